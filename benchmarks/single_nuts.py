"""Causes that could move or spread the torque of single nuts with oversize balls, computed for the rows of two makers.

    python benchmarks/single_nuts.py [--write]

Oversize of the balls at the preload of the row, which half a gauge of 1 um (ISO3290-1, balls of G5 and G10) changes by
so much; the half range of torque that the maker states, over its middle; the torque of the model over this middle, and
by how much bodies that swell change it at the same preload, which is by the contact angle.
"""

from __future__ import annotations

import dataclasses
import statistics
from collections.abc import Iterator
from typing import NamedTuple

import ballscrew as bs
from ballscrew.engine.uncertainty.uncertain_value import default_uncertainties
from ballscrew.evidence.validation.entries import Entry, Point
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.solvers.load_distribution import preload_growth
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate import compute
from harness import study

SETS = ("rexroth-single-nut", "hiwin-stock")


class Row(NamedTuple):
    """One row of a maker."""

    kind: str
    oversize: float
    by_gauge: float
    stated: float
    ratio: float
    swollen: float


def rows_of(entry: Entry) -> Iterator[Row]:
    """The rows of a set that have oversize balls."""
    gauge = default_uncertainties()["oversize"].half_width
    assert gauge is not None
    for point in entry.points:
        at = point.computed_at
        if at is None or not isinstance(at.screw.nut, OversizeBallNut) or at.screw.nut.preload is None:
            continue
        growth = preload_growth(at.screw, float(at.screw.nut.preload))
        elastic = dataclasses.replace(at.screw, nut=dataclasses.replace(at.screw.nut, bodies=bs.Bodies()))
        torques = [
            float(entry.model(screw, at.lubricant, axial_load=0.0, screw_speed=at.screw_speed).screw_torque)
            for screw in (at.screw, elastic)
        ]
        assert point.band.low is not None
        stated = 1 - point.band.low / point.band.middle
        yield Row(
            kind_of(entry, point), 1e6 / growth * 1.5, growth * gauge, stated, point.ratio, torques[1] / torques[0]
        )


def kind_of(entry: Entry, point: Point) -> str:
    """The rows that a row stands among."""
    at = point.computed_at
    assert at is not None
    if entry.data.name == SETS[0]:
        return f"Rexroth, {'up to' if at.screw.pitch_circle_diameter < 0.028 else 'above'} 25 mm"
    starts = "two starts" if at.screw.starts > 1 else point.group.replace("single", "one start")
    return f"HIWIN, {starts}"


def table() -> str:
    """The rows by their kinds, as Markdown."""
    request = dataclasses.replace(compute.request(SETS), calibration=None)
    by_kind: dict[str, list[Row]] = {}
    for entries, _ in compute.evaluate(request):
        for row in rows_of(entries[0]):
            by_kind.setdefault(row.kind, []).append(row)
    headings = ("rows", "number", "oversize, µm", "preload by half a gauge", "stated half range", "model / middle")
    lines: list[list[str]] = []
    for kind, rows in by_kind.items():
        sizes = [row.oversize for row in rows]
        shares = (statistics.median(getattr(row, name) for row in rows) for name in ("by_gauge", "stated"))
        ratios = (statistics.mean(getattr(row, name) for row in rows) for name in ("ratio", "swollen"))
        cells = [f"{min(sizes):.1f} to {max(sizes):.1f}", *(f"± {x:.0%}" for x in shares)]
        lines.append([kind, str(len(rows)), *cells, *(f"{x:.2f}" for x in ratios)])
    return markdown_table((*headings, "if bodies swell"), lines, numbers=True)


if __name__ == "__main__":
    study(__doc__, table, "single_nuts.inc")
