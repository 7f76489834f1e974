"""The arguments of a run: inputs by name, a scene, the folder for what is written, whether proof or bands are asked."""

import os
import sys
from collections.abc import Container, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from mechsheet.worksheet import scene as scenes
from mechsheet.worksheet.cells import base
from mechsheet.worksheet.data_file import ENDINGS, OTHER_SPREADSHEETS
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.inputs import known
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.scene import Scene


class UsageError(SheetError):
    """What is given cannot be used, whatever the worksheet computes: not understood, or no such name."""


@contextmanager
def usage() -> Iterator[None]:
    """Errors within are of what is given."""
    try:
        yield
    except SheetError as error:
        raise UsageError(str(error), error.of) from None


def is_script(worksheet: str) -> bool:
    """Whether the worksheet itself was started, as ``python worksheet.py``."""
    if not (sys.argv and sys.argv[0]) or Path(sys.argv[0]).resolve() != Path(worksheet).resolve():
        return False
    if "marimo" not in sys.modules:
        return True
    import marimo as mo  # on use: see above

    return not mo.running_in_notebook()  # an export to HTML runs in the name of the worksheet too


_OF_A_RUN = ("scene", "out", "want", "tolerances")  # none of which may be empty, as the text of an input may


@usage()
def read(arguments: Sequence[str], declared: Sequence[Input], results: Container[str] = ()) -> Scene:
    """Scene from ``--scene=FILE``, ``--out=FOLDER``, ``--want=NAMES``, ``--NAME=VALUE``; the later holds.

    ``--tolerances`` stands alone, and ``--proof`` too or as ``--proof=DIGITS``.

    Wanted are names with commas between them, or one check by its own, which may have commas: none of what stands
    between these is one of the ``results`` then. Those of all ``--want`` are wanted together.

    Raises UsageError for anything else, and for inputs that are not known or cannot be read.
    """
    scene, wanted = Scene(), list[str]()
    for argument in arguments:
        name, equals, value = argument.removeprefix("--").partition("=")
        if name == "proof" and argument.startswith("--"):
            scene = replace(scene, proof=scenes.digits(f"argument {argument!r}", value) if equals else scenes.PROVED)
            continue
        if argument == "--tolerances":
            scene = replace(scene, tolerances=True)
            continue
        if name == "jobs" and argument.startswith("--") and "jobs" not in {field.name for field in declared}:
            raise SheetError(f"argument {argument!r}: processes compute scenes side by side, and none is given")
        if not (argument.startswith("--") and name and equals) or (name in _OF_A_RUN and not value):
            forms = "--NAME=VALUE, --want=NAMES, --scene=FILE, --out=FOLDER, --proof, --proof=DIGITS or --tolerances"
            raise SheetError(f"argument {argument!r} must be {forms}")
        if name == "scene":
            new = load(_path(value), declared)
            inputs, limits, proof = scene.inputs | new.inputs, scene.limits | new.limits, new.proof or scene.proof
            scene = Scene(inputs, scene.out, new.want or scene.want, limits, proof, scene.tolerances)
        elif name == "out":
            scene = replace(scene, out=_path(value))
        elif name == "want":
            names = [scenes.as_read(part.strip()) for part in value.split(",")]
            known_to_be = not results or len(names) == 1 or any(base(part) in results for part in names)
            wanted += names if known_to_be and all(base(part).isidentifier() for part in names) else [value]
        else:
            scene = replace(scene, inputs={**scene.inputs, scenes.as_read(name): value})
    fields = {field.name: field for field in declared}
    for name, text in scene.inputs.items():
        known(fields, name).read(text)
    return replace(scene, want=tuple(dict.fromkeys(wanted)) or scene.want)


def _path(text: str) -> Path:
    """A path whose ~ the shell has left as it is: behind = it means nothing to most of them."""
    return Path(os.path.expanduser(text))


def load(path: Path, declared: Sequence[Input]) -> Scene:
    """Scene of a TOML file, or of an exported workbook whose sheet of inputs has been edited.

    Raises SheetError naming the file and what in it cannot be used.
    """
    if path.suffix.lower() == ".xlsx":
        from mechsheet.workbook import reading  # on use: openpyxl takes a third of a second

        return Scene(reading.inputs(path, declared))
    if path.suffix.lower() in OTHER_SPREADSHEETS and path.is_file():
        raise SheetError(f"scene {path} is a spreadsheet that cannot be read: save it as .xlsx")
    scene, lists = scenes.load(path), _lists(declared)
    for name, value in scene.inputs.items():
        if isinstance(value, dict | list) and name not in lists:
            raise SheetError(f"scene {path}: input {name} = {as_given(value)} must be one value")
    named = {name: path.parent / text for name, text in scene.inputs.items() if isinstance(text, str) and name in lists}
    beside = {name: str(file) for name, file in named.items() if file.suffix.lower() in ENDINGS and file.is_file()}
    return replace(scene, inputs=scene.inputs | beside)


def _lists(declared: Sequence[Input]) -> set[str]:
    """Inputs that may be given by the name of a file."""
    return {field.name for field in declared if isinstance(field, Rows)}
