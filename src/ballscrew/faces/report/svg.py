"""SVG by hand: a few shapes, numbers that are always written the same way, and no style that a strict page refuses.

Presentation attributes only: no ``style``, no identifiers, nothing from outside, so that several drawings stand in one
page. Lines and text are in ``currentColor``: they follow the page into the dark.
"""

from __future__ import annotations

import dataclasses
import math
import textwrap
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.basis.output.text import escaped

Point = tuple[float, float]

_FONT = "DejaVu Sans, sans-serif"
#: Colours of Okabe and Ito that are seen on white and on black alike, and how faint an area is.
GREEN, BLUE, RED, FAINT = "#009E73", "#0072B2", "#D55E00", 0.09
#: Sizes of letters.
TITLE, TEXT = 14.0, 13.0
#: From one line of a paragraph to the next.
LINE = 17.0


@dataclasses.dataclass(frozen=True)
class Paragraph:
    """Words in lines of so many characters."""

    at: Point
    words: str
    characters: int

    @property
    def lines(self) -> list[str]:
        """The lines."""
        return textwrap.wrap(self.words, self.characters)

    @property
    def bottom(self) -> float:
        """The foot of the last line."""
        return self.at[1] + LINE * (len(self.lines) - 1)

    def element(self) -> str:
        """The lines as elements."""
        x, y = self.at
        return "\n".join(text((x, y + LINE * row), line) for row, line in enumerate(self.lines))


class Panel(NamedTuple):
    """Elements, and the foot of the last line of text."""

    parts: Sequence[str]
    bottom: float


def number(value: float) -> str:
    """A coordinate: two decimals at most, no zero with a sign."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")


def element(tag: str, inner: str = "", /, **attributes: str | float) -> str:
    """An element; ``stroke_width=2`` is written ``stroke-width="2"``."""
    written = "".join(
        f' {name.rstrip("_").replace("_", "-")}="{escaped(value) if isinstance(value, str) else number(value)}"'
        for name, value in attributes.items()
    )
    return f"<{tag}{written}>{inner}</{tag}>" if inner else f"<{tag}{written}/>"


def group(*parts: str, **attributes: str | float) -> str:
    """Elements with attributes in common."""
    return element("g", "\n".join(parts), **attributes)


def text(at: Point, words: str, size: float = TEXT, anchor: str = "start", **attributes: str | float) -> str:
    """A line of text."""
    about = {"font_size": size, "text_anchor": anchor, "fill": "currentColor"}
    return element("text", escaped(words), x=at[0], y=at[1], **about, **attributes)


def line(start: Point, end: Point, **attributes: str | float) -> str:
    """A straight line."""
    return element("line", x1=start[0], y1=start[1], x2=end[0], y2=end[1], **_stroked(attributes))


def circle(middle: Point, radius: float, **attributes: str | float) -> str:
    """A circle, only its line unless a fill is given."""
    return element("circle", cx=middle[0], cy=middle[1], r=radius, **_stroked(attributes))


def ellipse(middle: Point, across: float, along: float, **attributes: str | float) -> str:
    """An ellipse, only its line unless a fill is given."""
    return element("ellipse", cx=middle[0], cy=middle[1], rx=across, ry=along, **_stroked(attributes))


def path(commands: Sequence[str], **attributes: str | float) -> str:
    """A path of commands such as :func:`to` and :func:`arc`."""
    return element("path", d=" ".join(commands), **_stroked(attributes))


def to(at: Point, command: str = "L") -> str:
    """A straight line of a path; with ``"M"`` its beginning."""
    return f"{command}{number(at[0])} {number(at[1])}"


def arc(end: Point, radius: float, *, clockwise: bool) -> str:
    """An arc of a path, of less than half a circle."""
    return f"A{number(radius)} {number(radius)} 0 0 {int(clockwise)} {number(end[0])} {number(end[1])}"


def arrow(start: Point, end: Point, head: float, colour: str, width: float = 1.2) -> str:
    """An arrow whose head ends at ``end``; short ones have a smaller head."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    if length < 0.5:
        return ""
    head = min(head, 0.6 * length)
    along = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
    base = (end[0] - head * along[0], end[1] - head * along[1])
    side = (0.42 * head * along[1], -0.42 * head * along[0])
    tip = [to((base[0] + side[0], base[1] + side[1]), "M"), to(end), to((base[0] - side[0], base[1] - side[1])), "Z"]
    return line(start, base, stroke=colour, stroke_width=width) + path(tip, fill=colour, stroke="none")


@dataclasses.dataclass(frozen=True)
class Document:
    """A whole drawing that says in words what it shows."""

    width: float
    height: float
    title: str
    description: str
    parts: Sequence[str]

    def text(self) -> str:
        """The drawing as SVG."""
        about = {"title": self.title, "desc": self.description}
        parts = [element(tag, escaped(words)) for tag, words in about.items()]
        parts += self.parts
        return element(
            "svg",
            "\n" + "\n".join(parts) + "\n",
            xmlns="http://www.w3.org/2000/svg",
            viewBox=f"0 0 {number(self.width)} {number(self.height)}",
            role="img",
            font_family=_FONT,
        )


def _stroked(attributes: dict[str, str | float]) -> dict[str, str | float]:
    return {"fill": "none", "stroke": "currentColor", "stroke_width": 1.2, **attributes}
