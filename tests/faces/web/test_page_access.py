"""The page for everybody: keyboard, screen readers, small and large letters, light and dark, on paper."""

import io
import itertools
from pathlib import Path

import axe_playwright_python
import pytest
from pypdf import PdfReader

pytestmark = pytest.mark.slow

DOUBLE = "rexroth-16x5x3-4-double"
AXE = (Path(axe_playwright_python.__file__).parent / "axe.min.js").read_text(encoding="utf-8")
SIZES = {"desktop": {"width": 1360, "height": 900}, "phone": {"width": 390, "height": 844}}
OPEN_ALL = "for (const one of document.querySelectorAll('details')) one.open = true"
FOCUS = "document.activeElement.id || document.activeElement.className || document.activeElement.textContent"


def violations(here):
    """What axe finds, with the places: an evaluation by the debugger is not stopped by the policy of the page."""
    here.page.evaluate(f"{AXE}; 0")
    found = here.page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    return [(one["id"], one["impact"], [node["target"] for node in one["nodes"]][:3]) for one in found]


@pytest.mark.parametrize(("size", "scheme"), [("desktop", "dark"), ("phone", "light")])
def test_axe_finds_nothing(visit, size, scheme):
    here = visit(**SIZES[size], scheme=scheme, expected=("status of 422",)).open(
        f"#A={DOUBLE}&A.operation.axial_load=2+kN&B=paper&band=1&show=A"
    )
    here.page.wait_for_selector("#band-words >> text=95 %")
    here.see("#models-button")
    here.page.locator("#models-button").click()
    here.page.wait_for_selector("#models table")
    here.go("torque.input")
    here.page.wait_for_selector('#over-input[aria-busy="false"]')
    here.page.evaluate(OPEN_ALL)
    here.page.locator("#f-screw-lead").focus()  # its help
    here.rest(200)
    assert violations(here) == []
    here.type("operation.axial_load", "nonsense")
    here.page.wait_for_selector(".field.wrong")
    assert violations(here) == []  # these show what they did


def test_everything_is_reached_by_tab_and_is_seen_to_be(visit):
    here = visit().open(f"#A={DOUBLE}&B=paper")
    here.see("#over-input").page.wait_for_selector("#over-input-of option", state="attached")
    here.page.evaluate(OPEN_ALL)
    here.page.wait_for_selector('#over-input[aria-busy="false"]', state="attached")
    here.rest(200)
    reached, hidden = [], []
    count = here.page.evaluate(
        """[...document.querySelectorAll("a[href], button:enabled, input, select, summary, [tabindex='0']")]
           .filter((one) => one.checkVisibility()).length"""
    )
    here.page.evaluate("document.body.focus()")
    for _ in range(count):
        here.page.keyboard.press("Tab")
        mark = here.page.evaluate(
            """() => { const one = document.activeElement;
              const style = getComputedStyle(one), box = one.getBoundingClientRect();
              one.dataset.count = Number(one.dataset.count ?? 0) + 1;
              const outlined = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2;
              const seen = outlined
                && box.bottom > 0 && box.top < innerHeight && box.right > 0;
              return [one.localName, one.id || one.textContent.slice(0, 30), seen]; }"""
        )
        reached.append(mark[1])
        if not mark[2]:
            hidden.append(mark)
    assert hidden == []
    assert here.page.evaluate("document.querySelectorAll('[data-count]').length") == count
    assert reached[0] == "Skip to the results"
    for name in (
        "start",
        "f-operation-axial_load",
        "u-operation-axial_load",
        "system",
        "share",
        "to-checks",
        "band",
    ):
        assert name in reached


def test_the_skip_link_skips_and_leaves_the_state_in_the_address(visit):
    here = visit().open("#A=paper&A.operation.axial_load=1234+N")
    here.page.keyboard.press("Tab")
    here.page.keyboard.press("Enter")
    here.settle()
    assert "1234" in here.page.url
    assert here.page.input_value("#f-operation-axial_load") == "1234"
    here.page.keyboard.press("Tab")
    assert here.page.evaluate("document.querySelector('#results').contains(document.activeElement)")


