"""An element: contacts that share a load, called with an operating state.

The ball screw is one. Support bearings, guides and seals meet the same protocols, so that an axis can sum what its
elements lose and needs to know no more of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from ballscrew.basis.quantities import Array, Mask, Power
from ballscrew.basis.records import Record
from ballscrew.physics.components.operating_state import OperatingState


class ElementFriction(Protocol):
    """What an axis needs to know of the friction of an element at an operating state."""

    @property
    def friction_effort(self) -> Array:
        """Magnitude of the generalised friction force: a torque about the shaft (N m) or a force along a rail (N)."""
        ...

    @property
    def contributions(self) -> Mapping[str, Array]:
        """The effort by mechanism; the parts sum to it."""
        ...

    @property
    def friction_power(self) -> Power:
        """Power dissipated, W; the heat of the element."""
        ...

    @property
    def validity(self) -> Mapping[str, Mask]:
        """Masks of the conditions of the model, by reason."""
        ...

    @property
    def warning_records(self) -> list[Record]:
        """Warnings as records."""
        ...


class FrictionElement(Protocol):
    """Anything that loses power in contacts under a load and in motion: its friction at an operating state."""

    def __call__(self, state: OperatingState, /) -> ElementFriction:
        """Friction at a state; load and speed are those of the element, with their signs."""
        ...
