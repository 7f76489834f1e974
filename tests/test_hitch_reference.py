"""Every line of the hitch worksheet against circles, their differences, and the equilibrium of the bodies."""

import numpy as np
import pytest
from independent import SLIDERS, circles, disagreements, inputs, moment, slopes, turns

STEP = 1e-4


def lengths(g, hinge, lever):
    """Lifting rod, stroke at work and upper link: distances of points that are known from the wanted position."""

    def low(height):  # pins of the lower link whose end is at that height
        slope = np.arcsin((height - g.Y05) / g.L56)
        return hinge[5] + g.L5 * np.exp(1j * slope), hinge[5] + g.L56 * np.exp(1j * slope)

    P45_0, _ = low(g.Y56_min)
    L4 = abs(P45_0 - lever(g.S_min)[1])
    P45_p, P56_p = low(g.Y_P56)
    P34_p = circles(hinge[3], g.L34, P45_p, L4, +1)
    P23_p = hinge[3] + (P34_p - hinge[3]) * np.exp(-1j * g.phi_BD) * g.L3 / g.L34
    S_p, L7 = abs(P23_p - hinge[1]), abs(P56_p + g.L6 * np.exp(1j * g.phi_P6) - hinge[7])
    known = {"L4": L4, "L4_c": L4, "S_p": S_p, "S_c": S_p, "L7": L7, "L7_c": L7, "P45_0": P45_0, "P45_p": P45_p}
    known |= {"P34_p": P34_p, "P23_p": P23_p, "P56_p": P56_p, "phi5_0": np.angle(P45_0 - hinge[5])}
    known |= {"P34_0": lever(g.S_min)[1], "psi5_0": known["phi5_0"], "psi5_p": np.angle(P45_p - hinge[5])}
    sides = {"s_23": -1, "s_45": 1, "s_67": -1, "s_34": 1, "s_6": 1}  # of the machine as it is printed
    return known | sides | {"phi5_p": np.angle(P45_p - hinge[5])}


def reference(g):
    hinge = {k: complex(getattr(g, f"X0{k}"), getattr(g, f"Y0{k}")) for k in (1, 3, 5, 7)}

    def lever(S):
        pin = circles(hinge[1], S, hinge[3], g.L3, -1)
        return pin, hinge[3] + (pin - hinge[3]) / g.L3 * g.L34 * np.exp(1j * g.phi_BD)

    found = lengths(g, hinge, lever)

    def pins(S):
        P23, P34 = lever(S)
        P45 = circles(P34, found["L4"], hinge[5], g.L5, +1)
        P56 = hinge[5] + (P45 - hinge[5]) * g.L56 / g.L5
        return P23, P34, P45, P56, circles(P56, g.L6, hinge[7], found["L7"], -1)

    def link(k):
        ways = {2: (hinge[1], 0), 3: (hinge[3], 0), 4: (1, 2), 5: (hinge[5], 2), 6: (3, 4), 7: (hinge[7], 4)}
        start, end = ways[k]
        return lambda S: pins(S)[end] - (start if isinstance(start, complex) else pins(S)[start])

    Z = complex(g.X6, g.Y6)
    work = link(6)(found["S_p"])

    def mass(S):
        return pins(S)[3] + Z * link(6)(S) / work

    S = np.linspace(g.S_min, g.S_max, g.N_pol)
    P23, P34, P45, P56, P67 = pins(S)
    PS6 = mass(S)
    turn = {k: turns(link(k), S, STEP)[0] for k in range(3, 8)}
    I56, IS6 = slopes(lambda s: pins(s)[3].imag, S, STEP)[0], slopes(lambda s: mass(s).imag, S, STEP)[0]
    known = found | {f"O{k}": hinge[k] for k in hinge} | {f"dphi{k}": turn[k] for k in turn}
    known |= {"I56": I56, "IS6": IS6, "Imp": I56, "Isp": IS6, "S": S, "k": np.arange(g.N_pol)}
    known |= {"dS": S[1] - S[0], "t": (S - g.S_min) / (g.S_max - g.S_min)}
    known |= {"U43": turn[4] / turn[3], "U53": turn[5] / turn[3], "U65": turn[6] / turn[5], "U75": turn[7] / turn[5]}
    known |= {"x_6": PS6.real, "P23_S": P23, "P34_S": P34, "P45_S": P45, "P56_S": P56, "P67_S": P67, "PS6_S": PS6}
    known |= {"P23c_S": P23, "P34s_S": P34, "P45s_S": P45, "P67s_S": P67}
    known |= {"P23(S)": P23, "P34(S)": P34, "P45(S, L4)": P45, "P56(S, L4)": P56, "P67(S, L7)": P67, "PS6(S)": PS6}
    known |= {f"phi{k}_S": np.angle(link(k)(S)) for k in range(3, 8)} | {"phi12_S": np.angle(link(2)(S))}
    known |= {"phi34_S": np.angle(P34 - hinge[3]), "phi3(S)": known["phi3_S"], "phi12(S)": known["phi12_S"]}
    known |= {"phi34(S)": known["phi34_S"], "phi4(S, L4)": known["phi4_S"], "phi5(S, L4)": known["phi5_S"]}
    known |= {"phi6(S, L7)": known["phi6_S"], "phi7(S, L7)": known["phi7_S"], "phi6P(P56_S, L7)": known["phi6_S"]}
    known |= frame(g, hinge, S, found, Z, pins) | capacity(g, I56, IS6) | stability(g, PS6)
    known |= reactions(g, hinge, pins(S), PS6)
    link_5, link_7 = P56 - hinge[5], P67 - hinge[7]
    D_p = moment(link_5, link_7)
    pole = hinge[5] + link_5 * moment(hinge[7] - hinge[5], link_7) / D_p  # where the links 5 and 7 meet
    known |= {"S1": abs(P34 - hinge[5]), "L53": abs(P56 - hinge[7]), "X_p": pole.real, "P56_d": P56}
    known |= {"S1_S": known["S1"], "L53_S": known["L53"]}
    known |= {"D_p": D_p, "N_p / D_p": (pole - hinge[5]).real, "k_p * D_p": turn[6]}
    return known | by_the_document(hinge, P34, P45, P56, P67, known)


