"""Bands of results within the tolerances of inputs: against random cases, by hand, and what is said of checks."""

import re
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import until
from own_worksheet import own
from playwright.sync_api import expect

from mechsheet.document import parts
from mechsheet.page import study
from mechsheet.page.of_file import refusing_another
from mechsheet.readers.banded import Banded, run_bands
from mechsheet.readers.bands import Band, Bands, tolerances
from mechsheet.readers.enclosed import enclosed
from mechsheet.recording.record import record
from mechsheet.run import arguments, banding, batch, studied, within
from mechsheet.run.within import cases
from mechsheet.studies.sweep import sweep
from mechsheet.studies.tolerance import tolerance
from mechsheet.worksheet import cells
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Table

GUIDE = Path(__file__).parents[1] / "worksheets" / "guide.py"
EXAMPLES = Path(__file__).parents[1] / "worksheets" / "examples"
PART = 1e-4  # of an input: so little that nothing bends by more than its square


def toleranced(tmp_path: Path, name: str) -> cells.Worksheet:
    """An example whose every number has a tolerance."""
    text = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
    text = re.sub(r"; ± [^;\n]*", "", text)
    text = re.sub(r"(?m)^(    \w+: float = .*  # \[.*)$", rf"\1; ± {100 * PART} %", text)
    for data in EXAMPLES.glob("*.csv"):
        (tmp_path / data.name).write_bytes(data.read_bytes())
    path = tmp_path / f"{name}.py"
    path.write_text(text, encoding="utf-8")
    return cells.load(path)


def bands(sheet: cells.Worksheet):
    """All bands of a worksheet, and its namespace."""
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    shown = parts.values(names)
    tables, checks = ([v for v in shown if isinstance(v, kind)] for kind in (Table, Check))
    by = tolerances(names["g"])
    known = registry(names)
    run = partial(cases, names["g"], sheet, sheet.results, known, by)
    return run_bands(record(names, sheet, whole=True, every=1), tables, checks, known, by, run), names


@pytest.mark.parametrize("name", ["bucket", "engine", "bolted_joint"])
def test_every_random_case_is_where_the_slopes_say(name, tmp_path):
    """Every result of worksheets that are no test's own, found values among them."""
    sheet = toleranced(tmp_path, name)
    found, names = bands(sheet)
    shown = {field.name: field for field in declared(sheet.inputs)}
    drawn = np.random.default_rng(20).uniform(-1, 1, (len(found.by), 6))
    own_values = {x: shown[x].display(getattr(names["g"], x)) for x in found.by}
    variants = {x: v + abs(v) * PART * d for (x, v), d in zip(own_values.items(), drawn, strict=True)}
    assert not any("it bends" in told for told in found.lines()), "what rounding leaves of a difference is no bend"
    results = [b for b in found.banded if b.where == "results" and np.max(b.band.worst) > 1e-12]  # no mere rounding
    assert len(results) > 10
    swept = sweep(sheet.path, dict.fromkeys(b.name.split(".")[0] for b in results), variants)
    assert swept.solved.all()
    for b in results:
        values = np.asarray(cells.value(b.name, swept)) if "." in b.name else swept[b.name]
        off = values.reshape(6, -1) - np.asarray(cells.value(b.name, names)).reshape(1, -1)
        said = drawn.T @ b.band.moves.reshape(len(drawn), -1)
        size = np.max(b.band.worst)
        assert np.max(np.abs(off - said)) <= 50 * PART * size + 1e-13 * np.max(np.abs(values)), b.name


OFF = ("F: float = 2.5  # [-] number", "a: float = 0.75  # [-] part")
LINES = """
from mechsheet import check
y = 2 * g.F + g.a  # [-] line
w = abs(g.F - 2.5)  # [-] with a corner
c = check("below", y, LIMIT)"""


CANCELLED = """
p = g.F * linspace(0.1, 0.7, 9) ** 2 * 0.7 / (1.1 * g.F)  # [-] whatever F is
q = p + 1e-9 * g.F  # [-] hardly moved by it"""
TEXT = '\nz = float(f"{g.F:.17g}") * g.a  # [-] by way of a text'


def off(tmp_path: Path, limit: float, F: str = "± 1", a: str = "± 0.5", more: str = "") -> cells.Worksheet:
    sheet = own(tmp_path, LINES.replace("LIMIT", str(limit)) + more)
    path = Path(sheet.path)
    text = path.read_text(encoding="utf-8")
    for line, tolerance_of in zip(OFF, (F, a), strict=True):
        text = text.replace(line, f"{line}; {tolerance_of}" if tolerance_of else line)
    path.write_text(text, encoding="utf-8")
    return cells.load(path)


