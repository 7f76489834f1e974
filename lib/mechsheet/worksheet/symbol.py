"""Names of variables as symbols of the field: ``phi34`` is φ with index 34."""

import re
from dataclasses import dataclass
from functools import cache, lru_cache

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "eps": "ε", "epsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "iota": "ι", "kappa": "κ", "lam": "λ", "lamda": "λ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ",
    "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "upsilon": "υ", "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω",
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lamda": "Λ", "Lambda": "Λ", "Sigma": "Σ", "Upsilon": "Υ", "Phi": "Φ",
    "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
INDEXED = r"[^\W\d_]+\d*_\w+"  # a name that tells itself from a word: its index stands behind an underscore
LETTERS = "".join(map(chr, range(ord("Α"), ord("ω") + 1)))  # Greek ones, as they may stand in a name themselves
_WORDS = "|".join(sorted(GREEK, key=len, reverse=True))
_OF_UNIT = "psi"  # which is in a sentence a unit, unless a quantity of the worksheet is called so
IN_PROSE = rf"(?<!\d )\b(?:{INDEXED}|(?!{_OF_UNIT}\b)(?:{_WORDS})\d*)\b(?!\.\w)"  # names that no word of a sentence is
DOUBTFUL = rf"(?:(?!{IN_PROSE})[A-Za-z]+\d\w*|(?<!\d ){_OF_UNIT}\b)"  # what may be a grade, a fit or a unit as well
_ENDS = "(?=$|[^a-z]|min|max)"  # where an index may begin, not the rest of a word
# Many words begin as the short ones do, such as pin, nut, multiple and chip; sigmav is a stress.
LETTER = rf"(?:(?:pi|nu|mu|chi|lam){_ENDS}|(?!pi|nu|mu|chi|lam(?!b?da))(?:{_WORDS})|[{LETTERS}])"
DIFFERENCE = rf"d(?=[{LETTERS}]|(?:{_WORDS}){_ENDS})"  # that of detail is none
_SMALL, _CAPITAL = r"a-zß-öø-ÿ\u0100-\u017fа-яё", "A-ZÀ-ÖØ-ÞА-ЯЁ"
_NAME = rf"(d(?=[A-Z])|{DIFFERENCE}|Δ(?=[^\W\d_]))?({LETTER}|[^\W\d_])_?(\w*)"


@dataclass(frozen=True, slots=True)
class Symbol:
    """A name as the field writes it: ``base`` is one letter or one word, ``mark`` stands before it or over it.

    Marks are ``Δ``, ``d``, and dots: ``.`` and ``..``.
    """

    base: str
    index: str = ""
    mark: str = ""


def is_slanted(text: str) -> bool:
    """Whether print slants it: a letter, but no Greek capital, and no word.

    >>> is_slanted("φ"), is_slanted("Φ"), is_slanted("side")
    (True, False, False)
    """
    return len(text) == 1 and text.isalpha() and not "Α" <= text <= "Ω"


@cache
def read(name: str) -> Symbol:
    """Symbol of a name; one word of small letters stays whole, as does one of five capitals or more.

    The rule: a leading ``d`` before a Greek word, a capital letter or the only letter is a difference or derivative;
    the base is one Greek word or one letter, or a word of small letters before a number or an underscore; the rest is
    the index.

    >>> read("phi34"), read("GS6_max")
    (Symbol(base='φ', index='34', mark=''), Symbol(base='G', index='S6,max', mark=''))
    >>> read("group_23"), read("h_phi6"), read("GS6max").index
    (Symbol(base='group', index='23', mark=''), Symbol(base='h', index='φ6', mark=''), 'S6,max')
    >>> read("dphi3"), read("dRa"), read("gap").base
    (Symbol(base='φ', index='3', mark='d'), Symbol(base='R', index='a', mark='Δ'), 'gap')
    >>> read("WIDTH"), read("LENGTH_2")
    (Symbol(base='WIDTH', index='', mark=''), Symbol(base='LENGTH', index='2', mark=''))
    >>> read("ds"), read("λ_max"), read("pins23").base
    (Symbol(base='s', index='', mark='d'), Symbol(base='λ', index='max', mark=''), 'pins')
    >>> read("_sigma_max")
    Symbol(base='σ', index='max', mark='')
    """
    name = name.lstrip("_") or name  # those of one cell alone begin so
    if re.fullmatch("d[a-z]", name):
        return Symbol(name[1], mark="d")
    if title := re.fullmatch(rf"(d?)([{_CAPITAL}]{{5,}})(\d*)(?:_(\w+))?", name):
        return Symbol(title[2], ",".join(filter(None, (title[3], _index(title[4] or "")))), "Δ" if title[1] else "")
    word = re.fullmatch(rf"([{_SMALL}]{{3,}})(\d*(?:_\w*)?)", name)
    if word and not re.match(f"{LETTER}|{DIFFERENCE}", name):
        return Symbol(word[1], _index(word[2]))
    match = re.fullmatch(_NAME, name)
    if not match:
        return Symbol(name)
    base = GREEK.get(match[2], match[2])
    mark = match[1] and ("d" if match[1] == "d" and base in LETTERS else "Δ")
    return Symbol(base, _index(match[3]), mark or "")


def _index(text: str) -> str:
    """Underscores of an index as commas, as before a word behind a digit; Greek words by themselves as letters."""
    letters = re.sub(rf"(?<![A-Za-z])({_WORDS})(?![a-z])", lambda m: GREEK[m[0]], text.strip("_"))
    return re.sub(r"(?<=\d)(?=[a-z]{3,}$)", ",", letters.replace("_", ","))


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


def is_doubtful(piece: str) -> bool:
    """Whether what looks like a name in a sentence may be something else, as in "bolt M12, pressure in psi".

    >>> is_doubtful("M12"), is_doubtful("psi"), is_doubtful("omega3"), is_doubtful("F_max")
    (True, True, False, False)
    """
    return re.fullmatch(DOUBTFUL, piece) is not None


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
    indexed = rf"(?![A-Z]{{3,}}\d+\b)[A-Za-z{LETTERS}]+[_\d]\w*"
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
