"""Formulas of the page in one file: MathML from the tree, and the font that is cut to their signs."""

from __future__ import annotations

import ast
import base64
import re
from io import BytesIO
from typing import TYPE_CHECKING, Any, get_args
from xml.etree import ElementTree

import numpy as np
import pytest
from in_tex import tex
from own_worksheet import own

from mechsheet.document import mathml
from mechsheet.document.expression import reads, substituted, tree
from mechsheet.document.formula import Measure, Node, Power, Row, Symbol, Text
from mechsheet.html import font, javascript, markdown, write
from mechsheet.html.put_in import Read, put_in
from mechsheet.worksheet import numbers
from mechsheet.worksheet.lines import Formula

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Page


def test_every_kind_of_node_has_a_rule() -> None:
    assert set(mathml.RULES) == set(get_args(Node))


def test_a_text_is_no_markup() -> None:
    row = Row((Text("<b>&"), Symbol("<i>", "<u>"), Measure(2.0, "mm**2")))
    told = "".join(ElementTree.fromstring(mathml.mathml(row)).itertext())
    assert told == "<b>&<i><u>2mm2"


def test_a_sign_between_words_has_its_space(blank: Page) -> None:
    """Where nothing but words stands beside it, too."""
    gaps = []
    for expression in ("sorted(a, reverse=True)", "sorted(a, reverse=b)"):
        blank.set_content(mathml.mathml(tree(ast.parse(expression, mode="eval").body)))
        gaps.append(
            blank.evaluate("""() => {
          const sign = [...document.querySelectorAll("mo")].find(e => e.textContent === "=");
          return sign.getBoundingClientRect().width;
        }""")
        )
    assert gaps[0] == gaps[1]


def test_numbers_have_their_signs_and_units() -> None:
    assert tex(Measure(-0.5, "m/s**2")) == r"-0.5\,\text{m/s}^{2}"
    assert tex(Measure(1.5 - 2j, "N")) == r"(1.5,-2)\,\text{N}"
    assert tex(Measure(30.0, "deg")) == r"30^\circ"
    assert tex(Measure(float("nan"), "-")) == r"\text{none}"
    assert tex(Power(Symbol("x"), Measure(-1.0, "-"))) == "x^{-1}"


def test_the_font_has_the_signs_and_what_a_root_and_a_high_bracket_need() -> None:
    from fontTools.ttLib import TTFont

    address = font.address("φΣx∫")
    assert address.startswith("data:font/woff;base64,")
    cut = TTFont(BytesIO(base64.b64decode(address.partition(",")[2])))
    signs = cut.getBestCmap()
    assert {ord(sign) for sign in "φ𝜑Σ𝛴x𝑥∫√(−0"} <= set(signs)
    assert 0x3B6 not in signs, "cut"
    variants = cut["MATH"].table.MathVariants
    for sign in "(√∫":
        assert signs[ord(sign)] in variants.VertGlyphCoverage.glyphs, sign
    assert len(address) < 120_000


PUT_IN = (
    "a + b", "a - b", "-a", "a*b", "a*b*c", "2*a", "2*a*b", "a/b", "-a/b*c", "a*(b + c)", "a + b*c", "a + (b + c)",
    "a + (b - c)*a", "a**2", "a**b", "(a/b)**2", "sin(a)", "sin(a)*b", "b*sin(a)", "cos(a)**2", "sqrt(a)", "abs(a - b)",
    "exp(-a)", "a % b", "a < b", "where(a < b, a, c)", "max(a, b)", "np.array([a, b])", "a[b]", "conj(p)*a", "p + q",
    "p*a", "a*p", "p - q", "abs(p)", "cross(p, q)", "dot(p, q)", "p.imag", "1j*a*p", "arctan2(a, b)", "a*(-b)",
    "a*(b/c)", "g.k*a", "g.k*g.k*p", "f(a)*b", "sum(a*x for x in c)", "a*b**2*c", "a and b or c", "-(a + b)",
    "a*b @ c", "a // b", "quad(lambda x: a*x, 0, b)[0]", "np.linalg.norm(c, ord=a)", "np.round(a, decimals=2)",
    "np.cbrt(a*b)", "a in (b, c)", "f(lambda b: b*c, b)", "np.prod([a*x for x in c])", "np.linspace(a, b, 5)",
)  # fmt: skip
UNITS = {"a": "-", "b": "deg", "c": "kN", "p": "mm", "q": "-", "g.k": "m/s**2"}
REALS = (0.0, -0.0, 0.5, 2.0, -3.25, 1e-7, -4e-7, 9e5, 2.5e8, -1e12, float("nan"), float("inf"), -float("inf"))