def test_worst_case_root_of_squares_and_what_is_not_followed(tmp_path):
    found, _ = bands(off(tmp_path, 9, more=f"{TEXT}\ns = g.a  # [-] the same\nP = 1 + 1j * g.F  # [-] point"))
    by_name = {b.name: b for b in found.banded}
    assert (by_name["y"].worst.tolist(), by_name["y"].squares.tolist()) == ([2.5], [4.25**0.5])
    assert by_name["w"].worst.tolist() == [1.0], "the steeper side"
    assert "line 42" in by_name["z"].cells()[-1]
    assert (by_name["s"].worst.tolist(), by_name["P.imag"].worst.tolist()) == ([0.5], [1.0]), "an input by another name"
    table = next(b for b in found.banded if b.where == "table 1")
    assert np.allclose(table.worst, np.linspace(0.1, 2, 5))
    assert re.search(r"table 1 +x .*± 2 .*in row 5", "\n".join(found.lines()))


def test_rounding_is_no_band(tmp_path):
    found, _ = bands(off(tmp_path, 9, more=CANCELLED))
    by_name = {b.name: b for b in found.banded}
    assert "p" not in by_name
    assert np.allclose(by_name["q"].worst, 1e-9, rtol=1e-6)


def test_how_many_rows_there_are_does_not_move(tmp_path):
    """A mean of values found for as many problems as there are, whatever these are moved by."""
    found, _ = bands(
        off(
            tmp_path,
            9,
            more="""
r = find(lambda u, v: (u**2 - np.arange(1, g.n) * g.F, v - u), u=(0.0, 90.0), v=(0.0, 90.0))
m = np.mean(r.value.u**2)  # [-] mean""",
        )
    )
    band = next(b for b in found.banded if b.name == "m")
    assert np.allclose(band.worst, np.mean(np.arange(1, 5)))


@pytest.mark.parametrize(
    ("limit", "F", "a", "said"),
    [
        (9.0, "± 1", "", "in all the tolerances"),
        (6.75, "± 1", "", r"in 7[45](\.\d)? % of cases, fails at worst"),  # of y = 5.75 ± 2
        (6.75, "± 1 normal", "", r"in 93\.\d % of cases, fails at worst"),  # half a length is 1.5 standard deviations
        (7.70, "± 1", "", "in 98.[5-9] % of cases, fails at worst"),
        (8.2, "± 1 normal", "± 0.5", r"in more than 99.9 % of cases, fails at worst"),
        (4.75, "± 1", "", "holds in 2[456] % of cases"),
        (3.0, "± 1", "", "in all the tolerances"),
    ],
)
def test_a_check_says_how_sure_it_is(limit, F, a, said, tmp_path):
    found, names = bands(off(tmp_path, limit, F, a))
    assert re.fullmatch(said, found.sure["below"]), found.sure
    assert found.told(names["c"]) == f"{names['c']}; {found.sure['below']}"


OVER = {
    "over": "np.maximum(y - LIMIT, 0)",
    "the other way round": "np.maximum(0.0, y - LIMIT)",
    "by Python": "max(y - LIMIT, 0)",
    "of many": "np.maximum(np.array([y - LIMIT, -1.0, y - 2 * LIMIT]), 0)",
    "greatest of many": "np.maximum(np.array([y - LIMIT, -1.0]), 0).max()",
    "size": "abs(np.maximum(y - LIMIT, 0))",
    "twice": "np.maximum(np.maximum(y - LIMIT, -3), 0)",
}


@pytest.mark.parametrize(
    ("limit", "F"), [(9.0, "± 1"), (6.75, "± 1"), (6.75, "± 1 normal"), (4.75, "± 1"), (3.0, "± 1")]
)
def test_what_is_over_a_limit_is_as_sure_as_the_limit_itself(limit, F, tmp_path):
    """Its slope is that of one side alone: 0 where it is kept, though it fails within the tolerances."""
    more = "".join(f'\ncheck_{n} = check("{name}", {text}, 0.0)' for n, (name, text) in enumerate(OVER.items()))
    found, _ = bands(off(tmp_path, limit, F, "", more.replace("LIMIT", str(limit))))
    assert {name: found.sure[name] for name in OVER} == dict.fromkeys(OVER, found.sure["below"])


JUMPS = {
    "whole number": "math.ceil(g.F / 3.4)",
    "rounded": "round(g.F)",
    "floored": "np.floor(g.F)",
    "sign": "np.sign(g.F - 3)",
    "remainder": "g.F % 2.6",
    "how many go in": "(0.2 * g.F + 8.3) // g.F",
    "standard size": "next(size for size in (1, 2, 3, 4, 6) if g.F <= size)",
    "branch of Python": "1.0 if g.F < 3 else 4.0",
    "choice": "np.where(g.F < 3, g.F, 2 * g.F)",
    "place in a list": "np.searchsorted([1.0, 2, 3, 4], g.F)",
    "first of the greatest": "np.argmax(np.array([1.2 * g.F, 3.3]))",
    "loop": "first_over(g.F)",
    "of a Find": "find(lambda x: x - np.where(g.F < 3, 1.0, 2.0), 0.0, 9.0).value",
}
FIRST_OVER = """
SIZES = np.array([1.0, 2.0, 3.0, 4.0])
def first_over(x):
    for size in SIZES:
        if x <= size:
            return size
    raise ValueError("too large")
"""


