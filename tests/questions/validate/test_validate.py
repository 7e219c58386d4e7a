"""``ballscrew validate``: text, JSON and picture; rows of one's own, good and bad."""

import json
import math
import re

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Chart, Curve, Lines
from ballscrew.cases.case_files import case_file
from ballscrew.evidence.validation.sets import SETS
from ballscrew.faces.sheets import pictures
from ballscrew.physics.friction.calibrations import calibration
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.shared.charts import house_style
from ballscrew.questions.validate import answer, compute, sheet
from support.documents import assert_same
from support.own_screws import SCREW
from support.processes import document_of, refused
from support.validation_sets import every_set

pytestmark = pytest.mark.slow

HEADINGS = (
    "nominal_diameter_mm,lead_mm,ball_diameter_mm,circuits,dynamic_load_rating_N,static_load_rating_N,"
    "no_load_torque_2pct_max_Nm,no_load_torque_5pct_min_Nm,no_load_torque_5pct_max_Nm"
)
#: What the calibration shipped was fitted to.
FITTED = ("rexroth-double-nut", "rexroth-single-nut")
GOOD = "40,12,6,4,49900,86200,.40,.75,1.25"
OTHER = "20,5,3,5,17500,27300,.07,.09,.26"


@pytest.fixture
def own(tmp_path):
    def write(*rows, headings=HEADINGS):
        path = tmp_path / "own.csv"
        path.write_text("\n".join([headings, *rows]) + "\n", encoding="utf-8")
        return path.name

    return write


# -- JSON -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def every():
    return plain(answer.documents([entry for entries in every_set() for entry in entries]))


def test_a_list_uncalibrated_first_calibrated_last(every):
    assert isinstance(every, list)
    names = [one["set"] for one in every]
    assert list(dict.fromkeys(names)) == list(SETS)
    for name, data in SETS.items():
        kinds = [one["calibration"] for one in every if one["set"] == name]
        assert kinds == [None, "rexroth-2006"] if data.calibratable else [None]
    keys = ["set", "model", "calibration", "n", "mean_ratio", "std_ratio", "share_in_band", "used_for"]
    for one in every:
        assert set(keys) | {"rows"} <= set(one)
        assert one["model"] == "reference"
        assert one["n"] == len(one["rows"])


#: Sets of many rows with bands; that of one row is asked alone in the short run.
MANY_BANDS = (*FITTED, "hiwin-stock", "thk-stock")


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.long] * (n in MANY_BANDS)) for n in SETS])
def test_each_set_by_itself(name, every, ballscrew):
    """A set asked for alone, with no option, says what it says among all."""
    alone = json.loads(ballscrew("validate", name, "--json").stdout)
    assert alone == [entry for entry in every if entry["set"] == name]


def test_means_are_those_of_the_rows(every):
    for one in every:
        ratios = [row["ratio"] for row in one["rows"]]
        assert one["mean_ratio"] == pytest.approx(sum(ratios) / len(ratios))
        bands = [row["in_band"] for row in one["rows"] if row["low"] is not None]
        assert one["share_in_band"] == (pytest.approx(sum(bands) / len(bands)) if bands else None)
        for row in one["rows"]:
            assert row["ratio"] == pytest.approx(row["value"] / row["middle"])
            assert row["band"] == (None if row["low"] is None else [row["low"], row["high"]])
            if row["low"] is not None:
                assert row["in_band"] == (row["low"] <= row["value"] <= row["high"])
                assert row["low"] < row["middle"]
                assert row["middle"] == row["high"] if one.get("upper_bound") else row["middle"] < row["high"]


def test_static_ratings_stand_beside_the_dynamic_ones(every):
    ratings = next(one for one in every if one["set"] == "hiwin-ratings")
    assert ratings["share_in_band"] is None
    assert all(0.9 < row["static_ratio"] < 1.1 for row in ratings["rows"])


def test_bands_of_the_model_stand_beside_those_of_vendors(every):
    with_bands = {"rexroth-double-nut", "rexroth-single-nut", "hiwin-stock", "thk-stock", "thk-jis"}
    assert {one["set"] for one in every if "share_in_uncertainty_band" in one} == with_bands
    for one in every:
        found = [row["in_uncertainty_band"] for row in one["rows"] if "in_uncertainty_band" in row]
        assert len(found) == (one["n"] if one["set"] in with_bands else 0)
        for row in one["rows"] if found else ():
            low, high = row["uncertainty_band"]
            assert row["in_uncertainty_band"] == (low <= row["middle"] <= high)
        assert one.get("share_in_uncertainty_band") == (pytest.approx(sum(found) / len(found)) if found else None)


