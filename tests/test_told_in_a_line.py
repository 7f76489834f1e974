"""Mistakes of who begins: each is one line that names what is wrong, and where; none passes without a word."""

import sys
from pathlib import Path

import pytest
from as_script import as_command, as_launched, as_script
from openpyxl import load_workbook
from own_worksheet import written
from test_launcher import refusal

from mechsheet.run import rename
from mechsheet.studies import asked_design
from mechsheet.worksheet import mistakes

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"
SETUP = (
    "import numpy as np\nfrom mechsheet import "
    "ask, check, check_slope, export, find, inputs, largest_of, minerr, one_of, read, sweep"
)
GIVEN = "F: float = 1200.0  # [N] force; > 0\nL: float = 0.35  # [m] length; > 0\nn: int = 3  # [-] number; > 0"


def worksheet(folder: Path, lines: str, given: str = GIVEN, end: str = "") -> Path:
    path = folder / "told.py"
    text = written(SETUP, given, lines, "Told")
    path.write_text(text.replace('export("Told", globals())', end or 'export("Told", globals())'))
    return path


Y = "y = g.F  # [N] y"
SWEPT = f"y = sweep({str(HITCH)!r}, ['GS6', 'L4'], {{'P6': [25e3]}})['z']  # [-] y"
REFUSED = {
    "export without the names": (Y, GIVEN, 'export("Told", {})', "export takes the title"),
    "export the other way round": (Y, GIVEN, 'export(globals(), "Told")', "export takes the title"),
    "an input twice": (Y, f"{GIVEN}\nF: float = 2.0  # [N] again", "", "input F stands in the class twice"),
    "a limit behind a comma": (Y, "F: float = 5.0  # [N] force, > 10", "", "> 10 stands in the meaning of F"),
    "an input in other letters": ("y = g.f  # [N] y", GIVEN, "", "there is no input f (did you mean F?)"),
    "an input without g": ("y = 2 * L  # [m] y", GIVEN, "", "name L is not defined in any cell (did you mean g.L?"),
    "options that are names": (Y, 'side: str = one_of("push", "pull")', "", 'type is Literal["push", "pull"]'),
    "options that are a list": (Y, 'side: str = one_of(["push", "pull"], "pull")', "", "one_of(options by their names"),
    "a number for a function": ("y = find(g.F, 0.0, 1.0).value  # [-] y", GIVEN, "", "find takes a function of"),
    "no function to make least": ("y = minerr(3, a=1.0).a  # [-] y", GIVEN, "", "minerr takes a function of what is"),
    "no result of a sweep": (SWEPT, GIVEN, "", "'z' is no result of this sweep: it has GS6, L4"),
    "largest of nothing": ("y = largest_of()  # [-] y", GIVEN, "", "largest_of is called without "),
    "no colon": ("def f(x)\n    return x", GIVEN, "", "def f(x): expected ':'"),
}  # fmt: skip


SIGNS = {  # of print, which Python reads otherwise or not at all
    "y = 2·x": "a product is written *",
    "y = 2 × x": "a product is written *",
    "y = x − 2": "a minus is written -",
    "y = x²": "a power is written **",
    "y = √(2)": "a root is written sqrt(..)",
    "y = sin(30°)": "an angle in degrees is written 30 * deg",
    "y = 1 if x ≤ 2 else 0": "comparisons are written <=, >= and !=",
    "y = |x|": "an absolute value is written abs(..)",
    "y = “name”": 'a text stands between " and "',
}


