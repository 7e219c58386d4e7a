"""Bad input: exit code 2, one line a fault, nothing on standard output, nothing written."""

import dataclasses
import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pint
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case_text import tables_in
from support.commands import with_small_files

FAULTS = {
    "missing key": ('lead = "5 mm"', "", "screw.lead: missing"),
    "unknown key": ('lead = "5 mm"', 'leed = "5 mm"', 'screw.leed: unknown key · did you mean "lead"?'),
    "missing unit": ('lead = "5 mm"', "lead = 5", 'screw.lead: needs a unit (5) · write "5 mm"'),
    "wrong unit": ('lead = "5 mm"', 'lead = "5 N"', "screw.lead: wrong unit (5 N)"),
    "negative length": ('lead = "5 mm"', 'lead = "-5 mm"', "screw.lead: must be positive (-5 mm)"),
    "zero length": ('lead = "5 mm"', 'lead = "0 mm"', "screw.lead: must be positive (0 mm)"),
    "zero roughness": ('"0.08 um"', '"0 um"', "screw.ball_roughness: must be positive (0 um)"),
    "conformity": ("nut_conformity = 0.515", "nut_conformity = 0.5", "screw.nut_conformity: must be above 0.5 (0.5)"),
    "angle of 90": ('"45 deg"', '"90 deg"', "screw.contact_angle: must be below 90 deg (90 deg)"),
    "angle of 0": ('"45 deg"', '"0 deg"', "screw.contact_angle: must be positive (0 deg)"),
    "ball against pitch circle": ('"3.175 mm"', '"31.75 mm"', "too big for the pitch circle (31.75 mm)"),
    "ball against lead": ('"3.175 mm"', '"6 mm"', "screw.ball_diameter: too big for the lead"),
    "nan": ('"4 kN"', '"nan kN"', "operation.axial_load: must be a finite number (nan kN)"),
    "inf": ('"600 rpm"', '"inf rpm"', "operation.screw_speed: must be a finite number (inf rpm)"),
    "negative viscosity": ('"0.1 Pa s"', '"-0.1 Pa s"', "lubricant.viscosity: must be positive (-0.1 Pa s)"),
    "broken ball": ("loaded_balls = 56", "loaded_balls = 56.5", "screw.loaded_balls: must be a whole number (56.5)"),
    "no ball": ("loaded_balls = 56", "loaded_balls = 0", "screw.loaded_balls: must be at least 1 (0)"),
    "missing section": ("[lubricant]", "[model.film]", "lubricant: missing section"),
    "misspelt section": ("[lubricant]", "[lubricnt]", 'lubricnt: unknown section · did you mean "lubricant"?'),
    "unknown model": ('name = "olaru2005"', 'name = "olaru205"', 'did you mean "olaru2005"?'),
    "unknown law": ('name = "olaru2005"', 'hertz = "exat"', 'model.hertz: unknown law (exat) · did you mean "exact"?'),
    "unknown coefficient": ('name = "olaru2005"', "friction.decai = 1.4", 'did you mean "decay"?'),
    "coefficient without its law": (
        'name = "olaru2005"', "boundary_friction_coefficient = 0.2",
        'model.boundary_friction_coefficient: unknown key · did you mean "friction.boundary_friction_coefficient"?',
    ),
    "law by name and with coefficients": (
        'name = "olaru2005"', 'friction = "balan"\nfriction.decay = 1.4',
        '· a law with coefficients: write friction.law = "balan"',
    ),
    "force that does not count": (
        'name = "olaru2005"', 'ball_force = "proportional"\nball_to_ball_force = "1 N"',
        'model.ball_to_ball_force: does not count with ball_force = "proportional" (1 N)',
    ),
    "force that does not count in the law that the model has": (
        'name = "olaru2005"', 'name = "reference"\nball_to_ball_force = "1 N"',
        'model.ball_to_ball_force: does not count with ball_force = "proportional" (1 N)',
    ),
    "turns for balls": ("loaded_balls = 56", 'loaded_balls = "4 turns"', "about turns · pi · pitch_circle_diameter"),
    "kinematic viscosity": ('"0.1 Pa s"', '"100 cSt"', "lubricant.viscosity: wrong unit (100 cSt)"),
}  # fmt: skip


