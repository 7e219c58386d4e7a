"""Kernels: the same as NumPy, whatever the blocks; kept on disk; still vectorised."""

import re
import stat
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ballscrew.compiler.kernels import kernel as kernels
from ballscrew.compiler.kernels.emission import UnknownOperationError, kernel_text
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from support.expressions import EXPRESSIONS
from support.small_kernels import compiled, played, recorded, run, text_of

pytestmark = pytest.mark.compiles
X = np.array([0.0, 0.25, 1.0, 2.0, 7.0, 0.5, np.inf, np.nan, 3.0, 1e-30, 1e30])
Y = np.array([3.0, 0.0, 1.0, 0.5, 2.0, np.nan, 1.0, 4.0, np.inf, 2.0, 1e-3])


@pytest.mark.parametrize("name", EXPRESSIONS)
@pytest.mark.parametrize("lanes", [8, 32])
def test_expressions(name, lanes):
    """All that the tape can record, also at zero, infinity and NaN."""
    program = recorded(EXPRESSIONS[name], 2)
    expected = played(program, X, Y)
    found = run(program, X, Y, lanes=lanes)
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    finite = np.isfinite(expected)
    assert np.array_equal(found[~finite], expected[~finite], equal_nan=True)
    # powers are exponentials: the last place of an exponent such as 69, for 1e30, counts 69 times; a product that is
    # subtracted is not rounded before, which differs by the last place of the product
    assert np.allclose(found[finite], expected[finite], rtol=2e-14, atol=1e-16)


MASKS = {
    "less": lambda x, y: x < y,
    "not": lambda x, y: ~(x >= y),
    "together": lambda x, y: (x < y) & (y != 2) | (x == 7),
    "either": lambda x, y: (x < y) ^ (y > 1),
    "finite": lambda x, y: np.isfinite(x * y),
    "no number": lambda x, y: np.isnan(x - y),
    "infinite": lambda x, y: np.isinf(x / y),
    "a choice of masks": lambda x, y: np.where(x > 1, y > 1, x < 0.3),
}


@pytest.mark.parametrize("name", MASKS)
def test_masks(name):
    program = recorded(MASKS[name], 2)
    assert np.array_equal(run(program, X, Y, mask=True), played(program, X, Y, mask=True))


@pytest.mark.parametrize("exponent", [9, 12, -9, 0.5, 0.3, -1.7])
def test_constant_powers_of_differences(exponent):
    program = recorded(lambda x, y: (x - y) ** exponent, 2)
    x, y = np.linspace(-2, 2, 41), np.full(41, 0.1)
    assert np.allclose(run(program, x, y), played(program, x, y), rtol=2e-14, atol=0, equal_nan=True)


def busy(x, y):
    """Enough of everything that a lane could go astray."""
    return np.where(x > 0.5, np.exp(-x) * y**0.3, np.sin(x) + np.sqrt(y)) / (1 + x**2)


@settings(deadline=None, max_examples=60)
@given(start=st.integers(0, 90), size=st.integers(1, 90), lanes=st.sampled_from([8, 16, 32]), aligned=st.booleans())
def test_any_part_gives_the_same_bits_and_touches_nothing_else(start, size, lanes, aligned):
    rng = np.random.default_rng(3)
    x, y = rng.uniform(0, 2, 200), rng.uniform(0, 2, 200)
    program = recorded(busy, 2)
    kernel = compiled(program, lanes=lanes)
    whole, part = aligned_array(200, float), aligned_array(202, float)[0 if aligned else 1 :][:200]
    kernel(slice(0, 1), slice(0, 200), 200, [x, y], [whole])
    part[:] = -1.0
    kernel(slice(0, 1), slice(start, start + size), 200, [x, y], [part])
    assert np.array_equal(part[start : start + size], whole[start : start + size])
    assert np.all(part[:start] == -1)
    assert np.all(part[start + size :] == -1)


