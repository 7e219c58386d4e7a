"""One style for all figures, and the way they are saved; and some of many points.

Nothing outside decides how a figure looks: a personal matplotlibrc is set aside, identifiers in
SVG files come from a fixed salt, and no file carries a date or a version.
"""

from __future__ import annotations

import contextlib
import dataclasses
import io
import re
import textwrap
import threading
from collections.abc import Callable, Generator, Mapping, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.output.sheet import Colour
from ballscrew.basis.output.text import escaped

if TYPE_CHECKING:  # matplotlib is slow to import: only where a picture is drawn
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Numbers = NDArray[np.float64]
#: Colours of Okabe and Ito, told apart with any colour vision.
BLUE, ORANGE, GREEN, PURPLE, SKY, RED, YELLOW = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#CC79A7",
    "#56B4E9",
    "#D55E00",
    "#F0E442",
)
#: From light to dark, for curves of one growing parameter; told apart in print, too.
GROWING = ("#7FB8DA", "#3C8DBC", "#8A6FB0", "#B0457B", "#5B1A3A")
INK, GREY, SHADE, LIGHT_SHADE = "#222222", "#666666", "#D9D9D9", "#F2F2F2"
#: The shades of the colours of a sheet.
SHADES: Mapping[Colour, str] = {
    "ink": INK,
    "grey": GREY,
    "blue": BLUE,
    "orange": ORANGE,
    "green": GREEN,
    "purple": PURPLE,
    "sky": SKY,
    "red": RED,
    "yellow": YELLOW,
}
#: The same colour for a mechanism in all figures.
_OF_MECHANISMS: Mapping[str, Colour] = {
    "hydrodynamic_rolling": "sky",
    "elastic_hysteresis": "green",
    "curvature": "orange",
    "spin": "red",
    "helix": "blue",
    "ball_to_ball": "purple",
    "chain_braking": "yellow",
}
MECHANISM_COLOURS: Mapping[str, str] = {name: SHADES[colour] for name, colour in _OF_MECHANISMS.items()}


def colour_of(mechanism: str) -> Colour:
    """The colour of a mechanism; grey for losses beside those of the balls."""
    return _OF_MECHANISMS.get(mechanism, "grey")


SUFFIXES = (".png", ".svg", ".pdf")


