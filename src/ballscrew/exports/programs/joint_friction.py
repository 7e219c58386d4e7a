"""Friction of a joint that knows no load: dry friction and a polynomial of the speed, fitted at one load."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export, Option, Values, WorstError, refusal, warning, worst_errors
from ballscrew.exports.programs import c99
from ballscrew.exports.subject import HandOver
from ballscrew.physics.components.materials import GRAVITY

LOAD = Quantity("load", "N", Info("F", "load of the fit", "kN", hint="4 kN", usual=(-1e7, 1e7)))
INERTIA = Quantity("inertia", "kg m^2", Info("J", "inertia of all that turns", "kg cm^2", at_least=0, usual=(0, 100)))
LOWEST_SPEED = Quantity(
    "lowest_speed", "rad/s", Info(r"\omega", "lowest speed of the fit", "rpm", above=0, usual=(0, 1e4))
)
MASS = Quantity("mass", "kg", Info("m", "mass that the screw moves", "kg", above=0, usual=(0, 1e5)))
INCLINATION = Quantity(
    "inclination",
    "rad",
    Info(r"\theta", "angle of positive motion above the horizontal", "deg", at_least=-math.pi / 2, at_most=math.pi / 2),
)
COUNTERFORCE = Quantity("counterforce", "N", Info("F_c", "force that balances a weight", "N", usual=(-1e6, 1e6)))

#: Choices of every target that has a joint.
JOINT_OPTIONS: Mapping[str, Option] = {
    "load": Option(math.nan, "axial load at which the joint is fitted", LOAD),
    "inertia": Option(0.0, "moment of inertia of motor, coupling and screw, at the screw", INERTIA),
    "mass": Option(math.nan, "mass that the screw moves; without it the mass whose weight is the load", MASS),
    "inclination": Option(math.pi / 2, "angle of positive motion above the horizontal", INCLINATION),
    "counterforce": Option(0.0, "force along positive motion that balances the weight", COUNTERFORCE),
    "lowest_speed": Option(5.0, "lowest speed of the fit; the highest is that of the range", LOWEST_SPEED),
}
#: Speeds of the fit in each direction, spread by ratios.
SPEEDS = 60
#: Speeds at which the error is measured in each direction: not those of the fit. Fewer, and fewer loads, where each
#: ball is solved by itself.
MEASURED, FEWER, FEWER_LOADS = 499, 49, 300
#: The damping is kept from driving up to so many times the highest speed.
BEYOND = 1e4
#: Loads of the table of errors, as shares of the load of the fit.
SHARES = (0.0, 0.5, 1.0, 1.5, 2.0)


@dataclasses.dataclass(frozen=True)
class JointFriction:
    r"""Friction on the shaft as a polynomial of its speed, whatever the load.

    .. math:: M = M_0 + c_1 |\omega| + c_2 \omega^2 + c_3 |\omega|^3

    The coefficients have the least possible largest relative error against the model at the load of the fit, in both
    directions, from the lowest to the highest speed. Neither the dry friction nor the damping ever drives.
    """

    #: Travel for a turn, m.
    lead: float
    #: Moment of inertia of all that turns, kg m².
    inertia: float
    #: Load of the fit, N.
    load: float
    #: Mass that was given, kg; not a number where none was.
    given_mass: float
    #: Angle of positive motion above the horizontal, rad.
    inclination: float
    #: Force along positive motion that balances the weight, N.
    counterforce: float
    #: Lowest and highest speed of the fit, rad/s.
    speeds: tuple[float, float]
    #: :math:`M_0, c_1, …`, in N m and powers of s.
    coefficients: tuple[float, ...]
    #: Friction of the model at rest under that load, N m.
    at_rest: float
    #: Share of the points of the fit at which the model holds.
    share_valid: float

    @property
    def arm(self) -> float:
        r"""Turn of the shaft for a travel, :math:`2\pi/P_h`, rad/m."""
        return 2 * math.pi / self.lead

    @property
    def dry(self) -> float:
        """Dry friction of the slide, N."""
        return self.coefficients[0] * self.arm

    @property
    def damping(self) -> tuple[float, ...]:
        """Damping of the slide by the powers of its speed: N s/m, N s²/m², N s³/m³."""
        return tuple(c * self.arm ** (power + 2) for power, c in enumerate(self.coefficients[1:]))

    @property
    def armature(self) -> float:
        r"""The inertia of what turns as a mass of the slide, :math:`J (2\pi/P_h)^2`, kg."""
        return self.inertia * self.arm**2

    @property
    def mass(self) -> float:
        """The mass that the screw moves, kg: as given, or that whose weight is the load of the fit, or 1 kg."""
        return (abs(self.load) / GRAVITY or 1.0) if math.isnan(self.given_mass) else self.given_mass

    @property
    def direction(self) -> tuple[float, float, float]:
        """The direction of positive motion; the third component is upwards."""
        return round(math.cos(self.inclination), 15) + 0.0, 0.0, round(math.sin(self.inclination), 15) + 0.0

    @property
    def direction_text(self) -> str:
        """The direction as the files have it: ``0 0 1`` upwards."""
        return " ".join(repr(int(x)) if x == int(x) else repr(x) for x in self.direction)

    @property
    def weight(self) -> float:
        """The force of the weight against positive motion, N, of which nothing is balanced yet."""
        return self.mass * GRAVITY * self.direction[2]

    @property
    def gravity_force(self) -> float:
        """The force against positive motion of the weight and what balances it, N."""
        return self.weight - self.counterforce

    def torque(self, speed: Any) -> NDArray[np.float64]:
        """Friction on the shaft at a speed of the shaft, N m."""
        return np.polynomial.polynomial.polyval(np.abs(speed), self.coefficients)

    def document(self) -> dict[str, Any]:
        """The axis and its joint, in SI."""
        return {
            "lead": self.lead,
            "gear": self.arm,
            "inertia": self.inertia,
            "mass": self.mass,
            "mass_is_of_load": math.isnan(self.given_mass),
            "inclination": self.inclination,
            "counterforce": self.counterforce,
            "gravity_force": self.gravity_force,
            "load": self.load,
            "speeds": list(self.speeds),
            "joint": {"friction": self.dry, "damping": list(self.damping), "armature": self.armature},
            "friction_of_the_model_at_rest": self.at_rest * self.arm,
        }

    def warnings(self, *, balances: bool) -> list[Record]:
        """A sentence where the mass is none of the case, and where a file does not have what balances the weight."""
        records = list[Record]()
        if math.isnan(self.given_mass):
            use = "whose weight is the load of the fit" if self.load else "of no meaning, as there is no load either"
            text = (
                "no mass is given ([axis] mass): the axis of the files is vertical and has "
                f"{units.in_unit(self.mass, 'kg')}, {use}"
            )
            records.append(warning("mass", "mass", text))
        if self.counterforce and not balances:
            force = units.in_unit(self.counterforce, "N")
            text = (
                f"a force of {force} along positive motion balances the weight, and the files have no place for "
                "it: add it in the simulation"
            )
            records.append(warning("counterforce", "counterforce", text))
        return records

    def at_points(self, points: Values) -> dict[str, NDArray[np.float64]]:
        """The friction of the joint at points of the model."""
        return {"screw_torque": self.torque(points[OPERATION[1]])}


def joint_friction(job: HandOver, degree: int) -> JointFriction:
    """The joint of a model, with damping up to a power of the speed.

    Raises :class:`~ballscrew.basis.errors.InputError` without a load, and where the model has no friction at it.
    """
    load, lowest = job.options["load"], job.options["lowest_speed"]
    highest = max(map(abs, job.working_range[OPERATION[1]]))
    if math.isnan(load):
        raise refusal("load", "missing", "", 'a joint is fitted at one load: give load="4 kN"')
    least, greatest = job.formula_range[OPERATION[0]]
    if not least <= load <= greatest:
        raise refusal("load", "is beyond the bounds of the model", units.shown(load, LOAD))
    if not job.options["inertia"] >= 0:
        raise refusal("inertia", "must be 0 or more", str(job.options["inertia"]), "in kg m^2")
    raise_if_any(_faults_of_axis(job))
    if not 0 < lowest < highest:
        shown = units.shown(lowest, LOWEST_SPEED)
        raise refusal("lowest_speed", "must be above 0 and below the highest speed of the range", shown)
    both = _both_ways(job, np.geomspace(lowest, highest, SPEEDS))
    loads, speeds = np.append(np.full(both.size, load), load), np.append(both, 0)
    outputs = job.evaluate({OPERATION[0]: loads, OPERATION[1]: speeds})
    torque = outputs["screw_torque"]
    if not np.all(torque > 0):
        shown = units.shown(load, LOAD)
        raise refusal("load", "the model has no friction at this load", shown, "take another load")
    fitted = least_largest_error(np.abs(both) / highest, torque[:-1], degree)
    coefficients = tuple(float(c) / highest**power for power, c in enumerate(fitted))
    return JointFriction(
        lead=job.subject.screw.lead,
        inertia=job.options["inertia"],
        load=load,
        given_mass=job.options["mass"],
        inclination=job.options["inclination"],
        counterforce=job.options["counterforce"],
        speeds=(lowest, highest),
        coefficients=coefficients,
        at_rest=float(torque[-1]),
        share_valid=float(np.mean(outputs["valid"])),
    )


def _faults_of_axis(job: HandOver) -> list[Fault]:
    """Faults of a mass that is none, and of an angle beyond the vertical."""
    mass, angle, faults = job.options["mass"], job.options["inclination"], list[Fault]()
    if mass <= 0:
        faults.append(
            Fault("hand_over.mass", "must be above 0", units.shown(mass, MASS), "leave it out, or give it in kg")
        )
    if abs(angle) > math.pi / 2:
        remedy = "90 deg for a vertical axis, 0 deg for a horizontal one"
        faults.append(Fault("hand_over.inclination", "is beyond the vertical", units.shown(angle, INCLINATION), remedy))
    return faults


def least_largest_error(speed: NDArray[np.float64], torque: NDArray[np.float64], degree: int) -> NDArray[np.float64]:
    r"""Coefficients of the polynomial with the least largest relative error, by linear programming.

    Of the coefficients and the error :math:`\epsilon`, :math:`|p(x_i)/M_i - 1| \le \epsilon` at all points and
    :math:`p(x) \ge p(0) \ge 0` from rest to beyond the highest speed.
    """
    relative = np.vander(speed, degree + 1, increasing=True) / torque[:, None]
    ones = np.ones((speed.size, 1))
    far = np.append(np.linspace(0, 4, 201), np.geomspace(4, BEYOND, 60))
    beyond = np.vander(far, degree, increasing=True)
    pushes = np.hstack([np.zeros((len(beyond), 1)), -beyond, np.zeros((len(beyond), 1))])
    solved = linprog(
        np.append(np.zeros(degree + 1), 1.0),
        A_ub=np.vstack([np.hstack([relative, -ones]), np.hstack([-relative, -ones]), pushes]),
        b_ub=np.concatenate([ones[:, 0], -ones[:, 0], np.zeros(len(beyond))]),
        bounds=[(0, None), *[(None, None)] * (degree - 1), (0, None), (0, None)],
    )
    coefficients = solved.x[:-1]
    if degree == 3:  # between the points of the constraint: a x + b x² + c x³ rises from rest if b² <= 4 a c
        coefficients[2] = max(coefficients[2], -2 * math.sqrt(max(coefficients[1], 0.0) * coefficients[3]))
    return coefficients


def joint_range(job: HandOver) -> dict[str, tuple[float, float]]:
    """The range of a joint: its loads and speeds, and all else as in the case."""
    at_case = {entry.name: (entry.value, entry.value) for entry in job.inputs}
    return {**at_case, **{name: job.working_range[name] for name in OPERATION}}


def _both_ways(job: HandOver, speeds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Speeds in each direction that the range has."""
    least, greatest = job.working_range[OPERATION[1]]
    both = np.concatenate([speeds, -speeds])
    return both[(least <= both) & (both <= greatest)]


