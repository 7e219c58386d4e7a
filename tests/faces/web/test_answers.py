"""What goes round each answer: headers, what browsers keep, and that nothing is asked from outside."""

import re
from urllib.parse import urljoin

import pytest

from ballscrew.evidence.validation.sets import SETS
from ballscrew.faces.web import api

from .conftest import asking

STRICT = ("content-security-policy", "x-content-type-options", "referrer-policy", "cross-origin-opener-policy")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("path", "status"),
    [("/", 200), ("/api", 200), ("/style.css", 200), ("/viewer/swagger-ui.css", 200),
     ("/api/v1/schema", 200), ("/api/v1/openapi.json", 200), ("/none", 404), ("/api/v1/catalogue/none", 404),
     ("/api/v1/run", 405), ("/api/v1/schema?x=1", 422), ("/main.js", 404), ("/page.js", 404)],
)  # fmt: skip
def test_headers(server, path, status):
    found = server.client.get(path)
    assert found.status_code == status
    assert all(found.headers[name] for name in STRICT)
    assert "'unsafe-eval'" not in found.headers["content-security-policy"]
    assert "script-src 'self' 'wasm-unsafe-eval';" in found.headers["content-security-policy"]
    assert "server" not in found.headers
    assert found.headers["cache-control"] == ("no-store" if "/v1/" in path or status >= 400 else "no-cache")


@pytest.mark.parametrize("path", ["/", "/style.css", "/viewer/swagger-ui-bundle.js"])
def test_files_are_sent_once(server, path):
    """A browser keeps them, and asks whether they are still the same."""
    tag = server.client.get(path).headers["etag"]
    again = server.client.get(path, headers={"If-None-Match": tag})
    assert (again.status_code, again.content) == (304, b"")
    assert "content-security-policy" in again.headers
    assert server.client.get(path, headers={"If-None-Match": '"another"'}).status_code == 200


@pytest.mark.parametrize("path", ["/", "/style.css"])
def test_head_of_files(server, path):
    found, whole = server.client.head(path), server.client.get(path)
    assert (found.status_code, found.content) == (200, b"")
    assert found.headers["etag"] == whole.headers["etag"]
    assert found.headers["content-security-policy"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("site", "status"), [("cross-site", 403), ("same-site", 403), ("same-origin", 200), ("none", 200)]
)
def test_no_other_page_can_start_work(server, paper, site, status):
    """Defect: any page could have the server compute the validation; a browser says whose page asks."""
    headers = {"Sec-Fetch-Site": site}
    for found in (
        server.get("validate", params={"set": next(iter(SETS))}, headers=headers),
        server.get("vocabulary", headers=headers),
        server.post("run", {"case": paper}, headers=headers),
    ):
        assert found.status_code == status
        if status == 403:
            assert found.json()["lines"] == [f"Sec-Fetch-Site: is not this server's ({site}) · ask from its own page"]


@pytest.mark.parametrize("path", ["schema", "vocabulary", "catalogue/hiwin-40-16k5", "openapi.json", "none"])
def test_head_of_the_api(server, path):
    """Defect: it answered 405."""
    found, whole = server.client.head(f"/api/v1/{path}"), server.get(path)
    assert (found.status_code, found.content) == (404 if path == "none" else 200, b"")
    assert found.headers["content-length"] == whole.headers["content-length"]
    assert server.client.head("/api/v1/run").status_code == 405


def test_a_defect_is_said(monkeypatch):
    """Of the server, with the same headers; the server writes where it was, and the answer does not."""

    def wrong(*_):
        raise ArithmeticError("secret")

    monkeypatch.setattr(api, "kept", wrong)

    with asking() as client:
        found = client.get("/api/v1/schema")
    assert found.status_code == 500
    assert found.headers["content-type"] == "application/problem+json"
    assert all(found.headers[name] for name in STRICT)
    assert "secret" not in found.text


@pytest.mark.parametrize("page", ["/", "/api"])
def test_pages_are_served_from_here(server, page):
    """Everything they name, and what that names; no script and no style stands in them."""
    text = server.client.get(page).text
    assert not re.search(r"<script(?![^>]*\bsrc=)[^>]*>|<style|\son\w+=|javascript:", text)
    pending, seen = re.findall(r"""(?:src|href)="([^"#]+)[#"]""", text), set()
    assert pending
    while pending:
        address = urljoin(page, pending.pop())
        assert address.startswith("/"), address
        if address in seen:
            continue
        seen.add(address)
        found = server.client.get(address)
        assert found.status_code == 200, address
        if address.endswith(".css"):
            links = re.findall(r"url\(([^)]+)\)", found.text)
            assert all(link.strip("\"'").startswith(("data:", "#")) for link in links)
    assert len(seen) > 3


@pytest.mark.slow
def test_what_is_described_is_there(server):
    """The viewer shows this document, and each of its addresses is one that answers."""
    described = server.get("openapi.json").json()
    assert described["openapi"].startswith("3.1")
    assert re.search(r'url: "(/[^"]+)"', server.client.get("/api.js").text)[1] == "/api/v1/openapi.json"
    for path, methods in described["paths"].items():
        for method in methods:
            assert server.client.request(method, path.replace("{name}", "x")).status_code != 405
