"""Oils in case files: by their data sheet, by name in the library or a file of one's own; the library itself."""

import copy
import re
from importlib import resources

import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file, descriptions
from ballscrew.cases.case_files.descriptions import inputs, references
from ballscrew.faces.web.bodies import case_of

TABLES = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "operation": {"axial_load": "5 kN", "screw_speed": "600 rpm"},
}
SHEET = {
    "kinematic_viscosity_40": "100 cSt", "kinematic_viscosity_100": "11.1 mm^2/s", "density_15": "880 kg/m^3",
    "temperature": "-20 degC",
}  # fmt: skip
LIBRARY = bs.oils()


def case_with(oil, **where):
    return case_file.build({**TABLES, "lubricant": oil}, **where)


def test_a_data_sheet_in_a_case_file():
    case = case_with(SHEET)
    made = bs.Lubricant.from_data_sheet(100e-6, 11.1e-6, 880.0, 253.15)
    assert case.lubricant.viscosity == pytest.approx(made.viscosity, rel=1e-12)
    given = inputs(case)["lubricant"]
    assert given["kinematic_viscosity_40"] == pytest.approx(1e-4)
    assert given["viscosity"] == case.lubricant.viscosity
    assert "ASTMD341" in references(case)
    assert any("100 cSt at 40 °C" in text for text in descriptions.assumptions(case))


def test_a_measured_density_counts_beside_a_data_sheet():
    assert case_with({**SHEET, "density": "870 kg/m^3"}).lubricant.density == 870.0


def test_an_oil_by_its_name_and_what_is_changed_of_it():
    case = case_with({"oil": "arcanol load150", "temperature": "20 degC"})
    assert case.lubricant == bs.Lubricant.from_sheet(LIBRARY["Arcanol LOAD150"], 293.15)
    assert case.origins.oil["oil"] == "Arcanol LOAD150"
    other = case_with({"oil": "Arcanol LOAD150", "kinematic_viscosity_40": "150 cSt"}).lubricant
    assert other.kinematic_viscosity == pytest.approx(150e-6, rel=1e-12)
    assert other.sheet.kinematic_viscosity_100 == LIBRARY["Arcanol LOAD150"].kinematic_viscosity_100


def test_an_oil_of_ones_own_file(tmp_path):
    (tmp_path / "mine.toml").write_text(
        '[oils.Mine]\nkinematic_viscosity_40 = "68 cSt"\nkinematic_viscosity_100 = "8.7 cSt"\n', encoding="utf-8"
    )
    oil = case_with({"oil": "mine", "oil_file": "mine.toml"}, folder=tmp_path).lubricant
    assert oil.sheet.source == "mine.toml"
    assert bs.oils(tmp_path / "mine.toml")["Mine"] == oil.sheet
    with pytest.raises(InputError, match=r"lubricant\.oil_file: is not taken from a request"):
        case_of({**TABLES, "lubricant": {"oil": "mine", "oil_file": "mine.toml"}})


@pytest.mark.parametrize(
    ("oil", "fault"),
    [
        ({**SHEET, "grade": "ISO VG 100"}, "lubricant.grade: contradicts kinematic_viscosity_40"),
        ({**SHEET, "viscosity": "88 mPa s"}, "lubricant.viscosity: contradicts kinematic_viscosity_40"),
        ({"oil": "Arcanol FOOD2", "grade": "VG 100"}, "lubricant.grade: contradicts oil"),
        ({"kinematic_viscosity_40": "100 cSt"}, "lubricant.kinematic_viscosity_100: missing"),
        ({"pour_point": "-10 degC"}, "lubricant.pour_point: is of a data sheet"),
        ({"oil": "Arcanol FOD2"}, 'lubricant.oil: unknown oil .* did you mean "Arcanol FOOD2"'),
        ({"oil_file": "mine.toml", "viscosity": "88 mPa s"}, "lubricant.oil_file: needs the name of an oil"),
        ({**SHEET, "temperature": "-90 degC"}, "lubricant.temperature: must be at least -80 degC"),
        ({"grade": "VG 100", "temperature": "-30 degC"}, "lubricant.temperature: must be at least -20 degC"),
        ({"temperature": "40 degC"}, "lubricant.temperature: needs a grade or a data sheet"),
        ({}, "lubricant.viscosity: missing"),
    ],
)
def test_faults(oil, fault):
    with pytest.raises(InputError, match=fault):
        case_with(oil)


def test_an_oil_is_changed_for_another_by_settings():
    oil = {"oil": "Arcanol FOOD2", "temperature": "40 degC"}
    tables = copy.deepcopy({**TABLES, "lubricant": oil})
    with pytest.raises(InputError, match=r"contradicts oil .* --set lubricant.oil= takes this away"):
        case_file.build(case_file.override(copy.deepcopy(tables), ["lubricant.grade=ISO VG 100"]))
    changed = case_file.override(tables, ["lubricant.grade=ISO VG 100", "lubricant.oil="])
    assert case_file.build(changed).lubricant.grade == "ISO VG 100"


def test_faults_of_a_file_are_found_all_at_once(tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text(
        '[oils.A]\nkinematic_viscosity_40 = "68 cSt"\n'
        '[oils.B]\nkinematic_viscosity_40 = "6 cSt"\nkinematic_viscosity_100 = "9 cSt"\ncolour = "red"\n',
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        bs.oils(file)
    assert [fault.where for fault in caught.value.faults] == [
        'bad.toml: oils."A".kinematic_viscosity_100',
        'bad.toml: oils."B".colour',
    ]
    with pytest.raises(InputError, match="does not exist"):
        bs.oils(tmp_path / "none.toml")


def test_the_library_has_its_sources_and_can_be_computed_in_its_range():
    keys = set(
        re.findall(r"@\w+\{(\w[\w-]*),", resources.files("ballscrew").joinpath("data/references.bib").read_text())
    )
    for sheet in LIBRARY.values():
        assert sheet.source in keys, sheet.name
        low = sheet.lowest_temperature or sheet.pour_point
        for temperature in (low, min(sheet.highest_temperature or 393.15, 473.15)):
            # the thickest, at -40 °C, is the base oil of a grease that its maker states down to there
            assert 1e-3 < bs.Lubricant.from_sheet(sheet, temperature).viscosity < 2e4, sheet.name


@pytest.mark.parametrize(
    ("name", "index"),
    # as their maker states it, beside the viscosities
    [
        ("Mobil EAL Envirosyn H 32", 147), ("Mobil EAL Envirosyn H 100", 136), ("Mobil SHC 824", 135),
        ("Mobil SHC Gear OH 320", 178), ("Mobil SHC Gear OH 460", 186), ("Mobil SHC Gear OH 680", 193),
    ],
)  # fmt: skip
def test_the_stated_index_follows_from_the_stated_viscosities(name, index):
    assert LIBRARY[name].viscosity_index == pytest.approx(index, abs=1.5)
