"""The operating state: load and speed with their signs, and the temperature."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew._arrays import ByValue
from ballscrew.errors import faults_of, names_keywords, raise_if_any
from ballscrew.quantities import AngularSpeed, Force, Info, Temperature


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class OperatingState(ByValue):
    """Operating state: axial load and speed of the screw with their signs, and the temperature of the oil.

    A positive load is one that a positive speed lifts. Zero load and zero speed are legal and give limits; without a
    temperature the oil has its own. Any of them may be an array. Raises :class:`~ballscrew.errors.InputError` for
    non-finite numbers.
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
        raise_if_any(faults_of("operation", self))
