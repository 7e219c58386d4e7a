"""Candidates: a row of a catalogue with a nut, a preload and an oil, judged by the full model and all checks."""

from __future__ import annotations

import dataclasses
import itertools
import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew import units
from ballscrew.axis_studies.duty import DutyReport, duty
from ballscrew.cases import case_file
from ballscrew.cases.case import Case
from ballscrew.quantities import Force, Length, fields_of
from ballscrew.screw_tables.catalogue import assumed, case_text
from ballscrew.selection import requirement_checks
from ballscrew.selection.need import Need
from ballscrew.selection.objectives import USUAL_LENGTH, reflected_mass, shaft_inertia, shaft_length
from ballscrew.selection.requirements import Requirements
from ballscrew.sizing.catalogue import CatalogueRow
from ballscrew.sizing.checks import Check
from ballscrew.sizing.installation import Installation
from ballscrew.sizing.listed_nut import NUTS, PRELOADED, lists_preload
from ballscrew.studies.check import Checked, checked
from ballscrew.studies.every_row import copied
from ballscrew.studies.own_screws import tables_of_row
from ballscrew.thermal.network import nut_length

#: Preloads where neither need nor row says one: the ends of what vendors give (Rexroth2006: 2 to 10 %), and between.
USUAL_PRELOADS = ("2 %", "5 %", "10 %")
#: How a length is made of a stroke.
LENGTH_OF_STROKE = "the stroke and a nut of its loaded turns and two leads; add what lies between it and the bearings"
_FEED = fields_of(Requirements)["feed"]
_DENSITY = Installation.__dataclass_fields__["shaft_density"].default


@dataclasses.dataclass(frozen=True)
class Variant:
    """What is chosen: a row, a kind of nut, a preload as it is written, and the table of an oil."""

    row: CatalogueRow
    nut: str
    #: Empty without preload, and for that which the row lists.
    preload: str
    oil: Mapping[str, Any]
    file: Path | None = None

    @property
    def oil_name(self) -> str:
        """The oil as it is called; ``own`` where its numbers are given."""
        return str(self.oil.get("oil") or self.oil.get("grade") or "own")

    @property
    def label(self) -> str:
        """Row, nut, preload and oil: unique in a selection."""
        preload = self.preload or ("preload as listed" if lists_preload(self.row) and self.nut in PRELOADED else "")
        return ", ".join(filter(None, [self.row.name, self.nut, preload, self.oil_name]))


@dataclasses.dataclass(frozen=True, eq=False)
class Candidate:
    """A variant with what the full model and all checks say of it."""

    variant: Variant
    #: The run at the operating point, of a motion that of steady travel, with its own checks.
    checked: Checked
    #: The cycle, where the need has a motion; its checks then count.
    duty: DutyReport | None
    #: All checks: those of ``ballscrew check`` or ``ballscrew duty``, then those of the need.
    checks: Sequence[Check]
    #: The numbers compared, by the names of :data:`~ballscrew.selection.objectives.OBJECTIVES`, in SI.
    objectives: Mapping[str, float]

    @property
    def name(self) -> str:
        """The name of the row."""
        return self.variant.row.name

    @property
    def holds(self) -> bool:
        """Whether all checks were judged and hold."""
        return all(check.holds for check in self.checks)

    @property
    def fits(self) -> bool:
        """Whether no check fails; one that could not be judged does not."""
        return not self.failed

    @property
    def valid(self) -> bool:
        """Whether the point lies within the validity of the model."""
        return bool(self.checked.run.friction.valid)

    @property
    def preload_lost_above(self) -> Force | None:
        """The load above which the nut has no preload left, N; None where no load of the need reaches it."""
        nut = self.checked.nut
        limit = float(nut.loads.lift_off_load)
        in_cycle = self.duty is not None and nut.preload > 0 and self.duty.largest_load >= limit
        return limit if nut.preload_is_lost or in_cycle else None

    @property
    def failed(self) -> Sequence[Check]:
        """The checks that fail."""
        return [check for check in self.checks if check.holds is False]

    @property
    def worst(self) -> float:
        """The largest utilisation of all checks; one or less where all hold."""
        if any(check.utilisation is None for check in self.failed):
            return math.inf
        used = [check.utilisation for check in self.checks if check.utilisation is not None]
        return max((value for value in used if not math.isnan(value)), default=0.0)


def variants(need: Need, rows: Sequence[CatalogueRow], file: Path | None) -> Iterator[Variant]:
    """Every row with every kind of nut, preload and oil of a need.

    Without kinds in the need each row has the nut that it lists. A preload is one of the need, or that of the row, or
    one of :data:`USUAL_PRELOADS`; nuts without preload come once.
    """
    for row in rows:
        for nut, oil in itertools.product(need.nuts or [row.nut or "single"], need.oils):
            for preload in _preloads(need, row, nut):
                yield Variant(row, nut, preload, oil, file)


def _preloads(need: Need, row: CatalogueRow, nut: str) -> Sequence[str]:
    if nut not in PRELOADED or "oversize" in need.tables.get("nut", {}):
        return ("",)
    if need.preloads:
        return need.preloads
    return ("",) if lists_preload(row) and nut == row.nut else USUAL_PRELOADS


