r"""The worksheets at 50 digits, by other means than the library's: the truth against which errors are measured.

Points where two circles meet, unknown lengths as distances between known points, derivatives by differences of the
positions, reactions by the equilibrium of the bodies that are no two-force members.

``g`` is anything with a worksheet's inputs as attributes, in SI; its floats are taken as exact numbers. Results bear
the names of the worksheet. Where something does not close or is infinite there, its result is NaN.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, lru_cache
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.accuracy.arithmetic import (
    DIGITS,
    SLACK,
    Numbers,
    cross,
    derivatives,
    mp,
    mpc,
    mpf,
    rotation,
    rrp,
    rrr,
    slope,
    turning,
)
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Chosen

_NOTHING = mpf(10) ** -95  # below the root of the rounding of the work: the sine at a dead centre
_LINKS = {3: ("O3", "P23_S"), 4: ("P34_S", "P45_S"), 5: ("O5", "P45_S"), 6: ("P56_S", "P67_S"), 7: ("O7", "P67_S")}


_LOADS = {"P6", "k_gc", "P_gc_max", "eta", "D_gc", "P_msha", "P_gr", "a", "L", "b"}  # move nothing of the hitch


def finds(g: Any) -> Numbers:
    """L4, S_p and L7 [m] of the document's three solve blocks, on its branches, each nearest to its guess.

    Raises ValueError where one of them has no solution.
    """
    return _finds(**{name: value for name, value in vars(_exact(g)).items() if name not in _LOADS})


@lru_cache(maxsize=1)  # while the loads alone change
def _finds(**unloaded: mpf) -> Numbers:
    x = SimpleNamespace(**unloaded)
    L4, _ = _nearest("L4", _rods(x), (x.L4_0 / 10 + x.L4_0 * 1.5) / 2)
    S_p, P56 = _nearest("S_p", _strokes(x, L4), (x.S_max + x.S_min) / 2)
    L7, _ = _nearest("L7", _upper_links(x, P56), (x.L7_0 / 10 + x.L7_0 * 1.5) / 2)
    return {"L4": L4, "S_p": S_p, "L7": L7}


def hitch(g: Any, S: Any = None, **lengths: Any) -> Numbers:
    """All results of the worksheet at one stroke S [m], by the names that they have there; S = S_p if none is given.

    Of the lengths L4, S_p, L7 those that are not given are found, as in `finds`.
    """
    x = _exact(g)
    length = {name: mpf(value) for name, value in lengths.items()}
    if len(length) < 3:
        length = finds(x) | length
    unloaded = {name: value for name, value in vars(x).items() if name not in _LOADS}
    results = _motion(length["S_p"] if S is None else mpf(S), **length, **unloaded)
    return results | _capacity(x, results) | _forces(x, results) | _stability(x, results)


def second_analogues(g: Any, S: Any, L4: Any, L7: Any) -> list[mpf]:
    """Second derivatives of the angles of the links 3 to 7 with respect to S."""
    pins, stroke = _pins(_exact(g), mpf(L4), mpf(L7)), mpf(S)
    return [rotation(_link(lambda t: pins(stroke + t), *ends))[1] for ends in _LINKS.values()]


def stroke(g: Any) -> Numbers:
    """Synthesis of the landing gear worksheet, from the tangent drawn from O1 to the circle of A."""
    x = _exact(g)
    O1, A_0, A_n = _leg_ends(x)
    l20, l2n = abs(A_0 - O1), abs(A_n - O1)
    lengths = {"l20": l20, "l2n": l2n, "H": l2n - l20, "V21": (l2n - l20) / x.t_r}
    angles = {"psi": mp.arg(-1j / A_0), "alpha_0": _pressure(O1, A_0), "alpha_n": _pressure(O1, A_n)}
    return lengths | angles


def landing_gear(g: Any, l2: Any) -> Numbers:
    """Results of the landing gear worksheet for the length l2 [m] of the cylinder.

    A lies on two circles; everything else is differentiated.
    """
    x = _exact(g)
    synthesis = stroke(x)
    O1, A_0, _ = _leg_ends(x)
    l2, l3, V21 = mpf(l2), x.l3, synthesis["V21"]

    def A_at(extension: mpf) -> mpc:
        return rrr(O1, mpc(0), l2 + extension, l3, +1)

    A = A_at(mpf(0))
    rod = (A - O1) / l2
    (omega3, eps3), (omega2, eps2) = rotation(A_at), rotation(lambda t: O1 - A_at(t))
    leg = -1j * l3 / A_0 * A / l3  # unit vector down the leg
    S3, W3, D3 = x.r3 * leg, x.l_w * leg, x.l_w / 2 * leg
    a_S = V21**2 * (1j * eps3 - omega3**2) * S3
    G, q, n = mpc(0, -x.m3 * x.g_n), x.rho * x.U * abs(x.U) / 2, 1j * leg
    wind = [(mpc(q * x.C_w), W3), (q * x.C_s * n.real * abs(n.real) * n, D3)]
    moment = sum(cross(P, F) for F, P in [*wind, (G, S3)])
    F_c = ((x.J3 + x.m3 * x.r3**2) * V21**2 * eps3 - moment) / cross(A, rod)
    motion = {"Ai": A, "phi2i": mp.arg(O1 - A), "phi3i": mp.arg(A), "alpha": _pressure(O1, A)}
    motion |= {"omega3_l2i": omega3, "omega2_l2i": omega2, "eps3_l2i": eps3, "eps2_l2i": eps2}
    motion |= {"omega3i": V21 * omega3, "omega2i": V21 * omega2, "eps3i": V21**2 * eps3, "eps2i": V21**2 * eps2}
    R03 = x.m3 * a_S - G - F_c * rod - sum(F for F, _ in wind)
    return synthesis | motion | {"F_c": F_c, "P_c": F_c * V21, "R23": F_c * rod, "R03": R03}


def joint(tables: Any, x: Mapping[str, Any], plane: int, case: int = 0) -> Numbers:
    """Stresses, forces and neutral axis of the rectangular joint, by trying every place of the neutral axis.

    x are the inputs by name, but of each column of the ``tables`` the factor by which all its elements change, such as
    ``beams.y``, so that what is symmetrical stays so; they begin as `factors` has them. Load cases count from 0.
    ``sigma_k`` belongs to the element k, from 0; P is the row of all forces. Raises ValueError where nothing is in
    equilibrium.
    """
    g = _exact(SimpleNamespace(**x))
    beams, stringers, loads = (_rows(tables, name, vars(g)) for name in ("beams", "stringers", "loads"))
    load = loads[case]
    beta = _rounded(g.E_al / g.E_st, g.d_E)
    l_b, l_h = (g.psi * (max(side) - min(side)) / 2 for side in ([e.z for e in beams], [e.y for e in beams]))
    pressed, A_t = beta * g.k_a * g.delta**2, list[mpf]()
    for e in beams:
        on_b = [s for s in stringers if abs(s.y - e.y) <= g.delta and abs(s.z - e.z) <= l_b]
        on_h = [s for s in stringers if abs(s.z - e.z) <= g.delta and abs(s.y - e.y) <= l_h]
        skin = (l_b + min([l_h, *(abs(s.y - e.y) for s in on_h)])) * g.delta
        A_t.append(e.F + e.k_t * _rounded(beta * (skin + sum(s.F for s in [*on_b, *on_h])), g.d_F))
    A_t += [s.k_t * beta * s.F for s in stringers]
    A_c = [e.F + e.k_c * pressed for e in beams] + [s.k_c * (beta * s.F + pressed) for s in stringers]
    y = [(e.y, e.z)[plane - 1] for e in [*beams, *stringers]]
    M, N, levels = load.M + load.M_w, load.N, sorted(set(y))
    fits = []
    for place in [levels[0] - 1, *((low + high) / 2 for low, high in pairwise(levels))]:
        for way in (1, -1):
            A = [t if way * (level - place) > 0 else c for level, t, c in zip(y, A_t, A_c, strict=True)]
            if sigma := _stresses(y, A, M, N):
                wrong = max(-way * (level - place) * s for level, s in zip(y, sigma, strict=True))
                fits.append((wrong, sigma, A))
    wrong, sigma, A = min(fits, key=lambda fit: fit[0])
    if wrong > mpf(10) ** -DIGITS * (levels[-1] - levels[0]) * max(map(abs, sigma)):
        raise ValueError("no place of the neutral axis is in equilibrium")
    named = {f"sigma_{k}": s for k, s in enumerate(sigma)}
    low, high = sigma[y.index(levels[0])], sigma[y.index(levels[-1])]
    y_0 = (levels[0] * high - levels[-1] * low) / (high - low) if high - low else mpf("inf")
    return named | {"P": [s * area for s, area in zip(sigma, A, strict=True)], "y_0": y_0}


def factors(g: Any) -> dict[str, Any]:
    """Inputs by name, of each column of a table the factor 1."""
    leaves = (leaf for each in declared(type(g)) for leaf in each.leaves(getattr(g, each.name)).items())
    return {name: 1.0 if np.ndim(value) else value for name, (_, value) in leaves}


def _rows(tables: Any, name: str, factors: Mapping[str, Any]) -> list[Any]:
    """Rows of a table, each column times its factor."""
    columns = {key: [mpf(v) * factors[f"{name}.{key}"] for v in xs] for key, xs in vars(getattr(tables, name)).items()}
    return [SimpleNamespace(**dict(zip(columns, row, strict=True))) for row in zip(*columns.values(), strict=True)]


def _stresses(y: Sequence[Any], A: Sequence[Any], M: Any, N: Any) -> list[mpf]:
    """Stresses of elements of the areas A on the levels y under a moment and a force; none if they are on one level."""
    F, S = sum(A), mp.fdot(A, y)
    J = mp.fdot(A, [level * level for level in y])
    if (D := F * J - S * S) <= 0:
        return []
    middle, slope = (N * J - M * S) / D, (M * F - N * S) / D
    return [middle + slope * level for level in y]


def slotted_link(g: Any, phi1: Any) -> Numbers:
    """Slider, turning of the link and motion of its end C at the angle phi1 [rad] of the crank, all differentiated."""
    x, phi1 = _exact(g), mpf(phi1)

    def A(t: mpf) -> Any:
        return mpc(0, x.L0) + x.L1 * mp.expj(phi1 + x.omega1 * t)

    (omega, eps), (V, W) = rotation(A), derivatives(lambda t: x.L3 * A(t) / abs(A(t)))
    return {"SAB_k": abs(A(mpf(0))), "omega_BC_k": omega, "eps_BC_k": eps, "VC_k": V, "WC_k": W}


def kinetostatics(g: Any, phi1: Any) -> Numbers:
    """Pins E and K, and the balancing moment by the work of all loads and inertia forces, at the crank's angle phi1."""
    x, phi1, still = _exact(g), mpf(phi1), mpf(0)
    C, H, O5, u5 = mpc(x.X_C, x.Y_C), mpc(x.X_H, x.Y_H), mpc(x.X05, x.Y05), mp.expj(x.phi05)

    @cache
    def bodies(t: mpf) -> list[tuple[mpc, mpc]]:
        """Centre of mass and direction of each body, pins D, E, after the crank has turned on by t."""
        A = x.l1 * mp.expj(phi1 + t)
        B = rrr(A, C, x.l2, x.l3, +1)
        D = C + (B - C) * x.l_CD / x.l3 * mp.expj(x.delta_D)
        K = C + (B - C) * x.l_CK / x.l3 * mp.expj(x.delta_K)
        E = rrp(D, O5, u5, x.l4, +1, still)
        e7 = (K - H) / abs(K - H)
        rods = [(A * x.l_O1S1 / x.l1, A), (B + (A - B) * x.l_BS2 / x.l2, A - B), (B + (C - B) * x.l_BS3 / x.l3, B - C)]
        rods += [(E + (D - E) * x.l_ES4 / x.l4, D - E), (E, u5)]
        return [*rods, (K - e7 * x.l_KS6, e7), (H + e7 * x.l_HS7, e7), (K, e7)]

    def of(k: int, part: int) -> Callable[[mpf], mpc]:
        return lambda t: bodies(t)[k][part]

    work = mpf(0)
    for k in range(7):
        (S1, S2), (turn1, turn2) = derivatives(of(k, 0)), rotation(of(k, 1))
        F = -getattr(x, f"m{k + 1}") * (S2 * x.n1**2 + S1 * x.eps1 + mpc(0, x.g_n))
        M = -getattr(x, f"J{k + 1}", 0) * (turn2 * x.n1**2 + turn1 * x.eps1)
        work += (mp.conj(F) * S1).real + M * turn1
    (E, _), (K, e7) = bodies(still)[4], bodies(still)[7]
    (E1, _), (K1, _) = derivatives(of(4, 0)), derivatives(of(7, 0))
    work += x.p_g * mp.pi * x.D_g**2 / 4 * (mp.conj(e7) * K1).real
    forwards = (E1 / u5).real
    if forwards * x.n1 > 0:
        work -= x.Q5 * forwards
    return {"K": K, "E": E, "M_b": -work}


