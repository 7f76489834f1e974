"""Errors in units of the condition number times a rounding: of random groups, and of the documents from end to end."""

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mechsheet.accuracy import arithmetic
from mechsheet.accuracy.arithmetic import EPS, Numbers, mpc, mpf
from mechsheet.accuracy.precision import times_of_one
from mechsheet.accuracy.truths import DOCUMENTS, TURNS, from_inputs
from mechsheet.mechanics.planar import cross
from mechsheet.mechanics.prp import prp
from mechsheet.mechanics.rpp import rpp
from mechsheet.mechanics.rpr import rpr
from mechsheet.mechanics.rrp import rrp
from mechsheet.mechanics.rrr import rrr
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.slopes import slopes
from mechsheet.recording.record import record
from mechsheet.run.progress import progress
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.terms import terms

_WITHIN = 64  # roundings times the condition number that an error may be
_QUANTILES = {"median": 0.5, "of 90 %": 0.9, "of 99 %": 0.99, "greatest": 1.0}


class Group(NamedTuple):
    """What a group is given; its position, and the exact one."""

    given: tuple[str, ...]
    found: Callable[..., Any]
    true: Callable[..., Any]

    def exactly(self, **parts: Any) -> Numbers:
        """The exact position C for real numbers: of a point or direction A its components A and Ay."""
        return {"C": self.true(*self.arguments(mpc, {name: mpf(part) for name, part in parts.items()}))}

    def arguments(self, complex_of: Callable[[Any, Any], Any], parts: Mapping[str, Any]) -> list[Any]:
        """What is given, from its components."""
        return [complex_of(parts[x], parts[f"{x}y"]) if f"{x}y" in parts else parts[x] for x in self.given]


GROUPS = {
    "RRR": Group(
        ("A", "B", "r_A", "r_B"),
        lambda A, B, r_A, r_B: rrr(A, B, r_A, r_B, 1),
        lambda A, B, r_A, r_B: arithmetic.rrr(A, B, r_A, r_B, 1),
    ),
    "RRP": Group(
        ("A", "B", "u", "r_A", "e"),
        lambda A, B, u, r, e: rrp(A, B, u, r, 1, e),
        lambda A, B, u, r, e: arithmetic.rrp(A, B, u, r, 1, e),
    ),
    "RPR": Group(("A", "B", "f"), lambda A, B, f: rpr(A, B, 1, f).u, lambda A, B, f: arithmetic.rpr(A, B, 1, f)[0]),
    "PRP": Group(("A", "B", "u", "w"), prp, arithmetic.lines),
    "RPP": Group(("A", "B", "w", "u"), rpp, arithmetic.lines),
}


def _drawn(count: int) -> dict[str, Any]:
    """Random pins A and B of links that meet, their lengths, directions u and w, offsets e from u and f from AC."""
    rng = np.random.default_rng(1)
    r_A, r_B = 10 ** rng.uniform(-0.5, 0.5, (2, count))
    C, w = rng.normal(size=(2, count)) + 1j * rng.normal(size=(2, count))
    a, u = np.exp(1j * rng.uniform(0, 2 * np.pi, (2, count)))
    A, B = C + r_A * a, C + r_B * a * np.exp(1j * rng.uniform(0.2, np.pi - 0.2, count))
    return {"A": A, "B": B, "r_A": r_A, "r_B": r_B, "u": u, "w": w, "e": cross(u, C - B), "f": cross(-a, A - B)}


def group_times(number: str, sizes: Sequence[int], seconds: float) -> Table:
    """Table of the time for one of n positions of each group computed at once, each of a geometry of its own."""

    def way(group: Group) -> Callable[[dict[str, Any]], Any]:
        return lambda x: group.found(*(x[name] for name in group.given))

    ways = {f"group {name}": way(group) for name, group in GROUPS.items()}
    return times_of_one(number, "Time of a group", sizes, _drawn, ways, seconds)


def _roundings(group: Group, x: Mapping[str, Any], found: Any) -> float:
    """The error of one position in roundings times its condition number; NaN where the group does not close."""

    parts = {name: float(np.real(x[name])) for name in group.given}
    parts |= {f"{name}y": float(np.imag(x[name])) for name in group.given if np.iscomplexobj(x[name])}
    exactly = group.exactly(**parts)["C"]
    if not arithmetic.exist(exactly):
        return np.nan
    condition = max(1.0, float(arithmetic.conditions(group.exactly, parts)["C"]))
    return arithmetic.relative_error(found, exactly) / (condition * EPS)


