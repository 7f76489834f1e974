"""A line that looks at all variants of a sweep at once has the numbers of each variant alone, whichever there are."""

from pathlib import Path

import numpy as np
import pytest
from own_worksheet import own

from mechsheet import sweep

MIXED = {  # which is the same for each of the first variants, and of few of the others
    "y = 2.0 if np.any(g.F * np.arange(1.0, 5.0) > 9) else 1.0",
    "y = 2.0 if (g.F * np.arange(1.0, 5.0)).max() > 9 else 1.0",
    "y = min(float(np.max(g.F * np.arange(1.0, 5.0))), 9.0) * 1.0",
    "y = np.minimum(np.array([g.F, 2.0 * g.F, 3.0 * g.F]).max(), 9.0)",
    "z = max(np.max(g.F * np.arange(4)), 6.0)\ny = g.a * z",
    "A = np.ones(3)\nA[1] = np.count_nonzero(g.F * np.arange(1.0, 5.0) > 9)\ny = g.a * np.minimum(A, 1.0).sum()",
    "y = find(lambda v: v**3 + v, 0, 5, equals=np.any(g.F * np.arange(1.0, 5.0) > 9) * 1.0).value",
    "y = find(lambda v: v**3 + v - np.any(g.F * np.arange(1.0, 5.0) > 9), 0, 5).value",
    "y = 2.0 if sum(v > 9 for v in g.F * np.arange(1.0, 5.0)) else 1.0",
    "y = 2.0 if np.allclose(np.minimum(g.F * np.arange(1.0, 5.0), 1.0), 1.0) else 1.0",
    "y = g.a * min(len((g.F * np.arange(1.0, 5.0))[g.F * np.arange(1.0, 5.0) > 9]), 1)",
    "y = g.a * min(np.where(g.F * np.arange(1.0, 5.0) > 9)[0].size, 1)",
    "y = g.a * min(np.argwhere(g.F * np.arange(1.0, 5.0) > 9).shape[0], 1)",
    "y = g.a * (np.size(np.unique(np.maximum(g.F * np.arange(1.0, 5.0), 9))) > 1)",
    "y = np.maximum(np.sort((g.F * np.arange(1.0, 5.0)).reshape(-1))[-1], 9.0)",
    "u = g.F * np.arange(1.0, 5.0)\ny = np.maximum(u.flat[u.size - 1], 9.0)",
    "y = np.maximum((g.F * np.arange(1.0, 5.0)).astype(float).max(), 9.0)",
    "y = np.maximum(np.ascontiguousarray(g.F * np.arange(1.0, 5.0)).max(), 9.0)",
    "y = round(max(float((g.F * np.arange(1.0, 5.0)).max()), 9.0), 6)",
    "y = np.maximum(np.float64((g.F * np.arange(1.0, 5.0)).max()), 9.0)",
    "y = max(complex((g.F * np.arange(1.0, 5.0)).max()).real, 9.0)",
    "import statistics\ny = np.maximum(statistics.fmean((g.F * np.arange(1.0, 5.0)).ravel()), 9.0)",
    "from scipy.optimize import brentq\ny = brentq(lambda v: v - max((g.F * np.arange(1.0, 5.0)).max(), 9.0), 0, 50)",
    "from mechsheet import find as f\nu = g.F * np.arange(1.0, 5.0)\ny = f(lambda v: v - max(u.max(), 9), 0, 50).value",
    "import numpy\ny = np.maximum(numpy.array([(g.F * np.arange(1.0, 5.0)).max(), 1.0])[0], 9.0)",
    "from mechsheet import angle\ny = 2.0 if np.any(angle(1 + 1j * g.F * np.arange(1.0, 5.0)) > np.arctan(9)) else 1.0",
    "from mechsheet import RRRGroup as R\ny = max(R(0, g.F * np.arange(1.0, 5.0), 20.0, 20.0, 1).C.real.max(), 4.5)",
    "f = lambda v: 3.0 if (v < 1).all() else 1.0\ny = f(np.maximum(g.F - 2.2, 0.5) * np.arange(1.0, 3.0) / 2.0)",
}


