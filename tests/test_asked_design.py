"""What would it take: designs of a worksheet that is no test's own, against what they are by hand."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import WITHIN
from own_worksheet import own
from playwright.sync_api import expect

from mechsheet import evaluate, export
from mechsheet.page.design import Design, Designing
from mechsheet.run import arguments, batch, studied
from mechsheet.studies import asked_design, refined
from mechsheet.worksheet import cells
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import declared

GUIDE = Path(__file__).parents[1] / "worksheets" / "guide.py"
LINES = """
p = g.F * (4 - g.F) - g.a  # [-] greatest at F = 2
s = linspace(0, 1, 2)  # [-] two positions
w = g.F * (1 - 2 * s) + 3 * s  # [-] F and 3 - F
t = 1j * w  # [-] complex
q = 1 + 1e-7 * g.F  # [-] nearly flat
e = (g.F - 2) ** 2 - (g.a - 0.5) ** 2  # [-] a saddle at F = 2, a = 0.5
f = 1 - (g.F - 2) ** 4 - (g.a - 0.5) ** 2  # [-] level along F
h = 1 - (g.F - 2) * abs(g.F - 2) - (g.a - 0.5) ** 2  # [-] without a second slope at F = 2
u = 9 + 0.5 * g.F  # [-] 10 at F = 2"""
TEXT = """
z = float(f"{g.F:.17g}") * (4 - g.F)  # [-] by way of a text"""


def asked(sheet: cells.Worksheet, *options: str) -> asked_design.Problem:
    return asked_design.Problem(sheet.path, asked_design.read(options, declared(sheet.inputs)))


@pytest.fixture(scope="module")
def sheet(tmp_path_factory) -> cells.Worksheet:
    return own(tmp_path_factory.mktemp("own"), LINES)


@pytest.mark.parametrize(
    ("options", "F", "said"),
    [
        (["--vary=F=0..5", "--best=max p"], 2.0, "conditions of an optimum hold: to the first order none"),
        (["--vary=F=0..5", "--best=max w"], 1.5, "conditions of an optimum hold"),  # the least of two, at their corner
        (["--vary=F=0..5", "--need=w <= 1.75", "--best=max p"], 1.75, "held by w <= 1.75 at position 0"),
        (["--vary=F=0..1.25", "--best=max p"], 1.25, "held by the upper bound of F"),
        (["--vary=F=0..5", "--need=w >= 0.5"], 1.5, "conditions of an optimum hold"),  # the greatest reserve
        (["--vary=F=1..5", "--best=min w"], 1.5, "conditions of an optimum hold"),
    ],
)
def test_the_best_design_is_that_by_hand(options, F, said, sheet):
    chosen, told = asked_design.best(asked(sheet, *options))
    assert chosen["F"] == pytest.approx(F, abs=1e-6) and said in "\n".join(told)


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e9])
def test_a_goal_may_have_any_size(size, tmp_path):
    """Stresses are in Pa: one of 1e8 is no worse than a design that misses a requirement."""
    sheet = own(tmp_path, f"v = {size} * (5 + g.F)  # [-] great\nw = {size} * g.F  # [-] needed")
    chosen, told = asked_design.best(asked(sheet, "--vary=F=0..5", f"--need=w >= {2 * size}", "--best=min v"))
    assert chosen["F"] == pytest.approx(2.0, rel=1e-6) and "refined by slopes" in told[-3]


@pytest.mark.parametrize("size", [1e-9, 1e6, 1e9])
def test_a_requirement_whose_limit_is_0_may_have_any_size(size, tmp_path):
    """It was counted in Pa or in m: the conditions at the best design were said not to hold, or to leave it level."""
    sheet = own(tmp_path, f"v = g.F + g.a / 2  # [-] goal\nw = {size} * (9 - g.F**2 - g.a**2)  # [-] needed")
    chosen, told = asked_design.best(asked(sheet, "--vary=F=0..5", "--vary=a=0..5", "--need=w >= 0", "--best=max v"))
    assert (chosen["F"], chosen["a"]) == pytest.approx((6 / 5**0.5, 3 / 5**0.5), rel=1e-6)
    assert "held by w >= 0: to the first order none near it is better" in told[-2] and "is worse" in told[-2]