@pytest.mark.parametrize("text", JUMPS.values(), ids=JUMPS)
def test_what_jumps_within_the_tolerances_is_told_by_cases(text, tmp_path, monkeypatch):
    """By slopes it rests, or moves on: F = 2.5 ± 1 is on both sides of 3."""
    more = f"""{FIRST_OVER}
j = {text}  # [-] jumps
r = 4 + 2 * j + g.a  # [-] rests on it
check_2 = check("jumping", r, R_LIMIT)"""
    alone = off(tmp_path, 9, "", "", more.replace("R_LIMIT", "0"))
    there = sweep(alone.path, ["r"], {"F": np.linspace(1.5, 3.5, 201)})["r"].tolist()
    monkeypatch.setattr(within, "COUNT", 250)
    own = there[100]
    other = max(there, key=lambda x: abs(x - own))
    limit = own + 0.25 * abs(other - own) if other > own else own - 0.25 * abs(other - own)
    found, names = bands(off(tmp_path, 9, "± 1", "", more.replace("R_LIMIT", str(limit))))
    by_name = {b.name: b for b in found.banded}
    assert "it jumps" in by_name["j"].cells()[-1] and "goes another way by F" in by_name["r"].cells()[-1]
    ends = [float(end) for end in re.search(r"it jumps: (\S+)\.\.(\S+) in", by_name["r"].cells()[-1]).groups()]
    assert np.allclose(ends, [min(there), max(there)], atol=0.05), "the span of all cases"
    holds = np.mean(np.array(there) <= limit)
    told = re.match(r"(?:holds )?in (\S+) % of cases", found.sure["jumping"])
    assert names["check_2"].passed == (other > own) and float(told[1]) / 100 == pytest.approx(holds, abs=0.06)


@pytest.mark.parametrize(
    "text",
    ["np.interp(g.F, [0.0, 3.0, 9.0], [0.0, 3.0, 9.5])", "max(g.F, 2.0)", "g.F if g.F < 3 else 3 + 1.01 * (g.F - 3)"],
)
def test_what_only_goes_on_in_another_way_keeps_its_band(text, tmp_path):
    found, _ = bands(off(tmp_path, 9, "± 1", "", f"\nk = {text}  # [-] bends"))
    assert np.allclose(next(b for b in found.banded if b.name == "k").worst, 1.0)


@pytest.mark.parametrize(
    ("text", "worst"),
    [("np.interp(g.F, [0.0, 2.5, 9.0], [0.0, 5.0, 31.0])", 4.0), ("g.F if g.F < 2.6 else 2.6 + 1.01 * (g.F - 2.6)", 1)],
)
def test_what_goes_on_in_another_way_right_there_keeps_its_band_too(text, worst, tmp_path):
    """At an abscissa of a table by the steeper side; a normal one gets farther off than its tolerance, as few do."""
    for distribution in ("", " normal"):
        found, _ = bands(off(tmp_path, 9, f"± 1{distribution}", "", f"\nk = {text}  # [-] bends"))
        assert np.allclose(next(b for b in found.banded if b.name == "k").worst, worst)


def test_what_bends_where_a_line_goes_another_way_is_not_said_to_jump(tmp_path, capsys):
    more = "\nk = 1 / (g.F if g.F < 2.6 else 2.6 + 1.01 * (g.F - 2.6))  # [-] bends"
    sheet = off(tmp_path, 9, "± 0.5", "", more)
    found, _ = bands(sheet)
    assert "it jumps or bends: " in next(b for b in found.banded if b.name == "k").cells()[-1]
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=k"], declared(sheet.inputs)))
    assert "k: no slopes, it jumps or bends: 0.33" in capsys.readouterr().out


def test_random_cases_without_a_value_leave_those_that_have_one(tmp_path, capsys):
    more = "\nk = next(size for size in (1.0, 2.0, 3.0) if size >= g.F) * g.a  # [-] size\ns = g.F + g.a  # [-] sum"
    sheet = off(tmp_path, 9, "± 1", "± 0.5", more)
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=k,s"], declared(sheet.inputs)))
    out = capsys.readouterr().out
    low, high = (float(end) for end in re.search(r"^2\.25 .* (\S+)\.\.(\S+)$", out, re.MULTILINE).groups())
    assert "nan" not in out and 0.5 <= low < 0.55 and 3.7 < high <= 3.75


def test_what_is_whole_is_guaranteed_as_a_whole_number(tmp_path):
    sheet = off(tmp_path, 9, "± 0.2", "", "\nr = (g.n + 1) % 3  # [-] rest\nk = np.floor(g.F)  # [-] whole")
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording, by = record(names, sheet, whole=True, every=1), tolerances(names["g"])
    nodes = [recording.values[name].re for name in ("r", "k")]
    bounds = enclosed(nodes, {recording.inputs[x]: t.size for x, t in by.items()})
    assert [[float(end) for end in bounds[node]] for node in nodes] == [[0, 0], [2, 2]]


