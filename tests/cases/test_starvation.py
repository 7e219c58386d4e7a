"""A cold, thick oil: the torque of the starved track never stands without that of the full bath."""

import copy
import dataclasses
import json

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis.output.sheet import Columns, Number, Table, words
from ballscrew.cases.case_files import case_file
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.faces.sheets import terminal
from ballscrew.physics.laws.inlet import Inlet
from ballscrew.questions.band import BandOptions, compute
from ballscrew.questions.band.answer import verdicts
from ballscrew.questions.check import answer as check
from ballscrew.questions.check.sheet import of_rows
from ballscrew.questions.duty import answer
from ballscrew.questions.duty.compute import duty
from ballscrew.questions.run import answer as run_documents
from ballscrew.questions.run.compute import run
from ballscrew.questions.run.sheet import SHOWN, results_table
from ballscrew.questions.run.sheet import meaning as meaning_of
from ballscrew.questions.run.sheet import of_rows as run_of_rows
from ballscrew.questions.service import answer as service_documents
from ballscrew.questions.service.compute import Reading, of_torque
from ballscrew.questions.shared import every_row
from ballscrew.questions.sweep import answer as sweep_documents
from ballscrew.questions.sweep import compute as sweep
from ballscrew.questions.sweep import table
from ballscrew.questions.sweep.band import with_band
from ballscrew.questions.warm_up import answer as warm_up_documents
from ballscrew.questions.warm_up import self_heating
from ballscrew.questions.warm_up.compute import warmed_up
from support.commands import ROOT

COLD = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "nut": {"type": "double", "preload": "7 %"},
    "lubricant": {"grade": "ISO VG 220", "temperature": "5 degC"},
    "operation": {"axial_load": "3 kN", "screw_speed": "1000 rpm"},
}


BATH = "model.inlet.replenishment_constant=0"
#: A cycle whose screw can be starved has states where either condition turns, one in a full bath its own alone: other
#: nodes, which integrate friction near rest to 1e-4, and another polynomial through them, with its largest value 2e-6
#: off.
OF_NODES, OF_TURNS = 1e-4, 1e-5


def record_of(document):
    """The one record of starvation, among the warnings or the verdicts; None where there is none."""
    found = [one for one in (*document["warnings"], *document["verdicts"]) if one["id"] == "lubricant.starved"]
    assert len(found) < 2
    return found[0] if found else None


def case_with(temperature="5 degC", constant=None):
    tables = copy.deepcopy(COLD)
    tables["lubricant"]["temperature"] = temperature
    if constant is not None:
        tables["model"] = {"inlet": {"law": "heated", "replenishment_constant": constant}}
    return case_file.build(tables)


def verdicts_of(case):
    return {record["id"]: record for record in run_documents.document(run(case))["verdicts"]}


def test_a_starved_torque_stands_beside_that_of_the_full_bath():
    bath = run(case_with(constant=0.0))
    flooded = float(bath.friction.screw_torque)
    starved = verdicts_of(case_with())["lubricant.starved"]
    assert starved["value"] == pytest.approx(flooded, rel=1e-12)
    assert starved["unit"] == "N m"
    assert starved["severity"] == "warning"
    assert f"{flooded:.4g} N m in a full bath of oil" in starved["text"]
    assert starved["limit"] == float(run(case_with()).friction.screw_torque)
    assert bath.friction.flooded_torque == flooded
    assert "lubricant.starved" not in verdicts_of(case_with("60 degC"))


def test_what_friction_holds_in_motion_alone_is_no_self_locking():
    found = verdicts_of(case_with(constant=0.0))
    assert "verdict.self_locking" not in found
    assert "it needs a brake" in found["verdict.held_in_motion"]["text"]
    assert found["verdict.held_in_motion"]["severity"] == "warning"
    assert found["verdict.held_in_motion"]["value"] < 0 < found["verdict.back_driving.at_rest"]["value"]


