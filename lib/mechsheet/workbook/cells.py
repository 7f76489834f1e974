"""Recorded quantities as the text of spreadsheet formulas, and the places where they stand."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.recording.recorded import LEAVES, Node

# Operation: its text, how tightly it binds, and how tightly its operands must.
_TEXT: dict[str, tuple[str, int, tuple[int, ...]]] = {
    "<": ("{}<{}", 1, (2, 2)), "<=": ("{}<={}", 1, (2, 2)), ">": ("{}>{}", 1, (2, 2)), ">=": ("{}>={}", 1, (2, 2)),
    "=": ("{}={}", 1, (2, 2)), "<>": ("{}<>{}", 1, (2, 2)), "+": ("{}+{}", 2, (2, 3)), "-": ("{}-{}", 2, (2, 3)),
    "*": ("{}*{}", 3, (3, 3)), "/": ("{}/{}", 3, (3, 4)), "neg": ("-{}", 2, (3,)), "^": ("{}^{}", 4, (5, 5)),
    "ATAN2": ("ATAN2({1},{0})", 5, (0, 0)), "IF": ("IF({},{},{})", 5, (0, 0, 0)), "MOD": ("MOD({},{})", 5, (0, 0)),
    "MAX": ("MAX({},{})", 5, (0, 0)), "MIN": ("MIN({},{})", 5, (0, 0)), "AND": ("AND({},{})", 5, (0, 0)),
    "OR": ("OR({},{})", 5, (0, 0)), "ROUND": ("ROUND({},0)", 5, (0,)),
}  # fmt: skip
_FAILS = {"SQRT", "ASIN", "ACOS", "ATAN2", "LN", "/", "^", "MOD", "TAN"}  # may give an error value
_LIGHT = 6  # operations that a formula repeats rather than give them a cell
_HEAVY = 60  # operations that one formula holds at most


@dataclass(frozen=True)
class Home:
    """Where a quantity stands: a cell or a column, and the name that means it (in a column: the cell of its row)."""

    name: str
    sheet: str
    row: int
    column: int

    def at(self, k: int = 0) -> str:
        """Address of the k-th cell."""
        return f"{_quoted(self.sheet)}!${letters(self.column)}${self.row + k + 1}"

    def range(self, first: int, last: int) -> str:
        column = letters(self.column)
        return f"{_quoted(self.sheet)}!${column}${self.row + first + 1}:${column}${self.row + last + 1}"

    def meaning(self, size: int) -> str:
        """What the name is defined as; a row without $ is that of the cell which uses it."""
        return f"={self.at() if size == 1 else f'{_quoted(self.sheet)}!${letters(self.column)}1'}"


@lru_cache(maxsize=1024)
def letters(column: int) -> str:
    """Letters of a column counted from 0."""
    head, tail = divmod(column, 26)
    return (letters(head - 1) if head else "") + chr(65 + tail)


@lru_cache(maxsize=256)
def _quoted(sheet: str) -> str:
    return "'" + sheet.replace("'", "''") + "'"


def formula(node: Node, k: int = 0, row: int | None = None, factor: float = 1.0) -> str:
    """Formula of a quantity's k-th element over ``factor``, without its own name, for a column's ``row``-th cell.

    What is no number is #N/A.
    """
    text, binding = _operation(node, k, _row(node, k, row))
    if factor != 1.0:
        text = _scaled(text if binding > 2 else f"({text})", factor)
    return f"=IFERROR({text},NA())" if _fails(node) else f"={text}"


def reference(node: Node, k: int = 0, row: int | None = None, factor: float = 1.0) -> str:
    """Formula that shows the k-th element of a quantity which has a place, over ``factor``."""
    if not node.home:
        return formula(node, k, row, factor)
    text = _element(node, k, _row(node, k, row))[0]
    return f"={_scaled(text, factor) if factor != 1.0 else text}"


def _row(node: Node, k: int, row: int | None) -> int:
    """Row of a cell among its column's; a single number stands in no row of any column."""
    return -1 if node.value.size == 1 else k if row is None else row


def uniform(node: Node) -> bool:
    """Whether the formula is the same text in all rows."""
    return node.value.size == 1 or (_plain(node) and all(_same_rows(o, node) for o in node.operands))


def spread(texts: Callable[[int], str], node: Node, own: bool) -> list[str]:
    """Formulas of all elements, written once where they are the same."""
    size = node.value.size
    same = uniform(node) if own else _same_rows(node, node)
    return [texts(0)] * size if same else [texts(k) for k in range(size)]


def place(roots: Iterable[Node]) -> list[Node]:
    """Quantities behind ``roots`` that need a place of their own, the ones they rest on first.

    These are the named ones, what a sum or a greatest value is taken of, and what would make a formula too long
    or stand in several of them.
    """
    order: list[Node] = []
    visited: set[int] = set()
    stack = [(root, False) for root in roots]
    while stack:
        node, done = stack.pop()
        if done:
            order.append(node)
        elif id(node) not in visited:
            visited.add(id(node))
            stack.append((node, True))
            stack.extend((operand, False) for operand in node.operands)
    for node in order:
        node.uses = 0
    for node in order:
        for operand in node.operands:
            operand.uses += 1
    placed, weight = dict[int, Node](), dict[int, int]()
    for node in order:
        own = 1 + sum(weight[id(operand)] for operand in node.operands) if node.operands else 0
        named = bool(node.name or node.label) or node.op in LEAVES
        if node.op in ("constant", "input") or (node.op == "rows" and node.value.size == 1):
            own = 0
        elif named or node.home or (node.uses > 1 and own > _LIGHT and node.op not in ("pick", "join")) or own > _HEAVY:
            placed[id(node)] = node
            own = 0
        if node.op == "reduce" and node.args[0].op != "input":
            placed.setdefault(id(node.args[0]), node.args[0])
        weight[id(node)] = own
    return list(placed.values())


