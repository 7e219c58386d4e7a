"""The answer of an axis over its stroke: declared once, and the same on every face."""

import dataclasses

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


@pytest.mark.parametrize("share", [0.4, 0.49, 0.51, 1.5])
def test_speed_and_load_are_judged_against_their_limits(report, share):
    """A shaft with a safety of two against buckling stands half of its load; a speed is judged by its share."""
    limits = dataclasses.replace(report.case.limits, buckling_safety=2.0, critical_speed_share=0.5)
    buckling, critical = np.min(report.chain.buckling_load), np.min(report.chain.critical_speed)
    judged = dataclasses.replace(
        report,
        case=dataclasses.replace(report.case, limits=limits),
        asked=tuple(report.chain.position),
        largest_load=share * buckling,
        largest_speed=share * critical,
    )
    verdicts = {record.id: record for record in judged.verdicts}
    for name, worst in (("verdict.buckling", buckling), ("verdict.critical_speed", critical)):
        assert verdicts[name].holds == (share < 0.5), name
        assert verdicts[name].limit == pytest.approx(worst / 2, rel=1e-12)
        assert verdicts[name].severity == ("info" if share < 0.5 else "warning")
