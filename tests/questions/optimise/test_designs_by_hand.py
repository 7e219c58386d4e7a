"""Designs as arrays against rows one by one, and what an optimisation does with them, worked out by hand."""

import math
import types

import jsonschema_rs
import numpy as np
import pytest

from ballscrew.basis.errors import InputError
from ballscrew.physics.sizing.catalogue import CatalogueRow, printed_rows
from ballscrew.physics.sizing.checks import Check
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.optimise import compute
from ballscrew.questions.optimise.compute import _sound, spread
from ballscrew.questions.optimise.design_model import (
    VARIABLES,
    DesignModel,
    Designs,
    Sampled,
    SearchOptions,
    _quantile,
    _sampled,
    design_space,
    makeable_bounds,
)
from ballscrew.questions.optimise.need_schema import json_schema
from ballscrew.questions.select.need import need_of
from ballscrew.questions.select.requirements import Requirements

POINT = {"force": "2 kN", "feed": "10 m/min"}
SIZES = [(0.040, 0.010, 0.006, 5.76), (0.0414, 0.020, 0.00635, 3.76), (0.016, 0.005, 0.003175, 2.76)]


def designs(spacer_balls=False):
    columns = dict(
        zip(("pitch_circle_diameter", "lead", "ball_diameter", "loaded_turns"), np.array(SIZES).T, strict=True)
    )
    nut = types.SimpleNamespace(spacer_balls=spacer_balls)
    screw = types.SimpleNamespace(contact_angle=math.pi / 4, screw_conformity=0.54, nut=nut)
    return Designs.of({**columns, "preload": np.array([0.02, 0.05, 0.1])}, screw)


@pytest.mark.parametrize("spacer_balls", [False, True])
def test_designs_are_rated_as_rows_are(spacer_balls):
    found = designs(spacer_balls)
    for i, (circle, lead, ball, turns) in enumerate(SIZES):
        row = CatalogueRow(
            name="one",
            nominal_diameter=circle,
            lead=lead,
            ball_diameter=ball,
            turns=turns + 0.24,
            spacer_balls=spacer_balls,
        )
        assert found.loaded_balls[i] == row.loaded_balls
        assert found.loaded_turns[i] == row.loaded_balls / row.balls_per_turn
        whole = row_of_turns(row, row.loaded_balls / row.balls_per_turn)
        assert found.dynamic_rating[i] == pytest.approx(ratings_of(whole).dynamic)
        assert found.static_rating[i] == pytest.approx(ratings_of(whole).static)
        assert found.root_diameter[i] == pytest.approx(row.groove_root_diameter)
        assert found.preload[i] == pytest.approx((0.02, 0.05, 0.1)[i] * found.dynamic_rating[i])
        assert found.room[i] == pytest.approx(ball / (lead * math.cos(math.atan(lead / (math.pi * circle)))))


def row_of_turns(row, turns):
    """A row whose loaded turns are those that whole balls fill."""
    return CatalogueRow(
        name=row.name,
        nominal_diameter=row.nominal_diameter,
        lead=row.lead,
        ball_diameter=row.ball_diameter,
        turns=turns + 0.24,
        spacer_balls=row.spacer_balls,
    )


