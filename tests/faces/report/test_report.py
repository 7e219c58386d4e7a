"""``ballscrew report``: read back as people and machines read it."""

import dataclasses
import datetime
import functools
import io
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from html.parser import HTMLParser

import numpy as np
import pypdf
import pytest

from ballscrew.basis.errors import InputError
from ballscrew.basis.output.sheet import Number, Share
from ballscrew.basis.output.sheet import words as words_of
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Origins
from ballscrew.cases.case_files.descriptions import references
from ballscrew.faces.report import contents, curve_figures, input_tables
from ballscrew.faces.report.contents import Heading
from ballscrew.faces.report.curves import curves
from ballscrew.faces.report.pdf import html_bytes, pdf_bytes, report_bytes
from ballscrew.faces.sheets.report_blocks import (
    Bar,
    Bullets,
    Columns,
    Links,
    Paragraph,
    Picture,
    Report,
    Section,
    Table,
    value,
)
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.nut_losses import ConstantTorque
from ballscrew.questions.band import compute
from ballscrew.questions.check.answer import checked
from ballscrew.questions.run.compute import run
from support.commands import ROOT

EXAMPLES = sorted(path.name for path in (ROOT / "examples").glob("*.toml"))
#: Enough for the words, and quick.
SAMPLES = 64
_TORQUE = quantities_of(FrictionResult)["screw_torque"]
_OVERSIZE = ('nut.type="oversize-balls"', 'nut.preload="2 kN"')

#: What no reader should see.
_NO_NUMBERS = re.compile(r"\b(nan|None|inf)\b")
_EXPONENT = re.compile(r"(?<!\w)\d[\d.]*[eE][-+\u2212]?\d+(?!\w)")
#: The share of the height between the margins that each page has content on, at least.
LEAST_FILLED = 0.3

CASES = {
    **{name.removesuffix(".toml"): (name, ()) for name in EXAMPLES},
    "at rest": ("feed_drive.toml", ('operation.screw_speed="0 rpm"',)),
    "without load": ("feed_drive.toml", ('operation.axial_load="0 N"',)),
    "nothing": ("feed_drive.toml", ('operation.axial_load="0 N"', 'operation.screw_speed="0 rpm"')),
    "oversize balls": ("feed_drive.toml", _OVERSIZE),
    "calibrated": ("feed_drive.toml", ('model.calibration="rexroth-2006"',)),
    "overloaded": ("feed_drive.toml", ('operation.axial_load="900 kN"',)),
    "all that can be said": (
        "catalogue_screw.toml",
        (
            'screw.contact_angle="44 deg"',
            'screw.screw_conformity="0.54 ± 0.01"',
            'screw.screw_material.young_modulus="210 GPa"',
            'deviations.ball_diameter="0.3 um"',
            'deviations.lead="1 um"',
            'losses.seals.law="known"',
            'losses.seals.seal_torque="0.2 N m"',
            'losses.churning="spheres"',
            'losses.recirculation="force"',
            'model.friction.law="greenwood-tripp"',
            'model.friction.asperity_radius="20 um"',
            'model.full_film="eyring"',
            'model.ball_force.law="proportional"',
            "model.ball_force.share_of_load=0.001",
        ),
    ),
}


def case_of(name):
    file, settings = CASES[name]
    return case_file.load(ROOT / "examples" / file, settings)


@functools.cache
def content_of(name):
    """What the report of a case says: computed for the first test that asks."""
    return contents.content(case_of(name), samples=SAMPLES)


@pytest.fixture(scope="module")
def content():
    return content_of("catalogue_screw")


@pytest.fixture(scope="module")
def pdf():
    return pypdf.PdfReader(io.BytesIO(pdf_bytes(content_of("catalogue_screw"))))


@pytest.fixture(scope="module")
def page():
    return Page(html_bytes(content_of("catalogue_screw")).decode())


