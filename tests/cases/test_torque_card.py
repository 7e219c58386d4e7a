"""Torque cards: what is read, what is refused, and what comes out of a comparison and of a log."""

import csv
import importlib.util
import json
import math
import tomllib

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.torque_cards import torque_card
from ballscrew.questions.validate import answer, compute
from ballscrew.questions.validate.sheet import sheet
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "torque_cards" / "synthetic_40x10.toml"
TEXT = EXAMPLE.read_text(encoding="utf-8")


@pytest.fixture
def changed(tmp_path):
    def write(*changes, name="mine"):
        path = tmp_path / f"{name}.toml"
        found = TEXT
        for old, new in changes:
            assert old in found
            found = found.replace(old, new)
        path.write_text(found, encoding="utf-8")
        return path

    return write


def test_a_card_in_si():
    card = torque_card.read(EXAMPLE)
    assert card.synthetic
    assert card.title.startswith("SYNTHETIC")
    assert card.case.screw.nut.preload == pytest.approx(0.05 * 72100)
    assert card.setup.torque_uncertainty == pytest.approx(0.004)
    assert card.setup.nut_outer_diameter == pytest.approx(0.063)
    first = card.points[0]
    assert first.screw_speed == pytest.approx(10 * math.pi / 30)
    assert first.torque == pytest.approx((0.3780 + 0.3729) / 2)
    assert first.temperature == pytest.approx(297.15)


def test_the_schema_takes_the_example_and_refuses_another():
    tables = tomllib.loads(TEXT)
    tables["card"]["when"] = tables["card"]["when"].isoformat()  # JSON has no dates
    schema = torque_card.json_schema()
    jsonschema_rs = pytest.importorskip(
        "jsonschema_rs", reason="jsonschema_rs is not among the oldest packages that are tested"
    )
    jsonschema_rs.validate(schema, tables)
    del tables["setup"]["wipers"]
    assert not jsonschema_rs.is_valid(schema, tables)


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ('torque_uncertainty = "4 mN m"', "", r"mine\.toml: setup\.torque_uncertainty: missing"),
        ('"0.3780 N m"', '"378.0"', r"points\.1\.torque_forward: needs a unit"),
        ('"0.3780 N m"', '"378.0 kN m"', r"points: has torques too far apart for one screw"),
        ('"0.3780 N m"', '"-0.3 N m"', r"points\.1\.torque_forward: must be positive"),
        ("format = 1", "format = 2", r"card\.format"),
        ('made_by = "model"', 'made_by = "guess"', r"card\.made_by"),
        ("when = 2026-11-22", 'when = "yesterday"', r"card\.when"),
        ('licence = "CC0-1.0"', "", r"card\.licence: missing"),
        ("wipers = false", 'wipers = "no"', r"setup\.wipers: must be true or false"),
        ('preload = "5 %"', 'preload = "0 N"', r"nut\.preload: missing"),
        ('preload = "5 %"', 'preload = "5"', r"nut\.preload: needs a unit"),
        ("[setup]", "[set_up]", r"set_up: unknown section.*setup"),
        (
            'grade = "ISO VG 68"\ntemperature = "24 degC"',
            'viscosity = "0.1 Pa s"',
            r"points\.temperature: needs an oil",
        ),
    ],
)
def test_what_is_wrong_with_a_card_is_said(changed, old, new, where):
    with pytest.raises(InputError, match=where):
        torque_card.read(changed((old, new)))


def test_all_faults_of_all_cards_of_a_folder_at_once(changed):
    folder = changed(('"0.3780 N m"', '"378.0"'), name="one").parent
    changed(("wipers = false", ""), ('licence = "CC0-1.0"', ""), name="two")
    with pytest.raises(InputError) as refused:
        torque_card.read_all([folder])
    assert [fault.where.split(":")[0] for fault in refused.value.faults] == ["one.toml", "two.toml", "two.toml"]
    with pytest.raises(InputError, match="has no torque cards"):
        torque_card.read_all([folder.parent])


