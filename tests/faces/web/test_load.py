"""The server under load, for a short while; the section ``users`` of the hostile run does it for minutes."""

import concurrent.futures
import importlib.util
import io
import sys

import psutil
import pytest
from pypdf import PdfReader

from ballscrew.faces.report.pdf import pdf_bytes
from ballscrew.faces.sheets.report_blocks import Report
from ballscrew.faces.web import limits
from support.commands import ROOT

pytestmark = pytest.mark.slow

SCRIPT = ROOT / "benchmarks" / "serve.py"


@pytest.fixture(scope="module")
def serve():
    spec = importlib.util.spec_from_file_location("serve", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_fifty_users_at_once(server, serve):
    def statuses(user):
        return [server.post("run", {"case": serve.case_number(4 * user + i)}).status_code for i in range(4)]

    with concurrent.futures.ThreadPoolExecutor(50) as pool:
        assert list(pool.map(statuses, range(50))) == 50 * [[200] * 4]


@pytest.mark.skipif(sys.platform != "linux", reason="needs malloc_trim of glibc")
def test_memory_of_heavy_work_is_given_back():
    """Also that of cycles, which figures and tapes are."""

    def work(size):
        cycle = [[str(i) * 200] for i in range(size)]
        cycle.append(cycle)
        return resident()

    def resident():
        return psutil.Process().memory_info().rss / 2**20

    limits.releasing(lambda _: None)(0)  # what earlier tests left free would be used again
    before = resident()
    largest = limits.releasing(work)(150_000)
    assert largest - before > 100
    assert resident() - before < 0.3 * (largest - before)


def test_what_typst_keeps_does_not_stay_with_the_server(monkeypatch):
    """10 MB for each of the last reports: the PDF is set in a process of its own."""
    monkeypatch.setitem(sys.modules, "typst", None)
    (page,) = PdfReader(io.BytesIO(pdf_bytes(Report("Title", ["below it"], [], "ballscrew")))).pages
    assert "below it" in page.extract_text()


@pytest.mark.long
def test_memory_after_a_thousand_reports(start, serve):
    server = start()
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        bodies = ({"case": serve.case_number(i)} for i in range(1000))
        assert {found.status_code for found in pool.map(lambda body: server.post("report", body), bodies)} == {200}
    assert server.memory < 400


def test_what_is_kept_is_bounded():
    """No cache has a case or a text of a request as its key: a thousand different ones leave as many entries as one."""
    # the cache itself: nothing public tells its size
    from ballscrew.engine.evaluation.outputs import _outputs, known_outputs
    from ballscrew.physics.components.nut import SingleNut

    known_outputs(SingleNut())
    before = _outputs.cache_info().currsize
    for _ in range(100):
        known_outputs(SingleNut())
    assert _outputs.cache_info().currsize == before
