"""Dimensions by a change of units: the known offender and no other, and planted mistakes by their lines."""

from pathlib import Path

import pytest

from mechsheet.recording.dimensions import mismatches

EVERY = sorted((Path(__file__).parents[1] / "worksheets").glob("*.py"))
# accuracy compares methods and declares no formula; the design computes through hitch.py, whose inputs keep their metre
WORKSHEETS = [path for path in EVERY if path.stem not in ("accuracy", "hitch_design")]
HITCH = next(path for path in WORKSHEETS if path.stem == "hitch")

# the printed formula of the greatest load subtracts newtons from newton metres
KNOWN = {"hitch": ["GS6_max"]}


@pytest.mark.parametrize("worksheet", WORKSHEETS, ids=lambda path: path.stem)
def test_every_line_scales_by_its_unit_but_the_printed_errata(worksheet):
    assert [m.name for m in mismatches(worksheet)] == KNOWN.get(worksheet.stem, [])


@pytest.mark.parametrize(
    ("right", "wrong", "name"),
    [
        ("F_gc / (g.k_gc * A_gc * g.eta)", "F_gc / (g.k_gc * g.eta)", "P_gc"),
        ("dRb = Rb / (g.P6 + g.P_msha", "dRb = Rb / (g.P6 + g.L", "dRb"),
        ("dphi4 = dphi3 * U43  # [rad/m]", "dphi4 = dphi3 * U43  # [rad]", "dphi4"),
        ("cross(O1 - P23_S, R01)  # [N*m]", "R01.real  # [N*m]", "M2"),
        ("LS6 = sqrt(g.X6**2 + g.Y6**2)", "LS6 = sqrt(g.X6**2 + g.Y6)", "LS6"),
        ("IS6 = I56 + dphi6", "IS6 = I56 + 0.3 * dphi6 + dphi6", "IS6"),
    ],
)
def test_planted_mistake_is_the_first_line_named(tmp_path, right, wrong, name):
    text = HITCH.read_text(encoding="utf-8")
    assert right in text
    sheet = tmp_path / "hitch.py"
    sheet.write_text(text.replace(right, wrong), encoding="utf-8")
    first = mismatches(sheet)[0]
    line = int(str(first).split()[1])
    assert first.name == name
    assert sheet.read_text(encoding="utf-8").splitlines()[line - 1].lstrip().startswith(f"{name} = ")