def test_demand_over_capacity_of_designs_by_hand():
    """Half of the rating's life for both halves at the same load; Euler, and the steel cylinder that whirls."""
    found, one = designs(), 0
    mounted = Installation(unsupported_length=1.5, ends=Ends.SUPPORTED_SUPPORTED)
    limits = Limits(running_time=1e4 * 3600, static_safety=3.0, shaft_stress=100e6)
    load, speed, left = -5e3, np.full(3, -100.0), np.array([0.0, 2e3, 0.0])
    used = found.utilisations(
        axial_load=load,
        screw_speed=speed,
        left=left,
        pressure=np.full(3, 2.1e9),
        young_modulus=206e9,
        installation=mounted,
        limits=limits,
    )
    C_a, C_0a, d_r = (values[one] for values in (found.dynamic_rating, found.static_rating, found.root_diameter))
    hours = 1e6 * (C_a / 5e3) ** 3 / (100 / (2 * math.pi)) / 3600
    assert used["running_time"][one] == pytest.approx(1e4 / hours)
    assert used["static_safety"][one] == pytest.approx(3 * 5e3 / C_0a)
    assert used["contact_pressure"][one] == pytest.approx(2.1 / 4.2)
    assert used["shaft_stress"][one] == pytest.approx(5e3 / (math.pi / 4 * d_r**2) / 100e6)
    assert used["buckling"][one] == pytest.approx(5e3 * 2 / (math.pi**3 * 206e9 * d_r**4 / 64 / 1.5**2))
    whirl = (math.pi / 1.5) ** 2 * math.sqrt(206e9 / 7850) * d_r / 4
    assert used["critical_speed"][one] == pytest.approx(100 / (0.8 * whirl))
    assert used["diameter_speed_product"][one] == pytest.approx(40 * 100 / (2 * math.pi) * 60 / 70000)
    # two halves, pressed by 7 kN and by 2 kN: lives by the exponent 10/9
    lives = [1e6 * (found.dynamic_rating[1] / force) ** 3 for force in (7e3, 2e3)]
    both = sum(life ** (-10 / 9) for life in lives) ** -0.9
    assert used["running_time"][1] == pytest.approx(1e4 * 3600 * 100 / (2 * math.pi) / both)


@pytest.mark.parametrize("nut", ["double", "single"])
def test_requirements_of_designs_by_hand(nut):
    """Each requirement over what there is, or the other way round, and none that is not asked for."""
    given = {"remaining_preload": np.array([500.0, 0.0, 1e3]), "maximum_pressure": np.full(3, 1e9)}
    at = {**given, "lift_off_load": np.full(3, 8e3), "holding_torque": np.array([0.1, 0.2, -0.1])}
    numbers = {
        "drive_torque": np.array([4.0, 5, 6]), "preload_torque": np.array([0.5, 1, 2]),
        "rigidity": np.array([2e8, 4e8, 8e8]), "inertia": np.array([1e-3, 2e-3, 3e-3]),
    }  # fmt: skip
    operation = types.SimpleNamespace(axial_load=9e3)
    material = types.SimpleNamespace(young_modulus=206e9)
    case = types.SimpleNamespace(
        operation=operation,
        screw=types.SimpleNamespace(screw_material=material),
        installation=None,
        limits=Limits(),
        turning_shaft=None,
    )
    asked = Requirements(
        largest_drive_torque=5.0,
        largest_preload_torque=1.0,
        least_rigidity=4e8,
        least_remaining_preload=1e3,
        largest_inertia=2e-3,
        largest_step=8e-6,
        counts_per_turn=1000,
        back_driving="forbidden",
        stroke=1.0,
    )

    def used(required):
        model = types.SimpleNamespace(
            requirements=required,
            case=case,
            space=types.SimpleNamespace(nut=nut),
            _back_driving=lambda designs, at: np.array([7.0, 8, 9]),
        )
        return DesignModel.utilisations(model, designs(), np.full(3, 10.0), at, numbers)

    found = used(asked)
    assert found["drive_torque"] == pytest.approx([0.8, 1.0, 1.2])
    assert found["preload_torque"] == pytest.approx([0.5, 1.0, 2.0])
    assert found["rigidity"] == pytest.approx([2.0, 1.0, 0.5])
    assert found["remaining_preload"] == pytest.approx([2.0, math.inf, 1.0])
    assert found["inertia"] == pytest.approx([0.5, 1.0, 1.5])
    assert found["step"] == pytest.approx([1.25, 2.5, 0.625])
    assert found["back_driving"].tolist() == [7, 8, 9]
    assert ("preload" in found) is (nut == "double")
    if nut == "double":
        preload = designs().preload
        assert found["preload"] == pytest.approx([1 - 500 / preload[0], 9 / 8, 1 - 1e3 / preload[2]])
    own = {"static_safety", "contact_pressure", "shaft_stress", "diameter_speed_product"}
    assert set(used(Requirements())) == own | ({"preload"} if nut == "double" else set())
    # without a length of shaft there is no inertia to be judged
    assert "inertia" not in used(Requirements(largest_inertia=2e-3))


@pytest.mark.parametrize(
    ("needs", "holding", "used"), [("forbidden", (0.2, -0.4), 1.2), ("forbidden", (-0.2, -0.4), 0.8),
                                   ("needed", (0.2, 0.4), 0.8), ("needed", (-0.2, 0.4), 1.2)]
)  # fmt: skip
@pytest.mark.parametrize("way", [1, -1])
def test_the_torque_that_a_load_has_left_by_hand(needs, holding, used, way):
    """At rest and at the speed, over the torque without friction: 3 N m for 3π kN on a lead of 2 mm."""
    rest, moving = (way * 3.0 * np.full(3, one) for one in holding)
    model = types.SimpleNamespace(
        case=types.SimpleNamespace(operation=types.SimpleNamespace(axial_load=way * 3e3 * math.pi)),
        requirements=Requirements(back_driving=needs),
        _at=lambda designs, load, speed: {"holding_torque": rest},
    )
    of_lead = types.SimpleNamespace(lead=np.full(3, 0.002))
    found = DesignModel._back_driving(model, of_lead, {"holding_torque": moving})
    assert found == pytest.approx(np.full(3, used))


def test_a_quantile_is_taken_on_the_bad_side():
    values = np.arange(11.0)[np.newaxis]
    sampled = Sampled({}, 0.9)
    # a search shows what it ends with, not what it begins with
    assert [float(_quantile(values, name, sampled)[0]) for name in ("loss", "rigidity")] == pytest.approx([9.0, 1.0])


def test_samples_have_what_a_calibration_left_correlated():
    """Two numbers together, as their covariance says, and all others by themselves."""
    need = need_of({**POINT, "nut": "double"})
    space = design_space(need, quantile=0.9, samples=256)
    centre = {name: math.sqrt(low * high) for name, (low, high) in space.bounds.items()}
    options = {"model": "reference", "calibration": "rexroth-2006", "allow_code": False}
    # a search shows what it ends with, not what it begins with
    case = compute._case(need, space, centre, options)
    factors = _sampled(case, space).factors
    names, covariance = (
        tuple(case.origins.calibration.parameters.values()),
        np.array(case.origins.calibration.covariance),
    )
    drawn = np.cov([np.log(factors[name]) for name in names])
    by_hand = covariance[0, 1] / math.sqrt(covariance[0, 0] * covariance[1, 1])
    assert drawn[0, 1] / math.sqrt(drawn[0, 0] * drawn[1, 1]) == pytest.approx(by_hand, abs=0.08)
    others = [values for name, values in factors.items() if name not in names]
    assert len(others) > 8
    assert max(abs(np.corrcoef(factors[names[0]], one)[0, 1]) for one in others) < 0.1


def test_what_is_no_number_does_not_hold():
    costs = np.array([[1.0, 2], [math.nan, 2], [1, math.inf]])
    constraints = np.array([[-1.0], [math.nan], [-math.inf]])
    # a search shows what it ends with, not what it begins with
    fine, limited = _sound(costs, constraints)
    assert fine.tolist() == [[1, 2], [1e6, 2], [1, 1e6]]
    assert limited.tolist() == [[-1, -1], [1e6, 1], [-1e6, 1]]


