"""Many scenes of one worksheet: each computed on its own, all side by side in a table and a workbook."""

import glob
import shutil
import signal
import sys
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet.document import parts
from mechsheet.recording.record import record
from mechsheet.run import banding, report
from mechsheet.run.arguments import UsageError, read, usage
from mechsheet.run.arguments import load as load_scene
from mechsheet.run.ending import INTERRUPTED, MISUSED, say, warn, warn_in_lines, watch
from mechsheet.run.progress import progress
from mechsheet.run.proving import proof_of, proof_of_wanted
from mechsheet.run.units_once import units_of
from mechsheet.workbook import writing
from mechsheet.workbook.checks_sheet import verdict
from mechsheet.worksheet import inputs, mistakes, numbers, results
from mechsheet.worksheet.cells import Worksheet, base, is_result, load, value
from mechsheet.worksheet.check import Check, checks_of, refuse_open, unkept
from mechsheet.worksheet.errors import SheetError, cut
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.no_inputs import beforehand
from mechsheet.worksheet.results import Displayed
from mechsheet.worksheet.scene import Scene
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.verdict import lacking, listen

_GAP = 2  # characters between columns
_MOST = 16384 - 3  # columns of a workbook's sheet behind symbol, unit and meaning


@dataclass(frozen=True)
class Outcome:
    """What became of a scene: its inputs, how their texts were read, results, checks, proof and bands, or the error.

    ``given`` is what it gives for inputs, None where that cannot be read; where it is refused there is no ``g``.
    ``misused`` tells that the error is of what is given; ``unsolved`` why solve blocks without a value have none.
    """

    name: str
    g: Any = None
    given: Mapping[str, Any] | None = None
    quantities: tuple[Displayed, ...] = ()
    tables: tuple[Table, ...] = ()
    checks: tuple[Check, ...] = ()
    readings: tuple[str, ...] = ()
    error: str = ""
    misused: bool = False
    proof: tuple[str, ...] = ()
    bands: tuple[str, ...] = ()
    unsolved: tuple[str, ...] = ()

    @property
    def problems(self) -> list[str]:
        """Why the scene did not pass, a line each."""
        failed = [str(check) for check in self.checks if not check.passed]
        gaps = [f"FAIL  {quantity.gaps}" for quantity in self.quantities if quantity.gaps]
        return [self.error] if self.error else [*failed, *gaps, *self.unsolved]

    @property
    def verdict(self) -> str:
        return "error" if self.error else "FAIL" if self.problems else "pass"


def compute(sheet: Worksheet, name: str, given: Scene) -> tuple[Outcome, dict[str, Any]]:
    """Outcome of one scene and the namespace of its run; only the cells that it needs are run.

    Without wanted results the whole worksheet is needed, and its found values are the results.

    Raises UsageError for a name that is not known, SheetError where an input or the mechanism cannot be used.
    """
    g: Any = inputs.build(sheet.inputs, given.inputs)
    with usage():
        sheet.needed([*given.want, *given.limits], beforehand(g))
    with listen():
        names = sheet.run([*(given.want or sheet.results), *given.limits], beforehand(g))
        unsolved = lacking(names.values())
    held = checks_of(names) if given.want else [value for value in parts.values(names) if isinstance(value, Check)]
    held += unkept(names, held)
    with usage():
        judged = results.limited(held, given.limits, names)
    refuse_open(judged)
    quantities, tables = dict[str, Displayed](), list[Table]()
    found = (row.symbol for row in report.solved(names))
    for want in dict.fromkeys([*(given.want or found), *given.limits]):
        named = next((check for check in judged if check.name == want), None)
        what = names[want] if is_result(want, names) else named
        if what is None and want in given.want and not base(want).isidentifier():
            with usage():
                value(want, names)  # tells that there is no such check
        if isinstance(what, Table):
            tables.append(what)
        elif base(want).isidentifier() and not _is_check(what):
            with usage():
                quantities |= {quantity.name: quantity for quantity in results.quantities(want, names)}
    if not given.want:
        judged.append(units_of(names, sheet))
    told, proved = inputs.readings(inputs.declared(sheet.inputs), given.inputs), tuple[str, ...]()
    if given.proof:
        wanted = [*given.want, *given.limits]
        proof = (
            proof_of_wanted(names, sheet, wanted)
            if given.want
            else proof_of(names, sheet, record(names, sheet, exact=True))
        )
        judged, proved = [*judged, proof.check(given.proof)], tuple(proof.lines())
    bands = tuple(banding.lines(names, sheet, given, [*quantities], judged)) if given.tolerances else ()
    shown = tuple(quantities.values()), tuple(tables), tuple(judged), tuple(told)
    return Outcome(name, g, given.inputs, *shown, proof=proved, bands=bands, unsolved=tuple(map(str, unsolved))), names


