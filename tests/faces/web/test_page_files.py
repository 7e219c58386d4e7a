"""What can be taken away from the page: each file is parsed, and its numbers are those of the page."""

import csv
import functools
import io
import json
import re
import tomllib
import xml.etree.ElementTree as ET

import pypdf
import pytest
from typer.testing import CliRunner

from ballscrew.faces.cli.main import app
from support.documents import assert_same

pytestmark = pytest.mark.slow

DOUBLE = "rexroth-16x5x3-4-double"
STARTS = {
    "paper": "#A=paper&A.operation.axial_load=3+kN",
    "double nut": f"#A={DOUBLE}&A.operation.axial_load=2+kN",
    "axis with bearings": "#A=feed-axis",  # whose rigidity is one with that of the nut
}


@pytest.mark.parametrize("start", STARTS)
def test_what_is_taken_away_is_what_the_page_shows(visit, start, tmp_path):
    here = visit().open(STARTS[start])
    toml_and_json(here, tmp_path / "case.toml")
    csv_of_the_curve(here, tmp_path / "case.toml")
    drawing_as_svg(here)
    # each kind of report takes seconds, and comes from the same content
    report_as_pdf(here) if start == "double nut" else report_as_html(here)


def taken(here, kind):
    content = here.download(f"#downloads button:text-is('{kind}')")
    here.page.wait_for_selector(f"#download-words >> text={kind} saved", state="attached")
    return content


def toml_and_json(here, path):
    path.write_bytes(taken(here, "TOML"))
    assert tomllib.loads(path.read_text(encoding="utf-8"))["operation"]["axial_load"] in ("3 kN", "2 kN", "2.5 kN")
    printed = CliRunner().invoke(app, ["run", str(path), "--json"])
    assert printed.exit_code == 0
    document = json.loads(taken(here, "JSON"))
    assert_same(document, json.loads(printed.stdout))
    shown = here.numbers()["results"]
    assert shown == {name: document["results"][name] for name in shown}
    of_nut = "all => all.map((one) => [one.dataset.name, Number(one.value)])"
    of_page = dict(here.page.eval_on_selector_all("#stiffness data", of_nut))
    if "balls" in document.get("loads", {}):
        assert {"rigidity", "deflection", "remaining_preload", "lift_off_load"} <= of_page.keys()
    for name, value in of_page.items():
        assert functools.reduce(dict.get, name.split("-"), document["loads"]) == value, name


def rows_of(content):
    headings, *rows = csv.reader(io.StringIO(content.decode("utf-8")))
    assert all(len(row) == len(headings) for row in rows)
    return headings, [[cell if cell in ("", "true", "false") else float(cell) for cell in row] for row in rows]


def csv_of_the_curve(here, path):
    headings, rows = rows_of(taken(here, "CSV"))
    assert headings[:2] == ["screw_speed [rad/s]", "screw_torque [N m]"]
    assert len(rows) == 41
    speed, torque = rows[20][:2]
    path.write_text(re.sub(r'screw_speed = ".*"', f'screw_speed = "{speed!r} rad/s"', path.read_text(encoding="utf-8")))
    found = json.loads(CliRunner().invoke(app, ["run", str(path), "--json"]).stdout)
    assert torque == pytest.approx(found["results"]["screw_torque"], rel=1e-12)
    parts = [place for place, name in enumerate(headings) if name.startswith("contribution_")]
    assert sum(rows[20][place] for place in parts) == pytest.approx(torque, rel=1e-12)


def torque_in_a_report(here):
    return f"{here.numbers()['results']['screw_torque']:.4g}"


def report_as_pdf(here):
    reader = pypdf.PdfReader(io.BytesIO(taken(here, "PDF")))
    assert torque_in_a_report(here) in "".join(page.extract_text() for page in reader.pages)


def report_as_html(here):
    html = taken(here, "HTML").decode("utf-8")
    assert html.lower().startswith("<!doctype html>")
    assert torque_in_a_report(here) in html


def drawing_as_svg(here):
    root = ET.fromstring(taken(here, "SVG"))
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert "Contact of ball and screw" in "".join(root.itertext())


#: Charts whose parts are told apart by their colours alone.
AREAS = {"torque-chart": 6, "compare-chart": 6}
CHARTS = {"torque-chart": 41, "map-chart": (20, 10), "film-chart": 41, "pressure-chart": (41, 15), "compare-chart": 12}


def test_csv_and_svg_of_each_chart(visit):
    here = visit(scheme="dark").open(f"#A=paper&B={DOUBLE}&band=0")
    for chart in CHARTS:
        files_are_the_chart(here, chart)


def files_are_the_chart(here, chart):
    content = here.download(f"#{chart} button[aria-label^=CSV]").decode("utf-8")
    headings, *rows = csv.reader(io.StringIO(content))
    assert len(rows) in (CHARTS[chart] if isinstance(CHARTS[chart], tuple) else (CHARTS[chart],))
    assert all(len(row) == len(headings) for row in rows)
    if chart == "torque-chart":  # the operating point is in the middle of its curve
        middle = next(row for row in rows if float(row[0]) == pytest.approx(600, rel=0.02))
        assert float(middle[1]) == pytest.approx(here.numbers()["results"]["screw_torque"], rel=0.02)
        assert headings[:2] == ["speed of the screw (rpm)", "friction torque (N·m)"]
    if chart == "compare-chart":
        assert sum(float(row[1]) for row in rows if row[0].startswith("A, ")) == pytest.approx(
            here.numbers()["results"]["screw_torque"], rel=1e-9
        )
    here.page.evaluate(f"document.querySelector('#{chart} details').open = true")
    here.see(f"#{chart}").page.wait_for_selector(f"#{chart} table")
    shown = here.page.locator(f"#{chart} tbody tr >> nth=0").locator("th, td").all_inner_texts()
    if chart != "compare-chart":
        assert [cell for cell in shown if cell.isalpha()] == [cell for cell in rows[0] if cell.isalpha()]
        numbers, exact = ([float(cell) for cell in row if not cell.isalpha()] for row in (shown, rows[0]))
        assert numbers == pytest.approx(exact, rel=1e-4)
    picture = here.download(f"#{chart} button[aria-label^=SVG]").decode("utf-8")
    root = ET.fromstring(picture)
    words = "".join(root.itertext())
    assert (headings[0] if chart != "compare-chart" else "friction torque").split(" (")[0] in words
    # the list beside the chart is not in the picture, which names its areas and lines itself
    named = here.page.locator(f"#{chart} ul.legend li:has(.area, .line) > span:nth-child(2)").all_inner_texts()
    assert [name for name in named if name not in words] == []
    assert len(named) >= AREAS.get(chart, 0)
    assert "#1c2127" in picture  # dark ink for white paper, though the screen is dark
