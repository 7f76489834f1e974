"""What stands first does not rest on last digits: processors round otherwise, and a document has one order."""

from dataclasses import replace

import numpy as np
import pytest

from mechsheet.studies.sensitivity import sensitivity
from mechsheet.worksheet.ties import greatest, greatest_first
from tests.own_worksheet import own

ROUNDED = [1 + n * np.finfo(float).eps for n in (-3, 0, 3)]


@pytest.mark.parametrize("x", ROUNDED)
@pytest.mark.parametrize("y", ROUNDED)
def test_those_that_are_equal_but_for_rounding_keep_their_order(x, y):
    assert greatest([0.5, 0.1 * x, 7 * x, 7 * y, 2.0]) == 2
    assert greatest_first([0.5, 0.1 * x, 7 * x, 7 * y, 0.1 * y, 2.0]) == [2, 3, 5, 0, 1, 4]


def test_what_has_no_size_or_is_infinite_has_a_place_too():
    assert greatest([1.0, np.nan, 2.0]) == 1 and greatest([1.0, np.inf, np.inf]) == 1 and greatest([-2.0, -1.0]) == 1
    assert greatest_first([np.nan, 1.0, np.inf, 0.0, np.inf, np.nan, -1.0]) == [2, 4, 1, 3, 6, 0, 5]
    assert greatest_first([1.0, 1.5, 2.0, 3.0], [0.5, np.nan, 0.1, np.inf]) == [3, 2, 0, 1] and greatest_first([]) == []


@pytest.mark.parametrize("x", ROUNDED)
def test_inputs_of_the_same_influence_stand_as_they_are_declared(tmp_path, x):
    found = sensitivity(own(tmp_path, "\nb = 3 * g.F * g.a / (g.F + g.a) ** 2  # [-] by their ratio").path, ["b"])
    rounded = replace(found, slopes={"b": found.slopes["b"] * [x, 1.0]})
    assert rounded.table("1", "", "b").columns[0].values.tolist() == ["F", "a"]
    assert [bar[0] for bar in rounded.tornado("1", "", "b").bars] == ["F", "a"]
