"""Every public function, class and method has a table of its parameters on the page of the Python reference."""

import inspect
import re

import ballscrew
import parameter_tables as tables
from ballscrew.basis.quantities import fields_of
from support.rules import for_each

from .pages import DOCS

PUBLIC = tables.public()
ALL = {**PUBLIC, **tables.methods()}


def test_all_that_is_public_stands_on_the_page():
    text = (DOCS / "reference.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"^\.\. auto(?:class|function|exception):: ballscrew\.(\w+)$", text, re.MULTILINE))
    assert set(ballscrew.__all__) - documented == {"__version__"}


def test_methods_of_the_page_are_found():
    assert {"FrictionModel.__call__", "Lubricant.from_grade", "FrictionResult.shaft_torque"} <= set(tables.methods())


@for_each(name={name: name for name in ALL})
def test_the_table_has_every_parameter_with_its_meaning(name):
    rows = tables.rows_of(name)
    taken = [] if tables.takes_nothing_of_its_own(ALL[name]) else list(inspect.signature(ALL[name]).parameters)
    assert [row.name.strip("*") for row in rows] == [one for one in taken if one != "self"]
    assert [row.name for row in rows if not row.meaning] == []
    assert [row.name for row in rows if not row.kind.strip("`")] == []
    assert sum(line.startswith("   * -") for line in tables.lines_of(name)) == (len(rows) + 1 if rows else 0)


def test_none_lacks_a_table():
    """All but what takes nothing: a function without parameters, and a warning."""
    assert {name for name in ALL if not tables.lines_of(name)} == {"catalogue", "ImplausibleInput"}


def test_units_are_those_of_the_annotations():
    units = {row.name: row.unit for row in tables.rows_of("BallScrew")}
    for name, quantity in fields_of(ballscrew.BallScrew).items():
        assert units[name] == ("" if quantity.unit == "1" else quantity.unit)
    assert {row.name: row.unit for row in tables.rows_of("preload_of_torque")}["torque_deviation"] == "N m"


def test_no_meaning_is_left_over():
    names = {name: {row.name.strip("*") for row in tables.rows_of(name)} for name in ALL}
    functions = [names[name] for name, value in ALL.items() if not isinstance(value, type)]
    for of, stated in tables.meanings().items():
        known = set().union(*functions) if of == "common" else names[of]
        assert set(stated) <= known, f"parameter_meanings.toml: [{of}]"
