"""Matrices as machines need them: natural frequencies over a mass matrix, bands, blocks; for other inputs too."""

import ast
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from cells import run
from in_tex import in_tex
from never_stale import assert_never_stale
from own_worksheet import own, recorded

from mechsheet import evaluate, find
from mechsheet.page.values import html
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.shapes import shapes

OVER = "M = np.array([[1.0, 0.2], [0.2, g.a + 1]])\nK = np.array([[2 * g.F, -g.F], [-g.F, g.F]])\n"
FOLLOWED = [
    f"from scipy.linalg import eigh\n{OVER}y = np.sqrt(eigh(K, M, eigvals_only=True))",
    f"from scipy.linalg import eigvalsh\n{OVER}y = eigvalsh(K, M - np.eye(2) * (g.a + 0.1))",  # nothing for some
    (
        "from scipy.linalg import eigvalsh\nM = np.diag([1.0, g.a + 1, 3.0]) + 0.3 * (np.eye(3, k=1) + np.eye(3, k=-1))"
        "\nK = np.array([[2 * g.F, -g.F, 0], [-g.F, g.F + 1, 0.5], [0, 0.5, 2]])\ny = eigvalsh(K, M)"
    ),
    "from scipy.linalg import eigvalsh\ny = eigvalsh([[2 * g.F, 9.0], [-g.F, g.F]], [[g.a, 7.0], [0.1, 2]])",
    "from scipy.linalg import eigvalsh\ny = eigvalsh([[g.F, 0.5], [9.0, g.F]], [[g.a, 0.1], [7.0, 2]], lower=False)",
    "y = np.linalg.cholesky(np.array([[g.F + 3, 9.0], [g.a, g.a + 3]])).ravel()",
    "y = np.linalg.cholesky(np.array([[g.F - 2, 0.5], [0.5, g.a]])).ravel()",  # none of some
    "y = np.linalg.cholesky(np.array([[g.F + 4, 1, 0.5], [1, g.a + 3, 0.2], [0.5, 0.2, 4]]), upper=True).ravel()",
    "from scipy.linalg import cholesky\ny = cholesky(np.array([[g.F + 3, 1], [9.0, g.a + 3]])).ravel()",
    "from scipy.linalg import cholesky\ny = cholesky(np.array([[g.F + 3, 9.0], [1, g.a + 3]]), lower=True).ravel()",
    "from scipy.linalg import block_diag\ny = block_diag(np.eye(2) * g.F, [[g.a, 2.0]], 3.0 * g.F, [1, g.a]).ravel()",
    "K = 2 * np.diag([g.F] * 3) - np.diag([g.a] * 2, 1) - np.diag([g.a] * 2, -1)\ny = np.linalg.solve(K, [1, 0, g.F])",
    "y = np.diag(x * g.a, 2).ravel()",
]
GRADED = [
    "[2.0, 30, 16, 293, 590, 7086, 10232, 94726, 6]",
    "[4.0**i for i in range(9)]",
    "[10.0**-i for i in range(8)] + [0]",
    "[1e5, 1, 1e4, 10, 1e3, 1e5, 1, 1e4, 0]",
]
EIGEN = "K = np.array([[2 * g.F, -g.F], [-g.F, g.F]])\nw, V = np.linalg.eigh(K)\n"


@pytest.mark.parametrize("lines", FOLLOWED)
def test_matrices_follow(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


@pytest.mark.parametrize("stiffness", GRADED)
def test_frequencies_of_unlike_springs_are_right(stiffness: str, tmp_path: Path) -> None:
    """Rotations that are enough for springs alike left a part in a hundred in the lowest."""
    lines = (
        f"k = np.array({stiffness}) * g.F\n"
        "y = np.linalg.eigvalsh(np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1))"
    )
    sheet = own(tmp_path, f"{lines}\nresult = y * 1  # [-] line")
    for F in (2.0, 3.0, 4.0):  # by the cells at first, then by what is recorded
        k = np.array(eval(stiffness)) * F
        known = np.linalg.eigvalsh(np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1))
        found = evaluate(sheet.path, ["result"], F=F)["result"]
        np.testing.assert_allclose(found, known, rtol=1e-9, atol=2e-14 * known[-1])


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        (f"{EIGEN}y = w", "line 38, V: eigenvectors"),
        (f"from scipy.linalg import eigh\n{OVER}w, V = eigh(K, M)\ny = w", "line 40, V: eigenvectors"),
        ("y = np.linalg.eigh(np.array([[2 * g.F, -g.F], [-g.F, g.F]]))[1][0] / 2", "line 37, y: eigenvectors"),
        (
            "from scipy.optimize import least_squares\ny = least_squares(lambda z: z - g.F, [1.0]).x",
            "scipy's least_squares",
        ),
    ],
)
def test_what_is_of_now_alone_is_named(lines: str, told: str, tmp_path: Path) -> None:
    """What is computed of eigenvectors was "what it changes", and a function of scipy was called "inner"."""
    assert_never_stale(lines, tmp_path)
    assert told in str(recorded(own(tmp_path, lines))[1].gaps[0])


