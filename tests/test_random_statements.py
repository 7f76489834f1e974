"""Statements written at random, no loops: whoever reads them has plain Python's numbers, or says that it has none."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
from conftest import examples
from hypothesis import assume, given
from hypothesis import strategies as st
from in_browser import evaluated
from own_worksheet import written
from test_counted_turns import recorded

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.readers.numbers import numbers
from mechsheet.worksheet import cells

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
import math
from types import SimpleNamespace as S
from typing import Literal

import numpy as np

from mechsheet import ask, check, export, find, inputs, read, table, typeset

SIZES = np.array([1.0, 2.0, 3.0, 5.0, 8.0])
AREA = {"low": 1.5, "mid": 2.5, "high": 4.0}
"""
GIVEN = """
n: int = 5  # [-] how many; >= 0
k: int = 2  # [-] which
x: float = 0.7  # [-] argument
u: float = 1.5  # [-] another
on: bool = True  # whether
mode: Literal["low", "mid", "high"] = "mid"  # mode
F: list[float] = [2.5, -1.0, 3.0, 0.5]  # [-] forces
"""
OTHER: list[dict[str, Any]] = [
    {}, {"n": 1, "u": 0.3}, {"k": -1, "mode": "low"}, {"k": 4, "x": 3.0}, {"x": -2.5, "on": False},
    {"x": 0.0, "u": 5.0}, {"mode": "high", "k": 0}, {"n": 8, "x": 1.5}, {"F": [1.0, 1.0, -3.0, 3.0]},
    {"F": [3.0, -1.0, 2.5, 0.5, 7.0], "x": 2.2}, {"F": [0.5, 4.0], "k": 1},
]  # fmt: skip
MODES = ["low", "mid", "high"]

