"""Traits of laws: what a law can do and what it stands for, declared where the law is defined.

Nothing in the package asks which law it has in hand; it asks for the traits. They are the attribute ``traits`` of
the law, put there by the decorator :func:`law_traits`, on a function and on a frozen dataclass alike. A law from
outside may have none: then the defaults hold, which promise nothing.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, TypeVar

T = TypeVar("T")

_TWO = frozenset({2})


@dataclasses.dataclass(frozen=True, kw_only=True)
class LawTraits:
    """Traits that a law declares; each has a meaning in some slots only."""

    #: Whether the law could as well be the right one, so that the uncertainty band takes it for an alternative.
    alternative: bool = False
    #: Why a law is no alternative: most often what it leaves out that another law of its slot has.
    excluded: str = ""
    #: Whether only the paper as printed has it: in another model it breaks a balance, and it is in no spread of laws.
    printed_form: bool = False
    #: Whether the law can be recorded, to be compiled and differentiated: not one that calls a library of its own which
    #: knows no arrays but NumPy's.
    recordable: bool = True
    #: Of a slip law: the numbers of contacts a ball may have. With four, over the whole ellipse, the balance is that of
    #: :mod:`ballscrew.physics.solvers.four_point_slip`.
    contacts_per_ball: frozenset[int] = _TWO
    #: Of a slip law: curvature is the only slip, so that an offset of the lines of pure rolling means something.
    curvature_alone: bool = False
    #: Of a slip law: the contacts slip across the path, too.
    lateral_slip: bool = True
    #: Of a law of the force between balls: an imposed force counts.
    uses_imposed_force: bool = True
    #: Of a law of the force between balls: it takes a third argument, the ball with its contacts
    #: (:class:`~ballscrew.physics.laws.ball_chain.BallInCircuit`). A ball without load has none, and no force.
    reads_ball: bool = False
    #: Of a law of the film: it reads the limit of the shear stress that the oil has.
    reads_limiting_shear: bool = False
    #: Of a friction law: it is of surfaces as they are made, which have neither run in nor reacted with the oil.
    new_surfaces: bool = False


_NONE_DECLARED = LawTraits()
#: An empty slot: the constant that stands for the missing law is an alternative to any law.
_EMPTY_SLOT = LawTraits(alternative=True)


def law_traits(**traits: Any) -> Callable[[T], T]:
    """Declare the traits of a law: a decorator of functions and of dataclasses."""
    declared = LawTraits(**traits)

    def declare(law: T) -> T:
        setattr(law, "traits", declared)  # noqa: B010  (neither functions nor classes declare the attribute)
        return law

    return declare


def traits_of(law: Any) -> LawTraits:
    """The traits of a law, or the defaults where it declares none."""
    if law is None:
        return _EMPTY_SLOT
    declared = getattr(law, "traits", None)
    return declared if isinstance(declared, LawTraits) else _NONE_DECLARED
