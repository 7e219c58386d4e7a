"""The friction of a nut as it was called before a ball screw had its nut: it warns, and calls the model."""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Mapping

from ballscrew.basis.quantities import AngularSpeed, Force
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Bodies, Deviations, Nut, SingleNut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.nut_losses import ParasiticLaw


def nut_friction(
    model: FrictionModel,
    screw: BallScrew,
    nut: Nut,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    bodies: Bodies | None = None,
    deviations: Deviations | None = None,
    losses: Mapping[str, ParasiticLaw] | None = None,
) -> FrictionResult:
    """Deprecated: call the model with ``dataclasses.replace(screw, nut=nut)``.

    Returns the :class:`~ballscrew.physics.friction.result.FrictionResult` of ``model`` for ``screw`` with another
    ``nut`` and with ``lubricant``, at ``axial_load`` (N) and ``screw_speed`` (rad/s); arrays broadcast. ``bodies``,
    ``deviations`` and ``losses`` take the place of those of the nut, where they are given. The contact angle of a
    single nut follows its load here, as with ``SingleNut(angle_under_load=True)``.

    Raises what the model raises (:class:`~ballscrew.basis.errors.InputError`).
    """
    warnings.warn(
        "nut_friction is deprecated: a ball screw has its nut, model(BallScrew(…, nut=…), oil, …)",
        DeprecationWarning,
        stacklevel=2,
    )
    parts = {"bodies": bodies, "deviations": deviations, "losses": losses}
    nut = dataclasses.replace(nut, **{name: part for name, part in parts.items() if part is not None})
    if isinstance(nut, SingleNut):
        nut = dataclasses.replace(nut, angle_under_load=True)
    return model(dataclasses.replace(screw, nut=nut), lubricant, axial_load=axial_load, screw_speed=screw_speed)
