"""A duty of one operating point: the nut goes to and fro at one speed, under one load."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.duty import Duty, duty
from ballscrew.axis.motion.profiles import Segment, Segments
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Force, Length
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.element import FrictionElement
from ballscrew.physics.friction.model import FrictionModel


@accepts_units("operation")
def to_and_fro(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant | None = None,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    stroke: Length,
    also: Mapping[str, FrictionElement] | None = None,
) -> Duty:
    """The duty of a screw that turns at one speed over a stroke and back, with no mass and no rest.

    Returns a :class:`~ballscrew.axis.duty_cycle.duty.Duty`. ``model``, ``screw``, ``lubricant`` and ``also``, further
    elements on the shaft, are those of :func:`~ballscrew.axis.duty_cycle.duty.duty`. ``axial_load`` (N),
    ``screw_speed`` (rad/s; its sign is that of the first way) and ``stroke`` (m) are one number each. The load keeps
    its direction, as a weight does: one way the screw lifts it, the other way it drives the screw.

    Raises :class:`~ballscrew.basis.errors.InputError` for a speed of zero, and for a stroke that is not positive.
    """
    faults: list[Fault] = []
    if not abs(screw_speed) > 0:
        faults.append(Fault("operation.screw_speed", "is zero: nothing warms up", "0 rpm", "give a speed"))
    if not stroke > 0:
        faults.append(Fault("surroundings.stroke", "must be positive", f"{stroke:g} m", "give half the shaft"))
    raise_if_any(faults)
    speed = abs(float(screw_speed)) * float(screw.lead) / (2 * math.pi)
    first = math.copysign(1.0, screw_speed)
    ways = tuple(
        Segment(name=name, duration=stroke / speed, speed=sign * speed, force=float(axial_load))
        for name, sign in (("forth", first), ("back", -first))
    )
    return duty(model, screw, lubricant, axis=Axis(mass=0.0), motion=Segments(segments=ways), also=also)
