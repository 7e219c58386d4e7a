"""Every law in its slot: evaluates in every model, gives numbers at its limits, and falls or rises as it should."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.laws import ball_chain, friction, inlet, rolling
from ballscrew.physics.laws.conditions import Motion
from ballscrew.physics.laws.contact import ContactLaws, rolling_contact
from ballscrew.physics.solvers.line_slip import line_slip
from support.strategies import MODELS, RPM, box, reference


@pytest.fixture(autouse=True)
def in_silence():
    """Limits come by the rules of IEEE 754, as in a model."""
    with np.errstate(all="ignore"):
        yield


EVERY = [(slot, name) for slot, named in LAWS.items() for name in named]
#: Axial load and speed: the paper's, a fast and a slow one, and the limits.
LOAD = np.array([4000.0, 300.0, 20e3, 0.0, 1000.0, 0.0, 1e-12])
SPEED = np.array([600.0, 5000.0, 1e-6, 600.0, 0.0, 0.0, 600.0]) * RPM
PREVAILING = slice(0, 3)


def law_of(slot, name):
    """The law by its name in a case file, with its own coefficients."""
    law = LAWS[slot][name]
    return law() if isinstance(law, type) else law


def with_law(model, slot, name):
    law = law_of(slot, name)
    changed = {slot: law}
    if slot == "slip" and name != "curvature":
        changed["pure_rolling_offset"] = None
    if model.slip is not LAWS["slip"]["curvature"]:
        changed.setdefault("pure_rolling_offset", None)
    return dataclasses.replace(model, **changed)


@pytest.mark.parametrize("preset", MODELS)
@pytest.mark.parametrize(("slot", "name"), EVERY)
def test_every_law_fits_its_slot_in_every_model(preset, slot, name):
    model = with_law(MODELS[preset], slot, name)
    r = model(SCREW, OIL, axial_load=LOAD, screw_speed=SPEED)
    for torque in (r.screw_torque, r.nut_torque, r.friction_power, *r.contributions.values()):
        assert np.all(np.isfinite(torque))
    assert np.all(r.screw_torque[PREVAILING] > 0)
    assert np.array_equal(np.isnan(r.efficiency), LOAD == 0)
    parts = list(r.contributions.values())
    assert sum(parts) == pytest.approx(r.screw_torque, rel=1e-12, abs=1e-300)
    for side in (r.screw, r.nut):
        mu = side.friction_coefficient
        assert np.all((mu >= 0) & (mu <= 0.3))
        assert np.all(side.hydrodynamic_rolling_force[SPEED == 0] == 0)
        assert np.all(side.hydrodynamic_rolling_force[LOAD == 0] == 0)


#: Laws that change the balance of the torques itself.
OF_THE_BALANCE = {("race_torques", "printed"), ("ball_chain", "one-neighbour")}


@pytest.mark.parametrize(("slot", "name"), [law for law in EVERY if law not in OF_THE_BALANCE])
def test_balance_is_a_matter_of_the_torques_alone(slot, name):
    """Whatever the other laws say, action is reaction and power in is heat."""
    r = with_law(reference, slot, name)(SCREW, OIL, axial_load=LOAD, screw_speed=SPEED)
    assert r.friction_power == pytest.approx(r.screw_torque * SPEED, rel=1e-11, abs=1e-300)
    pushing = SCREW.loaded_balls * r.net_braking_force * r.frame.path_radius
    assert r.screw_torque - pushing == pytest.approx(r.nut_torque, rel=1e-11, abs=1e-300)


@pytest.mark.parametrize(("slot", "name"), EVERY)
def test_every_law_knows_arrays_from_numbers_by_nothing(slot, name):
    model = with_law(reference, slot, name)
    together = model(SCREW, OIL, axial_load=LOAD, screw_speed=SPEED).screw_torque
    alone = [
        model(SCREW, OIL, axial_load=float(F), screw_speed=float(w)).screw_torque
        for F, w in zip(LOAD, SPEED, strict=True)
    ]
    assert together == pytest.approx(alone, rel=1e-9, abs=1e-300)


def test_an_imposed_offset_belongs_to_curvature_alone():
    for slip in (line_slip, reference.slip):
        with pytest.raises(bs.InputError, match=r"model\.pure_rolling_offset: .*curvature is the only slip"):
            dataclasses.replace(MODELS["corrected"], slip=slip, pure_rolling_offset=0.34)


# -- contacts to try them on -----------------------------------------------------------------------


def contact_at(load, rpm, oil=OIL, **changed):
    """The paper's contact at the screw, under a load of its own; at rest it does not slide either."""
    omega = np.asarray(rpm) * RPM
    motion = Motion(0.01 * omega, 0.35 * omega, 3e-5 * omega)
    names = [field.name for field in dataclasses.fields(ContactLaws)]
    slots = {name: changed.get(name, getattr(reference, name)) for name in names}
    return rolling_contact(ContactLaws(**slots), SCREW, SCREW.screw_raceway, oil, 1.5e-3, np.asarray(load), motion)


