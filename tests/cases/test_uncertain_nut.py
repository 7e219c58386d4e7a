"""Uncertain numbers of a nut in a case file: preload, a share of the rating, and what the nut loses."""

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.uncertain_inputs import all_of
from ballscrew.engine.uncertainty.distributions import Normal, Uniform, scaled
from support.drive_case import drive_case


def loaded(tmp_path, preload="4326 N", seals="0.2 N m"):
    path = tmp_path / "case.toml"
    losses = f'[losses]\nseals = {{law = "known", seal_torque = "{seals}"}}'
    path.write_text(drive_case(preload, "-3 kN", "-100 rpm", losses), encoding="utf-8")
    return case_file.load(path)


@pytest.mark.parametrize(
    ("written", "half_width"),
    [
        ("4326 ± 800 N", 800.0),
        ("4326 N ± 20 %", 865.2),
        ("7 % ± 10 %", 0.07 * 72100 * 0.1),
        ("(7 ± 1) %", 0.01 * 72100),
    ],
)
def test_a_preload_has_a_distribution(tmp_path, written, half_width):
    case = loaded(tmp_path, preload=written)
    found = case.origins.uncertain["preload"]
    assert found.mean == pytest.approx(case.screw.nut.preload, rel=1e-12)
    assert found.deviation * 1.959963984540054 == pytest.approx(half_width, rel=1e-12)
    assert all_of(case)["preload"].given


def test_seals_have_a_distribution(tmp_path):
    found = loaded(tmp_path, seals="0.2 ± 0.05 N m").origins.uncertain["losses.seals.seal_torque"]
    assert (found.mean, found.deviation) == pytest.approx((0.2, 0.05 / 1.959963984540054))


def test_a_preload_is_uncertain_by_default(tmp_path):
    """By a quarter, as far as the no-load torques of Rexroth2006 spread in the median."""
    found = all_of(loaded(tmp_path))["preload"]
    assert (found.given, found.source) == (False, "Rexroth2006")
    assert found.distribution.deviation == pytest.approx(0.25 * 4326 / 1.959963984540054)


def test_an_exact_preload_has_no_distribution(tmp_path):
    assert "preload" not in all_of(loaded(tmp_path, preload="4326 ± 0 N"))


@pytest.mark.parametrize("written", ["7 % ± nothing", "200 % ± 1 %", "4326 ± 800"])
def test_faults_name_the_preload(tmp_path, written):
    with pytest.raises(InputError, match=r"nut\.preload"):
        loaded(tmp_path, preload=written)


def test_a_multiple_of_a_distribution():
    assert scaled(Normal(2.0, 0.5, 1.0, 3.0), 10.0) == Normal(20.0, 5.0, 10.0, 30.0)
    assert scaled(Uniform(1.0, 2.0), 3.0) == Uniform(3.0, 6.0)
