"""The workbook read back: what stands in its cells, and how it looks."""

import html
import re
import subprocess
from dataclasses import replace
from datetime import datetime
from functools import cache
from io import BytesIO
from itertools import product
from math import inf, isclose, nan
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from zipfile import ZipFile

import numpy as np
import pandas as pd
import pytest
import written_cells
from conftest import WITHIN, examples
from hypothesis import given
from hypothesis import strategies as st
from openpyxl import load_workbook

from mechsheet import units
from mechsheet.workbook import writing
from mechsheet.workbook.book import Book
from mechsheet.workbook.find_sheet import FoundRow
from mechsheet.workbook.inputs_sheet import InputRow
from mechsheet.workbook.save import save
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.table import Column, Figure, Table

EXPORTS = Path(__file__).parents[1] / "exports"  # which other tests keep current
S = Column("S", "m", "cylinder length", 3, np.linspace(0.42, 0.67, 4))
G56 = Column("G56", "N", "capacity at the axis", 0, np.array([33139.4, 37094.25, 1e5 / 3, -2.0]))
GS6 = Column("GS6", "N", "capacity at the centre of mass", 0, np.array([31354.1, nan, inf, 32922.7]))
P_GC = Column("Pgc", "MPa", "pressure", 2, np.array([15.3, 14.6, 14.4, 14.5]))
TABLE = Table("4.1", "Lifting capacity", (S, G56, GS6), "GS6 is the least.")
FIGURE = Figure("4.1", "Capacity", S, (G56, GS6), (("S_p", 0.4694),))
FOUND = FoundRow("S_p", 0.1 + 0.2, "m", "working length", -5.5e-17, "m", 0.42, 0.67, "0.51 (branch -1)")
INPUTS = [
    InputRow("L3", 0.2, "m", "rocker", "1.2 Lengths", ((">", "0"), ("<", "S_max"))),
    InputRow("N_pol", 10, "-", "number of positions", "1.3 Positions", ((">=", "2"),), whole=True),
    InputRow("side", "left", "-", "branch", "1.3 Positions"),
]
CHECKS = [
    Check("loop closes", 1.2e-16, 1e-12, "m", "by both chains"),
    Check("slope", 2e-9, 1e-9),
    Check("lost", nan, 1e-9),
]
HOSTILE = [
    *("=1+1", "=cmd|' /C calc'!A0", "@SUM(A1)", "+1", "-1", "{=1}", "http://example.org", "internal:Checks!A1", "1e5"),
    *("#N/A", "TRUE", "<r><t>x</t></r>", "<r>&</r>", "Stop!A1", "=Checks!A1", "&G &[Picture] && &P", "_x0041_", "'q'"),
    *("\x01\x0b\x7f", "\ud800", "\uffff", "x" * 40, "𝔸" * 40, "[a]:b*c?d/e\\f", "", " ", "History", "checks", "a\nb"),
]


def data(**changes: Any) -> bytes:
    parts: dict[str, Any] = dict(inputs=INPUTS, found=[FOUND], tables=[TABLE], figures=[FIGURE], checks=CHECKS)
    return writing.workbook("Tractor hitch", **{**parts, **changes})


@cache
def unchanged(values: bool) -> Any:
    return load_workbook(BytesIO(data()), data_only=values)


def book(values: bool = True, **changes: Any) -> Any:
    return load_workbook(BytesIO(data(**changes)), data_only=values) if changes else unchanged(values)


def rows(sheet: Any) -> list[list[Any]]:
    return [list(row) for row in sheet.iter_rows(values_only=True)]


def words(title: Any) -> str:
    return "".join(run.t for paragraph in title.tx.rich.p for run in paragraph.r)


def test_sheets_stand_in_the_order_of_the_document() -> None:
    assert book().sheetnames == ["Front", "Inputs", "Find", "4.1 Lifting capacity", "Checks", "Marks"]
    assert book(figures=[]).sheetnames == ["Front", "Inputs", "Find", "4.1 Lifting capacity", "Checks"]


def test_table_has_title_note_symbols_units_and_numbers() -> None:
    cells = rows(book()["4.1 Lifting capacity"])
    assert [row[0] for row in cells[:2]] == ["Table 4.1 - Lifting capacity", "GS6 is the least."]
    assert cells[2:4] == [["S", "G56", "GS6"], ["m", "N", "N"]]
    assert [row[:2] for row in cells[4:]] == [[s, f] for s, f in zip(S.values, G56.values, strict=True)]


