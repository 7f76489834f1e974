"""A text with recorded numbers in it, which is written where these are known; Python sees it as the text of now."""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import or_
from typing import Any, NamedTuple

from mechsheet.quantities.arithmetic import choice, is_count
from mechsheet.quantities.graph import Guard, current
from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import regrouped
from mechsheet.quantities.perhaps import Perhaps, itself, settled, some_of, there
from mechsheet.quantities.quantity import Quantity
from mechsheet.worksheet.chosen import Chosen, place

_FORMAT = r"\+?(\.\d{1,2}[efg]|d|,(\.\d{1,2}f|d))|"  # which a reader writes too
_WIDE = r"([<>^]?)(\+?)([1-9]\d?)(|[,.a-z][^%]*)"  # so wide, with blanks
_SHORT = r"(\+?,?)(\.\d{1,2})?([efg%])"


class Number(NamedTuple):
    """A number in its format; of its text some signs are then replaced by others."""

    value: Quantity
    spec: str
    instead: tuple[tuple[str, str], ...] = ()
    blanks: str = ""  # on which side, and how wide it is with them

    def now(self) -> str:
        value = self.value.re.value.item()
        spec = self.spec if math.isfinite(value) else self.spec.removesuffix("d")  # where nobody reads it
        text: str = (int(value) if spec.endswith("d") else value).__format__(spec)
        return reduce(lambda told, pair: told.replace(*pair), self.instead, f"{text:{self.blanks}}")


class Either(NamedTuple):
    """One of two texts, by a condition."""

    holds: Quantity
    then: "Written"
    otherwise: "Written"


class OneOf(NamedTuple):
    """One of several texts, by its number; those of a ``column`` are inputs too, whose numbers tell which differ."""

    at: Quantity
    texts: tuple[str, ...]
    column: Quantity | None = None
    name: str = ""  # of the column

    @property
    def now(self) -> str:
        return self.texts[int(self.at.value)] if self.at.value >= 0 else ""  # no number is that of no text

    def seen(self) -> str:
        self.at.seen()
        if self.column is not None:
            self.at.graph.read(self.column[self.at].re)
        return self.now


Piece = str | Number | Either | OneOf


