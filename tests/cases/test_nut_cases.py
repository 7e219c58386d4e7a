"""Case files with a nut: rows, preload, bodies, deviations, losses, and what run, sweep and compare make of them."""

import csv
import dataclasses
import io
import json
import math
import tomllib

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import inputs, references
from ballscrew.cases.schema.case_schema import NUT_TABLES, json_schema, validated
from ballscrew.cases.screw_tables.nut_kinds import kind_of
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.physics.components.nut import NUTS, Bodies, Deviations
from ballscrew.physics.laws.nut_losses import LipSeals, ReturnBraking, Seals, ShearedOil, SpinUp
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.run.compute import run
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "catalogue_screw.toml"
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
RPM = 2 * math.pi / 60


def tables(**sections):
    """A case of the row; ``nut={…}`` and so on puts tables in."""
    usual = {
        "screw": {"catalogue": ROW.name},
        "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
        "operation": {"axial_load": "5 kN", "screw_speed": "600 rpm"},
    }
    return {**usual, **sections}


def friction(case, nut=None, axial_load=5000.0):
    screw = case.screw if nut is None else dataclasses.replace(case.screw, nut=nut)
    return case.model(screw, case.lubricant, axial_load=axial_load, screw_speed=600 * RPM)


def faults_of(**sections):
    with pytest.raises(InputError) as caught:
        case_file.build(tables(**sections))
    return caught.value.lines()


# -- what a case says -----------------------------------------------------------------------------


def test_a_row_is_the_screw_and_what_is_given_wins():
    case = case_file.build(tables())
    assert case.nut is None  # without a nut, everything is as it was
    assert case.origins.row is ROW
    assert case.origins.listed == {"dynamic_load_rating": 72100, "static_load_rating": 132200}
    assert (case.screw.ball_diameter, case.screw.loaded_balls) == (0.006, ROW.loaded_balls)
    given = {"catalogue": ROW.name.upper(), "screw_conformity": 0.52, "root_diameter": "34 mm"}
    changed = case_file.build(tables(screw={**given, "ball_material": {"young_modulus": "300 GPa"}}))
    assert (changed.screw.screw_conformity, changed.screw.nut_conformity) == (0.52, 0.54)
    assert changed.screw.ball_material.young_modulus == pytest.approx(300e9)
    assert changed.origins.listed["root_diameter"] == pytest.approx(0.034)
    assert inputs(case)["screw"]["catalogue"] == ROW.name


@pytest.mark.parametrize("kind", NUTS)
def test_every_kind_of_nut(kind):
    table = {"type": kind} | ({} if kind == "single" else {"preload": "3 kN"})
    case = case_file.build(tables(nut=table))
    assert type(case.nut) is NUTS[kind]
    assert kind_of(case.nut) == kind
    alone = bs.SingleNut(angle_under_load=True) if kind == "single" else NUTS[kind](3000.0)
    assert case.nut == case.screw.nut == alone
    assert run(case).friction.screw_torque == friction(case, alone).screw_torque
    assert inputs(case)["nut"]["type"] == kind


def test_a_preload_in_percent_is_of_the_dynamic_rating():
    case = case_file.build(tables(nut={"preload": "7 %"}))
    assert isinstance(case.nut, bs.DoubleNut)  # the row's kind
    assert case.nut.preload == pytest.approx(0.07 * 72100)
    assert tuple(map(str, case.origins.notes)) == (
        "preload 5.047 kN: 7 % of the dynamic load rating 72.1 kN, as listed",
    )
    given = case_file.build(
        tables(screw={"catalogue": ROW.name, "dynamic_load_rating": "50 kN"}, nut={"preload": "7 %"})
    )
    assert given.nut.preload == pytest.approx(3500)


def test_without_a_rating_it_is_that_of_the_geometry():
    drive = tomllib.loads((ROOT / "examples" / "feed_drive.toml").read_text(encoding="utf-8"))
    case = case_file.build({**drive, "nut": {"type": "double", "preload": "10%"}})
    like = bs.catalogue()["hiwin-40-20k4"]  # the same balls and as many a turn; another lead
    assert case.nut.preload == pytest.approx(0.1 * ratings_of(like).dynamic, rel=0.05)
    assert "computed from the geometry (ISO 3408-5)" in str(case.origins.notes[0])
    drive["screw"]["loaded_balls"] = 10_000
    with pytest.raises(InputError, match=r"nut\.preload: is a share of a dynamic load rating that is not known"):
        case_file.build({**drive, "nut": {"type": "double", "preload": "10 %"}})


