"""Formulas read from a cell's own source and typeset."""

import ast
import json
import re
from pathlib import Path

import numpy as np
import pytest
from cells import run
from in_tex import in_tex, typeset

from mechsheet.document.expression import tree
from mechsheet.document.formula import (
    Apply,
    Binary,
    Brackets,
    Code,
    Fraction,
    Measure,
    Number,
    Power,
    Product,
    Signed,
    Text,
    children,
    is_high,
)
from mechsheet.document.markup import HTML
from mechsheet.page.values import html
from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import formulas, registry
from mechsheet.worksheet.source import of_texts
from mechsheet.worksheet.symbol import Symbol

IMPORT = "from mechsheet import typeset\n"


@pytest.mark.parametrize(
    ("source", "tex"),
    [
        ("pi*g.D_gc**2/4", r"\frac{\pi\,D_{\mathrm{gc}}^{2}}{4}"),
        ("g.P6/(g.k_gc*S_gc*g.eta)", r"\frac{P_{6}}{k_{\mathrm{gc}}\,S_{\mathrm{gc}}\,\eta}"),
        ("O3 + g.L34*exp(1j*phi34(S))", r"O_{3} + L_{34}\,e^{i\,\varphi_{34}(S)}"),
        ("sqrt(X6**2 + Y6**2)", r"\sqrt{X_{6}^{2} + Y_{6}^{2}}"),
        ('h["GS6_lim"]', r"h_{G_{\mathrm{S6,lim}}}"),
        ('h["phi6_S"] + d["steel"]', r"h_{\varphi_{6}} + d_{\text{steel}}"),
        ("np.arctan2(y, x) + log10(x)", r"\mathrm{atan2}(y,\ x) + \mathrm{lg}(x)"),
        ("math.pi*np.pi*x/numpy.e", r"\frac{\pi\,\pi\,x}{e}"),
        ("math.sqrt(2*x) + np.inf", r"\sqrt{2\,x} + \infty"),
        ("np.power(a, n) - math.pow(a, 2) + np.square(b)", r"a^{n} - a^{2} + b^{2}"),
        ("float(math.fabs(x)) + np.real(z)", r"\left|x\right| + \mathrm{Re}\,z"),
        ("np.deg2rad(x) + scipy.special.gamma(n)", r"\mathrm{deg2rad}(x) + \Gamma(n)"),
        ("math.log(x, 10)", r"\mathrm{log}_{10}(x)"),
        ("K_1.T @ x + drive.T", r"K_{1}^{\mathrm{T}}\,x + T(\text{drive})"),
        ("g.T + g.motor.T", r"T + T_{\mathrm{motor}}"),
        ("x[1:] - x[:-1]", r"x_{k \ge 1} - x_{\text{all but last}}"),
        ("x[-1] + x[2:5] + x[-3:]", r"x_{\text{last}} + x_{2 \le k < 5} + x_{\text{last 3}}"),
        ("np.array([width(v) for v in x])", r"\left[\mathrm{width}(v)\,\text{ for each }v\,\text{ of }x\right]"),
        ("np.array([d for d, _ in x])", r"\left[d\,\text{ for each }d\,\text{ of }x\right]"),
        ("sum(F * r for F, r in x)", r"\sum_{(F,\ r) \in x}F\,r"),
        ("len(x) - np.ptp(y)", r"\mathrm{count}(x) - \mathrm{range}(y)"),
        ("log2(x) + expm1(x)", r"\mathrm{log2}(x) + \mathrm{expm1}(x)"),
        ("a - (b - c)", r"a - (b - c)"),
        ("a - (b + c)", r"a - (b + c)"),
        ("a + (b - c)", r"a + b - c"),
        ("a*(b + c)/d", r"\frac{a\,(b + c)}{d}"),
        ("a/b/c", r"\frac{a}{b\,c}"),  # which no one writes as a fraction of fractions
        ("-a/(b + c)/d/2", r"-\frac{a}{(b + c)\,d \cdot 2}"),
        ("a/b*c/d/e", r"\frac{a}{b}\,\frac{c}{d\,e}"),
        ("a/(b/c)", r"\frac{a}{\frac{b}{c}}"),
        ("-(a + b)", r"-(a + b)"),
        ("-a**2", r"-a^{2}"),
        ("(-a)**2", r"(-a)^{2}"),
        ("(a/b)**2", r"\left(\frac{a}{b}\right)^{2}"),
        ("a**(b + 1)", r"a^{b + 1}"),
        ("(a**b)**c", r"\left(a^{b}\right)^{c}"),
        ("a/(b*c)*d", r"\frac{a}{b\,c}\,d"),
        ("a*-b", r"a \cdot (-b)"),
        ("-m2*a_S2", r"-m_{2}\,a_{\mathrm{S2}}"),
        ("-1j*m2*g_n", r"-i\,m_{2}\,g_{\mathrm{n}}"),
        ("-(a + b)/c", r"-\frac{a + b}{c}"),
        ("a - -b/c", r"a - \left(-\frac{b}{c}\right)"),
        ("a + -b*c", r"a + (-b\,c)"),
        ("2*(-a/b)", r"2\,\left(-\frac{a}{b}\right)"),
        ("(-a*b)**2", r"(-a\,b)^{2}"),
        ("2*3", r"2 \cdot 3"),
        ("1.5e7*x", r"1.5 \cdot 10^{7}\,x"),
        ("sin(x)**2", r"\sin^{2}\,(x)"),
        ("abs(O1 - O3)", r"\left|O_{1} - O_{3}\right|"),
        ("cross(A - B, F)", r"(A - B) \times F"),
        ("x % (2*pi)", r"x\text{ mod }2\,\pi"),
        ("group_67.R_A", r"R_{\mathrm{A}}(\text{group 67})"),
        ("fit[0].F - fit[i + 1].F", r"F(\mathrm{fit}_{0}) - F(\mathrm{fit}_{i + 1})"),
        ("I3i.F + on_bucket.R_B", r"F(I_{\mathrm{3i}}) + R_{\mathrm{B}}(\text{on bucket})"),
        ("[0.5, -1]", r"\left[0.5,\ -1\right]"),
        ("phi3[k]", r"{\varphi_{3}}_{,k}"),
        ("M[i][12]", "{M_{i}}_{,12}"),
        ("x[:k] + x[k:g.i]", r"x_{i < k} + x_{k \le j < i}"),
        ("x[k + i + j:n + m]", r"x_{k + i + j \le p < n + m}"),
        ("F[0, 1]", "F_{0,1}"),
        ("P[..., :n_b] + P[..., n_b:]", r"P_{k < n_{\mathrm{b}}} + P_{k \ge n_{\mathrm{b}}}"),
        ("alpha[:, None, None] - a[0, :]", r"\alpha - a_{0}"),
        ("y.min(-1)", r"\min_{\text{last axis}}(y)"),
        ("sin(phi)*L", r"\sin(\varphi)\,L"),
        ("L*sin(phi)", r"L\,\sin\,\varphi"),
        ("sin(phi)", r"\sin\,\varphi"),
        ("sin(phi_S)", r"\sin(\varphi(S))"),
        ("2*sin(a)*cos(b)*c", r"2\,\sin(a)\,\cos(b)\,c"),
        ("sin(a) + c", r"\sin\,a + c"),
        ("arange(g.N)", r"0,\ 1\,\ldots\,N - 1"),
        ("arange(1, g.m + 1)", r"1\,\ldots\,m"),
        ("linspace(0, 2*pi, 361)", r"0\,\ldots\,2\,\pi"),
        ("motion_45(phi1).ds", r"\dot{s}\left[\mathrm{motion\ 45}(\varphi_{1})\right]"),
        (
            "where(F_b < 0, a, b)",
            r"\begin{cases} a & \text{if }F_{\mathrm{b}} < 0 \\ b & \text{otherwise} \end{cases}",
        ),
        (
            "a + where(b < 0, pi, 0) + c",
            r"a + \left(\begin{cases} \pi & \text{if }b < 0 \\ 0 & \text{otherwise} \end{cases}\right) + c",
        ),
        (
            "max(where(b < 0, pi, 0), c)",
            r"\max\left(\begin{cases} \pi & \text{if }b < 0 \\ 0 & \text{otherwise} \end{cases},\ c\right)",
        ),
        ("dot(F, v + w)*k", r"(F \cdot (v + w))\,k"),
        ("trapezoid(M, phi1)", r"\int M\,\mathrm{d}\varphi_{1}"),
        ("cumulative_trapezoid(M - T, phi, initial=0)", r"\int^{\varphi}(M - T)\,\mathrm{d}\varphi"),
        ("np.ceil(h / b) * b", r"\left\lceil\frac{h}{b}\right\rceil\,b"),
        ("dbeta(phi) + dx(phi)", r"d\beta(\varphi) + dx(\varphi)"),
        ("np.nanmin(SAB_k)", r"\min(S_{\mathrm{AB,k}})"),
        ("np.sum(S_g > 0, axis=1)", r"\sum_{\text{axis 1}}(S_{\mathrm{g}} > 0)"),
        ("x.max(axis=0)", r"\max_{\text{axis 0}}(x)"),
        ("sum(F[i]*x[i] for i in range(g.n))", r"\sum_{i = 0}^{n - 1}F_{i}\,x_{i}"),
        ("sum(F*2 for F in loads)", r"\sum_{F \in \mathrm{loads}}F \cdot 2"),
        ("a if 0 < x <= 1 else b", r"\begin{cases} a & \text{if }0 < x \le 1 \\ b & \text{otherwise} \end{cases}"),
        (
            "np.select([x < 0, x < 1], [a, b], c)",
            r"\begin{cases} a & \text{if }x < 0 \\ b & \text{if }x < 1 \\ c & \text{otherwise} \end{cases}",
        ),
        (
            "where(a > 0, 1, where(b > 0, 2, 3))",
            r"\begin{cases} 1 & \text{if }a > 0 \\ 2 & \text{if }b > 0 \\ 3 & \text{otherwise} \end{cases}",
        ),
        ("a > 0 and (b or c) and not d", r"a > 0\text{ and }(b\text{ or }c)\text{ and }\text{not }d"),
        ("(a > 0) | (b < 1)", r"a > 0\text{ or }b < 1"),
        ("np.array([[a, b], [c, 1]])", r"\begin{bmatrix} a & b \\ c & 1 \end{bmatrix}"),
        ("np.array([1, a])", r"\left[1,\ a\right]"),
        ("np.linalg.solve(A, b)", r"A^{-1}\,b"),
        ("group_1.transmission_angle", r"\mathrm{transmission\ angle}(\text{group 1})"),
        ("h_phi6_S", r"h_{\varphi6}(S)"),
        ("group_23", r"\mathrm{group}_{23}"),
        ("g.J_S*eps", r"J_{\mathrm{S}}\,\varepsilon"),
        ("P45(S, L4, branch)", r"P_{45}(S,\ L_{4})"),
        ("(2*a) % b - c", r"2\,a\text{ mod }b - c"),
        ("L4_found.value", r"\mathrm{Find}(L_{4})"),
        ("hypot(a, b/c)", r"\sqrt{a^{2} + \left(\frac{b}{c}\right)^{2}}"),
        ("hypot(sin(a), b)", r"\sqrt{\sin^{2}\,(a) + b^{2}}"),
        ("a/sin(b)*c", r"\frac{a}{\sin\,b}\,c"),
        ("(a + sin(b))*c", r"(a + \sin\,b)\,c"),
        ("x**sin(y)*z", r"x^{\sin\,y}\,z"),
        ("sin(dRa)*L", r"\sin(\Delta R_{\mathrm{a}})\,L"),
        ("arcsin(x)", r"\arcsin(x)"),
        ("omega3**2", r"\omega_{3}^{2}"),
        ("1.5e-7*x", r"1.5 \cdot 10^{-7}\,x"),
        ("WIDTH_2", r"\mathrm{WIDTH}_{2}"),
        ("floor(x)", r"\lfloor x\rfloor"),
        ("phi34[k] + M[1, 2]", r"{\varphi_{34}}_{,k} + M_{1,2}"),
        ("np.prod(a) * np.prod([f(x) for x in u])", r"\prod(a)\,\prod_{x \in u}f(x)"),
        ("max(a, key=lambda x: x)", r"\max(a,\ \text{key} = (x \mapsto x))"),
    ],
)
def test_expression_as_a_textbook_prints_it(source, tex):
    assert typeset(source) == tex


