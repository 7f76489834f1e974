"""The sheet of the checks, and the colours of their verdicts."""

import math
from collections.abc import Sequence
from typing import Any

from mechsheet.units import shown
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, Live
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.checks import Check


def write(book: Book, checks: Sequence[Check], formulas: SheetFormulas | None) -> None:
    """The sheet Checks; with ``formulas`` also a row that tells whether they still hold for the inputs."""
    fields = (
        *(("Check", looks.TEXT), ("Residual", looks.SMALL), ("Limit", looks.SMALL), ("Unit", looks.TEXT)),
        *(("Verdict", looks.VERDICT), ("Reason", looks.TEXT)),
    )
    listed: list[tuple[Content, ...]] = []
    for n, c in enumerate(checks, 3):
        live = formulas and formulas.check(c.name)
        known = "PASS" if c.passed else "FAIL"
        verdict: Content = known
        residual: Content = c.residual
        limit: Content = c.limit
        if live:
            residual = Live(live.residual, c.residual)
            if math.isclose(live.bound, c.limit, rel_tol=1e-9):  # a scene may have set another
                limit = Live(live.limit, c.limit)
            verdict = Live(f'=IF(IFERROR(B{n}<=C{n},FALSE),"PASS","FAIL")', known)
        listed.append((c.name, residual, limit, shown(c.unit), verdict, c.reason))
    if formulas and (guard := formulas.guard()):
        n = len(checks) + 3
        what = "made for these inputs: where this fails, export the worksheet again"
        verdict = Live(f'=IF(IFERROR(B{n}<=C{n},FALSE),"PASS","FAIL")', "PASS")
        listed.append((what, Live(guard, 0.0), 0.0, "-", verdict, ""))
    passed = sum(check.passed for check in checks)
    sheet = book.listing("Checks", f"Checks: {passed} of {len(checks)} passed", fields, listed)
    verdicts(book, sheet, len(listed), 4, 4)


def verdicts(book: Book, sheet: Any, rows: int, first: int, last: int) -> None:
    """Colour the verdicts in some columns of a listing."""
    for verdict, look in (("PASS", looks.PASS), ("FAIL", looks.FAIL)):
        rule = {"type": "cell", "criteria": "==", "value": f'"{verdict}"', "format": book.file.add_format(look)}
        sheet.conditional_format(2, first, rows + 2, last, rule)