def by_the_document(hinge, P34, P45, P56, P67, known):
    """What its own formulas give: turns of vectors from the lines O3 O5 and O7 O5, distances from pin to pin."""
    base = hinge[3] - hinge[5]
    found = {"phi341": np.angle((hinge[3] - P34) / base), "phiS1": np.angle(base / (P34 - hinge[5]))}
    found |= {"phi41": np.angle((P34 - P45) / base), "phi51": np.angle((hinge[5] - P45) / base)}
    base = hinge[5] - hinge[7]
    found |= {"phi53": np.angle((P56 - hinge[7]) / base)}
    found |= {"phi61": np.angle((P67 - P56) / base), "phi71": np.angle((P67 - hinge[7]) / base)}
    found |= {f"phi{k}_d": known[f"phi{k}_S"] for k in range(3, 8)}
    found |= {"dphi3_d": known["dphi3"], "X_pd": known["X_p"], "Imp_d": known["I56"], "Isp_d": known["IS6"]}
    found |= {"AA": moment(hinge[5] - P56, P56), "EE": moment(hinge[7] - P67, P67)}
    found |= {"BB": (hinge[7] - P67).real, "CC": (hinge[7] - P67).imag}
    return found | {"DD": (hinge[5] - P56).real, "FF": (hinge[5] - P56).imag}


def frame(g, hinge, S, found, Z, pins):
    known = {f"L{a}{b}": abs(hinge[a] - hinge[b]) for a, b in ((1, 3), (3, 5), (5, 7))}
    known["phi13"] = -np.angle(hinge[1] - hinge[3])  # the document counts slopes from x to the left and upwards
    known |= {f"delta{n}": -np.angle(hinge[5] - hinge[k]) for n, k in ((1, 3), (2, 7))}
    known |= {"L4_0": 0.8 * g.L4_pre, "L7_0": 0.8 * g.L7_pre, "LS6": abs(Z)}
    known |= {"phiS6": np.angle(Z) - g.phi_P6, "r_s": abs(Z - pins(found["S_p"])[4])}
    corner = np.arccos((S**2 + abs(hinge[1] - hinge[3]) ** 2 - g.L3**2) / (2 * S * abs(hinge[1] - hinge[3])))
    known |= {"phi12_printed": known["phi13"] - corner, "P23s_S": hinge[1] + S * np.exp(1j * (known["phi13"] - corner))}
    at = round(SLIDERS["forces_at"].value * (g.N_pol - 1))
    return known | {"S_t": g.S_min + SLIDERS["part"].value * (g.S_max - g.S_min), "S_k": S[at], "k_t": at}


