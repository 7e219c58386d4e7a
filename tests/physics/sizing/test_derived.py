"""What is judged of a screw besides its friction: as the program says of a row, and on arrays as on numbers."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import nut_tables
from ballscrew.physics.sizing.judged import LISTED, derived

NOTHING = dict.fromkeys(LISTED, math.nan)
POINT = {"axial_load": -4000.0, "screw_speed": 60.0, "remaining_preload": 500.0, "idle_torque": 0.5, "idle_losses": 0.1}
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SCREW = ROW.screw(nut=bs.DoubleNut(preload=3000.0))


def test_by_hand():
    found = derived(SCREW, **POINT, listed=NOTHING)
    assert (found["half_load"], found["other_half_load"], found["largest_load"]) == (4500.0, 500.0, 4000.0)
    assert found["nut_speed"] == pytest.approx(60.0 * 0.010 / (2 * math.pi), rel=1e-15)
    assert math.tan(found["lead_angle"]) == pytest.approx(0.010 / (math.pi * SCREW.pitch_circle_diameter), rel=1e-14)
    assert found["preload_drag_of_balls"] == pytest.approx(0.4, rel=1e-15)
    assert found["drag_by_rexroth"] == pytest.approx(0.004 * 3000.0 * SCREW.pitch_circle_diameter, rel=1e-14)


def test_what_is_listed_comes_first():
    listed = {"dynamic_load_rating": 1e5, "static_load_rating": 2e5, "root_diameter": 0.033, "nominal_diameter": 0.05}
    found = derived(SCREW, **POINT, listed=listed)
    assert [found[name] for name in LISTED[:3]] == [1e5, 2e5, 0.033]
    assert found["drag_by_rexroth"] == pytest.approx(0.004 * 3000.0 * 0.05, rel=1e-14)


@pytest.mark.parametrize("spacers", [False, True])
def test_the_ratings_are_those_of_a_screw_of_no_catalogue(spacers):
    screw = ROW.screw(nut=bs.DoubleNut(preload=3000.0, spacer_balls=spacers))
    found, made = derived(screw, **POINT, listed=NOTHING), nut_tables.screw_ratings(screw, None)
    assert (found["dynamic_load_rating"], found["static_load_rating"]) == pytest.approx(made, rel=1e-14)
    assert found["root_diameter"] == nut_tables.root_diameter(screw, {})


@pytest.mark.implausible
@pytest.mark.parametrize("preload", [0.0, 3.0, 3000.0, 2e5, 2e6])
def test_a_preload_that_no_nut_has_is_named(preload):
    """The mask is that of the warnings of the model: of the usual range, and of the share of the rating."""
    nut = bs.DoubleNut(preload=preload)
    model = bs.FrictionModel.reference()
    oil = bs.Lubricant.from_grade("ISO VG 100", 313.15)
    result = model(ROW.screw(nut=nut), oil, axial_load=1000.0, screw_speed=10.0)
    told = any(one.subject == "nut.preload" for one in result.warning_records)
    assert bool(derived(ROW.screw(nut=nut), **POINT, listed=NOTHING)["implausible_preload"]) is told


def test_a_nut_without_preload_has_no_rule_of_a_maker():
    found = derived(ROW.screw(nut=bs.SingleNut()), **POINT, listed=NOTHING)
    assert not any(name.startswith("drag_by") for name in found)
    none = derived(ROW.screw(nut=bs.DoubleNut(preload=0.0)), **POINT, listed=NOTHING)
    assert all(math.isnan(none[f"drag_by_{name}"]) for name in ("jis", "rexroth", "hiwin"))


def test_arrays_as_numbers():
    loads = np.array([-9e3, 0.0, 4e3])
    whole = derived(SCREW, **{**POINT, "axial_load": loads}, listed=NOTHING)
    for place, load in enumerate(loads):
        alone = derived(SCREW, **{**POINT, "axial_load": load}, listed=NOTHING)
        for name, value in alone.items():
            assert np.broadcast_to(whole[name], 3)[place] == pytest.approx(value, rel=1e-14), name
