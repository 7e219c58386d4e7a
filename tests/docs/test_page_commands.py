"""Commands of pages and their output: what is run, what is kept, what is shown."""

import shutil
import subprocess

import pytest

from support.commands import Commands

from .pages import ROOT, WRITER

#: A program that stands in for the one of the pages, and a table that it reads.
PROGRAM = {
    "src/screw/__init__.py": "",
    "src/screw/__main__.py": "from screw import first\nprint(first.torque())\n",
    "src/screw/first.py": (
        "from pathlib import Path\n"
        "def torque():\n"
        "    return Path('examples/case.toml').read_text() + Path(__file__).with_name('table.txt').read_text()\n"
    ),
    "docs/page.md": "",
    ".gitignore": "__pycache__\n",
    "tests/test_screw.py": "",
    "src/screw/table.txt": "1 N m",
    "examples/case.toml": "case, ",
}
#: What forks in place of the libraries: a process that has loaded nothing.
SERVER = f"""
import sys
sys.path[:0] = [{str(WRITER)!r}, {str(ROOT / "tests")!r}]
from support import fork_server
fork_server.serve(sys.argv[1])
"""


@pytest.fixture
def repository(writer, tmp_path, monkeypatch):
    """A repository with the program in it, whose pages keep what is printed beside it."""
    root = tmp_path / "repository"
    for name, text in PROGRAM.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    subprocess.run(["git", "init", "-q", root], check=True)
    monkeypatch.setattr(writer.command, "KEPT", tmp_path / "kept")
    writer.command.KEPT.mkdir()
    return root


@pytest.fixture
def command(writer, repository, monkeypatch):
    whole_page = writer.command.Page
    monkeypatch.setattr(writer.command, "Page", lambda name: whole_page(name, repository))
    return writer.command


@pytest.fixture
def program(writer, repository, tmp_path, monkeypatch):
    """The function that runs the program on a page and says whether it ran."""
    server = tmp_path / "server.py"
    server.write_text(SERVER, encoding="utf-8")
    commands = Commands(server, [repository / "src"])
    monkeypatch.setattr(writer.command, "ROOT", repository)
    monkeypatch.setattr(writer.command, "MODULE", "screw")
    monkeypatch.setattr(writer.command, "program_at_hand", lambda: commands)
    yield Program(writer.command, writer.kept, repository)
    commands.close()


class Program:
    """The program on a page, as a new build finds it."""

    def __init__(self, module, kept, root):
        self.module, self.kept, self.root = module, kept, root

    def page(self):
        self.kept.cause_of_all.cache_clear()
        return self.module.Page("a", self.root)

    def runs(self, expected):
        """Whether it runs for its output, which is as expected."""
        page = self.page()
        assert page.said(f"{self.module.PROGRAM} now", []) == f"{expected}\n"
        return not page.waiting


def test_what_is_kept_is_not_run_again(command, tmp_path):
    counter = tmp_path / "counter"
    typed = f"echo ran >> {counter}; ls examples/feed_drive.toml"
    assert command.Page("a").said(typed, []) == "examples/feed_drive.toml\n"
    assert command.Page("b").said(typed, []) == "examples/feed_drive.toml\n"
    assert counter.read_text() == "ran\n"


def test_a_later_command_finds_what_an_earlier_one_wrote(command):
    write, read = "mkdir -p out && echo 42 > out/answer && echo written", "cat out/answer"
    assert command.Page("a").said(write, []) == "written\n"
    page = command.Page("a")
    assert page.said(write, []) == "written\n"  # kept, so not run
    assert page.said(read, []) == "42\n"  # but needed here
    assert command.Page("a").said(write, []) == "written\n"


def test_output_belongs_to_all_commands_before_it(command):
    page, other = command.Page("a"), command.Page("a")
    page.said("true", [])
    assert page.said("ls out 2>/dev/null | wc -l", []) == "0\n"
    other.said("mkdir out && touch out/x", [])
    assert other.said("ls out 2>/dev/null | wc -l", []) == "1\n"


def test_files_are_kept_beside_the_page(command):
    page = command.Page("howto/a")
    page.said("mkdir out && echo picture > out/p.svg", ["out/p.svg"])
    assert (command.KEPT / "howto-a" / "p.svg").read_text() == "picture\n"
    (command.KEPT / "howto-a" / "p.svg").unlink()
    command.Page("howto/a").said("mkdir out && echo picture > out/p.svg", ["out/p.svg"])
    assert (command.KEPT / "howto-a" / "p.svg").is_file(), "made again where it is gone"


def test_a_command_that_fails_is_an_error(command):
    with pytest.raises(RuntimeError, match="ended with 3"):
        command.Page("a").said("echo why >&2; exit 3", [])
    assert not list(command.KEPT.iterdir())


@pytest.mark.parametrize(
    ("changed", "text", "expected"),
    [
        ("src/screw/table.txt", "2 N m", "case, 2 N m"),
        ("src/screw/first.py", "def torque():\n    return 'another'\n", "another"),
        ("src/screw/__init__.py", "# a comment, which could have been code\n", "case, 1 N m"),
        ("examples/case.toml", "another case, ", "another case, 1 N m"),
        ("examples/added.toml", "", "case, 1 N m"),  # a program may look whether there is one
        ("src/screw/third.py", "", "case, 1 N m"),  # and find another module than before
    ],
)
def test_a_command_runs_again_if_a_file_has_changed(changed, text, expected, program):
    assert program.runs("case, 1 N m")
    assert not program.runs("case, 1 N m")
    (program.root / changed).write_text(text, encoding="utf-8")
    assert program.runs(expected)
    assert not program.runs(expected)


@pytest.mark.parametrize("changed", ["docs/page.md", "tests/test_screw.py"])
def test_a_command_does_not_run_again_for_pages_and_tests(changed, program):
    assert program.runs("case, 1 N m")
    (program.root / changed).write_text("# changed\n", encoding="utf-8")
    assert not program.runs("case, 1 N m")


def test_where_git_knows_no_files_all_runs_again(program):
    shutil.rmtree(program.root / ".git")
    assert program.runs("case, 1 N m")
    assert program.runs("case, 1 N m")


def test_a_file_that_changes_while_the_command_runs_is_another_to_the_next_build(program):
    page = program.page()
    (program.root / "src/screw/table.txt").write_text("2 N m", encoding="utf-8")
    page.said(f"{program.module.PROGRAM} now", [])
    assert program.runs("case, 2 N m")


@pytest.mark.parametrize(
    ("show", "expected"),
    [
        ("..", "one\ntwo\nthree\nfour\n"),
        (".. two", "one\ntwo\n…\n"),
        ("three ..", "…\nthree\nfour\n"),
        ("two .. two | four .. four", "…\ntwo\n…\nfour\n"),
        ("two .. two | three .. four", "…\ntwo\nthree\nfour\n"),
    ],
)
def test_parts_are_shown_and_gaps_are_said(command, show, expected):
    assert command.chosen("one\ntwo\nthree\nfour\n", show) == expected


def test_words_that_are_not_there_are_an_error(command):
    with pytest.raises(RuntimeError, match="does not say: five"):
        command.chosen("one\n", "five ..")


def test_long_commands_stand_on_several_lines(command):
    typed = ".venv/bin/ballscrew sweep case.toml " + " ".join(f'--vary number_{i}="1, 2, 3"' for i in range(5))
    shown = command.displayed(typed)
    assert all(len(line) <= 100 for line in shown.splitlines())
    assert " ".join(shown.replace("\\\n", " ").split()) == typed
