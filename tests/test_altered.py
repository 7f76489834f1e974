"""Lines whose values are changed in place: none stands as the result of a formula that gave another one."""

import re
from pathlib import Path

import pytest
from own_worksheet import own

from mechsheet.document.expression import equation, left
from mechsheet.document.left_out import left_out
from mechsheet.html import write
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import Formula, formulas
from mechsheet.worksheet.source import of_texts

Z = "z = np.array([3.0, g.F, 1.0])  # [m] lengths\n"
CHANGING = [
    "z[0] = g.a",
    "z[1:] += g.a",
    "z.sort()",
    "z.fill(g.a)",
    "np.fill_diagonal(z, 0.0)",
    "np.add.at(z, [0, 0], 1.0)",
    "np.maximum(z, 2.0, out=z)",
    "for i in range(3):\n    z[i] = i * g.a",
    "for r in z:\n    r *= 2.0",
    "if g.F > 2:\n    z[0] = g.a",
    "def f(s):\n    s[0] = g.a\nf(z)",
    "def f(s):\n    s[0] = g.a\n    return s[1]\nw = f(s=z)",
    "def f(s):\n    s[0] = g.a\ndef h(s, k):\n    f(s)\nw = h(z, 2)",
    "of_another_cell(z)",
    "v = z\nv[0] = g.a",
    "v = z[1:]\nv[0] = g.a",
    "v = z.reshape(3, 1)\nw = v.T if g.F > 2 else v\nw[0] = g.a",
    "v = np.asarray(z)\nv.sort()",
]
LEAVING = [
    "v = z * 2\nv[0] = g.a",
    "v = z.copy()\nv[0] = g.a",
    "w = z[0] + 1",
    "def f(s):\n    return s[0] + g.a\nw = f(z)",
    "def f(z):\n    z[0] = g.a",
    "def f(s):\n    s = s * 2\n    return s\nw = f(z)",
    "v = z\nv = z * 2\nv[0] = g.a",
    "w = z[0]\nw += 1.0",
    "typeset(z)\nprint(z)",
    "led = [(0.0, z)]\nled.append(1.0)",
    "w = lines.at(z)",
    "a = np.zeros(3)\na[1] = z[1]",
]


def line_of(lines: str) -> Formula:
    (cell,) = of_texts(((lines, "own.py"),))
    return next(line for line in formulas(cell) if isinstance(line, Formula) and line.name == "z")


@pytest.mark.parametrize("change", CHANGING)
def test_what_is_changed_in_place_stands_without_its_formula(change: str) -> None:
    line = line_of(Z + change)
    assert line.has_value and equation(line) == left(line)


def test_what_was_made_of_what_is_changed_stands_without_its_formula() -> None:
    """It would be another number by what is shown; a function of it gives what it is by then."""
    lines = "w = np.array([1.0, 2.0])  # [m] w\nz = 2 * w[0]  # [m] z\nw[0] = 5.0"
    assert equation(line_of(lines)) == left(line_of(lines))
    line = line_of("z = lambda x: w[0] * x  # [m] z\nw[0] = 5.0")
    assert equation(line) != left(line)


@pytest.mark.parametrize("others", LEAVING)
def test_what_is_not_changed_keeps_its_formula(others: str) -> None:
    line = line_of(Z + others)
    assert equation(line) != left(line)
    assert equation(line_of(others.replace("z", "q") + "\n" + Z)) != left(line), "what stands above changes nothing"


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ("z[0] += g.F", True),
        ("z.sort()", True),
        ("v = z[1:]\n    v[0] = g.F", True),
        ("of_above(z)", True),
        ("w = of_above(z)", True),
        ("z = z * 2\n    z[0] = g.F", False),
        ("v = z.copy()\n    v[0] = g.F", False),
        ("typeset(z)", False),
        ("shown(z)", False),
    ],
)
def test_what_another_cell_gives_is_not_changed_in_place(change: str, told: bool) -> None:
    """Each run of its cell changed it once more: the page had other numbers than a script, without a word."""
    above = "z = np.zeros(3)\ndef of_above(s):\n    s[0] = g.F\n    return 2.0\ndef shown(s):\n    return s[0]"
    found = left_out(of_texts(((above, "own.py"), (change.replace("\n    ", "\n"), "own.py"))), {})
    assert [(each.cell, each.line) for each in found if "in place" in each.why] == [(1, 1 + ("v =" in change))] * told


def test_a_value_that_is_altered_is_no_rounding_of_the_former_terms(tmp_path: Path) -> None:
    """Nor is a name that is deleted an error in Python's words."""
    lines = "z = np.array([1e5, 2e5]) - 1e5  # [m] lengths\nz[0] = 1e-12\nz[1] = 1e-12"
    sheet = own(tmp_path, lines)
    assert "≈" not in "".join(re.findall('id="line-z".*?lengths', write.page(sheet, sheet.inputs())))
    with pytest.raises(SheetError, match=r"line \d+: z has no value where typeset\(\) shows it: it is deleted before"):
        own(tmp_path, f"{lines}\ndel z").run_whole()


def test_the_page_shows_what_it_is(tmp_path: Path) -> None:
    """There stood z = zeros(3) = 2.5, 0, 0."""
    sheet = own(tmp_path, "z = np.zeros(3)  # [m] lengths\nz[0] = g.F")
    (line,) = re.findall('id="line-z".*?lengths', write.page(sheet, sheet.inputs()))
    assert "zeros" not in line and "2.5, 0, 0" in line


CHANGE = "def change(s, by):\n        s[0] = by\n        return s[1]\n"
READING = "from mechsheet import ask, find, read, inputs\n"
BEFORE = "\n@app.cell\ndef given():\n"
OF_A_CELL = f"\n@app.cell\ndef changing():\n    {CHANGE}    return (change,)\n"


@pytest.mark.parametrize(("old", "new"), [(READING, f"{READING}\n    {CHANGE}"), (BEFORE, OF_A_CELL + BEFORE)])
def test_functions_of_the_setup_and_of_other_cells_change_what_they_are_handed(
    tmp_path: Path, old: str, new: str
) -> None:
    """There stood z = zeros(3) = 2.5, 0, 0: only those of its own cell were looked at."""
    own(tmp_path, "z = np.zeros(3)  # [m] lengths\nw = change(z, g.F)  # [m] w\nq = np.ones(3)  # [m] ones")
    file = tmp_path / "own.py"
    text = file.read_text(encoding="utf-8").replace(old, new)
    file.write_text(text.replace("def lines(g):", "def lines(change, g):") if old == BEFORE else text, encoding="utf-8")
    shown = write.page(sheet := load(file), sheet.inputs())
    assert "zeros" not in re.findall('id="line-z".*?lengths', shown)[0]
    assert "ones" in re.findall('id="line-q".*?</math>', shown)[0], "who is not changed keeps his formula"
