"""The left half of the drawing: the section across the path, a ball between its grooves."""

from __future__ import annotations

import math

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.faces.report import svg
from ballscrew.faces.report.drawing_contact import DrawnBall
from ballscrew.faces.report.svg import FAINT, GREEN, LINE, TEXT, TITLE, Panel, Point
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.ball_section import Arc, contact_width, land_height
from ballscrew.physics.laws.contact import RaceState
from ballscrew.questions.run.compute import Touching

#: The middle of the ball, and its radius.
BALL, RADIUS = (122.0, 158.0), 78.0
_HALF_WIDTH, _BODY = 116.0, 44.0


_SCREW = fields_of(BallScrew)
_LENGTH, _ANGLE, _LOAD = _SCREW["ball_diameter"], _SCREW["contact_angle"], quantities_of(RaceState)["contact_load"]


class Groove:
    """One flank of a groove as an arc that touches the ball, in drawing units: y points down."""

    def __init__(self, conformity: float, angle: float, side: int, down: int) -> None:
        self._arc = Arc.of(RADIUS, conformity, angle, loaded=side > 0, outward=-down)
        self.radius = self._arc.radius
        #: From the middle of the ball to the contact; nut contacts of the loaded side lie to the right.
        self.normal = (self._arc.normal[0], -self._arc.normal[1])
        self.contact = _on_paper(self._arc.contact)
        self.middle = _on_paper(self._arc.middle)

    @property
    def bottom(self) -> Point:
        """Point where the two flanks of the groove meet."""
        return _on_paper(self._arc.bottom)

    def edge(self, land: float) -> Point:
        """End of the groove, at a height over the middle of the ball."""
        return _on_paper(self._arc.edge(land))

    def around(self, half_width: float) -> tuple[Point, Point]:
        """The ends of a stretch of the arc to both sides of the contact."""
        first, last = self._arc.around(half_width)
        return _on_paper(first), _on_paper(last)


def _on_paper(place: tuple[float, float]) -> Point:
    return float(BALL[0] + place[0]), float(BALL[1] - place[1])


def section(ball: DrawnBall) -> Panel:
    """The ball, its grooves, its contacts and their angle, a scale, and the sizes in words."""
    flanks = {flank.side: flank for flank in ball.flanks}
    main = max(ball.flanks, key=lambda flank: flank.load)
    parts: list[str] = [svg.text((8, 20), "Section across the path", TITLE, font_weight="bold")]
    land = float(land_height(RADIUS, max(flank.angle for flank in ball.flanks)))
    for conformity, down, name in (
        (ball.nut_conformity, -1, "nut"),
        (ball.screw_conformity, 1, "screw"),
    ):
        grooves = {side: Groove(conformity, flanks.get(side, main).angle, side, down) for side in (1, -1)}
        left, right = sorted(grooves.values(), key=lambda groove: groove.normal[0])
        parts += _body(left, right, land, down)
        for side, groove in grooves.items():
            ends = svg.to(groove.edge(land), "M"), _arc_to(groove, groove.edge(land), groove.bottom)
            touching = side in flanks
            dashes = {} if touching else {"stroke_dasharray": "4 3", "opacity": 0.75}
            parts.append(svg.path(ends, stroke_width=1.8 if touching else 1.0, **dashes))
        y = BALL[1] + down * (RADIUS + _BODY - 5)
        parts.append(svg.text((BALL[0] - _HALF_WIDTH + 6, y + (0 if down > 0 else 9)), name, TEXT))
    parts.append(svg.circle(BALL, RADIUS, stroke_width=1.6))
    for flank in ball.flanks:
        parts += _normal(ball, flank)
    parts += [*_angle(main, has_both=len(ball.flanks) > 1), *_scale_bar(ball)]
    notes, y = _sizes(ball, short=True), BALL[1] + RADIUS + _BODY + 22
    parts += [svg.text((8, y + LINE * i), words) for i, words in enumerate(notes)]
    return Panel(parts, y + LINE * (len(notes) - 1))


def _body(left: Groove, right: Groove, land: float, down: int) -> list[str]:
    """The metal around a groove, and its lands."""
    outer = BALL[1] + down * (RADIUS + _BODY)
    sides = BALL[0] - _HALF_WIDTH, BALL[0] + _HALF_WIDTH
    first, last = left.edge(land), right.edge(land)
    outline = [
        svg.to((sides[0], outer), "M"),
        svg.to((sides[0], first[1])),
        svg.to(first),
        _arc_to(left, first, left.bottom),
        _arc_to(right, right.bottom, last),
        svg.to((sides[1], last[1])),
        svg.to((sides[1], outer)),
        "Z",
    ]
    return [
        svg.path(outline, fill="currentColor", fill_opacity=FAINT, stroke="none"),
        svg.line((sides[0], first[1]), first, stroke_width=1.8),
        svg.line(last, (sides[1], last[1]), stroke_width=1.8),
    ]


def _arc_to(groove: Groove, start: Point, end: Point) -> str:
    """The arc of a groove between two of its points, the short way."""
    (x, y), (u, v) = ((p[0] - groove.middle[0], p[1] - groove.middle[1]) for p in (start, end))
    return svg.arc(end, groove.radius, clockwise=x * v - y * u > 0)


