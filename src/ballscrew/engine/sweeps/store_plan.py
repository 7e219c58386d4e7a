"""Description of a store: its blocks, and the JSON document that identifies its plan."""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import itertools
import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ballscrew.basis.version import __version__
from ballscrew.engine.evaluation.fingerprint import Fingerprint, package_digest
from ballscrew.engine.evaluation.plan import Configuration, Plan

#: Version of the layout of a store.
FORMAT = 3
#: The results of one block take at most so many bytes: a few blocks at a time fit any memory, and a
#: file of each output still has some megabytes.
BLOCK_BYTES = 32_000_000
#: Entries that differ as a consequence of others, and are reported only where no other differs.
_CONSEQUENCES = ("shape", "chunks", "formulas", "package")
#: Entries of a plan that are read, and their JSON types.
_ENTRIES = {"engine": str, "attributes": dict, "axes": dict, "outputs": dict, "shape": list, "chunks": list}
#: Digits of a digest that a message shows.
_DIGITS_SHOWN = 12


@dataclasses.dataclass(frozen=True)
class Blocks:
    """A grid cut into blocks: each is one chunk of every output and one range of the flattened grid."""

    shape: tuple[int, ...]
    #: ``(1, …, 1, c, full, …)``.
    chunk: tuple[int, ...]

    @classmethod
    def of(cls, plan: Plan, block_size: int | None = None) -> Blocks:
        """The blocks of a plan, of ``block_size`` points at most; else as many as take ``BLOCK_BYTES``.

        A nut whose balls are solved for one by one gets smaller blocks: each is work that a kill loses.
        """
        point = sum(np.dtype(output.dtype).itemsize for output in plan.wanted.values())
        most = block_size or max(1, BLOCK_BYTES // (point * plan.subject.balls))
        chunk = list(plan.shape)
        for axis, length in enumerate(plan.shape):
            beyond = math.prod(chunk[axis + 1 :])
            if length * beyond <= most:
                break
            pieces = math.ceil(length / max(1, most // beyond))
            chunk[axis] = math.ceil(length / pieces)
        return cls(plan.shape, tuple(chunk))

    @property
    def along(self) -> tuple[int, ...]:
        """The number of blocks along each axis."""
        return tuple(-(-length // part) for length, part in zip(self.shape, self.chunk, strict=True))

    @property
    def count(self) -> int:
        """The number of blocks."""
        return math.prod(self.along)

    @property
    def largest(self) -> int:
        """The points of a block, of the last ones along an axis perhaps fewer."""
        return math.prod(self.chunk)

    def _places(self, number: int) -> list[int]:
        return [int(place) for place in np.unravel_index(number, self.along)] if self.shape else []

    def key(self, number: int) -> str:
        """The path of the chunk of a block in the folder of each output."""
        return "/".join(["c", *map(str, self._places(number))])

    def number(self, key: str) -> int | None:
        """The number of the block with that path; None where there is none."""
        first, *places = key.split("/")
        if first != "c" or len(places) != len(self.shape) or not all(place.isdecimal() for place in places):
            return None
        at = [int(place) for place in places]
        if any(place >= most for place, most in zip(at, self.along, strict=True)):
            return None
        return int(np.ravel_multi_index(at, self.along)) if at else 0

    def region(self, number: int) -> tuple[slice, ...]:
        """The range of a block in the grid."""
        corners = [place * part for place, part in zip(self._places(number), self.chunk, strict=True)]
        return tuple(
            slice(corner, min(corner + part, length))
            for corner, part, length in zip(corners, self.chunk, self.shape, strict=True)
        )

    def span(self, number: int) -> slice:
        """The range of a block in the flattened grid."""
        start, points = 0, 1
        for where, length in zip(self.region(number), self.shape, strict=True):
            start = start * length + where.start
            points *= where.stop - where.start
        return slice(start, start + points)

    def points(self, number: int) -> int:
        """The number of points of a block."""
        span = self.span(number)
        return span.stop - span.start


def description_of(
    plan: Plan, blocks: Blocks, attributes: Mapping[str, Any], *, engine: str, identity: Fingerprint
) -> dict[str, Any]:
    """All that determines the bytes of a store, as plain JSON values: equal if and only if the stores are.

    Where it cannot be known what a model computes, its fingerprint is random, and at least the package is compared.
    """
    coordinates = {
        name: _digest(axis.dims, axis.to_numpy()) if axis.dims else axis.to_numpy().item()
        for name, axis in plan.axes.items()
    }
    labels = {
        str(name): _digest(values.dims, values.to_numpy())
        for axis in plan.axes.values()
        for name, values in axis.coords.items()
        if name in axis.dims and name not in plan.axes
    }
    document = {
        "format": FORMAT,
        "version": __version__,
        "engine": engine,
        "formulas": identity.digest,
        **({"package": package_digest()} if identity.unknown else {}),
        "grid": " x ".join(f"{name} {size}" for name, size in plan.sizes.items()),  # their order counts
        "shape": blocks.shape,
        "chunks": blocks.chunk,
        "axes": coordinates | labels,
        "outputs": {name: np.dtype(output.dtype).name for name, output in plan.wanted.items()},
        "laws": _laws(plan.subject),
        "attributes": dict(attributes),
    }
    return json.loads(_json(document))


def _laws(subject: Configuration) -> dict[str, str]:
    """The laws of a model and a nut by name; their coefficients are among the attributes."""
    model = {field.name: getattr(subject.model, field.name) for field in dataclasses.fields(subject.model)}
    losses = {f"losses {name}": law for name, law in subject.nut.losses.items()}
    return {
        slot: getattr(law, "__name__", type(law).__name__) for slot, law in (model | losses).items() if callable(law)
    }


def canonical_json(document: Mapping[str, Any]) -> str:
    """JSON with sorted keys."""
    return _json(dict(document), sort_keys=True)


def _json(document: Mapping[str, Any], *, sort_keys: bool = False) -> str:
    return json.dumps(document, sort_keys=sort_keys, ensure_ascii=False, separators=(",", ":"), default=_plain)


def checksum(document: Mapping[str, Any]) -> str:
    """The digest of a description."""
    return hashlib.sha256(canonical_json(document).encode()).hexdigest()


def sealed(name: str, document: Mapping[str, Any]) -> bytes:
    """A document under a name, with its digest, as the text of a file."""
    return canonical_json({name: document, "sha256": checksum(document)}).encode()


def read_sealed(name: str, text: str) -> dict[str, Any] | None:
    """The document of a name in the text of a file; None where it is damaged."""
    with contextlib.suppress(ValueError, KeyError, TypeError):
        kept = json.loads(text)
        if isinstance(kept[name], dict) and checksum(kept[name]) == kept["sha256"]:
            return kept[name]
    return None


def is_plan(document: Mapping[str, Any]) -> bool:
    """Return whether a document has the entries of a plan that are read; of another format, whether it tells which."""
    if document.get("format") != FORMAT:
        return "format" in document
    if not all(isinstance(document.get(name), kind) for name, kind in _ENTRIES.items()):
        return False
    shape, chunks = document["shape"], document["chunks"]
    return len(shape) == len(chunks) and all(type(length) is int and length > 0 for length in (*shape, *chunks))


def differences(stored: Mapping[str, Any], wanted: Mapping[str, Any]) -> list[str]:
    """The differences of two descriptions as text: ``screw_lead 0.005, not 0.01``."""
    differing: dict[str, list[str]] = {}
    for name in (*wanted, *(name for name in stored if name not in wanted)):
        theirs, ours = stored.get(name), wanted.get(name)
        if ours == theirs:
            continue
        if isinstance(ours, dict) and isinstance(theirs, dict):
            differing[name] = differences(theirs, ours)
        else:
            differing[name] = [f"{name.replace('_', ' ')} {_shown(theirs)}, not {_shown(ours)}"]
    causes = [words for name, words in differing.items() if name not in _CONSEQUENCES]
    return list(itertools.chain(*(causes or differing.values())))


def _shown(value: Any) -> str:
    text = "missing" if value is None else value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    digest = len(text) == hashlib.sha256().digest_size * 2 and set(text) <= set("0123456789abcdef")
    return f"{text[:_DIGITS_SHOWN]}…" if digest else text


def _digest(dimensions: Sequence[Any], values: np.ndarray) -> str:
    """A digest of values along dimensions; values that are not numbers count by their text."""
    body = values.tobytes() if values.dtype.kind in "fiub" else json.dumps(values.tolist(), default=str).encode()
    return hashlib.sha256(f"{[*map(str, dimensions)]} {values.shape}\n".encode() + body).hexdigest()


def _plain(value: Any) -> Any:
    """A NumPy number as JSON knows it."""
    return value.item() if isinstance(value, np.generic) else str(value)
