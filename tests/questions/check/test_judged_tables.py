"""The tables of verdicts and checks as another program reads them: complete, and enough for every record of them."""

import ast
import dataclasses
from pathlib import Path

import pytest

import ballscrew
from ballscrew.basis import units
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.cases.case_files import case_file
from ballscrew.physics.friction.verdicts import PRELOAD_ABOVE_RATING
from ballscrew.physics.sizing.checks import judged as number_judged
from ballscrew.physics.sizing.judged import JUDGED, documents, judged
from ballscrew.questions.check.answer import checked
from ballscrew.questions.run.compute import run
from support.commands import ROOT

EXAMPLES = ROOT / "examples"
SOURCE = Path(ballscrew.__file__).parent
TABLES = documents()
ROWS = {row["id"]: row for name in ("verdicts", "warnings", "checks") for row in TABLES[name]}
#: Beginnings of the ids of records that are of inputs alone, before anything is computed: usual ranges, what a fit said
#: of its numbers, coefficients and the oil they are of, the data sheet of the oil.
OF_INPUTS = ("inputs.implausible", "calibration.", "friction.not_reacted", "lubricant.")


def cases():
    names = ("olaru2005", "catalogue_screw", "feed_axis", "vertical_axis")
    for name in names:
        case = case_file.build(case_file.read(EXAMPLES / f"{name}.toml"), None, EXAMPLES)
        load, speed = abs(float(case.operation.axial_load)) or 1000.0, abs(float(case.operation.screw_speed)) or 10.0
        for of_load, of_speed in ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (0, 1), (30, 1), (0.05, 0.01)):
            operation = dataclasses.replace(case.operation, axial_load=of_load * load, screw_speed=of_speed * speed)
            yield pytest.param(dataclasses.replace(case, operation=operation), id=f"{name} {of_load} {of_speed}")


def filled(sentences, found, words):
    """The first sentence that is said: what a page does with the tables."""
    one = next(one for one in sentences if one["said"] is None or found[one["said"]])
    return one["template"].format(**{name: standing(place, found, words) for name, place in one["places"].items()})


def standing(place, found, words):
    if "sentences" in place:
        return filled(place["sentences"], found, words)
    if "words" in place:
        return words[place["words"]]
    if "constant" in place:
        return place["constant"]
    value, digits = float(found[place["number"]]), place["digits"]
    if "decimals" in place:
        return f"{value:.{place['decimals']}f}"
    quantity = Quantity("", place["unit"], Info("", "", place["shown_in"]))
    return units.number(value, digits) if place["unit"] == "1" else units.shown(value, quantity, digits)


def record(row, found, words):
    """A record of a row."""
    holds = bool(found["holds"]) if "holds" in found else row["holds"]
    fails = holds is False and row["severity_of_failure"]
    return {
        "id": row["id"],
        "subject": row["subject"],
        "value": found.get("value"),
        "unit": row["unit"],
        "limit": found.get("limit"),
        "holds": holds,
        "severity": row["severity_of_failure"] if fails else row["severity"],
        "text": filled(row["sentences"], found, words),
    }


@pytest.mark.parametrize("case", [*cases()])
def test_the_verdicts_of_a_run_follow_from_the_tables(case):
    found = run(case)
    values, words = found.judged
    results = judged(values)
    expected = [
        record(row, results[row["id"]], words)
        for row in TABLES["verdicts"]
        if row["id"] in results and results[row["id"]].get("said", True)
    ]
    assert [one.document() for one in found.verdicts] == expected
    conditions = {f"validity_{reason}": mask for reason, mask in found.friction.validity.items()}
    said = {name for name, one in judged(conditions).items() if one["said"]}
    assert said == {one.id for one in found.conditions if one.id.startswith("validity.")}
    ids = {one.id for one in (*found.verdicts, *found.warnings)} - ROWS.keys()
    assert {one for one in ids if not one.startswith(OF_INPUTS)} == set()


@pytest.mark.parametrize("case", [*cases()])
def test_the_checks_are_those_of_the_table(case):
    made = checked("case", case)
    assert [check.record.id for check in made.checks] == [row["id"] for row in TABLES["checks"]]
    for check, row in zip(made.checks, TABLES["checks"], strict=True):
        assert (check.unit, check.title) == (row["unit"], row["title"])
        if check.missing and check.value is None:
            assert check.missing == row["give"]
        assert check.record.severity == ("error" if check.holds is False else row["severity"])
    assert {one.id for one in made.verdicts} <= {*ROWS, "verdict.checks"}
    assert number_judged(made.checks) <= len(TABLES["checks"])


def test_a_check_by_hand_from_the_tables():
    """A shaft of 10 mm under 5 kN, and its sentence with the words of its ends: read by nothing but names."""
    values = {
        "largest_load": 5000.0, "young_modulus": 2e11, "root_diameter": 0.010, "unsupported_length": 1.0,
        "buckling_root": 3.141592653589793, "limits.buckling_safety": 2.0,
    }  # fmt: skip
    found = judged(values)["check.buckling"]
    made = record(ROWS["check.buckling"], found, {"ends": "hinged"})
    euler = 3.141592653589793**3 * 2e11 * 0.010**4 / 64  # π² E I / l², I = π d⁴/64
    assert made["limit"] == pytest.approx(euler / 2, rel=1e-14)
    assert (made["holds"], made["severity"]) == (False, "error")
    assert made["text"].startswith("largest load, if it pushes, against Euler's over 2, ends hinged")


def test_a_preload_above_its_rating_is_said_once():
    values = {"preload": 400.0, "dynamic_load_rating": 2000.0, "implausible_preload": False}
    found = PRELOAD_ABOVE_RATING.finds(values)
    made = PRELOAD_ABOVE_RATING.record(found, {"rating_source": "as listed"})
    assert made.value == pytest.approx(0.2, rel=1e-15)
    assert "0.2 times the dynamic load rating" in made.text
    assert not PRELOAD_ABOVE_RATING.finds(values | {"implausible_preload": True})["said"]
    assert not PRELOAD_ABOVE_RATING.finds(values | {"preload": 200.0})["said"]


def test_all_records_of_a_run_have_rows():
    """No module of runs and checks makes a record with an id of its own: of those beneath, what inputs alone tell."""
    files = [file for room in ("questions/run", "questions/check", "physics") for file in (SOURCE / room).rglob("*.py")]
    nodes = [node for file in files for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))]
    calls = [node for node in nodes if isinstance(node, ast.Call) and isinstance(node.func, ast.Name | ast.Attribute)]
    names = ("Record", "record", "Record.warning")
    made = [call for call in calls if ast.unparse(call.func).removeprefix("records.") in names]
    ids = {getattr(call.args[0], "value", None) for call in made if call.args}
    literal = {one for one in ids if isinstance(one, str) and "." in one}
    assert {one for one in literal if one.startswith(("verdict.", "validity.", "check.", "run."))} == {"verdict.checks"}
    assert len(ROWS) == len(JUDGED)
