"""Numbers of a screw fitted to a log of torques."""
