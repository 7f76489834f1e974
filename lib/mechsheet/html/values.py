"""What the page shows of each value: its writer by its kind, from the data to HTML."""

import re
from collections.abc import Container, Sequence
from datetime import date
from functools import singledispatch
from html import escape
from inspect import cleandoc
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import chart, chart_svg, drawing_svg
from mechsheet.document.blocks import beside, blocks, fitting
from mechsheet.document.expression import equation
from mechsheet.document.markup import as_written, compared, meant, message, named, once, printed, tolerance, where
from mechsheet.document.mathml import mathml
from mechsheet.document.names import fields_by_name
from mechsheet.document.parts import Control, Line, Section, Text
from mechsheet.document.shortened import foot, shortened, thinned
from mechsheet.html import index, markdown, offered
from mechsheet.html.follow import Follower
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.lines import Recording
from mechsheet.worksheet import numbers, symbol
from mechsheet.worksheet.check import Check, Summary
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.index import Index
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.lines import Formula, Given
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.table import Column, Figure, Table
from mechsheet.worksheet.title import Caption, Mark, SideBySide, Title
from mechsheet.worksheet.verdict import Verdict

_MARK = re.compile(r' data-n="(\d+)"(>?)')
_READINGS = re.compile(" data-values='[^']*'")  # of a chart: the page knows them


@singledispatch
def html(value: Any, page: Follower) -> str:
    """HTML of a value, which `Follower` marks where it follows the inputs."""
    kind = type(value)
    what = escape(kind.__name__)
    if kind.__module__.startswith("marimo."):
        what = "what marimo shows"
        if not _SEEN.search(str(getattr(value, "text", "?"))):  # it has arranged parts, and adds nothing to them
            return ""
    return f'<p class="ms-note">{what}: shown in the worksheet alone</p>'


_SEEN = re.compile(r"<(?:img|svg|iframe|marimo-|table)|(?:^|>)[^<]*[^\s<]")


@html.register
def _(title: Title, page: Follower) -> str:
    cells = (("Worksheet", escape(title.file)), ("Computed", f"{date.today():%Y-%m-%d}"))
    told = "".join(f"<span>{label} <b>{value}</b></span>" for label, value in cells)
    told += '<label class="ms-screen"><input type="checkbox" class="ms-switch"> numbers in the formulas</label>'
    text = page.own(markdown.html(cleandoc(title.text)), cleandoc(title.text))
    return f'<header class="ms-title"><h1>{escape(title.name)}</h1>{text}<div class="ms-row">{told}</div></header>'


@html.register
def _(section: Section, page: Follower) -> str:
    level = min(section.level, 6)
    title = page.text(section, lambda text: markdown.html(text).removeprefix("<p>").removesuffix("</p>"))
    return f'<h{level} id="{anchor(section.title)}">{title}</h{level}>'


def anchor(title: str) -> str:
    """Id of a heading."""
    return "section-" + re.sub(r"\W+", "-", title.lower()).strip("-")


@html.register
def _(text: Text, page: Follower) -> str:
    return f'<div class="ms-between">{page.text(text, markdown.html)}</div>'


@html.register
def _(given: Given, page: Follower) -> str:
    return _line(_equation(given, page))


@html.register
def _(line: Line, page: Follower) -> str:
    formula = line.formula
    if not formula.has_value:
        text = once(formula) if formula.again else ""
        return _line(_equation(formula, page), text, formula, known=page.numbers or ())
    return _valued(line, page.value(line), page.put_in(line), page)


def _valued(line: Line, follows: str, put_in: str, page: Follower) -> str:
    """A line with its value, and room for its formula with numbers."""
    text = page.about_nothing(line) or value(line)
    equals = "" if text.startswith("≈") else "="
    shown = f'<span class="ms-equals">{equals}</span><span class="ms-value"{follows}>{text}</span>'
    numbers = f'<span class="ms-numbers"{put_in}></span>' if put_in else ""
    return _line(_equation(line.formula, page), shown, line.formula, numbers, page.numbers or ())


def _equation(line: Formula | Given, page: Follower) -> str:
    """A line as an equation in MathML."""
    return mathml(equation(line, page.numbers.single(fields_by_name(line)) if page.numbers else frozenset()))


def moving(part: Any, page: Follower, **moved: Any) -> str:
    """A part with the place of what a control moves in it: of a line its value."""
    if isinstance(part, Line) and not part.formula.has_value:
        return html(part, page)
    if isinstance(part, Line) and page.along(part):
        return _valued(part, page.value(part, **moved), page.put_in(part, **moved), page)
    place = page.mark("moved", **moved)
    if isinstance(part, Line):
        return _valued(part, place, page.put_in(part), page)
    page.pictures[len(page.specs) - 1] = still(part)
    return f"<div{place}></div>"


