"""Whatever is sent: a clear refusal, and the server goes on as before."""

import base64
import concurrent.futures
import contextlib
import io
import json
import random
import select
import socket
import time
import tomllib
import zipfile

import pytest

from ballscrew.faces.web import limits
from support.short_timeouts import READ_TIMEOUT

from .conftest import ROOT

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def unharmed(server, paper):
    """After each test a usual request is answered as ever."""
    yield
    assert server.post("run", {"case": paper}).status_code == 200


def refused(server, address, body, status, words, **more):
    found = server.post(address, body, **more)
    assert found.status_code == status, found.text[:500]
    assert found.headers["content-type"] == "application/problem+json"
    assert found.headers["x-content-type-options"] == "nosniff"
    assert any(words in line for line in found.json()["lines"]), found.json()["lines"]
    assert all(len(line) < 8000 for line in found.json()["lines"])


def with_value(case, section, field, value):
    return {"case": {**case, section: {**case.get(section, {}), field: value}}}


BODIES = {
    "no JSON": (b"{", 400, "request: is not JSON"),
    "nothing": (b"", 400, "request: is not JSON"),
    "not UTF-8": (b'{"case": "\xff"}', 400, "request: is not JSON"),
    "NaN": (b'{"case": NaN}', 400, "NaN is no JSON number"),
    "infinity": (b'{"case": -Infinity}', 400, "-Infinity is no JSON number"),
    "1e999": (b'{"case": {"screw": {"loaded_balls": 1e999}}}', 400, "1e999 is too large for a number"),
    "a number of 4000 digits": (b'{"case": {}, "samples": %s}' % (b"1" * 5000), 400, "request: is not JSON"),
    "twice": (b'{"case": {"screw": {}, "screw": {}}}', 400, "screw is given twice"),
    "deep": (b'{"case": %s%s}' % (b"[" * 20, b"]" * 20), 400, "request: is nested too deeply"),
    "very deep": (b'{"case": %s' % (b"[" * 60000), 400, "request: is nested too deeply"),
    "very deep tables": (b'{"case":' * 7000, 400, "request: is nested too deeply"),
    "a list": (b"[]", 422, "request: must be a table"),
    "null": (b"null", 422, "request: must be a table"),
    "many values": (json.dumps({"case": {"screw": [0] * 1100}}).encode(), 413, "more than 1000 values"),
    "long text": (json.dumps({"case": {"screw": "x" * 1100}}).encode(), 413, "a text of more than 1000 characters"),
    "long name": (json.dumps({"case": {"x" * 1100: 1}}).encode(), 413, "a text of more than 1000 characters"),
    "unpaired surrogate": (b'{"case": {"screw": "\\ud800"}}', 400, "unpaired surrogate"),
    "another name": (b'{"case": {}, "model": "reference"}', 422, "request.model: unknown key"),
    "large": (b" " * 10_000_000, 413, "more than"),
}


@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("address", ["run", "band", "fit"])
def test_bodies(server, name, address):
    refused(server, address, *BODIES[name])


def test_a_body_without_length(server):
    """In pieces, and nobody says beforehand how many."""

    def pieces():
        for _ in range(160):
            yield b" " * 65_536

    found = server.client.post("/api/v1/run", content=pieces(), headers={"Content-Type": "application/json"})
    assert found.status_code == 413


@pytest.mark.parametrize("media", ["text/plain", "", "application/x-www-form-urlencoded", "multipart/form-data"])
def test_other_kinds_of_bodies(server, paper, media):
    refused(server, "run", {"case": paper}, 415, "Content-Type", headers={"Content-Type": media})


