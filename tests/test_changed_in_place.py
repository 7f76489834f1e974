"""What is changed in place, of which a condition tells which one it is: all others that it may be change with it."""

from pathlib import Path
from typing import Any

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded

from mechsheet.recording.record import record

FOUR = "[[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]]"
TABLE = f"T = {FOUR}\n"
TWO = "a, b = [1.0, 2.0], [3.0, g.a]\nc = a if g.F > 2 else b\n"
POINTS = """from dataclasses import dataclass
@dataclass
class Point:
    x: float
    def move(self, by):
        self.x += by
T = [Point(1.0), Point(2.0), Point(3.0), Point(4.0)]
"""
SPACE = "from types import SimpleNamespace as S\n"
ROWS = "T[2][0]", "T[3][0]"
SUMS = "sum(T[2])", "sum(T[3])"
PLACES = "T[2].x", "T[3].x"

LAWS = """from types import SimpleNamespace as S
lin, sq = lambda t: 2 * t, lambda t: t * t
T = [S(x=1.0, law=lin), S(x=2.0, law=sq), S(x=3.0, law=lin), S(x=4.0, law=lin)]
"""
FIELDS = "T[2]['x']", "T[3]['x']"
TOPS = "T[2]._top", "T[3]._top"
COPY = "from copy import copy, deepcopy\n"
DICTS = "T = [{'x': 1.0, 'l': [1.0]}, {'x': 2.0, 'l': [2.0]}, {'x': 3.0, 'l': [3.0]}, {'x': 9.0, 'l': [4.0]}]\n"
ONE = "c = [1.0, g.a] if g.F > 2 else [3.0, 4.0]\n"

