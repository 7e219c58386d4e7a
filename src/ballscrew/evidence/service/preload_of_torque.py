"""The preload of a nut from one torque without load."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, accepts_units, raise_if_any, renamed_keyword
from ballscrew.basis.quantities import AngularSpeed, Temperature, Torque
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.engine.uncertainty.distributions import Distribution, standard_normal_quantile
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.oil_temperature import torque_of_model
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.evidence.service.preload_change import held_numbers, with_preload
from ballscrew.evidence.service.preload_estimate import Mixture, PreloadEstimate
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

if TYPE_CHECKING:
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

#: A preload is looked for between these multiples of the nominal one, by so many halvings.
LEAST, MOST, HALVINGS = 1e-3, 1e2, 40
#: Screws that could be this one: a power of two, as Sobol' points want.
SAMPLES = 512
#: With fewer samples that could have the torque, nothing is said.
MINIMUM_SAMPLES = 16


@renamed_keyword("uncertain", "distributions")
@accepts_units("service")
def preload_of_torque(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    torque: Torque,
    screw_speed: AngularSpeed,
    temperature: Temperature | None = None,
    torque_deviation: Torque = 0.0,
    distributions: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
    seed: int = 0,
) -> PreloadEstimate:
    """Preload, N, of a nut that loses this torque without load at a speed: the median, and its interval.

    Returns a :class:`~ballscrew.evidence.service.preload_estimate.PreloadEstimate` of the ``screw`` by the ``model``
    with its ``lubricant``. ``torque`` (N m) and ``screw_speed`` (rad/s) are one positive number each. ``distributions``
    are the distributions of the numbers of the model, by default those of ``data/uncertainties.toml``, and ``joint``
    those among them that a calibration left correlated; ``seed`` is that of the samples.

    For :data:`SAMPLES` samples of the numbers of the model, of the oil temperature (2 K either way where
    ``temperature`` is given in K, otherwise 10 K) and of the reading (``torque_deviation``, its standard deviation in
    N m) the preload is solved for; numbers with which no preload gives the torque are not those of this screw, and left
    out.

    Raises :class:`~ballscrew.basis.errors.InputError` for a nut without preload or with elastic bodies, a torque or a
    speed that is not positive, and a torque that no preload gives.
    """
    from ballscrew.engine.uncertainty.monte_carlo import Sampler, sobol_sequence  # loads xarray

    subject = with_preload(Configuration(model, screw, lubricant))
    for name, value in {"torque": torque, "screw_speed": screw_speed}.items():
        raise_if_any([Fault(f"service.{name}", "must be positive", f"{value:g}")] if not value > 0 else [])
    if not torque_deviation >= 0:
        raise InputError(Fault("service.torque_deviation", "must not be negative", f"{torque_deviation:g}"))
    oil = lubricant if temperature is None else lubricant.at(temperature)
    known = held_numbers(subject, distributions)
    together = () if joint is None else joint.names
    sampler = Sampler(subject, {n: one for n, one in known.items() if n not in together}, {}, (), joint)
    shares = sobol_sequence(len(sampler.names) + 2, SAMPLES, seed)
    values = {name: drawn for name, drawn in sampler.inputs_at(shares[2:]).items() if name in known}
    deviation = (LOGGED_TEMPERATURE if temperature is not None else UNKNOWN_TEMPERATURE) / NORMAL_95
    scores = np.asarray(standard_normal_quantile(shares[:2]))
    warmer, wanted = deviation * scores[0], torque + torque_deviation * scores[1]
    points = {"axial_load": np.zeros(SAMPLES), "screw_speed": np.full(SAMPLES, float(screw_speed))}
    if oil.follows_temperature:
        points[TEMPERATURE.name] = np.full(SAMPLES, oil.temperature, dtype=float)
    nominal = float(subject.value_of(PRELOAD) or math.nan)

    def torques(logarithm: Vector) -> Vector:
        there = subject.changed({**values, PRELOAD: nominal * np.exp(logarithm)})
        return torque_of_model(there, points, np.array([[0.0], [1.0]]), warmer)

    low, high = np.full(SAMPLES, math.log(LEAST)), np.full(SAMPLES, math.log(MOST))
    least, most = torques(low), torques(high)
    possible = (least < wanted) & (wanted < most)
    if np.count_nonzero(possible) < MINIMUM_SAMPLES:
        without, much = float(np.nanmedian(least)), float(np.nanmedian(most))
        problem = (
            f"no preload gives it: the nut loses {units.to_significant(without, 3)} N m without any, "
            f"{units.to_significant(much, 3)} N m at {units.to_significant(MOST, 6)} times it"
        )
        remedy = "look at the unit, and at the seals in [losses]"
        raise InputError(Fault("service.torque", problem, f"{torque:.4g} N m", remedy))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        above = torques(middle) > wanted
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    logarithms = ((low + high) / 2)[possible]
    even = np.full(logarithms.size, 1 / logarithms.size)
    # a kernel of a width that Silverman's rule gives stands for what lies between samples
    width = float(np.std(logarithms)) * logarithms.size ** (-1 / 5) / 2
    unknowns = {"temperature": warmer, "reading": wanted if torque_deviation else np.zeros(SAMPLES), **values}
    return PreloadEstimate(
        logarithm=Mixture(even, math.log(nominal) + logarithms, np.full(logarithms.size, width**2)),
        shares={name: _share(drawn[possible], logarithms) for name, drawn in unknowns.items()},
        temperature=None if temperature is None else float(temperature),
    )


def _share(drawn: Vector, logarithms: Vector) -> float:
    """The share of the variance that goes with an input: the square of the correlation of their ranks."""
    if np.ptp(drawn) == 0:
        return 0.0
    ranks = [np.argsort(np.argsort(one)) for one in (drawn, logarithms)]
    return float(np.corrcoef(ranks[0], ranks[1])[0, 1] ** 2)
