"""plotly.js as it is sent."""

import gzip
import hashlib
import re

from ballscrew.faces.web.plotly_js import eager, script

#: Of package/plotly-cartesian.min.js in the package plotly.js-cartesian-dist-min 4.1.1 of npm.
DIGEST = "79542150855a52c567260e3137095dbe2b744e6d702a5cabe67da246942fba7a"


def test_it_is_as_its_makers_distribute_it():
    assert hashlib.sha256(script().encode()).hexdigest() == DIGEST
    assert "Licensed under the MIT license" in script()[:300]


def test_it_is_sent_but_for_one_pair_of_parentheses():
    own = script()
    sent = eager(own)
    assert len(sent.rstrip()) == len(own.rstrip()) + 2
    begin = next(place for place, (a, b) in enumerate(zip(own, sent, strict=False)) if a != b)
    assert sent[begin] == "("
    assert sent[begin + 1 :].rstrip().removesuffix(")));") == own[begin:].rstrip().removesuffix("));")


def test_what_is_built_otherwise_is_sent_as_it_is():
    for other in ("", "var Plotly = 1;", script()[:-40], 2 * script()):
        assert eager(other) == other


def test_it_is_sent_compressed_and_kept_for_good(server):
    """Before, 4.8 MB as they are, and asked about each time: the first chart came after half a minute."""
    address = re.search(r'content="(/plotly-[0-9a-f]+\.js)"', server.client.get("/").text)[1]
    with server.client.stream("GET", address, headers={"Accept-Encoding": "gzip"}) as found:
        packed = b"".join(found.iter_raw())
    assert found.headers["cache-control"] == "public, max-age=31536000, immutable"
    assert found.headers["content-encoding"] == "gzip"
    assert len(packed) < 500_000
    content = gzip.decompress(packed)
    assert content == eager(script()).encode()
    assert address == f"/plotly-{hashlib.sha256(content).hexdigest()[:32]}.js"
    plain = server.client.get(address, headers={"Accept-Encoding": "gzip;q=0"})
    assert plain.content == content
    assert "content-encoding" not in plain.headers


def test_all_texts_of_the_page_are_sent_compressed(server):
    for path in ("/", "/page/main.js", "/page/style.css", "/viewer/swagger-ui-bundle.js"):
        packed = server.client.get(path, headers={"Accept-Encoding": "br, gzip"})
        plain = server.client.get(path, headers={"Accept-Encoding": "identity"})
        assert packed.headers["content-encoding"] == "gzip"
        assert "content-encoding" not in plain.headers
        assert packed.content == plain.content
        assert int(packed.headers["content-length"]) < 0.6 * len(plain.content)
        assert "Accept-Encoding" in packed.headers["vary"]


def test_a_chart_is_sketched_until_plotly_is_there(visit):
    """It is asked for when there is a first chart: the numbers do not wait for it."""
    held = []
    here = visit()
    size = here.page.viewport_size
    here.page.set_viewport_size({"width": 1280, "height": 3500})  # the chart is in it
    here.page.route("**/plotly-*.js", lambda route: held.append(route))
    here.page.goto(f"{here.address}/#band=0", wait_until="commit")
    here.page.wait_for_selector("#torque-chart canvas", state="attached")
    assert here.numbers()["results"]["screw_torque"] > 0
    while not held:
        here.rest(20)
    held.pop().continue_()
    here.page.unroute("**/plotly-*.js")
    here.page.wait_for_selector("#torque-chart .plot .main-svg", state="attached")
    here.page.wait_for_selector("#torque-chart canvas", state="detached")
    here.page.wait_for_selector("html[data-ready]")
    here.settle()
    here.page.set_viewport_size(size)
