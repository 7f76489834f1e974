"""Input data: declared once in a class, asked for in the page, replaced by scenes and arguments."""

import ast
import dataclasses
import difflib
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, TypeVar, dataclass_transform

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.worksheet import errors, lines, numbers, source
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.shown import Shown

if TYPE_CHECKING:
    import marimo as mo

T = TypeVar("T")
_LIMIT = re.compile(r"\s*(<=|>=|<|>)\s*([^\s<>=]+)(?=[\s<>]|$)")
_NUMBER = re.compile(r"([+−-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+−-]?\d+)?)(.*)", re.DOTALL)
_THOUSANDS = re.compile(r"\W?[1-9]\d{0,2},\d{3}(?!\d)")  # elsewhere read as such, here as a number with a decimal comma
_UNIT = 40  # characters of a unit at most
MOST, LEAST = 1e60, 1e-60  # products of a few inputs of this size are still numbers
_COMPARE = {"<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal}


@dataclass(frozen=True)
class Input:
    """One declared input; ``limits`` are pairs such as (">", "0"), in the display unit, or ("<", "S_max")."""

    name: str
    unit: str
    meaning: str
    section: str
    whole: bool
    limits: tuple[tuple[str, str], ...]

    def display(self, value: Any) -> Any:
        """Value in the display unit, the rounding of the conversion taken back."""
        if self.whole:
            return value
        shown = value / units.parse(self.unit).factor
        return shown if np.ndim(shown) else float(numbers.significant(shown, 15))

    def read(self, value: object) -> float:
        """Number in the display unit, from a number or a text, behind which another unit may stand.

        Raises SheetError naming the input and what cannot be used of it.
        """
        try:
            x, other = _split(value)
            if other:
                given = f"{self.meaning} {self.name} = {errors.as_given(value)}"
                try:
                    theirs, own = units.parse(other), units.parse(self.unit)
                except ValueError as error:
                    raise SheetError(f"{given}: {error}") from None
                if theirs.dims != own.dims:
                    raise SheetError(f"{given}: {other} does not measure {self.unit}")
                if units.plain(other) != self.unit and "degC" in (units.plain(other), self.unit):
                    raise SheetError(f"{given}: write it in {self.unit}, for a temperature is not a difference")
                x = float(numbers.significant(x * (theirs.factor / own.factor), 15))
        except SheetError:
            raise
        except ValueError:
            raise SheetError(f"{self.says(errors.as_given(value))} is no number") from None
        if self.whole and not x.is_integer():
            raise SheetError(f"{self.says(x)} must be a whole number")
        return x

    def si(self, value: Any, default: Any) -> Any:
        """SI value of a number or an array in the display unit; the default itself where it is shown as that number."""
        if np.ndim(value):
            return np.where(value == self.display(default), default, value * units.parse(self.unit).factor)
        if value == self.display(default):
            return default
        return int(value) if self.whole else float(value * units.parse(self.unit).factor)

    def written(self, value: Any, default: Any) -> Any:
        """Value in the display unit that is read back as the very same value, where there is one."""
        shown = self.display(value)
        if self.whole or np.ndim(value) or value == default or self.si(shown, default) == value:
            return shown
        x = value / units.parse(self.unit).factor
        near = (x, *(float(np.nextafter(x, end)) for end in (-np.inf, np.inf)))
        return next((y for y in near if self.si(y, default) == value), x)

    def says(self, value: object) -> str:
        """The input as an error names it: meaning, symbol, value and unit."""
        return f"{self.meaning} {self.name} = {value}{numbers.suffix(self.unit)}"


@dataclass_transform(frozen_default=True)
def inputs(cls: type[T]) -> type[T]:
    """Make a class of lines ``X01: float = 0.415  # [m] meaning; > 0`` the frozen, validated inputs of a worksheet.

    Comments alone on a line are section headings; after ``;`` stand limits, against numbers in the
    display unit or other inputs. Values are SI and radians. Arrays serve as variants.

    Building one with a value that is no finite number or breaks a limit raises SheetError naming it.
    """
    frame = sys._getframe(1)
    try:
        cls.__inputs__ = _declared(cls.__name__, source.cell(frame))  # type: ignore[attr-defined]
    except SheetError as error:
        refuse(error)
    cls.__worksheet__ = str(frame.f_globals.get("__file__", ""))  # type: ignore[attr-defined]
    cls.__post_init__ = _validate  # type: ignore[attr-defined]
    return dataclass(frozen=True)(cls)


def declared(cls: type) -> tuple[Input, ...]:
    """Inputs of a class made by `inputs`, in their order."""
    fields: tuple[Input, ...] = cls.__inputs__  # type: ignore[attr-defined]
    return fields


def _declared(name: str, cell: source.Cell) -> tuple[Input, ...]:
    body = next(node for node in cell.body if isinstance(node, ast.ClassDef) and node.name == name)
    found, places, section, line = list[Input](), dict[str, str](), "", body.lineno
    for node in body.body:
        between = [cell.comments[n] for n in range(line + 1, node.lineno) if n in cell.comments]
        section, line = between[-1] if between else section, node.end_lineno or node.lineno
        if not isinstance(node, ast.AnnAssign):
            continue
        field = ast.unparse(node.target)
        text = lines.declared(cell.comments.get(line, ""))
        if text is None:
            raise SheetError(f"{cell.at(line)}: input {field} needs a comment with its unit, such as # [m] meaning")
        if text.mistake:
            raise SheetError(f"{cell.at(line)}: {text.mistake}")
        unit, (meaning, _, limits) = text.unit, text.meaning.partition(";")
        whole = ast.unparse(node.annotation) == "int"
        found.append(Input(field, unit, meaning.strip(), section, whole, tuple(_limits(limits, field, cell.at(line)))))
        places[field] = cell.at(line)
    _comparable(found, places)
    return tuple(found)


def _limits(text: str, field: str, place: str) -> Iterator[tuple[str, str]]:
    """The limits of a line, all of its text; SheetError naming the place and what cannot be read."""
    at = 0
    while text[at:].strip():
        match = _LIMIT.match(text, at)
        if not match:
            like = "> 0, <= 3 or < S_max"
            raise SheetError(
                f"{place}: limit {text[at:].strip()!r} of {field} cannot be read; limits are such as {like}"
            )
        yield match[1], match[2]
        at = match.end()


def _comparable(fields: Iterable[Input], places: Mapping[str, str]) -> None:
    """SheetError where a limit is neither a number nor an input in the same unit."""
    units_of = {field.name: field.unit for field in fields}
    for field in fields:
        for sign, other in field.limits:
            said = f"{places[field.name]}: limit {sign} {other} of {field.name}"
            if other in units_of:
                if units_of[other] != field.unit:
                    raise SheetError(f"{said}: {other} is in {units_of[other]}, {field.name} in {field.unit}")
                continue
            try:
                number(other)
            except ValueError:
                raise SheetError(f"{said}: {other} is neither a number nor an input") from None


def _validate(self: Any) -> None:
    fields = declared(type(self))
    shown = {field.name: field.display(getattr(self, field.name)) for field in fields}
    for holds, say in _rules(fields, shown):
        if not np.all(holds):
            raise SheetError(say(int(np.argmin(holds))))


def _rules(fields: Iterable[Input], shown: Mapping[str, Any]) -> Iterator[tuple[Any, Callable[[int], str]]]:
    """The rules for inputs in display units, one by one: where each holds, and what to say of a variant where not."""

    def say(field: Input, must: str, other: str = "") -> Callable[[int], str]:
        def text(i: int) -> str:
            limit = f" = {_element(shown[other], i)}" if other else ""
            return f"{field.says(_element(shown[field.name], i))} must be {must}{limit}"

        return text

    fields = tuple(fields)
    for field in fields:  # what is no number is named before what it would be compared with
        size = np.abs(np.asarray(shown[field.name], dtype=float))
        yield np.isfinite(size), say(field, "a finite number")
        yield size <= MOST, say(field, f"at most {numbers.significant(MOST, 6)} in size")
    for field in fields:
        value = shown[field.name]
        for sign, other in field.limits:
            is_input, is_length = other in shown, (sign, other) == (">", "0")
            limit = shown[other] if is_input else number(other)
            must = "positive" if is_length else f"{sign} {other}"
            yield _COMPARE[sign](value, limit), say(field, must, other * is_input)
            if is_length:
                yield np.abs(value) >= LEAST, say(field, f"at least {numbers.significant(LEAST, 6)}")


def _element(values: Any, i: int) -> Any:
    """One of the values, or the value of all."""
    return np.ravel(values)[i] if np.ndim(values) else values


@dataclass(frozen=True, eq=False)
class Variants:
    """Many variants of some inputs: their shape, the inputs as given, their units, and why some cannot be used.

    ``reasons`` has one text for each variant, "" where all inputs are within their limits.
    """

    shape: tuple[int, ...]
    shown: dict[str, NDArray[np.float64]]
    units: dict[str, str]
    reasons: NDArray[np.object_]
    _si: dict[str, Any]

    def at(self, rows: NDArray[np.intp]) -> dict[str, Any]:
        """Inputs of some variants in SI: shape (variants, 1), or one number where it is the same for all variants."""
        return {name: x[rows, None] if np.ndim(x) else x for name, x in self._si.items()}


def variants(cls: type, given: Mapping[str, ArrayLike]) -> Variants:
    """Variants from arrays of numbers or texts in display units, which broadcast.

    Raises SheetError naming an unknown input, or shapes that do not broadcast.
    """
    fields = {field.name: field for field in declared(cls)}
    columns = {name: _column(known(fields, name), given[name]) for name in given}
    shapes = {name: np.shape(column) for name, (column, _) in columns.items()}
    try:
        shape = np.broadcast_shapes(*shapes.values())
    except ValueError:
        named = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise SheetError(f"inputs of the variants must have one shape or broadcast: {named}") from None
    shown = {name: np.broadcast_to(column, shape) for name, (column, _) in columns.items()}
    texts: NDArray[Any] = np.full(shape, "", dtype=object)
    for _, more in columns.values():
        texts = np.where(texts == "", more, texts)
    reasons = texts.ravel()
    flat = {name: column.ravel() for name, column in shown.items()}
    every = {name: flat.get(name, field.display(getattr(cls, name))) for name, field in fields.items()}
    for holds, say in _rules(fields.values(), every):
        if not np.all(holds):
            for i in np.flatnonzero(np.broadcast_to(~np.asarray(holds), reasons.shape) & (reasons == "")):
                reasons[i] = say(int(i))
    si = {name: fields[name].si(_shared(column), getattr(cls, name)) for name, column in flat.items()}
    return Variants(shape, shown, {name: fields[name].unit for name in shown}, reasons, si)


def instance(cls: type[T], si: Mapping[str, Any]) -> T:
    """Inputs from values in SI that are known to be good, and the defaults."""
    g = object.__new__(cls)
    for field in declared(cls):
        value: Any = si.get(field.name, getattr(cls, field.name))
        object.__setattr__(g, field.name, int(value) if field.whole and not np.ndim(value) else value)
    return g


def _column(field: Input, given: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.object_]]:
    """Numbers of an input in its display unit, and the reason for each that cannot be used."""
    try:
        column = np.asarray(given)
    except ValueError:  # of rows that differ in length
        raise SheetError(f"{field.says(errors.as_given(given))} is no array of numbers") from None
    texts = np.full(column.shape, "", dtype=object)
    if column.dtype.kind in "iuf":
        numbers = column.astype(np.float64)
    else:
        numbers = np.full(column.shape, np.nan)
        for i, value in np.ndenumerate(column.astype(object)):
            try:
                numbers[i] = field.read(value)
            except SheetError as error:
                texts[i] = str(error)
    if field.whole:
        parts = np.isfinite(numbers) & (numbers != np.rint(numbers))
        texts[parts] = [f"{field.says(value)} must be a whole number" for value in numbers[parts]]
    return numbers, texts


