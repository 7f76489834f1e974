"""What Python decides by itself, for recorded quantities: which of two numbers, which element, the greater of some."""

import operator
from collections.abc import Callable
from copy import copy
from functools import partial, reduce
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities import perhaps
from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.arithmetic import elementwise, none_like, trunc, whole
from mechsheet.quantities.arithmetic import is_whole as whole_number
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.of_lists import OneOfLists
from mechsheet.quantities.operations import is_double, regrouped
from mechsheet.quantities.options import Fields, Row, Thing, changed, every, is_object, parted
from mechsheet.quantities.quantity import Listed, Quantity, has_quantity, is_any_length, lift
from mechsheet.quantities.refused import compared, pointed, refused, says, unless
from mechsheet.quantities.selected import Selected, of_each
from mechsheet.quantities.sketch import Sketch
from mechsheet.quantities.sketch import merged as merged_sketch
from mechsheet.quantities.text_column import Texts, among, held_in
from mechsheet.quantities.written import Either, OneOf, Written, either, said, text
from mechsheet.recording import exactly
from mechsheet.recording.memory import before_ways, content, may_change, one_of, stands_for_others, taken
from mechsheet.recording.raised import Refused, on_way, only
from mechsheet.recording.sifted import Sifted, joined_kept
from mechsheet.worksheet.chosen import Chosen, cases
from mechsheet.worksheet.lists import Whole, first_column

NUMBERS = int | float | complex | np.number | Quantity
ARRAYS = NUMBERS | np.bool_ | np.ndarray
_ROWS = 200  # of a table at which a quantity points
_DEEPEST = 8  # ways in one another that are recorded though Python does not take them


class _Unbound:
    """Stands for what a name has before it is bound."""


UNBOUND = _Unbound()
_NOTHING = Written(())  # what is said where there is no text


def is_condition(value: Any) -> bool:
    """Whether a single recorded condition or number."""
    return isinstance(value, Quantity) and value.single and value.im is None and value.re.op != "constant"


def as_condition(value: Any) -> Any:
    """Whether a list of those that are kept has any, or what may be None is there and not 0; all else as it is."""
    if isinstance(value, perhaps.Number):
        return value.some & (perhaps.itself(value) != 0)
    if isinstance(value, perhaps.Row) and not isinstance(held := perhaps.itself(value), Written):
        return perhaps.some_of(value) if held else value
    return value.some if isinstance(value, Sifted) and value.pairs else value


def choice(condition: Any, x: FunctionType, y: FunctionType, *given: Any) -> Any:
    """What ``x`` or else ``y`` gives: of numbers those that the condition says, else those of the way that is taken.

    The way that is not taken is run too, where it changes nothing; it need not exist with these numbers.
    """
    return _chosen(condition, x, y, *given)


def _chosen(condition: Any, x: Callable[..., Any], y: Callable[..., Any], *given: Any, **named: Any) -> Any:
    condition = as_condition(condition)
    if not is_condition(condition):
        return (x if condition else y)(*given, **named)
    compared(condition)
    graph, (now, later) = condition.graph, (x, y) if condition.value else (y, x)
    before = before_ways(now, later, *given, *named.values())
    looked, holds, both, other = dict(graph.looked), bool(condition.value), None, UNBOUND
    try:
        value = on_way(condition, holds, now, *given, **named)
    except Refused:  # of a way that leads here is only supposed that it is gone
        if before.changed() or way_may_change(later):
            raise
        graph.looked = looked
        value = on_way(condition, not holds, later, *given, **named)
        only(condition, not holds)
        return value
    looked = dict(graph.looked)
    if graph.supposed < _DEEPEST and not before.changed() and not way_may_change(later):
        graph.supposed += 1
        try:
            other = on_way(condition, not holds, later, *given, **named)
            both = merged(condition, *((value, other) if holds else (other, value)))
        except Refused:
            graph.looked, both = looked, value
            only(condition, holds)
        except (Exception, NotRecorded):
            both = None
        finally:
            graph.supposed -= 1
        if before.changed():
            raise NotRecorded("the way that is not taken changes something")
    if both is None:
        graph.looked = looked
        if value is not None or other is not None:
            bool(condition)
            if all(isinstance(x, np.ndarray | Quantity) and x.ndim and is_double(x.dtype) for x in (value, other)):
                return one_of(copy(lift(graph, value)), value, other)
            taken(value, *(before.values() if other is UNBOUND else [other]))
        return value
    return both