VALUES = {
    "a path": ("screw", "catalogue_file", "../../etc/passwd", "screw.catalogue_file: is not taken from a request"),
    "an address": ("screw", "catalogue_file", "file:///etc/passwd", "screw.catalogue_file"),
    "a path as a row": ("screw", "catalogue", "../../etc/passwd", "screw.catalogue: unknown row"),
    "a path as a calibration": ("model", "calibration", "../calibrations.toml", "model.calibration: unknown"),
    "a path as a law": ("model", "friction", "/etc/passwd", "model.friction: unknown law"),
    "code as a law": ("model", "friction", "os:getcwd", "model.friction: is code from outside, which is not allowed"),
    "a script": ("screw", "lead", "<script>alert(1)</script>", "screw.lead: is not a number with a unit"),
    "NUL": ("screw", "lead", "5 mm\x00", "screw.lead: unknown unit"),
    "powers": ("screw", "lead", "5 m**9**9", "screw.lead: unknown unit"),
    "minus nothing": ("screw", "loaded_balls", -0.0, "screw.loaded_balls: must be at least 1"),
    "4000 digits": ("screw", "loaded_balls", 10**4000, "screw.loaded_balls"),
    "null": ("screw", "loaded_balls", None, "screw.loaded_balls: must not be null"),
    "truth": ("screw", "loaded_balls", True, "screw.loaded_balls: must be a number"),
    "a list": ("screw", "loaded_balls", [56], "screw.loaded_balls: must be a number"),
    "long": ("screw", "lead", "+ " * 490, "screw.lead: has more than 200 letters"),
    "long number": ("screw", "lead", "1" * 900 + " mm", "screw.lead: has more than 200 letters"),
    "long unit": ("screw", "lead", "5 " + "m" * 900, "screw.lead: has more than 200 letters"),
    "distribution": ("screw", "lead", "uniform(2, 1) mm", "screw.lead"),
    "distribution in a distribution": ("screw", "lead", "normal(normal(1,2),3) mm", "screw.lead"),
}


@pytest.mark.parametrize("name", VALUES)
def test_values(server, paper, name):
    section, field, value, words = VALUES[name]
    for address in ("run", "sweep", "toml"):
        refused(server, address, with_value(paper, section, field, value), 422, words)


def test_a_number_of_balls_may_be_any(server, paper):
    """Where they are all alike, it is what it is."""
    assert server.post("run", with_value(paper, "screw", "loaded_balls", 1e308)).status_code in (200, 422)


def test_many_faults_at_once(server, paper):
    """A text that patterns take long for, in all fields, and hundreds of names that are nearly known."""
    case = {name: dict.fromkeys(table, "   " * 100 + "+" + " " * 500) for name, table in paper.items()}
    refused(server, "run", {"case": case}, 422, "has more than 200 letters")
    unknown = {f"axial_lod{i}": "1 N" for i in range(900)}
    refused(server, "run", {"case": {**paper, "operation": unknown}}, 422, "unknown key")
    refused(server, "sweep", {"case": paper, "outputs": list(unknown)}, 422, "unknown output")


def packed(size):
    """A workbook that unpacks to so many bytes."""
    with io.BytesIO() as made:
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("xl/workbook.xml", b"<workbook/>" + b" " * size)
        return made.getvalue()


HEADINGS = b"speed [rpm],axial load [N],torque [N m]\n"
#: Contents of logs and what is said of them; None where there are numbers that may be fitted.
LOGS = {
    "no bytes": (b"", "is empty"),
    "empty lines": (b"\n" * 1000, "is empty"),
    "only headings": (HEADINGS, ""),
    "zeros": (b"\0" * 4000, ""),
    "random bytes": (random.Random(1).randbytes(4000), ""),
    "a picture": (b"\x89PNG\r\n\x1a\n" + random.Random(2).randbytes(900), ""),
    "no workbook": (b"PK\x03\x04" + random.Random(3).randbytes(900), ""),
    "a workbook with nothing in it": (packed(10), ""),
    "an old workbook": (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + random.Random(4).randbytes(2000), ""),
    "MATLAB": (b"MATLAB 5.0 MAT-file" + random.Random(5).randbytes(2000), ""),
    "MATLAB 7.3": (b"MATLAB 7.3 MAT-file" + b" " * 493 + b"\x89HDF\r\n\x1a\n" + b"\0" * 500, ""),
    "many columns": (
        b",".join(b"a%d" % i for i in range(20_000)) + b"\n" + b"1," * 20_000,
        "has too many columns (20,001)",
    ),
    "many headings": (b",".join([b"torque [N m]"] * 900) + b"\n" + b"1," * 900, ""),
    "a long line": (HEADINGS + b"1" * 1_000_000, ""),
    "a quote without end": (HEADINGS + b'"1,2,3\n' * 100, ""),
    "NaN": (HEADINGS + b"nan,nan,nan\n" * 50, ""),
    "infinity": (HEADINGS + b"inf,-inf,1e999\n" * 50, ""),
    "huge": (HEADINGS + b"1e308,1e308,1e308\n" * 50, ""),
    "zeros in all rows": (HEADINGS + b"0,0,0\n" * 50, ""),
    "one row again and again": (HEADINGS + b"50,1000,0.8\n" * 50, None),
    "formulas": (HEADINGS + b"=1+1,@SUM(A1:A9),=cmd|'/c calc'!A0\n" * 50, "is not a number"),
    "errors of a spreadsheet": (HEADINGS + b"#DIV/0!,#N/A,#REF!\n" * 50, ""),
    "scripts": (b"<script>alert(1)</script>,torque [N m]\n1,2\n", ""),
    "other digits": (HEADINGS + "١,٢,٣\n".encode() * 5, None),
    "only commas": (b"," * 100_000 + b"\n", ""),
}


