"""Sources of the checks and of the factors for accuracy: which was read, by a table by hand, and what is said of it."""

import math

import pytest

import ballscrew as bs
from ballscrew.basis.references import bibliography
from ballscrew.physics.components.nut import DoubleNut
from ballscrew.physics.sizing.checks import SOURCES, Check, checks
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.sizing.makers_tables import (
    QUALIFICATIONS,
    factor_of_make,
    factors_of_makes,
    factors_of_standard,
    printed_limit,
    speed_limit_of,
)

#: The source of each check, and the reason.
EXPECTED = {
    "static_safety": ("read", "listed rating over load, THK514E; the largest half load is that of the contacts"),
    "life": ("recalled", "ISO 3408-5 was not read"),
    "running_time": ("recalled", "the same life"),
    "contact_pressure": ("read", "4200 MPa stands in ISO 76"),
    "shaft_stress": ("read", "force over area; THK514E"),
    "buckling": ("read", "Euler's load, in textbooks; THK514E"),
    "critical_speed": ("read", "a beam's lowest vibration, in textbooks; THK514E"),
    "diameter_speed_product": ("estimate", "without a make, the limit of other makes' standard nuts stands for it"),
}
ROW = bs.catalogue()["hiwin-40-16k5"]
GIVEN = {
    "axial_load": 5000.0, "screw_speed": 60.0, "dynamic_load_rating": 50e3, "static_load_rating": 150e3,
    "maximum_pressure": 1.5e9, "installation": Installation(unsupported_length=1.2, ends=Ends.FIXED_SUPPORTED),
}  # fmt: skip


def sources(**changes):
    return {check.name: check.source for check in checks(ROW.screw(), **{**GIVEN, **changes})}


def test_the_source_of_each_check():
    assert sources() == {name: source for name, (source, _) in EXPECTED.items()}
    assert sources().keys() == SOURCES.keys()


@pytest.mark.parametrize(
    ("changes", "source"),
    [
        ({}, "read"),
        ({"computed_ratings": ("static_load_rating",)}, "recalled"),  # the rating is of ISO 3408-5
        ({"computed_ratings": ("dynamic_load_rating",)}, "read"),
        # so are the loads of both halves, where nothing else is known of them
        ({"nut": DoubleNut(preload=3000.0)}, "recalled"),
        ({"nut": DoubleNut(preload=3000.0), "half_loads": (6000.0, 1000.0)}, "read"),  # those of the contacts
        ({"nut": DoubleNut(preload=3000.0), "half_loads": (6000.0, 1000.0), "largest_load": 7000.0}, "recalled"),
        ({"largest_load": 7000.0}, "read"),
    ],
)
def test_static_safety_is_as_good_as_its_rating_and_its_load(changes, source):
    assert sources(**changes)["static_safety"] == source


@pytest.mark.parametrize(
    ("changes", "source"),
    [
        ({"limits": Limits(diameter_speed_product=5.0)}, "read"),  # that of the case is no estimate of the package
        ({"speed_limit": printed_limit("HIWIN")}, "read"),
        ({"speed_limit": speed_limit_of(ROW)}, "estimate"),  # what HIWIN's cassettes stand could not be read
        ({"speed_limit": printed_limit("THK", "end cap")}, "estimate"),  # that of THK's standard nuts instead
        ({"speed_limit": printed_limit("Thomson", "internal")}, "read"),
    ],
)
def test_the_dn_limit_of_another_nut_is_an_estimate(changes, source):
    assert sources(**changes)["diameter_speed_product"] == source


def test_a_check_of_given_and_computed_numbers_has_no_source():
    assert Check.at_most("said", "motor_rms_torque", 1.0, 2.0, "N m").source is None
    assert Check.at_most("said", "buckling", 1.0, 2.0, "N").source == "read"


def test_only_what_was_read_needs_no_words():
    assert {source for source, words in QUALIFICATIONS.items() if words is None} == {"read"}


# -- factors for accuracy -------------------------------------------------------------------------


def test_factors_have_sources_in_the_bibliography():
    """Rexroth's is implied by its rigidities and printed nowhere; those of the standard are recalled."""
    assert factors_of_standard() == (0.6, 0.5, "recalled", "ISO3408-4")
    assert factors_of_makes() == (("Rexroth", 0.5, "estimate", "Rexroth2006"),)
    assert {one.reference for one in (factors_of_standard(), *factors_of_makes())} <= bibliography().keys()
    assert factor_of_make("rexroth") == factor_of_make("Rexroth")
    assert factor_of_make("") is factor_of_make("HIWIN") is None


def test_the_factor_of_the_make_counts_where_none_is_given():
    """By hand: half of R_nu for Rexroth; a factor of the call or of the installation comes first."""
    row = bs.catalogue()["rexroth-40x10x6-6-double"]
    screw = row.screw(nut=DoubleNut(preload=5000.0))
    mounted = Installation(unsupported_length=1.2, ends=Ends.FIXED_FIXED, accuracy_factor=0.55)
    of_make = bs.rigidity_iso3408(screw, make="Rexroth")
    assert of_make.nut_corrected == pytest.approx(0.5 * of_make.nut, rel=1e-13)
    assert (of_make.accuracy_factor, of_make.accuracy_factor_source) == (0.5, "estimate")
    said = "factor for accuracy 0.5, of Rexroth's printed rigidities of double nuts (Rexroth2006): by an estimate"
    assert said in of_make.assumed
    for given, factor in (({"accuracy_factor": 0.6}, 0.6), ({"installation": mounted}, 0.55)):
        found = bs.rigidity_iso3408(screw, make="Rexroth", **given)
        assert (found.accuracy_factor, found.accuracy_factor_source) == (factor, None)
        assert said not in found.assumed
    unknown = bs.rigidity_iso3408(screw, make="HIWIN")
    assert math.isnan(unknown.nut_corrected)
    assert (unknown.accuracy_factor, unknown.accuracy_factor_source) == (None, None)


def test_a_nut_without_a_rigidity_has_no_factor():
    """A single nut without load: nothing is left to correct, and nothing is said of it."""
    found = bs.rigidity_iso3408(ROW.screw(), make="Rexroth")
    assert found.accuracy_factor is None
    assert not any("factor for accuracy" in text for text in found.assumed)
