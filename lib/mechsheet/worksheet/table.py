"""Tables and figures as values, one description for the page, the workbook and pandas."""

import ast
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from types import FrameType
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.mechanics.arguments import unmasked
from mechsheet.worksheet import lines, numbers, source, symbol
from mechsheet.worksheet.errors import SheetError, as_given, measured, nearest, refuse, texts
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.shown import Shown

if TYPE_CHECKING:
    import pandas as pd

_DECIMALS = {
    "m": 3, "cm": 2, "mm": 1, "deg": 1, "N": 0, "kgf": 0, "kN": 2, "Pa": 0, "MPa": 2, "kgf/cm**2": 0, "%": 1,
    "lbf": 0, "ksi": 2, "psi": 0, "bar": 2, "kgf*cm": 0, "kgf/cm": 1, "N*m": 0, "N/mm": 1, "mm**2": 1,
    "cm**4": 1, "mm**4": 0, "mm**3": 0, "ms": 1, "us": 1, "um": 1, "W": 1, "kPa": 1, "GPa": 2, "g": 1, "km/h": 1,
    "mm/s": 1, "deg/s": 1, "N*mm": 0, "daN": 1, "L/min": 2, "Hz": 2,
}  # fmt: skip
MARKED = 60  # points of a curve that are marked one by one; more of them hide the line


@dataclass(frozen=True, eq=False)
class Column:
    """One quantity over the rows of a table: its symbol, display unit, meaning and values in that unit.

    Values may be a list, which becomes an array, and texts, of unit "". ``power`` shows numbers as 1.2e-15; those of
    ``unlike`` quantities, in one column, have each digits of their own. ``of`` is the name that the line declares, of a
    field without its ``_S``; ``want`` is what stands in the worksheet, a name or a part of one. Texts that are
    ``names`` of quantities stand on the page as their symbols. Decimals that are ``usual`` are as many as
    its numbers ask for.
    """

    symbol: str
    unit: str
    meaning: str
    decimals: int
    values: NDArray[Any]
    power: bool = False
    of: str = ""
    want: str = ""
    names: bool = False
    unlike: bool = False
    usual: bool = False

    def __post_init__(self) -> None:
        if isinstance(self.values, list):
            kind = object if any(isinstance(value, str) for value in self.values) else None
            object.__setattr__(self, "values", np.array(self.values, kind))
        array = self.values if isinstance(self.values, np.ndarray) else None
        rows = array is not None and array.ndim == 1 and array.dtype.kind != "c"
        if not rows and (array is not None or isinstance(self.values, str | complex | float | int | None)):
            told = "must be real numbers or texts, one a row"
            refuse(SheetError(f"column {self.symbol}: its values {told}, not {as_given(self.values)}"))
        if array is not None:
            object.__setattr__(self, "values", unmasked(array))
        if not isinstance(self.decimals, int) or self.decimals < 0:
            given = as_given(self.decimals)
            refuse(SheetError(f"column {self.symbol}: its decimals must be a whole number >= 0, not {given}"))

    @property
    def name(self) -> str:
        """What it is called: as the line declares it, of a part as its heading is."""
        return self.of if symbol.plain(self.of) == self.symbol else self.symbol

    @property
    def factor(self) -> float:
        """Of the display unit, to SI; 1 without one."""
        return units.parse(self.unit).factor if self.unit else 1.0

    def texts(self, to: numbers.Notation = numbers.CELL) -> list[str]:
        """The values as they are shown."""
        if self.unlike:
            return [numbers.usual(v, to) for v in self.values.tolist()]
        written = numbers.scientific if self.power else numbers.fixed
        return [v if isinstance(v, str) else written(v, self.decimals, to) for v in self.values.tolist()]

    @property
    def number_format(self) -> str:
        """How a spreadsheet program shows its numbers."""
        return "General" if self.unlike else numbers.fixed(0, self.decimals) + ("E+00" if self.power else "")


