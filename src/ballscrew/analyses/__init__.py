"""Analyses: evaluate a model many times. No pictures and no printing here, and no files but the stores of large sweeps."""
