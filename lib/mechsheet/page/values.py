"""What the page shows of each value: its writer by its kind, from the data to HTML."""

import json
import re
from collections.abc import Sequence
from dataclasses import replace
from datetime import date
from functools import lru_cache, partial, singledispatch
from html import escape, unescape
from typing import Any

import marimo as mo
import numpy as np

from mechsheet import units
from mechsheet.document import chart, chart_svg, drawing_svg
from mechsheet.document.blocks import beside, blocks, fitting
from mechsheet.document.markup import as_written, compared, in_words, meant, message, named, tolerance
from mechsheet.document.shortened import foot, shortened, thinned
from mechsheet.html import index
from mechsheet.page import fields, notebook, switched
from mechsheet.page.charted import charted
from mechsheet.page.editable import marking
from mechsheet.page.headings import heading
from mechsheet.page.lines import lines
from mechsheet.page.needed import needed
from mechsheet.page.script import element
from mechsheet.page.smooth import smooth
from mechsheet.page.unchanged import kept
from mechsheet.page.waiting import section, waiting
from mechsheet.worksheet import mistakes, numbers, symbol
from mechsheet.worksheet.check import Check, Summary
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.errors import SheetError, Waits
from mechsheet.worksheet.index import Index
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.kinds import Choice, Input, Switch
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.said import said
from mechsheet.worksheet.shown import Charted, Shown
from mechsheet.worksheet.table import Column, Figure, Table
from mechsheet.worksheet.text_line import TextLine
from mechsheet.worksheet.title import Caption, Mark, Note, Player, SideBySide, Slider, Title
from mechsheet.worksheet.typeset import Typeset
from mechsheet.worksheet.verdict import Verdict

# Shown by the style sheet that stands where something was refused.
_LOST = '<span class="ms-badge ms-FAIL">not computed to its end</span>'
_FAILED = "ms-failed"
MISTAKE = '<span class="ms-badge ms-FAIL">mistake</span>'
NOTE = '<span class="ms-badge ms-OPEN">note</span>'
_TOLD = f'<div class="ms-told" style="display:none">{_LOST} </div>'


def written(value: object) -> tuple[str, str]:
    """MIME type and text of a value of the package."""
    try:
        text = _marked(value)
    except Exception as error:  # which marimo would leave out without a word
        text = failed(f"this {type(value).__name__} cannot be shown: {mistakes.why(error, ())}", ends=False)
    titled = mo.running_in_notebook() and notebook.shows("title_block")
    if mo.running_in_notebook() and (isinstance(value, Title) or (not titled and notebook.is_first())):
        if mo.app_meta().mode == "edit":
            notebook.compute_what_lost_a_name()
        return "text/html", needed(notebook.file()) + text
    placed = _placed(value) and not _HEADED.search(text)
    shown = placed and mo.app_meta().mode == "run" and titled
    if shown and not _OF_MARIMO.search(text):
        # Else marimo itself makes each element over and again. HTML is full of double quotes: it stands in single ones.
        text = f"<ms-shown html='{text.replace('&', '&amp;').replace(_QUOTE, '&#39;')}'></ms-shown>"
    if shown or (placed and isinstance(value, Typeset)):  # plain HTML is parsed four times a run, in search of headings
        return "application/vnd.marimo+mimebundle", json.dumps({"text/html": text})
    return "text/html", text


def _placed(value: object) -> bool:
    """Whether a script of the page may put a value in its place: no headings, no picture asked for alone."""
    return not isinstance(value, Title | Index | Drawing)


def slider(value: Slider) -> Any:
    """The element of marimo that a slider is in a running page; the slider itself where none is running."""
    return fields.slider(value) if mo.running_in_notebook() else value


def refused(error: Exception, shown: Any) -> None:
    """Stop the running cell with an error in its place, or ``shown``; return where no page is running.

    And in the setup of an editor, which shows of that cell nothing but what it raises.
    """
    if mo.running_in_notebook() and not (notebook.is_setup() and mo.app_meta().mode == "edit"):
        of = error.of if isinstance(error, SheetError) else ""
        mo.stop(True, mo.Html(failed("" if isinstance(error, Waits) else str(error), of, str(error), shown)))


