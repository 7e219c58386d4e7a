"""Requirements of a need beyond what a case file says, and the objectives by which candidates are ranked."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

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
    Speed,
    Stiffness,
    Torque,
    fields_of,
)
from ballscrew.cases.case_files.case import Case

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
    """Whether no other row is better, for each row of costs, all to be small.

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