SIGNS |= {  # slips of who writes formulas elsewhere
    "y = 2a": "is a * missing? 2 * a",
    "y = 1e-3m": "is a * missing? 1e-3 * m",
    "y = (a + b) c": "is a * missing? (..) * c",
    "y = (a + b)c": "is a * missing? (..) * c",
    "y = 3 * 5 mm": "is a * missing? 5 * mm",
    "y = sqrt 2": "what a function is of stands in brackets: sqrt(2)",
    "y = 1 000": "a number has no spaces",
    "y = 1.2.3": "a number has one point",
    "y = 5 %": "per cent are hundredths: 0.05, shown by [%]",
    "y = n!": "a factorial is written factorial(n), from math",
    "y₁ = 2": "an index is written x_1",
    "y_{12} = 2": "an index is written x_1",
    "2y = 3": "a name begins with a letter",
    "y = (a = 2)": "a line has one =, behind its name; what is compared is written ==",
    "y = 2 * a = b + 1": "a line has one =, behind its name; what is compared is written ==",
    "a + b = c": "left of = stands one name; find solves an equation",
    "y = if a > 1: 2 else 3": "a choice is written this if condition else that",
    "y = a && b": "conditions are joined by and, or",
    "y = a =< b": "comparisons are written <=, >= and !=",
    "y = 2 +": "what follows is missing",
}


@pytest.mark.parametrize("line", SIGNS)
def test_signs_of_print_are_told_as_they_are_written(line: str) -> None:
    with pytest.raises(SyntaxError) as found:
        compile(line, "", "exec")
    assert mistakes.unread(found.value).endswith(f"({SIGNS[line]})")


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("y = (a + (b * 2)", "'(' was never closed: (a + (b * 2)"),
        ("y = (a + b", "'(' was never closed"),
        ("y = a and", "invalid syntax"),
        ("in = 3", "in is a word of Python: take another name, such as in_1"),
        ("y = f(a=1, 2)", "positional argument follows keyword argument"),
        ("if y = 2:\n    z = 3", "invalid syntax (what is compared is written ==)"),
        ("print y", "Missing parentheses in call to 'print'. Did you mean print(...)?"),
    ],
)
def test_a_slip_is_told_in_one_line_without_a_second_guess(line: str, says: str) -> None:
    with pytest.raises(SyntaxError) as found:
        compile(line, "", "exec")
    assert mistakes.unread(found.value) == says


@pytest.mark.parametrize("sign", ["=", ":="])
def test_a_function_as_mathcad_has_it_is_told_as_it_is_written(sign: str) -> None:
    with pytest.raises(SyntaxError) as found:
        compile(f"M(phi, S) {sign} 2 * phi * S", "", "exec")
    assert mistakes.unread(found.value) == "a function is written M = lambda phi, S: .."


def test_a_name_that_is_to_be_imported_is_told_from_where() -> None:
    """Rather than one that is like it."""
    known = ["sin", "check", "sinus"]
    for name, source in {"sinh": "numpy", "linspace": "numpy", "pi": "numpy", "check_slope": "mechsheet"}.items():
        assert mistakes.undefined(name, known).endswith(
            f"in any cell (add from {source} import {name} to the setup, the first cell)"
        )
    assert "(add import numpy as np to the setup, the first cell)" in mistakes.undefined("np", known)
    assert mistakes.undefined("sinis", known).endswith("(did you mean sinus?)")
    assert mistakes.undefined("F", known, ["F"]).endswith("(did you mean g.F?)")
    assert mistakes.undefined("e", known, ["e"]).endswith("(did you mean g.e?)")
    assert "log: add from numpy import log to the setup, the first cell)" in mistakes.undefined("ln", known)
    assert mistakes.why(TypeError("unsupported operand type(s) for +: 'float' and 'str'"), ()).endswith("is no number)")
    assert mistakes.undefined("x·y", known).endswith(" (a product is written *)")
    assert mistakes.no_input("F·g", ["F"]) == "there is no input F·g (a product is written *)"


