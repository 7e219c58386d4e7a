"""The drawing of the ball: its geometry against the numbers, its slip against the integral, its rules as SVG."""

import dataclasses
import functools
import math
import os
import re
import subprocess
import sys
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.font_manager import FontProperties, findfont
from matplotlib.ft2font import FT2Font

from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import title as title_of
from ballscrew.faces.report import drawing_contact, svg
from ballscrew.faces.report.drawing import WIDTH, drawing
from ballscrew.faces.report.drawing_contact import AT_REST, FOUR_CONTACTS, NO_LOAD, NO_NUMBER, NO_SLIP, drawn_ball
from ballscrew.faces.report.drawing_section import BALL, RADIUS
from ballscrew.questions.run.compute import run
from oracles.contact_integral import contact_integral
from oracles.tractions import Coulomb
from support.commands import ROOT

EXAMPLES = ROOT / "examples"
_NS = "{http://www.w3.org/2000/svg}"
_OVERSIZE = ('nut.type="oversize-balls"', 'nut.preload="2 kN"')

#: What must never fail to be drawn: file and settings.
CASES = {
    "paper": ("olaru2005.toml", ()),
    "corrected": ("olaru2005.toml", ('model.name="corrected"',)),
    "screw": ("feed_drive.toml", ()),
    "line law": ("feed_drive.toml", ('model.slip="line"',)),
    "double nut": ("catalogue_screw.toml", ()),
    "oversize balls": ("feed_drive.toml", _OVERSIZE),
    "oversize balls, lifted": ("feed_drive.toml", (*_OVERSIZE, 'operation.axial_load="30 kN"')),
    "at rest": ("feed_drive.toml", ('operation.screw_speed="0 rpm"',)),
    "paper at rest": ("olaru2005.toml", ('operation.screw_speed="0 rpm"',)),
    "without load": ("feed_drive.toml", ('operation.axial_load="0 N"',)),
    "nut without load": ("catalogue_screw.toml", ('operation.axial_load="0 N"',)),
    "nothing at all": ("catalogue_screw.toml", ('operation.axial_load="0 N"', 'nut.preload="0 N"')),
    "skids": ("feed_drive.toml", ('operation.axial_load="1 N"', 'operation.screw_speed="5000 rpm"')),
    "steep": ("feed_drive.toml", ('screw.lead="40 mm"', 'screw.contact_angle="80 deg"', "screw.nut_conformity=0.51")),
    "flat": ("feed_drive.toml", ('screw.contact_angle="5 deg"', "screw.screw_conformity=0.9")),
    "overloaded": ("feed_drive.toml", ('operation.axial_load="900 kN"',)),
    "beyond all bounds": ("feed_drive.toml", ('operation.axial_load="1e300 N"',)),
    "rig": ("rig.toml", ()),
}


@functools.cache
def answered(name):
    file, settings = CASES[name]
    return run(case_file.load(EXAMPLES / file, settings))


@functools.cache
def drawing_of(name):
    return drawing(answered(name))


def tree_of(name):
    return ElementTree.fromstring(drawing_of(name))


def texts(tree):
    return [element.text for element in tree.iter(f"{_NS}text")]


def read(tree):
    """All that can be read in the drawing, lines put together."""
    return " ".join(texts(tree))


# -- for all cases --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", CASES)
def test_a_strict_page_can_show_it(name):
    text = drawing(answered(name))
    tree = ElementTree.fromstring(text)
    assert tree.tag == f"{_NS}svg"
    assert tree.get("role") == "img"
    assert tree.get("viewBox").startswith(f"0 0 {WIDTH:g} ")
    assert tree.get("font-family") == "DejaVu Sans, sans-serif"
    assert tree[0].tag == f"{_NS}title"
    assert tree[1].tag == f"{_NS}desc"
    for element in tree.iter():
        assert not element.tag.endswith(("style", "script", "use", "image", "a"))
        assert not {key for key in element.attrib if key in ("style", "id", "class") or key.startswith("on")}
        assert not [key for key in element.attrib if key.endswith("href")]
        for key in ("fill", "stroke"):
            assert element.get(key, "none") in ("none", "currentColor", svg.GREEN, svg.BLUE, svg.RED)
    assert not re.search(r"nan|inf\b|-0\b(?!\.)", re.sub(r"<(title|desc|text).*?</\1>", "", text))


