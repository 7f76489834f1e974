"""The recording of a worksheet: nodes that never change, and readers that keep what they find out to themselves."""

from __future__ import annotations

from dataclasses import FrozenInstanceError
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own, recorded

from mechsheet.mechanics.rrr import rrr
from mechsheet.quantities import graph
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import UFUNCS, Quantity, lift
from mechsheet.recording.record import record
from mechsheet.recording.substitutes import instead
from mechsheet.workbook import inputs_sheet, writing
from mechsheet.worksheet import cells
from mechsheet.worksheet.table import Table

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"


@pytest.fixture(scope="module")
def names() -> dict[str, Any]:
    sheet = cells.load(HITCH)
    return sheet.run(sheet.results, {"g": sheet.inputs()})


@pytest.fixture(scope="module")
def recording(names: dict[str, Any]) -> Recording:
    return record(names)


def written(names: dict[str, Any], recording: Recording) -> bytes:
    inputs = inputs_sheet.rows(names["g"])
    tables = [value for value in names.values() if isinstance(value, Table)]
    return writing.workbook("t", inputs=inputs, found=[], tables=tables, figures=[], checks=[], recording=recording)


def every_node(recording: Recording) -> list[Node]:
    """All nodes, also those that only others rest on."""
    found = dict.fromkeys(recording.graph.nodes.values())
    waiting = [c.re for columns in recording.tables.values() for c in columns if c is not None] + list(found)
    while waiting:
        node = waiting.pop()
        found[node] = None
        waiting.extend(operand for operand in node.operands if operand not in found)
    return list(found)


def test_no_field_of_a_node_can_be_set(recording: Recording) -> None:
    node = recording.inputs["L3"]
    for field in ("op", "args", "value"):
        with pytest.raises(FrozenInstanceError):
            setattr(node, field, None)
    with pytest.raises((AttributeError, TypeError)):
        node.home = None  # type: ignore[attr-defined]


def test_no_array_of_any_node_can_be_written_to(recording: Recording) -> None:
    nodes = every_node(recording)
    assert {node.op for node in nodes} >= {"constant", "rows", "input", "found", "at", "reduce", "add", "sqrt"}
    arrays = [a for node in nodes for a in (node.value, *node.args) if isinstance(a, np.ndarray)]
    assert len(arrays) > len(nodes)
    assert not [array for array in arrays if array.flags.writeable]


@pytest.mark.parametrize("value", [np.array([1.0, 2.0]), np.array([1 + 2j, 3 - 1j])])
def test_an_array_changed_later_does_not_change_the_recording(value: Any) -> None:
    graph = Graph()
    quantity, leaf = lift(graph, value), graph.leaf("input", "x", value.real)
    before = quantity.value.copy()
    value[:] = 7
    assert np.array_equal(quantity.value, before) and np.array_equal(leaf.value, before.real)
    assert value.flags.writeable


def test_equal_operations_are_one_node() -> None:
    graph = Graph()
    x = Quantity(graph, graph.leaf("input", "x", 2.0))
    y = Quantity(graph, graph.leaf("input", "y", 2.0))
    assert (x * y + 1).re is (x * y + 1).re
    assert (x * 3).re is not (y * 3).re  # equal numbers, other quantities


def test_a_writer_leaves_the_recording_as_it_was(names: dict[str, Any], recording: Recording) -> None:
    """Two workbooks of one recording are the same, and nothing of the first one is left on it."""
    before = (dict(recording.names), dict(recording.graph.labels), len(recording.graph.nodes))
    first = written(names, recording)
    assert (dict(recording.names), dict(recording.graph.labels), len(recording.graph.nodes)) == before
    assert written(names, recording) == first
    assert written(names, record(names)) == first


def test_a_field_kept_for_its_size_is_none_of_a_statement_s_operations(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Both parts of its numbers are more than a statement may compute, as those of 30,000 rows were."""
    monkeypatch.setattr(graph, "MOST", 8)
    lines = 'P = np.exp(1j * x) * x  # [-] field\ntable_2 = table("2", "Two", x, P.real, P.imag)'
    _, recording = recorded(own(tmp_path, lines))
    assert [gap.reason for gap in recording.gaps] == ["it takes more than 8 operations on single numbers"] * 2
    assert "2" in recording.tables


def test_a_loop_of_too_many_turns_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It was said that it hands its numbers to contextlib, through which the turns of a loop are followed."""
    monkeypatch.setattr(graph, "MOST", 40)
    lines = "n = 0\nwhile n < 30 * g.F:\n    n += 1\nsteps = n * 1.0  # [-] turns"
    _, recording = recorded(own(tmp_path, lines))
    assert {gap.reason for gap in recording.gaps} == {"it takes more than 40 operations on single numbers"}


def test_what_guards_many_numbers_is_none_of_a_statement_s_operations(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ten columns of five numbers, each guarded by the branch that shows them, where a statement may compute 40."""
    monkeypatch.setattr(graph, "MOST", 40)
    lines = [f"y{k} = x * {k + 2}  # [-] line" for k in range(10)]
    shown = f'if y1.sum() > 0:\n    table_2 = table("2", "Two", {", ".join(f"y{k}" for k in range(10))})'
    _, recording = recorded(own(tmp_path, "\n".join([*lines, shown])))
    assert recording.gaps == [] and all(c is not None and c.re.op == "where" for c in recording.tables["2"])


def test_what_is_asked_for_again_is_not_made_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each time in an object of its own, in which a worksheet may set elements."""
    made = []
    rule = UFUNCS[np.sin]
    monkeypatch.setitem(UFUNCS, np.sin, lambda x: made.append(x) or rule(x))
    x = Quantity(new := Graph(), new.leaf("input", "x", np.array([1.0, 2.0])))
    first, second = np.sin(x), np.sin(x)
    assert len(made) == 1 and first is not second
    assert first.re is second.re and np.sin(x + 1).re is not first.re


def test_steps_without_names_have_them_where_the_function_is_called_again() -> None:
    """As on the other branch of an equation, whose steps no line shows, and then by the worksheet."""
    token = graph.current.set(new := Graph())
    try:
        found, L = instead(rrr), Quantity(new, new.leaf("input", "L", np.array(2.0)))
        with new.labelled({**new.labels}):
            apart = found(0j, 3 + 0j, L, L, 1)
            assert new.labels
        assert not new.labels
        again = found(0j, 3 + 0j, L, L, 1)
        assert again.re is apart.re and {label.symbol for label in new.labels.values()} >= {"q", "h"}
    finally:
        graph.current.reset(token)
