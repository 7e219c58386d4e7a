"""The band of the static page is that of the program: the same inputs, the same samples, the same ends."""

import numpy as np
import pytest

from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.uncertainty.distributions import allowed, standard_normal_quantile, standard_normal_share
from ballscrew.engine.uncertainty.monte_carlo import sobol_sequence
from ballscrew.engine.uncertainty.uncertain_value import default_uncertainties
from ballscrew.faces.page import banding, kinds
from support.bands_in_node import BandsPage, band_of_program, fan_of_program
from support.judged_in_node import case_at

pytestmark = [pytest.mark.slow, pytest.mark.implausible]

STRUCTURES = (("reference", "row"), ("reference", "double"), ("reference", "double+elastic"), ("olaru2005", "row"))
#: One whose oil is given by its viscosity, and one of a grade.
STARTS = (kinds.PAPER, "rexroth-40x10x6-6-double")
#: Relative: a module is that of the same recording, and the samples are the same.
TOLERANCE = 1e-12


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return BandsPage(tmp_path_factory.mktemp("bands"), STRUCTURES)


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("structure", STRUCTURES[:3], ids="/".join)
def test_the_ends_are_those_of_the_program(page, structure, start):
    speeds = np.linspace(2.0, 150.0, 5)
    question = page.question(start, structure, speeds)
    (found,) = page.bands([question])
    outputs = list(found["point"]["ends"])
    band = band_of_program(start, structure, question, found["point"]["count"], outputs)
    assert {"screw_torque", "drive_torque", "efficiency"} <= {*outputs}
    for name, ends in found["point"]["ends"].items():
        assert (ends["low"], ends["high"]) == pytest.approx(band[name].both, rel=TOLERANCE), name
    assert found["point"]["invalid"] == band.invalid_share
    fan = fan_of_program(start, structure, question, found["fan"]["count"])
    assert found["fan"]["lows"] == pytest.approx(fan.both[0], rel=TOLERANCE)
    assert found["fan"]["highs"] == pytest.approx(fan.both[1], rel=TOLERANCE)


def test_the_ends_do_not_depend_on_the_steps(page):
    question = page.question(kinds.PAPER, STRUCTURES[0], [10.0, 100.0])
    (few,), (many,) = (page.bands([question], step) for step in (1000.0, 0.01))
    assert few["steps"] < many["steps"]
    for kind in ("point", "fan"):
        left, right = ({**one[kind], "milliseconds": None} for one in (few, many))
        assert left == right


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"inlet.replenishment_constant": 0.0},
        {"preload": 0.0, "ball_friction_coefficient": 0.0},
        {"friction.boundary_friction_coefficient": 0.2, "ball_force.share_of_load": 0.0},
    ],
    ids=str,
)
def test_what_is_uncertain_is_as_in_the_program(page, changes):
    structure = ("reference", "double")
    question = page.question(kinds.PAPER, structure, **changes)
    (found,) = page.bands([question])
    assert found["names"] == list(uncertain_inputs.all_of(case_at(kinds.PAPER, structure, question["inputs"])))
    band = band_of_program(kinds.PAPER, structure, question, found["point"]["count"], ["screw_torque"])
    ends = found["point"]["ends"]["screw_torque"]
    assert (ends["low"], ends["high"]) == pytest.approx(band["screw_torque"].both, rel=TOLERANCE)


def test_a_model_with_numbers_that_no_module_reads_has_no_band(page):
    assert banding.uncertain_of("olaru2005", "row") == []
    assert page.bands([page.question(kinds.PAPER, ("olaru2005", "row"))]) == [{"makers": [], "steps": 0}]


def test_a_number_too_near_its_bound_has_no_band(page):
    question = page.question(kinds.PAPER, STRUCTURES[0], screw_conformity=0.9)
    assert page.bands([question]) == [{"makers": [], "steps": 0}]


SHARES = np.concatenate([sobol_sequence(1, 512)[0], 0.5 ** np.arange(1.0, 31.0), 1 - 0.5 ** np.arange(2.0, 31.0)])


@pytest.mark.parametrize("oil", ["viscosity", "grade"])
@pytest.mark.parametrize("factor", [0.8, 1.0, 1.25])
def test_values_are_drawn_as_from_the_distributions(oil, factor):
    """At a tail a rounding of the share moves the value: there they agree less."""
    case = kinds.case_of(STARTS[oil == "grade"], "reference", "double")
    known = inputs_of(case.model, case.screw, case.lubricant)
    for row in banding.uncertain_of("reference", "double"):
        if row.get("oil", oil) != oil:
            continue
        name = row["name"]
        quantity = known[name][1]
        usual = uncertain_inputs.all_of(case)[name].distribution.quantile(0.5)
        bound = row.get("above", usual - 100)
        value = bound + factor * (usual - bound)
        expected = default_uncertainties()[name].about(value, quantity.info).quantile(SHARES)
        found = banding.quantile(row["form"], SHARES, value, **row["numbers"])
        assert found == pytest.approx(np.clip(expected, *allowed(quantity.info)), rel=1e-9), name
        middle = (SHARES > 1e-3) & (SHARES < 1 - 1e-3)
        assert found[middle] == pytest.approx(expected[middle], rel=1e-13), name


def test_the_normal_distribution_is_that_of_scipy():
    assert banding._normal_quantile(SHARES) == pytest.approx(standard_normal_quantile(SHARES), rel=1e-14, abs=1e-16)
    for x in np.linspace(-9.0, -1.5, 31):
        assert banding._share_below(x) == pytest.approx(standard_normal_share(x), rel=1e-13)
    assert banding._share_below(-9.2) == banding._share_below(-40.0) == 0.0


@pytest.mark.parametrize("dimensions", [1, 9, 17])
def test_the_points_are_those_of_the_sequence(dimensions):
    numbers = banding.sobol_numbers(dimensions, 64)
    point, points = np.array(numbers["first"]), []
    for place in range(64):
        if place:
            last_bit = (place & -place).bit_length() - 1
            point = point ^ np.array([turns[last_bit] for turns in numbers["turns"]])
        points.append(point * numbers["unit"])
    assert np.array_equal(np.transpose(points), sobol_sequence(dimensions, 64, banding.SEED))
