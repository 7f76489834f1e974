"""Design by search: the optimum of known problems, and what the design worksheet promises, writes and refuses."""

import re
import shutil
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from as_script import as_script
from hypothesis import given
from hypothesis import strategies as st
from openpyxl import load_workbook
from test_exports import assert_current
from written_cells import Values

from mechsheet.recording.evaluation import evaluate
from mechsheet.run.batch import compute
from mechsheet.studies.design import Judged, Requirement, pareto, save_scene, scene_text, search
from mechsheet.worksheet.cells import load as load_sheet
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.scene import Limit, load

ROOT = Path(__file__).parents[1]
HITCH = ROOT / "worksheets" / "hitch.py"
DESIGN = ROOT / "worksheets" / "hitch_design.py"
SCENE = ROOT / "worksheets" / "scenes" / "designed.toml"
QUICK = {"generations": 3, "members": 3}


# The search on problems whose answer is known


def found(goal, *requirements, bounds, seed=1, generations=60, members=10, decimals=4, reasons=None, start=None):
    """Search over x and y for the greatest goal(x, y) under requirements (name, f, limit, at least)."""

    def judge(variants):
        x, y = variants["x"], variants["y"]
        made = tuple(Requirement(name, f(x, y), limit, "m", least) for name, f, limit, least in requirements)
        why = np.full(x.shape, "", dtype=object) if reasons is None else reasons(x, y)
        return Judged(goal(x, y), made, why)

    settings = {"seed": seed, "generations": generations, "members": members, "start": start}
    return search(judge, bounds, dict.fromkeys(bounds, decimals), **settings)


SQUARE = {"x": (-2.0, 2.0), "y": (-2.0, 2.0)}


def test_greatest_sum_in_a_circle_is_on_its_rim():
    design = found(lambda x, y: 5 * (x + y), ("circle", lambda x, y: x**2 + y**2, 1.0, False), bounds=SQUARE)
    assert np.allclose([design.inputs["x"], design.inputs["y"]], 0.5**0.5, atol=0.01)
    assert 5 * 2**0.5 - 5e-3 < design.goal <= 5 * 2**0.5
    assert design.requirements[0].values[0] <= 1.0, "a requirement is held, not approached"
    assert design.requirements[0].check().passed


def test_inputs_are_rounded_and_promises_hold_for_the_rounded():
    design = found(lambda x, y: -((x - 0.123456) ** 2) - (y - 1.98765) ** 2, bounds=SQUARE, decimals=2)
    assert design.inputs == {"x": 0.12, "y": 1.99}
    assert design.goal == -((0.12 - 0.123456) ** 2) - (1.99 - 1.98765) ** 2


def test_bounds_may_fix_an_input_and_are_kept():
    design = found(lambda x, y: x + y, bounds={"x": (0.3, 0.3), "y": (0.0, 0.55558)}, generations=20)
    assert design.inputs == {"x": 0.3, "y": 0.55558}, "0.5556 would lie outside"


@pytest.mark.parametrize("generations", [3, 10, 30, 60])
@pytest.mark.parametrize(
    ("goal", "greatest", "rim"),
    [
        (lambda x, y: x + y, 4.0, 9.0),  # in a corner of the bounds
        (lambda x, y: 5 * (x + y), 50**0.5, 1.0),  # on the rim of a circle
        (lambda x, y: np.minimum(np.minimum(x - y, 1 - x), 1 + y), 2 / 3, 9.0),  # where three planes meet
        (lambda x, y: -100 * (y - x**2) ** 2 - (1 - x) ** 2, 0.0, 9.0),  # in a curved valley
        (lambda x, y: np.sin(9 * x) + np.cos(7 * y), 2.0, 9.0),  # at one of many equal peaks
    ],
    ids=["corner", "circle", "planes", "valley", "peaks"],
)
def test_the_greatest_goal_is_within_the_uncertainty(goal, greatest, rim, generations):
    circle = ("circle", lambda x, y: x**2 + y**2, rim, False)
    for seed in range(10):
        design = found(goal, circle, bounds=SQUARE, generations=generations, seed=seed)
        assert design.goal <= greatest <= design.goal + design.uncertainty


def test_uncertainty_falls_with_the_generations_to_what_rounding_changes():
    def uncertainty(generations):
        return found(lambda x, y: x + 3 * y, bounds=SQUARE, generations=generations).uncertainty

    assert uncertainty(3) > 5 * uncertainty(20) > 25 * uncertainty(60)
    assert uncertainty(60) == pytest.approx(1e-4 + 3e-4), "a step of the last decimal of both inputs"


def test_uncertainty_is_unknown_where_half_of_the_generation_misses_a_requirement():
    narrow = ("stripe", lambda x, y: abs(x - 0.3), 0.2, False)
    assert found(lambda x, y: x + y, narrow, bounds=SQUARE, generations=1).uncertainty == np.inf
    assert found(lambda x, y: x + y, narrow, bounds=SQUARE, generations=30).uncertainty < 0.1


