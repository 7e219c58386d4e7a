"""Materials: the metal of balls and races, and the lubricant between them."""

from __future__ import annotations

import dataclasses
import functools
import re
import tomllib
from importlib import resources
from typing import Annotated, Any

from ballscrew._arrays import namespace
from ballscrew.equations import rheology
from ballscrew.errors import Fault, InputError, fault_of, faults_of, is_concrete, nearest, raise_if_any
from ballscrew.quantities import (
    Conductivity,
    Density,
    HeatCapacity,
    Info,
    Pressure,
    PressureCoefficient,
    Quantity,
    Ratio,
    Temperature,
    TemperatureCoefficient,
    Viscosity,
    within_bounds,
)


@dataclasses.dataclass(frozen=True, eq=False)
class Material:
    """An elastic material. The default is bearing steel: E′ = 226 GPa against itself.

    The paper prints no value of its equivalent modulus.

    Raises :class:`~ballscrew.errors.InputError` (a ``ValueError``) for a modulus that is not
    positive or a Poisson's ratio outside [0, 0.5).
    """

    young_modulus: Annotated[Pressure, Info("E", "Young's modulus", "GPa", above=0, hint="steel has 206 GPa")] = 2.06e11
    poisson_ratio: Annotated[Ratio, Info(r"\nu", "Poisson's ratio", at_least=0, below=0.5, hint="steel has 0.3")] = 0.3

    def __post_init__(self) -> None:
        raise_if_any(faults_of("material", self))