@pytest.mark.parametrize(("distribution", "told"), [("", 0), (" normal", 1)])
def test_what_is_guaranteed_is_not_of_cases_beyond_a_normal_tolerance(distribution, told, tmp_path, capsys):
    sheet = off(tmp_path, 9, f"± 1{distribution}", "", "\ns = 2 * g.F  # [-] twice")
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=s"], declared(sheet.inputs)))
    out = capsys.readouterr().out
    least, low = re.search(r"^5 .* (\S+)\.\.\S+ +(\S+)\.\.\S+$", out, re.MULTILINE).groups()
    assert out.count("no guaranteed bound holds") == told == (float(least) < float(low))


def test_a_bound_is_shown_rounded_so_that_it_still_holds(tmp_path, capsys):
    sheet = off(tmp_path, 9, "± 1", "", "\ns = 2 * g.F / 3  # [-] part\nt = 7 - 2 * g.F / 3  # [-] rest")
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=s,t"], declared(sheet.inputs)))
    found = re.findall(r"^\d\S* .* (\S+)\.\.(\S+)$", capsys.readouterr().out, re.MULTILINE)
    assert found == [("1", "2.33334"), ("4.66666", "6")], "F is 2.5 with a tolerance of 1: 7 / 3 and 14 / 3 lie between"


CHOSEN = """
kinds = {"small": 1.0, "large": 2.0}
kind = "small" if g.F < 3 else "large"
s = kinds[kind.strip("!")]  # [-] by a text
out = [1]
while len(out) < g.F:
    out.append(1)
k = len(out)  # [-] how many there are
n_b = np.sum(np.where(np.array([g.F, 2 * g.F]) > 3.2, 1, 0))  # [-] large ones
e = max(g.F - 2.6, 0)  # [-] what is over
R = float("8.5") * 2  # [-] of a text"""


def test_wanted_results_that_python_chooses_are_not_guaranteed_to_keep_still(tmp_path, capsys):
    sheet = off(tmp_path, 9, "± 1", "", CHOSEN)
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=s,k,n_b,e,R"], declared(sheet.inputs)))
    out = capsys.readouterr().out
    for told in (r"s: no slopes, it jumps: 1\.\.2 in .*\n.*\n1 +– +– +1\.\.2\n", r"k: no slopes, it jumps: 2\.\.4 in"):
        assert re.search(told, out), told
    assert re.search(r"n_b: no slopes, it jumps: 0\.\.2 in .*\n.*\n1 +– +– +0\.\.2 +0\.\.2\n", out), "whole numbers"
    assert "e: no slopes, it bends: 0..0.9 in" in out and "\nR: keeps still\n" in out


TOLD = """
t = np.sqrt(np.array([g.F - 2.0, g.F]))  # [-] none for some
word = "few" if g.F < 3 else "many"
check_3 = check(f"called {word}", g.F, 9)
if g.F > 3.4:
    raise ValueError("no size for that")"""
SLOPE = """
from mechsheet import check_slope
check_5 = check_slope("of a square", 2 * x, lambda x: x**2, x, 0, 9)"""


FOLLOWED = [text for kind, text in JUMPS.items() if kind != "loop"]


@pytest.mark.parametrize("text", [*FOLLOWED, FIRST_OVER + SLOPE, TOLD])
def test_recordings_of_few_cases_tell_what_runs_one_by_one_do(text, tmp_path, monkeypatch):
    is_line = not text.startswith("\n")
    more = f"{FIRST_OVER}\nj = {text}  # [-] jumps" if is_line else f"\nj = np.floor(g.F)  # [-] jumps{text}"
    sheet = off(tmp_path, 7, "± 1", "± 0.5 normal", f"{more}\ncheck_2 = check('jumping', j + g.a, 3)")
    monkeypatch.setattr(within, "COUNT", 400)
    names, run, runs = sheet.run(sheet.results, {"g": sheet.inputs()}), cells.Worksheet.run, []
    monkeypatch.setattr(cells.Worksheet, "run", lambda *args: runs.append(1) or run(*args))
    given = names["g"], sheet, sheet.results, registry(names), tolerances(names["g"])
    fast, few = cases(*given), len(runs)
    slow = cases(*given, ways=0)
    assert few < 150 < 400 < len(runs) - few, "few cases are run"
    assert (fast.lost, fast.reason) == (slow.lost, slow.reason) and fast.spans.keys() == slow.spans.keys()
    for key, span in slow.spans.items():
        assert np.allclose(fast.spans[key], span, rtol=1e-9, equal_nan=True), key
    for name, holds in slow.holds.items():
        told = fast.holds if name in fast.holds else fast.ran.holds
        assert np.array_equal(told[name], holds), name
    assert set(fast.holds) <= set(slow.holds)


@pytest.mark.parametrize(
    "more", [f"\nj = np.floor(g.F)  # [-] jumps{TEXT}", f"{FIRST_OVER}\nj = first_over(g.F)  # [-] jumps"]
)
def test_what_no_recording_tells_runs_one_by_one(more, tmp_path, monkeypatch):
    sheet = off(tmp_path, 7, "± 1", "± 0.5", more)
    monkeypatch.setattr(within, "COUNT", 150)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    given = names["g"], sheet, sheet.results, registry(names), tolerances(names["g"])
    fast, slow = cases(*given), cases(*given, ways=0)
    assert all(np.array_equal(fast.spans[key], span) for key, span in slow.spans.items()) and fast.ran is None


