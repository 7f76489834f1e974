"""Texts of a worksheet that are just a symbol's name and mean something else: an option, a key, a value of a text.

Such a text may stand elsewhere too, in a scene, a file or on the command line, and there it would be the old one.
"""

import ast
from collections.abc import Callable, Iterator, Set
from typing import Any, TypeGuard

_OPTIONS = frozenset(("Literal", "one_of"))  # whose texts are names of options
_BY_NAME = frozenset(("getattr", "setattr", "hasattr", "delattr", "vars"))  # which know attributes by their names


def own_texts(tree: ast.AST, name: str, called: Callable[[ast.expr], Any], inputs: Set[str]) -> Iterator[ast.Constant]:
    """Where the name is a text of the worksheet's own.

    ``called`` gives what an expression that is called stands for, as far as it is imported; ``inputs`` are the names
    of those inputs that are texts or choices.
    """
    nodes = [*ast.walk(tree)]
    if not any(_is(node, name) for node in nodes):
        return
    classes = {node.name for node in nodes if isinstance(node, ast.ClassDef)}
    library = [node for node in nodes if isinstance(node, ast.Call) and _takes_names(node.func, called)]
    given = {part for call in library for each in _arguments(call) for part in ast.walk(each)}
    passed = {part.id for part in given if isinstance(part, ast.Name)}
    for node in nodes:
        match node:  # what is bound to a name that is given to the library is as if it stood there
            case ast.Assign([ast.Name(target)], value) if target in passed:
                given.update(ast.walk(value))
    certain = [part for node in nodes for part in _options(node, classes, inputs) if _is(part, name)]
    certain += [part for node in nodes for part in _keys(node) if _is(part, name) and part not in given]
    words = (node.keywords for node in nodes if isinstance(node, ast.Call) and _named(node.func) == "dict")
    if certain or any(word.arg == name for each in words for word in each):
        yield from certain
        yield from (node for node in nodes if _is(node, name) and node not in given and node not in certain)


def _is(node: ast.AST, name: str) -> TypeGuard[ast.Constant]:
    return isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value == name


def _takes_names(function: ast.expr, called: Callable[[ast.expr], Any]) -> bool:
    """Whether a function is the library's, or one that knows attributes by name, so that texts are symbols to it."""
    module = getattr(called(function), "__module__", "") or ""
    own = module.split(".")[0] == "mechsheet" or _named(function) in {*_BY_NAME, "partial"}
    return own and _named(function) not in _OPTIONS


def _named(function: ast.expr) -> str:
    return function.id if isinstance(function, ast.Name) else getattr(function, "attr", "")


def _arguments(call: ast.Call) -> Iterator[ast.expr]:
    yield from call.args
    yield from (keyword.value for keyword in call.keywords)


def _options(node: ast.AST, classes: Set[str], inputs: Set[str]) -> Iterator[ast.AST]:
    """Texts that are options, values of a text, or cells of a row."""
    match node:
        case ast.Subscript(ast.Name("Literal"), within):
            yield from ast.walk(within)
        case ast.Call(ast.Name("one_of")):
            yield from (key for each in _arguments(node) for part in ast.walk(each) for key in _keys(part))
            yield from node.args[1:]
        case ast.Call(ast.Name(of)) if of in classes:
            yield from _arguments(node)
        case ast.ClassDef():
            yield from (line.value for line in node.body if isinstance(line, ast.AnnAssign) and line.value)
        case ast.Compare(left, _, right) if any(_is_input(side, inputs) for side in (left, *right)):
            yield from (part for side in (left, *right) for part in ast.walk(side))
        case ast.Match(subject, cases) if _is_input(subject, inputs):
            yield from (part for case in cases for part in ast.walk(case.pattern))


def _keys(node: ast.AST) -> Iterator[ast.AST]:
    if isinstance(node, ast.Dict):
        yield from filter(None, node.keys)


def _is_input(node: ast.expr, inputs: Set[str]) -> bool:
    match node:
        case ast.Attribute(ast.Name("g"), name):
            return name in inputs
    return False
