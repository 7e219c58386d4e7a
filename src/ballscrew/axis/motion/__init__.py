"""Motions of an axis: profiles in closed form, segments, trajectories from logs. No ball screw in it."""
