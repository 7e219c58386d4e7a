"""Tables people bring: every row is good, or has a fault that says where and what to do."""

import codecs
import datetime
import importlib
import math
import sys
from pathlib import Path

import openpyxl
import pytest
import xlsxwriter

from ballscrew.axis.motion import trajectory_file
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.evidence.moving_logs import columns
from ballscrew.evidence.validation.sets import SETS
from ballscrew.files.tables import cells, rows, sheets
from ballscrew.files.tables.headings import Column, heading_of, headings_in, known_heading_of
from ballscrew.files.tables.sheets import Record
from ballscrew.files.torque_logs import columns as torque_logs
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.questions.validate.compute import columns_of
from support.log_texts import lines_of

FIELDS = fields_of(CatalogueRow)
LEAD, BALL = Column("lead", FIELDS["lead"], ("Ph", "P"), True), Column("ball_diameter", FIELDS["ball_diameter"])
TURNS, STARTS = Column("turns", FIELDS["turns"], ("i",)), Column("starts", FIELDS["starts"])
NAME = Column("name", aliases=("model",))
COLUMN = (NAME, LEAD, BALL, TURNS, STARTS)


def test_names_of_columns_have_letters():
    """So numbers, which most cells of a log are, need not be looked at to find its headings."""
    known = [*COLUMNS, *torque_logs.COLUMNS, *columns.COLUMNS, *trajectory_file.COLUMNS]
    names = [name for column in known for name in (column.name, *column.aliases, *column.hints, *column.capitals)]
    assert all(any(map(str.isalpha, name)) for name in names)
    assert known_heading_of("-12.5", 0, known) is None
    assert known_heading_of("lead_mm", 0, COLUMN) == heading_of("lead_mm", 0, COLUMN) is not None