class JointErrors(NamedTuple):
    """The errors of a joint against the model."""

    #: At the load of the fit, over its speeds.
    at_load: WorstError
    #: Over the loads and speeds of the working range, rest among them.
    over_loads: WorstError
    #: At each of :data:`SHARES` of the load of the fit, over its speeds.
    by_load: tuple[WorstError, ...]
    #: At the load of the fit and at rest; None where the range has no rest.
    at_rest: WorstError | None

    def document(self) -> dict[str, Any]:
        """The errors as they stand in JSON."""
        by_load = [entry.document() for entry in self.by_load]
        rest = None if self.at_rest is None else self.at_rest.document()
        over_loads = self.over_loads.document()
        return {"joint_errors": by_load, "joint_error_over_loads": over_loads, "joint_error_at_rest": rest}

    @property
    def of_export(self) -> tuple[WorstError, ...]:
        """The errors as an export has them, with names of their own."""
        of_fit = dataclasses.replace(self.at_load, output="screw_torque_at_load_and_speeds_of_fit")
        rest = () if self.at_rest is None else (dataclasses.replace(self.at_rest, output="screw_torque_at_rest"),)
        return self.over_loads, of_fit, *rest

    @property
    def text(self) -> str:
        """The errors in words."""
        load, half, twice = (units.shown(entry.at[OPERATION[0]], LOAD) for entry in (self.at_load, *self.by_load[1::3]))
        near = max(entry.relative for entry in self.by_load[1:])
        around = f", {_percent(near)} % from {half} to {twice}" if half != twice else ""
        at_load = units.shown(self.over_loads.at[OPERATION[0]], LOAD)
        at_speed = units.shown(self.over_loads.at[OPERATION[1]], LOWEST_SPEED)
        text = (
            "The friction of the joint knows no load: over the speeds of the fit it is at most "
            f"{_percent(self.at_load.relative)} % off the model at {load}{around}, and over its whole range "
            f"{units.in_unit(self.over_loads.value, 'N m', 2)} off at {at_load} and {at_speed}"
        )
        if self.at_rest is None:
            return text
        return f"{text}; at rest it is {_percent(self.at_rest.relative)} % off at {load}"

    def warnings(self, joint: JointFriction) -> list[Record]:
        """The errors as a warning, and one where the model itself does not hold at all speeds of the fit."""
        text = f"{self.text}; beyond its range, and below the lowest speed of the fit, it goes on as fitted"
        error = self.over_loads
        records = [warning("no_load", "screw_torque", text, value=error.value, unit=error.unit)]
        if joint.share_valid < 1:
            percent = units.fixed(100 * joint.share_valid)
            text = (
                f"at {units.shown(joint.load, LOAD)} the model itself holds at {percent} % of the speeds of the "
                "fit; ballscrew run says why"
            )
            records.append(warning("fit_validity", "screw_speed", text, value=joint.share_valid, limit=1.0))
        return records