@pytest.mark.parametrize("lines", sorted(MIXED))
def test_a_variant_has_its_own_number_whatever_others_have(lines: str, tmp_path: Path) -> None:
    """All had that of the greatest one; and those of another sweep too, once one was found to go at once."""
    sheet = own(tmp_path, f"{lines}\nresult = y * 1.0  # [-] line")
    for greatest in (1.9, 6.0):
        F = np.append(np.linspace(1.0, greatest, 60), 1.2)
        swept = sweep(sheet.path, ["result"], {"F": F})
        alone = [sheet.run(["result"], {"g": sheet.inputs(F=x)})["result"] for x in F]
        assert swept["result"] == pytest.approx(alone, rel=1e-12, abs=1e-12)


PYTHONS = {  # whose numbers make of a line what arrays do not, as in a few variants alone
    "try:\n    y = 1 / (g.F - 2.0)\nexcept ZeroDivisionError:\n    y = 100.0",
    "try:\n    y = 1 / (g.F - 2.0)\nexcept Exception:\n    y = 100.0",
    "try:\n    y = g.a / (g.F % (2.0 - g.F))\nexcept ZeroDivisionError:\n    y = 100.0",
    "from contextlib import suppress\ny = 3.0\nwith suppress(OverflowError):\n    y = 10.0 ** (400.0 * (g.F > 2.9))",
    "from contextlib import suppress as quietly\ny = 3.0\nwith quietly(ZeroDivisionError):\n    y = 1 / (g.F - 2.0)",
    "def f(u):\n    try:\n        return 1 / u\n    except ZeroDivisionError:\n        return 7.0\ny = f(g.F - 2.0)",
    "y = (g.F > 1) + (g.F > 2) + (g.F > 2.9)",
    "y = ((g.F > 2) + True) * g.a",
}


@pytest.mark.parametrize("lines", sorted(PYTHONS))
def test_a_variant_has_what_python_makes_of_its_numbers(lines: str, tmp_path: Path) -> None:
    """A division by zero that is handled was infinite, or handled for all of them; what holds was counted as one."""
    sheet = own(tmp_path, f"{lines}\nresult = y * 1.0  # [-] line")
    F = np.array([*np.linspace(0.53, 2.8, 40), 2.0, *np.linspace(1.01, 3.0, 20)])
    alone = [sheet.run(["result"], {"g": sheet.inputs(F=x)})["result"] for x in F.tolist()]
    assert sweep(sheet.path, ["result"], {"F": F})["result"] == pytest.approx(alone, rel=1e-12)


