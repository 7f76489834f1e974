"""Input data: declared once in a class, asked for in the page, replaced by scenes and arguments."""

import ast
import dataclasses
import sys
import weakref
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import NoneType
from typing import Any, Literal, TypeVar, dataclass_transform, get_args, get_origin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.mechanics.arguments import unmasked
from mechsheet.units import parse
from mechsheet.worksheet import alone, deviation, errors, limits, lines, source
from mechsheet.worksheet.caret import caret
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.kinds import Choice, Input, Offer, Switch
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.text_line import TextLine

T = TypeVar("T")


@dataclass_transform(frozen_default=True)
def inputs(cls: type[T]) -> type[T]:
    """Make a class of lines ``X01: float = 0.415  # [m] meaning; > 0`` the frozen, validated inputs of a worksheet.

    Comments alone on a line are section headings; after ``;`` stand limits, against numbers in the display unit or
    other inputs, and after another one a tolerance, ``± 0.001`` or ``± 1 %``: all values within are equally likely,
    unless ``normal`` behind it makes it three standard deviations. Values are SI and radians; alone an ``int`` counts
    in its display unit, as in ``n: int = 1450  # [rpm] speed``. Arrays serve as variants.

    The kind of an input is its type: ``float``, ``int``, ``bool`` (a switch), ``str`` (a text),
    ``Literal["single", "double"]`` (a choice of names), what `one_of` gives (options with properties), ``list[float]``
    (an array of any length), or a list of objects of a class (a table, whose columns are arrays). A class of lines
    without values is not asked for: it declares the properties of such options, or the columns of such a table, which
    are numbers or texts.

    Building one with a value that is no finite number or breaks a limit raises SheetError naming it.
    """
    frame = sys._getframe(1)
    try:
        found = _declared(cls, source.cell(frame), frame.f_globals)
    except SheetError as error:
        refuse(error)
    given = [name for name in (f.name for f in found) if name in vars(cls)]
    setattr(cls, "__inputs__" if given else "__properties__", found)
    leaves = (field.leaves(vars(cls)[field.name]) for field in found if given)
    cls.__units__ = {name: leaf.unit for each in leaves for name, (leaf, _) in each.items()}  # type: ignore[attr-defined]
    cls.__worksheet__ = str(frame.f_globals.get("__file__", ""))  # type: ignore[attr-defined]
    cls.__post_init__ = _validate  # type: ignore[attr-defined]
    cls.__eq__, cls.__hash__ = _equal, _hash  # type: ignore[method-assign]
    own = {field.name: vars(cls)[field.name] for field in found if given}
    for name, value in own.items():  # arrays, which no dataclass takes as they are
        setattr(cls, name, dataclasses.field(default_factory=partial(_itself, value)))
    made = dataclass(frozen=True, eq=False)(cls)
    for name, value in own.items():
        setattr(made, name, value)
    return made


def _itself(value: Any) -> Any:
    return value


def _equal(self: Any, other: object) -> Any:
    if type(other) is not type(self):
        return NotImplemented
    return all(f.same(getattr(self, f.name), getattr(other, f.name)) for f in declared(type(self)))


def _hash(self: Any) -> int:
    values = (leaf for f in declared(type(self)) for _, leaf in f.leaves(getattr(self, f.name)).values())
    return hash(tuple(np.asarray(value).tobytes() for value in values))


_LISTED = 3  # names at most
_LOST = '; the editor loses one that ends the setup cell, so end the class with a line such as """Rows."""'


def declared(cls: type) -> tuple[Input, ...]:
    """Inputs of a class made by `inputs`, or the properties of one without values, in their order."""
    fields: tuple[Input, ...] = getattr(cls, "__inputs__" if hasattr(cls, "__inputs__") else "__properties__")
    return fields


def units_of(cls: type) -> dict[str, str]:
    """Units of the numbers of all inputs by name; of a property or a column ``bolt.R_m``."""
    units: dict[str, str] = cls.__units__  # type: ignore[attr-defined]
    return units


