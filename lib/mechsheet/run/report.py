"""The end of a worksheet: the workbook in the page, and in a script the report, the file and the exit code."""

import ast
import gc
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mechsheet import units
from mechsheet.document import parts
from mechsheet.document.left_out import left_out
from mechsheet.document.numberless import numberless
from mechsheet.quantities.graph import Gap
from mechsheet.quantities.lines import Recording, Residual
from mechsheet.readers.infinite import lose
from mechsheet.readers.largest import narrow
from mechsheet.readers.searched import search
from mechsheet.recording.dimensions import dimensions
from mechsheet.recording.record import record, record_every_line
from mechsheet.run import arguments, ending
from mechsheet.run.ending import say
from mechsheet.run.progress import if_long
from mechsheet.run.proving import proof_of
from mechsheet.workbook import inputs_sheet, writing
from mechsheet.workbook.arrangement import too_long
from mechsheet.workbook.find_sheet import FoundRow
from mechsheet.workbook.save import save
from mechsheet.worksheet import index, inputs, mistakes, numbers, source
from mechsheet.worksheet.cells import load, results
from mechsheet.worksheet.check import Check, refuse_open, unkept
from mechsheet.worksheet.errors import SheetError, some
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.no_inputs import beforehand, inputs_of
from mechsheet.worksheet.results import limited
from mechsheet.worksheet.scene import Limit
from mechsheet.worksheet.system import Solution
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.verdict import Verdict, lacking

T = TypeVar("T")


@contextmanager
def _uncollected() -> Iterator[None]:
    """Without looks for garbage: what is made stays, and each look goes over all of it."""
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.unfreeze()  # all counts as old now: the next look among what is new does not go over it either
        if was:
            gc.enable()


def export(title: str, namespace: Mapping[str, Any]) -> Any:
    """Workbook of every table, figure, check, found value and input that the cells show or give.

    ``namespace`` is the last cell's ``globals()``.

    In the page: a button that builds it when pressed, and then tells what it does not follow; beside it one that writes
    the document as a page in one file, and above them switches for what differs from the document's own inputs, for
    bands within tolerances, for what a result depends on, and for a proof of the digits of all numbers. In
    ``python worksheet.py``: prints the found values and the checks, writes ``NAME.xlsx`` into ``exports/`` of the
    project whose worksheet it is, elsewhere beside the worksheet (or into ``--out``), and exits with 1 where a check
    fails. Where a group does not close, nothing is written.
    """
    if not (isinstance(title, str) and isinstance(namespace, dict) and "__file__" in namespace):
        raise SheetError('export takes the title and the worksheet\'s names: export("Title", globals())')
    worksheet = Path(namespace["__file__"])
    if arguments.is_script(str(worksheet)):
        _script(title, namespace, worksheet)
        return None
    from mechsheet.html import write as html  # on use: a worksheet called as a function needs no page
    from mechsheet.page import design, of_file, study  # on use: as above
    from mechsheet.page.download import File, download  # on use: as above
    from mechsheet.run import banding, studied  # on use: only a page and tolerances need them

    def book() -> tuple[bytes, list[str]]:
        _refuse_part(namespace, worksheet)
        values = parts.values(namespace)
        recording, fit = _recorded(namespace, values)
        return _workbook(title, namespace, [*values, fit], values, recording), _not_followed(recording, [*values, fit])

    def page() -> tuple[bytes, list[str]]:
        of_file.refusing_another(namespace)()  # whose lines it would have, beside the numbers of this page
        _refuse_part(namespace, worksheet)
        return html.page(sheet(), inputs_of(namespace)).encode(), []

    sheet = partial(load, worksheet)  # each time as it is then: in the editor its lines change

    def proof(done: Callable[[int, int], object]) -> str:
        from mechsheet.page import proved  # on use: only a proof needs balls

        known = registry(namespace)
        fields = [name for name, line in known.items() if not line.arguments and np.ndim(namespace.get(name, 0.0))]
        shown = proof_of(namespace, sheet(), record(namespace, sheet(), whole=True, every=1, exact=True), fields, done)
        return proved.html(shown, _of(Table, parts.values(namespace)), known)

    def bands() -> Any:
        shown = parts.values(namespace)
        return banding.bands_of(namespace, sheet(), _of(Check, shown)), _of(Table, shown), _of(Figure, shown)

    matter = partial(studied.matters, namespace)
    results = partial(studied.results_of, namespace)  # in the editor they change, too
    asked = study.Asked(results, bands, matter, proof, partial(_own, worksheet))
    designing = design.Designing(results, partial(studied.designed, namespace))
    files = [File(f"{worksheet.stem}.xlsx", "Excel workbook", book)]
    if not studied.searches(worksheet):
        files.append(File(f"{worksheet.stem}.html", "Page in one file", page))
    return download(*files, asked=asked, designing=designing, namespace=namespace)


