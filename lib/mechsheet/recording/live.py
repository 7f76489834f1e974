"""The formulas of a workbook: the cells of a worksheet run again with quantities that record what is done with them.

Every line that a table, a check or a found value rests on gets a cell of its own and a defined name. A quantity over
the positions is a column, and its name means the cell of the same row, so that a formula reads the same in all rows.
"""

import ast
import math
import re
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.recording.recorded import Node, NotRecorded, Recorded, Recorder, takes
from mechsheet.worksheet import formula, inputs, symbol
from mechsheet.worksheet.cells import Cell, Worksheet, read
from mechsheet.worksheet.checks import Check
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.table import Figure, Table

_ADDRESS = re.compile(r"[A-Za-z]{1,3}\d+|[rR]\d*([cC]\d*)?|[cC]\d*|[rR]\d+[cC]\d+")
_HEADING = re.compile(r"^def (\w+)\(|^\s*## +(.+)$", re.MULTILINE)
_RISKY = {"SQRT", "ASIN", "ACOS", "ATAN2", "LN", "/", "^", "MOD"}  # may be an error value
_WRITTEN = {"__post_init__"}  # the only special method of a group that is not made by `dataclass`
_INLINE = 6  # operations that a formula repeats rather than give them a cell


class Names:
    """Defined names of a workbook.

    The rule: a quantity keeps the name that it has in the worksheet, without the ``_S`` of a field; a point or a
    vector has one for each coordinate, ``P56`` X56 and Y56, ``R56`` R56x and R56y. A name that is the address of
    a cell (``L3``), or that another quantity has already, small and capital letters taken as the same, gets a
    line behind it: ``L3_``.
    """

    def __init__(self) -> None:
        self.taken: set[str] = set()

    def new(self, name: str) -> str:
        while _ADDRESS.fullmatch(name) or name.lower() in self.taken:
            name += "_"
        self.taken.add(name.lower())
        return name


@dataclass
class Line:
    """One quantity behind the tables: where it is defined, and where its numbers stand."""

    node: Node
    symbol: str
    unit: str
    meaning: str
    text: str = ""


@dataclass
class Residual:
    """What a check compares, in SI: the largest of some magnitudes, or one signed number, with its limit."""

    parts: list[Node]
    limit: Node
    unit: str
    signed: bool = False


@dataclass
class Solved:
    """A found value: its closed form where there is one, what it leaves of its equation, and its interval."""

    node: Node
    residual: Node | None
    interval: tuple[Node, Node] | None
    inverse: Node | None = None


@dataclass
class Recording:
    """The quantities of a worksheet, cell by cell, and what it shows of them."""

    recorder: Recorder
    inputs: dict[str, Node]
    tables: dict[str, tuple[Recorded | None, ...]] = field(default_factory=dict)
    checks: dict[str, Residual] = field(default_factory=dict)
    found: dict[str, Solved] = field(default_factory=dict)
    lines: dict[str, list[Line]] = field(default_factory=dict)
    marks: dict[str, dict[str, Node]] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    every: int = 1
    sections: list[str] = field(default_factory=list)


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
    recorder = Recorder(every)
    g: Any = object.__new__(sheet.inputs)
    known = {}
    for declared in inputs.declared(sheet.inputs):
        value = getattr(namespace["g"], declared.name)
        known[declared.name] = recorder.leaf("input", declared.name, float(value))
        object.__setattr__(g, declared.name, Recorded(recorder, known[declared.name]))
    recording = Recording(recorder, known, every=every)
    names = _replaced(sheet.common, recorder)
    names["g"] = g
    givers = [(c, n) for c in sheet.cells for n in c.gives]
    want = [n for _, n in givers if _shown(namespace.get(n))]
    known_lines = formula.registry(namespace)
    sections = _sections(path.read_text(encoding="utf-8"))
    recording.sections = list(dict.fromkeys(sections.values()))
    for cell in sheet.needed(want, {"g": g}):
        stage = _Stage(recorder, recording, namespace, cell)
        names |= stage.replacements()
        try:
            exec(cell.code, names)
            stage.compare(names)
        except Exception as error:
            recording.left_out[cell.name] = str(error) or type(error).__name__
            stage.numbers(names, cell.gives)
        section = sections.get(cell.name, "")
        for name in dict.fromkeys([*(n for n in cell.code.co_names if n in known_lines), *cell.gives]):
            _define(recording, section, name, names.get(name), known_lines)
        for solved in stage.solved:
            lines = recording.lines.setdefault(section, [])
            for node in (solved.inverse, solved.residual):
                if node and not node.name:
                    _steps_of(node, solved.node.name, lines, set())
    return recording


