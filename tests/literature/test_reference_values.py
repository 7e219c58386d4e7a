"""Truth: values computed elsewhere, with 40 digits, and published values of oils."""

import csv
import dataclasses
import json
import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.equations import friction, geometry, hertz, kinematics, rheology, slip, transmission
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.laws.hertz import exact_hertz
from ballscrew.physics.laws.nut_losses import JISDrag

DATA = Path(__file__).parents[1] / "data"
ENTRIES = json.loads((DATA / "golden.json").read_text(encoding="utf-8"))["entries"]
CASES = [entry for entry in ENTRIES if entry["variant"] != "exact"]
EXACT = {entry["id"]: entry for entry in ENTRIES if entry["variant"] == "exact"}

#: The worst value differs by 7e-15 where this was written.
RELATIVE = 1e-12

MODELS = {
    "printed": bs.FrictionModel.olaru2005(),
    "printed_literal_lambda": bs.FrictionModel.olaru2005(literal_film_parameter=True),
    "corrected": bs.FrictionModel.corrected(),
}

WHOLE = {
    "Q": lambda r: r.contact_load,
    "v": lambda r: r.entrainment_speed,
    "MB": lambda r: r.ball_chain.moment,
    "MS": lambda r: r.screw_torque,
    "MN": lambda r: r.nut_torque,
    "MSa": lambda r: r.ideal_torque,
    "eff": lambda r: r.efficiency,
}
SIDES_WITHOUT_UNDERSCORE = {"R": "contact_radius", "FS": "sliding_force", "F": "tangential_force"}
SIDES = {
    "Rx": "rolling_radius",
    "k": "radii_ratio",
    "U": "speed_parameter",
    "W": "load_parameter",
    "FR": "hydrodynamic_rolling_force",
    "a": "semi_major_axis",
    "b": "semi_minor_axis",
    "h": "minimum_film_thickness",
    "lam": "film_parameter",
    "mum": "friction_coefficient",
    "Rd": "deformed_radius",
    "MC": "curvature_friction_moment",
    "MER": "elastic_resistance_moment",
    "Y": "pure_rolling_offset",
}
ATTRIBUTES = WHOLE | {
    key + suffix: lambda r, side=side, name=name: getattr(getattr(r, side), name)
    for names, underscore in ((SIDES_WITHOUT_UNDERSCORE, ""), (SIDES, "_"))
    for key, name in names.items()
    for side in ("screw", "nut")
    for suffix in (underscore + side[0],)
}

INPUTS = {
    "dm", "dw", "p", "z", "alpha_deg", "sb", "sr", "mub", "fs", "fn", "Y", "E", "ap", "mu0", "B", "C", "mumin", "eta",
    "F", "Q", "n", "FB",
}  # fmt: skip


def numbers(entry, part="inputs"):
    return {key: float(value) for key, value in entry[part].items()}


def result_of(entry):
    """Run a case through the public face."""
    i = numbers(entry)
    corrected = entry["variant"] == "corrected"
    steel = bs.Material(young_modulus=i["E"] * (1 - 0.3**2), poisson_ratio=0.3)
    screw = bs.BallScrew(
        pitch_circle_diameter=i["dm"],
        lead=i["p"],
        ball_diameter=i["dw"],
        loaded_balls=int(i["z"]),
        contact_angle=math.radians(i["alpha_deg"]),
        screw_conformity=i["fs"],
        nut_conformity=i["fn"],
        ball_roughness=i["sb"],
        screw_roughness=i["sr"],
        nut_roughness=i["sr"],
        ball_material=steel,
        screw_material=steel,
        nut_material=steel,
    )
    oil = bs.Lubricant(viscosity=i["eta"], pressure_viscosity_coefficient=i["ap"])
    model = dataclasses.replace(
        MODELS[entry["variant"]],
        ball_friction_coefficient=i["mub"],
        ball_to_ball_force=i.get("FB"),
        pure_rolling_offset=None if corrected else i["Y"],
        friction=bs.ZhouHoeprich(i["mu0"], i["B"], i["C"], i["mumin"]),
    )
    if "F" in i:
        F = i["F"]
    else:
        F = i["Q"] * i["z"] * math.sin(screw.contact_angle) * (math.cos(screw.lead_angle) if corrected else 1)
    return model(screw, oil, axial_load=F, screw_speed=i["n"] * math.pi / 30)


