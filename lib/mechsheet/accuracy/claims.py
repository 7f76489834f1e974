"""The digits that a proof claims beside those that there are, by exact results from the inputs to the end."""

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mechsheet.accuracy.arithmetic import error, mp, mpf
from mechsheet.accuracy.truths import DOCUMENTS, TURNS, from_inputs
from mechsheet.run.progress import progress
from mechsheet.run.proving import proof_of_wanted
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.numbers import fixed
from mechsheet.worksheet.table import Column, Table

_ROUNDED = 16.0  # digits of a float, which are all that count
_FEWER = 2.0  # digits less than there are that a proof should seldom claim


class Claim(NamedTuple):
    """One number: digits proved of it, and digits that agree with the exact one, both beside its column's largest."""

    worksheet: str
    name: str
    proved: float
    right: float

    @property
    def is_more(self) -> bool:
        return self.proved > self.right + 1e-6

    @property
    def is_fewer(self) -> bool:
        return self.proved < min(self.right, _ROUNDED) - _FEWER


def claims(path: Path) -> list[Claim]:
    """What is proved of the results of one of the five documents for which there are exact ones."""
    return [*_claims(path, path.read_bytes())]


@lru_cache(maxsize=len(DOCUMENTS))  # a cell runs again where it is recorded
def _claims(path: Path, text: bytes) -> list[Claim]:
    sheet, names, truths = from_inputs(path, text)
    plain = {name: truth for name, truth in truths.items() if not name.startswith(TURNS)}
    proof, made = proof_of_wanted(names, sheet, plain), list[Claim]()
    for name, truth in plain.items():
        columns = [column for column in proof.columns if (column.where, column.name) == ("results", name)]
        own = np.ravel(names[name])
        parts = ("real", "imag") if np.iscomplexobj(own) else ("real",)
        for part, column in zip(parts, columns, strict=True):
            size = mpf(float(np.nanmax(np.abs(getattr(own, part)))))
            for k, true in truth.items() if size else ():  # the real part of a weight is no number to prove
                off = error(float(getattr(own[k], part)), getattr(true, part)) / size
                made.append(Claim(path.stem, name, float(column.digits[k]), float(-mp.log10(off)) if off else np.inf))
    return made


def claims_table(number: str, folder: Path) -> tuple[Table, Check]:
    """A row for each of the five documents, and the check that no proof claims digits that there are not."""
    with progress(len(DOCUMENTS), f"{number} Proof") as done:
        rows = []
        for stem in DOCUMENTS:
            rows.append(claims(folder / f"{stem}.py"))
            done()
    more = [claim for row in rows for claim in row if claim.is_more]
    told = "; ".join(f"{c.worksheet} {c.name}: {fixed(c.proved, 1)} proved of {fixed(c.right, 1)}" for c in more[:3])
    fewer = np.array([100 * np.mean([claim.is_fewer for claim in row]) for row in rows])
    columns = (
        Column("worksheet", "", "", 0, np.array([stem.replace("_", " ") for stem in DOCUMENTS], object)),
        Column("compared", "-", "numbers of which there are exact ones", 0, np.array([len(row) for row in rows])),
        Column("proved", "-", "fewest digits proved", 1, np.array([min(c.proved for c in row) for row in rows])),
        Column("right", "-", "fewest digits that are right", 1, np.array([min(c.right for c in row) for row in rows])),
        Column("fewer", "%", "numbers with over two digits fewer proved than right", 1, fewer),
    )
    return Table(number, "Digits proved and digits that are right", columns), Check(
        "digits proved that there are not", len(more), 0, reason=told
    )