@pytest.mark.parametrize("name", LOGS)
def test_logs(server, paper, name):
    """Whatever is in them, they are read or refused, by their own name; a fit of no use is refused as well."""
    content, words = LOGS[name]
    case = {**paper, "model": {"name": "olaru2005"}, "nut": {"type": "double", "preload": "1 kN"}}
    log = {"name": "log.csv", "base64": base64.b64encode(content).decode()}
    asked = [("log", {"log": log}), ("fit", {"log": log})][name.startswith("MATLAB") :]  # a process for each
    for address, body in [*asked, *[("service", {"worn": log})] * (name in ("NaN", "random bytes"))]:
        found = server.post(address, {"case": case, **body})
        if found.status_code == 200 and (address == "log" or words is None):
            continue  # its columns are shown, good or not; numbers are fitted, however few they are
        refused(server, address, {"case": case, **body}, 422, words)


@pytest.mark.parametrize("content", [b"\0" * 4000, b"\n" * 1000, b"", b" \n\t\n"], ids=["NUL", "lines", "no", "blanks"])
def test_traces_with_nothing_in_them(server, content):
    """Defect: status 500, as there was no first row to name."""
    case = tomllib.loads((ROOT / "examples" / "vertical_axis.toml").read_text(encoding="utf-8"))
    trace = {"name": "trace.csv", "base64": base64.b64encode(content).decode()}
    refused(server, "duty", {"case": case, "trace": trace}, 422, "trace.csv: is empty")


@pytest.mark.parametrize(
    ("address", "more", "status", "words"),
    [
        ("fit", {}, 422, "request.log: missing"),
        ("fit", {"log": "speed"}, 422, "request.log"),
        ("fit", {"log": {"name": "x" * 2000, "text": ""}}, 413, "a text of more than 1000 characters"),
        ("fit", {"log": {"name": "x.csv", "text": ["a"] * 2000}}, 413, "more than 1000 values"),
        ("fit", {"log": {"name": "x.csv", "text": "\ud800"}}, 422, "log.text: has an unpaired surrogate"),
        ("fit", {"log": {"name": "x.csv", "text": "a"}, "free": ["x" * 900]}, 422, ""),
        ("fit", {"log": {"name": "x.csv", "text": "a"}, "bounds": {"../../etc/passwd": "1:2"}}, 422, "--bounds"),
        ("fit", {"log": {"name": "x.csv", "text": "a"}, "limits": {"screw_speed": "9" * 900}}, 422, "--limits"),
        ("fit", {"log": {"name": "x.csv", "text": "a"}, "columns": {"torque": "../../etc/passwd"}}, 422, ""),
        ("fit", {"log": {"name": "x.csv", "text": "a"}, "holdout": 1e308}, 422, ""),
        ("fit", {"log": {"name": "x.csv", "text": "a"}, "seed": 10**4000}, 422, ""),
        ("fit", {"log": {"name": "x.csv", "text": "x" * 5_000_000}}, 413, "more than 4194304 bytes"),
        ("service", {"worn": {"name": "x.csv", "text": "a"}, "tolerance": -5}, 422, ""),
        ("hand-over", {}, 422, "request.to: missing"),
        ("hand-over", {"to": "../../etc/passwd"}, 422, "unknown target"),
        ("hand-over", {"to": "os"}, 422, "unknown target"),
        ("hand-over", {"to": "drive", "options": {"points": "-1"}}, 422, "points"),
        ("hand-over", {"to": "mujoco", "options": {"plugin": "../../x"}}, 422, "plugin"),
        ("hand-over", {"to": "linuxcnc", "options": {"joint": "1e999"}}, 422, "joint"),
        ("hand-over", {"to": "c", "ranges": {"axial_load": "1e308:-1e308 N"}}, 422, "axial_load"),
        ("hand-over", {"to": "table", "options": {"tolerance": "1e-300"}}, 422, "tolerance"),
    ],
)
def test_options_of_logs_and_targets(server, paper, address, more, status, words):
    refused(server, address, {"case": paper, **more}, status, words)


