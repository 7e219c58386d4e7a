"""``bs.select`` and ``ballscrew select``: equal to brute force by the public check, ranked, and refused in words."""

import csv
import json
import math
import sys
import tomllib

import jsonschema_rs
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.faces.cli.progress import progress
from ballscrew.faces.sheets import terminal
from ballscrew.questions.select import answer, compute
from ballscrew.questions.select.answer import document
from ballscrew.questions.select.candidates import BY_LOADS, NEARLY, USUAL_LIFE
from ballscrew.questions.select.compute import verdict
from ballscrew.questions.select.need import OF_MOTION, need_of
from ballscrew.questions.select.sheet import cost, sheet
from support.commands import ROOT
from support.pictures import drawn

EXAMPLE = ROOT / "examples" / "needs" / "feed_axis.toml"
FEW = {
    "operation": {"axial_load": "6 kN", "feed": "15 m/min"},
    "installation": {"unsupported_length": "1 m", "ends": "fixed-supported"},
    "limits": {"running_time": "20000 h"},
    "nut": {"preload": ["2 %", "5 %"]},
    "need": {"rows": "rexroth 63x"},
}


def test_a_selection_is_brute_force_by_the_public_check(ballscrew):
    """Each row by itself, by the command ``check``: the same numbers, checks and verdicts, and no candidate more."""
    need = {**FEW, "need": {"rows": "40-20k"}, "nut": {"type": ["single", "double"]}}
    found = document(bs.select(need, complete=True))
    by_label = {each["label"]: each for each in found["candidates"]}
    rows = [name for name in bs.catalogue() if "40-20k" in name]
    assert rows
    expected = {}
    for name in rows:
        for nut, preload in (("single", None), ("double", "2 %"), ("double", "5 %"), ("double", "10 %")):
            speed = 2 * math.pi * 0.25 / bs.catalogue()[name].lead
            options = ["--axial-load", "6 kN", "--speed", f"{speed!r} rad/s", "--nut", nut, "--length", "1 m"]
            options += ["--ends", "fixed-supported", "--set", 'limits.running_time="20000 h"']
            options += [] if preload is None else ["--preload", preload]
            label = ", ".join(filter(None, [name, nut, preload, "ISO VG 100"]))
            expected[label] = json.loads(ballscrew("check", name, *options, "--json").stdout)
    assert set(by_label) == set(expected)
    for label, alone in expected.items():
        mine = by_label[label]
        assert mine["results"]["screw_torque"] == pytest.approx(alone["results"]["screw_torque"], rel=1e-9)
        own = [check for check in mine["checks"] if check["name"] != "preload"]  # a need has one check more
        assert [check["id"] for check in own] == [check["id"] for check in alone["checks"]]
        for one, other in zip(own, alone["checks"], strict=True):
            assert one["holds"] == other["holds"]
            assert one["utilisation"] == pytest.approx(other["utilisation"], rel=1e-9)
        assert mine["holds"] == all(check["holds"] for check in alone["checks"])


POINT = {"force": "4 kN", "feed": "15 m/min", "ends": "fixed-supported", "length": "1 m", "life": "2000 h"}
UP = {
    "mass": "400 kg", "inclination": "90 deg", "acceleration": "3 m/s^2", "feed": "24 m/min", "stroke": "600 mm",
}  # fmt: skip
ROWS = {"rows": "rexroth-32x"}
#: One row of them in three nuts, of which loads rule out one or two: a cycle takes each candidate a second.
ROW = {"rows": "rexroth-32x20"}


@pytest.mark.slow
def test_the_motor_accelerates_the_shaft_that_the_list_prints(ballscrew, tmp_path):
    """The torque is that of ``duty`` with the printed inertia given, and that of steel of 32 mm and 1 m is in it."""
    need = {**UP, **ROW, "acceleration": "3.6 m/s^2", "nut": "single", "length": "1 m", "ends": "fixed-supported"}
    found = bs.select(need, complete=True)
    (only,) = found.ranked
    path = tmp_path / "case.toml"
    path.write_text(answer.case_text(found, only, ""), encoding="utf-8")

    def peak(setting):
        return json.loads(ballscrew("duty", str(path), "--set", setting, "--json").stdout)["results"]["torque_peak"]

    counted = peak(f"axis.inertia={only.candidate.objectives['inertia']!r} kg m^2")
    mine = document(found)["candidates"][0]
    assert mine["duty"]["torque_peak"] == pytest.approx(counted, rel=1e-12)
    steel = math.pi * 0.016**2 * 7850 * 0.016**2 / 2
    without = peak("axis.screw_inertia=0 kg m^2")
    assert counted - without == pytest.approx(steel * 3.6 * math.tau / 0.020, rel=1e-9)
    said = {one["id"]: one["text"] for one in mine["verdicts"]}["verdict.inertia"]
    assert said.endswith("not given: motor, coupling")
    printed = " ".join(terminal.text(sheet(found, [only])).split())
    assert "1: what turns has 8.081 kg cm^2 at the motor: screw (a cylinder of 32 mm" in printed


def test_a_preload_that_is_asked_for_is_not_dropped():
    """HIWIN's rows list single nuts: they hold nothing of it, unless the need names that kind itself."""
    need = {**POINT, "force": "2 kN", "life": "100 h", "rows": "hiwin-50-20k4", "preload": "5 %"}
    (only,) = bs.select(need).ranked
    assert [check.name for check in only.candidate.failed] == ["preload"]
    assert not only.candidate.holds
    assert only.candidate.failed[0].text.startswith("a preload is asked for, and this nut has none")
    del need["preload"]
    for nut in ({"type": ["single", "double"], "preload": "5 %"}, {"type": "single"}):
        assert all(each.candidate.holds for each in bs.select({**need, "nut": nut}).ranked)


