"""Objectives: the numbers by which candidates are compared, and which of them are better when larger."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence

from ballscrew.basis.errors import Fault, nearest, raise_if_any
from ballscrew.basis.quantities import Info, Length, Mass, MomentOfInertia, Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.select.requirements import Requirements

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
