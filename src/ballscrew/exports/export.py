"""The export: the files of a target, where they hold, and how far off they are."""

from __future__ import annotations

import contextlib
import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.exports.subject import TEMPERATURE, HandOver
from ballscrew.exports.worst_error import WorstError


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Export:
    """A model handed over: its files, their range, their worst error against the model, and what to know of them."""

    #: The name of the target, ``c``.
    target: str
    #: The content of each file by its name; a name may have folders, ``models/screw.xml``.
    files: Mapping[str, bytes]
    #: The least and the greatest value of each input, in SI. Beyond them the nearest value counts, and ``valid`` is 0.
    valid_range: Mapping[str, tuple[float, float]]
    #: The worst error of each output over the range, measured when this was made.
    worst_error: tuple[WorstError, ...]
    #: The range over which the error was measured.
    measured_range: Mapping[str, tuple[float, float]] = dataclasses.field(
        default_factory=dict[str, tuple[float, float]]
    )
    #: Warnings of the model and of the target.
    warnings: tuple[Record, ...] = ()
    #: Version, model, sources, and all inputs with their values.
    provenance: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])
    #: The quantity of each input.
    quantities: Mapping[str, Quantity] = dataclasses.field(default_factory=dict[str, Quantity])

    @classmethod
    def of(
        cls,
        handed: HandOver,
        target: str,
        files: Mapping[str, bytes],
        *,
        valid_range: Mapping[str, tuple[float, float]],
        worst_error: Sequence[WorstError],
        warnings: Sequence[Record] = (),
    ) -> Export:
        """An export of the model ``handed`` over, with its provenance and the warnings that every target has.

        ``target``, ``files``, ``valid_range`` and ``worst_error`` are the fields of these names; ``warnings`` are
        further ones.
        """
        return cls(
            target=target,
            files=files,
            valid_range=valid_range,
            worst_error=tuple(worst_error),
            measured_range=handed.working_range,
            warnings=(*_warnings(handed), *warnings),
            provenance=handed.provenance,
            quantities={one.name: one.quantity for one in handed.inputs},
        )

    def write(self, directory: str | Path) -> list[Path]:
        """Write all files into the folder ``directory``, which is made where there is none; return their paths.

        All of them are written whole, or none. Raises
        :class:`~ballscrew.basis.errors.InputError` for a place that cannot be written.
        """
        places = {Path(directory) / PurePosixPath(name): content for name, content in self.files.items()}
        for path in places:
            check_writable("--out", path)
        with contextlib.ExitStack() as stack:  # at its end all files get their names
            for path, content in places.items():
                stack.enter_context(atomic_write("--out", path)).write_bytes(content)
        return list(places)


def _warnings(handed: HandOver) -> list[Record]:
    """Starvation, and a warning where the temperature changes nothing."""
    if handed.has_effect[TEMPERATURE]:
        return [*handed.starvation]
    message = (
        "the oil is given by its numbers, so that the input temperature changes nothing; give a grade or a data sheet"
    )
    record = Record(text=message, id="hand_over.temperature", subject="temperature", severity="warning", holds=False)
    return [*handed.starvation, record]
