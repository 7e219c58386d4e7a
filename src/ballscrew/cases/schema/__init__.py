"""Sections and fields of case files: names, units, limits, help, and what may stand in each."""