def answer(worksheet: str, given: Scene) -> int:
    """Exit code of a script whose scene wants some results: prints them, writes a file only where ``out`` is given."""
    sheet = load(worksheet)
    outcome, _ = compute(sheet, "scene", given)
    say(*outcome.readings, *outcome.quantities, *_told(outcome.tables))
    say(*(check for check in outcome.checks if check.passed), *outcome.proof, *outcome.bands, *outcome.problems)
    if given.out:
        report.write(comparison(sheet, [outcome]), given.out / _summary(sheet))
    return 1 if outcome.problems else 0


def comparison(sheet: Worksheet, outcomes: Sequence[Outcome]) -> bytes:
    """Workbook of all outcomes side by side: inputs that differ from the document's, results, checks and verdicts."""
    rows: list[tuple[str | float, ...]] = [("Inputs that differ from the worksheet's",)]
    default = sheet.inputs()
    for field in _changed(default, outcomes):
        shown = (_written(field, o, default) for o in outcomes)
        rows.append((field.name, numbers.in_text(field.unit), field.meaning, *shown))
    rows.append(("Results",))
    fields = list[Table]()
    for name, quantity in _quantities(outcomes).items():
        each = [{q.name: q.values for q in o.quantities}.get(name) for o in outcomes]
        ends = {f"{name} least": np.min, f"{name} greatest": np.max}
        if all(x is None or x.size == 1 for x in each):
            ends = {name: np.min}
        else:
            fields.append(_field(quantity, {o.name: x for o, x in zip(outcomes, each, strict=True) if x is not None}))
        for head, end in ends.items():
            shown = ("" if x is None else float(end(x)) for x in each)
            rows.append((head, numbers.in_text(quantity.unit), quantity.meaning, *shown))
    rows.append(("Checks",))
    for name in dict.fromkeys(check.name for o in outcomes for check in o.checks):
        verdicts = ({c.name: verdict(c) for c in o.checks}.get(name, "") for o in outcomes)
        rows.append((name, "", "", *verdicts))
    rows.append(("Verdict",))
    rows.append(("verdict", "", "", *("PASS" if o.verdict == "pass" else "FAIL" for o in outcomes)))
    rows.append(("reason", "", "", *("; ".join(o.problems) for o in outcomes)))
    tables = [
        Table(table.number, f"{o.name} {table.number} {table.title}", table.columns, table.note)
        for o in outcomes
        for table in o.tables
    ]
    return writing.comparison(sheet.title, [o.name for o in outcomes], rows, fields + tables)


def run(worksheet: str, arguments: Sequence[str]) -> int:
    """Exit code of ``mechsheet run WORKSHEET SCENE.. [--out=FOLDER] [--jobs=N] [--NAME=VALUE ..]``.

    It is 0 where all pass, 2 where what is given of any cannot be used, else 1.

    Prints a table of the scenes, and what each tells alone. Into ``out`` go a workbook of all of them side by side, and
    one of each scene that wants the whole worksheet; without it nothing is written. Arguments replace inputs of every
    scene. ``jobs`` are processes that compute scenes at the same time.

    Raises SheetError where the worksheet cannot be used, UsageError for arguments, and for two scenes of one name.
    """
    sheet = load(worksheet)
    files = [Path(name) for argument in arguments if not argument.startswith("-") for name in _expanded(argument)]
    with usage():
        if not files:
            raise SheetError("no scene given")
        jobs, options = _jobs([argument for argument in arguments if argument.startswith("-")])
        out = read(options, inputs.declared(sheet.inputs)).out
        _distinct(sheet, files, out)
    outcomes = list[Outcome]()
    try:
        names = [file.stem for file in files]
        with progress(len(files), names[0]) as done:
            attempts = _attempts(sheet, files, options, out, min(jobs, len(files)))
            for outcome, following in zip(attempts, [*names[1:], ""], strict=True):
                outcomes.append(outcome)
                done(following)
        if out:
            report.write(comparison(sheet, outcomes), out / _summary(sheet))
    except KeyboardInterrupt:
        print(f"\ninterrupted after {len(outcomes)} of {len(files)} scenes", file=sys.stderr)
        return INTERRUPTED
    for block in _blocks(_table(sheet, outcomes), shutil.get_terminal_size((120, 24)).columns):
        say(*_text(block), "")
    for outcome in outcomes:
        told = *outcome.readings, *_told(outcome.tables), *outcome.proof, *outcome.bands, *outcome.problems
        say(*(f"{outcome.name}: {text}" for text in told))
    failed = sum(o.verdict != "pass" for o in outcomes)
    say(f"{len(outcomes) - failed} of {len(outcomes)} scenes pass" + (f", written to {out}" if out else ""))
    return MISUSED if any(o.misused for o in outcomes) else 1 if failed else 0