def _shown(value: Any) -> bool:
    group = value if isinstance(value, tuple | list) else [value]
    return any(isinstance(v, Table | Figure | Check | Found) for v in group)


def _sections(text: str) -> dict[str, str]:
    """Heading of the section, by the name of the cell."""
    found, cell, section = {}, "", ""
    for match in _HEADING.finditer(text):
        if match[1]:
            cell = match[1]
            found[cell] = section
        else:
            section = match[2].strip()
            found[cell] = section
    return found


def _replaced(common: Mapping[str, Any], recorder: Recorder) -> dict[str, Any]:
    """Shared names with the library's and numpy's functions exchanged for those that take recorded quantities."""
    steps = _steps()

    def instead(value: Any) -> Any:
        original = getattr(value, "__recorded__", value)
        if value is np or isinstance(value, _Numpy):
            return _Numpy(recorder)
        if isinstance(original, np.ufunc) or (callable(original) and _of_numpy(original)):
            function = takes(original, recorder)
            function.__recorded__ = original  # type: ignore[attr-defined]
            return function
        if callable(original) and original in steps:
            function = _either(original, steps[original])
            function.__recorded__ = original  # type: ignore[attr-defined]
            return function
        if isinstance(original, type) and original in _groups():
            return _group(original, instead)
        return value

    for name, value in common.items():
        if not name.startswith("__"):
            common[name] = instead(value)  # type: ignore[index]
    return {**common, "float": lambda x: x if isinstance(x, Recorded) else float(x)}


def _of_numpy(value: Any) -> bool:
    return (getattr(value, "__module__", None) or "").partition(".")[0] == "numpy" and not isinstance(value, type)


@cache
def _steps() -> Mapping[Any, Callable[..., Any]]:
    from mechsheet.recording.elementary import STEPS  # imported on use: needs all of the mechanics

    return STEPS


@cache
def _groups() -> frozenset[type]:
    from mechsheet.recording.elementary import GROUPS  # as above

    return GROUPS


def _group(kind: type, instead: Callable[[Any], Any]) -> type:
    """A group of the mechanics whose methods call what takes recorded quantities."""
    module = vars(sys.modules[kind.__module__])
    names = {name: value if isinstance(value, type) else instead(value) for name, value in module.items()}

    def own(method: Any) -> Any:
        if isinstance(method, property):
            return property(own(method.fget))
        return FunctionType(method.__code__, names, method.__name__, method.__defaults__, method.__closure__)

    written = {name: value for name, value in vars(kind).items() if not name.startswith("__") or name in _WRITTEN}
    methods = {name: own(value) for name, value in written.items() if isinstance(value, FunctionType | property)}
    return type(kind.__name__, (kind,), {**methods, "__recorded__": kind})


def _either(original: Callable[..., Any], steps: Callable[..., Any]) -> Callable[..., Any]:
    known: dict[Any, Any] = {}

    def function(*args: Any, **kwargs: Any) -> Any:
        if not _recorded((args, kwargs)):
            return original(*args, **kwargs)
        if kwargs or any(isinstance(a, list | tuple | np.ndarray) for a in args):
            return steps(*args, **kwargs)
        key = tuple((id(a.re), id(a.im)) if isinstance(a, Recorded) else a for a in args)
        if key not in known:
            known[key] = steps(*args)
        return known[key]

    return function


def _recorded(value: Any) -> bool:
    if isinstance(value, Recorded):
        return True
    if isinstance(value, dict):
        return any(_recorded(v) for v in value.values())
    if isinstance(value, list | tuple):
        return any(_recorded(v) for v in value)
    return hasattr(value, "__dataclass_fields__") and any(_recorded(v) for v in vars(value).values())


