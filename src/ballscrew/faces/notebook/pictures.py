"""Pictures of results and sweeps, for notebooks and files."""

from __future__ import annotations

import dataclasses
import functools
import io
import os
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.quantities import Quantity, fields_of, quantities_of
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import NUTS
from ballscrew.physics.components.oil_grades import SHEET_TEMPERATURE, DataSheet
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.shared import charts

_TORQUE = "friction torque on the screw (N m)"
_OPERATION = fields_of(OperatingState)
_PARTS = (DataSheet, Lubricant, FrictionModel, *NUTS.values(), BallScrew, OperatingState)
#: Inputs that a sweep can vary, with the units that people read.
_INPUTS = {
    **{name: quantity for part in _PARTS for name, quantity in fields_of(part).items()},
    SHEET_TEMPERATURE.name: SHEET_TEMPERATURE,
}
_LEVELS = 15


@dataclasses.dataclass(frozen=True, eq=False)
class Picture:
    """A figure in the house style: a notebook shows it, ``save`` writes it."""

    figure: Figure

    def save(self, to: str | os.PathLike[str]) -> Path:
        """Write it as .png, .svg or .pdf, by the ending. Raises :class:`~ballscrew.basis.errors.InputError` for
        others.
        """
        charts.check_picture(Path(to), "to")
        charts.draw(lambda: self.figure, Path(to), "to")
        return Path(to)

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        with charts.house_style():
            charts.save_as(self.figure, buffer, "png")
        return buffer.getvalue()


@functools.singledispatch
def picture(value: Any) -> Picture:
    """The picture of a value. Raises :class:`~ballscrew.basis.errors.InputError` for what has none."""
    raise InputError(Fault("plot", "has no picture", type(value).__name__, "plot a result or a sweep"))


@picture.register
def _of_result(result: FrictionResult) -> Picture:
    """The friction by cause: bars at a point, areas along a load or a speed."""
    with charts.house_style():
        if np.ndim(result.screw_torque) == 0:
            return Picture(_bars(result))
        return Picture(_areas(result))


def _parts(result: FrictionResult) -> dict[str, Any]:
    return {name: part for name, part in result.contributions.items() if np.any(np.asarray(part, dtype=float) != 0)}


def _bars(result: FrictionResult) -> Figure:
    load, speed = (units.shown(float(getattr(result, n)), _OPERATION[n]) for n in ("axial_load", "screw_speed"))
    caption = f"At {load} and {speed}; in all {float(result.screw_torque):.4g} N m."
    figure, (panel,) = charts.new_figure(caption, columns=1)
    parts = _parts(result)
    colours = [charts.MECHANISM_COLOURS.get(name, charts.GREY) for name in parts]
    panel.barh([MECHANISMS.get(n, n) for n in parts], [float(part) for part in parts.values()], color=colours)
    panel.invert_yaxis()
    panel.set_xlabel(_TORQUE)
    panel.grid(visible=False, axis="y")
    return figure


def _areas(result: FrictionResult) -> Figure:
    shape = np.shape(result.screw_torque)
    moving = {n: np.asarray(getattr(result, n), dtype=float) for n in ("axial_load", "screw_speed")}
    varied = [n for n, values in moving.items() if values.size > 1 and np.ptp(values) > 0]
    if len(shape) != 1 or len(varied) != 1:
        remedy = "give one of load and speed as a list, or plot a sweep: ds.ballscrew.plot_map()"
        raise InputError(Fault("plot", "needs one load or one speed that varies", str(shape), remedy))
    along = varied[0]
    order = np.argsort(np.broadcast_to(moving[along], shape))
    x = np.asarray(units.from_si(np.broadcast_to(moving[along], shape)[order], _OPERATION[along]))
    caption = "Areas add up to the friction torque; where it is shaded the model does not hold."
    figure, (panel,) = charts.new_figure(caption, columns=1)
    parts = {
        name: np.broadcast_to(np.asarray(part, dtype=float), shape)[order] for name, part in _parts(result).items()
    }
    panel.stackplot(
        x,
        list(parts.values()),
        labels=[MECHANISMS.get(n, n) for n in parts],
        colors=[charts.MECHANISM_COLOURS.get(n, charts.GREY) for n in parts],
        linewidth=0,
    )
    panel.plot(x, np.asarray(result.screw_torque)[order], color=charts.INK, label="total")
    _shade(panel, x, np.broadcast_to(np.asarray(result.valid), shape)[order])
    panel.set_xlabel(_label(_OPERATION[along]))
    panel.set_ylabel(_TORQUE)
    panel.set_xlim(float(x[0]), float(x[-1]))
    panel.legend(loc="best", fontsize=8.5)
    return figure


