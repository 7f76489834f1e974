"""Functions in formulas: each as a textbook writes it, and all that it is told stands there."""

from __future__ import annotations

import ast
import inspect
import re

import numpy as np
import pytest
from in_tex import typeset

from mechsheet.document.expression import tree
from mechsheet.document.formula import Measure
from mechsheet.document.functions import RULES
from mechsheet.document.markup import as_written
from mechsheet.document.mathml import mathml


@pytest.mark.parametrize(
    ("source", "tex"),
    [
        ("np.sum(a, 0)", r"\sum_{\text{axis 0}}(a)"),
        ("np.sum(a, axis=(0, 1))", r"\sum_{\text{axes (0, 1)}}(a)"),
        ("a.sum(axis=1, keepdims=True)", r"\sum_{\text{axis 1}}(a,\ \mathrm{keepdims} = \mathrm{true})"),
        ("np.mean(x, axis=-1)", r"\mathrm{mean}_{\text{last axis}}(x)"),
        ("np.cumsum(a, axis=k)", r"\mathrm{cumsum}(a,\ \text{axis} = k)"),
        ("np.max(a, initial=0)", r"\max(a,\ \text{initial} = 0)"),
        ("np.concatenate([a, b], axis=1)",
         r"\mathrm{concatenate}_{\text{axis 1}}\left(\left[a,\ b\right]\right)"),
        ("np.sum(x)**2 / np.sum(x**2)", r"\frac{(\sum(x))^{2}}{\sum\left(x^{2}\right)}"),
        ("np.std(x, ddof=1) + x.var(ddof=1)",
         r"\mathrm{std}(x,\ \text{ddof} = 1) + \mathrm{var}(x,\ \text{ddof} = 1)"),
        ("x.round(2) + np.clip(x, a_min=0, a_max=b)",
         r"\mathrm{round}(x,\ 2) + \mathrm{clip}(x,\ \text{a min} = 0,\ \text{a max} = b)"),
        ("np.interp(x, u, v, left=0)", r"\mathrm{interp}(x,\ u,\ v,\ \text{left} = 0)"),
        ("np.diff(x, n=2) + np.heaviside(x, 0.5)",
         r"\mathrm{diff}(x,\ \text{n} = 2) + \mathrm{heaviside}(x,\ 0.5)"),
        ("np.isclose(a, b, rtol=1e-6)", r"\mathrm{isclose}\left(a,\ b,\ \text{rtol} = 1 \cdot 10^{-6}\right)"),
        ("np.count_nonzero(a)", r"\mathrm{count\ nonzero}(a)"),
        ("max(a, key=f) + min(a, default=0)", r"\max(a,\ \text{key} = f) + \min(a,\ \text{default} = 0)"),
        ("sorted(a, reverse=True)", r"\mathrm{sorted}(a,\ \mathrm{reverse} = \mathrm{true})"),
        ("f(x, n=3)", r"f(x,\ \text{n} = 3)"),
        ("np.divide(a, b) + np.mod(a, n) + np.negative(a)", r"\frac{a}{b} + (a\text{ mod }n) + (-a)"),
        ("np.divide(a, b, where=c)", r"\mathrm{divide}(a,\ b,\ \text{where} = c)"),
        ("np.logical_and(np.greater(a, 0), b <= 1)", r"a > 0\text{ and }b \le 1"),
        ("positive(x)", r"\mathrm{positive}(x)"),  # one of the worksheet's own
        ("np.sin(x)**2 + np.tan(x)**2", r"\sin^{2}\,(x) + \tan^{2}\,(x)"),
        ("np.cbrt(x) + np.exp2(x)", r"\sqrt[3]{x} + 2^{x}"),
        ("complex(a, b)", r"a + i\,b"),
        ("-np.inf", r"-\infty"),
    ],
)  # fmt: skip
def test_a_function_with_what_it_is_told(source: str, tex: str) -> None:
    assert typeset(source) == tex


