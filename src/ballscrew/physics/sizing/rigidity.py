"""Axial rigidity by ISO 3408-4: nut, shaft, support bearings, and the deflection of the whole drive."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import as_array, namespace, where
from ballscrew.basis.errors import (
    Fault,
    accepts_units,
    holds_somewhere,
    is_concrete,
    plain,
    raise_if_any,
    shown,
)
from ballscrew.basis.quantities import Force, Info, Length, Ratio, Stiffness
from ballscrew.physics.components.nut import Nut, OversizeBallNut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import rigidity
from ballscrew.physics.sizing.installation import Ends, Installation
from ballscrew.physics.sizing.makers_tables import Source, factor_of_make, factors_of_standard
from ballscrew.physics.solvers.load_distribution import pair_load_deflection, preload_of

#: Outer diameters of nuts by DIN 69051-5, m, by nominal diameter: for leads below COARSE_LEAD, and from there on.
#: HIWIN2017, table 5.5 (double nuts DDB). TBI MOTION prints the same for its nuts "DIN 69051 form B".
DIN_69051_5 = {
    0.016: (0.028, 0.028),
    0.020: (0.036, 0.036),
    0.025: (0.040, 0.040),
    0.032: (0.050, 0.050),
    0.040: (0.063, 0.063),
    0.050: (0.075, 0.075),
    0.063: (0.090, 0.095),
    0.080: (0.105, 0.125),
}
COARSE_LEAD = 0.020
#: Factors for accuracy that ISO 3408-4 has by grade, greatest and least; as recalled, the default of nothing.
RECALLED_ACCURACY_FACTORS = factors_of_standard()[:2]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class AxialRigidity:
    """Outcome: the rigidities that ISO 3408-4 defines, and the deflection of a drive. NaN is what is not known.

    Not the rigidity of the balls one by one, which is :attr:`~ballscrew.physics.friction.result.FrictionResult.loads`.
    """

    balls_and_tracks: Annotated[Stiffness, Info("R_{b/t}", "rigidity of balls and tracks, R_b/t", "N/um")]
    widening: Annotated[Stiffness, Info("R_{n/s}", "rigidity by the widening of nut and shaft, R_n/s", "N/um")]
    nut: Annotated[Stiffness, Info("R_{nu}", "rigidity of the nut by ISO 3408-4, R_nu", "N/um")]
    nut_corrected: Annotated[
        Stiffness, Info("R_{nu,ar}", "rigidity of the nut corrected for accuracy, R_nu,ar", "N/um")
    ]
    shaft: Annotated[Stiffness, Info("R_s", "rigidity of the shaft where it is least", "N/um")]
    bearings: Annotated[Stiffness, Info("R_b", "rigidity of the support bearings", "N/um")]
    drive: Annotated[
        Stiffness, Info("R", "rigidity of nut, shaft and bearings in series, where the shaft is softest", "N/um")
    ]
    deflection: Annotated[Length, Info("x", "axial deflection of nut, shaft and bearings by the load", "um")]
    #: Number that turns R_nu into R_nu,ar, given or of the make of the nut; None where neither is known.
    accuracy_factor: float | None = None
    #: Kind of source of the factor of a make, "read", "recalled" or "estimate"; None for one that was given.
    accuracy_factor_source: Source | None = None
    #: In words, what stands for what was not given, and what could not be read in a source.
    assumed: Sequence[str] = ()


class _Sizes(NamedTuple):
    """Sizes that the widening depends on besides the screw."""

    nut_outer_diameter: Length
    assumed: Sequence[str]


@accepts_units("rigidity")
def rigidity_iso3408(
    screw: BallScrew,
    *,
    axial_load: Force | None = None,
    nut_outer_diameter: Length | None = None,
    nominal_diameter: Length | None = None,
    accuracy_factor: Ratio | None = None,
    installation: Installation | None = None,
    distance_to_bearing: Length | None = None,
    make: str = "",
) -> AxialRigidity:
    """Rigidity of a screw with its nut by ISO 3408-4, of its shaft, and the deflection of the drive under a load.

    Returns an :class:`AxialRigidity` of ``screw``, with one number for each rigidity, N/m. A nut without preload needs
    ``axial_load`` (N): its rigidity is load over deflection. Without ``nut_outer_diameter`` (m) that of the nut's
    bodies is taken, or else that of DIN 69051-5 for the ``nominal_diameter`` (m), by default the pitch circle
    (:func:`usual_nut_outer_diameter`). ``accuracy_factor`` is f_ar, by the accuracy grade, by default that of the
    installation, or else that of the ``make`` of the nut where it is known
    (:mod:`~ballscrew.physics.sizing.rules`); without it R_nu,ar is NaN, and the drive has R_nu. The shaft
    is that of ``installation``; ``distance_to_bearing`` (m) is from the nut to the bearing that holds the shaft, by
    default where the shaft gives way most: its whole length held at one end, half of it held at both. The contact
    angle stays that without load.

    The formulas are elementwise: values that are recorded give rigidities that are recorded, and what is assumed
    because of a value is then not said. Ends, and what is given at all, are no values.

    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """
    nut = screw.nut
    if accuracy_factor is None and installation is not None:
        accuracy_factor = installation.accuracy_factor
    raise_if_any(_faults(screw, nut_outer_diameter, accuracy_factor, axial_load, installation, distance_to_bearing))
    size = _outer_diameter(screw, nut, nut_outer_diameter, nominal_diameter)
    of_make = factor_of_make(make) if accuracy_factor is None else None
    preload = as_array(preload_of(screw, nut))
    assumed = list(size.assumed)
    load = abs(as_array(0.0 if axial_load is None else axial_load))
    with np.errstate(all="ignore"):
        R_bt, of_body = _balls_and_tracks(screw, preload, load), _widening(screw, size.nut_outer_diameter)
    R_ns = where(preload > 0, 2 * of_body, of_body)
    if holds_somewhere(R_ns != R_ns):
        assumed.append("no rigidity of the nut: the usual one has no wall around these balls, give nut_outer_diameter")
    if holds_somewhere(preload > 0):
        assumed.append("R_b/t up to the load that relieves one half, as ISO 3408-4 is recalled; it was not read")
        if holds_somewhere(load > 2**1.5 * preload):
            assumed.append(
                "the load is beyond that which relieves one half: "
                "there only one half carries, and just beyond that load the nut is softer than R_nu says"
            )
    elif holds_somewhere(load == 0):
        assumed.append("no rigidity of the nut: without preload it takes a load")
    if isinstance(nut, OversizeBallNut):
        assumed.append(
            "widening of a nut with oversize balls as of two halves; a ball on both flanks widens it less under load"
        )
    R_nu = rigidity.series_rigidity(R_bt, R_ns)
    factor = None if accuracy_factor is None else plain(accuracy_factor)
    source: Source | None = None
    if of_make is not None and not holds_somewhere(R_nu != R_nu):
        factor, source = of_make.value, of_make.source
        assumed.append(of_make.words)
    corrected = np.nan if factor is None else rigidity.rigidity_corrected_for_accuracy(factor, R_nu)
    R_s, R_b, words = _shaft(screw, installation, distance_to_bearing)
    assumed += words
    if factor is None and installation is not None:
        assumed.append("drive with R_nu, not R_nu,ar: no accuracy factor is given")
    compliances = (1 / (R_nu if factor is None else corrected), 1 / R_s, 0.0 if R_b is None else 1 / R_b)
    drive = 1 / sum(compliances)
    return AxialRigidity(
        balls_and_tracks=plain(R_bt),
        widening=plain(R_ns),
        nut=plain(R_nu),
        nut_corrected=plain(corrected),
        shaft=plain(R_s),
        bearings=np.nan if R_b is None else plain(R_b),
        drive=plain(drive),
        deflection=np.nan if axial_load is None else plain(axial_load / drive),
        accuracy_factor=factor,
        accuracy_factor_source=source,
        assumed=tuple(assumed),
    )


def usual_nut_outer_diameter(nominal_diameter: Length, lead: Length) -> Length:
    """Outer diameter of the nut by DIN 69051-5; between its sizes a line, beyond them the wall of the last one."""
    fine, coarse = ([each[column] - size for size, each in DIN_69051_5.items()] for column in (0, 1))
    size = as_array(nominal_diameter)
    return plain(size + where(as_array(lead) >= COARSE_LEAD, _wall(size, coarse), _wall(size, fine)))


# -- parts ----------------------------------------------------------------------------------------


def loaded_length(screw: BallScrew) -> Length:
    """Axial length of the thread that the loaded balls of one nut body fill: whole balls in each turn."""
    phi = screw.lead_angle
    xp = namespace(screw.pitch_circle_diameter, screw.ball_diameter, phi)
    turn = xp.floor(xp.pi * screw.pitch_circle_diameter / (screw.ball_diameter * xp.cos(phi)))
    return screw.loaded_balls / turn * screw.lead / screw.starts


def _wall(size: Length, walls: Sequence[float]) -> Length:
    """Twice the wall of a nut of some size, by those of the sizes of :data:`DIN_69051_5`."""
    sizes = list(DIN_69051_5)
    wall = walls[-1]
    for low, high, of_low, of_high in zip(sizes[-2::-1], sizes[:0:-1], walls[-2::-1], walls[:0:-1], strict=True):
        wall = where(size < high, of_low + (of_high - of_low) / (high - low) * (size - low), wall)
    return where(size < sizes[0], walls[0], wall)


def _balls_and_tracks(screw: BallScrew, preload: Force, load: Force) -> Stiffness:
    """R_b/t of a preloaded nut, or at the load of one without preload; NaN without both."""
    alpha, phi = screw.contact_angle, screw.lead_angle
    xp = namespace(alpha, phi)
    lever = xp.sin(alpha) * xp.cos(phi)
    force = where(preload > 0, preload, load)
    approach = (force / (screw.carrying_balls * pair_load_deflection(screw) * lever)) ** (2 / 3)
    preloaded = rigidity.preloaded_ball_track_rigidity(preload, approach / lever)
    return where(preload > 0, preloaded, where(load > 0, rigidity.ball_track_rigidity(load, approach / lever), np.nan))


def _widening(screw: BallScrew, nut_outer_diameter: Length) -> Stiffness:
    """R_n/s of one nut body; NaN for one without a wall around the balls."""
    inside = _nut_force_diameter(screw)
    compliance = rigidity.radial_compliance(
        nut_outer_diameter,
        inside,
        screw.nut_material.young_modulus,
        screw.nut_material.poisson_ratio,
        screw.screw_material.young_modulus,
        screw.screw_material.poisson_ratio,
    )
    stiffness = rigidity.radial_stiffness(compliance, loaded_length(screw))
    widening = rigidity.widening_rigidity(stiffness, screw.contact_angle, screw.lead_angle)
    return where(nut_outer_diameter > inside, widening, np.nan)


def _nut_force_diameter(screw: BallScrew) -> Length:
    return rigidity.nut_force_diameter(screw.pitch_circle_diameter, screw.ball_diameter, screw.contact_angle)


def _shaft(
    screw: BallScrew, installation: Installation | None, distance: Length | None
) -> tuple[Stiffness, Stiffness | None, Sequence[str]]:
    """Rigidity of shaft and of bearings, and what is assumed; NaN and None where they are not known."""
    if installation is None:
        return np.nan, None, ()
    E, l = screw.screw_material.young_modulus, installation.unsupported_length  # noqa: E741  (l is the formula's letter)
    d_c = rigidity.shaft_force_diameter(screw.pitch_circle_diameter, screw.ball_diameter, screw.contact_angle)
    both = installation.ends is Ends.FIXED_FIXED
    at = distance if distance is not None else l / 2 if both else l
    assumed: list[str] = []
    if distance is None:
        assumed.append(
            "nut in the middle of the shaft, where it gives way most"
            if both
            else "nut at the end of the shaft, where it gives way most"
        )
    if installation.ends is Ends.SUPPORTED_SUPPORTED:
        assumed.append("one of the two supports holds the shaft axially")
    R_s = (
        rigidity.shaft_rigidity_held_at_both_ends(E, d_c, at, l)
        if both
        else rigidity.shaft_rigidity_held_at_one_end(E, d_c, at)
    )
    if installation.bearing_rigidity is None:
        return R_s, None, [*assumed, "support bearings rigid: no rigidity of theirs is given"]
    R_b = installation.bearing_rigidity
    if not both:
        return R_s, R_b, assumed
    # each stretch of the shaft with its bearing; what they give more than the shaft alone is that of the bearings
    stretches = [rigidity.shaft_rigidity_held_at_one_end(E, d_c, part) for part in (at, l - at)]
    together = sum(rigidity.series_rigidity(stretch, R_b) for stretch in stretches)
    return R_s, 1 / (1 / together - 1 / R_s), assumed


def _outer_diameter(screw: BallScrew, nut: Nut, given: Length | None, nominal: Length | None) -> _Sizes:
    """The outer diameter of the nut: given, of its bodies, or of the standard's series."""
    of_bodies = None if nut.bodies is None else nut.bodies.nut_outer_diameter
    known = of_bodies if given is None else given
    if known is not None:
        return _Sizes(known, ())
    size = screw.pitch_circle_diameter if nominal is None else nominal
    usual = usual_nut_outer_diameter(size, screw.lead)
    if not (is_concrete(size) and is_concrete(usual)):
        return _Sizes(usual, ())
    is_listed = min(DIN_69051_5) <= size <= max(DIN_69051_5)
    of_wall = "" if is_listed else ", its last size with the same wall"
    return _Sizes(usual, (f"nut {1000 * usual:.4g} mm wide, DIN 69051-5{of_wall}: none is given",))


