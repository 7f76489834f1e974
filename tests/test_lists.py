"""Lists and tables of numbers as inputs, wherever an input is given or shown."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from openpyxl import load_workbook
from test_kinds import script
from test_recalculation import cell_of, disagreements, edit
from written_cells import Values

from mechsheet import evaluate, grid, load, sweep
from mechsheet.html import write
from mechsheet.page.values import html
from mechsheet.recording.dimensions import mismatches
from mechsheet.recording.record import record
from mechsheet.run import arguments
from mechsheet.workbook import reading
from mechsheet.worksheet import inputs
from mechsheet.worksheet.errors import SheetError

SHEET = '''import marimo

app = marimo.App()

with app.setup:
    from numpy import abs, sum

    from mechsheet import ask, export, inputs, read, table, typeset
    from mechsheet.units import cm, kN, mm

    @inputs
    class Stringer:
        A: float  # [cm**2] area; > 0
        y: float  # [cm] level; < y_top
        y_top: float  # [cm] greatest level


@app.class_definition
@inputs
class Section:
    # 1.1 Loads
    F: list[float] = [10 * kN, -4 * kN, 2.5 * kN]  # [kN] forces; < F_max
    F_max: float = 50 * kN  # [kN] greatest force; > 0
    # 1.2 Section
    stringers: list[Stringer] = [  # rows from the top
        Stringer(1 * cm**2, 25 * cm, 30 * cm),
        Stringer(0.5 * cm**2, -25 * cm, 30 * cm),
    ]  # stringers of the section

    """Inputs."""


@app.cell
def form():
    form = ask(Section)
    return (form,)


@app.cell
def given(form):
    g = read(Section, form)
    return (g,)


@app.cell
def section(g):
    s = g.stringers
    A = sum(s.A)  # [cm**2] area
    y_c = sum(s.A * s.y) / A  # [cm] centroid
    I_c = sum(s.A * (s.y - y_c) ** 2)  # [cm**4] second moment of area
    sigma = g.F / A  # [MPa] stress
    share = g.stringers.A / A  # [-] share of the area
    most = abs(sigma).max()  # [MPa] greatest stress
    typeset()
    return A, I_c, most, share, sigma, y_c


@app.cell
def results(A, I_c, g, most, share, sigma, y_c):
    F = g.F  # [kN] force
    table_1 = table("1", "Stresses", F, sigma, A, y_c, I_c, most)
    table_2 = table("2", "Stringers", share)
    return table_1, table_2


@app.cell
def workbook():
    export("Section", globals())
    return


if __name__ == "__main__":
    app.run()
'''


@pytest.fixture(scope="module")
def section(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "section.py"
    path.write_text(SHEET, encoding="utf-8")
    return path


ROWS = [(2.0, 20.0, 30.0), (1.0, 5.0, 30.0), (1.0, -10.0, 30.0)]
WAYS: list[Any] = [
    "2; 20; 30 | 1; 5; 30 | 1; -10; 30",
    "2\t20\t30\n1\t5\t30\n1\t-10\t30\n",
    "2,0; 0,2 m; 300 mm\n1; 5; 30\n1 cm**2; −10; 30;",
    ROWS,
    [{"A": 2, "y": "20", "y_top": 30}, {"y": 5, "A": "1,0", "y_top": 30}, [1, -10, 30]],
    {"A": [2, 1, 1], "y": [20, 5, -10], "y_top": [30, 30, 30]},
    pd.DataFrame(ROWS, columns=["A", "y", "y_top"]),
    np.array(ROWS),
]


@pytest.mark.parametrize("way", WAYS, ids=range(len(WAYS)))
def test_a_table_is_given_in_many_ways(section: Path, way: Any) -> None:
    found = evaluate(section, ["A", "y_c", "I_c"], stringers=way)
    areas, levels = np.array([2, 1, 1]) * 1e-4, np.array([0.2, 0.05, -0.1])
    y_c = (areas * levels).sum() / areas.sum()
    assert found["A"] == pytest.approx(4e-4, rel=1e-14)
    assert found["y_c"] == pytest.approx(y_c, rel=1e-14)
    assert found["I_c"] == pytest.approx((areas * (levels - y_c) ** 2).sum(), rel=1e-14)


@pytest.mark.parametrize(
    "way", ["12; -5 kN; 0,5", "12\n-5\n500 N", [12, "-5", 0.5], np.array([12, -5, 0.5]), "12, ; -5; 0.5;"]
)
def test_a_list_is_given_in_many_ways(section: Path, way: Any) -> None:
    assert evaluate(section, ["sigma"], F=way)["sigma"] == pytest.approx(
        np.array([12, -5, 0.5]) * 1e3 / 1.5e-4, rel=1e-14
    )


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"F": "1; heavy; 3"}, "forces F (2) = 'heavy' kN is no number"),
        ({"F": "1 2 3"}, "forces F (1) = '1 2 3' kN is no number; those of a list stand apart by ;"),
        ({"F": "[1,2,3]"}, "forces F (1) = '[1,2,3]' kN is no number; those of a list stand apart by ;"),
        ({"F": "1;; 3"}, "forces F (2) = '' kN is no number"),
        ({"F": ""}, "forces F must have 1 to 10000 rows, not 0"),
        ({"F": []}, "forces F must have 1 to 10000 rows, not 0"),
        ({"F": [1] * 10_001}, "forces F must have 1 to 10000 rows, not 10001"),
        ({"F": [1, "2 MPa"]}, "forces F (2) = '2 MPa': MPa does not measure kN"),
        ({"F": [1, float("nan")]}, "forces F (2) = nan kN is no number"),
        ({"F": [1, 60]}, "forces F (2) = 60.0 kN must be < F_max = 50.0 kN"),
        ({"F": [1, 1e300]}, "forces F (2) = 1e+300 kN must be at most 1e+60 in size"),
        ({"F": 3}, 'forces F = 3 kN must be a list such as "1; 2,5; 3"'),
        ({"F": None}, 'forces F = None kN must be a list such as "1; 2,5; 3"'),
        ({"F": [[1, 2]]}, "forces F (1) = [1, 2] kN is no number"),
        ({"F_max": 5}, "forces F (1) = 10.0 kN must be < F_max = 5.0 kN"),
        ({"stringers": "1; 2"}, "stringers of the section stringers (1) = '1; 2' must have the columns A, y, y_top"),
        ({"stringers": "1 |"}, "stringers of the section stringers (1) = '1' must have the columns A, y, y_top apart"),
        ({"stringers": "0; 2; 30"}, "area stringers.A (1) = 0.0 cm² must be positive"),
        ({"stringers": "1; 2; 30 | 1; 31; 30"}, "level stringers.y (2) = 31.0 cm must be < stringers.y_top = 30.0 cm"),
        ({"stringers": "1; 2; 30 | 1; x; 30"}, "level stringers.y (2) = 'x' cm is no number"),
        ({"stringers": [{"A": 1, "y": 2}]}, "stringers of the section stringers (1) must have the columns"),
        ({"stringers": {"A": [1], "y": [2, 3], "y_top": [3]}}, "stringers of the section stringers: columns must be"),
        ({"stringers": "other.csv; 1"}, "stringers of the section stringers (1) = 'other.csv; 1' must have"),
        ({"stringers": 5}, "stringers of the section stringers = 5 must be rows, or columns by name"),
        ({"stringers": [5]}, "stringers of the section stringers (1) = 5 must have the columns A, y, y_top"),
    ],
)  # fmt: skip
def test_bad_input_is_one_line(section: Path, given: dict[str, Any], message: str) -> None:
    with pytest.raises(SheetError) as error:
        evaluate(section, ["A", "sigma"], **given)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)


def test_the_default_is_held_to_the_last_bit_and_all_is_read_back(section: Path) -> None:
    sheet = load(section)
    default: Any = sheet.inputs()
    fields = inputs.declared(sheet.inputs)
    assert inputs.build(sheet.inputs, {f.name: f.text(getattr(default, f.name)) for f in fields}) == default
    g = inputs.build(sheet.inputs, {"F": [1 / 3, 0.1, 7e-5], "stringers": [(1 / 7, 1 / 3, 30)]})
    assert inputs.build(sheet.inputs, dict((f.name, v) for f, v in inputs.Used(g).rows())) == g
    assert inputs.Used(g).changed == {"F", "stringers"} and g != default and hash(default) == hash(sheet.inputs())
    with pytest.raises(ValueError, match="read-only"):
        default.F[0] = 1.0


def test_on_paper_every_number_stands_with_its_minus(section: Path) -> None:
    sheet = load(section)
    g = inputs.build(sheet.inputs, {"F": [-x for x in range(14)], "F_max": 50, "stringers": [(1, -2.5, 30)] * 3})
    paper = html(inputs.Used(g)).partition('<table class="ms-print"')[2]
    assert "; ".join(f"−{x}" for x in range(14)).replace("−0", "0") in paper
    assert paper.count("<td>−2.5</td>") == 3 and "<i>y</i> [cm]" in paper and "<td>-" not in paper


def test_a_long_list_is_listed_by_its_ends(section: Path) -> None:
    (field, _), *_ = inputs.Used(load(section).inputs()).rows()
    assert field.brief(np.arange(12.0) * 1e3) == "0; 1; 2; 3; 4; 5; 6; 7; 8; 9; 10; 11"
    assert field.brief(np.arange(13.0) * 1e3) == "0; 1; 2; ..; 12 (13 rows)"


def test_scenes_and_arguments_give_lists_and_tables(section: Path, tmp_path: Path) -> None:
    scene = tmp_path / "other.toml"
    scene.write_text('want = ["A", "sigma"]\n[inputs]\nF = [1, "2,5"]\n[[inputs.stringers]]\nA = 2\ny = 3\ny_top = 9\n')
    answer = script(section, f"--scene={scene}")
    assert answer.returncode == 0, answer.stderr
    assert "A = 2 cm²" in answer.stdout and "5..12.5 MPa" in answer.stdout
    fields = inputs.declared(load(section).inputs)
    assert inputs.build(load(section).inputs, arguments.load(scene, fields).inputs).F.tolist() == [1000.0, 2500.0]
    told = script(section, "--F=27,500; 3", "--stringers=1; 2; 30 | 1; 3; 30", f"--out={tmp_path}")
    assert told.returncode == 0, told.stderr
    assert "F (1) = 27.5 kN, read with a decimal comma" in told.stdout


def test_sweeps_vary_lists_and_tables(section: Path) -> None:
    swept = sweep(section, ["most", "A"], {"F": ["1; 2; 3", [4, 5], "x"], "F_max": [50, 50, 50]})
    assert swept["most"][:2].tolist() == pytest.approx([3e3 / 1.5e-4, 5e3 / 1.5e-4], rel=1e-14)
    assert swept.reasons.tolist() == ["", "", "forces F (1) = 'x' kN is no number"]
    limited = sweep(section, ["most"], {"F_max": [50, 5]})
    assert limited.reasons.tolist() == ["", "forces F (1) = 10.0 kN must be < F_max = 5.0 kN"]
    tables = sweep(section, ["A"], {"stringers": ["1; 2; 30", [[1, 2, 30], [3, 4, 30]]]})
    assert tables["A"].tolist() == pytest.approx([1e-4, 4e-4], rel=1e-14)
    frame = sweep(
        section, ["most"], {"F": ["1; 2,5; 3", "x"], "stringers": ["1; 2; 30 | 3; 4; 30", "1; 2; 30"]}
    ).frame()
    assert frame.iloc[0, 1:3].tolist() == ["1; 2.5; 3", "1; 2; 30 | 3; 4; 30"]  # each as it is read
    every = grid(F=[[1, 2], [4, 5]], stringers=["1; 2; 30", [{"A": 3, "y": 4, "y_top": 30}]], F_max=[50, 60])
    combined = sweep(section, ["most"], every)
    assert combined["most"].shape == (2, 2, 2) and combined.solved.all()
    assert combined["most"][1, 1, 0] == sweep(section, ["most"], {"F": ["4; 5"], "stringers": ["3; 4; 30"]})["most"][0]


def test_a_list_of_one_element_keeps_its_axis_in_sweeps(section: Path) -> None:
    for rows in (["3"], ["3", "5"], ["3", "5; 6"][:1] * 2):
        swept = sweep(section, ["sigma", "most"], {"F": rows})
        assert swept["sigma"].shape == (len(rows), 1) and swept["most"].shape == (len(rows),)
        assert swept["sigma"][:, 0] == pytest.approx(swept["most"], rel=1e-14)
    both = sweep(section, ["share"], grid(stringers=["1; 2; 30", [[2, 3, 30]]], F_max=[50, 60, 70]))
    assert both["share"].shape == (2, 3, 1) and (both["share"] == 1).all()


def test_a_list_of_one_element_is_written_and_read_as_a_longer_one(
    section: Path, tmp_path: Path, recalculated: Callable[[Path], Any]
) -> None:
    """Its line is that of the input itself: its one number stands there in place of a column."""
    assert script(section, "--F=30", "--proof", f"--out={tmp_path}").returncode == 0
    book = recalculated(tmp_path / "section.xlsx")
    lines = [
        row
        for sheet in book.worksheets
        for row in sheet.iter_rows(values_only=True)
        if row[0] == "F" and row[3] == "force"
    ]
    assert [row[1] for row in lines] == [30e3]


def test_rows_of_a_table_are_gone_through(section: Path) -> None:
    rows = load(section).inputs(F=np.array([1.0])).stringers
    assert len(rows) == 2 and [row.y for row in rows] == rows.y.tolist() == [0.25, -0.25]
    first, last = rows
    assert (first, last) == (rows[0], rows[-1]) and last.A == 0.5e-4
    assert rows[::-1].y.tolist() == rows[np.array([1, 0])].y.tolist() == [-0.25, 0.25]
    assert [len(rows[1:]), len(rows[rows.y > 0]), len(rows[5:])] == [1, 1, 0]
    with pytest.raises(IndexError, match="index 2 is out of bounds"):
        rows[2]


@pytest.mark.parametrize("column", ["first", "row", "columns", "count", "index"])
def test_a_column_may_have_any_name(column: str, section: Path, tmp_path: Path) -> None:
    path = tmp_path / "named.py"
    text = section.read_text(encoding="utf-8")
    path.write_text(re.sub(r"\bA: float", f"{column}: float", text.replace(".A", f".{column}")), encoding="utf-8")
    rows = load(path).inputs().stringers
    assert [getattr(row, column) for row in rows] == getattr(rows, column).tolist() and len(rows[1:]) == 1
    assert evaluate(path, ["A"])["A"] == evaluate(section, ["A"])["A"]


def test_sweeps_go_through_rows_of_each_variant(section: Path, tmp_path: Path) -> None:
    text = section.read_text(encoding="utf-8")
    line = "    A = sum(s.A)"
    assert text.count(line) == 1
    gone = tmp_path / "gone.py"
    gone.write_text(text.replace(line, "    A = sum([each.A for each in s])"), encoding="utf-8")
    for varied in ({"stringers": ["1; 2; 30", [[1, 2, 30], [3, 4, 30]]]}, {"F_max": [50, 60]}):
        np.testing.assert_array_equal(sweep(gone, ["A"], varied)["A"], sweep(section, ["A"], varied)["A"])


def test_units_are_followed_and_nothing_is_left_out(section: Path) -> None:
    assert mismatches(section) == []
    sheet = load(section)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    assert record({**names, "__file__": sheet.path}).gaps == []


CHANGES = {"F (2)": 6.5, "F_max": "60,5", "stringers.A (1)": 2, "stringers.y (2)": "-12,5"}


def test_the_workbook_follows_each_element(section: Path, tmp_path: Path, recalculated: Callable[[Path], Any]) -> None:
    assert script(section, f"--out={tmp_path}").returncode == 0
    path = edit(tmp_path / "section.xlsx", CHANGES, tmp_path / "edited.xlsx")
    sheet = load(section)
    read = reading.inputs(path, inputs.declared(sheet.inputs))
    changed = {"F": [10, 6.5, 2.5], "F_max": 60.5, "stringers": [(2, 25, 30), (0.5, -12.5, 30)]}
    assert inputs.build(sheet.inputs, read) == inputs.build(sheet.inputs, changed)
    given = ("--F=10; 6.5; 2.5", "--F_max=60.5", "--stringers=2; 25; 30 | 0.5; -12.5; 30")
    assert script(section, f"--out={tmp_path / 'own'}", *given).returncode == 0
    own = Values(tmp_path / "own" / "section.xlsx")
    assert not list(disagreements(recalculated(path), own))


@pytest.fixture(scope="module")
def exported(section: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("exported")
    assert script(section, f"--out={out}").returncode == 0
    return out / "section.xlsx"


def typed(exported: Path, to: Path, changes: dict[tuple[str, int], object]) -> Path:
    """The workbook with other cells of its input tables, by column and row; row 0 is the unit, -1 the heading."""
    book = load_workbook(exported)
    cells = {place: cell_of(book, *place) for place in changes}
    for place, cell in cells.items():
        cell.value = changes[place]
    book.save(to)
    return to


@pytest.mark.parametrize(
    ("changes", "given"),
    [
        ({("F", 4): 20}, {"F": [10, -4, 2.5, 20]}),
        ({("F", 4): "20000 N", ("F", 1): "0,5"}, {"F": [0.5, -4, 2.5, 20]}),
        ({("F", 0): "N"}, {"F": ["10 N", "-4 N", "2,5 N"]}),
        ({("F", 2): None}, {"F": [10, 2.5]}),
        ({("stringers.A", 5): 1, ("stringers.y", 5): -2, ("stringers.y_top", 5): 30},
         {"stringers": [(1, 25, 30), (0.5, -25, 30), (1, -2, 30)]}),
        ({("F", -3): "F", ("F", 1): 12}, {"F": [12, -4, 2.5]}),  # meant as it is called, or as another one is
        ({("F", -3): "stringers.A", ("stringers.A", -3): "F", ("F", 1): 12}, {"F": [12, -4, 2.5]}),
    ],
)  # fmt: skip
def test_rows_and_units_of_input_tables_are_read_as_they_are_typed(
    exported: Path, section: Path, tmp_path: Path, changes: dict[tuple[str, int], object], given: dict[str, Any]
) -> None:
    cls = load(section).inputs
    path = typed(exported, tmp_path / "typed.xlsx", changes)
    assert inputs.build(cls, reading.inputs(path, inputs.declared(cls))) == inputs.build(cls, given)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({("F", 2): "heavy"}, "sheet Input tables, cell B9: forces F (2) = 'heavy' kN is no number"),
        (
            {("F", 0): "MPa"},
            "cell B7: MPa is not the unit of F (1), which is kN: forces F (1) = '10 MPa': MPa does not",
        ),
        ({("F", 0): None}, "cell B7: an empty cell is not the unit of F (1), which is kN"),
        ({("stringers.y", 2): None}, "cell E9: stringers.y (2): the value is missing"),
        ({("stringers.y", -1): "y"}, "stringers of the section stringers must have the columns A, y, y_top; it has"),
        ({("stringers.y", -1): "stringers.A"}, "cell E6: stringers.A stands in D6 already"),
        ({("F", 5): "=SUM(C8:C10)"}, "12: =SUM(C8:C10) stands below an empty row: take it out, or fill the rows of F"),
        ({("F", 3): "=SUM(B$7:B9)"}, "cell B10: =SUM(B$7:B9) is of the rows above: take it out, or give its number"),
        ({("stringers.y", 3): "=AVERAGE(E8:E9)/2"}, "cell E10: =AVERAGE(E8:E9)/2 is"),
        ({("F", 2): "=2*5"}, "cell B9: F (2): the formula =2*5 has no value; open and save the file"),
        ({("F", -1): "forces", ("F", 1): 12}, "sheet Input tables has no column F: give it its name back, or delete"),
    ],
)
def test_what_cannot_be_read_of_input_tables_is_told_at_its_cell(
    exported: Path, section: Path, tmp_path: Path, changes: dict[tuple[str, int], object], message: str
) -> None:
    path = typed(exported, tmp_path / "typed.xlsx", changes)
    with pytest.raises(SheetError) as error:
        reading.inputs(path, inputs.declared(load(section).inputs))
    assert message in str(error.value) and "\n" not in str(error.value)


def test_a_sheet_of_tables_with_another_name_is_missed(exported: Path, section: Path, tmp_path: Path) -> None:
    """What was typed there was left out of the scene without a word; a table whose row is gone too is meant so."""
    declared, path = inputs.declared(load(section).inputs), tmp_path / "typed.xlsx"
    book = load_workbook(exported)
    book["Input tables"].title = "Lasten"
    book.save(path)
    with pytest.raises(SheetError, match=r"typed\.xlsx has no sheet Input tables: give it its name back"):
        reading.inputs(path, declared)
    told = {row[0].value: row[0] for row in book["Inputs"].iter_rows(min_row=3)}
    for name in ("F", "stringers"):
        told[name].value = None
    book.save(path)
    assert not {"F", "stringers"} & reading.inputs(path, declared).keys()


def test_the_sheet_of_the_inputs_tells_where_its_tables_are(exported: Path, section: Path, tmp_path: Path) -> None:
    book = load_workbook(exported)
    told = {row[0].value: row for row in book["Inputs"].iter_rows(min_row=3)}
    assert told["stringers"][4].value == "2 rows on the sheet Input tables"
    assert "'Input tables'!A1" in told["stringers"][4].hyperlink.location
    told["F"][1].value = "1; 2; 3"
    book.save(tmp_path / "typed.xlsx")
    with pytest.raises(SheetError, match="the rows of F stand on the sheet Input tables"):
        reading.inputs(tmp_path / "typed.xlsx", inputs.declared(load(section).inputs))


def test_cells_of_input_tables_refuse_what_the_limits_do_not_allow(exported: Path) -> None:
    """In rows that are added too."""
    book = load_workbook(exported)
    validations = book["Input tables"].data_validations.dataValidation
    rules = {str(rule.sqref): re.fullmatch(r"_xlfn.IFNA\((.*),FALSE\)", rule.formula1)[1] for rule in validations}
    F_max = next(row[0].row for row in book["Inputs"].iter_rows() if row[0].value == "F_max")
    assert rules == {
        "B8:B10007": f"IF(ISTEXT($B8),TRUE,AND(ISNUMBER($B8),$B8<Inputs!$I${F_max}))",
        "D8:D10007": "IF(ISTEXT($D8),TRUE,AND(ISNUMBER($D8),$D8>=1E-60))",
        "E8:E10007": "IF(ISTEXT($E8),TRUE,AND(ISNUMBER($E8),OR(ISTEXT($F8),$E8<$F8)))",
        "F8:F10007": "IF(ISTEXT($F8),TRUE,AND(ISNUMBER($F8)))",
    }


def test_a_row_added_or_outside_its_limits_has_no_number_in_the_workbook(
    exported: Path, tmp_path: Path, recalculated: Callable[[Path], Any]
) -> None:
    """Of a list with another number of rows nothing is shown; of a limit that does not hold only what rests on it."""
    added = recalculated(typed(exported, tmp_path / "added.xlsx", {("F", 4): 20}))
    assert {row[0].value for row in added["1 Stresses"].iter_rows(min_row=5, max_row=7)} == {"#N/A"}
    assert {row[0].value for row in added["2 Stringers"].iter_rows(min_row=5, max_row=6)} != {"#N/A"}
    verdicts = {row[0].value: row[4].value for row in added["Checks"].iter_rows(min_row=3)}
    assert verdicts["inputs within their limits"] == "FAIL"
    above = recalculated(typed(exported, tmp_path / "above.xlsx", {("F", 2): 51, ("stringers.y", 1): "0,3 m"}))
    assert [row[0].value for row in above["1 Stresses"].iter_rows(min_row=5, max_row=7)] == [10, "#N/A", 2.5]


def test_a_row_outside_its_limits_is_told_by_its_value_and_limit(tmp_path: Path) -> None:
    """A class of rows has no values of its own: to look at them ended with Python's words about the class."""
    path = tmp_path / "rows.py"
    path.write_text(SHEET.replace("Stringer(1 * cm**2", "Stringer(-1 * cm**2"), encoding="utf-8")
    with pytest.raises(SheetError, match=r"area A = -1\.0 cm² must be positive"):
        load(path)


def test_on_paper_a_tolerance_stands_behind_the_meaning() -> None:
    """Limits of inputs are of the fields alone; with its tolerances a result is of them."""
    sheet = load(Path(__file__).parents[1] / "worksheets" / "examples" / "bucket.py")
    whole = write.page(sheet, sheet.inputs())
    for paper in (html(inputs.Used(sheet.inputs())), whole):
        _, _, rows = paper.partition('<table class="ms-print"')
        assert "hinge of the cylinder, along the arm ±&nbsp;0.002&nbsp;m</td>" in rows