def test_the_list_names_what_each_was_compared_with():
    """The limit of the DN value is an estimate, and decides: one that is given is none."""
    need = {**POINT, "force": "2 kN", "life": "100 h", "feed": "20 m/min", "rows": "63x10x6-4", "preload": "5 %"}
    found = bs.select(need)
    (only,) = found.ranked
    assert verdict(only.candidate).startswith("cannot hold: diameter speed product 1.8 times an estimated limit")
    printed = " ".join(terminal.text(sheet(found, found.ranked)).split())
    assert "compared with: diameter speed product 70000 mm rpm; of standard nuts in general (THK514E" in printed
    assert "it may be more: 1 candidates 1 fail by an estimated limit alone" in printed
    given = bs.select({**need, "limits": {"diameter_speed_product": "100000 mm rpm"}})
    assert verdict(given.ranked[0].candidate).startswith("cannot hold: diameter speed product 1.26 times")
    assert "estimated" not in terminal.text(sheet(given, given.ranked))


#: Checks that loads, speeds and sizes decide.
OF_LOADS = {
    "static_safety", "life", "running_time", "shaft_stress", "buckling", "critical_speed", "diameter_speed_product",
    "motor_speed", "preload", "remaining_preload", "inertia", "step",
}  # fmt: skip


def order_of_failing(candidates, objective, *, asks_for_life):
    """Labels of those that fail, in their order: by how much; then those that loads rule out, by how much.

    Of those that fail alike that of the smaller objective is first, and then the label decides. Where no life is asked
    for, less than 10,000 h counts as if it failed.
    """

    def by_how_much(checks):
        of_each = [math.inf if one.utilisation is None else one.utilisation for one in checks if one.holds is not None]
        return max(of_each, default=0.0)

    failing, ruled_out = [], []
    for one in candidates:
        label, hours = one.variant.label, one.objectives["life"] / 3600
        by_loads = by_how_much([check for check in one.checks if check.name in OF_LOADS])
        short = 0.0 if asks_for_life else 10_000 / hours
        if by_loads > 1.25:
            ruled_out.append((by_loads, label))
        elif short > 1 or any(check.holds is False for check in one.checks):
            failing.append((max(short, by_how_much(one.checks)), one.objectives[objective], label))
    return [one[-1] for one in [*sorted(failing), *sorted(ruled_out)]]


@pytest.mark.slow
@pytest.mark.parametrize(
    "need",
    [
        POINT,
        {**POINT, "life": "6000 h"},
        {**POINT, "force": "5 kN", "ends": "fixed-free", "life": "500 h"},
        {**POINT, "force": "-2 kN", "nut": ["single", "double"], "preload": ["3 %", "8 %"]},
        {**POINT, "force": "2 kN", "feed": "20 m/min", "length": "1.5 m"},
        {"force": "4 kN", "feed": "10 m/min"},
        {**POINT, "need": {**ROWS, "least_remaining_preload": "1 kN", "largest_inertia": "20 kg cm^2"}},
        {**POINT, "need": {**ROWS, "largest_drive_torque": "20 N m", "back_driving": "forbidden"}},
        {**POINT, "oil": ["ISO VG 68", "ISO VG 220"], "temperature": "20 degC"},
        {**UP, **ROWS, "life": "500 h", "ends": "fixed-supported"},
        {**UP, **ROW, "inclination": "0 deg", "life": "20000 h"},
        {**UP, **ROW, "motor": {"rated_torque": "10 N m", "peak_torque": "30 N m", "largest_speed": "2200 rpm"}},
        {**UP, **ROW},
        {**POINT, "nut": {"type": ["double", "oversize-balls"], "preload": ["3 %"], "set_at_rest": True}},
    ],
)
def test_what_its_loads_rule_out_changes_no_rank(need):
    """The list in two stages is that of brute force: all ranks, marks and verdicts, and all that was computed."""
    need = {"bodies": {}, **need} if "need" in need else {**ROWS, **need, "bodies": {}}
    found, brute = bs.select(need), bs.select(need, complete=True)
    assert all(each.candidate.complete for each in brute.ranked)
    for one, other in zip(found.ranked, brute.ranked, strict=True):
        mine, full = one.candidate, other.candidate
        assert (mine.variant.label, one.rank, one.pareto) == (full.variant.label, other.rank, other.pareto)
        assert (mine.holds, mine.fits, mine.rigid_lift_off_load) == (full.holds, full.fits, full.rigid_lift_off_load)
        of_full = {check.name: check for check in full.checks}
        assert mine.complete is not (mine.worst_by_loads > NEARLY)
        for check in mine.checks:
            same = of_full[check.name]
            assert (check.holds, check.text, check.missing) == (same.holds, same.text, same.missing)
            if check.utilisation is None or same.utilisation is None:
                assert check.utilisation is same.utilisation
            else:
                assert check.utilisation == pytest.approx(same.utilisation, rel=1e-9)
            assert check.name in BY_LOADS or mine.complete
        for name, value in mine.objectives.items():
            assert value == pytest.approx(full.objectives[name], rel=1e-9, nan_ok=True) or not mine.complete
        assert mine.objectives["life"] == pytest.approx(full.objectives["life"], rel=1e-9)
        if not mine.complete:
            assert set(of_full) & BY_LOADS == {check.name for check in mine.checks}
    order = order_of_failing([one.candidate for one in brute.ranked], brute.objectives[0], asks_for_life="life" in need)
    assert [one.candidate.variant.label for one in found.ranked][len(found.ranked) - len(order) :] == order
    best, same = found.best, brute.best
    assert (best and best.variant.label) == (same and same.variant.label)


