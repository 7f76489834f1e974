"""A worksheet recorded: its cells run again with quantities that remember what is done with them."""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph
from mechsheet.recording.lines import Recording
from mechsheet.recording.quantity import Quantity
from mechsheet.recording.stage import Stage
from mechsheet.recording.substitutes import substituted
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, read
from mechsheet.worksheet.checks import Check
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Figure, Table


@lru_cache(maxsize=8)
def _own(path: str, changed: int) -> Worksheet:
    """Cells of a worksheet with shared names of their own, which the recording replaces."""
    return read(Path(path))


def record(namespace: Mapping[str, Any]) -> Recording:
    """Run the cells behind the tables, found values and checks of ``namespace`` with recorded quantities.

    A cell that does something for which a workbook has no formula keeps its numbers; `Recording.left_out` says why.
    Where all tables list every so many positions, only those are recorded.
    """
    path = Path(namespace["__file__"]).resolve()
    sheet = _own(str(path), path.stat().st_mtime_ns)
    listed = {value.every for value in namespace.values() if isinstance(value, Table)}
    every = listed.pop() if len(listed) == 1 else 1
    graph = Graph(every)
    g: Any = object.__new__(sheet.inputs)
    known = {}
    for declared in inputs.declared(sheet.inputs):
        value = getattr(namespace["g"], declared.name)
        known[declared.name] = graph.leaf("input", declared.name, float(value))
        object.__setattr__(g, declared.name, Quantity(graph, known[declared.name]))
    recording = Recording(graph, known, every=every)
    names = substituted(sheet.common, graph)
    names["g"] = g
    givers = [(c, n) for c in sheet.cells for n in c.gives]
    want = [n for _, n in givers if _shown(namespace.get(n))]
    known_lines = registry(namespace)
    recording.sections = list(dict.fromkeys(cell.section for cell in sheet.cells))
    for cell in sheet.needed(want, {"g": g}):
        stage = Stage(recording, namespace, cell)
        names |= stage.replacements()
        try:
            with np.errstate(all="ignore"):  # the worksheet's own run has warned
                exec(cell.code, names)
            stage.compare(names)
        except Exception as error:
            recording.left_out[cell.name] = str(error) or type(error).__name__
            stage.numbers(names, cell.gives)
        for name in dict.fromkeys([*(n for n in cell.code.co_names if n in known_lines), *cell.gives]):
            recording.define(cell.section, name, names.get(name), known_lines)
        for solved in stage.solved:
            recording.define_steps(cell.section, solved)
    return recording


def _shown(value: Any) -> bool:
    group = value if isinstance(value, tuple | list) else [value]
    return any(isinstance(v, Table | Figure | Check | Found) for v in group)
