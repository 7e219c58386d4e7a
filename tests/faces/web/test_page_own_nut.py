"""The card of a nut of one's own: few numbers in, estimates with their bands beneath, and a design of them."""


def opened(here, **typed):
    here.go("start.own")
    for name, value in typed.items():
        here.page.fill(f"#own-nut-{name}", value)
    return here.page


def row(page, label):
    """The cells of an estimate by the label of its field."""
    line = page.locator("#own-nut tbody tr").filter(has=page.locator("th", has_text=label))
    return [cell.inner_text().replace("\N{NO-BREAK SPACE}", " ") for cell in line.locator("td").all()]


def test_few_numbers_become_a_design(visit):
    here = visit().open("#A=paper")
    page = opened(here, nominal_diameter="40", lead="10", turns="2x2.5", dynamic_load_rating="52.7", name="40x10")
    page.wait_for_selector("#own-nut table")
    value, low, high, source = row(page, "ball diameter")
    assert (value, low, high) == ("5.696 mm", "5.24 mm", "7.063 mm")
    assert "ISO 3408-5" in source
    page.click("#own-nut-use")
    page.wait_for_selector("#own-nut >> text=Added as design A: 40x10.")
    # the form of the design, which is made anew after the words are there
    page.wait_for_function("[...document.querySelectorAll('input')].some((one) => one.value === '5.696')")


def test_numbers_that_do_not_go_together_are_named(visit):
    here = visit().open("#A=paper")
    here.expected = ("status of 422",)
    page = opened(here, nominal_diameter="40", lead="10", turns="5", ball_diameter="6",
                  dynamic_load_rating="5.27")  # fmt: skip
    page.wait_for_selector("#own-nut .warning >> text=check its unit")
    page.fill("#own-nut-ball_diameter", "")
    page.fill("#own-nut-starts", "1000000")
    page.wait_for_selector("#own-nut .fault >> text=leaves no room for balls")
    assert "0 m" not in page.inner_text("#own-nut .fault")  # that of a ball that nobody has typed
    page.fill("#own-nut-starts", "")
    page.fill("#own-nut-ball_diameter", "60")
    page.wait_for_selector("#own-nut .fault")
    assert page.locator("#own-nut-use").is_disabled()