def test_focus_stays_when_the_form_is_made_anew(visit):
    here = visit().open()
    for field, value in (("#u-operation-axial_load", "kN"), ("#f-model-name", "olaru2005"), ("#start", DOUBLE)):
        here.page.evaluate(OPEN_ALL)
        here.page.locator(field).focus()
        here.page.locator(field).select_option(value)
        here.settle()
        assert "#" + here.page.evaluate(FOCUS) == field
    here.page.locator("#system").focus()
    here.page.locator("#system").select_option("inch")
    here.settle()
    assert here.page.evaluate(FOCUS) == "system"
    here.page.locator("#add").focus()
    here.page.keyboard.press("Enter")
    here.settle()
    assert here.page.evaluate(FOCUS) == "add"


def test_results_and_faults_are_said(visit):
    here = visit(expected=("status of 422",)).open()
    assert here.page.locator("#said").get_attribute("role") == "status"
    here.page.evaluate(
        """() => { window.heard = []; const said = document.querySelector("#said");
          new MutationObserver(() => heard.push(said.textContent)).observe(said, { childList: true }); }"""
    )
    here.page.locator("#f-operation-axial_load").focus()
    for _ in range(8):
        here.page.keyboard.press("ArrowUp")
    here.page.wait_for_function("() => heard.length")
    here.rest(1500)
    heard = here.page.evaluate("heard")
    assert 1 <= len(heard) <= 2  # not at every key
    assert heard[-1].replace("\u00a0", " ") == here.text("#summary")
    here.page.evaluate("heard.length = 0")
    here.page.locator("#f-operation-axial_load").select_text()
    for letter in "nonsense":
        here.page.keyboard.type(letter)
        here.rest(100)
    here.page.wait_for_function("() => heard.at(-1)?.includes('nonsense')")
    assert "axial load" in here.text("#faults")
    heard = here.page.evaluate("heard")
    assert len(heard) <= 2
    assert here.text("[data-path='operation.axial_load'] .fault") in heard[-1]


def test_headings_tables_and_labels(visit):
    here = visit().open("#A=paper&B=paper&band=0")
    here.page.evaluate(OPEN_ALL)
    levels = here.page.evaluate("[...document.querySelectorAll('h1, h2, h3')].map((one) => Number(one.localName[1]))")
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in itertools.pairwise(levels))
    wrong = here.page.evaluate(
        """() => [...document.querySelectorAll("th")].filter((one) => !["col", "row"].includes(one.scope)).length
          + [...document.querySelectorAll("table")].filter((one) => !one.caption?.textContent).length
          + [...document.querySelectorAll("section, form, nav")].filter((one) =>
              !one.ariaLabel && !one.getAttribute("aria-labelledby")).length"""
    )
    assert wrong == 0
    names = here.page.locator("#results button, #results summary").evaluate_all(
        """all => all.map((one) => one.ariaLabel ?? (one.hasAttribute("aria-labelledby")
          ? one.getAttribute("aria-labelledby").split(" ").map((id) => document.getElementById(id).textContent).join()
          : one.textContent))"""
    )
    assert len(names) == len(set(names))  # also those of the charts, one below the other
    groups = here.page.locator("[data-path$='.young_modulus'] input").evaluate_all(
        "all => all.map((one) => one.closest('fieldset').querySelector('legend').textContent)"
    )
    assert len(groups) == len(set(groups)) == 3
    for field in here.page.locator("#form input, #form select, header select").all():
        assert field.evaluate("one => one.labels.length === 1 || Boolean(one.ariaLabel)")


#: The narrowest and the widest; 680 is a screen of 1360 with letters of 200 %.
WIDTHS = [320, 680, 1024]


@pytest.mark.parametrize("width", WIDTHS)
def test_no_scrolling_to_the_side(visit, width):
    here = visit(width=width, height=800)
    here.open(f"#A={DOUBLE}&B=paper&C=hiwin-40-16k5&D=paper&band=1")
    here.page.evaluate(OPEN_ALL)
    here.page.wait_for_selector("#band-words >> text=95 %")
    assert here.page.evaluate("document.documentElement.scrollWidth") <= width
    outside = here.page.evaluate(
        """() => [...document.querySelectorAll("main *, header *")].filter((one) => one.checkVisibility()
          && one.getBoundingClientRect().right > innerWidth + 1
          && !one.closest("#views, .scroll, .drawing, .plot, .hidden"))
          .map((one) => `${one.localName}.${one.className} ${one.textContent.slice(0, 30)}`)"""
    )
    assert outside == []


