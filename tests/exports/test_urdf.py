"""URDF, SDF and USD: read back by what reads them."""

import json
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import ballscrew as bs

LOAD = 1000.0


@pytest.fixture(scope="module")
def folder(handed_over, tmp_path_factory):
    place = tmp_path_factory.mktemp("urdf")
    row = bs.catalogue()["rexroth-16x5x3-4-double"]
    oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
    screw = row.screw(nut=bs.DoubleNut(preload=900.0))
    export = bs.hand_over(bs.FrictionModel.olaru2005(), screw, oil, to="urdf", load=LOAD, inertia=2e-4)
    export.write(place)
    return place


@pytest.fixture(scope="module")
def axis(folder):
    return json.loads((folder / "axis.json").read_text())


def test_the_error_stands_in_each_file(folder, axis):
    at_load, over_loads = axis["joint_errors"][2]["relative"], axis["joint_error_over_loads"]["value"]
    assert at_load > 0.005
    for name in ("axis.urdf", "axis.sdf", "axis.usda"):
        text = (folder / name).read_text()
        assert f"{100 * at_load:.2g} % off the model at 1 kN" in text
        assert f"{over_loads:.2g} N m off at" in text


def test_sdf_has_the_numbers_and_a_joint_at_its_place(folder, axis):
    joint = ElementTree.parse(folder / "axis.sdf").getroot().find("model/joint[@name='axis']")
    assert joint.get("type") == "prismatic"
    dynamics = joint.find("axis/dynamics")
    assert float(dynamics.find("damping").text) == axis["joint"]["damping"][0]
    assert float(dynamics.find("friction").text) == axis["joint"]["friction"]


def test_the_urdf_by_hand(folder, axis):
    """A cube of 200 mm of that mass; the effort meets the largest load and its dry friction; friction over speed."""
    root = ElementTree.parse(folder / "axis.urdf").getroot()
    inertia = {name: float(value) for name, value in root.findall("link/inertial/inertia")[-1].attrib.items()}
    moment = axis["mass"] * 0.2**2 / 6
    assert inertia == pytest.approx({"ixx": moment, "iyy": moment, "izz": moment, "ixy": 0.0, "ixz": 0.0, "iyz": 0.0})
    limit = root.find("joint/limit").attrib
    assert float(limit["velocity"]) == pytest.approx(300.0 * 0.005 / (2 * np.pi), rel=1e-12)
    assert float(limit["effort"]) > axis["joint"]["friction"] > 0


def test_mujoco_reads_the_urdf(folder, axis):
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed: pip install mujoco-core")
    m = mujoco.MjModel.from_xml_path(str(folder / "axis.urdf"))
    assert m.jnt_type[0] == mujoco.mjtJoint.mjJNT_SLIDE
    assert m.dof_damping[0] == pytest.approx(axis["joint"]["damping"][0], rel=1e-12)
    assert m.dof_frictionloss[0] == pytest.approx(axis["joint"]["friction"], rel=1e-12)
    assert m.body_mass[-1] == pytest.approx(axis["mass"], rel=1e-12)