def _shared(column: NDArray[np.float64]) -> Any:
    """The number that all variants have, or the column."""
    return column[0] if column.size and (column == column[0]).all() else column


def known(fields: Mapping[str, Input], name: str) -> Input:
    """The input of that name; SheetError with the nearest names where there is none."""
    if name not in fields:
        near = difflib.get_close_matches(name, fields, n=3, cutoff=0.5)
        raise SheetError(f"input {errors.cut(name)} is unknown; nearest: {', '.join(near or fields)}")
    return fields[name]


def number(text: object) -> float:
    """Number written with a decimal point or comma; ValueError for anything else.

    >>> number("0,415"), number("1.75e7"), number("27,500")
    (0.415, 17500000.0, 27.5)
    """
    x, unit = _split(text)
    if unit:
        raise ValueError(f"{errors.as_given(text)} is no number")
    return x


def _split(value: object) -> tuple[float, str]:
    """A number and the unit behind it; ValueError where there is no number."""
    if isinstance(value, int) and not isinstance(value, bool):
        return _float(value), ""
    match = None if isinstance(value, bool) else _NUMBER.fullmatch(str(value).strip())
    unit = match[2].strip() if match else ""
    if not match or (unit and not (len(unit) < _UNIT and re.match(r"[^\W\d_]|[%°]|1/", unit))):
        raise ValueError(f"{errors.as_given(value)} is no number")
    return float(match[1].replace(",", ".").replace("−", "-")), unit


