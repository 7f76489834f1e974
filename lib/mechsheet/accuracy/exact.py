r"""The worksheets at 50 digits, by other means than the library's: the truth against which errors are measured.

Points where two circles meet, unknown lengths as distances between known points, derivatives by differences of the
positions, reactions by the equilibrium of the bodies that are no two-force members. What is computed here in balls is
given back as the numbers in their midst.

``g`` is anything with a worksheet's inputs as attributes, in SI; its floats are taken as exact numbers. Results bear
the names of the worksheet. Where something does not close or is infinite there, its result is NaN.
"""

from collections.abc import Callable, Iterator
from functools import lru_cache
from types import SimpleNamespace
from typing import Any, NamedTuple

from flint import acb, arb

from mechsheet.accuracy.arithmetic import (
    SLACK,
    STEP,
    Numbers,
    cross,
    in_balls,
    rrr,
)
from mechsheet.worksheet.chosen import Chosen

_LINKS = {3: ("O3", "P23_S"), 4: ("P34_S", "P45_S"), 5: ("O5", "P45_S"), 6: ("P56_S", "P67_S"), 7: ("O7", "P67_S")}
_LOADS = {"P6", "k_gc", "P_gc_max", "eta", "D_gc", "P_msha", "P_gr", "a", "L", "b"}  # move nothing of the hitch
_H = arb(STEP)


# --- what moves -------------------------------------------------------------------------------------------------


class Moving(NamedTuple):
    """A number, point or vector a step ahead, here and a step behind."""

    ahead: Any
    here: Any
    behind: Any

    @property
    def first(self) -> Any:
        """First derivative."""
        return (self.ahead - self.behind) / (2 * _H)

    @property
    def second(self) -> Any:
        """Second derivative."""
        return (self.ahead - 2 * self.here + self.behind) / _H**2

    def to(self, other: "Moving") -> "Moving":
        """The vector from this point to another one."""
        return Moving(*(q - p for p, q in zip(self, other, strict=True)))

    def rotation(self) -> tuple[arb, arb]:
        """First and second derivative of the direction of a vector."""
        rate = self.first / self.here
        return rate.imag, (self.second / self.here - rate**2).imag


def moving(at: Callable[[arb], Numbers], x: arb) -> dict[str, Moving]:
    """What a function of x gives by names, about one of its places."""
    ahead, here, behind = at(x + _H), at(x), at(x - _H)
    return {name: Moving(ahead[name], y, behind[name]) for name, y in here.items()}


# --- hitch --------------------------------------------------------------------------------------------------------


@in_balls
def finds(g: Any) -> Numbers:
    """L4, S_p and L7 [m] of the document's three solve blocks, on its branches, each nearest to its guess.

    Raises ValueError where one of them has no solution.
    """
    return _finds(**_unloaded(g))


def _unloaded(g: Any) -> dict[str, Any]:
    return {name: value for name, value in numbers(g).items() if name not in _LOADS}


@lru_cache(maxsize=1)  # while the loads alone change
def _finds(**unloaded: Any) -> Numbers:
    x = exactly(SimpleNamespace(**unloaded))
    L4, _ = _nearest("L4", _rods(x), (x.L4_pre / 10 + x.L4_pre * 3 / 2) / 2)
    S_p, P56 = _nearest("S_p", _strokes(x, L4), (x.S_max + x.S_min) / 2)
    L7, _ = _nearest("L7", _upper_links(x, P56), (x.L7_pre / 10 + x.L7_pre * 3 / 2) / 2)
    return {"L4": L4, "S_p": S_p, "L7": L7}


@in_balls
def hitch(g: Any, S: Any = None, **lengths: Any) -> Numbers:
    """All results of the worksheet at one stroke S [m], by the names that they have there; S = S_p if none is given.

    Of the lengths L4, S_p, L7 those that are not given are found, as in `finds`.
    """
    given = {name: length.mid() if isinstance(length, arb) else length for name, length in lengths.items()}
    x, results = exactly(g), _motion(S, tuple(given.items()), **_unloaded(g))
    return results | _capacity(x, results) | _forces(x, results) | _stability(x, results)


