"""Tables and figures read their columns from the lines that define them."""

import re
from io import BytesIO

import numpy as np
import pytest
from cells import run
from openpyxl import load_workbook
from own_worksheet import own, recorded

from mechsheet.document.markup import HTML
from mechsheet.page.values import html
from mechsheet.run import report
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.numbers import in_any_unit
from mechsheet.worksheet.results import quantities
from mechsheet.worksheet.table import Column, Table, figure, table

CELL = """
import numpy as np
from mechsheet import typeset
S = np.array([0.42, 0.67])  # [m] stroke
P23_S = S * (1 + 2j)  # [m] pin
R56 = S * (3000 + 4000j)  # [kN] reaction
dRa = 1 * 0.2381  # [%] share
typeset()
"""


@pytest.fixture
def names():
    return run("from mechsheet import figure, table", run(CELL))


def test_a_table_has_no_rows_where_a_condition_holds_for_none(tmp_path):
    """It has its heads on the page, in the workbook, which says so, and in the page in one file; a figure its axes."""
    lines = "x_w = x[x > 100.0]  # [N] those above\ntable_2 = table('2', 'Above', x_w)\n"
    lines += "figure_2 = figure('2', 'Above', x_w, x_w)\ntypeset(table_2, figure_2)"
    sheet = own(tmp_path, lines)
    names, _ = recorded(sheet)
    assert len(names["table_2"].frame()) == 0
    assert "<tbody></tbody>" in html(names["table_2"])
    data = report.workbook("", {**names, "__file__": sheet.path}, {})
    (cells,) = (each for each in load_workbook(BytesIO(data)) if "Above" in each.title)
    assert in_any_unit(names["x_w"])("N", HTML) == "none"
    note = "No rows for the exported inputs; for others the cells tell none."
    assert [cells[at].value for at in ("A2", "A3", "A5")] == [note, "xw", None]


@pytest.mark.parametrize(
    ("shown", "says"),
    [
        ('table("1", "T", S, P23_S)', r"column P23_S: P23_S is a point or a force: take P23_S.real and P23_S.imag"),
        ('figure("1", "T", P23_S)', "column P23_S: P23_S is a point or a force"),
        ('table("1", "T", grade)', "column grade: grade is neither a number nor a column of texts"),
        ('table("1", "T", S, three, dRa)', "columns must be as long as each other, not 2 of S, 3 of three"),
        ('figure("1", "T", S)', "figure 1 needs at least 2 columns"),
        ('table("1", "T")', "table 1 needs at least 1 column$"),
    ],
)
def test_what_is_no_column_is_refused_where_it_is_given(names, shown, says):
    run('grade = "8.8"  # [-] grade\nthree = np.arange(3.0)  # [m] places', names)
    with pytest.raises(SheetError, match=f"^{says}"):
        run(f"t = {shown}", names)


def test_a_result_without_values_is_refused(names):
    with pytest.raises(SheetError, match=r"^S has no values$"):
        quantities("S", names | {"S": names["S"][:0]})


def test_columns_of_points_and_forces(names):
    run(
        't = table("1", "T", S, *(P23_S.real, P23_S.imag), R56.real,\n  abs(R56), dRa, show={"R56": "N"}, note="n")',
        names,
    )
    t = names["t"]
    assert [(c.symbol, c.unit, c.decimals) for c in t.columns] == [
        ("S", "m", 3), ("X23", "m", 3), ("Y23", "m", 3), ("R56x", "kN", 2), ("R56", "N", 0), ("dRa", "%", 2),
    ]  # fmt: skip
    assert np.allclose([c.values for c in t.columns], [
        [0.42, 0.67], [0.42, 0.67], [0.84, 1.34], [1.26, 2.01], [2100, 3350], [23.81, 23.81],
    ])  # fmt: skip
    assert (t.columns[0].meaning, t.note) == ("stroke", "n")
    assert list(t.frame().columns) == ["S [m]", "X23 [m]", "Y23 [m]", "R56x [kN]", "R56 [N]", "dRa [%]"]


def test_two_calls_in_one_cell_read_their_own_arguments(names):
    run('a, b = table("1", "T", S), table("2", "T", dRa)', names)
    assert [names[k].columns[0].symbol for k in "ab"] == ["S", "dRa"]


