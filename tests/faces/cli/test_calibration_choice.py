"""A named calibration chosen on the command line: it wins over the file, and ``none`` is the model as it is."""

import tomllib

import pytest
from typer.testing import CliRunner

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file, descriptions, fitted_case
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.evidence.validation.entries import near_rows
from ballscrew.faces.cli.main import app
from ballscrew.faces.report import contents
from ballscrew.faces.web import documents
from ballscrew.physics.friction.calibrations import BY_MAKE, calibration, calibrations
from ballscrew.questions.run.compute import run
from support.commands import ROOT
from support.drive_case import drive_case

#: The commands that evaluate a case, and what else they need.
COMMANDS = {
    "run": ("{case}",),
    "run of rows": ("{case}", "--rows", "{rows}"),
    "run --band": ("{case}", "--band"),
    "sweep": ("{case}",),
    "sweep of rows": ("{case}", "--rows", "{rows}"),
    "check": ("{case}",),
    "check of a row": ("hiwin-40-20k4",),
    "check of rows": ("{case}", "--rows", "{rows}"),
    "compare": ("{case}",),
    "sensitivity": ("{case}",),
    "reversal": ("{case}",),
    "ripple": ("{case}",),
    "report": ("{case}", "--to", "report.html"),
    "service": ("--case", "{case}", "--torque", "0.4 N m", "--speed", "100 rpm"),
    "fit": ("log.csv", "--case", "{case}"),
    "condition": ("{table}", "--case", "{case}"),
    "duty": ("{moves}",),
    "fit of rows": ("--case", "{case}", "--rows", "{rows}"),
}
CALIBRATED = '[model]\ncalibration = "rexroth-2006"'


@pytest.fixture
def written(tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text(drive_case(more=CALIBRATED), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_that_evaluates_a_case_takes_it(name, written):
    """One that does not pass it on would not find the name wrong."""
    examples = {"rows": "own_screws.csv", "table": "nut_over_years.csv", "moves": "vertical_axis.toml"}
    places = {"case": str(written), **{place: str(ROOT / "examples" / file) for place, file in examples.items()}}
    given = [word.format(**places) for word in COMMANDS[name]]
    done = CliRunner().invoke(app, [name.split()[0], *given, "--calibration", "rexroth-206"])
    assert isinstance(done.exception, InputError), done.output
    assert str(done.exception).startswith("--calibration: unknown calibration (rexroth-206)")


def test_the_page_offers_it():
    """The form is made of the schema."""
    model = json_schema()["$defs"]["Model"]["properties"]
    assert model["calibration"]["enum"] == [*calibrations(), BY_MAKE]


def test_it_wins_over_the_file(written):
    as_written, other, without = (
        case_file.load(written, calibration=name) for name in (None, "rexroth-2006-rubbing", "none")
    )
    assert as_written.origins.calibration == calibration("rexroth-2006")
    assert other.origins.calibration == calibration("rexroth-2006-rubbing")
    assert other.model.ball_force.share_of_load == calibration("rexroth-2006-rubbing").share_of_load
    assert without.origins.calibration is None
    assert without.model == case_file.MODELS["reference"]


def test_a_fault_names_the_option(written):
    with pytest.raises(
        InputError, match=r'^--calibration: unknown calibration .rexroth-206. · did you mean "rexroth-2006"'
    ):
        case_file.load(written, calibration="rexroth-206")
    with pytest.raises(InputError, match=r"^model\.calibration: unknown"):
        case_file.load(written, ["model.calibration=rexroth-206"])


@pytest.mark.parametrize("name", [None, "none", "rexroth-2006-rubbing"])
def test_every_answer_shows_the_ratio_of_the_rows_most_like_the_nut(written, name):
    case = case_file.load(written, calibration=name)
    used = None if case.origins.calibration is None else case.origins.calibration.name
    near = near_rows(case.screw, used)
    answer = documents.run(run(case))
    assert answer["vendor_rows"] == {
        "set": "rexroth-double-nut",
        "maker": "Rexroth",
        "calibration": used,
        "mean_ratio": near.mean,
        "std_ratio": near.scatter,
        "rows": near.rows,
    }
    ratio = f"model / vendor: {near.mean:.2f} ± {near.scatter:.2f} for the 6 rows"
    bullets = contents.beware(run(case))[-1]
    for texts in (answer["words"]["assumed"], bullets.entries, descriptions.assumptions(case)):
        assert sum(ratio in text for text in texts) == 1


def test_a_fit_writes_the_numbers_of_a_calibration_out(written):
    case = case_file.load(written)
    table = fitted_case.written_out(tomllib.loads(CALIBRATED)["model"], case)
    again = case_file.build({**case_file.read(written), "model": table})
    assert again.origins.calibration is None
    assert again.model == case.model
    rubbing = case_file.load(written, ["model.friction=load-sharing"], calibration="rexroth-2006-rubbing")
    table = fitted_case.written_out({"friction": "load-sharing", "calibration": "rexroth-2006-rubbing"}, rubbing)
    assert case_file.build({**case_file.read(written), "model": table}).model == rubbing.model