GOOD = {
    "pitch_circle_diameter": 0.04, "lead": 0.005, "ball_diameter": 3.175e-3, "loaded_balls": 56,
    "contact_angle": math.pi / 4, "screw_conformity": 0.515, "nut_conformity": 0.515,
}  # fmt: skip


def single_line_fault(process, expected):
    assert process.returncode == 2
    assert process.stdout == ""
    assert "Traceback" not in process.stderr
    lines = process.stderr.strip().splitlines()
    assert len(lines) <= 10
    assert any(expected in line for line in lines), process.stderr


@pytest.mark.parametrize("name", FAULTS)
def test_faults_of_a_case_file(name, tmp_path, example):
    old, new, expected = FAULTS[name]
    text = example.read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "case.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        case_file.load(path)
    assert any(expected in line for line in caught.value.lines()), caught.value.lines()


@pytest.mark.parametrize("name", ["missing unit", "ball against lead", "missing section", "unknown model"])
def test_faults_on_the_command_line(name, tmp_path, example, ballscrew):
    old, new, expected = FAULTS[name]
    path = tmp_path / "case.toml"
    path.write_text(example.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    single_line_fault(ballscrew("run", path), expected)
    single_line_fault(ballscrew("sweep", path, "--to", tmp_path / "map.csv"), expected)
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        ("lead = 10,0 mm", 'put the value in quotes: lead = "10,0 mm"'),
        ("screw.lead=10 mm  # of one turn", 'put the value in quotes: screw.lead = "10 mm"'),
        ("grade = ISO VG 100\r", 'put the value in quotes: grade = "ISO VG 100"'),
        ("set_at_rest = True", "write set_at_rest = true"),
        ("a = = b", 'start from "ballscrew catalogue show'),
        ('lead = "10" mm', 'start from "ballscrew catalogue show'),
        ("lead = [10 mm]", 'start from "ballscrew catalogue show'),
    ],
)
def test_a_value_without_quotes_is_shown_with_them(line, remedy):
    with pytest.raises(InputError, match="is not TOML") as caught:
        tables_in(f"# a case\n{line}\n".encode(), "case.toml")
    assert f" · {remedy}" in str(caught.value)


def test_files_that_are_no_case(tmp_path, ballscrew):
    empty = tmp_path / "empty.toml"
    empty.write_text("", encoding="utf-8")
    other = tmp_path / "other.toml"
    other.write_text("a = = b", encoding="utf-8")
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe\x00\x01")
    for path, problem in [
        (empty, "is empty"),
        (other, "is not TOML"),
        (binary, "is not text in UTF-8"),
        (tmp_path / "none.toml", "does not exist"),
        (tmp_path, "cannot be read"),
    ]:
        process = ballscrew("run", path)
        single_line_fault(process, problem)
        assert len(process.stderr.strip().splitlines()) == 1


def test_unwritable_output(tmp_path, example, ballscrew):
    single_line_fault(ballscrew("sweep", example, "--to", tmp_path), "--to: unknown kind of file")
    single_line_fault(ballscrew("sweep", example, "--to", tmp_path / "map.doc"), "end it in .csv, .xlsx, .nc or .zarr")
    file = tmp_path / "file"
    file.write_text("kept", encoding="utf-8")
    single_line_fault(ballscrew("reproduce", "olaru2005", "--out", file / "out"), "cannot")
    single_line_fault(ballscrew("sweep", example, "--to", file / "map.csv"), "--to: cannot be written")
    assert file.read_text(encoding="utf-8") == "kept"
    assert sorted(tmp_path.iterdir()) == [file]


def test_ten_lines_at_most(example, ballscrew):
    settings = [word for i in range(15) for word in ("--set", f"screw.key{i}=1")]
    process = ballscrew("run", example, *settings)
    lines = process.stderr.strip().splitlines()
    assert len(lines) == 10
    assert lines[-1] == "and 6 more"


