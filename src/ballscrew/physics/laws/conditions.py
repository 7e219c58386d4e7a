"""Conditions of a ball–race contact: the one argument of all its laws."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, NamedTuple, TypeVar

from ballscrew.basis.arrays import lazy, namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Pressure, Ratio, Speed
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.equations import film, hertz, rheology, slip

C = TypeVar("C", bound="ContactConditions")


class HertzShape(NamedTuple):
    """Coefficients of a Hertz contact, and the largest radii ratio they are good for."""

    major: Ratio
    minor: Ratio
    ellipticity: Ratio
    largest_radii_ratio: float


class Motion(NamedTuple):
    """Motion of a contact: rolling, and half of the spin and of the lateral slip of its ball."""

    entrainment_speed: Speed
    spin: AngularSpeed
    lateral_slip_speed: Speed


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class ContactConditions:
    """Geometry, load, motion and oil of a contact, and its film as soon as the film laws have made it.

    All laws of a contact take this one argument, in this order: inlet, film, film parameter, full film, friction,
    rolling, elastic resistance. What the laws before it have found, a law can read; before that it is None. What
    only some laws ask for is computed when asked.
    """

    contact_load: Annotated[Force, Info("Q", "normal load of the contact")]
    equivalent_modulus: Annotated[Pressure, Info("E'", "equivalent modulus of ball and race", "GPa")]
    rolling_radius: Annotated[Length, Info("R_x", "equivalent radius in the rolling direction", "mm")]
    transverse_radius: Annotated[Length, Info("R_y", "equivalent radius across the rolling direction", "mm")]
    radii_ratio: Annotated[Ratio, Info("k", "ratio of the equivalent radii R_y/R_x")]
    deformed_radius: Annotated[Length, Info("R_d", "radius of the deformed surface", "mm")]
    hertz: HertzShape
    material_parameter: Annotated[Ratio, Info("G", "dimensionless material parameter")]
    speed_parameter: Annotated[Ratio, Info("U", "dimensionless speed parameter")]
    load_parameter: Annotated[Ratio, Info("W", "dimensionless load parameter")]
    semi_major_axis: Annotated[Length, Info("a", "semi-axis of the ellipse across the rolling direction", "mm")]
    combined_roughness: Annotated[Length, Info(r"\sigma", "combined RMS roughness of ball and race", "um")]
    motion: Motion
    lubricant: Lubricant
    ball_diameter: Length
    ball_roughness: Length
    race_roughness: Length
    minimum_film_thickness: Annotated[Length, Info("h", "minimum film thickness", "um")] = None
    film_parameter: Annotated[Ratio, Info(r"\lambda", "film thickness / combined roughness")] = None
    inlet_film_factor: Annotated[Ratio, Info(r"\phi_T", "what the heat of the inlet leaves of the film")] = None
    #: What the oil at the inlet suffices for of the film.
    inlet_supply_factor: Ratio = 1.0
    #: Of the law in the slot ``full_film``; None where there is none, and the coefficient of the friction law counts.
    full_film_friction_coefficient: Ratio | None = None

    def extended(self, kind: type[C], /, **further: Any) -> C:
        """A fuller state: these conditions, with all that has been computed of them, and what is given.

        As ``dataclasses.replace``, but nothing that was computed when asked is computed twice.
        """
        state = object.__new__(kind)
        vars(state).update(vars(self))
        vars(state).update(further)
        return state

    @property
    def ellipticity(self) -> Annotated[Ratio, Info(r"\kappa", "ratio of the semi-axes a/b")]:
        """Ratio of the semi-axes a/b."""
        return self.hertz.ellipticity

    @lazy
    def semi_minor_axis(
        self,
    ) -> Annotated[Length, Info("b", "semi-axis of the ellipse along the rolling direction", "mm")]:
        """Semi-axis of the contact ellipse along the rolling direction."""
        return hertz.semi_axis(self.hertz.minor, self.rolling_radius, self.load_parameter)

    @lazy
    def maximum_pressure(self) -> Annotated[Pressure, Info("p_0", "maximum contact pressure", "GPa")]:
        """Maximum contact pressure."""
        return hertz.maximum_pressure(self.hertz.major, self.hertz.minor, self.equivalent_modulus, self.load_parameter)

    @lazy
    def mean_pressure(self) -> Annotated[Pressure, Info("p_m", "mean contact pressure", "GPa")]:
        """Mean contact pressure."""
        return hertz.mean_pressure(self.maximum_pressure)

    @lazy
    def nominal_sliding_speed(self) -> Annotated[Speed, Info("u_s", "sliding speed before equilibrium is known, RMS")]:
        """Sliding speed over the ellipse before the equilibrium is known."""
        v, spin, lateral = self.motion
        curvature = slip.curvature_slip_speed(self.semi_major_axis, self.deformed_radius, v / self.rolling_radius)
        return slip.nominal_sliding_speed(curvature, spin * self.semi_major_axis, lateral, self.hertz.ellipticity)

    @lazy
    def thermal_loading_parameter(self) -> Annotated[Ratio, Info("L", "heat of the inlet against its conduction")]:
        """Heat of the shear in the inlet against what the oil conducts away."""
        oil = self.lubricant
        return rheology.thermal_loading_parameter(
            oil.viscosity, oil.temperature_coefficient, self.motion.entrainment_speed, oil.thermal_conductivity
        )

    @lazy
    def central_film_thickness(
        self,
    ) -> Annotated[Length, Info("h_c", "central film thickness, inlet cool and full", "um")]:
        """Central film thickness by HamrockDowson1977; none at rest."""
        v = self.motion.entrainment_speed
        thickness = film.central_film_thickness(
            self.rolling_radius,
            self.speed_parameter,
            self.material_parameter,
            self.load_parameter,
            self.hertz.ellipticity,
        )
        return namespace(v, thickness).where(v == 0, 0.0, thickness)