def test_meaning_is_a_note_at_the_symbol() -> None:
    sheet = book()["4.1 Lifting capacity"]
    assert [cell.comment.text for cell in sheet[3]] == [S.meaning, G56.meaning, GS6.meaning]


def test_number_format_shows_the_decimals_of_the_column() -> None:
    sheet = book()["4.1 Lifting capacity"]
    assert [cell.number_format for cell in sheet[5]] == ["0.000", "0", "0"]


@examples(25)
@given(st.lists(st.floats(-1e306, 1e306).filter(lambda v: v == 0 or abs(v) > 1e-300), min_size=1, max_size=60))
def test_numbers_are_stored_to_the_last_bit(values: list[float]) -> None:
    column = replace(S, values=np.array(values))
    sheet = written_cells.read(BytesIO(data(tables=[Table("1", "t", (column,))], figures=[])))["1 t"]
    assert [sheet[row, 1][1] for row in range(5, 1 + max(row for row, _ in sheet))] == values


def test_pandas_reads_a_table_as_numbers() -> None:
    frame = pd.read_excel(BytesIO(data()), sheet_name="4.1 Lifting capacity", header=2, skiprows=[3])
    assert list(frame.columns) == ["S", "G56", "GS6"]
    assert {str(kind) for kind in frame.dtypes} == {"float64"}
    expected = [GS6.values[0], nan, nan, GS6.values[3]]
    np.testing.assert_array_equal(frame["GS6"], expected)
    np.testing.assert_array_equal(frame["S"], S.values)


def test_no_number_is_an_error_value_not_a_text() -> None:
    sheet = book()["4.1 Lifting capacity"]
    assert [(c.value, c.data_type) for c in (sheet["C6"], sheet["C7"])] == [("#N/A", "e"), ("#NUM!", "e")]


def test_only_error_values_are_formulas() -> None:
    sheets = book(values=False).worksheets[1:]  # the front sheet refers to the others
    formulas = [c.value for sheet in sheets for row in sheet for c in row if c.data_type == "f"]
    assert set(formulas) == {"=#N/A", "=#NUM!"}


def test_inputs_stand_under_their_sections() -> None:
    assert rows(book()["Inputs"]) == [
        ["Tractor hitch - inputs", None, None, None, None],
        ["Symbol", "Value", "Unit", "Meaning", "Limits"],
        ["1.2 Lengths", None, None, None, None],
        ["L3", 0.2, "m", "rocker", "> 0, < S_max"],
        ["1.3 Positions", None, None, None, None],
        ["N_pol", 10, "-", "number of positions", "whole number, >= 2"],
        ["side", "left", "-", "branch", None],
    ]


def test_values_to_edit_have_a_ground_of_their_own() -> None:
    sheet = book()["Inputs"]
    assert sheet["B4"].fill.fgColor.rgb == sheet["B7"].fill.fgColor.rgb != sheet["A4"].fill.fgColor.rgb


def test_find_shows_value_residual_and_interval() -> None:
    _, heads, row = rows(book()["Find"])
    assert heads[:8] == ["Symbol", "Value", "Unit", "Meaning", "Residual", "Unit", "From", "To"]
    assert heads[8:] == ["Other roots", "Value is", "Target"]
    assert row == [
        *("S_p", 0.1 + 0.2, "m", "working length", -5.5e-17, "m", 0.42, 0.67, "0.51 (branch -1)", "found", None),
    ]


def test_checks_show_verdicts_and_their_count() -> None:
    title, heads, *listed = rows(book()["Checks"])
    assert title[0] == "Checks: 1 of 3 passed"
    assert heads == ["Check", "Residual", "Limit", "Unit", "Verdict", "Reason"]
    assert listed[0] == ["loop closes", 1.2e-16, 1e-12, "m", "PASS", "by both chains"]
    assert [(row[1], row[4]) for row in listed[1:]] == [(2e-9, "FAIL"), ("#N/A", "not evaluated")]


def test_a_quantity_is_shown_as_one_and_what_two_computations_differ_by_as_rounding() -> None:
    """A pressure of 16.064 MPa under a limit of 17.5 is not read as 1.6E+01."""
    sheet = book(checks=[Check("pressure", 16.064, 17.5, "MPa"), Check("loop", 2e-16, 1e-12, agreement=True)])["Checks"]
    formats = [[cell.number_format for cell in row[1:3]] for row in sheet["A3:E4"]]
    assert formats == [["[>=100]0;[>=0.01]0.000;General"] * 2, ["0.0E+00;-0.0E+00;0"] * 2]