def dyad(
    A: Any, B: Any, r_A: Any, r_B: Any, branch: int, P_A: Any, P_B: Any, F_A: Any, F_B: Any, X_C: Any = 1, Y_C: Any = 1
) -> Numbers:
    """Pin C, analogues for a lengthening link AC, and reactions of a dyad of two links.

    The force F_A [N] acts on the link AC at P_A, F_B on BC at P_B. X_C and Y_C are factors of the coordinates of C,
    which is rounded before anything is computed from it.
    """
    A, B, P_A, P_B, F_A, F_B = (mpc(z) for z in (A, B, P_A, P_B, F_A, F_B))
    C = rrr(A, B, mpf(r_A), mpf(r_B), branch)
    C = mpc(C.real * X_C, C.imag * Y_C)
    a, b = C - A, C - B
    T_A, T_B = cross(P_A - C, F_A), cross(P_B - C, F_B)
    # about C: a x R_A = T_A, b x R_B = T_B, with R_A + R_B = -(F_A + F_B); and i (omega_A a - omega_B b) = -a/|a|
    T, D = T_B + cross(b, F_A + F_B), cross(a, b)
    moves = abs(D) > _NOTHING * abs(a) * abs(b)
    R_A = (a * T + b * T_A) / D if moves else mpc(mp.nan, mp.nan)
    omega_A, omega_B = (-(a * c.conjugate()).real / abs(a) / D for c in (b, a)) if moves else (mp.nan, mp.nan)
    R_B = -(R_A + F_A + F_B)
    return {"C": C, "omega_A": omega_A, "omega_B": omega_B, "R_A": R_A, "R_B": R_B, "R_C": -(R_A + F_A)}


