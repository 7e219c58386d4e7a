"""The most informative next test: the operating point whose readings shrink the confidence region most (D-optimal)."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, nearest, raise_if_any, si_value
from ballscrew.evidence.calibration.fit_result import FitResult
from ballscrew.evidence.calibration.identifiability import weighted_derivatives
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.files.torque_logs.log_rows import quantities
from ballscrew.physics.components.oil_grades import TEMPERATURE

#: Without limits, loads of the signs in the log and speeds, from half the least to twice the largest, are thought
#: possible, and temperatures this many kelvin beyond those of the log.
RANGE_FACTOR, TEMPERATURE_MARGIN = 2.0, 10.0
#: How many speeds, loads and temperatures are tried.
SPEED_COUNT, LOAD_COUNT, TEMPERATURE_COUNT = 25, 15, 5
#: Default readings of a test, as a share of those of the log.
READINGS_SHARE = 0.05
#: How many random tests the best one is compared with.
RANDOM_TEST_COUNT = 50


@dataclasses.dataclass(frozen=True, eq=False)
class NextTest:
    """Tests that were thought of, in SI, and what each would leave of the uncertainty of all parameters together."""

    #: The values of the inputs at all tests, each an array of one length.
    tests: Mapping[str, NDArray[np.float64]]
    #: By test, the volume of the joint confidence region of the free parameters, over that without the test.
    remaining_volume: NDArray[np.float64]
    #: By name, the standard error after the best test over that before.
    remaining_error: Mapping[str, float]
    #: Readings of a test; in both directions where the log has both.
    readings: int
    #: The median of what random tests would leave.
    random_volume: float

    @property
    def best(self) -> dict[str, float]:
        """The operating point of the best test, in SI."""
        place = int(np.argmin(self.remaining_volume))
        return {name: float(values[place]) for name, values in self.tests.items()}

    @property
    def best_volume(self) -> float:
        """Remaining volume of the best test."""
        return float(np.min(self.remaining_volume))


def next_test(
    fit_result: FitResult,
    limits: Mapping[str, tuple[float, float]] | None = None,
    readings: int | None = None,
    seed: int = 0,
) -> NextTest:
    """Expected information of one more test, for tests on a grid within limits in SI.

    By derivatives at the estimate: with the covariance Σ and the derivatives G of the readings of a test in units of
    the scatter, what remains is ``Σ − Σ Gᵀ (1/m + G Σ Gᵀ)⁻¹ G Σ`` for m readings. Numbers that are open altogether
    count as known to their own size. Points that are not valid are left out. The error of the oil temperature stays:
    the volume is of the scatter alone.

    Raises :class:`~ballscrew.basis.errors.InputError` for limits of what is no condition of a test.
    """
    given = dict(limits or {})
    log = fit_result.rows.log
    rows = len(log)
    count = readings or math.ceil(READINGS_SHARE * rows)
    ranges = _ranges(fit_result, given)
    tests = _grid(ranges)
    tests = {name: values[_valid(fit_result, tests)] for name, values in tests.items()}
    problem = [Fault("fit.next_test", "has no valid point within the limits", "", "widen the limits")]
    raise_if_any(problem if not tests["axial_load"].size else [])
    before = _open(fit_result)
    remaining = _after(before, _derivatives(fit_result, tests), count)
    asked = len(fit_result.estimates)
    volume = _volume(remaining, asked) / _volume(before[np.newaxis], asked)
    best = int(np.argmin(volume))
    stays = np.diagonal(fit_result.temperature_error.covariance)[:asked]
    errors = np.sqrt((np.diagonal(remaining[best])[:asked] + stays) / (np.diagonal(before)[:asked] + stays))
    random = np.random.default_rng(seed).choice(volume, RANDOM_TEST_COUNT)
    told = dict(zip(fit_result.estimates, errors.tolist(), strict=True))
    return NextTest(tests, volume, told, count, float(np.median(random)))


def _ranges(fit_result: FitResult, limits: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    log = fit_result.rows.log
    ranges = {
        name: (_further(float(values.min()), -1), _further(float(values.max()), 1))
        for name, values in {"axial_load": log.axial_load, "screw_speed": np.abs(log.screw_speed)}.items()
    }
    if fit_result.lubricant.follows_temperature and log.temperature is not None:
        info = fit_result.lubricant.temperature_quantity.info
        low, high = float(log.temperature.min()) - TEMPERATURE_MARGIN, float(log.temperature.max()) + TEMPERATURE_MARGIN
        ranges[TEMPERATURE.name] = max(low, info.at_least or low), min(high, info.at_most or high)
    unknown = [name for name in limits if name not in ranges]
    raise_if_any([Fault(f"fit.limits.{n}", "is no condition of a test", "", nearest(n, ranges)) for n in unknown])
    known = quantities()
    in_si = {
        name: (si_value(where := f"fit.limits.{name}", low, known[name].unit), si_value(where, high, known[name].unit))
        for name, (low, high) in limits.items()
    }
    return {**ranges, **in_si}


def _further(end: float, side: int) -> float:
    """An end of a range moved to its side by :data:`RANGE_FACTOR`."""
    return end * RANGE_FACTOR if end * side > 0 else end / RANGE_FACTOR


def _grid(ranges: Mapping[str, tuple[float, float]]) -> dict[str, Vector]:
    """Tests all over the ranges: speeds and loads by ratios, temperatures by differences."""
    axes: list[Vector] = []
    for name, number in {
        "axial_load": LOAD_COUNT,
        "screw_speed": SPEED_COUNT,
        TEMPERATURE.name: TEMPERATURE_COUNT,
    }.items():
        if name in ranges:
            low, high = ranges[name]
            if low == high:
                axes.append(np.array([high]))
            elif name == TEMPERATURE.name:
                axes.append(np.linspace(low, high, number))
            else:
                sides = [-_by_ratios(max(-high, 0.0), -low, number)[::-1]] if low < 0 else []
                axes.append(np.concatenate([*sides, *([_by_ratios(max(low, 0.0), high, number)] if high > 0 else [])]))
    meshes = np.meshgrid(*axes, indexing="ij")
    return dict(zip(("axial_load", "screw_speed", TEMPERATURE.name), (m.ravel() for m in meshes), strict=False))


def _by_ratios(low: float, high: float, number: int) -> Vector:
    return np.geomspace(low if low > 0 else 1e-3 * high, high, number)


def _valid(fit_result: FitResult, tests: Mapping[str, Vector]) -> NDArray[np.bool_]:
    oil = fit_result.lubricant.at(tests[TEMPERATURE.name]) if TEMPERATURE.name in tests else fit_result.lubricant
    result = fit_result.model(fit_result.screw, oil, axial_load=tests["axial_load"], screw_speed=tests["screw_speed"])
    return np.asarray(result.valid & np.isfinite(result.screw_torque))


def _open(fit_result: FitResult) -> Vector:
    """Covariance of all parameters of the fit, those that are open known to their own size."""
    root = weighted_derivatives(fit_result.solution)
    own = np.diag(1 / fit_result.uncertainty.scale**2)
    return np.asarray(np.linalg.inv(root.T @ root + own), dtype=np.float64)


def _derivatives(fit_result: FitResult, tests: Mapping[str, Vector]) -> NDArray[np.float64]:
    """Derivatives of the readings of each test in units of the scatter, of shape (tests, directions, parameters)."""
    log, response, convention = fit_result.rows.log, fit_result.response, fit_result.rows.convention
    points, load = dict(tests), tests["axial_load"]
    if fit_result.lubricant.follows_temperature and TEMPERATURE.name not in points:
        points[TEMPERATURE.name] = np.full(load.size, fit_result.lubricant.temperature)
    directions = [sign for sign in (1.0, -1.0) if np.any(sign * log.screw_speed > 0)]
    ones = np.ones(load.size)
    made: list[Vector] = []
    for sign in directions:
        points["axial_load"] = convention.loads(load, sign * ones)
        torques, slopes = response.at(points)(fit_result.solution.values[: len(response.names)])
        weights = convention.weights(load, sign * ones)
        columns = [np.einsum("tr,trn->rn", weights, slopes)]
        columns += [weights[1][:, np.newaxis]] * (len(fit_result.estimates) - len(response.names))
        # a later test has the zero error of the sensor, and nobody knows its drift by then
        columns += [(ones if name == "torque_offset" else 0 * ones)[:, np.newaxis] for name in fit_result.sensor]
        scatter = fit_result.solution.noise.of(np.sum(weights * torques, axis=0))
        made.append(np.hstack(columns) / scatter[:, np.newaxis])
    return np.stack(made, axis=1)


def _after(before: Vector, derivatives: Vector, readings: int) -> Vector:
    """The covariances that tests leave, of shape (tests, parameters, parameters)."""
    directions = derivatives.shape[1]
    each = readings / directions
    crossed = derivatives @ before
    inner = crossed @ derivatives.transpose(0, 2, 1) + np.eye(directions) / each
    return before - crossed.transpose(0, 2, 1) @ np.linalg.solve(inner, crossed)


def _volume(covariances: Vector, asked: int) -> Vector:
    """Volume of the joint confidence region of the first parameters, but for a factor."""
    _, logarithm = np.linalg.slogdet(covariances[:, :asked, :asked])
    return np.exp(0.5 * logarithm)
