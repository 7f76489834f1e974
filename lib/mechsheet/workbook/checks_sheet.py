"""The sheet of the checks, and the colours of their verdicts."""

import math
from collections.abc import Container, Mapping, Sequence
from typing import Any

from mechsheet.units import shown
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import LARGEST, Content, Live, holding, put
from mechsheet.workbook.place import letters
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.workbook.sizes import Sizes
from mechsheet.worksheet.check import Check

_WITHIN = "inputs within their limits"
_MADE = "made for these inputs: where this fails, export the worksheet again"
_VERDICT = '=IF(ISNUMBER(B{0}-C{0}),IF(B{0}{1}C{0},"PASS","FAIL"),"not evaluated")'


def write(
    book: Book,
    checks: Sequence[Check],
    formulas: SheetFormulas | None,
    fixed: Container[str] = (),
    proved: Mapping[str, float] | None = None,
) -> None:
    """The sheet Checks; with ``formulas`` also rows that tell whether inputs are within their limits and all holds.

    Of the ``fixed`` checks a scene has set the limit. Where there is a proof, a column has the digits ``proved`` by the
    names of its checks, for the exported inputs alone.
    """
    fields: tuple[tuple[str, looks.Look], ...] = (
        *(("Check", looks.TEXT), ("Residual", looks.SMALL), ("Limit", looks.SMALL), ("Unit", looks.TEXT)),
        *(("Verdict", looks.VERDICT), ("Reason", looks.TEXT)),
    )
    listed: list[tuple[Content, ...]] = []
    rows: list[tuple[Check, Content, Content]] = [(c, c.residual, c.limit) for c in checks]
    if not formulas:
        listed += [(c.name, c.residual, c.limit, shown(c.unit), verdict(c), c.reason) for c in checks]
        title: Content = _title(sum(check.passed for check in checks), len(checks))
    else:
        within = Check(_WITHIN, 0.0, 0.0, "inputs")
        rows = [(within, Live(formulas.outside(), 0.0), 0.0)] if formulas.recording.inputs else []
        rows += [(c, *_compared(c, formulas, c.name in fixed)) for c in checks]
        if guard := formulas.guard():
            rows.append((Check(_MADE, 0.0, 0.0, reason=formulas.looked()), Live(guard, 0.0), 0.0))
        listed += [
            (
                formulas.name_of(c.name),
                residual,
                limit,
                shown(c.unit),
                Live(_VERDICT.format(n, ">=" if c.at_least else "<="), verdict(c)),
                _reason(c, formulas),
            )
            for n, (c, residual, limit) in enumerate(rows, 3)
        ]
        cells = f"E3:E{len(rows) + 2}"
        known = _title(sum(c.passed for c, *_ in rows), len(rows))
        title = Live(f'="Checks: "&COUNTIF({cells},"PASS")&" of "&ROWS({cells})&" passed"', known)
    if proved:
        fields = (*fields, ("Digits proved", looks.NUMBER))
        shown_digits = (_digits(check.name, proved, formulas) for check, *_ in rows)
        listed = [(*row, digits) for row, digits in zip(listed, shown_digits, strict=True)]
    sheet = book.listing("Checks", title, fields, listed)
    for n, (check, residual, limit) in enumerate(rows, 2):
        if not check.agreement:
            put(sheet, n, 1, residual, book.style(looks.CELL, looks.QUANTITY))
            put(sheet, n, 2, limit, book.style(looks.CELL, looks.AT_LEAST if check.at_least else looks.QUANTITY))
    if formulas and not formulas.arrangement.finite:  # for another condition the format of the numbers has no room
        infinite = {"type": "cell", "criteria": ">=", "value": LARGEST, "format": book.file.add_format(looks.INFINITE)}
        sheet.conditional_format(2, 1, len(listed) + 2, 1, infinite)
    sizes = Sizes(book, sheet)
    for n, (check, *_) in enumerate(rows, 2):
        if not check.agreement:
            sizes.of_any(n, 1)
            sizes.of_any(n, 2, looks.FROM if check.at_least else "")
    sizes.write()
    verdicts(book, sheet, len(listed), 4, 4)


def _digits(name: str, proved: Mapping[str, float], formulas: SheetFormulas | None) -> Content:
    if name not in proved:
        return ""
    return formulas.as_exported(proved[name]) if formulas else proved[name]


def verdict(check: Check) -> str:
    """The verdict of a check as it stands in a workbook."""
    return "PASS" if check.passed else check.verdict


def _title(passed: int, count: int) -> str:
    return f"Checks: {passed} of {count} passed"


def _compared(check: Check, formulas: SheetFormulas, fixed: bool) -> tuple[Content, Content]:
    """Residual and limit of a check, live or for the exported inputs alone."""
    live = formulas.check(check.name)
    if not live:
        return formulas.as_exported(check.residual), check.limit
    residual = math.copysign(LARGEST, check.residual) if math.isinf(check.residual) else check.residual
    return Live(live.residual, residual), check.limit if fixed else Live(live.limit, live.bound)


def _reason(check: Check, formulas: SheetFormulas) -> Content:
    held = formulas.recording.checks.get(check.name)
    fixed = held and all(part.op == "constant" for part in (*held.parts, held.limit))
    if check.name == _MADE or (fixed and not check.passed):  # it is of all inputs, as that of units
        return check.reason
    return formulas.as_exported(check.reason) if check.reason else ""


def verdicts(book: Book, sheet: Any, rows: int, first: int, last: int) -> None:
    """Colour the verdicts in some columns of a listing."""
    for text, look in (("PASS", looks.PASS), ("FAIL", looks.FAIL), ("not evaluated", looks.OPEN)):
        holds = holding(f'{letters(first)}3="{text}"')
        coloured = {"type": "formula", "criteria": holds, "format": book.file.add_format(look)}
        sheet.conditional_format(2, first, rows + 2, last, coloured)