def test_numbers_are_put_into_a_formula_as_python_puts_them_in(blank: Page) -> None:
    """Brackets and dots too, whatever the numbers are, alone and together."""
    rng, given, expected = np.random.default_rng(5), list[Any](), list[str]()
    for expression in PUT_IN:
        line = Formula("y", ast.parse(expression, mode="eval").body, "-", "")
        names = [name for name in reads(line) if name in UNITS]
        told = put_in(line, {name: Read(UNITS[name], name in "pq") for name in names})
        for _ in range(40):
            x = {n: complex(*rng.choice(REALS, 2)) if n in "pq" else float(rng.choice(REALS)) for n in names}
            node = substituted(line, {name: Measure(x[name], UNITS[name]) for name in names})
            assert (node is None) == (told is None)
            if node is None or told is None:
                continue
            parts = [[x[n].real, x[n].imag] if n in "pq" else [x[n]] for n in names]
            behind = [numbers.behind(UNITS[n], mathml.NUMBER) for n in names]
            asked = [{"factor": 1, "behind": text} for text in behind]
            given.append([{"text": told.text, "signs": told.signs, "numbers": asked}, parts])
            expected.append(f'<math displaystyle="true"><mo>=</mo>{mathml.inner(node)}</math>')
    found = blank.evaluate(
        f"all => {{{javascript.runtime('format.js', 'put_in.js')}\nreturn all.map(each => withNumbers(...each))}}",
        given,
    )
    for (spec, parts), known, text in zip(given, expected, found, strict=True):
        assert as_seen(text) == as_seen(known), (spec, parts)


def as_seen(text: str) -> str:
    """MathML without what only groups, where a line may end, how high brackets and how wide spaces are, needless dots.

    High brackets have none before them, and how high they are may hang on a number far from where they begin. A browser
    writes a blank that does not break by its name.
    """
    text = text.replace("&nbsp;", "\u00a0")
    bare = re.sub(r"</?mrow>|</?mspace[^>]*>| stretchy=\"false\"|</math><wbr/?><math[^>]*>| form=\"infix\"", "", text)
    return re.sub(r"<mo>⋅</mo>(<mo>\(</mo><mo[^>]*>−</mo>)", r"\1", bare)


def test_a_minus_of_a_number_stands_at_it_wherever_the_number_stands(blank: Page) -> None:
    """After an opening bracket and a comma too, where browsers take it for that of a difference."""
    written = mathml.mathml(Measure(complex(-1, -2), "m"))
    blank.set_content(f"<math>{written}</math>")
    gaps = blank.evaluate("""() => [...document.querySelectorAll("mo")].filter(e => e.textContent === "−").map(e =>
      e.nextElementSibling.getBoundingClientRect().left - e.getBoundingClientRect().right)""")
    assert gaps == [0, 0]


LONG = f"""b = 2.0 * g.a  # [-] other
y = (g.F + g.a) * sin(b) ** 2 + sqrt(g.F**2 + g.a**2 + 2 * g.F * g.a * cos(b)) - (b + g.F) ** 3 / g.a - b  # [-] long
z = ({" + ".join(f"g.F * cos({n} * b)" for n in range(2, 22))}) / (g.F + g.a)  # [-] wide"""
OVER = """lines => lines.map(line => {
  const parts = [...line.querySelectorAll("math")].map(math => math.getBoundingClientRect());
  const {right} = line.getBoundingClientRect(), lowest = Math.max(...parts.map(part => part.top));
  return [parts.length, lowest > parts[0].bottom, Math.max(...parts.map(part => part.right - right))];
})"""


