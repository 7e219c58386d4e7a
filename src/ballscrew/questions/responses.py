"""The models of the answers in the API, of which its description is made.

Parts that are declared beside their computation follow from there; the tests validate answers against these models, and
no answer is built with them. Only the server loads this file: making the models takes a fifth of a second.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from pydantic import Field

from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.own_nut import RATED
from ballscrew.questions.axis.answer import ChainResults
from ballscrew.questions.band.answer import BandResults
from ballscrew.questions.check.answer import BothRatings, Geometry
from ballscrew.questions.compare.compute import ByRules, Compared
from ballscrew.questions.condition.answer import ConditionResults
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.fit.answer import FitResults, LogColumns
from ballscrew.questions.hand_over.answer import HandOverResults
from ballscrew.questions.optimise.answer import Front, OneMember
from ballscrew.questions.reversal.answer import ReversalResults
from ballscrew.questions.ripple.answer import RippleResults
from ballscrew.questions.run.answer import RunResults, VendorRows
from ballscrew.questions.run.compute import NutLoads
from ballscrew.questions.select.answer import OfMotion, OneCandidate, OneObjective
from ballscrew.questions.select.compute import Plan
from ballscrew.questions.sensitivity.answer import Indices
from ballscrew.questions.service.answer import ServiceResults
from ballscrew.questions.shared.declared import table_of
from ballscrew.questions.shared.schemas import (
    Assumed,
    Closed,
    FaultLine,
    JudgedCheck,
    Number,
    OfLogs,
    Open,
    Provenance,
    Record,
    Shown,
    Tables,
    field,
    response,
    schema,
    with_answers,
)
from ballscrew.questions.sweep.answer import SweepResults
from ballscrew.questions.warm_up.answer import WarmUpResults

LOADS = (NutLoads, field("loads of the balls of a nut, SI", optional=True))
VENDOR_ROWS = (VendorRows, field("model over vendor for the rows most like the nut, without load", optional=True))


class RunWords(Closed):
    """Sentences beside the numbers, as the command line prints them."""

    title: str
    verdicts: list[str]
    assumed: list[str]
    rigidity: list[str] = field("what the axial rigidity rests on")
    rules: list[str] = field("the torque without load beside the rules of makers; none of a nut without preload")


Document: Any = response(RunResults, "Document", beside=with_answers(loads=LOADS, vendor_rows=VENDOR_ROWS))


class Run(Document):
    """Friction at one operating point."""

    words: RunWords


class BandWords(Closed):
    """Sentences beside the numbers of a band."""

    sentences: list[str]
    inputs: str


class Band(Document, with_answers(band=BandResults)):
    """The answer of a run with the band beside it."""

    words: BandWords


class OneCheck(JudgedCheck):
    """A check with its text for people."""

    passes: bool | None = Field(description="as ``holds``")
    words: str = Field(description="as ``text``")


class BesideChecks(with_answers(geometry=Geometry, loads=NutLoads, vendor_rows=VENDOR_ROWS, ratings=BothRatings)):
    """Values that the checks of a case have beside its results."""

    checks: list[OneCheck]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    holds: bool = Field(description="true where all checks were judged and hold")
    verdict: str
    nut: str = Field(description="kind of the nut; a case without one is checked with a single nut")
    assumed: list[str]


class Checks(response(RunResults, "Checks", beside=BesideChecks)):
    """The checks of a case, with its results."""


_Compared: Any = schema(Compared)
_ByRules: Any = schema(ByRules)


class Compare(_Compared, _ByRules, Shown):
    """All models and all laws side by side."""

    inputs: Tables
    units: Tables
    reasons: dict[str, str]
    verdicts: list[Record] = field(optional=True)
    checks: list[Record] = field(optional=True)
    warnings: list[Record] = field(optional=True)
    provenance: Provenance


class Said(Closed):
    """Statements on results, and what they rest on."""

    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance


class Sweep(schema(SweepResults), Said):
    """Results over ranges of the operating point or of other fields."""


class ColumnFault(FaultLine):
    """A fault of the columns of a log."""

    column: str = Field(description="that it is about; may be empty")


class Log(schema(LogColumns)):
    """The columns of a log, and what may be fitted to it."""

    faults: list[ColumnFault] = Field(description="for which the log cannot be read as it is")


class ExampleLog(Closed):
    """A log to try."""

    name: str
    text: str


class Example(Closed):
    """A case, and logs that belong to it."""

    file: str
    case: Tables
    logs: list[ExampleLog]
    free: list[str] = Field(description="numbers to fit to the logs")


class Examples(Closed):
    """Logs to try; no screw was measured for them."""

    condition: Example
    fit: Example
    service: Example


class Calibrated(Closed):
    """The case with the fitted numbers and ``[calibration]``."""

    toml: str
    case: Tables


class Fit(schema(FitResults), Shown):
    """A case fitted to a log."""

    units: Tables
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record] = Field(description="also what cannot be told apart")
    inputs: Tables
    provenance: Tables
    assumed: list[str] = field(optional=True)
    calibrated: Calibrated


class OfCheck(Open):
    """The parts of the document of a check that candidates have."""

    results: Tables
    checks: list[Tables]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    verdicts: list[Record]
    warnings: list[Record]


class Candidate(schema(OneCandidate), schema(OfMotion, optional=True), OfCheck):
    """A row with a nut, a preload and an oil: the document of its check, with its rank."""


class Select(with_answers(objectives=Sequence[OneObjective]), Shown):
    """Candidates for a need, the best first."""

    need: Tables
    best: str | None = Field(description="label of the first that holds within the validity of the model")
    holding: int
    ruled_out: int = Field(description="candidates that their loads alone rule out, without the full model")
    candidates: list[Candidate]
    notes: list[str]
    warnings: list[Record] = Field(description="lubricant.starved, of the first candidate that is")
    units: Tables
    provenance: Provenance | None


class Member(schema(OneMember), OfCheck):
    """A design of the front: the document of its check, with its sizes and the numbers compared."""

    case: Tables = Field(description="its case file as tables")


class Optimise(schema(Front), Shown):
    """Free geometries for a need: the front of the best."""

    need: Tables
    candidates: list[Member]
    notes: list[str]
    warnings: list[Record]
    units: Tables
    provenance: Provenance | None


class OptimisePlan(Closed):
    """Plan of an optimisation."""

    designs: int = Field(description="that the search evaluates")
    members: int = Field(description="that are then evaluated in full, at most")
    seconds: float = Field(description="of one processor, about")


class WarmUpBands(Open):
    """Bands over time and in the steady state."""

    level: float
    samples: int
    time: list[float] = field("instants, SI", "s")
    known_share: list[float] = field("share of the samples whose friction is known at each instant")
    equilibrium: Tables
    inputs: Tables


class BesideWarmUp(Assumed):
    """Assumptions, and the bands where they are asked for."""

    band: WarmUpBands = field(optional=True)


class ValidationRow(Open):
    """One measured or stated value, and the model beside it."""

    name: str
    unit: str
    value: Number = Field(description="of the model, SI")
    middle: Number = Field(description="of the data, SI")
    low: Number = Field(description="of the vendor's band, SI")
    high: Number = Field(description="of the vendor's band, SI")
    band: list[Number] | None = Field(description="low and high in one; null where there is no band")
    ratio: Number
    in_band: bool | None
    residual: Number = Field(description="SI")
    residual_in_half_bands: Number
    in_uncertainty_band: bool | None = Field(
        default=None, description="whether the model's own 95 % band holds the middle of the data"
    )
    warnings: list[Any]


class ValidationEntry(Open):
    """A set of data against a model."""

    set: str
    model: str
    calibration: str | None
    n: int
    mean_ratio: Number
    std_ratio: Number
    share_in_band: Number
    used_for: list[str] = Field(description="choices of the model that were made with these rows in sight; [] for none")
    rows: list[ValidationRow]


class SentContent(Closed):
    """A file of a hand-over, or a zip archive of several."""

    name: str
    media_type: str
    base64: str


class HandOverWords(Closed):
    """Words of a hand-over: ranges, worst errors, warnings."""

    lines: list[str]
    ranges: list[str] = Field(description="ranges and worst errors alone")


class BesideHandOver(Closed):
    """Fields beside the results of a hand-over."""

    provenance: Tables
    words: HandOverWords
    file: SentContent


HandOver: Any = response(HandOverResults, "HandOver", beside=BesideHandOver)


_LISTED, _ALL_OF_ROW = fields_of(CatalogueRow), quantities_of(CatalogueRow)


class ListedRow(table_of(_LISTED)):
    """Numbers that the catalogue lists."""


class DerivedRow(table_of({name: q for name, q in _ALL_OF_ROW.items() if name not in _LISTED})):
    """Numbers that follow from the listed ones."""


class ComputedRatings(table_of({name: _LISTED[name] for name in RATED})):
    """Load ratings by the geometry."""


class CatalogueEntry(with_answers(row=ListedRow, derived=DerivedRow, computed=ComputedRatings)):
    """A row of the catalogue."""

    name: str
    nut: str | None
    source: str
    seal_torque_source: str | None = Field(description="of whose seals the torque is, where it is not the row's own")
    ball_diameter_source: str | None = Field(description="where the ball diameter is from, if not from the row")
    family: str | None = Field(description="series of the maker")
    notes: list[str] = Field(description="ratings far from those by the geometry, and why no torque is computed")


class RowUnits(Closed):
    """SI units of the numbers of a row."""

    row: dict[str, str]
    derived: dict[str, str]
    computed: dict[str, str]


class Version(Closed):
    """Version of the program."""

    version: str


class Catalogue(Closed):
    """Rows of the catalogue."""

    rows: list[CatalogueEntry]
    units: RowUnits
    provenance: Version


class Row(CatalogueEntry):
    """One row, and a case that starts from it."""

    assumed: dict[str, str]
    units: RowUnits
    provenance: Version
    case: Tables


class NutEstimate(Closed):
    """A number that the catalogue does not print, with its band, in SI."""

    name: str = Field(description="field of the row or of the screw that it makes")
    value: float
    low: float
    high: float
    unit: str
    shown_in: str = Field(description="unit that people have for it")
    source: str = Field(description="where it is from")


class OwnNut(Closed):
    """A nut of few numbers as a case, what was estimated, and what does not go together."""

    name: str
    case: Tables
    estimates: list[NutEstimate]
    warnings: list[Record]
    provenance: Version


class OpenedDesign(Closed):
    """A design of a file."""

    name: str
    case: Tables = Field(description="tables as they are written, unchecked")
    aside: Tables = Field(description="tables that no case has, kept for the next file")


class Opened(Closed):
    """The designs of a file."""

    kind: str = Field(description="case, project, table or need")
    designs: list[OpenedDesign]
    comments: int = Field(description="comments of the file, which are lost")
    notes: list[str] = Field(description="columns that are not used, rows that are left out")


class Job(Closed):
    """A request that runs by itself."""

    id: str = Field(description="its name, which nobody can guess")
    address: str
    state: Literal["waiting", "running", "finished", "failed", "cancelled"]
    before: int = Field(description="jobs that wait before it")
    finished: int = Field(description="how much is done, as the work counts it")
    total: int = Field(description="of how much; zero where it does not count")
    computed: float = Field(description="seconds of processor")
    limit: float = Field(description="seconds of processor that it may take")
    rows: list[Any] = Field(description="parts of the answer that are there before the rest, from the place asked for")


#: The models of the answers of questions that are records, by the names of these.
OF_QUESTIONS: Mapping[str, Any] = {
    "axis": response(ChainResults, "Chain", beside=Assumed),
    "compare": Compare,
    "condition": response(ConditionResults, "Condition", beside=OfLogs),
    "duty": response(DutyReport, "Duty", judged=True),
    "optimise": Optimise,
    "reversal": response(ReversalResults, "Reversal"),
    "ripple": response(RippleResults, "Ripple", beside=Assumed),
    "select": Select,
    "sensitivity": response(Indices, "Sensitivity", named="sensitivity"),
    "service": response(ServiceResults, "Service", beside=OfLogs),
    "warm-up": response(WarmUpResults, "WarmUp", beside=BesideWarmUp),
}
#: Those of their plans.
OF_PLANS: Mapping[str, Any] = {"optimise": OptimisePlan, "select": schema(Plan)}
