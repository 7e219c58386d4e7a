"""The log that a case is fitted to, and what is asked of the fit.

Nothing here needs the solvers of the fit, which are slow to import: a log that is bad is refused before.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from ballscrew.cases.case_files.case import Case
from ballscrew.files.torque_logs import reading
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog

#: The number that is fitted by default.
DEFAULT_FREE = "boundary_friction_coefficient"
#: The quantities that describe a test.
CONDITIONS = ("axial_load", "screw_speed", "temperature")
Range = tuple[float, float]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options:
    """Settings of a fit; numbers in SI."""

    free: Sequence[str]
    bounds: Mapping[str, Range] = dataclasses.field(default_factory=dict[str, Range])
    #: Ranges for the next test, by condition.
    limits: Mapping[str, Range] = dataclasses.field(default_factory=dict[str, Range])
    #: Headings of the log by column.
    columns: Mapping[str, str] = dataclasses.field(default_factory=dict[str, str])
    kind: Kind = "unknown"
    inertia: float | None = None
    torque_constant: float | None = None
    holdout: float = 0.2
    #: Half the width of the 95 % interval of the oil temperature, K; None for the usual one.
    temperature_error: float | None = None
    seed: int = 0
    keep_going: bool = False


def steady_log(case: Case, path: Path, options: Options, done: Callable[[int, int], None] | None = None) -> TorqueLog:
    """The rows of the log in a file at which the motion is steady. ``done`` gets the bytes read and those of the file.

    Raises :class:`~ballscrew.basis.errors.InputError` for a case that cannot be fitted, and for a log that cannot be
    used.
    """
    log = reading.read(
        path, options.columns, torque_constant=options.torque_constant, lead=float(case.screw.lead),
        keep_going=options.keep_going, done=done,
    )  # fmt: skip
    return log.cleaned(inertia=options.inertia)