FOLLOWED = [
    (TABLE + "c = T[g.k]\nc[0] = 50.0 * g.a", (*ROWS, "c[0]")),
    (TABLE + "T[g.k][1] += g.F", SUMS),
    (TABLE + "c = next(row for row in T if row[0] > g.F)\nc[0] = 50.0", ("T[1][0]", "T[2][0]")),
    (TABLE + "def struck(row):\n    row[0] = g.a\nstruck(T[2] if g.F > 2 else T[3])", ROWS),
    (TABLE + "c = T[g.k][:]\nc[0] = 9.0\nd = [*T[g.k]]\nd.append(g.F)", (*ROWS, "c[0] + sum(d)")),
    (TWO + "c[0] = 50.0", ("a[0]", "b[0]", "c[0]")),
    (TWO + "c[1] = g.F\nc[0] += c[1]", ("a[0]", "b[0]", "c[0] + c[1]")),
    (
        TWO.replace("[1.0, 2.0]", "{'x': 1.0}").replace("[3.0, g.a]", "{'x': g.a}") + "c['x'] = g.F",
        ("a['x']", "b['x']"),
    ),
    (POINTS + "c = T[g.k]\nc.x = g.F", (*PLACES, "c.x")),
    (POINTS + "T[g.k].move(g.F)", PLACES),
    (POINTS + "c, d = T[g.k], T[2]\nd.x = g.F", (*PLACES, "c.x")),
    (
        "from types import SimpleNamespace as S\na, b = S(x=1.0), S(x=g.a)\n(a if g.F > 2 else b).x = 9.0",
        ("a.x", "b.x"),
    ),
    # under a name that is no other's business, of one that may be None, of what a function gives that ends without one
    (POINTS.replace("x: float", "x: float\n    _top: float = 0.0") + "T[g.k]._top = max(0.0, g.F - 3)", TOPS),
    (POINTS + "c = next((p for p in T if p.x > g.F), None)\nif c is None:\n    c = T[0]\nc.x = g.a", PLACES),
    (POINTS + "c = next((p for p in T if p.x > g.F - 1), None)\nc.x *= g.a", PLACES),
    (TABLE + "c = next((row for row in T if row[0] > g.F), None)\nc[0] = 50.0", ("T[1][0]", "T[2][0]")),
    (
        DICTS + "def first():\n    for row in T:\n        if row['x'] > g.F:\n            return row\n"
        "first()['x'] = g.a",
        FIELDS,
    ),
    (LAWS + "c = next(s for s in T if s.x >= g.F)\nc.law = sq", ("T[2].law(g.a)", "T[3].law(g.a)", "c.law(g.a)")),
    # copies, which are others
    (COPY + DICTS + "c = copy(T[g.k])\nc['x'] *= g.a", (*FIELDS, "c['x']")),
    (DICTS + "c = T[g.k].copy()\nc['x'] *= g.a\nc['y'] = 1.0", (*FIELDS, "c['x'] + c['y']")),
    (COPY + DICTS + "c = deepcopy(T[g.k])\nc['l'][0] *= g.a", ("T[2]['l'][0]", "T[3]['l'][0]", "c['l'][0]")),
    (COPY + POINTS + "c = copy(T[g.k])\nc.move(g.F)", (*PLACES, "c.x")),
    (COPY + POINTS + "c = deepcopy(T[g.k])\nc.move(g.F)", (*PLACES, "c.x")),
    (COPY + TABLE + "c = copy(T[g.k])\nc[0] = g.F\nc.append(g.a)", (*ROWS, "sum(c)")),
    (POINTS + "from dataclasses import replace\nc = replace(T[g.k], x=g.F * T[g.k].x)\nc.move(1.0)", (*PLACES, "c.x")),
    (POINTS + "c = T[g.k]\nif isinstance(c, Point):\n    c.x = g.F", PLACES),
    # a list of two lists that have no other name
    (ONE + "d = c if g.a > 1 else [g.a, 7.0]\nd[0] = 9.0", ("sum(c)", "sum(d)")),
    (ONE + "c = c if g.a > 1 else [g.a, 7.0]\nc.append(9.0)", ("sum(c)",)),
    # lists that nobody else knows are such as any others
    ("c = [1.0, g.a] if g.F > 2 else [3.0, 4.0]\nc.append(5.0)\nc[0] = 9.0", ("sum(c)", "c[0]")),
    ("if g.F > 2:\n    c = [1.0, g.a]\nelse:\n    c = [3.0, 4.0]\nc += [g.F]\nc[0] = c[1]", ("sum(c)", "c[0]")),
    (
        "h = []\nfor k in range(3):\n    r = [k * 1.0]\n    if k > g.F:\n        r = [g.a]\n"
        "    r.append(g.F)\n    h.append(r)",
        ("sum(h[2])",),
    ),
]
TOLD = [
    (ONE + "d = c if g.a > 1 else [g.a, 7.0]\nd.append(4.0)", ("sum(c)", "sum(d)")),
    (POINTS + "c = next((p for p in T if p.x > 2 * g.F), None)\nif c is not None:\n    c.x *= 0.5", PLACES),
    (TABLE + "c = next((row for row in T if row[0] > 2 * g.F), None)\nif c is not None:\n    c += [g.a]", SUMS),
    (TABLE + "c = next((row for row in T if row[0] > 2 * g.F), None)\nif c:\n    c[1] += g.a", SUMS),
    # a part of one that there is not always
    *((f"T = {FOUR[:23]}]\n{change}", ("T[0][0]", "T[1][0]")) for change in (
        "c = next(row for row in T if row[0] > g.F)\nc[0] = 50.0",
        "c = [row for row in T if row[0] > g.F][0]\nc[0] = 50.0",
        "c = min((row for row in T if row[0] > g.F), key=sum)\nc[0] = 50.0",
        "for row in T:\n    if row[0] > g.F:\n        c = row\nc[0] = 50.0",
    )),
    (POINTS + "c = next(p for p in T[:3] if p.x > g.F)\nc.x = 50.0", PLACES),
    (DICTS + "c = next(p for p in T[:3] if p['x'] > g.F)\nc['l'][0] = 50.0", ("T[2]['l'][0]", "T[1]['l'][0]")),
    (DICTS + "def f():\n    for p in T[:3]:\n        if p['x'] > g.F:\n            return p\nf()['x'] = 5.0", FIELDS),
    *((f"T = np.array({FOUR})\n{change}", ("T[2].sum()", "T[3].sum()")) for change in (
        "c = T[g.k]\nc[0] = max(5.0, 2 * g.F)", "c = T[g.k]\nc *= max(1.0, g.F - 2)",
        "c = T[g.k]\nif g.a > 1:\n    c[0] = 2",
        "c = T[g.k:]\nc[0] = max(T[g.k, 0], g.F)", "c = T[1:]  # [mm] rows\nc[1] = T[2] * max(1.0, g.F - 2)",
        "c = np.reshape(T, (g.k, 4))\nc[1] = c[1] * max(1.0, g.F - 2)",
        *(f"T = T * (g.F / g.F)\nc = {form}\nc[2] = c[2] * max(1.0, g.F - 2)" for form in (
            "T.real", "np.real(T)", "np.asarray(T, dtype=float)", "np.array(T, copy=None)",
            "T.astype(float, copy=False)",
        )),
    )),
    (POINTS + "c = T[g.k]\nvars(c).update(x=7.0 * g.F - 17.5 + c.x)", PLACES),
    *((TABLE + f"c = T[g.k]\n{change}", (*SUMS, "sum(c)")) for change in (
        "c.append(5.0)", "c.extend([5.0])", "c += [5.0]", "c *= 2", "c.pop()", "del c[0]", "c[:] = [9.0]", "c.clear()",
        "c.insert(0, 5.0)", "c.remove(c[0])", "T[2].append(5.0)", "d = T[2]\nd[0] = 5.0",
    )),
    *((TABLE + f"c = T[g.k]\n{change}", (*ROWS, "c[0]")) for change in ("c.sort(reverse=True)", "c.reverse()")),
    (TABLE + "T[g.k].append(5.0)", SUMS),
    (TABLE + "c = sorted(T, key=lambda row: abs(row[0] - g.F))[0]\nc[0] = 50.0", ROWS),
    (TABLE + "import heapq\nc = T[g.k]\nheapq.heappush(c, 0.5)", (*SUMS, "sum(c)")),
    (TABLE + "def f():\n    c = T[g.k]\n    T[2][0] = g.F\n    return c[0]\nd = f()", (*ROWS, "d")),
    (TWO + "c.append(9.0)", ("sum(a)", "sum(b)", "sum(c)")),
    (TWO + "d = {'it': c}\nd['it'].append(9.0)", ("sum(a)", "sum(b)", "sum(c)")),
    (TWO + "a.append(9.0)", ("sum(b)", "sum(c)")),
    (TWO + "b[0] = 9.0", ("a[0]", "c[0]")),
    ("a, b = [1.0], [2.0, 3.0]\nc = a if g.F > 2 else b\nc.append(5.0)", ("sum(a)", "sum(b)", "sum(c)")),
    ("a, L = [1.0], {2: [2.0]}\nc = a if g.F > 2 else L[2 if g.F < 2 else 9]\nc.append(5.0)", ("sum(a)", "sum(L[2])")),
    ("a, b = [1.0], [2.0, 3.0]\nk = [a, a, a][g.k]\nc = [a, b, a][g.k - 2]\nc.append(5.0)", ("sum(a)", "sum(b)")),
    ("a, b = {1.0}, {2.0}\nc = a if g.F > 2 else b\nc.add(5.0)", ("sum(a)", "sum(b)", "sum(c)")),
    ("a, b = np.ones(2), np.ones(3)\nc = a if g.F > 2 else b\nc[0] = 5.0", ("sum(a)", "sum(b)")),
    ("a, b = [1.0], [2.0, 3.0]\nc = [a, b, b][g.k]\nc.append(5.0)", ("sum(a)", "sum(b)", "sum(c)")),
    ("a, b = {'x': [1.0]}, {'x': [g.a]}\nc = a if g.F > 2 else b\nc['x'].append(5.0)", ("sum(a['x'])", "sum(b['x'])")),
    ("a, b = {'x': 1.0}, {'x': g.a}\nc = a if g.F > 2 else b\nc['y'] = 5.0", ("len(a)", "len(b)", "c['y']")),
    (SPACE + "a, b = S(x=[1.0]), S(x=[g.a])\nc = a if g.F > 2 else b\nc.x.append(5.0)", ("sum(a.x)", "sum(b.x)")),
]  # fmt: skip

