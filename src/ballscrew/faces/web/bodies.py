"""Bodies of requests, with limits that are checked before any work.

Bytes, values and nesting are counted here. The case itself is checked by :mod:`ballscrew.cases.case_files.case_file`,
as for a file.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, NoReturn, TypeVar

import anyio
from pydantic import BaseModel, ConfigDict, Field, create_model
from starlette.requests import ClientDisconnect, Request

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.case_schema import read_table
from ballscrew.faces.report.options import ReportOptions
from ballscrew.faces.web.problems import Refused
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.band import BandOptions
from ballscrew.questions.fit import FitOptions
from ballscrew.questions.hand_over import HandOverOptions
from ballscrew.questions.shared.options import body_fields
from ballscrew.questions.sweep import SweepOptions

#: A case file has one or two kilobytes.
MOST_BYTES = 65_536
#: Tables within tables, and values in all of them.
DEEPEST, MOST_VALUES = 8, 1_000
LONGEST_TEXT = 1_000
#: Names of the contents of a file: as text, or any bytes in base64.
CONTENTS = ("text", "base64")
#: Loaded balls that are computed one by one, where the bodies of a nut are elastic or its balls differ.
MOST_BALLS = 500
#: Seconds for a body to arrive.
READ_TIMEOUT = 10.0

#: Bytes of a request with a project or a table of screws, and with a log: some 100,000 rows as text.
MOST_FILE_BYTES, MOST_LOG_BYTES = 1_048_576, 4_194_304

B = TypeVar("B", bound="Body")
Tables = dict[str, Any]
#: A file: its ``name``, which says what kind it is, and its content as ``text``, or any bytes in ``base64``.
SentFile = dict[str, str]


class Body(BaseModel):
    """The body of a request: these names and no others."""

    model_config = ConfigDict(extra="forbid")
    #: Bytes of a request at most.
    most_bytes: ClassVar[int] = MOST_BYTES
    #: Fields that are files, whose contents are neither counted nor cut as other texts are.
    files: ClassVar[tuple[str, ...]] = ()
    #: Values in all tables at most.
    most_values: ClassVar[int] = MOST_VALUES


class CaseBody(Body):
    """A case: the tables of a case file as JSON, texts with their units."""

    case: Tables


class NeedBody(Body):
    """A need: the tables of a file of ``ballscrew select`` as JSON."""

    need: Tables


def body_of(name: str, base: type[B], options: type, words: str) -> type[B]:
    """A body with a field for each option of a dataclass beside those of another body."""
    return create_model(name, __base__=base, __doc__=words, **body_fields(options))


class OwnNutBody(Body):
    """The numbers of a nut by their names, with their units: ``{"d0": "40 mm", "lead": "10 mm", "turns": "2x2.5"}``."""

    numbers: Tables = Field(description="texts with their units; d0, lead and turns are needed")


class OpenBody(Body):
    """A file of cases or of screws: a case file, a project, or a table."""

    most_bytes: ClassVar[int] = MOST_FILE_BYTES
    files: ClassVar[tuple[str, ...]] = ("file",)

    file: SentFile


class ProjectBody(Body):
    """Designs: each with its ``name``, its ``case`` and what is kept ``aside``."""

    most_bytes: ClassVar[int] = MOST_FILE_BYTES
    most_values: ClassVar[int] = 20 * MOST_VALUES

    designs: list[Tables]


class CasesBody(CaseBody):
    """A case, and other designs beside it."""

    beside: list[Tables] = Field(default_factory=list[Tables], description="other designs, three at most", max_length=3)


ReportBody = body_of(
    "ReportBody",
    CasesBody,
    ReportOptions,
    "A case, other designs beside it, samples of the band, and what may stand below the title: a project, and a date.",
)
BandBody = body_of("BandBody", CaseBody, BandOptions, "A case, and the options of its band.")
SweepBody = body_of(
    "SweepBody",
    CaseBody,
    SweepOptions,
    "A case, the axes to vary (as ``--vary``), the outputs to return, perhaps with the ends of their bands.",
)


class LogBody(CaseBody):
    """A case and a log whose columns are asked for, with those that are given by hand."""

    most_bytes: ClassVar[int] = MOST_LOG_BYTES
    files: ClassVar[tuple[str, ...]] = ("log",)

    log: SentFile
    columns: dict[str, str] = Field(default_factory=dict)


FitBody = body_of(
    "FitBody",
    LogBody,
    FitOptions,
    "A case, a log of torques, and the options of ``ballscrew fit``, as text with units.",
)


class TargetBody(CaseBody):
    """A case, and a target."""

    to: str = Field(strict=True)


HandOverBody = body_of(
    "HandOverBody",
    TargetBody,
    HandOverOptions,
    "A case, a target, and the options of ``ballscrew hand-over``, as text.",
)


async def read(request: Request, kind: type[Body]) -> Any:
    """The body of a request as one of the kinds above. Raises :class:`~ballscrew.faces.web.problems.Refused`."""
    content = await content_of(request, kind.most_bytes)
    request.state.body, request.state.digest = content, hashlib.sha256(content).digest()
    value = _json(content)
    _count(_without_contents(value, kind.files), kind.most_values)
    faults: list[Fault] = []
    table = read_table("request", kind, value, faults)
    if faults:
        raise Refused(422, *faults)
    return kind(**table)


def _without_contents(value: Any, files: Sequence[str]) -> Any:
    """A body without the contents of its files; a field may be a list of files."""
    if not isinstance(value, dict):
        return value
    return {name: _emptied(inner) if name in files else inner for name, inner in value.items()}


def _emptied(file: Any) -> Any:
    """A file without its content, or a list of such files."""
    if isinstance(file, list):
        return [_emptied(one) if isinstance(one, dict) else one for one in file]
    if not isinstance(file, dict):
        return file
    return {key: "" if key in CONTENTS and isinstance(text, str) else text for key, text in file.items()}


async def content_of(request: Request, most: int) -> bytes:
    """The bytes of a body that says it is JSON. Raises :class:`~ballscrew.faces.web.problems.Refused`."""
    media = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if media != "application/json":
        raise Refused(415, Fault("Content-Type", "is not application/json", media, "send JSON"))
    remedy = "send one case" if most == MOST_BYTES else "send a shorter log, or read it by the command line"
    too_large = Refused(413, Fault("request", f"has more than {most} bytes", "", remedy))
    length = request.headers.get("content-length", "0")
    if length.isdecimal() and int(length[:10]) > most:
        raise too_large
    result = bytearray()
    try:
        with anyio.fail_after(READ_TIMEOUT):
            async for chunk in request.stream():
                result += chunk
                if len(result) > most:
                    raise too_large
    except TimeoutError:
        raise Refused(
            408,
            Fault(
                "request",
                f"did not arrive within {units.to_significant(READ_TIMEOUT, 6)} s",
            ),
        ) from None
    except ClientDisconnect:
        raise Refused(400, Fault("request", "was interrupted")) from None  # no client is left to read it
    return bytes(result)


def _json(body: bytes) -> Any:
    try:
        return json.loads(
            body.decode("utf-8"), parse_constant=_no_number, parse_float=_number, object_pairs_hook=_table
        )
    except RecursionError:
        raise Refused(
            400,
            Fault("request", "is nested too deeply", "", f"{DEEPEST} levels at most"),
        ) from None
    except ValueError as error:
        raise Refused(400, Fault("request", "is not JSON", str(error), "send one JSON object in UTF-8")) from None


def _no_number(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON number")


def _number(text: str) -> float:
    """A finite number; JSON would make 1e999 infinite."""
    if not math.isfinite(number := float(text)):
        raise ValueError(f"{text[:40]} is too large for a number")
    return number


def _table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A table without repeated names, as in a case file; JSON would keep the last one."""
    table = dict(pairs)
    if len(table) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(f"{next(name for name in names if names.count(name) > 1)[:40]} is given twice")
    return table