def test_a_verdict_that_rests_on_a_jump_and_is_the_same_in_all_cases_says_so(tmp_path, capsys):
    more = "\nj = np.floor(g.F)  # [-] jumps\ncheck_2 = check('jumping', j, 9)\ncheck_3 = check('failing', j, 0.5)"
    sheet = off(tmp_path, 9, "± 1", "", more)
    found, _ = bands(sheet)
    for name in ("jumping", "failing"):
        assert re.fullmatch(r"in all of 1000 random cases \(line 42 goes another way by F\)", found.sure[name])
    asked = arguments.read(["--tolerances", "--want=j,jumping"], declared(sheet.inputs))
    assert batch.answer(sheet.path, asked) == 1, "one fails"
    out = capsys.readouterr().out
    assert "j: no slopes, it jumps: 1..3 in 1000 random cases (line 42 goes another way by F)" in out
    assert re.search(r"^2 +– +– +1\.\.3", out, re.MULTILINE) and "jumping: pass in all of 1000 random cases" in out


def test_a_lost_case_names_its_line_and_takes_no_other_result_with_it(tmp_path, capsys):
    path = Path(off(tmp_path, 9, "± 1", "± 0.5", "\npass").path)
    cell = """@app.cell
def sized(g):
    size = min(size for size in (1.0, 2.0, 3.0) if size >= g.F)  # [-] next size
    return (size,)

"""
    path.write_text(path.read_text(encoding="utf-8").replace("if __name__", f"{cell}if __name__"), encoding="utf-8")
    sheet = cells.load(str(path))
    found, _ = bands(sheet)
    assert re.search(r"no numbers: own\.py, line \d+, size = min\(.*\) is empty: min takes", "\n".join(found.lines()))
    asked = arguments.read(["--tolerances", "--want=y,size"], declared(sheet.inputs))
    batch.answer(sheet.path, asked)
    out = capsys.readouterr().out
    assert re.search(r"^5\.75 .*\d\.\.8\.\d+", out, re.MULTILINE) and out.count("random cases have no value") == 1
    assert re.search(r"have no value: own\.py, line \d+, size", out)


AT_ITS_LEAST = """
e = (g.F - 2.5) ** 2  # [-] least at the value itself
s = 2 if e < 0.04 else 5  # [-] size by it
z = np.sqrt(g.F - 2.0)  # [-] none for some
w = np.where(g.F < 2.2, 20, 1) * z  # [-] jumps, and none for some
check_2 = check("least", e, 0.5)
check_3 = check("greatest", 0.9 / np.cos(g.F - 2.5), 1)
check_4 = check("size", 3 * s, 10)
check_5 = check("there", z, 1)
check_6 = check("far", e, 1.1)
t = cos(2 * np.pi * g.F)  # [-] the same at both ends
v = np.arcsin(min(g.F / 2.5, 1.0))  # [-] upright at the value itself
check_8 = check("upright", v, at_least=1.6)
check_7 = check("turning", np.angle(exp(1j * 1.2 * g.F)), at_least=-2.6)"""


def test_what_slopes_mislead_about_is_told_by_cases(tmp_path):
    """At its least a number moves by no slope at all, and still by the tolerance."""
    found, _ = bands(off(tmp_path, 9, "± 1", "± 0.5", AT_ITS_LEAST))
    share = {"least": 0.71, "greatest": 0.45, "size": 0.2, "there": 0.5, "turning": 0.77}
    for name, part in share.items():
        told = re.fullmatch(r"in (\S+) % of cases, fails at worst \(.*(bends|by F)\)", found.sure[name])
        assert told and float(told[1]) / 100 == pytest.approx(part, abs=0.06), name
    assert found.sure["far"] == "in all the tolerances"
    by_name = {b.name: b.cells() for b in found.banded}
    assert re.match(r"it bends: \S+\.\.1 in 1000 random cases", by_name["e"][-1])
    assert re.match(r"it bends: -1\.\.\S+ in 1000 random cases", by_name["t"][-1])
    assert re.match(r"it bends: 0\.64\d+\.\.1\.5708 in 1000 random cases", by_name["v"][-1])
    assert found.sure["upright"] == "in all of 1000 random cases (it bends)", "it is a quarter of a turn at most"
    assert by_name["s"][-1].startswith("it bends: 2..5 in")
    assert by_name["z"][-1] == by_name["w"][-1] == "it ends within the tolerances"


def test_what_bends_to_where_a_line_goes_another_way_jumps(tmp_path):
    """By its slope the square of 2.5 ± 1 gets to 11.25, and in truth to 12.25."""
    more = "\ns = np.where(g.F**2 > LIMIT, 1, 2) * g.a  # [-] size by a square"
    for limit, jumps in (("11.5", True), ("12.5", False)):
        found, _ = bands(off(tmp_path, 9, "± 1", "± 0.5", more.replace("LIMIT", limit)))
        told = next(b for b in found.banded if b.name == "s").cells()[-1]
        assert told.startswith("it jumps or bends: 0.25..2.5 in") == jumps and (told == "") != jumps


