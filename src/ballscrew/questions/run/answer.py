"""Response models of the API for a run, made from the annotations of the parts that it consists of.

They describe the answers in the OpenAPI document. They are not run on each answer: the endpoints return finished
responses, and the tests validate answers against the description.
"""

from __future__ import annotations

from pydantic import BaseModel

from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.run.compute import OF_ONE_BALL
from ballscrew.questions.run.nut_loads import NutLoads
from ballscrew.questions.run.text import SHOWN
from ballscrew.questions.shared.answer_parts import (
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
    quantities,
    with_fields,
)
from ballscrew.questions.shared.declared import with_answers


class Contact(with_fields(BaseModel, **quantities(quantities_of(RaceState), optional=True))):
    """One contact of a ball with its race."""


_RESULTS = {n: q for n, q in quantities_of(FrictionResult).items() if n not in fields_of(OperatingState)}
#: Results of one row of equal balls, and of a whole nut.
_ALWAYS = {n: q for n, q in _RESULTS.items() if n in (*SHOWN, *MASKS, "holding_torque") and n not in OF_ONE_BALL}
_AT_TIMES = {name: quantity for name, quantity in _RESULTS.items() if name not in _ALWAYS}


class Results(with_fields(Open, **quantities(_ALWAYS), **quantities(_AT_TIMES, optional=True))):
    """Results of one row of equal balls, or of a whole nut."""

    preload_drag: Number = field(
        "torque of the nut without load, seals and other losses included, SI", "N m", optional=True
    )
    contributions: Numbers = field("parts of the friction torque, SI", "N m")
    validity: dict[str, bool]
    screw: Contact
    nut: Contact


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


class Document(with_answers(loads=(NutLoads, field("loads of the balls of a nut, SI", optional=True)))):
    """Inputs, results and units in SI; verdicts, checks and warnings; provenance."""

    inputs: Tables
    results: Results
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