SWEEPS = {
    "points": ({"axial_load": "1:2:1000000000 N"}, "too many points"),
    "points of two axes": ({"axial_load": "1:2:200 N", "screw_speed": "1:2:200 rpm"}, "too many points (40,000)"),
    "hidden by none": ({"axial_load": "1:2:0 N", "screw_speed": "1:2:9000000 rpm"}, "too many points"),
    "axes": ({f"axis{i}": "1:2:999999999 N" for i in range(900)}, "too many axes"),
    "axes of one": ({f"axis{i}": "1 N" for i in range(20)}, "too many axes"),
    "digits": ({"axial_load": "1:2:" + "9" * 900 + " N"}, "sweep.axial_load"),
    "names": ({"../../etc/passwd": "1 N"}, "sweep.../../etc/passwd: unknown field"),
}


@pytest.mark.parametrize("name", SWEEPS)
def test_sweeps(server, paper, name):
    vary, words = SWEEPS[name]
    refused(server, "sweep", {"case": paper, "vary": vary}, 422, words)
    refused(server, "sweep", {"case": {**paper, "sweep": vary}}, 422, words)


def test_sweeps_of_nuts(server, paper, elastic):
    double = {**paper, "nut": {"type": "double", "preload": "1 kN"}}
    some = {"axial_load": "1:2:1500 N"}
    assert server.post("sweep", {"case": double, "vary": some}).status_code == 200
    refused(server, "sweep", {"case": elastic, "vary": {"axial_load": "1:2:20000 N"}}, 422, "too many values (220,000)")
    outputs = [f"contribution_{name}" for name in ("spin", "helix", "curvature")] * 30
    wide = {"case": paper, "vary": {"axial_load": "1:2:9000 N"}, "outputs": outputs}
    refused(server, "sweep", wide, 422, "too many values (810,000)")
    banded = {"case": paper, "vary": {"screw.lead": "5:10:9000 mm"}, "outputs": [*"abcdefgh"], "band": True}
    refused(server, "sweep", banded, 422, "too many values (504,000)")  # the ends of all intervals are values, too


@pytest.mark.parametrize("balls", [1e18, 10**18, 501, 1e300])
@pytest.mark.parametrize("more", [{"bodies": {}}, {"deviations": {"lead": "1 um"}}], ids=lambda more: next(iter(more)))
def test_balls_one_by_one(server, paper, balls, more):
    case = {**with_value(paper, "screw", "loaded_balls", balls)["case"], **more}
    for address in ("run", "compare", "band", "sweep", "toml", "drawing", "report"):
        problem = "too many to compute one by one" if balls <= 10_000 else "must be at most 10000"
        refused(server, address, {"case": case}, 422, f"screw.loaded_balls: {problem}")


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"samples": 10**12}, "--samples: too many (1,000,000,000,000)"),
        ({"samples": 10**4000}, "--samples: too many"),
        ({"samples": -5}, "--samples"),
        ({"samples": 1.5}, "request.samples"),
        ({"samples": "64"}, "request.samples"),
        ({"level": 2}, "--level"),
        ({"level": -0.0}, "--level"),
        ({"level": 1e308}, "--level"),
        ({"only_given": 1}, "request.only_given: must be true or false"),
    ],
)
def test_bands(server, paper, more, words):
    refused(server, "band", {"case": paper, **more}, 422, words)


def test_a_band_of_very_many_balls_has_fewer_samples(server, elastic):
    """Where their number is not asked for; the answer says it."""
    many = with_value(elastic, "screw", "loaded_balls", 400)
    assert server.post("band", many).json()["band"]["samples"] == limits.USUAL_BALLS_IN_ALL // 800


