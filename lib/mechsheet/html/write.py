"""The file of a document: one page with its style, its font, its script and what it computes."""

import ast
import base64
import hashlib
import json
import re
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from html import escape, unescape
from inspect import cleandoc
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import parts
from mechsheet.document.mathml import symbol
from mechsheet.document.parts import Line, Section, by_cell
from mechsheet.html import fields, font, frames, javascript, values
from mechsheet.html.follow import Follower
from mechsheet.html.frames import Moved
from mechsheet.recording.dimensions import dimensions
from mechsheet.recording.memory import names_of
from mechsheet.recording.record import continued, record
from mechsheet.worksheet import symbol as symbols
from mechsheet.worksheet.cells import Cell, Worksheet
from mechsheet.worksheet.check import LITTLE, Check, Summary, checks_of, refuse_open
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.force_diagram import polar_diagrams
from mechsheet.worksheet.inputs import Used, declared
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.no_inputs import NoInputs, beforehand, inputs_of
from mechsheet.worksheet.source import constant, standing
from mechsheet.worksheet.title import SideBySide, Title
from mechsheet.worksheet.typeset import Numbers

_SCRIPTS = (
    "format.js",
    "chart.js",
    "drawing.js",
    "looks.js",
    "given.js",
    "fields.js",
    "found.js",
    "put_in.js",
    "page.js",
    "rows.js",
    "grid.js",
    "view.js",
    "units.js",
    "moved.js",
    "tooltip.js",
    "symbols.js",
    "tip.js",
    "start.js",
)
# Calls whose texts a page shows.
_SHOWING = {"md", "title_block", "table", "figure", "caption", "typeset", "side_by_side"}
_CHOICES = (
    *(ast.IfExp, ast.BoolOp, ast.Subscript, ast.Dict, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp),
    *(ast.If, ast.For, ast.While, ast.Match, ast.Try, ast.FunctionDef, ast.Lambda),
)
_STUDIES = ("mechsheet.accuracy.", "mechsheet.studies.")
_MADE = "what it shows is made by code that is not recorded"
_MOST = 700_000  # bytes of a page; one that is larger has its lists at their own length
# The page asks for nothing: what it shows and runs stands in it.
_POLICY = (
    "default-src 'none'; script-src {}; style-src 'unsafe-inline'; font-src data:; base-uri 'none'; form-action 'none'"
)


def page(sheet: Worksheet, g: Any) -> str:
    """Text of an HTML file with everything that a worksheet shows for these inputs, in the order of its file.

    What the recording of the run holds follows the inputs of the page; anything else is there while these are the
    run's own.

    Raises SheetError where an essential check fails, and for a worksheet of `studies`.
    """
    if name := studies(sheet):
        raise SheetError(f"{Path(sheet.path).stem} computes by {name}, over many runs: a page cannot follow that")
    namespace = sheet.run(sheet.results, beforehand(g))
    refuse_open(checks_of(namespace))
    parts.values(namespace)  # which tells of what goes by one name
    if any(isinstance(field, Rows) for field in declared(type(inputs_of(namespace)))):
        with suppress(SheetError):  # how many values are found is not known before the list is
            text = _page(sheet, namespace, lists=True)
            if len(text.encode()) < _MOST:
                return text
    return _page(sheet, namespace, lists=False)


