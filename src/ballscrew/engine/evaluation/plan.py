"""A plan: what is evaluated, over which points, and what is wanted of it."""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import hashlib
import importlib.metadata
import math
import sys
import types
from collections.abc import Generator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import MISSING, Fault, nearest, raise_if_any
from ballscrew.basis.quantities import Quantity, fields_of, quantities_of
from ballscrew.basis.records import Record
from ballscrew.basis.references import citations_of
from ballscrew.basis.version import __version__
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import CannotRecordError, Tape, why_not_recorded
from ballscrew.engine.evaluation.outputs import (
    DEFAULT_OUTPUTS,
    NUT_OUTPUTS,
    OPERATION,
    Output,
    attributes_of,
    axis_of,
    ends,
    faults_of_axis,
    inputs_of,
    known_outputs,
)
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Nut, NutParts
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.model import SLOTS, FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import implausible, named_parts
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.solvers.load_distribution import BallLoads

#: Where code comes from: this package, an installed library or Python itself, or anywhere else.
Origin = Literal["package", "library", "outside"]
_PACKAGE = __name__.partition(".")[0]
#: Values without an address.
_DATA = frozenset({dict, list, set, tuple, frozenset, np.ndarray})


def name_in_library(value: Any) -> str:
    """The address of a function, class or constant of a library; empty if it is none."""
    if type(value) in _DATA:
        return ""
    module, name = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    if isinstance(value, np.ufunc):
        module, name = "numpy", value.__name__
        if getattr(np, name, None) is not value:
            module = "scipy.special"
    if not isinstance(module, str) or not isinstance(name, str) or _origin_of(module) != "library":
        return ""
    if isinstance(value, type) and module == "builtins":
        return f"{library(module)}:{name};"  # also types without a name there, as that of None
    result: Any = sys.modules.get(module)
    for part in name.split("."):
        result = getattr(result, part, None)
    return f"{library(module)}:{module}.{name};" if result is value else ""


def origin(item: Any) -> Origin:
    """The origin of a function, a class or a module."""
    if isinstance(item, types.ModuleType):
        return _origin_of(item.__name__)
    return _origin_of(getattr(item, "__module__", None) or "")


@functools.cache
def _origin_of(module: str) -> Origin:
    top = module.partition(".")[0]
    if top == _PACKAGE:
        return "package"
    file = getattr(sys.modules.get(top), "__file__", None)
    if top in sys.builtin_module_names or (top in sys.stdlib_module_names and top in sys.modules):
        return "library" if file is None or Path(file).is_relative_to(sys.base_prefix) else "outside"
    is_installed = file is not None and {"site-packages", "dist-packages"} & set(Path(file).parts)
    return "library" if is_installed and _distribution(top) else "outside"


@functools.cache
def _distribution(top: str) -> importlib.metadata.Distribution | None:
    try:
        return importlib.metadata.distribution(top)
    except importlib.metadata.PackageNotFoundError:  # named otherwise, as scikit-learn is; to look for it takes longer
        names = importlib.metadata.packages_distributions().get(top)
    return importlib.metadata.distribution(names[0]) if names else None


@functools.cache
def library(module: str) -> str:
    """A library as it is installed: its name, and the version of Python or a digest of its files."""
    top = module.partition(".")[0]
    distribution = None if top in sys.stdlib_module_names else _distribution(top)
    if distribution is None:
        return f"python {sys.version}"
    record = distribution.read_text("RECORD") or ""
    # of scripts and caches the record has other digests in each environment
    lines = [line for line in record.splitlines() if line.startswith(top) and "__pycache__" not in line]
    digest = hashlib.sha256("\n".join(sorted(lines)).encode()).hexdigest()
    return f"{top} {distribution.version} {digest}"


#: Attributes of a dataset that is starved of oil: the friction torque as given and in a full bath where it is most so.
STARVED = ("most_starved_torque", "most_starved_flooded_torque")
#: Points of a plan, besides its corners, at which it is judged whether they are starved of oil.
_JUDGED = 48
#: Balls at all points up to which each point is judged.
_FEW_BALLS = 2000
#: Balls at the rows of a log that are solved for to judge starvation, and rows at once.
_MOST_BALLS, _AT_ONCE = 20_000, 4096
#: Corners of the inputs of oil and screw at most that tell whether that can be at all.
_MOST_CORNERS = 4096
_REPLENISHMENT = "inlet.replenishment_constant"
#: Multiples of it, less their whole part, are spread evenly.
_GOLDEN = (math.sqrt(5) - 1) / 2
_OF_POINTS = "so at the point that starves the most; the output flooded_torque has it for each"
#: An axis of more values is long: to read it twice takes time.
LONG_AXIS = 100_000


