"""Sweeps: the results of a worksheet for many variants of its inputs, through the very same cells.

Variants stand on a leading axis, positions on the last one, so that a cell computes a thousand variants as it computes
one. They are taken in chunks that stay in the processor's cache: memory is what the results need and no more. Those
that lack a value are run once more, among themselves, for the reason. A worksheet whose lines mix the variants, such as
by a mean over everything, is found out before: then many of them are computed by the recording of one, and those that
it does not know, one after the other.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass, replace
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.run.progress import on_terminal
from mechsheet.run.silent import silently
from mechsheet.studies.by_variant import Part, alike, same_shape
from mechsheet.studies.chunks import Job, digest, fixed, one_by_one, varied
from mechsheet.studies.executed import computed
from mechsheet.studies.mixing import COUNT, mixes
from mechsheet.worksheet import inputs, lists
from mechsheet.worksheet.cells import Worksheet, asked, load, split
from mechsheet.worksheet.data_file import HEAD
from mechsheet.worksheet.errors import SheetError, as_given, is_of_numbers
from mechsheet.worksheet.kinds import converted
from mechsheet.worksheet.table import heading

if TYPE_CHECKING:
    import pandas as pd

T = TypeVar("T")
_CHUNK = 2000  # variants: their fields of some tens of positions fit a processor's cache, see tests/benchmarks
_RECORDINGS = 4  # variants that are recorded at most
_PAYS = 100  # variants that take as long alone as a recording and its check, and more
_ONE_BY_ONE = 50  # variants of a chunk that are run one by one
_PROBES = 32  # variants tried alone until two of them are solved
_KNOWN = 64  # worksheets and inputs that are known to take arrays of variants
_SPREAD = np.argsort([int(f"{i:05b}"[::-1], 2) for i in range(_PROBES)])  # first, middle, quarters..


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
        Display units of the inputs given and of the results; of a name that both have that of the result.
    input_units : dict of str to str
        Display units of the inputs given.
    at_once : bool
        Whether the worksheet takes arrays of variants, or its recording does; otherwise they were run one by one,
        which takes longer.
    """

    shape: tuple[int, ...]
    names: tuple[str, ...]
    inputs: dict[str, NDArray[Any]]
    reasons: NDArray[np.object_]
    units: dict[str, str]
    input_units: dict[str, str]
    at_once: bool
    _values: dict[str, NDArray[Any]]

    def __getitem__(self, name: str) -> NDArray[Any]:
        return known(name, self._values, "result of this sweep")

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
        for each coordinate. A list or a table among the inputs is the text that is read as it.
        """
        import pandas as pd  # on use: takes longer than the rest of the package

        size = self.reasons.size
        shown = {
            name: self.display(name).reshape(size, prod(self[name].shape[len(self.shape) :])) for name in self.names
        }
        positions = max((values.shape[1] for values in shown.values()), default=1)

        for name, values in shown.items():
            if values.shape[1] not in (1, positions):
                raise SheetError(f"{name} has {values.shape[1]} numbers a variant, another result has {positions}")

        def column(values: NDArray[Any]) -> NDArray[Any]:
            return np.broadcast_to(values.reshape(size, -1 if size else 1), (size, positions)).ravel()

        columns = {"variant": column(np.arange(size))}
        if any(self[name].ndim > len(self.shape) for name in self.names):
            columns["position"] = np.tile(np.arange(positions), size)
        for name, values in self.inputs.items():
            label = f"g.{heading(name)}" if name in shown else heading(name)
            columns[f"{label} [{self.input_units[name]}]"] = column(_as_texts(values))
        for name, values in shown.items():
            root, own = split(name)
            parts = {"real": values.real, "imag": values.imag} if np.iscomplexobj(values) else {own: values}
            for part, numbers in parts.items():
                label = f"{heading(root, '' if part == 'abs' else part)} [{self.units[name]}]"
                columns[label if label not in columns else f"{name} [{self.units[name]}]"] = column(numbers)
        columns["reason"] = column(self.reasons)
        return pd.DataFrame(columns)


def known(name: str, every: Mapping[str, T], what: str) -> T:
    """What a study knows of a result or of an input; SheetError naming those that it has where that is none."""
    if name not in every:
        raise SheetError(f"{as_given(name)} is no {what}: it has {', '.join(every)}")
    return every[name]


def _as_texts(values: NDArray[Any]) -> NDArray[Any]:
    """Values of an input, each list or table as a text."""
    if not any(isinstance(x, dict) for x in values.flat):
        return values
    texts = (lists.as_text(x) if isinstance(x, dict) else x for x in values.flat)
    return np.fromiter(texts, object, values.size)


def grid(**axes: ArrayLike) -> dict[str, NDArray[Any]]:
    """Variants of every combination of the given values, each input on an axis of its own, in the order given.

    >>> {name: values.shape for name, values in grid(P6=[20e3, 25e3, 30e3], S_max=[0.65, 0.67]).items()}
    {'P6': (3, 1), 'S_max': (1, 2)}
    """
    columns = [_along(name, values) for name, values in axes.items()]
    last = len(axes) - 1
    return {
        name: x.reshape(*[1] * k, -1, *[1] * (last - k)) for k, (name, x) in enumerate(zip(axes, columns, strict=True))
    }


def _along(name: str, values: Any) -> NDArray[Any]:
    """Values of an input along an axis; each list or table among them is one."""
    if np.iterable(values) and (isinstance(values, Mapping) or not hasattr(values, "__getitem__")):
        raise SheetError(f"{name} of a grid = {as_given(values)} must be a list of values")
    several = isinstance(values, list | tuple) and any(np.iterable(x) and not isinstance(x, str) for x in values)
    column: NDArray[Any] = inputs.each(values) if several else np.atleast_1d(values)
    if column.ndim > 1:
        raise SheetError(f"{name} of a grid has shape {column.shape}: give its values along one axis")
    return column


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
        Names of results, a number or a field over the positions, or of parts of them (``PS6_S.imag``, ``abs(R56)``).
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
        What is wrong for all variants: an argument of another kind, an unknown name, shapes that do not broadcast, a
        result whose shape differs. A variant that is outside a limit or has no solution is NaN with its reason.
    TypeError
        A result that is no number.
    RuntimeError
        Executors that broke three times in a row without one chunk done.
    """
    sheet, want = load(path), asked(want)
    if not hasattr(variants, "items"):
        raise SheetError(f"variants = {as_given(variants)} must be a mapping of inputs to their values, or a DataFrame")
    if not isinstance(chunk, int) or chunk < 1:
        raise SheetError(f"chunk = {as_given(chunk)} variants must be at least 1 and whole")
    if not (executor is None or callable(executor) or hasattr(executor, "submit")):
        raise SheetError(f"executor = {as_given(executor)} must be an executor, or a function that makes one")
    sheet.needed(want, ["g"])
    with silently() if executor is None else nullcontext():  # a variant without a value is told as one, once
        return _swept(sheet, want, variants, chunk, executor)


