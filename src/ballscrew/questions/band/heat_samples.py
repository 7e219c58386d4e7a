"""What heat leaves open of a warm operating point: its oil and its preload, by samples of the surroundings."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from ballscrew.axis.thermal.equilibrium import equilibrium
from ballscrew.axis.thermal.surroundings import PREFIX
from ballscrew.axis.thermal.warm_up_band import sampled
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.uncertainty.default_uncertainties import JUDGEMENT
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal
from ballscrew.engine.uncertainty.sampling import JointSamples, sobol_sequence
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.warm_up.band import inputs_of
from ballscrew.questions.warm_up.compute import SERIES
from ballscrew.questions.warm_up.self_heating import SelfHeating

#: Samples of the surroundings, and the share of them that needs a steady state.
SAMPLES, ENOUGH = 256, 0.5
_REASON = "steady states of samples of the surroundings and of the preload as it was set"
_PRELOAD = SERIES["preload"]


@dataclasses.dataclass(frozen=True, eq=False)
class HeatSamples:
    """Temperature of the oil and preload in the steady states of samples of the surroundings, as uncertain inputs."""

    samples: JointSamples
    inputs: Mapping[str, Uncertain]


def heat_samples(heating: SelfHeating, *, only_given: bool = False) -> HeatSamples:
    """The samples of a case that heats itself, about its steady state.

    The friction is that of the model: its own uncertain inputs are drawn by the band, and do not change the heat.
    Raises :class:`~ballscrew.basis.errors.InputError` where half of the samples have no steady state.
    """
    case, network = heating.given, heating.equilibrium.network
    every = inputs_of(case, network, only_given)
    names = [name for name in every if name.startswith(PREFIX) or name in ("preload", "nut.preload")]
    shares = sobol_sequence(len(names), SAMPLES) if names else np.empty((0, SAMPLES))
    drawn = {name: np.asarray(every[name].distribution.quantile(row)) for name, row in zip(names, shares, strict=True)}
    preload = drawn.get("preload", drawn.get("nut.preload"))
    ends = [
        equilibrium(
            sampled(
                network,
                {n.removeprefix(PREFIX): float(v[i]) for n, v in drawn.items() if n.startswith(PREFIX)},
                preload=None if preload is None else float(preload[i]),
                factor=None,
            )
        )
        for i in range(SAMPLES)
    ]
    known = [end for end in ends if end.exists]
    if len(known) < ENOUGH * SAMPLES:
        count = units.to_significant(100 * (1 - len(known) / SAMPLES), 2)
        problem = f"has no steady state in {count} % of samples of the surroundings"
        remedy = "give [surroundings] ball_conductance and nut_conductance with their bands, or see ballscrew warm-up"
        raise InputError(Fault("--self-heating", problem, "", remedy))
    oil = np.array([end.oil_temperature for end in known])
    inputs = {TEMPERATURE.name: Uncertain(Normal(float(np.mean(oil)), float(np.std(oil)) or 1e-9), JUDGEMENT, False,
                                          _range(oil, TEMPERATURE), _REASON)}  # fmt: skip
    if not network.preload_set:
        return HeatSamples(JointSamples((TEMPERATURE.name,), oil[None, :]), inputs)
    held = np.maximum(np.array([end.preload for end in known]), 1e-6 * network.preload_set)
    name = next((name for name in ("preload", "nut.preload") if name in every), "preload")
    spread = float(np.exp(np.std(np.log(held))))
    inputs[name] = Uncertain(
        LogNormal(float(np.median(held)), max(spread, 1 + 1e-9)), JUDGEMENT, False, _range(held, _PRELOAD), _REASON
    )
    return HeatSamples(JointSamples((TEMPERATURE.name, name), np.stack([oil, held])), inputs)


def _range(values: np.ndarray, quantity: Quantity) -> str:
    low, high = (units.shown(float(end), quantity) for end in np.quantile(values, (0.025, 0.975)))
    return f"{low} to {high} (95 %), by the heat"
