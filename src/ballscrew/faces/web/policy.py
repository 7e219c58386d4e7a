"""The Content-Security-Policy: browsers run and show only files of this server."""

from __future__ import annotations

import base64
import hashlib
import re

#: Texts that plotly.js writes into an element <style> when it is loaded.
_STYLE = re.compile(r"textContent='((?:[^'\\]|\\.)*)'")


def policy(plotly: str) -> str:
    """The policy of all responses, by the script of the charts.

    plotly.js sets style attributes, adds rules by script to an empty <style>, and adds <style> elements with the texts
    in its file: these are allowed by their hashes, and no others. Modules of WebAssembly may be compiled, no text.
    """
    texts = ["", *_STYLE.findall(plotly)]
    styles = " ".join(["'self'", *map(_hash, texts)])
    return (
        f"default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src {styles}; "
        "style-src-attr 'unsafe-inline'; "
        "img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