@pytest.fixture
def table(tmp_path):
    """Read a text as a file."""

    def read(text, columns=COLUMN, name="screws.csv"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return rows.read(path, columns)

    return read


def values(found, name):
    return [row.values.get(name) for row in found.rows]


# -- headings -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "name", "unit"),
    [
        ("lead_mm", "lead", "mm"),
        ("lead [mm]", "lead", "mm"),
        ("LEAD (in)", "lead", "in"),
        ("Ph_mm", "lead", "mm"),
        ("P_h [mm]", "lead", "mm"),
        ("Ph / mm", "lead", "mm"),
        ("Lead Ph [µm]", "lead", "µm"),
        ("d0 [mm]", "nominal_diameter", "mm"),
        ("d₀ [mm]", "nominal_diameter", "mm"),
        ("Nominal-Diameter d0 (mm)", "nominal_diameter", "mm"),
        ("Dw [mm]", "ball_diameter", "mm"),
        ("Ball Ø [mm]", "ball_diameter", "mm"),
        ("Ball ⌀ [mm]", "ball_diameter", "mm"),
        ("Nenndurchmesser d0 [mm]", "nominal_diameter", "mm"),
        ("Screw shaft outer dia. d (mm)", "nominal_diameter", "mm"),
        ("Durchmesser d0 [mm]", "nominal_diameter", "mm"),
        ("d [mm]", None, ""),
        ("d_mm", None, ""),
        ("Dia. d [mm]", None, ""),
        ("Ø [mm]", None, ""),
        ("Steigung P [mm]", "lead", "mm"),
        ("Kugel-Ø Dw [mm]", "ball_diameter", "mm"),
        ("Ball dia. (mm)", "ball_diameter", "mm"),
        ("Teilkreisdurchmesser [mm]", "pitch_circle_diameter", "mm"),
        ("Ball centre-to-centre dia dp mm", "pitch_circle_diameter", "mm"),
        ("Thread minor dia dc mm", "root_diameter", "mm"),
        ("Kerndurchmesser d2 [mm]", "root_diameter", "mm"),
        ("Root dia", "root_diameter", ""),
        ("tragende Umläufe i", "turns", ""),
        ("Umlaeufe", "turns", ""),
        ("No. of loaded circuits Rows × turns", "turns", ""),
        ("Gangzahl", "starts", ""),
        ("dynamische Tragzahl C [kN]", "dynamic_load_rating", "kN"),
        ("Tragzahl C0a [kN]", "static_load_rating", "kN"),
        ("Basic load rating Ca kN", "dynamic_load_rating", "kN"),
        ("Basic load rating [kN]", None, ""),
        ("Steifigkeit [N/µm]", "rigidity", "N/µm"),
        ("Druckwinkel α [°]", "contact_angle", "°"),
        ("Schmiegung", "conformity", ""),
        ("Bezeichnung", "name", ""),
        ("Mutterart", "nut", ""),
        ("preload 10 % of Ca [kN]", None, ""),
        ("D1 [mm]", "nut_outer_diameter", "mm"),
        ("D_1_mm", "nut_outer_diameter", "mm"),
        ("D₁ (mm)", "nut_outer_diameter", "mm"),
        ("Nut outer diameter D1 [mm]", "nut_outer_diameter", "mm"),
        ("Mutter-Ø D1 [mm]", "nut_outer_diameter", "mm"),
        ("d1 [mm]", None, ""),  # of the shaft
        ("Preload Fpr [kN]", "preload", "kN"),
        ("preload_N", "preload", "N"),
        ("Vorspannung [%]", "preload", "%"),
        ("preload_percent", "preload", "%"),
        ("lead [%]", "lead", "%"),  # to be refused: no share
        ("Dichtung [Nm]", "seal_torque", "N m"),
        ("Messung", "log", ""),
        ("nut diameter d1 [mm]", None, ""),
        ("dm [mm]", "pitch_circle_diameter", "mm"),
        ("d_m_mm", "pitch_circle_diameter", "mm"),
        ("d_m", "pitch_circle_diameter", ""),
        ("ball circle, mm", "pitch_circle_diameter", "mm"),
        ("PCD mm", "pitch_circle_diameter", "mm"),
        ("Ca (kN)", "dynamic_load_rating", "kN"),
        ("C_kgf", "dynamic_load_rating", "kgf"),
        ("dynamic_load_rating_N", "dynamic_load_rating", "N"),
        ("Dynamic load rating Ca [N]", "dynamic_load_rating", "N"),
        ("C0a N", "static_load_rating", "N"),
        ("stiffness_kgf_per_um", "rigidity", "kgf/um"),
        ("rigidity_10pct_N_per_um", "rigidity", "N/um"),
        ("rigidity_7pct_N_per_um", None, ""),
        ("Rnu [N/µm]", "rigidity", "N/µm"),
        ("alpha [°]", "contact_angle", "°"),
        ("α (deg)", "contact_angle", "deg"),
        ("f [-]", "conformity", ""),
        ("circuits", "turns", ""),
        ("i (circuits)", "turns", ""),
        ("Part Number", "name", ""),
        ("nut", "nut", ""),
        ("torque [Nm]", None, ""),
        ("no_load_torque_10pct_max_Nm", None, ""),
        ("Lead angle [deg]", None, ""),
        ("", None, ""),
        (40.0, None, ""),
    ],
)
def test_headings(written, name, unit):
    heading = heading_of(written, 0, COLUMNS)
    assert (heading and heading.column.name, heading.unit if heading else "") == (name, unit)


@pytest.mark.slow
@pytest.mark.parametrize("columns", [COLUMNS, *map(columns_of, SETS.values())])
def test_no_name_means_two_columns(columns):
    """Each name means its own column, alone and beside its other names and hints; no hint means one alone."""
    for column in columns:
        names = (column.name, *column.aliases)
        for text in (*names, *(f"{one} {other}" for one in names for other in (*names, *column.hints))):
            found = heading_of(text, 0, columns)
            assert found is not None, text
            assert found.column is column, text
        assert [heading_of(hint, 0, columns) for hint in column.hints] == [None] * len(column.hints)


