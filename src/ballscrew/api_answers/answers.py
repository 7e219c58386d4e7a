"""Response models of the API, made from the annotations of the parts that the answers consist of.

They describe the answers in the OpenAPI document. They are not run on each answer: the endpoints return finished
responses, and the tests validate answers against the description.
"""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BaseModel, Field

from ballscrew.api_answers.parts import (
    MASKS,
    Closed,
    Number,
    Numbers,
    Open,
    Provenance,
    Record,
    Tables,
    Template,
    VendorRows,
    field,
    model,
    quantities,
)
from ballscrew.case_schema.schema import LAWS
from ballscrew.components.contact import RaceState
from ballscrew.components.operating_state import OperatingState
from ballscrew.friction.result import FrictionResult
from ballscrew.quantities import fields_of, quantities_of
from ballscrew.sizing.catalogue import CatalogueRow
from ballscrew.studies.run import OF_ONE_BALL
from ballscrew.text.run import SHOWN
from ballscrew.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.uncertainty.bands import Interval, OutputBand

# -- run ------------------------------------------------------------------------------------------

Contact = model(
    "Contact",
    "One contact of a ball with its race.",
    BaseModel,
    **quantities(quantities_of(RaceState), optional=True),
)
_RESULTS = {n: q for n, q in quantities_of(FrictionResult).items() if n not in fields_of(OperatingState)}
# Models made by ``create_model`` are variables to a type checker: where they are used as types, it is silenced.
#: Results of one row of equal balls, and of a whole nut.
_ALWAYS = {n: q for n, q in _RESULTS.items() if n in (*SHOWN, *MASKS, "holding_torque") and n not in OF_ONE_BALL}
Results = model(
    "Results",
    "Results of one row of equal balls, or of a whole nut.",
    Open,
    **quantities(_ALWAYS),
    **quantities({name: q for name, q in _RESULTS.items() if name not in _ALWAYS}, optional=True),
    preload_drag=(
        Number,
        field("torque of the nut without load, seals and other losses included, SI", "N m", optional=True),
    ),
    contributions=(Numbers, field("parts of the friction torque, SI", "N m")),
    validity=(dict[str, bool], ...),
    screw=(Contact, ...),
    nut=(Contact, ...),
)


class RunWords(Closed):
    """Sentences beside the numbers, as the command line prints them."""

    title: str
    verdicts: list[str]
    assumed: list[str]


class RunDisplay(Closed):
    """The same sentences, with their quantities apart."""

    title: Template
    verdicts: list[Template]
    assumed: list[Template]


class Document(Closed):
    """Inputs, results and units in SI; verdicts, checks and warnings; provenance."""

    inputs: Tables
    results: Results  # pyright: ignore[reportInvalidTypeForm]
    loads: Tables = field("loads of the balls of a nut, SI", optional=True)
    vendor_rows: VendorRows = field(optional=True)
    units: Tables
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance


class Run(Document):
    """Friction at one operating point."""

    words: RunWords
    display: RunDisplay


# -- sweep ----------------------------------------------------------------------------------------


class Values(Closed):
    """Values along the axes of a sweep, in their order, one array in the other."""

    values: list[Any]
    unit: str = Field(description="SI")
    meaning: str


class Swept(Values):
    """Values of an output, with the ends of its band where bands were asked for."""

    low: list[Any] | None = None
    high: list[Any] | None = None


class SweepBand(Closed):
    """What the bands of a sweep are of."""

    level: float
    samples: int = Field(description="of each point")
    seed: int


class Sweep(Closed):
    """Results over ranges of the operating point or of other fields."""

    axes: dict[str, Values]
    outputs: dict[str, Swept]
    band: SweepBand | None = None
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance


# -- compare --------------------------------------------------------------------------------------

_COMPARED = ("screw_torque", "efficiency", "back_driving_efficiency", "holding_torque")


class _Row(Closed):
    name: str
    change: Number = Field(description="friction torque over that of the case, less one")
    contributions: Numbers
    self_locking: bool
    valid: bool
    not_valid_because: list[str]


ComparedModel = model(
    "ComparedModel",
    "The case with one model.",
    _Row,
    **quantities({name: quantities_of(FrictionResult)[name] for name in _COMPARED}),
)
_Slot: TypeAlias = Annotated[str, Field(json_schema_extra={"enum": list(LAWS)})]
ComparedLaw = model(
    "ComparedLaw",
    "The case with another law in one slot.",
    ComparedModel,
    slot=(_Slot, ...),
    counts=(bool, field("false for a printed form that breaks a balance: it is in no spread")),
)


class ComparedRule(Closed):
    """A rule of one line that people use in place of a model."""

    name: str
    title: str
    formula: str
    source: str
    screw_torque: Number = Field(
        description="friction torque of the balls under the load, N m; null where the rule has no answer"
    )
    change: Number = Field(description="friction torque over that of the balls of the case, less one")
    efficiency: Number
    drag_torque: Number = Field(description="torque of the balls of the preloaded nut without load, N m")
    drag_change: Number = Field(description="torque without load over that of the balls of the case, less one")


