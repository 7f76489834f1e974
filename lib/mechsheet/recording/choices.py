"""What Python decides by itself, for recorded quantities: which of two numbers, which element, the greater of some."""

import builtins
import operator
from collections.abc import Callable, Iterable, Mapping
from functools import partial, reduce
from itertools import repeat
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.recording.arithmetic import choice as where
from mechsheet.recording.arithmetic import elementwise, imaginary, trunc
from mechsheet.recording.graph import Graph, Guard, NotRecorded, current
from mechsheet.recording.memory import Memory, may_change, names_of
from mechsheet.recording.node import Loop, Node
from mechsheet.recording.options import parted
from mechsheet.recording.quantity import Quantity, has_quantity, is_any_length, lift
from mechsheet.recording.selected import Selected
from mechsheet.recording.sketch import Sketch
from mechsheet.recording.sketch import merged as merged_sketch
from mechsheet.recording.written import Written, either, text
from mechsheet.worksheet.drawing import COLOURS
from mechsheet.worksheet.kinds import Chosen, cases

_NUMBERS = int | float | complex | np.number | Quantity
_ARRAYS = _NUMBERS | np.bool_ | np.ndarray
_DEEPEST = 8  # ways in one another that are recorded though Python does not take them


class _Unbound:
    """Stands for what a name has before it is bound."""


UNBOUND = _Unbound()


def is_condition(value: Any) -> bool:
    """Whether a single recorded condition or number."""
    return isinstance(value, Quantity) and value.single and value.im is None and value.re.op != "constant"


def choice(condition: Any, x: FunctionType, y: FunctionType, *given: Any) -> Any:
    """What ``x`` or else ``y`` gives: of numbers those that the condition says, else those of the way that is taken.

    The way that is not taken is run too, where it changes nothing; it need not exist with these numbers.
    """
    return _chosen(condition, x, y, *given)


def _chosen(condition: Any, x: Callable[..., Any], y: Callable[..., Any], *given: Any, **named: Any) -> Any:
    if not is_condition(condition):
        return (x if condition else y)(*given, **named)
    graph, (now, later) = condition.graph, (x, y) if condition.value else (y, x)
    own = next((f.__globals__ for f in (now, later) if isinstance(f, FunctionType)), {})
    before = Memory([*_reached(now), *_reached(later), *given, *named.values()], own)
    value, both = now(*given, **named), None
    looked = dict(graph.looked)
    if graph.supposed < _DEEPEST and not before.changed() and not way_may_change(later):
        graph.supposed += 1
        try:
            other = later(*given, **named)
            both = merged(condition, *((value, other) if condition.value else (other, value)))
        except (Exception, NotRecorded):
            both = None
        finally:
            graph.supposed -= 1
        if before.changed():
            raise NotRecorded("the way that is not taken changes something")
    if both is None:
        graph.looked = looked
        bool(condition)
        return value
    return both


def merged(condition: Quantity, x: Any, y: Any) -> Any:
    """``x`` where the condition holds, else ``y``; None where these are not of one kind."""
    if x is y:
        return x
    if (x if condition.value else y) is UNBOUND:
        return UNBOUND
    x, y = _missing(y) if x is UNBOUND else x, _missing(x) if y is UNBOUND else y
    if type(x) is type(y) and isinstance(x, tuple | list) and len(x) == len(y):
        parts = [merged(condition, a, b) for a, b in zip(x, y, strict=True)]
        return None if any(part is None for part in parts) else _made_like(x, parts)
    if isinstance(x, Sketch) and isinstance(y, Sketch):
        return merged_sketch(condition, x, y)
    if condition.graph.draws and _are_written(x, y):
        return either(condition, x, y)
    if isinstance(x, _ARRAYS) and isinstance(y, _ARRAYS) and _lengths(x) == _lengths(y):
        return where(condition.graph, condition.reshape(()), x, y)
    if isinstance(x, FunctionType | np.poly1d) and isinstance(y, FunctionType | np.poly1d):
        return lambda *given, **named: _chosen(condition, x, y, *given, **named)
    return parted(partial(_part_of, condition), x, y)


def _part_of(condition: Quantity, x: Any, y: Any) -> Any:
    """A part of ``x`` or else the same of ``y``: of what is no number that which is meant now."""
    both = merged(condition, x, y)
    return both if both is not None else x if condition else y