def _swept(
    sheet: Worksheet,
    want: tuple[str, ...],
    variants: "Mapping[str, ArrayLike] | pd.DataFrame",
    chunk: int,
    executor: Executor | Callable[[], Executor] | None,
) -> Sweep:
    """`sweep` of what can be swept."""
    given = inputs.variants(sheet.inputs, _by_name(sheet, variants))
    rows = np.flatnonzero(given.reasons == "")
    job = Job(sheet.path, digest(sheet.path), want, at_once=True)
    together = _together(sheet, job, given, rows)
    if together is None:
        job = _recorded(replace(job, at_once=False), given, rows)
        chunk = chunk if job.recorded else min(chunk, _ONE_BY_ONE)
    else:
        job = together

    reasons = given.reasons.copy()
    size = reasons.size
    values: dict[str, NDArray[Any]] = {}
    declared: dict[str, str] = {}
    lacking = np.zeros(size, dtype=bool)
    chunks = _split(rows, chunk)
    with on_terminal(len(chunks), "sweep") as done:
        for i, part in computed(job.results, given.at, chunks, executor):
            for name, value in part.values.items():
                if name not in values:
                    values[name] = np.full((size, *value.shape[1:]), np.nan, value.dtype)
                same_shape(name, values[name], value)
                values[name] = values[name].astype(np.result_type(values[name], value), copy=False)
                values[name][chunks[i]] = value
            lacking[chunks[i]] = part.lacking
            declared |= part.units
            done()
    chunks = _split(np.flatnonzero(lacking), chunk)
    for i, texts in computed(job.reasons, given.at, chunks, executor):
        reasons[chunks[i]] = texts

    if not values:
        values = {name: np.full((size, *shape), np.nan) for name, shape in _shapes(job, given, rows).items()}
    return Sweep(
        shape=given.shape,
        names=want,
        inputs=given.shown,
        reasons=reasons.reshape(given.shape),
        units={**given.units, **{name: declared.get(name, "-") for name in want}},
        input_units=given.units,
        at_once=job.at_once or bool(job.recorded),
        _values={name: v.reshape((*given.shape, *v.shape[1:])) for name, v in values.items()},
    )


