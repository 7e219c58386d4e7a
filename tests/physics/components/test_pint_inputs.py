"""Quantities of pint: converted by their unit wherever a number is given, or refused; a unit is never dropped."""

import dataclasses
import importlib
import math
import pkgutil
import re

import numpy as np
import pint
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.axis.duty_cycle.screw_friction import ConstantEfficiency
from ballscrew.axis.supports.bearing import MountedBearing, SupportBearing
from ballscrew.axis.supports.guide import CarriedMass, GuidedTable, LinearGuide
from ballscrew.axis.supports.makers_bearing import KnownBearing, PalmgrenBearing, SKFBearing, SKFConstants
from ballscrew.basis.quantities import fields_of
from ballscrew.engine.uncertainty.bands import band_along
from ballscrew.physics.components.nut import Scatter
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.laws import nut_losses
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.physics.sizing.checks import checks
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.solvers.load_distribution import ball_loads
from ballscrew.questions.optimise.design_model import SearchOptions
from ballscrew.questions.select.requirements import Requirements
from support.synthetic_logs import OIL

U = pint.UnitRegistry()


@pytest.mark.parametrize("unit", ["1/min", "Hz"])
def test_a_speed_without_an_angle_is_refused(unit):
    """Pint counts it in radians, a case file ``1/min`` in revolutions."""
    with pytest.raises(bs.InputError, match="could count radians or revolutions"):
        OperatingState(axial_load=1e3, screw_speed=U.Quantity(500.0, unit))
    assert OperatingState(axial_load=1e3, screw_speed=U.Quantity(60.0, "rpm")).screw_speed == pytest.approx(2 * math.pi)


SCREW = catalogue()["rexroth-40x10x6-6-double"].screw()
PRELOADED = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=1e3))
MODEL = bs.FrictionModel.corrected()
GRADE = bs.Lubricant.from_grade("ISO VG 100")
POINT = {"axial_load": 5e3, "screw_speed": 60.0}
IN_UNITS = {"axial_load": 5 * U.kN, "screw_speed": 60 * 30 / math.pi * U.rpm}
#: What is wanted of a screw or a result, and what only results have, is not given by anybody.
RESULTS = {
    "AxialRigidity",
    "AxisStiffness",
    "Breakaway",
    "ContactConditions",
    "Contact",
    "RaceState",
    "BallFriction",
    "FrictionResult",
    "BallLoads",
    "MovingChain",
    "NamedOrder",
    "Ripple",
    "OffLineBalls",
    "Reversal",
    "WindingUp",
    "FitError",
    "Dahl",
    "LuGre",
    "SlipElement",
    "Element",
    "Presliding",
}

