"""Three synthetic logs that end in numbers that no screw has, and what the fit says of them.

Each is made by the model with noise of 1 %, and each has one fault that is usual: a nut that is not the one of the
case, a torque sensor whose zero is off in a log of one direction, seals that the case does not have.

    python benchmarks/implausible_fits.py            print the table, as Markdown
    python benchmarks/implausible_fits.py --write    and store it in docs/implausible_fits.inc
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import ballscrew as bs
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.physics.components.nut import Nut
from ballscrew.questions.shared.text_tables import markdown_table
from harness import study

MODEL = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("ISO VG 68", 308.15)
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
RATING = float(ROW.dynamic_load_rating or math.nan)
FRICTION, CONSTANT, PRELOAD = "boundary_friction_coefficient", "constant_torque", "nut.preload"
ROWS, NOISE = 120, 0.01
#: The ranges in which nothing was said before the verdicts: of the coefficient, and of the constant torque in N m.
BEFORE = {FRICTION: (0.0, 1.0), CONSTANT: (-50.0, 50.0), PRELOAD: (0.0, math.inf)}
#: The range in the sentence of a verdict.
OUTSIDE = re.compile(r"is (outside .+? to .+?) \(")


class Log(NamedTuple):
    """A log with its fault: the nut that it is of, that of the case, and what is fitted."""

    fault: str
    true: Nut
    case: Nut
    free: tuple[str, ...]
    loads: tuple[float, float] = (0.0, 6000.0)
    zero: float = 0.0
    both: bool = True

    def columns(self) -> dict[str, Any]:
        """The columns in SI."""
        random = np.random.default_rng(7)
        load = random.uniform(*self.loads, ROWS)
        speed = np.exp(random.uniform(math.log(10), math.log(600), ROWS)) * 2 * math.pi / 60
        sign = np.where(np.arange(ROWS) % 2, -1.0, 1.0) if self.both else np.ones(ROWS)
        torque = MODEL(ROW.screw(nut=self.true), OIL, axial_load=load, screw_speed=speed).screw_torque
        measured = sign * torque * (1 + NOISE * random.standard_normal(ROWS)) + self.zero
        warm = np.full(ROWS, 308.15)
        return {"axial_load": load, "screw_speed": sign * speed, "friction_torque": measured, "temperature": warm}

    def fit(self) -> CalibratedModel:
        """The fit of the case's nut to the log."""
        screw = ROW.screw(nut=self.case)
        return bs.fit(MODEL, screw, OIL, self.columns(), self.free, holdout=0.0, dynamic_load_rating=RATING)


DOUBLE = bs.DoubleNut(preload=3000.0)
SMALL_SEALS, SEALS = (bs.DoubleNut(3000.0, losses={"seals": bs.Seals(seal_torque=torque)}) for torque in (0.05, 0.9))
LOGS = {
    "another nut": Log(
        "a double nut of 2 kN; the case has a single nut", bs.DoubleNut(preload=2000.0), bs.SingleNut(), (FRICTION,),
        loads=(500.0, 3000.0),
    ),
    "zero of the sensor": Log(
        "zero off by -0.2 N m, forward only", SMALL_SEALS, DOUBLE, (FRICTION, CONSTANT), zero=-0.2, both=False
    ),
    "seals left out": Log(
        "wipers of 0.9 N m that the case does not have; no load", SEALS, DOUBLE, (PRELOAD,), loads=(0.0, 0.0)
    ),
}  # fmt: skip


def rows() -> Iterator[list[str]]:
    """What was found and said."""
    for name, log in LOGS.items():
        found = log.fit()
        said = {one.subject: f"implausible: {OUTSIDE.findall(one.text)[0]}" for one in found.verdict_records}
        for estimate in found.estimates.values():
            low, high = BEFORE[estimate.name]
            before = "nothing" if low <= estimate.value <= high else "a warning"
            unit = "" if estimate.quantity.unit == "1" else f" {estimate.quantity.unit}"
            value = f"{estimate.name.rpartition('.')[2].replace('_', ' ')} {estimate.value:.3g}{unit}"
            yield [name, log.fault, value, before, said.get(estimate.name, "plausible")]


if __name__ == "__main__":
    heading = ("log", "fault", "fitted", "before", "verdict")
    study(__doc__, lambda: markdown_table(heading, list(rows())), "implausible_fits.inc")