def four_bar(a: Any, b: Any, c: Any, d: Any, theta: Any) -> Numbers:
    """Pin C and the angles of coupler and rocker; the crank a turns about 0, the rocker c about d, C to the left."""
    A, B = mpf(a) * mp.expj(mpf(theta)), mpc(d)
    C = rrr(A, B, mpf(b), mpf(c), +1)
    return {"C": C, "phi2": mp.arg(C - A), "phi3": mp.arg(C - B)}


def ring(phi: Sequence[float], r: Any, M: Any, N: Any) -> Numbers:
    """Bolt forces P at the angles phi, resultant R and greatest line load p_0 of a circular joint in part pressed."""
    r, M, N = map(mpf, (r, M, N))
    c, angles = N * r / (2 * M), [mpf(angle) for angle in phi]
    edge = mp.acos(-c)
    s, t = mp.sin(edge), mp.pi - edge
    arc_N, arc_M = 2 * r * (c * t - s), 2 * r * (t / 2 - s * mp.cos(edge) / 2 - c * s)
    stretched = [max(mp.cos(angle) + c, mpf(0)) for angle in angles]
    bolt_N, bolt_M = mp.fsum(stretched), mp.fdot(stretched, map(mp.cos, angles))
    k_t, k_c = mp.lu_solve(mp.matrix([[bolt_N, arc_N], [bolt_M, arc_M]]), mp.matrix([N, M / r]))
    return {"P": [k_t * q for q in stretched], "R": k_c * arc_N, "p_0": k_c * (c - 1), "y_0": -c * r}


