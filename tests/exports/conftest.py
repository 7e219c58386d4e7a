"""Models handed over, as targets take them."""

import pytest

import ballscrew as bs
from ballscrew.exports import hand_over

OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)


@pytest.fixture(scope="session")
def handed_over():
    """A function: the model handed over with a nut, as the function of a target gets it."""

    def handed(model, nut, oil=OIL, to="c", **asked):
        screw = bs.catalogue()["rexroth-16x5x3-4-double"].screw(nut=nut)
        return hand_over.export_job(model, screw, oil, to, **asked)

    return handed
