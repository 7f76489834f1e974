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


@pytest.mark.parametrize("worksheet", WORKSHEETS, ids=lambda path: path.stem)
def test_export_is_current(worksheet: Path, tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-X", "utf8", worksheet, f"--out={tmp_path}"], capture_output=True, encoding="utf-8"
    )
    assert run.returncode == 0, run.stdout + run.stderr
    book = f"{worksheet.stem}.xlsx"
    assert [path.name for path in tmp_path.iterdir()] == [book]
    stale = list(differences(EXPORTS / book, tmp_path / book))
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
