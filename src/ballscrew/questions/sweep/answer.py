"""The results of a sweep, declared once: JSON and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import of_case
from ballscrew.engine.uncertainty.bands import ENDS, inner_end, inner_levels
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT
from ballscrew.questions.sweep.compute import Plan, implausible, starved


@dataclasses.dataclass(frozen=True, eq=False)
class Values:
    """Values along the axes of a sweep, in their order, one array in the other."""

    #: The values, SI.
    values: Sequence[Any]
    #: SI unit.
    unit: str
    #: What they are.
    meaning: str


@dataclasses.dataclass(frozen=True, eq=False)
class InnerInterval:
    """A narrower interval of an output: fewer of the samples of the band are between its ends."""

    #: Share of the samples between the ends.
    level: Annotated[float, FINITE]
    #: Lower ends, SI.
    low: Sequence[Any]
    #: Upper ends, SI.
    high: Sequence[Any]


@dataclasses.dataclass(frozen=True, eq=False)
class Swept(Values):
    """Values of an output, with the ends of its band where bands were asked for."""

    #: Lower ends of its band, SI.
    low: Annotated[Sequence[Any] | None, LEFT_OUT] = None
    #: Upper ends of its band, SI.
    high: Annotated[Sequence[Any] | None, LEFT_OUT] = None
    #: Narrower intervals within its band, from the narrowest on.
    inner: Annotated[Sequence[InnerInterval] | None, LEFT_OUT] = None


class SweepBand(NamedTuple):
    """Level, samples and seed of the bands of a sweep."""

    #: Share of the samples between the ends.
    level: Annotated[float, FINITE]
    #: Samples of each point.
    samples: int
    #: Seed of the random numbers.
    seed: int


class SweepResults(NamedTuple):
    """Results over ranges of the operating point or of other fields."""

    #: The axes, by name.
    axes: Mapping[str, Values]
    #: The outputs, by name.
    outputs: Mapping[str, Swept]
    #: What the bands are of, where bands were asked for.
    band: Annotated[SweepBand | None, LEFT_OUT]


def results(plan: Plan, dataset: xr.Dataset) -> SweepResults:
    """Axes and outputs of a sweep."""

    def said(name: str) -> tuple[str, str]:
        return plan.quantities[name].unit, plan.quantities[name].info.meaning

    def output(name: str) -> Swept:
        ends = (dataset[end].to_numpy().tolist() for end in plan.ends_of(name))
        inner = [
            InnerInterval(level, *(dataset[inner_end(name, end, level)].to_numpy().tolist() for end in ENDS))
            for level in inner_levels(dataset)
            if name in plan.outputs and plan.ends_of(name)
        ]
        return Swept(dataset[name].to_numpy().tolist(), *said(name), *ends, inner=inner or None)

    return SweepResults(
        axes={name: Values(values.tolist(), *said(name)) for name, values in plan.axes.items()},
        outputs={name: output(name) for name in dict.fromkeys((*plan.outputs, "valid"))},
        band=SweepBand(*(dataset.attrs[f"band_{name}"] for name in SweepBand._fields)) if plan.banded else None,
    )


def document(case: Case, plan: Plan, dataset: xr.Dataset) -> dict[str, Any]:
    """Axes, outputs with the ends of their bands where there are bands, verdicts, checks and warnings, provenance."""
    return {
        **declared.document(results(plan, dataset)),
        "verdicts": [],
        "checks": [],
        "warnings": documents([*implausible(case, plan), *starved(dataset), *warnings(dataset)]),
        "provenance": of_case(case),
    }


def warnings(dataset: xr.Dataset) -> list[Record]:
    """A warning where the model is not valid at some of the points."""
    valid = dataset["valid"].to_numpy()
    count = int(valid.size - valid.sum())
    if not count:
        return []
    message = f"{units.number(count, 9)} of {units.number(valid.size, 9)} points lie outside the model's validity"
    return [Record.warning("validity.points", "valid", message, value=float(count), limit=0.0)]
