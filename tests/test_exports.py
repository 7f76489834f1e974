"""The workbooks in exports/ are what the worksheets write today."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

ROOT = Path(__file__).resolve().parents[1]
WORKSHEETS = sorted((ROOT / "worksheets").glob("*.py"))
EXPORTS = ROOT / "exports"

MEASURED = ("accuracy",)  # workbooks of run times and of errors that are rounding: no two runs write the same
TIMED = ("time", "ratio", "place", "least time", "of whole")  # columns, not compared
LOST = 1.5  # digits between two runs of one method: their errors are rounding, which differs between processors


@pytest.mark.parametrize("worksheet", WORKSHEETS, ids=lambda path: path.stem)
def test_export_is_current(worksheet: Path, tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-X", "utf8", worksheet, f"--out={tmp_path}"], capture_output=True, encoding="utf-8"
    )
    assert run.returncode == 0, run.stdout + run.stderr
    book = f"{worksheet.stem}.xlsx"
    assert [path.name for path in tmp_path.iterdir() if path.suffix != ".toml"] == [book]  # a design writes its scene
    compared = measured if worksheet.stem in MEASURED else differences
    stale = list(compared(EXPORTS / book, tmp_path / book))
    assert not stale, f"exports/{book} is not current:\n" + "\n".join(stale[:20])


def test_every_export_has_its_worksheet() -> None:
    assert {path.stem for path in EXPORTS.glob("*.xlsx")} == {path.stem for path in WORKSHEETS}


def differences(old: Path, new: Path) -> Iterator[str]:
    """Cells of two workbooks that differ in their formula or their value."""
    for data_only in (False, True):  # the formulas, then the values stored beside them
        was, now = load_workbook(old, data_only=data_only), load_workbook(new, data_only=data_only)
        if was.sheetnames != now.sheetnames:
            yield f"sheets {was.sheetnames} became {now.sheetnames}"
            return
        for a, b in zip(was.worksheets, now.worksheets, strict=True):
            rows, columns = max(a.max_row, b.max_row), max(a.max_column, b.max_column)
            for row, column in product(range(1, rows + 1), range(1, columns + 1)):
                x, y = a.cell(row, column), b.cell(row, column)
                if not same(x.value, y.value):
                    yield f"{a.title}!{x.coordinate}: {x.value!r} became {y.value!r}"


def measured(old: Path, new: Path) -> Iterator[str]:
    """Cells that differ in what is not measured, errors that differ by more than LOST digits, checks that turned."""
    was, now = load_workbook(old, data_only=True), load_workbook(new, data_only=True)
    if was.sheetnames != now.sheetnames:
        yield f"sheets {was.sheetnames} became {now.sheetnames}"
        return
    for a, b in zip(was.worksheets, now.worksheets, strict=True):
        rows, columns = max(a.max_row, b.max_row), max(a.max_column, b.max_column)
        heads = [a.cell(2 if a.title == "Checks" else 3, column).value for column in range(1, columns + 1)]
        for row, (column, head) in product(range(1, rows + 1), enumerate(heads, 1)):
            x, y = a.cell(row, column), b.cell(row, column)
            if isinstance(x.value, float | int) and isinstance(y.value, float | int):
                alike = head in (*TIMED, "Residual") or a.cell(4, column).value == "µs" or _near(head, x.value, y.value)
            else:
                alike = x.value == y.value or (head in TIMED and row > 4)
            if not alike:
                yield f"{a.title}!{x.coordinate}: {x.value!r} became {y.value!r}"


def _near(head: object, x: float, y: float) -> bool:
    if head == "error":
        return x > 0 and y > 0 and abs(math.log10(x / y)) <= LOST
    return abs(x - y) <= LOST if head in ("digits", "most") else same(x, y)


def same(x: object, y: object) -> bool:
    """Numbers agree to 1e-9, relative or of the cell's unit: processors differ in the last digits, so does noise."""
    if isinstance(x, float | int) and isinstance(y, float | int):
        return math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-9)
    return x == y


def test_a_changed_cell_is_seen(tmp_path: Path) -> None:
    """The comparison itself: a number, a text, a formula and a lost row each count; the last digits do not."""

    def written(name: str, *rows: Sequence[object]) -> Path:
        book = Workbook()
        for cells in rows:
            book.worksheets[0].append(cells)
        book.save(tmp_path / name)
        return tmp_path / name

    old = written("old.xlsx", [1.0, "m", "=A1*2"], [5e4])
    assert not list(differences(old, written("same.xlsx", [1.0 + 1e-12, "m", "=A1*2"], [5e4 + 1e-6])))
    for cells in ([1.0 + 1e-8, "m", "=A1*2"], [1.0, "mm", "=A1*2"], [1.0, "m", "=A1*3"], ["1.0", "m", "=A1*2"]):
        assert list(differences(old, written("new.xlsx", cells, [5e4])))
    assert list(differences(old, written("short.xlsx", [1.0, "m", "=A1*2"])))


def test_measurements_may_differ_in_time_and_a_little_in_error(tmp_path: Path) -> None:
    """The comparison of measurements itself: methods, sheets, verdicts and lost digits count; times do not."""

    def written(name: str, *cells: object, verdict: str = "PASS", title: str = "1.1 Position") -> Path:
        book = Workbook()
        sheet, checks = book.worksheets[0], book.create_sheet("Checks")
        sheet.title = title
        heads = ("method", "error", "digits", "time", "place")
        for line in (["Table 1.1"], [], heads, [], cells):
            sheet.append(list(line))
        for line in (["Checks"], ["Check", "Residual", "Limit", "Verdict"], ["1.1 Position", 0.3, 1, verdict]):
            checks.append(line)
        book.save(tmp_path / name)
        return tmp_path / name

    old = written("old.xlsx", "Newton", 3e-16, 15.5, 0.2, "slower, the same digits")
    assert not list(measured(old, written("same.xlsx", "Newton", 5e-16, 15.3, 0.4, "faster, the same digits")))
    assert list(measured(old, written("lost.xlsx", "Newton", 3e-14, 13.5, 0.2, "slower, the same digits")))
    assert list(measured(old, written("other.xlsx", "hybr", 3e-16, 15.5, 0.2, "slower, the same digits")))
    assert list(measured(old, written("none.xlsx", "Newton", None, 15.5, 0.2, "slower, the same digits")))
    for change in ({"verdict": "FAIL"}, {"title": "1.2 Position"}):
        assert list(measured(old, written("new.xlsx", "Newton", 3e-16, 15.5, 0.2, "slower, the same digits", **change)))
