"""The operating state: load and speed with their signs, and the temperature.

An element: contacts that share a load, called with an operating state.

The ball screw is one. Support bearings, guides and seals meet the same protocols, so that an axis can sum what its
elements lose and needs to know no more of them.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Protocol

import numpy as np

from ballscrew.basis.arrays import ByValue, where
from ballscrew.basis.errors import (
    Fault,
    fault_of_declared_unit,
    faults_of,
    is_concrete,
    names_keywords,
    raise_if_any,
)
from ballscrew.basis.quantities import AngularSpeed, Array, Force, Info, Mask, Power, Temperature, fields_of
from ballscrew.basis.records import Record

#: A load (N) or a speed (rad/s) nearer to zero than this is none to the formulas. A speed that decays to rest passes
#: numbers whose reciprocals and powers leave the range of numbers of 64 bits; those of what is farther away do not.
NOTHING = 1e-100
#: A speed (rad/s) beyond this is none: its powers leave the range of numbers as well.
FASTEST = 1 / NOTHING
#: What to do with arrays that are no list of operating points.
USE_SWEEP = "give one speed for each load; for every load at every speed use ballscrew.sweep"


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class OperatingState(ByValue):
    """Operating state: axial load and speed of the screw with their signs, and the temperature of the oil.

    A positive load is one that a positive speed lifts. Zero load and zero speed are legal and give limits; without a
    temperature the oil has its own. Any of them may be an array; a labelled one of xarray loses its labels. Raises
    :class:`~ballscrew.basis.errors.InputError` for non-finite numbers, for a speed beyond 1e100 rad/s, which is NaN in
    an array, and for labelled arrays along different dimensions or in another unit.
    """

    axial_load: Annotated[
        Force,
        Info(
            "F",
            "axial load on the nut",
            hint="positive where a positive speed lifts it",
            usual=(-1e7, 1e7),
        ),
    ]
    screw_speed: Annotated[
        AngularSpeed,
        Info(r"\omega", "speed of the screw", "rpm", hint="in rad/s in Python", usual=(-2000.0, 2000.0)),
    ]
    #: The temperature at which an oil of a grade is taken, K. In a case file it stands with the oil.
    temperature: Temperature | None = None

    def __post_init__(self) -> None:
        faults = [*self._without_labels(), *faults_of("operation", self)]
        if not faults and is_concrete(self.screw_speed) and abs(self.screw_speed) > FASTEST:
            given = f"{float(self.screw_speed):g} rad/s"
            faults.append(
                Fault("operation.screw_speed", "is beyond all numbers of the formulas", given, "check its unit")
            )
        raise_if_any(faults)

    def _without_labels(self) -> list[Fault]:
        """Replace labelled arrays by their values, and return the faults of those that these are not enough for."""
        labelled = {name: value for name, value in vars(self).items() if hasattr(value, "dims")}
        if not labelled:
            return []
        units = {name: quantity.unit for name, quantity in fields_of(self).items()}
        faults = [fault_of_declared_unit(f"operation.{name}", value, units[name]) for name, value in labelled.items()]
        for name, value in labelled.items():
            object.__setattr__(self, name, value.data)
        dimensions = dict.fromkeys(str(value.dims) for value in labelled.values() if value.dims)
        if len(dimensions) > 1:
            given = " and ".join(dimensions)
            faults.append(Fault("operation", "has arrays along different dimensions", given, USE_SWEEP))
        return [fault for fault in faults if fault is not None]

    @property
    def settled(self) -> OperatingState:
        """The same state as the formulas take it; see :func:`settled`."""
        load, speed = settled(self.axial_load), settled(self.screw_speed)
        if not is_concrete(speed):
            speed = where(abs(speed) <= FASTEST, speed, np.nan)
        if load is self.axial_load and speed is self.screw_speed:
            return self
        return OperatingState(load, speed, self.temperature)


def settled(values: Array) -> Array:
    """Loads or speeds of which those nearer to zero than :data:`NOTHING` are zero."""
    if isinstance(values, np.float64) and not abs(values) < NOTHING:
        return values
    return where(abs(values) < NOTHING, 0.0, values)


class ElementFriction(Protocol):
    """Friction that an axis needs to know of an element at an operating state."""

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
