"""The mechanics from their vector equations, in exact numbers: what `test_digits` holds the library against.

A function here takes the inputs of the library's function of that name and returns its results by name. Beside them
stands, under "exists", a number that is positive where the results exist: of a dead centre or an end of reach it tells
how far away it is. Nothing is arranged for digits: 60 of them make up for it.
"""

from flint import acb, arb

BITS = 200  # of balls, which are computed in a tenth of mpmath's time
i = acb(0, 1)


def outer(a, b):
    return a.real * b.imag - a.imag * b.real


def inner(a, b):
    return a.real * b.real + a.imag * b.imag


def root(x):
    """A root that is not there has no number, and no second one either."""
    return x.sqrt() if x >= 0 else arb.nan()


def over(x, y):
    return x / y if y != 0 else arb.nan()


def two(p, q, w):
    """x, y of x p + y q = w."""
    D = outer(p, q)
    return over(outer(w, q), D), over(outer(p, w), D)


def unit(u):
    return u / abs(u)


def total(loads, pole):
    return sum(F for F, _, _ in loads), sum(outer(P - pole, F) + M for F, P, M in loads)


# --- positions ---------------------------------------------------------------------------------------------------


def rrr(A, B, r_A, r_B, branch):
    d = B - A
    L2 = inner(d, d)
    along = (L2 + r_A**2 - r_B**2) / 2
    square = r_A**2 * L2 - along**2
    return {"": A + acb(along, branch * root(square)) * d / L2, "exists": square / L2**2}


def rrp(A, B, u, r_A, branch, offset):
    u = unit(u)
    h = outer(u, A - B) - offset
    square = (r_A - abs(h)) / r_A
    return {"": A + acb(branch * root(r_A**2 - h**2), -h) * u, "exists": square}


def rpr(A, B, branch, offset):
    d = A - B
    L = abs(d)
    s = branch * root(L**2 - offset**2)
    return {"u": d / acb(s, offset), "s": s, "exists": (L - abs(offset)) / L}


def prp(A, B, u_A, u_B):
    x, _ = two(u_A, -u_B, B - A)
    return {"": A + x * u_A, "exists": prp_sine(u_A, u_B)}


def prp_sine(u_A, u_B):
    return abs(outer(unit(u_A), unit(u_B)))


rpp = prp


def rrr_reach(A, B, r_A):
    L = abs(B - A)
    return {"least": abs(L - r_A), "greatest": L + r_A}


def rrp_reach(A, B, u, offset):
    return {"least": abs(outer(unit(u), A - B) - offset)}


def rpr_reach(A, B):
    return {"least": -abs(A - B), "greatest": abs(A - B)}


def prp_reach(A, B, u_A, u_B):
    return {"least": -arb.pos_inf(), "greatest": arb.pos_inf(), "exists": prp_sine(u_A, u_B)}


rpp_reach = prp_reach


def crank(O1, r, phi):
    return {"": O1 + r * acb(0, phi).exp()}


def opposite(D, r, d):
    """Angle opposite to D in the triangle with the sides r and d; at its end where D is too short or too long."""
    cosine = (r**2 + d**2 - D**2) / (2 * r * d)
    return max(min(cosine, arb(1)), arb(-1)).acos()


def rrr_crank_reach(O1, B, r, r_A, r_B):
    d = abs(B - O1)
    near, far = abs(r_A - r_B), r_A + r_B
    ends = {"least": opposite(near, r, d), "greatest": opposite(far, r, d)}
    return {"axis": (B - O1).arg(), **ends, "exists": min(r + d - near, far - abs(r - d)) / d}


def rpr_crank_reach(O1, B, r, offset):
    d = abs(B - O1)
    ends = {"least": opposite(abs(offset), r, d), "greatest": arb.pi()}
    return {"axis": (B - O1).arg(), **ends, "exists": (r + d - abs(offset)) / d}


def rrp_crank_reach(O1, B, u, r, r_A, offset):
    gap = outer(unit(u), O1 - B) - offset  # of O1 above the path; the pin is at gap + r cos(theta)

    def theta(height):
        return max(min((height - gap) / r, arb(1)), arb(-1)).acos()

    ends = {"least": theta(r_A), "greatest": theta(-r_A)}
    return {"axis": (i * u).arg(), **ends, "exists": (r + r_A - abs(gap)) / r}


# --- velocities and accelerations -----------------------------------------------------------------------------------


def radial(a, omega, dr, ddr):
    """Second derivative of a = r e^(i phi) without the part of the angular acceleration."""
    return -(omega**2) * a + (ddr + 2 * i * omega * dr) * unit(a)