@in_balls
def second_analogues(g: Any, S: Any, L4: Any, L7: Any) -> Numbers:
    """Second derivatives of the angles of the links 3 to 7 with respect to S, by the names of these."""
    pins = moving(_pins(exactly(g), arb(L4), arb(L7)), arb(S))
    return {f"phi{k}_S": pins[start].to(pins[end]).rotation()[1] for k, (start, end) in _LINKS.items()}


def _nearest(name: str, roots: Iterator[tuple[arb, acb]], guess: arb) -> tuple[arb, acb]:
    found = sorted(roots, key=lambda root: root[0])
    if not found:
        raise ValueError(f"{name} does not exist")
    return min(found, key=lambda root: abs(root[0] - guess))


def _rods(x: Any) -> Iterator[tuple[arb, acb]]:
    """Lengths L4 that put the suspension axis at its least height, and where it is then."""
    O1, O3, O5, _ = _hinges(x)
    P34 = O3 + (rrr(O1, O3, x.S_min, x.L3, -1) - O3) * _arm(x)
    for u in _low_links(x, x.Y56_min):
        P45 = O5 + x.L5 * u
        if cross(O5 - P34, P45 - P34) >= 0:
            yield abs(P45 - P34), O5 + x.L56 * u


def _strokes(x: Any, L4: arb) -> Iterator[tuple[arb, acb]]:
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
            if inside and cross(O5 - P34, P45 - P34) >= 0 and cross(O3 - O1, P23 - O1) <= 0:
                yield S, O5 + x.L56 * u


def _upper_links(x: Any, P56: acb) -> Iterator[tuple[arb, acb]]:
    """Length L7 that puts the mast at its angle, and its upper pin."""
    O7 = _hinges(x)[-1]
    P67 = P56 + x.L6 * turn(x.phi_P6)
    if cross(O7 - P56, P67 - P56) <= 0:
        yield abs(P67 - O7), P67


def _low_links(x: Any, height: arb) -> Iterator[acb]:
    """Directions of the lower link that put its end at the height."""
    rise = (height - x.Y05) / x.L56
    if abs(rise) <= 1:
        run = (1 - rise**2).sqrt()
        yield from (acb(run, rise), acb(-run, rise))


def _hinges(x: Any) -> tuple[acb, ...]:
    return tuple(acb(getattr(x, f"X0{k}"), getattr(x, f"Y0{k}")) for k in (1, 3, 5, 7))


def _arm(x: Any) -> Any:
    """The side of the lift arm next to the rod over the one next to the cylinder."""
    return x.L34 / x.L3 * turn(x.phi_BD)


def _pins(x: Any, L4: arb, L7: arb) -> Callable[[arb], Numbers]:
    """Where the pins are as a function of the stroke."""
    O1, O3, O5, O7 = _hinges(x)
    arm, lever = _arm(x), x.L56 / x.L5

    def at(S: arb) -> Numbers:
        P23 = rrr(O1, O3, S, x.L3, -1)
        P34 = O3 + (P23 - O3) * arm
        P45 = rrr(P34, O5, L4, x.L5, +1)
        P56 = O5 + (P45 - O5) * lever
        P67 = rrr(P56, O7, x.L6, L7, -1)
        frame = {"O1": O1, "O3": O3, "O5": O5, "O7": O7}
        return frame | {"P23_S": P23, "P34_S": P34, "P45_S": P45, "P56_S": P56, "P67_S": P67}

    return at


