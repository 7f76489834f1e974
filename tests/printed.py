"""Printed numbers of the source documents: digits as printed, half the last digit as tolerance."""

import csv
from decimal import Decimal
from pathlib import Path

REFERENCE = Path(__file__).parent / "reference"


def rows(name: str) -> list[dict[str, str]]:
    """Rows of a reference table, numbers as the printed texts."""
    with (REFERENCE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def half_last_digit(printed: str) -> float:
    exponent = Decimal(printed).as_tuple().exponent
    assert isinstance(exponent, int)
    return 0.5 * 10.0**exponent


def agrees(value: float, printed: str) -> bool:
    """Whether a value rounds to the printed digits; a rounding tie counts, so does a unit of noise in it."""
    return abs(value - float(printed)) <= half_last_digit(printed) * (1 + 1e-9)
