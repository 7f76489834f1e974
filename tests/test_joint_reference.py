"""Every line of the joint worksheet against the section and the ring themselves: elements placed, axes tried."""

import numpy as np
import pytest
from independent import FOLDER, disagreements
from test_joint import ring_at_50_digits

from mechsheet.worksheet.cells import load
from mechsheet.worksheet.inputs import build

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


def ring(g, alpha, M, N):
    """Bolts, resultant and line load of the ring, with the integrals over half of its compressed arc.

    The document's formulas, of the names in PRINTED, hold for a positive moment; a negative one pulls the other side.
    """
    phi, m = g.bolts - alpha, len(g.bolts)
    c = N * g.r / (2 * abs(M))
    P, _, p_0 = ring_at_50_digits(phi + np.pi * (M < 0), g.r, abs(M), N)
    P, edge = np.array([float(x) for x in P]), np.arccos(-c)
    node, weight = np.polynomial.legendre.leggauss(40)
    at, weight = edge + (np.pi - edge) * (node + 1) / 2, weight * (np.pi - edge) / 2
    arc, lever = (weight * (np.cos(at) + c)).sum(), (weight * (np.cos(at) + c) * np.cos(at)).sum()
    q = np.maximum(np.cos(phi) + c, 0)
    k = int(P.argmax())
    found = {"c_n": c, "phi_n": edge, "phi_no": edge, "k_0": arc, "k_1": lever / arc, "k_2": (1 - c) / 2 / arc}
    P_1 = P[k] / q[k] if M > 0 else np.nan
    found |= {"S_1": q.sum(), "S_2": (q * np.cos(phi)).sum(), "P_1": P_1, "P_n": P[k], "P_max": P[k]}
    found |= {} if M > 0 else dict.fromkeys(PRINTED, np.nan) | {"S_1": 0, "S_2": 0}
    return found | {
        "P_k": P,
        "p_n": float(p_0) if M > 0 else np.nan,
        "p_o": float(p_0),
        "P_str": float(p_0) * g.t,
        "M_x / M_r": (P * g.r * np.sin(phi)).sum() / M,
        "i_P": P[k] / (N / m + 2 * abs(M) / g.r / m),
        "i_p": float(p_0) / (N / (2 * np.pi * g.r) - abs(M) / (np.pi * g.r**2)),
    }


def additional(g, beam):
    """Additional area of a beam in tension before it is reduced, from what stands beside it; and its parts."""
    y, z, *_ = beam
    l_b, l_h = (g.psi * np.ptp(side) / 2 for side in (g.beams.z, g.beams.y))
    rows = list(zip(g.stringers.y, g.stringers.z, g.stringers.F, strict=True))
    on_b = [F for v, w, F in rows if abs(v - y) <= g.delta and abs(w - z) <= l_b]
    on_h = {abs(v - y): F for v, w, F in rows if abs(w - z) <= g.delta and abs(v - y) <= l_h}
    width = min([l_h, *on_h])
    return {"F_sb": sum(on_b), "F_sh": sum(on_h.values()), "w_h": width, "F_sk": (l_b + width) * g.delta}


def reduced(g, beta, area):
    return round(beta * area / g.d_F) * g.d_F if g.d_F else beta * area


