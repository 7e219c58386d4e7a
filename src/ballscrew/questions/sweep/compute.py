"""Sweeps of a case: axes and outputs from text, checked before anything is computed, and the dataset."""

from __future__ import annotations

import contextlib
import dataclasses
import importlib.util
import logging
import math
import re
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError, either, fault_of, nearest, overflow_as_input_error, raise_if_any
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.case_schema import name_of_law
from ballscrew.engine.evaluation.outputs import (
    DEFAULT_OUTPUTS,
    NUT_OUTPUTS,
    OPERATION,
    attributes_of,
    inputs_of,
    known_outputs,
)
from ballscrew.engine.evaluation.plan import STARVED, Configuration, starvation_of
from ballscrew.engine.evaluation.plan import Plan as Swept
from ballscrew.engine.evaluation.recordings import FEW_POINTS
from ballscrew.engine.sweeps import sweep as sweeps
from ballscrew.engine.sweeps.cluster import cluster_client, stream
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.engine.uncertainty.bands import ENDS
from ballscrew.physics.components.oil_grades import TEMPERATURE, nominal_oil
from ballscrew.physics.friction.model import coefficients
from ballscrew.physics.friction.validity import NUT_REASONS, REASONS
from ballscrew.physics.laws.traits import traits_of

#: A range as people write it in prose: ``10-100 rpm``, ``10 to 100 rpm``, ``10..100 rpm``.
_FROM_TO = re.compile(
    r"(?P<start>[-+]?\d+(?:\.\d+)?)\s*(?:-|–|—|…|\.{2,3}|to|bis)\s*(?P<stop>\d+(?:\.\d+)?)\s*(?P<unit>1\s*/.*|[^\d\s.].*)?"
)
_RANGE = re.compile(r"(?P<start>[^:]+):(?P<stop>[^:]+):\s*(?P<count>\d{1,18})\s*(?P<unit>1\s*/.*|[^\d\s.].*)?")
_TORQUE = "screw_torque"
_SECTIONS = ("operation", "screw", "lubricant", "model", "nut")
#: A folder that is filled block by block, so that a sweep need not fit into memory.
STORE = ".zarr"
#: What each kind of file needs beyond the core, and what to install for it.
_NEEDS = {".csv": (), ".xlsx": ("xlsxwriter",), ".nc": ("h5netcdf", "h5py"), STORE: ("zarr",)}
#: A worksheet ends here; larger sweeps belong into NetCDF.
_XLSX_ROWS = 1_048_576
_XLSX_COLUMNS = 16_384
_LONGEST_AXIS = 10_000_000
#: What of an oil of a grade depends on its temperature.
OF_TEMPERATURE = ("viscosity", "pressure_viscosity_coefficient", "temperature_coefficient")
#: The torque in a full bath of oil, which stands beside that of the screw, with its value alone where there are bands.
FLOODED = "flooded_torque"
#: Above this, a sweep in memory is refused.
MOST_VALUES = 200_000_000


@dataclasses.dataclass(frozen=True, eq=False)
class Plan:
    """Axes in SI by field, and the outputs wanted."""

    axes: Mapping[str, np.ndarray]
    outputs: tuple[str, ...]
    quantities: Mapping[str, Quantity]
    #: SI units of the inputs, by section_field.
    units: Mapping[str, str]
    #: Whether each point is taken at the temperature and preload in which it ends.
    heats: bool = False
    #: Whether each output has the ends of its band beside it.
    banded: bool = False

    @property
    def is_table(self) -> bool:
        """One output over two axes reads best as a table."""
        return len(self.axes) == 2 and len(self.outputs) == 1 and not self.banded

    @property
    def columns(self) -> tuple[str, ...]:
        """The outputs wanted, with the ends of their bands where they have one, and whether a point is valid."""
        every = [column for name in self.outputs for column in (name, *self.ends_of(name))]
        return tuple(dict.fromkeys((*every, "valid")))

    def ends_of(self, name: str) -> tuple[str, ...]:
        """The names of the ends of the band of an output; none without a band."""
        return tuple(f"{name}_{end}" for end in ENDS) if self.banded and name != FLOODED else ()


