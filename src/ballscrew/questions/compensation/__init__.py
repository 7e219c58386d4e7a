"""The error of position by heat, as a table for controls."""