@pytest.mark.parametrize("name", CASES)
def test_no_text_leaves_the_drawing_or_its_panel(name):
    font = FT2Font(findfont(FontProperties(family="DejaVu Sans")))
    bold = FT2Font(findfont(FontProperties(family="DejaVu Sans", weight="bold")))
    tree = tree_of(name)
    height = float(tree.get("viewBox").split()[-1])
    assert 320 < height < 420
    for element in tree.iter(f"{_NS}text"):
        size = float(element.get("font-size"))
        assert size >= 13
        face = bold if element.get("font-weight") == "bold" else font
        face.set_size(size, 72)
        face.set_text(element.text)
        width, x = face.get_width_height()[0] / 64, float(element.get("x"))
        left = x - {"start": 0, "middle": width / 2, "end": width}[element.get("text-anchor")]
        panel = (0, 252) if left < 240 else (252, WIDTH)
        assert panel[0] <= left, element.text
        assert left + width <= panel[1], element.text
        assert float(element.get("y")) <= height - 4, element.text


@pytest.mark.parametrize("name", CASES)
def test_its_words_say_what_is_drawn(name):
    found = answered(name)
    tree = ElementTree.fromstring(drawing(found))
    title, words = tree[0].text, tree[1].text
    assert title_of(found.case) in title
    assert "Contact angle" in words
    assert f"diameter {found.case.screw.ball_diameter * 1e3:.4g} mm" in words
    contact = drawn_ball(found).contact
    if contact is None:
        assert NO_LOAD in words or NO_NUMBER in words
    else:
        assert f"a = {contact.semi_major_axis * 1e3:.4g} mm" in words
        assert f"{contact.maximum_pressure / 1e9:.4g} GPa" in words


