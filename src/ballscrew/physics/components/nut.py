"""The nut: how its balls are arranged and preloaded, and the bodies that carry their loads on."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Annotated, Any, NamedTuple, Protocol, TypeAlias, cast

import numpy as np

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import (
    MISSING,
    Fault,
    InputError,
    accepts_units,
    faults_of,
    holds_somewhere,
    is_concrete,
    names_keywords,
    raise_if_any,
)
from ballscrew.basis.quantities import Angle, Count, Force, Info, Length, Torque, fields_of
from ballscrew.basis.usual_ranges import warn_at_once

#: Of a preload. The smallest screws on sale, of 4 mm, are rated at some 300 N: 5 N is the least of their 2 to 10 %.
PRELOAD = Info(
    "F_pr",
    "axial preload without external load",
    at_least=0,
    hint="2 to 10 % of the dynamic load rating",
    usual=(5.0, 1e6),
)
Preload = Annotated[Force, PRELOAD]
Spacing = Annotated[
    Length,
    Info(
        "l",
        "axial distance between the two halves, last ball to first ball",
        "mm",
        at_least=0,
        hint="about a lead",
        usual=(0.0, 1.0),
    ),
]


class _Sized(Protocol):
    """The sizes of a screw that its bodies follow."""

    @property
    def pitch_circle_diameter(self) -> Any: ...
    @property
    def ball_diameter(self) -> Any: ...
    @property
    def contact_angle(self) -> Any: ...


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Bodies(ByValue):
    """The bodies of screw and nut between the balls: bars, and tubes that swell, and where the load enters them.

    A diameter that is not given has the usual size for the screw (:meth:`sized`).
    Raises :class:`~ballscrew.basis.errors.InputError` for diameters that are not positive or do not fit.
    """

    screw_diameter: Annotated[
        Length | None,
        Info(
            "d_c", "diameter of the screw's bar, its root diameter", "mm", above=0, hint="d_m - d_w", usual=(5e-4, 0.5)
        ),
    ] = None
    nut_outer_diameter: Annotated[
        Length | None,
        Info("D_o", "outer diameter of the nut's tube", "mm", above=0, hint="about 1.5 d_m", usual=(1e-3, 2.0)),
    ] = None
    nut_inner_diameter: Annotated[
        Length | None,
        Info("D_i", "inner diameter of the nut's tube", "mm", above=0, hint="about d_m + d_w", usual=(1e-3, 1.0)),
    ] = None
    #: Whether screw and nut are held on the same side of the balls: one is pulled where the other is pushed.
    same_side: bool = True
    #: Whether the balls widen the nut and shrink the shaft radially, too.
    swelling: bool = True

    def __post_init__(self) -> None:
        faults = faults_of("bodies", self, optional=tuple(fields_of(Bodies)))
        outer, inner = self.nut_outer_diameter, self.nut_inner_diameter
        if not faults and outer is not None and inner is not None and holds_somewhere(outer <= inner):
            remedy = "give the outer diameter of the nut, not that of its bore"
            faults.append(Fault("bodies.nut_outer_diameter", "must exceed the inner diameter", "", remedy))
        raise_if_any(faults)

    @classmethod
    def of(cls, screw: _Sized, *, same_side: bool = True) -> Bodies:
        """Bodies of a usual size for ``screw``: its core, and a nut one and a half pitch circles wide.

        ``same_side`` is the field of that name. Raises :class:`~ballscrew.basis.errors.InputError` as :meth:`sized`.
        """
        return cls(same_side=same_side).sized(screw)

    def sized(self, screw: _Sized) -> Bodies:
        """These bodies with the usual sizes for ``screw`` where none is given.

        Raises :class:`~ballscrew.basis.errors.InputError` for a nut that swells and has no wall around its balls.
        """
        d_m, d_w = screw.pitch_circle_diameter, screw.ball_diameter
        usual = {
            "screw_diameter": d_m - d_w,
            "nut_outer_diameter": 1.5 * d_m,
            "nut_inner_diameter": d_m + d_w,
        }
        missing = {name: value for name, value in usual.items() if getattr(self, name) is None}
        whole = dataclasses.replace(self, **missing) if missing else self
        if self.swelling and holds_somewhere(whole.nut_outer_diameter <= d_m + d_w * np.cos(screw.contact_angle)):
            remedy = "give the outer diameter of the nut, or let it not swell (swelling = false)"
            raise InputError(Fault("bodies.nut_outer_diameter", "leaves no wall around the balls", "", remedy))
        return whole


class Deviations(NamedTuple):
    """Deviations of each ball and of the lead at its place from the nominal ones, the ball axis last.

    ``ball_diameter`` and ``lead`` are arrays in m, or one number for all balls. Of a double nut both halves in a row,
    the one that carries the load first.
    """

    ball_diameter: Length = 0.0
    lead: Length = 0.0

    @classmethod
    @accepts_units("deviations")
    def scattered(cls, balls: int, *, seed: int, ball_diameter: Length = 0.0, lead: Length = 0.0) -> Deviations:
        """Normal scatter of so many ``balls``; the same ``seed`` gives the same balls.

        ``ball_diameter`` and ``lead`` are standard deviations, m. Raises :class:`~ballscrew.basis.errors.InputError`
        for a unit that is none of a length.
        """
        generator = np.random.default_rng(seed)
        return cls(ball_diameter * generator.standard_normal(balls), lead * generator.standard_normal(balls))

    @classmethod
    @accepts_units("deviations")
    def once_a_turn(cls, angles: Angle, groove: Length, phase: Angle = 0.0) -> Deviations:
        r"""Grooves whose place along the axis deviates once a turn, as that of a runout in grinding does.

        .. math:: e_i = e_g \cos(\psi_i + \psi_g)

        ``angles`` (rad) are those of the balls along the helix, the first at zero; ``groove`` is the amplitude, m, and
        ``phase`` that at the first ball, rad. A ball whose deviation is positive carries less on the forward flank.
        Returns :class:`Deviations` with that ``lead`` of each ball. Raises
        :class:`~ballscrew.basis.errors.InputError` for a wrong unit.
        """
        return cls(lead=groove * np.cos(np.asarray(angles) + phase))


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class Scatter(ByValue):
    """Scatter of balls and lead as standard deviations, and grooves that deviate once a turn.

    One seed gives the same balls every time, and the same phase of the grooves.
    Raises :class:`~ballscrew.basis.errors.InputError` for negative numbers.
    """

    ball_diameter: Annotated[
        Length,
        Info(
            "s_w",
            "standard deviation of the ball diameters",
            "um",
            at_least=0,
            hint="balls of one lot: below 1 um",
            usual=(0.0, 5e-5),
        ),
    ] = 0.0
    lead: Annotated[
        Length,
        Info(
            "s_h",
            "standard deviation of each ball's place on the lead",
            "um",
            at_least=0,
            hint="ground: about 1 um",
            usual=(0.0, 1e-4),
        ),
    ] = 0.0
    seed: Annotated[
        Count, Info("n_s", "seed of the random numbers", at_least=0, whole=True, hint="any whole number")
    ] = 1
    groove: Annotated[
        Length,
        Info(
            "e_g",
            "amplitude of the grooves' place along the axis, once a turn",
            "um",
            at_least=0,
            hint="ground: 1 um to 2 um",
            usual=(0.0, 1e-4),
        ),
    ] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("deviations", self))

    def of(self, balls: int, angles: Angle | None = None) -> Deviations:
        """The deviations of so many ``balls``, at ``angles`` along the helix (rad) where the grooves deviate."""
        seed = int(self.seed)
        deviations = Deviations.scattered(balls, seed=seed, ball_diameter=self.ball_diameter, lead=self.lead)
        if angles is None or not np.any(self.groove):
            return deviations
        # a stream of its own: the balls of a seed stay those they were
        phase = float(np.random.default_rng((seed, 1)).uniform(0.0, 2.0 * np.pi))
        return deviations._replace(lead=deviations.lead + Deviations.once_a_turn(angles, self.groove, phase).lead)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class NutParts(ByValue):
    """Parts that every nut may have besides its balls and its preload.

    Without bodies, screw and nut are rigid between the balls. Losses are laws of torque besides the balls by name, as
    ``{"seals": Seals(seal_torque=0.2)}`` (:mod:`ballscrew.physics.laws.nut_losses`).
    """

    #: Screw and nut between the balls; without them both are rigid there.
    bodies: Bodies | None = None
    #: Deviations of each ball, or their scatter.
    deviations: Deviations | Scatter | None = None
    #: Laws of torque besides the balls, N m, by name.
    losses: Mapping[str, Callable[..., Torque]] = dataclasses.field(default_factory=dict[str, Callable[..., Torque]])
    #: Whether every second ball is a spacer: smaller than the others, so that it parts them and carries nothing.
    spacer_balls: bool = False

    #: Nut bodies or halves with the loaded balls of the screw each.
    halves = 1
    #: Contacts of a ball that is preloaded.
    contacts_per_ball = 2
    #: Whether the contact angle stays nominal where nothing braces the balls.
    nominal_angle = False
    #: Whether the preload is that at rest; of a nut whose preload is the same at rest and in motion it is not asked.
    set_at_rest = False

    @property
    def one_by_one(self) -> bool:
        """True where the balls differ, so that each is solved by itself."""
        return self.bodies is not None or self.deviations is not None

    @property
    def is_row(self) -> bool:
        """True where all balls carry the same load at the nominal contact angle: the row of balls of Olaru2005."""
        return self.nominal_angle and not self.one_by_one

    @property
    def parts(self) -> dict[str, Any]:
        """The nut and its parts that have quantities, by their sections in a case file."""
        scatter = self.deviations if isinstance(self.deviations, Scatter) else None
        values = {"nut": self, "bodies": self.bodies, "deviations": scatter}
        values |= {f"losses.{name}": law for name, law in self.losses.items() if dataclasses.is_dataclass(law)}
        return {section: part for section, part in values.items() if part is not None}

    def value_of(self, name: str) -> Any:
        """The value of an input by ``name``: ``preload``, ``nut.preload``, or ``losses.seals.seal_torque``."""
        section, _, field = name.rpartition(".")
        return getattr(self.losses[section.removeprefix("losses.")] if section not in ("", "nut") else self, field)

    def changed(self, name: str, value: Any) -> Nut:
        """The nut with another ``value`` (SI) of an input, whose ``name`` is as in :meth:`value_of`."""
        section, _, field = name.rpartition(".")
        if section in ("", "nut"):
            return self._with(field, value)
        law: Any = self.losses[loss := section.removeprefix("losses.")]
        return dataclasses.replace(self._nut, losses={**self.losses, loss: dataclasses.replace(law, **{field: value})})

    def _with(self, field: str, value: Any) -> Nut:
        return dataclasses.replace(self._nut, **{field: value})

    @property
    def _nut(self) -> Nut:
        return cast("Nut", self)

    def deviations_of(self, balls: Any, angles: Angle | None = None) -> Deviations | None:
        """The deviations of each ball of a nut of which so many ``balls`` carry load in each half.

        ``angles`` are those of all of them along the helix, rad; without them no groove deviates.
        """
        if not isinstance(self.deviations, Scatter):
            return self.deviations
        if not is_concrete(balls):
            return Deviations()
        return self.deviations.of(self.halves * int(balls), angles)


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class SingleNut(NutParts):
    """One nut body without preload: each ball touches one flank of screw and nut, and there may be play.

    Rigid, and with balls alike, it is the row of equal balls of Olaru2005 at the nominal contact angle; with
    ``angle_under_load`` the angle follows the load there too, as it always does where balls differ or are preloaded.
    Raises :class:`~ballscrew.basis.errors.InputError` for a negative play.
    """

    axial_play: Annotated[
        Length,
        Info("S_a", "axial play between screw and nut", "um", at_least=0, hint="5 um to 100 um", usual=(0.0, 1e-3)),
    ] = 0.0
    angle_under_load: bool = dataclasses.field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))
        warn_at_once("nut", self)

    @property
    def nominal_angle(self) -> bool:  # pyright: ignore[reportIncompatibleVariableOverride]  (a constant elsewhere)
        """True where the contact angle stays nominal."""
        return not self.angle_under_load


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class OversizeBallNut(NutParts):
    """One nut body, preloaded by balls too big for its grooves: each touches both flanks of both, four contacts.

    The preload is the axial force that each flank would carry by itself: that of the balls on one
    flank of the nut, which those on the other hold. Instead of it, the ``oversize`` of the balls against their
    grooves can be given.
    Raises :class:`~ballscrew.basis.errors.InputError` for a negative preload or oversize, and for both or none of them.
    """

    preload: Annotated[Force | None, PRELOAD] = None
    oversize: Annotated[
        Length | None,
        Info(
            r"\delta_w",
            "diameter of the balls beyond what fits their grooves",
            "um",
            at_least=0,
            hint="a few micrometres",
            usual=(0.0, 1e-4),
        ),
    ] = None
    contacts_per_ball = 4

    def __post_init__(self) -> None:
        faults = faults_of("nut", self, optional=("preload", "oversize"))
        if (self.preload is None) == (self.oversize is None):
            problem = MISSING if self.preload is None else "is given beside the oversize of the balls"
            faults.append(Fault("nut.preload", problem, "", "give either the preload or the oversize of the balls"))
        raise_if_any(faults)
        warn_at_once("nut", self)

    def _with(self, field: str, value: Any) -> Nut:
        other = {"preload": "oversize", "oversize": "preload"}.get(field)
        return dataclasses.replace(self, **{field: value, **({other: None} if other else {})})


def _flag_faults(nut: Any) -> list[Fault]:
    """Fault of a truth value that is none: a text or an array would count as true."""
    if isinstance(nut.set_at_rest, bool):
        return []
    return [Fault("nut.set_at_rest", "must be true or false", repr(nut.set_at_rest), "without quotes")]


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class DoubleNut(NutParts):
    """Two nut bodies braced against each other: the balls of each touch one flank, opposite to the other's.

    The loaded balls of the screw are those of one body; the other has as many.
    Raises :class:`~ballscrew.basis.errors.InputError` for a negative preload or spacing.
    """

    preload: Preload
    spacing: Spacing = 0.0
    #: Whether the preload is what the nut was given at rest: motion pushes the balls off the line of their grooves, so
    #: that both halves press harder, also once it has stopped. Else it is what acts in motion, and at the first start.
    set_at_rest: bool = dataclasses.field(default=False, kw_only=True)
    halves = 2

    def __post_init__(self) -> None:
        raise_if_any([*faults_of("nut", self), *_flag_faults(self)])
        warn_at_once("nut", self)


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class OffsetLeadNut(NutParts):
    """One nut body whose lead has an offset in its middle, which braces the balls before and behind it.

    It works like a :class:`DoubleNut`; the loaded balls of the screw are those of one half.
    Raises :class:`~ballscrew.basis.errors.InputError` for a negative preload or spacing.
    """

    preload: Preload
    spacing: Spacing = 0.0
    #: Whether the preload is what the nut was given at rest: motion pushes the balls off the line of their grooves, so
    #: that both halves press harder, also once it has stopped. Else it is what acts in motion, and at the first start.
    set_at_rest: bool = dataclasses.field(default=False, kw_only=True)
    halves = 2

    def __post_init__(self) -> None:
        raise_if_any([*faults_of("nut", self), *_flag_faults(self)])
        warn_at_once("nut", self)


Nut: TypeAlias = SingleNut | OversizeBallNut | DoubleNut | OffsetLeadNut

#: The kinds of nut by their names.
NUTS: Mapping[str, type[Nut]] = {
    "single": SingleNut,
    "oversize-balls": OversizeBallNut,
    "double": DoubleNut,
    "offset-lead": OffsetLeadNut,
}
#: Those that may have a preload.
PRELOADED = tuple(name for name, kind in NUTS.items() if "preload" in fields_of(kind))
