"""``ballscrew sensitivity``: what to find out next, as table, JSON and picture."""

import json
import math
import re
from pathlib import Path

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.basis.output.json_text import as_json
from ballscrew.basis.output.sheet import Bars, Lines, Table
from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.cases.case_files.case import NO_ORIGINS
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.questions.sensitivity import answer
from ballscrew.questions.sensitivity.answer import LAWS_STAY, sheet
from support.pictures import words_of

EXAMPLES = Path(__file__).parents[3] / "examples"
#: Two inputs that the case gives a distribution, one of them without any effect on the torque of this model.
GIVEN = [
    "screw.screw_conformity=0.515 ± 0.005",
    "operation.axial_load=4 kN ± 0.4 kN",
    "lubricant.density=800 kg/m^3 ± 5 %",
]
SETTINGS = [part for setting in GIVEN for part in ("--set", setting)]
FEW = ("--model", "corrected", "--samples", "64")


@pytest.fixture(scope="module")
def case():
    return case_file.load(EXAMPLES / "olaru2005.toml", GIVEN, "corrected")


@pytest.fixture(scope="module", params=["sobol", "morris", "local"])
def found(request, case):
    return answer.sensitivity(case, answer.SensitivityOptions(method=request.param))


def of_method(case, method, **asked):
    return answer.sensitivity(case, answer.SensitivityOptions(method=method, **asked))


# -- what is varied -------------------------------------------------------------------------------


def test_what_is_given_and_what_is_usual(case):
    every = of_method(case, "local")
    assert set(every.result.inputs) == set(uncertain_inputs.all_of(case))
    given = of_method(case, "local", only_given=True)
    assert set(given.result.inputs) == {"screw_conformity", "axial_load", "density"}
    assert given.result.inputs[-1] == "density"
    assert every.result.effect["axial_load"] == pytest.approx(given.result.effect["axial_load"])


@pytest.mark.slow
def test_inputs_have_words_of_their_own(case):
    reference = case_file.load(EXAMPLES / "feed_drive.toml")
    for one in (case, reference, case_file.load(EXAMPLES / "catalogue_screw.toml")):
        known = Configuration(one.model, one.screw, one.lubricant).inputs
        names = {name: entry for name, entry in known.items() if not name.startswith("nut.")}  # preload, once more
        words = [answer.SensitivityReport(None, {}, names).describe(name) for name in names]
        assert len(set(words)) == len(words)
    assert "oil temperature" in words
    assert "decay of the asperities' share" in words
    assert "boundary friction coefficient" in words


# -- the terminal ---------------------------------------------------------------------------------


def test_the_table(ballscrew, example, case):
    process = ballscrew("sensitivity", example, *FEW, "--only-given", *SETTINGS)
    assert process.returncode == 0, process.stderr
    assert process.stderr == ""
    text = process.stdout
    found = of_method(case, "sobol", samples=64, only_given=True)
    assert text.startswith("what moves the friction torque on the screw: 4000 N, 600 rpm, model corrected\n")
    assert "friction torque on the screw: mean " in text
    rows = text.partition("\nInputs ")[2].partition("\n\n")[0].splitlines()[1:]
    assert [row.strip().split("  ")[0] for row in rows] == [found.describe(name) for name in found.result.inputs]
    first = found.result.inputs[0]
    assert f"{found.result.first_order[first].value:.1%} (" in rows[0]
    assert f"{found.result.left_if_known(first):.1%}" in rows[0]
    assert rows[0].endswith(found.uncertain[first].description)
    assert "* not in the case" not in text
    assert "192 evaluations" not in text
    assert f"{found.result.evaluations} evaluations, seed 0, intervals of 95%" in text
    assert "laws do not" in text
    assert not re.search("nan|inf ", text)
    assert max(map(len, text.splitlines())) <= 120


