"""Sphinx configuration: builds offline; the program computes every figure, table and claim."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE / "_ext"), str(HERE), str(ROOT / "tests")]

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
    "sphinxcontrib.bibtex",
    "mathml",
    "command",
    "equation",
    "navigation",
    "parameters",
    "parts",
    "static_page",
]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist", "substitution"]
myst_heading_anchors = 3
html_math_renderer = "mathml"
html_theme = "furo"
html_title = "ballscrew"
html_static_path = ["_static"]
html_css_files = ["tables.css", "theory.css"]
exclude_patterns = ["generated/**"]
bibtex_bibfiles = [str(ROOT / "src/ballscrew/data/references.bib")]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
suppress_warnings = ["myst.header"]  # the included claims start with a heading of their own
if tags.has("alone"):  # noqa: F821  (Sphinx has it)
    # the other pages, which it refers to, are not there
    extensions.remove("sphinx.ext.viewcode")
    extensions.remove("static_page")
    suppress_warnings += [
        "myst.xref_missing",
        "ref.doc",
        "ref.ref",
        "toc.excluded",
        "toc.not_readable",
        "bibtex.key_not_found",
    ]
