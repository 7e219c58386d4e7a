"""Units at the edge: what people write, in SI, or one fault that says how to write it."""

import math

import pytest

from ballscrew.basis import units
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.solvers.load_distribution import BallLoads

KNOWN = {
    **quantities_of(BallScrew),
    **quantities_of(Lubricant),
    **quantities_of(OperatingState),
    "temperature": TEMPERATURE,
}


@pytest.mark.parametrize(
    ("name", "written", "expected"),
    [
        ("lead", "5 mm", 0.005),
        ("lead", "5mm", 0.005),
        ("lead", " 5e-3  m ", 0.005),
        ("lead", "0.2 in", 0.00508),
        ("ball_diameter", "1/4 in", 0.00635),
        ("ball_diameter", "1 3/16in", 0.0301625),
        ("ball_roughness", "0.08 µm", 0.08e-6),
        ("ball_roughness", "0.08 um", 0.08e-6),
        ("contact_angle", "45 deg", math.pi / 4),
        ("contact_angle", "45°", math.pi / 4),
        ("screw_speed", "600 rpm", 20 * math.pi),
        ("screw_speed", "10 rev/s", 20 * math.pi),
        ("screw_speed", "3600 deg/s", 20 * math.pi),
        ("axial_load", "4 kN", 4000.0),
        ("axial_load", "1 lbf", 4.4482216152605),
        ("viscosity", "0.1 Pa s", 0.1),
        ("viscosity", "0.1 Pa·s", 0.1),
        ("viscosity", "100 cP", 0.1),
        ("pressure_viscosity_coefficient", "2.2e-8 1/Pa", 2.2e-8),
        ("pressure_viscosity_coefficient", "22 GPa⁻¹", 2.2e-8),
        ("temperature", "40 degC", 313.15),
        ("temperature", "40 °C", 313.15),
        ("temperature", "104 degF", 313.15),
        ("loaded_balls", 56, 56.0),
        ("screw_conformity", 0.515, 0.515),
    ],
)
def test_written_values_in_si(name, written, expected):
    assert units.parse(name, written, KNOWN[name]) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "written", "problem", "remedy"),
    [
        ("lead", 5, "needs a unit", 'write "5 mm"'),
        ("lead", "5", "needs a unit", 'write "5 mm"'),
        ("lead", "5 N", "wrong unit", "use a unit such as mm, um or in"),
        ("lead", "5 m^0", "unknown unit", "use a unit such as mm, um or in"),
        ("lead", "5 mmm", "unknown unit", "use a unit such as mm, um or in"),
        ("lead", "5 MM", "unknown unit", 'did you mean "mm"?'),
        ("axial_load", "5 KN", "unknown unit", 'did you mean "kN"?'),
        ("axial_load", "5 NM", "unknown unit", "use a unit such as N, kN or lbf"),
        ("viscosity", "100 mPas", "wrong unit", 'did you mean "mPa s"?'),
        ("temperature", "40 C", "unknown unit", "use a unit such as degC, K or degF"),
        ("lead", "3,500 mm", "could be two numbers", "write 3500 for thousands, 3.5 for a decimal"),
        ("axial_load", "4,000 N", "could be two numbers", "write 4000 for thousands, 4.0 for a decimal"),
        ("lead", "1,2,3 mm", "is not a number", "write a decimal point"),
        ("lead", "1 50 mm", "is not a number with a unit", 'write it like "1 mm"'),
        ("lead", "five mm", "is not a number with a unit", 'write it like "1 mm"'),
        ("lead", "", "is not a number with a unit", 'write it like "1 mm"'),
        ("lead", True, "must be a number with a unit", 'write it like "1 mm"'),
        ("lead", ["5 mm"], "must be a number with a unit", 'write it like "1 mm"'),
        *(
            ("screw_speed", f"600 {unit}", problem, 'write it in rpm, such as "1500 rpm"')
            for unit, problem in {
                "Hz": "wrong unit",
                "1/s": "wrong unit",
            }.items()
        ),
        ("viscosity", "100 cSt", "wrong unit", "ISO VG 100"),
        ("contact_angle", 45, "needs a unit", 'write "45 deg"'),
        ("loaded_balls", "56 mm", "takes no unit", "a number of balls: about turns"),
        ("loaded_balls", "4 turns", "takes no unit", "turns · pi · pitch_circle_diameter / ball_diameter"),
        ("loaded_balls", "4 %", "takes no unit", "a number of balls"),
        ("screw_conformity", "52 %", "takes no unit", "write 0.52"),
        ("screw_conformity", "1.7 mm", "takes no unit", "it is a plain number: grooves have 0.515 to 0.54"),
    ],
)
def test_faults_name_the_value_and_the_remedy(name, written, problem, remedy):
    fault = units.parse(name, written, KNOWN[name])
    assert isinstance(fault, Fault)
    assert fault.parts[0] == problem
    assert remedy in fault.parts[2]


