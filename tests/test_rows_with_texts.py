"""Rows of a table with texts in them: the numbers of the row that is chosen follow, a text holds only what uses it."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from by_cells import by_cells
from own_worksheet import ELSEWHERE, own, recorded, value_of
from test_recalculation import edit

from mechsheet import evaluate
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.written import Either, Written
from mechsheet.readers.numbers import numbers
from mechsheet.run import report

ROWS = "T = [('M6', 6, 1.0), ('M8', 8, 1.25), ('M10', 10, 1.5), ('M16', 16, 2.0)]\n"
FOLLOWED = [
    "name, d, P = next(r for r in T if r[1] > 2 * g.F)\ny = d * P * g.a",
    "name, d = next((n, d) for n, d, P in T if d > 2 * g.F)\ny = d * g.a",
    "name, d, P = [r for r in T if r[1] > 2 * g.F][0]\ny = d * P",
    "for name, d, P in T:\n    if d > 2 * g.F:\n        break\ny = d * P * g.a",
    "for row in T:\n    if row[1] > 2 * g.F:\n        break\ny = row[1] * row[2] * g.a",
    "for row in T:\n    if row[1] > 2 * g.F:\n        d, name = row[1], row[0]\n        break\ny = d * g.a",
    "name, d, P = min(T, key=lambda r: abs(r[1] - 2 * g.F))\ny = d * g.a",
    "D = {n: (d, P) for n, d, P in T}\nname = next(n for n, (d, P) in D.items() if d > 2 * g.F)\ny = D[name][0] * g.a",
    "kind = 'low'\nif g.F > 3:\n    kind = 'high'\ny = {'low': g.a, 'high': 1.0}[kind]",
    "D = [{'d': d, 'n': n} for n, d, P in T]\nrow = next(r for r in D if r['d'] > 2 * g.F)\ny = row['d'] * g.a",
]
FOLLOWED += [
    "name, d, P = next((r for r in T if r[1] > 2 * g.F), ('-', 20, 2.5))\ny = d * P * g.a",
    "name, d = min(((n, d) for n, d, P in T if d > 2 * g.F), key=lambda r: r[1])\ny = d * g.a",
    "name, d, P = max((r for r in T if r[1] < 5 * g.F), key=lambda r: r[1])\ny = d * P",
    "y = min((d for n, d, P in T if d >= 2 * g.F), key=lambda d: abs(d - 9 * g.a))",
    "y = next(r for r in T if 2 * g.F < r[1] < 12)[1] * g.a",
    (
        "from dataclasses import dataclass\n@dataclass(frozen=True)\nclass Bolt:\n    name: str\n    d: float\n"
        "B = [Bolt('M6', 6.0), Bolt('M10', 10.0)]\nb = next(b for b in B if b.d > 2 * g.F)\ny = b.d * g.a"
    ),
    "name, d, P = next(r for r in T if r[1] > 2 * g.F)\ny = d * (2 if name == 'M6' else 1)",
    "n = next(n for n, d, P in T if 2 * g.F < d < 12)\ny = {n: P for n, d, P in T}[n] * g.a",
    "name, d, P = next(r for r in T if r[1] > 2 * g.F)\ny = d * isinstance(name, str)",
    "best = None\nfor row in T:\n    if row[1] > 2 * g.F:\n        best = row\n        break\ny = best[1] * g.a",
]
WITH_A_CONDITION = [  # that there is such a row
    "for row in T:\n    if row[1] > 2 * g.F:\n        break\nelse:\n    raise ValueError('x')\nname, y, P = row",
    (
        "def size(need):\n    for name, d, P in T:\n        if d >= need:\n            return name, d\n"
        "    raise ValueError('none')\nname, d = size(2 * g.F)\ny = d * g.a"
    ),
    "i = next(i for i, r in enumerate(T) if r[1] > 2 * g.F)\nname, d, P = T[i]\ny = d * g.a",
    "name, d, P = T[g.k]\ny = d * g.a",
    "y = {2: ('a', 3.0), 3: ('b', g.F)}[g.k][1] * g.a",
]
HELD = [
    "name, d, P = next(r for r in T if r[1] > 2 * g.F)\ny = d * len(f'{name} x')",
    "name, d, P = next(r for r in T if r[1] > 2 * g.F)\ny = d * float(name.removeprefix('M'))",
]


@pytest.mark.parametrize("lines", [*FOLLOWED, *WITH_A_CONDITION, *HELD])
def test_the_numbers_follow(lines: str, tmp_path: Path) -> None:
    """Where Python uses a text they are those of the worksheet or none."""
    sheet = own(tmp_path, f"{ROWS}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    told = recording.gaps or [guard for guard in recording.guards.values() if not guard.rows]
    assert bool(told) is (lines not in FOLLOWED)
    for given in ELSEWHERE:
        value = value_of(recording, "result", given)
        if lines not in HELD or np.isfinite(value).all():
            expected = by_cells(sheet.path, ["result"], **given)["result"]
            np.testing.assert_allclose(value, expected, rtol=1e-12, err_msg=str(given))


def test_where_no_row_fits_there_is_no_number(tmp_path: Path) -> None:
    for lines in (*FOLLOWED[:3], FOLLOWED[5], FOLLOWED[7], FOLLOWED[9], *FOLLOWED[-2:], *WITH_A_CONDITION[:2]):
        _, recording = recorded(own(tmp_path, f"{ROWS}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"))
        assert np.isnan(value_of(recording, "result", {"F": 8.5}))


def said(text: Written, F: float, recording: Recording) -> str:
    """What a text says for another input."""
    (part,) = text.parts or ("",)
    if not isinstance(part, Either):
        return str(part)
    holds = numbers([part.holds.re], {recording.inputs["F"]: F})[part.holds.re]
    return said(part.then if holds else part.otherwise, F, recording)


@pytest.mark.parametrize("lines", [*FOLLOWED[:4], *FOLLOWED[5:8], WITH_A_CONDITION[1]])
def test_the_text_is_that_of_the_row_and_none_where_no_row_fits(lines: str, tmp_path: Path) -> None:
    """As a page in one file says it."""
    _, recording = recorded(own(tmp_path, f"{ROWS}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"))
    name = recording.values["name"]
    nearest, last = "min(T" in lines, "for name" in lines and "def" not in lines
    assert isinstance(name, Written) and said(name, 2.5, recording) == "M6"
    assert said(name, 3.5, recording) == ("M6" if nearest else "M8")
    assert said(name, 8.5, recording) == ("M16" if nearest or last else "")


@pytest.mark.office
def test_cells_choose_the_row_and_hold_what_uses_its_text(recalculated_all: Any, tmp_path: Path) -> None:
    each = [*FOLLOWED, *WITH_A_CONDITION]
    lines = [f"{line}\nr_{k} = y * 1.0  # [-] line" for k, line in enumerate(each)]
    lines += [f"every = np.array([{', '.join(f'r_{k}' for k in range(len(each)))}])  # [-] all"]
    lines += [f"{FOLLOWED[0]}\nheld = len(name) * g.a * 1  # [-] number of signs", 'table_3 = table("3", "Held", held)']
    sheet = own(tmp_path, ROWS + "\n".join([*lines, 'table_2 = table("2", "All", every)']))
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", {**names, "__file__": sheet.path}, {}))
    changes: list[dict[str, Any]] = [{"F": 4.5, "a": 0.9}, {"F": 3.5, "k": 3}]
    edited = [edit(book, given, tmp_path / f"changed{n}.xlsx") for n, given in enumerate(changes)]
    for given, changed in zip(changes, recalculated_all(edited), strict=True):
        rows = [row[0] for row in changed["2 All"].iter_rows(min_row=5, values_only=True)]
        np.testing.assert_allclose(rows, evaluate(sheet.path, ["every"], **given)["every"], rtol=1e-12)
        assert changed["3 Held"].cell(5, 1).value == "#N/A"
        made = {row[0]: row[4] for row in changed["Checks"].iter_rows(min_row=3, values_only=True)}
        assert [verdict for name, verdict in made.items() if "made for these inputs" in name] == ["FAIL"]
