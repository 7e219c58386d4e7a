"""Numbers in texts as people write them, without the notation of programs."""

from __future__ import annotations

import re

#: A number as programs write it, such as 4.03e+08.
_WRITTEN_BY_PROGRAMS = re.compile(r"(?<![\w.])(?P<sign>[-\u2212]?)(?P<digits>\d+(?:\.\d+)?)e(?P<power>[+-]?\d+)(?!\w)")
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
#: From where on and up to where numbers are counted in millions; below which size they are not written out.
MILLIONS, _LARGEST, _SMALLEST = 1e7, 1e12, 1e-4


def plain(text: str) -> str:
    """A text with its numbers written out: ``4.03e+08`` is ``403 million``, ``1.5e-08`` is ``1.5 × 10⁻⁸``."""
    return _WRITTEN_BY_PROGRAMS.sub(_written_out, text)


def _written_out(match: re.Match[str]) -> str:
    digits, power = match["digits"], int(match["power"])
    size = float(f"{digits}e{power}")
    if size and not _SMALLEST <= size < _LARGEST:
        times = "" if digits == "1" else f"{digits} × "
        return f"{match['sign']}{times}10{str(power).translate(_SUPERSCRIPTS)}"
    if size >= MILLIONS:
        return f"{match['sign']}{size / 1e6:.10g} million"
    decimals = max(0, len(digits.partition(".")[2]) - power)
    return f"{match['sign']}{size:.{decimals}f}"
