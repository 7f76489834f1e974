"""Sweeps: the results of a worksheet for many variants of its inputs, through the very same cells.

Variants stand on a leading axis, positions on the last one, so that a cell computes a thousand variants as it computes
one. They are taken in chunks that stay in the processor's cache: memory is what the results need and no more. Those
that lack a value are run once more, among themselves, for the reason. A worksheet whose lines mix the variants, such as
by a mean over everything, is found out before and run for one variant after the other.
"""

import hashlib
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING, Any
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.worksheet import checks, inputs
from mechsheet.worksheet.cells import Cell, Worksheet, load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.find import Found, values_only
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import heading

if TYPE_CHECKING:
    import pandas as pd

_CHUNK = 1000  # variants: their fields of some tens of positions fit a processor's cache, see tests/benchmarks
_ONE_BY_ONE = 50  # variants of a chunk that are run one by one
_AHEAD = 256  # chunks handed to an executor and not yet taken back: bounds the memory of results that wait
_PROBES = 32  # variants tried alone until two of them are solved
_SPREAD = np.argsort([int(f"{i:05b}"[::-1], 2) for i in range(_PROBES)])  # first, middle, quarters..
_ALIKE = 1e-9  # of the greatest value: a variant among others and alone differ by rounding
_BREAKS = 3  # times that an executor may break in a row without one chunk done


@dataclass(frozen=True, eq=False)
class Sweep:
    """Results of all variants.

    ``sweep["GS6"]`` is the result of that name in SI: an array of the variants' ``shape``, with the positions on one
    more axis for a field; NaN where a variant or a position has no value.

    Attributes
    ----------
    shape : tuple of int
        Shape of the variants.
    names : tuple of str
        The results, in the order asked for.
    inputs : dict of str to array
        The inputs that were given, in their display units.
    reasons : array of str
        For each variant why it lacks a value, naming the quantity; "" where it lacks none.
    units : dict of str to str
        Display units of the inputs given and of the results.
    at_once : bool
        Whether the worksheet takes arrays of variants; otherwise they were run one by one, which takes longer.
    """

    shape: tuple[int, ...]
    names: tuple[str, ...]
    inputs: dict[str, NDArray[Any]]
    reasons: NDArray[np.object_]
    units: dict[str, str]
    at_once: bool
    _values: dict[str, NDArray[Any]]

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._values[name]

    @property
    def solved(self) -> NDArray[np.bool_]:
        """Which variants lack no value."""
        return np.asarray(self.reasons == "", dtype=bool)

    def display(self, name: str) -> NDArray[Any]:
        """Result in its display unit."""
        return self[name] / units.parse(self.units[name]).factor

    def frame(self) -> "pd.DataFrame":
        """Inputs, results and reasons as a pandas DataFrame, headings ``symbol [unit]``.

        A row is a variant, or a position of a variant where any result is a field; points and forces have a column
        for each coordinate.
        """
        import pandas as pd

        size = self.reasons.size
        shown = {name: self.display(name).reshape(size, -1) for name in self.names}
        positions = max((values.shape[1] for values in shown.values()), default=1)

        for name, values in shown.items():
            if values.shape[1] not in (1, positions):
                raise SheetError(f"{name} has {values.shape[1]} numbers a variant, another result has {positions}")

        def column(values: NDArray[Any]) -> NDArray[Any]:
            return np.broadcast_to(values.reshape(size, -1), (size, positions)).ravel()

        columns = {"variant": column(np.arange(size))}
        if any(self[name].ndim > len(self.shape) for name in self.names):
            columns["position"] = np.tile(np.arange(positions), size)
        for name, values in {**self.inputs, **shown}.items():
            parts = {"real": values.real, "imag": values.imag} if np.iscomplexobj(values) else {"": values}
            for part, numbers in parts.items():
                columns[f"{heading(name, part)} [{self.units[name]}]"] = column(numbers)
        columns["reason"] = column(self.reasons)
        return pd.DataFrame(columns)


