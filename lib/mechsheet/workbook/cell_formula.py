"""The text of a spreadsheet's formula for a recorded quantity."""

import math
import re
from collections.abc import Container, Iterable, Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from mechsheet.quantities.node import Node, bottom_up, is_number, passes_over
from mechsheet.readers.infinite import carries, endless
from mechsheet.workbook.column_rows import COUNTED, Index, Rows, Unlike
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
    "argmax": "MATCH(MAX({0}),{1},0)-1", "argmin": "MATCH(MIN({0}),{1},0)-1",
    "nanmax": f"IF(COUNT({{0}})=0,NA(),{AGGREGATE}(4,6,{{0}}))",
    "nanmin": f"IF(COUNT({{0}})=0,NA(),{AGGREGATE}(5,6,{{0}}))", "nansum": f"{AGGREGATE}(9,6,{{}})",
}  # fmt: skip
_FIRST = np.zeros(1, np.intp)
_ALONE = Rows(_FIRST, (), 0, alone=True)
_INFINITE = "1E+307"  # stands for an infinite number, which is compared and chosen, and is else none
_COMPARING = {
    *("max", "min", "neg", "abs", "where", "lt", "le", "gt", "ge", "eq", "ne", "and", "or", "not"),
}  # which may take it
_FAILS = {"sqrt", "asin", "acos", "atan2", "log", "div", "pow", "mod", "tan", "at"}  # may give an error value


