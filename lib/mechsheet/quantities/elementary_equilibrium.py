"""Equilibrium of all bodies of a mechanism in elementary steps."""

from collections.abc import Iterator, Sequence
from itertools import chain

import numpy as np

from mechsheet.mechanics.equilibrium import DriveMoment, Reaction
from mechsheet.mechanics.group import ROUNDINGS
from mechsheet.mechanics.load import Load
from mechsheet.quantities.elementary_planar import Quantity, cross, step

Equation = tuple[dict[int, Quantity], Quantity]  # coefficients by the number of their unknown, and the right side


def solve_reactions(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> Quantity:
    """Unknowns that stand with 1 or -1 are put into the other equations; few are left to be solved with pivots."""
    equations = list(_equations(loads, reactions))
    known: list[tuple[int, Equation]] = []
    while plain := _fewest(equations):
        n, j = plain
        coefficients, right = equations.pop(n)
        way = coefficients.pop(j)
        known.append((j, ({k: way * c for k, c in coefficients.items()}, way * right)))
        equations = [_put(equation, *known[-1]) for equation in equations]
    found = _solved(equations, _far(reactions))
    for j, (coefficients, right) in reversed(known):
        for k, c in coefficients.items():
            right = right - c * found[k]
        found[j] = step(f"x{j + 1}", "", "reaction of the one system", right)
    return np.stack(np.broadcast_arrays(*(found[j] for j in sorted(found))), axis=-1)


def _equations(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> Iterator[Equation]:
    """Forces x and y, and moments about a pair, on each body; a coefficient of 0 is left out."""
    units = [(r, F, M) for r in reactions for F, M in r.units]
    for body, of_body in enumerate(loads, start=1):
        pairs = [r.P for r in reactions if body in (r.on, r.by) and not isinstance(r, DriveMoment)]
        pole: Quantity = (pairs or [of_body[0].P])[0]
        own = [(j, 1 if r.on == body else -1, r.P, F, M) for j, (r, F, M) in enumerate(units) if body in (r.on, r.by)]
        columns = [(j, [way * part for part in _wrench(F, M, P, pole)]) for j, way, P, F, M in own]
        known = [_wrench(load.F, load.M, load.P, pole) for load in of_body]
        for n in range(3):
            yield {j: c[n] for j, c in columns if not _is(c[n], 0)}, -sum(k[n] for k in known)


def _wrench(F: Quantity, M: Quantity, P: Quantity, pole: Quantity) -> tuple[Quantity, Quantity, Quantity]:
    """Components x and y of a force, and its moment about the pole with that of the couple."""
    return F.real, F.imag, M if P is pole or _is(F, 0) else M + cross(P - pole, F)


def _is(x: Quantity, *numbers: int) -> bool:
    return isinstance(x, int | float) and x in numbers


def _fewest(equations: Sequence[Equation]) -> tuple[int, int] | None:
    """An equation and an unknown with 1 or -1 in it, which make the fewest new terms; None where there is none."""
    uses = [j for coefficients, _ in equations for j in coefficients]
    plain = [
        ((len(coefficients) - 1) * (uses.count(j) - 1), n, j)
        for n, (coefficients, _) in enumerate(equations)
        for j, c in coefficients.items()
        if _is(c, 1, -1)
    ]
    return min(plain)[1:] if plain else None


def _put(equation: Equation, j: int, value: Equation) -> Equation:
    """An equation with the value of an unknown in its place."""
    coefficients, right = dict(equation[0]), equation[1]
    if j not in coefficients:
        return equation
    of = coefficients.pop(j)
    for k, c in value[0].items():
        new = coefficients.get(k, 0) - of * c
        if _is(new, 0):
            coefficients.pop(k, None)
        else:
            coefficients[k] = step("a", "", "coefficient of the one system", new)
    return coefficients, step("b", "", "right side of the one system", right - of * value[1])


def _far(reactions: Sequence[Reaction]) -> Quantity:
    """The part that rounding of the pairs has of their distances, in roundings."""
    pairs: list[Quantity] = list({id(r.P): r.P for r in reactions if not isinstance(r, DriveMoment)}.values())
    if len(pairs) < 2:
        return 1
    far = 1 + sum(np.abs(P) for P in pairs) / sum(np.abs(P - pairs[0]) for P in pairs[1:])
    return step("far", "-", "1 and how far the pairs are from the origin, in distances from one another", far)


def _solved(equations: Sequence[Equation], far: Quantity) -> dict[int, Quantity]:
    """The unknowns of the equations that are left; none where rounding of the pairs can leave bodies that move."""
    unknowns = sorted(set(chain.from_iterable(coefficients for coefficients, _ in equations)))
    if not unknowns:
        return {}
    rows = [[*(coefficients.get(j, 0.0) for j in unknowns), right] for coefficients, right in equations]
    cells = np.broadcast_arrays(*chain.from_iterable(rows))
    count = len(unknowns) + 1
    whole = np.stack([np.stack(cells[n : n + count], axis=-1) for n in range(0, len(cells), count)], axis=-2)
    found = np.linalg.solve(whole[..., :-1], whole[..., -1:])[..., 0]
    size = np.prod(np.abs(whole[..., :-1]).sum(axis=-1), axis=-1)
    stands = np.abs(np.linalg.det(whole[..., :-1])) > ROUNDINGS * far * size
    return {j: np.where(stands, found[..., n], np.nan) for n, j in enumerate(unknowns)}
