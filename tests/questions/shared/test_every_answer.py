"""Answers of all questions: document, units, schema and sheet of each tell the same, whatever the question is."""

import functools
import json
import math
import re
import tempfile
import tomllib
from pathlib import Path

import numpy as np
import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Number, Table
from ballscrew.basis.output.text import WIDTH
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.questions import records, responses
from ballscrew.questions.check import answer as check
from ballscrew.questions.check.sheet import sheet as sheet_of_check
from ballscrew.questions.fit import answer as fit_answer
from ballscrew.questions.fit import compute as fit_compute
from ballscrew.questions.fit.log import read_options, steady_log
from ballscrew.questions.fit.sheet import sheet as sheet_of_fit
from ballscrew.questions.run import compute as run
from ballscrew.questions.run.answer import document as document_of_run
from ballscrew.questions.run.sheet import sheet as sheet_of_run
from ballscrew.questions.shared import declared, schemas
from ballscrew.questions.shared.options import options_of
from ballscrew.questions.shared.question import CaseFile, CaseOptions, Request
from support.answers import without_unit
from support.commands import ROOT
from support.fit_logs import FRICTION, OFFSET, PAPER, columns, text_of

EXAMPLES = ROOT / "examples"
QUESTIONS = {question.name: question for question in records.QUESTIONS}
#: The model of the paper answers the quickest.
QUICK = "model.name=olaru2005"
#: Questions that are records: their files, what is set in the case, and their options as they are written.
ASKED = {
    "axis": ("axis", {"case": "feed_axis.toml"}, (), {}),
    "axis at an operating point": ("axis", {"case": "catalogue_screw.toml"}, (), {}),
    "compare": ("compare", {"cases": "service.toml"}, (), {}),
    "compare of a row of balls": ("compare", {"cases": "olaru2005.toml"}, (), {}),
    "compare without load": ("compare", {"cases": "feed_drive.toml"}, ("operation.axial_load=0 N",), {}),
    "compare under much load": ("compare", {"cases": "feed_drive.toml"}, ("operation.axial_load=100 kN",), {}),
    "condition": ("condition", {"case": "service.toml", "tests": "nut_over_years.csv"}, (QUICK,), {}),
    "duty": ("duty", {"case": "vertical_axis.toml"}, (), {}),
    "duty with guides": ("duty", {"case": "feed_axis.toml"}, (), {}),
    "duty by a rule": (
        "duty", {"case": "vertical_axis.toml"}, ("model.name=constant-efficiency", "model.efficiency=0.9"), {},
    ),
    "duty starved of oil": ("duty", {"case": "feed_axis.toml"}, ("lubricant.temperature=-5 degC",), {}),
    "reversal": ("reversal", {"case": "service.toml"}, ("operation.screw_speed=6 rpm",), {"inertia": "2e-3 kg m^2"}),
    "ripple": (
        "ripple", {"case": "service.toml"}, ("screw.loaded_balls=20", "nut.preload=1.5 kN"),
        {"return_balls": 10, "turns": 6.0, "fault": ["preload=35 %"]},
    ),
    "sensitivity": ("sensitivity", {"case": "olaru2005.toml"}, ("model.name=corrected",), {"samples": 64}),
    "service": ("service", {"case": "service.toml", "logs": "nut_new.csv nut_worn.csv"}, (QUICK,), {}),
    "service by one torque": ("service", {"case": "service.toml"}, (QUICK,), {"torque": "0.5 N m", "speed": "100 rpm"}),
    "warm-up": ("warm-up", {"case": "warm_up.toml"}, (), {"hours": 0.5}),
    "warm-up starved of oil": (
        "warm-up", {"case": "warm_up.toml"}, ("surroundings.ambient=-5 degC", "lubricant.temperature=-5 degC"),
        {"hours": 0.5},
    ),
    "warm-up with a band": ("warm-up", {"case": "rig.toml"}, (QUICK,), {"hours": 0.5, "band": True, "samples": 8}),
}  # fmt: skip
#: Cases of the first question of all.
RUN = {
    "run of a row of equal balls": ("olaru2005.toml", ()),
    "run of a preloaded nut": ("service.toml", ()),
    "run at rest": ("service.toml", ("operation.screw_speed=0 rpm",)),
    "run without load": ("olaru2005.toml", ("operation.axial_load=0 N",)),
    "run against the load": ("catalogue_screw.toml", ("operation.axial_load=-7 kN",)),
    "run backwards": ("catalogue_screw.toml", ("operation.screw_speed=-600 rpm",)),
    "run backwards against the load": (
        "catalogue_screw.toml", ("operation.axial_load=-7 kN", "operation.screw_speed=-600 rpm"),
    ),
    "run of a load that does not suffice": ("catalogue_screw.toml", ("operation.axial_load=-100 N",)),
    "run of a ball that skids": ("olaru2005.toml", ("operation.axial_load=2 N", "model.name=reference")),
    "run on four contacts": ("service.toml", ("nut.type=oversize-balls", "nut.preload=2 kN")),
}  # fmt: skip
CHECK = {
    "check of a row": "rexroth-40x10x6-6-double",
    **{f"check of {name}": str(EXAMPLES / f"{name}.toml") for name in ("olaru2005", "vertical_axis")},
}
FIT = {"fit": columns(60), "fit of what a log does not tell": columns(200, speeds=(10, 600))}
#: Numbers that say their unit themselves, or have none.
OWN_UNITS = {
    "check": {"loads.balls.count", "loads.axial_rigidity.accuracy_factor"},
    "duty": {"motor.utilisation"},  # a share of a torque that changes with the speed
    "service": {"alternatives.value", "alternatives.instead_of"},
}
#: Questions whose units have the names of numbers wherever these stand, and so no places of the schema.
BY_NAME = ("compare", "condition", "fit", "sensitivity")
#: What is no sentence of its own there: without load no ball skids, and a comparison marks the models.
UNSAID = {"run without load": ["validity.skid"], "compare of a row of balls": ["model.power_balance"]}
#: Rows of tables whose numbers are sums and products of those of the document.
MADE_OF_OTHERS = ("sum", "torque", "R_nu,ar")


