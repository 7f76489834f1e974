"""What a worksheet refuses or gets wrong is told with the line where it stands."""

from pathlib import Path

import pytest
from as_script import as_script

from mechsheet.recording.dimensions import mismatches
from tests.own_worksheet import SHEET, own


def line_of(path: str, text: str) -> int:
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    return next(n for n, line in enumerate(lines, 1) if text in line)


@pytest.mark.parametrize(
    "line",
    [
        "y = find(lambda r: r**2 + g.F, 0, 2).value",
        "y = find(lambda r: r**2, 3, 2).value",
        "y = find(lambda u, v: (u**2 + g.F, v), u=1.0, v=1.0).value.u",
        'y = table("2", "Two", x, x[:-1])',
        'y = table("2", "Two", x, show={"x": "no_such"})',
    ],
)
def test_what_a_line_refuses_is_told_with_its_place(tmp_path, line):
    sheet = own(tmp_path, f"{line}")
    number = line_of(sheet.path, line)
    done = as_script(sheet.path)
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    assert f"own.py, line {number}" in done.stderr, done.stderr


@pytest.mark.parametrize(("given", "told"), [("--F=none", "F = 'none' is no number"), ("--G=1", "input G is unknown")])
def test_an_input_has_no_line_of_a_cell(tmp_path, given, told):
    done = as_script(own(tmp_path, "y = x").path, given)
    assert told in done.stderr and "own.py, line" not in done.stderr


@pytest.mark.parametrize(
    ("check", "line"),
    [
        ('check("too long", g.a, g.L, "m")', "line {}, check 'too long'"),
        ('check(f"too {2}", g.a, g.L, "m")', "line {}, check 'too 2'"),
    ],
)
def test_a_check_that_compares_inputs_alone_has_the_line_where_it_stands(tmp_path, monkeypatch, check, line):
    """Nothing of it is computed in that line, which has no quantity of its own."""
    monkeypatch.setattr(
        "tests.own_worksheet.SHEET", SHEET.replace("# [-] part\n", "# [-] part\n    L: float = 2.0  # [N] L\n")
    )
    sheet = own(tmp_path, f"from mechsheet import check\nc = {check}")
    number = line_of(sheet.path, check)
    (mistake,) = mismatches(sheet.path)
    assert str(mistake).startswith(line.format(number))
