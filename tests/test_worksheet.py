"""A worksheet as a function: the right cells, the right values, the right machine."""

import runpy
import shutil
import subprocess
import sys
import tokenize
from dataclasses import replace
from io import StringIO
from pathlib import Path
from textwrap import indent

import numpy as np
import pytest
from hypothesis import settings
from marimo._convert.converters import MarimoConvert

from mechsheet.recording.evaluation import evaluate
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import load, results
from mechsheet.worksheet.check import checks_of
from mechsheet.worksheet.errors import SheetError
from worksheets import hitch

HITCH = Path(__file__).resolve().parents[1] / "worksheets" / "hitch.py"
EVERY = 500 // settings.default.max_examples or 1  # one file in so many, all of them in a search


def test_capacity_runs_only_what_it_depends_on():
    needed = [cell.name for cell in load(HITCH).needed(["GS6"], ["g"])]
    assert set(needed) == {
        *("hinges", "coordinate", "group_1", "group_2", "find_L4", "find_S_p", "group_3", "find_L7"),
        *("sides", "fields", "centre_of_mass", "transmission", "capacity"),
    }
    assert len(needed) < len(load(HITCH).cells) / 4


@pytest.mark.parametrize("path", sorted(HITCH.parent.rglob("*.py")), ids=lambda path: path.stem)
def test_where_the_inputs_are_given_no_form_is_made(path):
    """A case of many takes as long as its cells, and not as the fields of a page."""
    sheet = load(path)
    cells = sheet.needed(sheet.results, ["g"])
    assert len(cells) > 5 and not any("ask" in cell.code.co_names for cell in cells)
    assert {"form", "g"}.isdisjoint(sheet.results)


WITH_INPUTS = """\
import marimo
app = marimo.App()
with app.setup:
    from dataclasses import replace
    import mechsheet
    from mechsheet import ask, inputs, read
    from mechsheet import read as read_as

    @inputs
    class Given:
        a: float = 1.0  # [m] length

    form = ask(Given)

@app.cell
def _():
    {}
    return

@app.cell
def _(g):
    c = 2 * g.a
    return (c,)
"""


def test_what_more_than_the_inputs_needs_is_a_result(tmp_path):
    path = tmp_path / "own.py"
    given = "k, form_2 = 2.0, ask(Given)\n    return form_2, k\n\n"
    given += "@app.cell\ndef _(form_2, k):\n    print(k)\n    g = read(Given, form_2)"
    path.write_text(WITH_INPUTS.format(given).replace("c = 2 * g.a", "c = k * g.a").replace("def _(g)", "def _(g, k)"))
    assert load(path).results == ["k", "c"]


@pytest.mark.parametrize("line", ["k, g = 3.0, Given()", "g = Given()\n    _k = 2\n    k = 3 * g.a"])
def test_the_cell_of_the_inputs_gives_nothing_else(tmp_path, line):
    """It does not run where others are given: what stood there kept its number in sweeps and the workbook, unsaid."""
    path = tmp_path / "own.py"
    path.write_text(WITH_INPUTS.format(line))
    with pytest.raises(SheetError, match="g, the inputs, needs a cell of its own: move k to another one"):
        load(path)


@pytest.mark.parametrize(
    "line",
    [
        "g = Given(a=5.0)",
        "g = Given(form.value)",
        "g = replace(Given(), a=5.0)",
        "g = Given() if form else Given(2.0)",
        "_g = Given(2.0)\n    g = _g",
        "if form:\n        g = read(Given, form)",
        "print(g := Given(2.0))",
        "for g in [Given(2.0)]:\n        pass",
        "g: Given = Given(2.0)",
        "g = form",
    ],
)
def test_the_inputs_begin_with_the_values_of_their_class(tmp_path, line):
    """Others are those of a run alone: sweeps, single results and the workbook begin with those of the class."""
    path = tmp_path / "own.py"
    path.write_text(WITH_INPUTS.format(line))
    with pytest.raises(SheetError, match=r"own.py, line 1[78]: inputs begin with the values of their class"):
        load(path)


@pytest.mark.parametrize(
    "line",
    [
        "g = Given()",
        "g: Given = Given()",
        "g = read(Given, form)",
        "g = mechsheet.read(Given, form)",
        "g = read_as(Given, form)",
    ],
)
def test_the_inputs_are_read_or_those_of_their_class(tmp_path, line):
    path = tmp_path / "own.py"
    path.write_text(WITH_INPUTS.format(line))
    assert load(path).run_whole()["c"] == 2.0