IN_WORDS = {  # what Python says in words about values that nobody sees in the line
    "a function as a number": ("f = lambda x: g.F * x  # [N] f\ny = 2 * f  # [N] y", "in its brackets, such as"),
    "a function in square brackets": ("f = lambda x: x  # [-] f\ny = f[2]  # [-] y", "in its brackets, such as"),
    "a choice of many": ("x = np.arange(3)  # [-] x\ny = 1 if x > 1 else 2  # [-] y", "np.where(condition, "),
    "no size is large enough": ("d = np.arange(3)  # [-] d\ny = d[d > 9][0]  # [-] y", "none meets the condition"),
    "rounding up of none": ("y = int(np.sqrt(-g.L))  # [-] y", "is none, as the root of a negative one"),
    "no return": ("def f(x):\n    x * 2\ny = 2 * f(1)  # [-] y", "a function without return gives None"),
    "two of no return": ("def f(x):\n    x * 2\ny, z = f(1)  # [-] y", "a function without return gives None"),
    "the greatest of none": ("d = np.arange(3)  # [-] d\ny = d[d > 9].max()  # [-] y", "none meets the condition"),
    "the most of none": ("y = max(d for d in range(3) if d > 9)  # [-] y", "none meets the condition"),
    "other lengths": (
        "y = np.arange(3) + np.arange(4)  # [-] y",
        "3 values, np.arange(4) has 4 values: they do not fit",
    ),
    "what does not exist": ("y = np.roots([1.0, np.nan, 2.0])  # [-] y", "as where a mechanism does not close"),
    "no one solution": (
        "y = np.linalg.solve(np.ones((2, 2)), [1, 2])  # [-] y",
        "is singular: its equations depend on each other",
    ),
    "a root of Python's": (
        "import math\ny = math.sqrt(-g.L / g.L)  # [-] y",
        "math.sqrt has no value for -g.L / g.L = -1",
    ),
    "the imaginary unit": ("y = 2 * j  # [-] y", "(the imaginary unit is 1j)"),
    "a switch": ("y = 2 * yes  # [-] y", "(did you mean True?)"),
    "another unit": ("from mechsheet.units import Rpm\ny = g.F  # [N] y", "unit Rpm is not known; nearest: rpm"),
    "marks without names": (
        "from mechsheet import figure\nx = np.arange(3)  # [-] x\nfig = figure('1', 'x', x, x, marks=2)",
        "figure 1: marks must be positions by their names",
    ),
    "a word of find": (
        "y = find(lambda x: x - 2, 0, 9, unknwon='x').value  # [-] y",
        "unknwon (did you mean unknown?)",
    ),
    "a word of find alone": ("y = find(lambda x: x - 2, gues=1.0).value  # [-] y", "are gues (did you mean guess?)"),
    "another name": ("y = find(lambda x: x, 0, 1, equal=0.5).value  # [-] y", "or the unknowns equal"),
}
REFUSED |= {what: (lines, GIVEN, "", said) for what, (lines, said) in IN_WORDS.items()}
MANY = "a = np.arange(3) * g.L  # [m] a\nb = np.arange(4) * g.L  # [m] b\n"
MATRIX = "A = np.array([[1.0, 2.0], [2.0, 4.0]]) * g.n  # [-] A\n"
BY_VALUES = {  # what a line computes with, by its name and value in the words of the worksheet
    "y = a[a > 9].min()  # [m] y": "a[a > 9] is empty: min takes at least one value",
    "y = min(v for v in a if v > 9)  # [m] y": "(v for v in a if v > 9) is empty: min takes at least one value",
    "p, q = a": "a has 3 values for 2 names: p, q",
    "p, q = g.L": "length L = 0.35 m is one number for 2 names: p, q",
    "y = a + b  # [m] y": "a has 3 values, b has 4 values: they do not fit each other",
    "y = a @ b  # [m] y": "a has 3 values, b has 4 values: they do not fit each other",
    "y = np.polyfit(a, b, 1)  # [-] y": "a has 3 values, b has 4 values: they do not fit each other",
    "y = np.interp(0.2, a, b)  # [m] y": "a has 3 values, b has 4 values: they do not fit each other",
    "y = np.array([a, b])  # [m] y": "a has 3 values, b has 4 values: they do not fit each other",
    "y = np.concatenate([a, g.L])  # [m] y": "a has 3 values, length L = 0.35 m is one number: they do not fit",
    "a[:] = [1.0, 2.0]": "a[:] has 3 values, [1.0, 2.0] has 2 values: they do not fit each other",
    f"{MATRIX}y = np.linalg.solve(A, [1.0, 2.0])  # [-] y": "A is singular: its equations depend on each other",
    "y = np.linalg.det(np.ones((2, 3)))  # [-] y": "np.ones((2, 3)) has 2 x 3 values: it must have as many rows as",
    "y = a[g.n]  # [m] y": "a has 3 values, counted from 0: there is none at number n = 3",
    "f = lambda i: a[i]  # [m] f\ny = f(5)  # [m] y": "a has 3 values, counted from 0: there is none at i = 5",
    "y = a[g.n / 3]  # [m] y": "g.n / 3 = 1.0: a place is a whole number, as int(g.n / 3)",
    "y = {'M6': 20.1}['M' + '8']  # [-] y": "{'M6': 20.1} has no 'M8' ('M' + '8'): it has 'M6'",
    "w = 'M8'\ny = g.L * w  # [m] y": "w = 'M8' is a text, no number",
    "w = 'M8'\ny = np.sqrt(w)  # [m] y": "w = 'M8' is a text, no number",
    "w = 'M8'\ny = float(w)  # [m] y": "w = 'M8' is no number",
    "f = lambda x: None\ny = f(2) + 1  # [m] y": "f(2) is None: a function without return gives None",
    "f = lambda x, z: x * z\ny = f(2)  # [m] y": "f is called without z",
    "y = g.L / (g.n - 3)  # [m] y": "division by zero: g.n - 3 = 0",
    "y = g.F ** 200  # [-] y": "g.F ** 200 is beyond the largest number, 1.8e308: force F = 1200 N",
    "import math\ny = math.sqrt(-g.L)  # [-] y": "math.sqrt has no value for -g.L = -0.35",
    "import math\nr = -g.L  # [mm] r\ny = math.sqrt(r)  # [-] y": "math.sqrt has no value for r = -350 mm",
    "import math\ny = math.sqrt(a)  # [-] y": "a has 3 values, where math.sqrt takes one number: np.sqrt computes each",
    "y = 1 if 1j * g.L > 0 else 2  # [-] y": "1j * g.L = 0.35j is complex, where a real number is taken",
    "y = max(g.L)  # [m] y": "length L = 0.35 m is one number, where several are taken",
    "y = np.where((a > 0) and (a < 9), 1, 2)  # [-] y": "of many values it is written (a > 0) & (a < 9)",
    "y = np.where(0 < a < 9, 1, 2)  # [-] y": "of many values it is written (0 < a) & (a < 9)",
    "y = np.sqroot(g.L)  # [m] y": "numpy has no sqroot (did you mean sqrt?)",
    "y = np.zeros(g.n - 5)  # [m] y": "g.n - 5 = -2 must not be negative",
    "assert g.L > 1\ny = g.L  # [m] y": "it does not hold: length L = 0.35 m",
    "assert not g.L\ny = g.L  # [m] y": "it does not hold: length L = 0.35 m",
    "for k in g.n + 1:\n    y = k": "g.n + 1 = 4 is one number, where several are taken",
    "y = [k for k in g.n + 1]  # [-] y": "g.n + 1 = 4 is one number, where several are taken",
    "y = {k: 1 for k in g.n}": "number n = 3 is one number, where several are taken",
    "w = g.L  # [m] w\nw.foo = 1": "w is a number, which has no foo",
    "y = min()  # [-] y": "min is called with 0 values, and takes at least 1",
    "import math\ny = math.atan2(1)  # [-] y": "atan2 is called with 1 value, and takes 2",
    "y = find(lambda x: x - a, np.zeros(4), np.ones(4)).value  # [m] y": "4 values and 3 values do not fit each other",
    "y = np.select([a > 0], [1, 2])  # [-] y": "list of cases must be same length",  # where none are better
}
REFUSED |= {lines: (MANY + lines, GIVEN, "", f": {said}") for lines, said in BY_VALUES.items()}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_refused(what: str, tmp_path: Path) -> None:
    lines, given, end, said = REFUSED[what]
    run = as_script(worksheet(tmp_path, lines, given, end))
    assert run.returncode == 1 and len(run.stderr.splitlines()) == 1 and said in run.stderr, run.stderr
    assert "is a * missing" not in run.stderr and not (tmp_path / "told.xlsx").exists()


