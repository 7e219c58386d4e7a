"""The sheet of the checks of a screw: verdict, sizes, torque, stiffness, ratings and limits; or a row a screw."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.basis import units
from ballscrew.basis.output.sheet import Cell, Cells, Line, Lines, Number, Sheet, Table, columns_of, warning_lines
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import FULL_BATH
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.check.answer import Checked, Rated
from ballscrew.questions.run import sheet as run_sheet
from ballscrew.questions.shared.check_lines import check_table, quantity_of

_RESULT, _LOADS, _SCREW = quantities_of(FrictionResult), quantities_of(BallLoads), quantities_of(BallScrew)
_SIZES = ("pitch_circle_diameter", "lead", "lead_angle", "ball_diameter", "loaded_balls", "contact_angle")
_RESULTS = ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")
#: Ratings further apart than this are not of one criterion: rows that ISO 3408-5 meets are within 0.05.
_OTHER_CRITERION = 0.1
_STATIC_CRITERION = (
    "the static rating that is listed counts: a maker may have another criterion than the dent of 1e-4 of the ball "
    "diameter of ISO 3408-5"
)


def sheet(screw: Checked) -> Sheet:
    """All that people see of the checks of one screw."""
    case = screw.case
    source = "" if case.origins.row is None else f" ({case.origins.row.source})"
    records = [*([] if screw.heating is None else screw.heating.records), *screw.run.verdicts]
    return Sheet(
        f"{screw.name}{source}: {descriptions.title(screw.run.case)}",
        [
            Lines(
                [Line(f"verdict: {screw.verdict}", "verdict"), *(Line(record.text, "verdict") for record in records)]
            ),
            warning_lines(screw.run.conditions),
            _sizes(screw),
            run_sheet.results_table(screw.run, _RESULTS),
            run_sheet.stiffness(screw.nut),
            _ratings(screw),
            check_table(screw.checks),
            Lines([Line("assumed:", "small"), *(Line(f"  {text}", "small") for text in screw.assumed)], detail=True),
        ],
    )


def _sizes(screw: Checked) -> Table:
    rows: list[list[Cell]] = [
        [_SCREW[name].info.meaning, Number(float(getattr(screw.case.screw, name)), _SCREW[name])] for name in _SIZES
    ]
    root = LISTED["root_diameter"]
    rows.append([root.info.meaning, Number(screw.geometry.root_diameter, root)])
    return Table("sizes", "Geometry", ("", "value"), rows)


def _ratings(screw: Checked) -> Table:
    """Ratings as listed and by the geometry, and whether they can be of one criterion."""
    ratings = screw.ratings
    rows: list[list[Cell]] = []
    notes: list[str] = []
    for name in Rated._fields:
        listed, computed = getattr(ratings.listed, name), getattr(ratings.computed, name, None)
        numbers = (None if value is None else Number(value, LISTED[name]) for value in (listed, computed))
        rows.append([LISTED[name].info.meaning, *numbers])
        if name == "static_load_rating" and listed is not None and computed is not None:
            notes += [_STATIC_CRITERION] if abs(computed / listed - 1) > _OTHER_CRITERION else []
    return Table("ratings", "Ratings", ("", "listed", "ISO 3408-5"), rows, notes)


# -- the screws of a table ------------------------------------------------------------------------


def of_rows(screws: Sequence[Checked]) -> Sheet:
    """All that people see of the checks of many screws: a row for each."""
    headings = ("", "load", "torque", "eff.", "eff. back", "rigidity", "life", "verdict")
    holding = sum(screw.holds for screw in screws)
    return Sheet(
        f"{len(screws)} screws; all checks judged and held: {holding}",
        [
            columns_of("screws", lambda: (cells(screw) for screw in screws)),
            Table("list", "name", headings, [row for screw in screws for row in _rows(screw)]),
            run_sheet.starved_line({screw.name: screw.run for screw in screws}),
        ],
    )


def _rows(screw: Checked) -> list[list[Cell]]:
    """The row of a screw, and where it is starved another one of what is different in a full bath of oil."""
    result = screw.run.friction

    def numbers(of: FrictionResult) -> list[Cell]:
        names = ("screw_torque", "efficiency", "back_driving_efficiency")
        return [Number(float(getattr(of, name)), _RESULT[name]) for name in names]

    # at the same speed as all others: the revolutions would say no more
    life = screw.check("running_time")
    rows: list[list[Cell]] = [
        [
            screw.name,
            Number(float(result.axial_load), LISTED["dynamic_load_rating"]),
            *numbers(result),
            Number(float(screw.nut.loads.rigidity), _LOADS["rigidity"]),
            None if life.value is None else Number(life.value, quantity_of(life)),
            screw.verdict,
        ]
    ]
    if screw.run.is_starved:
        rows.append([f"  {FULL_BATH}", "", *numbers(result.in_full_bath), "", "", ""])
    return rows


def cells(screw: Checked) -> Cells:
    """The values of one screw in a file, by heading; of a check its value, and the share of the limit that is used."""
    ratings = screw.ratings
    values = dict(run_sheet.cells(screw.name, screw.run))
    for name in Rated._fields:
        quantity, of_geometry = LISTED[name], getattr(ratings.computed, name, None)
        values[quantity.name] = (getattr(ratings.listed, name), quantity)
        values[f"{name} by geometry"] = (of_geometry, quantity)
    for check in screw.checks:
        values[quantity_of(check).name] = (check.value, quantity_of(check))
        values[f"{check.name.replace('_', ' ')} used"] = (check.utilisation, None)
    return {**values, "verdict": (screw.verdict, None)}


def unlisted_ratings(screw: Checked) -> str:
    """The ratings that the checks took from the geometry, as nobody lists them; nothing where all are listed."""
    names = [name for name in Rated._fields if screw.case.origins.listed.get(name) is None]
    if screw.computed is None or not names:
        return ""
    computed = screw.ratings.computed
    values = [f"{name.split('_')[0]} {units.shown(getattr(computed, name), LISTED[name])}" for name in names]
    return (
        "load ratings that are not listed are computed from the geometry, by ISO 3408-5 as recalled: "
        + " and ".join(values)
    )