@dataclass(frozen=True, eq=False)
class Table(Shown):
    """A numbered table; all columns have the same length, the first ones of whole numbers name the rows.

    Without rows, such as those for which a condition holds nowhere, it is shown as one that has none.

    What its note says is the name of a quantity where the worksheet has it, or it is one of those ``said``.
    """

    number: str
    title: str
    columns: tuple[Column, ...]
    note: str = ""
    every: int = 1  # only every so many positions are listed
    said: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        _some_columns(f"table {self.number}", self.columns)

    def head(self, count: int) -> "Table":
        """The table with its first rows alone, which its note says."""
        columns = tuple(replace(column, values=column.values[:count]) for column in self.columns)
        rows = len(self.columns[0].values)
        cut = f" The first {count} of {rows} rows; the workbook holds all." if rows > count else ""
        return replace(self, columns=columns, note=f"{self.note}{cut}".strip())

    def frame(self) -> "pd.DataFrame":
        """The table as a pandas DataFrame, headings ``symbol [unit]``."""
        import pandas as pd  # on use: a worksheet shows its tables without

        return pd.DataFrame({f"{c.symbol} [{c.unit}]" if c.unit else c.symbol: c.values for c in self.columns})


@dataclass(frozen=True, eq=False)
class Figure(Shown):
    """A numbered line chart of some columns over another; ``marks`` are labelled positions on the x axis."""

    number: str
    title: str
    x: Column
    lines: tuple[Column, ...]
    marks: tuple[tuple[str, float], ...] = ()
    every: int = 1  # only every so many positions are marked by a point

    def __post_init__(self) -> None:
        _some_columns(f"figure {self.number}", (self.x, *self.lines), 2)

    logarithmic: ClassVar[bool] = False  # both axes

    def series(self) -> list[tuple[Column, slice, str]]:
        """Curves: a column over which rows, and a name for what it is where that is not its symbol."""
        return [(line, slice(0, len(line.values)), "") for line in self.lines]

    def chart(self) -> Any:
        """The figure as an altair chart, to be changed, combined or saved; the page draws its own, which is faster."""
        import altair as alt  # on use: the page draws its own

        names = [symbol.text(c.name) for c in self.lines]
        curves = [
            [
                {"x": float(x), "y": float(y) if np.isfinite(y) else None, "line": name}  # None is a gap
                for x, y in zip(self.x.values, column.values, strict=True)
            ]
            for column, name in zip(self.lines, names, strict=True)
        ]
        y_title = f"{', '.join(names)} [{units.shown(self.lines[0].unit)}]"
        base = alt.Chart(alt.InlineData([row for curve in curves for row in curve])).encode(
            x=alt.X(
                "x:Q",
                title=f"{symbol.text(self.x.name)} [{units.shown(self.x.unit)}]",
                scale=alt.Scale(zero=False, nice=False),
            ),
            y=alt.Y("y:Q", title=y_title, scale=alt.Scale(zero=False)),
            color=alt.Color(
                "line:N", title=None, sort=names, legend=alt.Legend(orient="top") if len(names) > 1 else None
            ),
            tooltip=[
                alt.Tooltip("line:N", title="quantity"),
                alt.Tooltip("x:Q", title=symbol.text(self.x.name), format=f".{self.x.decimals}f"),
                alt.Tooltip("y:Q", title="value", format=f",.{self.lines[0].decimals}f"),
            ],
        )
        layers = [base.mark_line()]
        if self.x.values[:: self.every].size <= MARKED:
            listed = alt.InlineData([row for curve in curves for row in curve[:: self.every]])
            layers.append(base.mark_point(filled=True, size=36).properties(data=listed))
        for name, x in self.marks:
            at = alt.Chart(alt.InlineData([{"x": x, "name": name}])).encode(x="x:Q")
            layers += [
                at.mark_rule(strokeDash=[5, 4], opacity=0.6),
                at.mark_text(align="left", dx=4, y=8, fontSize=12).encode(text="name:N"),
            ]
        title = f"Figure {self.number} – {self.title}"
        sharp = {"embedOptions": {"renderer": "svg"}}  # on paper too
        return alt.layer(*layers).properties(title=title, width=620, height=300, usermeta=sharp)


