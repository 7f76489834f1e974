"""The numbers of a page in one file: what JavaScript makes of a recording is what the worksheet has."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import test_everyday_forms
import test_guessed
import test_integral
import test_recorded_worksheet
import test_rows_followed
import test_rows_with_texts
import test_scipy_rules
from by_cells import by_cells
from in_browser import evaluated
from own_worksheet import ELSEWHERE, OTHER, own, recorded

from mechsheet import evaluate
from mechsheet.document import markup
from mechsheet.html import javascript
from mechsheet.html.elementwise import ELEMENTWISE
from mechsheet.quantities import operations
from mechsheet.worksheet import cells, numbers

if TYPE_CHECKING:
    from playwright.sync_api import Page


def test_every_operation_has_a_rule() -> None:
    assert set(ELEMENTWISE) == set(operations.ELEMENTWISE)
    of_several = {"rows", "length", "found", "iterated", "exported", "take", "at", "join", "reduce"}
    assert set(javascript.RULES) == {"input", *of_several}  # a constant and a state are known where they are met
    runtime = javascript.runtime("numbers.js")
    assert all(f"{kind}:" in runtime or f"of.{kind} =" in runtime for kind in operations.REDUCE)


@pytest.mark.parametrize("expression", test_recorded_worksheet.FOLLOWED)
def test_a_line_is_computed(expression: str, blank: Page, tmp_path: Path) -> None:
    assert_computed(blank, own(tmp_path, f"y = {expression}  # [-] line\nresult = y * 1  # [-] line"), OTHER)


@pytest.mark.parametrize("expression", test_rows_followed.FOLLOWED)
def test_a_line_is_computed_for_any_number_of_rows(expression: str, blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line\nresult = y * 1  # [-] line")
    assert_computed(blank, sheet, [*ELSEWHERE, {"n": 2}, {"n": 12, "a": 0.4}])


@pytest.mark.parametrize("lines", test_everyday_forms.SELECTED)
def test_what_meets_a_condition_is_selected(lines: str, blank: Page, tmp_path: Path) -> None:
    assert_computed(blank, own(tmp_path, f"{lines}\nresult = y * 1  # [-] line"), ELSEWHERE)


@pytest.mark.parametrize(
    "lines",
    [
        *(test_integral.IMPORT + lines for lines in test_integral.FOLLOWED[:4]),
        *(test_guessed.IMPORT + lines for lines in test_guessed.FOLLOWED[1:3]),
        *test_scipy_rules.SEVERAL,
        *(test_rows_with_texts.ROWS + lines for lines in test_rows_with_texts.FOLLOWED[3:5]),
    ],
)
def test_integrals_roots_and_rows_follow(lines: str, blank: Page, tmp_path: Path) -> None:
    assert_computed(blank, own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"), ELSEWHERE)


def test_frequencies_of_many_masses_are_computed(blank: Page, tmp_path: Path) -> None:
    """Cells have the eigenvalues of three rows, a page those of eight."""
    lines = (
        "from scipy.linalg import eigh\nM = np.diag(np.arange(1.0, 9.0) * g.a)\n"
        "K = 2 * np.diag([g.F] * 8) - np.diag([g.F] * 7, 1) - np.diag([g.F] * 7, -1)\n"
        "y = np.sqrt(eigh(K, M, eigvals_only=True))  # [-] line\nresult = y * 1  # [-] line"
    )
    assert_computed(blank, own(tmp_path, lines), OTHER)


def test_elements_are_taken_of_a_field_that_is_whole(blank: Page, tmp_path: Path) -> None:
    """Where the field and what is taken of it are as long, one loop could compute both: it had the exported numbers."""
    lines = (
        "u = np.array([k / 5 * g.F for k in range(6)])\nm = np.array([g.a + np.sin(k * g.a) for k in range(6)]) * g.F"
    )
    lines += "\ny = np.interp(u * np.array([0.0, 0.1, 0.3, 0.5, 0.9, 1.0]), u, m + np.cos(u))"
    assert_computed(blank, own(tmp_path, f"{lines}\nresult = y * 1  # [-] line"), OTHER)


@pytest.mark.parametrize(
    "total", ["x.sum()", "np.stack([x, x / 3]).sum(axis=1)[1]", "np.stack([x, x], axis=1).sum(axis=0)[1]"]
)
def test_sums_are_those_of_numpy_to_the_last_bit(total: str, blank: Page, tmp_path: Path) -> None:
    """So that a limit at which one stands is met as in the worksheet."""
    sheet = own(tmp_path, f"x = 1 / np.arange(1.0, g.n + 1)\ny = {total}  # [-] line")
    _, recording = recorded(sheet)
    given = [{"n": n} for n in (2, 7, 8, 9, 37, 128, 129, 300, 1001)]
    found = evaluated(blank, javascript.module(recording, {"y": recording.values["y"].re}), given)
    assert [each["values"]["y"].item() for each in found] == [
        by_cells(sheet.path, ["y"], **each)["y"] for each in given
    ]


LOOPS = {
    "while": "v, k = g.F, 0\nwhile v > 0.1 * g.a:\n    v = v / 2 - 0.01\n    k = k + 1\ny = v + k",
    "break": "v = g.F\nfor k in range(50):\n    v = v - (v**3 - g.a) / (3 * v**2)\n"
    "    if abs(v**3 - g.a) < 1e-13:\n        break\ny = v",
    "field": "v = x * 1.0\nwhile v.max() > g.a:\n    v = v * 0.7\ny = v",
}


@pytest.mark.parametrize("loop", LOOPS)
def test_a_loop_is_run_again(loop: str, blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{LOOPS[loop]}\nresult = y * 1  # [-] line")
    assert not recorded(sheet)[1].gaps
    assert_computed(blank, sheet, OTHER)


def test_an_element_that_is_not_there_empties_what_is_told_by_it(blank: Page, tmp_path: Path) -> None:
    lines = "k_max = 0\nfor k in range(5):\n    if np.sin(x[k]) > np.sin(x[k_max]):\n        k_max = k"
    sheet = own(tmp_path, f"{lines}\nresult = x[k_max] * g.a  # [-] line")
    assert_computed(blank, sheet, [*OTHER, {"n": 7}])
    script = javascript.module(recording := recorded(sheet)[1], {"a": recording.values["result"].re})
    (found,) = evaluated(blank, script, [{"n": 3}])
    assert found["values"]["a"] is None and "number of rows" in found["gaps"]["a"]


def test_what_is_not_recorded_is_empty_for_other_inputs_and_says_why(blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = np.fft.fft(x * g.a).real\nresult = y[1] + g.F  # [-] line\nother = x * g.F  # [-] line")
    _, recording = recorded(sheet)
    script = javascript.module(recording, {name: recording.values[name].re for name in ("result", "other")})
    same, changed, beside = evaluated(blank, script, [{}, {"a": 0.5}, {"k": 3}])
    assert not same["gaps"] and same["values"]["result"] == pytest.approx(recording.values["result"].re.value)
    assert changed["values"]["result"] is None and changed["gaps"].keys() == {"result"}
    assert changed["gaps"]["result"].startswith("line ")
    np.testing.assert_allclose(changed["values"]["other"], recording.values["other"].re.value, rtol=1e-14)
    assert beside["values"]["other"] is not None


def assert_computed(page: Page, sheet: cells.Worksheet, others: list[dict[str, Any]]) -> None:
    """The line ``result`` has in a page the numbers that the worksheet has, or the page says why it has none."""
    _, recording = recorded(sheet)
    value = recording.values["result"]
    script = javascript.module(recording, dict(zip("ab", value.parts, strict=False)))
    given = [{}, *others]
    for inputs, found in zip(given, evaluated(page, script, given), strict=True):
        parts = [found["values"][key] for key, _ in zip("ab", value.parts, strict=False)]
        try:
            expected = evaluate(sheet.path, ["result"], **inputs)["result"]
        except Exception:  # the worksheet itself has no number for these inputs
            assert all(part is None or np.isnan(part).all() for part in parts), inputs
            continue
        if any(part is None for part in parts):
            assert found["gaps"], inputs
            continue
        number = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        assert number.shape == np.shape(expected), inputs
        np.testing.assert_allclose(number, expected, rtol=1e-12, atol=1e-13, err_msg=str(inputs))


def test_numbers_are_written_as_python_writes_them(blank: Page) -> None:
    """A battery: ties, ends of the ranges, many random numbers."""
    rng = np.random.default_rng(7)
    wide = [float(x) for x in rng.choice([-1, 1], 4000) * 10 ** rng.uniform(-12, 24, 4000)]
    ties = [n / 2**k for k in range(8) for n in (1, 3, 5, 7, 9, 19, 25, 95, 1001, 12345, 99999)]
    ends = [0.0, -0.0, 1e-3, 9.99995e-4, 99999.5, 1e5, 999999.5, 1e6, 1e21, 1e22, 5e-324, 1.7e308, -0.0004, 0.00005]
    values = [*wide, *ties, *(-x for x in ties), *ends]
    told = blank.evaluate(
        f"""values => {{{javascript.runtime("format.js")}
        return values.map(x => [usual(x, AXIS), fixed(x, 0, CELL), fixed(x, 3, AXIS), scientific(x, 1, CELL),
          significant(x, 6), significant(x, 15), apart([x])[0], apart([x, x * 1.0001 + 1e-9]).join(" "),
          ...{json.dumps(FORMATS)}.map(spec => formatted(x, spec))])}}""",
        values,
    )
    for x, texts in zip(values, told, strict=True):
        assert texts[0].replace("\u202f·\u202f10<sup>", "e").replace("</sup>", "") == power(x), x
        assert texts[1:] == [
            numbers.fixed(x, 0, numbers.CELL),
            numbers.fixed(x, 3, numbers.AXIS),
            numbers.scientific(x, 1, numbers.CELL),
            numbers.significant(x, 6),
            numbers.significant(x, 15),
            numbers.apart([x])[0],
            " ".join(numbers.apart([x, x * 1.0001 + 1e-9])),
            *(f"{x:{'' if spec == 'r' else spec}}" for spec in FORMATS),
        ], x


def test_a_column_of_small_or_large_numbers_has_as_many_decimals_as_in_python(blank: Page) -> None:
    """Of which an amplitude of 1e-4 mm was a column of 0.0; so that of nothing but roundings stays.

    A number of cycles was 479949442798310.000, with more digits than there are.
    """
    columns = [[x, -3 * x, 0.0, np.nan] for k in range(-9, 15) for x in (10.0**k, 9.99 * 10.0**k)] + [[], [0.0]]
    asked = [(column, decimals) for column in columns for decimals in range(4)]
    script = f"asked => {{{javascript.runtime('format.js')} return asked.map(([x, n]) => enough(x, n))}}"
    told = blank.evaluate(script, [([None if np.isnan(x) else x for x in xs], n) for xs, n in asked])
    assert told == [numbers.enough(xs, n) for xs, n in asked]
    for xs, n in asked:
        largest = max(map(abs, xs[:2]), default=0)
        if largest >= 1e-6:
            shown = numbers.fixed(largest, numbers.enough(xs, n))
            assert len(shown.replace(".", "").lstrip("0")) >= 2 and ("." not in shown or len(shown) <= 10)


FORMATS = ("r", ".4g", ".1g", ".2f", ".0f", ".3e")


def power(x: float) -> str:
    return numbers.usual(x, numbers.AXIS._replace(power="{}e{}"))


def test_a_sentence_is_written_as_on_the_page_of_marimo(blank: Page) -> None:
    said = [
        "n = -0.5 must be >= 0, x <= -1e-05 m, at 90 deg",
        "S = -2..-1 m, a - b, x2e3, h-1, '-2e5 >= 3' stays, it's -3",
        "reached &lt;= 2, &gt;= -∞",
    ]
    told = blank.evaluate(f"all => {{{javascript.runtime('format.js')}\nreturn all.map(inWords)}}", said)
    assert told == [numbers.rewritten(text, markup.HTML) for text in said]
    assert told[0].startswith("n = −0.5 must be ≥ 0, x ≤ −1")
