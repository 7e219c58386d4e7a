"""Starvation: oil that flows back into the track too late, and the torque of the same screw in a full bath of oil.

One rule for all answers. Which of the two torques a ball screw has is not measured: the factor that starves is one of
bearings (:func:`~ballscrew.physics.equations.rolling.replenishment_factor`), and in the cold it may make friction fall
that would rise with a full track, and at last be that of contacts without a film. A supply that is known to be short
(``inlet_film_ratio``) is left as it is given.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import as_array
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import rolling

#: The id of the record, in every answer that holds a torque.
STARVED = "lubricant.starved"
#: What is beside a starved number.
FULL_BATH = "in a full bath of oil"
#: Two torques differ where that of the full bath is larger by more than this share of the other.
LARGEST_DIFFERENCE = 0.1
#: Share of the rolling force that is left, at and above which the torque of a full bath is not asked for: were all of
#: the torque that force, it would grow by 1/0.92, that is by less than what counts.
NEARLY_ALL = 0.92

_SENTENCE = (
    "starvation: {given} if oil this thick comes back into the track too late, as formulas for bearings say, and "
    "{flooded} in a full bath of oil; no measurement on a ball screw decides between them"
)
#: The sentence of an answer that has one number, with places for it.
OF_ONE_NUMBER = _SENTENCE.replace("{given}", "friction is {given}")


class BothTorques(NamedTuple):
    """A number of an answer, such as a torque, with the inlet as it is given and in a full bath of oil, SI."""

    quantity: Quantity
    given: float
    flooded: float


def differs(given: Any, flooded: Any) -> Any:
    """Mask: one of the torques is larger by more than :data:`LARGEST_DIFFERENCE`; False where one is NaN.

    It is that of the full bath, but far beyond what the heat of the inlet is known for: there a thick film may rub less
    than none.
    """
    one, other, most = as_array(given), as_array(flooded), 1 + LARGEST_DIFFERENCE
    return (other > most * one) | (one > most * other)


def most_starved(given: Any, flooded: Any) -> tuple[float, float] | None:
    """Both torques where they differ the most, by their ratio; None where they differ nowhere."""
    given, flooded = np.broadcast_arrays(np.asarray(given, dtype=float), np.asarray(flooded, dtype=float))
    apart = differs(given, flooded)
    if not np.any(apart):
        return None
    with np.errstate(over="ignore"):  # infinite where there is no friction as given
        tiny = np.finfo(float).tiny
        ratio = np.where(apart, np.maximum(flooded, given) / np.maximum(np.minimum(given, flooded), tiny), 0.0)
    place = np.unravel_index(int(np.argmax(ratio)), ratio.shape)
    return float(given[place]), float(flooded[place])


def replenished(model: Any, screw: BallScrew, lubricant: Any, screw_speed: Any) -> Any:
    """Share of the rolling force that oil coming back late leaves over; one without a law that starves."""
    constant = getattr(model.inlet, "replenishment_constant", None)
    if constant is None:
        return np.ones(np.shape(screw_speed))
    speed = model.laws.frame(screw).entrainment_speed(np.abs(screw_speed))
    return rolling.replenishment_factor(
        lubricant.viscosity / lubricant.density, np.asarray(speed, dtype=float), screw.ball_diameter, constant
    )


def least_replenished(model: Any, screw: BallScrew, lubricant: Any, screw_speed: Any) -> float:
    """The least of the shares that are :func:`replenished`, of those that are numbers."""
    left = replenished(model, screw, lubricant, screw_speed)
    return float(np.min(left, initial=1.0, where=np.isfinite(left)))


def records(numbers: Sequence[BothTorques], remark: str | None = None) -> list[Record]:
    """The record of an answer that is starved; the first of the numbers is its value, in a full bath.

    The limit of the record is that number with the inlet as it is given. A ``remark`` ends the sentence.
    """
    first = numbers[0]
    given = [units.shown(one.given, one.quantity) for one in numbers]
    flooded = [units.shown(one.flooded, one.quantity) for one in numbers]
    if len(numbers) == 1:
        as_given = f"friction is {given[0]}"
    else:
        as_given = _listed(
            [f"{one.quantity.info.meaning} {torque}" for one, torque in zip(numbers, given, strict=True)]
        )
    text = _SENTENCE.format(given=as_given, flooded=_listed(flooded))
    return [
        Record.warning(
            STARVED,
            first.quantity.name,
            f"{text}; {remark}" if remark else text,
            value=first.flooded,
            limit=first.given,
            unit=first.quantity.unit,
        )
    ]


def _listed(parts: Sequence[str]) -> str:
    *others, last = parts
    return f"{', '.join(others)} and {last}" if others else last