@dataclass(frozen=True, eq=False)
class Written:
    """Pieces of a text one after the other; nothing is noted of them until Python looks at the text as a whole."""

    parts: tuple[Piece, ...]

    @property
    def now(self) -> str:
        """The text with the present numbers."""
        return "".join(map(_now, self.parts))

    @property
    def fixed(self) -> str:
        """What of the text is the same for all inputs, with a sign for the rest."""
        return "".join(part if isinstance(part, str) else "…" for part in self.parts)

    @property
    def nodes(self) -> Iterator[Node]:
        """What stands in it, or decides what does."""
        for part in self.parts:
            match part:
                case Number(value):
                    yield value.re
                case OneOf(at):
                    yield at.re
                case Either(holds, then, otherwise):
                    yield from (holds.re, *then.nodes, *otherwise.nodes)

    def __str__(self) -> str:
        for part in self.parts:
            if isinstance(part, Either):
                str(part.then if part.holds else part.otherwise)
            elif isinstance(part, Number):
                part.value.__format__(part.spec)
            elif isinstance(part, OneOf):
                part.seen()
        return self.now

    def __format__(self, spec: str) -> str:
        return str(self).__format__(spec)

    def __repr__(self) -> str:
        return repr(str(self))

    def __bool__(self) -> bool:
        return any(part and isinstance(part, str | Number) for part in self.parts) or bool(str(self))

    def __eq__(self, other: object) -> Any:
        same = self._is(other) if isinstance(other, str) else None
        return str(self) == (str(other) if isinstance(other, Written) else other) if same is None else same

    def __ne__(self, other: object) -> Any:
        same = self == other
        return not same if isinstance(same, bool) else same == 0

    def _is(self, text: str) -> Any:
        """Whether it is a text, as a condition; None where it has numbers in it."""
        match self.parts:
            case () | (str(),):
                return self.now == text
            case (OneOf(at, texts, None),):
                return reduce(or_, (at == k for k, each in enumerate(texts) if each == text), at != at)
            case (Either(holds, then, otherwise),):
                ways = then._is(text), otherwise._is(text)
                if any(way is None for way in ways) or ways[0] is ways[1]:
                    return None if ways[1] is None else ways[0]
                return choice(holds.graph, holds, *ways)
        return None

    def __hash__(self) -> int:
        return hash(str(self))

    def __lt__(self, other: "str | Written") -> bool:
        return str(self) < str(other)

    def __gt__(self, other: "str | Written") -> bool:
        return str(self) > str(other)

    def __len__(self) -> int:
        return len(str(self))

    def __getitem__(self, key: Any) -> str:
        return str(self)[key]

    def __contains__(self, text: str) -> bool:
        return text in str(self)

    def __add__(self, other: "str | Written") -> "Written":
        return Written(tuple(_pieces([self, other]))) if isinstance(other, str | Written) else NotImplemented

    def __radd__(self, other: str) -> "Written":
        return Written(tuple(_pieces([other, self]))) if isinstance(other, str) else NotImplemented

    def __getattr__(self, name: str) -> Any:
        """Methods of texts."""
        if not hasattr(str, name):
            raise AttributeError(f"{name} of a text")
        return getattr(str(self), name)

    def replace(self, old: str, new: str, count: int = -1) -> "str | Written":
        """With one sign in place of another one; anything longer may lie across pieces."""
        if len(old) != 1 or count != -1:
            return str(self).replace(old, new, count)
        return Written(tuple(_replaced(part, old, new) for part in self.parts))

    def head(self) -> "tuple[str | Number | OneOf, Written] | None":
        """What stands before the first space, where it is a text or a number alone, and the rest."""
        match self.parts:
            case (str(first), *rest) if " " in first:
                begin, space, more = first.partition(" ")
                return begin, Written((space + more, *rest))
            case (OneOf() as first, *rest):
                return first, Written(tuple(rest))
            case (Number() as first, *rest) if not rest or (isinstance(rest[0], str) and rest[0][0] == " "):
                return first, Written(tuple(rest))
        return None

    def ways(self) -> "Either | None":
        """The whole text as one of two, where it begins with one of two."""
        match self.parts:
            case (Either(holds, then, otherwise), *rest):
                return Either(holds, *(Written(tuple(_pieces([way, *rest]))) for way in (then, otherwise)))
        return None

    def is_name(self) -> bool:
        """Whether a reader can tell its `head`, whichever of two texts it is."""
        if either := self.ways():
            return either.then.is_name() and either.otherwise.is_name()
        return not self.parts or self.head() is not None

    def strip(self, signs: str | None = None) -> "str | Written":
        """Without white space at its ends."""
        if signs is not None or not self.parts or any(isinstance(part, Either) for part in self.parts):
            return str(self).strip(signs)
        first, *rest = self.parts
        parts = [first.lstrip() if isinstance(first, str) else first, *rest]
        last = parts.pop()
        return Written(tuple(_pieces([*parts, last.rstrip() if isinstance(last, str) else last])))


def _now(part: Piece) -> str:
    match part:
        case Number():
            return part.now()
        case Either(holds, then, otherwise):
            return (then if holds.value else otherwise).now
        case OneOf():
            return part.now
    return part


class Said(NamedTuple):
    """A text that a cell shows, and the guards under which it is the worksheet's own."""

    text: Written
    guards: Sequence[Guard]


def text(*parts: Any) -> Any:
    """What an f-string gives: its texts, and its values each with its format."""
    shown = [piece for part in parts for piece in _shown(*(part if isinstance(part, tuple) else (part, "")))]
    return "".join(shown) if all(isinstance(part, str) for part in shown) else Written(tuple(_pieces(shown)))


def said(value: Any) -> Any:
    """One of two values in a text, of which Python need not see which one it is."""
    return Written((value,)) if isinstance(value, str) else value