def test_comments_are_those_of_pythons_own_tokens():
    """In every way in which texts and comments may hold each other, and in files of the project."""
    files = [*HITCH.parent.rglob("*.py"), *sorted(Path(__file__).parent.glob("*.py"))]
    texts = [path.read_text(encoding="utf-8") for path in files[::EVERY]]
    texts += [
        """x = '#' "\\"#" r'\\'  # a '#' b\ny = \'\'\'# " \n'' #\'\'\'; z = f"{x:#}"  #: c\n#d""",
        "a = 'b\\\n#c'  # d",
        "",
    ]
    for text in texts:
        tokens = tokenize.generate_tokens(StringIO(text).readline)
        assert source.comments(text) == {
            t.start[0]: t.string.lstrip("# ") for t in tokens if t.type == tokenize.COMMENT
        }


def test_what_marimos_editor_saves_is_the_same_worksheet(tmp_path):
    """The editor writes behind ``return`` only what other cells read: tables and found values are not there."""
    documents = [HITCH, *HITCH.parent.glob("examples/*.py")]
    shutil.copy(HITCH.parent / "examples" / "engine.csv", tmp_path)
    for old in documents:
        new = tmp_path / old.name
        new.write_text(MarimoConvert.from_py(old.read_text(encoding="utf-8")).to_py(), encoding="utf-8")
        assert new.read_text(encoding="utf-8") != old.read_text(encoding="utf-8")
        alone = load(new).common  # a function that needs no other cell stands alone when it is saved
        assert load(new).results == [name for name in load(old).results if name not in alone]
    tables = [name for name in load(HITCH).results if name.startswith("table")]
    assert tables and all(table.columns for table in evaluate(tmp_path / "hitch.py", tables).values())


def test_what_a_cell_defines_is_what_its_lines_bind(tmp_path):
    path = tmp_path / "lever.py"
    path.write_text("""import marimo
app = marimo.App()

with app.setup:
    from math import pi

@app.cell
def lever():
    import json as text
    (a, *b), c = (1, 2), 3
    squares = [x * x for x in range(3) if (last := x) >= 0]
    for k in range(2):
        _own = k
    def f(y):
        inside = y
        return inside
    d: float = 4
    d += pi
    c_squared = (lambda z: z * z)(c)
    return
""")
    names = ["text", "a", "b", "c", "squares", "last", "k", "f", "d", "c_squared"]
    assert load(path).results == results(path) == names
    assert results(path, certain=True) == [name for name in names if name != "k"]


COUNT = """
import sys

ran = 0

def count(frame, event, argument):
    global ran
    code = frame.f_code
    ran += event == "call" and code.co_name == "<module>" and code.co_filename == {path!r}

for run in {runs!r}:
    ran = 0
    sys.setprofile(count)
    exec(run, {{}})
    sys.setprofile(None)
    print("ran", ran, *sorted(name for name in sys.modules if "." not in name))
"""
RUNS = {
    "evaluate": "from mechsheet import evaluate; evaluate({path!r}, want=['GS6'], P6=30e3)",
    "scene": "from mechsheet.run.batch import run; run({path!r}, [{scene!r}])",
    "figure": "from mechsheet import evaluate; evaluate({path!r}, ['figure_54'])",
}


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """How many blocks of the hitch worksheet a fresh process runs one after the other, and the packages it has loaded.

    The setup is one of the first.
    """
    scene = tmp_path_factory.mktemp("scene") / "capacity.toml"
    scene.write_text('want = ["GS6"]\n[inputs]\nP6 = 30e3\n[limits]\nGS6 = {min = 20e3}\n')
    runs = [run.format(path=str(HITCH), scene=str(scene)) for run in RUNS.values()]
    code = COUNT.format(path=str(HITCH), runs=runs)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    told = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("ran ")]
    return {name: (int(blocks), set(packages)) for name, (blocks, *packages) in zip(RUNS, told, strict=True)}


HEAVY = {"marimo", "altair", "pandas", "scipy", "openpyxl", "xlsxwriter", "matplotlib"}


@pytest.mark.parametrize(("run", "blocks"), [("evaluate", 1 + 13), ("scene", 13)])
def test_capacity_runs_its_thirteen_cells_and_loads_no_page_chart_or_workbook(run, blocks, ran):
    assert ran[run][0] == blocks
    assert not HEAVY & ran[run][1]


def test_reactions_and_charts_are_counted_where_they_are_asked_for(ran):
    blocks, packages = ran["figure"]
    assert blocks == len(load(HITCH).needed(["figure_54"], ["g"])) > 13
    assert "altair" not in packages, "a figure is drawn by the page"


def test_same_values_as_the_whole_run():
    g = replace(hitch.Hitch(), P6=30e3)
    whole = hitch.app.run(defs={"g": g})[1]
    some = evaluate(HITCH, ["GS6", "R56", "table_31"], P6=30e3)
    assert list(some) == ["GS6", "R56", "table_31"]
    assert np.array_equal(some["GS6"], whole["GS6"]) and np.array_equal(some["R56"], whole["R56"])
    assert [c.symbol for c in some["table_31"].columns] == [c.symbol for c in whole["table_31"].columns]


