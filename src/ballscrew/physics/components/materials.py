"""Materials: the metal of balls and races, and the lubricant between them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Annotated, Any

from ballscrew.basis.arrays import ByValue, namespace, same
from ballscrew.basis.errors import (
    Fault,
    InputError,
    accepts_units,
    faults_of,
    names_keywords,
    raise_if_any,
    without_unit,
)
from ballscrew.basis.quantities import (
    Conductivity,
    Density,
    HeatCapacity,
    Info,
    KinematicViscosity,
    Pressure,
    PressureCoefficient,
    Quantity,
    Ratio,
    Temperature,
    TemperatureCoefficient,
    Viscosity,
    fields_of,
)
from ballscrew.basis.usual_ranges import warn_at_once
from ballscrew.physics.components.oil_grades import (
    AT_40,
    AT_100,
    PARAFFINIC,
    SHEET_TEMPERATURE,
    TEMPERATURE,
    DataSheet,
    LimitingShear,
    OilState,
    nominal_oil,
    oil_of_grade,
    oil_of_sheet,
    viscosity_index,
)
from ballscrew.physics.equations import rheology

#: How far the grooves go up the ball, of its radius, or of the height of its contacts: catalogues do not say.
LAND, LAND_OF_CONTACT = 0.35, 0.6


#: Standard acceleration of free fall, m/s², and the density of steel, kg/m³.
GRAVITY, STEEL_DENSITY = 9.80665, 7850.0


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class Material(ByValue):
    """An elastic material. The default is bearing steel: E′ = 226 GPa against itself.

    The paper prints no value of its equivalent modulus.

    Raises :class:`~ballscrew.basis.errors.InputError` (a ``ValueError``) for a modulus that is not
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
        warn_at_once("material", self)


#: The numbers of an oil that its grade, or its data sheet, and its temperature set.
OF_A_GRADE = (
    "viscosity", "pressure_viscosity_coefficient", "temperature_coefficient", "density", "limiting_shear_coefficient",
    "pressure_modulus_slope",
)  # fmt: skip