def numbers(g: Any) -> dict[str, Any]:
    """Inputs that are numbers; the sides on which a mechanism is assembled are none, and here those of the document."""
    return {name: value for name, value in vars(g).items() if not isinstance(value, str | Chosen)}


def _exact(g: Any) -> SimpleNamespace:
    return SimpleNamespace(**{name: mp.convert(value) for name, value in numbers(g).items()})


def _nearest(name: str, roots: Iterator[tuple[mpf, mpc]], guess: mpf) -> tuple[mpf, mpc]:
    found = sorted(roots, key=lambda root: root[0])
    if not found:
        raise ValueError(f"{name} does not exist")
    return min(found, key=lambda root: abs(root[0] - guess))


def _rods(x: Any) -> Iterator[tuple[mpf, mpc]]:
    """Lengths L4 that put the suspension axis at its least height, and where it is then."""
    O1, O3, O5, _ = _hinges(x)
    P34 = O3 + (rrr(O1, O3, x.S_min, x.L3, -1) - O3) * _arm(x)
    for u in _low_links(x, x.Y56_min):
        P45 = O5 + x.L5 * u
        if _left(P34, O5, P45) >= 0:
            yield abs(P45 - P34), O5 + x.L56 * u


def _strokes(x: Any, L4: mpf) -> Iterator[tuple[mpf, mpc]]:
    """Strokes that put the suspension axis at its working height, and where it is then."""
    O1, O3, O5, _ = _hinges(x)
    for u in _low_links(x, x.Y_P56):
        P45 = O5 + x.L5 * u
        for side in (+1, -1):
            P34 = rrr(O3, P45, x.L34, L4, side)
            P23 = O3 + (P34 - O3) / _arm(x)
            S = abs(P23 - O1)
            # an end of the interval may be a number found and rounded
            inside = x.S_min * (1 - SLACK) <= S <= x.S_max * (1 + SLACK)
            if inside and _left(P34, O5, P45) >= 0 and _left(O1, O3, P23) <= 0:
                yield S, O5 + x.L56 * u


