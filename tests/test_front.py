"""The front sheet of a workbook, the sheets behind its tables, and what of them does not follow other inputs."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from as_script import as_script
from conftest import WITHIN
from openpyxl import load_workbook
from openpyxl.formula.translate import Translator
from own_worksheet import written
from test_recalculation import computed, edit, export
from test_recorded_worksheet import own

from mechsheet.run import report

GREY = "FFE4E4E4"
LINES = """y = np.fft.fft(x).real  # [-] spectrum
z = 2 * np.max(y)  # [%] rests on it
w = 3 * g.F  # [-] (2.4) does not
v = 2 * g.F  # [-] is read by another line
u = v + g.a  # [-] reads it
table_2 = table("2", "Spectrum", x, y)"""


@pytest.fixture(scope="module")
def hitch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export("hitch", tmp_path_factory.mktemp("hitch"), {})


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Workbook of a worksheet one of whose lines is not recorded."""
    folder = tmp_path_factory.mktemp("kept")
    sheet = own(folder, LINES)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": str(sheet.path)}
    (folder / "own.xlsx").write_bytes(report.workbook("Own", names, {}))
    return folder / "own.xlsx"


@cache
def opened(path: Path, values: bool = True) -> Any:
    """A workbook that no test changes."""
    return load_workbook(path, data_only=values)


def blocks(path: Path | Any) -> dict[str, list[Any]]:
    """Rows of cells of the front sheet under the heading of their block."""
    book = opened(path) if isinstance(path, Path) else path
    heads, found = ("Key results", "Contents", "Not followed"), dict[str, list[Any]]()
    for row in book["Front"].iter_rows(min_row=3):
        if row[0].value in heads:
            rows = found[row[0].value] = []
        elif row[0].value:
            rows.append(row)
        else:
            rows = []  # below stand notes
    return found


def front(path: Path | Any) -> dict[str, list[list[Any]]]:
    return {head: [[cell.value for cell in row] for row in rows] for head, rows in blocks(path).items()}


def column(sheet: Any, symbol: str) -> list[Any]:
    """Values of the cells under a symbol."""
    at = [cell.value for cell in sheet[3]].index(symbol)
    return [row[at].value for row in sheet.iter_rows(min_row=5, max_row=14)]


def test_front_sheet_is_the_first_and_tells_the_verdict(hitch: Path) -> None:
    book = opened(hitch)
    assert book.sheetnames[:2] == ["Front", "Inputs"]
    assert [book["Front"][cell].value for cell in ("A1", "A2")] == ["Tractor hitch", "all checks PASS"]


def test_key_results_are_found_values_then_what_figures_show(hitch: Path) -> None:
    book = opened(hitch)
    results = {row[0]: row[1:] for row in front(hitch)["Key results"]}
    assert list(results)[:3] == ["L4", "S_p", "L7"]
    assert [results[row[0].value][0] for row in book["Find"].iter_rows(min_row=3)] == [
        row[1].value for row in book["Find"].iter_rows(min_row=3)
    ]
    names = [
        series.tx.strRef.f for sheet in book for chart in sheet._charts for series in chart.series if series.tx.strRef
    ]
    sheets = [name.rsplit("!", 1) for name in names if not name.startswith("Marks")]
    assert {book[sheet.strip("'")][cell.replace("$", "")].value for sheet, cell in sheets} <= set(results)
    capacity = column(book["4.1 Lifting capacity"], "GS6")
    assert results["GS6"][:3] == [min(capacity), max(capacity), "N"]


def test_contents_link_to_every_sheet_under_its_title(hitch: Path) -> None:
    book = opened(hitch)
    rows = blocks(hitch)["Contents"]
    assert [row[0].value for row in rows] == book.sheetnames[1:]
    for row in rows:
        sheet = re.fullmatch(r"'(.*)'!A1", row[0].hyperlink.location)
        assert sheet and sheet[1] == row[0].value
        assert row[1].value == book[sheet[1]]["A1"].value


