"""The answer of an axis over its stroke: declared once, and the same on every face."""

import numpy as np
import pytest

from ballscrew.basis.output.sheet import Columns, Table
from ballscrew.questions.axis.answer import SERIES, ChainResults, chain_of, document, sheet
from ballscrew.questions.shared import schemas
from support.axis_cases import load
from support.commands import ROOT

EXAMPLES = ROOT / "examples"


@pytest.fixture(scope="module")
def report():
    return chain_of(load(EXAMPLES / "feed_axis.toml", []))


def test_every_number_at_a_place_is_on_every_face(report):
    """A number is annotated where it is computed."""
    answer, schema = document(report), schemas.schema(ChainResults).model_json_schema()
    results, of_place = answer["results"], schema["$defs"]["AtPlace"]["properties"]
    (columns,) = sheet(report).of_kind(Columns)
    tables = {table.name: table for table in sheet(report).of_kind(Table)}
    shown = {cell.quantity.name for row in tables["places"].rows for cell in row[1:]}
    shown |= {row[0] for row in tables["rigidity"].rows} | {"position"}
    for name, quantity in SERIES.items():
        described = schema["properties"][name]
        column = next(column for column in columns.columns if column.name == quantity.info.meaning)
        assert len(results[name]) == len(report.chain.position)
        np.testing.assert_array_equal(column.values, report.series[name])
        assert results["softest"][name] == results[name][report.softest]
        assert answer["units"][name] == answer["units"]["softest"][name] == quantity.unit
        assert described["x-si-unit"] == of_place[name]["x-si-unit"] == quantity.unit
        assert described["description"].startswith(quantity.info.meaning)
        assert name in shown or not np.isfinite(report.series[name]).any()
