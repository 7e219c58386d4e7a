"""The posterior of a calibration, sampled by walkers: where intervals from derivatives are not to be trusted.

Needs the extra ``calibrate``.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError
from ballscrew.evidence.calibration.fit_result import FitResult
from ballscrew.evidence.calibration.robust import Vector, loss_of

#: Walkers for each parameter, and the share of the steps that is thrown away as the way in.
WALKERS, BURN_IN = 4, 0.3


@dataclasses.dataclass(frozen=True, eq=False)
class Posterior:
    """Samples of the free parameters by name, with the diagnostics of the chain."""

    samples: dict[str, NDArray[np.float64]]
    #: Integrated autocorrelation time in steps; where it is NaN or a large share of the run, the run is too short.
    autocorrelation_time: float
    acceptance: float

    def interval(self, name: str, level: float = 0.95) -> tuple[float, float]:
        """The interval with equal shares of the samples on either side."""
        low, high = np.quantile(self.samples[name], [0.5 - level / 2, 0.5 + level / 2])
        return float(low), float(high)


def posterior(
    fit_result: FitResult, steps: int = 2000, seed: int = 0, done: Callable[[int, int], None] | None = None
) -> Posterior:
    """Samples of ``exp(−½ k Σ ρ(r))`` times the priors within the bounds, by emcee's affine-invariant walkers.

    ρ is the loss of the fit and r the residual in units of its scatter, which stays as it was found; k makes the loss
    as sharp as its residuals are spread, ``Σ ψ' / Σ ψ²`` at the fit. The error of the oil temperature is one number
    more, of which the log may tell something. Residuals that follow each other count as
    independent here. Raises :class:`~ballscrew.basis.errors.InputError` without emcee.
    """
    try:
        import emcee
    except ImportError:
        raise InputError(Fault("posterior", "needs emcee", "", 'pip install "ballscrew[calibrate]"')) from None
    problem, solution = fit_result.problem, fit_result.solution
    low, high = problem.bounds
    torque = problem.on(~fit_result.rows.held_out)
    measured = fit_result.rows.log.torque[~fit_result.rows.held_out]

    psi = solution.influence
    kept = int(np.count_nonzero(~solution.outlying))
    sharpness = solution.curvature * kept / max(float(psi @ psi), 1e-300)

    warmth, known = fit_result.temperature_error, problem.start.size
    by_score = warmth.deviation * warmth.torque_per_kelvin[~fit_result.rows.held_out]
    warm = int(warmth.half_width > 0)

    def logarithm(every: Vector) -> float:
        values, scores = every[:known], every[known:]
        if np.any(values < low) or np.any(values > high):
            return -np.inf
        predicted, _ = torque(values)
        predicted = predicted + by_score * float(np.sum(scores))
        loss = loss_of(predicted - measured, solution.scatter)
        return -0.5 * (sharpness * loss + float(np.sum(fit_result.priors.residuals(values) ** 2) + np.sum(scores**2)))

    random = np.random.default_rng(seed)
    count = known + warm
    walkers = max(WALKERS * count, 2 * count + 2)
    of_rows = np.maximum(np.diagonal(fit_result.uncertainty.covariance - warmth.covariance), 0.0)
    spread = np.sqrt(of_rows) + 1e-3 * problem.scale
    off = random.standard_normal((walkers, count))
    moved = off[:, known:] * warmth.deviation * warmth.shift if warm else 0.0
    start = np.clip(solution.values + moved + spread * off[:, :known], low, high)
    start = np.hstack([start, off[:, known:]])
    sampler: Any = emcee.EnsembleSampler(walkers, count, logarithm)
    state: Any = emcee.State(start, random_state=np.random.RandomState(seed).get_state())
    for step, _ in enumerate(sampler.sample(state, iterations=steps), start=1):
        if done is not None:
            done(step, steps)
    kept = sampler.get_chain(discard=int(BURN_IN * steps), flat=True)
    autocorrelation_time = float(np.max(sampler.get_autocorr_time(quiet=True, tol=0)))
    samples = {name: kept[:, i] for i, name in enumerate(problem.names)}
    return Posterior(samples, autocorrelation_time, float(np.mean(sampler.acceptance_fraction)))
