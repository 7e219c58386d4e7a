"""Sphinx configuration: builds offline, from pages that have all they show (``make pages`` writes it into them)."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
# the reference has the oracles of the tests, too
sys.path[:0] = [str(HERE / "_ext"), str(HERE), str(HERE.parent / "tests")]

from ballscrew.basis.version import __version__  # noqa: E402  (after the path of the extensions)

project = "ballscrew"
author = "The ballscrew authors"
copyright = "2026, the ballscrew authors"
version = release = __version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "mathml",
    "code_links",
    "navigation",
    "parameters",
    "static_page",
]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
html_math_renderer = "mathml"
html_theme = "furo"
html_title = "ballscrew"
html_static_path = ["_static"]
html_css_files = ["tables.css", "theory.css"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
suppress_warnings = ["myst.header"]  # the claims, written into their page, start with a heading of their own
