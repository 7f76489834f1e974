"""A text that is kept for a value is that of the value: what differs in anything that is shown is made anew."""

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
import pytest

from mechsheet import units
from mechsheet.page.unchanged import kept


@dataclass(frozen=True)
class Row:
    unit: str
    values: Any


class Named(NamedTuple):
    unit: str
    values: Any


@pytest.fixture
def made() -> tuple[list[Any], Any]:
    seen = list[Any]()

    @kept(8)
    def text(row: Any) -> str:
        seen.append(row)
        return repr(row)

    return seen, text


FIRST = Row("kN", np.array([0.0, 1.0, np.nan]))


def test_like_values_are_written_once(made: tuple[list[Any], Any]) -> None:
    seen, text = made
    assert text(FIRST) is text(Row("kN", FIRST.values.copy())) and len(seen) == 1


@pytest.mark.parametrize(
    "values",
    [
        np.array([-0.0, 1.0, np.nan]),
        np.array([0, 1.0, np.nan], complex),
        np.array([[0.0, 1.0, np.nan]]),
        np.array([0.0, 1.0, "none"], object),
        [0.0, 1.0, np.nan],
        (0, 1.0, np.nan),
        0.0,
    ],
)
def test_what_is_shown_otherwise_is_written_anew(made: tuple[list[Any], Any], values: Any) -> None:
    seen, text = made
    text(FIRST)
    assert text(replace(FIRST, values=values)) == repr(seen[-1]) and len(seen) == 2


@pytest.mark.parametrize("row", [FIRST, Named("kN", 1.0)])
def test_a_unit_that_measures_something_else_is_another(
    made: tuple[list[Any], Any], monkeypatch: pytest.MonkeyPatch, row: Any
) -> None:
    seen, text = made
    text(row)
    with monkeypatch.context() as patched:
        other = units.parse("N")
        patched.setattr(units, "known", lambda _: other)
        text(row)
    assert len(seen) == 2


def test_what_holds_a_function_is_never_kept(made: tuple[list[Any], Any]) -> None:
    seen, text = made
    row = Row("kN", lambda: 0)
    assert text(row) == text(row) and len(seen) == 2