def _by_name(sheet: Worksheet, variants: "Mapping[str, ArrayLike] | pd.DataFrame") -> dict[str, Any]:
    """Values by the names of the inputs, each in its own unit: a head such as ``r [cm]`` tells that of its column."""
    found, fields = dict[str, Any](), {field.name: field for field in inputs.declared(sheet.inputs)}
    for head, values in variants.items():
        match = re.fullmatch(HEAD, str(head))
        name, unit = match.groups() if match and match[2] is not None else (str(head), "")
        if name in found:
            raise SheetError(f"input {name} is given twice")
        own = inputs.known(fields, name).unit
        if unit and units.plain(unit) != own:
            try:
                units.conversion(unit, own)
            except ValueError as error:
                raise SheetError(f"input {as_given(str(head))}: {error}") from None
            each = np.asarray(values, dtype=object)
            plain = [converted(x, unit, own) if isinstance(x, int | float) else f"{x} {unit}" for x in each.flat]
            values = np.fromiter(plain, object, each.size).reshape(each.shape)
        found[name] = values
    return found


def _shapes(job: Job, given: inputs.Variants, rows: NDArray[np.intp]) -> dict[str, tuple[int, ...]]:
    """Shapes of results that no variant has, as far as they are told by the first one among others of its kind."""
    none = dict.fromkeys(job.want, tuple[int, ...]())
    try:
        found = replace(job, at_once=True, recorded=(), refusing=False).run(given.at(np.resize(rows[:1], COUNT)))
    except Exception:  # whatever a line does that cannot take an array
        return none
    return none | {name: value.shape[1:] for name, value in found.values.items()}


_taking_arrays: dict[Any, Job] = {}  # by worksheets, results and inputs that were found to take arrays of variants


def _together(sheet: Worksheet, job: Job, given: inputs.Variants, rows: NDArray[np.intp]) -> Job | None:
    """The job with all variants at once, where some give the same among each other as alone."""
    columns = given.at(rows[:1])
    names = varied(columns)
    key = job, names, fixed(columns)  # lines may go another way by those that no variant has of its own
    if not names or not rows.size:
        return job
    if key in _taking_arrays and rows.size < 10 * _CHUNK:  # of more a tenth of the time is for looking at these
        return _taking_arrays[key]
    probes = rows[np.linspace(0, len(rows) - 1, _PROBES).astype(int)]
    tried: dict[int, Part | None] = {}
    for row in dict.fromkeys(probes[_SPREAD].tolist()):
        try:
            tried[row] = job.run(next(one_by_one(given.at(np.array([row])))))
        except Exception as error:
            if not is_of_numbers(error):
                raise
            tried[row] = None
        if sum(part is not None and not part.lacking[0] for part in tried.values()) == 2:
            break
    ran = {row: part for row, part in tried.items() if part is not None}
    refused = np.array([row for row, part in tried.items() if part is None], dtype=int)
    if not ran:  # nobody knows a number that is right
        return job if _in_common(job, given, refused) else None
    numbers = (name for name in job.want if all(part.values[name].ndim == 1 for part in ran.values()))
    if mixes(sheet, job.want, given.at(np.resize([*ran], COUNT))):
        return None
    all_at_once = replace(job, numbers=frozenset(numbers))
    together = [*ran] if len(ran) > 1 else [*tried]
    all_at_once = replace(all_at_once, refusing=not all_at_once.divides(given.at(np.array([*ran]))))
    try:
        among = all_at_once.run(given.at(np.array(together)))
        if refused.size and not _is_refused(all_at_once, given, refused):
            return None
        compared = np.unique([*probes, *_outermost(given, rows)])
        if not _apart(all_at_once, given, compared):
            return None
    except Exception:  # whatever a line does that cannot take an array
        return None
    for i, row in enumerate(together):
        alone = tried[row]
        if alone and not all(alike(alone.values[name], among.values[name][[i]]) for name in job.want):
            return None
    if all((x != x[0]).any() for x in given.at(compared).values() if np.ndim(x)):  # of one value others say nothing
        while len(_taking_arrays) >= _KNOWN:
            _taking_arrays.pop(next(iter(_taking_arrays)), None)
        _taking_arrays[key] = all_at_once
    return all_at_once


