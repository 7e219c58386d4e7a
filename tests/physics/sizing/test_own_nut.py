"""Nuts of few numbers: each number estimated against rows that list it, by rules that did not see the row."""

import dataclasses
import math
import tomllib
from importlib import resources

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.files.tables.headings import YES
from ballscrew.physics.sizing import own_nut
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from ballscrew.physics.sizing.own_nut import BY_TABLE, with_table_balls
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.physics.solvers.swelling import ball_of_rating
from ballscrew.questions.validate.compute import shipped_rows
from support.rules import for_each

ROWS = tuple(printed_rows())
#: Rows of HIWIN's stock list whose ratings do not go with their geometry, as the head of the file has it.
MISPRINTS = ("R25-4B2-FSW", "R32-8B1-OFSW")
KEPT = ("name", "nominal_diameter", "lead", "turns", "starts", "ball_diameter", "pitch_circle_diameter",
        "root_diameter", "dynamic_load_rating", "spacer_balls")  # fmt: skip


STOCK = tuple(
    dataclasses.replace(screw_of(values), spacer_balls=values["spacer_balls"] == YES)
    for values in shipped_rows(SETS["hiwin-stock"])
)
ALL = (*ROWS, *(row for row in STOCK if row.name not in MISPRINTS))
every_row = for_each(row={f"{place}: {row.name}": row for place, row in enumerate(ALL)})


def without(row, *names):
    listed = {name: getattr(row, name) for name in KEPT if name not in names}
    return own_nut.completed({name: value for name, value in listed.items() if value is not None})


def estimate(found, name):
    return next(one for one in found.estimates if one.name == name)


def is_in_band(found, name, value):
    one = estimate(found, name)
    return one.low <= value <= one.high


def test_balls_are_made_of_all_sizes():
    """From 1/32 in. on a size is a quarter larger than the next smaller one at most, in inches and in millimetres."""
    sizes = np.unique(own_nut.BALLS)
    assert sizes[0] == pytest.approx(0.0254 / 32, rel=1e-12)
    assert np.max(sizes[1:] / sizes[:-1]) <= 1.25 + 1e-12


# -- the balls of a table ----------------------------------------------------------------------------


def balls_of(rows):
    """Each row of a table that prints no ball, with the ball that its table tells, and the one that it has."""
    blank = [dataclasses.replace(row, ball_diameter_source=own_nut.BY_RATING) for row in rows]
    return [
        (row.ball_diameter, known.ball_diameter)
        for row, known in zip(with_table_balls(blank), rows, strict=True)
        if row.ball_diameter_source == BY_TABLE
    ]


@pytest.mark.parametrize(("maker", "right"), [("rexroth", 25), ("hiwin", 13)])
def test_a_table_tells_the_balls_of_its_grooves(maker, right):
    """All that are told are right; untold stay 80x20 of Rexroth, with two balls, 16 mm, 20x20, and HIWIN 32x20."""
    rows = [dataclasses.replace(row, make="", nut="") for row in ROWS if row.name.startswith(maker)]
    told = balls_of(rows)
    assert len(told) == right
    assert all(abs(ball / known - 1) < 0.012 for ball, known in told)
    # row by row the rating of none of Rexroth's goes with its ball: they are 5 % to 12 % above ISO 3408-5
    by_rating = [estimate(without(row, "ball_diameter"), "ball_diameter").value / row.ball_diameter for row in rows]
    assert sum(abs(ratio - 1) < 0.012 for ratio in by_rating) == {"rexroth": 0, "hiwin": 8}[maker]


def test_a_table_whose_ratings_have_nothing_in_common_tells_no_ball():
    assert not balls_of(STOCK)
    assert not balls_of(ROWS[:7])


