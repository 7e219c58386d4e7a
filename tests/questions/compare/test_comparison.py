"""``ballscrew compare``: all models and laws on one case, as table, JSON and picture."""

import math
import re

import pytest

from ballscrew.basis.output.sheet import Table
from ballscrew.cases.case_files import case_file
from ballscrew.cases.schema import case_schema
from ballscrew.engine.evaluation.comparison import same_law
from ballscrew.faces.sheets import terminal
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import LAWS, presets
from ballscrew.questions.compare import compute
from ballscrew.questions.compare.sheet import sheet
from ballscrew.questions.shared import charts
from support.commands import ROOT
from support.pictures import words_of
from support.processes import document_of


@pytest.fixture(scope="module")
def paper():

    return case_file.load(ROOT / "examples" / "olaru2005.toml", model="reference")


@pytest.fixture(scope="module")
def found(paper):
    return compute.comparison(paper)


# -- what is compared -----------------------------------------------------------------------------


def test_every_model_and_every_other_law_once(paper, found):
    assert [row.candidate.name for row in found.models] == list(presets())
    assert found.case is found.models[-1]
    expected = {
        (slot, name)
        for slot, known in LAWS.items()
        for name in known
        if name != case_schema.name_of_law(slot, getattr(paper.model, slot))
    }
    laws = [(row.candidate.slot, row.candidate.name) for row in found.laws]
    assert len(laws) == len(set(laws))
    # other laws take the coefficients of the case; the paper's film exponent and its boundary friction
    # come with the model that has them
    assert set(laws) == expected | {("film", "as in olaru2005"), ("friction", "as in olaru2005")}


def test_another_law_keeps_the_coefficients_it_shares_with_that_of_the_case(paper, found):
    mine = paper.model.friction.boundary_friction_coefficient
    rows = {row.candidate.name: row.candidate.model.friction for row in found.laws if row.candidate.slot == "friction"}
    assert rows["zhou-hoeprich"].boundary_friction_coefficient == mine
    assert rows["balan"].boundary_friction_coefficient == mine
    assert rows["as in olaru2005"].boundary_friction_coefficient != mine


def test_each_row_is_the_model_with_one_law_replaced(paper, found):
    for row in found.laws:
        slot = row.candidate.slot
        changed = [
            name for name in LAWS if not same_law(getattr(row.candidate.model, name), getattr(paper.model, name))
        ]
        assert changed == [slot]
        point = {name: getattr(paper.operation, name) for name in ("axial_load", "screw_speed")}
        alone = row.candidate.model(paper.screw, paper.lubricant, **point)
        assert row.torque == float(alone.screw_torque)
        assert row.change == pytest.approx(row.torque / found.case.torque - 1, rel=1e-12)


def test_spreads(found):
    torques = [row.torque for row in found.models]
    assert [row.torque for row in found.spread_of_models] == [min(torques), max(torques)]
    counting = [row for row in (found.case, *found.laws) if row.candidate.counts and not row.outside]
    torques = [row.torque for row in counting]
    assert [row.torque for row in found.spread_of_laws] == [min(torques), max(torques)]
    widths = [high - low for low, high in found.spans.values()]
    assert widths == sorted(widths, reverse=True)
    assert all(low <= 0 <= high for low, high in found.spans.values())
    assert not {"race_torques", "ideal_torque", "film_parameter"} & set(found.spans)


def test_what_the_case_changes_is_a_row_of_its_own(example):
    case = case_file.load(example, ["model.friction.boundary_friction_coefficient=0.15"], "reference")
    found = compute.comparison(case)
    assert found.case not in found.models
    assert found.rows[0] is found.case
    assert found.case.candidate.name == "this case"
    friction = {
        row.candidate.name: row.candidate.model.friction for row in found.laws if row.candidate.slot == "friction"
    }
    # what the case has changed holds for the other laws, too
    assert friction.pop("as in reference").boundary_friction_coefficient == 0.12
    assert friction.pop("as in olaru2005").boundary_friction_coefficient == 0.2
    assert {law.boundary_friction_coefficient for law in friction.values()} == {0.15}
    assert len(friction) == 4


@pytest.mark.parametrize("name", presets())
def test_any_model_can_be_the_case(name, example):
    found = compute.comparison(case_file.load(example, model=name))
    assert found.case.candidate.name == name
    assert all(math.isfinite(row.torque) for row in found.rows)
    for row in found.rows:
        assert sum(map(float, row.result.contributions.values())) == pytest.approx(row.torque, rel=1e-10)


