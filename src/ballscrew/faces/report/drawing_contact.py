"""The right half of the drawing: the contact of ball and screw as it is seen from the ball, and the slip in it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import quantities_of
from ballscrew.faces.report import svg
from ballscrew.faces.report.contact_geometry import DrawnBall, DrawnContact, SlipField
from ballscrew.faces.report.svg import BLUE, FAINT, GREEN, RED, TEXT, TITLE, Panel, Point
from ballscrew.physics.laws.contact import RaceState

#: The left end of the panel, the middle of the ellipse and what is above it, and the most its semi-axes may take.
_LEFT, _MIDDLE, _ABOVE, _HALF_ACROSS, _HALF_ALONG = 254.0, 418.0, 56.0, 140.0, 76.0
#: Below this b/a the ellipse is drawn stretched along the path.
SMALLEST_RATIO = 0.17
_COLUMNS, _ROWS, _ROOM, _RIM = 15, 5, 0.95, 1.8
_CHARACTERS = 46

_CONTACT = quantities_of(RaceState)
_SLIP = _CONTACT["creep_speed"]


def contact(ball: DrawnBall) -> Panel:
    """The ellipse to scale, the lines of pure rolling, the slip as arrows, and what is to be said of them."""
    parts: list[str] = [svg.text((_LEFT, 20), "Contact of ball and screw", TITLE, font_weight="bold")]
    if ball.contact is None:
        lines = svg.Paragraph((_LEFT, 60), ball.missing, _CHARACTERS)
        return Panel([*parts, lines.element()], lines.bottom)
    touching = ball.contact
    place = Place.of(touching)
    outline = (place.middle, place.across, place.along)
    parts.append(svg.ellipse(*outline, fill=GREEN, fill_opacity=FAINT, stroke="none"))
    if touching.slip is not None:
        parts += _lines(touching.slip, place)
    parts.append(svg.ellipse(*outline, stroke_width=1.6))
    if touching.slip is not None:
        parts += _arrows(touching, touching.slip, place)
    bottom = place.middle[1] + place.along + 74
    at = _LEFT, bottom + (0 if touching.slip is None else 22)
    lines = svg.Paragraph(at, " ".join(in_words(ball)[1:]), _CHARACTERS)
    parts += [*_axes(touching, place), *_legend(touching, bottom), lines.element()]
    return Panel(parts, lines.bottom)


class Place(NamedTuple):
    """Position of the ellipse, its semi-axes in drawing units, and its stretch along the path."""

    middle: Point
    across: float
    along: float
    stretched: float

    @classmethod
    def of(cls, contact: DrawnContact) -> Place:
        """As large as there is room for."""
        short = SMALLEST_RATIO / contact.axes_ratio
        stretched = 1.0 if short <= 1 else math.ceil(2 * short) / 2
        ratio = stretched * contact.axes_ratio
        across = min(_HALF_ACROSS, _HALF_ALONG / ratio)
        return cls((_MIDDLE, _ABOVE + across * ratio), across, across * ratio, stretched)


def _lines(field: SlipField, place: Place) -> list[str]:
    """The lines where nothing slips along the path."""
    parts: list[str] = []
    for t in field.lines:
        x, reach = place.middle[0] + t * place.across, place.along * math.sqrt(max(1 - t**2, 0.0)) + 8
        ends = (x, place.middle[1] - reach), (x, place.middle[1] + reach)
        parts.append(svg.line(*ends, stroke_dasharray="5 3", stroke_width=1.4))
    return parts


def _arrows(contact: DrawnContact, field: SlipField, place: Place) -> list[str]:
    """The slip at places of a grid, as long as it is; on one scale in both directions, even in a stretched ellipse."""
    rows = max(3, min(_ROWS, int(place.along / 11)))
    step = 2 * place.across / _COLUMNS, 2 * place.along / rows
    grid = [
        (t, h)
        for t in ((2 * column + 1) / _COLUMNS - 1 for column in range(_COLUMNS))
        for h in ((2 * row + 1) / rows - 1 for row in range(rows))
        if t**2 + h**2 < 0.97
    ]
    slips = [(float(field.along(t)), float(field.across(t, h * contact.axes_ratio))) for t, h in grid]
    scale = _arrow_scale(grid, slips, step)
    parts: list[str] = []
    for (t, h), (along, across) in zip(grid, slips, strict=True):
        x, y = place.middle[0] + t * place.across, place.middle[1] - h * place.along
        right, up = scale * across / 2, scale * along / 2
        parts.append(svg.arrow((x - right, y + up), (x + right, y - up), 5.5, BLUE if along > 0 else RED))
    return parts


def _arrow_scale(grid: Sequence[Point], slips: Sequence[Point], step: Point) -> float:
    """Drawing units of a m/s: no arrow reaches the next one; those at the rim have more room."""
    columns = [t for t, _ in grid]
    limits = [
        room / abs(speed)
        for t, (along, across) in zip(columns, slips, strict=True)
        for room, speed in (
            (_ROOM * step[1] * (1.0 if columns.count(t) > 1 else _RIM), along),
            (_ROOM * step[0], across),
        )
        if speed
    ]
    return min(limits, default=0.0)


def _axes(contact: DrawnContact, place: Place) -> list[str]:
    """Both semi-axes with their lengths, outside the ellipse, and which of its ends is where in the groove."""
    (x, y), across, along = place.middle, place.across, place.along
    below, left, right = y + along + 15, x - across - 14, x + across + 8
    a, b = (_of_contact(contact, name) for name in ("semi_major_axis", "semi_minor_axis"))
    return [
        *_measure((x, below), (x + across, below)),
        svg.text((x + across / 2, below + 15), f"a {a}", TEXT, "middle"),
        *_measure((right, y - along), (right, y)),
        svg.text((right + 4, y - along - 8), f"b {b}", TEXT, "end"),
        svg.arrow((left, y + 18), (left, y - 18), 7, "currentColor", 1.4),
        svg.text((left - 6, y - along - 8), "path", TEXT),
        svg.text((x - across, below + 15), "← groove bottom", TEXT),
        svg.text((right + 4, below + 32), "groove edge →", TEXT, "end"),
    ]


def _of_contact(contact: DrawnContact, name: str) -> str:
    return units.shown(getattr(contact, name), _CONTACT[name])


def _measure(start: Point, end: Point) -> list[str]:
    """A measured stretch with a stroke at both ends."""
    upright = start[0] == end[0]
    tick = (4.0, 0.0) if upright else (0.0, 4.0)
    return [
        svg.line(start, end, stroke_width=0.9),
        *(
            svg.line((p[0] - tick[0], p[1] - tick[1]), (p[0] + tick[0], p[1] + tick[1]), stroke_width=0.9)
            for p in (start, end)
        ),
    ]


def _legend(contact: DrawnContact, y: float) -> list[str]:
    if contact.slip is None:
        return []
    x, parts = _LEFT, list[str]()
    for colour, words, wide in ((BLUE, "screw ahead of ball", 170), (RED, "behind", 88)):
        parts += [svg.arrow((x, y - 4), (x + 18, y - 4), 6, colour, 1.6), svg.text((x + 23, y), words, TEXT)]
        x += wide
    if contact.slip.lines:
        parts += [
            svg.line((x, y - 4), (x + 18, y - 4), stroke_dasharray="5 3", stroke_width=1.4),
            svg.text((x + 22, y), "neither", TEXT),
        ]
    return parts


def in_words(ball: DrawnBall) -> list[str]:
    """Alternative text of the picture of the contact, with its numbers."""
    contact = ball.contact
    if contact is None:
        return [ball.missing]
    a, b, pressure = (_of_contact(contact, name) for name in ("semi_major_axis", "semi_minor_axis", "maximum_pressure"))
    words = [
        f"Right: contact ellipse of ball and screw, semi-axes a = {a} across the path and b = {b} along it.",
        f"Greatest pressure {pressure}.",
    ]
    if contact.slip is not None:
        words += _slip_in_words(contact, contact.slip)
    stretched = Place.of(contact).stretched
    if stretched > 1:
        words.append(f"The ellipse is stretched {stretched:g} times along the path.")
    return [*words, *([contact.missing] if contact.missing else [])]


def _slip_in_words(contact: DrawnContact, field: SlipField) -> list[str]:
    slip, speed = (units.shown(v, _SLIP) for v in (field.largest(contact.axes_ratio), field.entrainment_speed))
    words = [f"Largest slip {slip}, at a rolling speed of {speed}."]
    places = [f"{place:+.3f} a".replace("-", "−") for place in field.lines]
    words.append(
        f"Nothing slips along the path at {' and '.join(places)}."
        if places
        else "The screw slips the same way along the path all over the contact."
    )
    if field.along_only:
        words.append("The model has no slip across the path.")
    elif field.lateral:
        words.append("Drawn as the screw drives.")
    return words
