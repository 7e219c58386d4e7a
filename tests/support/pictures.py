"""Pictures that the program has written, by what they show: words, panels, curves, and legends that cover none of it.

An SVG file of matplotlib says all of that: each text stands in a comment beside its outlines, each artist in a group.
"""

from __future__ import annotations

import dataclasses
import io
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib import image
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from pypdf import PdfReader

_SVG = "{http://www.w3.org/2000/svg}"
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
#: The height of letters over their base line, and the width of the last, in sizes of the font.
_HEIGHT, _LAST = 0.75, 0.6
#: Points by which the outlines of two things may overlap: strokes are that wide.
_SLACK = 1.0


class Box(NamedTuple):
    """A rectangle in points, from the upper left corner of the page."""

    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: Box) -> bool:
        return (
            self.left + _SLACK < other.right
            and other.left + _SLACK < self.right
            and self.top + _SLACK < other.bottom
            and other.top + _SLACK < self.bottom
        )

    def within(self, other: Box) -> bool:
        return (
            other.left - _SLACK <= self.left
            and self.right <= other.right + _SLACK
            and other.top - _SLACK <= self.top
            and self.bottom <= other.bottom + _SLACK
        )

    def crossed_by(self, points: np.ndarray) -> bool:
        """Whether a line through these points enters the rectangle: at a hundred places of each part of it."""
        if len(points) > 1:
            share = np.linspace(0, 1, 100)[:, None, None]
            points = (points[:-1] + share * np.diff(points, axis=0)).reshape(-1, 2)
        inside = (points > (self.left + _SLACK, self.top + _SLACK)) & (
            points < (self.right - _SLACK, self.bottom - _SLACK)
        )
        return bool(np.any(inside.all(axis=1)))


class Words(NamedTuple):
    """A text, and the rectangle that it fills."""

    text: str
    box: Box


@dataclasses.dataclass
class Panel:
    """One panel: its frame, what stands along its axes, its curves and points, the number of its areas."""

    box: Box
    words: list[Words] = dataclasses.field(default_factory=list)
    lines: list[np.ndarray] = dataclasses.field(default_factory=list)
    areas: int = 0


@dataclasses.dataclass
class Picture:
    """All that a picture shows."""

    page: Box
    panels: list[Panel] = dataclasses.field(default_factory=list)
    legends: list[Box] = dataclasses.field(default_factory=list)
    words: list[Words] = dataclasses.field(default_factory=list)

    @property
    def text(self) -> str:
        """All words, without line breaks and the signs that set an index low."""
        return re.sub(r"\$_\{?(\w+)\}?\$", r"_\1", " ".join(" ".join(one.text.split()) for one in self.words))


def drawn(svg: Path | str, *, legends_over_curves: int = 0) -> Picture:
    """A picture, which must be readable: it shows something, nothing is cut off, and no legend covers anything.

    ``legends_over_curves``: so many legends lie over a curve, where curves fill their panel.
    """
    found = picture(svg.read_text(encoding="utf-8") if isinstance(svg, Path) else svg)
    assert found.panels
    assert any(panel.lines or panel.areas for panel in found.panels), "it shows nothing"
    assert all(legend.within(found.page) for legend in found.legends), "a legend is cut off"
    for one in found.words:
        assert one.box.within(found.page), f"is cut off: {one.text}"
    for legend in found.legends:
        for panel in found.panels:
            for one in panel.words:
                assert not legend.overlaps(one.box), f"a legend covers: {one.text}"
            assert legend.within(panel.box) or not legend.overlaps(panel.box), "a legend covers an axis"
    over = sum(
        any(legend.crossed_by(line) for panel in found.panels for line in panel.lines) for legend in found.legends
    )
    assert over == legends_over_curves, "a legend covers a curve"
    return found


def size(png: bytes) -> tuple[int, int]:
    """Width and height of a picture in PNG, which must be light here and dark there."""
    pixels = image.imread(io.BytesIO(png), format="png")
    assert np.ptp(pixels[..., :3], axis=(0, 1)).min() > 0.5, "it shows nothing"
    return pixels.shape[1], pixels.shape[0]


def picture(svg: str) -> Picture:
    """What an SVG file of matplotlib shows."""
    root = ET.fromstring(svg, ET.XMLParser(target=ET.TreeBuilder(insert_comments=True)))
    found = Picture(Box(*map(float, root.attrib["viewBox"].split())))
    (figure,) = (group for group in root if group.get("id") == "figure_1")
    for group in figure:
        _add(group, found)
    return found


def _add(group: ET.Element, found: Picture) -> None:
    kind = group.get("id", "").rpartition("_")[0]
    if kind == "axes":
        _add_panel(group, found)
    elif kind == "legend":
        found.legends.append(_box(_points(group[0])))
        found.words += _words(group)
    elif kind == "text":
        found.words += _words(group)
    elif kind == "subfigure":
        for child in group:
            _add(child, found)