def failed(told: str, of: str = "", reason: str = "", shown: Any = None, cell_id: str = "", ends: bool = True) -> str:
    """HTML of what stands in the place of a cell that failed: its reason, or ``shown``.

    Title block and bar tell it too, for the verdicts of the checks may have gone with their cells, and the field of the
    input ``of`` that name. What waits for a number leaves what is ``told`` to the line that has none. Sections that
    wait for the cell, the one that runs unless an id is given, say so where it ``ends`` there.
    """
    callout = shown if shown is not None else mo.callout(mo.Html(message(reason or told)), kind="danger")
    said = numbers.on_page(reason or told)
    if told and mo.app_meta().mode == "edit" and (place := section(*notebook.stopped(cell_id))):
        told, said = f"{place}, {told}", f"{place}, {said}"  # whose lines are counted in each cell
    content = f'content:"{_quoted(said)}"'
    style = ".ms-told{display:block!important}" + (f".ms-told::after{{{content}}}" if told else "")
    if of:
        style += f'td[data-input="{re.split(r"[. ]", of)[0]}"]::after{{{content}}}'
        style += f'input[data-input="{of}"]{{outline:2px solid var(--red-11,#c62828)}}'
    if ends and mo.app_meta().mode == "run":  # the editor tells it of every cell
        for place, text in waiting(*notebook.stopped(cell_id)).items():
            style += f'.marimo-cell:has([id="{_quoted(place)}"])::after{{content:"{_quoted(text)}"}}'
    bar = f'<a href="#failed">{_LOST} {message(told)}</a>'
    return element(_FAILED, f"{mo.as_html(callout).text}<style>{style}</style>", id="failed", bar=bar)


def stopped(output: object, cell_id: str) -> str:
    """HTML of what stands in the place of a cell that ``mo.stop`` has ended; nothing where the cell was `refused`."""
    if output is None:
        return failed("stopped here by mo.stop, which says nothing", cell_id=cell_id)
    shown = mo.as_html(output)
    if _FAILED in shown.text:
        return ""
    words = " ".join(unescape(_TAG.sub(" ", shown.text)).split())
    return failed(words or "stopped here by mo.stop", shown=shown, cell_id=cell_id)


_QUOTE = "'"
_TAG = re.compile(r"<(style|script)\b.*?</\1>|<[^>]*>", re.DOTALL)
_HEADED = re.compile("<h[1-6][ >]")  # marimo lists the headings of plain HTML beside the page
_OF_MARIMO = re.compile("<(?:script|marimo-ui-element)")  # works only where marimo itself puts it


@singledispatch
def html(value: Any) -> str:
    """What the page shows of a value, as HTML; what is not the package's is left to marimo."""
    if isinstance(value, Shown):
        return f"<div>{escape(type(value).__name__)}: the page has no writer for values of this kind</div>"
    kind, text = value._mime_() if hasattr(value, "_mime_") else ("", "")
    return str(text) if kind == "text/html" else mo.as_html(value).text


_marked = marking(html)


@html.register
def _(markdown: str) -> str:
    return _set(markdown)


@lru_cache(maxsize=256)  # a text stays while the numbers beside it move
def _set(markdown: str) -> str:
    return f'<div class="ms-between">{mo.md(markdown).text}</div>'


@html.register
def _(value: Charted) -> str:
    shown, place, title = charted(value.chart())
    return f"{shown}{_caption('Figure', place, title)}" if title else shown


@html.register
def _(value: Drawing) -> str:
    return drawing_svg.svg(value).replace("<svg", '<svg role="img" aria-label="drawing"', 1)


