"""A log as text, and what is read from it."""

import numpy as np
import pytest

from ballscrew.basis.errors import InputError

RPM = 2 * np.pi / 60


HEADINGS = "time [s],speed [rpm],axial load [N],friction torque [N m],temperature [degC]\n"


ROWS = "0,100,1000,0.5,30\n1,110,1100,0.6,30.5\n2,-120,1200,-0.7,31\n"


def lines_of(action, *arguments, **options):
    with pytest.raises(InputError) as caught:
        action(*arguments, **options)
    return caught.value.lines()


def in_display_units(log):
    """The rows of a log in rpm, N, N m and °C."""
    speed, temperature = log.screw_speed / RPM, None if log.temperature is None else log.temperature - 273.15
    found = [speed, log.axial_load, log.torque, *([] if temperature is None else [temperature])]
    return [tuple(round(float(value), 9) for value in row) for row in zip(*found, strict=True)]


EXPECTED = [(100, 1000, 0.5, 30), (110, 1100, 0.6, 30.5), (-120, 1200, -0.7, 31)]
