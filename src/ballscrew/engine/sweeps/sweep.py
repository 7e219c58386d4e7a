"""Sweeps: one model over many operating points and designs, as a labelled dataset.

Friction after a reversal is such a dataset over the angle of the screw.
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from ballscrew.basis.displayed import notebook
from ballscrew.basis.errors import Fault, InputError, accepts_units, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Quantity, Ratio, fields_of, quantities_of
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import attributes_of
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import SweepEngine
from ballscrew.engine.sweeps.cluster import stream
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.moving_balls import reversal as moving_balls

if TYPE_CHECKING:
    import distributed


def sweep(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    nut: Nut | None = None,
    outputs: Sequence[str] | None = None,
    engine: SweepEngine | None = None,
    block_size: int | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    to: str | os.PathLike[str] | None = None,
    cluster: distributed.Client | None = None,
    verify: bool = False,
    trust: bool = False,
    **varied: Any,
) -> xr.Dataset:
    """Evaluate a model over the values given, and return a dataset of them with names, units and sources.

    ``model`` is evaluated on ``screw`` with ``lubricant``. ``varied`` gives values to any field of the operating point
    (``axial_load`` and ``screw_speed`` are needed), the screw, the lubricant or the model, in SI; coefficients of laws
    as ``**{"friction.boundary_friction_coefficient": [...]}``. A sequence becomes a dimension of its own name;
    ``xarray.DataArray`` values that share a dimension vary together along it, so random points are
    ``xr.DataArray(values, dims="point")``. The dataset has the dimensions in the order given. Only the ``outputs``
    asked for are kept (see :func:`~ballscrew.engine.evaluation.outputs.known_outputs`; a default handful otherwise),
    and ``valid`` where no file is written. A ``nut`` takes the place of that of the screw; its fields are varied as
    ``**{"nut.preload": [...]}``.

    Work goes block by block on a few threads, of ``block_size`` points at most, and
    ``done(finished, total)`` reports the points.
    The ``engine`` is chosen by the size of the work: ``"numpy"``, or ``"compiled"``, which needs the extra ``fast``.
    ``"model"`` calls the model itself on all points: without recording it, which takes about a second with the
    reference model and is not paid back by a few thousand points. Engines differ by rounding.

    ``to`` names a folder for sweeps larger than the memory: a Zarr store that is filled block by
    block, two of which are in memory at a time. It needs the extra ``data``. The same call goes on
    where a run was stopped, for any reason; a store that is complete is opened at once. The values of
    the dataset are read from it when they are asked for.
    Blocks whose files are damaged are computed again, damaged metadata written again, and a warning is logged. Before
    a run goes on, sizes and checksums of finished blocks are compared; of a complete store only the sizes, and with
    ``verify`` the checksums too (:func:`~ballscrew.verify` compares and changes nothing). A folder of another user is
    refused unless ``trust``, as its owner could replace files by links; links in a store are always refused. A model
    of which it cannot be known what it computes (compiled code, a file that it reads) fills a new store only.
    With a ``cluster``, the client of a Dask scheduler, its workers evaluate the blocks and write them; they must
    see the folder ``to`` under the same path. The blocks of a lost worker are evaluated again. Each block takes
    one thread unless ``threads`` says otherwise. It needs the extra ``cluster``.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names and missing or bad values, and for
    a folder that holds something else or that another process writes into; and
    :class:`~ballscrew.engine.sweeps.store.UnfinishedSweepError` when the disk is full or the cluster is lost.
    """
    counts = {"block_size": block_size, "threads": threads}
    raise_if_any(
        [Fault(f"sweep.{n}", "must be 1 or more", str(v), "") for n, v in counts.items() if v is not None and v < 1]
    )
    if cluster is not None and to is None:
        remedy = 'add to="map.zarr", in a folder that all workers share'
        raise InputError(Fault("sweep.cluster", "needs a store", "", remedy))
    screw = screw if nut is None else dataclasses.replace(screw, nut=nut)
    if outputs is not None:
        outputs = (outputs,) if isinstance(outputs, str) else tuple(outputs)
        if to is None and outputs:  # a map without it looks valid everywhere
            outputs = (*outputs, "valid")
    plan = Plan.of(Configuration(model, screw, lubricant), outputs, varied, later=to is None)
    if to is not None:
        if engine == "model":
            raise InputError(Fault("sweep.engine", "fills no store", engine, 'take engine="numpy"'))
        return stream(
            plan,
            to,
            engine=engine,
            block_size=block_size,
            threads=threads,
            done=done,
            cluster=cluster,
            verify=verify,
            trust=trust,
        )
    return in_memory(plan, engine, block_size=block_size, threads=threads, done=done)


def in_memory(
    plan: Plan,
    engine: SweepEngine | None = None,
    *,
    block_size: int | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    recorded: bool = False,
) -> xr.Dataset:
    """The dataset of a plan; ``recorded`` as of :meth:`~ballscrew.engine.evaluation.evaluation.Evaluation.of`.

    Raises :class:`~ballscrew.basis.errors.InputError` for an engine that cannot be had, and for bad values of an axis
    that is checked where it is read.
    """
    evaluation = Evaluation.of(plan, engine, recorded=recorded)
    results = evaluation.empty(plan.total)
    evaluation.fill(results, slice(0, plan.total), block_size=block_size, threads=threads, done=done)
    return plan.dataset(results).assign_attrs(evaluation.attributes)


@xr.register_dataset_accessor("ballscrew")
class SweepAccessor:
    """Pictures of a sweep: ``ds.ballscrew.plot_map("screw_torque")``."""

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def plot_map(self, output: str = "screw_torque") -> Any:
        """Picture of an output over the axes of the sweep: contours over two, a line over one.

        It is hatched or shaded where the model does not hold. A notebook shows the picture; its ``save(path)`` writes
        .png, .svg or .pdf. Raises :class:`~ballscrew.basis.errors.InputError` for an unknown output, and for more axes.
        """
        return notebook("pictures").sweep_map(self._dataset, output)


#: The numbers of a reversal: over the angle, and of steady motion.
QUANTITIES: Mapping[str, Quantity] = quantities_of(moving_balls.Reversal)
#: The parts of the torque, by how they come back.
PARTS: Mapping[str, str] = {
    "rolling": "rolling resistance, at once",
    "spin_and_curvature": "spin and curvature slip, within the contacts",
    "helix": "helix slip, as balls on two contacts roll across their grooves",
    "ball_to_ball": "ball to ball and return, as the gaps close",
    moving_balls.LOSSES: "losses of the nut, at once",
}
_LENGTH = Quantity("displacement", "m", Info(r"\eta", "way of the balls off the line of their grooves", "um"))
#: Said of every dataset.
HYPOTHESIS = (
    "a hypothesis: that helix slip comes back over degrees of the screw follows from the contacts, "
    "and no measured ball screw shows it by itself"
)


@accepts_units("reversal")
def reversal(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    travel: Length | None = None,
    from_rest: bool = False,
    gap: Ratio = moving_balls.GAP,
) -> xr.Dataset:
    """Friction torque over the angle of the screw after it has turned round, by mechanism.

    ``model``, ``screw`` and ``lubricant`` are those of a steady point under an ``axial_load`` (N) at a ``screw_speed``
    (rad/s); the curve goes from minus the steady torque to plus it, or ``from_rest`` from zero, over a ``travel`` (m)
    of the nut; without it until nothing changes any more. The ``gap`` of each circuit, in balls, closes before they
    press on each other again. The dataset that is returned has the coordinate ``screw_angle`` and
    the variables ``travel``, ``screw_torque``, ``contribution_…`` by mechanism, the same of steady motion
    (``steady_torque``, ``steady_contribution_…``), and the ``displacement`` of the balls of each kind off the line of
    their grooves; names, units and sources are those of a sweep.

    A hypothesis: that the helix part comes back over degrees of the screw follows from the contacts, and is not
    measured. Raises :class:`~ballscrew.basis.errors.InputError` for arrays, a speed of zero, a travel that is
    not above zero, a gap below zero, balls without load, and for a model without slip across the path.
    """
    curve = moving_balls.reversal(
        model,
        screw,
        lubricant,
        axial_load=axial_load,
        screw_speed=screw_speed,
        travel=travel,
        from_rest=from_rest,
        gap=gap,
    )
    operation = {"axial_load": axial_load, "screw_speed": screw_speed}
    return dataset_of(Configuration(model, screw, lubricant), curve, operation)


def dataset_of(subject: Configuration, curve: moving_balls.Reversal, operation: Mapping[str, Any]) -> xr.Dataset:
    """A reversal with names, units and sources, at its operating point."""
    over = ("screw_angle",)
    variables: dict[str, Any] = {
        name: (over, np.asarray(getattr(curve, name), dtype=float), attributes_of(QUANTITIES[name]))
        for name in ("travel", "screw_torque")
    }
    for mechanism, values in curve.contributions.items():
        name = f"contribution_{mechanism}"
        variables[name] = (over, np.asarray(values, dtype=float), attributes_of(contribution(mechanism)))
    variables["steady_torque"] = ((), float(curve.steady_torque), attributes_of(QUANTITIES["steady_torque"]))
    for mechanism, value in curve.steady_contributions.items():
        name = f"steady_contribution_{mechanism}"
        variables[name] = ((), float(value), attributes_of(contribution(mechanism, steady=True)))
    if curve.displacement:
        variables["displacement"] = (("kind", *over), np.array(curve.displacement), attributes_of(_LENGTH))
    fields = fields_of(OperatingState)
    coordinates: dict[str, Any] = {
        "screw_angle": (over, np.asarray(curve.screw_angle, dtype=float), attributes_of(QUANTITIES["screw_angle"]))
    }
    coordinates |= {name: ((), float(value), attributes_of(fields[name])) for name, value in operation.items()}
    records = subject.implausible(operation)
    sentences = "; ".join(f"{record.name}: {record.text}" for record in records)
    start = "from rest" if curve.from_rest else "after a reversal"
    attributes = {
        **subject.attributes(),
        "title": f"Ball screw friction {start}, model {subject.model.label}",
        "start": start,
        "comment": HYPOTHESIS,
    }
    return xr.Dataset(variables, coordinates, attributes | ({"warnings": sentences} if sentences else {}))


def contribution(mechanism: str, *, steady: bool = False) -> Quantity:
    """The part of the torque by a mechanism, over the angle or of steady motion."""
    torque = QUANTITIES["screw_torque"]
    symbol, words = f"{torque.info.symbol} ({mechanism})", PARTS.get(mechanism, mechanism)
    info = Info(symbol, f"friction torque{' of steady motion' * steady}: {words}")
    return Quantity(f"{'steady_' * steady}contribution_{mechanism}", torque.unit, info)