def test_the_band_says_where_the_full_bath_lies():
    case = case_with()
    report = compute.band(case, compute.BandOptions(samples=2, only_given=True))
    found = {record.id: record for record in verdicts(case, report)}["band.flooded"]
    assert found.value == run(case).friction.flooded_torque
    assert found.limit == report.band["screw_torque"].both.high
    assert f"a full bath of oil, {found.value:.4g} N m" in found.text
    assert "inlet" in report.band.alternatives
    # of a fit, which exchanges no law, the band is of one track
    alone = dataclasses.replace(report, band=dataclasses.replace(report.band, alternatives={}))
    said = {record.id: record for record in verdicts(case, alone)}["band.flooded"]
    assert said.text.startswith("the band takes oil to come back into the track late")


@pytest.mark.slow
@pytest.mark.parametrize("load", ["500 N", "5 kN"])
def test_the_band_holds_both_torques_that_are_named(load):
    """Also under a light load, where balls in thick oil skid in a full bath alone."""
    tables = case_file.read(ROOT / "examples" / "feed_drive.toml")
    tables["lubricant"] = {"oil": "Arcanol LOAD150", "temperature": "-10 degC"}
    tables["operation"]["axial_load"] = load
    case = case_file.build(tables)
    report = compute.band(case, compute.BandOptions(samples=512))
    found, both = run(case).friction, report.band["screw_torque"].both
    assert found.starvation
    assert both.low <= found.screw_torque < found.flooded_torque == report.flooded_torque <= both.high
    assert "inlet" in report.band.alternatives
    rows = {name: [*map(words, numbers)] for name, *numbers in results_table(run(case), SHOWN).rows}
    assert rows["friction torque on the screw"] == [f"{found.screw_torque:.4g} N m", f"{found.flooded_torque:.4g} N m"]
    # beside each result that of the model in a full bath
    operation = {name: getattr(case.operation, name) for name in ("axial_load", "screw_speed")}
    flooded = case.model.in_full_bath(case.screw, case.lubricant, **operation)
    for name in ("drive_torque", "holding_torque", "efficiency", "back_driving_efficiency", "friction_power"):
        meaning, number = run(case).quantities[name], float(getattr(flooded, name))
        assert rows[meaning_of(name)][1] == words(Number(number, meaning)), name


def tables_of_duty(temperature, *settings):
    tables = case_file.read(ROOT / "examples" / "vertical_axis.toml")
    return case_file.override(tables, [f"lubricant.temperature={temperature}", *settings])


def document_of_duty(temperature, *settings):
    case = case_file.build(tables_of_duty(temperature, *settings), moves=True)
    return answer.document(duty(case))


@pytest.mark.slow
def test_a_cold_cycle_stands_beside_that_of_a_full_bath():
    cold = document_of_duty("-5 degC")
    bath = document_of_duty("-5 degC", BATH)
    record = record_of(cold)
    found, full = cold["results"], cold["results"]["full_bath"]
    assert found["flooded_torque"] == full["torque_peak"] == record["value"]
    assert full["torque_peak"] == pytest.approx(bath["results"]["torque_peak"], rel=OF_TURNS)
    assert record["limit"] == found["torque_peak"] < record["value"]
    assert cold["units"]["flooded_torque"] == record["unit"] == "N m"
    for name in ("torque_rms", "energy_lost", "screw_torque", "power_peak", "energy_drawn", "energy_returned"):
        assert full[name] == pytest.approx(bath["results"][name], rel=OF_NODES), name
    assert full["energy_lost"] > 3.5 * found["energy_lost"]
    assert full["screw_torque"] > 3 * found["screw_torque"]
    assert f"{full['energy_lost']:.4g} J" in record["text"]
    of_bath = dict(zip(*(bath["results"]["cycle"][name] for name in ("time", "torque")), strict=True))
    of_cold = dict(zip(*(found["cycle"][name] for name in ("time", "flooded_torque")), strict=True))
    same = of_bath.keys() & of_cold.keys()
    assert len(same) > len(of_bath) / 4
    assert {time: of_cold[time] for time in same} == pytest.approx({time: of_bath[time] for time in same}, rel=1e-9)
    assert bath["results"]["cycle"]["flooded_torque"] is None


