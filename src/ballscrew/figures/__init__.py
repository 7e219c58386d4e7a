"""Figures: drawn with matplotlib's objects only, the same bytes on every run."""
