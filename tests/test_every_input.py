"""Every input of every worksheet is given what people type: the result of that number, or one line that says why not.

The cells run as those of a page do: one that refuses stops those that need it and no other.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from mechsheet.page import values
from mechsheet.run import report
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError, raised
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.shown import Shown

ROOT = Path(__file__).parents[1]
SEARCHES = ("accuracy", "hitch_design")  # run for half a minute: what they are given is read, and no more
WORKSHEETS = sorted(path.stem for path in (ROOT / "worksheets").glob("*.py"))
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


@dataclass
class Run:
    """What the cells of a worksheet made of its inputs."""

    names: dict[str, Any]
    refusals: list[str] = field(default_factory=list)

    @property
    def open(self) -> list[Check]:
        return [check for check in cells.checks(self.names) if check.essential and not check.passed]

    @property
    def verdict(self) -> str:
        judged = cells.checks(self.names)
        if self.open:
            return "does not close"
        if self.refusals:
            return "refused by a cell"
        if not all(check.evaluated for check in judged):
            return "not evaluated"
        return "pass" if all(check.passed for check in judged) else "FAIL"


def ran(sheet: cells.Worksheet, g: Any) -> Run:
    run, lost = Run({**sheet.common, "g": g}), set[str]()
    with raised():
        for cell in sheet.needed((name for name in sheet.results if name != "form"), {"g": g}):
            try:
                if lost.isdisjoint(cell.needs):
                    exec(cell.code, run.names)
                    continue
            except SheetError as error:
                run.refusals.append(str(error))
            lost.update(cell.gives)
    return run


def typed(sheet: cells.Worksheet) -> Iterator[tuple[str, Callable[[object], dict[str, object]]]]:
    """What can be typed, by name, and the inputs that are given with it: of each column of a table its last cell."""
    default = sheet.inputs()
    for each in inputs.declared(sheet.inputs):
        if not isinstance(each, Rows):
            yield each.name, lambda value, name=each.name: {name: value}
            continue
        columns = each.display(getattr(default, each.name))
        for column, xs in columns.items():

            def given(
                value: object, each: Rows = each, others: Any = columns, column: str = column
            ) -> dict[str, object]:
                cells = {**others, column: [*others[column][:-1], value]}
                return {each.name: cells if each.row else cells[column]}

            yield f"{column} ({len(xs)})", given


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
    if run.verdict == "not evaluated":  # with the reason, which the check's own words give
        return "; ".join(str(check) for check in cells.checks(run.names) if not check.evaluated and not check.reason)
    return next((f"not one line: {text!r}" for text in run.refusals if "\n" in text), "")


def tried(path: Path, run_too: bool) -> tuple[Counter[str], list[str]]:
    """How the worksheet answers each text in each of its inputs, counted, and the answers that are none."""
    counts, wrong = Counter[str](), list[str]()
    sheet = cells.read(path)
    written = set[str]()
    for name, given in typed(sheet):
        runs = dict[float, str]()
        for text, number in TYPED.items():
            what = f"{path.stem} --{name}={text}"
            g, refusal = built(sheet, given(text))
            plain, why = (None, "no number") if number is None else built(sheet, given(number))
            if g != plain or bool(refusal) != bool(why):
                wrong.append(f"{what}: {refusal or g} in place of {why or plain}")
            elif refusal:
                counts["no number" if number is None else "outside its limits"] += 1
                if "\n" in refusal or f"{name} = " not in refusal:
                    wrong.append(f"{what}: {refusal!r} does not name it in a line")
            elif run_too:
                if number not in runs:
                    try:
                        run = ran(sheet, g)
                        for value in shown(run.names):
                            values.html(value)
                        if not run.refusals and not run.open and run.verdict not in written:
                            written.add(run.verdict)  # one workbook of each kind: a third of a second
                            report.workbook("", run.names, {})
                    except Exception as error:
                        run = Run({}, [f"{type(error).__name__}: {error}"])
                        wrong.append(f"{what}: {run.refusals[0]}")
                    if reason := what_is_wrong(run):
                        wrong.append(f"{what}: {reason}")
                    runs[number] = run.verdict
                counts[runs[number]] += 1
    return counts, wrong


@pytest.mark.parametrize("name", WORKSHEETS)
def test_whatever_is_typed_gives_the_result_of_that_number_or_one_line(
    name: str, record_property: Callable[[str, object], None]
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        counts, wrong = tried(ROOT / "worksheets" / f"{name}.py", name not in SEARCHES)
    record_property("table", f"{name:14}" + "".join(f"  {counts[answer]:4} {answer}" for answer in ANSWERS))
    assert set(counts) <= set(ANSWERS)
    assert not wrong, "\n".join(wrong)
