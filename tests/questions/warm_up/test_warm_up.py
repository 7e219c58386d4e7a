"""``ballscrew warm-up`` and ``--self-heating``: words, JSON, tables and picture; what is refused, and how."""

import csv
import dataclasses
import json
import math
from types import SimpleNamespace

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Columns
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.questions.band.compute import heat_samples
from ballscrew.questions.duty import band
from ballscrew.questions.warm_up import band as warm_up_band
from ballscrew.questions.warm_up.answer import document
from ballscrew.questions.warm_up.compute import SERIES, moves, warmed_up
from ballscrew.questions.warm_up.self_heating import self_heating
from ballscrew.questions.warm_up.sheet import sheet
from support.commands import ROOT
from support.own_screws import WITH_OIL

EXAMPLE = ROOT / "examples" / "warm_up.toml"
#: A single nut at one operating point; without a nut the model answers the quickest.
POINT = (
    WITH_OIL
    + """\
temperature = "30 degC"
[operation]
axial_load = "4 kN"
screw_speed = "1000 rpm"
[surroundings]
shaft_length = "1 m"
"""
)
#: Where places and lengths are looked at, friction may be that of the paper: the model is recorded in no time.
SIMPLE = "model.name=olaru2005"
DOUBLE = '[nut]\ntype = "double"\npreload = "3 kN"\n'


@pytest.fixture
def case(tmp_path):
    """The case of a text."""

    def of(written, *settings):
        path = tmp_path / "case.toml"
        path.write_text(written, encoding="utf-8")
        tables = case_file.override(case_file.read(path), settings)
        return case_file.build(tables, moves=moves(tables))

    return of


def records(document, kind):
    return {record["id"]: record for record in document[kind]}


@pytest.mark.parametrize("study", ["warm-up", "duty"])
def test_a_band_of_nothing_is_refused(study):
    case = case_file.load(EXAMPLE, ["model.name=olaru2005"], moves=True)
    # the duty itself is not asked for
    banded, of = (band.band, SimpleNamespace(case=case)) if study == "duty" else (warm_up_band.band, case)
    with pytest.raises(InputError, match=r"^--only-given: the case gives no input a distribution"):
        banded(of, only_given=True)


@pytest.mark.slow
def test_what_the_case_gives_is_no_default(case):
    """Also where it gives the very number that would stand in for it."""
    written = POINT + 'ambient = "20 degC"\nbearing_conductance = "8 ± 2 W/K"\n'
    defaults = [line for line in warmed_up(case(written), hours=0.01).assumed if line.endswith(": the default")]
    assert [line for line in defaults if "bearing" in line] == [
        "mass of each bearing with its housing 3 kg: the default"
    ]
    assert len(defaults) == 3  # and of the nut and the share


def test_an_operating_point_goes_to_and_fro(case):
    report = warmed_up(case(POINT), hours=0.5)
    written = plain(document(report))
    results = written["results"]
    assert results["network"]["stroke"] == pytest.approx(0.5)  # half the shaft
    assert results["network"]["mean_speed"] == pytest.approx(1000 * math.tau / 60, rel=1e-12)
    assert set(results["preload"]) == {0.0}
    assert "verdict.preload" not in records(written, "verdicts")
    said = terminal.text(sheet(report))
    assert "to and fro over 500 mm, half the shaft, under the load of the case" in said
    assert "preload" not in said.partition("Steady state")[0].partition("time ")[2]
    # every quantity of the series has its unit in the document
    assert {name for name in SERIES if not name.startswith("heat_")} <= set(written["units"])


@pytest.mark.slow
def test_a_cycle_like_that_of_the_drift_test(ballscrew):
    """Full stroke at half of rapid, with an hour of rest; drift at both ends and the middle."""
    done = ballscrew("warm-up", EXAMPLE, "--drift-cycle", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["inputs"]["motion"]["speed"] == pytest.approx(10 / 60 / 2)
    assert found["inputs"]["motion"]["stroke"] == pytest.approx(0.8)
    assert found["results"]["time"][-1] == 5 * 3600
    assert len(found["results"]["drift"]["place"]) == 3


def test_stroke_and_length_are_those_of_the_case(case):
    mounted = POINT.replace('[surroundings]\nshaft_length = "1 m"', "[installation]") + (
        'unsupported_length = "0.8 m"\nends = "fixed-supported"\n'
    )
    report = warmed_up(case(mounted, "surroundings.stroke=200 mm", SIMPLE), hours=0.1)
    assert report.duty.states.stroke == pytest.approx(0.2)
    assert report.warm_up.network.shaft.length == 0.8
    assert "shaft of 0.8 m: the length of [installation]" in report.assumed


@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "length"),
    [
        (("surroundings.stroke=300 mm",), 0.6),
        ((), 1.0),
        (("axis.mass=0 kg", "motion.kind=trapezoid", "motion.stroke=200 mm", "motion.speed=6 m/min",
          "motion.acceleration=2 m/s^2"), 0.4),
    ],
    ids=["stroke", "nothing", "motion"],
)  # fmt: skip
def test_a_length_that_is_not_given_is_assumed_and_warned_of(case, settings, length):
    written = POINT.partition("[surroundings]")[0]
    report = warmed_up(case(written, *settings, SIMPLE), hours=0.02)
    assert report.warm_up.network.shaft.length == pytest.approx(length)
    warned = records(plain(document(report)), "warnings")["warm_up.assumed_length"]
    assert warned["value"] == pytest.approx(length)


