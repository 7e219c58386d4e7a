"""The rooms: without import cycles, and as CONTRIBUTING.md lists them."""

import re

import pytest

import make_rooms


def without_sizes(text):
    """The table without its numbers and its largest files, which change with every line of code."""
    return re.sub(r"\d+( \(`[^`]*`\))?", "", text)


def test_the_table_is_up_to_date():
    text = make_rooms.CONTRIBUTING.read_text(encoding="utf-8")
    assert without_sizes(text) == without_sizes(make_rooms.page(text)), "run: make rooms"
    total = int(re.search(r"In all: (\d+) lines", text)[1])
    assert total == pytest.approx(sum(room.lines for room in make_rooms.rooms()), rel=0.1), "run: make rooms"


def test_imports_form_no_cycle():
    assert make_rooms.cycles(make_rooms.arrows()) == []
    assert make_rooms.cycles(make_rooms.modules()) == []


def test_cycles_are_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}, "e": set()}
    assert make_rooms.cycles({name: frozenset(others) for name, others in graph.items()}) == [["a", "b", "c"]]
