"""Checks of what is put together compare as many numbers as one of its parts has, and the same largest one."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import OTHER, own, recorded

from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import bottom_up
from mechsheet.readers.largest import narrow
from mechsheet.readers.numbers import numbers

LINES = """from mechsheet import check
_y = np.stack([x - g.a, g.a * x**2, np.sin(x) / (g.a - 0.2), x * 0 + 1])
_z = np.stack([x, -x, g.F + 0 * x, x - x])
_off = _y.T * 1 - _z.T * 2
named = np.concatenate([x, x**2])  # [-] has a column of its own
checks = (
    check("complex", _off[..., 0:4:2] + 1j * _off[..., 1:4:2], 1e-9, of=np.max(np.stack([abs(x), g.F + x]))),
    check("one of them", _off[..., 3], 1e9),
    check("of two lengths", np.concatenate([x, x[:2]]) * g.a, 1e9, of=np.min(np.concatenate([x, [g.a]]))),
    check("named", named - g.a, 1e9),
    check("nothing", (np.stack([0 * x, x]) * 0.0)[0], 1e9),
)
"""
ROWS = {"complex": 5, "one of them": 5, "of two lengths": 7, "named": 10, "nothing": 5}


def results(recording: Recording, inputs: dict[str, Any]) -> dict[str, Any]:
    """By check, the largest of what it compares, and its limit."""
    values = {recording.inputs[name]: value for name, value in inputs.items()}
    found = {}
    for name, check in recording.checks.items():
        known = numbers([*check.parts, check.limit], values)
        found[name] = np.max([np.max(np.abs(known[part])) for part in check.parts]), known[check.limit]
    return found


@pytest.mark.filterwarnings("ignore:.*encountered")
def test_a_check_has_the_same_largest_number_of_fewer(tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, LINES))
    before = [results(recording, inputs) for inputs in ({}, *OTHER, {"a": 0.2})]
    narrow(recording)
    after = [results(recording, inputs) for inputs in ({}, *OTHER, {"a": 0.2})]
    for old, new in zip(before, after, strict=True):
        assert new.keys() == old.keys() == ROWS.keys()
        for name in old:
            assert np.array_equal(new[name], old[name], equal_nan=True), name
    assert np.isnan(before[-1]["complex"][0]) or np.isinf(before[-1]["complex"][0]), "where there is no number"
    rows = {name: sum(part.size for part in check.parts) for name, check in recording.checks.items()}
    assert all(rows[name] <= ROWS[name] for name in ROWS) and rows["complex"] == 5
    under = [*bottom_up([node for c in recording.checks.values() for node in (*c.parts, c.limit)], ())]
    assert {node for node in under if node.op == "join"} <= {*recording.names}, "of these each row has a formula"
