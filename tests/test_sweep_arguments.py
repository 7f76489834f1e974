"""What a sweep is given: parts of results as any other study takes them, and in a line what is of another kind."""

import re
from pathlib import Path

import numpy as np
import pytest
from by_cells import by_cells

from mechsheet.recording.evaluation import evaluate
from mechsheet.studies.sensitivity import sensitivity
from mechsheet.studies.sweep import grid, sweep
from mechsheet.studies.tolerance import tolerance
from mechsheet.worksheet.errors import SheetError
from tests.own_worksheet import own

HITCH, GUIDE = (Path(__file__).parents[1] / "worksheets" / f"{name}.py" for name in ("hitch", "guide"))


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


BAND = {"tolerances": {"F": 1.0}, "method": "monte carlo", "seed": 1, "count": 2}
STUDIES = [
    (lambda: sensitivity(GUIDE, []), "want = [] must be a list of names"),
    (lambda: sensitivity(GUIDE, ["M_work"], inputs="F"), "inputs = 'F' must be a list of names, such as ['r']"),
    (lambda: sensitivity(GUIDE, ["M_work"], inputs=[]), "inputs = [] must be a list of names"),
    (lambda: tolerance(GUIDE, ["M_work"], ["F"]), "tolerances = ['F'] must be a mapping of inputs to numbers"),
    (lambda: tolerance(GUIDE, ["M_work"], **BAND | {"seed": 1.5}), "a whole number such as seed=1, not 1.5"),
    (
        lambda: tolerance(GUIDE, ["M_work"], **BAND | {"count": "9"}),
        "count = '9' variants must be at least 2 and whole",
    ),
    (lambda: tolerance(GUIDE, ["M_work"], **BAND | {"percentiles": 5}), "percentiles = 5 must be a list of numbers"),
    (lambda: tolerance(GUIDE, ["M_work"], **BAND | {"percentiles": ["5"]}), "percentile '5' must be 0..100"),
    (lambda: tolerance(GUIDE, ["M_work"], {"F": 1.0})["M"], "'M' is no result of this tolerance: it has M_work"),
    (lambda: evaluate(GUIDE, ["H"], g=9.81), "g = 9.81 must be all inputs"),
    (lambda: evaluate(GUIDE, ["H"], r=1j), "r = 1j mm is no number"),
    (lambda: grid(P6={1, 2}), "P6 of a grid = {1, 2} must be a list of values"),
]


@pytest.mark.parametrize(("call", "message"), STUDIES)
def test_what_a_study_cannot_take_is_named(call, message):
    with pytest.raises(SheetError, match=re.escape(message)):
        call()


def test_a_position_is_a_number_or_an_end():
    """Of another kind it was that of the greatest result."""
    found = sensitivity(GUIDE, ["M"], ["F", "r"])
    assert found.position("M", np.int64(3)) == found.position("M", 3) == 3
    for at in ("most", 1.5, -1):
        with pytest.raises(SheetError, match=rf"position '?{at}'? of M must be 0..12, 'least' or 'greatest'"):
            found.table("1", "M", "M", at)
    for unknown in (lambda: found.relative("Q"), lambda: found.unit("Q", "F"), lambda: found.tornado("1", "", "Q")):
        with pytest.raises(SheetError, match="'Q' is no result of this sensitivity: it has M"):
            unknown()
    with pytest.raises(SheetError, match="'q' is no input of this sensitivity: it has F, r"):
        found.unit("M", "q")


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
