"""What statements change in place: elements of arrays and lists, by whatever name these are known."""

import ast
import builtins
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import chain

from mechsheet.worksheet import source

ARRANGING = {"sort", "fill", "partition", "put", "resize"}  # methods of arrays
FILLING = {  # functions of numpy, of their first argument
    "at", "fill_diagonal", "copyto", "put", "put_along_axis", "place", "putmask", "shuffle",
}  # fmt: skip
_GROWING = {  # methods of lists and of what holds several values
    "append", "appendleft", "extend", "insert", "pop", "popleft", "popitem", "remove", "discard", "clear", "reverse",
    "update", "add", "setdefault",
}  # fmt: skip
# Functions that change nothing of what they show.
_SHOWING = {"typeset", "summary", "title_block", "caption", "table", "figure", "check", "check_slope", "export"}
_SHOWING |= {*vars(builtins)}
# Attributes, methods and functions of numpy that give another name to the same elements.
SAME = {
    "T", "real", "imag", "flat", "reshape", "ravel", "view", "transpose", "squeeze", "swapaxes", "diagonal", "asarray",
    "atleast_1d", "atleast_2d", "moveaxis", "flip",
}  # fmt: skip


def altered(nodes: Iterable[ast.AST]) -> Iterator[ast.expr]:
    """What a statement of some nodes changes in place where it is an array."""
    for node in nodes:
        match node:
            case ast.AugAssign(target):
                yield target
            case ast.Subscript(of, ctx=ast.Store()) | ast.Attribute(of, ctx=ast.Store()):
                yield of
            case ast.Call(args=args, keywords=named) if any(map(overwrites, named)):
                yield from args
            case ast.Call(ast.Attribute(of, function), args) if function in ARRANGING or function in FILLING:
                yield of  # or numpy itself
                yield from args[:1] if function in FILLING else ()
            case ast.keyword("out", array):
                yield array
            case ast.Expr(ast.Call(ast.Attribute(ast.Name("np"), function), [_, _, array])) if function not in FILLING:
                yield array  # where it is to put what it gives


_WHOLE = {"fill_diagonal", "copyto", "put", "place", "putmask"}  # of these those that a recording follows


def filled(value: ast.expr) -> str:
    """The name of the array into which a call lets numpy put numbers, all or some; "" of any other call."""
    match value:
        case ast.Call(ast.Attribute(ast.Name("np" | "numpy"), function), [ast.Name(name), *_]) if function in _WHOLE:
            return name
        case ast.Call(keywords=named) if not any(k.arg == "where" for k in named):
            return next((k.value.id for k in named if k.arg == "out" and isinstance(k.value, ast.Name)), "")
    return ""


def overwrites(named: ast.keyword) -> bool:
    """Whether an argument lets a function of scipy put what it needs into the arrays that it is given."""
    return (named.arg or "").startswith("overwrite_")


def turned_through(nodes: Iterable[ast.AST], arrays: Iterable[ast.expr]) -> Iterator[ast.expr]:
    """What loops go through whose turns change what they take out of it."""
    names = {array.id for array in arrays if isinstance(array, ast.Name)}
    for node in reversed([node for node in nodes if isinstance(node, ast.For)]):  # those in others first
        for target, items in pairs(node.target, node.iter):
            if any(isinstance(n, ast.Name) and n.id in names for n in ast.walk(target)):
                names |= {items.id} if isinstance(items, ast.Name) else set()
                yield items


def pairs(target: ast.expr, items: ast.expr) -> Iterator[tuple[ast.expr, ast.expr]]:
    """What a loop calls the elements of what it goes through, each for itself."""
    match target, items:
        case ast.Tuple([_, each]), ast.Call(ast.Name("enumerate"), [of, *_]):
            yield from pairs(each, of)
        case ast.Tuple(elts=targets), ast.Call(ast.Name("zip"), several) if len(targets) == len(several):
            for each, of in zip(targets, several, strict=True):
                yield from pairs(each, of)
        case _, ast.Call(ast.Name("reversed"), [of]):
            yield from pairs(target, of)
        case _:
            yield target, items


def held_by(node: ast.AST) -> Iterator[ast.Name]:
    """Names of what an expression is a part of, or a view, as a function of it may be; of several together.

    The inputs are none, of which nothing can be changed, nor are functions of Python.
    """
    match node:
        case ast.Name(name):
            yield from () if name == "g" or hasattr(builtins, name) else (node,)
        case ast.Subscript(of) | ast.Attribute(of):
            yield from held_by(of)
        case ast.Call(function, args):
            yield from chain.from_iterable(map(held_by, (function, *args)))
        case ast.Tuple(elts) | ast.List(elts):
            yield from chain.from_iterable(map(held_by, elts))


