"""Texts of a worksheet in HTML: Markdown with formulas between dollar signs, and no markup of its own."""

import re
from functools import lru_cache
from html import escape

from latex2mathml.converter import convert
from markdown import Markdown  # type: ignore[import-untyped]
from markdown.inlinepatterns import InlineProcessor  # type: ignore[import-untyped]

_TAG = re.compile(r"\\tag\{([^}]*)\}")
_UPRIGHT = re.compile(r"\\mathrm\{([^{}]*)\}")  # which is left slanted otherwise


@lru_cache(maxsize=512)
def html(text: str) -> str:
    """A text in HTML; tags that stand in it are shown as they are.

    >>> html("the *rod* $L_4$ <b>")
    '<p>the <em>rod</em> <math><msub><mi>L</mi><mn>4</mn></msub></math> &lt;b&gt;</p>'
    """
    return str(_converter().convert(text))


def formula(latex: str, *, block: bool = False) -> str:
    """A formula of a text in MathML, the number of one that stands alone at its end."""
    number = _TAG.search(latex)
    written = convert(_UPRIGHT.sub(r"\\text{\1}", _TAG.sub("", latex)))
    inside = re.sub(r"^<math[^>]*><mrow>(.*)</mrow></math>$", r"\1", written, flags=re.DOTALL)
    if not block:
        return f"<math>{inside}</math>"
    label = f'<span class="ms-number">({escape(number[1])})</span>' if number else ""
    return f'<span class="ms-line"><math displaystyle="true">{inside}</math>{label}</span>'


class _Formula(InlineProcessor):  # type: ignore[misc]
    def handleMatch(self, m: "re.Match[str]", data: str) -> tuple[str, int, int]:
        return self.md.htmlStash.store(formula(m[2], block=len(m[1]) > 1)), m.start(0), m.end(0)


def _converter() -> Markdown:
    made = Markdown(extensions=["tables", "sane_lists"])
    made.preprocessors.deregister("html_block")
    made.inlinePatterns.deregister("html")
    made.inlinePatterns.register(_Formula(r"(\${1,2})((?:[^$\\]|\\.)+?)\1", made), "formula", 185)  # before escapes
    return made
