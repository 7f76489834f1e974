"""What Python has an error for, of some inputs: a comparison of it goes neither way there, where one of NaN would."""

import sys
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import reduce
from operator import and_
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import elementwise
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import LEAVES, Node, bottom_up, free_of
from mechsheet.quantities.operations import COMPARISONS
from mechsheet.quantities.quantity import NOTED, Quantity, quantities

_LIBRARY, _NUMPY = str(Path(__file__).parents[1]), str(Path(np.__file__).parent)
_DIVIDING = ("div", "pow", "mod")
_REFUSING = (*_DIVIDING, "exp")
_ARITHMETIC = (*_DIVIDING, "add", "sub", "mul", "neg", "abs", "max", "min", "round")
_WHY = "it needs a number that does not exist for these inputs"
_rows = ContextVar("_rows", default=0)  # how often ways are supposed for all rows, one in another
_told = ContextVar[list[Quantity] | None]("_told", default=None)  # what is noted in the turn of a loop


@contextmanager
def each_row(graph: Graph, rows: Iterable[Node]) -> Iterator[None]:
    """What is computed of each of some rows compares once for all of them what is no row's own, and nothing else."""
    token = _rows.set(_rows.get() + 1)
    try:
        yield
    finally:
        _rows.reset(token)
        own = [holds for holds, guard in graph.looked.items() if guard.why == _WHY and not free_of(rows, [holds])]
        for holds in own:
            del graph.looked[holds]


class Turn:
    """A turn of a loop that also tells, behind its names, whether Python has compared none but numbers up to now."""

    def __init__(self, turn: Callable[..., Any]) -> None:
        self._own, self.tells = turn, False

    def __call__(self, *state: Any) -> list[Any]:
        *names, exists = state
        after, told = self._taken(names)
        self.tells |= bool(told)
        return [*after, reduce(and_, told, exists)]

    def untold(self, *names: Any) -> Any:
        """The turn alone."""
        return self._taken(names)[0]

    def _taken(self, names: Iterable[Any]) -> tuple[Any, list[Quantity]]:
        token = _told.set(told := list[Quantity]())
        try:
            return self._own(*names), told
        finally:
            _told.reset(token)


def refused(value: Any, read: bool = True) -> Any:
    """Numbers for which Python has an error where they are none; of many together nobody knows which it computes.

    It has that at once, whatever is made of them, but for a name that is only bound on other ways and not ``read`` yet.
    """
    for each in _telling(value):
        for part in each.parts if not each.ndim else ():
            _note(each.graph, part, each.graph.fold("finite", part), read)
    return value


def unless(holds: Quantity, value: Any) -> Any:
    """Numbers for which Python has an error where a condition does not hold, once it makes anything of them."""
    for each in _telling(value):
        for part in each.parts:
            each.graph.refused[part] = _all(each.graph, [holds.re, _exists(each.graph, part)])
    return value


def pointed(value: Any, container: Any) -> Any:
    """What computed places in a container point at, for which Python has an error where there are none."""
    own = {part for each in _telling(container) for part in each.parts}
    for each in _telling(value):
        for part in each.parts:
            _note_places(each.graph, part, own)
    return value


def _telling(value: Any) -> Iterator[Quantity]:
    """Quantities of a recording that tells what Python refuses."""
    return (each for each in quantities(value) if each.graph.refuses)


def _note_places(graph: Graph, node: Node, own: Container[Node]) -> None:
    """Those of the source first, on which the others rest."""
    if node.op in ("at", "take") and node not in own:
        source = node.args[0]
        _note_places(graph, source, own)
        if node.op == "at":
            place = Quantity(graph, node.args[1])
            there: Any = (place >= 0) & (place < Quantity(graph, source).count())
            _note(graph, node, there.reduced("all").re)


def _note(graph: Graph, node: Node, exists: Node, at_once: bool = True) -> None:
    if node not in graph.always:
        under = [_exists(graph, operand) for operand in node.operands]
        graph.refused[node] = _all(graph, [exists, *under])
        if graph.bodies and at_once:  # what is made of it is no matter to whom computes others
            _tell(graph, [graph.refused[node]])


def compared(*operands: Quantity) -> None:
    """Note that Python needs what it may have an error for; the cells of a workbook have one themselves."""
    graph = operands[0].graph
    if not graph.refuses:
        return
    _tell(graph, [_exists(graph, part) for x in operands for part in x.parts])


def _tell(graph: Graph, exist: Sequence[Node | None]) -> None:
    """Note conditions under which Python has no error for what it computes now."""
    # Of other ways that are supposed nobody knows here when they are gone.
    if any(exist) and graph.supposed == _rows.get() + sum(not way.value for way in graph.ways):
        for each in (Quantity(graph, node) for node in exist if node):
            if not sure(each):
                note(on_ways(each))


