"""The units of a worksheet's lines in many runs: judged once for all that go the same way."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.lines import Recording
from mechsheet.readers.numbers import numbers
from mechsheet.recording.dimensions import dimensions
from mechsheet.recording.evaluation import ways_of
from mechsheet.recording.planned import leaves
from mechsheet.recording.record import record_every_line
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.no_inputs import inputs_of


class _Judged(NamedTuple):
    """The check of the units of a worksheet, for inputs on which its ways depend, and the recording that it is of."""

    sheet: Worksheet
    ways: tuple[Any, ...]
    recording: Recording
    check: Check

    def fits(self, sheet: Worksheet, g: Any) -> bool:
        """Whether the lines go the same way for other inputs."""
        if self.sheet is not sheet or self.ways != ways_of(g):
            return False
        given = leaves(g)
        looked = (guard.holds for guards in self.recording.looked.values() for guard in guards)
        seen = [*self.recording.guards, *looked]
        found = numbers(seen, {node: given[name] for name, node in self.recording.inputs.items() if name in given})
        return all(np.all(found[node]) for node in seen)


_judged: list[_Judged] = []  # the newest last
_KEPT = 8


def units_of(namespace: Mapping[str, Any], sheet: Worksheet) -> Check:
    """The check of the units of a run's lines."""
    g = inputs_of(namespace)
    known: _Judged | None = next((each for each in reversed(_judged) if each.fits(sheet, g)), None)
    if known is not None:
        return known.check
    recording = record_every_line(namespace, sheet)
    check = dimensions(recording, sheet, namespace, registry(namespace)).check()
    if not recording.gaps:  # what is not recorded may go any way for other inputs
        _judged[:] = [*_judged[1 - _KEPT :], _Judged(sheet, ways_of(g), recording, check)]
    return check
