"""One line of a worksheet's file in another text: that of a symbol which a cell declares, or of an input.

Texts in, texts out. Nothing else in the file changes but the arguments and the return of the cell, where the line reads
or gives other names.
"""

import ast
import io
import re
import textwrap
import tokenize
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple, TypeAlias

from mechsheet.worksheet import imports, line_shown, mistakes
from mechsheet.worksheet.cells import defines
from mechsheet.worksheet.depending import Part, circle, read
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.line_shown import Given
from mechsheet.worksheet.lines import formulas
from mechsheet.worksheet.source import bound, functions, is_app, nodes, of_texts, read_outside, scopes_of

OF_INPUT = "g."  # before the name of an input, as formulas read it
_LIKE = {
    False: "a line is a name and what it is, such as F = m * a  # [N] force",
    True: "an input is a name, its type and its value, such as L: float = 0.5  # [m] length; > 0",
}


class Change(NamedTuple):
    """Parts of the file, and what stands in their places after the change."""

    before: Sequence[str]
    after: Sequence[str]

    def of(self, text: str) -> str:
        """The text after the change, whatever the cells return by now: the editor writes that anew when it saves.

        Raises SheetError where a part is not there, or what comes out is no Python.
        """
        for before, after in zip(self.before, self.after, strict=True):
            if text.count(before) != 1:
                there = [part for part in _cells(text) if _RETURN.sub("", part) == _RETURN.sub("", before)]
                if len(there) != 1:
                    raise SheetError("the cell has changed since in the file: nothing is written")
                before = there[0]
            text = text.replace(before, after)
        _parsed(text)
        return text

    def back(self) -> "Change":
        """The change that takes this one back."""
        return Change(self.after, self.before)


_RETURN = re.compile(r"\n\s+return\b[^\n(]*(?:\([^()]*\))?\s*\Z")


def _cells(text: str) -> Iterator[str]:
    """Texts of the cells, each with its decorator and without."""
    rows = list(io.StringIO(text, newline=""))
    for node in functions(_parsed(text)):
        first, last = _rows(node)
        yield from ("".join(rows[n:last]) for n in dict.fromkeys((first, node.lineno - 1)))


def changed(text: str, made: str) -> Change:
    """The change from one text of a file to another one with the same cells, of the parts that differ."""
    parts = (
        ["".join(list(io.StringIO(each, newline=""))[slice(*_rows(node))]) for node in _parsed(each).body]
        for each in (text, made)
    )
    before, after = zip(*(pair for pair in zip(*parts, strict=True) if pair[0] != pair[1]), strict=True)
    return Change(before, after)


def line(text: str, name: str) -> str:
    """Text of the line that declares a symbol, or the input ``g.NAME``, with its comment and without its indentation.

    Raises SheetError where no line does, several do, or it shares its line with others.
    """
    return _place(text, name).line


def change(text: str, name: str, was: str, new: str, below: bool = False) -> Change:
    """The change of the file in which ``new`` stands in place of the line ``was`` of a name, or ``below`` it.

    Without a text the line goes. The setup imports what ``new`` calls and nothing gives; what it gives to be shown,
    such as a check, the cell's typeset shows and the summary counts. Raises SheetError where the line is another one by
    now, ``new`` is no such line, or needs what needs its cell.
    """
    place = _place(text, name)
    if place.line != was:
        raise SheetError(f"the line of {name} has changed since in the file: nothing is written")
    if new == was and not below:
        return Change((place.cell,), (place.cell,))
    new = "\n".join(row.rstrip() for row in new.strip().split("\n"))
    if below and not new:
        raise SheetError(_LIKE[name.startswith(OF_INPUT)])
    if new:
        _refuse(new, place, name.startswith(OF_INPUT), below)
    own = list(io.StringIO(place.cell, newline=""))
    end = "\r\n" if own[place.first].endswith("\r\n") else "\n"
    rows = [place.indent + row + end if row else end for row in new.split("\n")] if new else []
    own[place.last if below else place.first : place.last] = rows
    if new and place.cell_number is not None:
        _refuse_early("".join(own), place.last if below else place.first)
    made, counted, (lines, setup) = "".join(own), list[tuple[str, str]](), _imports(text, new)
    if place.cell_number is not None and _named(new) != _named("" if below else was):
        gone, gives = {} if below else line_shown.given(was), line_shown.given(new)
        made = line_shown.in_summary(line_shown.in_typeset(made, gone, gives, end), gone, gives, end)
        if setup and setup.before in place.cell:  # of the cell that imports
            own_setup = imports.added(made, next(functions(ast.parse(made))), lines)
            made, setup = made.replace(*own_setup or ("", "")), None
        whole = (text.replace(*setup) if setup else text).replace(place.cell, made)
        made = _signed(made, _parsed(text), _parsed(whole), place.cell_number, end)
        if gone or gives:
            counted = list(_counted(text, whole, place.cell_number, gone, gives))
    before, after = zip((place.cell, made), *([setup] if setup else []), *counted, strict=True)
    found = Change(before, after)
    now = _circle(_parsed(found.of(text)), place.cell_number)
    if now and not _circle(_parsed(text), place.cell_number):
        raise SheetError(now)
    return found


