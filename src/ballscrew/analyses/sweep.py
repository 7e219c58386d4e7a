"""Sweeps: one model over many operating points and designs, as a labelled dataset."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

import ballscrew
from ballscrew._arrays import map_blocks
from ballscrew.analyses.tape import Program, Tape
from ballscrew.components.contact import RaceState
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.faults import Fault, InputError, fault_of, nearest
from ballscrew.model import FrictionModel
from ballscrew.quantities import Quantity, quantities_of
from ballscrew.references import citations_of
from ballscrew.result import MECHANISMS, FrictionResult

#: What a sweep returns unless told otherwise.
DEFAULT_OUTPUTS = (
    "screw_torque",
    "nut_torque",
    "ideal_torque",
    "efficiency",
    "back_driving_efficiency",
    "contact_load",
    "screw_film_parameter",
    "nut_film_parameter",
    "screw_friction_coefficient",
    "nut_friction_coefficient",
    "valid",
)


@dataclasses.dataclass(frozen=True, eq=False)
class Output:
    """One thing a sweep can return: how to read it off a result, and what it is."""

    name: str
    quantity: Quantity
    read: Callable[[FrictionResult], Any]


def outputs() -> Mapping[str, Output]:
    """Everything a sweep can return, by name: ``screw_torque``, ``nut_film_parameter``, ``contribution_curvature``…"""
    found: dict[str, Output] = {}
    inputs = {"axial_load", "screw_speed"}
    for name, quantity in quantities_of(FrictionResult).items():
        if name not in inputs:
            found[name] = Output(name, quantity, lambda r, n=name: getattr(r, n))
    torque = quantities_of(FrictionResult)["screw_torque"]
    for mechanism, words in MECHANISMS.items():
        info = dataclasses.replace(
            torque.info, symbol=f"M_S ({words})", meaning=f"friction torque on the screw by {words}"
        )
        name = f"contribution_{mechanism}"
        found[name] = Output(name, Quantity(name, torque.unit, info), lambda r, m=mechanism: r.contributions[m])
    for side in ("screw", "nut"):
        for name, quantity in quantities_of(RaceState).items():
            info = dataclasses.replace(quantity.info, meaning=f"{quantity.info.meaning}, ball–{side} contact")
            full = f"{side}_{name}"
            found[full] = Output(
                full, Quantity(full, quantity.unit, info), lambda r, s=side, n=name: getattr(getattr(r, s), n)
            )
    return found


def inputs_of(model: FrictionModel, screw: BallScrew, lubricant: Lubricant) -> Mapping[str, tuple[str, Quantity]]:
    """Everything a sweep can vary: name to (part, quantity).

    Names are those of the fields; a coefficient of a law is ``law.field``, for example
    ``friction.boundary_friction_coefficient``.
    """
    found: dict[str, tuple[str, Quantity]] = {}
    for part, value in (("operation", Operation), ("screw", screw), ("lubricant", lubricant), ("model", model)):
        cls = value if inspect.isclass(value) else type(value)
        fields = {field.name for field in dataclasses.fields(cls)}
        for name, quantity in quantities_of(cls).items():
            if name in fields:
                found[name] = (part, quantity)
    for field in dataclasses.fields(model):
        law = getattr(model, field.name)
        if dataclasses.is_dataclass(law) and not inspect.isclass(law):
            for name, quantity in quantities_of(type(law)).items():
                found[f"{field.name}.{name}"] = ("model", quantity)
    return found


def sweep(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    outputs: Sequence[str] | None = None,
    block_size: int | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    **varied: Any,
) -> xr.Dataset:
    """Evaluate a model over the values given, and return them with names, units and sources.

    ``varied`` gives values to any field of the operating point (``axial_load`` and ``screw_speed``
    are needed), the screw, the lubricant or the model, in SI; coefficients of laws as
    ``**{"friction.boundary_friction_coefficient": [...]}``. A sequence becomes a dimension of its
    own name; ``xarray.DataArray`` values that share a dimension vary together along it, so random
    points are ``xr.DataArray(values, dims="point")``. The dataset has the dimensions in the order
    given. Only the ``outputs`` asked for are kept (see :func:`outputs`; a default handful
    otherwise).

    Work goes block by block on a few threads, and ``done(finished, total)`` is told the progress.
    Raises :class:`~ballscrew.faults.InputError` for unknown names and missing or bad values.
    """
    wanted = _wanted(outputs)
    axes = _axes(model, screw, lubricant, varied)
    sizes: dict[str, int] = {}
    for axis in axes.values():
        for dimension, size in zip(axis.dims, axis.shape, strict=True):
            if sizes.setdefault(str(dimension), size) != size:
                raise InputError(
                    Fault(
                        f"sweep.{dimension}",
                        "different lengths",
                        f"{sizes[str(dimension)]} and {size}",
                        "make them equal",
                    )
                )
    shape = tuple(sizes.values())
    total = int(np.prod(shape, dtype=np.int64))
    results = {name: np.empty(total, dtype=bool if name == "valid" else float) for name in wanted}

    varying = [name for name, axis in axes.items() if axis.dims]
    fixed = {name: axis.to_numpy()[()] for name, axis in axes.items() if not axis.dims}
    program = _recorded(model, screw, lubricant, wanted, varying, fixed)

    def evaluate(block: slice) -> None:
        points = _points(axes, sizes, varying, block)
        with np.errstate(all="ignore"):
            if program is not None:
                program.play([points[name] for name in varying], {name: v[block] for name, v in results.items()})
            else:
                result = _assemble(model, screw, lubricant, fixed | points)
                for name, output in wanted.items():
                    results[name][block] = output.read(result)

    map_blocks(
        evaluate,
        total,
        threads=threads,
        done=None if done is None else lambda n: done(n, total),
        **({} if block_size is None else {"block_size": block_size}),
    )
    return _dataset(model, screw, lubricant, axes, sizes, wanted, {n: v.reshape(shape) for n, v in results.items()})


def _wanted(names: Sequence[str] | None) -> dict[str, Output]:
    known = outputs()
    chosen = [name.replace(".", "_") for name in (names or DEFAULT_OUTPUTS)]
    faults = [
        Fault("sweep.outputs", "unknown output", name, nearest(name, known)) for name in chosen if name not in known
    ]
    if faults:
        raise InputError(*faults)
    return {name: known[name] for name in chosen}


def _axes(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, varied: Mapping[str, Any]
) -> dict[str, xr.DataArray]:
    known = inputs_of(model, screw, lubricant)
    faults: list[Fault] = []
    axes: dict[str, xr.DataArray] = {}
    for name, values in varied.items():
        if name not in known:
            faults.append(Fault(f"sweep.{name}", "unknown name", "", nearest(name, known)))
            continue
        part, quantity = known[name]
        if isinstance(values, xr.DataArray):
            axes[name] = values.astype(float, copy=False)
        else:
            array = np.asarray(values, dtype=float)
            if array.ndim > 1:
                faults.append(
                    Fault(
                        f"sweep.{name}",
                        "has more than one axis",
                        f"shape {array.shape}",
                        "name its axes: pass an xarray.DataArray",
                    )
                )
                continue
            axes[name] = xr.DataArray(array, dims=(name,) if array.ndim else ())
        if axes[name].size == 0:
            faults.append(Fault(f"sweep.{name}", "has no values", "", "give at least one"))
        for extreme in {float(v) for v in _extremes(axes[name].to_numpy())}:
            fault = fault_of(part, quantity, extreme)
            if fault is not None:
                faults.append(fault)
    for name in ("axial_load", "screw_speed"):
        if name not in varied:
            faults.append(Fault(f"sweep.{name}", "missing", "", f"give {name}=[…]"))
    if faults:
        raise InputError(*faults)
    return axes


def _extremes(values: np.ndarray) -> np.ndarray:
    """The values that decide whether all are within bounds: NaN if there is one, else the ends."""
    return np.array([values.min(), values.max()]) if values.size else values


def _recorded(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    wanted: Mapping[str, Output],
    varying: Sequence[str],
    fixed: Mapping[str, Any],
) -> Program | None:
    """The model as a program of the varying inputs, or None if a law of the user's cannot be recorded."""
    tape = Tape(len(varying))
    points: dict[str, Any] = {**fixed, **{name: tape.value(i) for i, name in enumerate(varying)}}
    try:
        with np.errstate(all="ignore"):
            result = _assemble(model, screw, lubricant, points)
            return Program(tape, {name: output.read(result) for name, output in wanted.items()})
    except TypeError:
        return None


