"""Checks as values."""

import re

import numpy as np
import pytest

from mechsheet.page.values import html
from mechsheet.worksheet.check import Check, assembled, check, check_slope, closed_form, require, summary
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.find import find
from mechsheet.worksheet.verdict import listen


@pytest.mark.parametrize(("residual", "passed"), [(1e-12, True), ([0, -2e-12], False), (np.nan, False), (1e-12j, True)])
def test_worst_element_decides_and_nan_fails(residual, passed):
    assert check("c", residual, 1e-12).passed is passed


@pytest.mark.parametrize(
    ("over_nothing", "passed"),
    [
        (check("c", [], 1.0), False),
        (check("c", [], 1.0, of=1), False),
        (check("c", [], 1.0, of=[]), False),
        (check_slope("c", [], np.sin, np.array([]), 0, 1), False),
        (assembled("c", np.array([]), [], (0.3, 0.7), "S", "m"), False),
        (check("c", [0.0], 0.0, of=0.0), True),
    ],
)
def test_over_nothing_is_not_evaluated_and_zero_is_something(over_nothing, passed):
    c = over_nothing
    assert (c.passed, c.evaluated, c.verdict) == (passed, passed, "pass" if passed else "not evaluated")
    assert passed or "there is nothing to check" in c.reason


@pytest.mark.parametrize("part", [1e-12, 0.9e-3, 1.1e-3, 1.0, 1e10, np.inf, np.nan])
@pytest.mark.parametrize("size", [1e-300, 1.0, 3.6e16])
@pytest.mark.parametrize("off", [0.0, 0.5, 2.0])
def test_agreement_within_more_than_a_thousandth_is_none(part, size, off):
    """Whatever the two computations differ by, a limit that allows anything has compared nothing."""
    within = part * size if part < 1 else size
    c = check("R12 is that of the library", [0.0, off * within], part, "N", of=[size, -size / 2])
    assert c.evaluated is (part <= 1e-3)
    assert c.passed is (part <= 1e-3 and off < 1)
    if not c.evaluated:
        assert "more than a thousandth of what is compared" in str(c) and str(c).startswith("not evaluated  R12")


def test_what_is_infinite_is_written_alike_in_a_check_and_in_a_line():
    c = check("moment", np.inf, 2500.0, "N*m")
    assert str(c) == "FAIL  moment: ∞ <= 2500 N·m" and "∞ &gt; 2500" in html(c)
    assert "−∞ &lt; 2" in html(check("gap", -np.inf, at_least=2.0, unit="m"))


def test_a_part_of_nothing_says_why_it_lets_nothing_through():
    c = check("balance", [0.0, 9e-13], 1e-9, "N", of=[0.0, 0.0])
    assert not c.passed and "what is compared is 0, and so is any part of it" in str(c)
    assert check("balance", 0.0, 1e-9, "N", of=0.0).passed


def test_slope_whose_differences_know_nothing_is_not_evaluated():
    x = np.linspace(0.0, 1.0, 5)
    c = check_slope("wild", np.ones(5), lambda x: np.sin(1e6 * x), x, 0.0, 1.0)
    assert not c.evaluated and "more than a thousandth" in c.reason


def test_shown_in_its_unit():
    c = check("c", 0.5, 2.0, "mm")
    assert (c.residual, c.limit) == (500, 2000)
    assert str(c) == "pass  c: 500 <= 2000 mm, 25 %"


def test_rounding_is_not_shown_as_a_value():
    """Of two computations that agree the limit is told; where they do not, by how much they differ."""
    agreed, apart = check("loop", 2.2e-16, 1e-12, "m", of=1.0), check("loop", 1e-9, 1e-12, "m", of=1.0)
    assert str(agreed) == "pass  loop: within 1e-12 m" and "2.2" not in html(agreed)
    assert str(apart) == "FAIL  loop: 1e-9 <= 1e-12 m" and "1\u202f·\u202f10−9 &gt; 1\u202f·\u202f10−12" in re.sub(
        "<[^>]*>", "", html(apart)
    )


