"""Formulas of a typed input: the number that its cell holds, and that number in SI units while it is allowed."""

import math
from collections.abc import Iterator, Mapping, Sequence

from mechsheet.units import parse, shown
from mechsheet.workbook.cell_formula import written
from mechsheet.workbook.content import quoted
from mechsheet.worksheet.kinds import number
from mechsheet.worksheet.limits import LEAST, MOST

_LETTERS = '"0123456789.,+-−eE"'  # of a number as text


def read(cell: str) -> str:
    """The number that a cell holds: a number, or a text with a decimal comma or point."""
    text = f"TRIM({cell})"
    strange = f"SUMPRODUCT(--ISERROR(FIND(MID({text}&REPT(0,40),ROW($1:$40),1),{_LETTERS})))"
    plain = f'SUBSTITUTE(SUBSTITUTE({text},"−","-"),",",".")'
    held = f'IF(AND(LEN({text})>0,LEN({text})<=40,{strange}=0),IFERROR(_xlfn.NUMBERVALUE({plain},"."," "),NA()),NA())'
    return f"=IF(ISLOGICAL({cell}),NA(),IF(ISNUMBER({cell}),{cell},{held}))"


def in_si(as_read: str, unit_cell: str, unit: str, rules: Sequence[str], truth: bool = False) -> str:
    """The number ``as_read`` in SI units, or whether it is 1; none in another unit, or where a rule does not hold."""
    units = dict.fromkeys([unit, shown(unit), *([""] if unit == "-" else [])])
    same = ",".join(f"EXACT(TRIM({unit_cell}),{quoted(text)})" for text in units)
    factor = parse(unit).factor
    scaled = "" if factor == 1 else "*PI()/180" if factor == math.pi / 180 else f"*{factor!r}"
    holds = ",".join([f"OR({same})", f"ABS({as_read})<={written(MOST)}", *rules])
    return f"=IF(AND({holds}),{as_read}{'=1' if truth else scaled},NA())"


def differs(in_si: str, as_read: str, as_exported: str) -> str:
    """1 where an input is not the exported one, else 0."""
    return f"=IF(ISERROR({in_si}),1,IF({as_read}={as_exported},0,1))"


def differing(cell: str, text: str) -> str:
    """0 while a cell holds a text, else 1."""
    return f'=IF(EXACT({cell}&"",{quoted(text)}),0,1)'


def limits(pairs: Sequence[tuple[str, str]], whole: bool, value: str, others: Mapping[str, str]) -> Iterator[str]:
    """Conditions for a ``value``; ``others`` are the cells of the inputs that limit it, several of those of a list."""
    for sign, other in pairs:
        cells = others.get(other, "")
        if (sign, other) == (">", "0"):
            yield f"{value}>={written(LEAST)}"
        elif ":" in cells:
            yield f"SUMPRODUCT(--NOT({value}{sign}{cells}))=0"
        else:
            yield f"{value}{sign}{cells or written(number(other))}"
    if whole:
        yield f"{value}=INT({value})"