def test_balls_that_are_printed_help_and_stay():
    rows = [row for row in ROWS if row.name.startswith("hiwin")]
    half = [
        row
        if place % 2
        else dataclasses.replace(row, ball_diameter=0.9 * row.ball_diameter, ball_diameter_source=own_nut.BY_RATING)
        for place, row in enumerate(rows)
    ]
    result = with_table_balls(half)
    assert [row.ball_diameter for row in result] == pytest.approx([row.ball_diameter for row in rows], rel=0.012)
    assert [row.ball_diameter_source for row in result[1::2]] == [""] * 7


# -- the ball of a make ------------------------------------------------------------------------------

GROUND = [row for row in catalogue().values() if not row.refusal and not row.family.endswith("rolled")]
GROOVES = sorted({own_nut._groove(row) for row in GROUND})  # private: rows of one groove, as the table has them


def told_of_other_grooves(grooves, **unknown):
    """Rows told and rows told right, each by the rows of other grooves; the row has no make."""
    told = []
    for groove in grooves:
        makes = own_nut.makes_of(row for row in GROUND if own_nut._groove(row) != groove)
        for row in (row for row in GROUND if own_nut._groove(row) == groove):
            made = own_nut.ball_of_make(dataclasses.replace(row, make="", **unknown), makes)
            told += [] if made is None else [abs(made.ball.value / row.ball_diameter - 1) < 0.012]
    return len(told), sum(told)


@pytest.mark.slow
def test_a_make_tells_the_balls_of_other_grooves():
    """The numbers that the estimate states: of rows that print their ball, and of those whose ball is an estimate."""
    printed = [groove for groove in GROOVES if groove[0] != "THK"]
    estimated = [groove for groove in GROOVES if groove[0] == "THK"]
    assert told_of_other_grooves(printed) == (38, 38)
    assert told_of_other_grooves(estimated) == (403, 402)
    assert (
        "of 44 that print their ball 38 are told, all right; of 501 whose ball is itself an estimate 403"
        in own_nut.BY_MAKE
    )
    assert [sum((row.make == "THK") == is_thk for row in GROUND) for is_thk in (False, True)] == [44, 501]
    # without pitch circle and root nearly as many
    assert told_of_other_grooves(GROOVES, pitch_circle_diameter=None, root_diameter=None) == (438, 435)


def test_a_make_tells_the_balls_of_some_other_grooves():
    told, right = told_of_other_grooves(GROOVES[::12])
    assert told == right > 20


def test_a_make_tells_the_balls_of_stocked_nuts():
    """Of a list that makes are not told by, whose circuits of 2.5 turns are rated as another maker's are."""
    makes = own_nut.makes_of(GROUND)
    rows = [row for row in STOCK if row.static_load_rating is not None]
    made = [(own_nut.ball_of_make(row, makes), row.ball_diameter) for row in rows]
    told = [found.ball.value / ball for found, ball in made if found is not None]
    assert len(told) >= 10
    assert told == pytest.approx([1.0] * len(told), rel=0.012)


def test_numbers_that_are_as_a_make_has_them():
    """BNFN4010-5 of THK: no ball is printed, all turns carry, and the rating by the geometry is the one listed."""
    numbers = {"nominal_diameter": 0.04, "lead": 0.01, "turns": 5, "dynamic_load_rating": 52.7e3}
    made = bs.own_nut(**numbers, static_load_rating=141.1e3)
    ball, circle = estimate(made, "ball_diameter"), estimate(made, "ball_circle")
    assert (ball.value, ball.source) == (6.35e-3, own_nut.BY_MAKE + "THK")
    assert circle.value == pytest.approx(0.04175, abs=2e-4)
    assert (circle.low, circle.high) == pytest.approx((0.04, 0.042))
    assert made.row.turns_without_load == 0.0
    assert ratings_of(made.row).dynamic == pytest.approx(52.7e3, rel=0.03)
    # without the static rating, and with one that nothing has, the ball is of any size
    for odd in ({}, {"static_load_rating": 90e3}):
        assert estimate(bs.own_nut(**numbers, **odd), "ball_diameter").source == own_nut.BY_RATING


