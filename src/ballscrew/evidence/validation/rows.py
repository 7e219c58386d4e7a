"""Evaluations of a model for the rows of each set of data, and the statements of the rows."""
# ruff: noqa: ARG001  (evaluations of rows have one signature)

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.axis.supports.bearing import SupportBearing
from ballscrew.basis.errors import Fault, InputError, either
from ballscrew.basis.quantities import Ratio, Torque, fields_of
from ballscrew.evidence.validation.entries import RPM, Band, Conditions, OperatingPoint, Point, UpperLimitOnly, Values
from ballscrew.files.tables.headings import YES
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Bodies, DoubleNut, Nut, OffsetLeadNut, OversizeBallNut, SingleNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import STEEL, BallScrew
from ballscrew.physics.equations import geometry, hertz, rheology, transmission
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.conditions import ContactConditions, Motion
from ballscrew.physics.laws.nut_losses import Seals
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.makers_tables import factors_of_makes
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.physics.sizing.rigidity import rigidity_iso3408
from ballscrew.physics.sizing.rules import CHART_LINES, DRAG_RULES, LOADED_RULES, RULES, Subject, of_model
from ballscrew.physics.solvers.load_distribution import ball_loads

#: The share of the dynamic load rating at which THK514E defines the rigidity of a nut without preload (as recalled).
RIGIDITY_LOAD = 0.30
#: Factor for accuracy of the rigidity that a catalogue prints. Rexroth2006 names neither it nor a grade. ISO 3408-4 has
#: 0.6, 0.55 and 0.5 (as recalled); this is that of its coarsest grade, and the others are reported beside it.
ACCURACY_FACTOR = {one.make: one.value for one in factors_of_makes()}["Rexroth"]
OTHER_FACTORS = (0.55, 0.6)
#: The share of the dynamic load rating that vendors preload double nuts with at most.
USUAL_PRELOAD = 0.10

#: The share of the dynamic load rating at which the friction coefficient is compared with charts that state no load.
CHART_LOAD = 0.10
#: The medium preload of HIWIN2016 over the dynamic load rating: printed as 6 to 8 %, of no row by itself.
MEDIUM_PRELOAD = 0.07
ENDS_OF_MEDIUM = (0.06, 0.08)
#: The preload at which Rexroth2006 states nuts with oversize balls.
USUAL_OF_OVERSIZE = 0.05
#: Kinds of nut by the words of HIWIN's stock list. Its single nuts that have a drag are braced by oversize balls.
_STOCK: Mapping[str, type[DoubleNut | OffsetLeadNut | OversizeBallNut]] = {
    "single": OversizeBallNut, "double": DoubleNut, "offset": OffsetLeadNut,
}  # fmt: skip
#: Groups of rows by the kind of nut.
DOUBLE, SINGLE = "double", "single"
WITH_SPACERS, WITH_WIPERS = "{nut}, spacer balls", "{nut}, two wipers"
#: Contact angle of bearings made for screws.
_OF_SUPPORT_BEARINGS = math.radians(60)
#: A speed beside that of the set, as some torques of bearings are said to be those of a start, 10 rpm.
_SLOW = 10 * RPM
#: Preloaded nuts by the names of case files.
_BRACED: Mapping[str, type[DoubleNut | OversizeBallNut]] = {"double": DoubleNut, "oversize-balls": OversizeBallNut}

_SCREW = tuple(fields_of(CatalogueRow))


# -- screws of a catalogue ------------------------------------------------------------------------


def screw_of(values: Values) -> CatalogueRow:
    """The catalogue row of the values of a row; without a name it is called by its sizes."""
    # a preload is that of a statement, not of the row
    fields = {name: values[name] for name in _SCREW if name in values and not name.startswith("preload")}
    sizes = "x".join(f"{1000 * values[name]:.6g}" for name in ("nominal_diameter", "lead", "ball_diameter"))
    row = CatalogueRow(name=values.get("name") or f"{sizes}-{values['turns']:g}", **fields)
    row.screw()
    return row


def _descriptors(row: CatalogueRow) -> dict[str, float]:
    d_0 = float(row.nominal_diameter)
    return {"size": d_0, "lead": row.lead, "steepness": row.lead / d_0, "ball": row.ball_diameter}