@pytest.mark.parametrize(
    "written",
    [
        'force = "6 kN"\nfeed = "15 m/min"\nends = "fixed-supported"\nlife = "20000 h"\nlength = "1 m"\n'
        'oil = "ISO VG 68"\nnut = "double"\npreload = "2 %"',
        '[need]\nforce = "6 kN"\nfeed = "15 m/min"\nends = "fixed-supported"\nlife = "20000 h"\nlength = "1 m"\n'
        'oil = "ISO VG 68"\nnut = "double"\npreload = "2 %"',
        '[operation]\nforce = "6 kN"\nfeed = "15 m/min"\n[installation]\nends = "fixed-supported"\nlength = "1 m"\n'
        '[limits]\nlife = "20000 h"\n[lubricant]\noils = "ISO VG 68"\n[nut]\nnut_type = "double"\npreload = "2 %"',
        'lubricant = "ISO VG 68"\n'
        '[operation]\naxial_load = "6 kN"\nfeed = "15 m/min"\n[installation]\nends = "fixed-supported"\n'
        'unsupported_length = "1 m"\n[limits]\nrunning_time = "20000 h"\n[nut]\ntype = "double"\npreload = "2 %"',
    ],
)
def test_all_ways_to_write_a_need(written, tmp_path):
    path = tmp_path / "need.toml"
    path.write_text(written, encoding="utf-8")
    need = need_of(path)
    assert need.requirements.feed == pytest.approx(0.25)
    assert need.nuts == ["double"]
    assert need.preloads == ["2 %"]
    assert need.oils == [{"grade": "ISO VG 68", "temperature": "40 degC"}]
    assert need.tables["operation"] == {"axial_load": "6 kN"}
    assert need.tables["installation"] == {"ends": "fixed-supported", "unsupported_length": "1 m"}
    assert need.tables["limits"] == {"running_time": "20000 h"}


@pytest.mark.parametrize(
    ("written", "place", "value"),
    [
        ({"operation": {"thrust": "2 kN", "feed": "10 m/min", "life": "1 h"}}, "limits", {"running_time": "1 h"}),
        ({"requirements": {"force": "2 kN", "feed": "10 m/min"}}, "operation", {"axial_load": "2 kN"}),
        ({"force": "2 kN", "speed": "10 m/min"}, "operation", {"axial_load": "2 kN"}),
        ({"operation": {"load": "2 kN", "screw_speed": "10 m/min"}}, "operation", {"axial_load": "2 kN"}),
        ({"force": "2 kN", "feed": "9 rpm"}, "operation", {"axial_load": "2 kN", "screw_speed": "9 rpm"}),
        (
            {"force": "2 kN", "feed": "9 m/min", "mounting": "fixed-free", "length": "1 m"},
            "installation",
            {"ends": "fixed-free", "unsupported_length": "1 m"},
        ),
    ],
)
def test_names_that_people_write(written, place, value):
    need = need_of(written)
    assert need.tables[place] == value
    assert (need.requirements.feed is None) == ("screw_speed" in need.tables["operation"])


@pytest.mark.parametrize("oil", ["ISO VG 68", "vg68", ["ISO VG 68"]])
def test_a_grade_may_be_written_as_an_oil(oil):
    found = bs.select(
        {"force": "2 kN", "feed": "10 m/min", "nut": "single", "lubricant": {"oil": oil}}, words="40-20k4"
    )
    assert [each.candidate.checked.case.origins.oil["grade"] for each in found.ranked] == ["ISO VG 68"] * len(
        found.ranked
    )


def test_all_faults_of_a_need_at_once():
    with pytest.raises(InputError) as raised:
        need_of(
            {
                "demands": {"force": "2 kN"},
                "rapid": "40 m/min",
                "need": {"colour": "red", "feed": 0.25, "least_rigidity": "5 kg"},
                "limits": {"life": 5},
            }
        )
    found = {fault.where: fault for fault in raised.value.faults}
    assert list(found) == ["demands", "need.colour", "rapid", "need.feed", "need.least_rigidity"]  # no load is missing
    assert "known: force, speed, feed, stroke, length" in found["need.colour"].parts[2]
    assert "largest_step" in found["need.colour"].parts[2]
    assert found["need.feed"].parts[2] == 'write "0.25 m/s", or "0.25 m/min"'
    assert "two speeds" in found["rapid"].parts[0]


def test_a_case_file_is_a_need():
    found = bs.select(ROOT / "examples" / "catalogue_screw.toml", words="rexroth 40x10")
    assert [each.candidate.name for each in found.ranked] == ["rexroth-40x10x6-6-double"]
    assert found.ranked[0].candidate.checked.nut.preload == pytest.approx(0.07 * 72100)


