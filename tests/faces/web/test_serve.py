"""``ballscrew serve`` as a process: how it begins and how it ends."""

import asyncio
import contextlib
import json
import signal
import socket
import subprocess
import sys
import time
import unittest.mock

import httpx
import pytest
import uvicorn

from ballscrew.faces.web import connections, server

from .conftest import run_scene

ENDS = (0, 130)


def test_it_says_where_it_is(start):
    server = start()
    assert server.first_line.startswith(f"ballscrew in the browser: {server.address} · API: {server.address}/api")
    assert server.get("schema").status_code == 200
    assert server.end() == (0, "")


def test_a_port_in_use_is_one_line(ballscrew):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        process = ballscrew("serve", "--port", str(taken.getsockname()[1]))
    assert process.returncode == 2
    assert process.stdout == ""
    (line,) = process.stderr.strip().splitlines()
    assert line.startswith("--port: cannot be listened on")
    assert "--port 0" in line


@pytest.mark.parametrize(
    ("options", "expected"),
    [(["--port", "70000"], "--port: is no port (70000)"), (["--host", "no.such.host.invalid"], "--host: is not known")],
)
def test_bad_options(options, expected, ballscrew):
    process = ballscrew("serve", *options)
    assert process.returncode == 2
    assert process.stderr.startswith(expected)
    assert len(process.stderr.strip().splitlines()) == 1


def test_without_the_extra_it_says_what_to_install(tmp_path):
    """As on an installation without it: the packages cannot be found."""
    program = (
        "import sys, importlib.util as u; find = u.find_spec\n"
        "u.find_spec = lambda name, *more: None if name in ('fastapi', 'uvicorn') else find(name, *more)\n"
        "from ballscrew.faces.cli import main; sys.argv = ['ballscrew', 'serve']; main.main()"
    )
    process = subprocess.run([sys.executable, "-c", program], capture_output=True, encoding="utf-8", check=False)
    assert process.returncode == 2
    assert process.stderr == 'serve: needs fastapi and uvicorn · pip install "ballscrew[web]"\n'


def connected(server):
    return socket.create_connection(("127.0.0.1", server.port), timeout=60)


def request_bytes(address, case):
    body = json.dumps({"case": case}).encode()
    head = (
        f"POST {address} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: {len(body)}"
    )
    return head.encode() + b"\r\n\r\n" + body


def status_of(connection):
    """The status of the response on a connection; a reset of the connection is an error."""
    return int(connection.recv(65_536).split()[1])


@pytest.mark.slow
def test_it_ends_at_once_while_it_computes(start, elastic):
    """Also with a body that does not come to its end, and with a connection that says nothing."""
    server = start()
    with contextlib.ExitStack() as stack:
        asked, (slow, _) = ([stack.enter_context(connected(server)) for _ in range(count)] for count in (3, 2))
        for connection in asked:
            connection.sendall(request_bytes("/api/v1/band", elastic))
        before = server.processor_time
        while server.processor_time < before + 0.1:  # more than it takes to read the requests: it computes
            time.sleep(0.01)
        slow.sendall(request_bytes("/api/v1/run", elastic)[:-9])
        code, errors = server.end()
        assert {status_of(connection) for connection in asked} <= {200, 503}
        with contextlib.suppress(ConnectionResetError):
            assert slow.recv(65_536) == b"", "it waited until the body was late"
    assert code in ENDS
    assert "Traceback" not in errors


@pytest.mark.parametrize("accepted", [False, True])
def test_what_was_sent_before_the_end_is_answered(paper, accepted):
    """Requests that the kernel has, on connections that are accepted or not, and that are not read yet.

    A client that has not sent its whole request by then may be reset: no server can answer what it has not got.
    """
    listening = socket.create_server(("127.0.0.1", 0))
    application = server.application()

    async def scene():
        config = uvicorn.Config(application, http=connections._TimeoutProtocol, lifespan="off", log_level="error")
        server = connections._Server(config, application.state.requests, application.state.jobs)
        config.load()
        server.lifespan = config.lifespan_class(config)
        await server.startup([listening])
        asked = [socket.create_connection(listening.getsockname(), timeout=60) for _ in range(5)]
        while accepted and len(server.server_state.connections) < len(asked):
            await asyncio.sleep(0)
        for connection in asked:
            connection.sendall(request_bytes("/api/v1/run", paper))
        await server.shutdown([listening])
        return asked

    with contextlib.ExitStack() as stack:
        asked = [stack.enter_context(connection) for connection in run_scene(scene())]
        assert [status_of(connection) for connection in asked] == [503] * 5


def test_warnings_do_not_reach_the_terminal(start):
    """Of NumPy: the answer says what has no value, and nobody reads the terminal."""
    server = start(module="warning_server", errors=())
    assert server.get("catalogue").status_code == 200
    assert server.end() == (0, "")


@pytest.mark.slow
def test_a_second_signal_ends_it_too(start):
    server = start()
    for _ in range(2):
        server.process.send_signal(signal.SIGINT)
    assert server.end()[0] in ENDS


def test_everybody_may_ask_where_others_are_let_in(start):
    """And only then: the page of another site must not be able to."""
    server = start("--host", "0.0.0.0")
    found = httpx.get(
        f"http://127.0.0.1:{server.port}/api/v1/schema", headers={"Host": "ballscrew.example"}, trust_env=False
    )
    assert found.status_code == 200
    assert "no password" in server.said()


def test_it_answers_to_its_own_address(start):
    """As browsers write it: in small letters, and in brackets where it has colons."""
    try:
        socket.create_server(("::1", 0), family=socket.AF_INET6).close()
    except OSError:
        pytest.skip("needs IPv6")
    server = start("--host", "0:0:0:0:0:0:0:1")
    assert server.get("schema", headers={"Host": f"[0:0:0:0:0:0:0:1]:{server.port}"}).status_code == 200
    assert server.get("schema", headers={"Host": "[::2]"}).status_code == 421


@pytest.mark.parametrize("reads", [True, False])
def test_unread_responses_time_out(monkeypatch, reads):
    """Or each client could keep its response in memory for as long as it likes."""
    monkeypatch.setattr(connections, "_WRITE_TIMEOUT", 0.05)
    transport = unittest.mock.Mock()
    transport.get_extra_info.return_value = None

    async def scene():
        config = uvicorn.Config(lambda: None, ws="none", lifespan="off", log_level="error")
        protocol = connections._TimeoutProtocol(config, uvicorn.server.ServerState(), {})
        protocol.connection_made(transport)
        protocol.pause_writing()
        if reads:
            protocol.resume_writing()
        await asyncio.sleep(0.3)
        protocol.connection_lost(None)

    run_scene(scene())
    assert transport.abort.called != reads
