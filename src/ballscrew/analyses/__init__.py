"""Analyses: evaluate a model many times. No pictures, no printing; no files but the stores of large sweeps."""