def capacity(g, I56, IS6):
    """The cylinders at their greatest pressure against a weight that rises by so much for a metre of them."""
    area = np.pi * (g.D_gc / 2) ** 2
    most = g.k_gc * area * g.P_gc_max * g.eta
    known = {"S_gc": area, "F_gc": g.P6 * IS6, "P_gc": g.P6 * IS6 / (g.k_gc * area) / g.eta}
    return known | {"G56": most / I56, "GS6": most / IS6, "dGS65": most / IS6 / g.P6 - 1}


def reactions(g, hinge, pins, PS6):
    """Links 2, 4 and 7 carry forces along themselves; the moments on the bodies 6, 5 and 3 give how much."""
    P23, P34, P45, P56, P67 = pins
    G6 = -1j * g.P6

    def held(start, end, about, force, at):  # force along a link that holds another one
        way = (end - start) / abs(end - start)
        return -way * moment(at - about, force) / moment(start - about, way)

    R07 = held(P67, hinge[7], P56, G6, PS6)
    R56 = -R07 - G6
    on_5 = held(P45, P34, hinge[5], -R56, P56)  # lifting rod on the lower link
    on_frame = on_5 - R56
    R01 = held(P23, hinge[1], hinge[3], -on_5, P34)
    known = {"G6": G6, "R07": R07, "R67": -R07, "R56": R56, "R65": -R56, "R34": -on_5, "R45": -on_5}
    known |= {"R05": on_frame, "R01": R01, "R23": R01, "R03": on_5 - R01}
    # what is left of forces and moments is only rounding
    left = {f"{name}{k} / np.max(abs(R34))": 0 for name in "FM" for k in range(2, 8)}
    left |= {f"F{k} / np.max(abs(R34))": 0 for k in (23, 45, 67)}
    printed = 2 * (P67 - P56).real * R56.imag  # twice the term whose sign is wrong
    # the document's lengths: heights a, c and abscissas b, d from pin to pin, e of the load or its moment
    ways = {"1": (hinge[7] - P67, P67 - P56), "2": (P34 - P45, hinge[5] - P45), "3": (P23 - hinge[1], hinge[3] - P23)}
    right = {"b1": -ways["1"][0], "d1": ways["1"][1], "b2": ways["2"][0], "d2": -ways["2"][1]}
    right |= {"b3": ways["3"][0], "d3": ways["3"][1], "e1": PS6 - P67}
    known |= {f"{axis}{k}": way.imag for k, pair in ways.items() for axis, way in zip("ac", pair, strict=True)}
    known |= {name: way.real for name, way in right.items()}
    known |= {"e2": moment(P56 - P45, -R56), "e3": moment(P34 - P23, on_5)}
    known |= {f"{name}_x": known[name].real for name in ("R56", "R05", "R34", "R03", "R01")}
    known |= {"D_2": moment(P45 - hinge[5], P34 - P45), "D_3": moment(hinge[3] - P23, P23 - hinge[1])}
    return known | left | {"R43": on_5, "M6_printed": printed}


def stability(g, PS6):
    """Wheels hold the machine: moments about the axles; then a fifth of all on the front one."""
    weights = {g.a + g.L: g.P_gr, g.b: g.P_msha}
    front = (sum(x * w for x, w in weights.items()) - PS6.real * g.P6) / g.L
    rear = (sum((g.L - x) * w for x, w in weights.items()) + (g.L + PS6.real) * g.P6) / g.L
    every = g.P6 + g.P_gr + g.P_msha
    known = {"Ra": front, "Rb": rear, "dRa": front / every, "dRb": rear / every, "Ra_min": every / 5}
    low, high = np.full(PS6.shape, -1e9), np.full(PS6.shape, 1e9)
    for _ in range(100):
        P = (low + high) / 2
        share = (sum(x * w for x, w in weights.items()) - PS6.real * P) / g.L - (P + g.P_gr + g.P_msha) / 5
        low, high = np.where(share > 0, P, low), np.where(share > 0, high, P)
    known |= {"GS6_lim": P, "Ra_lim": (P + g.P_gr + g.P_msha) / 5}
    return known | {"GS6_max": (sum(x * w for x, w in weights.items()) - every / 5) / PS6.real}  # as printed


CHANGES = [
    {},
    {"N_pol": 7, "P6": 1.9e4, "X6": 0.7, "Y6": -0.2, "k_gc": 3, "phi_P6": 1.4, "L4_pre": 0.55, "a": 0.9, "b": 1.3},
]


@pytest.mark.parametrize("changed", CHANGES, ids=["as printed", "another implement"])
def test_every_line_is_that_of_the_circles_and_the_bodies(changed):
    g = inputs("hitch", **changed)
    assert disagreements("hitch", g, reference(g), within=1e-7) == []
