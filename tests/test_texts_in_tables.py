"""Texts in the rows of a table and in the options of a choice: labels, wherever these are given, shown or used."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest
from by_cells import by_cells
from cells import run
from openpyxl import Workbook, load_workbook
from own_worksheet import written
from test_lists import script, typed
from test_recalculation import computed, edit

from mechsheet import evaluate, grid, load, sensitivity, sweep
from mechsheet.html import write
from mechsheet.quantities.lines import Recording
from mechsheet.readers.numbers import numbers
from mechsheet.recording.dimensions import mismatches
from mechsheet.recording.record import record
from mechsheet.run import arguments
from mechsheet.workbook import reading
from mechsheet.worksheet import inputs
from mechsheet.worksheet.check import checks_of
from mechsheet.worksheet.errors import SheetError

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
import re

import marimo as mo
import numpy as np

from mechsheet import ask, check, export, figure, inputs, one_of, read, table, typeset
from mechsheet.units import MPa, kN, mm

@inputs
class Case:
    name: str  # name of the case
    F: float  # [kN] force; > 0
    arm: float  # [mm] lever

@inputs
class Steel:
    standard: str  # standard
    R_e: float  # [MPa] yield strength

STEELS = {"S235": Steel("EN 1", 235 * MPa), "S355": Steel("EN 1", 355 * MPa), "C45": Steel("DIN", 490 * MPa)}
"""
GIVEN = """
cases: list[Case] = [Case("braking", 12 * kN, 80 * mm), Case("cornering", 8 * kN, 150 * mm)]  # load cases
steel: Steel = one_of(STEELS, "S235")  # steel
W: float = 9000 * mm**3  # [mm**3] section modulus
"""
LINES = """
sigma = g.cases.F * g.cases.arm / g.W  # [MPa] stress
worst = g.cases[np.argmax(sigma)]
table_1 = table("1", f"Cases, {g.steel.standard}", g.cases.name, sigma)
checks_1 = [check(f"stress, {c.name}", s, g.steel.R_e, "MPa") for c, s in zip(g.cases, sigma)]
"""
WORDS = """
@app.cell
def words(g, worst):
    mo.md(f"Worst: {worst.name}, first {g.cases[0].name}, all {', '.join(g.cases.name)}; {g.steel}: {g.steel.standard}")
    return


"""


