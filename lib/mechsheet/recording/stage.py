"""One cell of a worksheet while it is recorded: what `table`, `find`, `check` and their like do there."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechsheet.recording.graph import Node, NotRecorded
from mechsheet.recording.lines import Recording, Residual, Solved
from mechsheet.recording.quantity import Quantity, lift
from mechsheet.worksheet.cells import Cell
from mechsheet.worksheet.find import Found


@dataclass
class _Solving:
    """What `find` gives while recording."""

    value: Quantity
    solved: Solved
    unknown: str


class Stage:
    """One cell while it is recorded: what it shows is noted, and compared with what the worksheet has."""

    def __init__(self, recording: Recording, namespace: Mapping[str, Any], cell: Cell) -> None:
        self.graph, self.recording, self.namespace, self.cell = recording.graph, recording, namespace, cell
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
        self._show(number, columns, 1 if self.graph.thin > 1 else listed)

    def _show(self, number: str, columns: tuple[Any, ...], every: int) -> None:
        """Note the columns of a table or a figure, as long as each other."""
        shape = np.broadcast_shapes((1,), *(np.shape(getattr(c, "value", c)) for c in columns))
        kept = np.ascontiguousarray(np.arange(math.prod(shape)).reshape(shape)[..., ::every].ravel())

        def rows(column: Any) -> Quantity | None:
            if not isinstance(column, Quantity):
                return None
            if column.shape == shape and every == 1 and len(shape) == 1:
                return column
            return column.take(np.broadcast_to(np.arange(column.size).reshape(column.shape), shape).reshape(-1)[kept])

        self.recording.tables[number] = tuple(rows(c) for c in columns)

    def figure(self, number: str, title: str, *columns: Any, marks: Mapping[str, Any] | None = None, **_: Any) -> None:
        self._show(f"Fig {number}", columns, 1)
        self.recording.marks[number] = {k: lift(self.graph, v).re for k, v in (marks or {}).items()}

    def find(
        self, f: Callable[..., Any], lo: Any = None, hi: Any = None, *, unknown: str, equals: Any, **rest: Any
    ) -> Any:
        found = next(v for v in self.real if isinstance(v, Found) and v.words.unknown == unknown)
        node = self.graph.leaf("found", unknown, found.value)
        x, branch = Quantity(self.graph, node), rest.get("branch")
        left = lift(self.graph, (f(x, branch) if branch is not None else f(x)) - equals)
        ends = None if lo is None or hi is None else (lift(self.graph, lo).re, lift(self.graph, hi).re)
        solved = Solved(node, left.re if left.size == 1 else None, ends)
        self.solved.append(solved)
        self.recording.found[unknown] = solved
        return _Solving(x, solved, unknown)

    def closed_form(self, found: _Solving, value: Any, tolerance: float = 1e-10) -> None:
        value = lift(self.graph, value)
        inside: Any = value
        if found.solved.interval:
            low, high = (Quantity(self.graph, end) for end in found.solved.interval)
            slack = 1e-12  # an end of the interval may be a found value, rounded
            within = (value >= low * (1 - slack)) & (value <= high * (1 + slack))
            inside = np.where(within, value, np.nan)
        found.solved.inverse = inside.re
        real = next(v for v in self.namespace.values() if isinstance(v, Found) and v.words.unknown == found.unknown)
        name = f"{found.unknown}: Find and the closed form"
        self.check(name, value - found.value, tolerance * abs(found.value), real.words.unknown_unit)

    def check(self, name: str, residual: Any, limit: Any, unit: str = "-") -> None:
        parts = [lift(self.graph, r) for r in (residual if isinstance(residual, list) else [residual])]
        self._check(name, [abs(p).re for p in parts], limit, unit)

    def stated(self, name: str, residual: Any, limit: Any, unit: str = "-", *_: Any, **__: Any) -> None:
        self._check(name, [lift(self.graph, residual).re], limit, "-", signed=True)

    def check_slope(
        self, name: str, slope: Any, f: Callable[..., Any], x: Any, lo: Any, hi: Any, unit: str = "-"
    ) -> None:
        """The slope by central differences, at the middle one of the positions."""
        slope, x = lift(self.graph, slope), lift(self.graph, x)
        middle, step = len(x) // 2, 0.002 * (hi - lo)
        at = x[middle]
        near, far = (f(at + n * step) - f(at - n * step) for n in (1, 2))
        left = slope[middle] - (8 * near - far) / (12 * step)
        self._check(name, [abs(left).re], 1e-7 * abs(slope).max(), unit)

    def assembled(self, name: str, point: Any, *_: Any) -> None:
        missing: Any = np.where(np.isfinite(lift(self.graph, point)), 0.0, 1.0)
        self._check(name, [missing.re], 0.0, "-")

    def _check(self, name: str, parts: list[Node], limit: Any, unit: str, signed: bool = False) -> None:
        bound = lift(self.graph, limit)
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
        if not (isinstance(value, Quantity) and isinstance(own, int | float | complex | np.ndarray | np.generic)):
            return True
        kept = np.asarray(own) + 0
        if kept.shape and kept.shape[-1:] != value.shape[-1:]:
            kept = kept[..., :: self.graph.thin]
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
                    array = array[..., :: self.graph.thin]
                parts = [array.real, array.imag] if array.dtype.kind == "c" else [array]
                nodes = [self.graph.leaf("static", f"{name}.{n}", part) for n, part in enumerate(parts)]
                names[name] = Quantity(self.graph, *nodes)
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
