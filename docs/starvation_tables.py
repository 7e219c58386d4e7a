"""What oil that comes back too late does to each answer, from the cold to a warm hall.

``python docs/starvation_tables.py`` prints the table. Each column is an answer of one command for an example that is
shipped, with the inlet as it is given (a low oil bath) and in a full bath of oil:

- *run*: the friction torque of ``examples/vertical_axis.toml`` at 4 kN and 1500 rpm.
- *duty, torque* and *duty, energy lost*: the largest torque of the motor and the energy lost in a cycle of that axis.
- *warm-up, start* and *warm-up, end*: the mean friction torque of ``examples/warm_up.toml`` in a hall of this
  temperature, at the start and in the steady state; below -15 °C the oil of a warm-up is not known.
- *select, loss*: the loss of the screw of that axis as a candidate at 4 kN and 1500 rpm; it is ranked by the larger.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import ballscrew as bs
from ballscrew.axis.thermal.friction_map import COLDEST
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.friction.validity import differs
from ballscrew.questions.duty.compute import duty
from ballscrew.questions.run.compute import run
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.warm_up.compute import warmed_up

EXAMPLES = Path(__file__).parents[1] / "examples"
#: Temperatures of the oil, or of the hall, °C.
TEMPERATURES = (-20, -10, 0, 10, 20, 40, 60)
ZERO = 273.15
#: A need that the screw of the vertical axis alone is held against.
CANDIDATE = {
    "force": "4 kN", "speed": "1500 rpm", "oil": "ISO VG 100", "nut": "double", "preload": "5 %",
    "rows": "hiwin-40-20k4", "life": "20000 h",
}  # fmt: skip


class Cell(NamedTuple):
    """A number with the inlet as it is given, and in a full bath of oil."""

    given: float
    flooded: float
    unit: str = "N m"


#: Answers by the heads of their columns.
Answers = Mapping[str, Cell]


def of_run(degrees: float) -> Answers:
    """The friction torque at one operating point."""
    found = run(_vertical_axis(degrees)).friction
    return {"run": Cell(float(found.screw_torque), float(found.flooded_torque))}


def of_duty(degrees: float) -> Answers:
    """Torque of the motor and energy lost over a cycle."""
    report = duty(_vertical_axis(degrees))
    full = report.bath.numbers
    return {
        "duty, torque": Cell(report.numbers["torque_peak"], full["torque_peak"]),
        "duty, energy lost": Cell(report.numbers["energy_lost"], full["energy_lost"], "J"),
    }


def of_warm_up(degrees: float) -> Answers:
    """Friction torque at the start of warming up and at its end."""
    nothing = Cell(math.nan, math.nan)
    if degrees + ZERO < COLDEST:
        return {"warm-up, start": nothing, "warm-up, end": nothing}
    report = warmed_up(case_file.load(EXAMPLES / "warm_up.toml", [f"surroundings.ambient={degrees} degC"], moves=True))
    full = report if report.full_bath is None else report.full_bath
    return {
        "warm-up, start": Cell(float(report.series["screw_torque"][0]), report.warm_up.flooded_torque),
        "warm-up, end": Cell(report.equilibrium["screw_torque"], full.equilibrium["screw_torque"]),
    }


def of_select(degrees: float) -> Answers:
    """The loss of a candidate."""
    [found] = bs.select({**CANDIDATE, "temperature": f"{degrees} degC"}, complete=True).ranked
    given = float(found.candidate.checked.run.friction.friction_power)
    return {"select, loss": Cell(given, found.candidate.objectives["loss"], "W")}


#: What is asked, in the order of the columns.
QUESTIONS: tuple[Callable[[float], Answers], ...] = (of_run, of_duty, of_warm_up, of_select)


def answers(degrees: float) -> Answers:
    """All answers at a temperature."""
    return {head: cell for question in QUESTIONS for head, cell in question(degrees).items()}


def _vertical_axis(degrees: float) -> Case:
    tables = case_file.read(EXAMPLES / "vertical_axis.toml")
    return case_file.build(case_file.override(tables, [f"lubricant.temperature={degrees} degC"]), moves=True)


def table() -> str:
    """Rows are temperatures; a cell is starved → full bath where the two differ, or else one number."""
    found = {degrees: answers(degrees) for degrees in TEMPERATURES}
    heads = list(found[TEMPERATURES[0]])
    rows = [[str(degrees), *(_shown(row[head]) for head in heads)] for degrees, row in found.items()]
    return markdown_table(("°C", *heads), rows, numbers=True)


def _shown(cell: Cell) -> str:
    if math.isnan(cell.given):
        return "–"
    if not differs(cell.given, cell.flooded):
        return f"{_rounded(cell.given)} {cell.unit}"
    return f"{_rounded(cell.given)} → {_rounded(cell.flooded)} {cell.unit}"


def _rounded(value: float) -> str:
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


if __name__ == "__main__":
    print(table())
