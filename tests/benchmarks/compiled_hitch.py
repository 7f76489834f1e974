"""The hitch worksheet once more, as one would write it by hand for numba: a scalar loop over variants and positions.

The same formulas, each computed once; the same job for each of the three Finds: the interval is sampled as densely, a
local extreme that comes near the target is looked for, the root nearest the guess on the wanted branch is bracketed to
four floats by Brent's method, and a jump is told from a root.
"""

from math import atan2, cos, inf, nan, pi, sin, sqrt

import numpy as np
from numba import njit

EPS = float(np.finfo(float).eps)


@njit(inline="always")
def cross(a, b):
    return a.real * b.imag - a.imag * b.real


@njit(inline="always")
def dot(a, b):
    return a.real * b.real + a.imag * b.imag


@njit(inline="always")
def size(z):
    return sqrt(z.real * z.real + z.imag * z.imag)


@njit(inline="always")
def unit(phi):
    return complex(cos(phi), sin(phi))


@njit(inline="always")
def angle(z):
    return atan2(z.imag, z.real)


@njit
def pin(A, B, r_A, r_B, branch):
    """Pin of two links; their triangle's area by Kahan's formula."""
    d = B - A
    L = size(d)
    low, mid, high = min(L, r_A, r_B), 0.0, max(L, r_A, r_B)
    mid = max(min(L, r_A), min(max(L, r_A), r_B))
    excess = low - (high - mid)
    if excess < 0:
        if not (high <= mid + low or high - mid <= low or high - low <= mid):
            return complex(nan, nan)
        excess = 0.0
    area = sqrt((high + (mid + low)) * excess * (low + (high - mid)) * (high + (mid - low))) / 4
    longer, shorter = max(L, r_A), min(L, r_A)
    along = (shorter**2 + (longer - r_B) * (longer + r_B)) / 2
    return A + complex(along / L**2, 2 * branch * area / L**2) * d


@njit
def height_by_rod(L4, P34, O5, L5, L56, target):
    return (O5 + L56 * unit(angle(pin(P34, O5, L4, L5, 1) - O5))).imag - target


@njit
def height_by_stroke(S, O1, O3, L3, phi_BD, L34, O5, L4, L5, L56, target):
    P34 = O3 + L34 * unit(angle(pin(O1, O3, S, L3, -1) - O3) + phi_BD)
    return (O5 + L56 * unit(angle(pin(P34, O5, L4, L5, 1) - O5))).imag - target


@njit
def mast_by_link(L7, P56, O7, L6, target):
    return angle(pin(P56, O7, L6, L7, -1) - P56) - target


@njit
def brent(f, args, a, b, f_a, f_b):
    """Root of f between a and b, to four floats."""
    c, f_c, d = a, f_a, b - a
    e = d
    for _ in range(200):
        if (f_b > 0) == (f_c > 0):
            c, f_c, d = a, f_a, b - a
            e = d
        if abs(f_c) < abs(f_b):
            a, b, c, f_a, f_b, f_c = b, c, b, f_b, f_c, f_b
        near, half = 2 * EPS * abs(b), (c - b) / 2
        if abs(half) <= near or f_b == 0:
            return b
        if abs(e) < near or abs(f_a) <= abs(f_b):
            d = e = half
        else:
            s = f_b / f_a
            if a == c:
                p, q = 2 * half * s, 1 - s
            else:
                q, r = f_a / f_c, f_b / f_c
                p = s * (2 * half * q * (q - r) - (b - a) * (r - 1))
                q = (q - 1) * (r - 1) * (s - 1)
            if p > 0:
                q = -q
            p = abs(p)
            if 2 * p < min(3 * half * q - abs(near * q), abs(e * q)):
                e, d = d, p / q
            else:
                d = e = half
        a, f_a = b, f_b
        b += d if abs(d) > near else (near if half > 0 else -near)
        f_b = f(b, *args)
    return nan


@njit
def top(f, args, a, b, sign):
    """Greatest value of sign * f between a and b by golden section."""
    g = (sqrt(5.0) - 1) / 2
    c, d = b - g * (b - a), a + g * (b - a)
    f_c, f_d = sign * f(c, *args), sign * f(d, *args)
    while b - a > 1e-8 * abs(b):
        if f_c > f_d:
            b, d, f_d = d, c, f_c
            c = b - g * (b - a)
            f_c = sign * f(c, *args)
        else:
            a, c, f_c = c, d, f_d
            d = a + g * (b - a)
            f_d = sign * f(d, *args)
    return (a + b) / 2