def test_of_the_inputs_what_the_user_edits_is_printed_alone() -> None:
    """The numbers in SI units beside them would be pages of their own, under titles cut off."""
    with ZipFile(EXPORTS / "hitch.xlsx") as file:
        assert re.search(r"Inputs!\$A\$1:\$E\$\d+<", file.read("xl/workbook.xml").decode())


def test_headings_and_first_column_are_frozen() -> None:
    for sheet in book():
        assert sheet.freeze_panes == f"B{5 if sheet.title[0].isdigit() else 3}"


@pytest.mark.parametrize(
    ("rows", "columns", "over", "across"),
    [(5, 3, None, None), (40, 30, None, "$A:$A"), (300, 3, "$1:$4", None)],
)
def test_headings_are_printed_on_every_page(rows: int, columns: int, over: str | None, across: str | None) -> None:
    """A sheet that is one page has them once: LibreOffice reads a workbook of these three times as fast without."""
    wide = [Column(f"x_{n}", "m", "", 3, np.linspace(0, 1, rows)) for n in range(columns)]
    sheet = book(tables=[Table("1.1", "Own", wide)], figures=[])["1.1 Own"]
    assert (sheet.print_title_rows, sheet.print_title_cols) == (over, across)


def test_pages_are_a4_with_title_and_number() -> None:
    for sheet in book(figures=[]):
        assert sheet.page_setup.paperSize == 9
        assert sheet.oddHeader.left.text.strip() == "Tractor hitch"
        assert sheet.oddFooter.center.text.strip() == "&P / &N"
        assert sheet.sheet_properties.pageSetUpPr.fitToPage


@pytest.mark.parametrize(("title", "printed"), [("R&D", "R&&D"), ("R&G", "R&& G"), ("7 bar", "7 bar")])
def test_title_in_the_header_is_no_code(title: str, printed: str) -> None:
    """&D would print the date, &G ask for a picture, and a digit after the font size enlarge it."""
    content = writing.workbook(title, inputs=[], found=[], tables=[], figures=[], checks=[])
    with ZipFile(BytesIO(content)) as file:
        header = html.unescape(
            re.findall("<oddHeader>(.*)</oddHeader>", file.read("xl/worksheets/sheet1.xml").decode())[0]
        )
    assert header == f"&L&8 {printed}&R&8 &A"


def test_wide_sheets_are_printed_on_their_side() -> None:
    wide = Table("2", "wide", tuple(replace(S, symbol=f"X{n}") for n in range(14)))
    opened = book(tables=[replace(TABLE, number="1"), wide], figures=[])
    assert opened["1 Lifting capacity"].page_setup.orientation != "landscape"
    assert opened["2 wide"].page_setup.orientation == "landscape"


def test_columns_are_as_wide_as_their_numbers() -> None:
    long = replace(S, symbol="F", values=-1e12 * S.values)
    sheet = book(tables=[Table("1", "t", (S, long))], figures=[])["1 t"]
    assert sheet.column_dimensions["B"].width > len(f"{long.values[0]:.3f}") + 1


def test_figure_is_a_chart_of_straight_lines_on_the_cells_of_its_table() -> None:
    (chart,) = book()["4.1 Lifting capacity"]._charts
    lines = chart.series[:2]
    assert [line.xVal.numRef.f for line in lines] == ["'4.1 Lifting capacity'!$A$5:$A$8"] * 2
    assert [line.yVal.numRef.f for line in lines] == [f"'4.1 Lifting capacity'!${c}$5:${c}$8" for c in "BC"]
    assert [line.tx.strRef.f for line in lines] == [f"'4.1 Lifting capacity'!${c}$3" for c in "BC"]
    assert chart.scatterStyle == "lineMarker"
    assert not any(line.smooth for line in chart.series)


def test_figure_names_itself_its_axes_and_their_units() -> None:
    (chart,) = book()["4.1 Lifting capacity"]._charts
    assert words(chart.title) == "Figure 4.1 - Capacity"
    assert (words(chart.x_axis.title), words(chart.y_axis.title)) == ("S [m]", "G56, GS6 [N]")


def test_axis_of_many_lines_names_the_first_and_the_last() -> None:
    lines = tuple(replace(G56, symbol=f"R{n}") for n in range(6))
    (chart,) = book(tables=[Table("5", "t", (S, *lines))], figures=[Figure("5", "f", S, lines)])["5 t"]._charts
    assert words(chart.y_axis.title) == "R0 .. R5 [N]"


