"""One line of a worksheet's file in another text: everything else stays byte for byte, and it can be taken back."""

from __future__ import annotations

import ast
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from hypothesis import settings

from mechsheet import Check, find
from mechsheet.page import in_place, notebook, values
from mechsheet.worksheet import cells
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.line_edit import Change, change, imported, line, same_cells
from mechsheet.worksheet.lines import Formula, formulas
from mechsheet.worksheet.source import _in_file

WORKSHEETS = [*sorted(ROOT.glob("worksheets/*.py")), *sorted(ROOT.glob("worksheets/examples/*.py"))]
LOOKED = 800 // settings.default.max_examples or 1  # one line in so many, all of them in a search
EVERY = 9600 // settings.default.max_examples or 1  # those that are edited
TEMPLATE = (ROOT / "lib/mechsheet/run/new_worksheet.txt").read_text(encoding="utf-8")


def names(path: Path) -> list[str]:
    """All that can be edited in a worksheet: inputs, and symbols of lines that stand alone."""
    lines = [row.name for cell in _in_file(str(path), 0) for row in formulas(cell) if isinstance(row, Formula)]
    once = [name for name in dict.fromkeys(lines) if lines.count(name) == 1]
    return [*(f"g.{field.name}" for field in declared(cells.load(path).inputs)), *once]


@pytest.mark.parametrize("path", WORKSHEETS, ids=lambda path: path.stem)
def test_every_line_of_every_worksheet_is_edited_alone_and_back(path: Path) -> None:
    text = path.read_bytes().decode()
    editable = names(path)
    assert len(editable) > 3
    for n, name in enumerate(editable):
        if n % LOOKED:
            continue
        was = line(text, name)
        assert ast.parse(was).body and was == was.strip()
        if n % EVERY:
            continue
        assert change(text, name, was, was).of(text) == text
        told = change(text, name, was, f"{was}  # told")
        made = told.of(text)
        assert made.replace("  # told", "") == text
        assert told.back().of(made) == text
        assert line(made, name) == f"{was}  # told"
        new = "Q_added: float = 1.0  # [m] new" if name.startswith("g.") else "Q_added = 1  # [m] new"
        added = change(text, name, was, new, below=True)
        assert [row for row in added.of(text).splitlines() if "Q_added" not in row] == text.splitlines()
        assert line(added.of(text), "g.Q_added" if name.startswith("g.") else "Q_added") == new
        assert added.back().of(added.of(text)) == text
        gone = change(text, name, was, "")
        with pytest.raises(SheetError, match="no lines"):
            line(gone.of(text), name)
        assert gone.back().of(gone.of(text)) == text


def edited(name: str, new: str, below: bool = False, text: str = TEMPLATE) -> str:
    return change(text, name, line(text, name), new, below).of(text)


def test_arguments_and_return_follow_what_a_cell_reads_and_gives() -> None:
    made = edited("n", "n = M(1)  # [-] levers")
    assert "def load_cases(M, g):" in made
    assert "def load_cases(g):" in edited("n", "n = 2  # [-] levers", text=made)
    gone = edited("sigma", "")
    assert "return M_n, strong" in gone
    assert "return (M_n,)" in edited("strong", "", text=gone)
    many = "".join(f"    long_name_of_a_symbol_{n} = {n}  # [-] one\n" for n in range(9))
    text = TEMPLATE.replace("    phi = linspace", many + "    phi = linspace")
    wide = edited("n", f"n = {' + '.join(f'long_name_of_a_symbol_{n}' for n in range(9))}  # [-] sum", text=text)
    assert "def load_cases(\n    g, long_name_of_a_symbol_0," in wide
    assert [a.arg for a in cell(wide, "load_cases").args.args] == [
        "g",
        *(f"long_name_of_a_symbol_{n}" for n in range(9)),
    ]


def cell(text: str, name: str) -> ast.FunctionDef:
    return next(node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef) and node.name == name)


