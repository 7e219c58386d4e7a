"""Ranks, fronts and requirements of tables made by hand: no model is run."""

import dataclasses
import itertools
import math
import types

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.select import candidates, requirements
from ballscrew.questions.select.answer import need_document
from ballscrew.questions.select.candidates import Candidate, Variant
from ballscrew.questions.select.compute import Selection, ranked
from ballscrew.questions.select.need import NeedReader, need_of
from ballscrew.questions.select.requirements import OBJECTIVES, Requirements, front, kept_preload, preload_used
from ballscrew.questions.select.sheet import _dots

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
HOUR = 3600.0


def check(name, used, holds=None):
    said = None if used is None else used <= 1
    return Check.saying("said", name, used, 1.0, "1", used, said if holds is None else holds)


def candidate(name, *checks, loss=1.0, life=2e4 * HOUR, valid=True, complete=True, looked_for=None, **more):
    """A candidate of these checks and numbers."""
    run = types.SimpleNamespace(run=types.SimpleNamespace(friction=types.SimpleNamespace(valid=valid)))
    row = types.SimpleNamespace(name=name, preload=None, preload_share=None, nut="")
    objectives = {**dict.fromkeys(OBJECTIVES, math.nan), "loss": loss, "life": life, **more}
    return Candidate(
        Variant(row, "single", "", {"grade": "A"}),
        None,
        checks,
        objectives,
        0.0,
        0.0,
        None,
        run if complete else None,
        life_looked_for=looked_for,
    )


def test_the_order_of_a_table_made_by_hand():
    fits = check("contact_pressure", 0.9)
    table = [
        candidate("on the front, least loss", fits, loss=1.0, life=1e4 * HOUR),
        candidate("on the front, long life", fits, loss=3.0, life=9e4 * HOUR),
        candidate("behind the front", fits, loss=2.0, life=0.9e4 * HOUR),
        candidate("behind the front, no loss known", fits, loss=math.nan),
        candidate("not judged", check("contact_pressure", None, holds=None), loss=2.5, life=0.8e4 * HOUR),
        candidate("invalid", fits, loss=0.1, life=1e9 * HOUR, valid=False),
        candidate("lives too short", fits, loss=0.5, looked_for=1.1e4 * HOUR, life=1e4 * HOUR),
        candidate("fails by 20 %, small loss", check("contact_pressure", 1.2), loss=1.0),
        candidate("fails by 20 %, large loss", check("rigidity", 1.2), loss=2.0),
        candidate("fails by what is not known", check("back_driving", None, holds=False)),
        candidate("ruled out, by 30 %", check("buckling", 1.3), check("rigidity", 9.0)),
        candidate("ruled out, by 40 %", check("buckling", 1.4), complete=False),
    ]
    order = [
        "on the front, least loss", "on the front, long life", "behind the front", "not judged",
        "behind the front, no loss known", "invalid", "lives too short", "fails by 20 %, small loss",
        "fails by 20 %, large loss", "fails by what is not known", "ruled out, by 30 %", "ruled out, by 40 %",
    ]  # fmt: skip
    for seed in range(3):
        shuffled = [table[place] for place in np.random.default_rng(seed).permutation(len(table))]
        found = ranked(shuffled, ["loss", "life"])
        assert [one.candidate.name for one in found] == order
        assert [one.rank for one in found] == list(range(1, 13))
        assert {one.candidate.name for one in found if one.pareto} == set(order[:2])
    made = Selection(None, ["loss", "life"], found)
    assert made.best is table[0]
    assert [one.candidate.name for one in made.holding] == [
        name for name in order if not name.startswith(("not judged", "fails", "ruled out"))
    ]


def test_candidates_outside_the_validity_alone_have_a_front():
    table = [candidate(name, loss=loss, valid=False) for name, loss in (("b", 2.0), ("a", 1.0), ("c", 1.0))]
    found = ranked(table, ["loss"])
    assert [(one.candidate.name, one.pareto) for one in found] == [("a", True), ("c", True), ("b", False)]
    assert Selection(None, ["loss"], found).best is None
    assert ranked([], ["loss", "life"]) == []


