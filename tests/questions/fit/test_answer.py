"""The answer of a fit: declared once, and the same on every face."""

import dataclasses
import tomllib

import numpy as np
import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Columns
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import files, terminal
from ballscrew.questions.fit import compute
from ballscrew.questions.fit.answer import FitResults, FittedNumber, document
from ballscrew.questions.fit.log import read_options, steady_log
from ballscrew.questions.fit.sheet import of_rows, sheet, trade_off
from ballscrew.questions.shared import declared, schemas
from support.answers import without_unit
from support.fit_logs import EXAMPLES, FRICTION, OFFSET, PAPER, columns, text_of

#: With and without what the log tells.
LOGS = {"told": columns(60), "not told": columns(200, speeds=(10, 600))}


@pytest.fixture(scope="module", params=LOGS)
def fitted(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("log") / "log.csv"
    path.write_text(text_of(LOGS[request.param]), encoding="utf-8")
    case = case_file.build(tomllib.loads(PAPER), None, EXAMPLES)
    options = read_options(case, {"free": [FRICTION, OFFSET]})
    return case, compute.fit(case, steady_log(case, path, options), options)


def test_every_number_is_on_every_face(fitted):
    case, report = fitted
    answer = plain(document(case, report))
    cells = files.rows_of(next(of_rows({"log": report}).of_kind(Columns)))
    row = dict(zip(cells.headings, cells.rows[0], strict=True))
    model = schemas.schema(FitResults).model_json_schema()
    numbers = {name: part for name, part in declared.parts_of(FitResults).items() if part.quantity is not None}
    assert {"temperature_error", "residual_rms", "holdout_rms"} == numbers.keys()
    for name, part in numbers.items():
        described = model["properties"][name]
        assert answer[name] > 0
        assert answer["units"][name] == part.unit == described["x-si-unit"]
        assert described["description"].startswith(part.quantity.info.meaning)
        if part.column is not None:
            assert row[f"{part.column.heading} [{part.unit}]"] == pytest.approx(answer[name], rel=1e-11)
    for name, estimate in answer["estimates"].items():
        for part in declared.parts_of(FittedNumber).values():
            if part.column is not None:
                words = f"{name} {part.column.heading}".strip().replace("_", " ")
                value = estimate[part.name]
                assert row[words] == (None if value is None else pytest.approx(float(value), rel=1e-11))


def test_every_number_has_a_unit(fitted):
    answer = plain(document(*fitted))
    results = {name: answer[name] for name in declared.parts_of(FitResults)}
    # an estimate says its own unit, a column of the log has that of its name, and ratios have none
    own = {"estimates", "sensor", "identifiability", "covariance", "next_test"}
    found = {name for name in without_unit(results, answer["units"]) if name.partition(".")[0] not in own}
    assert found <= {f"residuals.{name}.values" for name in answer["residuals"]}


def test_no_trade_off_is_not_taken_for_a_log_that_determines_each_number(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(text_of(columns(60)), encoding="utf-8")
    case = case_file.build(tomllib.loads(PAPER), None, EXAMPLES)
    options = read_options(case, {"free": [FRICTION]})
    model = compute.fit(case, steady_log(case, path, options), options).model
    assert trade_off(model) == "Trade-offs: none; the log determines each number by itself"
    untold = dataclasses.replace(model.estimates[FRICTION], identified=False, std=None)
    said = trade_off(dataclasses.replace(model, estimates={FRICTION: untold}))
    assert said == "Trade-offs: none; the log does not determine: boundary friction coefficient"


def fit_of(tmp_path, data, free, **changes):
    path = tmp_path / "log.csv"
    path.write_text(text_of(data), encoding="utf-8")
    case = case_file.build(case_file.override(tomllib.loads(PAPER), changes.pop("settings", [])), None, EXAMPLES)
    options = read_options(case, {"free": free, **changes})
    return case, compute.fit(case, steady_log(case, path, options), options)


def sentences(case, report):
    """All that is printed of a fit, below its tables and in them."""
    return " ".join(terminal.text(sheet(case, report)).split())


def test_four_rows_have_no_error_and_no_sentence_that_speaks_of_one(tmp_path):
    case, report = fit_of(tmp_path, columns(4), [FRICTION, OFFSET])
    assert report.model.has_few_rows
    printed = sentences(case, report)
    assert "no estimate has an error" in printed
    for contradiction in ("determines only", "standard error)", "in the errors:", "% of the error of", "known to less"):
        assert contradiction not in printed, contradiction
    assert "spread assumed for the boundary friction coefficient (not identified)" in printed


def test_a_number_that_stands_on_its_prior_is_not_called_known(tmp_path):
    settings = ['model.pure_rolling_offset="0.34 ± 0.02"']
    data = columns(200, speeds=(10, 600))
    case, report = fit_of(tmp_path, data, [FRICTION, OFFSET], settings=settings)
    assert not report.model.estimates[OFFSET].identified
    printed = sentences(case, report)
    assert "pure_rolling_offset is not identified, it stands on its prior" in printed
    assert "pure_rolling_offset is known" not in printed


def test_a_number_that_is_known_by_its_prior_too_is_not_said_to_be_determined_by_the_log(tmp_path):
    """A log that alone leaves more than half of the number open, and a prior with which it is known."""
    _, report = fit_of(tmp_path, columns(60), [FRICTION])
    known = dataclasses.replace(report.model.identifiability, identified={FRICTION: False})
    model = dataclasses.replace(report.model, identifiability=known)
    expected = "the log determines boundary friction coefficient only together with what was known before"
    assert trade_off(model) == f"Trade-offs: none; {expected}"


def test_a_trade_off_of_a_number_that_is_not_identified_has_no_standard_error(tmp_path):
    _, report = fit_of(tmp_path, columns(120), [FRICTION, "constant_torque"])
    identifiability, constant = report.model.identifiability, report.model.estimates["constant_torque"]
    least = dataclasses.replace(identifiability.combinations[-1], powers={FRICTION: 0.9, "constant_torque": -0.4})
    together = dataclasses.replace(identifiability, combinations=[least])

    def sentence(**changes):
        estimates = {**report.model.estimates, "constant_torque": dataclasses.replace(constant, value=0.05, **changes)}
        return trade_off(dataclasses.replace(report.model, identifiability=together, estimates=estimates))

    assert sentence().endswith("fits the rows nearly as well (one standard error)")
    assert sentence(identified=False, std=None).endswith("nearly as well; not identified: constant torque")


def test_what_is_asked_reaches_the_fit(tmp_path):
    """Bounds, rows held out, their seed, the kind of torque and the inertia; how each counts is a test of the fit."""
    data = {"time": 0.5 * np.arange(60.0), **columns(60)}
    bounds, inertia = {FRICTION: "0.15:0.3"}, {"inertia": "0.02 kg m^2", "holdout": 0.0, "kind": "friction"}
    _, bounded = fit_of(tmp_path, data, [FRICTION], bounds=bounds, seed=1)
    estimate = bounded.model.estimates[FRICTION]
    assert (estimate.value, estimate.at_bound) == (pytest.approx(0.15, abs=1e-3), True)
    _, other = fit_of(tmp_path, data, [FRICTION], seed=2)
    assert np.any(bounded.model.rows.held_out != other.model.rows.held_out)
    _, asked = fit_of(tmp_path, data, [FRICTION], **inertia)
    assert not asked.model.rows.held_out.any()
    assert asked.model.rows.convention.kind == "friction"