def _add_panel(group: ET.Element, found: Picture) -> None:
    panel: Panel | None = None
    for child in group:
        kind = child.get("id", "").rpartition("_")[0]
        if kind.startswith("matplotlib.axis"):
            words = list(_words(child))
            found.words += words
            if panel:
                panel.words += words
        elif kind == "patch" and panel is None:
            panel = Panel(_box(_points(child)))
            found.panels.append(panel)
        elif kind in ("legend", "text", "axes"):
            _add(child, found)
        elif panel is not None and kind == "line2d":
            panel.lines += _lines(child)
        elif panel is not None and not _is_frame(child):
            panel.areas += 1
            if "PathCollection" in kind:
                panel.lines += _lines(child)


def _is_frame(group: ET.Element) -> bool:
    """A side of the frame of a panel: two points and no filling."""
    paths = list(group.iter(f"{_SVG}path"))
    return len(paths) == 1 and "fill: none" in paths[0].get("style", "") and len(_points(group)) == 2


def _lines(group: ET.Element) -> Iterator[np.ndarray]:
    """The curves of a group, and its markers, each as a line of one point."""
    markers = {path for defined in group.iter(f"{_SVG}defs") for path in defined}
    for path in group.iter(f"{_SVG}path"):
        if path not in markers:
            for part in re.split("(?=M)", path.get("d", "")):
                numbers = [float(number) for number in _NUMBER.findall(part)]
                if numbers:
                    yield np.array(numbers).reshape(-1, 2)
    for use in group.iter(f"{_SVG}use"):
        yield np.array([[float(use.get("x", "0")), float(use.get("y", "0"))]])


def _points(group: ET.Element) -> np.ndarray:
    (path, *_) = group.iter(f"{_SVG}path")
    return np.array([float(number) for number in _NUMBER.findall(path.get("d", ""))]).reshape(-1, 2)


def _box(points: np.ndarray) -> Box:
    return Box(*points.min(axis=0), *points.max(axis=0))


def _words(group: ET.Element) -> Iterator[Words]:
    """The texts below a group: a comment, and its letters after it."""
    for parent in group.iter():
        text = ""
        for child in parent:
            if child.tag is ET.Comment:
                text = (child.text or "").strip()
            elif text and child.get("transform"):
                yield Words(text, _box_of_letters(child))
                text = ""


def _box_of_letters(letters: ET.Element) -> Box:
    transform = letters.get("transform", "")
    (x, y), *_ = ([float(n) for n in _NUMBER.findall(part)] for part in re.findall(r"translate\(([^)]*)\)", transform))
    scale = float(re.search(r"scale\(([\d.]+)", transform)[1])
    angle = float(found[1]) if (found := re.search(r"rotate\(([-\d.]+)", transform)) else 0.0
    places = [[0.0, 0.0]]
    for use in letters.iter(f"{_SVG}use"):
        numbers = [float(n) for n in _NUMBER.findall(use.get("transform", "").partition(")")[0])]
        places.append([*numbers, 0.0, 0.0][:2])
    last, size = max(place[0] for place in places) * scale, 100 * scale
    corners = np.array([[0, 0], [last + _LAST * size, 0], [0, -_HEIGHT * size], [last + _LAST * size, -_HEIGHT * size]])
    turn = np.radians(angle)
    turned = corners @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return _box(turned + np.array([x, y]))


def words_of(path: Path) -> str:
    """What a picture of any kind says, which must show something; nothing is read from the dots of PNG."""
    if path.suffix == ".svg":
        return drawn(path).text
    if path.suffix == ".pdf":
        (page,) = PdfReader(path).pages
        return " ".join(page.extract_text().split())
    assert min(size(path.read_bytes())) > 300
    return ""


def undrawn(figure: Figure) -> set[Text]:
    """Labels of ticks beyond the limits, or of hidden axes: they are laid out but not drawn."""
    found = set()
    for panel in figure.findobj(Axes):
        for axis in (panel.xaxis, panel.yaxis):
            low, high = sorted(axis.get_view_interval())
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                if not (panel.axison and low <= tick.get_loc() <= high):
                    found |= {tick.label1, tick.label2}
    return found


def clipped(figure: Figure) -> list[str]:
    """Texts of a figure, laid out, that reach beyond its page."""
    renderer, page, hidden = figure.canvas.get_renderer(), figure.bbox.padded(1.0), undrawn(figure)
    shown = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible() and text not in hidden]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in shown]
    return [
        words
        for words, box in boxes
        if not (page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0 and box.y1 <= page.y1)
    ]