NEW_LINES = {  # what the setup gets
    "b = g.L * cos(g.W)  # [m] way": ["    from numpy import cos, linspace, pi, sin"],
    "b = np.cos(g.W) * mm": ["    import numpy as np", "    from mechsheet.units import MPa, cm, mm"],
    "k = minerr(lambda x: x**2, x=1.0).x * nan": [
        "    from numpy import linspace, nan, pi, sin",
        "        Used, ask, check, export, figure, find, inputs, minerr, one_of, read, summary, table, title_block, "
        "typeset,",
    ],
    "k = power / angle * log(2) + sin(W) + abs(x)": [],
    "f = lambda cos: cos(2)": [],
}


@pytest.mark.parametrize("new", NEW_LINES)
def test_the_setup_imports_what_a_new_line_calls(new: str) -> None:
    """The first line with a function of one's own had to be preceded by a search for the cell that imports.

    What is as often a quantity is none, nor is the logarithm, which is that to base 10 elsewhere.
    """
    told = change(TEMPLATE, "n", line(TEMPLATE, "n"), new, below=True)
    made = told.of(TEMPLATE)
    before = TEMPLATE.splitlines()
    assert [row for row in made.splitlines() if row not in before] == [*NEW_LINES[new], f"    {new}"]
    assert len(made.splitlines()) == len(before) + 1 + ("np." in new)
    assert told.back().of(made) == TEMPLATE
    assert bool(imported(TEMPLATE, new)) == bool(NEW_LINES[new])


@pytest.mark.parametrize(
    ("setup", "after"),
    [
        ("import marimo as mo", "import marimo as mo\n    from numpy import cos"),
        (
            "from numpy import (\n        pi,\n        sin,\n    )",
            "from numpy import (\n        cos,\n        pi,\n        sin,\n    )",
        ),
        (
            "from numpy import (  # of formulas\n        pi, sin)",
            "from numpy import (  # of formulas\n        pi, sin)\n    from numpy import cos",
        ),
        ("from numpy import sin as s\n\n    s(2)", "from numpy import sin as s\n    from numpy import cos\n\n    s(2)"),
        ("from numpy import pi  # and more\n", "from numpy import cos, pi  # and more\n"),
        (
            "import mechsheet\n    from mechsheet import find",
            "import mechsheet\n    from numpy import cos\n    from mechsheet import find",
        ),
        ("s = 1", "from numpy import cos\n    s = 1"),
        ("import marimo; s = 1", "import marimo; s = 1"),
    ],
)
def test_a_setup_keeps_what_else_it_holds(setup: str, after: str) -> None:
    text = "with app.setup:\n    {}\n\n@app.cell\ndef _():\n    n = 2\n    return (n,)\n"
    for end in ("\n", "\r\n"):
        before = text.format(setup).replace("\n", end)
        made = change(before, "n", "n = 2", "n = cos(2)").of(before)
        assert made == text.format(after).replace("n = 2", "n = cos(2)").replace("\n", end)
    assert change(text[text.index("@") :], "n", "n = 2", "n = cos(2)").of(text[text.index("@") :]).count("cos") == 1


def test_without_a_setup_the_cell_that_imports_gets_what_a_line_calls() -> None:
    """The import was told, and not written."""
    cells = "@app.cell\ndef _():\n    import marimo as mo\n    from numpy import pi\n    return mo, pi\n\n\n"
    text = f"{cells}@app.cell\ndef _(pi):\n    a = pi\n    b = 1\n    return a, b\n"
    told = change(text, "b", "b = 1", "b = cos(a) * mm")
    made = text.replace("import pi\n", "import cos, pi\n    from mechsheet.units import mm\n")
    made = made.replace("return mo, pi", "return cos, mm, mo, pi")
    assert told.of(text) == made.replace("b = 1", "b = cos(a) * mm").replace("def _(pi)", "def _(cos, mm, pi)")
    assert told.back().of(told.of(text)) == text
    own = "@app.cell\ndef _():\n    from numpy import pi\n    b = pi\n    return b, pi\n"
    told = change(own, "b", "b = pi", "b = cos(pi)")
    assert told.of(own) == own.replace("import pi", "import cos, pi").replace("b = pi", "b = cos(pi)").replace(
        "b, pi", "b, cos, pi"
    )
    assert told.back().of(told.of(own)) == own


