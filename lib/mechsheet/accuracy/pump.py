"""The machine of the worksheet ``kinetostatics``: its equilibrium, and its results at 50 digits.

A crank and groups of three kinds. Positions are those of its loops, all motion their differences, reactions the
solution of the 18 equations of the bodies 2 to 7; the balancing moment is told by the work of all loads.
"""

from collections.abc import Callable
from functools import lru_cache
from types import SimpleNamespace
from typing import Any

from flint import acb, arb

from mechsheet.accuracy.arithmetic import Numbers, cross, dot, in_balls, pin, rrp, rrr, slide, solved
from mechsheet.accuracy.exact import Moving, angle, exactly, moving, numbers, turn

Points = Any  # the points, directions and loads of the machine by the worksheet's names

# Worksheet's names of the loads on the bodies 2 to 7: force, the point where it acts, couple.
LOADS: tuple[tuple[str, str, str | None], ...] = (
    ("F2_sum", "S2", "M_in2"),
    ("F3_own", "S3", "M_in3"),
    ("F4_sum", "S4", "M_in4"),
    ("F5_sum", "E", None),
    ("F6_sum", "S6", "M_in6"),
    ("F7_sum", "S7", "M_in7"),
)
FORCES = ("R_A", "R_B", "R_C", "R_D", "R_E", "R_K", "R_H", "R_05", "R_76")  # in the pins and the prismatic pairs
_STILL = {"g_n", "Q5", "p_g", "D_g", "l6", "l7", "l_O1P", "alpha_w", "n1", "eps1"}  # move no pin
_STILL |= {f"{name}{k}" for name in "mJ" for k in range(1, 8)}


def pairs(p: Points) -> list[tuple[Any, ...]]:
    """Pins and slides of the bodies 2 to 7, counted from 1 here: place, direction of a slide, on a body, by another."""
    pins = [(p.A, 1, 0), (p.B, 2, 1), (p.C, 2, 0), (p.D, 3, 2), (p.E, 4, 3), (p.K, 5, 2), (p.H, 6, 0)]
    return [*pins, (p.E, p.u5, 4, 0), (p.K, p.u7, 5, 6)]


def loads(p: Points) -> list[tuple[Any, ...]]:
    """Loads as body, force, point, couple."""
    rows = enumerate(LOADS, 1)
    return [(k, getattr(p, F), getattr(p, S), getattr(p, M) if M else 0 * p.A.real) for k, (F, S, M) in rows]


def forces(x: Any, p: Points, point: Callable[[Any, Any], Any]) -> list[Any]:
    """The `FORCES` from the solution of the equations."""
    pins = [point(x[k], x[k + 1]) for k in range(0, 14, 2)]
    return [*pins, point(-x[14] * p.u5.imag, x[14] * p.u5.real), point(-x[16] * p.u7.imag, x[16] * p.u7.real)]


def exact_forces(p: Points) -> list[acb]:
    """The `FORCES` at one position in balls."""
    joined = [[*place, on - 1, by - 1 if by else None] for *place, on, by in pairs(p)]
    unknowns = [unknown for each in joined for unknown in (pin(*each) if len(each) == 3 else slide(*each))]
    poles = [p.A, p.C, p.D, p.E, p.K, p.H]
    return forces(solved(unknowns, [(body - 1, *load) for body, *load in loads(p)], poles), p, acb)


