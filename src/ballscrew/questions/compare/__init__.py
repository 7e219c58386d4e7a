"""The torque by several models, laws and rules of one line; or several designs side by side."""
