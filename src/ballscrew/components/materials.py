"""Materials: the metal of balls and races, and the lubricant between them."""

from __future__ import annotations

import dataclasses
import functools
import math
import re
import tomllib
from collections.abc import Iterable
from importlib import resources
from typing import Annotated, Any

from ballscrew._arrays import ByValue, namespace, same
from ballscrew.equations import rheology
from ballscrew.errors import (
    Fault,
    InputError,
    accepts_units,
    fault_of,
    faults_of,
    is_concrete,
    nearest,
    raise_if_any,
    without_unit,
)
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
class Material(ByValue):
    """An elastic material. The default is bearing steel: E′ = 226 GPa against itself.

    The paper prints no value of its equivalent modulus.

    Raises :class:`~ballscrew.errors.InputError` (a ``ValueError``) for a modulus that is not
    positive or a Poisson's ratio outside [0, 0.5).
    """

    young_modulus: Annotated[
        Pressure, Info("E", "Young's modulus", "GPa", above=0, hint="steel has 206 GPa", usual=(3e10, 1e12))
    ] = 2.06e11
    poisson_ratio: Annotated[
        Ratio, Info(r"\nu", "Poisson's ratio", at_least=0, below=0.5, hint="steel has 0.3", usual=(0.05, 0.45))
    ] = 0.3

    def __post_init__(self) -> None:
        raise_if_any(faults_of("material", self))


@dataclasses.dataclass(frozen=True)
class OilState:
    """A grade and a temperature, and the numbers that they set."""

    grade: str | None
    temperature: Temperature | None
    viscosity: Viscosity
    pressure_viscosity_coefficient: PressureCoefficient
    temperature_coefficient: TemperatureCoefficient
    density: Density


#: The numbers of an oil that its grade and its temperature set.
OF_A_GRADE = ("viscosity", "pressure_viscosity_coefficient", "temperature_coefficient", "density")


