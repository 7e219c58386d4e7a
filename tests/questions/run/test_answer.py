"""The answer of a run: declared once, and the same on every face."""

import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.questions.run import compute
from ballscrew.questions.run.answer import RunResults, document
from ballscrew.questions.run.compute import OF_ONE_BALL
from ballscrew.questions.run.sheet import SHOWN, meaning, sheet
from ballscrew.questions.shared import schemas
from support.commands import ROOT

CASES = {
    "a row of equal balls": ("olaru2005.toml", ()),
    "a preloaded nut": ("service.toml", ()),
    "at rest": ("service.toml", ("operation.screw_speed=0 rpm",)),
    "without load": ("olaru2005.toml", ("operation.axial_load=0 N",)),
    "on four contacts": ("service.toml", ("nut.type=oversize-balls", "nut.preload=2 kN")),
}


@pytest.fixture(scope="module", params=CASES.values(), ids=CASES)
def found(request):
    name, settings = request.param
    tables = case_file.override(case_file.read(ROOT / "examples" / name), list(settings))
    return compute.run(case_file.build(tables, None, ROOT))


def test_every_number_is_on_every_face(found):
    answer, described = plain(document(found)), schemas.schema(RunResults).model_json_schema()["properties"]
    results, units = answer["results"], answer["units"]
    for name, quantity in found.quantities.items():
        if name in ("axial_load", "screw_speed"):  # inputs
            continue
        assert name in results
        assert described[name]["description"].startswith(quantity.info.meaning)
        if not isinstance(results[name], bool):
            assert units[name] == quantity.unit == described[name].get("x-si-unit", "1")
    assert (OF_ONE_BALL & results.keys() == set()) == (found.nut is not None)
    assert ("preload_drag" in results) == ("loads" in answer) == (found.nut is not None)


def test_the_first_numbers_are_on_the_terminal(found):
    words = terminal.text(sheet(found))
    is_loaded = float(found.friction.axial_load) != 0
    for name in SHOWN:
        if name in found.quantities and (is_loaded or name != "holding_torque"):
            assert meaning(name) in words
