"""The sheet of a run: torque and efficiency, verdicts, the parts of the torque, quadrants, loads, and contacts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ballscrew.basis.output.sheet import (
    Cell,
    Cells,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    columns_of,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import BY_RULE
from ballscrew.cases.case_files.nut_tables import seal_torque_source
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS, kind_of
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import FULL_BATH
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.sizing.rigidity import RECALLED_ACCURACY_FACTORS, AxialRigidity
from ballscrew.physics.sizing.rules import RULES
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.run.answer import results
from ballscrew.questions.run.compute import NutState, Run, beside_rules, contradiction

if TYPE_CHECKING:  # loads xarray
    from ballscrew.engine.uncertainty.bands import OutputBand

#: The first results, in this order; a nut has no contact load and entrainment speed of all its balls.
SHOWN = (
    "screw_torque",
    "nut_torque",
    "ideal_torque",
    "drive_torque",
    "holding_torque",
    "efficiency",
    "back_driving_efficiency",
    "friction_coefficient",
    "friction_angle",
    "friction_power",
    "contact_load",
    "entrainment_speed",
)
_FILM = (
    "contact_load",
    "semi_major_axis",
    "semi_minor_axis",
    "maximum_pressure",
    "minimum_film_thickness",
    "film_parameter",
    "friction_coefficient",
)
_FORCES = (
    "hydrodynamic_rolling_force",
    "sliding_force",
    "traction_limit",
    "tangential_force",
    "curvature_friction_moment",
    "elastic_resistance_moment",
)
#: What is shown of a contact of a row of equal balls beside its film, and of that of the most loaded ball of a nut.
_OF_CURVATURE, _OF_SPIN = ("pure_rolling_offset",), ("spin_parameter", "creep_speed", "lateral_slip_speed")
#: Short labels of results.
_SHORT: Mapping[str, str] = {
    "holding_torque": "torque that holds a load that drives (negative: lowers it)",
    "semi_major_axis": "semi-axis across the rolling direction",
    "semi_minor_axis": "semi-axis along the rolling direction",
    "spin_parameter": "spin parameter E_s",
    "creep_speed": "creep of the race",
    "lateral_slip_speed": "lateral slip",
    "traction_limit": "traction limit",
}
_RESULT, _LOADS, _CONTACT = quantities_of(FrictionResult), quantities_of(BallLoads), quantities_of(RaceState)
_RIGIDITY = quantities_of(AxialRigidity)
_TORQUE = _RESULT["screw_torque"]
#: Those that a full bath of oil changes.
_OF_BATH = ("screw_torque", "nut_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")
#: The results of each screw of a table, beside the nut without load.
_OF_ROW = (
    "axial_load",
    "screw_speed",
    "screw_torque",
    "nut_torque",
    "ideal_torque",
    "drive_torque",
    "efficiency",
    "back_driving_efficiency",
    "friction_power",
)


def sheet(run: Run, bands: Mapping[str, OutputBand] | None = None, heating: Sequence[Record] = ()) -> Sheet:
    """All that people see of a run: results with their bands where they were computed, and what self-heating did."""
    case = run.case
    of_case = [*descriptions.of_weight(case), *descriptions.of_fit(case)]
    return Sheet(
        descriptions.title(case),
        [
            Lines(
                [
                    Line(descriptions.design(case, plain_text=True), "small"),
                    *(Line(text, "small") for text in descriptions.assumptions(case, run.ball_to_ball_force)),
                ],
                detail=True,
            ),
            Lines([Line(record.text) for record in heating]),
            results_table(run, SHOWN, bands or {}),
            verdict_lines(run.verdicts),
            warning_lines(_warnings(run)),
            Lines([Line(text) for text in (descriptions.left_out(case), *of_case) if text]),
            *parts(run),
            _quadrants(run),
            *([] if run.nut is None else [_loads(run.nut), stiffness(run.nut)]),
            _contacts(run),
        ],
    )


def meaning(name: str) -> str:
    """The meaning of a result, short where there is little room."""
    return _SHORT.get(name, _RESULT[name].info.meaning)


def _warnings(run: Run) -> list[Record]:
    """The conditions that fail; that balls skid is left out without load, and where a verdict has it."""
    is_unloaded = not any(flank.load for flank in run.touching)
    is_repeated = is_unloaded or any(record.id == "verdict.skid.at_rest" for record in run.verdicts)
    return [record for record in run.conditions if not (is_repeated and record.id == "validity.skid")]


def results_table(run: Run, names: Sequence[str], bands: Mapping[str, OutputBand] | None = None) -> Table:
    """Results by name, those in a full bath of oil beside starved ones, and the nut without load."""
    names = [name for name in names if name in run.quantities]
    if not float(run.friction.axial_load) and "holding_torque" in names:
        names.remove("holding_torque")  # there is nothing to hold, as the verdict says
    rows: list[list[Cell]] = [
        [
            _SHORT.get(name, run.quantities[name].info.meaning),
            Number(
                float(getattr(run.friction, name)),
                run.quantities[name],
                band=bands[name].both if bands is not None and name in bands else None,
            ),
        ]
        for name in names
    ]
    if run.is_starved:
        flooded = run.friction.in_full_bath
        for name, row in zip(names, rows, strict=True):
            row.append(Number(float(getattr(flooded, name)), run.quantities[name]))
    for label, *torques in unloaded_rows(run):
        rows.append([label, *(Number(torque, _TORQUE) for torque in torques[: 1 + run.is_starved])])
    for name, value in ({} if run.nut is None else run.nut.drag_coefficients).items():
        if math.isfinite(value):
            rows.append([_RESULT[name].info.meaning, Number(value, _RESULT[name])])
    columns = ("", "value", *([FULL_BATH] if run.is_starved else []))
    rows = [[*row, *[""] * (len(columns) - len(row))] for row in rows]
    return Table("results", "Torque and efficiency", columns, rows, rules_contradict(run))


def unloaded_rows(run: Run) -> list[tuple[str, *tuple[float, ...]]]:
    """The drag torque of the nut with seals and other losses, these, and without them, as makers' rules have it.

    Behind those of the nut stand those in a full bath of oil; the rules know no oil.
    """
    nut = run.nut
    if nut is None:
        return []
    losses = [(_of_loss(name, run.case), torque) for name, torque in nut.idle_losses.items() if torque]
    rules = [(rule.label, float(rule.by_rule.torque)) for rule in beside_rules(run.case, nut)]
    lost = [name for name, torque in nut.idle_losses.items() if torque]
    whole = [(drag_label(lost, included=True), nut.preload_drag, nut.flooded_drag), *losses] if lost else []
    more = nut.flooded_drag - nut.preload_drag
    return [*whole, (drag_label(lost, included=False), nut.drag_of_balls, nut.drag_of_balls + more), *rules]


def drag_label(losses: Sequence[str], *, included: bool) -> str:
    """``drag torque without seals``; of a nut with other losses with the names of those that it has."""
    names = [MECHANISMS.get(name, name).replace("_", " ") for name in losses] or ["seals"]
    return f"drag torque {'with' if included else 'without'} {' and '.join(names)}"


def rules_contradict(run: Run) -> list[str]:
    """Factor by which the rules of makers contradict each other; nothing of a nut without preload."""
    rules = beside_rules(run.case, run.nut)
    return [contradiction(rules)] if rules else []


def _of_loss(name: str, case: Case) -> str:
    """A loss, of seals with the table that their torque is from, where it is not the row's own."""
    source = seal_torque_source(case.origins.row, case.screw.nut) if name == "seals" else ""
    return f"of which {MECHANISMS.get(name, name)}" + (f" ({source})" if source else "")


