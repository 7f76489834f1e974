"""Every line of the bolted joint worksheet against pieces of bar, slices of the flanges and halving."""

from itertools import pairwise
from math import pi

import mpmath as mp
import numpy as np
import pytest
from independent import disagreements, inputs

SHEET = "examples/bolted_joint"
INCH = 0.0254


def bar(length, diameter, E):
    """How much a round bar gives way."""
    return length / (E * pi * (diameter / 2) ** 2)


def flanges(g, tangent):
    """What both flanges give way: slices of the cones, which end at the flanges' diameter."""

    def slice_of(z):
        outside = mp.mpf(min(g.d_w + 2 * z * tangent, g.D_A))
        return 1 / (g.part.E * mp.pi / 4 * (outside**2 - g.d_h**2))

    end = min(g.l_K / 2, (g.D_A - g.d_w) / (2 * tangent))
    with mp.workdps(30):
        return float(2 * mp.quad(slice_of, [0, end, g.l_K / 2] if end < g.l_K / 2 else [0, end]))


def joint(delta_S, delta_P, c, stretch, load):
    """Bolt force and compression of the gasket: the one that uses all of the stretch, by halving."""
    low, high = -delta_S * load - 1e-3, stretch
    for _ in range(200):
        x = (low + high) / 2
        clamp = c * x**2 if x > 0 else 0.0
        low, high = (x, high) if delta_S * (load + clamp) + delta_P * clamp + x < stretch else (low, x)
    return load + (c * x**2 if x > 0 else 0.0), x


def reference(g):
    d_2, d_3, d_s = (g.d - part * g.P for part in (0.649519, 1.226869, 0.9743))
    A_s = pi * (d_s / 2) ** 2
    bolt = [(0.4 * g.d, g.d), (g.l_1, g.d), (g.l_K - g.l_1, d_3), (0.5 * g.d, d_3), (0.5 * g.d, g.d)]
    delta_S = sum(bar(length, diameter, g.E_S) for length, diameter in bolt)
    t = 0.362 + 0.032 * np.log(g.l_K / g.d_w / 2) + 0.153 * np.log(g.D_A / g.d_w)
    delta_P, D_K = flanges(g, t), min(g.D_A, g.d_w + t * g.l_K)
    known = {"mil": INCH / 1000, "d_2": d_2, "d_3": d_3, "d_s": d_s, "A_s": A_s, "delta_S * 1e9": delta_S * 1e9, "t": t}
    known |= {"D_K": D_K, "l_H + 1": 1 + g.l_K - (D_K - g.d_w) / t, "delta_P * 1e9": delta_P * 1e9}
    z = np.linspace(0, g.l_K / 2, 201)
    ring = [pi / 4 * (min(g.d_w + 2 * t * each, g.D_A) ** 2 - g.d_h**2) for each in z]
    slices = sum((1 / a + 1 / b) * (z[1] - z[0]) for a, b in pairwise(ring))
    known |= {"delta_z * 1e9": slices / g.part.E * 1e9}
    c = g.F_G / g.x_G / g.x_G
    known |= {"z": z, "A_z": ring, "c": c, "F_K(np.array([-1e-4, 2e-4]))": [0, c * 4e-8]}
    return known | tightened(g, A_s, d_2, d_s, (delta_S, delta_P, c))