def changed(
    body: Sequence[ast.stmt], functions: Iterable[ast.FunctionDef] = (), by_others: bool = True
) -> dict[str, list[int]]:
    """By the names of values, the numbers of the statements of a cell that change these in place.

    Its own functions do, and the others that are known; and what is called for nothing, ``by_others``.
    """
    own = {line.name: line for line in (*functions, *body) if isinstance(line, ast.FunctionDef)}
    found, same = dict[str, list[int]](), dict[str, set[str]]()
    for n, line in enumerate(body):
        for name in _by_all_names(_changed(line, own, by_others), same):
            found.setdefault(name, []).append(n)
        for name in source.bound(line):
            same.pop(name, None)
        match line:
            case ast.Assign([ast.Name(name)], value) | ast.AnnAssign(ast.Name(name), value=ast.expr() as value):
                same[name] = {*_shown_by(value)} - {name}
    return found


@lru_cache(maxsize=32)
def changing(functions: tuple[ast.FunctionDef, ...]) -> tuple[ast.FunctionDef, ...]:
    """Those of some functions that change what they are handed."""
    every = {function.name: function for function in functions}
    return tuple(each for each in every.values() if not _inside(each, every).isdisjoint(_arguments(each)))


def _by_all_names(names: set[str], same: Mapping[str, set[str]]) -> set[str]:
    """Names of some values, and of those whose elements they show."""
    found = [*names]
    for name in found:
        found += same.get(name, set()).difference(found)
    return {*found}


def _shown_by(value: ast.expr) -> Iterator[str]:
    """Names of the values whose elements an expression may show."""
    match value:
        case ast.Name(name):
            yield name
        case ast.Subscript(of) | ast.Attribute(of, "T" | "real" | "imag" | "flat"):
            yield from _shown_by(of)
        case ast.IfExp(_, then, otherwise):
            yield from chain(_shown_by(then), _shown_by(otherwise))
        case ast.Call(ast.Attribute(of, function), args) if function in SAME:
            yield from chain.from_iterable(map(_shown_by, (of, *args[:1])))


def _changed(line: ast.stmt, functions: Mapping[str, ast.FunctionDef], by_others: bool) -> set[str]:
    """Names of what a statement changes in place, and of what it hands for nothing to others than these functions."""
    if isinstance(line, ast.FunctionDef | ast.ClassDef):
        return set()
    nodes = source.nodes(line)
    added = [node.target for node in nodes if isinstance(node, ast.AugAssign)]  # a number is bound anew by it
    parts = list[ast.expr]()
    for node in nodes:
        match node:
            case ast.Subscript(of, ctx=ast.Store() | ast.Del()) | ast.Attribute(of, ctx=ast.Store() | ast.Del()):
                parts.append(of)
            case ast.Call(args=args, keywords=given) if any(map(overwrites, given)):
                parts += args
            case ast.Call(ast.Attribute(of, name), [first, *_]) if name in FILLING and _is_of_numpy(of, name):
                parts.append(first)
            case ast.Call(ast.Attribute(of, name)) if name in _GROWING | ARRANGING and not _is_of_numpy(of, name):
                parts.append(of)
            case ast.keyword("out", array):
                parts.append(array)
            case ast.Expr(ast.Call(ast.Name(name), args, named)) if (
                by_others and name not in functions.keys() | _SHOWING
            ):
                parts += [part for part in (*args, *(each.value for each in named)) if isinstance(part, ast.Name)]
            case ast.Call(ast.Name(name)) if name in functions:
                parts += _handed(node, functions[name], functions)
    parts += turned_through(nodes, [*parts, *added])
    return {name.id for part in parts for name in held_by(part)}


def _handed(node: ast.Call, function: ast.FunctionDef, functions: Mapping[str, ast.FunctionDef]) -> list[ast.expr]:
    """What a call hands to a function that changes it."""
    inside, names = _inside(function, functions), _arguments(function)
    given = [*zip(names, node.args, strict=False), *((each.arg, each.value) for each in node.keywords)]
    return [value for name, value in given if name in inside]


def _inside(function: ast.FunctionDef, functions: Mapping[str, ast.FunctionDef]) -> set[str]:
    """Names in a function of what it changes."""
    others = {name: each for name, each in functions.items() if each is not function}
    return {name for line in function.body for name in _changed(line, others, by_others=False)}


def _arguments(function: ast.FunctionDef) -> list[str]:
    return [each.arg for each in (*function.args.posonlyargs, *function.args.args)]


def _is_of_numpy(of: ast.expr, name: str) -> bool:
    """Whether a function that is called by its ``name`` is numpy's, as ``np.add.at``, or of its random numbers."""
    if name == "at":
        return isinstance(of, ast.Attribute) and _is_of_numpy(of.value, "")
    return isinstance(of, ast.Name) and (of.id in ("np", "numpy") or name == "shuffle")