def _made_like(row: tuple[Any, ...] | list[Any], parts: Iterable[Any]) -> Any:
    """A tuple, a named one or a list of other parts."""
    return getattr(type(row), "_make", type(row))(parts)


def _are_written(x: Any, y: Any) -> bool:
    """Whether two texts with numbers in them, or two colours: of any other text Python sees which one it is."""
    if isinstance(x, Written) or isinstance(y, Written):
        return isinstance(x, str | Written) and isinstance(y, str | Written)
    return isinstance(x, str) and isinstance(y, str) and {x, y} <= {"", *COLOURS}


def _lengths(value: Any) -> tuple[Any, ...]:
    """The shape, with the nodes of lengths that follow a number of rows."""
    lengths = value.shape if isinstance(value, Quantity) else np.shape(value)
    return tuple(n.re if isinstance(n, Quantity) else n for n in lengths)


def _missing(value: Any) -> Any:
    """What stands for a number on a way where the worksheet has none; for a text, which is of no use there, itself."""
    if isinstance(value, str | Written):
        return value
    if isinstance(value, tuple | list):
        return _made_like(value, map(_missing, value))
    if isinstance(value, Quantity):
        return lift(value.graph, np.nan).like(value)
    return np.full(np.shape(value), np.nan) if isinstance(value, _ARRAYS) else UNBOUND


def _reached(f: Callable[..., Any]) -> list[Any]:
    """What a function reads, but for its arguments."""
    if not isinstance(f, FunctionType):
        return [f]
    return [f.__closure__, *(f.__globals__.get(name) for name in names_of(f.__code__))]


def way_may_change(f: Callable[..., Any]) -> bool:
    """Whether a way that is not taken may change something in place."""
    if not isinstance(f, FunctionType):
        return False
    inner = [c.cell_contents for c in f.__closure__ or () if isinstance(c.cell_contents, FunctionType)]
    return may_change([f.__code__, *(g.__code__ for g in inner)], f.__globals__)


def iterated(turn: FunctionType, items: Any, item: int | None, *state: Any) -> Any:
    """What the names of a loop are in the end; ``turn`` tells whether it ends, and what they are after it.

    The name number ``item`` is the next one of the ``items``. Where a quantity decides about the end, readers repeat
    the turns for the inputs that they have.
    """
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
    rest = items if item is None else items[number:]
    if item is not None and rest and all(isinstance(row, tuple | list) for row in rest):
        rest, first, last = _rows(rest), _with_row(first, item), _with_row(state, item)
        return _repeated(turn, rest, item, first, last, looked) or state
    return _repeated(turn, rest, item, first, state, looked) or state


def _with_row(state: tuple[Any, ...], item: int) -> tuple[Any, ...]:
    return tuple(_rows(x) if n == item else x for n, x in enumerate(state))


def _rows(rows: Any) -> Any:
    """Rows of numbers as an array, which any of them can be taken of; others as they are."""
    numbers = (int, float)
    each = rows if isinstance(rows[0], tuple | list) else [rows]
    alike = all(len(row) == len(each[0]) and all(isinstance(x, numbers) for x in row) for row in each)
    return np.array(rows) if alike else rows


