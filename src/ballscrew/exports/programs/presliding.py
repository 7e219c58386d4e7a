"""Friction that comes back after a reversal, for exports with a state: Maxwell-slip elements, in shares of the torque.

They are fitted at one operating point. What slides there at a share of the steady friction torque slides at that share
of it everywhere, and after the same angle: so the state is a number for each element, without a unit.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Annotated, Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.quantities import Angle, AngularSpeed, Force, Info, Quantity, Ratio
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.export import Option, filled, warning
from ballscrew.exports.programs.c_source import number
from ballscrew.exports.subject import HandOver
from ballscrew.physics.moving_balls.friction_states import (
    MOST_ELEMENTS,
    SlipElementsFit,
    WindingUp,
    fit_slip_elements,
)
from ballscrew.physics.moving_balls.reversal import loops, reversal

_LOAD = Quantity("presliding_load", "N", Info("F", "load of the reversal", "kN", hint="4 kN", usual=(-1e7, 1e7)))
_SPEED = Quantity("presliding_speed", "rad/s", Info(r"\omega", "speed of the reversal", "rpm", usual=(-1e4, 1e4)))
#: Choices of the targets that have it.
OPTIONS: Mapping[str, Option] = {
    "presliding": Option(0, "Maxwell-slip elements, 1 to 4, of the friction after a reversal, as a state; 0: none"),
    "presliding_load": Option(math.nan, "axial load of the reversal (default: that of the case)", _LOAD),
    "presliding_speed": Option(
        math.nan, "speed of the screw at the reversal, a slow one (default: that of the case)", _SPEED
    ),
}
_NOTES = """\
Friction after a reversal is a HYPOTHESIS: it is computed from the contacts, and no published ball screw shows it by
itself. {elements}, fitted to a reversal at
  axial_load = {load!r} N, screw_speed = {speed!r} rad/s, all else at its usual value.
There their sum is off by up to {largest:.2g} of the steady torque, {rms:.2g} as root mean square over the travel.
Balls in their contacts have no memory of turning points, as the elements have: no elements have the curve and the
friction work of all strokes. On a stroke to and fro, again and again, the elements have of the work by the balls
{work}
That curve is scaled to the steady slip torque of the model, of which its own was {bristles:.3g}.
Nothing tells how far the elements are off at other loads, speeds and temperatures: there each has the same share of
screw_torque, and slides after the same angle.
{table}
The share {at_once!r} of screw_torque follows the direction at once.
The state of an element is what it holds over the torque at which it slides, -1 to 1:
  state = min(max(state + turned / slip_angle, -1), 1)
  friction torque = screw_torque * (at_once * sign(turned) + the sum of share * state)
This is exact for any turn that does not reverse on its way, and has the sign of the direction; the torque on the shaft
is ideal_torque and this. Take screw_torque in motion, not that at a speed of zero.
"""

_C_NOTES = """
ballscrew_presliding.c and ballscrew_presliding.h have the friction after a reversal, with a state that is yours:
  ballscrew_presliding state;
  ballscrew_presliding_start(&state, 0.0);
  ballscrew_evaluate(inputs, outputs);  /* in each step, with the speed of the screw */
  torque = outputs[BALLSCREW_IDEAL_TORQUE]
      + ballscrew_presliding_turn(&state, turned, outputs[BALLSCREW_SCREW_TORQUE]);
