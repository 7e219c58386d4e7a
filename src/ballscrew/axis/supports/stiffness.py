"""The stiffness chain of an axis over its stroke: shaft, nut, bearings, mount and twist, and what the shaft stands."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Sequence
from typing import Annotated, Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from ballscrew.axis.supports import formulas
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.errors import Fault, accepts_units, is_concrete, raise_if_any, shown
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Ratio, Stiffness
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry, presliding, rigidity, shaft
from ballscrew.physics.sizing.installation import Ends, Installation
from ballscrew.physics.sizing.rigidity import rigidity_iso3408

Matrix = NDArray[np.float64]

#: Elements of each of the two stretches: the roots are good to 1e-6.
ELEMENTS = 24
#: Which of the two ends are held against sliding sideways and against turning.
_HELD = {
    Ends.FIXED_FIXED: ((True, True), (True, True)),
    Ends.FIXED_SUPPORTED: ((True, True), (True, False)),
    Ends.SUPPORTED_SUPPORTED: ((True, False), (True, False)),
    Ends.FIXED_FREE: ((True, True), (False, False)),
}


@functools.cache
def whirling_root(ends: Ends, share: float, *, nut_holds_slope: bool = False) -> float:
    """Root of the lowest bending vibration of a shaft whose nut is at a share of its length, 0 to 1."""
    stiffness, mass, _ = _beam(ends, share, nut_holds_slope)
    least: Any = eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 0])
    return float(least[0]) ** 0.25


@functools.cache
def buckling_root(ends: Ends, share: float, *, nut_holds_slope: bool = False) -> float:
    """Root of the load of the nut, at a share of the length, under which the shaft buckles, for the whole length.

    One bearing, the first, holds the load; of a shaft that is fixed at both ends each holds its part of it, and the
    worse of the two directions counts. The stretch that is pulled is not counted as stiffer.
    """
    stiffness, _, compressed = _beam(ends, share, nut_holds_slope)
    both = ends is Ends.FIXED_FIXED
    parts = (1 - share, share) if both else (1.0,)
    roots = [
        _root(part * by_load, stiffness) for part, by_load in zip(parts, compressed, strict=False) if np.any(by_load)
    ]
    return min(roots)


def _root(by_load: Matrix, stiffness: Matrix) -> float:
    last = len(stiffness) - 1
    result: Any = eigh(by_load, stiffness, eigvals_only=True, subset_by_index=[last, last])
    return 1 / math.sqrt(float(result[0])) if result[0] > 0 else math.inf


def _beam(ends: Ends, share: float, nut_holds_slope: bool) -> tuple[Matrix, Matrix, tuple[Matrix, Matrix]]:
    """Matrices of stiffness, mass, and of a unit push in each stretch, of a beam of unit length, held as it is."""
    lengths = [length for length in (share, 1 - share) if length > 0]
    places = ELEMENTS * len(lengths) + 1
    stiffness, mass = np.zeros((2, 2 * places, 2 * places))
    pushed = np.zeros((2, 2 * places, 2 * places))
    for stretch, length in enumerate(lengths):
        h = length / ELEMENTS
        bent, heavy, tipped = _element(h)
        for first in range(stretch * ELEMENTS, (stretch + 1) * ELEMENTS):
            own = slice(2 * first, 2 * first + 4)
            stiffness[own, own] += bent
            mass[own, own] += heavy
            # with the nut at the first bearing the only stretch is the second
            pushed[stretch + (share <= 0), own, own] += tipped
    held = np.zeros((places, 2), dtype=bool)
    held[0], held[-1] = _HELD[ends]
    nut = 0 if share <= 0 else ELEMENTS
    held[nut] |= (True, nut_holds_slope)
    free = np.flatnonzero(~held.ravel())
    at = np.ix_(free, free)
    return stiffness[at], mass[at], (cast("Matrix", pushed[0][at]), cast("Matrix", pushed[1][at]))


def _element(h: float) -> tuple[Matrix, Matrix, Matrix]:
    """Stiffness, consistent mass and effect of a push of a cubic beam element of a length, for unit EI and ρA."""
    bent = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / h**3
    heavy = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * h / 420
    tipped = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / (30 * h)
    turned = np.array([1, h, 1, h])
    scale = np.outer(turned, turned)
    return bent * scale, heavy * scale, tipped * scale


#: Places of the nut where none are given, as shares of the shaft.
SHARES = np.linspace(0.05, 0.95, 19)

Numbers = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class AxisStiffness(ByValue):
    """Stiffness of the parts between the motor and the table, at places of the nut; NaN or infinite where not known.

    Compliances add: nut, shaft, bearings, mount and twist carry the same force, one behind the other.
    """

    position: Annotated[Length, Info("l_1", "distance of the nut from the fixed bearing, where the motor is", "mm")]
    nut: Annotated[Stiffness, Info("R_{nu}", "rigidity of the nut", "N/um")]
    shaft: Annotated[Stiffness, Info("R_s", "axial rigidity of the shaft", "N/um")]
    bearings: Annotated[Stiffness, Info("R_b", "rigidity of the support bearings; infinite: not given", "N/um")]
    mount: Annotated[Stiffness, Info("R_m", "rigidity of housings and brackets; infinite: not given", "N/um")]
    torsion: Annotated[Stiffness, Info("R_t", "axial rigidity by the twist of the shaft", "N/um")]
    #: The root diameter and the material of the shaft, and how it is held.
    root_diameter: Length
    screw: BallScrew
    installation: Installation
    nut_holds_slope: bool = False
    #: In words, what stands for what was not given.
    assumed: Sequence[str] = ()

    @lazy
    def total(self) -> Annotated[Stiffness, Info("R", "rigidity between motor and table", "N/um")]:
        """All in series."""
        return 1 / sum(1 / part for part in self.parts.values())

    @property
    def parts(self) -> dict[str, Numbers]:
        """The springs of the chain by name."""
        return {name: getattr(self, name) for name in ("nut", "shaft", "bearings", "mount", "torsion")}

    @property
    def shares(self) -> dict[str, Numbers]:
        """Share of each spring in the whole deflection; they sum to one."""
        return {name: self.total / part for name, part in self.parts.items()}

    @accepts_units("stiffness")
    def lost_motion(self, friction_force: Force) -> Length:
        """Way lost at a reversal by a friction force of the table, twice the force over the rigidity, m."""
        return formulas.lost_motion(friction_force, self.total)

    @lazy
    def critical_speed(self) -> Annotated[AngularSpeed, Info("n_k", "critical speed of the shaft", "rpm")]:
        """Lowest critical speed of the shaft, held by its bearings and by the nut, rad/s."""
        roots = np.array([whirling_root(self.installation.ends, share, **self._slope) for share in self._shares])
        E, rho = self.screw.screw_material.young_modulus, self.installation.shaft_density
        return shaft.critical_speed(roots, E, rho, self.root_diameter, self.installation.unsupported_length)

    @lazy
    def buckling_load(self) -> Annotated[Force, Info("F_k", "load at which the shaft buckles", "kN")]:
        """Least load of the nut under which the shaft buckles, Euler's, N."""
        roots = np.array([buckling_root(self.installation.ends, share, **self._slope) for share in self._shares])
        E, d_r = self.screw.screw_material.young_modulus, self.root_diameter
        return shaft.buckling_load(roots, E, d_r, self.installation.unsupported_length)

    @property
    def without_nut(self) -> tuple[AngularSpeed, Force]:
        """Critical speed and buckling load of the shaft held by its bearings alone, as the checks have them."""
        E, d_r, held = self.screw.screw_material.young_modulus, self.root_diameter, self.installation
        length, rho = held.unsupported_length, held.shaft_density
        speed = shaft.critical_speed(held.ends.whirling_root, E, rho, d_r, length)
        return speed, shaft.buckling_load(held.ends.buckling_root, E, d_r, length)

    @property
    def _shares(self) -> list[float]:
        return [float(share) for share in np.ravel(self.position) / self.installation.unsupported_length]

    @property
    def _slope(self) -> dict[str, bool]:
        return {"nut_holds_slope": self.nut_holds_slope}


