"""Tables of pandas beside statements that cannot be followed: known as far as nothing has changed them."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import own, recorded, value_of

TABLE = 'import pandas as pd\nT = pd.DataFrame({"a": ["p", "q"], "W": [2.0, 1.0]})\n'
NOW = "(g.F - 1.5)"  # 1 for the inputs of the worksheet: there it changes nothing
CHANGES = [
    f'T.loc[1, "W"] = {NOW}\ny = float(T["W"].sum())',
    f'T["W"] *= {NOW}\ny = float(T["W"].sum())',
    f'T["W"] = T["W"] * {NOW}\ny = float(T["W"].sum())',
    f'w = T.insert(1, "V", [{NOW}, 1.0]) is None\ny = float(T["V"].sum())',
    f'w = T.update(pd.DataFrame({{"W": [{NOW} + 1, 1.0]}}))\ny = float(T["W"].iloc[0])',
    'w = T.drop(index=[0 if g.F > 2 else 1], inplace=True)\ny = float(T["W"].iloc[0])',
    'T.sort_values("W", inplace=True, ascending=bool(g.F > 2))\ny = float(T["W"].iloc[0])',
    'w = T.eval("W = W * 2", inplace=True) if g.F > 3 else None\ny = float(T["W"].iloc[0])',
    'w = T.pop("W") if g.F > 3 else T["W"]\ny = float(len(T.columns))',
    f'def scale(t, k):\n    t["W"] = t["W"] * k\n    return t\nw = scale(T, {NOW})\ny = float(T["W"].iloc[0])',
    f"s = pd.Series([1.0, 2.0])\ns[0] = {NOW}\ny = float(s.sum())",
    'fit = T[T["W"] >= g.F - 1.0].sort_values("W")\ny = float(T["W"].iloc[1]) * g.F + len(fit)',
]


@pytest.mark.filterwarnings("ignore:The inplace keyword")  # it will be gone, and is in use
@pytest.mark.parametrize("lines", CHANGES)
def test_no_number_of_a_table_is_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(TABLE + lines, tmp_path)


def test_a_table_that_is_only_looked_at_stays_known(tmp_path: Path) -> None:
    """All that rested on it was nothing for any other input, of a statement too that does not read it."""
    lines = (
        f'{TABLE}fit = T[T["W"] >= g.F - 1.0].sort_values("W")\nb = float(T.loc[T["W"].idxmax(), "W"]) * g.F  # [-] b\n'
        'c = float(np.interp(g.F, T["W"].iloc[::-1], [4.0, 8.0])) + g.a  # [-] c'
    )
    _, recording = recorded(own(tmp_path, lines))
    assert not recording.looked.get("b") and not recording.looked.get("c")
    assert value_of(recording, "b", {"F": 3.0}) == 6.0 and value_of(recording, "c", {"F": 1.5, "a": 1.0}) == 7.0
