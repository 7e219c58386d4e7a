"""The picture of the reference model on a preloaded nut without load: its band, and the rules of makers on one axis."""

from __future__ import annotations

from matplotlib.figure import Figure

from ballscrew.cases.case_files import descriptions
from ballscrew.questions.reproduce import preloaded_nut_text as words
from ballscrew.questions.reproduce.preloaded_nut import PreloadedNut
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.charts import Columns, Plot

_BAR = 0.5


def band_and_rules(preloaded_nut: PreloadedNut) -> Figure:
    """The band of the model as a bar, with its value and its median; below it a point for each rule."""
    here = preloaded_nut.unloaded
    torque = here.band.band["screw_torque"]
    caption = (
        f"{descriptions.title(here.case)}; {descriptions.design(here.case)}. Bar: {words.level(here)} of "
        f"{here.band.band.count} samples of uncertain inputs and laws. "
        "Without seals, because the makers' rules leave them out."
    )
    figure, (panel,) = charts.new_figure(caption, columns=1, height=2.4)
    panel.barh(0, torque.both.high - torque.both.low, _BAR, left=torque.both.low, color=charts.SKY)
    ends = [-_BAR / 2, _BAR / 2]
    panel.plot([torque.median] * 2, ends, color=charts.INK, linestyle=":", label="median of the samples")
    panel.plot([torque.value] * 2, ends, color=charts.INK, label="at the values of the case")
    labels = ["reference model"]
    rules = preloaded_nut.rules
    for place, one in enumerate(rules, start=1):
        colour = charts.RED if one.beside.by_rule.is_own else charts.ORANGE
        panel.plot(float(one.beside.by_rule.torque), place, "o", color=colour)
        labels.append(words.label_of(one))
    panel.axvspan(*torque.both, color=charts.LIGHT_SHADE, zorder=0)
    panel.set_yticks(range(len(labels)), labels)
    panel.set_ylim(len(labels) - 0.5, -0.6)
    panel.set_xlim(left=0)
    panel.set_xlabel(f"{words.DRAG} (N m)")
    panel.grid(visible=False, axis="y")
    panel.tick_params(axis="y", length=0)
    figure.legend(loc="outside upper right", ncols=2)
    return figure


def _columns(preloaded_nut: PreloadedNut) -> Columns:
    torque = preloaded_nut.unloaded.band.band["screw_torque"]
    rules = preloaded_nut.rules
    return {
        "of": ["reference model", *(words.label_of(one) for one in rules)],
        f"{words.DRAG} (N m)": [torque.value, *(float(one.beside.by_rule.torque) for one in rules)],
        "least of the band (N m)": [torque.both.low, *[""] * len(rules)],
        "greatest of the band (N m)": [torque.both.high, *[""] * len(rules)],
        "within the band (1 = yes)": ["", *(int(one.is_in_band) for one in rules)],
    }


PLOT = Plot(words.PICTURE, band_and_rules, _columns)
