"""Mounting of a screw, and its permissible limits."""

from __future__ import annotations

import dataclasses
import enum
import math
from typing import Annotated, Any, cast

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, faults_of, raise_if_any
from ballscrew.basis.quantities import Array, Density, DiameterSpeed, Info, Length, Pressure, Ratio, Stiffness, Unit
from ballscrew.physics.components.materials import STEEL_DENSITY


class Ends(enum.Enum):
    """End fixity of the shaft, with its coefficients of buckling and critical speed.

    The numbers are the least roots x of a uniform beam (TimoshenkoGere1961, Timoshenko1974). Buckling: sin(x/2) = 0,
    tan x = x, sin x = 0, cos x = 0. Whirling: cos x cosh x = 1, tan x = tanh x, sin x = 0, cos x cosh x = -1.
    """

    FIXED_FIXED = (2 * math.pi, 4.730040744862704)
    FIXED_SUPPORTED = (4.493409457909064, 3.926602312047919)
    SUPPORTED_SUPPORTED = (math.pi, math.pi)
    FIXED_FREE = (math.pi / 2, 1.8751040687119611)

    def __init__(self, buckling_root: float, whirling_root: float) -> None:
        self.buckling_root = buckling_root
        self.whirling_root = whirling_root

    @property
    def words(self) -> str:
        """Name as it is said, ``fixed–supported``."""
        return self.name.lower().replace("_", "–")


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Installation(ByValue):
    """A mounted screw. The default density is that of steel.

    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, and for ends that are not
    :class:`Ends`.
    """

    unsupported_length: Annotated[
        Length,
        Info(
            "l",
            "length of the shaft between its bearings",
            "mm",
            above=0,
            hint="bearing to bearing",
            usual=(0.01, 20.0),
        ),
    ]
    ends: Ends
    shaft_density: Annotated[
        Density,
        Info(
            r"\rho_s", "density of the shaft", "kg/m^3", above=0, hint="steel has 7850 kg/m^3", usual=(1500.0, 20000.0)
        ),
    ] = STEEL_DENSITY
    bearing_rigidity: Annotated[
        Stiffness | None,
        Info(
            "R_b",
            "axial rigidity of the support bearing at a fixed end",
            "N/um",
            above=0,
            hint="catalogues of bearings have 300 N/um to 3000 N/um",
            usual=(1e7, 1e11),
        ),
    ] = None
    mount_rigidity: Annotated[
        Stiffness | None,
        Info(
            "R_m",
            "axial rigidity of housings and brackets, of bearings and nut in series",
            "N/um",
            above=0,
            hint="300 N/um to 3000 N/um: by finite elements, or measured",
            usual=(1e6, 1e11),
        ),
    ] = None
    accuracy_factor: Annotated[
        Ratio | None,
        Info(
            "f_{ar}",
            "share of the rigidity of the nut that its accuracy grade leaves, ISO 3408-4",
            above=0,
            at_most=1,
            hint="0.5 to 0.6",
        ),
    ] = None

    def __post_init__(self) -> None:
        faults = faults_of("installation", self, optional=("bearing_rigidity", "mount_rigidity", "accuracy_factor"))
        if not isinstance(cast("Any", self.ends), Ends):
            known = ", ".join(f"Ends.{ends.name}" for ends in Ends)
            faults.append(Fault("installation.ends", "must be one of Ends", repr(self.ends), f"known: {known}"))
        raise_if_any(faults)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Limits(ByValue):
    """Permissible shares of the limits, and the required life.

    Defaults, all of THK514E: a static safety of 2, its least for loads without shocks (5 with them); a stress of
    147 MPa; half of the buckling load; 0.8 of the critical speed. No running time is asked for by default, and the DN
    value is held against that of the make of the nut, or a general one (:mod:`ballscrew.physics.sizing.rules`).
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    static_safety: Annotated[
        Ratio, Info("S_0", "least static rating against the largest load", above=0, hint="2, with shocks 5")
    ] = 2.0
    running_time: Annotated[
        Array | None, Unit("s"), Info("t", "required basic rating life L10h", "h", above=0, hint="20000 h is common")
    ] = None
    shaft_stress: Annotated[
        Pressure, Info(r"\sigma", "largest stress in the shaft", "MPa", above=0, hint="catalogues have 147 MPa")
    ] = 147e6
    buckling_safety: Annotated[
        Ratio, Info("S_k", "least buckling load against the largest load", at_least=1, hint="catalogues have 2")
    ] = 2.0
    critical_speed_share: Annotated[
        Ratio, Info("s_k", "largest share of the critical speed", above=0, at_most=1, hint="catalogues have 0.8")
    ] = 0.8
    diameter_speed_product: Annotated[
        DiameterSpeed | None,
        Info(
            "V",
            "largest DN value, pitch circle diameter times speed",
            "mm rpm",
            above=0,
            hint='standard nuts have "70000 mm rpm"; left out: that of the make of the row, or a general one',
        ),
    ] = None

    def __post_init__(self) -> None:
        raise_if_any(faults_of("limits", self, optional=("running_time", "diameter_speed_product")))
