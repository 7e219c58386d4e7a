"""A tornado: the friction torque with each uncertain input at either end of its distribution, the widest on top."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis.output.plain_numbers import plain
from ballscrew.engine.uncertainty.one_at_a_time import Swing
from ballscrew.questions.band.text import spoken
from ballscrew.questions.band.tornado import Tornado
from ballscrew.questions.shared import charts

#: Inputs that are drawn, and the share of the widest swing below which an input is left out.
MOST, LEAST = 12, 0.01
#: Inches: width, height of a bar, and of what stands above and below all bars.
_WIDTH, _ROW, _FRAME = 7.1, 0.19, 0.8
_BAR = 0.72
_OF_LAWS = "#999999"


def shown(tornado: Tornado) -> Sequence[Swing]:
    """The swings that are drawn: the widest, those that move anything."""
    finite = [swing for swing in tornado.swings if math.isfinite(swing.width)]
    widest = finite[0].width if finite else 0.0
    return [swing for swing in finite if swing.width > LEAST * widest][:MOST]


def picture(tornado: Tornado) -> Figure:
    """Bars from the lower to the upper end of each input, then of the other laws; call within the house style."""
    swings, value = shown(tornado), tornado.torque.value
    laws = tornado.torque.model_form
    with_laws = laws.high > laws.low
    rows = len(swings) + with_laws
    figure = Figure(figsize=(_WIDTH, _FRAME + _ROW * rows), layout="constrained")
    panel: Axes = figure.subplots()
    places = np.arange(len(swings))
    for colour, label, ends in (
        (charts.SKY, "input at its lower end", [swing.at_lower for swing in swings]),
        (charts.ORANGE, "at its upper end", [swing.at_upper for swing in swings]),
    ):
        panel.barh(places, np.array(ends) - value, _BAR, left=value, color=colour, label=label)
    labels = [plain(f"{spoken(swing.input)}: {tornado.inputs[swing.input].description}") for swing in swings]
    if with_laws:
        panel.barh(len(swings), laws.high - laws.low, _BAR, left=laws.low, color=_OF_LAWS, label="other laws")
        labels.append("other laws that are valid here, together")
    panel.axvline(value, color=charts.INK, linewidth=0.9)
    panel.set_yticks(range(rows), labels)
    panel.set_ylim(rows - 0.4, -0.6)
    panel.tick_params(axis="y", length=0)
    panel.grid(visible=False, axis="y")
    panel.set_xlabel("friction torque on the screw (N m)")
    panel.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)
    return figure
