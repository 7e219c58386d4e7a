"""The oils and greases of the library."""
