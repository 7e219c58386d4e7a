"""The check of written pictures itself: what it must find."""

import io
import re

import pytest

from ballscrew.questions.shared import charts
from support import pictures


def svg(place, **options):
    """A curve through the middle of a panel, and a legend at a place of the panel."""
    with charts.house_style():
        figure, (panel, _) = charts.new_figure("A caption: F = 4000 N.")
        panel.plot([0, 1, 2], [0, 1, 2], label="friction torque M$_S$")
        panel.set_xlabel("screw speed n (rpm)")
        panel.set_ylabel("friction torque (N m)")
        legend = panel.legend(bbox_to_anchor=place, borderaxespad=0, **options)
        legend.set_in_layout(place[0] > -1)  # or room is made for it
        figure.get_layout_engine().set(w_pad=1.0, h_pad=0.5)
        written = io.BytesIO()
        charts.save_as(figure, written, "svg")
    return written.getvalue().decode()


def test_what_a_picture_shows():
    found = pictures.drawn(svg((0, 1), loc="upper left"))
    assert len(found.panels) == 2
    for words in (
        "screw speed n (rpm)",
        "friction torque (N m)",
        "friction torque M_S",
        "A caption: F = 4000 N.",
        "2.0",
    ):
        assert words in found.text
    (line,) = found.panels[0].lines
    assert line.shape == (3, 2)
    assert not found.panels[1].lines


@pytest.mark.parametrize(
    ("place", "loc", "covered"),
    [
        ((-0.01, 0.5), "center right", "a legend covers: "),  # the numbers of the vertical axis
        ((0.5, -0.1), "center", "a legend covers: "),  # those of the horizontal one
        ((-0.02, 0.9), "center left", "a legend covers"),  # the axis alone, or its numbers too
        ((0.5, 0.5), "center", "a legend covers a curve"),
        ((-1.5, 0.5), "center", "a legend is cut off"),
    ],
)
def test_a_legend_that_covers_something_is_found(place, loc, covered):
    with pytest.raises(AssertionError, match=covered):
        pictures.drawn(svg(place, loc=loc))


def test_a_text_beyond_the_page_is_found():
    written = svg((0, 1), loc="upper left")
    moved = re.sub(r"(<!-- screw speed n \(rpm\) -->\s*<g [^>]*translate\()[\d.]+", r"\g<1>-40", written)
    assert moved != written
    with pytest.raises(AssertionError, match=r"is cut off: screw speed n \(rpm\)"):
        pictures.drawn(moved)


def test_a_picture_without_anything_is_found():
    with charts.house_style():
        figure, _ = charts.new_figure("nothing")
        written, pixels = io.BytesIO(), io.BytesIO()
        charts.save_as(figure, written, "svg")
        figure.clear()
        charts.save_as(figure, pixels, "png")
    with pytest.raises(AssertionError, match="it shows nothing"):
        pictures.drawn(written.getvalue().decode())
    with pytest.raises(AssertionError, match="it shows nothing"):
        pictures.size(pixels.getvalue())
