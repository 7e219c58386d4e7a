"""Texts of case files at their limits, settings, and the inputs that a document has of a case."""

import dataclasses
import math
import types

import pytest

import ballscrew as bs
from ballscrew.basis.errors import MISSING, Fault, InputError
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.cases.case_files import case_file, case_text, descriptions, fitted_case, uncertain_inputs
from ballscrew.cases.case_files.case import Origins
from ballscrew.cases.schema import case_schema
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.cases.schema.reader import in_options
from ballscrew.cases.screw_tables.catalogue import assumed, seal_source
from ballscrew.cases.screw_tables.catalogue import case_text as text_of
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from support.commands import ROOT
from support.drive_case import drive_case

ROW = bs.catalogue()["hiwin-40-20k4"]


def built(text=""):
    return case_file.build(case_text.toml(drive_case() + text))


def test_whole_numbers_up_to_the_largest_float():
    """A double has an exponent of 1024 at most: 2¹⁰²³ is one, 2¹⁰²⁴ is none."""
    assert case_text.toml(f"a = {2**1023}") == {"a": 2**1023}
    assert case_text.toml(f"a = [{{b = -{2**1023}}}]")["a"][0]["b"] == -(2**1023)
    with pytest.raises(OverflowError):
        float(2**1024)
    with pytest.raises(ValueError, match="more than 1024 bits"):
        case_text.toml(f"a = {2**1024}")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[a]\nb = 1\nc = 2\nb = 3\n', '"b" of [a] is given twice (lines 2 and 4) · leave one of them out'),
        ('b = 1\n\nb = 3\n', '"b" of the file is given twice (lines 1 and 3) · leave one of them out'),
        ('[a]\nb = 1\n[c]\nb = 1\n[a]\nd = 1\n', "[a] is given twice (lines 1 and 5) · put their keys into one"),
        ("[[a]]\nb = 1\n[[a]]\nb = 1\nc = 1\nc = 2\n", '"c" of the table of line 3 is given twice (lines 5 and 6)'),
    ],
)  # fmt: skip
def test_what_is_given_twice_is_told_with_its_lines(text, words, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as raised:
        case_file.read(path)
    assert words in str(raised.value)


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("axial_load=4 kN", "write operation.axial_load=4 kN"),
        ("wibble=4 kN", 'write operation.axial_load="4 kN"'),
        ("axial_load", 'write operation.axial_load="4 kN"'),
        ("operation.=4", 'write operation.axial_load="4 kN"'),
        ("operation.axial_load.size=4", "set axial_load itself"),
    ],
)
def test_settings_that_are_none_say_how(setting, words):
    with pytest.raises(InputError) as raised:
        case_file.override({"operation": {"axial_load": "1 kN"}}, [setting])
    assert words in str(raised.value)


def test_settings_go_into_their_tables():
    tables = {"operation": {"axial_load": "1 kN"}, "model": {"friction": "zhou-hoeprich"}}
    settings = ['operation.axial_load = "4 kN"', "limits.static_safety=3", "screw.catalogue=hiwin-40-20k4"]
    assert case_file.override(tables, settings) == {
        "operation": {"axial_load": "4 kN"},
        "model": {"friction": "zhou-hoeprich"},
        "limits": {"static_safety": 3},
        "screw": {"catalogue": "hiwin-40-20k4"},
    }


def test_inputs_have_what_is_given_and_nothing_else():
    """Limits but for the usual ones, and of the mounting what is known: all in SI."""
    plain = dataclasses.replace(built(), installation=None)
    assert "installation" not in descriptions.inputs(plain)
    assert "limits" not in descriptions.inputs(plain)
    mounted = Installation(unsupported_length=1.2, ends=Ends.FIXED_FREE, bearing_rigidity=4e8)
    found = descriptions.inputs(dataclasses.replace(plain, installation=mounted, limits=Limits(static_safety=3.0)))
    assert found["installation"] == {
        "unsupported_length": 1.2,
        "ends": "fixed-free",
        "shaft_density": 7850.0,
        "bearing_rigidity": 4e8,
    }
    assert found["limits"]["static_safety"] == 3.0
    assert found["limits"]["buckling_safety"] == 2.0