class Page(HTMLParser):
    """A page as its tags, and what can be read on it."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.read, self.source, self._hidden = [], "", text, 0
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self._hidden += tag == "style"

    def handle_endtag(self, tag):
        self._hidden -= tag == "style"
        self.read += " " * (tag in ("th", "td", "li", "p", "text"))

    def handle_data(self, data):
        if not self._hidden:
            self.read += data

    @property
    def words(self):
        return re.sub(r"\s+", " ", self.read)


def pictures_of(content):
    """What the pictures of a report show, in words."""
    return [block.words for section in content.sections for block in section.blocks if isinstance(block, Picture)]


def text_and_least_filled(reader):
    """The text, and the least share of the height between the margins down to which a page has some above its footer.

    Both at once, as to read the drawings of a page takes the longest.
    """
    texts, shares = [], []
    for sheet in reader.pages:
        heights = []

        def visit(text, page, line, *_, heights=heights):
            if text.strip():
                heights.append(line[4] * page[1] + line[5] * page[3] + page[5])

        texts.append(sheet.extract_text(visitor_text=visit))
        top, height = 14 / 25.4 * 72, float(sheet.mediabox.height)
        bottom = 15 / 25.4 * 72
        lowest = min((y for y in heights if y > bottom), default=height)
        shares.append((height - top - lowest) / (height - top - bottom))
    return re.sub(r"\s+", " ", " ".join(texts)), min(shares)


def text_of(reader):
    return text_and_least_filled(reader)[0]


def structure_of(reader):
    """All elements of the structure tree of a PDF: kind and alternative text."""
    found = []

    def walk(node):
        node = node.get_object()
        if isinstance(node, list):
            for each in node:
                walk(each)
        elif isinstance(node, dict):
            if "/S" in node:
                found.append((node["/S"], node.get("/Alt")))
            if "/K" in node:
                walk(node["/K"])

    walk(reader.trailer["/Root"]["/StructTreeRoot"])
    return found


# -- what is in it --------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_numbers_are_those_of_the_program(pdf, page):
    found = run(case_of("catalogue_screw"))
    result = found.friction
    bands = compute.band(case_of("catalogue_screw"), compute.BandOptions(samples=SAMPLES)).band
    torque = Number(float(result.screw_torque), _TORQUE, band=bands["screw_torque"].both)
    said = [
        f"Friction torque on the screw {words_of(torque)}",
        f"efficiency {words_of(Share(float(result.efficiency), band=bands['efficiency'].both))}",
        f"drag torque without seals {value(found.nut.preload_drag, _TORQUE)}",
        *(value(float(part), _TORQUE) for part in result.contributions.values() if part),
        *(record.text.capitalize()[:20] for record in found.verdicts),
    ]
    for words in (text_of(pdf), page.words):
        assert [text for text in said if text not in words] == []


def pieces(lines):
    """A report that begins with so many lines; all below them stays together in pieces, named by a word of each."""
    side = [
        [Table(f"{name}-title", ("", "value"), [(f"{name}-row-{row}", "1") for row in range(8)]) for name in names]
        for names in (("left-a", "left-b"), ("right-a", "right-b"))
    ]
    blocks = {
        "Opening": [Paragraph("opening-strong " * 60, strong=True), Paragraph("opening-words"), Columns(*side)],
        "Cautions": [Paragraph("cautions-words"), Bullets([f"cautions-entry-{entry}" for entry in range(6)])],
        "Sources": [Links([(f"sources-entry-{entry}", "") for entry in range(12)])],
    }
    filler = [Paragraph(f"line {line}") for line in range(lines)]
    sections = [Section("Filler", filler), *(Section(title, blocks) for title, blocks in blocks.items())]
    together = [
        [f"{name}-title", f"{name}-row-0", f"{name}-row-7"] for name in ("left-a", "left-b", "right-a", "right-b")
    ]
    together += [["Opening", "opening-strong", "opening-words", "left-a-row-7"]]
    together += [["Cautions", "cautions-words", "cautions-entry-0", "cautions-entry-5"]]
    together += [["Sources", "sources-entry-0", "sources-entry-2"]]
    return Report("Pieces", ("of a report",), sections, "nobody", pages=9), together


@pytest.mark.parametrize("lines", range(20, 50, 3))
def test_no_page_ends_within_a_table_a_list_or_behind_a_heading(lines):
    report, together = pieces(lines)
    pages = [sheet.extract_text() for sheet in pypdf.PdfReader(io.BytesIO(pdf_bytes(report))).pages]
    for words in together:
        found = [{number for number, text in enumerate(pages) if word in text} for word in words]
        assert len(found[0]) == 1
        assert all(each == found[0] for each in found), (words, found)


def test_every_input_is_there_with_its_origin(content):
    case = case_of("catalogue_screw")
    (columns,) = [
        b for s in content.sections if s.title == "Inputs and model" for b in s.blocks if isinstance(b, Columns)
    ]
    tables = {table.title: table.rows for table in (*columns.left, *columns.right)}
    screw = {what: (words, origin) for what, words, origin in tables["Screw"]}
    for name, quantity in fields_of(case.screw).items():
        assert screw[quantity.info.meaning][0] == value(float(getattr(case.screw, name)), quantity)
    assert screw["ball diameter"] == ("6 mm", "catalogue")
    assert screw["screw groove radius / ball diameter"] == ("0.54", "usual")
    assert screw["RMS roughness of the balls"][1] == "default"
    assert ("ends of the screw", "fixed-supported", "case") in tables["Installation"]
    assert {"Lubricant", "Operating point", "Nut", "Limits of the checks"} <= set(tables)
    assert len([title for title in tables if "what is not marked is that of reference" in title]) == 1


def test_what_a_case_has_as_an_estimate_is_marked_as_one_until_it_is_changed():
    path = ROOT / "examples" / "catalogue_screw.toml"
    tables = case_file.read(path)
    places = {"installation": "unsupported_length", "nut": "preload", "lubricant": "grade", "operation": "axial_load"}
    tables["estimates"] = {section: {name: tables[section][name]} for section, name in places.items()}
    tables["operation"]["axial_load"] = "4.5 kN"
    found = input_tables.tables(case_file.build(tables, folder=path.parent))
    marked = {(table.title, row[0]) for table in found for row in table.rows if row[-1] == input_tables.ESTIMATE}
    assert marked == {
        ("Installation", "length of the shaft between its bearings"),
        ("Nut", "axial preload without external load"),
        ("Lubricant", "grade"),
    }
    assert "estimate: estimated when the case was made" in input_tables.sources_in_words(case_file.load(path), found)


@pytest.mark.parametrize("wrong", ["all", {"installation": "1 m"}])
def test_a_table_of_estimates_that_is_none_is_refused(wrong):
    tables = {**case_file.read(ROOT / "examples" / "catalogue_screw.toml"), "estimates": wrong}
    with pytest.raises(InputError, match="estimates: must be a table of sections"):
        case_file.build(tables, folder=ROOT / "examples")


@pytest.mark.slow
def test_what_a_case_changes_is_marked_as_its_own():
    found = content_of("all that can be said")
    rows = [
        row
        for section in found.sections
        for block in section.blocks
        if isinstance(block, Columns)
        for table in (*block.left, *block.right)
        for row in table.rows
    ]
    assert ("screw groove radius / ball diameter", "0.54 ± 0.01", "case") in rows
    assert ("angle of the contact normal against the radial plane", "44 deg", "case") in rows
    (friction,) = [row[1] for row in rows if row[0] == "friction"]
    assert friction.startswith("greenwood-tripp: ")
    assert "asperity radius 20 µm" in friction
    assert friction.endswith("(from: case)")
    assert ("rolling", "biboulet-houpert") in rows


def test_parts_sum_to_the_torque_and_bars_repeat_them(content):
    (table,) = next(s for s in content.sections if s.title == "Where the torque comes from").blocks
    *parts, together = table.rows
    total = float(together[1].split()[0])
    assert sum(float(row[1].split()[0]) for row in parts) == pytest.approx(total, rel=1e-3)
    for _, torque, share, bar in parts:
        assert isinstance(bar, Bar)
        assert bar.end - bar.start == pytest.approx(float(torque.split()[0]) / total, abs=1e-3)
        assert float(share.rstrip("%")) == pytest.approx(100 * (bar.end - bar.start), abs=0.06)
    assert list(parts) == sorted(parts, key=lambda row: -row[3].end)


def test_checks_are_those_of_the_command(content):
    case = case_of("catalogue_screw")
    found = checked("", case)
    verdict, table = next(s for s in content.sections if s.title == "Checks").blocks
    assert found.verdict.lower() in verdict.text.lower()
    assert [row[0] for row in table.rows] == [one.name.replace("_", " ") for one in found.checks]
    assert all(row[4].startswith(("passes: ", "passes; by ")) for row in table.rows)


def test_sources_are_those_that_were_used(content):
    (links,) = next(s for s in content.sections if s.title == "Sources").blocks
    assert isinstance(links, Links)
    words = [text.partition(":")[0] for text, _ in links.entries]
    assert words == list(dict.fromkeys(words))
    case = case_of("catalogue_screw")
    # THK514E: the general limit of the DN value
    assert set(references(case)) | {"Rexroth2006", "ISO3408-5", "SKF2018", "THK514E"} <= set(words)
    assert "Saltelli2010" not in words
    links_of = dict(zip(words, (link for _, link in links.entries), strict=True))
    assert links_of["Olaru2005"] == "https://doi.org/10.1007/1-4020-2933-0_20"


@pytest.mark.slow
def test_torque_that_a_fit_found_besides_is_a_part_of_the_torque():
    fit = {
        "log": "rig_log.csv",
        "constant_torque": "0.08 N m",
        "numbers": ["friction.boundary_friction_coefficient"],
        "values": [0.12],
        "covariance": [[1e-6]],
        "holdout_rms": "0.0155 N m",
    }
    plain = case_of("rig")
    nut = dataclasses.replace(plain.screw.nut, losses={"constant": ConstantTorque(0.08)})
    case = dataclasses.replace(plain, screw=dataclasses.replace(plain.screw, nut=nut), origins=Origins(fit=fit))
    found = contents.content(case, samples=SAMPLES)
    (table,) = next(s for s in found.sections if s.title == "Where the torque comes from").blocks
    assert ["constant", "0.08 N m"] in [row[:2] for row in table.rows]
    (own,) = next(s for s in content_of("rig").sections if s.title == "Where the torque comes from").blocks
    alone, together = (float(rows[-1][1].split()[0]) for rows in (own.rows, table.rows))
    assert together == pytest.approx(alone + 0.08, abs=1e-4)
    beware = next(section for section in found.sections if section.title == "What to beware of")
    assert "not compared with measurements" not in str(beware)
    assert "not compared with measurements" in str(
        next(s for s in content_of("rig").sections if s.title == beware.title)
    )


@pytest.mark.parametrize(("name", "arrows"), [("at rest", False), ("oversize balls", False), ("feed_drive", True)])
def test_the_caption_tells_of_arrows_where_there_are_some(name, arrows):
    # one part alone: a report takes seconds
    (picture,) = contents._drawing(run(case_of(name)))
    assert ("arrows" in picture.caption) == arrows


def test_a_torque_without_a_number_is_a_gap():
    found = curves(case_of("feed_drive"))
    parts = {name: part.copy() for name, part in found.parts.items()}
    parts["helix"][20:30] = np.nan
    panel, _ = curve_figures._over_speed(found._replace(parts=parts)).axes
    total = panel.lines[0].get_ydata()
    assert np.all(np.isnan(total[20:30]))
    assert np.isfinite(total[30:]).all()


def test_a_project_and_a_date_stand_on_it_only_if_somebody_says_so():
    plain, _ = pieces(20)
    told = dataclasses.replace(plain, heading=Heading.of(" Axis <2> ", "2026-11-23").lines)
    for words in (
        Page(html_bytes(told).decode()).words,
        text_of(pypdf.PdfReader(io.BytesIO(pdf_bytes(told)))),
    ):
        assert "Project: Axis <2> · Date: 2026-11-23" in words
    assert "Project" not in Page(html_bytes(plain).decode()).words
    assert Heading.of(None, "").lines == []
    assert Heading.of("", "2026-11-23").lines == ["Date: 2026-11-23"]
    before = datetime.date.today()
    assert before <= datetime.date.fromisoformat(Heading.of("", "today").date) <= datetime.date.today()
    for project, date, where in (("a\nb", "", "--project"), ("x" * 121, "", "--project"), ("", "23.11.2026", "--date")):
        with pytest.raises(InputError, match=where):
            Heading.of(project, date)


# -- all cases ------------------------------------------------------------------------------------


#: Each of them is much like another case.
LONG = (
    "at rest",
    "axis",
    "calibrated",
    "feed_axis",
    "oversize balls",
    "rig",
    "service",
    "vertical_axis",
    "xjtu",
)


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.long] if n in LONG else []) for n in CASES])
def test_every_case_has_a_report_of_few_pages(name):
    content = content_of(name)
    reader = pypdf.PdfReader(io.BytesIO(pdf_bytes(content)))
    assert 1 <= len(reader.pages) <= content.pages
    moves, warms = case_of(name).motion is not None, case_of(name).surroundings is not None
    is_mounted = moves and case_of(name).installation is not None
    assert content.pages == 5 + 2 * moves + is_mounted + warms
    words, filled = text_and_least_filled(reader)
    assert f"page {len(reader.pages)} of {len(reader.pages)}" in words
    found = Page(html_bytes(content).decode())
    for each in (words, found.words):
        assert not _NO_NUMBERS.search(each)
        assert not _EXPONENT.findall(each)
    assert filled >= LEAST_FILLED
    tornado = any("one uncertain input at a time" in text.lower() for text in pictures_of(content))
    assert tornado == (name not in ("without load", "nothing"))
    assert len([tag for tag, _ in found.tags if tag == "figure"]) == 4 + moves + is_mounted + warms + tornado


# -- as a PDF -------------------------------------------------------------------------------------


def test_the_pdf_is_tagged_for_everybody(pdf):
    root = pdf.trailer["/Root"]
    assert root["/MarkInfo"]["/Marked"]
    assert root["/Lang"] == "en-GB"
    assert pdf.metadata.title == "Friction of a ball screw: 7000 N, 600 rpm; model reference"
    assert "/CreationDate" not in pdf.metadata
    assert re.search(rb"<pdfuaid:part>1</pdfuaid:part>", root["/Metadata"].get_data())
    kinds = structure_of(pdf)
    assert [kind for kind, _ in kinds].count("/H1") == 1
    assert [kind for kind, _ in kinds].count("/H2") == 10
    assert len([kind for kind, _ in kinds if kind == "/TH"]) > 20
    alternatives = [alt for kind, alt in kinds if kind == "/Figure"]
    assert len([alt for alt in alternatives if alt]) >= 4
    assert any(alt and "between its grooves" in alt for alt in alternatives)


@pytest.mark.slow
def test_figures_of_the_pdf_have_text_that_can_be_read_back(pdf):
    words = text_of(pdf)
    for text in ("speed of the screw (rpm)", "film parameter λ", "Contact of ball and screw", "hydrodynamic rolling"):
        assert text in words
    fonts = {
        str(font.get_object()["/BaseFont"])
        for sheet in pdf.pages
        for font in sheet["/Resources"].get("/Font", {}).values()
    }
    assert any("DejaVu" in font for font in fonts)


# -- as HTML --------------------------------------------------------------------------------------


def test_the_page_asks_for_nothing_from_outside(page):
    links = [attributes["href"] for tag, attributes in page.tags if tag == "a" and "href" in attributes]
    assert links
    assert all(link.startswith("https://doi.org/10.") for link in links)
    for tag, attributes in page.tags:
        assert tag not in ("script", "link", "iframe", "object", "embed", "base", "form", "image", "img")
        for name, given in attributes.items():
            assert not name.startswith("on")
            if name in ("src", "href", "xlink:href") and tag != "a":
                assert given.startswith("#")
    assert "@import" not in page.source
    assert not re.search(r"url\((?!#)", page.source)
    without = page.source
    for link in (*links, "http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"):
        without = without.replace(link, "")
    assert "://" not in without


def test_the_page_is_for_everybody(page):
    assert ("html", {"lang": "en-GB"}) in page.tags
    headings = [tag for tag, _ in page.tags if re.fullmatch("h[1-6]", tag)]
    assert headings == ["h1", *["h2"] * 10]
    assert all(attributes.get("scope") in ("col", "row") for tag, attributes in page.tags if tag == "th")
    tables = [tag for tag, _ in page.tags if tag == "table"]
    assert len(tables) == len([tag for tag, _ in page.tags if tag == "caption"]) > 8
    for place, (tag, attributes) in enumerate(page.tags):
        if tag == "svg":
            assert attributes.get("aria-hidden") == "true" or (
                attributes.get("role") == "img" and page.tags[place + 1][0] == "title"
            )
    names = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert len(names) == len(set(names))
    used = set(re.findall(r'(?:url\(#|href="#)([^)"]+)', page.source))
    assert used <= set(names)
    assert "prefers-color-scheme: dark" in page.source
    assert "@media print" in page.source


# -- hostile texts --------------------------------------------------------------------------------

_HOSTILE = '#import "x" <script>alert(1)</script> $x$ {{ 1 + 1 }} \\*_`@a &amp; ]'


@pytest.mark.slow
def test_texts_of_files_come_out_as_text(tmp_path):
    quoted = _HOSTILE.replace('"', '""')
    (tmp_path / "rows.csv").write_text(
        "name,nominal_diameter [mm],lead [mm],ball_diameter [mm],turns,source\n"
        f'"{quoted}",40,10,6.35,4,"of <b>{quoted}</b>"\n',
        encoding="utf-8",
    )
    tables = case_file.read(ROOT / "examples" / "feed_drive.toml")
    tables["screw"] = {"catalogue": _HOSTILE, "catalogue_file": "rows.csv"}
    case = case_file.build(tables, folder=tmp_path)
    content = contents.content(case, samples=SAMPLES)
    words = re.sub(r"\s+", "", text_of(pypdf.PdfReader(io.BytesIO(pdf_bytes(content)))))
    assert re.sub(r"\s+", "", _HOSTILE) in words
    assert re.sub(r"\s+", "", f"of <b>{_HOSTILE}</b>") in words
    found = Page(html_bytes(content).decode())
    assert _HOSTILE in found.words
    assert f"of <b>{_HOSTILE}</b>" in found.words
    assert not {"script", "b", "img"} & {tag for tag, _ in found.tags}


# -- as a command ---------------------------------------------------------------------------------


#: In the short run each kind once, in a process that orders its hashes otherwise than this one.
SEEDS = [("pdf", 1), ("html", 2), *(pytest.param(*one, marks=pytest.mark.long) for one in (("pdf", 2), ("html", 1)))]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed"), SEEDS)
def test_equal_cases_give_equal_bytes_in_all_processes(kind, seed, tmp_path):
    to = tmp_path / f"report.{kind}"
    command = [sys.executable, "-m", "ballscrew.faces.cli", "report", str(ROOT / "examples/feed_drive.toml")]
    done = subprocess.run(
        [*command, "-o", str(to), "--samples", str(SAMPLES)],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env={**os.environ, "PYTHONHASHSEED": str(seed), "TZ": f"UTC+{seed}"},
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{to}: report of feed_drive.toml, {len(to.read_bytes()) // 1000} kB\n"
    assert done.stderr == ""
    content = content_of("feed_drive")
    assert to.read_bytes() == (pdf_bytes(content) if kind == "pdf" else html_bytes(content))


@pytest.mark.slow
def test_reports_made_at_once_do_not_disturb_each_other():
    wanted = {name: html_bytes(content_of(name)) for name in ("feed_drive", "olaru2005")}
    with ThreadPoolExecutor(2) as pool:
        names = [*wanted]
        found = list(pool.map(lambda name: report_bytes(case_of(name), "html", samples=SAMPLES), names))
    assert [each == wanted[name] for name, each in zip(names, found, strict=True)] == [True] * 2


def test_it_tells_how_far_it_is():
    told = []
    report_bytes(case_of("feed_drive"), "html", lambda *step: told.append(step), SAMPLES)
    finished = [step for step, _ in told]
    assert {total for _, total in told} == {100}
    assert finished == sorted(finished)
    assert finished[0] < 10
    assert finished[-1] == 100


def test_what_cannot_be_written_is_one_line_and_nothing_is_left(ballscrew, tmp_path):
    """The ending is looked at, and the designs are counted, by ``test_refused_commands``."""
    (tmp_path / "folder.pdf").mkdir()
    done = ballscrew("report", ROOT / "examples" / "feed_drive.toml", "-o", tmp_path / "folder.pdf")
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert line.startswith("--to: cannot be written")
    assert [path.name for path in tmp_path.iterdir()] == ["folder.pdf"]
