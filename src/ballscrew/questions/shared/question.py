"""A question as a record: its name, what it reads, its options, and the module that answers it.

Faces list these records and make what they need of them: the command line a command, the server an address. The records
load nothing that is slow: they name the module of the answer, which is loaded when it is asked for.
"""

from __future__ import annotations

import dataclasses
import importlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, Protocol, TypeVar, cast

from ballscrew.questions.shared.options import Option

if TYPE_CHECKING:
    from ballscrew.basis.output.sheet import Sheet
    from ballscrew.cases.case_files.case import Case

T = TypeVar("T")
#: Gets how many steps of how many are done.
Done = Callable[[int, int], None]
#: Stand for the names of the models and of the calibrations in help texts; replaced when the help is shown.
MODEL_NAMES, CALIBRATION_NAMES = "{models}", "{calibrations}"
SELF_HEATING = Option("Take the oil as warm as friction makes it in the [surroundings] of the case.")


@dataclasses.dataclass(frozen=True, kw_only=True)
class CaseOptions:
    """Options of reading a case: its model and calibration, values in place of those of the file, code of its own."""

    model: Annotated[str | None, Option(f"Model, in place of that of the file: {MODEL_NAMES}.", metavar="NAME")] = None
    calibration: Annotated[
        str | None,
        Option(
            f"Calibration, in place of that of the file: {CALIBRATION_NAMES}, by-make or none.",
            metavar="NAME",
        ),
    ] = None
    settings: Annotated[
        Sequence[str],
        Option(
            'Change a value: --set operation.axial_load="4 kN".',
            flag="set",
            metavar="SECTION.FIELD=VALUE",
            is_table=True,
        ),
    ] = ()
    allow_code: Annotated[bool, Option('Let the case name laws of your own, "module:name", and run their code.')] = (
        False
    )

    def load(self, path: Path) -> Case:
        """The case of a file."""
        return self.build(self.tables(path), path.parent)

    def tables(self, path: Path) -> dict[str, Any]:
        """The tables of a case file, with the settings."""
        from ballscrew.cases.case_files import case_file

        return case_file.override(case_file.read(path), self.settings)

    def build(self, tables: Mapping[str, Any], folder: Path, *, moves: bool = False) -> Case:
        """The case of tables, whose motion counts where it ``moves``; files that they name are in ``folder``."""
        from ballscrew.cases.case_files import case_file

        return case_file.build(
            tables, self.model, folder, calibration=self.calibration, allow_code=self.allow_code, moves=moves
        )


@dataclasses.dataclass(frozen=True)
class File:
    """A file that a question reads: an argument of its command, or a flag."""

    name: str
    meaning: str
    _: dataclasses.KW_ONLY
    metavar: str = ""
    is_case: bool = False
    is_need: bool = False
    is_flag: bool = False
    is_optional: bool = False
    is_repeated: bool = False


CASE = File("case", "Case file (TOML); ballscrew catalogue show NAME --case makes one.", is_case=True)
NEED = File("need", "File (TOML) of what the screw has to do; a case file will do.", metavar="NEED", is_need=True)
#: The case beside logs, which are the arguments.
CASE_OF_LOGS = File(
    "case",
    "Case file (TOML) of screw, nut, oil and model.",
    metavar="FILE",
    is_case=True,
    is_flag=True,
    is_optional=True,
)


class Sent(NamedTuple):
    """A file that is sent to the address of a question: a field of the body."""

    name: str
    #: The name of the file, or of the option with its path, that it stands for.
    stands_for: str
    is_optional: bool = False
    #: How many there may be; a field for several has a list.
    most: int = 1


class CaseSource(Protocol):
    """A case as it comes: from a file with options, or with a request."""

    def tables(self) -> dict[str, Any]:
        """The tables of the case. Raises :class:`~ballscrew.basis.errors.InputError` for what is no case."""
        ...

    def build(self, tables: Mapping[str, Any], *, moves: bool = False) -> Case:
        """The case of tables, whose motion counts where it ``moves``."""
        ...


