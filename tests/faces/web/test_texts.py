"""The texts of the page: one file of them, and no text anywhere else."""

import ast
import fnmatch
import re
from pathlib import Path

from tests.support.message_templates import (
    NOT_ON_PAGE,
    calls,
    faults,
    imports_of,
    is_left_out,
    messages,
    placeholders,
    records,
    shown_by_page,
    sources,
)

from ballscrew.faces.web import page_texts

PAGE = Path(page_texts.__file__).with_name("page")
OF_CHECKS = (
    "static_safety", "life", "running_time", "contact_pressure", "shaft_stress", "buckling", "critical_speed",
    "diameter_speed_product", "motor_rms_torque", "motor_peak_torque", "motor_speed",
)  # fmt: skip
TEXTS = page_texts.texts()
SCRIPTS = {file.name: file.read_text(encoding="utf-8") for file in PAGE.rglob("*.js")}
#: Comments and patterns, which are skipped; then strings, and templates, of which what is computed is left out.
_TOKEN = re.compile(
    r"""/\*.*?\*/|(?:^|\s)//[^\n]*|(?<=\()/(?:\\.|[^/\n\\])+/|"((?:\\.|[^"\\\n])*)"|'[^'\n]*'|`((?:\\.|[^`\\])*)`""",
    re.DOTALL,
)
_COMPUTED = re.compile(r"\$\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}")
#: A literal that reads like a sentence or a label: two words.
_WORDS = re.compile(r"[A-Za-z]{2,}[,:;]? [a-z]{2,}")
#: A section of a case file.
_SECTION = re.compile(r"\[[a-z_.]+\]")
#: Two words that nobody reads: classes of elements, units, selectors, and a defect of the page.
CODES = {
    "(prefers-color-scheme: dark)", "chart low", "chart low whole-width",
    "chart tall whole-width", "chart whole-width", "field given",
    "field start given",
    "input, select", "kg cm^2", "lbf in", "line thin", "mm rpm",
    "no element #…", "no element …", "part absent", "part-of-axis absent", "scroll whole", "verdict careful",
    "warning card-trouble",
}  # fmt: skip


#: Records that a screw, an axis or a person may be hurt by if they are not understood.
SAFETY = (
    "band.flooded", "check.*", "duty.*", "lubricant.*", "run.preload_above_rating", "validity.*",
    "verdict.back_driving", "verdict.brake", "verdict.checks", "verdict.equilibrium",
    "verdict.equilibrium_of_full_bath", "verdict.held_in_motion",
    "verdict.buckling", "verdict.critical_speed",
    "verdict.motor", "verdict.no_load", "verdict.preload", "verdict.preload_lost", "verdict.quadrant",
    "verdict.self_locking", "verdict.skid", "verdict.stretch", "warning.bracing", "warning.stopped",
)  # fmt: skip
#: Fields of a record that are no text.
OF_RECORDS = ("id", "subject")


def id_of(call):
    """The id of a record as it stands in the source; what is computed of it is ``*``."""
    value = next((one.value for one in call.keywords if one.arg == "id"), None)
    if isinstance(value, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "*" for part in value.values)
    return value.value if isinstance(value, ast.Constant) else ""


def of_page():
    """The templates that the page can show."""
    found = {one for said in (*faults(), *records()) if said.module in shown_by_page() for one in said.templates}
    return found | {one for module, one in messages() if module in shown_by_page()}


def overrides():
    """What the page says in the place of a template."""
    return {key.removeprefix("message."): text for key, text in TEXTS.items() if key.startswith("message.")}


def test_no_message_is_stale():
    """A text has the template of a message that there is; it may leave values out, and has no others."""
    known = {one for said in (*faults(), *records()) for one in said.templates} | {one for _, one in messages()}
    found = overrides()
    assert found.keys() - known - {"dynamic_load_rating", "maximum_pressure", "static_load_rating"} == set()
    assert {key for key, text in found.items() if not set(placeholders(text)) <= set(placeholders(key))} == set()
    own = {key.removeprefix("fault.").rpartition(": ")[2] for key in TEXTS if key.startswith("fault.")}
    assert own - known == set()


def test_faults_are_templates():
    """Problem and remedy of every fault are literals, or messages: none is a text that was put together."""
    assert len(faults()) > 750
    assert {fault.where: fault.untold for fault in faults() if fault.untold} == {}


def test_records_are_templates():
    """Every verdict, check and warning is a message: none is a text that was put together."""
    assert len(records()) > 85
    assert {record.where: record.untold for record in records() if record.untold} == {}


def test_the_page_names_no_section_of_a_file():
    """``[lubricant]`` stands in files: who sees a form reads a text of its own, and no script looks for it."""
    of_faults = {one for fault in faults() for one in fault.templates}  # files have faults that name their sections
    of_files = {one for one in of_page() - of_faults if _SECTION.search(one)}
    assert len(of_files) > 5
    assert {one for one in of_files if _SECTION.search(overrides().get(one, one))} == set()


