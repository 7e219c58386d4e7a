"""Targets of a hand-over that compute: C, data with an interpreter, FMU, joints of simulators of robots."""
