"""The inputs that a result varies with, and by how much."""
