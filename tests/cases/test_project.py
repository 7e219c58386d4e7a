"""Project files: what is written is read again, what is wrong is said, and a path names one design."""

import json
import tomllib

import pytest
import tomli_w
import tomlkit

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file, project
from ballscrew.cases.case_files.opened_file import opened
from ballscrew.cases.case_files.project import Design

CASE = {
    "screw": {"catalogue": "hiwin-40-20k4", "contact_angle": "45 ± 2 deg"},
    "nut": {"type": "single"},
    "lubricant": {"grade": "ISO VG 68", "temperature": "40 degC"},
    "operation": {"axial_load": "4 kN", "screw_speed": "600 rpm"},
    "model": {"rolling": {"law": "houpert"}},
}
DESIGNS = [
    Design("as it is", CASE),
    Design("Öl #2", {**CASE, "lubricant": {"grade": "ISO VG 150"}}, {"shop": {"a": 1}}),
]


@pytest.fixture(params=["toml", "json"])
def file(request, tmp_path):
    tables = project.tables_of(DESIGNS)
    path = tmp_path / f"two.{request.param}"
    text = tomlkit.dumps(tables) if request.param == "toml" else json.dumps(tables)
    path.write_text(text, encoding="utf-8")
    return path


def test_what_is_written_is_read_again(file):
    assert project.read(file) == DESIGNS
    assert opened(file).designs == DESIGNS
    assert case_file.read(f"{file}#Öl #2")["lubricant"] == {"grade": "ISO VG 150"}
    assert case_file.load(f"{file}#as it is").origins.row.name == "hiwin-40-20k4"
    for path, words in ((file, "several designs (as it is, Öl #2)"), (f"{file}#no", "has no such design (no)")):
        with pytest.raises(InputError) as error:
            case_file.read(path)
        assert words in str(error.value)


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({"ballscrew_project": 2, "designs": []}, "a project of an unknown version (2)"),
        ({"ballscrew_project": True, "designs": []}, "unknown version (True)"),
        ({"designs": [{"name": "a", "case": {}}]}, "a project without a version"),
        ({"ballscrew_project": 1, "designs": []}, "has no designs"),
        ({"ballscrew_project": 1, "design": []}, 'did you mean "designs"'),
        ({"ballscrew_project": 1, "designs": [{"name": "a", "case": {}}] * 2}, "designs.a: is the name of two"),
        ({"ballscrew_project": 1, "designs": [{"case": {}, "nam": "a"}]}, "designs[1].name: must be text"),
        ({"ballscrew_project": 1, "designs": [{"name": "a", "cases": {}}]}, "designs[1].case: must be a table"),
    ],
)
def test_what_is_no_project_is_said(tables, words):
    with pytest.raises(InputError) as error:
        project.designs_of(tables, "two.toml")
    assert words in str(error.value)


def test_a_case_file_opened(tmp_path):
    """Comments are counted, not those in strings; tables that no case has are kept aside, and no fault is found."""
    path = tmp_path / "mine.toml"
    path.write_text(
        "# of the shop\n[screw]\nlead = \"five # mm\"  # a fault\n[shop]\nbin = 7\n[operation]\naxial_load = '4 kN #'\n"
    )
    found = opened(path)
    assert (found.kind, found.comments) == ("case", 2)
    (design,) = found.designs
    assert (design.name, list(design.tables), design.aside) == ("mine", ["screw", "operation"], {"shop": {"bin": 7}})


def test_a_table_opened_is_its_rows_by_their_numbers(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text("name,d0 [mm],lead [mm],ball [mm],turns,nut,colour\nA,40,20,6,4,single,red\nB,1,20,6,4,single,\n")
    found = opened(path)
    assert (found.kind, [one.name for one in found.designs]) == ("table", ["A"])
    assert "catalogue" not in found.designs[0].tables["screw"]
    assert case_file.build(found.designs[0].tables).screw.lead == pytest.approx(0.02)
    assert any("colour" in note for note in found.notes)
    assert any("row 3" in note for note in found.notes)


@pytest.mark.parametrize(
    ("headings", "is_log"),
    [("axial load [N],torque [N m]", True), ("part,torque [N m]", False), ("part,speed [rpm]", False)],
)
def test_a_table_is_a_log_where_it_has_a_torque_and_what_belongs_to_it(headings, is_log, tmp_path):
    path = tmp_path / "bench.csv"
    path.write_text(f"{headings}\n1000,2\n2000,3\n")
    with pytest.raises(InputError) as error:
        opened(path)
    assert ("is a log of torques" in str(error.value)) is is_log


def test_results_are_no_case(tmp_path):
    path = tmp_path / "answer.json"
    path.write_text('{"inputs": {"screw": 1}, "results": {}}')
    with pytest.raises(InputError, match="has results and no case"):
        opened(path)


@pytest.mark.parametrize(
    "tables",
    [
        {"a": 1, "b": {"c": [1, {"d": []}, [True, -0.5e-300]], "e": {}}, "f": {"g": {"h": 2}}},
        {"rows": [{"a": 1, "b": {"c": 2}}, {}, {"rows": [{"x": 1}]}], "none": [], "mixed": [{"a": 1}, 2]},
        {"": {"ö\n": {'"': "\\ \x00\x7f\u2028😀"}}, "a.b": {"c d": 1e22}},
    ],
)
def test_tables_are_the_same_after_their_text(tables):
    assert tomllib.loads(tomli_w.dumps(tables)) == tables


def test_the_text_of_a_case_is_laid_out_as_people_write_it():
    case = {"model": {"name": "a"}, "losses": {"x": {"law": "known", "torque": "1 N m"}}}
    assert tomli_w.dumps(project.tables_of([project.Design("one", case)])) == (
        'ballscrew_project = 1\n\n[[designs]]\nname = "one"\n\n[designs.case.model]\nname = "a"\n\n'
        '[designs.case.losses.x]\nlaw = "known"\ntorque = "1 N m"\n'
    )
