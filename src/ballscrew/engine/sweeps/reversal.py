"""Friction after a reversal as a labelled dataset over the angle of the screw."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import accepts_units
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Quantity, Ratio, fields_of, quantities_of
from ballscrew.engine.evaluation.outputs import attributes_of
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.moving_balls import reversal as moving_balls

#: The numbers of a reversal: over the angle, and of steady motion.
QUANTITIES: Mapping[str, Quantity] = quantities_of(moving_balls.Reversal)
#: The parts of the torque, by how they come back.
PARTS: Mapping[str, str] = {
    "rolling": "rolling resistance, at once",
    "spin_and_curvature": "spin and curvature slip, within the contacts",
    "helix": "helix slip, as balls on two contacts roll across their grooves",
    "ball_to_ball": "ball to ball and return, as the gaps close",
    moving_balls.LOSSES: "losses of the nut, at once",
}
_LENGTH = Quantity("displacement", "m", Info(r"\eta", "way of the balls off the line of their grooves", "um"))
#: Said of every dataset.
HYPOTHESIS = (
    "a hypothesis: that helix slip comes back over degrees of the screw follows from the contacts, "
    "and no measured ball screw shows it by itself"
)


@accepts_units("reversal")
def reversal(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    travel: Length | None = None,
    from_rest: bool = False,
    gap: Ratio = moving_balls.GAP,
) -> xr.Dataset:
    """Friction torque over the angle of the screw after it has turned round, by mechanism.

    ``model``, ``screw`` and ``lubricant`` are those of a steady point under an ``axial_load`` (N) at a ``screw_speed``
    (rad/s); the curve goes from minus the steady torque to plus it, or ``from_rest`` from zero, over a ``travel`` (m)
    of the nut; without it until nothing changes any more. The ``gap`` of each circuit, in balls, closes before they
    press on each other again. The dataset that is returned has the coordinate ``screw_angle`` and
    the variables ``travel``, ``screw_torque``, ``contribution_…`` by mechanism, the same of steady motion
    (``steady_torque``, ``steady_contribution_…``), and the ``displacement`` of the balls of each kind off the line of
    their grooves; names, units and sources are those of a sweep.

    A hypothesis: that the helix part comes back over degrees of the screw follows from the contacts, and is not
    measured. Raises :class:`~ballscrew.basis.errors.InputError` for arrays, a speed of zero, a travel that is
    not above zero, a gap below zero, balls without load, and for a model without slip across the path.
    """
    curve = moving_balls.reversal(
        model,
        screw,
        lubricant,
        axial_load=axial_load,
        screw_speed=screw_speed,
        travel=travel,
        from_rest=from_rest,
        gap=gap,
    )
    operation = {"axial_load": axial_load, "screw_speed": screw_speed}
    return dataset_of(Configuration(model, screw, lubricant), curve, operation)


def dataset_of(subject: Configuration, curve: moving_balls.Reversal, operation: Mapping[str, Any]) -> xr.Dataset:
    """A reversal with names, units and sources, at its operating point."""
    over = ("screw_angle",)
    variables: dict[str, Any] = {
        name: (over, np.asarray(getattr(curve, name), dtype=float), attributes_of(QUANTITIES[name]))
        for name in ("travel", "screw_torque")
    }
    for mechanism, values in curve.contributions.items():
        name = f"contribution_{mechanism}"
        variables[name] = (over, np.asarray(values, dtype=float), attributes_of(contribution(mechanism)))
    variables["steady_torque"] = ((), float(curve.steady_torque), attributes_of(QUANTITIES["steady_torque"]))
    for mechanism, value in curve.steady_contributions.items():
        name = f"steady_contribution_{mechanism}"
        variables[name] = ((), float(value), attributes_of(contribution(mechanism, steady=True)))
    if curve.displacement:
        variables["displacement"] = (("kind", *over), np.array(curve.displacement), attributes_of(_LENGTH))
    fields = fields_of(OperatingState)
    coordinates: dict[str, Any] = {
        "screw_angle": (over, np.asarray(curve.screw_angle, dtype=float), attributes_of(QUANTITIES["screw_angle"]))
    }
    coordinates |= {name: ((), float(value), attributes_of(fields[name])) for name, value in operation.items()}
    records = subject.implausible(operation)
    sentences = "; ".join(f"{record.name}: {record.text}" for record in records)
    start = "from rest" if curve.from_rest else "after a reversal"
    attributes = {
        **subject.attributes(),
        "title": f"Ball screw friction {start}, model {subject.model.label}",
        "start": start,
        "comment": HYPOTHESIS,
    }
    return xr.Dataset(variables, coordinates, attributes | ({"warnings": sentences} if sentences else {}))


def contribution(mechanism: str, *, steady: bool = False) -> Quantity:
    """The part of the torque by a mechanism, over the angle or of steady motion."""
    torque = QUANTITIES["screw_torque"]
    symbol, words = f"{torque.info.symbol} ({mechanism})", PARTS.get(mechanism, mechanism)
    info = Info(symbol, f"friction torque{' of steady motion' * steady}: {words}")
    return Quantity(f"{'steady_' * steady}contribution_{mechanism}", torque.unit, info)
