"""Commands that cannot be answered: each is refused in words that name the option or the field, and writes nothing."""

import shlex

import pytest
from typer.testing import CliRunner

from ballscrew.basis.errors import InputError
from ballscrew.faces.cli.main import app
from support.commands import ROOT

EXAMPLES = ROOT / "examples"
#: By the beginning of a command, whose files are examples: how it goes on, and what is said of it.
REFUSED = {
    "run feed_drive.toml": [
        ("--samples 8", "--samples: needs --band (8) · add --band"),
        ("--level 0.9", "--level: needs --band (0.9) · add --band"),
        ("--only-given", "--only-given: needs --band"),
        ("--to band.png", "--to: needs --band (band.png) · add --band"),
        ("--band --samples 1", "--samples: must be a whole number from 2 to 2^30 (1)"),
        ("--band --level 95", "--level: must lie between 0 and 1 (95.0)"),
        ("--band --level nan", "--level: must lie between 0 and 1 (nan)"),
        ("--band --to band.doc", "--to: unknown kind of file (band.doc)"),
        ("--band --set 'screw.screw_conformity=0.54 ± x'", "screw.screw_conformity: is not a number"),
        (
            "--self-heating --band --to a.png --set 'surroundings.shaft_length=1 m'",
            "--to: draws a curve over the speed",
        ),
    ],
    "sweep feed_drive.toml --vary 'screw_speed=100, 200 rpm'": [
        ("--output deflection --band", "--output: has no band (deflection)"),
        ("--band --to map.zarr", "--band: fills no store"),
        ("--band --self-heating", "--band: is given beside --self-heating"),
        ("--samples 1", "--samples: must be a whole number"),
        ("--json --rows screws.csv", "--json: is of one screw"),
    ],
    "duty vertical_axis.toml": [
        ("--samples 1", "--samples: must be a whole number from 2 to 2^30 (1)"),
        ("--set motion.kind=4", "motion.kind: must be text (4) · put it in quotes"),
        ("--trace none.csv", "none.csv: does not exist"),
    ],
    "warm-up warm_up.toml": [
        ("--samples 64", "--samples: needs --band (64) · add --band"),
        ("--band --samples 1", "--samples: must be a whole number from 2 to 2^30 (1) · such as 2**14"),
        ("--band --level 2", "--level: must lie between 0 and 1 (2.0) · 0.95 is usual"),
        (
            "--set 'surroundings.shaft_length=1 m ± 1 mm'",
            'surroundings.shaft_length: takes no distribution (1 m ± 1 mm) · write one number: "1 m"',
        ),
        ("--hours 0", "--hours: must be above 0 and at most 8766 (0) · write --hours 4"),
        ("--hours nan", "--hours: must be above 0 and at most 8766 (nan) · write --hours 4"),
        ("--cool-down -1", "--cool-down: must be 0 to 8766 (-1) · write --cool-down 1"),
        ("--feed-share 0.4", "--feed-share: needs --drift-cycle (0.4) · add --drift-cycle"),
        ("--drift-cycle --feed-share 2", "--feed-share: must be above 0 and at most 1 (2) · write --feed-share 0.5"),
        (
            "--set 'surroundings.ambient=-40 degC'",
            "surroundings.ambient: is not among the temperatures of the oil (-40 °C) · the oil is known",
        ),
        ("--set 'surroundings.ambiant=20 degC'", 'surroundings.ambiant: unknown key · did you mean "ambient"?'),
        (
            "--set 'surroundings.coolant=20 degC'",
            'surroundings.coolant: has no bore to flow through · give bore = "12 mm"',
        ),
    ],
    "warm-up": [
        (
            "feed_drive.toml --drift-cycle",
            "--drift-cycle: has no motion whose stroke it could take · add [axis] and [motion]",
        ),
    ],
    "sweep feed_drive.toml --self-heating --set 'surroundings.shaft_length=1 m'": [
        ("--vary 'temperature=20, 40 degC'", "sweep.temperature: is not free · leave it out: it follows from the heat"),
        ("--to a.zarr", "--self-heating: fills no store (a.zarr) · write .nc, .csv or .xlsx"),
    ],
    "axis feed_axis.toml": [
        ("--at '1.2 m'", "must lie on the shaft"),
        ("--at '1 kg'", "--at: "),
    ],
    "axis": [
        ("olaru2005.toml", "installation: missing section"),
    ],
    "compensation": [
        ("warm_up.toml --to siemens -o a.ini", "--to: unknown control (siemens)"),
        ("olaru2005.toml --to isg -o a.lis --zero '2 N'", "--zero: wrong unit (2 N)"),
    ],
    "reversal service.toml": [
        ("--travel '2 N'", "--travel: wrong unit (2 N)"),
        ("--travel '-1 mm'", "--travel"),
        ("--gap -1", "Invalid value for '--gap'"),
        ("--model olaru2005", "model.slip: knows no slip across the path"),
    ],
    "ripple service.toml": [
        ("--fault crack", "--fault: unknown fault (crack)"),
        ("--set 'operation.screw_speed=0 rpm'", "operation.screw_speed: must not be zero"),
        ("--set nut.spacer_balls=true", "nut.spacer_balls: part the loaded balls"),
    ],
    "service": [
        ("nut_new.csv nut_worn.csv", "--case: missing"),
        ("nut_worn.csv --case rig.toml", "nut: has no preload (a single nut)"),
        ("nut_worn.csv --case catalogue_screw.toml", "leave out [bodies] and [deviations]"),
    ],
    "service --case service.toml --model olaru2005": [
        ("", "WORN: missing"),
        ("nut_new.csv nut_worn.csv nut_new.csv", "WORN: more than two logs (3)"),
        ("nut_new.csv gone.csv", "gone.csv"),
        ("--torque '1 N' --speed '1 rpm'", "--torque: "),
        ("--torque '1e6 N m' --speed '1 rpm'", "--torque: no preload gives it"),
        ("nut_worn.csv --tolerance 2", "--tolerance: must lie between 0 and 1 (2.0)"),
        ("nut_worn.csv --free decay", "--free: is not fitted to each log (decay)"),
    ],
    "condition": [
        ("nut_over_years.csv", "--case: missing"),
        ("nut_over_years.csv --case rig.toml", "nut: has no preload (a single nut)"),
    ],
    "condition --case service.toml --model olaru2005": [
        ("", "TABLE: missing"),
        ("gone.csv", "gone.csv: does not exist"),
        ("nut_worn.csv", "has speeds in both directions or at rest, as a log has"),
        ("nut_new.csv nut_worn.csv", "condition.tests: too few: the baseline alone takes 5 (2)"),
        ("nut_new.csv nut_worn.csv nut_worn.csv nut_new.csv --baseline 3", "condition: two logs are the same file"),
    ],
    "condition --case service.toml --model olaru2005 nut_over_years.csv": [
        ("--baseline 1", "--baseline: is too short (1)"),
        ("--tolerance 2", "--tolerance: must lie between 0 and 1 (2.0)"),
        ("--false-alarms 1", "--false-alarms: must lie between"),
        ("--speed '9 rpm'", "--speed: is given beside a column of speeds"),
        ("--at '9 N'", "--at: "),
        ("--at '-300 degC'", "--at: "),
        ("--kind drive", "--kind: is for logs (drive)"),
        ("--column drag=M", "--column drag: unknown column"),
    ],
    "fit rig_log.csv --case rig.toml": [
        ("-o fitted.csv", "--to: is no case file (fitted.csv)"),
        ("-o fitted", "--to: is no case file (fitted)"),
        ("--free constant_torqe", '--free: unknown name (constant_torqe) · did you mean "constant_torque"?'),
        ("--free axial_load", "--free: is given by the log (axial_load)"),
        ("--bounds boundary_friction_coefficient=0.1", "--bounds: is not name=low:high"),
        ("--limits 'screw_speed=1 kg:2 rpm'", "--limits screw_speed: wrong unit (1 kg)"),
        ("--kind torque", "--kind: unknown kind of torque (torque)"),
        ("--inertia '2 kg'", "--inertia"),
        ("--column torque", "--column: is not name=heading (torque)"),
        ("--holdout nan", "--holdout: must be a share from 0 to 0.5 (nan)"),
        ("--set 'model.friction.decay=1 ± x'", "model.friction.decay"),
        (
            "--temperature-error '2 degC'",
            'is a difference of temperatures, in K (2 degC) · write --temperature-error "2 K"',
        ),
        ("--temperature-error 2", "--temperature-error: needs a unit"),
        ("--temperature-error '-1 K'", "--temperature-error: must not be negative"),
        ("--temperature-error '200 K'", "--temperature-error: must be from 0 to 100 K"),
        ("--self-heating", "--self-heating: is given beside a log with temperatures · leave it out"),
    ],
    "fit": [
        ("missing.csv --case rig.toml -o fitted.toml", "missing.csv: does not exist"),
        ("rig_log.csv --case service.toml --rows own_screws.csv", "LOG: does not go with --rows ("),
    ],
    "fit axis_log.csv --case axis.toml": [
        ("--to out.toml", "--to: does not go with a moving log"),
        ("--inertia '1e-4 kg m^2'", "--inertia: does not go with a moving log"),
        ("--gain '5 V'", "--gain: wrong unit"),
        ("--carried-mass '-1 kg'", "--carried-mass: must not be negative"),
        ("--free preloud", "--free"),
        ("--test none.csv", "none.csv"),
    ],
    "run": [
        ("service.toml --row A", "--row: needs a table of screws (A) · add --rows FILE"),
        ("projects/two_oils.toml", "is a project of several designs (thick oil, thin oil)"),
    ],
    "check": [
        ("--row A", "--row: needs a table of screws (A)"),
        ("'X axis' --rows own_screws.csv --row 'Y axis'", "--row: is given beside another name (X axis)"),
        ("40x10x6-6-double", 'unknown row (40x10x6-6-double) · did you mean "rexroth-40x10x6-6-double"?'),
        ("none.toml", "none.toml: does not exist"),
        ("some/where", "does not exist"),
        ("screws.csv", "is a table, not a case · write --rows "),
    ],
    "run service.toml --rows own_screws.csv": [
        ("--row Z9", "own_screws.csv: unknown row (Z9)"),
        ("--band", "--band: is of one screw (4 rows) · choose one: --row"),
        ("--to a.png", "--to: unknown kind of file (a.png)"),
        ("--set nut.preloda=1", "nut.preloda: unknown key"),
    ],
    "sweep service.toml --rows own_screws.csv": [
        ("--to a.zarr", "--to: holds one screw (a.zarr) · end it in"),
        ("--verify", "--verify: needs a store"),
        ("--scheduler tcp://a:1", "--scheduler: needs a store"),
    ],
    "sweep olaru2005.toml": [
        ("--to map.nc --verify", "--verify: needs a store · add --to map.zarr"),
        ("--scheduler tcp://127.0.0.1:8786", "--scheduler: needs a store (tcp://127.0.0.1:8786) · add --to map.zarr"),
        (
            "--to map.nc --scheduler tcp://127.0.0.1:8786",
            "--scheduler: needs a store (tcp://127.0.0.1:8786) · add --to map.zarr",
        ),
        ("--set 'screw.nut_roughness=3e199 um'", "case: has numbers too large or too small to compute with"),
        ("--vary 'axial_laod=1:2:3 N'", 'did you mean "axial_load"?'),
        ("--vary 'axial_load=1:2:0 N'", "bad number of values"),
        ("--vary 'axial_load=1:2:2.5 N'", "is not start:stop:count"),
        ("--vary 'axial_load=1,2 N' --vary 'axial_load=3,4 N'", "--vary: is given twice (axial_load)"),
        ("--vary 'axial_load=1,2 N' --vary 'operation.axial_load=3,4 N'", "sweep.operation.axial_load: is given twice"),
        ("--vary 'screw.axial_load=1,2 N'", "unknown field"),
        ("--vary loaded_balls=50:60:4", "must be whole numbers"),
        ("--output eficiency", 'did you mean "efficiency"?'),
        ("--to map.doc", "end it in .csv, .xlsx, .nc or .zarr"),
        (
            "--vary 'axial_load=1,2 N' --vary 'screw_speed=0:1000:20000 rpm' --output efficiency --to wide.xlsx",
            "too large for a worksheet",
        ),
        ("--vary 'temperature=20, 60 degC'", "give the oil by its data sheet or its grade"),
    ],
    "fit --case service.toml": [
        ("", "fit: needs a log · give a file, or --rows FILE with a column log"),
        ("--rows own_screws.csv --to a.toml", "end it in .csv or .xlsx, or give a fo"),
        ("--rows screws.csv", 'screws.csv: has no column "log" with a file'),
    ],
    "check rexroth-40x10x6-6-double": [
        ("--axial-load '5 mm'", "--axial-load: wrong unit (5 mm)"),
        ("--preload 7", '--preload: needs a unit (7) · write "7 %" of the dynamic'),
        ("--preload 0.07", '--preload: needs a unit (0.07) · write "7 %" of the'),
        ("--preload 700", '--preload: needs a unit (700) · write "700 N"'),
        ("--set nut.preload=7", 'nut.preload: needs a unit (7) · write "7 %"'),
        ("--nut duble", '--nut: unknown kind of nut (duble) · did you mean "double"?'),
        ("--length '1 m'", '--ends: missing · add --ends "'),
        ("--ends fixed-free", '--length: missing · add --length "1 m"'),
        (
            "--nut single --preload '5 %'",
            '--preload: a nut of type "single" has none (5 %) · leave it out, or take --nut',
        ),
        ("--ends fixed --length '1 m'", "--ends: unknown kind of ends"),
        ("--grade 'VG 99'", "--grade: "),
        ("--model x", "--model: unknown model (x)"),
        ("--set model.name=x", "model.name: unknown model (x)"),
        ("--set nut=double", "--set: is not section.field=value"),
        ("--set 'screw.lead=1 mm'", "too big for the lead"),
    ],
    "run olaru2005.toml": [
        ("--model corected", 'did you mean "corrected"?'),
        ("--model ''", "model.name: unknown model"),
        ("--set 'axial_load=4 kN'", "--set: is not section.field=value"),
        ("--set operation.axial_load=4", 'write "4 N"'),
        ("--set 'operation.axial_laod=4 N'", 'did you mean "axial_load"?'),
        ("--set screw.lead.x=5", "--set screw.lead.x: is not a table (lead)"),
        ("--set 'screw.nut_roughness=3e199 um'", "case: has numbers too large or too small to compute with"),
        ("--band --set 'screw.nut_roughness=3e199 um'", "case: has numbers too large or too small to compute with"),
    ],
    "compare": [
        (
            "olaru2005.toml --set 'screw.nut_roughness=3e199 um'",
            "case: has numbers too large or too small to compute with",
        ),
        ("projects/two_oils.toml projects/two_oils.toml", "two designs of one name (thick oil)"),
        ("'projects/two_oils.toml#thin oil' --own", "--own: is for several designs"),
        ("projects/two_oils.toml --self-heating", "--self-heating: is for one case"),
        ("'projects/two_oils.toml#no oil'", "has no such design"),
    ],
    "sweep": [
        ("feed_drive.toml --vary 'temperature=20, 60 degC' --vary 'viscosity=1,2 Pa s'", "goes with the temperature"),
    ],
    "reproduce": [
        ("olaru2004 --out x", 'did you mean "olaru2005"?'),
    ],
    "oils show": [("'SHC 231'", 'library: unknown oil (SHC 231) · did you mean "SHC 230"?')],
    "catalogue list": [
        ("nsk", "catalogue: no row has these words (nsk) · leave them out"),
        ("40x1", "sizes are diameter x lead in mm: 40x10, or 40x for all of 40 mm"),
        ("--rows none.csv", "none.csv: does not exist"),
    ],
    "catalogue show": [
        ("40-20k4", 'unknown row (40-20k4) · did you mean "hiwin-40-20k4"?'),
        ("hiwin-40-20k5", "did you mean"),
        ("'?'", 'catalogue: unknown row (?) · see "ballscrew catalogue list"'),
        ("BNFN3210-5", '"rexroth-32x10x3.969-5-single", "thk-dik3210-6"; "ballscrew catalogue own"'),
        ("'R1532 490 13'", 'see "ballscrew catalogue list"'),
        ("hiwin-40-20k4 --case --json", "--case: does not go with --json"),
    ],
    "list": [
        ("grade", 'list: unknown kind of names (grade) · did you mean "grades"?'),
    ],
    "sensitivity olaru2005.toml": [
        ("--output torque", "--output: unknown output (torque) · did you mean "),
        ("--only-given", "--only-given: the case gives no input a distribution · write one, such as "),
        (
            "--method local --set 'operation.axial_load=0 N' --model reference",
            "sensitivity.distributions.viscosity: has no slope here",
        ),
        (
            "--model corrected --output valid",
            "--output: is true or false, and has no variance (valid) · choose a number",
        ),
        ("--method best", "--method: unknown method (best) · one of sobol, morris, local"),
        ("--samples 100", "--samples: must be a power of two (100) · take 64 or 128"),
        ("--seed -1", "--seed: must be a whole number, 0 or more (-1)"),
    ],
    "sensitivity": [
        (
            "catalogue_screw.toml --method local",
            "--method: has no derivatives where balls differ (local) · add --method sobol or --method morris",
        ),
    ],
    "validate": [
        ("rexroth-double", 'validate: unknown set (rexroth-double) · did you mean "rexroth-double-nut"?'),
        ("--model refrence", '--model: unknown model (refrence) · did you mean "reference"?'),
        ("--calibration rexroth", 'model.calibration: unknown calibration (rexroth) · did you mean "rexroth-2006'),
        ("--temperature 25", '--temperature: needs a unit (25) · write "25 degC"'),
        ("--temperature '900 degC'", "--temperature: must be at most 150 degC (900 degC)"),
        ("--speed '-5 rpm'", "--speed: must not be negative (-5 rpm)"),
        ("--grade 'VG 101010'", "--grade: unknown grade (VG 101010)"),
        ("--summary --to ratios.png", "--summary: is no picture and no paper · leave --to out"),
        ("--summary --card a.toml", "--summary: is a table of the sets · leave --card out"),
        ("--to ratios.bmp", "--to: unknown kind of file (ratios.bmp)"),
        ("hiwin-ratings --speed '5 rpm'", "validate: oil and speed do not move these sets (hiwin-ratings)"),
        ("rexroth-single-nut --model olaru2005", "rexroth-single-nut: model olaru2005 knows no balls with four"),
        ("thk-jis --report worth.txt", "--report: unknown kind of file"),
        ("--rows screws.csv", "--rows: needs exactly one set (none) · name the set whose columns"),
    ],
    "report feed_drive.toml": [
        ("-o x.doc", "--to: unknown kind of file"),
        ("-o x", "--to: unknown kind"),
        (
            "-o x.pdf --beside rig.toml --beside rig.toml --beside rig.toml --beside rig.toml",
            "--beside: too many designs (4) · 3 at most",
        ),
        ("-o x.pdf --samples 1", "--samples"),
    ],
    "serve": [
        ("--port 70000", "--port: is no port (70000)"),
        ("--host no.such.host.invalid", "--host: is not known"),
    ],
}


@pytest.mark.parametrize(
    ("command", "said"),
    [
        pytest.param(f"{command} {rest}", said, id=f"{command} {rest}")
        for command, every in REFUSED.items()
        for rest, said in every
    ],
)
def test_what_cannot_be_answered_is_refused_in_words(command, said, tmp_path, monkeypatch):
    """Bad input as ``main`` gets it, or bad words as the parser of the command line says it."""
    monkeypatch.chdir(tmp_path)
    words = [word if word.startswith("-") else example_of(word) for word in shlex.split(command)]
    done = CliRunner().invoke(app, words)
    lines = done.exception.lines() if isinstance(done.exception, InputError) else [done.stderr]
    assert done.exception is not None
    assert done.stdout == ""
    assert any(said in line for line in lines), lines
    assert list(tmp_path.iterdir()) == []


def example_of(word):
    """The path of an example, perhaps with a design of it."""
    return str(EXAMPLES / word) if (EXAMPLES / word.partition("#")[0]).is_file() else word
