"""Tables of one's own with what is listed of the nut: kind, preload, seals, outer diameter, log."""

import openpyxl
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables import catalogue
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.ratings import ratings_of

HEAD = "Part number;d0 [mm];Ph [mm];Dw [mm];i;starts;Ca [kN];Preload;Seals;D1 [mm];Nut;log;Gewinderichtung\n"
OWN = f"""{HEAD}\
A;40;10;6,35;4;1;50,3;7 %;standard;70;Double;logs/a.csv;rechts
B;40;20;6,35;4;2;50,3;3,5 kN;0,2 N m;;oversize;;
C;40;10;6,35;4;1;50,3;;ohne;;single;;
D;40;10;6,35;4;1;;5 %;;;Doppelmutter;;
E;40;10;6,35;4;1;50,3;;;70;double;;
"""
GERMAN = """\
Bezeichnung;d0 [mm];Ph [mm];Dw [mm];i;Ca [kN];Vorspannung [%];Dichtung [Nm];Mutter-Ø D1 [mm];Mutter
A;40;10;6;4;50;7;0,4;70;Doppelmutter
B;40;10;6;4;50;3 kN;ohne;;Einzelmutter mit Kugelübermaß
C;40;10;6;4;50;7,5 %;400 N mm;;Doppel
"""


@pytest.fixture
def table(tmp_path):
    """The rows of a text as a file."""

    def read(text, **options):
        path = tmp_path / "own.csv"
        path.write_text(text, encoding="utf-8")
        return bs.screws(path, **options)

    return read


def test_a_row_has_its_nut(table, tmp_path):
    rows = table(OWN)
    assert rows["A"].screw().nut == bs.DoubleNut(
        0.07 * 50300, bodies=Bodies(nut_outer_diameter=0.07), losses={"seals": bs.Seals(0.4)}
    )
    assert rows["B"].screw().nut == bs.OversizeBallNut(3500.0, losses={"seals": bs.Seals(0.2)})
    assert rows["B"].screw().starts == 2
    assert rows["D"].screw().nut == bs.DoubleNut(0.05 * ratings_of(rows["D"]).dynamic)
    # without a preload and seals the balls are a row, as those of the catalogue are, whatever their D1 is
    assert rows["C"].screw().nut == rows["E"].screw().nut == bs.SingleNut()
    assert rows.logs == {"A": tmp_path / "logs" / "a.csv"}
    assert rows.notes == ('own.csv: columns not used: "Gewinderichtung"',)


def test_columns_in_german(table):
    rows = table(GERMAN)
    listed = [
        (row.nut, row.preload, row.preload_share, row.seal_torque, row.nut_outer_diameter) for row in rows.values()
    ]
    assert listed == [
        ("double", None, pytest.approx(0.07), 0.4, 0.07),
        ("oversize-balls", 3000.0, None, 0.0, None),
        ("double", None, pytest.approx(0.075), pytest.approx(0.4), None),
    ]


@pytest.mark.parametrize("name", "ABCDE")
def test_a_case_of_a_row_has_its_nut(name, table, tmp_path):
    """Named in a case, or written as one: what the case says counts, what it leaves out is that of the row."""
    row = table(OWN)[name]
    common = {"lubricant": {"viscosity": "88 mPa s"}, "operation": {"axial_load": "5 kN", "screw_speed": "600 rpm"}}
    tables = {"screw": {"catalogue": name, "catalogue_file": "own.csv"}, **common}
    nut = row.screw().nut
    assert case_file.build(tables, folder=tmp_path).screw.nut == nut
    if name == "A":
        changed = {**tables, "nut": {"preload": "2 kN"}, "bodies": {}, "losses": {"seals": {"seal_torque": "1 N m"}}}
        found = case_file.build(changed, folder=tmp_path).screw.nut
        assert found == bs.DoubleNut(2000.0, bodies=Bodies(nut_outer_diameter=0.07), losses={"seals": bs.Seals(1.0)})
    path = tmp_path / "own.toml"
    path.write_text(catalogue.case_text(row), encoding="ascii")
    written = case_file.load(path).screw.nut
    assert written.losses == nut.losses
    assert written.bodies == Bodies(nut_outer_diameter=row.nut_outer_diameter)
    if name in "AB":  # D has no listed rating: a case counts whole balls for it
        assert (type(written), float(written.preload)) == (type(nut), pytest.approx(float(nut.preload)))


