"""The moving log that a case is fitted to, and what is asked of the fit.

Nothing here needs the solvers of the fit, which are slow to import: a log that is bad is refused before.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path

from ballscrew.basis.quantities import Info, Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.moving_logs import reading
from ballscrew.evidence.moving_logs.moving_log import GAIN as GAIN
from ballscrew.evidence.moving_logs.moving_log import MovingLog

CARRIED_MASS = Quantity("carried_mass", "kg", Info("m", "mass whose force passes the nut", at_least=0))


@dataclasses.dataclass(frozen=True, kw_only=True)
class MovingOptions:
    """Settings of a fit to a moving log; numbers in SI."""

    #: None for what is usual.
    free: Sequence[str] | None = None
    #: Headings of the log by column.
    columns: Mapping[str, str] = dataclasses.field(default_factory=dict[str, str])
    torque_constant: float | None = None
    #: Force for each volt of a control voltage, N/V.
    gain: float | None = None
    carried_mass: float | None = None
    seed: int = 0
    keep_going: bool = False


def is_moving(path: Path, columns: Sequence[str]) -> bool:
    """Test whether a file is a moving log; ``columns`` are those of the command line, ``name=heading``."""
    named = (text.partition("=") for text in columns)
    return reading.is_moving(path, {name.strip(): heading.strip() for name, _, heading in named if heading.strip()})


def moving_log(case: Case, path: Path, options: MovingOptions, usual_gain: float | None = None) -> MovingLog:
    """The log of a file; ``usual_gain`` (N/V) holds where neither the file nor the options give one.

    Raises :class:`~ballscrew.basis.errors.InputError` for a log that cannot be used.
    """
    return reading.read_moving(
        path, options.columns, lead=float(case.screw.lead), torque_constant=options.torque_constant,
        gain=options.gain, usual_gain=usual_gain, keep_going=options.keep_going,
    )  # fmt: skip