@pytest.mark.parametrize(
    ("source", "tex"),
    [
        ("quad(lambda x: x**2 + c, 0, b)[0]", r"\int_{0}^{b}\left(x^{2} + c\right)\,\mathrm{d}x"),
        ("scipy.integrate.quad(f, 0, np.inf)[0]", r"\int_{0}^{\infty}f(x)\,\mathrm{d}x"),
        ("integrate.quad(f, 0, x, args=(c, t))[0]", r"\int_{0}^{x}f(s,\ c,\ t)\,\mathrm{d}s"),
        ("2*quad(f, a, b)[0]*c", r"2\,\left(\int_{a}^{b}f(x)\,\mathrm{d}x\right)\,c"),
        ("quad(f, a, b, limit=200)[0]", r"{\mathrm{quad}(f,\ a,\ b,\ \text{limit} = 200)}_{0}"),
        ("quad(f, a, b)[1]", r"{\mathrm{quad}(f,\ a,\ b)}_{1}"),
        ("np.trapezoid(y, x=x) + simpson(y, x=x)", r"\int y\,\mathrm{d}x + \int y\,\mathrm{d}x"),
        ("np.trapezoid(y, dx=h)", r"\mathrm{trapezoid}(y,\ \text{dx} = h)"),
        ("np.trapezoid(y, x, axis=0)", r"\mathrm{trapezoid}_{\text{axis 0}}(y,\ x)"),
        ("cumulative_trapezoid(y, x)", r"{\left(\int^{x}y\,\mathrm{d}x\right)}_{k \ge 1}"),
        ("np.linalg.norm(a, ord=1) + np.linalg.norm(a, np.inf)",
         r"\left\Vert a\right\Vert_{1} + \left\Vert a\right\Vert_{\infty}"),
        ("np.linalg.norm(a - b, axis=1)", r"\left\Vert a - b\right\Vert_{\text{axis 1}}"),
        ("np.linalg.norm(a, ord=1, axis=0)", r"\mathrm{norm}_{\text{axis 0}}(a,\ \text{ord} = 1)"),
        ("scipy.linalg.solve(A, b, assume_a='sym')", r"\mathrm{solve}(A,\ b,\ \mathrm{assume\ a} = \mathrm{sym})"),
        ("linalg.solve(A, b) + np.linalg.inv(A) @ c", r"A^{-1}\,b + A^{-1}\,c"),
        ("np.transpose(A) @ A + (A + B).T + x.T",
         r"A^{\mathrm{T}}\,A + (A + B)^{\mathrm{T}} + x^{\mathrm{T}}"),
        ("CubicSpline(x, y, bc_type='natural')(t, 1)",
         r"\mathrm{CubicSpline}(x,\ y,\ \mathrm{bc\ type} = \mathrm{natural})(t,\ 1)"),
        ("interp1d(x, y)(t)", r"\mathrm{interp1d}(x,\ y)(t)"),
        ("spline.derivative(2)(t)", r"\mathrm{spline.derivative}(2)(t)"),
        ("scipy.stats.norm.cdf(x, scale=s)", r"\mathrm{norm.cdf}(x,\ \text{scale} = s)"),
        ("np.linalg.inv(A).T", r"\left(A^{-1}\right)^{\mathrm{T}}"),
        ("g.F_K(x) + g.table.value(x)", r"F_{\mathrm{K}}(x) + \mathrm{table.value}(x)"),
        ("special.erf(x)", r"\mathrm{erf}(x)"),
        ("brentq(lambda x: x**2 - c, 0, 2)", r"\mathrm{brentq}\left(x \mapsto x^{2} - c,\ 0,\ 2\right)"),
        ("root_scalar(f, bracket=b).root",
         r"\mathrm{root}\left[\mathrm{root\ scalar}(f,\ \text{bracket} = b)\right]"),
    ],
)  # fmt: skip
def test_integrals_matrices_and_functions_of_scipy(source: str, tex: str) -> None:
    assert typeset(source) == tex


def test_a_name_that_begins_with_d_is_no_differential() -> None:
    """`da` may be a tip diameter: only the sign of an integral has an upright d."""
    assert typeset("da * dx + dphi") == r"da\,dx + d\varphi"
    assert mathml(tree(ast.parse("da", mode="eval").body)).count("normal") == 0
    assert as_written("da") == "<i>d</i><i>a</i>" and as_written("dRa").startswith("Δ<i>R</i>")
    assert typeset("quad(f, 0, da)[0]") == r"\int_{0}^{da}f(x)\,\mathrm{d}x"


@pytest.mark.parametrize(
    ("source", "as_written_out"),
    [
        ("list(map(f, D))", "[f(x) for x in D]"),
        ("np.array(list(map(lambda q: q**2 * pi / 4, D)))", "[q**2 * pi / 4 for q in D]"),
        ("array([*map(f, D)])", "[f(x) for x in D]"),
        ("tuple(map(max, A, B))", "[max(x, t) for x, t in zip(A, B)]"),
        ("sum(map(lambda q, r: q * r, A, B))", "sum(q * r for q, r in zip(A, B))"),
        ("max(map(f, map(h, x)))", "max(f(t) for t in [h(t) for t in x])"),
        ("sum(map(np.sqrt, D)) / len(list(D))", "sum(sqrt(x) for x in D) / len(D)"),
        ("list(filter(lambda q: q > a, D))", "[q for q in D if q > a]"),
        ("max(filter(lambda q: q < a, D))", "max(q for q in D if q < a)"),
        ("next(filter(lambda q: q >= a, D), None)", "next((q for q in D if q >= a), None)"),
        ("sorted(filter(None, D))", "sorted([x for x in D if x != 0])"),
        ("list(filter(f, map(h, D)))", "[x for x in [h(x) for x in D] if f(x)]"),
    ],
)
def test_map_and_filter_are_what_they_do_for_each(source: str, as_written_out: str) -> None:
    assert typeset(source) == typeset(as_written_out)
    assert not re.search("map|filter|list", typeset(source))