def _numbers(screw: BallScrew) -> tuple[Any, ...]:
    """Values that have to be one number of a screw and its nut."""
    nut = screw.nut
    given = (getattr(nut, "preload", None), getattr(nut, "oversize", None))
    whole = (screw.loaded_balls, screw.lead, screw.contact_angle, screw.ball_diameter, screw.pitch_circle_diameter)
    return *whole, *(number for number in given if number is not None)


def _fails(mask: Any) -> bool:
    """Return whether a condition fails; False for one of a value that is only being recorded."""
    return holds_somewhere(np.logical_not(mask))


def _faults(
    screw: BallScrew,
    outer: Length | None,
    factor: Ratio | None,
    load: Force | None,
    installation: Installation | None,
    distance: Length | None,
) -> list[Fault]:
    faults: list[Fault] = []
    if any(isinstance(number, list | tuple) or getattr(number, "ndim", 0) for number in _numbers(screw)):
        faults.append(Fault("rigidity.screw", "must be one screw", "an array", "call once for each"))
        return faults
    least = _nut_force_diameter(screw)
    if outer is not None and _fails(outer > least):
        remedy = f"more than {least:.6g} m, where the balls press on it"
        faults.append(
            Fault("rigidity.nut_outer_diameter", "leaves no wall around the balls", shown(outer, "m"), remedy)
        )
    if factor is not None and (_fails(factor > 0) or _fails(factor <= 1)):
        faults.append(Fault("rigidity.accuracy_factor", "must be above 0 and at most 1", f"{factor:g}", "0.5 to 0.6"))
    if load is not None and _fails(np.isfinite(load)):
        faults.append(Fault("rigidity.axial_load", "must be a finite number", f"{load:g}", "give a force"))
    if distance is not None:
        if installation is None:
            faults.append(Fault("rigidity.distance_to_bearing", "has no shaft", "", "give an installation, too"))
        elif _fails(distance > 0) or _fails(
            distance < installation.unsupported_length
            if installation.ends is Ends.FIXED_FIXED
            else distance <= installation.unsupported_length
        ):
            length = shown(installation.unsupported_length, "m")
            faults.append(
                Fault("rigidity.distance_to_bearing", "must lie on the shaft", shown(distance, "m"), f"below {length}")
            )
    return faults
