"""The table of all makers: exponents of hand-made rows, what each line is of, and what was chosen on its rows."""

import numpy as np
import pytest

from ballscrew.evidence.validation.entries import Band, Point, exponents
from ballscrew.evidence.validation.sets import SETS
from ballscrew.faces.sheets import terminal
from ballscrew.physics.friction.calibrations import calibrations
from ballscrew.questions.validate import compute, sheet
from ballscrew.questions.validate.sheet import of_makers


@pytest.fixture(scope="module")
def asked():
    return compute.request(["rexroth-single-nut", "thk-jis", "xjtu", "support-bearings", "hiwin-ratings"])


@pytest.fixture(scope="module")
def table(asked):
    rows, notes = sheet.summary(asked)
    assert notes == []
    return rows


def points(sizes, leads):
    return [
        Point(name="a", value=1.0, band=Band(1.0), descriptors={"size": size, "lead": lead})
        for size, lead in zip(sizes, leads, strict=True)
    ]


def test_exponents_of_a_power_law_are_its_own():
    """Property: of ratio = c · d^a · P^b, whatever the rows, the fit of both finds a and b."""
    rng = np.random.default_rng(3)
    for a, b in ((-0.2, 0.15), (0.0, 0.5), (1.3, -0.7)):
        sizes, leads = rng.uniform(0.01, 0.1, 9), rng.uniform(0.002, 0.04, 9)
        found = exponents(points(sizes, leads), list(0.8 * sizes**a * leads**b))
        assert found == pytest.approx({"size": a, "lead": b}, abs=1e-9)


@pytest.mark.parametrize(
    ("sizes", "leads"),
    [
        ([0.02, 0.03, 0.04], [0.005, 0.01, 0.02]),
        ([0.02, 0.03, 0.04, 0.05], [0.01, 0.01, 0.01, 0.01]),
        ([0.02, 0.03, 0.04, 0.05], [0.002, 0.003, 0.004, 0.005]),
    ],
    ids=["too few", "one lead", "leads that go with the diameter"],
)
def test_rows_that_do_not_tell_both_have_no_exponents(sizes, leads):
    assert exponents(points(sizes, leads), [1.0] * len(sizes)) == {}


def test_lines_are_of_torques_of_known_nuts(table):
    """Neither alternatives, nor loads, ratings and bearings: a mean over those says something else."""
    assert list(dict.fromkeys((row.maker, row.nut) for row in table)) == [("Rexroth", "single"), ("THK", "double")]
    models = ["reference", *calibrations(), "jis", "rexroth", "hiwin"]
    for maker in ("Rexroth", "THK"):
        assert [row.name for row in table if row.maker == maker] == models
    kinds = {row.name: row.kind for row in table}
    assert [kinds[name] for name in ("reference", "rexroth-2006", "jis")] == ["model", "calibration", "rule"]


@pytest.mark.slow
def test_lines_have_the_statistics_of_their_rows(table, asked):
    (entries, _), *_ = compute.evaluate(asked)
    single = {row.name: row for row in table if row.maker == "Rexroth"}
    for entry in entries:
        row = single[entry.calibration or "reference"]
        ratios = [point.ratio for point in entry.points]
        assert (row.n, row.share_in_band) == (len(ratios), entry.share_in_band)
        assert [row.mean_ratio, row.std_ratio] == pytest.approx([np.mean(ratios), np.std(ratios, ddof=1)], rel=1e-12)
        assert row.exponents == pytest.approx(entry.exponents, rel=1e-9)


def test_exponents_of_rules_differ_as_their_formulas_do(table):
    """JIS has F √(P d), on pitch circles as large as the diameter; Rexroth's rule F d: over the same rows √(P/d)."""
    single = {row.name: row.exponents for row in table if row.maker == "Rexroth"}
    apart = {name: single["jis"][name] - single["rexroth"][name] for name in ("size", "lead")}
    assert apart == pytest.approx({"size": -0.5, "lead": 0.5}, rel=1e-9)


def test_what_was_chosen_on_rows_is_said(table):
    chosen = {(row.maker, row.name): row.chosen_on for row in table}
    assert len(chosen["Rexroth", "reference"]) == 2
    fitted = "calibration rexroth-2006, fitted"
    assert chosen["Rexroth", "rexroth-2006"] == [*chosen["Rexroth", "reference"], fitted]
    assert all("rexroth-2006" not in word for word in chosen["Rexroth", "reference"])
    assert chosen["Rexroth", "jis"] == chosen["THK", "reference"] == chosen["THK", "rexroth-2006"] == []
    assert "jis" in chosen["THK", "jis"][0]
    other, _ = sheet.summary(compute.request(["rexroth-double-nut"], model="olaru2005"))
    assert [(row.name, bool(row.chosen_on)) for row in other if row.kind != sheet.RULE] == [("olaru2005", False)]


def test_sets_declare_what_was_chosen_on_them():
    fitted = {name: data.calibrations for name, data in SETS.items() if data.calibrations}
    of_rexroth = ["rexroth-2006-rubbing", "rexroth-2006"]
    of_others = {"hiwin-stock": ["hiwin"], "thk-jis": ["jis"]}
    of_double = [*of_rexroth, "jis"]  # whose sizes and preloads the rule was asked for
    assert fitted == {"rexroth-double-nut": of_double, "rexroth-single-nut": of_rexroth, **of_others}
    never = [name for name, data in SETS.items() if not data.used_for]
    assert {"hiwin-stock", "support-bearings", "thk-jis", "xjtu"} <= set(never)
    assert not {"rexroth-double-nut", "rexroth-single-nut"} & set(never)


@pytest.mark.slow
def test_entries_computed_before_are_used(asked, table):
    found = [entries for entries, _ in compute.evaluate(asked)]
    again, _ = sheet.summary(asked, found)
    assert [(row.name, row.mean_ratio) for row in again] == [(row.name, row.mean_ratio) for row in table]


def test_lines_for_people(table):
    text = terminal.text(of_makers(table))
    head, *lines = text.split("\n\n")[1].splitlines()
    assert head.split() == ["Model", "/", "middle", "n", "mean", "scatter", "in", "band", "d0^", "Ph^", "rows"]
    assert [line for line in lines if line in {"  Rexroth, single", "  THK, double"}] == [lines[0], lines[9]]
    told = [line for line in lines if line.endswith(("chosen on", "never used"))]
    assert len(told) == len(table)
    for line, row in zip(told, table, strict=True):
        assert f" {row.n} " in line
        assert f"{float(f'{row.mean_ratio:.3g}'):g}" in line
        assert line.endswith("chosen on" if row.chosen_on else "never used")
    assert "chosen on rexroth-single-nut: " in text