@pytest.mark.parametrize(
    ("source", "tex"),
    [
        ("np.linspace(0, 1, 5)", r"0,\ 0.25\,\ldots\,1"),
        ("np.linspace(0, b, 5)", r"0,\ \frac{b}{4}\,\ldots\,b"),
        ("np.linspace(0, pi / 2, 7)", r"0,\ \frac{\pi}{12}\,\ldots\,\frac{\pi}{2}"),
        ("np.linspace(a, b, 50, endpoint=False)",
         r"\mathrm{linspace}(a,\ b,\ 50,\ \mathrm{endpoint} = \mathrm{false})"),
        ("np.arange(0, 1, 0.1)", r"0,\ 0.1\,\ldots\,0.9"),
        ("np.arange(0.5, 3)", r"0.5\,\ldots\,2.5"),
        ("np.arange(2.5)", r"0,\ 1\,\ldots\,2"),
        ("np.arange(a, b, h)", r"a,\ a + h\,\ldots\,\text{before }b"),
        ("np.arange(n, dtype=int)", r"\mathrm{arange}(n,\ \text{dtype} = \mathrm{int})"),
        ("sum(f(i) for i in range(0, 10, 2))", r"\sum_{i \in \{0,\ 2\,\ldots\,8\}}f(i)"),
        ("sum(x**2 for x in u if x > 0)", r"\sum_{x \in u,x > 0}x^{2}"),
        ("sum(a[i]*b[j] for i in range(3) for j in range(1, n + 1))",
         r"\sum_{i = 0}^{2}\sum_{j = 1}^{n}a_{i}\,b_{j}"),
        ("math.prod(f(i) for i in range(1, n + 1))", r"\prod_{i = 1}^{n}f(i)"),
        ("max(x**2 for x in u)", r"\max_{x \in u}\left(x^{2}\right)"),
        ("[x + 1 for x in u if x > 0]", r"\left[x + 1\,\text{ for each }x\,\text{ of }u\,\text{ with }x > 0\right]"),
        ("next((x for x in u if x > a), None)",
         r"\text{first }x\,\text{ of }u\,\text{ with }x > a\,\text{, else none}"),
        ("a * next((n for n, d in u if d > a), 2*b)",
         r"a\,(\text{first }n\,\text{ for each }(n,\ d)\,\text{ of }u\,\text{ with }d > a\,\text{, else }2\,b)"),
        ("next(x for x in u)", r"\text{first }x\,\text{ of }u"),
        ("lambda x, k=2: k*x", r"(x,\ k = 2) \mapsto k\,x"),
        ("x in (1, 2) or y not in u", r"x \in \{1,\ 2\}\text{ or }y \notin u"),
        ("x is not None", r"x \ne \text{None}"),
        ("x[1::2] + x[2:-1] + x[i:i + 2] + x[::-1]",
         r"x_{k \ge 1,\text{every }2} + x_{k \ge 2,\text{all but last}} + x_{i \le k < i + 2} + x_{\text{reversed}}"),
        ("x[:-n] + x[-n:]", r"x_{\text{all but last }n} + x_{\text{last }n}"),
        ("x[-n] + x[-1]", r"x_{\text{from the end }n} + x_{\text{last}}"),
        ("x[:, 1] + x[1, :] + x[np.newaxis, :]", r"x_{\text{:},1} + x_{1} + x"),
        ("np.select([x < 0], [a], default=c)",
         r"\begin{cases} a & \text{if }x < 0 \\ c & \text{otherwise} \end{cases}"),
        ("np.piecewise(x, [x < 0, x < 1], [a, lambda x: x**2, f])",
         r"\begin{cases} x^{2} & \text{if }x < 1 \\ a(x) & \text{if }x < 0 \\ f(x) & \text{otherwise} \end{cases}"),
        ("np.piecewise(x, [x < 0], [lambda t: -t])",
         r"\mathrm{piecewise}\left(x,\ \left[x < 0\right],\ \left[t \mapsto -t\right]\right)"),
        ("dWIDTH + WIDTH_2*LENGTH_MAX + SAB",
         r"\Delta\mathrm{WIDTH} + \mathrm{WIDTH}_{2}\,\mathrm{LENGTH}_{\mathrm{MAX}} + S_{\mathrm{AB}}"),
    ],
)  # fmt: skip
def test_ranges_elements_conditions_and_words(source: str, tex: str) -> None:
    assert typeset(source) == tex


