"""The JSON Schema of a file of a need: that of a case file without its screw, with what is open and what is asked."""

from __future__ import annotations

import copy
from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.cases.schema.case_schema import json_schema as case_schema
from ballscrew.cases.schema.case_schema import without_null
from ballscrew.cases.schema.fields import section_of
from ballscrew.physics.components.nut import NUTS
from ballscrew.questions.optimise.design_model import SEARCHED, VARIABLES, SearchOptions
from ballscrew.questions.select.need import SHORT_NAMES, need_section
from ballscrew.questions.select.requirements import OBJECTIVES, Requirements

#: Fields of a case that may be lists of choices.
_CHOICES = {"Nut": ("type", "preload"), "Lubricant": ("grade", "oil")}
_WORDS = "words that a row must have in name, source or kind of nut"


def json_schema() -> dict[str, Any]:
    """JSON Schema of a file of ``ballscrew select`` and ``ballscrew optimise``."""
    schema = copy.deepcopy(case_schema())
    for name in ("required", "allOf"):
        schema.pop(name, None)
    schema["title"] = "ballscrew need file"
    parts, known = schema["$defs"], schema["properties"]
    for section, fields in _CHOICES.items():
        for field in fields:
            parts[section]["properties"][field] = _or_list(parts[section]["properties"][field])
    parts["Operation"].pop("required", None)
    own = without_null(need_section().model_json_schema())
    prices = {"type": "object", "additionalProperties": {"type": "number", "exclusiveMinimum": 0}}
    of_need = {
        "rows": {"type": "string", "description": _WORDS},
        "objectives": _names(OBJECTIVES),
        "price_index": {**prices, "description": OBJECTIVES["price_index"].quantity.info.meaning + ", by rows"},
    }
    parts["Operation"]["properties"]["feed"] = own["properties"]["feed"]
    short = {name: {"description": f"short for {place}"} for name, place in SHORT_NAMES.items()}
    own["properties"] |= {**{n: each for n, each in short.items() if n not in own["properties"]}, **of_need}
    parts["Need"], parts["Optimise"] = own, _optimise()
    known |= {name: {"$ref": f"#/$defs/{name.capitalize()}"} for name in ("need", "optimise")}
    tables = {*known}
    known |= {name: each for name, each in short.items() if name not in tables}
    known |= {name: own["properties"][name] for name in fields_of(Requirements) if name not in known}
    known["nut"] = {"anyOf": [known["nut"], parts["Nut"]["properties"]["type"]]}
    return schema


def _optimise() -> dict[str, Any]:
    section = section_of("Optimise", fields_of(SearchOptions), SearchOptions, required=False)
    schema = without_null(section.model_json_schema())
    end = {"type": ["string", "number"]}
    pair = {"anyOf": [end, {"type": "array", "items": end, "minItems": 2, "maxItems": 2}]}
    bounds = {name: {**pair, "description": quantity.info.meaning} for name, quantity in VARIABLES.items()}
    schema["properties"] |= {
        "nut": {"type": "string", "enum": list(NUTS)},
        "objectives": _names(SEARCHED),
        "bounds": {"type": "object", "properties": bounds, "additionalProperties": False},
    }
    return schema


def _names(known: Any) -> dict[str, Any]:
    one = {"type": "string", "enum": list(known)}
    return {"anyOf": [one, {"type": "array", "items": one, "minItems": 1}]}


def _or_list(schema: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [schema, {"type": "array", "items": schema, "minItems": 1}]}
