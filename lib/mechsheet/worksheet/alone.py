"""Numbers of inputs that stand without a unit and are taken in SI, where their line shows them in another unit."""

from mechsheet.units import parse, si
from mechsheet.worksheet import numbers

# Beyond these a number is hardly meant in SI by somebody who reads it in such a unit: 400 N in kN, 42 m in mm, 20 rad.
_LARGE = 1e3  # of a unit that many times that of SI or more, less than one of it
_SMALL, _MOST = 0.02, 5.0  # of one that is no more than so much of that of SI, so many of SI


def taken(text: str, unit: str) -> str:
    """How the number is taken, and what to write where it is meant otherwise.

    >>> taken("42", "%"), taken("0.62", "%")
    ('42 is taken as it stands: write 42 / 100', '0.62 is taken as it stands, and a limit in %, such as <= 100')
    """
    if unit == "%" and abs(float(text)) <= 1:
        return f"{text} is taken as it stands, and a limit in %, such as <= 100"
    if unit == "%":  # which is no name in Python
        return f"{text} is taken as it stands: write {text} / 100"
    return f"{text} is taken in {numbers.in_text(si(unit))}: write {text} * {unit}"


def unlikely(text: str, unit: str) -> str:
    """What is to be told of a number that is hardly meant as it is taken; "" of any other.

    >>> unlikely("42", "mm")
    '42000 mm; 42 is taken in m: write 42 * mm, or 42 * m where that is meant'
    >>> unlikely("210e3", "MPa")
    '0.21 MPa; 210e3 is taken in Pa: write 210e3 * MPa, or 210e3 * Pa where that is meant'
    >>> unlikely("0.042", "mm"), unlikely("50e3", "kN"), unlikely("0", "kN")
    ('', '', '')
    """
    size, factor = abs(float(text)), parse(unit).factor
    if not (factor >= _LARGE and 0 < size < factor) and not (factor <= _SMALL and size >= _MOST):
        return ""
    meant = "" if si(unit) == "-" else f", or {text} * {si(unit)} where that is meant"
    return f"{numbers.amount(float(text), unit)}; {taken(text, unit)}{meant}"
