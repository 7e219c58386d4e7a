"""Figures: labels with units, a caption with the case, nothing clipped, nobody's settings."""

import re
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from ballscrew.evidence.papers import olaru2005
from ballscrew.questions.reproduce import ball_figure
from ballscrew.questions.reproduce import figure as figures
from ballscrew.questions.shared import charts
from support.pictures import clipped, undrawn

PLOTS = {plot.name: plot for plot in (*ball_figure.PLOTS, *figures.PLOTS)}


@pytest.fixture(scope="module")
def sources():
    data, results = olaru2005.curves(), ball_figure.drawn_results()
    return {name: results if plot in ball_figure.PLOTS else data for name, plot in PLOTS.items()}


@pytest.fixture(scope="module", params=PLOTS)
def plot(request):
    return PLOTS[request.param]


@pytest.fixture(scope="module")
def figure(plot, sources):
    """Laid out as for a PNG."""
    with charts.house_style():
        drawn = plot.draw(sources[plot.name])
        FigureCanvasAgg(drawn)
        drawn.draw_without_rendering()
    return drawn


@pytest.mark.slow
def test_axes_name_their_units(figure):
    shown = [panel for panel in figure.axes if panel.axison]
    assert shown
    for panel in shown:
        assert re.search(r"\((rpm|N|N m|mm|mN mm|mm/s)\)$", panel.get_xlabel())
        if panel.get_yticks().size:
            assert re.search(r"\((N m|mm|mm/s)\)$|^efficiency η$", panel.get_ylabel())


@pytest.mark.slow
def test_both_models_side_by_side_on_one_scale(figure):
    titles = [panel.get_title(loc="left") for panel in figure.axes]
    assert sum(title.startswith("as printed") for title in titles) == sum(t.startswith("corrected") for t in titles) > 0
    for left, right in zip(figure.axes[::2], figure.axes[1::2], strict=True):
        assert left.get_ylim() == right.get_ylim()
        assert left.get_xlim() == pytest.approx(right.get_xlim(), rel=0.1)


def test_caption_states_the_case(figure):
    caption = " ".join(" ".join(text.get_text() for text in figure.texts).split())
    assert "56 balls" in caption
    assert "E′ 226 GPa" in caption
    assert re.search("ssumed|Chosen", caption)


def test_nothing_is_clipped(figure):
    assert clipped(figure) == []


def test_no_legend_covers_an_axis_or_its_labels(figure):
    renderer = figure.canvas.get_renderer()
    hidden = undrawn(figure)
    texts = [
        text
        for panel in figure.findobj(mpl.axes.Axes)
        for axis in (panel.xaxis, panel.yaxis)
        for text in (*axis.get_ticklabels(), axis.label)
        if text.get_text() and text.get_visible() and text not in hidden
    ]
    for legend in figure.findobj(mpl.legend.Legend):
        box = legend.get_window_extent(renderer)
        for text in texts:
            assert not box.overlaps(text.get_window_extent(renderer)), text.get_text()
        if legend.axes is not None:
            panel = legend.axes.get_window_extent(renderer)
            assert panel.x0 <= box.x0
            assert panel.y0 <= box.y0


def test_table_holds_the_numbers(plot, sources):
    table = plot.table(sources[plot.name])
    lengths = {len(column) for column in table.values()}
    assert len(lengths) == 1
    for heading, column in table.items():
        if not isinstance(column, list) or not isinstance(column[0], str):
            assert re.search(r"\(.+\)$", heading), heading
            assert np.all(np.isfinite(column))


def test_assumptions_of_the_figures_are_stated(sources):
    with charts.house_style():
        for number, name in (
            (5, "fig5_torque_on_screw_and_nut"),
            (8, "fig8_torque_over_load"),
            (9, "fig9_efficiency_over_load"),
        ):
            caption = " ".join(PLOTS[name].draw(sources[name]).texts[0].get_text().split())
            assert "assumed" in caption
            assert f"Fig. {number}" in caption


def test_skid_is_shaded(sources):
    with charts.house_style():
        figure = PLOTS["fig9_efficiency_over_load"].draw(sources["fig9_efficiency_over_load"])
    for panel in figure.axes:
        assert "the ball would skid" in panel.get_legend_handles_labels()[1]


def test_forces_and_moments_of_the_drawings_balance(sources):
    for result in sources["fig2_forces_on_ball"].values():
        for arrows in (ball_figure.forces(result), ball_figure.moments(result)):
            values = [arrow.value for arrow in arrows]
            assert sum(values) == pytest.approx(0, abs=1e-12 * max(map(abs, values)) + 1e-13)


@pytest.mark.slow
def test_nobodys_settings_matter(sources, tmp_path):
    plot = PLOTS["fig7_efficiency_over_speed"]
    with charts.house_style():
        charts.save(plot.draw(sources[plot.name]), tmp_path, "plain")
    with mpl.rc_context({"lines.linewidth": 9, "font.size": 30, "axes.grid": False, "savefig.dpi": 20}):
        with charts.house_style():
            charts.save(plot.draw(sources[plot.name]), tmp_path, "loud")
        assert mpl.rcParams["font.size"] == 30
    for kind in ("svg", "png"):
        assert (tmp_path / f"plain.{kind}").read_bytes() == (tmp_path / f"loud.{kind}").read_bytes()


@pytest.mark.slow
def test_no_pyplot():
    code = "import sys; from ballscrew.questions.reproduce import ball_figure, figure; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "matplotlib.figure" in loaded
    assert "matplotlib.pyplot" not in loaded
