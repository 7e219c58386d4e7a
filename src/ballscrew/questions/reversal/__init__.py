"""Friction after a reversal or from rest, by mechanism, and the models of control engineering that stand for it."""