def _float(x: int) -> float:
    """A whole number of any length, which Python would refuse to write."""
    try:
        return float(x)
    except OverflowError:
        return inf if x > 0 else -inf


def build(cls: type[T], values: Mapping[str, object]) -> T:
    """Inputs with some values replaced, given as texts or numbers in display units.

    Raises SheetError naming an unknown input with the nearest known ones, a text that is no number, or
    a value outside its limits.
    """
    fields = {field.name: field for field in declared(cls)}
    read = {name: known(fields, name).read(value) for name, value in values.items()}
    return cls(**{name: fields[name].si(x, getattr(cls, name)) for name, x in read.items()})


def readings(fields: Iterable[Input], values: Mapping[str, object]) -> list[str]:
    """How texts among the values are read that could mean thousands elsewhere: a line each, to be told once.

    >>> length = Input("L", "mm", "length", "", False, ())
    >>> readings([length], {"L": "1,035"}), readings([length], {"L": "0,415"})
    (['L = 1.035 mm, read with a decimal comma'], [])
    """
    return [
        f"{field.name} = {numbers.significant(field.read(value), 15)}{numbers.suffix(field.unit)}"
        ", read with a decimal comma"
        for field in fields
        if isinstance(value := values.get(field.name), str) and _THOUSANDS.match(value.strip())
    ]


def text(field: Input, value: Any) -> str:
    """Value in the display unit as a text field shows it."""
    return numbers.significant(field.display(value), 15)


def read(cls: type[T], form: "mo.ui.batch") -> T:
    """Inputs as the text fields of ``form`` hold them, checked as in `build`."""
    values: dict[str, object] = form.value
    try:
        return build(cls, values)
    except SheetError as error:
        refuse(error)


@dataclass(frozen=True)
class Used(Shown):
    """The values that a worksheet really uses, shown in their display units."""

    g: Any

    def rows(self) -> list[tuple[Input, Any]]:
        """Each input with its value in the display unit."""
        cls = type(self.g)
        return [
            (field, field.written(getattr(self.g, field.name), getattr(cls, field.name))) for field in declared(cls)
        ]

    @property
    def changed(self) -> set[str]:
        """Names of the inputs that differ from the worksheet's own."""
        return {f.name for f in dataclasses.fields(self.g) if getattr(self.g, f.name) != f.default}
