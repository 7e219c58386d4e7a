"""Uncertain inputs of a case: those that its file gives, and defaults for those rarely known.

A table of surroundings gives its numbers distributions, too: ``ball_conductance = "4 ± 1 W/K"``.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ballscrew.axis.thermal.surroundings import PREFIX, VARIED, Surroundings
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.fields import NUT_SPEED, is_nut_speed, is_share, without_percent
from ballscrew.cases.screw_tables.nut_kinds import PERCENT
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.uncertainty.distributions import Distribution, Normal, scaled
from ballscrew.engine.uncertainty.uncertain_value import (
    UncertainValue,
    default_distributions,
    describe_distribution,
    parse_uncertain,
)
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.calibrations import Calibration
from ballscrew.physics.friction.model import FrictionModel

if TYPE_CHECKING:
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

#: The source of what stands in the case file.
GIVEN = "given"
#: The fault of ``--only-given`` where nothing is: a band of width zero would look like certainty.
NOTHING_GIVEN = Fault(
    "--only-given",
    "the case gives no input a distribution",
    remedy='write one, such as screw_conformity = "0.54 ± 0.01", or leave --only-given out',
)
#: Numbers that a file writes to twelve digits are the same within this.
_SAME = 1e-9


@dataclasses.dataclass(frozen=True)
class Uncertain:
    """An uncertain input: its distribution in SI, the source of that, and a description."""

    distribution: Distribution
    #: A key of the bibliography, "judgement", "given" or the name of a calibration.
    source: str
    #: Whether the case file gives it; otherwise it is a default of this package.
    given: bool
    #: The distribution in display units.
    description: str
    #: The reason of a default.
    reason: str = ""


def all_of(case: Case, only_given: bool = False) -> Mapping[str, Uncertain]:
    """The uncertain inputs of a case, named as in sweeps: those given, then the defaults of all others.

    ``only_given`` leaves the defaults out. A case that a fit wrote has none for the inputs that the fit held fixed.
    Parameters of a named calibration have its standard errors; :func:`joint_of` has their correlation.
    """
    known = inputs_of(case.model, case.screw, case.lubricant)
    uncertain = {
        name: Uncertain(distribution, GIVEN, True, describe_distribution(distribution, known[name][1]))
        for name, distribution in case.origins.uncertain.items()
    }
    if case.origins.calibration is not None:
        uncertain |= {
            name: u
            for name, u in _of_calibration(case.origins.calibration, known).items()
            if name not in case.origins.exact
        }
    if not only_given:
        usual = default_distributions(case.model, case.screw, case.lubricant, given=uncertain, exact=case.origins.exact)
        # a fit holds for what it held: not for the temperature of the day, and not for what it could not tell
        open_after_fit = {TEMPERATURE.name, *case.origins.fit.get("not_identified", ())}
        for name, (distribution, why) in usual.items():
            if case.origins.fit and name not in open_after_fit:
                continue
            description = describe_distribution(distribution, known[name][1])
            uncertain[name] = Uncertain(distribution, why.source, False, description, why.reason)
    return uncertain


def joint_of(case: Case, inputs: Mapping[str, Uncertain]) -> JointNormal | None:
    """The correlated errors that a fit or a named calibration left; None where there are none.

    Of a fit, numbers count that are still uncertain and still what it found. Raises
    :class:`~ballscrew.basis.errors.InputError` for a table ``[calibration]`` that is not as a fit writes it.
    """
    # loads xarray: only where inputs are sampled
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

    if case.origins.fit:
        joint = _joint_of_fit(case.origins.fit, inputs_of(case.model, case.screw, case.lubricant))
    elif case.origins.calibration is not None:
        parameters = case.origins.calibration.parameters
        mean = np.array([getattr(case.origins.calibration, field) for field in parameters])
        joint = JointNormal(tuple(parameters.values()), mean, np.array(case.origins.calibration.covariance))
    else:
        joint = None
    if joint is None:
        return None
    kept = [
        i
        for i, name in enumerate(joint.names)
        if name in inputs and math.isclose(joint.mean[i], _central(inputs[name].distribution), rel_tol=_SAME)
    ]
    names = tuple(joint.names[i] for i in kept)
    return JointNormal(names, joint.mean[kept], joint.covariance[np.ix_(kept, kept)]) if kept else None


def _joint_of_fit(table: Any, known: Mapping[str, Any]) -> JointNormal | None:
    """The correlated numbers of ``[calibration]``. Raises :class:`~ballscrew.basis.errors.InputError`."""
    # loads xarray: only where inputs are sampled
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

    try:
        names = tuple(table["numbers"])
        values, covariance = np.array(table["values"], dtype=float), np.array(table["covariance"], dtype=float)
        covariance = covariance.reshape(len(names), len(names))
        sound = values.shape == (len(names),) and np.isfinite(covariance).all() and np.isfinite(values).all()
        if not sound or np.any(np.linalg.eigvalsh(covariance) < -1e-9 * np.abs(covariance).max(initial=0.0)):
            raise ValueError
    except (TypeError, KeyError, ValueError):
        remedy = "leave the section as ballscrew fit wrote it, or leave it out"
        raise InputError(Fault("calibration", "is not as a fit writes it", "", remedy)) from None
    unknown = [name for name in names if name not in known]
    if unknown:
        remedy = "fit again, or leave the section out"
        raise InputError(Fault("calibration.numbers", "the case has no such number", ", ".join(unknown), remedy))
    return JointNormal(names, values, covariance) if names else None


def _central(distribution: Distribution) -> float:
    return distribution.mean if isinstance(distribution, Normal) else float(distribution.quantile(0.5))


def quantity_of(case: Case, name: str) -> Quantity:
    """The quantity of an uncertain input."""
    return inputs_of(case.model, case.screw, case.lubricant)[name][1]


def _of_calibration(calibration: Calibration, known: Mapping[str, Any]) -> dict[str, Uncertain]:
    """The parameters of a calibration with their standard errors."""
    uncertain: dict[str, Uncertain] = {}
    for (field, name), error in zip(calibration.parameters.items(), calibration.standard_errors, strict=True):
        distribution = Normal(getattr(calibration, field), error)
        reason = "as the fit left it"
        uncertain[name] = Uncertain(
            distribution, calibration.name, True, describe_distribution(distribution, known[name][1]), reason
        )
    return uncertain


def parse_distributions(
    tables: Mapping[str, Any], model: FrictionModel, screw: BallScrew, lubricant: Lubricant
) -> tuple[dict[str, Distribution], frozenset[str]]:
    """The distributions in the tables of a case file, by input, and the inputs that the tables give as exact.

    The tables must be those of a case without faults.
    """
    distributions: dict[str, Distribution] = {}
    exact: set[str] = set()
    for name, (section, quantity) in inputs_of(model, screw, lubricant).items():
        if name.startswith("nut."):
            continue  # another name of the same field
        written = _written(_at(tables, _path(section, name)), quantity, screw)
        assert not isinstance(written, Fault), written
        if isinstance(written, UncertainValue):
            if written.distribution is None:
                exact.add(name)
            else:
                distributions[name] = written.distribution
    return distributions, frozenset(exact)


def path_of(case: Case, name: str) -> str:
    """The field of an input in case files: ``screw_conformity`` is ``screw.screw_conformity``."""
    return _path(inputs_of(case.model, case.screw, case.lubricant)[name][0], name)


def _path(section: str, name: str) -> str:
    return name if name.startswith(("losses.", f"{section}.")) else f"{section}.{name}"


def _written(raw: Any, quantity: Quantity, screw: BallScrew) -> UncertainValue | Fault | None:
    """The uncertain value in a text.

    A share of the dynamic load rating becomes a force by the preload of the screw, a speed of the nut one of the screw
    by its lead.
    """
    if quantity.name == "screw_speed" and is_nut_speed(raw):
        written = parse_uncertain(raw, NUT_SPEED)
        if not isinstance(written, UncertainValue) or written.distribution is None:
            return written
        return dataclasses.replace(written, distribution=scaled(written.distribution, 2 * math.pi / screw.lead))
    if quantity.name != "preload" or not isinstance(raw, str) or not is_share(raw):
        return parse_uncertain(raw, quantity)
    written = parse_uncertain(without_percent(raw), PERCENT)
    if not isinstance(written, UncertainValue) or written.distribution is None:
        return written
    force = getattr(screw.nut, "preload", 0.0) / written.central
    return dataclasses.replace(written, distribution=scaled(written.distribution, force))


def _at(tables: Mapping[str, Any], path: str) -> Any:
    """The value at a path in nested tables; None where there is none."""
    place: Any = tables
    for key in path.split("."):
        place = place.get(key) if isinstance(place, Mapping) else None
    return place


def written_bands(table: Mapping[str, Any]) -> tuple[dict[str, Distribution], frozenset[str]]:
    """The distributions by name (``surroundings.ball_conductance``), and what is exact; of a table without faults."""
    distributions: dict[str, Distribution] = {}
    exact: set[str] = set()
    quantities = fields_of(Surroundings)
    for name in VARIED:
        written = parse_uncertain(table.get(name), quantities[name])
        assert not isinstance(written, Fault), written
        if written is None:
            continue
        if written.distribution is None:
            exact.add(PREFIX + name)
        else:
            distributions[PREFIX + name] = written.distribution
    return distributions, frozenset(exact)
