"""Options that are declared once are the same on every face."""

import dataclasses
import inspect
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Literal

import pydantic
import pytest
import typer
from typer.testing import CliRunner

from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.faces.cli import condition, fit, service
from ballscrew.faces.cli.flags import flags_of
from ballscrew.faces.web.log_bodies import FitBody, ServiceBody
from ballscrew.faces.web.vocabulary import OPTIONS, vocabulary
from ballscrew.questions.condition.options import ConditionOptions
from ballscrew.questions.fit.options import FitOptions
from ballscrew.questions.fit_motion.options import FitMotionOptions
from ballscrew.questions.service.options import ReadingOptions, ServiceOptions
from ballscrew.questions.shared.option_values import read
from ballscrew.questions.shared.options import Option, Range, body_fields, options_of, vocabulary_of

#: The classes of options of each command.
COMMANDS = {
    fit.fit: (FitOptions, FitMotionOptions),
    service.service: (ServiceOptions, ReadingOptions),
    condition.condition: (ConditionOptions,),
}
BODIES = {"fit": FitBody, "service": ServiceBody}


def flags(command):
    """The flags of a command and what its help says of them."""
    annotations = [one.annotation for one in inspect.signature(command, eval_str=True).parameters.values()]
    found = [one.__metadata__[0] for one in annotations if hasattr(one, "__metadata__")]
    return {one.default: one.help for one in found if isinstance(one, typer.models.OptionInfo)}


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.__name__)
def test_every_option_is_a_flag(command):
    """Also in the help; of an option that two classes have, the first one says what it means."""
    said = flags(command)
    meanings = {}
    for cls in COMMANDS[command]:
        for option in options_of(cls).values():
            meanings.setdefault(option.flag, option.option.meaning)
    assert meanings.items() <= said.items()


@pytest.mark.parametrize("question", OPTIONS)
def test_every_option_is_in_the_api_and_on_the_page(question):
    options = options_of(OPTIONS[question])
    schema = BODIES[question].model_json_schema()["properties"]
    fields = {one["name"]: one for one in vocabulary()["options"][question]}
    assert fields.keys() == options.keys()
    for name, option in options.items():
        assert schema[name]["description"] == fields[name]["meaning"] == option.option.meaning
        assert schema[name].get("x-si-unit") == fields[name]["unit"] == (option.option.unit or None)
        assert fields[name]["flag"] == option.flag
    assert OPTIONS.keys() == BODIES.keys()


@pytest.mark.parametrize("cls", {cls for classes in COMMANDS.values() for cls in classes}, ids=lambda cls: cls.__name__)
def test_nothing_written_is_the_default(cls):
    assert read(cls, {}) == cls()
    assert read(cls, {name: option.written_default for name, option in options_of(cls).items()}) == cls()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Every:
    """An option of each kind."""

    names: Annotated[Sequence[str], Option("Of names.", metavar="NAMES")] = ("one",)
    ranges: Annotated[Mapping[str, Range], Option("Of ranges.")] = dataclasses.field(default_factory=dict)
    texts: Annotated[Mapping[str, str], Option("Of texts.", example="a=b")] = dataclasses.field(default_factory=dict)
    choice: Annotated[Literal["a", "b", "none"], Option("Of choices.", noun="letter")] = "none"
    length: Annotated[float | None, Option("Of lengths.", unit="m", above=0, short="-l", flag="long")] = None
    warmer: Annotated[float | None, Option("Of differences.", unit="K", at_least=0, is_difference=True)] = None
    share: Annotated[float, Option("Of shares.")] = 0.5
    count: Annotated[int | None, Option("Of counts.")] = None
    text: Annotated[str | None, Option("Of text.")] = None
    switch: Annotated[bool, Option("Of switches.")] = False


VALUES = Every(
    names=["two", "three"], ranges={"x": (0.001, 0.002)}, texts={"a": "b = c"}, choice="b", length=0.002, warmer=2.0,
    share=0.25, count=3, text="t", switch=True,
)  # fmt: skip
TYPED = [
    "--names", "two, three", "--ranges", "x=1:2 mm", "--texts", "a=b = c", "--choice", "b", "-l", "2 mm",
    "--warmer", "2 K", "--share", "0.25", "--count", "3", "--text", "t", "--switch",
]  # fmt: skip
SENT = {
    "names": ["two", "three"], "ranges": {"x": "1:2 mm"}, "texts": {"a": "b = c"}, "choice": "b", "length": "2 mm",
    "warmer": "2 K", "share": 0.25, "count": 3, "text": "t", "switch": True,
}  # fmt: skip


def lengths(_name, found):
    assert "names" in found  # the options before it
    return {"x": Quantity("x", "m", Info("x", "a length", "mm"))}


def test_every_kind_on_the_command_line():
    app = typer.Typer(rich_markup_mode=None)
    given = []

    @app.command()
    @flags_of(Every)
    def command(case: str, *, written: Mapping[str, object], loud: bool = False) -> None:
        given.append((case, read(Every, written, lengths), loud))

    done = CliRunner().invoke(app, ["case", *TYPED, "--loud"])
    assert done.exit_code == 0, done.output
    assert CliRunner().invoke(app, ["case"]).exit_code == 0
    assert given == [("case", VALUES, True), ("case", Every(), False)]
    shown = CliRunner().invoke(app, ["--help"]).output
    assert [option.option.meaning in shown for option in options_of(Every).values()] == [True] * 10
    assert "[default: 0.5]" in shown


def test_every_kind_in_a_body():
    body = pydantic.create_model("Body", **body_fields(Every))
    assert read(Every, dict(body(**SENT)), lengths) == VALUES
    assert read(Every, dict(body()), lengths) == Every()
    with pytest.raises(pydantic.ValidationError):
        body(switch="yes")
    with pytest.raises(pydantic.ValidationError):
        body(share="0.25")
    assert {one["name"]: one["kind"] for one in vocabulary_of(Every)} == {
        "names": "names", "ranges": "ranges", "texts": "texts", "choice": "choice", "length": "quantity",
        "warmer": "quantity", "share": "number", "count": "whole", "text": "text", "switch": "switch",
    }  # fmt: skip


FAULTS = {
    "names": ([","], "--names: has no names (,) · write --names one"),
    "ranges": (["x=1"], '--ranges: is not name=low:high (x=1) · write --ranges name="low:high unit"'),
    "texts": (["a"], "--texts: is not name=text (a) · write --texts a=b"),
    "choice": ("c", "--choice: unknown letter (c) · a or b"),
    "length": ("-2 mm", "--long: must be positive (-2 mm)"),
    "warmer": ("2 degC", '--warmer: is a difference of temperatures, in K (2 degC) · write --warmer "2 K"'),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_names_the_flag(name):
    given, line = FAULTS[name]
    with pytest.raises(InputError) as refused:
        read(Every, {name: given}, lengths)
    assert refused.value.lines() == [line]


def test_all_faults_are_told_at_once():
    with pytest.raises(InputError) as refused:
        read(Every, {"length": "nan m", "choice": "c", "ranges": {"y": "1:2 m", "x": "2:1 mm"}}, lengths)
    assert [fault.where for fault in refused.value.faults] == ["--ranges y", "--ranges x", "--choice", "--long"]
    assert math.isfinite(VALUES.length)
