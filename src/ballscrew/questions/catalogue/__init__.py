"""The rows of catalogues."""
