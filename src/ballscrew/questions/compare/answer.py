"""Designs side by side, with their sheet; and the answer to a comparison, of them or of the models of one case."""

from __future__ import annotations

import copy
import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.output.sheet import Bar, Bars, Cell, Line, Lines, Number, Share, Sheet, Table, columns_of, lines
from ballscrew.basis.quantities import quantities_of
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import case_file, descriptions, project
from ballscrew.engine.evaluation.comparison import Comparison
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.check.answer import Checked, checked, list_document, with_nut_named
from ballscrew.questions.check.sheet import cells
from ballscrew.questions.compare import CompareOptions
from ballscrew.questions.compare.compute import comparison, document
from ballscrew.questions.compare.sheet import sheet
from ballscrew.questions.shared.charts import colour_of
from ballscrew.questions.shared.question import Answer, Done, Request, Work


@dataclasses.dataclass(frozen=True, eq=False)
class SideBySide:
    """Designs with what the model and all checks say of them, in the order that they were given."""

    designs: Sequence[Checked]
    #: Whether each stands at its own load and speed, and not at those of the first one.
    own: bool


def is_one_case(paths: Sequence[Path]) -> bool:
    """Test whether there is nothing to stand beside: one path of one design. Raises ``InputError``."""
    return len(paths) == 1 and len(project.read(paths[0])) == 1


def side_by_side(
    paths: Sequence[str | Path],
    *,
    own: bool = False,
    settings: Sequence[str] = (),
    model: str | None = None,
    calibration: str | None = None,
    allow_code: bool = False,
) -> SideBySide:
    """The designs of case files and projects, at the load and speed of the first one, or each at its own.

    A design is called as its project calls it, or as its file. Raises :class:`~ballscrew.basis.errors.InputError` with
    the name of the design that is at fault.
    """
    values = [(design, Path(path).parent) for path in paths for design in project.read(path)]
    names = [design.name for design, _ in values]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InputError(Fault("compare", "two designs of one name", twice, "name the files, or the designs, apart"))
    tables = [case_file.override(copy.deepcopy(dict(design.tables)), settings) for design, _ in values]
    operation = tables[0].get("operation")
    checks: list[Checked] = []
    for (design, folder), each in zip(values, tables, strict=True):
        at = each if own or operation is None else {**each, "operation": operation}
        checks.append(_checked(design.name, at, folder, model, calibration, allow_code))
    return SideBySide(checks, own)


def _checked(
    name: str, tables: dict[str, Any], folder: Path, model: str | None, calibration: str | None, allow_code: bool
) -> Checked:
    try:
        made, notes = with_nut_named(tables, folder)
        case = case_file.build(made, model, folder, calibration=calibration, allow_code=allow_code)
        return checked(name, case, notes)
    except InputError as error:
        faults = [dataclasses.replace(fault, where=f"{name}: {fault.where}") for fault in error.faults]
        raise InputError(*faults) from None


#: Results whose change against the first design is stated.
COMPARED = ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")


def document_of_designs(result: SideBySide) -> dict[str, Any]:
    """All designs in SI, each as ``ballscrew check --json`` has it; a change is a share of the value of the first."""
    first = result.designs[0]
    return {
        "at": "own" if result.own else "first",
        "designs": [
            {**whole, "change": {name: change_of(name, one, first) for name in COMPARED}}
            for whole, one in zip(list_document(result.designs), result.designs, strict=True)
        ],
        "provenance": {"version": __version__},
    }


def change_of(name: str, one: Checked, first: Checked) -> float | None:
    """The change of a result against that of the first design; None where their signs make it meaningless."""
    value, start = (float(getattr(each.run.friction, name)) for each in (one, first))
    return value / start - 1 if value > 0 and start > 0 else None


_RESULT = quantities_of(FrictionResult)
_HEADINGS = {
    "screw_torque": "torque",
    "drive_torque": "drive torque",
    "efficiency": "eff.",
    "back_driving_efficiency": "eff. back",
    "friction_power": "heat",
}


