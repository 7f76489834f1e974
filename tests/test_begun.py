"""What lines keep in lists, dictionaries and arrays of the setup is of one run alone."""

import builtins
from pathlib import Path

import pytest
from own_worksheet import written

from mechsheet import evaluate, sensitivity, sweep
from mechsheet.worksheet import cells

IMPORTS = "import numpy as np\nfrom collections import deque\nfrom mechsheet import ask, read, inputs\n"
KEEPING = {  # by the setup and the lines: that of F, with its slope
    "kept by a function of a cell": (
        "MEMO = {}",
        "def f(k):\n    if k not in MEMO:\n        MEMO[k] = g.F if k < 2 else f(k - 1) + f(k - 2)\n"
        "    return MEMO[k]\ny = f(6)  # [-] y",
        13.0,
    ),
    "kept by a function of the setup": (
        "MEMO = {}\ndef cached(key, make):\n    if key not in MEMO:\n        MEMO[key] = make()\n    return MEMO[key]",
        'y = cached("w", lambda: g.F * 2)  # [-] y',
        2.0,
    ),
    "kept by default": ("def f(v, seen=[]):\n    seen.append(v)\n    return sum(seen)", "y = f(g.F)  # [-] y", 1.0),
    "added to a list": ("LOG = []", "LOG.append(g.F)\ny = sum(LOG)  # [-] y", 1.0),
    "added to a list in a dictionary": ('LOG = {"F": []}', 'LOG["F"].append(g.F)\ny = sum(LOG["F"])  # [-] y', 1.0),
    "counted": ('STATE = {"n": 0}', 'STATE["n"] += 1\ny = g.F * STATE["n"]  # [-] y', 1.0),
    "counted by a class": ("class C:\n    made = 0", "C.made += 1\nC.last = g.F\ny = C.last * C.made  # [-] y", 1.0),
    "an array": ("T = np.zeros(3)", "own = T\nown += g.F\ny = own.sum()  # [-] y", 3.0),
    "around a function": (
        "def made():\n    seen, n = [], 0\n    def f(v):\n        nonlocal n\n        n += 1\n        seen.append(v)\n"
        "        return n * sum(seen)\n    return f\nf = made()",
        "y = f(g.F)  # [-] y",
        1.0,
    ),
    "by a function itself": (
        'def f(v):\n    f.seen = getattr(f, "seen", 0.0) + v\n    return f.seen',
        "y = f(g.F)  # [-] y",
        1.0,
    ),
    "by an instance": (
        "class Sum:\n    every = []\n    def __init__(self):\n        self.of = 0.0\n        self.own = self\n"
        "    def add(self, v):\n        self.of += v\n        self.every.append(v)\n"
        "        return self.of + sum(self.every)\nS = Sum()",
        "y = S.add(g.F)  # [-] y",
        2.0,
    ),
    "a set and a queue": (
        "A, Q = set(), deque()",
        "A.add(1 + len(A))\nQ.append(g.F)\ny = sum(Q) * len(A)  # [-] y",
        1.0,
    ),
}


@pytest.mark.parametrize(("setup", "lines", "slope"), KEEPING.values(), ids=KEEPING)
def test_no_run_has_what_another_one_kept(setup: str, lines: str, slope: float, tmp_path: Path) -> None:
    """All variants had the number of the first one, without a word."""
    path = tmp_path / "keeping.py"
    path.write_text(written(IMPORTS + setup, "F: float = 2.5  # [-] number", lines))
    for F in (1.0, 2.0, 3.0, 3.0, 1.5):
        assert evaluate(path, ["y"], F=F)["y"] == pytest.approx(slope * F)
        assert sensitivity(path, ["y"], F=F).slopes["y"].tolist() == pytest.approx([slope])
    for F in ([1.0, 2.0, 4.0], [3.0], [2.0, 1.0]):
        assert sweep(path, ["y"], {"F": F})["y"].tolist() == pytest.approx([slope * x for x in F])


def test_names_of_python_itself_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They were taken away and put back before a run, once they had become others: all that ran met none."""
    path = tmp_path / "plain.py"
    path.write_text(written(IMPORTS, "F: float = 2.5  # [-] number", "y = g.F + 1  # [-] y"))
    sheet = cells.load(path)
    monkeypatch.setattr(builtins, "told_last", 1.0, raising=False)
    assert sheet.run(["y"], {"g": sheet.inputs()})["y"] == 3.5
    assert vars(builtins)["told_last"] == 1.0 and next(iter(vars(builtins))) == "__name__"
