"""HIWIN's stock list against the model: rows as printed, how they are read, and each kind of nut once by hand."""

import math

import numpy as np
import pytest

from ballscrew.basis.errors import InputError
from ballscrew.evidence.validation.entries import Conditions
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.files.tables.rows import made, read
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut, OffsetLeadNut, OversizeBallNut
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.validate import compute

STOCK = SETS["hiwin-stock"]
REFERENCE = FrictionModel.reference()
RPM = math.pi / 30


@pytest.fixture(scope="module")
def rows():
    return {values["name"]: values for values in compute.shipped_rows(STOCK)}


def point(values, model=REFERENCE, conditions=STOCK.conditions):
    (found,) = STOCK.evaluate(model, values, conditions)
    return found


# -- rows as printed ------------------------------------------------------------------------------


def test_rows_are_those_of_the_list(rows):
    assert len(rows) == 33
    kinds = [(values["nut"], values["spacer_balls"]) for values in rows.values()]
    count = {kind: kinds.count(kind) for kind in kinds}
    assert count == {("single", "no"): 8, ("single", "yes"): 16, ("double", "no"): 2, ("offset", "no"): 7}


@pytest.mark.parametrize(
    ("name", "d_0", "d_m", "lead", "ball", "starts", "turns", "rated", "low", "high"),
    [
        ("R6-1.0T3-FSI", 6, 6.1, 1, 0.8, 1, 3, 647, 0, 0.01275),
        ("2R25-50V2-DFSH", 25, 25.8, 50, 3.969, 2, 1.6, 7845, 0.02942, 0.21477),
        ("R20-5B2-FSW", 20, 20.6, 5, 3.175, 1, 5, 9336, 0.02746, 0.12945),
        ("R25-20K3-FSC", 25, 25.6, 20, 3.175, 1, 3, 7747, 0.03923, 0.24517),
        ("R40-10B2-FDW", 40, 41.4, 10, 6.35, 1, 5, 52652, 0.81003, 1.35136),
        ("R50-10B1-OFSW", 50, 51.4, 10, 6.35, 1, 2.5, 31999, 0.47464, 1.10619),
    ],
)
def test_published_numbers(rows, name, d_0, d_m, lead, ball, starts, turns, rated, low, high):
    values = rows[name]
    sizes = ("nominal_diameter", "pitch_circle_diameter", "lead", "ball_diameter")
    assert [1000 * values[size] for size in sizes] == pytest.approx([d_0, d_m, lead, ball], rel=1e-12)
    assert (values["starts"], values["turns"], values["dynamic_load_rating"]) == (starts, pytest.approx(turns), rated)
    assert point(values).band == pytest.approx(((low + high) / 2, low, high), rel=1e-12)


def test_circuits_are_turns_times_circuits(tmp_path):
    """Property: ``2.5x2`` is the product of its numbers, and a plain number itself, whatever the numbers."""
    rng = np.random.default_rng(4)
    pairs = [
        (round(float(turns), 2), int(circuits))
        for turns, circuits in zip(rng.uniform(0.5, 4, 40), rng.integers(1, 6, 40), strict=True)
    ]
    written = [*(f"{turns}x{circuits}" for turns, circuits in pairs), "3", "2.5"]
    head = "code,nut,starts,spacer_balls,nominal_diameter_mm,pitch_circle_mm,lead_mm,ball_mm,circuits,"
    head += "dynamic_rating_N,static_rating_N,drag_low_Nm,drag_high_Nm"
    lines = [f"R{i},single,1,none,20,20.6,5,3.175,{text},9336,16985,0.0,0.1" for i, text in enumerate(written)]
    path = tmp_path / "own.csv"
    path.write_text("\n".join([head, *lines]) + "\n", encoding="utf-8")
    found, notes = made(read(path, compute.columns_of(STOCK)), lambda row: row.values["turns"])
    assert notes == []
    assert found == pytest.approx([*(turns * circuits for turns, circuits in pairs), 3, 2.5], rel=1e-12)


