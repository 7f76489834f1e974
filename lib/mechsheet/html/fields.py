"""The inputs of a worksheet as fields of the page, and what the page must know to read them."""

from collections.abc import Container, Iterator
from html import escape
from typing import Any

from numpy.typing import NDArray

from mechsheet import units
from mechsheet.document.markup import as_written, limits, meant
from mechsheet.units import parse
from mechsheet.worksheet import numbers
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Choice, Input, Switch, number
from mechsheet.worksheet.limits import LEAST, MOST
from mechsheet.worksheet.lists import MOST_ROWS, Rows
from mechsheet.worksheet.text_line import LONGEST, TextLine


def fields(g: Any) -> str:
    """Fields with the values of the inputs ``g``, section by section; every value is text, and escaped."""
    sections: dict[str, list[str]] = {}
    known = {field.name for field in declared(type(g))}
    for field in declared(type(g)):
        sections.setdefault(field.section, []).append(_row(field, getattr(g, field.name), known))
    blocks = "".join(
        f"<fieldset><legend>{escape(section)}</legend>{''.join(rows)}</fieldset>" for section, rows in sections.items()
    )
    return f'<form class="ms-inputs" autocomplete="off">{blocks}</form>'


def _row(field: Input, value: Any, known: Container[str]) -> str:
    unit = "" if field.unit == "-" or isinstance(field, Rows) else escape(units.shown(field.unit))
    mistake = f' <span class="ms-badge ms-FAIL">mistake</span> {escape(field.mistake)}' if field.mistake else ""
    meaning = f'{meant(field.meaning, known)}{mistake} <span class="ms-limits">{_limits(field)}</span>'
    told = f'<span class="ms-meaning" id="meaning-{field.name}">{meaning}'
    return (
        f'<div class="ms-field"><label for="input-{field.name}">{as_written(field.name)}</label>'
        f'{_element(field, value)}<span class="ms-unit">{unit}</span>{told}</span>'
        f'<output class="ms-error" id="error-{field.name}" role="alert"></output></div>'
    )


def _limits(field: Input) -> str:
    columns = field.columns if isinstance(field, Rows) and field.row else (field,)
    told = {column: limits(column) for column in columns}
    return ", ".join(own if c is field else f"{as_written(_short(c))}&nbsp;{own}" for c, own in told.items() if own)


def _short(column: Input) -> str:
    return column.name.rpartition(".")[2]


def _element(field: Input, value: Any) -> str:
    """What an input is edited with: a drop-down, a check box, a grid, or a field of text."""
    told = (
        f'id="input-{field.name}" name="{field.name}" aria-describedby="meaning-{field.name} error-{field.name}" '
        'autocomplete="off"'
    )
    text = field.text(value)
    match field:
        case Choice(options=options):
            each = "".join(f"<option{' selected' * (option == text)}>{escape(option)}</option>" for option in options)
            return f"<select {told}>{each}</select>"
        case Switch():
            return f'<input type="checkbox" {told}{" checked" * bool(value)}>'
        case Rows(columns=columns):
            return f"<textarea {told} hidden>{escape(text)}</textarea>{_grid(field, columns)}"
        case TextLine():
            return f'<input type="text" {told} value="{escape(text)}">'
    return f'<input type="text" inputmode="decimal" spellcheck="false" {told} value="{escape(text)}">'


def _grid(field: Rows, columns: tuple[Input, ...]) -> str:
    """The head of a list or a table, whose rows the page puts in."""
    kinds = (' class="ms-text"' if c.is_text else "" for c in columns)
    heads = "".join(
        f"<th{kind}>{as_written(_short(c))}{'' if c.unit == '-' else escape(f' [{units.shown(c.unit)}]')}</th>"
        for c, kind in zip(columns, kinds, strict=True)
    )
    return (
        f'<div class="ms-grid" data-grid="{field.name}" tabindex="0" role="group" aria-label="{escape(field.meaning)}">'
        f"<table><thead><tr><th></th>{heads}</tr></thead><tbody></tbody></table></div>"
    )


def told(g: Any) -> dict[str, Any]:
    """What the page must know of the inputs, and of the sizes that they may have, as JSON."""
    return {"fields": list(_told(g)), "most": MOST, "least": LEAST, "rows": MOST_ROWS, "longest": LONGEST}


def _told(g: Any) -> Iterator[dict[str, Any]]:
    cls = type(g)
    for field in declared(cls):
        value = getattr(g, field.name)
        own = _number(field) | {"text": field.text(value)}
        match field:
            case Choice(options=options):
                yield own | {"kind": "choice", "options": options, "own": options.index(str(value))}
            case Switch():
                yield own | {"kind": "switch", "own": int(bool(value))}
            case TextLine():
                yield own | {"kind": "text", "own": str(value)}
            case Rows():
                columns = [_number(c) | _column(c, xs) for c, xs in field.held_by(value).values()]
                yield own | {"kind": "rows", "columns": columns}
            case _:
                yield own | {"kind": "number", "own": float(value), "shown": float(field.display(value))}


def _column(column: Input, held: NDArray[Any]) -> dict[str, Any]:
    """What a list or a column of a table holds: numbers in SI and as they are shown, or texts, each of which is 0."""
    own = held.tolist()
    return (
        {"own": [0] * len(own), "texts": own} if column.is_text else {"own": own, "shown": [*map(column.display, own)]}
    )


def _number(field: Input) -> dict[str, Any]:
    """How a number is read: its unit, its limits, whether it is whole."""
    limits = [[sign, other if other[0].isalpha() else number(other)] for sign, other in field.limits]
    return {
        "name": field.name,
        "meaning": field.meaning,
        "unit": "" if field.unit == "-" else numbers.in_text(field.unit),  # of messages
        "factor": parse(field.unit).factor,
        # By what a number in each is multiplied; nobody writes the sign of a number without a unit.
        "units": {unit: factor for unit, factor in units.convertible(field.unit).items() if unit != "-"},
        "whole": field.whole,
        "limits": limits,
    }
