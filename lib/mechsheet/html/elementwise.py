"""JavaScript of single operations and numbers: what an elementwise operation of a recording is there."""

import re
from collections.abc import Iterator
from itertools import count, product
from string import ascii_letters
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Index = NDArray[np.intp]


class Text(NamedTuple):
    """An expression, and how tightly it binds: a choice 1, a call or a name 10."""

    text: str
    binding: int = 10

    def within(self, need: int) -> str:
        return f"({self.text})" if self.binding < need else self.text


# Operation: its text, how tightly it binds, and how tightly its operands must.
ELEMENTWISE: dict[str, tuple[str, int, tuple[int, ...]]] = {
    "where": ("{}?{}:{}", 1, (2, 1, 1)), "or": ("{}||{}", 2, (2, 3)), "and": ("{}&&{}", 3, (3, 4)),
    "eq": ("{}=={}", 4, (5, 5)), "ne": ("{}!={}", 4, (5, 5)), "lt": ("{}<{}", 5, (6, 6)),
    "le": ("{}<={}", 5, (6, 6)), "gt": ("{}>{}", 5, (6, 6)), "ge": ("{}>={}", 5, (6, 6)),
    "neg": ("-{}", 6, (8,)), "add": ("{}+{}", 6, (6, 7)), "sub": ("{}-{}", 6, (6, 7)), "mul": ("{}*{}", 7, (7, 8)),
    "div": ("{}/{}", 7, (7, 8)), "not": ("!{}", 8, (8,)), "pow": ("pow({},{})", 10, (1, 1)), "like": ("{}", 1, (1, 1)),
    "sized": ("{1}?{0}:NaN", 1, (1, 2)), "finite": ("isFinite({})", 10, (1,)),
    **{op: (f"{op}({{}})", 10, (1,)) for op in (
        "abs", "sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "sign", "floor", "round")},
    **{op: (f"{op}({{}},{{}})", 10, (1, 1)) for op in ("atan2", "mod", "min", "max")},
}  # fmt: skip
_SQUARE, _POWER = ("square({})", 10, (1,)), ("{}**{}", 9, (10, 9))
REFUSING: dict[str, tuple[str, int, tuple[int, ...]]] = {
    "div": ("per({},{})", 10, (1, 1)), "pow": ("refusing(pow({},{}))", 10, (1, 1)),
    "exp": ("refusing(exp({}))", 10, (1,)),
}  # fmt: skip
_OF_TRUTH = {"where": 1, "and": 2, "or": 2, "not": 1, "sized": 0}  # so many operands are conditions


def operation(op: str, operands: list[Text], conditions: list[bool], refuses: bool = False) -> Text:
    """An operation on operands, which are told to be conditions or numbers; as a condition every number but 0 holds.

    One of Python's own that is among the `REFUSING` ones ``refuses`` what would be infinite.
    """
    for k in range(_OF_TRUTH.get(op, 0)):
        if not conditions[k]:
            operands[k] = Text(f"{operands[k].within(5)}!=0", 4)
    form, binding, needs = ELEMENTWISE[op]
    if refuses and not (op != "exp" and _is_number(operands[1].text) and float(operands[1].text) > 0):
        form, binding, needs = REFUSING[op]
    elif op == "pow" and _is_number(operands[1].text):
        operands, (form, binding, needs) = (
            (operands[:1], _SQUARE) if operands[1].text == "2" else (operands, _POWER)
        )  # fmt: skip
    return Text(form.format(*(x.within(need) for x, need in zip(operands, needs, strict=True))), binding)


def _is_number(text: str) -> bool:
    return bool(re.fullmatch(r"-?[\d.]+(e-?\d+)?", text))


def literal(value: Any) -> Text:
    """A number or a condition."""
    if isinstance(value, bool | np.bool_):
        return Text("true" if value else "false")
    x = float(value)
    if x != x:
        return Text("NaN")
    if np.isinf(x):
        return Text("Infinity") if x > 0 else Text("-Infinity", 6)
    text = str(int(x)) if x.is_integer() and abs(x) < 1e6 else repr(x).replace("e+", "e").replace("e-0", "e-")
    text = text.replace("0.", ".", 1) if text.removeprefix("-").startswith("0.") else text.removesuffix(".0")
    return Text(text, 6 if text.startswith("-") else 10)


def array(values: Any) -> str:
    """A constant field."""
    texts = [literal(x).text for x in np.asarray(values).reshape(-1).tolist()]
    if len(texts) > 4 and len(set(texts)) == 1:
        return f"new Float64Array({len(texts)}).fill({texts[0]})"
    return f"Float64Array.of({','.join(texts)})"


def places(index: Index) -> str:
    """Positions: by equal steps along each axis where they are so."""
    start = int(index.reshape(-1)[0]) if index.size else 0
    steps = [int(np.diff(index, axis=k).reshape(-1)[0]) if n > 1 else 0 for k, n in enumerate(index.shape)]
    even = start + sum((s * np.arange(n)).reshape(-1, *[1] * (index.ndim - 1 - k))
                       for k, (s, n) in enumerate(zip(steps, index.shape, strict=True)))  # fmt: skip
    if index.size and np.array_equal(np.broadcast_to(even, index.shape), index):
        return f"positions({list(index.shape)},{steps}{f',{start}' if start else ''})".replace(" ", "")
    return f"[{','.join(map(str, index.reshape(-1).tolist()))}]"


def names(taken: frozenset[str]) -> Iterator[str]:
    """Short names, but for those that are taken."""
    digits = "0123456789"
    for length in count(1):
        for first, *rest in product(ascii_letters, *[ascii_letters + digits] * (length - 1)):
            if (name := "".join([first, *rest])) not in taken:
                yield name