@pytest.mark.parametrize("within", ["[math.sqrt(r) for r in a]", "{r: 1 / r for r in a}", "[sum([1 / r for r in a])]"])
def test_a_name_of_a_comprehension_is_not_told_with_the_value_of_another_one(within: str, tmp_path: Path) -> None:
    """Where it has one: from Python 3.12 on nobody knows it when the comprehension has failed."""
    lines = f"import math\na = [0.0, -2.0]\nr = 9.0  # [mm] r\ny = {within}"
    run = as_script(worksheet(tmp_path, lines))
    assert run.stderr.rstrip().endswith(("math.sqrt has no value for r = -2", "no value for r", "zero: r = 0")), (
        run.stderr
    )


def test_a_class_of_rows_with_values_of_its_own_is_told(tmp_path: Path) -> None:
    path = worksheet(tmp_path, Y, f"{GIVEN}\ncases: list[Case] = []  # load cases")
    begin = "@app.class_definition\n@inputs\nclass"
    rows = f"{begin} Case:\n    P: float = 1.0  # [N] load\n\n\n"
    path.write_text(path.read_text().replace(f"{begin} Given", f"{rows}{begin} Given", 1))
    run = as_script(path)
    assert "class Case of its rows has values: write P: float without one" in run.stderr, run.stderr


