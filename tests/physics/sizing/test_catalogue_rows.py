"""Rows of catalogues: balls and ratings by hand, the nut that a row lists, and what no row has."""

import dataclasses
import math

import pytest

import ballscrew as bs
from ballscrew.physics.components.nut import Bodies, DoubleNut, OversizeBallNut, SingleNut
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.ratings import nut_of, ratings_of

ROW = CatalogueRow(name="40x10", nominal_diameter=0.040, lead=0.010, ball_diameter=0.006, turns=6)
RATED = dataclasses.replace(ROW, dynamic_load_rating=60e3)


def test_balls_by_hand():
    """A turn is 126.06 mm long and has room for 21 balls of 6 mm; 5.76 turns of six carry (ISO 3408-5)."""
    turn = math.hypot(math.pi * 40, 10)
    assert turn / 6 == pytest.approx(21.01, abs=0.005)
    assert ROW.balls_per_turn == 21
    assert ROW.loaded_turns == pytest.approx(5.76)
    assert ROW.loaded_balls == 121  # 120.96
    # balls of 6.1 mm: 20.67 of them, of which 20 are whole
    assert dataclasses.replace(ROW, ball_diameter=0.0061).balls_per_turn == 20
    # a lead as long as the circle makes the turn longer by √2
    assert dataclasses.replace(ROW, lead=0.040 * math.pi).balls_per_turn == math.floor(math.sqrt(2) * math.pi * 40 / 6)
    # a tenth of a turn has two balls, of fewer there is one
    assert dataclasses.replace(ROW, turns=0.34).loaded_balls == 2
    assert dataclasses.replace(ROW, turns=0.25).loaded_balls == 1


def test_a_row_is_of_usual_grooves_and_one_start():
    """45°, a conformity of 0.54, and a pitch circle as large as the nominal diameter, as its documentation has it."""
    screw = ROW.screw()
    assert (screw.contact_angle, screw.starts) == (math.radians(45), 1)
    assert screw.screw_conformity == screw.nut_conformity == 0.54
    assert screw.pitch_circle_diameter == 0.040
    # the centre of an arc of 0.54 · 6 mm lies 0.24 mm beyond that of the ball, at 45°; both arcs meet in the middle
    aside = 0.24e-3 * math.sin(math.pi / 4)
    bottom = 0.040 + 2 * (aside - math.sqrt(3.24e-3**2 - aside**2))
    assert ROW.groove_root_diameter == pytest.approx(bottom, rel=1e-12)


def test_ratings_of_spacer_balls():
    """Half of the balls carry: half of the static rating, and 2^(-2/3) of the dynamic one (ISO 3408-5)."""
    plain, parted = (ratings_of(dataclasses.replace(ROW, spacer_balls=one)) for one in (False, True))
    assert parted.static == pytest.approx(plain.static / 2, rel=1e-12)
    assert parted.dynamic == pytest.approx(plain.dynamic * 2 ** (-2 / 3), rel=1e-12)


def test_the_static_rating_by_hand():
    """ISO 3408-5: k_0 z i d_w² sin α cos φ, with γ = d_w cos α / d_m, which leaves the lead out."""
    gamma = 6 * math.cos(math.pi / 4) / 40
    k_0 = 27.74 / math.sqrt(2 / (1 - gamma) * (2 - 1 / 0.52))
    by_hand = k_0 * 21 * 5.76 * 6**2 * math.sin(math.pi / 4) * math.cos(math.atan(10 / (40 * math.pi)))
    assert ratings_of(ROW).static == pytest.approx(by_hand, rel=1e-12)


@pytest.mark.parametrize(
    ("listed", "nut"),
    [
        ({}, None),
        ({"nut": "double"}, None),
        ({"nut_outer_diameter": 0.07}, None),
        ({"seal_torque": 0.2}, SingleNut(losses={"seals": bs.Seals(0.2)})),
        ({"seal_torque": 0.2, "nut": "double"}, SingleNut(losses={"seals": bs.Seals(0.2)})),
        ({"spacer_balls": True}, SingleNut(spacer_balls=True)),
        ({"nut": "double", "preload": 3000.0}, DoubleNut(3000.0)),
        ({"nut": "double", "preload_share": 0.05}, DoubleNut(3000.0)),
        ({"nut": "oversize-balls", "preload_share": 0.05, "seal_torque": 0.1},
         OversizeBallNut(3000.0, losses={"seals": bs.Seals(0.1)})),
        ({"nut": "double", "preload": 3000.0, "nut_outer_diameter": 0.07, "spacer_balls": True},
         DoubleNut(3000.0, spacer_balls=True, bodies=Bodies(nut_outer_diameter=0.07))),
        ({"nut": "single", "preload": 0.0}, None),
    ],
)  # fmt: skip
def test_the_nut_that_a_row_lists(listed, nut):
    row = dataclasses.replace(RATED, **listed)
    assert nut_of(row) == nut
    assert row.screw().nut == (nut or SingleNut())


def test_a_share_without_a_rating_is_of_that_by_the_geometry():
    row = dataclasses.replace(ROW, nut="double", preload_share=0.05)
    assert nut_of(row).preload == pytest.approx(0.05 * ratings_of(ROW).dynamic, rel=1e-12)


@pytest.mark.parametrize(
    ("sound", "faulty", "words"),
    [
        # a ball of a thousandth of its circle, a lead of ten circles, a nut with a wall around the balls
        ({"ball_diameter": 41e-6}, {"ball_diameter": 39e-6},
         "40x10.ball_diameter: too small for the pitch circle .* 4e-05 m or more"),
        ({"lead": 0.399}, {"lead": 0.401}, "40x10.lead: too large for the pitch circle .* 0.4 m or less"),
        ({"nut_outer_diameter": 0.0461}, {"nut_outer_diameter": 0.0459},
         "40x10.nut_outer_diameter: leaves no wall around the balls"),
        ({"nut_outer_diameter": 0.0461}, {"nut_outer_diameter": 0.046},
         "40x10.nut_outer_diameter: leaves no wall around the balls"),
        ({"name": ""}, {"name": "", "lead": 0.401}, "row.lead"),
        ({"nut": "double"}, {"nut": "twin"}, "40x10.nut: unknown kind of nut"),
        ({"preload": 3000.0, "nut": "double"}, {"preload": 3000.0, "preload_share": 0.05, "nut": "double"},
         "40x10.preload_share: is given beside the preload"),
        ({"preload": 0.0}, {"preload": 3000.0}, "40x10.preload: needs the kind of nut that has it"),
        ({"preload": 3000.0, "nut": "double"}, {"preload": 3000.0, "nut": "single"},
         '40x10.preload: a nut of type "single" has none'),
        ({"preload_share": 0.05, "nut": "double"}, {"preload_share": 0.05},
         "40x10.preload_share: needs the kind of nut that has it"),
        ({"preload_share": 0.0021, "nut": "double"}, {"preload_share": 0.0019, "nut": "double"},
         "40x10.preload_share: is too small a share of the dynamic load rating"),
        # a force is not judged as a share
        ({"preload": 10.0, "nut": "double"}, {"preload": 60001.0, "nut": "double"},
         "40x10.preload: exceeds the dynamic load rating"),
    ],
)  # fmt: skip
def test_rows_that_no_screw_has(sound, faulty, words):
    dataclasses.replace(RATED, **sound)
    with pytest.raises(bs.InputError, match=words):
        dataclasses.replace(RATED, **faulty)
