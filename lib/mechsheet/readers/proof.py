"""How many digits of what a worksheet shows are proved: its own numbers against balls that enclose the exact ones.

Exact is what the worksheet's formulas have for the inputs at hand, which are the floats as which they are held; 0.2 in
a formula is a fifth, and pi is pi. A proof shows that the numbers are those of the formulas, not that the formulas are
right.
"""

import itertools
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from math import floor, log10
from typing import Any

import numpy as np
from flint import arb

from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node, bottom_up, steps_of
from mechsheet.quantities.operations import SHAPED, Values
from mechsheet.readers import numbers as elsewhere
from mechsheet.readers.asked_numbers import Shown, of_lines, of_tables
from mechsheet.readers.ball_rules import NONE, UNDECIDED, constant, endless, leaves_open
from mechsheet.readers.balls import Balls, meant, precision, unfollowed
from mechsheet.readers.gradients import adjoints
from mechsheet.readers.proved_root import ProvedRoot, proved_root
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.scene import PROVED
from mechsheet.worksheet.table import Column, Table

_ALL = 16.0  # digits of a float, claimed where a number is exact
_BITS = (128, 256, 512, 1024)
_SMALL = 2.0**-60  # a ball beside the largest number of its column
_ZERO = 2.0**-500  # of what a number is made of: all that the highest precision leaves of one that is 0
_NEAR = 2.0**-20  # of an input: a step within which a number goes on as it is moved
_NOISE = 2.0**-24  # of what a number is made of: what rounding leaves of a difference by such a step
_HELD = 2.0**-51  # of an input: by how much it is off that is held as a float, in another unit than it is written


@dataclass(frozen=True)
class Proved:
    """Digits proved of each number of a column, relative to the largest one; 0 where nothing is, NaN where none can be.

    Of numbers that the worksheet has not, such as a root that is not found, there are none either.
    ``where`` is the table, ``name`` the column or result, ``why`` what keeps digits from being proved, with its line.
    One that is an ``exception`` has no digits, for the reason given, or those beside what it is made of. ``size`` is
    the number beside which they are, in the unit of the table's column, of results in SI; ``none`` of the numbers
    do not exist, which is proved of those that have digits.
    """

    where: str
    name: str
    digits: Values
    why: str = ""
    exception: bool = False
    size: float = np.inf
    none: int = 0

    @property
    def off(self) -> Values:
        """By how much each number may be off, in the unit of ``size``; infinite where nobody knows."""
        return np.where(self.digits > 0, self.size * 10.0**-self.digits, np.where(np.isnan(self.digits), 0.0, np.inf))

    @property
    def least(self) -> float:
        known = self.digits[~np.isnan(self.digits)]
        return float(known.min()) if known.size else np.nan

    @property
    def count(self) -> int:
        return self.digits.size - self.none

    @property
    def title(self) -> str:
        return f"{self.where}, {self.name}"

    def __str__(self) -> str:
        digits = [] if np.isnan(self.least) else [f"{_shown(self.least)} digits"]
        return f"{self.title}: " + "; ".join([*digits, *([self.why] if self.why else [])])


