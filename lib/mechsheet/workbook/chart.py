"""Charts of a workbook, and the sheet Marks that their vertical lines are drawn from."""

from collections.abc import Callable, Container, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.units import shown
from mechsheet.workbook import axis, looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.cell_formula import AGGREGATE
from mechsheet.workbook.content import Content, Live, allowed, caption, fits
from mechsheet.workbook.place import Place
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.workbook.table_sheet import Spot
from mechsheet.worksheet.table import Column, Figure


class Listed(NamedTuple):
    """Columns of a figure or table, where they stand, and which places hold for the exported inputs only."""

    columns: Sequence[Column]
    source: str
    place: Callable[[Column], Place]
    grey: Container[int]


class Charts:
    """The charts of a workbook; what their figures show and mark is noted for the sheets Front and Marks."""

    def __init__(self, book: Book, formulas: SheetFormulas | None) -> None:
        self._book, self._formulas = book, formulas
        self.drawn: list[Listed] = []
        self._marked: list[tuple[Content, ...]] = []

    def insert(
        self, sheet: Any, spot: Spot, figure: Figure, name: str, columns: Sequence[Column], grey: Container[int]
    ) -> None:
        """Draw a figure on a sheet, from the cells of ``columns``, some ``grey``, which stand on the sheet ``name``."""

        def place(column: Column) -> Place:
            return Place("", name, looks.FIRST, next(n for n, c in enumerate(columns) if same_column(column, c)))

        thinned = self._formulas is not None and self._formulas.recording.every > 1
        source = f"figure {figure.number}" + (", at the listed positions" if thinned else "")
        self.drawn.append(Listed(figure.lines, source, place, grey))
        chart = self._chart(figure, place)
        chart.set_size({"width": spot.width, "height": spot.height})
        inside = {"x_offset": spot.right, "y_offset": spot.down, "object_position": 2}
        said = self._caption(figure)
        told = f"Figure {figure.number}" if isinstance(said, Live) else caption("Figure", figure)  # as it stays
        sheet.insert_chart(spot.row, spot.column, chart, {**inside, "description": told})

    def marks(self) -> None:
        """The sheet Marks, where a figure marks anything."""
        fields = (
            *(("Figure", looks.TEXT), ("Mark", looks.TEXT), ("x", looks.VALUE), ("x", looks.VALUE)),
            *(("y from", looks.NUMBER), ("y to", looks.NUMBER)),
        )
        if self._marked:
            title = "Ends of the vertical lines in the figures"
            self._book.listing("Marks", title, fields, self._marked, behind=True)

    def _chart(self, figure: Figure, place: Callable[[Column], Place]) -> Any:
        chart = self._book.file.add_chart({"type": "scatter", "subtype": "straight_with_markers"})
        for n, (line, part, called) in enumerate(figure.series()):
            chart.add_series(_curve(n, figure.x, line, part, called, place))
        scale = axis.decades if figure.logarithmic else axis.linear
        x = scale(np.append(figure.x.values, [at for _, at in figure.marks]), figure.x.unit)
        y = scale(np.concatenate([line.values for line in figure.lines]))
        for label, at in figure.marks:
            chart.add_series(self._mark(figure, label, at, (y["min"], y["max"]), place))
        title = {"name": self._title(figure), "name_font": {**looks.CHART, "size": 11, "bold": True}}
        chart.set_title(title)
        if self._formulas:  # written ends would cut what other inputs give
            x, y = _following(x) if self._formulas.moves_along(figure) else x, _following(y)
        chart.set_x_axis({**looks.AXIS, **x, "name": _label(_quantity([figure.x]))})
        chart.set_y_axis({**looks.AXIS, **y, "name": _label(_quantity(figure.lines))})
        lines = len(figure.series())
        marks = list(range(lines, lines + len(figure.marks)))
        chart.set_legend({"position": "bottom" if lines > 1 else "none", "font": looks.CHART, "delete_series": marks})
        chart.set_chartarea({"border": {"color": "#BFBFBF"}})
        chart.show_na_as_empty_cell()
        return chart

    def _title(self, figure: Figure) -> str:
        """A text, or a reference to one on the sheet Marks that inputs change."""
        said = self._caption(figure)
        if not isinstance(said, Live):
            return _label(caption("Figure", figure))
        self._marked.append((said, "title", "", "", "", ""))
        return f"=Marks!$A${len(self._marked) + 2}"

    def _caption(self, figure: Figure) -> Content:
        own, number = caption("Figure", figure), f"Figure {figure.number}"
        return self._formulas.words(f"figure {figure.number} title", own, number) if self._formulas else own

    def _mark(
        self, figure: Figure, label: str, at: float, ends: tuple[float, float], place: Callable[[Column], Place]
    ) -> dict[str, Any]:
        """A vertical line, whose ends are noted for the sheet Marks."""
        row = len(self._marked) + 2
        x: Content = at
        y: Sequence[Content] = ends
        if formula := self._formulas and self._formulas.mark(figure.number, label, figure.x.unit):
            x = Live(formula, at)
            values = np.concatenate([line.values for line in figure.lines])
            numbers = values[np.isfinite(values)]
            ranges = ",".join(place(line).range(part.start, part.stop - 1) for line, part, _ in figure.series())
            known = [end(numbers).item() if numbers.size else np.nan for end in (np.min, np.max)]
            y = [Live(f"={AGGREGATE}({of},6,{ranges})", end) for of, end in zip((5, 4), known, strict=True)]
        self._marked.append((self._caption(figure), label, x, x, *y))
        return {
            "name": ["Marks", row, 1],
            "categories": ["Marks", row, 2, row, 3],
            "values": ["Marks", row, 4, row, 5],
            "line": {"color": "#404040", "width": 1, "dash_type": "dash"},
            "marker": {"type": "none"},
            "data_labels": {
                "series_name": True,
                "position": "right",
                "font": looks.CHART,
                "custom": [{"delete": True}],
            },
            "smooth": False,
        }


