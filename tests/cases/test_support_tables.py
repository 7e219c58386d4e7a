"""Bearings and guides in case files: what they may say, what is refused, and what they are made of."""

import math
import tomllib

import pytest

import ballscrew as bs
from ballscrew.axis.supports.element_laws import guide_rows, support_units
from ballscrew.axis.supports.makers_bearing import KnownBearing, SKFBearing
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.cases.schema import case_schema
from ballscrew.faces.web.bodies import case_of

CASE = """
[screw]
catalogue = "hiwin-40-20k4"
[nut]
type = "double"
preload = "2.5 kN"
[lubricant]
grade = "ISO VG 100"
temperature = "40 degC"
[axis]
mass = "400 kg"
[motion]
kind = "trapezoid"
stroke = "0.5 m"
speed = "30 m/min"
acceleration = "0.5 g"
"""
BEARINGS = """
[bearings.fixed]
catalogue = "FK30"
preload = "2 kN"
grade = "ISO VG 32"
[bearings.floating]
law = "known"
torque = "3 N cm"
[guides]
catalogue = "MRS35"
carriages = 6
"""


def built(more, *settings):
    return case_file.build(case_file.override(tomllib.loads(CASE + more), settings), moves=True)


def faults(more, *settings):
    with pytest.raises(InputError) as refused:
        built(more, *settings)
    return str(refused.value)


def test_a_row_of_a_catalogue_and_what_the_case_adds():
    case = built(BEARINGS)
    fixed, floating = case.bearings["fixed"], case.bearings["floating"]
    unit = support_units()["FK30"]
    assert isinstance(fixed.element, bs.SupportBearing)
    assert (fixed.element.bore, fixed.element.outside_diameter) == (0.030, 0.062)
    assert (fixed.element.contact_angle, fixed.element.preload) == (math.radians(30), 2000.0)
    assert (fixed.rigidity, fixed.load_share, fixed.name) == (unit.rigidity, 1.0, "fixed bearing")
    assert fixed.element.lubricant == bs.Lubricant.from_grade("ISO VG 32", 313.15)
    assert floating.element == KnownBearing(torque=0.03)
    assert (floating.load_share, floating.rigidity) == (0.0, None)
    row = guide_rows()["MRS35"]
    assert case.axis.guides == bs.LinearGuide(friction_coefficient=0.003, seal_force=row.seal_force, carriages=6)


def test_the_oil_of_the_screw_is_that_of_a_bearing_without_one():
    sizes = 'bore = "20 mm"\noutside_diameter = "47 mm"\nrows = 1\n'
    case = built(f'[bearings.fixed]\nlaw = "skf"\n{sizes}')
    assert case.bearings["fixed"].element == SKFBearing(
        bore=0.020, outside_diameter=0.047, rows=1, lubricant=case.lubricant
    )


def test_two_fixed_bearings_share_the_load():
    known = 'law = "known"\ntorque = "0.1 N m"\n'
    case = built(f"[bearings.fixed]\n{known}[bearings.second_fixed]\n{known}")
    assert {place: one.load_share for place, one in case.bearings.items()} == {"fixed": 0.5, "second_fixed": 0.5}


def test_carriages_have_loads_of_their_own_where_the_case_tells_where_they_are():
    case = built(
        BEARINGS,
        "guides.carriages=4",
        'guides.carriage_spacing="0.4 m"',
        'guides.rail_spacing="300 mm"',
        'guides.above="0.25 m"',
    )
    loads = case.axis.carriage_loads(2.0)
    assert loads.sum() == pytest.approx(400 * 9.80665)
    assert loads[0] - loads[1] == pytest.approx(400 * 2.0 * 0.25 / 0.4)


def test_inputs_are_in_si():
    found = inputs(built(BEARINGS))
    assert found["bearings"]["fixed"]["law"] == "contacts"
    assert found["bearings"]["fixed"]["rigidity"] == 195e6
    assert found["bearings"]["floating"] == {"law": "known", "torque": 0.03, "load_share": 0.0}
    assert found["guides"] == {"law": "maker", "friction_coefficient": 0.003, "seal_force": 0.8, "carriages": 6}