@pytest.mark.parametrize("unit", ["1/min", "U/min", "/min", "min^-1", "min-1", "min⁻¹", "r/min", "1 / min", "rpm"])
def test_speeds_as_drives_state_them(unit):
    assert units.parse("", f"600 {unit}", KNOWN["screw_speed"]) == units.parse("", "600 rpm", KNOWN["screw_speed"])


@pytest.mark.parametrize(
    ("written", "newtons"),
    [
        ("1 500 N", 1500),
        ("12 345 678 N", 12345678),
        ("1\u202f500 N", 1500),
        ("1\u00a0500 N", 1500),
        ("1'500 N", 1500),
        ("5,5 kN", 5500),
        ("5,25 kN", 5250),
        ("0,500 kN", 500),
        (",5 kN", 500),
        ("1,5e3 N", 1500),
        ("1.500,5 N", 1500.5),
        ("1,500.5 N", 1500.5),
        ("-1 500,25 N", -1500.25),
        ("1.500 N", 1.5),
    ],
)
def test_numbers_as_people_write_them(written, newtons):
    assert units.parse("", written, KNOWN["axial_load"]) == newtons


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_every_quantity_can_be_written_as_its_own_example(name):
    """The unit a message proposes is one the parser takes, and SI comes back through it."""
    quantity = KNOWN[name]
    written = "1" if quantity.unit == "1" else f"1 {quantity.shown_in}"
    value = units.parse(name, written, quantity)
    assert isinstance(value, float)
    assert units.from_si(value, quantity) == pytest.approx(1, rel=1e-12)


@pytest.mark.parametrize("written", ["\u22124000 N", "-４０００ N", "\u2212４．０　ｋＮ", "\uff0d4e3 N"])
def test_signs_and_digits_of_other_keyboards(written):
    """A minus sign as it is printed, and full-width forms, which are one number to people."""
    assert units.parse("axial_load", written, KNOWN["axial_load"]) == -4000


@pytest.mark.parametrize("name", ["loaded_balls", "screw_conformity", "starts"])
@pytest.mark.parametrize("unit", ["turns", "mm", "balls", "kN"])
def test_no_remedy_drops_a_word(name, unit):
    """4 turns are not 4 balls."""
    fault = units.parse(name, f"4 {unit}", KNOWN[name])
    assert isinstance(fault, Fault)
    assert "write 4" not in fault.parts[2]


@pytest.mark.parametrize("name", sorted(name for name, quantity in KNOWN.items() if quantity.unit != "1"))
def test_units_in_messages_are_of_the_right_kind(name):
    """A unit proposed for a misspelt one is the same but for capitals, and the parser takes it."""
    quantity = KNOWN[name]
    # all units that messages propose: a message has one or two of them
    for unit in units._usual(quantity):
        assert isinstance(units.parse(name, f"1 {unit}", quantity), float)
        for written in (unit.upper(), unit.lower(), unit.swapcase()):
            fault = units.parse(name, f"1 {written}", quantity)
            if isinstance(fault, Fault) and fault.parts[2].startswith("did you mean"):
                assert fault.parts[2].split('"')[1].lower() == written.lower()


def test_a_length_below_a_nucleus_is_shown_as_none():
    """The displacement of a nut without load, of which rounding leaves 1e-22 m; films and roughness are far larger."""
    quantity = quantities_of(BallLoads)["deflection"]
    assert units.shown(8.47e-22, quantity) == units.shown(-6.4e-18, quantity) == "0 µm"
    assert units.shown(2e-15, quantity) == "2e-09 µm"
    assert units.shown(8.47e-22, fields_of(OperatingState)["axial_load"]) == "8.47e-22 N"
    assert units.shown(math.nan, quantity) == "nan µm"


@pytest.mark.parametrize(
    ("number", "digits", "toward", "expected"),
    [
        (24_000.0, 2, 0, "24000"),
        (-40_334.0, 4, 0, "-40330"),
        (999_999.0, 4, 0, "1e+06"),
        (123_456.0, 3, 1, "124000"),
        (123_456.0, 3, -1, "123000"),
        (1e6, 4, 0, "1e+06"),
        (1.25e-4, 3, 0, "0.000125"),
        (1.25e-5, 3, 0, "1.25e-05"),
        (123.456789, 9, 0, "123.456789"),
        (float("inf"), 4, 0, "inf"),
    ],
)
def test_numbers_of_every_day_have_no_exponent(number, digits, toward, expected):
    assert units.to_digits(number, digits, toward) == expected
