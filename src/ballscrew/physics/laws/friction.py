"""Friction coefficients: the asperities that still touch, and the film that carries the rest."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue, namespace
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import ArealDensity, Info, Length, Pressure, Ratio, ShearRate, Viscosity
from ballscrew.physics.components.oil_grades import PARAFFINIC, LimitingShear
from ballscrew.physics.equations import friction, rheology
from ballscrew.physics.laws.conditions import ContactConditions
from ballscrew.physics.laws.traits import law_traits

#: Boundary friction between steel and steel before a film of reacted oil has grown (PCSTraction: 0.057 to 0.118).
FRESH_BOUNDARY_FRICTION = 0.06

Boundary = Annotated[
    Ratio,
    Info(
        r"\mu_0",
        "friction coefficient without a film",
        at_least=0,
        hint="boundary friction is 0.1 to 0.2",
        usual=(0.0, 1.0),
    ),
]
FullFilm = Annotated[
    Ratio,
    Info(r"\mu_f", "friction coefficient of the full film", at_least=0, hint="the paper has 0.02", usual=(0.0, 0.5)),
]
Decay = Annotated[Ratio, Info("B", "decay of the asperities' share", at_least=0, hint="the paper has 1.42")]
Exponent = Annotated[Ratio, Info("C", "exponent of the film parameter", above=0, hint="the paper has 0.8")]


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class ZhouHoeprich(ByValue):
    """Friction coefficient between the boundary and the full-film value, Olaru2005 §5 (23)–(26).

    After ZhouHoeprich1991. With the paper's coefficients the full-film value is reached at a film
    parameter of 1.83, not at 2.5 to 3 as its text says. The decay and its exponent belong to the
    surfaces; other published pairs are (2.32, 0.97), (1.90, 0.99) and (2.1, 0.85).
    Raises :class:`~ballscrew.basis.errors.InputError` for coefficients out of bounds.
    """

    boundary_friction_coefficient: Boundary = 0.2
    decay: Decay = 1.42
    exponent: Exponent = 0.8
    full_film_friction_coefficient: FullFilm = 0.02

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.friction", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient at the ``conditions`` of a contact."""
        mu_a = friction.asperity_friction_coefficient(
            conditions.film_parameter, self.boundary_friction_coefficient, self.decay, self.exponent
        )
        return friction.clamped_friction_coefficient(
            mu_a, self.boundary_friction_coefficient, _full_film(self, conditions)
        )


# -- load sharing ---------------------------------------------------------------------------------


