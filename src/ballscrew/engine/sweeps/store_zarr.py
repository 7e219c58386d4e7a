"""Zarr's part of a store: metadata and coordinates, chunks, and reading, where each file is compared before it is used.

Each chunk ends with the checksum of Zarr's own codec, which whatever reads it compares; for Zarr alone a chunk that is
missing, or an intact one of another sweep, is in order.
"""

from __future__ import annotations

import functools
import json
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
import zarr
from zarr.codecs import BloscCodec, Crc32cCodec
from zarr.core.buffer import default_buffer_prototype
from zarr.storage import LocalStore, MemoryStore, WrapperStore

from ballscrew.engine.evaluation.outputs import attributes_of
from ballscrew.engine.evaluation.plan import Plan
from ballscrew.engine.sweeps.store_check import ROOT, Contents, contents_of
from ballscrew.engine.sweeps.store_plan import Blocks, Content

#: LZ4 with the bytes of equal weight side by side: a map of seven outputs takes 0.72 of its bytes, and
#: a disk slower than a processor compresses has the less to do. Zstandard saves 0.02 more at most and
#: takes up to twice as long; on numbers as they are it saves half as much.
COMPRESSION: Mapping[str, Any] = {"cname": "lz4", "clevel": 1, "shuffle": "shuffle"}


def lay_out(
    folder: Path, plan: Plan, blocks: Blocks, variables: Sequence[str], attributes: Mapping[str, Any], digest: str
) -> dict[str, Content]:
    """Write all metadata and coordinates of a store into a new folder; size and checksum of each file.

    The checksums are bound to the ``digest`` of the plan.

    Each chunk ends with a checksum of its bytes, which whatever reads it compares.
    """
    with warnings.catch_warnings():
        # labels that are text have no settled type in Zarr 3 yet; they are read back by the same library
        warnings.filterwarnings("ignore", message=".*does not have a Zarr V3 specification")
        coordinates = xr.Dataset(coords=plan.coordinates(), attrs=dict(attributes))
        coordinates.to_zarr(folder, zarr_format=3, consolidated=False)
    aside = [str(name) for name in coordinates.coords if name not in coordinates.dims]
    for name in variables:
        output = plan.wanted[name]
        of_output: dict[str, Any] = {**attributes_of(output.quantity)}
        if aside:
            of_output["coordinates"] = " ".join(aside)
        zarr.create_array(
            folder,
            name=name,
            shape=blocks.shape,
            chunks=blocks.chunk,
            dtype=np.dtype(output.dtype),
            compressors=(*([BloscCodec(**COMPRESSION)] if blocks.shape else []), Crc32cCodec()),
            fill_value=np.dtype(output.dtype).type(np.nan if output.dtype is float else False),
            dimension_names=list(plan.sizes),
            attributes=of_output,
        )
    root = json.loads((folder / ROOT).read_text(encoding="utf-8"))
    root["attributes"].pop("coordinates", None)  # each variable names its own
    members = sorted(path.name for path in folder.iterdir() if path.is_dir())
    # with the metadata of all members in one place nobody need list the folder
    metadata = {name: json.loads((folder / name / ROOT).read_text(encoding="utf-8")) for name in members}
    root["consolidated_metadata"] = {"kind": "inline", "must_understand": False, "metadata": metadata}
    (folder / ROOT).write_bytes(json.dumps(root, indent=2, ensure_ascii=False, sort_keys=True).encode())
    files = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*")) if path.is_file()}
    return {key: Content.of(digest, key, path.read_bytes()) for key, path in files.items()}


def chunk_of(metadata: Any, blocks: Blocks, number: int, values: np.ndarray) -> np.ndarray | None:
    """The bytes of a block of an output as Zarr makes them, in memory; None of nothing but the fill value.

    ``metadata`` is the buffer of :func:`metadata_of`, ``values`` are those of the flattened block.
    """
    held = {ROOT: metadata}
    region = blocks.region(number)
    array: Any = zarr.open_array(MemoryStore(held), mode="r+")
    array[region if region else ...] = values.reshape([part.stop - part.start for part in region])
    chunk = held.get(blocks.key(number))
    return None if chunk is None else chunk.as_numpy_array()


def metadata_of(folder: Path) -> Any:
    """The metadata of an output in its folder, as a buffer of Zarr."""
    return default_buffer_prototype().buffer.from_bytes((folder / ROOT).read_bytes())


def opened(path: Path) -> xr.Dataset:
    """The dataset of a complete store; values are read, and compared with their checksums, when asked for."""
    return xr.open_zarr(CheckedStore(LocalStore(path, read_only=True)), chunks=None, consolidated=True)


class CheckedStore(WrapperStore[LocalStore]):
    """The folder of a complete store, read only.

    Reading raises :class:`~ballscrew.basis.errors.InputError` for a file that is damaged, missing, or of another sweep.
    """

    async def get(self, key: str, prototype: Any, byte_range: Any = None) -> Any:
        """The content of a file, as it was written."""
        content = await super().get(key, prototype, byte_range)
        if byte_range is None:  # Zarr reads chunks whole
            self._contents.check(key, None if content is None else content.as_numpy_array())
        return content

    @functools.cached_property
    def _contents(self) -> Contents:
        return contents_of(Path(self._store.root))