def grid(**axes: ArrayLike) -> dict[str, NDArray[Any]]:
    """Variants of every combination of the given values, each input on an axis of its own, in the order given.

    >>> {name: values.shape for name, values in grid(P6=[20e3, 25e3, 30e3], S_max=[0.65, 0.67]).items()}
    {'P6': (3, 1), 'S_max': (1, 2)}
    """
    return dict(zip(axes, np.ix_(*(np.atleast_1d(values) for values in axes.values())), strict=True))


def sweep(
    path: str | Path,
    want: Iterable[str],
    variants: "Mapping[str, ArrayLike] | pd.DataFrame",
    *,
    chunk: int = _CHUNK,
    executor: Executor | Callable[[], Executor] | None = None,
) -> Sweep:
    """Wanted results of a worksheet for many variants of its inputs.

    Only the cells that the results depend on are run, and for variants that lack a value those that say why.

    Parameters
    ----------
    path : str or Path
        The worksheet.
    want : iterable of str
        Names of results: a number or a field over the positions.
    variants : mapping of str to array, or DataFrame
        Values of inputs in their display units. They broadcast: columns of one length are a table of variants, `grid`
        gives all combinations. Inputs that are not named keep their defaults.
    chunk : int
        Variants computed at once.
    executor : Executor or callable that makes one, optional
        Where chunks are computed: processes, threads, ``Client.get_executor()`` of dask; in this process by default.
        The worksheet must be found there under the same path. A chunk whose worker dies is computed again: on a new
        executor if ``executor`` makes one, otherwise here and with a RuntimeWarning.

    Returns
    -------
    Sweep
        Complete, or none at all: an interrupt leaves nothing behind. The numbers don't depend on the executor.

    Raises
    ------
    SheetError
        What is wrong for all variants: an unknown name, shapes that do not broadcast, a result whose shape differs. A
        variant that is outside a limit or has no solution is NaN with its reason.
    TypeError
        A result that is no number.
    RuntimeError
        Executors that broke three times in a row without one chunk done.
    """
    sheet, want = load(path), tuple(dict.fromkeys(want))
    if chunk < 1:
        raise SheetError(f"chunk = {chunk} variants must be at least 1")
    sheet.needed(want, ["g"])
    given = inputs.variants(sheet.inputs, {str(name): values for name, values in variants.items()})
    rows = np.flatnonzero(given.reasons == "")
    job = _Job(sheet.path, _digest(sheet.path), want, at_once=True)
    if not _takes_arrays(job, given, rows):
        job, chunk = replace(job, at_once=False), min(chunk, _ONE_BY_ONE)

    reasons = given.reasons.copy()
    size = reasons.size
    values: dict[str, NDArray[Any]] = {}
    declared: dict[str, str] = {}
    lacking = np.zeros(size, dtype=bool)
    chunks = _split(rows, chunk)
    for i, part in _computed(job.results, [given.at(rows) for rows in chunks], executor):
        for name, value in part.values.items():
            if name not in values:
                values[name] = np.full((size, *value.shape[1:]), np.nan, value.dtype)
            _same_shape(name, values[name], value)
            values[name][chunks[i]] = value
        lacking[chunks[i]] = part.lacking
        declared |= part.units
    chunks = _split(np.flatnonzero(lacking), chunk)
    for i, texts in _computed(job.reasons, [given.at(rows) for rows in chunks], executor):
        reasons[chunks[i]] = texts

    for name in want:  # no variant at all could be computed
        values.setdefault(name, np.full(size, np.nan))
    return Sweep(
        shape=given.shape,
        names=want,
        inputs=given.shown,
        reasons=reasons.reshape(given.shape),
        units={**{name: declared.get(name, "-") for name in want}, **given.units},
        at_once=job.at_once,
        _values={name: v.reshape((*given.shape, *v.shape[1:])) for name, v in values.items()},
    )


