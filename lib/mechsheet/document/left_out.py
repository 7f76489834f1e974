"""What a document leaves out without a word: formulas that no typeset shows, numbers that formulas read undeclared.

And units that the numbers of inputs lack.
"""

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from mechsheet.units import Constant
from mechsheet.worksheet import inputs, source
from mechsheet.worksheet.altered import changed
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.line_shown import CHECKS
from mechsheet.worksheet.lines import Formula, declared, formulas, names_read, undeclaring
from mechsheet.worksheet.refused_cells import beside_inputs
from mechsheet.worksheet.source import bound
from mechsheet.worksheet.typeset import typeset_lines
from mechsheet.worksheet.unbracketed import unbracketed
from mechsheet.worksheet.verdict import Verdict


class LeftOut(NamedTuple):
    """Why something is left out, at a line of the cell of that number; None where the reason names its line."""

    cell: int
    line: int | None
    why: str


_GIVEN = "so give it to typeset()"
_REMEDY = {
    "title_block()": "so give it a cell of its own",
    "mo.md()": "so give it a cell of its own, or write the text alone, without mo.md",
}
_UNREAD = "this [unit] is read by nobody: it is read behind NAME = FORMULA, in a line of its own, not in a block"


def left_out(cells: Iterable[source.Cell], names: Mapping[str, Any]) -> Iterator[LeftOut]:
    """What the cells of a worksheet leave out, from the namespace ``names`` of its run."""
    cells, lines = list(cells), dict[int, list[Formula]]()
    for n, cell in enumerate(cells):
        try:
            lines[n] = [line for line in formulas(cell) if isinstance(line, Formula)]
        except SheetError as error:
            yield LeftOut(n, None, str(error))
    met = {name for found in lines.values() for line in found for name in names_read(line)}
    for n, cell in enumerate(cells):
        yield from (LeftOut(n, line, why) for line, why in beside_inputs(cell.body, names))
    yield from _of_others(cells)
    for n, found in lines.items():
        own, last = {line.name for line in found}, max(typeset_lines(cells[n]), default=0)
        below = [line.name for line in found if line.expression.lineno > last]
        if below:
            first = next(node.lineno for node in cells[n].body if below[0] in bound(node))
            verb = "is" if len(below) == 1 else "are"
            yield LeftOut(n, first, f"{', '.join(below)} {verb} not shown: end the cell in typeset()")
        shown = [node for node in cells[n].body if not isinstance(node, ast.Return)][:-1]
        for node in cells[n].body:
            for line in undeclaring(cells[n], node):
                yield LeftOut(n, line, _UNREAD)
            if node in shown and (name := _bare(node)):
                yield LeftOut(
                    n, node.lineno, f"{name} is not shown: a cell shows its last line, {_REMEDY.get(name, _GIVEN)}"
                )
            if bare := _unbracketed(cells[n], node, names):
                yield LeftOut(n, node.lineno, bare)
                continue
            match node:
                case ast.Assign([ast.Name(name)]) if name in met - own and _is_quantity(names.get(name)):
                    why = f"{name} stands in formulas and is not shown: end its line in # [unit] meaning"
                    yield LeftOut(n, node.lineno, why)
                case ast.ClassDef(name, body=body, decorator_list=[]) if _of_inputs(cells[n], body):
                    yield LeftOut(n, node.lineno, f"{name} is no class of inputs: write @inputs in the line above it")
                case ast.ClassDef(name):
                    told = {field: why for field, _, why in inputs.unlikely(names.get(name))}
                    for each in node.body:
                        match each:
                            case ast.AnnAssign(ast.Name(field)) if field in told:
                                yield LeftOut(n, each.lineno, told[field])


def _of_others(cells: Sequence[source.Cell]) -> Iterator[LeftOut]:
    """What cells change in place that others give: it is another one each time that they run once more."""
    gives = [{name for line in cell.body for name in bound(line)} for cell in cells]
    functions = [line for cell in cells for line in cell.body if isinstance(line, ast.FunctionDef)]
    for n, cell in enumerate(cells):
        others = set[str]().union(*gives[:n], *gives[n + 1 :]) - gives[n]
        for name, places in changed(cell.body, functions, by_others=False).items():
            if name in others and not name.startswith("_"):
                why = f"{name} is changed in place, and another cell gives it: once more whenever this one runs again"
                remedy = f"change a copy, as {name}_2 = {name}.copy(), or do so there"
                yield LeftOut(n, cell.body[places[0]].lineno, f"{why}: {remedy}")


