"""The results of a case for its report: tables of torque, parts, contacts, band and checks."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.analyses.checks import Check
from ballscrew.analyses.outputs import known_outputs
from ballscrew.analyses.uncertainty import Interval
from ballscrew.assembly import NutFriction
from ballscrew.components.contact import RaceState
from ballscrew.interfaces import band, check, config, nut_report, report
from ballscrew.interfaces.answer import Answer
from ballscrew.interfaces.nut_report import NutResult
from ballscrew.interfaces.nuts import LISTED
from ballscrew.interfaces.report_blocks import Bar, Block, Bullets, Paragraph, Table, sentence
from ballscrew.interfaces.report_blocks import value as value_of
from ballscrew.quantities import quantities_of
from ballscrew.result import MECHANISMS, FrictionResult
from ballscrew.solvers.load_distribution import BallLoads
from ballscrew.solvers.pure_rolling import curvature_slip

_ONE, _NUT, _LOADS = quantities_of(FrictionResult), quantities_of(NutFriction), quantities_of(BallLoads)
_CONTACT = quantities_of(RaceState)
_TORQUE = _ONE["screw_torque"]
_OF_ONE = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "holding_torque", "efficiency",
    "back_driving_efficiency", "friction_power", "contact_load", "entrainment_speed",
)  # fmt: skip
_OF_NUT = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "holding_torque", "efficiency",
    "back_driving_efficiency", "friction_power",
)  # fmt: skip
_OF_CONTACT = (
    "contact_load", "semi_major_axis", "semi_minor_axis", "maximum_pressure", "minimum_film_thickness",
    "film_parameter", "friction_coefficient", "pure_rolling_offset", "spin_parameter", "creep_speed",
    "lateral_slip_speed", "friction_torque",
)  # fmt: skip
#: What only one kind of slip law tells.
_OF_CURVATURE, _OF_SPIN = ("pure_rolling_offset",), ("spin_parameter", "creep_speed", "lateral_slip_speed")
#: What the band tells besides the friction torque.
_OF_BAND = ("drive_torque", "holding_torque", "efficiency", "back_driving_efficiency", "friction_power")
_CAUSES = ("inputs and laws", "inputs alone", "laws alone")
_SHORT: Mapping[str, str] = {
    **report.SHORT,
    "holding_torque": "torque that holds a load that drives (negative: lowers it)",
}


def results(answer: Answer) -> list[Table]:
    """Torque, efficiency and power; of a nut how it gives way; and the contacts with screw and nut."""
    result = answer.result
    if isinstance(result, NutResult):
        found, loads = result.found, result.found.loads
        rows = [_row(found, name, _NUT) for name in _OF_NUT]
        rows.insert(1, ("torque without load", value_of(result.preload_drag, _TORQUE)))
        sides, whose = nut_report.most_loaded(found), "Contacts of the most loaded ball"
        names = ["deflection", "rigidity", *(["remaining_preload", "lift_off_load"] if result.preload else [])]
        stiff = [_row(loads, name, _LOADS) for name in names]
        stiff.append(_row(found, "maximum_pressure", _NUT))
        alone = found.model.slip is curvature_slip
    else:
        rows, stiff = [_row(result, name, _ONE) for name in _OF_ONE], []
        sides = {
            name: {key: getattr(side, key) for key in _OF_CONTACT}
            for name, side in (("screw", result.screw), ("nut", result.nut))
        }
        whose, alone = "Contacts of each ball", result.slip_is_curvature_alone
    tables = [Table("Torque, efficiency and power", ("", "value"), rows)]
    if stiff:
        tables.append(Table("How the nut gives way", ("", "value"), stiff))
    return [*tables, _contacts(whose, sides, alone)]


def _row(result: Any, name: str, known: Mapping[str, Any]) -> tuple[str, str]:
    words: str = _SHORT.get(name, known[name].info.meaning)
    return words, value_of(float(getattr(result, name)), known[name])


def _contacts(title: str, sides: Mapping[str, Mapping[str, Any]], alone: bool) -> Table:
    left_out = _OF_SPIN if alone else _OF_CURVATURE
    rows = [
        (
            report.SHORT.get(name, _CONTACT[name].info.meaning),
            *(value_of(float(side[name]), _CONTACT[name]) for side in sides.values()),
        )
        for name in _OF_CONTACT
        if name in sides["screw"] and name not in left_out
    ]
    return Table(title, ("", "screw", "nut"), rows)


def parts(answer: Answer) -> list[Block]:
    """The parts of the friction torque, the greatest first, as numbers and bars."""
    found = answer.result.found if isinstance(answer.result, NutResult) else answer.result
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


def band_blocks(case: config.Case, found: band.Found) -> list[Block]:
    """How far off the results may be, because of what, and what was taken as uncertain."""
    said = [Paragraph(f"{'. '.join(map(sentence, band.sentences(case, found)))}.", strong=True)]
    if not math.isfinite(found.band["screw_torque"].median) or found.band["screw_torque"].both == (0.0, 0.0):
        return [*said]
    warned = [Bullets([f"Beware: {line}." for line in band.warnings(found)])] if band.warnings(found) else []
    laws = [line.strip() for line in band.laws_in_words(case, found) if line]
    exchanged = [Paragraph(f"{sentence(laws[0])}{': ' * (len(laws) > 1)}{'; '.join(laws[1:])}.")] if laws else []
    return [*said, _causes(found), _followers(case, found), *warned, *exchanged, *_uncertain(found)]


def _uncertain(found: band.Found) -> list[Block]:
    """What was taken as uncertain, by whose word and why."""
    blocks: list[Block] = [Paragraph(f"{band.assumed_in_words(found)}.")]
    items: list[str] = []
    for line in filter(None, band.inputs_in_words(found)):
        if line.startswith("  "):
            items.append(line.strip())
        else:
            items = []
            blocks += [Paragraph(f"{sentence(line)}:"), Bullets(items)]
    return blocks


def _causes(found: band.Found) -> Table:
    torque = found.band["screw_torque"]
    intervals: Sequence[Interval] = (torque.both, torque.parameters, torque.model_form)
    share = torque.share_of_parameters
    shares = ["", *(f"{part:.0%}" if math.isfinite(part) else "–" for part in (share, 1 - share))]
    ends = [end for interval in intervals for end in interval if math.isfinite(end)]
    rows = [
        (words, *(value_of(end, _TORQUE) for end in interval), part, _bar(interval, torque.value, ends))
        for words, interval, part in zip(_CAUSES, intervals, shares, strict=True)
    ]
    level = f"{100 * found.band.level:.4g} %"
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


def _followers(case: config.Case, found: band.Found) -> Table:
    known = known_outputs(case.parts)
    rows: list[tuple[str, ...]] = []
    for name in _OF_BAND:
        quantity, one = known[name].quantity, found.band[name]
        numbers = (one.value, one.median, *one.both)
        rows.append((_SHORT.get(name, quantity.info.meaning), *(value_of(x, quantity) for x in numbers)))
    return Table("What follows from it", ("", "case", "median", "from", "to"), rows)


# -- the checks -----------------------------------------------------------------------------------


def checks(found: check.Checked) -> list[Block]:
    """Whether the screw does, line by line."""
    without_nut = found.case.parts is None
    said = [found.verdict]
    if without_nut:
        said.append("the case has no nut: it is checked as a single nut without preload")
    said += _computed_ratings(found)
    return [
        Paragraph(" ".join(f"{sentence(words)}." for words in said), strong=True),
        Table(
            "Limits, and how much of each is used",
            ("", "value", "limit", "used", "verdict"),
            [_check(one) for one in found.checks],
            (0, 4),
            4,
        ),
    ]


def _computed_ratings(found: check.Checked) -> list[str]:
    """The ratings that nobody lists and that the checks took from the geometry instead."""
    unlisted = [name for name in ("dynamic", "static") if found.case.listed.get(f"{name}_load_rating") is None]
    if found.computed is None or not unlisted:
        return []
    values = [value_of(getattr(found.computed, name), LISTED[f"{name}_load_rating"]) for name in unlisted]
    ratings = " and ".join(f"{name} {value}" for name, value in zip(unlisted, values, strict=True))
    return [f"load ratings that are not listed are computed from the geometry, by ISO 3408-5 as recalled: {ratings}"]


def _check(one: Check) -> tuple[str, ...]:
    verdict = {True: "passes", False: "FAILS", None: ""}[one.passes]  # the words then say what is missing
    return (
        one.name.replace("_", " "),
        check.shown(one, one.value),
        check.shown(one, one.limit),
        "–" if one.utilisation is None else f"{one.utilisation:.1%}",
        ": ".join(filter(None, [verdict, one.words])),
    )


# -- words ----------------------------------------------------------------------------------------


def beware(answer: Answer) -> list[Block]:
    """Where the result is not to be trusted, what was assumed and what is left out."""
    result = answer.result
    warnings = nut_report.warnings(result) if isinstance(result, NutResult) else result.warnings
    valid: Block = (
        Bullets([f"Beware: {line}." for line in warnings])
        if warnings
        else Paragraph("All conditions of the model hold at the operating point.")
    )
    return [valid, Bullets([f"{sentence(line)}." for line in answer.assumed])]


def headline(answer: Answer) -> str:
    """The answer in a sentence or two."""
    found = answer.result.found if isinstance(answer.result, NutResult) else answer.result
    torque, efficiency = float(found.screw_torque), float(found.efficiency)
    power = value_of(float(found.friction_power), _ONE["friction_power"])
    if not math.isfinite(torque):
        return "No friction torque came out: it is no number here."
    words = [f"Friction torque on the screw {value_of(torque, _TORQUE)}"]
    if float(found.axial_load) > 0:
        words.append(f"efficiency {efficiency:.1%}")
    words.append(f"power lost {power}")
    outside = "" if found.valid else " (outside the model's validity)"
    return f"{', '.join(words)}{outside}."
