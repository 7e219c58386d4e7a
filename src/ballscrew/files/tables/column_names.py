"""Names of the columns of vendors' tables, in English and German.

A name is enough by itself. A hint is a name of more than one thing ("load rating", "d"): it counts only beside a name.
Capitals, blanks, hyphens and subscripts do not count; "dia." and "Ø" stand for "diameter", "No." for "number". Of
CAPITALS they do: d1 is of the shaft, D1 of the nut.
"""

from __future__ import annotations

from collections.abc import Mapping

NAMES: Mapping[str, tuple[str, ...]] = {
    "name": (
        "model", "model no", "part number", "part no", "designation", "type", "size",
        "Bezeichnung", "Typ", "Materialnummer", "Teilenummer",
    ),
    "nominal_diameter": (
        "d0", "screw diameter", "shaft diameter", "screw shaft diameter", "screw shaft outer diameter",
        "shaft outer diameter", "Nenndurchmesser", "Nenn-Ø", "Spindeldurchmesser",
    ),
    "lead": ("Ph", "P", "Steigung", "Spindelsteigung"),
    "ball_diameter": ("Dw", "Da", "Db", "ball", "ball size", "balls", "Kugeldurchmesser", "Kugel-Ø"),
    "turns": (
        "i", "circuits", "number of turns", "number of circuits", "effective turns", "effective turns of balls",
        "loaded circuits", "number of loaded circuits", "loaded turns", "number of loaded turns",
        "rows x turns", "turns x rows", "turns x circuits", "circuits x turns",
        "Umläufe", "tragende Umläufe", "Anzahl Umläufe", "Anzahl tragender Umläufe", "Zahl der Umläufe",
        "Zahl der tragenden Umläufe", "Kugelumläufe",
    ),
    "starts": ("number of starts", "thread starts", "Gangzahl", "Anzahl Gänge"),
    "pitch_circle_diameter": (
        "Dpw", "dm", "dp", "ball circle", "ball circle diameter", "pitch circle", "PCD", "BCD",
        "ball centre-to-centre diameter", "ball center-to-center diameter",
        "Teilkreisdurchmesser", "Teilkreis-Ø", "Teilkreis", "Kugelmittenkreisdurchmesser",
    ),
    "root_diameter": (
        "dr", "d2", "dc", "root", "core diameter", "minor diameter", "thread minor diameter",
        "Kerndurchmesser", "Kern-Ø",
    ),
    "contact_angle": ("alpha", "α", "Kontaktwinkel", "Druckwinkel"),
    "conformity": ("f", "groove conformity", "Schmiegung"),
    "dynamic_load_rating": (
        "Ca", "C", "Cdyn", "dynamic", "dynamic load", "dynamic rating", "dynamic axial load rating",
        "basic dynamic load rating", "dyn. load rating",
        "dynamische Tragzahl", "dyn. Tragzahl", "Tragzahl dyn.", "Tragzahl dynamisch", "dynamische axiale Tragzahl",
    ),
    "static_load_rating": (
        "C0a", "C0", "Coa", "Co", "C0stat", "static", "static load", "static rating", "static axial load rating",
        "basic static load rating", "stat. load rating",
        "statische Tragzahl", "stat. Tragzahl", "Tragzahl stat.", "Tragzahl statisch", "statische axiale Tragzahl",
    ),
    "rigidity": (
        "stiffness", "Rnu", "K", "nut rigidity", "nut stiffness", "axial stiffness", "rigidity_10pct",
        "Steifigkeit", "Mutternsteifigkeit", "axiale Steifigkeit",
    ),
    "nut_outer_diameter": (
        "D1", "nut outer diameter", "nut outside diameter", "nut diameter", "outer diameter of the nut",
        "nut body diameter", "Mutternaußendurchmesser", "Mutteraußendurchmesser", "Außendurchmesser Mutter",
        "Mutterdurchmesser", "Mutterndurchmesser", "Mutter-Ø",
    ),
    "nut": ("nut type", "kind of nut", "Mutterart", "Muttertyp", "Mutter"),
    "preload": (
        "preload force", "axial preload", "Fpr", "Vorspannung", "Vorspannkraft", "axiale Vorspannung",
    ),
    "preload_share": ("preload share",),
    "seal_torque": (
        "seals", "seal", "torque of seals", "seal friction torque", "seal drag", "wipers", "wiper torque",
        "Dichtung", "Dichtungen", "Dichtungsmoment", "Dichtungsreibmoment", "Reibmoment der Dichtungen", "Abstreifer",
    ),
    "price_index": ("relative price", "Preisindex"),
    "speed_limit": (
        "DN", "DN value", "limit of DN", "characteristic speed", "DN-Wert", "Drehzahlkennwert",
    ),
    "make": ("maker", "manufacturer", "brand", "Hersteller", "Fabrikat"),
    "recirculation": ("return of balls", "ball return", "recirculation system", "Umlenkung", "Kugelrückführung"),
    "spacer_balls": ("spacers", "spacer ball", "Distanzkugeln", "Abstandskugeln", "Zwischenkugeln", "Trennkugeln"),
    "log": ("test log", "log file", "measurement", "Messung", "Messdatei", "Messprotokoll"),
    "source": ("Quelle",),
}  # fmt: skip
_RATING = ("load rating", "basic load rating", "axial load rating", "Tragzahl")
HINTS: Mapping[str, tuple[str, ...]] = {
    "nominal_diameter": ("d", "diameter", "Durchmesser"),
    "pitch_circle_diameter": ("diameter", "Durchmesser"),
    "root_diameter": ("diameter", "Durchmesser"),
    "ball_diameter": ("diameter", "Durchmesser"),
    "dynamic_load_rating": _RATING,
    "static_load_rating": _RATING,
}
#: Names that are others in small letters, as they are without blanks and underscores.
CAPITALS: Mapping[str, tuple[str, ...]] = {"nut_outer_diameter": ("D1",)}
#: Columns whose cells may be products: "2x2.5".
PRODUCTS = ("turns",)
#: Columns whose cells may be shares: "7 %", and the column of the share.
SHARES: Mapping[str, str] = {"preload": "preload_share"}
#: What the standard seals of a vendor are called, and none.
STANDARD, NONE = "standard", "none"
#: What stands for a ball diameter that the catalogue does not print.
ESTIMATED = "estimate"
#: What a column that says yes or no has.
YES, NO = "yes", "no"
#: Words in place of a number, or the only ones, in small letters.
WORDS: Mapping[str, Mapping[str, str]] = {
    "seal_torque": {
        STANDARD: STANDARD, **dict.fromkeys((NONE, "no", "without", "ohne", "keine", "nein"), NONE),
    },
    "ball_diameter": dict.fromkeys((ESTIMATED, "estimated", "?", "schätzen", "geschätzt"), ESTIMATED),
    "spacer_balls": {
        **dict.fromkeys((YES, "true", "with", "ja", "mit", "1:1"), YES),
        **dict.fromkeys((NO, "false", NONE, "without", "nein", "ohne", "keine"), NO),
    },
}  # fmt: skip
