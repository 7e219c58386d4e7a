"""Everything that iterates."""
