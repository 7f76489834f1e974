"""Matrix products and systems of linear equations of recorded quantities."""

import operator
from collections.abc import Callable, Sequence
from functools import partial, reduce
from itertools import combinations
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import absolute, choice, is_zero, only_where
from mechsheet.quantities.array_rules import ordered
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import bottom_up
from mechsheet.quantities.quantity import Quantity, joined, lift, moved
from mechsheet.quantities.truths import summed

_MOST = 40  # equations, far fewer where most coefficients are no zeros: what a line may compute ends it before
_OF_STRESS, _OF_FRAME = 3, 8  # rows of a symmetric matrix whose eigenvalues are recorded; the last where no cell is
_NONE = 1e-20  # of all elements together: no digit of an eigenvalue, and no number in cells once it is squared
_SWEEPS = 5, 10  # of Jacobi's rotations: of three rows the third one reaches the last digits, of eight the eighth
_TOO_MANY = f"a system of more than {_MOST} linear equations"


def product(graph: Graph, x: Any, y: Any) -> Any:
    """The matrix product, as numpy's matmul and dot have it for one and two axes."""
    x, y = lift(graph, x), lift(graph, y)
    if not x.ndim or not y.ndim:
        return x * y
    together = summed(x, y)
    if y.ndim == 1:
        graph.go_together(*x.parts, *y.parts, strictly=True)
        return (x * y).reduced(together, -1)
    if x.ndim == 1:
        return (x[:, None] * y).reduced(together, -2)
    return (x[..., :, :, None] * y[..., None, :, :]).reduced(together, -2)


def outer(graph: Graph, x: Any, y: Any) -> Any:
    return lift(graph, x).reshape(-1, 1) * lift(graph, y).reshape(-1)


def kron(graph: Graph, x: Any, y: Any) -> Any:
    x, y = lift(graph, x), lift(graph, y)
    if x.ndim != y.ndim or x.ndim not in (1, 2):
        raise NotRecorded("numpy's kron of other than two vectors or two matrices")
    if x.ndim == 1:
        return (x[:, None] * y).reshape(-1)
    rows, columns = len(x) * len(y), len(x[0]) * len(y[0])
    return (x[:, None, :, None] * y[None, :, None, :]).reshape(rows, columns)


def inverse(graph: Graph, A: Any) -> Any:
    A = lift(graph, A)
    return solution(graph, A, np.eye(A.shape[-1]))


def diagonal(graph: Graph, x: Any, k: int = 0) -> Any:
    """numpy's diag: that of a matrix, or a matrix of it."""
    x = lift(graph, x)
    if x.ndim > 1:
        return np.diagonal(x, k)
    if not k:
        return choice(graph, np.eye(len(x), dtype=bool), x[:, None], 0.0)
    each = x[np.minimum(np.arange(len(x) + abs(k)), len(x) - 1)]
    return choice(graph, np.eye(len(each), k=k, dtype=bool), each[:, None] if k > 0 else each, 0.0)


def upper(graph: Graph, x: Any, k: int = 0) -> Any:
    """numpy's triu."""
    x = lift(graph, x)
    return choice(graph, np.tri(len(x), len(x[0]), k - 1, dtype=bool), 0.0, x)


def lower(graph: Graph, x: Any, k: int = 0) -> Any:
    """numpy's tril."""
    x = lift(graph, x)
    return choice(graph, np.tri(len(x), len(x[0]), k, dtype=bool), x, 0.0)


def matrix_power(graph: Graph, A: Any, n: Any) -> Any:
    A, count = lift(graph, A), int(n)
    if count < 1:
        raise NotRecorded("a power of a matrix that is less than 1")
    result = A
    for _ in range(count - 1):
        result = product(graph, result, A)
    return result