def _jobs(options: Sequence[str]) -> tuple[int, list[str]]:
    """Number of processes that the last ``--jobs=N`` asks for, one where there is none, and the other options."""
    given = [option.partition("=")[2] for option in options if option.startswith("--jobs=")]
    for text in given:
        if not (text.isascii() and text.isdecimal() and int(text)):
            raise SheetError(f"jobs = {text} must be a number of processes, at least 1")
    return int(given[-1]) if given else 1, [option for option in options if not option.startswith("--jobs=")]


def _attempts(
    sheet: Worksheet, files: Sequence[Path], options: Sequence[str], out: Path | None, jobs: int
) -> Iterator[Outcome]:
    """Outcomes of the scenes in their order, computed here or by several processes."""
    if jobs == 1:
        yield from (attempt(sheet, file, options, out) for file in files)
        return
    from concurrent.futures import ProcessPoolExecutor  # on use: one process needs nothing of it
    from multiprocessing import get_context  # on use: as above

    pool = ProcessPoolExecutor(jobs, get_context("spawn"), signal.signal, (signal.SIGINT, signal.SIG_IGN))
    try:
        found = pool.map(partial(_elsewhere, sheet.path, options=options, out=out), files)
        for file, (outcome, built, warned) in zip(files, found, strict=True):
            for line in warned:
                warn(line)
            yield replace(outcome, g=_inputs(sheet, file, options)) if built else outcome
    finally:
        pool.shutdown(cancel_futures=True)


def _elsewhere(path: str, file: Path, options: Sequence[str], out: Path | None) -> tuple[Outcome, bool, list[str]]:
    """Outcome of a scene without its inputs, whose class no other process knows, whether they could be built, and what
    it warns of.
    """
    warned = list[str]()
    with warnings.catch_warnings():
        warn_in_lines(path, warned.append)
        outcome = attempt(load(path), file, options, out)
    return replace(outcome, g=None), outcome.g is not None, warned


def _inputs(sheet: Worksheet, file: Path, options: Sequence[str]) -> Any:
    """The inputs of the scene of a file."""
    given = read([f"--scene={file}", *options], inputs.declared(sheet.inputs))
    return inputs.build(sheet.inputs, given.inputs)


def attempt(sheet: Worksheet, file: Path, options: Sequence[str], out: Path | None) -> Outcome:
    """Outcome of the scene of a file; whatever goes wrong stays its own."""
    try:
        given = read([f"--scene={file}", *options], inputs.declared(sheet.inputs), sheet.results)
        outcome, names = compute(sheet, file.stem, given)
        if out and not given.want:
            title = f"{sheet.title}: {file.stem}"
            report.write(report.workbook(title, names, given.limits), out / _workbook(sheet, file))
        return outcome
    except SheetError as error:
        return replace(_failed(sheet, file, options), error=str(error), misused=isinstance(error, UsageError))
    except Exception as error:  # of a line of the worksheet, which other scenes may well pass
        return replace(_failed(sheet, file, options), error=mistakes.told(error, sheet.path))


def _failed(sheet: Worksheet, file: Path, options: Sequence[str]) -> Outcome:
    """Outcome of a scene that goes no further than to its inputs, be they refused."""
    declared = inputs.declared(sheet.inputs)
    try:
        given = load_scene(file, declared).inputs | read(options, declared).inputs
    except SheetError:
        return Outcome(file.stem)
    try:
        return Outcome(file.stem, inputs.build(sheet.inputs, given), given)
    except SheetError:
        return Outcome(file.stem, None, given)


def _expanded(argument: str) -> list[str]:
    """Files of a pattern such as ``scenes/*.toml``, which Windows hands over as it is."""
    return sorted(glob.glob(argument)) or [argument]


def _summary(sheet: Worksheet) -> str:
    return f"{Path(sheet.path).stem}_scenes.xlsx"


def _workbook(sheet: Worksheet, file: Path) -> str:
    return f"{Path(sheet.path).stem}_{file.stem}.xlsx"


def _distinct(sheet: Worksheet, files: Sequence[Path], out: Path | None) -> None:
    """Refuse scenes that would overwrite one another, be overwritten themselves, or be left out of the workbook."""
    seen = dict[str, Path]()
    for file in files:
        name = _workbook(sheet, file)
        if name in {_summary(sheet), *seen}:
            raise SheetError(f"scene {file} has the name of {seen.get(name, 'the summary')}")
        seen[name] = file
    if out:
        if len(files) > _MOST:
            raise SheetError(f"{len(files)} scenes have no room side by side in a workbook: at most {_MOST}, in parts")
        written = {(out / name).resolve() for name in (*seen, _summary(sheet))}
        for file in files:
            if file.resolve() in written:
                raise SheetError(f"scene {file} would be overwritten; give another folder than --out={out}")


