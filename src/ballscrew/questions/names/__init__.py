"""The names that may stand in a case file."""
