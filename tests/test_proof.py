"""Proved digits: balls that enclose, found values that exist, and never more digits claimed than there are."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb
from own_worksheet import own
from run_once import DOCUMENTS, WORKSHEETS, recorded

from mechsheet.accuracy import exact, extreme
from mechsheet.accuracy.arithmetic import mp, mpc, mpf
from mechsheet.document import parts
from mechsheet.quantities.operations import ELEMENTWISE
from mechsheet.readers.ball_rules import MADE, NONE, SINGLE, UNDECIDED
from mechsheet.readers.balls import krawczyk
from mechsheet.readers.proof import Proof, _within
from mechsheet.recording.record import record
from mechsheet.run import batch
from mechsheet.run.proving import proof_of, proof_of_wanted
from mechsheet.units import parse
from mechsheet.worksheet import inputs, scene
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.table import Table, heading

# --- rules -------------------------------------------------------------------------------------------------------


def test_every_operation_has_a_rule() -> None:
    """But those that rest on nothing, what is found, which has a pass of its own, and what is not followed."""
    assert set(ELEMENTWISE) == set(SINGLE) and set(MADE) == {"take", "at", "join", "reduce"}


REAL = {
    "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
    "neg": lambda a: -a, "abs": abs, "sqrt": mp.sqrt, "exp": mp.exp, "log": mp.log, "sin": mp.sin, "cos": mp.cos,
    "tan": mp.tan, "asin": mp.asin, "acos": mp.acos, "atan2": mp.atan2, "sign": mp.sign, "floor": mp.floor,
    "round": mp.nint, "mod": lambda a, b: a - b * mp.floor(a / b), "max": max, "min": min,
}  # fmt: skip


@pytest.mark.parametrize("op", sorted(REAL))
@mp.workdps(40)
def test_a_ball_holds_the_number_of_every_point(op: str) -> None:
    rng = np.random.default_rng(7)
    count = 2 if op in ("add", "sub", "mul", "div", "atan2", "mod", "max", "min") else 1
    held = 0
    for _ in range(120):
        middle, radius = rng.uniform(-3, 3, count) * rng.choice([1, 0.2], count), 10.0 ** rng.uniform(-3, 0, count)
        balls = [arb(m, r) for m, r in zip(middle, radius, strict=True)]
        found = SINGLE[op](*balls)
        known = found is not NONE and found.is_finite()
        low, high = (mpf(str(end.str(40, radius=False))) for end in (found.lower(), found.upper())) if known else (0, 0)
        for _ in range(5):
            point = [
                mpf(m) + mpf(r) * mpf(t) for m, r, t in zip(middle, radius, rng.uniform(-1, 1, count), strict=True)
            ]
            if op in ("div", "mod") and not point[1]:
                continue
            true = REAL[op](*point)
            if found is NONE:
                assert isinstance(true, mpc) or (op == "log" and point[0] < 0)
            elif known and not isinstance(true, mpc):
                held += 1
                assert low - abs(low) * mpf("1e-15") <= true <= high + abs(high) * mpf("1e-15"), (op, point)
    assert held > 100


@pytest.mark.parametrize(
    ("op", "balls", "result"),
    [
        ("lt", [arb(1), arb(2, 0.5)], 1.0),
        ("lt", [arb(1, 0.5), arb(1)], UNDECIDED),
        ("ge", [arb(1, 0.5), arb(2)], 0.0),
        ("eq", [arb(1), arb(1)], 1.0),
        ("eq", [arb(1, 1e-30), arb(1)], UNDECIDED),
        ("eq", [arb(1, 1e-30), arb(2)], 0.0),
        ("eq", [NONE, arb(2)], 0.0),
        ("ne", [NONE, arb(2)], 1.0),
        ("and", [0.0, UNDECIDED], 0.0),
        ("and", [1.0, UNDECIDED], UNDECIDED),
        ("or", [1.0, UNDECIDED], 1.0),
        ("not", [UNDECIDED], UNDECIDED),
        ("finite", [NONE], 0.0),
        ("finite", [arb.nan()], UNDECIDED),
        ("sqrt", [arb(-2, 1)], NONE),
        ("acos", [arb(3, 1)], NONE),
        ("div", [arb(0), arb(0)], NONE),
        ("where", [0.0, arb(1), NONE], NONE),
        ("max", [NONE, arb(1)], NONE),
        ("min", [arb(1), NONE], NONE),
    ],
)
def test_what_is_decided_and_what_is_not(op: str, balls: list[Any], result: Any) -> None:
    assert SINGLE[op](*balls) is result or SINGLE[op](*balls) == result


@pytest.mark.parametrize(
    ("op", "balls"),
    [
        ("sqrt", [arb(0, 1)]),
        ("div", [arb(1), arb(0, 1)]),
        ("div", [arb(1), arb(0)]),
        ("where", [UNDECIDED, arb(1), NONE]),
        ("pow", [arb(0, 1), arb(0.5)]),
        ("asin", [arb(1, 0.1)]),
    ],
)
def test_what_nobody_knows_is_a_ball_that_says_nothing(op: str, balls: list[Any]) -> None:
    assert not SINGLE[op](*balls).is_finite()


def test_powers_of_balls_about_zero() -> None:
    square, cube = SINGLE["pow"](arb(0.5, 1), arb(2)), SINGLE["pow"](arb(0.5, 1), arb(3))
    assert square.contains(0) and square.contains(2.25) and not square.contains(-0.1)
    assert cube.contains(-0.125) and cube.contains(3.375)
    assert SINGLE["pow"](NONE, arb(0)) == 1


# --- found values ------------------------------------------------------------------------------------------------


def enclosed(residual: Any, slope: Any, at: float, width: float) -> Any:
    from flint import arb_mat

    box = arb(at, width)
    return krawczyk([arb(at)], [box], [residual(arb(at))], arb_mat(1, 1, [slope(box)]))


def test_a_box_holds_a_root_only_where_there_is_one() -> None:
    f, slope = (lambda x: x * x - 2), (lambda x: 2 * x)
    found = enclosed(f, slope, 1.4142135, 1e-6)
    assert found is not None and found[0].contains(arb(2).sqrt())
    assert enclosed(f, slope, 1.41, 1e-6) is None, "the root is outside"
    assert enclosed(f, slope, 0.5, 2.0) is None, "the slope may be 0"
    assert enclosed(lambda x: x * x, slope, 0.0, 1e-6) is None, "a double root is not proved"
    assert enclosed(lambda x: x * x + 1e-12, slope, 0.0, 1e-3) is None, "there is none"


def sheet_of(tmp_path: Path, lines: str, **given: Any) -> Proof:
    sheet = own(tmp_path, lines)
    names = sheet.run(sheet.results, {"g": sheet.inputs(**given)})
    return proof_of(
        {**names, "__file__": sheet.path},
        sheet,
        record({**names, "__file__": sheet.path}, sheet, whole=True, exact=True),
    )


def test_a_condition_that_is_not_decided_is_not_0() -> None:
    """It ended the proof of a whole worksheet, and its export, in an error: its ball is a plain number."""
    assert not _within(np.array([0.0, UNDECIDED], object), 1e-3)
    assert _within(np.array([0.0, 0.0], object), 1e-3)


def test_roots_are_proved_alone_or_others_told(tmp_path: Path) -> None:
    lines = """
