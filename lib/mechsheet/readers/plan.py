"""Some numbers of a recording as one Python function of the inputs: what is asked for often, without the worksheet.

Single numbers are computed by single floats, arrays by numpy, both as in `numbers`; a Find of one unknown in an
interval is solved again as by `find`, on its recorded equation. The function tells where it cannot know that the
worksheet gives the same: what Python saw of a quantity is not so any more, a single number does not exist, a Find is
not plain.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from mechsheet.mechanics.plain_root import NotPlain, plain_root
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE
from mechsheet.readers.numbers import _RULES

Plan = Callable[[Sequence[Any]], Sequence[Any]]
REFUSED = (NotPlain, ValueError, ZeroDivisionError, OverflowError)  # what a plan raises that cannot tell


class NotPlanned(Exception):
    """A recording that no plan computes again."""


_SINGLE = {
    "add": "{}+{}", "sub": "{}-{}", "mul": "{}*{}", "div": "{}/{}", "neg": "-{}", "pow": "power({},{})",
    "abs": "abs({})", "sqrt": "sqrt({})", "exp": "exp({})", "log": "log({})", "sin": "sin({})", "cos": "cos({})",
    "tan": "tan({})", "asin": "asin({})", "acos": "acos({})", "atan2": "atan2({},{})", "floor": "float(floor({}))",
    "round": "float(round({}))", "mod": "{}%{}",
    "max": "({1} if {1}>{0} else {0} if {0}>={1} else no())", "min": "({1} if {1}<{0} else {0} if {0}<={1} else no())",
    "where": "({1} if {0} else {2})", "lt": "{}<{}", "le": "{}<={}", "gt": "{}>{}", "ge": "{}>={}", "eq": "{}=={}",
    "ne": "{}!={}", "and": "({} and {})", "or": "({} or {})", "not": "not {}", "finite": "isfinite({})",
}  # fmt: skip
_MANY = {"add": "{}+{}", "sub": "{}-{}", "mul": "{}*{}", "div": "{}/{}", "neg": "-{}", "abs": "abs({})"}
_MANY |= {op: _SINGLE[op] for op in ("lt", "le", "gt", "ge", "eq", "ne")}
_MATH = ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan2", "floor", "isfinite")
_NAMES: dict[str, Any] = {name: getattr(math, name) for name in _MATH}
_NAMES |= {"power": math.pow, "root": plain_root, "NotPlain": NotPlain, "array": np.asarray}


def _no() -> float:
    """Of what is no number, such as an element of an array, Python takes one or the other, and numpy none."""
    raise NotPlain


_NAMES["no"] = _no


def plan(inputs: Sequence[Node], wanted: Iterable[Node], same: Iterable[Node], exist: Iterable[Node]) -> Plan:
    """A function that computes the ``wanted`` quantities for other numbers of the inputs.

    It raises one of `REFUSED` where a condition of ``same`` is not met, or a single number under these or under those
    that shall ``exist`` is none. Raises NotPlanned where it would not know some number.
    """
    writing = _Writing()
    for k, node in enumerate(inputs):
        writing.names[node] = f"given[{k}]"
    results, conditions = list(wanted), list(dict.fromkeys(same))
    for node in bottom_up([*conditions, *exist, *results], set(inputs)):
        writing.add(node)
    for node in conditions:
        writing.say(f"if not {writing.names[node]}: raise NotPlain")
    writing.say(f"return [{', '.join(writing.names[node] for node in results)}]")
    names = {**_NAMES, **writing.known}
    exec("def planned(given):\n" + "\n".join(writing.lines), names)
    planned = names["planned"]
    return lambda given: _computed(planned, given)


@np.errstate(all="ignore")
def _computed(planned: Plan, given: Sequence[Any]) -> Sequence[Any]:
    return planned(given)


class _Writing:
    """The statements of a plan, and the names of the nodes in it."""

    def __init__(self) -> None:
        self.names, self.known, self.lines = dict[Node, str](), dict[str, Any](), list[str]()
        self.many = set[Node]()  # of many unknowns at once
        self.indent = 1

    def say(self, line: str) -> None:
        self.lines.append("    " * self.indent + line)

    def keep(self, value: Any) -> str:
        name = f"k{len(self.known)}"
        self.known[name] = value
        return name

    def add(self, node: Node) -> None:
        """Compute a node whose operands are known."""
        if node.op == "constant":
            self.names[node] = self.keep(node.value.item() if node.shape == () else node.value)
            return
        if node.op in ("input", "exported", "state", "iterated"):
            raise NotPlanned(node.op)
        text = self.found(node) if node.op == "found" else self.text(node)
        self.names[node] = f"v{len(self.names)}"
        self.say(f"{self.names[node]} = {text}")

    def text(self, node: Node) -> str:
        """The expression of a node."""
        under, names = node.operands, [self.names[operand] for operand in node.operands]
        arrays = [operand.shape != () or operand in self.many for operand in under]
        if node.op == "pow" and under[1].op == "constant" and under[1].shape == () and under[1].value == 2:
            return f"{names[0]}*{names[0]}"
        if node.op not in ELEMENTWISE:
            return self.whole(node, names)
        if not any(arrays):
            return _SINGLE[node.op].format(*names) if node.op in _SINGLE else self.whole(node, names)
        truths = any(operand.value.dtype == bool for operand in under)
        if node.op in _MANY and not truths:
            return _MANY[node.op].format(*names)
        if node.op == "where" and not arrays[0]:
            either = [self.filled(operand, node) for operand in under[1:]]
            if all(either):
                return f"({either[0]} if {names[0]} else {either[1]})"
        put = [name if is_array else f"array({name})" for name, is_array in zip(names, arrays, strict=True)]
        return f"{self.keep(ELEMENTWISE[node.op])}({', '.join(put if truths else names)})"

    def filled(self, operand: Node, node: Node) -> str:
        """An operand with the type and shape of a node, of which it may be all; "" where it has others."""
        if self.many or operand.value.dtype != node.value.dtype:
            return ""
        if operand.op == "constant":
            return self.keep(np.broadcast_to(operand.value, node.shape))
        return self.names[operand] if operand.shape == node.shape else ""

    def whole(self, node: Node, names: Sequence[str]) -> str:
        """The expression of what is no arithmetic of elements."""
        if not self.many.isdisjoint(node.operands):
            raise NotPlanned("an equation that is not one of each number")
        if node.op == "reduce" and node.args[3].axis is None and node.args[2] in ("any", "all"):
            return f"bool({names[0]}.{node.args[2]}())"
        rule = f"{self.keep(_RULES[node.op])}({', '.join([self.keep(node), *(f'array({n})' for n in names)])})"
        return f"{rule}.item()" if node.shape == () else rule

    def found(self, node: Node) -> str:
        """A Find of one number, with its equation as a function of many numbers and as one of a single one."""
        block, _ = node.args
        if not (block.single and block.elementwise and node.shape == ()) or block.method:
            raise NotPlanned("a Find that is not of one number")
        starts = [block.starts[end][0] if end in block.starts else None for end in ("lo", "hi", "guess")]
        for given in (*starts, block.sides[1]):
            if given and given.op == "constant":  # which a block does not count among what it rests on
                self.add(given)
        many, one = self.equation(block, node, True), self.equation(block, node, False)
        named = [self.names[start] if start else "None" for start in starts]
        return f"root({many}, {one}, {', '.join(named)}, {self.names[block.sides[1]]})"

    def equation(self, block: Block, unknown: Node, many: bool) -> str:
        f, before = f"f{len(self.lines)}", dict(self.names)
        self.say(f"def {f}(x):")
        self.indent += 1
        self.names[unknown] = "x"
        self.many = {unknown} if many else set()
        for node in bottom_up(block.sides[:1], self.names):
            self.add(node)
            if not self.many.isdisjoint(node.operands):
                self.many.add(node)
        self.say(f"return {self.names[block.sides[0]]}")
        self.indent -= 1
        self.names, self.many = before, set()
        return f
