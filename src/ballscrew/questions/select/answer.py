"""Response models of the API for screws that are ranked for a need."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.shared.answer_parts import Closed, Number, Numbers, Open, Provenance, Record, Tables, field


class Failing(Closed):
    """A check that fails."""

    name: str
    utilisation: Number = Field(description="demand over capacity; null where the check is a question of yes or no")


class RowSizes(Closed):
    """Sizes of a row, and its source."""

    nominal_diameter: float = field("nominal diameter, SI", "m")
    lead: float = field("lead, SI", "m")
    source: str


class Candidate(Open):
    """A row with a nut, a preload and an oil: the document of its check, with its rank."""

    rank: int
    name: str = Field(description="of the row")
    label: str = Field(description="row, nut, preload and oil")
    row: RowSizes
    nut: str
    preload: Number = field("axial preload, SI", "N")
    oil: str
    holds: bool = Field(description="true where all checks were judged and hold")
    complete: bool = Field(
        description="false where its loads alone rule it out: friction was not computed, results are empty"
    )
    valid: bool
    pareto: bool = Field(description="true where no other candidate that fits is better in all objectives")
    rigid_lift_off_load: Number = field(
        "load above which rigid bodies lose the preload, SI, of a nut that has none left; null where some is left", "N"
    )
    worst: Number = Field(description="largest utilisation")
    fails: list[Failing]
    verdict: str
    objectives: Numbers
    case: Tables = Field(description="its case file as tables")
    starved: bool = Field(
        description="true where the torque in a full bath of oil is larger: loss and torques compared are the larger"
    )
    results: Tables
    checks: list[Tables]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    verdicts: list[Record]
    warnings: list[Record]


class OneObjective(Closed):
    """A number that is compared."""

    name: str
    meaning: str
    unit: str = Field(description="SI")
    better: str = Field(description="less or more")


class Unasked(Closed):
    """An input that a need leaves empty, and the checks that are not judged without it."""

    input: str = Field(description="by section.field of a case file")
    checks: list[str]


class Plan(Closed):
    """What a selection would do, before it is done."""

    candidates: int
    seconds: float = field("time of one processor, at most", "s")
    unasked: list[Unasked]


class Select(Closed):
    """Candidates for a need, the best first."""

    need: Tables
    objectives: list[OneObjective]
    best: str | None = Field(description="label of the first that holds within the validity of the model")
    holding: int
    ruled_out: int = Field(description="candidates that their loads alone rule out, without the full model")
    candidates: list[Candidate]
    notes: list[str]
    warnings: list[Record] = Field(description="lubricant.starved, of the first candidate that is")
    units: Tables
    provenance: Provenance | None