def _own(worksheet: Path) -> dict[str, Any]:
    """Namespace of a run of the worksheet as it stands, with its own inputs."""
    sheet = load(worksheet)
    return sheet.run(sheet.results, beforehand(inputs.build(sheet.inputs, {})))


def end(namespace: Mapping[str, Any]) -> None:
    """The end of a script in which no cell has called `export`: the same report, and no workbook."""
    if not ending.is_over():
        _script(None, namespace, Path(namespace["__file__"]))


def _script(title: str | None, namespace: Mapping[str, Any], worksheet: Path) -> None:
    """Report a run, write its workbook where it has a title, and exit with 1 where a check or a Find fails."""
    ending.over()
    _refuse_part(namespace, worksheet)
    declared = inputs.declared(type(inputs_of(namespace)))
    given = arguments.read(sys.argv[1:], declared)
    with arguments.usage():
        own = parts.values(namespace)
        own += unkept(namespace, own)
        values = limited(own, given.limits, namespace)
    refuse_open(_of(Check, values))
    unsolved = lacking(values)
    recording, fit = _recorded(namespace, values)
    checks = _of(Check, values)
    if checks or declared or registry(namespace):  # else units are compared with nothing
        checks.append(fit)
    bands = None
    if given.tolerances:
        from mechsheet.run import banding  # on use: as on the page

        bands = banding.bands_of(namespace, load(worksheet), checks)
    told = map(bands.told, checks) if bands else checks
    found = _of(Verdict, values)
    unnamed = (text for verdict in unsolved if verdict not in found for text in verdict.failures())
    say(*inputs.readings(declared, given.inputs), *found, *unnamed, *told, *_numberless(namespace, worksheet))
    if bands:
        say(*bands.lines())
    proved = dict[Check, float]()
    if given.proof:
        proof = proof_of(namespace, sheet := load(worksheet), record_every_line(namespace, sheet, exact=True))
        checks.append(proof.check(given.proof))
        proved = dict(proof.checks(given.proof))
        say(*proof.lines(), checks[-1])
    if title is None:
        why = f'no workbook is written: no cell calls export("{load(worksheet).title}", globals())'
        if given.out:
            raise arguments.UsageError(f"--out={given.out}: {why}")
        say(why, *_not_there(recording, [*values, fit]), *_left_out(namespace, worksheet))
    else:
        path = (given.out or folder(worksheet.resolve())) / f"{worksheet.stem}.xlsx"
        write(_workbook(title, namespace, [*values, fit, *proved], own, recording, proved), path)
        say(f"written {path}", *_not_followed(recording, [*values, fit]), *_left_out(namespace, worksheet))
    if unsolved or not all(check.passed for check in checks):
        sys.exit(1)


def _refuse_part(namespace: Mapping[str, Any], worksheet: Path) -> None:
    """Raise SheetError where some cells have not run: what they show would be missing, and its checks not counted."""
    if missing := [name for name in results(worksheet, certain=True) if name not in namespace]:
        raise SheetError(f"some cells did not run: {', '.join(some(missing))} missing")


def _numberless(namespace: Mapping[str, Any], worksheet: Path) -> Iterator[str]:
    """Where numbers get lost, a line for each."""
    text = worksheet.read_text(encoding="utf-8").splitlines()
    for line, where in numberless(namespace):
        number = line.expression.lineno
        yield f"{mistakes.at(worksheet, number, text[number - 1])}: {where}"


