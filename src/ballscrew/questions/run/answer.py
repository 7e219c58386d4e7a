"""The results of a run, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

from ballscrew.basis.quantities import Info, Ratio, Torque, fields_of, quantities_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import vendor_rows_like
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.result import FrictionResult, Quadrant
from ballscrew.questions.run.compute import OF_ONE_BALL, Run
from ballscrew.questions.shared.declared import LEFT_OUT, table_of

_OF_CONTACT = quantities_of(RaceState)
#: The numbers and truth values of a result, without the inputs among them.
_OF_RUN = {name: one for name, one in quantities_of(FrictionResult).items() if name not in fields_of(OperatingState)}
#: Those that are true or false.
_MASKS = ("valid", "self_locking")
_NUMBERS = {name: quantity for name, quantity in _OF_RUN.items() if name not in _MASKS}


class Contact(table_of(_OF_CONTACT, at_times=_OF_CONTACT)):
    """One contact of a ball with its race."""


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class RunResults(table_of(_NUMBERS, at_times=OF_ONE_BALL)):
    """Results of one row of equal balls, or of a whole nut."""

    valid: Annotated[bool, _OF_RUN["valid"].info]
    self_locking: Annotated[bool, _OF_RUN["self_locking"].info]
    preload_drag: Annotated[
        Torque | None, Info("M_0", "torque of the nut without load, seals and other losses included"), LEFT_OUT
    ]
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
    found, nut = run.friction, run.nut
    numbers = {name: getattr(found, name) if name in run.quantities else None for name in _OF_RUN}
    if nut is not None:
        numbers |= nut.drag_coefficients
    contacts = {side: Contact(**(dict.fromkeys(_OF_CONTACT) | dict(own))) for side, own in run.contacts.items()}
    return RunResults(
        **numbers,
        preload_drag=None if nut is None else nut.preload_drag,
        contributions=found.contributions,
        quadrants=run.quadrants,
        validity=found.validity,
        **contacts,
    )


class VendorRows(NamedTuple):
    """Model over vendor for the rows most like the nut, without load."""

    #: The table of the vendor.
    set: str
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
    calibration = None if case.calibration is None else case.calibration.name
    return VendorRows(near.data, calibration, near.mean, near.scatter, near.rows)