def _counted(
    text: str, whole: str, number: int, gone: Mapping[str, Given], gives: Mapping[str, Given]
) -> Iterator[tuple[str, str]]:
    """The other cell with a summary, before and after a change of what it counts; ``whole`` lacks that change."""
    tree, rows = _parsed(text), list(io.StringIO(text, newline=""))
    for n, node in enumerate(functions(tree)):
        first, last = _rows(node)
        cell = "".join(rows[first:last])
        end = "\r\n" if rows[first].endswith("\r\n") else "\n"
        if n != number and "summary" in cell and (made := line_shown.in_summary(cell, gone, gives, end)) != cell:
            yield cell, _signed(made, tree, _parsed(whole.replace(cell, made)), n, end)


def imported(text: str, new: str) -> list[str]:
    """Lines that the setup of a file gets with a line: they import what that calls and nothing gives."""
    return _imports(text, new)[0]


@lru_cache(maxsize=16)
def _imports(text: str, new: str) -> tuple[list[str], imports.Setup | None]:
    """Lines that the setup gets with a line, and its rows before and after; nothing where it needs none, or is none.

    Without a setup it is the first cell that imports.
    """
    tree = _parsed(text)
    lines = imports.lacking(new, {name for body in _bodies(tree) for node in body for name in bound(node)})
    importing = [node for node in functions(tree) if any(isinstance(s, ast.Import | ast.ImportFrom) for s in node.body)]
    holders: list[ast.With | ast.FunctionDef] = [*_setup(tree), *importing]
    for node in holders if lines else ():
        if setup := imports.added(text, node, lines):
            return (lines, setup) if text.count(setup.before) == 1 else ([], None)
    return [], None


def _setup(tree: ast.Module) -> Iterator[ast.With]:
    for node in tree.body:
        match node:
            case ast.With(items=[ast.withitem(context)]) if is_app(context, ("setup",)):
                yield node


def asked_for(text: str) -> str:
    """Text of the class of the inputs as the file has it, without marimo's decorator; SheetError where none is."""
    rows = list(io.StringIO(text, newline=""))
    for node in ast.walk(_parsed(text)):
        if isinstance(node, ast.ClassDef) and _is_asked(node):
            first, last = _rows(node)
            return textwrap.dedent("".join(row for row in rows[first:last] if not _ALONE.fullmatch(row.strip())))
    raise SheetError("the file declares no inputs")


def same_cells(text: str, codes: Iterable[str]) -> bool:
    """Whether the cells of a file are those of a page, whatever space stands in them.

    A page that was opened holds no text cells: those of the file that it lacks are as they are.
    """
    bodies = [(_plain(text, body), body) for body in _bodies(_parsed(text)) if body]
    in_page = Counter(_plain(code, body) for code in codes if (body := ast.parse(code).body))
    texts = Counter(plain for plain, body in bodies if _is_text(body))
    in_file = Counter(plain for plain, _ in bodies)
    return in_page <= in_file and in_file - in_page <= texts


class _Place(NamedTuple):
    """A line of a cell: the text of the cell, the rows of the line in it, and what the line shares its names with."""

    line: str
    cell: str
    first: int
    last: int
    indent: str
    names: frozenset[str]  # that the others of the class or the file bind
    cell_number: int | None  # among those that marimo calls with arguments


_Holder: TypeAlias = ast.FunctionDef | ast.ClassDef


@lru_cache(maxsize=16)
def _lines(text: str) -> dict[str, list[tuple[_Holder, int, int | None]]]:
    """Lines of a file by name, ``g.NAME`` of an input: the cell or class that holds each, its place there, and the
    number of the cell."""
    tree, found = _parsed(text), dict[str, list[tuple[_Holder, int, int | None]]]()
    asked = (node for node in ast.walk(tree) if isinstance(node, ast.ClassDef) and _is_asked(node))
    holders: list[tuple[_Holder, int | None]] = [(node, n) for n, node in enumerate(functions(tree))]
    for holder, number in (*holders, *((node, None) for node in asked)):
        before = OF_INPUT if number is None else ""
        for n, node in enumerate(holder.body):
            for name in declares(node):
                found.setdefault(before + name, []).append((holder, n, number))
    return found