def parts(run: Run) -> list[Table]:
    """The parts of the friction torque, the greatest first, with bars; nothing where there is none to take apart."""
    total = float(run.friction.screw_torque)
    values = {name: float(value) for name, value in run.friction.contributions.items() if float(value)}
    if not values:
        return []
    rows: list[list[Cell]] = [
        [MECHANISMS.get(name, name), Number(value, _TORQUE), Share(value / total if total else math.nan)]
        for name, value in sorted(values.items(), key=lambda item: -abs(item[1]))
    ]
    rows.append(["together", Number(total, _TORQUE), Share(1.0, bar=False)])
    return [Table("parts", "Where the friction torque on the screw comes from", ("", "torque", "share"), rows)]


def _quadrants(run: Run) -> Table:
    """The four quadrants of load and rotation; the signs are those of the first."""
    rows: list[list[Cell]] = []
    for name, quadrant in run.quadrants.items():
        signs = ["+" if sign > 0 else "-" for sign in (quadrant.load_sign, quadrant.speed_sign)]
        efficiency = float(quadrant.efficiency)
        drives = efficiency > 0 or quadrant.load_sign == quadrant.speed_sign or math.isnan(efficiency)
        locks = "locks" if float(run.friction.axial_load) else None
        rows.append(
            [
                name,
                *signs,
                Number(float(quadrant.shaft_torque), _RESULT["drive_torque"]),
                Number(float(quadrant.shaft_power), _RESULT["friction_power"]),
                Number(efficiency, _RESULT["efficiency"]) if drives else locks,
            ]
        )
    headings = ("", "load", "rotation", "torque", "power", "η")
    return Table("quadrants", "The screw, by direction of load and rotation", headings, rows, detail=True)


