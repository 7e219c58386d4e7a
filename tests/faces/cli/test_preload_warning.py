"""A preload beyond what vendors give a nut of its rating is said, in text and in JSON."""

import json

import pytest
from typer.testing import CliRunner

from ballscrew.faces.cli.main import app
from support.drive_case import drive_case


@pytest.mark.parametrize(("preload", "is_said"), [("15 %", True), ("10.8 kN", True), ("10 %", False), ("7 %", False)])
def test_a_preload_above_the_ratings(tmp_path, preload, is_said):
    case = tmp_path / "case.toml"
    case.write_text(drive_case(preload, "3 kN"), encoding="utf-8")
    said = json.loads(CliRunner().invoke(app, ["run", str(case), "--json"]).stdout)["warnings"]
    found = [record for record in said if record["id"] == "run.preload_above_rating"]
    assert bool(found) == is_said
    text = CliRunner().invoke(app, ["run", str(case)]).stdout
    assert ("preload_above_rating" in text) == is_said
