"""Arrays that are changed in place in ways of numpy's own, and those of a function that nobody else knows."""

import ast
from collections.abc import Callable, Set
from typing import Any

from mechsheet.recording.exactly import OPERATIONS
from mechsheet.recording.forms import call, index
from mechsheet.worksheet.altered import ARRANGING, FILLING, overwrites

ARRAYS = {  # functions that give new ones
    "zeros", "ones", "empty", "full", "eye", "arange", "linspace", "array", "copy", "zeros_like", "ones_like",
    "empty_like", "full_like",
}  # fmt: skip
_NEW = {*ARRAYS, "float", "int", "len", "sum", "abs", "sqrt", "sorted", "list"}


def of_its_own(function: ast.FunctionDef) -> set[str]:
    """Names of a function to which it gives nothing but new values, which nobody else knows."""
    nodes = [*ast.walk(function)]
    pairs = [(target, node.value) for node in nodes if isinstance(node, ast.Assign) for target in node.targets]
    pairs += [
        pair
        for target, value in pairs
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) and len(target.elts) == len(value.elts)
        for pair in zip(target.elts, value.elts, strict=True)
    ]
    new = {id(target): target.id for target, value in pairs if isinstance(target, ast.Name) and is_new(value)}
    kept = {id(node.target) for node in nodes if isinstance(node, ast.AugAssign)}
    names = (node for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store))
    others = {node.id for node in names if id(node) not in new.keys() | kept}
    others.update(node.arg for node in nodes if isinstance(node, ast.arg))
    return {*new.values()}.difference(others, *(n.names for n in nodes if isinstance(n, ast.Global | ast.Nonlocal)))


def is_new(value: ast.expr) -> bool:
    """Whether an expression gives a value that nobody knows."""
    match value:
        case ast.Call(ast.Name(name) | ast.Attribute(_, name)):
            return name in _NEW
    return isinstance(value, ast.Constant | ast.BinOp | ast.UnaryOp | ast.Compare | ast.List | ast.ListComp)


def marked(function: ast.FunctionDef, own: Set[str], changes: Set[str]) -> None:
    """Tell changes of arrays that nobody else knows from others."""
    for node in ast.walk(function):
        match node:
            case ast.Call(ast.Name(f), [ast.Name(name), *_]) if name in own and f"own {f[9:]}" in changes:
                node.func = ast.Name(f"recorded own {f[9:]}", ast.Load())


def outside(node: ast.Call) -> None:
    """Let a call by which numpy changes an array in place look at which one it is."""
    match node:
        case ast.Call(ast.Attribute(values, method) as function) if method in ARRANGING:
            function.value = call("outside", node, values)
        case ast.Call(ast.Attribute(_, function), [array, *others]) if function in FILLING:
            node.args = [call("outside", node, array), *others]
    for keyword in filter(overwrites, node.keywords):
        keyword.value = call("overwriting", node, keyword.value)
    for keyword in node.keywords:
        if keyword.arg == "out" and isinstance(node.func, ast.Attribute):
            keyword.value = call("outside", node, keyword.value)


def is_outside(node: ast.Call) -> bool:
    """Whether there may be such an array."""
    name = node.func.attr if isinstance(node.func, ast.Attribute) else ""
    return name in ARRANGING or name in FILLING or any(k.arg == "out" or overwrites(k) for k in node.keywords)


def put(node: ast.stmt, name: str, key: ast.expr, value: ast.expr) -> tuple[ast.stmt, ast.Expr]:
    """An element of an array that is set."""
    return bound_anew(node, name, "put", index(key), value)


def bound_anew(node: ast.stmt, name: str, change: str, *args: ast.expr) -> tuple[ast.stmt, ast.Expr]:
    """A change in place as a new value of the name, of which nobody knows the old one."""
    known = ast.Name(name, ast.Load())
    bind = ast.Assign([ast.Name(name, ast.Store())], call(change, node, known, *args))
    return ast.copy_location(bind, node), ast.copy_location(ast.Expr(call("settled", node, known)), node)


def filled_anew(node: ast.Expr, name: str, visited: Callable[[Any], Any]) -> tuple[ast.stmt, ast.Expr]:
    """An array into which numpy puts what a call gives, or some numbers."""
    value: Any = node.value
    others = [keyword for keyword in value.keywords if keyword.arg != "out"]
    if len(others) < len(value.keywords):
        made = ast.copy_location(ast.Call(value.func, value.args, others), value)
        return put(node, name, ast.Constant(...), visited(made))
    named = ast.Call(ast.Name("dict", ast.Load()), [], [*map(visited, others)])
    return bound_anew(node, name, "filled", ast.Constant(value.func.attr), named, *map(visited, value.args[1:]))


def put_held(node: ast.Assign) -> ast.stmt:
    """An element that is set of an array which an object holds, or a dictionary or a list."""
    match node.targets:
        case [ast.Subscript(array, key)] if found := _holder(array):
            return _set(node, key, *found)
    return node


def added_held(node: ast.AugAssign) -> ast.stmt:
    """The same of ``o.K[i] += x``, and ``o.K += x``."""
    operation = ast.Constant(OPERATIONS[type(node.op)])
    match node.target:
        case ast.Subscript(array, key) if found := _holder(array):
            return _set(node, key, *found, operation)
        case ast.Attribute(of, name):
            changed = call("changed_held", node, node.value, of, ast.Constant(name), operation)
            return ast.copy_location(ast.Expr(changed), node)
    return node


def _holder(array: ast.expr) -> tuple[ast.expr, ast.expr, bool] | None:
    """What holds an array, where, and whether by a name."""
    match array:
        case ast.Attribute(of, name):
            return of, ast.Constant(name), True
        case ast.Subscript(of, place):
            return of, index(place), False
        case ast.Call(ast.Name("recorded element"), [of, place]):
            return of, place, False
    return None


def _set(
    node: ast.Assign | ast.AugAssign, key: ast.expr, of: ast.expr, place: ast.expr, by_name: bool, *operation: ast.expr
) -> ast.stmt:
    changed = call("put_held", node, node.value, of, place, index(key), ast.Constant(by_name), *operation)
    return ast.copy_location(ast.Expr(changed), node)
