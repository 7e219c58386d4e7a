"""The results over the axes of a grid, in memory or in files."""