def plan(
    case: Case,
    vary: Sequence[str],
    wanted: Sequence[str],
    to: Path | None,
    *,
    heats: bool = False,
    banded: bool = False,
) -> Plan:
    """Plan of a sweep, of one that ``heats`` itself with what the heat does, of a ``banded`` one with bands.

    Raises :class:`~ballscrew.basis.errors.InputError` before anything is computed.
    """
    known = dict(inputs_of(case.model, case.screw, case.lubricant))
    axes, faults = _axes(case, vary, known)
    heat: Mapping[str, Quantity] = _heat() if heats else {}
    asked = _Asked(
        case=case,
        axes=axes,
        outputs=_outputs(case, wanted, tuple(heat), is_shown=to is None and len(axes) == 2, banded=banded),
        possible={**{name: output.quantity for name, output in known_outputs(case.screw.nut).items()}, **heat},
        to=to,
        heats=heats,
        banded=banded,
    )
    faults += [*_faults_of_outputs(asked), *_faults_of_axes(asked), *_faults_of_size(asked)]
    faults += _file_faults(to, [len(values) for values in axes.values()])
    if faults:
        raise InputError(*faults)
    if to is not None and not is_store(to):
        check_writable("--to", to)
    quantities = {name: quantity for name, (_, quantity) in known.items()}
    quantities |= {name: asked.possible[name] for name in (*asked.outputs, "valid")}
    result = Plan(axes, asked.outputs, quantities, _units_of(known), heats, banded)
    ends = {
        end: dataclasses.replace(quantities[name], name=end) for name in asked.outputs for end in result.ends_of(name)
    }
    return dataclasses.replace(result, quantities=quantities | ends)


@dataclasses.dataclass(frozen=True, eq=False)
class _Asked:
    """Axes in SI, outputs and a file as they are asked for, of which not all need be possible."""

    case: Case
    axes: Mapping[str, np.ndarray]
    outputs: tuple[str, ...]
    #: The outputs that there are.
    possible: Mapping[str, Quantity]
    to: Path | None
    heats: bool
    banded: bool


def _axes(
    case: Case, vary: Sequence[str], known: Mapping[str, tuple[str, Quantity]]
) -> tuple[dict[str, np.ndarray], list[Fault]]:
    """The axes of the command line, or else of the case, or else the usual ones, and the faults of the others.

    The usual ones are load and speed from a tenth on.
    """
    if not vary and not case.sweep:
        return {name: np.linspace(0.1, 1.0, 10) * (getattr(case.operation, name) or 1.0) for name in OPERATION}, []
    axes: dict[str, np.ndarray] = {}
    texts, faults = _texts(vary) if vary else (case.sweep, [])
    for written, text in texts.items():
        section, name = _split(written)
        if name not in known or section not in ("", known[name][0]):
            faults.append(_unknown_field(written, section, name, known))
            continue
        if name in axes:
            faults.append(Fault(f"sweep.{written}", "is given twice", "", "give each field once"))
            continue
        values = _axis(f"sweep.{name}", text, known[name][1])
        if isinstance(values, Fault):
            faults.append(values)
        else:
            axes[name] = values
    return axes, faults


def _unknown_field(written: str, section: str, name: str, known: Iterable[str]) -> Fault:
    """The fault of an axis that is no input of the case."""
    remedy = nearest(name, known)
    if name == "temperature" and section in ("", "lubricant"):
        remedy = 'give the oil by its data sheet or its grade, such as grade = "ISO VG 100", or vary the viscosity'
    return Fault(f"sweep.{written}", "unknown field", "", remedy)


