"""The proof of a run: how many digits of what it shows are right, and the check that they are enough."""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from mechsheet.document import parts
from mechsheet.quantities.lines import Recording
from mechsheet.recording.pinpoint import Places
from mechsheet.recording.record import record
from mechsheet.run.progress import if_long
from mechsheet.worksheet.cells import Worksheet, base
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.no_inputs import beforehand, inputs_of
from mechsheet.worksheet.table import Table

if TYPE_CHECKING:
    from mechsheet.readers.proof import Proof


def proof_of(
    namespace: Mapping[str, Any],
    sheet: Worksheet,
    recording: Recording,
    fields: Collection[str] = (),
    done: Callable[[int, int], object] | None = None,
) -> "Proof":
    """What is proved of the tables, results and found values of a run, which has been recorded.

    Also of ``fields``, which are results over several positions. ``done`` is called with how many of how many steps
    are behind; without it a bar on the terminal shows them.
    """
    from mechsheet.readers.balls import meant  # on use: only a proof needs balls
    from mechsheet.readers.proof import prove  # on use: as above

    known = registry(namespace)
    tables = [value for value in parts.values(namespace) if isinstance(value, Table)]
    before = meant.set(recording.graph.unmoved.written)
    try:
        with if_long("proof") as shown:
            return prove(recording, namespace, tables, known, Places(sheet, known).lines, fields, done or shown)
    finally:
        meant.reset(before)


def proof_of_wanted(namespace: Mapping[str, Any], sheet: Worksheet, want: Iterable[str]) -> "Proof":
    """What is proved of the cells that some results need, which have been run."""
    want = list(want)
    needed = replace(sheet, cells=tuple(sheet.needed(want, beforehand(inputs_of(namespace)))))
    return proof_of(namespace, sheet, record(namespace, needed, whole=True, exact=True), {base(name) for name in want})