def test_what_is_assumed_is_said():
    """No length: the inertia compares diameters by a shaft of 1 m, and is not judged by it."""
    tables = {"force": "2 kN", "feed": "10 m/min", "largest_inertia": "20 kg cm^2", "nut": "double"}
    found = bs.select(tables, words="hiwin-40-20k4")
    notes = " · ".join(document(found)["need"]["assumed"])
    for words in ("shaft of 1 m", "elastic bodies", "preloads of 2 %, 5 %, 10 %", "oil ISO VG 100"):
        assert words in notes
    check = next(check for check in found.ranked[0].candidate.checks if check.name == "inertia")
    assert (check.value, check.holds, check.missing) == (None, None, "installation.unsupported_length")
    stated = bs.select({**tables, "stroke": "0.5 m", "preload": "5 %", "bodies": {}}, words="hiwin-40-20k4")
    notes = " · ".join(stated.need.notes)
    assert "shaft of 1 m" not in notes
    assert "elastic bodies" not in notes
    assert "preloads of" not in notes
    check = next(check for check in stated.ranked[0].candidate.checks if check.name == "inertia")
    assert check.value == pytest.approx(math.pi * 7850 * 0.04**4 * 0.5 / 32)


@pytest.mark.slow
def test_the_motor_of_a_starved_cycle_is_listed_by_the_larger_torque(ballscrew, tmp_path):
    """Largest and RMS torque are those in a full bath of cold oil, in all forms of the list."""
    need, table = tmp_path / "need.toml", tmp_path / "list.csv"
    cold = {"oil": "ISO VG 220", "temperature": "5 degC", "preload": "8 %", "rows": "rexroth-40x10x6-6"}
    lines = [f"{key} = {json.dumps(value)}\n" for key, value in {**MOVING, "feed": "24 m/min", **cold}.items()]
    need.write_text("".join(lines), encoding="utf-8")
    document = json.loads(ballscrew("select", need, "--complete", "--json", "--to", table).stdout)
    mine, units = document["candidates"][0], document["units"]
    given, full, larger = mine["duty"], mine["full_bath"], mine["motor_torque"]
    assert mine["starved"]
    # the peaks of the load and of friction, and what accelerates the shaft at 3 m/s², lead 10 mm
    shaft = mine["objectives"]["inertia"] * 3 * 2 * math.pi / 0.01
    assert given["torque_peak"] == pytest.approx(10.2 + shaft, rel=0.01)
    assert full["torque_peak"] == pytest.approx(15.92 + shaft, rel=0.01)
    assert full["torque_rms"] > 1.4 * given["torque_rms"]
    assert larger == {name: full[name] for name in ("torque_peak", "torque_rms")}
    assert mine["objectives"]["drive_torque"] == larger["torque_peak"]
    assert units["motor_torque"]["torque_rms"] == units["full_bath"]["torque_rms"] == "N m"
    with table.open(encoding="utf-8") as stream:
        row = next(csv.DictReader(stream))
    assert float(row["motor torque peak [N m]"]) == pytest.approx(full["torque_peak"], rel=1e-9)
    assert float(row["motor torque rms [N m]"]) == pytest.approx(full["torque_rms"], rel=1e-9)
    lines = ballscrew("select", need, "--complete").stdout.splitlines()
    line = next(line for line in lines if line.startswith("  1"))
    shown = [f"{full[name]:.4g} N m" for name in ("torque_peak", "torque_rms")]
    assert [cell.strip() for cell in line.split("  ") if cell.strip() in shown] == shown


def test_the_larger_torque_of_a_starved_oil_ranks():
    """Thick oil that comes back late makes less friction than thin oil; in a full bath it makes more."""
    need = {
        "force": "1 kN", "speed": "3000 rpm", "temperature": "20 degC", "oil": ["ISO VG 68", "ISO VG 220"],
        "nut": "single", "rows": "hiwin-20-6", "life": "10 h", "bodies": {},
    }  # fmt: skip
    found = bs.select(need)
    thin, thick = (each.candidate for each in found.ranked)
    assert [each.variant.oil_name for each in (thin, thick)] == ["ISO VG 68", "ISO VG 220"]
    as_given = [float(each.checked.run.friction.friction_power) for each in (thin, thick)]
    assert as_given[0] > as_given[1]  # by the starved torque the thick oil would come first
    for each in (thin, thick):
        friction = each.checked.run.friction
        more = float(friction.flooded_torque - friction.screw_torque)
        assert each.objectives["loss"] == pytest.approx(float(friction.flooded_torque * friction.screw_speed))
        assert each.objectives["drive_torque"] == pytest.approx(float(friction.drive_torque) + more)
        record = each.starved[0]
        assert (record.id, record.value) == (
            "lubricant.starved",
            pytest.approx(float(friction.flooded_torque), rel=1e-3),
        )
    answer = document(found)
    assert [one["id"] for one in answer["warnings"]] == ["lubricant.starved"]
    for each in answer["candidates"]:
        assert each["starved"]
        assert "lubricant.starved" in [one["id"] for one in [*each["warnings"], *each["verdicts"]]]
    assert "in a full bath of oil" in " ".join(terminal.text(sheet(found, found.ranked)).split())
    warm = bs.select({**need, "speed": "100 rpm", "temperature": "60 degC"})
    assert not any(each.candidate.starved for each in warm.ranked)
    assert not document(warm)["warnings"]