def table(
    number: str,
    title: str,
    *columns: Any,
    show: Mapping[str, str] | None = None,
    note: str = "",
    decimals: int | None = None,
    every: int = 1,
) -> Table:
    """Table of the given quantities: symbols, units and meanings are read from the lines that define them.

    An argument is a name, an input such as ``g.F``, ``g.bolts.x`` or, of texts, ``g.bolts.name``, in another order
    ``g.bolts.name[order]``, ``P23_S.real`` or ``.imag`` (columns X23, Y23 of a point, R56x, R56y of a force) or
    ``abs(R56)`` (column R56). A name may be one of texts or dates too, in an array or a list. Quantities over
    several axes are listed with the last one running fastest. ``show`` gives another display unit for some columns,
    by heading or as the argument is written. ``note`` stands below the table. ``decimals`` are printed in all
    columns, by default as many as the unit asks for; whole numbers have none. ``every`` lists only every so many
    positions, from the first.
    """
    _named("table", number, title, every)
    if not (decimals is None or (isinstance(decimals, int | np.integer) and decimals >= 0)):
        must = "must be a whole number from 0 on"
        refuse(SheetError(f"table {number}: decimals {must}, not {as_given(decimals)}"))
    frame = sys._getframe(1)
    nodes = source.call(frame).args[2:]
    found = _columns(f"table {number}", frame, nodes, columns, show or {}, decimals, every)
    return Table(number, title, found, note, every)


def figure(
    number: str,
    title: str,
    x: Any,
    *lines: Any,
    marks: Mapping[str, float] | None = None,
    show: Mapping[str, str] | None = None,
    every: int = 1,
) -> Figure:
    """Line chart of the given quantities over ``x``, read as in `table`; ``marks`` are positions in SI.

    ``every`` marks only every so many positions of a smooth curve by a point: those that a table lists.
    """
    _named("figure", number, title, every)
    if not isinstance(marks or {}, Mapping):
        must = "must be positions by their names, such as {'phi_1': phi_1}"
        refuse(SheetError(f"figure {number}: marks {must}, not {as_given(marks)}"))
    frame = sys._getframe(1)
    first, *rest = _columns(f"figure {number}", frame, source.call(frame).args[2:], (x, *lines), show or {})
    factor = units.parse(first.unit).factor
    return Figure(number, title, first, tuple(rest), tuple((k, v / factor) for k, v in (marks or {}).items()), every)


def _named(kind: str, number: object, title: object, every: object) -> None:
    """Refuse a number or title that is no text, and a step from position to position that is none."""
    texts(kind, number=number)
    texts(f"{kind} {number}", title=title)
    if not isinstance(every, int | np.integer) or every < 1:
        must = "must be a whole number from 1 on"
        refuse(SheetError(f"{kind} {number}: every {must}, not {as_given(every)}"))


