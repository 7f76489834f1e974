"""Numbers and axes whose unit is switched on the page: each with what it is in the others that measure the same.

The elements that carry them are shown by ``units.js``.
"""

from collections.abc import Callable, Sequence
from functools import cache
from math import isfinite
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document.chart import Chart, ticks
from mechsheet.document.markup import HTML
from mechsheet.page.script import element
from mechsheet.worksheet import numbers
from mechsheet.worksheet.numbers import Notation
from mechsheet.worksheet.table import Column, Figure

Numbers = list[float | str]
UNIT = "<ms-unit>{}</ms-unit>"  # on which one clicks
_ALONE = HTML._replace(unit="\u00a0{}", percent="\u00a0%")  # a unit stands in the line of its number
_SWITCHED = _ALONE._replace(degrees=UNIT.format(HTML.degrees), unit=_ALONE.unit.format(UNIT))


def offered(unit: str) -> dict[str, str]:
    """Other units in which a number may be shown, by how they are printed; none for a pure number."""
    return {_printed(other): other for other in units.alike(unit)[1:] if "-" not in (unit, other)}


@cache  # of names alone: what a unit of one's own measures may change
def _printed(unit: str) -> str:
    return units.shown(unit)


def value(of: str, unit: str, text: Callable[[str, Notation], str]) -> str:
    """HTML that ``text`` gives in a unit and a notation; it follows the unit that is chosen for what it shows."""
    texts = {label: text(other, _SWITCHED) for label, other in offered(unit).items()}
    if not texts:
        return text(unit, _ALONE)
    return element("ms-value", f"<span>{text(unit, _SWITCHED)}</span>", of=of, unit=_printed(unit), texts=texts)


def beside(of: str, unit: str, x: Any) -> str:
    """HTML of an SI value in a unit, which follows the one that is chosen where the quantity itself is shown."""
    texts = {label: numbers.value(x, other, HTML) for label, other in offered(unit).items()}
    text = numbers.value(x, unit, HTML)
    return element("ms-value", f"<span>{text}</span>", of=of, unit=_printed(unit), texts=texts) if texts else text


def quantity(of: str, unit: str, values: Any) -> str:
    """HTML of SI values in a unit, which follows the unit that is chosen; few numbers are written anew by the page."""
    field = np.asarray(values)
    if not offered(unit) or not numbers.in_full(field):
        return value(of, unit, numbers.in_any_unit(field))
    parts = [field.real, field.imag] if field.dtype.kind == "c" else [field]
    told = [
        part.ravel().tolist() if np.isfinite(part).all() else [str(x).replace("inf", "Infinity") for x in part.flat]
        for part in parts
    ]
    text = f"<span>{numbers.value(field, unit, _SWITCHED)}</span>"
    return element("ms-value", text, of=of, unit=_printed(unit), units=_units(unit), si=told, shape=field.shape)


def _units(unit: str) -> dict[str, tuple[float, str]]:
    """Factors of the other units, and how they stand behind a number."""
    return {label: (units.parse(o).factor, numbers.behind(o, _SWITCHED)) for label, o in offered(unit).items()}


def columns(shown: Sequence[Column], table: str) -> str:
    """HTML of a table, whose columns follow the units that are chosen for what they show."""
    told = [_column(column) if _switches(column) else None for column in shown]
    return element("ms-columns", table, columns=told) if any(told) else table


def chart(figure: Figure, layout: Chart, picture: str) -> str:
    """HTML of a chart, whose axes and values under the pointer follow the units that are chosen for what they show.

    The curves stay where they are: an axis keeps its ends and has round ticks in the other unit, which is that of its
    first quantity for which another one is chosen. An axis of quantities in several units stays as it is.
    """
    axes = [_axis(layout, up, on) for up, on in enumerate(([figure.x], figure.lines))]
    told = [_column(column) if _switches(column) else None for column in (figure.x, *figure.lines)]
    return element("ms-axes", picture, axes=axes, columns=told) if any(axes) else picture


def _axis(layout: Chart, up: int, on: Sequence[Column]) -> dict[str, Any] | None:
    unit, of = on[0].unit, [column.of for column in on if column.of]
    if not of or not offered(unit) or any(column.unit != unit for column in on):
        return None
    made = {label: ticks(layout, bool(up), unit, other) for label, other in offered(unit).items()}
    return {
        "of": of,
        "unit": _printed(unit),
        "ticks": {label: {"at": t.at, "texts": t.texts, "unit": t.unit, "axis": t.axis} for label, t in made.items()},
    }


def _switches(column: Column) -> bool:
    return bool(column.of and offered(column.unit))


def numbers_of(column: Column) -> Numbers | None:
    """Numbers of a column whose unit is switched, in its own; texts where there is none."""
    return _numbers(column) if _switches(column) else None


def _numbers(column: Column) -> Numbers:
    return [x if isfinite(x) else numbers.fixed(x, 0, numbers.AXIS) for x in column.values.tolist()]


def _column(column: Column) -> dict[str, Any]:
    known = {_printed(column.unit): column.unit, **offered(column.unit)}
    return {
        "of": column.of,
        "unit": _printed(column.unit),
        "units": {label: units.parse(unit).factor for label, unit in known.items()},
        "decimals": column.decimals,
        "power": column.power,
        "values": _numbers(column),
    }
