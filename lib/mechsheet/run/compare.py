"""Two states of a document: ``python -m mechsheet.run.compare WORKSHEET OLD NEW [--markdown]``.

A state is a scene, a workbook, a revision of git - the worksheet of that revision, run by this library - or a
worksheet's file as it is now.
"""

import ast
import io
import re
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from difflib import SequenceMatcher
from functools import cache, partial
from itertools import chain, zip_longest
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.document import parts
from mechsheet.run import arguments
from mechsheet.run.ending import say, watch
from mechsheet.run.silent import silently
from mechsheet.workbook.checks_sheet import verdict
from mechsheet.worksheet import inputs, mistakes, numbers, results, source
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.check import Check, unkept
from mechsheet.worksheet.errors import SheetError, cut, is_of_numbers
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.no_inputs import beforehand
from mechsheet.worksheet.results import Displayed
from mechsheet.worksheet.scene import Scene
from mechsheet.worksheet.table import Column, Figure, Table

_SAME = 1e-12  # of the greatest value of a result: what differs by less is rounding
_ZERO = 1e-13  # of the greatest value of its dimension: a result that is less may be zero but for rounding
_DRAWS = 4  # of inputs off by some roundings, which moves what is zero but for rounding
_ROUNDINGS = 64  # of an input at most
_ALIKE = 10  # times a limit that is a part of something: more is another part
_CHECK = "check "  # before the name of what one compares
_BEFORE = 12  # characters that are shown before what differs in a paragraph
_GAP = re.compile(r"\n\s*\n")  # between paragraphs
_AS_MUCH = 16  # times what these move it by: roundings of another kind may leave as much


class State(NamedTuple):
    """What a document shows in one state, by name."""

    inputs: dict[str, tuple[str, ...]]  # as they are listed, in full, and their limits with the tolerance
    formulas: dict[str, str]
    numbers: dict[str, Displayed]  # results, columns that stand in a table alone, and what checks compare
    verdicts: dict[str, str]
    shaken: Callable[[], dict[str, float]] | None = None  # how much roundings of the inputs move numbers, in SI
    texts: Mapping[str, str] = MappingProxyType({})
    checks: Mapping[str, Check] = MappingProxyType({})
    meanings: Mapping[str, str] = MappingProxyType({})  # of inputs and lines; titles of tables and figures
    prose: Sequence[tuple[str, str]] = ()  # paragraphs, each with the section in which it stands


class Change(NamedTuple):
    """What changed: an input, a formula, a number, a text, a check, its words; empty where there is none, by how much.

    Of prose what is written, whatever numbers stand in it.
    """

    kind: str
    name: str
    old: str
    new: str
    by: str = ""


def main() -> None:
    worksheet, *options = sys.argv[1:]
    watch(worksheet)
    try:
        found = _compared(Path(worksheet), options)
    except Exception as error:  # of the library or of the worksheet's own lines; 1 says that something differs
        told = str(error) if isinstance(error, SheetError) else mistakes.told(error, worksheet)
        print(f"error: {told}", file=sys.stderr)
        sys.exit(2)
    say(*(_markdown(found) if "--markdown" in options else _text(found)))
    sys.exit(1 if found else 0)


def _compared(worksheet: Path, options: Sequence[str]) -> list[Change]:
    names = [option for option in options if option != "--markdown"]
    if len(names) != 2 or any(name.startswith("--") for name in names):
        raise SheetError("compare takes a worksheet, two states and --markdown, such as hitch HEAD heavy.toml")
    with ExitStack() as folders:
        old, new = (state(worksheet, name, folders) for name in names)
        return list(changes(old, new))


def state(worksheet: Path, name: str, folders: ExitStack) -> State:
    """The document in a state; what a revision needs is put in a folder that ends with ``folders``.

    Raises SheetError where the state is neither a file nor a revision, or cannot be computed, with its name.
    """
    try:
        return _state(worksheet, name, folders)
    except Exception as error:  # of the worksheet's own lines
        told = str(error) if isinstance(error, SheetError) else mistakes.told(error, str(worksheet))
        raise SheetError(told if name in told else f"{name}: {told}") from None


def _state(worksheet: Path, name: str, folders: ExitStack) -> State:
    if Path(name).suffix.lower() in (".toml", ".xlsx"):
        file = worksheet
    elif Path(name).suffix.lower() == ".py":
        file = Path(name)
    else:
        file = Path(folders.enter_context(tempfile.TemporaryDirectory())) / worksheet.name
        _check_out(worksheet.resolve(), name, file.parent)
    with _own_modules(file.resolve().parent):
        sheet = load(file)
        is_scene = file is worksheet
        return _of(sheet, arguments.load(Path(name), inputs.declared(sheet.inputs)) if is_scene else Scene())


