"""Code of a worksheet or of the mechanics, rewritten so that what Python decides by itself can be recorded.

A choice between two numbers, an element that a quantity points at, an element that is set and Python's own functions of
numbers are calls then, which `choices` answers. Statements such as ``if`` stay: which way they went is a guard.
"""

import ast
import inspect
import pickle
import textwrap
from types import CodeType, FunctionType
from typing import Any

from mechsheet.recording.choices import CALLS
from mechsheet.worksheet.cells import bound

_NAMES = {"float", "int", "complex", "max", "min", "pow", "round"}
_SCOPED = ast.NamedExpr, ast.Yield, ast.YieldFrom, ast.Await  # are not what they are inside a lambda


class _Rewriting(ast.NodeTransformer):
    def visit_Import(self, node: ast.Import | ast.ImportFrom) -> list[ast.stmt]:
        """What an import statement binds is exchanged at once."""
        names = [name for name in bound(node) if name != "*"]
        exchanged = [
            ast.Assign([ast.Name(name, ast.Store())], _call("imported", node, ast.Name(name, ast.Load())))
            for name in names
        ]
        return [node, *(ast.copy_location(line, node) for line in exchanged)]

    visit_ImportFrom = visit_Import

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in _NAMES:
            node.func = ast.copy_location(ast.Name(f"recorded {node.func.id}", ast.Load()), node.func)
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        self.generic_visit(node)
        if not isinstance(node.ctx, ast.Load) or isinstance(node.slice, ast.Slice | ast.Tuple | ast.Constant):
            return node
        return _call("element", node, node.value, node.slice)

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        self.generic_visit(node)
        if any(isinstance(n, _SCOPED) for n in ast.walk(node)):
            return node
        return _call("choice", node, node.test, _later(node.body), _later(node.orelse))

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        self.generic_visit(node)
        if any(isinstance(n, _SCOPED) for n in ast.walk(node)):
            return node
        return _call("and" if isinstance(node.op, ast.And) else "or", node, *map(_later, node.values))

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        if len(node.ops) == 1:
            return node
        sides = [node.left, *node.comparators]
        pairs = zip(sides, node.ops, sides[1:], strict=False)
        parts = [ast.copy_location(ast.Compare(a, [op], [b]), node) for a, op, b in pairs]
        return _call("and", node, *map(_later, parts))

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        self.generic_visit(node)
        return _call("not", node, node.operand) if isinstance(node.op, ast.Not) else node

    def visit_Assign(self, node: ast.Assign) -> Any:
        self.generic_visit(node)
        match node.targets:
            case [ast.Subscript(ast.Name(name), key)]:
                return _put(node, name, key, node.value)
            case [ast.Attribute(ast.Name(name), ("real" | "imag") as part)]:
                return _bound_anew(node, name, "part", ast.Constant(part), node.value)
        return node

    def visit_AugAssign(self, node: ast.AugAssign) -> Any:
        self.generic_visit(node)
        match node.target:
            case ast.Subscript(ast.Name(name), key):
                old = _call("element", node, ast.Name(name, ast.Load()), key)
                return _put(node, name, key, ast.BinOp(old, node.op, node.value))
            case ast.Name(name):
                return _bound_anew(node, name, "changed", ast.Constant(_OPERATIONS[type(node.op)]), node.value)
        return node

    def visit_ExceptHandler(self, node: ast.ExceptHandler) -> ast.AST:
        self.generic_visit(node)
        node.name = node.name or "_error"
        node.body.insert(0, ast.Expr(_call("handled", node, ast.Name(node.name, ast.Load()))))
        return node


_OPERATIONS = {
    ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "truediv", ast.FloorDiv: "floordiv", ast.Mod: "mod",
    ast.Pow: "pow", ast.MatMult: "matmul", ast.LShift: "lshift", ast.RShift: "rshift", ast.BitAnd: "and_",
    ast.BitOr: "or_", ast.BitXor: "xor",
}  # fmt: skip


def _put(node: ast.stmt, name: str, key: ast.expr, value: ast.expr) -> list[ast.stmt]:
    return _bound_anew(node, name, "put", _index(key), value)


def _bound_anew(node: ast.stmt, name: str, change: str, *args: ast.expr) -> list[ast.stmt]:
    """A change in place as a new value of the name, of which nobody knows the old one."""
    known = ast.Name(name, ast.Load())
    bind = ast.Assign([ast.Name(name, ast.Store())], _call(change, node, known, *args))
    return [ast.copy_location(bind, node), ast.copy_location(ast.Expr(_call("settled", node, known)), node)]


def _index(key: ast.expr) -> ast.expr:
    """An index as a value: slices are calls of ``slice`` outside of brackets."""
    if isinstance(key, ast.Slice):
        ends = [end or ast.Constant(None) for end in (key.lower, key.upper, key.step)]
        return ast.Call(ast.Name("slice", ast.Load()), ends, [])
    return ast.Tuple([_index(k) for k in key.elts], ast.Load()) if isinstance(key, ast.Tuple) else key


def _later(value: ast.expr) -> ast.expr:
    nothing = ast.arguments([], [], None, [], [], None, [])
    return ast.copy_location(ast.Lambda(nothing, value), value)


def _call(name: str, at: ast.AST, *args: ast.expr) -> ast.Call:
    call = ast.Call(ast.Name(f"recorded {name}", ast.Load()), list(args), [])
    return ast.copy_location(call, at)


def compiled(statement: ast.stmt, path: str) -> CodeType:
    """Code of a statement, to be run among the names of `CALLS`; the statement itself is not changed."""
    tree = ast.Module([pickle.loads(pickle.dumps(statement))], [])
    return compile(ast.fix_missing_locations(_Rewriting().visit(tree)), path, "exec")


def rebuilt(f: FunctionType, names: dict[str, Any]) -> FunctionType:
    """A function among other names, rewritten; a function of a class or inside another one is not rewritten."""
    if not f.__closure__ and "." not in f.__qualname__:
        lines, start = inspect.getsourcelines(f)
        tree = ast.parse(textwrap.dedent("".join(lines)))
        ast.increment_lineno(tree, start - 1)
        match tree.body:
            case [ast.FunctionDef() as written]:
                written.decorator_list, written.returns = [], None
                given = written.args
                for argument in (*given.args, *given.kwonlyargs, *given.posonlyargs, given.vararg, given.kwarg):
                    if argument:
                        argument.annotation = None
                given.defaults, given.kw_defaults = [], [None] * len(given.kw_defaults)
                own = names | {}
                exec(compiled(written, f.__code__.co_filename), own)
                code = own[f.__name__].__code__
                return _with(code, names, f)
    return _with(f.__code__, names, f)


def _with(code: CodeType, names: dict[str, Any], f: FunctionType) -> FunctionType:
    new = FunctionType(code, names, f.__name__, f.__defaults__, f.__closure__)
    new.__kwdefaults__ = f.__kwdefaults__
    return new


NAMES = {f"recorded {name}": function for name, function in CALLS.items()}