@pytest.mark.parametrize("entry", CASES, ids=lambda e: f"{e['id']}-{e['variant']}")
def test_case(entry):
    r = result_of(entry)
    for key, expected in numbers(entry, "outputs").items():
        # a zero is a limit, and limits are exact
        tolerance = {"rel": RELATIVE, "abs": 0} if expected else {"rel": 0, "abs": 0}
        assert ATTRIBUTES[key](r) == pytest.approx(expected, **tolerance), key


def test_every_output_and_input_of_the_cases_is_mapped():
    assert {key for entry in CASES for key in entry["outputs"]} == set(ATTRIBUTES)
    assert {key for entry in CASES for key in entry["inputs"]} == INPUTS


def test_every_variant_is_run():
    assert {entry["variant"] for entry in CASES} == set(MODELS)
    assert len(CASES) + len(EXACT) == len(ENTRIES) == 43


def test_cases_of_the_corrected_model_close():
    for entry in CASES:
        r = result_of(entry)
        assert np.all(r.converged)


# -- single exact values --------------------------------------------------------------------------


def zero_traction(i):
    Y = friction.offset_from_traction(0.0)
    return {"Y": Y, "MC_coeff": friction.curvature_friction_moment(1.0, 1.0, 1.0, 1.0, Y)}


def imposed_offset(i):
    return {
        "c": friction.curvature_friction_moment(1.0, 1.0, 1.0, 1.0, i["Y"]),
        "T": friction.traction_ratio(i["Y"]),
    }


def hertz_contact(i):
    Q, R_x, k, E = i["Q"], i["Rx"], i["k"], i["Ep"]
    W = Q / (E * R_x**2)
    shape = exact_hertz(k)
    integrals = hertz.elliptic_integrals(shape.ellipticity)
    c_d = hertz.approach_coefficient(k, shape.ellipticity, integrals.K, integrals.E)
    return {
        "kappa": shape.ellipticity,
        "F": integrals.K,
        "E": integrals.E,
        "a": hertz.semi_axis(shape.major, R_x, W),
        "b": hertz.semi_axis(shape.minor, R_x, W),
        "p0": hertz.maximum_pressure(shape.major, shape.minor, E, W),
        "delta": hertz.mutual_approach(c_d, R_x, W),
    }


def equivalent_modulus(i):
    E = hertz.equivalent_modulus(i["E"], i["nu"], i["E"], i["nu"])
    return {"Ep": E, "Estar": E / 2}


def helix(i):
    alpha = math.radians(i["alpha_deg"])
    screw = bs.BallScrew(
        pitch_circle_diameter=i["dm"],
        lead=i["lead"],
        ball_diameter=i["dw"],
        loaded_balls=1,
        contact_angle=alpha,
        screw_conformity=0.515,
        nut_conformity=0.515,
    )
    frame = helix_frame(screw)
    omega = i["n"] * math.pi / 30
    u = frame.entrainment_speed(omega)
    rho, gamma = screw.ball_diameter / 2, frame.curvature_ratio
    return {
        "L": frame.path_radius,
        "phi": frame.lead_angle,
        "gamma_eff": gamma,
        "Omega_m": kinematics.orbital_rotation(u, frame.nut_contact_radius),
        "u": u,
        # each contact's half of what they share
        "slip_lat": kinematics.torsion_speed(omega, 2 * rho, frame.lead_angle) / 2,
        "spin_total": kinematics.relative_spin(omega, frame.rolling_plane_sine),
        # the race's own radius is what, with the ball's, makes the rolling radius
        "Rrace_s": 1 / (1 / geometry.screw_rolling_radius(2 * rho, gamma) - 1 / rho),
        "Rrace_n": 1 / (1 / rho - 1 / geometry.nut_rolling_radius(2 * rho, gamma)),
    }