def tightened(g, A_s, d_2, d_s, springs):
    delta_S, delta_P, c = springs
    slope = g.P / (pi * d_2) + g.mu_G * 1.155  # of the thread, with its friction
    torsion = slope * d_2 / 2 / (pi * d_s**3 / 12) * A_s  # plastic, over the pull
    F_M = g.nu * g.grade.R_p * A_s / np.sqrt(1 + 3 * torsion**2)
    D_m, F_M0 = (g.d_w + g.d_h) / 2, F_M / g.tool.alpha
    known = {"k_t": torsion, "F_M": F_M, "D_m": D_m, "M_A": F_M * (slope * d_2 / 2 + g.mu_K * D_m / 2), "F_M0": F_M0}
    u_0, u_1 = (F * (delta_S + delta_P) + (F / c) ** 0.5 for F in (F_M0, F_M))
    u_0 -= g.f_Z
    known |= {"u_0": u_0, "u_1": u_1, "k_u / c * 1e9": (delta_S + delta_P) * 1e9}
    F_A, F_Q = np.array(g.cases.F_A), np.array(g.cases.F_Q)
    (S0, x0), (S1, x1) = (np.array([joint(*springs, u, F) for F in F_A]).T for u in (u_0, u_1))
    known |= {"F_S0": S0, "x_0": x0, "F_K0": S0 - F_A, "x_0c": x0, "b_0": u_0 - delta_S * F_A}
    known |= {"F_S1": S1, "x_1": x1, "x_1c": x1, "b_1": u_1 - delta_S * F_A, "F_A": F_A, "F_Q": F_Q}
    sigma, tau = S1 / A_s, torsion * F_M / A_s
    both = np.sqrt(sigma**2 + 3 * (tau / 2) ** 2)
    known |= {"sigma": sigma, "tau": tau, "sigma_r": both, "S_F": g.grade.R_p / both, "F_R": F_Q / g.mu_T}
    known |= {"sigma_a": (max(S1) - min(S1)) / A_s / 2, "sigma_A": 0.85 * (150 / (g.d * 1e3) + 45) * 1e6}
    known |= {"p_K": max(S1) / (pi * ((g.d_w / 2) ** 2 - (g.d_h / 2) ** 2))}
    return known | growing(springs, u_0)


def growing(springs, u_0):
    delta_S, delta_P, c = springs
    F_o = u_0 / delta_S
    F, F_t = np.linspace(0, 1.5 * F_o, 61), np.linspace(0, 0.9 * F_o, 10)
    S, x = np.array([joint(*springs, u_0, load) for load in F]).T
    known = {"F_o": F_o, "F": F, "F_SF": S, "x_F": x, "x_Fc": x, "F_KF": S - F, "h_F": [max(-each, 0) for each in x]}
    known |= {"b_F": u_0 - F * delta_S, "x_F0(F_t)": [joint(*springs, u_0, load)[1] for load in F_t], "F_t": F_t}
    step = 1e-4 * F_o
    ends = [(joint(*springs, u_0, load - step)[0], joint(*springs, u_0, load + step)[0]) for load in F_t]
    slopes = [(high - low) / (2 * step) for low, high in ends]
    known |= {"Phi_t": slopes, "Phi(F_t)": slopes}
    little = 1e-9  # of the gasket, a little more and a little less
    known["delta_T(2e-4) * 1e9"] = 1e9 * (delta_P + 2 * little / (c * (2e-4 + little) ** 2 - c * (2e-4 - little) ** 2))
    f = np.linspace(0, u_0, 41)
    parts = []
    for each in f:  # the force under which flanges and gasket take what the bolt has not
        low, high = 0.0, c * u_0**2
        for _ in range(200):
            force = (low + high) / 2
            low, high = (force, high) if delta_P * force + (force / c) ** 0.5 < u_0 - each else (low, force)
        parts.append(force)
    return known | {"f": f, "F_f": f / delta_S, "F_p": parts}


@pytest.mark.parametrize(
    "changed",
    [{}, {"D_A": 0.9 * INCH, "x_G": 0.2e-3, "nu": 0.6}, {"nu": 0.15, "f_Z": 2e-5, "l_1": 0.2 * INCH}],
    ids=["as it is", "narrow flanges", "hardly tightened, so that it opens"],
)
def test_every_line_is_that_of_bars_slices_and_halving(changed):
    g = inputs(SHEET, **changed)
    assert disagreements(SHEET, g, reference(g), within=1e-6) == []
