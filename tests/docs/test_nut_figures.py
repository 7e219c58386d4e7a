"""The figures of the page on nuts: all are shown, each has axes with units, and two runs give the same bytes."""

import re
from pathlib import Path

import numpy as np
import pytest

from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.shared import charts
from effect_study import nut_curves as curves
from effect_study import nut_figures

ROOT = Path(__file__).parents[2]


def test_the_page_shows_all():
    text = (ROOT / "docs" / "nuts.md").read_text(encoding="utf-8")
    assert set(re.findall(r"figures/nuts/(\w+)\.svg", text)) == set(nut_figures.DRAWN)


@pytest.mark.slow
@pytest.mark.parametrize("name", nut_figures.DRAWN)
def test_axes_have_words_and_units(name):
    with charts.house_style():
        figure = nut_figures.DRAWN[name]()
    for panel in figure.axes:
        assert panel.get_xlabel()
        assert panel.get_ylabel()
        assert panel.lines
    assert "40 × 10" in " ".join(text.get_text() for text in figure.texts).replace("\n", " ")


@pytest.mark.slow
def test_two_runs_give_the_same_bytes(tmp_path):
    for name in ("one", "two"):
        with charts.house_style():
            charts.save(nut_figures.distribution(), tmp_path, name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


@pytest.mark.slow
def test_the_curves_say_what_the_page_says():
    """Balls at the loaded end carry most; halves lift off near 2^1.5 preloads; four contacts cost more."""
    data = curves.distribution_curves()
    same, opposite = data.elastic.values()
    assert np.argmax(same) == 0
    assert np.ptp(opposite) < np.ptp(same)
    assert np.mean(same) == pytest.approx(data.rigid, rel=0.01)
    found = curves.preload_curves()
    lift = found.loads["double nut"].lift_off_load[0] / curves.preload()
    assert 2**1.5 < lift < 1.03 * 2**1.5
    single, double, oversize = (result.screw_torque for result in found.friction.values())
    assert np.all(oversize[1:40] > double[1:40])
    assert np.all(double[1:40] > single[1:40])
    assert oversize[-1] == pytest.approx(single[-1], rel=0.02)
    drag = curves.drag_curves(FrictionModel.reference())
    assert all(np.all(np.diff(torque) > -1e-4) for torque in drag.model.values())