@dataclasses.dataclass(frozen=True, eq=False)
class Lubricant:
    """An oil at the temperature of the contact.

    The temperature coefficient and the conductivity matter where the inlet heats; density and heat
    capacity are not used yet. The defaults are round figures for mineral oils: the density of
    Jungnickel2010; the others are from no source (the reference oil FVA 3 has 0.134 W/(m K),
    Lubricants2023; ISO VG 100 at 40 °C has a temperature coefficient of 0.054 1/K by its constants
    here, and 0.041 1/K at 60 °C). Raises :class:`~ballscrew.errors.InputError` for
    values that are not positive.
    """

    viscosity: Annotated[
        Viscosity,
        Info(
            r"\eta_0",
            "dynamic viscosity at ambient pressure and contact temperature",
            "mPa s",
            above=0,
            hint="oils lie between 0.005 Pa s and 1 Pa s",
        ),
    ]
    pressure_viscosity_coefficient: Annotated[
        PressureCoefficient,
        Info(
            r"\alpha_p",
            "pressure–viscosity coefficient",
            "1/GPa",
            above=0,
            hint="mineral oils have 1e-8 to 2.5e-8 1/Pa",
        ),
    ] = 2.2e-8
    temperature_coefficient: Annotated[
        TemperatureCoefficient,
        Info(
            r"\beta",
            "relative fall of the viscosity per kelvin",
            above=0,
            hint="mineral oils have 0.02 to 0.06 1/K near 40 degC",
        ),
    ] = 0.04
    density: Annotated[Density, Info(r"\rho", "density", above=0, hint="mineral oils have 870 kg/m^3")] = 870.0
    thermal_conductivity: Annotated[
        Conductivity, Info(r"k_f", "thermal conductivity", above=0, hint="mineral oils have 0.14 W/(m K)")
    ] = 0.14
    heat_capacity: Annotated[
        HeatCapacity, Info("c_p", "specific heat capacity", above=0, hint="mineral oils have 2000 J/(kg K)")
    ] = 2000.0

    #: The grade and the temperature (K) that the oil was made from, where it was: :meth:`at` needs them.
    grade: str | None = None
    temperature: Temperature | None = None

    def __post_init__(self) -> None:
        raise_if_any(faults_of("lubricant", self))

    def at(self, temperature: Temperature) -> Lubricant:
        """The oil at another temperature in kelvin: what depends on it changes as it does for the grade.

        What was changed against the grade, such as a measured viscosity, keeps its ratio to that of the grade.
        Raises :class:`~ballscrew.errors.InputError` for an oil that was not made from a grade, or a number
        out of the bounds of :meth:`from_grade`; of an array, elements out of them become NaN.
        """
        if self.grade is None:
            remedy = 'make it with Lubricant.from_grade("ISO VG 100", temperature)'
            raise InputError(Fault("lubricant.temperature", "needs an oil made from a grade", "", remedy))
        here, there = (Lubricant.from_grade(self.grade, T) for T in (self.temperature, temperature))
        moved = {
            name: getattr(self, name) * (getattr(there, name) / getattr(here, name))
            for name in ("viscosity", "pressure_viscosity_coefficient", "temperature_coefficient")
        }
        return dataclasses.replace(self, **moved, temperature=temperature)

    @classmethod
    def from_grade(cls, grade: str, temperature: Temperature = 313.15) -> Lubricant:
        """An oil by its grade (``"ISO VG 100"``, ``"FVA 3"``) at a temperature in kelvin.

        Viscosity by Vogel's law with the constants of ``data/lubricants.toml``; for ISO VG grades
        the pressure–viscosity coefficient is an estimate from the viscosity (Jungnickel2010), for
        FVA 3 it is measured (Lubricants2023). A real oil of a grade may lie 10 % off its nominal
        viscosity at 40 °C, and further off elsewhere (its viscosity index is not known here).

        Raises :class:`~ballscrew.errors.InputError` for an unknown grade or a temperature
        outside 253.15–423.15 K (-20 to 150 °C).
        """
        oils = _oils()
        key = _grade_key(grade)
        known = {_grade_key(name): name for name in oils}
        faults: list[Fault] = []
        if key not in known:
            faults.append(Fault("lubricant.grade", "unknown grade", grade, nearest(grade, oils)))
        fault = fault_of("lubricant", TEMPERATURE, temperature)
        if fault is not None:
            faults.append(fault)
        if faults:
            raise InputError(*faults)
        oil = oils[known[key]]
        nu = rheology.kinematic_viscosity_vogel(
            temperature, oil["viscosity_at_infinity"], oil["vogel_constant"], oil["vogel_temperature"]
        )
        if "inverse_pressure_viscosity_at_0_degC" in oil:
            alpha_p = rheology.pressure_viscosity_linear(
                temperature, oil["inverse_pressure_viscosity_at_0_degC"], oil["inverse_pressure_viscosity_slope"]
            )
        else:
            alpha_p = rheology.pressure_viscosity_estimate(nu)
        # numbers were refused above; of an array, elements out of range become NaN
        allowed = is_concrete(temperature) or within_bounds(TEMPERATURE.info, temperature)
        nu = nu if allowed is True else namespace(nu).where(allowed, nu, float("nan"))
        return cls(
            viscosity=_plain(rheology.dynamic_viscosity(nu, oil["density"])),
            pressure_viscosity_coefficient=_plain(alpha_p),
            temperature_coefficient=_plain(
                rheology.vogel_temperature_coefficient(temperature, oil["vogel_constant"], oil["vogel_temperature"])
            ),
            density=oil["density"],
            grade=known[key],
            temperature=temperature,
        )


TEMPERATURE = Quantity(
    "temperature",
    "K",
    Info(
        "T",
        "oil temperature",
        "degC",
        at_least=253.15,
        at_most=423.15,
        hint="the viscosity law holds from -20 degC to 150 degC",
    ),
)


def grades() -> list[str]:
    """The names :meth:`Lubricant.from_grade` knows."""
    return list(_oils())


@functools.cache
def _oils() -> dict[str, dict[str, Any]]:
    text = resources.files("ballscrew").joinpath("data/lubricants.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)["oils"]


def _grade_key(grade: str) -> str:
    """``"iso vg 100"``, ``"VG100"`` and ``"ISO VG 100"`` are one grade."""
    return re.sub(r"[^a-z0-9]", "", str(grade).lower()).removeprefix("iso")


def _plain(value: Any) -> Any:
    return float(value) if is_concrete(value) else value