@law_traits(alternative=True, new_surfaces=True)
@dataclasses.dataclass(frozen=True, eq=False)
class LoadSharing(ByValue):
    """Asperities and film share the load, ZhouHoeprich1991; no clamp.

    Boundary friction of 0.12 is what SKF2018 uses for rolling bearings in motion (0.15 at the
    start); the paper's 0.2 is high for steel and mineral oil. The film's 0.05 is what SKF2018 has for mineral
    oils (0.04 for synthetic ones, 0.1 for transmission fluids); the paper has 0.02. The pairs of decay and
    exponent are those of :class:`ZhouHoeprich`.
    """

    boundary_friction_coefficient: Boundary = 0.12
    decay: Decay = 1.42
    exponent: Exponent = 0.8
    full_film_friction_coefficient: FullFilm = 0.05

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.friction", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient."""
        share = friction.asperity_load_share_zhou_hoeprich(conditions.film_parameter, self.decay, self.exponent)
        return _shared(self, share, conditions)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class RunInSharing(ByValue):
    r"""Asperities and film share the load between surfaces that have run in to their film.

    Asperities that stand out of the film wear off, those below it do not: run in at the speed and load at hand, a
    contact has at least the film parameter at which wear ends, :math:`\lambda_r`. The share is that of
    ZhouHoeprich1991 at

    .. math:: \lambda_e = \left(\lambda^4 + \lambda_r^4\right)^{1/4} \frac{\lambda}{\lambda + \lambda_0}

    so that thick films are as before, and friction below :math:`\lambda_r` is nearly the same at all sizes, which is
    what the tables of vendors show (docs/validation). The default gives asperities a third of the load there. It
    was chosen by the trend of those tables with size, not by their mean; no measured value is known. At rest
    asperities carry everything, as in SKF2018: where the film parameter falls to :math:`\lambda_0`, below 1 rpm in
    usual screws, friction rises to the boundary value. Not for new surfaces: there :class:`LoadSharing` holds.
    """

    boundary_friction_coefficient: Boundary = 0.12
    decay: Decay = 1.42
    exponent: Exponent = 0.8
    full_film_friction_coefficient: FullFilm = 0.05
    run_in_film_parameter: Annotated[
        Ratio,
        Info(
            r"\lambda_r",
            "film parameter down to which surfaces wear in",
            at_least=0,
            hint="0.7; zero: as new where there is a film",
            usual=(0.0, 3.0),
        ),
    ] = 0.7
    lost_film_parameter: Annotated[
        Ratio,
        Info(
            r"\lambda_0",
            "film parameter below which run-in surfaces touch as new ones",
            above=0,
            hint="0.005: below 1 rpm",
            usual=(1e-4, 0.1),
        ),
    ] = 0.005

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.friction", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient."""
        # no share is left long before 1000, and without load the film parameter is infinite
        film_parameter = conditions.film_parameter
        bounded = namespace(film_parameter).minimum(film_parameter, 1000.0)
        worn = friction.run_in_film_parameter(bounded, self.run_in_film_parameter, self.lost_film_parameter)
        share = friction.asperity_load_share_zhou_hoeprich(worn, self.decay, self.exponent)
        return _shared(self, share, conditions)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class BalanSharing(ByValue):
    """Asperities and film share the load, Balan2015; its share is cut at a film parameter of 2."""

    boundary_friction_coefficient: Boundary = 0.12
    full_film_friction_coefficient: FullFilm = 0.05

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.friction", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient."""
        # no share is left beyond 2, and an infinite film, without load, would be infinity over infinity
        film_parameter = conditions.film_parameter
        bounded = namespace(film_parameter).minimum(film_parameter, 4.0)
        share = friction.asperity_load_share_balan(bounded)
        return _shared(self, share, conditions)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class GreenwoodTrippSharing(ByValue):
    """Asperities and film share the load, the asperities as elastic hills (GreenwoodTripp1970).

    The share is the pressure of the hills over what they have to carry: the mean pressure of the
    contact, or, where hills of that size could not carry it even with the mean planes in touch, their
    pressure at touch. So a dry contact is dry. With the defaults the hills carry some 0.1 GPa at most,
    so in a ball screw it is nearly always the second: the share is then a matter of the film
    parameter alone.
    """

    boundary_friction_coefficient: Boundary = 0.12
    full_film_friction_coefficient: FullFilm = 0.05
    asperity_density: Annotated[
        ArealDensity, Info("N", "number of asperities on an area", above=0, hint="ground steel has 1e9 to 1e11 1/m^2")
    ] = 1.3e10
    asperity_radius: Annotated[
        Length,
        Info(r"\beta", "radius of the tips of the asperities", "um", above=0, hint="ground steel has 5 to 50 um"),
    ] = 10e-6

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.friction", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient."""
        pressure, most = (
            friction.asperity_pressure(
                friction.asperity_contact_integral(separation),
                conditions.equivalent_modulus,
                self.asperity_density,
                self.asperity_radius,
                conditions.combined_roughness,
            )
            for separation in (conditions.film_parameter, 0.0)
        )
        xp = namespace(pressure, most)
        # above zero, so that no asperities against no load is none
        needed = xp.maximum(xp.minimum(conditions.mean_pressure, most), 1e-300)
        share = friction.asperity_load_share_greenwood_tripp(pressure, needed)
        return _shared(self, share, conditions)


_Friction = ZhouHoeprich | LoadSharing | RunInSharing | BalanSharing | GreenwoodTrippSharing


def _full_film(law: _Friction, conditions: ContactConditions) -> Ratio:
    """The film's own friction: from the law in its slot, where there is one, else the coefficient."""
    from_its_slot = conditions.full_film_friction_coefficient
    return law.full_film_friction_coefficient if from_its_slot is None else from_its_slot


def _shared(law: _Friction, asperity_load_share: Ratio, conditions: ContactConditions) -> Ratio:
    return friction.load_sharing_friction_coefficient(
        asperity_load_share, law.boundary_friction_coefficient, _full_film(law, conditions)
    )


# -- the film alone -------------------------------------------------------------------------------