def _loads(nut: NutState) -> Table:
    """Loads and angles of the balls on both flanks."""
    rows: list[list[Cell]] = []
    for flank, label in ((nut.loaded, "the flank that carries the load"), (nut.relieved, "the other flank")):
        if flank is not None:
            for values, name, what in ((flank.load, "forward_load", "load"), (flank.angle, "forward_angle", "angle")):
                rows.append([f"{what} on {label}", *(Number(value, _LOADS[name]) for value in values)])
    return Table("loads", "Loads of the balls", ("", "least", "mean", "greatest"), rows, detail=True)


def stiffness(nut: NutState) -> Table:
    """Stiffness of the nut at its operating point, its pressure, and its rigidity by ISO 3408-4."""
    pressure = _RESULT["maximum_pressure"]
    rows: list[list[Cell]] = [
        [_LOADS[name].info.meaning, Number(float(getattr(nut.loads, name)), _LOADS[name])]
        for name in stiffness_fields(nut)
    ]
    rows.append([pressure.info.meaning, Number(nut.maximum_pressure, pressure)])
    rows += _by_standard(nut.rigidity)
    notes = [f"rigidity: {text}" for text in nut.rigidity.assumed]
    return Table("stiffness", "Stiffness of the nut", ("", "value"), rows, notes)


def _by_standard(rigidity: AxialRigidity) -> list[list[Cell]]:
    """Rigidities by ISO 3408-4 and the deflection of the drive, what is known of them."""
    known = {name: float(getattr(rigidity, name)) for name in _RIGIDITY}
    rows: list[list[Cell]] = [
        [_RIGIDITY[name].info.meaning, Number(value, _RIGIDITY[name])]
        for name, value in known.items()
        if math.isfinite(value)
    ]
    if rigidity.accuracy_factor is not None or not math.isfinite(rigidity.nut):
        return rows

    def of_nut(factor: float) -> Number:
        return Number(factor * rigidity.nut, _RIGIDITY["nut"])

    most, least = RECALLED_ACCURACY_FACTORS
    corrected: list[list[Cell]] = [
        [f"R_nu,ar, {least:g} of it, the least by accuracy grade (value unchecked)", of_nut(least)],
        [f"R_nu,ar, {most:g} of it, the most by accuracy grade (value unchecked)", of_nut(most)],
    ]
    return [*rows[:3], *corrected, *rows[3:]]


def stiffness_fields(nut: NutState) -> list[str]:
    """The loads that describe stiffness, and those of the preload where there is one."""
    return ["deflection", "rigidity", *(["remaining_preload", "lift_off_load"] if nut.preload else [])]


def _contacts(run: Run) -> Table:
    """The contacts with screw and nut of a ball, of a nut those of the most loaded one."""
    slip = _OF_CURVATURE if run.curvature_alone else _OF_SPIN
    title, forces = ("Contacts", _FORCES) if run.nut is None else ("Contacts of the most loaded ball", ())
    rows: list[list[Cell]] = [
        [
            _SHORT.get(name, _CONTACT[name].info.meaning),
            *(Number(float(side[name]), _CONTACT[name]) for side in run.contacts.values()),
        ]
        for name in (*_FILM, *slip, *forces, "friction_torque")
        if name in run.contacts["screw"]
    ]
    return Table("contacts", title, ("", "screw", "nut"), rows)


