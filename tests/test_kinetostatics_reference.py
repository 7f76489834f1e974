"""Every line of the kinetostatics worksheet against circles, their differences, and one system of all bodies."""

import numpy as np
import pytest
from independent import along, circles, disagreements, inputs, moment, slopes, turns

STEP = 0.02
PHI = np.radians(np.arange(361))


class Machine:
    """Points and directions of the links over the crank's angle."""

    def __init__(self, g):
        self.g, self.C, self.H = g, complex(g.X_C, g.Y_C), complex(g.X_H, g.Y_H)
        self.O5, self.u5 = complex(g.X05, g.Y05), np.exp(1j * g.phi05)

    def A(self, phi):
        return self.g.l1 * np.exp(1j * phi)

    def B(self, phi):
        return circles(self.A(phi), self.g.l2, self.C, self.g.l3, +1)

    def rocker(self, phi, length, turn):
        return self.C + (self.B(phi) - self.C) / self.g.l3 * length * np.exp(1j * turn)

    def D(self, phi):
        return self.rocker(phi, self.g.l_CD, self.g.delta_D)

    def K(self, phi):
        return self.rocker(phi, self.g.l_CK, self.g.delta_K)

    def E(self, phi):
        d = (self.D(phi) - self.O5) / self.u5
        return self.O5 + (d.real + np.sqrt(self.g.l4**2 - d.imag**2)) * self.u5

    def way(self, body):
        """The vector along a link, from the pin first named in its line."""
        ends = {2: (self.A, self.B), 3: (self.at_C, self.B), 4: (self.D, self.E), 6: (self.K, self.at_H)}
        start, end = ends[body]
        return lambda phi: end(phi) - start(phi)

    def at_C(self, phi):
        return self.C + 0 * phi

    def at_H(self, phi):
        return self.H + 0 * phi

    def S(self, body):
        g = self.g
        if body == 1:
            return lambda phi: g.l_O1S1 * np.exp(1j * phi)
        if body == 5:
            return self.E
        start, end, length = {
            2: (self.B, self.A, g.l_BS2),
            3: (self.B, self.at_C, g.l_BS3),
            4: (self.E, self.D, g.l_ES4),
            6: (self.K, self.at_H, g.l_KS6),
            7: (self.at_H, self.K, g.l_HS7),
        }[body]
        return lambda phi: start(phi) + length * (end(phi) - start(phi)) / abs(end(phi) - start(phi))

    def height(self, phi):
        return sum(getattr(self.g, f"m{k}") * self.S(k)(phi).imag for k in range(1, 8))

    def inertia(self, phi):
        """Reduced masses, and with the moments of inertia."""
        g = self.g
        masses = sum(getattr(g, f"m{k}") * abs(slopes(self.S(k), phi, STEP)[0]) ** 2 for k in range(1, 8))
        rates = {k: turns(self.way(k), phi, STEP)[0] for k in (2, 3, 4, 6)}
        more = g.J1 + sum(getattr(g, f"J{k}") * rates[k] ** 2 for k in rates) + g.J7 * rates[6] ** 2
        return masses, masses + more

    def potential(self, phi):
        g = self.g
        return g.g_n * self.height(phi) - g.p_g * np.pi * g.D_g**2 / 4 * abs(self.K(phi) - self.H)

    def energy(self, phi):
        return self.g.n1**2 * self.inertia(phi)[1] / 2 + self.potential(phi)


def motion(m):
    """Velocities and accelerations in time, and the inertia of each body."""
    g = m.g

    def rates(pair):
        return g.n1 * pair[0], g.n1**2 * pair[1] + g.eps1 * pair[0]

    known = {f"omega{k}": rates(turns(m.way(k), PHI, STEP))[0] for k in (2, 3, 4, 6)}
    known |= {f"eps{k}": rates(turns(m.way(k), PHI, STEP))[1] for k in (2, 3, 4, 6)}
    known |= {f"u{k}(phi1)": known[f"omega{k}"] / g.n1 for k in (2, 3, 4, 6)}
    known |= {f"a_{p}": rates(slopes(getattr(m, p), PHI, STEP))[1] for p in "ADEK"}
    known |= {f"V_{p}(phi1)": slopes(getattr(m, p), PHI, STEP)[0] for p in "ADEK"}
    known |= {"v5": along(g.n1 * known["V_E(phi1)"], m.u5)}
    known |= {"v6": g.n1 * slopes(lambda phi: abs(m.K(phi) - m.H), PHI, STEP)[0]}
    for k in (1, 2, 3, 4, 6, 7):
        S, (V, _), (_, a) = m.S(k)(PHI), slopes(m.S(k), PHI, STEP), rates(slopes(m.S(k), PHI, STEP))
        epsilon = g.eps1 if k == 1 else known[f"eps{min(k, 6)}"]
        known |= {f"S{k}": S, f"P_S{k}(phi1)": S, f"a_S{k}": a, f"F_in{k}": -getattr(g, f"m{k}") * a}
        known |= {f"M_in{k}": -getattr(g, f"J{k}") * epsilon, f"M{k}": -getattr(g, f"J{k}") * epsilon}
        known["V_S1" if k == 1 else f"V_S{k}(phi1)"] = V
    return known | {"F_in5": -g.m5 * known["a_E"]} | {f"G{k}": -1j * getattr(g, f"m{k}") * g.g_n for k in range(1, 8)}


