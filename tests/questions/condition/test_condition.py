"""``ballscrew condition``: a table, logs; as words, JSON and picture; and what is refused."""

from types import SimpleNamespace

import pytest

from ballscrew.basis.output.sheet import Chart, Columns, Table
from ballscrew.cases.case_files import case_file
from ballscrew.questions.condition import ConditionOptions, answer
from ballscrew.questions.condition.answer import _shown_rows, sheet
from support.commands import ROOT
from support.pictures import drawn
from support.processes import document_of

EXAMPLES = ROOT / "examples"
TABLE, CASE, NEW, WORN = (
    EXAMPLES / name for name in ("nut_over_years.csv", "service.toml", "nut_new.csv", "nut_worn.csv")
)
#: The model of the paper answers the quickest.
QUICK = ("--case", CASE, "--model", "olaru2005")


@pytest.mark.slow
def test_a_table(ballscrew, tmp_path):
    done = ballscrew("condition", TABLE, "--case", CASE, "--json", "--to", tmp_path / "nut.svg")
    found = document_of(done)
    assert {"inputs", "results", "units", "warnings", "verdicts", "checks", "provenance"} == set(found)
    results = found["results"]
    assert len(results["states"]) == 24
    last = results["states"][-1]
    # the truth of the example
    assert last["preload"]["low"] < 0.75 < last["preload"]["high"]
    assert results["verdict"] == "lost"
    assert results["alarm_direction"] == "fall"
    assert 8 <= results["alarm"] <= results["lost_since"]
    # 15 °C of season do not show: the healthy tests have one torque
    torques = [one["torque"]["value"] for one in results["states"][:8]]
    assert max(torques) / min(torques) < 1.06
    assert results["trend"]["low"] < results["trend"]["slope"] < results["trend"]["high"] < 0
    assert results["states"][0]["limit"] is None
    assert [one["id"] for one in found["verdicts"]][:3] == [
        "condition.alarm",
        "condition.preload_left",
        "condition.trend",
    ]
    assert found["verdicts"][0]["holds"] is False
    identities = [(record["id"], record["subject"]) for record in (*found["warnings"], *found["verdicts"])]
    assert len(set(identities)) == len(identities)
    assert found["provenance"]["logs"][0]["log"] == "nut_over_years.csv"
    assert "friction torque [N m]" in drawn(tmp_path / "nut.svg").text
    assert "nut.svg: 24 tests" in done.stderr


def test_without_temperatures_that_is_said_first(ballscrew, tmp_path):
    lines = [line for line in TABLE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    kept = [",".join(line.split(",")[:3]) for line in lines]
    path = tmp_path / "cold.csv"
    path.write_text("\n".join(kept) + "\n", encoding="utf-8")
    done = ballscrew("condition", path, *QUICK, "--speed", "100 rpm", environment={"COLUMNS": "110"})
    assert done.returncode == 0, done.stderr
    said = done.stdout.splitlines()
    assert said[0] == "cold.csv: double nut, preload 4326 N, model olaru2005"
    assert said[2].startswith("warning  no_temperature: no temperature is logged, and each kelvin is ")
    assert "of the torque" in said[2]


def test_the_sheet_has_every_test_with_its_intervals():
    case = case_file.load(CASE, model="olaru2005")
    result = answer.of_files(case, [TABLE], ConditionOptions())
    shown = sheet(case, result)
    (table,), (columns,) = shown.of_kind(Table), shown.of_kind(Columns)
    for row, state in zip(table.rows, result.states, strict=True):
        assert (row[1].value, row[2].value, row[3].value) == (state.temperature, state.torque, state.preload)
        assert row[2].band == (state.torque_low, state.torque_high)
        assert row[3].band == (state.preload_low, state.preload_high)
    assert [row[0].endswith(" alarm") for row in table.rows].index(True) == result.alarm
    assert list(columns.columns[3].values) == [state.torque for state in result.states]
    marks = {mark.name: mark for mark in next(shown.of_kind(Chart)).marks}
    assert marks["alarm"].x * 86400 == pytest.approx(result.states[result.alarm].time)


@pytest.mark.slow
def test_logs(ballscrew, tmp_path):
    rows = NEW.read_text(encoding="utf-8").splitlines()
    body = [row for row in rows if not row.startswith("#")]
    logs = []
    for i in range(3):  # the same test with other digits, as three days have
        changed = [body[0], *(row.replace(",0,", f",{i + 1},", 1) for row in body[1:])]
        logs.append(tmp_path / f"day{i}.csv")
        logs[-1].write_text("\n".join(changed) + "\n", encoding="utf-8")
    found = document_of(ballscrew("condition", *logs, WORN, *QUICK, "--baseline", "3", "--json"))
    results = found["results"]
    assert [one["label"] for one in results["states"]] == ["day0.csv", "day1.csv", "day2.csv", "nut_worn.csv"]
    assert set(results["states"][-1]["parts"]) == {
        "nut.preload",
        "boundary_friction_coefficient",
        "constant_torque",
        "temperature",
    }
    assert results["states"][-1]["preload"]["high"] < 1
    assert len(found["provenance"]["logs"]) == 4


@pytest.mark.slow
def test_tests_without_a_speed_are_refused_though_the_case_has_one(ballscrew, tmp_path):
    """The speed of the case is of another motion: at 600 rpm in place of 100 rpm an alarm becomes none."""
    lines = [line for line in TABLE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    path = tmp_path / "slow.csv"
    path.write_text("\n".join(",".join(line.split(",")[:4]) for line in lines) + "\n", encoding="utf-8")
    done = ballscrew("condition", path, *QUICK)
    assert done.returncode == 2
    assert not done.stdout
    add = '· add a column "speed [rpm]", or give the speed of all tests: --speed'
    assert f"--speed: is not known {add}" in done.stderr
    assert (
        document_of(ballscrew("condition", path, *QUICK, "--speed", "100 rpm", "--json"))["results"]["alarm"]
        is not None
    )


def test_of_many_tests_the_first_those_about_the_alarm_and_the_last_are_listed():
    many = SimpleNamespace(states=[None] * 100, alarm=50, baseline=4)
    assert _shown_rows(many) == [*range(4), *range(45, 56), *range(90, 100)]
    assert _shown_rows(SimpleNamespace(states=[None] * 100, alarm=None, baseline=4)) == [*range(4), *range(90, 100)]
    assert _shown_rows(SimpleNamespace(states=[None] * 40, alarm=30, baseline=4)) == [*range(40)]