class CellFormulas:
    """Formulas of quantities, some of which stand at a place of the workbook: there a formula refers to them.

    ``first`` is the row of the first number of every column, ``counted`` the conditions, in their order, under which
    there are as many rows as columns have: no row has a number of another one's; ``inverse`` are the closed forms of
    found values, or the searches for the ``searched`` ones, ``sure`` the conditions under which those are all that is
    found. Where one that is ``lost`` has an error value, or wherever it would be another number, it has the exported
    one. What is no number is #N/A. Of ``finite`` ones no number is infinite.
    """

    def __init__(
        self,
        places: Mapping[Node, Place],
        first: int = 0,
        counted: Sequence[Node] = (),
        inverse: Mapping[Node, Node | None] = MappingProxyType({}),
        searched: Container[Node] = (),
        sure: Mapping[Node, Node] = MappingProxyType({}),
        lost: Mapping[Node, bool] = MappingProxyType({}),
        finite: bool = False,
    ) -> None:
        self.places, self.first, self.inverse, self.searched = places, first, inverse, searched
        self.sure, self.lost, self.finite = sure, lost, finite
        self._inputs: dict[Node, tuple[Node, ...]] = {}
        self._endless: dict[Node, bool] = {}
        self._failing: dict[Node, bool] = {}
        self._fixed: dict[Node, frozenset[Node]] = {}
        self._counted, self._known = list[str](), dict[Node, int]()
        self._counted = [self.reference(holds)[1:] for holds in counted]
        for k, holds in reversed([*enumerate(counted)]):
            self._known |= dict.fromkeys(_under(holds), k)  # of those before, none rests on a quantity

    def formula(self, node: Node, factor: float = 1.0) -> str:
        """Formula of a single number over ``factor``, without its own name."""
        return self._written(node, _ALONE, factor)

    def reference(self, node: Node, factor: float = 1.0) -> str:
        """Formula that shows a single number over ``factor``."""
        if node not in self.places:
            return self.formula(node, factor)
        name = self._finite(node, self.places[node].name)
        return f"={_scaled(name, factor) if factor != 1.0 else name}"

    def formulas(self, node: Node, factor: float = 1.0) -> list[str]:
        """Formulas of all elements over ``factor``, one a column where there is one for all of them."""
        if node.size == 1:
            return [self.formula(node, factor)]
        texts: list[str] = [""] * node.size
        for rows in _of_one_source(node) if node.size else ():
            try:
                self._fill(texts, node, rows, factor)
            except Unlike:
                for row in rows:
                    self._fill(texts, node, np.array([row]), factor)
        return texts

    def references(self, node: Node, factor: float) -> list[str]:
        """Formulas that show all elements of a quantity over ``factor``."""
        place = self.places.get(node)
        if place and not place.aligned:
            cells = [self._finite(node, place.at(k)) for k in range(node.size)]
            return [f"={_scaled(cell, factor) if factor != 1.0 else cell}" for cell in cells]
        return [self.reference(node, factor)] * node.size if node in self.places else self.formulas(node, factor)

    def endless(self, node: Node) -> bool:
        """Whether the cells of a quantity may have the number that stands for an infinite one."""
        return not self.finite and endless(node, self._endless)

    def _finite(self, node: Node, text: str) -> str:
        """The text of a quantity as it is shown and computed with: none of an infinite number."""
        return f"IF(ABS({text})<{_INFINITE},{text},NA())" if self.endless(node) else text

    def _fill(self, texts: list[str], node: Node, rows: Index, factor: float) -> None:
        rows_alike = Rows(rows, node.shape, self.first)
        text = self._written(node, rows_alike, factor)
        for row in rows.tolist():
            texts[row] = rows_alike.in_row(text, row)

    def _written(self, node: Node, rows: Rows, factor: float) -> str:
        text, binding = self._operation(node, rows.numbers, rows)
        if factor != 1.0:
            text = _scaled(text if binding > 2 else f"({text})", factor)
        return f"=IFERROR({text},NA())" if self._fails(node) else f"={text}"

    def _fails(self, node: Node) -> bool:
        """Whether a formula may give an error value where its operands give none."""
        if node not in self._failing:  # each row of a column asks
            stack, found = [node], False
            while stack and not found:
                here = stack.pop()
                found = here.op in _FAILS and not _safe(here)
                stack.extend(operand for operand in written_of(here) if operand not in self.places)
            self._failing[node] = found
        return self._failing[node]

    def _inputs_under(self, node: Node) -> tuple[Node, ...]:
        """Inputs on which a found value rests."""
        if node not in self._inputs:
            self._inputs[node] = tuple(n for n in bottom_up([node], ()) if n.op == "input")
        return self._inputs[node]

    def _element(self, node: Node, at: Index, rows: Rows) -> tuple[str, int]:
        """Elements as an operand: by their name or address where they have a place."""
        place = self.places.get(node)
        if place is None:
            return self._operation(node, at, rows)
        return place.name if node.size == 1 else rows.cells(place, at), 5

    def while_fixed(self, node: Node) -> str:
        """Condition under which the numbers of the worksheet's own run under a quantity are right; "" without any."""
        same = sorted(self._unchanged(each, _ALONE) for each in self._fixed_by(node))
        return f"AND({','.join(same)})" if same else ""

    def _fixed_by(self, node: Node) -> frozenset[Node]:
        """What must be as it was for the numbers of the worksheet's own run under a quantity, or must be found."""
        for part in bottom_up([node], self._fixed):
            closed = self.inverse.get(part)
            if (part.op in ("exported", "found") and closed is None) or part in self.lost:
                self._fixed[part] = frozenset(part.args if part.op == "exported" else self._inputs_under(part))
            elif part in self.searched:  # whose numbers may be there and not be sure
                self._fixed[part] = frozenset([part])
            else:
                under = [self._fixed_by(closed)] if closed is not None else [self._fixed[x] for x in part.operands]
                sure = [self.sure[part]] if part in self.sure else []
                self._fixed[part] = frozenset(sure).union(*under)
        return self._fixed[node]

    def _operation(self, node: Node, at: Index, rows: Rows) -> tuple[str, int]:
        if node in self.lost:
            kept = self._as_exported(node, self._inputs_under(node), at, rows)
            return kept if self.lost[node] else (f"IFERROR({self._of_known(node, at, rows)[0]},{kept[0]})", 5)
        if passes_over(node) and (same := self.while_fixed(node)):
            return f"IF({same},{self._of_known(node, at, rows)[0]},NA())", 5
        return self._of_known(node, at, rows)

    def _of_known(self, node: Node, at: Index, rows: Rows) -> tuple[str, int]:
        match node.op:
            case "constant":
                text = written(_only(node.value.reshape(-1)[at if node.size > 1 else 0]))
                if node.args and re.fullmatch("10{6,}", text):  # as of MPa
                    text = f"1E{len(text) - 1}"
                return text, 2 if text.startswith("-") else 3 if "*" in text or "/" in text else 5
            case "mul" | "div" if _is_one(node.args[1]):
                return self._element(node.args[0], _position(node.args[0].shape, node.shape, at), rows)
            case "mul" if _is_one(node.args[0]):
                return self._element(node.args[1], _position(node.args[1].shape, node.shape, at), rows)
            case "like" | "sized":
                whole = self._element(node.args[0], _position(node.args[0].shape, node.shape, at), rows)
                return whole if node.args[0].stretches else self._while_counted(node, *whole)
            case "iterated":
                return self._element(node.args[2], at, rows)
            case "length":
                return self._while_counted(node, written(node.value.item()), 5)
            case "rows":
                return self._while_counted(node, f"ROW()-{self.places[node].row + 1}" if node.size > 1 else "0", 2)
            case "finite" if node.args[0].stretches:
                inner = self._element(node.args[0], _position(node.args[0].shape, node.shape, at), rows)[0]
                return self._while_counted(node, f"ISNUMBER({inner})", 5)
            case "take":
                source, index, _ = node.args
                return self._element(source, index.reshape(-1)[at], rows)
            case "join":
                sources, which, index, _ = node.args
                source = sources[_only(which.reshape(-1)[at])]
                part = self._element(source, index.reshape(-1)[at], rows)
                return self._while_counted(node, *part) if node.stretches and not source.stretches else part
            case "reduce":
                leaf = _as_it_was(node)
                return (self._unchanged(leaf, rows), 1) if leaf else self._reduced(node, at, rows)
            case "at":
                source, position = node.args
                if not source.size:
                    return "NA()", 5
                where = self._element(position, _position(position.shape, node.shape, at), rows)[0]
                return f"INDEX({self.places[source].range(0, source.size - 1)},{where}+1)", 5
            case "exported":
                return self._as_exported(node, node.args, at, rows)
            case "found":
                return self._as_exported(node, self._inputs_under(node), at, rows)
        if not self.finite and carries(node, self._endless):
            return self._to_infinity(node, at, rows), 5
        form, binding, needs = _TEXT[node.op]
        shape, texts = node.shape, []
        for operand, need in zip(node.args, needs, strict=True):
            text, tight = self._element(operand, _position(operand.shape, shape, at), rows)
            if node.op == "finite" and self.endless(operand):
                return f"IFERROR(ABS({text})<{_INFINITE},FALSE)", 5
            if node.op not in _COMPARING and self.endless(operand):
                text, tight = self._finite(operand, text), 5
            texts.append(f"({text})" if tight < need else text)
        if node.op == "neg" and "^" in texts[0] and tight < 5:  # -x^2 is (-x)^2 to a spreadsheet
            return f"-({texts[0]})", binding
        return form.format(*texts), binding

    def _to_infinity(self, node: Node, at: Index, rows: Rows) -> str:
        """A sum, product or quotient of which one operand may be infinite."""
        a, b = (f"({self._element(x, _position(x.shape, node.shape, at), rows)[0]})" for x in node.args)
        first = self.endless(node.args[0])
        one, other = (a, b) if first else (b, a)
        if node.op == "div" and not first:
            beyond = f"0*{other}"
        elif node.op in ("mul", "div"):
            beyond = f"IF({other}=0,NA(),{one}*SIGN{other})"
        else:
            beyond = f"{'-' if node.op == 'sub' and not first else ''}{one}+0*{other}"
        return f"IF(ABS{one}<{_INFINITE},{_TEXT[node.op][0].format(a, b)},{beyond})"

    def _as_exported(self, node: Node, under: Iterable[Node], at: Index, rows: Rows) -> tuple[str, int]:
        """The numbers of the worksheet's own run while what is under them is unchanged."""
        value = _only(node.value.reshape(-1)[at if node.size > 1 else 0])
        known = "NA()" if node in self.lost and np.isinf(value) else written(value)
        same = [self._unchanged(x, rows) for x in under]
        return f"IF(AND({','.join(same)}),{known},NA())" if same else known, 5

    def _reduced(self, node: Node, at: Index, rows: Rows) -> tuple[str, int]:
        source, groups, kind, _ = node.args
        if not source.size:
            return written(node.value.reshape(-1)[0]), 2
        place, chosen = self.places[source], [groups[k] for k in at.tolist()]
        if max(map(len, chosen)) > 1 and all((np.diff(group) == 1).all() for group in chosen):
            ends = [np.array([group[n] for group in chosen]) for n in (0, -1)]
            cells = one = rows.range(place, *ends)
        else:
            length = _only(np.array([len(group) for group in chosen]))
            members = [rows.cells(place, np.array([group[n] for group in chosen])) for n in range(length)]
            cells = ",".join(members)
            one = f"CHOOSE({{{','.join(str(n + 1) for n in range(length))}}},{cells})"
        text, binding = _OF_RANGE[kind].format(cells, one), 2 if kind.startswith("arg") else 5
        if kind in ("sum", "prod", "nansum") and self.endless(source):
            text = f"IF(AND(MAX({cells})<{_INFINITE},MIN({cells})>-{_INFINITE}),{text},NA())"
        return (
            self._while_counted(node, text, binding) if source.stretches and kind.startswith("nan") else (text, binding)
        )

    def _while_counted(self, node: Node, text: str, binding: int) -> tuple[str, int]:
        """What is known of as many rows as columns have, and how tightly it binds; of those that tell this, before."""
        texts = sorted({*self._counted[: self._known.get(node)]})
        same = f"AND({','.join(texts)})" if len(texts) > 1 else "".join(texts)
        return (f"IF({same},{text},NA())", 5) if same else (text, binding)

    def _unchanged(self, node: Node, rows: Rows) -> str:
        """Condition under which an input or another quantity is what it was; of a list its rows tell what differs.

        Of what is searched, that all of it is found.
        """
        if node in self.searched:
            found = f"COUNT({self.places[node].range(0, node.size - 1)})={node.size}"
            if np.isfinite(node.value).all():
                return found
            same = ",".join(self._unchanged(each, rows) for each in self._inputs_under(node))
            return f"OR({found},AND({same}))"
        if node.size == 1:
            return f"{self._element(node, _FIRST, rows)[0]}={written(node.value.item())}"
        place = self.places[node]
        return f"SUM({place._replace(column=place.column + place.differs).range(0, node.size - 1)})=0"