GOOD = "A;40;10;6,35;4;1;50,3;7 %;0,4 N m;70;double;;"


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("double", "single", 'column "Preload": a nut of type "single" has none (7 %) · leave it empty, or give'),
        ("double", "", 'column "Preload": needs the kind of nut that has it (7 %) · give the nut as "oversize-balls"'),
        ("double", "triple", 'column "Nut": unknown kind of nut (triple) · known: single, oversize-balls, double'),
        ("7 %", "60 kN", 'column "Preload": exceeds the dynamic load rating (60 kN) · check the number and its unit'),
        ("7 %", "120 %", 'column "Preload": must be at most 100 % (120 %) · vendors have 2 to 10 %'),
        ("7 %", "-7 %", 'column "Preload": must not be negative (-7 %)'),
        ("7 %", "0,07 %", 'column "Preload": is too small a share of the dynamic load rating (0,07 %) · vendors have'),
        ("7 %", "7", 'column "Preload": needs a unit (7) · write "7 kN" or "7 %", or the unit in the heading'),
        ("7 %", "light", 'column "Preload": is not a number (light) · write a number in kN'),
        ("0,4 N m", "rubber", 'column "Seals": is neither a number nor a word that is known (rubber) · write "1'),
        ("0,4 N m", "0,4", 'column "Seals": needs a unit (0,4) · write "0,4 N m", or the unit in the heading'),
        ("A;40;10;6,35;4;1;50,3;7 %;0,4 N m", "A;41;10;6,35;4;1;50,3;7 %;standard",
         'column "Seals": no standard seals are known of this size (standard) · nearest: 40 mm, any lead; write the'),
        (";70;", ";46;", 'column "D1 [mm]": leaves no wall around the balls (46) · check the unit and the column'),
        (";1;", ";1,5;", 'column "starts": must be a whole number (1,5)'),
    ],
)  # fmt: skip
def test_bad_nuts(old, new, expected, table):
    assert table(HEAD + GOOD)["A"].preload_share == pytest.approx(0.07)
    with pytest.raises(InputError) as caught:
        table(HEAD + GOOD.replace(old, new))
    (line,) = caught.value.lines()
    assert line.startswith(f"own.csv row 2, {expected}")
    kept = table(f"{HEAD}{GOOD.replace(old, new)}\n{GOOD.replace('A', 'B')}", keep_going=True)
    assert list(kept) == ["B"]
    assert kept.notes[1:] == (line, "own.csv: 1 of 2 rows left out")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "own.csv: is empty"),
        (HEAD, "own.csv: has no rows below its headings"),
        (f"{HEAD}{GOOD}\n{GOOD}", 'own.csv row 3, column "Part number": is given twice (A) · row 2 has it, too'),
        (f"{HEAD}{GOOD}".replace("Dw [mm]", "x"), 'own.csv: has no column "ball_diameter [mm]"'),
        (f"{HEAD}{GOOD}".replace("log", "preload [%]"), 'own.csv column "preload [%]": means the same as "Preload"'),
    ],
)
def test_bad_tables(text, expected, table):
    with pytest.raises(InputError) as caught:
        table(text)
    (line,) = caught.value.lines()
    assert expected in line


def test_a_name_that_the_table_does_not_have(table):
    with pytest.raises(KeyError, match=r"own\.csv: unknown row \(F\) · known: A, B, C, D, E"):
        table(OWN)["F"]


def test_shares_of_a_spreadsheet(tmp_path):
    """A cell in per cent of a spreadsheet is a hundredth of what it shows."""
    book = openpyxl.Workbook()
    book.active.append(["name", "d0 [mm]", "Ph [mm]", "Dw [mm]", "i", "Ca [kN]", "Preload [%]", "Nut"])
    book.active.append(["A", 40, 10, 6, 4, 50, 7, "double"])
    book.active.append(["B", 40, 10, 6, 4, 50, 0.07, "double"])
    book.save(tmp_path / "own.xlsx")
    kept = bs.screws(tmp_path / "own.xlsx", keep_going=True)
    assert {name: row.preload_share for name, row in kept.items()} == {"A": pytest.approx(0.07)}
    assert (
        'own.xlsx row 3, column "Preload [%]": is too small a share of the dynamic load rating (0.07)' in kept.notes[0]
    )


def test_a_preload_and_a_share_of_a_row():
    given = {"name": "A", "nominal_diameter": 0.04, "lead": 0.01, "ball_diameter": 6e-3, "turns": 4, "nut": "double"}
    with pytest.raises(InputError, match=r"A\.preload_share: is given beside the preload"):
        CatalogueRow(**given, preload=1000.0, preload_share=0.05)
    with pytest.raises(InputError, match=r"A\.nut: unknown kind of nut"):
        CatalogueRow(**{**given, "nut": "two"})