def test_an_imposed_offset_does_not_stand_in_the_way(example):
    settings = ["model.slip=curvature", "model.pure_rolling_offset=0.3"]
    found = compute.comparison(case_file.load(example, settings, "reference"))
    models = {row.candidate.name: row.candidate.model for row in found.laws if row.candidate.slot == "slip"}
    assert set(models) == {"line", "ellipse"}
    assert all(model.pure_rolling_offset is None for model in models.values())
    assert found.case.candidate.model.pure_rolling_offset == 0.3


def test_nothing_finite_has_no_spread(example, ballscrew):
    found = compute.comparison(case_file.load(example, ["operation.axial_load=1e300 N"], "reference"))
    assert not any(math.isfinite(row.torque) for row in found.rows)
    assert found.spread_of_models is None
    assert found.spread_of_laws is None
    assert found.spans == {}
    process = ballscrew("compare", example, "--set", "operation.axial_load=1e300 N", "--to", "spread.png")
    assert process.returncode == 0, process.stderr
    assert "none is valid here" in process.stdout
    assert not re.search("nan|inf ", process.stdout)


# -- the terminal ---------------------------------------------------------------------------------


def rows_of(text):
    """The cells of each row of the table of models and laws, by its name."""
    table = next(block for block in text.split("\n\n") if block.startswith("Torque, "))
    return {line.split()[0]: line.split() for line in table.splitlines() if line.startswith("    ")}


def test_the_table_holds_the_numbers(paper, found):
    text = terminal.text(sheet(paper, found))
    table = next(block for block in sheet(paper, found).of_kind(Table) if block.name == "models")
    assert sum(any(row[1:]) for row in table.rows) == len(found.rows)
    rows = rows_of(text)
    corrected = next(row for row in found.models if row.candidate.name == "corrected")
    assert rows["corrected"][1] == f"{corrected.torque:.4g}"
    assert rows["corrected"][2] == f"{corrected.change:+.1%}"
    assert rows["reference"][2] == "case"
    # rubbing and braking in one column
    parts = [float(part) for part in rows["corrected"][3 : 3 + len(MECHANISMS) - 1]]
    assert sum(parts) == pytest.approx(corrected.torque, rel=3e-3)
    efficiencies = corrected.result.efficiency, corrected.result.back_driving_efficiency
    assert rows["corrected"][-2:] == [f"{float(efficiency):.4g}" for efficiency in efficiencies]


def test_rules_of_one_line_stand_beside_the_models(example, found, ballscrew):
    """By hand at the paper's screw: η = 0.9 costs a ninth of the ideal torque, and no rule knows its drag."""
    rules = {rule.name: rule for rule in found.rules}
    ideal = float(found.case.result.ideal_torque)
    assert rules["constant-efficiency"].screw_torque == pytest.approx(ideal / 9, rel=1e-12)
    assert rules["constant-efficiency"].efficiency == pytest.approx(0.9, rel=1e-12)
    assert math.isnan(rules["jis"].screw_torque)
    assert math.isnan(found.drag_torque)
    assert all(math.isnan(rule.drag_torque) for rule in found.rules)
    text = ballscrew("compare", example, "--model", "reference").stdout
    line = next(line for line in text.splitlines() if line.startswith("  constant efficiency 0.9"))
    assert line.split()[-4:] == [f"{rules['constant-efficiency'].change:+.1%}", "0.9", "–", "–"]
    assert "JIS B 1192, drag of the preload: 0.05" in text


# -- the picture ----------------------------------------------------------------------------------


def test_picture(example, found, tmp_path, ballscrew):
    path = tmp_path / "spread.svg"
    process = ballscrew("compare", example, "--model", "reference", "--to", path)
    assert process.returncode == 0, process.stderr
    assert process.stdout.splitlines()[-1] == f"{path}: {len(found.rows)} models and laws"
    assert list(tmp_path.iterdir()) == [path]
    first = path.read_bytes()
    assert "friction torque on the screw" in words_of(path)
    again = ballscrew("compare", example, "--model", "reference", "--json", "--to", path)
    assert document_of(again)["case"]["name"] == "reference"
    assert again.stderr.startswith(f"{path}: ")
    assert path.read_bytes() == first


def test_colours_tell_all_mechanisms_apart():
    assert set(charts.MECHANISM_COLOURS) == set(MECHANISMS)
    assert len(set(charts.MECHANISM_COLOURS.values())) == len(MECHANISMS)
