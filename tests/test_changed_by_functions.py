"""Arrays that functions change for who calls them, followed for other inputs, or told."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded

Z = "z = np.array([1.0, g.F, 3.0])\n"
F = "def f(s):\n    s[0] = g.a\n"
OWN = "K = np.zeros(3)\ndef one(k):\n    K[k] += max(0.0, g.a - 0.8)\n"
WAYS = "def f(c):\n    z = np.zeros(3) + g.a\n    if c > 3:\n        z[0] = 1.0\n        return z\n    z[0] = 2.0\n"
MORE = "def f(s):\n    s[0] = max(1.0, s[0] * g.a * 1.3)\n    return s[0]\n"
STEP = (
    "state = np.zeros(3)\ndef step(s, h):\n    s[0] += h * s[1]\n    s[1] -= h * s[0] * g.a\n"
    "    s[2] = max(s[2], abs(s[0]))\nstate[1] = g.F\n"
)
ADD = (
    "K = np.zeros((4, 4))\ndef add(K, k, i):\n"
    "    K[i:i + 2, i:i + 2] += k * np.array([[1.0, -1.0], [-1.0, 1.0]])\n    return K\n"
)
GAUSS = """def gauss(A, b):
    n = len(b)
    for k in range(n):
        for i in range(k + 1, n):
            m = A[i, k] / A[k, k]
            A[i] -= m * A[k]
            b[i] -= m * b[k]
    x = np.zeros(n)
    for i in range(n - 1, -1, -1):
        x[i] = (b[i] - A[i, i + 1:] @ x[i + 1:]) / A[i, i]
    return x