@html.register
def _(title: Title) -> str:
    text = mo.md(f"# {title.name}\n\n{title.text}").text
    cells = [("Worksheet", escape(title.file)), ("Computed", f"{date.today():%Y-%m-%d}")]
    fields = "".join(f"<span>{label} <b>{value}</b></span>" for label, value in cells)
    switch = '<label class="ms-screen"><input type="checkbox" class="ms-switch"> numbers in the formulas</label>'
    return (
        f'<div class="ms-title">{text}<div class="ms-row">{fields}{switch}'
        f"{''.join(map(html, title.tools))}</div>{_TOLD}{_noted(title.notes)}</div>"
    )


def _noted(notes: tuple[Note, ...]) -> str:
    """Notes with links to their cells, and the style sheet that tells each under the output of its cell too."""
    items = "".join(
        f"<div>{MISTAKE if note.mistake else NOTE} {escape(place and f'{place}, ')}"
        f'<a href="#cell-{note.cell}">{escape(note.text)}</a></div>'
        for note in notes
        for place in [section(*notebook.stopped(note.cell)) if note.cell else ""]
    )
    texts = {note.cell: "\n".join(n.text for n in notes if n.cell == note.cell) for note in notes}
    places = "".join(
        f'#cell-{cell} [data-cell-role="output"]::after{{content:"{_quoted(text)}"}}' for cell, text in texts.items()
    )
    return items + (f"<style>{places}</style>" if places else "")


def _quoted(text: str) -> str:
    """Text as it stands between the quotes of a style sheet in a page."""
    return re.sub(r"[^\w .,;:=()+-]", lambda c: f"\\{ord(c[0]):x} ", text)


@html.register
def _(value: Player) -> str:
    turning = " data-turning" if value.turning else ""
    button = f'<button class="ms-play" aria-label="play"{turning}>▶</button>'
    return f'<div class="ms-player">{html(value.slider)}{button}</div>'


@html.register
def _(slider: Slider) -> str:
    return f"<div>{escape(fields.label(slider))} {numbers.significant(slider.value, 4)}</div>"


@html.register
def _(value: Mark) -> str:
    marks = ";".join(f"{chart_svg.variable(symbol.plain(name))}:{float(x)!r}" for name, x in value.positions)
    return f'<ms-marks at="{marks}"></ms-marks>'


@html.register
def _(value: Caption) -> str:
    return _caption("Figure", value.number, value.title)


def _caption(what: str, number: str, title: str) -> str:
    return f'<div class="ms-caption" id="{_place(what, number)}"><b>{what} {escape(number)}</b> – {escape(title)}</div>'


def _place(what: str, number: str) -> str:
    return escape(f"{what.lower()}-{number}")


@html.register
def _(value: SideBySide) -> str:
    columns = ("".join(map(_marked, column)) for column in value.columns)
    rows = f' style="--row:{value.row}"' if value.row else ""
    return f'<div class="ms-beside"{rows}>{"".join(f"<div>{each}</div>" for each in columns)}</div>'


@html.register
def _(value: Typeset) -> str:
    return lines(value) + "".join(map(_marked, value.shown))


@html.register
def _(check: Check) -> str:
    told = ": " + switched.value(anchor(check.name), check.unit, partial(compared, check)) if check.evaluated else ""
    return (
        f'<div id="{anchor(check.name)}">{_badge(check)} {_in_words(check.name)}{told}'
        f'<span style="opacity:.7">{_why(check)}</span></div>'
    )


def _badge(check: Check) -> str:
    kind, verdict = ("PASS" if check.passed else "FAIL",) * 2 if check.evaluated else ("OPEN", "not evaluated")
    return f'<span class="ms-badge ms-{kind}">{verdict}</span>'


def anchor(name: str) -> str:
    """Id of a check in the page."""
    return "check-" + re.sub(r"\W+", "-", name)


@html.register
def _(summary: Summary) -> str:
    passed = sum(check.passed for check in summary.checks)
    items = "".join(
        f"<span>{_badge(check)} {_link(check, _in_words(check.name))}{_in_short(check)}</span>"
        for check in summary.worst_first
    )
    worst = "".join(map(_in_bar, summary.worst_first[:1]))
    bar = f'<a href="#checks"><b>{passed} of {len(summary.checks)} checks</b></a>{worst}'
    whole = f'<div class="ms-summary" id="checks"><b>{summary.count}</b><div class="ms-row">{items}</div></div>'
    return element("ms-verdict", whole, bar=bar)