def _outputs(
    case: Case, wanted: Sequence[str], heat: tuple[str, ...], *, is_shown: bool, banded: bool
) -> tuple[str, ...]:
    """The outputs wanted, or else the usual ones: of a table that ``is_shown`` the efficiency alone."""
    if wanted:
        return tuple(name.replace(".", "_") for name in wanted)
    if banded:
        return BAND_OUTPUTS
    if is_shown:
        return ("efficiency",)
    return (*(DEFAULT_OUTPUTS if case.screw.nut.is_row else NUT_OUTPUTS), *heat)


def _faults_of_outputs(asked: _Asked) -> list[Fault]:
    """The faults of outputs: in a store, without a band, unknown, or varied."""
    faults: list[Fault] = []
    outputs, possible = asked.outputs, asked.possible
    if asked.heats and is_store(asked.to):
        faults.append(Fault("--self-heating", "fills no store", str(asked.to), "write .nc, .csv or .xlsx"))
    if asked.banded and is_store(asked.to):
        faults.append(Fault("--band", "fills no store", str(asked.to), "write .nc, .csv or .xlsx"))
    if asked.banded:
        without = [name for name in outputs if name in possible and name not in BAND_OUTPUTS]
        faults += [Fault("--output", "has no band", name, nearest(name, BAND_OUTPUTS)) for name in without]
    faults += [Fault("--output", "unknown output", n, nearest(n, possible)) for n in outputs if n not in possible]
    faults += [
        Fault("--output", "is what is varied", name, "leave it out: it is a column anyway")
        for name in outputs
        if name in asked.axes
    ]
    return faults


def _faults_of_axes(asked: _Asked) -> list[Fault]:
    """The faults of axes that change nothing in this case, or that contradict another axis."""
    faults: list[Fault] = []
    case, axes = asked.case, asked.axes
    if "ball_to_ball_force" in axes and not traits_of(case.model.ball_force).uses_imposed_force:
        law = case.model.ball_force
        names = either(f"ball_force.{name}" for name in coefficients(law)) if coefficients(law) else None
        remedy = "leave it out" if names is None else f"vary {names}"
        problem = f'does not count with ball_force = "{name_of_law("ball_force", law)}"'
        faults.append(Fault("sweep.ball_to_ball_force", problem, "", remedy))
    of_temperature = [name for name in OF_TEMPERATURE if "temperature" in axes and name in axes]
    faults += [Fault(f"sweep.{n}", "goes with the temperature", "", "vary one of the two") for n in of_temperature]
    if "loaded_balls" in axes and case.nut is not None and case.nut.one_by_one:
        remedy = "leave out [bodies] and [deviations]"
        faults.append(Fault("sweep.loaded_balls", "cannot be varied where balls differ", "", remedy))
    return faults


def _faults_of_size(asked: _Asked) -> list[Fault]:
    """The fault of a sweep that does not fit into memory."""
    size = math.prod(len(values) for values in asked.axes.values())
    if size * len(asked.outputs) * (1 + asked.banded * len(ENDS)) <= MOST_VALUES or is_store(asked.to):
        return []
    remedy = "take fewer values an axis, or fewer outputs, or write to a folder: --to map.zarr"
    return [Fault("sweep", "too many values", f"{size:,} points", remedy)]


def _units_of(known: Mapping[str, tuple[str, Quantity]]) -> dict[str, str]:
    """The SI units of the inputs by section_field, with those of starved torques."""
    si = {f"{part}_{name.replace('.', '_')}": quantity.unit for name, (part, quantity) in known.items()}
    return si | dict.fromkeys(STARVED, "N m")


def _heat() -> Mapping[str, Quantity]:
    """Quantities of the heat at each point."""
    from ballscrew.axis.thermal.warm_sweep import HEAT  # for those only who ask

    return HEAT


def _split(written: str) -> tuple[str, str]:
    """Section and field: ``operation.axial_load`` and ``axial_load`` are the same axis."""
    section, dot, name = written.partition(".")
    return (section, name) if dot and section in _SECTIONS else ("", written)


