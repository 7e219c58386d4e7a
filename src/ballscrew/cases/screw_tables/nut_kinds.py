"""Nuts and what they lose, by the names that catalogues, case files and tables use."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.physics.components.nut import NUTS, Nut
from ballscrew.physics.laws import nut_losses
from ballscrew.physics.laws.nut_losses import ParasiticLaw
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.installation import Ends

#: What catalogues call them in words, besides "nut" and "flange". A single nut that is preloaded may be two of the
#: kinds: nothing is guessed.
_IN_WORDS: Mapping[str, str] = {
    "single": "single", "einzel": "single", "not preloaded": "single", "without preload": "single",
    "ohne vorspannung": "single",
    "double": "double", "doppel": "double", "preloaded double": "double", "double preloaded": "double",
    "vorgespannte doppel": "double",
    "oversize balls": "oversize-balls", "oversize ball": "oversize-balls", "oversized balls": "oversize-balls",
    "oversize": "oversize-balls", "oversized": "oversize-balls", "einzel kugelübermass": "oversize-balls",
    "kugelübermass": "oversize-balls", "übermasskugeln": "oversize-balls", "einzel übermasskugeln": "oversize-balls",
    "single oversize balls": "oversize-balls", "single oversized balls": "oversize-balls",
    "offset lead": "offset-lead", "lead offset": "offset-lead", "offset pitch": "offset-lead",
    "single offset lead": "offset-lead",
}  # fmt: skip
#: What a nut loses besides its balls, and the laws of each; the first is meant where none is named.
LOSSES: Mapping[str, Mapping[str, type[ParasiticLaw]]] = {
    "seals": {"known": nut_losses.Seals, "lips": nut_losses.LipSeals},
    "churning": {"spheres": nut_losses.Churning, "harris": nut_losses.HarrisChurning},
    "recirculation": {"force": nut_losses.Recirculation, "braking": nut_losses.ReturnBraking},
    "sheared_oil": {"gaps": nut_losses.ShearedOil},
    "spin_up": {"entries": nut_losses.SpinUp},
    "constant": {"known": nut_losses.ConstantTorque},
}
#: How the ends of a shaft are held.
ENDS: Mapping[str, Ends] = {ends.name.lower().replace("_", "-"): ends for ends in Ends}
#: What a catalogue lists of a screw besides its geometry, and a case may.
LISTED: Mapping[str, Quantity] = {
    name: fields_of(CatalogueRow)[name] for name in ("dynamic_load_rating", "static_load_rating", "root_diameter")
}
#: All fields of all nuts.
NUT_FIELDS: Mapping[str, Quantity] = {name: q for cls in NUTS.values() for name, q in fields_of(cls).items()}
PERCENT = Quantity("preload", "1", Info("p", "share of the dynamic load rating, %", at_least=0, at_most=100))


def kind_in(words: str) -> str:
    """The kind of nut that these words are: ``Preloaded double nut``, ``Doppelmutter``; as written if it is none."""
    plain = re.sub(r"[\s_-]+", " ", words.casefold())
    plain = " ".join(re.sub(r"\bflanged?\b|\bflansch|nuts?\b|muttern?\b|\bwith\b|\bmit\b", " ", plain).split())
    return _IN_WORDS.get(plain, words.lower().replace(" ", "-"))


def kind_of(nut: Nut) -> str:
    """Name of a kind of nut."""
    return next(name for name, cls in NUTS.items() if type(nut) is cls)
