"""Targets of a hand-over that are tables and curves: grids with an error, in files that programs and controls read."""