def test_a_find_without_a_solution_is_no_pass_though_no_check_rests_on_it(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    setup = "from mechsheet import ask, check, export, find, inputs, read, typeset"
    lines = "r_found = find(lambda r: r**2, 0, 2, equals=g.F)\nr = r_found.value  # [-] root\n"
    lines += "heavy = check('load', g.F, 90.0)\ntypeset(r_found)"
    path = tmp_path / "root.py"
    path.write_text(written(setup, "F: float = 2.5  # [-] load", lines, "Root"), encoding="utf-8")
    assert as_script(path).returncode == 0
    exported = path.with_suffix(".xlsx")
    books = {F: recalculated(edit(exported, {"F": F}, tmp_path / f"{F}.xlsx")) for F in (2.5, 3.5, 9)}
    said = {F: book["Front"]["A2"].value for F, book in books.items()}
    assert said == {2.5: "all checks PASS", 3.5: "all checks PASS", 9: "0 FAIL, 0 not evaluated, 1 not found"}
    others = [book["Find"]["I3"].value for book in books.values()]
    assert others == [None, "not followed", "not followed"], "nothing there would say that there is none"
    refused = as_script(path, "--F=9")
    assert refused.returncode == 1 and "9 is outside" in refused.stderr


def test_front_sheet_follows_the_inputs(hitch: Path, recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    book = recalculated(edit(hitch, {"P6": 26e3, "S_max": 0.9}, tmp_path / "edited.xlsx"))
    said = book["Front"]["A2"].value
    verdicts = [row[4].value for row in book["Checks"].iter_rows(min_row=3)]
    lost = [row[1].value for row in book["Find"].iter_rows(min_row=3)].count("#N/A")
    counts = f"{verdicts.count('FAIL')} FAIL, {verdicts.count('not evaluated')} not evaluated, {lost} not found"
    assert said == counts and not said.startswith("0 FAIL, 0")
    results = {row[0]: row[1:] for row in front(book)["Key results"]}
    capacity = column(book["4.1 Lifting capacity"], "GS6")
    numbers = [x for x in capacity if isinstance(x, float)]
    assert "#N/A" in capacity and results["GS6"][:2] == [min(numbers), max(numbers)]
    assert results["S_p"][0] == next(row[1].value for row in book["Find"].iter_rows() if row[0].value == "S_p")


def test_unchanged_the_front_sheet_is_recalculated_to_the_same(
    hitch: Path, recalculated: Callable[[Path], Any]
) -> None:
    live, own_values = front(recalculated(hitch)), front(hitch)
    assert live["Contents"] == own_values["Contents"]
    for row, known in zip(live["Key results"], own_values["Key results"], strict=True):
        assert [row[0], *row[3:]] == [known[0], *known[3:]]
        assert [x for x in row[1:3] if x] == pytest.approx([x for x in known[1:3] if x], rel=1e-12)


def test_sheets_behind_the_tables_are_the_last_and_have_grey_tabs(hitch: Path) -> None:
    book = opened(hitch, values=False)
    grey = [sheet.title for sheet in book if sheet.sheet_properties.tabColor]
    assert grey == book.sheetnames[-len(grey) :] and book.sheetnames[-len(grey) - 2 : -len(grey)] == ["Checks", "Index"]
    assert all(name == "Marks" or re.search(r" (lines|fields)( \(\d+\))?$", name) for name in grey)
    for name in grey:  # what is printed of them holds nothing
        cell = book[name].print_area.split("!")[-1].replace("$", "")
        assert book[name][cell.partition(":")[0]].value is None and not book[name].print_title_rows


def test_only_sheets_of_the_document_are_printed(hitch: Path, soffice: str, tmp_path: Path) -> None:
    """Every page is one of Front, Inputs, Find, the tables, Checks and Index."""
    profile = (tmp_path / "profile").as_uri()
    command = [soffice, f"-env:UserInstallation={profile}", "--headless", "--convert-to", "pdf"]
    subprocess.run([*command, "--outdir", tmp_path, hitch], check=True, capture_output=True, timeout=WITHIN)
    pages = len(re.findall(rb"/Type\s*/Page\b", (tmp_path / "hitch.pdf").read_bytes()))
    behind = sum(sheet.sheet_properties.tabColor is not None for sheet in opened(hitch))
    assert len(opened(hitch).sheetnames) - behind <= pages <= 16


def test_steps_tell_the_line_of_the_worksheet(hitch: Path) -> None:
    source = (Path(__file__).parents[1] / "worksheets" / "hitch.py").read_text(encoding="utf-8").splitlines()
    book = opened(hitch)
    seen = 0
    for name in book.sheetnames:
        if name.endswith(" lines"):
            for row in book[name].iter_rows(min_row=3, values_only=True):
                assert row[4] or row[3] in ("number of the row",) or row[3].startswith("limit: "), row
                if found := re.fullmatch(r"line (\d+)", row[4] or ""):
                    assert source[int(found[1]) - 1].strip(), row
                    seen += 1
    assert seen > 20


def test_axes_follow_what_inputs_move(hitch: Path) -> None:
    """The lengths of the cylinder are inputs: written ends would cut the curves of others."""
    (chart, *_) = opened(hitch)["4.1 Lifting capacity"]._charts
    assert [(a.scaling.min, a.scaling.max, a.majorUnit) for a in (chart.x_axis, chart.y_axis)] == [(None,) * 3] * 2


def test_axes_keep_the_range_that_no_input_moves(tmp_path: Path) -> None:
    lines = """t = linspace(0.2, 0.5, 5)  # [s] time
y = g.F * t  # [-] follows an input
figure_1 = figure("1", "Along what no input moves", t, y)
figure_2 = figure("2", "Along what one moves", x, y)"""
    sheet = own(tmp_path, lines)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": str(sheet.path)}
    (tmp_path / "own.xlsx").write_bytes(report.workbook("Own", names, {}))
    book = load_workbook(tmp_path / "own.xlsx")
    axes = [chart.x_axis.scaling for sheet in book for chart in sheet._charts]
    assert [(axis.min, axis.max) for axis in axes] == [(0.2, 0.5), (None, None)]


def test_what_is_not_followed_is_named_on_the_front_sheet(kept: Path, hitch: Path) -> None:
    book = opened(kept)
    row, note = front(kept)["Not followed"]
    line = (kept.parent / "own.py").read_text().splitlines().index("    y = np.fft.fft(x).real  # [-] spectrum") + 1
    assert row[0] == f"line {line}: y" and "fft" in row[1]
    assert note[0] == "Grey cells hold for the exported inputs only, and show #N/A otherwise."
    assert "Not followed" not in front(hitch)
    assert book["Front"]["A2"].value == "all checks PASS"


def test_without_found_values_the_last_lines_are_the_key_results(kept: Path) -> None:
    results = {row[0].value: row for row in blocks(kept)["Key results"]}
    assert list(results) == ["z", "w", "u"]
    grey = {name: row[1].fill.fgColor.rgb == GREY for name, row in results.items()}
    assert grey == {"z": True, "w": False, "u": False}
    book = opened(kept)
    assert results["w"][1].value == 7.5 and results["z"][1].value / 100 == 2 * max(
        row[1].value for row in book["2 Spectrum"].iter_rows(min_row=5)
    )


def test_grey_is_what_rests_on_the_line_and_it_is_not_available_for_other_inputs(
    kept: Path, recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """On every sheet: what is grey has no number after a change under it, and what is white has one."""
    book, changed = opened(kept, values=False), recalculated(edit(kept, {"F": 4.0}, tmp_path / "edited.xlsx"))
    grey = white = 0
    for sheet in book:
        for row in sheet.iter_rows():
            for cell in row:
                if cell.data_type != "f" or sheet.title in ("Inputs", "Checks"):
                    continue  # they say it in words: not evaluated
                if cell.fill.fgColor.rgb == GREY:
                    assert changed[sheet.title][cell.coordinate].value == "#N/A", (sheet.title, cell.coordinate)
                    grey += 1
                else:
                    assert changed[sheet.title][cell.coordinate].value != "#N/A", (sheet.title, cell.coordinate)
                    white += 1
    assert grey >= 7 and white >= 10  # five numbers of the spectrum, and z on two sheets


def test_the_number_of_a_printed_formula_stands_before_the_meaning_where_lines_are_listed(kept: Path) -> None:
    sheets = [sheet for sheet in opened(kept) if sheet.title != "Index"]
    texts = [cell.value for sheet in sheets for row in sheet for cell in row]
    assert texts.count("(2.4) does not") == 1, "in the list of lines"
    assert texts.count("does not") <= 1, "and not in the results"


def test_proved_digits_are_those_of_the_exported_inputs(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    command = [sys.executable, "-m", "mechsheet", "run", "landing_gear", "--proof", f"--out={tmp_path}"]
    subprocess.run(command, cwd=Path(__file__).parents[1], check=True, capture_output=True, timeout=WITHIN)
    path = tmp_path / "landing_gear.xlsx"
    kept, edited = recalculated_all([path, edit(path, {"l3": 0.31}, tmp_path / "edited.xlsx")])
    for book, digits in ((kept, True), (edited, False)):
        head, *listed = [[cell.value for cell in row] for row in book["Checks"].iter_rows(min_row=2)]
        proved = [row for row in listed if row[0].endswith("every number proved to 9 digits")]
        assert head[6] == "Digits proved" and len(proved) > 5
        assert all(row[4] == ("PASS" if digits else "not evaluated") for row in proved)
        assert all(row[6] > 9 if digits else row[6] == "#N/A" for row in proved)
        assert not any(row[6] for row in listed if row not in proved)


def test_lines_under_no_heading_stand_under_no_dash(tmp_path: Path) -> None:
    """The workbook of a worksheet without sections had ' - lines behind the tables' among its contents."""
    sheet = own(tmp_path, "y = x * g.a  # [-] line\nr = y.max()  # [-] greatest")
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("Own", {**sheet.run_whole(), "__file__": sheet.path}, {}))
    book = load_workbook(path)
    heads = [book[name]["A1"].value for name in ("Table lines", "Table fields")]
    assert heads == ["lines, in SI units", "fields, in SI units"]


def test_where_cells_compare_what_they_compute_it_says_how(tmp_path: Path) -> None:
    """Of two numbers that differ in the last digits a spreadsheet program tells another one the greater."""
    for line, told in {
        "y = np.where(x * g.a > 1, x, 0.0)": 1,
        "y = x * g.a": 0,
        "y = x * (2 if g.F > 3 else 1)": 0,
    }.items():
        sheet = own(tmp_path, f"{line}  # [-] line")
        path = tmp_path / "own.xlsx"
        path.write_bytes(report.workbook("Own", {**sheet.run_whole(), "__file__": sheet.path}, {}))
        cells = [cell.value for (cell, *_) in load_workbook(path)["Front"].iter_rows()]
        assert sum("differ in their last digits" in str(text) for text in cells) == told, line


def forms(sheet: Any, address: str) -> list[tuple[str, str]]:
    """Conditions and number formats of a cell, the first that holds prevailing; written they are those of the first."""
    every = ((rule, cells) for cells in sheet.conditional_formatting if address in cells for rule in cells.rules)
    rules = sorted((each for each in every if each[0].type == "expression"), key=lambda each: each[0].priority)
    return [
        (
            Translator(f"={rule.formula[0]}", str(cells.sqref).split(":")[0].split()[0]).translate_formula(address),
            rule.dxf.numFmt.formatCode,
        )
        for rule, cells in rules
    ]


def test_numbers_of_another_size_are_legible(
    recalculated_files: Callable[[list[Path]], list[Path]], tmp_path: Path
) -> None:
    """Those too long for their cells stood there as ###, and small ones as 0.000; the last row has no number."""
    lines = """from mechsheet import check
y = np.where(x == x[-1], np.nan, x)  # [-] field
z = 3 * g.F  # [kN] alone
checks = check("own", z / 7, at_least=-1e30, unit="kN")
table_2 = table("2", "Own", y)
figure_2 = figure("2", "Own", x, y)"""
    sheet = own(tmp_path, lines)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": str(sheet.path)}
    (tmp_path / "own.xlsx").write_bytes(report.workbook("Own", names, {}))
    any_size = "[>=100]0;[>=0.01]0.000;General"
    expected = {
        2.5: ("0.0000", "0.0000", "0.000000", "0.00E+00"),
        21.0: ("0.0000", "0.0000", "0.000000", any_size),
        1e7: ("0", "0", "0", any_size),
        -1e6: ("0", "0", "0", "0"),
        -1e3: ("0", "0.0000", "0.000000", "0.000"),
        -1e14: ("0.0E+00", "0.00E+00", "0.00E+00", "0.00E+00"),
        1e-2: ("0.0000", "0.0000", "0.00E+00", "0.00E+00"),
        1e-5: ("0.0E+00", "0.00E+00", "0.00E+00", "0.00E+00"),
        0.0: ("0.0000", "0.0000", "0.000000", any_size),
    }
    edited = list[Path]()
    for F in expected:
        book = load_workbook(tmp_path / "own.xlsx")
        rows = {cells[0].value: cells[0].row for cells in book["Front"].iter_rows(min_row=5)}
        places = ("2 Own", "A5"), ("Front", f"B{rows['y']}"), ("Front", f"B{rows['z']}"), ("Checks", "B4")
        known = [forms(book[title], address) for title, address in places]
        for n, ((title, _), rules) in enumerate(zip(places, known, strict=True)):
            for row, (condition, _) in enumerate(rules, 1):
                book[title].cell(row, 20 + n).value = condition
        assert book["Inputs"]["A3"].value == "F"
        book["Inputs"]["B3"].value = F
        book.save(tmp_path / f"{F}.xlsx")
        edited.append(tmp_path / f"{F}.xlsx")
    books = [load_workbook(path, data_only=True) for path in recalculated_files(edited)]
    for said, book in zip(expected.values(), books, strict=True):
        for n, ((title, address), rules, form) in enumerate(zip(places, known, said, strict=True)):
            holding = (look for row, (_, look) in enumerate(rules, 1) if book[title].cell(row, 20 + n).value is True)
            assert next(holding, book[title][address].number_format) == form, (title, book[title][address].value)


def test_the_verdict_has_room_for_all_its_words(hitch: Path) -> None:
    """White on red, what went beyond the first column was not to be read."""
    assert "A2:E2" in opened(hitch)["Front"].merged_cells


def test_a_mistake_in_a_unit_is_told_whatever_the_inputs_are(tmp_path: Path) -> None:
    """Its check fails for all of them, and said why for the exported ones alone."""
    sheet = own(tmp_path, "y = x * g.F  # [kN] line")
    (tmp_path / "own.xlsx").write_bytes(report.workbook("Own", {**sheet.run_whole(), "__file__": sheet.path}, {}))
    (row,) = (
        row for row in load_workbook(tmp_path / "own.xlsx")["Checks"].iter_rows(values_only=True) if "units" in row
    )
    assert row[1] == "=1" and row[5].startswith("line") and "unit [kN] does not fit" in row[5]


def test_no_step_is_a_number_that_was_typed(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """What tells whether a list is the exported one stood as that list among the steps, whatever was typed."""
    given = "F: float = 2.0  # [-] number\nlengths: list[float] = [1.25, 2.5, 7.75]  # [-] lengths"
    lines = """s = np.linalg.eigvals(np.diag(g.lengths)).real  # [-] own values
y = g.F if max(s) > 5 else 2.0  # [-] looks at it
typeset()"""
    setup = "import numpy as np\nfrom mechsheet import ask, export, inputs, read, typeset"
    path = tmp_path / "own.py"
    path.write_text(written(setup, given, lines, "Own"))
    book = computed(path, tmp_path, {})
    live = recalculated(edit(book, {"lengths (2)": 2.75}, tmp_path / "edited.xlsx"))
    behind = [sheet for sheet in live if sheet.title.endswith(("lines", "fields"))]
    shown = [cell for sheet in behind for row in sheet.iter_rows(values_only=True) for cell in row]
    assert "#N/A" in shown and {1.25, 2.5, 7.75}.isdisjoint(shown)
    (y,) = (row for row in behind[0].iter_rows(values_only=True) if row[0] == "y")
    assert y[1] == "#N/A"


def test_a_mark_of_a_chart_passes_over_what_is_no_number(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """Its line had no ends, and was not drawn, where a curve has no number somewhere."""
    lines = """y = np.where(x > 1, g.F * x, np.nan)  # [-] gaps
top = x[-1]  # [-] marked
figure_1 = figure("1", "Gaps", x, y, marks={"top": top})"""
    sheet = own(tmp_path, lines)
    (tmp_path / "own.xlsx").write_bytes(report.workbook("Own", {**sheet.run_whole(), "__file__": sheet.path}, {}))
    for path, ends in (
        (tmp_path / "own.xlsx", (1.4375 * 2.5, 12.5)),
        (edit(tmp_path / "own.xlsx", {"F": 5.0}, tmp_path / "edited.xlsx"), (14.375, 50.0)),
    ):
        (row,) = recalculated(path)["Marks"].iter_rows(min_row=3, values_only=True)
        assert row[4:6] == pytest.approx(ends)
