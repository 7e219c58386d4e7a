"""Logs that people bring: every row is used or counted, and what is wrong is said in a line."""

import hashlib

import numpy as np
import pytest

from ballscrew.files.tables import headings
from ballscrew.files.tables.headings import heading_of
from ballscrew.files.torque_logs.columns import COLUMNS
from support.log_texts import EXPECTED, HEADINGS, ROWS, RPM, in_display_units, lines_of

# -- columns --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "name", "unit"),
    [
        ("speed [rpm]", "screw_speed", "rpm"),
        ("n_rpm", "screw_speed", "rpm"),
        ("rpm", "screw_speed", "rpm"),
        ("n (1/min)", "screw_speed", "rpm"),
        ("Drehzahl [U/min]", "screw_speed", "rpm"),
        ("Motordrehzahl [min-1]", "screw_speed", "rpm"),
        ("Motor Speed [RPM]", "screw_speed", "rpm"),
        ("rotational speed [rad/s]", "screw_speed", "rad/s"),
        ("speed actual value [rpm]", "screw_speed", "rpm"),
        ("set speed [rpm]", None, ""),
        ("speed [m/min]", "screw_speed", "m/min"),
        ("axial_load_N", "axial_load", "N"),
        ("F [kN]", "axial_load", "kN"),
        ("Axialkraft Fa [kN]", "axial_load", "kN"),
        ("thrust_lbf", "axial_load", "lbf"),
        ("T [N m]", "torque", "N m"),
        ("T [s]", "time", "s"),
        ("T [°C]", "temperature", "°C"),
        ("T_Nm", "torque", "N m"),
        ("t_ms", "time", "ms"),
        ("T", None, ""),
        ("M_ist [Nm]", "torque", "N m"),
        ("Drehmoment [Ncm]", "torque", "N cm"),
        ("no-load torque [in-lb]", "friction_torque", "in lbf"),
        ("Reibmoment / Nm", "friction_torque", "N m"),
        ("motor torque [N·m]", "drive_torque", "N·m"),
        ("Iq [A]", "current", "A"),
        ("Motorstrom [mA]", "current", "mA"),
        ("Temperatur [C]", "temperature", "degC"),
        ("T_oil [K]", "temperature", "K"),
        ("Öltemperatur [°C]", "temperature", "°C"),
        ("Zeit [ms]", "time", "ms"),
        ("Vorschub [m/min]", "feed_rate", "m/min"),
        ("position [mm]", "position", "mm"),
    ],
)
def test_headings(written, name, unit):
    found = heading_of(written, 0, COLUMNS)
    assert (found.column.name if found else None, found.unit if found else "") == (name, unit)


@pytest.mark.parametrize("cell", ["59.13 " * 200, "n " * 200, "n " * 100])
def test_a_long_cell_is_no_heading_and_takes_no_time(cell, monkeypatch):
    """Without a limit, the letters tried grow with the fourth power of the words."""
    tried = []
    bare = headings.bare
    monkeypatch.setattr(headings, "bare", lambda name: tried.append(len(name)) or bare(name))
    assert heading_of(cell, 0, COLUMNS) is None
    assert sum(tried) < 1_000_000


def test_a_log(read):
    log = read(HEADINGS + ROWS)
    assert in_display_units(log) == EXPECTED
    assert log.time.tolist() == [0, 1, 2]
    assert log.line.tolist() == [2, 3, 4]
    assert log.kind == "friction"
    assert log.rows == 3
    assert not log.left_out
    assert not log.notes
    assert log.source == ("log.csv", hashlib.sha256((HEADINGS + ROWS).encode()).hexdigest())


@pytest.mark.parametrize(
    ("heading", "kind"),
    [("T [N m]", "unknown"), ("motor torque [N m]", "drive"), ("Reibmoment [N m]", "friction")],
)
def test_what_the_torque_is(heading, kind, read):
    assert read(f"n [rpm],F [N],{heading}\n1,2,3\n").kind == kind


def test_the_torque_that_says_most_is_taken(read):
    log = read("n [rpm],F [N],T [N m],I [A],Reibmoment [Nm]\n1,2,3,4,5\n")
    assert log.torque.tolist() == [5]
    assert log.kind == "friction"
    assert log.notes == ('columns not used: "T [N m]", "I [A]"',)


def test_a_current_is_a_torque_with_its_constant(read):
    text = "n [rpm],F [N],Iq [mA]\n1,2,3000\n"
    assert lines_of(read, text) == [
        'log.csv column "Iq [mA]": needs the torque constant · give --torque-constant "0.5 N m/A"'
    ]
    log = read(text, torque_constant=0.5)
    assert log.torque.tolist() == [1.5]
    assert log.kind == "drive"


