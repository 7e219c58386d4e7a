"""The front of an optimisation: its members and all of its designs, and what they look like along it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.questions.optimise import text
from ballscrew.questions.optimise.compute import Member, Optimisation
from ballscrew.questions.optimise.design_space import VARIABLES
from ballscrew.questions.select.figure import label_of
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.select.text import asked
from ballscrew.questions.shared import charts

_LABEL_SIZE = 7.5


def picture(found: Optimisation) -> Figure:
    """The front by its first two objectives, and the free variables along the first; call within the house style."""
    names = list(found.space.bounds)
    figure, panels = charts.new_figure(caption(found), rows=math.ceil((1 + len(names)) / 2), columns=2)
    figure.suptitle(text.title(found), x=0.012, ha="left", fontsize=11, fontweight="bold")
    _front(panels[0], found)
    for panel, name in zip(panels[1:], names, strict=False):
        _along(panel, found, name)
    for panel in panels[1 + len(names) :]:
        panel.set_axis_off()
    return figure


def caption(found: Optimisation) -> str:
    """What the picture shows, and of what need."""
    quantile = found.space.options.quantile
    of_search = "as the search has them" if quantile is None else f"by the {quantile:g} quantile of the search"
    return (
        f"{found.need.name}: {', '.join(asked(found.need))}. Grey: all designs of the front, {of_search}; filled: "
        "members by the full model at the central inputs, on the front by it; crosses: fail a check there."
    )


def _front(panel: Axes, found: Optimisation) -> None:
    x = found.space.objectives[0]
    y = found.space.objectives[1] if len(found.space.objectives) > 1 else x
    columns = {name: OBJECTIVES[name].sign * found.front.costs[:, i] for i, name in enumerate(found.space.objectives)}
    panel.scatter(_in_units(x, columns[x]), _in_units(y, columns[y]), s=9, color=charts.SHADE, label="search")

    def value(each: Member) -> float:
        return float(_in_units(y, each.objectives[y]))

    _members(panel, found, x, value)
    panel.set_ylabel(label_of(OBJECTIVES[y].quantity))
    panel.legend(loc="best", fontsize=_LABEL_SIZE)


def _along(panel: Axes, found: Optimisation, name: str) -> None:
    quantity = VARIABLES[name]

    def value(each: Member) -> float:
        number = each.variables[name]
        return 100 * number if name == "preload" else float(units.from_si(number, quantity))

    _members(panel, found, found.space.objectives[0], value)
    panel.set_ylabel("preload (% of C_a)" if name == "preload" else label_of(quantity), fontsize=9)


def _members(panel: Axes, found: Optimisation, x: str, value: Callable[[Member], float]) -> None:
    groups: tuple[tuple[str, list[Member], dict[str, Any]], ...] = (
        ("fails", [m for m in found.members if not m.fits], {"marker": "x", "color": charts.GREY}),
        (
            "holds", [m for m in found.members if m.fits and not m.pareto],
            {"marker": "o", "facecolors": "white", "edgecolors": charts.GREY},
        ),
        ("front by the full model", [m for m in found.members if m.pareto], {"marker": "o", "color": charts.RED}),
    )  # fmt: skip
    for label, members, look in groups:
        if members:
            places = [float(_in_units(x, each.objectives[x])) for each in members]
            panel.scatter(places, [value(each) for each in members], s=22, label=label, **look)
    panel.set_xlabel(label_of(OBJECTIVES[x].quantity))


def _in_units(name: str, values: object) -> np.ndarray:
    return np.asarray(units.from_si(np.asarray(values, dtype=float), OBJECTIVES[name].quantity))
