"""``bs.optimise``: known optima, constraints equal to the checks one by one, members equal to the public check."""

import json
import math
import time
from importlib.util import find_spec

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Sheet
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.faces.sheets import files, terminal
from ballscrew.physics.equations import geometry
from ballscrew.questions.check.answer import checked
from ballscrew.questions.optimise import compute
from ballscrew.questions.optimise.answer import document
from ballscrew.questions.optimise.design_model import DesignModel, design_space, makeable_ratios
from ballscrew.questions.optimise.sheet import cost, of_optimisation, sheet
from ballscrew.questions.select import requirements
from ballscrew.questions.select.need import need_of
from ballscrew.questions.select.requirements import OBJECTIVES, front
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "needs" / "feed_axis.toml"
NEED = {
    "operation": {"axial_load": "6 kN", "feed": "15 m/min"},
    "installation": {"unsupported_length": "1 m", "ends": "fixed-supported"},
    "limits": {"running_time": "20000 h"},
    "nut": {"type": "double"},
    "need": {"largest_drive_torque": "40 N m", "least_rigidity": "500 N/um", "largest_preload_torque": "2 N m"},
}
needs_pymoo = pytest.mark.skipif(not find_spec("pymoo"), reason='needs pymoo, of the extra "optimise"')
NO_OPTIONS = {"model": None, "calibration": None, "allow_code": False}


def model_of(tables, engine="numpy", **options):
    need = need_of(tables)
    space = design_space(need, **options)
    centre = {name: math.sqrt(low * high) for name, (low, high) in space.bounds.items()}
    # the case that a search starts from; a search takes seconds
    case = compute._case(need, space, centre, NO_OPTIONS)
    return need, space, DesignModel.of(case, need, space, 1.0, engine)


def some_designs(space, count, seed=0):
    """Random designs that a maker could make."""
    x = space.lower + (space.upper - space.lower) * np.random.default_rng(seed).random((20 * count, len(space.names)))
    made = space.columns(x)
    ratios = {
        "ball_in_circle": made["ball_diameter"] / made["pitch_circle_diameter"],
        "ball_in_lead": made["ball_diameter"] / made["lead"],
        "lead_over_circle": made["lead"] / made["pitch_circle_diameter"],
    }
    fits = [(ratios[name] > low) & (ratios[name] < high) for name, (low, high) in makeable_ratios().items()]
    return x[np.all(fits, axis=0)][:count]


@pytest.mark.parametrize("nut", ["double", "single", pytest.param("oversize-balls", marks=pytest.mark.long)])
@needs_pymoo
def test_constraints_and_objectives_are_those_of_the_check(nut):
    """Arrays of designs against the full model and its checks one by one, with elastic bodies."""
    need, space, rigid = model_of(
        {**NEED, "nut": {"type": nut}}, objectives=["loss", "rigidity", "preload_torque", "life"]
    )
    elastic = rigid.elastic
    assert elastic is not None
    x = some_designs(space, 4)
    if "preload" in space.names:
        column = list(space.names).index("preload")
        x[:2, column] = space.lower[column] / 10  # so little that the load takes it all
    designs = elastic.designs(x)
    speed = elastic.speed(designs)
    # the state that objectives and checks share: one solution of it for both
    at = elastic._at(designs, 6000.0, speed)
    numbers = elastic.objectives(designs, speed, at)
    used = elastic.utilisations(designs, speed, at, numbers)
    if nut == "double":
        assert set(at["remaining_preload"] > 0) == {True, False}
        assert np.all((used["preload"] > 1) == (at["remaining_preload"] <= 0))
    for place in range(len(x)):
        variables = {name: float(values[place]) for name, values in space.columns(x).items()}
        balls, preload = float(designs.loaded_balls[place]), float(designs.preload[place])
        tables = compute.tables_of(need, space, variables, balls=balls, preload=preload)
        # one design by itself, as it is checked at the end of a search
        found = checked("design", compute._built(need, tables, NO_OPTIONS))
        for check in found.checks:
            if check.name in used:
                assert used[check.name][place] == pytest.approx(check.utilisation, rel=1e-6), check.name
        kept = requirements.kept_preload(found.nut.preload, 6000.0, found.nut.loads)
        assert ("preload" in used) is (kept is not None)
        if kept is not None:
            assert used["preload"][place] == pytest.approx(kept.utilisation, rel=1e-6)
        assert numbers["loss"][place] == pytest.approx(float(found.run.friction.friction_power), rel=1e-6)
        assert numbers["rigidity"][place] == pytest.approx(float(found.nut.loads.rigidity), rel=1e-6)
        assert numbers["preload_torque"][place] == pytest.approx(float(found.nut.preload_drag), rel=1e-6, abs=1e-12)
        assert numbers["life"][place] == pytest.approx(found.check("running_time").value, rel=1e-6)
        judged = {check.name for check in found.checks if check.utilisation is not None} - {"life"}
        assert judged <= set(used)


