"""The constant torque as what a fit without it misses: found by a second fit, with it free."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.records import Record
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE

#: Signs that the model misses more than noise: then it is tried whether the constant torque is what it misses.
_SIGNS = ("fit.baseline_better", "fit.trend")
#: A number that brings the residuals below this share of what they were is worth a word.
_WORTH = 0.7


def constant_torque_missed(model: CalibratedModel, refit: Callable[[Sequence[str]], CalibratedModel]) -> list[Record]:
    """That the constant torque is what the model misses, if a fit with it free shows so.

    Friction of seals and bearings is in nearly every log, and this fit is cheap: no contact is solved anew.
    """
    free = model.settings["free"]
    if CONSTANT_TORQUE.name in free or not any(record.id in _SIGNS for record in model.warning_records):
        return []
    try:
        more = refit([*free, CONSTANT_TORQUE.name])
    except InputError:  # too few rows for one number more
        return []
    before, after = model.residual_rms, more.residual_rms
    if not more.estimates[CONSTANT_TORQUE.name].identified or after > _WORTH * before:
        return []
    message = (
        f"with the constant torque free, too, the rows miss by {units.in_unit(after, 'N m', 2)} instead of "
        f"{units.in_unit(before, 'N m', 2)}: the log has friction of seals or bearings, which the model of the "
        "balls does not; free it"
    )
    return [
        Record.warning("fit.free_more", CONSTANT_TORQUE.name, message, value=after, limit=_WORTH * before, unit="N m")
    ]
