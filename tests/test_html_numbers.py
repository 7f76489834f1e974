"""The numbers of a page in one file: what JavaScript makes of a recording is what the worksheet has."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import test_recorded_worksheet
import test_rows_followed
from in_browser import evaluated
from own_worksheet import ELSEWHERE, OTHER, own, recorded

from mechsheet.html import javascript
from mechsheet.html.elementwise import ELEMENTWISE
from mechsheet.recording import operations
from mechsheet.worksheet import cells

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
            expected = cells.evaluate(sheet.path, ["result"], **inputs)["result"]
        except Exception:  # the worksheet itself has no number for these inputs
            assert all(part is None or np.isnan(part).all() for part in parts), inputs
            continue
        if any(part is None for part in parts):
            assert found["gaps"], inputs
            continue
        number = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        assert number.shape == np.shape(expected), inputs
        np.testing.assert_allclose(number, expected, rtol=1e-12, atol=1e-13, err_msg=str(inputs))