#: Read from files, whose values are text.
READ = {"GuideRow", "LogRows", "Setup", "SupportUnit", "TorquePoint"}
#: A part of each class that has quantities for fields.
PARTS = [
    SCREW,
    GRADE,
    bs.DataSheet(kinematic_viscosity_40=1e-4, kinematic_viscosity_100=1.11e-5),
    MODEL,
    bs.Material(),
    catalogue()["rexroth-40x10x6-6-double"],
    OperatingState(**POINT),
    Installation(unsupported_length=1.0, ends=Ends.FIXED_FREE),
    Limits(running_time=3600.0),
    bs.SingleNut(1e-5),
    bs.DoubleNut(1000.0, 0.01),
    bs.OffsetLeadNut(1000.0, 0.01),
    bs.OversizeBallNut(1000.0),
    bs.Bodies.of(SCREW),
    Scatter(1e-6, 2e-6),
    bs.TorqueLog(axial_load=np.ones(3), screw_speed=np.ones(3), torque=np.ones(3), time=np.arange(3.0)),
    bs.TorqueSeries(torque=np.ones(3), time=np.arange(3.0), temperature=np.full(3, 300.0), screw_speed=np.ones(3)),
    bs.MovingLog(time=np.arange(3.0), force=np.ones(3), position=np.ones(3)),
    bs.Axis(mass=100.0, inclination=1.0, counterweight=5.0, guide_seal_force=3.0, inertia=1e-3, bearing_torque=0.1),
    ConstantEfficiency(lead=0.01, efficiency=0.9),
    bs.Motor(rated_torque=1.0, peak_torque=3.0, largest_speed=300.0, torque_constant=0.5, resistance=1.0),
    bs.Trapezoid(stroke=0.1, speed=0.2, acceleration=2.0, dwell=1.0),
    bs.SCurve(stroke=0.1, speed=0.2, acceleration=2.0, jerk=30.0),
    bs.Sine(stroke=0.1, frequency=2.0),
    bs.Segment(distance=0.1, speed=0.2, acceleration=2.0, temperature=300.0),
    bs.Segments(segments=(bs.Segment(duration=1.0),), acceleration=2.0, jerk=30.0),
    SupportBearing(bore=0.02, outside_diameter=0.047, contact_angle=1.0, lubricant=GRADE, preload=500.0),
    SKFBearing(bore=0.02, outside_diameter=0.047, lubricant=GRADE, preload=500.0),
    PalmgrenBearing(bore=0.02, outside_diameter=0.047, lubricant=GRADE, viscous_factor=2.0, load_factor=1e-3),
    KnownBearing(torque=0.1),
    MountedBearing(place="fixed", element=KnownBearing(torque=0.1), load_share=0.5, rigidity=1e8),
    SKFConstants(rolling=4e-7, axial_rolling=2.0, sliding=0.02, axial_sliding=0.7),
    LinearGuide(friction_coefficient=0.003, seal_force=3.0),
    bs.ContactGuide(ball_diameter=0.004, balls=14, lubricant=GRADE, preload=400.0),
    CarriedMass(mass=100.0, along=0.1),
    GuidedTable(masses=(CarriedMass(mass=100.0),), carriage_spacing=0.4, rail_spacing=0.3),
    bs.Surroundings(shaft_length=1.0, ball_conductance=2.0, shaft_convection=10.0, bore=0.01, coolant=290.0),
    SearchOptions(quantile=0.9),
    Requirements(feed=0.5, stroke=0.5, largest_drive_torque=10.0, least_rigidity=1e8),
]
PARTS += [
    nut_losses.EfficiencyDrag(0.9),
    nut_losses.ConstantTorque(0.2),
    *(
        getattr(nut_losses, name)()
        for name in ("JISDrag", "RexrothDrag", "Seals", "LipSeals", "Churning", "HarrisChurning", "Recirculation")
    ),
    nut_losses.ReturnBraking(),
    nut_losses.ShearedOil(),
    nut_losses.SpinUp(),
]
PARTS += [law() for laws in LAWS.values() for law in laws.values() if isinstance(law, type) and fields_of(law)]


def classes():
    """All dataclasses of the package that have quantities for fields."""
    found = set()
    for module in pkgutil.walk_packages(bs.__path__, "ballscrew."):
        if not module.name.endswith("__main__"):
            found |= {part for part in vars(importlib.import_module(module.name)).values() if isinstance(part, type)}
    ours = (c for c in found if c.__module__.startswith("ballscrew.") and not c.__name__.startswith("_"))
    # what a question answers is made by the program; people give what it asks
    answers = r"ballscrew\.questions\.(?!.*\.(options|need|requirements|design_space)$).*"
    ours = (c for c in ours if not re.fullmatch(answers, c.__module__))
    return {c for c in ours if dataclasses.is_dataclass(c) and fields_of(c)}


def with_unit(value, unit):
    """The same value in another unit of the same dimension, as people might give it."""
    quantity = U.Quantity(value, unit)
    other = {"m": "mm", "N": "kN", "rad/s": "rpm", "rad": "degree", "Pa": "MPa", "1": "percent"}.get(unit)
    return quantity.to(other) if other else quantity


def test_no_class_is_left_out():
    known = {type(part).__name__ for part in PARTS}
    assert {c.__name__ for c in classes()} - known - RESULTS <= READ


@pytest.mark.parametrize("part", PARTS, ids=lambda part: type(part).__name__)
def test_a_constructor_converts_or_refuses(part):
    given = {
        name: with_unit(getattr(part, name), quantity.unit)
        for name, quantity in fields_of(part).items()
        if getattr(part, name) is not None
    }
    made = dataclasses.replace(part, **given)
    for name in given:
        value, expected = getattr(made, name), getattr(part, name)
        assert not isinstance(value, pint.Quantity)
        np.testing.assert_allclose(value, expected, rtol=1e-12)
    name = next(iter(fields_of(part)))
    with pytest.raises(bs.InputError, match=f"{name}: wrong unit"):
        dataclasses.replace(part, **{name: U.Quantity(np.ones(np.shape(getattr(part, name))), "mol")})


