"""A unit at the head of a comment, without the brackets by which it would be one."""

import re
from collections.abc import Container

from mechsheet import units

# Units that no comment begins with as a word, a name or a standard, as one may with bar, min, in, at or EN.
_ALONE = (
    r"[mcdku]m[²³]?|m[²³]|[km]g|ms|([kMm]|da)N|[hkMG]?Pa|mbar|[pk]si|[kMm][JW]|kWh|hp|[kM]?Hz|m?rad|deg|arcmin|arcsec"
    r"|rpm|kip|lbf|kgf|inch|ft"
)
_LETTERS = frozenset("msNWJK")  # in products: others of one letter are as often quantities
_GOES_ON = re.compile(r"of|is|are|was|and|or|to|for|from|in|at|on|with|as|by|per|\W.*")  # a sentence


def unbracketed(comment: str, names: Container[str] = ()) -> str:
    """A comment as it declares its unit, where words follow that; "" where it begins with none.

    What is written with ``names`` alone, which the line reads, is a formula.

    >>> unbracketed("MPa stress"), unbracketed("m/s speed"), unbracketed("m is the module"), unbracketed("in mm")
    ('[MPa] stress', '[m/s] speed', '', '')
    """
    unit, *words = comment.split()
    if not words or _GOES_ON.fullmatch(words[0]) or "[" in comment:
        return ""
    used = re.findall(r"[^\W\d_]+", unit)
    product = re.search(r"[*/^·⋅]", unit) and (max(map(len, used), default=0) > 1 or _LETTERS.issuperset(used))
    if all(name in names for name in used) or not (product or re.fullmatch(_ALONE, unit)):
        return ""
    return f"[{unit}] {' '.join(words)}" if units.known(unit) else ""