def test_the_torque_without_load_is_starved_by_itself():
    """Under 40 kN oil hardly matters; without load the torque in a full bath is larger by a quarter, and it counts."""
    need = {
        "force": "40 kN", "speed": "1500 rpm", "temperature": "40 degC", "oil": "ISO VG 220", "nut": "double",
        "preload": "2 %", "rows": "rexroth-40x10x6-6", "bodies": {}, "need": {"largest_preload_torque": "1 N m"},
    }  # fmt: skip
    found = bs.select(need, complete=True)
    mine = found.ranked[0].candidate
    assert not mine.checked.run.friction.starvation
    assert mine.checked.nut.preload_drag == pytest.approx(0.922, rel=2e-3)
    assert mine.objectives["preload_torque"] == pytest.approx(1.164, rel=2e-3)
    assert mine.objectives["loss"] == float(mine.checked.run.friction.friction_power)
    assert next(check for check in mine.checks if check.name == "preload_torque").holds is False
    assert [record.id for record in mine.starved] == ["lubricant.starved"]
    assert mine.starved[0].value == pytest.approx(1.164, rel=2e-3)
    assert "drag torque of the nut" in mine.starved[0].text
    answer = document(found)["candidates"][0]
    assert answer["starved"]
    assert [one["id"] for one in answer["warnings"]].count("lubricant.starved") == 1


@pytest.mark.slow
def test_without_a_life_what_lives_short_is_ranked_last():
    """A small screw loses least and lives some hundred hours: nothing fails, and it comes after the others."""
    need = {"force": "3 kN", "feed": "12 m/min", "nut": "single", "rows": "hiwin", "bodies": {}}
    found = bs.select(need)
    lives = [each.candidate.objectives["life"] for each in found.ranked if not each.candidate.failed]
    short = [life < USUAL_LIFE for life in lives]
    assert short == sorted(short)
    assert True in short
    assert False in short
    shortest = [life for life in lives if life < USUAL_LIFE]
    assert shortest == sorted(shortest, reverse=True)
    assert any("ranked after the others" in note for note in found.need.notes)
    asked = bs.select({**need, "life": "1 h"})
    assert not any("ranked after" in note for note in asked.need.notes)
    losses = [each.candidate.objectives["loss"] for each in asked.ranked if not each.candidate.failed]
    assert min(losses) == losses[0]


def test_what_it_costs_and_leaves_open_is_said_before_it_starts(monkeypatch, capsys):
    planned = compute.plan({**MOVING, "rows": ""})
    said = cost(planned)
    assert said.startswith(f"candidates: {planned.candidates}, ")
    assert "s of a processor at most" in said
    assert "buckling, critical speed" in said
    assert "running time" not in said
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress("candidates", said):
        pass
    assert said in capsys.readouterr().err
    monkeypatch.setattr(sys.stderr, "isatty", lambda: False)
    with progress("candidates", said):
        pass
    assert not capsys.readouterr().err


def test_a_stroke_and_the_nut_are_the_unsupported_length():
    tables = {"force": "2 kN", "feed": "10 m/min", "nut": "double", "preload": "5 %", "stroke": "1 m", "life": "1 h"}
    found = bs.select({**tables, "ends": "fixed-free"}, words="hiwin-40-20k4")
    row, candidate = bs.catalogue()["hiwin-40-20k4"], found.ranked[0].candidate
    length = 1 + (2 * row.loaded_turns + 2) * row.lead
    assert candidate.checked.case.installation.unsupported_length == pytest.approx(length)
    mine = document(found)["candidates"][0]
    assert any(note.startswith("unsupported length 1") for note in mine["assumed"])
    assert any("unsupported length" in note for note in found.need.notes)
    given = bs.select({**tables, "ends": "fixed-free", "length": "1.2 m"}, words="hiwin-40-20k4")
    assert given.ranked[0].candidate.checked.case.installation.unsupported_length == 1.2
    assert not any("unsupported length" in note for note in document(given)["candidates"][0]["assumed"])


def test_why_none_holds_stands_at_the_top():
    tables = {"force": "2 kN", "feed": "10 m/min", "nut": "single"}
    lines = terminal.text(sheet(found := bs.select(tables, words="hiwin-40-20k4"), found.ranked)).splitlines()
    assert lines[0] == "need: 0 of 1 candidates hold"
    assert lines[2].startswith("1 of them fail no check, but a candidate holds only once all are judged: give install")
    assert sum("only once all" in line for line in lines) == 1
    failing = terminal.text(
        sheet(found := bs.select({**tables, "force": "900 kN"}, words="hiwin-40-20k4"), found.ranked)
    )
    assert failing.splitlines()[2].startswith("a candidate holds only once all checks are judged: give installation")


