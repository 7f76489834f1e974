"""What a worksheet shows at a glance, from one run with its own inputs: ``python -m mechsheet.run.glance WORKSHEET``.

One that searches or measures, for minutes, is run only with ``--asked`` behind it, else it ends with `LONG`. A run is
kept in the user's cache with its time and a digest of what it was computed from, so that whoever reads it later knows
whether it still holds.
"""

import hashlib
import json
import os
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from threading import Thread
from typing import Any

from mechsheet.document import chart, chart_svg, drawing_svg, parts
from mechsheet.document.shortened import thinned
from mechsheet.run import studied
from mechsheet.run.ending import watch
from mechsheet.run.report import write
from mechsheet.worksheet import inputs, mistakes
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Check, Summary
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.no_inputs import beforehand
from mechsheet.worksheet.numbers import on_page
from mechsheet.worksheet.table import Figure

_PACKAGE = Path(__file__).parents[1]
LONG = 3  # exit code: it was not run, as nobody asked for it
_BACKGROUND = 10  # how much it gives way to other programs, of 19


@dataclass(frozen=True)
class Glance:
    """The verdict of a run in a word and in a line, its first drawing or chart as SVG, when it was, and of what."""

    kind: str  # PASS, FAIL or OPEN, where there is nothing to judge
    told: str
    picture: str
    when: str
    digest: str


def kept(worksheet: Path) -> Glance | None:
    """The last run of a worksheet; none where it was not run yet."""
    place = _place(worksheet)
    return Glance(**json.loads(place.read_text(encoding="utf-8"))) if place.exists() else None


def digest(worksheet: Path) -> str:
    """Of a worksheet, of the files beside it that it names, and of the package: another one once any has changed."""
    text = worksheet.read_bytes()
    named = (path for path in sorted(worksheet.parent.iterdir()) if path.is_file() and path.name.encode() in text)
    return hashlib.sha256(b"".join([text, *(path.read_bytes() for path in named), _package()])).hexdigest()


def _package() -> bytes:
    files = [(path, path.stat()) for path in sorted(_PACKAGE.rglob("*.py"))]
    return repr([(str(path), file.st_mtime_ns, file.st_size) for path, file in files]).encode()


def _place(worksheet: Path) -> Path:
    folder = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return folder / "mechsheet" / f"{hashlib.sha256(str(worksheet).encode()).hexdigest()}.json"


def computed(worksheet: Path) -> Glance:
    """A run of a worksheet, at a glance."""
    of, when = digest(worksheet), time.strftime("%Y-%m-%d %H:%M")
    try:
        sheet = load(worksheet)
        g: Any = inputs.build(sheet.inputs, {})
        shown = parts.values(sheet.run(sheet.results, beforehand(g)))
        drawings = [value for value in shown if isinstance(value, Drawing)]
        fullest = max((len(drawing.elements) for drawing in drawings), default=0)  # others are parts that they share
        drawings = [drawing for drawing in drawings if len(drawing.elements) > fullest / 2]
        drawn: list[Drawing | Figure] = [*drawings, *(value for value in shown if isinstance(value, Figure))]
        return Glance(*_verdict(shown), "".join(map(_picture, drawn[:1])), when, of)
    except Exception as error:
        told = str(error) if isinstance(error, SheetError) else mistakes.told(error, str(worksheet))
        return Glance("FAIL", on_page(f"it does not run: {told}"), "", when, of)


def _verdict(shown: list[Any]) -> tuple[str, str]:
    found = Summary(tuple(value for value in shown if isinstance(value, Check)))
    if not found.checks:
        return "OPEN", "it has no checks"
    worst = found.worst_first[0]
    failed = any(not check.passed and check.evaluated for check in found.checks)
    kind = "PASS" if worst.passed else "FAIL" if failed else "OPEN"
    return kind, found.count + ("" if worst.passed else f": {on_page(worst.name)}")


def _picture(value: Drawing | Figure) -> str:
    if isinstance(value, Drawing):
        return drawing_svg.svg(value)
    figure = thinned(value)
    return chart_svg.svg(chart.line_chart(figure.x, figure.lines, figure.marks, figure.every))


def _end_with_who_asked() -> None:
    """Wait for the end of standard input: whoever started the run has gone, and nobody reads what it gives."""
    sys.stdin.read()
    os._exit(1)


def main() -> None:
    Thread(target=_end_with_who_asked, daemon=True).start()
    worksheet = Path(sys.argv[1]).resolve()
    watch(str(worksheet))
    if "--asked" not in sys.argv and studied.searches(worksheet):
        sys.exit(LONG)
    if hasattr(os, "nice"):  # where there is none, it runs beside the pages as they do
        os.nice(_BACKGROUND)
    made = json.dumps(asdict(computed(worksheet)))
    write(made.encode(), _place(worksheet))


if __name__ == "__main__":
    main()
