r"""The table of the gear ``Modelica.Mechanics.Rotational.Components.LossyGear``, fitted, with its error.

At each speed the gear knows an efficiency and a friction torque that no load changes. With the torque
:math:`T = \lvert F \rvert P_h / 2\pi` of the load its friction is :math:`c + k T` in all four quadrants, if
:math:`\eta_{mf1} = 1/(1 + k)`, :math:`\eta_{mf2} = 1 - k`, :math:`\tau_{bf1} = c\, \eta_{mf1}` and
:math:`\tau_{bf2} = c / \eta_{mf2}`; this follows from the equations of the gear. Friction that falls with the load, as
that of a nut with oversize balls, needs a negative :math:`k`, which is no efficiency.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.tables.friction_table import INTERPOLATED, FrictionTable

Floats = NDArray[np.float64]

#: Error, as a share of the largest friction, above which the table is advised against.
LARGE = 0.05


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
    found = linprog(
        [0.0, 0.0, 1.0],
        A_ub=np.vstack([above, below]),
        b_ub=np.concatenate([friction, -friction]),
        bounds=[(0, None), (0, 0.999), (0, None)],
    )
    return float(found.x[0]), float(found.x[1])