def blocks(graph: Graph, *matrices: Any) -> Any:
    """scipy's block_diag."""
    parts = [lift(graph, matrix) for matrix in matrices]
    parts = [part if part.ndim > 1 else part.reshape(1, -1) for part in parts]
    ends = np.cumsum([(0, 0), *((len(part), len(part[0])) for part in parts)], axis=0)
    flat = joined([part.reshape(-1) for part in parts], np.concatenate)
    places, at = np.full(ends[-1], -1), 0
    for (top, left), part in zip(ends.tolist(), parts, strict=False):
        rows, columns = len(part), len(part[0])
        places[top : top + rows, left : left + columns] = np.arange(at, at + rows * columns).reshape(rows, columns)
        at += rows * columns
    return choice(graph, places >= 0, flat[np.maximum(places, 0)], 0.0)


def products(graph: Graph, arrays: Any) -> Any:
    """numpy's multi_dot."""
    return reduce(partial(product, graph), arrays)


def transformed(f: Callable[..., Any]) -> Callable[..., Any]:
    """One of numpy's Fourier transforms, of as many numbers as there are: sums with fixed factors."""

    def rule(graph: Graph, x: Any, *options: Any, **named: Any) -> Any:
        x = lift(graph, x)
        if options or named or x.ndim != 1 or any(part.stretches for part in x.parts):
            raise NotRecorded(f"numpy's {f.__name__} but of one row of so many numbers, without options")
        parts = zip((1, 1j), x.parts, strict=False)
        return sum(product(graph, f(unit * np.eye(x.extent[0])).T, Quantity(graph, part)) for unit, part in parts)

    return rule


def _rows(graph: Graph, A: Any) -> list[list[Any]]:
    """The elements of square matrices on the last axes, by rows."""
    A = lift(graph, A)
    size = A.shape[-1]
    if A.ndim < 2 or A.shape[-2] != size or size > _MOST:
        raise NotRecorded(_TOO_MANY)
    return [[A[..., i, j] for j in range(size)] for i in range(size)]


def _eliminated(graph: Graph, rows: list[list[Any]], exist: bool = True) -> tuple[list[list[Any]], Any, bool]:
    """Upper triangles of square matrices, the signs of their rows' orders, and whether steps were left out.

    Where no pivot ``exist``s all below it are 0 too, and there is nothing to do, or else no number.

    The greatest pivots come first. Right sides that stand behind the matrices in their rows are changed with them. An
    element that is 0 whatever the inputs are takes no step: of frames and chains of springs most are.
    """
    size, short = len(rows), False
    if size > _MOST:
        raise NotRecorded(_TOO_MANY)
    sign = lift(graph, 1.0)
    for j in range(size):
        under = [i for i in range(j + 1, size) if not is_zero(rows[i][j])]
        short = short or len(under) < size - j - 1
        for i in under:
            greater = absolute(rows[i][j]) > absolute(rows[j][j])
            graph.pivots.update(greater.parts)
            sign = choice(graph, greater, -sign, sign)
            pairs = list(zip(rows[j], rows[i], strict=True))
            rows[j], rows[i] = (
                [choice(graph, greater, q, p) for p, q in pairs], [choice(graph, greater, p, q) for p, q in pairs]
            )  # fmt: skip
        for i in under:
            part = rows[i][j] / rows[j][j] if exist else choice(graph, rows[j][j] == 0, 0.0, rows[i][j] / rows[j][j])
            rows[i] = [
                p - part * q if k > j and not is_zero(q) else p
                for k, (p, q) in enumerate(zip(rows[i], rows[j], strict=True))
            ]
    return rows, sign, short