def _shade(panel: Axes, x: Any, valid: Any) -> None:
    """Grey where the model does not hold."""
    if not np.all(valid):
        low, high = panel.get_ylim()
        panel.fill_between(x, low, high, where=~valid, color=charts.SHADE, alpha=0.6, linewidth=0, zorder=3, step="mid")
        panel.set_ylim(low, high)


def _label(quantity: Quantity) -> str:
    unit = units.label(quantity)
    return f"{quantity.info.meaning} ({unit})" if unit else quantity.info.meaning


def sweep_map(data: xr.Dataset, output: str) -> Picture:
    """An output of a sweep over its two axes, hatched where the model does not hold; over one axis a line.

    Raises :class:`~ballscrew.basis.errors.InputError` for an output that the dataset lacks, and for other numbers of
    axes.
    """
    if output not in data.data_vars:
        remedy = nearest(output, list(map(str, data.data_vars)))
        raise InputError(Fault("plot_map.output", "is no output of this sweep", output, remedy))
    values = data[output]
    if values.ndim not in (1, 2):
        remedy = "choose values of the others: ds.isel(temperature=0).ballscrew.plot_map()"
        raise InputError(Fault("plot_map", "needs one or two axes", ", ".join(map(str, values.dims)), remedy))
    with charts.house_style():
        title = str(data.attrs.get("title", "Computed by ballscrew"))
        caption = f"{title}. Where it is hatched or shaded the model does not hold."
        figure, (panel,) = charts.new_figure(caption, columns=1)
        (_line if values.ndim == 1 else _contours)(figure, panel, data, values)
    return Picture(figure)


def _axis(data: xr.Dataset, name: str) -> tuple[Any, str]:
    """The values of an axis in the unit that people read, and its label."""
    values, attributes = data[name].to_numpy(), data[name].attrs
    known = _INPUTS.get(name.removeprefix("nut."))
    if known is not None and known.unit == attributes.get("units", known.unit):
        return np.asarray(units.from_si(values, known)), _label(known)
    unit = str(attributes.get("units", ""))
    words = str(attributes.get("long_name", name))
    return values, f"{words} ({unit})" if unit not in ("", "1") else words


def _of_output(values: xr.DataArray) -> tuple[Any, str]:
    name = str(values.name)
    known = {**quantities_of(FrictionResult), **{n: o.quantity for n, o in known_outputs().items()}}
    if name in known:
        return np.asarray(units.from_si(values.to_numpy(), known[name])), _label(known[name])
    return values.to_numpy(), str(values.attrs.get("long_name", name))


def _line(figure: Figure, panel: Axes, data: xr.Dataset, values: xr.DataArray) -> None:
    del figure
    x, across = _axis(data, str(values.dims[0]))
    y, words = _of_output(values)
    panel.plot(x, y, color=charts.BLUE)
    if "valid" in data:
        _shade(panel, x, data["valid"].to_numpy())
    panel.set_xlabel(across)
    panel.set_ylabel(words)


def _contours(figure: Figure, panel: Axes, data: xr.Dataset, values: xr.DataArray) -> None:
    down, across = (str(name) for name in values.dims)
    (x, x_words), (y, y_words) = _axis(data, across), _axis(data, down)
    z, words = _of_output(values)
    drawn = panel.contourf(x, y, np.ma.masked_invalid(z), levels=_LEVELS, cmap="viridis")
    if "valid" in data and data["valid"].dims == values.dims and not bool(data["valid"].all()):
        holds = data["valid"].to_numpy().astype(float)
        panel.contourf(x, y, holds, levels=[-0.5, 0.5], colors="none", hatches=["////"])
    figure.colorbar(drawn, ax=panel, label=words)
    panel.set_xlabel(x_words)
    panel.set_ylabel(y_words)
    panel.grid(visible=False)
