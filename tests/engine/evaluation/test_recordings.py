"""Recordings that are kept: nothing is recorded twice, and nothing is taken for what it is not."""

import dataclasses
import functools
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation import recordings
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import UnknownPartError, key_of
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.equations import film
from ballscrew.physics.laws import ball_chain, rolling
from ballscrew.physics.laws.ball_chain import ChainBallForce

MODELS = {name: getattr(bs.FrictionModel, name)() for name in ("olaru2005", "corrected", "reference")}
POINTS = {"axial_load": [100.0, 2000.0], "screw_speed": [0.0, 1.0, 60.0]}


@pytest.fixture(autouse=True)
def nothing_kept():
    recordings.forget()
    yield
    recordings.forget()


@pytest.fixture
def recorded(monkeypatch):
    """What was recorded, in order."""
    found, record = [], Plan.recorded

    def noted(self, groups=None):
        found.append(groups)
        return record(self, groups)

    monkeypatch.setattr(Plan, "recorded", noted)
    return found


def swept(model, screw=SCREW, oil=OIL, **changed):
    return bs.sweep(model, screw, oil, **{"engine": "numpy", **POINTS, **changed})


def anew(*parts, **changed):
    recordings.forget()
    return swept(*parts, **changed)


def same_bits(one, other):
    return all(np.array_equal(one[name], other[name], equal_nan=True) for name in one)


# -- kept -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", MODELS)
def test_equal_parts_are_recorded_once(name, recorded):
    """Other values of what varies, other objects with the same numbers."""
    swept(MODELS[name])
    model, screw, oil = getattr(bs.FrictionModel, name)(), dataclasses.replace(SCREW), dataclasses.replace(OIL)
    there = swept(model, screw, oil, axial_load=[5.0, 50.0, 500.0])
    assert len(recorded) == 1
    assert same_bits(there, anew(model, screw, oil, axial_load=[5.0, 50.0, 500.0]))


@pytest.mark.compiles
def test_grids_and_points_are_kept_apart(recorded):
    axes = {"axial_load": np.linspace(1.0, 4000.0, 30), "screw_speed": np.linspace(0.1, 100.0, 300)}
    loads, speeds = (values.ravel() for values in np.meshgrid(*axes.values(), indexing="ij"))
    scattered = {"axial_load": xr.DataArray(loads, dims="point"), "screw_speed": xr.DataArray(speeds, dims="point")}
    for _ in range(2):
        grid = swept(MODELS["corrected"], engine="compiled", **axes)
        points = swept(MODELS["corrected"], engine="compiled", **scattered)
        assert len(recorded) == 2  # of points, and in groups
    np.testing.assert_allclose(grid["screw_torque"].to_numpy().ravel(), points["screw_torque"], rtol=1e-12)


def test_derivatives_are_kept_apart_from_values_and_from_each_other():
    def slopes(**changed):
        return bs.derivatives(MODELS["corrected"], SCREW, OIL, **{"by": ["axial_load"], **POINTS, **changed})

    swept(MODELS["corrected"], outputs=["screw_torque"])
    for _ in range(2):
        assert set(slopes().data_vars) == {"screw_torque", "d_screw_torque_d_axial_load"}
        assert "d_screw_torque_d_lead" in slopes(by=["lead"])
        assert "d_nut_torque_d_lead" in slopes(by=["lead"], outputs=["nut_torque"])


def test_only_so_many_are_kept(monkeypatch, recorded):
    monkeypatch.setattr(recordings, "MOST_STEPS", 1000)
    for diameter in np.linspace(0.002, 0.003, 20):
        swept(MODELS["corrected"], dataclasses.replace(SCREW, ball_diameter=float(diameter)))
    assert len(recorded) == 20
    # nothing public tells how much is kept
    assert recordings._kept._steps <= 1000
    swept(MODELS["corrected"], dataclasses.replace(SCREW, ball_diameter=0.003))
    assert len(recorded) == 20
    swept(MODELS["corrected"], dataclasses.replace(SCREW, ball_diameter=0.002))
    assert len(recorded) == 21


def test_threads_share_what_is_kept():
    expected = {d: anew(MODELS["corrected"], dataclasses.replace(SCREW, ball_diameter=d)) for d in (0.002, 0.003)}
    recordings.forget()
    together = threading.Barrier(8)

    def work(number):
        together.wait()
        diameter = (0.002, 0.003)[number % 2]
        found = [swept(MODELS["corrected"], dataclasses.replace(SCREW, ball_diameter=diameter)) for _ in range(5)]
        return all(same_bits(one, expected[diameter]) for one in found)

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(8)))