@np.errstate(all="ignore")  # of ways that the worksheet does not go, as while it is recorded
def _page(sheet: Worksheet, namespace: dict[str, Any], lists: bool) -> str:
    """The file of a run; what rests on ``lists`` among the inputs follows them at any length, or at their own."""
    cells = _with_checks(_with_fields(by_cell(namespace), sheet, inputs_of(namespace)))
    shown = [part for each in cells.values() for part in each]
    recording = record(namespace, sheet, whole=True, every=1, draws=True, lists=lists)
    fit = dimensions(recording, sheet, namespace, registry(namespace)).check()  # before the page computes with it
    follower = Follower(recording, Numbers(namespace))
    follower.pair(cells)
    moving = frames.moved(sheet, namespace, cells, follower)
    among = tuple(cleandoc(constant(text)) for cell in sheet.cells for text in standing(cell.lines))
    meant = tuple(line.meaning for line in registry(namespace).values())
    written = (
        _cell(n, parts, sheet.cells[n], among + meant * _polar(sheet.cells[n]), follower, moving)
        for n, parts in cells.items()
    )
    with continued(follower.recording):
        body = _linked("".join(written))
    if not any(isinstance(part, Title) for part in shown):
        body = _BAR + body
    if fit.residual:
        wrong = f'<p><span class="ms-badge ms-FAIL">mistake</span> {escape(fit.reason)}</p>'
        body = body.replace(_BAR, _BAR + wrong, 1)
    told = {
        "name": Path(sheet.path).stem,
        "inputs": fields.told(inputs_of(namespace)),
        "shown": follower.specs,
        "little": LITTLE,
        "symbols": _symbols(namespace, shown),
        "pictures": follower.pictures,
        "units": follower.units,
        "positions": follower.positions(),
        "moved": {each.control.name: frames.told(each, follower) for each in moving},
    }
    data = json.dumps(told, ensure_ascii=False, separators=(",", ":")).encode()
    packed = base64.b64encode(zlib.compress(data, 9)).decode()
    computed = javascript.module(follower.recording, follower.wanted)
    own = javascript.runtime(*_SCRIPTS)
    script = f'"use strict";\n(async () => {{\n{computed}\n{own}}})();'
    style = javascript.runtime("formulas.css", "page.css")
    address = font.address(_signs(body + json.dumps(follower.specs, ensure_ascii=False)))
    face = f'@font-face{{font-family:"STIX Two Math";src:url({address})format("woff")}}'
    policy = _POLICY.format(f"'sha256-{_digest(script)}'")
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta name="color-scheme" content="light dark">\n<title>{escape(sheet.title)}</title>\n'
        f"<style>{face}\n{style}</style>\n</head>\n<body>\n{_contents(shown)}<main>{body}</main>\n"
        f'<script type="application/octet-stream" id="told">{packed}</script>\n'
        f"<script>{script}</script>\n</body>\n</html>\n"
    )


def _with_fields(cells: dict[int, list[Any]], sheet: Worksheet, g: Any) -> dict[int, list[Any]]:
    """What the cells show, with the inputs; where none shows those, at the cell that gives them."""
    if isinstance(g, NoInputs) or any(isinstance(part, Used) for each in cells.values() for part in each):
        return cells
    at = next((n for n, cell in enumerate(sheet.cells) if "g" in cell.gives), 0)
    return dict(sorted({**cells, at: [*cells.get(at, ()), Used(g)]}.items()))


def _with_checks(cells: dict[int, list[Any]]) -> dict[int, list[Any]]:
    """What the cells show; behind a summary the checks that none of them does: it takes their verdicts from there."""
    shown = {check.name for each in cells.values() for check in _checks(each)}
    found = dict[int, list[Any]]()
    for n, each in cells.items():
        found[n] = []
        for part in each:
            more = [c for c in part.checks if c.name not in shown] if isinstance(part, Summary) else []
            shown.update(check.name for check in more)
            found[n] += [part, *more]
    return found


def _checks(parts: Iterable[Any]) -> Iterator[Check]:
    for part in parts:
        if isinstance(part, Check):
            yield part
        elif isinstance(part, SideBySide):
            yield from _checks(each for column in part.columns for each in column)


def studies(sheet: Worksheet) -> str:
    """What a worksheet searches or measures with, over many runs of another one or of a method; "" otherwise."""
    waiting, read = [cell.code for cell in sheet.cells], set[str]()
    for code in waiting:
        for name in set(names_of(code)).difference(read):
            read.add(name)
            value = sheet.common.get(name)
            if f"{getattr(value, '__module__', '')}.".startswith(_STUDIES):
                return name
            if isinstance(value, FunctionType) and not value.__module__.startswith("mechsheet."):
                waiting.append(value.__code__)
    return ""


def _cell(
    n: int, parts: Iterable[Any], cell: Cell, among: Iterable[str], follower: Follower, moving: Iterable[Moved]
) -> str:
    """HTML of what a cell shows: texts of its own, and those ``among`` lines, which another cell may show."""
    follower.texts = (*(text for line in cell.lines for text in _as_written(line)), *among)
    follower.headings = frozenset(title for line in cell.lines for title in _headings(line))
    follower.why = follower.recording.unsaid.get(n) or f"line {cell.lines[-1].lineno}: {_MADE}" if cell.needs else None
    return "".join(_part((n, k), part, follower, moving) for k, part in enumerate(parts))