def test_what_a_candidate_says_of_its_checks():
    """Ruled out by its loads beyond 1.25; the worst of all, infinite where a check fails by what is not known."""
    for used, out in ((1.25, False), (1.2501, True)):
        one = candidate("x", check("life", used), check("drive_torque", 7.0))
        assert one.cannot_hold is out
        assert (one.worst, one.worst_by_loads) == (7.0, used)
    assert candidate("x").worst == 0.0
    assert candidate("x", check("life", math.nan, holds=False), check("buckling", 0.4)).worst == 0.4
    assert candidate("x", check("life", None, holds=False), check("buckling", 0.4)).worst == math.inf
    assert candidate("x", check("life", 0.4)).holds
    assert not candidate("x", check("life", 0.4), complete=False).holds
    unjudged = Check.saying("said", "life", None, None, "1", None, None)
    assert candidate("x", unjudged).fits
    assert not candidate("x", unjudged).holds
    assert candidate("x", looked_for=2e4 * HOUR, life=1e4 * HOUR).life_short == 2.0
    assert candidate("x", looked_for=2e4 * HOUR, life=0.0).life_short == math.inf
    assert candidate("x", looked_for=2e4 * HOUR, life=math.nan).life_short == 0.0
    assert candidate("x", life=1.0).life_short == 0.0
    with pytest.raises(bs.InputError, match="has no full model of what cannot hold"):
        _ = candidate("x", complete=False).checked


@pytest.mark.parametrize("columns", [1, 2, 3, 4])
def test_the_front_is_that_of_brute_force(columns):
    """Each row against each other one; of small whole numbers, so that many are equal."""
    random = np.random.default_rng(columns)
    for _ in range(20):
        costs = random.integers(0, 5, (30, columns)).astype(float)
        costs[random.random(costs.shape) < 0.03] = math.nan
        known = ~np.isnan(costs).any(axis=1)
        beaten = [
            any(known[j] and all(costs[j] <= costs[i]) and any(costs[j] < costs[i]) for j in range(30))
            for i in range(30)
        ]
        assert front(costs).tolist() == [bool(k and not b) for k, b in zip(known, beaten, strict=True)]


# -- requirements ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("left", "load", "used"),
    [(4000.0, 0.0, 0.0), (1000.0, 3000.0, 0.75), (1e-9, 9000.0, 1.0), (0.0, 12000.0, 1.2), (0.0, -12000.0, 1.2)],
)
def test_the_share_of_a_preload_that_a_load_takes(left, load, used):
    """Of 4 kN with lift-off of rigid bodies at 10 kN."""
    assert float(preload_used(4000.0, left, load, 10e3)) == pytest.approx(used)
    found = kept_preload(4000.0, load, types.SimpleNamespace(remaining_preload=left, rigid_lift_off_load=10e3))
    assert (found.value, found.limit, found.utilisation) == (left, 0.0, pytest.approx(used))
    assert found.holds is (left > 0)
    assert "rigid bodies lose it above" in found.text


def test_a_preload_that_elastic_bodies_lose_sooner():
    balls = types.SimpleNamespace(remaining_preload=0.0, rigid_lift_off_load=10e3)
    for load, said in ((9999.0, False), (-9999.0, False), (10e3, True), (-10001.0, True)):
        found = kept_preload(4000.0, load, balls)
        assert found.utilisation > 1
        assert ("rigid bodies" in found.text) is said
    assert kept_preload(0.0, 9e3, balls) is None


@pytest.mark.parametrize(
    ("needs", "holding", "value", "holds"),
    [
        ("forbidden", (-0.2, -0.4, -0.3), -0.2, True),
        ("forbidden", (-0.2, 0.1, -0.3), 0.1, False),
        ("forbidden", (0.0, -0.1, -0.3), 0.0, True),
        ("needed", (0.2, 0.1, 0.3), 0.1, True),
        ("needed", (0.2, -0.1, 0.3), -0.1, False),
        ("needed", (0.0, 0.1, 0.3), 0.0, False),
        ("needed", (math.nan, 0.1, 0.3), 0.1, True),
        ("forbidden", (math.nan, math.nan, math.nan), None, None),
    ],
)
@pytest.mark.parametrize("way", [1, -1])
def test_whether_a_load_turns_the_screw(needs, holding, value, holds, way):
    """By the torque left at rest, at the speed, and at the speed in a full bath, in the direction of the load."""
    rest, moving, flooded = (way * one for one in holding)
    friction = types.SimpleNamespace(
        ideal_torque=way * 1.0, flooded_torque=abs(way * 1.0 - flooded), holding_torque=moving
    )
    run = types.SimpleNamespace(
        at_rest=types.SimpleNamespace(axial_load=way * 5e3, holding_torque=rest), friction=friction
    )
    found = requirements.back_driving(Requirements(back_driving=needs), types.SimpleNamespace(run=run))
    assert found.value == (None if value is None else pytest.approx(value, abs=1e-12))
    assert found.holds is holds


