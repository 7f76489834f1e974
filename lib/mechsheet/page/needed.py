"""What the values of a page need to look and work as they do, which comes with the first of them: scripts and style."""

import re
from functools import cache
from pathlib import Path
from threading import local

import marimo as mo

from mechsheet.html import font
from mechsheet.html.javascript import runtime
from mechsheet.page.script import element, script


def needed(worksheet: Path) -> str:
    """HTML of the scripts of the page, and of its style where the worksheet's ``css_file`` has it not."""
    formulas = element("ms-formulas", css=runtime("formulas.css"), font=_font())
    return _scripts() + formulas + ("" if _is_styled(worksheet) else element("ms-style", css=_style()))


def _font() -> str:
    """Address of the font of formulas: a file of marimo's page, which knows those of images alone.

    There is one for each page: marimo keeps it as long as something refers to it.
    """
    if not hasattr(_page, "font"):
        _page.font = mo.image(font.whole())
    return str(_ADDRESS.findall(_page.font.text)[0])


@cache
def _scripts() -> str:
    return (
        script("shown.js")
        + script("page.js", "rows.js")
        + script("units.js", "format.js")
        + script("chart.js", "tooltip.js", "format.js", "chart.js")
        + script("symbols.js", "tooltip.js")
        + script("sections.js")
    )


_page = local()  # every page computes in a thread of its own
_ADDRESS = re.compile("src=['\"](.*?)['\"]")
_CSS_FILE = re.compile(r"""css_file\s*=\s*["']([^"']+)["']""")


def _is_styled(worksheet: Path) -> bool:
    """Whether the style sheet that a worksheet names is the package's, or has it in it."""
    try:
        named = _CSS_FILE.search(worksheet.read_text(encoding="utf-8"))
        return named is not None and ".ms-line" in (worksheet.parent / named[1]).read_text(encoding="utf-8")
    except OSError:
        return False


def _style() -> str:
    """The style of the page: it lies beside this file in the installed package, beside the worksheets in a clone."""
    places = Path(__file__).with_name("page.css"), Path(__file__).parents[3] / "worksheets" / "page.css"
    return next((place.read_text(encoding="utf-8") for place in places if place.exists()), "")
