"""The operating state as the formulas take it."""

import numpy as np
import pytest

from ballscrew.physics.components.operating_state import OperatingState


def test_a_state_of_numbers_is_settled_already():
    state = OperatingState(np.float64(-100.0), np.float64(1.0))
    assert state.settled is state


@pytest.mark.parametrize("nothing", [1e-120, -1e-120, -0.0])
def test_what_is_nearly_nothing_is_zero(nothing):
    for values in (np.float64(nothing), np.array([nothing, nothing])):
        settled = OperatingState(values, values).settled
        assert not np.any(settled.axial_load)
        assert not np.any(np.signbit(settled.screw_speed))