def test_ends_of_lines_and_a_line_of_several_rows_stay() -> None:
    text = TEMPLATE.replace("\n", "\r\n")
    made = edited("M", "def M(phi):\n    return 2 * g.F * g.L * sin(phi)  # [N*m] moment", text=text)
    assert made == text.replace("return g.F", "return 2 * g.F")
    assert line(TEMPLATE, "phi_found").count("\n") == 2
    was = line(TEMPLATE, "n")
    one = TEMPLATE.replace(was, f"{was} \u2028\x0c ")
    assert change(one, "n", line(one, "n"), line(one, "n")).of(one) == one
    assert edited("n", "n = 3  # [-] one\u2028line", text=one) == TEMPLATE.replace(was, "n = 3  # [-] one\u2028line")
    mixed = TEMPLATE.replace("\n", "\r\n", 5)
    assert edited("n", "n = 3", text=mixed) == mixed.replace(was, "n = 3")
    tabs = TEMPLATE.replace("\n    ", "\n\t")
    assert edited("n", "n = 3", text=tabs) == tabs.replace(was, "n = 3")
    assert "\treturn M_n, strong" in edited("sigma", "", text=tabs)


def test_a_line_is_found_after_many_other_texts() -> None:
    text = TEMPLATE.replace("1200.0", "1201.0")
    for n in range(40):
        change(text, "g.F", line(text, "g.F"), f"F: float = {n}  # [N] force")
    assert change(text, "n", line(text, "n"), "n = 3").of(text) == text.replace(line(text, "n"), "n = 3")


def test_a_name_that_its_cell_binds_again_can_be_edited() -> None:
    text = TEMPLATE.replace("    M_n = g.parts", "    for n in (1, 2):\n        pass\n    M_n = g.parts")
    assert edited("n", "n = 3", text=text) == text.replace(line(text, "n"), "n = 3")


@pytest.mark.parametrize(
    ("name", "new", "says"),
    [
        ("n", "n = 2 (3)  ]", "unmatched"),
        ("n", "n = 2,5 * g.L  # [m] n", "is several values: a decimal number has a point, not a comma"),
        ("n", "n = 2 * 10^3  # [-] n", r"2 \* 10 \^ 3: a power is written \*\*, not \^"),
        ("n", "n, k = 1, 2  # [m] n", "2 names need 2 units"),
        ("n", "n = 2 * sigma  # [-] n", "sigma is defined below its use: move its line up"),
        ("n", "n = 2 * n  # [-] n", "n is computed from itself"),
        ("n", "n = 2a  # [-] n", r"is a \* missing\? 2 \* a"),
        ("n", "n := 2", "a definition is written =, not :="),
        ("n", "lambda = 2", "the symbol λ is lamda"),
        ("g.F", "lambda: float = 2", "the symbol λ is lamda"),
        ("n", "n = M(30 deg)", r"invalid syntax \(is a \* missing\? 30 \* deg\)"),  # and not that a comma is missing
        ("n", "typeset()", "a line is a name and what it is"),
        ("n", "n = 1\nk = 2", "a line is a name and what it is"),
        ("n", "# only words", "a line is a name and what it is"),
        ("n", "sigma = 2  # [-] twice", "sigma is declared by another line"),
        ("g.F", "F = 3", "an input is a name, its type and its value"),
        ("g.F", "L: float = 3  # [m] twice", "L is declared by another line"),
        ("n", "n = 1 \\", "unexpected EOF"),
        ("n", "g.F = 3", "a line is a name and what it is"),
        ("n", "n, phi[0] = 3, 4", "a line is a name and what it is"),
        ("n", "pi = 3  # [-] own", "pi is declared by another line"),
        ("n", "def typeset():\n    return 1", "typeset is declared by another line"),
        ("n", "n = (sigma := 3)", "sigma is declared by another line"),
        ("n", "n = yield", "'yield' outside function"),
        ("n", "n = await phi", "'await' outside function"),
        ("n", "@vectorize\ndef n(x):\n    return x", "a line is a name and what it is"),
        ("n", "async def n(x):\n    return x", "a line is a name and what it is"),
        ("g.F", "F: float = yield", "'yield' outside function"),
    ],
)
def test_what_is_no_line_is_refused_in_words(name: str, new: str, says: str) -> None:
    with pytest.raises(SheetError, match=says):
        edited(name, new)


