r"""``--to modelica``: the screw as a component with the interfaces of the Modelica Standard Library.

Beside it stands the table of ``Modelica.Mechanics.Rotational.Components.LossyGear``, fitted, with its error.

At each speed the gear knows an efficiency and a friction torque that no load changes. With the torque
:math:`T = \lvert F \rvert P_h / 2\pi` of the load its friction is :math:`c + k T` in all four quadrants, if
:math:`\eta_{mf1} = 1/(1 + k)`, :math:`\eta_{mf2} = 1 - k`, :math:`\tau_{bf1} = c\, \eta_{mf1}` and
:math:`\tau_{bf2} = c / \eta_{mf2}`; this follows from the equations of the gear. Friction that falls with the load, as
that of a nut with oversize balls, needs a negative :math:`k`, which is no efficiency.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from ballscrew.basis import units
from ballscrew.basis.quantities import AngularSpeed, Info, Quantity, unit_of
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export, Option, Target, filled, warning
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables.friction_table import DRIVE, INTERPOLATED, OPTIONS, FrictionTable, TableJob

Floats = NDArray[np.float64]

#: Error, as a share of the largest friction, above which the table is advised against.
LARGE = 0.05
#: Inertia of the motor of the example, kg m².
_ROTOR = 1e-3

_README = """\
BallScrewFriction.mo has the component BallScrew with an example; it needs the Modelica Standard Library, version 4.
LossyGear.txt has the parameters of the library's own gear, fitted, and says how far off it is.
"""


def export(job: HandOver) -> Export:
    """The component in a package with an example, and the table of a LossyGear beside it."""
    made = TableJob.of(job, "the component")
    at_rest, gear = float(job.options["speed_at_rest"]), loss_table(made.table)
    files = {
        "BallScrewFriction.mo": component(job, made.table, at_rest, made.about),
        "LossyGear.txt": _lossy_gear(job, gear),
    }
    return made.export("modelica", files, _README, [_creeps(at_rest), _gear_is_off(gear)])


_SPEED_AT_REST = Quantity("speed_at_rest", unit_of(AngularSpeed) or "", Info("w_0", "speed of regularisation", "rpm"))
_AT_REST = 'speed around rest at which friction is a slope: "1 rpm"'
MODELICA = Target(export, {**OPTIONS, "speed_at_rest": Option(0.1, _AT_REST, _SPEED_AT_REST, 'give "1 rpm"')})


def component(job: HandOver, table: FrictionTable, at_rest: float, about: Sequence[str]) -> str:
    """The text of the package."""
    loads, speeds = (table.axes[name] for name in OPERATION[:2])
    travel = float(job.subject.screw.lead) / (2 * math.pi)
    mass = float(f"{_example_load(float(loads[0]), float(loads[-1])) / 9.81:.1g}")
    held = mass * 9.81 * table.torque_of_load
    # the swing of the motor turns the rotor up to a third of the range, against the friction at the load
    inertia = _ROTOR + mass * travel * travel
    friction = float(np.interp(9.81 * mass, loads, table.values[INTERPOLATED[0]].max(axis=1)))
    swing = friction + math.pi * inertia * min(-speeds[0], speeds[-1]) / 3
    return filled(
        "BallScrewFriction.mo",
        notes="\n".join(f"  // {line}" for line in about),
        loads=len(loads),
        speeds=len(speeds),
        f=_vector(loads),
        w=_vector(speeds),
        m=_matrix(table.values[INTERPOLATED[0]]),
        v=_matrix(table.valid.astype(float)),
        ideal=table.torque_of_load,
        travel=travel,
        at_rest=at_rest,
        mass=f"{mass:g}",
        rotor=f"{_ROTOR:g}",
        amplitude=f"{swing:.3g}",
        offset=f"{held:.3g}",
    )


def _example_load(least: float, greatest: float) -> float:
    """A load within the range for the example, upwards where the range has such loads."""
    if greatest <= 0:
        return 9.81
    return math.sqrt(least * greatest) if least > 0 else 0.1 * greatest


def _lossy_gear(job: HandOver, gear: LossTable) -> str:
    return filled(
        "LossyGear.txt",
        error=f"{gear.error:.3g}",
        of_largest=f"{100 * gear.of_largest:.2g}",
        advice="\n// That is much: take the component BallScrew instead." if gear.of_largest > LARGE else "",
        slowest=f"{gear.speeds[0]:.6g}",
        fastest=f"{gear.speeds[1]:.6g}",
        rows="[" + ";\n    ".join(", ".join(f"{value:.6g}" for value in row) for row in gear.rows.tolist()) + "]",
        ratio=2 * math.pi / float(job.subject.screw.lead),
    )


def _creeps(at_rest: float) -> Record:
    text = (
        f"friction is a slope through zero up to about {units.in_unit(at_rest, 'rad/s', 6)}: a load that friction "
        "holds creeps there; do not read holding from this component"
    )
    return warning("at_rest", DRIVE, text, value=at_rest)


def _gear_is_off(gear: LossTable) -> Record:
    severe = gear.of_largest > LARGE
    percent = units.to_significant(100 * gear.of_largest, 2)
    text = (
        f"the table of a LossyGear is off by up to {units.in_unit(gear.error, 'N m', 2)}, {percent} % of the largest "
        f"friction{'; take the component instead' if severe else ''}"
    )
    severity = "warning" if severe else "info"
    numbers = {"severity": severity, "holds": not severe, "value": gear.of_largest, "limit": LARGE}
    return warning("lossy_gear", INTERPOLATED[0], text, **numbers)


def _vector(values: Any) -> str:
    return "{" + ", ".join(map(repr, np.asarray(values).tolist())) + "}"


def _matrix(values: Any) -> str:
    return "{" + ",\n      ".join(map(_vector, values)) + "}"


@dataclasses.dataclass(frozen=True, eq=False)
class LossTable:
    """Rows of speed, efficiency driving, efficiency driven, friction driving, friction driven."""

    rows: Floats
    #: Worst error of the friction at the nodes of the table that it was fitted to, N m.
    error: float
    #: The same as a share of the largest friction.
    of_largest: float
    #: The least and the greatest speed of the nodes that it was fitted to, rad/s, with their sign.
    speeds: tuple[float, float]


def loss_table(table: FrictionTable) -> LossTable:
    """The table of least worst error at each speed of a friction table over load and speed.

    The gear knows the size of the speed only: its rows are those of the direction that reaches the higher speed, of two
    alike the positive one.
    """
    speeds = table.axes[OPERATION[1]]
    friction, load = (table.values[name] for name in INTERPOLATED)
    forward = speeds[-1] >= -speeds[0]
    columns = np.nonzero(speeds >= 0)[0] if forward else np.nonzero(speeds <= 0)[0][::-1]
    rows: list[list[float]] = []
    off: list[Floats] = []
    for column in columns:
        constant, share = _line(np.abs(load[:, column]), friction[:, column])
        driving, driven = 1 / (1 + share), 1 - share
        rows.append([abs(speeds[column]), driving, driven, constant * driving, constant / driven])
        off.append(np.abs(constant + share * np.abs(load[:, column]) - friction[:, column]))
    errors = np.column_stack(off)
    worst = float(errors.max())
    ends = float(speeds[columns].min()), float(speeds[columns].max())
    return LossTable(np.array(rows), worst, worst / float(friction[:, columns].max()), ends)


def _line(load: Floats, friction: Floats) -> tuple[float, float]:
    """Constant and share of the line of least worst error; both at least zero, the share below one."""
    ones = np.ones_like(load)
    above = np.column_stack([ones, load, -ones])
    below = np.column_stack([-ones, -load, -ones])
    fitted = linprog(
        [0.0, 0.0, 1.0],
        A_ub=np.vstack([above, below]),
        b_ub=np.concatenate([friction, -friction]),
        bounds=[(0, None), (0, 0.999), (0, None)],
    )
    return float(fitted.x[0]), float(fitted.x[1])