@lru_cache(maxsize=1)  # while the loads alone change
def _motion(S: Any, lengths: tuple[tuple[str, Any], ...], **unloaded: Any) -> Numbers:
    """Positions, and derivatives with respect to S; the implement is fixed to the mast where it stands at S_p."""
    x, given = exactly(SimpleNamespace(**unloaded)), {name: arb(value) for name, value in lengths}
    length = given if len(given) == 3 else _finds(**unloaded) | given
    Z, at = acb(x.X6, x.Y6), _pins(x, length["L4"], length["L7"])
    at_work = at(length["S_p"])
    mast = at_work["P67_S"] - at_work["P56_S"]
    turned = Z / mast

    def pins(S: arb) -> Numbers:
        p = at(S)
        return p | {"PS6_S": p["P56_S"] + turned * (p["P67_S"] - p["P56_S"])}

    moves = moving(pins, length["S_p"] if S is None else arb(S))
    links = {k: moves[start].to(moves[end]) for k, (start, end) in _LINKS.items()}
    dphi3, dphi4, dphi5, dphi6, dphi7 = ((link.first / link.here).imag for link in links.values())
    I56, IS6 = (moves[name].first.imag for name in ("P56_S", "PS6_S"))
    results = {name: move.here for name, move in moves.items()} | length
    results |= {f"phi{k}_S": angle(link.here) for k, link in links.items()}
    results |= {"phi12_S": angle(results["P23_S"] - results["O1"]), "phi34_S": results["phi3_S"] + x.phi_BD}
    phiS6 = angle(Z) - angle(mast)
    results |= {"LS6": abs(Z), "phiS6": phiS6 + 2 * arb.pi() if phiS6 < 0 else phiS6}
    results |= {"dphi3": dphi3, "dphi4": dphi4, "dphi5": dphi5, "dphi6": dphi6, "dphi7": dphi7}
    results |= {"U43": dphi4 / dphi3, "U53": dphi5 / dphi3, "U65": dphi6 / dphi5, "U75": dphi7 / dphi5}
    return results | {"I56": I56, "IS6": IS6, "Imp": I56, "Isp": IS6}


def _capacity(x: Any, at: Numbers) -> Numbers:
    F_gc, S_gc = x.P6 * at["IS6"], arb.pi() * x.D_gc**2 / 4
    greatest = x.k_gc * x.P_gc_max * x.eta * S_gc
    G56, GS6 = greatest / at["I56"], greatest / at["IS6"]
    P_gc, dGS65 = F_gc / (x.k_gc * S_gc * x.eta), (GS6 - x.P6) / x.P6
    return {"F_gc": F_gc, "S_gc": S_gc, "P_gc": P_gc, "G56": G56, "GS6": GS6, "dGS65": dGS65}


def _forces(x: Any, at: Numbers) -> Numbers:
    """Links 2, 4 and 7 carry forces along themselves only; moments of the bodies 6, 5, 3 give one force each."""
    G6 = acb(0, -x.P6)

    def along(link: acb, arm: acb, moment: arb) -> Any:
        return -link * (moment / cross(arm, link))

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
    share = arb(1) / 5
    Ra, Ra_min = (moment - x.P6 * X) / x.L, share * weight
    loads = {"Ra": Ra, "Rb": weight - Ra, "dRa": Ra / weight, "dRb": (weight - Ra) / weight, "Ra_min": Ra_min}
    GS6_lim = (moment - share * x.L * (x.P_msha + x.P_gr)) / (X + share * x.L)
    return loads | {"GS6_max": (moment - Ra_min) / X, "GS6_lim": GS6_lim}


# --- landing gear -------------------------------------------------------------------------------------------------


@in_balls
def stroke(g: Any) -> Numbers:
    """Synthesis of the landing gear worksheet, from the tangent drawn from O1 to the circle of A."""
    return _stroke(exactly(g))


def _stroke(x: Any) -> Numbers:
    O1, A_0, A_n = _leg_ends(x)
    l20, l2n = abs(A_0 - O1), abs(A_n - O1)
    lengths = {"l20": l20, "l2n": l2n, "H": l2n - l20, "V21": (l2n - l20) / x.t_r}
    angles = {"psi": angle(acb(0, -1) / A_0), "alpha_0": _pressure(O1, A_0), "alpha_n": _pressure(O1, A_n)}
    return lengths | angles


