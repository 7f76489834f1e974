"""Tables that a setup makes in loops, by units and in place: a recording has the numbers that the worksheet has."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from by_cells import by_cells
from own_worksheet import written

from mechsheet.readers.numbers import numbers
from mechsheet.recording.dimensions import mismatches
from mechsheet.recording.record import record
from mechsheet.run.proving import proof_of
from mechsheet.worksheet import cells

IMPORTS = "import numpy as np\nfrom typing import Literal\nfrom mechsheet import ask, check, inputs, read\n"
IMPORTS += "from mechsheet.units import N, mm\n"
GIVEN = 'kind: Literal["A", "B", "C"] = "A"  # kind\nk: int = 0  # [-] place\nF: float = 2.0  # [N] force'
TABLE = 'T = {"A": 6 * mm, "B": 8 * mm, "C": 1 * mm}\n'
NAMED = [
    TABLE + 'for k in ("B", "C"):\n    T[k] *= 2',
    TABLE + 'T["B"] *= 2',
    TABLE + 'def scale(t):\n    for k in ("B", "C"):\n        t[k] *= 2\nscale(T)',
    TABLE + 'if T["A"] > 5 * mm:\n    T["B"] = 3 * mm',
    TABLE + 'T |= {"B": 2 * mm}\nT.update(C=3 * mm)',
    'T = {}\nfor k, d in zip("ABC", (6, 8, 1)):\n    T[k] = d * mm',
    "class Store:\n    pass\n" + TABLE + 'S = Store()\nS.t = T\nS.t["B"] = 5 * mm',
]
METHOD = "import math\nfrom dataclasses import dataclass\n@dataclass(frozen=True)\nclass Bar:\n    d: float\n"
METHOD += "    def length(self):\n        return self.d * math.sqrt(self.d / mm) if self.d > 2 * mm else self.d\n"
OF_CLASSES = [
    METHOD + 'B = {"A": Bar(1 * mm), "B": Bar(4 * mm), "C": Bar(9 * mm)}\nT = {k: b.length() for k, b in B.items()}',
    METHOD + 'T = {"A": 1 * mm, "B": Bar(4 * mm).length(), "C": Bar(9.0 * mm).length()}\nT["C"] *= 2',
]
PLACED = [
    "T = [6 * mm, 8 * mm, 1 * mm]\nT.sort()\nT.reverse()",
    "T = [6.0, 8.0, 1.0]\nT = [t * mm for t in T]",
    "T = []\nfor d in (6, 8, 1):\n    T.append(d * mm)",
    "T = np.array([6.0, 8.0, 1.0]) * mm\nT[1:] *= 2",
    "T = np.array([6.0, 8.0, 1.0]) * mm\nU = T\nU[1] *= 2",
    "c = iter((6, 8, 1))\nT = [next(c) * mm for _ in range(3)]",
]


def assert_followed(path: Path, setup: str, at: str) -> None:
    """The moment is that of the worksheet for each of three options or places, of the unit of its line."""
    lines = f'L = T[g.{at}]  # [mm] length\nM = L * g.F  # [N*mm] moment\ncheck_1 = check("moment", M, 9, "N*mm")'
    path.write_text(written(IMPORTS + setup, GIVEN, lines), encoding="utf-8")
    sheet = cells.load(path)
    recording = record({**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}, sheet)
    assert not recording.gaps and mismatches(path) == []
    M = recording.values["M"].re
    for place, kind in enumerate("ABC"):
        expected = by_cells(path, ["M"], kind=kind, k=place)["M"]
        found = numbers([M], {recording.inputs[name]: float(place) for name in ("kind", "k")})[M]
        np.testing.assert_allclose(found, expected, rtol=1e-12, err_msg=kind)


@pytest.mark.parametrize(("setup", "at"), [*((s, "kind") for s in [*NAMED, *OF_CLASSES]), *((s, "k") for s in PLACED)])
def test_what_a_setup_changes_in_place_is_changed_in_a_recording(setup: str, at: str, tmp_path: Path) -> None:
    """It was run again as far as it binds names to units alone, and had numbers from before the change, or of twice."""
    assert_followed(tmp_path / "own.py", setup, at)


def test_what_a_recording_makes_otherwise_stays_the_worksheets_own(tmp_path: Path) -> None:
    """Rows that a loop changes by its own name, an iterator that is used up: of no unit then, and of no wrong one."""
    for setup in (
        TABLE + 'rows = [T, {"A": 1 * mm}]\nfor row in rows:\n    row["B"] = 5 * mm',
        'rows = iter(zip("ABC", (6, 8, 1)))\nT = {k: d * mm for k, d in rows}',
    ):
        assert_followed(tmp_path / "own.py", setup, "kind")


def test_a_method_of_a_class_of_the_setup_is_followed(tmp_path: Path) -> None:
    """With Python's own functions and by cases, as a function of the setup is."""
    lines = 'L = Bar(g.F * mm / N).length()  # [mm] length\ncheck_1 = check("length", L, 9, "mm")'
    path = tmp_path / "own.py"
    path.write_text(written(IMPORTS + METHOD, GIVEN, lines), encoding="utf-8")
    sheet = cells.load(path)
    recording = record({**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}, sheet)
    assert not recording.gaps and mismatches(path) == []
    L = recording.values["L"].re
    for F in (1.0, 2.0, 4.0):
        found = numbers([L], {recording.inputs["F"]: F})[L]
        np.testing.assert_allclose(found, by_cells(path, ["L"], F=F)["L"], rtol=1e-12)


def test_what_a_setup_appends_is_proved(tmp_path: Path) -> None:
    """Of the setup that is run again for a proof statements without a name were left out, so it had two lengths."""
    path = tmp_path / "own.py"
    lines = 'M = T[2] * g.F  # [N*mm] moment\ncheck_1 = check("moment", M, 99, "N*mm")'
    path.write_text(written(IMPORTS + "T = [6 * mm, 8 * mm]\nT.append(9 * mm)", GIVEN, lines), encoding="utf-8")
    sheet = cells.load(path)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    assert proof_of(names, sheet, record(names, sheet, whole=True, exact=True)).check().passed
