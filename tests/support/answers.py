"""Answers: numbers without a unit."""

from collections.abc import Iterator, Mapping
from typing import Any


def without_unit(results: Mapping[str, Any], units: Any, path: str = "") -> Iterator[str]:
    """Numbers of results without a unit, by their path."""
    for name, value in results.items():
        unit = units.get(name) if isinstance(units, dict) else units
        if isinstance(value, dict):
            yield from without_unit(value, unit or {}, f"{path}{name}.")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            yield from without_unit(value[0], unit or {}, f"{path}{name}.")
        elif not unit and isinstance(value[0] if isinstance(value, list) and value else value, float):
            yield path + name
