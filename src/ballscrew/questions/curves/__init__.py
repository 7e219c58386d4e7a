"""The curves around an operating point: the sweeps that show what load, speed and temperature change."""