def _upper_links(x: Any, P56: mpc) -> Iterator[tuple[mpf, mpc]]:
    """Length L7 that puts the mast at its angle, and its upper pin."""
    O7 = _hinges(x)[-1]
    P67 = P56 + x.L6 * mp.expj(x.phi_P6)
    if _left(P56, O7, P67) <= 0:
        yield abs(P67 - O7), P67


def _low_links(x: Any, height: mpf) -> Iterator[mpc]:
    """Directions of the lower link that put its end at the height."""
    rise = (height - x.Y05) / x.L56
    if abs(rise) <= 1:
        run = mp.sqrt(1 - rise**2)
        yield from (mpc(run, rise), mpc(-run, rise))


def _left(A: mpc, B: mpc, P: mpc) -> int:
    """On which side of the line from A to B the point P is: +1 on its left, 0 on it."""
    return int(mp.sign(cross(B - A, P - A)))


def _hinges(x: Any) -> tuple[mpc, ...]:
    return tuple(mpc(getattr(x, f"X0{k}"), getattr(x, f"Y0{k}")) for k in (1, 3, 5, 7))


def _arm(x: Any) -> mpc:
    """The side of the lift arm next to the rod over the one next to the cylinder."""
    return x.L34 / x.L3 * mp.expj(x.phi_BD)


def _pins(x: Any, L4: mpf, L7: mpf) -> Callable[[mpf], Numbers]:
    """Where the pins are as a function of the stroke."""
    O1, O3, O5, O7 = _hinges(x)
    arm, frame = _arm(x), {"O1": O1, "O3": O3, "O5": O5, "O7": O7}

    @cache
    def at(S: mpf) -> Numbers:
        P23 = rrr(O1, O3, S, x.L3, -1)
        P34 = O3 + (P23 - O3) * arm
        P45 = rrr(P34, O5, L4, x.L5, +1)
        P56 = O5 + (P45 - O5) * (x.L56 / x.L5)
        P67 = rrr(P56, O7, x.L6, L7, -1)
        return frame | {"P23_S": P23, "P34_S": P34, "P45_S": P45, "P56_S": P56, "P67_S": P67}

    return at


@lru_cache(maxsize=1)  # while the loads alone change
def _motion(S: mpf, L4: mpf, S_p: mpf, L7: mpf, **unloaded: mpf) -> Numbers:
    """Positions, and derivatives with respect to S; the implement is fixed to the mast where it stands at S_p."""
    x = SimpleNamespace(**unloaded)
    Z, at = mpc(x.X6, x.Y6), _pins(x, L4, L7)
    mast = at(S_p)["P67_S"] - at(S_p)["P56_S"]
    turned = Z / mast

    @cache
    def pins(t: mpf) -> Numbers:
        p = at(S + t)
        return p | {"PS6_S": p["P56_S"] + turned * (p["P67_S"] - p["P56_S"])}

    dphi3, dphi4, dphi5, dphi6, dphi7 = (turning(_link(pins, *ends)) for ends in _LINKS.values())
    I56, IS6 = (slope(lambda t, P=P: pins(t)[P]).imag for P in ("P56_S", "PS6_S"))  # type: ignore[misc]
    results = pins(mpf(0)) | {"L4": L4, "S_p": S_p, "L7": L7}
    results |= {f"phi{k}_S": mp.arg(results[end] - results[start]) for k, (start, end) in _LINKS.items()}
    results |= {"phi12_S": mp.arg(results["P23_S"] - results["O1"]), "phi34_S": results["phi3_S"] + x.phi_BD}
    results |= {"LS6": abs(Z), "phiS6": (mp.arg(Z) - mp.arg(mast)) % (2 * mp.pi)}
    results |= {"dphi3": dphi3, "dphi4": dphi4, "dphi5": dphi5, "dphi6": dphi6, "dphi7": dphi7}
    results |= {"U43": dphi4 / dphi3, "U53": dphi5 / dphi3, "U65": _over(dphi6, dphi5), "U75": _over(dphi7, dphi5)}
    return results | {"I56": I56, "IS6": IS6, "Imp": I56, "Isp": IS6}


