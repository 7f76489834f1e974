"""Workbooks of documents and examples as readers take them: one formula a column, no deep nesting, whole words."""

from __future__ import annotations

import re
import shutil
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple
from zipfile import ZipFile

import pytest
import written_cells
from openpyxl.utils import column_index_from_string, get_column_letter
from test_recalculation import CHANGED, whole

from mechsheet.run import report
from mechsheet.worksheet import cells, inputs

ROOT = Path(__file__).resolve().parents[1]
BOOKS = ("hitch", "landing_gear", "slotted_link", "kinetostatics", "joint", "bucket", "engine", "bolted_joint")
FEWER = {  # positions: a fifth of the cells, or half, with the same formulas
    "slotted_link": {"n: int = 6 ": "n: int = 3 "},
    "kinetostatics": {", 361)": ", 61)", "turn.value, R12=": "turn.value, 60, R12="},
    "engine": {", 361)": ", 61)", "turn.value // 2": "turn.value // 12", "turn=180": "turn=30"},
}
FIRST = 5  # row of the first number of a column
_ADDRESS = re.compile(r"(?<![A-Za-z_.\d])(\$?)([A-Z]{1,3})(\$?)(\d+)(?![\w(])")
_KEPT = re.compile(r",-?[\d.E+-]+,NA\(\)\)")

# Columns of several formulas and how many: each holds elements of several quantities, one after the other.
OF_SEVERAL = {
    "hitch": {"largest_1": 6, "largest_2": 6},  # reactions
    "landing_gear": {"scale_1": 3, "largest_1": 3, "largest_2": 3},  # accelerations, reactions
    "joint": {
        **dict.fromkeys(("y", "z", "A_t", "A_c"), 2),  # beams and stringers
        **dict.fromkeys(("y_b_1", "y_s_1", "z_b_1", "z_s_1"), 2),  # places in the two planes, of two columns
        "l_be": 2,
        "w_he": 3,
        "F_e": 2,
        "y_ce": 2,  # as printed and right
        "axes_40": 10,
        "steps_13": 10,  # steps of the iteration
        "A_A_1": 2,  # TRUE and FALSE, as exported
    },
    "engine": {
        "E_3": 2,  # the first one is none, behind it sums so far
        "size_13": 3,  # reactions
    },
    "slotted_link": {
        **dict.fromkeys(("guess_1", "size_1", "closed", "r_1", "slopes_14", "own_1"), 6),  # unknowns, equations
        "rates": 2,  # as the worksheet joins them
    },
}


@pytest.fixture(scope="module", params=BOOKS)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


class Book(NamedTuple):
    """What is written in the cells of each sheet, and all that stands in the file beside them and their widths."""

    cells: dict[str, dict[tuple[int, int], Any]]
    beside: dict[str, str]


@pytest.fixture(scope="module")
def worksheet(name: str, tmp_path_factory: pytest.TempPathFactory) -> cells.Worksheet:
    path = next((ROOT / "worksheets").rglob(f"{name}.py"))
    if name in FEWER:
        text = path.read_text(encoding="utf-8")
        for old, new in FEWER[name].items():
            assert old in text
            text = text.replace(old, new)
        path = Path(shutil.copytree(path.parent, tmp_path_factory.mktemp("fewer") / path.parent.name)) / path.name
        path.write_text(text, encoding="utf-8")
    return cells.load(path)


@pytest.fixture(scope="module")
def book(worksheet: cells.Worksheet, name: str) -> Callable[..., Book]:
    """The workbook of a worksheet, made once; with other inputs where these are changed."""

    @cache
    def made(changed: bool = False) -> Book:
        g = inputs.build(worksheet.inputs, whole(worksheet.inputs, CHANGED[name]) if changed else {})
        names = {**worksheet.run(worksheet.results, {"g": g}), "__file__": worksheet.path}
        file = BytesIO(report.workbook(worksheet.title, names, {}))
        held = {
            title: {at: formula or value for at, (formula, value) in sheet.items() if formula or value is not None}
            for title, sheet in written_cells.read(file).items()
        }
        with ZipFile(file) as parts:
            stored = written_cells.sheets(parts)
            beside = {title: re.sub("<cols>.*</sheetData>", "", _OF_SIZE.sub("", text)) for title, text in stored}
            for where in parts.namelist():
                if re.match("xl/(charts/|comments|workbook.xml)", where):
                    text = parts.read(where).decode()
                    beside[where] = re.sub("<c:(num|str)Cache>.*?</c:(num|str)Cache>", "", text)  # of numbers of cells
        return Book(held, beside)

    return made


# Rules for numbers of another size than those that the format of a cell is for; where printed pages end.
_OF_SIZE = re.compile(
    r"<conditionalFormatting [^>]*>"
    r"(?:<cfRule[^>]*><formula>_xlfn\.IFNA\((?:IF\()?LEN\(FIXED\([^<]*</formula></cfRule>)+"
    r"</conditionalFormatting>|<brk [^>]*/>"
)