@njit
def find(f, args, lo, hi, near, places, x, y):
    """Root of f nearest ``near`` in lo..hi, NaN where there is none; x, y are for the samples."""
    n = len(places)
    for i in range(n):
        x[i] = lo * (1 - places[i]) + hi * places[i]
    x[0], x[n - 1] = lo, hi
    for i in range(n):
        y[i] = f(x[i], *args)
    for i in range(1, n - 1):
        high, low = y[i] >= y[i - 1] and y[i] > y[i + 1], y[i] <= y[i - 1] and y[i] < y[i + 1]
        if (high or low) and abs(y[i]) <= 64 * max(abs(y[i] - y[i - 1]), abs(y[i] - y[i + 1])):
            x[i] = top(f, args, x[i - 1], x[i + 1], 1 if high else -1)
            y[i] = f(x[i], *args)
    best, distance = nan, inf
    for i in range(n - 1):
        if y[i] == 0 and abs(x[i] - near) < distance:
            best, distance = x[i], abs(x[i] - near)
        if y[i] * y[i + 1] < 0 and max(x[i] - near, near - x[i + 1], 0.0) <= distance:
            root = brent(f, args, x[i], x[i + 1], y[i], y[i + 1])
            far = 2.0**20 * EPS * abs(root)
            off = abs(f(root, *args))
            sound = off <= 4 * max(abs(f(max(root - far, lo), *args)), abs(f(min(root + far, hi), *args))) + 4 * EPS
            if sound and abs(root - near) < distance:
                best, distance = root, abs(root - near)
    return best


@njit
def put(row, at, z):
    row[at], row[at + 1] = z.real, z.imag
    return at + 2


@njit
def reactions(A, B, C, F_A, P_A, F_B, P_B):
    """Reactions at A and B of a dyad with one force on each link."""
    a, b = A - C, B - C
    T_A, T_B, F = cross(P_A - C, F_A), cross(P_B - C, F_B), F_A + F_B
    t = -T_A / dot(a, a)
    R_A = complex((cross(b, F) - T_B + t * dot(a, b)) / cross(a, b), t) * a
    return R_A, -(R_A + F)