def test_brackets_and_dots_stand_in_the_tree():
    """Writers of other notations read the same ones."""
    a, b = Symbol("a"), Symbol("b")
    assert read("(a + b)*a") == Product(Brackets((Binary(a, "+", b),)), a)
    assert read("a*-b") == Product(a, Brackets((Signed("-", b),)), dot=True)
    assert read("(a/b)**2") == Power(Brackets((Fraction(a, b),)), Number(2, typed=True))
    assert read("a/(b + 2)") == Fraction(a, Binary(b, "+", Number(2, typed=True)))
    assert read("phi34_S") == read("phi34(S)") == Apply(Symbol("φ", "34"), Brackets((Symbol("S"),)))
    assert read("2*x", {"x": Measure(3.0, "m")}) == Product(Number(2, typed=True), Measure(3.0, "m"), dot=True)
    assert [is_high(read(text)) for text in ("a + b", "a/b", "f(a**2)", "1e-9")] == [False, True, True, True]


def test_the_tree_knows_no_notation_of_a_writer():
    for path in sorted((Path(__file__).parents[1] / "worksheets").rglob("*.py")):
        assigned = (n.value for n in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(n, ast.Assign))
        for node in (part for expression in assigned for part in parts(tree(expression))):
            if not isinstance(node, Text | Code):  # which hold what stands in the worksheet
                words = [word for name in node.__match_args__ if isinstance(word := getattr(node, name), str)]
                assert not re.search(r"[\\{}&]", "".join(words)), node


