"""What a slider moves, at each of its positions: the worksheet's own pictures, made small.

Pictures of neighbouring positions are alike but for their numbers: these are kept as differences beside one text.
"""

import base64
import json
import re
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from mechsheet.document.parts import Control, Line, by_cell
from mechsheet.html.follow import Follower
from mechsheet.html.values import html, value
from mechsheet.recording.graph import Graph
from mechsheet.recording.lines import Recording
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.title import Mark, Slider

_MOST = 51  # positions of a slider
# One that is written again as it was: not -0 or -0.0, nor with more digits than a whole number keeps.
_NUMBER = re.compile(r"(?<![\w.])(?!-0(?:\.0+)?(?![\d.]))-?(?:0|[1-9]\d{0,8})(?:\.\d{1,6})?(?![\w.])")
_HOLE = "\x00"
_NO_RECORDING = Recording(Graph(), {})
_MARK = re.compile(r' data-n="\d+"')


@dataclass
class Moved:
    """What a control moves: HTML of each of its ``positions`` by cell and part, and the positions that it marks."""

    control: Control
    positions: Sequence[float]
    pictures: dict[tuple[int, int], list[str]] = field(default_factory=dict)
    marks: dict[str, list[float]] = field(default_factory=dict)


def moved(
    sheet: Worksheet, namespace: Mapping[str, Any], shown: Mapping[int, Sequence[Any]], page: Follower
) -> list[Moved]:
    """What each control of a run moves: ``shown`` is what its cells show."""
    controls = {part.name: part for parts in shown.values() for part in parts if isinstance(part, Control)}
    return [_moved(sheet, namespace, control, page) for control in controls.values()]


def _moved(sheet: Worksheet, namespace: Mapping[str, Any], control: Control, page: Follower) -> Moved:
    names, cells = {control.name}, set[int]()
    while more := {n for n, c in enumerate(sheet.cells) if n not in cells and c.needs & names and "g" not in c.gives}:
        cells |= more
        names |= {name for n in more for name in sheet.cells[n].gives}
    still = {name: value for name, value in namespace.items() if name not in names}
    want, found = sorted(names - {control.name}), Moved(control, _positions(control))
    own = namespace[control.name]
    for x in found.positions:
        slider: Slider = replace(own, value=x)
        at = sheet.run(want, {**still, control.name: slider})
        for n, parts in by_cell(at, cells).items():
            for k, part in enumerate(parts):
                if isinstance(part, Mark):
                    for name, position in part.positions:
                        found.marks.setdefault(name, []).append(float(position))
                elif not isinstance(part, Control):
                    found.pictures.setdefault((n, k), []).append(_picture(part, page))
    count = len(found.positions)
    found.pictures = {at: each for at, each in found.pictures.items() if len(each) == count and len(set(each)) > 1}
    found.marks = {name: each for name, each in found.marks.items() if len(each) == count}
    return found


def _picture(part: Any, page: Follower) -> str:
    """What of a part a slider may change: of a line its value, or where along its field that stands."""
    if isinstance(part, Line):
        return str(part.position) if page.along(part) else value(part)
    return _MARK.sub("", html(part, Follower(_NO_RECORDING)))


def _positions(control: Control) -> list[float]:
    """At most so many positions of a slider, of its own step or a multiple, its ends and the present one among them."""
    step = control.step or (control.stop - control.start) / 100
    count = round((control.stop - control.start) / step)
    every = -(-count // (_MOST - 1))
    at = sorted({*range(0, count + 1, every), count, round((control.value - control.start) / step)})
    if any(isinstance(x, float) for x in (control.start, step)):
        return [round(control.start + i * step, 12) for i in at]
    return [control.start + i * step for i in at]  # whole numbers may be indices


def packed(found: Moved) -> str:
    """The pictures and marks of a control as base64 of compressed JSON."""
    pictures = [_differences(each) for each in found.pictures.values()]
    told = {"positions": list(found.positions), "pictures": pictures, "marks": found.marks}
    return base64.b64encode(zlib.compress(json.dumps(told, separators=(",", ":")).encode(), 9)).decode()


def _differences(pictures: Sequence[str]) -> dict[str, Any]:
    """Texts with a hole and the decimals for each number; each picture has its text, and how they changed."""
    texts, of, rows = dict[str, int](), list[int](), list[list[int]]()
    last = dict[int, list[int]]()
    for picture in pictures:
        numbers = list(_numbers(picture))
        text = _NUMBER.sub(lambda m: f"{_HOLE}{_decimals(m[0])}", picture)
        n = texts.setdefault(text, len(texts))
        before = last.get(n, [0] * len(numbers))
        of.append(n)
        rows.append([x - y for x, y in zip(numbers, before, strict=True)])
        last[n] = numbers
    return {"texts": list(texts), "of": of, "numbers": rows}


def _numbers(picture: str) -> Iterator[int]:
    """The numbers in a picture without their decimal points."""
    for match in _NUMBER.finditer(picture):
        yield int(match[0].replace(".", ""))


def _decimals(number: str) -> int:
    return len(number.partition(".")[2])
