"""Find in a page: the same verdicts as in Python, on functions that are easily misjudged."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from in_browser import evaluated
from own_worksheet import own, recorded

from mechsheet.html import javascript, values
from mechsheet.html import write as html
from mechsheet.html.follow import Follower
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.lines import Recording
from mechsheet.worksheet import cells
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.typeset import Numbers
from mechsheet.worksheet.verdict import Verdict

if TYPE_CHECKING:
    from playwright.sync_api import Page


# What is asked of one unknown: the function, its interval, and what else is said.
ONE = {
    "cubic": "lambda t: t**3 + g.a * t, 0, 9, equals=g.F",
    "many roots": "lambda t: np.sin(20 * t * g.a), 0.01, 3",
    "nearest the guess": "lambda t: np.sin(20 * t * g.a), 0.01, 3, guess=2.2",
    "double root": "lambda t: (t - g.a)**2, 0, 2",
    "double root at large numbers": "lambda t: 1e9 + (t - g.a)**2, 0, 2, equals=1e9",
    "touches from below": "lambda t: np.cos(t - g.a), -1, 3, equals=1",
    "just does not touch": "lambda t: np.cos(t - g.a), -1, 3, equals=1 + 1e-9",
    "just crosses twice": "lambda t: np.cos(t - g.a), -1, 3, equals=1 - 1e-11",
    "pole": "lambda t: 1 / (t - g.a), 0, 2",
    "pole and root": "lambda t: np.tan(t), 0.5, 4",
    "jump": "lambda t: np.where(t > g.a, 1.0, -1.0), 0, 2",
    "jump in a slope": "lambda t: t + np.where(t > g.a, 1.0, -1.0), 0, 2, equals=g.a",
    "floor": "lambda t: np.floor(t * 3.3), 0, 2, equals=2.5",
    "kink": "lambda t: abs(t - g.a) - 0.1, 0, 2",
    "kink that touches": "lambda t: abs(t - g.a), 0, 2",
    "level at the target": "lambda t: np.maximum(t - g.a, 0), 0, 2",
    "level everywhere": "lambda t: 0 * t + g.a, 0, 2, equals=g.a",
    "level everywhere but for rounding": "lambda t: np.sin(t)**2 + np.cos(t)**2, 0, 2, equals=1",
    "dead centre": "lambda t: np.sqrt(g.a**2 - t**2), 0, 2, equals=0.1",
    "end of what closes": "lambda t: np.sqrt(g.a**2 - t**2), 0, 2",
    "closes in the middle": "lambda t: np.arccos(3 * (t - g.a)), 0, 2, equals=1",
    "closes nowhere": "lambda t: np.sqrt(-g.a - t**2), 0, 2",
    "outside": "lambda t: np.exp(t), 0, 2, equals=-g.a",
    "at the lower end": "lambda t: t**2 - g.a, g.a**0.5, 2",
    "at the upper end": "lambda t: np.exp(t), 0, 1, equals=np.exp(1.0)",
    "tenth power": "lambda t: t**9 - 1e-9 * g.a, -1, 2",
    "cubic root": "lambda t: np.cbrt(t - g.a), 0, 2",
    "flat cubic": "lambda t: ((t - 3) * t + 3) * t - 1, 0, 2",
    "rounded": "lambda t: (t * 1e-8 + 1e4 * g.a) - 1e4 * g.a, 0, 2, equals=1e-8",
    "large": "lambda t: (t / 1e30)**2, 1e29, 4e30, equals=g.a",
    "small": "lambda t: t * 1e25, 1e-29, 4e-25, equals=g.a",
    "steep": "lambda t: np.exp(50 * t) - np.exp(50 * g.a), 0, 2",
    "narrow dip": "lambda t: 1 - 2 * np.exp(-((t - g.a) * 100)**2), 0, 2",
    "root at zero": "lambda t: t * (t + 5), -1, 2",
    "two as near": "lambda t: 1.7 * g.F * np.cos(t), -1.5, 1.5, equals=0.7 * g.a",
    "two as near a guess": "lambda t: (t - 1.3)**2 * g.F, 0, 3, equals=0.7 * g.a, guess=1.3",
    "no interval": "lambda t: np.sqrt(t - g.a), guess=2.0, equals=3",
    "one end": "lambda t: np.log(t) * g.a, lo=0.1, guess=2.0",
    "no interval, no root": "lambda t: np.sqrt(t - g.a) + 1, guess=2.0",
    "branches": "lambda t, s: s * np.sin(3 * t * g.a), 0.1, 2, equals=0.3, branches=(1, -1), branch=1",
    "the other branch": "lambda t, s: s * np.sqrt(t - 0.5 * g.a), 0, 2, equals=0.3, branches=(1, -1), branch=-1",
    "a branch by an input": "lambda t, s: s * t, -2, 2, equals=g.a, branches=(1, -1), branch=np.where(g.F > 2, 1, -1)",
    "neither branch": "lambda t, s: s * np.sqrt(t - 0.5 * g.a), 0, 2, equals=30, branches=(1, -1), branch=-1",
    "array": "lambda t: t**3 + g.a * t, 0, 9, equals=x",
    "array with gaps": "lambda t: np.sin(t) * g.a, 0, 1.5, equals=x - 1",
    # In space, the square of a distance: the number of problems is that of what is summed over its last axis.
    "array of vectors": (
        "lambda t: ((np.asarray(t)[..., None] * np.array([g.a, 1.0, 0.5]) - x[:, None] * [0.1, 0.2, 0.1])**2)"
        ".sum(axis=-1), 0, 9, equals=g.F"
    ),
}
ROUGH = {
    "no solution": 1e-6,
    "no solution from the guess": 1e-6,
    "just crosses twice": 1e-10,
    "a double solution": 1e-6,
    "array": 1e-10,
}  # where rounding moves a root so far
ANGLES = ("complex", "array")
DEPENDENT = "one equation twice", "a curve twice", "twice in intervals", "twice with another input"  # any may be named
OTHER: list[dict[str, Any]] = [{"a": 0.5}, {"a": 1.2, "F": 1.0}]


@pytest.mark.parametrize("case", ONE)
def test_one_unknown_has_the_same_verdict(case: str, blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, f'y_found = find({ONE[case]}, unknown="t")\ny = x * 1  # [-] line')
    _, recording = recorded(sheet)
    assert not recording.gaps
    given = [{}, *OTHER]
    for inputs, each in zip(given, solved(blank, sheet, recording, given), strict=True):
        expected = sheet.run(["y_found"], {"g": sheet.inputs(**inputs)})["y_found"]
        assert_same_words(each["text"], expected, case in ROUGH or "pole" in case)
        verdicts = each["found"]["y_found.t"]
        many = verdicts if isinstance(verdicts, list) else [verdicts]
        for k, found in enumerate(many):
            at = (lambda v, k=k: np.ravel(v)[k]) if verdicts is many else (lambda v: v)
            reason = at(np.asarray(expected.reason, object)) if verdicts is many else expected.reason
            assert kind(reason) == found["reason"], inputs
            if expected.branch is None:  # else it is compared in words, as the roots of all branches are
                assert found["samples"] == at(expected.samples), inputs
            near = ROUGH.get(case, 1e-14)
            assert_same([found["value"]], [at(expected._value)], near)
            assert_same(found["interval"], [at(end) for end in expected.interval])
            if max(map(abs, found["reached"]), default=0) < 1e12:  # how near a pole it is looked at is rounding
                assert_same(found["reached"], [at(end) for end in expected.reached], 1e-12)
            roots = [at(root.value) for root in expected.roots if expected.branch in (None, root.branch)]
            assert_same([root["value"] for root in found["roots"]], [x for x in roots if x == x], near)


# Of several unknowns.
SEVERAL = {
    "circle and line": "lambda u, v: (u**2 + v**2, v - g.a * u), equals=(g.F**2, 0), u=(0, 9), v=(0, 9)",
    "circle and parabola": "lambda u, v: (u**2 + v**2, v - u**2), equals=(4, -1), u=(-2, 2), v=(-2, 2)",
    "from a guess": "lambda u, v: (u * v - g.F, u - g.a * v), u=1.0, v=1.0",
    "a guess of zero": "lambda u, v: (u + v - g.F, u - g.a * v), u=0.0, v=0.0",
    "no solution": "lambda u, v: (u**2 + v**2 + g.a, u + v - 1), u=(-9, 9), v=(-9, 9)",
    "no solution from the guess": "lambda u, v: (u**2 + g.a, v - u), u=1.0, v=1.0",
    "one seen around the guess": "lambda u, v: (u**3 - 2 * u + 2 + 0 * g.a, v - u), u=0.0, v=0.5",
    "a double solution": "lambda u, v: ((u - g.a)**2, v - u), u=(0, 2), v=(0, 2)",
    "sizes far apart": "lambda u, v: (u * 1e-9 - g.a, v * 1e9 - u * 1e-9), u=(0, 1e10), v=(0, 1e-8)",
    "no number beside it": "lambda u, v: (np.sqrt(u - g.a), v - u), u=(0, 4), v=(0, 4)",
    "complex": "lambda p, q: np.exp(1j * p) + g.a * np.exp(1j * q) - 0.4 * g.F, p=1.0, q=-1.0",
    "an angle far off": "lambda p, q: q * np.exp(1j * p) - g.F * np.exp(2j), p=0.3, q=1.0, unknown_unit=('rad', 'm')",
    "rounded to one number": "lambda p, q: np.exp(1j * p) + 0.7114300409213384 * np.exp(1j * q)"
    " - 0.2 * 8.347208449245823, p=1.0, q=-1.0",
    "three": "lambda u, v, w: (u + v + w - 6, u * v * w - 6 * g.a, u - w), u=(0, 4), v=(0, 6), w=(0, 4)",
    "no target": "lambda u, v: (u + v, v - g.a * u), equals=(np.where(g.F > 2, g.F, np.nan), 0), u=(0, 9), v=(0, 9)",
    "targets of some": "lambda u, v: (u + v, v - g.a * u), equals=(np.where(x > 2, x, np.nan), 0), u=1.0, v=1.0",
    "a guess beside an interval": "lambda u, v: (u + v - 2 * g.F, v - u - g.a), u=(0, 9), v=1.0",
    "at an end": "lambda u, v: (u - 1, v - g.a), u=(0, 1), v=(0, 2)",
    "one equation twice": "lambda u, v: (u + v - g.F, 2 * g.F - 2 * u - 2 * v), u=1.0, v=1.0",
    "a curve twice": "lambda u, v: (u**2 + v**2 - g.F, 3 * u**2 + 3 * v**2 - 3 * g.F), u=1.0, v=0.9",
    "twice in intervals": "lambda u, v: (u + v - 2 - g.a, 3 * (u + v - 2 - g.a)), u=(0.2, 3), v=(0.2, 3)",
    "twice with another input": "lambda u, v: (u + v - 1, g.F * u + v - 1), u=0.2, v=1.0",
    "rests on none": "lambda u, v: (0 * u + g.a, v - u), equals=(g.a, 0), u=1.0, v=1.5",
    "array": "lambda p, q: np.exp(1j * p) + g.a * np.exp(1j * q) - 0.2 * x, p=1.0, q=-1.0",
    "sums": "lambda k, m: (np.sum(k[..., None] * x**2, axis=-1) - g.F, m - k), k=np.array([1.0, 2.0]), m=1.0",
}


@pytest.mark.parametrize("case", SEVERAL)
def test_several_unknowns_have_the_same_verdict(case: str, blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y_found = find({SEVERAL[case]})\ny = x * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    given = [{}, *OTHER]
    for inputs, each in zip(given, solved(blank, sheet, recording, given), strict=True):
        expected = sheet.run(["y_found"], {"g": sheet.inputs(**inputs)})["y_found"]
        assert_same_words(each["text"], expected, case in ROUGH or case in ANGLES or case in DEPENDENT)
        verdict = next(iter(each["found"].values()))
        many = isinstance(verdict, list)
        for k, found in enumerate(verdict if many else [verdict]):
            values = [np.ravel(v)[k] for v in expected._values]
            if case in ANGLES:  # whole turns are told by rounding, where a step is long
                found["x"], values = np.exp(1j * np.array(found["x"])), np.exp(1j * np.array(values))
            np.testing.assert_allclose(found["x"], values, rtol=ROUGH.get(case, 1e-12), atol=1e-12, err_msg=str(inputs))
            reason = np.ravel(np.asarray(expected.reason, object))[k]
            assert bool(found["reason"]) == bool(reason), inputs
            if many or (case in DEPENDENT and reason):
                continue
            assert len(found["solutions"]) == len(expected.solutions), inputs
            assert found["starts"] == expected.starts, inputs
            if np.isfinite(expected.condition) and case not in ROUGH:
                assert found["condition"] == pytest.approx(expected.condition, rel=1e-3)


def test_least_squares_are_the_same(blank: Page, tmp_path: Path) -> None:
    path = Path(
        own(tmp_path, "y_least = minerr(lambda k: (k - g.F, 2 * k - g.a, k**2), k=1.0)\ny = x * 1  # [-] line").path
    )
    path.write_text(path.read_text().replace("from mechsheet import ", "from mechsheet import minerr, ", 1))
    sheet = cells.load(path)
    _, recording = recorded(sheet)
    (found,) = evaluated(blank, javascript.module(recording, {}), [{"a": 0.5}], verdicts=True)
    expected = sheet.run(["y_least"], {"g": sheet.inputs(a=0.5)})["y_least"]
    assert next(iter(found["found"].values()))["x"] == pytest.approx([expected.value.k], rel=1e-7)


def solved(blank: Page, sheet: cells.Worksheet, recording: Recording, given: list[dict[str, Any]]) -> list[Any]:
    """Verdicts of the page, and their words."""
    names = sheet.run(["y_found"], {"g": sheet.inputs()})
    script = javascript.module(recording, {}) + javascript.runtime("format.js", "found.js")
    follower = Follower(recording, Numbers({**names, "__file__": sheet.path}))
    follower.found(names["y_found"])
    return evaluated(blank, script, given, verdicts=True, words=follower.specs[0]["words"])


# What only roundings tell: how often and how exactly.
TOLD_BY_ROUNDING = ("missed", "value within", "errors grow", "computed")


def assert_same_words(text: str, expected: Verdict, rough: bool) -> None:
    """Of a ``rough`` one, whose last digits are others, only the words between its numbers."""
    own = values.html(expected, Follower(Recording(Graph(), {})))
    shown = re.search("<div><span.*</table>", own)
    assert shown
    a, b = without_rounding(text), without_rounding(shown[0])
    if rough:
        a, b = (re.sub(r"[−-]?[\d.]+(e-?\d+)?", "0", t) for t in (a, b))
    assert a == b


def without_rounding(text: str) -> str:
    """A verdict without what only roundings tell."""
    rounded = "|".join(TOLD_BY_ROUNDING)
    return re.sub(rf"<tr><th>[^<]*(?:{rounded}).*?</tr>", "", text)


def kind(reason: str) -> str:
    """The reason in one word, as the page's Find gives it."""
    words = {"nothing to solve": "nothing", "is NaN at each": "closes", "jumps over": "jumps", "is outside": "outside"}
    words |= {"any value would do": "level"}
    return next((word for text, word in words.items() if text in reason), reason)