def test_same_seed_same_design():
    def again(seed):
        return found(lambda x, y: np.sin(9 * x) + np.cos(7 * y), bounds=SQUARE, generations=4, seed=seed).inputs

    assert again(1) == again(1) != again(2)


def test_variants_without_a_value_are_never_chosen():
    def reasons(x, y):
        return np.where(x > 0, "does not close", "").astype(object)

    design = found(lambda x, y: np.where(x > 0, np.nan, x), bounds=SQUARE, reasons=reasons)
    assert design.inputs["x"] == pytest.approx(0, abs=1e-3) and design.inputs["x"] <= 0
    with pytest.raises(SheetError, match="no design within the bounds has a value: nothing closes"):
        found(
            lambda x, y: np.nan * x,
            bounds=SQUARE,
            reasons=lambda x, y: np.full(x.shape, "nothing closes", dtype=object),
            generations=2,
        )


def test_requirement_out_of_reach_is_named_with_what_can_be_reached():
    with pytest.raises(
        SheetError, match="no design within the bounds: height: best reachable 2 m, required at least 3 m"
    ):
        found(lambda x, y: x, ("height", lambda x, y: y, 3.0, True), ("width", lambda x, y: x, 9, False), bounds=SQUARE)


def test_requirements_that_exclude_each_other_are_told_so():
    both = ("left", lambda x, y: x, -1.0, False), ("right", lambda x, y: x, 1.5, True)
    with pytest.raises(SheetError, match=r"together: .* required at .*; alone it would reach"):
        found(lambda x, y: y, *both, bounds=SQUARE)


def test_bounds_out_of_order_are_refused():
    with pytest.raises(SheetError, match=r"bounds of x = 2..1 must be in order"):
        found(lambda x, y: x, bounds={"x": (2.0, 1.0), "y": (0.0, 1.0)})
    with pytest.raises(SheetError, match=r"bounds = \{\} must have those of at least one input"):
        found(lambda x, y: x, bounds={})
    with pytest.raises(SheetError, match=r"decimals = \{'x': 3\} must have those of y"):
        search(lambda x: x, SQUARE, {"x": 3}, seed=1, generations=1, members=4)


numbers = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=1, max_size=12)


@given(numbers)
def test_pareto_set_is_what_no_other_beats(pairs):
    a, b = np.array(pairs, dtype=float).T
    best = pareto(a, b)
    unbeaten = {(p, q) for p, q in pairs if not any(x >= p and y >= q and (x > p or y > q) for x, y in pairs)}
    assert [*zip(a[best], b[best], strict=True)] == sorted(unbeaten, reverse=True)


# The worksheet


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run of the worksheet as a script with its own inputs: its folder and what it printed."""
    out = tmp_path_factory.mktemp("out")
    done = as_script(DESIGN, f"--out={out}")
    assert (done.returncode, done.stderr) == (0, "")
    return out, done.stdout


def test_script_writes_workbook_and_scene(run):
    out, printed = run
    assert sorted(path.name for path in out.iterdir()) == ["designed.toml", "hitch_design.xlsx"]
    assert printed.count("pass  ") == 11 and "FAIL" not in printed
    book = Values(out / "hitch_design.xlsx")
    assert [cell.value for cell in book["3.1 Chosen inputs"][5]][:2] == ["L3", "m"]
    assert [name for name in book.sheetnames if name[0].isdigit() and name[1] == "."] == [
        "3.1 Chosen inputs", "3.2 The design over the stroke", "4.1 Designs of the trade-off",
        "5.1 Sensitivity of the capacity", "5.2 Sensitivity of the greatest", "5.3 Reserve and front axle",
        "5.4 Reserve of capacity within",
    ]  # fmt: skip


def test_export_is_current(run):
    assert_current(DESIGN, run[0])


def promised(scene: Path) -> tuple[str, dict, float]:
    """Text of a scene, what it holds, and the least reserve that it promises, in percent."""
    text = scene.read_text(encoding="utf-8")
    return text, tomllib.loads(text), float(re.search(r"Least reserve ([\d.]+) %", text)[1])


def test_scene_in_the_repository_is_that_of_the_worksheet(run):
    """Or one of another search, as a processor that rounds differently may take: as good within the uncertainty."""
    (old_text, old, old_reserve), (text, new, reserve) = promised(SCENE), promised(run[0] / "designed.toml")
    assert old_text == text or old["inputs"] != new["inputs"]
    assert old["limits"] == new["limits"] and list(old["inputs"]) == list(new["inputs"])
    note = load_workbook(run[0] / "hitch_design.xlsx")["3.1 Chosen inputs"]["A2"].value
    assert abs(old_reserve - reserve) <= float(re.search(r"uncertain by ([\d.]+) %", note)[1])


def test_hitch_opens_the_scene_with_the_promised_reserves(run):
    """The whole hitch worksheet runs on the scene: its checks, the scene's limits, and the numbers promised."""
    outcome, names = compute(load_sheet(HITCH), "designed", load(SCENE))
    assert outcome.verdict == "pass"
    P6 = names["g"].P6
    least = min(np.min(names["GS6"]), np.min(names["GS6_lim"])) / P6 - 1
    assert f"{100 * least:.4f}" == f"{promised(SCENE)[2]:.4f}"
    sheet = Values(run[0] / "hitch_design.xlsx")["3.2 The design over the stroke"]
    rows = list(sheet.iter_rows(min_row=5, values_only=True))
    reserve = min(min(row[3], row[4]) for row in rows)
    assert f"{reserve:.4f}" == f"{promised(run[0] / 'designed.toml')[2]:.4f}"
    present = evaluate(HITCH, ["GS6", "GS6_lim"])
    assert least > min(np.min(x) for x in present.values()) / P6 - 1 + 0.05, "better than the hitch as it was"


