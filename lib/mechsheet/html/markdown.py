"""Texts of a worksheet in HTML: Markdown with formulas between dollar signs, and no markup of its own."""

import re
from functools import lru_cache
from html import escape

from latex2mathml.converter import convert
from markdown import Markdown  # type: ignore[import-untyped]
from markdown.inlinepatterns import InlineProcessor  # type: ignore[import-untyped]

_TAG = re.compile(r"\\tag\{([^}]*)\}")
_UPRIGHT = re.compile(r"\\mathrm\{([^{}]*)\}")  # which is left slanted otherwise
_WORD = re.compile(r"<mtext>(\w[\w,]*)</mtext>")  # an index or an operator, which formulas of lines have so too
_CAPITAL = re.compile(r"<mi>(&#x003(?:9[348BE]|A[035689]);)</mi>")  # Greek ones, which print has upright
_TABLES = {"aligned": "split", "gathered": "matrix"}  # environments that run into one line otherwise
_BARS = re.compile(r"<mo>(&#x0007C;|&#x02016;)</mo>(<mtable>(?:(?!<mtable>).)*?</mtable>)<mo>\1</mo>")
_ENDS = "m(?:i|n|sub|sup|subsup|row|frac|sqrt)"
_FUNCTION = re.compile(  # between factors, but not with a power of its own
    rf"(</{_ENDS}>|&#x00029;</mo>)?(?<!<msup>)(?<!<msub>)<mi>(arc)?(sin|cos|tan|ln|log|exp)</mi>(?=(<{_ENDS}[ >])?)"
)
_SIGN = re.compile(  # of what begins there: with blanks at both sides it would be a difference
    r"(<mo>&#x0(?:003D|003C|003E|2264|2265|002C|2192|2208|22C5);</mo>|<mo [^>]*>(?:&#x00028;|\[)</mo>)"
    r"<mo>(?=&#x02212;</mo>)"
)
_FORMULA = r"<math>(?:(?!</math>).)*</math>"
_AT_A_FORMULA = re.compile(  # what stands in one line with it
    rf"[(\[]{_FORMULA}[.,;:!?)\]]*|{_FORMULA}[.,;:!?)\]]+", re.DOTALL
)
_SLASH = "<mo>&#x0002F;</mo>"
_THIN = '<mspace width=".17em"/>'
_BAR = '<mo stretchy="true" symmetric="true" form="{}fix">{}</mo>'


@lru_cache(maxsize=512)
def html(text: str) -> str:
    """A text in HTML; tags that stand in it are shown as they are.

    >>> html("the *rod* $L_4$ <b>")
    '<p>the <em>rod</em> <math><msub><mi>L</mi><mn>4</mn></msub></math> &lt;b&gt;</p>'
    >>> html("of $p$ and $q$, too")
    '<p>of <math><mi>p</mi></math> and <span class="ms-together"><math><mi>q</mi></math>,</span> too</p>'
    """
    return _AT_A_FORMULA.sub(r'<span class="ms-together">\g<0></span>', str(_converter().convert(text)))


def formula(latex: str, *, block: bool = False) -> str:
    """A formula of a text in MathML, the number of one that stands alone at its end."""
    number = _TAG.search(latex)
    for environment, other in _TABLES.items():
        latex = re.sub(rf"\\(begin|end)\{{{environment}\}}", rf"\\\1{{{other}}}", latex)
    written = convert(_UPRIGHT.sub(r"\\text{\1}", _TAG.sub("", latex)))
    inside = re.sub(r"^<math[^>]*><mrow>(.*)</mrow></math>$", r"\1", written, flags=re.DOTALL)
    inside = _BARS.sub(lambda m: f"<mrow>{_BAR.format('pre', m[1])}{m[2]}{_BAR.format('post', m[1])}</mrow>", inside)
    inside = _FUNCTION.sub(_spaced, inside)
    inside = _WORD.sub(r'<mi mathvariant="normal">\1</mi>', inside)
    inside = _CAPITAL.sub(r'<mi mathvariant="normal">\1</mi>', inside)
    inside = _SIGN.sub(r'\1<mo form="prefix">', inside).replace(_SLASH, '<mo lspace="0" rspace="0">&#x0002F;</mo>')
    # Browsers know of columns what styles say of their cells.
    inside = inside.replace('columnspacing="0em"', 'class="aligned"')
    inside = re.sub('<mtd columnalign="([a-z]+)"', r'<mtd style="text-align:\1;text-align:-webkit-\1"', inside)
    if not block:
        return f"<math>{inside}</math>"
    label = f'<span class="ms-number">({escape(number[1])})</span>' if number else ""
    return f'<span class="ms-line"><math displaystyle="true">{inside}</math>{label}</span>'


def _spaced(function: "re.Match[str]") -> str:
    before, arc, name, behind = (part or "" for part in function.groups())
    return f"{before}{_THIN * bool(before)}<mi>{arc}{name}</mi>{_THIN * bool(behind)}"


class _Formula(InlineProcessor):  # type: ignore[misc]
    def handleMatch(self, m: "re.Match[str]", data: str) -> tuple[str, int, int]:
        return self.md.htmlStash.store(formula(m[2], block=len(m[1]) > 1)), m.start(0), m.end(0)


def _converter() -> Markdown:
    made = Markdown(extensions=["tables", "sane_lists"])
    made.preprocessors.deregister("html_block")
    made.inlinePatterns.deregister("html")
    made.inlinePatterns.register(_Formula(r"(\${1,2})((?:[^$\\]|\\.)+?)\1", made), "formula", 185)  # before escapes
    return made
