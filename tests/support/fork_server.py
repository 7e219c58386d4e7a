"""A process that has loaded what commands need, and runs each command in a fork of itself.

A command takes most of its time to load NumPy, SciPy, pint and the rest. A fork of this process has them at once, and
is a process in all that tests look at: streams, exit code, folder, environment, signals. ``commands.py`` starts
it with the address of a socket; it ends when its standard input does.
"""

import array
import atexit
import builtins
import contextlib
import gc
import io
import json
import os
import runpy
import selectors
import signal
import socket
import sys
import threading
import traceback
import warnings

#: What a fork finds loaded, computed and compiled: each kind of command once, on a case of its own.
WARM_UP = (
    "run {examples}/olaru2005.toml",
    "run {examples}/olaru2005.toml --band --samples 256",
    "compare {examples}/olaru2005.toml --to {folder}/compare.png",
    "check rexroth-40x10x6-6-double",
    "sweep {examples}/olaru2005.toml --to {folder}/map.nc",
    "sensitivity {examples}/olaru2005.toml",
    "warm-up {examples}/warm_up.toml",
    "duty {examples}/vertical_axis.toml",
    "axis {examples}/vertical_axis.toml",
    "report {examples}/olaru2005.toml --to {folder}/report.html",
)


def load(examples: str, folder: str) -> None:
    """Run each kind of command once, here, with nobody listening, and make the application in the browser."""
    from ballscrew.compiler.kernels import kernel
    from ballscrew.faces.cli.main import main
    from ballscrew.faces.web import connections, server  # noqa: F401  (for those who serve)

    kernel.CODE_OPTIMISATION = 0  # as in the tests: a fifth of the time, and the same bits
    for command in WARM_UP:
        sys.argv = ["ballscrew", *command.format(examples=examples, folder=folder).split()]
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            try:
                main()
            except SystemExit as end:
                if end.code:
                    raise RuntimeError(f"{command}\n{said.getvalue()}") from end
    server.application()
    server.warm_up()


def serve(address: str) -> None:
    """Fork for each connection; tell it the process, and how that ended."""
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(address)
    listener.listen()
    woken, wake = os.pipe()
    os.set_blocking(wake, False)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the tests; they end this one
    signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(wake)
    running: dict[int, socket.socket] = {}
    gc.collect()
    gc.freeze()  # or the first collection of each fork copies all memory
    sys.stdout.write("ready\n")
    sys.stdout.flush()
    with selectors.DefaultSelector() as events:
        for source in (listener.fileno(), woken, 0):
            events.register(source, selectors.EVENT_READ)
        while True:
            ready = {key.fd for key, _ in events.select()}
            if 0 in ready:
                return
            if woken in ready:
                os.read(woken, 4096)
                _tell_of_ended(running)
            if listener.fileno() in ready:
                connection, _ = listener.accept()
                asked, streams = _request(connection)
                with warnings.catch_warnings(action="ignore"):  # BLAS has threads; it is made for forks
                    process = os.fork()
                if process == 0:
                    for other in (listener, connection, *running.values()):
                        other.close()
                    become(asked, streams)
                for stream in streams:
                    os.close(stream)
                running[process] = connection
                connection.sendall(f"{process}\n".encode())


def _request(connection: socket.socket) -> tuple[dict, list[int]]:
    """What is to be run, and its three streams."""
    size = 3 * array.array("i").itemsize
    head, ancillary, _, _ = connection.recvmsg(8, socket.CMSG_LEN(size))
    streams = array.array("i", ancillary[0][2])
    with connection.makefile("rb") as text:
        return json.loads(text.read(int(head))), list(streams)


def _tell_of_ended(running: dict[int, socket.socket]) -> None:
    while running:
        process, status = os.waitpid(-1, os.WNOHANG)
        if process == 0:
            return
        with running.pop(process) as connection, contextlib.suppress(OSError):  # nobody may wait any more
            connection.sendall(f"{os.waitstatus_to_exitcode(status)}\n".encode())


def become(asked: dict, streams: list[int]) -> None:
    """Become the process that was asked for, and end as it does."""
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    os.chdir(asked["folder"])
    os.environ.clear()
    os.environ.update(asked["environment"])
    sys.stdin = os.fdopen(0, encoding="utf-8", closefd=False)
    sys.stdout = os.fdopen(1, "w", encoding="utf-8", buffering=1 if asked["lines"] else -1, closefd=False)
    sys.stderr = os.fdopen(2, "w", encoding="utf-8", errors="backslashreplace", buffering=1, closefd=False)
    sys.argv = [asked["module"], *asked["arguments"]]
    for category in asked["errors"]:
        warnings.filterwarnings("error", category=getattr(builtins, category))
    sys.warnoptions = [f"error::{category}" for category in asked["errors"]]  # as -W: the program leaves them alone
    warnings.filterwarnings("default", category=EncodingWarning)  # forgets which warnings were shown while loading
    code = 1
    try:
        runpy.run_module(asked["module"], run_name="__main__", alter_sys=True)
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    except BaseException:
        traceback.print_exc()
    finally:
        with contextlib.suppress(Exception):
            threading._shutdown()  # threads end, and what is registered runs, as at the end of any program
            atexit._run_exitfuncs()
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    _, address, *places = sys.argv
    load(*places)
    serve(address)