def _normal(ball: DrawnBall, flank: Touching) -> list[str]:
    """The line through both contacts of a pair of flanks, and the contacts, as wide as they are."""
    pair = [
        Groove(conformity, flank.angle, flank.side, down)
        for conformity, down in ((ball.nut_conformity, -1), (ball.screw_conformity, 1))
    ]
    parts = [svg.line(pair[0].contact, pair[1].contact, stroke_width=1.0, stroke_dasharray="9 3 2 3")]
    contact = ball.contact
    widths = (0.0, 0.0) if contact is None else (contact.on_nut, contact.semi_major_axis)
    for groove, wide in zip(pair, widths, strict=True):
        if flank.load > 0 and wide > 0:
            start, end = groove.around(float(contact_width(wide * _scale(ball), flank.load, ball.load)))
            parts.append(svg.path([svg.to(start, "M"), _arc_to(groove, start, end)], stroke=GREEN, stroke_width=4.5))
        parts.append(svg.circle(groove.contact, 2.6, fill="currentColor", stroke="none"))
    return parts


def _scale(ball: DrawnBall) -> float:
    """Drawing units of a metre."""
    return 2 * RADIUS / ball.ball_diameter


def _angle(flank: Touching, *, has_both: bool) -> list[str]:
    """The contact angle against the radius."""
    radius, side = 0.5 * RADIUS, flank.side
    start = (BALL[0], BALL[1] - radius)
    end = (BALL[0] + side * radius * math.sin(flank.angle), BALL[1] - radius * math.cos(flank.angle))
    words = f"α {_degrees(flank)}"
    # beside the arc where there is room: between the normals with two, else on the far side of the radius
    middle = (BALL[0] - side * 6, BALL[1] - radius + 4) if not has_both else (BALL[0], BALL[1] + 0.62 * RADIUS)
    anchor = "middle" if has_both else "end" if side > 0 else "start"
    return [
        svg.line(BALL, (BALL[0], BALL[1] - 0.8 * RADIUS), stroke_width=0.8, opacity=0.8),
        svg.path([svg.to(start, "M"), svg.arc(end, radius, clockwise=side > 0)], stroke_width=1.0),
        svg.text(middle, words, TEXT, anchor),
    ]


def _degrees(flank: Touching) -> str:
    """The contact angle as it is written in drawings."""
    return units.shown(flank.angle, _ANGLE).replace(" deg", "°")


def _scale_bar(ball: DrawnBall) -> list[str]:
    """One, two or five times a power of ten millimetres, about a third of the ball."""
    wanted = 0.42 * ball.ball_diameter * 1e3
    power = 10 ** math.floor(math.log10(wanted))
    length = max(step * power for step in (1, 2, 5) if step * power <= wanted)
    wide, x, y = length * 1e-3 * _scale(ball), BALL[0] + _HALF_WIDTH - 6, BALL[1] + RADIUS + _BODY - 10
    ends = (x - wide, y), (x, y)
    return [
        svg.line(*ends, stroke_width=2.2),
        *(svg.line((end[0], y - 4), (end[0], y + 4), stroke_width=1.2) for end in ends),
        svg.text(
            (x - wide / 2, y - 7),
            units.shown(length * 1e-3, _LENGTH),
            TEXT,
            "middle",
        ),
    ]


def _sizes(ball: DrawnBall, *, short: bool) -> list[str]:
    """The sizes of ball and grooves, and the loads; ``short`` where there is little room."""
    diameter, radius = ("⌀", "r") if short else ("diameter", "radius")
    screw, nut = (
        (units.shown(conformity * ball.ball_diameter, _LENGTH), f"{conformity:.4g}")
        for conformity in (ball.screw_conformity, ball.nut_conformity)
    )
    if screw[1] == nut[1]:
        grooves = [f"groove radius {screw[0]}, {screw[1]} {diameter}"]
    else:
        grooves = [
            f"{name} groove {radius} {size}, {factor} {diameter}"
            for name, (size, factor) in (("screw", screw), ("nut", nut))
        ]
    return [f"ball {diameter} {units.shown(ball.ball_diameter, _LENGTH)}", *grooves, *_loads(ball)]


def _loads(ball: DrawnBall) -> list[str]:
    if ball.load == 0:
        return ["no load on the ball"]
    whose = "load of this ball" if ball.most_loaded else "load of each ball"
    if not math.isfinite(ball.load):
        return [f"{whose}: no number"]
    load = f"{whose} {' and '.join(units.shown(flank.load, _LOAD) for flank in ball.flanks)}"
    if len(ball.flanks) == 1:
        return [load]
    return [load, f"at {' and '.join(map(_degrees, ball.flanks))}: four contacts"]


def in_words(ball: DrawnBall) -> list[str]:
    """Alternative text of the section, with its numbers."""
    angles = " and ".join(units.shown(flank.angle, _ANGLE) for flank in ball.flanks)
    return [
        "Left: section across the path of the balls, to scale, the screw below and the nut above; how far the grooves "
        f"reach is assumed. Contact angle {angles}.",
        f"{'; '.join(_sizes(ball, short=False))}.",
    ]
