"""The beginning of a worksheet: its inputs asked for in the page, or taken from the arguments of a script."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from mechsheet.recording.memory import names_of
from mechsheet.run import arguments, ending
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.inputs import build, declared
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.scene import Scene

if TYPE_CHECKING:
    import marimo as mo


class Given(NamedTuple):
    """What stands for the fields where nobody fills them in."""

    value: dict[str, object]


def ask(cls: type) -> "mo.ui.batch | Given":
    """Text fields for all inputs, section by section, with the defaults or what arguments and scenes give."""
    try:
        if not hasattr(cls, "__worksheet__"):
            raise SheetError(f"ask takes a class of inputs: write @inputs above {getattr(cls, '__name__', cls)}")
        if not hasattr(cls, "__inputs__") and (names := [field.name for field in declared(cls)]):
            raise SheetError(f"input {names[0]} of {cls.__name__} needs a value, such as {names[0]}: float = 1.0")
        given = _given(cls).inputs
        if "marimo" not in sys.modules:
            return Given(given)
        g: object = build(cls, given)
    except SheetError as error:
        refuse(error)
    from mechsheet.page.fields import fields  # on use: imports marimo, which nothing but a page needs

    return fields(g)


def unasked(sheet: Worksheet) -> None:
    """Take the arguments of a script in which no cell asks for inputs.

    Raises UsageError for an input among them, and as `arguments.read`.
    """
    reads = {name for cell in sheet.cells for name in names_of(cell.code)}
    if "ask" not in reads and ask not in map(sheet.common.get, reads):
        scene = _of_script(sheet.path, declared(sheet.inputs))
        if scene.inputs:
            given = ", ".join(scene.inputs)
            raise arguments.UsageError(f"no cell of {sheet.path} asks for inputs, as ask(..) does: given is {given}")


def _of_script(worksheet: str, known: Sequence[Input]) -> Scene:
    """Scene from the arguments; one that wants only some results is answered here and now, and the script ends."""
    several = any(argument.startswith("--want=") and "," in argument for argument in sys.argv[1:])
    scene = arguments.read(sys.argv[1:], known, load(worksheet).results if several else ())
    if scene.want:
        from mechsheet.run import batch  # on use: brings the writer of workbooks

        ending.over()
        sys.exit(batch.answer(worksheet, scene))
    return scene


def _given(cls: type) -> Scene:
    """Scene from the arguments of ``python worksheet.py --NAME=VALUE ..`` or behind ``marimo run worksheet.py --``.

    Raises SheetError for an argument of another form or an unreadable scene file.
    """
    worksheet: str = cls.__worksheet__  # type: ignore[attr-defined]
    if arguments.is_script(worksheet):  # answered once: the cell that asks may be needed for what else it gives
        return Scene() if ending.is_over() else _of_script(worksheet, declared(cls))
    if "marimo" not in sys.modules:
        return Scene()
    import marimo as mo  # on use: a worksheet called as a function needs it not

    given = mo.cli_args().to_dict() if mo.running_in_notebook() else {}
    return arguments.read([f"--{name}={value}" for name, value in given.items()], declared(cls))
