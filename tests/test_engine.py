"""Every line of the engine worksheet against circle and line, their differences, and the equilibrium of each body."""

import csv
from bisect import bisect_right
from pathlib import Path

import numpy as np
import pytest
from independent import disagreements, inputs, moment, slopes, turns

FILE = Path(__file__).parents[1] / "worksheets" / "examples" / "engine.csv"
SHEET = "examples/engine"
STEP = 2e-3


def measured(phi):
    """The pressure [Pa] at these angles, from the lines of the file."""
    lines = [line for line in FILE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    rows = [(float(a), float(b)) for a, b in list(csv.reader(lines, delimiter=";"))[1:]]
    angles = [a for a, _ in rows]
    found = []
    for angle in np.degrees(phi):
        k = min(max(bisect_right(angles, angle), 1), len(rows) - 1)
        (a, p), (b, q) = rows[k - 1], rows[k]
        found.append(p + (q - p) * (angle - a) / (b - a))
    return np.array(found) * 1e5


def reference(g):
    w, phi = g.n, np.linspace(0, 4 * np.pi, 361)

    def pin(phi):
        return g.r * np.exp(1j * phi)

    def piston(phi):  # where the circle of the rod round the pin meets the axis of the cylinder
        a = pin(phi)
        return a.real + np.sqrt(g.l**2 - (g.e - a.imag) ** 2) + 1j * g.e

    def rod(phi):
        return piston(phi) - pin(phi)

    def centre(phi):
        return pin(phi) + g.l_S * rod(phi) / abs(rod(phi))

    A, C, S = pin(phi), piston(phi), centre(phi)
    (_, A2), (C1, C2), (S1, S2) = (slopes(f, phi, STEP) for f in (pin, piston, centre))
    turn, bend = turns(rod, phi, STEP)
    known = {"omega": w, "phi": phi, "A": A, "C": C, "S": S, "a_A": w**2 * A2, "a_C": w**2 * C2.real}
    known |= {"a_S": w**2 * S2, "g_S": w**2 * S2, "eps": w**2 * bend, "v": -w * C1.real, "V_S": S1}
    known |= {"beta(phi)": -np.angle(rod(phi)), "beta_phi": -np.angle(rod(phi)), "dbeta(phi)": -turn}
    known |= {"x(phi)": C.real, "dx(phi)": C1.real}
    x_top, x_bottom = (dead(lambda p: piston(p).real, start, sign) for start, sign in ((0.0, 1), (np.pi, -1)))
    known |= {"x_top": x_top, "x_bottom": x_bottom, "s": x_top - C.real}

    piston_area, p = np.pi * (g.D / 2) ** 2, measured(phi)
    V, gas = piston_area * (x_top - C.real), piston_area * (g.p_0 - p)
    work = sum((p[k] + p[k + 1]) / 2 * (V[k + 1] - V[k]) for k in range(360))
    swept = piston_area * (x_top - x_bottom)
    known |= {"A_P": piston_area, "V_h": swept, "p": p, "V": V, "F_g": gas, "W_i": work}
    known |= {"p_mi": work / swept, "P_i": work * w / (2 * np.pi) / 2}
    known |= balance(g, w, phi, (A, C, S), gas, (C2, S2, bend))

    def energy(phi):
        speeds = slopes(piston, phi, STEP)[0], slopes(centre, phi, STEP)[0], turns(rod, phi, STEP)[0]
        masses = g.m_P, g.m_R, g.J_R
        return sum(m * abs(v * w) ** 2 / 2 for m, v in zip(masses, speeds, strict=True))

    T = gas * C1.real - slopes(energy, phi, STEP)[0]
    known |= {"T": T, "W": T, "T_g": gas * C1.real, "W_in / W_T": 0}
    return known | flywheel(g, w, phi, T)


def dead(x, near, sign):
    """Greatest (+1) or least (-1) place of the piston: in finer and finer steps."""
    middle, width = near, 0.5
    while width > 1e-9:
        tried = middle + width * np.linspace(-1, 1, 2001)
        middle, width = tried[np.argmax(sign * x(tried))], width / 500
    return x(middle)


def balance(g, w, phi, points, gas, bends):
    """Five equations of equilibrium of rod and piston, solved in every position; then the crank."""
    (A, C, S), (C2, S2, bend) = points, bends
    F_S, M_S, F = -g.m_R * w**2 * S2, -g.J_R * w**2 * bend, gas - g.m_P * w**2 * C2.real
    one, none = np.ones(phi.size), np.zeros(phi.size)
    rows = [
        [one, none, one, none, none],  # rod, x: force of the crank, force of the piston
        [none, one, none, one, none],  # rod, y
        [-(A - S).imag, (A - S).real, -(C - S).imag, (C - S).real, none],  # rod, about S
        [none, none, -one, none, none],  # piston, x
        [none, none, none, -one, one],  # piston, y: the side force
    ]
    loads = [-F_S.real, -F_S.imag, -M_S, -F, none]
    x = np.linalg.solve(np.moveaxis(np.array(rows), 2, 0), np.moveaxis(np.array(loads), 1, 0)[..., None])[..., 0].T
    R_A, R_C, N = x[0] + 1j * x[1], x[2] + 1j * x[3], x[4]
    F_1 = g.m_C * w**2 * g.r_C * np.exp(1j * phi)
    known = {"F": F, "F_S": F_S, "M_S": M_S, "M_A": moment(S - A, F_S) + M_S, "N": N, "R_A": R_A, "R_C": R_C}
    on_pin = -R_A * np.exp(-1j * phi)
    known |= {"F_1": F_1, "R_O": R_A - F_1, "Q_O": F_1 - R_A, "Q_A": on_pin}
    return known | {"p_m": max(abs(on_pin)) / (g.d_A * g.b_A)}


def flywheel(g, w, phi, T):
    """The excess of work panel by panel, the rim by the roots of its cubic equation."""
    W_T = sum((T[k] + T[k + 1]) / 2 * (phi[k + 1] - phi[k]) for k in range(360))
    E = [0.0]
    for k in range(360):
        E.append(E[-1] + ((T[k] + T[k + 1]) / 2 - W_T / (4 * np.pi)) * (phi[k + 1] - phi[k]))
    excess = max(E) - min(E)
    wanted = excess / (g.delta * w**2)
    ring = g.iron.rho * np.pi * g.D_F * g.b_F  # mass of the rim over its thickness

    def inertia(h):  # of a ring between two circles
        outer, inner = (g.D_F + h) / 2, (g.D_F - h) / 2
        return g.iron.rho * g.b_F * np.pi * (outer**4 - inner**4) / 2

    left = max(wanted - g.J_0, 0)
    roots = np.roots([ring / 4, 0, ring * g.D_F**2 / 4, -left])
    h = max(roots[abs(roots.imag) < 1e-9].real)
    made = np.ceil(h * 1e3) / 1e3
    J_all, E_m = g.J_0 + inertia(made), (max(E) + min(E)) / 2
    n = np.sqrt(w**2 + 2 * (np.array(E) - E_m) / J_all)
    known = {"W_T": W_T, "T_m": W_T / (4 * np.pi), "E": E, "A_f": excess, "J": wanted, "J_F": left, "h": h}
    known |= {"J_h(0.03)": inertia(0.03), "q_F": 4 * left / ring, "h_F": made, "m_F": ring * made, "J_all": J_all}
    return known | {"E_m": E_m, "n_k": n, "delta_F": (max(n) - min(n)) / w, "v_F": max(n) * (g.D_F + made) / 2}


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"e": -0.02, "l": 0.2, "r_C": 0.03, "n": 250.0, "m_R": 3.1, "l_S": 0.09},
        {"r": 0.08, "l": 0.19, "n": 60.0, "J_0": 40.0, "D": 0.12},
    ],
    ids=["as it is", "beside the axis", "slow, heavy enough without a rim"],
)
def test_every_line_is_that_of_circle_and_line(changed):
    g = inputs(SHEET, **changed)
    assert disagreements(SHEET, g, reference(g), within=1e-7) == []