def test_a_warm_cycle_and_one_in_a_full_bath_are_not_starved_and_have_the_torque_of_the_bath_too():
    for settings in ((), (BATH,)):
        warm = document_of_duty("60 degC", *settings)
        assert record_of(warm) is None
        assert warm["results"]["flooded_torque"] == pytest.approx(warm["results"]["torque_peak"], rel=0.01)
    ruled = document_of_duty("-5 degC", "model.name=constant-efficiency", "model.efficiency=0.9")
    assert record_of(ruled) is None
    assert ruled["results"]["flooded_torque"] is None
    assert ruled["results"]["full_bath"] is None


def test_the_motor_is_judged_by_the_larger_torque_and_the_brake_by_the_smaller():
    settings = ("motor.rated_torque=20 N m", "motor.peak_torque=28.5 N m", "motor.curve=[]")
    cold, bath = document_of_duty("-5 degC", *settings), document_of_duty("-5 degC", *settings, BATH)
    of_cold, of_bath = ({check["name"]: check for check in one["checks"]} for one in (cold, bath))
    starved = cold["results"]["torque_peak"]
    assert starved < 28.5 < of_bath["motor_peak_torque"]["value"]
    assert of_cold["motor_peak_torque"]["value"] == pytest.approx(of_bath["motor_peak_torque"]["value"], rel=OF_TURNS)
    assert of_cold["motor_peak_torque"]["text"].endswith(", in a full bath of oil")
    assert cold["results"]["motor"]["suffices"] is False
    assert cold["results"]["motor"]["worst"]["condition"] == "in a full bath of oil"
    loss = bath["results"]["motor"]["copper_loss"]
    assert cold["results"]["motor"]["flooded_copper_loss"] == pytest.approx(loss, rel=OF_NODES)
    said = {record["id"]: record["text"] for record in cold["verdicts"]}
    assert "judged by the larger torque: peak and RMS in a full bath of oil" in said["verdict.motor"]
    assert "the smaller friction, that of the track starved of oil" in said["verdict.brake"]
    assert cold["results"]["brake"]["holding_torque"] >= bath["results"]["brake"]["holding_torque"]


def document_of_warm_up(ambient, *settings):
    settings = (f"surroundings.ambient={ambient}", *settings)
    return warm_up_documents.document(
        warmed_up(case_file.load(ROOT / "examples" / "warm_up.toml", settings, moves=True))
    )


def test_a_cold_start_stands_beside_that_of_a_full_bath():
    cold, bath = document_of_warm_up("-5 degC"), document_of_warm_up("-5 degC", BATH)
    record, found = record_of(cold), cold["results"]
    start = bath["results"]["screw_torque"][0]
    assert found["flooded_torque"] == record["value"] == pytest.approx(start, rel=1e-12)
    assert record["limit"] == found["screw_torque"][0] < 0.1 * start
    assert cold["units"]["flooded_torque"] == record["unit"] == "N m"
    full = found["full_bath"]
    for name in ("screw_torque", "oil_temperature", "shaft_growth"):  # heat of its own, and so a way of its own
        assert full[name] == pytest.approx(bath["results"][name], rel=1e-9)
    assert full["equilibrium"]["screw_torque"] == pytest.approx(bath["results"]["equilibrium"]["screw_torque"])
    assert f"{full['equilibrium']['screw_torque']:.4g} N m" in record["text"]
    assert full["equilibrium"]["oil_temperature"] > found["equilibrium"]["oil_temperature"] + 5
    assert record_of(bath) is None
    assert bath["results"]["flooded_torque"] == start
    assert bath["results"]["full_bath"] is None


def test_a_warm_start_has_the_torque_of_the_bath_and_no_second_way():
    warm, bath = document_of_warm_up("45 degC"), document_of_warm_up("45 degC", BATH)
    assert record_of(warm) is None
    assert warm["results"]["full_bath"] is None
    assert warm["results"]["flooded_torque"] == pytest.approx(bath["results"]["screw_torque"][0], rel=1e-3)
    assert warm["results"]["flooded_torque"] > warm["results"]["screw_torque"][0]


SPEEDS_AND_OILS = ("screw_speed=100:1500:8 rpm", "temperature=-10:60:8 degC")