def read(text, numbers=None):
    return tree(ast.parse(text, mode="eval").body, numbers)


def parts(node):
    return [node, *(p for child in children(node) for p in parts(child))]


def test_lines_with_a_unit_are_the_formulas():
    names = run(
        IMPORT
        + "a = 2.0  # [cm] given\n"
        + "b = a / 4  # [%]\n"
        + "c = a + b  # just a remark\n"
        + "def f(x, y):\n    return x + y  # [m] sum\n"
        + "shown = typeset()"
    )
    rows = names["shown"].rows
    assert [(r.name, r.unit, r.meaning, r.arguments) for r in rows] == [
        ("a", "cm", "given", ()),
        ("b", "%", "", ()),
        ("f", "m", "sum", ("x", "y")),
    ]


def test_an_unknown_unit_is_told_on_its_line_alone():
    names = run(IMPORT + "a = 1.0  # [mm] fine\np = 2.0  # [MPaa] wrong\nb = 2 * a  # [mm] fine\nshown = typeset()")
    first, second, third = joined(names["shown"]).split('class="ms-line"')[1:]
    assert "1000 mm" in first and "2000 mm" in third and "mistake" not in first + third
    assert "2 ?" in second and "unit [MPaa] is not known; nearest: MPa" in second


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (-0.66132, "m", "−0.66132 m"),
        (np.pi / 6, "deg", "30°"),
        (15348729.0, "MPa", "15.349 MPa"),
        (0.14, "%", "14 %"),
        (-1.5e-7, "m", "−1.5\u202f·\u202f10<sup>−7</sup> m"),
        (-2.5e12, "-", "−2.5\u202f·\u202f10<sup>12</sup>"),
        (129613.7, "N", "129614 N"),
        (999999.9, "N", "1000000 N"),
        (np.inf, "-", "∞"),
        (0.5 - 2j, "m/s**2", "(0.5, −2) m/s<sup>2</sup>"),
        (np.array([1.0, 2.0, 3.0]), "N*m", "1, 2, 3 N·m"),
        (np.array([1.0, np.nan]), "N*m**-1", "1, none N·m<sup>−1</sup>"),
        (np.arange(10.0), "-", "0, 1, 2, 3, 4, 5, 6, 7, 8, 9"),
        (np.sin(np.arange(24) * np.pi / 12), "m", "−1 … 1 m"),
        (np.array([[1.0, 2.0], [3.0, 4.5]]), "N", "[1, 2; 3, 4.5] N"),
        (np.array([np.nan, *np.arange(11.0)]), "m", "0 … 10 m (1 of 12 none)"),
        (np.full(11, np.nan), "m", "none m"),
        (np.full(11, 2.0), "m", "2 m"),
        (np.arange(5) * 1j, "m", "(0, 0 … 4) m"),
        (2 * np.exp(1j * np.linspace(0, 2 * np.pi, 9)), "m", "(−2 … 2, −2 … 2) m"),
        (7, "-", "7"),
        (-0.0, "m", "0 m"),
    ],
)
def test_value_in_its_display_unit(value, unit, text):
    assert numbers.value(value, unit, HTML) == text


