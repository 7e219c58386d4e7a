"""Counter-based random numbers: those of a point follow from its number and the seed alone.

Philox4x32-10 (Salmon, Moraes, Dror & Shaw 2011) turns a counter and a key into four words of 32 bits
by ten rounds of multiplication. The counter is the number of the point and that of a pair of inputs,
the key is the seed; so the numbers are the same whatever the blocks, the threads and the machines.
Implemented once for NumPy and once for compiled kernels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels.ir import Value, Writer, constant, integer

ROUNDS = 10
#: Multipliers of the first and the third word, and what is added to the halves of the key after each round.
MULTIPLIERS = (0xD2511F53, 0xCD9E8D57)
KEY_STEPS = (0x9E3779B9, 0xBB67AE85)
WORD = 0xFFFFFFFF
WORD_BITS = 32
#: A uniform number is made of the top 52 bits of two words and a half: with one bit more the half would be
#: rounded, and the largest number would be 1.
DROPPED_BITS = 12
SPACING = 2.0**-52

Words = tuple[NDArray[np.uint64], NDArray[np.uint64], NDArray[np.uint64], NDArray[np.uint64]]


def philox(counter: Words, key: tuple[int, int]) -> Words:
    """Four random words of 32 bits for each counter of four words (as 64-bit whole numbers)."""
    c0, c1, c2, c3 = counter
    k0, k1 = key
    for _ in range(ROUNDS):
        first, third = c0 * np.uint64(MULTIPLIERS[0]), c2 * np.uint64(MULTIPLIERS[1])
        c0, c1, c2, c3 = (
            (third >> np.uint64(WORD_BITS)) ^ c1 ^ np.uint64(k0),
            third & np.uint64(WORD),
            (first >> np.uint64(WORD_BITS)) ^ c3 ^ np.uint64(k1),
            first & np.uint64(WORD),
        )
        k0, k1 = (k0 + KEY_STEPS[0]) & WORD, (k1 + KEY_STEPS[1]) & WORD
    return c0, c1, c2, c3


def uniform(points: slice, inputs: int, seed: int) -> list[NDArray[np.float64]]:
    """Uniform random numbers between 0 and 1, ends excluded, for each of the inputs at the points of a slice."""
    number = np.arange(points.start, points.stop, dtype=np.uint64)
    low, high = number & np.uint64(WORD), number >> np.uint64(WORD_BITS)
    found: list[NDArray[np.float64]] = []
    for pair in range((inputs + 1) // 2):
        counter = low, high, np.full_like(low, pair), np.zeros_like(low)
        words = philox(counter, (seed & WORD, (seed >> WORD_BITS) & WORD))
        for one, other in (words[:2], words[2:]):
            bits = (one << np.uint64(WORD_BITS) | other) >> np.uint64(DROPPED_BITS)
            found.append((bits.astype(np.float64) + 0.5) * SPACING)
    return found[:inputs]


def emit_key_schedule() -> list[str]:
    """The halves of the key ``%seed`` in each round, as vectors are made of them later: ``%k0.0``, ``%k1.0``, …"""
    lines = [f"  %k0.0 = and i64 %seed, {WORD}", f"  %k1.0 = lshr i64 %seed, {WORD_BITS}"]
    for r in range(1, ROUNDS):
        for half, step in enumerate(KEY_STEPS):
            lines.append(f"  %t{half}.{r} = add i64 %k{half}.{r - 1}, {step}")
            lines.append(f"  %k{half}.{r} = and i64 %t{half}.{r}, {WORD}")
    return lines


def emit_uniform(w: Writer, number: Value, inputs: int) -> list[Value]:
    """:func:`uniform` in a kernel, for the points whose numbers are in a vector of whole numbers."""
    low, high = w.on_integers("and", number, integer(WORD)), w.on_integers("lshr", number, integer(WORD_BITS))
    keys = [[w.broadcast("i64", f"%k{half}.{r}") for half in range(2)] for r in range(ROUNDS)]
    found: list[Value] = []
    for pair in range((inputs + 1) // 2):
        c0, c1, c2, c3 = low, high, integer(pair), integer(0)
        for k0, k1 in keys:
            first = w.on_integers("mul", c0, integer(MULTIPLIERS[0]))
            third = w.on_integers("mul", c2, integer(MULTIPLIERS[1]))
            high_words = [w.on_integers("lshr", product, integer(WORD_BITS)) for product in (third, first)]
            c0, c1, c2, c3 = (
                w.on_integers("xor", w.on_integers("xor", high_words[0], c1), k0),
                w.on_integers("and", third, integer(WORD)),
                w.on_integers("xor", w.on_integers("xor", high_words[1], c3), k1),
                w.on_integers("and", first, integer(WORD)),
            )
        for one, other in ((c0, c1), (c2, c3)):
            both = w.on_integers("or", w.on_integers("shl", one, integer(WORD_BITS)), other)
            bits = w.on_integers("lshr", both, integer(DROPPED_BITS))
            number_of_bits = w.instruction(f"uitofp {w.integers} {bits} to {w.doubles}")
            found.append(w.exact("fmul", w.exact("fadd", number_of_bits, constant(0.5)), constant(SPACING)))
    return found[:inputs]
