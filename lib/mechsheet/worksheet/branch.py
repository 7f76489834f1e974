"""The assembly branch that a function of a worksheet takes unless it is told another, as its formula is shown."""

import ast
import re
from collections.abc import Iterable, Mapping
from copy import deepcopy
from typing import TypeVar

from mechsheet.worksheet import source

T = TypeVar("T", bound=ast.AST)


def on_its_branch(args: ast.arguments, expression: ast.expr) -> ast.expr:
    """The expression with the branch that its function takes by default."""
    default = _default(args)
    if not default:
        return expression
    text = re.sub(r"\bbranch\b", default, ast.unparse(expression))
    return ast.copy_location(ast.parse(text, mode="eval").body, expression)


def branches(body: Iterable[ast.stmt]) -> dict[tuple[str, int], str]:
    """Branches that functions take by default, by their names and how many arguments they have."""
    found = dict[tuple[str, int], str]()
    for node in body:
        match node:
            case ast.FunctionDef(name, args) | ast.Assign([ast.Name(name)], ast.Lambda(args)) if _default(args):
                found[name, len(args.args)] = _default(args)
    return found


def untold(node: T, known: Mapping[tuple[str, int], str]) -> T:
    """An expression whose calls leave out the branch that their functions take by default, as their formulas do."""
    if not any(name in ast.unparse(node) for name, _ in known):
        return node
    shown = deepcopy(node)
    for call in source.nodes(shown):
        match call:
            case ast.Call(ast.Name(name), [*_, last] as given) if ast.unparse(last) == known.get((name, len(given))):
                given.pop()
    return shown


def _default(args: ast.arguments) -> str:
    return ast.unparse(args.defaults[-1]) if args.args and args.args[-1].arg == "branch" and args.defaults else ""