def _declared(cls: type, cell: source.Cell, names: Mapping[str, Any]) -> tuple[Input, ...]:
    nodes = (node for statement in cell.body for node in ast.walk(statement))  # of a setup too, which is a block
    body = next((node for node in nodes if isinstance(node, ast.ClassDef) and node.name == cls.__name__), None)
    if body is None:
        raise SheetError(f"write @inputs in the line above class {cls.__name__}: its units are read where it stands")
    folder = str(Path(names.get("__file__") or "x").resolve().parent)
    found, places, section, line = list[Input](), dict[str, str](), "", body.lineno
    written = dict[str, tuple[str, str, str]]()  # place, what is written there, and the unit of each
    for node in body.body:
        between = [cell.comments[n] for n in range(line + 1, node.lineno) if n in cell.comments]
        section, line = between[-1] if between else section, node.end_lineno or node.lineno
        if isinstance(node, ast.Assign):
            untyped = ast.unparse(node.targets[0])
            raise SheetError(f"{cell.at(node.lineno)}: input {untyped} needs a type, such as {untyped}: float = 1.0")
        if not isinstance(node, ast.AnnAssign):
            continue
        name, place = ast.unparse(node.target), cell.at(line)
        if powered := caret(node)[1]:
            raise SheetError(f"{place}, {powered}")
        if name in places:
            raise SheetError(f"{place}: input {name} stands in the class twice")
        kind, default = cls.__annotations__[name], vars(cls).get(name)
        kind = eval(kind, dict(names)) if isinstance(kind, str) else kind
        comment = cell.comments.get(line, "")
        text = lines.declared(comment, node.value)
        if text is None and kind in (int, float, list[float]) and not isinstance(default, Offer):
            last = "" if comment or node is not body.body[-1] else _LOST
            raise SheetError(f"{place}: input {name} needs a comment with its unit, such as # [m] meaning{last}")
        unit, (meaning, *parts) = text.unit if text else "-", (text.meaning if text else comment).split(";")
        allowed, deviations = (";".join(p for p in parts if deviation.is_meant(p) is meant) for meant in (False, True))
        if text and (misplaced := limits.misplaced(meaning)):
            raise SheetError(f"{place}: {misplaced} stands in the meaning of {name}: limits stand behind a ;")
        if kind is float and any(map(deviation.is_misplaced, (meaning, allowed))):
            raise SheetError(f"{place}: tolerance of {name} must stand behind a semicolon of its own, as in ; ± 0.001")
        within, mistake = tuple(limits.read(allowed, name, place)), text.mistake if text else ""
        plain = Input(name, unit, meaning.strip(), section, kind is int, within, mistake=mistake, line=line)
        if deviations:
            plain = _with_tolerance(plain, deviations, kind is float and name in vars(cls), place)
        own = _of_kind(plain, kind, default, place, folder)
        if isinstance(own, Rows):
            if own.row and allowed:
                raise SheetError(f"{place}: limits of the table {name} stand in the class of its rows")
        elif own is not plain and (unit != "-" or allowed):
            raise SheetError(f"{place}: {name} is no number and has neither unit nor limits")
        if name in vars(cls):
            try:
                setattr(cls, name, own.first(default))
            except SheetError as error:
                raise SheetError(f"{place}: {error}") from None
        found.append(own)
        places[name] = place
        bare = kind is float and isinstance(node.value, ast.Constant) and not mistake and parse(unit).factor != 1
        written[name] = place, ast.unparse(node.value) if bare and node.value else "", unit
    if without := [f.name for f in found if f.name not in vars(cls)]:
        if len(without) < len(found):
            needs = f"input {without[0]} needs a value, such as {without[0]}: float = 1.0"
            valued = [f.name for f in found if f.name not in without]
            of = ", ".join(valued) if len(valued) <= _LISTED else "the others"
            rows = f"in a class of rows or options no field has one: there that of {of} must go"
            raise SheetError(f"{places[without[0]]}: {needs}; {rows}")
        if other := next(
            (f.name for f in found if not (f.is_text or f.continuous or (type(f) is Input and f.counted))), ""
        ):
            kinds = "the fields of options and rows are floats, texts, or ints in [-], as 1 and 0 for yes and no"
            raise SheetError(f"{places[other]}: {other}: {kinds}")
    unknown = {field.name for field in found if field.mistake}
    found = [_without(field, unknown) for field in found] if unknown else found
    limits.comparable(found, places)
    cls.__places__ = written  # type: ignore[attr-defined]
    return tuple(found)


