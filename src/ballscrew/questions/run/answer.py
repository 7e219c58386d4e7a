"""The results of a run, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from ballscrew.basis.quantities import Info, Ratio, Torque, fields_of, quantities_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import BY_RULE, by_rules, vendor_rows_like
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.result import FrictionResult, Quadrant
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.sizing.rules import DRAG_RULES, rule_of
from ballscrew.questions.run.compute import OF_ONE_BALL, Run, nut_loads
from ballscrew.questions.shared.declared import LEFT_OUT, OneOf, envelope, table_of

_OF_CONTACT = quantities_of(RaceState)
#: The numbers and truth values of a result, without the inputs among them.
_OF_RUN = {name: one for name, one in quantities_of(FrictionResult).items() if name not in fields_of(OperatingState)}
#: Those that are true or false.
_MASKS = ("valid", "self_locking")
_NUMBERS = {name: quantity for name, quantity in _OF_RUN.items() if name not in _MASKS}


class MakersRules(table_of(BY_RULE)):
    """Torque of the preloaded nut without load and seals by the rules of makers."""


class Contact(table_of(_OF_CONTACT, at_times=_OF_CONTACT)):
    """One contact of a ball with its race."""


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class RunResults(table_of(_NUMBERS, at_times=OF_ONE_BALL)):
    """Results of one row of equal balls, or of a whole nut."""

    valid: Annotated[bool, _OF_RUN["valid"].info]
    self_locking: Annotated[bool, _OF_RUN["self_locking"].info]
    preload_drag: Annotated[
        Torque | None,
        Info("M_0", "drag torque of the nut: without axial load, seals and other losses included"),
        LEFT_OUT,
    ]
    preload_drag_of_balls: Annotated[
        Torque | None,
        Info("M_0", "drag torque of the preloaded nut without seals and other losses"),
        LEFT_OUT,
    ]
    #: The same by the rules of makers, which know neither oil nor speed; of a preloaded nut.
    rules: Annotated[MakersRules | None, LEFT_OUT]
    #: The rule of the maker of the nut; where its row has a make with a rule.
    rule_of_make: Annotated[str | None, OneOf(DRAG_RULES), LEFT_OUT]
    #: Parts of the friction torque.
    contributions: Mapping[str, Torque]
    #: The four combinations of load and rotation, by name.
    quadrants: Mapping[str, Quadrant]
    #: The conditions of the model by reason, true where they hold.
    validity: Mapping[str, bool]
    #: The contact of the most loaded ball with the screw.
    screw: Contact
    #: The contact of the most loaded ball with the nut.
    nut: Contact


def results(run: Run) -> RunResults:
    """The results of a run."""
    result, nut, by_rule = run.friction, run.nut, by_rules(run.case)
    numbers = {name: getattr(result, name) if name in run.quantities else None for name in _OF_RUN}
    if nut is not None:
        numbers |= nut.drag_coefficients
    contacts = {side: Contact(**(dict.fromkeys(_OF_CONTACT) | dict(own))) for side, own in run.contacts.items()}
    return RunResults(
        **numbers,
        preload_drag=None if nut is None else nut.preload_drag,
        preload_drag_of_balls=nut.drag_of_balls if nut is not None and nut.preload else None,
        rules=MakersRules(**{one.rule.name: one.torque for one in by_rule}) if by_rule else None,
        rule_of_make=next((one.rule.name for one in by_rule if one.is_own), None),
        contributions=result.contributions,
        quadrants=run.quadrants,
        validity=result.validity,
        **contacts,
    )


class VendorRows(NamedTuple):
    """Model over vendor for the rows most like the nut, without load."""

    #: The table of the vendor.
    set: str
    #: The maker whose rows they are; the set where it names none.
    maker: str
    #: The calibration of the model; null without one.
    calibration: str | None
    mean_ratio: Annotated[Ratio, Info("", "mean of model over vendor")]
    std_ratio: Annotated[Ratio, Info("", "standard deviation of model over vendor")]
    #: The rows.
    rows: Sequence[str]


def vendor_rows(case: Case) -> VendorRows | None:
    """The rows of a vendor most like the nut of a case; None where there are none."""
    near = vendor_rows_like(case)
    if near is None:
        return None
    calibration = None if case.origins.calibration is None else case.origins.calibration.name
    maker = rule_of(near.data)
    return VendorRows(
        near.data, near.data if maker is None else maker.maker, calibration, near.mean, near.scatter, near.rows
    )


def document(run: Run) -> dict[str, Any]:
    """The document of a run; with a nut it has the loads of the balls, too."""
    return envelope(run.case, results(run), beside=beside(run), warnings=run.warnings, verdicts=run.verdicts)


def beside(run: Run) -> dict[str, Any]:
    """The loads of the balls of a nut, and the rows of a vendor that are like it."""
    loads = None if run.nut is None else nut_loads(run.nut)
    answers = {"loads": loads, "vendor_rows": vendor_rows(run.case)}
    return {name: answer for name, answer in answers.items() if answer is not None}


def list_document(runs: Mapping[str, Run]) -> list[dict[str, Any]]:
    """The documents of the screws of a table with their names, without the loads ball by ball."""
    listed: list[dict[str, Any]] = [{"name": name, **document(run)} for name, run in runs.items()]
    for each in listed:
        if "loads" in each:
            del each["loads"]["balls"], each["units"]["loads"]["balls"]
    return listed