def test_what_means_two_columns_means_none():
    twins = (Column("one", aliases=("both",)), Column("two", aliases=("both",)))
    assert heading_of("both", 0, twins) is None


def test_turns_may_be_products(table):
    columns = [column for column in COLUMNS if column.name in ("turns", "rigidity")]
    found = table("Rows x turns\n2x2.5\n2.5 × 2\n1X3\n5\n2x\n2x2x2\n-2x2\n", columns)
    assert values(found, "turns") == [5, 5, 3, 5]
    assert [line for line, _ in found.faults] == [6, 7, 8]
    commas = table("Umläufe;Steifigkeit [N/um]\n2x2,5;1,5\n", columns)
    assert values(commas, "turns") == [5]
    assert "takes no unit (2x2)" in str(table("starts\n2x2\n", (STARTS,)).faults[0][1])


def test_missing_columns_and_units_are_said_at_once(table):
    lines = lines_of(table, "d0,Dw,i,name\n40,6,4,A\n", COLUMNS)
    assert lines == [
        'screws.csv: has no column "lead [mm]" · it may also be called Ph, P, Steigung',
        'screws.csv column "d0": needs a unit · write "d0 [mm]"',
        'screws.csv column "Dw": needs a unit · write "Dw [mm]"',
    ]


def test_units_are_those_of_case_files(table):
    force = Column("force", FIELDS["dynamic_load_rating"])
    temperature = Column("temperature", TEMPERATURE)
    for unit in ("N", "kN", "kgf", "lbf"):
        (row,) = table(f"force_{unit}\n12.5\n", (force,)).rows
        assert row.values["force"] == pytest.approx(units.parse("", f"12.5 {unit}", force.quantity), rel=1e-15)
    (row,) = table("force_kgf\n12.5\n", (force,)).rows
    assert row.values["force"] == pytest.approx(122.583125, rel=1e-15)
    (row,) = table("temperature [°C]\n40\n", (temperature,)).rows
    assert row.values["temperature"] == pytest.approx(313.15, rel=1e-15)
    (row,) = table("lead\n0.2 in\n").rows
    assert row.values["lead"] == pytest.approx(0.00508, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("name,lead\nA,5\n", 'screws.csv column "lead": needs a unit · write "lead [mm]"'),
        ("lead [kg]\n5\n", 'screws.csv column "lead [kg]": wrong unit (kg) · use a unit such as mm, um or in'),
        ("lead [parsec]\n5\n", 'screws.csv column "lead [parsec]": unknown unit (parsec) · use a unit such as'),
        ("lead [MM]\n5\n", 'unknown unit (MM) · did you mean "mm"?'),
        ("lead [mm],turns [mm]\n5,4\n", 'column "turns [mm]": takes no unit (mm) · it is a plain number'),
        ("lead [mm],Ph_mm\n5,5\n", 'column "Ph_mm": means the same as "lead [mm]" (lead) · leave out one of the two'),
        ("leed_mm,turns\n5,4\n", 'screws.csv: has no column "lead [mm]" · write it for "leed_mm"'),
        ("turns\n4\n", 'screws.csv: has no column "lead [mm]" · it may also be called Ph, P'),
        (
            "foo,bar\n4,5\n",
            'screws.csv: has no heading that is known ("foo", "bar") · begin with a row like: lead [mm]',
        ),
        ("5,4\n6,4\n", "has no heading that is known"),
        ("lead_mm\n", "screws.csv: has no rows below its headings"),
        ("lead\n", "screws.csv: has no rows below its headings"),
        ("lead_mm,turns\n , \n\n# 5,4\n", "screws.csv: has no rows below its headings"),
        ("", "screws.csv: is empty"),
        ("\n \n;;;\n# nothing\n", "screws.csv: is empty"),
        ('lead_mm,name\n5,"A\n6,B\n', "screws.csv row 2: cannot be split into cells"),
        ('lead_mm,name\n5,"A"B\n', "screws.csv row 2: cannot be split into cells"),
        (b"lead_mm\n\x00\x01\n", "is neither text nor a spreadsheet"),
        (b"lead_mm\n\x81\x8d\n", "is neither text nor a spreadsheet"),
        (b"PK\x03\x04 no zip", "is no spreadsheet that can be read"),
        ("lead_mm,name\n5," + "x" * 200_000 + "\n", "cannot be split into cells"),
    ],
)
def test_faults_of_a_table(text, expected, table):
    (line,) = lines_of(table, text)
    assert expected in line


