"""The formula of a text with recorded numbers and texts of inputs in it."""

import re
from collections.abc import Callable

from mechsheet.quantities.node import Node
from mechsheet.quantities.written import Either, Number, OneOf, Piece, Written
from mechsheet.workbook.cell_formula import written
from mechsheet.workbook.content import quoted

_DECIMALS = r"(\+?)(,?)(?:d|\.(\d{1,2})f)"  # of a number that a cell writes as Python does
_UNKNOWN = '"…"'


def text_formula(text: Written, reference: Callable[[Node], str], typed: Callable[[str], str]) -> str:
    """Its pieces joined, by the ``reference`` of a quantity and the cells in which the texts of a column are ``typed``.

    A number in a format that no cell writes stands there for the exported inputs; for others, as for one that does not
    exist, there is a sign.
    """

    def piece(part: Piece) -> str:
        match part:
            case str():
                return quoted(part)
            case Number(value, spec, instead):
                cell, digits = reference(value.re), re.fullmatch(_DECIMALS, spec)
                if digits and not instead:
                    sign, comma, decimals = digits.groups()
                    fixed = f"FIXED({cell},{decimals or 0},{'FALSE' if comma else 'TRUE'})"
                    return known(f'IF(LEFT({fixed})="-","","+")&{fixed}' if sign else fixed)
                return known(f"IF({cell}={written(value.re.value.item())},{quoted(part.now())},{_UNKNOWN})")
            case Either(holds, then, otherwise):
                return known(f"IF({reference(holds.re)},{whole(then)},{whole(otherwise)})")
            case OneOf(at, texts, None):
                return known(f"CHOOSE({reference(at.re)}+1,{','.join(map(quoted, texts))})")
            case OneOf(at, name=name):
                return known(f"INDEX({typed(name)},{reference(at.re)}+1)")

    def known(text: str) -> str:
        return f"IFERROR({text},{_UNKNOWN})"

    def whole(text: Written) -> str:
        return "&".join(map(piece, text.parts)) or '""'

    return whole(text)