def test_seals_say_whose_torque_they_have():
    """Where the row stands that the torque of its seals is from elsewhere, and the case has that torque."""

    def said(torque, **fields):
        row = dataclasses.replace(ROW, seal_torque=0.2, **fields)
        nut = types.SimpleNamespace(losses={} if torque is None else {"seals": bs.Seals(torque)})
        case = types.SimpleNamespace(origins=Origins(row=row), screw=types.SimpleNamespace(nut=nut))
        # one line of a text, which stands among many
        return descriptions._seals_of_row(case)

    of_maker = "seals 0.2 N m: measured by us; give the torque of your seals if you know it"
    assert said(0.2, seal_torque_source="measured by us") == [of_maker]
    assert said(0.3, seal_torque_source="measured by us") == []
    assert said(None, seal_torque_source="measured by us") == []
    assert said(0.2) == []
    maker = seal_source("HIWIN")
    assert maker in said(0.2, seal_torque_source=maker, make="HIWIN")[0]
    bare = types.SimpleNamespace(nut=types.SimpleNamespace(losses={}))
    without_row = types.SimpleNamespace(origins=Origins(), screw=bare)
    assert descriptions._seals_of_row(without_row) == []


def test_what_stands_for_what_a_row_leaves_out():
    listed = dataclasses.replace(ROW, starts=2, contact_angle=0.7, conformity=0.53)
    assert set(assumed(listed)) == {"loaded_turns"}
    bare = dataclasses.replace(ROW, pitch_circle_diameter=None)
    assert set(assumed(bare)) == {"starts", "contact_angle", "conformity", "pitch_circle_diameter", "loaded_turns"}
    assert "45 deg" in assumed(bare)["contact_angle"]
    assert "the row lists no pitch circle" in text_of(bare)
    assert "the row lists no pitch circle" not in text_of(ROW)


@pytest.mark.parametrize("torque", [None, 0.25])
def test_the_case_of_a_row_has_its_seals(torque):
    row = dataclasses.replace(ROW, seal_torque=torque, seal_torque_source="" if torque is None else "by hand")
    text = text_of(row)
    assert ("[losses]" in text) is (torque is not None)
    if torque is not None:
        assert 'seals.seal_torque = "0.25 N m"' in text
        assert text.splitlines()[text.splitlines().index("[losses]") + 1].endswith("# by hand")
        assert "# as listed" in text_of(dataclasses.replace(row, seal_torque_source=""))
        case = case_file.build(case_text.toml(text))
        assert case.screw.nut.losses["seals"] == bs.Seals(0.25)


def test_an_axis_has_a_mass():
    assert json_schema()["$defs"]["Axis"]["required"] == ["mass"]
    assert "required" not in json_schema()["$defs"]["Motion"]


@pytest.mark.parametrize("written", ["600 rpm ± 5 %", "12 m/min ± 5 %"])
def test_a_speed_may_be_uncertain(written):
    """Of the screw, or of the nut along it."""
    tables = case_text.toml(drive_case())
    tables["operation"]["screw_speed"] = written
    case = case_file.build(tables)
    given = 600 / 60 if "rpm" in written else 12 / 60 / case.screw.lead
    assert case.operation.screw_speed == pytest.approx(2 * math.pi * given)


@dataclasses.dataclass(frozen=True)
class OwnLaw:
    """A law with two numbers that have no unit, of which one has a default."""

    share: float
    power: float = 2.0
    made: float = dataclasses.field(default=0.0, init=False)


@pytest.mark.parametrize(
    ("table", "where"),
    [
        ({"share": 0.5}, []),
        ({"share": 1, "power": 3.5}, []),
        ({"share": 0.5, "made": 1.0}, ["law.made"]),
        ({"share": "0.5"}, ["law.share"]),
        ({"share": True}, ["law.share"]),
        ({"power": 1.0}, ["law.share"]),
        ({"chare": 1.0}, ["law.chare", "law.share"]),
    ],
)
def test_numbers_of_a_law_of_ones_own(table, where):
    faults = []
    assert case_schema.with_plain_numbers("law", OwnLaw, table, faults) == table
    assert [fault.where for fault in faults] == where


def test_a_function_has_no_numbers():
    faults = []
    assert case_schema.with_plain_numbers("law", len, {"share": 1.0}, faults) == {}
    assert [fault.where for fault in faults] == ["law.share"]