def _points(
    axes: Mapping[str, xr.DataArray], sizes: Mapping[str, int], varying: Sequence[str], block: slice
) -> dict[str, Any]:
    """The values of the varying axes at the points of one block of the flattened grid."""
    if len(sizes) == 1:
        return {name: axes[name].to_numpy()[block] for name in varying}
    flat = np.arange(block.start, block.stop)
    indices = dict(zip(sizes, np.unravel_index(flat, tuple(sizes.values())), strict=True)) if sizes else {}
    return {name: axes[name].to_numpy()[tuple(indices[str(d)] for d in axes[name].dims)] for name in varying}


def _assemble(model: FrictionModel, screw: BallScrew, lubricant: Lubricant, points: dict[str, Any]) -> FrictionResult:
    """Put the values of a block into the parts, and evaluate."""
    parts: dict[str, Any] = {"screw": screw, "lubricant": lubricant, "model": model}
    where = {name: part for name, (part, _) in inputs_of(model, screw, lubricant).items()}
    operation = {name: points[name] for name in ("axial_load", "screw_speed")}
    for name, values in points.items():
        if name in operation:
            continue
        part = parts[where[name]]
        law, _, field = name.rpartition(".")
        change = {field: values} if not law else {law: dataclasses.replace(getattr(part, law), **{field: values})}
        parts[where[name]] = dataclasses.replace(part, **change)
    return parts["model"](parts["screw"], parts["lubricant"], **operation)


