"""Bands of warming up: temperatures, growth, preload and torque over time with uncertain surroundings and friction."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.duty_cycle.screw_friction import WORTH_RECORDING
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.moving_source import Itinerary, Piece, Slot, marched
from ballscrew.axis.thermal.network import FrictionFactor, Network
from ballscrew.axis.thermal.surroundings import PREFIX, VARIED, Surroundings
from ballscrew.axis.thermal.warm_up import Equilibrium, WarmUp, equilibrium, warm_up
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, accepts_units, nearest, raise_if_any, renamed_keyword
from ballscrew.basis.quantities import Duration, Length, Ratio, fields_of
from ballscrew.engine.evaluation.evaluator import evaluator
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.band_evaluation import faults_of_inputs, faults_of_options
from ballscrew.engine.uncertainty.bands import Interval
from ballscrew.engine.uncertainty.distributions import Distribution, allowed
from ballscrew.engine.uncertainty.monte_carlo import JointNormal, Sampler, sobol_sequence
from ballscrew.engine.uncertainty.uncertain_value import default_uncertainties

#: Samples where none are asked for, and of heat that goes along with the nut, which takes longer.
SAMPLES, SAMPLES_ALONG = 512, 64
#: What has a band over time, and in the steady state.
OVER_TIME = ("nut_temperature", "shaft_temperature", "shaft_growth", "preload", "screw_torque")
STEADY = ("nut_temperature", "oil_temperature", "shaft_temperature", "preload", "screw_torque", "growth", "power")
#: Networks that go through time together; less where each has one for every place of the nut.
_AT_ONCE, _AT_ONCE_ALONG = 128, 16
#: States of a duty by which the change of its friction is found, those that make the most heat, and K between the two
#: temperatures at least.
_STATES, _APART = 8, 1.0
#: Inputs that the network has itself.
_OF_NETWORK = frozenset({"preload", "nut.preload", "temperature", "axial_load", "screw_speed"})


@dataclasses.dataclass(frozen=True, eq=False)
class SeriesBand(ByValue):
    """Ends and median of a band at each instant, of the samples whose friction is known there; NaN where none is."""

    low: Numbers
    median: Numbers
    high: Numbers


@dataclasses.dataclass(frozen=True, eq=False)
class WarmUpBand(ByValue):
    """Bands of warming up; made by :func:`warm_up_band`."""

    #: With the central values of all inputs.
    warm_up: WarmUp
    level: Ratio
    count: int
    #: The uncertain inputs.
    uncertain: Mapping[str, Distribution]
    #: Instants, s, and the index of the last one of work, which the central transient may not reach.
    time: Numbers
    last_at_work: int
    #: Bands over time by :data:`OVER_TIME`, SI.
    series: Mapping[str, SeriesBand]
    #: Share of the samples whose friction is known at each instant: of the others oil or preload left the map before.
    known_share: Numbers
    #: Bands of the steady state by :data:`STEADY`, and of its margin; of the samples that have one.
    steady: Mapping[str, Interval]
    margin: Interval
    #: Share of the samples that have a steady state.
    steady_share: Ratio


def uncertain_surroundings(network: Network, names: Sequence[str] = VARIED) -> Mapping[str, Distribution]:
    """The usual distributions of what is least known of the surroundings, about the values of a network."""
    known, quantities = default_uncertainties(), fields_of(Surroundings)
    distributions: dict[str, Distribution] = {}
    for name in names:
        usual, value = known.get(PREFIX + name), _value(network, name)
        if usual is not None and value is not None:
            about = usual.about(value, quantities[name].info)
            distributions |= {} if about is None else {PREFIX + name: about}
    return distributions


def _value(network: Network, name: str) -> float | None:
    """A number of the surroundings as the network has it."""
    of_network = {
        "ball_conductance": network.ball_conductance,
        "shaft_convection": network.shaft.convection,
        "nut_mass": network.nut_mass,
    }
    value = of_network.get(name, getattr(network.surroundings, name))
    return None if value is None else float(value)


@renamed_keyword("uncertain", "distributions")
@accepts_units("warm_up_band")
def warm_up_band(
    duty: Duty,
    surroundings: Surroundings | None = None,
    *,
    distributions: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
    time: Duration = 4 * 3600.0,
    cool_down: Duration = 0.0,
    outputs: int = 121,
    samples: int | None = None,
    seed: int = 0,
    level: Ratio = 0.95,
    shaft_length: Length | None = None,
    done: Callable[[int, int], None] | None = None,
) -> WarmUpBand:
    """Bands of :func:`~ballscrew.axis.thermal.warm_up.warm_up` for uncertain surroundings and friction.

    Returns a :class:`WarmUpBand`. ``duty``, ``surroundings``, ``time`` (s), ``cool_down`` (s), ``outputs`` and
    ``shaft_length`` (m) are those of ``warm_up``. A band holds the share ``level`` of the ``samples``, by default
    :data:`SAMPLES`, or :data:`SAMPLES_ALONG` where the heat goes along with the nut; the same ``seed`` gives the same
    bands. ``done(finished, total)`` is told the samples. ``distributions`` names inputs of the surroundings as
    ``surroundings.ball_conductance`` and those of the friction as :func:`~ballscrew.engine.sweeps.sweep.sweep` does;
    left out, it is :func:`uncertain_surroundings`. Inputs of the friction change it by a factor at the ambient
    temperature and one at the last of the central transient; the preload counts in full. The temperature of the oil is
    computed, so it has no distribution. Samples are drawn from a Sobol' sequence, and each is a transient of its own;
    those whose oil or preload leave what is known are counted (``known_share``, ``steady_share``) and no longer in the
    bands. ``joint`` has inputs of the friction that depend on each other.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names and options, and as ``warm_up`` does.
    """
    central = warm_up(duty, surroundings, time=time, cool_down=cool_down, outputs=outputs, shaft_length=shaft_length)
    if samples is None:
        samples = SAMPLES if central.along is None else SAMPLES_ALONG
    drawn = dict(uncertain_surroundings(central.network) if distributions is None else distributions)
    raise_if_any([*faults_of_options((), samples, seed, level, None), *_faults(duty, drawn, joint)])
    networks = _networks(central, _draws(duty, drawn, joint, samples, seed), samples)
    instants = _instants(time, cool_down, outputs)
    series, ends = _outcomes(central, networks, instants, done)
    steady = {name: np.array([_steady(end, name, duty.mean_speed) for end in ends]) for name in STEADY}
    exist = np.array([end.exists for end in ends])
    margins = np.array([end.margin for end in ends])
    return WarmUpBand(
        central,
        level,
        samples,
        drawn,
        np.concatenate(instants),
        outputs - 1,
        {name: SeriesBand(*_quantiles(of, level)) for name, of in series.items()},
        np.mean(np.isfinite(series["screw_torque"]), axis=1),
        {name: _interval(of[exist], level) for name, of in steady.items()},
        _interval(margins[exist], level),
        float(np.mean(exist)),
    )


class _Draws(NamedTuple):
    """Samples of the uncertain inputs by name: of the surroundings, without their prefix, and of the friction."""

    of_air: Mapping[str, Numbers]
    of_friction: Mapping[str, Numbers]


def _subject(duty: Duty) -> Configuration:
    driven: Any = duty.driven
    return Configuration(driven.model, driven.screw, driven.lubricant)


def _parted(uncertain: Mapping[str, Distribution]) -> tuple[dict[str, Distribution], dict[str, Distribution]]:
    """Uncertain inputs as those of the surroundings and those of the friction."""
    of_air = {name: one for name, one in uncertain.items() if name.startswith(PREFIX)}
    return of_air, {name: one for name, one in uncertain.items() if name not in of_air}


def _draws(
    duty: Duty, uncertain: Mapping[str, Distribution], joint: JointNormal | None, samples: int, seed: int
) -> _Draws:
    of_air, of_friction = _parted(uncertain)
    sampler = Sampler(_subject(duty), of_friction, {}, (), joint)
    shares = sobol_sequence(len(of_air) + len(sampler.names), samples, seed)
    quantities = fields_of(Surroundings)
    values: dict[str, Numbers] = {}
    for (written, one), row in zip(of_air.items(), shares, strict=False):
        name = written.removeprefix(PREFIX)
        values[name] = np.clip(one.quantile(row), *allowed(quantities[name].info))
    return _Draws(values, sampler.inputs_at(shares[len(of_air) :]))


def _networks(central: WarmUp, draws: _Draws, samples: int) -> list[Network]:
    """The network of each sample."""
    factors = _factors(central, draws.of_friction, samples)
    preload = draws.of_friction.get("preload", draws.of_friction.get("nut.preload"))
    return [
        sampled(
            central.network,
            {name: float(of[i]) for name, of in draws.of_air.items()},
            preload=None if preload is None else float(preload[i]),
            factor=factors[i] if factors else None,
        )
        for i in range(samples)
    ]


def _outcomes(
    central: WarmUp,
    networks: Sequence[Network],
    instants: tuple[Numbers, Numbers],
    done: Callable[[int, int], None] | None,
) -> tuple[dict[str, Numbers], list[Equilibrium]]:
    """Numbers over time, instants by networks, and where each network ends, some networks at a time."""
    parts: list[dict[str, Numbers]] = []
    ends: list[Equilibrium] = []
    at_once, count = _AT_ONCE if central.along is None else _AT_ONCE_ALONG, len(networks)
    for first in range(0, count, at_once):
        some = networks[first : first + at_once]
        parts.append(_transients(some, instants, central.duty.mean_speed, central.along))
        ends += [equilibrium(one) for one in some]
        if done is not None:
            done(min(first + at_once, count), count)
    return {name: np.concatenate([part[name] for part in parts], axis=1) for name in OVER_TIME}, ends


def _faults(duty: Duty, uncertain: Mapping[str, Distribution], joint: JointNormal | None) -> list[Fault]:
    of_air, of_friction = _parted(uncertain)
    known = [PREFIX + name for name in VARIED]
    faults = [
        Fault(f"band.distributions.{name}", "has no band", "", nearest(name, known))
        for name in of_air
        if name not in known
    ]
    own = [name for name in of_friction if name in _OF_NETWORK and "preload" not in name]
    remedy = "leave it out: it is that of the duty, or follows from the heat"
    faults += [Fault(f"band.distributions.{name}", "has no band over a transient", "", remedy) for name in own]
    return [*faults, *faults_of_inputs(_subject(duty), of_friction, joint)]


def sampled(
    network: Network, values: Mapping[str, float], *, preload: float | None, factor: FrictionFactor | None
) -> Network:
    """A network with other surroundings, another preload and another friction."""
    shaft, given = network.shaft, network.surroundings
    shaft = dataclasses.replace(
        shaft,
        convection=values.get("shaft_convection", shaft.convection),
        bore_convection=values.get("coolant_convection", shaft.bore_convection) if shaft.bore_convection else 0.0,
    )
    # what is computed stays so: a convection by the speed is not that of a shaft at rest
    given = dataclasses.replace(
        given, **{name: value for name, value in values.items() if getattr(given, name) is not None}
    )
    set_to, approach = network.preload_set, network.approach_set
    if preload is not None and set_to:
        set_to, approach = preload, approach * (preload / network.preload_set) ** (2 / 3)
    return dataclasses.replace(
        network,
        shaft=shaft,
        surroundings=given,
        ball_conductance=values.get("ball_conductance", network.ball_conductance),
        nut_mass=values.get("nut_mass", network.nut_mass),
        preload_set=set_to,
        approach_set=approach,
        friction_factor=factor,
    )


def _factors(central: WarmUp, values: Mapping[str, Numbers], samples: int) -> list[FrictionFactor]:
    """The factor of the friction of each sample at the first and the last temperature; none where nothing changes it.

    By the states that make the most heat.
    """
    names = tuple(name for name in values if name not in _OF_NETWORK)
    if not names:
        return []
    duty, last = central.duty, int(np.flatnonzero(central.works)[-1])
    driven: Any = duty.driven
    cold = float(central.network.surroundings.ambient)
    warm = max(float(central.oil_temperature[last]), cold + _APART)
    heated = duty.states.weight * np.abs(duty.screw_speed)
    states, back = np.unique(np.stack([duty.axial_load, duty.screw_speed])[:, heated > 0], axis=1, return_inverse=True)
    weights = np.bincount(back.reshape(-1), weights=heated[heated > 0], minlength=states.shape[1])
    most = np.argsort(weights)[::-1][:_STATES]
    load, speed = states[:, most]
    numbers: list[Numbers] = []
    for temperature, at in ((cold, 0), (warm, last)):
        screw, oil = driven.screw, driven.lubricant.at(temperature)
        if central.network.preload_set:
            screw = dataclasses.replace(screw, nut=screw.nut.changed("preload", float(central.preload[at])))
        engine = "numpy" if samples * load.size < WORTH_RECORDING else None
        ready = evaluator(
            driven.model,
            screw,
            oil,
            inputs=("axial_load", "screw_speed", *names),
            outputs=["screw_torque"],
            engine=engine,
        )
        here = {name: values[name] for name in names}
        if "viscosity" in here:  # drawn about that at the temperature of the oil as it is given
            here["viscosity"] = here["viscosity"] * float(oil.viscosity) / float(driven.lubricant.viscosity)
        torque = ready(axial_load=load, screw_speed=speed, **{name: drawn[:, None] for name, drawn in here.items()})
        usual = driven.model(screw, oil, axial_load=load, screw_speed=speed).screw_torque
        heats = np.atleast_2d(torque["screw_torque"]) @ weights[most]
        numbers.append(heats / float(np.asarray(usual) @ weights[most]))
    return [FrictionFactor((cold, warm), (float(f0), float(f1))) for f0, f1 in zip(*numbers, strict=True)]


def _instants(time: Duration, cool_down: Duration, outputs: int) -> tuple[Numbers, Numbers]:
    """Instants of work and of rest, as a transient has them."""
    rest = np.linspace(0.0, cool_down, max(2, round(outputs * cool_down / time)))[1:] if cool_down else np.empty(0)
    return np.linspace(0.0, time, outputs), time + rest


def _transients(
    networks: Sequence[Network], instants: tuple[Numbers, Numbers], speed: float, along: Itinerary | None = None
) -> dict[str, Numbers]:
    """Numbers over time of networks side by side: instants by networks."""
    start = np.array([np.full(one.size, float(one.surroundings.ambient)) for one in networks])
    work, rest = instants
    mean = Slot.of(networks)
    if along is None:
        slots, pieces, spreads = (
            [mean],
            _pieces(work),
            np.broadcast_to(networks[0].spread, (work.size, start.shape[1] - 3)),
        )
    else:
        of_slots = zip(*(along.networks(one) for one in networks), strict=True)
        slots, pieces, spreads = [Slot.of(ones) for ones in of_slots], along.pieces(work), along.spreads_until(work)
    states = marched(slots, pieces, start, grows=along is None)
    every = [start, *(state.temperatures for state in states)]
    if rest.size:
        standing = [dataclasses.replace(one.standing, spread=spreads[-1]) for one in networks]
        later = np.concatenate([work[-1:], rest])
        states = marched([Slot.of(standing, works=False)], _pieces(later), every[-1])
        every += [state.temperatures for state in states]
        spreads = np.concatenate([spreads, np.broadcast_to(spreads[-1], (rest.size, spreads.shape[1]))])
    ambient, shaft = start[:, 0], networks[0].shaft
    result: dict[str, list[Numbers]] = {name: [] for name in OVER_TIME}
    for temperatures, spread in zip(every, spreads, strict=True):
        preload, power = mean.power_of(temperatures, spread)
        of_shaft = np.mean(temperatures[:, :-3], axis=1)
        growth = shaft.expansion * shaft.length * (of_shaft - ambient)
        row = (temperatures[:, -3], of_shaft, growth, preload, power / speed if speed else np.nan * power)
        for name, values in zip(OVER_TIME, row, strict=True):
            result[name].append(np.where(np.isfinite(power), values, np.nan))
    return {name: np.array(values) for name, values in result.items()}


def _pieces(instants: Numbers) -> Iterator[Piece]:
    return (Piece(0, float(a - instants[0]), float(b - a), True) for a, b in itertools.pairwise(instants))


def _steady(end: Equilibrium, name: str, speed: float) -> float:
    if name == "screw_torque":
        return end.power / speed if speed else float("nan")
    return float(getattr(end, name))


def _quantiles(values: Numbers, level: Ratio) -> tuple[Numbers, Numbers, Numbers]:
    """Low end, median and high end along the last axis, of what is a number."""
    shares = ((1 - level) / 2, 0.5, (1 + level) / 2)
    known = np.isfinite(values).any(axis=1)
    result = np.full((3, values.shape[0]), np.nan)
    result[:, known] = np.nanquantile(values[known], shares, axis=1)
    return result[0], result[1], result[2]


def _interval(values: Numbers, level: Ratio) -> Interval:
    if not values.size:
        return Interval(float("nan"), float("nan"))
    return Interval(*(float(end) for end in np.quantile(values, ((1 - level) / 2, (1 + level) / 2))))