def _linked(body: str) -> str:
    """HTML in which each place is named once, and a link to what is not there, but in a workbook alone, is a text."""
    places = set[str]()

    def first(place: "re.Match[str]") -> str:
        known = place[1] in places
        places.add(place[1])
        return "" if known else place[0]

    body = re.sub(' id="([^"]*)"', first, body)
    return re.sub('<a href="#([^"]*)"[^>]*>(.*?)</a>', lambda link: link[0 if link[1] in places else 2], body)


def _polar(cell: Cell) -> bool:
    """Whether a cell shows what lines mean, below the diagrams of their forces."""
    nodes = (node for line in cell.lines for node in ast.walk(line))
    return any(isinstance(node, ast.Name) and node.id == polar_diagrams.__name__ for node in nodes)


def _as_written(node: ast.AST) -> Iterator[str]:
    """Texts that stand in a cell as they are shown, whatever the inputs are."""
    if isinstance(node, _CHOICES):
        return
    match node:
        case ast.Call(ast.Name(name) | ast.Attribute(attr=name), args, keywords) if name in _SHOWING:
            given = (*args, *(keyword.value for keyword in keywords))
            values = (v for each in given for v in (each.elts if isinstance(each, ast.Tuple) else [each]))
            yield from (cleandoc(v.value) for v in values if isinstance(v, ast.Constant) and isinstance(v.value, str))
    for part in ast.iter_child_nodes(node):
        yield from _as_written(part)


def _headings(line: ast.stmt) -> Iterator[str]:
    """Headings that stand in texts with numbers, in lines that have none."""
    for text in (node for node in ast.walk(line) if isinstance(node, ast.JoinedStr)):
        pieces = (p.value if isinstance(p, ast.Constant) else "{}" for p in text.values)
        lines = (each.strip() for each in "".join(map(str, pieces)).splitlines())
        yield from (each.lstrip("#").strip() for each in lines if each.startswith("#") and "{}" not in each)


def _part(at: tuple[int, int], part: Any, follower: Follower, moving: Iterable[Moved]) -> str:
    """HTML of a part of the document; of one that a slider moves with the place of its picture."""
    for each in moving:
        if at in each.pictures:
            control, picture = each.control.name, [*each.pictures].index(at)
            return values.moving(part, follower, control=control, picture=picture)
    match part:
        case Title():
            return values.html(part, follower) + _BAR
        case Used(g):
            return fields.fields(g) + values.html(part, follower)
    return values.html(part, follower)


_BAR = (
    '<div class="ms-bar" role="status"><span class="ms-state"></span>'
    '<button type="button" class="ms-back" hidden>back to the document</button>'
    '<button type="button" class="ms-save">save the inputs</button></div>'
)


def _contents(shown: Iterable[Any]) -> str:
    """Links to the sections."""
    links = "".join(
        f'<li class="ms-level-{part.level}">'
        f'<a href="#{values.anchor(part.title)}">{escape(_plain(part.title))}</a></li>'
        for part in shown
        if isinstance(part, Section)
    )
    return f'<nav aria-label="sections"><details open><summary>Sections</summary><ol>{links}</ol></details></nav>'


def _plain(title: str) -> str:
    return re.sub(r"[$\\{}]", "", title)


def _signs(body: str) -> set[str]:
    """What stands in formulas, values, drawings and charts: more than the font has is left out of it."""
    return set(unescape(re.sub("<[^>]*>", "", body)))


def _symbols(namespace: Mapping[str, Any], shown: Iterable[Any]) -> dict[str, dict[str, str]]:
    """What a symbol means, by its MathML: an input, or a line that is shown."""
    found = dict[str, dict[str, str]]()
    for field in declared(type(inputs_of(namespace))):
        found[symbol(symbols.read(field.name))] = {
            "meaning": symbols.prose(field.meaning),
            "unit": "" if field.unit == "-" else units.shown(field.unit),
            "to": f"input-{field.name}",
        }
    lines = {part.formula.name for part in shown if isinstance(part, Line)}
    for name, line in registry(namespace).items():
        if name in lines:
            read = symbol(symbols.read(symbols.stem(name)))
            found.setdefault(read, {"meaning": symbols.prose(line.meaning), "unit": "", "to": f"line-{name}"})
    return found


def _digest(script: str) -> str:
    return base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
