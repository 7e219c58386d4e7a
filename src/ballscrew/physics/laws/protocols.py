"""Parameters and results of the law of each slot: a protocol for each slot of a friction model.

Laws from outside: what they return is checked, and what they raise names them.

The package's own laws are used as they are; their results are known, and a check would cost at every call.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple, Protocol

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Angle, Count, Force, Length, Ratio, Torque
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.laws.conditions import ContactConditions, HertzShape
from ballscrew.physics.laws.frame import Frame

# -- slots ----------------------------------------------------------------------------------------


class FrameLaw(Protocol):
    """Law of the frame in which the balls roll."""

    def __call__(self, screw: BallScrew, /) -> Frame: ...


class ContactLoadLaw(Protocol):
    """Normal load of a ball from the axial load."""

    def __call__(self, axial_load: Force, loaded_balls: Count, contact_angle: Angle, lead_angle: Angle, /) -> Force: ...


class HertzLaw(Protocol):
    """Shape of the contact ellipse: of the radii alone, as it is what the conditions of a contact are made of."""

    def __call__(self, radii_ratio: Ratio, /) -> HertzShape: ...


class FilmLaw(Protocol):
    """Minimum film thickness, inlet cool and full."""

    def __call__(self, conditions: ContactConditions, /) -> Length: ...


class FilmParameterLaw(Protocol):
    """Film thickness against roughness."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class InletFactors(NamedTuple):
    """Factors of the inlet: its heat on the film, all it does on the rolling force, missing oil on the film."""

    film: Ratio
    rolling: Ratio
    supply: Ratio = 1.0


class InletLaw(Protocol):
    """Heating and filling of the inlet."""

    def __call__(self, conditions: ContactConditions, /) -> InletFactors: ...


class FullFilmLaw(Protocol):
    """Friction coefficient of the film itself, where it alone carries the load."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class FrictionLaw(Protocol):
    """Friction coefficient of a contact, most often from its film parameter."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class RollingLaw(Protocol):
    """Hydrodynamic rolling force."""

    def __call__(self, conditions: ContactConditions, /) -> Force: ...


class ElasticResistanceLaw(Protocol):
    """Elastic resistance to rolling."""

    def __call__(self, conditions: ContactConditions, /) -> Torque: ...


class BallForceLaw(Protocol):
    """Net braking force between neighbouring balls."""

    def __call__(self, ball_to_ball_force: Force, contact_load: Force, /) -> Force: ...


class BallChainLaw(Protocol):
    """Law of the contact of a ball with its neighbours."""

    def __call__(
        self,
        ball_friction_coefficient: Ratio,
        ball_to_ball_force: Force,
        ball_diameter: Length,
        frame: Frame,
        /,
    ) -> BallChain: ...


class RaceTorqueLaw(Protocol):
    """Friction torque of one ball on screw and nut."""

    def __call__(
        self,
        screw_tangential_force: Force,
        nut_tangential_force: Force,
        screw_contact_moment: Torque,
        nut_contact_moment: Torque,
        frame: Frame,
        /,
    ) -> RaceTorques: ...


class IdealTorqueLaw(Protocol):
    """Drive torque without friction."""

    def __call__(self, axial_load: Force, screw: BallScrew, frame: Frame, /) -> Torque: ...


# -- the ball chain -------------------------------------------------------------------------------


class BallChain(NamedTuple):
    """Moment and force along the path that its neighbours exert on a ball."""

    #: Moment of the rubbing surfaces of the neighbours.
    moment: Torque
    #: Force against the motion: the net push of the neighbours, and what a curved chain makes of the moment.
    braking_force: Force
    #: The net push alone, as on a straight path; None where all of the braking force is that.
    net_push: Force | None = None

    @property
    def net_braking_force(self) -> Force:
        """Net push of the neighbours against the motion."""
        return self.braking_force if self.net_push is None else self.net_push


# -- torques --------------------------------------------------------------------------------------


class RaceTorques(NamedTuple):
    """Friction torque of one ball on each race."""

    screw: Torque
    nut: Torque