@dataclasses.dataclass(frozen=True, eq=False)
class Configuration(ByValue):
    """Configuration to evaluate: a model, a ball screw with its nut, and the lubricant."""

    model: FrictionModel
    screw: BallScrew
    lubricant: Lubricant

    @property
    def nut(self) -> Nut:
        """The nut of the screw."""
        return self.screw.nut

    @property
    def by_section(self) -> dict[str, Any]:
        """The parts with fields that can be varied."""
        return {"screw": self.screw, "lubricant": self.lubricant, "model": self.model, "nut": self.nut}

    @functools.cached_property
    def inputs(self) -> Mapping[str, tuple[str, Quantity]]:
        """Everything that can be varied."""
        return inputs_of(self.model, self.screw, self.lubricant)

    @property
    def balls(self) -> int:
        """Number of balls solved for at each point."""
        if not self.nut.one_by_one:
            return 1
        return self.nut.halves * int(np.max(self.screw.carrying_balls))

    def at(self, points: Mapping[str, Any]) -> FrictionResult:
        """The friction with these values in place: numbers, arrays, or values that are being recorded."""
        changed = self.changed({name: values for name, values in points.items() if name not in OPERATION})
        operation = {name: points[name] for name in OPERATION}
        return changed.model(changed.screw, changed.lubricant, **operation)

    def under(self, loads: BallLoads, points: Mapping[str, Any]) -> FrictionResult:
        """The friction under loads of the balls that are known, with these values in place."""
        bare = dataclasses.replace(self.nut, bodies=None, deviations=None)  # whose loads these are
        here = Configuration(self.model, dataclasses.replace(self.screw, nut=bare), self.lubricant)
        here = here.changed({name: values for name, values in points.items() if name not in OPERATION})
        state = OperatingState(*(points[name] for name in OPERATION))
        return here.model.under(loads, here.screw, here.lubricant, state)

    def changed(self, values: Mapping[str, Any]) -> Configuration:
        """The subject with other values of some inputs, those of the operating point left aside."""
        if not values:
            return self
        parts = self.by_section
        where = {name: part for name, (part, _) in self.inputs.items()}
        of_oil = {name: value for name, value in values.items() if where[name] == "lubricant"}
        parts["lubricant"] = self.lubricant.changed(of_oil)
        for name, value in values.items():
            if name in of_oil:
                continue
            part = parts[where[name]]
            if where[name] == "nut":
                parts["nut"] = part.changed(name, value)
                continue
            law, _, field = name.rpartition(".")
            change = {field: value} if not law else {law: dataclasses.replace(getattr(part, law), **{field: value})}
            parts[where[name]] = dataclasses.replace(part, **change)
        screw = parts["screw"] if parts["nut"] is self.nut else dataclasses.replace(parts["screw"], nut=parts["nut"])
        return Configuration(parts["model"], screw, parts["lubricant"])

    def value_of(self, name: str) -> Any:
        """The value an input has where it is not varied."""
        return read_input(self.by_section[self.inputs[name][0]], name)

    def is_nonnegative(self, name: str) -> bool:
        """True for an input that may not be negative."""
        info = self.inputs[name][1].info
        lowest = info.at_least if info.above is None else info.above
        return lowest is not None and lowest >= 0

    def recorded(self, tape: Tape, points: Mapping[str, Any], wanted: Mapping[str, Output]) -> Program:
        """The outputs wanted as a program of the inputs of a tape, at points that are made of them.

        Raises :class:`~ballscrew.compiler.tracing.tape.CannotRecordError` for a nut whose balls differ, and for a law
        that wants plain arrays.
        """
        with self.recording():
            result = self.at(points)
            return merged_program(tape, {name: output.read(result) for name, output in wanted.items()})

    @contextlib.contextmanager
    def recording(self, *, by_ball: bool = False) -> Generator[None]:
        """Turn every way in which a law fails to be recorded into one error that says which law, and why.

        What a law raises for another reason is raised as it is. Balls that differ are recorded ``by_ball`` only
        (:mod:`ballscrew.engine.evaluation.by_ball`).
        """
        if self.nut.one_by_one and not by_ball:
            raise CannotRecordError("balls that differ are solved one by one, on plain arrays")
        for slot in SLOTS:
            if not traits_of(getattr(self.model, slot)).recordable:
                raise CannotRecordError(f"the law model.{slot} declares that it wants plain arrays")
        try:
            with np.errstate(all="ignore"):
                yield
        except Exception as error:  # raised again unless the recording is its cause
            why = why_not_recorded(error)
            if why is None:
                raise
            raise CannotRecordError("; ".join([str(why), *getattr(error, "__notes__", ())])) from error

    def implausible(self, points: Mapping[str, Any]) -> list[Record]:
        """A warning for each input that no ball screw has, with these values of some inputs in place.

        Of arrays the least and the greatest element count.
        """
        ends = {name: np.array([np.min(values), np.max(values)]) for name, values in points.items()}
        there = self.changed({name: values for name, values in ends.items() if name not in OPERATION})
        operation = OperatingState(*(ends.get(name, 0.0) for name in OPERATION))
        return implausible(named_parts(there.model, there.screw, there.lubricant, operation=operation))

    def starvation(self, points: Mapping[str, Any], remark: str | None = None) -> list[Record]:
        """The record of points, arrays of one length, that are starved of oil, with both torques where it is most so.

        The torques are asked for at all points where oil that comes back late counts. Where these are too many balls
        to solve for, some are taken that stand for all by the share of oil that is left, the least among them.
        """
        every = {name: np.atleast_1d(np.asarray(values, dtype=float)) for name, values in points.items()}
        there = self.changed({name: values for name, values in every.items() if name not in OPERATION})
        left = validity.replenished(there.model, there.screw, there.lubricant, every["screw_speed"])
        left = np.broadcast_to(left, every["screw_speed"].shape)
        places = np.flatnonzero(left < validity.NEARLY_ALL)
        most = max(_MOST_BALLS // self.balls, _JUDGED)
        if places.size > most:
            some = np.linspace(0, places.size - 1, most).astype(int)
            places = places[np.argsort(left[places], kind="stable")][some]
        torques: list[tuple[float, float]] = []
        for first in range(0, places.size, _AT_ONCE):
            result = self.at({name: values[places[first : first + _AT_ONCE]] for name, values in every.items()})
            both = validity.most_starved(result.screw_torque, result.flooded_torque)
            torques += [] if both is None else [both]
        most_of_all = validity.most_starved(*np.transpose(torques)) if torques else None
        return [] if most_of_all is None else _starvation_record(*most_of_all, remark)

    def attributes(self, varied: Sequence[str] = ()) -> dict[str, Any]:
        """Attributes of a dataset: constant inputs, sources, and the version."""
        fixed: dict[str, Any] = {
            f"{part}_{name.replace('.', '_')}": value
            for name, (part, _) in self.inputs.items()
            if part not in ("operation", "nut") and name not in varied and (value := self.value_of(name)) is not None
        }
        fixed |= self._attributes_of_nut(varied)
        slots = {field.name: getattr(self.model, field.name) for field in dataclasses.fields(self.model)}
        fixed |= {f"model_{slot}": law.__name__ for slot, law in slots.items() if hasattr(law, "__name__")}
        return {
            "title": f"Ball screw friction, model {self.model.label}",
            "Conventions": "CF-1.11",
            "source": f"ballscrew {__version__}, model {self.model.label}",
            "references": "; ".join(citations_of(self.model)),
            **{name: value for name, value in fixed.items() if np.ndim(value) == 0},
        }

    def _attributes_of_nut(self, varied: Sequence[str]) -> dict[str, Any]:
        """The kind of the nut, its own numbers, and those of its parts."""
        parts = named_parts(self.model, self.screw, self.lubricant)
        values: dict[str, Any] = {} if self.nut.is_row else {"nut_kind": type(self.nut).__name__}
        values |= {f"nut_{name}": "true" for name in ("spacer_balls", "set_at_rest") if getattr(self.nut, name)}
        for section in self.nut.parts:
            for name in fields_of(parts[section]):
                if not {name, f"{section}.{name}"} & set(varied):
                    values[f"{section.replace('.', '_')}_{name}"] = getattr(parts[section], name)
        return {name: value for name, value in values.items() if value is not None}


@dataclasses.dataclass(frozen=True, eq=False)
class Plan:
    """A subject, the axes to vary as labelled arrays, and the names of the outputs; can be sent to other processes."""

    subject: Configuration
    axes: Mapping[str, xr.DataArray]
    sizes: Mapping[str, int]
    outputs: tuple[str, ...]
    #: False where values may lie beyond the bounds of their inputs.
    bounded: bool = dataclasses.field(default=True, kw_only=True)

    @classmethod
    def of(
        cls,
        subject: Configuration,
        outputs: Sequence[str] | None,
        varied: Mapping[str, Any],
        section: str = "sweep",
        *,
        later: bool = False,
    ) -> Plan:
        """A plan from what a person gives; with ``later``, long axes are left to be checked where they are read.

        Raises :class:`~ballscrew.basis.errors.InputError` with all faults in it, which stand under ``section``.
        """
        names = _wanted(section, outputs, subject.nut)
        axes, extremes = _axes(section, subject, varied, later=later)
        plan = cls(subject, axes, _sizes(section, axes, names), names)
        # cached properties, which a plan with other axes finds anew
        vars(plan).update(extremes=extremes, unchecked=[name for name in axes if name not in extremes])
        if len(plan.sizes) > 1:  # of a grid, an axis is read many times
            plan.check({name: ends(axes[name].to_numpy()) for name in plan.unchecked})
        return plan

    def __reduce__(self) -> tuple[Any, ...]:
        """Fields that other processes need."""
        made = functools.partial(Plan, bounded=self.bounded)
        return made, (self.subject, dict(self.axes), dict(self.sizes), self.outputs)

    @functools.cached_property
    def unchecked(self) -> Sequence[str]:
        """The inputs whose values are to be checked where they are read."""
        return ()

    def check(self, values: Mapping[str, np.ndarray]) -> None:
        """Check what is unchecked by the ends of its values. Raises :class:`~ballscrew.basis.errors.InputError`."""
        known = self.subject.inputs
        checked = [faults_of_axis(*known[name], self.axes[name].to_numpy(), held) for name, held in values.items()]
        raise_if_any([fault for faults in checked for fault in faults])
        vars(self).update(extremes={**self.extremes, **values}, unchecked=())

    @functools.cached_property
    def extremes(self) -> Mapping[str, np.ndarray]:
        """The least and the greatest value of each input."""
        return {name: ends(axis.to_numpy()) for name, axis in self.axes.items()}

    @functools.cached_property
    def wanted(self) -> dict[str, Output]:
        """The outputs, and how to read them off a result."""
        known = known_outputs(self.subject.nut)
        return {name: known[name] for name in self.outputs}

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of the dimensions."""
        return tuple(self.sizes.values())

    @property
    def total(self) -> int:
        """The number of points."""
        return math.prod(self.shape)

    @property
    def varying(self) -> list[str]:
        """The inputs that are not the same at all points."""
        return [name for name, axis in self.axes.items() if axis.dims]

    @property
    def fixed(self) -> dict[str, Any]:
        """The inputs that are the same at all points, as numbers."""
        varying = self.varying
        return {name: axis.to_numpy()[()] for name, axis in self.axes.items() if name not in varying}

    def recorded(self, groups: Sequence[int] | None = None) -> Program:
        """The model as a program of the varying inputs, in groups where asked for.

        Raises :class:`~ballscrew.compiler.tracing.tape.CannotRecordError` where it cannot be recorded.
        """
        tape = self.tape(groups)
        return self.subject.recorded(tape, self.fixed | self.traced(tape), self.wanted)

    def tape(self, groups: Sequence[int] | None = None) -> Tape:
        """A tape with the varying inputs."""
        varying = self.varying
        return Tape(len(varying), groups, [self.bounded and self.subject.is_nonnegative(name) for name in varying])

    def traced(self, tape: Tape) -> dict[str, Any]:
        """The varying inputs as values on a tape."""
        return {name: tape.value(i) for i, name in enumerate(self.varying)}

    def points(self, block: slice) -> dict[str, Any]:
        """The values of the varying inputs at the points of one block of the flattened grid."""
        if len(self.sizes) == 1:
            values = {name: self.axes[name].to_numpy() for name in self.varying}
            return {name: value[block] if value.ndim else value[()] for name, value in values.items()}
        return self.points_at(np.arange(block.start, block.stop))

    def points_at(self, places: np.ndarray) -> dict[str, Any]:
        """The values of the varying inputs at some places of the flattened grid."""
        indices = dict(zip(self.sizes, np.unravel_index(places, self.shape), strict=True)) if self.sizes else {}
        axes = self.axes
        return {n: axes[n].to_numpy()[tuple(indices[str(d)] for d in axes[n].dims)] for n in self.varying}

    def coordinates(self) -> dict[str, Any]:
        """The axes as coordinates of a dataset, with the labels they came with."""
        known = self.subject.inputs
        result: dict[str, Any] = {
            str(label): values
            for axis in self.axes.values()
            for label, values in axis.coords.items()
            if label in axis.dims and label not in self.axes
        }
        return result | {n: (axis.dims, axis.to_numpy(), attributes_of(known[n][1])) for n, axis in self.axes.items()}

    @functools.cached_property
    def starved_torques(self) -> tuple[float, float] | None:
        """Friction torque as the inlet is given and in a full bath of oil, N m, where they differ the most.

        Of all points where they are few, or else of the corners of the grid and of some spread evenly over it; None
        where the torques hardly differ at any of these.
        """
        if self._least_replenished >= validity.NEARLY_ALL:
            return None
        result = self.subject.at({**self.fixed, **self.points_at(self._some_places)})
        return validity.most_starved(result.screw_torque, result.flooded_torque)

    @property
    def _least_replenished(self) -> float:
        """Least share of the rolling force that oil coming back late leaves over, by the ends of the inputs."""
        known = self.subject.inputs
        of_oil = {
            name: np.unique(values)
            for name, values in self.extremes.items()
            if known[name][0] in ("screw", "lubricant") or name == _REPLENISHMENT
        }
        if math.prod(values.size for values in of_oil.values()) > _MOST_CORNERS:
            return 0.0
        corners = [corner.reshape(-1) for corner in np.meshgrid(*of_oil.values(), indexing="ij")]
        there = self.subject.changed(dict(zip(of_oil, corners, strict=True)))
        fastest = float(np.max(np.abs(self.extremes["screw_speed"])))
        return validity.least_replenished(there.model, there.screw, there.lubricant, fastest)

    @property
    def _some_places(self) -> np.ndarray:
        """Places of the flattened grid: all of a few, or its corners, unless they are many, and some spread evenly."""
        if self.total * self.subject.balls <= _FEW_BALLS:
            return np.arange(self.total)
        corners = np.zeros(1, dtype=int)
        if 2 ** len(self.shape) <= _JUDGED:
            first_and_last = np.meshgrid(*([0, size - 1] for size in self.shape), indexing="ij")
            indices = [index.reshape(-1) for index in first_and_last]
            corners = np.ravel_multi_index(indices, self.shape) if indices else corners
        spread = np.floor(np.arange(1, _JUDGED + 1) * _GOLDEN % 1 * self.total).astype(int)
        return np.unique([*corners, *spread])

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes of the dataset: those of the subject, what is implausible, and the torque of a full bath of oil.

        Both torques are those of :attr:`starved_torques`; they are left out where nothing is starved.
        """
        starved = self.starved_torques
        # so many digits, as a store has to have the same ones on another machine
        both = {} if starved is None else {n: float(f"{v:.6g}") for n, v in zip(STARVED, starved, strict=True)}
        records = [*self.subject.implausible(self.extremes), *starvation_of(both)]
        said = "; ".join(f"{record.name}: {record.text}" for record in records)
        return self.subject.attributes(list(self.axes)) | both | ({"warnings": said} if said else {})

    def dataset(self, results: Mapping[str, np.ndarray]) -> xr.Dataset:
        """The results with names, units and sources."""
        variables = {
            name: (tuple(self.sizes), values.reshape(self.shape), attributes_of(self.wanted[name].quantity))
            for name, values in results.items()
            if name not in self.axes  # what is varied is there as a coordinate
        }
        return xr.Dataset(variables, self.coordinates(), self.attributes)


def starvation_of(attributes: Mapping[str, Any]) -> list[Record]:
    """The record of a dataset some of whose points are starved of oil, by its attributes; empty where none is."""
    if any(name not in attributes for name in STARVED):
        return []
    given, flooded = (float(attributes[name]) for name in STARVED)
    return _starvation_record(given, flooded, _OF_POINTS)


def _starvation_record(given: float, flooded: float, remark: str | None) -> list[Record]:
    torque = quantities_of(FrictionResult)["screw_torque"]
    return validity.records([validity.BothTorques(torque, given, flooded)], remark)


def _wanted(section: str, names: Sequence[str] | None, nut: Nut) -> tuple[str, ...]:
    known = known_outputs(nut)
    usual = DEFAULT_OUTPUTS if nut.is_row else NUT_OUTPUTS
    names = (names,) if isinstance(names, str) else usual if names is None or not len(names) else names
    chosen = [str(name).replace(".", "_") for name in names]
    raise_if_any(
        [Fault(f"{section}.outputs", "unknown output", n, nearest(n, known)) for n in chosen if n not in known]
    )
    return tuple(dict.fromkeys(chosen))


def _axes(
    section: str, subject: Configuration, varied: Mapping[str, Any], *, later: bool
) -> tuple[dict[str, xr.DataArray], dict[str, np.ndarray]]:
    """The values to vary as labelled arrays, and the ends of those that are looked at now; all faults in them."""
    known = subject.inputs
    parts = subject.by_section
    faults = [
        Fault(f"{section}.{name}", "unknown name", "", nearest(name, known)) for name in varied if name not in known
    ]
    faults += [Fault(f"{section}.{name}", MISSING, "", f"give {name}=[…]") for name in OPERATION if name not in varied]
    faults += [
        Fault(f"{part}.{name}", "is an array", "", f"give it to the sweep: {name}=[…]")
        for name, (part, _) in known.items()
        if part != "operation" and name not in varied and np.ndim(read_input(parts[part], name))
    ]
    axes: dict[str, xr.DataArray] = {}
    extremes: dict[str, np.ndarray] = {}
    for name, values in varied.items():
        if name in known:
            part, quantity = known[name]
            axis = axis_of(section, name, values, quantity)
            if isinstance(axis, Fault):
                faults.append(axis)
            else:
                axes[name] = axis
                if later and axis.ndim == 1 and axis.size > LONG_AXIS and not quantity.info.whole:
                    continue
                extremes[name] = ends(axis.to_numpy())
                faults += faults_of_axis(part, quantity, axis.to_numpy(), extremes[name])
    raise_if_any(faults)
    return axes, extremes


def _sizes(section: str, axes: Mapping[str, xr.DataArray], wanted: Sequence[str]) -> dict[str, int]:
    """The dimensions of a sweep and their lengths, in the order given."""
    sizes: dict[str, int] = {}
    known: dict[str, np.ndarray] = {}
    faults: list[Fault] = []
    for axis in axes.values():
        for dimension, size in zip(map(str, axis.dims), axis.shape, strict=True):
            where = f"{section}.{dimension}"
            if sizes.setdefault(dimension, size) != size:
                faults.append(Fault(where, "different lengths", f"{sizes[dimension]} and {size}", "make them equal"))
            labels = axis.coords[dimension].to_numpy() if dimension in axis.coords else None
            if labels is not None and not np.array_equal(known.setdefault(dimension, labels), labels):
                faults.append(Fault(where, "has other labels in another input", "", "align them: xarray.align"))
            if axes[dimension].dims != (dimension,) if dimension in axes else dimension in wanted:
                faults.append(Fault(where, "is a dimension and something else", "", "name the dimension otherwise"))
    raise_if_any(faults)
    return sizes


def read_input(part: Any, name: str) -> Any:
    """A field of a part, or ``law.field`` of one of its laws or materials."""
    if isinstance(part, NutParts | Lubricant):
        return part.value_of(name)
    law, _, field = name.rpartition(".")
    return getattr(getattr(part, law) if law else part, field)
