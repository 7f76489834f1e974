"""Whether lines of a cell give numbers that belong to other inputs than those that they stand under."""

from pathlib import Path
from typing import Any

import numpy as np
from by_cells import by_cells
from own_worksheet import ELSEWHERE, own, recorded

from mechsheet import evaluate
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.numbers import numbers


def assert_never_stale(lines: str, tmp_path: Path) -> None:
    """What lines of a cell make of inputs is read rightly for others, or is no number, and something says why.

    What is asked for again, recorded another time, is read rightly too where Python sees something of what is followed.
    """
    more = 'result = np.atleast_1d(y) * 1  # [-] line\ntable_2 = table("2", "Two", result)\nalone = y  # [-] line'
    sheet = own(tmp_path, f"{lines}\n{more}")
    names, recording = recorded(sheet)
    if "2" not in recording.tables:  # it has other numbers at each run, so it holds for the exported inputs alone
        assert any("random" in lines and gap.line for gap in recording.gaps)
        return
    (column,) = recording.tables["2"]
    followed = 0
    for given in ELSEWHERE:
        told = recording.gaps or [guard for guard in recording.guards.values() if guard.rows <= ("n" in given)]
        values = names["table_2"].columns[0].values
        if column is not None:
            known = numbers([column.re], {recording.inputs[name]: float(x) for name, x in given.items()})
            values = known[column.re]
        asked = given in ELSEWHERE[:3] and any(not guard.rows for guard in recording.guards.values())
        if np.isnan(values).all() and told and not asked:
            continue
        try:
            expected = by_cells(sheet.path, ["result"], **given)["result"]
        except Exception:  # the worksheet itself has no number for these inputs
            expected = np.array(np.nan)
        else:
            if asked:
                found = evaluate(sheet.path, ["result"], **given)["result"]
                np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-13, err_msg=f"again {given}")
        if np.isnan(values).all() and (told or np.isnan(expected).all()):
            continue
        assert values.shape == expected.shape, given
        assert_shown_alone(recording, given, expected)
        np.testing.assert_allclose(values, expected, rtol=1e-12, atol=1e-13, err_msg=str(given))
        followed += 1
    assert followed, "not even for the inputs that it was recorded with"


def assert_shown_alone(recording: Recording, given: dict[str, Any], expected: Any) -> None:
    """A line that is no table's has these numbers too, or none, whatever Python makes of them: a list, a tuple."""
    value = recording.values.get("alone")
    if isinstance(value, Quantity):
        known = numbers(value.parts, {recording.inputs[name]: float(x) for name, x in given.items()})
        found = known[value.re]
    elif value is None or recording.looked.get("alone"):  # it is not known for other inputs
        return
    else:
        found = np.asarray(value)
    if not np.isnan(found).all():
        np.testing.assert_allclose(np.atleast_1d(found), expected, rtol=1e-12, atol=1e-13, err_msg=f"alone {given}")
