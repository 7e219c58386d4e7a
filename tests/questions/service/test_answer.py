"""The answer of a service: declared once, and the same on every face."""

import json

import pytest

from ballscrew.basis import units
from ballscrew.basis.quantities import quantities_of
from ballscrew.questions.service.answer import EstimatedPreload, ServiceResults
from ballscrew.questions.shared import schemas
from support.answers import without_unit
from support.commands import ROOT

EXAMPLES = ROOT / "examples"
#: The model of the paper answers the quickest.
CASE = ("--case", EXAMPLES / "service.toml", "--model", "olaru2005")
ASKED = {
    "two logs": (EXAMPLES / "nut_new.csv", EXAMPLES / "nut_worn.csv", *CASE),
    "one torque": (*CASE, "--torque", "0.5 N m", "--speed", "100 rpm"),
}


@pytest.fixture(params=ASKED.values(), ids=ASKED)
def answer(request, ballscrew):
    return json.loads(ballscrew("service", *request.param, "--json").stdout)


@pytest.mark.slow
def test_every_number_of_a_preload_is_on_every_face(ballscrew):
    answer = json.loads(ballscrew("service", *ASKED["two logs"], "--json").stdout)
    words = ballscrew("service", *ASKED["two logs"]).stdout
    described = schemas.schema(ServiceResults).model_json_schema()["$defs"]["EstimatedPreload"]["properties"]
    for of in ("new", "worn"):
        for name, quantity in quantities_of(EstimatedPreload).items():
            assert answer["results"][of][name] > 0
            assert answer["units"][of][name] == quantity.unit == described[name]["x-si-unit"]
            assert described[name]["description"].startswith(quantity.info.meaning)
        preload = quantities_of(EstimatedPreload)["preload"]
        # ends of an interval are rounded outwards
        value, low, high = (
            units.rounded(answer["results"][of][name], preload, toward=toward)
            for name, toward in {"preload": 0, "low": -1, "high": 1}.items()
        )
        assert f"{value} N ({low} to {high})" in words


@pytest.mark.slow
def test_results_are_valid_by_their_schema(answer):
    schemas.schema(ServiceResults).model_validate(answer["results"])
    assert ("ratio" in answer["results"]) != ("torque" in answer["results"])


@pytest.mark.slow
def test_every_number_has_a_unit(answer):
    (causes,) = [answer["results"].pop("alternatives", [])]
    assert list(without_unit(answer["results"], answer["units"])) == []
    # each of these numbers says its own unit
    assert {name for one in causes for name in without_unit(one, answer["units"]["alternatives"])} <= {
        "value",
        "instead_of",
    }
