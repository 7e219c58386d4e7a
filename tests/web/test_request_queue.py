"""Time limits and the queue, at a desk of small limits."""

import asyncio
import concurrent.futures
import json
import threading
import time

import pytest

from ballscrew.interfaces.web import api, server
from ballscrew.interfaces.web.problems import Refused
from ballscrew.interfaces.web.work import Desk


def played(scene):
    """In a thread of its own: a browser that is open in this process keeps a loop running in the first one."""
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        pool.submit(asyncio.run, scene).result()


def told(seconds):
    """Work that says how far it is, for so long."""

    def work(done):
        busy.append(1)
        try:
            end = time.monotonic() + seconds
            while time.monotonic() < end:
                time.sleep(0.005)
                done(1, 2)
        finally:
            busy.pop()
        return "finished"

    return work


#: One for each that is at work.
busy = []


def test_what_takes_too_long_is_stopped():
    async def scene():
        desk = Desk(longest=0.1)
        assert await desk.heavy(told(0.02)) == "finished"
        before = time.monotonic()
        with pytest.raises(Refused) as caught:
            await desk.heavy(told(60))
        assert caught.value.status == 408
        assert str(caught.value.faults[0]).startswith("server: stopped after 0.1 s")
        assert time.monotonic() - before < 1
        await asyncio.sleep(0.1)
        assert not busy
        assert await desk.heavy(told(0.02)) == "finished"

    played(scene())


def test_what_cannot_be_stopped_keeps_its_place():
    """Or more would compute than there are places for."""

    async def scene():
        desk, go_on = Desk(longest=0.1, heavy=1, waiting=1), threading.Event()
        with pytest.raises(Refused) as caught:
            await desk.heavy(lambda _: go_on.wait(60))
        assert caught.value.status == 408
        second = asyncio.create_task(desk.heavy(lambda _: "second"))
        await asyncio.sleep(0.05)
        assert not second.done()
        go_on.set()
        assert await second == "second"

    played(scene())


def test_beyond_the_queue_it_is_refused_and_quick_work_goes_on():
    async def scene():
        desk, go_on = Desk(longest=10, quick=1, heavy=2, waiting=3), threading.Event()
        heavy = [asyncio.create_task(desk.heavy(lambda _: go_on.wait(60))) for _ in range(5)]
        await asyncio.sleep(0.05)
        for _ in range(3):
            with pytest.raises(Refused) as caught:
                await desk.heavy(told(0))
            assert caught.value.status == 429
        before = time.monotonic()
        assert [await desk.quick(lambda i=i: i) for i in range(20)] == list(range(20))
        assert time.monotonic() - before < 0.5
        go_on.set()
        assert await asyncio.gather(*heavy) == [True] * 5
        assert await desk.heavy(told(0)) == "finished"

    played(scene())


def test_a_fault_is_handed_on_and_frees_its_place():
    async def scene():
        desk = Desk(quick=1)

        def wrong():
            raise KeyError("x")

        for _ in range(3):
            with pytest.raises(KeyError):
                await desk.quick(wrong)
        assert await desk.quick(lambda: 1) == 1

    played(scene())


def test_who_leaves_stops_what_was_for_them():
    async def scene():
        desk = Desk(longest=10)
        task = asyncio.create_task(desk.heavy(told(60)))
        await asyncio.sleep(0.05)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        await asyncio.sleep(0.1)
        assert not busy

    played(scene())


def test_when_it_closes_nobody_waits():
    async def scene():
        desk, go_on = Desk(longest=10, heavy=1), threading.Event()
        tasks = [asyncio.create_task(desk.heavy(lambda _: go_on.wait(60))) for _ in range(2)]
        await asyncio.sleep(0.05)
        desk.close()
        found = await asyncio.wait_for(asyncio.gather(tasks[0], return_exceptions=True), 1)
        assert found[0].status == 503
        go_on.set()
        assert (await asyncio.gather(tasks[1], return_exceptions=True))[0].status == 503

    played(scene())


def test_threads_are_used_again():
    """Each has memory of its own, which a thousand of them would leave behind."""

    async def scene():
        desk, seen = Desk(heavy=2), set()
        for _ in range(20):
            await asyncio.gather(*(desk.heavy(lambda _: seen.add(threading.get_ident())) for _ in range(4)))
        assert len(seen) <= 2

    played(scene())


def test_a_connection_that_ends_stops_what_was_for_it(monkeypatch, paper):
    """Asked as a server asks the application: the body comes, and then that nobody is there any more."""
    begun, stopped = threading.Event(), threading.Event()

    def endless(case, options, done):
        begun.set()
        try:
            told(60)(done)
        finally:
            stopped.set()

    monkeypatch.setattr(api.bands, "computed", endless)
    body = json.dumps({"case": paper}).encode()
    scope = {
        "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "method": "POST", "scheme": "http",
        "path": "/api/v1/band", "raw_path": b"/api/v1/band", "query_string": b"", "root_path": "",
        "headers": [(b"host", b"localhost"), (b"content-type", b"application/json")],
    }  # fmt: skip

    async def scene():
        application = server.application(desk=Desk(longest=30))
        messages = [{"type": "http.request", "body": body, "more_body": False}]

        async def receive():
            if messages:
                return messages.pop()
            await asyncio.to_thread(begun.wait, 20)
            return {"type": "http.disconnect"}

        async def send(message):
            pass

        await asyncio.wait_for(application(scope, receive, send), 25)
        assert await asyncio.to_thread(stopped.wait, 5)

    played(scene())
