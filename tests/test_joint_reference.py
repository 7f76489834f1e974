"""Every line of the joint worksheet against the section and the ring themselves: elements placed, axes tried."""

import numpy as np
import pytest
from independent import disagreements, inputs
from test_joint import even, ring_at_50_digits

ROUND = np.array([0.5 + 1j, 1 + 0.5j, 1 - 0.5j, 0.5 - 1j, -0.5 - 1j, -1 - 0.5j, -1 + 0.5j, -0.5 + 1j])
CORNERS = np.array([1 + 1j, 1 - 1j, -1 - 1j, -1 + 1j])
PRINTED = ("c_n", "phi_n", "k_0", "k_1", "k_2", "P_1", "P_n")


def bending(y, A, M, N):
    """a and b of the stresses a + b y that hold M and N."""
    return np.linalg.solve([[A.sum(), (A * y).sum()], [(A * y).sum(), (A * y * y).sum()]], [N, M])


def acting(y, A_t, A_c, M, N):
    """The areas that belong to the signs of their stresses: the axis tried at every level, both ways."""
    for axis in [*(y + 1e-9), y.min() - 1]:
        for way in (1, -1):
            A = np.where(way * (y - axis) > 0, A_t, A_c)
            if np.count_nonzero(A) > 1:
                a, b = bending(y, A, M, N)
                if np.all(np.where(a + b * y > 0, A_t, A_c) == A):
                    return A
    raise AssertionError("no equilibrium")


def iterated(y, A_t, A_c, M, N, start, steps):
    """Axes of the document's iteration, and the step from which on the areas repeat."""
    stretched, axes, settled = (y - start) * (1 if M >= 0 else -1) > 0, [], 0
    for n in range(1, steps + 1):
        a, b = bending(y, np.where(stretched, A_t, A_c), M, N)
        axes.append(-a / b)
        if np.all((a + b * y > 0) == stretched) and not settled:
            settled = n
        stretched = a + b * y > 0
    return axes, settled


def ring(g, first, M, N):
    """Bolts, resultant and line load of the ring, with the integrals over half of its compressed arc.

    The document's formulas, of the names in PRINTED, hold for a positive moment; a negative one pulls the other side.
    """
    phi = even(g.m, first)
    c = N * g.r / (2 * abs(M))
    P, _, p_0 = ring_at_50_digits(phi + np.pi * (M < 0), g.r, abs(M), N)
    P, edge = np.array([float(x) for x in P]), np.arccos(-c)
    node, weight = np.polynomial.legendre.leggauss(40)
    at, weight = edge + (np.pi - edge) * (node + 1) / 2, weight * (np.pi - edge) / 2
    arc, lever = (weight * (np.cos(at) + c)).sum(), (weight * (np.cos(at) + c) * np.cos(at)).sum()
    q = np.maximum(np.cos(phi) + c, 0)
    k = int(P.argmax())
    found = {"c_n": c, "phi_n": edge, "phi_no": edge, "k_0": arc, "k_1": lever / arc, "k_2": (1 - c) / 2 / arc}
    found |= {"S_1": q.sum(), "S_2": (q * np.cos(phi)).sum(), "P_1": P[k] / q[k], "P_n": P[k], "P_max": P[k]}
    found |= {} if M > 0 else dict.fromkeys(PRINTED, np.nan) | {"S_1": 0, "S_2": 0}
    return found | {
        "P_k": P,
        "p_n": float(p_0) if M > 0 else np.nan,
        "p_o": float(p_0),
        "P_str": float(p_0) * g.t,
        "M_x / M_r": (P * g.r * np.sin(phi)).sum() / M,
        "i_P": P[k] / (N / g.m + 2 * abs(M) / g.r / g.m),
        "i_p": float(p_0) / (N / (2 * np.pi * g.r) - abs(M) / (np.pi * g.r**2)),
    }


