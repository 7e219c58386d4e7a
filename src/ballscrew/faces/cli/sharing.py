"""Commands that write the model or its results for others: reports, exports, tables for controls, pages, the server."""

from __future__ import annotations

import contextlib
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ballscrew.faces.cli.options import AsJson, CaseArgument, Output, file_option, print_answer
from ballscrew.faces.cli.progress import progress
from ballscrew.faces.report.options import ReportOptions
from ballscrew.questions.compensation import CompensationOptions
from ballscrew.questions.hand_over import HandOverOptions
from ballscrew.questions.shared.question import CaseOptions

if TYPE_CHECKING:
    import socket

_TO = "--to"
#: Designs beside the first, as :mod:`ballscrew.faces.report.several` has letters for.
_MOST_BESIDE = 3
#: Packages that the server needs.
_NEEDS = ("fastapi", "fastapi_offline", "uvicorn", "jinja2", "typst")
_LOOPBACK = ("127.0.0.1", "localhost", "::1")
_ANY = ("0.0.0.0", "::")


def report(
    case: CaseArgument,
    to: Annotated[Path, file_option("File to write: .pdf or .html.")],
    case_options: CaseOptions,
    options: ReportOptions,
    beside: Annotated[
        list[Path] | None,
        typer.Option("--beside", metavar="CASE", help="Another design beside the first; may be repeated, up to three."),
    ] = None,
) -> None:
    """Write a report of a case as PDF or HTML.

    It has checks, results with their bands, drawing, curves, what makes the band, inputs and sources.

    With --beside other designs stand side by side with the first, checks and bands included, then each by itself. Up
    to five pages; two more with a motion, one more where that case has an [installation], one more with
    [surroundings], for four hours of warming up. The .html is one file that asks for nothing from
    outside; the .pdf can be read by machines, too (PDF/UA-1). The same case gives the same bytes: a date stands on it
    only where --date says one.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.faces.report.pdf import check_kind

    kind = check_kind(_TO, to)
    from ballscrew.basis.atomic_files import atomic_write
    from ballscrew.faces.report.contents import Heading
    from ballscrew.faces.report.pdf import report_bytes

    if len(beside or []) > _MOST_BESIDE:
        most = f"{_MOST_BESIDE} at most"
        raise InputError(Fault("--beside", "too many designs", str(len(beside or [])), most))
    loaded, *others = (case_options.load(path) for path in (case, *(beside or [])))
    heading = Heading.of(options.project, options.date)
    with progress("report") as done:
        content = report_bytes(loaded, kind, done, options.samples, heading, others)
    with atomic_write(_TO, to) as path:
        path.write_bytes(content)
    typer.echo(f"{to}: report of {case.name}, {len(content) // 1000} kB")


def hand_over(
    case: CaseArgument,
    to: Annotated[
        str, typer.Option("--to", metavar="TARGET", help="Target: c, fmu, table, …; an unknown name lists all.")
    ],
    out: Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write into.")],
    case_options: CaseOptions,
    options: HandOverOptions,
    as_json: AsJson = False,
) -> None:
    """Write the model for a simulator, a robot or a control. Its range and its worst error come with it."""
    from ballscrew.exports import hand_over
    from ballscrew.questions.hand_over import answer

    hand_over.check_target(to)
    loaded = case_options.load(case)
    request = hand_over.Request(**vars(options))
    with progress("hand-over"):
        export = hand_over.of_case(loaded, to, request)
    files = export.write(out)
    print_answer(lambda: answer.text(export, files), lambda: answer.document(export, loaded, files), as_json=as_json)


def compensation(
    case: CaseArgument,
    to: Annotated[str, typer.Option("--to", metavar="CONTROL", help="sinumerik or isg (TwinCAT CNC).")],
    out: Annotated[Path, typer.Option("--out", "-o", metavar="FILE", help="File to write.")],
    options: CompensationOptions,
    case_options: Annotated[CaseOptions, {"calibration": None}],
    output: Output,
) -> None:
    """Growth of a warm shaft as a table for a control.

    The shaft is that after hours of work; the table compensates positions of an axis with the encoder at the motor.

    Positions grow away from the fixed bearing; of an axis mounted the other way round, --direction towards turns the
    signs. It holds in that thermal state only; a warm-up that stops before the hours is refused.
    The format was checked against the example of the manual, not on a control.
    """
    from ballscrew.basis.atomic_files import atomic_write, check_writable
    from ballscrew.basis.errors import Fault, InputError, nearest
    from ballscrew.questions.compensation import answer
    from ballscrew.questions.compensation.answer import LISTS, sheet
    from ballscrew.questions.warm_up import compute

    if to not in LISTS:
        raise InputError(Fault(_TO, "unknown control", to, nearest(to, LISTS)))
    answer.check(options)
    check_writable("--out", out)
    tables = case_options.tables(case)
    loaded = case_options.build(tables, case.parent, moves=compute.moves(tables))
    warmed_up = compute.warmed_up(loaded, options.hours)
    result = answer.position_compensation(
        warmed_up,
        options.hours,
        zero=options.zero,
        direction=options.direction or "away",
        step=options.step,
        reference=options.reference,
    )
    with atomic_write("--out", out) as path:
        path.write_text(LISTS[to](result, options.axis), encoding="utf-8")
    output.note(f"{out}")
    output.print(sheet(result, warmed_up), lambda: answer.document(result, warmed_up))


def site(
    out: Annotated[Path, typer.Argument(metavar="OUT", help="Folder to write into; with --single also a file .html.")],
    single: Annotated[bool, typer.Option("--single", help="One HTML file that holds all, to send or to open.")] = False,
    model: Annotated[
        list[str] | None, typer.Option("--model", metavar="NAME", help="Only this model; may be repeated.")
    ] = None,
    nut: Annotated[
        list[str] | None, typer.Option("--nut", metavar="KIND", help="Only this kind of nut; may be repeated.")
    ] = None,
) -> None:
    """Write a page that computes in the browser alone. It needs neither a server nor Python.

    The folder can be put on any web server; a single file opens by a double click. To write it takes the compiler
    of the extra "fast"; to use it takes nothing.
    """
    from ballscrew.faces.page import site

    site.check_place(out, single=single)
    with progress("modules") as done:
        files = site.site(model or (), nut or (), single=single, done=done)
    written = site.write(out, files)
    size = sum(len(content) for content in files.values())
    place = written[-1]
    typer.echo(f"{place}: {len(written)} file{'s' if len(written) > 1 else ''}, {size / 1e6:.2f} MB")


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

    missing = [name for name in _NEEDS if importlib.util.find_spec(name) is None]
    if missing:
        raise InputError(Fault("serve", f"needs {' and '.join(missing)}", "", 'pip install "ballscrew[web]"'))
    listening = _listening(host, port)
    from ballscrew.faces.web import connections, limits, server
    from ballscrew.faces.web.job_process import Forks
    from ballscrew.faces.web.jobs import Jobs
    from ballscrew.faces.web.request_queue import TIME_LIMIT, RequestQueue

    name = f"[{host}]" if ":" in host else host
    hosts = limits.LOOPBACK if host in _LOOPBACK else ("*",) if host in _ANY else (name.lower(), *limits.LOOPBACK)
    limit = TIME_LIMIT if time_limit is None else time_limit
    jobs = Jobs(limit)
    application = server.application(hosts, RequestQueue(limit), jobs)
    server.warm_up()
    if sys.platform == "linux":  # elsewhere a fork is not safe, or there is none
        jobs.start = Forks(
            lambda requests: server.in_process(application, requests),
            listening,
            rehearsal=lambda: server.rehearsal(application),
        )
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