def test_what_could_not_be_computed_first_is_refused() -> None:
    """Its cells would not be run: they would show what was before, and nothing could be taken back."""
    with pytest.raises(
        SheetError, match="phi_max needs M of the same cell: what needs phi_max needs a cell of its own"
    ):
        edited("phi", "phi = linspace(0, phi_max, 7)  # [deg] angle")
    with pytest.raises(SheetError, match="M and phi_max need each other: neither can be computed first"):
        edited("M", "def M(phi):\n    return g.F * g.L * sin(phi - phi_max)  # [N*m] moment")
    circular = TEMPLATE.replace("(0, pi / 2, 7)", "(0, phi_max, 7)").replace("moment(g)", "moment(g, phi_max)")
    assert "2 * M(phi)" in edited("M_S", "M_S = 2 * M(phi)", text=circular), "what is mended line by line"


def test_a_line_that_is_another_one_by_now_is_left_alone() -> None:
    with pytest.raises(SheetError, match="the line of n has changed since"):
        change(TEMPLATE, "n", "n = 1  # [-] levers", "n = 3")
    told = change(TEMPLATE, "n", line(TEMPLATE, "n"), "n = 3  # [-] levers")
    with pytest.raises(SheetError, match="the cell has changed since"):
        told.back().of(TEMPLATE)
    with pytest.raises(SheetError, match="n has no lines"):
        line(TEMPLATE.replace("n = 2 if", "m = 2 if"), "n")
    with pytest.raises(SheetError, match="n shares its line"):
        line(TEMPLATE.replace("n = 2 if", "m = 1; n = 2 if"), "n")
    with pytest.raises(SheetError, match="never closed"):
        Change(("n = 2 if",), ("n = (2 if",)).of(TEMPLATE)


@pytest.mark.parametrize("path", WORKSHEETS[1::3], ids=lambda path: path.stem)
def test_cells_of_the_page_are_told_from_those_of_the_file(path: Path) -> None:
    from marimo._ast.load import load_app

    codes = list(load_app(path)._cell_manager.codes())
    text = path.read_bytes().decode()
    assert same_cells(text, codes)
    assert same_cells(text, [*codes, "", "\n"])
    assert not same_cells(text, [*codes, "x = 1"])
    assert not same_cells(text, [codes[-1] + "\ny = 2", *codes[:-1]])
    assert not same_cells(text, codes[1:])
    texts = [code for code in codes if code.startswith("mo.md(") and not code.startswith("mo.md(f")]
    assert texts and same_cells(text, [code for code in codes if code not in texts])
    assert not same_cells(text, [*codes, 'mo.md("of one\'s own")'])


@pytest.mark.parametrize(
    "new", ["phi.sort()", "phi.__imul__(2)", "parts.append(1)", "rows.update(a=1)", "rows['b'].append(2)"]
)
def test_what_is_shown_as_one_types_alters_nothing_of_the_page(new: str) -> None:
    names = {"phi": np.array([3.0, 1.0]), "parts": [1, 2], "rows": {"b": [2]}}
    shown = in_place._computed((), "k", "k = 1", f"k = {new}  # [-] k", False, dict(names))
    assert "no number" in shown or "__imul__" in new
    assert names["phi"].tolist() == [3.0, 1.0] and names["parts"] == [1, 2] and names["rows"] == {"b": [2]}


