"""The inputs of a worksheet as fields of the page, and its sliders."""

import html
from collections.abc import Container
from pathlib import Path
from typing import Any
from uuid import uuid4

import marimo as mo

from mechsheet import units
from mechsheet.document.markup import as_written, limits, meant
from mechsheet.page.script import element, script
from mechsheet.worksheet import scene
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import build, declared
from mechsheet.worksheet.kinds import Choice, Input, Switch
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.numbers import on_page
from mechsheet.worksheet.title import Slider


def _told(field: Input) -> str:
    """Why the unit of a field is not known."""
    return f' <span class="ms-badge ms-FAIL">mistake</span> {html.escape(field.mistake)}' if field.mistake else ""


def _short(column: Input) -> str:
    return column.name.rpartition(".")[2]


def head(column: Input) -> dict[str, str]:
    """A column of a grid: its full name, its heading with the unit, the same without markup, and its kind."""
    unit = "" if column.unit == "-" else f" [{units.shown(column.unit)}]"
    head = as_written(_short(column)) + html.escape(unit)
    kind = "text" if column.is_text else "number"
    return {"name": column.name, "head": head, "label": _short(column) + unit, "kind": kind}


class _Fields(mo.ui.batch):
    """Fields in a template, with the element of the batch, which tells of their changes, out of sight beside it."""

    def __init__(self, template: str, fields: "dict[str, Any]") -> None:
        self.template = template
        super().__init__(mo.Html(""), fields)

    @property
    def text(self) -> str:
        shown = self.template.format(**{name: field.text for name, field in self.elements.items()})
        return f"{shown}<div hidden>{super().text}</div>"


def _element(field: Input, value: Any) -> Any:
    """What an input is edited with: a drop-down, a check box, or a field of text."""
    match field:
        case Choice(options=options):
            return mo.ui.dropdown(options, value=field.text(value))
        case Switch():
            return mo.ui.checkbox(value=value)
        case Rows():
            return mo.ui.text_area(value=field.text(value), debounce=True)
    return mo.ui.text(value=field.text(value), debounce=True)


def _grid(field: Rows, value: Any) -> str:
    """The grid that is shown for the text area behind it."""
    columns = [head(column) for column in field.columns]
    grid = element("ms-grid", columns=columns, text=field.text(value), made=uuid4().hex)
    return _in_template(grid)


def _in_template(text: str) -> str:
    """HTML as a template has it, in which braces stand round the names of fields."""
    return text.replace("{", "{{").replace("}", "}}")


def fields(g: Any) -> "mo.ui.batch":
    """Fields with the values of the inputs ``g``, section by section."""
    sections: dict[str, list[str]] = {}
    texts, known = {}, {field.name for field in declared(type(g))}
    for field in declared(type(g)):
        value = getattr(g, field.name)
        unit, grid = "" if field.unit == "-" else html.escape(units.shown(field.unit)), ""
        measured = f'</td><td style="padding-left:.4em">{unit}'
        if isinstance(field, Rows):
            grid, measured = _grid(field, value), ""
        sections.setdefault(_in_template(html.escape(field.section)), []).append(
            f'<tr><td style="padding-right:.5em">{as_written(field.name)}</td>'
            f'<td data-input="{field.name}"{" colspan=2" * bool(grid)}>{grid}{{{field.name}}}{measured}</td>'
            f'<td style="padding-left:.7em;line-height:1.2">{_in_template(said(field, known))}</td></tr>'
        )
        texts[field.name] = _element(field, value)
    blocks = "".join(
        f'<div style="break-inside:avoid"><b>{section}</b><table>{"".join(rows)}</table></div>'
        for section, rows in sections.items()
    )
    style = "columns:28em;column-gap:2em;font-size:.93em"
    states = _in_template(element("ms-states", of=type(g).__name__.lower(), scenes=_scenes(type(g))))
    template = f'<div class="ms-inputs" style="{style}">{blocks}</div><div class="ms-screen">{states}</div>'
    return _Fields(script("grid.js") + script("inputs.js", "given.js") + template, texts)


def _scenes(cls: type) -> list[dict[str, Any]]:
    """Scenes beside the worksheet: of each the texts of the inputs that it gives, or why it cannot be used."""
    own, found = {field.name: field for field in declared(cls)}, list[dict[str, Any]]()
    worksheet: str = cls.__worksheet__  # type: ignore[attr-defined]
    for path in scene.beside(Path(worksheet)):
        if scene.is_of(path.read_text(encoding="utf-8-sig", errors="replace"), own):
            try:
                given = scene.load(path).inputs
                g: Any = build(cls, given)
                found.append({"name": path.stem, "texts": {name: own[name].text(getattr(g, name)) for name in given}})
            except SheetError as error:
                found.append({"name": path.stem, "why": on_page(str(error))})
    return found


def said(field: Input, known: Container[str] = ()) -> str:
    """Meaning of an input, with the ``known`` names in it as symbols, a mistake in its unit, and its limits."""
    told = limits(field)
    if isinstance(field, Rows) and field.row:
        told = ", ".join(f"{as_written(_short(c))}&nbsp;{limits(c)}" for c in field.columns if c.limits)
    return f'{meant(field.meaning, known)}{_told(field)}<span style="opacity:.5;padding-left:.6em">{told}</span>'


def slider(value: Slider) -> "mo.ui.slider":
    """The slider as an element of the page, with its position beside it."""
    return mo.ui.slider(
        value.start, value.stop, value.step, value=value.value, label=html.escape(label(value)), show_value=True
    )


def label(value: Slider) -> str:
    """What a slider moves, with its unit."""
    return value.label if value.unit == "-" else f"{value.label} [{units.shown(value.unit)}]"
