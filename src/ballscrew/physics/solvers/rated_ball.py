"""The ball diameter that belongs to a dynamic load rating."""

from __future__ import annotations

import math

from ballscrew.basis.quantities import Angle, Force, Length, Ratio
from ballscrew.physics.components.ratings import dynamic_load_rating
from ballscrew.physics.equations import geometry

#: Balls over their pitch circle between which the diameter is searched; real ones have 0.05 to 0.24.
SEARCHED = (0.02, 0.3)
#: Halvings of the interval: its end is within 1e-12 of the diameter.
_HALVINGS = 40


def ball_of_rating(
    rating: Force, ball_circle: Length, lead: Length, contact_angle: Angle, loaded_turns: Ratio
) -> Length:
    r"""Ball diameter, m, whose dynamic load rating by ISO 3408-5 is the one given; NaN where none searched has it.

    ``rating`` is the rating of one nut body (N), ``ball_circle`` the diameter of the helix of the ball centres (m),
    ``lead`` its lead (m), ``contact_angle`` in rad, ``loaded_turns`` the turns that carry load. Of a turn
    :math:`\pi d_m/(d_w \cos\varphi) - 1/2` balls are counted, the mean of the whole numbers of balls that find room:
    with whole ones the rating would fall where one fewer finds room. Searched are :data:`SEARCHED`.
    Found by bisection, as the rating then grows with the ball, by about its power of 1.3. The formulas are those of
    :mod:`ballscrew.physics.equations.rating`, as recalled, corroborated for balls of 3 mm to 10 mm.
    """
    phi = geometry.lead_angle(lead, ball_circle)

    def rated(ball: Length) -> Force:
        in_a_turn = math.pi * ball_circle / ball / math.cos(phi) - 0.5
        return float(dynamic_load_rating(ball_circle, ball, contact_angle, phi, in_a_turn, loaded_turns))

    low, high = (share * ball_circle for share in SEARCHED)
    if not rated(low) <= rating <= rated(high):
        return math.nan
    for _ in range(_HALVINGS):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if rated(middle) < rating else (low, middle)
    return math.sqrt(low * high)