@pytest.mark.parametrize(
    ("read", "said"),
    [
        ("g.cases.p", "no column p (did you mean P?)"),
        ("g.cases['P']", "read by its name"),
        ("np.zeros(3)[g.cases.P[0]]", "a place is a whole number, as int("),
        ("2 * g.on", "no number: its"),
    ],
)
def test_how_a_column_or_a_property_is_read_is_told(read: str, said: str, tmp_path: Path) -> None:
    given = "cases: list[Case] = [Case(1.0), Case(2.0)]  # load cases\non: Case = one_of({'a': Case(3.0)}, 'a')  # case"
    path = worksheet(tmp_path, f"y = {read}  # [N] y", given)
    begin = "@app.class_definition\n@inputs\nclass"
    rows = f"{begin} Case:\n    P: float  # [N] load\n\n\n"
    path.write_text(path.read_text().replace(f"{begin} Given", f"{rows}{begin} Given", 1))
    run = as_script(path)
    assert run.returncode == 1 and len(run.stderr.splitlines()) == 1 and said in run.stderr, run.stderr


def test_a_whole_number_that_no_float_is_has_a_limit(tmp_path: Path) -> None:
    run = as_script(worksheet(tmp_path, "y = g.n * g.F  # [N] y"), "--n=1e30")
    assert "must be at most 9007199254740992 in size" in run.stderr, run.stderr


def test_several_lines_behind_one_another_are_computed(tmp_path: Path) -> None:
    run = as_script(worksheet(tmp_path, "y = g.F * g.L; z = 3  # [N*m] moment"))
    assert run.returncode == 0, run.stderr


def test_warnings_of_what_is_written_are_told_once(tmp_path: Path) -> None:
    """At every reading of the file. Of a backslash, as of formulas in texts, Python warns from 3.12 on."""
    run = as_script(worksheet(tmp_path, "y = g.F  # [N] y\nsame = g.F is 5.0\ntext = 'with $\\phi$'"))
    compared, *others = sorted(run.stderr.splitlines())
    assert 'told.py, line 35, same = g.F is 5.0: "is" with' in compared, run.stderr
    assert all(line.endswith("""(a text with \\ is written r"..")""") for line in others), run.stderr
    assert run.returncode == 0 and (len(others) == 1 or (not others and sys.version_info < (3, 12)))