def sheet_of(folder: Path, lines: str = LINES) -> Path:
    path = folder / "cases.py"
    text = written(SETUP, GIVEN, lines, "Cases").replace("    return (form,)", "    form\n    return (form,)")
    if lines == LINES:
        text = text.replace("    return sigma", "    typeset(table_1, *checks_1)\n    return sigma")
        text = text.replace("@app.cell\ndef workbook", WORDS.lstrip() + "@app.cell\ndef workbook")
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def cases(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sheet_of(tmp_path_factory.mktemp("sheet"))


def built(path: Path, **given: Any) -> Any:
    return inputs.build(load(path).inputs, given)


def test_a_text_is_held_and_read_as_one(cases: Path) -> None:
    g: Any = load(cases).inputs()
    assert g.cases.name.tolist() == ["braking", "cornering"] and g.cases[1].name == "cornering"
    assert [case.name for case in g.cases[g.cases.name == "braking"]] == ["braking"]
    assert f"{g.cases[0].name}, {g.steel.standard}" == "braking, EN 1" and g.steel == "S235"
    assert built(cases, steel="C45").steel.standard == "DIN"
    assert type(g).__units__["cases.name"] == "-"


WAYS: list[Any] = [
    "left; 12; 80 | 42; 8; 150 | ; 1; 2",
    "left\t12\t80\n42\t8\t150\n\t1\t2\n",
    [("left", 12, 80), (42, "8", 150), ("", 1, 2)],
    [{"name": " left ", "F": 12, "arm": 80}, {"F": 8, "arm": 150, "name": 42.0}, ["", 1, 2]],
    {"name": ["left", 42, ""], "F": [12, 8, 1], "arm": [80, 150, 2]},
    pd.DataFrame({"name": ["left", "42", ""], "F": [12, 8, 1], "arm": [80, 150, 2]}),
]


@pytest.mark.parametrize("way", WAYS, ids=range(len(WAYS)))
def test_texts_are_given_in_many_ways(cases: Path, way: Any) -> None:
    """A number is the text that it is written as; no text is one too."""
    g = built(cases, cases=way)
    assert g.cases.name.tolist() == ["left", "42", ""]
    assert g.cases.F.tolist() == [12e3, 8e3, 1e3]
    (field, *_) = inputs.declared(type(g))
    assert field.same(g.cases, built(cases, cases=field.text(g.cases)).cases), "its text is read back"
    assert g != built(cases) and hash(g) == hash(built(cases, cases=way))


def test_texts_are_read_from_files(cases: Path) -> None:
    folder = cases.parent
    (folder / "loads.csv").write_text('F [kN];name;arm\n12;"left, slow";80\n8000 N;7;150\n1;;2\n', encoding="utf-8")
    book = Workbook()
    for row in (["name", "F", "arm [m]"], ["left, slow", 12, 0.08], [7, 8, 0.15], [None, 1, 0.002]):
        book.active.append(row)
    book.save(folder / "loads.xlsx")
    for file in ("loads.csv", "loads.xlsx"):
        g = built(cases, cases=file)
        assert (g.cases.name.tolist(), g.cases.F.tolist()) == (["left, slow", "7", ""], [12e3, 8e3, 1e3]), file


def test_a_file_beside_the_worksheet_gives_the_texts_at_first(tmp_path: Path) -> None:
    path = sheet_of(tmp_path)
    (tmp_path / "loads.csv").write_text("name;F;arm\nleft;12;80\n7;8;150\n", encoding="utf-8")
    first = '[Case("braking", 12 * kN, 80 * mm), Case("cornering", 8 * kN, 150 * mm)]'
    text = path.read_text().replace(first, 'from_file("loads.csv")').replace("import ask", "import from_file, ask")
    path.write_text(text)
    g: Any = load(path).inputs()
    assert g.cases.name.tolist() == ["left", "7"]


def test_a_table_of_one_column_of_texts_keeps_its_empty_rows(tmp_path: Path) -> None:
    path = tmp_path / "notes.py"
    setup = "from mechsheet import ask, inputs, read, typeset\n\n@inputs\nclass Note:\n    text: str  # note"
    path.write_text(written(setup, 'notes: list[Note] = [Note(""), Note("b"), Note("")]  # notes', "typeset()"))
    g: Any = load(path).inputs()
    (field,) = inputs.declared(type(g))
    assert built(path, notes=field.text(g.notes)).notes.text.tolist() == ["", "b", ""]


BAD: list[tuple[Any, str]] = [
    (
        "n" * 201 + "; 1; 2",
        r"name of the case cases.name \(1\) = 'n+'?\.\. .* must be a line of at most 200 characters",
    ),
    ([("a", 1, 2), ("a; b", 1, 2)], r"cases.name \(2\) = 'a; b' must be a text without ; and \|"),
    ([("a|b", 1, 2)], r"cases.name \(1\) = 'a\|b' must be a text without ; and \|"),
    ([("a\x00", 1, 2)], r"cases.name \(1\) = 'a\\x00' must be a line"),
    ([(True, 1, 2)], r"cases.name \(1\) = True must be a line"),
    ("braking; 12", r"load cases cases \(1\) = 'braking; 12' must have the columns name, F, arm"),
    ("12; braking; 80", r"force cases.F \(1\) = 'braking' kN is no number"),
]


@pytest.mark.parametrize(("given", "said"), BAD)
def test_a_bad_text_is_one_line(cases: Path, given: Any, said: str) -> None:
    with pytest.raises(SheetError, match=said) as refused:
        built(cases, cases=given)
    assert "\n" not in str(refused.value)


def test_code_is_held_to_the_same(cases: Path) -> None:
    sheet = load(cases)
    row = sheet.common["Case"]
    assert row(12, 1.0, 1.0).name == "12"
    with pytest.raises(SheetError, match=r"name = 'a+\.\. .* must be a line"):
        row("a" * 201, 1.0, 1.0)
    with pytest.raises(SheetError, match=r"cases.name \(2\) = 'a\|b' must be a text without"):
        sheet.inputs(cases=[row("a", 1.0, 1.0), row("a|b", 1.0, 1.0)])  # type: ignore[call-arg]


def test_what_a_text_cannot_have_is_told_at_its_line() -> None:
    for line, said in {
        "name: str  # name; > 0": "name is no number and has neither unit nor limits",
        "name: str  # [mm] name": "name is no number and has neither unit nor limits",
        "name: str  # name\n    F: float  # [-] force; < name": "limit < name of F: name is neither a number nor",
    }.items():
        with pytest.raises(SheetError, match=re.escape(said)):
            run(f"from mechsheet import inputs\n@inputs\nclass Case:\n    {line}\n    m: float  # [kg] mass")


def test_a_scene_gives_texts(cases: Path) -> None:
    file = cases.parent / "scene.toml"
    declared = inputs.declared(load(cases).inputs)
    for text in ('"x; 3; 100 | 12; 4; 100"', '[{name = "x", F = 3, arm = 100}, {name = 12, F = 4, arm = 100}]'):
        file.write_text(f"[inputs]\ncases = {text}\n", encoding="utf-8")
        assert built(cases, **arguments.load(file, declared).inputs).cases.name.tolist() == ["x", "12"]
    done = script(cases, "--cases=x; 3; 100 | y z; 4; 100", f"--out={cases.parent / 'out'}")
    assert done.returncode == 0 and "stress, y z" in done.stdout
    again = reading.inputs(cases.parent / "out" / "cases.xlsx", declared)
    assert built(cases, **again).cases.name.tolist() == ["x", "y z"]


# What is computed for other inputs never rests on a text that is another one now.

FOLLOWED = [  # of which no text is looked at
    "sum(c.F for c in g.cases)",
    "g.cases[np.argmax(g.cases.F)].F",
    "max(g.cases, key=lambda c: c.F).arm",
    "sum(c.F for c in g.cases[1:])",
    "g.cases[g.cases.F > 9e3].F.sum()",
    "len(g.cases.name) * g.W",
    "len([g.cases.name[np.argmax(g.cases.F)]]) * g.W",
    "2.0 if g.steel.standard == 'EN 1' else g.W",
    "g.W if g.steel.standard != 'EN 1' else 2.0",
    "{'EN 1': 2.0, 'DIN': 3.0}[g.steel.standard]",
    "{'EN 1': 2.0}.get(g.steel.standard, 3.0) * g.W",
]
HELD = [
    "g.cases.F[g.cases.name == 'braking'].sum()",
    "sum(c.F for c in g.cases if c.name == 'braking')",
    "len(g.cases[0].name) * g.W",
    "{'braking': 2.0}.get(g.cases[0].name, 3.0) * g.W",
    "2.0 if g.cases[0].name.startswith('b') else 3.0",
    "len(', '.join(c.name for c in g.cases)) * g.W",
    "len(sorted(g.cases.name)[0]) * g.W",
    "{c.name: c.F for c in g.cases}.get('braking', 1.0)",
    "float('braking' in g.cases.name)",
    "np.count_nonzero(g.cases.name != 'cornering') * g.W",
    "len(f'{g.cases[0].name}') * g.W",
    "len(repr(g.cases[0].name)) * g.W",
    "len(f'{g.cases.name}') * g.W",
    "float(g.cases.name[0] < g.cases.name[1])",
    "len(g.cases[np.argmax(g.cases.F)].name) * g.W",
    "len(re.sub('[aeiou]', '', g.cases[0].name)) * g.W",
    "np.char.str_len(g.cases.name.astype(str)).sum() * g.W",
    "isinstance(g.cases[0].name, str) * g.W",
    "next((c for c in g.cases if c.name == 'cornering'), g.cases[0]).F",
    "len(g.steel.standard) * g.W",
]
OTHERS: list[dict[str, Any]] = [
    {},
    {"cases": "braking; 7; 80 | cornering; 9; 70"},
    {"cases": "a; 12; 80 | cornering; 8; 150"},
    {"cases": "braking; 3; 80 | z; 11; 150"},
    {"cases": "zz; 3; 80 | braking; 11; 150"},
    {"steel": "S355"},
    {"steel": "C45"},
]


def leaves(recording: Recording, g: Any, own: Any) -> dict[Any, Any]:
    """The numbers of other inputs, of a text whether it is another one."""
    texts = [float(a != b) for a, b in zip(g.cases.name, own.cases.name, strict=True)]
    told = {"cases.name": np.array(texts), "cases.F": g.cases.F, "cases.arm": g.cases.arm}
    at = ["S235", "S355", "C45"].index(str(g.steel))
    return {recording.inputs[name]: x for name, x in (told | {"steel": at}).items()}


@pytest.mark.parametrize("draws", [False, True])
@pytest.mark.parametrize("line", [*FOLLOWED, *HELD])
def test_no_number_rests_on_the_text_of_other_inputs(line: str, draws: bool, tmp_path: Path) -> None:
    path = sheet_of(tmp_path, f"y = np.atleast_1d({line}) * 1.0  # [-] result\ntable_1 = table('1', 'All', y)")
    sheet = load(path)
    own: Any = sheet.inputs()
    names = sheet.run(sheet.results, {"g": own})
    recording = record({**names, "__file__": sheet.path}, whole=draws, every=int(draws), draws=draws)
    seen = [*recording.gaps, *(guard for guard in recording.guards.values() if "rounding" not in guard.why)]
    assert not (line in FOLLOWED and seen)
    (column,) = recording.tables["1"]
    assert column is not None
    for given in OTHERS:
        found = numbers([column.re], leaves(recording, built(path, **given), own))[column.re]
        if line in HELD and given and np.isnan(found).all():
            continue
        np.testing.assert_allclose(found, by_cells(path, ["y"], **given)["y"], rtol=1e-12, err_msg=str(given))


ROW_BY_ROW = [
    "y = sum(c.F * c.arm for c in g.cases)",
    "y = max(c.F for c in g.cases) + np.array([c.F / g.W for c in g.cases]).sum()",
    "y = 0\nfor c in g.cases:\n    y += c.F / g.W",
    "A = np.interp(g.cases.arm, [0.0, 0.1], [1.0, 2.0])\ny = sum(a * c.F for a, c in zip(A, g.cases))",
]
BY_THEIR_TEXTS = "(2.0 if g.cases[0].name == 'braking' else 1.0) * sum(c.F * (c.name == 'braking') for c in g.cases)"


@pytest.mark.parametrize("lines", [*ROW_BY_ROW, f"y = {BY_THEIR_TEXTS}"])
def test_rows_with_texts_are_gone_through_whatever_their_number(lines: str, tmp_path: Path) -> None:
    """One formula for all rows holds for a row that is put in; what reads the text of each is none."""
    path = sheet_of(
        tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1.0  # [-] result\ntable_1 = table('1', 'All', result)"
    )
    sheet = load(path)
    own: Any = sheet.inputs()
    names = sheet.run(sheet.results, {"g": own})
    recording = record({**names, "__file__": sheet.path}, whole=True, every=1, draws=True, lists=True)
    (column,) = recording.tables["1"]
    assert column is not None
    for rows in ("braking; 7; 80 | x; 9; 70 | braking; 5; 60", "braking; 4; 20", "x; 4; 20 | braking; 6; 50"):
        g = built(path, cases=rows)
        texts = [float(n >= 2 or text != own.cases.name[n]) for n, text in enumerate(g.cases.name)]
        told = {"cases.name": np.array(texts), "cases.F": g.cases.F, "cases.arm": g.cases.arm}
        found = numbers([column.re], {recording.inputs[name]: x for name, x in told.items()})[column.re]
        if lines in ROW_BY_ROW or not np.isnan(found).all():
            np.testing.assert_allclose(
                found, by_cells(path, ["result"], cases=rows)["result"], rtol=1e-12, err_msg=rows
            )


@pytest.mark.parametrize("line", [HELD[0], HELD[2]])
def test_what_is_asked_for_again_is_of_the_text_that_is_given(line: str, tmp_path: Path) -> None:
    """What `evaluate` has recorded for other texts is not what is computed."""
    given = 'note: str = "one"  # note\n' + GIVEN
    path = tmp_path / "again.py"
    path.write_text(written(SETUP, given, f"y = {line}  # [-] result\nz = len(g.note) * g.W  # [-] result"))
    for asked in [*OTHERS[:5], {"note": "fourteen"}] * 3:
        found, known = evaluate(path, ["y", "z"], **asked), by_cells(path, ["y", "z"], **asked)
        assert found == known, asked


def test_studies_leave_texts_as_they_are(cases: Path) -> None:
    many = sweep(cases, ["sigma"], {"cases": ["a; 12; 80 | b; 8; 150", "c; 6; 80 | d; 4; 150", "e|f; 1; 2"]})
    np.testing.assert_allclose(many["sigma"][0], 2 * many["sigma"][1], rtol=1e-14)
    assert np.isnan(many["sigma"][2]).all() and "must have the columns" in many.reasons[2]
    both = sweep(cases, ["sigma"], grid(W=[4500, 9000], steel=["S235", "C45"]))
    assert both["sigma"].shape == (2, 2, 2)
    slopes = sensitivity(cases, ["sigma"])
    assert [*slopes.inputs] == ["W"]
    with pytest.raises(SheetError, match="cases"):
        sensitivity(cases, ["sigma"], ["cases"])
    assert mismatches(cases) == []
    done = script(cases, "--proof", f"--out={cases.parent / 'proved'}")
    assert done.returncode == 0, done.stderr


def test_a_text_is_a_column_of_a_table_and_of_no_figure(cases: Path, tmp_path: Path) -> None:
    sheet = load(cases)
    found = sheet.run(sheet.results, {"g": sheet.inputs()})
    column = found["table_1"].columns[0]
    assert (column.symbol, column.unit, column.texts()) == ("name", "", ["braking", "cornering"])
    assert [check.name for check in checks_of(found)] == ["stress, braking", "stress, cornering"]
    path = sheet_of(tmp_path, LINES.replace('table("1", f"Cases, {g.steel.standard}"', 'figure("1", "Cases"'))
    with pytest.raises(SheetError, match="name_cases is no number"):
        evaluate(path, ["table_1"])


@pytest.mark.office
def test_cells_show_the_texts_that_are_typed(cases: Path, tmp_path: Path, recalculated: Any) -> None:
    """In titles and names of checks too; the workbook is read back with all of them."""
    done = script(cases, f"--out={tmp_path}")
    assert done.returncode == 0, done.stderr
    book, declared = tmp_path / "cases.xlsx", inputs.declared(load(cases).inputs)

    def seen(
        changes: dict[str, Any], added: Mapping[str, Any] | None = None
    ) -> tuple[list[Any], dict[str, Any], list[Any]]:
        edited = edit(book, changes, tmp_path / "edited.xlsx")
        if added:
            edited = typed(edited, tmp_path / "added.xlsx", {(f"cases.{k}", 3): x for k, x in added.items()})
        found = recalculated(edited)
        rows = [row[:2] for row in found["Table 1"].iter_rows(min_row=5, max_row=6, values_only=True)]
        checks = {row[0]: (row[4], row[5]) for row in found["Checks"].iter_rows(min_row=3, values_only=True)}
        return rows, checks, reading.inputs(edited, declared)["cases"]["cases.name"]  # type: ignore[index]

    rows, checks, names = seen({})
    assert [name for name, _ in rows] == names == ["braking", "cornering"]
    assert {verdict for verdict, _ in checks.values()} == {"PASS"}
    rows, checks, names = seen({"cases.name (2)": 7, "cases.F (2)": 4})
    assert rows == [("braking", pytest.approx(106.6667)), ("7", pytest.approx(66.6667))]
    assert names == ["braking", 7]  # which is read as that text
    assert {checks[f"stress, {name}"][0] for name in ("braking", "7")} == {"PASS"}
    assert not any(name.startswith("made for these inputs") for name in checks)
    other = recalculated(edit(book, {"steel": "C45"}, tmp_path / "steel.xlsx"))
    assert other["Table 1"]["A1"].value == "Table 1 - Cases, DIN"
    rows, _, names = seen({"cases.name (1)": None})
    assert names == ["", "cornering"] and [name or "" for name, _ in rows] == ["", "cornering"]
    _, checks, names = seen({}, {"name": "new", "F": 1, "arm": 2})
    assert names == ["braking", "cornering", "new"] and checks["inputs within their limits"][0] == "FAIL"
    assert script(cases, f"--scene={tmp_path / 'added.xlsx'}", f"--out={tmp_path / 'again'}").returncode == 0


def test_a_text_that_is_typed_has_room_at_any_length(cases: Path, tmp_path: Path) -> None:
    """A longer one was cut at the next cell, and where it is typed one line of three was seen."""
    assert script(cases, f"--out={tmp_path}").returncode == 0
    book = load_workbook(tmp_path / "cases.xlsx")
    for cell in (book["Table 1"]["A5"], book["Input tables"]["B8"]):
        assert cell.alignment.shrink_to_fit and not cell.alignment.wrap_text
        assert cell.parent.column_dimensions[cell.column_letter].width > 20


ORDERED = """
sigma = g.cases.F * g.cases.arm / g.W  # [MPa] stress
order = np.argsort(-sigma)
s = sigma[order]  # [MPa] the greatest first
b = sigma[::-1]  # [MPa] the last first
who = g.cases.name[order]
table_1 = table("1", "By stress", who, s)
table_2 = table("2", "Back", g.cases.name[::-1], b)
typeset(table_1, table_2)
"""
SORTED = [  # what is changed, and the texts by the stress and from the last one on
    ({}, ["cornering", "braking"], ["cornering", "braking"]),
    ({"cases.F (1)": 60}, ["braking", "cornering"], ["cornering", "braking"]),
    ({"cases.F (1)": 60, "cases.name (1)": "b"}, ["b", "cornering"], ["cornering", "b"]),
]


@pytest.mark.office
def test_texts_stand_in_the_order_of_numbers(tmp_path: Path, recalculated_all: Any, page: Page) -> None:
    """A table sorted by size says whose numbers these are: such a column had been refused."""
    path = sheet_of(tmp_path, ORDERED)
    sheet, file = load(path), tmp_path / "cases.html"
    assert script(path, f"--out={tmp_path}").returncode == 0
    books = [edit(tmp_path / "cases.xlsx", changes, tmp_path / f"{n}.xlsx") for n, (changes, *_) in enumerate(SORTED)]
    file.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    for (changes, *wanted), book in zip(SORTED, recalculated_all(books), strict=True):
        for number, names in enumerate(wanted, 1):
            (title,) = (title for title in book.sheetnames if title in (f"{number} By stress", f"{number} Back"))
            rows = book[title].iter_rows(min_row=5, max_row=6, values_only=True)
            assert [row[0] for row in rows] == names, (changes, title)
        F, name = changes.get("cases.F (1)", 12), changes.get("cases.name (1)", "braking")
        page.goto("about:blank")
        page.goto(f"{file.as_uri()}#cases={name}; {F}; 80 | cornering; 8; 150")
        page.wait_for_selector("body[data-ready]")
        shown = page.locator(".ms-table tbody tr td:first-child").all_inner_texts()
        assert shown == [*wanted[0], *wanted[1]], changes
    other = ORDERED.replace("who = g.cases.name[order]", "who = g.cases.name[order]  # [-] name")
    with pytest.raises(SheetError, match=r"who = g.cases.name\[order\] is no number: it has no \[unit\]"):
        evaluate(sheet_of(tmp_path, other), ["table_1"])


def test_a_page_in_one_file_shows_the_texts_that_are_typed(cases: Path, tmp_path: Path, page: Page) -> None:
    """In tables, sentences and names of checks."""
    sheet, file = load(cases), tmp_path / "cases.html"
    file.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page.goto(file.as_uri())
    page.wait_for_selector("body[data-ready]")

    def shown() -> tuple[list[list[str]], str, str]:
        rows = page.locator(".ms-table tbody tr").evaluate_all(
            "rows => rows.map(r => [...r.cells].map(c => c.innerText))"
        )
        words = "".join(page.get_by_text("Worst:").all_inner_texts())  # none where nothing is computed
        return rows, words, page.locator(".ms-state").inner_text()

    def type_in(label: str, text: str) -> None:
        page.get_by_label(label).fill(text)

    assert shown() == (
        [["braking", "106.67"], ["cornering", "133.33"]],
        "Worst: cornering, first braking, all braking, cornering; S235: EN 1",
        "as in the document",
    )
    type_in("name, row 2", "curve <left>")
    rows, words, state = shown()
    assert rows[1][0] == "curve <left>" and "Worst: curve <left>" in words and "all braking, curve <left>" in words
    assert page.locator(".ms-check .ms-name").all_inner_texts() == ["stress, braking", "stress, curve <left>"]
    assert state == "changed: cases" and page.locator(".ms-check .ms-PASS").count() == 2
    type_in("F, row 2", "1")
    assert "Worst: braking" in shown()[1]
    type_in("name, row 2", "a;b")
    assert "cases.name (2) = 'a;b' must be a text without ; and |" in shown()[2]
    type_in("name, row 2", "n" * 201)
    assert "must be a line of at most 200 characters" in shown()[2]
    type_in("name, row 2", "cornering")
    type_in("F, row 2", "8")
    assert shown()[2] == "as in the document"
    page.locator("#input-steel").select_option("C45")
    assert "; C45: DIN" in shown()[1] and page.get_by_text("Cases, DIN").count()
    type_in("name, row to be filled in", "third")
    type_in("F, row 3", "1")
    type_in("arm, row 3", "1")
    assert [row[0] for row in shown()[0]] == ["braking", "cornering", "third"]
    page.wait_for_function("location.hash.includes('third')")  # which the page writes when it has nothing else to do
    page.reload()
    page.locator(".ms-table tbody tr").nth(2).wait_for()  # what is not in view is shown a moment later
    assert [row[0] for row in shown()[0]] == ["braking", "cornering", "third"]


SHOWN = "    typeset(*checks_1)\n    return chosen"
NAMED = """
chosen = next((c for c in g.cases if c.F >= g.W * 1e9), g.cases[-1])
fitting = [c for c in g.cases if c.F >= g.W * 1e9]
n = len(fitting)  # [-] how many
checks_1 = (check(f"force of {chosen.name}, {n} do", chosen.F, 10 * kN, "kN"), check("n", n, 2.0))
"""


def test_a_check_that_is_called_by_what_was_chosen_follows(tmp_path: Path, page: Page) -> None:
    """It was not known once another row was chosen, and every other check that its words stand beside."""
    path = sheet_of(tmp_path, NAMED)
    shown = "@app.cell\ndef all_of_them(checks_1):\n    summary(*checks_1)\n    return\n\n\n"
    text = path.read_text().replace("import ask,", "import summary, ask,").replace("    return chosen", SHOWN)
    path.write_text(text.replace("@app.cell\ndef workbook", f"{shown}@app.cell\ndef workbook"))
    sheet, file = load(path), tmp_path / "named.html"
    file.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page.goto(file.as_uri())
    page.wait_for_selector("body[data-ready]")

    def told() -> list[str]:
        names = page.locator(".ms-name").all_inner_texts()
        assert len(names) == 2 and names[0] == names[1], "where they are summed up and where it stands"
        return [names[0], page.locator(".ms-check .ms-badge").first.inner_text()]

    assert told() == ["force of braking, 1 do", "FAIL"]
    for F, name, verdict in (("7", "one", "PASS"), ("30", "cornering", "PASS"), ("7", "<b>", "PASS")):
        page.get_by_label("F, row 1").fill(F)
        page.get_by_label("name, row 1").fill(name)
        chosen = name if float(F) >= 9 else "cornering"
        number = int(float(F) >= 9)
        assert told() == [f"force of {chosen}, {number} do", "FAIL" if float(F) > 10 else verdict]
    page.locator(".ms-back").click()
    assert told() == ["force of braking, 1 do", "FAIL"]
    page.get_by_label("name, row 1").fill("again")
    assert told() == ["force of again, 1 do", "FAIL"]
    page.get_by_label("name, row to be filled in").fill("third")
    page.get_by_label("F, row 3").fill("1")
    page.get_by_label("arm, row 3").fill("1")
    page.get_by_label("F, row 1").fill("2")
    page.get_by_label("F, row 3").fill("30")
    page.get_by_label("name, row to be filled in").fill("last")
    page.get_by_label("F, row 4").fill("1")
    page.get_by_label("arm, row 4").fill("1")
    assert told() == ["force of third, 1 do", "FAIL"]  # with two rows more than the page was made with


def test_what_is_neither_a_number_nor_a_text_is_no_column(tmp_path: Path) -> None:
    other = sheet_of(tmp_path, 'name = np.array(["x", None], object)\ntable_1 = table("1", "Two", name, g.cases.F)')
    with pytest.raises(SheetError, match="name is neither a number nor a column of texts"):
        load(other).run(["table_1"], {"g": built(other)})


@pytest.mark.office
def test_a_column_of_texts_may_have_a_name_of_its_own(recalculated: Any, tmp_path: Path, page: Page) -> None:
    """It was refused as no number, though a table takes names; what is made of texts is, with what may stand there."""
    path = sheet_of(tmp_path, 'name = g.cases.name\nF = g.cases.F  # [kN] force\ntable_1 = table("1", "Two", name, F)')
    path.write_text(path.read_text().replace("    return name", "    typeset(table_1)\n    return name"))
    made = load(path).run(["table_1"], {"g": built(path)})["table_1"]
    assert made.columns[0].values.tolist() == ["braking", "cornering"] and made.columns[0].meaning == "name of the case"
    edited = edit(computed(path, tmp_path, {}), {"cases.name (2)": "other"}, tmp_path / "edited.xlsx")
    assert [row[0] for row in recalculated(edited)["1 Two"].iter_rows(min_row=5, values_only=True)] == [
        "braking",
        "other",
    ]
    file = tmp_path / "named.html"
    file.write_text(write.page(load(path), load(path).inputs()), encoding="utf-8")
    page.goto(file.as_uri())
    page.wait_for_selector("body[data-ready]")
    page.get_by_label("name, row 2").fill("typed")
    assert page.locator(".ms-table tbody td.ms-text").all_inner_texts() == ["braking", "typed"]
    path.write_text(path.read_text().replace("name = g.cases.name", "name = np.array([c.name for c in g.cases])"))
    made = load(path).run(["table_1"], {"g": built(path)})["table_1"]
    assert made.columns[0].values.tolist() == ["braking", "cornering"], "one by one they are texts too"


def test_the_grid_of_a_page_takes_texts(serve: Any, page: Page, cases: Path, console_errors: list[str]) -> None:
    page.goto(serve("run", cases))
    name = page.get_by_label("name, row 2")
    name.fill("curve to the left")
    name.press("Enter")
    page.get_by_text("stress, curve to the left").first.wait_for()
    page.get_by_text("Worst: curve to the left, first braking").wait_for()
    page.get_by_label("F [kN], row 2").fill("1")
    page.keyboard.press("Enter")
    page.get_by_text("Worst: braking").wait_for()
    name.fill("x" * 201)
    name.press("Enter")
    page.get_by_text("must be a line of at most 200 characters").first.wait_for()
    name.fill("a; b")
    name.press("Enter")
    page.get_by_text("must have the columns name, F, arm").first.wait_for()
    assert page.get_by_label("F [kN], row 2").input_value() == "1", "and nothing is lost"
    name.fill("2")
    name.press("Enter")
    page.get_by_text("all braking, 2;").wait_for()
    assert name.evaluate("e => getComputedStyle(e).textAlign") == "left"
    assert console_errors == []
