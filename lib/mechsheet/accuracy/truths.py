"""The documents' exact results: at 50 digits from their inputs, at any of their positions."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mechsheet.accuracy import exact, pump, sections
from mechsheet.accuracy.arithmetic import Numbers, mp, mpf
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.inputs import build


class Truth(NamedTuple):
    """Of a worksheet: its field of positions, the exact one at a part of the way, and the exact results at a position.

    ``compared`` are the results of its run that are: all, where none are named.
    """

    field: str
    at: Callable[[Any, mpf], mpf]
    results: Callable[[Any, Any], Numbers]
    compared: Sequence[str] = ()


def _length(g: Any, t: mpf) -> mpf:
    made = exact.stroke(g)
    return made["l20"] + made["H"] * t


TRUTHS: dict[str, Truth] = {
    "hitch": Truth("S", lambda g, t: g.S_min + (mpf(g.S_max) - g.S_min) * t, exact.hitch),
    "landing_gear": Truth("l2i", _length, exact.landing_gear, ("Ai", "omega3_l2i", "eps3_l2i", "F_c")),
    "slotted_link": Truth("phi1_k", lambda g, t: g.phi_0 + mp.sign(g.omega1) * 2 * mp.pi * t, exact.slotted_link),
    "kinetostatics": Truth("phi1", lambda _, t: 2 * mp.pi * t, pump.kinetostatics),
}


TURNS = ("phi", "psi", "alpha")  # angles, which the exact results may have in another turn
DOCUMENTS = (*TRUTHS, "joint")
_GIVEN = {"kinetostatics": {"step": 1}}  # its recording holds the positions that its tables list


@lru_cache(maxsize=len(DOCUMENTS))
def from_inputs(path: Path, _text: bytes) -> tuple[Worksheet, dict[str, Any], dict[str, dict[int, Any]]]:
    """A document, its run, and exact results of it by name and position, which no float has been before.

    They are those at three of its positions, of the joint those of all load cases. ``_text`` is that of the document.
    """
    sheet, stem = load(path), path.stem
    names = sheet.run(sheet.results, {"g": build(sheet.inputs, _GIVEN.get(stem, {}))})
    if stem == "joint":
        return sheet, names, {name: dict(enumerate(y)) for name, y in exact_results(stem, names, ()).items()}
    truth, g = TRUTHS[stem], names["g"]
    n = len(names[truth.field])
    at = {k: truth.results(g, truth.at(g, mpf(k) / (n - 1))) for k in (0, n // 3, n - 1)}
    shown = [name for name in at[0] if name in names and np.shape(names[name]) == (n,)]
    return sheet, names, {name: {k: made[name] for k, made in at.items()} for name in shown}


def exact_results(stem: str, names: Mapping[str, Any], rows: Iterable[int]) -> Numbers:
    """Results of a worksheet at 50 digits at some of its positions, by name; of the joint, which has none, all."""
    if stem == "joint":
        return sections.joint_document(names["g"])
    truth = TRUTHS[stem]
    at = [truth.results(names["g"], float(names[truth.field][i])) for i in rows]
    return {name: [p[name] for p in at] for name in truth.compared or at[0].keys() & names.keys()}
