"""Results asked for again: computed without the cells, and then what the cells give and refuse."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from own_worksheet import own
from test_random_scenes import scene

from mechsheet import SheetError, evaluate
from mechsheet.mechanics import roots
from mechsheet.mechanics.plain_root import NotPlain, plain_root
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.once import once
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording import evaluation
from mechsheet.worksheet import cells, inputs

WORKSHEETS = Path(__file__).parents[1] / "worksheets"


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The runs of cells, one element each."""
    monkeypatch.setattr(evaluation, "_known", {})
    told, run = list[Any](), evaluation.by_cells

    def counted(*asked: Any) -> Any:
        told.append(asked)
        return run(*asked)

    monkeypatch.setattr(evaluation, "by_cells", counted)
    return told


def answer(ask: Callable[[], dict[str, Any]]) -> Any:
    try:
        return ask()
    except (SheetError, ValueError, ArithmeticError) as error:
        return type(error), str(error)


@pytest.mark.parametrize(
    ("name", "want", "count", "least"),
    [
        ("hitch.py", ["GS6", "abs(R56)", "L7"], 30, 12),  # three Finds behind one another, a library's checks
        ("examples/bucket.py", ["G_S", "phi_E"], 24, 9),  # a reach that is required
        ("kinetostatics.py", ["mu23", "v5"], 15, 5),
        ("kinetostatics.py", ["R_D", "gamma45"], 6, 2),  # more single numbers than a workbook has cells for a line
        ("landing_gear.py", ["t_lim", "eps3_lim"], 15, 5),  # a Find from a guess alone
        ("landing_gear.py", ["omega2_listing"], 10, 3),
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_again_is_what_the_cells_give_or_refuse(
    name: str, want: list[str], count: int, least: int, runs: list[Any]
) -> None:
    path, random = WORKSHEETS / name, Random(7)
    sheet = cells.load(path)
    for _ in range(2):
        evaluate(path, want)
    runs.clear()
    for _ in range(count):
        given = {key: x for key, x in scene(sheet, random).items() if "(" not in key}
        again = answer(lambda given=given: evaluate(path, want, **given))
        g = answer(lambda given=given: inputs.build(sheet.inputs, given))
        if isinstance(g, tuple):
            assert again == g
            continue
        before = len(runs)
        alone = answer(lambda g=g: evaluation.by_cells(sheet, want, g))
        del runs[before:]
        if isinstance(alone, tuple):
            assert again == alone, given
            continue
        for key, value in alone.items():
            assert type(again[key]) is type(value) and np.shape(again[key]) == np.shape(value)
            size = np.nanmax(np.abs(value), initial=0)
            assert np.allclose(again[key], value, rtol=0, atol=1e-11 * size, equal_nan=True), (key, given)
    assert len(runs) < count - least, "most of them need no cells"


def test_the_second_time_is_recorded_and_the_third_one_runs_no_cell(runs: list[Any]) -> None:
    hitch = WORKSHEETS / "hitch.py"
    ran = []
    for given in ({}, {"P6": 26}, {"P6": 25}, {"N_pol": 12}, {"N_pol": 12, "P6": 26}, {"k_gc": 1, "N_pol": 12}):
        runs.clear()
        evaluate(hitch, ["GS6"], **given)
        ran.append(len(runs))
    assert ran == [1, 0, 0, 1, 0, 1], "inputs on which the ways depend begin anew"


def asked(tmp_path: Path, lines: str, name: str) -> Callable[..., Any]:
    path = Path(own(tmp_path, lines).path)
    return lambda **given: answer(lambda: evaluate(path, [name], **given))


def test_what_a_file_holds_is_read_again(tmp_path: Path) -> None:
    data = tmp_path / "loads.txt"
    data.write_text("2.0")
    ask = asked(tmp_path, f'y = g.F * np.loadtxt("{data.as_posix()}").item()  # [-] read', "y")
    assert [ask()["y"] for _ in range(3)] == [5, 5, 5]
    data.write_text("5.0")
    assert ask()["y"] == 12.5


def test_a_line_that_divides_by_zero_refuses_though_nothing_rests_on_it(tmp_path: Path) -> None:
    ask = asked(tmp_path, "z = 1 / (g.F - 2)  # [-] beside\ny = 2 * g.F  # [-] wanted", "y")
    assert [ask()["y"] for _ in range(3)] == [5, 5, 5]
    assert ask(F=2)[0] is ZeroDivisionError


@pytest.mark.filterwarnings("ignore")
def test_the_greater_of_an_element_that_is_no_number_is_none(tmp_path: Path) -> None:
    """It was the other one of the two when asked for again."""
    for line in ("np.maximum(g.F, v[1])", "np.clip(1.0, v[1], 9.0)", "np.minimum(g.F, v[1])"):
        ask = asked(tmp_path, f"v = np.sqrt(g.F - np.arange(0.0, 5.0))  # [-] gaps\ny = {line}  # [-] one of two", "y")
        for F in (2.5, 2.5, 2.5, 0.5, 0.5):
            assert np.isnan(ask(F=F)["y"]) == (F < 1), (line, F)


@pytest.mark.parametrize(
    "line",
    [
        "np.where(g.F > 2, x, 7.5)",
        "np.where(g.F > 2, x, np.nan)",
        "np.where(g.F > 2, 2, x)",
        "np.where(g.F > 2, np.arange(4), x)",
        "np.where(g.F > 2, np.arange(4), 7)",
        "np.where(g.F > 2, x > 1, x > 2)",
        "np.where(g.F > 2, x[:1], x)",
        "np.where(g.F > 2, 1j * x, x)",
    ],
)
def test_what_one_truth_chooses_is_of_its_own_type_and_shape_and_nobody_elses(tmp_path: Path, line: str) -> None:
    ask = asked(tmp_path, f"x = g.F * np.arange(4)  # [-] of four\ny = {line}  # [-] one or the other", "y")
    for F in (2.5, 2.5, 2.5, 1.5, 1.5, 1.5, 3.0):
        x, y = F * np.arange(4), ask(F=F)["y"]
        expected = eval(line, {"np": np, "x": x, "g": type("G", (), {"F": F})})
        assert (y.dtype, y.shape, y.tolist()) == (
            expected.dtype,
            expected.shape,
            pytest.approx(expected.tolist(), nan_ok=True),
        )
        y[...] = 9  # of whoever asked


SHAPES: dict[str, Callable[[Any], Any]] = {
    "wave": lambda x: np.sin(7 * x) * np.exp(x),
    "cubic": lambda x: (x - 0.3) ** 3,
    "touching": lambda x: (x - 0.4) ** 2,
    "jump": lambda x: np.where(x < 0.43, -1.0, 1.0) + x / 9,
    "pole": lambda x: 1 / (x - 0.431),
    "arc": lambda x: np.sqrt(1 - x**2),
    "line": lambda x: 3 * x - 1,
    "turned": lambda x: np.arctan2(np.sin(3 * x), np.cos(3 * x)),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("shape", SHAPES)
def test_a_plain_root_is_the_one_that_roots_gives(shape: str) -> None:
    """Where it answers at all, for targets and guesses all over the interval: a jump or a pole it takes for none."""
    f, random, told = SHAPES[shape], Random(1), 0
    for _ in range(75):
        lo, hi = sorted((random.uniform(-1, 1), random.uniform(-1, 1)))
        guess, x = random.uniform(lo, hi), random.uniform(lo, hi)
        equals = random.choice([0.0, random.uniform(-1, 1), float(f(np.float64(x))), float(f(np.float64(x)))])
        given = {"lo": lo, "hi": hi, "guess": guess, "equals": equals}
        columns = {name: np.array([x]) for name, x in given.items()}
        slow = roots.nearest_root(roots.Counted([lambda x: f(x)], (1,)), columns)
        try:
            x = plain_root(f, lambda x: float(f(np.float64(x))), lo, hi, guess, equals)
        except NotPlain:
            continue
        told += 1
        assert abs(x - slow[2][0]) <= 1e-5 * (hi - lo), f"another root: {given}"
        steepness = abs(f(x + 1e-9) - f(x - 1e-9)) / 2e-9
        play = 4 * np.spacing(max(abs(equals), 1)) + 8 * steepness * np.spacing(abs(x))
        assert abs(f(np.float64(x)) - equals) <= abs(slow[3][0]) + play, given
    assert told > 10 or shape in ("touching", "jump", "pole"), "it answers what is plain"


def test_a_root_that_rounding_leaves_level_is_left_to_roots() -> None:
    """Millions of floats solve it, each as well as the others: the two would choose another one."""
    random, told = Random(2), 0
    for _ in range(60):
        steep, lo, hi, x = 10 ** random.uniform(2, 9), 0.0, 1.0, random.uniform(0, 1)
        f = lambda x, steep=steep: np.arctan(steep * (x - 0.4)) + x * 1e-9  # noqa: E731
        equals = float(f(np.float64(x)))
        columns = {name: np.array([x]) for name, x in {"lo": lo, "hi": hi, "equals": equals}.items()}
        slow = roots.nearest_root(roots.Counted([f], (1,)), columns)
        try:
            x = plain_root(f, lambda x, f=f: float(f(np.float64(x))), lo, hi, None, equals)
        except NotPlain:
            continue
        told += 1
        assert abs(x - slow[2][0]) <= 1e-12, (steep, equals)
    assert told > 3


def test_a_function_is_recorded_once_for_the_same_quantities_and_what_it_sees_is_noted_each_time() -> None:
    graph, calls = Graph(bodies=True), list[float]()
    x, y = (Quantity(graph, graph.leaf("input", name, 2.0)) for name in "xy")

    def f(a: Quantity, b: float) -> Quantity:
        calls.append(b)
        return a * b if a > 1 else a - b

    first = once(graph, f, [x, 0.0], {})
    seen, graph.looked = graph.looked, {}
    again = once(graph, f, [x, 0.0], {})
    assert len(seen) == 1 and graph.looked == seen and again.re is first.re and calls == [0.0]
    assert again is not first, "an array of its own, in which a worksheet may put other numbers"
    once(graph, f, [y, 0.0], {})
    once(graph, f, [x, -0.0], {})
    assert len(calls) == 3, "equal numbers are not the same quantity, nor 0.0 the same as -0.0"


def test_an_input_may_be_called_g_and_all_inputs_be_given_by_it(tmp_path):
    path = own(tmp_path, "W = g.F * g.g  # [-] weight").path
    text = Path(path).read_text(encoding="utf-8")
    Path(path).write_text(
        text.replace("    a: float", "    g: float = 9.81  # [-] gravity\n    a: float"), encoding="utf-8"
    )
    assert evaluate(path, ["W"], g=10.0, F=3.0)["W"] == 30.0
    assert evaluate(path, ["W"], g=cells.load(path).inputs(F=2.0))["W"] == 2 * 9.81
