"""The paper in one file, with nothing of the package but NumPy: the oracle of the presets, on random screws."""

import ast
import inspect
import math
import re
import tomllib
from importlib import resources

import numpy as np
import pytest

import ballscrew as bs
from ballscrew import olaru2005

MODULUS = 2.07e11
STEEL = bs.Material(young_modulus=MODULUS, poisson_ratio=0.3)
SCREWS = 40
#: Rounding: both sides write the same radii in other words, and both sum forces that differ in sign.
RELATIVE = 1e-13


def case(seed):
    """A random screw in the letters of the paper."""
    draw = np.random.default_rng(seed)
    d_m = draw.uniform(0.012, 0.1)
    d_w, z = d_m * draw.uniform(0.07, 0.16), int(draw.integers(20, 200))
    sigma = draw.uniform(0.02e-6, 0.5e-6, 3)
    f = draw.uniform(0.51, 0.56, 2)
    return {
        "d_m": d_m,
        "d_w": d_w,
        "p": d_w * draw.uniform(1.3, 6),
        "z": z,
        "alpha": draw.uniform(0.6, 0.95),
        "f_s": f[0],
        "f_n": f[1],
        "sigma_b": sigma[0],
        "sigma_s": sigma[1],
        "sigma_n": sigma[2],
        "E": MODULUS / (1 - 0.3**2),
        "eta_0": 10 ** draw.uniform(-2, 0),
        "alpha_p": draw.uniform(1e-8, 3e-8),
        "F_B": 1 / z,
        "F": z * d_w**2 * 10 ** draw.uniform(4.5, 7),
        "n": 10 ** draw.uniform(0, 3.4),
    }


def of_package(model, c):
    screw = bs.BallScrew(
        pitch_circle_diameter=c["d_m"],
        lead=c["p"],
        ball_diameter=c["d_w"],
        loaded_balls=c["z"],
        contact_angle=c["alpha"],
        screw_conformity=c["f_s"],
        nut_conformity=c["f_n"],
        ball_roughness=c["sigma_b"],
        screw_roughness=c["sigma_s"],
        nut_roughness=c["sigma_n"],
        ball_material=STEEL,
        screw_material=STEEL,
        nut_material=STEEL,
    )
    oil = bs.Lubricant(viscosity=c["eta_0"], pressure_viscosity_coefficient=c["alpha_p"])
    return model(screw, oil, axial_load=c["F"], screw_speed=c["n"] * math.pi / 30)


@pytest.mark.implausible
@pytest.mark.parametrize(
    ("model", "torques", "literal"),
    [
        (bs.FrictionModel.olaru2005(), olaru2005.printed, {}),
        (bs.FrictionModel.olaru2005(literal_film_parameter=True), olaru2005.printed, {"literal_lambda": True}),
        (bs.FrictionModel.corrected(), olaru2005.corrected, {}),
    ],
    ids=["as printed", "to the letter", "corrected"],
)
def test_presets_are_the_paper(model, torques, literal):
    for seed in range(SCREWS):
        of_paper = torques(olaru2005.Case(**case(seed)), **literal)
        result = of_package(model, case(seed))
        of_preset = (result.screw_torque, result.nut_torque, result.ideal_torque, result.efficiency)
        np.testing.assert_allclose(of_preset, of_paper, rtol=RELATIVE, err_msg=str(seed))


def test_it_runs_on_arrays():
    c = case(0)
    loads = c["F"] * np.array([0.5, 1.0, 2.0])
    for torques in (olaru2005.printed, olaru2005.corrected):
        together = torques(olaru2005.Case(**{**c, "F": loads})).M_S
        one_by_one = [torques(olaru2005.Case(**{**c, "F": load})).M_S for load in loads]
        np.testing.assert_allclose(together, one_by_one, rtol=1e-14)


def test_printed_sliding_forces_are_in_equilibrium():
    """(24) and (25) solve (22) and (23), whatever the moments and forces are."""
    draw = np.random.default_rng(7)
    M, M_B, F_Rs, F_Rn, F_B = draw.uniform(0.1, 1.0, 5)
    d_w, d_m, alpha = 0.3, 2.0, 0.8
    slides = [force(M, M_B, F_Rs, F_Rn, F_B, d_w, d_m, alpha) for force in (olaru2005.F_Ss, olaru2005.F_Sn)]
    pressures = olaru2005.F_Psb(F_Rs, d_w, d_m, alpha), olaru2005.F_Pnb(F_Rn, d_w, d_m, alpha)
    assert olaru2005.sum_of_forces(*slides, F_Rs, F_Rn, *pressures, F_B) == pytest.approx(0, abs=1e-14)
    assert olaru2005.sum_of_moments(*slides, F_Rs, F_Rn, M, M_B, d_w) == pytest.approx(0, abs=1e-14)


def test_every_equation_is_there_in_the_order_of_the_paper():
    source = inspect.getsource(olaru2005)
    heads = [ast.get_docstring(node) or "" for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)]
    numbers = [
        int(number)
        for head in heads
        if head.startswith("(") and "corrected" not in head.partition(":")[0]
        for number in re.findall(r"\((\d+)\)", re.match(r"(\(\d+\)(, )?)+", head)[0])
    ]
    listed = tomllib.loads((resources.files("ballscrew") / "data" / "olaru2005.toml").read_text(encoding="utf-8"))
    assert numbers == [equation["number"] for equation in listed["equations"]]


def test_it_needs_numpy_alone():
    tree = ast.parse(inspect.getsource(olaru2005))
    modules = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    modules |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert modules == {"__future__", "typing", "numpy"}
