"""What would it take, on the page: inputs within bounds, requirements and a goal, and the design that meets them.

``design.js`` shows the form, whose text comes in the field beside it, as the command ``design`` would be asked.
"""

import json
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any, NamedTuple, Protocol
from urllib.parse import quote

import marimo as mo

from mechsheet import units
from mechsheet.document.markup import message
from mechsheet.page.of_file import refusing_another
from mechsheet.page.script import element, script
from mechsheet.worksheet import mistakes, numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.no_inputs import declared_in, inputs_of

_PERIOD = 0.25  # s between two looks at the inputs, and at least between two steps that are shown
_SPREAD = 0.5  # of an input's value: bounds about it that stand there to be changed

Done = Callable[[float, str], object]  # called with the part that is behind and the time that is left, in words


class Answer(Protocol):
    """What a design is: its inputs, what is said of them, and the text of its scene."""

    @property
    def inputs(self) -> Sequence[str]: ...
    @property
    def told(self) -> Sequence[str]: ...
    @property
    def scene(self) -> str: ...


class Designing(NamedTuple):
    """What gives the printed units of the results by which one may ask, and what answers options of the command."""

    results: Callable[[], Mapping[str, str]]
    answer: Callable[[Sequence[str], Done], Answer]


class _Superseded(Exception):
    """Something else is asked for by now."""


class Design:
    """A form, and below it what was found, for as long as the inputs are those for which it was."""

    def __init__(self, designing: Designing, namespace: Mapping[str, Any], redraw: Callable[[], object]) -> None:
        self.designing, self.namespace, self.redraw = designing, namespace, redraw
        self.field = mo.ui.text_area(on_change=self.asked)
        self.number, self.told = 0, ""
        self.refuse_another: Callable[[], None] = lambda: None
        self.offer()

    def offer(self) -> None:
        """Offer the results that there are now."""
        self.results = self.designing.results()

    @property
    def text(self) -> str:
        """HTML of all of it; of a worksheet without inputs there is nothing to ask for."""
        if not declared_in(self.namespace):
            return ""
        inputs = list(_offered(inputs_of(self.namespace)))
        results = [{"name": name, "unit": unit} for name, unit in self.results.items()]
        form = element("ms-design", inputs=inputs, results=results)
        told = f'<div class="ms-designed" role="status">{self.told}</div>'
        return f'<div class="ms-screen">{script("design.js")}{form}<div hidden>{self.field.text}</div>{told}</div>'

    def asked(self, text: str) -> None:
        """Look for the design of some options, as JSON with a number of its own: the page goes on meanwhile."""
        options = json.loads(text)["options"]
        self.number += 1
        self.refuse_another = refusing_another(self.namespace)
        mo.Thread(target=self.look, args=(self.number, options), daemon=True).start()

    def look(self, number: int, options: Sequence[str]) -> None:
        """Show what is found until it is asked for something else, or the inputs or the file are others."""
        this, (g, written), shown = mo.current_thread(), self.rests_on(), 0.0

        def over() -> bool:
            return this.should_exit or self.number != number

        def show(text: str) -> None:
            self.told = text
            self.redraw()

        def done(part: float, left: str) -> None:
            nonlocal shown
            if over():
                raise _Superseded
            if time.monotonic() - shown > _PERIOD:
                shown = time.monotonic()
                show(f'<progress value="{numbers.fixed(part, 2)}"></progress> {escape(left)}')

        try:
            done(0.0, "")
            told = self.answer(options, done)
        except _Superseded:
            return
        while not over():
            now, last_written = self.rests_on()
            if now is not g or last_written != written:
                show('<div class="ms-note">The inputs are others by now.</div>')
                return
            if told:
                show(told)
                told = ""
            time.sleep(_PERIOD)

    def rests_on(self) -> tuple[object, int]:
        """What tells that a design is that of other numbers: the inputs, none while they change, and their file."""
        return self.namespace.get("g"), Path(self.namespace["__file__"]).stat().st_mtime_ns

    def answer(self, options: Sequence[str], done: Done) -> str:
        """HTML of what it would take, or why it cannot be had."""
        try:
            self.refuse_another()
            found = self.designing.answer(options, done)
        except _Superseded:
            raise
        except Exception as error:  # of the library or of the worksheet's own lines: the page goes on without
            why = str(error) if isinstance(error, SheetError) else mistakes.told(error, self.namespace["__file__"])
            return f'<div class="ms-note"><span class="ms-badge ms-FAIL">not found</span> {message(why)}</div>'
        name = f"{Path(self.namespace['__file__']).stem}_designed.toml"
        address = f"data:text/plain;charset=utf-8,{quote(found.scene)}"
        link = f'<a download="{escape(name)}" href="{address}">Scene of the design</a>'
        return f"{_lines('b', found.inputs)}{_lines('span', found.told)}{link}"


def _lines(kind: str, lines: Iterable[str]) -> str:
    return "".join(f'<div class="ms-note"><{kind}>{message(line)}</{kind}></div>' for line in lines)


def _offered(g: Any) -> Iterable[dict[str, str]]:
    """The inputs that can be varied, with bounds about them that keep their limits."""
    for field, value in Used(g).rows():
        if field.continuous:
            low, high = sorted([value * (1 - _SPREAD), value * (1 + _SPREAD)])
            ends = _kept(field, low, high) if value else ("", "")
            unit = "" if field.unit == "-" else units.shown(field.unit)
            yield {"name": field.name, "meaning": field.meaning, "unit": unit, "low": ends[0], "high": ends[1]}


def _kept(field: Input, low: float, high: float) -> tuple[str, str]:
    """Bounds moved within the limits that are numbers."""
    for sign, limit in field.limits:
        try:
            end = float(limit)
        except ValueError:  # another input
            continue
        low, high = (max(low, end), high) if ">" in sign else (low, min(high, end))
    return numbers.significant(low, 6), numbers.significant(high, 6)