def test_the_search_finds_a_known_front():
    """x² + y² and (x - 2)² + y² for x + y >= 1: beyond x = 1 on y = 0, before it on the line, by Lagrange."""

    def evaluate(x):
        costs = np.column_stack([x[:, 0] ** 2 + x[:, 1] ** 2, (x[:, 0] - 2) ** 2 + x[:, 1] ** 2])
        return costs, (1 - x.sum(axis=1))[:, np.newaxis]

    found = compute.search(
        evaluate, np.array([-1.0, -1.0]), np.array([3.0, 3.0]), population=40, generations=60, seed=1
    )
    # by Lagrange on x + y = 1 from x = 1/2 to 1, and on y = 0 from there to 2
    x = np.linspace(0.5, 2, 400)
    y = np.maximum(1 - x, 0)
    known = np.column_stack([x**2 + y**2, (x - 2) ** 2 + y**2])
    excess = (found.costs[:, np.newaxis] - known).max(axis=2)
    assert excess.min(axis=1).max() < 0.03  # no member is far behind the front, nor before it
    assert excess.min(axis=1).min() > -0.01
    assert excess.min(axis=0).max() < 0.3  # and no part of it is left out
    assert np.all(found.designs.sum(axis=1) >= 1 - 1e-12)
    assert found.evaluations == 2400


@needs_pymoo
def test_a_bad_number_never_wins():
    def evaluate(x):
        return np.where(x < 0.5, np.nan, x), np.zeros((len(x), 0))

    found = compute.search(evaluate, np.zeros(1), np.ones(1), population=16, generations=20, seed=0)
    assert found.costs.min() == pytest.approx(0.5, abs=0.01)


@needs_pymoo
def test_a_shaft_that_may_not_buckle_has_the_diameter_of_euler():
    """The least inertia of a long pushed shaft: d_r⁴ = 64 S F l² / (β² π E), all sizes but the circle given."""
    tables = {
        "operation": {"axial_load": "15 kN", "screw_speed": "10 rpm"},
        "installation": {"unsupported_length": "3 m", "ends": "supported-supported"},
        "nut": {"type": "single"},
        "optimise": {
            "objectives": ["inertia"],
            "bounds": {
                "lead": "10 mm", "ball_diameter": "5 mm", "loaded_turns": 4,
                "pitch_circle_diameter": ["25 mm", "90 mm"],
            },
        },
    }  # fmt: skip
    found = bs.optimise(
        tables, population=24, generations=25, engine="numpy", settings=["optimise.elastic_generations=0"]
    )
    best = found.members[0]
    d_r = (64 * 2.0 * 15e3 * 3.0**2 / (math.pi**2 * math.pi * 206e9)) ** 0.25
    offset = 0.05 - geometry.groove_root_diameter(0.05, 0.005, 0.54, math.radians(45))
    assert best.variables["pitch_circle_diameter"] == pytest.approx(d_r + offset, rel=1e-3)
    assert best.fits
    assert {check.name: check for check in best.checks}["buckling"].utilisation == pytest.approx(1, rel=5e-3)
    assert best.objectives["inertia"] == pytest.approx(math.pi * 7850 * (d_r + offset) ** 4 * 3 / 32, rel=5e-3)


