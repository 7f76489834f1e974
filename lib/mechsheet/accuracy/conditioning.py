"""Condition numbers: of a function by its own differences, and of the documents' results from end to end."""

from collections.abc import Callable, Collection, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet.accuracy import arithmetic
from mechsheet.accuracy.arithmetic import EPS
from mechsheet.accuracy.truths import DOCUMENTS, TURNS, from_inputs
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.proof import prove
from mechsheet.readers.slopes import slopes
from mechsheet.recording.record import record
from mechsheet.run.progress import progress
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.terms import terms
from mechsheet.worksheet.ties import greatest

WITHIN = 64  # roundings times the condition number that an error may be
_AS_PRINTED = ("_printed", "_listing")  # forms of the documents that lose more, to which the worksheets' own compare
_DERIVED, _PROVED = "50 digits", "balls"  # what results are compared with
_STEP = 2.0**-30  # relative change of an input; what a result has lost makes no more of it than a ten millionth


def changes(f: Callable[[dict[str, Any]], Any], x: Mapping[str, Any]) -> tuple[Any, Any]:
    """f of numbers or arrays by name, and by how much it changes where each real number in them does so relatively.

    The changes of all are added up. An array counts as one input: f takes its elements each by itself.
    """
    here = np.asarray(f(dict(x)))
    total = np.zeros(here.shape)
    for name, value in x.items():
        for part in (np.real(value), 1j * np.imag(value)) if np.iscomplexobj(value) else (value,):
            if np.any(part):
                total += np.abs(np.asarray(f({**x, name: value + _STEP * part})) - here) / _STEP
    return here, total


def condition(f: Callable[[dict[str, Any]], Any], x: Mapping[str, Any]) -> float:
    """Condition number of f as a whole: the greatest of the `changes` over the greatest number."""
    here, total = changes(f, x)
    return float(np.max(total) / np.max(np.abs(here)))


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
    known, count = sum(_known(errors) for _, errors in found), sum(len(errors) for _, errors in found)
    name = f"errors from end to end of {known} of {count} results, in roundings times their condition"
    return tuple(table for table, _ in found), Check(name, worst, WITHIN)


def _known(errors: Any) -> int:
    return int(np.count_nonzero(np.isfinite(errors)))


@lru_cache(maxsize=len(DOCUMENTS))
def _conditions(number: str, path: Path, text: bytes) -> tuple[Table, Any]:
    """The table of a document, and the errors of its results in roundings times their condition; NaN where not known.

    Of forms as printed there are none, but rows. The greatest change of a result over its greatest number, wherever
    these are.
    """
    sheet, names, truths = from_inputs(path, text)
    recording = record(names, sheet, whole=True, every=1)
    inputs = {name: node for name, node in recording.inputs.items() if node.value.dtype.kind == "f"}
    each = [name for name, node in inputs.items() for _ in range(node.size)]
    at = np.concatenate([np.abs(node.value).ravel() for node in inputs.values()])[:, None]
    lines = {name: line for name, line in registry(names).items() if not line.arguments}
    results = {name: value for name in lines if isinstance(value := recording.values.get(name), Quantity)}
    motion = slopes([part for value in results.values() for part in value.parts], [*inputs.values()])
    proved = _proved(recording, names, results.keys() - truths.keys())
    rows, lost = list[tuple[str, float, str, float, str]](), list[str]()
    for name, value in results.items():
        steepest = (np.max(np.abs(motion[part]), axis=0).reshape(len(at), -1) for part in value.parts)
        moves = at * np.sqrt(sum(side**2 for side in steepest))
        size, k = float(np.nanmax(np.abs(names[name]))), greatest(moves.sum(0))
        kappa = float(moves[:, k].sum() / size) if size else np.nan
        zero = numbers.is_rounding(names[name], terms(lines[name].expression, names)) or np.isinf(proved.get(name, 0))
        if not kappa * EPS < 1 or zero:
            lost.append(name)
            continue
        own, turn = np.ravel(names[name]), 2 * np.pi if name.startswith(TURNS) else None
        off = (arithmetic.error(own[k], true, turn) for k, true in truths.get(name, {}).items())
        error = float(max(off)) if name in truths else proved[name]
        by = _DERIVED if name in truths else _PROVED if np.isfinite(error) else ""
        rows.append((name, max(1.0, kappa), each[greatest(moves[:, k])], error / size, by))
    rows.sort(key=lambda row: -round(np.log10(row[1]), 6))  # those alike as they stand in the document
    found, conditions, blamed, errors, against = (np.array(column) for column in zip(*rows, strict=True))
    errors = np.maximum(errors, EPS)
    columns = (
        Column("result", "", "", 0, found.astype(object), names=True),
        Column("log κ", "-", "logarithm of the condition number", 1, np.log10(conditions)),
        Column("expected digits", "-", "digits that the rounded inputs leave", 1, -np.log10(conditions * EPS)),
        Column("kept digits", "-", "digits that are right", 1, -np.log10(errors)),
        Column("against", "", "what it is compared with", 0, against.astype(object)),
        Column("most by", "", "the input whose rounding costs most", 0, blamed.astype(object), names=True),
    )
    derived, formulas = (int(np.count_nonzero(against == by)) for by in (_DERIVED, _PROVED))
    note = f"{derived} of {len(rows)} results are compared with 50 digits by another derivation,"
    note += f" {formulas} with what is proved of their own formulas; the others are inputs."
    note += f" No condition have {', '.join(lost)}: zero but for rounding, or with a jump." if lost else ""
    title = f"{path.stem.replace('_', ' ').capitalize()}, end to end"
    own_forms = [not name.endswith(_AS_PRINTED) for name in found]
    return Table(number, title, columns, note), (errors / (conditions * EPS))[own_forms]


def _proved(recording: Recording, namespace: Mapping[str, Any], names: Collection[str]) -> dict[str, float]:
    """By how much results may be off their formulas' own numbers at most, by balls around these.

    NaN where nobody knows, infinite where they are 0 but for rounding.
    """
    proof = prove(recording, namespace, (), registry(namespace), {}, names)
    found = dict[str, float]()
    for name in names:
        parts = [column for column in proof.columns if column.name == name]
        off = float(np.hypot.reduce([np.max(part.off) for part in parts])) if parts else np.inf
        zero = bool(parts) and all(part.exception for part in parts)
        found[name] = np.inf if zero else off if np.isfinite(off) else np.nan
    return found