u_found = find(lambda x: x**3 - g.F, 0.0, 3.0, unknown="cube root u")
u = u_found.value  # [-] root
v_found = find(lambda x: cos(3 * x) - 0.1, 0.0, 1.0, unknown="first v")
v = v_found.value  # [-] root
w_found = find(lambda x: cos(3 * x) - 0.1, 0.0, 3.0, guess=0.4, unknown="one of several w")
w = w_found.value  # [-] root
d_found = find(lambda x: (x - g.a) ** 2, 0.0, 3.0, unknown="double root d")
d = d_found.value  # [-] root
s_found = find(lambda p, q: (p**2 + q**2 - 4, q - p**2 + 1), p=(0, 2), q=(0, 2))
p, q = s_found.value  # [-] one, [-] other"""
    proof = sheet_of(tmp_path, lines.strip())
    told = {root.name: root for root in proof.roots}
    assert "the only root of its equation in 0..3" in str(told["cube root u"])
    assert told["first v"].others == ()
    (other, *rest) = told["one of several w"].others or ()
    assert not rest or len(rest) == 1
    assert any(part.low <= (2 * np.pi - np.arccos(0.1)) / 3 <= part.high for part in (other, *rest))
    assert not told["double root d"].exists and "not proved" in str(told["double root d"])
    assert told["s_found.p"].exists and "others are not looked for" in str(told["s_found.q"])
    check = proof.check()
    assert not check.passed and "no root is proved there" in check.reason and "line " in check.reason


def test_a_root_that_is_0_is_proved(tmp_path: Path) -> None:
    """Its box had no width, and the slope of a square beside 0 was nothing: no root was proved there."""
    lines = """
t_found = find(lambda t: t**3 + t, -1, 10, equals=g.F)
t = t_found.value  # [-] root
xy = find(lambda x, y: (x**2 + y**2 - 4, y - g.F * x), x=(0.1, 3), y=(-1, 1))
p, q = xy.value  # [-] one, [-] other
s = t + g.a  # [-] sum"""
    proof = sheet_of(tmp_path, lines.strip(), F=0.0)
    assert all(root.exists for root in proof.roots) and len(proof.roots) == 3
    assert {column.name: column.least for column in proof.columns if column.name in "tpqs"} == dict.fromkeys("tpqs", 16)


