"""Loops that end by what they compute, for recorded quantities: readers repeat the turns for the inputs they have."""

import operator
from collections.abc import Callable, ItemsView, Iterator, KeysView, Mapping, Sequence, Sized, ValuesView
from contextlib import contextmanager
from contextvars import ContextVar
from functools import reduce
from itertools import repeat
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities import perhaps
from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.arithmetic import imaginary, is_count, none_like
from mechsheet.quantities.graph import Graph, Guard, NotRecorded, current
from mechsheet.quantities.lengths import turning
from mechsheet.quantities.node import Loop, Node, free_of
from mechsheet.quantities.quantity import Quantity, has_quantity, lift, owner
from mechsheet.quantities.refused import Turn, is_pythons, note, on_ways, unless
from mechsheet.recording.choices import ARRAYS, NUMBERS, UNBOUND, is_condition, is_there, part_of
from mechsheet.recording.in_place import of_now
from mechsheet.recording.memory import one_of


def iterated(turn: FunctionType, items: Any, item: int | None, *state: Any) -> Any:
    """What the names of a loop are in the end; ``turn`` tells whether it ends, and what they are after it.

    The name number ``item`` is the next one of the ``items``.
    """
    items = list(items) if isinstance(items, Mapping | KeysView | ValuesView | ItemsView) else items
    none = [n for n, x in enumerate(state) if x is None]
    if none and not hasattr(items, "__next__"):
        apart, looked = _Apart(turn, none), dict(current.get().looked)
        try:
            return apart.whole(_iterated(apart, items, item, *apart.parts(state)))
        except NotRecorded:
            current.get().looked = looked
    return _iterated(turn, items, item, *state)


class _Apart:
    """A turn of a loop of which some names are None at first: of each its number, and whether it is there."""

    def __init__(self, turn: Callable[..., Any], names: Sequence[int]) -> None:
        self._turn, self._names = turn, names

    def __call__(self, *parts: Any) -> tuple[Any, ...]:
        ends, *after = self._turn(*self.whole(parts))
        return ends, *self.parts(after)

    def parts(self, state: Sequence[Any]) -> tuple[Any, ...]:
        """The state, and behind it whether each of the names is there."""
        parts = [*state]
        for n in self._names:
            parts[n] = np.nan if state[n] is None else perhaps.itself(state[n])
            if not isinstance(parts[n], NUMBERS):
                raise NotRecorded("it is neither None nor a number")
        return (*parts, *(perhaps.some_of(state[n]) for n in self._names))

    def whole(self, parts: Sequence[Any]) -> tuple[Any, ...]:
        """The state itself."""
        state, graph = [*parts[: -len(self._names)]], current.get()
        for n, there in zip(self._names, parts[-len(self._names) :], strict=True):
            if is_condition(there):
                state[n] = perhaps.Number(there, unless(there, lift(graph, state[n])))
            else:
                state[n] = state[n] if there else None
        return tuple(state)


class Turns:
    """Python's range of so many numbers as the inputs say; who goes through them looks how many they are."""

    def __init__(self, ends: tuple[Any, ...], start: Any, step: int, count: Quantity) -> None:
        self.ends, self.start, self.step, self.count = ends, start, step, count
        self.sets = False  # whether elements of arrays

    def of(self, number: Any) -> Any:
        return (number if self.step == 1 else number * self.step) + self.start

    def end(self, number: Any) -> Quantity:
        """Whether a turn is the last one."""
        ended: Quantity = self.count <= number + 1
        return ended

    def __iter__(self) -> Iterator[int]:
        return iter(range(*self.ends))

    def __len__(self) -> int:
        return len(range(*self.ends))

    def __getitem__(self, key: Any) -> Any:
        return range(*self.ends)[key]


