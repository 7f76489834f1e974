"""Workbooks recalculate: LibreOffice computes every cell again, and each agrees with the worksheet's own run."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any
from zipfile import ZipFile

import numpy as np
import pandas as pd
import pytest
import written_cells
from openpyxl import Workbook, load_workbook
from own_worksheet import written
from test_recorded_worksheet import FOLLOWED, own
from typed_workbook import typed
from written_cells import Values

from mechsheet import evaluate
from mechsheet.run import arguments, batch, report
from mechsheet.workbook import reading
from mechsheet.workbook.place import DefinedNames
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lists import Rows

ROOT = Path(__file__).resolve().parents[1]
CHANGED = {  # lengths, loads and angles of each worksheet; "0,47" is typed as a text
    "hitch": {"P6": 25e3, "L5": "0,47", "X07": 0.42, "phi_BD": 23, "S_max": 0.66, "Y_P56": 0.42, "D_gc": 0.085},
    "landing_gear": {"theta": 80, "t_r": "9,5", "m3": 900, "a": 0.21, "U": -70},
    "slotted_link": {"L1": 0.21, "omega1": -9, "L0": "0,52"},
    "kinetostatics": {"m4": 3, "n1": "290,5", "l4": 0.46, "phi05": -9},
    "joint": {"loads.N (1)": 12500, "beams.z (3)": "-13", "alpha (1)": -3, "ring_loads.M (1)": 2.1e6, "psi": 0.6},
    "bucket": {"p_c": 30, "L_CB": "0,6", "phi_open": 8, "m": 1000},
    "engine": {"r": 52, "e": "-2,5", "n": 2100, "iron": "steel", "delta": "1,5", "m_P": 1.4},
    "bolted_joint": {"grade": "10.9", "part": "aluminium", "d": 0.48, "nu": "0,8", "x_G": 3.5, "D_A": 1.1},
}
FOLDERS = ROOT / "worksheets", ROOT / "worksheets" / "examples"


def exported(name: str) -> Path:
    """The workbook as it stands in exports/, which other tests keep current."""
    return ROOT / "exports" / f"{name}.xlsx"


def whole(cls: type, changes: dict[str, Any]) -> dict[str, Any]:
    """Inputs as they are given, of lists and tables all elements, from elements such as ``bolts.x (2)``."""
    left, default = dict(changes), cls()
    for field in inputs.declared(cls):
        if isinstance(field, Rows):
            columns = field.display(getattr(default, field.name))
            named = {name: [f"{name} ({k + 1})" for k in range(len(xs))] for name, xs in columns.items()}
            if left.keys() & {element for elements in named.values() for element in elements}:
                filled = [
                    [left.pop(e, x) for e, x in zip(named[name], xs, strict=True)] for name, xs in columns.items()
                ]
                left[field.name] = " | ".join("; ".join(map(str, row)) for row in zip(*filled, strict=True))
    return left


def export(name: str, out: Path, changes: dict[str, Any]) -> Path:
    script = next(path for folder in FOLDERS if (path := folder / f"{name}.py").exists())
    return computed(script, out, whole(cells.load(script).inputs, changes))


def computed(worksheet: Path, out: Path, given: Mapping[str, Any]) -> Path:
    """The workbook of a worksheet on other inputs, as its script writes it."""
    sheet, path = cells.load(worksheet), out / f"{worksheet.stem}.xlsx"
    scene = arguments.read([f"--{key}={value}" for key, value in given.items()], inputs.declared(sheet.inputs))
    _, names = batch.compute(sheet, "", scene)
    report.write(report.workbook(sheet.title, names, scene.limits), path)
    return path


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The workbook of a worksheet, made once."""
    return cache(lambda name: export(name, tmp_path_factory.mktemp("made"), {}))


@pytest.fixture(scope="module")
def kept(made: Callable[[str], Path]) -> Callable[[str], Path]:
    """The workbook of a document as it stands in exports/, of an example as it is made."""
    return lambda name: exported(name) if exported(name).exists() else made(name)


def edit(path: Path, changes: dict[str, Any], to: Path, units: Mapping[str, str] = MappingProxyType({})) -> Path:
    """The workbook with other values and units of inputs, as somebody types them; ``bolts.x (2)`` is of a table."""
    book = Values(path)
    left, contents = dict(changes), dict[tuple[str, str], object]()
    for name in [name for name in left if "Input tables" in book and name.endswith(")")]:
        column, _, k = name[:-1].partition(" (")
        contents["Input tables", cell_of(book, column, int(k)).coordinate] = left.pop(name)
    for n, (symbol, *_) in enumerate(book["Inputs"].iter_rows(min_row=3, values_only=True), 3):
        if symbol in units:
            contents["Inputs", f"C{n}"] = units[symbol]
        if symbol in left:
            contents["Inputs", f"B{n}"] = left.pop(symbol)
    assert not left
    return typed(path, contents, to)