def _of_one_source(node: Node) -> list[Index]:
    """Rows of a quantity's column by the source from which their elements are taken."""
    rows = np.arange(node.size)
    if node.op != "join":
        return [rows]
    which = node.args[1].reshape(-1)
    return [rows[which == source] for source in sorted(set(which.tolist()))]


def _only(values: Any) -> Any:
    """The value that is the same in all rows of a column."""
    first = values.reshape(-1)[0]
    if values.size > 1 and not ((values == first) | ((values != values) & (first != first))).all():
        raise Unlike
    return first


def written_of(node: Node) -> tuple[Node, ...]:
    """Quantities that stand in the formula of one: none of those that tell how many rows there are, which is fixed."""
    match node.op:
        case "like" | "sized":
            return node.operands[:1]
        case "rows" | "length":
            return ()
        case "iterated":  # by the turns that the loop takes, while these are as many
            return node.args[2:]
        case "reduce" if leaf := _as_it_was(node):
            return (leaf,)
    return node.operands


def _under(node: Node) -> set[Node]:
    """All that cells or readers look at for a quantity."""
    waiting, found = [node], set[Node]()
    while waiting:
        if (part := waiting.pop()) not in found:
            found.add(part)
            waiting += [*part.operands, *written_of(part)]
    return found


def _as_it_was(node: Node) -> Node | None:
    """The list among the inputs of which a condition says that all its numbers are the exported ones."""
    source, groups, kind, _ = node.args
    if kind != "all" or len(groups) != 1 or source.op != "eq":
        return None
    leaf, known = source.args
    same = leaf.op == "input" and leaf.size > 1 and known.op == "constant"
    return leaf if same and len(groups[0]) == leaf.size and np.array_equal(leaf.value, known.value) else None