def test_only_of_a_positive_limit_a_quantity_takes_a_part():
    limits = {2.0: "pass  c: 1 <= 2 N, 50 %", 1.0: "pass  c: 1 <= 1 N, 100 %", 0.0: "FAIL  c: 1 <= 0 N"}
    assert {limit: str(check("c", 1.0, limit, "N")) for limit in limits} == limits
    assert check("c", 100.0001, 100.0).utilised == "100.0001 %", "told apart from all of it"
    assert check("c", 1e-11, 1.0).utilised == "under 0.01 %" and check("c", 0.0, 1.0).utilised == "0 %"
    assert not check("c", 1.0, -2.0).utilised and not check("c", [], 2.0).utilised
    assert not Check("m <= 2 kN", -5.0, 2.0, "kN").utilised, (
        "a number on the other side of 0 takes no part of its limit"
    )


def test_the_worst_comes_first():
    fails, less, open_ = check("fails", 3.0, 2.0), check("less", 2.1, 2.0), check("open", np.nan, 2.0)
    loop, near, far = check("loop", 0.0, 1e-12, of=1), check("near", 1.9, 2.0), check("far", 0.2, 2.0)
    shown = summary(loop, far, open_, less, near, fails)
    assert [c.name for c in shown.worst_first] == ["fails", "less", "open", "near", "far", "loop"]
    bar = re.search('bar="(.*?)"', html(shown))[1]
    assert "3 of 6 checks" in bar and "fails: 3 &amp;gt; 2, 150 %" in bar
    assert "near 95 %" in re.search('bar="(.*?)"', html(summary(near, far)))[1]


def test_slope_against_differences():
    x = np.linspace(0.5, 1, 5)
    assert check_slope("cube", 3 * x**2, lambda x: x**3, x, 0.5, 1).passed
    several = check_slope("cubes", 3 * np.array([[1], [2]]) * x**2, lambda x: x**3, x, 0.5, 1)
    assert not several.passed and "in its own run" in several.reason
    assert not check_slope("cube", 3 * x**2 + 1e-6, lambda x: x**3, x, 0.5, 1).passed


def test_slope_is_taken_inside_the_range():
    x = np.linspace(0, 1, 3)[1:]
    assert check_slope("root", 0.5 / np.sqrt(x), lambda x: np.where(x <= 1, np.sqrt(np.abs(x)), np.nan), x, 0, 1).passed


@pytest.mark.parametrize("slope", [np.nan, 0.0])
def test_slope_that_does_not_exist_or_is_zero_everywhere(slope):
    c = check_slope("level", np.full(3, slope), lambda x: x * slope, np.linspace(0, 1, 3), 0, 1)
    assert c.passed is (slope == 0) and c.evaluated is (slope == 0)


def test_slope_over_an_empty_range_fails_in_words():
    c = check_slope("point", np.ones(2), lambda x: x, np.ones(2), 1.0, 1.0)
    assert not c.passed and not c.evaluated and c.reason == "there is nothing to check: the range is empty"


@pytest.mark.parametrize(
    "asked",
    [
        lambda: check("force", 1.0, 2.0, "Nn"),
        lambda: assembled("closes", 1j, 1.0, (0, 9), "cylinder", "Nn"),
        lambda: find(lambda x: x, -1, 1, unit="Nn"),
        lambda: find(lambda x: x, -1, 1, unknown_unit="Nn"),
        lambda: find(lambda x, y: (x, y), unit=("N", "Nn"), x=1.0, y=1.0),
        lambda: find(lambda x, y: (x, y), unknown_unit="Nn", x=1.0, y=1.0),
    ],
)
def test_a_unit_that_is_not_known_is_told_in_a_line(asked):
    with pytest.raises(SheetError, match=r"^(check \w+: )?unit \[Nn\] is not known; nearest: nN"):
        asked()


