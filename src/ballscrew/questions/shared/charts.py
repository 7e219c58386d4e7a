"""One style for all figures, and the way they are saved.

Nothing outside decides how a figure looks: a personal matplotlibrc is set aside, identifiers in
SVG files come from a fixed salt, and no file carries a date or a version.
"""

from __future__ import annotations

import contextlib
import dataclasses
import textwrap
from collections.abc import Callable, Generator, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.questions.shared.chart_colours import BLUE as BLUE
from ballscrew.questions.shared.chart_colours import GREEN as GREEN
from ballscrew.questions.shared.chart_colours import GREY as GREY
from ballscrew.questions.shared.chart_colours import GROWING as GROWING
from ballscrew.questions.shared.chart_colours import INK as INK
from ballscrew.questions.shared.chart_colours import LIGHT_SHADE as LIGHT_SHADE
from ballscrew.questions.shared.chart_colours import MECHANISM_COLOURS as MECHANISM_COLOURS
from ballscrew.questions.shared.chart_colours import ORANGE as ORANGE
from ballscrew.questions.shared.chart_colours import PURPLE as PURPLE
from ballscrew.questions.shared.chart_colours import RED as RED
from ballscrew.questions.shared.chart_colours import SHADE as SHADE
from ballscrew.questions.shared.chart_colours import SKY as SKY
from ballscrew.questions.shared.chart_colours import YELLOW as YELLOW

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