def _left_out(namespace: Mapping[str, Any], worksheet: Path) -> Iterator[str]:
    """What the document leaves out without a word, a line for each."""
    text = worksheet.read_text(encoding="utf-8").splitlines()
    for _, line, why in left_out(source.cells(namespace), namespace):
        yield why if line is None else f"{mistakes.at(worksheet, line, text[line - 1])}: {why}"
    yield from (f"{place}: {why}" for _, place, why in inputs.unlikely(type(inputs_of(namespace))))


def _not_followed(recording: Recording, values: Iterable[Any]) -> list[str]:
    """What the workbook does not follow, and what it has not, a line for each."""
    gaps = (f"not followed there: {gap}" for gap in (*recording.gaps, *recording.unsolved))
    return [*gaps, *_not_there(recording, values)]


def _not_there(recording: Recording, values: Iterable[Any]) -> list[str]:
    """The recorded tables, figures and checks that are not among the values, a line for each."""
    lacking = _recorded_ones(recording) - {*map(parts.called, values)}
    long = (f"not there: {line.symbol}, a line of too many numbers" for line in too_long(recording))
    return [*(f"not there: {name}, which has no name" for name in sorted(lacking)), *long]


def folder(worksheet: Path) -> Path:
    """Where what is written goes: into ``exports/`` of a clone of the project, elsewhere beside the worksheet."""
    for root in worksheet.parents:
        if worksheet.is_relative_to(root / "worksheets") and (root / "lib" / "mechsheet").is_dir():
            return root / "exports"
    return worksheet.parent