def needed(holds: Quantity, why: str) -> None:
    """Note a condition without which a function that a worksheet calls has an error, whatever is read of its result.

    In the turn of a loop and in an integral it is not known.
    """
    if any(node.op == "state" for node in bottom_up([holds.re], ())):
        return
    there = on_ways(holds)
    if not there.value:
        raise NotRecorded(why)
    note(there, why if holds.graph.refuses else "")  # cells are made for all that is seen


def note(exists: Quantity, why: str = _WHY) -> None:
    """Note that Python has no error where a condition holds, for all that is computed, or in a turn of a loop."""
    sliders = exists.graph.sliders
    if not sliders or sliders.isdisjoint(bottom_up([exists.re], ())):  # which go where the worksheet lets them
        if (told := _told.get()) is not None:
            told.append(exists)
        else:
            exists.graph.see(exists.re, why=why)


def on_ways(holds: Quantity) -> Any:
    """Whether a condition holds, or the ways that are recorded now are not gone."""
    return reduce(lambda held, way: held | elementwise("not")(way), holds.graph.ways, holds)


def sure(holds: Quantity) -> bool:
    """Whether a condition is that of a way that is recorded now."""
    return any(says(way, holds) for way in holds.graph.ways)


def says(way: Quantity, holds: Quantity) -> bool:
    """Whether two conditions are the same one."""
    return _affirmed(way.re) is _affirmed(holds.re)


def _affirmed(node: Node) -> Node:
    while node.op == "not" and node.args[0].op == "not":
        node = node.args[0].args[0]
    return node


def _exists(graph: Graph, node: Node) -> Node | None:
    """The condition under which Python has a number, where it may have an error for it."""
    known = graph.refused
    for each in bottom_up([node], known):
        own = graph.fold("finite", each) if each.op in _REFUSING and is_pythons(graph, each) else None
        if each.value.dtype == bool:  # which compares, and was noted
            known[each] = None
        elif each.op == "where" and not each.args[0].shape:
            holds, *ways = each.args
            then, otherwise = (known[way] or graph.constant(True) for way in ways)
            known[each] = graph.fold("where", holds, then, otherwise) if any(known[w] for w in ways) else None
        else:
            known[each] = _all(graph, [own, *(known[operand] for operand in each.operands)])
    return known[node]


def refusing(graph: Graph) -> list[Node]:
    """What Python has an error for where it is infinite, and has a number of now."""
    made = [node for node in graph.nodes.values() if node.op in _REFUSING and not node.shape]
    return [node for node in made if is_pythons(graph, node) and np.isfinite(node.value)]


def of_python(value: Any) -> Any:
    """Numbers that a function of Python gives."""
    for graph, part in _single(value):
        graph.pythons[part] = True
    return value


def unbounded(value: Any) -> Any:
    """Numbers of a function of Python whose exponentials have an error where they are infinite."""
    for graph, part in _single(value):
        graph.pythons |= {each: True for each in bottom_up([part], graph.pythons) if each.op == "exp"}
    return value


def of_numpy(value: Any) -> Any:
    """Numbers that a function of numpy gives, where the same operation gives none of Python's."""
    for graph, part in _single(value):
        graph.pythons.setdefault(part, False)
    return value


def _single(value: Any) -> Iterator[tuple[Graph, Node]]:
    return ((each.graph, part) for each in quantities(value) if not each.ndim for part in each.parts)


def is_pythons(graph: Graph, node: Node) -> bool:
    """Whether Python's own arithmetic makes a number of inputs: numpy's gives infinity for 1 / 0, Python an error."""
    known = graph.pythons
    for each in bottom_up([node], known):
        made = each.op in _ARITHMETIC or each.value.dtype == bool
        of = each.args[1:] if each.op == "where" else each.operands if made else ()
        known[each] = not each.shape and (each.op in LEAVES or (bool(of) and all(known[operand] for operand in of)))
    return known[node]


def _all(graph: Graph, exist: Iterable[Node | None]) -> Node | None:
    """Whether all conditions hold, each of them once."""
    each = dict.fromkeys(filter(None, exist))
    return reduce(lambda a, b: graph.fold("and", a, b), each) if each else None


def of_library(frame: FrameType) -> bool:
    """Whether a frame runs code of this package, and not of a worksheet."""
    return frame.f_code.co_filename.startswith(_LIBRARY)


def _compared_there(*operands: Quantity) -> None:
    """The same in the code of a worksheet: what the library compares itself says nothing of an error."""
    frame: Any = sys._getframe(2)
    while frame.f_code.co_filename.startswith(_NUMPY):  # of its operators
        frame = frame.f_back
    if not of_library(frame):
        compared(*operands)


NOTED.update(dict.fromkeys(COMPARISONS, _compared_there))
