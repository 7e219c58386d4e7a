"""Service: the preload that is left in a nut, from logs of its torque or from one torque."""
