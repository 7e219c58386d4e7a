"""Distributions that a table of surroundings gives its numbers: ``ball_conductance = "4 ± 1 W/K"``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.axis.thermal.surroundings import PREFIX, VARIED, Surroundings
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import fields_of
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.uncertain_value import parse_uncertain


def written_bands(table: Mapping[str, Any]) -> tuple[dict[str, Distribution], frozenset[str]]:
    """The distributions by name (``surroundings.ball_conductance``), and what is exact; of a table without faults."""
    distributions: dict[str, Distribution] = {}
    exact: set[str] = set()
    quantities = fields_of(Surroundings)
    for name in VARIED:
        written = parse_uncertain(table.get(name), quantities[name])
        assert not isinstance(written, Fault), written
        if written is None:
            continue
        if written.distribution is None:
            exact.add(PREFIX + name)
        else:
            distributions[PREFIX + name] = written.distribution
    return distributions, frozenset(exact)
