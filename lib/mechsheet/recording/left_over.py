"""What rounding leaves of what a worksheet's functions add, for which a line alone tells no terms."""

from collections.abc import Mapping
from typing import Any

from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.terms import terms_of
from mechsheet.recording.record import record
from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import Formula


def is_left_over(value: Any, line: Formula, namespace: Mapping[str, Any]) -> bool:
    """Whether the value of a line is none but roundings of what it and all functions behind it add.

    The cells behind it are recorded for that, which takes one or some hundredths of a second.
    """
    try:
        found = record(namespace, every=1, want=[line.name]).values.get(line.name)
    except (SheetError, NotRecorded):
        return False
    return isinstance(found, Quantity) and numbers.is_rounding(value, terms_of(found, ()).value)
