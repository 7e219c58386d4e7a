"""Records of a result: verdicts, checks and warnings of every document.

Terminal, page, report and API read the fields; the text is for people to read and for no program to parse.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import as_array, namespace, where
from ballscrew.basis.quantities import Mask, Quantity, Ratio

Severity = Literal["info", "warning", "error"]


@dataclasses.dataclass(frozen=True, slots=True)
class Record:
    """One verdict, check or warning.

    ``holds`` is the truth of the statement, None where it cannot be judged; whether it is good news ``severity`` says.
    ``value`` and ``limit`` are SI numbers in ``unit``, None where there is none. ``id`` and ``subject`` together are
    unique in a document.
    """

    #: Stable name, lower case with dots: ``validity.contact_pressure``, ``verdict.back_driving``, ``check.buckling``.
    id: str
    #: The quantity or part it concerns, by its name in the document: ``maximum_pressure``, ``nut.preload``, ``model``.
    subject: str
    #: One sentence for people, with its units.
    text: str
    _: dataclasses.KW_ONLY
    severity: Severity = "info"
    holds: bool | None = None
    value: float | None = None
    limit: float | None = None
    unit: str = "1"

    @classmethod
    def warning(
        cls,
        id: str,
        subject: str,
        text: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "1",
    ) -> Record:
        """A warning: what should hold does not."""
        return cls(id, subject, text, severity="warning", holds=False, value=value, limit=limit, unit=unit)

    @property
    def name(self) -> str:
        """The last part of the id: ``contact_pressure``."""
        return self.id.rpartition(".")[2]

    def document(self) -> dict[str, Any]:
        """The record as it stands in JSON."""
        names = ("id", "subject", "value", "unit", "limit", "holds", "severity", "text")
        return {name: getattr(self, name) for name in names}


def documents(records: Iterable[Record]) -> list[dict[str, Any]]:
    """Records as they stand in JSON, in their order."""
    return [record.document() for record in records]


Formula: TypeAlias = Callable[[Mapping[str, Any]], Mapping[str, Any]]


@dataclasses.dataclass(frozen=True, slots=True)
class Shown:
    """A number of a formula where it stands in a sentence: its quantity, and its significant digits or decimals."""

    name: str
    quantity: Quantity | None = None
    digits: int = 4
    decimals: int | None = None

    def text(self, value: Any) -> str:
        """The number as people read it."""
        if self.decimals is not None:
            return units.fixed(value, self.decimals)
        if self.quantity is None or self.quantity.unit == "1":
            return units.number(value, self.digits)
        return units.shown(value, self.quantity, self.digits)

    def document(self) -> dict[str, Any]:
        """The place as it stands in JSON: ``number`` is its name."""
        quantity = self.quantity
        units = ("1", "1") if quantity is None else (quantity.unit, quantity.shown_in)
        values = {"number": self.name, "unit": units[0], "shown_in": units[1], "digits": self.digits}
        return values if self.decimals is None else values | {"decimals": self.decimals}


@dataclasses.dataclass(frozen=True, slots=True)
class Words:
    """Words where they stand in a sentence, by name: they are given beside the values."""

    name: str

    def document(self) -> dict[str, Any]:
        """The place as it stands in JSON."""
        return {"words": self.name}


@dataclasses.dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence, and the mask under which it is said; without one, wherever none before it is."""

    template: str
    said: str = ""
    #: What stands in the places of the template: a number, words, one of several sentences, or a constant.
    places: Mapping[str, Shown | Words | tuple[Sentence, ...] | str] = dataclasses.field(default_factory=dict)

    def filled(self, values: Mapping[str, Any], words: Mapping[str, str]) -> str:
        """The sentence with what a formula found at one point, and words."""

        def one(place: Shown | Words | tuple[Sentence, ...] | str) -> str:
            if isinstance(place, Shown):
                return place.text(values[place.name])
            if isinstance(place, Words):
                return words[place.name]
            return chosen(place, values, words) if isinstance(place, tuple) else place

        return self.template.format(**{name: one(place) for name, place in self.places.items()})

    def document(self) -> dict[str, Any]:
        """The sentence as it stands in JSON; a constant is ``constant``, a choice of sentences ``sentences``."""

        def one(place: Any) -> Any:
            if isinstance(place, Shown | Words):
                return place.document()
            if isinstance(place, tuple):
                return {"sentences": [each.document() for each in place]}
            return {"constant": place}

        places = {name: one(place) for name, place in self.places.items()}
        return {"template": self.template, "said": self.said or None, "places": places}


