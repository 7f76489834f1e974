"""Lists of other lengths among the inputs: what the page makes of their rows is what the worksheet does."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from in_browser import evaluated

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.recording.record import record
from mechsheet.worksheet import cells, inputs

if TYPE_CHECKING:
    from playwright.sync_api import Page

SHEET = '''import marimo

app = marimo.App()

with app.setup:
    import numpy as np

    from mechsheet import ask, export, find, inputs, read, table, typeset

    @inputs
    class Point:
        x: float  # [-] place; > 0
        y: float  # [-] level


@app.class_definition
@inputs
class Own:
    a: float = 0.75  # [-] part
    F: list[float] = [2.5, -1, 3]  # [-] forces
    points: list[Point] = [Point(1, 2.5), Point(2, 4), Point(4, 3.5), Point(5, 6)]  # points of a curve

    """Inputs."""


@app.cell
def form():
    form = ask(Own)
    return (form,)


@app.cell
def given(form):
    g = read(Own, form)
    return (g,)


@app.cell
def lines(g):
    F = g.F  # [-] forces
    x = g.points.x  # [-] places
    y = g.points.y  # [-] levels
    LINES
    table_1 = table("1", "All", F)
    typeset()
    return


if __name__ == "__main__":
    app.run()
'''
FOLLOWED = [
    "F * g.a + 1", "F.sum()", "np.sum(F**2) / len(F)", "F.mean() - F.std()", "F.max() - F.min()", "F[0] + F[-1]",
    "F[::-1]", "F[1:] - F[:-1]", "np.cumsum(F)", "np.concatenate([[0.0], np.cumsum(F)])", "np.diff(y) / np.diff(x)",
    "np.argmax(F)", "F[np.argmax(abs(F))]", "np.where(F > 0, F, 0).sum()", "len(F) * g.a", "F.size * 1.0",
    "np.arange(len(F)) * F", "np.outer(F, x).sum(axis=1)", "F[:, None] * y", "(F[:, None] * y).max(axis=0)",
    "np.interp(g.a + 1, x, y)", "np.interp(np.linspace(0, 6, 7), x, y)", "np.trapezoid(y, x)", "x @ y", "F @ F",
    "np.exp(1j * F).sum()", "np.linalg.norm(F)", "np.any(F < 0) * 1.0", "np.count_nonzero(F > 0)", "np.ptp(F)",
    "np.stack([x, y])[1]", "np.stack([x, y]).sum(axis=0)", "np.append(F, g.a)", "np.repeat(F, 2)", "np.roll(x, 1)",
    "np.roll(x, -1)", "np.abs(np.roll(F, -2) - F)",
    "np.full_like(F, g.a)", "np.zeros(len(F)) + g.a", "np.gradient(y, x)", "x.shape[0] * g.a", "np.prod(x)",
    "find(lambda t: t**3 + t - F, -9, 9, unknown='t').value", "(x * y).sum() / y.sum()", "np.average(y, weights=x)",
    "find(lambda t: F.sum() * t**3 + t - g.a, -9, 9, unknown='t').value", "np.maximum.accumulate(F)", "np.tile(F, 2)",
    "(y - y.mean()) @ (x - x.mean()) / ((x - x.mean()) @ (x - x.mean()))", "np.hypot(x, y)", "np.median(F)",
    "np.sort(F)", "np.var(F, ddof=1)", "np.vstack([x, y]).T[:, 1]", "np.column_stack([x, y]).sum(axis=1)",
    "np.polyval([1.0, g.a], F)", "F.clip(0, 2)", "np.round(F * g.a)", "F[1:].sum() + F[0]", "np.flip(F)", "max(F)",
    "sum(F)", "sum(F, g.a)", "np.quantile(F, 0.3)", "np.percentile(y, [10, 90])", "x[np.argsort(y, kind='stable')]",
    "x[np.argsort(-x)]", "min(x)",
    "g.points[0].x * g.points[-1].y", "g.points[1:].y.sum()", "len(g.points) * g.a", "g.points[::-1].x - g.points.x",
    "g.points[x > 1].y.sum()", "g.points[np.argmax(y)].x",
    "sum(v * w for v, w in zip(x, y))", "np.array([v * g.a for v in F])", "sum(p.x * p.y for p in g.points)",
    "max(p.y if p.x > 1.5 else g.a for p in g.points)", "any(p.y > 5 for p in g.points) * g.a",
    "sum([1 / max(v, 1.0) for v in F])", "np.vectorize(lambda v: v**2 if v > 0 else g.a)(F)", "sum(1 for v in F) * g.a",
    "(F.sum() * np.array([1.0, 3.0, 2.0]))[np.argmax(F.sum() * np.array([1.0, 3.0, 2.0]))]",
    "(F.sum() * np.linspace(1, 2, 3))[np.argsort(-F.sum() * np.linspace(1, 2, 3))]",
    "sum(v for v in np.sin(x))", "[p.x for p in g.points][1]", "max(g.points, key=lambda p: p.y).x",
    "F[F > 0].sum() + len(F[F > 0])", "F[F > 0][-1]", "x[np.flatnonzero(y > 2)].max() * g.a",
    "np.around(F, 1)", "np.round(F * 1j, 1).imag", "(F * 1j + 1).real", "np.roll(F, np.argmax(F))",
    "np.delete(F, np.argmin(F))", "np.delete(x, -1)", "np.insert(x, len(x), g.a)", "np.insert(F, np.argmin(F), g.a)",
    "np.pad(F, 1, constant_values=g.a)", "np.pad(x, (1, 2), constant_values=(g.a, 2))", "np.insert(F, 1, g.a)",
]  # fmt: skip
COUNTED_BY_PYTHON = {  # lines, and the list whose rows are counted
    "np.array([[v, g.a] for v in F]).sum(axis=0)": "F", "np.fft.fft(F).real": "F",
    "sum(a.x * b.y for a, b in zip(g.points, g.points[1:]))": "points",
    "np.array([x[np.argmin(abs(x - v))] for v in F])": "F", "[np.argsort(x * v)[0] for v in F]": "F",
}  # fmt: skip
CURVE = [(1, 2.5), (2, 4), (4, 3.5), (5, 6)]
GIVEN: list[dict[str, Any]] = [
    {}, {"F": [1.5, 2]}, {"F": [1, 2.5, -4, 6, 0.25], "a": 0.4}, {"points": CURVE[:2]},
    {"points": [*CURVE, (6, 1), (8, 2.5)], "F": [4, 3]}, {"F": list(range(-40, 60))},
]  # fmt: skip


def test_what_is_made_of_lists_is_computed_for_other_lengths(blank: Page, tmp_path: Path) -> None:
    sheet, recording = recorded(tmp_path, FOLLOWED)
    assert not recording.gaps
    parts = parts_of(recording, FOLLOWED)
    given = [leaves(sheet, each) for each in GIVEN]
    for each, found in zip(GIVEN, evaluated(blank, javascript.module(recording, parts), given), strict=True):
        assert not found["guards"]
        expected = sheet.run([f"y_{k}" for k in range(len(FOLLOWED))], {"g": inputs.build(sheet.inputs, each)})
        for k, expression in enumerate(FOLLOWED):
            values = [found["values"][key] for key in (f"{k} 0", f"{k} 1") if key in parts]
            number, own = values[0] if len(values) == 1 else values[0] + 1j * values[1], expected[f"y_{k}"]
            assert np.shape(number) == np.shape(own), (expression, each)
            np.testing.assert_allclose(number, own, rtol=1e-12, atol=1e-13, err_msg=f"{expression} {each}")


def test_what_python_counts_is_empty_for_other_lengths_and_says_why(blank: Page, tmp_path: Path) -> None:
    sheet, recording = recorded(tmp_path, COUNTED_BY_PYTHON)
    script = javascript.module(recording, parts_of(recording, COUNTED_BY_PYTHON))
    given = [leaves(sheet, each) for each in GIVEN]
    for each, found in zip(GIVEN, evaluated(blank, script, given), strict=True):
        for k, (expression, counted) in enumerate(COUNTED_BY_PYTHON.items()):
            value, why = found["values"][f"{k} 0"], found["gaps"].get(f"{k} 0", "")
            assert value is None if counted in each else value is not None, (expression, each)
            assert why.startswith("line ") == (counted in each), (expression, each)


def test_at_its_own_length_alone_a_list_of_another_one_empties_what_rests_on_it(blank: Page, tmp_path: Path) -> None:
    """As in a large page; one of fewer rows ended the page with an error, which left all numbers as they were."""
    numbered = [expression for expression in FOLLOWED if not expression.startswith("find(")]
    beside = "g.a * 2.0"
    sheet, recording = recorded(tmp_path, [*numbered, beside], lists=False)
    script = javascript.module(recording, parts_of(recording, [*numbered, beside]))
    lengths, signs_of, told = {"F": 3, "points": len(CURVE)}, {"F": "F", "points": "xyp"}, 0
    for each, found in zip(GIVEN, evaluated(blank, script, [leaves(sheet, given) for given in GIVEN]), strict=True):
        others = {name for name, own in lengths.items() if len(each.get(name, range(own))) != own}
        for k, expression in enumerate(numbered):
            read = {name for name, signs in signs_of.items() if not set(signs).isdisjoint(expression)}
            why = found["gaps"].get(f"{k} 0", "")
            assert not why or (found["values"][f"{k} 0"] is None and why.split(" ")[0] in read & others)
            told += bool(why)
        assert found["values"][f"{len(numbered)} 0"] == 2 * each.get("a", 0.75)
    assert told > 100


def test_rows_that_a_text_alone_counts_are_the_worksheets_own_where_none_are_given(blank: Page, tmp_path: Path) -> None:
    path, expression = tmp_path / "own.py", ["[2 * p.x for p in g.points]"]
    named = SHEET.replace("        x: float", "        name: str  # label\n        x: float").replace(
        "Point(", 'Point("P", '
    )
    path.write_text(named.replace("LINES", f"y_0 = {expression[0]}  # [-] line"), encoding="utf-8")
    _, recording = recorded_file(path)
    (found,) = evaluated(blank, javascript.module(recording, parts_of(recording, expression)), [{}])
    np.testing.assert_array_equal(found["values"]["0 0"], [2, 4, 8, 10])


def leaves(sheet: cells.Worksheet, given: dict[str, Any]) -> dict[str, Any]:
    """Numbers in SI as the page reads them."""
    g = inputs.build(sheet.inputs, given)
    return {
        name: x
        for field in inputs.declared(sheet.inputs)
        for name, (_, x) in field.leaves(getattr(g, field.name)).items()
    }


def parts_of(recording: Recording, expressions: Collection[str]) -> dict[str, Node]:
    values = [recording.values[f"y_{k}"] for k in range(len(expressions))]
    return {f"{k} {n}": part for k, value in enumerate(values) for n, part in enumerate(value.parts)}


def recorded(tmp_path: Path, expressions: Collection[str], lists: bool = True) -> tuple[cells.Worksheet, Recording]:
    path, lines = tmp_path / "own.py", list[str]()
    for k, expression in enumerate(expressions):
        if expression.startswith("find("):
            lines.append(f"y_{k}_found = {expression.removesuffix('.value')}")
            expression = f"y_{k}_found.value"
        lines.append(f"y_{k} = {expression}  # [-] line")
    path.write_text(SHEET.replace("LINES", "\n    ".join(lines)), encoding="utf-8")
    return recorded_file(path, lists)


def recorded_file(path: Path, lists: bool = True) -> tuple[cells.Worksheet, Recording]:
    sheet = cells.load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    return sheet, record({**names, "__file__": sheet.path}, every=1, draws=True, lists=lists)
