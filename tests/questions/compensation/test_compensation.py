"""Compensations of positions: their numbers, and the forms of the manuals' examples."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Table
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.questions.compensation.answer import document, isg, position_compensation, sheet, sinumerik
from ballscrew.questions.warm_up.compute import warmed_up
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "warm_up.toml"
LENGTH, CELL, CURVATURE = 1.0, 0.02, 1e-4
#: SINUMERIK Function Manual Extended Functions, 03/2013, 6FC5397-1BP40-3BA1, 4.4.2.3; without its comments.
SINUMERIK = """\
%_N_AX_EEC_INI
CHANDATA(1)
$AA_ENC_COMP[0,0,X1]=0.003
$AA_ENC_COMP[0,1,X1]=0.01
$AA_ENC_COMP[0,2,X1]=0.012
$AA_ENC_COMP[0,800,X1]=-0.0
$AA_ENC_COMP_STEP[0,X1]=1.0
$AA_ENC_COMP_MIN[0,X1]=-200.0
$AA_ENC_COMP_MAX[0,X1]=600.0
$AA_ENC_COMP_IS_MODULO[0,X1]=0
M17
"""
#: infosys.beckhoff.com, tf5200_axis_compensation_parameters, Example of a compensation value list; parts of it.
ISG = """\
kopf.log_achs_name                   Y-ACHSE
kw.ssfk.interval                     0
kw.ssfk.kw_startpos                 -200000
kw.ssfk.kw_nr_max                    140
kw.ssfk.unit                         1
kw.ssfk.bilateral                    1
kw.ssfk.table[0].setpoint           -200000
kw.ssfk.table[0].pos                 0
kw.ssfk.table[0].neg                 0
"""


@pytest.fixture
def report():
    """A shaft that grows by c x² at the place x."""

    def table(step):
        places = np.linspace(0.0, LENGTH, round(LENGTH / step) + 1)
        return places, CURVATURE * places**2

    return SimpleNamespace(
        warm_up=SimpleNamespace(
            compensation_table=table,
            network=SimpleNamespace(shaft=SimpleNamespace(length=LENGTH, cell=CELL)),
            stopped=None,
        )
    )


def test_chords_of_a_parabola_miss_what_they_must(report):
    found = position_compensation(report, 4.0, zero=0.2, step=0.05)
    assert found.positions == pytest.approx(np.arange(-0.2, 0.81, 0.05))
    assert found.errors == pytest.approx(CURVATURE * (found.positions + 0.2) ** 2)
    assert found.worst_error == pytest.approx(CURVATURE * 0.025**2, rel=1e-6)


def test_what_lines_miss_is_told_only_between_cells(report):
    """Within a cell the computed growth is straight, so that nothing is known of what lines miss there."""
    wide, fine = (position_compensation(report, 4.0, step=step) for step in (0.1, 0.02))
    assert wide.missed == "straight lines between them miss up to 0.25 µm of the computed growth, whose cells are 20 mm"
    assert fine.missed.startswith("the growth is computed in cells of 20 mm; what straight lines miss within them is")


def test_nothing_is_compensated_at_the_reference(report):
    found = position_compensation(report, 4.0, zero=0.2, step=0.05, reference=0.3)
    assert np.interp(0.3, found.positions, found.errors) == pytest.approx(0.0, abs=1e-15)
    assert found.errors[-1] == pytest.approx(CURVATURE * (1.0 - 0.25))


def test_an_axis_that_is_turned_round_sees_the_same_places_the_other_way(report):
    """A nut that is farther along where positions grow away from the bearing is short where they grow towards it."""
    away = position_compensation(report, 4.0, zero=0.2, step=0.05, reference=0.3)
    towards = position_compensation(report, 4.0, zero=0.2, direction="towards", step=0.05, reference=-0.3)
    assert towards.positions == pytest.approx(-away.positions[::-1])
    assert towards.errors == pytest.approx(-away.errors[::-1])
    assert np.all(np.diff(towards.positions) > 0)
    for found, words in ((away, "away from"), (towards, "towards")):
        for written in (sinumerik(found, "X1"), isg(found, "X1")):
            assert f"positions grow {words} the fixed bearing, zero is 200 mm from it" in written


def form(text):
    """Lines without comments, with each number replaced by #."""
    lines = [line.partition(" ;")[0] for line in text.splitlines() if not line.startswith("# ")]
    return [re.sub(r"(?<![\w.])-?\d+(\.\d+)?(?![\w.])", "#", line) for line in lines]


def test_sinumerik_has_the_form_of_its_manual(report):
    found = position_compensation(report, 4.0, zero=0.2, step=0.05)
    text = sinumerik(found, "X1")
    assert list(dict.fromkeys(form(text))) == list(dict.fromkeys(form(SINUMERIK)))
    values = [float(v) for v in re.findall(r"COMP\[0,\d+,X1\]=(\S+)", text)]
    assert values == pytest.approx(1e3 * found.errors, abs=5e-6)
    assert "$AA_ENC_COMP_STEP[0,X1]=50.000000" in text
    assert values[-1] > 0  # a shaft that grew is moved back: positive moves the axis in the negative direction