# What stands for what: $f a number, $i a whole one, $b a condition, $a an array, $m a matrix, $s a slice, $p a
# place; $N is a name that the statement binds or changes, and $A an array that it changes.
NUMBERS = [
    "g.x", "g.u", "0.5", "2.0", "($f + $f)", "($f - $f)", "($f * $f)", "($f / (abs($f) + 1.0))", "($f if $b else $f)",
    "abs($f)", "max($f, $f)", "np.clip($f, -1.0, 2.0)", "math.sqrt(abs($f))", "SIZES[$p]", "AREA[g.mode]",
    "$a[$p]", "$a.max()", "$a.sum()", "min(z for z in SIZES if z > $f)", "SIZES[np.searchsorted(SIZES, $f)]",
    "sum(z > $f for z in g.F)", "np.interp($f, SIZES, SIZES**2)", "$b * $f", "$i", "max($a, key=lambda q: q % 2)",
]  # fmt: skip
WHOLE = ["g.n", "g.k", "1", "($i + 2)", "($i // 2)", "($i % 3)", "round($f)", "int($f)", "math.ceil($f)", "len($a)"]
CONDITIONS = [
    "g.on", "(not g.on)", "(g.mode == 'low')", "(g.mode in ('mid', 'high'))", "($f < $f)", "($f >= $f)",
    "($f < $f <= $f)", "($b and $b)", "($b or $b)", "np.any($a > $f)", "all(q > $f for q in $a)",
    "($i % 2 == 0)",
]  # fmt: skip
ARRAYS = [
    "g.F * $f", "np.linspace(0.0, $f, g.n)", "np.arange(6) * $f", "np.array([3.0, g.x, 1.0, $f])", "$a + $f",
    "np.where($a > $f, $f, 0.5)", "np.maximum($a, $f)", "np.clip($a, 0.0, 2.0)", "np.cumsum($a)", "np.sort($a)",
    "$a[$s]", "$a[$a > $f]", "np.diff($a)", "np.concatenate([$a, [$f]])", "$a // 2",
    "$a[np.argsort(-$a, kind='stable')]",
    "np.array([q if q > $f else $f for q in $a])", "np.array([q for q in $a if q > $f])", "np.roll($a, 1)",
    "$m[:, 0]", "$m.sum(axis=1)", "$m[g.k % 2]", "np.insert($a, 0, $f)", "np.linalg.solve($m, [1.0, $f])",
]  # fmt: skip
MATRICES = ["np.array([[2.0, $f], [0.5, 3.0]])", "np.stack([$a, $a])[:, :2]", "np.outer([1.0, $f], [2.0, g.x])"]
SLICES = ["1:", ":-1", "::2", "::-1", "1:3", "g.k:", ":g.k", "-2:", ":-g.k"]
PLACES = ["0", "-1", "1", "g.k", "-g.k", "len(g.F) - 1", "g.k % 2", "min(g.k, 2)", "$i"]
STATEMENTS = [
    "$N = $f", "$N = $f if $b else $f", "if $b:\n    $N = $f\nelse:\n    $N = $f",
    "if $b:\n    $N = $f\nelif $b:\n    $N = $f\nelse:\n    $N = $f",
    "$N = $f\nif $b:\n    $N $o $f", "$N = $i * 1.0", "$N, $N2 = $f, $f", "$N, $N2 = sorted([$f, $f])",
    "def h$N(p, q=$f):\n    if p > q:\n        return $f\n    r = p * $f\n    return r + q\n$N = h$N($f)",
    "def h$N(v):\n    w = v * 1.0\n    if $b:\n        $w[0] = $f\n    return w.sum()\n$N = h$N($A)",
    "match g.mode:\n    case 'low':\n        $N = $f\n    case _ if $b:\n        $N = $f\n    case _:\n        $N = $f",
    "$N = {'p': $f, 'q': $f}['p' if $b else 'q']", "$N = max([$f, $f, 1.0])", "$N = [$f, $f, 2.0][$p] * 1.0",
    "$N = abs($f + 1j * $f)", "t$N = 'low' if $b else 'high'\n$N = AREA[t$N]", 't$N = f"{$f:.1f}"\n$N = float(t$N)',
    "L$N = [q for q in $a if q > $f]\n$N = sum(L$N) / len(L$N) if L$N else $f",
]  # fmt: skip
CHANGES = [
    "$A[$p] $o $f", "$A[$s] = $f", "$A[$A > $f] = $f", "$A $o $f", "$A.sort()", "if $b:\n    $A $o $f",
    "if $b:\n    $A[$p] = $f", "$A[0], $A[-1] = $A[-1], $A[0]", "np.clip($A, 0, 1, out=$A)", "$A.fill($f)",
    "$A[np.argmax($A)] = $f", "for j, q in enumerate($A):\n    $A[j] = q * $f",
    "def c$N(s):\n    s[$p] = $f\n    s[0] $o $f\nc$N($A)",
    "def c$N(s, t):\n    if t > 1:\n        s[0] = t\n        return s\n    s[$p] $o t\n    return s\n$A = c$N($A, $f)",
    "class C$N:\n    def __init__(self, s):\n        self.s = s\n    def c(self, t):\n        self.s[$p] $o t\n"
    "C$N($A).c($f)",
    "if $b:\n    v$N = $A[$s]\n    v$N $o $f", "for j in range(2):\n    v$N = $A[j:]\n    v$N *= $f",
    "R$N = np.stack([$A, $A])\nfor r$N in R$N:\n    r$N[$p] $o $f\n$A[:] = R$N[1] * $f",
    "R$N = [$A, $A * $f]\nfor j, r$N in enumerate(R$N):\n    r$N *= j + $f\n$A = R$N[1] + R$N[0]",
]  # fmt: skip
SHARING = ["{0}", "{0}[1:]", "{0}[::2]", "{0}.reshape(-1)", "{0}.copy()", "np.array({0})"]
# What holds an array, and how it is called there.
HOLDERS = {
    "o{n} = S(K={a})": "o{n}.K", "o{n} = {{'p': {a}, 'q': {b}}}": "o{n}['p']", "o{n} = [{a}, {b}]": "o{n}[0]",
    "o{n} = S(K=[{a}], L={{'p': {b}}})": "o{n}.L['p']",
}  # fmt: skip
FORMS = {
    "f": NUMBERS, "i": WHOLE, "b": CONDITIONS, "a": ARRAYS, "m": MATRICES, "s": SLICES, "p": PLACES,
    "o": ["=", "+=", "*="], "w": ["w", "v"],
}  # fmt: skip
SIMPLE = {"f": 4, "i": 3, "b": 1, "a": 3}  # of each kind how many forms need nothing else
SCALE = "({0} * np.arange(1.0, len({0}) + 1)).sum() + len({0})"  # tells the places of elements too