@in_balls
def landing_gear(g: Any, l2: Any) -> Numbers:
    """Results of the landing gear worksheet for the length l2 [m] of the cylinder.

    A lies on two circles; everything else is differentiated.
    """
    x = exactly(g)
    synthesis = _stroke(x)
    O1, A_0, _ = _leg_ends(x)
    l2, l3, V21 = arb(l2), x.l3, synthesis["V21"]
    leg, rod = moving(lambda l2: {"A": rrr(O1, acb(0), l2, l3, +1), "O1": O1}, l2).values()
    A, u = leg.here, (leg.here - O1) / l2
    (omega3, eps3), (omega2, eps2) = leg.rotation(), leg.to(rod).rotation()
    down = acb(0, -1) * l3 / A_0 * A / l3  # unit vector down the leg
    S3, W3, D3 = x.r3 * down, x.l_w * down, x.l_w / 2 * down
    a_S = V21**2 * acb(-(omega3**2), eps3) * S3
    n = acb(0, 1) * down
    G, q = acb(0, -x.m3 * x.g_n), x.rho * x.U * abs(x.U) / 2
    wind = [(acb(q * x.C_w), W3), (q * x.C_s * n.real * abs(n.real) * n, D3)]
    moment = sum(cross(P, F) for F, P in [*wind, (G, S3)])
    F_c = ((x.J3 + x.m3 * x.r3**2) * V21**2 * eps3 - moment) / cross(A, u)
    motion = {"Ai": A, "phi2i": angle(O1 - A), "phi3i": angle(A), "alpha": _pressure(O1, A)}
    motion |= {"omega3_l2i": omega3, "omega2_l2i": omega2, "eps3_l2i": eps3, "eps2_l2i": eps2}
    motion |= {"omega3i": V21 * omega3, "omega2i": V21 * omega2, "eps3i": V21**2 * eps3, "eps2i": V21**2 * eps2}
    R03 = x.m3 * a_S - G - F_c * u - sum(F for F, _ in wind)
    return synthesis | motion | {"F_c": F_c, "P_c": F_c * V21, "R23": F_c * u, "R03": R03}


def _leg_ends(x: Any) -> tuple[acb, acb, acb]:
    """Hinge O1, and the pin A where the leg is extended and where it is retracted."""
    O1 = acb(-x.b, x.a)
    l12 = abs(O1)
    tangent = x.l3 * O1 / l12**2 * acb(x.l3, -(l12**2 - x.l3**2).sqrt())
    return O1, tangent * turn(x.theta / 2), tangent / turn(x.theta / 2)


def _pressure(O1: acb, A: acb) -> arb:
    """Angle from the force along the rod to the velocity of A, which turns clockwise about the origin."""
    return angle(acb(0, -1) * A / (A - O1))


# --- slotted link and four-bar linkage ------------------------------------------------------------------------------


@in_balls
def slotted_link(g: Any, phi1: Any) -> Numbers:
    """Slider, turning of the link and motion of its end C at the angle phi1 [rad] of the crank, all differentiated."""
    x, phi1 = exactly(g), arb(phi1)

    def at(t: arb) -> Numbers:
        A = acb(0, x.L0) + x.L1 * turn(phi1 + x.omega1 * t)
        return {"A": A, "SAB": abs(A), "C": x.L3 * A / abs(A)}

    A, SAB, C = moving(at, arb(0)).values()
    omega, eps = A.rotation()
    slider = {"SAB_k": SAB.here, "VAB_k": SAB.first, "WAB_k": SAB.second, "phi3_k": angle(A.here)}
    link = {"omega_BC_k": omega, "eps_BC_k": eps, "WCn_k": omega**2 * x.L3, "WCt_k": eps * x.L3}
    return slider | link | {"P_C_k": C.here, "VC_k": C.first, "WC_k": C.second}


@in_balls
def four_bar(a: Any, b: Any, c: Any, d: Any, theta: Any) -> Numbers:
    """Pin C and the angles of coupler and rocker; the crank a turns about 0, the rocker c about d, C to the left."""
    A, B = arb(a) * turn(arb(theta)), acb(d) if isinstance(d, complex) else acb(arb(d), 0)
    C = rrr(A, B, arb(b), arb(c), +1)
    return {"C": C, "phi2": angle(C - A), "phi3": angle(C - B)}


# --- numbers ------------------------------------------------------------------------------------------------------


def numbers(g: Any) -> dict[str, Any]:
    """Inputs that are numbers; the sides on which a mechanism is assembled are none, and here those of the document."""
    return {name: value for name, value in vars(g).items() if not isinstance(value, str | Chosen)}


def exactly(g: Any) -> SimpleNamespace:
    """The same in balls."""
    return SimpleNamespace(**{name: arb(value) for name, value in numbers(g).items()})


def turn(phi: arb) -> acb:
    """The unit vector at an angle."""
    return acb(0, phi).exp()


def angle(z: acb) -> arb:
    """The angle of a vector, in (-pi, pi]; NaN of one that is none."""
    if not z.is_finite():
        return arb.nan()
    if z.real < 0:  # a ball about pi would be one about -pi too
        return (-z).arg() - (1 if z.imag < 0 else -1) * arb.pi()
    return z.arg()
