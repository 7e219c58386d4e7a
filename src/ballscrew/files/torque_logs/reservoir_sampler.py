"""A log gathered piece by piece: whole while it is short, and evenly thinned while it is read once it is long.

How the speed changes is found from all rows before any of them goes, so that the rows that stay are the same as those
of a log that was read whole.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.files.torque_logs import cleaning
from ballscrew.files.torque_logs.log_rows import REQUIRED, Kind
from ballscrew.files.torque_logs.motion import SCALES, SHORTEST_RUN, Floats, Motion, joined, motion_of
from ballscrew.files.torque_logs.torque_log import TorqueLog

#: Distinct times that a row must have on either side before its motion is final.
_MARGIN = max(SCALES) + 4
#: The rows held may be so many times more before the log is thinned again.
_SLACK = 1.25
#: Times that go back are looked at one by one up to so many in a piece; a piece with more is out of order.
_MOST_RUNS = 10_000


@dataclasses.dataclass(frozen=True, eq=False)
class _Rows:
    """Some rows: their columns, among them ``line`` and ``key``, and how the speed changes where that is known."""

    columns: dict[str, NDArray[Any]]
    motion: Motion | None = None

    def __len__(self) -> int:
        return self.columns["key"].size

    def select(self, keep: Any) -> _Rows:
        motion = None if self.motion is None else self.motion.select(keep)
        return _Rows({name: values[keep] for name, values in self.columns.items()}, motion)


def _joined(parts: list[_Rows]) -> _Rows:
    if len(parts) == 1:
        return parts[0]
    names = parts[0].columns
    motions = [part.motion for part in parts if part.motion is not None]
    columns = {name: np.concatenate([part.columns[name] for part in parts]) for name in names}
    return _Rows(columns, joined(motions) if motions else None)


class ReservoirSampler:
    """Rows of a log, as they come. At most ``held`` of them stay."""

    def __init__(self, held: int = cleaning.HELD) -> None:
        self._held = held
        self._random = np.random.default_rng(0)
        self._parts: list[_Rows] = []
        self._spilled = self._timed = False
        #: Rows whose motion is not final yet, after some that are only looked back at.
        self._pending: _Rows | None = None
        self._looked_back = 0
        self._origin: float | None = None
        self._last = self._run_start = np.nan
        self._runs, self._out_of_order = 1, False
        self.rows = self.gaps = 0
        #: How many numbers each column has.
        self.known: dict[str, int] = {}

    def add(self, columns: Mapping[str, Floats], line: NDArray[np.int64]) -> None:
        """Add rows in the order of the file; the same columns every time. NaN stands for a value that is missing."""
        key = self._random.random(line.size)
        self.rows += line.size
        for name, values in columns.items():
            self.known[name] = self.known.get(name, 0) + int(np.isfinite(values).sum())
        part = _Rows({**columns, "line": line, "key": key})
        if self._spilled:
            self._spill(part)
            return
        self._parts.append(part)
        if self.rows > self._held:
            self._begin_spilling()

    @property
    def waiting(self) -> int:
        """Number of rows that wait for those that follow them."""
        return 0 if self._pending is None else len(self._pending)

    def log(self, kind: Kind) -> TorqueLog:
        """The log; it is not clean yet."""
        if self._pending is not None:
            self._settle(self._pending.select(slice(None)), last=True)
            self._pending = None
        result = _joined(self._parts)
        notes: list[str] = []
        if self._spilled:
            result = self._thinned(result)
        columns: dict[str, Any] = dict(result.columns)
        line, keys = columns.pop("line"), columns.pop("key")
        motion = result.motion
        if self._out_of_order or (self._runs > 1 and self.rows < SHORTEST_RUN * self._runs):
            notes.append(
                f"rows are not in the order of time, and too many to sort (over {units.number(self._held)}): sort "
                "the file"
            )
            columns.pop("time")
            motion = None
        elif self._runs > 1:
            notes.append(cleaning.describe_runs(self._runs))
        counts = {cleaning.GAPS: self.gaps, cleaning.THINNED: self.rows - self.gaps - line.size}
        left_out = {reason: count for reason, count in counts.items() if count}
        notes += [cleaning.describe_thinning(self._held)] if cleaning.THINNED in left_out else []
        return TorqueLog(
            **columns,
            line=line,
            keys=keys,
            motion=motion,
            kind=kind,
            rows=self.rows,
            left_out=left_out,
            notes=tuple(notes),
        )

    def _begin_spilling(self) -> None:
        part, self._parts, self._spilled = _joined(self._parts), [], True
        # a column that is empty so far will not be waited for
        self._timed = "time" in part.columns and bool(np.isfinite(part.columns["time"]).any())
        self._spill(part)

    def _spill(self, part: _Rows) -> None:
        names = (*REQUIRED, "time") if self._timed else REQUIRED
        whole = cleaning.complete_rows({name: part.columns[name] for name in names}, len(part))
        self.gaps += int((~whole).sum())
        part = part.select(whole)
        if not len(part):
            return
        if not self._timed:
            part.columns.pop("time", None)
            self._parts.append(part)
        else:
            self._look_at_order(part.columns["time"])
            self._pending = part if self._pending is None else _joined([self._pending, part])
            self._settle(self._pending)
        if sum(map(len, self._parts)) > _SLACK * self._held:
            self._parts = [self._thinned(_joined(self._parts))]

    def _look_at_order(self, time: Floats) -> None:
        if self._origin is None:
            self._origin = self._run_start = self._last = float(time[0])
        earlier = np.concatenate([[self._last], time[:-1]])
        begins = time[time < earlier]
        self._out_of_order |= begins.size > _MOST_RUNS
        for begin in begins[:_MOST_RUNS]:
            self._out_of_order |= bool(begin > self._run_start)
            self._run_start = float(begin)
            self._runs += 1
        self._last = float(time[-1])

    def _settle(self, rows: _Rows, last: bool = False) -> None:
        """Take the rows whose motion is final; the others wait for those that follow them."""
        assert self._origin is not None
        time = rows.columns["time"]
        begins = np.flatnonzero(np.concatenate([[True], np.diff(time) != 0]))
        stuck = len(rows) > self._held  # time stands still
        enough = begins.size > 2 * _MARGIN
        if not (last or stuck or enough):
            return
        end = len(rows) if last or not enough else int(begins[-_MARGIN])
        motion = motion_of(time - self._origin, rows.columns["screw_speed"])
        settled = slice(self._looked_back, end)
        columns = {name: values[settled] for name, values in rows.columns.items()}
        self._parts.append(_Rows(columns, motion.select(settled)))
        back = int(begins[max(0, int(np.searchsorted(begins, end)) - _MARGIN)]) if enough else end - 1
        self._pending = rows.select(slice(back, None))
        self._looked_back = end - back

    def _thinned(self, rows: _Rows) -> _Rows:
        if len(rows) <= self._held:
            return rows
        return rows.select(np.sort(np.argpartition(rows.columns["key"], self._held)[: self._held]))
