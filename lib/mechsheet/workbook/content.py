"""What stands in a cell of a workbook: a text, a number to its last bit, an error value, or a formula and its value."""

import math
import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from mechsheet.worksheet.table import Figure, Table


class Live(NamedTuple):
    """Content of a cell: a formula, and the value that the worksheet has for it."""

    formula: str
    value: float | str


Content = str | float | Live
LARGEST = 1e307  # stands for an infinite number; Excel's end at 9.99e307
_PART = 100  # letters of a text in a formula, whose 255 units a quotation mark takes two of


def computed(formulas: Sequence[str] | None, values: Sequence[float]) -> Sequence[Content]:
    """Values with their formulas where they have some."""
    return [Live(*pair) for pair in zip(formulas, values, strict=True)] if formulas else values


class _Exact(float):
    """A float stored to its last bit, for XlsxWriter formats numbers with 16 digits, one too few."""

    def __format__(self, spec: str) -> str:
        return float.__repr__(self)


def put(sheet: Any, row: int, col: int, value: Content, style: Any) -> None:
    """A text as a text, a number as a number, NaN as #N/A; a text of nothing leaves the cell empty."""
    if isinstance(value, Live):
        known = value.value
        if isinstance(known, float) and not fits(known):
            known = "#N/A"
        sheet.write_live(row, col, value.formula, style, known)
    elif value == "":
        sheet.write_empty(row, col, None, style)
    elif isinstance(value, str):
        sheet.write_text(row, col, allowed(value), style)
    elif fits(value):
        sheet.write_exact(row, col, value if isinstance(value, int) else _Exact(value), style)
    else:
        # XlsxWriter has no cell of an error alone; the formula that is this error keeps it as its value.
        error = "#N/A" if math.isnan(value) else "#NUM!"
        sheet.write_live(row, col, error, style, error)


def holding(condition: str) -> str:
    """A condition in a rule of formats or of what is typed, which does not hold where it is an error.

    A formula with a name as files have it XlsxWriter takes as it stands; it looks in any other for 150 functions.
    """
    return f"=_xlfn.IFNA({condition},FALSE)"


def quoted(text: str) -> str:
    """A text in a formula, in parts of a length that Excel takes."""
    parts = [allowed(text[at : at + _PART]).replace('"', '""') for at in range(0, len(text), _PART)]
    return "&".join(f'"{part}"' for part in parts) or '""'


def fits(value: float) -> bool:
    """Whether Excel can hold the number; it has no NaN."""
    return abs(value) <= LARGEST


def allowed(text: str) -> str:
    """Text that a cell can hold: characters that XML forbids are shown as �.

    XlsxWriter takes ``<r>..</r>`` for markup of its own, so a space is put before it.
    """
    if text.isprintable() and not text.startswith("<r>"):
        return text
    text = re.sub("[\x00-\x08\x0b-\x1f\x7f\ud800-\udfff\ufffe\uffff]", "�", text)
    return f" {text}" if text.startswith("<r>") else text


def cut(text: str, units: int) -> str:
    """The beginning of a text that has at most so many UTF-16 units, as Excel counts them."""
    return text.encode("utf-16-le")[: 2 * units].decode("utf-16-le", "ignore").rstrip("' ")


def caption(kind: str, numbered: Table | Figure) -> str:
    """Kind, number and title: ``Table 4.1 - Lifting capacity``."""
    return allowed(f"{kind} {numbered.number} - {numbered.title}")