def _is_check(what: Any) -> bool:
    return isinstance(what, Check) or (isinstance(what, tuple) and all(isinstance(part, Check) for part in what))


def _changed(default: Any, outcomes: Sequence[Outcome]) -> list[Input]:
    """Inputs that are not those of the worksheet in some scene, be they refused there."""
    used = [o.g for o in outcomes if o.g is not None]
    refused = {name for o in outcomes if o.g is None for name in o.given or ()}
    return [
        field
        for field in inputs.declared(type(default))
        if field.name in refused
        or not all(field.same(getattr(g, field.name), getattr(default, field.name)) for g in used)
    ]


def _written(field: Input, outcome: Outcome, default: Any) -> str | float:
    """An input of a scene as a cell has it: a number, or the text of another kind; what is refused as it is given."""
    if outcome.g is None:
        if outcome.given is None:
            return ""
        if field.name in outcome.given:
            given = outcome.given[field.name]
            try:
                return field.read(given) if type(field) is Input else cut(str(given))
            except SheetError:
                return cut(str(given))
    value = getattr(default if outcome.g is None else outcome.g, field.name)
    return field.display(value) if type(field) is Input else field.brief(value)


def _quantities(outcomes: Iterable[Outcome]) -> dict[str, Displayed]:
    return {q.name: q for q in chain.from_iterable(o.quantities for o in outcomes)}


def _field(quantity: Displayed, each: dict[str, Any]) -> Table:
    """A quantity over its positions, one column a scene; a shorter one ends in gaps."""
    size = max(x.size for x in each.values())
    number = Column("k", "-", "number of the position", 0, np.arange(1.0, size + 1))
    columns = [
        Column(name, quantity.unit, quantity.meaning, 3, np.append(x.ravel(), np.full(size - x.size, np.nan)))
        for name, x in each.items()
    ]
    return Table("", quantity.name, (number, *columns), quantity.meaning)


def _table(sheet: Worksheet, outcomes: Sequence[Outcome]) -> list[list[str]]:
    """The summary in words: a row a quantity, a column a scene."""
    rows = [["", *(o.name for o in outcomes)]]
    default = sheet.inputs()
    for field in _changed(default, outcomes):
        given = (_written(field, o, default) for o in outcomes)
        texts = (x if isinstance(x, str) else numbers.significant(x, 10) for x in given)
        rows.append([f"{field.name} [{numbers.in_text(field.unit)}]", *texts])
    for name, quantity in _quantities(outcomes).items():
        spans = ({q.name: q.span + q.partly for q in o.quantities}.get(name, "") for o in outcomes)
        rows.append([f"{name} [{numbers.in_text(quantity.unit)}]", *spans])
    passed = (f"{sum(check.passed for check in o.checks)} of {len(o.checks)}" if o.checks else "" for o in outcomes)
    return [*rows, ["checks passed", *passed], ["verdict", *(o.verdict for o in outcomes)]]


def _blocks(rows: Sequence[Sequence[str]], width: int) -> Iterator[list[Sequence[str]]]:
    """The rows in parts that are as wide as the terminal, each under the first column."""
    first, *columns = zip(*rows, strict=True)
    block, size = [first], max(map(len, first))
    for column in columns:
        wide = _GAP + max(map(len, column))
        if len(block) > 1 and size + wide > width:
            yield list(zip(*block, strict=True))
            block, size = [first], max(map(len, first))
        block, size = [*block, column], size + wide
    yield list(zip(*block, strict=True))


def _told(tables: Iterable[Table]) -> Iterator[str]:
    """Lines of wanted tables."""
    for table in tables:
        yield f"Table {table.number} - {table.title}"
        yield from _text(_printed(table))


def _printed(table: Table) -> list[list[str]]:
    """A table as it is printed: symbols, units, numbers."""
    heads = [[c.symbol for c in table.columns], [c.unit and f"[{numbers.in_text(c.unit)}]" for c in table.columns]]
    columns = [c.texts(numbers.PLAIN) for c in table.columns]
    return heads + [list(row) for row in zip(*columns, strict=True)]


def _text(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Lines of rows in columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield (" " * _GAP).join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip()


def main() -> int:
    """``python -m mechsheet.run.batch WORKSHEET SCENE..``"""
    worksheet, *given = sys.argv[1:]
    watch(worksheet)
    return run(worksheet, given)


if __name__ == "__main__":
    sys.exit(main())