def joined(shown):
    """HTML with the elements of a line, formula and value, as one, without its place and what switches its unit.

    Between a number and its unit stands a space that does not break, here as any other.
    """
    text = re.sub("<ms-value [^>]*><span>(.*?)</span></ms-value>", r"\1", html(shown))
    text = re.sub("</?ms-unit>", "", re.sub(' id="line-\\w+"', "", text))
    text = re.sub('<span class="ms-equals">(.?)</span><span class="ms-value">', r" \1 ", in_tex(text))
    return text.replace("\u00a0", " ")


def test_one_position_of_the_fields():
    names = run(
        IMPORT + "import numpy as np\nL = 2.0  # [m] link\nx = L * np.arange(3)  # [m] place\nshown = typeset().at(1)"
    )
    assert names["shown"].values == (2.0, 2.0)
    assert [row.name for row in names["shown"].rows] == ["L", "x"]
    assert "= 2 m</span>" in joined(names["shown"])


def test_page_shows_symbol_formula_value_and_meaning():
    names = run(IMPORT + "L3 = 0.2  # [m] arm\nA = L3**2  # [cm**2] <area>\nshown = typeset()")
    assert json.loads(names["shown"]._mime_()[1]) == {"text/html": html(names["shown"])}
    text = joined(names["shown"])
    assert "A = L_{3}^{2} = 400 cm<sup>2</sup></span>" in text
    assert "L_{3} = 0.2 m</span>" in text
    assert "&lt;area&gt;" in text


