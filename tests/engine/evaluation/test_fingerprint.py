"""The fingerprint of a model that cannot be recorded: equal for equal models, in every process, and for no others."""

import dataclasses
import functools
import os
import subprocess
import sys
import threading
import time
import types

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis import version
from ballscrew.compiler.tracing.tape import CannotRecordError
from ballscrew.engine.evaluation import evaluation as evaluations
from ballscrew.engine.evaluation import fingerprint
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.equations import film

POINTS = {"axial_load": [500.0, 2000.0], "screw_speed": 30.0}
MODEL = bs.FrictionModel.olaru2005()
FILMS = np.array([0.0, 1.0, 3.0])


def with_nut(nut):
    return dataclasses.replace(SCREW, nut=nut)


def evaluation(model=MODEL, screw=SCREW, **points):
    return Evaluation.of(Plan.of(Configuration(model, screw, OIL), None, POINTS | points), "numpy")


def fingerprint_of(friction, **options):
    made = evaluation(dataclasses.replace(MODEL, friction=friction), **options)
    assert made.identity.unknown == "", made.identity.unknown
    assert "the model itself" in made.reason
    return made.fingerprint


class Tabulated:
    def __init__(self, coefficients):
        self.coefficients = coefficients

    def __call__(self, conditions):
        return self.at(conditions.film_parameter)

    def at(self, film):
        return np.interp(film, FILMS, self.coefficients)


class Slotted:
    __slots__ = ("scale",)

    def __init__(self, scale):
        self.scale = scale

    def __call__(self, conditions):
        return self.scale * np.interp(conditions.film_parameter, FILMS, [0.2, 0.1, 0.02])


class Property:
    def __init__(self, scale):
        self.scale = scale

    @functools.cached_property
    def table(self):
        return self.scale * np.array([0.2, 0.1, 0.02])

    def __call__(self, conditions):
        return np.interp(conditions.film_parameter, FILMS, self.table)


def of_closure(table):
    def friction(conditions):
        return np.interp(conditions.film_parameter, FILMS, table)

    return friction


def of_default(scale):
    def friction(conditions, table=(0.2 * scale, 0.1 * scale, 0.02 * scale)):
        return np.interp(conditions.film_parameter, FILMS, table)

    return friction


def of_keyword_default(scale):
    def friction(conditions, *, share=scale):
        return share * np.interp(conditions.film_parameter, FILMS, [0.2, 0.1, 0.02])

    return friction


def shared(conditions, scale):
    return scale * np.interp(conditions.film_parameter, FILMS, [0.2, 0.1, 0.02])


def of_partial(scale):
    return functools.partial(shared, scale=scale)


def of_method(scale):
    return Slotted(scale).__call__


def of_vectorized(scale):
    law = np.vectorize(lambda film: scale / (1 + film))
    return lambda conditions: law(conditions.film_parameter)


def of_nested_code(scale):
    # the same constants in the outer code, others in that of the generator expression
    inner = {1.0: "0.1", 1.1: "0.11"}[scale]
    space = {"np": np}
    exec(
        f"def friction(conditions):\n"
        f"    return np.interp(conditions.film_parameter, (0.0, 3.0), [x * {inner} for x in (1.0, 0.5)])",
        space,
    )
    return space["friction"]


def module_of(source, **values):
    module = types.ModuleType("module_held_by_a_law")
    module.__dict__.update(values, np=np)
    exec(source, module.__dict__)
    return module


HELPED = """
def helper(film):
    return np.interp(film, [0.0, 3.0], [{0}, 0.02])

def friction(conditions):
    return helper(conditions.film_parameter)
"""
GLOBAL = """
def friction(conditions):
    return np.interp(conditions.film_parameter, [0.0, 3.0], table)
"""


def of_helper(scale):
    return module_of(HELPED.format(0.1 * scale)).friction


def of_global(scale):
    return module_of(GLOBAL, table=np.array([0.1 * scale, 0.02])).friction


def of_module(scale):
    """The law reaches a function of another module, by its name in that module."""
    laws = module_of(HELPED.format(0.1 * scale))
    source = "def friction(conditions):\n    return laws.helper(conditions.film_parameter)"
    return module_of(source, laws=laws).friction


