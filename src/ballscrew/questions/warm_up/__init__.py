"""Temperatures over hours, growth, preload, and the torque as they change it."""