@pytest.mark.parametrize(
    ("lines", "options", "F", "a"),
    [
        (["v = np.floor(3 * g.F) - 2 * g.F - g.a"], ["--best=max v"], 13 / 3, 0.1),  # a step and a bound
        (
            ["v = (np.ceil(g.F) + 0.1) * g.a", "w = g.F * g.a"],
            ["--need=w >= 2", "--best=min v"],
            4.0,
            0.5,
        ),  # and a limit
    ],
)
def test_a_design_stands_at_the_edge_of_a_step(lines, options, F, a, tmp_path):
    """Slopes lead beyond a step, so that the design stayed where the search had come by, a little off the best."""
    sheet = own(tmp_path, "\n".join(f"{line}  # [-] result" for line in lines))
    problem = asked(sheet, "--vary=F=0..4.5", "--vary=a=0.1..0.7", *options)
    chosen, told = asked_design.best(problem)
    assert chosen["a"] == pytest.approx(a, abs=1e-6) and chosen["F"] == pytest.approx(F, abs=1e-6)
    judged = problem.judge({x: np.array([value]) for x, value in chosen.items()})
    assert all(r.missed[0] == 0 for r in judged.requirements) and "variants near it" in "\n".join(told)


def test_two_inputs_with_requirements_make_a_scene_that_passes(sheet, tmp_path, monkeypatch, capsys):
    options = ["--vary", "F=0..5", "--vary", "a=0.1..1", "--need", "w <= 1.75", "--best", "max p", "--n=4"]
    monkeypatch.setattr(sys, "argv", ["design", sheet.path, *options, f"--out={tmp_path}"])
    asked_design.main()
    out = capsys.readouterr().out
    assert re.search(r"^F = 1.75, within 0..5; number$", out, re.MULTILINE) or "F = 1.749999" in out
    assert "p = 3.8375 by" in out and "now p = 3" in out
    scene = tmp_path / "own_designed.toml"
    given = arguments.read([f"--scene={scene}", "--want=p"], declared(sheet.inputs))
    outcome, _ = batch.compute(sheet, "scene", given)
    assert outcome.problems == [] and outcome.g.n == 4 and len(outcome.checks) == 1
    assert [path.name for path in tmp_path.iterdir()] == [scene.name]


ALL_OVER = """
c = g.F * g.a  # [-] best in one of two corners
v = np.where(g.F < 0.02, 2 - g.F, 1.0)  # [-] level but for a small part
d = 1 / g.F  # [-] without a number at 0
l = np.log(g.F)  # [-] steep beside 0
r = np.sqrt(g.F - 3)  # [-] of which the document has no number"""


@pytest.mark.parametrize(
    ("options", "chosen", "said"),
    [
        (["--vary=F=-1.3..1.2", "--vary=a=-1.1..1.3", "--best=max c"], {"F": 1.2, "a": 1.3}, "c = 1.56 by"),
        (["--vary=F=0.01..5", "--best=max v"], {"F": 0.01}, "v = 1.99 by"),
        (["--vary=F=0..1", "--best=max F", "--need=d >= 2"], {"F": 0.5}, "d >= 2: it is 2"),
        (["--vary=F=0..1", "--best=max d"], {}, r"not refined by slopes: own.py, line .*: (float )?division by zero"),
        (["--vary=F=1e-9..1e9", "--best=min l"], {"F": 1e-9}, "optimum hold, .* the lower bound of F: .* no way free"),
        (["--vary=F=-1.32..0.32", "--best=max F", "--need=c <= 9"], {"F": 0.32}, "F = 0.32 by"),
        (["--vary=F=0..4", "--best=max r"], {"F": 4.0}, "now: r has no value"),
    ],
)
def test_a_design_is_looked_for_all_over_the_bounds(options, chosen, said, tmp_path):
    """What random variants alone miss: a corner, a small part of level ground, where a line ends, where it begins."""
    problem = asked(own(tmp_path, ALL_OVER.strip()), *options)
    found, told = asked_design.best(problem)
    assert {x: found[x] for x in chosen} == pytest.approx(chosen, rel=1e-6) and re.search(said, "\n".join(told))
    assert all(low <= found[x] <= high for x, (low, high) in problem.bounds.items())


