"""What a line of a cell gives to be shown: a check, a Find, a table, a figure, in its cell's typeset and the summary.

Texts in, texts out.
"""

import ast
import io
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

CHECKS = {"check", "check_slope", "closed_form", "assembled", "balance"}
_SHOWN = {*CHECKS, "find", "minerr", "table", "figure", "caption", "Drawing"}
_WIDE = 120  # characters of a line of the file


class Given(NamedTuple):
    """What a name is to be shown as: of several each one, ``*name``; whether it is counted among the checks."""

    several: bool
    is_check: bool


def given(line: str) -> dict[str, Given]:
    """What a line gives to be shown, by its name; nothing where it gives a quantity, or an input.

    >>> given("c = check('stress', sigma, R_e)"), given("k = 2  # [-] two")
    ({'c': Given(several=False, is_check=True)}, {})
    """
    match ast.parse(line).body:
        case [ast.Assign([ast.Name(name)], value)]:
            parts = value.elts if isinstance(value, ast.Tuple | ast.List) else [value]
            calls = set(map(_maker, parts))
            if calls and _SHOWN.issuperset(calls):
                return {name: Given(parts != [value] or _gives_several(value), CHECKS.issuperset(calls))}
    return {}


def _maker(value: ast.expr) -> str:
    """The function that makes a value, which methods or sums may go on with, as of a drawing; "" where none does."""
    match value:
        case ast.Call(ast.Name(name)):
            return name
        case ast.Call(ast.Attribute(of)) | ast.BinOp(of, ast.Add()):
            return _maker(of)
    return ""


def _gives_several(value: ast.expr) -> bool:
    """Whether a call gives several checks."""
    match value:
        case ast.Call(ast.Name("balance")):
            return True
        case ast.Call(ast.Name("closed_form"), _, keywords):
            return any(key.arg != "tolerance" and key.arg != "value" for key in keywords)
    return False


def in_typeset(cell: str, was: Mapping[str, Given], now: Mapping[str, Given], end: str) -> str:
    """Text of a cell whose last typeset below a line shows what that gives now, and no longer what it gave."""
    calls = _calls(cell, "typeset")
    lines = [node.lineno for node in ast.walk(ast.parse(cell)) if isinstance(node, ast.Assign) and _gives(node, now)]
    if not calls or any(line > calls[-1].lineno for line in lines):
        return cell
    return _with(cell, calls[-1], was, [f"{'*' * each.several}{name}" for name, each in now.items()], end)


def in_summary(cell: str, was: Mapping[str, Given], now: Mapping[str, Given], end: str) -> str:
    """Text of a cell whose summary, where it has one, counts the checks that a line gives now, not those it gave."""
    calls = _calls(cell, "summary")
    checks = [name for name, each in now.items() if each.is_check]
    return _with(cell, calls[0], was, checks, end) if calls else cell


def _gives(node: ast.Assign, names: Mapping[str, Given]) -> bool:
    return any(isinstance(target, ast.Name) and target.id in names for target in node.targets)


def _calls(cell: str, name: str) -> list[ast.Call]:
    """Calls of a function by the statements of a cell that do nothing else."""
    (holder,) = ast.parse(cell).body
    found = list[ast.Call]()
    for node in getattr(holder, "body", ()):
        match node:
            case ast.Expr(ast.Call(ast.Name(called)) as call) if called == name:
                found.append(call)
    return found


def _with(cell: str, call: ast.Call, was: Iterable[str], now: Sequence[str], end: str) -> str:
    """Text of a cell in which a call has other arguments in the place of those of before, or as its last ones."""
    texts = [ast.get_source_segment(cell, each) or "" for each in call.args]
    old = {mark + name for name in was for mark in ("", "*")}
    read = {node.id for node in ast.walk(call) if isinstance(node, ast.Name)}
    new = [name for name in now if name.removeprefix("*") not in read or name in old]
    at = next((n for n, text in enumerate(texts) if text in old), len(texts))
    listed = [text for text in texts[:at] if text not in old]
    listed += [*new, *(text for text in texts[at:] if text not in old)]
    if listed == texts:
        return cell
    listed += [f"{key.arg}={ast.get_source_segment(cell, key.value)}" for key in call.keywords]
    rows = list(io.StringIO(cell, newline=""))
    first, last = call.lineno - 1, call.end_lineno or call.lineno
    before = rows[first].encode()[: call.col_offset].decode()
    after = rows[last - 1].encode()[call.end_col_offset :].decode()
    assert isinstance(call.func, ast.Name)
    one = f"{before}{call.func.id}({', '.join(listed)}){after}"
    if len(one.rstrip()) > _WIDE or any("\n" in text for text in listed):
        one = end.join([f"{before}{call.func.id}(", *(f"{before}    {text}," for text in listed), f"{before}){after}"])
    return "".join([*rows[:first], one, *rows[last:]])
