"""The table of checks: every line is there, says what it needs, and judges as it should."""

import dataclasses
import math

import pytest

import ballscrew as bs
from ballscrew.basis.references import bibliography
from ballscrew.physics.components.nut import DoubleNut, OffsetLeadNut, OversizeBallNut, SingleNut
from ballscrew.physics.equations import life, shaft
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.checks import HOUR, Check, all_hold, checks, loads_of_halves, mean_load, verdict_of
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.sizing.makers_tables import GENERAL, MM_RPM, printed_limit, printed_limits, speed_limit_of
from ballscrew.physics.sizing.ratings import ratings_of

RPM = math.tau / 60
NAMES = (
    "static_safety",
    "life",
    "running_time",
    "contact_pressure",
    "shaft_stress",
    "buckling",
    "critical_speed",
    "diameter_speed_product",
)
ROW = CatalogueRow(
    name="40-20K4", nominal_diameter=0.040, lead=0.020, ball_diameter=6.35e-3, turns=4, pitch_circle_diameter=0.0414
)
SCREW = ROW.screw()
RATINGS = ratings_of(ROW)
MOUNTED = Installation(unsupported_length=1.2, ends=Ends.FIXED_SUPPORTED)
PRELOADED = (DoubleNut, OffsetLeadNut, OversizeBallNut)


def table(**changes):
    known = {
        "axial_load": 5000.0,
        "screw_speed": 1000 * RPM,
        "dynamic_load_rating": RATINGS.dynamic,
        "static_load_rating": RATINGS.static,
        "maximum_pressure": 1.5e9,
        "installation": MOUNTED,
    }
    return {check.name: check for check in checks(SCREW, **{**known, **changes})}


def test_every_line_is_there_in_order():
    assert tuple(table()) == NAMES
    assert tuple(check.name for check in checks(SCREW, axial_load=1.0, screw_speed=1.0)) == NAMES


def test_a_line_without_its_inputs_says_what_to_give():
    missing = {check.name: check for check in checks(SCREW, axial_load=5000.0, screw_speed=100.0)}
    wanted = {
        "static_safety": "static_load_rating",
        "life": "dynamic_load_rating",
        "running_time": "dynamic_load_rating",
        "contact_pressure": "maximum_pressure",
        "buckling": "installation",
        "critical_speed": "installation",
    }
    assert {name for name, check in missing.items() if check.holds is None} == set(wanted)
    for name, give in wanted.items():
        assert missing[name].text == f"not checked: give {give}"
        assert missing[name][1:3] == (None, None)
        assert missing[name].utilisation is None
        assert missing[name].unit == table()[name].unit


def test_a_good_screw_passes():
    for check in table(limits=Limits(running_time=1e3 * HOUR)).values():
        assert check.holds
        assert check.utilisation <= 1
        assert isinstance(check.value, float)
        assert check.text


@pytest.mark.parametrize(
    ("value", "limit", "at_most", "at_least"),
    [
        (2.0, 4.0, (0.5, True), (2.0, False)),
        (0.0, 0.0, (0.0, True), (0.0, True)),
        (3.0, 0.0, (math.inf, False), (0.0, True)),
        (0.0, 3.0, (0.0, True), (math.inf, False)),
    ],
)
def test_demand_over_capacity(value, limit, at_most, at_least):
    """Nothing that is asked of nothing is no demand; something asked of nothing is beyond all."""
    made = (kind("said", "one", value, limit, "1") for kind in (Check.at_most, Check.at_least))
    assert [(check.utilisation, check.holds) for check in made] == [at_most, at_least]


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("static_safety", {"largest_load": 0.51 * RATINGS.static}),
        ("life", {"limits": Limits(running_time=1e6 * HOUR)}),
        ("running_time", {"limits": Limits(running_time=1e6 * HOUR)}),
        ("contact_pressure", {"maximum_pressure": 4.3e9}),
        ("contact_pressure", {"maximum_pressure": math.nan}),
        ("shaft_stress", {"largest_load": 147e6 * math.pi / 4 * 0.0350**2}),
        ("buckling", {"installation": Installation(unsupported_length=8.0, ends=Ends.FIXED_FREE)}),
        ("critical_speed", {"installation": Installation(unsupported_length=3.0, ends=Ends.FIXED_FREE)}),
        ("diameter_speed_product", {"screw_speed": 1700 * RPM}),
    ],
)
def test_each_line_can_fail(name, changes):
    assert table(**changes)[name].holds is False