def test_a_make_that_is_given_alone_counts():
    row = dataclasses.replace(catalogue()["rexroth-40x10x6-6-double"], make="THK")
    makes = own_nut.makes_of(GROUND)
    assert own_nut.ball_of_make(dataclasses.replace(row, make="rexroth"), makes).ball.value == 6e-3
    assert own_nut.ball_of_make(row, makes) is None


# -- the ball ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [(0.02, 0.005, 0.003, 4.76), (0.04, 0.01, 0.006, 5.76), (0.08, 0.02, 0.0127, 5.76)])
def test_the_ball_of_a_rating_has_that_rating(size):
    """Bisection against the formula that it inverts, where no whole number of balls jumps."""
    circle, lead, ball, turns = size
    phi = math.atan(lead / math.pi / circle)
    in_a_turn = math.pi * circle / ball / math.cos(phi) - 0.5
    rating = own_rating(circle, ball, phi, in_a_turn, turns)
    assert ball_of_rating(rating, circle, lead, math.pi / 4, turns) == pytest.approx(ball, rel=1e-9)
    # the rating grows by the power of 1.3 of the ball, less where the ball is large for its circle
    larger = ball_of_rating(1.01 * rating, circle, lead, math.pi / 4, turns)
    assert 1.0 + 0.01 / 1.45 < larger / ball < 1.0 + 0.01 / 1.15


def own_rating(circle, ball, phi, in_a_turn, turns):
    """ISO 3408-5 at 45° and a conformity of 0.52, written out."""
    alpha = math.pi / 4
    gamma = ball * math.cos(alpha) / circle
    f_c = 9.32 * 10 * (1 - math.sin(alpha) / 3) * gamma**0.3 * (1 - gamma) ** 1.39 / (1 + gamma) ** (1 / 3)
    f_c *= (1.04 / 0.04) ** 0.41
    c_s = f_c * math.cos(alpha) ** 0.86 * in_a_turn ** (2 / 3) * (1000 * ball) ** 1.8 * math.tan(alpha)
    c_s *= math.cos(phi) ** 1.3
    ratio = ((1 - gamma) / (1 + gamma)) ** 1.723
    c_i = c_s * (1 + ratio ** (10 / 3)) ** -0.3
    return c_i * turns**0.86


def test_no_ball_has_a_rating_out_of_all_proportion():
    assert math.isnan(ball_of_rating(1e9, 0.04, 0.01, math.pi / 4, 4.76))
    assert math.isnan(ball_of_rating(1.0, 0.04, 0.01, math.pi / 4, 4.76))


@every_row
def test_balls_by_the_rating_are_within_their_band(row):
    """No constant of it is fitted, to these rows or others."""
    found = without(row, "ball_diameter")
    assert estimate(found, "ball_diameter").source == own_nut.BY_RATING
    assert is_in_band(found, "ball_diameter", row.ball_diameter)
    assert is_in_band(found, "loaded_balls", row.loaded_balls)
    assert found.warnings == ()


@every_row
def test_balls_by_lead_and_diameter_are_within_their_band(row):
    found = without(row, "ball_diameter", "dynamic_load_rating")
    assert estimate(found, "ball_diameter").source == own_nut.BY_RULE
    assert is_in_band(found, "ball_diameter", row.ball_diameter)


def places(rows):
    pitches = [min(row.lead / row.starts / row.nominal_diameter, own_nut.LARGEST_PITCH) for row in rows]
    return np.column_stack([np.ones(len(rows)), np.log(np.array(pitches) / own_nut.LARGEST_PITCH)])


def sizes(rows):
    return np.log([row.ball_diameter / row.nominal_diameter for row in rows])


def test_the_rule_of_the_ball_is_the_least_squares_of_the_rows_shipped():
    found, *_ = np.linalg.lstsq(places(ROWS), sizes(ROWS), rcond=None)
    assert math.exp(found[0]) == pytest.approx(own_nut.RULE_FACTOR, abs=5e-4)
    assert found[1] == pytest.approx(own_nut.RULE_EXPONENT, abs=5e-3)


