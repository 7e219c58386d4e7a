"""Stiffness, lost motion, critical speed and buckling of an axis over its stroke."""