# -- never stale ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", MODELS)
def test_every_number_counts(name):
    """Of screw, oil, model and laws: changed in its last place, it is another recording."""
    model = MODELS[name]
    roomy = dataclasses.replace(SCREW, lead=0.020)  # for one start more
    subject = Configuration(model, dataclasses.replace(roomy, nut=bs.DoubleNut(1000.0, 0.01)), OIL)
    seen = {key_of(subject)}
    names = [name for name in subject.inputs if name not in OPERATION and not name.startswith("nut.")]
    unset = 0
    for name in names:
        value = subject.value_of(name)
        if value is None:
            unset += 1
            continue
        to = value + 1 if isinstance(value, int) else np.nextafter(value, 0 if value else 1)
        seen.add(key_of(subject.changed({name: float(to) if isinstance(value, float) else to})))
    assert len(seen) == 1 + len(names) - unset
    assert unset <= 3  # force between balls, offset of the lines of pure rolling, slope of the pressure modulus


@pytest.mark.parametrize(
    "change",
    [
        {"screw": {"ball_diameter": 0.003}},
        {"screw": {"nut_material": bs.Material(young_modulus=2.0e11)}},
        {"oil": {"viscosity": 0.2}},
        {"model": {"friction": bs.ZhouHoeprich(0.1)}},
        {"model": {"ball_friction_coefficient": 0.05}},
        {"model": {"ball_force": ball_chain.imposed_ball_force, "ball_to_ball_force": 0.05}},
        {"model": {"ball_force": ChainBallForce(gap=0.0)}},
        {"model": {"ball_chain": ball_chain.one_neighbour}},
        {"sweep": {"lead": 0.006}},
        {"sweep": {"friction.decay": 2.0}},
        {"sweep": {"axial_load": 100.0}},
    ],
    ids=lambda change: "-".join(name for part in change.values() for name in part),
)
def test_a_changed_constant_is_recorded_anew(change):
    first = swept(MODELS["corrected"])
    there = {"screw": SCREW, "oil": OIL, "model": MODELS["corrected"]}
    there = {name: dataclasses.replace(part, **change.get(name, {})) for name, part in there.items()}
    found = swept(there["model"], there["screw"], there["oil"], **change.get("sweep", {}))
    assert same_bits(found, anew(there["model"], there["screw"], there["oil"], **change.get("sweep", {})))
    assert not np.array_equal(found["screw_torque"], first["screw_torque"])


def test_zeros_of_both_signs_integers_and_nan_are_told_apart():
    keys = {
        key_of(value) for value in (0.0, -0.0, 0, False, None, "0", "0x0.0p+0", np.float64(0.0), np.zeros(()), b"0")
    }
    assert len(keys) == 10
    assert key_of(float("nan")) == key_of(float("nan"))


def closure(share):
    def snare_resistance(conditions):
        return share[0] * rolling.snare_resistance(conditions)

    return snare_resistance


SHARE = 1.0


def with_a_global(conditions):
    return SHARE * rolling.snare_resistance(conditions)


def with_an_attribute(conditions):
    return with_an_attribute.share * rolling.snare_resistance(conditions)


@dataclasses.dataclass(frozen=True)
class WithATable:
    table: dict

    def __call__(self, conditions):
        return self.table["share"] * rolling.snare_resistance(conditions)


def test_a_law_from_outside_is_never_stale(monkeypatch):
    """What it reads from elsewhere may change between two calls."""
    share, table = [1.0], {"share": 1.0}

    def change():
        share[0] = table["share"] = with_an_attribute.share = 3.0
        monkeypatch.setitem(globals(), "SHARE", 3.0)

    with_an_attribute.share = 1.0
    wrapped = functools.wraps(rolling.snare_resistance)(closure(share))
    for law in (closure(share), wrapped, with_a_global, with_an_attribute, WithATable(table)):
        model = dataclasses.replace(MODELS["corrected"], elastic_resistance=law)
        share[0] = table["share"] = with_an_attribute.share = 1.0
        monkeypatch.setitem(globals(), "SHARE", 1.0)
        before = swept(model)
        change()
        assert np.all(swept(model)["screw_torque"] > before["screw_torque"])
        with pytest.raises(UnknownPartError):
            key_of(model)


def test_a_replaced_equation_is_recorded_anew(monkeypatch):
    before = swept(MODELS["corrected"])
    thickness = film.minimum_film_thickness
    monkeypatch.setattr(film, "minimum_film_thickness", lambda *given: 1.1 * thickness(*given))
    found = swept(MODELS["corrected"])["screw_film_parameter"].isel(screw_speed=2)
    np.testing.assert_allclose(found, 1.1 * before["screw_film_parameter"].isel(screw_speed=2), rtol=1e-12)
    monkeypatch.undo()
    assert same_bits(swept(MODELS["corrected"]), before)
