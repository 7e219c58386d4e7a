"""Friction of an axis fitted to a log of its motion."""
