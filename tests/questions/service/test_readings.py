"""Questions of a service as they are asked, torques as they are written, and probabilities in words."""

import math

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.questions.service import answer
from ballscrew.questions.service.compute import probability


@pytest.mark.parametrize(
    ("share", "text"),
    [
        (0.9995, "more than 99.9%"),
        (0.995, "99.5%"),
        (0.5, "50%"),
        (0.02, "2%"),
        (0.005, "0.5%"),
        (0.0005, "less than 0.1%"),
    ],
)
def test_probabilities_in_words(share, text):
    assert probability(share) == text


def written(**given):
    return {"torque": None, "speed": None, "temperature": None, **given}


@pytest.mark.parametrize(
    ("logs", "given", "where"),
    [
        (1, {}, []), (2, {}, []), (0, {}, ["WORN"]), (3, {}, ["WORN"]),
        (1, {"speed": "1 rpm", "temperature": "9 degC"}, ["--speed", "--temperature"]),
        (0, {"torque": "1 N m", "speed": "1 rpm"}, []), (0, {"torque": "1 N m"}, ["--speed"]),
        (1, {"torque": "1 N m", "speed": "1 rpm"}, ["--torque"]),
    ],
)  # fmt: skip
def test_a_question_is_one(logs, given, where, tmp_path):
    asked = [tmp_path / str(i) for i in range(logs)], True, written(**given)
    if not where:
        answer.check_question(*asked)
    else:
        with pytest.raises(InputError) as raised:
            answer.check_question(*asked)
        assert [fault.where for fault in raised.value.faults] == where


@pytest.mark.parametrize(
    ("torque", "value", "deviation"),
    [("0.4 N m", 0.4, 0.0), ("400 N mm", 0.4, 0.0), ("0.4 ± 0.0392 N m", 0.4, 0.02), ("0.4 N m ± 10 %", 0.4, 0.0204)],
)
def test_a_torque_with_its_interval(torque, value, deviation):
    found = answer.reading(written(torque=torque, speed="60 rpm", temperature="30 degC"))
    assert (found.torque, found.screw_speed) == (pytest.approx(value), pytest.approx(2 * math.pi))
    assert found.torque_deviation == pytest.approx(deviation, rel=1e-3, abs=1e-12)
    assert found.temperature == pytest.approx(303.15)