def sheet_of_designs(designs: SideBySide) -> Sheet:
    """All that people see of designs side by side."""
    first = designs.designs[0]
    if designs.own:
        at = [f"{design.name}: {descriptions.operating_point(design.case)}" for design in designs.designs]
    else:
        at = [f"all at {descriptions.operating_point(first.case)}; --own takes each at its own load and speed"]
    warnings = [
        Line(f"{design.name}: {record.text}", "warning", record.name)
        for design in designs.designs
        for record in design.run.warnings
    ]
    parts = {design.name: design.run.friction.contributions for design in designs.designs}
    return Sheet(
        f"{len(designs.designs)} designs side by side",
        [
            lines(at),
            Lines([Line(f"{design.name}: checks {design.verdict}", "verdict") for design in designs.designs]),
            _results(designs.designs, first),
            Lines(warnings),
            bars(parts, {}),
            columns_of("screws", lambda: (cells(design) for design in designs.designs)),
        ],
    )


def _results(designs: Sequence[Checked], first: Checked) -> Table:
    """Each result with its change against the first design."""
    rows: list[list[Cell]] = []
    for design in designs:
        cells: list[Cell] = [design.name]
        for name in COMPARED:
            change = None if design is first else change_of(name, design, first)
            cells.append(Number(float(getattr(design.run.friction, name)), _RESULT[name]))
            cells.append("" if change is None else Share(change, bar=False, is_change=True))
        rows.append(cells)
    columns = ["", *(heading for name in COMPARED for heading in (_HEADINGS[name], ""))]
    return Table("designs", "design", columns, rows, [f"Changes are against {first.name}."])


def bars(parts: Mapping[str, Mapping[str, float]], bands: Mapping[str, tuple[float, float]]) -> Bars:
    """The friction torque of each design by its parts, with the band of its torque where there is one."""
    shown = [
        Bar(
            name,
            [
                (MECHANISMS.get(mechanism, mechanism), float(part), colour_of(mechanism))
                for mechanism, part in of_design.items()
                if math.isfinite(float(part)) and float(part)
            ],
            bands.get(name),
        )
        for name, of_design in parts.items()
    ]
    return Bars("friction torque on the screw", _RESULT["screw_torque"], shown)


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options = request.options(CompareOptions)
    paths = request.files["cases"]
    is_one = not paths or is_one_case(paths)
    if is_one and options.own:
        raise InputError(Fault("--own", "is for several designs", "", "name several case files, or a project"))
    if not is_one and options.self_heating:
        raise InputError(Fault("--self-heating", "is for one case", "", "compare one design alone"))
    return _models(request, options) if is_one else _designs(request, options)


def _models(request: Request, options: CompareOptions) -> Work:
    """The comparison of models and laws on one case."""
    case = request.load()

    def size(compared: Comparison) -> str:
        return f"{len(compared.rows)} models and laws"

    def answer(done: Done) -> Answer:
        if not options.self_heating:
            compared = comparison(case, done)
            return Answer(sheet(case, compared), lambda: document(case, compared), size(compared))
        from ballscrew.questions.warm_up.self_heating import self_heating  # its solvers are slow to import

        heating = self_heating(case)
        warm = comparison(heating.warm, done)
        return Answer(
            sheet(heating.warm, warm, heating.records),
            lambda: heating.within(document(heating.warm, warm)),
            size(warm),
        )

    return Work(answer)


def _designs(request: Request, options: CompareOptions) -> Work:
    """The comparison of several designs."""

    def answer(_: object) -> Answer:
        designs = side_by_side(request.files["cases"], own=options.own, **vars(request.case_options))
        return Answer(
            sheet_of_designs(designs), lambda: document_of_designs(designs), f"{len(designs.designs)} designs"
        )

    return Work(answer)