class Writer:
    """Statements whose later ones use the names of earlier ones."""

    def __init__(self, random: Random) -> None:
        self.random, self.one = random, random.choice
        self.known: dict[str, list[str]] = {"f": [], "a": []}

    def lines(self) -> list[str]:
        made = [self.array(n) for n in range(2)]
        for n in range(2, self.random.randint(5, 9)):
            made.append(self.one([self.statement, self.statement, self.array, self.change, self.shared, self.held])(n))
        arrays = [f"{SCALE.format(name)}" for name in self.known["a"]]
        return [*made, *(f"y_{n} = {value} * 1.0" for n, value in enumerate([*self.known["f"], *arrays]))]

    def filled(self, form: str, deep: int = 0, **names: str) -> str:
        def part(found: re.Match[str]) -> str:
            kind = found[1]
            if kind in names:
                return names[kind]
            if kind in self.known and self.known[kind] and self.random.random() < 0.5:
                return self.one(self.known[kind])
            if kind == "a" and not self.known["a"]:
                return "g.F"
            forms = FORMS[kind][: SIMPLE[kind]] if deep > 1 and kind in SIMPLE else FORMS[kind]
            filled = self.filled(self.one(forms), deep + 1, **names)
            return f"({filled})" if kind == "a" else filled

        return re.sub(r"\$(\w2?)", part, form)

    def array(self, n: int) -> str:
        line = f"a{n} = {self.filled(self.one(ARRAYS[:4] if n < 2 else ARRAYS))}"
        self.known["a"].append(f"a{n}")
        return line

    def statement(self, n: int) -> str:
        form = self.one(STATEMENTS)
        line = self.filled(form, N=f"f{n}", N2=f"e{n}", A=self.one(self.known["a"]))
        self.known["f"] += [f"f{n}"] + [f"e{n}"] * ("$N2" in form)
        return line

    def change(self, n: int) -> str:
        name = self.one(self.known["a"])
        return f"{name} = {name} * 1.0\n" * self.one([0, 1]) + self.filled(self.one(CHANGES), A=name, N=str(n))

    def shared(self, n: int) -> str:
        """An array that may show elements of another one, of which one is changed."""
        name = self.one(self.known["a"])
        line = f"a{n} = {self.one(SHARING).format(name)}"
        self.known["a"].append(f"a{n}")
        return f"{line}\n{self.filled(self.one(CHANGES), A=self.one([name, f'a{n}']), N=str(n))}"

    def held(self, n: int) -> str:
        """An array that something holds, itself or a copy, and another one made of it."""
        name, (line, held) = self.one(self.known["a"]), self.one([*HOLDERS.items()])
        a, b = (self.one([*SHARING, "{0} * 1.0"]).format(self.one(self.known["a"])) for _ in range(2))
        held = held.format(n=n)
        change = self.filled(self.one(CHANGES), A=self.one([held, held, name]), N=str(n))
        self.known["a"].append(f"a{n}")
        return f"{line.format(n=n, a=a, b=b)}\n{change}\na{n} = {held} * 1.0"


def sheet_of(folder: Path, lines: Sequence[str]) -> cells.Worksheet:
    """A worksheet of some lines, with a table for each of those that begin with y."""
    names = [line.split(" ")[0] for line in lines if line.startswith("y_")]
    tables = (f"z{name} = np.array([{name}])  # [-] z\nt{name} = table('{name}', 'Alone', z{name})" for name in names)
    each = [f"{line}  # [-] line" if line.startswith("y_") else line for line in lines]
    path = folder / "own.py"
    path.write_text(written(SETUP, GIVEN, "\n".join([*each, *tables, "typeset()"])), encoding="utf-8")
    return cells.load(path)


def plain(sheet: cells.Worksheet, names: Sequence[str]) -> list[list[float]]:
    """What the worksheet itself computes for each set of inputs; NaN where it is an error."""

    def run(each: dict[str, Any]) -> list[float]:
        try:
            found = sheet.run(names, {"g": sheet.inputs(**each)})
        except Exception:  # whatever plain Python has against these inputs
            return [np.nan] * len(names)
        return [found[name] for name in names]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of divisions by zero, and of what has no mean
        return [run(each) for each in OTHER]


