"""Random numbers by counting: the published answers, in NumPy and in compiled kernels."""

import numpy as np
import pytest

from ballscrew.compiler.kernels import random
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.kernels.kernel import Kernel
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import (
    Tape,
)

#: Known answers of Philox4x32-10, published with Salmon, Moraes, Dror & Shaw 2011: counter, key, words.
ANSWERS = {
    "zeros": ((0, 0, 0, 0), (0, 0), (0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8)),
    "ones": ((0xFFFFFFFF,) * 4, (0xFFFFFFFF,) * 2, (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD)),
    "digits of pi": (
        (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
        (0xA4093822, 0x299F31D0),
        (0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
    ),
}
SEEDS = [0, 1, 2**32 + 7, 2**63 - 1]


def words(*numbers):
    return tuple(np.array([n], dtype=np.uint64) for n in numbers)


@pytest.mark.parametrize("name", ANSWERS)
def test_known_answers(name):
    counter, key, expected = ANSWERS[name]
    assert tuple(int(word[0]) for word in random.philox(words(*counter), key)) == expected


def test_a_number_is_made_of_two_words():
    """The first 52 bits of two words and a half: point 0, inputs 0 and 1, seed 0."""
    first, second = random.uniform(slice(0, 1), 2, 0)
    assert first[0] == ((0x6627E8D5E169C58D >> 12) + 0.5) / 2**52
    assert second[0] == ((0xBC57AC4C9B00DBD8 >> 12) + 0.5) / 2**52


@pytest.mark.parametrize(("word", "expected"), [(0, 2.0**-53), (0xFFFFFFFF, 1 - 2.0**-53)])
def test_the_ends_are_excluded(monkeypatch, word, expected):
    monkeypatch.setattr(random, "philox", lambda counter, key: words(*[word] * 4))
    (found,) = random.uniform(slice(0, 1), 1, 0)
    assert found[0] == expected


def test_the_mean_and_the_spread_of_uniform_numbers():
    """1/2 and 1/12, to five standard errors: √(1/12n) and √(1/180n)."""
    count = 200_000
    for numbers in random.uniform(slice(0, count), 3, 4):
        assert abs(numbers.mean() - 1 / 2) < 5 * (1 / (12 * count)) ** 0.5
        assert abs(((numbers - 0.5) ** 2).mean() - 1 / 12) < 5 * (1 / (180 * count)) ** 0.5


def test_inputs_do_not_follow_each_other():
    """The correlation of independent numbers is 0, with standard error 1/√n."""
    count = 200_000
    a, b, c = random.uniform(slice(0, count), 3, 4)
    other = random.uniform(slice(0, count), 1, 5)[0]
    for one, two in ((a, b), (a, c), (b, c), (a, other), (a[:-1], a[1:])):
        assert abs(np.corrcoef(one, two)[0, 1]) < 5 / (one.size**0.5)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("start", [0, 3, 2**32 - 5])
def test_numbers_do_not_depend_on_the_others(start, seed):
    """Neither on the points that are asked for at once, nor on how many inputs there are."""
    whole = random.uniform(slice(start, start + 40), 5, seed)
    for first, last, inputs in ((0, 1, 1), (0, 40, 2), (7, 20, 3), (39, 40, 5)):
        part = random.uniform(slice(start + first, start + last), inputs, seed)
        assert len(part) == inputs
        for one, all_of_it in zip(part, whole, strict=False):
            assert np.array_equal(one, all_of_it[first:last])


@pytest.mark.compiles
@pytest.mark.parametrize("lanes", [8, 32])
@pytest.mark.parametrize("inputs", [1, 2, 5])
def test_kernels_make_the_same_numbers(inputs, lanes):
    """To the last bit, whatever the first point, the number of points and the lanes of a vector."""
    tape = Tape(inputs)
    program = Program.of(tape, {str(i): tape.value(i) for i in range(inputs)})
    sources = ["random"] * inputs
    kernel = Kernel.of(kernel_text(program, sources, {str(i): False for i in range(inputs)}, lanes=lanes), sources)
    for seed in SEEDS:
        for start, count in ((0, 1), (0, 64), (5, 101), (2**32 - 50, 77), (10**12, 33)):
            results = [np.full(count + 1, 99.0) for _ in range(inputs)]
            points = slice(start, start + count)
            kernel(slice(0, 1), points, points.stop, [None] * inputs, results, first=start, seed=seed)
            for found, expected in zip(results, random.uniform(points, inputs, seed), strict=True):
                assert np.array_equal(found[:-1], expected)
                assert found[-1] == 99.0