def test_the_preload_of_a_nut_is_not_taken_for_newtons():
    assert bs.DoubleNut(preload=1 * U.kN).preload == 1000.0


def test_the_temperature_of_an_oil():
    oil = bs.Lubricant.from_grade("ISO VG 100", U.Quantity(60.0, "degC"))
    assert oil == GRADE.at(333.15) or oil.viscosity == pytest.approx(GRADE.at(333.15).viscosity, rel=1e-12)
    assert dataclasses.replace(GRADE, temperature=U.Quantity(60.0, "degC")).viscosity == GRADE.at(333.15).viscosity
    with pytest.raises(bs.InputError, match=r"lubricant.temperature: wrong unit"):
        dataclasses.replace(GRADE, temperature=3 * U.mm)


def torque(result):
    return np.asarray(result.screw_torque, dtype=float)


#: Each takes the operating point as it is given, and returns numbers.
CALLS = {
    "model": lambda **point: torque(MODEL(SCREW, OIL, **point)),
    "model of a nut": lambda **point: torque(MODEL(PRELOADED, OIL, **point)),
    "sweep": lambda **point: torque(bs.sweep(MODEL, SCREW, OIL, **point)),
    "sweep of a nut": lambda **point: torque(bs.sweep(MODEL, SCREW, OIL, nut=bs.DoubleNut(1e3), **point)),
    "evaluator": lambda **point: bs.evaluator(MODEL, SCREW, OIL, engine="numpy")(**point)["screw_torque"],
    "derivatives": lambda **point: torque(bs.derivatives(MODEL, SCREW, OIL, by=["axial_load"], **point)),
}
ONE_POINT = {
    "ball_loads": lambda axial_load, screw_speed: ball_loads(SCREW, bs.SingleNut(), axial_load).forward_load,
    "checks": lambda **point: [check.value for check in checks(SCREW, **point) if check.value is not None],
    "monte_carlo": lambda **point: (
        bs.monte_carlo(
            MODEL, SCREW, OIL, distributions={"viscosity": bs.Normal(0.1, 0.01)}, samples=16, **point
        ).screw_torque_mean.values
    ),
    "band": lambda **point: (
        bs.band(MODEL, SCREW, OIL, distributions={"viscosity": bs.Normal(0.1, 0.01)}, samples=16, **point)[
            "screw_torque"
        ].median
    ),
    "sensitivity": lambda **point: (
        bs.sensitivity(MODEL, SCREW, OIL, distributions={"viscosity": bs.Normal(0.1, 0.01)}, method="local", **point)
        .first_order["viscosity"]
        .value
    ),
    "drag": lambda axial_load, screw_speed: nut_losses.JISDrag()(axial_load, 0.04, 0.04, 0.01),
}


@pytest.mark.parametrize("name", [*CALLS, *ONE_POINT])
def test_a_call_converts(name):
    call = (CALLS | ONE_POINT)[name]
    np.testing.assert_allclose(call(**IN_UNITS), call(**POINT), rtol=1e-9)


@pytest.mark.parametrize("name", CALLS)
def test_arrays_and_lists_of_quantities(name):
    expected = CALLS[name](axial_load=[1e3, 2e3], screw_speed=60.0)
    for loads in ([1, 2] * U.kN, [1 * U.kN, 2000 * U.N], np.array([1.0, 2.0]) * U.kN):
        np.testing.assert_allclose(CALLS[name](axial_load=loads, screw_speed=60.0), expected, rtol=1e-9)
    with pytest.raises(bs.InputError, match="some of the numbers have a unit"):
        CALLS[name](axial_load=[1 * U.kN, 2000.0], screw_speed=60.0)
    with pytest.raises(bs.InputError, match=r"axial_load: wrong unit .*give a quantity in N"):
        CALLS[name](axial_load=[1.0, 2.0] * U.mm, screw_speed=60.0)