def still(part: Any) -> str:
    """HTML of a part that follows no input."""
    bare = Follower(Recording(Graph(), {}))
    text = html(part, bare)
    return _MARK.sub(lambda mark: f">{bare.pictures[int(mark[1])]}" if int(mark[1]) in bare.pictures else mark[2], text)


def value(line: Line) -> str:
    """Value of a line in its display unit; nothing of a line that has none of its own."""
    if not line.formula.has_value:
        return ""
    unit = line.formula.unit
    return numbers.value(line.value, unit, offered.notation(unit)) + where(line.value, line.over)


def _line(
    formula: str, value: str = "", told: Formula | None = None, put_in: str = "", known: Container[str] = ()
) -> str:
    """A typeset line, the printed formula's number at its end; the index leads to it by its name."""
    if not told:
        return f'<div class="ms-line"><span class="ms-formula">{formula}</span></div>'
    mistake = f' <span class="ms-badge ms-FAIL">mistake</span> {escape(told.mistake)}' if told.mistake else ""
    said = f"<span>{meant(told.meaning, known)}{mistake}</span>" if told.meaning or mistake else ""
    said += f'<span class="ms-number">{printed(told.number)}</span>' if told.number else ""
    shown = f'<span class="ms-formula">{formula}{value}</span>{said}{put_in}'
    place = "" if told.again else f' id="line-{told.name}"'
    return f'<div class="ms-line"{place}>{shown}</div>'


@html.register
def _(table: Table, page: Follower) -> str:
    named = f'role="group" aria-labelledby="{_place("Table", table.number)}"'
    parts = "".join(_block(columns, page.columns(table, columns), named) for columns in blocks(table))
    note = ""
    if table.note:
        told = page.words(f"table {table.number} note", table.note, lambda text: page.in_words(text, table.said))
        note = f'<div class="ms-note">{told}</div>'
    return f'<div class="ms-table">{_caption("Table", table.number, table.title, page)}{parts}{note}</div>'


def _block(whole: Sequence[Column], follows: str, told: str) -> str:
    columns, left_out = shortened(whole)
    kinds = ["" if c.unit else ' class="ms-text"' for c in columns]
    heads = "".join(
        f'<th{kind} scope="col" title="{escape(symbol.prose(c.meaning))}">{named(c.name)}</th>'
        for c, kind in zip(columns, kinds, strict=True)
    )
    under = "".join(f"<th>{offered.head(c.unit) if c.unit else ''}</th>" for c in columns)
    rows = "".join(
        "<tr>" + "".join(f"<td{kind}>{t}</td>" for t, kind in zip(row, kinds, strict=True)) + "</tr>"
        for row in zip(*(map(as_written if c.names else escape, c.texts(numbers.AXIS)) for c in columns), strict=True)
    )
    head = f'<tr>{heads}</tr><tr class="ms-units">{under}</tr>'
    fit = fitting(whole)
    style = f' style="--fit:{numbers.fixed(fit, 2)}"' if fit < 1 else ""
    made = f"<table{follows}{style}><thead>{head}</thead><tbody>{rows}</tbody>{foot(left_out, len(columns))}</table>"
    return f'<div class="ms-wide" tabindex="0" {told}>{beside(columns, made)}</div>'


@html.register
def _(figure: Figure, page: Follower) -> str:
    columns = page.figure(figure)
    named = f' role="img" aria-labelledby="{_place("Figure", figure.number)}"'
    every = page.argument(f"figure {figure.number} every", figure.every)
    follows = named + page.mark("chart", columns=columns, marks=page.marks(figure), every=every)
    caption = _caption("Figure", figure.number, figure.title, page)
    known = all(column["key"] is not None or column["fixed"] for column in columns)
    shown = f"<div{follows}></div>" if known else page.picture(follows, _READINGS.sub("", _chart(figure)))
    return f'<figure class="ms-figure">{shown}{caption}</figure>'


def _chart(whole: Figure) -> str:
    figure = thinned(whole)
    return chart_svg.svg(chart.line_chart(figure.x, figure.lines, figure.marks, figure.every))


@html.register
def _(value: Caption, page: Follower) -> str:
    return _titled("Figure", value.number, page.text(value, escape))


def _caption(what: str, number: str, title: str, page: Follower) -> str:
    return _titled(what, number, page.words(f"{what.lower()} {number} title", title))