A = np.array([[4.0 + g.F, 1.0, 2.0], [g.a, 5.0, 1.0], [1.0, 0.5, 6.0]])
b = np.array([1.0, g.F, 2.0])
"""

FOLLOWED = [
    STEP + "for i in range(12):\n    step(state, 0.1)\ny = state",
    ADD + "for i in range(3):\n    add(K, g.F + i * g.a, i)\ny = K[1] + K[2]",
    ADD + "for i in range(3):\n    K = add(K, g.F + i * g.a, i)\ny = np.linalg.solve(K[1:, 1:], [1.0, 2.0, 3.0])",
    GAUSS + "w = gauss(A, b)\ny = w + A[2] + b",
    Z + F + "    return s[1] * 2\nw = f(z)\ny = w + z",
    Z + F + "    return s\nw = f(z)\ny = w + z",
    Z + F + "    return s[0], s[1]\nu, w = f(z)\ny = z + u * w",
    Z + F + "    return sum(s[k] for k in range(3))\nz[1] = f(z)\ny = z",
    Z + F + "def outer(s):\n    for k in range(3):\n        f(s)\n        s[1] *= s[0]\nouter(z)\ny = z",
    F + "def made(n):\n    s = np.ones(4)\n    for k in range(n):\n        f(s)\n    return s\ny = made(3)",
    Z + "def f(s):\n    s += g.a\nf(z)\ny = z",
    "def f(s):\n    s += g.a\n    return s\nq = g.F\nw = f(q)\ny = w + q",  # a number of its own
    Z + "def f(s):\n    if g.F > 3:\n        s[1] = g.a\nf(z)\ny = z",
    Z + "def f(s):\n    for i, v in enumerate(s):\n        s[i] = v * g.a\nf(z)\ny = z",
    Z + "def f(s, k=2, *, w=1.0):\n    s[k] = g.a * w\nf(z)\nf(z, k=0, w=2.0)\nf(s=z, k=1, w=3.0)\ny = z",
    "L = [1.0, g.F]\ndef f(s):\n    s.append(g.a)\n    s[0] = 5.0\nf(L)\ny = np.array(L)",
    "def swap(A, i, j):\n    A[[i, j]] = A[[j, i]]\nA = np.array([[1.0, g.F], [g.a, 2.0]])\nswap(A, 0, 1)\ny = A[0]",
    Z + "def f(s):\n    s.sort()\n    s[0] = g.a\nf(z)\ny = z",
    "z = np.array([1, 2, 3])\ndef f(s):\n    s[0] = g.F\nf(z)\ny = z",  # of whole numbers
    Z + "def f(s, t):\n    s[0] = t[1]\n    t[0] = s[0] + 1\n    return t\nw = z * 2\nv = f(z, w)\ny = z + w + v",
    Z + "def f(s, n):\n    s[n] = g.a + n\n    if n > 0:\n        f(s, n - 1)\nf(z, 2)\ny = z",
    # within an expression, before which nothing looks at the array
    Z + F + "    return s[1]\ny = g.F * f(z) + z",
    Z + F + "    return s[1]\nt = 1.0\nt += f(z)\nt *= 2 * f(z)\ny = z * t",
    Z + MORE + "held = []\nfor i in range(4):\n    held.append(f(z))\ny = z + sum(held)",
    Z + MORE + "held = []\nfor i in range(4):\n    held.append(2 * f(z))\nw = max(f(z), 2.0)\ny = z * w + sum(held)",
    MORE
    + "def made(n):\n    q = np.ones(3)\n    for i in range(n):\n        q[1] = 2 * f(q)\n    return f(q)\ny = made(3)",
    # arrays of the worksheet, which functions are not handed
    STEP.replace("(s, h)", "(h)").replace("s[", "state[") + "for i in range(12):\n    step(0.1)\ny = state",
    OWN + "def all_of(n):\n    for k in range(n):\n        one(k)\n    return K.sum()\nw = all_of(3)\ny = K + w",
    OWN.replace("(k)", "(s, k)") + "    s[0] = g.a\nM = np.ones(3)\none(M, 1)\ny = K + M",
    OWN.replace("(k)", "(k, K)") + "w = np.ones(3)\none(1, w)\ny = K + w",
    OWN.replace("    K[k]", "    K = np.ones(3)\n    K[k]") + "    return K\nw = one(1)\ny = K + w",
    Z + "def f(s, k):\n    for i in range(k):\n        s[i % 3] += g.a / (i + 1)\nf(z, g.n)\ny = z",
]
TOLD = [
    # another name of the array, within and beside
    "w = z\n" + F + "f(z)\ny = w + z",
    "L = [z]\n" + F + "f(z)\ny = L[0] + z",
    F + "    return z[0]\nw = f(z)\ny = w + z",
    F + "    return h()\nh = lambda: z[0]\nw = f(z)\ny = w + z",
    F.replace("(s)", "(s, t)") + "    return t[0]\nw = f(z, z)\ny = w + z",
    F.replace("(s)", "(s, *t)") + "    return t[0][0]\nw = f(z, [z])\ny = w + z",
    F.replace("(s)", "(s, **t)") + "    return t['t'][0]\nw = f(z, t=z[:2])\ny = w + z",
    F.replace("(s)", "(s, t)") + "    return next(t)\nw = f(z, (v for v in z))\ny = w + z",
    F.replace("(s)", "(s, t)") + "    return t()\nw = f(z, lambda: z[0])\ny = w + z",
    "def f(s):\n    t = s\n    s[0] = g.a\n    return t[0]\nw = f(z)\ny = w + z",
    "def f(s):\n    w = s.reshape(3, 1)\n    s[0] = g.a\n    return w[0, 0]\nw = f(z)\ny = w + z",
    # one that is told to somebody, who sees what is changed later
    "held = []\n" + F + "    held.append(s)\nf(z)\nz[1] = 9.0\ny = held[0] + z",
    "held = []\n" + F + "    held.append(lambda: s[1])\nf(z)\nz[1] = 9.0\ny = held[0]() + z",
    F + "    return {'s': s}\nd = f(z)\nz[1] = 9.0\ny = d['s'] + z",
    F + "    return s[1:]\nw = f(z)\nz[1] = 7.0\ny = w[0] + z",
    F + "    return s\nw = f(z)\nw[1] = 4.0\ny = w + z",
    "w = 2 * z\n" + F.replace("(s)", "(s, t)") + "    t[0] = g.F\nf(np.asarray(z), w)\ny = w + z",
    "w = 2 * z\n" + F.replace("(s)", "(s, t)") + "    t[0] = g.F\nf(z.reshape(3), w)\ny = w + z",
    "class Box:\n    pass\nb = Box()\nb.law = lambda: z[0]\n" + F + "    return b.law()\nw = f(z)\ny = w + z",
    "v = z[1:]\n" + F + "f(v)\ny = z",
    "v = z[1:]\ndef f(s):\n    s[1] = g.a\nf(z)\ny = v",
    # functions that are others by then, or have something of their own
    F + "f(z)\nf2 = f\ndef f(s):\n    s[1] = 2 * g.a\nf(z)\ny = z",
    "def f(s, n=[0]):\n    n[0] += 1\n    s[n[0] % 3] = g.a * n[0]\nf(z)\nf(z)\ny = z",
    "def f(s):\n    s[0] = g.a\n    s = s * 2\n    return s\nw = f(z)\ny = w + z",
    F + "    if g.F > 3:\n        return 1.0\n    s[1] = g.a\n    return 2.0\nw = f(z)\ny = z * w",
    F + "    raise ValueError\ntry:\n    f(z)\nexcept ValueError:\n    pass\ny = z",
    F + "if g.F > 3:\n    f(z)\ny = z",
    MORE + "y = z[0] + f(z)",
    MORE + "y = f(z) + f(z)",
    MORE + "y = (f(z) if g.F > 2 else 0.0) + z",
    MORE + "w = g.F > 2 and f(z) > 1\ny = z * (2.0 if w else 1.0)",
    MORE + "k = lambda: z[0]\ny = k() + f(z)",
    MORE + "y = [z[0], f(z)][0] + z",
    MORE + "class C:\n    @property\n    def top(self):\n        return z[0]\nc = C()\ny = c.top + f(z) + z",
    MORE.replace("return s[0]", "return s") + "L = []\nfor i in range(4):\n    L.append(f(z))\ny = L[0] + z",
    OWN + "    return total()\ndef total():\n    return K.sum()\nw = one(1)\ny = K + w",
    OWN + "L = K\none(1)\ny = K + L",
    OWN.replace("(k)", "(s, k)") + "    s[0] = max(s[0], g.a - 0.8)\none(K, 1)\ny = K",
    OWN + "    return K\nw = one(1)\nw[2] = max(w[2], g.a - 0.8)\ny = K + w",
    OWN + "h = lambda: K[1]\ndef two(k):\n    one(k)\n    return h()\nw = two(1)\ny = K + w",
    OWN + "    return 1.0\ny = one(1) + K",
    "K = np.zeros(3)\nclass Box:\n    def push(self, k):\n        K[k] += max(0.0, g.a - 0.8)\nBox().push(1)\ny = K",
    # ways of a function, each on its own copy
    WAYS + "    return z\ny = f(g.F)",
    WAYS + "    if c > 2:\n        z[1] = 3.0\n        return z * 2\n    z.sort()\n    return z\ny = f(g.F)",
    WAYS.replace("    if", "    t = z\n    if") + "    return t\ny = f(g.F)",
    WAYS.replace("    if", "    h = lambda: z[0] + z[1]\n    if") + "    return h()\ny = f(g.F)",
    WAYS.replace("    if", "    def h():\n        return z[0] + z[1]\n    if") + "    return h()\ny = f(g.F)",
    WAYS.replace("    if", "    h = (v for v in z)\n    if") + "    return next(h)\ny = f(g.F)",
    WAYS + "    return sum(z[k] * k for k in range(3))\ny = f(g.F)",
    "held = [0.0]\ndef f(c):\n    if c > 3:\n        held[0] += 1.0\n        return held[0]\n    held[0] = 5.0\n"
    "    return 2.0\ny = f(g.F) + held[0]",
    F + "w = [f(z) for k in range(3)]\ny = z",
    F + "def h(s):\n    s[2] = g.a\ndef outer(f, s):\n    f(s)\nouter(h, z)\ny = z",
]


# What is not changed now, and is for other inputs: no number of now tells that something is wrong.
LATER = [lines.replace("s[0] = g.a", "s[0] = max(1.0, 1.3 * g.a)") for lines in TOLD if F[-12:] in lines]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", [*FOLLOWED, *(Z + lines for lines in (*TOLD, *LATER))])
def test_what_functions_change_is_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


def test_a_function_that_ends_early_is_followed_where_it_goes_the_same_way(tmp_path: Path) -> None:
    """What its ways set in an array ended in words about a local variable."""
    sheet = own(tmp_path, f"{WAYS}    return z\nresult = f(g.F) * g.a  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, [{}, {"F": 1.5, "a": 3.0}])


@pytest.mark.parametrize("lines", FOLLOWED)
def test_what_functions_change_follows(lines: str, tmp_path: Path) -> None:
    """The array of who calls had another name in the function: all behind it kept the document's numbers."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) + g.F  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, ELSEWHERE)


# An array that is kept by two names, one of which is changed later in ways that nobody follows.
KEPT = "z = np.array([3.0, g.a, 1.0, g.F])\nv = z.reshape(-1)\nz[z > abs(g.a)] = v.sum()\n"


@pytest.mark.parametrize(
    "change",
    [
        "class C:\n    def __init__(self, s):\n        self.s = s\n    def c(self):\n        self.s[g.k % 2] *= 2.0\n"
        "C(v).c()",
        "def c(s, t):\n    s[g.k % 2] *= t\n    return [s]\nw = [c(v, 2.0)]",
        "h = lambda s: np.copyto(s, s * (g.k + 1))\nh(v)",
        "w = v\nv = v * 1.0\ndef c(s, t):\n    s[g.k % 2] *= t\n    return [s]\nw = [c(w, 2.0)]",
        "v[g.k % 2] *= 2.0",
    ],
)
def test_an_array_of_two_names_that_are_kept_changes_under_both(change: str, tmp_path: Path) -> None:
    """Each was kept as a number of its own, so that the other one stood with what it was, for all inputs."""
    assert_never_stale(f"{KEPT}{change}\nv = v * 1.0\ny = z * 1.0", tmp_path)