def asked(name):
    question = QUESTIONS[ASKED[name][0]]
    _, files, settings, options = ASKED[name]
    paths = {file.name: [] for file in question.reads}
    paths |= {file: [EXAMPLES / each for each in names.split()] for file, names in files.items()}
    written = {option: one.written_default for cls in question.options for option, one in options_of(cls).items()}
    given = CaseOptions(settings=list(settings))
    (case,) = (path for every in paths.values() for path in every if path.suffix == ".toml")
    request = Request(files=paths, case=CaseFile(case, given), case_options=given, written=written | options)
    answer = question.answer.prepare(request).answer(lambda *_: None)
    return answer.document(), answer.sheet, responses.OF_QUESTIONS[question.name]


def run_of(name):
    file, settings = RUN[name]
    found = run.run(case_file.load(EXAMPLES / file, settings))
    return document_of_run(found), sheet_of_run(found), responses.Document


def check_of(name):
    found = check.one(CHECK[name], None, check.Options({}, (), None), keep_going=False)[0]
    document = check.document(found)
    del document["name"]
    return document, sheet_of_check(found), responses.Checks


def fit_of(name):
    case = case_file.build(tomllib.loads(PAPER), None, EXAMPLES)
    options = read_options(case, {"free": [FRICTION, OFFSET]})
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        path.write_text(text_of(FIT[name]), encoding="utf-8")
        report = fit_compute.fit(case, steady_log(case, path, options), options)
    return fit_answer.document(case, report), sheet_of_fit(case, report), schemas.schema(fit_answer.FitResults)


MADE = {
    **dict.fromkeys(ASKED, asked),
    **dict.fromkeys(RUN, run_of),
    **dict.fromkeys(CHECK, check_of),
    **dict.fromkeys(FIT, fit_of),
}


@functools.cache
def answered(name):
    """The document, the sheet and the model of an answer."""
    document, sheet, model = MADE[name](name)
    return plain(document), sheet, model


