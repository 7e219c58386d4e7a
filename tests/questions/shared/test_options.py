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
from ballscrew.faces.cli import main
from ballscrew.faces.cli.options import Output, with_flags
from ballscrew.faces.page.vocabulary import OPTIONS, vocabulary
from ballscrew.faces.report.options import ReportOptions
from ballscrew.faces.web import question_api
from ballscrew.faces.web.bodies import BandBody, FitBody, HandOverBody, ReportBody, SweepBody
from ballscrew.questions.axis import AxisOptions
from ballscrew.questions.band import BandOptions
from ballscrew.questions.check import CheckOptions
from ballscrew.questions.compare import CompareOptions
from ballscrew.questions.compensation import CompensationOptions
from ballscrew.questions.condition import ConditionOptions
from ballscrew.questions.duty import DutyOptions, TraceOptions
from ballscrew.questions.fit import FitMotionOptions, FitOptions
from ballscrew.questions.hand_over import HandOverOptions
from ballscrew.questions.optimise import OptimiseOptions
from ballscrew.questions.records import QUESTIONS
from ballscrew.questions.reversal import ReversalOptions
from ballscrew.questions.ripple import RippleOptions
from ballscrew.questions.select import ListOptions, SelectOptions, TableOptions
from ballscrew.questions.sensitivity import SensitivityOptions
from ballscrew.questions.service import ReadingOptions, ServiceOptions
from ballscrew.questions.shared.option_values import read
from ballscrew.questions.shared.options import Option, Range, body_fields, options_of, vocabulary_of
from ballscrew.questions.shared.question import CaseOptions
from ballscrew.questions.sweep import SweepOptions
from ballscrew.questions.warm_up import DriftOptions, WarmUpOptions

#: The classes of options of each command.
COMMANDS = {
    "axis": (AxisOptions,),
    "cite": (),
    "compare": (CompareOptions,),
    "check": (CheckOptions,),
    "compensation": (CompensationOptions,),
    "condition": (ConditionOptions,),
    "duty": (TraceOptions, DutyOptions),
    "fit": (FitOptions, FitMotionOptions),
    "hand-over": (HandOverOptions,),
    "optimise": (OptimiseOptions,),
    "report": (ReportOptions,),
    "reversal": (ReversalOptions,),
    "ripple": (RippleOptions,),
    "run": (BandOptions,),
    "select": (SelectOptions, ListOptions, TableOptions),
    "sensitivity": (SensitivityOptions,),
    "service": (ServiceOptions, ReadingOptions),
    "sweep": (SweepOptions,),
    "validate": (),
    "warm-up": (WarmUpOptions, DriftOptions),
}
#: The body of the API for the options of a question.
BODIES = {
    BandOptions: BandBody,
    FitOptions: FitBody,
    HandOverOptions: HandOverBody,
    ReportOptions: ReportBody,
    SweepOptions: SweepBody,
    **{cls: question_api.BODIES[each.name] for each in QUESTIONS for cls in each.sent_options},
}


def named(one):
    return one.__name__


def flags(command):
    """The flags of a command and what its help says of them."""
    annotations = [one.annotation for one in inspect.signature(with_flags(command), eval_str=True).parameters.values()]
    found = [one.__metadata__[0] for one in annotations if hasattr(one, "__metadata__")]
    return {one.default: one.help for one in found if isinstance(one, typer.models.OptionInfo)}


def test_every_command_with_options_is_looked_at():
    assert {name for name, one in main.COMMANDS.items() if with_flags(one) is not one} == COMMANDS.keys()


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_is_a_flag(command):
    """Also in the help; of an option that two classes have, the first one says what it means."""
    said = flags(main.COMMANDS[command])
    meanings = {}
    for cls in COMMANDS[command]:
        for option in options_of(cls).values():
            meanings.setdefault(option.flag, option.option.meaning)
    assert meanings.items() <= said.items()


@pytest.mark.parametrize("cls", BODIES, ids=named)
def test_every_option_is_in_the_api(cls):
    schema = BODIES[cls].model_json_schema()["properties"]
    for name, option in options_of(cls).items():
        assert schema[name]["description"] == option.option.meaning
        assert schema[name].get("x-si-unit") == (option.option.unit or None)


@pytest.mark.parametrize("question", OPTIONS)
def test_every_option_is_on_the_page(question):
    """Which draws a field for each."""
    options = options_of(OPTIONS[question])
    fields = {one["name"]: one for one in vocabulary()["options"][question]}
    assert fields.keys() == options.keys()
    assert OPTIONS[question] in BODIES
    for name, option in options.items():
        assert fields[name]["meaning"] == option.option.meaning
        assert fields[name]["unit"] == (option.option.unit or None)
        assert fields[name]["flag"] == option.flag


