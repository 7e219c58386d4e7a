"""The cheat sheet, one page: commands, quantities of a case file with their units, names in Python.

``python docs/make_cheat_sheet.py out/cheat_sheet.pdf`` (or ``make docs``) sets it with Typst, from what ``--help``, the
case file and the reference say.
"""

import json
import sys
from pathlib import Path

import typst
from typer.main import get_command

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.faces.cli.main import app
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.sizing.installation import Installation, Limits

TEMPLATE = Path(__file__).with_suffix(".typ")
#: Tables of a case file that most cases have, with the class of their fields.
TABLES = {
    "operation": OperatingState,
    "screw": BallScrew,
    "nut": DoubleNut,
    "lubricant": Lubricant,
    "installation": Installation,
    "limits": Limits,
    "axis": Axis,
    "motor": Motor,
    "surroundings": Surroundings,
}
#: What a call of a model answers, as people ask for it.
RESULTS = (
    "screw_torque",
    "drive_torque",
    "holding_torque",
    "efficiency",
    "back_driving_efficiency",
    "friction_power",
    "screw_film_parameter",
    "screw_maximum_pressure",
    "screw_ellipticity",
    "nut_film_parameter",
    "nut_maximum_pressure",
)
#: Names in Python with what they are for.
PYTHON = {
    "bs.BallScrew(…)": "a screw; nut=bs.DoubleNut(preload=…)",
    "bs.catalogue()[NAME].screw()": "a screw of a maker",
    'bs.Lubricant.from_grade("ISO VG 100")': "an oil",
    "bs.FrictionModel.reference()": "the model; olaru2005(), corrected()",
    "model(screw, oil, axial_load=…, screw_speed=…)": "numbers or arrays, SI",
    "bs.sweep(model, screw, oil, …)": "xarray over any inputs",
    "bs.derivatives(…, by=[…])": "exact derivatives",
    "bs.monte_carlo(…, distributions={…})": "a band",
    "bs.fit(…, free=[…])": "numbers of a model from a log",
}
#: Options that many commands have.
OPTIONS = {
    '--set operation.axial_load="2 kN"': "another value, with its unit",
    "--json, --sheet": "the document; what people see of it, as data",
    "--to FILE, -o FILE": "a table or picture: .csv .xlsx .png .svg .pdf",
    "--band": "the 95 % band",
    "--model NAME": "reference, corrected or olaru2005",
}


def commands() -> list[tuple[str, str]]:
    """The commands with the first line of their help."""
    known = get_command(app).commands  # pyright: ignore[reportAttributeAccessIssue]  (a group)
    return [(f"ballscrew {name}", command.get_short_help_str(200)) for name, command in known.items()]


def row(quantity: Quantity) -> tuple[str, str]:
    """A quantity: its name with the unit that people think in, and its meaning."""
    unit = units.symbol(quantity.shown_in)
    return quantity.name + (f" [{unit}]" if unit not in ("1", "") else ""), quantity.info.meaning


def contents() -> list[tuple[str, list[tuple[str, str]]]]:
    """The tables of the sheet with their headings."""
    fields = {name: [row(quantity) for quantity in fields_of(cls).values()] for name, cls in TABLES.items()}
    results = known_outputs()
    return [
        ("Commands", commands()),
        ("Options of many commands", list(OPTIONS.items())),
        ("Units, typed with every number", [(unit, ", ".join(usual)) for unit, usual in units.USUAL.items()]),
        *((f"Case file: [{name}]", rows) for name, rows in fields.items()),
        ("Python: import ballscrew as bs", list(PYTHON.items())),
        ("Results", [row(results[name].quantity) for name in RESULTS]),
    ]


def main(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    data = json.dumps(contents(), ensure_ascii=False)
    path.write_bytes(typst.compile(str(TEMPLATE), sys_inputs={"contents": data}))
    print(path)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
