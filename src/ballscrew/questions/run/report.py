"""The results of a case for its report: tables of torque, parts and contacts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.engine.uncertainty.bands import OutputBand
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.friction.result import MECHANISMS, FrictionResult
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.run.compute import Run
from ballscrew.questions.run.text import SHORT, rigidity_rows, rules_contradict, stiffness_fields, unloaded_rows
from ballscrew.questions.shared.report_blocks import Bar, Block, Bullets, Paragraph, Table, sentence
from ballscrew.questions.shared.report_blocks import value as value_of
from ballscrew.questions.shared.report_numbers import banded

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
        rows[1:1] = [(label, value_of(torque, _TORQUE), "") for label, torque in unloaded_rows(run)]
        stiff = [_row(run.nut.loads, name, _LOADS) for name in stiffness_fields(run.nut)]
        stiff.append(_row(run.nut, "maximum_pressure", _ONE))
        stiff += rigidity_rows(run.nut.rigidity)
        whose = "Contacts of the most loaded ball"
    note = ". ".join(map(sentence, rules_contradict(run)))
    tables = [Table("Torque, efficiency and power", ("", "value", "band"), rows, note=note and f"{note}.")]
    if stiff:
        tables.append(Table("Stiffness of the nut", ("", "value"), stiff))
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