def test_a_check_of_what_is_counted_is_shown_in_its_words():
    assert "1 &gt; 0\u00a0open positions" in html(Check("closes", 1, 0, "open positions"))


def test_open_position_is_named_with_its_reach():
    S = np.array([0.5, 0.9])
    c = assembled("group closes", np.array([1j, np.nan]), S, (0.3733, 0.7733), "S", "m")
    assert not c.passed and c.essential
    assert c.reason == "no position closes for S = 0.9 m: it reaches 0.3733..0.7733 m"
    assert assembled("group closes", np.array([1j, 2]), S, (0.3733, 0.7733), "S", "m").passed


def test_each_variant_tells_why_it_does_not_close_to_who_listens():
    names = {"np": np, "assembled": assembled, "require": require}
    cell = """
point = np.array([[1j, 1j], [1j, np.nan], [np.nan, np.nan]])
require(point, 0.9, (0.3, [[0.6], [0.7], [0.8]]), "S", "m")
c = assembled("group closes", point, [0.5, 0.9], (300, 700), "S", "mm")
"""
    exec(cell, names)
    assert names["c"].residual == 3, "nobody listened"
    with listen() as told:
        exec(cell, names)
    exec(cell, names)
    assert [list(texts.flat) for texts in told] == [
        ["", *(f"no position closes for S = 0.9 m: it reaches 0.3..{high} m" for high in (0.7, 0.8))],
        ["", *(f"no position closes for S = {x} mm: it reaches 300000..700000 mm" for x in (900, 500))],
    ]


def test_verdict_is_shown():
    assert "FAIL" in Check("a<b", 2, 1)._mime_()[1] and "a&lt;b" in Check("a<b", 2, 1)._mime_()[1]


def test_summary_counts_and_leads_to_each_check():
    checks = (Check("a < b", 0, 1), Check("c", 2, 1))
    text = summary(checks[0], (checks[1],))._mime_()[1]
    assert "1 of 2 checks pass" in text
    assert text.index("FAIL") < text.index("PASS"), "what fails stands first"
    for each in checks:
        anchor = each._mime_()[1].split('id="')[1].split('"')[0]
        assert f'href="#{anchor}"' in text


def test_a_summary_takes_checks_alone_and_in_groups():
    a, b = check("a", 0, 1), check("b", 2, 1)
    assert summary(a, [b]) == summary((a,), b) == summary([a, b])
    with pytest.raises(SheetError, match="summary takes checks and groups of them, not 3"):
        summary(a, 3)


def test_what_has_no_number_is_not_evaluated_and_no_pass():
    open_one = check("moments of R01", [1e-15, np.nan], 1e-12, "N*m")
    assert not open_one.passed and not open_one.evaluated
    assert str(open_one) == "not evaluated  moments of R01; 1 of 2 values do not exist"
    assert "not evaluated" in open_one._mime_()[1] and "nan" not in open_one._mime_()[1]
    assert "<i>R</i><sub>01</sub>" in open_one._mime_()[1]
    shown = summary(check("a", 0, 1), check("b", 2, 1), open_one)._mime_()[1]
    assert "1 of 3 checks pass, 1 fail, 1 not evaluated" in shown
    assert shown.index(">b<") < shown.index("moments of") < shown.index(">a<"), "what fails first"


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (("a", 1.0, 2.0, 1.0), "check a: its unit must be a text between quotes, not 1.0"),
        ((3, 1.0, 2.0), "check 3: its name must be a text between quotes, not 3"),
        (("a", "big", 2.0), "check a: its residual must be numbers, not 'big'"),
        (("a", 1.0, "2"), "check a: its limit must be one number, not '2'"),
        (("a", 1.0, np.array([1.0, 2.0])), "check a: its limit must be one number, not [1. 2.]"),
        (("a", 1.0, None), "check a: it has no limit: give the limit behind the quantity, or at_least="),
        (("a", 1.0, 2.0, "mmm"), "check a: unit [mmm] is not known"),
    ],
)
def test_what_a_check_cannot_take_is_named(given, told):
    with pytest.raises(SheetError, match=re.escape(told)):
        check(*given)