def swept(case, vary=SPEEDS_AND_OILS, **options):
    plan = sweep.plan(case, vary, ["screw_torque", "flooded_torque"], None, **options)
    return plan, sweep.sweep(case, plan)


def test_a_sweep_has_both_torques_where_it_is_starved_the_most_in_its_attributes():
    case = case_with("40 degC")
    plan, found = swept(case)
    ratio = (found["flooded_torque"] / found["screw_torque"]).to_numpy()
    document = sweep_documents.document(case, plan, found)
    record = record_of(document)
    at = np.unravel_index(np.argmax(ratio), ratio.shape)
    assert ratio[at] > 5
    assert record["value"] == pytest.approx(found["flooded_torque"].to_numpy()[at], rel=1e-5)
    assert record["limit"] == pytest.approx(found["screw_torque"].to_numpy()[at], rel=1e-5)
    assert found.attrs["most_starved_flooded_torque"] == record["value"]
    assert "starved" in found.attrs["warnings"]
    assert document["outputs"]["flooded_torque"]["unit"] == "N m"
    bath = case_with("40 degC", 0.0)
    plan, found = swept(bath)
    assert "most_starved_torque" not in found.attrs
    assert "starved" not in found.attrs.get("warnings", "")
    assert record_of(sweep_documents.document(bath, plan, found)) is None
    assert found["flooded_torque"].equals(found["screw_torque"])


COLD_TO_WARM = ("temperature=-10, 0, 40 degC",)


def paired(case, vary, outputs, to=None, *, as_table=False, **options):
    return sweep.with_flooded_torque(case, sweep.plan(case, vary, outputs, to, **options), as_table=as_table)


def test_a_sweep_has_the_full_bath_beside_the_torque_where_some_of_its_points_are_starved():
    case = case_with("40 degC")
    plan = paired(case, COLD_TO_WARM, ["efficiency", "screw_torque"])
    assert plan.outputs == ("efficiency", "screw_torque", "flooded_torque")
    found = sweep.sweep(case, plan)
    outputs = sweep_documents.document(case, plan, found)["outputs"]
    for place, temperature in enumerate(("-10 degC", "0 degC", "40 degC")):
        there = run(case_with(temperature))
        assert outputs["screw_torque"]["values"][place] == pytest.approx(float(there.friction.screw_torque), rel=1e-9)
        assert outputs["flooded_torque"]["values"][place] == pytest.approx(
            float(there.friction.flooded_torque), rel=1e-9
        )
    assert outputs["flooded_torque"]["meaning"] == there.quantities["flooded_torque"].info.meaning


def test_a_sweep_without_starved_points_has_one_torque_and_so_have_those_with_a_full_bath_of_their_own():
    case, torque = case_with("40 degC"), ["screw_torque"]
    assert paired(case, ("temperature=60, 80 degC",), torque).outputs == ("screw_torque",)
    assert paired(case_with("40 degC", 0.0), COLD_TO_WARM, torque).outputs == ("screw_torque",)
    assert paired(case, COLD_TO_WARM, ["efficiency"]).outputs == ("efficiency",)
    assert paired(case, (*COLD_TO_WARM, "inlet.replenishment_constant=0, 3e-8"), torque).outputs == ("screw_torque",)
    # one output over two axes is a table on the terminal
    assert paired(case, SPEEDS_AND_OILS, torque, as_table=True).outputs == ("screw_torque",)
    assert paired(case, SPEEDS_AND_OILS, torque).outputs == ("screw_torque", "flooded_torque")
    assert paired(case, SPEEDS_AND_OILS, [*torque, "flooded_torque"]).outputs == ("screw_torque", "flooded_torque")