def test_files_that_are_not_there(tmp_path):
    assert "does not exist · give the path" in lines_of(rows.read, tmp_path / "none.csv", COLUMN)[0]
    assert "cannot be read (Is a directory)" in lines_of(rows.read, tmp_path, COLUMN)[0]
    (tmp_path / "book.xlsx").write_text("lead_mm\n5\n", encoding="utf-8")
    assert "is no spreadsheet that can be read" in lines_of(rows.read, tmp_path / "book.xlsx", COLUMN)[0]


# -- text -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
def test_delimiters_and_line_endings(delimiter, ending, table):
    lines = ["name;lead [mm];i", '# comment; with "quotes', "", '"A ""1"" ball";5;4', " B ; 10.5 ;2.5"]
    found = table(ending.join(line.replace(";", delimiter) for line in lines))
    assert values(found, "name") == ['A "1" ball', "B"]
    assert values(found, "lead") == [0.005, 0.0105]
    assert values(found, "turns") == [4, 2.5]
    assert [row.line for row in found.rows] == [4, 5]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_encodings(encoding, table):
    found = table("model;Ph [mm]\nMüller µ;5\n".encode(encoding))
    assert values(found, "name") == ["Müller µ"]
    assert table(codecs.BOM_UTF8 + b"lead_mm\n5\n").count == 1


def test_titles_declarations_and_cells_of_several_lines(table):
    text = 'sep=;\nBall screws of 2024\n\nname;lead [mm]\n"A\nB";5\nC;-6\n'
    found = table(text)
    assert [(row.line, row.values["name"]) for row in found.rows] == [(5, "A B")]
    assert [str(fault) for _, fault in found.faults] == [
        'screws.csv row 7, column "lead [mm]": must be positive (-6) · lengths are positive'
    ]