MADE = {
    "an attribute": lambda scale: Tabulated(scale * np.array([0.2, 0.1, 0.02])),
    "a slot": Slotted,
    "a cached property": Property,
    "an array in a closure": lambda scale: of_closure(scale * np.array([0.2, 0.1, 0.02])),
    "a default": of_default,
    "a default of a keyword": of_keyword_default,
    "a partial argument": of_partial,
    "the object of a method": of_method,
    "a vectorized function": of_vectorized,
    "a constant of nested code": of_nested_code,
    "a helper": of_helper,
    "a global": of_global,
    "a function of a module": of_module,
}


@pytest.mark.slow
@pytest.mark.parametrize("held", MADE)
def test_all_that_a_law_holds_counts(held):
    make = MADE[held]
    assert fingerprint_of(make(1.0)) != fingerprint_of(make(1.1))
    law = make(1.0)
    assert fingerprint_of(law) == fingerprint_of(make(1.0)) == fingerprint_of(law)


class Stribeck(Tabulated):
    """Another class with the same values: its own code counts, and that of the class below."""

    def at(self, film):
        return 1.1 * super().at(film)


def test_the_code_of_methods_counts():
    assert fingerprint_of(Tabulated([0.2, 0.1, 0.02])) != fingerprint_of(Stribeck([0.2, 0.1, 0.02]))


