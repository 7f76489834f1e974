"""The work of a sweep: what is done with a chunk of variants."""

import hashlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING, Any
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from mechsheet.studies.by_variant import Part, alike, array, fits, joined, lacks, of_each, result, told
from mechsheet.worksheet import check, inputs, mistakes, numbers
from mechsheet.worksheet.cells import Cell, Worksheet, base, load
from mechsheet.worksheet.cells import value as wanted
from mechsheet.worksheet.check import stating
from mechsheet.worksheet.errors import is_of_numbers
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.verdict import Verdict, listen, values_only

if TYPE_CHECKING:
    from mechsheet.recording.variants import Again

_WAYS = 8  # recordings that are kept


@dataclass(frozen=True)
class Job:
    """What is done with each chunk, wherever: ``columns`` are inputs in SI, of shape (variants, 1) if they vary.

    The variants of a chunk are run at once, or one by one as single numbers. Then what recordings of a few of them know
    is computed by these: ``recorded`` has for each the values of the inputs that vary. Of one alone ``numbers`` are the
    results that are numbers, such as a mean over the positions, which among others has no axis of positions left. With
    ``refusing`` no variant divides by zero alone, or is infinite: where some do among others, Python may have an error.
    """

    path: str
    digest: str
    want: tuple[str, ...]
    at_once: bool
    numbers: frozenset[str] = frozenset()
    recorded: tuple[tuple[float, ...], ...] = ()
    refusing: bool = False

    def results(self, columns: Mapping[str, Any]) -> Part:
        if self.recorded:
            return self._by_recording(columns)
        if not self.at_once:
            return joined([self._tried(one) for one in one_by_one(columns)])
        return self._tried(columns)

    def reasons(self, columns: Mapping[str, Any]) -> NDArray[np.object_]:
        if not self.at_once:
            return np.concatenate([self._reasons(one) for one in one_by_one(columns)])
        return self._reasons(columns)

    @values_only()
    def run(self, columns: Mapping[str, Any]) -> Part:
        """Results of variants all of which run to the end; any error is raised."""
        with self._quietly(columns), _emptied() as names:
            return self._run_in(names, columns)

    def _quietly(self, columns: Mapping[str, Any]) -> np.errstate:
        """What has no value is NaN here, and no reason for a warning."""
        if self.refusing and varied(columns):
            return np.errstate(all="ignore", divide="raise", over="raise")
        return np.errstate(all="ignore")

    def _run_in(self, names: dict[str, Any], columns: Mapping[str, Any]) -> Part:
        sheet, count = self._sheet(), _count(columns)
        lacking = np.zeros(count, dtype=bool)
        g: Any = inputs.instance(sheet.inputs, columns)
        among = count if varied(columns) else None
        for cell in _run(sheet, sheet.needed(self.want, ["g"]), g, names):
            for found in _founds(cell, names):
                valued = told(found.valued, among)
                lacking |= valued.shape[1] == 1 and ~valued[:, 0]  # of a field what is made of it tells
        sheet.refuse_unbound(self.want, names)
        one_row = among is None and _has_one_row(g)
        wants = {name: np.asarray(_wanted(name, names)) for name in self.want}
        for name in self.numbers:
            if wants[name].shape == (among,):
                wants[name] = wants[name][:, None]
        values = {name: result(name, value, among, one_row) for name, value in wants.items()}
        for value in values.values():
            lacking |= lacks(value)
        lines = registry(names)
        return Part(values, lacking, {name: lines[base(name)].unit for name in self.want if base(name) in lines})

    def _tried(self, columns: Mapping[str, Any], surely: bool = False) -> Part:
        """Results of variants one of which may have an error, ``surely`` where any of them divides by zero."""
        try:
            return self.run(columns)
        except _Changed:
            raise
        except Exception as error:
            if not is_of_numbers(error):
                raise
            if not varied(columns):
                return Part({}, np.ones(1, dtype=bool), {})
            if _count(columns) == 1:  # an array of one may have an error of its own
                return self._tried(next(one_by_one(columns)))
            if isinstance(error, FloatingPointError):
                if not surely and not self._is_refused(columns):
                    return replace(self, refusing=False)._tried(columns)
                surely = True
            elif self.in_common(columns):
                return Part({}, np.ones(_count(columns), dtype=bool), {})
        return joined([self._tried(half, surely) for half in _halves(columns)])

    def _is_refused(self, columns: Mapping[str, Any]) -> bool:
        """Whether a variant has an error alone that divides by zero among others: elements of its arrays may, too."""
        while _count(columns) > 1:
            first, second = _halves(columns)
            columns = first if self.divides(first) else second
        return bool(self._tried(columns).lacking[0])

    def divides(self, columns: Mapping[str, Any]) -> bool:
        """Whether variants divide by zero."""
        try:
            replace(self, refusing=True).run(columns)
        except Exception as error:  # or whatever a line does that cannot take an array
            return isinstance(error, FloatingPointError)
        return False

    def _by_recording(self, columns: Mapping[str, Any]) -> Part:
        """What recordings of a few variants know of these; those that none knows run alone."""
        names, left = varied(columns), np.arange(_count(columns))
        parts, order = list[Part](), list[NDArray[np.intp]]()
        for values in self.recorded:
            if left.size and (way := self.way(values, columns)):
                part, known = way.results({name: columns[name][left, 0] for name in names})
                parts.append(part)
                order.append(left[known])
                left = left[~known]
        whole = joined([*parts, *map(self._tried, one_by_one(_rows(columns, left)))])
        back = np.argsort(np.concatenate([*order, left]))
        return Part({name: x[back] for name, x in whole.values.items()}, whole.lacking[back], whole.units)

    def way(self, values: tuple[float, ...], columns: Mapping[str, Any]) -> "Way | None":
        """How the recording of the variant with these values computes others; None of one that has no results.

        Raises NotPlanned or NotRecorded where it cannot.
        """
        key = self.path, self.digest, self.want, varied(columns), fixed(columns), values
        if key not in _ways:
            while len(_ways) >= _WAYS:
                _ways.pop(next(iter(_ways)), None)
            _ways[key] = self._way({**columns, **dict(zip(varied(columns), values, strict=True))}, varied(columns))
        return _ways.get(key)

    def _way(self, one: Mapping[str, Any], names: Sequence[str]) -> "Way | None":
        from mechsheet.readers.plan import NotPlanned  # on use: most worksheets take arrays of variants
        from mechsheet.recording.variants import variants  # likewise

        alone = self._tried(one)
        if alone.lacking[0]:
            return None
        sheet = self._sheet()
        only = replace(sheet, cells=tuple(sheet.needed(map(base, self.want), ["g"])))
        g: Any = inputs.instance(sheet.inputs, one)
        with values_only():
            way = Way(variants(only, self.want, g, names), alone.units, _has_one_row(g))
        again, known = way.results({name: np.array([one[name]]) for name in names})
        if not known[0] or not all(way.same(name, alone.values[name], again.values[name]) for name in self.want):
            raise NotPlanned("its own numbers are others")
        return way

    def _reasons(self, columns: Mapping[str, Any]) -> NDArray[np.object_]:
        with self._quietly(columns), _emptied() as names:
            return self._reasons_in(names, columns)

    def _reasons_in(self, names: dict[str, Any], columns: Mapping[str, Any]) -> NDArray[np.object_]:
        sheet, count = self._sheet(), _count(columns)
        reasons = np.full(count, "", dtype=object)
        among = count if varied(columns) else None

        def add(texts: Any) -> None:
            new = told(texts, among)
            reasons[:] = np.where(reasons == "", new[np.arange(count), (new != "").argmax(1)], reasons)

        cells = sheet.needed(self.want, ["g"])
        g: Any = inputs.instance(sheet.inputs, columns)
        try:
            with listen() as heard:
                for cell in _run(sheet, [*cells, *_telling(sheet, cells)], g, names):
                    for lacking in (*heard, *_founds(cell, names)):
                        add(lacking.reason if isinstance(lacking, Verdict) else lacking)
                    heard.clear()
            sheet.refuse_unbound(self.want, names)
        except Exception as error:
            if not is_of_numbers(error):
                raise
            if count > 1 and not self.in_common(columns):
                return np.concatenate([self._reasons(half) for half in _halves(columns)])
            if varied(columns) and count == 1:  # of which Python has its own words
                return self._reasons(next(one_by_one(columns)))
            add(mistakes.reason(error, self.path))
        for name in (name for cell in cells for name in cell.gives):
            held = names.get(name)
            value = array(None if isinstance(held, tuple) else held)
            if value.dtype.kind in "fc" and fits(value, among):
                missing = lacks(result(name, value, among))
                add(np.where(missing, f"{name} has no value", "")[:, None])
        return reasons

    def _sheet(self) -> Worksheet:
        if digest(self.path) != self.digest:
            raise _Changed(f"worksheet {self.path} has changed during the sweep")
        return load(self.path)

    def in_common(self, columns: Mapping[str, Any]) -> bool:
        """Whether the cells fail before they read any input that varies, and so for all variants alike."""
        sheet = self._sheet()
        g = _Read(inputs.instance(sheet.inputs, columns))
        try:
            with _emptied() as names:
                deque(_run(sheet, sheet.needed(self.want, ["g"]), g, names), maxlen=0)
        except Exception as error:
            if not is_of_numbers(error):
                raise
            return g.read.isdisjoint(varied(columns))
        return False


