"""The declared sets of data: the columns of their rows, and the evaluation of a model for each."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.basis.quantities import Info, Quantity
from ballscrew.evidence.validation import rows
from ballscrew.evidence.validation.entries import Conditions, ValidationSet


def _positive(name: str, unit: str, words: str, shown_in: str = "") -> Quantity:
    return Quantity(name, unit, Info(name, words, shown_in, above=0, hint="give a positive value"))


def _quantities(*quantities: Quantity) -> dict[str, Quantity]:
    return {quantity.name: quantity for quantity in quantities}


_RIGIDITY = Quantity("rigidity", "N/m", Info("R", "rigidity", "N/um"))


def _torque(shown_in: str) -> Quantity:
    return Quantity("torque", "N m", Info("T", "torque", shown_in))


def _band_columns(name: str, words: str, shown_in: str = "N m") -> dict[str, Quantity]:
    return _quantities(*(_positive(f"{name}_{end}", "N m", f"{words}, {end}imum", shown_in) for end in ("min", "max")))


_REXROTH = "Bosch Rexroth R310RU 3301 (2006.02)"
_HIWIN = "HIWIN S99TE20-1610"
_THK = "THK General Catalog"
_OF_DOUBLE_NUTS = {
    **_band_columns("no_load_torque_7pct", "no-load torque at a preload of 7 %"),
    **_band_columns("no_load_torque_10pct", "no-load torque at a preload of 10 %"),
    **_quantities(_positive("rigidity_7pct", "N/m", "rigidity at a preload of 7 %", "N/um")),
}
_OF_SINGLE_NUTS = {
    **_quantities(_positive("no_load_torque_2pct_max", "N m", "no-load torque at a preload of 2 %, maximum")),
    **_band_columns("no_load_torque_5pct", "no-load torque at a preload of 5 %"),
}
_OF_THE_EXAMPLE = {
    **_quantities(_positive("preload", "N", "preload"), _positive("drag_torque", "N m", "drag torque", "N mm")),
    **_band_columns("drag_torque", "drag torque", "N mm"),
}
_OF_RINGS = _quantities(
    _positive("ball_diameter", "m", "ball diameter", "mm"),
    _positive("contact_load", "N", "load of a ball"),
    _positive("viscosity", "Pa s", "dynamic viscosity", "mPa s"),
    _positive("speed", "rad/s", "speed that the rings start with", "rpm"),
    _positive("K", "N m", "torque of the fit at 1 rad/s"),
    Quantity("n", "1", Info("n", "exponent of the speed")),
)

_OF_PLAUSIBLE_SCREWS = {
    **_quantities(_positive("preload", "N", "preload")),
    **_band_columns("torque", "torque without load of the screws measured"),
}
_OF_WIPERS = _quantities(_positive("seal_torque", "N m", "torque of two wipers that could be on the nut"))
_OF_WHOLES = _quantities(
    _positive("preload", "N", "preload"),
    _positive("whole_torque", "N m", "torque of the whole axis"),
    _positive("slow_speed", "rad/s", "slowest speed of the axis", "rpm"),
    _positive("slow_torque", "N m", "torque of the whole axis at its slowest speed"),
)
_DRAG_LOW, _DRAG_HIGH = (
    Quantity(f"drag_{end}", "N m", Info("T", f"drag torque, {end} end of its range", at_least=0, hint="of a nut"))
    for end in ("low", "high")
)
_OF_STOCK = _quantities(_DRAG_LOW, _DRAG_HIGH)
_OF_THK: dict[str, Quantity | None] = {
    "family": None,
    **_quantities(
        Quantity("rows", "1", Info("i", "circuits of a nut body")),
        Quantity("turns", "1", Info("i", "turns of a circuit", at_least=0, hint="nuts have 1 to 4")),
        _positive("ball_diameter", "m", "ball diameter", "mm"),
        Quantity(rows.INFERRED_BALL, "1", Info("D_w", "ball diameter in mm, which is not printed")),
        Quantity(rows.LISTED_RIGIDITY, "1", Info("K", "rigidity in N/um")),
    ),
}
_ALIASES_OF_THK = {"pitch_circle_diameter": ("ball_pcd",)}
_OF_SUPPORT_BEARINGS: dict[str, Quantity | None] = {
    "maker": None,
    "bearing": None,
    "preload_class": None,
    **_quantities(
        _positive("bore", "m", "bore", "mm"),
        _positive("outside", "m", "outside diameter", "mm"),
        _positive("preload", "N", "preload of the pair"),
        _positive("rigidity", "N/m", "axial rigidity of the pair", "N/um"),
        _positive("torque", "N m", "torque of the pair"),
    ),
}

#: Choices of the model that were made with Rexroth's no-load torques in sight.
_CHOSEN_ON_REXROTH = (
    "law of running in and its film parameter, by the trend over the diameter",
    "order of the force between balls, estimated with the tables known",
)

SETS: Mapping[str, ValidationSet] = {
    each.name: each
    for each in (
        ValidationSet(
            name="rexroth-double-nut",
            title="no-load torque of double nuts",
            details="two contacts a ball, preloads of 7 and 10 %",
            reference="against the vendor's band",
            maker="Rexroth",
            source=_REXROTH,
            file="rexroth-double-nut.csv",
            quantity=_torque("N m"),
            columns=_OF_DOUBLE_NUTS,
            required=("dynamic_load_rating", *(name for name in _OF_DOUBLE_NUTS if name != "rigidity_7pct")),
            evaluate=rows.double_nut,
            axes=("size", "steepness"),
            used_for=_CHOSEN_ON_REXROTH,
            rules_behind=("rexroth",),
            calibratable=True,
            conditioned=True,
        ),
        ValidationSet(
            name="rexroth-single-nut",
            title="no-load torque of single nuts",
            details="oversize balls with four contacts, preload of 5 %",
            reference="against the vendor's band; at 2 % against the vendor's maximum, apart",
            maker="Rexroth",
            source=_REXROTH,
            file="rexroth-single-nut.csv",
            quantity=_torque("N m"),
            columns=_OF_SINGLE_NUTS,
            required=("dynamic_load_rating", "no_load_torque_5pct_min", "no_load_torque_5pct_max"),
            evaluate=rows.single_nut,
            axes=("size", "steepness"),
            used_for=_CHOSEN_ON_REXROTH,
            rules_behind=("rexroth",),
            calibratable=True,
            conditioned=True,
            four_contacts=True,
        ),
        ValidationSet(
            name="hiwin-stock",
            title="drag torque of stocked nuts",
            details="preload not printed, medium: 7 % of the rating, and 6 and 8 % beside it",
            reference="against the range stated",
            maker="HIWIN",
            source=_HIWIN,
            file="hiwin-stock.csv",
            quantity=_torque("N m"),
            columns=_OF_STOCK,
            aliases={"name": ("code",)},
            required=("nut", "dynamic_load_rating", *_OF_STOCK),
            evaluate=rows.stock_nut,
            axes=("size", "lead"),
            calibratable=True,
            conditioned=True,
            conditions=Conditions(grade="ISO VG 68"),
        ),
        ValidationSet(
            name="thk-stock",
            title="drag torque of small stocked nuts, with and without spacer balls",
            details="preload not printed, medium: 7 % of the rating, and 5, 6 and 8 % beside it",
            reference="against the greatest drag stated, which it must stay below: its least is a fifth of that",
            maker="THK",
            source=_THK,
            file="thk-stock.csv",
            quantity=_torque("N m"),
            columns=_OF_STOCK,
            aliases={"name": ("code",)},
            required=("nut", "dynamic_load_rating", *_OF_STOCK),
            evaluate=rows.stock_bound,
            axes=("size", "lead"),
            calibratable=True,
            conditioned=True,
            bound=True,
        ),
        ValidationSet(
            name="thk-jis",
            title="preload drag of a double nut",
            reference="against a worked example by JIS B 1192 and its tolerance",
            maker="THK",
            source="THK catalogue",
            file="thk-jis.csv",
            quantity=_torque("N mm"),
            columns=_OF_THE_EXAMPLE,
            required=tuple(_OF_THE_EXAMPLE),
            evaluate=rows.worked_example,
            axes=("size", "steepness"),
            rules_behind=("jis",),
            calibratable=True,
            conditioned=True,
        ),
        ValidationSet(
            name="xjtu",
            title="torque without load of two new screws of one kind, measured",
            details="size, nut, wipers and oil are not stated: each row could be the screw",
            reference="against the two torques",
            maker="XJTU",
            source="XJTU degradation dataset",
            file="xjtu.csv",
            quantity=_torque("N m"),
            columns={**_OF_PLAUSIBLE_SCREWS, **_OF_WIPERS},
            required=("nut", *_OF_PLAUSIBLE_SCREWS),
            evaluate=rows.plausible_screw,
            axes=("size", "steepness"),
            calibratable=True,
            conditioned=True,
            alternatives=True,
        ),
        ValidationSet(
            name="emps",
            title="torque without load of a screw that could be in an axis, over the speed",
            details="size, nut, preload and oil are not stated: each row could be the screw",
            reference="against the whole, which it must stay below; the growth of both with speed beside it",
            maker="EMPS",
            source="EMPS benchmark, Janot, Gautier, Brunot 2019",
            file="emps.csv",
            quantity=_torque("N m"),
            columns=_OF_WHOLES,
            required=("nut", *_OF_WHOLES),
            evaluate=rows.part_of_a_whole,
            axes=("speed", "film_parameter"),
            calibratable=True,
            conditioned=True,
            alternatives=True,
            bound=True,
        ),
        ValidationSet(
            name="thk-kr4620a",
            title="torque without load of the screw of an actuator, over the speed with four lubricants",
            details="preload and temperature are not stated",
            reference="against the whole, which it must stay below; the growth of both with speed beside it",
            maker="THK",
            source="THK, actuators KR",
            file="thk-kr4620a.csv",
            quantity=_torque("N m"),
            columns=_OF_WHOLES,
            required=("nut", *_OF_WHOLES),
            evaluate=rows.part_of_a_whole,
            axes=("speed", "film_parameter"),
            calibratable=True,
            conditioned=True,
            alternatives=True,
            bound=True,
        ),
        ValidationSet(
            name="chart-friction",
            title="friction coefficient of the thread by the efficiency",
            details="a tenth of the dynamic load rating",
            reference="against the lines 0.003, 0.005 and 0.01 of two vendors' charts, which state no load",
            maker="THK, HIWIN",
            source="THK A-664, HIWIN BS-08-2-EN-1704-K",
            file="hiwin.csv",
            quantity=Quantity("friction_coefficient", "1", Info(r"\mu", "friction coefficient of the thread")),
            columns={},
            required=("dynamic_load_rating",),
            evaluate=rows.chart_friction,
            axes=("size", "steepness"),
            calibratable=True,
            conditioned=True,
            loaded=True,
        ),
        ValidationSet(
            name="balan-2015",
            title="torque of three balls between grooved rings",
            reference="against a fit of measurements, at the start of a run",
            maker="Balan2015",
            source="Lubricants 2015 3:222-243",
            file="balan-2015.csv",
            quantity=_torque("uN m"),
            columns=_OF_RINGS,
            required=tuple(_OF_RINGS),
            evaluate=rows.rings,
            axes=("speed", "ball"),
            of_screws=False,
        ),
        ValidationSet(
            name="hiwin-ratings",
            title="dynamic load rating by geometry",
            reference="against the catalogue; the static one beside it",
            maker="HIWIN",
            source=_HIWIN,
            file="hiwin.csv",
            quantity=Quantity("rating", "N", Info("C_a", "dynamic load rating", "kN")),
            columns={},
            required=("dynamic_load_rating", "static_load_rating"),
            evaluate=rows.ratings,
            axes=("size", "steepness"),
            ratio_names={"static": "static_ratio"},
            used_for=("turns without load and conformity of rows of catalogues",),
        ),
        ValidationSet(
            name="hiwin-stiffness",
            title="load over displacement of a rigid nut without preload at 30 % of its rating",
            reference="against the catalogue, whose definition is assumed",
            maker="HIWIN",
            source=_HIWIN,
            file="hiwin.csv",
            quantity=_RIGIDITY,
            columns={},
            required=("dynamic_load_rating", "rigidity"),
            evaluate=rows.rigidity_by_catalogue,
            axes=("size", "steepness"),
        ),
        ValidationSet(
            name="rexroth-rigidity",
            title="rigidity R_nu,ar of double nuts by ISO 3408-4",
            details=f"factor for accuracy {rows.ACCURACY_FACTOR:g}, preloads of 7 and 10 %",
            reference="against the catalogue",
            maker="Rexroth",
            source=_REXROTH,
            file="rexroth-double-nut.csv",
            quantity=_RIGIDITY,
            columns=_OF_DOUBLE_NUTS,
            required=("dynamic_load_rating", "rigidity_7pct", "rigidity"),
            evaluate=rows.rigidity_of_double_nuts,
            axes=("size", "steepness"),
            used_for=("factor for accuracy, one of the three of ISO 3408-4 by the mean of these rows",),
        ),
        ValidationSet(
            name="thk-ratings",
            title="dynamic load rating by geometry",
            details="conformity 0.535, all turns listed carry, the ball is inferred; without rolled, caged and "
            "deflector nuts",
            reference="against the catalogue; the static one beside it",
            maker="THK",
            source=_THK,
            file="thk.csv",
            quantity=Quantity("rating", "N", Info("C_a", "dynamic load rating", "kN")),
            columns=_OF_THK,
            aliases=_ALIASES_OF_THK,
            required=("family", "turns", "dynamic_load_rating", "static_load_rating"),
            evaluate=rows.ratings_of_thk,
            axes=("size", "lead"),
            ratio_names={"static": "static_ratio"},
            used_for=("ball of each groove",),
        ),
        ValidationSet(
            name="thk-rigidity",
            title="rigidity K of nuts at a tenth of the dynamic load rating, rigid bodies",
            details="2 F/delta of braced nuts and F/delta of one: what is printed for one nut is half of that for two, "
            "though it is said to be at 0.3 C_a",
            reference="against the catalogue",
            maker="THK",
            source=_THK,
            file="thk.csv",
            quantity=_RIGIDITY,
            columns=_OF_THK,
            aliases=_ALIASES_OF_THK,
            required=("family", "turns", "dynamic_load_rating"),
            evaluate=rows.rigidity_of_thk,
            axes=("size", "lead"),
            ratio_names={"at_30": "ratio_at_30_percent"},
            used_for=("ball of each groove",),
        ),
        ValidationSet(
            name="support-bearings",
            title="axial rigidity of pairs of 60° bearings by the contacts of the screw",
            details="the torque beside it; balls and grooves assumed, nothing fitted",
            reference="against the catalogues, which state neither oil nor, one of them, speed",
            maker="NSK, IBC",
            source="NSK, TAC B; IBC, BS",
            file="support-bearings.csv",
            quantity=_RIGIDITY,
            columns=_OF_SUPPORT_BEARINGS,
            required=tuple(name for name in _OF_SUPPORT_BEARINGS if name != "preload_class"),
            evaluate=rows.support_bearing,
            axes=("bore", "preload"),
            of_screws=False,
            conditioned=True,
            conditions=Conditions(grade="ISO VG 68"),
            ratio_names={"": "rigidity_ratio", "torque": "torque_ratio"},
        ),
    )
}
