"""Joints of compartments in elementary steps."""

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np

from mechsheet.mechanics import joint
from mechsheet.mechanics.group import ROUNDINGS
from mechsheet.mechanics.joint import Bending, Ring, Section
from mechsheet.quantities.elementary_planar import Quantity, step
from mechsheet.quantities.quantity import plain


class States:
    """Texts of which one holds for each element; whoever looks at them takes them for those of the present numbers.

    Of ``cases`` is known where they hold, so that a text is compared like a number.
    """

    def __init__(self, now: Any, rest_on: Sequence[Quantity], cases: Mapping[str, Quantity] | None = None) -> None:
        self._now, self._rest_on, self._cases = now, rest_on, cases or {}

    def seen(self) -> Any:
        for x in self._rest_on:
            plain(x)
        return self._now

    def __eq__(self, text: object) -> Any:
        return self._cases[text] if isinstance(text, str) and text in self._cases else self.seen() == text

    def __ne__(self, text: object) -> Any:
        equal = self == text
        return ~equal

    __hash__ = None  # type: ignore[assignment]

    def __array__(self, *args: Any, **kwargs: Any) -> Any:
        return np.asarray(self.seen(), *args)

    def __getitem__(self, key: Any) -> Any:
        return self.seen()[key]

    def __iter__(self) -> Any:
        return iter(self.seen())

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(self.seen().shape)


def sum_of_elements(x: Quantity) -> Quantity:
    return x.sum(axis=-1)


def bending(y: Quantity, A: Quantity, M: Quantity, N: Quantity) -> Bending:
    F = step("F", "m**2", "area", A.sum(axis=-1))
    S = step("S", "m**3", "first moment of area", (A * y).sum(axis=-1))
    y_c = S / F
    lever = y - y_c[..., None]
    second = (A * lever**2).sum(axis=-1)
    second = np.where(second > ROUNDINGS**2 * (A * y**2).sum(axis=-1), second, np.nan)  # none of a single level
    I_c = step("I", "m**4", "second moment of area about the centroid", second)
    M_c = M - N * y_c
    rounding = ROUNDINGS * (np.abs(M) + np.abs(N) * (A * np.abs(y)).sum(axis=-1) / F)
    turning = np.where(np.abs(M_c) > rounding, M_c, 0.0)  # none where pulled evenly: the axis is at infinity
    sigma = (N / F)[..., None] + (M_c / I_c)[..., None] * lever
    return Bending(sigma, F, S, y_c, I_c, M_c, y_c - N * I_c / (F * turning))


def _numbers(*quantities: Quantity) -> Any:
    """Present values of quantities that may be recorded."""
    return [getattr(x, "value", x) for x in quantities]


ITERATIONS = 5  # of the neutral axis, from the areas that acted when the workbook was made


def neutral_axis(y: Quantity, A_t: Quantity, A_c: Quantity, M: Quantity, N: Quantity) -> Section:
    """The document's iteration; its last areas count only where they are those of the stresses that they give.

    Without load the axis is that of the first ray, on the lowest level.
    """
    known = joint.neutral_axis(*_numbers(y, A_t, A_c, M, N))
    loaded, upper = ((M != 0) | (N != 0))[..., None], y > y.min(axis=-1, keepdims=True)
    stretched: Quantity = known.sigma > 0
    for _ in range(ITERATIONS):
        area = step("A", "m**2", "area that acts", np.where(stretched, A_t, A_c))
        result = bending(y, area, M, N)
        before, stretched = stretched, step("t", "-", "stretched", np.where(loaded, result.sigma > 0, upper))
    steady = ((stretched & before) | ~(stretched | before)).all(axis=-1, keepdims=True)
    area = np.where(steady, area, np.nan)
    result = bending(y, area, M, N)
    state = States(known.state, [steady, (result.sigma > 0).any(axis=-1), (result.sigma < 0).any(axis=-1)])
    return Section(result.sigma, result.sigma * area, area, result.y_0, cast("joint.Text", state))


def circular_joint(r: Quantity, phi: Quantity, M: Quantity, N: Quantity) -> Ring:
    """The two equations of equilibrium with the integrals over the compressed arc written out."""
    known = joint.circular_joint(*_numbers(r, phi, M, N))
    bend, axial, side = 2 * np.abs(M), N * r, np.where(M < 0, -1.0, 1.0)
    u = step("u", "-", "1 where the joint is stretched most", side[..., None] * np.cos(phi))
    q = step("q", "N*m", "line load of a uniform ring at the bolt, pulled part", axial[..., None] + bend[..., None] * u)
    q = np.where(q > 0, q, 0.0)
    bolt_N, bolt_M = step("bN", "N*m", "sum of the bolts", q.sum(axis=-1)), (q * u).sum(axis=-1)
    over, under = np.where(bend > axial, bend - axial, 0.0), np.where(bend + axial > 0, bend + axial, 0.0)
    alpha = step("alpha", "rad", "half of the compressed arc", 2 * np.arctan2(np.sqrt(over), np.sqrt(under)))
    arc_N = step("aN", "N*m", "sum of the arc", (alpha * axial - bend * np.sin(alpha)) / np.pi)
    lever = bend * (alpha + np.sin(alpha) * np.cos(alpha)) - 2 * axial * np.sin(alpha)
    arc_M = step("aM", "N*m", "moment of the arc", lever / (2 * np.pi))
    mixed = step("mixed", "-", "one part pulled, the other compressed", (axial < bend) & (axial > -bend))
    rim = axial <= -bend
    D = step("D", "N**2*m**2", "determinant of the two equations", bolt_N * arc_M - bolt_M * arc_N)
    k_t = (axial * arc_M - bend * arc_N / 2) / D
    shares = np.where(mixed, (bend * bolt_N / 2 - axial * bolt_M) / D, 1.0)
    k_c = step("kc", "-", "line load of the rim, part of a uniform ring's", shares)
    alone = bending(u, 1 + 0 * u, bend / 2, axial).sigma
    alone = np.where(rim[..., None], 0.0, alone)
    P = np.where(mixed[..., None], k_t[..., None] * q, alone) / (r[..., None] if np.ndim(r) else r)
    load = bend + np.abs(axial)
    rounding = np.sum(1.0 + 0 * phi, axis=-1) * np.finfo(float).eps * load
    none, pulled = mixed & (bolt_N == 0), mixed & (k_c * arc_N > rounding)
    least = -(rounding / r)[..., None]
    pressed = ~mixed & ~rim & (least > P).any(axis=-1)
    holds = step("holds", "-", "an equilibrium of this kind", ~(none | pulled | pressed))
    cases = {
        "tension and compression": mixed & holds,
        "all in compression": rim & holds,
        "no load": (load == 0) & holds & ~rim,
        "no bolt in tension": none,
        "ring in tension": pulled & ~none,
        "bolt in compression": pressed,
    }
    M_x = np.where(holds, r * (P * np.sin(phi)).sum(axis=-1), np.nan)
    c, k_c = np.where(holds, side * axial / bend, np.nan), np.where(holds, k_c, np.nan)
    p_0 = k_c * np.where(alpha > 0, axial - bend, 0.0) / (2 * np.pi * r**2)
    return Ring(
        P=np.where(holds[..., None], P, np.nan),
        p_0=p_0,
        R=k_c * arc_N / r,
        M_R=side * k_c * arc_M,
        M_x=M_x,
        c=c,
        y_0=-c * r,
        phi_0=np.broadcast_arrays(np.where(holds, np.pi - alpha, np.nan), p_0)[0],
        state=cast("joint.Text", States(known.state, [*cases.values()], cases)),
    )