def test_only_several_lines_have_a_legend() -> None:
    assert book()["4.1 Lifting capacity"]._charts[0].legend is not None
    alone = replace(FIGURE, lines=(G56,))
    assert book(figures=[alone])["4.1 Lifting capacity"]._charts[0].legend is None


def test_stored_points_of_a_chart_leave_out_what_is_no_number() -> None:
    """A viewer that does not read the cells would draw #N/A as zero."""
    (chart,) = book()["4.1 Lifting capacity"]._charts
    stored = chart.series[1].yVal.numRef.numCache
    assert stored.ptCount == 4
    assert {point.idx: float(point.v) for point in stored.pt} == {0: GS6.values[0], 3: GS6.values[3]}


def test_gaps_are_not_bridged() -> None:
    with ZipFile(BytesIO(data())) as file:
        xml = file.read("xl/charts/chart1.xml").decode()
    assert "dispNaAsBlank" in xml


def test_marks_are_vertical_lines_over_the_height_of_the_figure() -> None:
    opened = book()
    (chart,) = opened["4.1 Lifting capacity"]._charts
    mark = chart.series[2]
    assert (mark.xVal.numRef.f, mark.yVal.numRef.f) == ("Marks!$C$3:$D$3", "Marks!$E$3:$F$3")
    scale = chart.y_axis.scaling
    assert rows(opened["Marks"])[2] == ["Figure 4.1 - Capacity", "S_p", 0.4694, 0.4694, scale.min, scale.max]


def test_mark_beyond_the_data_is_within_the_axis() -> None:
    (chart,) = book(figures=[replace(FIGURE, marks=(("S_end", 0.93),))])["4.1 Lifting capacity"]._charts
    assert chart.x_axis.scaling.max >= 0.93


def test_figure_of_other_columns_gets_a_sheet_of_its_own_data() -> None:
    opened = book(figures=[FIGURE, Figure("4.3", "Pressure", S, (P_GC,))])
    assert opened.sheetnames[3:5] == ["4.1 Lifting capacity", "Fig 4.3 data"]
    sheet = opened["Fig 4.3 data"]
    assert rows(sheet)[2:5] == [["S", "Pgc"], ["m", "MPa"], [0.42, 15.3]]
    assert len(sheet._charts) == 1


def test_equal_columns_of_another_cell_of_the_worksheet_are_found() -> None:
    copies = [replace(column, values=column.values.copy()) for column in (S, GS6)]
    assert len(book(figures=[Figure("4.9", "f", copies[0], (copies[1],))])["4.1 Lifting capacity"]._charts) == 1


def test_charts_cover_neither_numbers_nor_each_other() -> None:
    """Of tables of several lengths, each with numbers of its own, under which its charts stand."""
    tables, figures = dict[tuple[int, int], Table](), list[Figure]()
    for n, (length, count) in enumerate(product((1, 10, 40, 41, 300), (1, 2, 3, 5)), 1):
        s, f = (replace(c, values=np.linspace(n, n + 1.0, length)) for c in (S, G56))
        tables[length, count] = Table(str(n), "t", (s, f))
        figures += [Figure(f"{n}.{k}", "f", s, (f,)) for k in range(count)]
    sheets = book(tables=[*tables.values()], figures=figures)
    for (length, count), table in tables.items():
        anchors = [chart.anchor for chart in sheets[f"{table.number} t"]._charts]
        boxes = [(a._from.col, a._from.row, a.to.col, a.to.row) for a in anchors]
        told = f"{count} charts of {length} rows"
        assert len(boxes) == count, told
        assert all(left >= 2 or top >= 4 + length for left, top, _, _ in boxes), f"{told}: over the numbers"
        assert all(left >= 1 and top >= 4 for left, top, _, _ in boxes), f"{told}: over the frozen part"
        for n, (left, top, right, low) in enumerate(boxes):
            for left2, top2, right2, low2 in boxes[:n]:
                assert left >= right2 or left2 >= right or top >= low2 or top2 >= low, told


def test_pages_of_a_long_table_end_between_charts() -> None:
    s, f = (replace(c, values=np.linspace(1.0, 2.0, 200)) for c in (S, G56))
    sheet = book(tables=[Table("1", "t", (s, f))], figures=[Figure(str(n), "f", s, (f,)) for n in range(5)])["1 t"]
    breaks = [row.id for row in sheet.row_breaks.brk]
    assert breaks
    for anchor in (chart.anchor for chart in sheet._charts):
        assert not any(anchor._from.row < row < anchor.to.row for row in breaks)


