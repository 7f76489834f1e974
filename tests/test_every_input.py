"""Every input of every worksheet is given what people type: the result of that number, or one line that says why not.

The cells run as those of a page do: one that refuses stops those that need it and no other.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest
from hypothesis import settings

from mechsheet.page import values
from mechsheet.run import report
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.check import Check, checks_of
from mechsheet.worksheet.errors import SheetError, Waits, raised
from mechsheet.worksheet.kinds import Choice, Input, Switch
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.text_line import TextLine

T = TypeVar("T")
ROOT = Path(__file__).parents[1]
SEARCHES = ("accuracy", "hitch_design")  # run for half a minute: what they are given is read, and no more
WORKSHEETS = {path.stem: path for path in sorted((ROOT / "worksheets").rglob("*.py"))}
ANSWERS = (
    *("no number", "outside its limits", "does not close", "refused by a cell"),
    *("not evaluated", "FAIL", "pass"),
)
# What is typed, and the number that it is; None for what is none.
TYPED = {
    "0": 0.0,
    "-1": -1.0,
    "1e-300": 1e-300,
    "1e300": 1e300,
    "nan": None,
    "inf": None,
    "": None,
    "heavy": None,
    "1,5": 1.5,
    "1e3": 1000.0,
    "0x10": None,
    "1_000": None,
    "−1": -1.0,
    "12345678901234567890": 12345678901234567890.0,
}
READ = (1000.0, 12345678901234567890.0)  # numbers that are read, and run no other way than those beside them
# Of the kinds that are no number: what is typed, and what it is; None for what is none.
SWITCHED: dict[str, object] = {"yes": True, "No": False, "1": True, "0": False, "": None, "perhaps": None, "1,5": None}
OF_TEXT: dict[str, object] = {"Bridge 7": "Bridge 7", "  a  b ": "a b", "": "", "x" * 201: None, "a\x00b": None}
LISTED: dict[str, object] = {"1; 2,5": [1.0, 2.5], "3": [3.0], "1;; 2": None, "1 2": None, "heavy": None, "": None}


def texts_of(each: Input) -> dict[str, object]:
    """What is typed into an input of its kind, and what that is."""
    match each:
        case Choice(options=options):
            return {**{option: option for option in options}, "": None, "none of them": None}
        case Switch():
            return SWITCHED
        case TextLine():
            return OF_TEXT
        case Rows(row=None):
            return LISTED
        case Rows(columns=columns):
            row, count = "1; " * len(columns), len(columns)
            rows = {row: [[1.0] * count], f"{row}|{row}": [[1.0] * count] * 2, row + "1": None, "heavy": None}
            return {**rows, "": None, "no_such_file.csv": None}
    return dict(TYPED)


@dataclass
class Run:
    """What the cells of a worksheet made of its inputs."""

    names: dict[str, Any]
    refusals: list[str] = field(default_factory=list)
    waits: list[str] = field(default_factory=list)

    @property
    def open(self) -> list[Check]:
        return [check for check in checks_of(self.names) if check.essential and not check.passed]

    @property
    def verdict(self) -> str:
        judged = checks_of(self.names)
        if self.open:
            return "does not close"
        if self.refusals or self.waits:
            return "refused by a cell"
        if not all(check.evaluated for check in judged):
            return "not evaluated"
        return "pass" if all(check.passed for check in judged) else "FAIL"


def ran(sheet: cells.Worksheet, g: Any) -> Run:
    run, lost = Run({**sheet.common, "g": g}), set[str]()
    with raised(), np.errstate(**sheet.errors):
        for cell in sheet.needed(sheet.results, {"g": g}):
            try:
                if lost.isdisjoint(cell.needs):
                    exec(cell.code, run.names)
                    continue
            except Waits as error:
                run.waits.append(str(error))
            except SheetError as error:
                run.refusals.append(str(error))
            lost.update(cell.gives)
    return run


def typed(
    sheet: cells.Worksheet,
) -> Iterator[tuple[str, dict[str, object], Callable[[object], dict[str, object]]]]:
    """What is typed, by name, with what it is, and the inputs that are given with it.

    Of a list and a table that is the whole, and of each column the last cell.
    """
    default = sheet.inputs()
    for each in inputs.declared(sheet.inputs):
        yield each.name, texts_of(each), lambda value, name=each.name: {name: value}
        if not isinstance(each, Rows):
            continue
        columns = each.display(getattr(default, each.name))
        for column, xs in columns.items():

            def given(
                value: object, each: Rows = each, others: Any = columns, column: str = column
            ) -> dict[str, object]:
                cells = {**others, column: [*others[column][:-1], value]}
                return {each.name: cells if each.row else cells[column]}

            yield f"{column} ({len(xs)})", dict(TYPED), given


def built(sheet: cells.Worksheet, given: dict[str, object]) -> tuple[Any, str]:
    """Inputs with one replaced, or why they are refused."""
    try:
        return inputs.build(sheet.inputs, given), ""
    except SheetError as error:
        return None, str(error)


def shown(names: dict[str, Any]) -> list[Shown]:
    every = (v for value in names.values() for v in (value if isinstance(value, tuple | list) else (value,)))
    return [v for v in every if isinstance(v, Shown)]


def what_is_wrong(run: Run) -> str:
    """Nothing where a run ends in a verdict on every check, or in a line."""
    if run.open and run.refusals:
        return f"{run.open[0].name} fails, and behind it speaks: {run.refusals[0]}"
    if run.waits and not (run.open or run.refusals):
        judged = [check for check in checks_of(run.names) if not check.evaluated]
        if not any(check.reason for check in judged):
            return f"nothing tells why it waits: {run.waits[0]}"
    if run.verdict == "not evaluated":  # with the reason, which the check's own words give
        return "; ".join(str(check) for check in checks_of(run.names) if not check.evaluated and not check.reason)
    return next((f"not one line: {text!r}" for text in run.refusals if "\n" in text), "")


def tried(path: Path, run_too: bool) -> tuple[Counter[str], list[str]]:
    """How the worksheet answers each text in each of its inputs, counted, and the answers that are none."""
    counts, wrong = Counter[str](), list[str]()
    sheet = cells.read(path)
    drawn, written = set[tuple[str, str]](), set[str]() if is_search() else {"pass"}  # those stand in exports/
    for turn, (name, texts, given) in enumerate(typed(sheet)):
        accepted = dict[str, tuple[str, str, Any]]()
        for text, number in texts.items():
            what = f"{path.stem} --{name}={text}"
            g, refusal = built(sheet, given(text))
            plain, why = (None, "no number") if number is None else built(sheet, given(number))
            if g != plain or bool(refusal) != bool(why):
                wrong.append(f"{what}: {refusal or g} in place of {why or plain}")
            elif refusal:
                counts["no number" if number is None else "outside its limits"] += 1
                if "\n" in refusal or not re.search(rf"\b{re.escape(name)}( = |[ .]|:)|no_such_file.csv", refusal):
                    wrong.append(f"{what}: {refusal!r} does not name it in a line")
            elif run_too and number not in READ:
                accepted.setdefault(str(number), (text, what, g))
        for text, what, g in some([*accepted.values()], turn if texts.keys() == TYPED.keys() else None):
            try:
                run = ran(sheet, g)
                if (text, run.verdict) not in drawn:  # a page of each kind with each number
                    drawn.add((text, run.verdict))
                    for value in shown(run.names):
                        values.html(value)
                if not (run.refusals or run.waits or run.open) and run.verdict not in written:
                    written.add(run.verdict)  # one workbook of each kind: a third of a second
                    report.workbook("", run.names, {})
            except Exception as error:
                run = Run({}, [f"{type(error).__name__}: {error}"])
                wrong.append(f"{what}: {run.refusals[0]}")
            if reason := what_is_wrong(run):
                wrong.append(f"{what}: {reason}")
            counts[run.verdict] += 1
    return counts, wrong


def is_search() -> bool:
    return settings.default.max_examples > 100


def some(cases: list[T], turn: int | None) -> list[T]:
    """Two of the numbers that an input takes, others for each next one; all in a search, and of what is no number."""
    if turn is None or is_search():
        return cases
    return [cases[(turn + k) % len(cases)] for k in range(min(2, len(cases)))]


@pytest.mark.parametrize("name", WORKSHEETS)
def test_whatever_is_typed_gives_the_result_of_that_number_or_one_line(
    name: str, record_property: Callable[[str, object], None]
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        counts, wrong = tried(WORKSHEETS[name], name not in SEARCHES)
    record_property("table", f"{name:14}" + "".join(f"  {counts[answer]:4} {answer}" for answer in ANSWERS))
    assert set(counts) <= set(ANSWERS)
    assert not wrong, "\n".join(wrong)