def test_results_that_leave_the_cache_are_the_same():
    """Large aligned results are written past the cache: the other way to store."""
    count = kernels.LARGEST_CACHED // 8 + 13
    x = np.linspace(0, 2, count)
    program = recorded(busy, 2)
    kernel, large, small = compiled(program), aligned_array(count, float), aligned_array(100, float)
    kernel(slice(0, 1), slice(0, count), count, [x, x], [large])
    kernel(slice(0, 1), slice(0, 100), 100, [x, x], [small])
    assert np.array_equal(large[:100], small)
    assert np.allclose(large, played(program, x, x), rtol=1e-14)


def test_rows_and_columns():
    """A grid from one number for each row and an array over the columns."""
    tape = Tape(2)
    program = Program.of(tape, {"out": busy(tape.value(0), tape.value(1))})
    sources = ["rows", "columns"]
    kernel = Kernel.of(kernel_text(program, sources, {"out": False}, lanes=8), sources)
    rows, columns = np.linspace(0, 2, 7), np.linspace(0.1, 3, 1301)
    out = aligned_array(7 * 1301, float)
    kernel(slice(0, 7), slice(0, 1301), 1301, [rows, columns], [out])
    grid = [np.ascontiguousarray(a).ravel() for a in np.broadcast_arrays(rows[:, None], columns)]
    assert np.allclose(out, played(recorded(busy, 2), *grid), rtol=1e-14)


def test_several_outputs_and_the_inputs_themselves():
    tape = Tape(2)
    x, y = tape.value(0), tape.value(1)
    program = Program.of(tape, {"sum": x + y, "input": x, "mask": x > y, "mask as number": x > y})
    masks = {"sum": False, "input": False, "mask": True, "mask as number": False}
    kernel = Kernel.of(kernel_text(program, ["points"] * 2, masks), ["points"] * 2)
    results = [aligned_array(5, bool if masks[name] else float) for name in program.outputs]
    kernel(slice(0, 1), slice(0, 5), 5, [X[:5].copy(), Y[:5].copy()], results)
    assert np.array_equal(results[0], X[:5] + Y[:5])
    assert np.array_equal(results[1], X[:5])
    assert np.array_equal(results[2], X[:5] > Y[:5])
    assert np.array_equal(results[3], (X[:5] > Y[:5]).astype(float))


def test_unknown_operation():
    with pytest.raises(UnknownOperationError, match="sinh"):
        text_of(recorded(lambda x, y: np.sinh(x) + y, 2))


def test_arrays_must_be_contiguous():
    with pytest.raises(ValueError, match="contiguous"):
        compiled(recorded(busy, 2))(slice(0, 1), slice(0, 5), 5, [X[::2], Y[::2]], [aligned_array(5, float)])


# on disk


def forget():
    # as a new process, which has no kernel loaded
    kernels._kernels.clear()


def kept():
    return sorted(p for p in kernels.cache_folder().iterdir()) if kernels.cache_folder().exists() else []


def test_kernels_are_found_on_disk_again():
    forget()
    program = recorded(busy, 2)
    assert not kernels.is_cached(text_of(program))
    first = run(program, X, Y)
    (file,) = kept()
    written = file.read_bytes()
    forget()
    assert kernels.is_cached(text_of(program))
    assert np.array_equal(run(program, X, Y), first, equal_nan=True)
    assert file.read_bytes() == written
    run(recorded(lambda x, y: x - y, 2), X, Y)
    assert len(kept()) == 2


@pytest.mark.parametrize("damage", [b"", b"rubbish", b"no line in it at all"])
def test_a_damaged_file_is_compiled_anew(damage):
    forget()
    program = recorded(busy, 2)
    first = run(program, X, Y)
    (file,) = kept()
    whole = file.read_bytes()
    file.write_bytes(damage or whole[:-100])
    forget()
    assert np.array_equal(run(program, X, Y), first, equal_nan=True)
    assert file.read_bytes() == whole