def test_a_feed_rate_is_a_speed_with_the_lead(read):
    text = "feed rate [m/min],F [N],M [N m]\n-6,2,3\n"
    assert lines_of(read, text) == [
        'log.csv column "feed rate [m/min]": needs the lead · give the lead of the screw, or a column with its speed'
    ]
    assert read(text, lead=0.01).screw_speed == pytest.approx([-600 * RPM], rel=1e-12)


def test_units_in_a_row_below_the_headings(read):
    log = read(
        "Zeit;Drehzahl;Axialkraft;Motormoment;T_oil [K]\ns;1/min;[kN];Nm;\n0;100;1,5;0,5;300\n1;110;1,5;0,6;301\n"
    )
    assert log.screw_speed == pytest.approx([100 * RPM, 110 * RPM], rel=1e-12)
    assert log.axial_load.tolist() == [1500, 1500]
    assert log.temperature.tolist() == [300, 301]
    assert log.line.tolist() == [3, 4]


def test_columns_of_the_users_own_names(read):
    text = "t [s];n_soll [rpm];n_1;F_m [kN];Kanal 4 (raw);T\n0;50;100;1,5;500;30\n"
    flags = {
        "screw_speed": "n_1 [rpm]",
        "axial_load": "F_m",
        "torque": "Kanal 4 (raw) [N mm]",
        "temperature": "T [degC]",
    }
    log = read(text, columns=flags)
    assert in_display_units(log) == [(100, 1500, 0.5, 30)]
    assert log.time.tolist() == [0]
    assert log.notes == ('columns not used: "n_soll [rpm]"',)
    # what the user says comes before what the file says
    assert read("n [rpm],F [N],T [N m],M [N m]\n1,2,3,4\n", columns={"torque": "M [N mm]"}).torque.tolist() == [0.004]
    assert read("n [rpm],F [N],T [N m]\n1,2,3\n", columns={"friction torque": "T"}).kind == "friction"
    assert read("n [rpm],F [N],T [N m],Reibmoment [N m]\n1,2,3,4\n", columns={"drive_torque": "T"}).torque.tolist() == [
        3
    ]


#: The end of a line on a cell, where its row may be left out.
KEEP_GOING = ", or leave such rows out: --keep-going"


def test_faults_of_columns_of_the_users_own_keep_their_names(read):
    (line,) = lines_of(read, "n [rpm],F [N],M_x\n1,2,ERR\n", columns={"torque": "M_x [N m]"})
    assert line == f'log.csv row 2, column "M_x": is not a number (ERR) · write a number in N m{KEEP_GOING}'


def test_a_column_of_the_users_own_without_a_unit_is_asked_for_by_its_own_heading(read):
    text = "Stand 3,2024-05-01\nNo,n [rpm],F [N],Kanal 4\n1,1,2,0.4\n"
    (line,) = lines_of(read, text, columns={"torque": "Kanal 4"})
    assert line == (
        'log.csv column "Kanal 4": needs a unit · write "Kanal 4 [N m]", or give --column torque="Kanal 4 [N m]"'
    )
    assert read(text, columns={"torque": "Kanal 4 [N m]"}).torque.tolist() == [0.4]
    (line,) = lines_of(read, text, columns={"torque": "Kraft [N m]"})  # the line of the logger is no heading
    assert line.endswith("is not a column of the file (Kraft [N m]) · known: No, n [rpm], F [N], Kanal 4")


def test_what_is_the_same_in_every_row(read):
    log = read("n [rpm],M [N m]\n1,2\n3,4\n", columns={"axial_load": "0 N", "temperature": "40 degC"})
    assert log.axial_load.tolist() == [0, 0]
    assert log.temperature.tolist() == [313.15, 313.15]
    assert lines_of(read, "n [rpm],M [N m]\n1,2\n", columns={"axial_load": "0 mm"}) == [
        "--column axial_load: wrong unit (0 mm) · use a unit such as N, kN or lbf"
    ]


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        ({"torqe": "x"}, '--column: is no column of a log (torqe) · did you mean "torque"?'),
        (
            {"temperature": "temperatur"},
            '--column temperature: is not a column of the file (temperatur) · did you mean "temperature [degC]"?',
        ),
        ({"torque": "friction torque [kg]"}, "--column torque: wrong unit (friction torque [kg]) · use a unit"),
        ({"torque": "friction torque [Gx]"}, "--column torque: unknown unit (friction torque [Gx]) · use a unit"),
    ],
)  # fmt: skip
def test_faults_of_columns_of_the_users_own(columns, expected, read):
    (line,) = lines_of(read, HEADINGS + ROWS, columns=columns)
    assert line.startswith(expected)