def test_a_module_beside_the_worksheet_may_handle_an_error_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    handles = "    try:\n        return 1 / u\n    except ZeroDivisionError:\n        return 7.0\n"
    (tmp_path / "handles_an_error.py").write_text(f"def inverse(u):\n{handles}", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    sheet = own(tmp_path, "from handles_an_error import inverse\nresult = inverse(g.F - 2.0)  # [-] line")
    swept = sweep(sheet.path, ["result"], {"F": [*np.linspace(0.53, 2.8, 40), 2.0]})
    assert swept["result"][-1] == 7.0 and not swept.at_once


def test_a_variant_whose_number_is_too_great_for_python_has_none(tmp_path: Path) -> None:
    """It was infinite, and its inverse 0; what is infinite in an array alone is so among others."""
    sheet = own(tmp_path, "y = 1 / 10.0 ** (g.F * 200)\nresult = y * 1.0  # [-] line")
    F = [*np.linspace(0.1, 1.0, 50), 3.0, 0.5]
    swept = sweep(sheet.path, ["result"], {"F": F})
    assert swept.at_once and np.flatnonzero(np.isnan(swept["result"])).tolist() == [50] and swept.reasons[50]
    sheet = own(tmp_path, "y = (1 / 10.0 ** (x * 200)).sum(-1)\nresult = y * 1.0  # [-] line")
    assert sweep(sheet.path, ["result"], {"F": F}).solved.all()


def test_what_holds_of_one_number_says_nothing_of_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After a sweep with one value that can be used, all variants of the next one had the greatest of them all."""
    monkeypatch.setattr("mechsheet.studies.sweep.mixes", lambda *_: False)  # as of what it cannot follow
    sheet = own(tmp_path, "result = np.max(g.F * np.arange(4))  # [-] line")
    assert sweep(sheet.path, ["result"], {"F": [1.0, np.nan]})["result"][0] == 3.0
    assert sweep(sheet.path, ["result"], {"F": [1.0, 2.0]})["result"].tolist() == [3.0, 6.0]


@pytest.mark.parametrize("k", [3, [3, 3]])
def test_what_holds_of_one_way_says_nothing_of_another(k: object, tmp_path: Path) -> None:
    """The next sweep went the way on which all variants have the greatest of them all, once another one had not."""
    sheet = own(tmp_path, "y = g.F * 2 if g.k == 2 else np.max(g.F * np.arange(4))\nresult = y * 1.0  # [-] line")
    assert sweep(sheet.path, ["result"], {"F": [1.0, 2.0]})["result"].tolist() == [2.0, 4.0]
    assert sweep(sheet.path, ["result"], {"F": [1.0, 2.0], "k": k})["result"].tolist() == [3.0, 6.0]


def test_variants_of_which_none_is_solved_alone_have_no_number_among_others(tmp_path: Path) -> None:
    """Two of them were a matrix, the product with which a Find had a solution for."""
    given = "np.array([1.0, 0.5]) @ (np.array([0.5, 2.0]) ** g.F) - 1.0"
    sheet = own(
        tmp_path, f"y = find(lambda v: np.sin(v) - ({given}), 0, 6, guess=1.0).value\nresult = y * 1.0  # [-] line"
    )
    swept = sweep(sheet.path, ["result"], {"F": np.linspace(2.0, 4.0, 34)})
    assert np.isnan(swept["result"]).all() and all("is outside" in reason for reason in swept.reasons)


@pytest.mark.parametrize(
    "lines",
    [
        "y = np.max(g.F * np.arange(1.0, 5.0), axis=-1)",
        "kappa = max(np.max(x), 1.0)\ny = g.F**2",  # of which nothing wanted is made
        "y = np.array([g.F, g.a * g.F]).max(0)",
        "y = np.where(x > 1, g.a, x).sum(axis=-1)",
        "y = find(lambda v: v**2, 0, 5, equals=g.F).value",
    ],
)
def test_what_keeps_variants_apart_goes_at_once(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = y * 1.0  # [-] line")
    F = np.linspace(1.0, 3.0, 30)
    swept = sweep(sheet.path, ["result"], {"F": F})
    alone = [sheet.run(["result"], {"g": sheet.inputs(F=x)})["result"] for x in F]
    assert swept.at_once and np.ravel(swept["result"]) == pytest.approx(np.ravel(alone), rel=1e-12)


def test_a_number_that_a_find_has_no_root_for_is_that_of_its_variant(tmp_path: Path) -> None:
    """Of a target without an axis of positions all variants lacked it, with the reason of the first one that does."""
    lines = "f = find(lambda v: v**2, 0, 3, equals=np.max(x, axis=-1))\nresult = f.value * 1.0  # [-] line"
    sheet = own(tmp_path, lines)
    F = np.linspace(1.0, 6.0, 30)
    swept = sweep(sheet.path, ["result"], {"F": F})
    assert swept.at_once and swept.solved.tolist() == (2 * F <= 9).tolist()
    assert swept.reasons[-1].endswith("12 is outside") and swept["result"][0] == pytest.approx(np.sqrt(2), rel=1e-12)
