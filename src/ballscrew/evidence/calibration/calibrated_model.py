"""A model calibrated to a log: the data of the fit, with predictions, intervals, the next test and the posterior."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping

import numpy as np

from ballscrew.basis.errors import Fault, InputError, accepts_units
from ballscrew.basis.quantities import AngularSpeed, Force, Temperature, Torque
from ballscrew.engine.uncertainty.distributions import normal_half_width
from ballscrew.evidence.calibration.diagnostics import product_of_powers
from ballscrew.evidence.calibration.fit_result import Band, FitResult
from ballscrew.evidence.calibration.next_test import NextTest, next_test
from ballscrew.evidence.calibration.posterior import Posterior, posterior
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.physics.components.oil_grades import TEMPERATURE


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
        """Samples of the fitted numbers: a :class:`~ballscrew.evidence.calibration.posterior.Posterior`.

        ``steps`` is the length of the chain, ``seed`` that of its random numbers; ``done(finished, total)`` is told the
        steps. See :func:`ballscrew.evidence.calibration.posterior.posterior`.
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