FOUND = find(lambda x: x - 1, 0.0, 2.0)
SOLUTION = find(lambda x, y: (x - 1, y - 1), x=0.0, y=0.0)
OTHERS = [
    (lambda: check("a", [[1.0], [1.0, 2.0]], 1.0), "check a: its residual must be numbers, not [[1.0], [1.0, 2.0]]"),
    (lambda: Check("a", np.array([1.0, 3.0]), 2.0), "check a: its residual must be one number, not [1. 3.]"),
    (lambda: check("a", 1.0, "b", of=2.0), "check a: its limit must be one number, not 'b'"),
    (lambda: check("a", 1.0, [1, 2], of=2.0), "check a: its limit must be one number, not [1, 2]"),
    (lambda: check("a", 1.0, True, of=2.0), "check a: its limit is a condition, which is no number"),
    (lambda: check("a", 1.0, 1e-6, of=10**400), "check a: of= must be numbers, not 1000000"),
    (lambda: check("a", 1.0, 1e-6, of="big"), "check a: of= must be numbers, not 'big'"),
    (lambda: check("a", 1.0, 1e-6, of=[[1], [1, 2]]), "check a: of= must be numbers, not [[1], [1, 2]]"),
    (lambda: assembled("a", 1.0, 1.0, (), "S", "m"), "check a: reaches must be the two limits of S, not ()"),
    (lambda: assembled("a", 1.0, 1.0, 5, "S", "m"), "check a: reaches must be the two limits of S, not 5"),
    (lambda: assembled("a", "x", 1.0, (0, 2), "S", "m"), "check a: its points must be numbers, not 'x'"),
    (lambda: require(np.nan, 1.0, (None, 2), "S", "m"), "S and the limits of its reach must be real numbers"),
    (lambda: assembled("a", [np.nan, 1], np.ones(3), (1, 2), "S", "m"), "S and the limits of its reach must be real"),
    (lambda: require(np.nan, 1.0, "ab", "S", "m"), "require: reaches must be the two limits of S, not 'ab'"),
    (lambda: require(np.nan, 1.0, (0, 2), "S", "mmm"), "require: unit [mmm] is not known"),
    (lambda: Check("a", 1.0, None), "check a: its limit must be one number, not None"),
    (lambda: Check("a", 1.0, 2.0, "m").shown_in("N"), "check a: N does not measure m"),
    (lambda: check_slope("a", 1.0, "x", 0.5, 0, 1), "check_slope takes a function of what is unknown"),
    (lambda: check_slope("a", 1.0, np.sin, "x", 0, 1), "x = 'x' for check a must be real numbers"),
    (lambda: check_slope("a", np.ones(2), np.sin, np.ones(3), 0, 1), "shapes do not broadcast: slope (2,), x (3,)"),
    (lambda: closed_form(3, 1.0), "closed_form compares what find has found with a value, not 3"),
    (lambda: closed_form(FOUND, x=1.0), "closed form of unknown x: give it behind what is found, without a name"),
    (lambda: closed_form(FOUND, "1"), "closed form = '1' for unknown x must be real numbers"),
    (lambda: closed_form(SOLUTION, 1.0), "closed form of x, y: give each that has one by its name, as x=.."),
]


@pytest.mark.parametrize(("call", "told"), OTHERS)
def test_what_other_checks_cannot_take_is_named(call, told):
    with pytest.raises(SheetError, match=re.escape(told)):
        call()


def test_what_is_masked_has_not_been_checked():
    masked = np.ma.masked_array([0.0, 5.0], mask=[False, True])
    assert check("loops close", masked, 1.0).reason == "1 of 2 values do not exist"
