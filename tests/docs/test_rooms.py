"""The rooms: small, without import cycles, and as CONTRIBUTING.md lists them."""

import re

import pytest

import make_rooms

#: 2,500 is the aim; equations, components and solvers are libraries of short modules, and the next to be cut.
MOST_LINES = 3150
MOST_LINES_OF_A_FILE = 400


def without_sizes(text):
    """The table without its numbers and its largest files, which change with every line of code."""
    return re.sub(r"\d+( \(`[^`]*`\))?", "", text)


def test_the_table_is_up_to_date():
    text = make_rooms.CONTRIBUTING.read_text(encoding="utf-8")
    assert without_sizes(text) == without_sizes(make_rooms.page(text)), "run: make rooms"
    total = int(re.search(r"In all: (\d+) lines", text)[1])
    assert total == pytest.approx(sum(room.lines for room in make_rooms.rooms()), rel=0.1), "run: make rooms"


def test_no_room_is_too_large_to_know():
    assert {room.name for room in make_rooms.rooms() if room.lines > MOST_LINES} == set()


def test_no_file_is_too_long():
    lengths = {f"{room.name}/{name}": lines for room in make_rooms.rooms() for name, lines in room.files.items()}
    assert {name: lines for name, lines in lengths.items() if lines > MOST_LINES_OF_A_FILE} == {}


def test_imports_form_no_cycle():
    assert make_rooms.cycles(make_rooms.arrows()) == []
    assert make_rooms.cycles(make_rooms.modules()) == []


def test_cycles_are_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}, "e": set()}
    assert make_rooms.cycles({name: frozenset(others) for name, others in graph.items()}) == [["a", "b", "c"]]