@contextmanager
def _own_modules(folder: Path) -> Iterator[None]:
    """Modules beside a worksheet are those of its own state."""
    before = set(sys.modules)
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in set(sys.modules) - before:
            file = Path(getattr(sys.modules[name], "__file__", None) or "")
            if file.is_relative_to(folder) and "site-packages" not in file.parts:
                del sys.modules[name]


def _check_out(worksheet: Path, revision: str, folder: Path) -> None:
    """The folder of the worksheet as it was in a revision, with the files that it reads."""
    command = ["git", "-C", str(worksheet.parent), "archive", "--format=tar", "--end-of-options", revision, "."]
    try:
        done = subprocess.run(command, capture_output=True)
    except OSError as error:
        raise SheetError(f"{revision} is no .toml or .xlsx, and git cannot be run: {error.strerror}") from None
    if done.returncode:
        said = done.stderr.decode(errors="replace").strip().splitlines() or ["git archive failed"]
        raise SheetError(f"{revision} is no .toml, no .xlsx and no revision of {worksheet.parent}: {said[-1]}")
    with tarfile.open(fileobj=io.BytesIO(done.stdout)) as tar:
        tar.extractall(folder, filter="data")
    if not (folder / worksheet.name).exists():
        raise SheetError(f"revision {revision} has no {worksheet.name}")


def _of(sheet: Worksheet, scene: Scene) -> State:
    g: Any = inputs.build(sheet.inputs, scene.inputs)
    names = sheet.run(sheet.results, beforehand(g))
    lines = registry(names)
    judged = results.limited(_checks(names), scene.limits, names)
    shown = _numbers(names)
    return State(
        {f.name: _shown(f, getattr(g, f.name)) for f in inputs.declared(sheet.inputs)},
        {name: ast.unparse(line.expression) for name, line in lines.items()},
        shown,
        {check.name: verdict(check) for check in judged},
        partial(_shaken, sheet, g, shown),
        {name: cut(text) for name, text in _texts(names, sheet.results)},
        {check.name: check for check in judged},
        dict(_meanings(type(g), names)),
        list(_prose(sheet)),
    )


def _meanings(declared: type, names: dict[str, Any]) -> Iterator[tuple[str, str]]:
    yield from ((field.name, field.meaning) for field in inputs.declared(declared))
    yield from ((name, line.meaning) for name, line in registry(names).items())
    for value in parts.values(names):
        if isinstance(value, Table | Figure):
            yield parts.called(value), value.title


def _prose(sheet: Worksheet) -> Iterator[tuple[str, str]]:
    for cell in sheet.cells:
        beside = (call.args for line in cell.lines for call in source.calls_of(line, "typeset"))
        for text in chain(source.texts(cell.lines), *beside):
            if not isinstance(text, ast.Constant | ast.JoinedStr):
                continue
            written = text.value if isinstance(text, ast.Constant) else ast.unparse(text)
            yield from ((cell.section, " ".join(part.split())) for part in _GAP.split(str(written)) if part.strip())


def _shaken(sheet: Worksheet, g: Any, own: Mapping[str, Displayed]) -> dict[str, float]:
    """By how much numbers move, in SI, where inputs are off by some roundings; runs to the end tell."""
    moved, rng = dict.fromkeys(own, 0.0), np.random.default_rng(0)
    for _ in range(_DRAWS):
        try:
            with silently(), _own_modules(Path(sheet.path).parent):
                there = _numbers(sheet.run(sheet.results, beforehand(_by_roundings(g, rng))))
        except Exception as error:
            if not is_of_numbers(error):
                raise
            continue
        for name in own.keys() & there.keys():
            a, b = _si(own[name]), _si(there[name])
            if a.shape == b.shape:
                moved[name] = max(moved[name], _greatest(b - a))
    return moved


def _by_roundings(g: Any, rng: np.random.Generator) -> Any:
    """Inputs that are off by some roundings each."""

    def off(x: Any) -> Any:
        near = x * (1 + np.finfo(float).eps * rng.integers(-_ROUNDINGS, _ROUNDINGS + 1, np.shape(x)))
        return near if isinstance(x, np.ndarray) else float(near)

    near = dict[str, Any]()
    for field in inputs.declared(type(g)):
        leaves = field.leaves(getattr(g, field.name))
        near[field.name] = field.held({name: off(x) if f.continuous else x for name, (f, x) in leaves.items()})
    return replace(g, **near) if near else g