@lru_cache(maxsize=16)
def _defined(text: str) -> tuple[tuple[int, tuple[str, ...]], ...]:
    """Rows of the statements of all cells, with the names that each defines."""
    return tuple((node.lineno, defines([node])) for body in _bodies(_parsed(text)) for node in body)


def _place(text: str, name: str) -> _Place:
    rows, lines = list(io.StringIO(text, newline="")), _lines(text)
    found = lines.get(name, [])
    if len(found) != 1:
        raise SheetError(f"{name} has {len(found) or 'no'} lines in the file: edit the code of its cell")
    (holder, n, number), *_ = found
    body = holder.body
    first, last = _rows(body[n])
    indent = rows[first][: body[n].col_offset]
    others = [*body[:n], *body[n + 1 :]]
    if indent.strip() or any(_rows(node)[0] < last and first < _rows(node)[1] for node in others):
        raise SheetError(f"{name} shares its line with another one: edit the code of its cell")
    own = [row.rstrip("\r\n") for row in rows[first:last]]
    if any(row.strip() and not row.startswith(indent) for row in own):
        raise SheetError(f"the line of {name} holds a text at the margin: edit the code of its cell")
    above, below = _rows(holder)
    taken = frozenset(defines(others))
    if number is not None:
        taken = frozenset(name for at, names in _defined(text) if at != body[n].lineno for name in names)
    return _Place(
        "\n".join(row.removeprefix(indent) for row in own),
        "".join(rows[above:below]),
        first - above,
        last - above,
        indent,
        taken,
        number,
    )


def declares(node: ast.stmt) -> set[str]:
    """Names that a line declares; none where a statement is no line."""
    match node:
        case ast.Assign(targets=targets):
            return {name for target in targets for name in bound(target)}
        case ast.AnnAssign(ast.Name(name)) | ast.FunctionDef(name=name):
            return {name}
    return set()


def _is_text(body: Sequence[ast.stmt]) -> bool:
    """Whether a cell does nothing but show a text as it is written."""
    match body:
        case [ast.Expr(ast.Call(ast.Attribute(ast.Name("mo"), "md"), [ast.Constant()]))]:
            return True
    return False


def _named(line: str) -> set[str]:
    """Names that a line reads or declares."""
    tree = ast.parse(line)
    read = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return read.union(*map(declares, tree.body))


def _is_asked(node: ast.ClassDef) -> bool:
    """Whether a class declares inputs with their values."""
    decorated = any(isinstance(d, ast.Name) and d.id == "inputs" for d in node.decorator_list)
    return decorated and any(isinstance(field, ast.AnnAssign) and field.value for field in node.body)


def _rows(node: ast.stmt) -> tuple[int, int]:
    """First row of a statement, and that behind its last."""
    decorated = getattr(node, "decorator_list", [])
    return min(n.lineno for n in (node, *decorated)) - 1, node.end_lineno or node.lineno


def _refuse(new: str, place: _Place, is_input: bool, below: bool) -> None:
    """Raise SheetError where a text is no line of a formula or an input, or binds a name that another line has."""
    try:
        body = ast.parse(new).body
        compile(new, "", "exec")  # which refuses what a cell may hold and a line may not, such as n = yield
    except SyntaxError as error:
        raise SheetError(mistakes.unread(error)) from None
    match body:
        case [ast.AnnAssign(ast.Name(), _, ast.expr())]:
            pass
        case [ast.Assign(targets=targets)] if not is_input and all(map(_is_of_names, targets)):
            pass
        case [ast.FunctionDef(decorator_list=[])] if not is_input:
            pass
        case _:
            raise SheetError(_LIKE[is_input])
    if not is_input:
        formulas(of_texts(((new, ""),))[0])  # what is no formula would take the whole cell from the page
    own = {name for node in ast.parse(place.line).body for name in bound(node)}
    taken = place.names | own if below else place.names - own
    if twice := sorted(taken.intersection(bound(body[0]))):
        raise SheetError(f"{twice[0]} is declared by another line: take another name")


_LATER = (ast.Lambda, ast.comprehension)  # which read when they are called, or names of their own


def _refuse_early(cell: str, row: int) -> None:
    """Raise SheetError where the line in a row of a cell reads what the cell gives in this line, or below it, alone."""
    (holder,) = functions(ast.parse(cell))
    body = holder.body
    at = next(n for n, node in enumerate(body) if _rows(node)[0] == row)
    if isinstance(body[at], ast.Assign | ast.AnnAssign) and not any(isinstance(n, _LATER) for n in nodes(body[at])):
        own = set(bound(body[at]))
        late = own.union(*map(bound, body[at:])).difference(*map(bound, body[:at]))
        for name in sorted(read(body[at]) & late):
            raise SheetError(mistakes.late(name, name in own))


