"""The API against its own OpenAPI description, by schemathesis."""

import re
from collections import Counter

import jsonschema_rs
import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from schemathesis import GenerationMode
from schemathesis.specs.openapi.checks import positive_data_acceptance
from schemathesis.specs.openapi.definitions import OPENAPI_31

from ballscrew.basis.output.json_text import plain
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.faces.web import limits, problems
from ballscrew.faces.web.request_queue import RequestQueue
from ballscrew.faces.web.server import (
    application,
)
from ballscrew.questions.validate import answer
from support.validation_sets import every_set

pytestmark = pytest.mark.slow

#: A job is a process: what it may be asked is in ``test_jobs.py``.
JOBS = "/api/v1/jobs/"
#: Seconds for the slowest request, also on a busy machine.
SLOW = 300
#: Responses by address and status: not all may be refusals.
answered: Counter[tuple[str, int]] = Counter()
#: Three at random beside those of the description; fifteen in the long run. So few need no check of their health.
FEW = settings(
    max_examples=settings.default.max_examples // 33,
    derandomize=True,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)


def described(*phases):
    """The API, under any host name: schemathesis uses its own."""
    found = schemathesis.openapi.from_asgi(
        "/api/v1/openapi.json", application(hosts=("*",), requests=RequestQueue(time_limit=SLOW))
    )
    found.config.phases.update(phases=list(phases))
    return found


schema = described("examples", "fuzzing")
#: All words of an address one by one. Those of ``POST``, a thousand fields of a case, are in the file of the long run.
one_by_one = described("coverage")
OPERATIONS = [
    (path, method)
    for path, methods in schema.raw_schema["paths"].items()
    if not path.startswith(JOBS)
    for method in methods
]


@pytest.fixture(scope="module", autouse=True)
def loaded():
    """As the server does when it starts: after each heavy answer it collects what is not loaded by then.

    Here that is what all tests of the worker before have left, too: a tenth of a second a time.
    """
    limits.keep_loaded()


@pytest.fixture(scope="module", autouse=True)
def some_were_answered():
    """The examples in the description are cases that are computed: not all was refused of any address."""
    yield
    paths = {path for path, _ in answered}
    assert paths == {path for path, status in answered if status == 200}
    assert not [status for _, status in answered if status >= 500]


def check(case):
    # positive_data_acceptance: tables can be as the schema says and still be no screw, a ball larger than its groove
    response = case.call_and_validate(timeout=SLOW, excluded_checks=[positive_data_acceptance])
    answered[case.operation.path, response.status_code] += 1
    headers = {name: values[0] for name, values in response.headers.items()}
    assert "content-security-policy" in headers
    if response.status_code >= 400:
        assert headers["content-type"] == problems.MEDIA_TYPE
        assert response.json()["status"] == response.status_code
        assert response.json()["lines"]


@pytest.mark.parametrize(("path", "method"), OPERATIONS)
def test_addresses(path, method):
    """What the description shows, and what else it allows and refuses.

    Without schemathesis' own parametrization, which makes all examples while tests are collected, in each worker.
    """
    operation = schema[path][method]
    for example in operation.get_strategies_from_examples():
        settings(FEW, max_examples=1)(given(example)(check))()
    FEW(given(st.one_of([operation.as_strategy(generation_mode=mode) for mode in GenerationMode]))(check))()


@one_by_one.exclude(method="POST").exclude(path_regex=JOBS).parametrize()
@FEW
def test_words_in_addresses(case):
    check(case)


def test_the_description_is_valid():
    raw = schema.raw_schema
    jsonschema_rs.validate(OPENAPI_31, raw)
    for name, part in raw["components"]["schemas"].items():
        jsonschema_rs.meta.validate(part), name
    case = raw["components"]["schemas"]["Case"]
    assert case["properties"].keys() == json_schema()["properties"].keys()


def test_the_bodies_to_try_follow_their_schema():
    """And a body of another form does not."""
    raw = schema.raw_schema
    for path, operation in raw["paths"].items():
        if path.startswith(JOBS):  # any of the others
            continue
        content = operation.get("post", {}).get("requestBody", {}).get("content", {})
        for media in content.values():
            validator = jsonschema_rs.validator_for({**media["schema"], "components": raw["components"]})
            for example in media["examples"].values():
                validator.validate(example["value"])
                assert not validator.is_valid({**example["value"], "cases": 1}), path
                assert not validator.is_valid({**example["value"], "case": {"screw": 5}}), path


def test_whatever_may_be_null_is_described():
    """A field that the description does not name may be anything: of null, a client learns from its description."""
    # all sets at once, without a server
    entries = plain(answer.documents([entry for entries in every_set() for entry in entries]))
    parts = schema.raw_schema["components"]["schemas"]
    for name, tables in (("ValidationEntry", entries), ("ValidationRow", [row for e in entries for row in e["rows"]])):
        null = {field for table in tables for field, value in table.items() if value is None}
        described = parts[name]["properties"]
        assert null <= {field for field, s in described.items() if {"type": "null"} in s.get("anyOf", [])}, name
        assert null


@pytest.mark.parametrize("method", ["DELETE", "PUT", "PATCH", "OPTIONS", "TRACE"])
def test_other_methods(server, method):
    known = [(re.sub(r"{\w+}", "x", path), methods) for path, methods in schema.raw_schema["paths"].items()]
    taken = {path for path, methods in known if method.lower() in methods}
    for path in [*{path for path, _ in known} - taken, "/", "/api"]:
        found = server.client.request(method, path)
        assert found.status_code == 405
        assert found.headers["allow"]
        assert found.headers["content-type"] == problems.MEDIA_TYPE