def test_every_so_many_positions_of_each_variant(names):
    run("import numpy as np\nx = np.arange(5.0)  # [m] x\ny = np.array([[0.0], [10.0]]) + x  # [m] y\ntypeset()", names)
    run('t, u = table("1", "T", x, y, every=2), table("2", "T", S, dRa, every=2)', names)
    assert [c.values.tolist() for c in names["t"].columns] == [[0, 2, 4, 0, 2, 4], [0, 2, 4, 10, 12, 14]]
    assert [c.values.tolist() for c in names["u"].columns] == [[0.42], [23.81]]


def test_a_line_is_declared_wherever_it_stands(names):
    """Before typeset in its cell, or in a cell that typesets nothing."""
    run('x = 2 * S  # [mm] length\nt = table("1", "T", x)\ntypeset()', names)
    assert (names["t"].columns[0].unit, names["t"].columns[0].meaning) == ("mm", "length")
    run("y = 3 * S  # [cm] another length", names)
    run('t = table("1", "T", x, y)', names)
    assert [c.unit for c in names["t"].columns] == ["mm", "cm"]


def test_a_column_whose_unit_is_not_known_is_in_si(names):
    run("y = 3 * S  # [cmm] length", names)
    run('t = table("1", "T", S, y)', names)
    _, y = names["t"].columns
    assert y.unit == "?" and y.values == pytest.approx(names["y"])


def test_units_that_typeset_shows_are_those_of_the_columns(names):
    run('F = S  # [kgf] force\nsi = {"kgf": "N"}\ntypeset(display=si)', names)
    run('x = S  # [m] length\ntypeset(display={"m": "mm"})', names)
    run('t = table("1", "T", F, x)', names)
    assert [c.unit for c in names["t"].columns] == ["N", "mm"]


def test_undeclared_column_says_what_is_missing(names):
    with pytest.raises(SheetError, match=r"column Q: no line declares Q with its unit"):
        run('Q = S\ntable("1", "T", S, Q)', names)
    with pytest.raises(SheetError, match="column S \\+ 1: a column is a name"):
        run('table("1", "T", S + 1)', names)


INPUTS = """
from mechsheet import inputs, one_of

@inputs
class Bolt:
    x: float  # [mm] place
    F: float  # [kN] force

@inputs
class Grade:
    R_m: float  # [MPa] strength

@inputs
class Given:
    k: float = 1.5  # [-] factor; > 0
    places: list[float] = [0.01, 0.02]  # [mm] places
    bolts: list[Bolt] = [Bolt(0.1, 5e3), Bolt(0.2, 7e3)]  # bolts
    grade: Grade = one_of({"8.8": Grade(800e6)}, "8.8")  # grade

g = Given()
"""


def test_inputs_are_columns_with_their_declarations(names):
    run(INPUTS, names)
    run('t = table("1", "T", g.bolts.x, g.bolts.F, g.places, g.k, g.grade.R_m, show={"x_bolts": "m"})', names)
    columns = names["t"].columns
    assert [(c.symbol, c.unit, c.meaning) for c in columns] == [
        ("x_bolts", "m", "place"),
        ("F_bolts", "kN", "force"),
        ("places", "mm", "places"),
        ("k", "-", "factor"),
        ("R_m_grade", "MPa", "strength"),
    ]
    assert np.allclose([c.values for c in columns], [[0.1, 0.2], [5, 7], [10, 20], [1.5, 1.5], [800, 800]])
    with pytest.raises(SheetError, match=r"column g.bolts: a column is a name, an input"):
        run('table("1", "T", g.bolts)', names)
    with pytest.raises(SheetError, match=r"column other.k: a column is a name, an input"):
        run('class Other:\n    k = 1.5\nother = Other()\ntable("1", "T", other.k)', names)


def test_page_leaves_what_is_not_assembled_empty(names):
    run("S = np.array([0.42, np.nan])  # [m] stroke\ntypeset()", names)
    run('t = table("2.1", "<T>", S)', names)
    text = names["t"]._mime_()[1]
    assert "<td" in text and "0.420" in text and "–" in text and "nan" not in text
    assert "&lt;T&gt;" in text


