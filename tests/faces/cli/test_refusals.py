"""Bad input is refused before the libraries are loaded that only an answer needs: they take most of the time."""

import json
import subprocess
import sys

import pytest

from support.fit_logs import PAPER

RUN = """
import json, sys
from ballscrew.faces.cli.main import main
sys.argv = ["ballscrew", *sys.argv[1:]]
try:
    main()
except SystemExit as end:
    print(json.dumps([end.code, sorted({name.partition(".")[0] for name in sys.modules})]))
"""
#: Libraries that a bad case does without, and those that a bad log does without: pandas reads it.
OF_ANSWERS = {"scipy", "xarray", "rich", "matplotlib"}


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
    done = subprocess.run(
        [sys.executable, "-c", RUN, *arguments], cwd=tmp_path, capture_output=True, check=True, encoding="utf-8"
    )
    code, loaded = json.loads(done.stdout)
    assert code == 2
    assert words in done.stderr
    assert not without & set(loaded)
