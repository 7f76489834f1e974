"""What the recording of one variant knows of others is what the worksheet gives for each of them alone."""

import re
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own
from run_once import run
from test_recorded_worksheet import FOLLOWED, ROOT

from mechsheet import evaluate
from mechsheet.recording.evaluation import by_cells
from mechsheet.recording.variants import Known, variants
from mechsheet.studies import chunks
from mechsheet.studies.sweep import Sweep, sweep
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, base, load
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.verdict import values_only

Again = Callable[[Mapping[str, Any]], Known]
F, A = np.random.default_rng(7).uniform([[0.5], [0.2]], [[6], [2]], (2, 8))
BALANCES = {("landing_gear", "M2"), ("landing_gear", "M3")}  # zero but for rounding, as all moments there
DOCUMENTS = [path for path in sorted(ROOT.glob("worksheets/**/*.py")) if path.stem not in ("accuracy", "hitch_design")]


def recorded(sheet: Worksheet, want: list[str], varied: list[str]) -> Again:
    only = replace(sheet, cells=tuple(sheet.needed(map(base, want), ["g"])))
    with values_only():
        return variants(only, want, sheet.inputs(), varied)


def test_every_line_that_is_followed_is_so_for_many_variants(tmp_path: Path) -> None:
    """Each in a cell of its own: one that is not followed costs the others nothing."""
    lines = {f"y{n}_": line for n, line in enumerate(FOLLOWED)}
    cells = "".join(f"@app.cell\ndef _(g, x):\n    {name} = {line}\n    return\n\n" for name, line in lines.items())
    path = Path(own(tmp_path, "pass").path)
    path.write_text(path.read_text().replace("if __name__", f"{cells}if __name__"))
    whole = load(path)
    machines = (inputs.build(whole.inputs, {"F": f, "a": a}) for f, a in zip([2.5, *F], [0.75, *A], strict=True))
    alone = [by_cells(whole, [*lines], g) for g in machines]
    wrong = []
    for name, line in lines.items():
        again = recorded(whole, [name], ["F", "a"])
        found = again({"F": np.array([2.5, *F]), "a": np.array([0.75, *A])})
        values = [np.asarray(one[name]) + 0 for one in alone]
        same = [
            x.shape == y.shape and np.allclose(x, y, rtol=1e-12, atol=1e-13, equal_nan=True)
            for x, y, known in zip(found.values[name], values, found.known, strict=True)
            if known
        ]
        if not all(same) or bool(found.known[0]) != bool(np.isfinite(values[0]).all()):
            wrong.append((line, found.known, same))
    assert not wrong


@pytest.mark.parametrize("path", DOCUMENTS, ids=[path.stem for path in DOCUMENTS])
def test_all_numbers_of_a_document_are_those_of_each_variant_alone(path: Path) -> None:
    sheet, space = run(path)
    lines = registry(space)
    cells = [cell for cell in sheet.cells if not any(isinstance(space.get(name), Drawing) for name in cell.gives)]
    given = (name for cell in cells for name in cell.gives if name in lines)
    numbers = {name: np.asarray(space[name]) for name in given if np.asarray(space[name]).dtype.kind in "fc"}
    want = [n for n, value in numbers.items() if np.isfinite(value).all() and (path.stem, n) not in BALANCES]
    fields = [field for field in inputs.declared(sheet.inputs) if field.continuous and type(field) is inputs.Input]
    near = np.random.default_rng(5).uniform(0.999, 1.001, (len(fields), 2))
    given = {field.name: getattr(sheet.inputs, field.name) * x for field, x in zip(fields, near, strict=True)}

    found = recorded(sheet, want, list(given))(given)
    assert found.known.all() and len(want) > 5
    largest = dict[str, float]()
    for name in want:  # of the same unit: what is zero but for rounding is no nearer than that
        unit = lines[name].unit
        largest[unit] = max(np.max(np.abs(numbers[name]), initial=0), largest.get(unit, 0))
    wrong = []
    for k in range(2):
        alone = sheet.run(want, {"g": inputs.instance(sheet.inputs, {name: x[k].item() for name, x in given.items()})})
        for name in want:
            own, x = np.asarray(alone[name]), found.values[name][k]
            near = 1e-11 * np.max(np.abs(own), initial=0) + 1e-13 * largest[lines[name].unit]
            if own.shape != x.shape or not np.allclose(x, own, rtol=0, atol=near):
                wrong.append((name, own, x))
    assert not wrong