def test_no_place_to_keep_kernels(tmp_path, monkeypatch):
    """A folder that cannot be made is no fault."""
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("BALLSCREW_CACHE", str(tmp_path / "file"))
    forget()
    program = recorded(busy, 2)
    assert np.allclose(run(program, X, Y), played(program, X, Y), rtol=1e-14, equal_nan=True)


def test_only_so_many_are_kept(monkeypatch):
    monkeypatch.setattr(kernels, "MOST_ON_DISK", 2)
    forget()
    for shift in (1.0, 2.0, 3.0):
        run(recorded(lambda x, y, s=shift: x + s * y, 2), X, Y)
    assert len(kept()) == 2


def test_others_cannot_write_to_the_folder():
    forget()
    run(recorded(busy, 2), X, Y)
    assert stat.S_IMODE(kernels.cache_folder().stat().st_mode) & 0o077 == 0


def test_a_folder_that_others_can_write_to_is_not_trusted():
    """Machine code that somebody else may have put there is not run."""
    forget()
    program = recorded(busy, 2)
    run(program, X, Y)
    (file,) = kept()
    kernels.cache_folder().chmod(0o777)
    # whether a file is loaded or compiled again shows in time alone
    assert kernels._load(file.name) is None
    kernels.cache_folder().chmod(0o700)
    file.chmod(0o666)
    # whether a file is loaded or compiled again shows in time alone
    assert kernels._load(file.name) is None
    file.chmod(0o600)
    # whether a file is loaded or compiled again shows in time alone
    assert kernels._load(file.name) is not None


# vectorised


def test_no_function_is_called_for_one_lane_at_a_time():
    """A kernel calls nothing but the copying of the last points; a mathematical library would go lane by lane."""
    program = recorded(lambda x, y: busy(x, y) + np.log(x) + np.arctan(y) + np.cos(x) + np.power(x, y), 2)
    # the machine code, which no result shows
    machine, module = kernels._optimise(text_of(program))
    assembly = machine.emit_assembly(module)
    called = set(re.findall(r"\b(?:callq?|bl|movabsq)\s+\$?([A-Za-z_]\w*)", assembly))
    assert called == {"memcpy"}


def test_vectors_are_vectors():
    """Most arithmetic on x86 is on packed numbers; elsewhere the calls above must do."""
    # the machine code, which no result shows
    machine, module = kernels._optimise(text_of(recorded(busy, 2)))
    assembly = machine.emit_assembly(module)
    packed, single = (len(re.findall(rf"\bv?f?m?(?:add|mul|sub|div)\w*{kind}\b", assembly)) for kind in ("pd", "sd"))
    if not packed + single:
        pytest.skip("not an x86 processor")
    assert packed > 20 * single


@pytest.mark.slow
def test_compiling_that_takes_long_is_logged_before_it_starts(caplog, capsys, monkeypatch):
    """Not what is compiled in an instant, and not what is kept already; in a console of Python it is also shown."""
    started = []
    # counts what is compiled
    whole = kernels._compile
    monkeypatch.setattr(kernels, "_compile", lambda *how: started.append(len(caplog.messages)) or whole(*how))

    def long(x, y):
        for place in range(1, 3000):
            x = x * y + 1 / place
        return x

    forget()
    program = recorded(long, 2)
    with caplog.at_level("INFO", "ballscrew"):
        compiled(recorded(busy, 2))
        compiled(program)
        forget()
        compiled(program)
    shown = capsys.readouterr().err.splitlines()
    lines = text_of(program).count("\n")
    assert caplog.messages == [f"compiling a kernel of {lines} lines: some {lines * kernels.LINE_SECONDS:.0f} s, once"]
    assert started == [0, 1]
    assert shown == []
    monkeypatch.setattr(sys, "ps1", ">>> ", raising=False)
    kernels.code_of(text_of(program))
    assert capsys.readouterr().err.splitlines() == caplog.messages
