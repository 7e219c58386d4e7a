"""The colours of figures and of the page, without the library that draws."""

from __future__ import annotations

from collections.abc import Mapping

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
#: The same colour for a mechanism in all figures.
MECHANISM_COLOURS: Mapping[str, str] = {
    "hydrodynamic_rolling": SKY,
    "elastic_hysteresis": GREEN,
    "curvature": ORANGE,
    "spin": RED,
    "helix": BLUE,
    "ball_to_ball": PURPLE,
    "chain_braking": YELLOW,
}
#: The same for a cause of the torque of a motor, as :data:`ballscrew.questions.duty.compute.CAUSES` names them.
CAUSE_COLOURS: Mapping[str, str] = {
    "acceleration": BLUE,
    "gravity": GREEN,
    "process": ORANGE,
    "friction of the balls": RED,
    "other friction": PURPLE,
}
