"""A value for each row, by one formula for all of them: so a comprehension holds for any number of rows."""

from collections.abc import Callable, Collection, Sequence
from typing import Any

import numpy as np

from mechsheet.quantities import perhaps
from mechsheet.quantities.arithmetic import as_count
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.node import Node, bottom_up, free_of
from mechsheet.quantities.operations import ELEMENTWISE, regrouped
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.refused import each_row
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.text_column import Texts, among
from mechsheet.quantities.written import OneOf, Written
from mechsheet.readers.replaced import replaced
from mechsheet.recording.choices import way_may_change
from mechsheet.worksheet.lists import Whole


def of_rows(kind: str, f: Callable[..., Any], plainly: Callable[..., Any], *sources: Any) -> Any:
    """The ``sum`` and the like of what ``f`` gives for each row, or all of it as an array.

    ``plainly`` gives what Python makes of them one by one: that is it where ``f`` is no formula of single numbers.
    """
    found = None if way_may_change(f) else _followed(lambda *row: [f(*row)], sources, _numbers)
    if found:
        return _whole(kind, found[0])
    texts = columns(f, *sources) if kind == "array" and current.get().draws else None
    return texts if isinstance(texts, Texts) else plainly(*sources)


def each_of(f: Callable[..., Any], *sources: Any) -> list[Quantity] | None:
    """Columns of each of the values that ``f`` gives for a row; None where these are no formulas of single numbers."""
    found: list[Quantity] | None = None if way_may_change(f) else _followed(f, sources, _numbers)
    return found


def columns(f: Callable[..., Any], *sources: Any) -> Any:
    """What ``f`` gives for a row, for all rows as a whole, in their form: a number is a column, a row its table.

    None where it rests on more than single numbers of the row, as on what its texts are.
    """
    return None if way_may_change(f) else _followed(f, sources, _in_their_form)


class Together:
    """Columns of the parts of a tuple or a list that there is for each row."""

    def __init__(self, parts: Any) -> None:
        self.parts = parts

    def __getitem__(self, row: Any) -> Any:
        found = regrouped(self.parts, [part[row] for part in self.parts])
        return Together(found) if isinstance(row, slice) or np.ndim(row) else found


class Numbers:
    """The number of each row, of any one that Python knows a whole number of its own."""

    def __init__(self, column: Quantity, of: Callable[[Any], Any]) -> None:
        """``of`` makes the number of that of a row, counted from 0."""
        self.column, self.of = column, of

    def __getitem__(self, row: Any) -> Any:
        number = self.of(row if isinstance(row, int) and 0 <= row < self.column.extent[0] else self.column[row])
        if isinstance(number, Quantity):
            number.graph.whole.update(number.parts)
        return number


def _followed(f: Callable[..., Any], sources: tuple[Any, ...], made: Callable[..., Any]) -> Any:
    """What is ``made``, for all rows as a whole, of what ``f`` gives for one; None where Python has to look."""
    if not are_rows(sources):
        return None
    graph = current.get()
    looked, numbered, work, rows = dict(graph.looked), dict(graph.numbered), graph.work, dict[Node, Node]()
    graph.supposed += 1
    try:
        with graph.labelled({**graph.labels}):
            each = [_row(source, rows) for source in sources]
            with each_row(graph, rows):
                values = f(*each)
            if free_of(rows, graph.looked.keys() - looked.keys()):
                return made(values, rows, [*zip(each, sources, strict=True)])
    except (Exception, NotRecorded):
        pass
    finally:
        graph.supposed -= 1
    graph.looked, graph.numbered, graph.work = looked, numbered, work
    return None


def _numbers(values: Any, rows: dict[Node, Node], _: Any) -> list[Quantity]:
    return [_column(lift(current.get(), value), rows) for value in values]


def _in_their_form(value: Any, rows: dict[Node, Node], known: list[tuple[Any, Any]]) -> Any:
    for row, source in known:
        if value is row:
            return source
    match value:
        case tuple() | list():
            return Together(regrouped(value, [_in_their_form(part, rows, known) for part in value]))
        case Written((OneOf(at, texts, Quantity() as column, name),)):
            return Texts(name, column, texts, _column(at, rows))
        case Written() if (found := among(current.get(), value)) is not None:
            return Texts("", None, found[0], _column(found[1], rows))
    return _column(lift(current.get(), value), rows)


def first_of(source: Any) -> Any:
    """The first column of a table or of parts, or a column itself."""
    return _columns_of(source)[0]


def held_by(parts: Any) -> list[Any]:
    """All that columns are made of."""
    if isinstance(parts, Together):
        return [each for part in parts.parts for each in held_by(part)]
    if isinstance(parts, Whole):
        return [each for part in vars(parts).values() for each in held_by(part)]
    if isinstance(parts, Texts):
        return [part for part in (parts.at, parts.column) if part is not None]
    return _columns_of(parts)


def are_rows(sources: Sequence[Any]) -> bool:
    """Whether all are columns or tables, with as many rows as the inputs say."""
    columns = [column for source in sources for column in _columns_of(source)]
    if not columns or not all(
        isinstance(c, Quantity) and not isinstance(c, Selected) and c.ndim == 1 and c.re.stretches for c in columns
    ):
        return False
    return len({c.graph.size(part) for c in columns for part in c.parts}) == 1


def _columns_of(source: Any) -> list[Any]:
    """A column, or those of a table; of texts their places."""
    if isinstance(source, Together):
        return [column for part in source.parts for column in _columns_of(part)]
    if isinstance(source, Numbers):
        return [source.column]
    held = vars(source).values() if isinstance(source, Whole) else (source,)
    return [each.at if isinstance(each, Texts) else each for each in held]


def _row(source: Any, rows: dict[Node, Node]) -> Any:
    """What stands for any row: the numbers of the first one, of which ``rows`` has the columns."""
    if isinstance(source, Whole):
        row = source[0]
        for name, column in vars(source).items():
            object.__setattr__(row, name, _row(column, rows))
        return row
    if isinstance(source, Texts):  # whoever reads one is seen
        return Written((OneOf(_row(source.at, rows), source.texts, source.column, source.name),))
    if isinstance(source, Numbers):
        return source.of(_row(source.column, rows))
    if isinstance(source, Together):
        return regrouped(source.parts, [_row(part, rows) for part in source.parts])
    parts = [source.graph.state(part) for part in source.whole()[0].parts]
    rows.update(zip(parts, source.whole().parts, strict=True))
    return as_count(Quantity(source.graph, *parts), source)


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


def _column(each: Quantity, rows: dict[Node, Node]) -> Quantity:
    """The values of a formula for all rows."""
    if isinstance(each, perhaps.Number):
        raise NotRecorded("it is None for some rows")
    if not _is_formula(each, rows):
        raise NotRecorded("it is no formula of single numbers")
    new = replaced(each.graph, each.parts, rows)
    column = Quantity(each.graph, next(iter(rows.values())))
    return each.each(lambda part: new.get(part, part)).like(column)


def _whole(kind: str, each: Quantity) -> Any:
    if kind in ("any", "all"):
        return (each if each.dtype == bool else each != 0).reduced(kind)
    return each if kind == "array" else as_count(each.reduced(kind), each)
