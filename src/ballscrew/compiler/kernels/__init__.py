"""Recorded formulas compiled by LLVM: emission, compilation, cache, random numbers, quantile sketches."""
