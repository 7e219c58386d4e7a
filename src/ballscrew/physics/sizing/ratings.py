"""Load ratings of a screw by its geometry.

The nut of a row of a catalogue: its kind, and the preload, the seals and the outer diameter that are listed.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from ballscrew.basis.arrays import namespace
from ballscrew.basis.errors import Fault, either, nearest, plain, shown
from ballscrew.basis.quantities import Angle, Count, Force, Length, Ratio
from ballscrew.physics.components.nut import NUTS, PRELOADED, Bodies, Nut, SingleNut
from ballscrew.physics.components.screw import RATING_CONFORMITY, BallScrew, dynamic_load_rating
from ballscrew.physics.equations import geometry, life
from ballscrew.physics.laws.nut_losses import Seals

# ruff: noqa: D102  (members of a protocol are described where a row has them)


class Ratings(NamedTuple):
    """Load ratings of one nut body, or one half."""

    dynamic: Force
    static: Force


class Rated(Protocol):
    """The geometry that ratings follow from: that of a row of a catalogue."""

    @property
    def ball_circle(self) -> Any: ...
    @property
    def ball_diameter(self) -> Any: ...
    @property
    def contact_angle(self) -> Any: ...
    @property
    def lead_angle(self) -> Any: ...
    @property
    def balls_per_turn(self) -> Any: ...
    @property
    def loaded_turns(self) -> Any: ...
    @property
    def spacer_balls(self) -> Any: ...
    @property
    def rating_conformity(self) -> Any: ...


class RatedGeometry(NamedTuple):
    """A geometry that is no row: numbers, arrays, or values that are recorded."""

    ball_circle: Length
    ball_diameter: Length
    contact_angle: Angle
    lead_angle: Angle
    #: Balls that find room in a turn, spacer balls counted, too.
    balls_per_turn: Count
    loaded_turns: Ratio
    spacer_balls: bool = False
    rating_conformity: Ratio = RATING_CONFORMITY


def rated_geometry_of(screw: BallScrew) -> RatedGeometry:
    """The geometry that the ratings of a screw follow from: so many turns as its loaded balls take. Elementwise."""
    d_m, d_w, phi = screw.pitch_circle_diameter, screw.ball_diameter, screw.lead_angle
    xp = namespace(d_m, d_w, phi)
    in_a_turn = xp.floor(xp.pi * (d_m / d_w) / xp.cos(phi))
    turns = screw.loaded_balls / in_a_turn
    return RatedGeometry(d_m, d_w, screw.contact_angle, phi, in_a_turn, turns, screw.nut.spacer_balls)


def ratings_of(row: Rated) -> Ratings:
    """Dynamic and static axial load rating of a row by its geometry; those printed in its catalogue play no part.

    Of a turn with spacer balls half of the balls carry. Elementwise: numbers, arrays, and values that are recorded.
    """
    balls = row.balls_per_turn / 2 if row.spacer_balls else row.balls_per_turn
    d_m, d_w, alpha = row.ball_circle, row.ball_diameter, row.contact_angle
    phi, f = row.lead_angle, row.rating_conformity
    # the standard leaves the lead out of the curvature
    k_0 = life.static_load_factor(geometry.curvature_ratio(d_w, d_m, alpha, lead_angle=0.0), f)
    return Ratings(
        dynamic=plain(dynamic_load_rating(d_m, d_w, alpha, phi, balls, row.loaded_turns, f)),
        static=plain(life.static_load_rating(k_0, balls, row.loaded_turns, d_w, alpha, phi)),
    )


def load_ratings(screw: BallScrew) -> Ratings:
    """Dynamic and static axial load rating of one nut body, or one half, by the geometry. Elementwise.

    Returns :class:`Ratings` of ``screw``: ``dynamic`` is C_a and ``static`` C_0a, both in N, by the formulas of
    ISO3408-5. What a catalogue prints is in its row, ``ballscrew.catalogue()[name].dynamic_load_rating``.
    """
    return ratings_of(rated_geometry_of(screw))


#: A share below this is one that a spreadsheet shows in per cent, read as per cent again: vendors have 2 to 10 %.
SMALLEST_SHARE = 0.002


class Listed(Rated, Protocol):
    """Values that a row lists of its nut."""

    @property
    def nut(self) -> str: ...
    @property
    def preload(self) -> Any: ...
    @property
    def preload_share(self) -> Any: ...
    @property
    def seal_torque(self) -> Any: ...
    @property
    def nut_outer_diameter(self) -> Any: ...
    @property
    def dynamic_load_rating(self) -> Any: ...


def lists_preload(row: Listed) -> bool:
    """Test whether a row lists a preload of a nut that may have one."""
    return row.nut in PRELOADED and not (row.preload is None and row.preload_share is None)


def preload_force(row: Listed) -> Force | None:
    """The preload that a row lists, a share as one of the dynamic load rating, listed or else by the geometry."""
    if row.preload_share is None:
        return row.preload
    return row.preload_share * _rating(row)


def _rating(row: Listed) -> Force:
    return ratings_of(row).dynamic if row.dynamic_load_rating is None else row.dynamic_load_rating


def nut_of(row: Listed) -> Nut | None:
    """The nut with what the row lists; None where it lists no preload, no seals and no spacer balls.

    With a preload, and D1, the bodies are elastic. Without one, the balls are those of one nut body by itself.
    """
    preloaded = lists_preload(row)
    if not preloaded and not row.seal_torque and not row.spacer_balls:
        return None
    parts: dict[str, Any] = {"spacer_balls": True} if row.spacer_balls else {}
    if row.seal_torque:
        parts["losses"] = {"seals": Seals(seal_torque=row.seal_torque)}
    if not preloaded:
        return SingleNut(**parts)
    if row.nut_outer_diameter is not None:
        parts["bodies"] = Bodies(nut_outer_diameter=row.nut_outer_diameter)
    kind: Any = NUTS[row.nut]
    return kind(preload=preload_force(row), **parts)


def faults_of_nut(where: str, row: Listed) -> list[Fault]:
    """Faults of what a row, whose numbers are each within their bounds, lists of its nut."""
    if row.nut and row.nut not in NUTS:
        return [Fault(f"{where}.nut", "unknown kind of nut", row.nut, nearest(row.nut, NUTS))]
    if row.preload is not None and row.preload_share is not None:
        given, remedy = f"{row.preload_share:.4g}", "give the force, or the share of the dynamic load rating"
        return [Fault(f"{where}.preload_share", "is given beside the preload", given, remedy)]
    force = preload_force(row)
    if not force:
        return []
    field, given = "preload", shown(force, "N")
    if row.preload_share is not None:
        field, given = "preload_share", f"{row.preload_share:.4g}"
    kinds = either(PRELOADED)
    if row.nut not in PRELOADED:
        problem = f'a nut of type "{row.nut}" has none' if row.nut else "needs the kind of nut that has it"
        remedy = f"leave it empty, or give the nut as {kinds}" if row.nut else f"give the nut as {kinds}"
        return [Fault(f"{where}.{field}", problem, given, remedy)]
    if row.preload_share is not None and row.preload_share < SMALLEST_SHARE:
        remedy = 'vendors have 2 to 10 %; a spreadsheet holds "7 %" as 0.07: write it as text, or as 7'
        return [Fault(f"{where}.{field}", "is too small a share of the dynamic load rating", given, remedy)]
    rating = _rating(row)
    if force > rating:
        remedy = (
            f"check the number and its unit; {shown(rating, 'N')} is the rating, and vendors preload by 2 to 10 % of it"
        )
        return [Fault(f"{where}.preload", "exceeds the dynamic load rating", given, remedy, bound=rating)]
    return []