NUTS = {
    "row": bs.SingleNut(),
    "single": bs.SingleNut(angle_under_load=True),
    "double": bs.DoubleNut(preload=1000.0),
    "ball by ball": bs.SingleNut(bodies=bs.Bodies()),
    "double, ball by ball": bs.DoubleNut(preload=1000.0, bodies=bs.Bodies()),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", NUTS)
def test_an_equation_of_the_package_counts(kind, monkeypatch):
    """One equation of shipped laws is changed under the same version."""
    screw = with_nut(NUTS[kind])
    before = evaluation(screw=screw)
    assert before.identity.unknown == ""
    assert "the model itself" not in before.reason
    assert evaluation(screw=screw).fingerprint == before.fingerprint
    before.fill(before.empty(2), slice(0, 2))
    assert evaluation(screw=screw).fingerprint == before.fingerprint
    thickness = film.minimum_film_thickness
    monkeypatch.setattr(film, "minimum_film_thickness", lambda *given: 1.1 * thickness(*given))
    assert evaluation(screw=screw).fingerprint != before.fingerprint


def test_the_source_of_the_package_counts(monkeypatch):
    """Of what is not recorded."""
    screw = with_nut(NUTS["ball by ball"])
    before = evaluation(screw=screw).fingerprint
    monkeypatch.setattr(evaluations, "package_digest", lambda: "another source")
    assert evaluation(screw=screw).fingerprint != before


@pytest.mark.slow
@pytest.mark.parametrize("kind", NUTS)
def test_losses_of_a_nut_count(kind):
    def fingerprint(scale):
        def seal(screw, lubricant, screw_speed):
            return scale

        return evaluation(screw=with_nut(dataclasses.replace(NUTS[kind], losses={"seals": seal}))).fingerprint

    assert fingerprint(0.1) != fingerprint(0.2)
    assert fingerprint(0.1) == fingerprint(0.1)


def test_balls_that_differ_are_not_recorded():
    """Not by points alone, as balls that are alike are: by points and balls (``test_by_ball``)."""
    for kind, nut in NUTS.items():
        subject = Configuration(MODEL, with_nut(nut), OIL)
        plan = Plan.of(subject, ["screw_torque"], POINTS)
        if not nut.one_by_one:
            assert plan.recorded().outputs, kind
            continue
        with pytest.raises(CannotRecordError, match="solved one by one, on plain arrays"):
            plan.recorded()


def test_what_is_varied_does_not_count():
    """The value that a field had before it was varied changes no result."""
    law = Tabulated([0.2, 0.1, 0.02])
    other = dataclasses.replace(SCREW, nut_conformity=0.53)
    same = [fingerprint_of(law, screw=screw, nut_conformity=[0.52, 0.54]) for screw in (SCREW, other)]
    assert same[0] == same[1]
    assert fingerprint_of(law, screw=other) != fingerprint_of(law)


def test_what_a_law_computes_with_besides_values_cannot_be_known():
    def reading(conditions):
        return np.interp(conditions.film_parameter, FILMS, float(open("friction.txt").read()))  # noqa: PTH123  (a call of open is the test)

    lock = threading.Lock()

    def locked(conditions):
        with lock:
            return np.interp(conditions.film_parameter, FILMS, FILMS)

    for law, why in ((reading, "open"), (locked, "lock")):
        model = dataclasses.replace(MODEL, friction=law)
        made = [
            Evaluation.of(Plan.of(Configuration(model, with_nut(NUTS["ball by ball"]), OIL), None, POINTS))
            for _ in "ab"
        ]
        assert made[0].fingerprint != made[1].fingerprint
        assert why in made[0].identity.unknown


def test_recorded_functions_of_other_libraries_count():
    """A step is known by the name of its function; of NumPy and SciPy that is enough, of others it is not."""
    from scipy import special

    def law(function):
        def friction(conditions):
            return 0.1 + 0.01 * function(conditions.film_parameter)

        return dataclasses.replace(MODEL, friction=friction)

    made = [evaluation(law(function)) for function in (np.exp, special.erf, special.erf, special.erfc)]
    assert all(each.reason == "it was asked for" and not each.identity.unknown for each in made)
    assert made[1].fingerprint == made[2].fingerprint
    assert len({each.fingerprint for each in made}) == 3
    assert evaluation(law(np.frompyfunc(abs, 1, 1))).identity.unknown == "the compiled function abs (vectorized)"


IN_ANOTHER_PROCESS = """
import dataclasses, sys
import numpy as np
import ballscrew as bs
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW

NAMES = {"dry", "mixed", "full film", "boundary"}
TABLE = {name: 0.1 for name in NAMES}

class Law:
    def __init__(self):
        self.names = NAMES
        self.table = TABLE

    def __call__(self, conditions):
        known = "dry" in {"dry", "mixed", "full film"}
        return np.interp(conditions.film_parameter, [0.0, 3.0], [self.table["dry"] * known, 0.02])

model = dataclasses.replace(bs.FrictionModel.reference(), friction=Law())
points = {"axial_load": [500.0, 2000.0], "screw_speed": 30.0}
double = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=1000.0, bodies=bs.Bodies()))
if "late" in sys.argv:  # modules that are loaded already change nothing
    import ballscrew.faces.cli.main, ballscrew.engine.uncertainty.bands
for subject in (
    Configuration(model, SCREW, OIL),
    Configuration(bs.FrictionModel.reference(), double, OIL),
):
    made = Evaluation.of(Plan.of(subject, None, points), "numpy")
    print(made.fingerprint, made.identity.unknown)
"""


@pytest.mark.slow
def test_it_is_the_same_in_every_process():
    said = [
        subprocess.run(
            [sys.executable, "-c", IN_ANOTHER_PROCESS, *late],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
            text=True,
        ).stdout
        for seed, late in (("1", []), ("2", ["late"]))
    ]
    assert said[0] == said[1]
    assert [len(line.split()) for line in said[0].splitlines()] == [1, 1]


@pytest.mark.slow
def test_a_law_sent_to_another_process_is_the_same():
    cloudpickle = pytest.importorskip("cloudpickle", reason="cloudpickle is not installed (the extra cluster)")
    cloudpickle.register_pickle_by_value(sys.modules[__name__])
    try:
        for held, make in MADE.items():
            if held == "a cached property":  # before Python 3.12 it has a lock
                continue
            law = make(1.0)
            sent = cloudpickle.loads(cloudpickle.dumps(law))
            assert fingerprint_of(sent) == fingerprint_of(law), held
    finally:
        cloudpickle.unregister_pickle_by_value(sys.modules[__name__])


@pytest.mark.parametrize("name", ["exports/wasm_modules.py", "data/oil_grades.toml", "physics/friction/model.py"])
def test_whatever_modules_and_kernels_follow_from_counts(monkeypatch, tmp_path, name):
    file = tmp_path / name
    file.parent.mkdir(parents=True)
    monkeypatch.setattr(fingerprint, "_FOLDER", tmp_path)
    monkeypatch.setattr(version, "IMPORTED_AT", time.time() + 60.0, raising=False)
    found = []
    for content in ("a", "b", "a"):
        file.write_text(content)
        found.append(fingerprint.recorder_digest.__wrapped__())
    assert found[0] == found[2] != found[1]
