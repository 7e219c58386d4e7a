"""The table of fields in the documentation: what stands there as an example may be written in a case file."""

import case_tables
from ballscrew.basis import units
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import within_bounds
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.physics.components.screw import MATERIALS
from support.rules import for_each

EXAMPLES = list(case_tables.examples())


@for_each(
    example={
        f"{section}.{quantity.name} = {written}": (section, quantity, written)
        for section, quantity, written in EXAMPLES
    }
)
def test_examples_lie_within_the_bounds_of_their_field(example):
    section, quantity, written = example
    value = units.parse(f"{section}.{quantity.name}", written, quantity)
    assert not isinstance(value, Fault), value
    assert within_bounds(quantity.info, value)


def test_examples_are_those_of_the_example_file():
    table = case_tables.field_table()
    for row in ('| `ball_diameter` | $d_w$ | `"6.35 mm"`', "| `loaded_balls` | $z$ | `75`", "| `starts` | $N$ | `1`"):
        assert row in table


def test_every_section_has_its_name():
    table = case_tables.field_table()
    for name in ("screw", *(f"screw.{material}" for material in MATERIALS), "lubricant", "operation", "model"):
        assert f"`[{name}]`" in table


def test_every_name_of_a_column_is_in_the_table_of_columns():
    lines = {line.split("`")[1]: line for line in case_tables.column_table().splitlines()[2:]}
    assert list(lines) == [column.name for column in COLUMNS]
    for column in COLUMNS:
        assert all(f"`{name}`" in lines[column.name] for name in (*column.aliases, *column.hints))
        assert ("| yes |" in lines[column.name]) == column.required
    assert "| mm |" in lines["lead"]
