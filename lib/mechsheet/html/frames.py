"""What a slider moves, at each of its positions: the worksheet's own pictures, made small.

Pictures of one slider have most of their pieces in common: each is kept once, and of those that move the numbers alone.
"""

import json
import math
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from mechsheet.document.parts import Control, Line, by_cell
from mechsheet.html.follow import Follower
from mechsheet.html.values import still, value
from mechsheet.recording import showing
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.symbol import plain
from mechsheet.worksheet.title import Mark, Slider

_MOST, _MOST_PICTURES = 400, 51  # positions of a slider; where drawings are kept for each
# One that is written again as it was: not -0 or -0.0, nor with more digits than a whole number keeps.
_NUMBER = re.compile(r"(?<![\w.])(?!-0(?:\.0+)?(?![\d.]))-?(?:0|[1-9]\d{0,8})(?:\.\d{1,6})?(?![\w.])")
_PIECE = re.compile("<[^>]*>[^<]*|[^<]+")
_HOLE = "\x00"


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
    return [_moved(sheet, namespace, control, shown, page) for control in controls.values()]


def _moved(
    sheet: Worksheet,
    namespace: Mapping[str, Any],
    control: Control,
    shown: Mapping[int, Sequence[Any]],
    page: Follower,
) -> Moved:
    names, cells = {control.name}, set[int]()
    while more := {n for n, c in enumerate(sheet.cells) if n not in cells and c.needs & names and "g" not in c.gives}:
        cells |= more
        names |= {name for n in more for name in sheet.cells[n].gives}
    resting = {name: value for name, value in namespace.items() if name not in names}
    left = {(n, k): part for n in cells for k, part in enumerate(shown.get(n, ())) if not page.follows(part)}
    drawn = any(any(showing.drawings(part)) for part in left.values())
    want = sorted(names - {control.name})
    found = Moved(control, _positions(control, _MOST_PICTURES if drawn else _MOST))
    if not left:
        return found
    own = namespace[control.name]
    for x in found.positions:
        slider: Slider = replace(own, value=x)
        at = sheet.run(want, {**resting, control.name: slider})
        for n, parts in by_cell(at, cells).items():
            for k, part in enumerate(parts):
                if (n, k) not in left:
                    continue
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
    return still(part)


def _positions(control: Control, most: int) -> list[float]:
    """At most so many positions of a slider, of its own step or a multiple, its ends and the present one among them."""
    step = control.step or (control.stop - control.start) / 100
    count = math.floor((control.stop - control.start) / step + 1e-9)
    at = sorted({*range(0, count + 1, -(-count // (most - 1)) or 1), count})
    if any(isinstance(x, float) for x in (control.start, step)):
        places = [round(control.start + i * step, 12) for i in at]
    else:
        places = [control.start + i * step for i in at]  # whole numbers may be indices
    near = any(abs(x - control.value) <= 1e-9 * step for x in places)
    return places if near else sorted([*places, control.value])


def told(found: Moved, page: Follower) -> dict[str, Any]:
    """The pictures and marks of a control as JSON has them, pictures that are alike once, and what its end is."""
    pictures = [json.dumps(_pieces(each)) for each in found.pictures.values()]
    known = list(dict.fromkeys(pictures))
    return {
        "positions": list(found.positions),
        "pictures": [json.loads(each) for each in known],
        "which": [known.index(each) for each in pictures],
        "marks": {plain(name): places for name, places in found.marks.items()},
        "stop": page.argument(f"slider {found.control.name} stop"),
        "stepped": bool(found.control.step),
    }


def _pieces(pictures: Sequence[str]) -> dict[str, Any]:
    """Each picture as pieces that are kept once.

    A piece that only one picture has holds a hole, with the decimals, for each of its numbers, which stand beside.
    """
    split = [_PIECE.findall(picture) for picture in pictures]
    count = Counter(piece for each in split for piece in set(each))
    pieces, of, rows = dict[str, int](), list[list[int]](), list[list[int]]()
    for each in split:
        moving = "".join(piece for piece in each if count[piece] == 1)
        kept = (p if count[p] > 1 else _NUMBER.sub(lambda m: f"{_HOLE}{_decimals(m[0])}", p) for p in each)
        of.append([pieces.setdefault(piece, len(pieces)) for piece in kept])
        rows.append([int(match[0].replace(".", "")) for match in _NUMBER.finditer(moving)])
    return {"pieces": list(pieces), "of": of, "numbers": rows}


def _decimals(number: str) -> int:
    return len(number.partition(".")[2])
