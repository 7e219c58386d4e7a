"""The sections of a case file on what holds the shaft and carries the table, as pydantic models."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from pydantic import BaseModel, Field, WithJsonSchema

from ballscrew.axis.supports.bearing import SupportBearing
from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, MOUNTING, STATICS, UNCERTAIN, fields_of_laws
from ballscrew.axis.supports.guide import LinearGuide
from ballscrew.axis.supports.mounted_bearing import PLACES, MountedBearing
from ballscrew.cases.schema.fields import section_of
from ballscrew.physics.components.materials import grades

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
        law=(_one_of(BEARING_LAWS, "law of the friction of the bearing, contacts if left out"), None),
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
            law=(_one_of(GUIDE_LAWS, "law of the friction of the guides, maker if left out"), None),
            catalogue=(_text("name of a carriage of a catalogue; the other fields then override it"), None),
            **_oil(),
        ),
    }


def _oil() -> dict[str, Any]:
    return {
        "grade": (_one_of(grades(), "grade of its oil, or of the base oil of its grease"), None),
        "oil": (_text("name of its oil or grease in the library; left out, it has the oil of the screw"), None),
        "oil_file": (_text("table with the oil, beside the case file, in place of the library"), None),
    }


def _text(meaning: str) -> Any:
    return Annotated[str, Field(description=meaning)]


def _one_of(names: Iterable[str], meaning: str) -> Any:
    return Annotated[str, WithJsonSchema({"type": "string", "enum": list(names), "description": meaning})]