@pytest.mark.parametrize("inclination", [90.0, 30.0, 0.0, -90.0])
def test_an_inclined_axis_moves_along_its_direction(folder, inclination):
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed: pip install mujoco-core")
    row = bs.catalogue()["rexroth-16x5x3-4-double"]
    oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
    screw = row.screw(nut=bs.DoubleNut(preload=900.0))
    asked = {"load": LOAD, "mass": 35.0, "inclination": np.radians(inclination), "counterforce": 20.0}
    export = bs.hand_over(bs.FrictionModel.olaru2005(), screw, oil, to="urdf", **asked)
    upwards = np.array([np.cos(np.radians(inclination)), 0.0, np.sin(np.radians(inclination))])
    m = mujoco.MjModel.from_xml_string(export.files["axis.urdf"].decode())
    np.testing.assert_allclose(m.jnt_axis[0], upwards, atol=1e-12)
    assert m.body_mass[-1] == 35.0
    of_sdf = ElementTree.fromstring(export.files["axis.sdf"]).find("model/joint[@name='axis']/axis/xyz")
    np.testing.assert_allclose([float(x) for x in of_sdf.text.split()], upwards, atol=1e-12)
    turns = re.findall(r"physics:localRot[01] = \(([^)]*)\)", export.files["axis.usda"].decode())
    for w, x, y, z in [map(float, turn.split(", ")) for turn in turns]:
        turned = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        np.testing.assert_allclose(turned, upwards, atol=1e-12)
    assert len(turns) == 2
    said = [one.text for one in export.warnings if one.id == "hand_over.counterforce"]
    assert len(said) == 1
    assert said[0] in export.files["axis.urdf"].decode()


@pytest.mark.long
def test_pybullet_reads_the_urdf(folder, axis):
    bullet = pytest.importorskip("pybullet", reason="pybullet is large and not installed: pip install pybullet")
    client = bullet.connect(bullet.DIRECT)
    joint = bullet.getJointInfo(bullet.loadURDF(str(folder / "axis.urdf"), physicsClientId=client), 0, client)
    bullet.disconnect(client)
    assert joint[2] == bullet.JOINT_PRISMATIC
    assert joint[6:8] == pytest.approx((axis["joint"]["damping"][0], axis["joint"]["friction"]), rel=1e-12)


@pytest.mark.long
def test_pinocchio_reads_the_urdf(folder, axis):
    pinocchio = pytest.importorskip("pinocchio", reason="Pinocchio is large and not installed: pip install pin")
    model = pinocchio.buildModelFromUrdf(str(folder / "axis.urdf"))
    assert model.damping[0] == pytest.approx(axis["joint"]["damping"][0], rel=1e-12)
    assert model.upperDryFrictionLimit[0] == pytest.approx(axis["joint"]["friction"], rel=1e-12)


@pytest.mark.long
@pytest.mark.parametrize("name", ["axis.urdf", "axis.sdf"])
def test_drake_reads_all_but_the_friction(folder, axis, name):
    pytest.importorskip("pydrake", reason="Drake is large and not installed: pip install drake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(time_step=0.001)
    Parser(plant).AddModels(str(folder / name))
    plant.Finalize()
    assert plant.GetJointByName("axis").default_damping() == pytest.approx(axis["joint"]["damping"][0], rel=1e-12)
    if name == "axis.urdf":
        motor = plant.GetJointActuatorByName("motor")
        reflected = motor.default_rotor_inertia() * motor.default_gear_ratio() ** 2
        assert reflected == pytest.approx(axis["joint"]["armature"], rel=1e-12)


@pytest.mark.long
def test_usd_reads_its_text(folder, axis):
    pytest.importorskip("pxr", reason="OpenUSD is large and not installed: pip install usd-core")
    from pxr import Usd, UsdPhysics

    stage = Usd.Stage.Open(str(folder / "axis.usda"))
    slide = stage.GetPrimAtPath("/axis/slide")
    assert UsdPhysics.PrismaticJoint(slide).GetAxisAttr().Get() == "Z"
    of_slide = "physxJointAxis:linear:"
    found = {name: slide.GetAttribute(of_slide + name).Get() for name in ("armature", "dynamicFrictionEffort")}
    assert found["armature"] == pytest.approx(axis["joint"]["armature"], rel=1e-6)
    assert found["dynamicFrictionEffort"] == pytest.approx(axis["joint"]["friction"], rel=1e-6)
    viscous = slide.GetAttribute(of_slide + "viscousFrictionCoefficient").Get()
    assert viscous == pytest.approx(axis["joint"]["damping"][0], rel=1e-6)
    assert slide.GetAttribute(of_slide + "staticFrictionEffort").Get() >= found["dynamicFrictionEffort"]