def test_python_says_the_same():
    """The same faults as ValueError, in the same words but for the unit of the value."""
    for change, expected in [
        ({"lead": -0.005}, "screw.lead: must be positive (-0.005 m)"),
        ({"lead": 0.0}, "screw.lead: must be positive (0 m)"),
        ({"lead": math.nan}, "screw.lead: must be a finite number (nan m)"),
        ({"lead": "5 mm"}, "screw.lead: must be a number in m ('5 mm')"),
        ({"screw_conformity": 0.5}, "screw.screw_conformity: must be above 0.5 (0.5)"),
        ({"contact_angle": 45.0}, "screw.contact_angle: must be below 1.5708 rad (45 rad)"),
        ({"ball_diameter": 0.03175}, "screw.ball_diameter: too big for the pitch circle (0.03175 m)"),
        ({"ball_diameter": 0.006}, "screw.ball_diameter: too big for the lead"),
        ({"loaded_balls": 5.5}, "screw.loaded_balls: must be a whole number (5.5)"),
    ]:
        with pytest.raises(ValueError, match="·") as caught:
            bs.BallScrew(**{**GOOD, **change})
        assert str(caught.value).startswith(expected)
    screw, oil = bs.BallScrew(**GOOD), bs.Lubricant(viscosity=0.1)
    with pytest.raises(ValueError, match=r"operation\.axial_load: must be a finite number \(inf N\)"):
        bs.FrictionModel.corrected()(screw, oil, axial_load=math.inf, screw_speed=1.0)
    with pytest.raises(ValueError, match=r"model\.ball_to_ball_force: must not be negative"):
        dataclasses.replace(bs.FrictionModel.corrected(), ball_to_ball_force=-1.0)
    with pytest.raises(ValueError, match=r"lubricant\.viscosity: must be positive"):
        bs.Lubricant(viscosity=0.0)
    with pytest.raises(ValueError, match=r"lubricant\.grade: unknown grade \(ISO VG 101\)"):
        bs.Lubricant.from_grade("ISO VG 101")


def test_forbidden_files(example, monkeypatch):
    """Root may read everything, so the refusal is made here."""

    def refuse(self, *_):
        raise PermissionError(13, "Permission denied", str(self))

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(InputError, match=r"olaru2005\.toml: cannot be read \(Permission denied\)"):
        case_file.load(example)