def test_a_heading_with_another_delimiter_in_it(table):
    assert values(table('"name; model",lead_mm\nA;B,5\n'), "lead") == [0.005]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Ph [mm]\n-5\n", 'row 2, column "Ph [mm]": must be positive (-5) · lengths are positive'),
        ("Ph [mm]\nnan\n", 'row 2, column "Ph [mm]": must be a finite number (nan)'),
        ("Ph [mm]\n-inf\n", 'row 2, column "Ph [mm]": must be a finite number (-inf)'),
        ("Ph [mm]\n1e999\n", 'row 2, column "Ph [mm]": must be a finite number (1e999)'),
        ("Ph [mm]\nfive\n", 'row 2, column "Ph [mm]": is not a number (five) · write a number in mm'),
        ("Ph [mm],i\n#DIV/0!,4\n", 'row 2, column "Ph [mm]": is not a number (#DIV/0!) · write a number in mm'),
        ("Ph [mm],i\n5,#N/A\n", 'row 2, column "i": is not a number (#N/A) · write a plain number'),
        ("Ph [mm],i\n5,0.1\n", 'row 2, column "i": must be above 0.24 (0.1) · nuts have 2 to 6'),
        ("Ph [mm],i\n5,4 mm\n", 'row 2, column "i": takes no unit (4 mm)'),
        ("Ph [mm],i\n5,54 %\n", 'row 2, column "i": takes no unit (54 %) · write 0.54'),
        ("Ph [mm],starts\n5,1.5\n", 'row 2, column "starts": must be a whole number (1.5)'),
        ("Ph [mm],i\n,4\n", 'row 2, column "Ph [mm]": is empty · give a value; of merged cells only the first has one'),
        ("Ph [mm],i\n-,4\n", 'row 2, column "Ph [mm]": is empty'),
        ("Ph [mm]\n5 kg\n", 'row 2, column "Ph [mm]": wrong unit (5 kg)'),
        ("Ph\n5 mm\n6\n", 'row 3, column "Ph": needs a unit (6) · write "6 mm", or the unit in the heading'),
        ("Ph [mm],i\n5\n", "row 2: has 1 cells, the headings 2 · give every column a cell"),
        ("Ph [mm],i\n5,4,3\n", "row 2: has 3 cells, the headings 2 · give every column a cell"),
        ("Ph [mm],i\n6,35,4\n", "put quotes around text that holds a delimiter"),
        ("Ph [mm];i\n1 000;4\n", 'column "Ph [mm]": has a separator of thousands (1 000) · write 1000'),
        ("Ph [mm];i\n1'000;4\n", "has a separator of thousands (1'000) · write 1000"),
        ("Ph [mm];i\n1.234,5;4\n", 'column "Ph [mm]": has a separator of thousands (1.234,5) · write it without'),
        ("Ph [mm];i\n1,234,567;4\n", "has a separator of thousands (1,234,567) · write it without"),
        ("Ph [mm];i\n12,300;4\n", "thousands (12,300) · write 12300 for thousands, 12.3 for a decimal"),
        ("Ph [mm];i\n6,35;4\n1.234;4\n", "row 3, column \"Ph [mm]\": may have a separator of thousands (1.234)"),
        ("Ph [mm];i\n6.35;4\n1,234;4\n", "thousands (1,234) · write 1234 for thousands, 1.234 for a decimal"),
        ('Ph [mm],i\n"1,234",4\n', "thousands (1,234) · write 1234 for thousands, 1.234 for a decimal"),
        ("Ph [mm]\n5\x1b[31m\n", "unknown unit (5 [31m) · use a unit such as mm"),
    ],
)  # fmt: skip
def test_faults_of_a_row(text, expected, table):
    found = table(text)
    (line,) = [str(fault) for _, fault in found.faults]
    assert line.startswith("screws.csv row ")
    assert expected in line


def test_decimal_commas(table):
    found = table("name;Ph [mm];Dw [mm];i\nA;10;6,35;2,5\nB;5,0;3,175;4\nC;5.5;3,5 mm;1e0\n")
    assert not found.faults
    assert values(found, "ball_diameter") == [None, None, None]
    assert found.unused == ['"Dw [mm]"']
    found = table("name;Ph [mm];ball diameter [mm];i\nA;10;6,35;2,5\nB;5,0;3,175;4\nC;5,5;3,5 mm;1e0\n")
    assert not found.faults
    assert values(found, "ball_diameter") == pytest.approx([0.00635, 0.003175, 0.0035], rel=1e-12)
    assert values(found, "turns") == [2.5, 4.0, 1.0]
    quoted = table('Ph [mm],i\n"6,35",4\n"3,175",4\n')
    assert values(quoted, "lead") == pytest.approx([0.00635, 0.003175], rel=1e-12)


@pytest.mark.parametrize(
    ("texts", "marks"),
    [(["3,175"], ""), (["6,35"], ","), (["0,540"], ","), (["1.234,5"], ","), (["1,234.5", "7"], "."),
     (["6,35", "6.35"], ",."), (["1,234,567"], ""), (["x", "-,"], ""), (["5,5 mm"], ",")],
)  # fmt: skip
def test_evidence_of_decimal_marks(texts, marks):
    assert cells.evidence(texts) == frozenset(marks)


