"""The beginning of a worksheet: its inputs asked for in the page, or taken from the arguments of a script."""

import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mechsheet.run import arguments
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.inputs import build, declared
from mechsheet.worksheet.scene import Scene

if TYPE_CHECKING:
    import marimo as mo


@dataclass(frozen=True)
class Given:
    """What stands for the fields where nobody fills them in."""

    value: dict[str, object]


def ask(cls: type) -> "mo.ui.batch | Given":
    """Text fields for all inputs, section by section, with the defaults or what arguments and scenes give."""
    try:
        given = _given(cls).inputs
        if "marimo" not in sys.modules:
            return Given(given)
        g: object = build(cls, given)
    except SheetError as error:
        refuse(error)
    from mechsheet.page.fields import fields  # on use: imports marimo, which nothing but a page needs

    return fields(g)


def _given(cls: type) -> Scene:
    """Scene from the arguments of ``python worksheet.py --NAME=VALUE ..`` or behind ``marimo run worksheet.py --``.

    In a script a scene that wants only some results is answered here and now, and the script ends.

    Raises SheetError for an argument of another form or an unreadable scene file.
    """
    worksheet: str = cls.__worksheet__  # type: ignore[attr-defined]
    if arguments.is_script(worksheet):
        scene = arguments.read(sys.argv[1:], declared(cls))
        if scene.want:
            from mechsheet.run import batch  # on use: brings the writer of workbooks

            sys.exit(batch.answer(worksheet, scene))
        return scene
    if "marimo" not in sys.modules:
        return Scene()
    import marimo as mo  # on use: a worksheet called as a function needs it not

    given = mo.cli_args().to_dict() if mo.running_in_notebook() else {}
    return arguments.read([f"--{name}={value}" for name, value in given.items()], declared(cls))