@pytest.mark.parametrize(
    ("line", "formula"),
    [
        ("A @ B", r"A\,B"),
        ("A * B", "A ⊙ B"),
        ("np.multiply(k * A, v)", r"(k\,A) ⊙ v"),
        ("A @ v * v", r"(A\,v) ⊙ v"),
        ("A**2 @ v", r"A^{\text{⊙}2}\,v"),
        ("k / A / 2", r"\frac{k ⊘ A}{2}"),
        ("k * v * w + A / k", r"k\,v\,w + \frac{A}{k}"),
        ("R * R", r"R\,R"),  # of which there is no product of matrices
        ("A[:, 0] * v", r"A_{\text{:},0}\,v"),
        ("A * v[:, None]", "A ⊙ v"),
        ("np.linalg.det(A) * A * B", r"(\mathrm{det}(A)\,A) ⊙ B"),
        ("A * v[0] * np.linalg.norm(v) * B", r") ⊙ B"),
        ("np.linalg.solve(A, B) * A", r"\left(A^{-1}\,B\right) ⊙ A"),
        ("A * np.eye(2) * [[1, 2], [3, 4]]", r"(A ⊙ \mathrm{eye}(2)) ⊙ \begin{bmatrix}"),
        ("(A if k > 1 else B) * A[0:2, 0:2]", "⊙ A_{"),
        ("np.sin(A) ** 2 + 2**A", r"(\sin\,A)^{\text{⊙}2} + 2^{\text{⊙}A}"),
        ("np.array([A**2 for A in v])", "A^{2}"),
        ("v @ w / 2", r"\frac{v \cdot w}{2}"),
        ("np.sqrt(v @ R[:, 0])", r"\sqrt{v \cdot R"),
        ("w @ A @ v", r"w\,A \cdot v"),
        ("v @ w * v", r"(v \cdot w)\,v"),
        ("v * (v @ w)", r"v\,(v \cdot w)"),
        ("k * (v @ w)", r"k\,(v \cdot w)"),
        ("k - v @ w + 1", r"k - (v \cdot w) + 1"),
        ("(v @ w) ** 2", r"(v \cdot w)^{2}"),
        ("v * w", r"v\,w"),
    ],
)
def test_products_by_elements_are_told_from_those_of_matrices(line: str, formula: str) -> None:
    """``A * B`` was typeset as ``A @ B`` is: who meant the one and wrote the other saw nothing."""
    names = run(
        "import numpy as np\nfrom mechsheet import typeset\nA = np.array([[1.0, 2], [3, 4]])\nB = A + 1\n"
        f"v = A[0]\nw = B[0]\nR = np.ones((2, 3))\nk = 2.0\ny = {line}  # [-] result\nshown = typeset()"
    )
    assert formula in in_tex(html(names["shown"]))


def test_shapes_are_of_what_is_kept_and_ask_for_nothing() -> None:
    """A Find without a root raises where its value is asked for: its line was not shown, and no later one was."""
    namespace = {"found": find(np.sin, 0, 1, equals=2), "A": np.eye(2), "g": SimpleNamespace(B=np.eye(3)), "k": 2.0}
    row = Formula("x", ast.parse("found.value * k + A @ g.B", mode="eval").body, "-", "")
    assert shapes(row, namespace) == (("k", ()), ("A", (2, 2)), ("g.B", (3, 3)))