def _without(field: Input, unknown: Container[str]) -> Input:
    """An input without the limits that nothing can be compared with, as a unit is not known: another line tells it."""
    kept = (limit for limit in field.limits if limit[1] == "0" or not (field.mistake or limit[1] in unknown))
    return dataclasses.replace(field, limits=tuple(kept))


def _with_tolerance(plain: Input, text: str, varies: bool, place: str) -> Input:
    """An input whose tolerance is written so; SheetError where it has none, as only one that ``varies`` can."""
    if not varies:
        raise SheetError(f"{place}: {plain.name} has a tolerance, {text.strip()}, which only a single float can have")
    try:
        part = dataclasses.replace(plain, unit="%")
        return dataclasses.replace(plain, tolerance=deviation.read(text, plain, part))
    except SheetError as error:
        raise SheetError(f"{place}: {error}") from None


def _of_kind(plain: Input, kind: Any, default: Any, place: str, folder: str) -> Input:
    """The declaration of an input for the kind that its type says."""
    known = {field.name: getattr(plain, field.name) for field in dataclasses.fields(plain)}
    if isinstance(default, Offer):
        if not isinstance(default.options, Mapping):
            names = f'"{default.options}", "{default.name}"' if isinstance(default.options, str) else ".."
            alone = f"of names alone the type is Literal[{names}]"
            raise SheetError(f"{place}: {plain.name} is one_of(options by their names, one of these); {alone}")
        rows = list(default.options.values())
        if not rows or len({type(row) for row in rows}) > 1 or not hasattr(rows[0], "__properties__"):
            raise SheetError(f"{place}: options of {plain.name} must be objects of one class of inputs without values")
        properties = declared(type(rows[0]))
        table = tuple(tuple(getattr(row, p.name) for p in properties) for row in rows)
        return Choice(**known, options=tuple(default.options), properties=properties, table=table)
    if get_origin(kind) is Literal and all(isinstance(option, str) for option in get_args(kind)):
        return Choice(**known, options=get_args(kind))
    if get_origin(kind) is list:
        (of,) = get_args(kind)
        if of is float:
            return Rows(**known, columns=(dataclasses.replace(plain, many=True),), folder=folder)
        if hasattr(of, "__properties__"):
            own = tuple(_column_of(plain.name, each, declared(of)) for each in declared(of))
            return Rows(**known, columns=own, row=of, folder=folder)
        if hasattr(of, "__inputs__"):
            first = of.__inputs__[0].name
            raise SheetError(f"{place}: class {of.__name__} of its rows has values: write {first}: float without one")
    if kind is bool:
        return Switch(**known)
    if kind is str:
        return TextLine(**known)
    if kind not in (int, float):
        name = getattr(kind, "__name__", str(kind))
        raise SheetError(f"{place}: {plain.name} is of type {name}, which is none of {_KINDS}")
    return plain


def _column_of(table: str, column: Input, others: Iterable[Input]) -> Input:
    """A column of a table under its full name, which its limits have too."""
    names = {other.name: f"{table}.{other.name}" for other in others}
    own = tuple((sign, names.get(other, other)) for sign, other in column.limits)
    return dataclasses.replace(column, name=names[column.name], limits=own, many=True)


_KINDS = "float, int, bool, str, Literal of texts, list[float], list of a class of rows, or what one_of(..) gives"


