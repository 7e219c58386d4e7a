"""The units of the annotations fit together: every equation is fed quantities that carry them.

The quantities come in other units than SI (mm, kN, rpm, degrees), so that besides the dimension of
the result its size shows whether all parts of the equation agree.
"""

import numpy as np
import pint
import pytest

from support.rules import for_each

from .discovery import DIMENSIONAL_FITS, EQUATIONS

CONSISTENT = {name: equation for name, equation in EQUATIONS.items() if name not in DIMENSIONAL_FITS}
FITS = {name: EQUATIONS[name] for name in DIMENSIONAL_FITS}
RELATIVE = 1e-12

#: For each SI unit one that people use, to mix units within a call.
ALSO = {
    "m": "mm",
    "rad": "degree",
    "N": "kN",
    "N m": "N mm",
    "W": "kW",
    "Pa": "GPa",
    "1/Pa": "1/GPa",
    "m/s": "mm/s",
    "rad/s": "rpm",
    "Pa s": "mPa s",
    "m^2/s": "mm^2/s",
    "kg/m^3": "g/cm^3",
    "K": "mK",
    "1/m": "1/mm",
}


def quantities(registry, equation, columns, *, other=False):
    """The arguments with the units of their annotations, or converted to other units."""
    for name, unit in equation.units.items():
        quantity = registry.Quantity(columns[name], unit or "1")
        yield quantity.to(ALSO[unit]) if other and unit in ALSO else quantity


def assert_same(registry, result, unit, expected):
    quantity = registry.Quantity(result) if not isinstance(result, pint.Quantity) else result
    assert quantity.dimensionality == registry.Quantity(1.0, unit).dimensionality
    np.testing.assert_allclose(quantity.to(unit).magnitude, expected, rtol=RELATIVE)


@pytest.mark.parametrize("kind", ["SI", "other", "arrays of other"])
@for_each(equation=CONSISTENT)
def test_the_result_has_the_unit_of_its_annotation(registry, equation, kind):
    columns = equation.sample(4)
    if "arrays" not in kind:
        columns = {parameter: float(column[0]) for parameter, column in columns.items()}
    results = equation(*quantities(registry, equation, columns, other="other" in kind))
    for result, unit, expected in zip(results, equation.return_units, equation(*columns.values()), strict=True):
        assert_same(registry, result, unit, expected)


@for_each(equation=FITS)
def test_dimensional_fits_are_not_consistent(registry, equation):
    # If one of them were, it would not belong on the list.
    columns = {parameter: float(column[0]) for parameter, column in equation.sample(1).items()}
    (unit,) = equation.return_units
    try:
        (result,) = equation(*quantities(registry, equation, columns))
        dimensionality = registry.Quantity(result).dimensionality
    except pint.DimensionalityError:
        dimensionality = None  # its parts do not even add up
    assert dimensionality != registry.Quantity(1.0, unit).dimensionality


@for_each(equation=CONSISTENT)
def test_a_wrong_unit_does_not_pass(registry, equation):
    # With each parameter in turn a length too many, something must not fit.
    columns = {parameter: float(column[0]) for parameter, column in equation.sample(1).items()}
    given = list(quantities(registry, equation, columns))
    metre = registry.Quantity(1.0, "m")
    for position, parameter in enumerate(equation.parameters):
        wrong = [quantity * metre if index == position else quantity for index, quantity in enumerate(given)]
        try:
            results = equation(*wrong)
        except pint.DimensionalityError:
            continue
        assert any(
            registry.Quantity(result).dimensionality != registry.Quantity(1.0, unit).dimensionality
            for result, unit in zip(results, equation.return_units, strict=True)
        ), parameter
