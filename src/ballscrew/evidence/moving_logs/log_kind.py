"""Logs read from files in Python as the command line reads them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ballscrew.basis.errors import Fault, InputError, accepts_units
from ballscrew.basis.quantities import Length
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.reading import is_moving, read_moving
from ballscrew.files.torque_logs.reading import read
from ballscrew.files.torque_logs.torque_log import TorqueLog


@accepts_units("read_log")
def read_log(
    path: str | os.PathLike[str],
    columns: Mapping[str, str] | None = None,
    *,
    lead: Length | None = None,
    torque_constant: float | None = None,
    keep_going: bool = False,
) -> TorqueLog | MovingLog:
    """The log of the file ``path``, as ``ballscrew fit`` reads it: .csv, .txt, .xlsx, .mat and others.

    Headings have the units. A log of steady tests has loads, speeds and torques: it is a :class:`~ballscrew.TorqueLog`,
    for :func:`~ballscrew.fit`. A log of positions and forces over time is a :class:`~ballscrew.MovingLog`, for
    :func:`~ballscrew.fit_motion`; it needs the ``lead`` (m), as feed rates in the other do. ``columns`` says which
    heading a column has where the file does not: ``{"torque": "M_ist [N m]"}``. A current needs the ``torque_constant``
    (N m/A).

    Raises :class:`~ballscrew.basis.errors.InputError` for a file that cannot be read; with ``keep_going`` rows with
    faults are left out and counted.
    """
    place, named = Path(path), dict(columns or {})
    if not is_moving(place, named):
        return read(place, named, torque_constant=torque_constant, lead=lead, keep_going=keep_going)
    if lead is None:
        raise InputError(Fault("read_log.lead", "is needed for a log of positions", "", "give lead=screw.lead"))
    return read_moving(place, named, lead=float(lead), torque_constant=torque_constant, keep_going=keep_going)