# an array of what is a whole number on one way and none on another
AS_WHOLE = [
    ("f = max(1.0, round(g.F))\nb = np.array([f, 3])\nb[0] = g.a * 0.75", ("b[0]",)),
    ("f = max(1.0, round(g.F - 2))\nb = np.array([f, 3])\nb[0] = g.a * 0.75", ("b[0]",)),
    ("f = round(g.F) if g.F > 2 else 2.0\nb = np.array([f, f])\nb[1] = g.a * 0.75", ("b[1]",)),
    ("f = 2.0 if g.F > 3 else 1 if g.F > 2 else 0.5\nb = np.array([f + 1, f])\nb[1] = g.a * 0.75", ("b[1]",)),
    ("f = min(2, g.F)\nb = np.full_like([f, f], 0.75)", ("b[0]",)),
    ("b = np.array([q if q > 9 * abs(g.F) else 3 for q in x])\nb[1] = max(1.0, g.a * 1.3)", ("b[1]",)),
    ("b = np.array([q if q > 9 * abs(g.F) else g.n for q in x])\nb[g.k] *= max(1.0, g.a)", ("b[2]",)),
]

ARRAYS = "A, B = np.array([4.0, 2.0]), np.array([1.0, 6.0])\n"
MATRIX = "M = np.array([[1.5, 2.0], [2.8, 2.0], [4.0, 2.0]])\n"
FOUND = "for r in {}:\n    if r[0] > g.F:\n        break\n"
TOLD += [  # arrays of which a condition tells which one is meant, and one of them is changed, by whatever name
    *((f"{ARRAYS}{chosen}\n{change}", ("r[0]", "A[0]", "B[0]")) for change in (
        "A[0] = g.a", "B[0] = 7.0", "A += 1.0", "A[A > 3] = g.a", "r[0] = g.a", "r *= 2",
    ) for chosen in (
        "r = A if g.F > 3 else B", "r = B\nif g.F > 3:\n    r = A", "r = [A, B, A, B][g.k]",
        "r = min((A, B), key=lambda v: abs(v[0] - g.F))", FOUND.format("(A, B)").replace(">", "<"),
        "def f(u, v):\n    return u if g.F > 3 else v\nr = f(A, B)",
    )),
    (MATRIX + "r = M[0] if g.F < 2 else M[1]\nM[1] = M[1] * max(g.a, 1)", ("r[1]",)),
    ("M = np.outer([1.5, 2.8], [1.0, g.F])\nr = [M[0], M[1]][int(g.F > 3)]\nr[1] = max(r[1], g.a)", ("M[0][1]",)),
    (MATRIX + FOUND.format("M") + "r[1] = g.a", ("M[0][1]", "M[:, 1].sum()")),
    *((f"{TABLE}{FOUND.format('T')}{change}", ("T[0][1]", "sum(p[1] for p in T)", "r[1]")) for change in (
        "r[1] = g.a", "if g.a > 1:\n    r[1] = 9.0", "T[0][1] = g.a", "r.append(g.a)",
    )),
]  # fmt: skip

