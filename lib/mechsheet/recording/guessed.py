"""Roots that scipy finds from a guess, of one equation or of several, while a worksheet is recorded.

Other ways than scipy's own lead to the same root where along the first of Newton's steps from the guess the slope keeps
its sign, or several equations are nearly straight, the second step is much shorter, and the root is no farther than two
of it. Elsewhere there is no number.
"""

import inspect
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.array_rules import of_any_unit
from mechsheet.quantities.graph import Graph, Label, NotRecorded, current
from mechsheet.quantities.node import Block
from mechsheet.quantities.quantity import Quantity, lift, stack
from mechsheet.readers import derived, stepped
from mechsheet.readers.replaced import replaced
from mechsheet.recording import solving

Note = Callable[[solving.Solving], Any]

GUESSED = frozenset({"fsolve", "newton", "root", "root_scalar"})
_ALONE = ("newton", "root_scalar")  # which find a single number
_BESIDE = {"fprime", "fprime2", "jac"}  # slopes, which lead to the same root
_BESIDE |= {"xtol", "rtol", "tol", "maxiter", "maxfev", "disp", "method", "options"}  # as it will be solved again
_BENT = 0.4  # first steps by which what is left on the way of it is off a straight one
_PARTS = tuple(n / 8 for n in range(1, 9))  # of the first step
_ROUNDED = 1e-9  # sizes of the unknowns that a step may be long in any case


def guessed(f: Callable[..., Any], note: Note, between: Callable[..., Any], *args: Any, **named: Any) -> Any:
    """What one of scipy's functions of `GUESSED` gives; what is solved is given to ``note``.

    A root in a bracket is one ``between`` two ends.
    """
    graph, name, signature = current.get(), f.__name__, inspect.signature(f)
    given = signature.bind(*args, **named).arguments
    g, x0, more = given.pop(next(iter(signature.parameters))), given.pop("x0", None), given.pop("args", ())
    more = more if isinstance(more, tuple) else (more,)
    bracket, told_all = given.pop("bracket", None), name == "fsolve" and given.pop("full_output", False)
    others = {key for key, value in given.items() if key not in _BESIDE or value is True}
    if told := [key for key in sorted(others - {"disp"}) if given[key] != signature.parameters[key].default]:
        raise NotRecorded(f"scipy's {name} with {', '.join(told)}")
    if bracket is not None:
        return _Result("root", between(g, *bracket, args=more))
    guess, alone = lift(graph, x0), name in _ALONE
    if guess.im is not None or guess.re.stretches or guess.ndim > (0 if alone else 1):
        raise NotRecorded(f"scipy's {name} from such a guess")
    roots = _found(graph, name, note, (lambda x: g(x[0], *more)) if alone else (lambda x: g(x, *more)), guess)
    if told_all:  # but for counts and slopes
        return roots, {}, int(_Result("x", roots).success), "The solution converged."
    if name in ("fsolve", "newton"):
        return roots[0] if alone else roots
    return _Result("root", roots[0]) if alone else _Result("x", roots)


class _Result:
    """What scipy gives with a root in it, as far as it is the same for other inputs."""

    def __init__(self, name: str, found: Quantity) -> None:
        self.__dict__[name] = self._found = found

    @property
    def success(self) -> bool:
        return bool(np.isfinite(self._found).all())

    converged = success


