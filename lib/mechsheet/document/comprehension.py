"""What is computed for each element of something, in formulas: lists of it, sums and products; functions of a line."""

import ast
from itertools import chain

from mechsheet.document import mapped, names
from mechsheet.document.formula import (
    PRODUCT,
    RELATION,
    SUM,
    Apply,
    Binary,
    Brackets,
    Element,
    Node,
    Number,
    Prefix,
    Range,
    Sum,
    Text,
)
from mechsheet.document.functions import Reader, before

Each = ast.GeneratorExp | ast.ListComp
_OVER_ALL = ("max", "min", "any", "all")  # of what is computed for each


def over_each(reader: Reader, node: ast.Call) -> Node | None:
    """A sum, a product, the first, the greatest or the least of what is computed for each element.

    None for any other call.
    """
    match ast.Call(node.func, [*map(mapped.written_out, node.args)], node.keywords):
        case ast.Call(ast.Name("sum"), [ast.GeneratorExp() | ast.ListComp() as terms], []):
            return _sum(reader, terms, "∑")
        case ast.Call(ast.Name("prod"), [ast.GeneratorExp() | ast.ListComp() as terms], []):
            return _sum(reader, terms, "∏")
        case ast.Call(ast.Name("next"), [ast.GeneratorExp() as some], []):
            return Prefix(Text("first "), _each(reader, some), RELATION)
        case ast.Call(ast.Name("next"), [ast.GeneratorExp() as some, otherwise], []):
            is_none = isinstance(otherwise, ast.Constant) and otherwise.value is None
            other = Text(", else none") if is_none else Prefix(Text(", else "), reader.read(otherwise))
            return Prefix(Text("first "), Prefix(_each(reader, some), other), RELATION)
        case ast.Call(ast.Name(name), [ast.GeneratorExp(elt, [_] as loops)], []) if name in _OVER_ALL:
            inner = reader.without(_bound(loops))
            over = Binary(
                _index(inner, loops[0].target), "∈", _limited(inner, loops[0], _source(reader, loops[0].iter))
            )
            return Apply(Element(names.function(name), over), Brackets((inner.read(elt),)))
    return None


def listed(reader: Reader, node: Each) -> Node:
    """A list of what is computed for each element."""
    return Brackets((_each(reader, node, plainly=False),), "[]", high=True)


def _each(reader: Reader, node: Each, plainly: bool = True) -> Node:
    """What is computed for each element, or ``plainly`` the elements themselves where it is these."""
    inner = reader.without(_bound(node.generators))
    first, *more = (_of(inner, loop) for loop in node.generators)
    for loop in more:
        first = Prefix(first, Prefix(Text(" and "), loop), RELATION)
    if plainly and not more and ast.unparse(node.elt) == ast.unparse(node.generators[0].target):
        return first
    return Prefix(inner.read(node.elt), Prefix(Text(" for each "), first))


def function(reader: Reader, node: ast.Lambda) -> Node | None:
    """A function without a name: what it makes of its arguments."""
    args = node.args
    if args.vararg or args.kwarg or args.kwonlyargs or args.posonlyargs:
        return None
    inner = reader.without([a.arg for a in args.args])
    needed: list[Node] = [names.symbol(a.arg) for a in args.args[: len(args.args) - len(args.defaults)]]
    given = zip(args.args[len(needed) :], args.defaults, strict=True)
    told = (*needed, *(Binary(names.symbol(a.arg), "=", reader.least(value, SUM)) for a, value in given))
    return Binary(told[0] if len(told) == 1 and needed else Brackets(told), "↦", inner.least(node.body, SUM))


def _bound(loops: list[ast.comprehension]) -> list[str]:
    """Names that stand for elements."""
    return [n.id for n in chain(*(ast.walk(loop.target) for loop in loops)) if isinstance(n, ast.Name)]


def _of(reader: Reader, loop: ast.comprehension) -> Node:
    of = Prefix(_index(reader, loop.target), Prefix(Text(" of "), _elements(reader, loop.iter)), RELATION)
    for condition in loop.ifs:
        of = Prefix(of, Prefix(Text(" with "), reader.read(condition)), RELATION)
    return of


def _index(reader: Reader, node: ast.expr) -> Node:
    """What stands for an element, or for its parts, but those that nothing reads."""
    named = [part for part in getattr(node, "elts", [node]) if ast.unparse(part) != "_"]
    return reader.read(named[0]) if len(named) == 1 else Brackets(tuple(map(reader.read, named)))


def _elements(reader: Reader, node: ast.expr) -> Node:
    """What has elements; numbers stand for symbols where it is numbers from one to another."""
    is_range = isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range"
    return (reader if is_range else reader.symbols()).read(node)


def _source(reader: Reader, node: ast.expr) -> Node:
    """What elements are of; numbers from one to another in brackets of a set."""
    part = _elements(reader, node)
    return Brackets((part,), "{}") if isinstance(part, Range) else part


def _limited(reader: Reader, loop: ast.comprehension, source: Node) -> Node:
    """Elements of something that keep the conditions."""
    for condition in loop.ifs:
        source = Binary(source, ",", reader.read(condition))
    return source


def _sum(reader: Reader, terms: Each, sign: str) -> Node:
    """A sum over the elements of something, or over whole numbers."""
    inner = reader.without(_bound(terms.generators))
    whole = inner.least(terms.elt, PRODUCT)
    for n, loop in reversed([*enumerate(terms.generators)]):
        outer = reader.without(_bound(terms.generators[:n]))
        match loop:
            case ast.comprehension(ast.Name() as index, ast.Call(ast.Name("range"), [stop] | [_, stop] as ends), []):
                first = outer.read(ends[0]) if len(ends) == 2 else Number(0)
                start = ends[0] if len(ends) == 2 else None
                whole = Sum(whole, inner.read(index), first, before(outer, stop, start), sign)
            case _:
                source = _limited(inner, loop, _source(outer, loop.iter))
                whole = Sum(whole, _index(inner, loop.target), source, sign=sign)
    return whole
