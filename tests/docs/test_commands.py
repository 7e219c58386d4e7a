"""Every command of the README and the documentation, as it stands there, in a copy of what people have.

The commands of a page run one after the other, so that a later one finds what an earlier one wrote.
"""

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

from ballscrew.questions.reproduce.preloaded_nut import CASE, CASE_FILE

from .pages import ROOT, blocks, commands, name, pages

pytestmark = pytest.mark.slow

#: Run by ``.ci/run`` itself, which is what keeps them true.
RUN_BY_CI = ("make demo", "make test")

#: Commands that are not run here, and why.
EXCEPTIONS = {
    ".venv/bin/ballscrew fit DATA_EMPS.mat --case emps.toml --test DATA_EMPS_PULSES.mat": (
        "needs the records of the benchmark, of which no copy is here as their licence is not stated"
    ),
    '.venv/bin/pip install ".[fast]"': "a test must not change what is installed, nor need a network",
    ".venv/bin/ballscrew sweep examples/feed_drive.toml --to /shared/map.zarr --scheduler tcp://head:8786": (
        "it needs a scheduler and a disk that machines share; tests/engine/sweeps/test_cluster.py has its own"
    ),
    '.venv/bin/ballscrew condition xjtu.csv --case examples/xjtu.toml --speed "100 rpm" --column torque=upper': (
        "the licence of the data is not stated, so the repository has none of it"
    ),
    (
        '.venv/bin/ballscrew condition xjtu.csv --case examples/xjtu.toml --speed "100 rpm" --column torque=lower '
        "--set nut.type=double"
    ): ("the licence of the data is not stated, so the repository has none of it"),
    **dict.fromkeys(
        ("make dist", "make trials"), "it takes minutes and a network; tests/conformance/test_release.py has its rules"
    ),
    **dict.fromkeys(
        (
            "make release VERSION=0.2.0",
            "make release VERSION=0.2.0 DO=1",
            "git push --atomic origin HEAD v0.2.0",
        ),
        "it needs a clone, and changes or publishes it; tests/conformance/test_release.py makes one in a clone",
    ),
    **dict.fromkeys(
        (
            "podman build --tag ballscrew .",
            "podman run --rm --read-only --tmpfs /tmp --cap-drop all --publish 127.0.0.1:8017:8017 ballscrew",
        ),
        "it needs an engine of containers, which machines that run tests need not have",
    ),
}

#: What such a command must have in it that would fail or hurt here; without it there is no reason to leave it out.
CANNOT_RUN_HERE = re.compile(
    r"pip install|benchmarks/|tcp://head:|xjtu\.csv|DATA_EMPS|make (?:dist|trials|release)|git push|podman "
)

#: Options that write a file. A command without them does the same on every page, and is run for the first of them.
WRITES = re.compile(r"\s(?:--to|--out|--output-file|--picture|-o)\b|\bout/|>")

#: Exit codes that a page announces.
EXIT_CODES = {
    ".venv/bin/ballscrew condition examples/nut_new.csv examples/nut_worn.csv --case examples/service.toml": 2,
}

SERVES = re.compile(r"^(?:\.venv/bin/)?ballscrew serve\b(?!.*--help)")

EVERY = {page: commands(page) for page in pages()}
PAGES = [page for page, typed in EVERY.items() if typed]


def left_out(command):
    return command in RUN_BY_CI or command in EXCEPTIONS


