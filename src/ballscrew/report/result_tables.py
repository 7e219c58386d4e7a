"""The results of a case for its report: tables of torque, parts, contacts, band and checks."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.cases import case_file, descriptions
from ballscrew.components.contact import RaceState
from ballscrew.evaluation.outputs import known_outputs
from ballscrew.friction.result import MECHANISMS, FrictionResult
from ballscrew.quantities import quantities_of
from ballscrew.records import Record
from ballscrew.report.blocks import Bar, Block, Bullets, Paragraph, Table, sentence
from ballscrew.report.blocks import value as value_of
from ballscrew.screw_tables.nut_kinds import LISTED
from ballscrew.sizing.checks import Check
from ballscrew.solvers.load_distribution import BallLoads
from ballscrew.studies.band import BandReport
from ballscrew.studies.check import Checked
from ballscrew.studies.run import Run
from ballscrew.text import band
from ballscrew.text import check as check_text
from ballscrew.text.run import SHORT, rigidity_rows, stiffness_fields
from ballscrew.uncertainty.bands import Interval

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


def results(run: Run) -> list[Table]:
    """Torque, efficiency and power; of a nut how it gives way; and the contacts with screw and nut."""
    rows = [_row(run.friction, name, run.quantities) for name in _RESULTS if name in run.quantities]
    stiff, whose = [], "Contacts of each ball"
    if run.nut is not None:
        rows.insert(1, ("torque without load", value_of(run.nut.preload_drag, _TORQUE)))
        stiff = [_row(run.nut.loads, name, _LOADS) for name in stiffness_fields(run.nut)]
        stiff.append(_row(run.nut, "maximum_pressure", _ONE))
        stiff += rigidity_rows(run.nut.rigidity)
        whose = "Contacts of the most loaded ball"
    tables = [Table("Torque, efficiency and power", ("", "value"), rows)]
    if stiff:
        tables.append(Table("How the nut gives way", ("", "value"), stiff))
    return [*tables, _contacts(whose, run.contacts, run.curvature_alone)]


def _row(result: Any, name: str, known: Mapping[str, Any]) -> tuple[str, str]:
    words: str = _SHORT.get(name, known[name].info.meaning)
    return words, value_of(float(getattr(result, name)), known[name])


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


# -- the band -------------------------------------------------------------------------------------


def band_blocks(case: case_file.Case, report: BandReport) -> list[Block]:
    """Band of the results, its causes, and the uncertain inputs."""
    summary = [
        Paragraph(
            f"{'. '.join(map(sentence, (verdict.text for verdict in band.verdicts(case, report))))}.", strong=True
        )
    ]
    torque = report.band["screw_torque"]
    if not math.isfinite(torque.median) or torque.both == (0.0, 0.0):
        return [*summary]
    warnings = band.warnings(report)
    warned = [Bullets([f"Beware: {one.text}." for one in warnings])] if warnings else []
    laws = band.exchanged_laws(case, report)
    exchanged = [Paragraph(f"{': '.join(filter(None, [sentence(laws.heading), '; '.join(laws.entries)]))}.")]
    inputs: list[Block] = [Paragraph(f"{band.input_counts(report)}.")]
    for heading, entries in band.uncertain_inputs(report):
        inputs += [Paragraph(f"{sentence(heading)}:"), Bullets(entries)]
    return [*summary, _causes(report), _followers(case, report), *warned, *exchanged * bool(laws.heading), *inputs]


def _causes(report: BandReport) -> Table:
    torque = report.band["screw_torque"]
    intervals = band.intervals(torque)
    share = torque.share_of_parameters
    shares = ["", *(f"{part:.0%}" if math.isfinite(part) else "–" for part in (share, 1 - share))]
    ends = [end for interval in intervals for end in interval if math.isfinite(end)]
    rows = [
        (words, *(value_of(end, _TORQUE) for end in interval), part, _bar(interval, torque.value, ends))
        for words, interval, part in zip(band.CAUSES, intervals, shares, strict=True)
    ]
    level = f"{100 * report.band.level:.4g} %"
    return Table(
        f"Friction torque on the screw: {level} of the samples, and the share of its variance",
        ("because of", "from", "to", "share", ""),
        rows,
        wide=4,
        note="Bars: from and to on one axis; the stroke is the value of the case.",
    )


def _bar(interval: Interval, value: float, ends: Sequence[float]) -> Bar | str:
    if not ends or not all(map(math.isfinite, (*interval, value))):
        return ""
    low, high = min(*ends, value), max(*ends, value)
    if high == low:
        return ""
    places = [(x - low) / (high - low) for x in (*interval, value)]
    return Bar(*places)


def _followers(case: case_file.Case, report: BandReport) -> Table:
    known = known_outputs(case.screw.nut)
    rows: list[tuple[str, ...]] = []
    for name in band.SHOWN:
        quantity, one = known[name].quantity, report.band[name]
        numbers = (one.value, one.median, *one.both)
        rows.append((_SHORT.get(name, quantity.info.meaning), *(value_of(x, quantity) for x in numbers)))
    return Table("What follows from it", ("", "case", "median", "from", "to"), rows)


# -- the checks -----------------------------------------------------------------------------------


def checks(found: Checked) -> list[Block]:
    """Checks, line by line."""
    without_nut = found.case.nut is None
    said = [found.verdict]
    if without_nut:
        said.append("the case has no nut: it is checked as a single nut without preload")
    said += _computed_ratings(found)
    return [
        Paragraph(" ".join(f"{sentence(words)}." for words in said), strong=True),
        Table(
            "Limits, and how much of each is used",
            ("", "value", "limit", "used", "verdict"),
            [check_row(one) for one in found.checks],
            (0, 4),
            4,
        ),
    ]


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
        check_text.shown(one, one.value),
        check_text.shown(one, one.limit),
        "–" if one.utilisation is None else f"{one.utilisation:.1%}",
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


def headline(run: Run) -> str:
    """The answer in a sentence or two."""
    found = run.friction
    torque, efficiency = float(found.screw_torque), float(found.efficiency)
    power = value_of(float(found.friction_power), _ONE["friction_power"])
    if not math.isfinite(torque):
        return "No friction torque came out: it is no number here."
    words = [f"Friction torque on the screw {value_of(torque, _TORQUE)}"]
    if math.isfinite(efficiency):
        words.append(f"efficiency {efficiency:.1%}")
    elif float(found.axial_load) != 0:
        words.append(f"efficiency, the load drives the screw, {float(found.back_driving_efficiency):.1%}")
    words.append(f"power lost {power}")
    outside = "" if found.valid else " (outside the model's validity)"
    return f"{', '.join(words)}{outside}."
