"""What a page shows beyond the numbers when it is asked: the document's own, bands, what matters, a proof.

Nothing is computed before; then it follows whatever changes on the page.
"""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import replace
from functools import partial
from html import escape
from pathlib import Path
from typing import Any, NamedTuple, TypeVar
from uuid import uuid4

import marimo as mo
import numpy as np

from mechsheet import units
from mechsheet.document.blocks import blocks
from mechsheet.document.chart import line_chart
from mechsheet.document.markup import message
from mechsheet.document.shortened import rows, shortened
from mechsheet.page import notebook, own, values
from mechsheet.page.of_file import refusing_another
from mechsheet.page.script import element, script
from mechsheet.page.smooth import smooth
from mechsheet.readers.banded import NOTE, Banded, RunBands, about, off
from mechsheet.worksheet import mistakes, numbers
from mechsheet.worksheet.data_file import state
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.no_inputs import declared_in
from mechsheet.worksheet.table import Column, Figure, Table

T = TypeVar("T")
_PERIOD = 0.25  # s between two looks at the page
_LONG = 2.0  # s of a proof that shows how far it is
_NOISE = 1e-12  # of the largest band of a column: less is rounding
_AT = "least"  # position at which a result is looked at unless another is chosen


class Asked(NamedTuple):
    """What computes that which a page may be asked for.

    These are names of results, bands of tables, charts and all else, what a result depends on, the HTML of a proof,
    which tells how many of how many steps are behind, and the namespace of a run with the document's own inputs.
    """

    results: Callable[[], Iterable[str]]
    bands: Callable[[], tuple[RunBands, Sequence[Table], Sequence[Figure]]]
    matters: Callable[[str, str], Sequence[Any]]
    proof: Callable[[Callable[[int, int], object]], str]
    own: Callable[[], Mapping[str, Any]]


class Study:
    """Switches for own numbers, bands and proof, fields for a result and a position, and below what they ask for."""

    def __init__(self, asked: Asked, namespace: Mapping[str, Any], redraw: Callable[[], object]) -> None:
        self.asked, self.namespace, self.redraw = asked, namespace, redraw
        self.bands = mo.ui.checkbox(label="tolerances", on_change=self.changed)
        self.position = mo.ui.text(value=_AT, label="at position", on_change=self.changed)
        self.proof = mo.ui.checkbox(label="every number proved", on_change=self.changed)
        self.own = mo.ui.checkbox(label="what differs from the document", on_change=self.changed)
        self.told, self.looking, self.part = "", False, 0.0
        self.written: object = None
        self.refuse_another: Callable[[], None] = lambda: None
        self.chosen: str | None = None
        self.result = self.choice([*asked.results()])

    def offer(self) -> None:
        """Offer the results that there are now; the chosen one stays."""
        names = [*dict.fromkeys([*self.asked.results(), *filter(None, [self.chosen])])]
        if names != [*self.result.options]:
            self.result = self.choice(names)

    def choice(self, names: Sequence[str]) -> mo.ui.dropdown:
        """A field for one of some results."""
        label = "what matters for"
        return mo.ui.dropdown(names, self.chosen, allow_select_none=True, label=label, on_change=self.choose)

    def choose(self, name: str | None) -> None:
        """Ask for a result, or for none."""
        self.chosen = name
        self.changed(name)

    @property
    def text(self) -> str:
        """HTML of all of it; where there are no inputs a proof alone."""
        of_inputs = (self.bands, self.result, self.position, self.own) if declared_in(self.namespace) else ()
        switches = "".join(each.text for each in (*of_inputs, self.proof))
        scripts = script("bands.js") + script("own.js")
        return f'{scripts}<div class="ms-row ms-screen ms-study">{switches}</div><div>{self.told}</div>'

    def changed(self, _: object) -> None:
        """Follow the page from now on, as long as anything is asked for."""
        if not self.looking:
            self.looking, self.refuse_another = True, refusing_another(self.namespace)
            try:
                cells, _ = notebook.running()
                cells()
            except notebook.Unlike:  # then it is at rest as soon as its values are
                cells = tuple
            mo.Thread(target=self.look, args=(cells,), daemon=True).start()

    def look(self, cells: Callable[[], tuple[notebook.Cell, ...]]) -> None:
        """Compute what is asked for again whenever the page has come to rest with other values."""
        this, before, done = mo.current_thread(), list[Any](), list[Any]()
        try:
            while not this.should_exit and self.asks:
                now = self.state()
                if _same(now, before) and not _same(now, done) and not any(cell.busy for cell in cells()):
                    told = self.answer()
                    if _same(now, self.state()):  # else it is of numbers that are no longer there
                        self.told, done = told, now
                        self.redraw()
                before = now
                time.sleep(_PERIOD)
        finally:
            self.looking, self.told = False, ""
        if not this.should_exit:
            self.redraw()

    def behind(self, steps: int, count: int) -> None:
        """Note how far a proof is."""
        self.part = steps / count

    def wait(self, begun: float) -> None:
        """Show how far a proof is that takes long."""
        if time.monotonic() - begun > _LONG:
            self.told = f'<progress value="{numbers.fixed(self.part, 2)}"></progress> proof'
            self.redraw()

    @property
    def asks(self) -> bool:
        """Whether anything is asked for."""
        return bool(self.own.value or self.bands.value or self.chosen or self.proof.value)

    def state(self) -> list[Any]:
        """What an answer rests on; the same objects as long as that is the same."""
        asked = (self.own.value, self.bands.value, self.chosen, self.position.value, self.proof.value)
        written = state(Path(self.namespace["__file__"]))
        self.written = self.written if self.written == written else written
        return [*asked, self.written, *self.namespace.values()]

    def answer(self) -> str:
        """HTML of what is asked for, or why there is none."""
        parts = list[str]()
        try:
            self.refuse_another()
            if self.own.value:
                parts.append(own.html(_elsewhere(self.asked.own)))
            if self.proof.value:
                parts.append(_elsewhere(lambda: self.asked.proof(self.behind), partial(self.wait, time.monotonic())))
            if self.bands.value:
                bands, tables, figures = _elsewhere(self.asked.bands)
                within = escape(", ".join(map(str, bands.by.values())))
                parts.append(element("ms-bands", told=_told(bands, tables, figures), made=uuid4().hex))
                told = f"± and the bars in charts are the worst case within {within}. {escape(NOTE)}."
                parts.append(f'<div class="ms-note">{told}</div>')
            if self.chosen:
                of, at = self.chosen, self.position.value.strip() or _AT
                found = _elsewhere(lambda: self.asked.matters(of, at))
                parts += [f'<div class="ms-matters">{values.html(each)}</div>' for each in found]
        except Exception as error:  # of the library or of the worksheet's own lines: the page goes on without
            why = str(error) if isinstance(error, SheetError) else mistakes.told(error, self.namespace["__file__"])
            parts.append(f'<div class="ms-note"><span class="ms-badge ms-FAIL">not shown</span> {message(why)}</div>')
        return "".join(parts)