def _count(value: Any, most: int) -> None:
    """Refuse deep nesting, too many values, long texts and invalid Unicode."""
    level, seen = [value], 0
    for _ in range(DEEPEST + 1):
        seen += len(level)
        if seen > most:
            raise Refused(413, Fault("request", f"has more than {most} values", "", "send one case"))
        for item in level:
            for text in _texts(item):
                if len(text) > LONGEST_TEXT:
                    problem = f"has a text of more than {LONGEST_TEXT} characters"
                    raise Refused(413, Fault("request", problem, text[:40] + "…", "shorten it"))
                if not text.isascii() and any("\ud800" <= letter <= "\udfff" for letter in text):
                    raise Refused(400, Fault("request", "has an unpaired surrogate", "", "send Unicode text"))
        level = [inner for item in level for inner in _inside(item)]
        if not level:
            return
    raise Refused(
        400,
        Fault("request", "is nested too deeply", "", f"{DEEPEST} levels at most"),
    )


def _inside(value: Any) -> list[Any]:
    if isinstance(value, dict):
        return list(value.values())
    return value if isinstance(value, list) else []


def _texts(value: Any) -> list[str]:
    if isinstance(value, dict):
        return list(value)
    return [value] if isinstance(value, str) else []


class SentCase(NamedTuple):
    """The case of a request; no value in its tables is read as a path."""

    sent: Mapping[str, Any]

    def tables(self) -> dict[str, Any]:
        """The tables. Raises :class:`~ballscrew.basis.errors.InputError` for names of files in them."""
        refuse_paths(self.sent)
        return dict(self.sent)

    def build(self, tables: Mapping[str, Any], *, moves: bool = False) -> Case:
        """The case of tables. Raises :class:`~ballscrew.basis.errors.InputError`."""
        case = case_file.build(tables, rows=catalogue(), moves=moves)
        if case.nut is not None and case.nut.one_by_one and case.screw.loaded_balls > MOST_BALLS:
            given, remedy = (
                f"{case.screw.loaded_balls:g}",
                f"{MOST_BALLS} at most where balls differ or bodies are elastic",
            )
            raise InputError(Fault("screw.loaded_balls", "too many to compute one by one", given, remedy))
        return case