def solved_rows(graph: Graph, rows: list[list[Any]]) -> list[list[Any]]:
    """The unknowns of square linear equations for each of the right sides that stand behind them in their rows.

    Without a pivot none of them is a number, nor with a right side that is none.
    """
    size = len(rows)
    rows, _, short = _eliminated(graph, rows)
    solved = list[list[Any]]()
    for k in range(size, len(rows[0])):
        x: list[Any] = [None] * size
        for i in reversed(range(size)):
            rest = rows[i][k]
            for j in range(i + 1, size):
                rest = rest if is_zero(rows[i][j]) else rest - rows[i][j] * x[j]
            x[i] = rest / rows[i][i]
        if short:
            exist = [absolute(rows[i][i]) > 0 for i in range(size)] + [np.isfinite(rows[i][k]) for i in range(size)]
            solvable = reduce(operator.and_, exist)
            x = [only_where(graph, solvable, each) for each in x]
        solved.append(x)
    return solved


def solution(graph: Graph, A: Any, b: Any) -> Any:
    b = lift(graph, b)
    vector = b.ndim == 1
    if vector:
        graph.go_together(*lift(graph, A).parts, *b.parts, strictly=True)
    columns = [b] if vector else [b[..., k] for k in range(b.shape[-1])]
    solved = solved_rows(graph, [[*row, *(c[..., i] for c in columns)] for i, row in enumerate(_rows(graph, A))])
    if vector:
        return moved(lift(graph, solved[0]), 0, -1)
    return moved(lift(graph, [lift(graph, list(row)) for row in zip(*solved, strict=True)]), (0, 1), (-2, -1))


def determinant(graph: Graph, A: Any) -> Any:
    rows, sign, _ = _eliminated(graph, _rows(graph, A), exist=False)
    for i, row in enumerate(rows):
        sign = sign * row[i]
    return lift(graph, sign)


def cholesky(graph: Graph, A: Any, *, upper: bool = False) -> Any:
    """numpy's cholesky; nothing of a matrix that is not positive definite."""
    factor, exists = _triangle(graph, A, "U" if upper else "L")
    whole = moved(lift(graph, [lift(graph, row) for row in factor]), (0, 1), (-2, -1))
    whole = only_where(graph, exists, whole)
    return np.swapaxes(whole, -1, -2) if upper else whole


def _triangle(graph: Graph, A: Any, UPLO: str) -> tuple[list[list[Any]], Any]:
    """Rows of the lower triangle of which a symmetric matrix is the square, and where it is positive definite."""
    a, exists = _symmetric(graph, A, UPLO), lift(graph, True)
    found = [[lift(graph, 0.0)] * len(a) for _ in a]
    for j in range(len(a)):
        for i in range(j, len(a)):
            rest = reduce(operator.sub, (found[i][k] * found[j][k] for k in range(j)), a[i][j])
            if i == j:
                exists = exists & (rest > 0)
            found[i][j] = np.sqrt(rest) if i == j else rest / found[j][j]
    return found, exists


def _symmetric(graph: Graph, A: Any, UPLO: str) -> list[list[Any]]:
    """Rows of real symmetric matrices, of which one triangle is read."""
    a = _rows(graph, A)
    if any(x.im is not None for row in a for x in row):
        raise NotRecorded("a symmetric matrix of complex numbers")
    side = max if UPLO == "L" else min
    return [[a[side(i, j)][i + j - side(i, j)] for j in range(len(a))] for i in range(len(a))]


def _eigenvalues(graph: Graph, a: list[list[Any]]) -> Any:
    """Eigenvalues of symmetric matrices of some rows, in order, by Jacobi's rotations: right to rounding.

    The closed form of three loses half of the digits where two are nearly the same.
    """
    most = _OF_FRAME if graph.refuses else _OF_STRESS
    if len(a) > most:
        raise NotRecorded(f"eigenvalues of a matrix of more than {most} rows")
    pairs = list(combinations(range(len(a)), 2))
    sweeps = 1 if len(a) < 3 else _SWEEPS[len(a) > _OF_STRESS]
    none = _NONE * reduce(operator.add, (absolute(a[i][j]) for i in range(len(a)) for j in range(i, len(a))))
    for p, q in pairs * sweeps:
        off, apart = a[p][q], a[q][q] - a[p][p]
        way = choice(graph, apart < 0, -2.0, 2.0) * off
        turn = choice(graph, absolute(off) <= none, 0.0, way / (absolute(apart) + np.hypot(apart, 2 * off)))
        c = 1 / np.sqrt(1 + turn**2)
        a[p][p], a[q][q] = a[p][p] - turn * off, a[q][q] + turn * off
        for r in {*range(len(a))} - {p, q}:
            x, y = a[min(r, p)][max(r, p)], a[min(r, q)][max(r, q)]
            a[min(r, p)][max(r, p)], a[min(r, q)][max(r, q)] = c * (x - turn * y), c * (turn * x + y)
        a[p][q] = lift(graph, 0.0)
    return ordered(graph, moved(lift(graph, [a[k][k] for k in range(len(a))]), 0, -1))


