"""The answer of a comparison: declared once, and the same on every face."""

import pytest

from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.compare import compute
from ballscrew.questions.compare.compute import Compared, ComparedLaw, ComparedModel, comparison
from ballscrew.questions.compare.sheet import sheet
from ballscrew.questions.shared import declared, schemas
from support.answers import without_unit
from support.commands import ROOT

SERVICE = ROOT / "examples" / "service.toml"


@pytest.fixture(scope="module")
def compared():
    case = case_file.load(SERVICE)
    return case, comparison(case)


def test_every_number_of_a_model_is_on_every_face(compared):
    case, found = compared
    answer = compute.document(case, found)
    words = terminal.text(sheet(case, found))
    schema = schemas.schema(Compared).model_json_schema()["$defs"]
    for name, quantity in quantities_of(ComparedModel).items():
        assert quantity.info == quantities_of(FrictionResult)[name].info
        assert answer["case"][name] == pytest.approx(getattr(found.case.result, name), rel=1e-15, nan_ok=True)
        for model in ("ComparedModel", "ComparedLaw"):
            assert schema[model]["properties"][name]["description"].startswith(quantity.info.meaning)
            assert schema[model]["properties"][name].get("x-si-unit", "1") == quantity.unit
        assert answer["units"].get(name, "1") == quantity.unit
    for row in (*answer["models"], *answer["laws"]):
        assert f"{row['screw_torque']:.4g}" in words


def test_every_number_has_a_unit(compared):
    answer = compute.document(*compared)
    parts = (answer["case"], *answer["laws"], *answer["rules"], answer["of_balls"])
    assert [path for part in parts for path in without_unit(part, answer["units"])] == []
    assert answer["units"]["drag_torque"] == "N m"


def test_a_law_has_its_slot_and_what_a_model_has(compared):
    answer = compute.document(*compared)
    assert answer["laws"][0].keys() == declared.parts_of(ComparedLaw).keys()
    assert answer["laws"][0].keys() - answer["models"][0].keys() == {"slot", "counts"}
