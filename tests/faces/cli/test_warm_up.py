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
from support.pictures import drawn, size

EXAMPLE = ROOT / "examples" / "warm_up.toml"
#: A single nut at one operating point; without a nut the model answers the quickest.
POINT = """
[screw]
pitch_circle_diameter = "40 mm"
lead = "10 mm"
ball_diameter = "6 mm"
loaded_balls = 60
contact_angle = "45 deg"
screw_conformity = 0.54
nut_conformity = 0.54
[lubricant]
grade = "ISO VG 100"
temperature = "30 degC"
[operation]
axial_load = "4 kN"
screw_speed = "1000 rpm"
[surroundings]
shaft_length = "1 m"
"""
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


@pytest.mark.slow
def test_example_in_all_forms(ballscrew, tmp_path):
    """The cycle of the example, four hours warm and one cool: face of the issue, tables and picture."""
    done = ballscrew("warm-up", EXAMPLE, "--hours", "4", "--cool-down", "1", "--json", "--to", "all")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout, parse_constant=lambda constant: pytest.fail(f"{constant} in JSON"))
    assert {"inputs", "results", "units", "assumed", "warnings", "verdicts", "checks", "provenance"} == set(found)
    results, instants = found["results"], len(found["results"]["time"])
    end = results["equilibrium"]
    last = max(i for i, works in enumerate(results["works"]) if works)
    assert results["time"][last] == 4 * 3600
    assert results["nut_temperature"][last] == pytest.approx(end["nut_temperature"], abs=1e-3)
    assert {path.name for path in (tmp_path / "all").iterdir()} == {
        "warm_up.csv",
        "warm_up.xlsx",
        "compensation.csv",
        "warm_up.png",
    }
    with (tmp_path / "all" / "compensation.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert list(rows[0]) == ["place [mm]", "growth [um]"]
    assert [float(row["growth [um]"]) for row in rows] == pytest.approx(
        [1e6 * value for value in results["compensation"]["growth"]], rel=1e-9, abs=1e-9
    )
    with (tmp_path / "all" / "warm_up.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == instants
    assert float(rows[last]["temperature of the nut [degC]"]) == pytest.approx(
        end["nut_temperature"] - 273.15, abs=1e-3
    )
    width, height = size((tmp_path / "all" / "warm_up.png").read_bytes())
    assert width > height / 2 > 500
    assert (tmp_path / "all" / "warm_up.xlsx").read_bytes().startswith(b"PK")


@pytest.mark.slow
def test_band_in_all_forms(ballscrew, tmp_path):
    """JSON, text, picture and table of a band; a number that the file gives with its own band is the case's."""
    (tmp_path / "case.toml").write_text(POINT + 'ball_conductance = "4 ± 1 W/K"\nshaft_share = "0.5 ± 0"\n', "utf-8")
    common = ["warm-up", "case.toml", "--hours", "0.5", "--band", "--samples", "16"]
    done = ballscrew(*common, "--json", "--to", "all", "--to", "band.svg")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout, parse_constant=lambda constant: pytest.fail(f"{constant} in JSON"))
    band, results = found["band"], found["results"]
    assert (band["samples"], band["level"]) == (16, 0.95)
    assert band["time"] == results["time"]
    inputs = band["inputs"]
    assert inputs["surroundings.ball_conductance"] == {
        "distribution": "4 W/K ± 1 W/K",
        "source": "given",
        "given": True,
    }
    assert "surroundings.shaft_share" not in inputs  # exact
    assert not inputs["surroundings.nut_conductance"]["given"]
    shown = drawn(tmp_path / "band.svg").text
    assert "time [h]" in shown
    assert "95 % of samples" in shown
    with (tmp_path / "all" / "warm_up_band.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["temperature of the nut, high [degC]"]) for row in rows] == pytest.approx(
        [value - 273.15 for value in band["nut_temperature"]["high"]], abs=1e-6
    )
    said = " ".join(ballscrew(*common, "--only-given").stdout.split())
    assert "Bands: 95 % of 16 samples" in said
    assert "of 1 uncertain inputs of surroundings, screw, oil and model, 1 of them given" in said


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
def test_a_cycle_like_that_of_the_drift_test(ballscrew, tmp_path):
    """Full stroke at half of rapid, with an hour of rest; drift at both ends and the middle."""
    done = ballscrew("warm-up", EXAMPLE, "--drift-cycle", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["inputs"]["motion"]["speed"] == pytest.approx(10 / 60 / 2)
    assert found["inputs"]["motion"]["stroke"] == pytest.approx(0.8)
    assert found["results"]["time"][-1] == 5 * 3600
    assert len(found["results"]["drift"]["place"]) == 3
    (tmp_path / "case.toml").write_text(POINT, encoding="utf-8")
    for words, line in (
        (["case.toml", "--drift-cycle"],
         "--drift-cycle: has no motion whose stroke it could take · add [axis] and [motion]"),
        ([EXAMPLE, "--feed-share", "0.4"], "--feed-share: needs --drift-cycle (0.4) · add --drift-cycle"),
        ([EXAMPLE, "--drift-cycle", "--feed-share", "2"],
         "--feed-share: must be above 0 and at most 1 (2) · write --feed-share 0.5"),
    ):  # fmt: skip
        refused = ballscrew("warm-up", *words)
        assert refused.returncode == 2
        assert line in refused.stderr.splitlines()


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


def test_words_say_what_stands_in_the_document(case):
    report = warmed_up(case(POINT + DOUBLE), hours=0.5, cool_down=0.25)
    said, written = " ".join(terminal.text(sheet(report)).split()), plain(document(report))
    for record in (*written["verdicts"], *written["warnings"]):
        assert record["text"] in said
    assert "0.75 h" in said
    assert "the preload goes from 3000 N to" in said


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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["--hours", "0"], "--hours: must be above 0 and at most 8766 (0) · write --hours 4"),
        (["--hours", "nan"], "--hours: must be above 0 and at most 8766 (nan) · write --hours 4"),
        (["--cool-down", "-1"], "--cool-down: must be 0 to 8766 (-1) · write --cool-down 1"),
        (["--samples", "64"], "--samples: needs --band (64) · add --band"),
        (["--band", "--samples", "1"], "--samples: must be a whole number from 2 to 2^30 (1) · such as 2**14"),
        (["--band", "--level", "2"], "--level: must lie between 0 and 1 (2.0) · 0.95 is usual"),
        (["--set", "surroundings.shaft_length=1 m ± 1 mm"],
         "surroundings.shaft_length: takes no distribution (1 m ± 1 mm) · write one number: \"1 m\""),
        (["--to", "a.doc"],
         "--to: unknown kind of file (a.doc) · end it in .csv, .xlsx, .png, .svg or .pdf, or name a folder"),
        (["--set", "surroundings.ambient=-40 degC"],
         "surroundings.ambient: is not among the temperatures of the oil (-40 °C) · "
         "the oil is known from -15 °C to 120 °C"),
        (["--set", "surroundings.ambiant=20 degC"], 'surroundings.ambiant: unknown key · did you mean "ambient"?'),
        (["--set", "surroundings.coolant=20 degC"],
         'surroundings.coolant: has no bore to flow through · give bore = "12 mm"'),
    ],
)  # fmt: skip
def test_refusals(ballscrew, tmp_path, arguments, line):
    done = ballscrew("warm-up", EXAMPLE, *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert line in done.stderr.splitlines()
    assert not (tmp_path / "a.doc").exists()


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
    only = ballscrew("run", "case.toml", "--self-heating", "--band", "--to", "a.png")
    assert (only.returncode, (tmp_path / "a.png").exists()) == (2, False)
    assert "--to: draws a curve over the speed" in only.stderr
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
    for options, line in (
        (
            ["--vary", "temperature=20, 40 degC"],
            "sweep.temperature: is not free · leave it out: it follows from the heat",
        ),
        (["--to", "a.zarr"], "--self-heating: fills no store (a.zarr) · write .nc, .csv or .xlsx"),
    ):
        refused = ballscrew("sweep", "case.toml", "--self-heating", *options)
        assert refused.returncode == 2
        assert line in refused.stderr.splitlines()


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
    (tmp_path / "warm.csv").write_text(
        "\n".join([lines[0] + ",temperature [degC]", *(f"{line},40" for line in lines[1:])]), "utf-8"
    )
    (tmp_path / "drive.csv").write_text("\n".join([lines[0].replace("friction", "drive"), *lines[1:]]), "utf-8")
    for name, line in (
        ("warm.csv", "--self-heating: is given beside a log with temperatures · leave it out"),
        ("drive.csv", "--self-heating: needs a log of friction torque: of a torque that is that of the drive"),
    ):
        refused = ballscrew("fit", name, "--case", "case.toml", "--self-heating")
        assert refused.returncode == 2
        assert line in refused.stderr


def test_inputs_have_the_surroundings_that_count(case):
    """Also of a case without any: a page shows them where nothing is typed."""
    bare = POINT.replace('[surroundings]\nshaft_length = "1 m"\n', "")
    inputs = document(warmed_up(case(bare), hours=0.1))["inputs"]
    assert inputs["surroundings"]["ambient"] == 293.15
    assert "shaft_length" not in inputs["surroundings"]