@pytest.mark.slow
def test_a_sweep_with_bands_has_the_full_bath_as_it_is_beside_them():
    case = case_with("40 degC")
    plan = paired(case, COLD_TO_WARM, ["screw_torque"], banded=True)
    assert plan.columns == ("screw_torque", "screw_torque_low", "screw_torque_high", "flooded_torque", "valid")
    found = with_band(case, plan, sweep.sweep(case, plan), BandOptions(samples=64), inner=(0.5,))
    outputs = sweep_documents.document(case, plan, found)["outputs"]
    assert outputs["flooded_torque"].keys() == {"values", "unit", "meaning"}
    assert outputs["screw_torque"]["inner"]
    one = run(case_with("-10 degC")).friction
    assert outputs["flooded_torque"]["values"][0] == pytest.approx(float(one.flooded_torque), rel=1e-9)


@pytest.mark.slow
def test_a_store_has_the_full_bath_beside_the_torque(tmp_path):
    case, to = case_with("40 degC"), tmp_path / "map.zarr"
    plan = paired(case, COLD_TO_WARM, ["screw_torque"], to)
    found = sweep.sweep(case, plan, to=to)
    assert set(plan.outputs) == {"screw_torque", "flooded_torque"} < set(map(str, found.data_vars))
    one = run(case_with("-10 degC")).friction
    assert found["flooded_torque"].to_numpy()[0] == pytest.approx(float(one.flooded_torque), rel=1e-9)


def test_the_drag_torque_of_a_starved_nut_stands_beside_that_of_the_full_bath():
    cold, bath = run(case_with()), run(case_with(constant=0.0))
    assert cold.nut.flooded_drag == pytest.approx(bath.nut.preload_drag, rel=1e-12)
    assert cold.nut.flooded_drag > 1.1 * cold.nut.preload_drag
    assert bath.nut.flooded_drag == bath.nut.preload_drag
    rows = {name: cells for name, *cells in results_table(cold, SHOWN).rows}
    shown = [cell.value for cell in rows["drag torque without seals"]]
    assert shown == pytest.approx([cold.nut.preload_drag, cold.nut.flooded_drag], rel=1e-12)


ROWS = """name;d0 [mm];Ph [mm];Dw [mm];i;Ca [kN];Preload;Nut
A;40;10;6,35;4;50,3;7 %;double
B;20;2;1,2;4;5;;single
"""


def rows_at(temperature, folder):
    """The runs of two screws of a table."""
    tables = copy.deepcopy(COLD)
    tables["lubricant"]["temperature"] = temperature
    (folder / "case.json").write_text(json.dumps(tables), encoding="utf-8")
    (folder / "own.csv").write_text(ROWS, encoding="utf-8")
    return every_row.cases(folder / "case.json", folder / "own.csv")


@pytest.mark.parametrize(("temperature", "is_starved"), [("-10 degC", True), ("60 degC", False)])
def test_screws_of_a_table_have_both_where_one_is_starved(temperature, is_starved, tmp_path):
    cases = rows_at(temperature, tmp_path).found
    runs = {name: run(each.case) for name, each in cases.items()}
    checks = {name: check.checked(name, each.case) for name, each in cases.items()}
    for seen in (run_of_rows(runs), of_rows(list(checks.values()))):
        (table,) = seen.of_kind(Table)
        (columns,) = seen.of_kind(Columns)
        names = [row[0] for row in table.rows]
        heading = "screw_torque in a full bath of oil"
        assert ("  in a full bath of oil" in names) == is_starved
        assert (heading in [column.name for column in columns.columns]) == is_starved
        assert ("no measurement on a ball screw decides" in terminal.text(seen).replace("\n    ", " ")) == is_starved
        if is_starved:
            flooded = float(runs["A"].friction.flooded_torque)
            row = table.rows[names.index("  in a full bath of oil")]
            assert names.index("  in a full bath of oil") == names.index("A") + 1
            assert flooded in [cell.value for cell in row if isinstance(cell, Number)]
            assert flooded > 1.1 * float(runs["A"].friction.screw_torque)
            assert len(row) == len(table.columns)


def test_a_sweep_of_the_screws_of_a_table_has_both_for_all_where_one_is_starved(tmp_path):
    cases = rows_at("-10 degC", tmp_path).found
    planned = table.plans(cases, ["axial_load=1, 3 kN"], ["screw_torque"], None, False).found
    assert {plan.outputs for _, plan in planned.values()} == {("screw_torque", "flooded_torque")}
    found, _ = table.sweep(planned, None)
    flooded = float(run(cases["A"].case).friction.flooded_torque)
    assert found["flooded_torque"].sel(screw="A").to_numpy()[1] == pytest.approx(flooded, rel=1e-9)
    assert np.isfinite(found["flooded_torque"].to_numpy()).all()


