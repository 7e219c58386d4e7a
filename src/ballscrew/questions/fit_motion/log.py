"""The moving log that a case is fitted to, and what is asked of the fit.

Nothing here needs the solvers of the fit, which are slow to import: a log that is bad is refused before.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.moving_logs import reading
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.questions.fit_motion.question import FitMotionOptions
from ballscrew.questions.shared.option_values import assignments


def is_moving(path: Path, columns: Mapping[str, str] | Sequence[str]) -> bool:
    """Test whether a file is a moving log; ``columns`` are headings by name, or ``name=heading`` of a command line."""
    named = (text.partition("=") for text in assignments(columns))
    return reading.is_moving(path, {name.strip(): heading.strip() for name, _, heading in named if heading.strip()})


def moving_log(case: Case, path: Path, options: FitMotionOptions, usual_gain: float | None = None) -> MovingLog:
    """The log of a file; ``usual_gain`` (N/V) holds where neither the file nor the options give one.

    Raises :class:`~ballscrew.basis.errors.InputError` for a log that cannot be used.
    """
    return reading.read_moving(
        path,
        options.columns,
        lead=float(case.screw.lead),
        torque_constant=options.torque_constant,
        gain=options.gain,
        usual_gain=usual_gain,
        axis=options.axis,
        period=options.period,
        in_amperes=options.steady,
        keep_going=options.keep_going,
    )