LOADS = "D = {'u': 1.0, 'w': g.F}\n"
TOLD += [  # what shows a list or a dictionary as it is then
    *((f"{LOADS}v = D.{view}()\n{change}", (shown,)) for change in (
        "if g.a > 1:\n    D['z'] = g.a", "D['u' if g.F > 3 else 'w'] = 7.0", "D.update({'z': 3.0} if g.F > 3 else {})",
    ) for view, shown in (("values", "sum(v)"), ("items", "sum(x for _, x in v)"), ("keys", "sum(D[k] for k in v)"))),
    *((f"A = [4.0, 2.0, 1.0]\nv = {live}\n{change}", (shown,)) for change in (
        "A[g.k % 3] = 7.0", "if g.a > 1:\n    A.pop(0)", "if g.a > 1:\n    A[0], A[1] = A[1], A[0]",
    ) for live, shown in (
        ("iter(A)", "next(v)"), ("map(lambda x: 2 * x, A)", "sum(v)"), ("zip(A, A)", "next(v)[0]"),
        ("(2 * x for x in A)", "sum(v)"), ("enumerate(A)", "next(v)[1]"), ("reversed(A)", "next(v)"),
    )),
    (f"from types import MappingProxyType as P\n{LOADS}v = P(D)\nD['u' if g.F > 3 else 'w'] = 7.0", ("v['u']",)),
    ("A = np.array([1.0, 2.0, 3.0])\nv = A.flat\nA[g.k % 3] = g.a", ("sum(v)",)),
]  # fmt: skip