def reference(g):
    ratio = g.E_al / g.E_st
    beta = round(ratio / g.d_E) * g.d_E if g.d_E else ratio
    l_b, l_h, skin = g.psi * g.b / 2, g.psi * g.h / 2, g.k_a * g.delta**2
    near_b, near_h = (g.F_s if reach >= side / 4 else 0.0 for reach, side in ((l_b, g.b), (l_h, g.h)))
    F_sk = (l_b + g.h / 4) * g.delta
    more = beta * (F_sk + near_b + near_h)
    dF_tr = round(more / g.d_F) * g.d_F if g.d_F else more
    F_bt, F_bc, F_sc = g.F_b + dF_tr, g.F_b + beta * skin, beta * (g.F_s + skin)
    known = {
        "beta": beta, "t_b": g.b / 4, "t_h": g.h / 4, "l_b": l_b, "l_h": l_h, "F_sb": near_b, "F_sh": near_h,
        "F_sk": F_sk, "dF_t": F_sk + near_b + near_h, "dF_tr": dF_tr, "dF_cr": beta * skin, "F_bt": F_bt,
        "F_bc": F_bc, "F_sc": F_sc, "F_bt2": g.F_b + beta * ((l_b + l_h) * g.delta + near_b + near_h),
        "plane": np.array([1, 2])[:, None, None], "case": np.array([[1], [2]]), "beam": np.arange(4) + 1,
        "stringer": np.arange(8) + 1, "bolt": np.arange(g.m) + 1, "load": np.array([[1], [2]]),
        "h_p": np.array([g.h, g.b])[:, None, None], "b_p": np.array([g.b, g.h])[:, None, None],
    }  # fmt: skip
    sides = np.array([[g.h, g.b], [g.b, g.h]])[:, :, None, None] / 2
    beams, stringers = (np.array([s[0] * z.imag + 1j * s[1] * z.real for s in sides]) for z in (CORNERS, ROUND))
    both = np.concatenate([beams, stringers], axis=-1)
    known |= {"y_b": beams.real, "z_b": beams.imag, "y_s": stringers.real, "z_s": stringers.imag}
    known |= {"y": both.real, "z": both.imag}
    A_t, A_c = np.repeat([F_bt, 0.0], [4, 8]), np.repeat([F_bc, F_sc], [4, 8])
    loads = [(g.M_1, g.N_1), (g.M_2, g.N_2)]
    known |= {"A_t": A_t, "A_c": A_c, "M": [[M] for M, _ in loads], "N": [[N] for _, N in loads]}
    section = {}
    most = 0
    for p in (0, 1):
        for M, N in loads:
            y = both.real[p, 0]
            A = acting(y, A_t, A_c, M, N)
            a, b = bending(y, A, M, N)
            centre = np.average(y, weights=A)
            one = {"A": A, "sigma": a + b * y, "P": (a + b * y) * A, "A_b": A[:4], "A_s": A[4:]}
            one |= {"sigma_b": one["sigma"][:4], "P_b": one["P"][:4], "P_s": one["P"][4:]}
            one["sigma_s"] = np.where(A[4:] > 0, one["sigma"][4:], 0)
            one |= {"sigma_al": beta * one["sigma_s"], "F": A.sum(), "S": (A * y).sum(), "y_c": centre}
            one |= {"I_c": (A * (y - centre) ** 2).sum(), "M_c": M - N * centre, "y_0": -a / b, "y_0c": -a / b - centre}
            most = max(most, iterated(y, A_t, A_c, M, N, g.y_00, g.k_max)[1])
            for name, value in one.items():
                section.setdefault(name, []).append(np.atleast_1d(value))
    known |= {name: np.array(v).reshape(2, 2, -1) for name, v in section.items()}
    steps = [iterated(both.real[p, 0], A_t, A_c, M, N, g.y_00, most) for p in (0, 1) for M, N in loads]
    known["y_k"] = np.array([axes for axes, _ in steps]).T.reshape(most, 2, 2, 1)
    known["n_k"] = np.array([n for _, n in steps]).reshape(2, 2, 1)
    known["step"] = np.arange(1, most + 1)[:, None, None, None]
    loads, firsts = [(g.M_r1, g.N_r1), (g.M_r2, g.N_r2)], (g.phi_1, g.phi_2)
    rings = [ring(g, first, M, N) for first in firsts for M, N in loads]
    known |= {k: np.array([np.atleast_1d(r[k]) for r in rings]).reshape(2, 2, -1) for k in rings[0]}
    known["phi"] = np.array([even(g.m, first) for first in firsts])[:, None]
    M, N = (np.array([[load[k]] for load in loads]) for k in (0, 1))
    known |= {"M_r": M, "N_r": N, "c": N * g.r / 2 / M, "y_r0": -N * g.r / 2 / M * g.r}
    P_e, p_e = N / g.m + 2 * abs(M) / g.r / g.m, N / (2 * np.pi * g.r) - abs(M) / (np.pi * g.r**2)
    return known | {"P_e": P_e, "N_e1": P_e * g.m, "p_e": p_e, "N_e2": p_e * 2 * np.pi * g.r}


CHANGES = {
    "as printed": {},
    "other sides, exact": {
        "h": 0.31,
        "b": 0.47,
        "d_E": 0.0,
        "d_F": 0.0,
        "psi": 0.7,
        "N_1": -2e4,
        "M_2": -2e4,
        "phi_1": 0.04,
        "r": 0.5,
        "m": 11,
    },
    "narrow skin": {"psi": 0.4, "F_s": 0.4e-4, "k_a": 20.0, "y_00": 0.05, "N_r1": 5e4, "t": 0.2},
    "stringers at the edge of the skin, the ring bent the other way": {"psi": 0.5, "M_r1": -1.5e5, "phi_1": 0.04},
}


@pytest.mark.parametrize("change", CHANGES)
def test_every_line_is_that_of_the_section_and_the_ring(change):
    g = inputs("joint", **CHANGES[change])
    assert disagreements("joint", g, reference(g)) == []
