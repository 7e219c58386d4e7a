"""Warming up as tables in files: numbers over time, the shaft over time, the compensation of the growth."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.shared.row_tables import RowTable, put, write_csv, xlsx_bytes
from ballscrew.questions.warm_up.compute import EQUILIBRIUM, PLACE, SERIES, WarmUpReport

if TYPE_CHECKING:  # slow to import
    from ballscrew.questions.warm_up.band import WarmUpBandReport

_GROWTH, _TEMPERATURE = SERIES["shaft_growth"], SERIES["shaft_temperature"]


def _column(columns: dict[str, list[Any]], quantity: Quantity, values: Any, name: str) -> None:
    cells: list[dict[str, Any]] = [{} for _ in values]
    for cell, value in zip(cells, values, strict=True):
        put(cell, quantity, value, name)
    columns[units.heading(quantity, name)] = [next(iter(cell.values())) for cell in cells]


def _table(columns: Mapping[str, list[Any]]) -> RowTable:
    return RowTable(list(columns), [list(row) for row in zip(*columns.values(), strict=True)])


def series(report: WarmUpReport) -> RowTable:
    """One row for each instant."""
    columns: dict[str, list[Any]] = {}
    for name, quantity in SERIES.items():
        _column(columns, quantity, report.series[name], quantity.info.meaning)
    full = report.full_bath
    if full is not None:
        known, torque = full.warm_up.time, SERIES["screw_torque"]
        values = np.interp(report.warm_up.time, known, full.warm_up.screw_torque, right=np.nan)
        _column(columns, torque, values, f"{torque.info.meaning}, in a full bath of oil")
    places, drift = report.drift
    for place, growth in zip(places, drift.T, strict=True):
        _column(columns, _GROWTH, growth, f"growth at {units.shown(float(place), PLACE)}")
    columns["works"] = [int(value) for value in report.warm_up.works]
    return _table(columns)


def compensation(report: WarmUpReport) -> RowTable:
    """Places on the shaft and the growth there at the end of work."""
    columns: dict[str, list[Any]] = {}
    places, growth = report.compensation
    _column(columns, PLACE, places, "place")
    _column(columns, _GROWTH, growth, "growth")
    return _table(columns)


def shaft(report: WarmUpReport) -> RowTable:
    """Temperatures of the shaft: instants down, places along."""
    columns: dict[str, list[Any]] = {}
    _column(columns, SERIES["time"], report.warm_up.time, "time")
    for place, values in zip(report.warm_up.places, report.warm_up.shaft_temperature.T, strict=True):
        _column(columns, _TEMPERATURE, values, f"at {units.shown(float(place), PLACE)}")
    return _table(columns)


def steady(report: WarmUpReport) -> RowTable:
    """The steady state."""
    end = report.warm_up.equilibrium
    rows: list[list[Any]] = [
        ["exists", int(end.exists), ""],
        ["stability margin of the thermal loop", _finite(end.margin), ""],
    ]
    for name, quantity in EQUILIBRIUM.items():
        cell: dict[str, Any] = {}
        put(cell, quantity, report.equilibrium[name])
        rows.append([quantity.info.meaning, *cell.values(), units.label(quantity)])
    return RowTable(["number", "value", "unit"], rows)


def band(found: WarmUpBandReport) -> RowTable:
    """Ends and median of each band at each instant."""
    columns: dict[str, list[Any]] = {}
    _column(columns, SERIES["time"], found.bands.time, "time")
    for name, one in found.bands.series.items():
        for end in ("low", "median", "high"):
            _column(columns, SERIES[name], getattr(one, end), f"{SERIES[name].info.meaning}, {end}")
    columns["share of samples known"] = [float(share) for share in found.bands.known_share]
    return _table(columns)


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def write(to: Path, report: WarmUpReport, found: WarmUpBandReport | None = None) -> None:
    """Write .csv (numbers over time) or .xlsx (all tables), whole or not at all."""
    with atomic_write("--to", to) as path:
        if to.suffix.lower() == ".xlsx":
            tables = {
                "over time": series(report),
                "steady state": steady(report),
                "compensation": compensation(report),
                "shaft": shaft(report),
                **({} if found is None else {"band": band(found)}),
            }
            path.write_bytes(xlsx_bytes(tables))
        else:
            write_csv(path, series(report))


def write_band(to: Path, found: WarmUpBandReport) -> None:
    """Write the bands over time as .csv, whole or not at all."""
    with atomic_write("--to", to) as path:
        write_csv(path, band(found))


def write_compensation(to: Path, report: WarmUpReport) -> None:
    """Write the compensation table as .csv, whole or not at all."""
    with atomic_write("--to", to) as path:
        write_csv(path, compensation(report))