@pytest.mark.parametrize("cls", [cls for classes in COMMANDS.values() for cls in classes], ids=named)
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
    places: Annotated[Sequence[float], Option("Of places.", unit="m")] = ()
    share: Annotated[float, Option("Of shares.")] = 0.5
    count: Annotated[int | None, Option("Of counts.")] = None
    text: Annotated[str | None, Option("Of text.")] = None
    switch: Annotated[bool, Option("Of switches.")] = False
    table: Annotated[Sequence[str], Option("Of tables.", is_table=True)] = ()


VALUES = Every(
    names=["two", "three"],
    ranges={"x": (0.001, 0.002)},
    texts={"a": "b = c"},
    choice="b",
    length=0.002,
    warmer=2.0,
    places=[0.3, 0.5],
    share=0.25,
    count=3,
    text="t",
    switch=True,
    table=["x=1:2", "x=3"],
)
TYPED = [
    "--names", "two, three", "--ranges", "x=1:2 mm", "--texts", "a=b = c", "--choice", "b", "-l", "2 mm",
    "--warmer", "2 K", "--places", "300 mm", "--places", "0.5 m",
    "--share", "0.25", "--count", "3", "--text", "t", "--switch",
    "--table", "x=1:2", "--table", "x=3",
]  # fmt: skip
SENT = {
    "names": ["two", "three"], "ranges": {"x": "1:2 mm"}, "texts": {"a": "b = c"}, "choice": "b", "length": "2 mm",
    "warmer": "2 K", "places": ["300 mm", "0.5 m"], "share": 0.25, "count": 3, "text": "t", "switch": True,
    "table": {"x": "1:2", "y": "3"},
}  # fmt: skip


def lengths(_name, found):
    assert "names" in found  # the options before it
    return {"x": Quantity("x", "m", Info("x", "a length", "mm"))}


def test_every_kind_on_the_command_line():
    app = typer.Typer(rich_markup_mode=None)
    given = []

    def command(case: str, *, written: Annotated[Mapping[str, object], Every], loud: bool = False) -> None:
        given.append((case, read(Every, written, lengths), loud))

    app.command()(with_flags(command))

    done = CliRunner().invoke(app, ["case", *TYPED, "--loud"])
    assert done.exit_code == 0, done.output
    assert CliRunner().invoke(app, ["case"]).exit_code == 0
    assert given == [("case", VALUES, True), ("case", Every(), False)]
    shown = CliRunner().invoke(app, ["--help"]).output
    assert [option.option.meaning in shown for option in options_of(Every).values()] == [True] * 12
    assert "[default: 0.5]" in shown


def test_a_class_gives_an_instance_and_its_texts_may_change():
    """One that is left out has its default; --allow-code stands last."""
    app = typer.Typer(rich_markup_mode=None)
    given = []

    def command(
        case_options: Annotated[CaseOptions, {"settings": "Other words.", "calibration": None}], output: Output
    ) -> None:
        given.append((case_options, output))

    app.command()(with_flags(command))
    assert CliRunner().invoke(app, ["--set", "a.b=1", "--set", "c.d=2", "--model", "m", "--json"]).exit_code == 0
    assert CliRunner().invoke(app, []).exit_code == 0
    assert given == [
        (CaseOptions(settings=["a.b=1", "c.d=2"], model="m"), Output(as_json=True)),
        (CaseOptions(), Output()),
    ]
    said = flags(command)
    assert list(said) == ["--model", "--set", "--json", "--sheet", "--allow-code"]
    assert said["--set"] == "Other words."


def test_every_kind_in_a_body():
    body = pydantic.create_model("Body", **body_fields(Every))
    assert read(Every, dict(body(**SENT)), lengths) == dataclasses.replace(VALUES, table=["x=1:2", "y=3"])
    assert read(Every, dict(body()), lengths) == Every()
    with pytest.raises(pydantic.ValidationError):
        body(switch="yes")
    with pytest.raises(pydantic.ValidationError):
        body(share="0.25")
    assert {one["name"]: one["kind"] for one in vocabulary_of(Every)} == {
        "names": "names",
        "ranges": "ranges",
        "texts": "texts",
        "choice": "choice",
        "length": "quantity",
        "warmer": "quantity",
        "places": "quantities",
        "share": "number",
        "count": "whole",
        "text": "text",
        "switch": "switch",
        "table": "texts",
    }


FAULTS = {
    "names": ([","], "--names: has no names (,) · write --names one"),
    "ranges": (["x=1"], '--ranges: is not name=low:high (x=1) · write --ranges name="low:high unit"'),
    "texts": (["a"], "--texts: is not name=text (a) · write --texts a=b"),
    "choice": ("c", "--choice: unknown letter (c) · a or b"),
    "length": ("-2 mm", "--long: must be positive (-2 mm)"),
    "warmer": ("2 degC", '--warmer: is a difference of temperatures, in K (2 degC) · write --warmer "2 K"'),
    "places": (["2 mm", "2 N"], "--places: wrong unit (2 N) · use a unit such as m, mm or um"),
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
