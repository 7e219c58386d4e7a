"""Modules of structures for the page, which computes in the browser while something is moved.

The first case of a structure has its module made in the background, by one thread for all; until then the page asks the
server for everything. A module is kept on disk beside the kernels, so that another process finds it.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import queue
import sys
import threading
from collections import OrderedDict
from collections.abc import Callable

from ballscrew.basis.quantities import quantities_of
from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation.fingerprint import recorder_digest
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import inputs_of_structure, keep, name_of
from ballscrew.exports.wasm_modules import (
    OUTPUTS,
    KeptModule,
    described,
    kept_module,
    module_of,
    module_of_oils,
    module_of_solver,
    oils,
)
from ballscrew.physics.laws.contact import RaceState

#: What the page shows of an answer, where the nut has it.
SHOWN = (*OUTPUTS, *(f"{side}_{name}" for side in ("screw", "nut") for name in quantities_of(RaceState)))
#: Most modules in memory, and most that wait to be made.
MOST_IN_MEMORY, MOST_WAITING = 32, 4
#: How much the thread that makes modules gives way to requests, where the system knows that of threads.
_NICENESS = 10
_OILS = "oils of the page"


class NotMadeError(Exception):
    """A structure that has no module, and why."""


class Modules:
    """The modules of one server."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._found: OrderedDict[str, KeptModule | str] = OrderedDict()
        self._codes: dict[str, bytes] = {}
        self._waiting: set[str] = set()
        self._tasks: queue.SimpleQueue[tuple[str, Callable[[], KeptModule]]] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None

    def of(self, subject: Configuration) -> KeptModule | None:
        """The module of a configuration whose oil is its numbers alone; None while it is made.

        Raises :class:`NotMadeError` for one that has none.
        """
        return self._get(_name(subject), lambda: KeptModule.of(module_of(subject, SHOWN)))

    def of_oils(self) -> KeptModule | None:
        """The module of all grades of oil; None while it is made."""
        return self._get(hashlib.sha256(f"{_OILS}\n{recorder_digest()}".encode()).hexdigest(), _oils)

    def solver(self) -> str:
        """The file of the module that solves the loads of the balls."""
        module = module_of_solver()
        self._codes.setdefault(module.file, module.code)
        return module.file

    def code(self, file: str) -> bytes | None:
        """The bytes of a module by the name of its file; None where it is not known, or no more."""
        self.solver()
        return self._codes.get(file)

    def _get(self, name: str, make: Callable[[], KeptModule]) -> KeptModule | None:
        with self._lock:
            known = self._found.get(name) or self._add(name, kept_module(name))
            if known is not None:
                self._found.move_to_end(name)
            if isinstance(known, str):
                raise NotMadeError(known)
            if known is None and name not in self._waiting and len(self._waiting) < MOST_WAITING:
                self._waiting.add(name)
                self._tasks.put((name, make))
                if self._thread is None:
                    self._thread = threading.Thread(target=self._work, name="ballscrew modules", daemon=True)
                    self._thread.start()
            return known

    def _add(self, name: str, made: KeptModule | str | None) -> KeptModule | str | None:
        """Keep a module in memory, or why there is none; the oldest one makes room."""
        if made is None:
            return None
        self._found[name] = made
        if isinstance(made, KeptModule):
            self._codes[made.file] = made.code
        if len(self._found) > MOST_IN_MEMORY:
            _, oldest = self._found.popitem(last=False)
            files = {one.file for one in self._found.values() if isinstance(one, KeptModule)}
            if isinstance(oldest, KeptModule) and oldest.file not in files:
                self._codes.pop(oldest.file, None)
        return made

    def _work(self) -> None:
        """Make one module after the other, and give way to whoever waits for an answer."""
        with contextlib.suppress(OSError, AttributeError):
            if sys.platform == "linux":  # elsewhere the number of a thread may be that of another process
                os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), _NICENESS)
        while True:
            name, make = self._tasks.get()
            made: KeptModule | str
            try:
                made = make()
                keep(name, made.document, made.code)
            # whatever it is, the next structure is made, and the page works without this one
            except Exception as error:
                made = str(error) or repr(error)
            with self._lock:
                self._add(name, made)
                self._waiting.discard(name)


def _name(subject: Configuration) -> str:
    """The name of a structure, equal in all processes. Raises :class:`NotMadeError` for one that has no module."""
    if not kernel.available():
        raise NotMadeError('needs a compiler that is not installed: pip install "ballscrew[fast]"')
    nut = subject.nut
    if nut.deviations is not None:
        raise NotMadeError("the balls or grooves deviate from each other")
    if nut.set_at_rest:
        raise NotMadeError("the preload was set at rest, and follows the friction of the balls")
    bodies = nut.bodies
    sizes = bodies and (bodies.screw_diameter, bodies.nut_inner_diameter, bodies.same_side, bodies.swelling)
    name = name_of(f"module for browsers {sizes}", subject, SHOWN, inputs_of_structure(subject))
    if name is None:
        raise NotMadeError("a law is not of this package")
    return name


def _oils() -> KeptModule:
    module = module_of_oils()
    grades = {grade: described(function) for grade, function in zip(oils(), module.functions, strict=True)}
    return KeptModule({"file": module.file, "grades": grades}, module.code)