def test_what_a_card_leaves_open_is_said(changed):
    path = changed(("wipers = false", "wipers = true"), ('run_in = "20 h at 500 rpm without load"\n', ""))
    notes = torque_card.read(path).notes
    assert any("wipers were fitted" in note for note in notes)
    assert "not stated: setup.run_in" in notes


def test_a_card_against_the_model():
    """Uncalibrated first; the ratio is that to the mean of both directions, the band theirs and the instrument's."""
    request = compute.request(cards=[EXAMPLE])
    ((entries, notes),) = compute.evaluate(request)
    assert notes == ["synthetic_40x10: synthetic: made by a model, says nothing of a screw"]
    before, after = answer.documents(entries)
    assert (before["calibration"], after["calibration"]) == (None, "rexroth-2006")
    assert before["card"]["made_by"] == "model"
    card = torque_card.read(EXAMPLE)
    for row, point in zip(before["rows"], card.points, strict=True):
        alone = card.case.model(
            card.case.screw,
            card.case.lubricant,
            axial_load=0.0,
            screw_speed=point.screw_speed,
            temperature=point.temperature,
        )
        assert row["value"] == pytest.approx(float(alone.screw_torque), rel=1e-12)
        assert row["ratio"] == pytest.approx(row["value"] / point.torque)
        assert (row["low"], row["high"]) == pytest.approx((min(point.readings) - 4e-3, max(point.readings) + 4e-3))
    rule = next(rule for rule in before["rules"] if rule["rule"] == "rexroth")
    torques = [point.torque for point in card.points]
    assert rule["mean_ratio"] == pytest.approx(sum(0.004 * 3605 * 0.04 / t for t in torques) / len(torques))
    assert "SYNTHETIC" in sheet(entries, request).title


def test_cards_go_with_no_set():
    with pytest.raises(InputError, match="--card: goes with no set"):
        compute.request(["thk-jis"], cards=[EXAMPLE])


def test_a_card_as_a_log_and_a_case(tmp_path):
    card, log, case = torque_card.read(EXAMPLE), tmp_path / "log.csv", tmp_path / "case.toml"
    torque_card.write(card, EXAMPLE.parent, log, case)
    rows = list(csv.DictReader(line for line in log.read_text(encoding="utf-8").splitlines() if line[0] != "#"))
    assert len(rows) == 2 * len(card.points)
    assert [float(rows[i]["speed [rpm]"]) for i in (0, 1)] == [10, -10]
    assert [float(rows[i]["torque [N m]"]) for i in (0, 1)] == [0.3780, -0.3729]
    assert float(rows[0]["temperature [degC]"]) == pytest.approx(24)
    assert case_file.load(case).screw == card.case.screw


def test_the_example_is_what_its_script_makes(tmp_path, monkeypatch):
    """If this was meant to move: python examples/make_torque_card.py --write."""
    place = EXAMPLE.parents[1] / "make_torque_card.py"
    spec = importlib.util.spec_from_file_location("make_torque_card", place)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.text() == TEXT
    other = tmp_path / "card.toml"
    other.write_text(TEXT.replace("10 rpm", "11 rpm"), encoding="utf-8")
    monkeypatch.setattr(module, "CARD", other)
    monkeypatch.setattr("sys.argv", [str(place)])
    with pytest.raises(SystemExit, match="is not what this script makes"):
        module.main()
    monkeypatch.setattr("sys.argv", [str(place), "--write"])
    module.main()
    assert other.read_text(encoding="utf-8") == TEXT


def test_the_commands(ballscrew):
    checked = ballscrew("card", "check", EXAMPLE, "--json")
    assert checked.returncode == 0, checked.stderr
    (found,) = json.loads(checked.stdout)
    assert found["synthetic"] is True
    assert len(found["points"]) == 5
    assert json.loads(ballscrew("card", "schema").stdout)["title"] == "ballscrew torque card"
    assert len(json.loads(ballscrew("validate", "--card", EXAMPLE, "--json").stdout)) == 2
    refused = ballscrew("card", "check", "none.toml")
    assert refused.returncode == 2
    assert "does not exist" in refused.stderr
