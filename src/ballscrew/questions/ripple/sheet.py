"""The sheet of a ripple: size and orders of the torque, as the nut is and with each fault; verdicts; curves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Array, Info, Quantity, quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.physics.moving_balls.ripple import NamedOrder, Ripple
from ballscrew.questions.ripple.compute import RippleReport

_KNOWN, _ORDER = quantities_of(Ripple), quantities_of(NamedOrder)
_TORQUE = Quantity("torque", "N m", Info("M", "friction torque of the balls"))
_TURNS = Quantity("turns", "1", Info("n", "turns of the screw"))
_COLOURS: tuple[Colour, ...] = ("blue", "orange", "green", "purple", "red", "grey")
#: Orders and turns that are drawn, and the least amplitude over the greatest.
_MOST_ORDER, _MOST_TURNS, _LEAST = 24.0, 6.0, 1e-4


def sheet(report: RippleReport) -> Sheet:
    """All that people see of a ripple."""
    ripples = {"as it is": report.ripple, **report.faults}
    return Sheet(
        f"torque over the angle: {descriptions.nut_text(report.case.screw.nut)}",
        [
            Lines([Line(descriptions.design(report.case, plain_text=True), "small")], detail=True),
            verdict_lines(report.verdicts),
            warning_lines(report.case.implausible()),
            _sizes(ripples),
            *_range(report),
            _orders(ripples),
            *_charts(ripples),
            Lines([Line(f"assumed: {message}", "small") for message in report.assumed]),
            *_files(ripples),
        ],
    )


def _sizes(ripples: Mapping[str, Ripple]) -> Table:
    """Mean and range of the torque, as the nut is and with each fault."""
    rows: list[list[Cell]] = [
        [
            name,
            Number(ripple.mean, _KNOWN["mean"], 3),
            Number(ripple.peak_to_peak, _KNOWN["peak_to_peak"], 3),
            Share(ripple.relative, bar=False),
            Number(ripple.deviation, _KNOWN["deviation"], 3),
            Number(ripple.share, _KNOWN["share"], 2),
        ]
        for name, ripple in ripples.items()
    ]
    columns = ("", "mean", "peak to peak", "over mean", "standard deviation", "force between balls")
    notes = ["Forces between balls are over the load of a ball.", *_displacement(ripples["as it is"])]
    return Table("sizes", "Torque of the balls", columns, rows, notes)


def _displacement(ripple: Ripple) -> Iterator[str]:
    if math.isfinite(ripple.displacement):
        moved = units.shown(ripple.displacement, _KNOWN["displacement"], 2)
        yield f"The nut moves against the screw by {moved} along the axis at constant load."


def _range(report: RippleReport) -> Iterator[Table]:
    """The range of several nuts, where they are asked for."""
    if report.range is not None:
        nuts, low, median, high = report.range
        peaks = Number(median, _KNOWN["peak_to_peak"], 3, (low, high))
        yield Table("nuts", f"{nuts} nuts", ("", "median (eight in ten)"), [["peak to peak", peaks]])


def _orders(ripples: Mapping[str, Ripple]) -> Table:
    """The orders with their causes, as the nut is and with each fault."""
    rows: list[list[Cell]] = []
    for orders in zip(*(ripple.orders for ripple in ripples.values()), strict=True):
        amplitudes = [Number(float(order.amplitude), _ORDER["amplitude"], 2) for order in orders]
        rows.append([orders[0].name, Number(float(orders[0].order), _ORDER["order"]), *amplitudes])
    return Table("orders", "Amplitude of orders", ("", "per turn", *ripples), rows)


def _charts(ripples: Mapping[str, Ripple]) -> Iterator[Chart]:
    colours = dict(zip(ripples, _COLOURS * len(ripples), strict=False))
    torques, spectra = list[Curve](), list[Curve | Vertical]()
    for name, ripple in ripples.items():
        turns, (orders, amplitudes) = ripple.angle / (2 * math.pi), ripple.spectrum
        drawn, listed = turns <= _MOST_TURNS, (orders > 0) & (orders <= _MOST_ORDER)
        torques.append(Curve(name, turns[drawn], ripple.torque[drawn], colours[name]))
        spectra.append(Curve(name, orders[listed], amplitudes[listed], colours[name]))
    for index, order in enumerate(ripples["as it is"].orders):
        spectra.append(Vertical("" if index else "with a cause", float(order.order)))
    yield Chart("torque of the balls", Axis("turns of the screw", _TURNS), Axis("torque", _TORQUE, least=0.0), torques)
    least = _LEAST * max(float(np.max(ripple.spectrum[1])) for ripple in ripples.values())
    amplitude = Axis("amplitude", _ORDER["amplitude"], log=True, least=least)
    yield Chart("orders of the torque", Axis("order, per turn of the screw", _ORDER["order"]), amplitude, spectra)


def _files(ripples: Mapping[str, Ripple]) -> Iterator[Columns]:
    """Torque over the turns and amplitude over the orders, of each nut below the other."""
    torque = [(ripple.angle / (2 * math.pi), ripple.torque) for ripple in ripples.values()]
    spectra = [ripple.spectrum for ripple in ripples.values()]
    yield _curves("curves", list(ripples), ("turns", _TURNS, "torque", _TORQUE), torque)
    yield _curves("spectra", list(ripples), ("order", _ORDER["order"], "amplitude", _ORDER["amplitude"]), spectra)


def _curves(
    name: str, nuts: Sequence[str], axes: tuple[str, Quantity, str, Quantity], curves: Sequence[tuple[Array, Array]]
) -> Columns:
    nut = [nut for nut, (x, _) in zip(nuts, curves, strict=True) for _ in x]
    x, y = (np.concatenate(values) for values in zip(*curves, strict=True))
    return Columns(name, [Column("nut", nut), Column(axes[0], x, axes[1]), Column(axes[2], y, axes[3])])
