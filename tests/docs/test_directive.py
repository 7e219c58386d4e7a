"""The directive that shows commands with their output: what it runs, what it keeps, what it shows."""

import importlib.util

import pytest

from .pages import DOCS


@pytest.fixture
def command(tmp_path, monkeypatch):
    spec = importlib.util.spec_from_file_location("command_directive", DOCS / "_ext" / "command.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "KEPT", tmp_path / "kept")
    module.KEPT.mkdir()
    return module


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
    assert command.causes([write, read])[-1] == page.cause


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
    assert not list(command.KEPT.glob("*.txt"))


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
    assert command._chosen("one\ntwo\nthree\nfour\n", show) == expected


def test_words_that_are_not_there_are_an_error(command):
    with pytest.raises(RuntimeError, match="does not say: five"):
        command._chosen("one\n", "five ..")


def test_long_commands_stand_on_several_lines(command):
    typed = ".venv/bin/ballscrew sweep case.toml " + " ".join(f'--vary number_{i}="1, 2, 3"' for i in range(5))
    shown = command._displayed(typed)
    assert all(len(line) <= 100 for line in shown.splitlines())
    assert " ".join(shown.replace("\\\n", " ").split()) == typed