def cell_of(book: Any, column: str, k: int) -> Any:
    """The cell of the k-th row of a column on the sheet Input tables; 0 is that of its unit, -1 of its heading."""
    sheet = book["Input tables"]
    head = next(cell for cell in sheet[6] if cell.value == column)
    return sheet.cell(7 + k, head.column)


def numbers(book: Any, titles: str = r"\d") -> Iterator[tuple[str, str, float | str]]:
    """Numbers and error values of the tables, or of other sheets whose titles begin so: sheet, cell, value."""
    for sheet in book.worksheets:
        if re.match(titles, sheet.title) and not sheet.title.endswith(("lines", "fields")):
            for row in sheet.iter_rows(min_row=5):
                yield from ((sheet.title, c.coordinate, c.value) for c in row if c.value is not None)


def disagreements(live: Any, own: Any, titles: str = r"\d") -> Iterator[str]:
    """Cells of the tables that differ by more than 1e-10 of what the workbook has in that unit."""
    tables = (sheet for sheet in own.worksheets if re.match(titles, sheet.title))
    heads = ((s.title, c) for s in tables for row in s.iter_rows(4, 4) for c in row if c.value is not None)
    units = {(title, cell.column_letter): cell.value for title, cell in heads}
    size: dict[Any, float] = defaultdict(float)
    given = list(numbers(own, titles))
    for sheet, cell, value in given:
        if isinstance(value, float | int):
            unit = units.get((sheet, re.match("[A-Z]+", cell)[0]))  # type: ignore[index]
            size[unit] = max(size[unit], abs(value))
    computed = {(sheet, cell): value for sheet, cell, value in numbers(live, titles)}
    for sheet, cell, value in given:
        other = computed.get((sheet, cell))
        if isinstance(value, str) or isinstance(other, str | type(None)):
            if value != other:
                yield f"{sheet}!{cell}: {other!r} instead of {value!r}"
        elif abs(value - other) > 1e-10 * size[units.get((sheet, re.match("[A-Z]+", cell)[0]))]:  # type: ignore[index]
            yield f"{sheet}!{cell}: {other!r} instead of {value!r}"


SEARCHES = {"N_F", "N_g"}  # lines of how often a Find evaluates, which cells do not follow


def lines(book: Any) -> dict[tuple[str, str], tuple[str, list[Any]]]:
    """Units and numbers of the lines that declare a unit, by the titles of their sheets and their names."""
    rows = {s.title: [*s.iter_rows(min_row=3, values_only=True)] for s in book.worksheets if "fields" in s.title}
    found = dict[tuple[str, str], tuple[str, list[Any]]]()
    for sheet in (sheet for sheet in book.worksheets if sheet.title.endswith("lines")):
        own = sheet.title.removesuffix("lines") + "fields"
        for name, value, unit, _, text in sheet.iter_rows(min_row=3, values_only=True):
            if not unit or re.fullmatch(r"line \d+", str(text)):
                continue
            if at := re.fullmatch(r"column [A-Z]+(?: of (.*))?", str(value)):
                heads, _, *values = rows.get(at[1] or own, [(), ()])
                column = [row[heads.index(name)] for row in values] if name in heads else []
                found[sheet.title, name] = unit, [x for x in column if x is not None]
            else:
                found[sheet.title, name] = unit, [value]
    return found


def lines_apart(live: Any, own: Any) -> Iterator[str]:
    """Lines that differ by more than 1e-10 of what the workbook has in that unit."""
    there, here = lines(live), lines(own)
    assert len(here) > 3 and there.keys() == here.keys()
    size: dict[str, float] = defaultdict(float)
    for unit, values in here.values():
        size[unit] = max([size[unit], *(abs(x) for x in values if not isinstance(x, str))])
    for key, (unit, values) in here.items():
        for value, other in zip(values, there[key][1], strict=True):
            if isinstance(value, str) or isinstance(other, str):
                if value != other and key[1] not in SEARCHES:
                    yield f"{key}: {other!r} instead of {value!r}"
            elif abs(value - other) > 1e-10 * size[unit]:
                yield f"{key}: {other!r} instead of {value!r}"


MADE = "made for these inputs: where this fails, export the worksheet again"


