"""The rules of makers beside a preloaded nut: whose is first, and what stands beside a vendor's rows."""

import dataclasses

import pytest

from ballscrew.cases.case_files import case_file, descriptions
from ballscrew.cases.case_files.case import NO_ORIGINS
from ballscrew.cases.case_files.named_calibration import by_rules, subject_of
from ballscrew.questions.run import compute
from ballscrew.questions.run.compute import run
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "catalogue_screw.toml"  # a row of Rexroth's catalogue


@pytest.fixture(scope="module")
def case():
    return case_file.load(EXAMPLE)


def of_make(case, make):
    """The case with the make of its row changed; None has no row."""
    row = None if make is None else dataclasses.replace(case.origins.row, make=make)
    return dataclasses.replace(case, origins=dataclasses.replace(case.origins, row=row))


@pytest.mark.parametrize(("make", "first"), [("THK", "jis"), ("HIWIN", "hiwin"), ("Rexroth", "rexroth")])
def test_the_rule_of_the_make_is_first(case, make, first):
    found = by_rules(of_make(case, make))
    assert [one.is_own for one in found] == [True, False, False]
    assert found[0].rule.name == first
    assert {one.rule.name for one in found} == {"jis", "hiwin", "rexroth"}


@pytest.mark.parametrize("make", ["", "Kuroda", None])
def test_no_rule_is_that_of_an_unknown_make(case, make):
    assert not any(one.is_own for one in by_rules(of_make(case, make)))


def of_own_rule(found):
    """The verdicts on the rule of the nut's own maker."""
    return [one for one in found.verdicts if one.id == "verdict.rule_of_maker"]


def test_without_preload_there_is_no_rule():
    slack = case_file.load(EXAMPLE, ["nut.preload=0 N"])
    assert by_rules(slack) == ()
    found = run(slack)
    assert compute.messages(found.case, found.nut) == []
    assert of_own_rule(found) == []


def test_the_nominal_diameter_is_that_of_the_row(case):
    """Without a row the pitch circle stands for it."""
    wide = case_file.load(EXAMPLE, ["screw.pitch_circle_diameter=41.75 mm"])
    assert subject_of(wide)[:2] == (0.040, pytest.approx(0.04175))
    assert subject_of(dataclasses.replace(wide, origins=NO_ORIGINS))[0] == pytest.approx(0.04175)
    assert subject_of(case).oversize_balls is False
    assert subject_of(case_file.load(EXAMPLE, ["nut.type=oversize-balls"])).oversize_balls is True


def said(case):
    """What is said of the rows of a vendor that are like the nut."""
    (found,) = [text for text in descriptions.assumptions(case) if "model / vendor" in text]
    return found


def test_rows_of_another_maker_are_called_so(case):
    rules = {one.rule.label: one.text for one in by_rules(case)}
    assert rules["Rexroth"] == "0.8075 N m by Rexroth"  # 0.004 x 5047 N x 40 mm
    own, other, unknown = (said(of_make(case, make)) for make in ("Rexroth", "THK", ""))
    assert "these are rows" not in own
    assert other.startswith(f"{own}; these are rows of Rexroth, and this nut is of THK: ")
    assert unknown.startswith(f"{own}; these are rows of Rexroth, and the make of this nut is not known: ")
    for text in (other, unknown):
        assert all(one in text for one in rules.values())


def test_the_rules_contradict_each_other_by_their_own_ends(case):
    found = run(case)
    torques = [one.torque for one in by_rules(case)]
    line, contradiction = compute.messages(found.case, found.nut)
    assert f"by a factor of {max(torques) / min(torques):.2f}" in contradiction
    assert line.startswith(f"drag torque without seals {found.nut.drag_of_balls:.4g} N m; by the rules of makers: ")
    assert f": Rexroth, its maker, {torques[0]:.4g} N m (model / rule " in line
    for torque in torques:
        assert f"{torque:.4g} N m (model / rule {found.nut.drag_of_balls / torque:.2f})" in line


@pytest.mark.parametrize(("share", "told"), [(1.3, True), (1.24, False), (1.0, False), (0.81, False), (0.79, True)])
def test_a_verdict_where_the_model_is_far_from_the_maker(case, share, told):
    """Told outside 0.8 to 1.25 of the rule."""
    found = run(case)
    torque = share * by_rules(case)[0].torque
    nut = dataclasses.replace(found.nut, preload_drag=torque, idle_losses={})
    records = of_own_rule(dataclasses.replace(found, nut=nut))
    assert [(one.id, one.severity) for one in records] == [("verdict.rule_of_maker", "info")] * told
    assert [one.value for one in records] == pytest.approx([share] * told)
    assert of_own_rule(dataclasses.replace(found, case=of_make(found.case, "Kuroda"), nut=nut)) == []