def test_inputs_in_display_units_or_whole():
    upright = evaluate(HITCH, ["phi6_S"], phi_P6=85)["phi6_S"]
    again = evaluate(HITCH, ["phi6_S"], g=replace(hitch.Hitch(), phi_P6=np.deg2rad(85)))["phi6_S"]
    assert np.allclose(upright, again, rtol=1e-13, atol=0), "what was asked for before is computed another way"


def test_parts_of_results_and_checks_by_their_names():
    wanted = ["abs(R56)", "P56_S.imag", "instant centre: Imp = I56", "checks_pole"]
    some = evaluate(HITCH, wanted)
    whole = evaluate(HITCH, ["R56", "P56_S"])
    assert list(some) == wanted
    assert np.array_equal(some["abs(R56)"], np.abs(whole["R56"]))
    assert np.array_equal(some["P56_S.imag"], whole["P56_S"].imag)
    assert some["instant centre: Imp = I56"] is some["checks_pole"][0]
    assert {cell.name for cell in load(HITCH).needed(wanted[2:3], ["g"])} >= {"transmission", "pole"}


def test_a_check_whose_name_is_composed_is_found():
    slotted = HITCH.with_name("slotted_link.py")
    name = next(
        check.name for check in checks_of(load(slotted).run(load(slotted).results, {})) if "Find = " in check.name
    )
    needed = load(slotted).needed([name])
    assert len(needed) < len(load(slotted).cells) / 2
    assert evaluate(slotted, [name])[name].passed


APART = """
import marimo

app = marimo.App()

with app.setup:
    from mechsheet import export, inputs, typeset


@app.class_definition
@inputs
class Bar:
    b: float = 2.0  # [m] length; > 0


@app.cell
def _(g):
    import math as _m
    from os import sep as _k

    _k = 2.0

    def _times(x, _k=_k):
        return _k * x

    class _Twice:
        of = staticmethod(lambda x: _times(x, _k=_k))

    match g.b:
        case _b:
            f = lambda x: _Twice.of(x) + 0 * (_b + _m.pi)
    return (f,)


@app.cell
def _(g):
    _k = 3.0
    _times = 5.0
    _m, _b, _Twice = 7.0, 11.0, 13.0
    z = _k * g.b * _times
    return (z,)


@app.cell
def _(f, z):
    d = f(z)
    return (d,)


@app.cell
def _():
    g = Bar()
    return (g,)


if __name__ == "__main__":
    app.run()
"""


def test_names_with_an_underscore_are_their_cells_own(tmp_path):
    """As in the page: what a function of one cell reads, a later cell must not change."""
    path = tmp_path / "apart.py"
    path.write_text(APART, encoding="utf-8")
    _, page = runpy.run_path(str(path), run_name="apart")["app"].run()
    assert evaluate(path, ["d"]) == {"d": 2 * 3 * 2 * 5.0} == {"d": page["d"]}


def test_a_stopped_cell_is_an_error_that_names_it(tmp_path):
    sheet = tmp_path / "sheet.py"
    sheet.write_text(
        "import marimo\napp = marimo.App()\n\nwith app.setup:\n    import marimo as mo\n\n\n"
        "@app.cell\ndef one():\n    mo.stop(True)\n    a = 1\n    return (a,)\n"
    )
    with pytest.raises(SheetError, match="cell one stopped before its end"):
        load(sheet).run(["a"], {})


def test_intermediate_results_can_be_given():
    given = {"g": hitch.Hitch(), "L4": 0.7}
    names = load(HITCH).run(["P56_S"], given)
    assert names["L4"] == 0.7, "whatever else its cell is needed for"
    assert "L4_found" not in load(HITCH).run(["P56_S"], {**given, "L7": names["L7"]})


@pytest.mark.parametrize(
    ("want", "given", "message"),
    [
        ("GS66", {}, f"GS66 is defined by no cell of {HITCH}; nearest: GS6, "),
        ("zzz", {}, f"zzz is defined by no cell of {HITCH}"),
        ("abs(R55)", {}, f"R55 is defined by no cell of {HITCH}; nearest: R65, R56"),
        (
            "instant centre: Imp = I65",
            {},
            "no check is named 'instant centre: Imp = I65'; nearest: 'instant centre: Imp",
        ),
        ("3.1", {}, "no check is named '3.1'"),
        ("table_31.real", {}, "table_31.real: table_31 is no number"),
        ("GS6", {"P66": 1}, "input P66 is unknown; nearest: P6"),
        ("GS6", {"P6": -1}, "weight of the implement P6 = -1.0 N must be >= 0 N"),
        ("GS6", {"Y_P56": 3}, "working stroke S_p: height Y56 of the suspension axis reaches"),
    ],
)
def test_what_cannot_be_answered_is_said(want, given, message):
    with pytest.raises(SheetError) as error:
        evaluate(HITCH, [want], **given)
    assert str(error.value).startswith(message)