def assert_same(found: list[float], expected: list[float], within: float = 1e-14) -> None:
    assert len(found) == len(expected)
    np.testing.assert_allclose(found, expected, rtol=within, atol=1e-29)


def test_how_many_values_are_found_is_told_by_what_equations_sum_along_another_axis(
    blank: Page, tmp_path: Path
) -> None:
    """Such a worksheet had no page."""
    sheet = own(
        tmp_path,
        "c = np.array([1.0, 2.0, 3.0])\n"
        "pull = lambda u: np.sum(np.maximum(np.asarray(u)[..., None] * c - 0.1, 0), axis=-1)\n"
        "two = find(lambda u, v: (pull(u) * v - x, u + v), equals=(0, 3), u=(0.5, 2.5), v=(0.5, 2.5))\n"
        "y = pull(two.value.u)  # [-] line\n"
        'table_2 = table("2", "Two", y)',
    )
    assert len(html.page(sheet, sheet.inputs()))
    _, recording = recorded(sheet)
    (column,) = recording.tables["2"]
    assert column is not None
    given: list[dict[str, Any]] = [{}, {"F": 2.25}]
    for inputs, each in zip(
        given, evaluated(blank, javascript.module(recording, {"y": column.re}), given), strict=True
    ):
        expected = sheet.run(["y"], {"g": sheet.inputs(**inputs)})["y"]
        np.testing.assert_allclose(each["values"]["y"], expected, rtol=1e-9)


def test_values_whose_count_only_their_own_equations_tell_are_refused_in_a_line(tmp_path: Path) -> None:
    """What sorts tells no length."""
    sheet = own(
        tmp_path,
        "c = np.array([1.0, 2.0, 3.0])\n"
        "pull = lambda u: np.sort(np.maximum(np.asarray(u)[..., None] * c - 0.1, 0), axis=-1)[..., 0]\n"
        "two = find(lambda u, v: (pull(u) * v - x, u + v), equals=(0, 3), u=(0.5, 2.5), v=(0.5, 2.5))\n"
        "y = pull(two.value.u)  # [-] line\n"
        'table_2 = table("2", "Two", y)',
    )
    with pytest.raises(SheetError, match="line 39: how many values are found there is not known before"):
        html.page(sheet, sheet.inputs())
