"""Digits of the page: as many with a band as without, the ends rounded outward, as on the terminal."""

import re

import numpy as np
import pytest

from ballscrew.basis.units import to_digits

pytestmark = pytest.mark.slow

ENDS = """async (pairs) => {
  const { ends, digits } = ballscrewModules["units.js"];
  return pairs.map(([low, high]) => [digits(low), ...ends(low, high)]);
}"""


def test_numbers_are_those_of_the_command_line(visit):
    here = visit().open()
    random = np.random.default_rng(11)
    low = random.uniform(-10, 10, 400) * 10.0 ** random.integers(-3, 5, 400)
    high = low + random.uniform(0, 3, 400) * np.abs(low)
    found = here.page.evaluate(ENDS, np.column_stack([low, high]).tolist())
    for start, end, (value, *ends) in zip(low.tolist(), high.tolist(), found, strict=True):
        assert float(value) == float(to_digits(start))
        assert [float(one) for one in ends] == [float(to_digits(start, toward=-1)), float(to_digits(end, toward=1))]


#: Just below a power of ten a step of the end is one of the smaller decade.
ROUNDED = """async (pairs) => {
  const { digits } = ballscrewModules["units.js"];
  return pairs.map(([number, toward]) => digits(number, 4, toward));
}"""
NEAR_POWERS = [
    (0.99996, -1, "0.9999"), (9.9996, -1, "9.999"), (99.996, -1, "99.99"), (-9.9996, 1, "-9.999"),
    (0.99996, 1, "1"), (-9.9996, -1, "-10"), (1.00004, -1, "1"), (1.00004, 1, "1.001"), (-0.099996, 1, "-0.09999"),
    (-0.12345, -1, "-0.1235"), (-0.12345, 1, "-0.1234"), (0, -1, "0"), (0, 1, "0"),
]  # fmt: skip


def test_an_end_near_a_power_of_ten_is_the_next_number(visit):
    here = visit().open()
    found = here.page.evaluate(ROUNDED, [list(one[:2]) for one in NEAR_POWERS])
    assert found == [text for *_, text in NEAR_POWERS]
    assert [float(one) for one in found] == [
        float(to_digits(number, toward=toward)) for number, toward, _ in NEAR_POWERS
    ]


def test_the_headline_does_not_change_when_its_band_comes(visit, server):
    """The value keeps its digits; headline, table and sentence of the band write one number alike."""
    here = visit().open("#A=paper&band=0")
    before = here.text("#summary")
    torque = re.search(r"Friction torque ([\d.]+) N·m", before)[1]
    assert torque == to_digits(here.numbers()["results"]["screw_torque"])
    shown = here.page.locator("#numbers dd data").all_inner_texts()
    here.page.locator("#band").check()
    here.page.wait_for_selector("#band-words details")
    after = here.text("#summary")
    low, high = re.search(rf"Friction torque {torque} N·m \([^)\d]*([\d.]+) to ([\d.]+) N·m\)", after).groups()
    assert before == re.sub(r" \([^)\d]*[\d.]+ to [\d.]+ N·m\)", "", after)
    values = here.page.locator("#numbers dd data").all_inner_texts()
    assert values == shown
    sentence = here.text("#band-words summary")
    assert f"friction torque {torque} N m" in sentence
    assert f"between {low} N m and {high} N m" in sentence
    case = server.get("vocabulary").json()["starts"]["paper"]["case"]
    band = server.post("band", {"case": case}).json()["band"]["screw_torque"]
    assert (low, high) == (to_digits(band["low"], toward=-1), to_digits(band["high"], toward=1))
