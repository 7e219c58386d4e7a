"""Series of mean torques of one axis: a row for each test, from arrays or from a table in a file.

Refused are series that cannot be of one nut in one unit: times that run back, torques that change their unit midway,
a number of the nut that changes.
"""

from __future__ import annotations

import dataclasses
import datetime
import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from ballscrew.basis.errors import Fault, InputError, raise_if_any, si_value, without_unit
from ballscrew.basis.quantities import AngularSpeed, Info, Quantity, Temperature, Torque, Unit, fields_of, quantities_of
from ballscrew.files.tables import rows as tables
from ballscrew.files.tables.headings import Column
from ballscrew.files.torque_logs.log_rows import within
from ballscrew.files.torque_logs.motion import Floats

Time = Annotated[Any, Unit("s")]
#: A torque so many times as large as the one before, or as small, is in another unit.
JUMP = 5.0
#: What a torque of 1 N m is in the units that people mix up, by unit.
_UNITS: Mapping[str, float] = {
    "N mm": 1000.0, "N cm": 100.0, "kgf cm": 10.1972, "in lbf": 8.85075, "ft lbf": 0.737562, "kN m": 1e-3, "mN m": 1e3,
}  # fmt: skip
_ALIKE = 0.15


@dataclasses.dataclass(frozen=True, eq=False)
class TorqueSeries:
    """Mean friction torques of one axis in SI, one for each test, in the order of time; NaN where nothing is known.

    Raises :class:`~ballscrew.basis.errors.InputError` for columns of different lengths, torques that are not positive,
    times that run back, another unit midway, and more than one nut; each names the row.
    """

    torque: Annotated[Torque, within(1e6, Info("M", "mean friction torque of a test", "N m", above=0))]
    #: From the first test, or a number of any kind (see :attr:`per`).
    time: Annotated[Time | None, within(1e18, Info("t", "time of the test", "h"))] = None
    temperature: Annotated[Temperature | None, Info("T", "temperature of the nut or its oil", "degC", above=0)] = None
    screw_speed: Annotated[AngularSpeed | None, within(1e9, Info("n", "speed of the test", "rpm", above=0))] = None
    #: The times as written, one for each test.
    labels: Sequence[str] = ()
    #: What the times count: ``"s"``, or ``"test"`` for numbers of tests.
    per: str = "test"
    #: Numbers of the rows in the file.
    line: Sequence[int] = ()
    #: Names of the nuts.
    nuts: Sequence[str] = ()
    #: Remarks on the series, one line each.
    notes: tuple[str, ...] = ()
    #: Name and SHA-256 of the file.
    source: tuple[str, str] | None = None

    def __post_init__(self) -> None:
        for name, quantity in fields_of(self).items():
            object.__setattr__(self, name, si_value(f"series.{name}", getattr(self, name), quantity.unit))
        size = np.size(self.torque)
        given = {"torque": self.torque, "time": self.time, "temperature": self.temperature, "speed": self.screw_speed}
        sizes = {name: np.shape(one) for name, one in given.items() if one is not None}
        if len(set(sizes.values())) > 1 or len(next(iter(sizes.values()))) != 1:
            told = ", ".join(f"{name} {' x '.join(map(str, shape)) or 'one'}" for name, shape in sizes.items())
            raise InputError(Fault("series", "has columns of different lengths", told, "give every column each test"))
        object.__setattr__(self, "line", tuple(self.line) or tuple(range(1, size + 1)))
        if self.time is None:
            object.__setattr__(self, "time", np.arange(1.0, size + 1))
        object.__setattr__(self, "labels", tuple(self.labels) or tuple(f"test {i + 1}" for i in range(size)))
        raise_if_any(self._faults())

    def __len__(self) -> int:
        return int(np.size(self.torque))

    def _where(self, place: int) -> str:
        return f"{'series' if self.source is None else self.source[0]} row {self.line[place]}"

    def _faults(self) -> list[Fault]:
        torque, time = np.asarray(self.torque), np.asarray(self.time)
        bad = [i for i, one in enumerate(torque.tolist()) if not (math.isfinite(one) and one > 0)]
        if bad:
            remedy = "leave the test out, or give the mean over the stroke without its sign"
            return [
                Fault(f"{self._where(i)}, torque", "is no positive friction torque", f"{torque[i]:g}", remedy)
                for i in bad
            ]
        faults = [
            Fault(
                f"{self._where(int(i) + 1)}, time",
                f"runs back from {self.labels[int(i)]}",
                self.labels[int(i) + 1],
                "put the tests in the order of their dates, and check the order of day and month",
            )
            for i in np.flatnonzero(np.diff(time) < 0)
        ]
        return [*faults, *self._faults_of_units(torque), *self._faults_of_nuts()]

    def _faults_of_units(self, torque: Floats) -> list[Fault]:
        jumps = np.flatnonzero(np.abs(np.diff(np.log(torque))) > math.log(JUMP))
        if not jumps.size:
            return []
        at = int(jumps[0]) + 1
        ratio = float(torque[at] / np.median(torque[:at]))
        unit = next(
            (name for name, scale in _UNITS.items() for end in (scale,) if abs(math.log(ratio / end)) < _ALIKE), ""
        )
        back = next(
            (name for name, scale in _UNITS.items() for end in (1 / scale,) if abs(math.log(ratio / end)) < _ALIKE), ""
        )
        guess = f"is it in {unit} from here on? " if unit else f"were the tests before in {back}? " if back else ""
        times = f"{float(f'{ratio:.3g}'):g} times" if ratio > 1 else f"a {1 / ratio:.3g}th of"
        return [
            Fault(
                f"{self._where(at)}, torque",
                f"is {times} the tests before: the unit changes midway",
                f"{torque[at]:.4g} N m",
                f'{guess}write all in one unit, or the unit behind each number, "0.41 N m"',
            )
        ]

    def _faults_of_nuts(self) -> list[Fault]:
        others = [i for i, name in enumerate(self.nuts) if name != self.nuts[0]]
        if not others:
            return []
        remedy = "give each nut a table of its own: what another nut loses says nothing of the wear of this one"
        first = others[0]
        return [Fault(f"{self._where(first)}, nut", f"is another than {self.nuts[0]}", self.nuts[first], remedy)]

    @classmethod
    def of(cls, data: Any) -> TorqueSeries:
        """A series from ``data``, arrays by name in SI.

        ``torque`` (N m), or ``torque_forward`` and ``torque_backward``; and ``time`` (dates, seconds, or numbers of
        tests as ``number``), ``temperature`` (K), ``screw_speed`` (rad/s) and ``nut`` (names). A series passes as it
        is. Raises :class:`~ballscrew.basis.errors.InputError` for what is no such data.
        """
        return data if isinstance(data, TorqueSeries) else _of_arrays(data)


