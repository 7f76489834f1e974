"""What is true or false in arithmetic: a sum of numpy's is whether any holds, one of Python's how many of them do."""

from collections.abc import Callable
from typing import Any

from mechsheet.quantities.arithmetic import add, elementwise, is_whole, multiply
from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.refused import is_pythons

_AND, _OR, _NOT = map(elementwise, ("and", "or", "not"))


def are_truths(*several: Quantity) -> bool:
    return all(x.dtype == bool for x in several)


def added(x: Quantity, y: Quantity) -> Quantity:
    if not are_truths(x, y):
        return add(x, y)
    if x.ndim or y.ndim:
        return _OR(x, y)
    total = add(x, y)
    if not all(is_pythons(x.graph, part) for part in (x.re, y.re)) and _AND(x, y).seen():
        raise NotRecorded("a sum of two truths, which is another number where these are numpy's")
    return total


def multiplied(x: Quantity, y: Quantity) -> Quantity:
    return _AND(x, y) if are_truths(x, y) and (x.ndim or y.ndim) else multiply(x, y)


def summed(x: Quantity, y: Quantity) -> str:
    """What numpy reduces the products of two arrays by: of truths to whether any of them holds."""
    return "any" if are_truths(x, y) else "sum"


def logical(of: Callable[..., Quantity]) -> Callable[..., Quantity]:
    """A logical function of numpy, of whatever may be 0 or not."""
    return lambda *several: of(*(x if are_truths(x) else x != 0 for x in several))


def bitwise(name: str, of: Callable[..., Quantity]) -> Callable[..., Any]:
    """A bitwise one, of truths: Python has bits of whole numbers too, and of no others."""

    def operation(*several: Quantity) -> Quantity:
        if any(x.dtype != bool and is_whole(x) for x in several):
            raise NotRecorded(f"{name} of numbers")
        return of(*several)

    return operation


def _xor(x: Quantity, y: Quantity) -> Quantity:
    return _AND(_OR(x, y), _NOT(_AND(x, y)))


LOGICAL = {"and": _AND, "or": _OR, "not": _NOT, "xor": _xor}
