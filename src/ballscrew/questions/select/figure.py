"""Pareto pictures: candidates by two objectives, those that fail, and the front."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.select import text
from ballscrew.questions.select.compute import Ranked, Selection
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.shared import charts

_LABEL_SIZE, _NAMED = 7.5, 6
#: Spans of an axis beyond which it is logarithmic.
_DECADE = 10.0


def picture(found: Selection) -> Figure:
    """The objectives two by two, the first against each other one; call within the house style."""
    names = list(found.objectives)
    pairs = [(names[0], other) for other in names[1:]] or [(names[0], "drive_torque")]
    figure, panels = charts.new_figure(caption(found), rows=math.ceil(len(pairs) / 2), columns=2)
    figure.suptitle(text.title(found), x=0.012, ha="left", fontsize=11, fontweight="bold")
    for panel, (x, y) in itertools.zip_longest(panels, pairs, fillvalue=("", "")):
        assert isinstance(panel, Axes)
        if x:
            _panel(panel, found.ranked, x, y)
        else:
            panel.set_axis_off()
    panels[0].legend(loc="best", fontsize=_LABEL_SIZE)
    return figure


def caption(found: Selection) -> str:
    """What the picture shows, and of what need."""
    required = ", ".join(text.asked(found.need))
    return (
        f"{found.need.name}: {required}. Filled: on the Pareto front of "
        f"{', '.join(found.objectives).replace('_', ' ')} "
        "among the candidates of which no check fails, as the circles; crosses: fail. Numbers are ranks."
    )


def _panel(panel: Axes, ranked: Sequence[Ranked], x: str, y: str) -> None:
    for label, members, look in _groups(ranked):
        points = [(_shown(x, each), _shown(y, each)) for each in members]
        panel.scatter([p[0] for p in points], [p[1] for p in points], s=22, label=label, **look)
    for each in [each for each in ranked if each.pareto][:_NAMED]:
        point = (_shown(x, each), _shown(y, each))
        if all(map(math.isfinite, point)):
            panel.annotate(str(each.rank), point, xytext=(4, 3), textcoords="offset points", fontsize=_LABEL_SIZE)
    for name, axis, scale in ((x, panel.set_xlabel, panel.set_xscale), (y, panel.set_ylabel, panel.set_yscale)):
        axis(label_of(OBJECTIVES[name].quantity))
        if _spans_decades(ranked, name):
            scale("log")


def _groups(ranked: Sequence[Ranked]) -> list[tuple[str, list[Ranked], dict[str, Any]]]:
    """The candidates that look alike: their label, and their marks."""
    return [
        ("fails", [each for each in ranked if not each.candidate.fits], {"marker": "x", "color": charts.SHADE}),
        (
            "no check fails", [each for each in ranked if each.candidate.fits and not each.pareto],
            {"marker": "o", "facecolors": "white", "edgecolors": charts.GREY},
        ),
        ("Pareto front", [each for each in ranked if each.pareto], {"marker": "o", "color": charts.RED}),
    ]  # fmt: skip


def _spans_decades(ranked: Sequence[Ranked], name: str) -> bool:
    """Test whether an objective is read best on a logarithmic axis."""
    numbers = [value for each in ranked if math.isfinite(value := _shown(name, each)) and value > 0]
    return bool(numbers) and max(numbers) > _DECADE * min(numbers)


def label_of(quantity: Quantity) -> str:
    """``power lost to friction (W)``."""
    unit = "" if quantity.unit == "1" else f" ({units.label(quantity)})"
    return f"{quantity.info.meaning}{unit}"


def _shown(name: str, each: Ranked) -> float:
    value = each.candidate.objectives[name]
    return float(units.from_si(value, OBJECTIVES[name].quantity)) if math.isfinite(value) else math.nan
