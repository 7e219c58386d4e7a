"""Friction of the EMPS axis over its travel after it turns round, and what the model has for a screw like its own.

``python benchmarks/emps_reversal.py --file DATA_EMPS.mat`` prints a table. The record is not in the
repository, as its licence is not stated (docs/howto/moving_log.md says where it is).

Position and force are filtered alike at 150 Hz. Mass, offset and a steady law F_0 + c |v|^n are fitted to what lies
more than 5 mm behind a reversal. What is left of the force nearer to one, against the new direction, is friction after
it: the mean of all reversals, with their standard deviation. Nothing of the model is tuned: the screw of EMPS is
unknown but for its lead, and the one taken here is a guess.

Confounders: guides wind up over 10 to 50 µm, too; inertia is several times the friction at these reversals, so that a
mass or a time that is a little off makes newtons (``off`` below); the speed rises from zero meanwhile.
"""

from __future__ import annotations

import itertools
import math
from typing import Any, NamedTuple

import numpy as np
from scipy import optimize, signal

import ballscrew as bs
from ballscrew.evidence.moving_logs.reading import read_moving
from ballscrew.questions.shared.text_tables import markdown_table
from harness import asked, told
from support.moving_logs import SCREW_OF

LEAD = 2.5e-3
CUTOFF = 150.0
#: Travel behind a reversal at which friction is taken as steady, and shortest way between two that count, m.
FAR, STROKE = 5e-3, 0.02
#: Ends of the ranges of travel, m.
ENDS = 1e-6 * np.array([0, 5, 10, 20, 35, 50, 100, 300, 500, 800])
#: What is tried of the confounders: a share of the mass, and seconds by which the force is late.
OFF = {"mass +1 %": (0.01, 0.0), "mass -1 %": (-0.01, 0.0), "1 ms late": (0.0, 1e-3), "1 ms early": (0.0, -1e-3)}
#: Of the screw, a guess as in docs/howto/moving_log.md.
OIL = bs.Lubricant.from_grade("ISO VG 100", 303.15)
#: Speed of the computed curve, rad/s: 2 mm/s, which the axis has after some tens of µm.
SPEED = 2 * math.pi * 2e-3 / LEAD


class Motion(NamedTuple):
    """The filtered record, evenly in time."""

    position: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray
    force: np.ndarray


class Steady(NamedTuple):
    """Inertia, offset and steady law."""

    mass: float
    offset: float
    constant: float
    slope: float
    exponent: float

    def friction(self, speed: np.ndarray) -> np.ndarray:
        """Friction at a speed, N."""
        return self.constant + self.slope * np.abs(speed) ** self.exponent


def filtered(path: str, late: float = 0.0) -> Motion:
    """The record of a file; its force is taken as measured ``late``."""
    log = read_moving(path, lead=LEAD)
    time = np.asarray(log.time)
    step = float(np.mean(np.diff(time)))
    force = np.interp(time + late, time, np.asarray(log.force))
    sections = signal.butter(4, CUTOFF * 2 * step, output="sos")
    position, force = (signal.sosfiltfilt(sections, one) for one in (np.asarray(log.position), force))
    speed = np.gradient(position, step)
    return Motion(position, speed, np.gradient(speed, step), force)


def reversals(motion: Motion) -> list[tuple[int, int]]:
    """Rows of each reversal and of the next one, between ways of more than a stroke."""
    turns = np.flatnonzero(np.diff(np.sign(motion.speed)))
    kept: list[int] = []
    for turn in turns:  # of a turn that trembles, its last row
        if kept and abs(motion.position[turn] - motion.position[kept[-1]]) < STROKE:
            kept[-1] = turn
        else:
            kept.append(turn)
    ends = [*kept, len(motion.position)]
    way = [np.ptp(motion.position[low:high]) for low, high in zip([0, *kept], ends, strict=True)]
    return [(kept[i], ends[i + 1]) for i in range(len(kept)) if way[i] > STROKE and way[i + 1] > STROKE]


def far_rows(motion: Motion) -> np.ndarray:
    """True more than 5 mm behind a reversal, in motion."""
    far = np.zeros(len(motion.position), dtype=bool)
    for low, high in reversals(motion):
        far[low:high] = np.abs(motion.position[low:high] - motion.position[low]) > FAR
    return far & (np.abs(motion.speed) > 2e-3)


