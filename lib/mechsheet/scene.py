"""Scenes: what replaces the inputs of a worksheet, from arguments, TOML files and edited workbooks.

A scene file is TOML of up to three parts::

    want = ["GS6", "PS6_S.imag"]     # results to compute, and nothing else; left out: the whole worksheet

    [inputs]
    P6 = 40e3                        # numbers, or texts such as "0,415", in display units

    [limits]
    GS6 = {min = 30e3}               # of a result: min, max or both, in its display unit
    "loop of group (2, 3)" = {max = 1e-9}    # of a check: max stands for its own limit

A wanted or limited name is that of a result, a part of one as in a table (``PS6_S.imag``, ``abs(R56)``), or of a check.
"""

import re
import sys
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from mechsheet.errors import SheetError

if TYPE_CHECKING:
    from mechsheet.inputs import Input


@dataclass(frozen=True)
class Limit:
    """Between what a result must lie, in its display unit."""

    min: float | None = None
    max: float | None = None


@dataclass(frozen=True)
class Scene:
    """Inputs by name, in display units; the folder for files if one is given; the results wanted, none for all
    of them; limits by the name of a result or check."""

    inputs: dict[str, object] = field(default_factory=dict)
    out: Path | None = None
    want: tuple[str, ...] = ()
    limits: dict[str, Limit] = field(default_factory=dict)


def is_script(worksheet: str) -> bool:
    """Whether the worksheet itself was started, as ``python worksheet.py``."""
    import marimo as mo

    started = bool(sys.argv and sys.argv[0]) and Path(sys.argv[0]).resolve() == Path(worksheet).resolve()
    return started and not mo.running_in_notebook()  # an export to HTML runs in the name of the worksheet too


def arguments(worksheet: str, declared: "Sequence[Input]") -> Scene:
    """Scene from the arguments of ``python worksheet.py --NAME=VALUE ..`` or behind ``marimo run worksheet.py --``.

    In a script a scene that wants only some results is answered here and now, and the script ends.

    Raises SheetError for an argument of another form or an unreadable scene file.
    """
    if is_script(worksheet):
        sys.excepthook = _one_line(sys.excepthook)
        scene = read(sys.argv[1:], declared)
        if scene.want:
            from mechsheet import scenes

            sys.exit(scenes.answer(worksheet, scene))
        return scene
    import marimo as mo

    given = mo.cli_args().to_dict() if mo.running_in_notebook() else {}
    return read([f"--{name}={value}" for name, value in given.items()], declared)


def read(arguments: Sequence[str], declared: "Sequence[Input]") -> Scene:
    """Scene from texts ``--scene=FILE``, ``--out=FOLDER`` and ``--NAME=VALUE``; the later one holds."""
    scene = Scene()
    for argument in arguments:
        name, equals, value = argument.removeprefix("--").partition("=")
        if not (argument.startswith("--") and name and equals and value):
            raise SheetError(f"argument {argument!r} must be --NAME=VALUE, --scene=FILE or --out=FOLDER")
        if name == "scene":
            new = load(Path(value), declared)
            scene = Scene(scene.inputs | new.inputs, scene.out, new.want or scene.want, scene.limits | new.limits)
        elif name == "out":
            scene = replace(scene, out=Path(value))
        else:
            scene = replace(scene, inputs={**scene.inputs, name: value})
    return scene


def load(path: Path, declared: "Sequence[Input]") -> Scene:
    """Scene of a TOML file, or of an exported workbook whose sheet of inputs has been edited.

    Raises SheetError naming the file and what in it cannot be used.
    """
    if path.suffix.lower() == ".xlsx":
        from mechsheet import edited

        return Scene(edited.inputs(path, declared))
    text = ""
    try:
        text = path.read_text(encoding="utf-8-sig")
        content = tomllib.loads(text)
    except OSError as error:
        raise SheetError(f"scene {path} cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        comma = re.search(r"=\s*([+-]?\d+,\d+)", text)
        hint = f'; a number with a comma stands in quotes: "{comma[1]}"' if comma else ""
        raise SheetError(f"scene {path} is no valid TOML: {error}{hint}") from None
    return _scene(path, content)


def _scene(path: Path, content: dict[str, Any]) -> Scene:
    unknown = sorted(set(content) - {"inputs", "want", "limits"})
    if unknown or not content:
        has = f"it has {', '.join(unknown)}" if unknown else "it is empty"
        raise SheetError(f"scene {path} may hold [inputs], want and [limits] and nothing else; {has}")
    inputs, want, limits = content.get("inputs", {}), content.get("want"), content.get("limits", {})
    for name, table in (("inputs", inputs), ("limits", limits)):
        if not isinstance(table, dict):
            raise SheetError(f"scene {path}: {name} = {table!r} must be a table [{name}]")
    for name, value in inputs.items():
        if isinstance(value, dict | list):
            raise SheetError(f"scene {path}: input {name} = {value!r} must be one number")
    if want is not None and not (isinstance(want, list) and want and all(isinstance(name, str) for name in want)):
        raise SheetError(f'scene {path}: want = {want!r} must be a list of names such as ["GS6"]')
    return Scene(
        inputs, None, tuple(dict.fromkeys(want or ())), {name: _limit(path, name, x) for name, x in limits.items()}
    )


def _limit(path: Path, name: str, given: object) -> Limit:
    from mechsheet.inputs import number  # that module imports this one

    says = f"scene {path}: limit {name} = {given!r}"
    if not isinstance(given, dict) or not given or set(given) - {"min", "max"}:
        raise SheetError(f"{says} must be {{min = NUMBER}}, {{max = NUMBER}} or both")
    try:
        limit = Limit(**{end: number(value) for end, value in given.items()})
    except ValueError as error:
        raise SheetError(f"{says}: {error}") from None
    if limit.min is not None and limit.max is not None and limit.min > limit.max:
        raise SheetError(f"{says}: min is above max")
    return limit


_Hook = Callable[[type[BaseException], BaseException, TracebackType | None], object]


def _one_line(other: _Hook) -> _Hook:
    def show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, SheetError):
            print(f"error: {error}", file=sys.stderr)
        else:
            other(kind, error, trace)

    return show