def test_no_template_is_put_together():
    """Neither a template nor what stands in one is an f-string with words of its own, which nothing could translate."""
    found = [
        f"{source.name}:{node.lineno}: {ast.unparse(node)}"
        for source, call in calls("Message", "of", "record")
        for one in (*call.args, *(keyword.value for keyword in call.keywords if keyword.arg not in OF_RECORDS))
        for node in ast.walk(one)
        if isinstance(node, ast.JoinedStr) and any(_WORDS.search(part.value) for part in node.values if is_text(part))
    ]
    assert found == []


def test_numbers_in_messages_are_numbers():
    """None is written by Python, with a point where a language has a comma."""
    found = [
        f"{source.name}:{value.lineno}: {ast.unparse(value)}"
        for source, call in calls("Message", "of")
        for value in values_in(call)
        if isinstance(value, ast.JoinedStr) and any(getattr(part, "format_spec", None) for part in value.values)
    ]
    assert found == []


def values_in(call):
    """What stands in the message that a call makes."""
    yield from (keyword.value for keyword in call.keywords)
    for one in call.args:
        yield from one.values if isinstance(one, ast.Dict) else ()


def is_text(part):
    return isinstance(part, ast.Constant)


def test_what_the_page_never_shows():
    """The modules that are left out are there, and the web application imports none of them by itself."""
    assert set(NOT_ON_PAGE) <= sources().keys()
    imported = {name for module in sources() if module.startswith("ballscrew.faces.web") for name in imports_of(module)}
    assert imported & {module for module in sources() if is_left_out(module)} == set()


def test_safety_is_said_by_messages():
    """A record with words that matter has a template with its numbers, which the page fills in its language."""
    without = {
        (source.name, id_of(node))
        for source, node in calls("Record")
        if any(fnmatch.fnmatch(id_of(node), one) for one in SAFETY)
        and not any(one.arg == "message" for one in node.keywords)
    }
    assert without == set()
    known = {id_of(node) for name in ("Record", "record", "Judgement") for _, node in calls(name)}
    assert {one for one in SAFETY if not fnmatch.filter(known, one) and "verdict." not in one} == set()


def test_the_file_is_sorted():
    """So that two people who add texts do not meet at the end of the file."""
    assert list(TEXTS) == sorted(TEXTS)


def test_every_text_is_used_and_there():
    """Literal keys are in the table; a key of the table is a literal, or begins with a prefix that names complete."""
    html = PAGE.joinpath("index.html").read_text(encoding="utf-8")
    code = "\n".join(SCRIPTS.values())
    named = set(re.findall(r'data-text(?:-[a-z-]+)?="([^"]+)"', html)) | set(re.findall(r'\btext\(\s*"([^"]+)"', code))
    assert named <= TEXTS.keys()
    quoted = set(re.findall(r'"([a-z_]+(?:\.[a-z0-9_]+)+)"', code))
    prefixes = tuple(re.findall(r"`([a-z_]+\.(?:[a-z_]+\.)*)\$\{", code))
    unused = {key for key in TEXTS.keys() - named - quoted if not key.startswith(prefixes)}
    assert unused == set()


def literals(script):
    """All that is quoted in a script."""
    return [_COMPUTED.sub("…", one[1] or one[2]) for one in _TOKEN.finditer(script) if one[1] or one[2]]


def test_no_script_has_a_text_of_its_own():
    found = {
        name: [one for one in literals(text) if _WORDS.search(one) and one not in CODES]
        for name, text in SCRIPTS.items()
    }
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_help_names_pages_of_the_theory():
    pages = set(re.findall(r'^  (?:"[a-z_.]+"|[a-z]+): "([a-z]+)",$', SCRIPTS["help.js"], re.MULTILINE))
    theory = Path(__file__).parents[3] / "docs" / "theory"
    assert len(pages) > 5
    assert {page for page in pages if not (theory / f"{page}.md").is_file()} == set()
    assert {f"help.page.{page}" for page in pages} == {key for key in TEXTS if key.startswith("help.page.")}


def test_cards_name_pages_of_the_documentation():
    pages = {page for script in SCRIPTS.values() for page in re.findall(r'documented\("([\w/]+)"', script)}
    docs = Path(__file__).parents[3] / "docs"
    assert {"howto/reversal", "howto/ripple"} <= pages
    assert {page for page in pages if not (docs / f"{page}.md").is_file()} == set()


def test_the_page_has_its_texts(server):
    found = server.client.get("/")
    assert TEXTS["page.lead"] in found.text
    assert "data-text" not in found.text
    again = server.client.get("/", headers={"If-None-Match": found.headers["etag"]})
    assert again.status_code == 304


def test_angles_of_a_message_are_those_of_the_program():
    angle = re.compile(r"\d+(?:\.\d+)?(?=\s?(?:deg\b(?!C)|°(?!\s?C)))")
    for template, text in overrides().items():
        assert set(angle.findall(text)) <= {*re.findall(r"\d+(?:\.\d+)?", template)}, template