@dataclasses.dataclass(frozen=True)
class CaseFile:
    """A case in a file, with options of the command line."""

    path: Path
    options: CaseOptions

    def tables(self) -> dict[str, Any]:
        """The tables of the file, with the settings."""
        return self.options.tables(self.path)

    def build(self, tables: Mapping[str, Any], *, moves: bool = False) -> Case:
        """The case of tables; files that they name are beside the file of the case."""
        return self.options.build(tables, self.path.parent, moves=moves)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Request:
    """A question with the files and options of one call."""

    #: The files to read, by the names of the question.
    files: Mapping[str, Sequence[Path]]
    case: CaseSource | None
    #: A need as it comes: its file, or its tables.
    need: Path | Mapping[str, Any] | None = None
    case_options: CaseOptions = CaseOptions()
    written: Mapping[str, Any]
    #: Files to write.
    to: Sequence[Path] = ()
    #: Gets parts of the document that are there before the rest.
    send: Callable[[Any], None] = lambda _: None

    def load(self, moves: Callable[[Mapping[str, Any]], bool] = lambda _: False) -> Case:
        """The case; its motion counts where its tables are those of a case that ``moves``."""
        assert self.case is not None
        tables = self.case.tables()
        return self.case.build(tables, moves=moves(tables))

    def options(self, cls: type[T]) -> T:
        """The options of a class as values. Raises :class:`~ballscrew.basis.errors.InputError` for faults in them."""
        from ballscrew.questions.shared.option_values import read

        return read(cls, self.written)


class Answer(NamedTuple):
    """An answer as people see it, and as a document, which is made only where it is needed."""

    sheet: Sheet
    document: Callable[[], Any]
    #: Words for its size, such as "361 angles", for the line on a file that is written.
    size: str = ""
    #: Writes a file of a kind that the question has beside tables and pictures, and returns what is in it.
    write: Callable[[Path], str] | None = None
    #: Lines for the error stream, such as those on rows that are left out.
    notes: Sequence[str] = ()
    #: Ctrl-C came before all rows were done.
    is_interrupted: bool = False


class Work(NamedTuple):
    """The work for an answer, once all that it needs is read and checked."""

    answer: Callable[[Done], Answer]
    #: Its name beside a progress bar; without one it has no bar.
    name: str = ""
    #: Files to write in place of those of the request, each with the name of the table that a .csv has.
    files: Mapping[Path, str] | None = None
    #: What it will cost, above the bar.
    cost: str = ""


class AnswerModule(Protocol):
    """The functions of a module that answers a question."""

    def prepare(self, request: Request) -> Work:
        """The work for an answer; a request is read and checked at once.

        Raises :class:`~ballscrew.basis.errors.InputError` for faults in it.
        """
        ...

    def plan_document(self, request: Request) -> Any:
        """The document of the plan, of a question whose address tells one."""
        ...


@dataclasses.dataclass(frozen=True, kw_only=True)
class Endpoint:
    """The address of a question in the API, as far as it does not follow from its command."""

    #: Classes of options, where it has not all of the command.
    options: Sequence[type] | None = None
    #: Files that come with the case.
    files: Sequence[Sent] = ()
    #: Options that are not sent, where they are not as those of a command without flags.
    written: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    #: The docstring of the address that tells what the question would do before it is asked; empty without one.
    plan: str = ""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Question:
    """A question of a user, as faces list it."""

    #: The module of its answer, see :class:`AnswerModule`.
    module: str
    name: str
    #: The help: its first paragraph stands in lists.
    help: str
    reads: Sequence[File] = (CASE,)
    #: Classes of options; of an option that several have, the first says what the help says.
    options: Sequence[type]
    #: Texts in place of those of :class:`CaseOptions`, by the name of the option; None leaves the option out.
    case_texts: Mapping[str, str | None] = dataclasses.field(default_factory=dict)
    #: The option that names files to write of the sheet, and whether it may be repeated.
    files: Option
    has_several_files: bool = False
    #: Endings of files that its answer writes itself.
    own_kinds: Sequence[str] = ()
    #: True where the help has the options behind all others.
    has_options_last: bool = False
    endpoint: Endpoint = Endpoint()

    @property
    def answer(self) -> AnswerModule:
        """The module of its answer, loaded when it is first asked for."""
        return cast("AnswerModule", importlib.import_module(self.module))

    @property
    def sent_options(self) -> Sequence[type]:
        """The classes of options that its address has."""
        return self.options if self.endpoint.options is None else self.endpoint.options
