"""Products, angles and points of links in elementary steps."""

from typing import Any

import numpy as np

from mechsheet.mechanics.group import ROUNDINGS

Quantity = Any  # a number, an array, or a quantity that records what is done with it


def step(symbol: str, unit: str, meaning: str, value: Quantity) -> Quantity:
    """A named intermediate quantity."""
    return value.called(symbol, unit, meaning) if hasattr(value, "called") else value


def whole(C: Quantity, u: Quantity, by: Quantity) -> Quantity:
    """A point found along ``u``: no coordinate of it is a number where ``by`` is none, along an axis neither."""
    if any(map(_is_nothing, (u.real, u.imag))):
        return np.where(np.isfinite(by), C, complex(np.nan, np.nan))
    return C


def _is_nothing(x: Quantity) -> bool:
    node = getattr(x, "re", None)
    return not np.any(x) if node is None else node.op == "constant" and not node.value.any()


def settled(x: Quantity, size: Quantity) -> Quantity:
    """A difference of what is as large as ``size``; 0, without a known slope, where it is no more than rounding.

    A constant instead would keep still there, and with it a root that has no slope.
    """
    return x * (np.abs(x) > ROUNDINGS * size)


def cross(a: Quantity, b: Quantity) -> Quantity:
    return a.real * b.imag - a.imag * b.real


def dot(a: Quantity, b: Quantity) -> Quantity:
    return a.real * b.real + a.imag * b.imag


def angle(z: Quantity) -> Quantity:
    return np.arctan2(z.imag, z.real)


def angle_between(a: Quantity, b: Quantity) -> Quantity:
    return np.arctan2(np.abs(cross(a, b)), dot(a, b))


def angle_opposite(a: Quantity, b: Quantity, c: Quantity) -> Quantity:
    size = a * (b + c)
    over, under = settled((a - b + c) * (a + b - c), size), settled((a + b + c) * (b + c - a), size)
    return 2 * np.arctan2(np.sqrt(over), np.sqrt(under))


def link_velocity(P: Quantity, A: Quantity, omega: Quantity, v_A: Quantity = 0) -> Quantity:
    return v_A + 1j * omega * (P - A)


def link_acceleration(P: Quantity, A: Quantity, omega: Quantity, epsilon: Quantity = 0, a_A: Quantity = 0) -> Quantity:
    return a_A + (1j * epsilon - omega**2) * (P - A)


def link_point(A: Quantity, B: Quantity, z: Quantity) -> Quantity:
    d = B - A
    return A + z * d / np.abs(d)


def crank(O1: Quantity, r: Quantity, phi: Quantity) -> Quantity:
    return O1 + r * (np.cos(phi) + 1j * np.sin(phi))


def product(p: Quantity, q: Quantity, z: Quantity) -> Quantity:
    return (p + 1j * q) * z


def unit(u: Quantity) -> Quantity:
    return u / np.abs(u)