def _found(graph: Graph, name: str, note: Note, g: Callable[[Any], Any], guess: Quantity) -> Quantity:
    """The root near a guess as a vector."""
    starts, count = [of_any_unit(start) for start in guess.reshape(-1)], guess.re.size
    with solving.tried(graph) as of:
        own = _plainly(name, of(g), np.atleast_1d(guess.value))
    number = 1 + sum(label.symbol.startswith("near_") for label in graph.labels.values())
    names = tuple(f"root_{number}_{k}" if count > 1 else f"root_{number}" for k in range(1, count + 1))
    texts, units = tuple(f"equation {k}" for k in range(1, count + 1)), ("-",) * count
    words = SimpleNamespace(names=names, unknowns=", ".join(names), units=units, equations=texts, equation_units=units)
    found: Any = SimpleNamespace(words=words, least=False, _values=own, evaluations=0)

    def equations(**x: Quantity) -> list[Quantity]:
        return [*lift(graph, g(stack([*x.values()]))).reshape(-1)]

    solved = solving.several(graph, found, equations, 0.0, dict(zip(names, starts, strict=True)))
    block: Block = solved.value[0].re.args[0]
    led = _led(graph, block, starts, [*solved.value])
    if not led.value:
        raise NotRecorded(f"scipy's {name} from a guess from which it is not sure to which root it leads")
    graph.labels[led.re] = Label(f"near_{number}", "", "whether the root is the only one near the guess")
    note(solved)
    return stack([choice(graph, led, x, np.nan) for x in solved.value])


def _plainly(name: str, g: Callable[[Any], Any], x0: Any) -> Any:
    """Numbers of the root, as sharp as they can be."""
    from scipy.optimize import fsolve  # on use: the worksheet has it

    x, _, told, _ = fsolve(g, x0, full_output=True)
    if told != 1:
        raise NotRecorded(f"scipy's {name} of what has no root there")
    return fsolve(g, x, xtol=1e-15, full_output=True)[0]


def _led(graph: Graph, block: Block, starts: Sequence[Quantity], found: Sequence[Quantity]) -> Any:
    """Whether there is no doubt to which root the guess leads."""
    left, slopes = _at(block, starts)
    first = _solved(graph, slopes, left)
    sizes = [np.maximum(abs(a), abs(s)) for a, s in zip(starts, first, strict=True)]
    unit = of_any_unit(lift(graph, 1.0))
    sizes = [choice(graph, size == 0, unit, size) for size in sizes]

    def length(step: Sequence[Quantity]) -> Any:
        return stepped._greatest([abs(part) / size for part, size in zip(step, sizes, strict=True)])

    one, alone = length(first), len(starts) == 1
    sure: Any = True
    for part in _PARTS:
        there = [a - part * s for a, s in zip(starts, first, strict=True)]
        if alone:
            _, own = _at(block, there)
            sure = sure & ((own[0].get(0, 0.0) > 0) == (slopes[0].get(0, 0.0) > 0))
        else:
            new = replaced(graph, block.residuals, {n: x.re for n, x in zip(block.nodes, there, strict=True)})
            off = _solved(graph, slopes, [Quantity(graph, new.get(node, node)) for node in block.residuals])
            bent = [x - (1 - part) * s for x, s in zip(off, first, strict=True)]
            sure = sure & (length(bent) <= np.maximum(_BENT * one, _ROUNDED))
    left, own = _at(block, there)
    two = np.maximum(length(_solved(graph, own, left)), _ROUNDED)
    sure = sure & (two <= np.maximum((0.5 if alone else 0.25) * one, _ROUNDED))
    return sure & (length([x - a + s for x, a, s in zip(found, starts, first, strict=True)]) <= 2 * two)


def _at(block: Block, x: Sequence[Quantity]) -> tuple[list[Quantity], list[derived.Slopes]]:
    """What the equations leave at some values of the unknowns, and their slopes there."""
    known, _ = derived.at(dict(zip(block.nodes, x, strict=True)), block.residuals)
    return [value for value, _ in known], [slopes for _, slopes in known]


def _solved(graph: Graph, slopes: Sequence[derived.Slopes], left: Sequence[Quantity]) -> list[Quantity]:
    """The step by which equations with such slopes change by what they leave."""
    none = lift(graph, 0.0)
    rows = [[*(own.get(k, none) for k in range(len(left))), value] for own, value in zip(slopes, left, strict=True)]
    return stepped._solved(graph, rows)