def reference(g):
    ratio = g.E_al / g.E_st
    beta = round(ratio / g.d_E) * g.d_E if g.d_E else ratio
    h, b, strip = np.ptp(g.beams.y), np.ptp(g.beams.z), beta * g.k_a * g.delta**2
    l_b, l_h = g.psi * b / 2, g.psi * h / 2
    beams, stringers = (list(zip(t.y, t.z, t.F, t.k_t, t.k_c, strict=True)) for t in (g.beams, g.stringers))
    more = [additional(g, beam) for beam in beams]
    known = {name: np.array([one[name] for one in more]) for name in more[0]}
    known["dF_t"] = sum(known[name] for name in ("F_sk", "F_sb", "F_sh"))
    known["dF_tr"] = np.array([reduced(g, beta, area) for area in known["dF_t"]])
    F_bt = np.array([F + k_t * dF for (_, _, F, k_t, _), dF in zip(beams, known["dF_tr"], strict=True)])
    F_bc = np.array([F + k_c * strip for *_, F, _, k_c in beams])
    F_st = np.array([k_t * beta * F for *_, F, k_t, _ in stringers])
    F_sc = np.array([k_c * (beta * F + strip) for *_, F, _, k_c in stringers])
    first = known["F_sb"][0] + known["F_sh"][0]
    l_be, w_he = np.array([8.15e-2, l_b, l_b]), np.array([12.5e-2, known["w_h"][0], l_h])
    F_ske = (l_be + w_he) * g.delta
    dF_tre = np.array([reduced(g, beta, skin + first) for skin in F_ske])
    loads = list(zip(g.loads.M + g.loads.M_w, g.loads.N, strict=True))
    known |= {
        "m": len(g.bolts), "n_b": len(beams),
        "beta": beta, "h": h, "b": b, "l_b": l_b, "l_h": l_h, "dF_cr": strip, "F_bt": F_bt, "F_bc": F_bc, "F_st": F_st,
        "F_sc": F_sc, "way": [1, 2, 3], "l_be": l_be, "w_he": w_he, "F_ske": F_ske, "dF_te": F_ske + first,
        "dF_tre": dF_tre, "F_bte": beams[0][2] + beams[0][3] * dF_tre, "line": [1, 2],
        "d_y": [[abs(y - v) for v, *_ in stringers] for y, *_ in beams],
        "d_z": [[abs(z - w) for _, w, *_ in stringers] for _, z, *_ in beams],
        "plane": np.array([1, 2])[:, None, None], "case": 1 + np.arange(len(loads))[:, None],
        "beam": np.arange(len(beams)) + 1, "stringer": np.arange(len(stringers)) + 1,
        "bolt": np.arange(len(g.bolts)) + 1, "load": 1 + np.arange(len(g.ring_loads.M))[:, None],
        "plane_r": 1 + np.arange(len(g.alpha))[:, None, None],
    }  # fmt: skip
    both = np.array([[e[:2] for e in [*beams, *stringers]], [e[1::-1] for e in [*beams, *stringers]]])[:, None]
    known |= {"y": both[..., 0], "z": both[..., 1]}
    n = len(beams)
    known |= {"y_b": both[..., :n, 0], "z_b": both[..., :n, 1], "y_s": both[..., n:, 0], "z_s": both[..., n:, 1]}
    A_t, A_c = np.array([*F_bt, *F_st]), np.array([*F_bc, *F_sc])
    known |= {"A_t": A_t, "A_c": A_c, "M": [[M] for M, _ in loads], "N": [[N] for _, N in loads]}
    known |= {"M_b": g.loads.M[:, None], "M_w": g.loads.M_w[:, None]}
    section = {}
    for y in known["y"][:, 0]:
        for M, N in loads:
            A = acting(y, A_t, A_c, M, N)
            a, b = bending(y, A, M, N)
            centre = np.average(y, weights=A)
            one = {"A": A, "sigma": a + b * y, "P": (a + b * y) * A, "A_b": A[:n], "A_s": A[n:]}
            one |= {"sigma_b": one["sigma"][:n], "P_b": one["P"][:n], "P_s": one["P"][n:]}
            one["sigma_s"] = np.where(A[n:] > 0, one["sigma"][n:], 0)
            one |= {"sigma_al": beta * one["sigma_s"], "F": A.sum(), "S": (A * y).sum(), "y_c": centre}
            one |= {
                "I_z": (A * (y - centre) ** 2).sum(),
                "M_z": M - N * centre,
                "y_no": -a / b,
                "y_1no": -a / b - centre,
            }
            for name, value in one.items():
                section.setdefault(name, []).append(np.atleast_1d(value))
    known |= {name: np.array(v).reshape(2, len(loads), -1) for name, v in section.items()}
    steps = [iterated(y, A_t, A_c, M, N, g.y_noo, g.k_max) for y in known["y"][:, 0] for M, N in loads]
    known["y_k"] = np.array([axes for axes, _ in steps]).T.reshape(g.k_max, 2, -1, 1)
    known["n_k"] = np.array([n for _, n in steps]).reshape(2, -1, 1)
    known["step"] = np.arange(1, g.k_max + 1)[:, None, None, None]
    F_e, y_ce = (np.array([read, known[name][0, 0, 0]]) for read, name in ((6.928e-4, "F"), (4.677e-2, "y_c")))
    (M, N), I_z = loads[0], known["I_z"][0, 0, 0]
    known |= {"F_e": F_e, "y_ce": y_ce, "S_e": F_e * y_ce, "M_ze": M - N * y_ce}
    known["y_1noe"] = -N / F_e / ((M - N * y_ce) / I_z)
    loads = list(zip(g.ring_loads.M, g.ring_loads.N, strict=True))
    rings = [ring(g, alpha, M, N) for alpha in g.alpha for M, N in loads]
    known |= {k: np.array([np.atleast_1d(r[k]) for r in rings]).reshape(len(g.alpha), len(loads), -1) for k in rings[0]}
    known["phi"] = np.array([g.bolts - alpha for alpha in g.alpha])[:, None]
    M, N, m = g.ring_loads.M[:, None], g.ring_loads.N[:, None], len(g.bolts)
    known |= {"M_r": M, "N_r": N, "c": N * g.r / 2 / M, "y_rno": -N * g.r / 2 / M * g.r}
    P_e, p_e = N / m + 2 * abs(M) / g.r / m, N / (2 * np.pi * g.r) - abs(M) / (np.pi * g.r**2)
    return known | {"P_e": P_e, "N_e1": P_e * m, "p_e": p_e, "N_e2": p_e * 2 * np.pi * g.r}