@pytest.mark.slow
def test_a_sweep_that_heats_itself_is_judged_at_the_oil_as_warm_as_it_becomes():
    case = case_with("-5 degC")  # the oil that is given, which no point of a warm hall has
    case = dataclasses.replace(case, surroundings=Surroundings(ambient=330.0))
    _, cold = swept(case, SPEEDS_AND_OILS[:1])
    _, warm = swept(case, SPEEDS_AND_OILS[:1], heats=True)
    assert cold.attrs["most_starved_torque"] < 0.5 * cold.attrs["most_starved_flooded_torque"]
    assert "most_starved_torque" not in warm.attrs


def test_self_heating_says_what_a_full_bath_would_end_in():
    settings = ["surroundings.ambient=-5 degC", "lubricant.temperature=-5 degC"]
    cold = self_heating.self_heating(case_file.load(ROOT / "examples" / "warm_up.toml", settings, moves=True))
    bath = self_heating.self_heating(case_file.load(ROOT / "examples" / "warm_up.toml", [*settings, BATH], moves=True))
    found = cold.numbers
    assert found.flooded_torque == pytest.approx(bath.numbers.screw_torque, rel=1e-6)
    assert found.flooded_torque_given == pytest.approx(bath.numbers.screw_torque_given, rel=1e-9)
    assert found.flooded_oil_temperature == pytest.approx(bath.numbers.oil_temperature, abs=1e-3)
    document = cold.within(run_documents.document(run(cold.warm)))
    (record,) = [r for r in document["verdicts"] if r["subject"] == "self_heating.screw_torque"]
    assert record["id"] == "lubricant.starved"
    assert (record["value"], record["limit"]) == (found.flooded_torque, found.screw_torque)
    assert [r.id for r in bath.records] == ["verdict.self_heating"]
    assert bath.numbers.flooded_torque == bath.numbers.screw_torque


def log_of(case, temperatures):
    """Torques of the model itself without load, at two speeds both ways."""
    speeds = np.tile([20.0, 60.0, -20.0, -60.0], 8)
    warm = np.repeat(np.linspace(*temperatures, 8), 4)
    load = np.zeros_like(speeds)
    found = case.model(case.screw, case.lubricant.at(warm), axial_load=load, screw_speed=speeds)
    torque = np.sign(speeds) * np.asarray(found.screw_torque)
    return {"axial_load": load, "screw_speed": speeds, "temperature": warm, "torque": torque}


@pytest.mark.slow
def test_a_fit_says_that_its_log_is_of_a_starved_model():
    case = case_with("20 degC")
    for temperatures, starved in (((263.15, 283.15), True), ((333.15, 353.15), False)):
        log = log_of(case, temperatures)
        found = bs.fit(case.model, case.screw, case.lubricant, log, free=["nut.preload"])
        assert [r.id for r in found.warning_records if r.id == "lubricant.starved"] == ["lubricant.starved"] * starved


@pytest.mark.parametrize("count", [5000, 50_000])
def test_one_starved_row_of_a_long_log_is_found(count):
    """Neither the fastest row nor the coldest is starved: one that is rather fast and rather cold is."""
    case = case_with("60 degC")
    subject = Configuration(case.model, case.screw, case.lubricant)
    rows = {
        "axial_load": np.full(count, 3e3),
        "screw_speed": np.full(count, 1.0),
        "temperature": np.full(count, 333.15),
    }
    for place, speed, temperature in ((10, 150.0, 353.15), (20, 0.01, 263.15)):
        rows["screw_speed"][place], rows["temperature"][place] = speed, temperature
    assert subject.starvation(rows) == []
    rows["screw_speed"][1234], rows["temperature"][1234] = 100.0, 278.15
    (record,) = subject.starvation(rows)
    here = case.model(case.screw, case.lubricant.at(278.15), axial_load=3e3, screw_speed=100.0)
    assert (record.limit, record.value) == pytest.approx((here.screw_torque, here.flooded_torque), rel=1e-9)