def positions(m):
    g, A, B, D, E, K = m.g, *(point(PHI) for point in (m.A, m.B, m.D, m.E, m.K))
    known = {"O1": 0, "C": m.C, "H": m.H, "O5": m.O5, "u5": m.u5, "omega1": g.n1, "phi1": PHI}
    known |= {"A": A, "B": B, "D": D, "E": E, "K": K, "P_A(phi1)": A, "P_B(phi1)": B, "P_D(phi1)": D}
    known |= {"P_K(phi1)": K, "P_E(phi1)": E, "e7(phi1)": (K - m.H) / abs(K - m.H)}
    known |= {f"phi{k}": np.angle(m.way(k)(PHI)) for k in (2, 3, 4, 6)}
    known |= {"s5": along(E - m.O5, m.u5), "s7": g.l6 + g.l7 - abs(K - m.H), "l_HK": abs(K - m.H)}
    known |= {"mu23": between(B - A, B - m.C), "mu45": between(E - D, 1j * m.u5)}
    return known | {"l_HS6": abs(m.S(6)(PHI) - m.H)}


def between(a, b):
    """The angle between two vectors, up to 180 degrees."""
    return np.arctan2(abs(moment(a, b)), along(a, b))


def held(m, loads):
    """Balancing moment, forces in the eight pins, normal forces and moments of guide and cylinder, at every position.

    ``loads`` are (body, force, point, couple); every body is in equilibrium, with moments about O1.
    """
    e7 = (m.K(PHI) - m.H) / abs(m.K(PHI) - m.H)
    pins = ((0, 1, 0 * PHI), (1, 2, m.A(PHI)), (2, 3, m.B(PHI)), (0, 3, m.at_C(PHI)), (3, 4, m.D(PHI)))
    pins += ((4, 5, m.E(PHI)), (3, 6, m.K(PHI)), (0, 7, m.at_H(PHI)))
    columns = [[(1, 0, 0 * PHI, 1)]]
    columns += [[(on, f, P, 0), (by, -f, P, 0)] for by, on, P in pins for f in (1 + 0j, 1j)]
    columns += [[(5, 1j * m.u5, m.E(PHI), 0)], [(5, 0j, m.E(PHI), 1)]]
    columns += [[(6, 1j * e7, m.K(PHI), 0), (7, -1j * e7, m.K(PHI), 0)], [(6, 0j, m.K(PHI), 1), (7, 0j, m.K(PHI), -1)]]

    def of_bodies(terms):
        rows = np.zeros((8, 3, PHI.size))
        for body, force, point, couple in terms:
            force = force + 0 * PHI
            rows[body] += [force.real, force.imag, moment(point, force) + couple]
        return rows[1:].reshape(21, -1).T

    matrix = np.stack([of_bodies(terms) for terms in columns], axis=-1)
    x = np.linalg.solve(matrix, -of_bodies(loads)[..., None])[..., 0].T
    names = ("R_1c", "R_A", "R_B", "R_C", "R_D", "R_E", "R_K", "R_H")
    forces = {name: x[2 * k + 1] + 1j * x[2 * k + 2] for k, name in enumerate(names)}
    return forces | {"M_c": x[0], "R_05": x[17] * 1j * m.u5, "R_76": x[19] * 1j * e7, "M_76": x[20]}


def lines_of(name, R, numbers):
    """A vector as the document writes it: magnitude, direction, components."""
    known = {name: abs(R), f"gamma{numbers}": np.angle(R), f"{name}_v": R}
    return known | {f"{name}_x": R.real, f"{name}_y": R.imag}


