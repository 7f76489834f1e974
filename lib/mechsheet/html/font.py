"""STIX Two Math: whole for a page that is served, and cut to the signs that a document has, to be part of its file."""

import base64
import struct
from collections.abc import Iterable
from functools import cache, lru_cache
from importlib.metadata import distribution
from io import BytesIO
from pathlib import Path

# What a number, a unit or a reason may have once an input is changed, and the sign of a root, which no text has.
_ALWAYS = "".join(map(chr, range(0x20, 0x7F))) + "−·⋅×∞…°–≤≥√⁻⁰¹²³⁴⁵⁶⁷⁸⁹\u202f"
_CAPITAL, _SMALL, _GREEK_CAPITAL, _GREEK_SMALL = 0x1D434, 0x1D44E, 0x1D6E2, 0x1D6FC  # slanted letters of mathematics
_SLANTED = {"h": "\u210e", "ϵ": "\U0001d716", "ϑ": "\U0001d717", "ϕ": "\U0001d719"}  # which stand apart

_BELOW = 225  # of 1000: how far letters reach below the line
_TABLES, _ENTRY = 12, 16  # bytes before the table of a font's tables, and of each of them
_SHIFT, _DROP = 24, 32  # among the constants of mathematics: how far an index stands below the line, and below its base


def slanted(letter: str) -> str:
    """The letter of mathematics that a browser draws for a variable of one letter.

    >>> slanted("x"), slanted("φ"), slanted("h"), slanted("2")
    ('𝑥', '𝜑', 'ℎ', '2')
    """
    for first, last, start in (
        ("A", "Z", _CAPITAL),
        ("a", "z", _SMALL),
        ("Α", "Ω", _GREEK_CAPITAL),
        ("α", "ω", _GREEK_SMALL),
    ):
        if first <= letter <= last and letter not in _SLANTED:
            return chr(start + ord(letter) - ord(first))
    return _SLANTED.get(letter, letter)


def address(signs: Iterable[str]) -> str:
    """Address that holds the font with these signs, their slanted forms, and what a number may need."""
    letters = {*_ALWAYS, *signs}
    return f"data:font/woff;base64,{_cut(frozenset(letters | set(map(slanted, letters))))}"


@cache
def whole() -> bytes:
    """The font; letters that reach below the line have their index where the others have it, as in print."""
    path = Path(str(distribution("ziamath").locate_file("ziamath/fonts/STIXTwoMath-Regular.ttf")))
    font = bytearray(path.read_bytes())
    (count,) = struct.unpack_from(">H", font, 4)
    entries = [struct.unpack_from(">4sLLL", font, _TABLES + _ENTRY * n) for n in range(count)]
    (math,) = (start for tag, _, start, _ in entries if tag == b"MATH")
    constants = math + struct.unpack_from(">H", font, math + 4)[0]
    (shift,) = struct.unpack_from(">h", font, constants + _SHIFT)
    struct.pack_into(">h", font, constants + _DROP, shift - _BELOW)
    return bytes(font)


@lru_cache(maxsize=8)
def _cut(signs: frozenset[str]) -> str:
    from fontTools import subset  # type: ignore[import-untyped]  # on use: it takes a quarter of a second

    options = subset.Options()
    options.flavor = "woff"  # woff2 would need a package more
    options.layout_features = ["ssty", "dtls", "flac", "kern", "mark", "mkmk"]  # of mathematics
    options.notdef_outline, options.recalc_timestamp, options.hinting = True, False, False
    out, cutter = BytesIO(), subset.Subsetter(options)
    with subset.load_font(BytesIO(whole()), options) as font:
        cutter.populate(unicodes=[ord(sign) for sign in signs])
        cutter.subset(font)
        subset.save_font(font, out, options)
    return base64.b64encode(out.getvalue()).decode()