@pytest.fixture(scope="module", params=MADE)
def answer(request):
    return request.param, *answered(request.param)


def numbers_of(document):
    """All numbers of a document, without their signs."""
    if isinstance(document, dict | list):
        for each in document.values() if isinstance(document, dict) else document:
            yield from numbers_of(each)
    elif isinstance(document, int | float) and not isinstance(document, bool):
        yield abs(document)


def resolved(described, definitions):
    """What a schema says of a part: of a reference, of a list and of what may be null, what it says of each."""
    while True:
        if "$ref" in described:
            described = definitions[described["$ref"].rpartition("/")[2]]
        elif "anyOf" in described:
            described = described | {"anyOf": None} | described["anyOf"][0]
            del described["anyOf"]
        elif "items" in described:
            described = described | {"items": None} | described["items"]
            del described["items"]
        else:
            return described


def other_units(units, described, definitions, path=""):
    """Units of a document that are not those of its schema; those of a mapping of numbers are its own."""
    described = resolved(described, definitions)
    if isinstance(units, str):
        if described.get("x-si-unit", "1") != units:
            yield path, units, described
        return
    parts, rest = described.get("properties", {}), described.get("additionalProperties")
    for name, unit in units.items():
        if name in parts:
            yield from other_units(unit, parts[name], definitions, f"{path}.{name}")
        elif not rest:
            yield f"{path}.{name}", unit, "not described"


def test_a_document_is_valid_by_its_schema(answer):
    name, document, _, model = answer
    if name in FIT:
        document = {part: document[part] for part in declared.parts_of(fit_answer.FitResults)}
    model.model_validate({**document, "sheet": {}} if "sheet" in model.model_fields else document)
    json.dumps(document, allow_nan=False)


#: Answers whose units have the places of their numbers.
by_place = pytest.mark.parametrize("answer", [name for name in MADE if not name.startswith(BY_NAME)], indirect=True)


@by_place
def test_every_number_has_a_unit(answer):
    name, document, *_ = answer
    found = {each for each in without_unit(document["results"], document["units"]) if not each.endswith("_sign")}
    assert found <= OWN_UNITS.get(name.partition(" ")[0], set())


@by_place
def test_units_are_those_of_the_schema(answer):
    _, document, _, model = answer
    schema = model.model_json_schema()
    results = resolved(schema["properties"]["results"], schema["$defs"])
    described = {"properties": schema["properties"] | results["properties"]}
    assert list(other_units(document["units"], described, schema["$defs"])) == []


def test_every_record_is_said_once_on_the_sheet(answer):
    name, document, sheet, _ = answer
    said, told = " ".join(terminal.text(sheet).split()), [*document.get("verdicts", []), *document["warnings"]]
    assert [one["id"] for one in told if " ".join(one["text"].split()) not in said] == UNSAID.get(name, [])
    identities = [(one["id"], one["subject"]) for one in told]
    assert len(set(identities)) == len(identities)


#: Not where rubbing and braking stand in one column, or rows of residuals are counted.
@pytest.mark.parametrize("answer", [name for name in MADE if not name.startswith(("compare", "fit"))], indirect=True)
def test_every_number_of_a_table_is_in_the_document(answer):
    _, document, sheet, _ = answer
    known = np.array(list(numbers_of(document)))
    rows = [row for table in sheet.of_kind(Table) for row in table.rows if not row[0].startswith(MADE_OF_OTHERS)]
    numbers = [cell.value for row in rows for cell in row if isinstance(cell, Number) and cell.value is not None]
    unknown = [one for one in numbers if math.isfinite(one) and not np.isclose(known, abs(one), 1e-12, 0).any()]
    assert unknown == []


def test_the_text_of_a_sheet_fits_a_terminal_and_has_no_number_that_is_none(answer):
    text = terminal.text(answer[2])
    assert max(map(len, text.splitlines())) <= WIDTH
    assert not re.search(r"\bnan\b|\binf\b| -0 |None", text)