def reference(g):
    m = Machine(g)
    known = positions(m) | motion(m)
    gas = g.p_g * np.pi * g.D_g**2 / 4
    e7, forwards = known["e7(phi1)"], along(known["V_E(phi1)"], m.u5) * np.sign(g.n1) > 0
    known |= {"F_g": gas, "F_gas": gas * e7, "F_Q": np.where(forwards, -g.Q5, 0) * m.u5}
    applied = {5: known["F_Q"], 6: gas * e7, 7: -gas * e7}
    loads = []
    for k in range(1, 8):
        own = known[f"G{k}"] + known[f"F_in{k}"] + applied.get(k, 0)
        loads.append((k, own, known.get(f"S{k}", known["E"]), known.get(f"M{k}", 0 * PHI)))
        if k != 3:
            known |= {f"F{k}_sum": own, f"F{k}": abs(own), f"gamma{k}": np.angle(own)}
    # the worksheet has the weight of the gas at S6 and S7: on their line it does the same
    R = held(m, loads)
    known |= R | second_and_third(m, known, R) | first(m, known, R, loads) | crank(m, known, R)
    for k in ("34", "45", "36", "07", "12", "03", "23", "_O1g", "_O1c"):  # as the document prints them
        known[f"1.0 * np.all((gamma{k} >= 0) & (gamma{k} < 2 * pi))"] = 1
    return known | balance(m, known, R, loads)


def second_and_third(m, known, R):
    g, e4, e6 = m.g, np.exp(1j * known["phi4"]), np.exp(1j * known["phi6"])
    found = lines_of("R34", R["R_D"], 34) | lines_of("R45", R["R_E"], 45) | lines_of("R36", R["R_K"], 36)
    found |= lines_of("R07", R["R_H"], "07")
    found = {k: v for k, v in found.items() if k[3:] not in ("_x", "_y", "_v") or k[:3] in ("R45", "R07")}
    across, along_4 = along(R["R_D"], 1j * e4), along(R["R_D"], e4)
    guide = along(R["R_05"], 1j * m.u5)
    known_45 = across * 1j * e4 + known["F4_sum"] + known["F5_sum"]
    found |= {"R34_t": across, "R34_n": along_4, "R05": guide, "A_45": known_45.real, "B_45": known_45.imag}
    found |= {"gamma34_t": known["phi4"] + np.pi / 2, "gamma05": g.phi05 + np.pi / 2, "R05_v": R["R_05"]}
    found |= {"r_45 / max(R34)": 0, "r_45_printed": -2 * guide * np.cos(g.phi05)}
    printed = np.array([[e4.real, -m.u5.imag + 0 * PHI], [e4.imag, -m.u5.real + 0 * PHI]]).transpose(2, 0, 1)
    solved = np.linalg.solve(printed, -np.stack([known_45.real, known_45.imag], axis=-1)[..., None])[..., 0]
    found |= {"R34_n_printed": solved[:, 0], "R05_printed": solved[:, 1]}

    across, along_6 = along(R["R_K"], 1j * e6), along(R["R_K"], e6)
    known_67, square = across * 1j * e6 + known["F6_sum"], along(R["R_76"], 1j * e6)
    T6 = moment(known["S6"] - m.H, known["F6_sum"]) + known["M6"]
    T7 = moment(known["S7"] - m.H, known["F7_sum"]) + known["M7"]
    other = abs(known["F7_sum"]) * np.exp(1j * known["gamma6"])  # as printed, with the direction of the load on 6
    T7_printed = moment(known["S7"] - m.H, other) + known["M7"]
    found |= {"T6": T6, "T7": T7, "R36_t": across, "R36_n": along_6, "A_67": known_67.real, "B_67": known_67.imag}
    found |= {"R76": square, "R76_v": R["R_76"], "h76": R["M_76"] / square, "M_67": -R["M_76"]}
    found |= {f"gamma{k}": known["phi6"] + turn * np.pi for k, turn in (("36_t", 0.5), ("76", 0.5), ("67", 1.5))}
    found |= {"T7_printed": T7_printed, "R36_t_printed": (T6 + T7_printed) / known["l_HK"], "d_134": -1}
    phi = known["phi6"]
    found |= {"d_134_printed": -np.cos(phi) * np.sin(phi + 0.5) - np.sin(phi) ** 2, "r_67 / max(R36)": 0}
    found["gamma36_t_UGL2"] = np.angle(across * 1j * e6)
    printed_67 = abs(across) * 1j * e6 + known["F6_sum"]  # with the sign of R36_t in its direction and in its number
    found |= {"A_67_printed": printed_67.real, "B_67_printed": printed_67.imag}
    found |= {"R76_printed": -along(printed_67, 1j * e6)}
    return found | {"r_67_printed": (square - abs(R["R_H"])) * np.sin(phi)}