def write(data: bytes, path: Path) -> None:
    """Save a file, whole or not at all, in a folder that is made where there is none.

    Raises SheetError where either cannot be done.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SheetError(f"folder {path.parent} cannot be made: {error.strerror}") from None
    save(data, path)


def workbook(title: str, namespace: Mapping[str, Any], limits: Mapping[str, Limit]) -> bytes:
    """Workbook of a whole run of a worksheet, its checks under the limits of a scene."""
    own = parts.values(namespace)
    own += unkept(namespace, own)
    values = limited(own, limits, namespace)
    recording, fit = _recorded(namespace, values)
    return _workbook(title, namespace, [*values, fit], own, recording)


@_uncollected()
def _recorded(namespace: Mapping[str, Any], values: Iterable[Any]) -> tuple[Recording, Check]:
    """The recording of a run that shows some values, and the check of its units."""
    sheet = load(namespace["__file__"])
    recording = record_every_line(namespace, sheet)
    groups = (value if isinstance(value, tuple | list) else [value] for value in namespace.values())
    named = {parts.called(value) for group in groups for value in group}
    if unknown := {*map(parts.called, values)} - named - _recorded_ones(recording):
        shown = ((sheet.cells[n].lines[-1].lineno, each) for n, each in parts.by_cell(namespace).items())
        told = ((line, parts.called(value)) for line, each in shown for value in each)
        why = "it is shown under no name, by what is not recorded"
        recording.gaps += (Gap((name,), line, why) for line, name in told if name in unknown)
    fit = dimensions(recording, sheet, namespace, registry(namespace)).check()
    search(recording)  # whose steps need no units
    narrow(recording)
    lose(recording)
    mistakes, none = recording.graph.constant(fit.residual), recording.graph.constant(fit.limit)
    recording.checks[fit.name] = Residual([mistakes], none, "-", signed=True)  # the same for all inputs
    return recording, fit


def _recorded_ones(recording: Recording) -> set[str]:
    """What the tables, figures and checks of a recording are called."""
    tables = {f"figure {number[4:]}" if number.startswith("Fig ") else f"table {number}" for number in recording.tables}
    return tables | {f"check {name}" for name in recording.checks}


@_uncollected()
def _workbook(
    title: str,
    namespace: Mapping[str, Any],
    values: list[Any],
    own: list[Any],
    recording: Recording,
    proved: Mapping[Check, float] | None = None,
) -> bytes:
    """The workbook of a run with the ``values`` that it shows, with the limits of a scene instead of their ``own``."""
    limits = {check.name: check.limit for check in _of(Check, own)}
    with if_long("workbook") as shown:
        return writing.workbook(
            title,
            inputs=inputs_sheet.rows(inputs_of(namespace)),
            found=list(solved(namespace)),
            tables=_of(Table, values),
            figures=_of(Figure, values),
            checks=_of(Check, values),
            recording=recording,
            index=index.of_worksheet(namespace),
            fixed={check.name for check in _of(Check, values) if limits.get(check.name, check.limit) != check.limit},
            done=shown,
            proved={check.name: digits for check, digits in (proved or {}).items()},
        )


def _of(kind: type[T], values: Iterable[Any]) -> list[T]:
    return [value for value in values if isinstance(value, kind)]


def solved(namespace: Mapping[str, Any]) -> Iterator[FoundRow]:
    """Single numbers that are found, by the lines that take them: ``L4 = L4_found.value``, ``x = xy_found.value.x``.

    One that no such line takes has the name of its solve block.
    """
    blocks = dict[int, str]()  # the first name of each
    for name, value in namespace.items():
        if isinstance(value, Found | Solution):
            blocks.setdefault(id(value), name)
    taken = set[tuple[str, str]]()
    for line in registry(namespace).values():
        match line.expression:
            case ast.Attribute(ast.Name(source), "value") if isinstance(namespace.get(source), Found):
                unknown = ""
            case ast.Attribute(ast.Attribute(ast.Name(source), "value"), unknown):
                pass
            case _:
                continue
        block: Any = namespace.get(source)
        first = blocks.get(id(block))
        if first and _is_single(block):
            taken.add((first, unknown))
            yield _row(line.name, line.unit, line.meaning, source if unknown else first, block, unknown)
    for name in blocks.values():
        block = namespace[name]
        for unknown in ("",) if isinstance(block, Found) else block.words.names:
            if (name, unknown) not in taken and _is_single(block):
                own = f"{name}.value.{unknown}" if unknown else f"{name}.value"
                yield _row(own, block.words.unit_of(unknown), unknown or block.words.unknown, name, block, unknown)


def _is_single(block: Found | Solution) -> bool:
    return np.ndim(block.value if isinstance(block, Found) else block.condition) == 0


def _row(symbol: str, unit: str, meaning: str, source: str, block: Found | Solution, unknown: str) -> FoundRow:
    if isinstance(block, Found):
        return _found(symbol, unit, meaning, source, block)
    return _one_of_several(symbol, unit, meaning, source, block, unknown)


def _one_of_several(name: str, own: str, meaning: str, source: str, solution: Solution, unknown: str) -> FoundRow:
    """One of several unknowns, beside it the equation of the same number."""
    k = solution.words.names.index(unknown)
    unit, target = units.parse(own).factor, solution.words.equation_units[k]
    lower, upper = solution.interval[unknown]
    others = [s[k] for s in solution.solutions if s != solution.value]
    return FoundRow(
        name,
        solution.value[k] / unit,
        own,
        meaning,
        solution.residual[k] / units.parse(target).factor,
        target,
        lower / unit,
        upper / unit,
        ", ".join(numbers.significant(x / unit, 6) for x in others),
        f"{source}.{unknown}",
        kind="least squares" if solution.least else "found",
    )


def _found(name: str, own: str, meaning: str, source: str, found: Found) -> FoundRow:
    unit, target = units.parse(own).factor, units.parse(found.words.unit).factor
    others = [r for r in found.roots if (r.value, r.branch) != (found.value, found.branch or 0)]
    return FoundRow(
        name,
        found.value / unit,
        own,
        meaning,
        found.residual / target,
        found.words.unit,
        found.interval[0] / unit,
        found.interval[1] / unit,
        ", ".join(
            numbers.significant(r.value / unit, 6) + (f" (branch {r.branch:+d})" if r.branch else "") for r in others
        ),
        f"{source}.{found.words.unknown}",
        found.equals / target,
    )