def eigenvalues(graph: Graph, A: Any, UPLO: str = "L") -> Any:
    """numpy's eigvalsh."""
    return _eigenvalues(graph, _symmetric(graph, A, UPLO))


def eigenvalues_over(graph: Graph, A: Any, B: Any = None, *, lower: bool = True) -> Any:
    """scipy's eigvalsh: of one matrix, or over another one, which is positive definite."""
    side = "L" if lower else "U"
    if B is None:
        return eigenvalues(graph, A, side)
    factor, exists = _triangle(graph, B, side)
    half = _forward(factor, _symmetric(graph, A, side))
    over = _forward(factor, [list(row) for row in zip(*half, strict=True)])
    return only_where(graph, exists, _eigenvalues(graph, over))


def _forward(factor: list[list[Any]], rows: list[list[Any]]) -> list[list[Any]]:
    """What a lower triangle makes to some rows."""
    found = list[list[Any]]()
    for i, row in enumerate(rows):
        rests = (reduce(operator.sub, (factor[i][k] * found[k][n] for k in range(i)), x) for n, x in enumerate(row))
        found.append([rest / factor[i][i] for rest in rests])
    return found


class Eigen(Sequence[Any]):
    """Eigenvalues and -vectors, of which only those of now are known: their sign is as the library's steps end."""

    def __init__(self, values: Callable[[], Any], vectors: Callable[[], Any], of: Sequence[Quantity]) -> None:
        self._values, self._vectors, self._of = values, vectors, of

    @property
    def eigenvalues(self) -> Any:
        return self._values()

    @property
    def eigenvectors(self) -> Any:
        graph = self._of[0].graph
        parts = [part for each in self._of for part in each.parts]
        under = [node for node in bottom_up(parts, ()) if node.op == "input"]
        found = graph.exported(under, self._vectors())
        graph.untold[found] = "eigenvectors: their sign is as the library's own steps end"
        return Quantity(graph, found)

    def __len__(self) -> int:
        return 2

    def __getitem__(self, key: Any) -> Any:
        return (self.eigenvalues if key in (0, -2) else self.eigenvectors) if key in (0, 1, -1, -2) else ()[key]


def eigen(graph: Graph, A: Any, UPLO: Any = "L") -> Eigen:
    """numpy's eigh."""
    matrix = lift(graph, A)
    return Eigen(lambda: eigenvalues(graph, matrix, UPLO), lambda: np.linalg.eigh(matrix.value, UPLO)[1], [matrix])


def eigen_over(graph: Graph, A: Any, B: Any = None, *, lower: bool = True, eigvals_only: bool = False) -> Any:
    """scipy's eigh: of one matrix, or over another one."""
    if eigvals_only:
        return eigenvalues_over(graph, A, B, lower=lower)
    of = [lift(graph, matrix) for matrix in (A, B) if matrix is not None]

    def vectors() -> Any:
        from scipy.linalg import eigh  # on use: the worksheet has it

        return eigh(*(matrix.value for matrix in of), lower=lower)[1]

    return Eigen(lambda: eigenvalues_over(graph, A, B, lower=lower), vectors, of)