BENDING = """
check_2 = check("just so", g.F**2, 11.4)
check_3 = check("mostly", g.F**2, 10.0)
check_4 = check("from below", g.F**2, at_least=2.2)
check_5 = check("never", 3 * g.F - g.F**2 / 4, 5.9)
check_6 = check("always", g.F**2, 12.3)"""


def test_how_sure_a_check_is_where_it_bends_is_told_by_cases(tmp_path):
    """By its slope the square of 2.5 ± 1 is 1.25..11.25, and in truth 2.25..12.25."""
    found, _ = bands(off(tmp_path, 9, "± 1", "", BENDING))
    for name, part in {"just so": (11.4**0.5 - 1.5) / 2, "mostly": (10**0.5 - 1.5) / 2}.items():
        told = re.fullmatch(r"in (\S+) % of cases, fails at worst \(it bends\)", found.sure[name])
        assert told and float(told[1]) / 100 == pytest.approx(part, abs=0.04), name
    assert found.sure["from below"] == "in all of 1000 random cases (it bends)"
    assert found.sure["always"] == "in all the tolerances"
    share = (3.5 - (6 - np.sqrt(36 - 4 * 5.9))) / 2
    told = re.fullmatch(r"holds in (\S+) % of cases(?: \(it bends\))?", found.sure["never"])
    assert float(told[1]) / 100 == pytest.approx(1 - share, abs=0.04)


def test_all_ends_of_few_tolerances_are_looked_at(tmp_path):
    """What has a value at seven of eight ends."""
    sheet = off(tmp_path, 9, "± 1", "± 0.5", "\nz = np.sqrt(1.8 - g.F + g.a + g.b)  # [-] none for some")
    path = Path(sheet.path)
    third = "    b: float = 1.5  # [-] third; ± 0.5\n    n: int"
    path.write_text(path.read_text(encoding="utf-8").replace("    n: int", third, 1), encoding="utf-8")
    found, _ = bands(cells.load(path))
    assert next(b for b in found.banded if b.name == "z").cells()[-1] == "it ends within the tolerances"


@pytest.mark.parametrize("name", ["seed", "count", "method", "want", "inputs", "g"])
def test_inputs_may_be_called_as_what_a_study_is_asked_is(name, tmp_path, capsys):
    path = Path(off(tmp_path, 9, more=f"\ns = g.F * g.{name}  # [-] product").path)
    more = f"    {name}: float = 3.0  # [-] named so\n    n: int"
    path.write_text(path.read_text(encoding="utf-8").replace("    n: int", more, 1), encoding="utf-8")
    sheet = cells.load(path)
    given = arguments.read(["--tolerances", "--want=s", "--F=5"], declared(sheet.inputs))
    batch.answer(sheet.path, replace(given, inputs={**given.inputs, name: "4"}))
    assert re.search(r"^20 .* 16\.0\d+\.\.23\.9\d+ +16\.\.24$", capsys.readouterr().out, re.MULTILINE)
    g = sheet.inputs(F=5.0, **{name: 4.0})
    _, table_1 = studied.matters({"g": g, "__file__": sheet.path}, "s", "0")
    assert dict(zip(table_1.columns[0].values, table_1.columns[4].values, strict=True)) == {"F": 4, name: 5, "a": 0}


def test_random_cases_of_a_result_called_as_an_input_are_in_its_unit(tmp_path, capsys):
    sheet = off(tmp_path, 9, "± 1", "", "\nF = 4 * g.F  # [kN] force, called as a number is")
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=F"], declared(sheet.inputs)))
    out = capsys.readouterr().out
    assert re.search(r"^0\.01 +± 0\.004 +± 0\.004 +0\.0060\d+\.\.0\.0139\d+ +0\.006\.\.0\.014$", out, re.MULTILINE), out


def test_cases_print_and_warn_of_nothing(tmp_path, capsys):
    more = "\nj = np.floor(g.F)  # [-] jumps\nprint('of a line', g.F)\nv = np.log(np.array([g.F - 2.5]))  # [-] none"
    more += "\nw = np.where(np.array([1.0, -1.0]) * g.F > 0, g.F**2, np.inf)  # [-] one is infinite"
    with pytest.warns(RuntimeWarning, match="divide by zero") as warned:
        bands(off(tmp_path, 9, "± 1", "", more))
    assert len(warned) == 1 and capsys.readouterr().out.splitlines().count("of a line 2.5") <= 2


def test_cases_without_numbers_are_told(tmp_path):
    more = """
j = math.floor(g.F)  # [-] jumps
if j > 2:
    raise ValueError(f"no size for {j}")
check_2 = check("jumping", j, 9)"""
    found, _ = bands(off(tmp_path, 9, "± 1", "", more))
    assert any(re.match(r"\d+ cases .* have no numbers: no size for 3", line) for line in found.lines())
    assert re.match(r"in 7\d(\.\d)? % of cases, fails at worst", found.sure["jumping"])


