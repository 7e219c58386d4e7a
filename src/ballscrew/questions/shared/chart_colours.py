"""The colours of figures and of the page, without the library that draws."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.basis.output.sheet import Colour

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
