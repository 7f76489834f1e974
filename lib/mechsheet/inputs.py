"""Input data: declared once in a class, asked for in the page, replaced by scenes and arguments."""

import ast
import dataclasses
import difflib
import html
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar, dataclass_transform

import numpy as np

from mechsheet import formula, scene, source, symbol, units
from mechsheet.errors import SheetError, refuse

if TYPE_CHECKING:
    import marimo as mo

T = TypeVar("T")
_LIMIT = re.compile(r"(<=|>=|<|>)\s*(\S+)")
_MOST = 1e60  # products of a few inputs of this size are still numbers
_COMPARE = {"<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal}


@dataclass(frozen=True)
class Input:
    """One declared input; ``limits`` are pairs such as (">", "0") or ("<", "S_max"), in the display unit."""

    name: str
    unit: str
    meaning: str
    section: str
    whole: bool
    limits: tuple[tuple[str, str], ...]

    def display(self, value: Any) -> Any:
        """Value in the display unit, the rounding of the conversion taken back."""
        if self.whole or np.ndim(value):
            return value
        return float(f"{value / units.parse(self.unit).factor:.15g}")

    def si(self, value: float) -> float | int:
        """SI value of a number in the display unit."""
        return int(value) if self.whole else value * units.parse(self.unit).factor

    def says(self, value: object) -> str:
        """The input as an error names it: meaning, symbol, value and unit."""
        return f"{self.meaning} {self.name} = {value}" + (f" {self.unit}" if self.unit != "-" else "")


@dataclass_transform(frozen_default=True)
def inputs(cls: type[T]) -> type[T]:
    """Make a class of lines ``X01: float = 0.415  # [m] meaning; > 0`` the frozen, validated inputs of a worksheet.

    Comments alone on a line are section headings; after ``;`` stand limits, against numbers in the
    display unit or other inputs. Values are SI and radians. Arrays serve as variants.

    Building one with a value that is no finite number or breaks a limit raises SheetError naming it.
    """
    frame = sys._getframe(1)
    cls.__inputs__ = _declared(cls.__name__, source.cell(frame))  # type: ignore[attr-defined]
    cls.__worksheet__ = str(frame.f_globals.get("__file__", ""))  # type: ignore[attr-defined]
    cls.__post_init__ = _validate  # type: ignore[attr-defined]
    return dataclass(frozen=True)(cls)


def declared(cls: type) -> tuple[Input, ...]:
    """Inputs of a class made by `inputs`, in their order."""
    fields: tuple[Input, ...] = cls.__inputs__  # type: ignore[attr-defined]
    return fields


def _declared(name: str, cell: source.Cell) -> tuple[Input, ...]:
    body = next(node for node in cell.body if isinstance(node, ast.ClassDef) and node.name == name)
    found, section, line = [], "", body.lineno
    for node in body.body:
        between = [cell.comments[n] for n in range(line + 1, node.lineno) if n in cell.comments]
        section, line = between[-1] if between else section, node.end_lineno or node.lineno
        if not isinstance(node, ast.AnnAssign):
            continue
        field = ast.unparse(node.target)
        text = formula.declared(cell.comments.get(line, ""), cell.at(line))
        if text is None:
            raise SheetError(f"{cell.at(line)}: input {field} needs a comment with its unit, such as # [m] meaning")
        unit, (meaning, _, limits) = text[0], text[1].partition(";")
        whole = ast.unparse(node.annotation) == "int"
        found.append(Input(field, unit, meaning.strip(), section, whole, tuple(_LIMIT.findall(limits))))
    return tuple(found)


def _validate(self: Any) -> None:
    fields = {field.name: field for field in declared(type(self))}
    shown = {name: field.display(getattr(self, name)) for name, field in fields.items()}
    for name, field in fields.items():
        value = shown[name]
        size = np.abs(np.asarray(value, dtype=float))
        if not np.all(np.isfinite(size)):
            raise SheetError(f"{field.says(value)} must be a finite number")
        if not np.all(size <= _MOST):
            raise SheetError(f"{field.says(value)} must be at most {_MOST:g} in size")
        for sign, other in field.limits:
            limit = shown[other] if other in shown else float(other)
            if not np.all(_COMPARE[sign](value, limit)):
                must = "positive" if (sign, other) == (">", "0") else f"{sign} {other}"
                raise SheetError(f"{field.says(value)} must be {must}{f' = {limit}' if other in shown else ''}")
            if (sign, other) == (">", "0") and not np.all(size >= 1 / _MOST):
                raise SheetError(f"{field.says(value)} must be at least {1 / _MOST:g}")


def number(text: object) -> float:
    """Number written with a decimal point or comma; ValueError for anything else.

    >>> number("0,415"), number("1.75e7")
    (0.415, 17500000.0)
    """
    if isinstance(text, bool) or not re.fullmatch(r"\s*[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?\s*", str(text)):
        raise ValueError(f"{text!r} is no number")
    return float(str(text).replace(",", "."))


def build(cls: type[T], values: Mapping[str, object]) -> T:
    """Inputs with some values replaced, given as texts or numbers in display units.

    Raises SheetError naming an unknown input with the nearest known ones, a text that is no number, or
    a value outside its limits.
    """
    fields, given = {field.name: field for field in declared(cls)}, {}
    for name, value in values.items():
        if name not in fields:
            near = difflib.get_close_matches(name, fields, n=3, cutoff=0.5)
            raise SheetError(f"input {name} is unknown; nearest: {', '.join(near or fields)}")
        field = fields[name]
        try:
            x = number(value)
        except ValueError:
            raise SheetError(f"{field.says(repr(value))} is no number") from None
        if field.whole and not x.is_integer():
            raise SheetError(f"{field.says(value)} must be a whole number")
        default = getattr(cls, name)
        given[name] = default if x == field.display(default) else field.si(x)
    return cls(**given)


def text(field: Input, value: Any) -> str:
    """Value in the display unit as a text field shows it."""
    return f"{field.display(value):.15g}"


def ask(cls: type) -> "mo.ui.batch":
    """Text fields for all inputs, section by section, with the defaults or what arguments and scenes give."""
    import marimo as mo

    g: Any = build(cls, scene.arguments(cls.__worksheet__).inputs)  # type: ignore[attr-defined]
    sections: dict[str, list[str]] = {}
    fields = {}
    for field in declared(cls):
        limits = ", ".join(f"{_SIGNS.get(sign, sign)}&nbsp;{_limit(other)}" for sign, other in field.limits)
        unit = "" if field.unit == "-" else units.shown(field.unit)
        sections.setdefault(field.section, []).append(
            f'<tr><td style="padding-right:.5em">{symbol.html(field.name)}</td><td>{{{field.name}}}</td>'
            f'<td style="padding-left:.4em">{html.escape(unit)}</td>'
            f'<td style="padding-left:.7em;line-height:1.2">{html.escape(field.meaning)}'
            f'<span style="opacity:.5;padding-left:.6em">{limits}</span></td></tr>'
        )
        fields[field.name] = mo.ui.text(value=text(field, getattr(g, field.name)), debounce=True)
    blocks = "".join(
        f'<div style="break-inside:avoid"><b>{html.escape(section)}</b><table>{"".join(rows)}</table></div>'
        for section, rows in sections.items()
    )
    style = "columns:28em;column-gap:2em;font-size:.93em"
    template = f'<div class="ms-inputs" style="{style}">{blocks}</div>'
    form = mo.Html(template).batch(**fields)
    # Shown without the element of the batch round them: a field tells of its change itself, and the batch told of it
    # again, so that the whole sheet ran twice.
    form._text = template.format(**{name: field.text for name, field in form.elements.items()})
    return form


def read(cls: type[T], form: "mo.ui.batch") -> T:
    """Inputs as the text fields of ``form`` hold them, checked as in `build`."""
    values: dict[str, object] = form.value
    try:
        return build(cls, values)
    except SheetError as error:
        refuse(error)


_SIGNS = {"<": "&lt;", ">": "&gt;", "<=": "≤", ">=": "≥"}


def _limit(text: str) -> str:
    return symbol.html(text) if text[0].isalpha() else text


@dataclass(frozen=True)
class Used:
    """The values that a worksheet really uses, shown in their display units."""

    g: Any

    def rows(self) -> list[tuple[Input, Any]]:
        """Each input with its value in the display unit."""
        return [(field, field.display(getattr(self.g, field.name))) for field in declared(type(self.g))]

    def _mime_(self) -> tuple[str, str]:
        changed = {f.name for f in dataclasses.fields(self.g) if getattr(self.g, f.name) != f.default}
        items, rows, section = [], [], ""
        for field, value in self.rows():
            unit = "" if field.unit == "-" else html.escape(units.shown(field.unit))
            weight = "bold" if field.name in changed else "normal"
            name = symbol.html(field.name)
            shown = f"{name}&nbsp;=&nbsp;{value:.10g}&nbsp;{unit}"
            items.append(f'<span style="white-space:nowrap;font-weight:{weight}">{shown}</span>')
            if field.section != section:
                section = field.section
                rows.append(f'<tr><th colspan="4" style="text-align:left">{html.escape(section)}</th></tr>')
            rows.append(
                f'<tr style="font-weight:{weight}"><td>{name}</td>'
                f'<td style="text-align:right;padding:0 .5em">{value:.10g}</td>'
                f'<td style="padding-right:1em">{unit}</td><td>{html.escape(field.meaning)}</td></tr>'
            )
        style = "display:flex;flex-wrap:wrap;gap:.2em 1.6em;font-size:.9em"
        return "text/html", (
            f'<div class="ms-screen" style="{style}">{"".join(items)}</div>'
            f'<table class="ms-print" style="display:none">{"".join(rows)}</table>'
        )
