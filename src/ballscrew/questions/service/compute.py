"""The service of a nut: the preload left, from two logs, from one against the case, or from a torque without load."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import default_distributions
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.evidence.service.preload_change import PreloadChange, preload_change
from ballscrew.evidence.service.preload_estimate import PreloadEstimate
from ballscrew.evidence.service.preload_of_torque import preload_of_torque
from ballscrew.files.torque_logs import reading
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.service.options import ReadingOptions, ServiceOptions
from ballscrew.questions.shared.option_values import faults_named, flags_of

TORQUE: Quantity = quantities_of(FrictionResult)["screw_torque"]
_OF_PRELOAD = "so with the preload found; in a full bath the same torque asks for a smaller one"
#: Flags of the command line by the fields in which a service finds faults.
_FLAGS: Mapping[str, str] = {
    **flags_of("service", ServiceOptions, ReadingOptions),
    "service.screw_speed": "--speed",
    "lubricant.temperature": "--temperature",
}


@dataclasses.dataclass(frozen=True)
class Reading:
    """A torque without load, SI."""

    torque: float
    screw_speed: float
    #: Standard deviation of the torque.
    torque_deviation: float = 0.0
    temperature: float | None = None


@dataclasses.dataclass(frozen=True, eq=False)
class ServiceReport:
    """The answer of a service: a change of the preload, or the preload of a single reading."""

    change: PreloadChange | None = None
    preload: PreloadEstimate | None = None
    reading: Reading | None = None
    #: Warnings of the inputs of the case, and of a reading.
    of_case: Sequence[Record] = ()

    @property
    def warnings(self) -> list[Record]:
        """Warnings of the change, and of the inputs of the case."""
        return [*(() if self.change is None else self.change.warning_records), *self.of_case]

    @property
    def estimates(self) -> dict[str, PreloadEstimate]:
        """The preloads by the names they have in the document."""
        if self.change is not None:
            return {"new": self.change.new, "worn": self.change.worn}
        return {} if self.preload is None else {"preload": self.preload}


def of_logs(
    case: Case,
    paths: Sequence[Path],
    options: ServiceOptions,
    done: Callable[[int, int], None] | None = None,
) -> ServiceReport:
    """The change between the logs of two files, or from the case to that of one."""
    logs: list[TorqueLog | None] = [
        reading.read(
            path,
            options.columns,
            torque_constant=options.torque_constant,
            lead=float(case.screw.lead),
            keep_going=options.keep_going,
            done=done,
        )
        for path in paths
    ]
    if len(logs) == 1:
        logs.insert(0, None)
    new, worn = logs
    uncertain = distributions(case)
    with faults_named(_FLAGS):
        change = preload_change(
            case.model,
            case.screw,
            case.lubricant,
            new,
            worn,
            free=[PRELOAD, *(name for name in options.free if name not in (PRELOAD, "preload"))],
            distributions=uncertain,
            joint=joint_of(case, all_of(case)),
            tolerance=options.tolerance,
            kind=options.kind,
            inertia=options.inertia,
            dynamic_load_rating=case.listed.get("dynamic_load_rating"),
            done=done,
        )
    records = tuple(change.warning_records)
    return ServiceReport(dataclasses.replace(change, warning_records=records), of_case=case.implausible())


def of_torque(case: Case, measured: Reading) -> ServiceReport:
    """The preload of a torque without load."""
    with faults_named(_FLAGS):
        preload = preload_of_torque(
            case.model,
            case.screw,
            case.lubricant,
            torque=measured.torque,
            screw_speed=measured.screw_speed,
            temperature=measured.temperature,
            torque_deviation=measured.torque_deviation,
            distributions=distributions(case),
            joint=joint_of(case, all_of(case)),
        )
    return ServiceReport(
        preload=preload, reading=measured, of_case=[*_starved(case, preload, measured), *case.implausible()]
    )


def _starved(case: Case, preload_estimate: PreloadEstimate, measured: Reading) -> list[Record]:
    """That the nut with the preload found is starved of oil at the reading."""
    oil = case.lubricant if measured.temperature is None else case.lubricant.at(measured.temperature)
    subject = Configuration(case.model, case.screw, oil).changed({PRELOAD: preload_estimate.preload})
    points = {"axial_load": 0.0, "screw_speed": measured.screw_speed}
    return subject.starvation(points, _OF_PRELOAD)


def distributions(case: Case) -> dict[str, Distribution]:
    """The uncertain numbers of a case, the temperature left to the logs, and what a grade then leaves open instead."""
    values = {name: one.distribution for name, one in all_of(case).items() if name != TEMPERATURE.name}
    if not case.fit and case.lubricant.follows_temperature:
        exact = {*case.exact, TEMPERATURE.name}
        usual = default_distributions(case.model, case.screw, case.lubricant, given=values, exact=exact)
        values |= {name: distribution for name, (distribution, _) in usual.items()}
    return values
