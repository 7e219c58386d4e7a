"""What is written almost right: read where it can only mean one thing, else refused with what was probably meant."""

import dataclasses

import pytest

import ballscrew as bs
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import case_file, lubricants
from ballscrew.physics.laws.nut_losses import Seals
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.sweep import compute
from support.commands import ROOT

FEED = ROOT / "examples" / "feed_drive.toml"
TEXT = FEED.read_text(encoding="utf-8")
SCREW = catalogue()["rexroth-40x10x6-6-double"].screw()
MODEL, OIL = bs.FrictionModel.reference(), bs.Lubricant.from_grade("ISO VG 100")


def refused(*settings, text=TEXT, tmp_path=None):
    path = FEED
    if text is not TEXT:
        path = tmp_path / "case.toml"
        path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as raised:
        case_file.load(path, settings)
    return " | ".join(raised.value.lines())


@pytest.mark.parametrize(
    ("text", "value"), [("0.4 Nm", 0.4), ("400 Nmm", 0.4), ("40 Ncm", 0.4), ("0,4Nm", 0.4), ("0.4 N-m", 0.4)]
)
def test_a_torque_is_read_as_headings_have_it(text, value):
    quantity = fields_of(Seals)["seal_torque"]
    assert units.parse("", text, quantity) == pytest.approx(value, rel=1e-12)
    case = case_file.load(FEED, [f'losses.seals.seal_torque="{text}"'])
    assert case.screw.nut.losses["seals"].seal_torque == pytest.approx(value, rel=1e-12)


def test_so_is_a_torque_for_each_ampere():
    axis = FEED.parent / "vertical_axis.toml"
    assert case_file.load(axis, ['motor.torque_constant="1.7 Nm/A"']).motor.torque_constant == pytest.approx(1.7)
    assert isinstance(units.parse("", "3 Nm", fields_of(bs.DoubleNut)["preload"]), Fault)


@pytest.mark.parametrize("text", ["10-100 rpm", "10..100 rpm", "10 to 100 rpm", "10 – 100 rpm"])
def test_a_range_in_prose(text):
    with pytest.raises(InputError) as raised:
        compute.plan(case_file.load(FEED), [f"screw_speed={text}"], (), None)
    (line,) = raised.value.lines()
    assert line.endswith(f'is not start:stop:count ({text}) · write "10:100:5 rpm" for five values, ends included')


def test_a_key_or_a_table_that_is_given_twice(tmp_path):
    twice = TEXT.replace('lead = "10 mm"', 'lead = "10 mm"\nlead = "12 mm"')
    line = TEXT[: TEXT.index('lead = "10 mm"')].count("\n") + 1
    said = refused(text=twice, tmp_path=tmp_path)
    assert said.endswith(f'"lead" of [screw] is given twice (lines {line} and {line + 1}) · leave one of them out')
    said = refused(text=f"{TEXT}\n[operation]\naxial_load = '1 kN'\n", tmp_path=tmp_path)
    assert "[operation] is given twice (lines " in said
    assert said.endswith("put their keys into one")
    said = refused(text='{"screw": {"lead": "5 mm", "lead": "6 mm"}}', tmp_path=tmp_path)
    assert said.endswith("is not JSON (lead is given twice) · leave one of them out")
    # a law by name and with coefficients is another fault, and each table of a list has keys of its own
    both = f'{TEXT}\n[model]\nrolling = "houpert"\nrolling.loss_factor = 0.1\n'
    assert "a law with coefficients" in refused(text=both, tmp_path=tmp_path)


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("inlet.inlet_film_ratio=2", "inlet: unknown section · write model.inlet.inlet_film_ratio"),
        ('seals.seal_torque="0.2 N m"', "seals: unknown section · write losses.seals.seal_torque"),
        ("inlet_film_ratio=2", "(inlet_film_ratio=2) · write model.inlet.inlet_film_ratio=2"),
        ("screws.lead=2", 'did you mean "screw"?'),
    ],
)
def test_a_law_without_its_section(setting, said):
    assert said in refused(setting)


def test_the_consistency_of_a_grease():
    known = lubricants.oils()
    of_class_2 = [sheet.name for sheet in known.values() if "2" in sheet.nlgi.split("-")]
    assert [sheet.name for sheet in lubricants.chosen(known, "NLGI 2")] == of_class_2
    assert [sheet.name for sheet in lubricants.chosen(known, "arcanol nlgi-2")] == [
        n for n in of_class_2 if "Arcanol" in n
    ]
    assert {s.nlgi for s in lubricants.chosen(known, "NLGI 3")} == {"2-3", "3", "3-4"}
    assert 'consistency of a grease, and friction follows its base oil: see "ballscrew oils list NLGI 2"' in refused(
        'lubricant.grade="NLGI 2"'
    )
    with pytest.raises(InputError, match=f"greases of that consistency: {of_class_2[0]}"):
        known.named("nlgi 2")


@pytest.mark.parametrize(
    ("call", "word", "meant"),
    [
        (
            lambda: bs.BallScrew(pitch_diameter=0.04),
            "BallScrew() has no keyword 'pitch_diameter'",
            "pitch_circle_diameter",
        ),
        (lambda: dataclasses.replace(SCREW, led=0.01), "BallScrew() has no keyword 'led'", "lead"),
        (lambda: bs.DoubleNut(pre_load=3e3), "DoubleNut() has no keyword 'pre_load'", "preload"),
        (lambda: MODEL(SCREW, OIL, load=1e3, screw_speed=1.0), "__call__() has no keyword 'load'", "axial_load"),
        (lambda: MODEL(SCREW, OIL, axial_load=1e3, speed=1.0), "__call__() has no keyword 'speed'", "screw_speed"),
        (lambda: dataclasses.replace(MODEL, rollng=None), "FrictionModel() has no keyword 'rollng'", "rolling"),
    ],
)
def test_a_misspelt_keyword(call, word, meant):
    with pytest.raises(TypeError) as raised:
        call()
    assert str(raised.value).endswith(f'{word}: did you mean "{meant}"?')
