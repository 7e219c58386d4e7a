"""While something moves the page computes by itself, with what the server would say, and asks once when it rests."""

import csv
import io
import math
import time

import pytest

from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.tracing.tape import CannotRecordError
from ballscrew.faces.page.starts import starts
from ballscrew.faces.web import modules
from ballscrew.faces.web.module_api import _answer
from ballscrew.faces.web.modules import Modules

from .drawn_charts import DRAWN, POINT

pytestmark = [pytest.mark.slow, pytest.mark.compiles]

#: Both compute the same formulas, compiled for other machines: so far apart in rounding, of the largest number.
CLOSE = 1e-12
ELASTIC = (
    "#A=hiwin-40-20k4&A.nut.type=double&A.bodies.screw_diameter=33+mm&A.nut.preload=2+kN&A.lubricant.grade=ISO+VG+100"
    "&A.lubricant.temperature=40+degC&A.operation.axial_load=2000+N&band=0"
)
PAPER = "#A=paper&A.lubricant.grade=ISO+VG+100&A.lubricant.viscosity=&A.lubricant.temperature=40+degC&band=0"
TORQUE = "#torque-chart"
#: The chart of the torque is that of the numbers beside it.
FOLLOWED = """() => {
  const { marks } = document.querySelector("#torque-chart .plot").drawn.figure;
  const torque = Number(document.querySelector("#numbers [data-name=screw_torque]").value);
  return Math.abs(marks.find(({ kind }) => kind === "point").y - torque) < 1e-12;
}"""


def ready(here):
    """The page has its module: the first one of a structure is made meanwhile."""
    here.page.locator(here.id("operation.axial_load")).focus()
    here.page.wait_for_selector("html[data-engine=ready]", state="attached", timeout=300_000)
    return here.settle()


def asked(here):
    return sum(one.endswith("/api/v1/answers") for one in here.requests)


def typed(here, field, text):
    """Type, and wait until the page shows what it makes of it; the answer of the server is held back."""
    here.page.locator(here.id(field)).fill(text)
    here.page.wait_for_selector("#results.moving")


def hold(here):
    """Hold the questions for answers back; they are here as they come."""
    held = []
    here.page.route("**/api/v1/answers", lambda route: held.append(route))
    return held


def wait_for(here, held):
    for _ in range(400):
        if held:
            return
        here.rest(25)
    raise AssertionError("nothing was asked")


def curve(here):
    """The numbers of the chart of the torque, with all their digits."""
    rows = list(csv.reader(io.StringIO(here.download(f"{TORQUE} button:text-is('CSV')").decode("utf-8-sig"))))
    return [[float(cell) for cell in row[:-1]] for row in rows[1:]]


def is_close(one, other):
    if one is None or other is None:
        return one == other
    return math.isclose(one, other, rel_tol=CLOSE, abs_tol=0)


@pytest.mark.parametrize(
    ("start", "changes"),
    [
        (PAPER, {"operation.axial_load": "3210", "lubricant.temperature": "55", "screw.lead": "6"}),
        (ELASTIC, {"operation.screw_speed": "432", "nut.preload": "1.5", "lubricant.temperature": "50"}),
    ],
    ids=["row", "elastic nut"],
)
def test_the_page_computes_what_the_server_would_say(visit, start, changes):
    here = ready(visit().open(start))
    here.page.locator(TORQUE).scroll_into_view_if_needed()
    here.rest(300)
    for field, text in changes.items():
        here.reveal(field)
        held = hold(here)
        before = here.numbers()
        typed(here, field, text)
        here.page.wait_for_function(FOLLOWED)
        own, own_curve = here.numbers(), curve(here)
        here.see("#contacts").rest(300)  # what is not in view is drawn once it is
        own |= {part: here.numbers()[part] for part in ("screw", "nut")}
        here.go("torque").rest(300)
        assert own["results"]["screw_torque"] != before["results"]["screw_torque"]
        wait_for(here, held)
        assert len(held) == 1
        held[0].continue_()
        here.page.unroute_all()
        here.settle()
        theirs = here.numbers()
        for part, numbers in theirs.items():
            scale = max((abs(n) for n in numbers.values() if n is not None), default=0) if part == "parts" else 0
            for name, number in numbers.items():
                found = own[part][name]
                assert is_close(found, number) or abs(found - number) <= CLOSE * scale, (field, part, name)
        here.page.wait_for_function(FOLLOWED)
        for row, other in zip(own_curve, curve(here), strict=True):
            largest = max(map(abs, other[1:]))
            assert row[0] == pytest.approx(other[0], rel=CLOSE)  # the axes are the same, too
            assert row[1:] == pytest.approx(other[1:], rel=CLOSE, abs=CLOSE * largest)


