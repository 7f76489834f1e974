"""The sheet of the inputs, which the user of a workbook edits."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

from mechsheet.units import parse, shown, si
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.cell_formula import written
from mechsheet.workbook.content import Content, Live, allowed, cut, put, quoted
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.inputs import LEAST, MOST, declared
from mechsheet.worksheet.kinds import Choice, Switch, number
from mechsheet.worksheet.lists import Rows

_FOLLOWED = "No formula of this workbook follows a value without a yellow ground: run the worksheet again for it."
_AS_TEXT = {"num_format": "@"}  # what is typed stays a text
_LETTERS = '"0123456789.,+-−eE"'  # of a number as text


@dataclass(frozen=True)
class InputRow:
    """One input: ``value`` is in ``unit``, a text, or one of the ``options``; those of a ``section`` stand together.

    ``limits``, ``whole`` and ``tolerance`` are those of the declared input. It is element ``k`` of the ``leaf`` of a
    recording, which has the name of the symbol where none is given. What is not ``asked`` is shown, and not to be
    changed.
    """

    symbol: str
    value: float | int | str
    unit: str
    meaning: str
    section: str = ""
    limits: tuple[tuple[str, str], ...] = ()
    whole: bool = False
    options: tuple[str, ...] = ()
    leaf: str = ""
    k: int = 0
    asked: bool = True
    tolerance: str = ""

    @property
    def allowed(self) -> str:
        """The limits in words."""
        if self.options:
            return ", ".join(self.options)
        return ", ".join([*(["whole number"] if self.whole else []), *(" ".join(limit) for limit in self.limits)])


def rows(g: Any) -> list[InputRow]:
    """Rows of all inputs of a worksheet, behind them those of the properties of its options."""
    asked, shown, cls = list[InputRow](), list[InputRow](), type(g)
    for field in declared(cls):
        value = getattr(g, field.name)
        written = field.written(value, getattr(cls, field.name))
        options: tuple[str, ...] = ()
        match field:
            case Choice():
                options = field.options
                shown += _properties(field)
            case Rows():
                asked += _of_rows(field, written)
                continue
            case Switch():
                written, options = field.text(value), (field.text(False), field.text(True))
        row = InputRow(
            field.name, written, field.unit, field.meaning, field.section, field.limits, field.whole, options
        )
        if field.tolerance:
            row = replace(row, tolerance=field.tolerance.text(field.unit))
        asked.append(row)
    return asked + shown


def _of_rows(field: Rows, written: Mapping[str, Any]) -> Iterator[InputRow]:
    """The numbers of a list or a table, column by column, each with the number of its row behind its name."""
    for column in field.columns:
        meaning = column.meaning if column.meaning == field.meaning else f"{field.meaning}: {column.meaning}"
        for k, value in enumerate(written[column.name].tolist()):
            limits = tuple(
                (sign, f"{other} ({k + 1})" if "." in other and other in written else other)
                for sign, other in column.limits
            )
            words = (column.unit, meaning, field.section, limits)
            yield InputRow(f"{column.name} ({k + 1})", value, *words, leaf=column.name, k=k)


def _properties(field: Choice) -> Iterator[InputRow]:
    """The properties of all options, one after the other, as they stand in the worksheet."""
    for n, each in enumerate(field.properties):
        for k, (option, row) in enumerate(zip(field.options, field.table, strict=True)):
            name = f"{field.name}.{each.name}"
            shown = (each.display(row[n]), each.unit, each.meaning, f"Options of {field.name}: {field.meaning}")
            yield InputRow(f"{name} ({option})", *shown, leaf=name, k=k, asked=False)


def write(book: Book, rows: Sequence[InputRow], formulas: SheetFormulas | None) -> None:
    """The sheet Inputs; with ``formulas`` each input also in SI units, under the name that formulas use.

    There is none where the value is outside its limits or no number, or stands in another unit.
    """
    fields = [("Symbol", looks.TEXT), ("Value", looks.FIELD), ("Unit", looks.TEXT), ("Meaning", looks.TEXT)]
    fields.append(("Limits", looks.TEXT))
    if formulas:
        fields += [("in SI units", looks.SI), ("Unit", looks.TEXT), ("Name", looks.TEXT)]
        fields += [("As read", looks.SI), ("As exported", looks.SI), ("Differs", looks.SI)]
    listed: list[tuple[Content, ...]] = []
    placed = {row.symbol: n + 1 for n, row in listed_rows(rows) if isinstance(row, InputRow)}
    for _, row in listed_rows(rows):
        if isinstance(row, InputRow):
            bounds = ", ".join(filter(None, (row.allowed, row.tolerance)))
            line: tuple[Content, ...] = (row.symbol, row.value, shown(row.unit), row.meaning, bounds)
            listed.append((*line, *(_computed(row, placed, formulas) if formulas else ())))
        else:
            listed.append((row,))
    sheet = book.listing("Inputs", f"{book.title} - inputs", fields, listed)
    if not formulas:
        return
    for n, row in listed_rows(rows):
        if isinstance(row, InputRow):
            followed = (row.leaf or row.symbol) in formulas.arrangement.followed
            if row.asked:
                sheet.data_validation(n, 1, n, 1, _validation(row, placed))
            if isinstance(row.value, str) or not (followed and row.asked):
                look = {**(looks.FIELD if followed and row.asked else looks.NUMBER)}
                look |= _AS_TEXT if isinstance(row.value, str) else {}
                put(sheet, n, 1, row.value, book.style(looks.CELL, look))
    end = len(listed) + 2
    changed = formulas.arrangement.changed
    text, small = book.style(looks.TEXT), book.style(looks.SI)
    put(sheet, changed.row, changed.column - 2, "inputs that differ from the exported ones", text)
    put(sheet, changed.row, changed.column, Live(f"=SUM(K3:K{end})", 0.0), small)
    put(sheet, changed.row, changed.column + 2, changed.name, text)
    if not {row.leaf or row.symbol for row in rows if row.asked} <= formulas.arrangement.followed:
        put(sheet, changed.row + 1, 0, _FOLLOWED, book.style(looks.NOTE))


def listed_rows(rows: Sequence[InputRow]) -> Iterator[tuple[int, InputRow | str]]:
    """Inputs and the headings of their sections, with the rows of the sheet in which they stand."""
    n = 2
    for section, members in groupby(rows, key=lambda row: row.section):
        for item in [section, *members] if section else members:
            yield n, item
            n += 1


def _computed(row: InputRow, placed: dict[str, int], formulas: SheetFormulas) -> tuple[Content, ...]:
    """Value in SI, its unit and name, the number read and the exported one, and whether they differ."""
    n, node, factor = placed[row.symbol], formulas.recording.inputs[row.leaf or row.symbol], parse(row.unit).factor
    read = f"I{n}"
    units = [row.unit, shown(row.unit), *([""] if row.unit == "-" else [])]
    same = ",".join(f"EXACT(TRIM(C{n}),{quoted(unit)})" for unit in dict.fromkeys(units))
    rules = [f"OR({same})", f"ABS({read})<={written(MOST)}", *_rules(row, read, placed)]
    if row.leaf and row.asked:  # rows that are added are not followed
        rules.append(f'COUNTIF($A:$A,"{row.leaf} (*")={node.size}')
    exported: Any = node.value.reshape(-1)[row.k].item()
    scaled = "" if factor == 1 else "*PI()/180" if factor == math.pi / 180 else f"*{factor!r}"
    if exported is True or exported is False:
        scaled = "=1"
    value = Live(f"=IF(AND({','.join(rules)}),{read}{scaled},NA())", exported)
    number = exported + 0 if isinstance(row.value, str) else row.value
    as_read = Live(_option(row, f"B{n}") if isinstance(row.value, str) else _read(f"B{n}"), number)
    differs = Live(f"=IF(ISERROR(F{n}),1,IF({read}=J{n},0,1))", 0.0)
    name = formulas.name(node) + (f" ({row.k + 1})" if node.shape else "")
    return value, shown(si(row.unit)), name, as_read, number, differs


def _rules(row: InputRow, value: str, placed: dict[str, int]) -> Iterator[str]:
    """Formulas of the limits of an input whose ``value`` stands in that cell; other inputs are taken as read."""
    for sign, other in row.limits:
        if (sign, other) == (">", "0"):
            yield f"{value}>={written(LEAST)}"
        else:
            yield f"{value}{sign}" + (f"$I${placed[other]}" if other in placed else written(number(other)))
    if row.whole:
        yield f"{value}=INT({value})"


def _read(cell: str) -> str:
    """Formula of the number that a cell holds: a number, or a text with a decimal comma or point."""
    text = f"TRIM({cell})"
    strange = f"SUMPRODUCT(--ISERROR(FIND(MID({text}&REPT(0,40),ROW($1:$40),1),{_LETTERS})))"
    plain = f'SUBSTITUTE(SUBSTITUTE({text},"−","-"),",",".")'
    held = f'IF(AND(LEN({text})>0,LEN({text})<=40,{strange}=0),IFERROR(_xlfn.NUMBERVALUE({plain},"."," "),NA()),NA())'
    return f"=IF(ISLOGICAL({cell}),NA(),IF(ISNUMBER({cell}),{cell},{held}))"


def _option(row: InputRow, cell: str) -> str:
    """Formula of the number of the option that a cell holds; of a text 0 while it is the exported one, else 1."""
    if not row.options:
        return f'=IF(EXACT({cell}&"",{quoted(str(row.value))}),0,1)'
    comma = any("," in option for option in row.options)
    held = f'TRIM({cell}&"")' if comma else f'SUBSTITUTE(TRIM({cell}&""),",",".")'
    same = f"EXACT({held},{{{';'.join(map(quoted, row.options))}}})"
    return f"=IF(SUMPRODUCT(--{same})=1,SUMPRODUCT({same}*(ROW($1:${len(row.options)})-1)),NA())"


def _validation(row: InputRow, placed: dict[str, int]) -> dict[str, object]:
    """What a spreadsheet program takes into the cell of an input; a text is judged by its value in SI units."""
    cell = f"B{placed[row.symbol]}"
    if isinstance(row.value, str):
        return _of_options(row)
    rules = ",".join([f"ISNUMBER({cell})", *_rules(row, cell, placed)])
    limits = f"Limits: {row.allowed}. " if row.allowed else ""
    message = allowed(f"{row.meaning} [{shown(row.unit)}]. {limits}Decimal point, or comma as text.")
    return {
        "validate": "custom",
        "value": f"=IF(ISTEXT({cell}),TRUE,AND({rules}))",
        "ignore_blank": False,
        "input_title": cut(allowed(row.symbol), 32),
        "input_message": cut(message, 255),
        "error_title": "Outside the limits",
        "error_message": cut(allowed(f"{row.symbol}: {row.allowed or 'a number'}"), 255),
        "error_type": "stop",
    }


def _of_options(row: InputRow) -> dict[str, object]:
    """A list to choose from, as long as a spreadsheet program takes; any text where there are no options."""
    texts = {"input_title": cut(allowed(row.symbol), 32), "input_message": cut(allowed(row.meaning), 255)}
    if not row.options or len(",".join(row.options)) > 255 or any("," in option for option in row.options):
        return {"validate": "any", **texts}
    wrong = {"error_title": "None of the options", "error_message": cut(allowed(row.allowed), 255)}
    return {"validate": "list", "source": list(row.options), "ignore_blank": False, **texts, **wrong}
