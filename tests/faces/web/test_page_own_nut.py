"""The card of a nut of one's own: few numbers in, estimates with their bands beneath, and a design of them."""

import pytest

from support.commands import ROOT

from .test_page_duty import case_of

pytestmark = pytest.mark.slow

EXAMPLES = ROOT / "examples"
#: A preloaded nut of elastic bodies, where its preload is asked for.
ELASTIC = "#A=paper&A.nut.type=double&A.nut.preload=3+kN&A.bodies.same_side=true&band=0&view=measure.service"
#: Contrast of the words of an element and its ground, by WCAG 2.
CONTRAST = """(selector) => {
  const style = getComputedStyle(document.querySelector(selector));
  const light = (colour) => {
    const parts = colour.match(/[\\d.]+/g).slice(0, 3).map((one) => one / 255);
    const [r, g, b] = parts.map((one) => (one <= 0.04045 ? one / 12.92 : ((one + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const [low, high] = [light(style.color), light(style.backgroundColor)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}"""


def opened(here, **typed):
    here.go("choose.own")
    for name, value in typed.items():
        here.page.fill(f"#own-nut-{name}", value)
    return here.page


def row(page, label):
    """The cells of an estimate by the label of its field."""
    line = page.locator("#own-nut tbody tr").filter(has=page.locator("th", has_text=label))
    return [cell.inner_text().replace("\N{NO-BREAK SPACE}", " ") for cell in line.locator("td").all()]


def test_few_numbers_become_a_design(visit):
    here = visit().open("#A=paper&band=0")
    page = opened(here, nominal_diameter="40", lead="10", turns="2x2.5", dynamic_load_rating="52.7", name="40x10")
    page.wait_for_selector("#own-nut table")
    value, low, high, source = row(page, "ball diameter")
    assert (value, low, high) == ("5.696 mm", "5.24 mm", "7.063 mm")
    assert "ISO 3408-5" in source
    page.evaluate("scrollTo(0, document.body.scrollHeight)")
    boxes = [page.locator(f"#own-nut {part}").bounding_box() for part in ("form", "table")]
    assert boxes[0]["y"] + boxes[0]["height"] <= boxes[1]["y"]  # the form does not lie over its table
    page.click("#own-nut-use")
    page.wait_for_selector("#own-nut >> text=Added as design A: 40x10.")
    page.wait_for_function("""() => {
      const { top, bottom } = document.querySelector("#summary").getBoundingClientRect();
      return top >= 0 && bottom <= innerHeight;
    }""")
    # the form of the design, which is made anew after the words are there
    page.wait_for_function("[...document.querySelectorAll('input')].some((one) => one.value === '5.696')")


def test_numbers_that_do_not_go_together_are_named(visit):
    here = visit().open("#A=paper&band=0")
    here.expected = ("status of 422",)
    page = opened(here, nominal_diameter="40", lead="10", turns="5", ball_diameter="6", dynamic_load_rating="5.27")
    page.wait_for_selector("#own-nut .warning >> text=check its unit")
    page.fill("#own-nut-ball_diameter", "")
    page.fill("#own-nut-starts", "1000000")
    page.wait_for_selector("#own-nut .fault >> text=leaves no room for balls")
    assert "0 m" not in page.inner_text("#own-nut .fault")  # that of a ball that nobody has typed
    page.fill("#own-nut-starts", "")
    page.fill("#own-nut-preload", "500 %")
    page.wait_for_selector("#own-nut .fault >> text=must be at most")
    assert page.inner_text("#own-nut .fault").startswith("preload (own nut): ")
    page.fill("#own-nut-starts", "")
    page.fill("#own-nut-ball_diameter", "60")
    page.wait_for_selector("#own-nut .fault")
    assert page.locator("#own-nut-use").is_disabled()


def test_the_first_view_says_that_it_shows_an_example(visit):
    here = visit().open("#view=torque&band=0").settle()
    assert here.text("#example").endswith("the screw of Olaru et al. (2005).")
    page = opened(here, nominal_diameter="40", lead="10", turns="5", dynamic_load_rating="52.7", name="my nut")
    page.click("#own-nut-use:enabled")
    page.wait_for_selector("#example", state="hidden")
    here.go("torque")
    assert page.locator("#start option:checked").inner_text() == "my nut"


def test_a_fit_takes_elastic_bodies(visit, tmp_path):
    here = visit().open("#A=paper&band=0")
    page = opened(here, nominal_diameter="40", lead="10", turns="5", dynamic_load_rating="52.7")
    page.click("#own-nut-use:enabled")
    page.wait_for_selector("#own-nut >> text=Added as design A")
    here.go("measure.fit").settle()
    heading, *rows = (EXAMPLES / "rig_log.csv").read_text(encoding="utf-8").splitlines()
    log = tmp_path / "log.csv"
    log.write_text("\n".join([heading, *rows[::40]]), encoding="utf-8")
    page.set_input_files("#calibrate-log", log)
    page.click("#calibrate-fit:enabled")
    page.wait_for_selector("#calibration .sheet data, #calibration .fault")
    assert not page.locator("#calibration .fault").count()


def test_a_service_of_elastic_bodies_offers_rigid_ones(visit):
    """The fault has a button that takes the bodies out, and the form a box that has them back."""
    here = visit().open(ELASTIC)
    here.expected = ("status of 422",)
    page = here.page
    for name in ("new", "worn"):
        page.set_input_files(f"#service-{name}", EXAMPLES / f"nut_{name}.csv")
    page.click("#service-start:enabled")
    page.click("#service .fault button")
    page.wait_for_selector("#service .fault", state="detached")
    here.settle()
    assert "bodies" not in case_of(here)
    here.go("torque").reveal("bodies.nut_outer_diameter")
    assert not page.is_checked("#elastic")
    page.check("#elastic")
    here.settle()
    assert case_of(here)["bodies"] == {}
    page.uncheck("#elastic")
    here.settle()
    assert "bodies" not in case_of(here)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_button_that_is_disabled_can_be_read(visit, scheme):
    here = visit(scheme=scheme).open("#A=paper&band=0").go("choose.own")
    here.page.wait_for_selector("#own-nut-use:disabled")
    assert here.page.evaluate(CONTRAST, "#own-nut-use") >= 4.5
