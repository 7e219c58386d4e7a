"""Input that would take all time or memory: one line, and no traceback."""

import ast
import re
import subprocess
import sys
import textwrap

import pytest

from support.commands import ROOT

pytestmark = pytest.mark.slow

CASE = (ROOT / "examples" / "feed_drive.toml").read_text(encoding="utf-8")
NUT = '\n[nut]\ntype = "double"\npreload = "3 kN"\n[bodies]\n'


def one_line(found, text, code=2):
    assert found.returncode == code
    assert found.stdout == ""
    (line,) = found.stderr.splitlines()
    assert text in line
    assert len(line) < 500


@pytest.fixture
def case(tmp_path):
    def written(old="", new="", more=""):
        assert old in CASE
        path = tmp_path / "case.toml"
        path.write_text(CASE.replace(old, new) + more, encoding="utf-8")
        return path

    return written


@pytest.mark.parametrize("balls", ["100000", "1" + 99 * "0", "1e99"])
def test_balls_without_number(ballscrew, case, balls):
    one_line(ballscrew("run", case("loaded_balls = 75", f"loaded_balls = {balls}", NUT)), "must be at most 10000")


def test_more_balls_than_can_be_solved_one_by_one(ballscrew, case):
    path = case("loaded_balls = 75", "loaded_balls = 9999", NUT)
    one_line(ballscrew("run", path), "screw.loaded_balls: too many to solve one by one (9999) · 2000 at most")


def test_a_whole_number_of_thousands_of_digits(ballscrew, case):
    huge = "0x" + 4200 * "f"
    text = "is not TOML (a whole number has more than 1024 bits)"
    one_line(ballscrew("run", case("loaded_balls = 75", f"loaded_balls = {huge}")), text)
    one_line(ballscrew("run", case(), "--set", f"screw.loaded_balls={huge}"), "screw.loaded_balls: has more than 200")


def test_files_without_end(ballscrew, case):
    one_line(ballscrew("run", "/dev/zero"), "/dev/zero: cannot be read (is larger than 4 MB)")
    row = '[screw]\ncatalogue = "x"\ncatalogue_file = "/dev/zero"\n'
    path = case(CASE[: CASE.index("[lubricant]")], row)
    one_line(ballscrew("run", path), "/dev/zero: cannot be read (is larger than 50 MB)")


def test_a_closed_output(case):
    command = f'"{sys.executable}" -m ballscrew.faces.cli run "{case()}" >&-'
    one_line(subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False), "stdout: is closed")


@pytest.mark.parametrize("when", ["loading", "running"])
def test_an_interrupt_while_the_program_is_loaded(when):
    stopped = {
        "loading": """
            import sys
            class Interrupt:
                def find_spec(self, name, *_):
                    if name == "typer":
                        raise KeyboardInterrupt
            sys.meta_path.insert(0, Interrupt())
            """,
        "running": """
            import types, sys
            def main():
                raise KeyboardInterrupt
            sys.modules["ballscrew.faces.cli.main"] = types.SimpleNamespace(main=main)
            """,
    }
    program = textwrap.dedent(stopped[when]) + "from ballscrew.faces.cli.start import main\nmain()"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    one_line(found, "interrupted", code=130)


def interrupted(patch, *arguments):
    """A command that is interrupted by what ``patch`` puts into its place."""
    program = f"{textwrap.dedent(patch)}\nimport sys\nsys.argv = ['ballscrew', *{[*map(str, arguments)]!r}]\n"
    program += "from ballscrew.faces.cli.start import main\nmain()"
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)


def test_an_interrupt_says_how_far_it_came_and_how_to_go_on(case):
    patch = """
        from ballscrew.questions.sensitivity import answer
        def sensitivity(*given):
            given[-1](300, 4000)
            raise KeyboardInterrupt
        answer.sensitivity = sensitivity
        """
    line = "sensitivity: interrupted at 300 of 4,000, nothing is kept · run the same again"
    one_line(interrupted(patch, "sensitivity", case()), line, code=130)


def test_an_interrupted_selection_says_what_it_keeps(tmp_path):
    patch = """
        from ballscrew.questions.select import compute
        judged, left = compute.judged, [3]
        def until_interrupted(*given, **options):
            left[0] -= 1
            if not left[0]:
                raise KeyboardInterrupt
            return judged(*given, **options)
        compute.judged = until_interrupted
        """
    need, table = ROOT / "examples" / "needs" / "feed_axis.toml", tmp_path / "kept.csv"
    found = interrupted(patch, "select", need, "--set", "need.least_rigidity=1e6 N/um", "--complete", "--to", table)
    assert found.returncode == 130
    assert "none of the candidates judged so far holds" in found.stdout
    assert "no candidate holds" not in found.stdout
    assert len(table.read_text().splitlines()) == 3
    last = found.stderr.splitlines()[-1]
    assert re.fullmatch(r"interrupted: 2 of \d+ are done and kept, the last is .* · run the same again for all", last)


def test_messages_name_only_files_that_are_installed():
    """The folders beside the package are not in the wheel; docstrings of modules may name them."""
    folders = ("examples/", "docs/", "tests/", "benchmarks/")
    for path in (ROOT / "src" / "ballscrew").rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        prose = {id(statement.value) for statement in ast.walk(tree) if isinstance(statement, ast.Expr)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in prose:
                assert not any(folder in node.value for folder in folders), f"{path}:{node.lineno}"
