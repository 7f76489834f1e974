"""Bands of a recording: how far its quantities are off where inputs lie within their tolerances, by the slopes.

To the first order: where a quantity bends within the tolerances its band does not tell, Monte Carlo and balls do; where
some corners of the tolerances show that the slopes mislead, cases do. At a corner it is the steeper side that counts.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, product
from typing import Any, NamedTuple

import numpy as np

from mechsheet import units
from mechsheet.quantities.graph import Gap
from mechsheet.quantities.lines import Recording, Residual
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.operations import Values
from mechsheet.readers.beside import beside
from mechsheet.readers.cases import JUMPS, Cases, in_cases
from mechsheet.readers.jumps import MISLED, Jump, jumps
from mechsheet.readers.numbers import numbers as recomputed
from mechsheet.readers.slopes import seen, slopes, unfollowed
from mechsheet.readers.terms import made_of, size_of
from mechsheet.worksheet import inputs, numbers
from mechsheet.worksheet.deviation import LIKE, SIGMAS
from mechsheet.worksheet.errors import OF_NUMBERS, SheetError
from mechsheet.worksheet.kinds import Input

_CASES = 20_000  # random ones by which a check is judged
_PLACES = 16  # within the tolerances at which it is looked whether slopes mislead: all ends of few, some of many
_INSIDE = 4  # of them between the ends: what turns may be at all of these what it is now
_LITTLE = 0.05  # of how far a check moves: what bends by less hardly changes in how many cases it holds
_CRITICAL = 100  # elements of a check that are judged at a time
BENDS, ENDS = "it bends", "it ends within the tolerances"  # what slopes do not tell
_EPS = float(np.finfo(float).eps)
_ROUNDING = 1e-9  # of the greatest number
_LEFT = 1e-12  # of the terms: what is left where they cancel


class Tolerance(NamedTuple):
    """An input with its tolerance: its declaration, its value and greatest deviation in SI."""

    field: Input
    value: float
    size: float

    @property
    def normal(self) -> bool:
        return self.field.tolerance is not None and self.field.tolerance.normal

    @property
    def deviation(self) -> float:
        """Standard deviation, in SI."""
        return self.size / (SIGMAS if self.normal else np.sqrt(3.0))

    def __str__(self) -> str:
        f = self.field
        return f"{f.name} = {f.brief(self.value)}{numbers.suffix(f.unit)} {f.tolerance and f.tolerance.text(f.unit)}"


def tolerances(g: Any) -> dict[str, Tolerance]:
    """Inputs of a worksheet that have a tolerance, by name.

    Raises SheetError where none has one, and where a value at the end of its tolerance breaks a limit.
    """
    cls, found = type(g), dict[str, Tolerance]()
    if not inputs.declared(cls):
        raise SheetError("the worksheet has no inputs that could have tolerances")
    own = {field.name: shown for field, shown in inputs.Used(g).rows() if type(field) is Input}
    for field in inputs.declared(cls):
        if field.tolerance:
            value, size = own[field.name], field.tolerance.of(own[field.name])
            ends = inputs.variants(cls, {**own, field.name: [value - size, value + size]})
            for reason in filter(None, ends.reasons):
                raise SheetError(f"tolerance {field.tolerance.text(field.unit)}: {reason}", field.name)
            found[field.name] = Tolerance(field, getattr(g, field.name), size * units.parse(field.unit).factor)
    if not found:
        raise SheetError(f"no input has a tolerance: behind the limits of one write ; {LIKE}")
    return found


@dataclass(frozen=True, eq=False)
class Band:
    """How far a quantity is off, in SI: by each input alone, shape (inputs, ...); ``why`` where that is not known."""

    moves: Values
    deviations: Values
    why: str = ""

    def none(self, why: str) -> "Band":
        """That nothing is known of the same quantity, and why."""
        return Band(np.full(self.moves.shape, np.nan), np.full(self.moves.shape, np.nan), why)

    @property
    def lost(self) -> str:
        """Why nothing is known where that is not that it jumps, of which cases tell."""
        return "" if self.why.startswith(JUMPS) else self.why

    @property
    def worst(self) -> Values:
        """Greatest deviation, where all inputs are at their worst."""
        return np.asarray(np.abs(self.moves).sum(0))

    @property
    def squares(self) -> Values:
        """Root of the squares of what each input alone does."""
        return np.asarray(np.sqrt((self.moves**2).sum(0)))

    @property
    def deviation(self) -> Values:
        """Standard deviation."""
        return np.asarray(np.sqrt((self.deviations**2).sum(0)))


class Bands:
    """Bands of quantities of one recording, for inputs with tolerances; ``run`` runs the worksheet within these."""

    def __init__(self, recording: Recording, by: Mapping[str, Tolerance], run: Callable[[], Cases]) -> None:
        self.recording, self.by, self.run = recording, list(by.values()), run
        self.inputs = [recording.inputs[name] for name in by]
        self.known, self.ran = dict[Node, Band](), False
        self.places = _places(len(by))
        self.there = [dict[Node, Values]() for _ in self.places]

    @cached_property
    def cases(self) -> Cases:
        """Cases within the tolerances, which only what jumps or bends there needs."""
        self.ran = True
        return self.run()

    def of(self, nodes: Iterable[Node]) -> dict[Node, Band]:
        """Bands of some quantities, each in its shape; best all at once, for they share what they rest on."""
        nodes = list(dict.fromkeys(nodes))
        new = [node for node in nodes if node not in self.known]
        lacking = {node: unfollowed([node], self.inputs) for node in new} if unfollowed(new, self.inputs) else {}
        moved = beside(slopes([node for node in new if not lacking.get(node)], self.inputs), self.inputs)
        for node in new:
            lost = lacking.get(node)
            self.known[node] = (
                self._none(node, untold(lost, self.recording.gaps)) if lost else self._band(node, *moved[node])
            )
        return {node: self.known[node] for node in nodes}

    def _band(self, node: Node, ahead: Values, behind: Values) -> Band:
        """The band of a quantity with slopes, seen from ahead and from behind."""
        steeper = np.where(np.isnan(behind) | (np.abs(ahead) < np.abs(behind)), behind, ahead)
        if np.isnan(steeper[:, np.isfinite(node.value)]).any():
            lost = seen([node], self.inputs)
            jumps = f"{JUMPS} or ends there by {self._jumping(steeper)}"
            return self._none(node, untold(lost, self.recording.gaps) if lost else jumps)
        sizes, sigmas = (
            np.reshape(x, (-1, *[1] * len(node.shape)))
            for x in ([t.size for t in self.by], [t.deviation for t in self.by])
        )
        size = float(np.max(np.abs(node.value[np.isfinite(node.value)]), initial=0))
        steeper = np.where(np.abs(steeper * sizes) <= _EPS * size, 0.0, steeper)  # what cancels but for rounding
        return Band(steeper * sizes, steeper * sigmas)

    def _none(self, node: Node, why: str) -> Band:
        nothing = np.full((len(self.by), *node.shape), np.nan)
        return Band(nothing, nothing, why)

    def _jumping(self, slope: Values) -> str:
        rows = [bool(np.isnan(each).any()) for each in slope]
        return ", ".join(t.field.name for t, lost in zip(self.by, rows, strict=True) if lost)

    def jumps(self, nodes: Iterable[Node]) -> dict[Node, Jump]:
        """Those of some quantities that rest on what goes another way within the tolerances."""
        return jumps(nodes, self.inputs, [t.size for t in self.by])

    def turns(self, jump: Jump) -> str:
        """What goes another way, and by which inputs."""
        return f"line {jump.line} goes another way by {', '.join(self.by[k].field.name for k in jump.by)}"

    def look(self, nodes: Iterable[Node]) -> None:
        """What quantities are at some places within the tolerances; best of all at once, which share what is below."""
        new = [node for node in dict.fromkeys(nodes) if node not in self.there[0]]
        for place, there in zip(self.places, self.there, strict=True):
            there |= self._there(new, place)

    def _there(self, nodes: Sequence[Node], place: Values) -> dict[Node, Values]:
        """What quantities are at a place within the tolerances."""
        at = {x: t.value + part * t.size for x, t, part in zip(self.inputs, self.by, place.tolist(), strict=True)}
        try:
            found = recomputed(nodes, at)
        except OF_NUMBERS:  # as of a Find that has no interval there
            return {node: np.full(node.shape, np.nan) for node in nodes}
        return {node: found[node] for node in nodes}

    def misled(self, node: Node, guards: Sequence[Node] = ()) -> str:
        """Why the slopes of a quantity with a band tell nothing of it, as where it is at its least; else nothing.

        It is recorded under ``guards``, which may not hold at some place.
        """
        self.look([node, *guards])
        known, worst = np.isfinite(node.value), self.known[node].worst
        rounding = max(_ROUNDING * size_of(node), _LEFT * made_of(node, self.recording.made_of))
        within = MISLED * worst + rounding
        bends = bool(np.isinf(worst[known]).any())
        for there in self.there:
            if not all(there[guard].all() for guard in guards):
                bends = True
            elif np.isnan(there[node][known]).any():
                return ENDS
            bends |= bool(np.any(np.abs(there[node][known] - node.value[known]) > within[known]))
        return BENDS if bends else ""

    def compared(self, residual: Residual) -> list[Node]:
        """What a check compares with its limit, and that limit, whose bands tell how sure it is."""
        return [*(part for part, _ in _judged(residual)), residual.limit]

    def sure(self, name: str, passed: bool) -> str:
        """How sure the verdict of a check is: in all the tolerances, or in how many of the cases."""
        residual = self.recording.checks[name]
        parts, compared = _judged(residual), self.compared(residual)
        if set(self.inputs).isdisjoint(bottom_up(compared, ())):
            return "whatever the tolerances"
        if not all(_is_step(part) for part, _ in parts) and (found := self.jumps([*residual.parts, residual.limit])):
            return f"{self.cases.sure(name, passed)} ({self.turns(next(iter(found.values())))})"
        bands = self.of(compared)
        if why := next((band.why for band in bands.values() if band.why), ""):
            return f"how sure is not known: {why}"
        if all(_is_step(part) for part, _ in parts):
            return self._at_ends(residual, passed)
        own = _reserves(residual, {node: node.value for node in compared})
        moves = [_reserves(residual, {node: bands[node].moves[k] for node in compared}) for k in range(len(self.by))]
        reserves = np.stack([own, *(x + 0.0 * own for x in moves)])
        if self._misleads(residual, reserves, passed):
            return f"{self.cases.sure(name, passed)} ({BENDS})"
        return self._by_reserves(reserves, passed)

    def _misleads(self, residual: Residual, reserves: Values, passed: bool) -> bool:
        """Whether a check has another verdict at some place where slopes say that it has one in all the tolerances.

        Where they say in how many cases it holds, whether its least reserve at an end is another one than by them.
        """
        nodes = [*self.compared(residual), *residual.parts]
        if np.isinf(reserves[1:]).any():
            return True
        self.look(nodes)
        most, rounding = np.abs(reserves[1:]).sum(0), _ROUNDING * float(np.max(np.abs(reserves[0]), initial=0.0))
        k = int(np.argmin(reserves[0] - most))
        worst, sure = np.sign(reserves[1:, k]), self._is_sure(reserves)
        ends = ((place, self._there(nodes, place)) for place in (-worst, worst))
        for place, there in chain(zip(self.places, self.there, strict=True), ends):
            least = np.min(_reserves(residual, there))
            if sure:
                if not least >= -rounding if passed else least > rounding:
                    return True
            elif not abs(least - np.min(reserves[0] + place @ reserves[1:])) <= _LITTLE * most[k] + rounding:
                return True
        return False

    def _is_sure(self, reserves: Values) -> bool:
        """Whether a check has its verdict in all the tolerances, by the slopes."""
        most = np.abs(reserves[1:]).sum(0)
        return bool(np.all(reserves[0] >= most) or np.any(reserves[0] < -most))

    def _by_reserves(self, reserves: Values, passed: bool) -> str:
        """By the reserve of each element, in the first row, and how each input moves it."""
        if self._is_sure(reserves):
            return "in all the tolerances"
        most = np.abs(reserves[1:]).sum(0)
        return in_cases(self._share(reserves[:, reserves[0] < most]), passed)

    def _share(self, reserves: Values) -> float:
        """Part of random cases in which all elements have a reserve."""
        rng = np.random.default_rng(0)
        drawn = [rng.normal(0, 1 / SIGMAS, _CASES) if t.normal else rng.uniform(-1, 1, _CASES) for t in self.by]
        cases, holds = np.array(drawn).T, np.ones(_CASES, dtype=bool)
        for start in range(0, reserves.shape[1], _CRITICAL):
            some = reserves[:, start : start + _CRITICAL]
            holds &= (some[0] + cases @ some[1:] >= 0).all(1)
        return float(holds.mean())

    def _at_ends(self, residual: Residual, passed: bool) -> str:
        """Of a check that holds or not, such as that a group closes: at both ends of each input, and of all of them."""
        nodes, word = [*residual.parts, residual.limit], "fails" if passed else "holds"
        for node, t in zip(self.inputs, self.by, strict=True):
            for end in (t.value - t.size, t.value + t.size):
                if residual.holds(recomputed(nodes, {node: end})) != passed:
                    f = t.field
                    return f"{word} for {f.name} = {numbers.significant(f.display(end), 6)}{numbers.suffix(f.unit)}"
        self.look(nodes)
        if any(residual.holds(there) != passed for there in self.there):
            return f"{word} where several are at their ends"
        return "at both ends of each tolerance"


def _places(count: int) -> Values:
    """Places within so many tolerances, in parts of them, a row for each: all ends or random ones, some inside."""
    rng = np.random.default_rng(0)
    if 2**count <= _PLACES:
        ends = np.array([*product((-1.0, 1.0), repeat=count)])
    else:
        corners = rng.choice([-1.0, 1.0], ((_PLACES - _INSIDE) // 2, count))
        ends = np.unique(np.concatenate([corners, -corners]), axis=0)
    return np.concatenate([ends, rng.uniform(-1.0, 1.0, (_INSIDE, count))])


def _reserves(residual: Residual, there: Mapping[Node, Values]) -> Values:
    """What a check has left of its limit, by the numbers of what it compares, or by how these move."""
    most, limit = -1.0 if residual.at_least else 1.0, there[residual.limit]
    both = [(part, sign) for part, signed in _judged(residual) for sign in ((1.0,) if signed else (1.0, -1.0))]
    return np.concatenate([np.reshape(most * (limit - sign * there[part]), -1) for part, sign in both])


def _judged(residual: Residual) -> list[tuple[Node, bool]]:
    """What a check compares with its limit, each with whether by its sign: of the greater of two numbers both.

    The slopes of the greater one are those of one alone, which may be another within the tolerances. Of a least value
    it is the lesser one.
    """
    by_sign, extreme = residual.signed or residual.at_least, "min" if residual.at_least else "max"
    found, left = list[tuple[Node, bool]](), [(part, by_sign) for part in reversed(residual.parts)]
    while left:
        part, signed = left.pop()
        node = _bare(part, signed)
        of, signed = node.operands, signed or _is_no_less_than_0(node)
        if node.op == extreme and signed and all(x.shape in ((), node.shape) for x in of):
            left += [(x, True) for x in reversed(of)]
        elif node.op == "reduce" and node.args[2] == extreme and node.args[3].axis is None and signed:
            left.append((of[0], True))
        else:
            found.append((node, signed))
    return found


def _is_no_less_than_0(node: Node) -> bool:
    """Whether a quantity is that whatever the inputs are, as far as its last operations tell."""
    node = _bare(node, True)
    match node.op:
        case "constant":
            return bool(np.all(node.value >= 0))
        case "max":
            return any(map(_is_no_less_than_0, node.operands))
        case "reduce":
            return node.args[2] in ("max", "min", "sum") and _is_no_less_than_0(node.operands[0])
        case "join":
            return all(map(_is_no_less_than_0, node.operands))
    return node.op == "abs"


def _bare(node: Node, signed: bool) -> Node:
    """What a check takes the size of, without the condition under which it is recorded as the worksheet has it."""
    while node.op == "where" and node.args[2].op == "constant" and np.isnan(node.args[2].value).all():
        node = node.args[1]
    return _bare(node.args[0], signed) if node.op == "abs" and not signed else node


def _is_step(node: Node) -> bool:
    """Whether a quantity is 0 or 1 by a condition, or a count of such."""
    if node.op == "reduce" and node.args[2] == "sum":
        node = node.args[0]
    return node.op == "where" and all(part.op == "constant" for part in node.args[1:])


def untold(lost: Node, gaps: Sequence[Gap]) -> str:
    """Why nothing is known of a quantity that is not recorded."""
    told = (str(gap) for gap in gaps if gap.line == lost.line)
    return next(told, f"what line {lost.line} does is not followed")