@pytest.mark.parametrize(
    ("where", "problem", "given", "expected"),
    [
        ("model.name", "unknown", {"model.name"}, "--model"),
        ("model.name", "unknown", {"model.calibration"}, "model.name"),
        ("model.name", MISSING, {"model.calibration"}, "--model"),
        ("model.name", MISSING, {"operation.axial_load"}, "model.name"),
        ("operation.axial_load", "unknown", {"operation.axial_load"}, "operation.axial_load"),
    ],
)
def test_a_fault_names_the_option_that_gave_the_field(where, problem, given, expected):
    (fault,) = in_options([Fault(where, problem)], given)
    assert fault.where == expected


def test_a_number_of_a_fit_as_a_case_file_has_it():
    """Behind the sign half of the interval that holds 95 %: 1.96 standard errors; and the section before the name."""
    friction = Quantity("boundary_friction_coefficient", "1", Info("mu", "a coefficient"))
    preload = Quantity("preload", "N", Info("F", "a preload", "kN"))
    one = types.SimpleNamespace(value=0.1, std=0.01, quantity=friction)
    # one line of a text, which stands among many
    value, half = fitted_case._written(one).split(" ± ")
    assert (float(value), float(half)) == (0.1, pytest.approx(0.0196, rel=1e-3))
    known = types.SimpleNamespace(value=3000.0, std=None, quantity=preload)
    assert fitted_case._written(known) == "3 kN"
    places = {"friction.decay": ("model", friction), "nut.preload": ("nut", preload), "lead": ("screw", preload)}
    # one line of a text, which stands among many
    found = [fitted_case._place(places, name) for name in places]
    assert found == ["model.friction.decay", "nut.preload", "screw.lead"]


def test_a_remedy_names_the_options_of_its_own_section():
    options = {"model.name": "--model", "nut.preload": "--preload"}
    (fault,) = in_options(
        [Fault("model.name", MISSING, remedy="write name = one, or preload = another")], {"model.name"}, options
    )
    assert fault.remedy == "write --model one, or preload = another"


def test_what_a_fit_writes_has_no_nulls():
    written = fitted_case._plain({"one": None, "some": ({"two": None, "three": 3}, 4.0)})
    assert written == {"some": [{"three": 3}, 4.0]}


FITTED = {"numbers": ["ball_diameter", "preload"], "values": [0.1, 3000.0],
          "covariance": [[1e-6, 1e-3], [1e-3, 100.0]]}  # fmt: skip


def fitted(**changes):
    case = case_file.load(ROOT / "examples" / "service.toml")
    return dataclasses.replace(case, origins=dataclasses.replace(case.origins, fit={**FITTED, **changes}))


@pytest.mark.parametrize(
    "changes",
    [
        {"values": [0.1]},
        {"values": [math.nan, 3000.0]},
        {"covariance": [[math.inf, 0.0], [0.0, 1.0]]},
        {"covariance": [[1.0, 2.0], [2.0, 1.0]]},
        {"covariance": [1.0, 2.0]},
    ],
    ids=["too few values", "a value that is none", "a variance without end", "more than correlated", "no square"],
)
def test_a_table_of_a_fit_that_none_has_written_is_refused(changes):
    with pytest.raises(InputError, match=r"^calibration: is not as a fit writes it"):
        uncertain_inputs.joint_of(fitted(**changes), {})


def test_numbers_of_a_fit_count_where_they_are_still_what_it_found():
    """Of any distribution its middle counts; a number that was changed by hand is no longer that of the fit."""
    inputs = {
        "ball_diameter": types.SimpleNamespace(distribution=bs.LogNormal(0.1, 1.2)),
        "preload": types.SimpleNamespace(distribution=bs.Normal(3000.0, 10.0)),
    }
    joint = uncertain_inputs.joint_of(fitted(), inputs)
    assert (joint.names, joint.covariance.tolist()) == (tuple(FITTED["numbers"]), FITTED["covariance"])
    joint = uncertain_inputs.joint_of(fitted(values=[0.2, 3000.0]), inputs)
    assert (joint.names, joint.covariance.tolist()) == (("preload",), [[100.0]])
