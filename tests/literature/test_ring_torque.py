"""Truth: the published torques of three balls between grooved rings, by two rolling laws."""

import json
from pathlib import Path

import pytest

from ballscrew.evidence.validation.rows import GROOVE_RADIUS, RING_RADIUS, ring_torque
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.rolling import biboulet_houpert_rolling

RING = json.loads((Path(__file__).parents[1] / "data" / "contact_points.json").read_text(encoding="utf-8"))[
    "thrust_ring"
]
RPM = 0.10471975511965977


@pytest.mark.parametrize("series", RING["series"], ids=lambda series: f"{series['ball_diameter'] * 1e3} mm")
@pytest.mark.parametrize(
    ("model", "law", "rel"),
    [
        (FrictionModel.reference(), "blended", 2e-3),
        # the coefficient of the oil is not given; (1) hardly depends on it
        (FrictionModel.olaru2005(), "Olaru2005 (1)", 7e-3),
    ],
)
def test_torque_of_the_rings(series, model, law, rel):
    assert (RING["pitch_radius"], RING["groove_radius"]) == (RING_RADIUS, GROOVE_RADIUS)
    for rpm, published in zip(RING["rpm"], series[law], strict=True):
        torque = ring_torque(model, series["ball_diameter"], series["contact_load"], RING["viscosity"], rpm * RPM)
        assert torque == pytest.approx(published, rel=rel)


def test_the_reference_rolls_by_the_law_in_question():
    assert FrictionModel.reference().rolling is biboulet_houpert_rolling