@pytest.mark.parametrize(
    ("headings", "expected"),
    [
        (
            "n [rpm],F [N]",
            ['log.csv: has no column "torque [N m]" · it may also be called T, M, Md, or name it: '
             '--column torque="your heading [N m]"; headings of the file: n [rpm], F [N]'],
        ),
        (
            "n [rpm],Presskraft [kN],M [N m]",
            ['log.csv: has no column "axial_load [N]" · it may also be called F, Fa, F_ax, or name it: '
             '--column axial_load="your heading [N]"; if it is the same in every row, --column axial_load="0 N"; '
             'headings of the file: n [rpm], Presskraft [kN], M [N m]'],
        ),
        (
            "n,F,M [N m]",
            ['log.csv column "n": needs a unit · write "n [rpm]", or give --column screw_speed="n [rpm]"',
             'log.csv column "F": needs a unit · write "F [N]", or give --column axial_load="F [N]"'],
        ),
        (
            "n [rpm],motor speed [rpm],F [N],M [N m]",
            ['log.csv column "motor speed [rpm]": means the same as "n [rpm]" (screw speed) · '
             'give --column screw_speed="motor speed [rpm]" for the one that is meant'],
        ),
        ("n [kg],F [N],M [N m]",
         ['log.csv column "n [kg]": wrong unit (kg) · write it in rpm, such as "1500 rpm"']),
        ("n [rpm],F [Nn],M [N m]",
         ['log.csv column "F [Nn]": unknown unit (Nn) · use a unit such as N, kN or lbf']),
        ("time,n [rpm],F [N],M [N m]",
         ['log.csv column "time": needs a unit · write "time [s]", or give --column time="time [s]"']),
    ],
)  # fmt: skip
def test_faults_of_headings(headings, expected, read):
    row = ",".join("1" for _ in headings.split(","))
    assert lines_of(read, f"{headings}\n{row}\n") == expected


def test_two_of_one_kind_are_told_apart_by_the_user(read):
    text = "n [rpm],F [N],M [N m],T_oil [degC],T_nut [degC]\n1,2,3,20,30\n"
    assert "means the same as" in lines_of(read, text)[0]
    assert read(text, columns={"temperature": "T_nut"}).temperature.tolist() == [303.15]


# -- times ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "times",
    [
        ["2024-05-01 12:00:00", "2024-05-01 12:00:00.250", "2024-05-01 12:00:02"],
        ["2024-05-01T12:00:00,000", "2024-05-01T12:00:00,250", "2024-05-01T12:00:02,000"],
        ["2024-05-01T12:00:00Z", "2024-05-01T12:00:00.25Z", "2024-05-01T14:00:02+02:00"],
        ["01.05.2024 12:00:00.0", "01.05.2024 12:00:00.25", "01.05.2024 12:00:02.0"],
        ["12:00:00", "12:00:00.250", "12:00:02"],
        ["0", "0.25", "2"],
    ],
)
def test_times(times, read):
    unit = " [s]" if times[0] == "0" else ""
    body = "".join(f"{time};1;2;3\n" for time in times)
    log = read(f"timestamp{unit};n [rpm];F [N];M [N m]\n{body}")
    assert log.time == pytest.approx([0, 0.25, 2], abs=1e-9)


def test_a_time_that_is_none(read):
    text = "time;n [rpm];F [N];M [N m]\n2024-05-01 12:00:00;1;2;3\nyesterday;1;2;3\n;1;2;3\n"
    assert lines_of(read, text) == [
        'log.csv row 3, column "time": is no date and time (yesterday) · write times like 2024-05-31 12:00:00.5, '
        "all in the same way"
    ]
    log = read(text, keep_going=True)
    assert log.left_out == {"a value cannot be read": 1}
    assert log.time[0] == 0
    assert np.isnan(log.time[1])


def test_dates_begin_with_the_first_piece(read):
    rows = [f"2024-05-01 12:00:{second:02d};1;2;{second}\n" for second in range(40)]
    log = read("time;n [rpm];F [N];M [N m]\n" + "".join(rows), chunk=7)
    assert log.time.tolist() == log.torque.tolist() == list(range(40))