def test_life_is_that_of_the_equations():
    found = table()
    revolutions = 1e6 * (RATINGS.dynamic / 5000.0) ** 3
    assert found["life"].value == pytest.approx(revolutions, rel=1e-12)
    assert found["running_time"].value == pytest.approx(revolutions / 1000 * 60, rel=1e-12)
    assert found["life"].holds is None
    assert found["life"].text.startswith("basic rating life L10")
    assert found["life"].text.endswith("not judged: give limits.running_time")
    assert found["running_time"].text == "16500 h at this speed; not judged: give limits.running_time"


def test_life_and_time_say_the_same():
    found = table(limits=Limits(running_time=5000 * HOUR))
    assert found["life"].limit == pytest.approx(5000 * 60 * 1000, rel=1e-12)
    assert found["life"].utilisation == pytest.approx(found["running_time"].utilisation, rel=1e-12)


def test_half_loads_that_are_known_count():
    """The loads of the halves from the load distribution stand in for those of the closed formula."""
    found = table(nut=DoubleNut(preload=2500.0), half_loads=(6000.0, 1000.0))
    lives = [life.basic_life(RATINGS.dynamic, load) for load in (6000.0, 1000.0)]
    assert found["life"].value == pytest.approx(life.combined_life(*lives), rel=1e-12)
    assert found["static_safety"].value == pytest.approx(RATINGS.static / 6000.0, rel=1e-12)


@pytest.mark.parametrize("kind", PRELOADED)
def test_preload_costs_life_and_safety(kind):
    alone, braced = table(), table(nut=kind(preload=2500.0))
    first, second = loads_of_halves(kind(preload=2500.0), 5000.0)
    assert first - second == pytest.approx(5000.0, rel=1e-12)
    lives = [life.basic_life(RATINGS.dynamic, load) for load in (first, second)]
    assert braced["life"].value == pytest.approx(life.combined_life(*lives), rel=1e-12)
    assert braced["life"].value < alone["life"].value
    assert braced["static_safety"].value == pytest.approx(RATINGS.static / first, rel=1e-12)
    # the shaft does not know of the preload
    assert braced["buckling"] == alone["buckling"]


@pytest.mark.parametrize("nut", [SingleNut(), DoubleNut(preload=0.0)])
def test_without_preload_the_nut_carries_the_load(nut):
    assert loads_of_halves(nut, 800.0) == (800.0,)


@pytest.mark.parametrize("kind", PRELOADED)
def test_preload_alone_tires_both_halves(kind):
    preload = 3000.0
    found = table(axial_load=0.0, nut=kind(preload=preload))
    one = life.basic_life(RATINGS.dynamic, preload)
    assert found["life"].value == pytest.approx(one * 2 ** (-0.9), rel=1e-12)


def test_a_heavy_load_makes_the_preload_forgotten():
    braced = table(axial_load=9000.0, nut=DoubleNut(preload=2500.0))
    assert braced["life"].value == pytest.approx(table(axial_load=9000.0)["life"].value, rel=1e-12)


def test_at_rest_without_load():
    found = table(axial_load=0.0, screw_speed=0.0, limits=Limits(running_time=HOUR))
    assert found["life"].value == found["running_time"].value == found["static_safety"].value == math.inf
    assert all(check.holds for check in found.values())
    loaded = table(screw_speed=0.0, limits=Limits(running_time=HOUR))
    assert loaded["running_time"].value == math.inf
    assert [loaded[name].holds for name in ("life", "running_time")] == [None, None]
    assert loaded["running_time"].text == "no turn tires it; not judged: at rest"
    assert [found[name].text for name in ("life", "running_time")] == ["no load tires it"] * 2


def test_the_largest_load_breaks_and_the_mean_load_tires():
    mean, peak = table(), table(largest_load=20e3)
    for name in ("static_safety", "shaft_stress", "buckling"):
        assert peak[name].utilisation == pytest.approx(4 * mean[name].utilisation, rel=1e-12)
    assert peak["life"] == mean["life"]


def test_shaft_lines_are_those_of_the_equations():
    found = table(root_diameter=0.030)
    E = SCREW.screw_material.young_modulus
    euler = shaft.buckling_load(Ends.FIXED_SUPPORTED.buckling_root, E, 0.030, 1.2)
    assert found["buckling"].limit == pytest.approx(euler / 2, rel=1e-12)
    whirl = shaft.critical_speed(Ends.FIXED_SUPPORTED.whirling_root, E, 7850.0, 0.030, 1.2)
    assert found["critical_speed"].limit == pytest.approx(0.8 * whirl, rel=1e-12)
    assert "fixed–supported" in found["buckling"].text


