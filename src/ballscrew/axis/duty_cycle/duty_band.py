"""Bands of a duty: torque and energy of a cycle with uncertain inputs of the screw."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ballscrew.axis.duty_cycle.duty import PROCESS, STORED, Duty
from ballscrew.axis.duty_cycle.screw_friction import WORTH_RECORDING, ModelledScrew
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.supports.bearing import PLACES
from ballscrew.axis.supports.element_laws import UNCERTAIN
from ballscrew.basis.errors import Fault, InputError, raise_if_any, renamed_keyword
from ballscrew.engine.evaluation.evaluator import evaluator
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.band_evaluation import faults_of_inputs, faults_of_options
from ballscrew.engine.uncertainty.bands import Interval
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.monte_carlo import Sampler, sobol_sequence

SAMPLES = 2**12
#: Operating points that are evaluated at a time.
_AT_ONCE = 2_000_000


@dataclasses.dataclass(frozen=True, eq=False)
class NumberBand:
    """A number of a cycle with its band."""

    value: float
    median: float
    band: Interval


@dataclasses.dataclass(frozen=True, eq=False)
class DutyBand:
    """Bands of the numbers of a cycle by name: torques in N m, energies in J."""

    level: float
    count: int
    numbers: Mapping[str, NumberBand]

    def __getitem__(self, name: str) -> NumberBand:
        """The band of a number."""
        return self.numbers[name]


@renamed_keyword("uncertain", "distributions")
def duty_band(
    duty: Duty,
    *,
    distributions: Mapping[str, Distribution],
    beside: Mapping[str, Distribution] | None = None,
    samples: int = SAMPLES,
    seed: int = 0,
    level: float = 0.95,
    done: Callable[[int, int], None] | None = None,
) -> DutyBand:
    """RMS and peak torque, and energy drawn, returned and lost, for uncertain inputs of screw, nut, oil and model.

    Returns a :class:`DutyBand` of a ``duty``, with intervals that hold the share ``level`` of the ``samples``. The same
    ``seed`` gives the same bands. ``done(finished, total)`` is told the samples. ``distributions`` names inputs as
    :func:`~ballscrew.engine.sweeps.sweep.sweep` does; they are independent, the same over a cycle, and drawn from a
    Sobol' sequence. The laws are those of the model. The motion and the axis are exact. ``beside`` has distributions of
    torques and seals of the bearings, and of coefficients and seals of the guides (``bearings.fixed.torque``,
    ``guides.friction_coefficient``), with which friction goes in proportion.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, and for a screw without a model of friction.
    """
    driven = duty.driven
    if not isinstance(driven, ModelledScrew):
        raise InputError(Fault("model", "has no inputs that are uncertain", "", 'take a model such as "reference"'))
    subject = Configuration(driven.model, driven.screw, driven.lubricant)
    raise_if_any([*faults_of_options((), samples, seed, level, None), *faults_of_inputs(subject, distributions, None)])
    states = np.stack([duty.axial_load, duty.screw_speed], axis=1)
    distinct, back = np.unique(states, axis=0, return_inverse=True)
    load, speed = distinct.T
    names, others = tuple(distributions), dict(beside or {})
    ready = evaluator(
        driven.model,
        driven.screw,
        driven.lubricant,
        inputs=("axial_load", "screw_speed", *names),
        outputs=["screw_torque"],
        engine="numpy" if samples * load.size < WORTH_RECORDING else None,
    )
    number = len(names) + len(others)
    shares = sobol_sequence(number, samples, seed) if number else np.empty((0, samples))
    values = Sampler(subject, distributions, {}, ()).inputs_at(shares[: len(names)])
    drawn_beside = {
        name: one.quantile(share) for (name, one), share in zip(others.items(), shares[len(names) :], strict=True)
    }
    more = {name: friction_beside(duty, name) for name in others}
    result: dict[str, list[Numbers]] = {}
    step = max(1, _AT_ONCE // load.size)
    for start in range(0, samples, step):
        chosen = {name: drawn[start : start + step, None] for name, drawn in values.items()}
        torque = ready(axial_load=load, screw_speed=speed, **chosen)["screw_torque"]
        every = np.atleast_2d(torque)[:, back.reshape(-1)]
        for name, (central, of_unit) in more.items():
            every = every + (drawn_beside[name][start : start + step, None] - central) * of_unit
        for name, numbers in numbers_of_cycle(duty, every).items():
            result.setdefault(name, []).append(numbers)
        if done is not None:
            done(min(start + step, samples), samples)
    own = numbers_of_cycle(duty, duty.screw.torque[None, :])
    ends = ((1 - level) / 2, 0.5, (1 + level) / 2)
    bands: dict[str, NumberBand] = {}
    for name, parts in result.items():
        low, median, high = (float(q) for q in np.nanquantile(np.concatenate(parts), ends, method="inverted_cdf"))
        bands[name] = NumberBand(float(own[name][0]), median, Interval(low, high))
    return DutyBand(level, samples, bands)


def friction_beside(duty: Duty, name: str) -> tuple[float, Numbers]:
    """A number of a bearing or of the guides, and the friction torque about the shaft that one unit of it makes, N m.

    Raises :class:`~ballscrew.basis.errors.InputError` for a name that the duty has not.
    """
    section, _, field = name.rpartition(".")
    element: Any = duty.axis.guides
    if section.startswith("bearings."):
        mounted: Any = duty.also.get(PLACES.get(section.removeprefix("bearings."), ""))
        element = getattr(mounted, "element", None)
    if field not in UNCERTAIN or not hasattr(element, field):
        raise InputError(Fault("band.distributions", "unknown number of a bearing or guide", name, "see the case"))
    every = np.ones_like(duty.screw_speed)
    if section == "guides":
        arm = float(duty.driven.lead) / (2 * math.pi)
        loads = duty.axis.carriage_loads(duty.states.acceleration)
        every = arm * (every * loads.shape[-1] if field == "seal_force" else np.sum(loads, axis=-1))
    return float(getattr(element, field)), every


def numbers_of_cycle(duty: Duty, screw_torque: Numbers) -> Mapping[str, Numbers]:
    """Torques and energies of a cycle for friction torques of the screw: samples by states."""
    states, axis = duty.states, duty.axis
    without = sum(part for name, part in duty.parts.items() if name not in ("transmission", "brake"))
    of_screw = states.direction * duty.screw.torque / axis.transmission_ratio
    rotating = duty.parts["acceleration of what turns"]
    turned = without - of_screw - rotating + states.direction * screw_torque / axis.transmission_ratio
    torque = turned + duty.transmission_loss(turned) + rotating
    if axis.brake_holds:
        torque = torque * np.abs(states.direction)
    power, weight = torque * duty.motor_speed, states.weight
    drawn = np.maximum(power, 0.0) @ weight
    returned = np.maximum(-power, 0.0) @ weight
    kept = sum(duty.energy_by[name] for name in (*STORED, PROCESS))
    return {
        "torque_rms": np.sqrt(torque**2 @ weight / states.cycle_time),
        "torque_peak": np.max(np.abs(torque), axis=-1),
        "energy_drawn": drawn,
        "energy_returned": returned,
        "energy_lost": drawn - returned - kept,
    }
