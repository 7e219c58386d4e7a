"""Jobs: long requests in processes of their own."""

import asyncio
import errno
import subprocess
import sys
import threading
import time

import psutil
import pytest

from ballscrew.faces.web import jobs as jobs_of
from ballscrew.faces.web.job_process import Answer, Computed, Progress, Row
from ballscrew.faces.web.jobs import Jobs
from ballscrew.faces.web.problems import Refused

from .conftest import asking, run_scene

pytestmark = pytest.mark.slow

#: Longer than any job of these tests takes, also on a busy machine.
LONG = 600
#: A body that computes for minutes: it is cancelled or stopped by its limit.
ENDLESS = {
    "need": {"force": "2 kN", "feed": "15 m/min", "preload": [f"{share} %" for share in range(1, 25)]},
    "words": "", "complete": True,
}  # fmt: skip


def started(server, address, body, **query):
    found = server.post(f"jobs/{address}", body, params=query)
    assert found.status_code == 202, found.text
    assert found.headers["location"] == f"/api/v1/jobs/{found.json()['id']}"
    return found.json()["id"]


def ended(server, name):
    """The job once it has ended; a test fails by its state where it does not."""
    end = time.monotonic() + LONG
    while True:
        found = server.get(f"jobs/{name}", params={"wait": 5}).json()
        if found["state"] not in ("waiting", "running") or time.monotonic() > end:
            return found


def below(server):
    """Processes that the server has started, and those that they have."""
    return psutil.Process(server.process.pid).children(recursive=True)


def until(true):
    end = time.monotonic() + LONG
    while not (found := true()):
        assert time.monotonic() < end
        time.sleep(0.02)
    return found


def test_a_job_answers_as_its_address(server, paper):
    body = {"case": paper, "samples": 64}
    name = started(server, "band", body)
    found = ended(server, name)
    assert (found["state"], found["address"], found["rows"]) == ("finished", "band", [])
    assert 0 < found["computed"] < found["limit"]
    answer = server.get(f"jobs/{name}/answer")
    assert answer.status_code == 200
    assert answer.json() == server.post("band", body).json()
    assert ended(server, name) == found  # it is kept


def test_a_report_is_a_file(server, paper):
    name = started(server, "report", {"case": paper}, kind="html")
    assert ended(server, name)["state"] == "finished"
    answer = server.get(f"jobs/{name}/answer")
    assert answer.headers["content-type"] == "text/html; charset=utf-8"
    assert answer.content == server.post("report", {"case": paper}, params={"kind": "html"}).content


def test_a_fault_is_the_answer(server, paper):
    body = {"case": {**paper, "operation": {"axial_load": "7"}}}
    name = started(server, "band", body)
    assert ended(server, name)["state"] == "failed"
    answer, waited = server.get(f"jobs/{name}/answer"), server.post("band", body)
    assert (answer.status_code, answer.json()) == (422, waited.json())
    assert answer.headers["content-type"] == "application/problem+json"


def test_what_is_no_job(server, paper):
    for asked, status, words in (
        (lambda: server.get("jobs/none"), 404, "job: is not known"),
        (lambda: server.get("jobs/none/answer"), 404, "job: is not known"),
        (lambda: server.client.delete("/api/v1/jobs/none"), 404, "job: is not known"),
        (lambda: server.post("jobs/bands", {"case": paper}), 422, 'did you mean "band"?'),
        (lambda: server.get("jobs/none", params={"wait": "soon"}), 422, "?wait: "),
        (lambda: server.get("jobs/none", params={"wait": 1e9}), 422, "?wait: "),
        (lambda: server.post("jobs/band", b"{}", headers={"Content-Type": "text/plain"}), 415, "Content-Type"),
        (lambda: server.post("jobs/band", b" " * 5_000_000), 413, "more than"),
    ):
        found = asked()
        assert found.status_code == status, found.text
        assert found.headers["content-type"] == "application/problem+json"
        assert words in found.json()["lines"][0]


def test_cancelling_kills_the_work(server):
    before = set(below(server))
    name = started(server, "select", ENDLESS)
    (process,) = until(lambda: set(below(server)) - before)
    until(lambda: server.get(f"jobs/{name}", params={"wait": 1}).json()["finished"])
    assert server.get(f"jobs/{name}/answer").status_code == 409
    found = server.client.delete(f"/api/v1/jobs/{name}").json()
    assert found["state"] == "cancelled"
    process.wait(LONG)
    assert server.get(f"jobs/{name}/answer").status_code == 404
    assert server.get(f"jobs/{name}").json()["state"] == "cancelled"


def test_a_job_ends_at_its_limit_of_processor_time(start):
    """Which a request that is waited for does, too; neither is refused by a status that browsers send again."""
    server = start("--time-limit", "0.1")
    name = started(server, "select", ENDLESS)
    found = ended(server, name)
    assert found["state"] == "failed"
    assert found["limit"] == pytest.approx(3.0)
    assert 3.0 < found["computed"] < 6.0
    for refused in (server.get(f"jobs/{name}/answer"), server.post("select", ENDLESS)):
        assert refused.status_code == 422
        assert "of processor time" in refused.json()["lines"][0]
        assert "--" not in refused.json()["faults"][0]["remedy"]  # which the page would cut
    line = server.get(f"jobs/{name}/answer").json()["lines"][0]
    assert line.startswith("server: stopped the work, which took too long (3 s of processor time)")