def test_what_was_chosen_on_rows_is_told_of_each_set(every):
    chosen = {one["set"] for one in every if any("calibration" in word for word in one["used_for"])}
    assert chosen == {*FITTED, "hiwin-stock", "thk-jis"}
    never = [one["set"] for one in every if one["used_for"] == []]
    assert {"xjtu", "emps", "thk-kr4620a", "support-bearings"} <= set(never)


def test_groups_are_kinds_of_nut_or_makers(every):
    groups = {one["set"]: one.get("groups", {}) for one in every}
    assert list(groups["hiwin-stock"]) == ["single", "single, spacer balls", "double", "offset"]
    assert list(groups["support-bearings"]) == ["NSK", "IBC"]
    for one in every:
        for name, group in one.get("groups", {}).items():
            ratios = [row["ratio"] for row in one["rows"] if row["group"] == name]
            assert group["n"] == len(ratios)
            assert group["mean_ratio"] == pytest.approx(sum(ratios) / len(ratios))
            assert group["range_ratio"] == [min(ratios), max(ratios)]
            assert set(group["exponents"]) <= {"size", "lead"}


def test_rows_with_a_maximum_only_are_apart(every):
    single = next(one for one in every if one["set"] == "rexroth-single-nut")
    for row in single["rows"]:
        (apart,) = row["apart"]
        assert apart["ratio"] == pytest.approx(apart["value"] / apart["maximum"])
        assert apart["value"] < row["value"]


def test_what_is_not_finite_is_null(own, ballscrew):
    one = document_of(ballscrew("validate", "thk-jis", "--json"))[0]
    assert one["n"] == 1
    assert one["std_ratio"] is None


# -- rows of one's own ----------------------------------------------------------------------------


STOCK = (
    "code,nut,starts,spacer_balls,nominal_diameter_mm,pitch_circle_mm,lead_mm,ball_mm,circuits,dynamic_rating_N,"
    "static_rating_N,drag_low_Nm,drag_high_Nm"
)
BEARINGS = "maker,bearing,preload_class,bore_mm,outside_mm,preload_N,rigidity_N_per_um,torque_Nm"
#: By set: the columns of the list and no others, rows, and their names.
OWN = {
    "rexroth-single-nut": (HEADINGS, (GOOD, OTHER), None),
    # circuits with and without a product, a least drag of zero among them
    "hiwin-stock": (
        STOCK,
        (
            "R6-1.0T3-FSI,single,1,none,6,6.1,1.0,0.8,1x3,647,1089,0.0,0.01275",
            "R25-20K3-FSC,single,1,1:1,25,25.6,20,3.175,3,7747,16818,0.03923,0.24517",
            "R40-8B2-OFSW,offset,1,none,40,41,8,4.763,2.5x2,35637,103980,0.4158,0.86495",
        ),
        ["R6-1.0T3-FSI", "R25-20K3-FSC", "R40-8B2-OFSW"],
    ),
    "support-bearings": (
        BEARINGS,
        ("NSK,TAC B 15x47,C10,15,47,2150,750,0.14", "IBC,BS 17x47,,17,47,875,460,0.04"),
        ["NSK TAC B 15x47, 2150 N", "IBC BS 17x47, 875 N"],
    ),
}


@pytest.mark.parametrize("name", OWN)
def test_rows_of_ones_own_are_those_shipped(ballscrew, own, name):
    headings, rows, names = OWN[name]
    process = ballscrew("validate", name, "--rows", own(*rows, headings=headings), "--json")
    found = document_of(process)[0]
    assert process.stderr == ""
    shipped = {row["name"]: row for row in document_of(ballscrew("validate", name, "--json"))[0]["rows"]}
    assert names is None or [row["name"] for row in found["rows"]] == names
    assert found["n"] == len(rows)
    for row in found["rows"]:
        assert_same(row, shipped[row["name"]])


def test_columns_of_shipped_rows_are_no_matter_of_users(ballscrew):
    assert "columns not used" not in ballscrew("validate", "thk-ratings", "--json").stderr


def test_the_summary_is_one_object(ballscrew):
    found = document_of(ballscrew("validate", "rexroth-single-nut", "thk-jis", "--summary", "--json"))["summary"]
    assert {(row["maker"], row["nut"]) for row in found} == {("Rexroth", "single"), ("THK", "double")}
    entries = document_of(ballscrew("validate", "rexroth-single-nut", "--json"))
    for entry in entries:
        (row,) = [
            one for one in found if one["set"] == entry["set"] and one["name"] == (entry["calibration"] or "reference")
        ]
        names = ("n", "mean_ratio", "std_ratio", "share_in_band", "exponents")
        assert [row[name] for name in names] == [entry[name] for name in names]