In a step without a turn the part that is at once is left out, as is all friction at rest in ballscrew_evaluate.
"""


@dataclasses.dataclass(frozen=True)
class Element:
    """A Maxwell-slip element, whatever the operating point."""

    share: Annotated[Ratio, Info("s_i", "torque at which the element slides, share of the steady friction torque")]
    slip_angle: Annotated[Angle, Info(r"\theta_i", "angle from rest at which the element slides", "deg", above=0)]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Presliding:
    """Friction that comes back after a reversal, as shares of the steady friction torque."""

    #: The one that slides first at the front.
    elements: tuple[Element, ...]
    at_once: Annotated[Ratio, Info("s_0", "share of the friction torque that follows the direction at once")]
    axial_load: Annotated[Force, Info("F", "axial load of the reversal")]
    screw_speed: Annotated[AngularSpeed, Info(r"\omega", "speed of the screw in the reversal")]
    #: How far the elements are from the curve, and from the work of the loops, that they are fitted to.
    fit: SlipElementsFit
    bristles_over_model: Annotated[Ratio, Info("", "steady slip torque of the reversal over that of the model")]

    @property
    def notes(self) -> str:
        """The text beside an export: the calls of C, the hypothesis, its point, how far off it is, and the rule."""
        count = len(self.elements)
        rows = [
            f"  {k}: share {element.share!r}, slip_angle {element.slip_angle!r} rad"
            for k, element in enumerate(self.elements, 1)
        ]
        numbers = _NOTES.format(
            elements="There is one Maxwell-slip element" if count == 1 else f"There are {count} Maxwell-slip elements",
            load=self.axial_load,
            speed=self.screw_speed,
            largest=self.fit.error.largest,
            rms=self.fit.error.rms,
            work="\n".join(
                f"  stroke of +-{math.degrees(loop.stroke / 2):g} deg of the screw: {loop.work_ratio:.3g}"
                for loop in self.fit.loops
            ),
            bristles=self.bristles_over_model,
            table="\n".join(rows),
            at_once=self.at_once,
        )
        return f"{_C_NOTES}\n{numbers}"

    @property
    def warning(self) -> Record:
        """The warning that it is a hypothesis."""
        load = units.shown(self.axial_load, _LOAD, 3)
        speed = units.shown(self.screw_speed, _SPEED, 3)
        off = units.percent(self.fit.error.largest)
        text = (
            "friction that comes back over the angle of the screw after a reversal is a hypothesis; it is fitted "
            f"at {load} and {speed} with an error of up to {off} of the steady torque, and of up to "
            f"{units.percent(self.fit.work_error)} of the friction work of short strokes, and carried over to all "
            "else"
        )
        return warning("presliding", "screw_torque", text, holds=None, value=self.fit.error.largest)

    @property
    def files(self) -> dict[str, str]:
        """The elements as C99: a structure for the state, and a function that turns it."""
        shares, angles = (
            ", ".join(number(getattr(element, name)) for element in self.elements) for name in ("share", "slip_angle")
        )
        return {
            "ballscrew_presliding.c": filled(
                "presliding.c", at_once=number(self.at_once), shares=shares, angles=angles
            ),
            "ballscrew_presliding.h": filled("presliding.h", count=len(self.elements)),
        }


def presliding(job: HandOver) -> Presliding | None:
    """The elements that an export asks for; None where it asks for none.

    Raises :class:`~ballscrew.basis.errors.InputError` for another number of them, without an operating point, and
    where the model has no such curve.
    """
    count, load, speed = (job.options[name] for name in OPTIONS)
    if count == 0:
        return None
    faults: list[Fault] = []
    if not 1 <= count <= MOST_ELEMENTS:
        faults.append(Fault("hand_over.presliding", "must be 0 to 4", str(count), "two hold both ranges"))
    if math.isnan(load):
        faults.append(Fault("hand_over.presliding_load", "is needed for the reversal", "", 'give "4 kN"'))
    if math.isnan(speed) or speed == 0:
        problem = "must not be zero" if speed == 0 else "is needed for the reversal"
        faults.append(Fault("hand_over.presliding_speed", problem, "", 'give a slow one: "6 rpm"'))
    raise_if_any(faults)
    subject = job.subject
    parts = subject.model, subject.screw, subject.lubricant
    result = reversal(*parts, axial_load=load, screw_speed=speed)
    curve = WindingUp.of(result, loops(*parts, result, axial_load=load, screw_speed=speed))
    fit, steady = fit_slip_elements(curve, count), float(curve.steady_torque)
    return Presliding(
        elements=tuple(Element(float(entry.slip_torque) / steady, float(entry.slip_angle)) for entry in fit.elements),
        at_once=float(curve.at_once) / steady,
        axial_load=load,
        screw_speed=speed,
        fit=fit,
        bristles_over_model=float(result.bristles_over_model),
    )


def options_of_case(case: Case) -> dict[str, Any]:
    """The operating point of the reversal: that of the case."""
    operation = case.operation
    return {"presliding_load": float(operation.axial_load), "presliding_speed": float(operation.screw_speed)}
