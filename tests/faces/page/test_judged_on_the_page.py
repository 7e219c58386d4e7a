"""Verdicts, checks and the drawing on the static page are those of the program: node runs the scripts of the page."""

import math

import numpy as np
import pytest

from ballscrew.faces.page import kinds
from ballscrew.faces.report.drawing_contact import drawn_ball
from ballscrew.faces.report.drawing_section import BALL, RADIUS, Groove
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.sizing.judged import JUDGED, judged, outputs
from ballscrew.questions.check.answer import checked
from ballscrew.questions.run.compute import run
from support.judged_in_node import JudgedPage, case_at

pytestmark = [pytest.mark.slow, pytest.mark.implausible]

ROW, SINGLE, DOUBLE = ("reference", "row"), ("reference", "single"), ("reference", "double")
OVERSIZE, ELASTIC = ("reference", "oversize-balls"), ("olaru2005", "double+elastic")
ROWS = {row.id for row in JUDGED}
REXROTH, HIWIN = "rexroth-40x10x6-6-double", next(name for name in kinds.start_tables() if name.startswith("hiwin"))
FAR = "rexroth-125x10x6.5-6-double"
MOUNTED = {"unsupported_length": 2.5, "ends": "fixed-supported", "limits.running_time": 7.2e7}
INSTALLATION = Installation(unsupported_length=2.5, ends=Ends.FIXED_SUPPORTED)

#: By name: start, structure, inputs, what is given, and the same as parts of a case.
CASES = {
    "paper": (kinds.PAPER, ROW, {}, {}, {}),
    "paper at rest": (kinds.PAPER, ROW, {"screw_speed": 0.0}, {}, {}),
    "paper without load": (kinds.PAPER, ROW, {"axial_load": 0.0}, {}, {}),
    "starved": (kinds.PAPER, ROW, {"viscosity": 3.0, "screw_speed": 300.0}, {}, {}),
    "lost preload": (REXROTH, DOUBLE, {"axial_load": 3e4, "preload": 2e3}, {}, {}),
    "double nut": (REXROTH, DOUBLE, {"axial_load": -2e3}, {}, {}),
    "far from the rule of its maker": (FAR, DOUBLE, {}, {}, {}),
    "preload above the rating": (REXROTH, DOUBLE, {"preload": 2e4}, {}, {}),
    "back-driving": (HIWIN, SINGLE, {"lead": 0.04, "axial_load": -8e3, "screw_speed": 20.0}, {}, {}),
    "self-locking": (REXROTH, DOUBLE, {"axial_load": 50.0}, {}, {}),
    "installed": (
        HIWIN, SINGLE, {"axial_load": 2e4}, {**MOUNTED, "limits.diameter_speed_product": 5.0},
        {
            "installation": INSTALLATION,
            "limits": Limits(running_time=MOUNTED["limits.running_time"], diameter_speed_product=5.0),
        },
    ),
    "installed double nut": (
        REXROTH, DOUBLE, {"axial_load": 8e3, "screw_speed": -300.0}, MOUNTED,
        {"installation": INSTALLATION, "limits": Limits(running_time=MOUNTED["limits.running_time"])},
    ),
    "oversize": (REXROTH, OVERSIZE, {"axial_load": -3e3, "screw_speed": 30.0}, {}, {}),
    "oversize, lifted": (REXROTH, OVERSIZE, {"axial_load": 3e4}, {}, {}),
    "elastic": (REXROTH, ELASTIC, {"axial_load": 5e3}, {}, {}),
    "elastic, lifted": (REXROTH, ELASTIC, {"axial_load": 2e4, "preload": 2e3}, {}, {}),
    "elastic, lifted backwards": (REXROTH, ELASTIC, {"axial_load": -2e4, "preload": 2e3}, {}, {}),
    "overloaded": (REXROTH, OVERSIZE, {"axial_load": 1e6}, {}, {}),
}  # fmt: skip


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return JudgedPage(tmp_path_factory.mktemp("judged"), [ROW, SINGLE, DOUBLE, OVERSIZE, ELASTIC])


@pytest.fixture(scope="module")
def found(page):
    points = [page.point(start, structure, given, **changes) for start, structure, changes, given, _ in CASES.values()]
    return dict(zip(CASES, page.judged(points), strict=True))


def case_of(page, name):
    start, structure, changes, _, parts = CASES[name]
    return case_at(start, structure, page.inputs(start, structure, **changes), **parts)


def number(text):
    return float(text) if text != "undefined" else math.nan


# -- masks and numbers ----------------------------------------------------------------------------

POINTS = 200
LOOSE = {"verdict.preload_lost:value": 1e-9, "model.power_balance:value": 1e-9, "model.power_balance:percent": 1e-9}