def test_jobs_end_with_the_server(start):
    server = start()
    started(server, "select", ENDLESS)
    processes = until(lambda: below(server) if len(below(server)) == 2 else None)
    assert server.end() == (0, "")
    assert psutil.wait_procs(processes, LONG)[1] == []


def test_without_forks(paper):
    """As on other systems: the process starts from nothing."""

    with asking() as client:
        name = client.post("/api/v1/jobs/run", json={"case": paper}).json()["id"]
        while (found := client.get(f"/api/v1/jobs/{name}?wait=5").json())["state"] != "finished":
            assert found["state"] in ("waiting", "running")
        answer = client.get(f"/api/v1/jobs/{name}/answer").json()
        assert answer == client.post("/api/v1/run", json={"case": paper}).json()


#: The first fork of a job fails, and the others do not; the second time fewer pipes arrive than were sent.
FULL = """
import errno, os, socket
from ballscrew.faces.web.job_process import Answer, Asked, Forks

fork, receive, turns, received = os.fork, socket.recv_fds, [], []

def failing():
    turns.append(1)
    if len(turns) == 2:
        raise OSError(errno.EAGAIN, "no room")
    return fork()

def truncated(*given):
    said, pipes, *rest = receive(*given)
    received.append(1)
    if len(received) == 2:
        os.close(pipes.pop())
    return said, pipes, *rest

os.fork, socket.recv_fds = failing, truncated

async def application(scope, receive, send):
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-type", b"text/plain")]})
    await send({"type": "http.response.body", "body": b"answered"})

forks = Forks(lambda requests: application)
for turn in range(3):
    process = forks()
    try:
        process.ask(Asked("/", "", b"", 600.0, os.curdir))
    except OSError:
        pass  # nobody reads it
    found = []
    while (message := process.message()) is not None:
        found.append(message)
    process.close()
    print(process.has_begun, found[-1].body if found else None)
print("end")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="forks are made on Linux only")
def test_a_fork_that_fails_ends_one_job_only():
    """Defect: the process of which jobs are forked then left its loop, and no job could be started any more."""
    found = subprocess.run([sys.executable, "-c", FULL], capture_output=True, text=True, timeout=LONG, check=True)
    assert found.stdout.splitlines() == ["False None", "False None", "True b'answered'", "end"]
    assert found.stderr == "ballscrew: cannot fork a process for a job: no room\n"


def test_a_job_whose_process_cannot_be_started(monkeypatch):
    """It starts from nothing; where that is not possible either, or it never begins, the job says so."""

    def none():
        raise BrokenPipeError(errno.EPIPE, "Broken pipe")

    never = Told()
    never.has_begun = False
    never.end()

    async def scene():
        for start, other, state, words in (
            (none, lambda: Told(Answer(200, "text/plain", b"x")), "finished", b"x"),
            (none, none, "failed", b"server: cannot start a process (Broken pipe)"),
            (lambda: never, none, "failed", b"server: cannot start a process"),
        ):
            monkeypatch.setattr(jobs_of, "spawned", other)
            jobs = Jobs(start=start)
            job = jobs.begin("select", "", b"{}")
            while not job.has_ended:
                await job.changed(0.01)
            assert (job.state, words in job.answer.body) == (state, True), job.answer
            jobs.close()

    run_scene(scene())


class Told:
    """A process that says what the test lets it say."""

    has_begun = True

    def __init__(self, *messages):
        self.messages, self.is_killed = list(messages), threading.Event()

    def ask(self, asked):
        self.asked = asked

    def message(self):
        if self.messages:
            return self.messages.pop(0)
        self.is_killed.wait(LONG)
        return None

    def end(self):
        self.is_killed.set()

    def close(self):
        pass


async def computed(*messages):
    """Jobs, and the one of a process that says these messages, once it has computed."""
    jobs = Jobs(start=lambda: Told(*messages, Computed(4.0)))
    job = jobs.begin("select", "", b"{}")
    while not job.computed:
        await job.changed(0.01)
    return jobs, job


def test_rows_come_before_the_rest():
    async def scene():
        jobs, job = await computed(Progress(1, 9), Row(b"1"), Row(b"[2]"))
        assert (job.rows, job.finished, job.total, job.computed) == ([b"1", b"[2]"], 1, 9, 4.0)
        jobs.close()

    run_scene(scene())


def test_no_more_rows_than_there_is_room_for(monkeypatch):
    monkeypatch.setattr(jobs_of, "MOST_ROWS", 3)

    async def scene():
        jobs, job = await computed(Row(b"1"), Row(b"23"), Row(b"4"))
        assert job.rows == [b"1", b"23"]
        jobs.close()

    run_scene(scene())


def test_what_is_dropped_takes_no_room_and_a_cancelled_job_gets_no_rows(monkeypatch):
    monkeypatch.setattr(jobs_of, "MOST_ROWS", 3)

    async def scene():
        jobs, job = await computed(Row(b"1"), Row(b"too long"), Row(b"23"))
        assert (job.rows, job.size) == ([b"1", b"23"], 3)
        late = Told(Row(b"2"))
        late.end = lambda: None  # it says one more row before it is dead
        jobs.start = lambda: late
        other = jobs.begin("select", "", b"{}")
        while other.state == "waiting":
            await asyncio.sleep(0)
        other.cancel()
        late.is_killed.set()
        await other.task
        assert (other.rows, other.size - len(other.answer.body)) == ([], 0)
        jobs.close()

    run_scene(scene())


def test_a_cancelled_job_waits_no_more():
    """Its place in the queue is free at once: those that are cancelled before their turn leave nothing behind."""

    async def scene():
        jobs = Jobs(start=Told)
        running = [jobs.begin("select", "", b"{}") for _ in range(2)]
        await asyncio.sleep(0.05)
        for _ in range(3):
            for job in [jobs.begin("select", "", b"{}") for _ in range(16)]:
                job.cancel()
            await asyncio.sleep(0.05)
            # what is left of a job that was cancelled shows in memory alone
            assert jobs._limiter.statistics().tasks_waiting == 0
            # likewise
            assert len(jobs._tasks) == len(running)
        last = jobs.begin("select", "", b"{}")
        running[0].cancel()
        while last.state == "waiting":
            await asyncio.sleep(0.01)
        jobs.close()
        await asyncio.sleep(0.05)

    run_scene(scene())


def test_an_answer_that_is_larger_than_all_that_are_kept_can_be_asked_for(monkeypatch):
    monkeypatch.setattr(jobs_of, "MOST_KEPT", 250)

    async def scene():
        jobs = Jobs(start=lambda: Told(Answer(200, "text/plain", b"x" * 200)))
        made = []
        for size in (200, 300):
            jobs.start = lambda size=size: Told(Answer(200, "text/plain", b"x" * size))
            made.append(jobs.begin("select", "", b"{}"))
            while not made[-1].has_ended:
                await made[-1].changed(0.01)
            await asyncio.sleep(0.05)
        assert len(jobs.named(made[1].id).answer.body) == 300
        assert set(jobs._jobs) == {made[1].id}  # forgotten as the next one ended
        jobs.close()

    run_scene(scene())


def test_what_is_old_is_forgotten_though_nobody_asks(monkeypatch):
    monkeypatch.setattr(jobs_of, "KEPT", 0.05)

    async def scene():
        jobs = Jobs(start=lambda: Told(Answer(200, "text/plain", b"x")))
        jobs.begin("select", "", b"{}")
        end = time.monotonic() + LONG
        await asyncio.sleep(0.02)
        # until all are forgotten
        while jobs._jobs:
            assert time.monotonic() < end
            await asyncio.sleep(0.05)
        jobs.close()

    run_scene(scene())


def test_a_job_that_nobody_asks_about_is_cancelled(monkeypatch):
    monkeypatch.setattr(jobs_of, "LEFT_ALONE", 0.2)

    async def scene():
        jobs = Jobs(start=Told)
        job = jobs.begin("select", "", b"{}")
        while job.state != "cancelled":
            await asyncio.sleep(0.01)
        jobs.close()

    run_scene(scene())


def test_answers_are_kept_for_a_while_and_the_oldest_are_forgotten(monkeypatch):
    async def scene():
        jobs = Jobs(start=lambda: Told(Answer(200, "text/plain", b"x" * 100)))
        made = [jobs.begin("select", "", b"{}") for _ in range(4)]
        while not all(job.has_ended for job in made):
            await asyncio.sleep(0.01)
        monkeypatch.setattr(jobs_of, "MOST_KEPT", 250)
        jobs.named(made[0].id)  # it is the latest that was asked about
        with pytest.raises(Refused) as caught:
            jobs.named(made[1].id)
        assert caught.value.status == 404
        monkeypatch.setattr(jobs_of, "KEPT", -1.0)
        with pytest.raises(Refused):
            jobs.named(made[0].id)
        jobs.close()

    run_scene(scene())


def test_beyond_the_queue_jobs_are_refused():
    async def scene():
        jobs = Jobs(start=Told)
        made = [jobs.begin("select", "", b"{}") for _ in range(2)]
        await asyncio.sleep(0.05)
        made += [jobs.begin("select", "", b"{}") for _ in range(16)]
        with pytest.raises(Refused) as caught:
            jobs.begin("select", "", b"{}")
        assert caught.value.status == 429
        assert [jobs.before(job) for job in made] == [0, 0, *range(16)]
        assert len({job.id for job in made}) == 18
        jobs.close()
        assert all(job.state == "failed" for job in made)
        await asyncio.sleep(0.05)

    run_scene(scene())