@njit
def hitch(inputs, places, variants, positions):
    """Results of all variants, rows in the order of PER_VARIANT and PER_POSITION; ``inputs`` shape (variants, 33)."""
    x, y = np.empty_like(places), np.empty_like(places)
    N = positions.shape[1]
    for v in range(len(inputs)):
        (
            X01, X03, X05, X07, Y01, Y03, Y05, Y07, L3, L5, L6, L34, L56, phi_BD, L7_pre, L4_pre, Y56_min, S_min, S_max,
            P6, X6, Y6, Y_P56, phi_P6, eta, D_gc, P_gc_max, k_gc, a, b, L, P_gr, P_msha,
        ) = (
            inputs[v, 0], inputs[v, 1], inputs[v, 2], inputs[v, 3], inputs[v, 4], inputs[v, 5], inputs[v, 6],
            inputs[v, 7], inputs[v, 8], inputs[v, 9], inputs[v, 10], inputs[v, 11], inputs[v, 12], inputs[v, 13],
            inputs[v, 14], inputs[v, 15], inputs[v, 16], inputs[v, 17], inputs[v, 18], inputs[v, 19], inputs[v, 20],
            inputs[v, 21], inputs[v, 22], inputs[v, 23], inputs[v, 24], inputs[v, 25], inputs[v, 26], inputs[v, 27],
            inputs[v, 28], inputs[v, 29], inputs[v, 30], inputs[v, 31], inputs[v, 32],
        )  # fmt: skip
        O1, O3, O5, O7 = complex(X01, Y01), complex(X03, Y03), complex(X05, Y05), complex(X07, Y07)
        L13, L35, L57 = size(O1 - O3), size(O3 - O5), size(O7 - O5)
        phi13 = atan2(Y03 - Y01, X01 - X03)

        P34 = O3 + L34 * unit(angle(pin(O1, O3, S_min, L3, -1) - O3) + phi_BD)
        L4_0 = (L4_pre * 0.1 + L4_pre * 1.5) * 0.5
        reach = size(O5 - P34)
        args4 = (P34, O5, L5, L56, Y56_min)
        L4 = find(height_by_rod, args4, abs(reach - L5), reach + L5, L4_0, places, x, y)
        args_S = (O1, O3, L3, phi_BD, L34, O5, L4, L5, L56, Y_P56)
        S_p = find(height_by_stroke, args_S, S_min, S_max, 0.5 * (S_max + S_min), places, x, y)
        P34 = O3 + L34 * unit(angle(pin(O1, O3, S_p, L3, -1) - O3) + phi_BD)
        P56 = O5 + L56 * unit(angle(pin(P34, O5, L4, L5, 1) - O5))
        L7_0 = (L7_pre * 0.1 + L7_pre * 1.5) * 0.5
        reach = size(O7 - P56)
        args7 = (P56, O7, L6, phi_P6)
        L7 = find(mast_by_link, args7, abs(reach - L6), reach + L6, L7_0, places, x, y)
        P67 = pin(P56, O7, L6, L7, -1)

        LS6 = sqrt(X6**2 + Y6**2)
        r_s = size(complex(X6, Y6) - P67)
        phiS6 = (atan2(Y6, X6) - angle(P67 - P56)) % (2 * pi)
        S_gc = pi * D_gc**2 / 4
        G6 = complex(0.0, -P6)
        Ra_min = 0.2 * (P6 + P_msha + P_gr)
        out = variants[v]
        out[0] = (S_max - S_min) / (N - 1)
        i = put(out, put(out, put(out, put(out, 1, O1), O3), O5), O7)
        for value in (L13, phi13, L35, pi - angle(O3 - O5), L4_0, L4, S_p, L57, pi - angle(O7 - O5), L7_0):
            out[i] = value
            i += 1
        for value in (L7, LS6, r_s, phiS6, S_gc):
            out[i] = value
            i += 1
        i = put(out, i, G6)
        out[i] = Ra_min

        for k in range(N):
            S = S_min * (1 - k / (N - 1)) + S_max * (k / (N - 1))
            P23 = pin(O1, O3, S, L3, -1)
            phi3, phi12 = angle(P23 - O3), angle(P23 - O1)
            phi34 = phi3 + phi_BD
            P34 = O3 + L34 * unit(phi34)
            P45 = pin(P34, O5, L4, L5, 1)
            phi4, phi5 = angle(P45 - P34), angle(P45 - O5)
            P56 = O5 + L56 * unit(phi5)
            P67 = pin(P56, O7, L6, L7, -1)
            phi6, phi7 = angle(P67 - P56), angle(P67 - O7)
            PS6 = P56 + LS6 * unit(phiS6 + phi6)
            phi12_printed = phi13 - np.arccos((S**2 + L13**2 - L3**2) / (2 * S * L13))
            P23s, P23c = O1 + S * unit(phi12_printed), O1 + S * unit(phi12)
            P34s, P45s, P67s = P45 - L4 * unit(phi4), P34 + L4 * unit(phi4), P56 + L6 * unit(phi6)

            U43 = L34 * sin(phi5 - phi34) / (L4 * sin(phi4 - phi5))
            U53 = L34 * sin(phi34 - phi4) / (L5 * sin(phi5 - phi4))
            U65 = L56 * sin(phi7 - phi5) / (L6 * sin(phi6 - phi7))
            U75 = L56 * sin(phi5 - phi6) / (L7 * sin(phi7 - phi6))
            dphi3 = 1 / (L3 * sin(phi12 - phi3))
            dphi4, dphi5, dphi6, dphi7 = dphi3 * U43, dphi3 * U53, dphi3 * U65 * U53, dphi3 * U75 * U53
            I56 = dphi5 * L56 * cos(phi5)
            IS6 = I56 + dphi6 * LS6 * cos(phi6 + phiS6)

            F_gc = P6 * IS6
            P_gc = F_gc / (k_gc * S_gc * eta)
            G56, GS6 = k_gc * P_gc_max * eta * S_gc / I56, k_gc * P_gc_max * eta * S_gc / IS6
            dGS65 = (GS6 - P6) / P6 if P6 else inf

            R56, R07 = reactions(P56, O7, P67, G6, PS6, 0j, O7)
            R_A, R_B = reactions(P34, O5, P45, 0j, P34, -R56, P56)
            R34, R05 = -R_A, -R_B
            R01, R03 = reactions(O1, O3, P23, 0j, O1, R34, P34)

            Ra = (P_gr * (a + L) + P_msha * b - P6 * PS6.real) / L
            Rb = P_gr + P_msha + P6 - Ra
            weight = P6 + P_msha + P_gr
            GS6_max = (P_msha * b + P_gr * (a + L) - Ra_min) / PS6.real
            GS6_lim = (P_msha * b + P_gr * (a + L) - 0.2 * L * (P_msha + P_gr)) / (PS6.real + 0.2 * L)

            D_p = cross(P56 - O5, P67 - O7)
            N_p = cross(O7 - O5, P67 - O7) * (P56 - O5).real
            k_p = dphi5 / (L6 * L7 * sin(phi6 - phi7))
            Imp, Isp = k_p * ((P56 - O5).real * D_p - N_p), k_p * ((PS6 - O5).real * D_p - N_p)

            out = positions[v, k]
            out[0] = S
            i = 1
            for z in (P23, P34, P45, P56, P67, PS6):
                i = put(out, i, z)
            for value in (phi12, phi3, phi34, phi4, phi5, phi6, phi7, phi12_printed):
                out[i] = value
                i += 1
            for z in (P23s, P23c, P34s, P45s, P67s):
                i = put(out, i, z)
            for value in (U43, U53, U65, U75, dphi3, dphi4, dphi5, dphi6, dphi7, I56, IS6, F_gc, P_gc, G56, GS6, dGS65):
                out[i] = value
                i += 1
            for z in (R56, R07, -R07, -R56, R34, R05, R34, R01, R03, R01):
                i = put(out, i, z)
            for value in (Ra, Rb, Ra / weight, Rb / weight, GS6_max, GS6_lim, Imp, Isp):
                out[i] = value
                i += 1