def scattered(page, start, structure, seed):
    """Points with all sizes a fifth around their own, loads and speeds of both signs, rest and no load among them."""
    rng = np.random.default_rng(seed)
    own = page.inputs(start, structure)
    varied = ("pitch_circle_diameter", "lead", "viscosity", "preload", "screw_material.young_modulus")
    points = []
    for _ in range(POINTS):
        changes = {name: own[name] * rng.uniform(0.9, 1.1) for name in varied if name in own}
        for name in ("axial_load", "screw_speed"):
            sign = rng.choice([-1.0, 0.0, 1.0], p=[0.4, 0.2, 0.4])
            changes[name] = sign * abs(own[name]) * 10 ** rng.uniform(-1, 1)
        given = {
            "unsupported_length": rng.uniform(0.5, 5.0), "ends": rng.choice(["fixed-free", "supported-supported"]),
            "limits.running_time": 10 ** rng.uniform(6, 8),
        }  # fmt: skip
        points.append(page.point(start, structure, given if rng.uniform() < 0.7 else {}, **changes))
    return points


def values_at(subject, points):
    """What is judged at points besides the checks, as the model has it on arrays."""
    columns = {name: np.array([one["inputs"][name] for one in points]) for name in points[0]["inputs"]}
    own = {name: column for name, column in columns.items() if name in subject.inputs}
    whole = {name: column[0] for name, column in own.items() if np.all(column == column[0])}
    own |= whole

    def at(**changes):
        return subject.at({**own, **changes})

    found, rest = at(), at(screw_speed=np.zeros(POINTS))
    values = {
        name: getattr(found, name)
        for name in (
            "axial_load",
            "screw_speed",
            "screw_torque",
            "drive_torque",
            "holding_torque",
            "valid",
            "power_imbalance",
            "nut_torque",
            "flooded_torque",
        )
    }
    values |= {"at_rest.holding_torque": rest.holding_torque, "at_rest.valid": rest.valid}
    values |= {f"validity_{reason}": mask for reason, mask in found.validity.items()}
    if subject.nut.is_row:
        return values | {"rolling_share": found.rolling_share}
    of_nut = {name: getattr(found.loads, name) for name in ("remaining_preload", "lift_off_load")}
    return values | of_nut | ({"preload": own["preload"]} if "preload" in own else {})


@pytest.mark.parametrize(
    ("start", "structure"), [(kinds.PAPER, ROW), (REXROTH, DOUBLE), (REXROTH, OVERSIZE)], ids=["row", "double", "four"]
)
def test_what_is_judged_is_what_python_judges(page, start, structure):
    points = scattered(page, start, structure, seed=len(structure[1]))
    made = page.judged(points)
    subject = kinds.subject_of(kinds.case_of(start, *structure))
    expected = outputs(judged(values_at(subject, points)))
    assert any(name.startswith("verdict.quadrant") for name in expected)
    told = set()
    for name, column in expected.items():
        there = np.array([number(one["found"][name]) for one in made])
        wanted = np.broadcast_to(np.asarray(column, dtype=float), POINTS)
        if np.asarray(column).dtype == bool:
            assert np.array_equal(there, wanted), name
            told |= {(name, bool(one)) for one in wanted}
        else:
            assert there == pytest.approx(wanted, rel=LOOSE.get(name, 1e-12), abs=1e-13, nan_ok=True), name
    # the masks of the quadrants hold at some points and not at others
    assert {("verdict.quadrant:said", True), ("verdict.quadrant:said", False)} <= told


# -- records --------------------------------------------------------------------------------------


def parts_of(record):
    return {name: record[name] for name in ("id", "severity", "holds", "text", "subject", "unit")}


def compare(page_records, records):
    wanted = [one for one in records if one["id"] in ROWS]
    assert [parts_of(one) for one in page_records] == [parts_of(one) for one in wanted]
    for mine, one in zip(page_records, wanted, strict=True):
        for name in ("value", "limit"):
            if mine[name] is not None:
                assert mine[name] == pytest.approx(one[name], rel=1e-9, nan_ok=True), (mine["id"], name)


@pytest.mark.parametrize("name", CASES)
def test_the_verdicts_and_warnings_are_those_of_a_run(page, found, name):
    made = run(case_of(page, name))
    compare(found[name]["records"]["verdicts"], [one.document() for one in made.verdicts])
    compare(found[name]["records"]["warnings"], [one.document() for one in made.conditions])