def _texts(vary: Sequence[str]) -> tuple[dict[str, str], list[Fault]]:
    """The ``field=values`` of the command line, and the faults of those that are none."""
    texts: dict[str, str] = {}
    faults: list[Fault] = []
    for axis in vary:
        name, equals, text = (part.strip() for part in axis.partition("="))
        if not equals:
            faults.append(Fault("--vary", "is not field=values", axis, 'write axial_load="100:4000:14 N"'))
        elif name in texts:
            faults.append(Fault("--vary", "is given twice", name, "give each field once"))
        else:
            texts[name] = text
    return texts, faults


def is_store(to: Path | None) -> bool:
    """True for a sweep that goes to a store on disk block by block."""
    return to is not None and to.suffix.lower() == STORE


def _file_faults(to: Path | None, lengths: Sequence[int]) -> list[Fault]:
    """The faults of a file that is to be written."""
    if to is None:
        return []
    kind = to.suffix.lower()
    if kind not in _NEEDS:
        return [Fault("--to", "unknown kind of file", str(to), "end it in .csv, .xlsx, .nc or .zarr")]
    missing = [name for name in _NEEDS[kind] if importlib.util.find_spec(name) is None]
    if missing:
        return [Fault("--to", f"needs {' and '.join(missing)}", str(to), 'pip install "ballscrew[data]"')]
    too_wide = len(lengths) == 2 and lengths[1] >= _XLSX_COLUMNS
    if kind == ".xlsx" and (math.prod(lengths) >= _XLSX_ROWS or too_wide):
        return [Fault("--to", "too large for a worksheet", " x ".join(map(str, lengths)), "write .nc or .csv")]
    return []


def length_of(text: str) -> int:
    """Number of values of an axis, from its text."""
    span = _RANGE.fullmatch(text.strip().strip("\"'"))
    return int(span["count"]) if span else text.count(",") + 1


def _axis(where: str, text: str, quantity: Quantity) -> np.ndarray | Fault:
    """``"100:4000:14 N"`` (start:stop:count) or ``"100, 200, 500 N"`` in SI, or the first fault in it."""
    text = text.strip().strip("\"'")
    span = _RANGE.fullmatch(text)
    values = _fault_of_range(where, text, quantity) or _values_in(where, text, quantity)
    if isinstance(values, Fault) or span is None:
        return values
    if not 1 <= int(span["count"]) <= _LONGEST_AXIS:
        return Fault(
            where,
            "bad number of values",
            span["count"],
            f"start:stop:count, count from 1 to {units.grouped(_LONGEST_AXIS)}",
        )
    numbers = np.linspace(values[0], values[1], int(span["count"]))
    if quantity.info.whole and np.any(numbers % 1):
        return Fault(where, "must be whole numbers", text, "choose a count that gives whole steps, or list them")
    return numbers


def _fault_of_range(where: str, text: str, quantity: Quantity) -> Fault | None:
    """The fault of a range that is written otherwise than start:stop:count, or without its unit."""
    span = _RANGE.fullmatch(text)
    if span is None and (ends := _FROM_TO.fullmatch(text)):
        unit = f" {ends['unit']}" if ends["unit"] else _blank_unit(quantity)
        remedy = f'write "{ends["start"]}:{ends["stop"]}:5{unit}" for five values, ends included'
        return Fault(where, "is not start:stop:count", text, remedy)
    if span is None and ":" in text:
        return Fault(
            where,
            "is not start:stop:count",
            text,
            f'write "1:10:4{_blank_unit(quantity)}", count a whole number',
        )
    if span and quantity.unit != "1" and not span["unit"]:
        return Fault(where, "needs a unit", text, f'write "{text} {quantity.shown_in}"')
    return None