@pytest.mark.slow
@needs_pymoo
def test_the_front_beats_random_search_and_its_members_are_public(ballscrew, tmp_path):
    from pymoo.indicators.hv import HV

    tables = {**NEED, "nut": {"type": "single"}, "need": {}}
    found = bs.optimise(
        tables, population=40, generations=15, members=3, engine="numpy", settings=["optimise.elastic_generations=2"]
    )
    assert len(found.members) == 3
    assert all(each.holds and each.valid for each in found.members)
    assert max(found.largest_change.values()) < 1e-6  # the last generations have the bodies of the full model
    table = files.rows_of(of_optimisation(found.members))
    headings = dict(zip(table.headings, table.rows[1], strict=True))
    assert headings[units.heading(OBJECTIVES["loss"].quantity)] == pytest.approx(found.members[1].objectives["loss"])
    assert units.heading(OBJECTIVES["price_index"].quantity) not in headings
    _, space, model = model_of(tables)
    x = space.lower + (space.upper - space.lower) * np.random.default_rng(0).random((600, len(space.names)))
    costs, constraints = model.costs(x)
    alone = costs[(constraints <= 0).all(axis=1)]
    reference = np.array([200.0, 5e-3])
    hypervolume = HV(ref_point=reference)
    assert hypervolume(found.front.costs) > 1.02 * hypervolume(alone[front(alone)])
    one = found.members[1]
    path = tmp_path / "design.toml"
    screw = one.checked.case.screw
    path.write_text(
        f'[screw]\npitch_circle_diameter = "{screw.pitch_circle_diameter!r} m"\nlead = "{screw.lead!r} m"\n'
        f'ball_diameter = "{screw.ball_diameter!r} m"\nloaded_balls = {screw.loaded_balls}\ncontact_angle = "45 deg"\n'
        'screw_conformity = 0.54\nnut_conformity = 0.54\n[nut]\ntype = "single"\n[bodies]\n'
        '[lubricant]\ngrade = "ISO VG 100"\ntemperature = "40 degC"\n[operation]\naxial_load = "6 kN"\n'
        f'screw_speed = "{2 * math.pi * 0.25 / screw.lead!r} rad/s"\n[limits]\nrunning_time = "20000 h"\n'
        '[installation]\nunsupported_length = "1 m"\nends = "fixed-supported"\n',
        encoding="utf-8",
    )
    alone = json.loads(ballscrew("check", path, "--json").stdout)
    assert one.objectives["loss"] == pytest.approx(alone["results"]["friction_power"], rel=1e-9)
    assert [check.holds for check in one.checks] == [check["holds"] for check in alone["checks"]]


def test_a_quantile_is_on_the_bad_side_and_that_of_samples():
    tables = {**NEED, "nut": {"type": "single"}, "need": {}}
    _, _, nominal = model_of(tables, objectives=["loss", "inertia"])
    _, space, model = model_of(tables, objectives=["loss", "inertia"], quantile=0.9, samples=16)
    x = some_designs(space, 2)
    worse, central = model.costs(x)[0], nominal.costs(x)[0]
    assert np.all(worse[:, 0] > central[:, 0])
    assert np.all(worse[:, 1] == central[:, 1])
    # one design in all samples, by the model itself
    designs, case = model.designs(x), model.case
    subject = Configuration(case.model, case.screw, case.lubricant)
    sizes = ("pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls")
    values = {name: float(getattr(designs, name)[0]) for name in sizes}
    values |= {"axial_load": 6000.0, "screw_speed": float(model.speed(designs)[0])}
    varied = {name: f * values.get(name, subject.value_of(name)) for name, f in model.sampled.factors.items()}
    assert len(varied) > 10
    found = subject.at({**values, **varied}).friction_power
    assert worse[0, 0] == pytest.approx(np.quantile(found, 0.9), rel=1e-6)