def _validate(self: Any) -> None:
    """See that the values are within their limits: of a class whose own are, those that are others."""
    cls, fields = type(self), declared(type(self))
    if "__within__" not in vars(cls):
        cls.__within__ = hasattr(cls, "__inputs__") and not any(_refusals(cls, fields, fields))
    given = [field for field in fields if getattr(self, field.name) is not vars(cls).get(field.name)]
    for field in given:
        object.__setattr__(self, field.name, field.taken(getattr(self, field.name)))
    for refusal in _refusals(self, fields, given if cls.__within__ else fields):
        raise refusal if cls.__within__ else _at_its_line(cls, refusal)


def _at_its_line(cls: Any, refusal: SheetError) -> SheetError:
    """Why a value cannot be used; of one of the class, where it stands, and in what unit a number alone is taken."""
    name, fields = refusal.of, declared(cls)
    whole = all(hasattr(cls, field.name) for field in fields)  # a row of a table has no values of its own
    if not whole or name not in cls.__places__ or str(refusal) not in map(str, _refusals(cls, fields, fields)):
        return refusal
    place, text, unit = cls.__places__[name]
    return SheetError(f"{place}: {refusal}{f'; {alone.taken(text, unit)}' if text else ''}", name)


def unlikely(cls: Any) -> Iterator[tuple[str, str, str]]:
    """Inputs of a class whose number is hardly meant in the unit in which it is taken: name, place and why."""
    for name, (place, text, unit) in getattr(cls, "__places__", {}).items():
        if text and (why := alone.unlikely(text, unit)):
            yield name, place, f"{name} = {why}"


def _refusals(g: Any, fields: Iterable[Input], given: Iterable[Input]) -> Iterator[SheetError]:
    """Why values cannot be used, of those that are given and those whose limits name them."""
    pairs = [(field, getattr(g, field.name)) for field in fields if type(field) is Input]
    for table in (field for field in fields if isinstance(field, Rows)):
        pairs += (leaf for leaf in table.leaves(getattr(g, table.name)).values() if not leaf[0].is_text)
    names = {each.name for field in given for each in (field.columns if isinstance(field, Rows) else [field])}
    near = limits.touched((field for field, _ in pairs), names)
    compared = {name for field in near for name in (field.name, *(other for _, other in field.limits))}
    shown = {field.name: field.display(value) for field, value in pairs if field.name in compared}
    for holds, say in limits.rules(near, shown):
        if holds is not True and not np.all(holds):  # numpy is slow to say so of single ones
            yield say(int(np.argmin(holds)))


@dataclass(frozen=True, eq=False)
class Variants:
    """Many variants of some inputs: their shape, the inputs as given, their units, and why some cannot be used.

    ``reasons`` has one text for each variant, "" where all inputs are within their limits.
    """

    shape: tuple[int, ...]
    shown: dict[str, NDArray[Any]]
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
    shown: dict[str, NDArray[Any]] = {name: np.broadcast_to(column, shape) for name, (column, _) in columns.items()}
    texts: NDArray[Any] = np.full(shape, "", dtype=object)
    for _, more in columns.values():
        texts = np.where(texts == "", more, texts)
    reasons, flat = texts.ravel(), {name: column.ravel() for name, column in shown.items()}
    plain = {name: field for name, field in fields.items() if type(field) is Input}
    every = {name: flat.get(name, field.display(getattr(cls, name))) for name, field in plain.items()}
    for holds, say in limits.rules(limits.touched(plain.values(), flat.keys()), every):
        if holds is not True and not np.all(holds):
            for i in np.flatnonzero(np.broadcast_to(~np.asarray(holds), reasons.shape) & (reasons == "")):
                reasons[i] = str(say(int(i)))
    si = {name: _shared(fields[name].leaf(column, getattr(cls, name))) for name, column in flat.items()}
    lists = [field for field in fields.values() if isinstance(field, Rows)]
    compared = {other for field in lists for column in field.columns for _, other in column.limits}
    if compared & columns.keys() or any(field.name in columns for field in lists):
        for i in np.flatnonzero(reasons == ""):
            try:
                build(cls, {name: column[i] for name, column in flat.items()})
            except SheetError as error:
                reasons[i] = str(error)
    return Variants(shape, shown, {name: fields[name].unit for name in shown}, reasons, si)


