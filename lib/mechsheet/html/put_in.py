"""Formulas with numbers for their symbols, whatever the numbers are: the page puts them in.

Which brackets and dots a formula has depends on the numbers: a negative one needs brackets where another one needs
none. The tree is made for numbers of each kind, and what differs stands in the formula with the kinds that have it.
"""

from collections.abc import Callable, Mapping
from math import inf, nan
from typing import Any, NamedTuple, get_args

from mechsheet.document.expression import substituted
from mechsheet.document.formula import Apply, Binary, Brackets, Measure, Node, Prefix, Product, Text
from mechsheet.document.mathml import in_terms
from mechsheet.worksheet.lines import Formula

# A number of each kind: with the usual digits or as a power of ten, negative, none. The page tells them alike.
_REAL = {"plain": 2.0, "power": 2e-9, "minus": -2.0, "minus power": -2e-9, "none": nan, "minus infinite": -inf}
_COMPLEX = {"plain": 2 + 2j, "minus": -2 + 2j}
_PLACES, _SIGNS = 0xE000, 0xF000  # letters for private use: of numbers, and of signs that depend on them
_NODES = get_args(Node)


class Read(NamedTuple):
    """A number that a formula reads: its unit, and whether it is complex."""

    unit: str
    is_complex: bool


class PutIn(NamedTuple):
    """MathML with letters where numbers stand, and where signs do that only some numbers need.

    ``signs`` has for each of these the sign, and of the numbers that need it their places with the kind of each.
    """

    text: str
    signs: list[tuple[str, list[tuple[int, str]]]]


def put_in(line: Formula, read: Mapping[str, Read]) -> PutIn | None:
    """The right side of a line, the numbers ``read`` in their order; None where it has none, or none that is known."""
    kinds = [_COMPLEX if each.is_complex else _REAL for each in read.values()]
    plain = _tree(line, read, ["plain"] * len(read))
    if plain is None:
        return None
    others = [
        _Other(n, kind, other)
        for n, known in enumerate(kinds)
        for kind in known
        if kind != "plain"
        and (other := _tree(line, read, ["plain"] * n + [kind] + ["plain"] * (len(read) - n - 1))) is not None
    ]
    merged = _Merged()
    return PutIn(in_terms(merged.node(plain, others)), merged.signs)


class _Other(NamedTuple):
    """The tree, or a part of it, for a number of another kind at one place."""

    place: int
    kind: str
    node: Node


def _tree(line: Formula, read: Mapping[str, Read], kinds: list[str]) -> Node | None:
    """The tree for numbers of these kinds, a letter for each of them."""
    values = [(_COMPLEX if r.is_complex else _REAL)[kind] for r, kind in zip(read.values(), kinds, strict=True)]
    numbers = {name: Measure(value, r.unit) for (name, r), value in zip(read.items(), values, strict=True)}
    node = substituted(line, numbers)
    letters = {id(number): Text(chr(_PLACES + n)) for n, number in enumerate(numbers.values())}
    return node and _lettered(node, letters)


def _lettered(node: Node, letters: Mapping[int, Text]) -> Node:
    return letters.get(id(node)) or _zipped(node, [], lambda part, _: _lettered(part, letters))


def _zipped(node: Node, others: list[_Other], each: Callable[[Node, list[_Other]], Node]) -> Node:
    """A node of other parts: ``each`` makes one of a part and of those at the same place in ``others``."""

    def made(part: Any, *at: Any) -> Any:
        if isinstance(part, tuple):
            return tuple(made(item, *at, n) for n, item in enumerate(part))
        if not isinstance(part, _NODES):
            return part
        return each(part, [other._replace(node=_at(other.node, *at)) for other in others])

    parts = (made(getattr(node, name), name) for name in node.__match_args__)
    return type(node)(*parts)


def _at(node: Node, name: str, *places: int) -> Node:
    part: Any = getattr(node, name)
    for n in places:
        part = part[n]
    held: Node = part
    return held


def _argument(node: Node) -> Node:
    """What a function is of, with brackets or without."""
    return node.arguments.items[0] if isinstance(node, Apply) else node.of if isinstance(node, Prefix) else node


class _Merged:
    """One tree for numbers of all kinds."""

    def __init__(self) -> None:
        self.signs: list[tuple[str, list[tuple[int, str]]]] = []

    def node(self, plain: Node, others: list[_Other]) -> Node:
        others = [other for other in others if other.node != plain]
        if not others:
            return plain
        match plain:
            case Prefix(function, of) if isinstance(others[0].node, Apply):
                inside = [other._replace(node=_argument(other.node)) for other in others]
                return Apply(function, Brackets((of,), self.brackets(inside)))
            case Brackets():
                bracketed = list[_Other]()
            case _:
                bracketed = [other for other in others if isinstance(other.node, Brackets)]
        if bracketed:
            inside = [o._replace(node=o.node.items[0]) if isinstance(o.node, Brackets) else o for o in others]
            return Brackets((self.node(plain, inside),), self.brackets(bracketed))
        if any(type(other.node) is not type(plain) for other in others):
            raise TypeError(f"{plain} and {others[0].node} have nothing in common")
        if isinstance(plain, Product):
            return self.product(plain, others)
        return _zipped(plain, others, self.node)

    def product(self, plain: Product, others: list[_Other]) -> Node:
        """A product whose dot stands for some numbers only."""
        left, right = (
            self.node(getattr(plain, side), [o._replace(node=getattr(o.node, side)) for o in others])
            for side in ("left", "right")
        )
        if all(isinstance(o.node, Product) and o.node.dot == plain.dot for o in others):
            return Product(left, right, plain.dot)
        place = next(o.place for o in others if isinstance(o.node, Product) and o.node.dot != plain.dot)
        own = {o.kind: o.node.dot for o in others if isinstance(o.node, Product) and o.place == place}
        with_dot = [(place, kind) for kind in _REAL if own.get(kind, plain.dot)]
        return Binary(left, self.sign("⋅", with_dot), right)

    def brackets(self, others: list[_Other]) -> str:
        when = [(other.place, other.kind) for other in others]
        return self.sign("(", when) + self.sign(")", when)

    def sign(self, sign: str, when: list[tuple[int, str]]) -> str:
        """The letter of a sign that stands for some numbers only."""
        self.signs.append((sign, when))
        return chr(_SIGNS + len(self.signs) - 1)