@pytest.mark.slow
def test_a_load_that_takes_the_preload_away_is_a_check_that_fails():
    """By the force of the need, and by the largest of a cycle though steady travel leaves preload."""
    tables = {"force": "8 kN", "feed": "15 m/min", "nut": "double", "preload": "2 %", "rows": "hiwin-40-20k4"}
    found = bs.select(tables, complete=True)
    mine = document(found)["candidates"][0]
    assert not mine["holds"]
    assert mine["fails"][0]["name"] == "preload"
    assert mine["fails"][0]["utilisation"] > 1
    limit = next(one["limit"] for one in mine["verdicts"] if one["id"] == "verdict.preload_lost")
    assert limit < 8000  # of the elastic bodies that a run has; rigid ones lose the preload sooner here
    limit, elastic = mine["rigid_lift_off_load"], limit
    assert 0.8 * elastic < limit < elastic
    assert f"preload lost (rigid bodies: above {float(f'{limit:.4g}'):g} N)" in mine["verdict"]
    assert mine["case"]["operation"]["screw_speed"] == "15 m/min"  # as typed: the lead makes the speed of it
    assert mine["verdict"].rpartition("; ")[2] in " ".join(terminal.text(sheet(found, found.ranked)).split())
    lighter = document(bs.select({**tables, "force": f"{0.9 * limit} N"}))["candidates"][0]
    assert lighter["rigid_lift_off_load"] is None
    assert "preload" not in lighter["verdict"]
    assert next(one for one in lighter["checks"] if one["name"] == "preload")["holds"]
    assert not [
        one
        for one in document(bs.select({**tables, "nut": "single"}))["candidates"][0]["checks"]
        if one["name"] == "preload"
    ]
    moving = {"axis": {"mass": "1000 kg"}, "motion": {"kind": "trapezoid", "stroke": "0.4 m", "speed": "15 m/min"}}
    moving["motion"]["acceleration"] = f"{1.5 * limit / 1000} m/s^2"
    rest = {name: value for name, value in tables.items() if name not in ("force", "feed")}
    cycle = bs.select({**rest, **moving}, complete=True).ranked[0].candidate
    assert cycle.rigid_lift_off_load == pytest.approx(limit)
    assert not cycle.checked.nut.preload_is_lost
    assert [check.name for check in cycle.failed] == ["preload"]


MOVING = {
    "mass": "400 kg", "inclination": "90 deg", "acceleration": "3 m/s^2", "feed": "15 m/min", "stroke": "600 mm",
    "nut": "double", "preload": "5 %", "life": "20000 h", "rows": "hiwin-40-20k4",
}  # fmt: skip


@pytest.mark.slow
def test_a_mass_and_an_acceleration_are_an_axis_and_a_motion():
    """The short names are the tables of a duty: the largest load is m (g + a), the life that of the cycle."""
    found = bs.select(MOVING)
    tables = {name: value for name, value in MOVING.items() if name not in OF_MOTION and name != "feed"}
    motion = {"kind": "trapezoid", "stroke": "600 mm", "speed": "15 m/min", "acceleration": "3 m/s^2"}
    written = bs.select({**tables, "axis": {"mass": "400 kg", "inclination": "90 deg"}, "motion": motion})
    mine, other = found.ranked[0].candidate, written.ranked[0].candidate
    assert mine.objectives == other.objectives
    assert mine.duty is not None
    assert mine.duty.largest_load == pytest.approx(400 * (9.80665 + 3))
    assert any("without rests" in note for note in found.need.notes)
    operation = document(found)["candidates"][0]["case"]["operation"]  # steady travel, for the other questions
    assert operation["axial_load"] == "3922.66 N"
    assert operation["screw_speed"] == "750 rpm"


def test_requirements_are_checks():
    tables = {
        **FEW,
        "need": {
            "rows": "hiwin-50-20k4", "back_driving": "forbidden", "least_rigidity": "2000 N/um",
            "largest_drive_torque": "15 N m", "largest_inertia": "100 kg cm^2", "largest_preload_torque": "1 N m",
            "counts_per_turn": 1000, "largest_step": "10 um", "accuracy": "5",
        },
    }  # fmt: skip
    found = bs.select(tables, complete=True).ranked[0].candidate
    checks = {check.name: check for check in found.checks}
    assert checks["step"].value == pytest.approx(20e-6)
    assert checks["step"].utilisation == pytest.approx(2)
    printed = found.checked.nut.rigidity
    of_nut = printed.nut if math.isnan(printed.nut_corrected) else printed.nut_corrected
    assert checks["rigidity"].utilisation == pytest.approx(2e9 / min(found.objectives["rigidity"], of_nut))
    assert checks["inertia"].value == pytest.approx(math.pi * 7850 * 0.05**4 / 32)
    assert checks["preload_torque"].holds
    assert checks["drive_torque"].holds is False
    assert checks["back_driving"].holds is False  # a ball screw of this lead drives back
    assert checks["back_driving"].value == pytest.approx(float(found.checked.run.at_rest.holding_torque), rel=0.2)
    assert any("grade 5" in note for note in bs.select(tables).need.notes)
    assert not found.holds


