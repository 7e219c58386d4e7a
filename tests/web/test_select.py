"""``POST /api/v1/select``: the document of the command; paths and too many choices are refused."""

import json

from ballscrew.documents.selection import document
from ballscrew.output.json_text import plain
from ballscrew.selection.selection import select

NEED = {
    "force": "2 kN",
    "feed": "15 m/min",
    "length": "1 m",
    "ends": "fixed-supported",
    "life": "20000 h",
    "preload": "2 %",
}


def test_the_answer_is_the_document_of_the_command(server):
    found = server.post("select", {"need": NEED, "words": "rexroth 32x10"})
    assert found.status_code == 200, found.text[:500]
    assert found.json() == json.loads(json.dumps(plain(document(select(NEED, words="rexroth 32x10")))))


def test_what_is_refused(server):
    for need, words in (
        ({**NEED, "lubricant": {"oil_file": "/etc/passwd"}}, "lubricant.oil_file"),
        ({**NEED, "force": None}, "must not be null"),
        ({**NEED, "preload": [f"{share} %" for share in range(1, 30)]}, "too many choices"),
        ({**NEED, "forse": "2 kN"}, "forse"),
        ({}, "operation.axial_load"),
    ):
        found = server.post("select", {"need": need})
        assert found.status_code == 422, found.text[:500]
        assert any(words in line for line in found.json()["lines"]), found.json()["lines"]