@pytest.mark.parametrize(
    ("ends", "effective_length", "root"),
    [
        (Ends.FIXED_FIXED, 0.5, 4.7300),
        (Ends.FIXED_SUPPORTED, 0.69916, 3.9266),
        (Ends.SUPPORTED_SUPPORTED, 1.0, math.pi),
        (Ends.FIXED_FREE, 2.0, 1.8751),
    ],
)
def test_ends_are_those_of_eulers_cases(ends, effective_length, root):
    """Buckling by the effective length, whirling by the root of a uniform beam, as textbooks print both."""
    E, section = SCREW.screw_material.young_modulus, math.pi * 0.030**4 / 64
    mounted = Installation(unsupported_length=1.2, ends=ends)
    found = table(root_diameter=0.030, installation=mounted)
    euler = math.pi**2 * E * section / (effective_length * 1.2) ** 2
    assert found["buckling"].limit == pytest.approx(euler / 2, rel=1e-4)
    whirl = (root / 1.2) ** 2 * math.sqrt(E * section / (7850 * math.pi * 0.030**2 / 4))
    assert found["critical_speed"].limit == pytest.approx(0.8 * whirl, rel=1e-4)


def test_the_root_of_the_groove_stands_in_for_one_not_given():
    # HIWIN S99TE20-1610: 34.91 mm
    assert table()["buckling"].limit == pytest.approx(table(root_diameter=34.91e-3)["buckling"].limit, rel=2e-4)


def test_dn_value_counts_in_millimetres_and_turns_a_minute():
    check = table(screw_speed=70e3 / 41.4 * RPM)["diameter_speed_product"]
    assert check.utilisation == pytest.approx(1, rel=1e-12)


def test_the_limit_of_the_dn_value_says_whose_it_is():
    """That of the case, of the row, of the make, or a general one; the text says which."""

    def checked(row=None, **given):
        return table(speed_limit=speed_limit_of(row), **given)["diameter_speed_product"]

    general, hiwin = checked(), checked(bs.catalogue()["hiwin-40-16k5"])
    assert "in general (THK514E, HIWIN2016): that of this make is not known" in general.text
    assert general.limit == pytest.approx(70000 * MM_RPM)
    assert "limit of standard nuts of HIWIN (HIWIN2016)" in hiwin.text
    assert "cassette recirculation" in hiwin.text
    assert checked(bs.catalogue()["rexroth-40x10x6-6-double"]) == general
    own = dataclasses.replace(bs.catalogue()["hiwin-40-16k5"], speed_limit=120000 * MM_RPM, source="A 1")
    assert checked(own).limit == pytest.approx(120000 * MM_RPM)
    assert checked(own).text.endswith("limit that the row lists (A 1)")
    given = checked(own, limits=Limits(diameter_speed_product=13.0))
    assert (given.limit, given.text[-20:]) == (13.0, "limit that was given")


@pytest.mark.parametrize(
    ("make", "recirculation", "limit"),
    [
        # thomsonlinear.com/en/training/ball_screws/nut_critical_speed
        ("Thomson", "external", 76200),
        ("Thomson", "external with solid deflectors", 133300),
        ("thomson", "Internal", 140000),
        # the abstract of Miyaguchi2013, and the article of Gretz
        ("NSK", "smooth return coupling", 160000),
        ("Anybody", "tube", 70000),
        ("THK", "", 70000),
        ("Rexroth", "internal", None),
        ("", "", None),
    ],
)
def test_limits_of_the_dn_value_are_those_that_makers_print(make, recirculation, limit):
    found = printed_limit(make, recirculation)
    assert (found is None) == (limit is None)
    assert found is None or found.value == pytest.approx(limit * MM_RPM)
    assert found is None or ("of all makes" in found.words) is (make == "Anybody")


def test_printed_limits_have_sources_and_make_nothing_milder():
    for one in printed_limits():
        assert one.source in bibliography(), one
        assert one.value >= GENERAL.value, one
        assert one.diameter in ("pitch circle", "nominal"), one


def said(checks, **how):
    return verdict_of(checks, **how)


def test_no_verdict_passes_with_checks_that_were_not_judged():
    """Defect 12: the word is said only where all were judged; elsewhere how many were."""
    found = [*table().values()]
    some = [check for check in found if check.holds is None]
    holding = [check for check in found if check.holds]
    assert some
    assert holding
    assert said([*some, *holding]) == f"{len(holding)} of {len(some) + len(holding)} judged, and these hold"
    assert all_hold([*some, *holding]) is None
    assert said(holding) == "passes"
    assert all_hold(holding) is True
    fails = holding[0]._replace(name="buckling", holds=False, utilisation=1.5)
    assert said([fails, *some]) == f"fails: buckling; 1 of {1 + len(some)} judged"
    assert said([fails], by_how_much=True) == "fails: buckling 1.5 times"
    assert all_hold([fails, *some]) is False


