"""Joints of elements and of rings at 50 digits: every place of the neutral axis is tried, arcs are integrated.

The loads of what is compared here are those of the worksheet ``joint``, or any.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from flint import arb, arb_mat

from mechsheet.accuracy.arithmetic import DIGITS, Numbers, in_balls
from mechsheet.accuracy.exact import exactly
from mechsheet.worksheet.inputs import declared


class Areas(NamedTuple):
    """Elements of a rectangular joint: places in both planes, areas in tension and in compression."""

    y: list[list[arb]]
    A_t: list[arb]
    A_c: list[arb]
    reduced: Numbers  # what they come from, by the worksheet's names


@in_balls
def joint(tables: Any, x: Mapping[str, Any], plane: int, case: int = 0) -> Numbers:
    """Stresses, forces and neutral axis of the rectangular joint of the worksheet.

    x are the inputs by name, but of each column of the ``tables`` the factor by which all its elements change, such as
    ``beams.y``, so that what is symmetrical stays so; they begin as `factors` has them. Load cases count from 0.
    ``sigma_k`` belongs to the element k, from 0; P is the row of all forces. Raises ValueError where nothing is in
    equilibrium.
    """
    areas, load = _areas(tables, x), _rows(tables, "loads", _of(x))[case]
    y = areas.y[plane - 1]
    sigma, A = _equilibrium(y, areas.A_t, areas.A_c, load.M + load.M_w, load.N)
    forces = [s * area for s, area in zip(sigma, A, strict=True)]
    return {f"sigma_{k}": s for k, s in enumerate(sigma)} | {"P": forces, "y_0": _axis(y, sigma)}


@in_balls
def section(y: Sequence[Any], A_t: Sequence[Any], A_c: Sequence[Any], M: Any, N: Any) -> Numbers:
    """Forces P of elements on the levels y, whose areas in tension and in compression are given."""
    levels, areas_t, areas_c = ([arb(each) for each in row] for row in (y, A_t, A_c))
    sigma, A = _equilibrium(levels, areas_t, areas_c, arb(M), arb(N))
    return {"P": [s * area for s, area in zip(sigma, A, strict=True)]}


@in_balls
def joint_document(g: Any) -> Numbers:
    """Results of the worksheet for both planes and all load cases, and of its rings, in the order of its arrays."""
    x = factors(g)
    areas, loads, rows = _areas(g, x), _rows(g, "loads", _of(x)), dict[str, list[Any]]()

    def add(**found: Any) -> None:
        for name, y in found.items():
            rows.setdefault(name, []).extend(y if isinstance(y, list) else [y])

    for y in areas.y:
        for load in loads:
            M, N = load.M + load.M_w, load.N
            sigma, A = _equilibrium(y, areas.A_t, areas.A_c, M, N)
            F, S = sum(A), _dot(A, y)
            y_c, y_no = S / F, _axis(y, sigma)
            I_z, M_z = _dot(A, [(level - y_c) ** 2 for level in y]), M - N * y_c
            P = [s * area for s, area in zip(sigma, A, strict=True)]
            add(sigma=sigma, A=A, P=P, F=F, S=S, y_c=y_c, I_z=I_z, M_z=M_z, y_no=y_no, y_1no=y_no - y_c)
    for alpha in g.alpha:
        for M, N in zip(map(arb, g.ring_loads.M), map(arb, g.ring_loads.N), strict=True):
            ring = _ring([arb(bolt) - arb(alpha) for bolt in g.bolts], arb(g.r), M, N)
            add(P_k=ring["P"], P_max=max(ring["P"]), p_o=ring["p_0"], P_str=ring["p_0"] * arb(g.t))
    return areas.reduced | rows


def factors(g: Any) -> dict[str, Any]:
    """Inputs by name, of each column of a table the factor 1."""
    leaves = (leaf for each in declared(type(g)) for leaf in each.leaves(getattr(g, each.name)).items())
    return {name: 1.0 if np.ndim(value) else value for name, (_, value) in leaves}


def _of(x: Mapping[str, Any]) -> dict[str, arb]:
    return vars(exactly(SimpleNamespace(**x)))


def _rows(tables: Any, name: str, factors: Mapping[str, Any]) -> list[Any]:
    """Rows of a table, each column times its factor."""
    table = vars(getattr(tables, name)).items()
    columns = {key: [float(v) * factors[f"{name}.{key}"] for v in values] for key, values in table}
    return [SimpleNamespace(**dict(zip(columns, row, strict=True))) for row in zip(*columns.values(), strict=True)]


def _areas(tables: Any, x: Mapping[str, Any]) -> Areas:
    given = _of(x)
    g, beams, stringers = SimpleNamespace(**given), _rows(tables, "beams", given), _rows(tables, "stringers", given)
    beta = _rounded(g.E_al / g.E_st, g.d_E)
    h, b = (max(side) - min(side) for side in ([e.y for e in beams], [e.z for e in beams]))
    l_b, l_h = g.psi * b / 2, g.psi * h / 2
    pressed, rows = beta * g.k_a * g.delta**2, list[Numbers]()
    for e in beams:
        on_b = [s.F for s in stringers if abs(s.y - e.y) <= g.delta and abs(s.z - e.z) <= l_b]
        beside = [s for s in stringers if abs(s.z - e.z) <= g.delta and abs(s.y - e.y) <= l_h]
        w_h = min([l_h, *(abs(s.y - e.y) for s in beside)])
        F_sb, F_sh = sum(on_b, arb(0)), sum((s.F for s in beside), arb(0))
        F_sk = (l_b + w_h) * g.delta
        dF_tr = _rounded(beta * (F_sk + F_sb + F_sh), g.d_F)
        of_beam = {"F_sb": F_sb, "F_sh": F_sh, "w_h": w_h, "F_sk": F_sk, "dF_t": F_sk + F_sb + F_sh, "dF_tr": dF_tr}
        rows.append(of_beam | {"F_bt": e.F + e.k_t * dF_tr, "F_bc": e.F + e.k_c * pressed})
    reduced: Numbers = {name: [row[name] for row in rows] for name in rows[0]}
    reduced |= {"F_st": [s.k_t * beta * s.F for s in stringers]}
    reduced |= {"F_sc": [s.k_c * (beta * s.F + pressed) for s in stringers]}
    A_t, A_c = reduced["F_bt"] + reduced["F_st"], reduced["F_bc"] + reduced["F_sc"]
    elements = [*beams, *stringers]
    scalars = {"beta": [beta], "h": [h], "b": [b], "l_b": [l_b], "l_h": [l_h], "dF_cr": [pressed]}
    return Areas([[e.y for e in elements], [e.z for e in elements]], A_t, A_c, scalars | reduced)


def _equilibrium(y: list[arb], A_t: list[arb], A_c: list[arb], M: arb, N: arb) -> tuple[list[arb], list[arb]]:
    """Stresses and areas that act: of all places of the neutral axis the one that its own stresses bear out."""
    ordered = sorted(y)
    levels = [ordered[0], *(high for low, high in pairwise(ordered) if high != low)]
    fits = []
    for place in [levels[0] - 1, *((low + high) / 2 for low, high in pairwise(levels))]:
        for way in (1, -1):
            A = [t if way * (level - place) > 0 else c for level, t, c in zip(y, A_t, A_c, strict=True)]
            if sigma := _stresses(y, A, M, N):
                wrong = max(-way * (level - place) * s for level, s in zip(y, sigma, strict=True))
                fits.append((wrong, sigma, A))
    wrong, sigma, A = min(fits, key=lambda fit: fit[0])
    if wrong > arb(10) ** -DIGITS * (levels[-1] - levels[0]) * max(map(abs, sigma)):
        raise ValueError("no place of the neutral axis is in equilibrium")
    return sigma, A


def _stresses(y: Sequence[Any], A: Sequence[Any], M: Any, N: Any) -> list[arb]:
    """Stresses of elements of the areas A on the levels y under a moment and a force; none if they are on one level."""
    F, S, J = sum(A), _dot(A, y), _dot(A, [level**2 for level in y])
    D = F * J - S * S
    if not D > 0:
        return []
    middle, slope = (N * J - M * S) / D, (M * F - N * S) / D
    return [middle + slope * level for level in y]


def _axis(y: list[arb], sigma: list[arb]) -> arb:
    """Where the stress is zero."""
    lowest, highest = y.index(min(y)), y.index(max(y))
    low, high = sigma[lowest], sigma[highest]
    return (y[lowest] * high - y[highest] * low) / (high - low)


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return sum(p * q for p, q in zip(a, b, strict=True))


def _rounded(value: arb, step: arb) -> arb:
    return step * (value / step + arb(1) / 2).floor() if step != 0 else value


@in_balls
def ring(phi: Sequence[float], r: Any, M: Any, N: Any) -> Numbers:
    """Bolt forces P at the angles phi, resultant R and greatest line load p_0 of a circular joint in part pressed."""
    return _ring([arb(at) for at in phi], arb(r), arb(M), arb(N))


def _ring(phi: list[arb], r: arb, M: arb, N: arb) -> Numbers:
    c, cosines = N * r / (2 * M), [at.cos() for at in phi]
    edge = (-c).acos()
    s, t = edge.sin(), arb.pi() - edge
    arc_N, arc_M = 2 * r * (c * t - s), 2 * r * (t / 2 - s * edge.cos() / 2 - c * s)
    stretched = [max(cosine + c, arb(0)) for cosine in cosines]
    bolt_N, bolt_M = sum(stretched), _dot(stretched, cosines)
    k_t, k_c = arb_mat([[bolt_N, arc_N], [bolt_M, arc_M]]).solve(arb_mat([[N], [M / r]])).entries()
    return {"P": [k_t * q for q in stretched], "R": k_c * arc_N, "p_0": k_c * (c - 1), "y_0": -c * r}