@pytest.mark.parametrize(
    ("line", "nothing"),
    [
        ("R + S", True),
        ("-(S + R) / L", True),
        ("abs(L * R + L * S)", True),
        ("cross(1j, R + S)", True),
        ("2 * trapezoid(R + S, W)", True),
        ("trapezoid(R + T, W)", False),
        ("3e-11 * R", False),
        ("R + T", False),
        ("R - R", False),
        ("1.0 / abs(R) - 1.0 / abs(R)", False),
        ("dot(np.zeros((3, 1)), np.ones((3, 1))) + 1e-15", False),
    ],
)
def test_what_rounding_leaves_of_a_sum_is_no_value(line, nothing):
    """By what is added, number by number; a number that is small by itself is a value, and so is one that may be."""
    names = run(
        IMPORT
        + "import numpy as np\nfrom mechsheet import cross, dot\n"
        + "from numpy import trapezoid\nL, W, R = 2.0, np.array([0.0, 0.5]), np.array([1e5, 3e5])\n"
        + "S, T = np.array([3e-11 - 1e5, -3e5]), np.array([3e-11 - 1e5, 1e-8 - 3e5])\n"
        + f"F = {line}  # [N] left over\nshown = typeset()"
    )
    assert ("≈ 0 N</span>" in joined(names["shown"])) is nothing


@pytest.mark.parametrize(
    ("line", "right"),
    [
        ("k = 640*MPa / F  # [1/m**2]", r"k = \frac{640\,\text{MPa}}{F}"),
        ("k = F / (2*kN)  # [-]", r"k = \frac{F}{2\,\text{kN}}"),
        ("k = F / (2*kN/mm)  # [m]", r"k = \frac{F}{2\,\text{kN/mm}}"),
        ("d = 3*inch  # [mm]", r"d = 3\,\text{in}"),
        ("d = -3*mm + 2*inch  # [mm]", r"d = -3\,\text{mm} + 2\,\text{in}"),
        ("G = 7.5*9.81*m/s**2  # [N]", r"G = 7.5 \cdot 9.81\,\text{m/s}^{2}"),
        ("f = 50/s  # [Hz]", r"f = 50\,\text{1/s}"),
        ("q = 1.2*kN*m/(m*s)  # [W/m]", r"q = 1.2\,\text{kN·m/(m·s)}"),
        ("x = F/kN  # [-]", r"x = \frac{F}{\text{kN}}"),
        ("A = (3*mm)**2  # [mm**2]", r"A = (3\,\text{mm})^{2}"),
        ("d = 3 * units.inch * 2  # [mm]", r"d = 3\,\text{in} \cdot 2"),
        ("T = celsius(20)  # [K]", r"T = 20\,\text{°C}"),
        ("d = 3*mm  # [mm]", "d ="),
        ("f = lambda m: 3*m  # [-]", r"f(m) = 3\,m"),
    ],
)
def test_a_number_is_typeset_with_its_unit(line, right):
    names = run(
        IMPORT
        + "from mechsheet import units\n"
        + "from mechsheet.units import MPa, celsius, inch, kN, m, mm, s\n"
        + f"F = 27.5  # [N]\n{line}\nshown = typeset()"
    )
    assert right in joined(names["shown"])


@pytest.mark.parametrize("value", ["'8.8'", "{}", "run", "[[1.0], [2.0, 3.0]]", "['a', 'b']", "typeset"])
def test_what_is_no_number_has_no_unit(value):
    text = re.escape(f"<cell>, line 3: grade = {value} is no number: it has no [unit]")
    with pytest.raises(SheetError, match=text.replace("<cell>", ".*")):
        run(IMPORT + f"run = print\ngrade = {value}  # [-] grade\nshown = typeset()")
    run(IMPORT + f"run = print\ngrade = {value}  # grade\nshown = typeset()")


def test_a_constant_has_the_digits_that_are_typed():
    """Five of them stood, and the formula shown was another one: 1.226869 a - 1.2269 a as 1.2269 a - 1.2269 a."""
    names = run(IMPORT + "a = 1.0  # [m]\nb = 1.226869 * a - 123456.7 * a + 7.6543212e-9 * a  # [m]\nshown = typeset()")
    assert r"1.226869\,a - 123456.7\,a + 7.6543212 \cdot 10^{-9}\,a" in joined(names["shown"])


def test_an_element_stands_for_a_field_where_the_line_has_as_many_alone():
    """`np.dot(v, w)` was "= 1 4" in the formula with numbers: of all elements the first ones."""
    lines = "v = np.array([1.0, 2.0])  # [-]\nw = 3 * v  # [-]\ns = np.dot(v, w)  # [-]\none = np.array([5.0])  # [-]"
    numbers = run(IMPORT + f"import numpy as np\n{lines}\nshown = typeset()")["shown"].numbers
    assert numbers.at("v", 1, "w") == (2.0, "-")
    assert numbers.at("v", 1, "s") is None and numbers.at("one", 1, "s") == (5.0, "-")