@law_traits(alternative=True, reads_limiting_shear=True)
def arana_traction(conditions: ContactConditions) -> Ratio:
    r"""Friction of the film by the oil's own numbers, Arana2019: Eyring's law up to its limit of the shear stress.

    .. math:: \mu_f = \min\left(\frac{\tau_E}{p_m} \sinh^{-1}\left(\frac{\eta u_s}{\tau_E \phi_T h_c}\right),
        \Lambda\right), \quad \tau_E = \frac{2 \Lambda}{\alpha}

    The viscosity is that at the mean pressure, the coefficient in the Eyring stress that at the greatest one, both by
    the pressure modulus of the oil where that is known, else by Roelands1966; the film is the central one with the
    heat and the supply of its inlet. Said to be within 0.005 of friction measured between two discs (Arana2019, as
    quoted elsewhere).
    """
    oil, p_m, u_s = conditions.lubricant, conditions.mean_pressure, conditions.nominal_sliding_speed
    loaded, moving = p_m > 0, u_s > 0
    xp = namespace(p_m, u_s, loaded, moving)
    safe = xp.where(loaded, p_m, 1.0)
    # below 1 MPa, where a difference of viscosities is lost to rounding, the coefficient is that at 1 MPa
    greatest = xp.maximum(conditions.maximum_pressure, 1e6)
    alpha = rheology.secant_pressure_viscosity_coefficient(oil.viscosity, oil.viscosity_under(greatest), greatest)
    tau_E = friction.arana_eyring_stress(oil.limiting_shear_coefficient, alpha)
    rate = _shear_rate(conditions, conditions.inlet_film_factor * conditions.inlet_supply_factor)
    stress = friction.eyring_shear_stress(oil.viscosity_under(safe), rate, tau_E)
    limit = friction.limiting_shear_stress(safe, oil.limiting_shear_coefficient)
    return xp.where(loaded & moving, friction.film_friction_coefficient(xp.minimum(stress, limit), safe), 0.0)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class EyringTraction(ByValue):
    """Friction of the film from the mean shear rate and the mean pressure, Eyring's law with a limit.

    Viscosity under pressure by that of the oil (:meth:`~ballscrew.Lubricant.viscosity_under`); the stress is that of
    Eyring1936 but never above the limit of BairWiner1979. Both numbers are those of the law, not of the oil.
    """

    eyring_stress: Annotated[
        Pressure, Info(r"\tau_E", "Eyring stress of the oil", "MPa", above=0, hint="mineral oils have 2 to 10 MPa")
    ] = 5e6
    limiting_shear_coefficient: LimitingShear = PARAFFINIC

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.full_film", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient of the film."""
        p_m, moving = conditions.mean_pressure, conditions.nominal_sliding_speed > 0
        stress = friction.eyring_shear_stress(_film_viscosity(conditions), _shear_rate(conditions), self.eyring_stress)
        limit = friction.limiting_shear_stress(p_m, self.limiting_shear_coefficient)
        xp = namespace(p_m, moving, stress, limit)
        loaded = p_m > 0
        mu = friction.film_friction_coefficient(xp.minimum(stress, limit), xp.where(loaded, p_m, 1.0))
        return xp.where(loaded & moving, mu, 0.0)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class LimitingShearTraction(ByValue):
    """Friction of the film from the mean shear rate and the mean pressure, BairWiner1979."""

    limiting_shear_coefficient: LimitingShear = PARAFFINIC

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.full_film", self))

    def __call__(self, conditions: ContactConditions) -> Ratio:
        """Friction coefficient of the film."""
        p_m = conditions.mean_pressure
        xp = namespace(p_m)
        loaded = p_m > 0
        pressure = xp.where(loaded, p_m, 1.0)
        limit = friction.limiting_shear_stress(pressure, self.limiting_shear_coefficient)
        stress = friction.bair_winer_shear_stress(_film_viscosity(conditions), _shear_rate(conditions), limit)
        mu = friction.film_friction_coefficient(stress, pressure)
        return namespace(loaded, mu).where(loaded, mu, 0.0)


def _film_viscosity(conditions: ContactConditions) -> Viscosity:
    return conditions.lubricant.viscosity_under(conditions.mean_pressure)


def _shear_rate(conditions: ContactConditions, inlet_film_factor: Ratio = 1.0) -> ShearRate:
    """Mean shear rate; where there is no film, one so high that only a limit can answer it."""
    h, u_s = conditions.central_film_thickness * inlet_film_factor, conditions.nominal_sliding_speed
    xp = namespace(h, u_s)
    film = h > 0
    return xp.where(film, friction.film_shear_rate(u_s, xp.where(film, h, 1.0)), xp.where(u_s > 0, 1e12, 0.0))
