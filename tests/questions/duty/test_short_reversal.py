"""Strokes shorter than the travel in which friction comes back."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.cases.case_files import case_file
from ballscrew.physics.moving_balls.friction_states import SlipElement, gms_torque, work_share
from ballscrew.questions.duty import compute
from ballscrew.questions.duty.parts import strokes
from ballscrew.questions.duty.verdicts import warnings

ELEMENTS = (SlipElement(stiffness=400.0, slip_torque=0.2), SlipElement(stiffness=5.0, slip_torque=0.5))
AT_ONCE = 0.3


def report(example, stroke, *changes):
    """The duty of the feed axis over a stroke to and fro, m, slowly."""
    case = case_file.load(example.parent / "feed_axis.toml", changes)
    motion = Trapezoid(stroke=stroke, speed=2e-3, acceleration=1.0)
    return compute.duty(dataclasses.replace(case, motion=motion))


def said(found):
    return [record for record in warnings(found) if record.id == "duty.short_reversal"]


@pytest.mark.parametrize("stroke", [1e-4, 1e-3, 1.5e-3, 0.01, 0.1, 0.25, 1.0, 30.0])
def test_the_work_is_the_area_within_the_loop_of_gms_torque(stroke):
    ends = [end for one in ELEMENTS if (end := 2 * one.slip_torque / one.stiffness) < stroke]
    way = np.unique([0.0, *ends, *(stroke - end for end in ends), stroke])  # between these all is straight
    loop = np.concatenate([way, way[-2::-1], way[1:], way[-2::-1]])
    torque = gms_torque(ELEMENTS, loop)
    last = slice(2 * (way.size - 1), None)  # the second time, when the loop has closed
    work = np.trapezoid(torque[last], loop[last]) + AT_ONCE * 2 * stroke
    steady = (AT_ONCE + 0.7) * 2 * stroke
    assert work_share(ELEMENTS, stroke, at_once=AT_ONCE) == pytest.approx(work / steady, rel=1e-12)


def test_the_work_goes_from_what_is_at_once_to_all():
    shares = [work_share(ELEMENTS, one, at_once=AT_ONCE) for one in (1e-6, 0.1, 0.3, 1e6)]
    assert shares == sorted(shares)
    assert shares[0] == pytest.approx(AT_ONCE)
    assert shares[-1] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("stroke", [0.0, -1.0, math.nan])
def test_no_stroke_is_refused(stroke):
    with pytest.raises(bs.InputError, match=r"work_share.stroke: must be above zero"):
        work_share(ELEMENTS, stroke)


def test_strokes_are_those_of_the_motion(example):
    found = report(example, 1e-4)
    ways = strokes(found.duty, float(found.case.screw.lead))
    assert [one.length for one in ways] == pytest.approx([1e-4, 1e-4], rel=1e-9)
    assert ways[0].screw_speed == pytest.approx(-ways[1].screw_speed, rel=1e-9)


@pytest.mark.slow
def test_a_short_stroke_is_told_with_its_share_of_the_work(example):
    found = report(example, 5e-5)
    short = found.short_reversal
    (record,) = said(found)
    assert record.value == pytest.approx(5e-5, rel=1e-9)
    assert record.limit == short.back > short.stroke
    assert 0.05 < short.work_share < 0.95
    assert "by a hypothesis" in record.text
    shorter = report(example, 2e-5).short_reversal
    assert shorter.work_share < short.work_share


@pytest.mark.slow
def test_a_long_stroke_and_a_model_without_the_curve_say_nothing(example):
    assert said(report(example, 0.6)) == []
    assert said(report(example, 2e-3)) == []  # computed, and back within it
    assert said(report(example, 5e-5, "model.name=corrected")) == []
