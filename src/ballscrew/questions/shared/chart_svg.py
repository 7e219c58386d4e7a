"""Figures as SVG that reads as text and follows the page into the dark, for reports."""

from __future__ import annotations

import io
import re
import threading
from collections.abc import Callable
from typing import Any

from matplotlib.figure import Figure

from ballscrew.basis.output.markup import escaped
from ballscrew.questions.shared import charts

_SMALL: Any = {
    "font.size": 8.5, "axes.titlesize": 9, "axes.labelsize": 8.5, "legend.fontsize": 7.5, "xtick.labelsize": 8,
    "ytick.labelsize": 8, "lines.linewidth": 1.5, "svg.fonttype": "none", "figure.facecolor": "none",
    "axes.facecolor": "none", "legend.framealpha": 0.0, "axes.formatter.limits": (-9, 9),
}  # fmt: skip
#: The style of matplotlib is one for all threads.
_LOCK = threading.Lock()


def svg_of(draw: Callable[[], Figure], name: str) -> str:
    """One figure as SVG text without a title, in the style of a report."""
    with _LOCK, charts.house_style():
        charts.mpl.rcParams.update(_SMALL)
        return _text_of(draw(), name)


def _text_of(figure: Figure, name: str) -> str:
    """The SVG of a figure: identifiers of its own, ink in the colour of the page, no style that leaks."""
    buffer = io.BytesIO()
    charts.save_as(figure, buffer, "svg")
    text = buffer.getvalue().decode()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>\s*", "", text, flags=re.DOTALL)
    text = re.sub(r"<defs>\s*<style[^>]*>.*?</style>\s*</defs>\s*", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\s*", "", text, flags=re.DOTALL)
    text = re.sub(r'\bid="', f'id="{name}-', text)
    text = re.sub(r"url\(#", f"url(#{name}-", text)
    text = re.sub(r'href="#', f'href="#{name}-', text)
    text = re.sub(charts.INK, "currentColor", text, flags=re.IGNORECASE)
    text = re.sub(charts.GREY, "currentColor", text, flags=re.IGNORECASE)
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
