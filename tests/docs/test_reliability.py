"""The table of the hostile run on its page: of all sections, and nothing in it is wrong."""

import re
import shutil
import subprocess
import sys

import pytest

from .pages import DOCS, ROOT

PAGE = DOCS / "reliability.md"
SECTIONS = {
    "screws", "nuts", "exports", "cases", "logs", "traces", "large_files", "stores", "places", "requests", "users",
}  # fmt: skip
ROW = re.compile(
    r"^\| (?P<section>\w+) \| (?P<tried>[\d,]+)(?: of [\d,]+)? \|(?: [\d,]+ \|){3} (?P<wrong>[\d,]+) \|$", re.M
)


def rows(page):
    return {row["section"]: row for row in ROW.finditer(page.read_text(encoding="utf-8"))}


def test_the_table_has_the_sections_of_the_program():
    program = {path.stem for path in (ROOT / "benchmarks" / "hostile").glob("*.py")}
    assert set(rows(PAGE)) == SECTIONS <= program


def test_nothing_is_wrong():
    assert {name: row["wrong"] for name, row in rows(PAGE).items() if row["wrong"] != "0"} == {}


@pytest.mark.long
def test_each_section_runs(tmp_path):
    """At a scale at which it takes seconds; a line is printed for whatever is wrong."""
    page = tmp_path / "reliability.md"
    shutil.copy(PAGE, page)
    command = [sys.executable, "-m", "benchmarks.hostile", "--scale", "0.001", "--seed", "1", "--page", str(page)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, check=False, encoding="utf-8")
    assert done.returncode == any(row["wrong"] != "0" for row in rows(page).values()), done.stderr
    assert "scale 0.001" in page.read_text(encoding="utf-8")
    assert {name for name, row in rows(page).items() if row["tried"] != "0"} == SECTIONS


@pytest.mark.slow
def test_the_program_of_the_run_starts():
    """It leans on tests of the server, which may move; the run itself is long."""
    command = [sys.executable, "-m", "benchmarks.hostile", "--help"]
    found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (found.returncode, "--scale" in found.stdout) == (0, True), found.stderr