def first(m, known, R, loads):
    e2, e3 = np.exp(1j * known["phi2"]), np.exp(1j * known["phi3"])
    own = loads[2][1]
    found = lines_of("R12", R["R_A"], 12) | lines_of("R03", R["R_C"], "03") | lines_of("R23", R["R_B"], 23)
    for name in ("R12", "R03"):
        del found[f"{name}_x"], found[f"{name}_y"]
    F3 = own - R["R_D"] - R["R_K"]
    found |= {"R43": -R["R_D"], "R63": -R["R_K"], "F3_own": own, "F3_sum": F3, "F3": abs(F3), "gamma3": np.angle(F3)}
    found["M3"] = known["M_in3"] + sum(moment(known[p] - known["S3"], -R[f"R_{p}"]) for p in "DK")
    for name, force, e, k in (("R12", R["R_A"], e2, 2), ("R03", R["R_C"], e3, 3)):
        found |= {f"{name}_t": along(force, 1j * e), f"{name}_n": along(force, e)}
        forces = found[f"{name}_t"] * 1j * e + (F3 if k == 3 else known["F2_sum"])
        found |= {f"A_{k}": forces.real, f"B_{k}": forces.imag}
    found |= {"A_23": found["A_2"] + found["A_3"], "B_23": found["B_2"] + found["B_3"]}
    found |= {"gamma12_UGL2": np.angle(found["R12_t"] * 1j * e2), "gamma23_UGL3": np.angle(R["R_B"])}
    found |= {"gamma12_UGL4": np.angle(R["R_A"]), "gamma03_UGL4": np.angle(R["R_C"])}
    found["1.0 * np.all((gamma23_UGL3 >= -pi / 2) & (gamma23_UGL3 <= 1.5 * pi))"] = 1  # as the document prints it
    return found | {"gamma12_t": known["phi2"] + np.pi / 2, "gamma03_t": known["phi3"] + np.pi / 2}


def crank(m, known, R):
    """The wheel's force presses on one of two flanks, alpha_w off the tangent and towards the centre."""
    g, P = m.g, complex(-m.g.l_O1P)
    T1, T2 = moment(known["S1"], known["F1_sum"]) + known["M1"], moment(known["A"], -R["R_A"])
    flanks = np.exp(1j * np.array([np.pi / 2 - g.alpha_w, -np.pi / 2 + g.alpha_w]))
    up = -(T1 + T2) / moment(P, flanks[0])
    F = np.where(up >= 0, up * flanks[0], -(T1 + T2) / moment(P, flanks[1]) * flanks[1])
    R_1g = -(known["F1_sum"] + F - R["R_A"])
    found = lines_of("R_O1g", R_1g, "_O1g") | lines_of("R_O1c", R["R_1c"], "_O1c")
    found |= {"R_O1_v": found.pop("R_O1c_v"), "F_w": F, "P_w": P, "F_b": up, "gamma_b": np.angle(F), "R_1g": R_1g}
    del found["R_O1g_v"]
    found |= {"gamma_b0": np.angle(flanks[0]), "T1": T1, "T2": T2, "M_b": -(T1 + T2), "M_b_printed": T1 + T2}
    return found | {"R21": abs(R["R_A"]), "gamma21": np.angle(-R["R_A"])}


def balance(m, known, R, loads):
    g, M_b = m.g, R["M_c"]
    found = {"P_b": M_b * g.n1, "M_mean": M_b[:-1].mean(), "W_b": 2 * np.pi * M_b[:-1].mean()}
    found["W_Q"] = g.Q5 * np.ptp(known["s5"])
    masses, every = m.inertia(PHI)
    found |= {"J_m(phi1)": masses, "J_r(phi1)": every, "Y_m(phi1)": m.height(PHI), "U(phi1)": m.potential(PHI)}
    energy = m.energy(PHI)
    found |= {"energy(phi1)": energy, "driven": slopes(m.energy, PHI, STEP)[0]}
    for k, force, _, couple in loads:
        V = slopes(m.S(k), PHI, STEP)[0]
        rate = 1 if k == 1 else 0 if k == 5 else known[f"u{min(k, 6)}(phi1)"]
        found[f"W_{k}"] = along(force, V) + couple * rate
    return found


CHANGES = {
    "as given": {},
    "clockwise, speeding up": {
        "n1": -21.0,
        "eps1": 70.0,
        "phi05": -0.02,
        "alpha_w": 0.5,
        "delta_K": -0.5,
        "delta_D": 2.8,
        "l_CK": 0.18,
        "l3": 0.3,
    },
}


@pytest.mark.parametrize("change", CHANGES)
def test_every_line_is_that_of_the_bodies_and_their_motion(change):
    g = inputs("kinetostatics", **CHANGES[change])
    assert disagreements("kinetostatics", g, reference(g), within=1e-6) == []
