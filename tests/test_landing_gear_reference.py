"""Every line of the landing gear worksheet against two circles, their differences, and the leg's equilibrium."""

import numpy as np
import pytest
from independent import SLIDERS, along, circles, disagreements, inputs, moment, turns


def reference(g):
    O1 = complex(-g.b, g.a)
    l12 = abs(O1)
    upward = np.angle(1j / O1)  # from the line O2 O1 to the vertical, clockwise positive
    mu = np.arctan2(np.sqrt(l12**2 - g.l3**2), g.l3)  # the tangent from O1 touches the circle of A

    def crank(gamma):  # turned so far from O2 O1, clockwise
        return g.l3 * O1 / l12 * np.exp(-1j * gamma)

    def pressure(A):  # from the force on A to the velocity of A, which goes clockwise
        return np.angle(-1j * A / (A - O1))

    gammas = mu + g.theta / 2 * np.array([-1, 1])
    (l20, l2n), (alpha_0, alpha_n) = abs(crank(gammas) - O1), pressure(crank(gammas))
    H, V = l2n - l20, (l2n - l20) / g.t_r
    mounted = -1j * g.l3 / crank(gammas[0])  # the leg hangs where the cylinder is shortest
    step = min(1e-3 * H, 0.02 * (l20 - (l12 - g.l3)))

    def A(l2):
        return circles(O1, l2, 0j, g.l3, +1)

    def rates(l2):
        return (*turns(A, l2, step), *turns(lambda x: O1 - A(x), l2, step))

    def leg(l2):
        return A(l2) / g.l3 * mounted

    def at(l2):
        a, e = A(l2), leg(l2)
        w3, e3, w2, e2 = rates(l2)
        moved = {"A": a, "alpha": pressure(a), "omega3_l2": w3, "eps3_l2": e3, "omega2_l2": w2, "eps2_l2": e2}
        moved |= {"phi2": np.angle(O1 - a), "phi3": np.angle(a), "phi32": np.angle(a / (O1 - a)), "e3": e}
        moved |= {"W3": g.l_w * e, "D3": g.l_w / 2 * e, "S3": g.r3 * e}
        return moved | forces(g, V, O1, a, e, w3, e3, step)

    n = -(-60 // g.R)
    l2i, l2f = np.linspace(l20, l2n, g.R + 1), np.linspace(l20, l2n, n * g.R + 1)
    i, f = at(l2i), at(l2f)
    known = {f"{name}(l2i)": i[name] for name in ("A", "phi2", "phi3", "phi32", "e3", "W3", "D3", "S3")}
    known |= {f"{name}(l2i)": i[name] for name in ("omega3_l2", "omega2_l2", "eps3_l2", "eps2_l2", "Q3", "a_S3")}
    known |= {f"{name}i": i[name] for name in ("A", "phi2", "phi3", "phi32", "omega3_l2", "omega2_l2")}
    known |= {"eps3_l2i": i["eps3_l2"], "eps2_l2i": i["eps2_l2"], "A_group": i["A"], "alpha": i["alpha"]}
    known |= {
        f"{name}f": f[name] for name in ("omega3_l2", "omega2_l2", "eps3_l2", "eps2_l2", "F_c", "F_G", "F_Q", "F_I")
    }
    known |= {"alpha_f": f["alpha"], "P_cf": f["F_c"] * V, "P_c": i["F_c"] * V, "l2i": l2i, "l2f": l2f, "every": n}
    known |= {name: i[name] for name in ("R01", "R03", "R23", "F_c", "F_G", "F_Q", "F_I", "F_in", "M_in")}
    known |= {"thrust(Ai, group_23)": i["F_c"], "weight(l2i, omega3_l2i)": i["F_G"], "drag(l2i, omega3_l2i)": i["F_Q"]}
    known |= {"inertial(l2i, omega3_l2i)": i["F_I"], "E3(l2i) - E3(l2i[0])": i["E"] - i["E"][0]}
    known |= {f"v_{p}3(l2i, omega3_l2i)": 1j * i["omega3_l2"] * i[f"{p}3"] for p in "SWD"}
    known |= {"F3 / largest": 0, "M3 / largest": 0, "M2 / largest": 0}
    known = {k.replace("largest", "np.max(abs(R23))"): v for k, v in known.items()}
    known |= {"omega3i": V * i["omega3_l2"], "omega2i": V * i["omega2_l2"], "V21": V, "H": H, "l20": l20, "l2n": l2n}
    known |= {"eps3i": V**2 * i["eps3_l2"], "eps2i": V**2 * i["eps2_l2"], "eps2_printed": V * i["eps2_l2"]}
    known |= {"eps3_printed": -i["eps3_l2"], "G3": -1j * g.m3 * g.g_n, "q": g.rho * g.U * abs(g.U) / 2}
    known |= {"Q_w": g.rho * g.U * abs(g.U) / 2 * g.C_w, "i": np.arange(g.R + 1)}
    # Between O1 O2 and the cylinder, counted like phi2 from the direction of O1
    known |= {"beta2i": np.angle(-A(l2i) / O1 + 1), "beta2(l2i)": np.angle(1 - A(l2i) / O1), "O1": O1, "O2": 0}
    half = np.arcsin(i["A"].imag / g.l3)  # the arcsine of the projection on y
    known |= {"phi3_printed": half, "phi3_half(l2i)": half, "phi3_arccos": np.arccos(i["A"].real / g.l3)}
    turned = O1 - (O1 - i["A"]) * np.exp(0.5j * (3.14 - np.pi))  # A where the right angle of (26) is 3.14/2
    listed = np.arcsin(turned.imag / g.l3)
    known |= {"phi2_listing": np.angle(O1 - turned), "phi3_listing": listed, "phi3_sine(l2i, phi2_listing)": listed}
    known["phi3_cosine(l2i, phi2i)"] = known["phi3_arccos"]
    between = np.exp(1j * listed) / (O1 - turned) * l2i
    known |= {"phi32_listing": np.angle(between), "omega3_listing": between.imag / g.l3}
    known |= {"omega2_listing": -between.imag * between.real / l2i}
    sine, cosine = between.imag, between.real
    known["eps3_listing"] = -(known["omega2_listing"] ** 2 * l2i / g.l3 + known["omega3_listing"] ** 2 * cosine) / sine
    known |= promin(g, l2i, np.exp(1j * known["phi3_arccos"]) * l2i / (O1 - i["A"]))
    known["psi_listing"] = np.angle(mounted) + 3.14 - np.pi  # from the crank to the leg
    known |= synthesis(g, O1, crank, pressure, mounted) | {"gamma_0": gammas[0], "gamma_n": gammas[1], "mu": mu}
    known |= {"alpha_0": alpha_0, "alpha_n": alpha_n, "beta0": -upward, "l12": l12, "phi3k": np.angle(crank(mu))}
    l2k = abs(crank(mu) - O1)
    known |= {"l2k": l2k, "p_k": (l2k - l20) / H, "l2_t": l20 + SLIDERS["part"].value * H}
    return known | times(g, H, l2i, rates)


def promin(g, l2, way):
    """The other program, from the crank's direction in the axes of the cylinder; its omega2 has the other sign."""
    cot, rate = way.real / way.imag, 1 / g.l3 / way.imag
    eps3 = cot * rate**2 - (cot / l2) ** 2 * rate
    known = {"phi32_promin": np.angle(way), "omega3_promin": rate, "omega2_promin": cot / l2, "eps3_promin": eps3}
    return known | {"eps2_promin": (rate - g.l3 * eps3 * way.real - 2 * cot / l2) / l2}


def synthesis(g, O1, crank, pressure, mounted):
    """The mounting angle, and that of equal pressure angles: O1 is then in line with both ends of the pin A."""
    low, high = g.theta / 2, np.pi - g.theta / 2
    for _ in range(60):
        middle = (low + high) / 2
        ends = crank(middle + g.theta / 2 * np.array([-1, 1]))
        low, high = (middle, high) if abs(pressure(ends[0])) > abs(pressure(ends[1])) else (low, middle)
    turned = -1j * g.l3 / ends[0]
    return {"psi": np.angle(mounted), "mu_eq": middle, "psi_eq": np.angle(turned), "alpha_eq": abs(pressure(ends[0]))}


def forces(g, V, O1, a, e, w3, e3, step):
    """Loads on the leg, what they do on a metre of the cylinder, and the reactions that hold leg and cylinder."""
    n, q = 1j * e, g.rho * g.U * abs(g.U) / 2
    S, W, D = g.r3 * e, g.l_w * e, g.l_w / 2 * e
    Q3, G3 = q * g.C_s * n.real * abs(n.real) * n, -1j * g.m3 * g.g_n
    a_S3 = V**2 * (1j * e3 - w3**2) * S
    F_in, M_in = -g.m3 * a_S3, -g.J3 * V**2 * e3
    shares = {"F_G": -along(G3, 1j * w3 * S)}
    shares["F_Q"] = -along(q * g.C_w + 0j, 1j * w3 * W) - along(Q3, 1j * w3 * D)
    shares["F_I"] = -along(F_in, 1j * w3 * S) - M_in * w3
    rod = (a - O1) / abs(a - O1)
    M = moment(S, G3 + F_in) + M_in + moment(W, q * g.C_w + 0j) + moment(D, Q3)
    F_c = -M / moment(a, rod)
    R03 = -(G3 + F_in + q * g.C_w + Q3 + F_c * rod)
    E = g.m3 * abs(1j * w3 * V * S) ** 2 / 2 + g.J3 * (V * w3) ** 2 / 2 + g.m3 * g.g_n * S.imag
    found = {"F_c": F_c, "R23": F_c * rod, "R01": F_c * rod, "R03": R03, "E": E, "Q3": Q3, "a_S3": a_S3}
    return found | shares | {"F_in": F_in, "M_in": M_in}


def times(g, H, l2i, rates):
    """Retraction time and the angular acceleration of the leg, which falls with its square."""
    ends = abs(rates(np.array([l2i[0], l2i[-1]]))[1])
    t = np.linspace(g.t_a, g.t_b, 11)
    parts = {"p0": 0, "p25": 0.25, "p75": 0.75, "p100": 1}
    curves = {f"eps3_{name}": (H / t) ** 2 * rates(l2i[0] + p * H)[1] for name, p in parts.items()}
    t_lim = H * np.sqrt(max(ends) / g.eps_lim)
    known = {"t": t, "t_lim": t_lim, "t_c": t_lim, "eps3_m": max(ends), "eps_max": g.eps_lim, "eps_min": -g.eps_lim}
    known |= {"eps3_lim": (H / t_lim) ** 2 * rates(l2i)[1], "eps3_g(2.0)": (H / 2) ** 2 * max(ends)}
    known |= {"eps3_t(2.0, 0.25)": (H / 2) ** 2 * rates(l2i[0] + H / 4)[1], "eps3_k / eps3_m": 0}
    return known | curves


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"a": -0.3, "b": 0.9, "l3": 0.41, "theta": 1.1, "R": 5, "U": -60.0, "t_r": 5.0},
        {"a": 1.1, "b": -0.2, "theta": 0.7},
    ],
    ids=["as printed", "hinge below, wind from behind", "hinge above"],
)
def test_every_line_is_that_of_two_circles(changed):
    g = inputs("landing_gear", **changed)
    assert disagreements("landing_gear", g, reference(g), within=1e-6) == []
