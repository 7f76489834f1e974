"""Several unknowns without closed forms are found by the cells of the workbook, by the worksheet's own steps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import recorded
from test_recalculation import edit
from test_solved_quantity import sheet_with

from mechsheet import evaluate
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import bottom_up
from mechsheet.readers.numbers import numbers
from mechsheet.readers.searched import search
from mechsheet.run import report
from mechsheet.worksheet import cells
from mechsheet.worksheet.errors import SheetError

LINES = """uv_found = find(lambda u, v: EQUATIONS, STARTS)
y = uv_found.value.u  # [-] first
z = uv_found.value.v  # [-] second
yz = np.array([y, z])  # [-] both
table_2 = table("2", "Two", yz)"""
STEPPED = {  # equations, guesses, and how many tenths of the inputs have a value at least, in each element
    "circle": ("(u**2 + v**2 - g.F**2, v - g.a * exp(u / 9))", "u=g.F, v=0.0", 7),
    "loop": ("np.exp(1j * u) + g.a * np.exp(1j * v) - 0.2 * x", "u=1.0, v=-1.0", 2),
    "far roots": ("(u * v - g.F, np.sin(u / 4) + v * g.a - 2)", "u=2.0, v=1.0", 3),
    "corners": (
        "(abs(u) * u + np.maximum(v, g.a) - g.F, np.where(u > 1, v**g.a, v) + np.hypot(u, v) - x)", "u=1.2, v=2.0", 3
    ),
    "at a corner": ("(abs(u - 1) - g.a + v / 9, v - g.F)", "u=1.000001, v=2.0", 0),
    "a jump": ("(u + np.sign(v - 2) - g.a, v - g.F)", "u=0.5, v=2.0", 10),
    "angles": (
        "np.exp(1j * u) + g.a * np.exp(1j * v) - 0.2 * x", "u=1.0, v=-1.0, unknown_unit=('deg', 'rad')", 2
    ),
    "a link": ("v * np.exp(1j * u) - g.F * np.exp(1j * x)", "u=0.3, v=1.0, unknown_unit=('deg', 'm')", 10),
    "a link, linear before": (
        "(v * np.cos(u) - g.F, v - 3 * g.F - g.a)", "u=4.0, v=1e-3, unknown_unit=('deg', 'm')", 10
    ),
    "linear behind": ("(u**2 - g.F, v * u - g.a * np.exp(u) - x)", "u=0.2, v=1e9", 10),
    "a jump behind": ("(u**3 - g.F, v - np.sign(v - 2) - g.a * u)", "u=1.0, v=1.0", 5),
    # of whole fields for each
    "integral": ("(np.trapezoid(np.exp(-u * x) * v, x) - g.a, v**3 - u - g.F)", "u=0.2, v=1.0", 8),
    "sums": ("(np.sum(np.exp(-u[..., None] * x), -1) + v - g.F, v - u**2)", "u=0.1 + 0.1 * x, v=1.0", 2),
    "contact": (
        "(np.sum(np.maximum(u + v * x, 0)) - g.F, np.sum(np.maximum(u + v * x, 0) * x) - g.a)", "u=1.0, v=0.1", 2
    ),
    "contacts": ("(np.sum(np.maximum(u[..., None] + (x - 1) * v[..., None], 0), -1) - x, v - g.a * u)", "u=x, v=1", 10),
    "means": ("(np.mean(np.maximum(u[..., None] * x - g.a * x**2 / 9, 0), -1) - x, v - u)", "u=x, v=1.0", 9),
    "slopes": ("(np.sum(np.gradient(np.exp(u * x), x)) - g.F, v - g.a)", "u=0.77, v=1.0", 10),
    "lever": ("(np.sum(np.abs(u * (x - x[0]))) - g.F, v - g.a * u)", "u=1.0, v=1.0", 10),
    "tables": ("(np.interp(u, [0, 1, 2, 4], [0, g.a, 2.5, 9]) - v, v + u - x)", "u=1.3, v=1.0", 8),
    "any": ("(u**2 + np.where(np.any(u > x), 1, 0) - g.F, v - g.a)", "u=1.0, v=1.0", 8),
    "put together": (
        "(np.concatenate([[u], v * x])[1:].sum() + u**2 - g.F, np.stack([u, v])[1] - g.a * u)", "u=1.0, v=1.0", 8
    ),
    "singular": ("(u + v - g.F, u + np.where(g.a < 0.8, 0.5, 1 + 4e-16 * g.a) * v - 1)", "u=1.0, v=1.0", 3),
    "ratio": ("(np.pi * np.arctan2(v, u) - g.a, np.sqrt(u) * np.log(v + 3) - g.F + np.tan(v / 4))", "u=2.0, v=1.0", 6),
    "linear": ("(g.F * u - v - 1, u + 1e3 * g.a * v - 5)", "u=1.0, v=1e-5", 10),
}  # fmt: skip
THREE = """uvw_found = find(
    lambda u, v, w: (u * v + w - g.F, v + w**3 - 2 * g.a, np.sin(u / 4) + v * w - 0.9), u=2.0, v=1.0, w=g.a
)
y = uvw_found.value.u  # [-] first
z = uvw_found.value.w  # [-] third
yz = np.array([y, z])  # [-] both
table_2 = table("2", "Two", yz)"""


def assert_the_same_or_none(sheet: cells.Worksheet, found: str, tenths: int) -> None:
    """What cells compute is what the worksheet finds for whatever inputs, else there is nothing."""
    _, recording = recorded(sheet)
    search(recording)
    assert bool(recording.unsolved) == (tenths == 0)
    if not tenths:
        return
    random, shown = np.random.default_rng(16), list[float]()
    roots = [solved.inverse for solved in recording.found.values() if solved.inverse]
    assert len(roots) == len(recording.found)
    assert not any(node.op == "found" for node in bottom_up(roots, ())), "cells in a circle"
    for F, a in zip(random.uniform(1, 6, 10)[1::2], random.uniform(0.05, 2, 10)[1::2], strict=True):
        known = numbers(roots, {recording.inputs["F"]: F, recording.inputs["a"]: a})
        values = np.asarray([known[root] for root in roots])
        there = np.isfinite(values)
        shown.append(there.mean())
        if not there.any():
            continue
        try:
            own = np.asarray(evaluate(sheet.path, [found], F=F, a=a)[found]._values)
        except SheetError:
            own = np.full(len(roots), np.nan)
        np.testing.assert_allclose(values[there], own[there], 1e-10, 1e-10, err_msg=str((F, a)))
    assert np.mean(shown) >= tenths / 10


@pytest.mark.parametrize("name", STEPPED)
def test_steps_end_where_the_worksheet_does(name: str, tmp_path: Path) -> None:
    equations, starts, tenths = STEPPED[name]
    lines = LINES.replace("EQUATIONS", equations).replace("STARTS", starts)
    assert_the_same_or_none(sheet_with(tmp_path, lines), "uv_found", tenths)


def test_steps_of_three_unknowns(tmp_path: Path) -> None:
    assert_the_same_or_none(sheet_with(tmp_path, THREE), "uvw_found", 3)


def test_a_root_of_the_slotted_link_is_found_from_any_guess_that_leads_the_worksheet_to_one() -> None:
    """All six unknowns of both its Finds, from all angles of the link, at inputs within a tenth of the given ones."""
    sheet = cells.load(Path(__file__).parents[1] / "worksheets" / "slotted_link.py")
    _, recording = recorded(sheet)
    search(recording)
    default, random = sheet.inputs(), np.random.default_rng(2026)
    names = [name for name, node in recording.inputs.items() if node.value.dtype.kind == "f"]
    for _ in range(3):
        given = {name: getattr(default, name) * random.uniform(0.9, 1.1) for name in names}
        own = sheet.run(["F_found", "G_found"], {"g": replace(default, **given)})
        for found in recording.found.values():
            assert found.inverse is not None
            block, number = found.node.args
            values = own["F_found" if found.node.value.ndim == 1 else "G_found"]._values[number]
            known = numbers([found.inverse], {recording.inputs[name]: x for name, x in given.items()})
            size = 1e-10 * np.max(np.abs(values))
            np.testing.assert_allclose(known[found.inverse], values, 1e-10, size, err_msg=f"{block.starts} {given}")


def unsolved(tmp_path: Path, lines: str) -> tuple[Recording, str]:
    _, recording = recorded(sheet_with(tmp_path, lines))
    search(recording)
    return recording, "; ".join(map(str, recording.unsolved))


@pytest.mark.parametrize(
    ("equations", "starts", "reason"),
    [
        ("(u**2 + v - 9, v - u)", "u=(0, 9), v=(0, 9)", "intervals"),
        ("(u * u.sum() - x, v - u)", "u=x, v=1.0", "rests on others of them"),
        ("((2 * np.stack([abs(np.sum(u)) + v, u]))[1] - g.F, v - u)", "u=x, v=1.0", "is not that of each value"),
        ("(np.exp(u[..., None] * np.linspace(0, 1, 50000)).sum(-1) - 2e5, v - u)", "u=x, v=1.0", "more than 8,000,000"),
        ("(np.max(u[..., None] * x, -1) - g.F, v - u)", "u=1.0, v=1.0", "the slope of max"),
        ("(u % 3 - g.a, v - g.F)", "u=2.0, v=1.0", "the slope of mod"),
        ("(u - g.F, v - 1, u)", "u=1.0, v=1.0", "squares"),
    ],
)
def test_what_cells_do_not_find_is_named_with_its_reason(
    equations: str, starts: str, reason: str, tmp_path: Path
) -> None:
    lines = LINES.replace("EQUATIONS", equations).replace("STARTS", starts)
    lines = lines.replace("= find(", "= minerr(") if reason == "squares" else lines
    recording, told = unsolved(tmp_path, lines)
    assert "y, z: the workbook has this of the exported inputs: " in told and reason in told
    assert not recording.gaps and all(solved.inverse is None for solved in recording.found.values())


def test_evaluations_are_named(tmp_path: Path) -> None:
    lines = LINES.replace("EQUATIONS", "(u + v**2 - x, v - g.a)").replace("STARTS", "u=1.0, v=1.0")
    _, told = unsolved(tmp_path, f'{lines}\nn = uv_found.evaluations  # [-] count\ntable_3 = table("3", "Count", n)')
    assert told.endswith("n: the workbook has this of the exported inputs: how often the equations are evaluated")


@pytest.mark.office
def test_cells_step_to_what_the_worksheet_finds(recalculated_all: Any, tmp_path: Path) -> None:
    """Of single problems and arrays of them; where it is not sure, nor is what counts numbers."""
    equations, starts, _ = STEPPED["loop"]
    loop = LINES.replace("EQUATIONS", equations).replace("STARTS", starts).split("yz =")[0]
    known = 'one = np.where(np.isfinite(y), 1.0, 0.0)  # [-] found\ntable_3 = table("3", "Loop", y, z, one)'
    three = THREE.replace("yz", "uw").replace("y =", "p =").replace("z =", "q =").replace("[y, z]", "[p, q]")
    equations, starts, _ = STEPPED["contacts"]
    rows = LINES.replace("EQUATIONS", equations).replace("STARTS", starts).split("yz =")[0]
    rows = rows.replace("uv", "rs").replace("y =", "r =").replace("z =", "s =") + 'table_4 = table("4", "Rows", r, s)'
    path = Path(sheet_with(tmp_path, f"{loop}{known}\n{three}\n{rows}").path)
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", cells.load(path).run_whole(), {}))
    changes = [{"F": 1.75, "a": 1.5}, {"F": 3.25}, {"a": 0.8, "F": 2.6}]
    edited = [edit(book, given, tmp_path / f"changed{n}.xlsx") for n, given in enumerate(changes)]
    sure = 0
    for given, changed in zip(changes, recalculated_all(edited), strict=True):
        own = evaluate(path, ["y", "z", "uw", "r", "s"], **given)
        rows = [*changed["3 Loop"].iter_rows(min_row=5, max_row=9, values_only=True)]
        for row, y, z in zip(rows, own["y"], own["z"], strict=True):
            assert row[:2] == ("#N/A", "#N/A") or row[:2] == pytest.approx((y, z), rel=1e-10)
            assert row[2] == ("#N/A" if any(r[0] == "#N/A" for r in rows) else 1)
        found = [row[0] for row in changed["2 Two"].iter_rows(min_row=5, max_row=6, values_only=True)]
        assert found == pytest.approx(own["uw"].tolist(), rel=1e-10) or found == ["#N/A", "#N/A"]
        for row, *rs in zip(changed["4 Rows"].iter_rows(5, 9, 1, 2, values_only=True), own["r"], own["s"], strict=True):
            assert row == pytest.approx(rs, rel=1e-10)
        sure += "#N/A" not in found
    assert sure >= 2
    front = [row[0] for row in changed["Front"].iter_rows(values_only=True)]
    assert any("not sure that the worksheet finds the same" in str(text) for text in front)
    kinds = [row[9] for row in changed["Find"].iter_rows(min_row=3, values_only=True)]
    assert kinds == ["Newton's steps from its guess"] * 3  # also of the unknown that no line takes