# -- the screws of a table ------------------------------------------------------------------------


def of_rows(runs: Mapping[str, Run]) -> Sheet:
    """All that people see of the screws of a table: a row for each, and the conditions that fail."""
    headings = ("", "nut", "preload", "friction torque", "drag torque", "drive torque", "eff.", "eff. back")
    rows = [row for name, run in runs.items() for row in _rows(name, run)]
    failed: dict[str, dict[str, None]] = {}
    for name, run in runs.items():
        for record in run.warnings:
            failed.setdefault(record.name, {})[f"{name}: {record.text}"] = None
    return Sheet(
        f"{len(runs)} screws",
        [
            columns_of("screws", lambda: (cells(name, run) for name, run in runs.items())),
            Table("list", "name", headings, rows),
            starved_line(runs),
            Lines([Line("; ".join(texts), "warning", name) for name, texts in failed.items()]),
        ],
    )


def starved_line(runs: Mapping[str, Run]) -> Lines:
    """The screws of a table that are starved of oil, below which their row in a full bath stands."""
    starved = [name for name, run in runs.items() if run.is_starved]
    text = (
        f"{' and '.join(filter(None, (', '.join(starved[:-1]), *starved[-1:])))}: the first row is with oil this thick "
        f"back in the track too late, as formulas for bearings say, the second {FULL_BATH}; no measurement on a ball "
        "screw decides between them"
    )
    return Lines([Line(text, "warning", "starved")] if starved else [])


def _rows(name: str, run: Run) -> list[list[Cell]]:
    """The row of a screw, and where it is starved another one of what is different in a full bath of oil."""
    nut = run.nut

    def numbers(of: FrictionResult, *fields: str) -> list[Cell]:
        return [Number(float(getattr(of, field)), _RESULT[field]) for field in fields]

    def row(first: Sequence[Cell], of: FrictionResult, drag: Cell) -> list[Cell]:
        powers = numbers(of, "drive_torque", "efficiency", "back_driving_efficiency")
        return [*first, *numbers(of, "screw_torque"), drag, *powers]

    preload = Number(nut.preload, NUT_FIELDS["preload"]) if nut is not None and nut.preload else None
    kind = "–" if nut is None else kind_of(nut.nut)
    drag = None if nut is None else Number(nut.preload_drag, _TORQUE)
    rows = [row([name, kind, preload], run.friction, drag)]
    if run.is_starved:
        flooded = None if nut is None else Number(nut.flooded_drag, _TORQUE)
        rows.append(row([f"  {FULL_BATH}", "", ""], run.friction.in_full_bath, flooded))
    return rows


def cells(name: str, run: Run) -> Cells:
    """The values of one screw in a file, by heading."""
    nut, result = run.nut, results(run)
    values: dict[str, tuple[Any, Any]] = {"name": (name, None), "nut": ("" if nut is None else kind_of(nut.nut), None)}
    values |= {_RESULT[field].name: (getattr(run.friction, field), _RESULT[field]) for field in _OF_ROW}
    values["preload"] = (None if nut is None else nut.preload, NUT_FIELDS["preload"])
    values["torque without load"] = (None if nut is None else nut.preload_drag, _TORQUE)
    values["torque without load of balls"] = (result.preload_drag_of_balls, _TORQUE)
    for name_of_rule, quantity in BY_RULE.items():
        torque = None if result.rules is None else getattr(result.rules, name_of_rule)
        values[f"torque without load by {RULES[name_of_rule].label}"] = (torque, quantity)
    values["rigidity"] = (None if nut is None else nut.loads.rigidity, _LOADS["rigidity"])
    if run.is_starved:
        flooded = run.friction.in_full_bath
        values[f"torque without load {FULL_BATH}"] = (None if nut is None else nut.flooded_drag, _TORQUE)
        values |= {f"{_RESULT[f].name} {FULL_BATH}": (getattr(flooded, f), _RESULT[f]) for f in _OF_BATH}
    values["valid"] = (int(run.friction.valid), None)
    values["warnings"] = ("; ".join(record.text for record in run.warnings), None)
    return values
