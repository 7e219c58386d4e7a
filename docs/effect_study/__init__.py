"""Contribution of each effect to the friction torque: the study behind docs/effects.md and its figures."""