@dataclasses.dataclass(frozen=True, eq=False)
class Lubricant(ByValue):
    """An oil at the temperature of the contact.

    An oil of a grade has a temperature: ``dataclasses.replace`` with another ``temperature`` or ``grade`` changes the
    numbers that depend on it, but for those that are given anew in the same call.

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
            usual=(3e-4, 1000.0),
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
            usual=(1e-9, 2e-7),
        ),
    ] = 2.2e-8
    temperature_coefficient: Annotated[
        TemperatureCoefficient,
        Info(
            r"\beta",
            "relative fall of the viscosity per kelvin",
            above=0,
            hint="mineral oils have 0.02 to 0.06 1/K near 40 degC",
            usual=(0.002, 0.3),
        ),
    ] = 0.04
    density: Annotated[
        Density, Info(r"\rho", "density", above=0, hint="mineral oils have 870 kg/m^3", usual=(500.0, 2500.0))
    ] = 870.0
    thermal_conductivity: Annotated[
        Conductivity,
        Info(r"k_f", "thermal conductivity", above=0, hint="mineral oils have 0.14 W/(m K)", usual=(0.05, 1.0)),
    ] = 0.14
    heat_capacity: Annotated[
        HeatCapacity,
        Info("c_p", "specific heat capacity", above=0, hint="mineral oils have 2000 J/(kg K)", usual=(500.0, 5000.0)),
    ] = 2000.0

    #: The grade and the temperature (K) that the oil was made from, where it was: with other ones it is another oil.
    grade: str | None = None
    temperature: Temperature | None = None
    #: The state that the numbers stand for; ``dataclasses.replace`` hands it on, which shows what has changed.
    made_as: OilState | None = dataclasses.field(default=None, repr=False, compare=False, kw_only=True)

    def __post_init__(self) -> None:
        temperature = without_unit("lubricant.temperature", self.temperature, TEMPERATURE.unit)
        faults = faults_of("lubricant", self)
        if isinstance(temperature, Fault):
            faults.append(temperature)
        elif (self.grade is None) != (temperature is None):
            given, other = ("temperature", "grade") if self.grade is None else ("grade", "temperature")
            remedy = 'make it with Lubricant.from_grade("ISO VG 100", temperature)'
            faults.append(Fault(f"lubricant.{given}", f"needs a {other}", str(getattr(self, given)), remedy))
        raise_if_any(faults)
        object.__setattr__(self, "temperature", temperature)
        if self.made_as is not None and self.grade is not None and self.made_as.grade is not None:
            for name, value in self._moved_from(self.made_as).items():
                object.__setattr__(self, name, value)
        numbers = {name: getattr(self, name) for name in OF_A_GRADE}
        object.__setattr__(self, "made_as", OilState(self.grade, self.temperature, **numbers))

    def _moved_from(self, before: OilState) -> dict[str, Any]:
        """The numbers that change with the grade or the temperature, each by the ratio of the grade's own.

        Nothing where both are as before. A number that is not as before was given anew, and stays.
        """
        if same(before.grade, self.grade) and same(before.temperature, self.temperature):
            return {}
        here, there = (oil_of_grade(str(state.grade), state.temperature) for state in (before, self))
        kept = {name: old for name in OF_A_GRADE if same(getattr(self, name), old := getattr(before, name))}
        ends = {name: (getattr(here, name), getattr(there, name)) for name in kept}
        moved = {name: old * (ends[name][1] / ends[name][0]) for name, old in kept.items() if not same(*ends[name])}
        return {"grade": there.grade, **moved}

    def at(self, temperature: Temperature) -> Lubricant:
        """The oil at another temperature in kelvin: what depends on it changes as it does for the grade.

        What was changed against the grade, such as a measured viscosity, keeps its ratio to that of the grade.
        Raises :class:`~ballscrew.errors.InputError` for an oil that was not made from a grade, or a number
        out of the bounds of :meth:`from_grade`; of an array, elements out of them become NaN.
        """
        if self.grade is None:
            remedy = 'make it with Lubricant.from_grade("ISO VG 100", temperature)'
            raise InputError(Fault("lubricant.temperature", "needs an oil made from a grade", "", remedy))
        return dataclasses.replace(self, temperature=temperature)

    @classmethod
    @accepts_units("lubricant")
    def from_grade(cls, grade: str, temperature: Temperature = 313.15) -> Lubricant:
        """An oil by its grade (``"ISO VG 100"``, ``"FVA 3"``) at a temperature in kelvin.

        Viscosity by Vogel's law with the constants of ``data/lubricants.toml``; for ISO VG grades
        the pressure–viscosity coefficient is an estimate from the viscosity (Jungnickel2010), for
        FVA 3 it is measured (Lubricants2023). A real oil of a grade may lie 10 % off its nominal
        viscosity at 40 °C, and further off elsewhere (its viscosity index is not known here).

        Raises :class:`~ballscrew.errors.InputError` for an unknown grade or a temperature
        outside 253.15–423.15 K (-20 to 150 °C).
        """
        state = oil_of_grade(grade, temperature)
        return cls(**{field.name: getattr(state, field.name) for field in dataclasses.fields(state)})


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


def oil_of_grade(grade: str, temperature: Temperature) -> OilState:
    """The nominal numbers of a grade at a temperature; see :meth:`Lubricant.from_grade`."""
    oils = _oils()
    key = _grade_key(grade)
    known = {_grade_key(name): name for name in oils}
    faults: list[Fault] = []
    if key not in known:
        faults.append(Fault("lubricant.grade", "unknown grade", str(grade), _nearest_grade(str(grade), oils)))
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
    return OilState(
        viscosity=_plain(rheology.dynamic_viscosity(nu, oil["density"])),
        pressure_viscosity_coefficient=_plain(alpha_p),
        temperature_coefficient=_plain(
            rheology.vogel_temperature_coefficient(temperature, oil["vogel_constant"], oil["vogel_temperature"])
        ),
        density=oil["density"],
        grade=known[key],
        temperature=temperature,
    )


def _nearest_grade(grade: str, oils: Iterable[str]) -> str:
    """A remedy with the grade whose number is nearest, by their ratio; by its letters where there is no number."""
    number = re.fullmatch(r"(?:iso)?(?:vg)?0*([1-9]\d{0,5})", _grade_key(grade))
    numbers = {float(name.rpartition(" ")[2]): name for name in oils if name.startswith("ISO VG ")}
    if number is None or not numbers:
        return nearest(grade, oils)
    return f'did you mean "{numbers[min(numbers, key=lambda n: abs(math.log(n / float(number[1]))))]}"?'


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
