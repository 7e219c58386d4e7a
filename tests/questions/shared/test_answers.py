"""Answers of all questions as the description of the API has them."""

import re

from ballscrew.faces.web import openapi
from ballscrew.faces.web.server import application

#: What questions answer: all that is in these is described, too.
ANSWERS = (
    "BandResults", "BandedOutput", "BothRatings", "ChainResults", "ComparedLaw", "ComparedModel", "ComparedRule",
    "CycleOfNeed", "DutyReport", "FitRows", "FittedNumber", "Geometry", "Identifiability", "NextTest", "NutLoads",
    "Objectives", "Plan", "ReversalResults", "RippleResults", "RunResults", "ServiceResults", "Swept", "VendorRows",
    "WarmUpResults",
)  # fmt: skip


def parts_of(name, schemas, seen):
    if name not in seen:
        seen.add(name)
        for inner in re.findall(r"'#/components/schemas/(\w+)'", str(schemas[name])):
            parts_of(inner, schemas, seen)
    return seen


def test_every_part_of_an_answer_is_described():
    schemas = openapi.document(application())["components"]["schemas"]
    every = set().union(*(parts_of(name, schemas, set()) for name in ANSWERS))
    parts = {f"{name}.{part}": one for name in every for part, one in schemas[name].get("properties", {}).items()}
    assert [name for name, described in parts.items() if "description" not in described] == []