@dataclass(frozen=True)
class _Part:
    """Results of one chunk, variants on the leading axis, which variants lack a value, and the units."""

    values: dict[str, NDArray[Any]]
    lacking: NDArray[np.bool_]
    units: dict[str, str]


@dataclass(frozen=True)
class _Job:
    """What is done with each chunk, wherever: ``columns`` are inputs in SI, of shape (variants, 1) if they vary.

    The variants of a chunk are run at once, or one by one as single numbers.
    """

    path: str
    digest: str
    want: tuple[str, ...]
    at_once: bool

    def results(self, columns: Mapping[str, Any]) -> _Part:
        if not self.at_once:
            return _joined([self._tried(one) for one in _ones(columns)])
        return self._tried(columns)

    def reasons(self, columns: Mapping[str, Any]) -> NDArray[np.object_]:
        if not self.at_once:
            return np.concatenate([self._reasons(one) for one in _ones(columns)])
        return self._reasons(columns)

    @np.errstate(all="ignore")  # what has no value is NaN here, and no reason for a warning
    @values_only()
    def run(self, columns: Mapping[str, Any]) -> _Part:
        """Results of variants all of which run to the end; any error is raised."""
        sheet, count = self._sheet(), _count(columns)
        names: dict[str, Any] = {}
        lacking = np.zeros(count, dtype=bool)
        for cell in _run(sheet, sheet.needed(self.want, ["g"]), inputs.instance(sheet.inputs, columns), names):
            for found in _founds(cell, names):
                lacking |= ~_by_variant(found.solved, count).all(1)
        values = {name: _result(name, names[name], columns) for name in self.want}
        for value in values.values():
            lacking |= _lacking(value)
        lines = registry(names)
        return _Part(values, lacking, {name: lines[name].unit for name in self.want if name in lines})

    def _tried(self, columns: Mapping[str, Any]) -> _Part:
        try:
            return self.run(columns)
        except ValueError:
            if _count(columns) == 1 or self._in_common(columns):
                return _Part({}, np.ones(_count(columns), dtype=bool), {})
            return _joined([self._tried(half) for half in _halves(columns)])

    @np.errstate(all="ignore")
    def _reasons(self, columns: Mapping[str, Any]) -> NDArray[np.object_]:
        sheet, count = self._sheet(), _count(columns)
        names: dict[str, Any] = {}
        reasons = np.full(count, "", dtype=object)

        def add(texts: Any) -> None:
            new = _by_variant(texts, count)
            reasons[:] = np.where(reasons == "", new[np.arange(count), (new != "").argmax(1)], reasons)

        cells, g = sheet.needed(self.want, ["g"]), inputs.instance(sheet.inputs, columns)
        try:
            with checks.listen() as told:
                for cell in _run(sheet, [*cells, *_telling(sheet, cells)], g, names):
                    while told:
                        add(told.pop(0))
                    for found in _founds(cell, names):
                        add(found.reason)
        except ValueError as error:
            if count > 1 and not self._in_common(columns):
                return np.concatenate([self._reasons(half) for half in _halves(columns)])
            add(str(error))
        for name in (name for cell in cells for name in cell.gives):
            value = np.asarray(names.get(name))
            if value.dtype.kind in "fc" and _fits(value, columns):
                missing = _lacking(_result(name, value, columns))
                add(np.where(missing, f"{name} has no value", "")[:, None])
        return reasons

    def _sheet(self) -> Worksheet:
        if _digest(self.path) != self.digest:
            raise RuntimeError(f"worksheet {self.path} has changed during the sweep")
        return load(self.path)

    def _in_common(self, columns: Mapping[str, Any]) -> bool:
        """Whether the cells fail before they read any input that varies, and so for all variants alike."""
        sheet = self._sheet()
        g = _Read(inputs.instance(sheet.inputs, columns))
        try:
            deque(_run(sheet, sheet.needed(self.want, ["g"]), g, {}), maxlen=0)
        except ValueError:
            return g.read.isdisjoint(_varied(columns))
        return False


