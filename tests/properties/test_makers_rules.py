"""Rules of makers for a preloaded nut without load: in proportion to the preload, and blind to oil, speed and load."""

import functools

import pytest
from hypothesis import given

from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.named_calibration import by_rules
from ballscrew.physics.sizing.rules import Subject, drags
from support.commands import ROOT
from support.strategies import floats, powers

CASE = ROOT / "examples" / "catalogue_screw.toml"
SIZES = (floats(0.010, 0.125), floats(1.0, 1.05), floats(0.05, 1.0), powers(10.0, 1e5), powers(1e-3, 1e3))


@given(*SIZES)
def test_rules_are_in_proportion_to_the_preload(d_0, wider, steep, preload, factor):
    subject = Subject(d_0, d_0 * wider, d_0 * steep, preload=preload)
    once, more = drags(subject), drags(subject._replace(preload=preload * factor))
    assert more == pytest.approx({name: factor * torque for name, torque in once.items()}, rel=1e-12)
    assert all(torque > 0 for torque in once.values())


@functools.cache
def of_example(*settings):
    return {one.rule.name: one.torque for one in by_rules(case_file.load(CASE, list(settings)))}


@given(floats(-10.0, 90.0), floats(0.0, 3000.0), floats(-20.0, 20.0))
def test_rules_know_neither_oil_nor_speed_nor_load(temperature, speed, load):
    changed = of_example(
        f"lubricant.temperature={temperature!r} degC",
        f"operation.screw_speed={speed!r} rpm",
        f"operation.axial_load={load!r} kN",
    )
    assert changed == of_example()
