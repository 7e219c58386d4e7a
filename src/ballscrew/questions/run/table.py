"""The results of screws as a table: a row for each, numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files.makers_rules import BY_RULE
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS, kind_of
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.sizing.rules import RULES
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.run.answer import results
from ballscrew.questions.run.compute import Run
from ballscrew.questions.shared.row_tables import Cells, RowTable, of_cells, put

_RESULT = quantities_of(FrictionResult)
_RIGIDITY = quantities_of(BallLoads)["rigidity"]
_OPERATION = ("axial_load", "screw_speed")
#: The results of a run, beside the nut without load.
_OF_RUN = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "back_driving_efficiency",
    "friction_power",
)  # fmt: skip


def of_runs(runs: Mapping[str, Run]) -> RowTable:
    """The results of each screw at its operating point."""
    return of_cells([of_run(name, run) for name, run in runs.items()])


def of_run(name: str, run: Run) -> Cells:
    """The cells of one screw, by heading."""
    cells: Cells = {"name": name, "nut": "" if run.nut is None else kind_of(run.nut.nut)}
    for field in (*_OPERATION, *_OF_RUN):
        put(cells, _RESULT[field], getattr(run.friction, field))
    nut = run.nut
    put(cells, NUT_FIELDS["preload"], None if nut is None else nut.preload)
    put(cells, _RESULT["screw_torque"], None if nut is None else nut.preload_drag, "torque without load")
    found = results(run)
    put(cells, _RESULT["screw_torque"], found.preload_drag_of_balls, "torque without load of balls")
    for name, quantity in BY_RULE.items():
        torque = None if found.rules is None else getattr(found.rules, name)
        put(cells, quantity, torque, f"torque without load by {RULES[name].label}")
    put(cells, _RIGIDITY, None if nut is None else nut.loads.rigidity)
    cells["valid"] = int(run.friction.valid)
    cells["warnings"] = "; ".join(record.text for record in run.warnings)
    return cells