@pytest.mark.parametrize("colour", [svg.GREEN, svg.BLUE, svg.RED])
@pytest.mark.parametrize("ground", ["#ffffff", "#16181d"])
def test_its_colours_are_seen_by_day_and_by_night(colour, ground):
    def luminance(code):
        parts = [int(code[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        red, green, blue = (p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    low, high = sorted([luminance(colour), luminance(ground)])
    assert (high + 0.05) / (low + 0.05) >= 3


# -- the section ----------------------------------------------------------------------------------


def flanks_in(tree):
    """Arcs of flanks that touch and of those that do not: radius and middle."""
    found = {True: [], False: []}
    for path in tree.iter(f"{_NS}path"):
        arc = re.fullmatch(r"M(\S+) (\S+) A(\S+) \S+ 0 0 ([01]) (\S+) (\S+)", path.get("d"))
        if arc is None or path.get("stroke") != "currentColor":
            continue
        x, y, radius, turn, u, v = map(float, arc.groups())
        if radius < RADIUS:
            continue  # that of the angle
        half = math.hypot(u - x, v - y) / 2
        up = math.sqrt(radius**2 - half**2) * (1 if turn else -1)
        middle = (x + u) / 2 - up * (v - y) / (2 * half), (y + v) / 2 + up * (u - x) / (2 * half)
        found[path.get("stroke-dasharray") is None].append((radius, middle))
    return found


@pytest.mark.parametrize("name", ["paper", "screw", "double nut", "steep", "flat", "oversize balls"])
def test_flanks_touch_the_ball_at_the_contact_angle(name):
    found = answered(name)
    screw = found.case.screw
    ball, flanks = drawn_ball(found), flanks_in(ElementTree.fromstring(drawing(found)))
    (flank, *others) = ball.flanks
    assert len(flanks[True]) == 2 * len(ball.flanks)
    assert len(flanks[True]) + len(flanks[False]) == 4
    normals = []
    for radius, (x, y) in flanks[True]:
        lever = math.hypot(x - BALL[0], y - BALL[1])
        assert lever == pytest.approx(radius - RADIUS, abs=0.06)  # the smaller circle touches the greater from within
        normals.append(((BALL[0] - x) / lever, (BALL[1] - y) / lever))
    radii = sorted(radius / (2 * RADIUS) for radius, _ in flanks[True])
    wanted = [screw.screw_conformity, screw.nut_conformity]
    assert radii == pytest.approx(sorted(wanted * len(ball.flanks)), abs=1e-4)
    if not others:
        # the nut is above and pushes from the right, the screw below
        across, up = math.sin(flank.angle), math.cos(flank.angle)
        room = 0.1 if min(wanted) < 0.53 else 0.03
        assert sorted(normals) == [
            (pytest.approx(-across, abs=room), pytest.approx(up, abs=room)),
            (pytest.approx(across, abs=room), pytest.approx(-up, abs=room)),
        ]


def test_the_ball_is_round_and_the_scale_right():
    tree = tree_of("screw")
    ball = next(c for c in tree.iter(f"{_NS}circle") if float(c.get("r")) > 10)
    assert (float(ball.get("cx")), float(ball.get("cy")), float(ball.get("r"))) == (*BALL, RADIUS)
    bar = next(element for element in tree.iter(f"{_NS}line") if element.get("stroke-width") == "2.2")
    length = float(bar.get("x2")) - float(bar.get("x1"))
    words = next(text for text in texts(tree) if re.fullmatch(r"\d mm", text))
    assert length / (2 * RADIUS) == pytest.approx(float(words.split()[0]) / 6.35, rel=1e-3)


def test_the_angle_is_that_under_load():
    found = answered("double nut")
    (flank,) = drawn_ball(found).flanks
    assert flank.angle > math.radians(45.3)
    assert f"α {math.degrees(flank.angle):.4g}°" in texts(tree_of("double nut"))
    assert "load of this ball" in read(tree_of("double nut"))


def test_contacts_are_as_wide_as_they_are():
    found = answered("screw")
    tree = ElementTree.fromstring(drawing(found))
    widths = []
    for path in tree.iter(f"{_NS}path"):
        if path.get("stroke") == svg.GREEN:
            x, y, radius, u, v = map(
                float, re.fullmatch(r"M(\S+) (\S+) A(\S+) \S+ 0 0 [01] (\S+) (\S+)", path.get("d")).groups()
            )
            widths.append(2 * radius * math.asin(math.hypot(u - x, v - y) / 2 / radius))
    scale = 2 * RADIUS / found.case.screw.ball_diameter
    sides = found.friction.nut, found.friction.screw
    assert widths == pytest.approx([2 * side.semi_major_axis * scale for side in sides], abs=0.02)


def test_oversize_balls_have_four_contacts_until_they_lift():
    four, two = tree_of("oversize balls"), tree_of("oversize balls, lifted")
    for tree, count in ((four, 4), (two, 2)):
        assert len([c for c in tree.iter(f"{_NS}circle") if c.get("r") == "2.6"]) == count
    assert "four contacts" in read(four)
    assert FOUR_CONTACTS in read(four)


# -- the contact ----------------------------------------------------------------------------------


def ellipse_in(tree):
    outline = next(tree.iter(f"{_NS}ellipse"))
    return [float(outline.get(key)) for key in ("cx", "cy", "rx", "ry")]


def pure_rolling_in(tree):
    """Heights of the dashed lines across the ellipse, in units of a."""
    x, y, across, _ = ellipse_in(tree)
    lines = [e for e in tree.iter(f"{_NS}line") if e.get("stroke-dasharray") == "5 3"]
    assert all(e.get("x1") == e.get("x2") for e in lines if float(e.get("y1")) < y)
    return [(float(e.get("x1")) - x) / across for e in lines if float(e.get("y1")) < y]


def test_the_ellipse_has_the_proportions_of_the_contact():
    found = answered("screw")
    _, _, across, along = ellipse_in(ElementTree.fromstring(drawing(found)))
    side = found.friction.screw
    assert along / across == pytest.approx(float(side.semi_minor_axis / side.semi_major_axis), rel=1e-3)
    assert "stretched" not in drawing(found)


def test_a_slender_ellipse_is_stretched_and_says_so():
    found = answered("paper")
    tree = ElementTree.fromstring(drawing(found))
    _, _, across, along = ellipse_in(tree)
    side = found.friction.screw
    times = along / across / float(side.semi_minor_axis / side.semi_major_axis)
    assert times == pytest.approx(2, rel=1e-3)
    assert along / across >= drawing_contact.SMALLEST_RATIO
    assert "The ellipse is stretched 2 times along the path." in read(tree)


@pytest.mark.parametrize("name", ["paper", "corrected"])
def test_lines_of_pure_rolling_are_at_the_offset_of_the_paper(name):
    found = answered(name)
    Y = float(found.friction.screw.pure_rolling_offset)
    assert pure_rolling_in(ElementTree.fromstring(drawing(found))) == pytest.approx([-Y, Y], abs=1e-3)
    assert f"{Y:.3f} a" in read(tree_of(name))


def test_lines_of_pure_rolling_are_where_creep_spin_and_curvature_cancel():
    found = answered("screw")
    side, field = found.friction.screw, drawn_ball(found).contact.slip
    # (a t)² small against R_d²: A + β t + C t² = 0
    a, A = float(side.semi_major_axis), float(side.creep_speed)
    C = a**2 / (2 * float(side.deformed_radius)) * float(side.motion.entrainment_speed / side.rolling_radius)
    beta = float(side.spin) * a
    roots = sorted(t for t in np.roots([C, beta, A]).real if abs(t) < 1)  # within the contact
    assert field.lines == pytest.approx(roots, abs=2e-3)
    assert pure_rolling_in(tree_of("screw")) == pytest.approx(field.lines, abs=1e-3)
    assert np.allclose(field.along(np.array(field.lines)), 0, atol=1e-8)


@pytest.mark.parametrize("settings", [(), ('screw.lead="30 mm"',), ('operation.axial_load="20 kN"',)])
def test_the_slip_is_that_of_the_contact_integral(settings):
    case = case_file.load(EXAMPLES / "feed_drive.toml", settings)
    found = run(case)
    result, contact = found.friction, drawn_ball(found).contact
    laws = tuple(Coulomb(float(side.friction_coefficient)) for side in (result.screw, result.nut))
    exact = contact_integral(
        case.screw, float(result.contact_load), laws, screw_speed=float(result.screw_speed), frame=result.frame
    ).screw.field
    a = contact.semi_major_axis
    along = contact.slip.along(exact.across / a)
    largest = float(np.max(np.hypot(exact.slip_along, exact.slip_across)))
    assert np.max(np.abs(along - exact.slip_along)) < 0.04 * largest
    # the integral has the screw below and the contact on the side where the load drives: the other way round, sideways
    # slip is that of the mirrored place along the path, with the other sign
    mirrored = -contact.slip.across(exact.across / a, -exact.along / a)
    assert np.max(np.abs(mirrored - exact.slip_across)) < 0.04 * largest
    assert contact.slip.largest(contact.axes_ratio) == pytest.approx(largest, rel=0.05)


@pytest.mark.parametrize("turns", [1, -1])
@pytest.mark.parametrize("hand", [1, -1])
def test_a_screw_that_drives_slips_towards_the_edge_of_its_groove(turns, hand):
    """By the motion of a rigid screw in a nut at rest, on the flank that presses against the load."""
    found = answered("screw")
    screw, omega = found.case.screw, float(found.case.operation.screw_speed)
    axis, outwards, around = np.eye(3)
    phi, alpha = float(screw.lead_angle), float(screw.contact_angle)
    across_path = math.cos(phi) * axis - hand * math.sin(phi) * around
    advance = hand * turns * omega * screw.lead / (2 * math.pi) * axis
    # the nut moves against the screw by -advance, and is pushed that way where the screw drives
    flank = next(
        side
        for side in (1, -1)
        if (-side * math.sin(alpha) * across_path + math.cos(alpha) * outwards) @ axis * (-advance @ axis) > 0
    )
    to_screw = flank * math.sin(alpha) * across_path - math.cos(alpha) * outwards
    at = screw.pitch_circle_diameter / 2 * outwards + screw.ball_diameter / 2 * to_screw
    velocity = np.cross(turns * omega * axis, at) + advance
    up_the_flank = flank * math.cos(alpha) * across_path + math.sin(alpha) * outwards
    sides = found.friction.screw, found.friction.nut
    both = sum(float(side.lateral_slip_speed) for side in sides)
    assert velocity @ up_the_flank == pytest.approx(both, rel=1e-6)
    assert drawn_ball(found).contact.slip.across(0.0, 0.0) == pytest.approx(float(sides[0].lateral_slip_speed))
    assert "Drawn as the screw drives." in read(tree_of("screw"))


def test_arrows_point_the_way_of_the_slip_and_are_as_long_as_it_is():
    found = answered("paper")
    tree, field = ElementTree.fromstring(drawing(found)), drawn_ball(found).contact.slip
    x, y, across, along = ellipse_in(tree)
    arrows = [
        [float(e.get(key)) for key in ("x1", "y1", "x2", "y2")] + [e.get("stroke")]
        for e in tree.iter(f"{_NS}line")
        if e.get("stroke") in (svg.BLUE, svg.RED) and float(e.get("y2")) < y + along + 20
    ]
    assert len(arrows) > 20
    for x1, y1, x2, y2, colour in arrows:
        t = ((x1 + x2) / 2 - x) / across
        assert x1 == pytest.approx(x2, abs=0.01)  # no slip across in this model
        assert (y2 < y1) == (field.along(t) > 0) == (colour == svg.BLUE)
    # where there is one place only, the length is that of the whole arrow with its head
    assert max(abs(y2 - y1) for _, y1, _, y2, _ in arrows) > 4 * min(abs(y2 - y1) for _, y1, _, y2, _ in arrows)


@pytest.mark.parametrize(
    ("name", "words"),
    [("at rest", AT_REST), ("paper at rest", AT_REST), ("without load", NO_LOAD), ("nothing at all", NO_LOAD)],
)
def test_what_is_missing_is_explained(name, words):
    tree = tree_of(name)
    assert words in read(tree)
    assert words in tree[1].text
    assert not [e for e in tree.iter(f"{_NS}line") if e.get("stroke") in (svg.BLUE, svg.RED)]
    assert bool(list(tree.iter(f"{_NS}ellipse"))) == (words == AT_REST)


@pytest.mark.parametrize(("field", "words"), [("semi_major_axis", NO_NUMBER), ("creep_speed", NO_SLIP)])
def test_no_number_is_explained_too(field, words):
    found = answered("screw")
    spoiled = {**found.contacts, "screw": {**found.contacts["screw"], field: math.nan}}
    tree = ElementTree.fromstring(drawing(dataclasses.replace(found, contacts=spoiled)))
    assert words in read(tree)
    assert f"ball ⌀ {found.case.screw.ball_diameter * 1e3:.4g} mm" in texts(tree)


def test_the_line_law_has_no_slip_across():
    assert "The model has no slip across the path." in read(tree_of("line law"))
    assert "no slip across" not in read(tree_of("screw"))


# -- as text --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_same_input_gives_the_same_bytes_in_all_processes():
    program = (
        "import sys; from pathlib import Path; from ballscrew.cases.case_files import case_file;"
        "from ballscrew.questions.run.compute import run; from ballscrew.faces.report.drawing import drawing;"
        "sys.stdout.buffer.write(drawing(run(case_file.load(Path(sys.argv[1])))).encode())"
    )
    command = [sys.executable, "-c", program, str(EXAMPLES / "catalogue_screw.toml")]
    written = {
        subprocess.run(command, capture_output=True, check=True, env={**os.environ, "PYTHONHASHSEED": seed}).stdout
        for seed in ("1", "2")
    }
    assert written == {drawing(answered("double nut")).encode()}


def test_all_words_are_escaped():
    title, description = "<script>&\x00", "\"quoted\" 'too'"
    drawn = svg.Document(1, 1, title, description, [svg.text((0, 0), "</text><b>", anchor='"')])
    tree = ElementTree.fromstring(drawn.text())
    assert tree[0].text == "<script>&\N{REPLACEMENT CHARACTER}"
    assert tree[2].text == "</text><b>"
    assert tree[2].get("text-anchor") == '"'


@pytest.mark.parametrize(
    ("value", "written"), [(-0.001, "0"), (10.0, "10"), (-1.25, "-1.25"), (100, "100"), (0.1, "0.1")]
)
def test_numbers_are_written_in_one_way(value, written):
    assert svg.number(value) == written
