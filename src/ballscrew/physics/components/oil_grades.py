"""Oils at a temperature: the nominal numbers of viscosity grades and of data sheets."""

from __future__ import annotations

import dataclasses
import functools
import math
import re
import tomllib
from collections.abc import Iterable
from importlib import resources
from typing import Annotated, Any

from ballscrew.basis.arrays import namespace
from ballscrew.basis.errors import Fault, InputError, fault_of, is_concrete, nearest
from ballscrew.basis.quantities import (
    Density,
    Info,
    PressureCoefficient,
    Quantity,
    Ratio,
    Temperature,
    TemperatureCoefficient,
    Viscosity,
    within_bounds,
)
from ballscrew.physics.components.data_sheet import ROUNDING, SHEET_TEMPERATURE, DataSheet
from ballscrew.physics.equations import rheology, viscosity_temperature

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
    nu = viscosity_temperature.kinematic_viscosity_vogel(
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
            viscosity_temperature.vogel_temperature_coefficient(
                temperature, oil["vogel_constant"], oil["vogel_temperature"]
            )
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
