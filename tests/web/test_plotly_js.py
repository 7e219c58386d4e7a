"""plotly.js as it is sent."""

import importlib.util
from pathlib import Path

from ballscrew.web.plotly_js import eager


def installed() -> str:
    found = importlib.util.find_spec("plotly")
    return (Path(found.origin).parent / "package_data" / "plotly.min.js").read_text(encoding="utf-8")


def test_it_is_the_installed_script_but_for_one_pair_of_parentheses():
    script = installed()
    sent = eager(script)
    assert len(sent.rstrip()) == len(script.rstrip()) + 2
    begin = next(place for place, (a, b) in enumerate(zip(script, sent, strict=False)) if a != b)
    assert sent[begin] == "("
    assert sent[begin + 1 :].rstrip().removesuffix(")));") == script[begin:].rstrip().removesuffix("));")


def test_what_is_built_otherwise_is_sent_as_it_is():
    for script in ("", "var Plotly = 1;", installed()[:-40], 2 * installed()):
        assert eager(script) == script
