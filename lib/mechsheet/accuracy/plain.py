"""The library's closed forms without what surrounds them there: plain numpy for arrays that are known to be right.

No argument is looked at, no dead centre or end of reach told, and no digit kept with care. The difference to the
library's time is what its checks cost.
"""

from typing import Any

from numpy import sqrt

from mechsheet.accuracy.arithmetic import cross, dot


def rrr(A: Any, B: Any, r_A: Any, r_B: Any, branch: int) -> Any:
    """Inner pin of a dyad, by Heron's formula."""
    d = B - A
    L2 = dot(d, d)
    L = sqrt(L2)
    area = sqrt((L + r_A + r_B) * (r_A + r_B - L) * (L + r_A - r_B) * (L - r_A + r_B))
    return A + (L2 + (r_A - r_B) * (r_A + r_B) + 1j * (branch * area)) / (2 * L2) * d


def rrr_turns(a: Any, b: Any, w: Any) -> tuple[Any, Any]:
    """omega_A, omega_B of the links a, b for i (omega_A a - omega_B b) = w: velocities, and accelerations too."""
    D = cross(a, b)
    return dot(w, b) / D, dot(w, a) / D


def rrr_forces(A: Any, B: Any, C: Any, F_A: Any, T_A: Any, F_B: Any, T_B: Any) -> tuple[Any, Any, Any]:
    """R_A, R_B, R_C for the sums of the loads and their moments about A and B."""
    a, b = C - A, C - B
    R_C = -(T_B * a + T_A * b) / cross(a, b)
    return -(R_C + F_A), R_C - F_B, R_C


def rrp_forces(A: Any, C: Any, u: Any, F_A: Any, T_A: Any, F_B: Any) -> tuple[Any, Any, Any]:
    """R_A, R_B, R_C of a link with a slider on a guide along the unit vector u; T_A about A."""
    a = C - A
    R_B = -1j * ((T_A + cross(a, F_B)) / dot(a, u)) * u
    R_C = R_B + F_B
    return -(R_C + F_A), R_B, R_C


def rpr_forces(A: Any, B: Any, F_A: Any, T_A: Any, F_B: Any, T_B: Any) -> tuple[Any, Any, Any]:
    """R_A, R_B, R_C of a rod in a cylinder in line with it; moments about A and B."""
    d = A - B
    R_C = 1j * ((T_A + T_B) / dot(d, d)) * d
    return -(R_C + F_A), R_C - F_B, R_C