@examples(25)
@given(st.lists(st.floats(), min_size=1, max_size=5))
def test_axes_enclose_the_data_in_whole_steps(values: list[float]) -> None:
    line = replace(G56, values=np.array(values))
    over = replace(S, values=np.arange(float(len(values))))
    content = data(tables=[Table("1", "t", (over, line))], figures=[Figure("1", "f", over, (line,))])
    with ZipFile(BytesIO(content)) as file:
        _, axis = re.findall("<c:valAx>.*?</c:valAx>", file.read("xl/charts/chart1.xml").decode())
    low, high, step = (float(re.findall(f'<c:{part} val="(.*?)"', axis)[0]) for part in ("min", "max", "majorUnit"))
    shown = [v for v in values if abs(v) < 1e307]
    slack = 1e-9 * (high - low)
    assert all(low - slack <= v <= high + slack for v in shown)
    assert isclose((high - low) / step, round((high - low) / step), rel_tol=1e-9)
    assert 1 <= round((high - low) / step) <= 8


def test_axis_of_lengths_does_not_start_at_zero() -> None:
    (chart,) = book()["4.1 Lifting capacity"]._charts
    scale = chart.x_axis.scaling
    assert (scale.min, scale.max, chart.x_axis.majorUnit) == (0.4, 0.7, 0.05)


@pytest.mark.parametrize("text", HOSTILE)
def test_text_stays_text_everywhere(text: str) -> None:
    """No text becomes a formula, a link, a number or broken XML, and none is lost."""
    column = replace(S, symbol=text, unit=text, meaning=text)
    figure = Figure(text, text, column, (column, G56), ((text, 0.5),))
    content = writing.workbook(
        text,
        inputs=[InputRow(text, text, text, text, text), InputRow(text, 1, text, text)],
        found=[FOUND._replace(symbol=text, unit=text, meaning=text, residual_unit=text, other_roots=text)],
        tables=[Table(text, text, (column, G56), text), Table(text, text, (S,), text)],
        figures=[figure, replace(figure, lines=(P_GC,))],
        checks=[Check(text, 1.0, 2.0, text, text)],
    )
    opened = written_cells.read(BytesIO(content))
    with ZipFile(BytesIO(content)) as file:
        parts = {name: file.read(name).decode() for name in file.namelist()}
        links = {title: re.findall("<hyperlink .*?>", sheet) for title, sheet in written_cells.sheets(file)}
    for part in parts.values():
        ElementTree.fromstring(part)
    front, *others = opened
    assert not [(title, at) for title in others for at, (formula, _) in opened[title].items() if formula]
    assert not [link for title in others for link in links[title]] and not [x for x in links[front] if "r:id" in x]
    formulas = [formula for formula, _ in opened[front].values() if formula]
    assert all(re.match(r"=('.*'!\$A\$1$|\w+!\$|IF\(COUNT|IFERROR)", formula) for formula in formulas)
    cells = [re.sub("[\x01\x0b\x7f\ud800\uffff]", "�", t) for t in (text, text, units.shown(text), text)]
    row = 4 if text else 3  # an empty section has no heading
    values = [opened["Inputs"].get((row, column), ("", None))[1] for column in range(1, 5)]
    assert [escaped(str(value or "")) for value in values] == [" " * text.startswith("<r>") + cell for cell in cells]
    assert not [name for name in parts if "externalLink" in name]
    charts = [part for name, part in parts.items() if name.startswith("xl/charts/chart")]
    formulas = {html.unescape(f) for xml in charts for f in re.findall("<c:f>(.*?)</c:f>", xml)}
    for formula in formulas:
        name, cells = formula.rsplit("!", 1)
        assert re.sub("^'(.*)'$", r"\1", name).replace("''", "'") in opened
        assert re.fullmatch(r"\$[A-Z]+\$\d+(:\$[A-Z]+\$\d+)?", cells)


def escaped(text: str) -> str:
    """Excel's own reading of ``_x005F_``, which openpyxl leaves as it is."""
    return text.replace("_x005F_", "_")