def test_ratings_listed_are_those_of_one_half(rows):
    """Ratings by ISO 3408-5 of the circuits of a row over those listed: the numbers that say how the rows are read.

    All nuts with return tubes of 2.5 turns have a few turns less without load than is assumed here, double ones and
    those with an offset as many as single ones. Two rows go with no reading; so do internal returns, of 1 turn each.
    """
    found: dict[str, list[float]] = {}
    for values in rows.values():
        row = screw_of(values)
        carrying = 0.5 if values["spacer_balls"] == "yes" else 1.0
        ratio = ratings_of(row).static * carrying / values["static_load_rating"]
        found.setdefault(f"{values['nut']} {row.name.rpartition('-')[2]}", []).append(ratio)
    tubes = {kind: sorted(of) for kind, of in found.items() if kind.endswith(("FSW", "FDW"))}
    assert tubes["double FDW"] == pytest.approx([1.295, 1.304], abs=1e-3)
    # R32-8B1-OFSW and R25-4B2-FSW are the odd ones, each the first
    assert tubes["offset OFSW"] == pytest.approx([0.926, 1.234, 1.254, 1.261, 1.331, 1.332, 1.341], abs=1e-3)
    assert tubes["single FSW"][0] == pytest.approx(0.796, abs=1e-3)
    assert 1.19 < tubes["single FSW"][1] < tubes["single FSW"][-1] < 1.52
    assert 0.98 < min(found["single FSC"]) < max(found["single FSC"]) < 1.0


# -- one row of each kind by hand -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "rated", "nut", "group"),
    [
        ("R32-10B2-FDW", 47170, DoubleNut, "double"),
        ("R40-12B1-OFSW", 33588, OffsetLeadNut, "offset"),
        ("R12-2T3-FSI", 2128, OversizeBallNut, "single"),
        ("R16-5B1-FSW", 4717, OversizeBallNut, "single, spacer balls"),
    ],
)
def test_a_row_is_the_nut_at_a_medium_preload(rows, name, rated, nut, group):
    oil = Lubricant.from_grade("ISO VG 68", 298.15)

    def torque(share):
        braced = nut(preload=share * rated, spacer_balls="spacer" in group)
        screw = screw_of(rows[name]).screw(nut=braced)
        return float(REFERENCE(screw, oil, axial_load=0.0, screw_speed=100 * RPM).screw_torque)

    found = point(rows[name])
    assert found.group == group
    assert found.value == pytest.approx(torque(0.07), rel=1e-12)
    shares = (0.06, 0.08) if nut is not OversizeBallNut else (0.05, 0.06, 0.08)
    assert list(found.definitions) == [f"at_{100 * share:.0f}_percent" for share in shares]
    for share in shares:
        expected = torque(share) / found.band.middle
        assert found.definitions[f"at_{100 * share:.0f}_percent"] == pytest.approx(expected, rel=1e-12)


def test_rules_by_hand(rows):
    """R32-10B2-FDW: F = 0.07 · 47 170 N on 33.4 mm with a lead of 10 mm; the middle of its range is 0.830625 N m."""
    force, tangent = 0.07 * 47170, 10 / (math.pi * 33.4)
    laws = point(rows["R32-10B2-FDW"]).laws
    assert laws["jis"] * 0.830625 == pytest.approx(0.05 / math.sqrt(tangent) * force * 0.010 / math.tau, rel=1e-12)
    assert laws["rexroth"] * 0.830625 == pytest.approx(0.004 * force * 0.032, rel=1e-12)
    assert point(rows["R12-2T3-FSI"]).laws["rexroth"] * 0.01912 == pytest.approx(0.010 * 0.07 * 2128 * 0.012, rel=1e-12)


def test_oil_and_speed_are_those_of_the_list(rows):
    values = rows["R40-10B2-FDW"]
    assert (STOCK.conditions.grade, STOCK.conditions.screw_speed) == ("ISO VG 68", pytest.approx(100 * RPM))
    assert point(values).value == point(values, conditions=Conditions(grade="ISO VG 68")).value
    assert point(values).value != point(values, conditions=Conditions()).value


def test_nuts_that_a_model_cannot_do_are_left_out(rows):
    found = [one for values in rows.values() for one in STOCK.evaluate(FrictionModel.olaru2005(), values, Conditions())]
    assert {one.group for one in found} == {"double", "offset"}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"nut": "tripple"}, r'row\.nut: unknown kind of preloaded nut \(tripple\) · write "single" or "double"'),
        ({"drag_low": 0.2}, r"row\.drag_high: does not exceed the minimum"),
    ],
)
def test_nonsense_is_refused(rows, changes, message):
    with pytest.raises(InputError, match=message):
        point({**rows["R20-5B2-FSW"], **changes})