def _titled(what: str, number: str, words: str) -> str:
    return f'<div class="ms-caption" id="{_place(what, number)}"><b>{what} {escape(number)}</b> – {words}</div>'


def _place(what: str, number: str) -> str:
    """Id of a caption."""
    return escape(f"{what.lower()}-{number}")


@html.register
def _(drawing: Drawing, page: Follower) -> str:
    follows = page.drawing(drawing)
    shown = f"<div{follows}></div>" if follows else page.own(drawing_svg.svg(drawing))
    return f'<div role="img" aria-label="drawing">{shown}</div>'


@html.register
def _(value: SideBySide, page: Follower) -> str:
    columns = ("".join(html(each, page) for each in column) for column in value.columns)
    row = f' data-row="{value.row}"' if value.row else ""
    return f'<div class="ms-beside"{row}>{"".join(f"<div>{each}</div>" for each in columns)}</div>'


@html.register
def _(value: str, page: Follower) -> str:
    return f'<div class="ms-between">{page.text(value, markdown.html)}</div>'


@html.register
def _(value: Mark, page: Follower) -> str:
    return ""


@html.register
def _(control: Control, page: Follower) -> str:
    label = control.label if control.unit == "-" else f"{control.label} [{units.shown(control.unit)}]"
    step = control.step or (control.stop - control.start) / 100
    made = (
        f'<div class="ms-player"><label>{escape(label)} <input type="range" data-control="{escape(control.name)}" '
        f'min="{control.start}" max="{control.stop}" step="{step}" value="{control.value}"></label>'
        f"<output>{numbers.significant(control.value, 6)}</output>"
        f'<button type="button" class="ms-play" aria-label="play"{" data-turning" * control.turning}>▶</button></div>'
    )
    return page.while_same(control.name, made)


@html.register
def _(check: Check, page: Follower) -> str:
    kind, verdict = ("PASS" if check.passed else "FAIL",) * 2 if check.evaluated else ("OPEN", "not evaluated")
    told = f": {compared(check, check.unit)}" if check.evaluated else ""
    return (
        f'<div class="ms-check" id="{_anchor(check)}"{page.check(check)}>'
        f'<span class="ms-badge ms-{kind}">{verdict}</span> '
        f'{page.check_name(check)}<span class="ms-compared" data-part="{float(check.utilisation)}">{told}</span> '
        f'<span class="ms-note">{message(check.reason)}</span></div>'
    )


def _anchor(check: Check) -> str:
    return "check-" + re.sub(r"\W+", "-", check.name)


@html.register
def _(summary: Summary, page: Follower) -> str:
    items = "".join(
        f'<span data-of="{_anchor(check)}"><span class="ms-badge"></span> '
        f'<a href="#{_anchor(check)}">{page.check_name(check)}</a> <span class="ms-note"></span></span>'
        for check in summary.checks
    )
    return f'<div class="ms-summary" role="status"><b></b><div class="ms-row">{items}</div></div>'


@html.register
def _(found: Verdict, page: Follower) -> str:
    lost = found.failures() and not np.all(found.waits)
    colour = "FAIL" if lost else "PASS" if np.any(found.solved) else "OPEN"
    lines = "".join(f"<div>{message(text)}</div>" for text in found.failures())
    rows = "".join(f"<tr><th>{escape(k)}</th><td>{page.in_words(v, found.names)}</td></tr>" for k, v in found.details())
    return (
        f'<div class="ms-found"{page.found(found)}><div>'
        f'<span class="ms-badge ms-{colour}">{found.word()}</span> '
        f"<b>{page.in_words(found.headline(), found.names)}</b></div>{lines}<table>{rows}</table></div>"
    )


@html.register
def _(made: Index, page: Follower) -> str:
    return index.written(made, anchor)


@html.register
def _(used: Used, page: Follower) -> str:
    rows, section = list[str](), ""
    known = {field.name for field, _ in used.rows()}
    for field, _ in used.rows():
        if field.section != section:
            section = field.section
            rows.append(f'<tr><th colspan="4">{escape(section)}</th></tr>')
        unit = "" if field.unit == "-" else escape(units.shown(field.unit))
        number = "" if isinstance(field, Rows) else escape(field.brief(getattr(used.g, field.name)))
        rows.append(
            f'<tr data-used="{field.name}"><td>{as_written(field.name)}</td><td>{number}</td>'
            f"<td>{unit}</td><td>{meant(field.meaning, known)} {tolerance(field)}</td></tr>"
        )
        rows += ['<tr><td colspan="4"></td></tr>'] if isinstance(field, Rows) else []  # for the page's own table
    return f'<table class="ms-print">{"".join(rows)}</table>'
