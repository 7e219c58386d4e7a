"""``ballscrew compare --json`` of several designs: the documents of their checks, and changes against the first."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.version import __version__
from ballscrew.questions.check.compute import Checked
from ballscrew.questions.check.document import list_document
from ballscrew.questions.compare_designs.compute import SideBySide

#: Results whose change against the first design is stated.
COMPARED = ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")


def document(found: SideBySide) -> dict[str, Any]:
    """All designs in SI, each as ``ballscrew check --json`` has it; a change is a share of the value of the first."""
    first = found.designs[0]
    return {
        "at": "own" if found.own else "first",
        "designs": [
            {**whole, "change": {name: change_of(name, one, first) for name in COMPARED}}
            for whole, one in zip(list_document(found.designs), found.designs, strict=True)
        ],
        "provenance": {"version": __version__},
    }


def change_of(name: str, one: Checked, first: Checked) -> float | None:
    """The change of a result against that of the first design; None where their signs make it meaningless."""
    value, start = (float(getattr(each.run.friction, name)) for each in (one, first))
    return value / start - 1 if value > 0 and start > 0 else None