@given(st.integers(0, 2**32 - 1))
@examples(13)
def test_numbers_are_those_of_other_inputs_or_none(blank: Page, seed: int) -> None:
    """By the reader that all studies use, recorded for cells and for pages, and by the page's own script."""
    lines = Writer(Random(seed)).lines()
    names = [line.split(" ")[0] for line in lines if line.startswith("y_")]
    with TemporaryDirectory() as folder:
        sheet = sheet_of(Path(folder), lines)
        told = plain(sheet, names)
        assume(np.isfinite(told[0]).all())
        for draws in (False, True):
            recording = recorded(sheet, every=1, draws=draws, lists=draws)
            columns = {n: recording.tables[name][0] for n, name in enumerate(names)}
            nodes = {n: column.re for n, column in columns.items() if column is not None}
            here = [own for each, own in zip(OTHER, told, strict=True) if draws or is_as_long(each)]
            constant = [row for n, row in enumerate(zip(*here, strict=True)) if n not in nodes]
            assert recording.gaps or all(x == row[0] or np.isnan(x) for row in constant for x in row), lines
            guards = {n: recording.looked[f"z{names[n]}"] if draws else recording.guards.values() for n in nodes}
            looked = {n: [guard.holds for guard in each] for n, each in guards.items()}
            for each, shown, own in zip(OTHER, by_reader(recording, nodes, looked, lists=draws), told, strict=True):
                assert_right(lines, each, shown, own)
            if draws:
                for each, shown, own in zip(OTHER, by_page(blank, sheet, recording, nodes, looked), told, strict=True):
                    assert_right(lines, each, shown, own)


def is_as_long(given: Mapping[str, Any]) -> bool:
    """Whether lists are as long as now, as they are in a workbook."""
    return "F" not in given or len(given["F"]) == 4


def number_of(name: str, value: Any) -> Any:
    return float(MODES.index(value)) if name == "mode" else np.asarray(value, float)


Shown = dict[int, float]  # by the number of a line, if there is one


def by_reader(
    recording: Recording, nodes: Mapping[int, Node], looked: Mapping[int, Sequence[Node]], lists: bool
) -> list[Shown]:
    """The lines for each set of inputs, where all that Python has looked at is the same; or where lists are as long."""
    every = [*nodes.values(), *(holds for each in looked.values() for holds in each)]
    found = list[Shown]()
    for each in OTHER:
        if not (lists or is_as_long(each)):
            found.append({})
            continue
        known = numbers(every, {recording.inputs[name]: number_of(name, x) for name, x in each.items()})
        held = {n for n in nodes if all(known[holds].all() for holds in looked[n])}
        found.append({n: known[nodes[n]].item() for n in held})
    return found


def by_page(
    blank: Page,
    sheet: cells.Worksheet,
    recording: Recording,
    nodes: Mapping[int, Node],
    looked: Mapping[int, Sequence[Node]],
) -> list[Shown]:
    """The same by the script of a page."""
    wanted = {f"{n}": node for n, node in nodes.items()}
    wanted |= {f"{n} {k}": holds for n, each in looked.items() for k, holds in enumerate(each)}
    sets = [{name: number_of(name, getattr(sheet.inputs(**each), name)) for name in recording.inputs} for each in OTHER]
    found = [page["values"] for page in evaluated(blank, javascript.module(recording, wanted), sets)]
    held = [{n: all(each[f"{n} {k}"] == 1 for k in range(len(looked[n]))) for n in nodes} for each in found]
    return [
        {n: each[f"{n}"].item() for n in nodes if holds[n] and each[f"{n}"] is not None and each[f"{n}"].size == 1}
        for each, holds in zip(found, held, strict=True)
    ]


def assert_right(lines: Sequence[str], given: Mapping[str, Any], shown: Shown, told: Sequence[float]) -> None:
    """What is shown is what plain Python has, if it has anything; of the inputs that were recorded it is shown."""
    assert given or all(np.isfinite(number) for number in shown.values()), lines
    for n, number in shown.items():
        if np.isfinite(number) and np.isfinite(told[n]):
            error = f"y_{n} {given}\n" + "\n".join(lines)
            np.testing.assert_allclose(number, told[n], rtol=1e-9, atol=1e-9, err_msg=error)
