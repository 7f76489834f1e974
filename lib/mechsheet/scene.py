"""Scenes: what replaces the inputs of a worksheet, from arguments and TOML files."""

import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType

from mechsheet.errors import SheetError


@dataclass(frozen=True)
class Scene:
    """Inputs by name, in display units, and the folder for the workbook if one is asked for."""

    inputs: dict[str, object] = field(default_factory=dict)
    out: Path | None = None


def is_script(worksheet: str) -> bool:
    """Whether the worksheet itself was started, as ``python worksheet.py``."""
    import marimo as mo

    started = bool(sys.argv and sys.argv[0]) and Path(sys.argv[0]).resolve() == Path(worksheet).resolve()
    return started and not mo.running_in_notebook()  # an export to HTML runs in the name of the worksheet too


def arguments(worksheet: str) -> Scene:
    """Scene from the arguments of ``python worksheet.py --NAME=VALUE ..`` or behind ``marimo run worksheet.py --``.

    Raises SheetError for an argument of another form or an unreadable scene file.
    """
    if is_script(worksheet):
        sys.excepthook = _one_line(sys.excepthook)
        return read(sys.argv[1:])
    import marimo as mo

    given = mo.cli_args().to_dict() if mo.running_in_notebook() else {}
    return read([f"--{name}={value}" for name, value in given.items()])


def read(arguments: list[str]) -> Scene:
    """Scene from texts ``--scene=FILE.toml``, ``--out=FOLDER`` and ``--NAME=VALUE``; the later one holds."""
    inputs: dict[str, object] = {}
    out = None
    for argument in arguments:
        name, equals, value = argument.removeprefix("--").partition("=")
        if not (argument.startswith("--") and name and equals and value):
            raise SheetError(f"argument {argument!r} must be --NAME=VALUE, --scene=FILE.toml or --out=FOLDER")
        if name == "scene":
            inputs |= load(Path(value))
        elif name == "out":
            out = Path(value)
        else:
            inputs[name] = value
    return Scene(inputs, out)


def load(path: Path) -> dict[str, object]:
    """Inputs of a scene file: the TOML table ``[inputs]`` of names and values in display units."""
    try:
        scene = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise SheetError(f"scene {path} cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SheetError(f"scene {path} is no valid TOML: {error}") from None
    unknown = set(scene) - {"inputs"}
    if unknown or not isinstance(scene.get("inputs"), dict):
        raise SheetError(f"scene {path} must hold a table [inputs] and nothing else; it has {sorted(scene)}")
    inputs: dict[str, object] = scene["inputs"]
    return inputs


_Hook = Callable[[type[BaseException], BaseException, TracebackType | None], object]


def _one_line(other: _Hook) -> _Hook:
    def show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, SheetError):
            print(f"error: {error}", file=sys.stderr)
        else:
            other(kind, error, trace)

    return show