@pytest.mark.slow
def test_of_more_starved_rows_than_are_solved_the_most_starved_is_named():
    case = case_with("60 degC")
    subject = Configuration(case.model, case.screw, case.lubricant)
    random = np.random.default_rng(4)
    rows = {"axial_load": np.full(50_000, 3e3), "screw_speed": random.uniform(20.0, 60.0, 50_000)}
    rows["temperature"] = np.full(50_000, 278.15)
    rows["screw_speed"][1234] = 100.0
    rows["screw_speed"][2345], rows["temperature"][2345] = 140.0, 353.15
    (record,) = subject.starvation(rows)
    here = case.model(case.screw, case.lubricant.at(278.15), axial_load=3e3, screw_speed=100.0)
    assert record.value == pytest.approx(float(here.flooded_torque), rel=1e-9)


@pytest.mark.slow
def test_a_torque_without_load_says_that_the_nut_is_starved_of_oil():
    for temperature, starved in (("0 degC", True), ("60 degC", False)):
        case = case_with(temperature)
        idle = case.model(case.screw, case.lubricant, axial_load=0.0, screw_speed=60.0)
        report = of_torque(case, Reading(float(idle.screw_torque), 60.0))
        record = record_of(service_documents.document(case, report))
        assert (record is not None) == starved
        if record is not None:  # the preload found is the one of the case, but for what is uncertain
            assert record["value"] == pytest.approx(float(idle.flooded_torque), rel=0.2)


@pytest.mark.slow
def test_a_condition_says_that_its_tests_are_of_a_starved_model():
    for degrees, starved in ((0.0, True), (60.0, False)):
        case = case_with(f"{degrees:g} degC")
        idle = case.model(case.screw, case.lubricant, axial_load=0.0, screw_speed=60.0)
        tests = {
            "torque": float(idle.screw_torque) * np.linspace(1.0, 1.01, 8),
            "temperature": np.full(8, 273.15 + degrees),
        }
        found = bs.condition(case.model, case.screw, case.lubricant, tests, screw_speed=60.0)
        assert ("lubricant.starved" in [record.id for record in found.warning_records]) == starved


#: Exports that are made in a full bath, too, one of either kind: what stands in a readme is decided once for all.
BOTH = ("c", "drive")


@pytest.mark.slow
@pytest.mark.parametrize("target", ["c", "table", "matlab", "modelica", "linuxcnc", "drive"])
def test_the_readme_of_an_export_says_that_its_range_is_starved_of_oil(target):
    case = case_with("20 degC")
    options = {} if target not in ("linuxcnc", "drive") else {"ranges": {"axial_load": (-3e3, 3e3)}}
    for constant, starved in ((3e-8, True), (0.0, False)) if target in BOTH else ((3e-8, True),):
        model = dataclasses.replace(case.model, inlet=Inlet(replenishment_constant=constant))
        made = bs.hand_over(model, case.screw, case.lubricant, target, **options)
        said = [record for record in made.warnings if record.id == "lubricant.starved"]
        assert bool(said) == starved
        words = b"in a full bath of oil; no measurement on a ball screw decides between them"
        assert any(words in content for content in made.files.values()) == starved


@pytest.mark.slow
def test_an_export_is_judged_without_load_too():
    """Where a double nut is starved the most, as there is least besides the rolling."""
    case = case_with("25 degC")
    made = bs.hand_over(case.model, case.screw, case.lubricant, "c", ranges={"temperature": (298.15, 300.15)})
    (record,) = [one for one in made.warnings if one.id == "lubricant.starved"]
    speeds = np.array([0.1, 1.0]) * np.max(np.abs(made.measured_range["screw_speed"]))
    idle = case.model(case.screw, case.lubricant.at(298.15), axial_load=0.0, screw_speed=speeds)
    place = int(np.argmax(idle.flooded_torque / idle.screw_torque))
    assert record.value == pytest.approx(float(idle.flooded_torque[place]), rel=1e-6)