def verdicts(book: Any) -> dict[str, str]:
    """Verdicts of the checks by their names."""
    rows = book["Checks"].iter_rows(min_row=3, values_only=True)
    return {re.sub(", at (the listed|the middle|three of the) positions?$", "", row[0]): row[4] for row in rows}


@pytest.mark.parametrize("name", CHANGED)
def test_unchanged_every_cell_agrees(
    name: str, kept: Callable[[str], Path], recalculated: Callable[[Path], Any]
) -> None:
    live, own = recalculated(kept(name)), Values(kept(name))
    assert not list(disagreements(live, own))
    assert not list(lines_apart(live, own))
    told, there = ([row[4] for row in book["Checks"].iter_rows(min_row=3, values_only=True)] for book in (live, own))
    assert told == there and "FAIL" not in told
    errors = any(str(value).startswith("#") for *_, value in numbers(live, ""))
    assert errors == any(str(value).startswith("#") for *_, value in numbers(own))


@pytest.mark.parametrize("name", CHANGED)
def test_changed_inputs_are_followed(
    name: str, kept: Callable[[str], Path], recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    changes = CHANGED[name]
    live = recalculated(edit(kept(name), changes, tmp_path / f"edited_{name}.xlsx"))
    own = Values(export(name, tmp_path, changes))
    assert not list(disagreements(live, own))
    assert not list(lines_apart(live, own))
    there, here = verdicts(own), verdicts(live)
    told = {check: verdict for check, verdict in here.items() if verdict != "not evaluated" and check != MADE}
    assert told == {check: there.get(check) for check in told}


def test_hitch_assembled_on_its_other_sides_is_followed(
    made: Callable[[str], Path], recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """The machine seen from its other side: what is chosen in the workbook turns every branch, the Finds too."""
    abscissas = {"X01": -0.415, "X03": -0.25, "X05": -0.135, "X07": -0.415, "X6": -0.857, "phi_BD": -22}
    changes = abscissas | {"side_23": "left", "side_45": "right", "side_67": "left", "side_6": "left"}
    live = recalculated(edit(made("hitch"), changes, tmp_path / "edited.xlsx"))
    own = Values(export("hitch", tmp_path / "own", changes))
    assert list(disagreements(live, own)) == []
    assert live["Find"]["B3"].value == pytest.approx(0.6612831669, rel=1e-9), "the printed 0.6613 of the lifting rod"


def test_edited_workbook_is_a_scene(tmp_path: Path) -> None:
    """The changed workbook, read back, is the worksheet's run on the same inputs."""
    changes = CHANGED["hitch"]
    path = edit(exported("hitch"), changes, tmp_path / "edited.xlsx")
    sheet = cells.load(ROOT / "worksheets" / "hitch.py")
    read = reading.inputs(path, inputs.declared(sheet.inputs))
    assert inputs.build(sheet.inputs, read) == inputs.build(sheet.inputs, changes)


def test_a_closed_form_that_is_no_root_on_its_branch_fails(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """A link's distance is the same on both sides of a group; the worksheet finds a root on neither.

    What rests on the link is no number then, nor are the links that are computed with it.
    """
    changes = {"P6": 25e3, "L5": "0,47", "S_max": 0.66, "side_45": "right"}
    with pytest.raises(SheetError, match="upper link L7: mast angle phi6 reaches"):
        export("hitch", tmp_path, changes)
    book = recalculated(edit(exported("hitch"), changes, tmp_path / "other_branch.xlsx"))
    said = verdicts(book)
    assert said.pop("lifting rod L4: Find and the closed form") == "FAIL"
    assert said["upper link L7: Find and the closed form"] == "not evaluated" and "FAIL" not in said.values()
    found = [[row[k] for k in (1, 4)] for row in book["Find"].iter_rows(min_row=3, values_only=True)]
    assert abs(found[0].pop()) > 1, "the equation is left by metres"
    assert found == [["#N/A"], ["#N/A", "#N/A"], ["#N/A", "#N/A"]]
    assert {cell.value for row in book["4.1 Lifting capacity"].iter_rows(5, 14, 2, 3) for cell in row} == {"#N/A"}


def test_what_does_not_close_is_not_available(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """Beyond the reach of the cylinder: #N/A from the first open position on, numbers before it."""
    path = edit(exported("hitch"), {"S_max": 0.9}, tmp_path / "open.xlsx")
    book = recalculated(path)
    for title in ("2.2 Points", "3.1 Kinematics", "4.1 Lifting capacity", "5.1 Reactions"):
        last = [cell.value for cell in book[title][14]][1:]
        assert set(last) == {"#N/A"}, title
        assert all(isinstance(cell.value, float) for cell in book[title][5]), title
    shown = {value for *_, value in numbers(book) if isinstance(value, str)}
    assert shown == {"#N/A"}
    verdicts = {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=3)}
    assert verdicts["group (2, 3) closes"] == "FAIL"


def test_every_table_of_the_hitch_is_live() -> None:
    book = load_workbook(exported("hitch"))
    plain = [(s, c) for s, c, value in numbers(book) if not str(value).startswith("=")]
    assert not plain
    assert "P6_*IS6_" in str(book["4.1 Lifting capacity"]["B5"].value)


def test_values_stand_beside_the_formulas(made: Callable[[str], Path]) -> None:
    """pandas, which computes nothing, reads the worksheet's numbers to the last bit, which is the processor's."""
    read = pd.read_excel(made("hitch"), sheet_name="4.1 Lifting capacity", header=2, skiprows=[3])
    own = evaluate(ROOT / "worksheets" / "hitch.py", ["table_41"])["table_41"].frame()
    assert read["GS6"].head(10).tolist() == own["GS6 [N]"].tolist()


def test_number_of_positions_is_that_of_the_workbook(
    made: Callable[[str], Path], recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """Rows cannot grow nor be left out: for another number of positions there is no number of any."""
    for count in (7, 12):
        book = recalculated(edit(made("hitch"), {"N_pol": count}, tmp_path / f"{count}.xlsx"))
        rows = {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=3)}
        assert rows["made for these inputs: where this fails, export the worksheet again"] == "FAIL"
        assert {value for _, cell, value in numbers(book)} == {"#N/A"}


def test_of_another_number_of_rows_no_cell_has_a_number(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """Of the position, of one number in all rows, of what passes over gaps, of ends; how many there are is known."""
    lines = """from mechsheet import check
gaps = np.where(x > 2, x, np.nan)  # [-] gaps
one = g.F + 0 * np.ones(g.n)  # [-] the same in all rows
same = np.full(g.n, 3.0)  # [-] constant
gap = np.where(np.isfinite(gaps), 1.0, 0.0)  # [-] from a condition
most = np.nanmax(gaps)  # [-] passes over gaps
mean = x.mean()  # [-] by the length
end = x[-1]  # [-] last
count = 1.0 * len(x)  # [-] length
odd = np.linspace(0, 1, 2 * g.n + 1)  # [-] other rows
put = np.append(x[1:], 7.0)  # [-] with a constant at the end
rise = np.gradient(x**2, x)  # [-] by the rows beside
table_2 = table("2", "Two", one, same, gap, put, rise)
table_3 = table("3", "Three", odd)
figure_1 = figure("1", "One", x, gap)
checks = check("most", most, 9.0), check("mean", mean, 9.0), check("end", end, 9.0), check("count", count, 9.0)"""
    sheet = own(tmp_path, lines)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("", {**names, "__file__": sheet.path}, {}))
    assert not any(str(value).startswith("#") for *_, value in numbers(recalculated(path)))
    for count in (4, 9):
        book = recalculated(edit(path, {"n": count}, tmp_path / f"{count}.xlsx"))
        shown = list(numbers(book))
        assert shown and {value for *_, value in shown} == {"#N/A"}, shown
        checks = {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=4)}
        assert checks.pop("made for these inputs: where this fails, export the worksheet again") == "FAIL"
        assert {name for name, said in checks.items() if said != "not evaluated"} == {"count", "units"}
        front = [row[1].value for row in book["Front"].iter_rows(min_row=5) if row[3].value == "-"]
        assert front.count(count) == 1 and {*front} == {"#N/A", count}, front


def test_how_many_rows_there_were_is_no_number_for_others(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """A row that was added or taken out left their number as it was, and a check of it passed."""
    setup = """import numpy as np
from mechsheet import ask, check, export, inputs, read, table, typeset
@inputs
class Row:
    name: str  # name
    x: float  # [m] place"""
    given = """F: float = 2.0  # [-] number
lengths: list[float] = [1.25, 2.5, 7.75]  # [m] lengths
rows: list[Row] = [Row("a", 1.0), Row("b", 2.0)]  # rows"""
    lines = """n = len(g.lengths)  # [-] lengths
m = len(g.rows)  # [-] rows
k = g.rows.x.size * g.F  # [-] product
i = np.arange(len(g.lengths))  # [-] their numbers
u = 1.0 if len(g.rows) > 1 else 0.0  # [-] several
other = 3 * g.F  # [-] rests on none
checks = check("lengths", n, at_least=3), check("rows", len(g.rows), at_least=2)
table_1 = table("1", "Numbers", i)
typeset()"""
    path = tmp_path / "own.py"
    path.write_text(written(setup, given, lines, "Own"))
    made = computed(path, tmp_path, {})
    same, more = recalculated(made), load_workbook(made)
    more["Input tables"]["B11"] = 3.0
    more["Input tables"]["E9"] = None
    more.save(tmp_path / "more.xlsx")
    other = recalculated(tmp_path / "more.xlsx")
    known, lost = (
        {row[0]: row[1] for row in book["Table lines"].iter_rows(3, values_only=True)} for book in (same, other)
    )
    assert [known[name] for name in ("n", "m", "k", "u", "other")] == [3, 2, 4, 1, 6]
    assert [lost[name] for name in ("n", "m", "k", "u", "other")] == ["#N/A"] * 4 + [6]
    assert [cell.value for cell in other["1 Numbers"]["A"][4:]] == ["#N/A"] * 3
    assert {verdicts(same)[name] for name in ("lengths", "rows", MADE)} == {"PASS"}
    assert [verdicts(other)[name] for name in ("lengths", "rows", MADE)] == ["not evaluated"] * 2 + ["FAIL"]


def test_a_condition_of_lines_that_went_another_way_is_no_number(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """It was that of the exported way, and what was not known was told not to exist, on the front sheet too."""
    setup = """import numpy as np
from mechsheet import ask, check, export, inputs, read, table, typeset"""
    given = """way: str = "over"  # which side
h: float = 3.0  # [m] height"""
    lines = """def beyond(x):
    if g.way == "over":
        return x > 2
    return x < 2
x = np.linspace(1.0, 5.0, 3)  # [m] places
e = np.where(beyond(x), np.nan, x)  # [m] those that are not
exists = np.isfinite(e)  # [-] of each
whole = np.isfinite(e).all()  # [-] all
high = beyond(g.h)  # [-] height
each = beyond(x)  # [-] every place
plain = g.h > 2.5  # [-] rests on nothing else
table_1 = table("1", "Places", x, exists)
typeset()"""
    path = tmp_path / "own.py"
    path.write_text(written(setup, given, lines, "Own"))
    made = computed(path, tmp_path, {})
    same, other = recalculated(made), recalculated(edit(made, {"way": "under"}, tmp_path / "under.xlsx"))
    for book, expected in ((same, [False, True, True]), (other, ["#N/A", "#N/A", True])):
        known = {row[0]: row[1] for row in book["Table lines"].iter_rows(3, values_only=True)}
        front = {row[0]: row[1] for row in book["Front"].iter_rows(5, values_only=True)}
        assert [known[name] for name in ("whole", "high", "plain")] == expected
        assert [front[name] for name in ("whole", "high", "plain")] == expected
    for book, expected in ((same, [(True, False), (False, True), (False, True)]), (other, [("#N/A", "#N/A")] * 3)):
        (heads,) = book["Table fields"].iter_rows(3, 3, values_only=True)
        each = [row[heads.index("each")] for row in book["Table fields"].iter_rows(5, 7, values_only=True)]
        exists = [row[1] for row in book["1 Places"].iter_rows(5, 7, values_only=True)]
        assert [*zip(exists, each, strict=True)] == expected


def test_a_line_that_is_another_name_of_one_bound_anew_follows(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """A sum of a loop, whose first line tells its unit, stood behind that name as the number of the exported inputs."""
    shown, books = list[float](), list[Path]()
    for n, steps in enumerate(
        (
            "for i in range(3):\n    y = y + 0.5 * g.F",
            "for i in range(5):\n    if g.F > i:\n        y = y + 1",
            "y = y + g.F",
            "if g.k > 1:\n    y = 2 * g.F",
            "y = np.zeros(2) + g.F * np.array([1.0, 2.0])\ny = y[1]",
        )
    ):
        sheet = own(tmp_path, f"y = 0.0  # [-] first\n{steps}\nlevel = y * 1  # [-] in the end")
        path = tmp_path / f"own{n}.xlsx"
        path.write_bytes(report.workbook("", {**sheet.run_whole(), "__file__": sheet.path}, {}))
        books.append(edit(path, {"F": 3.25}, tmp_path / f"edited{n}.xlsx"))
        shown.append(evaluate(sheet.path, ["level"], F=3.25)["level"])
    for book, expected in zip(recalculated_all(books), shown, strict=True):
        lines = {row[0]: row[1] for row in book["Table lines"].iter_rows(min_row=3, values_only=True)}
        assert lines["level"] == pytest.approx(expected, rel=1e-14)


def test_another_number_of_rows_is_told_where_nothing_else_is_known(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """The check that asks for another export was not evaluated: code looks at numbers that are in no cell then."""
    sheet = own(tmp_path, "y = g.a * np.sin(x)  # [-] curve\nway = 2.0 if np.unique(y).max() > 9 else g.F  # [-] way")
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("", {**sheet.run_whole(), "__file__": sheet.path}, {}))
    assert verdicts(recalculated(path))[MADE] == "PASS"
    assert verdicts(recalculated(edit(path, {"n": 4}, tmp_path / "edited.xlsx")))[MADE] == "FAIL"


def test_found_value_without_a_closed_form_is_searched_or_that_of_its_own_inputs(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """Its cells search the interval; where one end of that is open, they have the number of the exported inputs."""
    source = (ROOT / "worksheets" / "hitch.py").read_text(encoding="utf-8")
    start, end = source.index("    psi5_p = "), source.index("    typeset(S_p_found, checks_S_p)")
    searched = source[:start] + source[end:]
    searched = searched.replace("    checks_S_p,\n", "").replace(", checks_S_p", "")
    open_end = searched.replace("P56(S, L4).imag,\n        g.S_min,\n        g.S_max,", "P56(S, L4).imag, g.S_min,")
    assert open_end != searched
    for name, text in (("searched", searched), ("open", open_end)):
        path = tmp_path / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        data = report.workbook(name, cells.load(path).run_whole(), {})
        (tmp_path / f"{name}.xlsx").write_bytes(data)
    lower, better = {"Y_P56": 0.41}, {"eta": 0.8}
    books = recalculated_all(
        [
            tmp_path / "open.xlsx",
            edit(tmp_path / "open.xlsx", lower, tmp_path / "lower.xlsx"),
            edit(tmp_path / "open.xlsx", better, tmp_path / "better.xlsx"),
            edit(tmp_path / "searched.xlsx", lower, tmp_path / "found.xlsx"),
        ]
    )
    before, after, other, found = (book["Find"] for book in books)
    verdicts, of_found = (
        {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=3)} for book in (books[1], books[3])
    )
    assert [row[9].value for row in after.iter_rows(min_row=3)] == ["its closed form", "found", "its closed form"]
    assert isinstance(before["B4"].value, float) and abs(before["E4"].value) < 1e-12
    assert after["B4"].value == after["E4"].value == "#N/A" and isinstance(after["B3"].value, float)
    assert after["B5"].value == "#N/A", "L7 is computed at the stroke that is not known"
    assert verdicts["upper link L7: Find and the closed form"] == "not evaluated"
    assert math.isclose(other["B4"].value, before["B4"].value, rel_tol=1e-14), "it does not rest on eta"
    own = evaluate(tmp_path / "searched.py", ["S_p", "L7"], **lower)
    assert found["J4"].value == "the nearest change of sign of 97 places" and abs(found["E4"].value) < 1e-12
    assert math.isclose(found["B4"].value, own["S_p"], rel_tol=1e-13)
    assert math.isclose(found["B5"].value, own["L7"], rel_tol=1e-12)
    assert set(of_found.values()) <= {"PASS", None}


@pytest.mark.parametrize(
    ("name", "symbol", "typed", "unit", "legal"),
    [
        ("bucket", "phi_open", 95, "", 8),
        ("hitch", "k_gc", 2.5, "", 3),
        ("bucket", "S_min", 2.4, "", 1.5),
        ("hitch", "P6", 27.5, "kN", 2e4),
        ("landing_gear", "theta", -70, "", 80),
    ],
)
def test_outside_its_limits_an_input_leaves_no_number_that_rests_on_it(
    name: str,
    symbol: str,
    typed: float,
    unit: str,
    legal: float,
    made: Callable[[str], Path],
    recalculated: Callable[[Path], Any],
    tmp_path: Path,
) -> None:
    """What rests on it is what changes with it; all else stays as it is."""
    path = edit(made(name), {symbol: typed}, tmp_path / "edited.xlsx", {symbol: unit} if unit else {})
    live, before = recalculated(path), Values(made(name))
    other = Values(export(name, tmp_path, {symbol: legal}))
    lost = {f"{sheet}!{cell}" for sheet, cell, value in numbers(live) if value == "#N/A"}
    followed, differing = ({text.partition(":")[0] for text in disagreements(b, before)} for b in (other, live))
    assert followed and followed <= lost and differing <= lost
    title, _, first, *_ = live["Checks"].iter_rows(values_only=True)
    assert first[:2] == ("inputs within their limits", 1) and first[4] == "FAIL"
    verdicts = [row[4].value for row in live["Checks"].iter_rows(min_row=3)]
    passed = verdicts.count("PASS")
    assert title[0] == f"Checks: {passed} of {len(verdicts)} passed" and passed < len(verdicts)


def test_cells_of_inputs_are_read_as_the_worksheet_reads_them(
    made: Callable[[str], Path], recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """A text or number of every kind, each typed for another input: the same number in SI units, or none in both."""
    texts = {
        "X01": "0,415",
        "X03": " .5 ",
        "X05": "5.",
        "X07": "−1",
        "Y01": "1e-3",
        "Y03": "1,000.5",
        "Y05": "1 000",
        "Y07": "50%",
        "L3": "0",
        "L5": "-0,48",
        "L6": "$5",
        "L34": "(5)",
        "L56": "1:30",
        "phi_BD": "heavy",
        "L7_pre": "1,035",
        "L4_pre": "0x10",
        "Y56_min": "1_000",
        "S_min": 0.68,
        "N_pol": "10,5",
        "X6": True,
        "Y6": 1e61,
        "Y_P56": "nan",
        "phi_P6": 180,
        "D_gc": 1e-61,
        "P_gc_max": "2E7",
        "a": 0,
        "L": "1-2",
    }
    live = recalculated(edit(made("hitch"), texts, tmp_path / "edited.xlsx"))
    sheet = cells.load(ROOT / "worksheets" / "hitch.py")

    def accepted(symbol: str, value: object) -> object:
        try:
            return getattr(inputs.build(sheet.inputs, {symbol: value}), symbol)
        except SheetError:
            return "#N/A"

    read = {row[0].value: row[5].value for row in live["Inputs"].iter_rows(min_row=3) if row[0].value in texts}
    expected = {symbol: accepted(symbol, value) for symbol, value in texts.items()}
    expected["X6"] = 1  # LibreOffice holds a truth value in a cell with a number's format as 1, and shows it so
    assert read == {symbol: x if x == "#N/A" else pytest.approx(x, rel=1e-14) for symbol, x in expected.items()}
    assert live["Checks"]["B3"].value == list(read.values()).count("#N/A") > 10


def test_no_input_of_a_cell_is_read_as_none(
    made: Callable[[str], Path], recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """An emptied cell of a value is told, an emptied unit too; where there is no unit, nothing is no other unit."""
    path = edit(made("hitch"), {"P6": None}, tmp_path / "edited.xlsx", {"S_max": "", "eta": "", "X01": "M", "L": " m "})
    read = {row[0].value: row[5].value for row in recalculated(path)["Inputs"].iter_rows(min_row=3)}
    assert {symbol for symbol, value in read.items() if value == "#N/A"} == {"P6", "S_max", "X01"}


def test_cells_of_inputs_refuse_what_the_limits_do_not_allow(made: Callable[[str], Path]) -> None:
    sheet = load_workbook(made("hitch"))["Inputs"]
    rules = {str(rule.sqref): rule for rule in sheet.data_validations.dataValidation}
    values = {row[0].value: row[1] for row in sheet.iter_rows(min_row=3) if row[1].value is not None}
    assert set(rules) == {cell.coordinate for cell in values.values()}
    assert {rule.errorStyle or "stop" for rule in rules.values()} == {"stop"}
    assert all(len(rule.formula1) < 255 and not rule.allow_blank for rule in rules.values())
    low, high = values["S_min"].coordinate, values["S_max"].row
    rule = rules[low]
    limits = f"IF(ISTEXT({low}),TRUE,AND(ISNUMBER({low}),{low}>=1E-60,{low}<$I${high}))"
    assert rule.formula1 == f"_xlfn.IFNA({limits},FALSE)"
    assert rule.prompt.startswith("least length of the cylinder [m]. Limits: > 0, < S_max.")
    grounds = {symbol: cell.fill.fgColor.rgb for symbol, cell in values.items()}
    assert set(grounds.values()) == {grounds["P6"]}, "of every input something follows"


def test_joint_without_load_is_followed(
    made: Callable[[str], Path], recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """Any areas would be in equilibrium then: the cells take those of the worksheet."""
    none = {"loads.M (1)": 0, "loads.N (1)": 0}
    live = recalculated(edit(made("joint"), none, tmp_path / "edited.xlsx"))
    assert not list(disagreements(live, Values(export("joint", tmp_path, none))))
    assert {row[4].value for row in live["Checks"].iter_rows(min_row=3)} == {"PASS"}


def test_a_check_without_formulas_is_that_of_the_exported_inputs(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """No verdict for others; units do not depend on inputs."""
    sheet = own(
        tmp_path,
        """from types import SimpleNamespace
from mechsheet import check
held = SimpleNamespace(noise=np.lexsort((g.F * np.array([2.0, 3.0, 1.0]),)) + 0.5)
check_2 = check("noise", float(held.noise.max()), 9)""",
    )
    path = computed(Path(sheet.path), tmp_path, {})
    as_is, other = recalculated(path), recalculated(edit(path, {"F": 3}, tmp_path / "edited.xlsx"))
    for book, verdict in ((as_is, "PASS"), (other, "not evaluated")):
        verdicts = {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=3)}
        assert (verdicts["noise"], verdicts["units"]) == (verdict, "PASS")


def test_names_are_no_addresses_and_differ_in_more_than_case() -> None:
    names = DefinedNames()
    given = ["L3", "X01", "P56", "phi12", "R", "c", "r1c1", "a", "A", "S_p", "s_p", "IS6", "XFD1", "dphi3", "L_3"]
    new = [names.new(name) for name in given]
    assert new == [
        *("L3_", "X01_", "P56_", "phi12_", "R_", "c_", "r1c1_", "a", "A_", "S_p", "s_p_", "IS6_", "XFD1_", "dphi3"),
        "L_3",
    ]


def test_stored_names_are_accepted() -> None:
    """openpyxl, which knows Excel's rule for addresses, takes every defined name of every worksheet for a name."""
    from openpyxl.formula import Tokenizer

    for path in sorted((ROOT / "exports").glob("*.xlsx")):
        with ZipFile(path) as book:
            names = re.findall('<definedName name="([^"]*)">', written_cells.part(book, "workbook.xml"))
        assert names, path.name
        for name in names:
            (token,) = Tokenizer(f"={name}").items
            assert token.subtype == "RANGE" and not re.fullmatch(r"\$?[A-Z]{1,3}\$?\d+", name, re.IGNORECASE)


def test_a_change_is_seen(tmp_path: Path) -> None:
    """The comparison itself sees a wrong number and a lost error value."""

    def book(*cells: Any) -> Any:
        made = Workbook()
        made.worksheets[0].title = "1 Table"
        for row in (["Table"], [], ["a"], ["m"], *([c] for c in cells)):
            made.worksheets[0].append(row)
        return made

    assert not list(disagreements(book(1.0, 2.0), book(1.0, 2.0)))
    assert list(disagreements(book(1.0, 2.0 + 1e-9), book(1.0, 2.0)))
    assert list(disagreements(book(1.0, 2.0), book(1.0, "#N/A")))


def test_what_a_worksheet_of_ones_own_does_is_followed_by_its_cells(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """Every construct that the recording knows, as formulas: LibreOffice against the worksheet on other inputs."""
    lines = [f"y{n}_ = {expression}  # [-] line {n}" for n, expression in enumerate(FOLLOWED)]
    names = [f"y{n}_" for n in range(len(lines))]
    alike = defaultdict(list)
    for name, value in evaluate(own(tmp_path, "\n".join(lines)).path, names).items():
        alike[np.shape(value)] += [f"{name}.real", f"{name}.imag"] if np.iscomplexobj(value) else [name]
    shown = [f'table_{n} = table("{n}", "table {n}", {", ".join(these)})' for n, these in enumerate(alike.values())]
    sheet = own(tmp_path, "\n".join([*lines, *shown]))
    changes = {"F": 3.25, "a": 0.2, "k": 3}
    given = {"as_it_is": {}, "changed": changes}
    books = [computed(Path(sheet.path), tmp_path / folder, each) for folder, each in given.items()]
    live = recalculated(edit(books[0], changes, tmp_path / "edited.xlsx"))
    assert not list(disagreements(live, Values(books[1])))
    assert {row[4].value for row in live["Checks"].iter_rows(min_row=3)} == {"PASS"}


@pytest.mark.parametrize("name", ["hitch", "landing_gear", "joint", "kinetostatics", "slotted_link"])
def test_nothing_of_a_document_is_left_out(name: str) -> None:
    """Its front sheet would name it."""
    front = [row[0] for row in Values(exported(name))["Front"].iter_rows(values_only=True)]
    assert "Contents" in front and "Not followed" not in front