def _is_of_names(target: ast.expr) -> bool:
    """Whether a line binds names, and alters no part of what another one has."""
    return not any(isinstance(node, ast.Attribute | ast.Subscript) for node in ast.walk(target))


def _signed(cell: str, before: ast.Module, after: ast.Module, number: int, end: str) -> str:
    """Text of a cell with the arguments and the return that fit what its lines read and give after a change."""
    node, past = list(functions(after))[number], _reads(before, number)
    now, given = _reads(after, number), set(defines(node.body))
    arguments = [a.arg for a in node.args.args]
    wanted = {a for a in arguments if a not in past - now} | (now - past)
    rows = list(io.StringIO(cell, newline=""))
    top = _rows(node)[0]
    match node.body[-1]:
        case ast.Return(ast.expr() as value) as last:
            kept = [n.id for n in ast.walk(value) if isinstance(n, ast.Name)]
            if not given.issuperset(kept):
                kept = [name for name in kept if name in given]
                first, behind = _rows(last)
                indent = rows[first - top][: last.col_offset]
                rows[first - top : behind - top] = imports.returning(kept, indent, end)
    if wanted != set(arguments):
        text, several = "".join(rows), imports.several(sorted(wanted), "", end)
        start, stop = _brackets(text, node.name)
        one = f"({', '.join(sorted(wanted))})"
        return text[:start] + (one if len(f"def {node.name}{one}:") <= imports.WIDE else several) + text[stop:]
    return "".join(rows)


def _brackets(cell: str, name: str) -> tuple[int, int]:
    """Where the brackets of a cell's arguments begin, and where what follows them does."""
    starts = [0]
    for row in io.StringIO(cell, newline=""):
        starts.append(starts[-1] + len(row))
    depth, begin, before = 0, None, ("", "")
    for token in tokenize.generate_tokens(io.StringIO(cell, newline="").readline):
        at = starts[token.start[0] - 1] + token.start[1]
        if begin is None and token.string == "(" and before == ("def", name):
            begin = at
        if begin is not None and token.string in "()" and token.string:
            depth += 1 if token.string == "(" else -1
            if not depth:
                return begin, at + 1
        before = before[1], token.string
    raise SheetError(f"cell {name} has no arguments")


def _reads(tree: ast.Module, number: int) -> set[str]:
    """Names of other cells that a cell reads."""
    cells = list(functions(tree))
    node = cells[number]
    bare = ast.FunctionDef("cell", ast.arguments([], [], None, [], [], None, []), node.body, [])
    text = ast.unparse(ast.fix_missing_locations(ast.Module([bare], [])))
    (scope,) = scopes_of(text)
    read = set(read_outside(scope))
    return read & {name for other in cells if other is not node for name in defines(other.body)}


def _circle(tree: ast.Module, number: int | None) -> str:
    """Why a cell cannot be computed before all that needs it; nothing where it can, and of a class."""
    if number is None:
        return ""
    cells = list(functions(tree))
    parts = [Part({a.arg for a in node.args.args}, set(defines(node.body))) for node in cells]
    found = circle(parts[number], parts[:number] + parts[number + 1 :], cells[number].body)
    return str(found) if found else ""


def _bodies(tree: ast.Module) -> Iterator[Sequence[ast.stmt]]:
    """Statements of each cell of a file, as the page holds them."""
    yield from ([s for s in node.body if not isinstance(s, ast.Return)] for node in functions(tree))
    for node in tree.body:
        match node:
            case ast.With(items=[ast.withitem(context)]) if is_app(context, ("setup",)):
                yield node.body
            case ast.ClassDef() | ast.FunctionDef():
                if any(is_app(d, ("class_definition", "function")) for d in node.decorator_list):
                    yield [node]


_ALONE = re.compile(r"@app\.(class_definition|function)(\(.*\))?")


def _plain(text: str, body: Sequence[ast.stmt]) -> str:
    """Statements of a cell without space, without marimo's decorator of one that stands alone, and without the comment
    behind the last of them, which the page may lack."""
    own = list(io.StringIO(text, newline=""))[_rows(body[0])[0] : _rows(body[-1])[1]]
    own[-1] = own[-1].encode()[: body[-1].end_col_offset].decode()
    return re.sub(r"\s", "", "".join(row for row in own if not _ALONE.fullmatch(row.strip())))


@lru_cache(maxsize=16)
def _parsed(text: str) -> ast.Module:
    try:
        return ast.parse(text)
    except SyntaxError as error:
        raise SheetError(f"the file, line {error.lineno}: {mistakes.unread(error)}") from None
