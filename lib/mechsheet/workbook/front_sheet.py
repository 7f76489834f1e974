"""The first sheet: what all checks say, the key results, the contents, and what does not follow other inputs."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from mechsheet import units
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import LEAVES, bottom_up
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.cell_formula import AGGREGATE
from mechsheet.workbook.chart import Listed
from mechsheet.workbook.content import LARGEST, Content, Live, allowed, holding, put
from mechsheet.workbook.content import quoted as quoted_text
from mechsheet.workbook.find_sheet import FoundRow
from mechsheet.workbook.place import Place, quoted
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.workbook.sizes import Sizes
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.table import Column

_NAME = "Front"
_WIDTHS = (200, 95, 95, 60, 230)
_ROOM = 11  # characters for which a number's cell has room
_GREY = "Grey cells hold for the exported inputs only, and show #N/A otherwise."
_SEARCHED = "Found values are searched by their cells: #N/A where it is not sure that the worksheet finds the same."
_COMPARED = (
    "Spreadsheet programs take numbers that differ in their last digits for equal, where they compare or cut them."
)
_COMPARING = {"lt", "le", "gt", "ge", "eq", "ne", "floor", "sign", "mod"}
_ALL = "all checks PASS"
_VERDICT = "Checks!$E:$E"


class Result(NamedTuple):
    """A key result: its value, or the least and the greatest one of a column."""

    symbol: str
    values: tuple[Content, ...]
    unit: str
    meaning: Content
    look: looks.Look
    grey: bool = False  # holds for the exported inputs only
    column: Column | None = None  # of which they are the least and the greatest


def add(book: Book) -> Any:
    """The empty sheet."""
    return book.sheet(_NAME, book.title, _WIDTHS, 2, looks.UPRIGHT)


def write(
    book: Book,
    sheet: Any,
    checks: Sequence[Check],
    found: Sequence[FoundRow],
    results: Sequence[Result],
    known: Recording | None,
) -> None:
    """Fill the sheet, when all others are there; the recording ``known`` says what is not followed."""
    bold = book.style({"bold": True, "align": "left"})
    sheet.merge_range(1, 0, 1, len(_WIDTHS) - 1, "", bold)  # white on red, it is seen on its own ground alone
    put(sheet, 1, 0, _verdict(checks, found), bold)
    for sign, look in (("=", looks.PASS), ("<>", looks.FAIL)):
        coloured = {"type": "formula", "criteria": holding(f'A2{sign}"{_ALL}"'), "format": book.file.add_format(look)}
        sheet.conditional_format(1, 0, 1, 0, coloured)
    row, sizes = 3, Sizes(book, sheet)
    if results:
        row = _block(book, sheet, row, ("Key results", "Value, least", "greatest", "Unit", "Meaning"))
    for result in results:
        cells = (result.symbol, *result.values, *[""] * (2 - len(result.values)), units.shown(result.unit))
        number = {**result.look, **(looks.EXPORTED if result.grey else {})}
        side = (looks.TEXT, number, number if len(result.values) > 1 else looks.NUMBER, looks.TEXT)
        for col, (value, look) in enumerate(zip(cells, side, strict=True)):
            put(sheet, row, col, value, book.style(looks.CELL, look))
        if result.column:
            sizes.follow((row, 1, row, 2), result.column, _ROOM)
        else:
            sizes.alone(row, 1, looks.VALUE_DECIMALS, _ROOM)
        row = _text(book, sheet, row, 4, result.meaning)
    sizes.write()
    row = _block(book, sheet, row + bool(results), ("Contents", "", "", "", ""))
    for name, title in book.contents[1:]:
        sheet.write_url(row, 0, f"internal:{quoted(name)}!A1", book.style(looks.CELL, looks.LINK), name)
        row = _text(book, sheet, row, 1, Live(f"={quoted(name)}!$A$1", title))
    gaps = [*known.gaps, *known.unsolved] if known else []
    if gaps:
        row = _block(book, sheet, row + 1, ("Not followed", "Reason", "", "", ""))
        for gap in gaps:
            names = f"line {gap.line}" + (f": {', '.join(gap.names)}" if gap.names else "")
            put(sheet, row, 0, names, book.style(looks.CELL, looks.TEXT))
            row = _text(book, sheet, row, 1, gap.reason)
    searches = known and any(solved.searched for solved in known.found.values())
    told = {_GREY: gaps, _SEARCHED: searches, _COMPARED: known and _compares(known)}
    for n, note in enumerate((note for note, holds in told.items() if holds), row if gaps else row + 1):
        put(sheet, n, 0, note, book.style(looks.NOTE))


def _compares(known: Recording) -> bool:
    """Whether cells compare what they compute, or cut it: at a limit the worksheet may go the other way."""
    lines = (line.node for lines in known.lines.values() for line in lines)
    deciding = (node for node in bottom_up([*lines, *known.shown()], ()) if node.op in _COMPARING)
    return any(operand.op not in LEAVES for node in deciding for operand in node.operands)


def results(found: Sequence[FoundRow], drawn: Sequence[Listed], formulas: SheetFormulas | None) -> list[Result]:
    """The found values, else the numbers on which no other line rests; then what figures show, else tables."""
    first = [
        Result(row.symbol, (Live(f"=Find!$B${n}", row.value),), row.unit, row.meaning, looks.VALUE)
        for n, row in enumerate(found, 3)
    ]
    return [*(first or (_last(formulas) if formulas else ())), *_shown(drawn)]


def _verdict(checks: Sequence[Check], found: Sequence[FoundRow]) -> Live:
    """What the sheets Checks and Find say, for they may say another thing when inputs are changed."""
    said = [check.verdict for check in checks]
    counts = [
        (f'COUNTIF({_VERDICT},"{verdict}")', said.count(verdict), verdict) for verdict in ("FAIL", "not evaluated")
    ]
    if found:
        cells = f"SUMPRODUCT(--ISERROR(Find!$B$3:$B${len(found) + 2}))"
        counts.append((cells, sum(math.isnan(row.value) for row in found), "not found"))
    text = '&", "&'.join(f'{cells}&" {verdict}"' for cells, _, verdict in counts)
    formula = f'=IF({"+".join(cells for cells, _, _ in counts)}=0,"{_ALL}",{text})'
    own = ", ".join(f"{count} {verdict}" for _, count, verdict in counts)
    return Live(formula, own if any(count for _, count, _ in counts) else _ALL)


def _last(formulas: SheetFormulas) -> Iterator[Result]:
    for line in formulas.arrangement.last:
        value = Live(formulas.shown(line), float(line.node.value.item()) / units.parse(line.unit).factor)
        yield Result(line.symbol, (value,), line.unit, line.meaning, looks.VALUE, formulas.kept(line.node))


def _shown(drawn: Sequence[Listed]) -> Iterator[Result]:
    seen = set[Place]()
    for columns, source, place, grey in drawn:
        for column in columns:
            at = place(column)
            if at in seen:
                continue
            seen.add(at)
            numbers = column.values[abs(column.values) < LARGEST]
            cells = at.range(0, len(column.values) - 1)
            ends = [
                Live(
                    f"=IF(COUNT({cells})=0,NA(),{AGGREGATE}({code},6,{cells}))",
                    float(end(numbers)) if numbers.size else math.nan,
                )
                for code, end in ((5, min), (4, max))
            ]
            look = {**looks.NUMBER, "num_format": column.number_format}
            meaning = f"{column.meaning}, {source}" if column.meaning else source
            told = _lacking(meaning, cells, len(column.values), len(numbers))
            yield Result(column.symbol, tuple(ends), column.unit, told, look, at.column in grey, column)


def _lacking(meaning: str, cells: str, rows: int, count: int) -> Live:
    """What a column means, and in how many of its rows it has no number, over which its least and greatest pass."""
    text, count_of = f"{allowed(meaning)}; no number in ", f"COUNT({cells})"
    formula = f'=IF({count_of}<{rows},{quoted_text(text)}&{rows}-{count_of}&" of {rows}",{quoted_text(meaning)})'
    return Live(formula, allowed(meaning) if count == rows else f"{text}{rows - count} of {rows}")


def _block(book: Book, sheet: Any, row: int, heads: Sequence[str]) -> int:
    """The heading of a block; the row below it."""
    for col, head in enumerate(heads):
        side = looks.side(looks.NUMBER if heads[2] and col in (1, 2) else looks.TEXT)
        put(sheet, row, col, head, book.style(looks.HEAD, looks.TOP, looks.BOTTOM, side))
    return row + 1


def _text(book: Book, sheet: Any, row: int, col: int, text: Content) -> int:
    """A text in the columns from ``col`` on, in as many lines as it needs; the row below it."""
    style = book.style(looks.CELL, looks.TEXT)
    if col < len(_WIDTHS) - 1:
        sheet.merge_range(row, col, row, len(_WIDTHS) - 1, "", style)
    put(sheet, row, col, text, style)
    held = (sum(_WIDTHS[col:]) - looks.PAD) // (looks.CHAR - 1)  # words are narrower than digits
    length = len(str(text.value if isinstance(text, Live) else text))
    sheet.set_row_pixels(row, looks.ROW + (math.ceil(max(length, 1) / held) - 1) * (looks.ROW - 5))
    return row + 1
