"""Whether the signs of a log agree with each other: of its load, its speed and its torque."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ballscrew.analyses.torque_log import TorqueLog
from ballscrew.faults import Fault, InputError

#: A sign that this share of the rows has is that of all; the others are noise.
_NEARLY_ALL = 0.95
#: Coefficients of a line through the torques count if they are this many standard errors from nought, and if what they
#: stand for has a share of the torque.
_CLEAR, _LOAD_SHARE, _FRICTION_SHARE = 6.0, 0.2, 0.02
_LEAST_ROWS = 10
_TURNED = "the torque of friction is against the speed: its sign is turned"
#: The condition of normal equations whose columns are much the same.
_NO_NEWS = 1e6


def with_signs(log: TorqueLog) -> TorqueLog:
    """The log with signs that agree, or why they cannot be made to; its rows are those of steady motion.

    A torque of friction gets the sign of the speed: in many logs it is a magnitude, or the torque on the screw.
    Raises :class:`~ballscrew.faults.InputError` if a drive torque clearly belongs to other signs of load or speed.
    """
    if log.kind == "unknown":
        return log.noted('the heading says only "torque": whether it is that of friction or of the drive is not known')
    return _of_friction(log) if log.kind == "friction" else _of_drive(log)


def _of_friction(log: TorqueLog) -> TorqueLog:
    directions = [log.torque[direction] for direction in (log.forward, log.backward)]
    shares = [float(np.mean(torque > 0)) if torque.size else None for torque in directions]
    forward, backward = shares
    turned = dataclasses.replace(log, torque=np.abs(log.torque) * np.sign(log.screw_speed))
    if any(share is not None and 1 - _NEARLY_ALL < share < _NEARLY_ALL for share in shares):
        return log.noted(
            "the torque of friction has both signs at one direction of rotation: if it drives the load, "
            'name its column "drive torque"'
        )
    if backward is not None and backward > 0.5 and (forward is None or forward > 0.5):
        return turned.noted("the torque of friction is positive in reverse too: read as a magnitude")
    if forward is not None and forward < 0.5 and (backward is None or backward < 0.5):
        both = backward is not None
        return turned.noted(
            "the torque of friction is negative in both directions: read as a magnitude" if both else _TURNED
        )
    if forward is not None and forward < 0.5:
        return dataclasses.replace(log, torque=-log.torque).noted(_TURNED)
    return log


def _of_drive(log: TorqueLog) -> TorqueLog:
    """Signs of a drive torque: M = a·F + sign(ω)·(b₀ + b₁·|F|) + c, where a is lead/2π and the bracket friction."""
    F, s, M = log.axial_load, np.sign(log.screw_speed), log.torque
    if M.size < _LEAST_ROWS:
        return log
    columns = {"load": F, "friction": s, "opposing load": s * np.abs(F), "offset": np.ones(M.size)}
    mean_load = float(np.mean(np.abs(F)))
    line = _Line.through(columns, M)
    load = line.clear({"load": mean_load}, _LOAD_SHARE)
    friction = line.clear({"friction": 1.0, "opposing load": mean_load}, _FRICTION_SHARE)
    opposing = line.clear({"opposing load": mean_load}, _LOAD_SHARE)
    if friction < 0 and load <= 0:
        raise _disagreement("the torque brakes where it should drive", "turn the sign of the torque")
    if load < 0:
        raise _disagreement("a load that the motion works against takes less torque", "turn the sign of the load")
    if friction < 0:
        raise _disagreement("friction drives", "turn the sign of the speed, or that of both load and torque")
    if opposing > 3 * load:
        remedy = (
            "give the load the sign of the speed where it works against the motion, or name a torque of friction so"
        )
        raise _disagreement("the torque turns its sign with the speed, the load does not", remedy)
    return log


def _disagreement(problem: str, remedy: str) -> InputError:
    return InputError(Fault("log", f"the signs of load, speed and torque disagree: {problem}", "", remedy))


@dataclasses.dataclass(frozen=True, eq=False)
class _Line:
    """A linear fit through torques: its coefficients by name, their covariance, and a typical torque."""

    coefficients: dict[str, float]
    covariance: NDArray[np.float64]
    typical: float

    @classmethod
    def through(cls, columns: dict[str, NDArray[np.float64]], torque: NDArray[np.float64]) -> _Line:
        """The fit by least squares; a column that is no news beside those before it is left out."""
        names: list[str] = []
        scaled: NDArray[np.float64] = np.empty((torque.size, 0))
        sizes = {name: float(np.sqrt(np.mean(values**2))) for name, values in columns.items()}
        for name, values in columns.items():
            if sizes[name] > 0:
                more = np.column_stack([scaled, values / sizes[name]])
                if np.linalg.cond(more.T @ more) < _NO_NEWS:
                    names, scaled = [*names, name], more
        inverse = np.linalg.inv(scaled.T @ scaled)
        found = inverse @ (scaled.T @ torque)
        residual = torque - scaled @ found
        variance = float(residual @ residual) / max(1, torque.size - len(names))
        size = np.array([sizes[name] for name in names])
        return cls(
            dict(zip(names, map(float, found / size), strict=True)),
            variance * inverse / np.outer(size, size),
            float(np.sqrt(np.mean(torque**2))),
        )

    def clear(self, weights: dict[str, float], share: float) -> float:
        """A sum of coefficients with weights, if it is clear of the noise and has a share of the torque; else 0."""
        weight = np.array([weights.get(name, 0.0) for name in self.coefficients])
        value = float(weight @ np.array(list(self.coefficients.values())))
        error = float(np.sqrt(max(0.0, weight @ self.covariance @ weight)))
        return value if abs(value) > max(_CLEAR * error, share * self.typical) else 0.0