def test_where_a_line_has_no_number_is_told_as_one_types() -> None:
    names = {"x": np.array([1.0, 2.0, 3.0]), "sqrt": np.sqrt}
    shown = in_place._computed((), "k", "k = 1", "k = sqrt(x - 2)  # [-] root", False, dict(names))
    assert f"{values.NOTE} no number at 1 of 3 places: 1" in shown
    shown = in_place._computed((), "k", "k = 1", "k = sqrt(x)  # [-] root", False, dict(names))
    assert values.NOTE not in shown


def test_what_has_no_value_yet_in_its_cell_has_none_as_one_types() -> None:
    """The page has one of before: the line itself would not."""
    cells = [notebook.Cell("c", "a = 1\nk = 2 * a\nb = k", "c", frozenset("akb"), frozenset(), "success", None, False)]

    def shown(new: str, below: bool = False) -> str:
        return in_place._computed(cells, "k", "k = 2 * a", f"{new}  # [-] n", below, {"a": 7, "k": 7, "b": 7})

    assert "k is computed from itself" in shown("k = 2 * k")
    assert "b is defined below its use: move its line up" in shown("k = 2 * b")
    assert "b is defined below its use: move its line up" in shown("n = k * b", below=True)
    assert values.MISTAKE not in shown("k = 3 * a") + shown("n = k * a", below=True)


def test_what_computes_for_long_as_one_types_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(in_place, "_PATIENCE", 0.05)
    running: list[threading.Thread] = []

    def endless() -> str:
        running.append(threading.current_thread())
        while True:
            try:
                sum(range(1000))
            except Exception:
                continue

    with pytest.raises(SheetError, match=r"computes for more than 0\.05 s"):
        in_place._elsewhere(endless)
    running[0].join(20)
    assert not running[0].is_alive()


BOUNDED = {
    "10**10**9": "a whole number of more than 10000 digits",
    "9**9**9": "a whole number of more than 10000 digits",
    "pow(n, 9**9)": "a whole number of more than 10000 digits",
    "1 << 10**11": "a whole number of more than 10000 digits",
    "sum(range(10**12))": "more than 10 million elements",
    "np.linspace(0, 1, 10**11)[0]": "more than 10 million elements",
    "np.zeros((10**6, 10**6))[0, 0]": "more than 10 million elements",
    "len([0] * 10**11)": "more than 10 million elements",
    "input()": "a line asks nobody: what is given is an input",
    "eval('9**9**9')": "a line holds no program as a text",
}


@pytest.mark.parametrize("new", BOUNDED)
def test_a_step_that_python_does_not_leave_is_refused_as_one_types(new: str) -> None:
    """The page's process stood still until it was ended."""
    names = {"np": np, "n": 7}
    shown = in_place._elsewhere(lambda: in_place._computed((), "k", "k = 1", f"k = {new}  # [-] k", False, names))
    assert BOUNDED[new] in shown


@pytest.mark.parametrize(
    ("new", "value"),
    [
        ("2**3**2 - 2**-1 + (-n) ** 2 + a**0.5", "561.9"),
        ("sum(i**2 for i in range(n**2))", "38024"),
        ("pow(n, 3) + pow(2, 10**9, 7)", "345"),
        ("np.arange(3)[-1] + np.zeros((2, 2)).size + np.linspace(0, 1, num=3)[1]", "6.5"),
        ("find(lambda x: x**2 - n, 0, n).value ** 2", "7"),
        ("m**2", "(m is a list: np.array([..]) is computed element by element)"),
    ],
)
def test_what_is_bounded_is_computed_as_it_stands(new: str, value: str) -> None:
    names = {"np": np, "n": 7, "a": 2.0, "m": [1.0], "find": find}
    assert value in in_place._computed((), "k", "k = 1", f"k = {new}  # [-] k", False, names)


