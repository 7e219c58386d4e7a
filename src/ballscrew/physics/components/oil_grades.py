"""Oils at a temperature: the nominal numbers of viscosity grades and of data sheets.

An oil by the two viscosities of its data sheet, and what else that says.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import re
import tomllib
from collections.abc import Iterable
from importlib import resources
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import ByValue, namespace
from ballscrew.basis.errors import Fault, InputError, fault_of, faults_of, is_concrete, nearest, raise_if_any
from ballscrew.basis.quantities import (
    Density,
    Info,
    KinematicViscosity,
    PressureCoefficient,
    Quantity,
    Ratio,
    Temperature,
    TemperatureCoefficient,
    Viscosity,
    within_bounds,
)
from ballscrew.physics.equations import rheology

#: The temperatures of the two viscosities and of the density of a data sheet, K.
AT_40, AT_100, AT_15 = 313.15, 373.15, 288.15
#: Steps of Newton that invert the line of ASTMD341 to the last digit.
_STEPS = 2
#: A bound in degC is met by sums such as -20 + 273.15 = 253.14999999999998, K.
ROUNDING = 1e-9

#: The temperature of an oil of a data sheet.
SHEET_TEMPERATURE = Quantity(
    "temperature",
    "K",
    Info(
        "T",
        "oil temperature",
        "degC",
        at_least=193.15 - ROUNDING,
        at_most=473.15 + ROUNDING,
        hint="no oil of a data sheet is computed below -80 degC or above 200 degC",
    ),
)

_OPTIONAL = ("pour_point", "lowest_temperature", "highest_temperature")


class NominalState(NamedTuple):
    """The numbers of an oil that its temperature sets."""

    viscosity: Viscosity
    pressure_viscosity_coefficient: PressureCoefficient
    temperature_coefficient: TemperatureCoefficient
    density: Density


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class DataSheet(ByValue):
    """An oil, or the base oil of a grease, as its maker's data sheet has it.

    The viscosity follows the line of ASTMD341 through both points, in the full form that holds for thin oils too; the
    density follows ASTMD1250; the pressure–viscosity coefficient is an estimate from the viscosity (Jungnickel2010,
    mineral oils: others lie off it). Data sheets state typical values: an oil may lie 10 % off. The default density is
    that of Jungnickel2010's oils. ``Lubricant.from_sheet(sheet, temperature)`` is the oil at a temperature.

    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, and for an oil that is not thinner at
    100 °C.
    """

    kinematic_viscosity_40: Annotated[
        KinematicViscosity,
        Info(
            r"\nu_{40}",
            "kinematic viscosity at 40 degC",
            "cSt",
            at_least=5e-7,
            below=1.0,
            hint="data sheets have 10 cSt to 1000 cSt; 1 cSt is 1e-6 m^2/s",
            usual=(1e-6, 1e-2),
        ),
    ]
    kinematic_viscosity_100: Annotated[
        KinematicViscosity,
        Info(
            r"\nu_{100}",
            "kinematic viscosity at 100 degC",
            "cSt",
            at_least=5e-7,
            below=1.0,
            hint="data sheets have 2 cSt to 80 cSt; 1 cSt is 1e-6 m^2/s",
            usual=(7e-7, 1e-3),
        ),
    ]
    density_15: Annotated[
        Density,
        Info(r"\rho_{15}", "density at 15 degC", above=0, hint="mineral oils have 880 kg/m^3", usual=(500.0, 2500.0)),
    ] = 870.0
    pour_point: Annotated[
        Temperature | None, Info("T_P", "pour point: below it the oil does not flow", "degC", above=0, hint="in kelvin")
    ] = None
    lowest_temperature: Annotated[
        Temperature | None, Info("T_l", "lowest temperature that the maker states", "degC", above=0, hint="in kelvin")
    ] = None
    highest_temperature: Annotated[
        Temperature | None, Info("T_h", "highest temperature that the maker states", "degC", above=0, hint="in kelvin")
    ] = None
    #: The name of the oil.
    name: str = ""
    #: Where the numbers are from; a key of the bibliography, or words.
    source: str = ""
    #: The kind of oil, or of the base oil of a grease: "mineral oil", "PAO", "polyglycol"; empty where it is not known.
    base_oil: str = ""
    #: Of a grease: its thickener. Empty for an oil.
    thickener: str = ""
    #: Of a grease: its consistency (NLGI). Empty for an oil.
    nlgi: str = ""

    def __post_init__(self) -> None:
        faults = faults_of("lubricant", self, _OPTIONAL)
        thick, thin = self.kinematic_viscosity_40, self.kinematic_viscosity_100
        if not faults and is_concrete(thick) and is_concrete(thin) and not thick > thin:
            remedy = "look whether the two are exchanged"
            given = f"{float(thin):.6g} m^2/s against {float(thick):.6g} m^2/s"
            faults.append(Fault("lubricant.kinematic_viscosity_100", "must be below that at 40 degC", given, remedy))
        raise_if_any(faults)

    @property
    def is_grease(self) -> bool:
        """True for a grease, whose viscosities are those of its base oil."""
        return bool(self.thickener)

    def at(self, temperature: Temperature) -> NominalState:
        """The numbers at a ``temperature``, K; NaN for elements of an array that no oil is computed at."""
        allowed = is_concrete(temperature) or within_bounds(SHEET_TEMPERATURE.info, temperature)
        number_40 = rheology.walther_number(self.kinematic_viscosity_40)
        number_100 = rheology.walther_number(self.kinematic_viscosity_100)
        slope = rheology.walther_slope(AT_40, number_40, AT_100, number_100)
        number = rheology.walther_number_at(temperature, AT_40, number_40, slope)
        nu = rheology.kinematic_viscosity_of_walther_number(number)
        for _ in range(_STEPS):
            nu = rheology.refined_kinematic_viscosity(
                nu, number, rheology.walther_number(nu), rheology.walther_number_slope(nu)
            )
        nu = nu if allowed is True else namespace(nu).where(allowed, nu, float("nan"))
        density = rheology.oil_density(
            self.density_15, rheology.oil_expansion_coefficient(self.density_15), temperature, AT_15
        )
        return NominalState(
            rheology.dynamic_viscosity(nu, density),
            rheology.pressure_viscosity_estimate(nu),
            rheology.walther_temperature_coefficient(temperature, nu, number, slope, rheology.walther_number_slope(nu)),
            density,
        )

    @property
    def viscosity_index(self) -> Annotated[Ratio, Info("VI", "viscosity index")]:
        """The viscosity index by ASTMD2270 (ISO 2909); NaN below 2 mm²/s at 100 °C, where none is defined."""
        return viscosity_index(self.kinematic_viscosity_40, self.kinematic_viscosity_100)


def viscosity_index(kinematic_viscosity_40: KinematicViscosity, kinematic_viscosity_100: KinematicViscosity) -> Ratio:
    """The viscosity index of two numbers by ASTMD2270 (ISO 2909); NaN below 2 mm²/s at 100 °C."""
    values = np.vectorize(_viscosity_index, otypes=[float])(kinematic_viscosity_40, kinematic_viscosity_100)
    return values if values.ndim else float(values)


def _viscosity_index(U: float, Y: float) -> float:
    row = next((row for row in reversed(_reference_oils()) if row["viscosity"] <= 1e6 * Y), None)
    if row is None:
        return math.nan
    L, H = (rheology.reference_viscosity(Y, *row[oil]) for oil in ("L", "H"))
    if U > H:
        return float(rheology.viscosity_index_up_to_100(U, L, H))
    return float(rheology.viscosity_index_above_100(U, Y, H))


@functools.cache
def _reference_oils() -> list[dict[str, Any]]:
    text = resources.files("ballscrew").joinpath("data/viscosity_index.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)["from"]


#: Limit of the shear stress over the pressure of a paraffinic mineral oil (Höglund, in Arana2019).
PARAFFINIC = 0.047
LimitingShear = Annotated[
    Ratio,
    Info(
        r"\Lambda",
        "limiting shear stress / pressure",
        above=0,
        hint="paraffinic mineral oils have 0.047, naphthenic ones 0.053, PAO 0.035",
        usual=(0.005, 0.2),
    ),
]


@dataclasses.dataclass(frozen=True)
class OilState:
    """A grade or a data sheet and a temperature, and the numbers that they set."""

    grade: str | None
    temperature: Temperature | None
    viscosity: Viscosity
    pressure_viscosity_coefficient: PressureCoefficient
    temperature_coefficient: TemperatureCoefficient
    density: Density
    limiting_shear_coefficient: Ratio
    pressure_modulus_slope: Ratio | None
    sheet: DataSheet | None = None


#: The temperature of an oil of a grade.
TEMPERATURE = Quantity(
    "temperature",
    "K",
    Info(
        "T",
        "oil temperature",
        "degC",
        at_least=253.15 - ROUNDING,
        at_most=423.15 + ROUNDING,
        hint="the viscosity law holds from -20 degC to 150 degC",
    ),
)


def nominal_oil(state: Any) -> OilState:
    """The nominal numbers of an oil of a data sheet or of a grade at its temperature."""
    if state.sheet is not None:
        return oil_of_sheet(state.sheet, state.temperature)
    return oil_of_grade(str(state.grade), state.temperature)


def oil_of_sheet(sheet: DataSheet, temperature: Temperature) -> OilState:
    """The numbers of a data sheet at a temperature; see :meth:`Lubricant.from_data_sheet`."""
    fault = fault_of("lubricant", SHEET_TEMPERATURE, temperature)
    if fault is not None:
        raise InputError(fault)
    numbers = {name: plain(value) for name, value in sheet.at(temperature)._asdict().items()}
    return OilState(
        grade=None,
        temperature=temperature,
        sheet=sheet,
        limiting_shear_coefficient=limiting_shear_of(sheet.base_oil),
        pressure_modulus_slope=None,
        **numbers,
    )


def has_additives(grade: str | None) -> bool:
    """False for an oil of a grade that is known to have none: reference and base oils."""
    return grade is None or bool(_oils().get(grade, {}).get("additives", True))


def limiting_shear_of(base_oil: str) -> float:
    """The limit of shear of a kind of base oil, ``data/oil_grades.toml``; what is mixed or unknown is as mineral oil.

    The words are those of data sheets: "PAO", "mineral oil", "naphthenic mineral oil", "polyglycol".
    """
    known = _tables()["limiting_shear"]
    return float(known.get(base_oil.lower(), PARAFFINIC))


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
    slope = None
    if "pressure_modulus_slope_at_0_degC" in oil:
        slope = plain(
            rheology.pressure_modulus_slope_linear(
                temperature, oil["pressure_modulus_slope_at_0_degC"], oil["pressure_modulus_slope_coefficient"]
            )
        )
    # numbers were refused above; of an array, elements out of range become NaN
    allowed = is_concrete(temperature) or within_bounds(TEMPERATURE.info, temperature)
    nu = nu if allowed is True else namespace(nu).where(allowed, nu, float("nan"))
    return OilState(
        viscosity=plain(rheology.dynamic_viscosity(nu, oil["density"])),
        pressure_viscosity_coefficient=plain(alpha_p),
        temperature_coefficient=plain(
            rheology.vogel_temperature_coefficient(temperature, oil["vogel_constant"], oil["vogel_temperature"])
        ),
        density=oil["density"],
        limiting_shear_coefficient=oil.get("limiting_shear_coefficient", PARAFFINIC),
        pressure_modulus_slope=slope,
        grade=known[key],
        temperature=temperature,
    )


def _nearest_grade(grade: str, oils: Iterable[str]) -> str:
    """A remedy with the grade whose number is nearest, by their ratio; by its letters where there is no number."""
    if _grade_key(grade).startswith("nlgi"):
        return (
            'that is the consistency of a grease, and friction follows its base oil: see "ballscrew oils list '
            f'{grade}", and write oil = "…", or its kinematic_viscosity_40 and kinematic_viscosity_100'
        )
    number = re.fullmatch(r"(?:iso)?(?:vg)?0*([1-9]\d{0,5})", _grade_key(grade))
    numbers = {float(name.rpartition(" ")[2]): name for name in oils if name.startswith("ISO VG ")}
    if number is None or not numbers:
        return nearest(grade, oils)
    result = numbers[min(numbers, key=lambda n: abs(math.log(n / float(number[1]))))]
    return f'did you mean "{result}"?'


def grades() -> list[str]:
    """The names :meth:`Lubricant.from_grade` knows."""
    return list(_oils())


def _oils() -> dict[str, dict[str, Any]]:
    return _tables()["oils"]


@functools.cache
def _tables() -> dict[str, dict[str, Any]]:
    return tomllib.loads(resources.files("ballscrew").joinpath("data/oil_grades.toml").read_text(encoding="utf-8"))


def _grade_key(grade: str) -> str:
    """``"iso vg 100"``, ``"VG100"`` and ``"ISO VG 100"`` are one grade."""
    return re.sub(r"[^a-z0-9]", "", str(grade).lower()).removeprefix("iso")


def plain(value: Any) -> Any:
    """A number as a float; arrays and traced values as they are."""
    return float(value) if is_concrete(value) else value
