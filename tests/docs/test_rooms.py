"""The rooms: without import cycles, and as CONTRIBUTING.md lists them."""

import re
import tomllib

import pytest

import make_rooms

pytestmark = pytest.mark.slow


def without_sizes(text):
    """The table without its numbers, which change with every line of code."""
    return re.sub(r"\d+(\.\d+)?", "", text)


def test_the_table_is_up_to_date():
    text = make_rooms.CONTRIBUTING.read_text(encoding="utf-8")
    assert without_sizes(text) == without_sizes(make_rooms.page(text)), "run: make rooms"
    total = int(re.search(r"In all: (\d+) lines", text)[1])
    assert total == pytest.approx(sum(room.lines for room in make_rooms.rooms(make_rooms.folder_of)), rel=0.1), (
        "run: make rooms"
    )


def test_imports_form_no_cycle():
    assert make_rooms.cycles(make_rooms.arrows(make_rooms.folder_of)) == []
    assert make_rooms.cycles(make_rooms.arrows(make_rooms.room_of)) == []
    assert make_rooms.cycles(make_rooms.modules()) == []


def test_the_order_of_the_folders_holds_for_modules_that_are_named_in_strings_too():
    contracts = tomllib.loads((make_rooms.HERE / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    layers = [{name.strip() for name in line.split("|")} for line in contracts["contracts"][0]["layers"]]
    height = {name: -line for line, names in enumerate(layers) for name in names}
    arrows = make_rooms.arrows(make_rooms.folder_of)
    assert set(height) == set(arrows)
    assert [(one, other) for one, others in arrows.items() for other in others if height[other] >= height[one]] == []


def test_a_module_named_in_a_string_is_found():
    assert "ballscrew.faces.web.job_program" in make_rooms.named("ballscrew.faces.web.job_process")


def test_cycles_are_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}, "e": set()}
    assert make_rooms.cycles({name: frozenset(others) for name, others in graph.items()}) == [["a", "b", "c"]]