def test_a_long_formula_goes_on_in_the_next_line_and_what_cannot_is_smaller_on_paper(
    blank: Page, tmp_path: Path
) -> None:
    """It ended at the edge of the screen, and of the paper."""
    sheet = own(tmp_path, LONG)
    (tmp_path / "own.html").write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    blank.set_viewport_size({"width": 500, "height": 800})
    blank.goto((tmp_path / "own.html").as_uri())
    blank.wait_for_selector("body[data-ready]")
    for width in (400, 340):
        blank.set_viewport_size({"width": width, "height": 800})
        ((parts, goes_on, over),) = blank.eval_on_selector_all("#line-y", OVER)
        assert parts == 5 and goes_on and over <= 0
    shown = blank.locator("#line-z .ms-formula")
    assert shown.evaluate("e => e.scrollWidth > e.clientWidth && e.getBoundingClientRect().right <= innerWidth")
    blank.evaluate("""() => {
      const ask = document.createElement("input");  // that of a title
      document.body.append(Object.assign(ask, {className: "ms-switch", type: "checkbox", checked: true}));
      ask.dispatchEvent(new Event("change", {bubbles: true}));
    }""")
    blank.wait_for_selector("#line-z .ms-numbers math")
    ((parts, goes_on, over),) = blank.eval_on_selector_all("#line-y .ms-numbers", OVER)
    assert parts == 4 and goes_on and over <= 0
    blank.evaluate("dispatchEvent(new Event('beforeprint'))")
    blank.emulate_media(media="print")
    blank.set_viewport_size({"width": 8 * 687, "height": 800})  # as wide as what is printed of an A4, in fine steps
    blank.evaluate("document.documentElement.style.zoom = 8")
    assert [over for *_, over in blank.eval_on_selector_all(".ms-line", OVER) if over > 0] == []


def test_terms_of_a_long_formula_stand_as_close_as_those_of_one(blank: Page) -> None:
    """A sign that begins an element has no space of its own."""
    node = tree(ast.parse("a" + " + b - c" * 10, mode="eval").body)
    whole = f'<math displaystyle="true">{mathml.inner(node)}</math>'
    blank.set_viewport_size({"width": 1200, "height": 400})
    blank.set_content(f"<span>{whole}</span><br><span>{mathml.mathml(node)}</span>")
    one, several = blank.eval_on_selector_all("body > span", "e => e.map(e => e.getBoundingClientRect().width)")
    assert mathml.mathml(node).count("<math") == 21 and several == pytest.approx(one, abs=0.5)


def test_equations_below_each_other_are_rows_of_a_table() -> None:
    """In one line they would be another equation."""
    for environment in ("aligned", "gathered"):
        latex = rf"\begin{{{environment}}} a {'&' * (environment == 'aligned')}= b \\ c = d \end{{{environment}}}"
        written = markdown.formula(latex, block=True)
        assert written.count("<mtr>") == 2 and "&<" not in written and "newline" not in written


def test_bars_of_a_determinant_are_as_high_as_it() -> None:
    written = markdown.formula(r"M + \begin{vmatrix} a & b \\ c & d \end{vmatrix} + \begin{vmatrix} e \end{vmatrix}")
    assert written.count('stretchy="true"') == 4 and written.count("<mtable>") == 2


def test_a_function_stands_apart_from_the_factors_beside_it() -> None:
    spaced = markdown.formula(r"l \cos\varphi + \sin(x) - l \sin^2 x")
    assert spaced.count("<mspace") == 2 and "<msup><mi>sin</mi><mn>2</mn></msup>" in spaced