def test_runaway_is_said_and_no_number_clipped(case):
    """A nut on a heat sink at high speed: no steady state, null in the document, and an error as verdict."""
    hot = (
        "operation.screw_speed=3000 rpm",
        "surroundings.nut_conductance=150 W/K",
        "surroundings.ball_conductance=1 W/K",
    )
    report = warmed_up(case(POINT + DOUBLE.replace("3 kN", "5 kN"), *hot), hours=2)
    written = plain(document(report))
    end, verdict = written["results"]["equilibrium"], records(written, "verdicts")["verdict.equilibrium"]
    assert end["exists"] is False
    assert end["margin"] < 0
    assert end["nut_temperature"] is None
    assert verdict["severity"] == "error"
    assert written["results"]["time"][-1] <= written["results"]["stopped"] < 2 * 3600
    assert "Steady state: none" in terminal.text(sheet(report))
    with pytest.raises(InputError, match="finds no steady state"):
        self_heating(case(POINT + DOUBLE.replace("3 kN", "5 kN"), *hot))


def test_temperatures_of_a_motion_do_not_count(case):
    segments = '[axis]\nmass = "0 kg"\n[motion]\nkind = "segments"\n' + "".join(
        f'[[motion.segment]]\nduration = "2 s"\nspeed = "{speed} m/min"\ntemperature = "50 degC"\n' for speed in (6, -6)
    )
    report = warmed_up(case(POINT + segments), hours=0.01)
    warned = records(plain(document(report)), "warnings")
    assert "do not count" in warned["warm_up.own_temperatures"]["text"]
    said = records(plain(document(report)), "verdicts")["verdict.long_cycle"]["text"]
    assert "the heat goes along with the nut" in said  # 4 s of 36 s


def test_an_oil_warmer_than_its_data_sheet_goes_is_warned_of(case):
    sheet = 'kinematic_viscosity_40 = "100 cSt"\nkinematic_viscosity_100 = "11 cSt"\ndensity_15 = "880 kg/m^3"'
    written = POINT.replace('grade = "ISO VG 100"', sheet + '\nhighest_temperature = "31 degC"')
    report = warmed_up(case(written, "surroundings.ambient=30 degC"), hours=0.5)
    said = [record["text"] for record in plain(document(report))["warnings"]]
    assert any("31 degC" in one for one in said), said
    assert plain(document(warmed_up(case(written, "surroundings.ambient=10 degC"), hours=0.5)))["warnings"] == []


def test_self_heating_is_the_steady_state(case):
    found = self_heating(case(POINT + DOUBLE))
    end = found.equilibrium
    assert found.warm.lubricant.temperature == end.oil_temperature
    assert found.warm.screw.nut.preload == end.preload
    # the work of the torque there is the heat that the temperatures are those of
    assert found.torque * 1000 * math.tau / 60 == pytest.approx(end.power, rel=2e-3)
    assert found.given.lubricant.temperature == pytest.approx(303.15)


def test_run_and_check_say_self_heating(ballscrew, tmp_path):
    (tmp_path / "case.toml").write_text(POINT, encoding="utf-8")
    done = ballscrew("run", "case.toml", "--self-heating", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    heated = found["results"]["self_heating"]
    assert heated["oil_temperature_given"] == pytest.approx(303.15) == found["inputs"]["lubricant"]["temperature"]
    assert heated["screw_torque"] == found["results"]["screw_torque"]
    assert set(heated) == set(found["units"]["self_heating"])
    assert found["verdicts"][0]["id"] == "verdict.self_heating"
    words = " ".join(ballscrew("run", "case.toml", "--self-heating").stdout.split())
    assert "self-heating: oil at" in words
    assert f"not {heated['screw_torque_given']:.4g} N m" in words
    checked = ballscrew("check", "case.toml", "--self-heating")
    assert "self-heating: oil at" in checked.stdout, checked.stderr


def test_columns_of_the_shaft(case):
    report = warmed_up(case(POINT), hours=0.1)
    (shaft,) = (block for block in sheet(report).of_kind(Columns) if block.name == "shaft")
    assert len(shaft.columns) == 1 + report.warm_up.places.size
    assert {len(column.values) for column in shaft.columns} == {report.warm_up.time.size}


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        (["operation.screw_speed=0 rpm"], "operation.screw_speed: is zero"),
        (["surroundings.stroke=2 m"], "does not fit between the bearings"),
    ],
)
def test_points_that_warm_nothing(case, settings, line):
    with pytest.raises(InputError, match=line):
        warmed_up(case(POINT, *settings))


def test_an_oil_without_a_temperature_is_refused(case):
    written = POINT.replace('grade = "ISO VG 100"\ntemperature = "30 degC"', 'viscosity = "88 mPa s"')
    with pytest.raises(InputError, match=r"lubricant\.viscosity: has no temperature"):
        warmed_up(case(written))