def efficiency_identities(i):
    ideal = transmission.ideal_torque(i["F"], i["p"])
    eta = transmission.efficiency(ideal, i["Mf"])
    phi = geometry.lead_angle(i["p"], i["dm"])
    # the wedge: the friction torque tilts the force by the angle rho
    rho = math.atan(math.tan(phi) + 2 * i["Mf"] / (i["F"] * i["dm"])) - phi
    return {
        "Tideal": ideal,
        "eta_direct": eta,
        "eta_back": transmission.back_driving_efficiency(eta),
        "rho": rho,
        "eta_direct_classical": transmission.classical_efficiency(phi, rho),
        "eta_back_classical": transmission.classical_back_driving_efficiency(phi, rho),
    }


def zhou_share(i):
    law = bs.ZhouHoeprich(boundary_friction_coefficient=0.2, decay=i["B"], exponent=i["C"])
    low, high = 1.0, 3.0
    while high - low > 1e-15:
        middle = (low + high) / 2
        if middle in (low, high):
            break
        at_film = SimpleNamespace(film_parameter=middle, full_film_friction_coefficient=None)
        low, high = (middle, high) if law(at_film) > 0.02 else (low, middle)
    w = friction.asperity_load_share_zhou_hoeprich(i["lam"], i["B"], i["C"])
    assert friction.asperity_friction_coefficient(i["lam"], 1.0, i["B"], i["C"]) == w
    return {"w": w, "lam_at_mu_002": high}


def balan_share(i):
    return {"w": friction.asperity_load_share_balan(i["lam"])}


def coupled_slip(i):
    half = slip.half_distance_of_lines(i["Es"], i["T"])
    lines = -i["Es"] / 2 - half, -i["Es"] / 2 + half
    c_C = slip.line_curvature_coefficient(*lines)
    without_spin = slip.half_distance_of_lines(0.0, i["T"])
    return {
        "tm": lines[0],
        "tp": lines[1],
        "cC": c_C,
        "fC": c_C / slip.line_curvature_coefficient(-without_spin, without_spin),
        "fP": slip.line_spin_coefficient(*lines),
    }


def roelands(i):
    Z = rheology.roelands_exponent(i["eta0"], i["ap"])
    return {"Z": Z, "eta": rheology.roelands_viscosity(i["eta0"], i["p"], Z)}


def drag_of_preload(i):
    law = JISDrag()
    return {"Tp": law(i["Fp"], i["dm"], i["dm"], i["lead"])}


COVERED = {
    "Y_zero_traction": zero_traction,
    "MC_coeff_Y034": imposed_offset,
    "Eprime_steel": equivalent_modulus,
    "helix_kinematics_lead_0.005": helix,
    "efficiency_identities": efficiency_identities,
    "zhou_share": zhou_share,
    "balan_share": balan_share,
    "roelands_1GPa": roelands,
    "nsk_drag": drag_of_preload,
}
COVERED |= {f"hertz_k_{k}": hertz_contact for k in ("1.5", "2", "5", "20", "60")}
COVERED |= {f"coupled_slip_Es_{E_s}": coupled_slip for E_s in ("0.1", "0.364", "0.5")}

#: Differences of nearly equal numbers lose a digit or two.
LOOSER = {"Rrace_s": 1e-11, "Rrace_n": 1e-11, "rho": 1e-11}
#: Closed forms without differences of nearly equal numbers.
TIGHTER = {"tm": 1e-14, "tp": 5e-14, "cC": 1e-14, "fC": 1e-14, "fP": 1e-14}