@dataclass(frozen=True)
class Way:
    """How the recording of one variant computes others, and what of its run holds for these."""

    again: "Again"
    units: dict[str, str]
    one_row: bool

    def same(self, name: str, a: NDArray[Any], b: NDArray[Any]) -> bool:
        """Whether a result of the recorded variant is the same, or differs by what rounding leaves of its terms."""
        return alike(a, b) or (a.shape == b.shape and numbers.is_rounding((b - a)[0], self.again.terms(name)))

    def results(self, given: Mapping[str, NDArray[np.float64]]) -> tuple[Part, NDArray[np.bool_]]:
        """Results of those variants that are known, and which these are."""
        count = len(next(iter(given.values())))
        try:
            with values_only():
                values, known = self.again(given)
        except Exception as error:  # of one of them, as of a Find with no interval
            if not is_of_numbers(error):
                raise
            if count == 1:
                return Part({}, np.zeros(0, dtype=bool), {}), np.zeros(1, dtype=bool)
            halves = [self.results(half) for half in _halves(given)]
            return joined([part for part, _ in halves]), np.concatenate([known for _, known in halves])
        results = {name: of_each(x[known], self.one_row) for name, x in values.items()}
        return Part(results, np.zeros(known.sum(), dtype=bool), self.units), known


_ways: dict[Any, Way | None] = {}