def _percent(share: float) -> str:
    return units.to_significant(100 * share, 2) if share < 1 else units.fixed(100 * share)


def joint_errors(job: HandOver, joint: JointFriction) -> JointErrors:
    """The errors of a joint that knows no load, all else as in the case."""
    quick = job.is_recordable
    points = job.sample() if quick else job.sample(FEWER_LOADS)
    least, greatest = job.working_range[OPERATION[1]]
    still = _error(job, joint, np.array([joint.load]), np.zeros(1)) if least <= 0 <= greatest else None
    both = _both_ways(job, np.geomspace(*joint.speeds, MEASURED if quick else FEWER))
    by_load = tuple(_error(job, joint, np.full(both.size, share * joint.load), both) for share in SHARES)
    over_loads = _error(job, joint, *(points[name] for name in OPERATION[:2]))
    return JointErrors(by_load[SHARES.index(1.0)], over_loads, by_load, still)


def _error(job: HandOver, joint: JointFriction, load: NDArray[np.float64], speed: NDArray[np.float64]) -> WorstError:
    usual = {entry.name: np.full(speed.size, entry.value) for entry in job.inputs}
    points = {**usual, OPERATION[0]: load, OPERATION[1]: speed}
    return worst_errors(job, joint.at_points, points=points, outputs=["screw_torque"])[0]