def _dataset(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    axes: Mapping[str, xr.DataArray],
    sizes: Mapping[str, int],
    wanted: Mapping[str, Output],
    results: Mapping[str, np.ndarray],
) -> xr.Dataset:
    known = inputs_of(model, screw, lubricant)
    coordinates = {name: (axis.dims, axis.to_numpy(), _attributes(known[name][1])) for name, axis in axes.items()}
    variables = {name: (tuple(sizes), values, _attributes(wanted[name].quantity)) for name, values in results.items()}
    fixed = {
        f"{part}_{name.replace('.', '_')}": value
        for name, (part, _) in known.items()
        if part != "operation" and name not in axes
        if (value := _read({"screw": screw, "lubricant": lubricant, "model": model}[part], name)) is not None
    }
    for name in ("ball_material", "screw_material", "nut_material"):
        material = getattr(screw, name)
        fixed |= {f"screw_{name}_{field}": getattr(material, field) for field in quantities_of(type(material))}
    return xr.Dataset(
        variables,
        coordinates,
        {
            "title": f"Ball screw friction, model {model.name}",
            "Conventions": "CF-1.11",
            "source": f"ballscrew {ballscrew.__version__}, model {model.name}",
            "references": "; ".join(citations_of(model)),
            **{name: value for name, value in fixed.items() if np.ndim(value) == 0},
        },
    )


def _read(part: Any, name: str) -> Any:
    """A field of a part, or ``law.field`` of one of its laws."""
    law, _, field = name.rpartition(".")
    return getattr(getattr(part, law) if law else part, field)


def _attributes(quantity: Quantity) -> dict[str, str]:
    """CF attributes of a variable, from its annotation."""
    attributes = {
        "long_name": quantity.info.meaning,
        "units": quantity.unit,
        "symbol": quantity.info.symbol,
    }
    if quantity.info.address:
        attributes["references"] = quantity.info.address
    return attributes
