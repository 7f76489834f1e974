"""Formulas as trees, whoever writes them: a closed set of nodes, and what is to be asked of each.

Brackets and dots stand in the tree: where they are needed follows from how strongly a part holds together.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any, TypeAlias

from mechsheet.worksheet.numbers import is_plain
from mechsheet.worksheet.symbol import Symbol

# How strongly a part holds together: one that holds less than its place asks for stands in brackets.
RELATION, SUM, PRODUCT, SIGN, POWER, WHOLE = range(6)


@dataclass(frozen=True, slots=True)
class Number:
    """A number of the formula itself, as it is ``typed`` or made of such."""

    value: float
    typed: bool = False


@dataclass(frozen=True, slots=True)
class Measure:
    """A number in its unit, which stands for a symbol or is ``typed``; complex for a point or a vector."""

    value: float | complex
    unit: str
    typed: bool = False


@dataclass(frozen=True, slots=True)
class Text:
    """Words."""

    text: str


@dataclass(frozen=True, slots=True)
class Code:
    """What has no notation but that of Python."""

    text: str


@dataclass(frozen=True, slots=True)
class Function:
    """A function of the field by its short name, such as ``sin``, ``arg``, ``max``, ``sum``; any other in words."""

    name: str


@dataclass(frozen=True, slots=True)
class Signed:
    """A part under its sign, ``+`` or ``-``."""

    sign: str
    of: "Node"


@dataclass(frozen=True, slots=True)
class Binary:
    """Two parts round a sign: ``+ - × ⋅ ⊙ ⊘ mod < ≤ > ≥ = ≠ ∈ ∉ ↦ , and or``."""

    left: "Node"
    sign: str
    right: "Node"


@dataclass(frozen=True, slots=True)
class Product:
    """Two factors, with a dot between them or a thin space."""

    left: "Node"
    right: "Node"
    dot: bool = False


@dataclass(frozen=True, slots=True)
class Fraction:
    """One part over another."""

    over: "Node"
    under: "Node"


@dataclass(frozen=True, slots=True)
class Root:
    """Square root, or one of another degree."""

    of: "Node"
    degree: "Node | None" = None


@dataclass(frozen=True, slots=True)
class Power:
    """A base with a raised exponent."""

    base: "Node"
    exponent: "Node"


@dataclass(frozen=True, slots=True)
class Element:
    """A part with a lowered index."""

    of: "Node"
    index: "Node"


@dataclass(frozen=True, slots=True)
class Overline:
    """A part under a line: the conjugate."""

    of: "Node"


@dataclass(frozen=True, slots=True)
class Brackets:
    """Parts in brackets ``() [] {} || ‖‖ ⌊⌋ ⌈⌉``, as high as what they hold, or ``high``."""

    items: "tuple[Node, ...]"
    kind: str = "()"
    high: bool = False
    close: bool = False  # the items


@dataclass(frozen=True, slots=True)
class Apply:
    """A function of what its brackets hold."""

    function: "Node"
    arguments: Brackets


@dataclass(frozen=True, slots=True)
class Prefix:
    """An operator before its only operand, ``sin x``, ``Re z``."""

    operator: "Node"
    of: "Node"
    strength: int = WHOLE


@dataclass(frozen=True, slots=True)
class Range:
    """The first ones ... the last one."""

    first: "tuple[Node, ...]"
    last: "Node"


@dataclass(frozen=True, slots=True)
class Integral:
    """Integral of one part over another, of all of it, up to each value of that, or from ``start`` to ``end``."""

    of: "Node"
    over: "Node"
    so_far: bool = False
    start: "Node | None" = None
    end: "Node | None" = None


@dataclass(frozen=True, slots=True)
class Cases:
    """One value under a condition, another otherwise."""

    value: "Node"
    condition: "Node"
    otherwise: "Node"


@dataclass(frozen=True, slots=True)
class Sum:
    """Sum or product of one part for all values of an index: ``start`` to ``end``, or each one of ``start``."""

    of: "Node"
    index: "Node"
    start: "Node"
    end: "Node | None" = None
    sign: str = "∑"


@dataclass(frozen=True, slots=True)
class Matrix:
    """Rows of equal length in one pair of brackets."""

    rows: "tuple[Row, ...]"


@dataclass(frozen=True, slots=True)
class Row:
    """Parts side by side with space between them."""

    items: "tuple[Node, ...]"


Node: TypeAlias = (
    Symbol | Number | Measure | Text | Code | Function | Signed | Binary | Product | Fraction | Root | Power | Element
    | Overline | Brackets | Apply | Prefix | Range | Integral | Sum | Cases | Matrix | Row
)  # fmt: skip


def children(node: Node) -> Iterator[Node]:
    """Parts of a node."""
    for name in node.__match_args__:
        part: Any = getattr(node, name)
        if isinstance(part, tuple):
            yield from part
        elif part is not None and not isinstance(part, str | int | float | complex):
            yield part


def goes_on(node: Element) -> bool:
    """Whether its index stands behind that of its part: a comma parts them."""
    return isinstance(node.of, Element) or (isinstance(node.of, Symbol) and node.of.index != "")


def is_high(node: Node) -> bool:
    """Whether a part stands higher than a line."""
    match node:
        case Symbol() | Text() | Code() | Function():
            return False
        case Fraction() | Power() | Sum() | Integral() | Matrix() | Cases():
            return True
        case Brackets(items, high=high):
            return high or any(map(is_high, items))
        case Number(value):
            return isfinite(value) and not is_plain(value)
        case Measure(value, unit):
            numbers = (value.real, value.imag) if isinstance(value, complex) else (value,)
            return "**" in unit or any(isfinite(x) and not is_plain(x) for x in numbers)
    return any(map(is_high, children(node)))


_STRENGTHS = {
    Symbol: WHOLE, Fraction: WHOLE, Brackets: WHOLE, Apply: WHOLE, Power: POWER, Product: PRODUCT, Integral: PRODUCT,
    Sum: PRODUCT, Signed: SUM, Range: RELATION, Row: RELATION,
    Cases: RELATION,
}  # fmt: skip
_SUMS = ("+", "-", "×", "⋅", "⊙", "⊘", "mod")


def strength(node: Node) -> int:
    """How strongly a part holds together."""
    known = _STRENGTHS.get(type(node))
    if known is not None:
        return known
    match node:
        case Binary(sign=sign):
            return SUM if sign in _SUMS else RELATION
        case Prefix(strength=own):
            return own
        case Number(value):
            return WHOLE if is_plain(value) or not isfinite(value) else PRODUCT
        case Measure(value, unit):
            if _is_negative(value):
                return SUM
            return WHOLE if unit == "-" and not isinstance(value, complex) and is_plain(value) else PRODUCT
    return WHOLE


def _first(node: Node) -> Node:
    """What a part begins with."""
    while True:
        match node:
            case Binary(left=first) | Product(left=first) | Power(base=first) | Range(first=(first, *_)):
                node = first
            case _:
                return node


def _is_negative(value: float | complex) -> bool:
    return not isinstance(value, complex) and value < 0


def begins_negative(node: Node) -> bool:
    """Whether a part begins with a minus."""
    match _first(node):
        case Signed("-"):
            return True
        case Measure(value):
            return _is_negative(value)
    return False


def begins_as_number(node: Node) -> bool:
    """Whether a part begins with a digit or a minus in brackets, which need a dot before them."""
    match _first(node):
        case Number(value):
            return isfinite(value)
        case Measure(value):
            return value.real < 0 if isinstance(value, complex) else isfinite(value)
        case Brackets([item, *_], kind="()") as brackets:
            return begins_negative(item) and not is_high(brackets)
    return False
