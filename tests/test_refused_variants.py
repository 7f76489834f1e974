"""What a line of a worksheet raises for some numbers is the reason of these variants, and none for the others."""

from pathlib import Path

import numpy as np
import pytest
from own_worksheet import own, recorded, value_of

from mechsheet import SheetError, evaluate, sweep
from mechsheet.worksheet import mistakes

NONE = "next has found nothing for which its condition holds"
EMPTY, DOMAIN, LARGE = "is empty: min takes", " has no value for ", "is beyond the largest number, 1.8e308"
LINES = {  # that have no number for F = 4
    "y = next(v for v in (6.0, 8.0, 10.0) if v >= 3 * g.F)": NONE,
    "y = [next(v for v in (6.0, 8.0, 10.0) if v >= 3 * F) for F in (g.F, 1.0)][0]": NONE,
    "y = sum(next(v for v in (6.0, 8.0, 10.0) if v >= 3 * F) for F in (g.F, 1.0))": NONE,
    "y = [6.0, 8.0, 10.0, 12.0][int(g.F)]": "has 4 values, counted from 0: there is none at int(g.F) = 4",
    "y = {1: 2.0, 2: 3.0, 3: 4.0}[int(g.F)]": "has no 4 (int(g.F)): it has 1, 2, 3",
    "y = math.pow(g.F - 4.0, -1)": DOMAIN,
    "y = math.exp(200 * g.F)": LARGE,
    "y = min(5.0, math.cosh(200 * g.F))": LARGE,
    "assert g.F < 4\ny = g.F": "it does not hold: number F = 4",
    "from scipy.optimize import newton\ny = newton(lambda v: v**2 + g.F - 3.1, 1.0)": "Failed to converge",
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", LINES)
def test_an_error_of_some_numbers_is_the_reason_of_their_variant(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = y * 1.0  # [-] line")
    at = np.array([1.0, 2.5, 3.0, 4.0])
    for given in (at, np.concatenate([np.linspace(1.0, 3.0, 90), [4.0]])):
        swept = sweep(sheet.path, ["result"], {"F": given})
        assert swept.solved[:-1].all() and np.isnan(swept["result"][-1])
        assert LINES[lines] in swept.reasons[-1]
        for k in (0, 1):
            assert swept["result"][k] == pytest.approx(
                evaluate(sheet.path, ["result"], F=given[k])["result"], rel=1e-12
            )


@pytest.mark.parametrize(
    "y", ["1 / (g.F - 4)", "1 / (2 + 1 / (g.F - 4))", "sum(1 / (1 + 1 / (z - g.F)) for z in (4, 5.5))"]
)
def test_what_python_refuses_of_a_number_alone_is_not_infinite_among_others(y: str, tmp_path: Path) -> None:
    """Wherever it stands: one over infinity was 0 there, without a word."""
    sheet = own(tmp_path, f"y = {y}\nresult = y * 1.0  # [-] line")
    for n, k in ((4, 0), (300, 133), (5000, 4321)):
        F = np.linspace(1, 3, n)
        F[k] = 4
        swept = sweep(sheet.path, ["result"], {"F": F})
        assert swept.at_once and list(np.flatnonzero(~swept.solved)) == [k]
        assert "division by zero" in swept.reasons[k]


def test_a_field_that_no_variant_has_is_still_one(tmp_path: Path) -> None:
    """Who takes the least along its positions had one number for all variants."""
    sheet = own(tmp_path, "q = 1 / (0 * g.F)\nfield = x * q  # [-] field\nresult = q * 1  # [-] number")
    swept = sweep(sheet.path, ["field", "result"], {"F": [1.0, 2.0, 4.0]})
    assert not swept.solved.any() and all("division by zero" in reason for reason in swept.reasons)
    assert swept["field"].shape == (3, 5) and swept["result"].shape == (3,)


@pytest.mark.filterwarnings("ignore")
def test_what_numpy_makes_infinite_is_so_among_others_too(tmp_path: Path) -> None:
    """In elements of arrays, which Python does not refuse."""
    sheet = own(tmp_path, "result = 1 / (1 + 1 / (np.array([4.0]) - g.F)).sum()  # [-] line")
    F = np.linspace(1, 3, 300)
    F[[133, 250]] = 4
    swept = sweep(sheet.path, ["result"], {"F": F})
    assert swept.solved.all() and swept["result"][133] == 0 == evaluate(sheet.path, ["result"], F=4.0)["result"]


UNSEEN = {  # that Python has no number for where F = 9, of which only a condition or an unused place takes one
    "y = g.a if min(z for z in (1.0, 8.0) if z > g.F) > 2 else 3.0": EMPTY,
    "y = g.a if next(z for z in (1.0, 8.0) if z > g.F) > 2 else 3.0": NONE,
    "y = g.a if np.array([1.0, 2.0, 4.0, 8.0])[int(g.F)] > 3 else 3.0": "none at int(g.F) = 9",
    "y = np.array([g.a, 3.0])\ny[y > 5] = min(z for z in (1.0, 8.0) if z > g.F)\ny = y.sum()": EMPTY,
    "y = [g.a, next(z for z in (1.0, 8.0) if z > g.F)][0]": NONE,
    "y = max((0.5, 2.0), key=lambda q: abs(q - min(z for z in (1.0, 8.0) if z > g.F)))": EMPTY,
    "def h(v):\n    w = math.log(9.0 - v)\n    return v\ny = h(g.F)": DOMAIN,
    "k = 1 / (g.F - 9.0)\nk = math.sqrt(g.F)\ny = k": "division by zero",
    "y = g.a if math.exp(80 * g.F) > 3.0 else 2.0": LARGE,
    "y = g.a\nfor z in (0.5, 1.0):\n    if z > math.fmod(1.0, g.F - 9.0):\n        y = y + z": DOMAIN,
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", UNSEEN)
def test_what_python_refuses_has_no_number_when_asked_for_again(lines: str, tmp_path: Path) -> None:
    """By the recording of other inputs, which has none: a comparison with it went a way that Python does not go."""
    sheet = own(tmp_path, f"{lines}\nresult = y * 1.0  # [-] line")
    for F in (1.0, 1.2, 1.4):
        evaluate(sheet.path, ["result"], F=F)
    with pytest.raises((ValueError, LookupError, ArithmeticError)):
        evaluate(sheet.path, ["result"], F=9.0)
    F = np.append(np.linspace(0.5, 3.5, 210), 9.0)
    swept = sweep(sheet.path, ["result"], {"F": F})
    assert UNSEEN[lines] in swept.reasons[-1] and np.isnan(swept["result"][-1]) and swept.solved[:-1].all()
    assert swept["result"][100] == sheet.run(["result"], {"g": sheet.inputs(F=F[100])})["result"]


def test_a_mistake_whatever_the_numbers_are_ends_the_sweep(tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = g.F + nothing\nresult = y * 1.0  # [-] line")
    with pytest.raises(NameError, match="nothing"):
        sweep(sheet.path, ["result"], {"F": [1.0, 2.0]})


def test_who_asks_in_a_loop_is_not_ended_by_what_a_line_has_not_found(tmp_path: Path) -> None:
    """StopIteration would end it without a word."""
    sheet = own(tmp_path, "d = next(v for v in (6.0, 8.0) if v >= 3 * g.F)\nresult = d * 1.0  # [-] line")
    with pytest.raises(SheetError, match=r"own.py, line 37, d = next.*has found nothing"):
        [*(evaluate(sheet.path, ["result"], F=F) for F in (1.0, 4.0))]


def test_an_error_in_a_generator_is_told_as_outside_of_one() -> None:
    def found() -> object:
        yield next(iter(()))

    with pytest.raises(RuntimeError) as raised:
        [*found()]  # type: ignore[call-overload]
    assert mistakes.told(raised.value, "own.py") == f"StopIteration ({NONE})"


def test_a_result_that_only_some_ways_bind_has_a_reason_where_others_went(tmp_path: Path) -> None:
    own(tmp_path, "if g.F > 2:\n    x_m = g.F * 2")
    swept = sweep(tmp_path / "own.py", ["x_m"], {"F": [1.0, 2.5, 3.0]})
    np.testing.assert_array_equal(swept["x_m"], [np.nan, 5.0, 6.0])
    assert [*swept.reasons] == ["x_m has no value: none of the ways that its cell went gives it one", "", ""]
    with pytest.raises(SheetError, match="x_m has no value: none of the ways"):
        evaluate(tmp_path / "own.py", ["x_m"], F=1.0)


def test_a_function_that_ends_without_a_return_is_recorded_for_the_inputs_that_it_returns_for(tmp_path: Path) -> None:
    """The export raised an error of Python's: its other way has no line. Of what is None there is no number."""
    sheet = own(tmp_path, "def h(v):\n    if v > 2:\n        return 2 * v\ny = h(g.F) + 1  # [-] y")
    recording = recorded(sheet)[1]
    assert [value_of(recording, "y", {"F": F}) for F in (2.5, 3.0)] == [6, 7]
    assert np.isnan(value_of(recording, "y", {"F": 1.0}))
