"""Sweeps: one model over many operating points and designs, as a labelled dataset."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import xarray as xr

from ballscrew.analyses.evaluation import Engine, Evaluation
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.analyses.plan import Plan, Subject
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew
from ballscrew.faults import Fault, raise_if_any
from ballscrew.model import FrictionModel


def sweep(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    nut: NutParts | None = None,
    outputs: Sequence[str] | None = None,
    engine: Engine | None = None,
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
    given. Only the ``outputs`` asked for are kept (see
    :func:`~ballscrew.analyses.outputs.known_outputs`; a default handful otherwise). With a ``nut`` it is a whole nut whose friction is computed, and the fields of the nut can be varied.

    Work goes block by block on a few threads, and ``done(finished, total)`` is told the progress.
    The ``engine`` is chosen by the size of the work: ``"numpy"``, or ``"compiled"``, which needs the extra ``fast``.
    Raises :class:`~ballscrew.faults.InputError` for unknown names and missing or bad values.
    """
    counts = {"block_size": block_size, "threads": threads}
    raise_if_any(
        [Fault(f"sweep.{n}", "must be 1 or more", str(v), "") for n, v in counts.items() if v is not None and v < 1]
    )
    plan = Plan.of(Subject(model, screw, lubricant, nut), outputs, varied)
    evaluation = Evaluation.of(plan, engine)
    results = evaluation.empty(plan.total)
    evaluation.fill(results, slice(0, plan.total), block_size=block_size, threads=threads, done=done)
    return plan.dataset(results)