def test_whether_a_load_turns_the_screw_is_not_asked_or_not_known():
    run = types.SimpleNamespace(at_rest=types.SimpleNamespace(axial_load=0.0))
    assert requirements.back_driving(Requirements(), types.SimpleNamespace(run=run)) is None
    found = requirements.back_driving(Requirements(back_driving="needed"), types.SimpleNamespace(run=run))
    assert (found.holds, found.value) == (None, None)


@pytest.mark.parametrize(
    ("needs", "falls", "value", "holds"),
    [
        ("forbidden", (True, False), 0.7, False), ("forbidden", (False, False), 0.7, True),
        ("needed", (True, False), 0.3, False), ("needed", (True, True), 0.3, True),
    ],
)  # fmt: skip
def test_whether_an_axis_moves_with_the_motor_off(needs, falls, value, holds):
    """Forbidden in any condition, needed in every one."""
    conditions = [
        types.SimpleNamespace(falls=fall, holding_torque=torque) for fall, torque in zip(falls, (0.7, 0.3), strict=True)
    ]
    brake = types.SimpleNamespace(falls=any(falls), holding_torque=0.7, conditions=conditions)
    numbers = dict.fromkeys(OBJECTIVES, math.nan)
    report = types.SimpleNamespace(brake=brake)
    (found,) = requirements.of_friction(Requirements(back_driving=needs), None, report, numbers)
    assert (found.value, found.holds) == (value, holds)
    assert requirements.of_friction(Requirements(), None, report, numbers) == ()


def test_steps_and_bounds_by_hand():
    asked = Requirements(counts_per_turn=1000, largest_step=8e-6)
    found = requirements.step(asked, 0.010)
    assert (found.value, found.utilisation, found.holds) == (pytest.approx(1e-5), pytest.approx(1.25), False)
    assert requirements.step(dataclasses.replace(asked, largest_step=None), 0.010) is None
    assert requirements.step(Requirements(), 0.010) is None
    bounds = Requirements(largest_drive_torque=5.0, largest_preload_torque=1.0, least_rigidity=4e8)
    run = types.SimpleNamespace(brake=None)
    numbers = {"drive_torque": 4.0, "preload_torque": 1.2, "rigidity": math.nan}

    def with_rigidities(**by_standard):
        every = {**dict.fromkeys(("nut", "nut_corrected", "drive"), math.nan), **by_standard}
        return types.SimpleNamespace(nut=types.SimpleNamespace(rigidity=types.SimpleNamespace(**every)))

    drive, idle, rigidity = requirements.of_friction(bounds, with_rigidities(), run, numbers)
    assert (drive.utilisation, drive.holds) == (pytest.approx(0.8), True)
    assert (idle.utilisation, idle.holds) == (pytest.approx(1.2), False)
    assert (rigidity.utilisation, rigidity.holds, rigidity.limit) == (None, None, 4e8)
    assert "rigidity of the nut under the load: not known here" in rigidity.text
    # of the balls under the load and of the nut as catalogues print it the smaller; shaft and bearings stand beside it
    printed = with_rigidities(nut=6e8, nut_corrected=3e8, drive=2e8)
    for balls, value in ((5e8, 3e8), (2.5e8, 2.5e8), (math.nan, 3e8)):
        *_, rigidity = requirements.of_friction(bounds, printed, run, {**numbers, "rigidity": balls})
        assert (rigidity.value, rigidity.holds) == (value, False)
        assert "by ISO 3408-4, 300 N/µm; nut, shaft and bearings together 200 N/µm" in rigidity.text
    *_, rigidity = requirements.of_friction(bounds, with_rigidities(nut=6e8), run, {**numbers, "rigidity": 9e8})
    assert (rigidity.value, rigidity.holds) == (6e8, True)


