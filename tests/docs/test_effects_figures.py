"""The figures of the effects: units on the axes, the case in the caption, nothing clipped."""

import importlib.util
import re
from pathlib import Path

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from ballscrew.questions.shared import charts
from effect_study.cases import CASES, effects
from effect_study.effect_figures import DRAWN
from support.pictures import clipped

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module", params=DRAWN)
def name(request):
    return request.param


@pytest.fixture(scope="module")
def figure(name):
    """Laid out as for a PNG."""
    with charts.house_style():
        drawn = DRAWN[name](CASES)
        FigureCanvasAgg(drawn)
        drawn.draw_without_rendering()
    return drawn


def test_axes_name_their_units(name, figure):
    units = r"\((rpm|N|N m|mm|mm/s|1)\)$"
    for panel in figure.axes:
        if panel.get_label() != "<colorbar>":
            assert re.search(units, panel.get_xlabel())
        if name != "effects_steps":  # words there
            assert re.search(units, panel.get_ylabel())


def test_caption_states_the_case(figure):
    caption = " ".join(" ".join(text.get_text() for text in figure.texts).split())
    assert "56 balls" in caption
    assert "E′ 226 GPa" in caption
    assert "Assumed" in caption
    assert "_m " not in caption  # indices are set low


def test_caption_leaves_out_what_varies():
    for name, varied, stated in (
        ("effects_parts_over_speed", "n =", "F ="),
        ("effects_light_load", "F =", "n ="),
    ):
        with charts.house_style():
            caption = DRAWN[name](CASES).texts[-1].get_text()
        assert varied not in caption.replace("\N{NO-BREAK SPACE}", " ")
        assert stated in caption.replace("\N{NO-BREAK SPACE}", " ")


def test_panels_are_titled(figure):
    for panel in figure.axes:
        assert panel.get_title(loc="left") or panel.get_label() == "<colorbar>"


def test_nothing_is_clipped(figure):
    assert clipped(figure) == []


def test_the_bars_end_at_the_torque():
    with charts.house_style():
        figure = DRAWN["effects_steps"](CASES)
    for panel, case in zip(figure.axes, CASES.values(), strict=True):
        ends = [bar.get_x() + bar.get_width() for bar in panel.containers[-1]]
        assert ends == pytest.approx([effect.torque for effect in effects(case)])


def test_skid_is_shaded():
    with charts.house_style():
        figure = DRAWN["effects_light_load"](CASES)
    for panel in figure.axes:
        assert "the ball skids" in panel.get_legend_handles_labels()[1]


def test_the_slip_fields_fill_their_ellipses():
    with charts.house_style():
        figure = DRAWN["effects_slip_fields"](CASES)
    panels = [panel for panel in figure.axes if panel.images]
    assert len(panels) == 4
    for panel in panels:
        left, right, bottom, top = panel.images[0].get_extent()
        assert right == -left == pytest.approx(panel.patches[0].width / 2)
        assert top == -bottom == pytest.approx(panel.patches[0].height / 2)


@pytest.mark.slow
def test_two_runs_give_the_same_bytes(tmp_path):
    for name in ("one", "two"):
        with charts.house_style():
            charts.save(DRAWN["effects_slip_fields"](CASES), tmp_path, name)
    for kind in ("svg", "png"):
        assert (tmp_path / f"one.{kind}").read_bytes() == (tmp_path / f"two.{kind}").read_bytes()


@pytest.fixture(scope="module")
def page():
    """The script that writes what the page shows."""
    spec = importlib.util.spec_from_file_location("effect_tables", ROOT / "docs" / "effect_tables.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_all_the_page_shows_is_written(page):
    """By their names: how each is drawn is what the other tests are about."""
    text = (ROOT / "docs" / "effects.md").read_text(encoding="utf-8")
    shown = set(re.findall(r"figures/effects/([\w.]+)|include: effects/([\w.]+)", text))
    shown = {figure or table for figure, table in shown}
    assert {f"{name}.svg" for name in DRAWN} <= shown
    assert shown <= set(page.parts())


@pytest.mark.slow
def test_the_numbers_of_the_pages_are_those_that_are_made(page, monkeypatch):
    """All on a page are known, and all known ones stand on a page: none is computed for nothing."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    others = [importlib.import_module(name) for name in ("validation_tables", "theory_numbers", "errata_page")]
    made = {name for each in (page, *others) for name in each.numbers()}
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / "docs").rglob("*.md")]
    shown = {name for text in texts for name in re.findall(r"<!--= (\w+)-->", text)}
    assert shown - made == set()
    assert made - shown == set()
