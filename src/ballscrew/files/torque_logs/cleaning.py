"""Cleaning of a log for a model of steady motion. Each step is a function from a log to a log.

Rows of a log that repeat earlier ones, as in a file that was appended to itself: they are no further evidence.

Single rows are often alike where a logger has few digits. What repeats is a sequence, so long that chance does not
explain it, of rows that are alike in all columns but the time: a copy may have a clock of its own.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Collection, Mapping, Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, fault_of
from ballscrew.basis.quantities import within_bounds
from ballscrew.files.torque_logs.log_rows import INERTIA, REQUIRED, LogRows, quantities
from ballscrew.files.torque_logs.motion import CLEAR, Floats, motion_of, runs_in

#: The least number of rows in a repeated sequence that differ from each other.
DISTINCT_ROWS = 10
#: The least number of rows, beyond those of chance, of a repeated sequence that no step back in time begins.
LEAST_REPEATED = 50
#: Probability that chance repeats any sequence of a log.
CHANCE = 1e-6


def repeated_rows(columns: Sequence[Floats], time: Floats | None = None) -> NDArray[np.bool_]:
    """The rows within sequences that occurred before, from columns of equal length.

    Two rows are alike with the probability ``c = Σ p²``, so that a sequence of ``ln(rows² / CHANCE) / ln(1 / c)`` rows
    is not repeated by chance. Readings of few digits that follow each other are alike more often than that: a sequence
    also has so many distinct rows as :data:`DISTINCT_ROWS`. A test plan that is measured twice with few digits is no
    repeat: where the clock does not step back at its begin, a sequence has at least :data:`LEAST_REPEATED` rows more
    than chance needs, and as many as a tenth of the rows that are no repeats.
    """
    keys = _hashed(np.stack([np.asarray(values, dtype=np.float64) for values in columns], axis=1))
    _, number, counts = np.unique(keys, return_inverse=True, return_counts=True)
    alike = float(np.sum((counts / keys.size) ** 2))
    result = np.zeros(keys.size, dtype=bool)
    if counts.size < DISTINCT_ROWS or counts.max() == 1:
        return result
    length = max(DISTINCT_ROWS, math.ceil(math.log(keys.size**2 / CHANCE) / -math.log(alike)))
    if 2 * length > keys.size:
        return result
    windows = np.zeros(keys.size - length + 1, dtype=np.uint64)
    for place, factor in enumerate(_factors(length)):
        windows += factor * keys[place : place + windows.size]
    _, first, same = np.unique(windows, return_index=True, return_inverse=True)
    earlier = first[same.reshape(-1)]
    begins = np.flatnonzero(earlier + length <= np.arange(windows.size))
    if not begins.size:
        return result
    # windows one after the other, all as far behind what they repeat
    breaks = (np.diff(begins) != 1) | (np.diff(begins - earlier[begins]) != 0)
    sequences = [(part[0], part[-1] + length, part.size) for part in np.split(begins, np.flatnonzero(breaks) + 1)]
    repeated = np.zeros(keys.size, dtype=bool)
    for begin, end, _ in sequences:
        repeated[begin:end] = True
    least = max(LEAST_REPEATED, np.count_nonzero(~repeated) / 10)
    for begin, end, size in sequences:
        steps_back = time is not None and begin > 0 and time[begin] < time[begin - 1]
        distinct = np.unique(number.reshape(-1)[begin:end]).size
        if (steps_back or size >= least) and distinct >= DISTINCT_ROWS:
            result[begin:end] = True
    return result


def _hashed(table: Floats) -> NDArray[np.uint64]:
    """A number for each row, the same for rows that are alike."""
    bits = np.ascontiguousarray(table + 0.0).view(np.uint64)  # no negative zeros
    return np.asarray(np.sum((bits ^ (bits >> np.uint64(29))) * _factors(table.shape[1]), axis=1, dtype=np.uint64))


def _factors(count: int) -> NDArray[np.uint64]:
    """Odd random numbers, always the same."""
    return np.random.default_rng(1).integers(0, 2**64, count, dtype=np.uint64) | np.uint64(1)


#: Any kind of log: each step returns the kind that it was given.
Log = TypeVar("Log", bound=LogRows)

#: Reasons for leaving rows out.
GAPS, REST, RAMPS, THINNED = "a value is missing or impossible", "at rest", "speed changes", "thinned"
REPEATED = "repeats an earlier row"
_SORTED = "rows were not in the order of time: sorted"
_INERTIA_NOT_USED = "the inertia is not used: a torque of friction has no share of it"
#: Fewer rows than these tell nothing; fewer than those tell little.
LEAST_ROWS, FEW_ROWS = 3, 30
#: A log that is longer is thinned to so many rows before anything but its acceleration is looked at.
HELD = 1_000_000
#: Speeds below this share of the largest are rest; the largest is that of all rows but one in a thousand.
_REST, _LARGEST = 1e-4, 0.999
#: Speeds that are not clear of their noise are rest too, up to this share of the largest.
_NOISY_REST = 0.02
#: A row beside a gap may have narrow windows only: one so much noisier than the others may hide an acceleration.
_HIDING = 3.0
#: The speed hardly rests if changes that are usual are so many times what noise explains.
_RESTLESS = 3.0
#: Rows whose inertia takes more than this share of a typical torque are left out.
_INERTIA_SHARE = 0.1
#: A speed that would take longer than this to grow from rest to the largest, s, is as good as steady; a faster one is
#: looked for with windows wide enough to tell one that takes so long, whatever the noise.
_STEADY, _QUICK = 60.0, 5.0
#: A quarter of the absolute values of a normal distribution lie below this many standard deviations.
_QUARTER = 0.3186
#: A speed this far, as a share of the largest, from the line between its neighbours is a jump; with more jumps among
#: the rows than that, rows are settings and no trace of a motion.
_JUMP, _JUMPING = 0.1, 0.15
#: Numbers closer than this share of the largest are the same setting.
_SAME = 0.02


def cleaned(log: Log, inertia: float | None, most: int) -> Log:
    """All steps in their order; see :meth:`~ballscrew.files.torque_logs.torque_log.TorqueLog.cleaned`."""
    if inertia is not None and (fault := fault_of("log", INERTIA, inertia)) is not None:
        raise InputError(fault)
    log = log if log.keys is not None else dataclasses.replace(log, keys=random_keys(len(log)))
    log = without_repeats(without_gaps(log, (*REQUIRED, "time")))
    log = of_settings(thinned(in_order(log), HELD))
    log = without_gaps(log, ("temperature",))
    log = without_rest(without_ramps(log, inertia))
    log = thinned(log, most)
    if len(log) < LEAST_ROWS:
        told = "; ".join(f"{reason}: {count}" for reason, count in log.left_out.items())
        remedy = f"a fit needs {LEAST_ROWS} rows or more at steady speed"
        raise InputError(Fault("log", f"has {len(log)} rows that can be used", told, remedy))
    return dataclasses.replace(log.with_notes(*data_warnings(log)), is_clean=True, keys=None, motion=None)


def random_keys(rows: int) -> Floats:
    """The random numbers of the rows of a log, always the same."""
    return np.random.default_rng(0).random(rows)


def without_gaps(log: Log, names: Collection[str]) -> Log:
    """Without rows that lack a value of these columns; without those of them that lack every value."""
    columns = {name: values for name, values in log.columns.items() if name in names}
    empty = [name for name, values in columns.items() if not np.isfinite(values).any()]
    for name in empty:
        if name in REQUIRED:
            remedy = "give a column with numbers in it"
            raise InputError(Fault("log", f"has no {name.replace('_', ' ')} in any row", "", remedy))
    log = dataclasses.replace(log, **dict.fromkeys(empty))
    notes = (f"no row has a {name}: the column is not used" for name in empty)
    log = log.with_notes(*notes)
    return log.select(complete_rows(columns, len(log)), GAPS)


def complete_rows(columns: Mapping[str, Floats], rows: int) -> NDArray[np.bool_]:
    """The rows without missing or impossible values; columns without any value do not count."""
    result = np.ones(rows, dtype=bool)
    for name, values in columns.items():
        if np.isfinite(values).any():
            result &= within_bounds(quantities()[name].info, values)
    return result


def without_repeats(log: Log) -> Log:
    """Without rows in sequences that occurred before: a log that was appended to itself counts once."""
    if not len(log):
        return log
    again = repeated_rows([values for name, values in log.columns.items() if name != "time"], log.time)
    if not again.any():
        return log
    note = (
        f"{units.number(int(np.count_nonzero(again)))} of {units.number(len(log))} rows repeat earlier ones, one "
        "after the other: counted once"
    )
    return log.select(~again, REPEATED).with_notes(note)


def in_order(log: Log) -> Log:
    """Sort a log by time, with its motion; a log without time is left as it is."""
    if log.time is None:
        return log.with_notes("no time: rows under acceleration cannot be told from the others, and all stay")
    if log.motion is not None or not len(log):
        return log
    runs = runs_in(log.time)
    if runs is None:
        log = log.select(np.argsort(log.time, kind="stable")).with_notes(_SORTED)
    elif runs > 1:
        log = log.with_notes(describe_runs(runs))
    time = np.asarray(log.time)
    return dataclasses.replace(log, motion=motion_of(time - time[0], log.screw_speed))


def of_settings(log: Log) -> Log:
    """A log whose speed jumps from row to row has no motion: every row is a reading at rest or at a steady speed."""
    if log.motion is None or not len(log):
        return log
    jumps = np.abs(log.motion.bend) > _JUMP * _largest_speed(log)
    if np.mean(jumps) <= _JUMPING:
        return log
    note = "speeds jump from row to row: every row is taken as a reading at a steady speed"
    return dataclasses.replace(log, motion=None).with_notes(note)


def describe_runs(runs: int) -> str:
    """The note on a log whose time begins anew."""
    return f"time begins anew {units.number(runs - 1)} times: read as {units.number(runs)} logs, one after the other"


def moving(log: LogRows) -> NDArray[np.bool_]:
    """The rows at which the screw turns."""
    if not len(log):
        return np.zeros(0, dtype=bool)
    noise = 0.0 if log.motion is None else CLEAR * log.motion.noise()
    largest = _largest_speed(log)
    return np.abs(log.screw_speed) > max(_REST * largest, min(noise, _NOISY_REST * largest))


def _largest_speed(log: LogRows) -> float:
    """The largest speed, were it not for outliers."""
    return float(np.quantile(np.abs(log.screw_speed), _LARGEST))


def without_rest(log: Log) -> Log:
    """Without rows at rest."""
    return log.select(moving(log), REST)


def without_ramps(log: Log, inertia: float | None) -> Log:
    """Without rows under acceleration, and of the others' torque without the share of the inertia.

    With an inertia J (kg m²), rows with J·|dω/dt| above a tenth of the typical torque are left out, and the torque of
    the others is M − J·dω/dt, unless it is one of friction. Without one, rows are left out whose speed would grow from
    rest to the largest within a minute, if that is clear of the noise and of what is usual in the log.
    """
    turns = moving(log)
    if log.motion is None or not turns.any():
        if inertia is None or log.motion is not None:
            return log
        return log.with_notes("the inertia is not used, for it takes a trace of the speed over time")
    used = inertia if inertia and log.kind != "friction" else None
    if used is not None:
        limit = least = _INERTIA_SHARE * float(np.median(np.abs(log.torque[turns]))) / used
    else:
        limit, least = _largest_speed(log) / _STEADY, _largest_speed(log) / _QUICK
    slope, deviation = log.motion.acceleration(least)
    known = np.isfinite(slope)
    change, noise = np.where(known, slope, 0.0), np.where(known, deviation, 0.0)
    bound = np.maximum(limit, CLEAR * noise)
    notes = [_INERTIA_NOT_USED] if inertia and used is None else []
    if used is None:
        usual = CLEAR * _quarter(np.abs(change[turns])) / _QUARTER
        if usual > _RESTLESS * np.median(bound):
            notes.append("the speed hardly rests: rows at steady speed cannot be told from others; give the inertia")
        bound = np.maximum(bound, usual)
    else:
        # what is lost in the noise of the speed would only add to that of the torque
        taken_off = np.where(CLEAR * noise > limit, 0.0, used * change)
        log = dataclasses.replace(log, torque=log.torque - taken_off)
        notes.append("the torque that accelerates the inertia is taken off")
    hides = (noise > _HIDING * np.median(noise[turns])) & (CLEAR * noise > least)
    return log.select(~(turns & (hides | (np.abs(change) > bound))), RAMPS).with_notes(*notes)


def _quarter(values: Floats) -> float:
    return float(np.quantile(values, 0.25))


def thinned(log: Log, most: int) -> Log:
    """Keep at most so many rows, evenly at random and always the same ones."""
    if len(log) <= most or log.keys is None:
        return log
    keep = np.sort(np.argpartition(log.keys, most)[:most])
    return log.select(keep, THINNED).with_notes(describe_thinning(most))


def describe_thinning(most: int) -> str:
    """The note on a log that is too long."""
    return f"longer than {units.number(most)} rows: thinned evenly at random"


def data_warnings(log: LogRows) -> list[str]:
    """Warnings about effects that a log cannot identify."""
    names: list[str] = []
    if len(log) < FEW_ROWS:
        names.append(f"{units.number(len(log))} rows are few: expect wide intervals, or none")
    if _one_setting(np.abs(log.axial_load)):
        names.append("one axial load only: what depends on the load cannot be told")
    if _one_setting(np.abs(log.screw_speed)):
        names.append("one speed only: what depends on the speed cannot be told")
    if not (log.forward.any() and log.backward.any()):
        names.append("one direction only: friction cannot be told from an offset of the torque")
    if log.temperature is None:
        names.append("no temperature: the oil is taken to be as warm as in the case")
    elif float(np.ptp(log.temperature)) < 1.0:
        names.append("one temperature only: what depends on the temperature cannot be told")
    return names


def _one_setting(values: Floats) -> bool:
    return bool(np.ptp(values) <= _SAME * np.max(values))
