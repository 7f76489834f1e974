"""Formulas of the page in one file: MathML from the tree, and the font that is cut to their signs."""

import ast
import base64
import re
from io import BytesIO
from typing import get_args
from xml.etree import ElementTree

import pytest

from mechsheet.document.expression import tree
from mechsheet.document.formula import Measure, Node, Power, Row, Symbol, Text
from mechsheet.html import font, mathml

EXPRESSIONS = {
    "a + b*c": "𝑎+𝑏𝑐",
    "-a/(b - c)": "−𝑎/(𝑏−𝑐)",
    "sqrt(x**2 + 1)": "√(𝑥^2+1)",
    "where(a < b, -1, 2)": "{−1if𝑎<𝑏2otherwise",
    "abs(phi34)": "|𝜑_34|",
    "1.5e-7*x": "1.5⋅10^(−7)𝑥",
    "a[2]": "𝑎_2",
    "floor(x)": "⌊𝑥⌋",
    "a & (b | c)": "𝑎and(𝑏or𝑐)",
}


def read_out(element: ElementTree.Element) -> str:
    """What MathML shows, in a line: ``_``, ``^``, ``/`` and ``√`` for its forms."""
    parts = [read_out(child) for child in element]
    own = re.sub(r"\s", "", element.text or "")
    match element.tag:
        case "mi" if len(own) == 1 and element.get("mathvariant") != "normal":
            return font.slanted(own)
        case "msub" | "msup":
            sign = "_" if element.tag == "msub" else "^"
            lowered = f"({parts[1]})" if len(list(element[1])) > 1 else parts[1]
            return f"{parts[0]}{sign}{lowered}"
        case "mfrac":
            return "/".join(
                f"({p})" if len(list(e)) > 1 and "(" not in p else p for p, e in zip(parts, element, strict=True)
            )
        case "msqrt":
            return f"√({''.join(parts)})"
    return own + "".join(parts)


@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_an_expression_is_set_as_it_is_read(expression: str) -> None:
    written = mathml.mathml(tree(ast.parse(expression, mode="eval").body))
    assert read_out(ElementTree.fromstring(written)) == EXPRESSIONS[expression]


def test_every_kind_of_node_has_a_rule() -> None:
    assert set(mathml.RULES) == set(get_args(Node))


def test_a_text_is_no_markup() -> None:
    row = Row((Text("<b>&"), Symbol("<i>", "<u>"), Measure(2.0, "mm**2")))
    told = "".join(ElementTree.fromstring(mathml.mathml(row)).itertext())
    assert told == "<b>&<i><u>2mm2"


def test_numbers_have_their_signs_and_units() -> None:
    def told(node: Node) -> str:
        return read_out(ElementTree.fromstring(mathml.mathml(node)))

    assert told(Measure(-0.5, "m/s**2")) == "−0.5m/s^2"
    assert told(Measure(1.5 - 2j, "N")) == "(1.5,−2)N"
    assert told(Measure(30.0, "deg")) == "30°"
    assert told(Measure(float("nan"), "-")) == "none"
    assert told(Power(Symbol("x"), Measure(-1.0, "-"))) == "𝑥^(−1)"


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
