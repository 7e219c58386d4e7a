"""Logs of a moving axis: mass, gravity, friction and dead time found from positions and forces over time."""