def _columns(
    of: str,
    frame: FrameType,
    nodes: list[ast.expr],
    values: tuple[Any, ...],
    show: Mapping[str, str],
    decimals: int | None = None,
    every: int = 1,
) -> tuple[Column, ...]:
    known, columns = lines.registry(frame.f_globals), []
    values = tuple(map(numbers.existing, values))
    nodes = source.listed(nodes)
    rows = _as_long_as_each_other(nodes, values, every)
    called = dict[str, str]()  # columns by what they may be called in ``show``
    for node, value, row in zip(nodes, values, rows, strict=True):
        node = _of_texts(node, value)
        given = _input(frame.f_globals, node) or _texts_of(frame.f_globals, value)
        name, part = _name(node) if not given or isinstance(node, ast.Name) else (_of_table(node), "")
        is_label = bool(given and given.is_text and np.ndim(value)) and of.startswith("table")
        said = None if is_label or not of.startswith("table") else as_texts(value)
        if said is not None and said.ndim:
            columns.append(Column(heading(name), "", _meaning(known, name), 0, as_texts(row)))  # type: ignore[arg-type]
            called |= dict.fromkeys((heading(name), name, ast.unparse(node)), heading(name))
            continue
        if (kind := np.asarray(value).dtype.kind) not in "iufb" and not is_label:
            why = _NOT_SHOWN.get(kind if kind == "c" or of.startswith("table") else "", "no number")
            why = why.replace("NAME", name)
            refuse(SheetError(f"column {ast.unparse(node)}: {name} is {why}"))
        try:
            line = given or known[name]
        except KeyError:
            place = lines.on_one_way(frame.f_globals, name)
            within = f"that at {place} stands within a loop, or not on all ways of a choice or a try"
            why = within if place else "such as # [m] meaning"
            refuse(SheetError(f"column {ast.unparse(node)}: no line declares {name} with its unit, {why}"))
        except SheetError as error:
            refuse(error)
        label = heading(name, part)
        of_table = given and isinstance(node, ast.Attribute) and isinstance(node.value, ast.Attribute)
        if of_table or (
            given and symbol.read(name).base in symbol.LETTERS and symbol.read(label).base not in symbol.LETTERS
        ):
            label = name  # mu_k is μ with an index, muk is a word; so is the m of the parts, m_parts
        own, names = "" if given else symbol.stem(name), (label, ast.unparse(node), *([] if part else [name]))
        called |= dict.fromkeys(names, label)
        unit = next((_shown_in(of, label, line.unit, show[n]) for n in names if n in show), line.unit)
        if is_label:
            columns.append(Column(line.name.rpartition(".")[2], "", line.meaning, 0, row))
            continue
        shown = np.asarray(row) / units.parse(unit).factor
        counts = kind in "iu" or bool(given and given.whole)
        usual = decimals is None and kind == "f" and not counts
        places = 0 if counts else usual_decimals(unit) if decimals is None else decimals
        places = numbers.enough(shown, places) if usual else places
        want = "" if given else ast.unparse(node)
        columns.append(Column(label, unit, line.meaning, places, shown, of=own, want=want, usual=usual))
    for name in show:
        if name not in called:
            near = nearest(name, called, cutoff=0.5)
            offered = f"nearest: {', '.join(near or dict.fromkeys(called.values()))}"
            refuse(SheetError(f"{of}: show has {as_given(name)}, which is no column; {offered}"))
    return tuple(columns)


def _shown_in(of: str, label: str, own: str, unit: str) -> str:
    """The other unit in which a column is shown, in signs that Python reads; its own where that is not known."""
    says = f"{of}: show of {label} = {as_given(unit)}"
    texts(says, unit=unit)
    if own == units.UNKNOWN:
        return own
    if measured(unit, says).dims != units.parse(own).dims:
        refuse(SheetError(f"{says}: {unit} does not measure {numbers.in_text(own)}"))
    other = units.plain(unit)
    if units.turned(other, own) or other == "degC" != own:
        refuse(SheetError(f"{says}: a column in {numbers.in_text(own)} is another number there"))
    return other


def _as_long_as_each_other(nodes: list[ast.expr], values: tuple[Any, ...], every: int) -> list[NDArray[Any]]:
    try:
        return listed(values, every)
    except ValueError:
        lengths = ", ".join(f"{len(v)} of {ast.unparse(n)}" for n, v in zip(nodes, values, strict=True) if np.ndim(v))
        refuse(SheetError(f"columns must be as long as each other, not {lengths}"))


def listed(values: Sequence[Any], every: int) -> list[NDArray[Any]]:
    """Quantities at every so many positions of the shape that they have together, the last axis running fastest."""
    whole = np.broadcast_arrays(np.zeros(1), *values)[1:]
    some = [value[..., ::every] for value in whole] if every > 1 else whole
    return [value.reshape(-1) if value.ndim > 1 else value for value in some]


def usual_decimals(unit: str) -> int:
    """Decimals of a number in a display unit."""
    return _DECIMALS.get(unit, 3)