# -- text -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_delimiters_endings_and_encodings(delimiter, ending, encoding, read):
    text = (HEADINGS.replace("degC", "°C") + ROWS).replace(",", delimiter).replace("\n", ending)
    log = read(text.encode(encoding), "log.txt")
    assert in_display_units(log) == EXPECTED
    assert log.line.tolist() == [2, 3, 4]


def test_decimal_commas_and_quotes(read):
    text = 'n [rpm],F [N],M [N m],note\n"1,5","2",3,"a, b"\n"2,5",2,"3,25",\n'
    log = read(text)
    assert (log.screw_speed / RPM).tolist() == pytest.approx([1.5, 2.5])
    assert log.torque.tolist() == [3, 3.25]
    text = "n [rpm];F [N];M [N m]\n1,5;2;3\n2;1,234;0,5\n"
    assert read(text).axial_load.tolist() == [2, 1.234]
    # no mark at the top of the file, but further down
    text = "n [rpm];F [N];M [N m]\n" + "1;2;3\n" * 6000 + "1;2;0,5\n1;2;1,234\n"
    assert read(text).torque[-2:].tolist() == [0.5, 1.234]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1,234;5;6\n", "may have a separator of thousands (1,234) · write 1234 for thousands, 1.234 for a decimal"),
        (
            "0,5;5;6\n1.234;5;6\n",
            "may have a separator of thousands (1.234) · write 1234 for thousands, 1,234 for a decimal",
        ),
        (
            "0.5;5;6\n1,234;5;6\n",
            "may have a separator of thousands (1,234) · write 1234 for thousands, 1.234 for a decimal",
        ),
        ("1.234,5;5;6\n", "has a separator of thousands (1.234,5) · write it without"),
        ("1 000;5;6\n", "has a separator of thousands (1 000) · write 1000"),
    ],
)
def test_nobody_guesses_a_factor_of_a_thousand(text, expected, read):
    (line,) = lines_of(read, "n [rpm];F [N];M [N m]\n" + text)
    assert 'column "n [rpm]": ' + expected in line


def test_preambles_comments_and_blank_rows(read):
    preamble = "Logger 3000\n# made in 2024\n" + "".join(f"channel {n}: on\n" for n in range(40))
    log = read(
        preamble
        + "\n"
        + HEADINGS
        + "0,100,1000,0.5,30\n\n# a pause, 5 s\n1,110,1100,0.6,30.5\n,,,,\n2,-120,1200,-0.7,31\n"
    )
    assert in_display_units(log) == EXPECTED
    assert log.line.tolist() == [45, 48, 50]
    assert log.rows == 3


def test_headings_again_where_a_logger_began_anew(read):
    units = "time,n,F,Reibmoment\ns,rpm,N,Nm\n"
    log = read(units + "0,1,2,3\n1,1,2,3\n" + units + "0,1,2,4\n")
    assert log.torque.tolist() == [3, 3, 4]
    assert log.line.tolist() == [3, 4, 7]
    (line,) = lines_of(read, units + "0,1,2,Nm\n")
    assert line == 'log.csv row 3, column "Reibmoment": is not a number (Nm)'


def test_cells_with_units_of_their_own(read):
    log = read(HEADINGS + "0,100,1000,0.5,30\n500 ms,2 rev/s,1 kN,500 N mm,300 K\n")
    assert in_display_units(log) == [(100, 1000, 0.5, 30), (120, 1000, 0.5, 26.85)]
    assert log.time.tolist() == [0, 0.5]
    log = read("n,F [N],M [N m]\n100 rpm,2,3\n2 rev/s,2,3\n")
    assert (log.screw_speed / RPM).tolist() == pytest.approx([100, 120])
    (line,) = lines_of(read, HEADINGS + "0,100,5 kg,0.5,30\n")
    assert line == 'log.csv row 2, column "axial load [N]": wrong unit (5 kg) · use a unit such as N, kN or lbf'


# -- rows that are bad ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        ("ERR", "is not a number (ERR) · write a number in N m"),
        ("overrange", "is not a number (overrange) · write a number in N m"),
        ("inf", "must be a finite number (inf)"),
        ("1e999", "must be a finite number (inf)"),
        ("True", "is not a number (True)"),
        ("0.5 kg", "wrong unit (0.5 kg) · use a unit such as N m, N mm or lbf in"),
    ],
)
def test_text_in_numbers(cell, expected, read):
    text = HEADINGS + ROWS.replace("0.6", cell)
    (line,) = lines_of(read, text)
    assert line.startswith('log.csv row 3, column "friction torque [N m]": ' + expected)
    log = read(text, keep_going=True)
    assert in_display_units(log) == [EXPECTED[0], EXPECTED[2]]
    assert log.left_out == {"a value cannot be read": 1}
    assert log.rows == 3
    assert log.notes == (line.removesuffix(KEEP_GOING),)