def _numbers(names: dict[str, Any]) -> dict[str, Displayed]:
    lines = registry(names)
    found = [q for name, line in lines.items() for q in _quantities(name, line.arguments, names)]
    for name, column in _own_columns(names):
        if column.values.dtype.kind in "biuf" and column.values.size:
            found.append(Displayed(name, column.unit or "-", column.meaning, column.values.astype(float)))
    for check in _checks(names):
        found.append(Displayed(f"{_CHECK}{check.name}", _measured(check.unit), "", np.array([check.residual])))
    return {q.name: q for q in found}


def _measured(unit: str) -> str:
    """A unit; that of numbers for what is counted, in words."""
    try:
        units.parse(unit)
    except ValueError:
        return "-"
    return unit


def _checks(names: dict[str, Any]) -> list[Check]:
    kept = [value for value in parts.values(names) if isinstance(value, Check)]
    return kept + unkept(names, kept)


def _own_columns(names: dict[str, Any]) -> Iterator[tuple[str, Column]]:
    """Columns of tables that are not those of lines."""
    for table in (value for value in parts.values(names) if isinstance(value, Table)):
        yield from ((f"table {table.number} {column.symbol}", column) for column in table.columns if not column.of)


def _texts(names: dict[str, Any], of_cells: Iterable[str]) -> Iterator[tuple[str, str]]:
    yield from ((name, names[name]) for name in of_cells if isinstance(names.get(name), str))
    for name, column in _own_columns(names):
        if column.values.dtype.kind in "OU":
            yield name, "; ".join(map(str, column.values))


def _shown(field: Input, value: Any) -> tuple[str, ...]:
    unit = numbers.suffix(field.unit)
    limits = " ".join(f"{sign} {other}" for sign, other in field.limits)
    tolerance = field.tolerance.text(field.unit) if field.tolerance else ""
    return f"{field.brief(value)}{unit}", f"{field.text(value)}{unit}", "; ".join(filter(None, (limits, tolerance)))


def _quantities(name: str, takes: Sequence[str], names: dict[str, Any]) -> list[Displayed]:
    numeric = not takes and np.asarray(names.get(name)).dtype.kind in "biufc" and np.size(names[name])
    return results.quantities(name, names) if numeric else []


def changes(old: State, new: State) -> Iterator[Change]:
    """What differs, inputs first."""
    for name in dict.fromkeys([*old.inputs, *new.inputs]):
        a, b = old.inputs.get(name, ("", "", "")), new.inputs.get(name, ("", "", ""))
        if a[:2] != b[:2]:
            yield Change("input", name, a[0], b[0], "in a row that is not shown" if a[0] == b[0] else "")
        if name in old.inputs and name in new.inputs and a[2] != b[2]:
            yield Change("bound", name, a[2], b[2])
    for name in dict.fromkeys([*old.formulas, *new.formulas]):
        if old.formulas.get(name) != new.formulas.get(name):
            yield Change("formula", name, old.formulas.get(name, ""), new.formulas.get(name, ""))
    sizes = dict[Any, float]()  # the greatest value of each dimension, of whose rounding a zero has some
    for q in (*old.numbers.values(), *new.numbers.values()):
        dims = units.parse(q.unit).dims
        sizes[dims] = max(sizes.get(dims, 0.0), _greatest(_si(q)))

    @cache
    def rounding() -> dict[str, float]:
        both = [each.shaken() if each.shaken else dict.fromkeys(each.numbers, np.inf) for each in (old, new)]
        return {name: max(moved.get(name, 0.0) for moved in both) for name in old.numbers}

    moved = {
        name: [*_changed(name, old.numbers.get(name), new.numbers.get(name), sizes, rounding)]
        for name in dict.fromkeys([*old.numbers, *new.numbers])
    }
    yield from chain.from_iterable(found for name, found in moved.items() if not name.startswith(_CHECK))
    for name in dict.fromkeys([*old.texts, *new.texts]):
        if old.texts.get(name) != new.texts.get(name):
            yield Change("text", name, old.texts.get(name, ""), new.texts.get(name, ""))
    for name in (name for name in old.checks if name in new.checks):
        both = old.checks[name], new.checks[name]
        by = [change.by for change in moved.get(f"{_CHECK}{name}", []) if not _agree(*both)]
        if by or _has_another_limit(*both):
            yield Change("check", name, *map(_said, both), *by)
    for name in dict.fromkeys([*old.verdicts, *new.verdicts]):
        if old.verdicts.get(name) != new.verdicts.get(name):
            yield Change("verdict", name, old.verdicts.get(name, ""), new.verdicts.get(name, ""))
    for name in (name for name in old.meanings if name in new.meanings):
        if old.meanings[name] != new.meanings[name]:
            yield Change("meaning", name, old.meanings[name], new.meanings[name])
    for kind, i, j, k, m in SequenceMatcher(None, old.prose, new.prose, autojunk=False).get_opcodes():
        for before, after in zip_longest(old.prose[i:j], new.prose[k:m], fillvalue=("", "")):
            if kind != "equal":
                said = _from_where_they_differ(before[1], after[1])
                yield Change("paragraph", after[0] or before[0] or "text", *said)