def check_picture(to: Path, option: str = "--to") -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` if no picture can be written there."""
    if to.suffix.lower() not in SUFFIXES:
        raise InputError(Fault(option, "unknown kind of file", str(to), "end it in .png, .svg or .pdf"))
    check_writable(option, to)


def draw(figure: Callable[[], Figure], to: Path, option: str = "--to") -> None:
    """Draw a figure in the house style and write it, whole or not at all."""
    buffer = io.BytesIO()
    with house_style():
        save_as(figure(), buffer, to.suffix.lower().removeprefix("."))
    with atomic_write(option, to) as path:
        path.write_bytes(buffer.getvalue())


LINE_STYLES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))

STYLE: Any = {
    "font.family": ["DejaVu Sans"],
    "font.size": 10,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 10,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.7,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "lines.linewidth": 1.8,
    "legend.fontsize": 9,
    "legend.frameon": True,
    "legend.framealpha": 0.9,
    "legend.edgecolor": "none",
    "figure.facecolor": "white",
    "savefig.dpi": 150,
    "svg.hashsalt": "ballscrew",
    "svg.fonttype": "path",
    "path.simplify_threshold": 0.05,
}

#: Inches of one panel, and of a caption line.
PANEL_WIDTH, PANEL_HEIGHT, CAPTION_LINE = 4.6, 3.5, 0.17
_CAPTION_CHARACTERS_PER_INCH = 15.5


#: What keeps dates and versions out of a file, by its kind.
_NO_METADATA: Mapping[str, Any] = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}

#: The numbers of a figure: columns by heading, the unit in the heading.
Columns = Mapping[str, Any]


@dataclasses.dataclass(frozen=True)
class Plot:
    """One figure: its file name, how to draw it from the data, and the numbers in it."""

    name: str
    draw: Callable[[Any], Figure]
    table: Callable[[Any], Columns]


@contextlib.contextmanager
def house_style() -> Generator[None]:
    """The style for drawing and saving, whatever the user's own settings are."""
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(STYLE)
        yield


def new_figure(
    caption: str, *, rows: int = 1, columns: int = 2, height: float = PANEL_HEIGHT, **subplots: Any
) -> tuple[Figure, list[Axes]]:
    """A figure of panels with room for its caption, and the panels row by row."""
    figure = captioned_figure(caption, max(PANEL_WIDTH * columns, 2 * PANEL_WIDTH), height * rows)
    panels: Any = figure.subplots(rows, columns, squeeze=False, **subplots)
    return figure, list(panels.ravel())


def captioned_figure(caption: str, width: float, height: float) -> Figure:
    """A figure without panels, of a size in inches to which the room for its caption is added."""
    from matplotlib.figure import Figure

    lines = textwrap.wrap(caption, int(width * _CAPTION_CHARACTERS_PER_INCH))
    margin = CAPTION_LINE * len(lines) + 0.14
    figure = Figure(figsize=(width, height + margin), layout="constrained")
    total = float(figure.get_figheight())
    engine: Any = figure.get_layout_engine()
    engine.set(rect=(0, margin / total, 1, 1 - margin / total), w_pad=0.08, h_pad=0.06)
    figure.text(0.012, 0.07 / total, "\n".join(lines), ha="left", va="bottom", fontsize=8.5, color=GREY)
    return figure


def save(figure: Figure, folder: Path, name: str) -> list[Path]:
    """Write a figure as SVG and PNG; call within :func:`house_style`."""
    svg, png = folder / f"{name}.svg", folder / f"{name}.png"
    save_as(figure, png, "png")
    # the places found for the PNG hold for the SVG: found once, and the same in both
    figure.set_layout_engine("none")
    save_as(figure, svg, "svg")
    return [svg, png]


def save_as(figure: Figure, to: Path | IO[bytes], kind: str) -> None:
    """Write a figure as ``png``, ``svg`` or ``pdf``; call within :func:`house_style`."""
    figure.savefig(to, format=kind, metadata=_NO_METADATA[kind])


def shared_legend(axes: Sequence[Axes], **options: Any) -> None:
    """The same legend in each panel, so that each can be read alone."""
    for panel in axes:
        panel.legend(**options)


_SMALL: Any = {
    "font.size": 8.5, "axes.titlesize": 9, "axes.labelsize": 8.5, "legend.fontsize": 7.5, "xtick.labelsize": 8,
    "ytick.labelsize": 8, "lines.linewidth": 1.5, "svg.fonttype": "none", "figure.facecolor": "none",
    "axes.facecolor": "none", "legend.framealpha": 0.0, "axes.formatter.limits": (-9, 9),
}  # fmt: skip
#: The style of matplotlib is one for all threads.
_LOCK = threading.Lock()


def svg_of(draw: Callable[[], Figure], name: str) -> str:
    """One figure as SVG text without a title, in the style of a report."""
    import matplotlib as mpl

    with _LOCK, house_style():
        mpl.rcParams.update(_SMALL)
        return _text_of(draw(), name)


def _text_of(figure: Figure, name: str) -> str:
    """The SVG of a figure: identifiers of its own, ink in the colour of the page, no style that leaks."""
    buffer = io.BytesIO()
    save_as(figure, buffer, "svg")
    text = buffer.getvalue().decode()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>\s*", "", text, flags=re.DOTALL)
    text = re.sub(r"<defs>\s*<style[^>]*>.*?</style>\s*</defs>\s*", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\s*", "", text, flags=re.DOTALL)
    text = re.sub(r'\bid="', f'id="{name}-', text)
    text = re.sub(r"url\(#", f"url(#{name}-", text)
    text = re.sub(r'href="#', f'href="#{name}-', text)
    text = re.sub(INK, "currentColor", text, flags=re.IGNORECASE)
    text = re.sub(GREY, "currentColor", text, flags=re.IGNORECASE)
    text = re.sub(r"stroke: #e4e4e4", "stroke: currentColor; stroke-opacity: 0.14", text, flags=re.IGNORECASE)
    head = f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="{_box(text)}"'
    lines = 'stroke-linejoin="round" stroke-linecap="butt" fill="currentColor"'
    return re.sub(r"<svg[^>]*>", f"{head} {lines}>", text, count=1)


def _box(text: str) -> str:
    box = re.search(r'viewBox="([^"]*)"', text)
    assert box is not None
    return box[1]


def named(text: str, words: str) -> str:
    """An SVG with its name in words, for those who cannot see it."""
    return re.sub(r"<svg([^>]*)>", lambda m: f'<svg{m[1]} role="img">\n<title>{escaped(words)}</title>', text, count=1)


def some(places: NDArray[np.int64], most: int) -> NDArray[np.int64]:
    """Choose at most so many of some rows, the same each time."""
    return places if places.size <= most else np.random.default_rng(0).choice(places, most, replace=False)
