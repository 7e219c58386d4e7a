"""Rows of catalogues, and the screws they describe."""

from __future__ import annotations

import csv
import dataclasses
import functools
import math
import tomllib
from collections.abc import Iterator, Mapping
from importlib import resources
from typing import Annotated, Any

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, faults_of, nearest, raise_if_any, shown
from ballscrew.basis.quantities import Angle, Count, DiameterSpeed, Force, Info, Length, Ratio, Stiffness, Torque, Unit
from ballscrew.physics.components.screw import RATING_CONFORMITY, BallScrew
from ballscrew.physics.equations import geometry
from ballscrew.physics.sizing.ratings import faults_of_nut, nut_of

#: Turns that carry no load where the balls of a nut leave and enter (ISO3408-5, as it fits the ratings of catalogues).
TURNS_WITHOUT_LOAD = 0.24

#: What few catalogues list of the nut, and tables of one's own may.
_OF_NUT = ("preload", "preload_share", "seal_torque")
_OF_TRADE = ("price_index", "speed_limit")

#: A ball this much smaller than its pitch circle is a slip of the unit; real ones have a ratio of 5 to 50.
SMALLEST_BALL = 1e-3
#: A lead this many times the pitch circle is one, too; the steepest real ones have two to three.
LARGEST_LEAD = 10

#: How good the default conformity is.
CONFORMITY_DOUBT = 0.01

