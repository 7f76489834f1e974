"""The sheet of the inputs, which the user of a workbook edits."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any, NamedTuple

from mechsheet.units import shown, si
from mechsheet.workbook import input_formulas, input_tables_sheet, looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, Live, allowed, cut, holding, put, quoted
from mechsheet.workbook.input_tables_sheet import Grid, GridColumn
from mechsheet.workbook.place import Place
from mechsheet.workbook.place import quoted as quoted_sheet
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Choice, Switch
from mechsheet.worksheet.lists import Rows

_FOLLOWED = "No formula of this workbook follows a value without a yellow ground: run the worksheet again for it."
_SHEET = "Inputs"
_SI = 5  # column of the numbers in SI units


class InputRow(NamedTuple):
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


Item = InputRow | Grid


def rows(g: Any) -> list[Item]:
    """All inputs of a worksheet, behind them rows of the properties of its options."""
    asked, shown, cls = list[Item](), list[InputRow](), type(g)
    for field in declared(cls):
        value = getattr(g, field.name)
        written = field.written(value, getattr(cls, field.name))
        options: tuple[str, ...] = ()
        match field:
            case Choice():
                options = field.options
                shown += _properties(field)
            case Rows():
                columns = (
                    GridColumn(c.name, tuple(written[c.name].tolist()), c.unit, c.meaning, c.limits, c.whole, c.is_text)
                    for c in field.columns
                )
                asked.append(Grid(field.name, field.meaning, field.section, tuple(columns)))
                continue
            case Switch():
                written, options = field.text(value), (field.text(False), field.text(True))
        row = InputRow(
            field.name, written, field.unit, field.meaning, field.section, field.limits, field.whole, options
        )
        if field.tolerance:
            row = row._replace(tolerance=field.tolerance.text(field.unit))
        asked.append(row)
    return asked + shown


def _properties(field: Choice) -> Iterator[InputRow]:
    """The properties of all options, one after the other, as they stand in the worksheet."""
    for n, each in enumerate(field.properties):
        for k, (option, row) in enumerate(zip(field.options, field.table, strict=True)):
            name = f"{field.name}.{each.name}"
            shown = (each.display(row[n]), each.unit, each.meaning, f"Options of {field.name}: {field.meaning}")
            yield InputRow(f"{name} ({option})", *shown, leaf=name, k=k, asked=False)


def grids(items: Sequence[Item]) -> list[Grid]:
    """The lists and tables among the inputs."""
    return [item for item in items if isinstance(item, Grid)]


def places(items: Sequence[Item]) -> dict[str, Place]:
    """Where the inputs stand in SI units, by the names of their leaves; they have no names yet."""
    first = {x.leaf or x.symbol: n for n, x in listed_rows(items) if isinstance(x, InputRow) and x.k == 0}
    own = {name: Place("", _SHEET, n, _SI, differs=5) for name, n in first.items()}
    return own | input_tables_sheet.places(grids(items))


def changed(items: Sequence[Item]) -> Place:
    """Where it stands how many inputs differ from the exported ones."""
    return Place("inputs_changed", _SHEET, 2 + sum(1 for _ in listed_rows(items)), _SI)


def write(book: Book, items: Sequence[Item], formulas: SheetFormulas | None) -> None:
    """The sheet Inputs, and that of lists and tables; with ``formulas`` also in SI units, under the names they use.

    There is no number in SI units where the value is outside its limits or no number, or stands in another unit.
    """
    fields = [("Symbol", looks.TEXT), ("Value", looks.FIELD), ("Unit", looks.TEXT), ("Meaning", looks.TEXT)]
    fields.append(("Limits", looks.TEXT))
    if formulas:
        fields += [("in SI units", looks.SI), ("Unit", looks.TEXT), ("Name", looks.TEXT)]
        fields += [("As read", looks.SI), ("As exported", looks.SI), ("Differs", looks.SI)]
    listed: list[tuple[Content, ...]] = []
    empty = [""] * (len(fields) - 5)
    cells = {item.symbol: f"$I${n + 1}" for n, item in listed_rows(items) if isinstance(item, InputRow)}
    tables = grids(items)
    read = cells | input_tables_sheet.as_read(tables)
    for n, item in listed_rows(items):
        match item:
            case InputRow():
                bounds = ", ".join(filter(None, (item.allowed, item.tolerance)))
                line: tuple[Content, ...] = (item.symbol, item.value, shown(item.unit), item.meaning, bounds)
                held = formulas and (item.leaf or item.symbol) in formulas.recording.inputs  # but for texts of options
                listed.append((*line, *(_computed(item, n + 1, read, formulas) if formulas and held else empty)))
            case Grid():
                listed.append((item.symbol, "", "", item.meaning, item.told, *empty))
            case heading:
                listed.append((heading,))
    sheet = book.listing(_SHEET, f"{book.title} - inputs", fields, listed, printed=_SI)
    for n, item in listed_rows(items):
        if isinstance(item, Grid):
            put(sheet, n, 1, "", book.style(looks.CELL))
            link = f"internal:{quoted_sheet(input_tables_sheet.SHEET)}!A1"
            sheet.write_url(n, 4, link, book.style(looks.CELL, looks.LINK), item.told)
    if formulas:
        _live(book, sheet, items, read, formulas)
    if tables:
        others = {symbol: f"{_SHEET}!{cell}" for symbol, cell in cells.items()}
        input_tables_sheet.write(book, tables, others, formulas)


def _live(book: Book, sheet: Any, items: Sequence[Item], read: dict[str, str], formulas: SheetFormulas) -> None:
    """What may be typed into each cell, and how many inputs differ from the exported ones."""
    asked = set[str]()
    for n, row in listed_rows(items):
        if isinstance(row, InputRow):
            followed = (row.leaf or row.symbol) in formulas.arrangement.followed
            if row.asked:
                asked.add(row.leaf or row.symbol)
                sheet.data_validation(n, 1, n, 1, _validation(row, f"B{n + 1}", read))
            if isinstance(row.value, str) or not (followed and row.asked):
                look = {**(looks.FIELD if followed and row.asked else looks.NUMBER)}
                look |= looks.TYPED if isinstance(row.value, str) else {}
                put(sheet, n, 1, row.value, book.style(looks.CELL, look))
        elif isinstance(row, Grid):
            asked |= {column.symbol for column in row.columns}
    place = formulas.arrangement.changed
    text, small = book.style(looks.TEXT), book.style(looks.SI)
    put(sheet, place.row, place.column - 2, "inputs that differ from the exported ones", text)
    differing = ",".join([f"K3:K{max(place.row, 3)}", *input_tables_sheet.differing(grids(items))])
    put(sheet, place.row, place.column, Live(f"=SUM({differing})", 0.0), small)
    put(sheet, place.row, place.column + 2, place.name, text)
    if not asked <= formulas.arrangement.followed:
        put(sheet, place.row + 1, 0, _FOLLOWED, book.style(looks.NOTE))


def listed_rows(items: Sequence[Item]) -> Iterator[tuple[int, Item | str]]:
    """Inputs and the headings of their sections, with the rows of the sheet in which they stand."""
    n = 2
    for section, members in groupby(items, key=lambda item: item.section):
        for item in [section, *members] if section else members:
            yield n, item
            n += 1


def _computed(row: InputRow, n: int, read: dict[str, str], formulas: SheetFormulas) -> tuple[Content, ...]:
    """Value in SI, its unit and name, the number read and the exported one, and whether they differ."""
    node = formulas.recording.inputs[row.leaf or row.symbol]
    exported: Any = node.value.reshape(-1)[row.k].item()
    rules = list(input_formulas.limits(row.limits, row.whole, f"I{n}", read))
    truth = exported is True or exported is False
    value = Live(input_formulas.in_si(f"I{n}", f"C{n}", row.unit, rules, truth), exported)
    number = exported + 0 if isinstance(row.value, str) else row.value
    held = _option(row, f"B{n}") if isinstance(row.value, str) else input_formulas.read(f"B{n}")
    name = formulas.name(node) + (f" ({row.k + 1})" if node.shape else "")
    differs = Live(input_formulas.differs(f"F{n}", f"I{n}", f"J{n}"), 0.0)
    return value, shown(si(row.unit)), name, Live(held, number), number, differs


def _option(row: InputRow, cell: str) -> str:
    """Formula of the number of the option that a cell holds; of a text 0 while it is the exported one, else 1."""
    if not row.options:
        return input_formulas.differing(cell, str(row.value))
    comma = any("," in option for option in row.options)
    held = f'TRIM({cell}&"")' if comma else f'SUBSTITUTE(TRIM({cell}&""),",",".")'
    same = f"EXACT({held},{{{';'.join(map(quoted, row.options))}}})"
    return f"=IF(SUMPRODUCT(--{same})=1,SUMPRODUCT({same}*(ROW($1:${len(row.options)})-1)),NA())"


def _validation(row: InputRow, cell: str, read: dict[str, str]) -> dict[str, object]:
    """What a spreadsheet program takes into the cell of an input; a text is judged by its value in SI units."""
    if isinstance(row.value, str):
        return _of_options(row)
    rules = ",".join([f"ISNUMBER({cell})", *input_formulas.limits(row.limits, row.whole, cell, read)])
    limits = f"Limits: {row.allowed}. " if row.allowed else ""
    message = allowed(f"{row.meaning} [{shown(row.unit)}]. {limits}Decimal point, or comma as text.")
    return {
        "validate": "custom",
        "value": holding(f"IF(ISTEXT({cell}),TRUE,AND({rules}))"),
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
