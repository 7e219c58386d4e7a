"""Every equation gives the same values for floats and for arrays, in the shape NumPy's rules give."""

import numpy as np

from support.rules import for_each

from .discovery import EQUATIONS

#: NumPy's vectorised powers and exponentials may differ from the scalar ones in the last digits.
RELATIVE = 1e-14


@for_each(equation=EQUATIONS)
def test_floats_give_finite_floats(equation):
    for values in zip(*(column.tolist() for column in equation.sample(5).values()), strict=True):
        for result in equation(*values):
            assert isinstance(result, float)
            assert np.isfinite(result)


@for_each(equation=EQUATIONS)
def test_arrays_give_the_values_of_floats(equation):
    columns = equation.sample(5)
    rows = [equation(*values) for values in zip(*(column.tolist() for column in columns.values()), strict=True)]
    for results, array in zip(zip(*rows, strict=True), equation(*columns.values()), strict=True):
        assert array.shape == (5,)
        assert array.dtype == np.float64
        np.testing.assert_allclose(array, results, rtol=RELATIVE)


@for_each(equation=EQUATIONS)
def test_single_precision_stays_single(equation):
    # A literal array inside an equation would promote what it is given.
    for result in equation(*(column.astype(np.float32) for column in equation.sample(5).values())):
        assert result.dtype == np.float32


@for_each(equation=EQUATIONS)
def test_parameters_broadcast(equation):
    columns = list(equation.sample(2).values())
    count = len(columns)
    axes = [column.reshape([2 if axis == own else 1 for axis in range(count)]) for own, column in enumerate(columns)]
    for field, array in enumerate(equation(*axes)):
        assert array.shape == (2,) * count
        for index in np.ndindex(array.shape):
            one = equation(*(float(column[i]) for column, i in zip(columns, index, strict=True)))[field]
            np.testing.assert_allclose(array[index], one, rtol=RELATIVE)


@for_each(equation=EQUATIONS)
def test_arguments_are_left_alone(equation):
    columns = equation.sample(5)
    before = {name: column.copy() for name, column in columns.items()}
    for column in columns.values():
        column.flags.writeable = False
    equation(*columns.values())
    for name, column in columns.items():
        np.testing.assert_array_equal(column, before[name])


@for_each(equation=EQUATIONS)
def test_an_empty_array_gives_an_empty_array(equation):
    for result in equation(*(np.empty(0) for _ in equation.parameters)):
        assert result.shape == (0,)
