"""A store as Zarr reads it: each file is compared with its size and checksum before anything is made of it."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from zarr.storage import LocalStore, WrapperStore

from ballscrew.engine.sweeps.store_check import Contents, Noted, stored_plan


class CheckedStore(WrapperStore[LocalStore]):
    """The folder of a complete store, read only.

    Reading raises :class:`~ballscrew.basis.errors.InputError` for a file that is damaged, missing, or of another sweep.
    """

    async def get(self, key: str, prototype: Any, byte_range: Any = None) -> Any:
        """The content of a file, as it was written."""
        found = await super().get(key, prototype, byte_range)
        if byte_range is None:  # Zarr reads chunks whole
            self._noted.check(key, None if found is None else found.as_numpy_array())
        return found

    @functools.cached_property
    def _noted(self) -> Noted:
        path = Path(self._store.root)
        document = stored_plan(path)
        assert document is not None, "a store that is complete has a plan"
        return Contents.of(path, document).noted()


def checked_store(path: Path) -> CheckedStore:
    """The folder of a complete store, to be opened by xarray."""
    return CheckedStore(LocalStore(path, read_only=True))
