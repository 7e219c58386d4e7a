"""Coulomb and viscous friction: the linear model of a moving axis, and what a log does not tell about it."""

from __future__ import annotations

import dataclasses

import numpy as np

from ballscrew.basis.errors import Fault, spoken
from ballscrew.basis.records import Record
from ballscrew.evidence.moving_logs.equation import Equation
from ballscrew.evidence.moving_logs.regression import LARGEST_ERROR, LeastSquares, relative_error
from ballscrew.files.torque_logs.motion import Floats

#: The numbers of the model, in the order of its columns.
NAMES = ("mass", "offset", "coulomb_force", "viscous_coefficient")
#: Columns scaled to one are told apart if the smallest singular value is at least this.
_DISTINCT = 0.02
#: A number takes part in a direction if its share of it is at least this.
_TAKES_PART = 0.3
#: A force changes its unit midway if one scale before and another after, so many times as large, explain it better:
#: less than this share of the sum of squares is left.
_OTHER_UNIT, _BETTER = 4.0, 0.5
#: The change of unit is looked for in this part of the rows.
_WITHIN = 0.03

_REMEDIES = {
    frozenset({"offset", "coulomb_force"}): "record strokes in both directions",
    frozenset({"coulomb_force", "viscous_coefficient"}): (
        "record strokes at several speeds, the slowest a tenth of the fastest"
    ),
    frozenset({"mass", "viscous_coefficient"}): "record ramps of several accelerations and strokes at steady speed",
    frozenset({"mass", "coulomb_force"}): "record ramps in both directions that speed up and that slow down",
}
_SLOW = "record faster ramps: the force of the acceleration must be clear of the noise"
_FEW_SPEEDS = "record strokes at several speeds in both directions"


@dataclasses.dataclass(frozen=True, eq=False)
class LinearModel:
    """The fit of F = M a + F_g + sign(v)·(F_c + f_v |v|): values in the order of :data:`NAMES`, in SI."""

    solution: LeastSquares
    relative_error: float
    #: True for the numbers that the log identifies.
    identified: tuple[bool, ...]
    warnings: tuple[Record, ...]

    @property
    def values(self) -> Floats:
        """Mass, offset, Coulomb force, viscous coefficient."""
        return self.solution.values

    def force(self, equation: Equation) -> Floats:
        """The force of the model at the rows that an equation uses."""
        return columns(equation) @ self.values


def columns(equation: Equation) -> Floats:
    """The columns of the linear model at the rows used."""
    speed, direction = equation.speed, equation.direction
    ones = np.ones(speed.size)
    return equation.filtered(np.stack([equation.acceleration, ones, direction, direction**2 * speed], axis=1))


def linear_model(equation: Equation) -> LinearModel:
    """The linear model of a log, with what the log does not tell named."""
    sides = columns(equation)
    solved = LeastSquares.of(sides, equation.force)
    size = float(np.sqrt(np.mean(equation.force**2)))
    scale = np.sqrt(np.mean(sides**2, axis=0))
    # a friction matters by its own size, or by a tenth of the whole force if it is less; a mass by its own
    matters = np.maximum(np.abs(solved.values), 0.1 * size / np.maximum(scale, np.finfo(float).tiny))
    matters[0] = abs(solved.values[0])
    known = np.asarray((scale > 0) & (solved.errors <= LARGEST_ERROR * matters))
    warnings: list[Record] = []
    normal = sides / np.maximum(np.linalg.norm(sides, axis=0), np.finfo(float).tiny)
    _, singular, directions = np.linalg.svd(normal, full_matrices=False)
    for value, direction in zip(singular, directions, strict=True):
        if value >= _DISTINCT:
            continue
        part = np.abs(direction) >= _TAKES_PART
        names = [name for name, takes in zip(NAMES, part, strict=True) if takes]
        known &= ~part
        warnings.append(_not_told(names))
    named = {name for warning in warnings for name in warning.subject.split(",")}
    alone = [name for name, one in zip(NAMES, known, strict=True) if not one and name not in named]
    warnings += [_not_told([name]) for name in alone if not (name == "offset" and abs(solved.values[1]) < 0.1 * size)]
    return LinearModel(solved, relative_error(solved.residuals, equation.force), tuple(known.tolist()), tuple(warnings))


def _not_told(names: list[str]) -> Record:
    """The warning about numbers that a log does not tell, or not apart."""
    remedy = next(
        (text for pair, text in _REMEDIES.items() if pair <= {*names}), _SLOW if "mass" in names else _FEW_SPEEDS
    )
    numbers = " and ".join(map(spoken, names))
    problem = f"cannot tell {numbers} apart" if len(names) > 1 else f"does not tell the {numbers}"
    message = f"the log {problem} · {remedy}"
    return Record(text=message, id="fit.not_identified", subject=",".join(names), severity="warning", holds=False)


def unit_change(equation: Equation, name: str) -> Fault | None:
    """The fault of a log in which the force, or the position, changes its unit midway; None where it does not."""
    sides = columns(equation)
    values = np.linalg.lstsq(sides, equation.force, rcond=None)[0]
    explained, force = sides @ values, equation.force
    own, both, rows = np.cumsum(explained**2), np.cumsum(explained * force), force.size
    place = np.arange(int(_WITHIN * rows), rows - int(_WITHIN * rows))
    if place.size < 2 or own[-1] <= 0:
        return None
    tiny = np.finfo(float).tiny
    before = both[place] / np.maximum(own[place], tiny)
    after = (both[-1] - both[place]) / np.maximum(own[-1] - own[place], tiny)
    # the split is looked for by ratios, since the part in the larger unit is nearly all of the sum of squares
    ratio = np.abs(after) / np.maximum(np.abs(before), tiny)
    total = float(force @ force)
    left = total - before * both[place] - after * (both[-1] - both[place])
    best = int(np.argmin(left))
    most = max(float(ratio[best]), 1 / max(float(ratio[best]), tiny))
    # a part in a far smaller unit is lost in the sum of squares: it is judged by its own
    power = np.cumsum(force**2)
    parts = [power[place[best]] / (place[best] + 1), (power[-1] - power[place[best]]) / (rows - 1 - place[best])]
    jump = max(parts) / max(min(parts), tiny)
    if most < _OTHER_UNIT or jump < _OTHER_UNIT**2:
        return None
    row = equation.log.line[equation.used[place[best]]]
    told = f"the force is {most:.3g} times {'larger' if ratio[best] > 1 else 'smaller'} from there on"
    return Fault(
        f"{name} near row {row}",
        "the unit of the force or of the position changes midway",
        told,
        "give all rows one unit",
    )