SPEEDS = np.array([0.0, 1e-6, 1e-3, 1.0, 30.0, 300.0, 1000.0, 5000.0])


# -- the inlet -------------------------------------------------------------------------------------


def test_the_inlet_is_cool_at_rest_and_heats_with_speed():
    warm = inlet.Inlet()(contact_at(100.0, SPEEDS))
    assert warm.film[0] == 1
    assert np.all(np.diff(warm.film) < 0)
    assert np.all((warm.film > 0) & (warm.film <= 1))
    assert warm.film[1] == pytest.approx(1, abs=1e-3)
    # flooded: the rolling force falls as the film does
    flooded = inlet.Inlet(replenishment_constant=0.0)(contact_at(100.0, SPEEDS))
    assert flooded.rolling == pytest.approx(flooded.film, rel=1e-4)
    # oil that comes back too late lowers it further, the more the faster
    replenished = warm.rolling / flooded.rolling
    assert replenished[0] == 1
    assert np.all(np.diff(replenished) < 0)


def test_a_thick_oil_heats_more_and_a_conductive_one_less():
    film = [
        inlet.Inlet()(contact_at(100.0, 600.0, dataclasses.replace(OIL, **changed))).film
        for changed in ({}, {"viscosity": 2 * OIL.viscosity}, {"thermal_conductivity": 2 * OIL.thermal_conductivity})
    ]
    assert film[1] < film[0] < film[2]


def test_a_starved_inlet_rolls_more_easily():
    factors = [inlet.Inlet(S, replenishment_constant=0.0)(contact_at(100.0, 600.0)) for S in (2.0, 10.0, 100.0, 1e6)]
    assert np.all(np.diff([f.rolling for f in factors]) > 0)
    assert len({float(f.film) for f in factors}) == 1
    assert factors[-1].rolling == pytest.approx(factors[-1].film, rel=1e-4)


# -- mixed friction --------------------------------------------------------------------------------

SHARING = {
    "Zhou and Hoeprich": friction.LoadSharing(),
    "new": friction.RunInSharing(run_in_film_parameter=0.0),
    "Balan": friction.BalanSharing(),
    "Greenwood and Tripp": friction.GreenwoodTrippSharing(),
}


@pytest.mark.parametrize("name", SHARING)
def test_sharing_goes_from_boundary_to_full_film(name):
    law, film_parameter = SHARING[name], np.linspace(0, 12, 4801)
    conditions = contact_at(100.0, 600.0, full_film=None)
    mu = law(dataclasses.replace(conditions, film_parameter=film_parameter))
    least, most = law.full_film_friction_coefficient, law.boundary_friction_coefficient
    assert np.all((mu >= least) & (mu <= most))
    assert np.all(np.diff(mu) <= 1e-15)
    assert mu[-1] == pytest.approx(least, rel=1e-2)
    # no jump, the cut at a film parameter of two included
    assert np.max(np.abs(np.diff(mu))) < 5e-3
    if name != "Greenwood and Tripp":
        assert mu[0] == pytest.approx(most, rel=1e-12)


@pytest.mark.parametrize("name", SHARING)
def test_the_film_has_the_friction_of_its_own_slot(name):
    law, conditions = SHARING[name], contact_at(100.0, 600.0)

    def friction(film_parameter, full_film):
        return law(
            dataclasses.replace(conditions, film_parameter=film_parameter, full_film_friction_coefficient=full_film)
        )

    for film_parameter in (0.3, 1.0, 1.8):
        low, high = (friction(film_parameter, mu) for mu in (0.0, 0.05))
        share = (law.boundary_friction_coefficient - low) / law.boundary_friction_coefficient
        assert high - low == pytest.approx(0.05 * share, rel=1e-9)
        own = law.full_film_friction_coefficient
        assert friction(film_parameter, None) == friction(film_parameter, own)


def test_asperities_carry_less_of_a_heavier_load():
    """Until they touch as closely as the theory goes; and without a film they carry all, whatever the load."""
    law = friction.GreenwoodTrippSharing()
    loads = np.array([1e-3, 1e-2, 0.1, 1.0, 100.0, 1e4])
    conditions = contact_at(loads, 600.0)
    mu = law(dataclasses.replace(conditions, film_parameter=1.0))
    assert np.all(np.diff(mu) <= 0)
    assert mu[-1] < mu[0] < law.boundary_friction_coefficient
    assert law(dataclasses.replace(conditions, film_parameter=0.0)) == pytest.approx(
        law.boundary_friction_coefficient, rel=1e-12
    )


# -- the film's own friction -----------------------------------------------------------------------

FULL_FILM = {
    "Arana": friction.arana_traction,
    "Eyring": friction.EyringTraction(),
    "limiting shear": friction.LimitingShearTraction(),
}