def test_nobody_guesses_a_factor_of_a_thousand():
    """A number that may be two is refused, whatever marks the rest of the table has, unless they agree."""
    for decimal, text in [("", "1,234"), (".", "1,234"), (",.", "1,234"), (",", "1.234"), (",.", "1.234")]:
        found = cells.with_point("", text, frozenset(decimal))
        assert isinstance(found, Fault)
        written = found.parts[2].partition("thousands, ")[2].partition(" ")[0]  # as the remedy says
        assert float(cells.with_point("", written, frozenset(decimal))) == 1.234
    for decimal, text in [(",", "1,234"), ("", "1.234"), (".", "1.234")]:
        assert cells.with_point("", text, frozenset(decimal)) == "1.234"


def test_unicode_minus_and_signs(table):
    found = table("lead_mm\n+5\n−5\n")
    assert values(found, "lead") == [0.005]
    assert "must be positive (−5)" in str(found.faults[0][1])


# -- what is made of rows -------------------------------------------------------------------------

MIXED = "model,Ph [mm],i,note\nA,5,4,x\nB,-5,4,y\nC,x,y,z\nD,6,4,\n"


def test_any_fault_refuses_everything(table):
    found = table(MIXED)
    lines = lines_of(rows.made, found, lambda row: row)
    assert [line.partition(":")[0] for line in lines] == [
        'screws.csv row 3, column "Ph [mm]"',
        'screws.csv row 4, column "Ph [mm]"',
        'screws.csv row 4, column "i"',
    ]


def test_keep_going_loses_nothing_silently(table):
    found, lines = rows.made(table(MIXED), lambda row: row.values["name"], keep_going=True)
    assert found == ["A", "D"]
    assert lines[0] == 'screws.csv: columns not used: "note"'
    assert len(lines) == 5
    assert lines[-1] == "screws.csv: 2 of 4 rows left out"
    assert lines_of(rows.made, table("Ph [mm]\n-5\n"), lambda row: row, keep_going=True)


def test_faults_of_what_is_made_are_those_of_the_row(table):
    def make(row):
        if row.values["lead"] > 0.0055:
            raise InputError(
                Fault("screw.lead", "too big", "0.006 m", "below 0.0055 m", bound=0.0055), Fault("x.y", "odd")
            )
        return row

    lines = lines_of(rows.made, table(MIXED.replace("-5", "5").replace("x,y", "5,4")), make)
    assert lines == ['screws.csv row 5, column "Ph [mm]": too big (6) · below 5.5 mm', "screws.csv row 5, y: odd"]


def test_ten_lines_at_most(table):
    lines = lines_of(rows.made, table("Ph [mm]\n" + "-5\n" * 30), lambda row: row)
    assert len(lines) == 10
    assert lines[-1] == "and 21 more"


def test_columns_nobody_asked_for_are_named(table):
    found = table("lead_mm,colour,,x\n5,red,note,\n")
    assert found.unused == ['"colour"', "column 3 (no heading)", '"x"']


# -- spreadsheets ---------------------------------------------------------------------------------


