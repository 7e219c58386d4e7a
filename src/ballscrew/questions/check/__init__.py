"""Checks of a case: life, speed, buckling, pressure and preload against their limits."""
