"""Many points at once: evaluation, sweeps and their stores, uncertainty.

May import ``physics`` and below, xarray and pandas. Start with ``evaluation.evaluation``.
"""