def test_one_input_gives_a_result_its_value(sheet):
    chosen, (told,) = asked_design.solve(asked(sheet, "--vary=F=0..2", "--need=p = 2.25"))
    assert chosen["F"] == pytest.approx(1.0, abs=1e-12) and "roots seen by 97 samples 1" in told
    chosen, _ = asked_design.solve(asked(sheet, "--vary=F=2..5", "--need=max w = 4"))
    assert chosen["F"] == pytest.approx(4.0, abs=1e-12)


def test_where_other_values_would_do_too_they_are_told(tmp_path):
    """As of a number of belts, of which a search finds one place and no more."""
    sheet = own(tmp_path, "n = np.ceil(g.F)  # [-] belts\nm = min(g.F, 3.0)  # [-] no more\nt = 2 * g.F  # [-] once")
    chosen, told = asked_design.solve(asked(sheet, "--vary=F=0..5", "--need=n = 3"))
    assert 2 < chosen["F"] <= 3 and re.match(r"any F of 2\.0\d+\.\.3 would do, as far as 201 places tell", told[1])
    _, told = asked_design.solve(asked(sheet, "--vary=F=0..5", "--need=m = 3"))
    assert re.match(r"any F of 3\S*\.\.5 would do", told[1])
    assert len(asked_design.solve(asked(sheet, "--vary=F=0..5", "--need=t = 4"))[1]) == 1


def test_what_is_no_number_cannot_be_asked_for(tmp_path):
    sheet = own(tmp_path, "way = 'by one' if g.F > 2 else 'by another'")
    with pytest.raises(arguments.UsageError, match="way is no number"):
        asked(sheet, "--vary=F=0..5", "--best=max way")


def test_what_a_design_does_not_rest_on_may_have_no_value(tmp_path, recwarn):
    sheet = own(tmp_path, LINES + "\nv = np.sqrt(g.F - 9)  # [-] no number")
    chosen, _ = asked_design.best(asked(sheet, "--vary=F=0..5", "--best=max p"))
    assert chosen["F"] == pytest.approx(2.0, abs=1e-6) and not list(recwarn)


def test_designs_on_the_way_warn_and_print_of_nothing(tmp_path, capsys):
    """Of numpy's mean of nothing too, which is no error of a floating-point number."""
    lines = LINES + "\nm = np.nanmax(np.where(x < g.F - 1, x, np.nan))  # [-] of none at F = 0.5\nprint('of a line')"
    sheet = own(tmp_path, lines)
    chosen, _ = asked_design.best(asked(sheet, "--vary=F=0..5", "--best=max m"))
    assert chosen["F"] == pytest.approx(5.0, abs=1e-4) and not capsys.readouterr().out


def test_a_design_is_looked_for_from_where_the_present_one_has_no_value(tmp_path):
    """What would it take that it closes is what is asked most."""
    sheet = own(tmp_path, "v = 1e3 * np.sqrt(3 - g.F)  # [N] ends at F = 3")
    chosen, told = asked_design.best(asked(sheet, "--F=4", "--vary=F=0..5", "--need=v <= 1 kN", "--best=max v"))
    assert chosen["F"] == pytest.approx(2.0, rel=1e-6) and "now: v has no value" in told
    assert asked_design.solve(asked(sheet, "--F=4", "--vary=F=0..3", "--need=v = 1 kN"))[0]["F"] == pytest.approx(2.0)


def test_what_ends_on_the_way_to_a_better_design_is_told(tmp_path):
    sheet = own(tmp_path, LINES + "\nv = np.where(g.F < 3.00004, g.F, np.nan)  # [-] ends")
    _, told = asked_design.best(asked(sheet, "--vary=F=0..5", "--best=max v"))
    assert "not refined by slopes: a design on the way to a better one has no v" in told


def test_what_has_no_slope_is_searched_and_says_so(tmp_path):
    chosen, told = asked_design.best(asked(own(tmp_path, LINES + TEXT), "--vary=F=0..5", "--best=max z"))
    assert chosen["F"] == pytest.approx(2.0, abs=1e-3) and "not refined by slopes: z has no slope" in "\n".join(told)
    assert not [line for line in told if line.startswith("refined") or "conditions" in line]


