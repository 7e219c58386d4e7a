"""Analyses: evaluate a model many times. No files, no pictures, no printing here."""