def test_a_root_of_what_a_loop_computes_is_proved(tmp_path: Path) -> None:
    """Of a loop over as many turns as an input says no slope was known: no root was proved there."""
    lines = """
def f(t):
    s = 0.0
    for k in range(1, g.n):
        s = s + sin(k * t) / k
    return s
t_found = find(f, 0.5, 3, equals=g.a)
t = t_found.value  # [-] root"""
    proof = sheet_of(tmp_path, lines.strip())
    (root,), (column,) = proof.roots, (column for column in proof.columns if column.name == "t")
    exactly = mp.findroot(lambda t: sum(mp.sin(k * t) / k for k in range(1, 5)) - mpf(0.75), mpf(column.size))
    off = abs(mpf(column.size) - exactly)
    assert root.exists and column.least > 14 and (not off or column.least <= -mp.log10(off / exactly) + 1e-6)


def test_the_greatest_of_numbers_of_which_one_does_not_exist_is_proved_to_be_none(tmp_path: Path) -> None:
    lines = """
m = np.max(np.arccos(x - g.a))  # [-] greatest
n = np.nanmax(np.arccos(x + g.F))  # [-] of none
k = np.where(m > 1, 2.0, 3.0) * g.F  # [-] a choice by it"""
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):  # numpy's, of none but NaN
        told = {column.name: column for column in sheet_of(tmp_path, lines.strip()).columns}
    assert [told[name].least for name in "mnk"] == [16, 16, 16] and told["m"].none == told["n"].none == 1


def test_a_table_without_rows_has_nothing_to_prove(tmp_path: Path) -> None:
    """The proof had ended in an error of numpy's."""
    lines = """
far = np.sqrt(x)[x > 100 * g.F]  # [-] of those that are far
y = np.sqrt(g.a)  # [-] beside them
table_2 = table("2", "Far", far)"""
    proof = sheet_of(tmp_path, lines.strip())
    assert {column.where for column in proof.columns} == {"results", "table 1"} and proof.check().passed


def test_numbers_in_the_order_of_their_size_are_proved(tmp_path: Path) -> None:
    """None of them is less than itself, though its ball does not tell: no order had been proved."""
    lines = """
U = np.sqrt(np.array([g.F, 7.0, g.a, 3.0]))  # [-] numbers
s = U[np.argsort(-U)]  # [-] the largest first
m = np.sqrt(x)[np.argsort(np.sin(9 * x))]  # [-] by another one
t = np.sort(U)  # [-] the least first
table_2, table_3 = table("2", "Few", s, t), table("3", "Many", m)"""
    proof = sheet_of(tmp_path, lines.strip())
    assert all(column.least > 14 for column in proof.columns), [str(column) for column in proof.columns]


POWERS = {  # equations of which powers are made, and their roots
    "x ** 0.2 - g.F": lambda F: F**5,
    "x ** (1 / 3) - g.F": lambda F: F**3,
    "2 ** x - 100 * g.F": lambda F: mp.log(100 * F, 2),
    "x ** x - g.F": lambda F: mp.exp(mp.lambertw(mp.log(F))),
    "np.where(x > 2, (x - 2) ** 1.5, x - 2) + g.F / 3": lambda F: 2 - F / 3,
}


@pytest.mark.parametrize("text", POWERS)
def test_a_root_of_powers_is_proved(text: str, tmp_path: Path) -> None:
    """A fifth is no exact number, and an unknown exponent moves: neither had a slope.

    The power of what is negative beyond a kink ended the proof in an error.
    """
    proof = sheet_of(tmp_path, f"x_found = find(lambda x: {text}, 0.5, 150)\nt = x_found.value  # [-] root")
    (root,), (column,) = proof.roots, (column for column in proof.columns if column.name == "t")
    exactly = POWERS[text](mpf(2.5))
    off = abs(mpf(column.size) - exactly) / exactly
    assert root.exists and column.least > 14 and (not off or column.least <= -mp.log10(off) + 1e-6)


def test_where_some_positions_have_no_root_the_others_are_proved(tmp_path: Path) -> None:
    """That there is none where none is found is not proved but named: it kept the whole column from its digits."""
    lines = """
y_found = find(lambda y: y * y - 1.5 + x, 0.1, 5)
z = 2 * y_found.value  # [-] root
table_2 = table("2", "Two", z)"""
    proof = sheet_of(tmp_path, lines.strip())
    (column,) = (column for column in proof.columns if column.name == "z")
    assert column.digits[:2].min() > 14 and np.isnan(column.digits[2:]).all() and column.none == 3
    assert "no root is proved there: 3 of 5 have no number" in column.why and column.least > 14
    assert proof.check(9).passed and "3 of 10 do not exist" in proof.check(9).reason


def test_a_root_of_the_largest_or_least_of_several_is_proved(tmp_path: Path) -> None:
    lines = """
s = linspace(0.4, 1.3, 9)  # [-] positions
u_found = find(lambda x: np.max(np.sin(s * x)) - 0.5 * x, 0.2, 1.2, equals=0.3, unknown="largest u")
u = u_found.value  # [-] root
v_found = find(lambda x: np.min(np.cos(s * x)), 0.2, 1.2, equals=0.7, unknown="least v")
v = v_found.value  # [-] root
w_found = find(lambda x: np.max(np.abs(s - x)), 0.5, 0.86, equals=0.45, unknown="corner w")
w = w_found.value  # [-] root"""
    told = {root.name: root for root in sheet_of(tmp_path, lines.strip()).roots}
    assert told["largest u"].exists and told["least v"].exists
    assert not told["corner w"].exists, "at 0.85 the largest falls on one side and grows on the other"


