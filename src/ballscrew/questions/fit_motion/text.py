"""``ballscrew fit`` on a moving log: tables on the terminal, and the caption of its picture."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from ballscrew.basis import units
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text
from ballscrew.evidence.moving_logs.linear_model import NAMES
from ballscrew.evidence.moving_logs.motion_fit import LINEAR, POWER, QUANTITIES, SCREW, MotionEstimate, MotionFit
from ballscrew.questions.shared.text_tables import spoken, table_of

#: The models as they are printed.
SPOKEN = {LINEAR: "constant + viscous", POWER: "power of speed", SCREW: "screw model"}


def print_motion_fit(case: Case, found: MotionFit) -> None:
    """The log and its filter, the numbers, what the log cannot tell, and the three models side by side."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    log, equation = found.equation.log, found.equation
    say(f"{log_name(found)}: {equation.used.size} rows of {log.rows} used, {model_text(case)}\n", "bold")
    left_out = [
        f"left out: {count} {'row' if count == 1 else 'rows'}, {reason}" for reason, count in equation.left_out.items()
    ]
    for line in (*left_out, *log.notes, *filter_lines(found)):
        say(line, "dim")
    console.print()
    console.print(_estimates(found))
    if found.power is not None:
        for line in exponent_lines(found):
            say(line)
    for record in found.warning_records:
        say(f"{'beware' if record.severity == 'warning' else 'note'}  {record.text}", "yellow")
    console.print(_models(found))
    console.print(_effects(found))


def log_name(found: MotionFit) -> str:
    """The name of the log."""
    return (found.equation.log.source or ("log", ""))[0]


def filter_lines(found: MotionFit) -> list[str]:
    """The filters that the noise asked for."""
    equation, motion = found.equation, found.equation.kinematics
    of, unit, scale = ("position", "µm", 1e6) if equation.log.position is not None else ("speed", "mm/s", 1e3)
    blocks = found.linear.solution.blocks
    return [
        f"noise of the {of} {scale * motion.noise:.3g} {unit}: speed and acceleration filtered at "
        f"{motion.cutoff:.3g} Hz, both sides at {equation.cutoff:.3g} Hz",
        f"residuals follow each other: {blocks:.0f} blocks of {equation.duration / blocks:.2g} s count as independent",
    ]


def _estimates(found: MotionFit) -> Table:
    table = table_of("Fitted", "", "model", "", "value", "± standard error", "95 % interval")
    for estimate in found.estimates.values():
        unit = estimate.quantity.shown_in.replace("um", "µm") if estimate.quantity.unit != "1" else ""
        table.add_row(
            spoken(estimate.name), SPOKEN[estimate.model], unit, _number(estimate, estimate.value), _error(estimate),
            interval(estimate),
        )  # fmt: skip
    return table


def _error(estimate: MotionEstimate) -> str:
    if estimate.given:
        return "given"
    if estimate.at_bound:
        return "at its bound"
    return "not identified" if estimate.std is None else f"± {_number(estimate, estimate.std, 2)}"


def interval(estimate: MotionEstimate) -> str:
    """``94.5 to 95.6``; a dash where there is none."""
    if estimate.interval is None:
        return "–"
    low, high = (_number(estimate, end) for end in estimate.interval)
    return f"{low} to {high}"


def _number(estimate: MotionEstimate, value: float, digits: int = 4) -> str:
    return units.to_digits(units.from_si(value, estimate.quantity), digits)


def exponent_lines(found: MotionFit) -> list[str]:
    """The exponent of the speed, its two intervals, and where the wider one is from."""
    power = found.power
    assert power is not None
    (low, high), (least, most) = power.bootstrap, power.interval
    told = f"speed exponent {power.exponent:.2f}: {low:.2f} to {high:.2f} by resampled blocks"
    ends = sorted(power.choices.items(), key=lambda one: one[1])
    return [
        f"{told}, {least:.2f} to {most:.2f} over filters, slowest speeds, directions and halves",
        f"  lowest {ends[0][1]:.2f} ({ends[0][0]}), highest {ends[-1][1]:.2f} ({ends[-1][0]})",
    ]


def _models(found: MotionFit) -> Table:
    other = ["other log"] if found.test is not None else []
    table = table_of("\nError, root mean square over that of the force", "", "this log", *other)
    for name, error in found.relative_errors.items():
        crossed = [f"{found.cross_errors[name]:.2%}"] if other else []
        table.add_row(SPOKEN[name], f"{error:.2%}", *crossed)
    return table


def _effects(found: MotionFit) -> Table:
    spoken_names = [units.heading(QUANTITIES[name]) for name in NAMES]
    table = table_of("\nWhat another filter would have given (constant + viscous)", "", *spoken_names, "off")
    own = [("as fitted", found.linear.values, found.linear.relative_error)]
    for name, values, error in (*own, *found.filter_effects):
        table.add_row(name, *(f"{value:.4g}" for value in values.tolist()), f"{error:.2%}")
    return table


def caption(case: Case, found: MotionFit) -> str:
    """The caption of the picture."""
    kept = [e for e in found.estimates.values() if e.name in ("mass", "coulomb_force", "viscous_coefficient")]
    told = ", ".join(f"{spoken(e.name)} {units.shown(e.value, e.quantity)} ({interval(e)})" for e in kept)
    errors = ", ".join(f"{SPOKEN[name]} {error:.2%}" for name, error in found.relative_errors.items())
    return (
        f"{design(case)}. Fitted (95 %): {told}. Off: {errors}. Both sides filtered at {found.equation.cutoff:.3g} Hz."
    )