def test_members_are_spread_over_the_front():
    """The ends, then always the farthest from those taken: each by brute force."""
    random = np.random.default_rng(3)
    x = np.sort(random.random(40))
    costs = np.column_stack([100 * x, 1 / (0.1 + x)])
    scaled = (costs - costs.min(axis=0)) / np.ptp(costs, axis=0)
    for most in (2, 3, 7):
        found = spread(costs, most)
        assert {0, 39} <= set(found)
        assert len(set(found)) == most
        taken = [0, 39]
        while len(taken) < most:
            gaps = {i: min(math.dist(scaled[i], scaled[j]) for j in taken) for i in range(40) if i not in taken}
            taken.append(max(gaps, key=gaps.get))
        assert found == sorted(taken)
    assert spread(costs, 40) == spread(costs, 99) == list(range(40))
    assert len(spread(np.column_stack([x, np.ones(40)]), 5)) == 5  # a cost that all have alike


def member(loss, life, *checks, valid=True, searched=2.0):
    run = types.SimpleNamespace(run=types.SimpleNamespace(friction=types.SimpleNamespace(valid=valid)))
    return compute.Member({}, {"loss": searched}, run, checks, {"loss": loss, "life": life}, {})


def test_members_by_their_first_objective_with_their_front():
    fails = Check.saying("said", "life", 2.0, 1.0, "1", 2.0, False)
    unjudged = Check.saying("said", "life", None, None, "1", None, None)
    table = [member(3.0, 9.0), member(1.0, 5.0), member(2.0, 4.0), member(0.5, 99.0, fails),
             member(0.7, 99.0, valid=False), member(2.5, 8.0, unjudged)]  # fmt: skip
    # a search shows what it ends with, not what it begins with
    found = compute._marked(table, ["loss", "life"])
    assert [one.objectives["loss"] for one in found] == [0.5, 0.7, 1.0, 2.0, 2.5, 3.0]
    assert [one.pareto for one in found] == [False, False, True, False, True, True]
    by_life = compute._marked(table, ["life"])
    assert [one.objectives["life"] for one in by_life] == [99.0, 99.0, 9.0, 8.0, 5.0, 4.0]
    assert (found[2].holds, found[0].holds, found[4].holds, found[4].fits) == (True, False, False, True)


@pytest.mark.parametrize("full", [1.5, 2.5])
def test_the_largest_change_counts_either_way(full):
    space = types.SimpleNamespace(options=SearchOptions(), objectives=["loss"])
    made = compute.Optimisation(None, space, [member(full, 0.0), member(2.1, 0.0)], 0, None, ("", ""))
    assert made.largest_change == {"loss": pytest.approx(0.25)}
    space.options = SearchOptions(quantile=0.9)
    assert made.largest_change == {}


def test_the_tables_of_a_design():
    """Sizes and balls of the design; what belongs to one screw goes, what belongs to all stays."""
    need = need_of(
        {
            **POINT,
            "nut": {"type": "double", "spacer_balls": True},
            "bodies": {"nut_outer_diameter": "70 mm"},
            "screw": {"contact_angle": "40 deg", "starts": 2, "root_diameter": "35 mm"},
        }
    )
    sizes = {"pitch_circle_diameter": 0.05, "lead": 0.01, "ball_diameter": 0.006}
    found = compute.tables_of(need, design_space(need), sizes, balls=99.0, preload=1234.5)
    assert found["screw"] == {
        "contact_angle": "40 deg",
        "screw_conformity": 0.54,
        "nut_conformity": 0.54,
        "loaded_balls": 99,
        "pitch_circle_diameter": "50 mm",
        "lead": "10 mm",
        "ball_diameter": "6 mm",
    }
    assert found["bodies"] == {}
    assert found["nut"] == {"type": "double", "spacer_balls": True, "preload": "1234.5 N"}
    speed, unit = found["operation"]["screw_speed"].split()
    assert unit == "rpm"
    assert float(speed) == pytest.approx(10 / 0.010)
    need = need_of({**POINT, "nut": "single"})
    single = compute.tables_of(need, design_space(need), sizes, balls=9, preload=1.0)
    assert "preload" not in single["nut"]