class _Changed(RuntimeError):
    """The worksheet is another one by now."""


class _Read:
    """Inputs that remember which of them were read."""

    def __init__(self, g: Any) -> None:
        self.g, self.read = g, set[str]()

    def __getattr__(self, name: str) -> Any:
        self.read.add(name)
        return getattr(self.g, name)


def _run(sheet: Worksheet, cells: Iterable[Cell], g: Any, names: dict[str, Any]) -> Iterator[Cell]:
    """Run the cells one by one, their names in ``names``."""
    sheet.begun.again()
    names |= {**sheet.common, "g": g}
    for cell in cells:
        # Nothing stated is of the run of a worksheet that asks for this one.
        with stating(), mistakes.unbound(cell.gives, cell.certain, sheet.path):
            exec(cell.code, names)
        for name in cell.gives:
            if isinstance(function := names.get(name), FunctionType):  # a branch that was not taken binds nothing
                names[name] = _remembered(function)
        yield cell


@contextmanager
def _emptied() -> Iterator[dict[str, Any]]:
    """Names of one run: its functions know them, so that its arrays would stay until somebody looks for such rings."""
    names: dict[str, Any] = {}
    try:
        yield names
    finally:
        names.clear()


def _remembered(f: FunctionType) -> Callable[..., Any]:
    """A function of a document that computes once for the same arguments, as long as these exist.

    A chain such as P56(S), phi6(S), P67(S) computes each link of it once, as one does by hand.
    """
    kept: dict[Any, tuple[Any, list[Any]]] = {}

    def remembered(*args: Any, **kwargs: Any) -> Any:
        key = tuple(_identity(a) for a in args)
        if kwargs or None in key:
            return f(*args, **kwargs)
        if key not in kept:
            value = f(*args)
            if isinstance(value, np.ndarray):
                value = value.view()
                value.flags.writeable = False
            kept[key] = value, [ref(a, lambda _: kept.pop(key, None)) for a in args if isinstance(a, np.ndarray)]
        return kept[key][0]

    return remembered


def _identity(argument: Any) -> Any:
    if isinstance(argument, np.ndarray):
        return id(argument)
    if isinstance(argument, float):
        return argument.hex()  # tells -0.0 from 0.0
    return (type(argument), argument) if isinstance(argument, int | str) else None


def _founds(cell: Cell, names: Mapping[str, Any]) -> Iterator[Verdict]:
    return (found for name in cell.gives if isinstance(found := names.get(name), Verdict))


def _telling(sheet: Worksheet, cells: Sequence[Cell]) -> Iterator[Cell]:
    """Further cells that check whether what ``cells`` compute closes, and need nothing else."""
    known = {"g", *sheet.common, *(name for cell in cells for name in cell.gives)}
    for cell in sheet.cells:
        if cell not in cells and cell.needs <= known and check.assembled.__name__ in cell.code.co_names:
            yield cell


def _count(columns: Mapping[str, Any]) -> int:
    return max((len(v) for v in columns.values() if np.ndim(v)), default=1)


def _halves(columns: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    middle = _count(columns) // 2
    yield _rows(columns, slice(middle))
    yield _rows(columns, slice(middle, None))


def _rows(columns: Mapping[str, Any], which: Any) -> dict[str, Any]:
    return {name: v[which] if np.ndim(v) else v for name, v in columns.items()}


def one_by_one(columns: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """The variants one by one, as single numbers."""
    for i in range(_count(columns)):
        yield {name: _one(v[i, 0]) if np.ndim(v) else v for name, v in columns.items()}


def _one(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _wanted(name: str, names: Mapping[str, Any]) -> Any:
    """A wanted number or field, or a part of it; TypeError, which no variant takes for its reason, for all else."""
    if array(names.get(base(name), "")).dtype.kind not in "biufc":
        raise TypeError(f"{name} is no number and cannot be swept")
    return wanted(name, names)


def _has_one_row(g: Any) -> bool:
    """Whether a list or a table among the inputs has one row."""
    lists = (field for field in inputs.declared(type(g)) if isinstance(field, Rows))
    return any(len(x) == 1 for field in lists for _, x in field.leaves(getattr(g, field.name)).values())


def varied(columns: Mapping[str, Any]) -> tuple[str, ...]:
    """Inputs that are arrays of variants."""
    return tuple(name for name, x in columns.items() if np.ndim(x))


def fixed(columns: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """Inputs that all variants have in common, and what they are."""
    return tuple((name, repr(x)) for name, x in columns.items() if not np.ndim(x))


def digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()