def rrr_velocity(A, B, C, v_A, v_B, dr_A, dr_B):
    a, b = C - A, C - B
    v_A, v_B = v_A + dr_A * unit(a), v_B + dr_B * unit(b)
    x, y = two(i * a, -i * b, v_B - v_A)
    return {"v_C": v_A + i * x * a, "omega_A": x, "omega_B": y, "exists": rrr_sine(a, b)}


def rrr_sine(a, b):
    return abs(outer(a, b)) / abs(a) / abs(b)


def rrr_acceleration(A, B, C, omega_A, omega_B, dr_A, dr_B, a_A, a_B, ddr_A, ddr_B):
    a, b = C - A, C - B
    a_A, a_B = a_A + radial(a, omega_A, dr_A, ddr_A), a_B + radial(b, omega_B, dr_B, ddr_B)
    x, y = two(i * a, -i * b, a_B - a_A)
    return {"a_C": a_A + i * x * a, "epsilon_A": x, "epsilon_B": y, "exists": rrr_sine(a, b)}


def rrp_velocity(A, B, C, u, v_A, v_B, omega_B, dr_A):
    a, u = C - A, unit(u)
    pin, guide = v_A + dr_A * unit(a), v_B + i * omega_B * (C - B)
    x, y = two(i * a, -u, guide - pin)
    return {"v_C": guide + y * u, "omega_A": x, "ds": y, "exists": abs(inner(a, u)) / abs(a)}


def rrp_acceleration(A, B, C, u, omega_A, ds, omega_B, dr_A, a_A, a_B, epsilon_B, ddr_A):
    a, u = C - A, unit(u)
    pin = a_A + radial(a, omega_A, dr_A, ddr_A)
    guide = a_B + acb(-(omega_B**2), epsilon_B) * (C - B) + 2 * i * omega_B * ds * u
    x, y = two(i * a, -u, guide - pin)
    return {"a_C": guide + y * u, "epsilon_A": x, "dds": y, "exists": abs(inner(a, u)) / abs(a)}


def rpr_velocity(A, B, u, v_A, v_B):
    d, u = A - B, unit(u)
    x, y = two(i * d, u, v_A - v_B)
    return {"omega_A": x, "ds": y, "exists": abs(inner(d, u)) / abs(d)}


def rpr_acceleration(A, B, u, omega_A, ds, a_A, a_B):
    d, u = A - B, unit(u)
    x, y = two(i * d, u, a_A - a_B - 2 * i * omega_A * ds * u + omega_A**2 * d)
    return {"epsilon_A": x, "dds": y, "exists": abs(inner(d, u)) / abs(d)}


def prp_velocity(A, B, C, u_A, u_B, v_A, v_B, omega_A, omega_B):
    p, q = unit(u_A), unit(u_B)
    guide_A, guide_B = v_A + i * omega_A * (C - A), v_B + i * omega_B * (C - B)
    x, y = two(p, -q, guide_B - guide_A)
    return {"v_C": guide_A + x * p, "ds_A": x, "ds_B": y, "exists": abs(outer(p, q))}


def prp_acceleration(A, B, C, u_A, u_B, ds_A, ds_B, omega_A, omega_B, a_A, a_B, epsilon_A, epsilon_B):
    p, q = unit(u_A), unit(u_B)
    guide_A = a_A + acb(-(omega_A**2), epsilon_A) * (C - A) + 2 * i * omega_A * ds_A * p
    guide_B = a_B + acb(-(omega_B**2), epsilon_B) * (C - B) + 2 * i * omega_B * ds_B * q
    x, y = two(p, -q, guide_B - guide_A)
    return {"a_C": guide_A + x * p, "dds_A": x, "dds_B": y, "exists": abs(outer(p, q))}


def rpp_velocity(A, B, C, u_A, u_B, v_A, v_B, omega_B):
    p, q = unit(u_A), unit(u_B)
    x, y = two(p, q, v_A - v_B - i * omega_B * (A - B))
    return {"v_C": v_B + i * omega_B * (C - B) + y * q, "ds_A": x, "ds_B": y, "exists": abs(outer(p, q))}


def rpp_acceleration(A, B, C, u_A, u_B, ds_A, ds_B, omega_B, a_A, a_B, epsilon_B):
    p, q = unit(u_A), unit(u_B)
    coriolis_A, coriolis_B = 2 * i * omega_B * ds_A * p, 2 * i * omega_B * ds_B * q
    turning = acb(-(omega_B**2), epsilon_B)
    x, y = two(p, q, a_A - a_B - turning * (A - B) - coriolis_A - coriolis_B)
    a_C = a_B + turning * (C - B) + coriolis_B + y * q
    return {"a_C": a_C, "dds_A": x, "dds_B": y, "exists": abs(outer(p, q))}


# --- determinants, angles, conditions ---------------------------------------------------------------------------------


