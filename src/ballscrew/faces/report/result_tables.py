"""The results of a case for its report: tables of torque, parts, contacts and checks."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.engine.uncertainty.bands import OutputBand
from ballscrew.faces.report.blocks import Bar, Block, Bullets, Paragraph, Table, sentence
from ballscrew.faces.report.blocks import value as value_of
from ballscrew.faces.report.numbers import banded
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.friction.result import MECHANISMS, FrictionResult
from ballscrew.physics.sizing.checks import Check
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.check.compute import Checked
from ballscrew.questions.run.compute import Run
from ballscrew.questions.run.text import SHORT, rigidity_rows, stiffness_fields, unloaded_rows
from ballscrew.questions.shared import check_lines

_ONE, _LOADS = quantities_of(FrictionResult), quantities_of(BallLoads)
_CONTACT = quantities_of(RaceState)
_TORQUE = _ONE["screw_torque"]
#: The results of a screw, in this order; a nut has no contact load and entrainment speed of all its balls.
_RESULTS = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "holding_torque", "efficiency",
    "back_driving_efficiency", "friction_coefficient", "friction_angle", "friction_power", "contact_load",
    "entrainment_speed",
)  # fmt: skip
_OF_CONTACT = (
    "contact_load", "semi_major_axis", "semi_minor_axis", "maximum_pressure", "minimum_film_thickness",
    "film_parameter", "friction_coefficient", "pure_rolling_offset", "spin_parameter", "creep_speed",
    "lateral_slip_speed", "friction_torque",
)  # fmt: skip
#: What only one kind of slip law tells.
_OF_CURVATURE, _OF_SPIN = ("pure_rolling_offset",), ("spin_parameter", "creep_speed", "lateral_slip_speed")
_SHORT: Mapping[str, str] = {
    **SHORT,
    "holding_torque": "torque that holds a load that drives (negative: lowers it)",
}


def results(run: Run, bands: Mapping[str, OutputBand]) -> list[Table]:
    """Torque, efficiency and power with their bands; of a nut how it gives way; and the contacts with screw and nut."""
    known = [name for name in _RESULTS if name in run.quantities]
    if not float(run.friction.axial_load):
        known.remove("holding_torque")  # there is nothing to hold, as the verdict says
    rows = [_with_band(run.friction, name, run.quantities, bands) for name in known]
    stiff, whose = [], "Contacts of each ball"
    if run.nut is not None:
        rows[1:1] = [(label, value_of(torque, _TORQUE), "") for label, torque in unloaded_rows(run.nut)]
        stiff = [_row(run.nut.loads, name, _LOADS) for name in stiffness_fields(run.nut)]
        stiff.append(_row(run.nut, "maximum_pressure", _ONE))
        stiff += rigidity_rows(run.nut.rigidity)
        whose = "Contacts of the most loaded ball"
    tables = [Table("Torque, efficiency and power", ("", "value", "band"), rows)]
    if stiff:
        tables.append(Table("How the nut gives way", ("", "value"), stiff))
    return [*tables, _contacts(whose, run.contacts, run.curvature_alone)]


def _with_band(
    result: Any, name: str, known: Mapping[str, Quantity], bands: Mapping[str, OutputBand]
) -> tuple[str, str, str]:
    """A result, its value, and the band where it has one."""
    words, value = _row(result, name, known)
    if name not in bands:
        return words, value, ""
    said = banded(float(getattr(result, name)), *bands[name].both, known[name])
    return words, said.value, said.interval


def meaning(name: str, quantity: Quantity) -> str:
    """The meaning of a result, short where there is little room."""
    return _SHORT.get(name, quantity.info.meaning)


def _row(result: Any, name: str, known: Mapping[str, Any]) -> tuple[str, str]:
    return meaning(name, known[name]), value_of(float(getattr(result, name)), known[name])


def _contacts(title: str, sides: Mapping[str, Mapping[str, Any]], alone: bool) -> Table:
    left_out = _OF_SPIN if alone else _OF_CURVATURE
    rows = [
        (
            SHORT.get(name, _CONTACT[name].info.meaning),
            *(value_of(float(side[name]), _CONTACT[name]) for side in sides.values()),
        )
        for name in _OF_CONTACT
        if name in sides["screw"] and name not in left_out
    ]
    return Table(title, ("", "screw", "nut"), rows)


def parts(run: Run) -> list[Block]:
    """The parts of the friction torque, the greatest first, as numbers and bars."""
    found = run.friction
    total = float(found.screw_torque)
    values = {name: float(value) for name, value in found.contributions.items()}
    if not math.isfinite(total) or not any(values.values()):
        return [Paragraph("There is no friction torque to take apart: it is zero, or no number, here.")]
    rows = [
        (
            MECHANISMS.get(name, name),
            value_of(value, _TORQUE),
            f"{value / total:.1%}" if total else "–",
            Bar(0.0, max(0.0, min(value / total, 1.0)) if total else 0.0),
        )
        for name, value in sorted(values.items(), key=lambda item: -abs(item[1]))
        if value
    ]
    rows.append(("together", value_of(total, _TORQUE), "100.0%", Bar(0.0, 1.0)))
    return [Table("Parts of the friction torque on the screw", ("", "torque", "share", ""), rows, wide=3)]


# -- the checks -----------------------------------------------------------------------------------


def checks(found: Checked) -> list[Block]:
    """Checks, line by line."""
    return [
        said_of_checks(found.verdict, found),
        check_table("Limits, and how much of each is used", found.checks),
    ]


def said_of_checks(verdict: str, found: Checked) -> Paragraph:
    """The verdict on checks, and on what they rest."""
    said = [verdict]
    if found.case.nut is None:
        said.append("the case has no nut: it is checked as a single nut without preload")
    said += _computed_ratings(found)
    return Paragraph(" ".join(f"{sentence(words)}." for words in said), strong=True)


def check_table(caption: str, found: Sequence[Check]) -> Table:
    """A line for each check."""
    return Table(caption, ("", "value", "limit", "used", "verdict"), [check_row(one) for one in found], (0, 4), 4)


def _computed_ratings(found: Checked) -> list[str]:
    """The ratings that nobody lists and that the checks took from the geometry instead."""
    unlisted = [name for name in ("dynamic", "static") if found.case.listed.get(f"{name}_load_rating") is None]
    if found.computed is None or not unlisted:
        return []
    values = [value_of(getattr(found.computed, name), LISTED[f"{name}_load_rating"]) for name in unlisted]
    ratings = " and ".join(f"{name} {value}" for name, value in zip(unlisted, values, strict=True))
    return [f"load ratings that are not listed are computed from the geometry, by ISO 3408-5 as recalled: {ratings}"]


def check_row(one: Check) -> tuple[str, ...]:
    """A check: value, limit, share of it that is used, verdict."""
    verdict = {True: "passes", False: "FAILS", None: ""}[one.holds]  # the words then say what is missing
    return (
        one.name.replace("_", " "),
        check_lines.shown(one, one.value),
        check_lines.shown(one, one.limit),
        check_lines.used_of(one),
        ": ".join(filter(None, [verdict, one.text])),
    )


# -- words ----------------------------------------------------------------------------------------


def beware(run: Run) -> list[Block]:
    """Limits of validity, assumptions, and neglected effects."""
    valid: Block = (
        Bullets([f"Beware: {_warning(record)}." for record in run.warnings])
        if run.warnings
        else Paragraph("All conditions of the model hold at the operating point.")
    )
    return [valid, Bullets([f"{sentence(line)}." for line in descriptions.assumed(run.case, run.ball_to_ball_force)])]


def _warning(record: Record) -> str:
    """The reason and its text; the loss of the preload is a sentence of its own."""
    return f"{record.name}: {record.text}" if record.id == f"validity.{record.name}" else record.text
