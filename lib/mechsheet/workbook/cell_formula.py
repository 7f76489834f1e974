"""The text of a spreadsheet's formula for a recorded quantity."""

import math
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.recording.graph import Node, is_number
from mechsheet.workbook.place import Place

_SAME = ("abs", "sqrt", "exp", "sin", "cos", "tan", "asin", "acos", "sign")

# Operation: its text, how tightly it binds, and how tightly its operands must.
_TEXT: dict[str, tuple[str, int, tuple[int, ...]]] = {
    "lt": ("{}<{}", 1, (2, 2)), "le": ("{}<={}", 1, (2, 2)), "gt": ("{}>{}", 1, (2, 2)), "ge": ("{}>={}", 1, (2, 2)),
    "eq": ("{}={}", 1, (2, 2)), "ne": ("{}<>{}", 1, (2, 2)), "add": ("{}+{}", 2, (2, 3)), "sub": ("{}-{}", 2, (2, 3)),
    "mul": ("{}*{}", 3, (3, 3)), "div": ("{}/{}", 3, (3, 4)), "neg": ("-{}", 2, (3,)), "pow": ("{}^{}", 4, (5, 5)),
    "atan2": ("ATAN2({1},{0})", 5, (0, 0)),
    "round": ("IF(MOD(ABS({0}),2)=0.5,{0}-SIGN({0})/2,ROUND({0},0))", 5, (3,)), "floor": ("FLOOR({},1)", 5, (0,)),
    "where": ("IF({},{},{})", 5, (0, 0, 0)), "finite": ("ISNUMBER({})", 5, (0,)), "not": ("NOT({})", 5, (0,)),
    **{op: (f"{op.upper()}({{}},{{}})", 5, (0, 0)) for op in ("max", "min", "and", "or", "mod")},
    **{op: (f"{op.upper()}({{}})", 5, (0,)) for op in _SAME},
    "log": ("LN({})", 5, (0,)),
}  # fmt: skip
AGGREGATE = "_xlfn.AGGREGATE"  # the name of newer functions in the file; with 6 it passes over error values
_OF_RANGE = {
    "max": "MAX({})", "min": "MIN({})", "sum": "SUM({})", "prod": "PRODUCT({})", "any": "OR({})", "all": "AND({})",
    "argmax": "MATCH(MAX({0}),{1},0)-1", "argmin": "MATCH(MIN({0}),{1},0)-1", "nanmax": f"{AGGREGATE}(4,6,{{}})",
    "nanmin": f"{AGGREGATE}(5,6,{{}})", "nansum": f"{AGGREGATE}(9,6,{{}})",
}  # fmt: skip
_FAILS = {"sqrt", "asin", "acos", "atan2", "log", "div", "pow", "mod", "tan", "at"}  # may give an error value


class CellFormulas:
    """Formulas of quantities, some of which stand at a place of the workbook: there a formula refers to them."""

    def __init__(self, places: Mapping[Node, Place]) -> None:
        self.places = places

    def formula(self, node: Node, k: int = 0, row: int | None = None, factor: float = 1.0) -> str:
        """Formula of a quantity's k-th element over ``factor``, without its own name, for a column's ``row``-th cell.

        What is no number is #N/A.
        """
        text, binding = self._operation(node, k, _row(node, k, row))
        if factor != 1.0:
            text = _scaled(text if binding > 2 else f"({text})", factor)
        return f"=IFERROR({text},NA())" if self._fails(node) else f"={text}"

    def reference(self, node: Node, k: int = 0, row: int | None = None, factor: float = 1.0) -> str:
        """Formula that shows the k-th element of a quantity which has a place, over ``factor``."""
        if node not in self.places:
            return self.formula(node, k, row, factor)
        text = self._element(node, k, _row(node, k, row))[0]
        return f"={_scaled(text, factor) if factor != 1.0 else text}"

    def formulas(self, node: Node) -> list[str]:
        """Formulas of all elements, written once where they are the same text in all rows."""
        same = node.size == 1 or (_plain(node) and all(self._same_rows(o, node) for o in node.operands))
        return [self.formula(node)] * node.size if same else [self.formula(node, k) for k in range(node.size)]

    def references(self, node: Node, factor: float) -> list[str]:
        """Formulas that show all elements of a quantity, over ``factor``."""
        if self._same_rows(node, node):
            return [self.reference(node, 0, 0, factor)] * node.size
        return [self.reference(node, k, k, factor) for k in range(node.size)]

    def _same_rows(self, node: Node, root: Node) -> bool:
        """Whether a quantity reads the same in all rows of another."""
        if node.size == 1:
            return True
        if node.shape != root.shape:
            return False
        return node in self.places or (
            _plain(node) and all(self._same_rows(operand, root) for operand in node.operands)
        )

    def _fails(self, node: Node) -> bool:
        """Whether a formula may give an error value where its operands give none."""
        stack = [node]
        while stack:
            here = stack.pop()
            if here.op in _FAILS and not _safe(here):
                return True
            stack.extend(operand for operand in here.operands if operand not in self.places)
        return False

    def _element(self, node: Node, k: int, row: int) -> tuple[str, int]:
        """The k-th element as an operand: by its name or address where it has a place."""
        place = self.places.get(node)
        if place is None:
            return self._operation(node, k, row)
        return place.name if node.size == 1 or k == row else place.at(k), 5

    def _operation(self, node: Node, k: int, row: int) -> tuple[str, int]:
        match node.op:
            case "constant":
                text = written(node.value.reshape(-1)[k if node.size > 1 else 0])
                if node.args and re.fullmatch("10{6,}", text):  # as of MPa
                    text = f"1E{len(text) - 1}"
                return text, 2 if text.startswith("-") else 3 if "*" in text or "/" in text else 5
            case "mul" | "div" if _is_one(node.args[1]):
                return self._element(node.args[0], _position(node.args[0].shape, node.shape, k), row)
            case "mul" if _is_one(node.args[0]):
                return self._element(node.args[1], _position(node.args[1].shape, node.shape, k), row)
            case "rows":
                place = self.places.get(node)
                return f"ROW()-{place.row + 1 if place else 1}", 2
            case "take":
                source, index = node.args
                return self._element(source, int(index.reshape(-1)[k]), row)
            case "join":
                sources, which, index = node.args
                source = sources[which.reshape(-1)[k]]
                return self._element(source, int(index.reshape(-1)[k]), row)
            case "reduce":
                source, groups, kind = node.args
                group, place = groups[k], self.places[source]
                if len(group) > 1 and np.array_equal(np.diff(group), np.ones(len(group) - 1, int)):
                    cells = one = place.range(int(group[0]), int(group[-1]))
                else:
                    cells = ",".join(place.at(int(i)) for i in group)
                    one = f"CHOOSE({{{','.join(str(n + 1) for n in range(len(group)))}}},{cells})"
                return _OF_RANGE[kind].format(cells, one), 2 if kind.startswith("arg") else 5
            case "at":
                source, position = node.args
                where = self._element(position, _position(position.shape, node.shape, k), row)[0]
                return f"INDEX({self.places[source].range(0, source.size - 1)},{where}+1)", 5
            case "exported":
                known = written(node.value.reshape(-1)[k if node.size > 1 else 0])
                same = [f"{self._element(x, 0, row)[0]}={written(x.value)}" for x in node.args]
                return f"IF(AND({','.join(same)}),{known},NA())" if same else known, 5
        form, binding, needs = _TEXT[node.op]
        shape, texts = node.shape, []
        for operand, need in zip(node.args, needs, strict=True):
            text, tight = self._element(operand, _position(operand.shape, shape, k), row)
            texts.append(f"({text})" if tight < need else text)
        if node.op == "neg" and "^" in texts[0] and tight < 5:  # -x^2 is (-x)^2 to a spreadsheet
            return f"-({texts[0]})", binding
        return form.format(*texts), binding


