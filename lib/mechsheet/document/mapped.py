"""`map`, `filter`, `np.r_` and `np.c_` in formulas: what is computed for each element, kept or put together."""

import ast
from collections.abc import Iterable


def written_out(node: ast.expr) -> ast.expr:
    """The comprehension or list that such a thing is, without a list round it; anything else as it is.

    >>> def of(text):
    ...     return ast.unparse(written_out(ast.parse(text, mode="eval").body))
    >>> of("list(map(lambda q: 2 * q, D))"), of("map(f, x, y)")
    ('(2 * q for q in D)', '(f(t, s) for t, s in zip(x, y))')
    >>> of("filter(lambda q: q > a, D)"), of("filter(None, D)"), of("list(D)"), of("[*D]")
    ('(q for q in D if q > a)', '(x for x in D if x != 0)', 'D', 'D')
    >>> of("np.r_[0, x, L]"), of("np.c_[x, y]"), of("np.r_[:L, 0:1:5j]")
    ('[0, x, L]', '[[x, y]]', '[arange(0, L), linspace(0, 1, 5)]')
    """
    match node:
        case ast.Call(ast.Name("list" | "tuple"), [ast.expr() as of], []) | ast.List([ast.Starred(of)]):
            return written_out(of)
        case ast.Call(ast.Name("map"), [f, *of], []) if of and not any(isinstance(a, ast.Starred) for a in (f, *of)):
            arguments, value = _of_each(f, len(of), of)
            if len(of) == 1:
                return _each(value, arguments[0], of[0])
            return _each(value, ast.Tuple([*arguments]), ast.Call(ast.Name("zip"), of, []))
        case ast.Call(ast.Name("filter"), [ast.Constant(None), of], []):
            [one], _ = _of_each(ast.Name("bool"), 1, [of])
            return _each(one, one, of, ast.Compare(one, [ast.NotEq()], [ast.Constant(0)]))
        case ast.Call(ast.Name("filter"), [f, of], []):
            [one], condition = _of_each(f, 1, [of])
            return _each(one, one, of, condition)
        case ast.Subscript(ast.Attribute(ast.Name("np" | "numpy"), "r_" | "c_" as kind), key):
            row = ast.List([*map(_numbers, key.elts if isinstance(key, ast.Tuple) else [key])], ast.Load())
            return row if kind == "r_" else ast.List([row], ast.Load())
    return node


def _numbers(key: ast.expr) -> ast.expr:
    """The call that gives the numbers of a slice, as many as an imaginary step says; anything else as it is."""
    if not isinstance(key, ast.Slice) or not key.upper:
        return key
    start = key.lower or ast.Constant(0)
    if isinstance(key.step, ast.Constant) and isinstance(key.step.value, complex):
        return ast.Call(ast.Name("linspace"), [start, key.upper, ast.Constant(int(abs(key.step.value)))], [])
    step = [key.step] if key.step else []
    return ast.Call(ast.Name("arange"), [start, key.upper, *step], [])


def _each(value: ast.expr, one: ast.expr, of: ast.expr, *conditions: ast.expr) -> ast.GeneratorExp:
    return ast.GeneratorExp(value, [ast.comprehension(one, of, [*conditions], 0)])


def _of_each(f: ast.expr, count: int, of: Iterable[ast.expr]) -> tuple[list[ast.Name], ast.expr]:
    """Names of so many elements, and what a function makes of them: those of its own where it tells them."""
    match f:
        case ast.Lambda(ast.arguments([], own, None, [], [], None, []), body) if len(own) == count:
            return [ast.Name(a.arg) for a in own], body
    used = {node.id for part in (f, *of) for node in ast.walk(part) if isinstance(node, ast.Name)}
    names = [ast.Name(letter) for letter in "xtsuvwyzabcdehijklmnopqr" if letter not in used][:count]
    return names, ast.Call(f, [*names], [])