def _why(check: Check) -> str:
    return f"{';' if check.evaluated else ':'} {message(check.reason)}" if check.reason else ""


def _in_short(check: Check) -> str:
    """What stands behind the name of a check in the summary: what part of its limit it takes, or why it is as it is."""
    return f": {message(check.reason)}" if check.reason else f" {check.utilised}"


def _in_bar(check: Check) -> str:
    """The worst check: why it fails, or how near to its limit it comes; nothing of one that has no such part."""
    if check.passed:
        return _link(check, f"{_in_words(check.name)} {check.utilised}") if check.utilised else ""
    told = f": {compared(check, check.unit)}" if check.evaluated else ""
    return _link(check, f"{_badge(check)} {_in_words(check.name)}{told}")


def _in_words(sentence: str, names: tuple[str, ...] = ()) -> str:
    """A sentence, names of the worksheet that is shown as symbols."""
    if not mo.running_in_notebook():
        return in_words(sentence, names)
    try:
        return in_words(sentence, names, said(notebook.running()[1]))
    except notebook.Unlike:
        return in_words(sentence, names)


def _link(check: Check, text: str) -> str:
    return f'<a href="#{anchor(check.name)}">{text}</a>'


@html.register
def _(made: Index) -> str:
    return index.written(made, heading)


@html.register
def _(found: Verdict) -> str:
    failures = found.failures()
    lost = failures and not np.all(found.waits)
    colour = "#c62828" if lost else "#2e7d32" if np.any(found.solved) else "#8a6d00"
    badge = (
        f'<span style="background:{colour};color:#fff;border-radius:.3em;padding:.1em .5em;margin-right:.6em">'
        f"{found.word()}</span>"
    )
    lines = "".join(f"<div>{message(text)}</div>" for text in failures)
    rows = "".join(
        f'<tr><td style="opacity:.65;padding:0 1em 0 0">{escape(k)}</td>'
        f'<td style="padding:0;font-variant-numeric:tabular-nums">{_in_words(v, found.names)}</td></tr>'
        for k, v in found.details()
    )
    head = f"{badge}<b>{_in_words(found.headline(), found.names)}</b>"
    whole = (
        '<div class="ms-found" style="border-left:3px solid currentColor;padding:.2em .8em;margin:.4em 0">'
        f"<div>{head}</div>{lines}"
        f'<table style="border-collapse:collapse;font-size:.9em;margin-top:.3em">{rows}</table></div>'
    )
    return element("ms-unfound", whole, id="unfound", bar=f'<a href="#unfound">{head}</a>') if lost else whole


@html.register
def _(used: Used) -> str:
    changed, rows, told, section = used.changed, [], [], ""
    known = {field.name for field, _ in used.rows()}
    for field, _ in used.rows():
        unit = "" if field.unit == "-" else units.shown(field.unit)
        weight = "bold" if field.name in changed else "normal"
        name, value = as_written(field.name), getattr(used.g, field.name)
        if field.section != section:
            section = field.section
            rows.append(f'<tr><th colspan="4" style="text-align:left">{escape(section)}</th></tr>')
        rows.append(
            f'<tr style="font-weight:{weight}"><td>{name}</td>'
            f'<td style="text-align:right;padding:0 .5em">{_printed(field, value)}</td>'
            f'<td style="padding-right:1em">{escape(unit)}</td>'
            f"<td>{meant(field.meaning, known)} {tolerance(field)}</td></tr>"
        )
        own = field.text(getattr(type(used.g), field.name))
        text = field.text(value) if field.name in changed else own
        said, options = used.said.get(field.name), [*field.options] if isinstance(field, Choice) else None
        its = {"name": field.name, "head": name, "kind": _kind(field), "text": text, "own": own, "unit": unit}
        told.append({**its, "options": options, "said": said if isinstance(said, str) else text})
    return f'{element("ms-used", told=told)}<table class="ms-print" style="display:none">{"".join(rows)}</table>'