CHANGES = {  # as they are typed
    "as printed": {},
    "other loads, exact": {
        "d_E": 0, "d_F": 0, "psi": 0.7, "loads": "5e5; -2e4; 0 | -2e5; -13e3; 1e4", "alpha": "2.3; -7.5", "r": 50,
        "bolts": [360 * k / 11 for k in range(11)],
    },
    "narrow skin": {"psi": 0.4, "k_a": 20, "y_noo": 5, "ring_loads": "2e6; 5e3 | 1.2e6; 2.5e4", "t": 20},
    "stringers at the edge of the skin, the ring bent the other way": {
        "psi": 0.5, "ring_loads": "-1.5e6; -2e4 | 1.2e6; 2.5e4", "alpha": "2.3",
    },
    "other numbers of all": {
        "beams": "30; 10; 1.5; 1; 1 | -30; 10; 1; 0.5; 1 | -30; -10; 2; 1; 2 | 30; -10; 1; 1; 1 | 0; 10; 0.7; 0; 1",
        "stringers": "30; 4; 0.5; 1; 1 | 12; 10; 0.4; 0; 1 | -30; -4; 0.6; 0.5; 0",
        "loads": "5e5; 13e3; 2e4 | 0; -2e4; 1e5 | 3e5; 0; 0",
        "bolts": "3; 40; 95; 130; 170; 222; 240; 281; 333", "alpha": "0; 30; -45",
        "ring_loads": "2e6; -2e4 | 1e6; 1.5e4 | 8e5; 0", "k_max": 7,
    },
    "one of each": {
        "beams": "10; 0; 1; 1; 1 | -10; 0; 1; 1; 1 | 2; 7; 1; 1; 1", "stringers": "5; 3; 0.5; 0; 1",
        "loads": "1e4; 100; 0", "bolts": "1; 122; 240", "alpha": "0", "ring_loads": "1e6; 2e3", "k_max": 6,
    },
}  # fmt: skip


@pytest.mark.parametrize("change", CHANGES)
def test_every_line_is_that_of_the_section_and_the_ring(change):
    g = build(load(FOLDER / "joint.py").inputs, CHANGES[change])
    assert disagreements("joint", g, reference(g)) == []
