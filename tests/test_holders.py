"""Quantities that stand where only a value's own code looks: what is not followed rests on them too."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale

NUMBER_OF = {  # what holds the input F, and how it gives it back
    "from functools import partial\nd = partial(max, g.F)": "d(0.1)",
    "class K:\n    def f(self):\n        return self.q\nd = K()\nd.q = g.F\nd = d.f": "d()",
    "class K:\n    def f(self):\n        return g.F\nd = K()": "d.f()",
    "class K:\n    @property\n    def f(self):\n        return g.F\nd = [K()]": "d[0].f",
    "class K:\n    @staticmethod\n    def f():\n        return g.F\nd = K": "d.f()",
    "import pandas as pd\nd = pd.DataFrame({'p': [g.F, 1.0]})": "d['p'].iloc[0]",
    "import pandas as pd\nd = pd.Series([g.F, 1.0])": "d.iloc[0]",
    "import pandas as pd\nd = pd.DataFrame({'p': [g.F, 1.0], 'q': [1, 2]}).groupby('q')": "d['p'].sum().iloc[0]",
    "d = [lambda: g.F * 2]": "d[0]()",
    "d = (q * g.F for q in (1.0, 2.0))": "sum(d)",
    "d = map(lambda q: q * g.F, (1.0, 2.0))": "sum(d)",
    "d = zip((1.0, 2.0), (g.F, 3.0))": "next(d)[1]",
    "import itertools\nd = itertools.chain([g.F], [2.0])": "next(d)",
    "import operator\nd = operator.methodcaller('__mul__', g.F)": "d(2.0)",
    "d = np.vectorize(lambda q: q * g.F)": "d(np.array([1.0, 2.0]))[1]",
    "from scipy.interpolate import interp1d\nd = interp1d([0.0, 1.0], [g.F, 2.0])": "float(d(0.5))",
    "class L(list):\n    pass\nd = L([1.0])\nd.q = g.F": "d.q",
    "def d():\n    return d.q\nd.q = g.F": "d()",
    "def made(q):\n    def f(n):\n        return q if n == 0 else f(n - 1) * 0.5\n    return f\nd = made(g.F)": "d(2)",
    "L = [1.0]\nL.append(g.F)\nd = L.copy": "d()[1]",
}
OTHERS = ["d = slice(None, g.k)\ny = np.partition(np.arange(9.0)[d], 0).sum()"]


@pytest.mark.parametrize(
    "lines", [f"{d}\ny = np.partition([1.0, {q}], 0).sum()" for d, q in NUMBER_OF.items()] + OTHERS
)
def test_no_number_is_stale(lines: str, tmp_path: Path) -> None:
    """numpy's partition is not followed."""
    assert_never_stale(lines, tmp_path)