def test_what_to_find_out_in_words(case):
    sobol = of_method(case, "sobol")
    halved = sobol.result.to_halve
    first, second = (verdict.text for verdict in answer.verdicts(sobol))
    names = ", ".join(sobol.describe(name) for name in halved.inputs)
    assert first == (
        f"to halve the band of the friction torque on the screw, find out: {names} (leaves {halved.remaining:.0%})"
    )
    assert (
        second == f"{sobol.describe(halved.inputs[0])} alone leaves {sobol.result.explained_variance[0].remaining:.0%}"
    )
    only = case_file.load(EXAMPLES / "olaru2005.toml", GIVEN[:1], "corrected")
    assert answer.verdicts(of_method(only, "sobol", only_given=True))[0].text.endswith("screw conformity (leaves 0%)")
    assert [one.text for one in answer.verdicts(of_method(case, "morris"))] == [
        "screening ranks the inputs; what to find out next: --method sobol"
    ]
    constant = of_method(only, "local", only_given=True, output="ideal_torque")
    assert answer.verdicts(constant)[0].text.endswith("does not depend on any of these inputs")


def lines_of(case, report):
    return "\n".join(line.text for block in sheet(case, report).of_kind(Lines) for line in block.lines)


def test_what_was_assumed_is_said(found, case):
    told = lines_of(case, found)
    assert LAWS_STAY in told
    assert "* not in the case, taken as usual: " in told
    assert "by judgement" in told
    for name, one in found.uncertain.items():
        if not one.given and one.source != "judgement":
            assert f"{found.describe(name)} ({one.source})" in told
    (table,) = sheet(case, found).of_kind(Table)
    assert sum(row[-1].endswith(" *") for row in table.rows) == sum(not one.given for one in found.uncertain.values())


def test_a_calibration_is_said_to_be_correlated(case):
    import dataclasses

    calibrated = case_file.load(EXAMPLES / "olaru2005.toml", ["model.calibration=rexroth-2006"], "reference")
    found = of_method(calibrated, "morris", samples=4)
    assert answer.CORRELATED in lines_of(calibrated, found)
    assert answer.CORRELATED not in lines_of(dataclasses.replace(calibrated, origins=NO_ORIGINS), found)


# -- programs -------------------------------------------------------------------------------------


def test_json(ballscrew, example, case):
    process = ballscrew("sensitivity", example, *FEW, "--json", "--output", "efficiency", *SETTINGS)
    assert process.returncode == 0, process.stderr
    document = json.loads(process.stdout)
    assert list(document) == ["inputs", "sensitivity", "units", "warnings", "verdicts", "checks", "provenance"]
    shown, found = document["sensitivity"], of_method(case, "sobol", samples=64, output="efficiency")
    assert [row["name"] for row in shown["inputs"]] == list(found.result.inputs)
    for row in shown["inputs"]:
        estimate = found.result.first_order[row["name"]]
        assert row["first_order"] == pytest.approx(estimate._asdict())
        assert row["total"] == pytest.approx(found.result.total[row["name"]]._asdict())
        assert row["left_if_known"] == pytest.approx(found.result.left_if_known(row["name"]))
        assert row["given"] == (row["name"] in ("screw_conformity", "axial_load", "density"))
    by_name = {row["name"]: row["distribution"] for row in shown["inputs"]}
    assert by_name["axial_load"]["kind"] == "normal"
    assert by_name["axial_load"]["mean"] == 4000
    assert by_name["axial_load"]["high"] is None
    assert shown["to_halve"] == {"inputs": list(found.result.to_halve.inputs), "left": found.result.to_halve.remaining}
    assert shown["method"] == "sobol"
    assert document["units"]["axial_load"] == "N"
    assert document["units"]["efficiency"] == "1"


def test_json_of_what_has_no_number(case):
    document = json.loads(as_json(answer.document(case, of_method(case, "morris", samples=4))))["sensitivity"]
    assert document["standard_deviation"] is None
    assert document["to_halve"] is None
    assert document["knowing"] == []
    assert all(row["left_if_known"] is None for row in document["inputs"])