class _Numpy:
    """numpy, whose functions also take lists of recorded quantities."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder

    def __getattr__(self, name: str) -> Any:
        value = getattr(np, name)
        return takes(value, self._recorder) if callable(value) and not isinstance(value, type) else value


@dataclass
class _Solving:
    """What `find` gives while recording."""

    value: Recorded
    solved: Solved
    unknown: str


class _Stage:
    """One cell while it is recorded: what it shows is noted, and compared with what the worksheet has."""

    def __init__(self, recorder: Recorder, recording: Recording, namespace: Mapping[str, Any], cell: Cell) -> None:
        self.recorder, self.recording, self.namespace, self.cell = recorder, recording, namespace, cell
        self.solved: list[Solved] = []
        self.stated_here: list[str] = []
        given = [namespace.get(name) for name in cell.gives]
        self.real = [v for group in given for v in (group if isinstance(group, tuple | list) else [group])]

    def replacements(self) -> dict[str, Any]:
        shown = {
            "table": self.table,
            "figure": self.figure,
            "find": self.find,
            "closed_form": self.closed_form,
            "check": self.check,
            "check_slope": self.check_slope,
            "Check": self.stated,
            "assembled": self.assembled,
        }
        others = ("require", "refuse", "summary", "mo", "export", "typeset")
        return {**shown, **dict.fromkeys(others, _Nothing())}

    def table(self, number: str, title: str, *columns: Any, every: Any = 1, **_: Any) -> None:
        listed = int(np.asarray(getattr(every, "value", every)))
        self._show(number, columns, 1 if self.recorder.thin > 1 else listed)

    def _show(self, number: str, columns: tuple[Any, ...], every: int) -> None:
        """Note the columns of a table or a figure, as long as each other."""
        shape = np.broadcast_shapes((1,), *(np.shape(getattr(c, "value", c)) for c in columns))
        kept = np.ascontiguousarray(np.arange(math.prod(shape)).reshape(shape)[..., ::every].ravel())

        def rows(column: Any) -> Recorded | None:
            if not isinstance(column, Recorded):
                return None
            if column.shape == shape and every == 1 and len(shape) == 1:
                return column
            index = np.broadcast_to(np.arange(column.size).reshape(column.shape), shape).reshape(-1)[kept]
            return column._map(lambda node: self.recorder.pick(column._whole(node, column.shape), index))

        self.recording.tables[number] = tuple(rows(c) for c in columns)

    def figure(self, number: str, title: str, *columns: Any, marks: Mapping[str, Any] | None = None, **_: Any) -> None:
        self._show(f"Fig {number}", columns, 1)
        self.recording.marks[number] = {k: self.recorder.lift(v).re for k, v in (marks or {}).items()}

    def find(
        self, f: Callable[..., Any], lo: Any = None, hi: Any = None, *, unknown: str, equals: Any, **rest: Any
    ) -> Any:
        found = next(v for v in self.real if isinstance(v, Found) and v.words.unknown == unknown)
        node = self.recorder.leaf("found", unknown, found.value)
        x, branch = Recorded(self.recorder, node), rest.get("branch")
        left = self.recorder.lift((f(x, branch) if branch is not None else f(x)) - equals)
        ends = None if lo is None or hi is None else (self.recorder.lift(lo).re, self.recorder.lift(hi).re)
        solved = Solved(node, left.re if left.size == 1 else None, ends)
        self.solved.append(solved)
        self.recording.found[unknown] = solved
        return _Solving(x, solved, unknown)

    def closed_form(self, found: _Solving, value: Any, tolerance: float = 1e-10) -> None:
        value = self.recorder.lift(value)
        inside: Any = value
        if found.solved.interval:
            low, high = (Recorded(self.recorder, end) for end in found.solved.interval)
            slack = 1e-12  # an end of the interval may be a found value, rounded
            within = (value >= low * (1 - slack)) & (value <= high * (1 + slack))
            inside = np.where(within, value, np.nan)
        found.solved.inverse = inside.re
        real = next(v for v in self.namespace.values() if isinstance(v, Found) and v.words.unknown == found.unknown)
        name = f"{found.unknown}: Find and the closed form"
        self.check(name, value - found.value, tolerance * abs(found.value), real.words.unknown_unit)

    def check(self, name: str, residual: Any, limit: Any, unit: str = "-") -> None:
        parts = [self.recorder.lift(r) for r in (residual if isinstance(residual, list) else [residual])]
        self._check(name, [abs(p).re for p in parts], limit, unit)

    def stated(self, name: str, residual: Any, limit: Any, unit: str = "-", *_: Any, **__: Any) -> None:
        self._check(name, [self.recorder.lift(residual).re], limit, "-", signed=True)

    def check_slope(
        self, name: str, slope: Any, f: Callable[..., Any], x: Any, lo: Any, hi: Any, unit: str = "-"
    ) -> None:
        """The slope by central differences, at the middle one of the positions."""
        slope, x = self.recorder.lift(slope), self.recorder.lift(x)
        middle, step = len(x) // 2, 0.002 * (hi - lo)
        at = x[middle]
        near, far = (f(at + n * step) - f(at - n * step) for n in (1, 2))
        left = slope[middle] - (8 * near - far) / (12 * step)
        self._check(name, [abs(left).re], 1e-7 * abs(slope).max(), unit)

    def assembled(self, name: str, point: Any, *_: Any) -> None:
        missing: Any = np.where(np.isfinite(self.recorder.lift(point)), 0.0, 1.0)
        self._check(name, [missing.re], 0.0, "-")

    def _check(self, name: str, parts: list[Node], limit: Any, unit: str, signed: bool = False) -> None:
        bound = self.recorder.lift(limit)
        if bound.size != 1:
            raise NotRecorded(f"check {name!r} has several limits")
        self.stated_here.append(name)
        self.recording.checks[name] = Residual(parts, bound.re, unit, signed)

    def compare(self, names: dict[str, Any]) -> None:
        """Keep the worksheet's numbers where a recorded quantity differs from them: its formula would be wrong."""
        wrong = [name for name in self.cell.gives if not self._same(names.get(name), self.namespace.get(name))]
        if wrong:
            self.recording.left_out[self.cell.name] = f"{', '.join(wrong)} would differ from the worksheet"
            self.numbers(names, wrong)
            for check in self.stated_here:
                del self.recording.checks[check]

    def _same(self, value: Any, own: Any) -> bool:
        if not (isinstance(value, Recorded) and isinstance(own, int | float | complex | np.ndarray | np.generic)):
            return True
        kept = np.asarray(own) + 0
        if kept.shape and kept.shape[-1:] != value.shape[-1:]:
            kept = kept[..., :: self.recorder.thin]
        a, b = np.broadcast_arrays(value.value + 0, kept)
        size = np.max(np.abs(b), initial=0.0, where=np.isfinite(b))
        return bool(np.all((np.abs(a - b) <= 1e-7 * size + 1e-9) | (~np.isfinite(a) & ~np.isfinite(b))))

    def numbers(self, names: dict[str, Any], which: Iterable[str]) -> None:
        """The worksheet's own values instead of formulas."""
        for name in which:
            own = self.namespace.get(name)
            if isinstance(own, np.ndarray | np.generic | float) and np.asarray(own).dtype.kind in "fiuc":
                array = np.asarray(own)
                if array.ndim and array.shape[-1] > 1:
                    array = array[..., :: self.recorder.thin]
                parts = [array.real, array.imag] if array.dtype.kind == "c" else [array]
                nodes = [self.recorder.leaf("static", f"{name}.{n}", part) for n, part in enumerate(parts)]
                names[name] = Recorded(self.recorder, *nodes)
            else:
                names[name] = own