def test_mean_load_is_cubic():
    assert mean_load([1000.0, 2000.0], [3.0, 1.0]) == pytest.approx((11 / 4) ** (1 / 3) * 1000, rel=1e-12)
    # each load takes its share of the life: Palmgren and Miner
    loads, revolutions = [800.0, 3000.0, 1500.0], [2e5, 5e4, 3e5]
    used = sum(n / life.basic_life(40e3, F) for F, n in zip(loads, revolutions, strict=True))
    assert sum(revolutions) / life.basic_life(40e3, mean_load(loads, revolutions)) == pytest.approx(used, rel=1e-12)


def test_ratings_ignore_what_the_catalogue_prints():
    printed = dataclasses.replace(ROW, dynamic_load_rating=1.0, static_load_rating=1.0)
    assert ratings_of(printed) == RATINGS


def test_ratings_of_a_screw_are_those_of_its_geometry():
    # ISO 3408-5: the static rating grows with the balls, the dynamic one with the turns to the power of 0.86
    balls = SCREW.loaded_balls / (ROW.loaded_turns * ROW.balls_per_turn)
    expected = (RATINGS.dynamic * balls**0.86, RATINGS.static * balls)
    assert tuple(bs.load_ratings(SCREW)) == pytest.approx(expected, rel=1e-12)


def test_ratings_without_a_pitch_circle_use_the_nominal_diameter():
    bare = dataclasses.replace(ROW, pitch_circle_diameter=None)
    assert ratings_of(bare) == ratings_of(dataclasses.replace(ROW, pitch_circle_diameter=0.040))
    assert ratings_of(bare) != RATINGS


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"axial_load": math.nan}, "operation.axial_load: must be a finite number"),
        ({"dynamic_load_rating": 0.0}, "checks.dynamic_load_rating: must be positive"),
        ({"static_load_rating": -2.0}, "checks.static_load_rating: must be positive"),
        ({"root_diameter": math.nan}, "checks.root_diameter: must be positive"),
        ({"largest_load": 4000.0}, "checks.largest_load: is below the mean load"),
    ],
)
def test_nonsense_is_refused(changes, words):
    with pytest.raises(bs.InputError, match=words):
        table(**changes)


@pytest.mark.parametrize("nut", [SingleNut(), DoubleNut(2000.0)])
def test_loads_and_speed_count_by_their_size(nut):
    """A load of the other sign presses the other flanks as much: no check is passed by a sign."""
    plain, turned = (
        table(nut=nut, axial_load=sign * 5000.0, largest_load=sign * 9000.0, screw_speed=sign * 1000 * RPM)
        for sign in (1, -1)
    )
    assert turned == plain
    with pytest.raises(bs.InputError, match=r"checks\.largest_load: is below the mean load"):
        table(largest_load=-4000.0)


def test_an_installation_wants_sane_values():
    with pytest.raises(bs.InputError, match=r"installation\.unsupported_length: must be positive"):
        Installation(unsupported_length=0.0, ends=Ends.FIXED_FREE)
    with pytest.raises(bs.InputError, match=r"installation\.ends: must be one of Ends .* known: Ends\.FIXED_FIXED"):
        Installation(unsupported_length=1.0, ends="fixed")
    with pytest.raises(bs.InputError, match=r"limits\.buckling_safety: must be at least 1"):
        Limits(buckling_safety=0.5)
    with pytest.raises(bs.InputError, match=r"limits\.running_time: must be positive"):
        Limits(running_time=0.0)


def test_a_table_of_ones_own_brings_its_limit_of_the_dn_value(tmp_path):
    (tmp_path / "rows.csv").write_text(
        "name,d0 [mm],lead [mm],ball [mm],turns,DN value [mm rpm],maker,ball return\n"
        "fast,40,20,6.35,4,120000,,\nlisted,40,20,6.35,4,,Thomson,internal\n",
        encoding="utf-8",
    )
    rows = bs.screws(tmp_path / "rows.csv")
    assert speed_limit_of(rows["fast"]).value == pytest.approx(120000 * MM_RPM)
    assert speed_limit_of(rows["listed"]).value == pytest.approx(140000 * MM_RPM)