def _in_common(job: Job, given: inputs.Variants, rows: NDArray[np.intp]) -> bool:
    """Whether all variants are refused before anything is read in which they differ."""
    try:
        return job.in_common(given.at(rows))
    except Exception:  # whatever a line does that cannot take an array
        return False


def _is_refused(job: Job, given: inputs.Variants, rows: NDArray[np.intp]) -> bool:
    """Whether variants that are refused alone are so among others too, where 1 / 0, say, is infinite."""
    try:
        return bool(job.results(given.at(rows)).lacking.all())
    except Exception:  # whatever a line does that cannot take an array
        return False


def _outermost(given: inputs.Variants, rows: NDArray[np.intp]) -> Iterator[int]:
    """The variants with the two least and the two greatest numbers of each input: there lines go other ways."""
    for x in given.at(rows).values():
        if np.ndim(x) and x.dtype.kind in "iuf":
            yield from rows[np.argpartition(x[:, 0], [0, 1, -2, -1])[[0, 1, -2, -1]]] if len(rows) > 1 else rows


def _apart(job: Job, given: inputs.Variants, rows: NDArray[np.intp]) -> bool:
    """Whether variants have the same results among others as among half of these, for two ways to part them."""
    whole, places = job.results(given.at(rows)), np.arange(len(rows))
    for k in range(min(2, (len(rows) - 1).bit_length())):
        for half in (places[places >> k & 1 == 0], places[places >> k & 1 == 1]):
            among = job.results(given.at(rows[half]))
            same = all(alike(x, whole.values[name][half]) for name, x in among.values.items())
            if not same or not np.array_equal(whole.lacking[half], among.lacking):
                return False
    return True


def _recorded(job: Job, given: inputs.Variants, rows: NDArray[np.intp]) -> Job:
    """The job by the recordings of some variants that know others, as many as pay for themselves."""
    from mechsheet.quantities.graph import NotRecorded  # on use: most worksheets take arrays of variants
    from mechsheet.readers.plan import NotPlanned  # likewise

    most = min(_RECORDINGS, rows.size // _PAYS)
    few = given.at(rows[np.linspace(0, len(rows) - 1, _PROBES).astype(int)[_SPREAD]])
    names, known, ways = varied(few), np.zeros(_PROBES, dtype=bool), list[tuple[float, ...]]()
    for k in range(_PROBES if all(few[name].dtype.kind == "f" for name in names) else 0):
        if len(ways) == most:
            break
        values = tuple(few[name][k, 0].item() for name in names)
        try:
            way = None if known[k] else job.way(values, few)
        except (NotPlanned, NotRecorded):
            break
        if way:
            known |= way.results({name: few[name][:, 0] for name in names})[1]
            ways.append(values)
    return replace(job, recorded=tuple(ways))


def _split(rows: NDArray[np.intp], chunk: int) -> list[NDArray[np.intp]]:
    return [rows[i : i + chunk] for i in range(0, len(rows), chunk)]
