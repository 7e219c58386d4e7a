"""plotly.js in the form that browsers load fastest.

It is shipped: version 4.1.1 of the bundle ``cartesian`` (scatter, bar, contour and heatmap are what the page draws), as
npm's ``plotly.js-cartesian-dist-min`` has it, compressed; its licence (MIT) lies beside it. The Python package plotly
has the bundle of everything only, three times as large.
"""

from __future__ import annotations

import gzip
from importlib import resources

_FILE = "data/plotly/plotly-cartesian-4.1.1.min.js.gz"

#: How the script begins and ends the function with all of it, and the same in parentheses.
_BEGIN, _END = 'this, () => {\n"use strict"', "return Plotly;\n}));"
_BEGIN_EAGER, _END_EAGER = 'this, (() => {\n"use strict"', "return Plotly;\n})));"


def script() -> str:
    """The script as its makers distribute it."""
    return gzip.decompress(resources.files("ballscrew").joinpath(_FILE).read_bytes()).decode()


def eager(script: str) -> str:
    """The script with its one large function in parentheses, if it is built like that; else unchanged.

    Browsers parse a function twice, once to skip it and once to run it, but a function in parentheses only once, as it
    probably runs at once. That saves a third of the time until the first chart.
    """
    if script.count(_BEGIN) != 1 or not script.rstrip().endswith(_END):
        return script
    return script.rstrip().removesuffix(_END).replace(_BEGIN, _BEGIN_EAGER) + _END_EAGER + "\n"