# -- the picture ----------------------------------------------------------------------------------


@pytest.mark.slow
def test_picture_by_the_command(ballscrew, example, tmp_path):
    path = tmp_path / "bars.svg"
    process = ballscrew("sensitivity", example, "--method", "morris", *FEW, "--json", "--to", path)
    assert process.returncode == 0, process.stderr
    assert re.fullmatch(rf"{re.escape(str(path))}: \d+ inputs\n", process.stderr)
    assert json.loads(process.stdout)["sensitivity"]["method"] == "morris"
    shown = words_of(path)
    for words in ("change by one deviation of the input", "[N m]", "what moves the friction torque on the screw"):
        assert words in shown
    assert "56 loaded balls" in shown
    assert "laws do not" in shown


@pytest.mark.slow
def test_bars_are_the_numbers(found, case):
    result = found.result
    first, *left = sheet(case, found).of_kind(Bars)
    measures = {"sobol": ("first_order", "total"), "morris": ("effect", "effect_deviation"), "local": ("effect",)}
    expected = [result.measures[m][name] for name in result.inputs for m in measures[result.method]]
    assert [bar.parts[0][1] for bar in first.bars] == [estimate.value for estimate in expected]
    if result.method != "local":
        assert [bar.band for bar in first.bars] == [(estimate.low, estimate.high) for estimate in expected]
    assert [bar.name for bar in first.bars if bar.name] == [found.describe(name) for name in result.inputs]
    assert [len(bars.bars) - 1 for bars in left] == [len(result.explained_variance)] * bool(result.explained_variance)
    for bars in left:
        assert [bar.parts[0][1] for bar in bars.bars[1:]] == [known.remaining for known in result.explained_variance]


# -- bad input ------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--output", "torque"], "--output: unknown output (torque) · did you mean "),
        (["--only-given"], "--only-given: the case gives no input a distribution · write one, such as "),
        (["--to", "bars.doc"], "--to: unknown kind of file (bars.doc) · end it in .csv, .xlsx, .png, .svg or .pdf"),
        (
            ["--method", "local", "--set", "operation.axial_load=0 N", "--model", "reference"],
            "",
        ),
    ],
)
def test_bad_input(options, line, ballscrew, example, tmp_path):
    process = ballscrew("sensitivity", example, *options)
    assert process.returncode == 2
    assert process.stdout == ""
    assert process.stderr.startswith(line)
    assert len(process.stderr.splitlines()) <= 10
    assert "Traceback" not in process.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("asked", "line"),
    [
        ({"output": "valid"}, "--output: is true or false, and has no variance (valid) · choose a number"),
        ({"method": "best"}, "--method: unknown method (best) · one of sobol, morris, local"),
        ({"samples": 100}, "--samples: must be a power of two (100) · take 64 or 128"),
        ({"seed": -1}, "--seed: must be a whole number, 0 or more (-1)"),
    ],
)
def test_faults_name_the_option(asked, line, case):
    with pytest.raises(InputError) as caught:
        answer.sensitivity(case, answer.SensitivityOptions(**asked))
    assert caught.value.lines() == [line]


def test_an_elastic_nut_has_no_derivatives_but_samples(ballscrew):
    nut = EXAMPLES / "catalogue_screw.toml"
    refused = ballscrew("sensitivity", nut, "--method", "local")
    assert refused.returncode == 2
    assert refused.stderr == (
        "--method: has no derivatives where balls differ (local) · add --method sobol or --method morris\n"
    )
    process = ballscrew("sensitivity", nut, "--method", "morris", "--samples", "4", "--output", "rigidity")
    assert process.returncode == 0, process.stderr
    assert "double nut" in process.stdout.splitlines()[0]
    assert re.search(r"\d N/µm \(", process.stdout)


def test_no_number_says_so(case):
    assert math.isnan(of_method(case, "morris", samples=4).result.deviation)
    assert "standard deviation 0" not in lines_of(case, of_method(case, "morris", samples=4))