def _values_in(where: str, text: str, quantity: Quantity) -> np.ndarray | Fault:
    """The two ends of a range, or the values of a list, in SI; the first fault in them."""
    span = _RANGE.fullmatch(text)
    if span:
        items, unit = [span["start"], span["stop"]], span["unit"] or ""
    else:
        items = text.split(",")
        unit = units.unit_in(items[-1])
    # the unit after the last value counts for all; one may still carry its own
    values = [units.parse(where, item if units.unit_in(item) else f"{item} {unit}".strip(), quantity) for item in items]
    for value in values:
        fault = value if isinstance(value, Fault) else fault_of("sweep", quantity, value)
        if fault is not None:
            return units.in_display_units(fault, quantity, fault.given if fault is value else text)
    return np.array([value for value in values if not isinstance(value, Fault)])


def _blank_unit(quantity: Quantity) -> str:
    return "" if quantity.unit == "1" else f" {quantity.shown_in}"


def with_flooded_torque(case: Case, plan: Plan, *, as_table: bool = False) -> Plan:
    """The plan with the torque in a full bath of oil beside that of the screw, where some of its points are starved.

    What is written ``as_table``, a single output over two axes, stays one table, and where the replenishment is varied
    the full bath is a point of its own. Where points heat themselves, each would end in another state in a full bath.
    """
    stays = plan.heats or (as_table and plan.is_table) or "inlet.replenishment_constant" in plan.axes
    if stays or _TORQUE not in plan.outputs or FLOODED in plan.outputs or not starves(case, plan):
        return plan
    return with_column_of_bath(case, plan)


def starves(case: Case, plan: Plan) -> bool:
    """Test whether some points of a plan are starved of oil."""
    return _swept(case, plan, plan.outputs).starved_torques is not None


def with_column_of_bath(case: Case, plan: Plan) -> Plan:
    """The plan with the torque in a full bath of oil right behind that of the screw."""
    outputs = tuple(column for name in plan.outputs for column in ((name, FLOODED) if name == _TORQUE else (name,)))
    quantity = known_outputs(case.screw.nut)[FLOODED].quantity
    return dataclasses.replace(plan, outputs=outputs, quantities={**plan.quantities, FLOODED: quantity})


def _swept(case: Case, plan: Plan, names: Sequence[str], *, later: bool = False) -> Swept:
    """The plan of the engine for outputs of these names."""
    subject = Configuration(case.model, case.screw, case.lubricant)
    return Swept.of(subject, tuple(names), _varied(case, plan) | unvaried(case, plan), later=later)


def _varied(case: Case, plan: Plan) -> dict[str, Any]:
    """The axes, of a temperature those of the numbers of the oil."""
    varied: dict[str, Any] = {}
    for name, values in plan.axes.items():
        varied |= _oils(case, values) if name == "temperature" else {name: values}
    return varied


@overflow_as_input_error()
def sweep(
    case: Case,
    plan: Plan,
    done: Callable[[int, int], None] | None = None,
    to: Path | None = None,
    cluster: Any = None,
    *,
    verify: bool = False,
    trust: bool = False,
) -> xr.Dataset:
    """The dataset of a plan; load and speed are those of the case where they are not varied.

    Over the lead, a speed that the case gives as that of the nut stays that of the nut.

    It also says which points are valid, and why not, whether that was asked for or not. With a
    store ``to`` it is filled first, by the workers of a ``cluster`` if there is one; ``verify`` and ``trust`` are
    those of :func:`~ballscrew.engine.sweeps.sweep.sweep`.
    """
    fixed = unvaried(case, plan)
    names = dict.fromkeys((*plan.outputs, "valid", *(f"validity_{reason}" for reason in reasons_of(case))))
    varied = _varied(case, plan)
    if plan.heats:
        from ballscrew.questions.warm_up import self_heating

        wanted = tuple(name for name in names if name not in _heat())
        return self_heating.swept(case, wanted, {**plan.axes, **fixed}, done)
    oil = {f"lubricant_{name}": value for name, value in case.origins.oil.items() if name not in plan.axes}
    if to is not None and is_store(to):
        swept = _swept(case, plan, tuple(names))
        return stream(swept, to, done=done, cluster=cluster, attributes=oil, verify=verify, trust=trust)
    if to is not None:  # files of all kinds have the same bits, whatever is compiled already
        return sweeps.in_memory(_swept(case, plan, tuple(names), later=True), done=done, recorded=True).assign_attrs(
            oil
        )
    # what is only looked at may be quicker; balls that differ count how often they are asked for
    few = math.prod(len(values) for values in plan.axes.values()) <= FEW_POINTS and not case.screw.nut.one_by_one
    dataset = sweeps.sweep(
        case.model,
        case.screw,
        case.lubricant,
        outputs=tuple(names),
        engine="model" if few else None,
        done=done,
        **varied,
        **fixed,
    )
    dataset.attrs |= oil
    return dataset


