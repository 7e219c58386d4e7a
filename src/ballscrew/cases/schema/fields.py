"""Fields and sections of a case file as pydantic has them, made from the annotations of the parts."""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Collection, Mapping
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, create_model
from pydantic_core import PydanticCustomError

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, fault_of
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS, PERCENT
from ballscrew.engine.uncertainty import uncertain_value
from ballscrew.files.tables.cells import Share
from ballscrew.physics.components.operating_state import OperatingState

#: What stands in the schema as an example: examples/feed_drive.toml, and what has no default.
EXAMPLES: Mapping[str, str | float] = {
    "pitch_circle_diameter": "41.4 mm",
    "lead": "10 mm",
    "ball_diameter": "6.35 mm",
    "loaded_balls": 75,
    "contact_angle": "45 deg",
    "screw_conformity": 0.54,
    "nut_conformity": 0.54,
    "temperature": "40 degC",
    "axial_load": "5 kN",
    "screw_speed": "600 rpm",
    "viscosity": "88 mPa s",
    "kinematic_viscosity_40": "100 cSt",
    "kinematic_viscosity_100": "11.1 cSt",
    "density_15": "880 kg/m^3",
    "pour_point": "-24 degC",
    "lowest_temperature": "-20 degC",
    "highest_temperature": "120 degC",
    "pressure_modulus_slope": 0.02,
    "ball_to_ball_force": "0.0167 N",
    "pure_rolling_offset": 0.34,
    "dynamic_load_rating": "50.3 kN",
    "static_load_rating": "131 kN",
    "root_diameter": "34.9 mm",
    "preload": "3 kN",
    "axial_play": "20 um",
    "oversize": "3 um",
    "screw_diameter": "35 mm",
    "nut_outer_diameter": "62 mm",
    "nut_inner_diameter": "48 mm",
    "lip_friction": "80 N/m",
    "seal_torque": "0.2 N m",
    "bearing_rigidity": "500 N/um",
    "mount_rigidity": "1000 N/um",
    "accuracy_factor": 0.55,
    "balls": 165,
    "unsupported_length": "1 m",
    "running_time": "20000 h",
    "diameter_speed_product": "70000 mm rpm",
    "mass": "400 kg",
    "motor_inertia": "20 kg cm^2",
    "coupling_inertia": "3 kg cm^2",
    "screw_inertia": "20 kg cm^2",
    "stroke": "500 mm",
    "speed": "30 m/min",
    "acceleration": "4.9 m/s^2",
    "jerk": "100 m/s^3",
    "frequency": "1 Hz",
    "distance": "500 mm",
    "duration": "5 s",
    "rated_torque": "7 N m",
    "peak_torque": "20 N m",
    "largest_speed": "3000 rpm",
    "torque_constant": "0.9 N m/A",
    "resistance": "0.8 ohm",
    "holding_torque": "0.1 N m",
    "nut_mass": "2 kg",
    "ball_conductance": "4 W/K",
    "shaft_convection": "30 W/(m^2 K)",
    "shaft_length": "1.2 m",
    "first_position": "200 mm",
    "bore": "12 mm",
    "coolant": "20 degC",
    "stretch": "35 um",
    "outside_diameter": "62 mm",
    "z_r": 18,
    "conformity": 0.52,
    "viscous_factor": 2.0,
    "load_factor": 0.001,
    "torque": "0.35 N m",
    "load_share": 1.0,
    "rigidity": "500 N/um",
    "friction_coefficient": 0.003,
    "seal_force": "3 N",
    "carriage_spacing": "400 mm",
    "rail_spacing": "300 mm",
    # two fields of [deviations] are called as those of [screw]: they go by their symbols
    "s_w": "0.3 um",
    "s_h": "1 um",
    "groove": "1 um",
}


#: Marks of a distribution, which a plain number has not;
#: :func:`~ballscrew.engine.uncertainty.uncertain_value.parse_uncertain` reads it.
_DISTRIBUTION = r"±|\+\s*/?\s*[-−–]|\("


#: A force whose deviation alone is in per cent.
_PERCENT_OF_FORCE = re.compile(r"[a-zA-Z]\s*±")


def si_value(raw: object, quantity: Quantity, may_vary: bool = False) -> float:
    """A raw value in SI and within its bounds, or the fault in it as pydantic wants to hear it.

    Of a distribution, where one may stand, it is the central value.
    """
    written = (
        uncertain_value.parse_uncertain(raw, quantity)
        if may_vary
        else uncertain_value.refuse_distribution(raw, quantity)
    )
    if isinstance(written, Fault):
        raise PydanticCustomError("fault", "fault", {"fault": written})
    if written is not None:
        return written.central
    value = units.parse("", raw, quantity)
    fault = value if isinstance(value, Fault) else fault_of("", quantity, value)
    if fault is not None:
        fault = units.in_display_units(fault, quantity, fault.given if fault is value else str(raw))
        raise PydanticCustomError("fault", "fault", {"fault": fault})
    assert isinstance(value, float)
    return int(value) if quantity.info.whole else value


def read_preload(raw: object) -> float:
    """A preload in N, or as a share of the dynamic load rating."""
    if isinstance(raw, str) and is_share(raw):
        return Share(si_value(without_percent(raw), PERCENT, may_vary=True) / 100)
    bare = units.parse("", raw, PERCENT)
    if not isinstance(bare, Fault) and 0 < bare <= 100:
        share, force = (f"{number:.12g}" for number in (bare if bare >= 1 else 100 * bare, bare))
        remedy = f'write "{share} %" of the dynamic load rating, or "{force} kN"'
        raise PydanticCustomError("fault", "fault", {"fault": Fault("", "needs a unit", str(raw), remedy)})
    return si_value(raw, NUT_FIELDS["preload"], may_vary=True)


