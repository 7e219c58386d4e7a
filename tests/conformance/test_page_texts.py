"""No script of the page takes a text of ours apart: what is parsed is what people typed, a path, a name or a number."""

import re
from collections import defaultdict
from pathlib import Path

import ballscrew

PAGE = Path(ballscrew.__file__).parent / "faces" / "page"
SCRIPTS = {path.relative_to(PAGE).as_posix(): path.read_text(encoding="utf-8") for path in PAGE.rglob("*.js")}
#: Calls that take a text apart, and regular expressions as they begin: ``/`` after what cannot end an operand.
_CALL = re.compile(r"\.(?:split|replace|replaceAll|match|matchAll|search|test|exec)\(|\bRegExp\(")
_EXPRESSION = re.compile(r"(?:^|[=(:,\[&|!?]|return)\s*/(?![/*])\S")
_COMMENT = re.compile(r"/\*.*?\*/|^\s*//[^\n]*$", re.DOTALL | re.MULTILINE)

PATHS = "the path of a field, or a name in one"
NAMES = "a name of the API in words"
TYPED = "what people typed"
NUMBERS = "the digits of a number"
ADDRESSES = "an address, a fragment or a file name"
AXES = "an axis, as the page writes it"
#: What is left, by file: what stands in the line, and what it is applied to.
ALLOWED = {
    "alone.js": {'address.split("/")': ADDRESSES, 'structure.split("/")': NAMES, "record.id.replace(": NAMES,
                 'name.split("_")': NAMES, "const AXIS = ": AXES, "AXIS.exec(": AXES,
                 "numbers.split(": AXES, 'path.split(".")': PATHS},
    "case_alone.js": {"const SHARE = ": TYPED, "SHARE.test(": TYPED, ".replace(SHARE": TYPED, "path.replace(": PATHS,
                      'path.split(".")': PATHS},
    "judgements.js": {"shownIn.replace(": "the sign of a unit", 'structure.split("/")': NAMES,
                      "template.replace(": "places in a sentence of the tables", "toExponential(": NUMBERS,
                      "text.replace(": NUMBERS},
    "service_worker.js": {"cache.match(": "a request that is kept"},
    "cards.js": {'path.split(".")': PATHS},
    "cards/axis.js": {'path.split(".")': PATHS},
    "cards/candidates.js": {'name.replaceAll("_", " ")': NAMES, ".split(/\\s+/)": TYPED},
    "cards/duty.js": {'path.split(".")': PATHS},
    "cards/hand_over.js": {'name.replaceAll("_", " ")': NAMES},
    "cards/log_columns.js": {'name.replaceAll("_", " ")': NAMES, 'name.split(".")': PATHS,
                             'last.replaceAll("_", " ")': NAMES},
    "cards/log_parts.js": {"const OF_SHELLS = ": "a command line", "const SPECIAL = ": "a command line",
                           "SPECIAL.test(word)": "a command line"},
    "cards/motion.js": {'distance?.replace(/^[-−]/, "")': TYPED, 'typed.split(";")': TYPED},
    "cards/need_tables.js": {"value.split(/;|,\\s+/)": TYPED},
    "cards/option_fields.js": {"typed.split(": TYPED, "entry.split(/=(.*)/s, 2)": TYPED},
    "cards/over_input.js": {'path.split(".")': PATHS},
    "cards/segments.js": {".test(typed)": TYPED},
    "consequences.js": {'path.split(".")': PATHS},
    "engine.js": {'structure.split("/")': NAMES},
    "designs.js": {"const NOT_IN_FILES = ": ADDRESSES, "file?.replace(": ADDRESSES,
                   "replaceAll(NOT_IN_FILES": ADDRESSES, 'path.split(".")': PATHS, 'one.split(".")': PATHS},
    "dom.js": {'/[",\\n]/.test(text)': "a cell of CSV"},
    "downloads.js": {"address.replace(": ADDRESSES},
    "figure.js": {'name.split("': "lines that are broken at blanks"},
    "pen.js": {'words.replaceAll("&"': "a text as markup"},
    "fields.js": {"const BARE = ": TYPED, "BARE.exec(typed)": TYPED, 'name.replaceAll("_", " ")': NAMES,
                  'path.replaceAll(".", "-")': PATHS},
    "files.js": {"const LOG = ": ADDRESSES, "LOG.test(name)": ADDRESSES},
    "form.js": {'where.split(".")': PATHS},
    "part_search.js": {".replace(": TYPED, "const SIZES = ": TYPED, "const CODES = ": TYPED,
                       "const CODE_WITHOUT_SIZE = ": TYPED,
                       "words.split(": TYPED, "code.exec(words)": TYPED, "CODE_WITHOUT_SIZE.test(words)": TYPED,
                       "SIZES.exec(word)": TYPED},
    "help.js": {'path.split(".")': PATHS, "documentation.replace(": ADDRESSES},
    "history.js": {"this.replace(fragment)": "an entry of the history"},
    "keeping.js": {"fragment.replace(": ADDRESSES, 'key.split(".")': PATHS},
    "main.js": {"entries.replace(fragment)": "an entry of the history"},
    "messages.js": {'path.split(".")': PATHS, 'words(parts[0]).replaceAll("-", " ")': NAMES, "const KEY = ": PATHS,
                    "const FILE = ": PATHS, "KEY.test(place)": PATHS},
    "names.js": {'name.replaceAll("_", " ")': NAMES},
    "needs.js": {'place.split(".")': PATHS},
    "operating_point.js": {'path.replaceAll(".", "-")': PATHS, 'path.split(".")': PATHS, "const SHARE = ": TYPED,
                           "SHARE.test(": TYPED, "written.replace(SHARE": TYPED},
    "sheet_charts.js": {'slug(block.title)': ADDRESSES, 'words.toLowerCase().replaceAll(': ADDRESSES},
    "chart_place.js": {'name.replaceAll("_", " ")': NAMES},
    "digits.js": {"toExponential()": NUMBERS, "written.replace(": NUMBERS, "/e(\\d+)/": NUMBERS},
    "results.js": {"replaceAll(/[._]/g": NAMES, 'text.split("; ")': "verdicts that begin alike, said once"},
    "schema.js": {'$ref?.split("/")': PATHS, 'path.split(".")': PATHS},
    "server.js": {'.split("\\n")': "lines of JSON"},
    "state.js": {"fragment.replace(": ADDRESSES, 'key.split(".")': PATHS,
                 'path.split(".")': PATHS, ".test(text.trim())": TYPED},
    "stiffness.js": {'path.split(".")': PATHS, 'path.replace(".", "-")': PATHS},
    "symbols.js": {"tex.replace(": "TeX of a symbol", ".exec(text)": "TeX of a symbol"},
    "sentence.js": {"const PATH = ": PATHS, "const ENTRY = ": PATHS, ".replace(ENTRY": PATHS, ".replace(PATH": PATHS,
                    "(_, power)": "the sign of a unit",
                    "const isWord = ": "a capital for a word, none for a file", "/[.:]$/.test(line)": "a full stop"},
    "views.js": {'address).split(".")': ADDRESSES, '"").split(" ")': ADDRESSES},
    "units.js": {"const NUMBER = ": TYPED, "const COMMA = ": TYPED,
                 "text.replace(COMMA": TYPED, "/[1-9]/.test(before)": TYPED,
                 '.replaceAll("\\u': TYPED, ".replace(/[\\uff01": TYPED,
                 "NUMBER.exec(": TYPED},
}  # fmt: skip


def parsed(script):
    """The lines of a script that take a text apart."""
    code = _COMMENT.sub(lambda comment: re.sub(r"[^\n]", "", comment[0]), script)
    return [line.strip() for line in code.splitlines() if _CALL.search(line) or _EXPRESSION.search(line)]


def test_no_script_takes_a_text_apart():
    found = {
        name: [line for line in parsed(script) if not any(one in line for one in ALLOWED.get(name, {}))]
        for name, script in SCRIPTS.items()
    }
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_what_is_allowed_is_there():
    """An exception that nothing needs any more goes."""
    unused = defaultdict(list)
    for name, entries in ALLOWED.items():
        lines = parsed(SCRIPTS.get(name, ""))
        for one in entries:
            if not any(one in line for line in lines):
                unused[name].append(one)
    assert unused == {}