def _repeated(
    turn: FunctionType,
    items: Any,
    item: int | None,
    first: tuple[Any, ...],
    last: tuple[Any, ...],
    looked: dict[Node, Guard],
) -> tuple[Any, ...] | None:
    """What a loop gives however many turns it takes, by one from whatever state; None where that has no such form.

    ``looked`` are the guards before any that tell how many turns it takes now.
    """
    if not all(isinstance(x, _ARRAYS) or x is UNBOUND for x in first) or not all(isinstance(x, _ARRAYS) for x in last):
        return None
    graph = current.get()
    met = {holds: guard for holds, guard in graph.looked.items() if holds not in looked}
    end = [lift(graph, x) for x in (*last, 0)]
    begin = [
        lift(graph, np.nan).like(b) if a is UNBOUND else lift(graph, a) for a, b in zip((*first, 0), end, strict=True)
    ]
    like = [a + 0j if b.im is not None else a for a, b in zip(begin, end, strict=True)]
    initial = _parts(begin, like)
    nodes = [graph.state(node) for node in initial]
    *state, number = _whole(graph, nodes, like)
    now, graph.looked = graph.looked, {}
    try:
        if item is not None:
            state[item] = lift(graph, items)[number]
        ends, *after = turn(*state)
        made = [lift(graph, x) for x in (*after, number + 1)]
        followed = met and not graph.looked and is_condition(ends)
    except (Exception, NotRecorded):
        followed = False
    finally:
        graph.looked = now
    if not followed or [x.extent for x in made] != [x.extent for x in like]:
        return None
    if any(a.im is not None and b.im is None for a, b in zip(made, like, strict=True)):
        return None
    graph.looked = looked
    most = None if item is None else len(items)
    loop = Loop(nodes, initial, _parts(made, like), ends.re, most)
    same = reduce(operator.and_, (Quantity(graph, holds) for holds in met))
    ended, state = _in_turns(turn, items, item, _whole(graph, initial, like)[:-1], most) or (same, end[:-1])
    graph.see(lift(graph, ended).re, turns=True)
    turns = [where(graph, ended, Quantity(graph, node), np.nan).re for node in _parts(state, like[:-1])]
    found = [graph.iterated(loop, k, node) for k, node in enumerate(turns)]
    return tuple(_whole(graph, found, like[:-1]))


def _in_turns(
    turn: FunctionType, items: Any, item: int | None, begin: list[Quantity], most: int | None
) -> tuple[Any, list[Quantity]] | None:
    """Whether a loop has ended after twice as many turns as it takes now and some more, and its state then.

    A turn behind its end changes nothing. None where that would take too many operations.
    """
    graph, state = begin[0].graph, begin
    now, work, graph.looked = graph.looked, graph.work, {}
    ended, number, count = lift(graph, False), 0, None
    try:
        while number not in (most, count):
            if item is not None:
                state[item] = where(graph, ended, state[item], lift(graph, items)[number])
            ends, *after = turn(*state)
            state = [where(graph, ended, a, b) for a, b in zip(state, after, strict=True)]
            ended, number = ended | ends, number + 1
            if count is None and ended.value:
                count = 2 * number + _FURTHER
        looked = bool(graph.looked)
    except (Exception, NotRecorded):
        looked = True
    finally:
        graph.looked, graph.work = now, work
    if looked:
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


def known(names: Mapping[str, Any], *wanted: str) -> list[Any]:
    """What some names are bound to."""
    return [names.get(name, UNBOUND) for name in wanted]


def both(*parts: FunctionType) -> Any:
    """``x and y``: of conditions whether all hold."""
    return _all(parts, True)


def any_of(*parts: FunctionType) -> Any:
    """``x or y``."""
    return _all(parts, False)


def _all(parts: tuple[FunctionType, ...], wanted: bool) -> Any:
    value = parts[0]()
    for part in parts[1:]:
        if is_condition(value):
            value = choice(value, part, _given(value)) if wanted else choice(value, _given(value), part)
        elif bool(value) is wanted:
            value = part()
        else:
            return value
    return value


def _given(value: Any) -> Any:
    return lambda: value


def negated(value: Any) -> Any:
    return (
        elementwise("not")(value != 0 if value.re.value.dtype != bool else value) if is_condition(value) else not value
    )


def matched(value: Any) -> Any:
    """A value that is compared with True and False themselves, which no quantity is."""
    if isinstance(value, tuple | list) and has_quantity(value):
        return type(value)(map(matched, value))
    return bool(value) if is_condition(value) and value.re.value.dtype == bool else value


def element(container: Any, key: Any) -> Any:
    """``container[key]``: where the key is a quantity, the one of several numbers that it points at."""
    if isinstance(key, Chosen) and isinstance(container, dict):
        return _of_option(container, key, cases(key))
    if isinstance(key, tuple) and isinstance(container, np.ndarray) and has_quantity(key):
        return lift(current.get(), container)[key]
    if not isinstance(key, Quantity) or isinstance(container, Quantity):
        return container[key]
    if isinstance(container, np.ndarray) and container.dtype.kind in "biufc":
        return lift(key.graph, container)[key]
    values = container if isinstance(container, dict) else dict(enumerate(container))
    if not key.single or not all(isinstance(v, _NUMBERS) for v in (*values, *values.values())):
        seen = key.seen()
        return container[seen.item() if seen.size == 1 else seen]
    if not any(key.value == known for known in values):
        raise KeyError(key.value.item()) if isinstance(container, dict) else IndexError(f"no element {key.value}")
    return _at_key(values, key, np.nan)


