"""Requirements of a need beyond what a case file says, their checks, and the objectives to rank by."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, faults_of, nearest, raise_if_any
from ballscrew.basis.quantities import (
    Count,
    Force,
    Info,
    Length,
    Mass,
    MomentOfInertia,
    Quantity,
    Ratio,
    Speed,
    Stiffness,
    Torque,
    fields_of,
    quantities_of,
)
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.friction import directions
from ballscrew.physics.sizing.checks import Check
from ballscrew.physics.sizing.rigidity import AxialRigidity
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.check.answer import Checked
from ballscrew.questions.duty.compute import DutyReport

#: What the load may do with the screw: drive it or not, must drive it, must not.
ALLOWED, NEEDED, FORBIDDEN = "allowed", "needed", "forbidden"
BACK_DRIVING = (ALLOWED, NEEDED, FORBIDDEN)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Requirements(ByValue):
    """Requirements of a need. What is None is not asked for.

    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    feed: Annotated[
        Speed | None,
        Info("v", "speed of travel, in place of a screw speed", "m/min", hint="each lead then has a speed of its own"),
    ] = None
    stroke: Annotated[
        Length | None, Info("s", "travel of the nut", "mm", above=0, hint="lengths are positive", usual=(1e-3, 20.0))
    ] = None
    largest_drive_torque: Annotated[
        Torque | None, Info("M_{max}", "largest torque on the shaft", "N m", above=0, hint="that of the motor")
    ] = None
    largest_preload_torque: Annotated[
        Torque | None,
        Info("M_{p,max}", "largest drag torque of the nut, its seals included", "N m", above=0, hint="0.1 to 2 N m"),
    ] = None
    least_rigidity: Annotated[
        Stiffness | None,
        Info("R_{min}", "least rigidity of the nut under the load", "N/um", above=0, hint="200 N/um to 2000 N/um"),
    ] = None
    least_remaining_preload: Annotated[
        Force | None,
        Info("F_{r,min}", "least preload that the load leaves", "N", above=0, hint="some per cent of the load"),
    ] = None
    largest_inertia: Annotated[
        MomentOfInertia | None,
        Info("J_{max}", "largest moment of inertia of the shaft", "kg cm^2", above=0, hint="that of the motor"),
    ] = None
    counts_per_turn: Annotated[
        Count | None,
        Info("n_c", "counts of the encoder in one turn of the screw", at_least=1, whole=True, hint="4096 to 16777216"),
    ] = None
    largest_step: Annotated[
        Length | None,
        Info("x_{max}", "largest travel of one count of the encoder", "um", above=0, hint="0.01 um to 10 um"),
    ] = None
    #: Whether the load may turn the screw (``allowed``), must (``needed``), or must not (``forbidden``).
    back_driving: str = ALLOWED
    #: Grade of ISO 3408-3, as it is written. No row lists its grades: it is echoed and never judged.
    accuracy: str = ""

    def __post_init__(self) -> None:
        faults = faults_of("need", self, optional=tuple(fields_of(Requirements)))
        if self.back_driving not in BACK_DRIVING:
            given = str(self.back_driving)
            faults.append(Fault("need.back_driving", "unknown", given, nearest(given, BACK_DRIVING)))
        if not faults and self.largest_step is not None and self.counts_per_turn is None:
            remedy = "add counts_per_turn, those of the encoder"
            faults.append(Fault("need.largest_step", "cannot be judged alone", f"{self.largest_step:g} m", remedy))
        raise_if_any(faults)


#: The length of shaft whose inertia counts where a need gives neither a length nor a stroke, m.
USUAL_LENGTH = 1.0


@dataclasses.dataclass(frozen=True)
class Objective:
    """A number to be small, or to be large."""

    quantity: Quantity
    larger_is_better: bool = False

    @property
    def sign(self) -> float:
        """The factor that makes less better."""
        return -1.0 if self.larger_is_better else 1.0


def _objective(
    name: str, unit: str, symbol: str, meaning: str, shown_in: str = "", *, larger: bool = False
) -> Objective:
    return Objective(Quantity(name, unit, Info(symbol, meaning, shown_in)), larger)


#: The objectives by name.
OBJECTIVES: Mapping[str, Objective] = {
    each.quantity.name: each
    for each in (
        _objective("loss", "W", "P_f", "power lost to friction, of a cycle its mean"),
        _objective("inertia", "kg m^2", "J", "moment of inertia of the shaft", "kg cm^2"),
        _objective("reflected_mass", "kg", "m_J", "mass that the shaft adds to what moves"),
        _objective("life", "s", "L_h", "basic rating life L10h", "h", larger=True),
        _objective("rigidity", "N/m", "R", "rigidity of the nut under the load", "N/um", larger=True),
        _objective("drive_torque", "N m", "M", "torque on the shaft, of a cycle the largest"),
        _objective("preload_torque", "N m", "M_p", "drag torque of the nut"),
        _objective("price_index", "1", "p", "price against another of the same list"),
    )
}
#: Those that count by default; the price where one is known.
USUAL_OBJECTIVES = ("loss", "inertia", "life", "rigidity")


