"""``ballscrew fit`` on a log of a moving axis."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import typer

from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.cases.case_files.case import Case
from ballscrew.faces.cli.common_options import print_answer
from ballscrew.questions.fit.options import FitOptions
from ballscrew.questions.fit_motion.log import moving_log
from ballscrew.questions.fit_motion.options import FitMotionOptions
from ballscrew.questions.shared.option_values import read
from ballscrew.questions.shared.options import options_of


def fit_moving(
    case: Case,
    log: Path,
    test: Path | None,
    written: Mapping[str, Any],
    *,
    as_json: bool,
    as_sheet: bool,
    to: Path | None,
    picture: Path | None,
) -> None:
    """Fit a case to a moving log, and print, or draw, what is found."""
    _check_unused(written, to)
    options = read(FitMotionOptions, written)
    read_log = moving_log(case, log, options)
    other = None if test is None else moving_log(case, test, options, usual_gain=read_log.gain)
    # solvers are slow to import: only for a log that can be read
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.fit_motion import compute
    from ballscrew.questions.fit_motion import document as documents
    from ballscrew.questions.fit_motion.sheet import sheet

    motion = compute.fit(case, read_log, other, options)
    seen = sheet(case, motion)
    print_answer(seen, lambda: documents.document(case, motion), as_json=as_json, as_sheet=as_sheet)
    if picture is not None:
        to_file.write(picture, seen, option="--picture")
        typer.echo(f"{picture}: {motion.equation.used.size} rows", err=as_json or as_sheet)


def _check_unused(written: Mapping[str, Any], to: Path | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for options of logs of torques alone."""
    of_motion = options_of(FitMotionOptions)
    others = {name: one for name, one in options_of(FitOptions).items() if name not in of_motion}
    unused = [one.flag for one in others.values() if one.is_given(written)]
    remedy = "leave it out: the log is of a motion, not of torques at steady speed"
    raise_if_any(
        [
            Fault(flag, "does not go with a moving log", "", remedy)
            for flag in [*unused, *([] if to is None else ["--to"])]
        ]
    )
