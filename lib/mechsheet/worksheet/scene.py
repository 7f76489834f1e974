"""Scenes: what replaces the inputs of a worksheet, what is wanted of it, and within which limits.

A scene file is TOML of up to four parts::

    want = ["GS6", "PS6_S.imag"]     # results to compute, and nothing else; left out: the whole worksheet
    proof = 9                        # digits to which every number shown must be proved; left out: no proof

    [inputs]
    P6 = 40e3                        # numbers, or texts such as "0,415", in display units

    [limits]
    GS6 = {min = 30e3}               # of a result: min, max or both, in its display unit, or {min = "30 kN"}
    "loop of group (2, 3)" = {max = 1e-9}    # of a check: max stands for its own limit

A wanted or limited name is that of a result, a part of one as in a table (``PS6_S.imag``, ``abs(R56)``), or of a check.
"""

import re
import unicodedata
from collections.abc import Collection, Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from mechsheet.worksheet import numbers
from mechsheet.worksheet.cells import base
from mechsheet.worksheet.errors import SheetError, as_given, cut
from mechsheet.worksheet.kinds import converted, number, number_and_unit

PROVED, MOST_PROVED = 9.0, 15  # digits that a proof is asked for by itself, and at most


class Limit(NamedTuple):
    """Between what a result must lie, in its display unit, or in those that stand behind the numbers."""

    min: float | None = None
    max: float | None = None
    min_unit: str = ""
    max_unit: str = ""

    def of(self, name: str, unit: str) -> "Limit":
        """The limit in the unit of the result of that name; SheetError where it cannot be given in that."""
        ends = list[float | None]()
        for x, other in ((self.min, self.min_unit), (self.max, self.max_unit)):
            try:
                ends.append(converted(x, other, unit) if x is not None and other else x)
            except ValueError as error:
                given = numbers.significant(x or 0.0, 10)
                raise SheetError(f"limit {given} {other} of {name}: {error}") from None
        least, most = ends
        if least is not None and most is not None and least > most:
            raise SheetError(f"limit of {name}: min is above max")
        return Limit(least, most)


@dataclass(frozen=True)
class Scene:
    """Inputs by name, in display units; the folder for files if one is given; the results wanted, none for all
    of them; limits by the name of a result or check; the digits that must be proved, none for no proof; whether bands
    for the tolerances of the inputs are wanted."""

    inputs: dict[str, object] = field(default_factory=dict)
    out: Path | None = None
    want: tuple[str, ...] = ()
    limits: dict[str, Limit] = field(default_factory=dict)
    proof: float | None = None
    tolerances: bool = False


def beside(worksheet: Path) -> list[Path]:
    """Files that may be scenes in the folder of a worksheet, and in ``scenes`` there."""
    return sorted([*worksheet.parent.glob("*.toml"), *worksheet.parent.glob("scenes/*.toml")])


def texts_beside(worksheet: Path) -> dict[Path, str]:
    """Texts of the files that may be scenes of a worksheet, but for those that are no text."""
    found = dict[Path, str]()
    for path in beside(worksheet):
        with suppress(UnicodeDecodeError):
            found[path] = path.read_bytes().decode()
    return found


def is_of(text: str, declared: Iterable[str], results: Collection[str] = ()) -> bool:
    """Whether the text of a file is that of a scene that gives inputs, all of them among the ``declared`` ones.

    With ``results`` one too that gives none, and wants or limits some of these alone, beside checks.
    """
    import tomllib  # on use: most runs are given no scene

    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return False
    given, *named = (content.get(part, ()) for part in ("inputs", "want", "limits"))
    if given or not results:
        return isinstance(given, dict) and bool(given) and set(map(as_read, given)) <= set(declared)
    names = (name for part in named if isinstance(part, list | dict) for name in part if isinstance(name, str))
    asked = {root for name in names if (root := base(as_read(name))).isidentifier()}
    return bool(asked) and asked <= {*results, *declared}