def test_how_a_text_is_shown_is_told():
    with pytest.raises(SheetError, match=re.escape("it has no [unit], typeset(f'{grade}') shows it")):
        run(IMPORT + "grade = '8.8'  # [-] grade\nshown = typeset()")


def test_solve_block_is_typeset_as_given_and_find():
    names = run(
        IMPORT
        + "from mechsheet import find\n"
        + "h = 0.25  # [m] height\n"
        + "def y(x, branch):\n    return branch * x**2  # [m] curve\n"
        + "x_found = find(lambda x, branch: y(x, branch), 0, 2, equals=h, branches=(1,), branch=1)\n"
        + "x = x_found.value  # [m] found\n"
        + "shown = typeset(x_found)"
    )
    text = joined(names["shown"])
    assert r"y(x) = x^{2}" in text or r"y(x) =" in text
    assert r"\text{Given}\quad y(x) = h" in text
    assert r"x = \mathrm{Find}(x) = 0.5 m</span>" in text
    assert "found" in text


@pytest.mark.parametrize(
    ("call", "given"),
    [
        ("q_found = find(y, 0, 2, equals=h)", "y(q) = h"),
        ("q_found = find(y, equals=h, guess=1.0)", "y(q) = h"),
        ("root = find(y, 0, 2, equals=h)", "y = h"),
    ],
)
def test_a_function_that_is_solved_by_its_name_is_typeset_of_its_unknown(call, given):
    """For a function without a line of its own nothing else told of what it is."""
    lines = "from mechsheet import find\nh = 0.25  # [m**2] square\ndef y(x):\n    return x**2\n"
    text = joined(run(f"{IMPORT}{lines}{call}\nshown = typeset()")["shown"])
    assert rf"\text{{Given}}\quad {given}" in text


def test_solve_block_of_several_unknowns_is_typeset_equation_by_equation():
    names = run(
        IMPORT
        + "from mechsheet import find, minerr\n"
        + "h = 4.0  # [m**2] square\n"
        + "xy_found = find(lambda x, y: (x**2 + y**2, x - y), equals=(h, 0), x=(0, 3), y=(0, 3), unit=('m**2', 'm'))\n"
        + "x = xy_found.value.x  # [m] found\n"
        + "k_least = minerr(lambda k: (k - h, 2 * k - h), k=1.0)\n"
        + "k = k_least.value.k  # [m**2] fitted\n"
        + "shown = typeset(xy_found, k_least)"
    )
    text = joined(names["shown"])
    assert r"\text{Given}\quad x^{2} + y^{2} = h" in text
    assert r"\text{and}\quad x - y = 0" in text
    assert r"x = \mathrm{Find}(x) = 1.4142 m</span>" in text
    assert r"k = \mathrm{Minerr}(k) = 2.4 m" in text
    assert ">found</span>" in text and ">least squares</span>" in text
    assert "solutions seen by 128 starts" in text and "<i>x</i> in 0..3; <i>y</i> in 0..3" in text


@pytest.mark.parametrize(
    ("lines", "numbers"),
    [
        ("y = a * b / 4  # [m**2]", r"\frac{2\,\text{m} \cdot (-30\,\text{mm})}{4}"),
        ("y = (a + b)**2  # [m**2]", r"(2\,\text{m} + (-30\,\text{mm}))^{2}"),
        ("y = a**2 - b  # [m**2]", r"(2\,\text{m})^{2} - (-30\,\text{mm})"),
        ("y = sin(w) * a  # [m]", r"\sin(30^\circ) \cdot 2\,\text{m}"),
        ("y = c[0] * n  # [m]", r"c_{0} \cdot 3"),
        ("y = f[0] + unknown  # [m]", None),
    ],
)
def test_numbers_stand_for_the_symbols(lines, numbers):
    names = run(
        IMPORT
        + "from numpy import array, pi, sin\n"
        + "a = 2.0  # [m]\nb = -0.03  # [mm]\nw = pi / 6  # [deg]\nn = 3  # [-]\nunknown = c = f = array([1.0, 2.0])\n"
        + f"{lines}\nshown = typeset()"
    )
    text = joined(names["shown"])
    if numbers is None:
        assert "= " + lines[4:10] not in text and "unknown</ms-numbers" not in text
    else:
        assert f'formula="= {numbers}"' in text


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ("u, v = 2 * mm, x * 3 * kN  # [m] gap, [kNn] force", [r"u = 2\,\text{mm} = 0.002 m", "nearest: kN"]),
        ("M = array([[1 * kN], [2 * kN]])  # [N]", [r"\begin{bmatrix} 1\,\text{kN} \\ 2\,\text{kN} \end{bmatrix}"]),
        ("c = 5 * mm if x > 1 else 6 * mm  # [m]", [r"6\,\text{mm} & \text{otherwise}"]),
        (
            "def f(x):\n    k = x * 2 * mm\n    return k * 3 * kN  # [J]",
            [r"f(x) = k \cdot 3\,\text{kN}\quad \text{where}\quad k = x \cdot 2\,\text{mm}"],
        ),
    ],
)
def test_units_stand_wherever_a_formula_has_them(lines: str, told: list[str]) -> None:
    """In one of several names, a matrix, a choice, and what a function calls its own."""
    names = run(
        IMPORT + "from numpy import array\nfrom mechsheet.units import kN, mm\n"
        f"x = 2.0\n{lines}\nshown = typeset()"
    )  # fmt: skip
    assert all(text in joined(names["shown"]) for text in told)


