"""Synthetic logs of a moving axis, from known truth: strokes of several speeds, quantised positions, coloured noise."""

import numpy as np
from scipy import integrate, signal

import ballscrew as bs
from support.screws import with_grooves

TRUTH = {"mass": 95.0, "offset": -3.2, "coulomb_force": 20.0, "viscous_coefficient": 200.0}

#: A small screw with the lead of the EMPS benchmark; the rest is guessed.
SCREW_OF = with_grooves(
    0.53,
    pitch_circle_diameter=12.6e-3,
    lead=2.5e-3,
    ball_diameter=1.588e-3,
    loaded_balls=70,
    nut=bs.DoubleNut(preload=150.0),
)
OIL = bs.Lubricant(viscosity=0.05)
MODEL = bs.FrictionModel.reference()


def strokes(speeds=(0.04, 0.08, 0.12), acceleration=1.5, hold=0.8, rest=0.1, repeats=2, step=1e-3, start=1):
    """Speed over time: trapezoids of every speed, forward and back, with a rest after each."""
    pieces = []
    for _ in range(repeats):
        for speed in speeds:
            ramp = np.linspace(0, speed, max(2, int(speed / acceleration / step)))
            one = np.concatenate([ramp, np.full(int(hold / step), speed), ramp[::-1], np.zeros(int(rest / step))])
            pieces += [start * one, -start * one]
    return np.concatenate(pieces)


def record(
    speed=None,
    *,
    step=1e-3,
    friction=None,
    truth=TRUTH,
    noise=1.0,
    correlation=0.05,
    resolution=5e-8,
    delay=0.0,
    seed=0,
):
    """A log as arrays in SI; the noise has a standard deviation in N and falls off over ``correlation`` seconds."""
    random = np.random.default_rng(seed)
    speed = strokes(step=step) if speed is None else speed
    # corners rounded over a few rows, as an axis does
    speed = np.convolve(speed, np.hanning(31) / np.hanning(31).sum(), mode="same")
    time = step * np.arange(speed.size)
    position = integrate.cumulative_trapezoid(speed, dx=step, initial=0.0)
    acceleration = np.gradient(speed, step)
    constant, viscous = truth["coulomb_force"], truth["viscous_coefficient"]
    law = friction or (lambda v: constant + viscous * v)
    clean = truth["mass"] * acceleration + truth["offset"] + np.sign(speed) * law(np.abs(speed))
    if delay:  # the motion follows the force
        clean = np.interp(time + delay, time, clean)
    pole = np.exp(-step / correlation)
    white = random.standard_normal(speed.size)
    coloured = signal.lfilter([np.sqrt(1 - pole**2)], [1, -pole], white)
    measured = np.round((position + 0.5 * resolution * random.standard_normal(speed.size)) / resolution) * resolution
    return {"time": time, "position": measured, "force": clean + noise * coloured}