def quantities() -> Mapping[str, Quantity]:
    """The columns of a series: their units and bounds."""
    return quantities_of(TorqueSeries)


_NAMES = ("torque", "torque_forward", "torque_backward", "time", "number", "temperature", "screw_speed", "nut")


def _of_arrays(data: Any) -> TorqueSeries:
    names = [str(name) for name in data]
    unknown = [name for name in names if name not in _NAMES]
    raise_if_any([Fault("series", "has a column that is not known", n, f"known: {', '.join(_NAMES)}") for n in unknown])
    result: dict[str, Any] = {}
    faults: list[Fault] = []
    per, labels = "test", ()
    for name in names:
        if name == "nut":
            result["nuts"] = tuple(map(str, data[name]))
            continue
        values = np.asarray(data[name])
        if name == "time" and values.dtype.kind == "M":
            result["time"] = (values - values[0]) / np.timedelta64(1, "s")
            per, labels = "s", tuple(str(one) for one in values.astype("datetime64[D]"))
            continue
        unit = {"time": "s", "number": "1", "temperature": "K", "screw_speed": "rad/s"}.get(name, "N m")
        plain = without_unit(f"series.{name}", data[name], unit)
        if isinstance(plain, Fault):
            faults.append(plain)
            continue
        try:
            made = np.asarray(plain, dtype=np.float64)
        except (TypeError, ValueError):
            faults.append(Fault(f"series.{name}", "must be an array of numbers", "", "give a numpy.array of floats"))
            continue
        result["time" if name == "number" else name] = made
        if name in ("time", "number"):
            per = "s" if name == "time" else "test"
            labels = tuple(f"{one:g}{' s' if name == 'time' else ''}" for one in made.tolist())
    raise_if_any(faults)
    return TorqueSeries(**_one_torque(result, "series"), per=per, labels=labels)


def _one_torque(values: dict[str, Any], where: str) -> dict[str, Any]:
    """The columns with one torque: friction is the mean of both directions, in which the load goes out."""
    pair = [name for name in ("torque_forward", "torque_backward") if name in values]
    if ("torque" in values) == bool(pair) or len(pair) == 1:
        problem = "has two kinds of torques" if "torque" in values else "has no torque of both directions"
        raise InputError(Fault(where, problem, ", ".join(pair), "give torque, or torque_forward and torque_backward"))
    if not pair:
        return values
    forward, backward = (np.abs(np.asarray(values.pop(name))) for name in pair)
    return {**values, "torque": (forward + backward) / 2}


# -- tables ---------------------------------------------------------------------------------------