def rrr_determinant(A, B, C):
    return {"": outer(C - A, C - B), "exists": rrr_sine(C - A, C - B)}


def rrp_determinant(A, C, u):
    D = inner(C - A, unit(u))
    return {"": D, "exists": abs(D) / abs(C - A)}


def rpr_determinant(A, B, u):
    return rrp_determinant(B, A, u)


def prp_determinant(u_A, u_B):
    return {"": outer(unit(u_A), unit(u_B)), "exists": prp_sine(u_A, u_B)}


def between(a, b):
    return abs((b / a).arg())


def rrr_transmission_angle(A, B, C):
    return {"": between(C - A, C - B)}


def rrp_transmission_angle(A, C, u):
    return {"": between(C - A, i * u)}


def rpr_transmission_angle(A, B, u):
    return {"": between(A - B, i * u)}


def prp_transmission_angle(u_A, u_B):
    return {"": between(u_A, u_B)}


def rrr_condition(A, B, C):
    a, b = abs(C - A), abs(C - B)
    sine = rrr_sine(C - A, C - B)
    return {"": (abs(A) + abs(B) + a + b) / min(a, b) / sine, "exists": sine}


def rrp_condition(A, B, C, u):
    D = abs(inner(C - A, unit(u)))
    return {"": (abs(A) + abs(B) + abs(C - A) + abs(C - B)) / D, "exists": D / abs(C - A)}


def rpr_condition(A, B, u):
    D = abs(inner(A - B, unit(u)))
    return {"": (abs(A) + abs(B) + abs(A - B)) / D, "exists": D / abs(A - B)}


def prp_condition(u_A, u_B):
    return {"": 1 / prp_sine(u_A, u_B), "exists": prp_sine(u_A, u_B)}


rpp_determinant, rpp_transmission_angle, rpp_condition = prp_determinant, prp_transmission_angle, prp_condition


# --- reactions: forces of both links together, moments about a pole on the line of what is not asked for --------------


def rrr_reactions(A, B, C, loads_A, loads_B):
    (F_A, T_A), (F_B, T_B) = total(loads_A, A), total(loads_B, B)
    a, b = C - A, C - B
    D = outer(a, b)  # AC about A: a x R_C = -T_A; BC about B: b x R_C = T_B
    R_C = -over(T_B, D) * a - over(T_A, D) * b
    return {"R_A": -(R_C + F_A), "R_B": R_C - F_B, "R_C": R_C, "exists": rrr_sine(a, b)}


def rrp_reactions(A, C, u, loads_A, loads_B):
    (F_A, T_A), (F_B, T_B) = total(loads_A, A), total(loads_B, C)
    a, u = C - A, unit(u)
    D = inner(a, u)
    N = -over(T_A + outer(a, F_B), D)  # both links about A, R_B = i N u in C
    R_B = i * N * u
    known = {"R_A": -(R_B + F_A + F_B), "R_B": R_B, "R_C": R_B + F_B, "M_B": -T_B, "h_B": over(-T_B, N)}
    return {**known, "exists": abs(D) / abs(a)}


def rpr_reactions(A, B, u, loads_A, loads_B):
    (F_A, T_A), (F_B, T_B) = total(loads_A, A), total(loads_B, B)
    d, u = A - B, unit(u)
    D = inner(d, u)
    N = over(T_A + T_B, D)  # slotted link about B: T_B + T_A - d x (i N u) = 0
    R_C = i * N * u
    known = {"R_A": -(R_C + F_A), "R_B": R_C - F_B, "R_C": R_C, "M_C": -T_A, "h_C": over(-T_A, N)}
    return {**known, "exists": abs(D) / abs(d)}


def prp_reactions(C, u_A, u_B, loads_A, loads_B):
    (F_A, T_A), (F_B, T_B) = total(loads_A, C), total(loads_B, C)
    p, q = unit(u_A), unit(u_B)
    N_A, N_B = two(i * p, i * q, -(F_A + F_B))
    R_A, R_B = i * N_A * p, i * N_B * q
    known = {"R_A": R_A, "R_B": R_B, "R_C": -(R_A + F_A), "M_A": -T_A, "M_B": -T_B, "h_A": over(-T_A, N_A)}
    return {**known, "h_B": over(-T_B, N_B), "exists": abs(outer(p, q))}


def rpp_reactions(A, C, u_A, u_B, loads_A, loads_B):
    (F_A, T_A), (F_B, T_B) = total(loads_A, A), total(loads_B, C)
    p, q = unit(u_A), unit(u_B)
    N_C, N_B = two(-i * p, i * q, -F_B)  # of the slider: R_B - R_C + F_B = 0
    R_B, R_C = i * N_B * q, i * N_C * p
    M_B = -(T_A + T_B) + outer(A - C, R_C)  # of the slider about C, with -R_C in A and -M_C = T_A
    known = {"R_A": -(R_C + F_A), "R_B": R_B, "R_C": R_C, "M_B": M_B, "M_C": -T_A, "h_B": over(M_B, N_B)}
    return {**known, "h_C": over(-T_A, N_C), "exists": abs(outer(p, q))}