class OfBalls(Closed):
    """The case without its seals and other losses, of which no rule knows: what the rules are held against."""

    screw_torque: Number = Field(description="friction torque under the load, N m")
    efficiency: Number
    drag_torque: Number = Field(description="torque of the preloaded nut without load, N m")
    losses: dict[str, Number] = Field(description="what is left out, N m")


class SpreadEnd(Closed):
    """The least or the greatest torque of some models or laws."""

    slot: _Slot | None
    name: str
    screw_torque: Number


class Ends(Closed):
    """Least and greatest torque."""

    least: SpreadEnd
    greatest: SpreadEnd


class Spread(Closed):
    """Spread of the torque over models and over laws."""

    models: Ends | None
    valid_laws: Ends | None
    change_by_slot: dict[str, list[Number]]


class Compare(Closed):
    """All models and all laws side by side."""

    inputs: Tables
    case: ComparedModel  # pyright: ignore[reportInvalidTypeForm]
    models: list[ComparedModel]  # pyright: ignore[reportInvalidTypeForm]
    laws: list[ComparedLaw]  # pyright: ignore[reportInvalidTypeForm]
    rules: list[ComparedRule]
    drag_torque: Number = Field(
        description="torque of the case's preloaded nut without load, seals and other losses included, N m"
    )
    of_balls: OfBalls = field(optional=True)
    spread: Spread
    units: dict[str, str]
    reasons: dict[str, str]
    verdicts: list[Record] = field(optional=True)
    checks: list[Record] = field(optional=True)
    warnings: list[Record] = field(optional=True)
    provenance: Provenance


# -- band -----------------------------------------------------------------------------------------

_Interval = model(
    "Interval",
    "Two ends with a share of the samples between them.",
    Closed,
    **dict.fromkeys((*Interval._fields,), (Number, ...)),
)
_INTERVALS = [name for name, kind in OutputBand.__annotations__.items() if kind == Interval.__name__]
#: The interval by both causes stands beside the value, the others under their names.
BandedOutput = model(
    "BandedOutput",
    "One output and its intervals.",
    _Interval,
    **{name: (Number, ...) for name in OutputBand.__annotations__ if name not in _INTERVALS},
    **{name: (_Interval, ...) for name in _INTERVALS if name != "both"},
)


class UncertainInput(Closed):
    """Distribution of an input, and where it comes from."""

    distribution: str
    source: str
    reason: str = field(optional=True)


class AlternativeLaw(Closed):
    """A law that could stand in place of the model's."""

    name: str
    factor: Number = Field(description="torque with it over torque with the model's own law")


class _BandTables(Closed):
    level: float
    samples: int
    seed: int
    self_locking_share: Number
    invalid_share: Number
    reasons: Numbers
    laws: dict[str, list[AlternativeLaw]]
    inputs: dict[str, UncertainInput]


BandTables = model(
    "BandTables",
    "Intervals of all outputs, and what they come from.",
    _BandTables,
    **dict.fromkeys(BAND_OUTPUTS, (BandedOutput, ...)),
)


class BandWords(Closed):
    """Sentences beside the numbers of a band."""

    sentences: list[str]
    inputs: str


class BandDisplay(Closed):
    """The same sentences, with their quantities apart."""

    sentences: list[Template]


class Band(Document):
    """The answer of a run with the band beside it."""

    band: BandTables  # pyright: ignore[reportInvalidTypeForm]
    words: BandWords
    display: BandDisplay


# -- catalogue ------------------------------------------------------------------------------------

_LISTED, _ALL_OF_ROW = fields_of(CatalogueRow), quantities_of(CatalogueRow)
ListedRow = model("ListedRow", "Numbers that the catalogue lists.", Closed, **quantities(_LISTED))
DerivedRow = model(
    "DerivedRow",
    "Numbers that follow from the listed ones.",
    Closed,
    **quantities({name: q for name, q in _ALL_OF_ROW.items() if name not in _LISTED}),
)


class CatalogueEntry(Closed):
    """A row of the catalogue."""

    name: str
    nut: str | None
    source: str
    row: ListedRow  # pyright: ignore[reportInvalidTypeForm]
    derived: DerivedRow  # pyright: ignore[reportInvalidTypeForm]


class RowUnits(Closed):
    """SI units of the numbers of a row."""

    row: dict[str, str]
    derived: dict[str, str]


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


# -- validation and schema ------------------------------------------------------------------------


class ValidationRow(Open):
    """One measured or stated value, and the model beside it."""

    name: str
    unit: str
    value: Number = Field(description="of the model, SI")
    middle: Number = Field(description="of the data, SI")
    low: Number = Field(description="of the vendor's band, SI")
    high: Number = Field(description="of the vendor's band, SI")
    ratio: Number
    in_band: bool | None
    residual: Number = Field(description="SI")
    residual_in_half_bands: Number
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
    rows: list[ValidationRow]


class CaseSchema(Open):
    """JSON Schema of a case file."""

    dialect: str = Field(alias="$schema")
    properties: Tables


class NeedSchema(Open):
    """JSON Schema of a need."""

    dialect: str = Field(alias="$schema")
    properties: Tables