def nesting(node: Node, inside: Mapping[Node, int]) -> int:
    """Parentheses inside each other in the formula of an operation whose operands have ``inside``."""
    deep = {operand: max(inside[operand], COUNTED * _elsewhere(operand, node)) for operand in written_of(node)}
    deepest = max(deep.values(), default=0)
    if node.op == "reduce":
        return deepest + (2 if node.args[2].startswith(("arg", "nan")) else 1)
    if node.op not in _TEXT:
        return deepest + {"at": 1, "like": 1, "sized": 1, "exported": 2, "found": 2}.get(node.op, 0)
    _, binding, needs = _TEXT[node.op]
    if binding == 5:
        return deepest + 1
    tight = map(_loosest, node.operands)
    return max(deep[o] + (t < need) for o, t, need in zip(node.operands, tight, needs, strict=True))


def _loosest(node: Node) -> int:
    """How loosely the text of a quantity may bind: of what is put together from others as theirs."""
    loosest, stack, seen = 5, [node], {node}
    while stack:
        here = stack.pop()
        if here.op in _TEXT:
            loosest = min(loosest, _TEXT[here.op][1])
        elif here.op == "join":
            stack += [operand for operand in here.operands if operand not in seen]
            seen.update(here.operands)
    return loosest


def _elsewhere(operand: Node, node: Node) -> bool:
    """Whether the operand of a row may stand in another row."""
    return operand.size > 1 and (operand.shape != node.shape or node.op in ("take", "join", "reduce", "at"))


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
    return all(part.op == "constant" or (part.operands and part.op != "rows") for part in bottom_up([node], ()))