@pytest.mark.parametrize("name", ["..%2f..%2fetc%2fpasswd", "%00", "%ff", "<script>", "a" * 5000, "%F0%9F%98%80"])
def test_names_in_addresses(server, name):
    for path in (f"/api/v1/catalogue/{name}", f"/page-{name}.js", f"/viewer/{name}"):
        found = server.client.get(path)
        assert found.status_code == 404
        assert found.headers["content-type"] == "application/problem+json"
        assert "/" not in found.json()["lines"][0].partition(":")[0]  # no address of the server
        assert "<script>" not in found.text or found.headers["x-content-type-options"] == "nosniff"


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("catalogue?word=40x", "?word: unknown"),
        ("catalogue?words=a&words=b", "?words: is given twice"),
        ("schema?x=1", "?x: unknown"),
        ("validate?set=../../etc/passwd", "validate: unknown set"),
        ("validate?rows=/etc/passwd", "?rows: unknown"),
    ],
)
def test_words_behind_the_question_mark(server, path, words):
    found = server.get(path)
    assert (found.status_code, words in found.text) == (422, True)


@pytest.mark.parametrize("host", ["ballscrew.example", "127.0.0.1.example:80", "localhost.example", "", "[::2]:80"])
def test_names_of_other_sites(server, host):
    """No other site's page can read what is here by giving itself this address."""
    found = server.get("schema", headers={"Host": host})
    assert found.status_code == 421
    assert found.json()["lines"][0].startswith("Host: is not a name of this server")
    assert "content-security-policy" in found.headers


@pytest.mark.parametrize("host", ["localhost", "LOCALHOST:1", "127.0.0.1", "[::1]", "[::1]:80"])
def test_own_names(server, host):
    assert server.get("schema", headers={"Host": host}).status_code == 200


def raw(server, text, wait=120.0):
    """What comes back for bytes."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=wait) as connection:
        connection.sendall(text)
        found = b""
        while piece := connection.recv(65_536):
            found += piece
        return found


@pytest.mark.parametrize(
    "beginning", [b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ", b"GET /"], ids=["header", "address"]
)
def test_what_never_ends_is_not_read_to_its_end(server, beginning):
    """Whether the refusal arrives hangs on how much of it was on its way."""
    before = server.memory
    with contextlib.suppress(ConnectionResetError, BrokenPipeError):
        assert raw(server, beginning + b"x" * 40_000_000).startswith(b"HTTP/1.1 400")
    assert server.memory - before < 20


HEAD = b"POST /api/v1/run HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 500\r\n\r\n"


def test_slow_ones_hold_up_nobody(start, paper):
    """Half a request each, of heads and of bodies, on a hundred connections."""
    server = start(module="short_timeouts")
    slow = [socket.create_connection(("127.0.0.1", server.port), timeout=300) for _ in range(100)]
    try:
        for i, connection in enumerate(slow):
            connection.sendall((b"", HEAD[:40], HEAD, HEAD + b'{"case": ')[i % 4])
        begun = time.monotonic()
        assert server.post("run", {"case": paper}).status_code == 200
        assert not select.select(slow, [], [], 0)[0], "it was answered when the slow ones had been sent away"
        for _ in range(20):
            assert server.post("run", {"case": paper}).status_code == 200
        found = [b"".join(iter(lambda connection=connection: connection.recv(65_536), b"")) for connection in slow[:4]]
        assert time.monotonic() - begun > READ_TIMEOUT - 1
    finally:
        for connection in slow:
            connection.close()
    assert found[:2] == [b"", b""]
    assert all(b"HTTP/1.1 408" in answer and b"did not arrive within" in answer for answer in found[2:])


def test_those_who_leave(server):
    """In the middle of a head, of a body, and before the answer."""
    for text in (HEAD[:50], HEAD, HEAD + b"{", HEAD + b" " * 500, HEAD.replace(b"run", b"band") + b"{}" + b" " * 498):
        for _ in range(20):
            with socket.create_connection(("127.0.0.1", server.port)) as connection:
                connection.sendall(text)


def test_memory_does_not_grow(server, paper):
    """A thousand refusals of all kinds, each with another text, leave nothing behind."""

    def one(i):
        long = f"{i} " * 40
        server.post("run", with_value(paper, "screw", "lead", f"{i} mm {long}"))
        server.post("run", with_value(paper, "screw", f"leed{i}", "5 mm"))
        server.post("sweep", {"case": paper, "vary": {f"axial_load{i}": "1:2:3 N"}})
        server.post("run", b" " * 1_000_000)

    def some(first, last):
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            list(pool.map(one, range(first, last)))
        return server.memory

    some(0, 50)
    before = some(50, 100)
    assert some(100, 300) - before < 10
