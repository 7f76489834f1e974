"""Whole worksheets as scripts of a page: every number is the worksheet's own, whatever the inputs are."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from in_browser import evaluated
from test_random_scenes import scene
from test_recalculation import whole

from mechsheet import units
from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.numbers import numbers
from mechsheet.recording.record import record
from mechsheet.recording.solving import listed
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import Choice
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Table

if TYPE_CHECKING:
    from playwright.sync_api import Page

ROOT = Path(__file__).resolve().parents[1] / "worksheets"
DOCUMENTS = ("hitch", "landing_gear", "slotted_link", "kinetostatics", "joint")
EXAMPLES = ("examples/bucket", "examples/engine", "examples/bolted_joint")
SCENES = 4
EPS = np.finfo(float).eps
_AS_LARGE = ["add", "sub", "neg", "abs", "max", "min", "take", "join", "reduce", "where", "like", "sized"]


@pytest.mark.parametrize("name", [*DOCUMENTS, *EXAMPLES])
def test_every_number_is_the_worksheets_own(name: str, blank: Page) -> None:
    sheet = cells.load(ROOT / f"{name}.py")
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    recording = record(names, sheet)
    wanted = shown(recording, names)
    script = javascript.module(recording, wanted)
    scenes = [
        *itertools.chain([({}, names)], runs(sheet, of_rows(recording) + others(sheet)), random_runs(name, sheet))
    ]
    given = [in_si(sheet.inputs, own["g"]) for _, own in scenes]
    wrong = list[str]()
    recorded = values_of(recording, names)  # some checks are recorded in a form of their own, which is compared alone
    followed = {
        key for key, node in wanted.items()
        if key in recorded and (greatest(recorded[key]) or not key.startswith("check"))
        and not difference(compared(key, node.value), recorded[key], 1e6 * greatest(recorded[key]))
    }  # fmt: skip
    for (changes, own), si, found in zip(scenes, given, evaluated(blank, script, given), strict=True):
        assert changes or not (found["gaps"] or found["guards"])
        known = numbers(wanted.values(), {recording.inputs[key]: x for key, x in si.items()})
        expected, sizes = values_of(recording, own), made_of(wanted.values(), known)
        for key, node in wanted.items():
            value = found["values"][key]
            if value is None:
                assert found["gaps"][key]
                continue
            reader, size = known[node], sizes[node]
            if key not in followed:
                text = difference(value, reader, size)
            else:  # the recording's steps may keep fewer digits than the library's functions: as few as Python's reader
                text = difference(compared(key, value), expected[key], size)
                if text and not difference(compared(key, reader), expected[key], 1e4 * greatest(expected[key])):
                    text = difference(value, reader, size)
            if text:
                wrong.append(f"{changes} {key}: {text}")
    assert not wrong


def runs(sheet: cells.Worksheet, scenes: Iterable[dict[str, Any]]) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """What the worksheet has at changed inputs, but for those that it refuses."""
    for changes in scenes:
        try:
            g = inputs.build(sheet.inputs, whole(sheet.inputs, changes))
            yield changes, {**sheet.run(sheet.results, {"g": g}), "__file__": sheet.path, "g": g}
        except SheetError:
            continue


def random_runs(name: str, sheet: cells.Worksheet) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    random = Random(name)
    scenes = (scene(sheet, random) for _ in range(20 * SCENES))
    ordered = (changes for changes in scenes if not any(key.startswith("gas.phi") for key in changes))
    return itertools.islice(runs(sheet, ordered), SCENES)  # interpolation of abscissas out of order means nothing


def shown(recording: Recording, names: Mapping[str, Any]) -> dict[str, Node]:
    """What a worksheet shows, by keys: columns of tables, lines, and what checks compare.

    How often equations are evaluated is told by rounding, and left out.
    """
    columns = {f"table {number} {n}": column for number, columns in recording.tables.items()
               for n, column in enumerate(columns) if column is not None and "Fig" not in number}  # fmt: skip
    lines = {f"line {name}": x for name in registry(names) if isinstance(x := recording.values.get(name), Quantity)}
    wanted = {f"{key} {part}": node for key, x in (columns | lines).items() for part, node in enumerate(x.parts)}
    for name, check in recording.checks.items():
        wanted |= {f"check {name} {k}": part for k, part in enumerate(check.parts)}
        wanted[f"limit {name}"] = check.limit
    return {key: node for key, node in wanted.items() if not any(map(_counts, bottom_up([node], ())))}


def _counts(node: Node) -> bool:
    return node.op == "found" and not node.args[0].single and node.args[1] == len(node.args[0].starts)


def values_of(recording: Recording, names: Mapping[str, Any]) -> dict[str, Any]:
    """What the worksheet itself has under these keys, in SI."""
    own = dict[str, Any]()
    for value in (v for group in names.values() for v in (group if isinstance(group, tuple | list) else [group])):
        if isinstance(value, Table):
            own |= {f"table {value.number} {n} 0": c.values * units.parse(c.unit).factor
                    for n, c in enumerate(value.columns) if c.unit}  # fmt: skip
        elif isinstance(value, Check) and value.name in recording.checks:
            factor = units.parse(recording.checks[value.name].unit).factor
            own |= {f"check {value.name} 0": value.residual * factor, f"limit {value.name}": value.limit * factor}
    for name in registry(names):
        if isinstance(x := recording.values.get(name), Quantity):
            values = listed(recording.graph, names[name])
            own |= {
                f"line {name} {k}": part for k, part in enumerate((values.real, values.imag)[: 1 + (x.im is not None)])
            }
    return own


def of_rows(recording: Recording) -> list[dict[str, Any]]:
    """Another number of rows, one at a time."""
    rows = [node.args[0] for node in recording.graph.nodes.values() if node.op == "rows"]
    names = {node: name for name, node in recording.inputs.items()}
    counts = {
        names[node]: int(node.value) for node in bottom_up(rows, ()) if node in names and node.value.dtype.kind == "i"
    }
    return [{name: count + 3} for name, count in counts.items()]


def others(sheet: cells.Worksheet) -> list[dict[str, Any]]:
    """Another option of each choice, one at a time."""
    default = sheet.inputs()
    choices = [field for field in inputs.declared(sheet.inputs) if isinstance(field, Choice)]
    return [{field.name: next(o for o in field.options if o != getattr(default, field.name))} for field in choices]


def in_si(cls: type, g: Any) -> dict[str, Any]:
    fields = inputs.declared(cls)
    return {name: x for field in fields for name, (_, x) in field.leaves(getattr(g, field.name)).items()}


def made_of(wanted: Iterable[Node], known: Mapping[Node, Any]) -> dict[Node, float]:
    """The largest number of which each quantity is a sum or difference, over all that it rests on."""
    size = dict[Node, float]()
    for part in bottom_up(wanted, ()):
        values = [known.get(n, n.value) for n in (part, *part.operands)]
        own, under = greatest(values[0]), [size[operand] for operand in part.operands]
        match part.op:
            case "mul":
                own = max(own, under[0] * greatest(values[2]), under[1] * greatest(values[1]))
            case "div":
                least = np.min(np.abs(values[2] + 0.0), initial=np.inf)
                own = max(own, under[0] / least) if least else own
            case "pow" if part.args[1].size == 1:
                own = max(own, under[0] ** max(float(values[2]), 0.0))
            case "sqrt":
                own = max(own, under[0] ** 0.5)
            case (
                "add" | "sub" | "neg" | "abs" | "max" | "min" | "take" | "join" | "reduce" | "where" | "like" | "sized"
            ):
                own = max([own, *under])
        size[part] = own
    return size


def compared(key: str, value: Any) -> Any:
    """What the worksheet has: of the parts of a check the largest."""
    return np.max(value) if key.startswith("check") else value


def greatest(values: Any) -> float:
    x = np.abs(np.asarray(values) + 0.0)
    return float(np.max(x, initial=0.0, where=np.isfinite(x)))


def difference(value: Any, expected: Any, terms: float) -> str:
    """What differs by more than 1e-12 of the largest in the column, or by more than rounding of what it is made of."""
    b = np.asarray(expected) + 0.0
    a = np.broadcast_to(value, b.shape) + 0.0 if np.size(value) == 1 or np.ndim(value) < b.ndim else value + 0.0
    if a.shape != b.shape:
        return f"{a.shape} numbers, the worksheet has {b.shape}"
    if not np.array_equal(np.isfinite(a), np.isfinite(b)):
        return f"{np.count_nonzero(np.isfinite(a))} numbers, the worksheet has {np.count_nonzero(np.isfinite(b))}"
    with np.errstate(invalid="ignore"):
        off = greatest(a - b)
    return f"{off / greatest(b) if greatest(b) else off:.1e}" if off > 1e-12 * greatest(b) + 64 * EPS * terms else ""
