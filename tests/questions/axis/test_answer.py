"""The answer of an axis over its stroke: declared once, and the same on every face."""

import pytest

from ballscrew.basis import units
from ballscrew.questions.axis import document, table, text
from ballscrew.questions.axis.answer import ChainResults
from ballscrew.questions.axis.compute import FRICTION, LOAD, SERIES, SPEED, chain_of, load
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.answer_parts import Assumed
from ballscrew.questions.shared.text_tables import shown_or_dash
from support.answers import undescribed, without_unit
from support.commands import ROOT

EXAMPLES = ROOT / "examples"


@pytest.fixture(scope="module")
def report():
    return chain_of(load(EXAMPLES / "feed_axis.toml", []))


def test_every_number_at_a_place_is_on_every_face(report):
    """A number is annotated where it is computed; of what follows, only the terminal chooses."""
    answer, schema = document.document(report), declared.schema(ChainResults).model_json_schema()
    results, places = answer["results"], table.places(report)
    of_place, words = schema["$defs"]["AtPlace"]["properties"], text.text(report)
    for name, quantity in SERIES.items():
        described = schema["properties"][name]
        assert len(results[name]) == len(report.chain.position) == len(places.rows)
        assert results["softest"][name] == results[name][report.softest]
        assert answer["units"][name] == answer["units"]["softest"][name] == quantity.unit
        assert described["x-si-unit"] == of_place[name]["x-si-unit"] == quantity.unit
        assert described["description"].startswith(quantity.info.meaning)
        assert units.heading(quantity, quantity.info.meaning) in places.headings
        assert shown_or_dash(results[name][report.shown[0]], quantity) in words


def test_the_numbers_of_the_motion_have_units(report):
    answer, schema = document.document(report), declared.schema(ChainResults).model_json_schema()["properties"]
    for quantity in (LOAD, SPEED, FRICTION):
        assert answer["results"][quantity.name] == getattr(report, quantity.name)
        assert answer["units"][quantity.name] == quantity.unit == schema[quantity.name]["x-si-unit"]
    assert list(without_unit(answer["results"], answer["units"])) == []


@pytest.mark.parametrize("example", ["feed_axis.toml", "catalogue_screw.toml"])
def test_answers_are_valid_by_their_schema(example):
    found = document.document(chain_of(load(EXAMPLES / example, [])))
    declared.response(ChainResults, "Chain", beside=Assumed).model_validate(found)


def test_every_part_is_described():
    assert list(undescribed(ChainResults)) == []