@pytest.mark.parametrize("name", CASES)
def test_the_checks_are_those_of_a_check(page, found, name):
    made = checked(name, case_of(page, name))
    records = found[name]["records"]
    compare(records["checks"], [check.record.document() for check in made.checks])
    for mine, check in zip(records["checks"], made.checks, strict=True):
        used = math.nan if check.utilisation is None else check.utilisation
        mine_used = math.nan if mine["utilisation"] is None else mine["utilisation"]
        assert mine_used == pytest.approx(used, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize(
    ("start", "structure"), [(kinds.PAPER, ROW), (REXROTH, DOUBLE), (REXROTH, OVERSIZE)], ids=["row", "double", "four"]
)
def test_records_at_random_points_are_those_of_the_program(page, start, structure):
    points = scattered(page, start, structure, seed=7)[:15]
    for point, each in zip(points, page.judged(points), strict=True):
        given, parts = point["given"], {}
        if given:
            ends = Ends[given["ends"].upper().replace("-", "_")]
            parts = {
                "installation": Installation(unsupported_length=given["unsupported_length"], ends=ends),
                "limits": Limits(running_time=given["limits.running_time"]),
            }
        case = case_at(start, structure, point["inputs"], **parts)
        made, judgement = run(case), checked("random", case)
        compare(each["records"]["verdicts"], [one.document() for one in made.verdicts])
        compare(each["records"]["warnings"], [one.document() for one in made.conditions])
        compare(each["records"]["checks"], [check.record.document() for check in judgement.checks])


def test_the_cases_say_much(found):
    """Nothing above is true for want of records."""
    ids = {one["id"] for each in found.values() for what in ("verdicts", "warnings") for one in each["records"][what]}
    assert ids >= {
        "lubricant.starved",
        "verdict.no_load",
        "verdict.quadrant",
        "verdict.back_driving",
        "verdict.self_locking",
        "verdict.back_driving.at_rest",
        "verdict.self_locking.at_rest",
        "verdict.rule_of_maker",
        "verdict.preload_lost",
        "validity.contact_pressure",
        "run.preload_above_rating",
    }
    holds = {(one["id"], one["holds"]) for each in found.values() for one in each["records"]["checks"]}
    assert {("check.buckling", True), ("check.buckling", None), ("check.running_time", False)} <= holds


# -- the drawing ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["paper", "double nut", "oversize", "oversize, lifted", "lost preload", "elastic"])
def test_the_drawing_is_that_of_the_report(page, found, name):
    """Contacts, grooves and the widths of contacts, at the scale of the report, whose y points down."""
    ball, places = drawn_ball(run(case_of(page, name))), {n: number(v) for n, v in found[name]["drawing"].items()}
    scale = RADIUS / places["ball_radius"]
    assert places["ball_radius"] == pytest.approx(ball.ball_diameter / 2, rel=1e-15)
    assert {1: places["loaded.touches"], -1: places["other.touches"]} == {
        side: float(side in {flank.side for flank in ball.flanks}) for side in (1, -1)
    }
    for flank in ball.flanks:
        side = "loaded" if flank.side > 0 else "other"
        assert places[f"{side}.load"] == pytest.approx(flank.load, rel=1e-9)
        assert places[f"{side}.angle"] == pytest.approx(flank.angle, rel=1e-9)
        for body, down, conformity, width in (
            ("screw", 1, ball.screw_conformity, ball.contact.semi_major_axis),
            ("nut", -1, ball.nut_conformity, ball.contact.on_nut),
        ):
            groove = Groove(conformity, flank.angle, flank.side, down)
            ends = groove.around(width * scale * (flank.load / ball.load) ** (1 / 3))
            expected = {
                "contact": groove.contact, "bottom": groove.bottom, "edge": groove.edge(places["land"] * scale),
                "from": ends[0], "to": ends[1],
            }  # fmt: skip
            for what, (x, y) in expected.items():
                mine = (places[f"{body}.{side}.{what}.{axis}"] * scale for axis in "xy")
                across, up = mine
                assert (BALL[0] + across, BALL[1] - up) == pytest.approx((x, y), abs=1e-6), (body, side, what)


def test_a_groove_goes_from_its_bottom_to_its_edge_through_the_contact(found):
    """The arcs are circles: edge, bottom and both ends of a contact are as far from the middle of an arc."""
    for each in found.values():
        places = {name: number(value) for name, value in each["drawing"].items()}
        if not places["loaded.load"] > 0:
            continue
        for body in ("screw", "nut"):
            at = {
                what: np.array([places[f"{body}.loaded.{what}.{axis}"] for axis in "xy"])
                for what in ("edge", "bottom", "contact", "from", "to")
            }
            contact, ball = at["contact"], places["ball_radius"]
            assert np.hypot(*contact) == pytest.approx(ball, rel=1e-12)  # the ball touches there
            middle = contact * (1 - places[f"{body}.loaded.radius"] / ball)
            for what in ("edge", "bottom", "from", "to"):
                assert np.hypot(*(at[what] - middle)) == pytest.approx(places[f"{body}.loaded.radius"], rel=1e-9)
            assert at["bottom"][0] == 0.0
            assert abs(at["from"][0]) <= abs(at["contact"][0]) <= abs(at["to"][0])
