"""The README and the pages that ``make readme`` writes show what the program gives today."""

import re

import pytest

import ballscrew
import validation_tables
from ballscrew.cases.case_files import case_file
from ballscrew.faces.cli.main import app
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.sensitivity import SensitivityOptions
from ballscrew.questions.sensitivity.answer import sensitivity

from .pages import ROOT

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def readme():
    return (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_picture_is_that_of_the_page(readme):
    """``make screenshots`` takes it."""
    assert readme.count("![") == 1
    assert "static_page.png" in (ROOT / "docs" / "make_screenshots.py").read_text(encoding="utf-8")
    assert (ROOT / re.search(r"!\[.*?\]\((.*?)\)", readme)[1]).is_file()


@pytest.mark.parametrize("page", ["../README", "start"])
def test_the_python_examples_print_what_stands_below_them(writer, page):
    """If this fails, run ``make readme``."""
    found = writer.write.Written(page)
    written = [block["written"] for block in found.blocks if block["kind"] == "output"]
    assert written == [f"```text\n{printed}```\n" for printed in found._printed()]  # alone: commands of pages are tests
    assert written


def test_the_rows_of_agreement_are_up_to_date(readme):
    """If this fails, run ``make readme``."""
    assert validation_tables.agreement_table() in readme


def test_two_of_three_makers_state_twice_our_torque(readme):
    """The sentence below the table, by its rows of double nuts."""
    rows = (
        readme.split("<!-- include: validation/agreement.md -->")[1].split("<!-- end -->")[0].strip().splitlines()[2:]
    )
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    of = {
        who.split(",")[0]: float(ratio.split()[0])
        for who, what, _, _, ratio in cells
        if "torque" in what and "double" in what
    }
    assert list(of) == ["Rexroth", "HIWIN", "THK"]
    assert 0.45 < of["HIWIN"] < 0.6
    assert 0.45 < of["THK"] < 0.6
    assert of["Rexroth"] > 0.8
    assert "Two of three makers, THK and HIWIN, state about twice our torque" in " ".join(readme.split())


def test_one_sentence_says_what_it_is(readme):
    """Where people meet the project, they read the same: that of the package."""
    said = ballscrew.__doc__.splitlines()[0]
    assert f"**{said}**" in readme
    for file in ("pyproject.toml", "CITATION.cff", "docs/index.md"):
        assert said in " ".join((ROOT / file).read_text(encoding="utf-8").split()), file
    assert app.info.help == said


def test_the_readme_is_short(readme):
    assert len(readme.splitlines()) <= 80


def test_the_inputs_said_to_move_the_torque_most_are_those_of_the_command():
    """In the order of ``ballscrew sensitivity examples/feed_drive.toml``."""
    case = case_file.load(ROOT / "examples" / "feed_drive.toml")
    total = sensitivity(case, SensitivityOptions(samples=256)).result.total
    shares = {name.rpartition(".")[2]: one.value for name, one in total.items()}
    first, second, third = sorted(shares, key=shares.__getitem__, reverse=True)[:3]
    assert first == "share_of_load"
    assert shares[first] > 2 * shares[second]
    assert (second, third) == ("ball_friction_coefficient", TEMPERATURE.name)
    assert max(shares["boundary_friction_coefficient"], shares["full_film_friction_coefficient"]) < 0.05
    said = "force between balls, far ahead; friction between balls; temperature of the oil."
    page = (ROOT / "docs" / "sensitivity.md").read_text(encoding="utf-8")
    assert said in " ".join(page.split())


def test_the_python_example_is_ten_lines_and_readable(readme):
    example, _, rest = readme.split("```python\n")[1].partition("```")
    assert len([line for line in example.splitlines() if line]) == 10
    shown = rest.split("<!-- output: python -->")[1].split("<!-- end -->")[0]
    assert "helix" in shown
    assert "np." not in shown
