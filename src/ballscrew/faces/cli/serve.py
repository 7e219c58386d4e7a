"""``ballscrew serve``: the application in the browser."""

from __future__ import annotations

import contextlib
import os
import sys
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    import socket

_NEEDS = ("fastapi", "fastapi_offline", "uvicorn", "jinja2", "typst")
_LOOPBACK = ("127.0.0.1", "localhost", "::1")
_ANY = ("0.0.0.0", "::")


def serve(
    port: Annotated[int, typer.Option("--port", metavar="N", help="Port to listen on, 0 for any free one.")] = 8017,
    host: Annotated[
        str,
        typer.Option(
            "--host",
            metavar="NAME",
            help="Address to listen on; with another than 127.0.0.1 other machines can reach it.",
        ),
    ] = "127.0.0.1",
    open_browser: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    time_limit: Annotated[
        float | None,
        typer.Option(
            "--time-limit",
            metavar="SECONDS",
            min=0.1,
            help="Seconds of processor time that one request may take, 20; a job may take 30 times as long.",
        ),
    ] = None,
) -> None:
    """The application in the browser, and its JSON API. Both run on this machine; Ctrl-C ends them.

    The page is at the address it prints, the API under /api. Nothing is asked from outside and nothing is stored.
    """
    # not for those who ask for help only
    import importlib.util
    import logging
    import webbrowser

    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.records import Message

    missing = [name for name in _NEEDS if importlib.util.find_spec(name) is None]
    if missing:
        raise InputError(
            Fault(
                "serve", Message("needs {names}", {"names": " and ".join(missing)}), "", 'pip install "ballscrew[web]"'
            )
        )
    listening = _listening(host, port)
    from ballscrew.faces.web import connections, guard, server
    from ballscrew.faces.web.job_process import Forks
    from ballscrew.faces.web.request_queue import TIME_LIMIT, RequestQueue

    name = f"[{host}]" if ":" in host else host
    hosts = guard.LOOPBACK if host in _LOOPBACK else ("*",) if host in _ANY else (name.lower(), *guard.LOOPBACK)
    application = server.application(hosts, RequestQueue(TIME_LIMIT if time_limit is None else time_limit))
    server.warm_up()
    if sys.platform == "linux":  # elsewhere a fork is not safe, or there is none
        application.state.jobs.start = Forks(lambda requests: server.application(requests=requests), listening)
    address = f"http://{name}:{listening.getsockname()[1]}"
    typer.echo(f"ballscrew in the browser: {address} · API: {address}/api · Ctrl-C ends it")
    if host not in _LOOPBACK:
        typer.echo("beware: others on the network can use it, too; it has no password and no encryption", err=True)
    sys.stdout.flush()
    if open_browser:
        webbrowser.open(address)
    logging.captureWarnings(True)  # of NumPy: the answers state what has no value, the terminal is not where to look
    with listening, contextlib.suppress(KeyboardInterrupt):  # Ctrl-C is how it ends
        connections.serve(application, listening)


def _listening(host: str, port: int) -> socket.socket:
    """A socket that listens there; a fault that names the option if there can be none."""
    import socket

    from ballscrew.basis.errors import Fault, InputError

    if not 0 <= port <= 65535:
        raise InputError(Fault("--port", "is no port", str(port), "0 to 65535"))
    try:
        family, _, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    except OSError as error:
        raise InputError(Fault("--host", "is not known", f"{host}: {error.strerror}", "take 127.0.0.1")) from None
    # named as TCP, or asyncio leaves Nagle's delay of 40 ms on every answer
    listening = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, int(os.name != "nt"))
    try:
        listening.bind(address)
        listening.listen(128)
    except OSError as error:
        listening.close()
        remedy = "choose another: --port 0 takes any that is free"
        raise InputError(Fault("--port", "cannot be listened on", f"{port}: {error.strerror}", remedy)) from None
    return listening
