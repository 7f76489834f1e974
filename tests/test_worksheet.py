"""A worksheet as a function: the right cells, the right values, the right machine."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mechsheet.errors import SheetError
from mechsheet.worksheet import evaluate, load
from worksheets import hitch

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"


def test_capacity_runs_only_what_it_depends_on():
    needed = [cell.name for cell in load(HITCH).needed(["GS6"], ["g"])]
    assert set(needed) == {
        *("hinges", "coordinate", "group_1", "group_2", "find_L4", "find_S_p", "group_3", "find_L7"),
        *("fields", "centre_of_mass", "ratios", "analogues", "capacity"),
    }
    assert len(needed) < len(load(HITCH).cells) / 4


def test_same_values_as_the_whole_run():
    g = replace(hitch.Hitch(), P6=30e3)
    whole = hitch.app.run(defs={"g": g})[1]
    some = evaluate(HITCH, ["GS6", "R56", "table_31"], P6=30e3)
    assert list(some) == ["GS6", "R56", "table_31"]
    assert np.array_equal(some["GS6"], whole["GS6"]) and np.array_equal(some["R56"], whole["R56"])
    assert [c.symbol for c in some["table_31"].columns] == [c.symbol for c in whole["table_31"].columns]


def test_inputs_in_display_units_or_whole():
    upright = evaluate(HITCH, ["phi6_S"], phi_P6=85)["phi6_S"]
    assert np.array_equal(
        upright, evaluate(HITCH, ["phi6_S"], g=replace(hitch.Hitch(), phi_P6=np.deg2rad(85)))["phi6_S"]
    )


def test_intermediate_results_can_be_given():
    names = load(HITCH).run(["P56_S"], {"g": hitch.Hitch(), "L4": 0.7})
    assert names["L4"] == 0.7 and "L4_found" not in names


@pytest.mark.parametrize(
    ("want", "given", "message"),
    [
        ("GS66", {}, "GS66 is defined by no cell of "),
        ("GS6", {"P66": 1}, "input P66 is unknown; nearest: P6"),
        ("GS6", {"P6": -1}, "weight of the implement P6 = -1.0 N must be >= 0"),
        ("GS6", {"Y_P56": 3}, "working stroke S_p: height Y56 of the suspension axis reaches"),
    ],
)
def test_what_cannot_be_answered_is_said(want, given, message):
    with pytest.raises(SheetError) as error:
        evaluate(HITCH, [want], **given)
    assert str(error.value).startswith(message)


def test_file_that_cannot_be_read(tmp_path):
    with pytest.raises(SheetError, match=r"none\.py cannot be read"):
        load(tmp_path / "none.py")
    broken = tmp_path / "broken.py"
    broken.write_text("a = (\n")
    with pytest.raises(SheetError, match=r"broken.py, line 1: '\(' was never closed"):
        load(broken)


def test_changed_file_is_read_again(tmp_path):
    sheet = tmp_path / "sheet.py"
    text = "import marimo\napp = marimo.App()\n\n@app.cell\ndef one():\n    a = {}\n    return (a,)\n"
    for value in (1, 22):
        sheet.write_text(text.format(value))
        assert load(sheet).run(["a"], {})["a"] == value