@dataclass(frozen=True)
class Proof:
    """What is proved of a run of a worksheet."""

    columns: tuple[Proved, ...]
    roots: tuple[ProvedRoot, ...]

    @cached_property
    def least(self) -> dict[str, Proved]:
        """Of each table, and of the single results, the column with the fewest digits."""
        found = dict[str, Proved]()
        for column in sorted(self.columns, key=lambda c: np.nan_to_num(c.least, nan=np.inf)):
            found.setdefault(column.where, column)
        return {column.where: found[column.where] for column in self.columns}

    @property
    def exceptions(self) -> list[Proved]:
        """Columns that are no numbers of the formulas, or 0 but for rounding."""
        return [column for column in self.columns if column.exception]

    @property
    def apart(self) -> list[str]:
        """The exceptions, a line each."""
        return [f"exception: {column}" for column in self.exceptions]

    def below(self, digits: float) -> list[Proved]:
        """Columns of which not every number is proved to so many digits."""
        return [column for column in self.columns if column.least < digits]

    def check(self, digits: float = PROVED) -> Check:
        """The check that every number is proved to so many digits, which names the first that is not."""
        least = [column.least for column in self.columns if not np.isnan(column.least)]
        missing = max((max(digits - own, 0.0) for own in least), default=np.nan)
        told = [str(column) for column in self.below(digits)[:1]]
        told += [str(root) for root in self.roots if not root.exists][:1]
        if none := sum(column.none for column in self.columns):
            own = sum(column.count for column in self.columns)
            told.append(f"{none} of {none + own} do not exist")
            missing = missing if own else np.nan
        apart = [column.title for column in self.exceptions]
        told += [f"but for exceptions: {'; '.join(apart)}"] if apart else []
        name = f"every number proved to {numbers.significant(digits, 4)} digits"
        return Check(name, missing, 0.0, "digits missing", "; ".join(told))

    def checks(self, digits: float = PROVED) -> list[tuple[Check, float]]:
        """The same of each table and of the single results, with the digits that are proved."""
        found = list[tuple[Check, float]]()
        for where, least in self.least.items():
            own = Proof(tuple(column for column in self.columns if column.where == where), ()).check(digits)
            found.append((replace(own, name=f"{where}: {own.name}"), _down(least.least)))
        return found

    def table(self) -> Table:
        """A row for each table: how many numbers it has, the fewest digits proved, and of which column."""
        rows = [(where, column, [c for c in self.columns if c.where == where]) for where, column in self.least.items()]
        columns = (
            _texts("where", "", [where for where, _, _ in rows]),
            Column("numbers", "-", "how many it shows", 0, np.array([sum(c.count for c in cs) for *_, cs in rows])),
            Column("digits", "-", "fewest that are proved", 1, np.array([_down(c.least) for _, c, _ in rows])),
            _texts("least", "column with the fewest", [c.name for _, c, _ in rows]),
            _texts("why", "what keeps them from being proved", [c.why for _, c, _ in rows]),
        )
        return Table(
            "proof", "Digits proved", columns, "Of the formulas' own numbers: not that the formulas are right."
        )

    def lines(self) -> list[str]:
        """The table, its exceptions and what is proved of found values, as texts."""
        rows = list(zip(*(column.texts() for column in self.table().columns), strict=True))
        heads = [("", "numbers", "digits proved", "least in", "")]
        return [*numbers.aligned([*heads, *rows]), *self.apart, *map(str, self.roots), self.table().note]


def prove(
    recording: Recording,
    namespace: Mapping[str, Any],
    tables: Iterable[Table],
    known: Mapping[str, Formula],
    lines: Mapping[str, int],
    fields: Collection[str] = (),
    done: Callable[[int, int], object] = lambda behind, count: None,
) -> Proof:
    """Digits proved of tables and single results of a run, and of found values what roots there are.

    ``known`` are the worksheet's lines that declare a unit, ``lines`` where the names of the worksheet are bound.
    Results over several positions are proved in their tables, and by themselves those of the ``fields``. ``done`` is
    called with how many of how many steps are behind.
    """
    every = chain(of_tables(recording, tables, lines), of_lines(recording, namespace, known, lines, fields))
    shown = [each for each in every if each.own.size]  # a table may have no rows
    digits = _Digits(recording)
    steps, count = itertools.count(1), 2 * len(shown) + len(recording.found)

    def step() -> None:
        done(next(steps), count)

    digits.enclose(shown, step)
    columns, roots = list[Proved](), list[ProvedRoot]()
    for each in shown:
        columns.append(digits.proved(each))
        step()
    with precision(_BITS[0]):
        for key, solved in recording.found.items():
            alone = solved.node.op == "found" and solved.node.args[0].single
            roots.append(proved_root(digits.first, solved.words.unknown if alone else key, solved))
            step()
    return Proof(tuple(columns), tuple(roots))