_OPTIONAL = (
    "pitch_circle_diameter",
    "root_diameter",
    "dynamic_load_rating",
    "static_load_rating",
    "rigidity",
    "nut_outer_diameter",
)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class CatalogueRow(ByValue):
    """A ball screw as a catalogue lists it; what the catalogue leaves out is None or has a stated default.

    Defaults: a conformity of 0.54, which most root diameters of a catalogue imply (HIWIN's grooves for balls of
    3.175 mm have 0.56) and measured grooves (0.542, 0.544) confirm, good to about ±0.01; a contact angle of 45°; one
    thread start; a pitch circle as large as the nominal diameter (those listed are mostly 1.5 to 5 % larger).
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    name: str
    nominal_diameter: Annotated[Length, Info("d_0", "nominal diameter", "mm", above=0, hint="lengths are positive")]
    lead: Annotated[Length, Info("P_h", "advance of the nut in one turn", "mm", above=0, hint="lengths are positive")]
    ball_diameter: Annotated[Length, Info("d_w", "ball diameter", "mm", above=0, hint="lengths are positive")]
    turns: Annotated[
        Ratio,
        Info(
            "i",
            "turns of balls in one nut body, all circuits together",
            above=TURNS_WITHOUT_LOAD,
            at_most=100,
            hint="nuts have 2 to 6",
        ),
    ]
    starts: Annotated[
        Count, Info("N", "number of thread starts", at_least=1, whole=True, hint="give a whole number, 1 or more")
    ] = 1
    pitch_circle_diameter: Annotated[
        Length | None,
        Info("d_m", "diameter of the helix of the ball centres", "mm", above=0, hint="lengths are positive"),
    ] = None
    root_diameter: Annotated[
        Length | None, Info("d_r", "diameter at the bottom of the groove", "mm", above=0, hint="lengths are positive")
    ] = None
    contact_angle: Annotated[
        Angle,
        Info(r"\alpha", "angle of the contact normal against the radial plane", "deg", above=0, below=math.pi / 2),
    ] = math.pi / 4
    conformity: Annotated[
        Ratio,
        Info("f", "groove radius / ball diameter, screw and nut", above=0.5, at_most=1, hint="catalogues have 0.54"),
    ] = 0.54
    dynamic_load_rating: Annotated[
        Force | None, Info("C_a", "dynamic axial load rating", "kN", above=0, hint="ratings are positive")
    ] = None
    static_load_rating: Annotated[
        Force | None, Info("C_{0a}", "static axial load rating", "kN", above=0, hint="ratings are positive")
    ] = None
    rigidity: Annotated[
        Stiffness | None,
        Info(
            "R_{nu}",
            "nut stiffness as listed, at the greatest preload",
            "N/um",
            above=0,
            hint="300 N/um to 3000 N/um",
        ),
    ] = None
    nut_outer_diameter: Annotated[
        Length | None, Info("D_1", "outer diameter of the nut body", "mm", above=0, hint="about 1.5 d_0")
    ] = None
    #: Where the outer diameter of the nut is from, if not from the source of the row.
    nut_outer_diameter_source: str = ""
    #: Where the ball diameter is from, if not from the source of the row.
    ball_diameter_source: str = ""
    #: Who makes the nut, and how its balls return: the limit of its DN value is looked up by both.
    make: str = ""
    recirculation: str = ""
    #: How the nut is braced, by the name that the interfaces know it by; nothing where the catalogue does not say.
    nut: str = ""
    source: str = ""
    preload: Annotated[
        Force | None,
        Info(
            "F_pr",
            "axial preload without external load",
            "kN",
            at_least=0,
            hint="2 to 10 % of the dynamic load rating",
        ),
    ] = None
    preload_share: Annotated[
        Ratio | None,
        Info(
            "p",
            "preload / dynamic load rating, instead of the preload",
            at_least=0,
            at_most=1,
            hint="vendors have 2 to 10 %",
        ),
    ] = None
    seal_torque: Annotated[
        Torque | None,
        Info("M_W", "torque of all seals of the nut", at_least=0, hint="rubber: 0.08 N m at 16 mm, 0.4 N m at 40 mm"),
    ] = None
    #: Where the torque of the seals is from, if not from the source of the row.
    seal_torque_source: str = ""
    speed_limit: Annotated[
        DiameterSpeed | None,
        Info(
            "V",
            "largest DN value of the nut, pitch circle diameter times speed",
            "mm rpm",
            above=0,
            hint="standard nuts have 70000 mm rpm",
        ),
    ] = None
    price_index: Annotated[
        Ratio | None,
        Info(
            "p_i",
            "price against another of the same list",
            above=0,
            hint="of two screws, 1.2 costs a fifth more than 1",
        ),
    ] = None
    #: Whether every second ball is a spacer; None where the row does not say.
    spacer_balls: bool | None = None
    #: The series of the maker that the row is of.
    family: str = ""
    #: Turns of those listed that carry no load, and the conformity that the maker's ratings follow from.
    turns_without_load: float = TURNS_WITHOUT_LOAD
    rating_conformity: float = RATING_CONFORMITY
    #: Why no torque is computed of such a nut; empty where one is.
    refusal: str = ""

    def __post_init__(self) -> None:
        where = self.name or "row"
        raise_if_any(faults_of(where, self, optional=(*_OPTIONAL, *_OF_NUT, *_OF_TRADE)))
        if self.ball_diameter < SMALLEST_BALL * self.ball_circle:
            problem, given = "too small for the pitch circle", shown(self.ball_diameter, "m")
            least = SMALLEST_BALL * self.ball_circle
            remedy = f"check the unit; {shown(least, 'm')} or more"
            raise InputError(Fault(f"{where}.ball_diameter", problem, given, remedy, bound=least))
        bound = self.ball_circle + self.ball_diameter
        if self.nut_outer_diameter is not None and self.nut_outer_diameter <= bound:
            problem, given = "leaves no wall around the balls", shown(self.nut_outer_diameter, "m")
            remedy = f"check the unit and the column; above {shown(bound, 'm')}"
            raise InputError(Fault(f"{where}.nut_outer_diameter", problem, given, remedy, bound=bound))
        if self.lead > LARGEST_LEAD * self.ball_circle:
            problem, given = "too large for the pitch circle", shown(self.lead, "m")
            most = LARGEST_LEAD * self.ball_circle
            remedy = f"check the unit; {shown(most, 'm')} or less"
            raise InputError(Fault(f"{where}.lead", problem, given, remedy, bound=most))
        raise_if_any(faults_of_nut(where, self))

    @property
    def ball_circle(self) -> Annotated[Length, Info("d_m", "pitch circle diameter that counts", "mm")]:
        """Pitch circle diameter; the nominal diameter where the catalogue gives none."""
        return self.nominal_diameter if self.pitch_circle_diameter is None else self.pitch_circle_diameter

    @property
    def lead_angle(self) -> Annotated[Angle, Info(r"\varphi", "lead angle of the helix of the ball centres", "deg")]:
        """Lead angle of the helix of the ball centres."""
        return geometry.lead_angle(self.lead, self.ball_circle)

    @property
    def balls_per_turn(self) -> Annotated[int, Unit("1"), Info("z_1", "whole balls that find room in one turn")]:
        """Whole balls that find room in one turn."""
        return math.floor(math.pi * (self.ball_circle / self.ball_diameter) / math.cos(self.lead_angle))

    @property
    def loaded_turns(self) -> Annotated[Ratio, Info("i_l", "turns that carry load")]:
        """Turns that carry load."""
        return self.turns - self.turns_without_load

    @property
    def loaded_balls(self) -> Annotated[int, Unit("1"), Info("z", "balls of one nut body that carry load")]:
        """Balls of one nut body that carry load, any spacer balls between them counted, too."""
        return max(1, round(self.balls_per_turn * self.loaded_turns))

    @property
    def groove_root_diameter(
        self,
    ) -> Annotated[Length, Info("d_r", "diameter at the bottom of the groove, from the conformity", "mm")]:
        """Diameter at the bottom of the groove that the conformity implies; compare ``root_diameter``."""
        return geometry.groove_root_diameter(self.ball_circle, self.ball_diameter, self.conformity, self.contact_angle)

    def screw(self, **changes: Any) -> BallScrew:
        """The screw of the row, with the loaded balls of one nut body; ``changes`` are fields of ``BallScrew``.

        Where the row lists a preload, its nut has that, with its seals, and with elastic bodies where it lists the
        outer diameter of the nut. Elsewhere the balls are those of one nut body without preload. Raises
        :class:`~ballscrew.basis.errors.InputError` for a nut whose torque no model here computes.
        """
        if self.refusal:
            remedy = f"{self.refusal}; take a row of another family than {self.family}"
            raise InputError(Fault(f"{self.name}.screw", "no torque is computed of this nut", "", remedy))
        fields: dict[str, Any] = {
            "pitch_circle_diameter": self.ball_circle,
            "lead": self.lead,
            "ball_diameter": self.ball_diameter,
            "loaded_balls": self.loaded_balls,
            "contact_angle": self.contact_angle,
            "screw_conformity": self.conformity,
            "nut_conformity": self.conformity,
            "starts": self.starts,
        }
        nut = nut_of(self)
        if nut is not None:
            fields["nut"] = nut
        return BallScrew(**{**fields, **changes})


class UnknownRowError(InputError, KeyError):
    """A name that the catalogue does not have; a ``KeyError``, so that mappings work as usual."""

    __str__ = ValueError.__str__


class _Rows(Mapping[str, CatalogueRow]):
    """Rows by name, each made when somebody looks at it."""

    def __init__(self, fields: Mapping[str, Mapping[str, Any]]) -> None:
        self._fields = fields
        self._rows: dict[str, CatalogueRow] = {}

    def __getitem__(self, name: str) -> CatalogueRow:
        if name not in self._rows:
            if name not in self._fields:
                raise UnknownRowError(Fault("catalogue", "unknown row", str(name), nearest(str(name), self, most=5)))
            self._rows[name] = CatalogueRow(name=name, **self._fields[name])
        return self._rows[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)

    def __contains__(self, name: object) -> bool:
        return name in self._fields


@functools.cache
def catalogue() -> Mapping[str, CatalogueRow]:
    """The rows shipped, each a :class:`CatalogueRow`, by name (``data/screws.toml``, and the tables that it names).

    A name that it does not have raises an :class:`UnknownRowError` with the nearest one.
    """
    rows: dict[str, Mapping[str, Any]] = {}
    for table in tomllib.loads(_text("screws.toml"))["catalogue"]:
        shared = {name: value for name, value in table.items() if not isinstance(value, dict)}
        if "file" in table:
            rows |= _fields_of_file(shared, table["families"])
            continue
        outer = shared.pop("nut_outer_diameter_source", "")
        for name, fields in table["rows"].items():
            source = {"nut_outer_diameter_source": outer} if "nut_outer_diameter" in fields else {}
            rows[name] = {**shared, **source, **fields}
    return _Rows(rows)


def _text(file: str) -> str:
    return resources.files("ballscrew").joinpath("data", file).read_text(encoding="utf-8")


#: Columns of a file of rows: fields and their units in SI. Circuits and the turns of each are apart.
_OF_FILE: Mapping[str, tuple[str, float]] = {
    "d0_mm": ("nominal_diameter", 1e-3),
    "lead_mm": ("lead", 1e-3),
    "ball_pcd_mm": ("pitch_circle_diameter", 1e-3),
    "root_mm": ("root_diameter", 1e-3),
    "Ca_kN": ("dynamic_load_rating", 1e3),
    "C0a_kN": ("static_load_rating", 1e3),
    "K_N_um": ("rigidity", 1e6),
    "ball_mm_inferred": ("ball_diameter", 1e-3),
}


def _fields_of_file(
    shared: Mapping[str, Any], families: Mapping[str, Mapping[str, Any]]
) -> dict[str, Mapping[str, Any]]:
    """The rows of a file of a maker by name, as fields, with what the families of the maker are."""
    common = {name: value for name, value in shared.items() if name not in ("file", "source")}
    lines = [line for line in _text(shared["file"]).splitlines() if not line.startswith("#")]
    rows: dict[str, Mapping[str, Any]] = {}
    for row in csv.DictReader(lines):
        # to twelve digits: 39.7 mm are 0.0397 m
        listed = {name: float(f"{float(row[of]) * unit:.12g}") for of, (name, unit) in _OF_FILE.items() if row[of]}
        circuits, family = float(row["rows"]), dict(families[row["family"]])
        return_turns = circuits * family.pop("turns_of_a_return", 0.0)
        rolled = "-rolled" if row["family"].endswith("rolled") else ""
        rows[f"{shared['make']}-{row['model']}{rolled}".lower()] = {
            "source": f"{shared['source']}, PDF page {row['pdf_page']}, line {row['line']}",
            "family": row["family"],
            "turns": float(f"{circuits * float(row['turns']):.12g}"),
            "turns_without_load": return_turns,
            **listed,
            **common,
            **family,
        }
    return rows


def printed_rows() -> list[CatalogueRow]:
    """The rows shipped whose catalogue prints all sizes: of the others the ball is an estimate."""
    return [row for row in catalogue().values() if not row.ball_diameter_source]


def is_shipped(row: CatalogueRow) -> bool:
    """Test whether a row is one of those shipped. Their published numbers are of bodies of a usual size."""
    return catalogue().get(row.name) is row
