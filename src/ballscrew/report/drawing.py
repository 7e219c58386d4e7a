"""The ball between its grooves, drawn to scale as SVG: the section across its path, and its contact with the screw.

The page and the report show the same drawing. What is physics in it is in :mod:`ballscrew.interfaces.drawn_ball` and
below; the rest is places on paper.
"""

from __future__ import annotations

from ballscrew.interfaces import answer as answers
from ballscrew.interfaces import drawing_contact, drawing_section, svg
from ballscrew.interfaces.answer import Answer
from ballscrew.interfaces.drawn_ball import drawn_ball

WIDTH = 600.0
#: What is left below the last line.
_MARGIN = 8.0


def drawing(answer: Answer) -> str:
    """The drawing of an answer, as SVG text; of a nut that of its most loaded ball.

    What the result does not hold is left out, and the drawing says why.
    """
    ball = drawn_ball(answer)
    which = "The most loaded ball" if ball.most_loaded else "A ball"
    title = f"{which} between screw and nut: {answers.title(answer.case)}"
    words = [*drawing_section.in_words(ball), *drawing_contact.in_words(ball)]
    panels = drawing_section.section(ball), drawing_contact.contact(ball)
    height = max(panel.bottom for panel in panels) + _MARGIN
    parts = [part for panel in panels for part in panel.parts]
    return svg.document(WIDTH, height, title, " ".join(words), parts)