def _stated(values: Values, name: str) -> Band:
    """The band of two columns. Raises for ends that are the wrong way round."""
    return _between(values, f"{name}_min", f"{name}_max")


def _between(values: Values, least: str, greatest: str) -> Band:
    low, high = float(values[least]), float(values[greatest])
    if not low < high:
        raise InputError(Fault(f"row.{greatest}", "does not exceed the minimum", "", "the smallest torque comes first"))
    return Band((low + high) / 2, low, high)


def _unloaded(
    model: FrictionModel, row: CatalogueRow, nut: Nut, conditions: Conditions
) -> tuple[OperatingPoint, FrictionResult, dict[str, float]]:
    """A nut without load at these conditions, its result, and what its row is like."""
    at = OperatingPoint(row.screw(nut=nut), conditions.lubricant, 0.0, conditions.screw_speed)
    result = model(at.screw, at.lubricant, axial_load=at.axial_load, screw_speed=at.screw_speed)
    film = float(np.min([np.min(pair.screw.film_parameter) for pair in result.pairs]))
    return at, result, {**_descriptors(row), "film_parameter": film}


def _drag_laws(
    model: FrictionModel,
    row: CatalogueRow,
    preload: float,
    conditions: Conditions,
    middle: float,
    two_contacts: bool,
    with_model: bool = True,
) -> dict[str, float]:
    """Torques by the rules of vendors, over the middle of the band; and by the model's efficiency under load."""
    subject = Subject(row.nominal_diameter, row.ball_circle, row.lead, preload=preload, oversize_balls=not two_contacts)
    drags = {name: RULES[name].estimate(subject).drag_torque for name in DRAG_RULES}
    if two_contacts and with_model:
        half = model(row.screw(), conditions.lubricant, axial_load=preload, screw_speed=conditions.screw_speed)
        drags["efficiency"] = of_model(subject, half.efficiency)
    return {name: float(drag) / middle for name, drag in drags.items()}


def _preloaded(values: Values, percent: int) -> float:
    return percent / 100 * float(values["dynamic_load_rating"])


def _no_load_point(
    model: FrictionModel,
    row: CatalogueRow,
    nut: DoubleNut | OffsetLeadNut | OversizeBallNut,
    conditions: Conditions,
    band: Band,
    *,
    name: str = "",
    group: str = "",
    with_model: bool = True,
    **more: Any,
) -> Point:
    """The torque of a preloaded nut without load beside a stated one; ``more`` describes the row further."""
    at, result, descriptors = _unloaded(model, row, nut, conditions)
    two_contacts, preload = nut.contacts_per_ball == 2, float(nut.preload or 0.0)
    return Point(
        name=name or row.name,
        value=float(result.screw_torque),
        band=band,
        descriptors={**descriptors, **more},
        laws=_drag_laws(model, row, preload, conditions, band.middle, two_contacts, with_model),
        warnings=result.warning_records,
        group=group or (DOUBLE if two_contacts else SINGLE),
        computed_at=at,
    )


