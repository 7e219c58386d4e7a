"""The right half of the drawing: the contact of ball and screw as it is seen from the ball, and the slip in it.

Geometry of the drawing (:mod:`~ballscrew.faces.report.drawing`): a ball, its flanks, the slip at the screw.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.quantities import quantities_of
from ballscrew.faces.report import svg
from ballscrew.faces.report.svg import BLUE, FAINT, GREEN, RED, TEXT, TITLE, Panel, Point
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.equations import kinematics, slip
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.laws.traits import traits_of
from ballscrew.questions.run.compute import Run, Touching

Field = NDArray[np.float64]
#: Heights across the ellipse at which the slip is asked for a change of sign.
_HEIGHTS = 4001
#: Places along and across the ellipse where the largest slip is looked for.
_PLACES = 181

AT_REST = "At rest nothing slips: neither arrows nor lines of pure rolling."
NO_LOAD = "Without load ball and grooves have no contact area: neither ellipse nor slip."
NO_NUMBER = "No contact is drawn: what came out is no number here."
NO_SLIP = "No slip is drawn: what came out is no number here."
FOUR_CONTACTS = "The slip on four contacts is not drawn: the result keeps the power that is lost in it, not its speeds."


@dataclasses.dataclass(frozen=True)
class SlipField:
    """Slip of the screw's surface over the ball as the screw drives, in the ellipse as it is seen from the ball; m/s.

    Heights t are across the path in units of a, positive where the groove is farther from the axis of the screw; places
    x along the path are in units of a, too, positive the way the screw's surface goes.
    """

    creep: float
    spin_rim: float
    lateral: float
    curvature: float
    semi_major_axis: float
    deformed_radius: float
    #: The model knows the slip along the path only.
    along_only: bool
    #: Half the distance of the lines of pure rolling where curvature is the only slip.
    offset: float | None
    entrainment_speed: float
    rolling_radius: float

    def along(self, height: Any) -> Any:
        """Slip along the path."""
        a = self.semi_major_axis
        if self.offset is not None:
            # Olaru2005 has the slip of the ball against the race
            return -kinematics.curvature_sliding_speed(
                self.entrainment_speed, self.rolling_radius, self.deformed_radius, height * a, self.offset * a
            )
        depth = slip.surface_depth(height, a, self.deformed_radius)
        return slip.path_slip_speed(self.creep, self.spin_rim, self.curvature, height, depth)

    def across(self, height: Any, place: Any) -> Any:
        """Slip across the path, positive towards greater heights."""
        if self.along_only:
            return 0.0 * (height + place)
        turn = slip.local_spin_speed(self.spin_rim, self.curvature, height)
        # a screw that drives is dragged towards the edge of its groove, one that is driven towards the bottom
        return slip.across_slip_speed(self.lateral, turn, place)

    @property
    def lines(self) -> list[float]:
        """Heights at which nothing slips along the path."""
        if self.offset is not None:
            return sorted({-self.offset, self.offset}) if 0 <= self.offset <= 1 else []
        t = np.linspace(-1, 1, _HEIGHTS)
        s = self.along(t)
        places = np.flatnonzero(np.sign(s[:-1]) * np.sign(s[1:]) < 0)
        between = [t[i] + (t[i + 1] - t[i]) * s[i] / (s[i] - s[i + 1]) for i in places]
        return sorted([*map(float, between), *map(float, t[s == 0])])

    def largest(self, axes_ratio: float) -> float:
        """Largest slip in the ellipse whose axes have the ratio b/a."""
        t, height = np.meshgrid(np.linspace(-1, 1, _PLACES), np.linspace(-1, 1, _PLACES))
        x = height * axes_ratio * np.sqrt(1 - t**2)
        return float(np.max(np.hypot(self.along(t), self.across(t, x))))


@dataclasses.dataclass(frozen=True)
class DrawnContact:
    """The contact of ball and screw, on the pair of flanks that carries the most."""

    semi_major_axis: float
    semi_minor_axis: float
    #: The semi-major axis at the nut.
    on_nut: float
    maximum_pressure: float
    #: None where there is none, or none that is known.
    slip: SlipField | None
    #: Why a part of the picture is missing; empty where none is.
    missing: str

    @property
    def axes_ratio(self) -> float:
        """b/a."""
        return self.semi_minor_axis / self.semi_major_axis


@dataclasses.dataclass(frozen=True)
class DrawnBall:
    """One ball between its grooves."""

    ball_diameter: float
    screw_conformity: float
    nut_conformity: float
    flanks: Sequence[Touching]
    #: None where nothing presses.
    contact: DrawnContact | None
    #: Why there is no contact.
    missing: str
    #: One of many balls with loads of their own.
    most_loaded: bool

    @property
    def load(self) -> float:
        """Load of the pair of flanks that carries the most."""
        return max(flank.load for flank in self.flanks)


def drawn_ball(run: Run) -> DrawnBall:
    """The ball of a run; of a nut the one with the greatest load."""
    screw, sides = run.case.screw, run.contacts
    contact, missing = _contact(run, run.touching, sides["screw"], sides["nut"]["semi_major_axis"])
    return DrawnBall(
        float(screw.ball_diameter),
        float(screw.screw_conformity),
        float(screw.nut_conformity),
        run.touching,
        contact,
        missing,
        run.nut is not None,
    )


def _contact(
    run: Run, flanks: Sequence[Touching], side: Mapping[str, float], on_nut: float
) -> tuple[DrawnContact | None, str]:
    a, b, pressure = (side[name] for name in ("semi_major_axis", "semi_minor_axis", "maximum_pressure"))
    if all(flank.load == 0 for flank in flanks):
        return None, NO_LOAD
    if not all(map(math.isfinite, (a, b, pressure))) or min(a, b) <= 0:
        return None, NO_NUMBER
    field, missing = _slip(run, flanks, side)
    return DrawnContact(a, b, on_nut, pressure, field, missing), ""


def _slip(run: Run, flanks: Sequence[Touching], side: Mapping[str, float]) -> tuple[SlipField | None, str]:
    case, omega = run.case, float(run.case.operation.screw_speed)
    if omega == 0:
        return None, AT_REST
    if "creep_speed" not in side or isinstance(case.nut, OversizeBallNut):
        return None, FOUR_CONTACTS
    flank = max(flanks, key=lambda flank: flank.load)
    at_angle = dataclasses.replace(case.screw, contact_angle=flank.angle)
    v, R_x = float(case.model.frame(at_angle).entrainment_speed(omega)), side["rolling_radius"]
    a, R_d = side["semi_major_axis"], side["deformed_radius"]
    of_slip = traits_of(case.model.slip)
    field = SlipField(
        creep=side["creep_speed"],
        spin_rim=side["spin"] * a,
        lateral=side["lateral_slip_speed"],
        curvature=float(slip.curvature_slip_speed(a, R_d, v / R_x)),
        semi_major_axis=a,
        deformed_radius=R_d,
        along_only=not of_slip.lateral_slip,
        offset=side["pure_rolling_offset"] if of_slip.curvature_alone else None,
        entrainment_speed=v,
        rolling_radius=R_x,
    )
    numbers = (
        field.creep,
        field.spin_rim,
        field.lateral,
        field.curvature,
        0.0 if field.offset is None else field.offset,
    )
    return (field, "") if all(map(math.isfinite, numbers)) else (None, NO_SLIP)


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
        """Choose the place as large as there is room for."""
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
