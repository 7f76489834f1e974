"""Solve blocks of one line, in loops and functions, or taken as a number at once, are followed each by itself."""

from pathlib import Path

import numpy as np
import pytest
from by_cells import by_cells
from own_worksheet import OTHER, own, recorded, value_of

from mechsheet.readers.numbers import numbers
from mechsheet.readers.searched import search

CUBE = "find(lambda v: v**3 - {}, 0, 3)"
LINES = {
    "at once": f"y = {CUBE.format('g.F')}.value",
    "two of the same words": f"s = {CUBE.format('g.F')}\nt = find(lambda v: v**2 - g.F, 0, 3)\ny = s.value - t.value",
    "a comprehension": f"y = np.array([{CUBE.format('f')}.value for f in (g.F, 2 * g.F)])",
    "a loop": f"y = 0.0\nfor f in (g.F, 2 * g.F):\n    y = y + {CUBE.format('f')}.value",
    "alike now": f"y = np.array([{CUBE.format('f')}.value for f in (g.F, g.F**2 / 2.5, 2.5)])",
    "a function": f"def root(f):\n    s = {CUBE.format('f')}\n    return 2 * s.value\ny = root(g.F) - root(2 * g.a)",
    "a list of verdicts": f"found = [{CUBE.format('f')} for f in (g.F, 2 * g.F)]\ny = found[0].value + found[1].value",
    "a field": f"y = {CUBE.format('x')}.value",
    "a branch": "y = find(lambda v, s: s * v**3 - g.F, -3, 3, branch=-1, branches=(-1, 1)).value",
    "two unknowns": "y = find(lambda u, v: (u * v - g.F, u - v - g.a), u=1.5, v=1.0).value.u",
    "least squares": "y = minerr(lambda u: (u - g.F, u - g.a), u=1.0).value.u",
    "what is left": f"y = {CUBE.format('g.F')}.residual + find(lambda v: v**2 - g.F, 0, 3).value",
}


@pytest.mark.parametrize("lines", LINES.values(), ids=LINES)
def test_what_no_name_holds_the_verdict_of_is_found_again(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, "from mechsheet import minerr\n" + lines)
    _, recording = recorded(sheet)
    search(recording)
    assert not recording.gaps and bool(recording.unsolved) == ("minerr" in lines)
    blocks = {solved.node.args[0] for solved in recording.found.values()}
    assert len(blocks) == (3 if "2.5)" in lines else 1 + (lines.count("find(") > 1 or "2 *" in lines))
    for given in OTHER:
        own_value = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_allclose(value_of(recording, "y", given), own_value, rtol=1e-12, atol=1e-13)
        inputs = {recording.inputs[name]: x for name, x in given.items()}
        for solved in recording.found.values():  # as the cells find it
            known = numbers([solved.node, solved.inverse or solved.node], inputs)
            x, cells = known[solved.node], known[solved.inverse or solved.node]
            assert np.allclose(x, cells, rtol=1e-9, equal_nan=False) or np.isnan(cells).any()