#: What the law of a slot returns, where it is not one quantity.
_RETURNS: Mapping[str, type] = {
    "frame": Frame,
    "hertz": HertzShape,
    "inlet": InletFactors,
    "ball_chain": BallChain,
    "race_torques": RaceTorques,
}
_CONTAINERS = (str, bytes, list, tuple, dict, set)


def is_own(law: Any) -> bool:
    """True for laws of the package, and for no law."""
    return law is None or (getattr(law, "__module__", None) or "").partition(".")[0] == "ballscrew"


def name_of(law: Any) -> str:
    """A law from outside as a case file names it: ``module:name``."""
    named = law if hasattr(law, "__qualname__") else type(law)
    return f"{named.__module__}:{named.__qualname__}"


def usable(slot: str, law: Any, returns: type | None = None) -> Any:
    """The law itself, or around one from outside a law that checks what it returns."""
    return law if is_own(law) else _Checked(slot, law, returns or _RETURNS.get(slot))


@dataclasses.dataclass(frozen=True, eq=False, slots=True)
class _Checked:
    """A law from outside."""

    slot: str
    law: Any
    returns: type | None

    def __call__(self, *arguments: Any) -> Any:
        try:
            result = self.law(*arguments)
        except Exception as error:  # named and raised again, whatever it is
            error.add_note(f"raised by the law model.{self.slot} = {name_of(self.law)}")
            law = f"model.{self.slot}: {name_of(self.law)}"
            error.raised_by_law = law  # pyright: ignore[reportAttributeAccessIssue]  (ours, on an error of anybody)
            raise
        problem = self._problem(result, arguments)
        if problem is not None:
            given = f"{name_of(self.law)} returned {_shown(result)}"
            raise InputError(Fault(f"model.{self.slot}", problem, given, self._remedy))
        return result

    @property
    def _remedy(self) -> str:
        if self.returns is None:
            return "return a number, or an array in the shape of what the law is given"
        return f"return {self.returns.__module__}.{self.returns.__qualname__}"

    def _problem(self, result: Any, arguments: tuple[Any, ...]) -> str | None:
        """Defect of a returned value; None if there is none."""
        values = (result,)
        if self.returns is not None:
            if not isinstance(result, self.returns):
                return f"must return a {self.returns.__name__}"
            values = result if isinstance(result, tuple) else ()
        for value in values:
            if not _is_number(value):
                return "must return numbers"
        if any(isinstance(value, np.ndarray) and value.ndim for value in values):
            allowed = np.broadcast_shapes(*_shapes((*arguments, self.law)))
            for value in values:
                if not _fits(np.shape(value) if isinstance(value, np.ndarray) else (), allowed):
                    return "must return an array in the shape of what it is given"
        return None


def _is_number(value: Any) -> bool:
    """True for real numbers, arrays of them, symbols and recorded values."""
    if isinstance(value, (*_CONTAINERS, bool, complex, np.bool_, np.complexfloating)) or value is None:
        return False
    kind = getattr(getattr(value, "dtype", None), "kind", None)
    return hasattr(value, "__truediv__") and hasattr(value, "__mul__") if kind is None else kind in "fiuV"


def _fits(shape: tuple[int, ...], allowed: tuple[int, ...]) -> bool:
    try:
        return np.broadcast_shapes(shape, allowed) == allowed
    except ValueError:
        return False


def _shapes(parts: Any) -> Iterator[tuple[int, ...]]:
    """The shapes of all arrays in parts, and in the parts of those."""
    yield ()
    for part in parts:
        if isinstance(part, np.ndarray):
            yield part.shape
        elif isinstance(part, tuple):
            yield from _shapes(part)
        elif dataclasses.is_dataclass(part):
            yield from _shapes(getattr(part, field.name) for field in dataclasses.fields(part))


def _shown(result: Any) -> str:
    if isinstance(result, np.ndarray) and result.dtype.kind in "fiu":
        return f"an array of shape {result.shape}"
    return "None" if result is None else f"a {type(result).__name__}"
