"""What a command says on a terminal while it works: what that costs, what is compiled, and how far it is."""

import os
import pty
import re
import threading
from importlib.util import find_spec
from pathlib import Path

import pytest

from support.commands import ROOT

pytestmark = pytest.mark.slow

EXAMPLES = ROOT / "examples"
COMPILING = re.compile(r"compiling a kernel of \d+ lines: some \d+ s, once")
#: What moves the cursor and colours a terminal.
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


@pytest.fixture
def on_terminal(commands, tmp_path):
    """A command whose error stream is a terminal: all that it says there. It finds no kernels on the disk."""

    def command(*arguments):
        ours, its = pty.openpty()
        said = []

        def read():
            try:
                while found := os.read(ours, 65536):
                    said.append(found)
            except OSError:  # the other end is closed
                return

        reader = threading.Thread(target=read)
        with (tmp_path / "output").open("wb") as output, Path(os.devnull).open("rb") as nothing:
            process = commands.start(
                arguments,
                folder=tmp_path,
                streams=[nothing.fileno(), output.fileno(), its],
                environment={"BALLSCREW_CACHE": str(tmp_path / "cache"), "TERM": "xterm", "COLUMNS": "120"},
            )
            os.close(its)
            reader.start()
            code = process.wait(300)
        reader.join()
        os.close(ours)
        text = b"".join(said).decode()
        assert code == 0, text
        return CONTROL.sub("", text)

    return command


@pytest.mark.compiles
@pytest.mark.skipif(not find_spec("pymoo"), reason='needs pymoo, of the extra "optimise"')
def test_a_search_says_what_it_costs_what_it_compiles_and_how_far_it_is(on_terminal):
    small = ["--population", "8", "--generations", "3", "--members", "1", "--set", "optimise.elastic_generations=1"]
    said = on_terminal("optimise", EXAMPLES / "needs" / "feed_axis.toml", *small)
    lines = [line.rstrip() for line in re.split(r"[\r\n]+", said)]
    assert lines[0].startswith("32 designs, then at most 1 in full: some ")
    assert len([line for line in lines if COMPILING.fullmatch(line)]) == 2  # of rigid bodies, and of elastic ones
    assert any(line.startswith("designs ━") and " 73% " in line for line in lines)  # 24 of 33: those of rigid bodies


@pytest.mark.parametrize(
    ("command", "options"),
    [("reversal", []), ("ripple", []), ("hand-over", ["--to", "c", "-o", "out"])],
    ids=["reversal", "ripple", "hand-over"],
)
def test_what_takes_seconds_is_named_while_it_lasts(on_terminal, command, options):
    said = on_terminal(command, EXAMPLES / "service.toml", *options)
    assert f"{command} ━" in said


@pytest.mark.compiles
def test_a_sweep_says_on_a_terminal_that_it_compiles(on_terminal):
    """Once: not again among what a sweep logs."""
    arguments = ["--vary", "screw_speed=1:3000:4000 rpm", "--output", "screw_torque", "--to", "out.zarr"]
    said = on_terminal("sweep", EXAMPLES / "catalogue_screw.toml", *arguments)
    assert len(COMPILING.findall(said)) == 1, said
