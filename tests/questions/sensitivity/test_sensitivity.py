"""``ballscrew sensitivity``: what to find out next, as table, JSON and picture."""

import json
import math
import re

import pytest

from ballscrew.basis.output.json_text import as_json
from ballscrew.basis.output.sheet import Bars, Lines, Table
from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.cases.case_files.case import NO_ORIGINS
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.questions.sensitivity import answer
from ballscrew.questions.sensitivity.answer import LAWS_STAY, sheet
from support.commands import ROOT

EXAMPLES = ROOT / "examples"
#: Two inputs that the case gives a distribution, one of them without any effect on the torque of this model.
GIVEN = [
    "screw.screw_conformity=0.515 ± 0.005",
    "operation.axial_load=4 kN ± 0.4 kN",
    "lubricant.density=800 kg/m^3 ± 5 %",
]


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


def test_json_of_what_has_no_number(case):
    document = json.loads(as_json(answer.document(case, of_method(case, "morris", samples=4))))["sensitivity"]
    assert document["standard_deviation"] is None
    assert document["to_halve"] is None
    assert document["knowing"] == []
    assert all(row["left_if_known"] is None for row in document["inputs"])


# -- the picture ----------------------------------------------------------------------------------


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


def test_an_elastic_nut_has_samples(ballscrew):
    nut = EXAMPLES / "catalogue_screw.toml"
    process = ballscrew("sensitivity", nut, "--method", "morris", "--samples", "4", "--output", "rigidity")
    assert process.returncode == 0, process.stderr
    assert "double nut" in process.stdout.splitlines()[0]
    assert re.search(r"\d N/µm \(", process.stdout)


def test_no_number_says_so(case):
    assert math.isnan(of_method(case, "morris", samples=4).result.deviation)
    assert "standard deviation 0" not in lines_of(case, of_method(case, "morris", samples=4))