def _is_one(node: Node) -> bool:
    """Whether the constant of a unit without a factor, such as N, or a power of it."""
    if node.op == "pow":
        return _is_one(node.args[0])
    return node.op == "constant" and bool(node.args) and node.size == 1 and bool(node.value == 1)


def _scaled(text: str, factor: float) -> str:
    if factor == math.pi / 180:
        return f"DEGREES({text})"
    if factor < 1:
        return f"{text}*{written(1 / factor)}"
    known = written(factor)
    return f"{text}/({known})" if "*" in known else f"{text}/{known}"  # of a turn, 2*PI()


def _position(shape: tuple[int, ...], whole: tuple[int, ...], at: Index) -> Index:
    """Flat positions in an operand of elements of what it is broadcast to."""
    if shape == whole:
        return at
    return _positions(shape, whole)[at] if math.prod(shape) > 1 else np.zeros_like(at)


@lru_cache(maxsize=256)
def _positions(shape: tuple[int, ...], whole: tuple[int, ...]) -> Index:
    return np.broadcast_to(np.arange(math.prod(shape)).reshape(shape), whole).reshape(-1)


def written(value: Any) -> str:
    """A constant as it stands in a formula."""
    if isinstance(value, bool | np.bool_):
        return "TRUE" if value else "FALSE"
    x = float(value)
    if not math.isfinite(x):
        return "NA()" if math.isnan(x) else f"{'-' if x < 0 else ''}{_INFINITE}"
    for text, known in _KNOWN.items():
        if x == known:
            return text
    return str(int(x)) if x.is_integer() and abs(x) < 1e15 else repr(x).upper()


_KNOWN = {"PI()": math.pi, "2*PI()": 2 * math.pi, "PI()/2": math.pi / 2, "PI()/180": math.pi / 180}