def _some_columns(what: str, columns: tuple[Column, ...], least: int = 1) -> None:
    """Refuse what would be shown with fewer columns, or with some of another length: it would look like a result."""
    if isinstance(columns, Column) or not all(isinstance(column, Column) for column in columns):
        refuse(SheetError(f"{what}: its columns must be several of Column, not {as_given(columns)}"))
    if len({column.values.size for column in columns}) > 1:
        lengths = ", ".join(f"{column.values.size} of {column.name}" for column in columns)
        refuse(SheetError(f"{what}: columns must be as long as each other, not {lengths}"))
    if len(columns) < least:
        refuse(SheetError(f"{what} needs at least {least} column{'s' * (least > 1)}"))


def _input(namespace: Mapping[str, Any], node: ast.expr) -> Input | None:
    """The declaration of a column that is an input, such as ``g.F`` or ``g.bolts.x``."""
    head, _, name = ast.unparse(node).partition(".")
    given = namespace.get(head)
    fields: tuple[Input, ...] = getattr(type(given), "__inputs__", ())
    leaves = (field.leaves(getattr(given, field.name)) for field in fields)
    return next((each[name][0] for each in leaves if name in each), None)


def _of_texts(node: ast.expr, value: Any) -> ast.expr:
    """Of texts in another order, ``g.bolts.name[order]``, those that are put in order; any other column itself."""
    return node.value if isinstance(node, ast.Subscript) and np.asarray(value).dtype.kind == "O" else node


def _texts_of(namespace: Mapping[str, Any], value: Any) -> Input | None:
    """The declaration of the column of texts that a value is of, in any order, whatever the worksheet calls it."""
    if not isinstance(value, np.ndarray) or value.dtype != object:
        return None
    texts = {*map(id, value)}
    tables = (
        (field, getattr(given, field.name))
        for given in namespace.values()
        for field in getattr(type(given), "__inputs__", ())
    )
    every = ((leaf, getattr(table, leaf.name.rpartition(".")[2], ()))
             for field, table in tables for leaf, _ in field.leaves(table).values() if leaf.is_text)  # fmt: skip
    return next((leaf for leaf, held in every if held is value or (texts and texts <= {*map(id, held)})), None)


def as_texts(value: Any) -> NDArray[Any] | None:
    """Texts of an array or a list, dates as they are written; None of what holds anything else."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows that are not as long as each other
        return None
    if array.dtype.kind == "M":
        return np.array(np.datetime_as_string(array), object)
    if array.dtype.kind not in "OU" or not all(isinstance(each, str | date) for each in array.flat):
        return None
    return np.array([str(each) for each in array.flat], object).reshape(array.shape)


def _meaning(known: Mapping[str, Any], name: str) -> str:
    """What a line says of texts, which have no unit."""
    try:
        return str(known[name].meaning)
    except (KeyError, SheetError):
        return ""


_NOT_SHOWN = {
    "c": "a point or a force: take NAME.real and NAME.imag, or abs(NAME)",
    **dict.fromkeys("OU", "neither a number nor a column of texts"),
}


def _of_table(node: ast.expr) -> str:
    """Name of an input; of the column ``g.bolts.x`` of a table ``x_bolts``."""
    return "_".join(reversed(ast.unparse(node).split(".")[1:]))


def _name(node: ast.expr) -> tuple[str, str]:
    match node:
        case ast.Name(name):
            found = name, ""
        case ast.Attribute(ast.Name(name), ("real" | "imag") as part):
            found = name, part
        case ast.Call(ast.Name("abs"), [ast.Name(name)]):
            found = name, ""
        case _:
            refuse(
                SheetError(
                    f"column {ast.unparse(node)}: a column is a name, an input, name.real, name.imag or abs(name)"
                )
            )
    return found


def heading(name: str, part: str = "") -> str:
    """Heading of the column of a quantity, or of its part ``real`` or ``imag``.

    >>> heading("P23_S", "real"), heading("R56", "imag"), heading("phi3_S")
    ('X23', 'R56y', 'phi3')
    """
    name = symbol.plain(name)
    if not part:
        return name
    axis = {"real": "x", "imag": "y"}[part]
    return axis.upper() + name[1:] if name.startswith("P") else name + axis