def test_numbers_of_a_field_are_those_of_the_position_shown():
    names = run(IMPORT + "from numpy import arange\nx = 2 * arange(3)  # [m]\ny = 3 * x  # [m]\nshown = typeset()")
    assert r'formula="= 3 \cdot 0\,\text{m}"' in joined(names["shown"])
    assert r'formula="= 3 \cdot 4\,\text{m}"' in joined(names["shown"].at(2))


def test_a_number_and_a_point_at_nothing_are_told_apart():
    """0 and 0j are equal, and shown in two ways by the same line."""
    names = run(IMPORT + "x = 0.0  # [m]\ny = 3 * x  # [m]\nshown = typeset()")
    assert r'formula="= 3 \cdot 0\,\text{m}"' in joined(names["shown"])
    names["x"] = 0j
    assert r'formula="= 3\,(0,0)\,\text{m}"' in joined(names["shown"])


def test_edited_unit_alone_is_seen():
    """Cells whose code is equal but for a comment are told apart."""
    shown = [run(IMPORT + f"a = 0.5  # [{unit}] length\nshown = typeset()")["shown"] for unit in ("m", "mm")]
    assert [s.rows[0].unit for s in shown] == ["m", "mm"]


def test_a_call_leaves_out_the_branch_that_its_function_takes_anyway():
    lines = (
        "P = lambda S, L7, branch=s: rrr(S, L7, branch)  # [m] pin\n"
        "Q = lambda S, L7, branch=s: P(S, L7, branch) - P(S, L7, t) + rrr(S, branch)  # [m] other\n"
        "def R(S):\n    q = Q(S, 1, s)\n    return q + P(S, s)  # [m] third\n"
    )
    rows = {row.name: row for row in formulas(of_texts(((lines, "own.py"),))[0])}
    assert ast.unparse(rows["P"].expression) == "rrr(S, L7, s)"
    assert ast.unparse(rows["Q"].expression) == "P(S, L7) - P(S, L7, t) + rrr(S, s)"
    assert [ast.unparse(value) for _, value in rows["R"].where] == ["Q(S, 1)"]
    assert ast.unparse(rows["R"].expression) == "q + P(S, s)", "of another number of arguments"


def test_branch_that_is_meant_stands_in_the_definition():
    text = run(IMPORT + "def P(S, L7, branch=-1):\n    return rrr(S, L7, branch)  # [m] pin\nshown = typeset()")[
        "shown"
    ]
    assert r"P(S,L_{7}) = \mathrm{rrr}(S,\ L_{7},\ -1)" in in_tex(html(text))


@pytest.mark.parametrize(
    ("comment", "number", "meaning"),
    [
        ("(1.26) known forces, x", "(1.26)", "known forces, x"),
        ("(24)", "(24)", ""),
        ("(1.13), (1.14)", "(1.13), (1.14)", ""),
        ("(1.3)-(1.5) at A (erratum)", "(1.3)-(1.5)", "at A (erratum)"),
        ("(2.33) – (2.38) slopes", "(2.33) – (2.38)", "slopes"),
        ("(5.1b) of the first", "(5.1b)", "of the first"),
        ("(erratum) as printed", "", "(erratum) as printed"),
        ("(1.26)known", "", "(1.26)known"),
        ("(8 bolts) force", "", "(8 bolts) force"),
        ("(-1.5) of x", "", "(-1.5) of x"),
        ("(1982) of the edition", "", "(1982) of the edition"),
        ("force of (1.26)", "", "force of (1.26)"),
    ],
)
def test_the_number_of_the_printed_formula(comment, number, meaning):
    shown = run(IMPORT + f"a = 2.0  # [m] {comment}\nshown = typeset()")["shown"]
    (line,) = shown.rows
    assert (line.number, line.meaning, line.unit) == (number, meaning, "m")
    printed = number.replace(")-(", ")–(")  # from which to which
    assert re.findall('<span class="ms-number">(.*?)</span>', html(shown)) == [printed][: bool(number)]