def nesting(node: Node, inside: Mapping[Node, int]) -> int:
    """Parentheses inside each other in the formula of an operation whose operands have ``inside``."""
    deepest = max((inside[operand] for operand in node.operands), default=0)
    if node.op == "reduce":
        return deepest + (2 if node.args[2].startswith("arg") else 1)
    if node.op not in _TEXT:
        return deepest + {"at": 1, "exported": 2}.get(node.op, 0)
    _, binding, needs = _TEXT[node.op]
    if binding == 5:
        return deepest + 1
    tight = [_TEXT[operand.op][1] if operand.op in _TEXT else 5 for operand in node.operands]
    return max(inside[o] + (t < need) for o, t, need in zip(node.operands, tight, needs, strict=True))


def _row(node: Node, k: int, row: int | None) -> int:
    """Row of a cell among its column's; a single number stands in no row of any column."""
    return -1 if node.size == 1 else k if row is None else row


def _plain(node: Node) -> bool:
    return node.op not in ("take", "at", "join", "reduce", "constant", "exported")


def _safe(node: Node) -> bool:
    """Whether this operation has a value for all operands: a length, a square, a part by a number."""
    match node.op:
        case "div":
            return _is_constant(node.args[1])
        case "pow":
            return node.args[1].op == "constant" and bool(np.all(node.args[1].value > 0))
        case "sqrt":
            inner = node.args[0]
            return inner.op == "add" and all(a.op == "pow" and is_number(a.args[1], 2) for a in inner.args)
    return False


def _is_constant(node: Node) -> bool:
    """Whether a quantity is made of constants alone, such as ``2*kN``."""
    return node.op == "constant" or (bool(node.operands) and all(map(_is_constant, node.operands)))


def _is_one(node: Node) -> bool:
    """Whether the constant of a unit without a factor, such as N, or a power of it."""
    if node.op == "pow":
        return _is_one(node.args[0])
    return node.op == "constant" and bool(node.args) and node.size == 1 and bool(node.value == 1)


def _scaled(text: str, factor: float) -> str:
    if factor == math.pi / 180:
        return f"DEGREES({text})"
    return f"{text}/{written(factor)}" if factor >= 1 else f"{text}*{written(1 / factor)}"


def _position(shape: tuple[int, ...], whole: tuple[int, ...], k: int) -> int:
    """Flat position in an operand of the k-th element of what it is broadcast to."""
    if shape == whole:
        return k
    return int(_positions(shape, whole)[k]) if math.prod(shape) > 1 else 0


@lru_cache(maxsize=256)
def _positions(shape: tuple[int, ...], whole: tuple[int, ...]) -> NDArray[Any]:
    return np.broadcast_to(np.arange(math.prod(shape)).reshape(shape), whole).reshape(-1)


def written(value: Any) -> str:
    """A constant as it stands in a formula."""
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