def _same(one: Sequence[Any], other: Sequence[Any]) -> bool:
    return len(one) == len(other) and all(x is y for x, y in zip(one, other, strict=True))


def _elsewhere(work: Callable[[], T], meanwhile: Callable[[], object] = lambda: None) -> T:
    """What some work gives in a thread of no page, where sliders that it makes are none that the page moves."""
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(work)
        while not wait([future], _PERIOD).done:
            meanwhile()
        return future.result()


def _told(bands: RunBands, tables: Sequence[Table], figures: Iterable[Figure]) -> dict[str, Any]:
    """Texts of all bands: of lines by their names, of checks by their places, of tables by blocks and columns.

    Of figures they are bars.
    """
    lines, columns = dict[str, list[Banded]](), dict[tuple[str, str], Banded]()
    for each in bands.banded:
        if each.where == "results":
            lines.setdefault(each.name.split(".")[0], []).append(each)
        columns[each.where, each.name] = each

    def cells(table: Table, name: str) -> list[str] | None:
        own = columns.get((f"table {table.number}", name))
        if own is None or own.band.why:
            return None
        worst = np.where(own.worst < _NOISE * own.most, 0.0, own.worst)
        return [numbers.on_page(about(x)) for x in worst[rows(len(worst))]]

    def shown(table: Table) -> list[tuple[Column, ...]]:
        return blocks(replace(table, columns=shortened(table.columns)[0]))

    return {
        "lines": {name: _of_line(parts) for name, parts in lines.items()},
        "tables": {t.number: [[cells(t, c.name) for c in block] for block in shown(t)] for t in tables},
        "checks": {values.anchor(name): sure for name, sure in bands.sure.items()},
        "figures": {figure.number: _bars(smooth(figure), bands) for figure in figures},
    }


def _bars(figure: Figure, bands: RunBands) -> list[tuple[str, list[list[float]]]]:
    """Of each curve whose points have bands its colour and the bars of these: x, y and half the length [px]."""
    found, chart = [], line_chart(figure.x, figure.lines, figure.marks, figure.every)
    _, up = chart.axes
    scale = chart.plot.height / (up.high - up.low)
    for line, curve in zip(figure.lines, chart.curves, strict=True):
        points = slice(None, None, figure.every)
        own = next((each for each in bands.banded if each.name == line.name and _is_of(each, line, points)), None)
        if own is not None and not own.band.why:
            half = own.band.worst.reshape(-1) / units.parse(line.unit).factor * scale
            bars = np.stack([curve.x[points], curve.y[points], half], axis=-1)
            found.append((curve.stroke.colour, np.round(bars[np.isfinite(bars).all(axis=1)], 2).tolist()))
    return found


def _is_of(banded: Banded, line: Column, points: slice) -> bool:
    """Whether bands are those of the points of a curve."""
    own, shown = banded.values.reshape(-1) * units.parse(banded.unit).factor, line.values[points]
    return own.shape == shown.shape and np.allclose(own, shown * units.parse(line.unit).factor, 1e-12, equal_nan=True)


def _of_line(parts: Sequence[Banded]) -> str:
    if why := next((part.band.why for part in parts if part.band.why), ""):
        return f"± not known: {why}"
    most = [off(part.most) for part in parts]
    if len(most) == 1 and (part := parts[0].name.split(".")[1:]):  # of a point whose other part keeps still
        most.insert(int(part == ["real"]), off(0.0))
    among = "up to " if parts[0].values.size > 1 else ""
    told = f"± {among}{most[0] if len(most) == 1 else '(' + ', '.join(most) + ')'}{numbers.suffix(parts[0].unit)}"
    return numbers.on_page(told)