def test_numbers_of_printed_formulas_in_a_line_of_several_names():
    lines = "x, y = 1.0, 2.0  # [m] (1.18) along, [s] (1.19)\nf = lambda x: x  # [m] (7) itself\n"
    rows = run(IMPORT + lines + "shown = typeset()")["shown"].rows
    assert [(r.number, r.meaning) for r in rows] == [("(1.18)", "along"), ("(1.19)", ""), ("(7)", "itself")]


def test_a_line_of_several_names_declares_each():
    names = run(IMPORT + "a, b = pair = (2.0, 3.0)\nu, v = pair  # [m] one, [s]\nx, y = 2 * u, v  # [m], [s] last\n"
                "shown = typeset()")  # fmt: skip
    rows = names["shown"].rows
    assert [(r.name, r.unit, r.meaning) for r in rows] == [
        ("u", "m", "one"), ("v", "s", ""), ("x", "m", ""), ("y", "s", "last"),
    ]  # fmt: skip
    text = joined(names["shown"])
    assert r"u = \mathrm{pair}_{0} = 2 m" in text and r"x = 2\,u = 4 m" in text
    with pytest.raises(SheetError, match=r"<cell \d+>, line 2: 2 names need 2 units"):
        run(IMPORT + "u, v = 1.0, 2.0  # [m] one\ntypeset()")


@pytest.mark.parametrize(("text", "kind"), [("## Bar", "text/html"), ("Bar", "application/vnd.marimo+mimebundle")])
def test_marimo_lists_the_headings_among_lines(text, kind):
    """It looks for them in plain HTML alone."""
    assert run(f'{IMPORT}"""{text}"""\nu = 1.0  # [m] length\nshown = typeset()')["shown"]._mime_()[0] == kind


def test_a_function_with_branches_and_names_of_its_own():
    def shown(body):
        return in_tex(html(run(IMPORT + f"def f(x):\n{body}  # [m] it\nshown = typeset()")["shown"]))

    chosen = r"f(x) = \begin{cases} 1 & \text{if }x < 0 \\ 2 & \text{if }x < 3 \\ x & \text{otherwise}"
    assert chosen in shown("    if x < 0:\n        return 1\n    elif x < 3:\n        return 2\n    return x")
    assert chosen in shown(
        "    if x < 0:\n        return 1\n    if x < 3:\n        return 2\n    else:\n        return x"
    )
    assert r"f(x) = y + 1\quad \text{where}\quad y = 2\,x" in shown("    y = 2 * x\n    return y + 1")
    loop = shown("    for _ in range(3):\n        x = x / 2\n    return x")
    assert ">f(x)<" in loop and "it" in loop, "what is no formula is not shown as one"


def test_a_field_has_positions():
    """What only ends in _S is printed as it is written."""
    code = "from numpy import arange\nS = arange(3.0)  # [m]\nl_S = 2.0  # [m]\nP_S = l_S * S  # [m]\nshown = typeset()"
    text = joined(run(IMPORT + code)["shown"])
    assert r"s_{\mathrm{S}} = \left[0,\ 1\right] = 0, 1 m" in joined(
        run(IMPORT + "s_S = [0, 1]  # [m]\nshown = typeset()")["shown"]
    )
    assert r"l_{\mathrm{S}} = 2 m" in text and r"P(S) = l_{\mathrm{S}}\,S = 0, 2, 4 m" in text


def test_a_point_called_S_is_no_stroke():
    code = "from numpy import arange, exp\nS = exp(1j * arange(3.0))  # [m]\na_S = -4 * S  # [m]\nshown = typeset()"
    assert r"a_{\mathrm{S}} = -4\,S" in joined(run(IMPORT + code)["shown"])


@pytest.mark.parametrize("args", ["S", "S, L7, branch=-1"])
def test_function_is_the_same_line_by_lambda_and_by_def(args):
    written = f"def P({args}):\n    return a * S  # [mm] pin\n", f"P = lambda {args}: a * S  # [mm] pin\n"
    over = f"P = lambda {args}: (\n    a\n    * S\n)  # [mm] pin\n"
    texts = [html(run(IMPORT + f"a = 2.0\n{line}shown = typeset()")["shown"]) for line in (*written, over)]
    assert texts[0] == texts[1] == texts[2] and "pin" in texts[0]


@pytest.mark.parametrize("called", ["second = typeset()", "second = typeset(\n    first,\n)"])
def test_each_call_of_typeset_has_the_lines_above_it_that_no_other_has(called):
    lines = f"a = 1.0  # [m] one\nb = 2 * a  # [m] two\nfirst = typeset()\nc = a + b  # [m] three\n{called}"
    names = run(IMPORT + lines)
    assert [[row.name for row in names[shown].rows] for shown in ("first", "second")] == [["a", "b"], ["c"]]
    assert list(registry(names)) == ["a", "b", "c"]
