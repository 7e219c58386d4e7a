"""The table of models handed over: the steps in the page are those of the program."""

import pytest

import ballscrew as bs
from ballscrew.exports.hand_over import export_job
from support.commands import ROOT

PAGE = ROOT / "docs" / "howto" / "hand_over.md"
NUTS = {"row of balls": bs.SingleNut(), "single": bs.SingleNut(angle_under_load=True)}


def steps_of_page():
    """Steps by model and nut."""
    _, _, table = PAGE.read_text(encoding="utf-8").partition("| model | nut | steps |")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:] if line.startswith("|")]
    return {(model, nut): int(steps.replace(",", "")) for model, nut, steps, *_ in rows}


@pytest.mark.parametrize("preset", ["olaru2005", "corrected", "reference"])
@pytest.mark.parametrize("nut", NUTS)
def test_steps_are_those_of_the_program(preset, nut):
    screw = bs.catalogue()["rexroth-16x5x3-4-double"].screw(nut=NUTS[nut])
    oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
    made = export_job(getattr(bs.FrictionModel, preset)(), screw, oil, "c")
    assert len(made.program.steps) == steps_of_page()[preset, nut]