def chosen(sentences: Sequence[Sentence], values: Mapping[str, Any], words: Mapping[str, str]) -> str:
    """The first of the sentences whose mask holds at one point, filled."""
    return next(one.filled(values, words) for one in sentences if not one.said or bool(values[one.said]))


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """One row of a table of verdicts, checks and warnings; see :mod:`ballscrew.basis.records`."""

    #: Stable name, unique in its table: ``verdict.back_driving``, ``check.buckling``.
    id: str
    #: The quantity or part that it concerns, by its name in the document.
    subject: str
    #: From values by name to masks and numbers by name.
    formula: Formula
    #: Of these the first is said whose mask holds.
    sentences: tuple[Sentence, ...]
    #: Names of the values without which it is left out: what a part that is not there would have.
    needs: tuple[str, ...] = ()
    #: Names of values that may be left out: numbers, which are NaN then, and truth values, which are false.
    takes: tuple[str, ...] = ()
    #: Those of both that are truth values: masks, not numbers.
    truths: tuple[str, ...] = ()
    #: What to give where one of its needs is not there; empty where nothing is said then.
    give: str = ""
    unit: str = "1"
    severity: Severity = "info"
    #: The severity where ``holds`` of the formula is false.
    severity_of_failure: Severity | None = None
    #: The truth of the statement where it is a constant.
    holds: bool | None = None
    #: The kind of source of its formulas and its limit, where that does not depend on what is given.
    source: str | None = None

    @property
    def name(self) -> str:
        """The last part of the id: ``buckling``."""
        return self.id.rpartition(".")[2]

    @property
    def title(self) -> str:
        """The name as people read it."""
        return self.name.replace("_", " ")

    def finds(self, values: Mapping[str, Any]) -> Mapping[str, Any] | None:
        """The masks and numbers of the formula; None where a value that it needs is not given.

        Numbers follow the rules of IEEE 754, in silence.
        """
        given: dict[str, Any] = {}
        for name in self.needs:
            value = values.get(name)
            if value is None:
                return None
            given[name] = _plain(value)
        for name in self.takes:
            value = values.get(name)
            given[name] = self._left_out(name) if value is None else _plain(value)
        with np.errstate(all="ignore"):
            return self.formula(given)

    def _left_out(self, name: str) -> Any:
        return np.bool_(False) if name in self.truths else np.float64("nan")

    def text(self, values: Mapping[str, Any], words: Mapping[str, str]) -> str:
        """The sentence that is said at one point."""
        return chosen(self.sentences, values, words)

    def record(self, values: Mapping[str, Any], words: Mapping[str, str]) -> Record | None:
        """Record at one point, None where nothing is."""
        if not values.get("said", True):
            return None
        holds = bool(values["holds"]) if "holds" in values else self.holds
        holds = holds if values.get("judged", True) else None
        fails = holds is False and self.severity_of_failure is not None
        return Record(
            self.id,
            self.subject,
            self.text(values, words),
            severity=self.severity_of_failure or self.severity if fails else self.severity,
            holds=holds,
            value=float(values["value"]) if "value" in values else None,
            limit=float(values["limit"]) if "limit" in values else None,
            unit=self.unit,
        )

    def document(self) -> dict[str, Any]:
        """The row as it stands in JSON, without its formula: ``masks`` and ``numbers`` are what that gives, by name."""
        result = self.finds({name: True if name in self.truths else 1.0 for name in self.needs}) or {}
        masks = [name for name, value in result.items() if isinstance(value, bool | np.bool_)]
        return {
            "id": self.id,
            "subject": self.subject,
            "title": self.title,
            "severity": self.severity,
            "severity_of_failure": self.severity_of_failure,
            "holds": self.holds,
            "unit": self.unit,
            "needs": list(self.needs),
            "truths": list(self.truths),
            "takes": list(self.takes),
            "give": self.give or None,
            "source": self.source,
            "masks": masks,
            "numbers": [name for name in result if name not in masks],
            "sentences": [sentence.document() for sentence in self.sentences],
        }


def judged(rows: Iterable[Judgement], values: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """The masks and numbers of each row by its id; of those alone whose needs are given, None being not given.

    ``values`` are numbers in SI and masks, arrays of them, or values of a tape that records.
    """
    result = ((row.id, row.finds(values)) for row in rows)
    return {name: one for name, one in result if one is not None}


def said(rows: Iterable[Judgement], values: Mapping[str, Any], words: Mapping[str, str]) -> list[Record]:
    """The records of the rows that have something to say at one point, in their order."""
    result = ((row, row.finds(values)) for row in rows)
    records = (row.record(one, words) for row, one in result if one is not None)
    return [record for record in records if record is not None]


def utilisation(demand: Any, capacity: Any) -> Ratio:
    """Demand over capacity: nothing that is asked of nothing is no demand, something asked of nothing beyond all."""
    of_nothing = where(demand != 0, np.inf, 0.0)
    return where(capacity != 0, demand / where(capacity != 0, capacity, 1.0), of_nothing)


def at_most(value: Any, limit: Any) -> dict[str, Any]:
    """Fields of a judgement that holds up to a limit; its utilisation is the value over the limit."""
    return {"value": value, "limit": limit, "utilisation": utilisation(value, limit), "holds": value <= limit}


def at_least(value: Any, limit: Any) -> dict[str, Any]:
    """Fields of a judgement that holds from a limit on; its utilisation is the limit over the value."""
    return {"value": value, "limit": limit, "utilisation": utilisation(limit, value), "holds": value >= limit}


def is_nan(value: Any) -> Mask:
    """Mask: the value is no number."""
    return namespace(value).isnan(value)


def _plain(value: Any) -> Any:
    """A truth value or a number as NumPy has it, of which masks can be made; others as they are."""
    if type(value) is float:
        return np.float64(value)
    return np.bool_(value) if isinstance(value, bool) else as_array(value)
