"""Tables and examples of the page on the API, from the server itself."""

import asyncio
import json
import textwrap

import httpx

from ballscrew.faces.web import bodies, connections, job_process, jobs, limits, problems, request_queue
from ballscrew.faces.web.server import application
from ballscrew.questions.shared.text_tables import markdown_table

#: The case of the examples, as Python source.
CASE = """\
case = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "nut": {"type": "double", "preload": "7 %"},
    "bodies": {},
    "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
    "operation": {"axial_load": "7 kN", "screw_speed": "600 rpm"},
}
"""
RUN = """\
answer = httpx.post("http://127.0.0.1:8017/api/v1/run", json={"case": case}).json()
print(answer["results"]["screw_torque"], answer["units"]["screw_torque"])
print(answer["results"]["efficiency"], answer["warnings"])
"""
WRONG = """\
case["operation"]["axial_load"] = "7"
answer = httpx.post("http://127.0.0.1:8017/api/v1/run", json={"case": case})
print(answer.status_code, answer.headers["content-type"])
print("\\n".join(answer.json()["lines"]))
"""


def _output_of(*parts: str) -> str:
    """The output of a client program; its requests go to a server in this process."""
    printed: list[str] = []
    app = application()

    class Client:
        @staticmethod
        def post(address, json):
            async def post():
                async with httpx.AsyncClient(transport=httpx.ASGITransport(app)) as client:
                    return await client.post(address, json=json)

            return asyncio.run(post())

    names = {"httpx": Client, "print": lambda *words: printed.append(" ".join(map(str, words)))}
    for part in parts:
        printed.clear()
        exec(part, names)
    return "\n".join(printed)


def _example(shown: str, printed: str) -> str:
    return f"```python\n{shown}```\n\n```text\n{textwrap.fill(printed, 110) if len(printed) > 400 else printed}\n```\n"


def addresses() -> str:
    """Each address, its query parameters, and its description."""
    rows: list[tuple[str, str]] = []
    described = json.loads(_get("/api/v1/openapi.json"))
    for path, methods in described["paths"].items():
        for method, operation in methods.items():
            words = " ".join(operation["description"].split()).replace("``", "`")
            query = [p["name"] for p in operation.get("parameters", ()) if p["in"] == "query"]
            asked = f" `?{'&'.join(f'{name}=' for name in query)}`" if query else ""
            rows.append((f"`{method.upper()} {path}`{asked}", words))
    return markdown_table(("address", "answer"), rows)


def _get(path: str) -> bytes:
    async def ask():
        transport = httpx.ASGITransport(application())
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return (await client.get(path)).content

    return asyncio.run(ask())


def statuses() -> str:
    """Title of each error status."""
    return markdown_table(("status", "title"), [(str(status), title) for status, title in problems.TITLES.items()])


def limits_table() -> str:
    """The limits, read from the modules that enforce them."""
    rows = {
        "bytes of a body": bodies.MOST_BYTES,
        "bytes of the head of a request": connections.LONGEST_HEAD,
        "bytes of a body with a log": bodies.MOST_LOG_BYTES,
        "columns of a log": limits.MOST_COLUMNS,
        "values in a body": bodies.MOST_VALUES,
        "characters of a text": bodies.LONGEST_TEXT,
        "depth of nested tables": bodies.DEEPEST,
        "seconds until a body has arrived": bodies.READ_TIMEOUT,
        "loaded balls of a nut, if each has its own load": bodies.MOST_BALLS,
        "axes of a sweep": limits.MOST_AXES,
        "points of a sweep": limits.MOST_POINTS,
        "values that a sweep returns": limits.MOST_RETURNED,
        "samples of a band": limits.MOST_SAMPLES,
        "seconds of processor for a request": request_queue.TIME_LIMIT,
        "seconds of processor for a job": jobs.LONGER * request_queue.TIME_LIMIT,
        "MiB of memory for a request or a job": job_process.MOST_MEMORY >> 20,
        "heavy requests computed at a time, and as many jobs": request_queue.HEAVY,
        "heavy requests in the queue, and jobs": request_queue.MOST_WAITING,
        "seconds that a job goes on unless somebody asks about it": jobs.LEFT_ALONE,
        "seconds that the answer of a job is kept": jobs.KEPT,
    }
    return markdown_table(("at most", ""), [(words, f"{n:,.0f}") for words, n in rows.items()], numbers=True)


def parts() -> dict[str, str]:
    """All parts that the page includes."""
    return {
        "addresses.md": addresses(),
        "statuses.md": statuses(),
        "limits.md": limits_table(),
        "run.md": _example("import httpx\n\n" + CASE + RUN, _output_of(CASE + RUN)),
        "wrong.md": _example(WRONG, _output_of(CASE, WRONG)),
    }