def _link(pins: Callable[[mpf], Numbers], start: str, end: str) -> Callable[[mpf], mpc]:
    """A link's vector, where the pins depend on a small change of S."""
    return lambda t: pins(t)[end] - pins(t)[start]


def _over(a: mpf, b: mpf) -> mpf:
    return a / b if b else mp.nan


def _capacity(x: Any, at: Numbers) -> Numbers:
    F_gc, A_gc = x.P6 * at["IS6"], mp.pi * x.D_gc**2 / 4
    greatest = x.k_gc * x.P_gc_max * x.eta * A_gc
    G56, GS6 = _over(greatest, at["I56"]), _over(greatest, at["IS6"])
    P_gc, dGS65 = F_gc / (x.k_gc * A_gc * x.eta), _over(GS6 - x.P6, x.P6)
    return {"F_gc": F_gc, "A_gc": A_gc, "P_gc": P_gc, "G56": G56, "GS6": GS6, "dGS65": dGS65}


def _forces(x: Any, at: Numbers) -> Numbers:
    """Links 2, 4 and 7 carry forces along themselves only; moments of the bodies 6, 5, 3 give one force each."""
    G6 = mpc(0, -x.P6)

    def along(link: mpc, arm: mpc, moment: mpf) -> mpc:
        return -link * _over(moment, cross(arm, link))

    P23, P34, P45, P56, P67 = (at[f"P{k}_S"] for k in (23, 34, 45, 56, 67))
    R07 = along(P67 - at["O7"], P67 - P56, cross(at["PS6_S"] - P56, G6))
    R56 = -(R07 + G6)
    R34_on_5 = along(P34 - P45, P45 - at["O5"], cross(P56 - at["O5"], -R56))
    R05 = R34_on_5 - R56
    R34 = -R34_on_5
    R01 = along(P23 - at["O1"], P23 - at["O3"], cross(P34 - at["O3"], R34))
    group_67 = {"R56": R56, "R65": -R56, "R07": R07, "R67": -R07}
    return group_67 | {"R34": R34, "R45": R34, "R05": R05, "R01": R01, "R23": R01, "R03": -(R01 + R34)}


def _stability(x: Any, at: Numbers) -> Numbers:
    weight, X = x.P6 + x.P_msha + x.P_gr, at["PS6_S"].real
    moment = x.P_gr * (x.a + x.L) + x.P_msha * x.b
    share = mpf(1) / 5
    Ra, Ra_min = (moment - x.P6 * X) / x.L, share * weight
    loads = {"Ra": Ra, "Rb": weight - Ra, "dRa": Ra / weight, "dRb": (weight - Ra) / weight, "Ra_min": Ra_min}
    GS6_lim = _over(moment - share * x.L * (x.P_msha + x.P_gr), X + share * x.L)
    return loads | {"GS6_max": _over(moment - Ra_min, X), "GS6_lim": GS6_lim}


def _leg_ends(x: Any) -> tuple[mpc, mpc, mpc]:
    """Hinge O1, and the pin A where the leg is extended and where it is retracted."""
    O1 = mpc(-x.b, x.a)
    l12 = abs(O1)
    tangent = x.l3 * O1 / l12**2 * mpc(x.l3, -mp.sqrt(l12**2 - x.l3**2))
    return O1, tangent * mp.expj(x.theta / 2), tangent / mp.expj(x.theta / 2)


def _pressure(O1: mpc, A: mpc) -> mpf:
    """Angle from the force along the rod to the velocity of A, which turns clockwise about the origin."""
    return mp.arg(-1j * A / (A - O1))


def _rounded(value: mpf, step: mpf) -> mpf:
    return step * mp.nint(value / step) if step else value
