"""The end of a worksheet: the workbook in the page, and in a script the report, the file and the exit code."""

import ast
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

from mechsheet import units
from mechsheet.recording.record import record
from mechsheet.run import arguments
from mechsheet.workbook import writing
from mechsheet.workbook.find_sheet import FoundRow
from mechsheet.workbook.inputs_sheet import InputRow
from mechsheet.workbook.save import save
from mechsheet.worksheet import inputs, numbers
from mechsheet.worksheet.cells import results
from mechsheet.worksheet.checks import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.lines import Formula, registry
from mechsheet.worksheet.results import limited
from mechsheet.worksheet.scene import Limit
from mechsheet.worksheet.table import Figure, Table

T = TypeVar("T")


def export(title: str, namespace: Mapping[str, Any]) -> Any:
    """Workbook of every table, figure, check, found value and input in ``namespace``; the last cell's ``globals()``.

    In the page: a button that builds it when pressed. In ``python worksheet.py``: prints the found values
    and the checks, writes ``exports/NAME.xlsx`` (or into ``--out``), and exits with 1 where a name that
    some cell returns does not exist or a check fails. Where a group does not close, nothing is written.
    """
    worksheet = Path(namespace["__file__"])
    if arguments.is_script(str(worksheet)):
        _script(title, namespace, worksheet)
        return None
    import marimo as mo  # on use: a worksheet called as a function needs it not

    return mo.download(
        lambda: _workbook(title, namespace, _values(namespace, results(worksheet))),
        filename=f"{worksheet.stem}.xlsx",
        label="Excel workbook",
    )


def _script(title: str, namespace: Mapping[str, Any], worksheet: Path) -> None:
    names = results(worksheet)
    missing = [name for name in names if name not in namespace]
    if missing:
        raise SheetError(f"some cells did not run: {', '.join(missing)} missing")
    given = arguments.read(sys.argv[1:], inputs.declared(type(namespace["g"])))
    values = limited(_values(namespace, names), given.limits, namespace)
    checks = _of(Check, values)
    for check in checks:
        if check.essential and not check.passed:
            raise SheetError(f"{check.name}: {check.reason}" if check.reason else str(check))
    for found in _of(Found, values):
        print(found)
    for check in checks:
        print(check)
    path = (given.out or worksheet.resolve().parent.parent / "exports") / f"{worksheet.stem}.xlsx"
    write(_workbook(title, namespace, values), path)
    print(f"written {path}")
    if not all(check.passed for check in checks):
        sys.exit(1)


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
    values = _values(namespace, results(namespace["__file__"]))
    return _workbook(title, namespace, limited(values, limits, namespace))


def _workbook(title: str, namespace: Mapping[str, Any], values: list[Any]) -> bytes:
    return writing.workbook(
        title,
        inputs=[
            InputRow(f.name, value, f.unit, f.meaning, f.section) for f, value in inputs.Used(namespace["g"]).rows()
        ],
        found=[_found(line, found) for line, found in solved(namespace)],
        tables=_of(Table, values),
        figures=_of(Figure, values),
        checks=_of(Check, values),
        recording=record(namespace),
    )


def _values(namespace: Mapping[str, Any], names: Iterable[str]) -> list[Any]:
    """Values by their place in the worksheet, each of a group on its own."""
    order = {name: i for i, name in enumerate(names)}
    ordered = (namespace[name] for name in sorted(namespace, key=lambda name: order.get(name, len(order))))
    return [v for value in ordered for v in (value if isinstance(value, tuple | list) else [value])]


def _of(kind: type[T], values: Iterable[Any]) -> list[T]:
    return [value for value in values if isinstance(value, kind)]


def solved(namespace: Mapping[str, Any]) -> Iterator[tuple[Formula, Found]]:
    """Lines whose value is found, such as ``L4 = L4_found.value``, and what was found."""
    for line in registry(namespace).values():
        match line.expression:
            case ast.Attribute(ast.Name(source), "value") if isinstance(namespace.get(source), Found):
                yield line, namespace[source]


def _found(line: Formula, found: Found) -> FoundRow:
    unit, target = units.parse(line.unit).factor, units.parse(found.words.unit).factor
    others = [r for r in found.roots if (r.value, r.branch) != (found.value, found.branch or 0)]
    return FoundRow(
        line.name,
        found.value / unit,
        line.unit,
        line.meaning,
        found.residual / target,
        found.words.unit,
        found.interval[0] / unit,
        found.interval[1] / unit,
        ", ".join(
            numbers.significant(r.value / unit, 6) + (f" (branch {r.branch:+d})" if r.branch else "") for r in others
        ),
        found.words.unknown,
        found.equals / target,
    )