def test_labelled_arrays_state_their_unit_in_two_ways():
    loads = xr.DataArray([1e3, 2e3], dims="row")
    expected = torque(bs.sweep(MODEL, SCREW, OIL, axial_load=loads, screw_speed=60.0))
    of_pint = xr.DataArray([1.0, 2.0] * U.kN, dims="row")
    np.testing.assert_allclose(torque(bs.sweep(MODEL, SCREW, OIL, axial_load=of_pint, screw_speed=60.0)), expected)
    same = loads.assign_attrs(units="N")
    np.testing.assert_array_equal(torque(bs.sweep(MODEL, SCREW, OIL, axial_load=same, screw_speed=60.0)), expected)
    with pytest.raises(bs.InputError, match=r"another unit by its attribute units \(kN\)"):
        bs.sweep(MODEL, SCREW, OIL, axial_load=loads.assign_attrs(units="kN"), screw_speed=60.0)


@pytest.mark.parametrize("name", ["model", "model of a nut"])
def test_a_call_takes_labelled_arrays_of_points_and_refuses_those_of_a_grid(name):
    loads, speeds = xr.DataArray([1e3, 2e3, 3e3], dims="load"), xr.DataArray([60.0, 70.0], dims="speed")
    call = CALLS[name]
    expected = call(axial_load=loads.values, screw_speed=60.0)
    of_pint = xr.DataArray([1.0, 2.0, 3.0] * U.kN, dims="load")
    for given in (loads, of_pint, loads.assign_attrs(units="N")):
        np.testing.assert_allclose(call(axial_load=given, screw_speed=60.0), expected, rtol=1e-12)
    for grid in (speeds, xr.DataArray([60.0, 70.0, 80.0], dims="speed")):
        with pytest.raises(bs.InputError, match=r"has arrays along different dimensions .*use ballscrew.sweep"):
            call(axial_load=loads, screw_speed=grid)
    with pytest.raises(bs.InputError, match=r"axial_load: is in another unit by its attribute units \(kN\)"):
        call(axial_load=loads.assign_attrs(units="kN"), screw_speed=60.0)


def test_what_takes_units_says_that_plain_numbers_come_out():
    for function in (bs.FrictionModel.__call__, bs.rigidity_iso3408):
        assert "Quantities of pint are converted" in function.__doc__
        assert "plain numbers, in SI" in function.__doc__


def test_points_along_a_band():
    with pytest.raises(bs.InputError, match=r"band.points: takes no unit"):
        band_along(MODEL, SCREW, OIL, along="axial_load", points=[1, 2] * U.kN, distributions={}, **POINT)


def test_a_distribution_refuses_quantities():
    for make in (lambda: bs.Normal(10 * U.mm, 0.1 * U.mm), lambda: bs.Normal(0.01, 1e-4, low=9 * U.mm)):
        with pytest.raises(bs.InputError, match=r"must be a finite number .*give one number in SI"):
            make()


def test_deviations_of_balls():
    plain, given = bs.Deviations(ball_diameter=1e-6), bs.Deviations(ball_diameter=1 * U.um)
    screw = dataclasses.replace(SCREW, loaded_balls=5)
    loads = [ball_loads(screw, bs.DoubleNut(1e3), 1e3, deviations=each).forward_load for each in (plain, given)]
    np.testing.assert_allclose(*loads, rtol=1e-12)


def test_logs_and_fits():
    loads, speeds = np.linspace(1e3, 5e3, 12), np.full(12, 60.0)
    measured = torque(MODEL(SCREW, OIL, axial_load=loads, screw_speed=speeds))
    log = bs.TorqueLog.of(
        {"axial_load": loads / 1e3 * U.kN, "screw_speed": speeds, "torque": measured * 1e3 * U("N mm")}
    )
    np.testing.assert_allclose([log.axial_load, log.torque], [loads, measured], rtol=1e-12)
    with pytest.raises(bs.InputError, match=r"data.axial_load: wrong unit"):
        bs.TorqueLog.of({"axial_load": loads * U.mm, "screw_speed": speeds, "torque": measured})
    free, bounds = ["viscosity"], {"viscosity": (10 * U("mPa s"), 500 * U("mPa s"))}
    found = bs.fit(MODEL, SCREW, OIL, log, free, bounds=bounds, kind="friction", engine="numpy")
    assert found.estimates["viscosity"].bounds == pytest.approx((0.01, 0.5))
    assert found.predict(5 * U.kN, 60.0) == found.predict(5e3, 60.0)
    assert found.band(5 * U.kN, 60.0) == found.band(5e3, 60.0)


def test_a_law_by_its_name_in_python():
    with pytest.raises(bs.InputError, match=r"model.rolling: must be a law, not its name .*rolling=houpert_rolling"):
        dataclasses.replace(MODEL, rolling="houpert")
