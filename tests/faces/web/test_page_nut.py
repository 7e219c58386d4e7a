"""The pictures of the nut: what they show is what the API says, and each ball is where the model has it."""

import csv
import io
import re
import urllib.parse
from pathlib import Path

import numpy as np
import pytest

import ballscrew
from ballscrew.cases.case_files import case_file
from ballscrew.physics.friction.loaded_balls import ball_angles
from ballscrew.questions.shared.charts import GROWING

from .test_page_access import violations
from .test_page_duty import case_of

pytestmark = pytest.mark.slow

DOUBLE = "rexroth-16x5x3-4-double"
#: Balls of the side view: place along the screw and across it in m, number, load in N.
BALLS = """() => { const svg = document.querySelector("#nut-picture svg"), f = Number(svg.dataset.scale);
  return [...svg.querySelectorAll("circle[data-place]")]
    .sort((a, b) => a.dataset.place - b.dataset.place)
    .map((one) => [Number(one.getAttribute("cx")) / f, Number(one.getAttribute("cy")) / f,
                   one.dataset.load === undefined ? null : Number(one.dataset.load)]); }"""


def balls(here):
    return here.page.evaluate(BALLS)


def value(here, name):
    return float(here.page.locator(f"#nut-extremes [data-name={name}]").get_attribute("value"))


def rows_of_chart(here):
    """The numbers of the unrolled nut, as its button saves them."""
    here.see("#nut-extremes").page.locator("#nut-unrolled").scroll_into_view_if_needed()
    here.page.wait_for_selector("#nut-unrolled .plot[data-drawn]")
    text = here.download("#nut-unrolled button:text-is('CSV')").decode()
    return list(csv.reader(io.StringIO(text)))[1:]


def test_the_balls_of_a_rigid_double_nut_have_a_dot_for_each_half(visit):
    here = visit().open("#" + urllib.parse.urlencode({"A": DOUBLE, "A.tables": '{"bodies": null}', "band": "0"}))
    here.see("#balls-chart").page.locator("#balls-chart").scroll_into_view_if_needed()
    here.page.wait_for_selector("#balls-chart .plot[data-drawn]")
    curves = here.page.evaluate("document.querySelector('#balls-chart .plot').drawn.figure.marks")
    assert {(curve["style"], *curve["x"]) for curve in curves} == {("dots", 1, 2)}
    assert all(max(curve["y"]) > 0 for curve in curves)


def test_a_double_nut_between_elastic_bodies(visit, server):
    here = visit().open(f"#A={DOUBLE}&A.operation.axial_load=2+kN&A.nut.spacing=9+mm&A.bodies.swelling=true&band=0")
    case = case_of(here)
    loads = server.post("run", {"case": case}).json()["loads"]
    expected = np.maximum(loads["balls"]["forward_load"], loads["balls"]["backward_load"])
    found = balls(here)
    assert [load for *_, load in found] == expected.tolist()
    assert np.ptp(expected) > 0.1 * expected.max()  # so that a mistaken order is seen
    # places: those of the model, to the hundredths of a unit of the drawing
    screw = case_file.build(case).screw
    angles = ball_angles(screw)
    across = screw.pitch_circle_diameter / 2 * np.cos(angles)
    along = angles * screw.lead / (2 * np.pi)
    x, y, _ = np.array(found).T
    assert x - x[0] == pytest.approx(along, abs=1e-5)
    assert y[0] - y == pytest.approx(across - across[0], abs=1e-5)
    half = len(expected) // 2
    for flank, name in (("loaded_flank", 1), ("relieved_flank", 2)):
        assert {one: value(here, f"{one}-{name}") for one in ("least", "mean", "greatest")} == pytest.approx(
            loads[flank]["load"], rel=1e-12
        )
    numbers = rows_of_chart(here)
    assert [int(row[1]) for row in numbers] == [1] * half + [2] * half
    assert [float(row[2]) for row in numbers] == pytest.approx(np.degrees(angles % (2 * np.pi)), abs=1e-6)
    assert [float(row[3]) for row in numbers] == pytest.approx(1000 * along, abs=1e-6)
    assert [max(float(row[4]), float(row[5])) for row in numbers] == pytest.approx(expected, rel=1e-12)
    label = here.page.locator("#nut-picture svg").first.get_attribute("aria-label").replace("\u00a0", " ")
    assert f"{2 * half} balls carry" in label
    assert "axial load 2000 N" in label
    assert "their distance is not given" not in here.text("#nut-picture")
    assert violations(here) == []


