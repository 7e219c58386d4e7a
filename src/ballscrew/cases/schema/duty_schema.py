"""The sections of a case file that a motion and its heat need, as pydantic models."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, Field, WithJsonSchema

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.motion.profiles import SCurve, Segment, Segments, Sine, Trapezoid
from ballscrew.axis.supports.bearing import PLACES, MountedBearing, SupportBearing
from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, MOUNTING, STATICS, UNCERTAIN, fields_of_laws
from ballscrew.axis.supports.guide import LinearGuide
from ballscrew.axis.thermal.surroundings import BRACINGS, VARIED, Surroundings
from ballscrew.basis import units
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.schema.fields import json_of, section_of, si_value
from ballscrew.physics.components.oil_grades import grades

#: The tables of a case that moves.
DUTY_TABLES = ("axis", "motion", "motor", "surroundings")
#: The rule of one efficiency, by the name of a model.
CONSTANT_EFFICIENCY = "constant-efficiency"
EFFICIENCY = Quantity(
    "efficiency",
    "1",
    Info(r"\eta", "efficiency at all loads and speeds", above=0, at_most=1, hint="catalogues have 0.9"),
)
#: Kinds of motion, by the names of a case file.
MOTIONS: Mapping[str, type] = {"trapezoid": Trapezoid, "s-curve": SCurve, "sine": Sine, "segments": Segments}
#: The kind of a motion that is read from a file.
TRAJECTORY = "trajectory"
#: The key of a case file for a field of a motion, where they differ: a word of Python, and the tables of a list.
KEYS: Mapping[str, str] = {"returns": "return", "segments": "segment"}
#: Speed and torque of a point of the curve of a motor.
POINT = (fields_of(Motor)["largest_speed"], fields_of(Motor)["peak_torque"])


class Counterforce(float):
    """A counterweight that is written as a force."""


def read_counterweight(raw: object) -> float:
    """A counterweight as a mass in kg, or as a constant force in N."""
    known = fields_of(Axis)
    force = units.parse("", raw, known["counterforce"])
    return si_value(raw, known["counterweight"]) if isinstance(force, Fault) else Counterforce(force)


def fields_of_motion(kind: str) -> tuple[str, ...]:
    """The keys that a motion of a kind may have, besides its kind."""
    if kind == TRAJECTORY:
        return ("file",)
    cls = MOTIONS[kind]
    return (*fields_of(cls), *(key for name, key in KEYS.items() if name in cls.__dataclass_fields__))


@functools.cache
def duty_sections() -> Mapping[str, type[BaseModel]]:
    """The models of the sections."""
    axis = fields_of(Axis)
    weight = json_of(axis["counterweight"], 0.0) | {"examples": ["150 kg", "1.5 kN"]}
    of_motions: dict[str, Quantity] = {}
    for cls in reversed(list(MOTIONS.values())):
        of_motions |= fields_of(cls)
    segment = section_of(
        "Segment",
        fields_of(Segment),
        Segment,
        required=False,
        name=(Annotated[str, Field(description="name of the segment in results")], None),
    )
    back: Any = {"return": (_flag("whether the cycle has the way back, true if left out"), None)}
    return {
        "axis": section_of(
            "Axis",
            {name: q for name, q in axis.items() if name != "counterweight"},
            Axis,
            required=True,
            counterweight=(
                Annotated[Any, BeforeValidator(read_counterweight), WithJsonSchema(weight), axis["counterweight"]],
                Field(default=None),
            ),
            brake_holds=(_flag("whether a brake holds the axis in rests, and the motor gives no torque there"), None),
        ),
        "motion": section_of(
            "Motion",
            of_motions,
            Trapezoid,
            required=False,
            kind=(one_of((*MOTIONS, TRAJECTORY), "kind of motion"), None),
            file=(Annotated[str, Field(description="table of a recorded motion, beside the case file")], None),
            segment=(
                Annotated[
                    list[Any],
                    WithJsonSchema({"type": "array", "minItems": 1, "items": segment.model_json_schema()}),
                ],
                Field(default=None, description="parts of a motion of segments, one after the other"),
            ),
            **back,
        ),
        "segment": segment,
        "motor": section_of(
            "Motor",
            fields_of(Motor),
            Motor,
            required=True,
            curve=(Annotated[list[Any], WithJsonSchema(_curve())], Field(default=None)),
        ),
        "surroundings": section_of(
            "Surroundings",
            fields_of(Surroundings),
            Surroundings,
            required=False,
            uncertain=VARIED,
            bracing=(one_of(BRACINGS, "how the halves of a nut are braced: pushed apart, or together"), None),
        ),
    }


def efficiency_field() -> tuple[Any, Any]:
    """The field ``efficiency`` of the section of the model, of the rule of one efficiency."""
    read = BeforeValidator(functools.partial(si_value, quantity=EFFICIENCY))
    schema = json_of(EFFICIENCY, 0.9) | {"description": f'{EFFICIENCY.info.meaning}, of name = "{CONSTANT_EFFICIENCY}"'}
    return Annotated[float, read, WithJsonSchema(schema)], Field(default=None)


def _curve() -> dict[str, Any]:
    point = {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}
    return {
        "type": "array",
        "items": point,
        "description": "peak torque over speed, straight between points",
        "examples": [[["0 rpm", "7 N m"], ["3000 rpm", "5 N m"]]],
    }


def _flag(meaning: str) -> Any:
    return Annotated[bool, Field(strict=True, description=meaning)]


def one_of(names: Iterable[str], meaning: str) -> Any:
    """A text that must be one of these names; the check is that of whoever looks the name up."""
    return Annotated[str, WithJsonSchema({"type": "string", "enum": list(names), "description": meaning})]


#: The tables on what holds the shaft and carries the table.
SUPPORT_TABLES = ("bearings", "guides")
#: The oil of an element where it is not that of the screw.
OIL = ("grade", "oil", "oil_file")


@functools.cache
def support_sections() -> Mapping[str, type[BaseModel]]:
    """The models of the sections."""
    bearing = section_of(
        "Bearing",
        {**fields_of_laws(BEARING_LAWS), **MOUNTING},
        SupportBearing,
        required=False,
        uncertain=UNCERTAIN,
        law=(one_of(BEARING_LAWS, "law of the friction of the bearing, contacts if left out"), None),
        catalogue=(_text("name of a support unit of a catalogue; the other fields then override it"), None),
        **_oil(),
    )
    places: dict[str, Any] = dict.fromkeys(PLACES, (bearing, None))
    return {
        "bearings": section_of("Bearings", {}, MountedBearing, required=False, **places),
        "guides": section_of(
            "Guides",
            {**fields_of_laws(GUIDE_LAWS), **STATICS},
            LinearGuide,
            required=False,
            uncertain=UNCERTAIN,
            law=(one_of(GUIDE_LAWS, "law of the friction of the guides, maker if left out"), None),
            catalogue=(_text("name of a carriage of a catalogue; the other fields then override it"), None),
            **_oil(),
        ),
    }


def _oil() -> dict[str, Any]:
    return {
        "grade": (one_of(grades(), "grade of its oil, or of the base oil of its grease"), None),
        "oil": (_text("name of its oil or grease in the library; left out, it has the oil of the screw"), None),
        "oil_file": (_text("table with the oil, beside the case file, in place of the library"), None),
    }


def _text(meaning: str) -> Any:
    return Annotated[str, Field(description=meaning)]
