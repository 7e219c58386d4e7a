"""A model calibrated to a log: the data of the fit, with predictions, intervals, the next test and the posterior.

The posterior of a calibration, sampled by walkers: where intervals from derivatives are not to be trusted.

Needs the extra ``calibrate``.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError, accepts_units
from ballscrew.basis.quantities import AngularSpeed, Force, Temperature, Torque
from ballscrew.engine.uncertainty.distributions import normal_half_width
from ballscrew.evidence.calibration.diagnostics import product_of_powers
from ballscrew.evidence.calibration.fit_result import Band, FitResult
from ballscrew.evidence.calibration.next_test import NextTest, next_test
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.robust import Vector, loss_of
from ballscrew.physics.components.oil_grades import TEMPERATURE

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


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class CalibratedModel(FitResult):
    """The result of :func:`~ballscrew.evidence.calibration.fit.fit`."""

    @accepts_units("predict")
    def predict(self, axial_load: Force, screw_speed: AngularSpeed, temperature: Temperature | None = None) -> Torque:
        """Friction torque on the screw, N m, at loads, speeds and temperatures of the oil; arrays broadcast.

        ``axial_load`` (N) has the signs of the model: elastic bodies rub otherwise under the opposite load. The sign of
        ``screw_speed`` (rad/s) does not count. Without a ``temperature`` (K) the oil is as it was given. Raises
        :class:`~ballscrew.basis.errors.InputError` for a temperature of an oil that was not made from a grade.
        """
        oil = self.lubricant if temperature is None else self.lubricant.at(temperature)
        speed = np.abs(np.asarray(screw_speed, dtype=float))
        model = self.model(self.screw, oil, axial_load=np.asarray(axial_load, dtype=float), screw_speed=speed)
        return model.screw_torque

    @accepts_units("band")
    def band(
        self,
        axial_load: Force,
        screw_speed: AngularSpeed,
        temperature: Temperature | None = None,
        *,
        level: float = 0.95,
        scatter: bool = False,
    ) -> Band:
        """The friction torque with the interval that the calibration leaves, N m; with ``scatter``, of one reading.

        Returns a :class:`~ballscrew.evidence.calibration.fit_result.Band` at ``axial_load`` (N), ``screw_speed``
        (rad/s) and ``temperature`` (K), which broadcast; the interval has the probability ``level``. From the exact
        derivatives and the covariance: ``M ± z √(g C gᵀ)``, within what data and priors tell. Where the torque depends
        on what they do not tell, the interval is NaN.

        Raises :class:`~ballscrew.basis.errors.InputError` for a level out of (0, 1).
        """
        if not 0 < level < 1:
            raise InputError(Fault("band.level", "must lie between 0 and 1", str(level), "0.95 is usual"))
        oil_temperature = self.lubricant.temperature if temperature is None else temperature
        given = [axial_load, screw_speed, *([] if oil_temperature is None else [oil_temperature])]
        arrays = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in given))
        names = ("axial_load", "screw_speed", TEMPERATURE.name)
        points = {name: array.ravel() for name, array in zip(names, arrays, strict=False)}
        points["screw_speed"] = np.abs(points["screw_speed"])
        values = self.solution.values
        torques, slopes = self.response.at(points)(values[: len(self.response.names)])
        friction = torques[1] + self.constant_torque
        gradient = np.zeros((friction.size, values.size))
        gradient[:, : slopes.shape[2]] = slopes[1]
        if CONSTANT_TORQUE.name in self.estimates:
            gradient[:, slopes.shape[2]] = 1.0
        variance = self.uncertainty.variance_of(gradient) + (self.solution.noise.of(friction) ** 2 if scatter else 0.0)
        half = normal_half_width(level) * np.sqrt(variance)
        shape = arrays[0].shape
        return Band(*(np.reshape(torque, shape)[()] for torque in (friction - half, friction, friction + half)))

    def next_test(
        self, limits: Mapping[str, tuple[float, float]] | None = None, readings: int | None = None
    ) -> NextTest:
        """The test that would teach most: a :class:`~ballscrew.evidence.calibration.next_test.NextTest`.

        ``limits`` are the least and the greatest value of conditions of a test by name, in SI; ``readings`` is the
        number of readings of a test. See :func:`ballscrew.evidence.calibration.next_test.next_test`.
        """
        return next_test(self, limits, readings)

    def posterior(self, steps: int = 2000, seed: int = 0, done: Callable[[int, int], None] | None = None) -> Posterior:
        """Samples of the fitted numbers: a :class:`~ballscrew.evidence.calibration.calibrated_model.Posterior`.

        ``steps`` is the length of the chain, ``seed`` that of its random numbers; ``done(finished, total)`` is told the
        steps. See :func:`ballscrew.evidence.calibration.calibrated_model.posterior`.
        """
        return posterior(self, steps, seed, done)

    def report(self) -> str:
        """The results in plain text and SI units."""
        lines = [*self.verdicts, "number, value, standard error", *self.estimate_lines]
        combinations = self.identifiability.combinations
        lines += [
            f"known: {product_of_powers(c.powers)} to {c.relative_error:.2g}" for c in combinations if c.identified
        ]
        lines += [f"not known: {product_of_powers(c.powers)}" for c in combinations if not c.identified]
        lines += [f"{s.description}: rms {s.fitted:.4g} N m, held out {s.held_out:.4g} N m" for s in self.scores]
        return "\n".join([*lines, *(f"beware: {warning}" for warning in self.warnings)])