def unseen(cells: Iterable[source.Cell], names: Mapping[str, Any]) -> Iterator[LeftOut]:
    """Checks and solve blocks that cells bind to names which none of them reads or shows, and checks not counted.

    A table or figure may be there for the workbook alone.
    """
    cells = list(cells)
    read = _read(node for cell in cells for node in cell.body)
    counted = _counted(cells)
    for n, cell in enumerate(cells):
        for node in cell.body:
            for name in sorted({*bound(node)}) if isinstance(node, ast.Assign) else ():
                value = names.get(name)
                kinds = {type(each) for each in (value if isinstance(value, tuple | list) else [value])}
                if kinds and all(issubclass(kind, _SEEN) for kind in kinds) and name not in read:
                    into = " and to summary()" if kinds == {Check} else ""
                    yield LeftOut(n, node.lineno, f"{name} is not shown: give it to typeset(){into}")
                elif kinds == {Check} and counted is not None and name not in counted:
                    yield LeftOut(n, node.lineno, f"{name} is not counted in the verdict: give it to summary()")
            if isinstance(node, ast.Expr) and counted is not None and not _sums(node):
                for call in (call for kind in sorted(CHECKS) for call in source.calls_of(node, kind)):
                    why = "has no name and is not counted in the verdict: bind it to one, and give that to summary()"
                    yield LeftOut(n, call.lineno, f"a {ast.unparse(call.func)} {why}")


def _read(statements: Iterable[ast.stmt]) -> set[str]:
    nodes = (node for statement in statements for node in source.nodes(statement))
    return {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}


def _sums(node: ast.stmt) -> bool:
    return any(source.calls_of(node, "summary"))


def _counted(cells: Sequence[source.Cell]) -> set[str] | None:
    """Names of which a summary tells, by others too; None where there is no summary, or it may tell of any."""
    statements = [node for cell in cells for node in cell.body]
    found = _read(filter(_sums, statements))
    if not found or "globals" in found:
        return None
    before = set[str]()
    while before != found:
        before = found
        found = found | _read(node for node in statements if not found.isdisjoint(bound(node)))
    return found


_SEEN = (Check, Verdict)


def _unbracketed(cell: source.Cell, node: ast.stmt, names: Mapping[str, Any]) -> str:
    """Why the comment of a line declares no unit, where it begins with one; "" where it is no more than a comment."""
    match node:
        case ast.Assign([ast.Name(name)]) if callable(names.get(name)) or is_numeric(names.get(name)):
            pass
        case ast.FunctionDef(name):
            pass
        case _:
            return ""
    read = {n.id if isinstance(n, ast.Name) else n.attr for n in source.nodes(node) if isinstance(n, _NAMED)}
    comment = cell.comments.get(node.end_lineno or node.lineno, "")
    meant = comment and unbracketed(comment, {each for each in read if not isinstance(names.get(each), Constant)})
    return "" if not meant or name.startswith("_") else f"# {comment} has no brackets: # {meant}"


_NAMED = (ast.Name, ast.Attribute)


def _of_inputs(cell: source.Cell, body: Iterable[ast.stmt]) -> bool:
    """Whether the lines of a class are written as those of inputs are, each with its value and its unit."""
    given = [node for node in body if isinstance(node, ast.AnnAssign)]
    comments = [cell.comments.get(node.end_lineno or node.lineno, "") for node in given]
    return bool(given) and all(node.value and declared(text) for node, text in zip(given, comments, strict=True))


def _bare(node: ast.stmt) -> str:
    """What a statement would show, were it the last one of its cell; "" where it would show nothing."""
    match node:
        case ast.Expr(ast.Name(name)):
            return name
        case ast.Expr(
            ast.Call(ast.Name("table" | "figure" | "check" | "caption" as kind), [ast.Constant(str(what)), *_])
        ):
            return f"{kind} {what}"
        case ast.Expr(ast.Call(ast.Name("title_block" | "summary" as kind))):
            return f"{kind}()"
        case ast.Expr(ast.Call(ast.Attribute(ast.Name("mo"), "md"))):
            return "mo.md()"
    return ""


def _is_quantity(value: Any) -> bool:
    """Whether a value is numeric and no array of whole numbers, which are places in another one."""
    return is_numeric(value) and not (np.ndim(value) and np.asarray(value).dtype.kind in "iu")


def is_numeric(value: Any) -> bool:
    """Whether a value is a number or an array of numbers."""
    return isinstance(value, int | float | complex | np.ndarray | np.generic) and np.asarray(value).dtype.kind in "iufc"
