"""``ballscrew list``: the names that the program takes, by group; as a document and as text."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from itertools import groupby
from typing import Any, NamedTuple

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.case_schema import MODELS, coefficients_of
from ballscrew.engine.evaluation.outputs import inputs_of, known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut
from ballscrew.physics.components.oil_grades import grades
from ballscrew.physics.friction.model import LAWS, FrictionModel
from ballscrew.physics.sizing.catalogue import catalogue


class Name(NamedTuple):
    """A name: the group that it belongs to, its SI unit (empty where it has none), and its meaning."""

    group: str
    name: str
    unit: str
    meaning: str


def names(kind: str, case: Case | None = None) -> list[Name]:
    """The names of a kind; inputs and outputs are those of a case, or of the reference model with a double nut.

    Raises :class:`~ballscrew.basis.errors.InputError` for an unknown kind.
    """
    if kind not in KINDS:
        raise InputError(Fault("list", "unknown kind of names", kind, nearest(kind, KINDS)))
    return KINDS[kind](case)


def _subject(case: Case | None) -> Configuration:
    if case is not None:
        return Configuration(case.model, case.screw, case.lubricant)
    row = next(iter(catalogue().values()))
    oil = Lubricant.from_grade("ISO VG 100", temperature=313.15)
    return Configuration(MODELS["reference"], row.screw(nut=DoubleNut(preload=1000.0)), oil)


def _grades(_: Case | None) -> list[Name]:
    result: list[Name] = []
    for grade in grades():
        oil = Lubricant.from_grade(grade, temperature=313.15)
        result.append(Name("grade", grade, "", f"{1000 * float(oil.viscosity):.4g} mPa s at 40 °C"))
    return result


def _laws(_: Case | None) -> list[Name]:
    return [
        Name(slot, name, "", _meaning(law) + _coefficients(slot, name))
        for slot, laws in LAWS.items()
        for name, law in laws.items()
    ]


def _coefficients(slot: str, name: str) -> str:
    coefficients = coefficients_of(slot, name)
    return f" ({', '.join(coefficients)})" if coefficients else ""


def _meaning(law: Any) -> str:
    """The first sentence of a law, on one line."""
    text = "" if law is None else (inspect.getdoc(law) or "").partition("\n\n")[0].replace("\n", " ")
    return text.partition(". ")[0].rstrip(".") or "none"


def _models(_: Case | None) -> list[Name]:
    return [Name("model", name, "", _meaning(getattr(FrictionModel, name.replace("-", "_"), None))) for name in MODELS]


def _inputs(case: Case | None) -> list[Name]:
    subject = _subject(case)
    known = inputs_of(subject.model, subject.screw, subject.lubricant)
    return [_of(part, name, quantity) for name, (part, quantity) in known.items() if not name.startswith("nut.")]


def _outputs(case: Case | None) -> list[Name]:
    result = known_outputs(_subject(case).nut)
    return [_of("output", name, output.quantity) for name, output in result.items()]


def _of(group: str, name: str, quantity: Quantity) -> Name:
    return Name(group, name, "" if quantity.unit == "1" else quantity.unit, quantity.info.meaning)


#: The kinds of names, and the function that lists each.
KINDS: Mapping[str, Callable[[Case | None], list[Name]]] = {
    "grades": _grades,
    "laws": _laws,
    "models": _models,
    "inputs": _inputs,
    "outputs": _outputs,
}


def document(kind: str, result: Sequence[Name]) -> dict[str, Any]:
    """The names of a kind, with their groups, SI units and meanings."""
    return {"results": {kind: [one._asdict() for one in result]}, "warnings": []}


def text(names: Sequence[Name]) -> str:
    """The names in columns: name, unit, meaning; a heading before each group where there are several."""
    groups = [(group, list(each)) for group, each in groupby(names, key=lambda one: one.group)]
    width = max((len(one.name) for one in names), default=0)
    units = max((len(one.unit) for one in names), default=0)
    lines: list[str] = []
    for group, each in groups:
        lines += [f"{group}:"] if len(groups) > 1 else []
        lines += ["  ".join([f"{one.name:<{width}}", f"{one.unit:<{units}}", one.meaning]).rstrip() for one in each]
    return "\n".join(lines)
