"""What a sweep is given: parts of results as any other study takes them, and in a line what is of another kind."""

from pathlib import Path

import numpy as np
import pytest
from by_cells import by_cells

from mechsheet.studies.sweep import grid, sweep
from mechsheet.worksheet.errors import SheetError
from tests.own_worksheet import own

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


@pytest.mark.parametrize(
    "values", [[True, False], [False], (True,), np.array([False, True]), [1, 0], [2.5], "left", ["left", "right"], 3]
)
def test_a_grid_has_every_value_of_each_input_in_its_order(values):
    """Truth values too, which numpy takes for a choice among the others."""
    axes = grid(first=values, second=[1.0, 2.0, 3.0], third=values)
    shape = np.broadcast_shapes(*(axis.shape for axis in axes.values()))
    assert shape == (np.size(values), 3, np.size(values))
    for name, k in (("first", 0), ("third", 2)):
        along = np.moveaxis(np.broadcast_to(axes[name], shape), k, 0)
        assert along.reshape(len(along), -1)[:, 0].tolist() == np.atleast_1d(values).tolist()


def test_a_grid_of_a_matrix_is_refused():
    with pytest.raises(SheetError, match=r"P6 of a grid has shape \(2, 2\): give its values along one axis"):
        grid(P6=np.eye(2))


LINES = "s = np.gradient(g.a * t**2, t)", "s = t if g.a > 0 else -t", "s = t * float(g.a)", "s = np.roll(t, int(g.a))"


@pytest.mark.parametrize("line", LINES)
def test_where_no_variant_has_a_solution_each_has_its_reason(tmp_path, line):
    """Beside a line that takes no arrays of variants, which nothing shows as long as none is solved."""
    find = "r = find(lambda r: g.a * r**2, 0, 1, equals=9.0).value"
    sheet = own(tmp_path, f"t = np.linspace(0, 1, 5)\n{line}\n{find}\ny = s + r")
    swept = sweep(sheet.path, ["y", "r"], {"a": [0.5, 1.0, 2.0]})
    assert [reason.startswith("unknown x: f(x) reaches 0..") for reason in swept.reasons] == [True] * 3
    assert np.isnan(swept["r"]).all()
