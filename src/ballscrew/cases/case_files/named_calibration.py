"""Named calibrations and the rules of makers, of a case.

A calibration is chosen in the file or on the command line, put into the model, and written out. Rules give the torque
of the nut without load and seals; one of them is that of its make.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, either, raise_if_any
from ballscrew.basis.quantities import Info, Quantity, Torque
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.case_schema import name_of_law
from ballscrew.cases.schema.reader import Reader
from ballscrew.evidence.validation.entries import NearRows, near_rows
from ballscrew.physics.friction.calibrations import BY_MAKE, calibrated, calibration, calibration_of_make, calibrations
from ballscrew.physics.friction.model import FrictionModel, coefficients
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.rules import DRAG_RULES, RULES, Rule, Subject, drags, rule_of
from ballscrew.physics.solvers.load_distribution import preload_of

#: Written for a calibration on the command line: the model as it is.
NO_CALIBRATION = "none"
_NUMBER = "boundary_friction_coefficient"
_CHAIN = ("ball_force", "ball_chain")


def with_calibration(tables: Mapping[str, Any], name: str | None) -> Mapping[str, Any]:
    """Tables of a case with another named calibration, or without one; None keeps that of the file."""
    table = tables.get("model", {})
    if name is None or not isinstance(table, dict):
        return tables
    others = {key: value for key, value in table.items() if key != "calibration"}
    return {**tables, "model": others if name == NO_CALIBRATION else {**others, "calibration": name}}


def of_make(reader: Reader, tables: Mapping[str, Any], row: CatalogueRow | None) -> Mapping[str, Any]:
    """Tables with the calibration of the make of the row, where the case leaves the choice to it; else as they are."""
    table = tables.get("model", {})
    if not isinstance(table, dict) or table.get("calibration") != BY_MAKE:
        return tables
    make = "" if row is None else row.make
    result = calibration_of_make(make)
    if result is None and reader.faults:
        return _without_calibration(tables)  # of a screw that is at fault itself
    if result is None:
        known = either(dict.fromkeys(one.maker for one in calibrations().values()))
        remedy = f"take a row of {known}, or the name of a calibration"
        problem = "there is none of this make" if make else "the make of this nut is not given"
        reader.refuse("model.calibration", problem, make, remedy)
        return _without_calibration(tables)
    return {**tables, "model": {**table, "calibration": result.name}}


def _without_calibration(tables: Mapping[str, Any]) -> Mapping[str, Any]:
    return {**tables, "model": {key: value for key, value in tables["model"].items() if key != "calibration"}}


def calibrated_by_table(model: FrictionModel, table: Mapping[str, Any]) -> FrictionModel:
    """The model with the calibration that ``[model]`` names.

    Raises :class:`~ballscrew.basis.errors.InputError` for an unknown name, and where the table sets what it sets.
    """
    friction: Any = table.get("friction")
    name, result = table["calibration"], calibration(table["calibration"])
    twice = [slot for slot in _CHAIN if slot in table]
    if _NUMBER in result.fitted and isinstance(friction, dict) and _NUMBER in friction:
        twice.append(f"friction.{_NUMBER}")
    raise_if_any([Fault(f"model.{field}", "is set by the calibration", name, "leave one out") for field in twice])
    return calibrated(model, result)


def written_out(table: Mapping[str, Any], case: Case) -> dict[str, Any]:
    """The table ``[model]`` with the numbers of the case's calibration in place of its name: a fit may change them."""
    made = {key: value for key, value in table.items() if key != "calibration"}
    if case.origins.calibration is None:
        return made
    for slot in _CHAIN:
        law = getattr(case.model, slot)
        numbers = {name: getattr(law, name) for name in coefficients(law)}
        made[slot] = {"law": name_of_law(slot, law), **numbers} if numbers else name_of_law(slot, law)
    if _NUMBER in case.origins.calibration.fitted:
        friction: Any = case.model.friction
        given: Any = made.get("friction")
        others = given if isinstance(given, dict) else {}
        made["friction"] = {
            "law": name_of_law("friction", friction), **others, _NUMBER: getattr(friction, _NUMBER),
        }  # fmt: skip
    return made


def vendor_rows_like(case: Case) -> NearRows | None:
    """The model against the rows of a vendor most like the nut of a case.

    None without preload, far from all rows, and for another model than the one the ratios were stored for.
    """
    nut, fitted = case.nut, case.origins.calibration
    compared = FrictionModel.reference() if fitted is None else calibrated(FrictionModel.reference(), fitted)
    preloaded = getattr(nut, "preload", 0.0) or getattr(nut, "oversize", 0.0)
    if nut is None or not preloaded or case.origins.fit or case.model != compared:
        return None
    return near_rows(dataclasses.replace(case.screw, nut=nut), None if fitted is None else fitted.name)


def _quantity(rule: Rule) -> Quantity:
    meaning = f"drag torque of the nut without seals by the rule of {rule.label}: {rule.formula} ({rule.range})"
    return Quantity(rule.name, "N m", Info("M_0", meaning))


#: The torque of the nut without load and seals by each rule; what a rule holds for is in its meaning.
BY_RULE = {name: _quantity(RULES[name]) for name in DRAG_RULES}


class OfRule(NamedTuple):
    """Torque that a rule gives for a nut."""

    rule: Rule
    #: Torque of the nut without load and seals, N m.
    torque: Torque
    #: True for the rule of the maker of the nut.
    is_own: bool

    @property
    def text(self) -> str:
        """``0.8654 N m by THK (JIS B 1192)``."""
        torque = units.shown(self.torque, BY_RULE[self.rule.name])
        return f"{torque} by {self.rule.label}"


def subject_of(case: Case) -> Subject:
    """Sizes, load and preload of a case; the pitch circle stands for a nominal diameter that it does not state."""
    screw = case.screw
    nominal = screw.pitch_circle_diameter if case.origins.row is None else case.origins.row.nominal_diameter
    return Subject(
        nominal_diameter=float(nominal),
        pitch_circle_diameter=float(screw.pitch_circle_diameter),
        lead=float(screw.lead),
        axial_load=abs(float(case.operation.axial_load)),
        preload=float(preload_of(screw, screw.nut)),
        oversize_balls=screw.nut.contacts_per_ball > 2,
    )


def make_of(case: Case) -> str:
    """The make of the nut as its row gives it; empty where none is known."""
    return "" if case.origins.row is None else case.origins.row.make


def by_rules(case: Case) -> Sequence[OfRule]:
    """Results of the makers' rules for the nut of a case, that of its own maker first; none without preload."""
    subject = subject_of(case)
    if not subject.preload:
        return ()
    own = rule_of(make_of(case))
    of_rules = [OfRule(RULES[name], torque, RULES[name] is own) for name, torque in drags(subject).items()]
    return sorted(of_rules, key=lambda one: not one.is_own)
