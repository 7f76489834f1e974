"""The proof of a run: how many digits of what it shows are right, and the check that they are enough."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from mechsheet.document import parts
from mechsheet.recording.lines import Recording
from mechsheet.recording.pinpoint import Places
from mechsheet.recording.record import record
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Table

if TYPE_CHECKING:
    from mechsheet.recording.proof import Proof


def proof_of(namespace: Mapping[str, Any], sheet: Worksheet, recording: Recording) -> "Proof":
    """What is proved of the tables, results and found values of a run, which has been recorded."""
    from mechsheet.recording.proof import prove  # on use: only a proof needs balls

    known = registry(namespace)
    tables = [value for value in parts.values(namespace) if isinstance(value, Table)]
    return prove(recording, namespace, tables, known, Places(sheet, known).lines)


def proof_of_wanted(namespace: Mapping[str, Any], sheet: Worksheet, want: Iterable[str]) -> "Proof":
    """What is proved of the cells that some results need, which have been run."""
    needed = replace(sheet, cells=tuple(sheet.needed(want, ["g"])))
    return proof_of(namespace, sheet, record(namespace, needed, whole=True))
