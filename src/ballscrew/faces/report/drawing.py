"""The ball between its grooves, drawn to scale as SVG: the section across its path, and its contact with the screw.

The page and the report show the same drawing. What is physics in it is in
:mod:`ballscrew.faces.report.drawing_contact` and below; the rest is places on paper.
"""

from __future__ import annotations

from ballscrew.cases.case_files import descriptions
from ballscrew.faces.report import drawing_contact, drawing_section, svg
from ballscrew.faces.report.drawing_contact import drawn_ball
from ballscrew.questions.run.compute import Run

WIDTH = 600.0
#: What is left below the last line.
_MARGIN = 8.0


def drawing(run: Run) -> str:
    """The drawing of a run, as SVG text; of a nut that of its most loaded ball.

    What the result does not hold is left out, and the drawing says why.
    """
    ball = drawn_ball(run)
    what = "The most loaded ball" if ball.most_loaded else "A ball"
    title = f"{what} between screw and nut: {descriptions.title(run.case)}"
    words = " ".join([*drawing_section.in_words(ball), *drawing_contact.in_words(ball)])
    panels = drawing_section.section(ball), drawing_contact.contact(ball)
    height = max(panel.bottom for panel in panels) + _MARGIN
    return svg.Document(WIDTH, height, title, words, [part for panel in panels for part in panel.parts]).text()
