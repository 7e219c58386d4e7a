"""Reversals in closed form: parts that wind up as a law of their own each, and parts that follow at once."""

import math

import numpy as np

from ballscrew.physics.moving_balls.reversal import Reversal

#: Steady parts, N m, and the angles (degrees) over which Maxwell-slip elements wind them up after a reversal.
STEADY = {"rolling": 0.05, "spin_and_curvature": 0.06, "helix": 0.1, "ball_to_ball": 0.02, "losses": 0.04}
WINDS_UP_WITHIN = {"spin_and_curvature": 0.04, "helix": 10.0}
#: The angle (degrees) over which balls close up that press on each other no more at once.
CLOSES_WITHIN = 30.0


def closed_form(*, from_rest=False, lead=0.01, travel=None, steady=STEADY):
    """A reversal whose parts are straight lines up to their angles, half as far from rest."""
    end = 60.0 if travel is None else math.degrees(2 * math.pi * travel / lead)
    angles = np.radians(np.concatenate([[0.0], np.geomspace(1e-4, end, 500)]))
    before = 0.0 if from_rest else -1.0
    shares = {}
    for name in steady:
        risen = np.ones(angles.shape)
        if name == "ball_to_ball":
            risen = np.minimum(angles / math.radians(CLOSES_WITHIN), 1.0)
        elif name in WINDS_UP_WITHIN:
            within = math.radians(WINDS_UP_WITHIN[name]) * (0.5 if from_rest else 1.0)
            risen = before + (1 - before) * np.minimum(angles / within, 1.0)
        shares[name] = np.where(angles > 0, risen, before)
    parts = {name: torque * shares[name] for name, torque in steady.items()}
    return Reversal(
        screw_angle=angles,
        travel=angles * lead / (2 * math.pi),
        screw_torque=sum(parts.values()),
        contributions=parts,
        steady_torque=sum(steady.values()),
        steady_contributions=steady,
        displacement=tuple(1e-5 * share for name, share in shares.items() if name == "helix"),
        bristles_over_model=1.0,
        from_rest=from_rest,
    )
