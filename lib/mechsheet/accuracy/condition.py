"""How many digits a result can keep, and how many a number keeps of it: condition numbers and errors at 50 digits."""

from collections.abc import Callable, Mapping
from typing import Any

from mechsheet.accuracy.arithmetic import Numbers, mp, mpc, mpf

_CHANGE = mpf(10) ** -40  # of an input, relative
_ROUNDING = mpf(2) ** -50


def conditions(f: Callable[..., Numbers], inputs: Mapping[str, Any]) -> Numbers:
    r"""Condition number of each result of ``f(**inputs)`` with respect to relative changes of the inputs.

    .. math:: \kappa = \sum_i \left| x_i \frac{\partial y}{\partial x_i} \right| / |y|

    To first order, inputs changed by at most eps each change the result by kappa eps at most: rounded once, they cost
    log10(kappa) of the 16 digits, whatever the method. Of a row of results, the greatest change over the greatest one.
    0/0 is 0: a result that is zero and stays so. Whole numbers count something and stay.
    """
    x = {name: mpf(value) for name, value in inputs.items()}
    y = f(**x)
    sums = dict.fromkeys(y, mpf(0))
    for name, value in x.items():
        if value and not isinstance(inputs[name], int):
            changed = f(**{**x, name: value * (1 + _CHANGE)})
            for result in y:
                sums[result] += _size(_difference(changed[result], y[result])) / _CHANGE
    sizes = {name: _size(value) for name, value in y.items()}
    return {name: sums[name] / size if size else mpf("inf" if sums[name] else 0) for name, size in sizes.items()}


def undecided(f: Callable[..., Numbers], inputs: Mapping[str, Any]) -> set[str]:
    """Results of ``f(**inputs)`` that exist or not according to one more rounding of an input."""

    def existing(values: Mapping[str, Any]) -> set[str]:
        try:
            return {name for name, y in f(**values).items() if exist(y)}
        except ValueError:
            return set()

    x = {name: mpf(value) for name, value in inputs.items()}
    here = existing(x)
    changed = ({**x, name: value * (1 + way * _ROUNDING)} for name, value in x.items() for way in (1, -1))
    return set[str]().union(*(here ^ existing(values) for values in changed))


def exist(y: Any) -> bool:
    """Whether a result, or every one of a row, is a finite number."""
    return all(map(mp.isfinite, y)) if isinstance(y, list) else bool(mp.isfinite(y))


def relative_error(value: Any, true: Any, turn: Any = None) -> float:
    """|value - true| / |true|, for a float, a complex number or a row of them; ``turn`` is the period of an angle.

    Infinite where a value that is not zero should be.
    """
    row = isinstance(true, list)
    error = _difference([mpc(complex(v)) for v in value] if row else mpc(complex(value)), true)
    if turn:
        error = mpc((error.real + turn / 2) % turn - turn / 2)
    size = _size(true)
    return float(_size(error) / size) if size else float("inf" if _size(error) else 0)


def _difference(a: Any, b: Any) -> Any:
    return [p - q for p, q in zip(a, b, strict=True)] if isinstance(b, list) else a - b


def _size(y: Any) -> mpf:
    """Magnitude of a number, or the greatest one of a row."""
    return max(map(abs, y)) if isinstance(y, list) else abs(y)