@pytest.mark.slow
def test_band_and_comparison_with_self_heating(ballscrew, tmp_path, case):
    """About the warm point; temperature and preload are those of samples of the surroundings, not independent."""
    (tmp_path / "case.toml").write_text(POINT + DOUBLE, encoding="utf-8")
    done = ballscrew("run", "case.toml", "--self-heating", "--band", "--samples", "64", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    heated = found["results"]["self_heating"]
    band = found["band"]
    assert band["screw_torque"]["value"] == pytest.approx(heated["screw_torque"], rel=1e-9)
    assert "steady states of samples" in band["inputs"]["temperature"]["reason"]
    heating = self_heating(case(POINT + DOUBLE))
    heat = heat_samples(heating)
    oil, preload = heat.samples.values
    assert heat.samples.names == ("temperature", "preload")
    assert np.min(oil) < heated["oil_temperature"] < np.max(oil)
    assert np.corrcoef(oil, np.log(preload))[0, 1] > 0.2  # a nut that holds tighter is warmer
    drawn = heat.samples.quantiles(np.array([[0.0, 0.5, 1 - 1e-12], [0.3, 0.3, 0.3]]))
    assert drawn["temperature"].tolist() == [np.min(oil), np.sort(oil)[oil.size // 2], np.max(oil)]
    compared = json.loads(ballscrew("compare", "case.toml", "--self-heating", "--json").stdout)
    assert compared["case"]["screw_torque"] == pytest.approx(heated["screw_torque"], rel=1e-9)
    assert compared["assumed"] == found["assumed"]


@pytest.mark.slow
def test_sweep_with_self_heating(ballscrew, tmp_path):
    """Each point as ``run --self-heating`` has it; assumptions and runaway on the error stream."""
    (tmp_path / "case.toml").write_text(POINT, encoding="utf-8")
    done = ballscrew("sweep", "case.toml", "--self-heating", "--vary", "screw_speed=500, 1000 rpm")
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader(done.stdout.splitlines()))
    alone = json.loads(ballscrew("run", "case.toml", "--self-heating", "--json").stdout)
    assert float(rows[1]["oil temperature [degC]"]) == pytest.approx(
        alone["results"]["self_heating"]["oil_temperature"] - 273.15, abs=1e-6
    )
    assert float(rows[1]["screw torque [N m]"]) == pytest.approx(alone["results"]["screw_torque"], rel=1e-6)
    assert "assumed of the heat" in done.stderr
    assert any("from nut to shaft" in line for line in alone["assumed"])


@pytest.mark.slow
def test_fit_with_self_heating(ballscrew, tmp_path, case):
    """Of torques made warm by their own heat the fit finds the coefficient again; without it, it does not."""
    truth, loaded = 0.15, case(POINT)
    model = dataclasses.replace(
        loaded.model, friction=dataclasses.replace(loaded.model.friction, boundary_friction_coefficient=truth)
    )
    lines = ["axial load [N],screw speed [rpm],friction torque [N m]"]
    for force in (2000.0, 4000.0, 8000.0):
        for rpm in (100, 300, 600, 1000, 1500, 2000):
            point = {"axial_load": force, "screw_speed": rpm * math.tau / 60}
            duty = bs.to_and_fro(model, loaded.screw, loaded.lubricant, **point, stroke=0.5)
            oil = loaded.lubricant.at(bs.steady_heat(duty, loaded.surroundings).oil_temperature)
            lines.append(f"{force},{rpm},{float(model(loaded.screw, oil, **point).screw_torque):.12g}")
    (tmp_path / "log.csv").write_text("\n".join(lines), "utf-8")
    (tmp_path / "case.toml").write_text(POINT, "utf-8")
    common = ["fit", "log.csv", "--case", "case.toml", "--holdout", "0", "--json"]
    found, cold = (json.loads(ballscrew(*common, *options).stdout) for options in (["--self-heating"], []))
    estimate = found["estimates"]["boundary_friction_coefficient"]
    assert estimate["value"] == pytest.approx(truth, rel=0.01)
    assert abs(cold["estimates"]["boundary_friction_coefficient"]["value"] / truth - 1) > 0.02
    assert "in the steady state of the measured torque" in found["assumed"][0]
    assert "assumed" not in cold
    (tmp_path / "drive.csv").write_text("\n".join([lines[0].replace("friction", "drive"), *lines[1:]]), "utf-8")
    refused = ballscrew("fit", "drive.csv", "--case", "case.toml", "--self-heating")
    assert refused.returncode == 2
    assert "--self-heating: needs a log of friction torque: of a torque that is that of the drive" in refused.stderr


def test_inputs_have_the_surroundings_that_count(case):
    """Also of a case without any: a page shows them where nothing is typed."""
    bare = POINT.replace('[surroundings]\nshaft_length = "1 m"\n', "")
    inputs = document(warmed_up(case(bare), hours=0.1))["inputs"]
    assert inputs["surroundings"]["ambient"] == 293.15
    assert "shaft_length" not in inputs["surroundings"]
