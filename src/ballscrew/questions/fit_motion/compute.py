"""The fit of a case to a moving log, and its test on another one."""

from __future__ import annotations

import dataclasses

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.moving_logs.motion_fit import MotionFit, fit_motion
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.questions.fit_motion.options import FitMotionOptions
from ballscrew.questions.shared.options import options_of

#: Flags of the command line by the fields in which the fit finds faults.
_FLAGS = {f"fit.{name}": option.flag for name, option in options_of(FitMotionOptions).items()}


def fit(case: Case, log: MovingLog, test: MovingLog | None, options: FitMotionOptions) -> MotionFit:
    """Fit of a case to a moving log. Raises ``InputError`` that names options of the command line."""
    try:
        result = fit_motion(
            case.model,
            case.screw,
            case.lubricant,
            log,
            options.free or None,
            carried_mass=options.carried_mass,
            test=test,
            keep_going=options.keep_going,
            seed=options.seed,
        )
    except InputError as error:
        faults = (dataclasses.replace(one, where=_FLAGS.get(one.where, one.where)) for one in error.faults)
        raise InputError(*faults) from None
    return dataclasses.replace(result, warning_records=(*result.warning_records, *case.implausible()))