@examples(25)
@given(st.lists(st.tuples(st.text(max_size=6), st.text(max_size=50)), min_size=1, max_size=4))
def test_sheet_names_are_what_excel_accepts(titles: list[tuple[str, str]]) -> None:
    tables = [Table(number, title, (S,)) for number, title in [*titles, *titles]]
    with ZipFile(BytesIO(data(tables=tables, figures=[]))) as file:
        names = [name for name, _ in written_cells.sheets(file)]
    assert len(names) == len(tables) + 4
    assert len({name.lower() for name in names}) == len(names)
    for name in names:
        assert 0 < len(name.encode("utf-16-le")) <= 62
        assert not set(name) & set("[]:*?/\\")
        assert name[0] != "'" != name[-1]


def test_long_sheet_name_ends_with_a_whole_word() -> None:
    title = Table("3.1", "Ratios and velocity analogues of the links", (S,))
    assert "3.1 Ratios and velocity" in book(tables=[title], figures=[]).sheetnames


@pytest.mark.parametrize(
    ("title", "name"),
    [
        ("Reduced areas (sheets and stringers)", "3.1 Reduced areas"),
        ("Forces and stresses in the flanges", "3.1 Forces and stresses"),
        ("Check by the instant centre of the coupler", "3.1 Check by the instant centre"),
        ("Iteration - of the neutral axis", "3.1 Iteration - of the neutral"),
        ("Points, of all the mechanism's links", "3.1 Points"),
        ("Sums (a (b) and what is behind it)", "3.1 Sums"),
        ("Unabbreviatedcompoundword" * 2, "3.1"),
    ],
)
def test_sheet_name_ends_with_a_word_that_says_something(title: str, name: str) -> None:
    assert name in book(tables=[Table("3.1", title, (S,))], figures=[]).sheetnames


def test_sheets_of_one_long_title_end_alike() -> None:
    made = Book("t")
    names = [made.name("Neutral axis of the whole joint (appendix 3)", " fields") for _ in range(3)]
    assert names == ["Neutral axis fields", "Neutral axis fields (2)", "Neutral axis fields (3)"]


def test_same_input_gives_the_same_bytes() -> None:
    """On one machine, with the same versions."""
    first = data()
    assert first == data()
    with ZipFile(BytesIO(first)) as file:
        assert {info.date_time for info in file.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    properties = load_workbook(BytesIO(first)).properties
    assert properties.created == properties.modified == datetime(2000, 1, 1)
    assert properties.title == "Tractor hitch"


def test_a_long_workbook_tells_how_much_of_it_is_written() -> None:
    """Of the work with a sheet, putting its cells is the smaller part."""
    seen: list[tuple[int, int]] = []
    data(tables=[TABLE, replace(TABLE, number="4.2")], done=lambda *step: seen.append(step))
    assert [behind for behind, _ in seen] == [1, 2] and {count for _, count in seen} == {2 * writing._PACKED}


def test_workbook_of_nothing_opens() -> None:
    empty = writing.workbook("t", inputs=[], found=[], tables=[], figures=[], checks=[])
    assert load_workbook(BytesIO(empty)).sheetnames == ["Front", "Inputs", "Checks"]


def test_libreoffice_reads_every_cell_back(soffice: str, tmp_path: Path) -> None:
    """Recalculated and saved by LibreOffice, the workbook has the same values, errors, texts and charts."""
    hostile = Table("9", "Hostile", tuple(replace(S, symbol=text) for text in HOSTILE if text.isprintable() and text))
    save(data(tables=[TABLE, hostile]), tmp_path / "hitch.xlsx")
    profile, out = (tmp_path / "profile").as_uri(), tmp_path / "out"
    options = [f"-env:UserInstallation={profile}", "--headless", "--convert-to", "xlsx:Calc MS Excel 2007 XML"]
    command = [soffice, *options, "--outdir", str(out), str(tmp_path / "hitch.xlsx")]
    subprocess.run(command, check=True, capture_output=True, timeout=WITHIN)
    ours, theirs = (load_workbook(p / "hitch.xlsx", data_only=True) for p in (tmp_path, out))
    assert theirs.sheetnames == ours.sheetnames
    for sheet in ours:
        for row in sheet:
            for cell in row:
                back = theirs[sheet.title][cell.coordinate].value
                # LibreOffice saves 15 digits.
                same = isclose(back, cell.value, rel_tol=1e-14) if isinstance(cell.value, float) else back == cell.value
                assert same, f"{sheet.title}!{cell.coordinate}: {cell.value!r} became {back!r}"
    assert len(theirs["4.1 Lifting capacity"]._charts) == 1