@pytest.mark.parametrize(("to", "reason"), [(1.5, "no better one"), (2.5, "a design that misses w <= 1.75")])
def test_what_slopes_make_worse_is_not_written_and_what_is_said_is_of_the_design_written(
    to, reason, sheet, monkeypatch
):
    monkeypatch.setattr(refined.Slopes, "refined", lambda _: {"F": to})
    problem = asked(sheet, "--vary=F=0..5", "--need=w <= 1.75", "--best=max p")
    chosen, told = asked_design.best(problem)
    assert chosen == {"F": 1.75} and f"not refined by slopes: they lead to {reason}" in told
    assert refined.Slopes(problem, chosen).conditions(chosen) in told and "an optimum hold, held by" in "\n".join(told)
    assert not [line for line in told if line.startswith("refined")]


SECOND = {
    "a peak": (
        ["--best=max p"],
        {"F": 2.0, "a": 0.1},
        "bound of a: .*second order each one near it is",
    ),
    "a vertex": (["--need=w <= 1.75", "--best=max p"], {"F": 1.75, "a": 0.1}, "what holds it leaves no way free"),
    "a saddle": (["--best=max e"], {"F": 2.0, "a": 0.5}, "to the first order alone: .*better along F$"),
    "its peak within a bound": (
        ["--vary=F=2..5", "--best=min e"],
        {"F": 2.0, "a": 0.5},
        "better along a$",
    ),
    "level": (["--best=max f"], {"F": 2.0, "a": 0.5}, "optimum hold: .*to the second order it is level along F$"),
    "unknown": (["--best=max h"], {"F": 2.0, "a": 0.5}, "nothing is known, for max h has no second slope there"),
}


@pytest.mark.parametrize("name", SECOND)
def test_the_second_order_tells_a_peak_from_a_saddle(name, sheet):
    options, design, said = SECOND[name]
    problem = asked(sheet, "--vary=F=0..5", "--vary=a=0.1..1", *options)
    assert re.search(said, told := refined.Slopes(problem, design).conditions(design)), told


def test_a_slope_that_is_left_is_told_by_what_the_goal_varies_by(sheet):
    """However small beside the goal, and the same on both sides of a power of ten of it."""
    for goal, slope in (("q", 1e-7), ("u", 0.5)):
        problem = asked(sheet, "--vary=F=0..5", f"--best=max {goal}")
        slopes = refined.Slopes(problem, {"F": 2.0})
        told = [slopes.conditions({"F": F}) for F in (1.0, 1.9, 2.1, 4.0)]
        assert len(set(told)) == 1 and "do not hold" in told[0]
        part = float(re.search(r"a slope of ([\d.]+) of what the goal varies by", told[0])[1])
        assert part == pytest.approx(5 * slope / np.median(slope * abs(np.linspace(0, 5, 1001) - 2.0)), rel=0.1)


def test_of_several_limits_of_a_result_the_strictest_stands_in_the_scene(sheet):
    needs = ["--need=p >= 1", "--need=p >= 2", "--need=p >= 1.5", "--need=p <= 9", "--need=p <= 7", "--need=p <= 8"]
    problem = asked(sheet, "--vary=F=0..5", *needs, "--best=max w")
    assert "p = {min = 2.0, max = 7.0}" in asked_design.scene_of(problem, {"F": 2.0}, []).replace('"', "")


