"""Questions as records: each is a command, and what it asks is checked before anything is computed or written."""

import inspect
from pathlib import Path

import pytest
from typer.testing import CliRunner

import ballscrew.questions
from ballscrew.basis.errors import InputError
from ballscrew.faces.cli import main
from ballscrew.questions import responses
from ballscrew.questions.records import QUESTIONS
from ballscrew.questions.shared.options import options_of


def name(question):
    return question.name


def test_every_question_that_is_a_record_is_listed():
    files = [*Path(ballscrew.questions.__file__).parent.glob("*/__init__.py")]
    assert len(QUESTIONS) == sum(" = Question(\n" in path.read_text(encoding="utf-8") for path in files)


@pytest.mark.parametrize("question", QUESTIONS, ids=name)
def test_every_record_has_its_answer_and_its_models(question):
    assert inspect.get_annotations(question.answer.prepare) == {"request": "Request", "return": "Work"}
    assert question.name in responses.OF_QUESTIONS
    assert (
        bool(question.endpoint.plan)
        == (question.name in responses.OF_PLANS)
        == hasattr(question.answer, "plan_document")
    )


@pytest.mark.parametrize("question", QUESTIONS, ids=name)
def test_every_record_is_a_command(question):
    command = main.typer_command(question.name, main.COMMANDS[question.name])
    flags = {flag for parameter in command.params for flag in parameter.opts}
    options = {option.flag for cls in question.options for option in options_of(cls).values()}
    assert command.help == inspect.cleandoc(question.help)
    assert options | {"--model", "--set", "--json", "--sheet", "--allow-code"} <= flags
    assert ("--calibration" in flags) == ("calibration" not in question.case_texts)
    assert [parameter.opts[-1] for parameter in command.params][-1] == "--allow-code"


@pytest.mark.parametrize("question", QUESTIONS, ids=name)
def test_a_fault_of_the_case_makes_no_folder(question, tmp_path):
    (tmp_path / "case.toml").write_text("screw = 1\n", encoding="utf-8")
    case = [tmp_path / "case.toml"]
    read = [part for file in question.reads for part in ([f"--{file.name}", *case] if file.is_flag else case)]
    to = [f"--{question.files.flag or 'to'}", tmp_path / "new" / "picture.svg"]
    done = CliRunner().invoke(main.app, [question.name, *map(str, [*read, *to])])
    assert isinstance(done.exception, InputError)
    assert not (tmp_path / "new").exists()
