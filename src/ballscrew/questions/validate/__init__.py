"""The model against rows of makers and of publications."""