def test_the_answer_is_in_sight_of_who_types_on_a_phone(visit):
    here = visit(**SIZES["phone"]).open()
    here.page.locator("#case-column > summary").click()
    here.page.locator("#f-operation-axial_load").focus()
    here.page.keyboard.press("ArrowUp")
    here.settle()
    box = here.page.locator("#summary").bounding_box()
    assert 0 <= box["y"] <= SIZES["phone"]["height"] - box["height"] + 1


def test_nothing_moves_where_motion_is_not_wanted(visit):
    here = visit(motion="reduce").open()
    here.type("operation.axial_load", "3000")
    assert here.page.evaluate("document.getAnimations().length") == 0


def contrast(one, other):
    """The contrast of two colours ``rgb(…)`` after WCAG."""

    def luminance(colour):
        parts = [int(part) / 255 for part in colour.strip("rgba()").split(",")[:3]]
        light = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]

    bright, dark = sorted([luminance(one), luminance(other)], reverse=True)
    return (bright + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_letters_of_charts_and_drawing_can_be_read(visit, scheme):
    here = visit(scheme=scheme, height=4000).open()
    here.see("#drawing")
    here.page.wait_for_selector("#drawing text")
    back = here.page.evaluate("getComputedStyle(document.querySelector('section')).backgroundColor")
    fills = here.page.evaluate(
        """async () => {
          const { ofScreen } = ballscrewModules["palette.js"];
          const drawing = [...document.querySelectorAll("#drawing text")].filter((one) => one.textContent);
          const rgb = (hex) => `rgb(${[1, 3, 5].map((start) => parseInt(hex.slice(start, start + 2), 16)).join(", ")})`;
          const charts = ["ink", "soft", "accent", "second"].map((name) => rgb(ofScreen()[name]));
          return [...charts, ...drawing.map((one) => getComputedStyle(one).fill)];
        }"""
    )
    assert len(fills) > 10
    assert min(contrast(fill, back) for fill in set(fills)) > 4.5


def test_changing_to_dark_redraws(visit):
    here = visit(scheme="light").open()
    here.page.locator("#torque-chart").scroll_into_view_if_needed()
    here.page.wait_for_selector("#torque-chart .plot[data-drawn]")
    ink = "document.querySelector('#torque-chart canvas').toDataURL()"
    before = here.page.evaluate(ink)
    here.page.emulate_media(color_scheme="dark")
    here.page.wait_for_function(f"(before) => {ink} !== before", arg=before)
    after = here.page.evaluate(ink)
    assert before != after


#: The darkest colour that a chart on paper has: that of its letters.
DARKEST = """() => {
  const canvas = document.querySelector("#pressure-chart canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let best = [255, 255, 255];
  for (let at = 0; at < data.length; at += 4) {
    const one = [...data.slice(at, at + 3)];
    if (data[at + 3] === 255 && one[0] + one[1] + one[2] < best[0] + best[1] + best[2]) best = one;
  }
  return best;
}"""


def test_on_paper_it_is_a_sheet(visit):
    here = visit(scheme="dark").open(f"#A={DOUBLE}&A.operation.axial_load=2+kN")
    here.page.emulate_media(media="print", color_scheme="dark")
    here.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    here.rest(300)
    visible = "[...document.querySelectorAll(`{}`)].filter((one) => one.checkVisibility()).length"
    assert here.page.evaluate(visible.format("button, nav, .tools, #band")) == 0
    assert here.page.evaluate(visible.format("[data-path='operation.axial_load'] input")) == 1
    assert here.page.evaluate(visible.format("[data-path='limits.static_safety']")) == 0  # nothing given there
    assert here.page.evaluate(visible.format(".plot[data-drawn]")) >= 1
    darkest = here.page.evaluate(DARKEST)
    assert contrast(f"rgb({', '.join(map(str, darkest))})", "rgb(255, 255, 255)") > 7
    pages = PdfReader(io.BytesIO(here.page.pdf(format="A4"))).pages
    assert "friction torque" in " ".join(page.extract_text() for page in pages)