def double_nut(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """No-load torque of a double nut at preloads of 7 and 10 %."""
    row, at = screw_of(values), conditions.of(values)
    return [
        _no_load_point(
            model,
            row,
            DoubleNut(preload=_preloaded(values, percent)),
            at,
            _stated(values, f"no_load_torque_{percent}pct"),
            name=f"{row.name} at {percent} %",
            preload_share=percent / 100,
        )
        for percent in (7, 10)
    ]


def single_nut(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """No-load torque of a nut with oversize balls at a preload of 5 %; at 2 % there is a maximum only."""
    row, at = screw_of(values), conditions.of(values)
    nut, band = OversizeBallNut(preload=_preloaded(values, 5)), _stated(values, "no_load_torque_5pct")
    point = _no_load_point(model, row, nut, at, band, name=f"{row.name} at 5 %", preload_share=0.05)
    if "no_load_torque_2pct_max" not in values:
        return [point]
    _, light, _ = _unloaded(model, row, OversizeBallNut(preload=_preloaded(values, 2)), at)
    limit = UpperLimitOnly(f"{row.name} at 2 %", float(light.screw_torque), float(values["no_load_torque_2pct_max"]))
    return [dataclasses.replace(point, upper_limits=[limit])]


def worked_example(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Preload drag of a double nut whose preload is given as a force."""
    row, at = screw_of(values), conditions.of(values)
    band = _stated(values, "drag_torque")._replace(middle=float(values["drag_torque"]))
    return [_no_load_point(model, row, DoubleNut(preload=float(values["preload"])), at, band)]


def stock_nut(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Drag of a nut of HIWIN's stock list at a medium preload, with others beside it: those at the ends of what is
    medium, of single nuts that at 5 %, too.

    No preload is printed for a row. The dynamic load rating that is listed, and so the preload, is taken as that of
    the circuits of the row: one body of a double nut, one half of a nut with an offset, half of the balls where every
    second one is a spacer. The ratings by ISO 3408-5 say so: over those listed they are 1.16 to 1.17 for double nuts,
    1.12 to 1.19 for nuts with an offset, but for one, and 1.10 to 1.20 for single nuts with spacers, but for three, all
    in circuits of 2.5 turns: those have more turns without load than the 0.24 taken here. The six single nuts FSI, full
    of balls in circuits of one turn, have 1.47 to 1.54 times their listed rating by the standard: what they carry is
    read with less certainty than the others. No point of a nut that the model cannot compute.
    """
    row, at, kind = screw_of(values), conditions.of(values), str(values["nut"])
    if kind not in _STOCK:
        raise InputError(_unknown_nut(kind, _STOCK))
    spacers = values.get("spacer_balls") == YES
    rated = float(values["dynamic_load_rating"])

    def nut(share: Ratio) -> DoubleNut | OffsetLeadNut | OversizeBallNut:
        return _STOCK[kind](preload=share * rated, spacer_balls=spacers)

    if not model.knows(nut(MEDIUM_PRELOAD)):
        return []
    band = _between(values, "drag_low", "drag_high")
    group = WITH_SPACERS.format(nut=kind) if spacers else kind
    point = _no_load_point(model, row, nut(MEDIUM_PRELOAD), at, band, group=group, preload_share=MEDIUM_PRELOAD)
    shares = ENDS_OF_MEDIUM if kind != SINGLE else (USUAL_OF_OVERSIZE, *ENDS_OF_MEDIUM)
    others = np.asarray(_torque_without_load(model, row.screw(nut=nut(np.array(shares))), at))
    definitions = {
        f"at_{100 * share:.0f}_percent": float(torque) / band.middle
        for share, torque in zip(shares, others, strict=True)
    }
    return [dataclasses.replace(point, definitions=definitions)]


def stock_bound(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """The points of :func:`stock_nut` against the greatest drag of their range, which they must stay below."""
    most = float(values["drag_high"])
    return [
        dataclasses.replace(
            point,
            band=Band(most, 0.0, most),
            laws={},
            definitions={name: ratio * point.band.middle / most for name, ratio in point.definitions.items()},
        )
        for point in stock_nut(model, values, conditions)
    ]


def _torque_without_load(model: FrictionModel, screw: BallScrew, at: Conditions) -> Torque:
    return model(screw, at.lubricant, axial_load=0.0, screw_speed=at.screw_speed).screw_torque


def plausible_screw(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """No-load torque of a screw that could be the measured one, against what two of its kind had.

    Where the row has a torque of wipers there is a second point with them. No point of a nut that the model cannot
    compute.
    """
    row, at = screw_of(values), conditions.of(values)
    kind, preload = str(values["nut"]), float(values["preload"])
    if kind not in _BRACED:
        raise InputError(_unknown_nut(kind, _BRACED))
    bare = _BRACED[kind](preload=preload)
    if not model.knows(bare):
        return []
    group = DOUBLE if bare.contacts_per_ball == 2 else SINGLE
    nuts = {row.name: (bare, group)}
    if wipers := float(values.get("seal_torque", 0.0)):
        sealed = dataclasses.replace(bare, losses={"seals": Seals(wipers)})
        nuts[f"{row.name}, wipers"] = sealed, WITH_WIPERS.format(nut=group)
    band = _stated(values, "torque")
    return [
        _no_load_point(model, row, nut, at, band, name=name, group=group, with_model=False)
        for name, (nut, group) in nuts.items()
    ]


def _unknown_nut(kind: str, known: Mapping[str, Any]) -> Fault:
    return Fault("row.nut", "unknown kind of preloaded nut", kind, f"write {either(known)}")


def part_of_a_whole(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Torque without load of a screw that could be in an axis, against that of the whole axis, which it is a part of.

    Beside it the growth of both from the slowest speed, one over the other. No point of a nut that the model cannot
    compute.
    """
    row, at = screw_of(values), conditions.of(values)
    kind, whole = str(values["nut"]), float(values["whole_torque"])
    if kind not in _BRACED:
        raise InputError(_unknown_nut(kind, _BRACED))
    nut = _BRACED[kind](preload=float(values["preload"]))
    if not model.knows(nut):
        return []
    speed = float(at.screw_speed)
    name = f"{row.name}, {speed / RPM:.0f} rpm"
    band = Band(whole, 0.0, whole)
    point = _no_load_point(model, row, nut, at, band, name=name, group=row.name, with_model=False, speed=speed)
    slow = dataclasses.replace(at, screw_speed=float(values["slow_speed"]))
    growth = point.value / float(_torque_without_load(model, row.screw(nut=nut), slow))
    return [
        dataclasses.replace(point, laws={}, definitions={"growth": growth / (whole / float(values["slow_torque"]))})
    ]


def chart_friction(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Friction coefficient of the thread at a tenth of the rating, against the lines of vendors' charts."""
    row, at = screw_of(values), conditions.of(values)
    load = CHART_LOAD * float(values["dynamic_load_rating"])
    result = model(row.screw(), at.lubricant, axial_load=load, screw_speed=at.screw_speed)
    low, middle, high = CHART_LINES
    subject = Subject(row.nominal_diameter, row.ball_circle, row.lead, axial_load=load)
    etas = {name: RULES[name].estimate(subject).efficiency(subject.ideal_torque) for name in LOADED_RULES}
    film = float(np.min([np.min(pair.screw.film_parameter) for pair in result.pairs]))
    return [
        Point(
            name=row.name,
            value=float(result.friction_coefficient),
            band=Band(middle, low, high),
            descriptors={**_descriptors(row), "film_parameter": film},
            laws={
                name: float(transmission.friction_coefficient(row.lead_angle, eta)) / middle
                for name, eta in etas.items()
            },
            warnings=result.warning_records,
        )
    ]


# -- ratings and rigidity -------------------------------------------------------------------------


def ratings(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Dynamic load rating by geometry, the static one beside it, and both with one ball less a turn."""
    row = screw_of(values)
    result, z = ratings_of(row), row.balls_per_turn
    dynamic, static = float(values["dynamic_load_rating"]), float(values["static_load_rating"])
    fewer = (z - 1) / z
    return [
        Point(
            name=row.name,
            value=result.dynamic,
            band=Band(dynamic),
            descriptors=_descriptors(row),
            definitions={
                "static": result.static / static,
                "one_ball_less": result.dynamic * fewer ** (2 / 3) / dynamic,
                "static_one_ball_less": result.static * fewer / static,
            },
        )
    ]


def rigidity_by_catalogue(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Load over displacement of a rigid nut without preload at 30 % of its rating, and other definitions."""
    row = screw_of(values)
    screw, rated, listed = row.screw(), float(values["dynamic_load_rating"]), float(values["rigidity"])
    load, preload = RIGIDITY_LOAD * rated, USUAL_PRELOAD * rated
    single = ball_loads(screw, SingleNut(), load)
    definitions = {
        "tangent_at_30": float(single.rigidity),
        "double_nut_at_10": _tangent(screw, preload, None),
        "double_nut_at_10_elastic": _tangent(screw, preload, Bodies.of(screw)),
    }
    return [
        Point(
            name=row.name,
            value=load / float(single.deflection),
            band=Band(listed),
            descriptors=_descriptors(row),
            definitions={name: value / listed for name, value in definitions.items()},
        )
    ]


#: Columns of THK's rows whose headings have no unit that a table knows: balls in mm, and rigidity in N/um.
INFERRED_BALL, LISTED_RIGIDITY = "ball_mm_inferred", "K_N_um"
#: The conformity that THK's ratings and rigidities follow from, by its catalogue's rows with grooves of known depth.
_CONFORMITY_OF_THK = 0.535
#: Balls from this size on: their ratings and rigidities are those of closer grooves.
_LARGE_BALL = 9.5e-3
#: Families whose turns or hardness are not those of the others: rolled ones, deflectors, balls in a cage.
_OTHER_MAKES = re.compile("rolled|^(DI|DK|MDK|JPF|SB|HBN|MTF|BTK|WTF|CNF)")
#: Families of two halves or two nuts that brace each other; THK prints half of their rigidity for the one nut alone.
_BRACED_FAMILIES = ("BNFN", "BIF", "BLW")


def _of_thk(values: Values) -> CatalogueRow | None:
    """The row of a line of THK's tables: all listed turns carry; None without a ball, and of other makes of nuts."""
    if _OTHER_MAKES.search(values["family"]) or not (values.get(INFERRED_BALL) or values.get("ball_diameter")):
        return None
    ball = values.get("ball_diameter") or 1e-3 * values[INFERRED_BALL]
    turns = values["turns"] * (values.get("rows") or 1)
    row = screw_of({**values, "ball_diameter": ball, "turns": turns})
    return dataclasses.replace(
        row,
        turns_without_load=0.0,
        rating_conformity=_CONFORMITY_OF_THK,
        conformity=_CONFORMITY_OF_THK,
        family=values["family"] + (", balls of 9.5 mm and more" if ball > _LARGE_BALL else ""),
    )


def ratings_of_thk(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Dynamic load rating of a row of THK by geometry, the static one beside it."""
    if (row := _of_thk(values)) is None:
        return []
    computed, static = ratings_of(row), float(values["static_load_rating"])
    return [
        Point(
            name=row.name,
            value=computed.dynamic,
            band=Band(float(values["dynamic_load_rating"])),
            descriptors=_descriptors(row),
            definitions={"static": computed.static / static},
            group=row.family,
        )
    ]


def rigidity_of_thk(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Secant 2 F/delta of braced nuts at a tenth of the rating, of one nut F/delta; that at 0.3 C_a beside it."""
    if not values.get(LISTED_RIGIDITY) or (row := _of_thk(values)) is None:
        return []
    screw, listed = row.screw(), 1e6 * values[LISTED_RIGIDITY]
    halves = 2 if values["family"] in _BRACED_FAMILIES else 1

    def secant(share: float) -> float:
        load = share * float(values["dynamic_load_rating"])
        return halves * load / float(ball_loads(screw, SingleNut(), load).deflection)

    return [
        Point(
            name=row.name,
            value=secant(USUAL_PRELOAD),
            band=Band(listed),
            descriptors=_descriptors(row),
            definitions={"at_30": secant(RIGIDITY_LOAD) / listed},
            group=row.family,
        )
    ]


def rigidity_of_double_nuts(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """R_nu,ar of a double nut by ISO 3408-4, and its other factors, its parts and the physical nut beside it."""
    row = screw_of(values)
    points: list[Point] = []
    for percent, column in ((7, "rigidity_7pct"), (10, "rigidity")):
        listed, preload = float(values[column]), _preloaded(values, percent)
        screw = row.screw(nut=DoubleNut(preload=preload))
        bodies = Bodies(nut_outer_diameter=row.nut_outer_diameter)
        result = rigidity_iso3408(
            screw,
            nominal_diameter=row.nominal_diameter,
            nut_outer_diameter=row.nut_outer_diameter,
            accuracy_factor=ACCURACY_FACTOR,
        )
        definitions = {
            "uncorrected": result.nut,
            **{f"factor_{factor:g}": factor * result.nut for factor in OTHER_FACTORS},
            "rigid_bodies": _tangent(screw, preload, None),
            "elastic_bodies": _tangent(screw, preload, bodies),
        }
        points.append(
            Point(
                name=f"{row.name} at {percent} %",
                value=float(result.nut_corrected),
                band=Band(listed),
                descriptors={**_descriptors(row), "preload_share": percent / 100},
                definitions={name: float(value) / listed for name, value in definitions.items()},
            )
        )
    return points


def _tangent(screw: BallScrew, preload: float, bodies: Bodies | None) -> float:
    return float(ball_loads(screw, DoubleNut(preload=preload), 0.0, bodies=bodies).rigidity)


# -- bearings of the shaft -------------------------------------------------------------------------


def support_bearing(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """Axial rigidity of a preloaded pair of 60° bearings, and its torque beside it, from the contacts of the screw.

    Balls, their number and the grooves are those that :class:`~ballscrew.axis.supports.bearing.SupportBearing` takes
    where none are given: catalogues print none.
    """
    at, preload = conditions.of(values), float(values["preload"])
    pair = SupportBearing(
        bore=float(values["bore"]),
        outside_diameter=float(values["outside"]),
        contact_angle=_OF_SUPPORT_BEARINGS,
        lubricant=at.lubricant,
        preload=preload,
        model=model,
    )
    result, slow = (pair(OperatingState(0.0, speed)) for speed in (at.screw_speed, _SLOW))
    torque = float(values["torque"])
    return [
        Point(
            name=f"{values['maker']} {values['bearing']}, {preload:g} N",
            value=float(pair.rigidity()),
            band=Band(float(values["rigidity"])),
            descriptors={"bore": float(pair.bore), "preload": preload},
            definitions={
                "torque": float(result.friction_effort) / torque,
                "torque_at_10_rpm": float(slow.friction_effort) / torque,
            },
            warnings=result.warning_records,
            group=str(values["maker"]),
        )
    ]


# -- balls between rings --------------------------------------------------------------------------

#: Pitch radius of the rings of Balan2015, by the sizes of a bearing 51205 (not printed there), and of their grooves.
RING_RADIUS = 0.018
GROOVE_RADIUS = 4.16e-3
_CONTACTS = 6


def ring_torque(model: FrictionModel, ball_diameter: float, load: float, viscosity: float, speed: float) -> Torque:
    """Torque of three balls between two grooved rings, Balan2015: T_z = 6 r F_R by the rolling law of the model.

    One ring turns, so the balls are entrained at half of its speed. Nothing but rolling: the rest is small there.
    """
    oil, R_x, v = Lubricant(viscosity=viscosity), ball_diameter / 2, speed * RING_RADIUS / 2
    E = hertz.equivalent_modulus(STEEL.young_modulus, STEEL.poisson_ratio, STEEL.young_modulus, STEEL.poisson_ratio)
    R_y = 1 / (1 / R_x - 1 / GROOVE_RADIUS)
    shape = model.hertz(R_y / R_x)
    W = rheology.load_parameter(load, E, R_x)
    conditions = ContactConditions(
        contact_load=load,
        equivalent_modulus=E,
        rolling_radius=R_x,
        transverse_radius=R_y,
        radii_ratio=R_y / R_x,
        deformed_radius=geometry.deformed_radius(ball_diameter, GROOVE_RADIUS / ball_diameter),
        hertz=shape,
        material_parameter=rheology.material_parameter(E, oil.pressure_viscosity_coefficient),
        speed_parameter=rheology.speed_parameter(viscosity, v, E, R_x),
        load_parameter=W,
        semi_major_axis=hertz.semi_axis(shape.major, R_x, W),
        combined_roughness=math.hypot(0.06e-6, 0.03e-6),
        motion=Motion(v, 0.0, 0.0),
        lubricant=oil,
        ball_diameter=ball_diameter,
        ball_roughness=0.06e-6,
        race_roughness=0.03e-6,
    )
    return _CONTACTS * RING_RADIUS * model.rolling(conditions)


def rings(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
    """The fit of the measured torque at the speed that the rings start with."""
    d_w, Q, rpm = (float(values[name]) for name in ("ball_diameter", "contact_load", "speed"))
    fit = float(values["K"]) * rpm ** float(values["n"])
    name = f"{1000 * d_w:g} mm at {rpm * 30 / math.pi:.0f} rpm"
    return [
        Point(
            name=name,
            value=float(ring_torque(model, d_w, Q, float(values["viscosity"]), rpm)),
            band=Band(fit),
            descriptors={"ball": d_w, "speed": rpm},
        )
    ]
