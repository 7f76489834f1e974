"""Lines of a cell in the page: formula, value, unit, meaning, printed number; the formula with numbers for symbols."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from html import escape
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document.expression import equation, reads, substituted
from mechsheet.document.formula import Measure
from mechsheet.document.markup import attribute, meant, once, printed, where
from mechsheet.document.mathml import equal_to, mathml
from mechsheet.document.names import fields_by_name
from mechsheet.page import switched
from mechsheet.page.unchanged import kept
from mechsheet.worksheet import symbol
from mechsheet.worksheet.lines import Formula, Given
from mechsheet.worksheet.over import over
from mechsheet.worksheet.terms import is_rounding, may_be_rounding
from mechsheet.worksheet.typeset import Numbers, Typeset


def lines(shown: Typeset) -> str:
    """The lines as they stand in the page."""
    return "".join(
        _line(_equation(row, _single(row, shown)), line=row if row.first else None)
        if isinstance(row, Given)
        else _formula(row, value, shown)
        for row, value in zip(shown.rows, shown.values, strict=True)
    )


@lru_cache(maxsize=4096)
def _equation(line: Formula | Given, single: frozenset[str]) -> str:
    return mathml(equation(line, single))


def _single(line: Formula | Given, shown: Typeset) -> frozenset[str]:
    """Names of a line that end as a field does and have no positions."""
    return shown.numbers.single(fields_by_name(line)) if shown.numbers else frozenset()


def _formula(line: Formula, value: object, shown: Typeset) -> str:
    single = _single(line, shown)
    meaning = meant(line.meaning, shown.numbers or ())
    if not line.has_value or value is None:
        text = f'<span class="ms-value">{once(line)}</span>' if line.again else ""
        return _line(_equation(line, single) + text, meaning, line.number, mistake=line.mistake, line=line)
    text = "" if shown.numbers is None else _substituted(line, shown.numbers, shown.position)
    namespace = shown.numbers.namespace if shown.numbers else None
    cleared = _cleared(line, value, namespace)
    found = _valued(line, cleared, namespace)
    sign = "≈" if cleared is not value else "" if _is_about(found) else "="
    behind = f'<span class="ms-equals">{sign}</span><span class="ms-value">{found}</span>'
    return _line(_equation(line, single) + behind, meaning, line.number, text, line.mistake, line)


def valued(line: Formula, value: object, namespace: Mapping[str, Any] | None) -> str:
    """The value of a line, of a field also where it is least and greatest, if a namespace tells over what it is one."""
    return _valued(line, _cleared(line, value, namespace), namespace)


def _valued(line: Formula, cleared: Any, namespace: Mapping[str, Any] | None) -> str:
    text = _switched(_Value(symbol.stem(line.name), line.unit, cleared))
    if namespace is None or not isinstance(cleared, np.ndarray):
        return text
    return text + where(cleared, over(line.name, namespace), _beside)


def _beside(line: Formula, x: Any) -> str:
    return switched.beside(symbol.stem(line.name), line.unit, x)


def _is_about(shown: str) -> bool:
    """Whether a value says itself that it, or the first of its numbers, is about 0."""
    return shown.startswith("≈") or "<span>≈" in shown


def _cleared(line: Formula, value: Any, namespace: Mapping[str, Any] | None) -> Any:
    """The value itself, or 0 of one that is nothing but the rounding of what its line, or a function, adds."""
    if namespace is None:
        return value
    if is_rounding(value, line.adding, namespace) or _is_left_over(value, line, namespace):
        return np.asarray(value).dtype.type(0).item()
    return value


def _is_left_over(value: Any, line: Formula, namespace: Mapping[str, Any]) -> bool:
    if not may_be_rounding(value, line.unit) or "__file__" not in namespace:
        return False
    from mechsheet.recording.left_over import is_left_over  # on use: few lines ask for a recording

    return is_left_over(value, line, namespace)


@dataclass(frozen=True)
class _Value:
    """A value as it is shown: of what, in which unit, one or several numbers."""

    of: str
    unit: str
    numbers: Any


@kept(2048)
def _switched(value: _Value) -> str:
    return switched.quantity(value.of, value.unit, value.numbers)


def _substituted(line: Formula, known: Numbers, position: int) -> str:
    """The right side with numbers for its symbols; nothing where it has none."""
    found = ((name, known.at(name, position, line.name)) for name in reads(line))
    return _with_numbers(line, tuple((name, *at, type(at[0])) for name, at in found if at))  # 0 and 0j are not alike


@lru_cache(maxsize=2048)  # most numbers stay when an input changes
def _with_numbers(line: Formula, found: tuple[tuple[str, float | complex, str, type], ...]) -> str:
    numbers = {name: Measure(value / units.parse(unit).factor, unit) for name, value, unit, _ in found}
    node = substituted(line, numbers)
    return equal_to(node) if node else ""


def _line(
    formula: str,
    meaning: str = "",
    number: str = "",
    substituted: str = "",
    mistake: str = "",
    line: Formula | Given | None = None,
) -> str:
    """A typeset line, the printed formula's number at its end; its numbers wait in an attribute until asked for.

    The value is an element of its own: where it alone changes, the browser keeps the formula as it has set it, and the
    value is there with the output that holds it. The index leads to the line by its name, symbols
    to what they stand for.
    """
    more = f'<ms-numbers formula="{escape(substituted)}"></ms-numbers>' if substituted else ""
    told = f' <span class="ms-badge ms-FAIL">mistake</span> {escape(mistake)}' if mistake else ""
    said = f"<span>{meaning}{told}</span>" if meaning or told else ""
    said += f'<span class="ms-number">{printed(number)}</span>' if number else ""
    place = f' id="line-{line.name}"' if line and not (isinstance(line, Formula) and line.again) else ""
    place += _symbols(line) if isinstance(line, Formula) else ""
    return f'<div class="ms-line"{place}><span class="ms-formula">{formula}</span>{said}{more}</div>'


@lru_cache(maxsize=4096)
def _symbols(line: Formula) -> str:
    """Names of a line by the letters of their symbols, in an attribute; ``g.L3`` of an input."""
    names = (line.name, *reads(line))
    read = {name: symbol.read(name[2:] if name.startswith("g.") else symbol.stem(name)) for name in names}
    return attribute("data-reads", {s.base + s.index: name for name, s in reversed(read.items())})
