"""The case: the model, the parts and the operating point that every command evaluates."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.motion.profiles import Motion, Segments
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.arrays import lazy
from ballscrew.basis.displayed import Displayed
from ballscrew.basis.quantities import Length, MomentOfInertia, fields_of
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE, unusual
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.physics.components.materials import STEEL_DENSITY, Lubricant
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.oil_grades import has_additives
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations.shaft import shaft_inertia
from ballscrew.physics.friction.calibrations import Calibration
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.validity import implausible, named_parts
from ballscrew.physics.laws.friction import FRESH_BOUNDARY_FRICTION
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.sizing.catalogue import CatalogueRow, is_shipped
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.sizing.own_nut import RATED, odd_ratings, odd_root, odd_seals
from ballscrew.physics.sizing.ratings import rated_geometry_of, ratings_of

#: A moved mass below this share of that of the nut is a slip: the mass of the nut is an estimate.
_LEAST_MASS = 0.5
#: The limits of the checks where a case gives none.
USUAL_LIMITS = Limits()


class TurningShaft(NamedTuple):
    """The shaft of a screw as a cylinder that turns."""

    inertia: MomentOfInertia
    #: The nominal diameter of the row, or else that of the pitch circle.
    diameter: Length
    length: Length
    #: True where no length is given, and the stroke of the motion stands for it.
    of_stroke: bool = False


class PreloadNote(NamedTuple):
    """A preload that was given as a share of the dynamic load rating."""

    share: float
    rating: float
    source: str

    def __str__(self) -> str:
        """``preload 5.047 kN: 7 % of the dynamic load rating 72.1 kN, as listed``."""
        return self.text

    @property
    def text(self) -> str:
        """``preload 5.047 kN: 7 % of the dynamic load rating 72.1 kN, as listed``."""
        quantity = LISTED["dynamic_load_rating"]
        force, rating = (units.shown(value, quantity) for value in (self.share * self.rating, self.rating))
        return f"preload {force}: {100 * self.share:.4g} % of the dynamic load rating {rating}, {self.source}"


@dataclasses.dataclass(frozen=True, eq=False)
class Origins:
    """Sources of the numbers of a case, and how well its file knows them."""

    #: Grade and temperature the oil was made from, where it was.
    oil: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])
    #: The catalogue row the screw was made from, where it was.
    row: CatalogueRow | None = None
    #: Load ratings and root diameter, where a catalogue or the case lists them.
    listed: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    #: Numbers that were derived from others.
    notes: Sequence[PreloadNote] = ()
    #: The named calibration that gave two numbers of the model.
    calibration: Calibration | None = None
    #: The table ``[calibration]`` that a fit wrote beside its numbers, as it stands in the file.
    fit: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])
    #: Distributions of inputs that the file gives, in SI, named as sweeps name inputs; the rest of the case has
    #: their central values. :func:`~ballscrew.cases.case_files.uncertain_inputs.all_of` adds the defaults of the
    #: others.
    uncertain: Mapping[str, Distribution] = dataclasses.field(default_factory=dict[str, Distribution])
    #: Inputs that the file gives as exact (± 0).
    exact: frozenset[str] = frozenset()
    #: Distributions of numbers of the surroundings that the file gives, named as ``surroundings.ball_conductance``.
    uncertain_surroundings: Mapping[str, Distribution] = dataclasses.field(default_factory=dict[str, Distribution])
    #: Numbers of the surroundings that the file gives, also those that it gives as they are by default.
    given_surroundings: frozenset[str] = frozenset()
    #: Distributions of numbers of bearings and guides that the file gives, by section and field.
    uncertain_supports: Mapping[str, Distribution] = dataclasses.field(default_factory=dict[str, Distribution])
    #: Places of values that were estimated when the case was made: ``installation.unsupported_length``.
    estimated: frozenset[str] = frozenset()
    #: Warnings of numbers that the file writes so that they could be others
    #: (:mod:`ballscrew.cases.case_files.case_text`).
    doubtful_numbers: Sequence[Record] = ()
    #: Whether the operating point is that of steady travel in the motion, as the file gives none.
    travels: bool = False
    #: Whether the file gives the speed of the nut: of another lead, it is another speed of the screw.
    speed_of_nut: bool = False


#: Of a case that no file made.
NO_ORIGINS = Origins()


@dataclasses.dataclass(frozen=True, eq=False)
class Case(Displayed):
    """The content of a case file: a model, a screw, an oil, an operating point, an axis, and where they are from."""

    model: FrictionModel
    screw: BallScrew
    lubricant: Lubricant
    operation: OperatingState
    sweep: Mapping[str, str] = dataclasses.field(default_factory=dict[str, str])
    origins: Origins = NO_ORIGINS
    #: The efficiency of the rule that stands in for the model; None where the model counts.
    efficiency: float | None = None
    installation: Installation | None = None
    limits: Limits = USUAL_LIMITS
    #: What moves, how it moves, and what drives it: of ``ballscrew duty`` and ``ballscrew warm-up``.
    axis: Axis | None = None
    motion: Motion | None = None
    motor: Motor | None = None
    #: Where the heat goes: of ``ballscrew warm-up``.
    surroundings: Surroundings | None = None
    #: The bearings of the shaft by their place on it.
    bearings: Mapping[str, MountedBearing] = dataclasses.field(default_factory=dict[str, MountedBearing])

    @property
    def bearings_by_name(self) -> Mapping[str, MountedBearing]:
        """The bearings of the shaft by the names that their friction has."""
        return {bearing.name: bearing for bearing in self.bearings.values()}

    @property
    def nut(self) -> Nut | None:
        """The nut with its preload, bodies and losses; None for a row of equal balls and nothing else."""
        nut = self.screw.nut
        return None if nut.is_row and not nut.losses and not nut.spacer_balls else nut

    def sizes_of_nut(self, screw: BallScrew) -> dict[str, Any]:
        """Sizes and make of the nut as a row lists them, for the rigidity by ISO 3408-4 of a screw of the case."""
        row, bodies = self.origins.row, screw.nut.bodies
        if row is None or row.ball_circle != screw.pitch_circle_diameter:
            return {"nut_outer_diameter": None, "nominal_diameter": None, "make": ""}
        listed = row.nut_outer_diameter if bodies is None or bodies.nut_outer_diameter is None else None
        return {"nut_outer_diameter": listed, "nominal_diameter": row.nominal_diameter, "make": row.make}

    @property
    def shaft_length(self) -> Length | None:
        """The shaft between its bearings: of the surroundings, or the unsupported one; None where none is given."""
        if self.surroundings is not None and self.surroundings.shaft_length is not None:
            return float(self.surroundings.shaft_length)
        return None if self.installation is None else float(self.installation.unsupported_length)

    @lazy
    def turning_shaft(self) -> TurningShaft | None:
        """The shaft of the screw as it turns, at least as long as the stroke; None where neither is known."""
        if self.shaft_length is not None:
            return self.shaft_of(self.shaft_length)
        stroke = 0.0 if self.motion is None else self.motion.states().stroke
        return self.shaft_of(stroke)._replace(of_stroke=True) if stroke else None

    def shaft_of(self, length: Length) -> TurningShaft:
        """The shaft of the screw as it turns, were it of this ``length`` (m)."""
        row, screw = self.origins.row, self.screw
        listed = row is not None and row.ball_circle == screw.pitch_circle_diameter
        diameter = float(row.nominal_diameter if row is not None and listed else screw.pitch_circle_diameter)
        bore = 0.0 if self.surroundings is None else float(self.surroundings.bore)
        density = STEEL_DENSITY if self.installation is None else float(self.installation.shaft_density)
        return TurningShaft(shaft_inertia(diameter, bore, length, density), diameter, length)

    @lazy
    def turning_axis(self) -> Axis | None:
        """The axis with the inertia of the screw, where it is given neither by itself nor in that of all that turns."""
        axis = self.axis
        if axis is None or axis.inertia or axis.screw_inertia is not None or self.turning_shaft is None:
            return axis
        return dataclasses.replace(axis, screw_inertia=self.turning_shaft.inertia)

    def implausible(self) -> list[Record]:
        """A warning for each input that no ball screw has, and :attr:`doubts`."""
        parts = named_parts(self.model, self.screw, self.lubricant, operation=self.operation)
        return [*implausible(parts), *self.doubts]

    @property
    def _other_parts(self) -> dict[str, Any]:
        """Parts beside screw, nut and oil, by the section that its fields have."""
        axis, motion = self.axis, self.motion
        segments = motion.segments if isinstance(motion, Segments) else ()
        parts = {
            "installation": self.installation,
            "limits": self.limits,
            "axis": axis,
            "motion": motion,
            **{f"motion.segment {number}": part for number, part in enumerate(segments, start=1)},
            "motor": self.motor,
            "surroundings": self.surroundings,
            **{f"bearings.{place}": bearing.element for place, bearing in self.bearings.items()},
            "guides": None if axis is None else axis.guides,
        }
        return {section: part for section, part in parts.items() if part is not None}

    def _far_from_estimates(self) -> list[Record]:
        """Warnings of what is given beside the geometry of the screw, and is far from what follows from it.

        None where the geometry itself is one that no screw has: all that follows from it would be.
        """
        screw, listed = self.screw, self.origins.listed
        if unusual("screw", screw) or _too_many_balls(screw, self.origins.row):
            return []
        geometry, row = rated_geometry_of(screw), self.origins.row
        if row is not None and is_shipped(row) and geometry == rated_geometry_of(row.screw(nut=screw.nut)):
            # what its own catalogue prints of these balls is no slip
            listed = {name: value for name, value in listed.items() if value != getattr(row, name)}
        ratings = odd_ratings(listed, ratings_of(geometry)) if {*RATED} & {*listed} else []
        values = [*ratings, *odd_root(listed.get("root_diameter"), screw), *odd_seals(screw)]
        return [*values, *_light(self.axis, screw)]

    @property
    def unlikely(self) -> tuple[str, ...]:
        """Inputs, by section and field, that no screw or axis has, or that could be others."""
        return tuple(dict.fromkeys(one.subject for one in self.implausible() if one.id.startswith("inputs.")))

    @property
    def doubts(self) -> list[Record]:
        """Warnings that the parts of the friction cannot tell: fitted numbers that no screw has, numbers that could be
        others, numbers of axis, motor and mounting that none has, ratings, root diameter, seals and mass far from those
        by the geometry, balls beyond the turns of the row, a calibration of other nuts, boundary friction of surfaces
        that have not reacted.
        """
        return [
            *implausible(self._other_parts),
            *self._far_from_estimates(),
            *_of_fit(self.origins.fit),
            *self.origins.doubtful_numbers,
            *_too_many_balls(self.screw, self.origins.row),
            *_of_other_nuts(self.origins.calibration, self.screw.nut),
            *_not_reacted(self.model, self.lubricant),
        ]


def _light(axis: Axis | None, screw: BallScrew) -> list[Record]:
    """A warning of an axis that moves less than the nut alone weighs; without any mass it is a force that moves."""
    if axis is None:
        return []
    from ballscrew.axis.thermal.network import nut_mass_of  # loads xarray, which a single run does without

    nut = nut_mass_of(screw)
    if not 0 < axis.mass < _LEAST_MASS * nut:
        return []
    quantity = fields_of(Axis)["mass"]
    message = (
        f"moved mass {units.shown(axis.mass, quantity)} is less than that of the nut, about "
        f"{units.shown(nut, quantity, 2)}: check the number and its unit"
    )
    return [Record.warning(IMPLAUSIBLE, "axis.mass", message, value=float(axis.mass), limit=nut, unit="kg")]


def _of_fit(table: Mapping[str, Any]) -> list[Record]:
    """Records of the fit that a case is from on its own numbers: which of them no screw has."""
    return [
        Record.warning("calibration.implausible", f"calibration.{place}", f"calibrated, and {text}")
        for place, text in enumerate(table.get("verdicts", ()))
    ]


def _of_other_nuts(calibration: Calibration | None, nut: Nut) -> list[Record]:
    """A warning of a calibration that was fitted to nuts whose balls have another number of contacts."""
    if calibration is None or nut.contacts_per_ball in calibration.contacts_per_ball:
        return []
    fitted = units.number(calibration.contacts_per_ball[0])
    contacts = units.number(nut.contacts_per_ball)
    message = (
        f"the calibration {calibration.name} was fitted to nuts with {fitted} contacts a ball, and this one has "
        f"{contacts}"
    )
    return [
        Record.warning(
            "calibration.other_nuts",
            "model.calibration",
            message,
            value=float(nut.contacts_per_ball),
            limit=float(calibration.contacts_per_ball[0]),
        )
    ]


def _not_reacted(model: FrictionModel, lubricant: Lubricant) -> list[Record]:
    """A warning of boundary friction as of reacted surfaces for new ones, or for an oil without additives."""
    friction = getattr(model.friction, "boundary_friction_coefficient", None)
    is_new = traits_of(model.friction).new_surfaces
    bare = not has_additives(lubricant.grade)
    if friction is None or not (is_new or bare) or not float(friction) > 1.5 * FRESH_BOUNDARY_FRICTION:
        return []
    fresh = units.number(FRESH_BOUNDARY_FRICTION)
    reason = (
        f", and this oil has none; {fresh} was measured before a film of reacted oil had grown"
        if bare
        else f"; on new ones {fresh} was measured, and it rose while they ran in"
    )
    message = (
        f"boundary friction of {units.number(friction)} is that of surfaces that have reacted with additives{reason}"
    )
    return [
        Record.warning(
            "friction.not_reacted", "model.friction", message, value=float(friction), limit=FRESH_BOUNDARY_FRICTION
        )
    ]


def _too_many_balls(screw: BallScrew, row: CatalogueRow | None) -> list[Record]:
    """A warning of loaded balls that the turns of the row do not hold."""
    if row is None:
        return []
    most = math.ceil(
        row.turns * math.pi * screw.pitch_circle_diameter / screw.ball_diameter / math.cos(screw.lead_angle)
    )
    if screw.loaded_balls <= most:
        return []
    balls, turns, room = (units.number(count) for count in (screw.loaded_balls, row.turns, most))
    return [
        Record.warning(
            IMPLAUSIBLE,
            "screw.loaded_balls",
            f"{balls} loaded balls, and the {turns} turns of {row.name} hold {room}: check the number",
            value=float(screw.loaded_balls),
            limit=float(most),
        )
    ]
