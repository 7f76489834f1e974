"""What a sweep is given: parts of results as any other study takes them, and in a line what is of another kind."""

from pathlib import Path

import numpy as np
import pytest
from by_cells import by_cells

from mechsheet.studies.sweep import sweep
from mechsheet.worksheet.errors import SheetError

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"path": 5}, "worksheet = 5 must be a path"),
        ({"want": "GS6"}, r"want = 'GS6' must be a list of names, such as \['GS6'\]"),
        ({"want": 5}, "want = 5 must be a list of names"),
        ({"want": ["GS6", 5]}, r"want = \['GS6', 5\] must be a list of names"),
        ({"want": None}, "want = None must be a list of names"),
        ({"variants": [1, 2]}, r"variants = \[1, 2\] must be a mapping of inputs to their values, or a DataFrame"),
        ({"variants": None}, "variants = None must be a mapping"),
        ({"variants": {"P6": [[1], [1, 2]]}}, r"P6 = \[\[1\], \[1, 2\]\] N is no array of numbers"),
        ({"variants": {5: [1, 2]}}, "input 5 is unknown"),
        ({"chunk": 2.5}, r"chunk = 2\.5 variants must be at least 1 and whole"),
        ({"chunk": "5"}, "chunk = '5' variants must be"),
        ({"executor": 5}, "executor = 5 must be an executor, or a function that makes one"),
    ],
)
def test_an_argument_of_another_kind_is_named(change, message):
    arguments = {"path": HITCH, "want": ["GS6"], "variants": {"P6": [1, 2]}} | change
    with pytest.raises(SheetError, match=message):
        sweep(**arguments)


@pytest.mark.parametrize("value", [None, {}, "heavy"])
def test_what_is_no_number_is_the_reason_of_its_variant(value):
    swept = sweep(HITCH, ["GS6"], {"P6": [value, 30e3]})
    assert swept.reasons[0].endswith("is no number") and swept.reasons[1] == ""


def test_parts_of_results_are_swept_as_they_are_evaluated():
    wanted = ["abs(R56)", "PS6_S.imag", "PS6_S.real", "R56"]
    swept = sweep(HITCH, wanted, {"P6": [20e3, 30e3]})
    for i, P6 in enumerate((20e3, 30e3)):
        alone = by_cells(HITCH, wanted, P6=P6)
        for name in wanted:
            assert np.array_equal(swept[name][i], alone[name]), name
    assert [swept.units[name] for name in wanted] == ["N", "m", "m", "N"]
    assert list(swept.frame())[3:-1] == ["R56 [N]", "YS6 [m]", "XS6 [m]", "R56x [N]", "R56y [N]"]
    with pytest.raises(TypeError, match="instant centre: Imp = I56 is no number and cannot be swept"):
        sweep(HITCH, ["instant centre: Imp = I56"], {"P6": [20e3, 30e3]})