@accepts_units("stiffness")
def stiffness_over_stroke(
    screw: BallScrew,
    *,
    installation: Installation,
    positions: Length | None = None,
    axial_load: Force | None = None,
    mount_rigidity: Stiffness | None = None,
    root_diameter: Length | None = None,
    nut_outer_diameter: Length | None = None,
    nominal_diameter: Length | None = None,
    accuracy_factor: Ratio | None = None,
    make: str = "",
    nut_holds_slope: bool = False,
) -> AxisStiffness:
    """The springs between motor and table at places of the nut, by ISO 3408-4's parts, and what the shaft stands there.

    The first bearing, at the motor, is the fixed one; ``positions`` are distances from it, and the length of the
    ``installation`` is that between the bearings. Nut, shaft and bearings are those of
    :func:`~ballscrew.physics.sizing.rigidity.rigidity_iso3408` (R_nu,ar with an accuracy factor, or that
    of the ``make`` of the nut where it is known); a nut without preload needs an ``axial_load``.
    ``mount_rigidity`` is that of housings and brackets in series, by default the installation's. Sideways the nut is a
    support that lets the shaft turn, the safe side; ``nut_holds_slope`` clamps it. Between two fixed bearings the
    twist is that from the motor's side, too.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """
    length = float(installation.unsupported_length)
    mount_rigidity = installation.mount_rigidity if mount_rigidity is None else mount_rigidity
    places = np.atleast_1d(np.asarray(length * SHARES if positions is None else positions, dtype=float))
    raise_if_any(_faults(places, length, mount_rigidity, root_diameter))
    given: dict[str, Any] = {
        "axial_load": axial_load,
        "nut_outer_diameter": nut_outer_diameter,
        "nominal_diameter": nominal_diameter,
        "accuracy_factor": accuracy_factor,
        "make": make,
        "installation": installation,
    }
    values = [rigidity_iso3408(screw, **given, distance_to_bearing=float(place)) for place in places]
    factor = values[0].accuracy_factor
    nut = np.array([each.nut if factor is None else each.nut_corrected for each in values])
    bearings = np.array([math.inf if math.isnan(each.bearings) else each.bearings for each in values])
    material = screw.screw_material
    d_c = rigidity.shaft_force_diameter(screw.pitch_circle_diameter, screw.ball_diameter, screw.contact_angle)
    G = presliding.shear_modulus(material.young_modulus, material.poisson_ratio)
    twist = formulas.shaft_torsional_rigidity(G, d_c, places)
    groove = geometry.groove_root_diameter(
        screw.pitch_circle_diameter, screw.ball_diameter, screw.screw_conformity, screw.contact_angle
    )
    assumed = [*values[0].assumed]
    if mount_rigidity is None:
        assumed.append("mount rigid: no rigidity of it is given")
    if not nut_holds_slope:
        assumed.append("the nut holds the shaft sideways and lets it turn")
    return AxisStiffness(
        position=places,
        nut=nut,
        shaft=np.array([each.shaft for each in values]),
        bearings=bearings,
        mount=np.full_like(places, math.inf if mount_rigidity is None else mount_rigidity),
        torsion=formulas.axial_rigidity_of_torsion(twist, screw.lead),
        root_diameter=groove if root_diameter is None else root_diameter,
        screw=screw,
        installation=installation,
        nut_holds_slope=nut_holds_slope,
        assumed=tuple(assumed),
    )


def _faults(places: Numbers, length: float, mount: Stiffness | None, root: Length | None) -> list[Fault]:
    faults: list[Fault] = []
    if not np.all((places > 0) & (places < length)):
        remedy = f"distances from the fixed bearing, below {shown(length, 'm')}"
        faults.append(Fault("stiffness.positions", "must lie on the shaft", "", remedy))
    for name, value, unit in (("mount_rigidity", mount, "N/m"), ("root_diameter", root, "m")):
        if value is not None and is_concrete(value) and not value > 0:
            faults.append(Fault(f"stiffness.{name}", "must be positive", shown(value, unit), "leave it out: not known"))
    return faults