MIXED = """def part(v):
    return v * v.max() / np.mean(v)  # [-] part
y = part(x)  # [-] field
m = float(g.F) * np.argmax(np.sin(x))  # [-] number
z = x.sum() if g.F > 3 else g.a - max(x)  # [-] by cases
"""
MANY = {"F": np.random.default_rng(8).uniform(0.5, 6, 400), "a": np.linspace(0.2, 2, 400)}


def assert_those_of_each_alone(sheet: Worksheet, want: list[str], **given: Any) -> Sweep:
    swept = sweep(sheet.path, want, given)
    for k in range(0, swept.solved.size, 15):
        one = {name: x[k] for name, x in given.items()}
        g = inputs.build(sheet.inputs, one)
        if swept.solved[k]:
            alone = by_cells(sheet, want, g)
            for name in want:
                assert swept[name][k] == pytest.approx(alone[name], rel=1e-12)
        else:
            with pytest.raises(ValueError):
                by_cells(sheet, want, g)
    return swept


def runs(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The variants that are run alone from now on."""
    ran, run = list[Any](), chunks.Job.run
    monkeypatch.setattr(chunks.Job, "run", lambda job, columns: (ran.append(columns), run(job, columns))[1])
    return ran


def test_lines_that_mix_variants_cost_a_few_runs_whatever_way_they_go(tmp_path: Path, monkeypatch: Any) -> None:
    sheet = own(tmp_path, MIXED)
    swept = assert_those_of_each_alone(sheet, ["y", "m", "z"], **MANY)
    assert swept.at_once and swept.solved.all()
    ran = runs(monkeypatch)
    sweep(sheet.path, ["y", "m", "z"], {name: x[::-1] for name, x in MANY.items()})
    assert len(ran) < 10


@pytest.mark.parametrize("lines", ["y = np.max(x) * x * g.k", "y = np.where(x > 11, np.max(x), x)"])
def test_that_variants_mix_is_seen_where_one_of_them_alone_hides_it(lines: str, tmp_path: Path) -> None:
    given = {"k": np.arange(400) % 4, "F": MANY["F"]}  # two of them hide it: a factor is zero, neither reaches 11
    assert_those_of_each_alone(own(tmp_path, lines), ["y"], **given)


KINDS = [
    "1 if g.F > 3 else g.a / q", "2 if g.F > 3 else q * 1j", "x > g.a if g.F > 3 else x", "(1, 2.5, q)[int(g.F) % 3]",
]  # fmt: skip


@pytest.mark.parametrize("falling", [False, True])
@pytest.mark.parametrize("line", KINDS)
def test_another_way_may_give_a_number_of_another_kind(line: str, falling: bool, tmp_path: Path) -> None:
    """Whole, true or real where the recorded one is not, or the other way round."""
    given = {"F": np.sort(MANY["F"])[:: -1 if falling else 1], "a": MANY["a"]}
    sheet = own(tmp_path, f"q = float(x.max())\ny = ({line}) * 1")
    assert assert_those_of_each_alone(sheet, ["y"], **given).solved.all()
    for f, a in zip(given["F"][::50], given["a"][::50], strict=True):
        once = by_cells(sheet, ["y"], inputs.build(sheet.inputs, {"F": f, "a": a}))["y"]
        assert evaluate(sheet.path, ["y"], F=f, a=a)["y"] == pytest.approx(once, rel=1e-12)


def test_what_the_worksheet_refuses_has_its_reason_and_costs_the_others_nothing(tmp_path: Path) -> None:
    lines = """y = x / x.mean()  # [-] field
s = find(lambda v: v**3 - g.F, 0, 5.5 - g.F)  # [-] root
r = sqrt(g.a - 0.25) + s.value  # [-] number
if g.F > 3.7 and g.a < 0.4:
    raise ValueError("F is too large")
"""
    given = {name: x[::2] for name, x in MANY.items()}
    swept = assert_those_of_each_alone(own(tmp_path, lines), ["y", "r"], **given)
    told = "\n".join(swept.reasons)
    assert swept.at_once and 50 < swept.solved.sum() < 150
    assert "hi = " in told and "is outside" in told and "F is too large" in told
    assert re.search(r"sqrt has no value for g.a - 0.25 = -0\.", told)


FOUND = """f = find(lambda p, q: (p**2 - x + 1, q - g.a), p=np.array([[2.0], [-3.0]]), q=1.0)
y = f.value.p[:, -1] + f.value.q[:, -1]  # [-] roots
n = np.sum(np.isfinite(f.value.p), axis=0)  # [-] how many there are of each
e = f.evaluations  # [-] evaluations"""


@pytest.mark.parametrize("count", [2, 120])
def test_a_find_of_several_axes_may_have_no_root_at_places(count: int, tmp_path: Path) -> None:
    """No variant had a number, and numpy's words of a shape for its reason."""
    sheet, given = own(tmp_path, FOUND), {name: x[:count] for name, x in MANY.items()}
    given["F"] = np.maximum(given["F"], 0.6)  # below there is no root at the last place
    swept = assert_those_of_each_alone(sheet, ["n", "y"], **given)
    assert swept.solved.all() and swept.at_once == (count > 100) and set(swept["n"].flat) == {0, 2}
    lacking = sweep(sheet.path, ["n", "y"], {"F": [0.4, 0.8]})
    assert lacking.solved.tolist() == [False, True] and "no solution for p, q" in lacking.reasons[0]


def test_a_list_of_unlike_parts_hides_no_reason(tmp_path: Path) -> None:
    """The sweep ended in numpy's error of it as soon as one variant had no value."""
    sheet = own(tmp_path, "parts = [x, x[:2]]\ny = np.sqrt(x - 0.1).sum()  # [-] number")
    swept = sweep(sheet.path, ["y"], {"F": [0.5, 2.0]})
    assert swept.solved.tolist() == [False, True] and swept.reasons[0] == "y has no value"
    with pytest.raises(TypeError, match="parts is no number and cannot be swept"):
        sweep(sheet.path, ["parts"], {"F": [0.5, 2.0]})


def test_lines_beside_a_drawing_go_at_once(tmp_path: Path) -> None:
    """Python looked at each point of it; what it refuses has its reason."""
    lines = """from mechsheet import Drawing
u = x / x.mean()
d = Drawing(frame=[0, u[0]], scales={"N": g.F - 0.7}).wheel(0j, g.a - 0.3).cylinder(0j, g.F + 0j, barrel=4.5 - g.F)
y = d and u * g.a"""
    swept = assert_those_of_each_alone(own(tmp_path, lines), ["y"], **MANY)
    told = "\n".join(swept.reasons)
    assert swept.at_once and swept.solved.sum() > 100
    assert all(what in told for what in ("radius of the wheel", "barrel of the cylinder", "scale of the arrows"))


def test_what_is_zero_but_for_rounding_hinders_no_other_result(monkeypatch: Any) -> None:
    """It differs from itself with each way to compute it, by which none of the results went at once."""
    path, ran = ROOT / "worksheets" / "landing_gear.py", runs(monkeypatch)
    swept = sweep(path, ["F3", "M2", "M3", "R03"], {"a": np.linspace(0.19, 0.21, 200)})
    assert swept.at_once and swept.solved.all() and len(ran) < 10
    assert np.abs(swept["F3"]).max() < 1e-11 * np.abs(swept["R03"]).max()


@pytest.mark.parametrize(
    ("lines", "given"),
    [
        ("t = 1.0\nwhile t > 1e-9:\n    t = t * g.a / 4\ny = x / x.mean() + t", MANY),
        ("import json\ny = x * float(json.loads('2')) / x.max() * g.a", MANY),
        ("y = np.max(x) * x + g.a", {name: x[:50] for name, x in MANY.items()}),
    ],
    ids=["a loop to convergence", "another's package", "few"],
)
def test_what_no_recording_knows_runs_alone(lines: str, given: Any, tmp_path: Path) -> None:
    assert not assert_those_of_each_alone(own(tmp_path, lines), ["y"], **given).at_once


def test_nothing_changes_with_chunks_threads_and_processes(tmp_path: Path) -> None:
    sheet, want = own(tmp_path, MIXED), ["y", "m", "z"]
    ways: list[dict[str, Any]] = [{}, {"chunk": 7}, {"executor": ThreadPoolExecutor(2), "chunk": 60}]
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        several = [sweep(sheet.path, want, MANY, **way) for way in (*ways, {"executor": pool, "chunk": 150})]
    for other in several[1:]:
        assert all(np.array_equal(several[0][name], other[name]) for name in want)
