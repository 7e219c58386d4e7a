"""Tables and examples of the page on the API, from the server itself."""

import asyncio
import json
import textwrap
from pathlib import Path

import httpx

from ballscrew.interfaces.web import bodies, limits, listen, problems, work
from ballscrew.interfaces.web.server import application

#: What is asked in the examples, as Python writes it.
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


def _played(*parts: str) -> str:
    """What a program prints that asks the server; it asks one in this process."""
    said: list[str] = []
    app = application()

    class Asked:
        @staticmethod
        def post(address, json):
            async def ask():
                async with httpx.AsyncClient(transport=httpx.ASGITransport(app)) as client:
                    return await client.post(address, json=json)

            return asyncio.run(ask())

    names = {"httpx": Asked, "print": lambda *words: said.append(" ".join(map(str, words)))}
    for part in parts:
        said.clear()
        exec(part, names)
    return "\n".join(said)


def _example(shown: str, said: str) -> str:
    return f"```python\n{shown}```\n\n```text\n{textwrap.fill(said, 110) if len(said) > 400 else said}\n```\n"


def addresses() -> str:
    """Each address, what it takes, and what it does."""
    rows = ["| address | what it answers |", "|---|---|"]
    described = json.loads(_get("/api/v1/openapi.json"))
    for path, methods in described["paths"].items():
        for method, operation in methods.items():
            words = " ".join(operation["description"].split()).replace("``", "`")
            query = [p["name"] for p in operation.get("parameters", ()) if p["in"] == "query"]
            asked = f" `?{'&'.join(f'{name}=' for name in query)}`" if query else ""
            rows.append(f"| `{method.upper()} {path}`{asked} | {words} |")
    return "\n".join(rows) + "\n"


def _get(path: str) -> bytes:
    async def ask():
        transport = httpx.ASGITransport(application())
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return (await client.get(path)).content

    return asyncio.run(ask())


def statuses() -> str:
    """What a refusal is called."""
    rows = [f"| {status} | {title} |" for status, title in problems.TITLES.items()]
    return "\n".join(["| status | title |", "|---|---|", *rows]) + "\n"


def most() -> str:
    """The limits, from where they stand."""
    rows = {
        "bytes of a body": bodies.MOST_BYTES,
        "bytes of the head of a request": listen.LONGEST_HEAD,
        "values in a body": bodies.MOST_VALUES,
        "letters of a text": bodies.LONGEST_TEXT,
        "tables within tables": bodies.DEEPEST,
        "seconds for a body to arrive": bodies.PATIENCE,
        "loaded balls of a nut whose balls are computed one by one": bodies.MOST_BALLS,
        "axes of a sweep": limits.MOST_AXES,
        "points of a sweep": limits.MOST_POINTS,
        "points of a sweep of a whole nut": limits.MOST_POINTS_OF_NUT,
        "values that a sweep returns": limits.MOST_RETURNED,
        "samples of a band": limits.MOST_SAMPLES,
        "samples of a band of a whole nut": limits.MOST_SAMPLES_OF_NUT,
        "balls one by one over all points or samples; one with four contacts counts as three": limits.MOST_BALLS_IN_ALL,
        "seconds that a request computes": work.LONGEST,
        "heavy requests at a time": work.HEAVY,
        "heavy requests that wait": work.MOST_WAITING,
    }
    return "\n".join(["| at most | |", "|---|--:|", *(f"| {words} | {n:,.0f} |" for words, n in rows.items())]) + "\n"


def write(folder: Path) -> None:
    """Everything that the page includes."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = {
        "addresses": addresses(),
        "statuses": statuses(),
        "limits": most(),
        "run": _example("import httpx\n\n" + CASE + RUN, _played(CASE + RUN)),
        "wrong": _example(WRONG, _played(CASE, WRONG)),
    }
    for name, text in pages.items():
        (folder / f"{name}.md").write_text(text, encoding="utf-8")