def test_the_schema_has_the_fields_with_their_units():
    defined = case_schema.json_schema()["$defs"]
    assert defined["Bearing"]["properties"]["preload"]["x-unit"] == "N"
    assert defined["Bearing"]["properties"]["law"]["enum"] == ["contacts", "skf", "palmgren", "known"]
    assert set(defined["Bearings"]["properties"]) == {"fixed", "floating", "second_fixed"}
    assert defined["Guides"]["properties"]["rail_spacing"]["x-si-unit"] == "m"


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("bearings.fixed.rowz=2", 'bearings.fixed.rowz: unknown key · did you mean "rows"?'),
        ('bearings.fixed.law="schaeffler"', "bearings.fixed.law: unknown law of a bearing"),
        ('bearings.fixed.catalogue="FK31"', 'bearings.fixed.catalogue: unknown row (FK31) · did you mean "FK30"?'),
        ('bearings.fixed.catalogue="FK6"', 'bearings.fixed.bore: missing · add bore = "… mm"'),
        ('bearings.fixed.oil="nothing"', "bearings.fixed.grade: contradicts oil (ISO VG 32)"),
        ('bearings.fixed.preload="-2 kN"', "bearings.fixed.preload: must not be negative"),
        ("bearings.fixed.load_share=2", "bearings.fixed.load_share: must be at most 1"),
        ('bearings.floating.preload="3 N"', 'bearings.floating.preload: the law "known" has none'),
        ('bearings.floating.grade="ISO VG 32"', 'bearings.floating.grade: a bearing of law "known" has none'),
        ('axis.bearing_torque="1 N m"', "axis.bearing_torque: is given beside the bearings (1 N m)"),
        ('axis.guide_seal_force="1 N"', "axis.guide_seal_force: is given beside the guides (1 N)"),
        ('guides.catalogue="MRS36"', "guides.catalogue: unknown row (MRS36)"),
        ('guides.above="0.1 m"', 'guides.carriage_spacing: missing · add carriage_spacing = "… mm"'),
        ('installation.ends="fixed-fixed"', "installation.ends: has no floating bearing"),
    ],
)
def test_a_fault_names_the_field_and_the_way_out(setting, said):
    more = ("installation.unsupported_length=1 m",) if setting.startswith("installation") else ()
    assert said in faults(BEARINGS, setting, *more)


def test_a_preload_that_no_catalogue_prints_is_asked_for():
    text = BEARINGS.replace('preload = "2 kN"\n', "")
    assert 'bearings.fixed.preload: is not printed in the catalogue (FK30) · add preload = "… N"' in faults(text)


def test_something_holds_the_shaft():
    assert "bearings.fixed: missing" in faults('[bearings.floating]\nlaw = "known"\ntorque = "0.1 N m"')


def test_a_table_stands_on_four_carriages_unless_it_says_so():
    places = ('guides.carriage_spacing="0.4 m"', 'guides.rail_spacing="300 mm"')
    left_out = built(BEARINGS.replace("carriages = 6\n", ""), *places)
    assert left_out.axis.table == built(BEARINGS, "guides.carriages=4", *places).axis.table
    assert left_out.axis.guides.carriages == 4


def test_guides_carry_an_axis():
    text = CASE.partition("[axis]")[0] + '[operation]\naxial_load = "1 kN"\nscrew_speed = "100 rpm"\n' + BEARINGS
    with pytest.raises(InputError, match="guides: carry the mass of an axis"):
        case_file.build(tomllib.loads(text))


def test_the_rule_of_one_efficiency_lends_no_oil():
    text = (CASE + BEARINGS).replace('[lubricant]\ngrade = "ISO VG 100"\ntemperature = "40 degC"\n', "")
    rule = ['model.name="constant-efficiency"', "model.efficiency=0.9"]
    tables = case_file.override(tomllib.loads(text.replace('grade = "ISO VG 32"\n', "")), rule)
    with pytest.raises(InputError, match=r"bearings\.fixed\.grade: missing"):
        case_file.build(tables, moves=True)
    assert case_file.build(case_file.override(tomllib.loads(text), rule), moves=True).bearings


def test_numbers_that_friction_goes_with_may_have_a_distribution():
    case = built(
        BEARINGS, 'bearings.floating.torque="(3 ± 1) N cm"', 'guides.friction_coefficient="uniform(0.002, 0.004)"'
    )
    assert case.bearings["floating"].element.torque == pytest.approx(0.03)
    assert case.axis.guides.friction_coefficient == pytest.approx(0.003)
    assert set(case.origins.uncertain_supports) == {"bearings.floating.torque", "guides.friction_coefficient"}
    assert case.origins.uncertain_supports["guides.friction_coefficient"] == bs.Uniform(0.002, 0.004)
    assert "bearings.fixed.preload" in faults(BEARINGS, 'bearings.fixed.preload="2 ± 0.1 kN"')


@pytest.mark.parametrize("section", ["bearings.fixed", "guides"])
def test_a_request_reads_no_file_of_the_server(section):
    more = BEARINGS.replace(f"[{section}]", f'[{section}]\noil_file = "/etc/passwd"')
    with pytest.raises(InputError, match=rf"{section}\.oil_file: is not taken from a request"):
        case_of(tomllib.loads(CASE + more))