# --- never more digits than there are ----------------------------------------------------------------------------


def proved(stem: str, given: Mapping[str, Any]) -> tuple[Any, dict[str, Any], Proof]:
    sheet = load(WORKSHEETS / f"{stem}.py")
    g = inputs.build(sheet.inputs, given)
    names = sheet.run(sheet.results, {"g": g})
    return g, names, proof_of(names, sheet, record(names, sheet, exact=True))


@cache
def document(stem: str) -> tuple[Any, dict[str, Any], Proof]:
    sheet, names, _ = recorded(stem)
    return names["g"], names, proof_of(names, sheet, record(names, sheet, exact=True))


def compared(
    names: Mapping[str, Any], proof: Proof, truths: Mapping[int, Mapping[str, Any]]
) -> Iterator[tuple[str, float, float]]:
    """Digits claimed and the error that there is, of all numbers of tables whose exact ones are known by row."""
    claims = iter(column for column in proof.columns if column.where != "results")
    for table in (value for value in parts.values(names) if isinstance(value, Table)):
        for column in (c for c in table.columns if c.values.dtype.kind in "biuf"):
            claimed, factor = next(claims), mpf(repr(parse(column.unit).factor))
            assert (claimed.where, claimed.name) == (f"table {table.number}", column.symbol)
            size = float(np.max(np.abs(column.values)))
            for row, true in truths.items():
                if column.symbol in true and claimed.digits.size > row and size:
                    off = abs(mpf(float(column.values[row])) - true[column.symbol] / factor) / size
                    yield f"{claimed} row {row}", float(claimed.digits[row]), float(off)


def headed(results: Mapping[str, Any]) -> dict[str, Any]:
    """Exact results by the headings of their columns; angles may be shown in another turn, and are left out."""
    found = dict[str, Any]()
    for name, y in results.items():
        if not name.startswith(("phi", "psi")) and not isinstance(y, list):
            if hasattr(y, "imag") and type(y).__name__ == "mpc":
                found |= {heading(name, "real"): y.real, heading(name, "imag"): y.imag}
            else:
                found[heading(name)] = y
    return found


def assert_honest(pairs: list[tuple[str, float, float]], least: int) -> None:
    assert len(pairs) >= least
    more = [pair for pair in pairs if pair[2] > 10.0 ** -pair[1] * (1 + 1e-6)]
    fewer = [pair for pair in pairs if 10.0 ** -pair[1] > 100 * max(pair[2], 1e-16) and "differ" not in pair[0]]
    assert not more and len(fewer) <= 0.05 * len(pairs), (more[:3], fewer[:3])


# Those in which others, or the document itself, lose the same digits for the same reason.
ALIKE = {
    "away_1e9", "cylinder_upright", "dead_centre_folded", "loads", "lower_link_level", "mast_in_line", "mast_upright",
    "millimetres", "rod_in_line",
}  # fmt: skip
HITCH = [s for s in extreme.scenes() if s.job == "hitch" and not s.says and s.name not in ALIKE]