def test_whether_a_group_closes_is_looked_at_at_the_ends(tmp_path):
    lines = """
from mechsheet import assembled
C = rrr(0, 5.0, g.F, 3.0, +1)  # [m] pin
c = assembled("closes", C, g.F, (2.0, 8.0), "F", "-")"""
    for tolerance_of, said in (("± 0.4", "at both ends of each tolerance"), ("± 0.6", "fails for F = 1.9")):
        sheet = own(tmp_path, lines)
        path = Path(sheet.path)
        path.write_text(path.read_text(encoding="utf-8").replace(OFF[0], f"{OFF[0]}; {tolerance_of}"), encoding="utf-8")
        assert bands(cells.load(path))[0].sure["closes"] == said


def test_a_group_that_does_not_close_where_two_are_short_is_told(tmp_path, capsys):
    more = """
from mechsheet import assembled
C = rrr(0, 5.0, g.F, 4 * g.a, +1)  # [m] pin
c = assembled("closes", C, g.F, (2.0, 8.0), "F", "-")"""
    for F, said in (("± 0.3", "at both ends of each tolerance"), ("± 0.4", "fails where several are at their ends")):
        assert bands(off(tmp_path, 9, F, "± 0.04", more))[0].sure["closes"] == said
    sheet = off(tmp_path, 9, "± 0.4", "± 0.04", more)
    batch.answer(sheet.path, arguments.read(["--tolerances", "--want=closes"], declared(sheet.inputs)))
    assert "closes: pass, fails where several are at their ends" in capsys.readouterr().out


def test_of_a_check_that_is_not_evaluated_nothing_is_sure(tmp_path):
    sheet = off(
        tmp_path,
        9,
        more="\ngap = np.where(g.F > 9, g.F, np.nan)  # [-] is no number\ncheck_3 = check('reserve', gap, 9)",
    )
    found, names = bands(sheet)
    assert not names["check_3"].evaluated and "reserve" not in found.sure


def test_guaranteed_bounds_hold_all_cases(tmp_path):
    sheet = off(tmp_path, 9)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording = record(names, sheet, whole=True)
    by = tolerances(names["g"])
    node = recording.values["y"].re
    low, high = enclosed([node], {recording.inputs[x]: t.size for x, t in by.items()})[node]
    assert low <= 3.25 and high >= 8.25 and high - low < 5 + 1e-6
    assert Bands(recording, by, lambda: pytest.fail("nothing jumps")).of([node])[node].worst == 2.5


def test_a_run_shows_bands_only_where_it_is_asked_for_them(tmp_path, capsys):
    sheet = off(tmp_path, 6.75, more=TEXT)
    declared_inputs = declared(sheet.inputs)
    asked = arguments.read(["--tolerances", "--want=y,z,c", "--F=2.75"], declared_inputs)
    assert batch.answer(sheet.path, asked) == 0
    out = capsys.readouterr().out
    assert "within F = 2.75 ± 1, a = 0.75 ± 0.5" in out and "most by F (± 2), a (± 0.5)" in out
    assert re.search(r"6.25 +± 2.5 +± 2.1 +3\.\d+..8\.\d+ +3.75..8.75", out), "guaranteed too"
    assert "z: no slopes" in out and re.search(r"^below: pass in 6\d(\.\d)? % of cases", out, re.MULTILINE)
    assert batch.answer(sheet.path, arguments.read(["--want=y"], declared_inputs)) == 0
    assert "±" not in capsys.readouterr().out


def test_a_table_that_is_asked_for_shows_the_band_of_every_number(tmp_path, capsys):
    more = """
s = linspace(1, 3, 3)  # [-] positions
e = g.F * s  # [-] moves
r = np.where(s > 2.5, e, np.nan)  # [-] at the last one alone
table_2 = table("2", "Both", s, e, r)"""
    sheet = off(tmp_path, 9, more=more)
    given = arguments.read(["--tolerances", "--want=table_2,r,e"], declared(sheet.inputs))
    assert batch.answer(sheet.path, given) == 1, "r does not exist at 2 of 3 positions"
    out = capsys.readouterr().out
    rows = re.search(r"Table 2 - Both: worst case\n(.*\n.*\n.*\n.*\n.*)", out)[1].split("\n")
    assert [row.split() for row in rows] == [
        ["e", "r"], ["[-]", "[-]"], ["±", "1", "–"], ["±", "2", "–"], ["±", "3", "±", "3"]
    ]  # fmt: skip
    assert "r: not known, there is none at 2 of 3 positions" in out and "e [-]" in out
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    rows = banding.bands_of({**names, "__file__": sheet.path}, sheet, ()).lines()
    assert any(row.startswith("table 2  e") and "in row 3" in row for row in rows)


def test_what_cannot_be_banded_is_said(tmp_path):
    with pytest.raises(SheetError, match=r"no input has a tolerance: behind the limits of one write ; ± 0\.001"):
        tolerances(off(tmp_path, 9, "", "").inputs())
    with pytest.raises(SheetError, match=r"tolerance ± 3 normal: number F = -0.5 must be positive"):
        tolerances(off(tmp_path, 9, "> 0; ± 3 normal").inputs())
    with pytest.raises(SheetError, match=r"argument '--tolerances=' must be"):
        arguments.read(["--tolerances="], declared(off(tmp_path, 9).inputs))