def test_a_line_that_would_end_the_program_is_refused() -> None:
    """The page's process ended while one typed exit."""
    with pytest.raises(SheetError, match="ends the program"):
        in_place._elsewhere(lambda: in_place._computed((), "k", "k = 1", "k = exit()", False, {"exit": sys.exit}))


def test_what_is_typed_is_read_whatever_stands_before_it_and_warns_nowhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, recwarn: pytest.WarningsRecorder
) -> None:
    """A line that is pasted with its indentation could not be read; warnings of what was typed stayed at the title."""
    path = tmp_path / "lever.py"
    path.write_text(TEMPLATE, encoding="utf-8")
    monkeypatch.setattr(notebook, "running", lambda: (lambda: (), {}))
    names = cells.load(path).run(["g"], {}) | {"__file__": str(path)}
    page = in_place.InPlace(names, lambda: None)
    was = line(TEMPLATE, "g.F")
    shown = page.done("type", "g.F", was, "\tF: float = 2.0  # [N] force ")["shown"]
    assert "2 N" in shown
    with pytest.raises(Exception, match="not callable"):
        page.done("type", "g.F", was, "F: float = 2 (3)  # [N] force")
    assert not recwarn.list


def test_what_marimo_has_saved_since_is_taken_back() -> None:
    """It writes anew what each cell returns: the cell was another one, and nothing was written."""
    told = change(TEMPLATE, "sigma", line(TEMPLATE, "sigma"), CHECK, below=True)
    for old, new in (
        ("M_n, sigma, strong", "M_n, light, sigma, strong"),
        ("M_n, sigma, strong", "(\n        M_n,\n    )"),
    ):
        saved = told.of(TEMPLATE).replace(f"return {old}", f"return {new}").replace("_1, table_1", "_1")
        assert told.back().of(saved) == TEMPLATE.replace("_1, table_1", "_1")
    with pytest.raises(SheetError, match="the cell has changed since"):
        told.back().of(told.of(TEMPLATE).replace("M_n / g.W", "M_n / g.W / 2"))