def columns(book: Book) -> Iterator[tuple[str, str, list[tuple[int, Any]]]]:
    """Columns of tables and of what stands behind them: sheet, symbol, and rows with what stands there."""
    for title, sheet in book.cells.items():
        if (re.match(r"\d|Fig", title) and not title.endswith("lines")) or title.endswith("fields"):
            held = defaultdict[int, list[tuple[int, Any]]](list)
            for (row, column), value in sheet.items():
                if row >= FIRST:
                    held[column].append((row, value))
            yield from ((title, sheet[3, column], values) for column, values in held.items() if sheet.get((3, column)))


def seen_from(formula: str, row: int) -> str:
    """A formula with its relative rows counted from that of its cell; texts stay as they are.

    The number that it keeps for the exported inputs alone is one of its row.
    """
    formula = _KEPT.sub(",0,NA())", formula)

    def counted(found: re.Match[str]) -> str:
        across, down = column_index_from_string(found[2]), found[4] if found[3] else f"[{int(found[4]) - row}]"
        return f"R{down}C{across}"

    return "".join(
        part if n % 2 else _ADDRESS.sub(counted, part)
        for n, part in enumerate(re.split(r"(\"[^\"]*\"|'[^']*')", formula))
    )


def test_a_column_has_one_formula(name: str, book: Callable[..., Book]) -> None:
    """Filled down, seen from its cells; or plain numbers alone."""
    found = {}
    for _, symbol, held in columns(book()):
        formulas = {seen_from(value, row) for row, value in held if str(value).startswith("=")}
        count = len(formulas) + any(not str(value).startswith("=") for _, value in held) * bool(formulas)
        if count > 1:
            found[symbol] = max(count, found.get(symbol, 0))
    known = OF_SEVERAL.get(name, {})
    assert {symbol: count for symbol, count in found.items() if count > known.get(symbol, 1)} == {}
    assert found.keys() == known.keys(), "one that has one formula now is listed"


def test_no_formula_is_nested_deeper_than_eight(book: Callable[..., Book]) -> None:
    for title, sheet in book().cells.items():
        for place, text in sheet.items():
            if isinstance(text, str) and text.startswith("=") and not title.startswith("Input"):
                deepest = inside = 0
                for letter in re.sub("'[^']*'|\"[^\"]*\"|[^()'\"]+", "", text):
                    inside += (letter == "(") - (letter == ")")
                    deepest = max(deepest, inside)
                assert deepest <= 8, (title, place, text)


def written(book: Book) -> Iterator[tuple[str, str, Any]]:
    """All that is written in a workbook: where, under which heading, and what."""
    for title, sheet in book.cells.items():
        heads = 3 if title.endswith("fields") else 2
        for (row, column), value in sheet.items():
            yield f"{title}!{get_column_letter(column)}{row}", str(sheet.get((heads, column))), value
    # Names, comments, charts, rules, limits of fields.
    yield from ((part, "beside the cells", text) for part, text in book.beside.items())


def told(where: str, head: str, text: Any) -> bool:
    """Whether what is written of the exported inputs is one of them, or asks whether they are still the ones."""
    if where.startswith("Inputs!"):
        return head in ("Value", "As exported")
    if where.startswith("Input tables!"):
        return head == "as exported" or "." in head or not isinstance(text, str)
    if head == "A_A_1":  # areas from which the search begins; it tells whether it has ended
        return True
    if not isinstance(text, str):
        return False
    return bool(UNCHANGED.match(text)) or (
        text.startswith("=") and ("IF(inputs_changed=0," in text or "IF(AND(" in text)
    )


UNCHANGED = re.compile(r"=(AND\()+(TRUE|\w+)(,\w+=[-+\d.E]+(\*PI\(\))?\))+$")  # whether inputs are as exported


def guarded(head: str, formulas: list[str], asking: set[str]) -> bool:
    """Whether a number of the exported inputs is read only where they are still the ones."""
    read = [text for text in formulas if re.search(rf"\b{head}\b", text)]
    kept = re.compile(rf"IF\((\w+),{head},NA\(\)\)")
    return bool(read) and all(
        not re.search(rf"\b{head}\b", kept.sub("", text)) and {*kept.findall(text)} <= asking for text in read
    )


@pytest.mark.parametrize("name", [name for name in BOOKS if name != "kinetostatics"], indirect=True)
def test_what_is_written_is_the_same_for_other_inputs(name: str, book: Callable[..., Book]) -> None:
    """Titles, notes, limits, other roots, comments, names, axes: a formula, or what does not depend on the inputs."""
    one, other = list(written(book())), list(written(book(True)))
    assert [place[:2] for place in one] == [place[:2] for place in other]
    differ = [(a, b[2]) for a, b in zip(one, other, strict=True) if a[2] != b[2]]
    assert len(differ) >= 2 * len(CHANGED[name]), "each changed input is written, and as exported"
    formulas = [text for *_, text in one if isinstance(text, str) and text.startswith("=")]
    rows = {where: text for where, _, text in one}
    asking = {rows[where.replace("!B", "!A")] for where, _, text in one if UNCHANGED.match(str(text))}
    left = [pair for pair in differ if not (told(*pair[0]) and told(*pair[0][:2], pair[1]))]
    kept = {head for head in {head for (_, head, _), _ in left} if guarded(head, formulas, asking)}
    assert [pair for pair in left if pair[0][1] not in kept] == []
