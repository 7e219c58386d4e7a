"""Validity of the model: one mask for each condition, and a record for each that fails.

Starvation: oil that flows back into the track too late, and the torque of the same screw in a full bath of oil.

One rule for all answers. Which of the two torques a ball screw has is not measured: the factor that starves is one of
bearings (:func:`~ballscrew.physics.equations.rolling.replenishment_factor`), and in the cold it may make friction fall
that would rise with a full track, and at last be that of contacts without a film. A supply that is known to be short
(``inlet_film_ratio``) is left as it is given.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import as_array, namespace
from ballscrew.basis.errors import is_concrete
from ballscrew.basis.quantities import Mask, Quantity, Ratio, Torque, fields_of, within_bounds
from ballscrew.basis.records import Judgement, Record, Sentence, Shown
from ballscrew.basis.usual_ranges import unusual
from ballscrew.physics.components.oil_grades import SHEET_TEMPERATURE, DataSheet
from ballscrew.physics.components.screw import MATERIALS, BallScrew, odd_preload
from ballscrew.physics.equations import rolling
from ballscrew.physics.laws.contact import Contact, RaceState

#: Constant of replenishment of a track with grease (SKF2018).
GREASE_REPLENISHMENT = 6e-8
#: Without a pour point or a range on the sheet, temperatures as far from 40 and 100 °C as this are extrapolated, K.
_COLD, _HOT = 273.15, 393.15


def named_parts(model: Any, screw: BallScrew, lubricant: Any, **others: Any) -> dict[str, Any]:
    """The parts of a configuration by the section that their fields have in a case file.

    Those of the nut are among them. ``others`` are further parts by section; None stands for one that there is not.
    """
    materials = zip(MATERIALS, screw.materials, strict=True)
    laws = {f"model.{slot}": law for slot, law in model.laws_with_coefficients.items()}
    return {
        "screw": screw,
        **{f"screw.{name}": material for name, material in materials},
        "lubricant": lubricant,
        **_parts_of_nut(screw),
        **{section: part for section, part in others.items() if part is not None},
        "model": model,
        **laws,
    }


def _parts_of_nut(screw: BallScrew) -> dict[str, Any]:
    """The nut, its bodies in the sizes they have for the screw, and what it loses."""
    parts = screw.nut.parts
    return parts | ({"bodies": screw.nut.bodies.sized(screw)} if screw.nut.bodies is not None else {})


def implausible(parts: Mapping[str, Any]) -> list[Record]:
    """A warning for each quantity of the parts that is somewhere outside its usual range, with the value farthest out.

    Relations of fields, such as the lead angle, are quantities of the part as well. A preload that does not go with the
    load rating, and an oil outside the range of its data sheet, are among them.
    """
    lubricant, screw = parts.get("lubricant"), parts.get("screw")
    sheet = getattr(lubricant, "sheet", None)
    odd = odd_preload(screw) if isinstance(screw, BallScrew) else []
    values = [
        record
        for section, part in [*parts.items(), *([] if sheet is None else [("lubricant", sheet)])]
        for record in unusual(section, part)
        if record.subject not in {one.subject for one in odd}
    ]
    return [*values, *odd, *beyond_data_sheet(lubricant), *_grease_as_oil(lubricant, parts.get("model.inlet"))]


def beyond_data_sheet(lubricant: Any) -> list[Record]:
    """Warnings of an oil below its pour point, or outside the range of its data sheet, at the temperature farthest out.

    Where the sheet states no end, a warning tells that the viscosity is extrapolated below 0 °C and above 120 °C.
    """
    sheet: DataSheet | None = getattr(lubricant, "sheet", None)
    if sheet is None:
        return []
    numbers = np.asarray(lubricant.temperature, dtype=float)
    numbers = numbers[np.isfinite(numbers)]
    coldest, hottest = float(numbers.min(initial=np.inf)), float(numbers.max(initial=-np.inf))

    def shown(temperature: float) -> str:
        return units.shown(temperature, SHEET_TEMPERATURE)

    extrapolated = "its viscosity is extrapolated far from the two points of its data sheet"
    records: list[Record] = []
    if sheet.pour_point is not None and coldest < sheet.pour_point:
        text = (
            f"oil at {shown(coldest)}, below its pour point {shown(sheet.pour_point)}: it does not flow "
            "by itself, and its viscosity is a guess; at the start it is more"
        )
        records.append(_of_sheet("below_pour_point", text, coldest, float(sheet.pour_point)))
    elif sheet.lowest_temperature is not None and coldest < sheet.lowest_temperature:
        text = (
            f"lubricant at {shown(coldest)}, below the {shown(sheet.lowest_temperature)} that its maker "
            "states: its viscosity is a guess"
        )
        records.append(_of_sheet("below_range", text, coldest, float(sheet.lowest_temperature)))
    elif sheet.pour_point is None and sheet.lowest_temperature is None and coldest < _COLD:
        text = f"oil at {shown(coldest)}: {extrapolated}; give its pour_point"
        records.append(_of_sheet("extrapolated_cold", text, coldest, _COLD))
    if sheet.highest_temperature is not None and hottest > sheet.highest_temperature:
        text = (
            f"lubricant at {shown(hottest)}, above the {shown(sheet.highest_temperature)} that its maker "
            "states: it does not last"
        )
        records.append(_of_sheet("above_range", text, hottest, float(sheet.highest_temperature)))
    elif sheet.highest_temperature is None and hottest > _HOT:
        text = f"oil at {shown(hottest)}: {extrapolated}; give its highest_temperature"
        records.append(_of_sheet("extrapolated_hot", text, hottest, _HOT))
    return records


def _grease_as_oil(lubricant: Any, inlet: Any) -> list[Record]:
    """A warning of a grease whose track is replenished as by an oil bath (SKF2018)."""
    sheet: DataSheet | None = getattr(lubricant, "sheet", None)
    constant = getattr(inlet, "replenishment_constant", None)
    if sheet is None or not sheet.is_grease or constant is None:
        return []
    least = float(np.min(constant))
    if least >= GREASE_REPLENISHMENT * (1 - 1e-9):
        return []
    message = (
        "grease computed as oil of a bath: its constant of replenishment is 6e-8; write [model] "
        "inlet.replenishment_constant = 6e-8"
    )
    return [
        Record.warning(
            "lubricant.grease_as_oil",
            "model.inlet.replenishment_constant",
            message,
            value=least,
            limit=GREASE_REPLENISHMENT,
        )
    ]


def _of_sheet(name: str, text: str, value: float, limit: float) -> Record:
    return Record.warning(f"lubricant.{name}", "lubricant.temperature", text, value=value, limit=limit, unit="K")


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


PERCENT = {"percent": Shown("percent", digits=3)}
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
            PERCENT,
        ),
        Sentence(
            "the power of the torque differs by up to {percent}% from what the parts dissipate: the reactions "
            "of the model do not balance; the model corrected has them in balance",
            places=PERCENT,
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


#: The id of the record, in every answer that holds a torque.
STARVED = "lubricant.starved"
#: What is beside a starved number.
FULL_BATH = "in a full bath of oil"
#: Two torques differ where that of the full bath is larger by more than this share of the other.
LARGEST_DIFFERENCE = 0.1
#: Share of the rolling force that is left, at and above which the torque of a full bath is not asked for: were all of
#: the torque that force, it would grow by 1/0.92, that is by less than what counts.
NEARLY_ALL = 0.92

_SENTENCE = (
    "starvation: {given} if oil this thick comes back into the track too late, as formulas for bearings say, and "
    "{flooded} in a full bath of oil; no measurement on a ball screw decides between them"
)
#: The sentence of an answer that has one number, with places for it.
OF_ONE_NUMBER = _SENTENCE.replace("{given}", "friction is {given}")


class BothTorques(NamedTuple):
    """A number of an answer, such as a torque, with the inlet as it is given and in a full bath of oil, SI."""

    quantity: Quantity
    given: float
    flooded: float


def differs(given: Any, flooded: Any) -> Any:
    """Mask: one of the torques is larger by more than :data:`LARGEST_DIFFERENCE`; False where one is NaN.

    It is that of the full bath, but far beyond what the heat of the inlet is known for: there a thick film may rub less
    than none.
    """
    one, other, most = as_array(given), as_array(flooded), 1 + LARGEST_DIFFERENCE
    return (other > most * one) | (one > most * other)


def most_starved(given: Any, flooded: Any) -> tuple[float, float] | None:
    """Both torques where they differ the most, by their ratio; None where they differ nowhere."""
    given, flooded = np.broadcast_arrays(np.asarray(given, dtype=float), np.asarray(flooded, dtype=float))
    apart = differs(given, flooded)
    if not np.any(apart):
        return None
    with np.errstate(over="ignore"):  # infinite where there is no friction as given
        tiny = np.finfo(float).tiny
        ratio = np.where(apart, np.maximum(flooded, given) / np.maximum(np.minimum(given, flooded), tiny), 0.0)
    place = np.unravel_index(int(np.argmax(ratio)), ratio.shape)
    return float(given[place]), float(flooded[place])


def replenished(model: Any, screw: BallScrew, lubricant: Any, screw_speed: Any) -> Any:
    """Share of the rolling force that oil coming back late leaves over; one without a law that starves."""
    constant = getattr(model.inlet, "replenishment_constant", None)
    if constant is None:
        return np.ones(np.shape(screw_speed))
    speed = model.laws.frame(screw).entrainment_speed(np.abs(screw_speed))
    return rolling.replenishment_factor(
        lubricant.viscosity / lubricant.density, np.asarray(speed, dtype=float), screw.ball_diameter, constant
    )


def least_replenished(model: Any, screw: BallScrew, lubricant: Any, screw_speed: Any) -> float:
    """The least of the shares that are :func:`replenished`, of those that are numbers."""
    left = replenished(model, screw, lubricant, screw_speed)
    return float(np.min(left, initial=1.0, where=np.isfinite(left)))


def records(numbers: Sequence[BothTorques], remark: str | None = None) -> list[Record]:
    """The record of an answer that is starved; the first of the numbers is its value, in a full bath.

    The limit of the record is that number with the inlet as it is given. A ``remark`` ends the sentence.
    """
    first = numbers[0]
    given = [units.shown(one.given, one.quantity) for one in numbers]
    flooded = [units.shown(one.flooded, one.quantity) for one in numbers]
    if len(numbers) == 1:
        as_given = f"friction is {given[0]}"
    else:
        as_given = _listed(
            [f"{one.quantity.info.meaning} {torque}" for one, torque in zip(numbers, given, strict=True)]
        )
    text = _SENTENCE.format(given=as_given, flooded=_listed(flooded))
    return [
        Record.warning(
            STARVED,
            first.quantity.name,
            f"{text}; {remark}" if remark else text,
            value=first.flooded,
            limit=first.given,
            unit=first.quantity.unit,
        )
    ]


def _listed(parts: Sequence[str]) -> str:
    *others, last = parts
    return f"{', '.join(others)} and {last}" if others else last
