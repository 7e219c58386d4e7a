"""Recorded formulas compiled by LLVM: emission, compilation, cache."""
