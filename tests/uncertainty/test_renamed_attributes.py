"""Old names of public attributes: they give the new ones, and warn with the new name."""

import pytest

import ballscrew as bs
from ballscrew.calibration.fit_result import Score
from ballscrew.sizing.checks import Check
from ballscrew.uncertainty.sensitivity import ExplainedVariance

RENAMED = [
    (bs.Uniform(1.0, 2.0), "telling", "characteristic_values"),
    (ExplainedVariance(("lead",), 0.5), "left", "remaining"),
    (Score("the model", 2, 0.1, 0.2), "words", "description"),
    (Score("the model", 2, 0.1, 0.2), "numbers", "parameters"),
    (Check("life", 1.0, 2.0, "1", 0.5, True, "long enough"), "passes", "holds"),
    (Check("life", 1.0, 2.0, "1", 0.5, True, "long enough"), "words", "text"),
]


@pytest.mark.parametrize(("value", "old", "new"), RENAMED, ids=[f"{type(v).__name__}.{old}" for v, old, _ in RENAMED])
def test_an_old_name_gives_the_new_one_and_warns(value, old, new):
    with pytest.warns(DeprecationWarning, match=f"{old} is deprecated: use {new}"):
        assert getattr(value, old) == getattr(value, new)


def test_an_old_method_works():
    with pytest.warns(DeprecationWarning, match="use describe"):
        assert bs.Uniform(1.0, 2.0).words("N") == "uniform from 1.0 N to 2.0 N"