def _from_where_they_differ(old: str, new: str) -> tuple[str, str]:
    same = next((n for n, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), 0)
    begin = old.rfind(" ", 0, max(0, same - _BEFORE)) + 1
    return cut(f"{'.. ' if begin else ''}{old[begin:]}"), cut(f"{'.. ' if begin else ''}{new[begin:]}")


def _agree(old: Check, new: Check) -> bool:
    """Whether two computations agree in both states: what they leave is rounding."""
    return old.agrees and new.agrees


def _has_another_limit(old: Check, new: Check) -> bool:
    """Whether a limit differs; that of an agreement, a part of what agrees, by more than this does for other inputs."""
    a, b = (check.limit * units.parse(_measured(check.unit)).factor for check in (old, new))
    same = abs(a - b) <= _SAME * abs(a) or (_agree(old, new) and a < _ALIKE * b and b < _ALIKE * a)
    return old.at_least != new.at_least or not (a == b or same)


def _said(check: Check) -> str:
    """What a check compares, and its limit."""
    residual, limit = check.compared
    return f"{residual} {'>=' if check.at_least else '<='} {limit}{numbers.suffix(check.unit)}"


def _si(quantity: Displayed) -> NDArray[np.float64]:
    return np.asarray(quantity.values * units.parse(quantity.unit).factor, dtype=float)


def _greatest(values: NDArray[np.float64]) -> float:
    """The greatest of the finite values, of either sign; 0 where there is none."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def _changed(
    name: str,
    old: Displayed | None,
    new: Displayed | None,
    sizes: Mapping[Any, float],
    rounding: Callable[[], Mapping[str, float]],
) -> Iterator[Change]:
    """A number that differs: by the greatest difference, in the new unit, and its part of the old greatest value."""
    said = ["" if q is None else f"{q.span}{numbers.suffix(q.unit)}{q.partly}" for q in (old, new)]
    if old is None or new is None:
        yield Change("number", name, said[0], said[1])
        return
    dims, own = units.parse(old.unit).dims, units.parse(new.unit)
    if old.values.shape != new.values.shape or dims != own.dims:
        what = "another unit" if dims != own.dims else f"{old.values.size} values, now {new.values.size}"
        yield Change("number", name, said[0], said[1], what)
        return
    a, b = _si(old), _si(new)
    finite = np.isfinite(a) & np.isfinite(b)
    gaps = ~finite & (a != b) & ~(np.isnan(a) & np.isnan(b))
    with np.errstate(invalid="ignore", over="ignore"):
        by = np.where(finite, b - a, 0.0)
    most = float(by.ravel()[int(np.abs(by).argmax())])
    greatest, size = _greatest(a), max(_greatest(a), _greatest(b))
    if not gaps.any() and abs(most) <= _SAME * size:
        if old.unit != new.unit:
            yield Change("number", name, said[0], said[1], "the same in another unit")
        return
    if not gaps.any() and size <= _ZERO * sizes[dims] and abs(most) <= _AS_MUCH * rounding()[name]:
        return
    part = f" ({_signed(100 * most / greatest, 3)} %)" if greatest else ""
    told = f"{_signed(most / own.factor, 4)}{numbers.suffix(new.unit)}{part}" if most else ""
    lost = f"{np.count_nonzero(gaps)} of {gaps.size} values differ by no finite number" if gaps.any() else ""
    yield Change("number", name, said[0], said[1], "; ".join(filter(None, (told, lost))))


def _signed(x: float, digits: int) -> str:
    return "+" * (x > 0) + numbers.apart([x], digits=digits)[0]


def _text(found: Sequence[Change]) -> Iterator[str]:
    if not found:
        yield "nothing differs"
    kind = ""
    for change in found:
        if change.kind != kind:
            kind = change.kind
            yield f"{kind}s:"
        by = f"  {change.by}" if change.by else ""
        yield f"  {change.name}: {change.old or 'none'} -> {change.new or 'none'}{by}"


def _markdown(found: Sequence[Change]) -> Iterator[str]:
    if not found:
        yield "Nothing differs."
        return
    yield "| what | name | old | new | by |"
    yield "| --- | --- | --- | --- | --- |"
    for change in found:
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in change) + " |"


if __name__ == "__main__":
    main()