def test_file_that_cannot_be_read(tmp_path):
    with pytest.raises(SheetError, match=r"none\.py cannot be read"):
        load(tmp_path / "none.py")
    broken = tmp_path / "broken.py"
    broken.write_text("a = (\n")
    with pytest.raises(SheetError, match=r"broken.py, line 1, a = \(: '\(' was never closed"):
        load(broken)


def test_changed_file_is_read_again(tmp_path):
    sheet = tmp_path / "sheet.py"
    text = "import marimo\napp = marimo.App()\n\n@app.cell\ndef one():\n    a = {}\n    return (a,)\n"
    for value in (1, 22):
        sheet.write_text(text.format(value))
        assert load(sheet).run(["a"], {})["a"] == value


def cells(*bodies: str) -> str:
    """Text of a worksheet of cells, each the lines of its function."""
    parts = ("import marimo\napp = marimo.App()\n", *(f"@app.cell\ndef _():\n{indent(b, '    ')}\n" for b in bodies))
    return "\n\n".join(parts)


def test_all_cells_run_those_first_that_others_need_and_those_too_that_give_nothing(tmp_path, capsys):
    path = tmp_path / "sheet.py"
    # As text editors leave it: the cells name none of what they read, be it in a function, as arguments.
    path.write_text(cells("print(c)", "c = f()", "def f():\n    return 2 * b", "b = 21", "print('end')"))
    names = load(path).run_whole()
    assert (names["c"], capsys.readouterr().out) == (42, "42\nend\n")
    assert evaluate(path, ["c"]) == {"c": 42}


def test_a_name_that_two_cells_define_is_refused_with_both_places(tmp_path):
    path = tmp_path / "sheet.py"
    path.write_text(cells("a = 1", "b = a", "for a in (1, 2):\n    pass"))
    with pytest.raises(SheetError, match=r"^sheet\.py, lines 6 and 16: a is defined in two cells: rename"):
        load(path)


def test_all_names_that_two_cells_define_are_told_at_once(tmp_path):
    path = tmp_path / "sheet.py"
    path.write_text(cells("a = 1\nk = 2", "b = a", "a = 3\nk = 4\nb = 5"))
    with pytest.raises(SheetError) as refused:
        load(path)
    stays = "rename them in one of them; a name such as _a stays in its cell"
    last = "lines 12 and 17: b is defined in two cells: rename it in one of them; a name such as _b stays in its cell"
    assert str(refused.value) == f"sheet.py, lines 6 and 17: a, k are defined in two cells: {stays}; {last}"


def test_a_name_of_the_setup_that_a_cell_defines_is_refused_as_the_page_does(tmp_path):
    """A unit that is imported, a constant, a class: the page would not open, so a script does not run either."""
    path = tmp_path / "sheet.py"
    setup = "with app.setup:\n    from mechsheet.units import N\n    a = 1\n\n@app.function\ndef f():\n    return 1\n"
    for line, name in (("N = 2", "N"), ("a = 2", "a"), ("f = 2", "f")):
        path.write_text(cells("b = 1", line).replace("@app.cell", f"{setup}\n@app.cell", 1))
        with pytest.raises(SheetError, match=rf"^sheet\.py, lines \d+ and \d+: {name} is of the setup"):
            load(path)
    path.write_text(
        cells("b = a", "def g():\n    a = 2\n    _a = a\n    return a").replace("@app.cell", f"{setup}\n@app.cell", 1)
    )
    load(path)


def test_a_cell_that_the_editor_keeps_as_a_text_is_refused(tmp_path):
    path = tmp_path / "sheet.py"
    unread = 'app._unparsable_cell(\n    r"""\n    L = 2 g.F\n    """,\n    name="_"\n)\n'
    path.write_text(cells("a = 1") + "\n\n" + unread)
    with pytest.raises(SheetError, match=r"line 10: a cell there cannot be read: L = 2 g\.F: .*is a \* missing"):
        load(path)
    path.write_text("print('no cells')\n")
    with pytest.raises(SheetError, match=r"sheet\.py is no worksheet: it has no cells"):
        load(path).run_whole()


def test_cells_that_need_each_other_are_refused(tmp_path):
    path = tmp_path / "sheet.py"
    path.write_text(cells("a = b + 1", "b = a - 1"))
    with pytest.raises(SheetError, match="a and b need each other"):
        load(path).run_whole()