def test_random_cases_are_drawn_from_the_distributions_at_the_inputs(tmp_path):
    sheet = off(tmp_path, 9, "± 1 normal")
    drawn = tolerance(sheet.path, ["y"], method="monte carlo", seed=1, count=4000)
    assert drawn["y"].deviation == pytest.approx(np.hypot(2 / 3, 0.5 / 3**0.5), rel=0.05)
    assert "uniform and normal" in drawn.method and drawn.tolerances == {"F": 1.0, "a": 0.5}


def test_the_page_writes_bands_as_the_numbers_that_they_stand_behind():
    """Not as they are typed in a terminal: 1.7 deg stood behind 110°, and powers of ten as 2e-9."""

    def told(*moves: float) -> str:
        moved = np.array([moves])
        return study._of_line([Banded("results", "phi", "deg", np.ones(len(moves)), Band(moved, moved))])

    assert told(np.radians(1.7)) == "± 1.7°"
    assert told(np.radians(0.2), np.radians(2e-5)) == "± up to 0.2°"
    assert told(np.radians(2e-9)) == "± 2·10⁻⁹°"
    imaginary = Banded("results", "P.imag", "mm", np.ones(1), Band(np.array([[2e-3]]), np.array([[1e-3]])))
    assert study._of_line([imaginary]) == "± (0, 2) mm", "not as if both parts moved"


def test_a_page_whose_file_is_another_one_by_now_asks_nothing_of_it(tmp_path, monkeypatch):
    """Of a page that is open while its worksheet is edited: bands and proofs would be those of other formulas."""
    from marimo._ast.load import load_app

    sheet, text = tmp_path / "guide.py", GUIDE.read_text(encoding="utf-8")
    sheet.write_text(text, encoding="utf-8")
    codes = [SimpleNamespace(code=code) for code in load_app(sheet)._cell_manager.codes()]
    monkeypatch.setattr(study.notebook, "running", lambda: (lambda: codes, {}))
    asked = study.Asked(tuple, lambda: None, lambda of, at: (), lambda told: "", dict)
    page = study.Study(asked, {"__file__": str(sheet)}, lambda: None)
    page.refuse_another = refusing_another(page.namespace)
    before = page.state()
    assert page.answer() == "" and page.state()[-2] is before[-2]
    sheet.write_text(text.replace("H = 2 * g.r", "H = 3 * g.r"), encoding="utf-8")
    assert page.state()[-2] is not before[-2], "so it is asked again"
    assert "the file of this worksheet is another one than this page" in page.answer()
    sheet.unlink()
    assert "is another one than this page" in page.answer() and page.state()


def test_the_page_shows_bands_and_what_matters_once_it_is_asked(serve, page, console_errors):
    """Behind numbers, cells and checks; when a number changes they are gone until they are those of the new one."""
    page.goto(serve("run", GUIDE))
    study, moment = page.locator(".ms-study"), page.locator("#line-M .ms-value")
    study.wait_for()
    assert page.locator("[data-band]").count() == 0
    study.get_by_role("checkbox").first.click()
    expect(moment).to_have_attribute("data-band", "± up to 160 N·m")
    assert "160" in moment.evaluate("e => getComputedStyle(e, '::after').content"), "it is seen"
    expect(page.locator("#line-H .ms-value")).to_have_attribute("data-band", "± 0.1 mm")
    expect(page.locator("#check-moment-where-the-work-begins")).to_have_attribute(
        "data-band", re.compile("in 92.* at worst")
    )
    cell = page.locator(".ms-table:has-text('Table 1 ') tbody tr:nth-child(8) td:nth-child(3)")
    expect(cell).to_have_attribute("data-band", "± 160")
    assert page.locator("[data-band*=e-]").count() == 0, "rounding is no band"
    bars = page.locator("#figure-1 ~ * .ms-bars, .ms-figure:has(#figure-1) .ms-bars")
    expect(bars).to_have_count(1)
    scale = 250 / 4000  # px in N·m, by the chart's axis
    halves = [-float(half) for half in re.findall(r"M\S+ \S+m-3 (\S+)h6", bars.get_attribute("d"))]
    assert len(halves) == 13 and halves[7] == pytest.approx(160 * scale, abs=0.2) and halves[0] == 0
    study.locator("select").select_option("M_work")
    row = page.locator(".ms-matters tbody tr").first
    expect(row, "the moment is as large as the force").to_contain_text("F50kN1.0000")
    field = page.locator(".ms-inputs tr:has-text('force on the ram') input")
    field.fill("25")
    field.press("Enter")
    expect(moment, "half the force").to_have_attribute("data-band", "± up to 79 N·m")
    study.get_by_role("checkbox").first.click()
    until(page, lambda: page.locator("[data-band], .ms-bars").count() == 0, "bands stay")
    assert console_errors == []


def test_what_matters_is_known_of_a_worksheet_with_lists(tmp_path):
    sheet = cells.load(EXAMPLES / "bolted_joint.py")
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    tornado, table = studied.matters(names, "p_K", "least")
    assert len(table.columns[0].values) > 5 and tornado
