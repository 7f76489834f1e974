"""What statements read: names that other cells have too are no ties; and what is not followed behind lines is told."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own, recorded, value_of

from mechsheet import evaluate, sweep
from mechsheet.html import write as html
from mechsheet.quantities.graph import Graph, current
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording import raised, statement
from mechsheet.recording.record import record_every_line
from mechsheet.worksheet import cells
from mechsheet.worksheet.errors import SheetError


@pytest.mark.parametrize(
    ("line", "read"),
    [
        ("f = lambda x, y=x: x * g.a + z", {"g", "x", "z"}),
        ("f = lambda x: x * g.a", {"g"}),
        ("def f(x, k=n):\n    w = x * k\n    return w * q", {"n", "q"}),
        ("def f(*x, k, **w):\n    return x, k, w, q", {"q"}),
        ("def f():\n    global s\n    s = 1\n    return s", {"s"}),
        ("def f(a):\n    def h(b):\n        return a + b + c\n    return h", {"c"}),
        ("r = sum(x**2 for x in x if x > b)", {"sum", "x", "b"}),
        ("r = [[i * j for j in range(i)] for i in v]", {"range", "v"}),
        ("r = {k: v for k, v in d.items()}", {"d"}),
        ("r = (y := x) + y", {"x", "y"}),
    ],
)
def test_parameters_and_other_names_of_functions_are_not_read(line: str, read: set[str]) -> None:
    (node,) = ast.parse(line).body
    assert statement.facts(node, "own.py").loaded == read


def recording_of(sheet: cells.Worksheet) -> Recording:
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    return record_every_line({**names, "__file__": sheet.path}, sheet)


OTHERS = {
    "function": "def area(w):\n    return w**2 * g.a\nr = area(g.F)  # [-] line",
    "lambda": "area = lambda w: w**2 * g.a\nr = area(g.F)  # [-] line",
    "attribute": "from types import SimpleNamespace as S\nf = lambda p: p.w * g.a\nr = f(S(w=2.0))  # [-] line",
    "sum": "r = sum(w**2 for w in [g.F, g.a])  # [-] line",
    "list": "r = np.sum(np.array([w * g.a for w in (1, 2)]))  # [-] line",
    "key": "r = max([g.F, g.a], key=lambda w: -w)  # [-] line",
}
LOOP = (
    "acc = 0.0\nfor w in (g.F, 1.0):\n    if f'{w:.0f}' > '3':\n        continue\n    acc += w\nq = acc  # [-] of some"
)


@pytest.mark.parametrize("lines", OTHERS.values(), ids=OTHERS)
def test_a_parameter_of_one_cell_is_no_loop_variable_of_another(lines: str, tmp_path: Path) -> None:
    """The loop goes another way for other inputs; the lines that use its name for something of their own do not."""
    sheet = own(tmp_path, "pass", further=[LOOP, lines])
    recording = recording_of(sheet)
    assert np.isnan(value_of(recording, "q", {"F": 4.0})), "which goes another way"
    expected = sheet.run(["r"], {"g": sheet.inputs(F=4.0)})["r"]
    np.testing.assert_allclose(value_of(recording, "r", {"F": 4.0}), expected, rtol=1e-13)


BEHIND = {
    "name without unit": "q = np.sort_complex([g.F, g.a]).real\nr = q[0] * 2  # [-] line",
    "private name": "_q = np.sort_complex([g.F, g.a]).real\nr = _q[0] * 2  # [-] line",
    "function": "q = np.sort_complex([g.F, g.a]).real\nf = lambda v: q[0] * v\nr = f(2.0)  # [-] line",
    "changed": "q = np.zeros(2)\nq[:] = np.sort_complex([g.F, g.a]).real\nr = q[0] * 2  # [-] line",
    "error handled": "try:\n    q = sqrt(0.5 - g.a)\nexcept ValueError:\n    q = 7.0\nr = q * 2  # [-] line",
}


@pytest.mark.parametrize("lines", BEHIND.values(), ids=BEHIND)
def test_what_is_not_followed_behind_a_line_that_nothing_else_shows_is_told(lines: str, tmp_path: Path) -> None:
    recording = recording_of(own(tmp_path, "pass", further=[f"{lines}\nz = np.sort_complex([g.F]).imag"]))
    assert recording.gaps, "no reason is told"
    assert not any("z" in gap.names for gap in recording.gaps), "no line rests on that"


BY_HAND = """T = [(1.0, 2.0), (2.0, 3.5), (4.0, 5.0)]
for (x0, y0), (x1, y1) in zip(T, T[1:]):
    if x0 <= g.F <= x1:
        y_F = y0 + (y1 - y0) * (g.F - x0) / (x1 - x0)
        break
r = y_F  # [-] between two rows"""


