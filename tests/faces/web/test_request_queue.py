"""Time limits and the queue, with small limits."""

import asyncio
import subprocess
import sys
import threading
import time

import pytest

from ballscrew.faces.web import api
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import RequestQueue

from .conftest import ask_and_leave, asking, run_scene

#: Longer than any test takes, also on a busy machine.
LONG = 600


async def idle():
    """Wait until no work is running; the test fails by its time limit where it goes on."""
    while busy:
        await asyncio.sleep(0.01)


def reporting(seconds):
    """Work that reports its progress, for some seconds."""

    def work(done):
        busy.append(1)
        try:
            end = time.monotonic() + seconds
            while time.monotonic() < end:  # it computes: only that counts
                done(1, 2)
        finally:
            busy.pop()
        return "finished"

    return work


#: One entry for each running work.
busy = []


def test_work_is_stopped_at_its_time_limit():
    async def scene():
        queue = RequestQueue(time_limit=LONG)
        assert await queue.heavy(reporting(0.02)) == "finished"
        queue.time_limit = 0.1
        with pytest.raises(Refused) as caught:
            await queue.heavy(reporting(LONG))
        assert caught.value.status == 422  # a browser sends a request again in silence that is refused with 408
        assert str(caught.value.faults[0]).startswith(
            "server: stopped the work, which took too long (0.1 s of processor time)"
        )
        await asyncio.wait_for(idle(), LONG / 2)
        queue.time_limit = LONG
        assert await queue.heavy(reporting(0.02)) == "finished"

    run_scene(scene())


def test_only_processor_time_counts():
    """Not that of other work on the machine, which this one waits for."""

    async def scene():
        def slow(done):
            time.sleep(1.5)
            done(1, 2)
            return "finished"

        assert await RequestQueue(time_limit=0.1).heavy(slow) == "finished"

    run_scene(scene())


def test_work_that_cannot_be_stopped_keeps_its_place():
    """Or more requests would compute than there are places."""

    async def scene():
        queue, go_on = RequestQueue(time_limit=0.1, heavy=1, waiting=1), threading.Event()

        def deaf(_):
            while not go_on.is_set():
                pass

        with pytest.raises(Refused) as caught:
            await queue.heavy(deaf)
        assert caught.value.status == 422
        queue.time_limit = LONG  # of the second, which waits
        second = asyncio.create_task(queue.heavy(lambda _: "second"))
        await asyncio.sleep(0.05)
        assert not second.done()
        go_on.set()
        assert await second == "second"

    run_scene(scene())


def test_beyond_the_queue_it_is_refused_and_quick_work_goes_on():
    async def scene():
        queue, go_on = RequestQueue(time_limit=LONG, quick=1, heavy=2, waiting=3), threading.Event()
        heavy = [asyncio.create_task(queue.heavy(lambda _: go_on.wait(LONG))) for _ in range(5)]
        await asyncio.sleep(0.05)
        for _ in range(3):
            with pytest.raises(Refused) as caught:
                await queue.heavy(reporting(0))
            assert caught.value.status == 429
        assert [await queue.quick(lambda i=i: i) for i in range(20)] == list(range(20))
        assert not any(task.done() for task in heavy)
        go_on.set()
        assert await asyncio.gather(*heavy) == [True] * 5
        assert await queue.heavy(reporting(0)) == "finished"

    run_scene(scene())


def test_a_short_sweep_does_not_wait_for_bands(paper):
    """One of some hundred points takes 20 to 90 ms; a long one waits its turn, and here there is no room left."""
    queue, go_on = RequestQueue(time_limit=LONG, heavy=1, waiting=1), threading.Event()

    async def begin():
        return [asyncio.create_task(queue.heavy(lambda _: go_on.wait(LONG))) for _ in range(2)]

    with asking(requests=queue) as client:
        heavy = client.portal.call(begin)

        def status(points):
            body = {"case": paper, "vary": {"axial_load": f"1:9000:{points} N"}, "outputs": ["screw_torque"]}
            return client.post("/api/v1/sweep", json=body).status_code

        assert (status(400), status(5000)) == (200, 429)
        assert not any(task.done() for task in heavy)
        go_on.set()


def test_an_error_is_raised_and_frees_its_place():
    async def scene():
        queue = RequestQueue(quick=1)

        def wrong():
            raise KeyError("x")

        for _ in range(3):
            with pytest.raises(KeyError):
                await queue.quick(wrong)
        assert await queue.quick(lambda: 1) == 1

    run_scene(scene())


def test_a_cancelled_request_stops_its_work():
    async def scene():
        queue = RequestQueue(time_limit=LONG)
        task = asyncio.create_task(queue.heavy(reporting(LONG)))
        await asyncio.sleep(0.05)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        await asyncio.wait_for(idle(), LONG / 2)

    run_scene(scene())


def test_requests_are_refused_at_shutdown():
    async def scene():
        queue, go_on = RequestQueue(time_limit=LONG, heavy=1), threading.Event()
        tasks = [asyncio.create_task(queue.heavy(lambda _: go_on.wait(LONG))) for _ in range(2)]
        await asyncio.sleep(0.05)
        queue.close()
        found = await asyncio.wait_for(asyncio.gather(tasks[0], return_exceptions=True), LONG / 2)
        assert found[0].status == 503
        go_on.set()
        assert (await asyncio.gather(tasks[1], return_exceptions=True))[0].status == 503

    run_scene(scene())


def test_work_does_not_keep_the_program_from_ending():
    """Also work that never calls its deadline; threads of anyio would be waited for."""
    program = (
        "import asyncio, time\n"
        "from ballscrew.faces.web.request_queue import RequestQueue\n"
        "async def scene():\n"
        "    task = asyncio.ensure_future(RequestQueue().heavy(lambda _: time.sleep(600)))\n"
        "    await asyncio.sleep(0.1)\n"
        "    task.cancel()\n"
        "asyncio.run(scene())"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=300)


def test_threads_are_reused():
    """Each has memory of its own, which a thousand of them would leave behind."""

    async def scene():
        queue, seen = RequestQueue(heavy=2), set()
        for _ in range(20):
            await asyncio.gather(*(queue.heavy(lambda _: seen.add(threading.get_ident())) for _ in range(4)))
        assert len(seen) <= 2

    run_scene(scene())


def test_a_disconnect_stops_the_work(monkeypatch, paper):
    """The application is called as by a server: with a body, and then with a disconnect."""
    begun, stopped = threading.Event(), threading.Event()

    def endless(case, options, done):
        begun.set()
        try:
            reporting(LONG)(done)
        finally:
            stopped.set()

    monkeypatch.setattr(api.compute, "band", endless)
    ask_and_leave("band", paper, begun, stopped)


def test_the_samples_of_a_sweep_are_refused_before_it_waits(paper):
    """Defect: they were counted after the sweep was computed. No heavy request may wait here: it would be a 429."""

    with asking(requests=RequestQueue(waiting=0)) as client:
        body = {"case": paper, "vary": {"axial_load": "1:2:9 kN"}, "band": True, "samples": 10**9}
        found = client.post("/api/v1/sweep", json=body)
    assert (found.status_code, "--samples: too many" in found.text) == (422, True), found.text[:300]