def test_warnings_of_what_a_line_calls_are_told_at_the_line(tmp_path: Path) -> None:
    """They named a file of numpy's, with a line of its source."""
    run = as_script(worksheet(tmp_path, "x = g.L * np.arange(3)  # [m] x\ny = x[x > 99].mean()  # [m] mean"))
    assert len(run.stderr.splitlines()) == 2, run.stderr
    assert all("told.py, line 35, y = x[x > 99].mean(): " in line for line in run.stderr.splitlines()), run.stderr


@pytest.mark.parametrize("command", ["run", "html", "scenes", "scenes side by side", "compare", "index", "design"])
def test_warnings_are_told_in_a_line_by_whatever_command(command: str, tmp_path: Path) -> None:
    """Each as often as there are lines that it warns of: two lines of Python's own were told, of each process."""
    path = worksheet(tmp_path, "same = g.F is 5.0\ny = np.array([g.L]) / (g.n - g.n)  # [m] y")
    scenes = [tmp_path / f"{name}.toml" for name in "ab"]
    for k, scene in enumerate(scenes):
        scene.write_text(f"[inputs]\nF = {k + 3}\n")
    out = f"--out={tmp_path}"
    given = {
        "run": ["run", path, out],
        "html": ["html", path, out],
        "scenes": ["run", path, *scenes, out],
        "scenes side by side": ["run", path, *scenes, "--jobs=2", out],
        "compare": ["compare", path, *scenes],
        "index": ["index", path],
        "design": ["design", path, "--vary=F=1..2", "--best=max F"],
    }[command]
    compared, *others = as_launched(*given).stderr.splitlines()
    assert 'told.py, line 34, same = g.F is 5.0: "is" with' in compared
    if command == "index":  # which runs nothing, and finds nothing to list here
        assert len(others) == 1 and others[0].startswith("error: ")
    else:
        line = "told.py, line 35, y = np.array([g.L]) / (g.n - g.n): divide by zero encountered in divide"
        assert others == [line]


@pytest.mark.parametrize("ends", ["z = 1 / 0", "z = find(lambda x: x**2 + 1, 0.0, 1.0).value"])
def test_an_error_that_ends_the_run_says_alone_what_is_invalid(ends: str, tmp_path: Path) -> None:
    lines = "x = g.L * np.zeros(3)  # [m] x\ny = x / x  # [-] y"
    whole = as_script(worksheet(tmp_path, lines))
    assert whole.stderr.endswith("told.py, line 35, y = x / x: invalid value encountered in divide\n"), whole.stderr
    run = as_script(worksheet(tmp_path, f"{lines}\n{ends}"))
    assert run.returncode == 1 and len(run.stderr.splitlines()) == 1, run.stderr
    assert run.stderr.startswith("error: ") and "invalid value" not in run.stderr


def test_units_that_do_not_fit_are_told_three_at_a_time_in_units_of_mechanics(tmp_path: Path) -> None:
    lines = "\n".join(f"y_{k} = {k} * g.F * g.L  # [N] moment" for k in range(1, 6))
    run = as_script(worksheet(tmp_path, lines))
    assert run.stdout.count("does not fit; the value is in N·m") == 3 and "and 2 more" in run.stdout, run.stdout


@pytest.mark.parametrize(("typed", "meant"), [("Nmm", "N*mm"), ("kNm", "kN*m"), ("Nm", "N*m"), ("KN", "kN")])
def test_units_that_run_together_are_told_apart(typed: str, meant: str, tmp_path: Path) -> None:
    run = as_script(worksheet(tmp_path, f"y = g.F * g.L  # [{typed}] moment"))
    assert f"unit [{typed}] is not known; nearest: {meant}" in run.stdout, run.stdout


