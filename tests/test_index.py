"""The index of a worksheet: numbers of printed formulas, tables, figures, programs and errata lead to their lines."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from zipfile import ZipFile

import pytest
import written_cells
from as_script import as_launched
from conftest import until
from written_cells import Values

from mechsheet import evaluate
from mechsheet.worksheet import source
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.index import Entry, Index, numbers, of_cells, of_worksheet

WORKSHEETS = Path(__file__).resolve().parents[1] / "worksheets"
EXPORTS = WORKSHEETS.with_name("exports")
CELLS = (
    "mo.md('''\n## 4 Group (4, 5), rod (2, 3) (programs SR1, SR2, figure 1.3)\n\n### 4.1 No name in the document\n''')",
    "b = 2 * a  # [N] (1.10), (1.2) force\n"
    "a_printed = g.c + 1  # [N] (1.2) as printed (erratum)\n"
    "free = 1 + g.c  # [N] of (1.4), which is not its number\n"
    "turn = lambda x: b * x  # [N] (1.3)-(1.5)\n",
    "table_1 = table('1', 'Forces', b)\n"
    "typeset(table_1, caption('7.1', f'Crank (figure 1.6), at {g.c}'), caption('7.2', f'Scheme, at {g.c}'))\n",
)


def made(*texts: str) -> Index:
    cells = source.of_texts(tuple((text, f"cell {n}") for n, text in enumerate(texts)))
    return of_cells(cells, cells)


@pytest.mark.parametrize(
    ("printed", "each"),
    [
        ("", []),
        ("(7)", ["(7)"]),
        ("(1.26), (1.3)", ["(1.26)", "(1.3)"]),
        ("(2.3)-(2.5), (2.8a)", ["(2.3)", "(2.4)", "(2.5)", "(2.8a)"]),
        ("(9)–(11)", ["(9)", "(10)", "(11)"]),
        ("(3)-(5b)", ["(3)", "(4)", "(5b)"]),
    ],
)
def test_a_range_has_every_number_in_it(printed: str, each: list[str]) -> None:
    assert numbers(printed) == each


def test_formulas_stand_by_their_numbers_with_the_lines_that_have_them() -> None:
    found = [(entry.label, entry.name, entry.text, entry.line) for entry in made(*CELLS).formulas]
    assert found[:3] == [
        ("(1.2)", "b", "force", 1),
        ("(1.2)", "a_printed", "as printed (erratum)", 2),
        ("(1.3)", "turn", "", 4),
    ]
    assert [label for label, name, *_ in found if name == "turn"] == ["(1.3)", "(1.4)", "(1.5)"]
    assert found[-1][:2] == ("(1.10)", "b"), "ten is behind nine"
    assert "free" not in {name for _, name, *_ in found}


def test_titles_go_by_what_the_document_calls_them_and_by_their_own_numbers_otherwise() -> None:
    found = [(entry.label, entry.kind, entry.name, entry.text) for entry in made(*CELLS).titles]
    heading = "4 Group (4, 5), rod (2, 3) (programs SR1, SR2, figure 1.3)"
    assert found == [
        ("program SR1", "heading", "", heading),
        ("program SR2", "heading", "", heading),
        ("figure 1.3", "heading", "", heading),
        ("table 1", "table", "1", "Forces"),
        ("figure 1.6", "figure", "7.1", "Crank"),
        ("figure 7.2", "figure", "7.2", "Scheme"),
    ]


def test_errata_are_the_lines_that_say_so() -> None:
    assert made(*CELLS).errata == (Entry("(1.2)", "line", "a_printed", "as printed", 2),)


def test_a_line_whose_units_do_not_match_its_names_is_named() -> None:
    with pytest.raises(SheetError, match="2 names need 2 units"):
        made("a, b = 1, 2  # [m] (1.2) both")


# --- command -----------------------------------------------------------------------------------------------------


def command(*arguments: str | Path) -> tuple[int, str, str]:
    run = as_launched(*arguments)
    return run.returncode, run.stdout, run.stderr


def test_command_prints_the_line_of_every_formula() -> None:
    code, out, err = command("index", "kinetostatics")
    assert (code, err) == (0, "")
    lines = (WORKSHEETS / "kinetostatics.py").read_text(encoding="utf-8").splitlines()
    listed = re.findall(r"^  (\(1\.\d+\)) +(\w+) +line (\d+)", out.partition("tables, figures")[0], re.MULTILINE)
    assert {label for label, *_ in listed} == {f"(1.{n})" for n in range(1, 60)}
    assert all(f" {name} = " in lines[int(number) - 1] for _, name, number in listed)
    assert re.search(r"^errata:\n  \(1\.26\) +r_45_printed +line \d+ +left by the line as printed", out, re.MULTILINE)


def test_a_worksheet_without_numbers_of_formulas_says_so_in_one_line() -> None:
    code, out, _ = command("index", "hitch")
    assert code == 0
    assert out.startswith("formulas: none\ntables, figures, programs:\n")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((), "mechsheet: index needs a worksheet: give a file or one of "),
        (("kinetostatic",), "mechsheet: no worksheet kinetostatic: did you mean kinetostatics? "),
        (("kinetostatics", "(1.26)"), "error: argument '(1.26)': index takes a worksheet and nothing else"),
    ],
)
def test_what_is_wrong_with_the_command_is_one_line(arguments: tuple[str, ...], says: str) -> None:
    code, out, err = command("index", *arguments)
    assert (code != 0, out, err.count("\n")) == (True, "", 1)
    assert err.startswith(says)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("import marimo\napp = marimo.App()\n", "has no number of a printed formula, no table, no figure and no err"),
        ("import marimo\napp = (\n", "line 2, app = (: "),
        ("import marimo\napp = marimo.App()\n\n\n@app.cell\ndef c():\n    a, b = 1, 2  # [m]\n    return\n", "need 2"),
    ],
)
def test_a_worksheet_that_has_nothing_or_cannot_be_read_is_one_line(text: str, says: str, tmp_path: Path) -> None:
    path = tmp_path / "lever.py"
    path.write_text(text, encoding="utf-8")
    code, out, err = command("index", path)
    assert (code, out, err.count("\n")) == (1, "", 1)
    assert says in err


# --- workbook and page -------------------------------------------------------------------------------------------


def test_sheet_leads_to_the_cell_of_the_line() -> None:
    """Of the exported workbook, which another test holds up to date."""
    path = EXPORTS / "kinetostatics.xlsx"
    with ZipFile(path) as file:
        index = next(text for title, text in written_cells.sheets(file) if title == "Index")
    book = Values(path)
    places = [(place, unescape(at)) for place, at in re.findall(r'<hyperlink ref="(\w+)" location="(.*?)"', index)]
    shown = {cell.coordinate: cell.value for row in book["Index"].iter_rows() for cell in row if cell.value is not None}
    linked = [(shown.get(re.sub("[A-Z]+", "A", place)), shown[place], at) for place, at in places]
    assert {label for label, *_ in linked} >= {f"(1.{n})" for n in range(1, 60)}
    (at,) = {at for label, name, at in linked if (label, name) == ("(1.11)", "R12")}
    sheet, address = re.fullmatch(r"'(.*)'!(.*)", at).groups()
    R12 = evaluate(WORKSHEETS / "kinetostatics.py", want=["R12"])["R12"]
    assert book[sheet][address.replace("$", "")].value == pytest.approx(R12[0], rel=1e-12)
    for _, _, at in linked:
        name = re.match(r"'?(.*?)'?!", at)[1].replace("''", "'")
        assert name in book.sheetnames


def test_search_and_index_lead_to_the_places_of_the_page(left_open) -> None:
    page = left_open(WORKSHEETS / "kinetostatics.py", "checks pass")
    fold = page.locator(".ms-index")
    page.get_by_text("Excel workbook").wait_for()
    assert page.evaluate("window.find('(1.27)')"), "the browser's own search: the number stands at the end of its line"
    assert page.evaluate("getSelection().anchorNode.parentElement.closest('.ms-line').id") == "line-R34"
    assert (fold.locator("summary").text_content() or "").startswith("Index of the document: 59 formulas")
    targets = "links => links.map(a => a.getAttribute('href').slice(1))"
    many = f"links => ({targets})(links).filter(to => document.querySelectorAll(`[id='${{to}}']`).length != 1)"
    assert fold.locator("a").evaluate_all(many) == []
    assert fold.get_by_text("program SR2").count() == 1
    fold.locator("summary").click()
    link = fold.locator("a[href='#line-h76']").first
    link.click()
    place = page.locator("#line-h76")

    def in_sight() -> bool:
        box = place.bounding_box()
        return box is not None and -10 <= box["y"] <= page.viewport_size["height"]

    until(page, in_sight, "the line is not in sight")
    assert "(1.44)–(1.46)" in (place.text_content() or "")


# --- the documents' own lists ------------------------------------------------------------------------------------

# What each document numbers or names, read from its pages: formulas, then tables, figures, programs and appendices.
PRINTED: dict[str, tuple[list[str], list[str]]] = {
    "hitch": (
        [],
        [
            *("table 2.1", "table 2.2", "table 3.1", "table 4.1", "table 5.1", "table 6.1"),
            *("figure 2.1", "figure 3.1", "figure 3.2", "figure 4.1", "figure 4.2", "figure 4.3"),
            *("figure 5.1", "figure 5.2", "figure 5.3", "figure 5.4", "figure 6.1", "figure 6.2"),
        ],
    ),
    "joint": ([], ["appendix 1", "appendix 2", "appendix 3", "table 1", "table 2"]),
    "kinetostatics": (
        [f"(1.{n})" for n in range(1, 60)],
        [
            *(f"figure 1.{n}" for n in range(1, 7)),
            *(f"program {name}" for name in ("SR1", "SR2", "SR3", "SRWL1", "SRWL2", "UGL2", "UGL3", "UGL4")),
        ],
    ),
    "landing_gear": (
        [f"({n})" for n in range(1, 29)],
        ["figure 1", "figure 2", "figure 3", "appendix 1", "appendix 2"],
    ),
    "slotted_link": (["(2.33)", "(2.37)", "(2.38)"], ["program of page 39", "table of page 39"]),
}


@pytest.mark.parametrize("name", sorted(PRINTED))
def test_nothing_that_a_document_numbers_is_without_a_line(name: str) -> None:
    index = of_worksheet({"__file__": str(WORKSHEETS / f"{name}.py")})
    formulas, others = PRINTED[name]
    assert set(index.numbers) == set(formulas)
    assert sorted(set(others) - {entry.label for entry in index.titles}) == []