def _printed(field: Input, value: Any) -> str:
    """Value of an input on paper: of a list or a table all of it, up to as many as a page holds."""
    if isinstance(field, TextLine | Choice):
        return escape(field.brief(value))
    if not isinstance(field, Rows):
        return message(field.brief(value))
    columns = [
        [(escape if c.is_text else message)(c.text(x)) for x in xs.tolist()] for c, xs in field.held_by(value).values()
    ]
    if len(columns[0]) > _ON_PAPER:
        return message(field.brief(value))
    if field.row is None:
        return message(field.text(value))
    heads = "".join(f"<td>{fields.head(column)['head']}</td>" for column in field.columns)
    lines = ("".join(f"<td>{text}</td>" for text in row) for row in zip(*columns, strict=True))
    return f"<table><tr>{heads}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"


_ON_PAPER = 45  # rows of the inputs


def _kind(field: Input) -> str:
    return {Choice: "choice", Switch: "switch", TextLine: "text", Rows: "rows"}.get(type(field), "number")


@html.register
def _(whole: Figure) -> str:
    return _chart(thinned(smooth(whole)))


@kept(128)
def _chart(figure: Figure) -> str:
    layout = chart.line_chart(figure.x, figure.lines, figure.marks, figure.every)
    picture = switched.chart(figure, layout, chart_svg.svg(layout))
    caption = _caption("Figure", figure.number, figure.title)
    named = f'role="figure" aria-labelledby="{_place("Figure", figure.number)}"'
    return f'<ms-figure class="ms-figure" {named}>{picture}{caption}</ms-figure>'


@html.register
def _(table: Table) -> str:
    note = f'<div class="ms-note">{_in_words(table.note, table.said)}</div>' if table.note else ""
    named = f'role="group" aria-labelledby="{_place("Table", table.number)}" tabindex="0"'
    return f'<div class="ms-table" {named}>{_table(replace(table, note=""))}{note}</div>'


@kept(128)
def _table(table: Table) -> str:
    caption = _caption("Table", table.number, table.title)
    columns, left_out = shortened(table.columns)
    return caption + "".join(_block(part, left_out) for part in blocks(replace(table, columns=columns)))


def _block(columns: Sequence[Column], left_out: int) -> str:
    kinds = ["" if c.unit else ' class="ms-text"' for c in columns]
    heads = "".join(
        f'<th{kind} title="{escape(symbol.prose(c.meaning))}">{named(c.name)}</th>'
        for c, kind in zip(columns, kinds, strict=True)
    )
    unit_row = "".join(f"<th>{f'[{_unit(c)}]' if c.unit else ''}</th>" for c in columns)
    rows = "".join(
        "<tr>" + "".join(f"<td{kind}>{t}</td>" for t, kind in zip(row, kinds, strict=True)) + "</tr>"
        for row in zip(*(map(as_written if c.names else escape, cells(c)) for c in columns), strict=True)
    )
    head = f'<tr>{heads}</tr><tr class="ms-units">{unit_row}</tr>'
    fit = fitting(columns)
    style = f' style="--fit:{numbers.fixed(fit, 2)}"' if fit < 1 else ""
    below = foot(left_out, len(columns))
    table = f"<table{style}><thead>{head}</thead><tbody>{rows}</tbody>{below}</table>"
    return beside(columns, switched.columns(columns, table))


def cells(column: Column) -> list[str]:
    """Texts of a column of a table."""
    if column.unit and not column.power:
        return column.texts(numbers.AXIS)
    return [numbers.on_page(text) for text in column.texts()]


def _unit(column: Column) -> str:
    unit = escape(units.shown(column.unit))
    return switched.UNIT.format(unit) if column.of and switched.offered(column.unit) else unit