def test_what_is_alike_and_what_is_assumed_is_said(visit, server):
    here = visit(width=390, height=844, scheme="dark").open(
        "#A=paper&A.nut.type=double&A.nut.preload=2+kN&A.operation.axial_load=-1+kN&band=0"
    )
    loads = server.post("run", {"case": case_of(here)}).json()["loads"]["balls"]
    greater = np.maximum(loads["forward_load"], loads["backward_load"])
    found = [load for *_, load in balls(here)]
    assert found == np.repeat(greater, len(found) // 2).tolist()
    words = here.see("#nut-picture").text("#nut-picture")
    assert "All balls of a half carry the same" in words
    assert "their distance is not given" in words
    ends = here.page.locator("#nut-picture .load polygon").evaluate("one => one.getBBox().x")
    line = here.page.locator("#nut-picture .load line").evaluate("one => one.getBBox().x")
    assert ends > line  # a positive load acts against the motion of a positive speed, to the left
    # inches, without a request
    here.page.locator("#system").select_option("inch")
    here.settle()
    assert re.search(r"\d in\b", here.text("#nut-picture"))
    assert "(lbf)" in here.text("#nut-picture")
    assert violations(here) == []


def test_spacer_balls_and_four_contacts(visit, server):
    here = visit().open(f"#A={DOUBLE}&A.nut.spacer_balls=true&A.screw.loaded_balls=21&band=0")
    case = case_of(here)
    screw = case_file.build(case).screw
    found = balls(here)
    assert len(found) == 2 * 21
    assert sum(load is not None for *_, load in found) == len(ball_angles(screw)) == 2 * 10
    assert here.page.locator("#nut-picture .spacer-ball").count() == 22
    kinds = [row[6] for row in rows_of_chart(here)]
    assert kinds[:5] == ["ball", "spacer ball"] * 2 + ["ball"]
    here.choose("nut.type", "oversize-balls")
    here.type("nut.preload", "300 N")
    here.page.wait_for_selector("#nut-extremes [data-name=least-1]")
    loads = server.post("run", {"case": case_of(here)}).json()["loads"]["balls"]
    assert value(here, "greatest-1") == max(*loads["forward_load"], *loads["backward_load"])
    assert here.page.locator("#nut-extremes [data-name=least-2]").count() == 0


def test_a_screw_without_a_nut(visit, server):
    here = visit().open("#A=paper&band=0")
    found = server.post("run", {"case": case_of(here)}).json()
    assert {load for *_, load in balls(here)} == {found["results"]["contact_load"]}
    assert len(balls(here)) == found["inputs"]["screw"]["loaded_balls"]
    assert value(here, "least-1") == found["results"]["contact_load"]
    here.type("screw.loaded_balls", "1500")
    assert "more balls than can be told apart" in here.text("#nut-picture")
    assert not here.page.locator("#nut-unrolled").is_visible()


def test_colours_are_those_of_the_figures():
    (folder,) = ballscrew.__path__
    script = (Path(folder) / "faces" / "page" / "ball_places.js").read_text(encoding="utf-8")
    found = re.search(r"^export const COLOURS = \[(.*)\];$", script, re.MULTILINE)
    assert re.findall("#[0-9A-F]{6}", found[1]) == list(GROWING)
