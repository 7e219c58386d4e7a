"""What a command loads, which takes most of its time: bad input is refused before, and an answer needs few."""

import json
import subprocess
import sys

import pytest

from support.commands import ROOT
from support.fit_logs import PAPER

RUN = """
import json, sys
from ballscrew.faces.cli.main import main
sys.argv = ["ballscrew", *sys.argv[1:]]
try:
    main()
except SystemExit as end:
    loaded = sorted(name for name, module in sys.modules.items() if module is not None)
    print("\\n" + json.dumps([end.code or 0, loaded]))
"""
#: Libraries that a bad case does without, and those that a bad log does without: pandas reads it.
OF_ANSWERS = {"scipy", "xarray", "rich", "matplotlib"}


def run(arguments, folder):
    """A command in a process of its own: its exit code, what it has loaded, and what it said of errors."""
    program = [sys.executable, "-c", RUN, *arguments]
    done = subprocess.run(program, cwd=folder, capture_output=True, check=True, encoding="utf-8")
    code, loaded = json.loads(done.stdout.splitlines()[-1])
    return code, set(loaded), done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "log", "arguments", "words", "without"),
    [
        (PAPER.replace("lead", "leadd"), None, ["run", "case.toml"], "unknown key", {*OF_ANSWERS, "pandas"}),
        (PAPER.replace("5 mm", "5 kg"), None, ["run", "case.toml"], "wrong unit", {*OF_ANSWERS, "pandas"}),
        (PAPER.replace("5 mm", "5 kg"), "", ["fit", "log.csv", "--case", "case.toml"], "unit", {*OF_ANSWERS, "pandas"}),
        (PAPER, "a\n1\n", ["fit", "log.csv", "--case", "case.toml"], "has no heading that is known", OF_ANSWERS),
        (
            PAPER, "F [N],n [rpm],M [N m]\n1,2,x\n",
            ["fit", "log.csv", "--case", "case.toml", "--to", "new.toml", "--picture", "new.png"],
            "is not a number", OF_ANSWERS,
        ),
        (
            PAPER, "F [N],n [rpm],M [N m]\n1,2,3\n", ["fit", "log.csv", "--case", "case.toml"],
            "has 1 rows that can be used", OF_ANSWERS,
        ),
    ],
)  # fmt: skip
def test_a_refusal_loads_no_library_of_answers(case, log, arguments, words, without, tmp_path):
    (tmp_path / "case.toml").write_text(case, encoding="utf-8")
    if log is not None:
        (tmp_path / "log.csv").write_text(log, encoding="utf-8")
    code, loaded, said = run(arguments, tmp_path)
    assert code == 2
    assert words in said
    assert not without & loaded


DRIVE = str(ROOT / "examples" / "feed_drive.toml")
HEAVY = {"xarray", "pandas", "matplotlib", "numba", "jax", "dask", "jinja2", "typst"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "without"),
    [
        # pint loads scipy itself where it is, and none of its parts
        (["run", DRIVE, "--json"], {*HEAVY, "scipy.special"}),
        (["compare", DRIVE, "--json"], {*HEAVY, "scipy.optimize"}),
        # dask is for a scheduler only; xarray would load it where it is installed: seconds after a boot
        (["sweep", DRIVE, "--vary", "screw_speed=10:1500:3 rpm", "--json"], {"dask"}),
        (["--help"], {"numpy", "pydantic", "pint", "rich.console"}),
    ],
    ids=["run", "compare", "sweep", "help"],
)
def test_an_answer_loads_what_it_needs(arguments, without, tmp_path):
    code, loaded, said = run(arguments, tmp_path)
    assert code == 0, said
    assert not without & loaded