def test_the_scene_is_written_beside_a_worksheet_of_ones_own(tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "sheets").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    monkeypatch.setattr(asked_design, "watch", lambda _: None)
    sheet = own(tmp_path / "sheets", LINES)
    monkeypatch.setattr(sys, "argv", ["design", sheet.path, "--vary=F=0..2", "--need=p = 2.25"])
    asked_design.main()
    assert (tmp_path / "sheets" / "own_designed.toml").is_file() and not [*(tmp_path / "elsewhere").iterdir()]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--vary=F=0..5", "--need=p >= 4", "--best=max w"], "p >= 4: best reachable 3.25, required at least 4"),
        (["--vary=F=0..5", "--need=w >= 1.2", "--need=p >= 3.24", "--best=max w"], "holds all requirements together"),
        (["--vary=F=5..0", "--best=max p"], r"bounds of number F = 5..0 must be in order"),
        (["--vary=F=0..x", "--best=max p"], "number F = 'x' is no number"),
        (["--vary=G=0..5", "--best=max p"], "input G is unknown; nearest: "),
        (["--vary=n=2..5", "--best=max p"], "varying positions n, which is a whole number"),
        (["--vary=F=0..5", "--best=max v"], "v is defined by no cell"),
        (["--vary=F=0..5", "--best=max t"], "t is complex; take t.real"),
        (["--vary=F=0..5", "--best=p"], "argument '--best=p' must be such as --best="),
        (["--vary=F=0..5", "--need=p > 1"], "must be such as --need="),
        (["--vary=F=0..5", "--need=p >= much"], "limit of p = 'much' is no number"),
        (["--vary=F", "--best=max p"], "must be such as --vary="),
        (["--best=max p"], "nothing is varied"),
        (["--vary=F=0..5"], "design takes one --best="),
        (["--vary=F=0..5", "--vary=a=0..1", "--need=p = 1"], "design takes one --best="),
        (["--vary=F=0..5", "--need=w = 1"], "w has 2 positions: min or max w"),
        (["--vary=F=0..2", "--need=p = 9"], "reaches -0.75..3.25"),
        (["--vary=F=0..5", "--best=max p", "--want=p"], "design takes --vary, --need, --best, inputs"),
    ],
)
def test_what_cannot_be_asked_or_reached_is_said_in_a_line(options, message, sheet):
    with pytest.raises(SheetError, match=message) as error:
        problem = asked(sheet, *options)
        (asked_design.solve if any(n.sign == "=" for n in problem.asked.needs) else asked_design.best)(problem)
    assert "\n" not in str(error.value)


CORNERS = """
b = max(g.F + 1, 5 - g.F, g.a + 2)  # [-] greatest of three, least at F = 2, a < 1
c = np.max(abs(np.array([g.F - 2, g.a - 0.5])))  # [-] nothing at F = 2, a = 0.5
d = min(g.F, 4 - g.F)  # [-] least of two, greatest at F = 2
e = math.sqrt(4 - g.F) * g.F  # [-] ends at F = 4"""


@pytest.mark.parametrize(
    ("options", "F", "said"),
    [
        (["--best=min b"], 2.0, "hold, held by 2 numbers of the goal: to the first order none near it is better"),
        (["--vary=a=0..3", "--best=min c"], 2.0, "hold, held by 4 numbers of the goal"),
        (["--best=max d"], 2.0, "hold, held by 2 numbers of the goal"),
        (["--need=b <= 3.5", "--best=max F"], 2.5, "hold, held by b <= 3.5: to the first order"),
        (["--need=F >= 1", "--need=F <= 1.75", "--best=max d"], 1.75, "hold, held by F <= 1.75"),
    ],
)
def test_at_a_corner_the_conditions_are_those_of_each_of_its_numbers(options, F, said, tmp_path):
    """An input that is varied may be the goal, or have to be small, itself."""
    problem = asked(own(tmp_path, CORNERS), "--vary=F=0..5", *options)
    chosen, told = asked_design.best(problem)
    assert chosen["F"] == pytest.approx(F, abs=1e-6) and said in "\n".join(told)
    assert '"F"' not in asked_design.scene_of(problem, chosen, told), "an input is no result with a limit"


def test_a_design_is_refined_where_all_near_it_have_a_value(tmp_path):
    """Of the whole of the bounds slopes lead beyond the end."""
    sheet = own(tmp_path, CORNERS)
    text = Path(sheet.path).read_text(encoding="utf-8")
    Path(sheet.path).write_text(text.replace("F: float = 2.5  # [-] number", "F: float = 2.5  # [-] number; < 4"))
    chosen, told = asked_design.best(asked(cells.load(sheet.path), "--vary=F=0..4", "--need=d <= 1.2", "--best=max e"))
    assert chosen["F"] == pytest.approx(2.8, abs=1e-6) and "conditions of an optimum hold" in told[-2]


def test_a_design_may_start_at_a_bound():
    """Rounding puts no start outside: the search for what can be reached sets out from the nearest design."""
    bucket = Path(__file__).parents[1] / "worksheets" / "examples" / "bucket.py"
    with pytest.raises(SheetError, match=r"no design within the bounds: mu_2 >= 70 deg: best reachable \d"):
        asked_design.best(asked(cells.load(bucket), "--vary=L_DE=0.42..0.5", "--need=mu_2 >= 70 deg", "--best=max F_T"))
    assert np.isfinite(asked(cells.load(bucket), "--vary=L_DE=0.42..0.5", "--best=max F_T").now.goal)