@pytest.mark.parametrize(
    ("optimise", "words"),
    [
        ({"bounds": {"lead": ["40 mm", "5 mm"]}}, "lower and an upper bound"),
        ({"bounds": {"leed": "5 mm"}}, 'did you mean "lead"'),
        ({"bounds": {"lead": ["5 kg", "6 kg"]}}, "optimise.bounds.lead"),
        ({"objectives": ["price_index"]}, "unknown objective"),
        ({"objectives": 5}, "unknown objective"),
        ({"nut": "tripple"}, "unknown kind of nut"),
        ({"nut": ["single"]}, "unknown kind of nut"),
        ({"population": 2}, "optimise.population"),
        ({"quantile": 2.0}, "optimise.quantile"),
        ({"speed": 2.0}, "unknown key"),
    ],
)
def test_faults_of_the_space(optimise, words):
    with pytest.raises(InputError) as raised:
        design_space(need_of({**NEED, "optimise": optimise}))
    assert words in str(raised.value)


def test_without_pymoo_a_fault_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pymoo.core.problem", None)
    with pytest.raises(InputError, match=r'pip install "ballscrew\[optimise\]"'):
        # where a search begins, without the screws that it would need
        compute._pymoo()


@pytest.mark.slow
@needs_pymoo
def test_a_need_that_nothing_fulfils_ends_in_words(tmp_path):
    tables = {"force": "900 kN", "feed": "60 m/min", "nut": "single", "life": "20000 h"}
    options = {"population": 8, "generations": 2, "engine": "numpy", "settings": ["optimise.elastic_generations=1"]}
    found = bs.optimise(tables, **options)
    assert found.members == []
    assert "no design within the bounds passes all checks" in terminal.text(sheet(found))
    assert json.loads(json.dumps(plain(document(found))))["candidates"] == []
    files.write_tables(tmp_path / "empty.csv", Sheet("", [of_optimisation(found.members)]))
    files.write(tmp_path / "empty.svg", sheet(found))


@needs_pymoo
def test_an_objective_that_is_zero_has_no_change():
    """A single nut has no torque without load: the ratio of the full model to the search is left out, not divided."""
    need = need_of({**NEED, "nut": {"type": "single"}})
    space = design_space(need, objectives=["loss", "preload_torque"])
    numbers = ([2.0, 2.2, 0.0, 0.0], [4.0, 4.0, -0.0, 0.1])
    members = [
        compute.Member({}, {"loss": s, "preload_torque": m}, None, [], {"loss": full, "preload_torque": n}, {})
        for s, full, m, n in numbers
    ]
    found = compute.Optimisation(need, space, members, 0, None, ("", ""))
    assert found.largest_change == {"loss": pytest.approx(0.1)}


def test_a_motion_is_refused():
    with pytest.raises(InputError, match="is too much for a search"):
        bs.optimise(ROOT / "examples" / "vertical_axis.toml")


@pytest.mark.long
@pytest.mark.compiles
def test_twelve_thousand_designs_take_five_seconds():
    """Once the model is recorded and compiled, on a machine that does nothing else; the double nut is the slower."""
    _, space, model = model_of(NEED, engine="compiled")
    start = time.perf_counter()
    found = compute.search(model.costs, space.lower, space.upper, population=200, generations=60, seed=0)
    assert found.evaluations == 12_000
    assert time.perf_counter() - start < 5


@needs_pymoo
def test_the_search_tells_its_designs_and_what_it_costs():
    """Generation by generation of both searches, then the members: to the end, within what was planned before."""
    tables = {**NEED, "nut": {"type": "single"}, "need": {}}
    options = {"population": 20, "generations": 4, "members": 3, "settings": ["optimise.elastic_generations=2"]}
    planned = compute.plan(tables, **options)
    assert (planned.rigid, planned.elastic, planned.members, planned.total) == (80, 40, 3, 123)
    told = []
    found = bs.optimise(tables, engine="numpy", done=lambda *numbers: told.append(numbers), **options)
    assert told[:6] == [(20 * number, 123) for number in range(1, 7)]
    total = 120 + len(found.members)
    assert told[6:] == [(120 + number, total) for number in range(1, len(found.members) + 1)]
    assert found.members
    assert cost(planned).startswith("120 designs, then at most 3 in full: some ")
    larger = compute.plan(tables, **{**options, "generations": 40_000})
    assert larger.seconds > 10 * planned.seconds