def test_own_rows_were_never_used(ballscrew, own):
    file = own(GOOD, OTHER)
    assert all(one["used_for"] == [] for one in document_of(ballscrew("validate", FITTED[1], "--rows", file, "--json")))
    found = document_of(ballscrew("validate", FITTED[1], "--rows", file, "--summary", "--json"))["summary"]
    assert [row["chosen_on"] for row in found] == [[]] * len(found)
    faulty = own(GOOD, OTHER.replace("17500", "many"))
    process = ballscrew("validate", FITTED[1], "--rows", faulty, "--summary", "--json", "--keep-going")
    assert {row["n"] for row in document_of(process)["summary"]} == {1}
    assert "1 of 2 rows left out" in process.stderr


def test_own_rows_with_oil_and_speed(ballscrew, own):
    file = own(f"{GOOD},100 rpm,25 degC", f"{GOOD},500 rpm,60 degC", headings=f"{HEADINGS},speed,temperature")
    slow, fast = document_of(ballscrew("validate", "rexroth-single-nut", "--rows", file, "--json"))[0]["rows"]
    assert slow["value"] != fast["value"]
    file = own(GOOD)
    options = ("--speed", "500 rpm", "--temperature", "60 degC")
    (found,) = document_of(ballscrew("validate", "rexroth-single-nut", "--rows", file, "--json", *options))[0]["rows"]
    assert found["value"] == pytest.approx(fast["value"], rel=1e-12)


def test_a_bad_row_is_named(ballscrew, own):
    file = own(GOOD, OTHER.replace(".09,.26", ".26,.09"), OTHER.replace("17500", "many"))
    expected = (
        'own.csv row 3, column "no_load_torque_5pct_max_Nm": does not exceed the minimum (.09)',
        'own.csv row 4, column "dynamic_load_rating_N": is not a number (many)',
    )
    refused(ballscrew("validate", "rexroth-single-nut", "--rows", file), *expected)
    process = ballscrew("validate", "rexroth-single-nut", "--rows", file, "--json", "--keep-going")
    assert document_of(process)[0]["n"] == 1
    lines = process.stderr.strip().splitlines()
    assert [text in line for line, text in zip(lines, (*expected, "2 of 3 rows left out"), strict=True)] == [True] * 3


def test_a_file_needs_its_columns(ballscrew, own):
    file = own("40,12,6,4,49900,.75", headings=HEADINGS.replace(",static_load_rating_N", "").rpartition(",")[0][:-28])
    process = ballscrew("validate", "rexroth-single-nut", "--rows", file)
    assert process.returncode == 2
    assert 'own.csv: has no column "no_load_torque_5pct_m' in process.stderr


# -- options --------------------------------------------------------------------------------------


def test_another_model_is_as_it_is(ballscrew):
    process = ballscrew("validate", "thk-jis", "--model", "olaru2005", "--json")
    (found,) = document_of(process)
    assert (found["model"], found["calibration"]) == ("olaru2005", None)
    assert found["mean_ratio"] < 0.5
    asked = ("validate", "thk-jis", "--model", "olaru2005", "--calibration", "rexroth-2006", "--json")
    assert [one["calibration"] for one in document_of(ballscrew(*asked))] == [None, "rexroth-2006"]


def test_sets_that_a_model_cannot_do_are_left_out_aloud():
    asked = compute.request(model="olaru2005")
    assert "rexroth-single-nut" not in [data.name for data in asked.sets]
    assert asked.notes == ["rexroth-single-nut: left out, the model olaru2005 knows no balls with four contacts"]


# -- for people -----------------------------------------------------------------------------------


def test_warnings_of_the_model_are_told(ballscrew):
    process = ballscrew("validate", "thk-jis", "--speed", "100000 rpm")
    assert process.returncode == 0, process.stderr
    assert re.search(r"warning  \w+: uncalibrated \(reference\), 1 rows: ", process.stdout)
    assert "warning" not in ballscrew("validate", "thk-jis").stdout