def test_a_line_that_changes_its_name_does_so_everywhere_and_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It left all lines that read the name without a value, and only a command gave them the other one.

    One without a value takes its whole cell from the page, where it cannot be clicked any more: it is asked first.
    """
    path, scene = tmp_path / "lever.py", tmp_path / "light.toml"
    path.write_text(TEMPLATE, encoding="utf-8")
    scene.write_text("[inputs]\nF = 3\n", encoding="utf-8")
    monkeypatch.setattr(notebook, "running", lambda: (lambda: (), {}))
    page = in_place.InPlace({"__file__": str(path)}, lambda: None)
    monkeypatch.setattr(page, "is_taken", lambda text: True)
    new = "F_0: float = 1300.0  # [N] force"
    asked = {"name": "g.F", "was": line(TEMPLATE, "g.F"), "new": new}
    told = page.done("write", **asked)
    assert told["asks"].startswith("F goes, needed in") and told["renames"] == ["F", "F_0"]
    lost = {"name": "n", "was": line(TEMPLATE, "n"), "new": "n = g.F.parts  # [-] levers"}
    asked_first = "it has no value, and without one nor has what stands below it in its cell"
    assert page.done("write", **lost)["asks"] == asked_first
    assert path.read_text(encoding="utf-8") == TEMPLATE
    told = page.done("write", everywhere=True, **asked)
    made = path.read_text(encoding="utf-8")
    assert f"    {new}\n" in made and "return g.F_0 * g.L * sin(phi)" in made and "g.F " not in made
    assert scene.read_text(encoding="utf-8") == "[inputs]\nF_0 = 3\n"
    saved = made.replace("return M, M_S, phi", "return M, phi").replace("0.25.2", "0.25.1")
    path.write_text(saved, encoding="utf-8")  # by marimo
    page.done("undo", before=told["written"]["after"], after=told["written"]["before"])
    assert path.read_text(encoding="utf-8").replace("0.25.1", "0.25.2") == TEMPLATE
    assert scene.read_text(encoding="utf-8") == "[inputs]\nF = 3\n"
    assert page.done("write", **asked | {"new": ""})["renames"] == []


CHECK = 'light = check("force", g.F, 2e3, "N")'


@pytest.mark.parametrize(
    ("name", "new", "below", "after"),
    [
        (
            "sigma",
            CHECK,
            True,
            {"typeset(strong)": "typeset(strong, light)", "(within, strong)": "(within, strong, light)"},
        ),
        (
            "sigma",
            f"lights = [{CHECK.removeprefix('light = ')}]",
            True,
            {"typeset(strong)": "typeset(strong, *lights)", "(within, strong)": "(within, strong, lights)"},
        ),
        ("strong", CHECK, False, {"typeset(strong)": "typeset(light)", "(within, strong)": "(within, light)"}),
        ("strong", "", False, {"typeset(strong)": "typeset()", "(within, strong)": "(within)"}),
        ("strong", "k = 2  # [-] two", False, {"typeset(strong)": "typeset()", "(within, strong)": "(within)"}),
        ("M_S", "P_found = find(M, 0, 1, equals=1)", True, {"typeset()": "typeset(P_found)"}),
        ("M_S", 't = table("3", "T", phi, M_S)', True, {"typeset()": "typeset(t)"}),
        ("M_S", "d = Drawing().link(0, g.L) + Drawing()", True, {"typeset()": "typeset(d)"}),
        ("M_S", "k = 2  # [-] two", True, {}),
    ],
)
def test_what_a_line_gives_to_be_shown_is_shown_and_counted(
    name: str, new: str, below: bool, after: dict[str, str]
) -> None:
    """A check written as a line was seen nowhere, and the verdict stayed at 2 of 2 checks."""
    for text in (TEMPLATE, TEMPLATE.replace("\n", "\r\n")):
        told = change(text, name, line(text, name), new, below)
        made = told.of(text)
        assert told.back().of(made) == text
        before = TEMPLATE
        for old, now in after.items():
            before = before.replace(old, now)
        shown = [row for row in made.splitlines() if "typeset(" in row or "summary(" in row]
        assert shown == [row for row in before.splitlines() if "typeset(" in row or "summary(" in row]
        wanted = [
            n
            for n in ("light", "lights", "strong", "within")
            if f"{n}" in after.get("(within, strong)", "(within, strong)").strip("()").split(", ")
        ]
        assert [a.arg for a in cell(made, "verdict").args.args] == wanted
        assert made.count("\r\n") == (made.count("\n") if text != TEMPLATE else 0)


def test_a_line_reads_what_its_cell_keeps_to_itself() -> None:
    """marimo forgets names with _ once the cell has run: the editor told that they are defined nowhere."""
    code = "_c = 2.0\n_k = 3 * _c\nG = 1.0\nF = _k * L  # [N] force\n_late = 1.0"
    cells = [notebook.Cell("Hbol", code, "", frozenset({"F", "G"}), frozenset({"L"}), None, None, False)]
    was = "F = _k * L  # [N] force"

    def shown(new: str) -> str:
        return in_place._computed(cells, "F", was, new, False, {"L": 0.5})

    assert "si='[[3.0]]'" in shown(was) and "mistake" not in shown(was)
    assert "mistake" in shown("F = _late * L  # [N] force") and "mistake" in shown("F = _m * L  # [N] force")
    two = 'c = (Check("a", 1.0, 2.0), Check("b", 3.0, 2.0))'
    checks = in_place._computed((), "c", "c = 1", two, False, {"Check": Check})
    assert ">PASS<" in checks and ">FAIL<" in checks and "mistake" not in checks, "several are shown"
