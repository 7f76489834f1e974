"""A kernel of the mechanics exchanged for a mathematically equal one: the proof sees the digits that it loses."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own

import mechsheet
from mechsheet.accuracy.arithmetic import mp, mpc, mpf
from mechsheet.mechanics.rrr import rrr
from mechsheet.quantities import elementary_rrr
from mechsheet.readers.proof import Proved
from mechsheet.recording.record import record
from mechsheet.run.proving import proof_of


def by_arccosine(A: Any, B: Any, r_A: Any, r_B: Any, branch: Any) -> Any:
    """Law of cosines: near 0 a cosine hardly tells its angle."""
    L = np.abs(B - A)
    return A + r_A * np.exp(1j * (np.angle(B - A) + branch * np.arccos((L**2 + r_A**2 - r_B**2) / (2 * L * r_A))))


def by_far_points(A: Any, B: Any, r_A: Any, r_B: Any, branch: Any) -> Any:
    """About an origin a thousand kilometres away."""
    return rrr(A + 1e6, B + 1e6, r_A, r_B, branch) - 1e6


def by_elimination(A: Any, B: Any, r_A: Any, r_B: Any, branch: Any) -> Any:
    """One coordinate by a quadratic equation and the other by the line through both pins, divided by what may be 0."""
    d = B - A
    k, L2 = (np.abs(d) ** 2 + r_A**2 - r_B**2) / 2, np.abs(d) ** 2
    y = (k * d.imag + branch * d.real * np.sqrt(L2 * r_A**2 - k**2)) / L2
    return A + (k - y * d.imag) / d.real + 1j * y


# The kernel, and pins and lengths where it loses: a tiny link, any, one pin above the other.
LOSING: dict[str, tuple[Callable[..., Any], str]] = {
    "arccosine near 0": (by_arccosine, "0j, 1 + 0j, 1.0, 1e-6 * g.a"),
    "difference of far points": (by_far_points, "0.25 * g.a + 0j, 1 + 0.5j * g.a, 0.625, 0.75"),
    "removable singularity": (by_elimination, "0.25 * g.a + 0j, 0.25 * g.a + 1e-9 * g.a + 1j, 0.625, 0.75"),
}


def pin(name: str, a: Any) -> Any:
    """The pin at 50 digits."""
    A, B, r_A, r_B = {
        "arccosine near 0": (mpc(0), mpc(1), mpf(1), a * mpf("1e-6")),
        "difference of far points": (mpc(a / 4), mpc(1, a / 2), mpf("0.625"), mpf("0.75")),
        "removable singularity": (mpc(a / 4), mpc(a / 4 + a * mpf("1e-9"), 1), mpf("0.625"), mpf("0.75")),
    }[name]
    d = B - A
    x = (abs(d) ** 2 + r_A**2 - r_B**2) / (2 * abs(d))
    return A + (x + mpc(0, 1) * mp.sqrt(r_A**2 - x**2)) * d / abs(d)


def proved(folder: Path, where: str) -> tuple[Any, list[Proved]]:
    sheet = own(folder, f"C = rrr({where}, +1)  # [m] pin")
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    proof = proof_of(names, sheet, record(names, sheet, whole=True, exact=True))
    return names["C"], [column for column in proof.columns if column.name == "C"]


@pytest.mark.parametrize("name", LOSING)
def test_the_digits_that_a_kernel_loses_are_not_proved(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kernel, where = LOSING[name]
    true = pin(name, mpf(0.75))
    monkeypatch.setattr(kernel, "__module__", rrr.__module__)  # it stands in the library in place of that
    monkeypatch.setattr(elementary_rrr, kernel.__name__, elementary_rrr.rrr, raising=False)
    least = dict[Any, float]()
    for form in (rrr, kernel):
        monkeypatch.setattr(mechsheet, "rrr", form, raising=False)
        (tmp_path / form.__name__).mkdir()
        C, claims = proved(tmp_path / form.__name__, where)
        for part, own_part, claim in zip((true.real, true.imag), (C.real, C.imag), claims, strict=True):
            off = abs(mpf(float(own_part)) - part) / abs(part)
            there = min(16.0, float(-mp.log10(off))) if off else 16.0
            assert there - 0.2 < claim.least <= there + 1e-6, (form.__name__, claim)
        least[form] = min(claim.least for claim in claims)
    assert least[rrr] > 14.5 and least[kernel] < least[rrr] - 4, least
