"""What was asked for before is not computed again, and what is kept has bounds."""

import pytest

from ballscrew.faces.web import api, server
from ballscrew.faces.web.documents import KeptAnswers, Question

testclient = pytest.importorskip("starlette.testclient", reason="needs httpx, of the extra test")


@pytest.fixture
def asked(monkeypatch):
    """A client, and what was computed for it."""
    computed, band = [], api.compute.band

    def counted(case, options, done):
        computed.append((case.operation.axial_load, options.samples))
        return band(case, options, done)

    monkeypatch.setattr(api.compute, "band", counted)
    with testclient.TestClient(server.application(), base_url="http://localhost") as client:
        yield client, computed


def test_the_same_request_is_computed_once(asked, paper):
    client, computed = asked
    body = {"case": paper, "samples": 64}
    first, second = (client.post("/api/v1/band", json=body) for _ in range(2))
    assert first.status_code == second.status_code == 200
    assert first.content == second.content
    assert first.headers["content-type"] == second.headers["content-type"]
    assert len(computed) == 1


@pytest.mark.slow
@pytest.mark.parametrize("change", [{"samples": 65}, {"level": 0.9}])
def test_another_request_is_computed(asked, paper, change):
    client, computed = asked
    first, second = (client.post("/api/v1/band", json={"case": paper, "samples": 64, **more}) for more in ({}, change))
    assert first.status_code == second.status_code == 200
    assert first.content != second.content
    assert len(computed) == 2


def test_a_fault_is_not_kept(asked, paper):
    client, computed = asked
    body = {"case": {**paper, "operation": {**paper["operation"], "axial_load": "much"}}}
    assert [client.post("/api/v1/band", json=body).status_code for _ in range(2)] == [422, 422]
    assert not computed


def test_the_same_body_at_another_address_is_another_question(asked, paper):
    client, _ = asked
    kinds = {tuple(client.post(f"/api/v1/{address}", json={"case": paper}).json()) for address in ("compare", "band")}
    assert len(kinds) == 2


def test_the_last_ones_are_kept():
    kept = KeptAnswers(most_bytes=1010, largest=4)  # each takes 500 beside its own
    one, two, three, large = (Question("/band", bytes([number])) for number in range(4))
    for question in (one, two):
        kept.keep(question, b"1234")
    assert kept.find(one) == b"1234"  # asked for again: the other one makes room
    kept.keep(three, b"5678")
    kept.keep(large, b"12345")
    assert [kept.find(each) for each in (one, two, three, large)] == [b"1234", None, b"5678", None]