def untold(source: str, letters: str) -> set[str]:
    """Which symbols do not stand in the formula of a call; words of it are no symbols."""
    words = r"\\(?:text|operatorname|mathrm|texttt)\{[^{}]*\}|\\[a-zA-Z]+"
    return set(letters) - set(re.sub(words, " ", typeset(source)))


COUNT = {"linspace(p, q, u)", "linspace(p, stop=q, num=u)"}  # how fine a range is, where it is no small number


@pytest.mark.parametrize("name", [*RULES, "unknown", "F_K", "own.method", "f(p)"])
def test_a_function_is_written_with_every_argument(name: str) -> None:
    """Whatever it has a rule for; by its place and by its name."""
    known = list(inspect.signature(RULES[name]).parameters)[1:] if name in RULES else ["x", "y"]
    called = f"np.{name}" if "." in name and name in RULES else name
    for count in range(1, len(known) + 2):
        letters = "pquvw"[:count]
        alone = ", ".join(letters)
        by_name = ", ".join(["p", *(f"{k}={x}" for k, x in zip(known[1:], letters[1:], strict=False))])
        for told, of in ((alone, letters), (by_name, letters[: len(known)]), (f"{alone}, option=z", f"{letters}z")):
            missing = untold(f"{called}({told})", of)
            assert not missing or f"{name}({told})" in COUNT, f"{called}({told}) without {missing}"


def test_numpy_is_written_with_every_argument() -> None:
    """Each of its functions, and of an array's own, told something by place and by name."""
    functions = [f"np.{name}(p" for name, f in vars(np).items() if name.islower() and callable(f) and name[0] != "_"]
    own = [f"p.{name}(" for name in dir(np.ndarray) if not name.startswith("_") and callable(getattr(np.ndarray, name))]
    assert len(functions) > 300 and len(own) > 40
    wrong = {}
    for first in (*functions, *own):
        for told in ("q", "q, u", "axis=q", "axis=3, option=q", "q, dtype=u"):
            call = first + ("" if first.endswith("(") else ", ") + told + ")"
            missing = untold(call, "pq" + "u" * ("u" in told))
            if missing and call.removeprefix("np.") not in COUNT:
                wrong[call] = missing
    assert wrong == {}


def test_numbers_stand_for_symbols_but_not_for_bound_ones() -> None:
    """What a function or a sum calls its own is no quantity of that name."""
    told = {"x": Measure(2.0, "m"), "b": Measure(3.0, "m"), "c": Measure(4.0, "m")}
    assert typeset("quad(lambda x: c*x, 0, b)[0]", told) == r"\int_{0}^{3\,\text{m}}4\,\text{m}\,x\,\mathrm{d}x"
    assert typeset("sum(c*x for x in u)", told) == r"\sum_{x \in u}4\,\text{m}\,x"
    assert typeset("[x for x in u] + x", told).endswith(r"x\,\text{ of }u\right] + 2\,\text{m}")
    assert typeset("f(lambda x: x, x)", told) == r"f(x \mapsto x,\ 2\,\text{m})"
    assert typeset("np.round(x, decimals=2)", told) == r"\mathrm{round}(2\,\text{m},\ \text{decimals} = 2)"


def test_what_is_of_all_elements_has_its_symbols() -> None:
    """The number that is shown for a field is that of one position: an integral of it would be another one."""
    told = {name: Measure(2.0, "m") for name in "xyabc"}
    for source in (
        "np.trapezoid(y, x)", "np.max(x, axis=0)", "x.max()", "np.sum(x*y)", "np.linalg.norm(x)", "x[1:]", "x[0]",
        "np.diff(x)", "A @ x", "np.linalg.solve(a, b)", "len(x)", "max(x, key=f)", "cumulative_trapezoid(y, x)",
    ):  # fmt: skip
        assert typeset(source, told) == typeset(source), source
    assert typeset("max(a, b)", told) == r"\max(2\,\text{m},\ 2\,\text{m})"
    assert typeset("a*np.max(x)", told) == r"2\,\text{m}\,\max(x)"
    assert typeset("np.interp(a, x, y)", told) == r"\mathrm{interp}(2\,\text{m},\ x,\ y)"
    assert typeset("CubicSpline(x, y)(a)", told) == r"\mathrm{CubicSpline}(x,\ y)(2\,\text{m})"
    assert typeset("x[:, None]*a", told) == r"(2\,\text{m}) \cdot 2\,\text{m}"
    assert typeset("own(a)", told) == r"\mathrm{own}(2\,\text{m})"


def test_an_argument_in_its_place_needs_no_name() -> None:
    """Of the mechanics, whose arguments are known."""
    assert typeset("rpr_acceleration(K, H, u, o, v, a_A=a)").endswith(r"v,\ a)")
    assert typeset("rpr_acceleration(K, H, u, o, v, a_B=a)").endswith(r"v,\ \text{a B} = a)")
