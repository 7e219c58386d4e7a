"""Sweeps: one model over many operating points and designs, as a labelled dataset."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

import ballscrew
from ballscrew._arrays import BLOCK_SIZE, map_blocks
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.analyses.tape import Program, Tape
from ballscrew.assembly import NUT_REASONS, NutFriction
from ballscrew.components.contact import RaceState
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import MATERIALS, BallScrew, Operation
from ballscrew.faults import Fault, fault_of, nearest, raise_if_any
from ballscrew.model import FrictionModel
from ballscrew.quantities import Info, Quantity, fields_of, quantities_of
from ballscrew.references import citations_of
from ballscrew.result import MECHANISMS, FrictionResult
from ballscrew.solvers.load_distribution import BallLoads
from ballscrew.validity import REASONS

#: The fields of the operating point, which every sweep needs.
OPERATION = tuple(fields_of(Operation))
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


#: What of the loads of the balls of a nut is one number.
OF_LOADS = ("deflection", "rigidity", "remaining_preload", "lift_off_load", "residual")
#: What a sweep over a whole nut returns unless told otherwise.
NUT_OUTPUTS = (
    "screw_torque",
    "nut_torque",
    "ideal_torque",
    "efficiency",
    "back_driving_efficiency",
    "largest_contact_load",
    "maximum_pressure",
    "deflection",
    "rigidity",
    "remaining_preload",
    "valid",
)


#: Outputs that are truth values, besides the validity.
TRUTHS = frozenset({"self_locking"})


@dataclasses.dataclass(frozen=True, eq=False)
class Output:
    """One thing a sweep can return: how to read it off a result, and what it is."""

    name: str
    quantity: Quantity
    read: Callable[[Any], Any]

    @property
    def dtype(self) -> type:
        """Truth values for what is true or not, numbers for all else."""
        return bool if self.name.startswith("valid") or self.name in TRUTHS else float


@functools.cache
def known_outputs(nut: NutParts | None = None) -> Mapping[str, Output]:
    """Everything a sweep can return, by name: ``screw_torque``, ``nut_film_parameter``, ``contribution_curvature``…

    On a whole nut there are ``rigidity`` and other results of the loads of all balls, and no single contacts.
    """
    found: dict[str, Output] = {}
    result = FrictionResult if nut is None else NutFriction
    for name, quantity in quantities_of(result).items():
        if name not in OPERATION:
            found[name] = Output(name, quantity, lambda r, n=name: getattr(r, n))
    torque = quantities_of(FrictionResult)["screw_torque"]
    losses = {} if nut is None else {name: name for name in nut.losses}
    for mechanism, words in {**MECHANISMS, **losses}.items():
        info = dataclasses.replace(
            torque.info, symbol=f"M_S ({words})", meaning=f"friction torque on the screw by {words}"
        )
        name = f"contribution_{mechanism}"
        found[name] = Output(name, Quantity(name, torque.unit, info), lambda r, m=mechanism: r.contributions[m])
    mask = quantities_of(FrictionResult)["valid"]
    for reason, words in (REASONS if nut is None else NUT_REASONS).items():
        name, info = f"validity_{reason}", Info(reason, f"holds where true; where false, {words}")
        found[name] = Output(name, Quantity(name, mask.unit, info), lambda r, n=reason: r.validity[n])
    if nut is not None:
        of_loads = {name: quantities_of(BallLoads)[name] for name in OF_LOADS}
        return found | {n: Output(n, q, lambda r, n=n: getattr(r.loads, n)) for n, q in of_loads.items()}
    for side in ("screw", "nut"):
        for name, quantity in quantities_of(RaceState).items():
            info = dataclasses.replace(quantity.info, meaning=f"{quantity.info.meaning}, ball–{side} contact")
            full = f"{side}_{name}"
            found[full] = Output(
                full, Quantity(full, quantity.unit, info), lambda r, s=side, n=name: getattr(getattr(r, s), n)
            )
    return found


def inputs_of(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, nut: NutParts | None = None
) -> Mapping[str, tuple[str, Quantity]]:
    """Everything a sweep can vary: name to (part, quantity).

    Names are those of the fields; a coefficient of a law is ``law.field``, for example
    ``friction.boundary_friction_coefficient``.
    """
    parts = {"operation": Operation, "screw": screw, "lubricant": lubricant, "model": model}
    parts |= {} if nut is None else {"nut": nut.nut}
    found = {name: (part, quantity) for part, value in parts.items() for name, quantity in fields_of(value).items()}
    for slot, law in model.laws_with_coefficients.items():
        found |= {f"{slot}.{name}": ("model", quantity) for name, quantity in fields_of(law).items()}
    return found


def sweep(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    nut: NutParts | None = None,
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
    given. Only the ``outputs`` asked for are kept (see :func:`known_outputs`; a default handful
    otherwise). With a ``nut`` it is a whole nut whose friction is computed, and the fields of the nut can be varied.

    Work goes block by block on a few threads, and ``done(finished, total)`` is told the progress.
    Raises :class:`~ballscrew.faults.InputError` for unknown names and missing or bad values.
    """
    counts = {"block_size": block_size, "threads": threads}
    raise_if_any(
        [Fault(f"sweep.{n}", "must be 1 or more", str(v), "") for n, v in counts.items() if v is not None and v < 1]
    )
    parts = _Parts(model, screw, lubricant, nut)
    wanted = _wanted(outputs, nut)
    axes = _axes(parts, varied)
    sizes = _sizes(axes, wanted)
    shape = tuple(sizes.values())
    total = int(np.prod(shape, dtype=np.int64))
    results = {name: np.empty(total, dtype=output.dtype) for name, output in wanted.items()}
    varying = [name for name, axis in axes.items() if axis.dims]
    fixed = {name: axis.to_numpy()[()] for name, axis in axes.items() if not axis.dims}
    program = _recorded(parts, wanted, varying, fixed)

    def evaluate(block: slice) -> None:
        points = _points(axes, sizes, varying, block)
        with np.errstate(all="ignore"):
            if program is not None:
                program.play([points[name] for name in varying], {name: v[block] for name, v in results.items()})
            else:
                result = _assemble(parts, fixed | points)
                for name, output in wanted.items():
                    results[name][block] = output.read(result)

    map_blocks(
        evaluate,
        total,
        block_size=block_size or max(1, BLOCK_SIZE // parts.balls),
        threads=threads,
        done=None if done is None else lambda n: done(n, total),
    )
    return _dataset(parts, axes, sizes, wanted, {n: v.reshape(shape) for n, v in results.items()})


class _Parts(NamedTuple):
    """What is evaluated."""

    model: FrictionModel
    screw: BallScrew
    lubricant: Lubricant
    nut: NutParts | None

    @property
    def by_section(self) -> dict[str, Any]:
        """The parts with fields that can be varied."""
        nut = {} if self.nut is None else {"nut": self.nut.nut}
        return {"screw": self.screw, "lubricant": self.lubricant, "model": self.model, **nut}

    @property
    def balls(self) -> int:
        """How many balls are solved for at each point."""
        if self.nut is None or not self.nut.one_by_one:
            return 1
        return self.nut.halves * int(np.max(self.screw.loaded_balls))


def _wanted(names: Sequence[str] | None, nut: NutParts | None) -> dict[str, Output]:
    known = known_outputs(nut)
    usual = DEFAULT_OUTPUTS if nut is None else NUT_OUTPUTS
    names = (names,) if isinstance(names, str) else usual if names is None or not len(names) else names
    chosen = [str(name).replace(".", "_") for name in names]
    raise_if_any([Fault("sweep.outputs", "unknown output", n, nearest(n, known)) for n in chosen if n not in known])
    return {name: known[name] for name in chosen}


def _axes(subject: _Parts, varied: Mapping[str, Any]) -> dict[str, xr.DataArray]:
    """The values to vary as labelled arrays; all faults in them at once."""
    known = inputs_of(*subject)
    parts = subject.by_section
    faults = [Fault(f"sweep.{name}", "unknown name", "", nearest(name, known)) for name in varied if name not in known]
    faults += [Fault(f"sweep.{name}", "missing", "", f"give {name}=[…]") for name in OPERATION if name not in varied]
    faults += [
        Fault(f"{part}.{name}", "is an array", "", f"give it to the sweep: {name}=[…]")
        for name, (part, _) in known.items()
        if part != "operation" and name not in varied and np.ndim(_read(parts[part], name))
    ]
    axes: dict[str, xr.DataArray] = {}
    for name, values in varied.items():
        if name in known:
            part, quantity = known[name]
            axis = _axis(name, values)
            if isinstance(axis, Fault):
                faults.append(axis)
            else:
                axes[name] = axis
                faults += _faults_of_axis(part, quantity, axis.to_numpy())
    raise_if_any(faults)
    return axes


def _axis(name: str, values: Any) -> xr.DataArray | Fault:
    """Values as a labelled array: a sequence gets a dimension of its own name."""
    where = f"sweep.{name}"
    try:
        if isinstance(values, xr.DataArray):
            axis = values.astype(float, copy=False)
        else:
            array = np.asarray(values, dtype=float)
            if array.ndim > 1:
                return Fault(where, "has several axes", f"shape {array.shape}", "name them: pass an xarray.DataArray")
            axis = xr.DataArray(array, dims=(name,) if array.ndim else ())
    except (TypeError, ValueError):
        return Fault(where, "must be numbers in SI", str(values), "give a number or a plain list of numbers")
    return axis if axis.size else Fault(where, "has no values", "", "give at least one")


def _faults_of_axis(part: str, quantity: Quantity, values: np.ndarray) -> list[Fault]:
    """Faults of an axis: its ends (NaN comes out as both) and, where whole numbers are needed, the first broken one."""
    telling = [values.min()]
    if not np.isnan(telling[0]):
        telling.append(values.max())
    if quantity.info.whole:
        telling += values[values != np.floor(values)].ravel()[:1].tolist()
    faults = [fault_of(part, quantity, float(value)) for value in dict.fromkeys(telling)]
    return [fault for fault in faults if fault is not None]


def _sizes(axes: Mapping[str, xr.DataArray], wanted: Mapping[str, Output]) -> dict[str, int]:
    """The dimensions of a sweep and their lengths, in the order given."""
    sizes: dict[str, int] = {}
    faults: list[Fault] = []
    for axis in axes.values():
        for dimension, size in zip(map(str, axis.dims), axis.shape, strict=True):
            where = f"sweep.{dimension}"
            if sizes.setdefault(dimension, size) != size:
                faults.append(Fault(where, "different lengths", f"{sizes[dimension]} and {size}", "make them equal"))
            if axes[dimension].dims != (dimension,) if dimension in axes else dimension in wanted:
                faults.append(Fault(where, "is a dimension and something else", "", "name the dimension otherwise"))
    raise_if_any(faults)
    return sizes


def _recorded(
    subject: _Parts, wanted: Mapping[str, Output], varying: Sequence[str], fixed: Mapping[str, Any]
) -> Program | None:
    """The model as a program of the varying inputs; None for a nut, or if a law of the user's wants plain arrays."""
    if subject.nut is not None:
        return None
    tape = Tape(len(varying))
    points: dict[str, Any] = {**fixed, **{name: tape.value(i) for i, name in enumerate(varying)}}
    try:
        with np.errstate(all="ignore"):
            result = _assemble(subject, points)
            program = Program(tape, {name: output.read(result) for name, output in wanted.items()})
            program.play([np.ones(1)] * len(varying), {n: np.empty(1, output.dtype) for n, output in wanted.items()})
    except Exception:  # whatever a law of the user's cannot do with a recording, it may do with arrays
        return None
    return program


def _points(
    axes: Mapping[str, xr.DataArray], sizes: Mapping[str, int], varying: Sequence[str], block: slice
) -> dict[str, Any]:
    """The values of the varying axes at the points of one block of the flattened grid."""
    if len(sizes) == 1:
        return {name: axes[name].to_numpy()[block] for name in varying}
    flat = np.arange(block.start, block.stop)
    indices = dict(zip(sizes, np.unravel_index(flat, tuple(sizes.values())), strict=True)) if sizes else {}
    return {name: axes[name].to_numpy()[tuple(indices[str(d)] for d in axes[name].dims)] for name in varying}


def _assemble(subject: _Parts, points: dict[str, Any]) -> FrictionResult | NutFriction:
    """Put the values of a block into the parts, and evaluate."""
    parts = subject.by_section
    where = {name: part for name, (part, _) in inputs_of(*subject).items()}
    operation = {name: points[name] for name in OPERATION}
    for name, values in points.items():
        if name in operation:
            continue
        part = parts[where[name]]
        law, _, field = name.rpartition(".")
        change = {field: values} if not law else {law: dataclasses.replace(getattr(part, law), **{field: values})}
        parts[where[name]] = dataclasses.replace(part, **change)
    if subject.nut is None:
        return parts["model"](parts["screw"], parts["lubricant"], **operation)
    nut = dataclasses.replace(subject.nut, nut=parts["nut"])
    return nut.friction(parts["model"], parts["screw"], parts["lubricant"], **operation)


def _dataset(
    subject: _Parts,
    axes: Mapping[str, xr.DataArray],
    sizes: Mapping[str, int],
    wanted: Mapping[str, Output],
    results: Mapping[str, np.ndarray],
) -> xr.Dataset:
    model, screw, known = subject.model, subject.screw, inputs_of(*subject)
    coordinates: dict[str, Any] = {
        str(label): values
        for axis in axes.values()
        for label, values in axis.coords.items()
        if label in axis.dims and label not in axes
    }
    coordinates |= {name: (axis.dims, axis.to_numpy(), _attributes(known[name][1])) for name, axis in axes.items()}
    variables = {
        name: (tuple(sizes), values, _attributes(wanted[name].quantity))
        for name, values in results.items()
        if name not in axes  # what is varied is there as a coordinate
    }
    fixed = {
        f"{part}_{name.replace('.', '_')}": value
        for name, (part, _) in known.items()
        if part != "operation" and name not in axes
        if (value := _read(subject.by_section[part], name)) is not None
    }
    fixed |= {} if subject.nut is None else subject.nut.attributes(subject.screw)
    for name, material in zip(MATERIALS, screw.materials, strict=True):
        fixed |= {f"screw_{name}_{field}": getattr(material, field) for field in fields_of(material)}
    slots = {field.name: getattr(model, field.name) for field in dataclasses.fields(model)}
    fixed |= {f"model_{slot}": law.__name__ for slot, law in slots.items() if hasattr(law, "__name__")}
    return xr.Dataset(
        variables,
        coordinates,
        {
            "title": f"Ball screw friction, model {model.label}",
            "Conventions": "CF-1.11",
            "source": f"ballscrew {ballscrew.__version__}, model {model.label}",
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