#: The speed of the screw, and that of the nut along it, which may stand in its place.
_SCREW_SPEED = fields_of(OperatingState)["screw_speed"]
NUT_SPEED = Quantity("screw_speed", "m/s", Info("v", "speed of the nut along the screw", "m/min"))
#: A unit of a speed along a line: a length by a time, at the end or before a deviation. A unit of a turn is none, as
#: the r of "r/min".
_ALONG = re.compile(r"(?<![A-Za-z])(?:m|[a-zµμ]m|in|inch|inches|ft|foot|feet)\s*/\s*(?:min|s|h|sec|hour)\s*(?:$|[±+])")


class NutSpeed(float):
    """A speed of the nut along the screw, m/s, in place of a speed of the screw: the lead turns one into the other."""


def read_speed(raw: object) -> float:
    """A speed of the screw in rad/s, or one of the nut, by its unit."""
    if is_nut_speed(raw):
        return NutSpeed(si_value(raw, NUT_SPEED, may_vary=True))
    return si_value(raw, _SCREW_SPEED, may_vary=True)


def is_nut_speed(raw: object) -> bool:
    """Return whether a speed is written in a unit of length by time, such as ``"12 m/min"``."""
    return isinstance(raw, str) and len(raw) <= units.LONGEST_VALUE and bool(_ALONG.search(raw.strip(" )")))


def is_share(raw: str) -> bool:
    """Return whether a preload is written as a share of the dynamic load rating."""
    return "%" in raw and not _PERCENT_OF_FORCE.search(raw)


def without_percent(raw: str) -> str:
    """A share of the dynamic load rating without its sign: ``"7"``, ``"7 ± 10 %"``, ``"(7 ± 1)"``."""
    middle, sign, half = raw.partition("±")
    if sign and not middle.lstrip().startswith("("):
        return f"{middle.strip().removesuffix('%').strip()} ± {half.strip()}"
    return raw.strip().removesuffix("%").strip()


def example_of(quantity: Quantity) -> str | float | None:
    """Example value of a field, by its symbol or its name."""
    return EXAMPLES.get(quantity.info.symbol, EXAMPLES.get(quantity.name))


def _example(quantity: Quantity, default: Any) -> str | float:
    """Possible value of a field: that of the feed drive in the examples, or else the default."""
    written = example_of(quantity)
    if written is not None:
        return written
    if default is None:  # a coefficient of a law from outside, which has to be given
        return 1.0 if quantity.unit == "1" else f"1 {quantity.shown_in}"
    number = units.from_si(default, quantity)
    return default if quantity.unit == "1" else f"{number:.6g} {quantity.shown_in}"


def json_of(quantity: Quantity, default: Any, may_vary: bool = False) -> dict[str, Any]:
    """Form of a field in the file: text with a unit, or a plain number within its bounds.

    A plain number that may be uncertain may be the text of a distribution, too.
    """
    info = quantity.info
    examples = [_example(quantity, default)]
    description = {"description": info.meaning, "x-symbol": info.symbol}
    if info.hint:
        description["x-hint"] = info.hint
    if quantity.unit != "1":
        return {
            **description,
            "type": "string",
            "examples": examples,
            "x-si-unit": quantity.unit,
            "x-unit": quantity.shown_in,
        }
    bounds = {
        "exclusiveMinimum": info.above,
        "minimum": info.at_least,
        "exclusiveMaximum": info.below,
        "maximum": info.at_most,
    }
    number = {"type": "integer" if info.whole else "number"}
    number |= {name: bound for name, bound in bounds.items() if bound is not None}
    described = {**description, "examples": examples}
    if may_vary and not info.whole:
        return {**described, "anyOf": [number, {"type": "string", "pattern": _DISTRIBUTION}]}
    return {**described, **number}


def _field(quantity: Quantity, default: Any, shown: Any, may_vary: bool) -> tuple[Any, Any]:
    read = BeforeValidator(functools.partial(si_value, quantity=quantity, may_vary=may_vary))
    kind = int if quantity.info.whole else float
    return Annotated[kind, read, WithJsonSchema(json_of(quantity, shown, may_vary)), quantity], Field(default=default)


def section_of(
    title: str,
    quantities: Mapping[str, Quantity],
    cls: type,
    /,
    required: bool,
    uncertain: Collection[str] = (),
    **others: Any,
) -> type[BaseModel]:
    """A model with a field for each quantity; unset fields keep the default of the part.

    Those named ``uncertain`` may have a distribution.
    """
    needed = {
        field.name
        for field in dataclasses.fields(cls)
        if field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    }
    own = defaults_of(cls)
    fields = {
        n: _field(q, ... if required and n in needed else None, own.get(n), n in uncertain)
        for n, q in quantities.items()
    }
    return create_model(title, __config__=ConfigDict(extra="forbid"), **fields, **others)


def defaults_of(cls: type) -> dict[str, Any]:
    """The defaults of a dataclass by field, where it has any."""
    fields = dataclasses.fields(cls)
    return {field.name: field.default for field in fields if field.default is not dataclasses.MISSING}