@in_balls
def kinetostatics(g: Any, phi1: Any) -> Numbers:
    """Results of the worksheet at the angle phi1 [rad] of the crank."""
    x = exactly(g)
    m = _moving(phi1, **{name: value for name, value in numbers(g).items() if name not in _STILL})
    here = {name: path.here for name, path in m.items()}
    C, H, u5 = acb(x.X_C, x.Y_C), acb(x.X_H, x.Y_H), turn(x.phi05)
    p = SimpleNamespace(C=C, H=H, u5=u5, u7=here["e7"], **here)
    made = {name: here[name] for name in "ABDEK"}
    motion, work = _inertia(x, m)
    made |= motion | {"s7": x.l6 + x.l7 - abs(H - p.K), "s5": dot(p.E - acb(x.X05, x.Y05), u5)}
    made |= {"phi2": angle(p.AB), "phi3": angle(p.CB), "phi4": angle(p.DE), "phi6": angle(-p.e7)}
    made |= {"mu23": abs(angle(p.AB / p.CB)), "mu45": abs(angle(p.DE / (acb(0, 1) * u5)))}
    forwards = dot(m["E"].first, u5)
    made |= {"F_g": x.p_g * arb.pi() * x.D_g**2 / 4}
    made |= {"F_Q": (-x.Q5 if forwards * x.n1 > 0 else 0) * u5, "F_gas": made["F_g"] * p.e7}
    own = {"F5_sum": made["F_Q"], "F6_sum": made["F_gas"], "F7_sum": -made["F_gas"]}
    for k, (F, _, _) in enumerate(LOADS, 2):
        made[F] = made[f"G{k}"] + made[f"F_in{k}"] + own.get(F, 0)
    work += dot(made["F_gas"], m["K"].first) + dot(made["F_Q"], m["E"].first)
    vars(p).update(made)
    made |= dict(zip(FORCES, exact_forces(p), strict=True))
    rod = -p.e7
    made |= {"R05": dot(made["R_05"], acb(0, 1) * u5), "R76": dot(made["R_76"], acb(0, 1) * rod)}
    for name, of in {"R12": "A", "R23": "B", "R03": "C", "R34": "D", "R45": "E", "R36": "K", "R07": "H"}.items():
        made[name] = abs(made[f"R_{of}"])
    M_76 = -(made["M_in6"] + cross(p.S6 - p.K, made["F6_sum"]))
    return made | {"M_76": M_76, "h76": M_76 / made["R76"], "M_b": -work, "M_c": -work}


@lru_cache(maxsize=1)  # while the loads alone change
def _moving(phi1: Any, **still: Any) -> dict[str, Moving]:
    """Pins, centres of mass and the links' directions over the angle of the crank."""
    x = exactly(SimpleNamespace(**still))
    C, H, O5, u5 = acb(x.X_C, x.Y_C), acb(x.X_H, x.Y_H), acb(x.X05, x.Y05), turn(x.phi05)

    def at(phi: arb) -> Numbers:
        e1 = turn(phi)
        A = x.l1 * e1
        B = rrr(A, C, x.l2, x.l3, +1)
        D, K = (C + (B - C) * (r / x.l3) * turn(d) for r, d in ((x.l_CD, x.delta_D), (x.l_CK, x.delta_K)))
        E = rrp(D, O5, u5, x.l4, +1, arb(0))
        e7 = (K - H) / abs(K - H)
        pins = {"A": A, "B": B, "D": D, "E": E, "K": K, "e1": e1, "AB": B - A, "CB": B - C, "DE": E - D, "e7": e7}
        centres = {"S1": x.l_O1S1 * e1, "S2": B + (A - B) * x.l_BS2 / x.l2, "S3": B + (C - B) * x.l_BS3 / x.l3}
        centres |= {"S4": E + (D - E) * x.l_ES4 / x.l4, "S6": K - e7 * x.l_KS6, "S7": H + e7 * x.l_HS7}
        return pins | centres | {"HK": abs(K - H), "s": dot(E - O5, u5)}

    return moving(at, arb(phi1))


def _inertia(x: Any, m: dict[str, Moving]) -> tuple[Numbers, arb]:
    """Motion, inertia and weights of the links, and the work of these for each radian of the crank."""
    made, work = Numbers(), arb(0)
    links = {1: "e1", 2: "AB", 3: "CB", 4: "DE", 5: None, 6: "e7", 7: "e7"}
    for k, direction in links.items():
        S = m["E" if k == 5 else f"S{k}"]
        turned = m[direction].rotation() if direction else (arb(0), arb(0))
        a_S, eps = (second * x.n1**2 + first * x.eps1 for first, second in ((S.first, S.second), turned))
        m_k, J = getattr(x, f"m{k}"), getattr(x, f"J{k}", 0)
        made |= {f"F_in{k}": -m_k * a_S, f"G{k}": acb(0, -m_k * x.g_n)}
        if direction:
            made |= {f"S{k}": S.here, f"a_S{k}": a_S, f"M_in{k}": -J * eps}
        if k in (2, 3, 4, 6):  # 7 turns with 6, 5 does not, 1 as it is told
            made |= {f"omega{k}": x.n1 * turned[0], f"eps{k}": eps}
        work += dot(made[f"F_in{k}"] + made[f"G{k}"], S.first) - J * eps * turned[0]
    for name in "ADEK":
        made[f"a_{name}"] = m[name].second * x.n1**2 + m[name].first * x.eps1
    return made | {"v5": x.n1 * m["s"].first, "v6": x.n1 * m["HK"].first}, work