# -- numbers compared -----------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "drive"), [(10.0, 3.0), (-10.0, -3.0), (10.0, -1.0), (0.0, 3.0)])
@pytest.mark.parametrize("starves", [True, False])
def test_numbers_of_a_point_in_a_full_bath(speed, drive, starves):
    """0.2 N m more friction in a full bath: against the motion, and 10 rad/s times as much power."""
    friction = types.SimpleNamespace(
        screw_torque=0.5, flooded_torque=0.7, friction_power=5.0, drive_torque=drive, screw_speed=speed
    )
    life = types.SimpleNamespace(name="running_time", value=7.0)
    found = types.SimpleNamespace(run=types.SimpleNamespace(friction=friction), checks=[check("life", 0.3), life])
    # numbers of a candidate by hand, without the model that a selection asks
    numbers = candidates._of_point(found, starves=starves)
    more = 0.2 if starves else 0.0
    assert numbers["loss"] == pytest.approx(5.0 + more * abs(speed))
    assert numbers["drive_torque"] == pytest.approx(max(abs(drive), abs(drive + np.sign(speed) * more)))
    assert numbers["life"] == 7.0


@pytest.mark.parametrize("starves", [True, False])
def test_numbers_of_a_cycle_in_a_full_bath(starves):
    numbers = {"energy_lost": 30.0, "cycle_time": 4.0, "torque_peak": -6.0, "life_time": 9.0}

    def bath(lost):
        return types.SimpleNamespace(numbers={"energy_lost": lost})

    report = types.SimpleNamespace(numbers=numbers, bath=bath(50.0), motor_torque={"torque_peak": 8.0})
    # numbers of a candidate by hand, without the model that a selection asks
    found = candidates._of_cycle(report, starves=starves)
    expected = {"loss": 12.5, "drive_torque": 8.0} if starves else {"loss": 7.5, "drive_torque": 6.0}
    assert found == {**expected, "life": 9.0}
    # a full bath that loses less takes nothing away
    less = types.SimpleNamespace(numbers=numbers, bath=bath(20.0), motor_torque={"torque_peak": 6.0})
    assert candidates._of_cycle(less, starves=starves)["loss"] == 7.5


def test_the_shaft_by_hand():
    """A steel cylinder of 40 mm and 1 m has 9.86 kg and 19.7 kg cm²; at a lead of 10 mm that is 779 kg."""
    tables = {"screw": {"catalogue": "rexroth-40x10x6-6-double"}, "lubricant": {"grade": "ISO VG 100"}}
    tables |= {"operation": {"axial_load": "1 kN", "screw_speed": "100 rpm"}}
    need = types.SimpleNamespace(requirements=Requirements())
    # numbers of a candidate by hand, without the model that a selection asks
    found = candidates._of_shaft(need, case_file.build(tables))
    mass = 7850 * math.pi * 0.020**2
    assert found["inertia"] == pytest.approx(mass * 0.020**2 / 2)
    assert found["reflected_mass"] == pytest.approx(mass * 0.020**2 / 2 * (2 * math.pi / 0.010) ** 2)
    need = types.SimpleNamespace(requirements=Requirements(stroke=0.5))
    assert candidates._of_shaft(need, case_file.build(tables))["inertia"] == pytest.approx(found["inertia"] / 2)
    mounted = {"unsupported_length": "2 m", "ends": "fixed-fixed", "shaft_density": "2700 kg/m^3"}
    longer = 2 * found["inertia"] * 2700 / 7850
    mounted_case = case_file.build({**tables, "installation": mounted})
    assert candidates._of_shaft(need, mounted_case)["inertia"] == pytest.approx(longer)


# -- what is tried --------------------------------------------------------------------------------

POINT = {"force": "2 kN", "feed": "10 m/min"}


def labels(tables, *rows):
    return [
        (one.nut, one.preload, one.oil_name) for one in candidates.variants(need_of({**POINT, **tables}), rows, None)
    ]


def test_variants_are_each_with_each():
    many = {"nut": ["single", "double"], "preload": ["3 %", "8 %"], "oil": ["VG 68", "VG 220"]}
    oils = ("ISO VG 68", "ISO VG 220")
    expected = [("single", "", oil) for oil in oils] + [("double", p, oil) for oil in oils for p in ("3 %", "8 %")]
    found = labels({"nut": {"type": many["nut"], "preload": many["preload"]}, "oil": many["oil"]}, ROW)
    assert sorted(found) == sorted(expected)


def test_preloads_are_those_of_the_need_or_of_the_row_or_usual_ones():
    listed = dataclasses.replace(ROW, preload=3000.0)
    usual = [("double", share, "ISO VG 100") for share in ("2 %", "5 %", "10 %")]
    assert labels({}, ROW) == usual
    assert labels({"preload": "4 %"}, listed) == [("double", "4 %", "ISO VG 100")]
    assert labels({}, listed) == [("double", "", "ISO VG 100")]
    # the preload that a row lists is that of its own nut
    assert [one[1] for one in labels({"nut": "oversize-balls"}, listed)] == ["2 %", "5 %", "10 %"]
    assert labels({"nut": "single"}, ROW) == [("single", "", "ISO VG 100")]
    assert labels({"nut": {"type": "oversize-balls", "oversize": "5 um"}}, ROW) == [
        ("oversize-balls", "", "ISO VG 100")
    ]


