"""Logs of measured torques: reading files, recognising columns, cleaning, motion."""
