"""Formulas read from a cell's own source and typeset."""

import ast

import numpy as np
import pytest
from cells import run

from mechsheet import formula
from mechsheet.errors import SheetError

IMPORT = "from mechsheet.formula import typeset\n"


@pytest.mark.parametrize(
    ("source", "tex"),
    [
        ("pi*g.D_gc**2/4", r"\frac{\pi\,D_{gc}^{2}}{4}"),
        ("g.P6/(g.k_gc*A_gc*g.eta)", r"\frac{P_{6}}{k_{gc}\,A_{gc}\,\eta}"),
        ("O3 + g.L34*exp(1j*phi34(S))", r"O_{3} + L_{34}\,e^{i\,\varphi_{34}(S)}"),
        ("sqrt(X6**2 + Y6**2)", r"\sqrt{X_{6}^{2} + Y_{6}^{2}}"),
        ("a - (b - c)", r"a - (b - c)"),
        ("a - (b + c)", r"a - (b + c)"),
        ("a + (b - c)", r"a + b - c"),
        ("a*(b + c)/d", r"\frac{a\,(b + c)}{d}"),
        ("-(a + b)", r"-(a + b)"),
        ("-a**2", r"-a^{2}"),
        ("(-a)**2", r"(-a)^{2}"),
        ("(a/b)**2", r"\left(\frac{a}{b}\right)^{2}"),
        ("a**(b + 1)", r"a^{b + 1}"),
        ("(a**b)**c", r"(a^{b})^{c}"),
        ("a/(b*c)*d", r"\frac{a}{b\,c}\,d"),
        ("a*-b", r"a \cdot (-b)"),
        ("-m2*a_S2", r"-m_{2}\,a_{S2}"),
        ("-1j*m2*g_n", r"-i\,m_{2}\,g_{n}"),
        ("-(a + b)/c", r"-\frac{a + b}{c}"),
        ("a - -b/c", r"a - \left(-\frac{b}{c}\right)"),
        ("a + -b*c", r"a + (-b\,c)"),
        ("2*(-a/b)", r"2\,\left(-\frac{a}{b}\right)"),
        ("(-a*b)**2", r"(-a\,b)^{2}"),
        ("2*3", r"2 \cdot 3"),
        ("1.5e7*x", r"1.5 \cdot 10^{7}\,x"),
        ("sin(x)**2", r"\sin^{2} (x)"),
        ("abs(O1 - O3)", r"\left|O_{1} - O_{3}\right|"),
        ("cross(A - B, F)", r"(A - B) \times F"),
        ("x % (2*pi)", r"x \bmod 2\,\pi"),
        ("group_67.R_A", r"R_{A}(\text{group 67})"),
        ("[0.5, -1]", r"\left[0.5,\ -1\right]"),
        ("phi3[k]", r"{\varphi_{3}}_{k}"),
        ("L4_found.value", r"\operatorname{Find}\,L_{4}"),
    ],
)
def test_expression_as_a_textbook_prints_it(source, tex):
    assert formula.latex(ast.parse(source, mode="eval").body) == tex


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


@pytest.mark.parametrize(
    ("value", "unit", "tex"),
    [
        (0.66132, "m", r"0.66132\ \mathrm{m}"),
        (np.pi / 6, "deg", r"30^\circ"),
        (15348729.0, "MPa", r"15.349\ \mathrm{MPa}"),
        (0.14, "%", r"14\,\%"),
        (1.5e-7, "m", r"1.5 \cdot 10^{-7}\ \mathrm{m}"),
        (-2.5e12, "-", r"-2.5 \cdot 10^{12}"),
        (129613.7, "N", r"129614\ \mathrm{N}"),
        (999999.9, "N", r"1000000\ \mathrm{N}"),
        (0.5 - 2j, "m", r"(0.5,\ -2)\ \mathrm{m}"),
        (np.array([1.0, 2.0, 3.0]), "N*m", r"1 \,\ldots\, 3\ \mathrm{N\cdot m}"),
        (np.array([1.0, np.nan]), "m**2", r"1 \,\ldots\, \text{none}\ \mathrm{m^{2}}"),
        (7, "-", "7"),
        (-0.0, "m", r"0\ \mathrm{m}"),
    ],
)
def test_value_in_its_display_unit(value, unit, tex):
    assert formula.value_latex(value, unit) == tex


def test_unknown_unit_names_the_line():
    with pytest.raises(SheetError, match=r"line 3 of <cell \d+>: unit \[MPaa\] is not known"):
        run(IMPORT + "a = 1.0  # [m] fine\np = 2.0  # [MPaa] wrong\ntypeset()")


def test_one_position_of_the_fields():
    names = run(
        IMPORT + "import numpy as np\nL = 2.0  # [m] link\nx = L * np.arange(3)  # [m] place\nshown = typeset().at(1)"
    )
    assert names["shown"].values == (2.0, 2.0)
    assert [row.name for row in names["shown"].rows] == ["L", "x"]
    assert r"\ldots" not in names["shown"]._mime_()[1]


def test_page_shows_symbol_formula_value_and_meaning():
    names = run(IMPORT + "L3 = 0.2  # [m] arm\nA = L3**2  # [cm**2] <area>\nshown = typeset()")
    kind, text = names["shown"]._mime_()
    assert kind == "text/html"
    assert r"A = L_{3}^{2} = 400\ \mathrm{cm^{2}}" in text
    assert r"L_{3} = 0.2\ \mathrm{m}" in text
    assert "&lt;area&gt;" in text
