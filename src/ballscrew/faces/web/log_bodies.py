"""Bodies of requests that bring logs, and of those for a hand-over."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import Field

from ballscrew.faces.web.bodies import CaseBody, SentFile, Tables, body_of
from ballscrew.questions.condition.options import ConditionOptions
from ballscrew.questions.fit.options import FitOptions
from ballscrew.questions.hand_over.options import HandOverOptions
from ballscrew.questions.service.options import ServiceOptions

#: Bytes of a request with a log: some 100,000 rows as text.
MOST_LOG_BYTES = 4_194_304
#: Logs of one condition; more tests stand in a table.
MOST_LOGS = 100


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


class LogsBody(CaseBody):
    """A case, the log of a worn screw, and perhaps that of the new one."""

    most_bytes: ClassVar[int] = MOST_LOG_BYTES
    files: ClassVar[tuple[str, ...]] = ("new", "worn")

    new: SentFile | None = None
    worn: SentFile


ServiceBody = body_of(
    "ServiceBody",
    LogsBody,
    ServiceOptions,
    "A case, the log of the worn screw, perhaps that of the new one, and the options of ``ballscrew service``.",
)


class TestsBody(CaseBody):
    """A case, and the tests of its nut: a table with a row for each, or a log for each, in their order."""

    most_bytes: ClassVar[int] = MOST_LOG_BYTES
    files: ClassVar[tuple[str, ...]] = ("tests",)

    tests: list[SentFile] = Field(min_length=1, max_length=MOST_LOGS)


ConditionBody = body_of(
    "ConditionBody",
    TestsBody,
    ConditionOptions,
    "A case, the tests of its nut (a table, or logs in their order), and the options of ``ballscrew condition``.",
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


#: Logs to try, made by the model with noise of 0.2 %: of the paper's screw, and of it with a preload of 3 kN and 2 kN.
_LOG = """speed [rpm],axial load [N],torque [N m]
50,1000,0.8456
100,1000,0.8538
200,1000,0.8655
400,1000,0.8829
50,2000,1.6943
100,2000,1.7017
200,2000,1.7134
400,2000,1.7415
50,3000,2.5455
100,3000,2.5553
200,3000,2.5708
400,3000,2.6005
"""
_NEW, _WORN = (
    "\n".join(["speed [rpm],axial load [N],friction torque [N m]", *(f"{n},0,{torque}" for n, torque in rows)])
    for rows in (
        ((20, 0.2562), (50, 0.2485), (100, 0.2441), (200, 0.2461), (300, 0.2525), (400, 0.2609), (500, 0.2708)),
        ((20, 0.15), (50, 0.15), (100, 0.1538), (200, 0.1623), (300, 0.1733), (400, 0.185), (500, 0.1961)),
    )
)

_TESTS = "date,torque [N m],speed [rpm]\n" + "".join(
    f"2026-{month:02d}-01,{torque},100\n"
    for month, torque in enumerate((0.244, 0.246, 0.243, 0.247, 0.245, 0.241, 0.222, 0.205, 0.189), start=1)
)


def examples_with_logs(kind: type[CaseBody], paper: Tables) -> dict[str, Any]:
    """Bodies to try, by name; none for a body of another kind."""
    log = {"name": "log.csv", "text": _LOG}
    nut = {**paper, "nut": {"type": "double", "preload": "3 kN"}, "model": {"name": "olaru2005"}}
    found: dict[type[CaseBody], dict[str, Any]] = {
        LogBody: {"log": log},
        FitBody: {"log": log, "free": ["boundary_friction_coefficient"]},
        HandOverBody: {"to": "linuxcnc", "options": {"joint": "1"}},
        ServiceBody: {"new": {"name": "new.csv", "text": _NEW}, "worn": {"name": "worn.csv", "text": _WORN}},
        ConditionBody: {"tests": [{"name": "tests.csv", "text": _TESTS}]},
    }
    case = nut if kind in (ServiceBody, ConditionBody) else paper
    return {"paper": {"case": case, **found[kind]}} if kind in found else {}
