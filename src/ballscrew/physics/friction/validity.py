"""Validity of the model: one mask for each condition, and a record for each that fails."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ballscrew.basis.arrays import namespace
from ballscrew.basis.errors import is_concrete
from ballscrew.basis.judgements import Judgement, Sentence, Shown
from ballscrew.basis.quantities import Mask, Ratio, Torque, fields_of, within_bounds
from ballscrew.basis.records import Record
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.laws.contact import Contact, RaceState

#: Y at which the curvature moment (15) changes sign: the root of 1 - 5Y³ + 3Y⁵ in (0, 1).
LARGEST_PURE_ROLLING_OFFSET = 0.643
#: Half-way between the rigid and the elastic asymptote of the rolling force (BibouletHoupert2010).
SMALLEST_ELASTIC_REGIME_PARAMETER = 6.6
#: Materials and oils behind the film regression: G from 2310 to 6785 (HamrockDowson1977), and a
#: little room on both sides, as the exponent 0.49 is smooth.
MATERIAL_PARAMETER_RANGE = (2000.0, 7500.0)

#: Above this pressure balls and races keep a dent of 1e-4 of the ball diameter (ISO76), Pa.
LARGEST_PRESSURE = 4.2e9

#: Share of the dissipated power by which the power of the torque may differ from it.
LARGEST_IMBALANCE = 0.01
#: Below this the heat of the inlet is no longer a correction of the film but its master.
SMALLEST_INLET_FACTOR = 0.5


@dataclasses.dataclass(frozen=True, slots=True)
class Condition:
    """A condition of the model: the quantity it concerns and the text shown where it fails.

    Where it compares one number of each contact with one limit: ``quantity`` (its name there), ``limit`` and ``unit``.
    """

    subject: str
    text: str
    quantity: str = ""
    limit: float | None = None
    unit: str = "1"
    #: The limit is the greatest allowed value, not the least.
    upper: bool = False


CONDITIONS: Mapping[str, Condition] = {
    "inputs": Condition(
        "inputs", "inputs must be finite and within their bounds, the balls must fit, and the torque must be finite"
    ),
    "skid": Condition(
        "friction_coefficient",
        "the sliding force exceeds friction coefficient times load at a contact: the ball skids; "
        "more load or less speed ends it",
    ),
    "pure_rolling_offset": Condition(
        "pure_rolling_offset",
        f"the lines of pure rolling lie outside 0 <= Y < {LARGEST_PURE_ROLLING_OFFSET}, where (15) holds",
    ),
    "radii_ratio": Condition(
        "semi_major_axis",
        "the radii ratio k is outside the range of the Hertz law (k >= 1, and a largest k of each law)",
    ),
    "contact_pressure": Condition(
        "maximum_pressure",
        f"the maximum pressure exceeds {LARGEST_PRESSURE / 1e9:g} GPa: the contact yields (ISO 76)",
        "maximum_pressure",
        LARGEST_PRESSURE,
        "Pa",
        upper=True,
    ),
    "elastic_regime": Condition(
        "minimum_film_thickness",
        f"the load is too light for the film law (M < {SMALLEST_ELASTIC_REGIME_PARAMETER}): "
        "film and friction are estimates; more load or less speed leads back",
        "elastic_regime_parameter",
        SMALLEST_ELASTIC_REGIME_PARAMETER,
    ),
    "inlet_heating": Condition(
        "minimum_film_thickness",
        "the heat of the inlet takes more than half of the film: too fast for its factor to be trusted",
        "inlet_film_factor",
        SMALLEST_INLET_FACTOR,
    ),
    "material_parameter": Condition(
        "minimum_film_thickness",
        "G is outside {:g} to {:g}, the materials and oils behind the film regression (26)".format(
            *MATERIAL_PARAMETER_RANGE
        ),
    ),
    "equilibrium": Condition("equilibrium", "the slip of the ball did not converge"),
}
#: The conditions of a ball, and those of a nut.
NUT_CONDITIONS: Mapping[str, Condition] = {
    **CONDITIONS,
    "load_distribution": Condition("load_distribution", "the loads of the balls did not converge"),
}
#: The texts alone, by reason.
NUT_REASONS: Mapping[str, str] = {reason: condition.text for reason, condition in NUT_CONDITIONS.items()}
REASONS: Mapping[str, str] = {reason: condition.text for reason, condition in CONDITIONS.items()}


def _imbalance(of: Mapping[str, Any]) -> Mapping[str, Any]:
    share = abs(of["power_imbalance"])
    return {
        "said": namespace(share).isfinite(share) & (share > LARGEST_IMBALANCE),
        "value": share,
        "limit": LARGEST_IMBALANCE,
        "percent": 100 * share,
        "is_below_zero": of["nut_torque"] < 0,
    }


_PERCENT = {"percent": Shown("percent", digits=3)}
#: A warning where a model's own torque and losses differ by more than rounding and slow convergence explain.
IMBALANCE = Judgement(
    id="model.power_balance",
    subject="friction_power",
    formula=_imbalance,
    needs=("power_imbalance", "nut_torque"),
    severity="warning",
    holds=False,
    sentences=(
        Sentence(
            "the power of the torque differs by up to {percent}% from what the parts dissipate, and the torque "
            "on the nut falls below zero: the reactions of the model do not balance; the model corrected has "
            "them in balance",
            "is_below_zero",
            _PERCENT,
        ),
        Sentence(
            "the power of the torque differs by up to {percent}% from what the parts dissipate: the reactions "
            "of the model do not balance; the model corrected has them in balance",
            places=_PERCENT,
        ),
    ),
)


def _judgement(reason: str, condition: Condition) -> Judgement:
    """The warning of a condition: said where its mask, the output ``validity_…``, is false."""
    mask = f"validity_{reason}"
    limit = {} if condition.limit is None else {"limit": condition.limit}

    def formula(of: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"said": namespace(of[mask]).logical_not(of[mask]), **limit}

    return Judgement(
        id=f"validity.{reason}",
        subject=condition.subject,
        formula=formula,
        needs=(mask,),
        truths=(mask,),
        severity="warning",
        holds=False,
        unit=condition.unit,
        sentences=(Sentence(condition.text),),
    )


#: The warnings of all conditions.
VALIDITY: tuple[Judgement, ...] = tuple(_judgement(*one) for one in NUT_CONDITIONS.items())


def imbalance_records(power_imbalance: Ratio, nut_torque: Torque) -> list[Record]:
    """:data:`IMBALANCE` of arrays: of the largest imbalance, and the least torque on the nut."""
    shares, torques = (np.asarray(values, dtype=float) for values in (power_imbalance, nut_torque))
    largest = np.max(np.abs(shares), initial=0.0, where=np.isfinite(shares))
    least = np.min(torques, initial=0.0, where=torques < 0)
    result = IMBALANCE.finds({"power_imbalance": largest, "nut_torque": least})
    record = None if result is None else IMBALANCE.record(result, {})
    return [] if record is None else [record]


def warning_records(
    validity: Mapping[str, Mask], contacts: Sequence[Contact], conditions: Mapping[str, Condition] = CONDITIONS
) -> list[Record]:
    """One record for each condition that fails somewhere; its value is the worst of all contacts."""
    return [
        _record(reason, conditions[reason], contacts)
        for reason, mask in validity.items()
        if not namespace(mask).all(mask)
    ]


def _record(reason: str, condition: Condition, contacts: Sequence[Contact]) -> Record:
    """The warning of a condition that fails at one of several points, with its worst value."""
    row = _judgement(reason, condition)
    result = dict(row.finds({f"validity_{reason}": False}) or {})
    if condition.quantity:
        result["value"] = _worst(condition, contacts)
    record = row.record(result, {})
    assert record is not None, "a condition that fails is said"
    return record


def _worst(condition: Condition, contacts: Sequence[Contact]) -> float:
    """The value farthest beyond the limit; NaN where a value is NaN."""
    values = (getattr(contact, condition.quantity) for contact in contacts)
    ends = [float(np.max(value) if condition.upper else np.min(value)) for value in values]
    return float(np.max(ends) if condition.upper else np.min(ends))


def validity_masks(
    parts: Iterable[Any],
    screw: RaceState,
    nut: RaceState,
    converged: Mask,
    rolling_share: Ratio,
    slip_is_curvature_alone: bool,
    drive_torque: Torque,
) -> Mapping[str, Mask]:
    """Masks by reason, in the shape of the torque; NaN fails every condition it enters.

    ``parts`` are the screw, the lubricant, the model and its laws, and the operating point, whose
    arrays are checked here as constructors check numbers.
    """
    xp = namespace(drive_torque)
    everywhere = xp.isfinite(drive_torque) | True
    of_slip = {reason: holds(screw) & holds(nut) for reason, holds in _OF_THE_SLIP.items()}
    on_screw, on_nut = contact_masks(screw), contact_masks(nut)
    of_contacts = {reason: on_screw[reason] & on_nut[reason] for reason in on_screw}
    masks = {"inputs": input_mask(parts, drive_torque), **of_slip, **of_contacts, "equilibrium": converged}
    masks["skid"] = masks["skid"] & (rolling_share == 1)
    if not slip_is_curvature_alone:
        masks["pure_rolling_offset"] = everywhere
    return {reason: masks[reason] & everywhere for reason in REASONS}


def input_mask(parts: Iterable[Any], torque: Torque) -> Mask:
    """Mask: all arrays of the parts are within their bounds, balls fit their screw, and the torque is finite."""
    inputs = namespace(torque).isfinite(torque)
    for part in parts:
        for name, quantity in fields_of(part).items():
            value = getattr(part, name)
            if value is not None and not is_concrete(value):
                inputs = inputs & within_bounds(quantity.info, value)
        if isinstance(part, BallScrew):
            inputs = inputs & part.fits
    return inputs


def contact_masks(contact: Contact) -> dict[str, Mask]:
    """Masks of the conditions that load, geometry and film of a contact must meet, by reason."""
    return {reason: holds(contact) for reason, holds in _OF_A_CONTACT.items()}


def slip_masks(side: RaceState) -> dict[str, Mask]:
    """Masks of the conditions on the slip at a contact, by reason."""
    return {reason: holds(side) for reason, holds in _OF_THE_SLIP.items()}


def no_skid(side: RaceState) -> Mask:
    """Mask: the contact is loaded, and friction carries its sliding force."""
    return (side.contact_load > 0) & (abs(side.sliding_force) <= side.traction_limit)


def _within(value: Ratio, least: float, most: float) -> Mask:
    return (value >= least) & (value <= most)


#: The conditions on the slip at a contact, by reason.
_OF_THE_SLIP: Mapping[str, Callable[[RaceState], Mask]] = {
    "skid": no_skid,
    "pure_rolling_offset": lambda side: (
        (side.pure_rolling_offset >= 0) & (side.pure_rolling_offset < LARGEST_PURE_ROLLING_OFFSET)
    ),
}
#: The conditions on a contact that its slip has no part in, by reason.
_OF_A_CONTACT: Mapping[str, Callable[[Contact], Mask]] = {
    "radii_ratio": lambda contact: _within(contact.radii_ratio, 1.0, contact.hertz.largest_radii_ratio),
    "contact_pressure": lambda contact: contact.maximum_pressure <= LARGEST_PRESSURE,
    "elastic_regime": lambda contact: contact.elastic_regime_parameter >= SMALLEST_ELASTIC_REGIME_PARAMETER,
    "inlet_heating": lambda contact: contact.inlet_film_factor >= SMALLEST_INLET_FACTOR,
    "material_parameter": lambda contact: _within(contact.material_parameter, *MATERIAL_PARAMETER_RANGE),
}