class _Digits:
    """Balls of what is shown, each as small as the precisions that are tried make it."""

    def __init__(self, recording: Recording) -> None:
        self.recording = recording
        self.found = dict[Node, Values]()
        self.first = self.last = Balls()
        self.finest = Balls()

    def enclose(self, shown: Iterable[Shown], step: Callable[[], object]) -> None:
        """Find the balls; ``step`` is called as soon as each has one."""
        sizes = dict[Node, float]()
        for each in shown:
            if each.node:
                sizes[each.node] = min(each.size * each.factor, sizes.get(each.node, np.inf))
                with precision(_BITS[0]):
                    self.first.of([each.node])
            step()
        for bits in _BITS:
            with precision(bits):
                self.last = self.first if bits == _BITS[0] else Balls()
                self.found |= zip(sizes, self.last.of(sizes), strict=True)
            hopeless = unfollowed(sizes)
            sizes = {
                node: size
                for node, size in sizes.items()
                if node not in hopeless and not all(_small(x, size) for x in self.found[node].flat)
            }
            if not sizes:
                break

    def proved(self, shown: Shown) -> Proved:
        def nothing(why: str) -> Proved:
            return Proved(shown.where, shown.name, np.zeros(shown.own.shape), f"{shown.at}{why}")

        if shown.node is None:
            return nothing("it is not recorded")
        if near := next((n for n in bottom_up([shown.node], ()) if n in self.recording.integrals), None):
            bound = "of whose error there is no bound: that takes one of what is integrated between its places"
            return nothing(f"the integral of line {near.line} is the sum of a rule, {bound}")
        balls = self.found[shown.node].reshape(-1)
        if balls.size != shown.own.size:
            return nothing("it is recorded with another number of rows")
        with precision(_BITS[0]):
            digits = _digits(balls, shown.own, shown.factor, shown.size)
        none, open_ = (int(np.count_nonzero(np.isnan(each))) for each in (shown.own, digits))
        if open_ < digits.size and np.nanmin(digits) >= PROVED:
            why = f"{self.why(shown)}: {open_} of {digits.size} have no number" if open_ else ""
            return Proved(shown.where, shown.name, digits, why, size=shown.size, none=none)
        if _is_count(shown.node):
            why = f"{shown.at}a count of evaluations, which is none of the formulas' numbers"
            return Proved(shown.where, shown.name, np.full(shown.own.shape, np.nan), why, exception=True)
        lost = Proved(shown.where, shown.name, digits, self.why(shown), size=shown.size, none=none)
        return self.zero(shown, shown.node) or lost

    @np.errstate(all="ignore")
    def zero(self, shown: Shown, node: Node) -> Proved | None:
        """Digits of numbers that are 0 but for rounding, beside what they are made of; None of others.

        They are 0 to hundreds of digits, or less than what the inputs move them by that are held as floats.
        """
        with precision(_BITS[-1]):
            (found,) = self.finest.of([node])
        largest = int(np.argmax(np.abs(shown.own)))
        moves = {part: share * part.value for part, share in adjoints(node, largest).items()}
        parts = [np.abs(m) for m in (*moves.values(), *(part.value for part in _addends(node)))]  # some move nothing
        made = max(float(np.max(m, initial=0.0, where=np.isfinite(m))) for m in parts)
        given = {part: m for part, m in moves.items() if _is_held(part)}
        if not _within(found, made * _ZERO):
            if not _within(found, max(made * _ZERO, _HELD * sum(map(_most, given.values())))):
                return None
            if not _within(found, _HELD * sum(_held(node, largest, part, m, made) for part, m in given.items())):
                return None
        digits = _digits(found, shown.own, shown.factor, made / shown.factor)
        part = numbers.significant(shown.size * shown.factor / made, 1)
        why = f"{shown.at}0 but for rounding, {part} of what it is made of, beside which its digits are"
        return Proved(shown.where, shown.name, digits, why, exception=True, size=made / shown.factor)

    def lost(self, part: Node) -> str:
        """What computes numbers of numbers alone that are not followed; nothing of others."""
        alone = self.recording.graph.unmoved
        return f"line {part.line}: {alone.lost[part]}" if alone and part in alone.lost else ""

    def why(self, shown: Shown) -> str:
        """What keeps digits from being proved: the first operation that leaves something open, or their rounding."""
        known = self.last.known if shown.node in self.last.known else self.first.known
        for part in bottom_up([shown.node] if shown.node else (), ()):
            if part in known and leaves_open(known[part]) and not any(leaves_open(known[o]) for o in part.operands):
                gap = next((str(gap) for gap in self.recording.gaps if gap.line == part.line), "")
                if part.op == "exported" and (gap := self.lost(part) or gap):
                    return gap
                if part.op == "found":
                    root = "least sum of squares" if part.args[0].least else "root"
                    what = f"no {root} is proved there"
                    return f"line {part.line}: {'a count of evaluations is no formula' if _is_count(part) else what}"
                return f"line {part.line}: {_WHY.get(part.op, 'it')} is not decided"
            if (
                part in known
                and _no_longer(part, known[part])
                and not any(_no_longer(o, known[o]) for o in part.operands if o in known)
            ):
                return f"line {part.line}: in exact arithmetic {_EXACTLY.get(part.op, 'it is no number')}"
        least = (p for p in bottom_up([shown.node] if shown.node else (), ()) if p.op == "found" and p.args[0].least)
        if found := next(least, None):
            return f"line {found.line}: the search for the least sum of squares ends there"
        return f"{shown.at}the rest is lost to rounding"


