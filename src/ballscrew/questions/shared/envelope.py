"""The envelope of an answer: the inputs of its case, its results, and what is to be said of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.shared import declared


def envelope(
    case: Case,
    results: Any,
    *,
    named: str = "results",
    units: Mapping[str, str] | None = None,
    beside: Mapping[str, Any] | None = None,
    assumed: Iterable[str] | None = None,
    warnings: Iterable[Record] = (),
    verdicts: Iterable[Record] = (),
    checks: Iterable[Mapping[str, Any]] = (),
    sources: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The document of an answer, in SI.

    ``units`` are those of numbers by other names than its own, ``beside`` are more answers by name, ``sources`` what
    else it rests on.
    """
    return {
        "inputs": descriptions.inputs(case),
        **numbers(**{named: results}, **(beside or {})),
        **({} if units is None else {"units": dict(units)}),
        **({} if assumed is None else {"assumed": list(assumed)}),
        "warnings": documents(warnings),
        "verdicts": documents(verdicts),
        "checks": list(checks),
        "provenance": {**descriptions.of_case(case), **(sources or {})},
    }


def numbers(**answers: Any) -> dict[str, Any]:
    """Answers by name, and the units of all: those of the results are not under their name."""
    units = {name: declared.units(answer) for name, answer in answers.items()}
    return {
        **{name: declared.document(answer) for name, answer in answers.items()},
        "units": units.pop("results", {}) | units,
    }
