"""``ballscrew run --band``: words, JSON, pictures, bad input."""

import math

import pytest
from matplotlib.text import Text

from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.engine.uncertainty.bands import Interval, OutputBand
from ballscrew.faces.sheets import pictures
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.rolling import biboulet_houpert_rolling
from ballscrew.physics.laws.traits import LawTraits, traits_of
from ballscrew.questions.band import answer, compute
from ballscrew.questions.band.sheet import sheet
from ballscrew.questions.compare.compute import candidates
from ballscrew.questions.shared import charts
from support.processes import document_of


@pytest.fixture
def drive(example):
    return example.with_name("feed_drive.toml")


def output_band(value, both, inputs, laws, median=1.0):
    return OutputBand(value, median, Interval(*both), Interval(*inputs), Interval(*laws), 0.5, 0.0)


@pytest.mark.parametrize(
    ("torque", "ids", "used"),
    [
        # other laws only widen it
        (output_band(1.0, (0.7, 1.6), (0.8, 1.5), (0.9, 1.1)), [], []),
        (output_band(1.0, (0.7, 1.4), (0.8, 1.5), (0.9, 1.1)), ["band.laws_lower_it"], [1.5]),
        (output_band(1.0, (0.9, 1.6), (0.8, 1.5), (0.9, 1.1)), ["band.laws_raise_it"], [0.8]),
        (output_band(1.2, (0.7, 1.6), (0.8, 1.5), (0.9, 1.1)), ["band.above_laws"], [1.0]),
        (output_band(0.8, (0.7, 1.6), (0.8, 1.5), (0.9, 1.1)), ["band.below_laws"], [1.0]),
        (output_band(1.2, (0.7, 1.4), (0.8, 1.5), (0.9, 1.1)), ["band.laws_lower_it", "band.above_laws"], [1.5, 1.0]),
        # what is written alike is the same
        (output_band(1.10001, (0.7, 1.49999), (0.8, 1.5), (0.9, 1.1)), [], []),
        (output_band(1.2, (0.7, 1.4), (0.8, math.nan), (0.9, 1.1)), [], []),
    ],
)
def test_where_the_laws_pull_the_band_one_line_says_which_number_to_use(torque, ids, used):
    found = answer.beside_laws(torque, quantities_of(FrictionResult)["screw_torque"])
    assert [record.id for record in found] == ids
    assert [record.value for record in found] == used
    assert all(f"{value:.3g} N m" in record.text for value, record in zip(used, found, strict=True))


def test_a_line_for_a_brake_names_the_end_for_a_motor_too():
    torque = output_band(1.0, (0.9, 1.6), (0.8, 1.5), (0.9, 1.1))
    (record,) = answer.beside_laws(torque, quantities_of(FrictionResult)["screw_torque"])
    assert record.text.endswith("for a brake take 0.8 N m, for a motor 1.6 N m")


def test_only_given(drive, ballscrew):
    given = ("--set", "screw.screw_conformity=0.54 ± 0.01", "--only-given", "--samples", "256", "--json")
    found = document_of(ballscrew("run", drive, "--band", *given))["band"]
    assert list(found["inputs"]) == ["screw_conformity"]
    assert found["inputs"]["screw_conformity"]["source"] == "given"
    nothing = document_of(ballscrew("run", drive, "--band", *given[2:]))["band"]
    assert nothing["inputs"] == {}
    assert nothing["screw_torque"]["parameters"] == dict.fromkeys(("low", "high"), nothing["screw_torque"]["value"])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("operation.axial_load=0 N", "no band: without load there is no friction torque"),
        ("operation.screw_speed=0 rpm", "self-locking in none of the samples"),
        ("operation.axial_load=1e-3 N", "of the samples lie outside the model's validity"),
    ],
)
def test_limits_in_words(setting, words, drive, ballscrew):
    process = ballscrew("run", drive, "--band", "--samples", "256", "--set", setting)
    assert process.returncode == 0, process.stderr
    assert words in process.stdout
    assert process.stderr == ""
    document_of(ballscrew("run", drive, "--band", "--samples", "256", "--set", setting, "--json"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "axis"),
    [
        ([], "speed of the screw [rpm]"),
        (["operation.screw_speed=0 rpm"], "axial load on the nut [N]"),
        (["operation.screw_speed=600 ± 50 rpm"], "speed of the screw [rpm]"),
    ],
)
def test_what_a_picture_says(settings, axis, drive):
    case = case_file.load(drive, settings)
    options = compute.BandOptions(samples=64)
    with charts.house_style():
        report = compute.band(case, options)
        figure = pictures.picture(sheet(case, report, compute.curve(case, report, options)))
        figure.draw_without_rendering()
    left, right = figure.axes
    assert left.get_xlabel() == axis
    assert "N m" in left.get_ylabel()
    labels = [label.get_text() for label in right.get_yticklabels()]
    assert labels[:3] == ["inputs and laws", "inputs alone", "laws alone"]
    assert "rolling: houpert" in labels
    caption = " ".join(text.get_text().replace("\n", " ") for text in figure.findobj(Text))
    assert "75 loaded balls" in caption
    assert "64 samples of" in caption
    assert ("the screw speed is exact" in caption) == ("50 rpm" in str(settings))
    assert all(math.isfinite(x) for x in (*left.get_xlim(), *left.get_ylim(), *right.get_xlim()))