def _at_key(values: dict[Any, Any], key: Quantity, otherwise: Any) -> Any:
    result = otherwise
    for known, value in values.items():
        result = where(key.graph, key == known, value, result)
    return result


def got(container: Any, key: Any, *otherwise: Any) -> Any:
    """``container.get(key, otherwise)``, where the key may be a quantity or a chosen option."""
    if isinstance(container, dict) and isinstance(key, Chosen):
        is_it = cases(key)
        return _of_option({option: container.get(option, *otherwise) for option in is_it}, key, is_it)
    known = isinstance(container, dict) and isinstance(key, Quantity) and key.single and otherwise
    if known and all(isinstance(v, _NUMBERS) for v in (*container, *container.values(), *otherwise)):
        return _at_key(container, key, *otherwise)
    return container.get(key.seen().item() if isinstance(key, Quantity) else key, *otherwise)


def _of_option(container: dict[Any, Any], key: Chosen, is_it: dict[str, Any]) -> Any:
    """``container[key]`` of a chosen option: numbers, rows of them and functions of all options, else what is now."""
    rows = {option: container[option] for option in is_it if option in container}
    if any(condition.value and option not in rows for option, condition in is_it.items()):
        return container[key]
    of_some, *others = rows
    result = rows[of_some]
    for option in others:
        result = merged(is_it[option], rows[option], result)
        if result is None:
            return container[key]
    if len(rows) < len(is_it):  # there is no number for the others
        holds = reduce(operator.or_, (is_it[option] for option in rows))
        result = merged(holds, result, _missing(result))
    return container[key] if result is None else result


def handled(error: BaseException) -> None:
    """An exception that the worksheet handles may be one of recorded quantities alone."""
    raise NotRecorded(f"it handles an error ({error!r})")


def _is_whole(values: Any) -> bool:
    """Whether there is no telling how many numbers these are for other inputs."""
    return isinstance(values, Selected) or is_any_length(values)


def _extreme(name: str) -> Callable[..., Any]:
    fold = {"max": np.maximum, "min": np.minimum}[name]

    def function(*args: Any, **kwargs: Any) -> Any:
        if len(args) == 1 and not kwargs and _is_whole(args[0]):
            return args[0].reduced(name)
        values = list(args[0]) if len(args) == 1 and isinstance(args[0], Iterable) else list(args)
        if kwargs or not has_quantity(values):
            return getattr(builtins, name)(*args if len(args) > 1 else [values], **kwargs)
        result = values[0]
        for value in values[1:]:
            result = fold(result, value)
        return result

    return function


def ranked(values: Iterable[Any], *, reverse: Any = False, **given: Any) -> Any:
    """Python's sorted."""
    each = list(values)
    if given or not has_quantity(each) or not all(isinstance(v, _NUMBERS) for v in each):
        return sorted(each, reverse=reverse, **given)
    found: Any = np.sort(lift(current.get(), each))
    return list(found)[::-1] if reverse else list(found)


def total(values: Any, start: Any = 0) -> Any:
    """Python's sum."""
    return values.reduced("sum") + start if _is_whole(values) else sum(values, start)


CALLS: dict[str, Any] = {
    "choice": choice, "and": both, "or": any_of, "not": negated, "matched": matched, "element": element, "get": got,
    "handled": handled,
    "len": lambda x: x.count(0) if isinstance(x, Quantity) and x.ndim else len(x), "known": known,
    "iterated": iterated, "unbound": UNBOUND, "text": text,
    "max": _extreme("max"), "min": _extreme("min"), "round": round, "sorted": ranked,
    "float": lambda *x: x[0] if has_quantity(x) else float(*x),
    "int": lambda *x: trunc(x[0]) if has_quantity(x) else int(*x),
    "complex": lambda *x: sum(a * b for a, b in zip(x, (1, 1j), strict=False)) if has_quantity(x) else complex(*x),
    "pow": lambda *x: x[0] ** x[1] if has_quantity(x) else pow(*x),
}  # fmt: skip