def _plain(node: Node) -> bool:
    return node.op not in ("pick", "join", "reduce", "constant", "static")


def _same_rows(node: Node, root: Node) -> bool:
    """Whether a quantity reads the same in all rows of another."""
    if node.value.size == 1:
        return True
    if node.value.shape != root.value.shape:
        return False
    return bool(node.home) or (_plain(node) and all(_same_rows(operand, root) for operand in node.operands))


def _fails(node: Node) -> bool:
    """Whether a formula may give an error value where its operands give none."""
    stack = [node]
    while stack:
        here = stack.pop()
        if here.op in _FAILS and not _safe(here):
            return True
        stack.extend(operand for operand in here.operands if not operand.home)
    return False


def _safe(node: Node) -> bool:
    """Whether this operation has a value for all operands: a length, a square, a part by a number."""
    match node.op:
        case "/":
            return bool(node.args[1].op == "constant")
        case "^":
            return node.args[1].op == "constant" and bool(np.all(node.args[1].value > 0))
        case "SQRT":
            inner = node.args[0]
            return inner.op == "+" and all(a.op == "^" and _is_two(a.args[1]) for a in inner.args)
    return False


def _is_two(node: Node) -> bool:
    return node.op == "constant" and node.value.shape == () and bool(node.value == 2)


def _scaled(text: str, factor: float) -> str:
    if factor == math.pi / 180:
        return f"DEGREES({text})"
    return f"{text}/{_number(factor)}" if factor >= 1 else f"{text}*{_number(1 / factor)}"


def _element(node: Node, k: int, row: int) -> tuple[str, int]:
    """The k-th element as an operand: by its name or address where it has a place."""
    if not node.home:
        return _operation(node, k, row)
    home: Home = node.home
    if node.value.size == 1 or k == row:
        return home.name, 5
    return home.at(k), 5


def _operation(node: Node, k: int, row: int) -> tuple[str, int]:
    match node.op:
        case "constant":
            text = _number(node.value.reshape(-1)[k if node.value.size > 1 else 0])
            return text, 2 if text.startswith("-") else 3 if "*" in text or "/" in text else 5
        case "rows":
            return "ROW()-" + str(node.home.row + 1 if node.home else 1), 2
        case "pick":
            source, index = node.args
            return _element(source, int(index.reshape(-1)[k]), row)
        case "join":
            sources, which, index = node.args
            source = sources[which.reshape(-1)[k]]
            return _element(source, int(index.reshape(-1)[k]), row)
        case "reduce":
            source, groups, kind = node.args
            group = groups[k]
            if len(group) > 1 and np.array_equal(np.diff(group), np.ones(len(group) - 1, int)):
                return f"{kind}({source.home.range(int(group[0]), int(group[-1]))})", 5
            return f"{kind}({','.join(source.home.at(int(i)) for i in group)})", 5
    form, binding, needs = _TEXT.get(node.op) or _function(node.op, len(node.args))
    shape, texts = node.value.shape, []
    for operand, need in zip(node.args, needs, strict=True):
        text, tight = _element(operand, _position(operand.value.shape, shape, k), row)
        texts.append(f"({text})" if tight < need else text)
    if node.op == "neg" and "^" in texts[0] and tight < 5:  # -x^2 is (-x)^2 to a spreadsheet
        return f"-({texts[0]})", binding
    return form.format(*texts), binding


@lru_cache(maxsize=64)
def _function(name: str, count: int) -> tuple[str, int, tuple[int, ...]]:
    return f"{name}({','.join(['{}'] * count)})", 5, (0,) * count


def _position(shape: tuple[int, ...], whole: tuple[int, ...], k: int) -> int:
    """Flat position in an operand of the k-th element of what it is broadcast to."""
    if shape == whole:
        return k
    return int(_positions(shape, whole)[k]) if math.prod(shape) > 1 else 0


@lru_cache(maxsize=256)
def _positions(shape: tuple[int, ...], whole: tuple[int, ...]) -> NDArray[Any]:
    return np.broadcast_to(np.arange(math.prod(shape)).reshape(shape), whole).reshape(-1)


def _number(value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "TRUE" if value else "FALSE"
    x = float(value)
    if not math.isfinite(x):
        return "NA()" if math.isnan(x) else f"{'-' if x < 0 else ''}1E+307"
    for text, known in _KNOWN.items():
        if x == known:
            return text
    return str(int(x)) if x.is_integer() and abs(x) < 1e15 else repr(x).upper()


_KNOWN = {"PI()": math.pi, "2*PI()": 2 * math.pi, "PI()/2": math.pi / 2, "PI()/180": math.pi / 180}