@pytest.mark.slow
def test_tables_pictures_and_own_rows(ballscrew, tmp_path):
    rows = tmp_path / "rows.csv"
    own = (ROOT / "examples" / "own_screws.csv").read_text(encoding="utf-8").splitlines()
    heading = next(place for place, line in enumerate(own) if line.startswith("Part number"))
    priced = [f"{line};{'price index' if place == heading else '1,5'}" for place, line in enumerate(own)]
    rows.write_text("\n".join([*own[:heading], *priced[heading:]]), encoding="utf-8")
    table, picture = tmp_path / "list.csv", tmp_path / "front.svg"
    need = tmp_path / "need.toml"
    need.write_text('force = "2 kN"\nspeed = "600 rpm"\nprice_index = {}\n', encoding="utf-8")
    done = ballscrew("select", need, "--rows", rows, "--json", "--to", table, "--to", picture)
    document = json.loads(done.stdout)
    with table.open(encoding="utf-8") as stream:
        written = list(csv.DictReader(stream))
    assert [row["name"] for row in written] == [each["name"] for each in document["candidates"]]
    assert [each["name"] for each in document["objectives"]] == ["loss", "inertia", "life", "rigidity", "price_index"]
    assert all(each["objectives"]["price_index"] == 1.5 for each in document["candidates"])
    torque = [each["objectives"]["drive_torque"] for each in document["candidates"]]
    assert [float(row["drive torque [N m]"]) for row in written] == pytest.approx(torque, rel=1e-9)
    shown = drawn(picture)
    for words in ("power lost to friction", "[W]", "moment of inertia", "0 of 4 candidates hold"):
        assert words in shown.text
    words = ballscrew("select", need, "--rows", rows, "--first", "1").stdout
    assert "oil ISO VG 100: none was given" in words


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({"operation": {"screw_speed": "600 rpm"}}, "operation.axial_load"),
        ({"operation": {"axial_load": "2 kN"}}, "need.feed"),
        ({"forse": "2 kN"}, 'did you mean "force"'),
        ({"duty": [{"force": "2 kN"}]}, "write [axis] and [motion]"),
        ({**FEW, "limits": {"life": 20000}}, "limits.running_time: needs a unit"),
        ({**FEW, "force": "2 kN"}, "is given twice"),
        ({**FEW, "need": {"back_driving": "perhaps"}}, "need.back_driving"),
        ({**FEW, "need": {"largest_step": "1 um"}}, "counts_per_turn"),
        ({**FEW, "need": {"objectives": ["beauty"]}}, "unknown objective"),
        ({**FEW, "need": {"price_index": {"no-such-row": 2.0}}}, "no such row"),
        ({**FEW, "need": {"least_rigidity": "5 kg"}}, "need.least_rigidity"),
        ({**FEW, "nut": {"type": "tripple"}}, "unknown kind of nut"),
        ({**FEW, "operation": {"axial_load": "6 kN", "feed": "15 m/min", "screw_speed": "5 rpm"}}, "leave one of them"),
    ],
)
def test_faults_of_a_need(tables, words):
    with pytest.raises(InputError) as raised:
        bs.select(tables)
    assert words in str(raised.value)


def test_the_schema_knows_what_is_read(ballscrew):
    schema = json.loads(ballscrew("schema", "--need").stdout)
    validator = jsonschema_rs.validator_for(schema)
    validator.validate(tomllib.loads(EXAMPLE.read_text(encoding="utf-8")))
    validator.validate(FEW)
    validator.validate({"force": "6 kN", "feed": "15 m/min", "nut": ["single", "double"], "preload": "2 %"})
    validator.validate({"need": {"force": "6 kN", "speed": "15 rpm", "least_rigidity": "500 N/um"}})
    for wrong in ({"forse": "6 kN"}, {"need": {"leest_rigidity": "5 N/um"}}, {"optimise": {"population": 1}}):
        assert not validator.is_valid(wrong), wrong


# -- the case of a candidate ----------------------------------------------------------------------


def need_file(folder, **others):
    """A need that moves, with all that other commands want to know."""
    path = folder / "need.toml"
    lines = [f"{key} = {json.dumps(value)}\n" for key, value in {**UP, **ROW, "preload": "5 %", **others}.items()]
    tables = (
        '[bearings.fixed]\nlaw = "known"\ntorque = "0.3 N m"\nrigidity = "800 N/um"\n'
        '[guides]\nfriction_coefficient = 0.003\nseal_force = "3 N"\ncarriages = 4\n'
        '[installation]\nunsupported_length = "0.9 m"\nends = "fixed-supported"\n'
        '[limits]\nrunning_time = "2000 h"\n[surroundings]\nambient = "20 degC"\n[aside]\nfile = "offer.pdf"\n'
    )
    path.write_text("".join(lines) + tables, encoding="utf-8")
    return path


@pytest.mark.slow
def test_the_case_of_a_candidate_goes_on_unchanged(ballscrew, tmp_path):
    """Duty, axis, warm-up and run take the file that ``--to`` writes, and duty has the numbers of the list."""
    (tmp_path / "out").mkdir()
    need, case = need_file(tmp_path), tmp_path / "out" / "axis.toml"
    done = ballscrew("select", need, "--complete", "--json", "--to", case)
    first = json.loads(done.stdout)["candidates"][0]
    assert f"{case}: {first['label']}, rank 1: {first['verdict']}" in done.stderr
    text = case.read_text(encoding="utf-8")
    assert text.startswith(f"# {first['label']}: rank 1 of ")
    assert "# assumed: " in text
    tables = tomllib.loads(text)
    assert tables == first["case"]
    assert tables["estimates"] == {"lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"}}
    assert {"bearings", "guides", "installation", "limits", "surroundings", "axis", "motion"} <= tables.keys()
    duty = json.loads(ballscrew("duty", case, "--json").stdout)
    assert duty["results"]["energy_lost"] == pytest.approx(first["duty"]["energy_lost"], rel=1e-9)
    assert {check["id"]: check["holds"] for check in duty["checks"]}.items() <= {
        check["id"]: check["holds"] for check in first["checks"]
    }.items()
    for command in ("axis", "run"):
        assert json.loads(ballscrew(command, case, "--json").stdout)["results"]
    assert json.loads(ballscrew("warm-up", case, "--hours", "0.1", "--json").stdout)["results"]