def test_the_band_of_the_rule_holds_rows_that_it_was_not_fitted_to():
    """Each row by the rule of the other sizes; with the row itself the errors are smaller than they are."""
    low, high = own_nut.RULE_BAND
    for row in ROWS:
        size = (row.make, row.nominal_diameter, row.lead)
        others = [other for other in ROWS if (other.make, other.nominal_diameter, other.lead) != size]
        fit, *_ = np.linalg.lstsq(places(others), sizes(others), rcond=None)
        assert low <= float(np.exp(sizes([row]) - places([row]) @ fit)[0]) <= high, row.name


# -- the other numbers -------------------------------------------------------------------------------


@pytest.mark.parametrize("row", [row for row in ROWS if row.root_diameter], ids=lambda row: row.name)
def test_the_conformity_follows_from_the_root_and_not_from_the_rating(row):
    """Root diameters have 0.54, of balls of 3.175 mm 0.56; the ratings of both are those of one conformity, 0.52."""
    by_root = without(row).row.conformity
    assert by_root == pytest.approx(0.56 if row.ball_diameter == 3.175e-3 else 0.54, abs=5e-4)
    assert estimate(without(row), "conformity").source == own_nut.BY_ROOT
    assert estimate(without(row, "root_diameter"), "conformity").source == own_nut.BY_DEFAULT
    rated = ratings_of(row).dynamic / row.dynamic_load_rating
    assert rated == pytest.approx(1, abs=0.06)
    assert ratings_of(dataclasses.replace(row, rating_conformity=by_root)).dynamic / row.dynamic_load_rating < 0.82


@for_each(row={f"{place}: {row.name}": row for place, row in enumerate(ALL) if row.pitch_circle_diameter})
def test_pitch_circles_are_within_their_band(row):
    assert is_in_band(without(row, "pitch_circle_diameter"), "ball_circle", row.ball_circle)