def test_numbers_too_long_for_a_computer(tmp_path, example, ballscrew):
    """Overlong numbers, brackets and powers are faults like others, and answered at once."""
    for old, new in [
        ("loaded_balls = 56", f"loaded_balls = 1{'0' * 400}"),
        ("loaded_balls = 56", f"loaded_balls = {'1' * 5000}"),
        ('"5 mm"', '"5 m**9**9**9"'),
        ('"5 mm"', f'"5 {"m" * 100_000}"'),
        ('"5 mm"', f'"1{"0" * 400} mm"'),
        ('"5 mm"', '"5 mm # five"'),
        ("[model]", f"[model.{'.'.join('a' * 2000)}]"),
    ]:
        path = tmp_path / "case.toml"
        path.write_text(example.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
        with pytest.raises(InputError) as caught:
            case_file.load(path)
        assert len(caught.value.lines()) <= 10
    single_line_fault(ballscrew("run", example, "--set", f"screw.lead={'[' * 3000}"), "screw.lead")
    single_line_fault(ballscrew("sweep", example, "--vary", f"axial_load=1:2:{'9' * 5000} N"), "sweep.axial_load")
    with pytest.raises(InputError, match="must be a finite number"):
        bs.BallScrew(**{**GOOD, "lead": 10**400})


#: What ascii can show, the others can.
ENCODINGS = ["ascii", *(pytest.param(name, marks=pytest.mark.long) for name in ("cp1252", "latin-1"))]


@pytest.mark.slow
@pytest.mark.parametrize("encoding", ENCODINGS)
def test_terminals_of_other_encodings(encoding, example, ballscrew):
    """What a terminal cannot show is written otherwise; the answer is complete."""
    for arguments in (["run", example], ["run", example, "--json"], ["compare", example], ["schema"], ["--help"]):
        process = ballscrew(*arguments, environment={"PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"})
        assert process.returncode == 0
        assert process.stderr == ""
    assert "friction torque of one ball" in ballscrew("run", example, environment={"PYTHONIOENCODING": encoding}).stdout
    bad = ballscrew("run", example, "--set", "screw.lead=5", environment={"PYTHONIOENCODING": encoding})
    assert bad.returncode == 2
    assert "screw.lead: needs a unit" in bad.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full, a device that is always full")
def test_a_full_output_is_one_line(example, commands, tmp_path):
    for command in (["run", example], ["run", example, "--json"], ["compare", example], ["sweep", example]):
        said = tmp_path / "said"
        with Path("/dev/full").open("w") as full, said.open("w", encoding="utf-8") as complaints:
            streams = [full.fileno(), full.fileno(), complaints.fileno()]
            assert commands.start(command, folder=tmp_path, streams=streams).wait(300) == 2
        errors = said.read_text(encoding="utf-8")
        assert errors.strip().splitlines()[-1].startswith("stdout: cannot be written")
        assert "Traceback" not in errors


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "name"),
    [
        *(
            ("sweep --vary axial_load=1:4000:3000N --vary screw_speed=1,2rpm --output screw_torque", f"map.{ending}")
            for ending in ("nc", "xlsx", "csv")
        ),
        ("compare", "spread.png"),
    ],
)
def test_a_really_full_disk(command, name, tmp_path, example):
    """A limit on the size of files stands for the disk: one line, no crash in a library, nothing left."""
    target = tmp_path / name
    target.write_text("old", encoding="utf-8")
    command, *options = command.split()
    program = [sys.executable, "-m", "ballscrew.faces.cli", command, example, "--to", target, *options]
    process = subprocess.run(with_small_files(program), capture_output=True, text=True, check=False)
    assert process.returncode == 2
    (line,) = process.stderr.strip().splitlines()
    assert line.startswith("--to: cannot be written")
    assert target.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_python_refuses_what_is_no_number():
    oil = {"viscosity": 0.1}
    for change in ({"viscosity": [0.05, 0.1]}, {"viscosity": np.array(["0.1"])}, {"viscosity": np.array(0.1j)}):
        with pytest.raises(ValueError, match=r"lubricant\.viscosity: must be a number"):
            bs.Lubricant(**{**oil, **change})
    with pytest.raises(ValueError, match=r"lubricant\.viscosity: must be positive"):
        bs.Lubricant(viscosity=np.array(-0.1))
    with pytest.raises(ValueError, match=r"screw\.ball_material: must be a Material"):
        bs.BallScrew(**{**GOOD, "ball_material": None})
    screw = bs.BallScrew(**GOOD)
    for load in ("4 kN", 1j, np.array(["4"]), None):
        with pytest.raises(ValueError, match=r"operation\.axial_load: must be a number"):
            bs.FrictionModel.corrected()(screw, bs.Lubricant(**oil), axial_load=load, screw_speed=1.0)


def test_a_defect_is_not_called_a_full_output(monkeypatch):
    """Only faults of the output itself are put down to the output; anything else must be seen."""
    from ballscrew.faces.cli import main

    def defect():
        raise FileNotFoundError(2, "No such file or directory", "a part of the package")

    monkeypatch.setattr(main, "command_line", lambda: defect)
    with pytest.raises(FileNotFoundError, match="a part of the package"):
        main.main()


@pytest.mark.parametrize(
    "text",
    [
        " " * 330 + "+" + " " * 660,
        "+ " * 500,
        "5 mm" + " " * 990 + "x",
        "uniform(" + "," * 990 + ")",
        "1" * 990 + "x y",
    ],
)
def test_long_texts_cost_nothing(text, example):
    """The patterns of values are not given what they would need seconds for."""
    case_file.load(example)  # what is loaded once is not the question
    tables = case_file.read(example)
    for field in tables["screw"]:
        tables["screw"][field] = text
    begin = time.process_time()
    sum(range(5_000_000))
    moment = time.process_time() - begin
    begin = time.process_time()
    with pytest.raises(InputError):
        case_file.build(tables)
    assert time.process_time() - begin < 5 * moment


def test_units_that_are_asked_for_once_are_not_kept():
    from ballscrew.basis import units
    from ballscrew.basis.quantities import fields_of
    from ballscrew.physics.components.screw import BallScrew

    lead, first = fields_of(BallScrew)["lead"], units.registry()
    for i in range(2, 1202):
        with pytest.raises(pint.DimensionalityError):
            units.to_si(1.0, f"m^{i}", lead)
    assert units.registry() is not first
    assert units.parse("", "5 mm", lead) == 0.005