def test_bodies_deviations_and_losses_are_those_of_python():
    case = case_file.build(
        tables(
            nut={"preload": "3 kN", "spacing": "12 mm"},
            bodies={"nut_outer_diameter": "70 mm", "same_side": False},
            deviations={"ball_diameter": "0.3 um", "lead": "1 um", "seed": 7},
            losses={"seals": {"seal_torque": "0.4 N m"}, "recirculation": {"return_force": "1 N", "returns": 3}},
        )
    )
    usual = Bodies.of(case.screw)
    bodies = Bodies(
        screw_diameter=usual.screw_diameter,
        nut_inner_diameter=usual.nut_inner_diameter,
        nut_outer_diameter=0.07,
        same_side=False,
    )
    scatter = Deviations.scattered(2 * case.screw.loaded_balls, seed=7, ball_diameter=0.3e-6, lead=1e-6)
    expected = friction(case, bs.DoubleNut(3000.0, 0.012, bodies=bodies, deviations=scatter, losses=case.nut.losses))
    found = run(case).friction
    assert found.screw_torque == pytest.approx(float(expected.screw_torque), rel=1e-12)
    assert found.loads.rigidity == pytest.approx(float(expected.loads.rigidity), rel=1e-12)
    assert found.contributions["seals"] == 0.4
    given = inputs(case)
    assert given["losses"]["recirculation"] == {"law": "force", "return_force": 1.0, "returns": 3}
    assert given["bodies"]["same_side"] is False
    expected = {"ball_diameter": pytest.approx(0.3e-6), "lead": pytest.approx(1e-6), "seed": 7, "groove": 0.0}
    assert given["deviations"] == expected


def test_losses_by_another_law_and_without_a_nut():
    case = case_file.build(tables(losses={"seals": {"law": "lips", "lip_friction": "80 N/m"}}))
    assert isinstance(case.nut, bs.SingleNut)
    assert isinstance(case.nut.losses["seals"], LipSeals)
    assert isinstance(case_file.build(tables(losses={"seals": "known"})).nut.losses["seals"], Seals)
    spheres = case_file.build(tables(losses={"churning": {"oil_share": 1}}))
    assert "SchillerNaumann1933" in references(spheres)
    assert "SchillerNaumann1933" not in references(case)


def test_losses_of_moving_balls_are_added_to_those_of_the_case():
    """Each is an input by name, and the torque is that of the case and of the three laws."""
    losses = {
        "recirculation": {"law": "braking", "return_balls": 8, "wall_factor": 20, "returns": 3},
        "sheared_oil": {"oil_share": 0.5, "oil_gap": "30 um"},
        "spin_up": {"entries": 3},
    }
    single = {"nut": {"type": "single"}}
    case, bare = case_file.build(tables(losses=losses, **single)), case_file.build(tables(**single))
    found, without = run(case).friction, run(bare).friction
    screw, speed = case.screw, float(found.screw_speed)
    laws = [
        ReturnBraking(return_balls=8, wall_factor=20.0, returns=3),
        ShearedOil(oil_share=0.5, oil_gap=30e-6),
        SpinUp(entries=3),
    ]
    expected = {name: law(screw, case.lubricant, speed) for name, law in zip(losses, laws, strict=True)}
    assert min(expected.values()) > 0
    assert {name: found.contributions[name] for name in losses} == pytest.approx(expected, rel=1e-12)
    assert found.screw_torque - without.screw_torque == pytest.approx(sum(expected.values()), rel=1e-9)
    assert "JeffreyOnishi1984" in references(case)
    assert "losses.recirculation.wall_factor" in inputs_of(case.model, screw, case.lubricant)


def test_rows_of_a_file_beside_the_case(tmp_path):
    (tmp_path / "mine.csv").write_text("name;d0 [mm];Ph [mm];Dw [mm];i\nA;40;10;6,35;4\n", encoding="utf-8")
    (tmp_path / "case.toml").write_text(
        EXAMPLE.read_text(encoding="utf-8").replace(
            'catalogue = "rexroth-40x10x6-6-double"', 'catalogue = "A"\ncatalogue_file = "mine.csv"'
        ),
        encoding="utf-8",
    )
    case = case_file.load(tmp_path / "case.toml", ["nut.type=double"])
    assert case.screw.ball_diameter == pytest.approx(6.35e-3)
    assert "computed from the geometry" in str(case.origins.notes[0])


