"""A solve block some of whose problems have no solution is told with the problem, and is no success."""

from pathlib import Path

import pytest
from as_script import as_script

from mechsheet.run import batch
from mechsheet.worksheet.scene import Scene
from tests.own_worksheet import own

ROOTS = "lambda r: r**2, 0, 2, equals=np.array([1.0, g.F, 9.0])"
TOLD = "problem 3: unknown x: f(x) reaches 0..4 by 97 samples, 9 is outside"
SEVERAL = "lambda u, v: (u**2, u + v), equals=(np.array([1.0, -9.0]), 0), u=1.0, v=1.0"


def problems(tmp_path: Path, lines: str) -> list[str]:
    """What the scene of a worksheet's own inputs does not pass by."""
    return batch.compute(own(tmp_path, lines), "own", Scene())[0].problems


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        (f"r_found = find({ROOTS})\nr = r_found.value", TOLD),
        (f"r = find({ROOTS}).value", TOLD),
        (f"r = [find({ROOTS}).value for _ in range(2)][0]", TOLD),
        (f"root = lambda: find({ROOTS}).value\nr = root()", TOLD),
        (f"r = find({SEVERAL}).value.u", "problem 2: no solution for u, v from the guess: equation 1 leaves"),
        (f"uv_found = find({SEVERAL})\nr = uv_found.value.u", "problem 2: no solution for u, v from the guess"),
    ],
)
def test_a_problem_without_a_solution_is_told_and_no_success(tmp_path, lines, told):
    found = problems(tmp_path, lines)
    assert found and all(told in problem for problem in found)


@pytest.mark.parametrize(
    "lines",
    [
        f"r_found = find({ROOTS.replace('9.0', '3.0')})\nr = r_found.value",
        # Looked for, and not taken where there is none.
        "for top in (1.0, 2.0, 3.0):\n    r_k = find(lambda r: r**2, 0, top, equals=8.0)\n    if r_k.solved: break\n"
        "r = r_k.value",
        "found = [find(lambda r: r**2, 0, top, equals=np.array([1.5, 8.0])) for top in (2.0, 3.0)]\n"
        "r = next(f.value for f in found if f.solved.all())",
    ],
)
def test_what_is_solved_or_only_looked_for_passes(tmp_path, lines):
    assert problems(tmp_path, lines) == []


def test_a_script_ends_with_one_and_tells_it_once(tmp_path):
    sheet = own(tmp_path, f"r_found = find({ROOTS})\nr = r_found.value\ns = find({ROOTS}).value")
    done = as_script(sheet.path)
    assert done.returncode == 1 and done.stdout.count(TOLD) == 2, "by its name, and what has none"
