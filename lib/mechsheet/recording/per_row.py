"""A value for each row, by one formula for all of them: so a comprehension holds for any number of rows."""

from collections.abc import Callable, Collection
from typing import Any

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.text_column import Texts
from mechsheet.readers.replaced import replaced
from mechsheet.recording.choices import way_may_change
from mechsheet.worksheet.lists import Whole


def of_rows(kind: str, f: Callable[..., Any], plainly: Callable[[], Any], *sources: Any) -> Any:
    """The ``sum`` and the like of what ``f`` gives for each row, or all of it as an array.

    ``plainly`` gives what Python makes of them one by one: that is it where ``f`` is no formula of single numbers.
    """
    found = None if way_may_change(f) else _followed(lambda *row: [f(*row)], sources)
    return _whole(kind, found[0]) if found else plainly()


def sums(f: Callable[..., Any], *sources: Any) -> list[Any] | None:
    """Sums of each of the values that ``f`` gives for a row; None where these are no formulas of single numbers."""
    found = None if way_may_change(f) else _followed(f, sources)
    return [_whole("sum", each) for each in found] if found else None


def _followed(f: Callable[..., Any], sources: tuple[Any, ...]) -> list[Quantity] | None:
    """Each of the values that ``f`` gives for a row, for all rows as a whole."""
    if not _are_rows(sources):
        return None
    graph = current.get()
    looked, numbered, work, rows = dict(graph.looked), dict(graph.numbered), graph.work, dict[Node, Node]()
    graph.supposed += 1
    try:
        with graph.labelled({**graph.labels}):
            values = [lift(graph, value) for value in f(*(_row(source, rows) for source in sources))]
            if graph.looked.keys() == looked.keys() and all(_is_formula(each, rows) for each in values):
                return [_of_all(each, rows) for each in values]
    except (Exception, NotRecorded):
        pass
    finally:
        graph.supposed -= 1
    graph.looked, graph.numbered, graph.work = looked, numbered, work
    return None


def _are_rows(sources: tuple[Any, ...]) -> bool:
    """Whether all are columns or tables, with as many rows as the inputs say."""
    columns = [column for source in sources for column in _columns(source)]
    if not columns or not all(isinstance(c, Quantity) and c.ndim == 1 and c.re.stretches for c in columns):
        return False
    return len({c.graph.size(part) for c in columns for part in c.parts}) == 1


def _columns(source: Any) -> list[Any]:
    """A column, or those of a table but for its texts."""
    held = vars(source).values() if isinstance(source, Whole) else (source,)
    return [each for each in held if not isinstance(each, Texts) or each is source]


def _row(source: Any, rows: dict[Node, Node]) -> Any:
    """What stands for any row: the numbers of the first one, of which ``rows`` has the columns."""
    if isinstance(source, Whole):
        row = source[0]
        for name, column in vars(source).items():
            if isinstance(column, Texts):
                object.__delattr__(row, name)  # what reads it is no formula of all rows
            else:
                object.__setattr__(row, name, _row(column, rows))
        return row
    parts = [source.graph.state(part) for part in source.whole()[0].parts]
    rows.update(zip(parts, source.whole().parts, strict=True))
    return Quantity(source.graph, *parts)


def _is_formula(each: Quantity, rows: Collection[Node]) -> bool:
    """Whether all that rests on a row is a single number, made of others and of elements that these point at."""
    made = set(rows)
    for node in bottom_up(each.parts, made):
        if not made.isdisjoint(node.operands):
            read = node.operands[1:] if node.op == "at" and node.args[0] not in made else node.operands
            if node.op not in (*ELEMENTWISE, "at") or any(part.shape for part in (node, *read)):
                return False
            made.add(node)
    return not each.ndim


def _of_all(each: Quantity, rows: dict[Node, Node]) -> Quantity:
    new = replaced(each.graph, each.parts, rows)
    column = Quantity(each.graph, next(iter(rows.values())))
    return each.each(lambda part: new.get(part, part)).like(column)


def _whole(kind: str, each: Quantity) -> Any:
    if kind in ("any", "all"):
        return (each if each.dtype == bool else each != 0).reduced(kind)
    return each if kind == "array" else each.reduced(kind)


CALLS: dict[str, Any] = {"of_rows": of_rows, "sums": sums}