UNFOLLOWED = "np.linalg.cond(np.array([[1.0, 2.0], [3.0, g.a]]))"
KEPT = [  # what is taken of a statement that is not followed may have another name, by which it is changed
    (TABLE + f"c = [T[0], {UNFOLLOWED}][0]\nT[0][0] = g.F", ("c[0]",)),
    (TABLE + f"c = [T[0], {UNFOLLOWED}][0]\nd = T[0]\nd.append(g.F)", ("sum(c)",)),
    (TABLE + f"c = {{'a': T[0], 'b': {UNFOLLOWED}}}\nT[0][0] = g.F", ("c['a'][0]",)),
    (TABLE + f"c = [T[0], {UNFOLLOWED}][0]\nif g.F > 3:\n    T[0][0] = 5.0", ("c[0]",)),
    (TABLE + f"c = [T[0], {UNFOLLOWED}][0]\nc[0] = g.F", ("T[0][0]",)),
    (SPACE + f"a = S(x=1.0)\nc = [a, {UNFOLLOWED}][0]\na.x = g.F", ("c.x",)),
    (TABLE + "c, d = T[g.k], min(T, key=lambda row: 1)\nd.append(0.0)\nc[0], c[1] = 1.0, 0.0", ("sum(d)",)),
]
AS_FLOAT = [  # of a whole number is none: an array takes others
    ("f = float(g.n)\nb = np.array([f, f])\nb[0] = 4 * g.a", ("b[0]",)),
    ("f = float(round(g.F))\nb = np.array([f, f])\nb[0] = 4 * g.a", ("b[0] + b[1]",)),
    ("b = np.array([float(q > g.F) for q in (1.0, 3.0)])\nb[0] = 4 * g.a", ("b[0]",)),
]


def each_alone(cases: list[tuple[str, tuple[str, ...]]]) -> list[tuple[str, str]]:
    return [(lines, shown) for lines, each in cases for shown in each]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("lines", "shown"), each_alone([*FOLLOWED, *TOLD, *KEPT, *AS_FLOAT, *AS_WHOLE]))
def test_what_is_not_changed_now_changes_for_other_inputs(lines: str, shown: str, tmp_path: Path) -> None:
    """It stood with the document's number for all inputs where only another one was changed: not even told."""
    assert_never_stale(f"{lines}\ny = {shown} * 1.0", tmp_path)


@pytest.mark.parametrize(("lines", "shown"), each_alone([*FOLLOWED, *AS_FLOAT]))
def test_parts_that_are_set_follow(lines: str, shown: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d({shown}) + g.F  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, ELSEWHERE)


@pytest.mark.parametrize(
    "lines",
    [
        f"held = [1.0]\ndef f(x, k={UNFOLLOWED}):\n    held.append(x)\n    return k * x\ny = f(g.a)",
        "from functools import partial\nheld = [1.0]\ndef f(k, x):\n    held.append(x)\n    return k * x\n"
        f"h = partial(f, {UNFOLLOWED})\ny = h(g.a)",
        f"{SPACE}held = S(v={UNFOLLOWED}, w=1.0)\nheld.w += g.a\ny = held.w",
        f"{SPACE}held = S(v={UNFOLLOWED}, w=[1.0])\nheld.w.append(g.a)\ny = sum(held.w)",
        f"class Kept:\n    pass\nheld = Kept()\nheld.v, held.w = {UNFOLLOWED}, 1.0\nheld.w += g.a\ny = held.w",
    ],
)
def test_to_record_changes_nothing_of_the_worksheet(lines: str, tmp_path: Path) -> None:
    """What is not followed is taken from the worksheet's own run; to change that was to put a quantity into it."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1.0  # [-] line")
    names = sheet.run(["held", "result"], {"g": sheet.inputs()})
    before = written_out(names["held"])
    record({**names, "__file__": sheet.path})
    assert written_out(names["held"]) == before


def written_out(value: Any) -> str:
    return repr(getattr(value, "__dict__", value))