def merged(condition: Quantity, x: Any, y: Any) -> Any:
    """``x`` where the condition holds, else ``y``; None where these are not of one kind."""
    if x is y:
        return x
    if x is None or y is None or isinstance(x, perhaps.Perhaps) or isinstance(y, perhaps.Perhaps):
        return _perhaps(condition, x, y)
    if (x if condition.value else y) is UNBOUND and not condition.graph.supposed:
        return UNBOUND
    if x is UNBOUND or y is UNBOUND:
        x, y = _bound(x, y), _bound(y, x)
        return None if x is UNBOUND or y is UNBOUND else refused(merged(condition, x, y), read=False)
    alike = {type(x), type(y)} <= {list, OneOfLists} or (type(x) is type(y) and isinstance(x, tuple | list))
    if alike and len(x) == len(y):
        parts = [part_of(condition, a, b) for a, b in zip(x, y, strict=True)]
        if all(part is not None for part in parts):
            part = partial(part_of, condition)
            return OneOfLists(parts, condition.graph.meant, part, x, y) if isinstance(x, list) else regrouped(x, parts)
    if isinstance(x, Sketch) and isinstance(y, Sketch):
        return merged_sketch(condition, x, y)
    if _are_written(x, y):
        return either(condition, x, y)
    if (each := of_each(lambda a, b: where(condition.graph, condition.reshape(()), a, b), x, y)) is not None:
        return each
    if isinstance(x, ARRAYS) and isinstance(y, ARRAYS) and _lengths(x) == _lengths(y):
        return one_of(where(condition.graph, condition.reshape(()), x, y), x, y)
    if isinstance(x, FunctionType | np.poly1d) and isinstance(y, FunctionType | np.poly1d):
        return lambda *given, **named: _chosen(condition, x, y, *given, **named)
    return parted(partial(_part_of, condition), x, y)


def _perhaps(condition: Quantity, x: Any, y: Any) -> Any:
    """The same of values that may be None; conditions that may be are not followed."""
    if x is UNBOUND or y is UNBOUND:
        return None
    ways = [_missing(perhaps.itself(b)) if a is None else perhaps.itself(a) for a, b in ((x, y), (y, x))]
    both = None if any(a is UNBOUND or _is_truth(a) for a in ways) else merged(condition, *ways)
    if both is None:
        return None
    truth = condition.reshape(()) if condition.dtype == bool else condition.reshape(()) != 0
    some = [
        says(way, holds) or holds if isinstance(holds := perhaps.some_of(a), Quantity) else holds
        for way, a in ((truth, x), (elementwise("not")(truth), y))
    ]
    if all(holds is True for holds in some):
        return both
    there = where(condition.graph, truth, *some)
    return (perhaps.Number if isinstance(both, Quantity) else perhaps.Row)(there, unless(there, both))


def _is_truth(value: Any) -> bool:
    return isinstance(value, bool | np.bool_) or (isinstance(value, Quantity) and value.dtype == bool)


def _part_of(condition: Quantity, x: Any, y: Any) -> Any:
    """A part of ``x`` or else the same of ``y``: of texts which one once Python looks, of all else which one now."""
    both = part_of(condition, x, y)
    return both if both is not None else x if condition else y


def part_of(condition: Quantity, x: Any, y: Any) -> Any:
    """The same; None where Python has to look now."""
    both = merged(condition, x, y)
    if both is not None:
        return both
    x, y = _bound(x, y), _bound(y, x)
    return either(condition, x, y) if isinstance(x, str | Written) and isinstance(y, str | Written) else None


def _bound(value: Any, other: Any) -> Any:
    """A value, or what stands for one on a way that has none."""
    return _missing(other) if value is UNBOUND else value


def _are_written(x: Any, y: Any) -> bool:
    """Whether two texts: Python sees which one it is once it reads it."""
    return isinstance(x, str | Written) and isinstance(y, str | Written)


def _lengths(value: Any) -> tuple[Any, ...]:
    """The shape, with the nodes of lengths that follow a number of rows."""
    lengths = value.shape if isinstance(value, Quantity) else np.shape(value)
    return tuple(n.re if isinstance(n, Quantity) else n for n in lengths)