def test_isg_has_the_form_of_its_manual(report):
    found = position_compensation(report, 4.0, zero=0.2, step=0.05)
    rows = [line.split() for line in isg(found, "Y").splitlines() if not line.startswith("# ")]
    example = [line.split()[0] for line in ISG.splitlines()]
    assert list(dict.fromkeys(re.sub(r"\[\d+\]", "[0]", name) for name, _ in rows)) == example
    values = dict(rows)
    assert values["kw.ssfk.kw_startpos"] == values["kw.ssfk.table[0].setpoint"] == "-2000000"
    assert int(values["kw.ssfk.table[20].pos"]) == round(1e7 * found.errors[20]) == int(values["kw.ssfk.table[20].neg"])


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        ({"step": 0.001}, "--step: makes more than 200 points"),
        ({"step": -1.0}, "--step: makes more than 200 points, or less than two"),
        ({"reference": 2.0}, "--reference: is beyond the shaft (2000 mm) · it is 0 mm to 1000 mm"),
        (
            {"reference": 0.5, "zero": 0.2, "direction": "towards"},
            "--reference: is beyond the shaft (500 mm) · it is -800 mm to 200 mm",
        ),
        ({"zero": -0.5}, "--zero: is beyond the shaft (-500 mm) · its place is 0 mm to 1000 mm from"),
        ({"direction": "left"}, "--direction: unknown direction (left) · known: away, towards"),
    ],
)
def test_faults_name_option_and_remedy(report, asked, expected):
    with pytest.raises(bs.InputError) as fault:
        position_compensation(report, 4.0, **asked)
    assert str(fault.value).startswith(expected)


def test_a_state_that_was_never_reached_has_no_table(report):
    report.warm_up.stopped = 0.7049 * 3600
    with pytest.raises(bs.InputError) as fault:
        position_compensation(report, 4.0)
    assert str(fault.value).startswith("--hours: the warm-up stops after 0.70 h: beyond it")
    assert "(4) · write --hours 0.7 at most, or look at ballscrew warm-up" in str(fault.value)


def test_sheet_and_document_tell_of_the_warm_up():
    report = warmed_up(case_file.load(EXAMPLE, ["model.name=olaru2005"], moves=True), 0.01)
    found = position_compensation(report, 0.01)
    made = sheet(found, report)
    told, said = plain(document(found, report)), " ".join(terminal.text(made).split())
    assert told["assumed"] == list(report.assumed)
    assert told["verdicts"][0]["id"] == "verdict.equilibrium"
    assert told["results"]["error"] == found.errors.tolist()
    (numbers,) = made.of_kind(Table)
    assert [cell.value for cell in numbers.rows[0][1:]] == [found.positions[0], found.positions[-1]]
    assert [cell.value for cell in numbers.rows[1][1:]] == [found.errors.min(), found.errors.max()]
    for words in (*report.assumed, told["verdicts"][0]["text"], found.missed, found.mounting):
        assert words in said


@pytest.mark.parametrize(("direction", "sign"), [("away", 1.0), ("towards", -1.0)])
def test_both_lists_are_the_growth_of_another_case(direction, sign):
    """At places between their points too, to what they say that they miss and the digits that they have."""
    case = case_file.load(
        EXAMPLE, ["model.name=olaru2005", "surroundings.ambient=12 degC", "screw.lead=8 mm"], moves=True
    )
    report = warmed_up(case, 0.3)
    zero, step = 0.15, 0.04
    found = position_compensation(report, 0.3, zero=zero, step=step, direction=direction, reference=0.0)
    places, growth = report.warm_up.compensation_table(float(report.warm_up.network.shaft.cell) / 4)
    at = np.random.default_rng(8).uniform(found.positions[0], found.positions[-1], 500)
    wanted = sign * (np.interp(zero + sign * at, places, growth) - np.interp(zero, places, growth))
    assert np.ptp(wanted) > 1e-6
    text = sinumerik(found, "Z1")
    first, apart = (float(re.search(rf"COMP_{name}\[0,Z1\]=(\S+)", text)[1]) for name in ("MIN", "STEP"))
    values = np.array([float(v) for v in re.findall(r"COMP\[0,\d+,Z1\]=(\S+)", text)])
    read = 1e-3 * np.interp(1e3 * at, first + apart * np.arange(values.size), values)
    assert np.max(np.abs(read - wanted)) <= found.worst_error + 1e-8
    held = dict(re.findall(r"(?m)^kw\.ssfk\.table(\S+) +(\S+)$", isg(found, "Z")))
    count = len(found.positions)
    points, ahead, back = ([float(held[f"[{k}].{n}"]) for k in range(count)] for n in ("setpoint", "pos", "neg"))
    assert ahead == back
    assert np.max(np.abs(1e-7 * np.interp(1e7 * at, points, ahead) - wanted)) <= found.worst_error + 1.5e-7