_taking_arrays: set[Any] = set()  # worksheets, results and inputs that were found to take arrays of variants


def _takes_arrays(job: _Job, given: inputs.Variants, rows: NDArray[np.intp]) -> bool:
    """Whether some variants give the same among each other as alone."""
    varied = _varied(given.at(rows[:1]))
    key = job, varied
    if not varied or not rows.size or key in _taking_arrays:
        return True
    tried: dict[int, _Part | None] = {}
    for row in dict.fromkeys(np.linspace(0, len(rows) - 1, _PROBES).astype(int)[_SPREAD].tolist()):
        try:
            tried[row] = job.run(next(_ones(given.at(rows[[row]]))))
        except ValueError:
            tried[row] = None
        if sum(part is not None and not part.lacking[0] for part in tried.values()) == 2:
            break
    ran = [row for row, part in tried.items() if part is not None]
    if not ran:
        return True
    together = ran if len(ran) > 1 else list(tried)
    try:
        among = job.run(given.at(rows[together]))
    except Exception:  # whatever a line does that cannot take an array
        return False
    for i, row in enumerate(together):
        alone = tried[row]
        if alone and not all(_alike(alone.values[name][0], among.values[name][i]) for name in job.want):
            return False
    _taking_arrays.add(key)
    return True


def _alike(a: NDArray[Any], b: NDArray[Any]) -> bool:
    size = np.max(np.abs(a), initial=0.0, where=np.isfinite(a))
    return a.shape == b.shape and np.allclose(a, b, rtol=0, atol=_ALIKE * size, equal_nan=True)


class _Read:
    """Inputs that remember which of them were read."""

    def __init__(self, g: Any) -> None:
        self.g, self.read = g, set[str]()

    def __getattr__(self, name: str) -> Any:
        self.read.add(name)
        return getattr(self.g, name)


def _run(sheet: Worksheet, cells: Iterable[Cell], g: Any, names: dict[str, Any]) -> Iterator[Cell]:
    """Run the cells one by one, their names in ``names``."""
    names |= {**sheet.common, "g": g}
    for cell in cells:
        exec(cell.code, names)
        for name in cell.gives:
            if isinstance(names[name], FunctionType):
                names[name] = _remembered(names[name])
        yield cell


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


def _founds(cell: Cell, names: Mapping[str, Any]) -> Iterator[Found]:
    return (names[name] for name in cell.gives if isinstance(names[name], Found))


def _telling(sheet: Worksheet, cells: Sequence[Cell]) -> Iterator[Cell]:
    """Further cells that check whether what ``cells`` compute closes, and need nothing else."""
    known = {"g", *sheet.common, *(name for cell in cells for name in cell.gives)}
    for cell in sheet.cells:
        if cell not in cells and cell.needs <= known and checks.assembled.__name__ in cell.code.co_names:
            yield cell


def _count(columns: Mapping[str, Any]) -> int:
    return max((len(v) for v in columns.values() if np.ndim(v)), default=1)