def test_an_error_in_the_first_column_is_no_comment(read):
    """It is a missing value, and its row is read."""
    log = read(HEADINGS + ROWS + "#DIV/0!,1,2,3,4\n")
    assert log.rows == 4
    assert any("(#DIV/0!)" in note for note in log.notes)


def test_ten_lines_at_most(read):
    text = HEADINGS + "0,ERR,1000,0.5,30\n" * 12 + ROWS
    lines = lines_of(read, text)
    assert len(lines) == 10
    assert lines[0].startswith("log.csv row 2, ")
    assert lines[-1] == "and 3 more"
    log = read(text, keep_going=True)
    assert log.notes == tuple(line.removesuffix(KEEP_GOING) for line in lines)
    assert log.left_out == {"a value cannot be read": 12}


def test_a_file_of_faults_is_given_up_early(read):
    text = HEADINGS + "0,ERR,1000,0.5,30\n" * 5000
    assert lines_of(read, text, chunk=500)[-1] == "and 991 more"
    assert "has no rows" not in lines_of(read, text, keep_going=True)[0]


def test_temperatures_below_absolute_zero(read):
    (line,) = lines_of(read, HEADINGS + ROWS.replace("31\n", "-300\n"))
    assert line.startswith('log.csv row 4, column "temperature [degC]": must be ')
    assert "(-300) · not colder than absolute zero" in line


def test_gaps_are_counted(read):
    log = read(
        HEADINGS
        + ROWS
        + "3,,1000,0.5,30\n4,100,NaN,0.5,30\n5,100,1000,nan,30\n6,100,1000,-,30\n7,130,1300,0.8,\n8,140\n"
    )
    assert log.rows == 9
    clean = log.cleaned()
    assert clean.left_out == {"a value is missing or impossible": 6}
    assert in_display_units(clean) == EXPECTED


def test_columns_that_are_empty(read):
    text = "time [s],n [rpm],F [N],M [N m],T [degC]\n" + ",1,2,3,\n" * 4
    clean = read(text).cleaned()
    assert clean.temperature is None
    assert clean.time is None
    assert len(clean) == 4
    text = "n [rpm],F [N],M [N m]\n" + "1,,\n" * 4
    assert lines_of(read, text) == [
        'log.csv column "F [N]": is empty · give it numbers, or another column',
        'log.csv column "M [N m]": is empty · give it numbers, or another column',
    ]


def test_rows_with_more_cells_than_headings(read):
    text = "n [rpm],F [N],M [N m]\n1,2,3\n1,2,3,\n6,35,4,5\n"
    assert lines_of(read, text) == [
        "log.csv row 4: has more cells than the headings, 3 · put quotes around text that holds a delimiter"
    ]
    assert len(read(text.replace("6,35,4,5", "6,35,4,,,,,,,,,,,"))) == 3
    assert "row 4: has more cells" in lines_of(read, text.replace("6,35,4,5", ",".join("1" * 99)))[0]


@pytest.mark.parametrize("text", ["n [rpm],M_R [N m]\n10,1\n20,2\n30,3\n", "n,M_R\nrpm,N m\n10,1\n20,2\n30,3\n"])
def test_a_log_without_a_column_of_the_load_is_one_of_no_load_and_says_so(read, text):
    found = read(text)
    assert found.axial_load.tolist() == [0.0, 0.0, 0.0]
    (note,) = [note for note in found.notes if "no column of the load" in note]
    assert '0 N in every row; give --column axial_load="your heading [N]"' in note
    given = read(text, columns={"axial_load": "2 kN"})
    assert given.axial_load.tolist() == [2000.0] * 3
    assert not [note for note in given.notes if "no column of the load" in note]


def test_another_column_in_a_unit_of_force_may_be_the_load_and_is_asked_for(read):
    for text in ("n [rpm],Presse [kN],M_R [N m]\n10,1,1\n20,1,2\n", "n,Presse,M_R\nrpm,kN,N m\n10,1,1\n20,1,2\n"):
        (line,) = lines_of(read, text)
        assert line.startswith('log.csv: has no column "axial_load [N]"')
        assert read(text, columns={"axial_load": "Presse [kN]"}).axial_load.tolist() == [1000.0, 1000.0]