def _missing(value: Any) -> Any:
    """What stands for a number on a way where the worksheet has none, or for a text."""
    if value is None:
        return None
    if isinstance(value, str | Written):
        return _NOTHING
    if isinstance(value, tuple | list):
        return _noted(regrouped(value, map(_missing, value)))
    if isinstance(value, Row | Fields | Thing):
        return changed(_missing, value)
    if isinstance(value, dict):
        return _noted({key: _missing(part) for key, part in value.items()})
    if is_object(value):
        kind: Any = type(value)
        new = kind.__new__(kind)  # a copy would leave a mark in its class
        vars(new).update((name, _missing(part)) for name, part in vars(value).items())
        return _noted(new)
    if isinstance(value, Quantity):
        return none_like(value)
    if isinstance(value, FunctionType):
        return lambda *given, **named: _missing(value(*given, **named))
    none = complex(np.nan, np.nan) if np.iscomplexobj(value) else np.nan
    return np.full(np.shape(value), none) if isinstance(value, ARRAYS) else UNBOUND


def _noted(missing: Any) -> Any:
    current.get().meant.missing[id(missing)] = missing
    return missing


def way_may_change(f: Callable[..., Any]) -> bool:
    """Whether a way that is not taken may change something in place."""
    if not isinstance(f, FunctionType):
        return False
    inner = [g for cell in f.__closure__ or () for g in content(cell) if isinstance(g, FunctionType)]
    if stands_for_others(f):
        return any(way_may_change(g) for g in inner if g is not f)
    return may_change([f.__code__, *(g.__code__ for g in inner)], f.__globals__)


def element(container: Any, key: Any) -> Any:
    """``container[key]``: where the key is a quantity, the one of several numbers that it points at."""
    if isinstance(key, perhaps.Row):
        key = perhaps.settled(key) if None in container else perhaps.there(key)
    if isinstance(container, Row) and not isinstance(key, str):
        container = {known: container[known] for known in every(container)[0]}
    if isinstance(container, dict) and (is_it := _each(key)):
        return _of_option(container, key, is_it)
    if isinstance(key, Written) and isinstance(container, dict):
        if key.now not in container:
            return container[str(key)]  # some dictionaries give what is missing: Python looks which text it is
        return _supposed(_of_text, container, key)
    if isinstance(key, tuple) and isinstance(container, np.ndarray) and has_quantity(key):
        return _pointed(lift(current.get(), container), key)
    if not isinstance(key, Quantity) or isinstance(container, Quantity | Whole | Texts | Listed):
        return _pointed(container, key)
    if isinstance(container, np.ndarray) and (held := held_in(key.graph, container, key.ndim > 0)) is not None:
        return _pointed(held, key)
    values = container if isinstance(container, dict) else dict(enumerate(container))
    row = None
    if key.single and isinstance(container, list | tuple):  # whose last element is that of -1
        key = where(key.graph, key < 0, key + len(container), key)
    if key.single and all(isinstance(known, NUMBERS) for known in values):
        if not any(key.value == known for known in values):
            if isinstance(container, dict):
                return container[key.seen().item()]  # as above
            raise IndexError(f"no element {key.value}")
        if all(map(is_there, values.values())):
            return refused(one_of(_at_key(values, key, np.nan), *values.values()))
        row = _row_at(values, key)
    if row is not None:
        return refused(row)
    seen = key.seen()
    if seen.size != 1:
        return container[seen]
    return taken(container[int(seen.item()) if isinstance(container, list | tuple) else seen.item()], container)


def is_there(value: Any, kinds: Any = NUMBERS) -> bool:
    """Whether a number of some kinds, and None for no inputs."""
    return isinstance(value, kinds) and not isinstance(value, perhaps.Number)


def _row_at(values: dict[Any, Any], key: Quantity) -> Any:
    """The row at a key that is one of several now; None of what is no row."""
    (now,) = (value for known, value in values.items() if key.value == known)
    if len(values) <= _ROWS:
        row = now
        for known, value in values.items():
            if value is not now:  # which is meant where no other one is
                row = None if row is None else part_of(key == known, value, row)
        if row is not None:
            key.graph.see(reduce(operator.or_, (key == known for known in values)).re)
            return row
    return None


def _supposed(f: Callable[..., Any], *given: Any) -> Any:
    """What a function makes of ways that Python does not take: what these alone have is kept."""
    graph = current.get()
    graph.supposed += 1
    try:
        return f(*given)
    finally:
        graph.supposed -= 1