def test_the_length_of_a_nut_by_hand():
    """Its loaded turns and two leads; of two bodies the turns of both."""
    turns = ROW.loaded_turns * ROW.lead
    for nut, length in (("single", turns + 2 * ROW.lead), ("double", 2 * turns + 2 * ROW.lead)):
        # numbers of a candidate by hand, without the model that a selection asks
        assert candidates._nut_length(Variant(ROW, nut, "", {})) == pytest.approx(length)


MOTION = {"mass": "400 kg", "acceleration": "3 m/s^2", "feed": "24 m/min", "stroke": "600 mm"}


@pytest.mark.parametrize("missing", [(), *itertools.combinations(MOTION, 1), ("mass", "stroke")])
def test_a_mass_needs_all_of_its_motion(missing):
    places = {"mass": "axis", "acceleration": "motion", "feed": "need", "stroke": "need"}
    tables = {"axis": {}, "motion": {}, "need": {}}
    for name, value in MOTION.items():
        if name not in missing:
            tables[places[name]][name] = value
    reader = NeedReader(tables)
    reader.make_motion()
    assert [fault.where for fault in reader.faults] == [
        f"{places[name]}.{name}" for name in MOTION if name in missing and name in ("mass", "acceleration")
    ] + [f"need.{name}" for name in ("stroke", "feed") if name in missing]
    if not missing:
        assert tables["motion"] == {
            "acceleration": "3 m/s^2",
            "kind": "trapezoid",
            "stroke": "600 mm",
            "speed": "24 m/min",
        }
        assert "feed" not in tables["need"]
        assert len(reader.notes) == 2
    else:
        assert "kind" not in tables["motion"]
        assert reader.notes == []


def test_what_is_said_beside_a_motion():
    def read(**more):
        axis, motion = {"mass": "1 kg", "inclination": "0 deg"}, {"acceleration": "1 m/s^2", "dwell": "1 s"}
        tables = {"axis": axis, "motion": motion, "need": {"feed": "1 m/s", "stroke": "1 m"}, **more}
        reader = NeedReader(tables)
        reader.make_motion()
        assert reader.notes == []
        return reader

    assert read().faults == []
    assert [fault.where for fault in read(operation={"axial_load": "1 N"}).faults] == ["operation.axial_load"]
    # a motion that is written out is left alone
    reader = read(axis={}, motion={"kind": "sine"}, need={})
    assert reader.faults == []
    assert reader.tables["motion"] == {"kind": "sine"}


def test_the_document_of_a_need_has_what_is_required_and_nothing_else():
    need = need_of(
        {**POINT, "need": {"largest_drive_torque": "5 N m", "back_driving": "no", "accuracy": 5}, "nut": "double"}
    )
    found = need_document(need)
    assert found["requirements"] == {
        "feed": pytest.approx(1 / 6),
        "largest_drive_torque": 5.0,
        "back_driving": "forbidden",
        "accuracy": "5",
    }
    assert found["choices"]["nut"] == ["double"]
    plain = need_document(need_of({"force": "2 kN", "screw_speed": "600 rpm"}))
    assert plain["requirements"] == {"back_driving": "allowed"}


def test_dots_of_a_chart_stand_by_what_became_of_the_candidates():
    """Grey where a check fails, blue where none does, red on the front, whose ranks are named."""

    def one(rank, fits, pareto):
        return types.SimpleNamespace(
            rank=rank,
            pareto=pareto,
            candidate=types.SimpleNamespace(fits=fits, objectives={"loss": rank, "life": 10 * rank}),
        )

    ranked = [one(1, True, True), one(2, True, False), one(3, False, False), one(4, True, True)]
    curves = {curve.name: curve for curve in _dots(ranked, "loss", "life")}
    assert {name: list(curve.x) for name, curve in curves.items()} == {
        "fails": [3],
        "no check fails": [2],
        "Pareto front": [1, 4],
    }
    assert list(curves["Pareto front"].labels) == ["1", "4"]
    assert [curve.colour for curve in curves.values()] == ["grey", "blue", "red"]