def test_hitch_as_a_script_takes_the_scene(tmp_path):
    done = as_script(HITCH, f"--scene={SCENE}", f"--out={tmp_path}")
    assert (done.returncode, done.stderr) == (0, "")
    assert "pass  dGS65 >= 10 %" in done.stdout and "pass  phi6_S <= 115 deg" in done.stdout


def test_search_goes_through_the_formulas_of_the_hitch(tmp_path):
    """A hitch whose cylinders lift less makes another worksheet of the very same design file."""
    text = HITCH.read_text(encoding="utf-8")
    line = "GS6 = g.k_gc * g.P_gc_max"
    assert text.count(line) == 1
    (tmp_path / "hitch.py").write_text(text.replace(line, "GS6 = 0.1 * g.k_gc * g.P_gc_max"), encoding="utf-8")
    shutil.copy(DESIGN, tmp_path)
    with pytest.raises(SheetError, match="no design within the bounds: reserve of capacity: best reachable -8"):
        evaluate(tmp_path / "hitch_design.py", ["design"], **QUICK)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"dRa_req": 27},
            "no design within the bounds: share of the front axle: best reachable 24.* %, required at least",
        ),
        (
            {"Y56_req": 1.6},
            "no design within the bounds: height of the suspension axis: best reachable 1.* m, required",
        ),
        ({"L3_min": 1, "L3_max": 1.1}, "no design within the bounds has a value: no position closes for cylinder S"),
        ({"L3_min": 0.3}, "L3_min = 0.3 m must be <= L3_max = 0.22 m"),
    ],
)
def test_what_cannot_be_designed_is_said(given, message):
    with pytest.raises(SheetError, match=message):
        evaluate(DESIGN, ["design"], **QUICK, **given)


def test_every_requirement_is_a_check_of_the_design(run):
    names = evaluate(DESIGN, ["design", "checks_design"], dG_req=-50, dRa_req=5, mu_req=5, Y56_req=0.5, **QUICK)
    checks = names["checks_design"]
    assert len(checks) == 9 and all(check.passed for check in checks)
    assert (checks[0].at_least, checks[0].limit) == (True, pytest.approx(-50))
    found = evaluate(HITCH, ["dGS65", "dRa"], **names["design"].inputs)
    assert checks[0].residual == pytest.approx(100 * np.min(found["dGS65"]), abs=1e-9)
    assert checks[1].residual == pytest.approx(100 * np.min(found["dRa"]), abs=1e-9)


# The scene file


FIELDS = {field.name: field for field in declared(load_sheet(HITCH).inputs)}


def test_scene_text_reads_back():
    text = scene_text(FIELDS, {"L3": 0.2001, "phi_BD": 1e-7}, {"abs(R56)": Limit(1.0, 2e5)}, ["one", "two"])
    assert text.startswith("# one\n# two\n[inputs]\nL3 = 0.2001  # m\n")
    assert tomllib.loads(text) == {
        "inputs": {"L3": 0.2001, "phi_BD": 1e-7},
        "limits": {"abs(R56)": {"min": 1.0, "max": 2e5}},
    }


def test_scene_is_written_for_a_named_folder_only(tmp_path, monkeypatch, capsys):
    namespace = {"__file__": str(DESIGN), "g": load_sheet(DESIGN).inputs()}
    monkeypatch.chdir(tmp_path)
    for arguments in ([], ["--seed=3"]):
        monkeypatch.setattr(sys, "argv", [str(DESIGN), *arguments])
        assert save_scene("[inputs]\n", "designed.toml", namespace) is None
    assert list(tmp_path.iterdir()) == [] and capsys.readouterr().out == ""
    monkeypatch.setattr(sys, "argv", [str(DESIGN), "--out=a/b"])
    assert save_scene("[inputs]\n", "designed.toml", namespace) is None
    assert [p.name for p in (tmp_path / "a" / "b").iterdir()] == ["designed.toml"], "and nothing beside it"
    monkeypatch.setattr(sys, "argv", ["elsewhere"])
    assert "download" in save_scene("[inputs]\n", "designed.toml", namespace).text
    (tmp_path / "file").touch()
    monkeypatch.setattr(sys, "argv", [str(DESIGN), "--out=file"])
    with pytest.raises(SheetError, match="folder file cannot be made"):
        save_scene("[inputs]\n", "designed.toml", namespace)