@pytest.mark.parametrize("of", [None, *HITCH], ids=lambda s: s.name if s else "document")
def test_no_more_digits_than_the_exact_chain_has_of_the_hitch(of: extreme.Scene | None) -> None:
    g, names, proof = proved("hitch", of.cases()[len(of.values) // 2]) if of else document("hitch")
    lengths = exact.finds(g)
    S_min, S_max = mpf(float(g.S_min)), mpf(float(g.S_max))
    rows = [0, 4, g.N_pol - 1] if of is None else [of.at % g.N_pol]
    truths = {k: headed(exact.hitch(g, S_min + (S_max - S_min) * k / (g.N_pol - 1), **lengths)) for k in rows}
    assert_honest(list(compared(names, proof, truths)), 20 * len(rows))


LOSING = {
    "arccosine near 0": ("np.arccos(1 - g.a * 1e-10)", lambda F, a: mp.acos(1 - a * mpf(1e-10))),
    "difference of far points": ("(1e9 + g.a) - (1e9 + g.F / 7)", lambda F, a: a - F / 7),
    "removable singularity": ("(1 - cos(g.a * 1e-4)) / (g.a * 1e-4) ** 2", None),
    "kept": ("2 * np.arcsin(np.sqrt(g.a * 1e-10 / 2))", lambda F, a: 2 * mp.asin(mp.sqrt(a * mpf(1e-10) / 2))),
}


@pytest.mark.parametrize("name", LOSING)
def test_a_formula_that_loses_digits_is_seen_with_those_that_it_loses(name: str, tmp_path: Path) -> None:
    text, true = LOSING[name]
    sheet = own(tmp_path, f"y = {text}  # [-] losing")
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    names = {**names, "__file__": sheet.path}
    proof = proof_of(names, sheet, record(names, sheet, whole=True, exact=True))
    (claimed,) = (c for c in proof.columns if c.name == "y")
    F, a = mpf(2.5), mpf(0.75)
    x = a * mpf(1e-4)
    exactly = true(F, a) if true else (1 - mp.cos(x)) / x**2
    there = min(16.0, float(-mp.log10(abs(mpf(float(names["y"])) - exactly) / abs(exactly))))
    assert there - 0.2 < claimed.least <= there + 1e-6
    assert (claimed.least > 14) == (name == "kept") and proof.check(14).passed == (name == "kept")
    if name != "kept":
        assert f"line {line_of(sheet.path, 'y = ')}" in str(claimed) or claimed.least >= 9


COMPUTED = {  # numbers that Python rounds before a quantity meets them
    "30 / np.pi * g.a": lambda a: 30 / mp.pi * a,
    "g.a * (1 / 3)": lambda a: a / 3,
    "g.a - 2.25 / 3": lambda a: a - mpf(9) / 12,
    "(g.a + 1 / 3) - (1 / 3 + 0.7499999)": lambda a: a - mpf("0.7499999"),
    "g.a * np.sqrt(2) - 1.06": lambda a: a * mp.sqrt(2) - mpf("1.06"),
    "np.cos(g.a * (4.18879 / 2) + 2 / 7)": lambda a: mp.cos(a * mpf("2.094395") + mpf(2) / 7),
    "g.a * (1 - 0.9999999)": lambda a: a * mpf("1e-7"),
    "g.a * -(1e-9 + np.cos(np.pi / 2))": lambda a: -a * mpf("1e-9"),
    "g.a * (math.sqrt(2) ** 2 - 2 + 1e-8)": lambda a: a * mpf("1e-8"),
    "g.a * np.tan(np.radians(89.99))": lambda a: a * mp.tan(mp.pi * mpf("89.99") / 180),
    "g.a * np.diff(np.array([0.1, 0.11]))[0]": lambda a: a * mpf("0.01"),
    "g.a * (0.1 + 0.2 - 0.3 + 1e-12)": lambda a: a * mpf("1e-12"),
    "g.a * (math.sqrt(1 + abs(-1e-3) ** 2) - 1)": lambda a: a * (mp.sqrt(1 + mpf("1e-6")) - 1),
    "g.a * (max(0.7, 0.1 * 7) - 0.7 + 1e-9)": lambda a: a * mpf("1e-9"),
    "g.a * (7.25 % 0.7 - 0.2499)": lambda a: a * mpf("1e-4"),
    "g.a * (np.exp(0.3j).imag - 0.2955)": lambda a: a * (mp.sin(mpf("0.3")) - mpf("0.2955")),
    "g.a * (np.exp(1j * 0.3) * (0.1 + 0.2j)).real": lambda a: a * (mp.cos(mpf("0.3")) / 10 - mp.sin(mpf("0.3")) / 5),
}


@pytest.mark.parametrize("text", COMPUTED)
def test_a_number_that_python_has_computed_is_off_by_its_rounding(text: str, tmp_path: Path) -> None:
    """It had been taken for the number that is meant: 16 digits were claimed of what has fewer."""
    sheet = own(tmp_path, f"y = {text}  # [-] rounded before")
    for a in np.random.default_rng(0).uniform(0.5, 1.0, 20):
        names = {**sheet.run(sheet.results, {"g": sheet.inputs(a=a)}), "__file__": sheet.path}
        (claimed,) = (
            c for c in proof_of(names, sheet, record(names, sheet, whole=True, exact=True)).columns if c.name == "y"
        )
        own_number = mpf(float(names["y"]))
        off = abs(own_number - COMPUTED[text](mpf(a)))
        assert not off or claimed.least <= -mp.log10(off / abs(own_number)) + 1e-6, a


ALONE = {  # what computes numbers of numbers alone, in the setup or in the cell, and what is exact
    "a function": ("def f(p):\n    return 1 - cos(p)", "g.F * f(1e-9)", lambda F: F * (1 - mp.cos(mpf("1e-9")))),
    "a default": ("def f(p, q=0.3 // 0.1):\n    return p * q", "f(g.F)", lambda F: 3 * F),
    "a function that reads another number": (
        "c = 1 - 0.9999999\n\ndef f(p):\n    return p * c",
        "f(0.1) * g.F",
        lambda F: F * mpf("1e-8"),
    ),
    "a loop": (
        "def f(p):\n    s = 0.0\n    for k in range(10):\n        s += p\n    return s - 1",
        "g.F * (f(0.1) + 1e-12)",
        lambda F: F * mpf("1e-12"),
    ),
    "a lambda": ("f = lambda p: p // 0.1", "g.F * f(0.3)", lambda F: 3 * F),
    "a method": (
        "class Part:\n    def of(self, p):\n        return (p + 0.2 - 0.3) * 1e12 + 1",
        "Part().of(0.1) * g.F",
        lambda F: F,
    ),
    "a function in another one": (
        "def f(p):\n    def inner(q=p * 0.2):\n        return q - 0.02\n    return inner()",
        "(f(0.1) + 1e-16) * g.F",
        lambda F: F * mpf("1e-16"),
    ),
    "a function that keeps a number": (
        "def made(c):\n    return lambda p: p - c // 0.1\n\nf = made(0.3)",
        "f(g.F)",
        lambda F: F - 3,
    ),
    "an array": ("c = np.array([0.1, 0.2, -0.3])", "(c.sum() + 1e-15) * g.F", lambda F: F * mpf("1e-15")),
    "a function that is handed on": (
        "import functools\nimport operator",
        "functools.reduce(operator.add, [0.1, 0.2, -0.3, 1e-15]) * g.F",
        lambda F: F * mpf("1e-15"),
    ),
    "a way that is taken by rounding": (
        "def f(p):\n    return 1.0 if p > 0.3 else 2.0",
        "f(0.1 + 0.2) * g.F",
        lambda F: 2 * F,
    ),
    "an element of whole numbers": ("", "g.F * (np.arange(5)[3] * 7 // 0.1)", lambda F: 210 * F),
    "a series": (
        "",
        "g.F * (np.sinh(0.029) / 0.029 - 1.00014017)",
        lambda F: F * (mp.sinh(mpf("0.029")) / mpf("0.029") - mpf("1.00014017")),
    ),
    "rounding": ("", "g.F * round(2.675, 2)", lambda F: F * mpf("2.68")),
    "divmod": ("", "g.F * divmod(0.3, 0.1)[0]", lambda F: 3 * F),
}


@pytest.mark.parametrize("name", ALONE)
def test_what_functions_make_of_numbers_alone_is_followed(name: str, tmp_path: Path) -> None:
    """Python's result was taken for exact where rounding had left it few digits: 16 of them were claimed of 2 for 3."""
    before, text, exactly = ALONE[name]
    column, number = shown_of(tmp_path, before, text)
    off = abs(mpf(number) - exactly(mpf(2.5)))
    assert not off or not number or column.least <= max(0.0, -mp.log10(off / abs(number)) + 1e-6), column


def shown_of(tmp_path: Path, before: str, text: str) -> tuple[Any, float]:
    """What is proved of a line behind others that stand in the setup, and its number."""
    sheet = own(tmp_path, f"y = {text}  # [-] number")
    path = Path(sheet.path)
    path.write_text(
        path.read_text().replace(
            "@app.class_def", f"    {before.replace(chr(10), chr(10) + '    ')}\n\n@app.class_def", 1
        )
    )
    sheet = load(path)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    proof = proof_of(names, sheet, record(names, sheet, whole=True, exact=True))
    return next(column for column in proof.columns if column.name == "y"), float(names["y"])


FOLLOWED = {  # of which few digits had been proved, or no more than before
    "a function": ("def f(p):\n    return p * 0.1 + 1 / 3", "f(0.7) * g.F"),
    "nothing but decimals": ("c = 0.25 * 1.1", "g.F * c"),
    "a table of them": ("c = np.array([[0.1, 0.2], [0.3, 0.7]])", "g.F * (c @ c)[1, 0]"),
    "positions": ("", "np.sum(np.sqrt(linspace(0.1, 0.7, 7))) * g.F"),
    "a rounded number": ("", "g.F * round(0.3, 1) * math.floor(7.3)"),
}


@pytest.mark.parametrize("name", FOLLOWED)
def test_what_is_followed_of_numbers_alone_is_proved(name: str, tmp_path: Path) -> None:
    column, _ = shown_of(tmp_path, *FOLLOWED[name])
    assert column.least > 14.5, column


def test_what_is_not_followed_of_numbers_alone_is_told(tmp_path: Path) -> None:
    """It was taken for the number that is meant, or nobody was told which of several had lost the digits."""
    column, _ = shown_of(tmp_path, "", "g.F * math.gamma(0.3)")
    assert column.least == 0 and "what gamma makes of numbers alone is not followed" in column.why


@pytest.mark.parametrize("before", ["c, d = 0.1, 3.0", "c: float = 0.1", "for c in (0.1,):\n    pass"])
def test_a_name_that_is_bound_twice_is_none_of_numbers_alone(before: str, tmp_path: Path) -> None:
    """Its last line alone was known, which names it itself: the proof ended in an error of endless calls."""
    (column,) = sheet_of(tmp_path, f"{before}\nc = c * 3\ny = g.F * c  # [-] number").columns[-1:]
    assert column.name == "y" and column.least > 14


def line_of(path: str, text: str) -> int:
    return 1 + next(n for n, line in enumerate(Path(path).read_text().splitlines()) if text in line)


def test_what_cannot_be_proved_is_told_with_its_line(tmp_path: Path) -> None:
    lines = """
y = float(np.sort_complex([g.F, 2.0])[0].real)  # [-] not recorded
z = np.where(np.sqrt(g.a) ** 2 <= g.a, 1.0, 2.0) * g.F  # [-] decided by rounding
n = np.sqrt(-g.F) * 1  # [-] no number"""
    with np.errstate(all="ignore"):
        proof = sheet_of(tmp_path, lines.strip())
    told = {column.name: column for column in proof.columns}
    path = str(tmp_path / "own.py")
    assert told["y"].least == 0 and f"line {line_of(path, 'y = ')}" in told["y"].why
    undecided = f"line {line_of(path, 'z = ')}: which of two numbers is greater is not decided"
    assert told["z"].least == 0 and undecided in str(told["z"])
    assert told["n"].least == 16, "that it is no number is proved"


def test_what_is_endured_for_ever_is_proved_beside_numbers(tmp_path: Path) -> None:
    """One infinite number of a column had taken the digits of all others, and said that it is not decided."""
    lines = """
N = np.array([np.inf if v < 1 else 2e6 * (g.F / v) ** 5 for v in x])  # [-] endured
D = (1 / N).sum()  # [-] damage
L = -g.F * np.inf  # [-] least of all
c = np.where(np.sqrt(g.a) ** 2 <= g.a, np.inf, 2.0) * g.F  # [-] decided by rounding
table_2 = table("2", "Two", N)"""
    told = {column.name: column for column in sheet_of(tmp_path, lines.strip()).columns}
    assert told["N"].least > 14 and told["D"].least > 14 and told["L"].least == 16
    assert told["c"].least == 0 and "which of two numbers is greater is not decided" in told["c"].why


# --- the documents -----------------------------------------------------------------------------------------------

EXCEPTIONS = {
    "joint": {("table 5.1", "Mx")},  # zero but for the roundings of its angles
    "landing_gear": {("results", "eps3_k")},  # zero
}


@pytest.mark.parametrize("stem", DOCUMENTS)
def test_nine_digits_of_all_tables_are_proved_but_for_listed_exceptions(stem: str) -> None:
    _, names, proof = document(stem)
    assert proof.check(9).passed and not proof.below(9)
    assert {(c.where, c.name) for c in proof.exceptions} == EXCEPTIONS.get(stem, set())
    for column in proof.exceptions:
        assert "line " in column.why and f"exception: {column}" in proof.lines()
        assert column.title in proof.check(9).reason
        assert not np.isnan(column.digits).all()
    assert {c.where for c in proof.columns} >= {
        f"table {v.number}" for v in parts.values(names) if isinstance(v, Table)
    }
    assert all(root.exists for root in proof.roots)
    assert sum(c.digits.size for c in proof.columns) == proof.table().columns[1].values.sum()
    assert "not that the formulas are right" in proof.lines()[-1]


ZEROS = {
    "zero": ("np.cos(g.F * np.pi) * g.a", {}, True),
    "zero by numbers alone": ("g.F * np.cos(np.pi / 2)", {}, True),
    "zero by an element of numbers alone": ("(g.F * np.array([math.sin(math.pi), 1.0]))[0]", {}, True),
    "zero by a name": ("g.F * (one - 0.01)", {}, True),
    "less than an input is held to": ("(1 + np.cos(g.F)) - 1", {"F": np.pi / 2}, True),
    "parts that cancel move nothing": ("(lambda u: u + (-u))(g.F / 3)", {}, True),
    "the size of what cancels": ("abs(np.diff(x)[0] * (g.n - 1) - 1.9 * g.F)", {}, True),
    "the greatest of what cancels": ("np.max(np.abs(x * g.a / 3 - x / (3 / g.a)))", {}, True),
    "lost": ("(1e17 + g.a) - 1e17", {}, False),
    "lost in chaos": ("functools.reduce(lambda v, _: 3.9 * v * (1 - v), range(150), g.a)", {}, False),
    "lost in many turns": ("sin(1e17 * g.F / 3)", {}, False),
    "lost beside what is left out again": ("(1e17 * g.F + g.a) - 1e17 * g.F", {}, False),
    "small": ("1e-30 * g.F / 7", {}, None),
}


@pytest.mark.parametrize("name", ZEROS)
def test_zero_but_for_rounding_is_an_exception_and_what_lost_all_digits_is_none(name: str, tmp_path: Path) -> None:
    text, given, exception = ZEROS[name]
    proof = sheet_of(tmp_path, f"import functools\none = 1 - 0.99\ny = {text}  # [-] number", **given)
    (column,) = (c for c in proof.columns if c.name == "y")
    if exception is None:
        assert column.least > 14 and not column.exception
    else:
        assert column.exception == proof.check().passed == exception, column
        assert f"line {line_of(str(tmp_path / 'own.py'), 'y = ')}: " in column.why
        assert (column.least > 9) == exception


@pytest.mark.parametrize("spec", [".0f", ".1f", ".3e", ".6g"])
def test_a_number_in_a_title_is_another_one_only_where_its_text_is(spec: str, tmp_path: Path) -> None:
    """2 * 0.0025 / 0.001 is 5 in floats alone, and what the title tells of it is the same."""
    sheet = own(
        tmp_path, f"a = g.k * 0.0025 / 0.001\ny = a * x  # [-] line\ntable_2 = table('2', f'At {{a:{spec}}}', y)"
    )
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    proof = proof_of(names, sheet, record(names, sheet, exact=True))
    assert proof.check(12).passed, proof.check(12).reason


def test_a_count_is_an_exception_and_what_is_made_with_it_is_not(tmp_path: Path) -> None:
    lines = """
r = find(lambda p, q: (p**2 + q**2 - 4, q - p**2 + 1), p=(0, 2), q=(0, 2))
n = 1.0 * r.evaluations + 1  # [-] evaluations
v = r.value.p * n  # [-] both"""
    told = {column.name: column for column in sheet_of(tmp_path, lines.strip()).columns}
    assert told["n"].exception and not told["v"].exception and told["v"].least == 0
    assert "a count of evaluations" in told["n"].why and "a count of evaluations" in told["v"].why


# --- scenes and arguments ----------------------------------------------------------------------------------------


def test_a_scene_may_ask_for_digits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "proved.toml"
    path.write_text('want = ["GS6"]\nproof = 12\n')
    assert batch.answer(str(WORKSHEETS / "hitch.py"), scene.load(path)) == 0
    shown = capsys.readouterr().out
    g, names, _ = document("hitch")
    of_field = proof_of_wanted(names, load(WORKSHEETS / "hitch.py"), ["GS6"]).columns
    assert {c.name: c.digits.size for c in of_field}["GS6"] == g.N_pol
    assert "pass  every number proved to 12 digits" in shown and "not that the formulas are right" in shown
    assert batch.run(str(WORKSHEETS / "landing_gear.py"), [str(path), "--proof=15", "--t_r=8"]) == 2


@pytest.mark.parametrize("proof", ["0", "16", '"many"', "true", "[9]"])
def test_digits_that_cannot_be_asked_for(proof: str, tmp_path: Path) -> None:
    path = tmp_path / "proved.toml"
    path.write_text(f"proof = {proof}\n")
    with pytest.raises(SheetError, match=r"proof = .* must be a number of digits, 1\.\.15"):
        scene.load(path)


def test_numbers_that_stand_in_each_other_twice_are_looked_at_once(tmp_path: Path) -> None:
    """Of thirty in a row a proof never came to its end."""
    chain = "".join(f"c{k + 1} = (c{k} + 0.3 * c{k}) / 1.3000001  # [-] number\n" for k in range(30))
    sheet = own(tmp_path, f"c0 = 1.1  # [-] first\n{chain}y = g.F * c30  # [-] last")
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    assert proof_of(names, sheet, record(names, sheet, whole=True, exact=True)).check(9).passed


SIZES = "sizes = np.array([0.032, 0.04, 0.05])\n"
CHOSEN_TWICE = [
    (
        f"{SIZES}def not_below(d):\n    for size in sizes:\n        if size >= d:\n            return size\n"
        "    return math.nan\ny = [*sizes].index(not_below(0.0141 * g.F)) + g.a  # [-] y"
    ),
    f"{SIZES}d = next(size for size in sizes if size >= 0.01 * g.F)\ny = [*sizes].index(d) + g.a  # [-] y",
    f"{SIZES}d = sizes[1] if g.F > 2 else sizes[2]\ny = (2.0 if d == 0.04 else 3.0) * g.F  # [-] y",
    f"{SIZES}d = sizes[np.argmax(sizes > 0.012 * g.F)]\ny = (2.0 if d <= 0.032 else 3) * g.F  # [-] y",
    "d = {2: 0.1, 3: 0.3}[g.k]\ny = (2.0 if d < 0.1 else 3.0 if d in (0.1, 0.2) else 4.0) * g.F  # [-] y",
]


@pytest.mark.parametrize("lines", CHOSEN_TWICE)
def test_a_decimal_that_is_chosen_is_the_one_that_is_written(lines: str, tmp_path: Path) -> None:
    """Of a standard size no digit was proved: 0.04 was not the float that it is compared with, or not surely itself."""
    sheet = own(tmp_path, lines)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path, "g": sheet.inputs()}
    assert proof_of_wanted(names, sheet, ["y"]).least["results"].least > 15


def test_a_column_without_a_unit_or_a_line_is_named_without_one(tmp_path: Path) -> None:
    """A proof of such a document ended in unit [] is not known."""
    lines = 'table_2 = Table("2", "Built", (Column("v", "", "", 1, np.array([g.F, 1.0])),))'
    path = Path(own(tmp_path, lines).path)
    path.write_text(path.read_text().replace("import ask, find", "import Column, Table, ask, find", 1))
    sheet = load(path)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    proof = proof_of(names, sheet, record(names, sheet, whole=True, exact=True))
    assert [str(column) for column in proof.columns if column.where == "table 2"] == [
        "table 2, v: 0.0 digits; it is not recorded"
    ]
