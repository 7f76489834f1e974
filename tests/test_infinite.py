"""Infinite numbers on the way to finite ones: cells hold none, so they have the exported number there, or none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from as_script import as_script
from own_worksheet import written
from test_counted_turns import recorded
from test_random_statements import OTHER, by_page, by_reader, plain, sheet_of
from test_recalculation import computed, disagreements, edit, lines_apart
from written_cells import Values

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """import numpy as np
from numpy import arctan, exp, isfinite, linspace, minimum, tan, where
from mechsheet import ask, export, figure, inputs, read, table"""
GIVEN = """k: float = 2.0  # [-] limit; >= 0
z: float = 0.0  # [-] where it is infinite"""
LINES = """th = linspace(0, 1, 6)  # [-] angle
cot = 1 / tan(th - g.z)  # [-] infinite at one place
a = minimum(cot, g.k)  # [-] limited
b = arctan(g.k / (th - g.z))  # [-] angle from a ratio
c = 1 / (1 / (th - g.z) + 1 / g.k)  # [-] in series
d = exp(-g.k / abs(th - g.z))  # [-] decay
e = where(th > g.z, g.k / where(th > g.z, th, 1.0), 0.0)  # [-] never infinite
p = where(cot > g.k, 1.0, cot)  # [-] by a comparison
q = isfinite(cot) * 1.0  # [-] which are finite
turned = a[::-1] + 1.0  # [-] from what is limited
least = cot.min()  # [-] least
beyond = where(th > 0.3, th, np.inf).min()  # [-] least beyond, from infinity
after = np.nanmax(a)  # [-] greatest of what is limited
table_1 = table("1", "All", th, a, b, c, d, e, p, q, turned)
figure_1 = figure("1", "Limited", th, a)"""
# The places of some numbers, where infinity stands for those that are out of the question.
PLACES = [
    "y_0 = np.argmin(np.where(g.F > g.u, g.F, np.inf)) * 1.0",
    "y_0 = np.argmax(np.where(g.F > g.u, -g.F, -np.inf)) * 1.0",
    "y_0 = g.F[np.argmin(np.where(g.F > 0.6 * g.u, np.abs(g.F - g.x), np.inf))]",
    "y_0 = np.argsort(np.where(g.F > 0.1 * g.u, g.F, np.inf), kind='stable')[0] * 1.0",
    "m = np.stack([g.F, np.where(g.F > g.u, g.F * g.x, np.inf)])\ny_0 = np.argmin(m, axis=1).sum() * 1.0",
]
# Of great numbers: Python's own functions have an error, numpy's are infinite, and what is bounded stays so.
GREAT = [
    "y_0 = min(5.0, math.exp(300 * (g.x + g.u)))", "y_0 = 3 + 1 / math.exp(900 * abs(g.x))",
    "y_0 = max(1.0, -math.expm1(500 * g.x))", "y_0 = 1 / math.cosh(500 * g.x)", "y_0 = math.atan(math.sinh(400 * g.x))",
    "y_0 = 1 / (1 + g.u ** (700.0 * g.x))", "y_0 = 1 / (1 + np.exp(300 * g.u))", "y_0 = np.tanh(400.0 * g.x)",
    "y_0 = math.tanh(1e300 * g.x)", "y_0 = np.expm1(-1500 * g.x)", "y_0 = math.exp(-2000 * abs(g.x))",
    "y_0 = np.tanh(g.F * 1e4 * g.x).sum()",
]  # fmt: skip
LOST = {"a", "b", "c", "d", "p", "least"}


@pytest.fixture
def worksheet(tmp_path: Path) -> Path:
    path = tmp_path / "infinite.py"
    path.write_text(written(SETUP, GIVEN, LINES, "Infinite"))
    return path


def test_a_run_tells_where(worksheet: Path) -> None:
    run = as_script(worksheet)
    told = {line.split(":")[1].rpartition(" ")[2] for line in run.stdout.splitlines() if "infinite number" in line}
    assert told == LOST, run.stdout


@pytest.mark.office
@pytest.mark.filterwarnings("ignore:divide by zero")  # as the worksheet does
def test_cells_have_the_exported_number_or_none(
    worksheet: Path, recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """They had none where the worksheet has one, and the greatest on the front passed over it in silence."""
    path = computed(worksheet, tmp_path, {})
    changes: list[dict[str, Any]] = [{"k": 3.0}, {"z": 0.1}, {"z": 0.2, "k": 1.5}]
    edited = [edit(path, change, tmp_path / f"{n}.xlsx") for n, change in enumerate(changes)]
    same, *others = recalculated_all([path, *edited])
    own = Values(path)
    assert not [*disagreements(same, own, r"\d|Front")] and not [*lines_apart(same, own)]
    for n, (change, there) in enumerate(zip(changes, others, strict=True)):
        (tmp_path / f"{n}").mkdir()
        here = Values(computed(worksheet, tmp_path / f"{n}", change))
        apart = [*disagreements(there, here, r"\d"), *lines_apart(there, here)]
        assert all("'#N/A' instead of" in text for text in apart), "what it does not follow is no number"
        apart = [text for text in apart if "'after'" not in text]  # nobody knows what it passes over
        assert bool(apart) == (change != {"z": 0.1}), "where nothing is infinite all else is followed"
        front = {row[0]: row[4] for row in there["Front"].iter_rows(values_only=True) if row[0] == "a"}
        assert ("no number in 1 of 6" in front["a"]) == (change != {"z": 0.1})


@pytest.mark.parametrize("lines", PLACES)
def test_a_page_has_the_place_of_a_number_among_infinite_ones(lines: str, blank: Page, tmp_path: Path) -> None:
    """It was grey for all other inputs, as if the finite numbers could not be told apart."""
    sheet = sheet_of(tmp_path, lines.split("\n"))
    told = [own for (own,) in plain(sheet, ["y_0"])]
    recording = recorded(sheet, every=1, draws=True, lists=True)
    assert recording.gaps == []
    nodes = {0: recording.tables["y_0"][0].re}
    looked = {0: [guard.holds for guard in recording.looked["zy_0"]]}
    readers = by_reader(recording, nodes, looked, lists=True), by_page(blank, sheet, recording, nodes, looked)
    for found in readers:
        assert [shown.get(0) for shown in found] == pytest.approx(told), OTHER


@pytest.mark.filterwarnings("ignore:overflow")  # as the worksheets do
@pytest.mark.parametrize("line", GREAT)
def test_a_page_has_a_number_of_great_ones_where_python_has_one(line: str, blank: Page, tmp_path: Path) -> None:
    """It made something of infinity where Python has an error, and had none of tanh beyond 355."""
    sheet = sheet_of(tmp_path, [line])
    told = [own for (own,) in plain(sheet, ["y_0"])]
    recording = recorded(sheet, every=1, draws=True, lists=True)
    nodes = {0: recording.tables["y_0"][0].re}
    looked = {0: [guard.holds for guard in recording.looked["zy_0"]]}
    shown = by_page(blank, sheet, recording, nodes, looked)
    assert [values.get(0, np.nan) for values in shown] == pytest.approx(told, nan_ok=True), OTHER