def load(path: Path) -> Scene:
    """Scene of a TOML file.

    Raises SheetError naming the file and what in it cannot be used.
    """
    import tomllib  # on use: as above

    text = ""
    try:
        text = path.read_text(encoding="utf-8-sig")
        content = tomllib.loads(text)
    except OSError as error:
        raise SheetError(f"scene {path} cannot be read: {error.strerror}") from None
    except RecursionError:
        raise SheetError(f"scene {path} is no valid TOML: its brackets are nested too deep") from None
    except UnicodeDecodeError:
        raise SheetError(f"scene {path} is no text in UTF-8: save it in that encoding") from None
    except tomllib.TOMLDecodeError as error:
        raise SheetError(f"scene {path} is no valid TOML: {error}{_unquoted(text, str(error))}") from None
    except ValueError:
        raise SheetError(f"scene {path}: a whole number of thousands of digits cannot be used") from None
    return _scene(path, content)


def _unquoted(text: str, error: str) -> str:
    """What a scene needs quotes for or gives twice, where that may be what is wrong."""
    at = re.search(r"at line (\d+)", error)
    line = text.splitlines()[int(at[1]) - 1] if at else ""
    bare = re.match(r"\s*([^\W\d]\w*)\s*=", line)
    if bare and not bare[1].isascii():
        return f'; a name with other letters than a..z stands in quotes: "{bare[1]}"'
    if bare and error.startswith("Cannot overwrite"):
        return f"; {bare[1]} is given twice"
    comma = re.search(r"=\s*([+-]?\d+,\d+)", text)
    return f'; a number with a comma stands in quotes: "{comma[1]}"' if comma else ""


def _scene(path: Path, content: dict[str, Any]) -> Scene:
    unknown = sorted(set(content) - {"inputs", "want", "limits", "proof"})
    if unknown or not content:
        has = f"it has {cut(', '.join(unknown))}" if unknown else "it is empty"
        raise SheetError(f"scene {path} may hold [inputs], want, proof and [limits] and nothing else; {has}")
    inputs, want, limits = content.get("inputs", {}), content.get("want"), content.get("limits", {})
    for name, table in (("inputs", inputs), ("limits", limits)):
        if not isinstance(table, dict):
            raise SheetError(f"scene {path}: {name} = {as_given(table)} must be a table [{name}]")
    if want is not None and not (isinstance(want, list) and want and all(isinstance(name, str) for name in want)):
        raise SheetError(f'scene {path}: want = {as_given(want)} must be a list of names such as ["GS6"]')
    proof = (
        digits(f"scene {path}: proof = {as_given(content['proof'])}", content["proof"]) if "proof" in content else None
    )
    limited = {name: _limit(path, name, x) for name, x in _as_read(path, limits).items()}
    return Scene(_as_read(path, inputs), None, tuple(dict.fromkeys(map(as_read, want or ()))), limited, proof)


def _as_read(path: Path, table: dict[str, Any]) -> dict[str, Any]:
    """A table with its names as Python reads them; SheetError where two are the same one then."""
    named = dict[str, Any]()
    for name, value in table.items():
        if as_read(name) in named:
            raise SheetError(f"scene {path}: {as_read(name)} is given twice")
        named[as_read(name)] = value
    return named


def as_read(name: str) -> str:
    """A name in the letters in which Python reads it: the sign of the key µ is another one than the Greek letter."""
    return unicodedata.normalize("NFKC", name) if name.isidentifier() else name


def digits(says: str, given: object) -> float:
    """A number of digits to prove; SheetError, which begins with what it says, for anything else."""
    try:
        asked = number(given)
    except ValueError:
        asked = 0.0
    if not 1 <= asked <= MOST_PROVED:
        raise SheetError(f"{says} must be a number of digits, 1..{MOST_PROVED}")
    return asked


def _limit(path: Path, name: str, ends: object) -> Limit:
    says = f"scene {path}: limit {name} = {as_given(ends)}"
    if not isinstance(ends, dict) or not ends or set(ends) - {"min", "max"}:
        raise SheetError(f"{says} must be {{min = NUMBER}}, {{max = NUMBER}} or both")
    try:
        read = {end: number_and_unit(value) for end, value in ends.items()}
    except ValueError as error:
        raise SheetError(f"{says}: {error}") from None
    (least, least_in), (most, most_in) = (read.get(end, (None, "")) for end in ("min", "max"))
    limit = Limit(least, most, least_in, most_in)
    if least_in == most_in and least is not None and most is not None and least > most:
        raise SheetError(f"{says}: min is above max")
    return limit