def options_of_case(case: Case) -> dict[str, float]:
    """The choices that follow from a case: the load of its operating point, and what its axis moves.

    A counterweight moves, too; its weight, and a force that balances, is the counterforce.
    """
    options, axis = {"load": float(case.operation.axial_load)}, case.turning_axis
    if axis is None:
        return options
    options["inertia"] = float(axis.turning_inertia * axis.transmission_ratio**2)
    mass = float(axis.mass + axis.counterweight)
    if mass > 0:
        gravity = mass * GRAVITY * math.sin(axis.inclination)
        balanced = axis.counterweight or axis.counterforce
        counterforce = float(gravity - axis.gravity_force) if balanced else 0.0
        options |= {"mass": mass, "inclination": float(axis.inclination), "counterforce": counterforce}
    return options


def joint_export(
    job: HandOver,
    target: str,
    joint: JointFriction,
    errors: JointErrors,
    files: Mapping[str, str],
    *,
    balances: bool,
    valid_range: Mapping[str, tuple[float, float]] | None = None,
) -> Export:
    """The export of a target that has a joint, with its numbers as ``axis.json``.

    ``balances`` is true where the files have the force that balances the weight, ``valid_range`` where another than
    that of the model holds.
    """
    document = {"made_by": provenance_line(job), **joint.document(), **errors.document()}
    return Export.of(
        job,
        target,
        {**files, "axis.json": json.dumps(document, indent=2) + "\n"},
        errors.of_export,
        valid_range=valid_range,
        measured_range=joint_range(job),
        warnings=[*errors.warnings(joint), *joint.warnings(balances=balances)],
    )


def provenance_line(job: HandOver) -> str:
    """The line that says what made a file, and of which model."""
    return f"Made by ballscrew {job.provenance['version']}. {c99.title(job)}."