def test_a_proof_tells_what_does_not_exist(tmp_path: Path) -> None:
    run = as_script(worksheet(tmp_path, "y = np.sqrt(g.L - 1)  # [-] none\nz = 2 * g.F  # [N] twice"), "--proof")
    assert "1 of 2 do not exist" in run.stdout and "pass  every number proved" in run.stdout, run.stdout
    run = as_script(worksheet(tmp_path, "y = np.sqrt(g.L - 1)  # [-] none"), "--proof")
    assert run.returncode == 1 and "not evaluated  every number proved" in run.stdout, run.stdout


def test_a_slope_is_looked_at_in_several_places(tmp_path: Path) -> None:
    """A workbook looked at the middle position alone, and passed what is wrong beside it."""
    lines = """x = np.linspace(0, 2 * g.L, 21)  # [m] places
ok = check_slope("slope", 2 * g.F * x, lambda x: g.F * x**2, x, 0, 2 * g.L, "N*m")"""
    assert as_script(worksheet(tmp_path, lines)).returncode == 0
    names = [row[0] for row in load_workbook(tmp_path / "told.xlsx")["Checks"].iter_rows(values_only=True)]
    assert "slope, at three of the positions" in names


def test_a_condition_of_the_workbook_names_its_lines(tmp_path: Path) -> None:
    lines = "w = 'many' if g.n > 2 else 'few'\ny = len(w) * g.F  # [N] by a text"
    as_script(worksheet(tmp_path, lines))
    rows = load_workbook(tmp_path / "told.xlsx")["Checks"].iter_rows(values_only=True)
    assert any(str(row[0]).startswith("made for these inputs") and row[5] == "looked at in line 35" for row in rows)


def test_a_file_that_is_no_text_is_no_scene_to_rename_in(tmp_path: Path) -> None:
    path = worksheet(tmp_path, "y = g.F  # [N] y")
    (tmp_path / "other.toml").write_bytes(b"\xff\xfe")
    assert as_command(rename, path, "y", "w").returncode == 0 and "w = g.F" in path.read_text()


def test_a_design_that_the_worksheet_refuses_is_told(tmp_path: Path) -> None:
    """The scene was written without a word, and its run failed."""
    path = worksheet(tmp_path, 'y = 2 * g.F  # [N] twice\nok = check("y", y, 2500, "N")')
    run = as_command(asked_design, path, "--vary=F=500..2000", "--best=max y")
    assert run.returncode == 0 and "with it: FAIL  y: 4000 <= 2500 N" in run.stdout, run.stdout + run.stderr


def test_commands_that_would_harm_are_refused() -> None:
    """A worksheet named as a module breaks all others beside it; a page without a password is everybody's."""
    for name in ("platform", "numpy", "marimo", "random", "class"):
        assert refusal("new", name).endswith(f"is one of Python's, as which it would be read: give {name}_1")
    told = "--host=0.0.0.0 shows the pages to whoever is on the network: give --password-file=FILE"
    assert told in refusal("serve", "guide", "--host=0.0.0.0") and told in refusal("serve", "--host", "0.0.0.0")
    for port in ("99999", "-1", "x"):
        assert f"port = {port} must be a number from 1 to 65535" in refusal("edit", "guide", f"--port={port}")


def test_a_unit_without_brackets_is_told(tmp_path: Path) -> None:
    """Such a line was neither typeset nor mentioned."""
    run = as_script(worksheet(tmp_path, "s = g.F / g.L**2  # MPa stress"))
    says = "told.py, line 34, s = g.F / g.L**2: # MPa stress has no brackets: # [MPa] stress"
    assert run.returncode == 0 and says in run.stdout, run.stdout


@pytest.mark.parametrize(
    ("name", "told"),
    [("hour", "unit hour is not known; nearest: h"), ("Newton", "unit Newton is not known; nearest: N"),
     ("kw", "unit kw is not known; nearest: kW"), ("qqqq", "mechsheet.units has no qqqq")],
)  # fmt: skip
def test_of_a_unit_that_is_taken_in_by_another_name_the_one_that_is_meant_is_told(name: str, told: str) -> None:
    with pytest.raises(ImportError) as raised:
        exec(f"from mechsheet.units import {name}")
    assert mistakes.why(raised.value, ()) == told