def test_a_name_that_no_way_binds_for_some_inputs_is_told_there_and_costs_the_others_nothing(tmp_path: Path) -> None:
    sheet = own(tmp_path, "pass", further=[BY_HAND])
    swept = sweep(sheet.path, ["r"], {"F": [3.0, 9.0, 1.5]})
    np.testing.assert_allclose(swept["r"], [4.25, np.nan, 2.75])
    reason = "r = y_F: y_F has no value there: none of the ways that the lines above it went gives it one"
    assert [text.partition(", ")[2].partition(", ")[2] for text in swept.reasons] == ["", reason, ""]
    with pytest.raises(SheetError, match="y_F has no value there"):
        evaluate(sheet.path, ["r"], F=9.0)


def test_a_name_that_nothing_binds_is_a_mistake_whatever_the_inputs_are(tmp_path: Path) -> None:
    sheet = own(tmp_path, "pass", further=["r = 2 * y_F  # [-] line"])
    with pytest.raises(NameError):
        sweep(sheet.path, ["r"], {"F": [3.0, 9.0]})


@pytest.mark.filterwarnings("error")
def test_what_a_function_holds_under_a_name_is_not_known_where_another_way_sets_it(tmp_path: Path) -> None:
    """It was as it is here: a wrong number of inputs for which the function is called, and nothing said so."""
    lines = "def h():\n    h.k = 1.0\n    return g.F\nh.k = 5.0\ny = h() if g.F > 5 else g.F  # [-] y\n"
    _, recording = recorded(own(tmp_path, f"{lines}z = 2 * g.F * h.k  # [-] z"))
    assert value_of(recording, "z", {"F": 3.25}) == 32.5 and np.isnan(value_of(recording, "z", {"F": 6.0}))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("changes", ["[row.sort() for row in rows]", "{k: v.sort() for k, v in enumerate(rows)}"])
def test_a_way_that_changes_something_is_not_gone_to_see_what_it_gives(changes: str, tmp_path: Path) -> None:
    """Nor in a comprehension, which from Python 3.12 on is called no more: the line was not recorded."""
    lines = f"rows = [[3.0, 1.0], [2.0, 5.0]]\ndef h():\n    {changes}\n    return g.F\n"
    _, recording = recorded(own(tmp_path, f"{lines}y = h() if g.F > 5 else g.F * rows[0][0]  # [-] y"))
    assert not recording.gaps
    assert value_of(recording, "y", {"F": 3.25}) == 9.75 and np.isnan(value_of(recording, "y", {"F": 6.0}))


def test_ways_that_are_not_gone_raise_no_warning_of_the_page(tmp_path: Path) -> None:
    sheet = own(
        tmp_path, "r = 1 / (g.n - 5) if g.n != 5 else 9.0  # [-] line\ns = exp(1e3 * g.F) if g.F > 9 else 1  # [-] e"
    )
    assert len(html.page(sheet, sheet.inputs())) > 1000


@pytest.mark.parametrize(("fills", "told"), [("v[k + 1] = w", True), ("v.append(w)", False)], ids=["set", "append"])
def test_of_an_array_that_takes_too_much_to_be_filled_the_list_is_told(fills: str, told: bool, tmp_path: Path) -> None:
    first = "v = np.zeros(20_001)\nv[0] = g.F" if told else "v = [g.F]"
    lines = f"{first}\nfor k in range(500):\n    w = v[k] - 1e-3 * g.a * v[k]\n    {fills}\ny = v[-1]  # [-] last"
    recording = recording_of(own(tmp_path, "pass", further=[lines]))
    assert ["a list that is appended to is not" in gap.reason for gap in recording.gaps] == [True] * told


@pytest.mark.parametrize(("file", "looked"), [("own.py", 1), (raised.__file__, 0)], ids=["worksheet", "library"])
def test_errors_that_the_library_handles_are_no_ways_of_the_worksheet(file: str, looked: int) -> None:
    graph, names = Graph(), dict[str, Any]()
    exec(compile("def made(tried, x):\n    return tried(x)", file, "exec"), names)
    token = current.set(graph)
    try:
        x = 1 / Quantity(graph, graph.leaf("input", "a", 2.0))
        assert names["made"](raised.tried, x) is x and len(graph.looked) == looked
    finally:
        current.reset(token)


def test_of_names_that_a_line_binds_at_once_each_is_followed_alone(tmp_path: Path) -> None:
    """Unless they change places: then what the line reads is what was there before it."""
    lost = "np.sort_complex([g.F, g.a]).real[0]"
    recording = recording_of(own(tmp_path, "pass", further=[f"q, v, w = {lost}, g.F * 2, {lost}\nr = v  # [-] line"]))
    assert value_of(recording, "r", {"F": 4.0}) == 8
    assert [gap.names for gap in recording.gaps] == [("q", "w")]
    recording = recording_of(own(tmp_path, "pass", further=["v, w = g.F, g.a\nv, w = w, v\nr = v - w  # [-] line"]))
    assert value_of(recording, "r", {"F": 4.0}) == 0.75 - 4
    lines = "v = 1.0\ndef f():\n    return v * g.F * 3\nv, w = 2.0, f()\nr = w  # [-] of the first"
    recording = recording_of(own(tmp_path, "pass", further=[lines]))
    assert value_of(recording, "r", {"F": 4.0}) == 12