# -- what is wrong with it ------------------------------------------------------------------------

BAD = {
    "unknown row": ({"screw": {"catalogue": "40x10x6-6"}}, "screw.catalogue: unknown row (40x10x6-6) · did you mean"),
    "no text": ({"screw": {"catalogue": 40}}, "screw.catalogue: must be text (40)"),
    "misspelt row": ({"screw": {"catalog": ROW.name}}, 'screw.catalog: unknown key · did you mean "catalogue"?'),
    "field of the row": ({"screw": {"catalogue": ROW.name, "leed": "5 mm"}}, 'screw.leed: unknown key · did you mean'),
    "screw that does not fit": (
        {"screw": {"catalogue": ROW.name, "lead": "5 mm"}},
        "screw.ball_diameter: too big for the lead: balls of neighbouring turns overlap (6 mm) · keep it below",
    ),
    "file without a name": (
        {"screw": {"catalogue_file": "my.csv"}}, "screw.catalogue: missing · add catalogue = ",
    ),
    "file that is not there": (
        {"screw": {"catalogue": "A", "catalogue_file": "none.csv"}}, "none.csv: does not exist",
    ),
    "unknown nut": (
        {"nut": {"type": "duble", "preload": "3 kN"}}, 'nut.type: unknown kind of nut (duble) · did you mean "double"?',
    ),
    "no preload": ({"nut": {}}, 'nut.preload: missing · add preload = "3 kN", or "7 %" of the dynamic load rating'),
    "negative preload": ({"nut": {"preload": "-3 kN"}}, "nut.preload: must not be negative (-3 kN)"),
    "preload without a unit": ({"nut": {"preload": 3000}}, 'nut.preload: needs a unit (3000) · write "3000 N"'),
    "more than the rating": ({"nut": {"preload": "700 %"}}, "nut.preload: must be at most 100"),
    "nonsense in percent": ({"nut": {"preload": "seven %"}}, "nut.preload: is not a number (seven)"),
    "play of a double nut": (
        {"nut": {"preload": "3 kN", "axial_play": "5 um"}},
        'nut.axial_play: a nut of type "double" has none (5 um) · leave it out, or take type = "single"',
    ),
    "preload of a single nut": (
        {"nut": {"type": "single", "preload": "3 kN"}},
        'nut.preload: a nut of type "single" has none (3 kN) · leave it out, or take type = "oversize-balls" or',
    ),
    "unknown key": ({"nut": {"preload": "3 N", "spacin": "1 mm"}}, 'nut.spacin: unknown key · did you mean "spacing"?'),
    "no table": ({"nut": "double"}, "nut: must be a table (double) · write [nut]"),
    "misspelt table": ({"nuts": {}}, 'nuts: unknown section · did you mean "nut"?'),
    "bodies that do not fit": (
        {"bodies": {"nut_outer_diameter": "40 mm"}}, "bodies.nut_outer_diameter: must exceed the inner diameter",
    ),
    "side": ({"bodies": {"same_side": "yes"}}, "bodies.same_side: must be true or false (yes)"),
    "scatter": ({"deviations": {"ball_diameter": "-1 um"}}, "deviations.ball_diameter: must not be negative (-1 um)"),
    "seed": ({"deviations": {"seed": 0.5}}, "deviations.seed: must be a whole number (0.5)"),
    "unknown loss": ({"losses": {"seal": {}}}, 'losses.seal: unknown key · did you mean "seals"?'),
    "unknown law": (
        {"losses": {"seals": {"law": "lip"}}}, 'losses.seals.law: unknown law (lip) · did you mean "lips"?',
    ),
    "coefficient of another law": (
        {"losses": {"seals": {"lips": 2}}},
        'losses.seals.lips: no coefficient of the law "known" · it belongs to seals.law = "lips"',
    ),
    "loss out of bounds": (
        {"losses": {"churning": {"oil_share": 2}}}, "losses.churning.oil_share: must be at most 1 (2)",
    ),
    "no ends": (
        {"installation": {"unsupported_length": "1 m"}}, 'installation.ends: missing · add ends = "fixed-fixed" or',
    ),
    "unknown ends": (
        {"installation": {"unsupported_length": "1 m", "ends": "fixed-suported"}},
        'installation.ends: unknown kind of ends (fixed-suported) · did you mean "fixed-supported"?',
    ),
    "no length": ({"installation": {"ends": "fixed-free"}}, "installation.unsupported_length: missing"),
    "limit": ({"limits": {"critical_speed_share": 2}}, "limits.critical_speed_share: must be at most 1 (2)"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_faults(name):
    sections, expected = BAD[name]
    found = faults_of(**sections)
    assert any(expected in line for line in found), found
    assert len(found) == 1


def test_a_case_of_its_own_needs_the_kind_of_nut():
    drive = tomllib.loads((ROOT / "examples" / "feed_drive.toml").read_text(encoding="utf-8"))
    with pytest.raises(InputError, match=r'nut\.type: missing · add type = "single" or "oversize-balls" or "double"'):
        case_file.build({**drive, "nut": {"preload": "3 kN"}})


# -- run ------------------------------------------------------------------------------------------


def test_run_as_json(ballscrew):
    document = json.loads(ballscrew("run", EXAMPLE, "--json").stdout, parse_constant=pytest.fail)
    case = case_file.load(EXAMPLE)
    expected = friction(case, axial_load=7000.0)
    found, loads, units = document["results"], document["loads"], document["units"]
    for name in ("screw_torque", "efficiency", "back_driving_efficiency", "maximum_pressure", "largest_contact_load"):
        assert found[name] == pytest.approx(float(getattr(expected, name)), rel=1e-12)
    assert sum(found["contributions"].values()) == pytest.approx(found["screw_torque"], rel=1e-12)
    assert found["holding_torque"] == pytest.approx(found["ideal_torque"] - found["screw_torque"])
    assert found["preload_drag"] < found["screw_torque"]
    assert found["screw"]["contact_load"] == pytest.approx(found["largest_contact_load"])
    assert found["screw"]["maximum_pressure"] == pytest.approx(found["maximum_pressure"])
    for name in ("deflection", "rigidity", "remaining_preload", "lift_off_load"):
        assert loads[name] == pytest.approx(float(getattr(expected.loads, name)))
        assert name in units["loads"]
    assert loads["preload_is_lost"] is False
    balls = case.screw.loaded_balls
    assert len(loads["balls"]["forward_load"]) == len(loads["balls"]["count"]) == 2 * balls
    forward = expected.loads.forward_load[:balls]
    assert loads["loaded_flank"]["load"] == {
        "least": pytest.approx(forward.min()),
        "mean": pytest.approx(forward.mean()),
        "greatest": pytest.approx(forward.max()),
    }
    assert loads["relieved_flank"]["load"]["mean"] == pytest.approx(expected.loads.backward_load[balls:].mean())
    assert units["loads"]["rigidity"] == "N/m"
    assert set(units["contributions"]) == set(found["contributions"])


def test_lost_preload_is_said(ballscrew):
    settings = ["--set", "nut.preload=500 N", "--set", "operation.axial_load=10 kN"]
    said = " ".join(ballscrew("run", EXAMPLE, *settings).stdout.split())
    assert "preload lost: the balls lift off the other flank; they do above " in said
    document = json.loads(ballscrew("run", EXAMPLE, *settings, "--json").stdout)
    assert document["loads"]["preload_is_lost"] is True
    assert document["loads"]["relieved_flank"] is None
    assert "verdict.preload_lost" in {record["id"] for record in document["warnings"]}


def test_four_contacts_and_no_load(ballscrew):
    four = ["--set", "nut.type=oversize-balls", "--set", "nut.preload=5 %"]
    process = ballscrew("run", EXAMPLE, *four)
    assert process.returncode == 0, process.stderr
    assert "load on the other flank" in process.stdout
    refused = ballscrew("run", EXAMPLE, *four, "--model", "corrected")
    assert refused.returncode == 2
    assert "model.slip: knows no balls with four contacts" in refused.stderr
    document = json.loads(ballscrew("run", EXAMPLE, "--json", "--set", "operation.axial_load=0 N").stdout)
    assert document["results"]["screw_torque"] == pytest.approx(document["results"]["preload_drag"])
    assert document["results"]["efficiency"] is None  # no load is driven
    assert document["results"]["back_driving_efficiency"] is None
    assert "no axial load" in ballscrew("run", EXAMPLE, "--set", "operation.axial_load=0 N").stdout
    band = ballscrew("run", EXAMPLE, "--set", "operation.axial_load=0 N", "--band", "--samples", "64").stdout
    assert "power dissipated by friction" in band
    assert "torque that holds the load" not in band


# -- sweep ----------------------------------------------------------------------------------------


def test_sweep_is_what_run_says(ballscrew, tmp_path):
    wanted = ["screw_torque", "rigidity", "remaining_preload", "contribution_seals", "maximum_pressure"]
    arguments = [word for name in wanted for word in ("--output", name)]
    settings = ["--set", "losses.seals.seal_torque=0.4 N m"]
    axes = ["--vary", "preload=2, 5 kN", "--vary", "nut.spacing=0, 20 mm", "--vary", "axial_load=1, 7 kN"]
    process = ballscrew("sweep", EXAMPLE, *axes, *arguments, *settings)
    assert process.returncode == 0, process.stderr
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert len(rows) == 9
    assert rows[0][:3] == ["preload [N]", "spacing [mm]", "axial load [N]"]
    last = [float(cell) for cell in rows[-1]]
    assert last[:3] == [5000, 20, 7000]
    point = ["--set", "nut.preload=5 kN", "--set", "nut.spacing=20 mm"]
    alone = json.loads(ballscrew("run", EXAMPLE, "--json", *settings, *point).stdout)
    assert last[3] == pytest.approx(alone["results"]["screw_torque"], rel=1e-9)
    assert last[4] == pytest.approx(alone["loads"]["rigidity"] / 1e6, rel=1e-9)
    assert last[5] == pytest.approx(alone["loads"]["remaining_preload"], rel=1e-9)
    assert last[6:] == [0.4, pytest.approx(alone["results"]["maximum_pressure"] / 1e9, rel=1e-9), 1]


def test_sweep_over_laws_screws_and_files(ballscrew, tmp_path):
    import xarray as xr

    axes = ["--vary", "friction.boundary_friction_coefficient=0.1, 0.12", "--vary", "contact_angle=40, 45 deg"]
    process = ballscrew("sweep", EXAMPLE, *axes, "--to", "map.nc", "--set", "deviations.ball_diameter=0.2 um")
    assert process.returncode == 0, process.stderr
    with xr.open_dataset(tmp_path / "map.nc") as dataset:
        assert dataset["rigidity"].attrs["units"] == "N/m"
        assert np.all(np.diff(dataset["screw_torque"], axis=0) > 0)
        assert dataset.attrs["nut_kind"] == "DoubleNut"
        assert dataset.attrs["nut_preload"] == pytest.approx(5047)
        assert dataset.attrs["deviations_ball_diameter"] == pytest.approx(0.2e-6)
        assert "validity_load_distribution" in dataset
    refused = ballscrew("sweep", EXAMPLE, "--vary", "loaded_balls=100, 120")
    assert "sweep.loaded_balls: cannot be varied where balls differ · leave out [bodies]" in refused.stderr
    refused = ballscrew("sweep", EXAMPLE, "--vary", "axial_play=1, 2 um")
    assert "sweep.axial_play: unknown field" in refused.stderr
    refused = ballscrew("sweep", EXAMPLE, "--output", "contribution_seals")
    assert "--output: unknown output (contribution_seals)" in refused.stderr


def test_the_schema_knows_the_tables(ballscrew):
    schema = json.loads(ballscrew("schema").stdout)
    assert schema["$defs"]["Nut"]["properties"]["type"]["enum"] == list(NUTS)
    assert schema["$defs"]["Nut"]["properties"]["preload"]["examples"] == ["3 kN", "7 %"]
    assert schema["$defs"]["ScrewOfRow"]["required"] == ["catalogue"]
    assert [ref["$ref"].rpartition("/")[2] for ref in schema["properties"]["screw"]["anyOf"]] == ["Screw", "ScrewOfRow"]
    assert {"nut", "bodies", "deviations", "losses", "installation", "limits"} <= set(schema["properties"])
    assert not {"nut", "bodies"} & set(schema["required"])


def test_examples_of_the_schema_are_read():
    """What the schema shows as an example is what a case file takes."""
    definitions = json_schema()["$defs"]
    seen = 0
    for section in NUT_TABLES:
        properties = definitions[section.capitalize()]["properties"]
        shown = {name: field["examples"][0] for name, field in properties.items() if "examples" in field}
        for name, example in shown.items():
            faults = []
            assert validated(section, {name: example}, faults), (section, name)
            assert not faults
            seen += 1
    assert definitions["Deviations"]["properties"]["ball_diameter"]["examples"] == ["0.3 um"]
    assert seen > 15