def counted(*ends: Any) -> Any:
    """Python's range, for a loop."""
    start, stop, step = (0, *ends, 1) if len(ends) == 1 else (*ends, 1)[:3]
    distance = lift(current.get(), stop) - start if has_quantity([start, stop]) else None
    if distance is None or not (distance.single and is_count(distance) and type(step) is int and step):
        return range(*ends)
    return Turns(ends, start, step, distance if step == 1 else -(-distance // step))


class _Within:
    """What is recorded of the loops in a turn of another one: nothing more than its own run, or any turn of them."""

    def __init__(self, of_any: bool) -> None:
        self.of_any, self.has_loops = of_any, False


_within: ContextVar[_Within | None] = ContextVar("_within", default=None)


@contextmanager
def _turns_of(within: _Within) -> Iterator[_Within]:
    token = _within.set(within)
    try:
        yield within
    finally:
        _within.reset(token)


def over_all(kind: str, f: Callable[[Any], Any], turns: Turns) -> Any:
    """The ``sum`` and the like of what a function gives for each number; there is one at least."""
    put, of_none = _PUT[kind]
    return _counted(lambda k, so_far: (False, k, put(so_far, f(k))), turns, 0, (UNBOUND, of_none))[1]


_PUT: dict[str, tuple[Callable[[Any, Any], Any], int]] = {"sum": (operator.add, 0), "prod": (operator.mul, 1)}


@turning()
def _iterated(turn: Callable[..., Any], items: Any, item: int | None, *state: Any) -> Any:
    """The same. A page also needs to know that Python has no error in any turn."""
    if not current.get().draws:
        return _followed(turn, items, item, *state)
    *found, exists = _followed(Turn(turn), items, item, *state, True)
    if isinstance(exists, Quantity):
        note(on_ways(exists))
    return tuple(found)


def _followed(turn: Callable[..., Any], items: Any, item: int | None, *state: Any) -> Any:
    """The same. Where a quantity decides about the end, readers repeat the turns for the inputs that they have."""
    if isinstance(items, Turns):
        return _counted(turn, items, item or 0, state)
    begun: tuple[int, tuple[Any, ...], dict[Node, Guard]] | None = None
    for number, value in enumerate(repeat(None) if item is None else items):
        if item is not None:
            state = (*state[:item], value, *state[item + 1 :])
        ends, *after = turn(*state)
        if begun is None and is_condition(ends):
            begun = number, state, dict(ends.graph.looked)
        state = tuple(after)
        if ends:
            break
    if begun is None:
        return state
    number, first, looked = begun
    if item is not None and not isinstance(items, range | list | tuple | np.ndarray | Quantity):
        return state
    rest, last = items if item is None else items[number:], state
    if item is not None and isinstance(rest, list | tuple) and all(isinstance(row, tuple | list) for row in rest):
        rest, first, last = _rows(rest), _with_row(first, item), _with_row(state, item)
    repeated = _repeated(turn, rest, item, first, last, looked)
    if repeated is None and item is not None and isinstance(rest, list | tuple):
        repeated = _one_by_one(turn, rest, item, first, looked)
    if repeated and item is not None:
        rows = [*items] if isinstance(items, list | tuple) else [items]
        owners = {id(owner(row)) for row in rows}
        may_be = [n == item or id(owner(x)) in owners for n, x in enumerate(state)]
        return tuple(one_of(x, *rows) if may else x for x, may in zip(repeated, may_be, strict=True))
    return repeated or state


@turning()
def _counted(turn: Callable[..., Any], turns: Turns, item: int, first: tuple[Any, ...]) -> Any:
    """What a loop gives of which the inputs say how many turns it takes at most; nothing changes where that is none."""
    graph, some = turns.count.graph, turns.count > 0
    looked = dict(graph.looked)
    state = tuple(of_now(x, always=True) if isinstance(x, Quantity) else x for x in first)
    with _turns_of(_Within(of_any=False)) as within:
        now = _taken(turn, turns, item, state)
        graph.see(some.re if some.value else (~some).re)
        now = now if some.value else _supposed(turn, turns, item, state)
    begin = (*first[:item], turns.of(0), *first[item + 1 :])
    found = now and _repeated(turn, turns, item, begin, now, looked)
    if not found and some.value and within.has_loops and not _within.get():  # each of which may be followed alone
        graph.looked = looked
        graph.see(some.re)
        now = _taken(turn, turns, item, first)
    if not found:
        return now if some.value else first
    given = [lift(graph, np.nan if x is UNBOUND else x) for x in first]
    ways = zip(found, given, strict=True)
    return tuple(x if x.parts == y.parts else where(graph, some, x, y.like(x)) for x, y in ways)


def _taken(turn: Callable[..., Any], turns: Turns, item: int, state: tuple[Any, ...]) -> tuple[Any, ...]:
    """What is after all turns that a loop takes now."""
    for number in range(int(turns.count.value)):
        ends, *after = turn(*state[:item], turns.of(number), *state[item + 1 :])
        state = tuple(after)
        if ends | turns.end(number):
            break
    return state


def _supposed(turn: Callable[..., Any], turns: Turns, item: int, state: tuple[Any, ...]) -> tuple[Any, ...]:
    """What would be after a turn, where there is none now; nothing where that would be an error."""
    graph = current.get()
    looked, work = dict(graph.looked), graph.work
    graph.supposed += 1
    try:
        _, *after = turn(*state[:item], turns.of(0), *state[item + 1 :])
        return tuple(after)
    except (Exception, NotRecorded):
        return ()
    finally:
        graph.supposed -= 1
        graph.looked, graph.work = looked, work


def _one_by_one(
    turn: Callable[..., Any], items: Sequence[Any], item: int, first: tuple[Any, ...], looked: dict[Node, Guard]
) -> tuple[Any, ...] | None:
    """What a loop over a list gives, by all its turns, of which one behind the end changes nothing.

    Its state may be rows with texts in them. None where Python has to look.
    """
    graph, state, ended = current.get(), first, lift(current.get(), False)
    now, work, graph.looked = graph.looked, graph.work, dict(looked)
    graph.supposed += 1  # what a turn binds that is not the last one now
    try:
        for n, value in enumerate(items):
            ends, *after = turn(*state[:item], value, *state[item + 1 :])
            state = tuple(after) if not n else tuple(part_of(ended, a, b) for a, b in zip(state, after, strict=True))
            if any(part is None for part in state):
                raise NotRecorded("a part of it is of another kind")
            ended = ended | ends
        followed = graph.looked.keys() == looked.keys()
    except (Exception, NotRecorded):
        followed = False
    finally:
        graph.supposed -= 1
    if followed:
        return state
    graph.looked, graph.work = now, work
    return None


def _with_row(state: tuple[Any, ...], item: int) -> tuple[Any, ...]:
    return tuple(_rows(x) if n == item else x for n, x in enumerate(state))


def _rows(rows: Any) -> Any:
    """Rows of numbers as an array, which any of them can be taken of; others as they are."""
    numbers = (int, float)
    each = rows if isinstance(rows[0], tuple | list) else [rows]
    alike = all(len(row) == len(each[0]) and all(isinstance(x, numbers) for x in row) for row in each)
    return np.array(rows) if alike else rows


def _repeated(
    turn: Callable[..., Any],
    items: Any,
    item: int | None,
    first: tuple[Any, ...],
    last: tuple[Any, ...],
    looked: dict[Node, Guard],
) -> tuple[Any, ...] | None:
    """What a loop gives however many turns it takes, by one from whatever state; None where that has no such form.

    ``looked`` are the guards before any that tell how many turns it takes now.
    """
    if outer := _within.get():
        outer.has_loops = True
    if outer and not outer.of_any:
        return None
    if not all(is_there(x, ARRAYS) or x is UNBOUND for x in (*first, *last)):
        return None
    graph = current.get()
    met = {holds: guard for holds, guard in graph.looked.items() if holds not in looked}
    end = [lift(graph, np.nan if x is UNBOUND else x) for x in (*last, 0)]
    begin = [none_like(b) if a is UNBOUND else lift(graph, a) for a, b in zip((*first, 0), end, strict=True)]
    like = [a + 0j if b.im is not None else a for a, b in zip(begin, end, strict=True)]
    initial = _parts(begin, like)
    nodes = [graph.state(node) for node in initial]
    for node, *both in zip(nodes, initial, _parts(end, like), strict=True) if graph.draws else ():
        graph.pythons[node] = all(is_pythons(graph, each) for each in both)
    *state, number = _whole(graph, nodes, like)
    now, numbered = graph.looked, graph.numbered
    graph.looked, graph.numbered = {}, {}
    try:
        with _turns_of(_Within(of_any=True)) as within:
            ends, *after = _turned(turn, items, item, number, state)
        made = [lift(graph, x) for x in (*after, number + 1)]
        inside = graph.looked  # what Python sees of other things holds for all turns
        followed = met and free_of(nodes, inside | graph.numbered) and is_condition(ends)
        followed = followed and all(is_there(x, ARRAYS) for x in after)
        numbered |= graph.numbered if followed else {}
    except (Exception, NotRecorded):
        followed = False
    finally:
        graph.looked, graph.numbered = now, numbered
    if not followed or [x.extent for x in made] != [x.extent for x in like]:
        return None
    if any(a.im is not None and b.im is None for a, b in zip(made, like, strict=True)):
        return None
    if silent := isinstance(turn, Turn) and not turn.tells:
        turn = turn.untold  # nobody asks for what is always so
        for each in begin, end, like, made, nodes:  # of which a single number stands behind it
            del each[-2]
        initial = _parts(begin, like)
    graph.looked = looked | inside
    most = None if item is None or isinstance(items, Turns) else len(items)
    loop = Loop(nodes, initial, _parts(made, like), ends.re, most)
    same = reduce(operator.and_, (Quantity(graph, holds) for holds in met))
    ended, state = same, end[:-1]
    if not (outer or within.has_loops):
        ended, state = _in_turns(turn, items, item, _whole(graph, initial, like)[:-1], most) or (ended, state)
    if not outer:
        graph.see(lift(graph, ended).re, turns=True)
    turns = [where(graph, ended, Quantity(graph, node), np.nan).re for node in _parts(state, like[:-1])]
    found = [graph.iterated(loop, k, node) for k, node in enumerate(turns)]
    return (*_whole(graph, found, like[:-1]), *[lift(graph, True)] * silent)


def _turned(turn: Callable[..., Any], items: Any, item: int | None, number: Any, state: list[Quantity]) -> Any:
    """One turn, of that number."""
    if item is None:
        return turn(*state)
    if not isinstance(items, Turns):
        graph = current.get()
        element = lift(graph, items)[number]
        if isinstance(items, range | list | tuple):
            graph.pythons |= dict.fromkeys(element.parts, True)
        return turn(*state[:item], element, *state[item + 1 :])
    ends, *after = turn(*state[:item], items.of(number), *state[item + 1 :])
    return [ends | items.end(number), *after]


def _in_turns(
    turn: Callable[..., Any], items: Any, item: int | None, begin: list[Quantity], most: int | None
) -> tuple[Any, list[Quantity]] | None:
    """Whether a loop has ended after twice as many turns as it takes now and some more, and its state then.

    A turn behind its end changes nothing. None where that would take too many operations, as of an array of which each
    turn sets an element.
    """
    if isinstance(items, Turns) and items.sets:
        return None
    graph, state = begin[0].graph, begin
    now, work, graph.looked = graph.looked, graph.work, {}
    ended, number, count = lift(graph, False), 0, None
    try:
        while number not in (most, count):
            ends, *after = _turned(turn, items, item, number, state)
            state = [where(graph, ended, a, b) for a, b in zip(state, after, strict=True)]
            ended, number = ended | ends, number + 1
            if count is None and ended.value:
                count = 2 * number + _FURTHER
        followed = graph.looked.keys() <= now.keys()
    except (Exception, NotRecorded):
        followed = False
    finally:
        graph.looked, graph.work = now, work
    if not followed:
        return None
    return (True if number == most else ended), state


_FURTHER = 8  # turns


def _parts(values: list[Quantity], like: list[Quantity]) -> list[Node]:
    """Real parts, and imaginary ones where others have them."""
    pairs = zip(values, like, strict=True)
    return [part for x, y in pairs for part in ((x.re,) if y.im is None else (x.re, imaginary(x)))]


def _whole(graph: Graph, parts: list[Node], like: list[Quantity]) -> list[Quantity]:
    rest = iter(parts)
    return [Quantity(graph, next(rest), None if x.im is None else next(rest)) for x in like]


def known(names: dict[str, Any], *wanted: str) -> list[Any]:
    """What some of the ``names`` of a function or a cell are bound to."""
    values = [names.get(name, UNBOUND) for name in wanted]
    if "__builtins__" not in names:  # until Python 3.12 a function keeps what it has told
        names.clear()
    return values


def all_of(function: Any, *parts: Any, **named: Any) -> Any:
    """What ``enumerate`` or ``zip`` gives, as a list where it has an end and nothing else goes through its parts."""
    items = function(*parts, **named)
    return list(items) if function in (enumerate, zip) and all(isinstance(part, Sized) for part in parts) else items


CALLS: dict[str, Any] = {
    "known": known,
    "iterated": iterated,
    "all_of": all_of,
    "counted": counted,
}
