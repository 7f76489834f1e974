"""How many digits a result can keep, and how many a number keeps of it: condition numbers and errors at 50 digits."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from mechsheet.accuracy.arithmetic import SLACK, Numbers, mp, mpc, mpf

_CHANGE = mpf(10) ** -40  # of an input, relative


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
                sums[result] += _size(map(mp.fsub, _row(changed[result]), _row(y[result]))) / _CHANGE
    sizes = {name: _size(_row(value)) for name, value in y.items()}
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
    changed = ({**x, name: value * (1 + way * SLACK)} for name, value in x.items() for way in (1, -1))
    return set[str]().union(*(here ^ existing(values) for values in changed))


def exist(y: Any) -> bool:
    """Whether a result, or every one of a row, is a finite number."""
    return all(map(mp.isfinite, _row(y)))


def relative_error(value: Any, true: Any, turn: Any = None) -> float:
    """|value - true| / |true|, for a float, a complex number or a row of them; ``turn`` is the period of an angle.

    Infinite where a value that is not zero should be.
    """
    errors = [mpc(complex(v)) - y for v, y in zip(np.ravel(value), _row(true), strict=True)]
    if turn:
        errors = [(error.real + turn / 2) % turn - turn / 2 for error in errors]
    error, size = _size(errors), _size(_row(true))
    return float(error / size) if size else float("inf" if error else 0)


def _row(y: Any) -> list[Any]:
    return y if isinstance(y, list) else [y]


def _size(row: Any) -> mpf:
    """The greatest magnitude of a row."""
    return max(map(abs, row))