def test_bounds_are_those_of_the_need_or_of_the_catalogue():
    rows = printed_rows()
    assert makeable_bounds()["lead"] == (min(row.lead for row in rows), max(row.lead for row in rows))
    bounds = {"lead": "10 mm", "loaded_turns": [2, 5], "preload": ["2 %", 8], "ball_diameter": ["3 mm", "6 mm"]}
    found = design_space(need_of({**POINT, "optimise": {"bounds": bounds}})).bounds
    assert found["lead"] == (0.010, 0.010)
    assert found["loaded_turns"] == (2.0, 5.0)
    assert found["preload"] == pytest.approx((0.02, 0.08))
    assert found["ball_diameter"] == pytest.approx((0.003, 0.006))
    assert found["pitch_circle_diameter"] == makeable_bounds()["pitch_circle_diameter"]
    for wrong in (["3 mm"], ["3 mm", "4 mm", "5 mm"], ["0 mm", "4 mm"], ["5 mm", "4 mm"]):
        with pytest.raises(InputError, match="is not a lower and an upper bound above zero"):
            design_space(need_of({**POINT, "optimise": {"bounds": {"lead": wrong}}}))
    with pytest.raises(InputError, match='a nut of type "single" has none'):
        design_space(need_of({**POINT, "nut": "single", "optimise": {"bounds": {"preload": ["2 %", "5 %"]}}}))


def test_what_is_said_of_the_kind_of_nut():
    for tables, notes in (
        ({}, ["double nut: no kind was given"]),
        ({"nut": "single"}, []),
        ({"nut": ["single", "double"]}, ["single nut: the first of 2"]),
        ({"nut": ["single", "double"], "optimise": {"nut": "double"}}, []),
    ):
        assert list(design_space(need_of({**POINT, **tables})).notes) == notes


def test_what_a_plan_counts():
    case = types.SimpleNamespace(screw=types.SimpleNamespace(nut=types.SimpleNamespace(one_by_one=True)))
    space = types.SimpleNamespace(options=SearchOptions(population=10, generations=4, elastic_generations=3, members=2))
    # a search shows what it ends with, not what it begins with
    plain = compute._plan(space, case)
    assert (plain.rigid, plain.elastic, plain.members, plain.total) == (40, 30, 2, 72)
    space.options = SearchOptions(
        population=10, generations=4, elastic_generations=3, members=2, quantile=0.9, samples=16
    )
    # each design again in all samples
    more = compute._plan(space, case).seconds - plain.seconds
    assert more == pytest.approx(70 * 16 * compute.SECONDS["sample"])
    case.screw.nut.one_by_one = False
    assert compute._plan(space, case).elastic == 0


def test_samples_are_balanced():
    """Sobol' points are balanced in powers of two."""
    assert math.log2(SearchOptions().samples) == round(math.log2(SearchOptions().samples))


def test_the_schema_takes_one_name_and_a_list_of_them():
    valid = jsonschema_rs.validator_for(json_schema()).is_valid
    one = {**POINT, "optimise": {"objectives": "loss"}}
    for objectives, known in (
        ("loss", True),
        (["loss"], True),
        (["loss", "life"], True),
        ([], False),
        ("price", False),
    ):
        assert valid({**one, "optimise": {"objectives": objectives}}) is known, objectives
    for grade, known in ((["ISO VG 68"], True), ("ISO VG 68", True), ([], False)):
        assert valid({**POINT, "lubricant": {"grade": grade}}) is known
    pair = ["5 mm", "9 mm"]
    for bounds, known in (({"lead": pair}, True), ({"lead": pair[:1]}, False), ({"leed": pair}, False)):
        assert valid({**one, "optimise": {"bounds": bounds}}) is known
    assert valid({**one, "optimise": {}})
    assert set(VARIABLES) == {"pitch_circle_diameter", "lead", "ball_diameter", "loaded_turns", "preload"}