def objectives_named(names: Sequence[str], where: str, known: Sequence[str] = tuple(OBJECTIVES)) -> tuple[str, ...]:
    """Names of objectives, each once. Raises :class:`~ballscrew.basis.errors.InputError` for unknown ones, and for
    none.
    """
    faults = [Fault(where, "unknown objective", str(n), nearest(str(n), known)) for n in names if n not in known]
    faults += [] if names else [Fault(where, "is empty", "", f"name some of {', '.join(known)}")]
    raise_if_any(faults)
    return tuple(dict.fromkeys(names))


def shaft_length(required: Requirements, case: Case) -> Length | None:
    """The length of shaft whose inertia counts: that of the case, else the stroke; None where neither is given."""
    return required.stroke if case.turning_shaft is None else case.turning_shaft.length


def reflected_mass(inertia: MomentOfInertia, lead: Length) -> Mass:
    r"""Mass whose kinetic energy at the nut is that of the shaft, :math:`m_J = J (2\pi/P_h)^2`, kg."""
    return inertia * (2 * math.pi / lead) ** 2


def front(costs: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask of the rows of costs, all to be small, to which no other row is preferable.

    A row beats another that it is nowhere above and somewhere below; equal rows beat each other not. Rows with NaN are
    on no front.
    """
    values = np.zeros(len(costs), dtype=bool)
    known = np.flatnonzero(~np.isnan(costs).any(axis=1))
    # a row that beats another comes before it in the order of its columns, one after the other
    order = known[np.lexsort(costs[known].T[::-1])]
    kept: list[int] = []
    for place in order:
        best, row = costs[kept], costs[place]
        if not np.any((best <= row).all(axis=1) & (best < row).any(axis=1)):
            kept.append(int(place))
    values[kept] = True
    return values


#: The checks of :func:`by_loads`.
BY_LOADS = ("preload", "remaining_preload", "inertia", "step")
LIFT_OFF = quantities_of(BallLoads)["lift_off_load"]
_LEFT = "preload that the largest load leaves on the relieved half or flank"
_NO_PRELOAD = "a preload is asked for, and this nut has none: name the kinds of nuts that have one"
_RIGIDITY = quantities_of(AxialRigidity)["nut"]


def by_loads(
    required: Requirements,
    case: Case,
    numbers: Mapping[str, float],
    *,
    preload: Force,
    largest_load: Force,
    balls: BallLoads,
    lacks_preload: bool = False,
) -> tuple[Check, ...]:
    """A check for the preload of a nut and for each requirement that is set and knows no friction.

    ``balls`` are under the largest load of the need. A nut ``lacks_preload`` where the need asks for one and its kind
    has none.
    """
    lacking = Check.saying(_NO_PRELOAD, "preload", 0.0, None, "N", None, False)
    pair = (
        lacking if lacks_preload else kept_preload(preload, largest_load, balls),
        _bounded(
            Check.at_least, _LEFT,
            "remaining_preload", float(balls.remaining_preload), required.least_remaining_preload, "N",
        ),
        _inertia(required, case, numbers["inertia"]),
        step(required, float(case.screw.lead)),
    )  # fmt: skip
    return tuple(check for check in pair if check is not None)


def of_friction(
    required: Requirements, checked: Checked, report: DutyReport | None, numbers: Mapping[str, float]
) -> tuple[Check, ...]:
    """A check for each other requirement that is set."""
    bounds = (
        _bounded(
            Check.at_most, "torque on the shaft",
            "drive_torque", numbers["drive_torque"], required.largest_drive_torque, "N m",
        ),
        _bounded(
            Check.at_most, "drag torque of the nut",
            "preload_torque", numbers["preload_torque"], required.largest_preload_torque, "N m",
        ),
        _rigidity(required, checked, numbers["rigidity"]),
    )  # fmt: skip
    drives = back_driving(required, checked) if report is None else _of_axis(required, report)
    return tuple(check for check in (*bounds, drives) if check is not None)


def kept_preload(preload: Force, largest_load: Force, balls: BallLoads) -> Check | None:
    """Check whether the largest load leaves some of the preload, with :func:`preload_used`; of a nut that has one."""
    if not preload > 0:
        return None
    left, limit = float(balls.remaining_preload), float(balls.rigid_lift_off_load)
    holds = left > 0
    message = (
        "preload that the largest load leaves on the relieved half or flank: some; rigid bodies lose it above "
        f"{units.shown(limit, LIFT_OFF)}"
    )
    if not holds and not limit <= abs(largest_load):  # what rigid bodies would bear says nothing here
        message = _LEFT
    used = float(preload_used(preload, left, largest_load, limit))
    return Check.saying(message, "preload", left, 0.0, "N", used, holds)


def preload_used(preload: Force, left: Force, load: Force, rigid_lift_off_load: Force) -> Ratio:
    """Share of the preload that a load takes; where it takes all of it, always above one.

    It is then the load over that at which the balls of a rigid nut lift off the other half or flank. Bodies may lose
    the preload below that load, too: then it is the next number above one.
    """
    lost = np.fmax(abs(load) / np.asarray(rigid_lift_off_load), np.nextafter(1.0, 2.0))
    return np.where(np.asarray(left) > 0, 1 - np.asarray(left) / preload, lost)


def _bounded(
    check: Callable[..., Check], message: str, name: str, value: float, limit: float | None, unit: str
) -> Check | None:
    """A check against a limit, none without one; a value that is no number is not judged."""
    if limit is None:
        return None
    if math.isnan(value):
        return Check.saying(f"{message}: not known here", name, None, limit, unit, None, None)
    return check(message, name, value, limit, unit)


def _rigidity(required: Requirements, checked: Checked, of_balls: float) -> Check | None:
    """The nut against the least rigidity: that of its balls under the load, or that of ISO 3408-4 where it is smaller.

    Catalogues print the latter. That of the drive stands beside it, where shaft and bearings are known.
    """
    if required.least_rigidity is None:
        return None
    by_standard = checked.nut.rigidity
    corrected, nut, drive = (float(value) for value in (by_standard.nut_corrected, by_standard.nut, by_standard.drive))
    printed = nut if math.isnan(corrected) else corrected
    message = "rigidity of the nut under the load"
    if not math.isnan(printed):
        message = (
            f"the smaller of the balls under the load, {units.shown(of_balls, _RIGIDITY)}, and of the nut by ISO "
            f"3408-4, {units.shown(printed, _RIGIDITY)}"
        )
    if not math.isnan(drive):
        message = f"{message}; nut, shaft and bearings together {units.shown(drive, _RIGIDITY)}"
    return _bounded(
        Check.at_least, message, "rigidity", float(np.fmin(of_balls, printed)), required.least_rigidity, "N/m"
    )


def _inertia(required: Requirements, case: Case, value: float) -> Check | None:
    """Inertia of the shaft; not judged where its length is not known."""
    limit = required.largest_inertia
    if limit is not None and shaft_length(required, case) is None:
        message = "not judged: give the length of the shaft, or the stroke"
        return Check.saying(message, "inertia", None, limit, "kg m^2", None, None, "installation.unsupported_length")
    return _bounded(Check.at_most, "inertia of a solid shaft", "inertia", value, limit, "kg m^2")


def step(required: Requirements, lead: float) -> Check | None:
    """Travel of one count of the encoder."""
    if required.largest_step is None or required.counts_per_turn is None:
        return None
    count = lead / required.counts_per_turn
    return _bounded(Check.at_most, "travel of one count", "step", count, required.largest_step, "m")


def back_driving(required: Requirements, checked: Checked) -> Check | None:
    """Check whether the load turns the screw, at rest and at the speed.

    The value is the torque that the load has left over friction, negative where friction holds it: at rest, at the
    speed, and at the speed in a full bath of oil, as it is not measured whether a ball screw is starved; of these the
    one that is worse for the need. At the ends of the band of friction the answer may be another.
    """
    if required.back_driving == ALLOWED:
        return None
    load = checked.run.at_rest.axial_load
    if not load:
        return Check.saying("not judged: no load", "back_driving", None, None, "N m", None, None)
    friction, way = checked.run.friction, math.copysign(1.0, load)
    flooded = directions.holding_torque(friction.ideal_torque, friction.flooded_torque)
    left = (way * float(torque) for torque in (checked.run.at_rest.holding_torque, friction.holding_torque, flooded))
    known = [value for value in left if not math.isnan(value)]
    if not known:
        return Check.saying("not judged: outside of what the model knows", "back_driving", None, 0.0, "N m", None, None)
    if required.back_driving == FORBIDDEN:
        value = max(known)
        return Check.saying(
            "torque that the load has left: at most none", "back_driving", value, 0.0, "N m", None, value <= 0
        )
    value = min(known)
    return Check.saying(
        "torque that the load has left: more than none", "back_driving", value, 0.0, "N m", None, value > 0
    )


def _of_axis(required: Requirements, report: DutyReport) -> Check | None:
    """Check whether the axis moves, motor off, in all conditions of ``ballscrew duty``: as it is, cold, hot, dry."""
    if required.back_driving == ALLOWED:
        return None
    brake = report.brake
    if required.back_driving == FORBIDDEN:
        message = "torque that holds the axis with the motor off, in any condition"
        return Check.saying(message, "back_driving", brake.holding_torque, 0.0, "N m", None, not brake.falls)
    every = all(condition.falls for condition in brake.conditions)
    least = min(condition.holding_torque for condition in brake.conditions)
    return Check.saying(
        "torque that the load has left in every condition", "back_driving", least, 0.0, "N m", None, every
    )
