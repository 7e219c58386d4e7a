"""Response models of the API for an axis: a cycle of it, and what gives way between its motor and its table."""

from __future__ import annotations

from ballscrew.api_answers.parts import (
    Closed,
    JudgedCheck,
    Number,
    Numbers,
    Open,
    Provenance,
    Record,
    Tables,
    field,
    model,
    quantities,
)
from ballscrew.axis_studies.duty import NUMBERS, SCREW_TORQUE
from ballscrew.axis_studies.stiffness import FRICTION, LOAD, SERIES, SPEED


class PowerOff(Open):
    """What the axis does with its motor off."""

    falls: bool
    holding_torque: Number = field("largest torque that keeps the axis at rest, SI", "N m")
    brake_torque: Number = field("rated torque of a brake, SI", "N m")
    conditions: list[Tables]


class Cycle(Closed):
    """The states of a cycle over time, and the torque of the motor by cause."""

    every: int = field("1 where each state of the motion is here, or each second, third … one")
    time: list[float] = field("time since the start of the cycle, SI", "s")
    position: list[float] = field("position, SI", "m")
    speed: list[float] = field("speed, SI", "m/s")
    acceleration: list[float] = field("acceleration, SI", "m/s^2")
    axial_load: list[Number] = field("load of the nut, SI", "N")
    motor_speed: list[Number] = field("speed of the motor, SI", "rad/s")
    torque: list[Number] = field("torque of the motor by mechanics, SI", "N m")
    flooded_torque: list[Number] | None = field(
        "the same in a full bath of oil, SI; null where nothing is starved of oil", "N m"
    )
    power: list[Number] = field("power of the motor, SI", "W")
    torque_by: dict[str, list[Number]] = field("torque of the motor by cause, SI", "N m")


class MotorCurve(Closed):
    """What a motor gives, at the corners of its curve."""

    speed: list[float] = field("speed of the motor, SI", "rad/s")
    peak_torque: list[float] = field("torque that it gives for a short time, SI", "N m")
    rated_torque: float = field("torque that it gives for ever, SI", "N m")


class MotorUse(Open):
    """The cycle against the motor."""

    suffices: bool
    utilisation: Number = field("torque over the peak torque at its speed, where that is largest")
    curve: MotorCurve


DutyResults = model(
    "DutyResults",
    "Numbers of a cycle of an axis.",
    Open,
    **quantities(NUMBERS),
    energy_lost_by=(Numbers, field("energy lost in a cycle by mechanism, SI", "J")),
    energy_lost_in=(dict[str, Numbers], field("energy lost in a cycle by element and mechanism, SI", "J")),
    heat_by_element=(Numbers, field("mean heat of each element over the cycle, SI", "W")),
    torque_rms_by=(Numbers, field("parts of the RMS torque, SI", "N m")),
    torque_peak_by=(Numbers, field("parts of the peak torque, SI", "N m")),
    energy_by=(Numbers, field("energy of a cycle by cause, SI", "J")),
    screw_torque=(Number, field(f"{SCREW_TORQUE.info.meaning}, SI", SCREW_TORQUE.unit)),
    flooded_torque=(
        Number,
        field("largest torque of the motor in a full bath of oil, SI; null for one efficiency", "N m"),
    ),
    full_bath=(
        dict[str, Number] | None,
        field("numbers of the cycle in a full bath of oil, SI; null for one efficiency, which knows no oil"),
    ),
    brake=(PowerOff, ...),
    motor=(MotorUse, field("the cycle against the motor, where there is one", optional=True)),
    phases=(list[Tables], ...),
    cycle=(Cycle, ...),
    valid=(bool, ...),
)


class Duty(Closed):
    """A cycle of an axis."""

    inputs: Tables
    results: DutyResults  # pyright: ignore[reportInvalidTypeForm]  (a model made from the annotations)
    units: Tables
    verdicts: list[Record]
    checks: list[JudgedCheck]
    warnings: list[Record]
    provenance: Provenance


ChainResults = model(
    "ChainResults",
    "Rigidity, lost motion, critical speed and buckling load over the place of the nut.",
    Open,
    **{name: (list[Number], field(f"{q.info.meaning}, SI", q.unit)) for name, q in SERIES.items()},
    shares=(dict[str, list[Number]], field("share of each spring in what gives way")),
    travel=(list[float], field("places of the nut at the ends of its travel, SI", "m")),
    **quantities({q.name: q for q in (LOAD, SPEED, FRICTION)}),
)


class Chain(Closed):
    """What gives way between the motor and the table of an axis, over its stroke."""

    inputs: Tables
    results: ChainResults  # pyright: ignore[reportInvalidTypeForm]  (a model made from the annotations)
    units: Tables
    assumed: list[str]
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance
