"""Units checked by the recording of a worksheet: what does not fit, by its line and part."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from mechsheet.quantities.lines import Recording
from mechsheet.recording.converted import converted
from mechsheet.recording.dimension_rules import Reader
from mechsheet.recording.handbook import by_turns, to_the_unit
from mechsheet.recording.pinpoint import Mistake, Places
from mechsheet.recording.record import record
from mechsheet.recording.temperatures import misread
from mechsheet.recording.turned import turned
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.lines import Formula, registry
from mechsheet.worksheet.no_inputs import beforehand, inputs_of

_TOLD = 3  # mistakes


class Dimensions(NamedTuple):
    """What the dimensions of a worksheet tell.

    ``notes`` are what a literal is taken for, and what would be a mistake unless one has a unit. ``missing`` are the
    declared lines that are not recorded, ``gaps`` the statements by their lines.
    """

    mistakes: tuple[Mistake, ...]
    notes: tuple[Mistake, ...]
    missing: tuple[str, ...]
    gaps: tuple[int, ...]

    def check(self) -> Check:
        """The check named units, which fails by the first mistake."""
        told = [str(mistake) for mistake in self.mistakes[:_TOLD]] or [str(note) for note in self.notes[:1]]
        if len(self.mistakes) > _TOLD:
            told.append(f"and {len(self.mistakes) - _TOLD} more")
        if self.gaps:
            told.append(f"not followed at line{'s' * (len(self.gaps) > 1)} {', '.join(map(str, self.gaps))}")
        return Check("units", len(self.mistakes), 0, "mistakes", "; ".join(told))


def dimensions(
    recording: Recording, sheet: Worksheet, namespace: Mapping[str, Any], known: Mapping[str, Formula]
) -> Dimensions:
    """What the dimensions of a recording tell, in the order of the lines.

    ``namespace`` is that of the worksheet's own run, ``known`` its lines that declare a unit.
    """
    values = recording.values
    lines = [line for line in known.values() if line.has_value]
    places = Places(sheet, known)
    reader = Reader(recording, values, namespace, lines, places)
    for mistake in (*turned(reader), *converted(reader), *by_turns(reader), *misread(reader)):
        reader.add(mistake)
    for note in to_the_unit(reader):
        reader.notes.setdefault(note.line, note)
    g = inputs_of(namespace)
    for field in declared(type(g)):
        for leaf, _ in field.leaves(getattr(g, field.name)).values():
            if leaf.mistake:
                reader.add(Mistake(leaf.line, leaf.name, leaf.mistake))
    for line in known.values():
        if line.mistake:
            reader.add(Mistake(places.line_of(line), line.name, line.mistake))
    return Dimensions(
        tuple(sorted(reader.mistakes.values())),
        tuple(sorted(reader.notes.values())),
        tuple(line.name for line in lines if values.get(line.name) is None),
        tuple(sorted({gap.line for gap in recording.gaps})),
    )


def of_every_line(sheet: Worksheet, namespace: Mapping[str, Any], known: Mapping[str, Formula]) -> Dimensions:
    """What the dimensions of all cells tell, also of those that no table or check needs."""
    return dimensions(record(namespace, sheet, True, known), sheet, namespace, known)


def mismatches(worksheet: str | Path) -> list[Mistake]:
    """Mistakes in the units of a worksheet, in the order of its lines; each where it arises, and once."""
    sheet = load(worksheet)
    namespace = sheet.run(sheet.results, beforehand(sheet.inputs()))
    return list(of_every_line(sheet, namespace, registry(namespace)).mistakes)