def coupling_drive(O1, loads):
    F, T = total(loads, O1)
    return {"M": -T, "R_O1": -F}


def gear_drive(O1, P, alpha_w, loads):
    F, T = total(loads, O1)
    q = P - O1
    along = -T / abs(q)
    teeth = acb(along, abs(along) * alpha_w.tan()) * i * unit(q)
    return {"F": teeth, "R_O1": -(F + teeth)}


def cylinder_drive(A, C, R_C, loads):
    F, T = total(loads, C)
    u = unit(C - A)
    along, across = inner(u, F + R_C), outer(u, F + R_C)
    return {"F": -along, "R": -i * across * u, "M": -T, "h": over(T, across)}


def inertia(S, m, J, a_S, epsilon):
    return {"F": -m * a_S, "P": S, "M": -J * epsilon}


def solve_reactions(A, C, u, loads_A, loads_B):
    """Of a link with a slider."""
    R = rrp_reactions(A, C, u, loads_A, loads_B)
    N = inner(R["R_B"], i * unit(u))
    return {"R_A": R["R_A"], "R_C": R["R_C"], "N": N, "M_B": R["M_B"], "exists": R["exists"]}


# --- a chain of groups ----------------------------------------------------------------------------------------------


def chain(O1, r, phi, omega, B, r_A, r_B, branch, z, G, u, r_D, branch_D):
    """Crank, dyad A-C-B, link D-E with a slider on a guide through G; D is on the link CB."""
    rod = r * acb(0, phi).exp()
    first = rrr(O1 + rod, B, r_A, r_B, branch)
    A, C = O1 + rod, first[""]
    v = rrr_velocity(A, B, C, i * omega * rod, acb(0), arb(0), arb(0))
    known = v["omega_A"], v["omega_B"], arb(0), arb(0), -(omega**2) * rod, acb(0), arb(0), arb(0)
    a = rrr_acceleration(A, B, C, *known)
    D = B + z * unit(C - B)
    second = rrp(D, G, u, r_D, branch_D, arb(0))
    E, v_D = second[""], i * v["omega_B"] * (D - B)
    a_D = acb(-(v["omega_B"] ** 2), a["epsilon_B"]) * (D - B)
    w = rrp_velocity(D, G, E, u, v_D, acb(0), arb(0), arb(0))
    still = arb(0), arb(0)
    b = rrp_acceleration(D, G, E, u, w["omega_A"], w["ds"], *still, a_D, acb(0), *still)
    known = {"C": C, "omega_B": v["omega_B"], "epsilon_B": a["epsilon_B"], "E": E, "ds": w["ds"], "dds": b["dds"]}
    return {**known, "exists": min(first["exists"], second["exists"])}


# --- the plane ----------------------------------------------------------------------------------------------------


def cross(a, b):
    return {"": outer(a, b)}


def dot(a, b):
    return {"": inner(a, b)}


def angle_between(a, b):
    return {"": between(a, b)}


def product(p, q, z):
    return {"": acb(p, q) * z}


def angle(z):
    return {"": z.arg()}


def angle_opposite(a, b, c):
    cosine = (b**2 + c**2 - a**2) / (2 * b * c)
    exists = min(a + b - c, b + c - a, c + a - b) / (a + b + c)
    return {"": cosine.acos(), "exists": exists}


def triangle_area(a, b, c):
    square = (a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)
    return {"": root(square) / 4, "exists": min(a + b - c, b + c - a, c + a - b) / (a + b + c)}


def link_point(A, B, z):
    return {"": A + z * unit(B - A)}


def link_velocity(P, A, omega, v_A):
    return {"": v_A + i * omega * (P - A)}


def link_acceleration(P, A, omega, epsilon, a_A):
    return {"": a_A + acb(-(omega**2), epsilon) * (P - A)}


# --- joints -------------------------------------------------------------------------------------------------------


def sum_of_elements(x):
    return {"": sum(x)}


def bending(y, A, M, N):
    F, S = sum(A), sum(a * level for a, level in zip(A, y, strict=True))
    y_c = S / F
    I_c = sum(a * (level - y_c) ** 2 for a, level in zip(A, y, strict=True))
    M_c = M - N * y_c
    sigma = [N / F + M_c / I_c * (level - y_c) for level in y]
    return {"sigma": sigma, "F": F, "S": S, "y_c": y_c, "I_c": I_c, "M_c": M_c, "y_0": y_c - over(N * I_c, F * M_c)}