@pytest.fixture
def place(tmp_path):
    """A folder with what a reader has: the examples, the pages, and the program where the pages say that it is."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    shutil.copy(ROOT / "README.md", tmp_path)
    (tmp_path / CASE_FILE).write_text(CASE, encoding="utf-8")  # what ballscrew reproduce writes beside its page
    (tmp_path / ".venv").symlink_to(Path(sys.executable).parents[1], target_is_directory=True)
    return tmp_path


def environment():
    here = str(Path(sys.executable).parent)
    return {**os.environ, "PATH": f"{here}{os.pathsep}{os.environ['PATH']}", "COLUMNS": "110", "NO_COLOR": "1"}


#: What only a shell understands.
SHELL = re.compile(r"[|&;<>$`*?~\n]")
PROGRAM = re.compile(r"^(?:\.venv/bin/)?ballscrew ")


def run(command, place, commands):
    """Run a command: in a process that has its libraries at once if that says the same, else in a shell."""
    if PROGRAM.match(command) and not SHELL.search(command):
        return commands.run(shlex.split(command)[1:], folder=place, environment=environment())
    return typed(command, place)


def typed(command, place):
    return subprocess.run(
        ["bash", "-c", command], cwd=place, env=environment(), capture_output=True, encoding="utf-8", check=False
    )


def served(command, place):
    """Start it, ask it for its page, stop it as people do: with Ctrl-C."""
    # what else runs on this machine may have the usual port
    words = ["bash", "-c", f"exec {command}" if "--port" in command else f"exec {command} --port 0"]
    log = place / "serve.log"
    with log.open("w", encoding="utf-8") as heard:
        server = subprocess.Popen(words, cwd=place, env=environment(), stdout=heard, stderr=subprocess.STDOUT)
        try:
            page = _page_of(server, log)
        finally:
            server.send_signal(signal.SIGINT)
            code = server.wait(300)
    assert "<html" in page.lower(), f"{command}\nno page came: {page[:200]}"
    assert code in (0, 130, -signal.SIGINT), f"{command}\nended with {code}\n{log.read_text()}"


def _page_of(server, log):
    """What stands at the address that it says it listens on."""
    for _ in range(3000):
        said = log.read_text(encoding="utf-8")
        address = re.search(r"http://[\w.:-]+", said)
        assert server.poll() is None, f"it ended by itself\n{said}"
        if address:
            try:
                with urllib.request.urlopen(f"{address[0]}/", timeout=60) as answer:
                    return answer.read().decode()
            except OSError:
                pass  # it says where it will listen before it does
        time.sleep(0.1)
    raise AssertionError(f"no page within five minutes\n{log.read_text()}")


#: The first page that has a command.
FIRST = {}
for page, typed_there in EVERY.items():
    for _, one in typed_there:
        FIRST.setdefault(one, page)


def _run_by_the_docs(page):
    """Whether what writes the pages runs all of it: there, a command that fails is an error."""
    return all(block.written for block in blocks(page) if block.info == "console")


def _plain(command):
    return command.removeprefix(".venv/bin/")


#: Commands that are run for what some page shows of them. On another page, they are needed only for the files that
#: they write.
BUILT = {_plain(command) for page in PAGES for _, command in commands(page, written=True)}


def test_the_long_pages_are_run_by_what_writes_them():
    """Each of their commands stands in a block that is compared with what the command prints."""
    assert sum(not _run_by_the_docs(page) for page in PAGES) >= 10
    steps = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    assert any("make pages CHECK=1" in step for step in steps)


@pytest.mark.parametrize(
    "page", [pytest.param(p, marks=[pytest.mark.long] if _run_by_the_docs(p) else []) for p in PAGES], ids=name
)
def test_the_commands_of_a_page_do_what_it_says(page, place, commands):
    for line, command in EVERY[page]:
        if left_out(command):
            continue
        elsewhere = FIRST[command] != page or (_plain(command) in BUILT and not _run_by_the_docs(page))
        if elsewhere and not WRITES.search(command):
            continue
        if SERVES.match(command):
            served(command, place)
            continue
        done = run(command, place, commands)
        expected = EXIT_CODES.get(command, 0)
        assert done.returncode == expected, (
            f"{name(page)}:{line}: {command}\nends with {done.returncode}\n{done.stderr}"
        )
        assert "Traceback" not in done.stderr, done.stderr


def test_a_command_does_the_same_when_it_is_typed(place, commands):
    """The other tests of commands do without a shell, and without the script that the installation made."""
    command = '.venv/bin/ballscrew run examples/feed_drive.toml --set operation.axial_load="2 kN"'
    assert command in {typed for _, typed in EVERY[ROOT / "README.md"]}
    asked, expected = run(command, place, commands), typed(command, place)
    assert expected.returncode == 0, expected.stderr
    assert (asked.returncode, asked.stdout) == (0, expected.stdout)


def test_ci_runs_what_is_left_to_it():
    ci = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    for command in RUN_BY_CI:
        make, *targets = command.split()
        assert make == "make"
        for target in targets:
            assert f"make {target}" in ci, f".ci/run does not run make {target}"


@pytest.mark.parametrize("failing", ["", "lint", "docs", "test"])
def test_ci_ends_well_only_if_all_targets_do(tmp_path, failing):
    """The real script with a ``make`` that does nothing: its exit status is all that a machine reads of it."""
    (tmp_path / ".ci").mkdir()
    shutil.copy(ROOT / ".ci" / "run", tmp_path / ".ci" / "run")
    programs = tmp_path / "programs"
    programs.mkdir()
    for program in ("make", "npm", "chromium"):
        (programs / program).write_text(f'#!/bin/sh\n[ "$1" != "{failing}" ]\n' if failing else "#!/bin/sh\n")
        (programs / program).chmod(0o755)
    environment = os.environ | {"PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
    ended = subprocess.run([tmp_path / ".ci" / "run"], env=environment, capture_output=True, timeout=60)
    assert (ended.returncode == 0) == (not failing), ended.stderr


def test_no_exception_outlives_its_page():
    on_pages = {command for typed in EVERY.values() for _, command in typed}
    for command in (*RUN_BY_CI, *EXCEPTIONS, *EXIT_CODES):
        assert command in on_pages, f"no page has it any more: {command}"


@pytest.mark.parametrize("command", EXCEPTIONS)
def test_no_exception_without_need(command):
    assert CANNOT_RUN_HERE.search(command), "it can be run here, so it has to be"
    assert len(EXCEPTIONS[command].split()) > 4


def test_commands_stand_in_console_blocks():
    """A command in a block of another kind would not be run, and nobody would notice; what is written was run."""
    for page in pages():
        for block in blocks(page):
            if not block.written and block.info in ("", "text", "bash", "sh", "shell"):
                for line in block.text.splitlines():
                    assert not re.match(r"(\$ |\.venv/bin/|ballscrew [a-z]+ )", line), (
                        f"{name(page)}:{block.line}: {line}"
                    )