def test_one_request_once_a_slider_rests(visit):
    here = ready(visit().open())
    before = asked(here)
    torques = here.page.evaluate(
        """async () => {
          const slider = document.querySelector("#s-operation-axial_load"), found = [];
          for (let i = 0; i < 12; i++) {
            slider.value = String(2000 + 100 * i);
            slider.dispatchEvent(new Event("input"));
            await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
            found.push(document.querySelector("#numbers data[data-name=screw_torque]").value);
          }
          return found;
        }"""
    )
    assert len(set(torques)) > 6  # one frame may show several steps
    assert [*torques] == sorted(torques, key=float)
    here.settle()
    assert asked(here) == before + 1
    assert not here.page.locator("#results.moving").count()


def test_numbers_follow_the_diamond_and_its_field_when_it_is_let_go(visit):
    here = ready(visit().open())
    here.page.locator(TORQUE).scroll_into_view_if_needed()
    here.page.wait_for_function(DRAWN, arg="torque-chart")
    before, torque = asked(here), here.numbers()["results"]["screw_torque"]
    x, y = here.page.evaluate(POINT, "torque-chart")
    mouse = here.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 80, y, steps=3)
    here.page.wait_for_selector("#results.moving")
    assert here.numbers()["results"]["screw_torque"] > torque
    assert here.page.locator(here.id("operation.screw_speed")).input_value() == "600"
    here.rest(400)
    assert asked(here) == before
    mouse.up()
    here.rest(0).settle()
    assert asked(here) == before + 1
    assert float(here.page.locator(here.id("operation.screw_speed")).input_value()) > 600


def test_what_the_module_does_not_know_is_asked_of_the_server(visit):
    """Another law, a text that is no number, and a number beyond its bounds: as without a module."""
    here = ready(visit().open())
    for field, text in (("operation.axial_load", "4000 ± 100 N"), ("screw.lead", "-5")):
        held = hold(here)
        here.page.locator(here.id(field)).fill(text)
        wait_for(here, held)
        assert not here.page.locator("#results.moving").count()
        held[0].continue_()
        here.page.unroute_all()
        here.settle()
    assert "stale" in here.page.locator("#results").get_attribute("class")
    here.expected = ("422",)


def test_without_a_module_the_page_asks_for_everything(visit):
    here = visit()
    empty = {"state": "none", "reason": "needs a compiler", "structure": None, "solver": None, "oil": None}
    answer = {**empty, "values": {}, "places": {}, "axes": {}}
    here.page.route("**/api/v1/module", lambda route: route.fulfill(json=answer))
    here.open()
    before, torque = asked(here), here.numbers()["results"]["screw_torque"]
    here.type("operation.axial_load", "3000")
    assert asked(here) == before + 1
    assert here.numbers()["results"]["screw_torque"] < torque


def test_modules_of_the_server(server):
    """It is made once; its bytes are kept for ever under their name; nothing else is there."""
    case = starts()["paper"]["case"]
    while (found := server.post("module", {"case": case}).json())["state"] == "pending":
        time.sleep(0.2)
    assert (found["state"], found["values"]["axial_load"], found["values"]["lead"]) == ("ready", 4000, 0.005)
    assert found["places"]["screw.lead"]["input"] == "lead"
    code = server.get(f"modules/{found['structure']['file']}")
    assert (code.content[:4], "immutable" in code.headers["Cache-Control"]) == (b"\0asm", True)
    assert server.get("modules/none.wasm").status_code == 404
    policy = server.client.get("/").headers["Content-Security-Policy"].split("; ")
    assert "script-src 'self' 'wasm-unsafe-eval'" in policy


def test_places_are_fields_that_nothing_else_follows_from(server):
    """A preload as a share of the rating, a speed of the nut, and a screw of the catalogue."""
    case = starts()["paper"]["case"]

    def places(**tables):
        while (found := server.post("module", {"case": {**case, **tables}}).json())["state"] == "pending":
            time.sleep(0.2)
        return set(found["places"])

    travelling = {**case["operation"], "screw_speed": "3 m/min"}
    assert places() >= {"operation.screw_speed", "screw.lead", "screw.loaded_balls", "lubricant.viscosity"}
    assert not {"operation.screw_speed", "screw.lead"} & places(operation=travelling)
    nut = {"type": "double", "preload": "7 %"}
    assert not {"nut.preload", "screw.lead"} & places(nut=nut)
    assert "nut.preload" in places(nut={**nut, "preload": "1 kN"})


def test_without_a_compiler_there_is_no_module(monkeypatch):
    monkeypatch.setattr(kernel, "available", lambda: False)
    found = _answer(Modules(), starts()["paper"]["case"])
    assert (found["state"], found["structure"]) == ("none", None)
    assert "ballscrew[fast]" in found["reason"]


def test_what_cannot_be_recorded_has_no_module(monkeypatch):
    """It is not tried again and again."""
    tried = []

    def failing(*_):
        tried.append(1)
        raise CannotRecordError("no such step")

    monkeypatch.setattr(modules, "module_of", failing)
    monkeypatch.setattr(modules.kernel, "kept", lambda _: None)
    found, case = Modules(), starts()["paper"]["case"]
    while (state := _answer(found, case))["state"] == "pending":
        time.sleep(0.01)
    assert (state["state"], state["reason"], _answer(found, case)["state"]) == ("none", "no such step", "none")
    assert len(tried) == 1
