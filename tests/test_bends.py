"""Second slopes against those at 50 digits: of every rule, of found values, at corners."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own

from mechsheet.accuracy.arithmetic import mp, mpf
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.bends import BENT, bends
from mechsheet.readers.slope_rules import SMOOTH
from mechsheet.recording.record import record


def test_every_smooth_operation_has_a_rule() -> None:
    assert set(BENT) == {*SMOOTH, "pow"}


def second(folder: Path, lines: str, directions: Any, **given: Any) -> dict[str, Any]:
    """Second slopes of the results of some lines along directions of F and a, by the names of the results."""
    sheet = own(folder, lines)
    names = sheet.run(sheet.results, {"g": sheet.inputs(**given)})
    recording = record({**names, "__file__": sheet.path}, sheet, whole=True)
    nodes = {name: x.whole().re for name, x in recording.values.items() if name in lines and isinstance(x, Quantity)}
    found = bends(nodes.values(), [recording.inputs["F"], recording.inputs["a"]], np.array(directions, float))
    return {name: found[node] for name, node in nodes.items()}


RULES = {
    "u_sum": ("g.F - g.a + 2", lambda F, a: F - a + 2),
    "u_product": ("-g.F * g.a * g.F", lambda F, a: -F * a * F),
    "u_quotient": ("(g.F - 3) / (g.a * g.F)", lambda F, a: (F - 3) / (a * F)),
    "u_root": ("sqrt(g.F * g.a)", lambda F, a: mp.sqrt(F * a)),
    "u_exp": ("np.exp(g.F * g.a)", lambda F, a: mp.exp(F * a)),
    "u_log": ("np.log(g.F + g.a**2)", lambda F, a: mp.log(F + a**2)),
    "u_sin": ("sin(g.F * g.a)", lambda F, a: mp.sin(F * a)),
    "u_cos": ("cos(g.F / g.a)", lambda F, a: mp.cos(F / a)),
    "u_tan": ("np.tan(g.F * g.a)", lambda F, a: mp.tan(F * a)),
    "u_asin": ("np.arcsin(g.a / g.F)", lambda F, a: mp.asin(a / F)),
    "u_acos": ("np.arccos(g.a / g.F)", lambda F, a: mp.acos(a / F)),
    "u_atan": ("np.arctan2(g.F, g.a * g.F - 1)", lambda F, a: mp.atan2(F, a * F - 1)),
    "u_cube": ("(g.F * g.a) ** 3", lambda F, a: (F * a) ** 3),
    "u_power": ("g.F ** (g.a * g.F)", lambda F, a: F ** (a * F)),
    "u_distance": ("abs(g.F + 1j * g.a * g.F)", lambda F, a: mp.sqrt(F**2 + (a * F) ** 2)),
    "u_log1p": ("np.log1p(g.F * g.a)", lambda F, a: mp.log(1 + F * a)),
    "u_most": ("np.max(g.F * np.array([1.0, 2.0, 0.5]) * g.a**2)", lambda F, a: 2 * F * a**2),
    "u_size": ("abs(g.a - g.F) ** 1.5", lambda F, a: abs(a - F) ** mpf("1.5")),
    "u_chosen": ("np.where(g.F > g.a, g.F**2 * g.a, 0.0)", lambda F, a: F**2 * a),
    "u_total": ("np.sum(np.cos(g.F * linspace(1, 3, 3)))", lambda F, a: sum(mp.cos(F * k) for k in (1, 2, 3))),
    "u_found": ("x_found.value * 1.0", None),
}


def cubic(F: Any, a: Any) -> Any:
    return mp.findroot(lambda x: x**3 + x - F * a, mpf(1))


def test_second_slopes_are_exact_to_rounding(tmp_path: Path) -> None:
    lines = 'x_found = find(lambda x: x**3 + x - g.F * g.a, 0.0, 9.0, unknown="x")\n' + "\n".join(
        f"{name} = {text}  # [-] bent" for name, (text, _) in RULES.items()
    )
    directions = [(1.0, 0.0), (0.0, 1.0), (0.6, -0.8)]
    found = second(tmp_path, lines, directions)
    for name, (_, f) in RULES.items():
        for k, (p, q) in enumerate(directions):
            true = mp.diff(lambda t, f=f, p=p, q=q: (f or cubic)(mpf(2.5) + t * mpf(p), mpf(0.75) + t * mpf(q)), 0, 2)
            assert abs(float(found[name][k]) - float(true)) <= 1e-13 * max(1, abs(float(true))), (name, k)


def test_several_unknowns_over_positions_bend_by_their_equations(tmp_path: Path) -> None:
    """A point on two circles: p² + q² = F², (p - a)² + q² = s², so 2 a p = F² + a² - s², and q from the first."""
    lines = """
s = linspace(2.2, 2.6, 3)  # [-] positions
c_found = find(lambda p, q: (p**2 + q**2 - g.F**2, (p - g.a) ** 2 + q**2 - s**2), p=s, q=1 + s)
p, q = c_found.value  # [-] one, [-] other"""
    found = second(tmp_path, lines.strip(), [(1.0, 0.0), (0.3, 0.5)])

    def pin(F: Any, a: Any, s: Any) -> tuple[Any, Any]:
        p = (F**2 + a**2 - s**2) / (2 * a)
        return p, mp.sqrt(F**2 - p**2)

    for k, (u, v) in enumerate([(1.0, 0.0), (0.3, 0.5)]):
        for i, s in enumerate(np.linspace(2.2, 2.6, 3)):
            for n, name in enumerate("pq"):
                true = mp.diff(lambda t, s=s, n=n, u=u, v=v: pin(mpf(2.5) + t * u, mpf(0.75) + t * v, mpf(s))[n], 0, 2)
                assert found[name][k, i] == pytest.approx(float(true), rel=1e-11), (name, k, i)


@pytest.mark.parametrize(
    "text",
    [
        "abs(g.F - 2.5) * (g.F - 2.5)",  # 2 x |x| bends by 2 on one side and by -2 on the other
        "np.where(g.F >= 2.5, 1.0, -1.0) * (g.F - 2.5) ** 2",
        "np.maximum(g.F, 2.5)",
        "np.sqrt((g.F - 2.5) ** 4)",
        'float(f"{g.F:.17g}") * (4 - g.F)',
    ],
)
def test_at_a_corner_there_is_no_second_slope(text: str, tmp_path: Path) -> None:
    with np.errstate(all="ignore"):
        found = second(tmp_path, f"u = {text}  # [-] bent", [(1.0, 0.0)], F=2.5)
    assert np.isnan(found["u"]).all()
