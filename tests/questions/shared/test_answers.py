"""Answers of all questions as the description of the API has them."""

import re

from ballscrew.faces.web import openapi
from ballscrew.faces.web.server import application

SCHEMAS = openapi.document(application())["components"]["schemas"]
#: What questions answer: all that is in these is described, too.
ANSWERS = (
    "BandResults", "BandedOutput", "BothRatings", "ChainResults", "ComparedLaw", "ComparedModel", "ComparedRule",
    "CycleOfNeed", "DutyReport", "FitRows", "FittedNumber", "Geometry", "Identifiability", "NextTest", "NutLoads",
    "Objectives", "Plan", "ReversalResults", "RippleResults", "RunResults", "ServiceResults", "Swept", "VendorRows",
    "WarmUpResults",
)  # fmt: skip


def parts_of(name, seen):
    if name not in seen:
        seen.add(name)
        for inner in re.findall(r"'#/components/schemas/(\w+)'", str(SCHEMAS[name])):
            parts_of(inner, seen)
    return seen


def test_every_part_of_an_answer_is_described():
    every = set().union(*(parts_of(name, set()) for name in ANSWERS))
    parts = {f"{name}.{part}": one for name in every for part, one in SCHEMAS[name].get("properties", {}).items()}
    assert [name for name, described in parts.items() if "description" not in described] == []