# What of an operation nobody knows where its ball says nothing.
_WHY = {
    "exported": "what is not recorded", "iterated": "what a loop ends with",
    "sqrt": "whether the root is of a negative number",
    "div": "whether the divisor is 0", "at": "which element is taken", "where": "a choice",
    "atan2": "the side of a full turn", "mod": "a whole turn", "floor": "a whole number", "round": "a whole number",
    "log": "whether the logarithm is of 0", "pow": "whether the base is 0 or below", "tan": "the side of a pole",
    **dict.fromkeys(("asin", "acos"), "whether there is such an angle"), "reduce": "which of several it is",
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne"), "which of two numbers is greater"),
}  # fmt: skip

_SUMS = frozenset(("add", "sub", "neg", "abs", "max", "min", "take", "join", "reduce", "like"))

# What has a number by rounding alone.
_EXACTLY = {"iterated": "a loop takes other turns", "where": "another way is taken"}


def _within(balls: Values, size: float) -> bool:
    known = (x is not NONE and (isinstance(x, float) or x.is_finite()) and abs(x) <= size for x in balls.flat)
    return all(map(bool, known))  # of a condition the ball is a plain number


def _most(moves: Values) -> float:
    return float(np.nansum(np.abs(moves)))


def _is_held(part: Node) -> bool:
    """Whether an input, which may be no number that is written in a formula."""
    return part.op == "input" and part not in meant.get()


def _held(node: Node, element: int, part: Node, moves: Values, made: float) -> float:
    """By how much an input moves a number; 0 of one that is no float, or moves it elsewhere than where it is alone.

    A number that has gone through many turns of chaos is moved beyond all it can be by the last digit of an input.
    """
    if part.value.dtype.kind != "f":
        return 0.0
    try:
        there = elsewhere.numbers([node], {part: part.value * (1 + _NEAR)})[node]
    except Exception:  # of an input that has no other value
        return _most(moves)
    moved = (there - node.value).reshape(-1)[element] / _NEAR
    off, most = float(abs(moved - np.nansum(moves))), _most(moves)
    return most if off <= most / 2 + made * _NOISE else 0.0


def _addends(node: Node) -> Iterator[Node]:
    """What a sum is made of, or the size or one of several; nothing of a quantity that is none."""
    return steps_of(node, lambda part: part.operands if part.op in _SUMS else (), ())


def _is_count(node: Node) -> bool:
    """Whether a quantity is made of counts of evaluations and of nothing else."""
    counts = set[Node]()
    for part in bottom_up([node], ()):
        if part.op == "found":
            counts |= {part} if part.args[1] >= len(part.args[0].nodes) else set()
            continue
        made_of = part.operands[:1] if part.op in SHAPED else part.operands
        if own := [operand for operand in made_of if operand.op != "constant"]:
            counts |= {part} if counts.issuperset(own) else set()
    return node in counts


def _small(x: Any, size: float) -> bool:
    if x is NONE or isinstance(x, float):
        return x is NONE or x != UNDECIDED
    return bool(x.is_finite() and x.rad() <= _SMALL * size) or endless(x)


def _no_longer(node: Node, balls: Values) -> bool:
    """Whether exact arithmetic has no number where the worksheet has one."""
    return any(x is NONE and v == v for x, v in zip(balls.flat, node.value.flat, strict=False))


def _digits(balls: Values, own: Values, factor: float, size: float) -> Values:
    """Digits of numbers that their balls prove beside a size, in a unit; also that there is no number."""
    unit = constant(factor)
    return np.array([_digits_of(x, v, unit, size) for x, v in zip(balls.flat, own.astype(float).flat, strict=True)])


def _digits_of(x: Any, own: float, unit: Any, size: float) -> float:
    if isinstance(x, float):
        x = arb(x) if x != UNDECIDED else arb.nan()
    if np.isnan(own):
        return _ALL if x is NONE else 0.0 if x.is_finite() else np.nan
    if x is NONE:
        return 0.0
    if np.isinf(own):
        return _ALL if endless(x) and (x > 0) == (own > 0) else 0.0
    off = abs(x / unit - own).upper()
    if off.is_zero() or (own == 0 and 2 * off < 5e-324):  # no other float is as near
        return _ALL
    if not off.is_finite() or not size:
        return 0.0
    part = float(off / size)
    return min(max(0.0, -log10(part)), _ALL) if part else _ALL


def _down(digits: float) -> float:
    # Never more than there are.
    return floor(10 * digits) / 10 if digits == digits else digits


def _shown(digits: float) -> str:
    return numbers.fixed(_down(digits), 1)


def _texts(heading: str, meaning: str, texts: Sequence[str]) -> Column:
    return Column(heading, "", meaning, 0, np.array(texts, dtype=object))
