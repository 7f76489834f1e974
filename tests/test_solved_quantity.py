"""Found values while a worksheet is recorded: solved again for other inputs, and never shown for inputs not theirs."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from as_script import as_script
from test_recalculation import edit
from test_recorded_worksheet import own, recorded, value_of
from written_cells import Values

from mechsheet import closed_form, evaluate, find, sweep
from mechsheet.recording.dimensions import mismatches
from mechsheet.worksheet import cells
from mechsheet.worksheet.errors import SheetError

OTHER: list[dict[str, float]] = [{"F": 3.25}, {"F": 1.75, "a": 1.5}, {"a": 0.2}]

TWO = """xy_found = find(
    lambda u, v: (u**2 + v**2, v - g.a * u),
    equals=(g.F**2, 0),
    u=(0, 9),
    v=(0, 9),
)
y = xy_found.value.u  # [-] first
z = xy_found.value.v  # [-] second
yz = np.array([y, z])  # [-] both
table_2 = table("2", "Two", yz)"""

ARRAY = """y_found = find(lambda t: t**3 + g.a * t, 0, 9, equals=x, unknown="t")
y = y_found.value  # [-] each
table_2 = table("2", "Each", y)"""

COMPLEX = """y_found = find(
    lambda p, q: np.exp(1j * p) + g.a * np.exp(1j * q) - 0.2 * x,
    p=1.0,
    q=-1.0,
)
y = y_found.value.p  # [-] angle
z = y_found.evaluations  # [-] evaluations
table_2 = table("2", "Angles", y, z)"""

LEAST = """y_least = minerr(lambda k: (k - g.F, 2 * k - g.a, k**2), k=1.0)
y = y_least.value.k  # [-] fitted
ys = np.array([y])  # [-] one
table_2 = table("2", "Fitted", ys)"""

REDUCED = """y_found = find(
    lambda k, m: (np.sum(k[..., None] * x**2, axis=-1) - g.F, m - k),
    k=np.array([1.0, 2.0]),
    m=1.0,
)
y = y_found.value.k  # [-] share of all
table_2 = table("2", "Share", y)"""

BRANCH = """y_found = find(lambda t, branch: branch * t, -9, 9, equals=g.F, branches=(1, -1), branch=-1, unknown="t")
y = y_found.value  # [-] on its branch
ys = np.array([y])  # [-] one
table_2 = table("2", "Branch", ys)"""


def sheet_with(tmp_path: Path, lines: str) -> cells.Worksheet:
    path = Path(own(tmp_path, lines).path)
    path.write_text(path.read_text().replace("from mechsheet import ", "from mechsheet import export, minerr, ", 1))
    return cells.load(path)


@pytest.mark.parametrize(
    "lines", [TWO, ARRAY, COMPLEX, LEAST, REDUCED, BRANCH], ids=["two", "array", "complex", "least", "sums", "branch"]
)
def test_a_found_value_is_solved_again(lines: str, tmp_path: Path) -> None:
    sheet = sheet_with(tmp_path, lines)
    _, recording = recorded(sheet)

    assert not recording.gaps
    for given in OTHER[1:]:
        value = value_of(recording, "y", given)
        expected = np.asarray(evaluate(sheet.path, ["y"], **given)["y"])
        assert value.shape == expected.shape
        np.testing.assert_allclose(value, expected, rtol=1e-9 if lines is LEAST else 1e-12)


def test_what_has_no_solution_for_other_inputs_is_nan(tmp_path: Path) -> None:
    sheet = own(tmp_path, "u_found = find(lambda u, v: (u**2 + v**2 - g.F, u + v - 1), u=(0, 9), v=(-9, 9))\n"
                "y = u_found.value.u  # [-] found")  # fmt: skip
    _, recording = recorded(sheet)

    assert value_of(recording, "y", {"F": 0.6}) == pytest.approx(0.5 + np.sqrt(0.05))
    assert np.isnan(value_of(recording, "y", {"F": 0.4}))


@pytest.mark.parametrize(
    ("unknown_unit", "told"),
    [("m", []), ("N", ["subtracts", "adds", "does not fit"])],
)
def test_dimensions_of_several_unknowns_are_checked(unknown_unit: str, told: list[str], tmp_path: Path) -> None:
    path = tmp_path / "own.py"
    own(tmp_path, "d_found = find(lambda d, e: (d * g.F - g.a, d - e), d=1.0, e=2.0, unit=('N*m', 'm'), "
        f"unknown_unit=({unknown_unit!r}, 'm'))\ny = d_found.value.d  # [m] arm")  # fmt: skip
    text = path.read_text().replace("# [-] number", "# [N] force").replace("# [-] part", "# [N*m] moment")
    path.write_text(text.replace("* g.F  # [-] field", "# [-] field"))
    mistakes = [str(m) for m in mismatches(path)]
    assert bool(mistakes) == bool(told)
    assert all(any(word in mistake for word in told) for mistake in mistakes)


def exported(tmp_path: Path, lines: str) -> Path:
    sheet = sheet_with(tmp_path, lines)
    path = Path(sheet.path)
    cell = '\n@app.cell\ndef workbook():\n    export("Own", globals())\n    return\n\nif __name__'
    path.write_text(path.read_text().replace("\nif __name__", cell))
    run = as_script(path, f"--out={tmp_path}")
    assert (tmp_path / "own.xlsx").exists(), run.stdout + run.stderr
    return tmp_path / "own.xlsx"


@pytest.mark.office
def test_the_workbook_has_residuals_and_no_value_of_other_inputs(recalculated: Any, tmp_path: Path) -> None:
    path = exported(tmp_path, TWO)
    before = recalculated(path)
    rows = [[c.value for c in row] for row in before["Find"].iter_rows(min_row=3)]
    u = 2.5 / np.hypot(1, 0.75)
    assert [row[0] for row in rows] == ["y", "z"]
    assert [row[1] for row in rows] == pytest.approx([u, 0.75 * u], rel=1e-12)
    assert all(abs(row[4]) < 1e-12 for row in rows) and [row[9] for row in rows] == ["found", "found"]
    assert [row[6:8] for row in rows] == [[0, 9], [0, 9]]

    after = recalculated(edit(path, {"F": 3.5}, tmp_path / "edited.xlsx"))
    assert {row[k].value for row in after["Find"].iter_rows(min_row=3) for k in (1, 4)} == {"#N/A"}
    assert {c.value for row in after["2 Two"].iter_rows(min_row=5) for c in row} == {"#N/A"}


@pytest.mark.office
def test_an_array_of_problems_is_searched_by_the_cells(recalculated: Any, tmp_path: Path) -> None:
    path = exported(tmp_path, ARRAY)
    live, stored = recalculated(path), Values(path)
    values = [row[0].value for row in live["2 Each"].iter_rows(min_row=5)]
    assert values == pytest.approx([row[0].value for row in stored["2 Each"].iter_rows(min_row=5)], rel=1e-12)
    after = recalculated(edit(path, {"a": 0.5}, tmp_path / "edited.xlsx"))
    own = evaluate(tmp_path / "own.py", ["y"], a=0.5)["y"]
    assert [row[0].value for row in after["2 Each"].iter_rows(min_row=5)] == pytest.approx(own, rel=1e-12)


CLOSED = """from mechsheet import closed_form
uv_found = find(
    lambda u, v: (u + v, v - g.a * u),
    equals=(x, 0),
    u=1.0,
    v=1.0,
)
y = uv_found.value.u  # [-] first
z = uv_found.value.v  # [-] second
uv_c = closed_form(uv_found, u=x / (1 + g.a), v=x * g.a / (1 + g.a))
table_2 = table("2", "Each", y, z)"""


@pytest.mark.office
def test_several_unknowns_with_closed_forms_follow_changed_inputs(recalculated: Any, tmp_path: Path) -> None:
    path = exported(tmp_path, CLOSED)
    after = recalculated(edit(path, {"a": 0.5, "F": 3.0}, tmp_path / "edited.xlsx"))
    own_values = evaluate(tmp_path / "own.py", ["y", "z", "uv_c"], a=0.5, F=3.0)
    rows = [[c.value for c in row] for row in after["2 Each"].iter_rows(min_row=5)]
    assert [row[0] for row in rows] == pytest.approx(own_values["y"].tolist(), rel=1e-12)
    assert [row[1] for row in rows] == pytest.approx(own_values["z"].tolist(), rel=1e-12)
    assert [c.verdict for c in own_values["uv_c"]] == ["pass", "pass"]
    assert {row[4].value for row in after["Checks"].iter_rows(min_row=3)} == {"PASS"}


def test_a_closed_form_of_no_unknown_is_refused() -> None:
    found = find(lambda u, v: (u + v - 3, u - v - 1), u=1.0, v=1.0)
    assert [c.name for c in closed_form(found, v=1.0)] == ["v: Find and the closed form"]
    with pytest.raises(SheetError, match=r"^closed form of w: the unknowns are u, v$"):
        closed_form(found, w=1.0)


def test_a_sweep_has_nan_with_the_reason(tmp_path: Path) -> None:
    lines = "u_found = find(lambda u, v: (u**2 + v**2 - g.F, u + v - 1), u=1.2, v=-0.2)\ny = u_found.value.u  # [-] u"
    swept = sweep(own(tmp_path, lines).path, ["y"], {"F": [2.5, 0.4, 1.0]})

    assert swept.at_once
    assert np.isnan(swept["y"]).tolist() == [False, True, False]
    assert swept["y"][[0, 2]] == pytest.approx([0.5 + np.sqrt(F / 2 - 0.25) for F in (2.5, 1.0)], rel=1e-12)
    assert swept.reasons[1].startswith("no solution for u, v from the guess: equation ")


def test_a_sweep_of_least_squares_has_all_its_values(tmp_path: Path) -> None:
    swept = sweep(sheet_with(tmp_path, LEAST).path, ["y"], {"F": [2.5, 3.0]})

    assert np.isfinite(swept["y"]).all() and swept.reasons.tolist() == ["", ""]