def _shown(value: Any, spec: str) -> Iterator[Any]:
    """Pieces of a text for a value in its format."""
    blanks = end = ""
    if isinstance(value, Perhaps) and not spec:
        yield from either(some_of(value), Written(tuple(_pieces([*_shown(itself(value), "")]))), "None").parts
        return
    value = there(value)
    if isinstance(value, Quantity) and value.graph.draws and (wide := re.fullmatch(_WIDE, spec)):
        spec, blanks = wide[2] + wide[4], (wide[1] or ">") + wide[3]
    if isinstance(value, Chosen):
        options, at = place(value)
        value = Written((OneOf(at, options),)) if isinstance(at, Quantity) else str(value)
    elif isinstance(value, Quantity) and (short := re.fullmatch(_SHORT, spec)):
        begin, digits, kind = short[1], short[2] or ".6", short[3]
        value, kind, end = (value * 100, "f", "%") if kind == "%" else (value, kind, "")
        spec = begin + digits + kind
    elif isinstance(value, Quantity) and spec in ("", "+", ",", "+,") and is_count(value):
        spec += "d"
    followed = _is_followed(value, spec)
    if followed:
        yield Number(value, spec, blanks=blanks) if isinstance(value, Quantity) else value
    else:
        yield f"{f'{value:{spec}}':{blanks}}"
    yield end


def joined(sign: Any, parts: Any) -> Any:
    """``sign.join(parts)`` of texts, some of them with recorded numbers in them."""
    each = [*map(_part, parts)] if isinstance(sign, str | Written) else None
    if each is None or not any(isinstance(part, Written) for part in (sign, *each)):
        return sign.join(parts if each is None else each)
    pieces = [piece for part in each for piece in (sign, part)][1:]
    return Written(tuple(_pieces(pieces)))


def _part(value: Any) -> Any:
    return text(value) if isinstance(value, Chosen) else there(value)


def either(holds: Quantity, then: "str | Written", otherwise: "str | Written") -> Written:
    """One text where a condition holds, else the other one; of ways in one another each text stands there once."""
    holds = holds if holds.dtype == bool else holds != 0
    one, other = (Written(tuple(_pieces([side]))) for side in (then, otherwise))
    match one.parts, other.parts:
        case (Either(inner, text, rest),), _ if _is_same(rest, other):
            return Written((Either(holds & inner, text, rest),))
        case _, (Either(inner, text, rest),) if _is_same(rest, one):
            return Written((Either((holds == 0) & inner, text, rest),))
    return Written((Either(holds, one, other),))


def _is_same(one: Written, other: Written) -> bool:
    """Whether two texts are made of the same pieces."""
    pairs = zip(one.parts, other.parts, strict=False)
    alike = (a is b or (isinstance(a, str) and isinstance(b, str) and a == b) for a, b in pairs)
    return len(one.parts) == len(other.parts) and all(alike)


def seen(value: Any) -> Any:
    """A number or a text for Python to look at, as it is now; a guard tells while it is the same."""
    if isinstance(value, Quantity):
        return value.seen().item() if value.single else value.seen()
    return str(value) if isinstance(value, Written | Chosen) else value


def looked_at(value: Any) -> Any:
    """A value for what shows it, which is of the texts in it that are said now, and is there or is none."""
    value = settled(value)
    if isinstance(value, Written) and not current.get().draws:
        return str(value)
    if isinstance(value, tuple | list) and any(isinstance(part, Written) for part in value):
        return regrouped(value, map(looked_at, value))
    return value


def _is_followed(value: Any, spec: str) -> bool:
    if isinstance(value, Written):
        return not spec
    if not isinstance(value, Quantity) or value.re.op == "constant" or not re.fullmatch(_FORMAT, spec):
        return False
    return value.im is None and value.single and value.dtype.kind in "iuf"


def _pieces(parts: list[Any]) -> Iterator[Piece]:
    """Pieces in a row, texts that meet as one."""
    waiting = ""
    for part in [piece for whole in parts for piece in (whole.parts if isinstance(whole, Written) else (whole,))]:
        if isinstance(part, str):
            waiting += part
            continue
        if waiting:
            yield waiting
        waiting = ""
        yield part
    if waiting:
        yield waiting


def _replaced(part: Piece, old: str, new: str) -> Piece:
    match part:
        case Number():
            return part._replace(instead=(*part.instead, (old, new)))
        case Either(holds, then, otherwise):
            ways = (Written(tuple(_replaced(piece, old, new) for piece in way.parts)) for way in (then, otherwise))
            return Either(holds, *ways)
        case OneOf():
            return part.seen().replace(old, new)
    return part.replace(old, new)