def test_bands_of_roughness_are_those_of_the_uncertainty():
    text = resources.files("ballscrew").joinpath("data/uncertainties.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    found = without(ROWS[0])
    for name in ("ball_roughness", "screw_roughness", "nut_roughness"):
        one = estimate(found, name)
        assert one.high / one.value == pytest.approx(table[name]["factor"])
        assert one.value / one.low == pytest.approx(table[name]["factor"])


@pytest.mark.parametrize("name", ["rexroth-16x10x3-3-single", "rexroth-80x20x9-6-double", "hiwin-20-8k5",
                                  "hiwin-40-5k5", "hiwin-50-20k4"])  # fmt: skip
def test_the_friction_torque_hardly_depends_on_what_the_rating_tells(name):
    """A ball larger by a tenth changes the friction torque by less than that: 6 % at most over the rows shipped."""
    row, oil, model = catalogue()[name], bs.Lubricant.from_grade("ISO VG 100", 313.15), bs.FrictionModel.reference()

    def torque(of):
        return float(model(of.screw(), oil, axial_load=row.dynamic_load_rating / 10, screw_speed=10.0).screw_torque)

    changed = without(row, "ball_diameter", "pitch_circle_diameter", "root_diameter").row
    assert torque(changed) / torque(without(row).row) == pytest.approx(1, abs=0.065)


# -- what does not go together -----------------------------------------------------------------------


def test_ratings_that_no_geometry_has_are_named():
    """The two of HIWIN's list whose ratings the head of the file calls wrong, and no other of 77."""
    named = {row.name for row in (*ROWS, *STOCK) if without(row).warnings}
    assert named == {*MISPRINTS}


def test_a_rating_in_the_wrong_unit_is_named_with_its_value_and_a_remedy():
    row = catalogue()["rexroth-40x10x6-6-double"]
    (warning,) = without(dataclasses.replace(row, dynamic_load_rating=7210.0)).warnings
    assert warning.subject == "screw.dynamic_load_rating"
    assert warning.severity == "warning"
    assert "7.21 kN" in warning.text
    assert "check its unit" in warning.text
    found = without(dataclasses.replace(row, dynamic_load_rating=7210.0), "ball_diameter")
    assert estimate(found, "ball_diameter").source == own_nut.BY_RULE
    assert "goes with no ball" in found.warnings[0].text


def test_a_root_that_is_no_bottom_of_a_groove_is_named():
    row = dataclasses.replace(catalogue()["hiwin-40-20k4"], root_diameter=34.4e-3)
    found = without(row)
    assert found.warnings[0].subject == "screw.root_diameter"
    assert found.row.conformity == 0.54


# -- in Python ---------------------------------------------------------------------------------------


def test_own_nut_in_python():
    found = bs.own_nut(
        nominal_diameter=0.04,
        lead=0.01,
        turns=6,
        ball_diameter=0.006,
        dynamic_load_rating=72100,
        nut="double",
        preload_share=0.07,
    )
    listed = catalogue()["rexroth-40x10x6-6-double"]
    screw = found.row.screw()
    assert (screw.loaded_balls, screw.ball_diameter) == (listed.loaded_balls, 0.006)
    assert screw.nut.preload == pytest.approx(0.07 * 72100)
    assert {one.name for one in found.estimates} == {
        "ball_circle",
        "conformity",
        "contact_angle",
        "loaded_balls",
        "ball_roughness",
        "screw_roughness",
        "nut_roughness",
    }
    assert all(one.low <= one.value <= one.high for one in found.estimates)


@pytest.mark.parametrize(
    ("faulty", "words"),
    [
        ({"nominal_diameter": -0.04}, "nominal_diameter: must be positive"),
        ({"turns": 0.2}, "turns: must be above 0.24"),
        ({"nut": "twin"}, "nut: unknown kind of nut"),
        ({"ball_diameter": 0.011}, "too big for the lead"),
        # whose rating would be that of no circle at all
        ({"ball_diameter": 0.06, "dynamic_load_rating": 5e4}, "ball_diameter: too big for the pitch circle"),
        ({"lead": float("nan")}, "lead: "),
        # the ball that would be estimated is of 0 m, and nobody has typed it
        ({"starts": 1_000_000}, r"starts: leaves no room for balls \(1000000\) · .* 1e-05 mm apart"),
        ({"starts": 1_000_000, "dynamic_load_rating": 5e4}, "starts: leaves no room for balls"),
        ({"lead": 1e-7}, r"lead: leaves no room for balls \(0\.0001 mm\) · .* larger lead or fewer starts"),
    ],
)
def test_numbers_that_no_nut_has(faulty, words):
    with pytest.raises(bs.InputError, match=words) as raised:
        bs.own_nut(**{"nominal_diameter": 0.04, "lead": 0.01, "turns": 5, **faulty})
    assert len(raised.value.faults) == 1


@pytest.mark.parametrize(
    ("other", "cost", "is_kept"), [("inch", 3.0, True), ("inch", 1.9, False), ("metric", 2.5, False)]
)
def test_another_size_of_balls_must_pay(other, cost, is_kept):
    """Of 20 grooves three fit another ball: it stays where they save more than 6, or 9 beyond inches and metric."""
    inch, beside = (np.argmin(np.abs(own_nut.BALLS - size)) for size in (0.25 * 0.0254, 0.28125 * 0.0254))
    ball = beside if other == "inch" else np.argmin(np.abs(own_nut.BALLS - 7.0e-3))
    costs = np.full((20, own_nut.BALLS.size, 5, own_nut._FACTORS.size), np.inf)
    costs[:, :, 0, 0] = 50.0
    costs[:17, inch, 0, 0] = 0.0
    costs[17:, inch, 0, 0] = cost
    costs[17:, ball, 0, 0] = 0.0
    choice = own_nut._choice(costs, np.ones(20, dtype=int))
    assert {*choice.balls.tolist()} == ({inch, ball} if is_kept else {inch})