def instance(cls: type[T], si: Mapping[str, Any]) -> T:
    """Inputs from values in SI that are known to be good, and the defaults."""
    g = object.__new__(cls)
    for field in declared(cls):
        object.__setattr__(g, field.name, field.held(si) if field.name in si else getattr(cls, field.name))
    return g


def _column(field: Input, given: ArrayLike) -> tuple[NDArray[Any], NDArray[np.object_]]:
    """What is given of an input, in its display unit, and the reason for each that cannot be used."""
    try:
        column = each(given) if isinstance(field, Rows) else unmasked(given)
    except ValueError:  # of rows that differ in length
        raise SheetError(f"{field.says(errors.as_given(given))} is no array of numbers") from None
    texts = np.full(column.shape, "", dtype=object)
    if column.dtype.kind in "iuf" and type(field) is Input:
        shown: NDArray[Any] = column.astype(np.float64)
    else:
        shown = np.full(column.shape, np.nan, dtype=float if type(field) is Input else object)
        for i, value in np.ndenumerate(column.astype(object)):
            try:
                shown[i] = field.read(value)
            except SheetError as error:
                texts[i] = str(error)
    return shown, texts


def each(given: Any) -> NDArray[np.object_]:
    """Lists or tables, one a variant; a text is that of all, and an array of them is as it is."""
    if isinstance(given, np.ndarray) and given.dtype == object:
        return given
    several = [given] if isinstance(given, str) else list(given)
    column = np.empty(len(several), dtype=object)
    column[:] = several if len(several) != 1 else [None]
    if len(several) == 1:
        column[0] = several[0]
    return column


def _shared(column: NDArray[Any]) -> Any:
    """What all variants have, or the column."""
    if not column.size or isinstance(column[0], dict | NoneType) or (column != column[0]).any():
        return column
    return column[0].item() if isinstance(column[0], np.generic) else column[0]


def known(fields: Mapping[str, Input], name: str) -> Input:
    """The input of that name; SheetError with the nearest names where there is none."""
    if name not in fields:
        near = errors.nearest(name, fields, 3, cutoff=0.5)
        which = f"nearest: {', '.join(near or fields)}" if fields else "the worksheet has none"
        raise SheetError(f"input {errors.cut(name)} is unknown; {which}")
    return fields[name]


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
    return [text for field in fields if field.name in values for text in field.readings(values[field.name])]


_said = dict[int, Mapping[str, object]]()  # what stood in the fields, by the identity of the inputs that were read


def read(cls: type[T], form: Any) -> T:
    """Inputs as the text fields that `ask` gives hold them, checked as in `build`."""
    try:
        if not (hasattr(cls, "__inputs__") and hasattr(form, "value")):
            raise SheetError("read takes a class of inputs and what ask gives of it: g = read(Inputs, form)")
        values: dict[str, object] = form.value
        g = build(cls, values)
    except SheetError as error:
        refuse(error)
    _said[id(g)] = values  # for the page alone, and beside g, whose attributes are the inputs
    weakref.finalize(g, _said.pop, id(g), None)
    return g


@dataclass(frozen=True, eq=False)
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
    def said(self) -> Mapping[str, object]:
        """What stood in the fields by which they were read; nothing where there were none."""
        return _said.get(id(self.g), {})

    def given(self) -> dict[str, Any]:
        """What gives these values when it is read as inputs: of a list or table its text, which is no variants."""
        return {f.name: x if type(f) is Input else f.text(getattr(self.g, f.name)) for f, x in self.rows()}

    @property
    def changed(self) -> set[str]:
        """Names of the inputs that differ from the worksheet's own."""
        cls = type(self.g)
        return {f.name for f in declared(cls) if not f.same(getattr(self.g, f.name), getattr(cls, f.name))}