def test_picture_shows_all_ratios_with_their_bands():
    asked = compute.request()
    found = [list(entries) for entries in every_set()]
    seen = sheet.picture(found, asked)
    charts = list(seen.of_kind(Chart))
    # rings of two sizes of balls, and a single worked example, show no trend over it
    names = [(data.name, name) for data in SETS.values() for name in data.axes if _values(found, data.name, name) > 2]
    assert len(names) == 2 * len(SETS) - 3
    shown = {(chart.title, chart.x.quantity.name): chart for chart in charts}
    assert [*shown] == [*names[:8], ("thk-jis", "size"), *names[8:]]
    for (set_name, name), chart in shown.items():
        (entries,) = (entries for entries in found if entries[0].data.name == set_name)
        bands, level, *curves = chart.marks
        assert (level.y, chart.y.name, chart.y.least) == (1.0, "model / stated", 0.0)
        for entry, curve in zip(entries, curves, strict=True):
            fitted = ", fitted" if set_name in FITTED else ""
            assert curve.name == (f"{entry.calibration}{fitted}" if entry.calibration else "uncalibrated")
            assert curve.x == [point.descriptors[name] for point in entry.points]
            assert curve.y == [point.ratio for point in entry.points]
        ends = [(p.band.low / p.band.middle, p.band.high / p.band.middle) for p in entries[0].points if p.band.high]
        assert isinstance(bands, Curve)
        assert list(zip(bands.y[::3], bands.y[1::3], strict=True)) == ends
        assert all(math.isnan(gap) for gap in bands.y[2::3])
        assert bands.name == ("stated band" if ends else "")
    words = " ".join(line.text for block in seen.of_kind(Lines) for line in block.lines)
    for said in (
        "model reference",
        "calibration rexroth-2006: boundary friction 0.143, ball force 0.011 of the load",
        "rexroth-double-nut: no-load torque of double nuts",
        "stated: Bosch Rexroth R310RU 3301 (2006.02); 100 rpm, ISO VG 100 at 25 degC, no load, no wipers",
        "stated: HIWIN S99TE20-1610; 100 rpm, ISO VG 68 at 25 degC, no load, no wipers",
    ):
        assert said in words
    with house_style():
        panels = pictures.picture(seen).axes
    for panel, chart in zip(panels, charts, strict=True):
        _, top = panel.get_ylim()
        assert all(0 < ratio < top for curve in chart.marks[2:] for ratio in curve.y)


def _values(found, set_name, name):
    (points,) = (entries[0].points for entries in found if entries[0].data.name == set_name)
    return len({point.descriptors[name] for point in points})


def test_sheets_as_json(ballscrew):
    both = document_of(ballscrew("validate", "thk-jis", "hiwin-ratings", "--sheet"))
    assert [sheet["title"].partition(":")[0] for sheet in both] == ["thk-jis", "hiwin-ratings"]
    _, ratios, rows, *_ = both[0]["blocks"]
    assert (ratios["name"], rows["name"]) == ("ratios", "rows")
    (example,) = document_of(ballscrew("validate", "thk-jis", "--json"))[0]["rows"]
    stated, model = rows["rows"][0][1:3]
    assert (stated["value"], stated["band"], model["value"]) == (example["middle"], example["band"], example["value"])
    (makers,) = document_of(ballscrew("validate", "thk-jis", "--summary", "--sheet"))
    assert [block["name"] for block in makers["blocks"] if block["kind"] == "table"] == ["makers"]


def test_own_rows_are_not_the_vendors(ballscrew, own):
    process = ballscrew("validate", "rexroth-single-nut", "--rows", own(GOOD, OTHER))
    assert process.returncode == 0, process.stderr
    assert "stated: rows of own.csv; 100 rpm" in process.stdout
    assert "chosen on these rows: nothing of the model" in process.stdout
    assert "Rexroth R310" not in process.stdout


# -- in a case file -------------------------------------------------------------------------------


CASE = {
    "screw": SCREW,
    "lubricant": {"viscosity": "100 mPa s"},
    "operation": {"axial_load": "5 kN", "screw_speed": "600 rpm"},
}


def test_a_case_with_a_calibration():
    model = case_file.build({**CASE, "model": {"calibration": "rexroth-2006"}}).model
    stored = calibration("rexroth-2006")
    assert model.friction.boundary_friction_coefficient == stored.boundary_friction_coefficient
    assert model.ball_force.share_of_load == stored.share_of_load
    assert model.slip is FrictionModel.reference().slip


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        ({"calibration": "rexroth-2007"}, r"model\.calibration: unknown calibration \(rexroth-2007\)"),
        ({"calibration": 5}, r"model\.calibration: must be text"),
        ({"calibration": "rexroth-2006", "ball_force": "imposed"}, r"model\.ball_force: is set by the calibration"),
        (
            {"calibration": "rexroth-2006", "friction": {"boundary_friction_coefficient": 0.1}},
            r"model\.friction\.boundary_friction_coefficient: is set by the calibration",
        ),
        ({"calibration": "rexroth-2006", "ball_to_ball_force": "1 N"}, r"model\.ball_to_ball_force: does not count"),
    ],
)
def test_a_case_that_contradicts_its_calibration(table, expected):
    with pytest.raises(InputError, match=expected):
        case_file.build({**CASE, "model": table})