def _of_text(container: dict[Any, Any], key: Written) -> Any:
    """``container[key]`` of a text that is one of several."""
    match key.parts:
        case (Either(holds, then, otherwise),):
            ways = (_of_text(container, way) if way.parts else UNBOUND for way in (then, otherwise))
            return _part_of(holds, *ways)
    return container.get(str(key), UNBOUND)


def _pointed(container: Any, key: Any) -> Any:
    """``container[key]``, which Python refuses where a single place is none; of many, only some may be looked at."""
    places = [k for k in (key if isinstance(key, tuple) else [key]) if isinstance(k, Quantity)]
    found = container[key]
    return pointed(found, container) if places and all(k.single for k in places) else found


def _at_key(values: dict[Any, Any], key: Quantity, otherwise: Any) -> Any:
    result = otherwise
    for known, value in values.items():
        result = where(key.graph, key == known, value, result)
    return result


def got(container: Any, key: Any, *otherwise: Any) -> Any:
    """``container.get(key, otherwise)``, where the key may be a quantity, a chosen option or a text of it."""
    if isinstance(container, dict) and (is_it := _each(key)):
        return _of_option({option: container.get(option, *otherwise) for option in is_it}, key, is_it)
    texts = among(current.get(), key) if isinstance(container, dict) and isinstance(key, Written) else None
    if texts is not None:
        return element({each: container.get(each, *otherwise) for each in texts[0]}, key)
    default = otherwise[0] if otherwise else None
    known = isinstance(container, dict) and isinstance(key, Quantity) and key.single
    if known and all(map(is_there, (*container, *container.values(), default))):
        return _at_key(container, key, default)
    if known and all(isinstance(each, NUMBERS) for each in container):
        result = default
        for n, (each, value) in enumerate(container.items()):
            result = None if n and result is None else part_of(key == each, value, result)
        if result is not None:
            return result
    return container.get(key.seen().item() if isinstance(key, Quantity) else key, *otherwise)


def _each(key: Any) -> dict[str, Any]:
    """Whether each option is the chosen one, or has its text, by that name; none of any other key."""
    match key:
        case Chosen():
            known = cases(key)
            return known if all(map(is_condition, known.values())) else {}  # where it is that of these inputs alone
        case Written((OneOf(_, texts, None),)):
            return {text: key == text for text in dict.fromkeys(texts)}
    return {}


def _of_option(container: dict[Any, Any], key: Any, is_it: dict[str, Any]) -> Any:
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


def is_whole(values: Any) -> bool:
    """Whether there is no telling how many numbers these are for other inputs."""
    return isinstance(values, Selected) or is_any_length(values)


def total(values: Any, start: Any = 0) -> Any:
    """Python's sum."""
    if isinstance(values, Sifted) and values.pairs:
        return values.of("sum", start)
    return values.reduced("sum") + start if is_whole(values) else exactly.added(values, start)


def _number(kind: type, followed: Callable[..., Any]) -> Callable[..., Any]:
    """A number of Python's made of a quantity, or read out of a text, which Python looks at for it."""

    def made(*given: Any) -> Any:
        given = tuple(str(x) if isinstance(x, Written) else x for x in given)
        return followed(*given) if has_quantity(given) else kind(*given)

    return made


def _as_float(x: Quantity) -> Any:
    """What arrays take for no whole number, and a text shows with decimals."""
    return x.astype(float) if x.dtype == bool or whole_number(x) else x


def length(x: Any) -> Any:
    """``len`` of anything; of a quantity over rows, and of a table of them, it is one."""
    if isinstance(x, Sifted) and x.pairs:
        return x.of("len")
    first = first_column(x) if isinstance(x, Whole) else x.at if isinstance(x, Texts) else x
    if type(first) is Quantity:
        first.graph.ask_rows(first.re)
    return first.count(0) if isinstance(first, Quantity) and first.ndim else len(x)


def _power(x: Any, y: Any, *modulus: Any) -> Any:
    if not has_quantity((x, y, *modulus)):
        return exactly.powered(x, y, *modulus)
    if modulus:
        raise NotRecorded("pow with a modulus")
    return x**y


CALLS: dict[str, Any] = {
    "choice": choice, "said": said, "element": element, "get": got,
    "len": length,
    "unbound": UNBOUND, "text": text, "join": joined_kept,
    "round": exactly.rounded,
    "float": _number(float, _as_float), "int": _number(int, lambda x: whole(trunc(x))),
    "complex": _number(complex, lambda *x: sum(a * b for a, b in zip(x, (1, 1j), strict=False))),
    "pow": _power,
}  # fmt: skip