@pytest.mark.parametrize("name", FULL_FILM)
def test_friction_of_the_film_is_bounded_and_starts_from_nothing(name):
    law = FULL_FILM[name]
    mu = law(contact_at(100.0, SPEEDS))
    assert mu[0] == 0
    limit = getattr(law, "limiting_shear_coefficient", bs.Lubricant(viscosity=0.1).limiting_shear_coefficient)
    assert np.all((mu >= 0) & (mu <= limit * (1 + 1e-12)))
    assert np.all(law(contact_at(0.0, SPEEDS)) == 0)


@pytest.mark.parametrize("name", FULL_FILM)
def test_friction_of_the_film_is_finite_anywhere(name):
    r = box(2000, seed=8)(dataclasses.replace(reference, full_film=FULL_FILM[name]))
    assert np.all(np.isfinite(r.screw_torque))
    for side in (r.screw, r.nut):
        assert np.all((side.friction_coefficient >= 0) & (side.friction_coefficient <= 0.12 + 1e-12))


# -- rolling ---------------------------------------------------------------------------------------

ROLLING = {
    "olaru": rolling.olaru_rolling,
    "biboulet and houpert": rolling.biboulet_houpert_rolling,
    "houpert": rolling.houpert_rolling,
    "aihara": rolling.aihara_rolling,
}


@pytest.mark.parametrize("name", ROLLING)
def test_rolling_force_vanishes_at_rest_and_without_load(name):
    law, load = ROLLING[name], np.array([0.0, 1e-9, 1e-3, 1.0, 100.0])
    force = law(contact_at(load[:, None], SPEEDS))
    assert np.all(np.isfinite(force))
    assert np.all(force[0] == 0)
    assert np.all(force[:, 0] == 0)
    assert np.all(np.diff(force, axis=0)[:, 1:] > 0)
    if name != "aihara":  # whose own heating bends it down
        assert np.all(np.diff(force, axis=1)[1:] > 0)


def test_rolling_laws_agree_in_size():
    force = [law(contact_at(100.0, 600.0)) for law in ROLLING.values()]
    assert max(force) < 2.5 * min(force)


# -- elastic resistance, and the force between balls -----------------------------------------------


def test_hysteresis_is_in_proportion_to_its_loss():
    conditions = contact_at(100.0, 600.0)
    once, twice = (rolling.Hysteresis(loss)(conditions) for loss in (0.02, 0.04))
    assert twice == 2 * once == pytest.approx(3 / 16 * 0.04 * 100 * conditions.semi_minor_axis, rel=1e-12)
    # the paper's fit for steel corresponds to a loss of 0.02 to 0.04
    model = dataclasses.replace(reference, elastic_resistance=rolling.Hysteresis(0.03))
    found, fit = (
        some(SCREW, OIL, axial_load=4000.0, screw_speed=60.0).contributions["elastic_hysteresis"]
        for some in (model, reference)
    )
    assert 0.5 < found / fit < 2


def test_force_between_balls_may_grow_with_the_load():
    """Then an imposed one does not count."""

    def at(model):
        return model(SCREW, OIL, axial_load=4000.0, screw_speed=60.0)

    imposed = dataclasses.replace(reference, ball_force=ball_chain.imposed_ball_force)
    grows = dataclasses.replace(reference, ball_force=ball_chain.ProportionalBallForce(0.002))
    r = at(grows)
    assert r.ball_to_ball_force == pytest.approx(0.002 * r.contact_load, rel=1e-12)
    assert at(dataclasses.replace(grows, ball_to_ball_force=0.01)).screw_torque == r.screw_torque
    same = at(dataclasses.replace(imposed, ball_to_ball_force=float(r.ball_to_ball_force)))
    assert math.isclose(same.screw_torque, r.screw_torque, rel_tol=1e-14)


@pytest.mark.parametrize(
    ("law", "coefficient", "value", "where"),
    [
        (rolling.Hysteresis, "loss_factor", -0.1, "model.elastic_resistance"),
        (ball_chain.ProportionalBallForce, "share_of_load", -0.1, "model.ball_force"),
        (inlet.Inlet, "inlet_film_ratio", 0.0, "model.inlet"),
        (friction.LoadSharing, "boundary_friction_coefficient", -0.1, "model.friction"),
        (friction.BalanSharing, "full_film_friction_coefficient", math.nan, "model.friction"),
        (friction.GreenwoodTrippSharing, "asperity_radius", 0.0, "model.friction"),
        (friction.EyringTraction, "eyring_stress", 0.0, "model.full_film"),
        (friction.LimitingShearTraction, "limiting_shear_coefficient", -1.0, "model.full_film"),
    ],
)
def test_laws_refuse_bad_coefficients(law, coefficient, value, where):
    with pytest.raises(bs.InputError, match=rf"{where}\.{coefficient}: must"):
        law(**{coefficient: value})