@pytest.mark.slow
def test_the_case_of_a_short_need_says_what_was_estimated(ballscrew, tmp_path):
    """The oil, a preload and the length of the shaft of a row shipped; also numbers of the screw of one's own row."""
    need = tmp_path / "need.toml"
    need.write_text(
        'mass = "200 kg"\nstroke = "900 mm"\nfeed = "10 m/min"\nacceleration = "5 m/s^2"\nends = "fixed-supported"\n',
        encoding="utf-8",
    )
    shipped, own = tmp_path / "shipped.toml", tmp_path / "own.toml"
    assert ballscrew("select", need, "--filter", "rexroth 40x40", "--to", shipped).returncode == 0
    table = ("--rows", ROOT / "examples" / "own_screws.csv", "--filter", "loader")
    assert ballscrew("select", need, *table, "--set", "screw.contact_angle=44 deg", "--to", own).returncode == 0
    oil = {"lubricant.grade", "lubricant.temperature"}
    case = case_file.load(shipped)
    assert case.origins.estimated == {*oil, "nut.preload", "installation.unsupported_length"}
    of_row = {f"screw.{name}" for name in ("pitch_circle_diameter", "screw_conformity", "nut_conformity")}
    assert case_file.load(own).origins.estimated == {*oil, "installation.unsupported_length", *of_row}
    changed = case_file.load(shipped, ['installation.unsupported_length="1.3 m"'])
    assert changed.origins.estimated == {*oil, "nut.preload"}


@pytest.mark.slow
def test_the_case_of_another_rank(ballscrew, tmp_path):
    need, case = need_file(tmp_path, preload=["3 %", "5 %"]), tmp_path / "axis.toml"
    document = json.loads(ballscrew("select", need, "--complete", "--json", "--rank", "2", "--to", case).stdout)
    assert tomllib.loads(case.read_text(encoding="utf-8")) == document["candidates"][1]["case"]
    for words, said in (
        (["--rank", "2"], "--rank"),
        (["--rank", "99", "--to", tmp_path / "made" / "b.toml"], "there is no such candidate"),
        (["--to", need], "is the file of the need"),
        (["--to", tmp_path / "b.docx"], ".toml"),
    ):
        refused = ballscrew("select", need, *words)
        assert refused.returncode == 2
        assert said in refused.stderr
    assert not (tmp_path / "made").exists()


def test_no_file_that_is_read_is_written_over(ballscrew, tmp_path):
    """Neither the need by another way to it, nor the table of rows, nor a file that the need names."""
    (tmp_path / "out").mkdir()
    rows, oils, need = tmp_path / "rows.csv", tmp_path / "oils.toml", tmp_path / "need.toml"
    for file in (rows, oils):
        file.write_text("kept", encoding="utf-8")
    need.write_text('force = "4 kN"\n[lubricant]\noil = "Oil"\noil_file = "oils.toml"\n', encoding="utf-8")
    before = need.read_bytes()
    around = tmp_path / "out" / ".." / "need.toml"
    for target, said in ((around, "is the file of the need"), (rows, "is a file"), (oils, "is a file")):
        refused = ballscrew("select", need, "--rows", rows, "--to", target)
        assert refused.returncode == 2
        assert f"--to: {said}" in refused.stderr
    named = 'need.price_index={file="rows.csv"}'
    refused = ballscrew("optimise", need, "--set", named, "--to", rows)
    assert refused.returncode == 2
    assert "--to: is a file that is read" in refused.stderr
    assert need.read_bytes() == before
    assert rows.read_text(encoding="utf-8") == oils.read_text(encoding="utf-8") == "kept"


def test_tables_are_written_though_there_is_no_case_to_write(ballscrew, tmp_path):
    need, case, table = need_file(tmp_path, mass="40000 kg"), tmp_path / "a.toml", tmp_path / "list.csv"
    refused = ballscrew("select", need, "--holds", "--to", case, "--to", table)
    assert refused.returncode == 2
    assert f"--to: there is no candidate to write ({case})" in refused.stderr
    assert len(table.read_text(encoding="utf-8").splitlines()) >= 1
    assert not case.exists()


@pytest.mark.slow
def test_the_case_of_a_row_of_ones_own_needs_no_table(ballscrew, tmp_path):
    """Written elsewhere it finds the oil that the need names by a file; model and calibration are those asked for."""
    (tmp_path / "out").mkdir()
    oils = tmp_path / "oils.toml"
    oils.write_text(
        '[oils."Oil"]\nkinematic_viscosity_40 = "100 cSt"\nkinematic_viscosity_100 = "11.1 cSt"\n',
        encoding="utf-8",
    )
    need, case = tmp_path / "need.toml", tmp_path / "out" / "case.toml"
    need.write_text(
        'force = "4 kN"\nfeed = "10 m/min"\n'
        '[lubricant]\noil = "Oil"\noil_file = "oils.toml"\ntemperature = "40 degC"\n',
        encoding="utf-8",
    )
    words = ["--rows", ROOT / "examples" / "own_screws.csv", "--filter", "axis", "--complete"]
    words += ["--model", "corrected", "--to", case]
    first = json.loads(ballscrew("select", need, *words, "--json").stdout)["candidates"][0]
    tables = tomllib.loads(case.read_text(encoding="utf-8"))
    assert tables["lubricant"]["oil_file"] == "../oils.toml"
    assert tables["model"]["name"] == "corrected"
    assert tables["model"] == first["case"]["model"]
    assert "catalogue" not in tables["screw"]
    alone = json.loads(ballscrew("run", case, "--json").stdout)
    assert alone["results"]["screw_torque"] == pytest.approx(first["results"]["screw_torque"], rel=1e-9)