def assumes_preload(need: Need, variant: Variant) -> bool:
    """Whether the preload of a variant is one of :data:`USUAL_PRELOADS`, as neither need nor row has one."""
    return bool(variant.preload) and not need.preloads


def tables_of(need: Need, variant: Variant) -> dict[str, Any]:
    """The tables of the case of a variant, as a case file has them.

    The screw has elastic bodies of a usual size where the need does not say, as ``ballscrew check`` takes a row.
    """
    tables = copied({"screw": {}, "bodies": {}, **need.tables})
    made = tables_of_row({**tables, "nut": {}}, variant.row, variant.file)
    made["nut"] = _nut(tables.get("nut", {}), variant)
    made["lubricant"] = dict(variant.oil)
    feed = need.requirements.feed
    if feed is not None and isinstance(operation := made.setdefault("operation", {}), dict):
        operation["screw_speed"] = units.written(feed, _FEED)
    if need.length_is_stroke and need.requirements.stroke is not None:
        length = need.requirements.stroke + _nut_length(variant)
        made["installation"] = {**made["installation"], "unsupported_length": f"{length!r} m"}
    return made


def case_tables(need: Need, variant: Variant) -> dict[str, Any]:
    """The case file of a variant as tables, with the numbers of a row of one's own, so that it needs no table.

    A load rating that such a row does not list is computed from these numbers, whole balls in place of parts of turns.
    """
    made = tables_of(need, variant)
    if variant.file is None:
        return made
    own = tomllib.loads(case_text(variant.row))
    preload = (
        {"preload": own["nut"]["preload"]} if lists_preload(variant.row) and variant.nut == variant.row.nut else {}
    )
    kept = {name: value for name, value in made["screw"].items() if name not in ("catalogue", "catalogue_file")}
    made["screw"] = {**own["screw"], **kept}
    made["nut"] = {**preload, **made["nut"]}
    made["bodies"] = {**own["bodies"], **made["bodies"]}
    if "losses" in own:
        made["losses"] = {**own["losses"], **made.get("losses", {})}
    return made


def _nut_length(variant: Variant) -> Length:
    row = variant.row
    return nut_length(row.loaded_turns, row.lead, NUTS[variant.nut].halves if variant.nut in NUTS else 1)


def _nut(table: Mapping[str, Any], variant: Variant) -> dict[str, Any]:
    """The section of the nut, without what other kinds of nuts have."""
    of_others = {name for kind in NUTS.values() for name in fields_of(kind)}
    if variant.nut in NUTS:
        of_others -= set(fields_of(NUTS[variant.nut]))
    kept = {name: value for name, value in table.items() if name not in of_others}
    return {"type": variant.nut, **kept, **({"preload": variant.preload} if variant.preload else {})}


def case_of(need: Need, variant: Variant, *, model: str | None, calibration: str | None, allow_code: bool) -> Case:
    """The case of a variant. Raises :class:`~ballscrew.errors.InputError` with all faults in it."""
    return case_file.build(
        tables_of(need, variant), model, need.folder, {variant.row.name: variant.row},
        calibration=calibration, allow_code=allow_code, moves=need.moves,
    )  # fmt: skip


def judged(need: Need, variant: Variant, case: Case) -> Candidate:
    """A variant with all that is computed of it."""
    row = variant.row
    notes = [text for name, text in assumed(row).items() if name != "loaded_turns"]
    if need.length_is_stroke and case.installation is not None:
        length = units.shown(case.installation.unsupported_length, fields_of(Installation)["unsupported_length"])
        notes.append(f"unsupported length {length}: {LENGTH_OF_STROKE}")
    found = checked(row.name, case, [*need.notes, *notes])
    report = duty(case) if need.moves else None
    prices = need.price_index
    listed = math.nan if row.price_index is None else row.price_index
    numbers = objectives(need, found, report, row.nominal_diameter, prices.get(row.name, listed))
    own = found.checks if report is None else report.checks
    return Candidate(
        variant, found, report, (*own, *requirement_checks.of(need.requirements, found, report, numbers)), numbers
    )


def objectives(
    need: Need, found: Checked, report: DutyReport | None, diameter: float, price_index: float = math.nan
) -> dict[str, float]:
    """The numbers compared, in SI. The shaft is a cylinder of this diameter, 1 m long where no length is known."""
    case, friction = found.case, found.run.friction
    installation = case.installation
    length = shaft_length(need.requirements, installation) or USUAL_LENGTH
    density = _DENSITY if installation is None else installation.shaft_density
    inertia = shaft_inertia(diameter, length, density)
    if report is None:
        time = found.check("running_time").value
        loss, torque = float(friction.friction_power), abs(float(friction.drive_torque))
    else:
        numbers = report.numbers
        time, torque = numbers["life_time"], abs(numbers["torque_peak"])
        loss = numbers["energy_lost"] / numbers["cycle_time"]
    return {
        "loss": loss,
        "inertia": inertia,
        "reflected_mass": reflected_mass(inertia, case.screw.lead),
        "life": math.nan if time is None else float(time),
        "rigidity": float(found.nut.loads.rigidity),
        "drive_torque": torque,
        "preload_torque": float(found.nut.preload_drag),
        "price_index": float(price_index),
    }
