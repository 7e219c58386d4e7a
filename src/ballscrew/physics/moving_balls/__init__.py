"""Balls in motion: off the line of their grooves, after a reversal, and in the chain of their neighbours."""