@lru_cache(maxsize=1)  # a cell runs again where it is recorded
def random_groups(number: str, count: int) -> tuple[Table, Check]:
    """Quantiles of the errors of so many random positions of each group, in roundings times their condition number."""
    given, errors = _drawn(count), dict[str, Any]()
    with progress(len(GROUPS) * count, f"{number} Random groups") as done:
        for name, group in GROUPS.items():
            found, each = group.found(*(given[key] for key in group.given)), list[float]()
            for k in range(count):
                each.append(_roundings(group, {key: x[k] for key, x in given.items()}, found[k]))
                done()
            errors[name] = np.array([error for error in each if not np.isnan(error)])
    columns = [
        Column("group", "", "", 0, np.array(list(errors), object)),
        Column("positions", "-", "random positions at which it closes", 0, np.array([len(e) for e in errors.values()])),
    ]
    for name, part in _QUANTILES.items():
        meaning = f"{name}, in roundings times the condition number"
        columns.append(
            Column(f"{name} error", "-", meaning, 2, np.array([np.quantile(e, part) for e in errors.values()]))
        )
    worst = max(float(e.max()) for e in errors.values())
    return Table(number, "Errors of random groups", tuple(columns)), Check(
        "errors of random groups, in roundings times their condition", worst, _WITHIN
    )


def end_to_end(number: str, folder: Path) -> tuple[tuple[Table, ...], Check]:
    """Condition numbers of all results of the five documents from their inputs on, and the digits that they keep.

    A table for each document, the worst conditioned result first. The slopes are those of its recording, through what
    is found; at a corner the steeper side counts.
    """
    first, rest = number.split(".")
    with progress(len(DOCUMENTS), f"{number} Conditions") as done:
        found = []
        for k, stem in enumerate(DOCUMENTS, int(rest)):
            path = folder / f"{stem}.py"
            found.append(_conditions(f"{first}.{k}", path, path.read_bytes()))
            done()
    worst = max(float(np.nanmax(errors)) for _, errors in found)
    name = "errors from end to end, in roundings times their condition"
    return tuple(table for table, _ in found), Check(name, worst, _WITHIN)


@lru_cache(maxsize=len(DOCUMENTS))
def _conditions(number: str, path: Path, text: bytes) -> tuple[Table, Any]:
    """The table of a document, and its errors in roundings times their condition; NaN where no exact result is known.

    The greatest change of a result over its greatest number, wherever these are.
    """
    sheet, names, truths = from_inputs(path, text)
    recording = record(names, sheet, whole=True, every=1)
    inputs = {name: node for name, node in recording.inputs.items() if node.value.dtype.kind == "f"}
    each = [name for name, node in inputs.items() for _ in range(node.size)]
    at = np.concatenate([np.abs(node.value).ravel() for node in inputs.values()])[:, None]
    lines = {name: line for name, line in registry(names).items() if not line.arguments}
    results = {name: value for name in lines if isinstance(value := recording.values.get(name), Quantity)}
    motion = slopes([part for value in results.values() for part in value.parts], [*inputs.values()])
    rows, lost = list[tuple[str, float, str, float]](), list[str]()
    for name, value in results.items():
        steepest = (np.max(np.abs(motion[part]), axis=0).reshape(len(at), -1) for part in value.parts)
        moves = at * np.sqrt(sum(side**2 for side in steepest))
        size, k = float(np.nanmax(np.abs(names[name]))), _greatest(moves.sum(0))
        kappa = float(moves[:, k].sum() / size) if size else np.nan
        if not kappa * EPS < 1 or numbers.is_rounding(names[name], terms(lines[name].expression, names)):
            lost.append(name)
            continue
        own, turn = np.ravel(names[name]), 2 * np.pi if name.startswith(TURNS) else None
        off = (arithmetic.error(own[k], true, turn) for k, true in truths.get(name, {}).items())
        error = float(max(off, default=mpf(np.nan))) / size
        rows.append((name, max(1.0, kappa), each[_greatest(moves[:, k])], error))
    rows.sort(key=lambda row: -round(np.log10(row[1]), 6))  # those alike as they stand in the document
    found, conditions, blamed, errors = (np.array(column) for column in zip(*rows, strict=True))
    errors = np.maximum(errors, EPS)
    columns = (
        Column("result", "", "", 0, found.astype(object), names=True),
        Column("log κ", "-", "logarithm of the condition number", 1, np.log10(conditions)),
        Column("expected digits", "-", "digits that the rounded inputs leave", 1, -np.log10(conditions * EPS)),
        Column("kept digits", "-", "digits that are right", 1, -np.log10(errors)),
        Column("most by", "", "the input whose rounding costs most", 0, blamed.astype(object), names=True),
    )
    note = f"No condition have {', '.join(lost)}: zero but for rounding, or with a jump." if lost else ""
    title = f"{path.stem.replace('_', ' ').capitalize()}, end to end"
    return Table(number, title, columns, note), errors / (conditions * EPS)


def _greatest(x: Any) -> int:
    """Which number is the greatest, of those that are but for rounding the first."""
    return int(np.argmax((x >= (1 - 1e-9) * np.max(x)) | np.isnan(x)))
