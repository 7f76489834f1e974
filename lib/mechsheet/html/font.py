"""STIX Two Math, cut to the signs that a document has, to be part of its file."""

import base64
from collections.abc import Iterable
from functools import lru_cache
from importlib.metadata import distribution
from io import BytesIO
from pathlib import Path

# What a number, a unit or a reason may have once an input is changed, and the sign of a root, which no text has.
_ALWAYS = "".join(map(chr, range(0x20, 0x7F))) + "−·⋅×∞…°–≤≥√⁻⁰¹²³⁴⁵⁶⁷⁸⁹\u202f"
_CAPITAL, _SMALL, _GREEK_CAPITAL, _GREEK_SMALL = 0x1D434, 0x1D44E, 0x1D6E2, 0x1D6FC  # slanted letters of mathematics
_SLANTED = {"h": "\u210e", "ϵ": "\U0001d716", "ϑ": "\U0001d717", "ϕ": "\U0001d719"}  # which stand apart

_BELOW = 225  # of 1000: how far letters reach below the line


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


@lru_cache(maxsize=8)
def _cut(signs: frozenset[str]) -> str:
    from fontTools import subset  # type: ignore[import-untyped]  # on use: it takes a quarter of a second

    options = subset.Options()
    options.flavor = "woff"  # woff2 would need a package more
    options.layout_features = ["ssty", "dtls", "flac", "kern", "mark", "mkmk"]  # of mathematics
    options.notdef_outline, options.recalc_timestamp, options.hinting = True, False, False
    path = Path(str(distribution("ziamath").locate_file("ziamath/fonts/STIXTwoMath-Regular.ttf")))
    out, cutter = BytesIO(), subset.Subsetter(options)
    with subset.load_font(path, options) as font:
        cutter.populate(unicodes=[ord(sign) for sign in signs])
        cutter.subset(font)
        # Letters that reach below the line have their index where the others have it, as in print.
        constants = font["MATH"].table.MathConstants
        constants.SubscriptBaselineDropMin.Value = constants.SubscriptShiftDown.Value - _BELOW
        subset.save_font(font, out, options)
    return base64.b64encode(out.getvalue()).decode()