def _columns(aliases: Mapping[str, str]) -> list[Column]:
    own = quantities()
    # signs are judged with all rows: a log has both
    signed = Quantity("torque", "N m", within(1e6, Info("M", "mean torque of a test", "N m")))
    speed = Quantity("screw_speed", "rad/s", within(1e9, Info("n", "speed of the test", "rpm")))
    number = Quantity("number", "1", Info("", "number of the test"))
    known: list[tuple[str, Quantity | None, tuple[str, ...]]] = [
        ("number", number, ("test", "no.", "test number", "Versuch", "Nr.", "run")),
        ("date", None, ("day", "timestamp", "date time", "datetime", "Datum", "Zeitstempel")),
        ("time", own["time"], ("t", "hours", "h", "days", "operating time", "running time", "Zeit", "Betriebszeit")),
        (
            "torque", signed,
            ("friction torque", "mean torque", "drag torque", "no-load torque", "M", "Md", "Reibmoment", "Drehmoment"),
        ),
        ("torque_forward", signed, ("torque up", "up", "forward", "Moment vor", "Moment auf")),
        ("torque_backward", signed, ("torque down", "down", "backward", "reverse", "Moment ab")),
        ("temperature", own["temperature"], ("temp", "nut temperature", "oil temperature", "Temperatur")),
        ("screw_speed", speed, ("n", "speed", "rpm", "Drehzahl")),
        ("nut", None, ("serial", "serial number", "nut number", "Mutter", "Seriennummer", "axis", "Achse")),
    ]  # fmt: skip
    unknown = [name for name in aliases if name not in {column for column, _, _ in known}]
    names = ", ".join(column for column, _, _ in known)
    raise_if_any([Fault(f"--column {name}", "unknown column", "", f"known: {names}") for name in unknown])
    # a column that is given by hand has that heading only
    return [Column(name, quantity, (aliases[name],) if name in aliases else others) for name, quantity, others in known]


def read(path: Path, columns: Mapping[str, str] | None = None, keep_going: bool = False) -> TorqueSeries:
    """The series in a table of a file, a row for each test. ``columns`` has headings by name of a column.

    Raises :class:`~ballscrew.basis.errors.InputError` for faults of the table and its rows; with ``keep_going`` rows
    that cannot be read are left out and counted.
    """
    table = tables.read(path, _columns(columns or {}))
    if "screw_speed" in table.headings and any(row.values.get("screw_speed", 1.0) <= 0 for row in table.rows):
        _refuse_log(path)
    result, notes = tables.made(table, lambda row: row, keep_going)
    lines = [row.line for row in result]
    values: dict[str, Any] = {}
    for name in ("torque", "torque_forward", "torque_backward", "temperature", "screw_speed"):
        if name in table.headings:
            values[name] = np.array([row.values.get(name, math.nan) for row in result])
    values = _one_torque(values, path.name)
    per, time, labels = _times(table, result)
    nuts = [str(row.values.get("nut", "")) for row in result] if "nut" in table.headings else []
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return TorqueSeries(
        **values,
        time=time,
        labels=labels,
        per=per,
        line=lines,
        nuts=nuts,
        notes=tuple(notes),
        source=(path.name, digest),
    )


def _refuse_log(path: Path) -> None:
    remedy = "a table has a positive speed for each test; of logs give several, one for each test"
    raise InputError(Fault(path.name, "has speeds in both directions or at rest, as a log has", "", remedy))


def _times(table: tables.Table, rows: Sequence[tables.Row]) -> tuple[str, Any, Sequence[str]]:
    """Unit in which tests are counted (s, or a test), their times and their labels."""
    name = next((one for one in ("date", "time", "number") if one in table.headings), None)
    if name is None:
        return "test", None, ()
    absent = [row for row in rows if name not in row.values]
    raise_if_any([Fault(table.where(row.line, name), "is empty", "", "give each test its time") for row in absent])
    written = [row.written[name] for row in rows]
    if name == "date":
        return "s", _seconds(table, rows), written
    unit = table.headings[name].unit
    labels = [f"{text} {unit}" if unit and name == "time" else text for text in written]
    return "s" if name == "time" else "test", np.array([float(row.values[name]) for row in rows]), labels


def _seconds(table: tables.Table, rows: Sequence[tables.Row]) -> Floats:
    """The dates of tests in seconds from the first. Raises :class:`~ballscrew.basis.errors.InputError`."""
    dates = [_date(str(row.values["date"])) for row in rows]
    raise_if_any(
        [
            Fault(table.where(row.line, "date"), "is no date that is known", row.written["date"], "write 2026-03-31")
            for row, date in zip(rows, dates, strict=True)
            if date is None
        ]
    )
    first = dates[0]
    assert first is not None
    return np.array([(date - first).total_seconds() for date in dates if date is not None])


_FORMATS: Sequence[Callable[[str], datetime.datetime]] = (
    datetime.datetime.fromisoformat,
    lambda text: datetime.datetime.strptime(text, "%d.%m.%Y"),
    lambda text: datetime.datetime.strptime(text, "%d.%m.%Y %H:%M"),
)


def _date(text: str) -> datetime.datetime | None:
    for parsed in _FORMATS:
        try:
            return parsed(text.strip()).replace(tzinfo=None)
        except ValueError:
            continue
    return None
