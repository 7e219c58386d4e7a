"""Sweeps of a screw that warms itself: each point at the temperature and preload in which it ends."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.axis.thermal.steady_points import SteadyPoints, steady_points
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis.errors import Fault, InputError, accepts_units
from ballscrew.basis.quantities import Info, Length, Quantity
from ballscrew.engine.evaluation.outputs import attributes_of
from ballscrew.engine.evaluation.plan import STARVED, Configuration, Plan
from ballscrew.engine.sweeps.sweep import sweep
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import FrictionElement
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

#: What the heat does at each point, besides the outputs.
HEAT: Mapping[str, Quantity] = {
    "oil_temperature": Quantity("oil_temperature", "K", Info("T_o", "steady temperature of the oil", "degC")),
    "nut_temperature": Quantity("nut_temperature", "K", Info("T_n", "steady temperature of the nut", "degC")),
    "warm_preload": Quantity("warm_preload", "N", Info("F_{pr}", "preload in the steady state")),
    "shaft_growth": Quantity("shaft_growth", "m", Info(r"\Delta L", "growth of the shaft in the steady state", "um")),
    "heat_margin": Quantity("heat_margin", "1", Info("1 - g", "stability margin of the thermal loop")),
}
#: Where there is a steady state.
STEADY = "validity_steady_state"
_OF = {"warm_preload": "preload", "shaft_growth": "growth", "heat_margin": "margin"}


@accepts_units("sweep")
def warm_sweep(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    surroundings: Surroundings | None = None,
    stroke: Length,
    shaft_length: Length | None = None,
    also: Mapping[str, FrictionElement] | None = None,
    outputs: Sequence[str] | None = None,
    done: Callable[[int, int], None] | None = None,
    **varied: Any,
) -> xr.Dataset:
    """:func:`~ballscrew.engine.sweeps.sweep.sweep` with each point in its own steady state.

    ``model``, ``screw``, ``lubricant``, ``outputs`` and ``varied`` are those of a sweep. Each point goes to and fro
    over the ``stroke`` (m) under its load until it is warm (:func:`~ballscrew.axis.thermal.warm_up.steady_heat`) in
    its ``surroundings``, with what rubs on the shaft besides (``also``). ``shaft_length`` (m) is taken where the
    surroundings have none. Its results are those of the oil and the preload then; one without a steady state has none,
    and is not valid. ``done(finished, total)`` is told the points. The dataset that is returned has :data:`HEAT` beside
    the outputs.

    Raises :class:`~ballscrew.basis.errors.InputError` as ``sweep`` and ``steady_heat`` do, and for inputs that follow
    from the heat.
    """
    subject = Configuration(model, screw, lubricant)
    air = surroundings or Surroundings()
    return swept(subject, air, varied, stroke=stroke, shaft_length=shaft_length, also=also, outputs=outputs, done=done)[
        0
    ]


def swept(
    subject: Configuration,
    surroundings: Surroundings,
    varied: Mapping[str, Any],
    *,
    stroke: Length,
    shaft_length: Length | None,
    also: Mapping[str, FrictionElement] | None,
    outputs: Sequence[str] | None,
    done: Callable[[int, int], None] | None,
) -> tuple[xr.Dataset, SteadyPoints]:
    """The dataset of :func:`warm_sweep`, and the steady states of its points."""
    plan = Plan.of(subject, outputs, varied)
    flat: dict[str, Any] = {**plan.fixed, **plan.points_at(np.arange(plan.total))}
    every = {name: np.broadcast_to(np.asarray(values, dtype=float), plan.total) for name, values in flat.items()}
    result = steady_points(subject, every, surroundings, stroke=stroke, shaft_length=shaft_length, also=also, done=done)
    dims, (results, warm) = tuple(plan.sizes), _results(plan, every, result)
    numbers = {name: getattr(result, _OF.get(name, name)).reshape(plan.shape) for name in HEAT}
    dataset = plan.dataset(results).assign(
        {name: (dims, values, attributes_of(HEAT[name])) for name, values in numbers.items()}
    )
    # of the oil as warm as it becomes, and not as it is given
    kept = {name: value for name, value in dataset.attrs.items() if name not in (*STARVED, "warnings")}
    dataset.attrs = kept | {name: warm[name] for name in (*STARVED, "warnings") if name in warm}
    return dataset.assign({STEADY: (dims, result.exists.reshape(plan.shape))}), result


def _results(plan: Plan, points: Mapping[str, Any], result: SteadyPoints) -> tuple[dict[str, Any], Mapping[str, Any]]:
    """The outputs at the points that have a steady state, NaN and not valid at the others; attributes of the former."""
    known = np.flatnonzero(result.exists)
    if not known.size:
        remedy = "cool the shaft, turn slower, or preload less"
        raise InputError(
            Fault("surroundings", "no point has a steady state in the range of oil and preload", "", remedy)
        )
    subject = plan.subject
    there: dict[str, Any] = {**points, "temperature": result.oil_temperature}
    if np.any(result.preload[known] > 0):
        preload = next((name for name in ("preload", "nut.preload") if name in points), "nut.preload")
        there[preload] = result.preload
    axes: dict[str, Any] = {name: xr.DataArray(values[known], dims="point") for name, values in there.items()}
    swept = sweep(subject.model, subject.screw, subject.lubricant, outputs=plan.outputs, **axes)
    results: dict[str, Any] = {}
    for name in plan.outputs:
        values = swept[name].to_numpy()
        if values.dtype == bool:  # of what is not computed, only this is known to fail
            results[name] = np.full(plan.total, name != "valid")
        else:
            results[name] = np.full(plan.total, np.nan)
        results[name][known] = values
    return results, swept.attrs
