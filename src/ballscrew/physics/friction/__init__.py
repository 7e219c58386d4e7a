"""Friction of a ball screw: the model, what comes out, where it may be trusted, and the sum over a nut."""
