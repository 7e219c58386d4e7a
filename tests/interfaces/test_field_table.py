"""The table of fields in the documentation: what stands there as an example may be written in a case file."""

import importlib.util
from pathlib import Path

import pytest

from ballscrew.components.screw import MATERIALS
from ballscrew.faults import Fault
from ballscrew.interfaces import units
from ballscrew.quantities import within_bounds

ROOT = Path(__file__).parents[2]


def _field_table():
    spec = importlib.util.spec_from_file_location("field_table", ROOT / "docs" / "field_table.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


FIELD_TABLE = _field_table()
EXAMPLES = list(FIELD_TABLE.examples())


@pytest.mark.parametrize(("section", "quantity", "written"), EXAMPLES, ids=lambda value: getattr(value, "name", None))
def test_examples_lie_within_the_bounds_of_their_field(section, quantity, written):
    value = units.parse(f"{section}.{quantity.name}", written, quantity)
    assert not isinstance(value, Fault), value
    assert within_bounds(quantity.info, value)


def test_examples_are_those_of_the_example_file():
    table = FIELD_TABLE.field_table()
    for row in ('| `ball_diameter` | $d_w$ | `"6.35 mm"`', "| `loaded_balls` | $z$ | `75`", "| `starts` | $N$ | `1`"):
        assert row in table


def test_every_section_has_its_name():
    table = FIELD_TABLE.field_table()
    for name in ("screw", *(f"screw.{material}" for material in MATERIALS), "lubricant", "operation", "model"):
        assert f"`[{name}]`" in table
