"""Truth: a calibration by the make of the row, calibrations of other nuts, and friction of surfaces without a film."""

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.physics.friction.calibrations import calibration_of_make, calibrations
from ballscrew.physics.laws.friction import LoadSharing
from support.own_screws import SCREW

TABLES = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "nut": {"type": "double", "preload": "5 kN"},
    "lubricant": {"grade": "ISO VG 100", "temperature": "25 degC"},
    "operation": {"axial_load": "0 N", "screw_speed": "100 rpm"},
}


def case(calibration=None, **sections):
    return case_file.build({**TABLES, **sections}, calibration=calibration)


def ids(found):
    return {record.id for record in found.doubts}


def test_the_make_of_the_row_chooses():
    found = case("by-make")
    assert found.origins.calibration.name == "rexroth-2006"
    assert found.model == case("rexroth-2006").model
    assert case().origins.calibration is None  # never unless asked


def test_makers_by_any_capitals():
    assert calibration_of_make("hiwin").name == "hiwin"
    assert calibration_of_make("THK").name == "jis"
    assert calibration_of_make("") is calibration_of_make("nobody") is None


def test_a_screw_without_a_make_has_none():
    with pytest.raises(InputError, match="--calibration: the make of this nut is not given · take a row of"):
        case("by-make", screw=SCREW)


def test_a_calibration_of_two_contacts_on_four():
    oversize = {"type": "oversize-balls", "preload": "3 kN"}
    assert calibrations()["hiwin"].contacts_per_ball == [2]
    assert "calibration.other_nuts" in ids(case("hiwin", nut=oversize))
    assert "calibration.other_nuts" not in ids(case("hiwin")) | ids(case("rexroth-2006", nut=oversize))


@pytest.mark.parametrize(
    ("sections", "said"),
    [
        ({}, False),
        ({"lubricant": {"grade": "FVA 3", "temperature": "25 degC"}}, True),
        ({"model": {"friction": "load-sharing"}}, True),
        ({"model": {"friction": {"law": "load-sharing", "boundary_friction_coefficient": 0.06}}}, False),
    ],
)
def test_boundary_friction_of_surfaces_that_have_not_reacted(sections, said):
    """0.057 before and 0.118 after a film of reacted oil had grown (PCSTraction)."""
    found = case(**sections)
    assert ("friction.not_reacted" in ids(found)) == said
    assert LoadSharing().boundary_friction_coefficient == 0.12
