"""Names of variables as symbols of the field: ``phi34`` is φ with index 34."""

import re
from dataclasses import dataclass
from functools import cache, lru_cache

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "eps": "ε", "epsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "kappa": "κ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Sigma": "Σ",
    "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
INDEXED = r"[A-Za-z]+\d*_\w+"  # a name that tells itself from a word: its index stands behind an underscore
_WORDS = "|".join(sorted(GREEK, key=len, reverse=True))
IN_PROSE = rf"(?<!\d )\b(?:{INDEXED}|(?:{_WORDS})\d*)\b(?!\.\w)"  # names that no word of a sentence is
_NAME = re.compile(rf"(d(?=[A-Z]|{_WORDS}))?({_WORDS}|[A-Za-z])_?(\w*)")


@dataclass(frozen=True, slots=True)
class Symbol:
    """A name as the field writes it: ``base`` is one letter or one word, ``mark`` stands before it or over it.

    Marks are ``Δ``, ``d``, and dots: ``.`` and ``..``.
    """

    base: str
    index: str = ""
    mark: str = ""


@cache
def read(name: str) -> Symbol:
    """Symbol of a name; one word of small letters stays whole, as does one of five capitals or more.

    The rule: a leading ``d`` before a Greek word, a capital letter or the only letter is a difference or derivative;
    the base is one Greek word or one letter, or a word of small letters before an underscore; the rest is the index.

    >>> read("phi34"), read("GS6_max")
    (Symbol(base='φ', index='34', mark=''), Symbol(base='G', index='S6,max', mark=''))
    >>> read("group_23"), read("h_phi6"), read("GS6max").index
    (Symbol(base='group', index='23', mark=''), Symbol(base='h', index='φ6', mark=''), 'S6,max')
    >>> read("dphi3"), read("dRa"), read("gap").base
    (Symbol(base='φ', index='3', mark='d'), Symbol(base='R', index='a', mark='Δ'), 'gap')
    >>> read("WIDTH"), read("LENGTH_2")
    (Symbol(base='WIDTH', index='', mark=''), Symbol(base='LENGTH', index='2', mark=''))
    >>> read("ds")
    Symbol(base='s', index='', mark='d')
    """
    greek = re.match(_WORDS, name)
    if re.fullmatch("d[a-z]", name):
        return Symbol(name[1], mark="d")
    if title := re.fullmatch(r"(d?)([A-Z]{5,})(\d*)(?:_(\w+))?", name):
        return Symbol(title[2], ",".join(filter(None, (title[3], _index(title[4] or "")))), "Δ" if title[1] else "")
    word = re.fullmatch(r"([a-z]{3,})(?:_(\w*))?", name)
    if word and not greek and not re.match(f"d({_WORDS})", name):
        return Symbol(word[1], _index(word[2] or ""))
    match = (re.fullmatch(rf"()({_WORDS})_?(\w*)", name) if greek else None) or _NAME.fullmatch(name)
    if not match:
        return Symbol(name)
    base = GREEK.get(match[2], match[2])
    mark = match[1] and ("d" if base in _LETTERS else "Δ")
    return Symbol(base, _index(match[3]), mark or "")


def _index(text: str) -> str:
    """Underscores of an index as commas, as before a word behind a digit; Greek words by themselves as letters."""
    letters = re.sub(rf"(?<![A-Za-z])({_WORDS})(?![a-z])", lambda m: GREEK[m[0]], text.strip("_"))
    return re.sub(r"(?<=\d)(?=[a-z]{3,}$)", ",", letters.replace("_", ","))


_LETTERS = frozenset(GREEK.values())


def is_field(name: str) -> bool:
    """Whether the name says "over S": ``phi34_S`` is printed φ34(S)."""
    return name.endswith("_S") and len(name) > 2


def stem(name: str) -> str:
    """Name without the ``_S`` of a field."""
    return name[:-2] if is_field(name) else name


def plain(name: str) -> str:
    """Name as a table heading prints it: without the ``_S`` of a field and without underscores.

    >>> plain("phi34_S"), plain("GS6_max"), plain("S_p")
    ('phi34', 'GS6max', 'Sp')
    """
    return stem(name).replace("_", "")


def pieces(sentence: str, names: tuple[str, ...] = ()) -> list[str]:
    """A sentence in pieces: every second one is the name of a quantity, one of the ``names`` or what looks like one.

    >>> pieces("omega3 < 1, theta/2")
    ['', 'omega3', ' < 1, ', 'theta', '/2']
    >>> pieces("UGL2: Imp = I56, l20 = H")  # what an equation makes equal, too; a program is no quantity
    ['UGL2: ', 'Imp', ' = ', 'I56', ', ', 'l20', ' = ', 'H', '']
    >>> pieces("Find = closed form at S = 0.6 m")  # nor is a word
    ['Find = closed form at ', 'S', ' = 0.6 m']
    >>> pieces("m in 0..3 m, SAB = 2 mm/m", ("m", "SAB"))  # a unit is no name
    ['', 'm', ' in 0..3 m, ', 'SAB', ' = 2 mm/m']
    """
    return _looks_like_a_name(names).split(sentence)


@lru_cache(maxsize=64)
def _looks_like_a_name(names: tuple[str, ...]) -> re.Pattern[str]:
    given = "".join(rf"(?<!\d )(?<![*/·]){re.escape(name)}\b|" for name in names)
    indexed = r"(?![A-Z]{3,}\d+\b)[A-Za-z]+[_\d]\w*"
    equal = rf"[A-Z][a-z]{{0,3}}(?= = (?:[-\d]|{indexed}))|(?<= = )[A-Z](?![\w.])"
    return re.compile(rf"\b({given}(?:{_WORDS})\b|{indexed}|{equal})")


def prose(sentence: str) -> str:
    """A sentence in plain characters, Greek words in it as letters.

    >>> prose("half the arc, for cos(phi) + c = 1; 40 psi, delta_F")
    'half the arc, for cos(φ) + c = 1; 40 psi, delta_F'
    """
    return re.sub(IN_PROSE, lambda m: m[0] if "_" in m[0] else text(m[0]), sentence)


def text(name: str) -> str:
    """Name in plain characters, for charts and the terminal.

    >>> text("phi34"), text("dRa")
    ('φ34', 'ΔRa')
    """
    symbol = read(stem(name))
    return symbol.mark + symbol.base + symbol.index