_HOW_TO_MAKE = "make it with Lubricant.from_data_sheet(100e-6, 11.1e-6, 880.0, temperature), or from_grade"
#: The numbers of a data sheet that change those of the oil.
INPUTS_OF_SHEET = {
    name: quantity for name, quantity in fields_of(DataSheet).items() if not name.endswith(("_point", "_temperature"))
}


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class Lubricant(ByValue):
    """An oil at the temperature of the contact.

    An oil of a data sheet (:meth:`from_data_sheet`) or of a grade (:meth:`from_grade`, a shortcut) has a temperature:
    ``dataclasses.replace`` with another ``temperature``, ``sheet`` or ``grade`` changes the numbers that depend on it,
    but for those that are given anew in the same call.

    The temperature coefficient and the conductivity matter where the inlet heats; density and heat capacity are not
    used yet. The limit of the shear stress counts where the law of the film asks for it (``full_film`` "arana"). The
    defaults are round figures for mineral oils: the density of Jungnickel2010, the limit of a paraffinic oil
    (Arana2019); the others are from no source (the reference oil FVA 3 has 0.134 W/(m K), Lubricants2023; ISO VG 100
    at 40 °C has a temperature coefficient of 0.054 1/K by its constants here, and 0.041 1/K at 60 °C). Raises
    :class:`~ballscrew.basis.errors.InputError` for
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
    limiting_shear_coefficient: LimitingShear = PARAFFINIC
    pressure_modulus_slope: Annotated[
        Ratio | None,
        Info(
            "B",
            "growth of the pressure modulus 1/alpha with pressure; by default viscosity under pressure is Roelands'",
            at_least=-0.01,
            hint="three oils of Arana2019 have 0 to 0.04",
            usual=(-0.01, 0.1),
        ),
    ] = None

    #: The grade and the temperature (K) that the oil was made from, where it was: with other ones it is another oil.
    grade: str | None = None
    temperature: Temperature | None = None
    #: The data sheet, in place of a grade.
    sheet: DataSheet | None = None
    #: The state that the numbers stand for; ``dataclasses.replace`` hands it on, which shows what has changed.
    made_as: OilState | None = dataclasses.field(default=None, repr=False, compare=False, kw_only=True)

    def __post_init__(self) -> None:
        temperature = without_unit("lubricant.temperature", self.temperature, TEMPERATURE.unit)
        faults = faults_of("lubricant", self, optional=("pressure_modulus_slope",))
        if isinstance(temperature, Fault):
            faults.append(temperature)
        elif self.grade is not None and self.sheet is not None:
            faults.append(Fault("lubricant.sheet", "contradicts the grade", str(self.grade), "give one of the two"))
        elif (self.grade is None and self.sheet is None) != (temperature is None):
            given = "temperature" if temperature is not None else "grade" if self.grade is not None else "sheet"
            words = "grade or a data sheet" if given == "temperature" else "temperature"
            problem = f"needs a {words}"
            faults.append(Fault(f"lubricant.{given}", problem, str(getattr(self, given)), _HOW_TO_MAKE))
        raise_if_any(faults)
        object.__setattr__(self, "temperature", temperature)
        if self.made_as is not None and self.follows_temperature and self.made_as.temperature is not None:
            for name, value in self._moved_from(self.made_as).items():
                object.__setattr__(self, name, value)
        numbers = {name: getattr(self, name) for name in OF_A_GRADE}
        object.__setattr__(self, "made_as", OilState(self.grade, self.temperature, sheet=self.sheet, **numbers))
        warn_at_once("lubricant", self)

    def _moved_from(self, before: OilState) -> dict[str, Any]:
        """The numbers that change with the grade, the sheet or the temperature, each by the ratio of the nominal ones.

        Nothing where all are as before. A number that is not as before was given anew, and stays.
        """
        if all(same(getattr(before, name), getattr(self, name)) for name in ("grade", "sheet", "temperature")):
            return {}
        here, there = (nominal_oil(state) for state in (before, self))
        kept = {name: old for name in OF_A_GRADE if same(getattr(self, name), old := getattr(before, name))}
        ends = {name: (getattr(here, name), getattr(there, name)) for name in kept}
        moved = {name: _moved(name, old, *ends[name]) for name, old in kept.items() if not same(*ends[name])}
        return {"grade": there.grade, **moved}

    def at(self, temperature: Temperature) -> Lubricant:
        """The oil at another ``temperature`` in kelvin: what depends on it changes as it does for the sheet or grade.

        What was changed against it, such as a measured viscosity, keeps its ratio to the nominal one.
        Raises :class:`~ballscrew.basis.errors.InputError` for an oil that was made from neither, or a number
        out of the bounds of :meth:`from_data_sheet` or :meth:`from_grade`; of an array, elements out of them are NaN.
        """
        if not self.follows_temperature:
            problem = "needs an oil made from a grade or a data sheet"
            raise InputError(Fault("lubricant.temperature", problem, "", _HOW_TO_MAKE))
        return dataclasses.replace(self, temperature=temperature)

    @property
    def follows_temperature(self) -> bool:
        """True for an oil of a data sheet or of a grade, whose numbers change with the temperature."""
        return self.grade is not None or self.sheet is not None

    @property
    def temperature_quantity(self) -> Quantity:
        """The temperature with the bounds that this oil has."""
        return TEMPERATURE if self.sheet is None else SHEET_TEMPERATURE

    def viscosity_under(self, pressure: Pressure) -> Viscosity:
        """Return the viscosity under a ``pressure`` (Pa), in Pa s: by the oil's pressure modulus, or by Roelands1966.

        The law of the modulus (Mann, in Arana2019) is fitted to measurements to 1 GPa, that of Roelands to 0.5 GPa.
        """
        eta_0, alpha_p = self.viscosity, self.pressure_viscosity_coefficient
        if self.pressure_modulus_slope is not None:
            eta = rheology.pressure_modulus_viscosity(eta_0, pressure, alpha_p, self.pressure_modulus_slope)
            # a modulus that falls with the pressure ends at zero: beyond, the law says nothing
            modulus = 1 / alpha_p + self.pressure_modulus_slope * pressure
            return namespace(eta, modulus).where(modulus > 0, eta, float("nan"))
        return rheology.roelands_viscosity(eta_0, pressure, rheology.roelands_exponent(eta_0, alpha_p))

    @property
    def kinematic_viscosity(self) -> Annotated[KinematicViscosity, Info(r"\nu", "kinematic viscosity", "cSt")]:
        """The kinematic viscosity at the temperature of the oil."""
        return self.viscosity / self.density

    @property
    def viscosity_index(self) -> float:
        """The viscosity index by ASTMD2270 (ISO 2909); NaN for an oil that does not change with the temperature."""
        if self.sheet is not None:
            return self.sheet.viscosity_index
        if self.grade is None:
            return math.nan
        nominal = (oil_of_grade(self.grade, temperature) for temperature in (AT_40, AT_100))
        return viscosity_index(*(oil.viscosity / oil.density for oil in nominal))

    def changed(self, values: Mapping[str, Any]) -> Lubricant:
        """The oil with other ``values`` (SI) of its own fields by name, those of its data sheet among them.

        The temperature and the sheet come first: a number of the oil that is given, too, counts as it is given.
        """
        of_sheet = {name: value for name, value in values.items() if name in INPUTS_OF_SHEET}
        first: dict[str, Any] = {} if not of_sheet else {"sheet": dataclasses.replace(self._own_sheet, **of_sheet)}
        if TEMPERATURE.name in values:
            first[TEMPERATURE.name] = values[TEMPERATURE.name]
        rest = {name: value for name, value in values.items() if name not in of_sheet and name not in first}
        moved = dataclasses.replace(self, **first) if first else self
        return dataclasses.replace(moved, **rest) if rest else moved

    def value_of(self, name: str) -> Any:
        """The value of the field ``name`` of the oil or of its data sheet."""
        return getattr(self._own_sheet if name in INPUTS_OF_SHEET else self, name)

    @property
    def _own_sheet(self) -> DataSheet:
        if self.sheet is None:
            raise InputError(Fault("lubricant.kinematic_viscosity_40", "needs a data sheet", "", _HOW_TO_MAKE))
        return self.sheet

    @classmethod
    @accepts_units("lubricant")
    def from_data_sheet(
        cls,
        kinematic_viscosity_40: KinematicViscosity,
        kinematic_viscosity_100: KinematicViscosity,
        density_15: Density = 870.0,
        temperature: Temperature = 313.15,
        *,
        pour_point: Temperature | None = None,
        lowest_temperature: Temperature | None = None,
        highest_temperature: Temperature | None = None,
        name: str = "",
    ) -> Lubricant:
        """An oil by the two viscosities of its data sheet, at a ``temperature`` in kelvin.

        ``kinematic_viscosity_40`` and ``kinematic_viscosity_100`` are those at 40 °C and 100 °C, m²/s. The viscosity is
        on the line of ASTMD341 through both points, full form; the density (``density_15``, at 15 °C, in kg/m³) follows
        ASTMD1250, the pressure–viscosity coefficient the estimate of Jungnickel2010 for mineral oils. Below the
        ``pour_point`` (K), and outside the range that the maker states (``lowest_temperature`` to
        ``highest_temperature``, K), results carry a warning. ``name`` is that of the oil. See
        :class:`~ballscrew.physics.components.oil_grades.DataSheet`.

        Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, an oil that is not thinner at 100
        °C, and a temperature outside 193.15–473.15 K (-80 to 200 °C).
        """
        sheet = DataSheet(
            kinematic_viscosity_40=kinematic_viscosity_40,
            kinematic_viscosity_100=kinematic_viscosity_100,
            density_15=density_15,
            pour_point=pour_point,
            lowest_temperature=lowest_temperature,
            highest_temperature=highest_temperature,
            name=name,
        )
        return cls.from_sheet(sheet, temperature)

    @classmethod
    @accepts_units("lubricant")
    def from_sheet(cls, sheet: DataSheet, temperature: Temperature = 313.15) -> Lubricant:
        """An oil of a data ``sheet``, such as one of ``bs.oils()``, at a ``temperature`` in kelvin.

        Raises :class:`~ballscrew.basis.errors.InputError` for a temperature outside 193.15–473.15 K (-80 to 200 °C).
        """
        state = oil_of_sheet(sheet, temperature)
        return cls(**{field.name: getattr(state, field.name) for field in dataclasses.fields(state)})

    @classmethod
    @accepts_units("lubricant")
    def from_grade(cls, grade: str, temperature: Temperature = 313.15) -> Lubricant:
        """An oil by its ``grade`` (``"ISO VG 100"``, ``"FVA 3"``) at a ``temperature`` in K: a shortcut.

        With the viscosities of a data sheet take :meth:`from_data_sheet`: far below 0 °C the two laws differ by
        a factor of two and more (ISO VG 100 at -20 °C: 35800 mm²/s here, 18900 mm²/s through 100 and 11.1 mm²/s).
        Viscosity by Vogel's law with the constants of ``data/oil_grades.toml``; for ISO VG grades
        the pressure–viscosity coefficient is an estimate from the viscosity (Jungnickel2010), for
        FVA 3 it is measured (Lubricants2023). A real oil of a grade may lie 10 % off its nominal
        viscosity at 40 °C, and further off elsewhere (its viscosity index is not known here).

        Raises :class:`~ballscrew.basis.errors.InputError` for an unknown grade or a temperature
        outside 253.15–423.15 K (-20 to 150 °C).
        """
        state = oil_of_grade(grade, temperature)
        return cls(**{field.name: getattr(state, field.name) for field in dataclasses.fields(state)})


def _moved(name: str, old: Any, here: Any, there: Any) -> Any:
    """A number of an oil at another temperature or grade, by the nominal ones: by their ratio, a slope by their
    difference, as it may be zero.
    """
    if old is None or here is None or there is None:
        return there
    return old + (there - here) if name == "pressure_modulus_slope" else old * (there / here)