def check_store_options(to: Path | None, **given: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for options of a store where there is none."""
    remedy = "add --to map.zarr"
    without = [name for name, is_given in given.items() if is_given and not is_store(to)]
    raise_if_any([Fault(f"--{name}", "needs a store", "", remedy) for name in without])


@contextlib.contextmanager
def workers(scheduler: str | None, to: Path | None) -> Generator[Any]:
    """A client of the cluster with a scheduler at this address; None without an address."""
    if scheduler is None:
        yield None
        return
    if not is_store(to):
        remedy = "add --to map.zarr, in a folder that all workers share"
        raise InputError(Fault("--scheduler", "needs a store", scheduler, remedy))
    with cluster_client(scheduler, "--scheduler") as client:
        # what it logs of a scheduler that is gone, the command says in a line
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        yield client


def implausible(case: Case, plan: Plan) -> list[Record]:
    """A warning for each input that no ball screw has, at some point of the sweep."""
    subject = Configuration(case.model, case.screw, case.lubricant)
    there = {name: np.asarray(value) for name, value in unvaried(case, plan).items()}
    return [*subject.implausible({**there, **plan.axes}), *case.doubts]


def starved(dataset: xr.Dataset) -> list[Record]:
    """A warning where points of a sweep are starved of oil, with both torques at the one that is so the most."""
    return starvation_of(dataset.attrs)


def unvaried(case: Case, plan: Plan) -> dict[str, Any]:
    """The load and the speed that are not varied; that of a nut whose lead is varied is one for each lead."""
    values: dict[str, Any] = {name: getattr(case.operation, name) for name in OPERATION if name not in plan.axes}
    if "screw_speed" in values and "lead" in plan.axes and case.origins.speed_of_nut:
        leads = plan.axes["lead"]
        speeds = values["screw_speed"] * case.screw.lead / leads
        attributes = attributes_of(plan.quantities["lead"])
        coords = {"lead": xr.DataArray(leads, dims="lead", attrs=attributes)}
        values["screw_speed"] = xr.DataArray(speeds, coords, "lead")
    return values


def reasons_of(case: Case) -> Mapping[str, str]:
    """The reasons for which a point may not be valid, with their texts."""
    return REASONS if case.screw.nut.is_row else NUT_REASONS


def _oils(case: Case, temperatures: np.ndarray) -> dict[str, xr.DataArray]:
    """Properties of the oil at the temperatures, without those that the case gives."""
    oils, given = nominal_oil(case.lubricant.at(temperatures)), given_of_oil(case)
    own = [name for name in OF_TEMPERATURE if name not in given]
    dim, attributes = "temperature", {"units": TEMPERATURE.unit, "long_name": TEMPERATURE.info.meaning}
    coords = {dim: xr.DataArray(temperatures, dims=dim, attrs=attributes)}
    return {name: xr.DataArray(np.broadcast_to(getattr(oils, name), temperatures.shape), coords, dim) for name in own}


def given_of_oil(case: Case) -> dict[str, float]:
    """Numbers of the oil that the case gives beside its grade or its data sheet, which would say others."""
    made = nominal_oil(case.lubricant)
    own = {name: getattr(case.lubricant, name) for name in OF_TEMPERATURE}
    return {name: value for name, value in own.items() if value != getattr(made, name)}
