"""Optimisation: free geometries within what is made, searched for a need by several objectives at once."""
