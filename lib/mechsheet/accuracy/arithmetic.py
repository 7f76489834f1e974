"""Arithmetic of 50 digits, the groups in it and condition numbers: what the library is measured against.

Positions come straight from the loop equations, derivatives from differences of the positions, reactions from the
system of all equations. The groups take numbers of any kind that knows `root` and `point`: mpmath's, of a context of
its own, whose precision nothing else changes, balls of as many bits, which are ten times faster, and others.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextvars import ContextVar
from functools import singledispatch, wraps
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import acb, arb, arb_mat
from mpmath import MPContext

from mechsheet.readers.balls import precision

DIGITS = 50
mp = MPContext()
mp.dps = 200  # differences with these steps keep DIGITS of them 1e-16 from a dead centre too
if TYPE_CHECKING:
    from mpmath import mpc as mpc
    from mpmath import mpf as mpf
else:
    mpf, mpc = mp.mpf, mp.mpc
sqrt, expj, nan = mp.sqrt, mp.expj, mp.nan
Numbers = dict[str, Any]  # results by name; a row of them is a list
STEP = mpf(10) ** -45  # for differences from both sides; its square for those from one
EPS = 2.0**-53  # relative error of one rounding
SLACK = 8 * mpf(EPS)  # within which an input may be another
_CHANGE = mpf(10) ** -40  # of an input, relative, for its condition number
_RIGHT = 4 + DIGITS * 10 // 3  # bits of a ball that make its digits
_WIDTH = arb(10) ** -DIGITS  # of a ball about zero


@singledispatch
def root(x: Any) -> Any:
    """The root of a number; NaN of one below zero."""
    return sqrt(x) if x >= 0 else nan


@singledispatch
def point(x: Any, y: Any) -> Any:
    """The complex number of two real ones."""
    return mpc(x, y)


root.register(arb, arb.sqrt)
point.register(arb, acb)


_in_balls: ContextVar[bool] = ContextVar("_in_balls", default=False)  # whether results are to stay in balls


def in_balls(f: Callable[..., Numbers]) -> Callable[..., Numbers]:
    """``f``, which computes in balls, with its results as mpmath's numbers, right to `DIGITS` digits.

    A ball that holds zero is zero. Raises ArithmeticError where one is too wide.
    """

    @wraps(f)
    def found(*args: Any, **named: Any) -> Numbers:
        with precision(mp.prec):
            made = f(*args, **named)
            return made if _in_balls.get() else {name: _centre(y) for name, y in made.items()}

    return found


def _centre(y: Any) -> Any:
    if isinstance(y, list):
        return [_centre(each) for each in y]
    if isinstance(y, acb):
        return mp.make_mpc((_middle(y.real), _middle(y.imag)))
    return mp.make_mpf(_middle(y))


def _middle(y: arb) -> Any:
    """The number in the midst of a ball, as mpmath holds it."""
    if y.rel_accuracy_bits() >= _RIGHT:
        return y._mpf_
    if not y.is_finite():
        return nan._mpf_
    if not abs(y) < _WIDTH:
        raise ArithmeticError(f"{y} is not known to {DIGITS} digits")
    return mp.zero._mpf_


def cross(a: Any, b: Any) -> Any:
    return a.real * b.imag - a.imag * b.real


def dot(a: Any, b: Any) -> Any:
    return a.real * b.real + a.imag * b.imag


def over(a: Any, b: Any) -> Any:
    """a / b; NaN where b is zero."""
    try:
        return a / b
    except ZeroDivisionError:  # of mpmath's numbers alone
        return a * nan


def rrr(A: Any, B: Any, r_A: Any, r_B: Any, branch: int) -> Any:
    """C with |C - A| = r_A and |C - B| = r_B, to the left (+1) of the line from A to B; NaN where none is."""
    d = B - A
    L2 = dot(d, d)
    along = (L2 + r_A**2 - r_B**2) / 2
    return A + point(along, root(r_A**2 * L2 - along**2) * branch) * over(d, L2)


def rrp(A: Any, B: Any, u: Any, r_A: Any, branch: int, e: Any) -> Any:
    """C with |C - A| = r_A at the distance e to the left of the line through B along u; NaN where none is."""
    u = u / root(dot(u, u))
    z = (A - B) / u
    return B + point(z.real + root(r_A**2 - (z.imag - e) ** 2) * branch, e) * u


def rpr(A: Any, B: Any, branch: int, e: Any) -> tuple[Any, Any]:
    """u and s with A - B = (s + i e) u; NaN where none is."""
    d = A - B
    s = root(dot(d, d) - e**2) * branch
    return over(d, point(s, e)), s


def lines(A: Any, B: Any, u_A: Any, u_B: Any) -> Any:
    """Crossing of the line through A along u_A with the line through B along u_B; NaN of parallel ones."""
    return A + over(u_A * cross(B - A, u_B), cross(u_A, u_B))


def derivatives(f: Callable[[mpf], mpc]) -> tuple[mpc, mpc]:
    """First and second derivative at t = 0."""
    return _value_and_derivatives(f)[1:]


def _value_and_derivatives(f: Callable[[mpf], mpc]) -> tuple[mpc, mpc, mpc]:
    ahead, here, behind = f(STEP), f(mpf(0)), f(-STEP)
    return here, (ahead - behind) / (2 * STEP), (ahead - 2 * here + behind) / STEP**2


def rotation(a: Callable[[mpf], mpc]) -> tuple[mpf, mpf]:
    """Angular velocity and acceleration of the vector a(t) at t = 0."""
    here, first, second = _value_and_derivatives(a)
    rate = first / here
    return rate.imag, (second / here - rate**2).imag


# --- equilibrium -----------------------------------------------------------------------------------------------


def equations(unknowns: list[list[tuple[Any, ...]]], loads: list[tuple[Any, ...]], poles: list[Any]) -> Any:
    """Matrix and right-hand side of the equilibrium of all bodies, for exact numbers and for arrays.

    A load is (body, force, point, couple); an unknown is the list of loads that its unit puts on the bodies. Moments
    of a body are taken about its pole.
    """

    def column(terms: list[tuple[Any, ...]]) -> list[Any]:
        sums = [0 * poles[0].real] * (3 * len(poles))
        for body, force, point, couple in terms:
            moment = couple + cross(point - poles[body], force)
            for k, part in enumerate((force.real, force.imag, moment), 3 * body):
                sums[k] = sums[k] + part
        return sums

    return [column(terms) for terms in unknowns], [-x for x in column(loads)]


def pin(P: Any, on: int, by: int | None = None) -> list[list[tuple[Any, ...]]]:
    """Unknown force components in a pin at P, on one body and opposite on the other (None: the frame)."""
    one = 1 + 0 * P
    return [_pair(force, P, 0, on, by) for force in (one, 1j * one)]


def slide(P: Any, u: Any, on: int, by: int | None = None) -> list[list[tuple[Any, ...]]]:
    """Unknown normal force through P and couple in a prismatic pair along the unit vector u."""
    return [_pair(1j * u, P, 0, on, by), _pair(0 * u, P, 1, on, by)]


def _pair(force: Any, P: Any, couple: Any, on: int, by: int | None) -> list[tuple[Any, ...]]:
    return [(on, force, P, couple)] + ([] if by is None else [(by, -force, P, -couple)])


def reactions(unknowns: Any, loads: Any, poles: Any) -> list[mpf]:
    """The unknowns at 50 digits."""
    with precision(mp.prec):
        return [_centre(x) for x in solved(unknowns, loads, poles)]


def solved(unknowns: Any, loads: Any, poles: Any) -> list[arb]:
    """The unknowns in balls; NaN where nothing but rounding parts the bodies from moving."""
    columns, right = equations(unknowns, loads, poles)
    try:
        return list(arb_mat(columns).transpose().solve(arb_mat([[x] for x in right])).entries())
    except ZeroDivisionError:
        return [arb.nan()] * len(right)


# --- how many digits a result can keep, and how many a number keeps of it ------------------------------------------


def conditions(f: Callable[..., Numbers], inputs: Mapping[str, Any]) -> Numbers:
    r"""Condition number of each result of ``f(**inputs)`` with respect to relative changes of the inputs.

    .. math:: \kappa = \sum_i \left| x_i \frac{\partial y}{\partial x_i} \right| / |y|

    To first order, inputs changed by at most eps each change the result by kappa eps at most: rounded once, they cost
    log10(kappa) of the 16 digits, whatever the method. Of a row of results, the greatest change over the greatest one.
    0/0 is 0: a result that is zero and stays so. Whole numbers count something and stay.
    """
    x = {name: mpf(value) for name, value in inputs.items()}
    token = _in_balls.set(True)  # what is subtracted need not be a number of mpmath's, which takes longer
    try:
        with precision(mp.prec):
            y = f(**x)
            sums = dict.fromkeys(y, 0.0)
            for name, value in x.items():
                if value and not isinstance(inputs[name], int):
                    changed = f(**{**x, name: value * (1 + _CHANGE)})
                    for result in y:
                        sums[result] += _change(changed[result], y[result])
            sizes = {name: max(abs(complex(part)) for part in _row(value)) for name, value in y.items()}
    finally:
        _in_balls.reset(token)
    return {name: sums[name] / size if size else float("inf" if sums[name] else 0) for name, size in sizes.items()}


def _change(there: Any, here: Any) -> float:
    """The greatest change of a row for a relative one of an input: a float, once it is subtracted."""
    return max(abs(complex(a - b)) for a, b in zip(_row(there), _row(here), strict=True)) / float(_CHANGE)


def undecided(f: Callable[..., Numbers], inputs: Mapping[str, Any]) -> set[str]:
    """Results of ``f(**inputs)`` that exist or not according to one more rounding of an input."""

    def existing(values: Mapping[str, Any]) -> set[str]:
        try:
            return {name for name, y in f(**values).items() if exist(y)}
        except ValueError:
            return set()

    x = {name: mpf(value) for name, value in inputs.items()}
    here = existing(x)
    changed = ({**x, name: value * (1 + way * SLACK)} for name, value in x.items() for way in (1, -1))
    return set[str]().union(*(here ^ existing(values) for values in changed))


def exist(y: Any) -> bool:
    """Whether a result, or every one of a row, is a finite number."""
    return all(map(mp.isfinite, _row(y)))


def error(value: Any, true: Any, turn: Any = None) -> mpf:
    """|value - true|, for a float, a complex number or the greatest of a row; ``turn`` is the period of an angle."""
    errors = [mpc(complex(v)) - y for v, y in zip(np.ravel(value), _row(true), strict=True)]
    if turn:
        errors = [(each.real + turn / 2) % turn - turn / 2 for each in errors]
    return _size(errors)


def relative_error(value: Any, true: Any, turn: Any = None) -> float:
    """`error` over |true|; infinite where a value that is not zero should be."""
    off, size = error(value, true, turn), _size(_row(true))
    return float(off / size) if size else float("inf" if off else 0)


def _row(y: Any) -> list[Any]:
    return y if isinstance(y, list) else [y]


def _size(row: Any) -> mpf:
    """The greatest magnitude of a row."""
    return max(map(abs, row))
