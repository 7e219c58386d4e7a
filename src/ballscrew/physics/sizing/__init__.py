"""Ratings, life, and the checks of a ball screw."""