def case_of(tables: Mapping[str, Any]) -> Case:
    """The case that the tables of a request describe. Raises :class:`~ballscrew.basis.errors.InputError`."""
    case = SentCase(tables)
    return case.build(case.tables())


def refuse_paths(tables: Mapping[str, Any]) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for names of files, and for null, which no case file can
    have.
    """
    screw = tables.get("screw")
    if isinstance(screw, Mapping) and "catalogue_file" in screw:
        remedy = "send the numbers of the screw, or name a row that is shipped"
        raise InputError(Fault("screw.catalogue_file", "is not taken from a request", "", remedy))
    bearings = tables.get("bearings")
    beside = {f"bearings.{place}": table for place, table in bearings.items()} if isinstance(bearings, Mapping) else {}
    for section, oil in {"lubricant": tables.get("lubricant"), "guides": tables.get("guides"), **beside}.items():
        if isinstance(oil, Mapping) and "oil_file" in oil:
            remedy = "send the numbers of the oil, or name one of the library"
            raise InputError(Fault(f"{section}.oil_file", "is not taken from a request", "", remedy))
    motion = tables.get("motion")
    if isinstance(motion, Mapping) and "file" in motion:
        raise InputError(Fault("motion.file", "is not taken from a request", "", "send the motion as segments"))
    refuse_nulls(tables)


def refuse_nulls(tables: Any) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for null, which no case file can have."""
    raise_if_any([Fault(where, "must not be null", "", "leave it out") for where in _nulls("", tables)])


def _nulls(where: str, value: Any) -> Iterator[str]:
    """Places where JSON has null, which a case file cannot have."""
    if value is None:
        yield where
    elif isinstance(value, dict):
        for name, inner in value.items():
            yield from _nulls(f"{where}.{name}".removeprefix("."), inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _nulls(where, inner)