def test_a_design_rests_on_inputs_that_are_gone_while_they_change() -> None:
    """And holds them: others at the same place of the memory are others."""
    inputs = cells.load(GUIDE).inputs
    namespace = {"g": inputs(), "__file__": str(GUIDE)}
    design = Design(Designing(dict, None), namespace, lambda: None)
    g, written = design.rests_on()
    assert design.rests_on()[0] is g is namespace["g"]
    del namespace["g"]
    assert design.rests_on() == (None, written)


def test_results_that_are_offered_are_numbers(tmp_path) -> None:
    """Functions were, of which nothing can be asked; and rows of several lengths failed there in numpy's words."""
    lines = "\nz = 1j * g.F  # [-] z\nrows = [[1.0], [1.0, 2.0]]  # [-] rows\ndef f(t):\n    return t  # [-] f"
    names = {"x": 1.0, "z": 1j, "rows": [[1.0], [1.0, 2.0]], "f": abs}
    offered = studied.results_of({"__file__": own(tmp_path, lines).path, **names})
    assert list(offered) == ["x", "z.real", "z.imag", "abs(z)"]


@pytest.mark.parametrize("line", ["d = (", "d = 1.0  # [-] one\n    typeset(display=dict(m='mm'))"])
def test_the_end_of_a_page_is_there_while_a_line_cannot_be_read(line, tmp_path) -> None:
    """It was not, nor once the line was mended: that it cannot be read was said until the page was opened anew."""
    path = tmp_path / "own.py"
    path.write_text(f"import marimo\napp = marimo.App()\n\n@app.cell\ndef one():\n    {line}\n", encoding="utf-8")
    shown = export("Own", {"__file__": str(path), "d": 1.0}).text
    assert "Excel workbook" in shown and "Page in one file" in shown


def test_the_page_finds_what_it_would_take(serve, page, console_errors):
    """In the guide the moment is as large as the force: M_work = 2442.8 N m at 50 kN, and H = 2 r the stroke."""
    page.goto(serve("run", GUIDE))
    form, told = page.locator("ms-design"), page.locator(".ms-designed")
    form.get_by_text("what would it take").click()
    vary, need = form.locator(".ms-vary > div"), form.locator(".ms-need > div")
    vary.last.locator("select").select_option("F")
    expect(vary.first.get_by_label("least")).to_have_value("25")
    need.last.get_by_label("result that is required").select_option("M_work")
    need.first.get_by_label("value").fill("2")
    form.get_by_role("button").click()
    expect(told, "which one, and what is reachable").to_contain_text("M_work reaches 1221..3664 N·m by 97 samples")
    need.first.get_by_label("value").fill("2000 N*m")
    form.get_by_role("button").click()
    expect(told).to_contain_text("M_work = 2000 N·m")
    moment = evaluate(GUIDE, ["M_work"])["M_work"]
    found = float(re.match(r"F = ([\d.]+) kN, within 25..75", told.inner_text())[1])
    assert found == pytest.approx(50 * 2000 / moment, rel=1e-9)
    need.first.get_by_label("is", exact=True).select_option("<=")
    vary.last.locator("select").select_option("r")
    form.get_by_label("goal").select_option("max")
    form.get_by_label("result that shall be best").select_option("H")
    form.get_by_role("button").click()
    expect(told).to_contain_text("conditions of an optimum hold", timeout=WITHIN * 1000)
    assert "r = 90 mm, within 30..90" in told.inner_text(), "with less force the longest crank"
    with page.expect_download() as scene:
        told.get_by_text("Scene of the design").click()
    text = Path(scene.value.path()).read_text(encoding="utf-8")
    assert scene.value.suggested_filename == "guide_designed.toml" and '"M_work" = {max = 2000.0}' in text
    field = page.locator(".ms-inputs tr:has-text('force on the ram') input")
    field.fill("40")
    field.press("Enter")
    expect(told).to_have_text("The inputs are others by now.")
    expect(vary.first.get_by_label("least"), "what is filled in stays").to_have_value("25")
    assert console_errors == []