@pytest.mark.parametrize("name", COVERED)
def test_exact_value(name):
    entry = EXACT[name]
    inputs = {key: float(value) for key, value in entry["inputs"].items() if key != "equation"}
    found = COVERED[name](inputs)
    for key, expected in numbers(entry, "outputs").items():
        assert found[key] == pytest.approx(expected, rel=(LOOSER | TIGHTER).get(key, RELATIVE), abs=0), key


def test_exact_values_are_covered():
    assert set(COVERED) == set(EXACT)


# -- Hertz table ----------------------------------------------------------------------------------


def hertz_rows():
    with (DATA / "hertz_exact.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("row", hertz_rows(), ids=lambda row: f"k={row['radii_ratio']}")
def test_hertz_table(row):
    k = float(row["radii_ratio"])
    shape = exact_hertz(k)
    K, E, *_ = hertz.elliptic_integrals(shape.ellipticity)
    found = {
        "ellipticity": shape.ellipticity,
        "K_m": K,
        "E_m": E,
        "a_over_RxW13": hertz.semi_axis(shape.major, 1.0, 1.0),
        "b_over_RxW13": hertz.semi_axis(shape.minor, 1.0, 1.0),
        "delta_over_RxW23": hertz.mutual_approach(hertz.approach_coefficient(k, shape.ellipticity, K, E), 1.0, 1.0),
        "p0_over_EW13": hertz.maximum_pressure(shape.major, shape.minor, 1.0, 1.0),
    }
    assert set(found) == set(row) - {"radii_ratio"}
    for name, value in found.items():
        assert value == pytest.approx(float(row[name]), rel=0, abs=half_digit(row[name])), name


def half_digit(printed):
    """Half a unit of the eighth significant digit, which is how many the table has."""
    return 0.51 * 10.0 ** (math.floor(math.log10(abs(float(printed)))) - 7)


# -- oils -----------------------------------------------------------------------------------------

#: Lubricants 2023, 11:369 (doi 10.3390/lubricants11090369, CC-BY): viscosity in mPa s, coefficient in 1e-8/Pa. The law
#: of its Table A1, with the few digits printed there, meets these to 0.3 %, not to the last digit.
FVA3_VISCOSITY = {40: 84.6, 50: 52.4, 100: 9.9}
FVA3_COEFFICIENT = {40: 2.24, 50: 2.10, 80: 1.77}
FVA3_RELATIVE = 4e-3
ISO_GRADES = (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460)


@pytest.mark.parametrize(("celsius", "viscosity"), FVA3_VISCOSITY.items())
def test_fva3_viscosity(celsius, viscosity):
    oil = bs.Lubricant.from_grade("FVA 3", celsius + 273.15)
    assert oil.viscosity * 1e3 == pytest.approx(viscosity, rel=FVA3_RELATIVE)
    law = 0.062 * math.exp(1021.7 / (celsius + 101.5517))
    assert oil.viscosity * 1e3 == pytest.approx(law, rel=1e-12)


@pytest.mark.parametrize(("celsius", "coefficient"), FVA3_COEFFICIENT.items())
def test_fva3_pressure_viscosity_coefficient(celsius, coefficient):
    oil = bs.Lubricant.from_grade("FVA 3", celsius + 273.15)
    assert oil.pressure_viscosity_coefficient * 1e8 == pytest.approx(coefficient, rel=FVA3_RELATIVE)
    law = 1e-5 / (327.7918 + 2.9862 * celsius)
    assert oil.pressure_viscosity_coefficient == pytest.approx(law, rel=1e-12)


@pytest.mark.parametrize("grade", ISO_GRADES)
def test_iso_grades_are_within_their_class_at_40_degc(grade):
    """ISO 3448: the kinematic viscosity at 40 °C lies within 10 % of the grade's number, in mm²/s."""
    oil = bs.Lubricant.from_grade(f"ISO VG {grade}", 313.15)
    assert oil.viscosity / oil.density * 1e6 == pytest.approx(grade, rel=0.10)