def test_a_spreadsheet(tmp_path):
    path = tmp_path / "screws.xlsx"
    with xlsxwriter.Workbook(path) as book:
        book.add_worksheet("cover")
        sheet = book.add_worksheet("screws")
        sheet.write_row(0, 0, ["Ball screws"])
        sheet.write_row(2, 1, ["Model", "Ph [mm]", "i", "starts"])
        sheet.write_row(3, 1, ["A", 10, 4, 1])
        sheet.write_row(4, 1, [4010, "6,35", "2.5", "2"])
        sheet.write_formula(5, 1, '="B"&"1"', value="B1")
        sheet.write_row(5, 2, ["0.2 in", 3])
        sheet.write_row(7, 1, ["C", -5, True])
        sheet.write(7, 3, True)
        sheet.write_datetime(8, 2, datetime.datetime(2024, 5, 2), book.add_format({"num_format": "d.m.yyyy"}))
        sheet.merge_range(9, 1, 10, 1, "D")
        sheet.merge_range(9, 2, 10, 2, 5)
        sheet.write(9, 3, 4)
        sheet.write(10, 3, 5)
    found = rows.read(path, COLUMN)
    assert [(row.line, row.values.get("name")) for row in found.rows] == [(4, "A"), (5, "4010"), (6, "B1"), (10, "D")]
    assert values(found, "lead") == pytest.approx([0.01, 0.00635, 0.00508, 0.005], rel=1e-12)
    assert values(found, "starts") == [1, 2, None, None]
    assert isinstance(found.rows[0].values["starts"], int)
    assert [str(fault) for _, fault in found.faults] == [
        'screws.xlsx row 8, column "Ph [mm]": must be positive (-5) · lengths are positive',
        'screws.xlsx row 8, column "i": is not a number (True) · a spreadsheet makes dates of numbers: '
        "format the cell as a number",
        'screws.xlsx row 9, column "Ph [mm]": is not a number (2024-05-02) · a spreadsheet makes dates of numbers: '
        "format the cell as a number",
        'screws.xlsx row 11, column "Ph [mm]": is empty · give a value; of merged cells only the first has one',
    ]


def test_a_spreadsheet_of_another_program(tmp_path):
    path = tmp_path / "screws.data"  # a spreadsheet is known by how it begins
    book = openpyxl.Workbook()
    book.active.append(["lead_mm", "turns", None])
    book.active.append(["# a note on all of it"])
    book.active.append([5, 4, "beside"])
    book.active.append(["#1", 4])
    book.active.append([math.pi, None])
    book.save(path)
    found = rows.read(path, COLUMN)
    assert values(found, "lead") == pytest.approx([0.005, math.pi * 1e-3])
    assert values(found, "turns") == [4, None]
    assert found.unused == ["column 3 (no heading)"]
    assert [line for line, _ in found.faults] == [4]


def test_empty_and_broken_spreadsheets(tmp_path):
    path = tmp_path / "empty.xlsx"
    openpyxl.Workbook().save(path)
    assert lines_of(rows.read, path, COLUMN) == [f"{path}: is empty · give a table with headings and rows"]
    path.write_bytes(path.read_bytes()[:2000])
    assert "is no spreadsheet that can be read" in lines_of(rows.read, path, COLUMN)[0]


def test_without_the_extra_a_spreadsheet_says_what_to_install(tmp_path, monkeypatch):
    path = tmp_path / "screws.xlsx"
    openpyxl.Workbook().save(path)
    monkeypatch.setitem(sys.modules, "python_calamine", None)
    (line,) = lines_of(rows.read, path, COLUMN)
    assert line == f'{path}: needs python-calamine · pip install "ballscrew[data]", or save it as CSV'
    monkeypatch.undo()
    assert importlib.import_module("python_calamine")


# -- very many columns ----------------------------------------------------------------------------


def test_of_very_many_columns_none_is_looked_up():
    """A log of 100,000 of them was refused after half a minute: each was looked up among all names."""
    looked_up = []
    text = ",".join(f"a{i}" for i in range(100_000))
    assert sheets.delimiter_of(text, looked_up.append) == ","
    assert looked_up == []
    wide = [Record(1, [f"a{i}" for i in range(sheets.MOST_COLUMNS + 1)])]
    with pytest.raises(InputError, match=r"has too many columns \(5,001\) · 5,000 at most: keep those that are needed"):
        headings_in(Path("log.csv"), wide, [LEAD])


@pytest.mark.parametrize("content", [b"\0" * 4000, b"\n" * 1000, b""])
def test_a_trace_with_nothing_in_it_is_empty(tmp_path, content):
    """Defect: an error of Python, as there was no first row to name."""
    path = tmp_path / "trace.csv"
    path.write_bytes(content)
    with pytest.raises(InputError, match="is empty · give a table with headings and rows"):
        trajectory_file.read_trajectory(path)
