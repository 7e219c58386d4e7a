"""The state of a nut over time, from a table of tests."""
