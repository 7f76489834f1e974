"""Loops of more steps than Python's calls may stand in one another: whoever follows their numbers does it without."""

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from as_script import as_script
from own_worksheet import own, recorded

from mechsheet import evaluate
from mechsheet.html import write
from mechsheet.quantities import graph
from mechsheet.readers.numbers import numbers
from mechsheet.readers.terms import Terms
from mechsheet.worksheet.errors import SheetError

STEPS, CALLS = 300, 260  # of calls in one another Python takes 1000: with fewer, fewer steps tell as much
LINES = f"""
from mechsheet import closed_form
N = {STEPS}
v, y, w, n, far, u = 0.0, g.F, x, x, g.F * 1e-320, np.array([g.F])
q = find(lambda q: q * g.a, 0, 10, equals=g.F)
again = g.F / g.a
for _ in range(N):
    v = v - g.a * y * 1e-3
    y = y + v * 1e-3
    w = w - g.a * w * 1e-3
    n = n - x / N
    again = again + g.a - g.a
for _ in range(60):
    far = far + far
for _ in range(N):
    u = np.append(u, [u[-1] * 1.0001])
closed_form(q, again)
ends = np.array([y, u.max(), q.value])  # [-] a motion, the greatest of a list, and what is found
field = w * 1  # [-] a motion of each position
left = n * 1  # [-] nothing but rounding
none = np.array([far - g.F * 1e-320 * 2.0**60])  # [-] the same, of what doubles
table_2, table_3 = table("2", "Ends", ends), table("3", "Fields", field, left)
table_4 = table("4", "Nothing", none)"""


@pytest.fixture
def few_calls() -> Iterator[None]:
    most = sys.getrecursionlimit()
    sys.setrecursionlimit(CALLS)
    yield
    sys.setrecursionlimit(most)


def test_loop_of_many_steps_is_followed_by_every_reader(few_calls: None, tmp_path: Path) -> None:
    """The recording, the workbook, the dimensions, the proof and the page in one file."""
    sheet = own(tmp_path, LINES, further=['export("Own", globals())'])
    _, recording = recorded(sheet)
    assert not recording.gaps
    columns = [column.re for number in ("2", "3") for column in recording.tables[number] if column is not None]
    known = numbers(columns, {recording.inputs["F"]: 3.25})
    expected = evaluate(sheet.path, ["ends", "field"], F=3.25)
    for column, name in zip(columns, expected, strict=False):
        np.testing.assert_allclose(known[column], expected[name], rtol=1e-12)
    run = as_script(sheet.path, "--proof=9", f"--out={tmp_path}")
    assert not run.stderr and "not followed" not in run.stdout and (tmp_path / "own.xlsx").exists(), run
    assert 'id="line-left"' in write.page(sheet, sheet.inputs())


SET = """
M = {}
p = np.zeros(M + 1)  # [-] way
q = np.full((M // 8 + 1, 2), g.a)
p[0], q[:, 1] = g.F, g.a
for i in range(M):
    p[i + 1] = p[i] - 1e-3 * g.a * p[i]
for i in range(M // 8):
    q[i + 1] = q[i, 0] * 0.99, q[i, 0] - 1e-3 * g.a * q[i, 1]
ends = np.array([p[-1], p.min(), q[-1, 0], q[0].sum(), q[:, 1].max()])  # [-] of a motion in arrays of their length
table_2 = table("2", "Motion", p, every=100)
table_3 = table("3", "Ends", ends)"""


@pytest.mark.parametrize("steps", ["1200", "g.n * 240"])
def test_arrays_whose_elements_are_set_one_by_one_are_followed(steps: str, tmp_path: Path) -> None:
    """Each was a new one made of the last: of 1200 elements these were more operations than a line may have."""
    _, recording = recorded(own(tmp_path, SET.replace("{}", steps)))
    assert not recording.gaps
    (column,) = recording.tables["3"]
    known = numbers([column.re], {recording.inputs["F"]: 3.25, recording.inputs["a"]: 0.9})[column.re]
    expected = evaluate(tmp_path / "own.py", ["ends"], F=3.25, a=0.9)["ends"]
    np.testing.assert_allclose(known, expected, rtol=1e-12)
    whole = [node for node in recording.graph.nodes.values() if node.op == "join" and node.size > 1000]
    assert not any(source.op == "join" for node in whole for source in node.args[0]), "they are no chain"


def test_steps_that_use_the_last_one_more_than_once_are_walked_once(tmp_path: Path) -> None:
    """Of sixty steps that name it thrice there are 3**60 ways down, and one step of each."""
    root = "z = g.F\nfor _ in range(60):\n    z = z - (z * z - 2.0) / (2 * z)\ny = z / g.a  # [-] of a root"
    recording = recorded(own(tmp_path, root))[1]
    wanted = [recording.values["y"].re]
    assert np.isnan(numbers(wanted, {recording.inputs["a"]: 0.0})[wanted[0]])


def test_formula_that_is_too_deep_to_be_read_is_refused_at_its_line(tmp_path: Path) -> None:
    deep = " + ".join(f"{n} * g.F" for n in range(600))
    with pytest.raises(SheetError, match=r"own.py, line 38: 60\d operations in one another, and 300 are read"):
        own(tmp_path, f"y = g.a\nz = {deep}")


def test_the_page_of_many_lines_over_many_positions_is_written(tmp_path: Path) -> None:
    """What is said of the rounding of one takes as many operations as the line itself; a limit is that of one line."""
    lines = [f"x_{k} = 0.5 * x_{k - 1} + g.F * np.sin(x) + x - 1  # [-] line {k}" for k in range(1, 12)]
    sheet = own(tmp_path, "x_0 = x * 1  # [-] first\n" + "\n".join(lines))
    page = write.page(sheet, sheet.inputs(n=40_000))
    assert all(f"line {k}" in page for k in range(1, 12))


def test_page_is_written_of_steps_whose_terms_are_more_than_are_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a motion adds is told to the end, else by its last sums, else by itself."""
    steps = "p, q = g.F, g.a\nfor _ in range(100):\n    p = p - g.a * q * 1e-3\n    q = q + g.F * p * 1e-3"
    factors = "r = g.F\nfor _ in range(500):\n    r = r * (1 - 1e-3 * g.a)"
    sheet = own(tmp_path, f"{steps}\ny = (p - q) * 1  # [-] two motions\n{factors}\nz = r * 1  # [-] factors")
    monkeypatch.setattr(graph, "_NODES", 1500)  # fewer tell as much
    assert 'id="line-y"' in write.page(sheet, sheet.inputs())
    for name, deep in (("y", True), ("z", True), ("z", False)):
        value = recorded(sheet)[1].values[name]
        value.graph.work = 0
        with pytest.raises(graph.NotRecorded):
            Terms(value.graph).of(value, deep)
    y, z = (recorded(sheet)[1].values[name] for name in "yz")
    assert Terms(y.graph).recorded(y).value > abs(y.value) and Terms(z.graph).recorded(z).value == abs(z.value)
