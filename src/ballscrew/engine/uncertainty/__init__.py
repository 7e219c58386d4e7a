"""Distributions of inputs, bands of outputs, Monte Carlo, Sobol' indices and Morris screening."""
