"""Every Python example of the README and the documentation runs as it stands there.

The blocks of a page share their names, in order, as for someone who types them one after the other. A block that
cannot run here has ``<!-- not run: why -->`` before it.
"""

import shutil
import subprocess
import sys

import matplotlib as mpl
import pytest

from support.rules import for_each

from .pages import ROOT, blocks, markers, name, pages

pytestmark = pytest.mark.slow


def examples(page):
    return [block for block in blocks(page) if block.info == "python" and not block.written]


PAGES = [page for page in pages() if examples(page)]


def test_there_are_examples():
    assert {"README.md", "docs/start.md"} <= {name(page) for page in PAGES}


def test_every_file_of_the_examples_stands_in_their_table():
    """By its name, or by that of its folder."""
    _, _, table = (ROOT / "docs" / "start.md").read_text(encoding="utf-8").partition("## Examples")
    files = [path.relative_to(ROOT / "examples") for path in (ROOT / "examples").rglob("*.*") if path.is_file()]
    files = [path for path in files if "__pycache__" not in path.parts]
    assert len(files) > 20
    for path in files:
        assert f"`{path.as_posix()}`" in table or f"`{path.parent.as_posix()}/`" in table, path


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_the_examples_of_a_page_run(page, tmp_path, monkeypatch, capsys):
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "example"}
    with mpl.rc_context():
        for block in examples(page):
            if not block.not_run:
                # as many empty lines before it as there are on the page, so that a fault names the page's line
                source = "\n" * block.line + block.text
                exec(compile(source, str(page), "exec"), names)
    capsys.readouterr()


def test_the_recipe_for_a_simulator_has_the_friction_of_the_nut(capsys):
    """Without load it is that of the preload, by the model itself; the page states it."""
    (page,) = (page for page in PAGES if name(page) == "docs/howto/sweep.md")
    block = examples(page)[0]
    names = {"__name__": "example"}
    exec(compile(block.text, str(page), "exec"), names)
    stated = block.text.split("  # ")[1].splitlines()[0]
    torque, unit = capsys.readouterr().out.splitlines()[0].split(maxsplit=1)
    assert f"{float(torque):.3g} {unit}" == stated == "0.0621 N m"
    table = names["table"]
    at_rest = table.sel(axial_load=0, screw_speed=0)
    assert at_rest["screw_torque"] > 0
    assert at_rest["drive_torque"] == 0
    assert (table["drive_torque"].values == -table["drive_torque"].values[::-1, ::-1]).all()


@for_each(page={name(page): page for page in pages()})
def test_what_does_not_run_says_why(page):
    marked = [block for block in blocks(page) if block.not_run]
    assert len(marked) == markers(page), "a marker stands before a Python block, and before nothing else"
    for block in marked:
        assert block.info == "python"
        assert len(block.not_run.split()) >= 3, f"line {block.line}: this is no reason"


def test_few_examples_do_not_run():
    assert sum(markers(page) for page in pages()) <= 3


@pytest.mark.parametrize("name", ["axis_log", "condition_table", "rig_log", "service_logs"])
def test_logs_of_the_examples_are_what_their_scripts_make(name):
    """Each script compares what it makes with the file, and ends with an error where it differs."""
    script = [sys.executable, str(ROOT / "examples" / f"make_{name}.py")]
    done = subprocess.run(script, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", ["axis_log", "nut_new", "nut_over_years", "nut_worn", "rig_log"])
def test_logs_of_the_examples_say_that_nobody_measured_them(name):
    assert (ROOT / "examples" / f"{name}.csv").read_text(encoding="utf-8").startswith("# SYNTHETIC")
