"""Rigidity by ISO 3408-4: against the balls one by one, its parts in series, and what it says it assumes."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.sizing import rigidity
from ballscrew.physics.sizing.installation import Ends, Installation
from ballscrew.physics.solvers.load_distribution import ball_loads
from support import screws

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
PRELOAD = 0.07 * ROW.dynamic_load_rating


def screw(nut=None, **changes):
    return ROW.screw(nut=bs.DoubleNut(preload=PRELOAD) if nut is None else nut, **changes)


def found(part=None, **given):
    return bs.rigidity_iso3408(screw() if part is None else part, nut_outer_diameter=0.063, **given)


def test_balls_and_tracks_are_the_rigid_nut_up_to_lift_off():
    """At a constant contact angle, load over deflection at the load that relieves the other half."""
    loads = ball_loads(screw(), screw().nut, 2**1.5 * PRELOAD, constant_contact_angle=True)
    assert float(loads.remaining_preload) == pytest.approx(0.0, abs=1e-6 * PRELOAD)
    secant = 2**1.5 * PRELOAD / float(loads.deflection)
    assert found().balls_and_tracks == pytest.approx(secant, rel=1e-6)


def test_one_half_alone_is_softer_and_stiffens_with_the_load():
    """At a constant contact angle its tangent is below R_b/t from 2√2 to 6.7 times the preload."""
    for times, softer in ((2.84, True), (6.6, True), (6.8, False)):
        loads = ball_loads(screw(), screw().nut, times * PRELOAD, constant_contact_angle=True)
        assert (float(loads.rigidity) < found().balls_and_tracks) is softer


def test_widening_is_that_of_the_nut_that_swells():
    """What swelling adds to the deflection of a small load is F/(R_n/s), but for how bars spread the loads."""
    part, slack = screw(), []
    for swelling in (False, True):
        bodies = Bodies(screw_diameter=100.0, nut_inner_diameter=1e-3, nut_outer_diameter=0.063, swelling=swelling)
        slack.append(1 / float(ball_loads(part, part.nut, 0.0, bodies=bodies, constant_contact_angle=True).rigidity))
    # the standard counts whole balls in a turn, the nut those that touch: 1.5 % less length here
    length = rigidity.loaded_length(part) / (part.loaded_balls * part.ball_diameter * math.sin(part.lead_angle))
    assert 1 / (slack[1] - slack[0]) == pytest.approx(found().widening / length, rel=5e-3)


def test_parts_are_in_series():
    mounted = Installation(unsupported_length=1.2, ends=Ends.FIXED_FIXED, bearing_rigidity=8e8)
    r = found(accuracy_factor=0.55, installation=mounted, axial_load=5000.0)
    assert 1 / r.nut == pytest.approx(1 / r.balls_and_tracks + 1 / r.widening, rel=1e-13)
    assert r.nut_corrected == pytest.approx(0.55 * r.nut, rel=1e-13)
    assert r.bearings == pytest.approx(2 * 8e8, rel=1e-9)  # both, with the nut in the middle
    assert 1 / r.drive == pytest.approx(1 / r.nut_corrected + 1 / r.shaft + 1 / r.bearings, rel=1e-13)
    assert r.deflection == pytest.approx(5000.0 / r.drive, rel=1e-13)
    assert found(installation=dataclasses.replace(mounted, accuracy_factor=0.55)).nut_corrected == r.nut_corrected


def test_ends_that_hold_less_give_way_more():
    drives = [
        found(installation=Installation(unsupported_length=1.0, ends=ends)).drive
        for ends in (Ends.FIXED_FIXED, Ends.FIXED_SUPPORTED, Ends.SUPPORTED_SUPPORTED, Ends.FIXED_FREE)
    ]
    assert drives[0] > drives[1] == drives[2] == drives[3]
    near = Installation(unsupported_length=1.0, ends=Ends.FIXED_FREE, bearing_rigidity=1e9)
    along = [found(installation=near, distance_to_bearing=at).drive for at in (0.1, 0.5, 1.0)]
    assert along == sorted(along, reverse=True)


def test_a_thinner_nut_is_softer_and_a_preload_stiffens_by_its_cube_root():
    widths = np.linspace(0.046, 0.2, 12)
    by_width = [bs.rigidity_iso3408(screw(), nut_outer_diameter=width).nut for width in widths]
    assert np.all(np.diff(by_width) > 0)
    assert by_width[-1] < found().balls_and_tracks
    light, heavy = (found(screw(bs.DoubleNut(preload=force))) for force in (1000.0, 8000.0))
    assert heavy.balls_and_tracks / light.balls_and_tracks == pytest.approx(2.0, rel=1e-12)
    assert heavy.widening == light.widening


@pytest.mark.implausible
def test_the_least_preload_is_one():
    assert found(screw(bs.DoubleNut(preload=0.5))).widening == found().widening


def test_a_nut_without_preload_is_load_over_deflection():
    single = screw(bs.SingleNut())
    loads = ball_loads(single, single.nut, 4000.0, constant_contact_angle=True)
    r = found(single, axial_load=4000.0)
    assert r.balls_and_tracks == pytest.approx(4000.0 / float(loads.deflection), rel=1e-6)
    assert r.widening == pytest.approx(found().widening / 2, rel=1e-13)
    unloaded = found(single)
    assert math.isnan(unloaded.nut)
    assert any("without preload" in text for text in unloaded.assumed)


def test_nothing_recalled_is_a_default():
    """Without a factor there is no R_nu,ar, and the result says what it stands on."""
    r = found()
    assert math.isnan(r.nut_corrected)
    assert r.accuracy_factor is None
    assert math.isnan(r.drive)
    assert any("as ISO 3408-4 is recalled; it was not read" in text for text in r.assumed)


#: DIN 69051-5 as HIWIN2017, table 5.5, prints it, mm: nominal diameter, and D_1 of leads below 20 mm and from there on.
PRINTED = [
    (16, 28, 28), (20, 36, 36), (25, 40, 40), (32, 50, 50), (40, 63, 63), (50, 75, 75), (63, 90, 95), (80, 105, 125),
]  # fmt: skip


@pytest.mark.parametrize(("size", "fine", "coarse"), PRINTED)
def test_outer_diameters_of_the_standard(size, fine, coarse):
    for lead, width in ((5, fine), (19.9, fine), (20, coarse), (40, coarse)):
        assert rigidity.usual_nut_outer_diameter(size / 1000, lead / 1000) == pytest.approx(width / 1000)


def test_outer_diameters_between_the_sizes_of_the_standard_and_beyond():
    for size, lead, width in ((125, 5, 150), (6, 5, 18), (125, 20, 170), (36, 10, 56.5)):
        assert rigidity.usual_nut_outer_diameter(size / 1000, lead / 1000) == pytest.approx(width / 1000)
    for size, beyond in ((0.015, True), (0.017, False), (0.079, False), (0.125, True)):
        part = screw(pitch_circle_diameter=size, ball_diameter=0.003)
        (said,) = (text for text in bs.rigidity_iso3408(part).assumed if "DIN 69051-5" in text)
        assert ("last size" in said) is beyond


def test_the_loaded_length_by_hand():
    """121 balls, 21 in a turn of 10 mm, or in one of 20 mm, of which two starts have half."""
    assert rigidity.loaded_length(screw()) == pytest.approx(121 / 21 * 0.010, rel=1e-12)
    assert rigidity.loaded_length(screw(lead=0.020, starts=2)) == pytest.approx(121 / 21 * 0.010, rel=1e-12)
    # a turn of a steep thread is longer: 2π·40 mm at an angle of 60° to its axis
    steep = screw(lead=0.040 * math.pi * math.tan(math.radians(60)))
    assert rigidity.loaded_length(steep) == pytest.approx(
        121 / math.floor(2 * math.pi * 40 / 6) * steep.lead, rel=1e-12
    )


def test_what_is_said_of_loads_and_nuts():
    """A load is beyond what relieves a half from 2√2 times the preload on; oversize balls are said."""
    for load, said in ((2.82 * PRELOAD, False), (2.84 * PRELOAD, True)):
        assert any("beyond that which relieves" in text for text in found(axial_load=load).assumed) is said
    for nut, said in ((bs.DoubleNut(preload=PRELOAD), False), (bs.OversizeBallNut(preload=PRELOAD), True)):
        assert any("oversize balls" in text for text in found(screw(nut)).assumed) is said
    mounted = Installation(unsupported_length=1.0, ends=Ends.FIXED_FREE)
    for given, said in (({}, False), ({"installation": mounted}, True)):
        assert any("no accuracy factor is given" in text for text in found(**given).assumed) is said
    least, most = sorted(rigidity.RECALLED_ACCURACY_FACTORS)
    with pytest.raises(bs.InputError, match=f"{least:g} to {most:g}"):
        found(accuracy_factor=1.1)
    given = found(installation=mounted, accuracy_factor=0.5)
    assert not any("no accuracy factor is given" in text for text in given.assumed)


def test_bodies_know_how_wide_their_nut_is():
    given = screw(bs.DoubleNut(preload=PRELOAD, bodies=Bodies(nut_outer_diameter=0.07)))
    assert bs.rigidity_iso3408(given).nut == bs.rigidity_iso3408(screw(), nut_outer_diameter=0.07).nut


@pytest.mark.parametrize(
    ("given", "problem"),
    [
        ({"nut_outer_diameter": 0.044}, "rigidity.nut_outer_diameter: leaves no wall around the balls"),
        ({"accuracy_factor": 1.2}, "rigidity.accuracy_factor: must be above 0 and at most 1"),
        ({"axial_load": math.nan}, "rigidity.axial_load: must be a finite number"),
        ({"distance_to_bearing": 0.3}, "rigidity.distance_to_bearing: has no shaft"),
    ],
)
def test_bad_input(given, problem):
    with pytest.raises(bs.InputError, match=problem):
        bs.rigidity_iso3408(screw(), **given)


def test_a_place_beyond_the_shaft_and_many_screws_are_refused():
    mounted = Installation(unsupported_length=1.0, ends=Ends.FIXED_FIXED)
    for place in (0.0, 1.0, 1.5):
        with pytest.raises(bs.InputError, match="distance_to_bearing: must lie on the shaft"):
            found(installation=mounted, distance_to_bearing=place)
    with pytest.raises(bs.InputError, match="must be one screw"):
        bs.rigidity_iso3408(screw(lead=np.array([0.005, 0.010])))


@pytest.mark.implausible
def test_random_screws_have_numbers():
    rng = np.random.default_rng(4)
    for size, lead in itertools.product((6, 16, 40, 125, 200), (0.3, 0.5, 1.5)):
        d_m = size / 1000
        part = screws.screw(
            pitch_circle_diameter=d_m,
            lead=lead * d_m,
            ball_diameter=d_m * rng.uniform(0.06, 0.2),
            loaded_balls=int(rng.integers(5, 200)),
            contact_angle=math.radians(rng.uniform(30, 60)),
            nut=bs.DoubleNut(preload=float(rng.uniform(10, 1000))),
        )
        r = bs.rigidity_iso3408(part, accuracy_factor=0.5)
        assert 0 < r.nut_corrected < r.nut < min(r.balls_and_tracks, r.widening)
