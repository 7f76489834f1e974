"""The page itself: its title block, and sliders that play."""

import base64
import html
import sys
from dataclasses import dataclass, replace
from datetime import date
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mechsheet.document import chart_svg
from mechsheet.page.lines import markup
from mechsheet.worksheet import symbol
from mechsheet.worksheet.errors import quoted

if TYPE_CHECKING:
    import marimo as mo

    from mechsheet.page.editor import Note


# Shown by the style sheet that stands where something was refused.
_TOLD = '<div class="ms-told" style="display:none"><span class="ms-badge ms-FAIL">not computed to its end</span> </div>'


@dataclass(frozen=True)
class Title:
    """Title block: what the worksheet is about, its file, the day, and the switch for numbers in formulas."""

    name: str
    text: str
    file: str
    notes: "tuple[Note, ...]" = ()

    def _mime_(self) -> tuple[str, str]:
        import marimo as mo

        text = mo.md(f"# {self.name}\n\n{self.text}").text
        cells = [("Worksheet", html.escape(self.file)), ("Computed", f"{date.today():%Y-%m-%d}")]
        fields = "".join(f"<span>{label} <b>{value}</b></span>" for label, value in cells)
        switch = '<label class="ms-screen"><input type="checkbox" class="ms-switch"> numbers in the formulas</label>'
        return (
            "text/html",
            f'{_script()}<div class="ms-title">{text}<div class="ms-row">{fields}{switch}</div>'
            f"{_TOLD}{_noted(self.notes)}</div>",
        )


def title_block(name: str, text: str = "") -> Title:
    """Title block of the calling worksheet; ``text`` is Markdown."""
    title = Title(name, text, Path(sys._getframe(1).f_globals.get("__file__", "")).name)
    if "marimo" in sys.modules:
        import marimo as mo

        if mo.running_in_notebook():
            from mechsheet.page.hastened import hasten

            hasten()
        if mo.app_meta().mode == "edit":
            from mechsheet.page import editor

            editor.watch(lambda notes: mo.output.replace(replace(title, notes=tuple(notes))))
    return title


def _noted(notes: "tuple[Note, ...]") -> str:
    """Mistakes with links to their cells, and the style sheet that tells each under the output of its cell too."""
    items = "".join(
        f'<div><span class="ms-badge ms-FAIL">mistake</span> '
        f'<a href="#cell-{note.cell}">{html.escape(note.text)}</a></div>'
        for note in notes
    )
    texts = {note.cell: "\n".join(n.text for n in notes if n.cell == note.cell) for note in notes}
    places = "".join(
        f'#cell-{cell} [data-cell-role="output"]::after{{content:"{quoted(text)}"}}' for cell, text in texts.items()
    )
    return items + (f"<style>{places}</style>" if places else "")


def player(slider: "mo.ui.slider", turning: bool = False) -> "mo.Html":
    """A slider with a play button, which moves it to and fro; ``turning`` always on, from its end to its beginning."""
    import marimo as mo

    button = f'<button class="ms-play" aria-label="play"{" data-turning" if turning else ""}>▶</button>'
    return mo.Html(f'<div class="ms-player">{slider.text}{button}</div>')


@dataclass(frozen=True)
class Mark:
    """A moving position in SI: it is marked in every chart over the quantity of that name."""

    positions: tuple[tuple[str, float], ...]

    def _mime_(self) -> tuple[str, str]:
        marks = ";".join(f"{chart_svg.variable(symbol.plain(name))}:{float(x)!r}" for name, x in self.positions)
        return "text/html", f'<ms-marks at="{marks}"></ms-marks>'


def mark(**positions: Any) -> Mark:
    """The position of a slider, such as ``mark(S=S_t)``, to be shown beside what is drawn there."""
    return Mark(tuple(positions.items()))


@dataclass(frozen=True)
class Caption:
    """Number and title of a drawing, below it; those of a chart or a table stand with it."""

    number: str
    title: str

    def _mime_(self) -> tuple[str, str]:
        return "text/html", (
            f'<div class="ms-caption"><b>Figure {html.escape(self.number)}</b> – {html.escape(self.title)}</div>'
        )


def caption(number: str, title: str) -> Caption:
    """Caption of a drawing: ``typeset(drawing_21, caption("2.1", "Scheme of the mechanism"))``."""
    return Caption(number, title)


@dataclass(frozen=True)
class SideBySide:
    """Columns of what is shown, as many in a row as find room."""

    columns: tuple[tuple[Any, ...], ...]

    def _mime_(self) -> tuple[str, str]:
        columns = ("".join(map(markup, column)) for column in self.columns)
        return "text/html", f'<div class="ms-beside">{"".join(f"<div>{each}</div>" for each in columns)}</div>'


def side_by_side(*shown: Any) -> SideBySide:
    """Drawings beside each other; of a tuple, one below the other."""
    return SideBySide(tuple(each if isinstance(each, tuple) else (each,) for each in shown))


@cache
def _script() -> str:
    """The page's script, as an address: the only form in which a page of marimo runs one from an output."""
    text = (Path(__file__).parent / "page.js").read_bytes()
    return f'<script src="data:text/javascript;base64,{base64.b64encode(text).decode()}"></script>'
