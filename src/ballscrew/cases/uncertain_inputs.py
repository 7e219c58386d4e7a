"""What is uncertain of a case: what its file says, and for what is rarely known what is usual."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ballscrew.analyses.distributions import Distribution, Normal
from ballscrew.analyses.known_uncertainties import usual_uncertainties
from ballscrew.analyses.outputs import inputs_of
from ballscrew.calibrations import PARAMETERS, Calibration
from ballscrew.components.materials import TEMPERATURE, Lubricant
from ballscrew.components.screw import BallScrew
from ballscrew.faults import Fault, raise_if_any
from ballscrew.interfaces.distribution_text import Written, in_words, read
from ballscrew.model import FrictionModel
from ballscrew.quantities import Quantity

if TYPE_CHECKING:
    from ballscrew.analyses.sampling import JointNormal
    from ballscrew.interfaces.config import Case

#: The source of what stands in the case file.
GIVEN = "given"
#: Numbers that a file writes to twelve digits are the same within this.
_SAME = 1e-9


@dataclasses.dataclass(frozen=True)
class Uncertain:
    """An uncertain input: its distribution in SI, where that is from, and both in words."""

    distribution: Distribution
    #: A key of the bibliography, "judgement", "given" or the name of a calibration.
    source: str
    #: Whether the case file says so, and not this package.
    given: bool
    #: The distribution in the units people think in.
    words: str
    #: Why it is taken, where the package took it.
    reason: str = ""


def all_of(case: Case, only_given: bool = False) -> Mapping[str, Uncertain]:
    """The uncertain inputs of a case, named as sweeps name inputs: those given, then the usual ones of all others.

    ``only_given`` leaves the usual ones out. Of a case that a fit wrote they are left out for what the fit held.
    Numbers of a named calibration have its errors, one by one: that they are correlated :func:`joint_of` knows.
    """
    known = inputs_of(case.model, case.screw, case.lubricant)
    found = {
        name: Uncertain(distribution, GIVEN, True, in_words(distribution, known[name][1]))
        for name, distribution in case.uncertain.items()
    }
    if case.calibration is not None:
        found |= {name: u for name, u in _of_calibration(case.calibration, known).items() if name not in case.exact}
    if not only_given:
        usual = usual_uncertainties(case.model, case.screw, case.lubricant, given=found, exact=case.exact)
        # a fit holds for what it held: not for the temperature of the day, and not for what it could not tell
        open_after_fit = {TEMPERATURE.name, *case.fit.get("not_identified", ())}
        for name, (distribution, why) in usual.items():
            if case.fit and name not in open_after_fit:
                continue
            words = in_words(distribution, known[name][1])
            found[name] = Uncertain(distribution, why.source, False, words, why.reason)
    return found


def joint_of(case: Case, inputs: Mapping[str, Uncertain]) -> JointNormal | None:
    """The correlated errors that a fit or a named calibration left; None where there are none.

    Of a fit, numbers count that are still uncertain and still what it found. Raises
    :class:`~ballscrew.faults.InputError` for a table ``[calibration]`` that is not as a fit writes it.
    """
    import numpy as np

    # what samples is slow to load: only for those who sample
    from ballscrew.analyses.sampling import JointNormal

    if case.fit:
        from ballscrew.interfaces import fitted_case

        faults: list[Fault] = []
        found = fitted_case.joint_of(case.fit, inputs_of(case.model, case.screw, case.lubricant), faults)
        raise_if_any(faults)
    elif case.calibration is not None:
        mean = np.array([getattr(case.calibration, field) for field in PARAMETERS])
        found = JointNormal(tuple(PARAMETERS.values()), mean, np.array(case.calibration.covariance))
    else:
        found = None
    if found is None:
        return None
    kept = [
        i
        for i, name in enumerate(found.names)
        if name in inputs and math.isclose(found.mean[i], _central(inputs[name].distribution), rel_tol=_SAME)
    ]
    names = tuple(found.names[i] for i in kept)
    return JointNormal(names, found.mean[kept], found.covariance[np.ix_(kept, kept)]) if kept else None


def _central(distribution: Distribution) -> float:
    return distribution.mean if isinstance(distribution, Normal) else float(distribution.quantile(0.5))


def quantity_of(case: Case, name: str) -> Quantity:
    """What an uncertain input is."""
    return inputs_of(case.model, case.screw, case.lubricant)[name][1]


def _of_calibration(calibration: Calibration, known: Mapping[str, Any]) -> dict[str, Uncertain]:
    """The numbers of a calibration with their standard errors."""
    found: dict[str, Uncertain] = {}
    for (field, name), error in zip(PARAMETERS.items(), calibration.standard_errors, strict=True):
        distribution = Normal(getattr(calibration, field), error)
        reason = "as the fit left it"
        found[name] = Uncertain(distribution, calibration.name, True, in_words(distribution, known[name][1]), reason)
    return found


def written_in(
    tables: Mapping[str, Any], model: FrictionModel, screw: BallScrew, lubricant: Lubricant
) -> tuple[dict[str, Distribution], frozenset[str]]:
    """The distributions that the tables of a case file say, by input, and the inputs that they say are exact.

    The tables are those of a case without faults.
    """
    found: dict[str, Distribution] = {}
    exact: set[str] = set()
    for name, (section, quantity) in inputs_of(model, screw, lubricant).items():
        written = read(_at(tables, f"{section}.{name}"), quantity)
        assert not isinstance(written, Fault), written
        if isinstance(written, Written):
            if written.distribution is None:
                exact.add(name)
            else:
                found[name] = written.distribution
    return found, frozenset(exact)


def _at(tables: Mapping[str, Any], path: str) -> Any:
    """What stands at a path in nested tables; None where nothing does."""
    place: Any = tables
    for key in path.split("."):
        place = place.get(key) if isinstance(place, Mapping) else None
    return place