def _halves(columns: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    middle = _count(columns) // 2
    for part in (slice(middle), slice(middle, None)):
        yield {name: v[part] if np.ndim(v) else v for name, v in columns.items()}


def _ones(columns: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """The variants one by one, as single numbers."""
    for i in range(_count(columns)):
        yield {name: v[i, 0].item() if np.ndim(v) else v for name, v in columns.items()}


def _joined(parts: Sequence[_Part]) -> _Part:
    """Parts one after the other; NaN for the values that some of them do not have."""
    like = {name: value for part in parts for name, value in part.values.items()}
    values = {}
    for name, value in like.items():
        for part in parts:
            _same_shape(name, value, part.values.get(name, value))
        empty = (np.full((part.lacking.size, *value.shape[1:]), np.nan, value.dtype) for part in parts)
        values[name] = np.concatenate([part.values.get(name, e) for part, e in zip(parts, empty, strict=True)])
    lacking = np.concatenate([part.lacking for part in parts])
    return _Part(values, lacking, {name: unit for part in parts for name, unit in part.units.items()})


def _by_variant(value: Any, count: int) -> NDArray[Any]:
    """Values of each variant in a row of its own."""
    value = np.atleast_2d(value)
    return np.broadcast_to(value, (count, value.shape[1]))


def _result(name: str, value: Any, columns: Mapping[str, Any]) -> NDArray[Any]:
    """A result of each variant; among many variants it is a number or a field."""
    found: NDArray[Any] = np.asarray(value)
    if found.dtype.kind not in "iufc":
        raise TypeError(f"{name} is no number and cannot be swept")
    found = found.astype(complex if found.dtype.kind == "c" else float, copy=False)
    if not _varied(columns):
        return found.reshape(1) if found.shape == (1,) else found[None]
    if not _fits(found, columns):
        raise TypeError(f"{name} of shape {found.shape} has no axis of {_count(columns)} variants")
    rows = _by_variant(found, _count(columns))
    return rows[:, 0] if found.ndim == 0 or found.shape[1:] == (1,) else rows


def _fits(value: NDArray[Any], columns: Mapping[str, Any]) -> bool:
    """Whether a value is a number or a field, for each of the variants or for all of them."""
    return not _varied(columns) or value.ndim < 2 or (value.ndim == 2 and len(value) in (1, _count(columns)))


def _varied(columns: Mapping[str, Any]) -> tuple[str, ...]:
    """Inputs that are arrays of variants."""
    return tuple(name for name, x in columns.items() if np.ndim(x))


def _lacking(value: NDArray[Any]) -> NDArray[np.bool_]:
    """Which variants have NaN anywhere in this result."""
    if np.isfinite(value.sum()):  # a fifth of the time of looking at every element
        return np.zeros(len(value), dtype=bool)
    return np.asarray(np.isnan(value).reshape(len(value), -1).any(1), dtype=bool)


def _same_shape(name: str, a: NDArray[Any], b: NDArray[Any]) -> None:
    if a.shape[1:] != b.shape[1:]:
        raise SheetError(f"{name} has shape {a.shape[1:]} in one variant and {b.shape[1:]} in another")


def _split(rows: NDArray[np.intp], chunk: int) -> list[NDArray[np.intp]]:
    return [rows[i : i + chunk] for i in range(0, len(rows), chunk)]


def _digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def _computed(
    work: Callable[[Mapping[str, Any]], Any],
    chunks: Sequence[Mapping[str, Any]],
    executor: Executor | Callable[[], Executor] | None,
) -> Iterator[tuple[int, Any]]:
    """Number and result of each chunk, in the order in which they are done."""
    left = deque(range(len(chunks)))
    breaks = 0
    while left and executor is not None:
        with executor() if callable(executor) else nullcontext(executor) as pool:
            running: dict[Future[Any], int] = {}
            try:
                while left or running:
                    while left and len(running) < _AHEAD:
                        future = pool.submit(work, chunks[left[0]])
                        running[future] = left.popleft()
                    for future in wait(running, return_when=FIRST_COMPLETED).done:
                        result = future.result()
                        yield running.pop(future), result
                        breaks = 0
            except BrokenExecutor as error:
                left.extendleft(running.values())
                breaks += 1
                if breaks == _BREAKS:
                    raise RuntimeError(f"the executor broke {breaks} times without one chunk done: {error}") from error
                if not callable(executor):
                    warnings.warn(f"the executor broke, {len(left)} chunks are computed here", RuntimeWarning, 3)
                    executor = None
            finally:
                for future in running:
                    future.cancel()
    for i in left:
        yield i, work(chunks[i])