#: The laws that every default band of the reference model exchanges; the numbers of the documentation rest on them.
ENSEMBLE = {
    ("film", "hamrock-dowson-central"),
    ("friction", "zhou-hoeprich"),
    ("friction", "load-sharing"),
    ("friction", "balan"),
    ("friction", "greenwood-tripp"),
    ("inlet", "flooded"),
    ("full_film", "arana"),
    ("full_film", "eyring"),
    ("full_film", "limiting-shear"),
    ("rolling", "olaru"),
    ("rolling", "houpert"),
    ("rolling", "aihara"),
    ("elastic_resistance", "hysteresis"),
}


def a_new_law(conditions):
    return 2 * biboulet_houpert_rolling(conditions)


def test_a_name_for_a_law_moves_no_default_band(drive, monkeypatch):
    """The table of names is no ensemble: a law is an alternative where it says so itself."""
    case = case_file.load(drive)
    before = compute.alternatives(case)
    monkeypatch.setitem(LAWS["rolling"], "new", a_new_law)
    assert ("rolling", "new") in {(law.slot, law.name) for law in candidates(case)[1]}
    assert [(law.slot, law.name) for law in compute.alternatives(case)] == [(law.slot, law.name) for law in before]
    monkeypatch.setattr(a_new_law, "traits", LawTraits(alternative=True), raising=False)
    assert ("rolling", "new") in {(law.slot, law.name) for law in compute.alternatives(case)}


def test_laws_that_only_leave_something_out_are_no_alternatives(drive):
    case = case_file.load(drive)
    names = {(law.slot, law.name) for law in compute.alternatives(case)}
    assert names == ENSEMBLE
    everything = {(law.slot, law.name) for law in candidates(case)[1]}
    assert everything >= {("slip", "curvature"), ("frame", "bearing")}
    for named in LAWS.values():
        for name, law in named.items():
            assert bool(traits_of(law).excluded) != traits_of(law).alternative, name
    with_the_papers = case_file.load(drive, ["model.slip=curvature"])
    assert ("slip", "ellipse") in {(law.slot, law.name) for law in compute.alternatives(with_the_papers)}


def test_a_calibration_is_drawn_with_its_correlation(drive):
    case = case_file.load(drive, ["model.calibration=rexroth-2006"])
    joint = joint_of(case, all_of(case))
    assert joint is not None
    assert joint.covariance[0, 1] < 0
    slots = {law.slot for law in compute.alternatives(case)}
    assert "rolling" in slots
    assert not slots & {"friction", "ball_force"}
    plain = case_file.load(drive)
    assert joint_of(plain, all_of(plain)) is None


FIT = """
[model]
friction.boundary_friction_coefficient = "0.11 ± 0.00392"

[calibration]
numbers = ["friction.boundary_friction_coefficient", "viscosity"]
values = [0.11, 0.09]
covariance = [[4e-6, -3.6e-6], [-3.6e-6, 4e-6]]
"""


def fitted(example, tmp_path, text=FIT):
    path = tmp_path / "fitted.toml"
    original = example.read_text(encoding="utf-8").partition("[model]")[0]
    path.write_text(original.replace('"0.1 Pa s"', '"0.09 Pa s ± 0.00392 Pa s"') + text, encoding="utf-8")
    return path


def test_a_fit_is_drawn_with_its_correlation(example, tmp_path, ballscrew):
    """Opposite errors of two numbers that both raise the torque: the band is narrower than without the table."""
    path = fitted(example, tmp_path)
    joint = joint_of(case_file.load(path), all_of(case_file.load(path)))
    assert joint.names == ("friction.boundary_friction_coefficient", "viscosity")
    alone = fitted(example, tmp_path, FIT.partition("[calibration]")[0])
    case = case_file.load(alone)
    options = compute.BandOptions(samples=1024, only_given=True)
    independent = compute.band(case, options).band["screw_torque"].parameters
    path = fitted(example, tmp_path)
    found = compute.band(case_file.load(path), options).band["screw_torque"].parameters
    assert found.high - found.low < 0.9 * (independent.high - independent.low)
    assert "friction" not in {law.slot for law in compute.alternatives(case_file.load(path))}
    assert ballscrew("run", path).returncode == 0


def test_a_number_changed_after_the_fit_is_no_part_of_it(example, tmp_path):
    case = case_file.load(fitted(example, tmp_path), ["lubricant.viscosity=0.2 Pa s ± 10 %"])
    assert joint_of(case, all_of(case)).names == ("friction.boundary_friction_coefficient",)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('calibration = "mine"\n', "calibration: must be a table (mine)"),
        ('[calibration]\nnumbers = ["viscosity"]\n', "calibration: is not as a fit writes it"),
    ],
)
def test_a_fit_that_is_none(text, expected, example, tmp_path, ballscrew):
    path = fitted(example, tmp_path, "")
    path.write_text(
        text + path.read_text(encoding="utf-8") if text.startswith("cal") else path.read_text(encoding="utf-8") + text,
        encoding="utf-8",
    )
    process = ballscrew("run", path, "--band", "--samples", "8")
    assert (process.returncode, process.stdout) == (2, "")
    assert process.stderr.startswith(expected)


def test_a_law_with_large_numbers_has_a_band(drive, ballscrew):
    """Its asperities are 1e10 in a square metre: the least number there is, over that, is none."""
    process = ballscrew("run", drive, "--band", "--json", "--samples", "64", "--set", "model.friction=greenwood-tripp")
    assert document_of(process)["band"]["inputs"]["friction.asperity_density"]["source"]