def steady_of(motion: Motion) -> Steady:
    """Least squares over the rows far from reversals; the exponent by search."""
    rows = far_rows(motion)
    speed, force = motion.speed[rows], motion.force[rows]

    def solved(exponent: float) -> tuple[Any, float]:
        columns = np.stack(
            [
                motion.acceleration[rows],
                np.ones(speed.shape),
                np.sign(speed),
                np.sign(speed) * np.abs(speed) ** exponent,
            ],
            axis=1,
        )
        found, *_ = np.linalg.lstsq(columns, force, rcond=None)
        return found, float(np.sum((columns @ found - force) ** 2))

    best = optimize.minimize_scalar(lambda exponent: solved(exponent)[1], bounds=(0.3, 1.2), method="bounded")
    return Steady(*map(float, solved(best.x)[0]), float(best.x))


def table(motion: Motion, steady: Steady, mass_off: float = 0.0) -> list[dict[str, float]]:
    """Means over all reversals, by range of travel."""
    rows: list[dict[str, float]] = []
    turned = reversals(motion)
    for low, high in itertools.pairwise(ENDS):
        friction: list[float] = []
        law: list[float] = []
        inertia: list[float] = []
        for first, last in turned:
            travel = np.abs(motion.position[first + 1 : last] - motion.position[first + 1])
            here = first + 1 + np.flatnonzero((travel >= low) & (travel < high))
            here = here[: int(np.flatnonzero(np.diff(here) > 1)[0]) + 1] if np.any(np.diff(here) > 1) else here
            way = np.sign(motion.position[last - 1] - motion.position[first + 1])
            pushed = steady.mass * (1 + mass_off) * motion.acceleration[here]
            friction.append(float(np.mean(way * (motion.force[here] - steady.offset - pushed))))
            law.append(float(np.mean(steady.friction(motion.speed[here]))))
            inertia.append(float(np.mean(np.abs(pushed))))
        rows.append(
            {
                "from_um": 1e6 * low,
                "to_um": 1e6 * high,
                "angle_deg": math.degrees(2 * math.pi * high / LEAD),
                "friction_N": float(np.mean(friction)),
                "spread_N": float(np.std(friction, ddof=1)),
                "steady_N": float(np.mean(law)),
                "inertia_N": float(np.mean(inertia)),
            }
        )
    return rows


def computed() -> tuple[np.ndarray, np.ndarray]:
    """Share of the swing that the model has back, over the travel, for the guessed screw."""
    found = bs.reversal(
        bs.FrictionModel.reference(), SCREW_OF, OIL, axial_load=0.0, screw_speed=SPEED, travel=float(ENDS[-1])
    )
    back = (found["screw_torque"] / found["steady_torque"] + 1) / 2
    return found["travel"].to_numpy(), back.to_numpy()


def main() -> None:
    """Evaluate, and print."""
    arguments = asked(__doc__, file="DATA_EMPS.mat")
    motion = filtered(arguments.file)
    steady = steady_of(motion)
    rows = table(motion, steady)
    travel, back = computed()
    for row in rows:
        middle = np.linspace(row["from_um"], row["to_um"], 50) * 1e-6
        row["swing_back"] = (row["friction_N"] / row["steady_N"] + 1) / 2
        row["computed_back"] = float(np.mean(np.interp(middle, travel, back)))
    for name, (mass, late) in OFF.items():
        other = filtered(arguments.file, late) if late else motion
        for row, off in zip(rows, table(other, steady, mass), strict=True):
            row[name] = off["friction_N"] - row["friction_N"]
    told({"reversals": len(reversals(motion)), **steady._asdict()}, arguments.json)
    headings = ["travel [µm]", "screw [°]", "friction [N]", "±", "steady [N]", "inertia [N]", "back", "computed", *OFF]
    lines: list[list[str]] = []
    for row in rows:
        numbers = [f"{row[name]:.1f}" for name in ("angle_deg", "friction_N", "spread_N", "steady_N", "inertia_N")]
        shares = [f"{row[name]:.0%}" for name in ("swing_back", "computed_back")]
        offs = [f"{row[name]:+.1f}" for name in OFF]
        lines.append([f"{row['from_um']:.0f} to {row['to_um']:.0f}", *numbers, *shares, *offs])
    print(markdown_table(headings, lines), end="")


if __name__ == "__main__":
    main()