def test_figure_marks_are_in_the_unit_of_the_axis(names):
    run('f = figure("3.1", "F", S, R56.imag, marks={"S_p": 0.5})', names)
    f = names["f"]
    assert (f.x.symbol, [c.symbol for c in f.lines], f.marks) == ("S", ["R56y"], (("S_p", 0.5),))
    text = f._mime_()[1]
    assert "<b>Figure 3.1</b> – F" in text
    assert 'R</tspan><tspan dy="4" font-size="11">56y</tspan><tspan dy="-4">\u200b</tspan> [kN]' in text


def test_a_table_is_one_block_where_the_page_is_wide_enough(names):
    """Else in blocks that are as good as equal, each with the column that names its rows; on paper it shrinks."""
    for columns, blocks in ((6, [6]), (11, [11]), (13, [13]), (16, [16]), (25, [13, 12]), (40, [14, 14, 12])):
        run(f't = table("1", "T", S, *({"dRa, " * columns}), decimals=1)', names)
        text = names["t"]._mime_()[1]
        assert [block.count("<th") // 2 - 1 for block in text.split("<thead>")[1:]] == blocks
        assert text.count("<table") == len(blocks)
        assert ("--fit" in text) == (max(blocks) > 13)


@pytest.mark.parametrize(
    ("rows", "columns", "parts"), [(19, 2, 0), (30, 2, 3), (200, 2, 4), (30, 6, 2), (30, 9, 0), (9, 0, 0)]
)
def test_many_rows_of_a_few_columns_stand_side_by_side(rows, columns, parts):
    """As many times as they have room, none of them with fewer than ten rows."""
    numbers = Column("x", "m", "length", 3, np.linspace(0, 1, rows))
    text = html(Table("1", "T", (numbers, *[numbers] * columns)))
    assert f"--rows:{parts};" in text if parts else "--rows" not in text
    assert text.count("<tr>") == rows + 1


def test_names_in_a_note_are_symbols(names):
    run('t = table("1", "T", S, note="phi3 < V21")', names)
    assert "<i>φ</i><sub>3</sub> &lt; <i>V</i><sub>21</sub></div>" in names["t"]._mime_()[1]


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("table(1, 'Shaft', x)", "table: its number must be a text between quotes, not 1"),
        ("table('1', x, y)", "table 1: its title must be a text between quotes, not [1. 2.]"),
        ("figure('2', None, x, y)", "figure 2: its title must be a text between quotes, not None"),
        ("table('1', 'Shaft', x, every=0)", "table 1: every must be a whole number from 1 on, not 0"),
        ("figure('1', 'Shaft', x, y, every=1.5)", "figure 1: every must be a whole number from 1 on, not 1.5"),
        ("table('1', 'Shaft', x, decimals=0.003)", "table 1: decimals must be a whole number from 0 on, not 0.003"),
        ("table('1', 'Shaft', x, decimals=-1)", "table 1: decimals must be a whole number from 0 on, not -1"),
        ("Column('x', 'm', '', 3, x * 1j)", "column x: its values must be real numbers or texts, one a row"),
        ("Column('x', 'm', '', -1, x)", "column x: its decimals must be a whole number >= 0, not -1"),
        ("Table('1', 'Shaft', ('x',))", "table 1: its columns must be several of Column, not ('x',)"),
        (
            "Table('1', 'Shaft', (Column('x', 'm', '', 3, x), Column('y', 'm', '', 3, y[:1])))",
            "table 1: columns must be as long as each other, not 2 of x, 1 of y",
        ),
    ],
)
def test_what_a_table_cannot_take_is_named(given, told):
    known = {
        "Column": Column,
        "Table": Table,
        "table": table,
        "figure": figure,
        "x": np.array([1.0, 2.0]),
        "y": np.array([3.0, 4.0]),
    }
    with pytest.raises(SheetError, match=re.escape(told)):
        eval(given, known)


def test_texts_of_a_table_have_the_signs_of_the_page() -> None:
    texts = [Column(head, "", "", 0, [text]) for head, text in (("name", "a_b"), ("error", "-3e-09"), ("grade", "S-2"))]
    shown = html(Table("1", "Sensitivity", tuple(texts)))
    assert "".join(f'<td class="ms-text">{cell}</td>' for cell in ("a_b", "−3·10⁻⁹", "S-2")) in shown
