"""``ballscrew list``: names, one line each, by group."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from ballscrew.questions.names.compute import Name


def text(names: Sequence[Name]) -> str:
    """The names in columns: name, unit, meaning; a heading before each group where there are several."""
    groups = [(group, list(each)) for group, each in groupby(names, key=lambda one: one.group)]
    width = max((len(one.name) for one in names), default=0)
    units = max((len(one.unit) for one in names), default=0)
    lines: list[str] = []
    for group, each in groups:
        lines += [f"{group}:"] if len(groups) > 1 else []
        lines += ["  ".join([f"{one.name:<{width}}", f"{one.unit:<{units}}", one.meaning]).rstrip() for one in each]
    return "\n".join(lines)