class _Nothing:
    """Stands for what a workbook does not show; every use of it gives it again."""

    def __call__(self, *args: Any, **kwargs: Any) -> "_Nothing":
        return self

    def __getattr__(self, name: str) -> "_Nothing":
        if name.startswith("__"):
            raise AttributeError(name)
        return self


def _define(recording: Recording, section: str, name: str, value: Any, known: Mapping[str, formula.Formula]) -> None:
    """Give the quantities of a line its name, and the steps behind it theirs."""
    if not isinstance(value, Recorded):
        return
    lines = recording.lines.setdefault(section, [])
    line = known.get(name)
    unit, meaning = (line.unit, line.meaning) if line else ("", "")
    text = _source(line.expression) if line else ""
    stem = name.removesuffix("_S") if symbol.is_field(name) else name
    ends = ("real", "imag") if value.im is not None else ("",)
    for node, part in zip(value.parts, ends, strict=True):
        if node.op in ("constant", "input") or node.name:
            continue
        node.name = _coordinate(stem, part)
        _steps_of(node, stem, lines, set())
        lines.append(Line(node, node.name, unit, meaning, text))


def _coordinate(name: str, part: str) -> str:
    axis = {"real": "x", "imag": "y"}.get(part, "")
    return axis.upper() + name[1:] if axis and name.startswith("P") else name + axis


_source = lru_cache(maxsize=4096)(ast.unparse)


def _steps_of(node: Node, stem: str, lines: list[Line], seen: set[int]) -> None:
    for operand in node.operands:
        if not operand.name and operand.op != "constant" and id(operand) not in seen:
            seen.add(id(operand))
            _steps_of(operand, stem, lines, seen)
            if operand.label:
                sign, unit, meaning = operand.label
                operand.name = f"{stem}_{sign}"
                lines.append(Line(operand, operand.name, unit, meaning))
