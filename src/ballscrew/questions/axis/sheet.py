"""The sheet of the chain of an axis: verdicts, what gives way at places of the nut, and all of it over the stroke."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Block,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.cases.case_files import descriptions
from ballscrew.questions.axis.compute import FRICTION, SERIES, SPRINGS, ChainReport
from ballscrew.questions.shared.elements_text import element_lines

_POSITION = SERIES["position"]
_SHARE = Quantity("share", "1", Info("", "share of the compliance"))
#: What a table of places has, and its headings.
_PLACES: Mapping[str, str] = {
    "total": "rigidity",
    "lost_motion": "lost motion",
    "critical_speed": "critical speed",
    "buckling_load": "buckling load",
}
_COLOURS: Mapping[str, Colour] = dict(zip(SPRINGS, ("blue", "orange", "green", "grey", "purple"), strict=True))


def sheet(report: ChainReport) -> Sheet:
    """All that people see of the chain of an axis."""
    case = report.case
    return Sheet(
        title(report),
        [
            Lines(
                [Line(descriptions.design(case, plain_text=True), "small")]
                + [Line(text, "small") for text in element_lines(case)],
                detail=True,
            ),
            verdict_lines(report.verdicts),
            warning_lines(case.implausible()),
            _places(report),
            *_springs(report),
            *_charts(report),
            Columns(
                "axis",
                [Column(quantity.info.meaning, report.series[name], quantity) for name, quantity in SERIES.items()],
            ),
            Lines([Line(f"assumed: {text}", "small") for text in report.assumed]),
        ],
    )


def title(report: ChainReport) -> str:
    """``fixed–supported shaft of 1100 mm, nut from 250 mm to 850 mm: double nut, preload 3500 N``."""
    installation, case = report.chain.installation, report.case
    length = units.shown(installation.unsupported_length, _POSITION)
    ends = " to ".join(units.shown(end, _POSITION) for end in report.travel)
    nut = "" if case.nut is None else f": {descriptions.nut_text(case.nut)}"
    return f"{installation.ends.words} shaft of {length}, nut from {ends}{nut}"


def _places(report: ChainReport) -> Table:
    """One row for each place that is shown."""
    is_known = math.isfinite(report.guide_friction)
    names = [name for name in _PLACES if name != "lost_motion" or is_known]
    rows: list[list[Cell]] = [
        [place, *(Number(float(report.series[name][index]), SERIES[name]) for name in names)]
        for index, place in _shown_places(report).items()
    ]
    notes = [_origin_of_lost_motion(report)] if is_known else []
    return Table("places", "Nut at", ("", *(_PLACES[name] for name in names)), rows, notes)


def _origin_of_lost_motion(report: ChainReport) -> str:
    is_preloaded = bool(getattr(report.case.nut, "preload", 0))
    backlash = "the preloaded nut has no backlash" if is_preloaded else "backlash comes on top"
    return f"Lost motion from the {units.shown(report.guide_friction, FRICTION)} of the guides; {backlash}."


def _shown_places(report: ChainReport) -> dict[int, str]:
    return {index: units.shown(float(report.chain.position[index]), _POSITION) for index in report.shown}


def _springs(report: ChainReport) -> Iterator[Table]:
    """The rigidity of each spring that is known, and its share of the compliance, at the places that are shown."""
    shares, places = report.chain.shares, _shown_places(report)
    known = [name for name in SPRINGS if np.any(shares[name])]
    columns = ("", *places.values())
    rigidity = [[name, *(Number(float(report.series[name][i]), SERIES[name]) for i in places)] for name in known]
    yield Table("rigidity", "Rigidity", columns, rigidity)
    share = [[name, *(Share(float(shares[name][index]), bar=False) for index in places)] for name in known]
    yield Table("shares", "Share of the compliance", columns, share)


def _charts(report: ChainReport) -> Iterator[Block]:
    place, at = Axis("nut from the fixed bearing", _POSITION), report.chain.position
    travel = [Vertical("travel of the nut", report.travel[0]), Vertical("", report.travel[1])]

    def curve(name: str) -> list[Curve]:
        return [Curve("", at, report.series[name], "blue")]

    rigidity = Axis("rigidity", SERIES["total"], least=0.0)
    yield Chart("rigidity between motor and table", place, rigidity, [*curve("total"), *travel])
    yield Chart("share of the compliance", place, Axis("share", _SHARE), list(_stacked(report)))
    for name, limit, limit_name in (
        ("critical_speed", report.largest_speed, "largest speed"),
        ("buckling_load", report.largest_load, "largest load"),
    ):
        axis = Axis(_PLACES[name], SERIES[name], log=True)
        marks = [*curve(name), Level(limit_name, limit, "red"), *travel] if limit > 0 else [*curve(name), *travel]
        yield Chart(f"{_PLACES[name]} of the shaft", place, axis, marks)


def _stacked(report: ChainReport) -> Iterator[Band]:
    """The shares of the springs, one upon the other."""
    below = np.zeros_like(report.chain.position)
    for name in SPRINGS:
        share = np.asarray(report.chain.shares[name])
        if np.any(share):
            yield Band(name, report.chain.position, below, below + share, _COLOURS[name], solid=True)
            below = below + share