def _following(scale: dict[str, Any]) -> dict[str, Any]:
    """An axis whose ends the spreadsheet program takes from the numbers that it shows."""
    return {"log_base": scale["log_base"], "crossing": "min"} if "log_base" in scale else {}


def same_column(a: Column, b: Column) -> bool:
    """Whether two columns hold the same quantity."""
    return a is b or ((a.symbol, a.unit) == (b.symbol, b.unit) and np.array_equal(a.values, b.values, equal_nan=True))


def _curve(n: int, x: Column, y: Column, part: slice, called: str, place: Callable[[Column], Place]) -> dict[str, Any]:
    """The n-th curve of a chart, over some rows of its columns."""
    color = looks.COLORS[n % len(looks.COLORS)]
    marker = {"type": looks.MARKERS[n % len(looks.MARKERS)], "size": 5, "border": {"color": color}}

    def cells(column: Column) -> list[str | int]:
        at = place(column)
        return [at.sheet, at.row + part.start, at.column, at.row + part.stop - 1, at.column]

    return {
        "name": called or [place(y).sheet, 2, place(y).column],
        "categories": cells(x),
        "values": cells(y),
        # What a viewer draws that reads no cells; without it #N/A would be a zero there.
        "categories_data": _drawn(x.values[part]),
        "values_data": _drawn(y.values[part]),
        "line": {"color": color, "width": 1.75, "dash_type": looks.DASHES[n // 2 % len(looks.DASHES)]},
        "marker": {**marker, "fill": {"color": color}} if part.stop - part.start <= looks.LONG else {"type": "none"},
        "smooth": False,
    }


def _drawn(values: NDArray[np.float64]) -> list[float | None]:
    return [float(value) if fits(value) else None for value in values]


def _label(text: str) -> str:
    """Text of a chart, which XlsxWriter would take for a reference where it holds one such as ``!A1``."""
    return allowed(text).replace("!", "! ")


def _quantity(columns: Sequence[Column]) -> str:
    """Symbols and units of what an axis shows: ``S [m]``, ``G56, GS6 [N]``, ``R56 .. R01 [N]``."""
    parts = []
    for unit, members in groupby(columns, key=lambda column: column.unit):
        symbols = [column.symbol for column in members]
        names = ", ".join(symbols) if len(symbols) <= 4 else f"{symbols[0]} .. {symbols[-1]}"
        parts.append(f"{names} [{shown(unit)}]")
    return ", ".join(parts)
