"""Options of a fit to a moving log as they are written: numbers with units, names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.files.torque_logs.log_rows import TORQUE_CONSTANT
from ballscrew.questions.fit.options import columns_of, number_of
from ballscrew.questions.fit_motion.log import CARRIED_MASS, GAIN, MovingOptions


def moving_options(
    *,
    free: Sequence[str],
    columns: Sequence[str],
    torque_constant: str | None,
    gain: str | None,
    carried_mass: str | None,
    seed: int,
    keep_going: bool,
    unused: Mapping[str, bool],
) -> MovingOptions:
    """The options of a fit to a moving log; ``unused`` says which of those that do not go with one are given.

    Raises :class:`~ballscrew.basis.errors.InputError` with all faults in them.
    """
    remedy = "leave it out: the log is of a motion, not of torques at steady speed"
    faults = [Fault(option, "does not go with a moving log", "", remedy) for option, given in unused.items() if given]
    names = [name.strip() for given in free for name in given.split(",") if name.strip()]
    found = MovingOptions(
        free=names or None,
        columns=columns_of(columns, faults),
        torque_constant=number_of("--torque-constant", torque_constant, TORQUE_CONSTANT, faults),
        gain=number_of("--gain", gain, GAIN, faults),
        carried_mass=number_of("--carried-mass", carried_mass, CARRIED_MASS, faults, least=0.0),
        seed=seed,
        keep_going=keep_going,
    )
    raise_if_any(faults)
    return found
