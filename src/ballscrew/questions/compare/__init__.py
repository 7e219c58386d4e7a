"""The torque by several models and by rules of one line."""
