"""The formulas that stand on the sheets of a workbook: of inputs, tables, found values, checks, marks and lines."""

from collections.abc import Sequence
from typing import NamedTuple

from mechsheet import units
from mechsheet.quantities.lines import Line, leaves_of
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.written import Written
from mechsheet.workbook.arrangement import Arrangement
from mechsheet.workbook.cell_formula import CellFormulas, written
from mechsheet.workbook.content import LARGEST, Content, Live, allowed, quoted
from mechsheet.workbook.place import Place
from mechsheet.workbook.text_formula import text_formula
from mechsheet.worksheet.table import Figure, Table

_LONGEST = 5000  # characters of a formula that are written twice, at most: a cell holds 8192
_KNOWN = {"input", "constant", "eq", "ne", "lt", "le", "gt", "ge", "not", "and", "or", "add", "sub", "mul", "neg"}


class Compared(NamedTuple):
    """Formulas of a check's residual and of its limit, and the limit's value."""

    residual: str
    limit: str
    bound: float


class SheetFormulas:
    """Formulas of the quantities of a recording that stand as an `Arrangement` says."""

    def __init__(self, arrangement: Arrangement) -> None:
        self.arrangement, self.recording = arrangement, arrangement.recording
        self._inverse = {solved.node: solved.inverse for solved in self.recording.found.values()}
        searched = {solved.node for solved in self.recording.found.values() if solved.searched}
        sure = {solved.node: solved.sure for solved in self.recording.found.values() if solved.sure}
        self._cells = CellFormulas(
            arrangement.places,
            arrangement.first,
            [holds for holds, guard in self.recording.guards.items() if guard.rows],
            inverse=self._inverse,
            searched=searched,
            sure=sure,
            lost=self.recording.lost,
            finite=arrangement.finite,
        )
        self._known: dict[Node, bool] = {}  # which rest on numbers that are not followed

    def name(self, node: Node) -> str:
        """Defined name of a quantity that has a place."""
        return self.arrangement.places[node].name

    def place(self, name: str) -> Place | None:
        """Where a line of the worksheet stands, its first coordinate or row; None where it has no place of its own."""
        value = self.recording.values.get(name)
        nodes = value.parts if isinstance(value, Quantity) else ()
        return next((self.arrangement.places[node] for node in nodes if node in self.arrangement.places), None)

    def column(self, table: Table, n: int) -> list[str] | None:
        """Formulas of a table's column in its display unit; None where it holds the same numbers for all inputs."""
        node = self.arrangement.columns(table)[n]
        if node is None:
            values = table.columns[n].values.tolist()
            return [self.as_exported(x).formula for x in values] if self._may_differ(table, n) else None
        if (table.number, n) in self.arrangement.own:
            return self._formulas(node)
        if label := self.recording.labels.get((table.number, n)):
            return self._labels(*label, self._cells.references(node, 1.0))
        factor = table.columns[n].factor
        if node.size == 1:
            return [self._cells.reference(node, factor)] * len(table.columns[n].values)
        return self._cells.references(node, factor)

    def _said(self, text: str | Written, same: str) -> str:
        """Formula of a text with numbers in it, while there is a number ``same``."""
        if isinstance(text, str):
            return f"=IF(ISNUMBER({same[1:]}),{quoted(text)},NA())"
        said = text_formula(text, lambda node: self._cells.reference(node)[1:], self._typed)
        return f"=IF(ISNUMBER({same[1:]}),{said},NA())"

    def _labels(self, name: str | tuple[str | Written, ...], rows: Quantity, same: Sequence[str]) -> list[str]:
        """Formulas of texts of an input: what is typed in their rows, while there is a number ``same`` of each.

        Of several texts the number says which one stands there.
        """
        if not isinstance(name, str):
            known = [quoted(text) for text in name if isinstance(text, str)]
            if len(known) < len(name):
                return [self._said(name[int(k)], x) for k, x in zip(rows.value, same, strict=True)]
            texts = ",".join(known)
            return [f"=IFERROR(CHOOSE({x[1:]}+1,{texts}),NA())" for x in same]
        place = self.arrangement.places[self.recording.inputs[name]]
        if _are_fixed(rows.re):
            cells = [place.text(k) for k in rows.value.reshape(-1).tolist()]
        else:  # of rows in an order that numbers give
            cells = [f"INDEX({self._typed(name)},{each[1:]}+1)" for each in self._cells.references(rows.re, 1.0)]
        return [f'=IF(ISNUMBER({x[1:]}),{cell}&"",NA())' for x, cell in zip(same, cells, strict=True)]

    def moves_along(self, figure: Figure) -> bool:
        """Whether the positions over which a figure is drawn, or what it marks there, rest on inputs."""
        columns = self.recording.tables.get(f"Fig {figure.number}", (None,))[:1]
        nodes = [part for column in columns if column is not None for part in column.parts]
        return bool(leaves_of([*nodes, *self.recording.marks.get(figure.number, {}).values()], self.recording))

    def exported(self, table: Table) -> tuple[int, ...]:
        """Columns of a table that rest on numbers of the worksheet's own run, and so do not follow other inputs."""
        columns = enumerate(self.arrangement.columns(table))
        return tuple(n for n, node in columns if (self.kept(node) if node else self._may_differ(table, n)))

    def _may_differ(self, table: Table, n: int) -> bool:
        """Whether nobody knows that a column of plain numbers or texts is the same for all inputs."""
        return bool(self.recording.gaps) and (table.number, n) not in self.recording.constants

    def kept(self, node: Node) -> bool:
        """Whether a quantity rests on numbers of the worksheet's own run."""
        for part in bottom_up([node], self._known) if node not in self._known else ():
            own = part.op == "exported" or self.recording.lost.get(part, False)
            own |= part.op == "found" and self._inverse.get(part) is None
            self._known[part] = own or any(self._known[operand] for operand in part.operands)
        return self._known[node]

    def line(self, line: Line) -> list[str] | None:
        """Formulas of a quantity of a section; None where it holds plain numbers."""
        plain = line.node.op == "constant" and line.node.value.dtype != bool  # 1 is not TRUE to a spreadsheet
        if plain:
            return None
        texts, holds = self._formulas(line.node), [self._cells.reference(each)[1:] for each in line.holds]
        same = f"AND({','.join(holds)})" if len(holds) > 1 else "".join(holds)
        return [f"=IF({same},{text[1:]},NA())" for text in texts] if same else texts

    def holds_infinite(self, node: Node) -> bool:
        """Whether cells of a quantity have what stands for an infinite number."""
        return node not in self.recording.lost and self._cells.endless(node)

    def reference(self, node: Node) -> str:
        """Formula of a single number that stands elsewhere, in SI."""
        return self._cells.reference(node)

    def _formulas(self, node: Node) -> list[str]:
        """Formulas in SI: of a found value its closed form, or the number while its equations are the same."""
        inverse = self._inverse.get(node)
        if inverse is None:
            return self._cells.formulas(node)
        return [self._cells.reference(inverse)] if node.size == 1 else self._cells.references(inverse, 1.0)

    def shown(self, line: Line) -> str:
        """Formula that shows a single number of a line in its display unit."""
        return self._cells.reference(line.node, units.parse(line.unit).factor)

    def found(self, unknown: str, unit: str, target_unit: str) -> tuple[str | None, ...]:
        """Formulas of a found value, what it leaves of its equation, its interval and target; None where none is."""
        solved = self.recording.found.get(unknown)
        if solved is None:
            return (None,) * 5
        factor, target = units.parse(unit).factor, units.parse(target_unit).factor
        place = self.arrangement.places.get(solved.node)
        reference = self._cells.reference
        own = not place or place.sheet == "Find"
        value = self._formulas(solved.node)[0] if own else reference(solved.node, factor)
        left = reference(solved.residual, target) if solved.residual else None
        low, high = (reference(end, factor) for end in solved.interval) if solved.interval else (None, None)
        return value, left, low, high, reference(solved.target, target) if solved.target else None

    def name_of(self, check: str) -> Content:
        """The name of a check, with the numbers and texts in it, and whether it looks at fewer positions."""
        held, said = self.recording.checks.get(check), self.recording.name_said(check)
        where = f", {held.where}" if held and held.where else ""
        return self.words(f"check {check} name", check + where, said.fixed + where if said is not None else "")

    def _typed(self, name: str) -> str:
        """Address of the cells in which the texts of an input are typed."""
        node = self.recording.inputs[name]
        place = self.arrangement.places[node]
        return place._replace(column=place.column + place.typed).range(0, node.size - 1)

    def words(self, key: str, text: str, otherwise: str = "") -> Content:
        """A title or a note: where inputs change it, what stands there ``otherwise`` for others."""
        holds, said = self.recording.worded.get(key), self.recording.said.get(key)
        if not text or holds is None:
            return text
        now, known = quoted(text), allowed(said.now) if said is not None else ""
        if said is not None and known and known in text:  # of others it is but what stands before the numbers
            before, _, behind = text.partition(known)
            now = text_formula(before + said + behind, lambda node: self._cells.reference(node)[1:], self._typed)
        if holds.op != "constant":
            now = f"IF(ISNUMBER({self._cells.reference(holds)[1:]}),{now},{quoted(otherwise)})"
        return text if now == quoted(text) else Live(f"={now}", text)

    def as_exported(self, value: float | str, otherwise: str = "") -> Live:
        """What is known for the exported inputs alone: for others no number, and no text or another one."""
        known, else_ = (quoted(value), quoted(otherwise)) if isinstance(value, str) else (written(value), "NA()")
        return Live(f"=IF({self.arrangement.changed.name}=0,{known},{else_})", value)

    def outside(self) -> str:
        """Formula of how many inputs have no value in SI units."""
        ends = dict[tuple[str, int], tuple[Place, int]]()  # of each column: its first place, and its last row
        for node in self.recording.inputs.values():
            place = self.arrangement.places[node]
            first, last = ends.get((place.sheet, place.column), (place, place.row))
            top = min(first, place, key=lambda at: at.row)
            ends[place.sheet, place.column] = top, max(last, place.row + node.size - 1)
        counts = [f"SUMPRODUCT(--ISERROR({first.range(0, last - first.row)}))" for first, last in ends.values()]
        return f"={'+'.join(counts) or '0'}"

    def kind(self, unknown: str, own: str) -> str:
        """What a found value is in the workbook: ``own`` where it is the number of the worksheet's own run."""
        solved = self.recording.found.get(unknown)
        if solved is None or solved.inverse is None:
            return own
        return solved.searched or "its closed form"

    def check(self, name: str) -> Compared | None:
        """Formulas of a check; None where it holds plain numbers."""
        check = self.recording.checks.get(name)
        if check is None:
            return None
        reference, parts = self._cells.reference, [*map(self._judged, check.parts)]
        most = parts[0] if check.signed else f"{'MIN' if check.at_least else 'MAX'}({','.join(parts)})"
        factor = units.parse(check.unit).factor
        residual = f"={most}" + (f"/{factor!r}" if factor != 1 else "")
        if factor != 1 and any(map(self.holds_infinite, check.parts)):
            size = f"ABS({most})" if check.at_least else most
            residual = f"=IF({size}<{written(LARGEST)},{residual[1:]},{most})"
        return Compared(residual, reference(check.limit, factor), check.limit.value.item() / factor)

    def _judged(self, part: Node) -> str:
        """The cells of what a check compares, which may be infinite."""
        place = self.arrangement.places.get(part)
        if not part.size:
            return "NA()"
        if place and part.size > 1:
            return place.range(0, part.size - 1)
        return place.name if place and self.holds_infinite(part) else self._cells.reference(part)[1:]

    def guard(self) -> str:
        """Formula of how many of the conditions that the worksheet's code looked at have changed; "" without any.

        Found values without a closed form are those of the worksheet's own run, while what they rest on is the same.
        """
        solved = [node for node, inverse in self._inverse.items() if inverse is None and node.op == "found"]
        holds = {*map(self._cells.while_fixed, solved)} - {""}
        holds |= {self._cells.reference(condition)[1:] for condition in self.recording.guards}
        changed = [f"IF({text},0,1)" for text in sorted(holds)]
        every, known = "+".join(changed), "+".join(f"IFERROR({text},0)" for text in changed)
        nodes = bottom_up(self.recording.guards, ())
        if len(changed) < 2 or len(every) + len(known) > _LONGEST or all(node.op in _KNOWN for node in nodes):
            return f"={every}" if every else ""
        return f"=IFERROR({every},IF({known}=0,NA(),{known}))"  # where one has changed, others may not be known

    def looked(self) -> str:
        """The lines of the worksheet whose code goes another way, or has other rows, where such a condition changes."""
        lines = sorted({guard.line for guard in self.recording.guards.values() if guard.line})
        return f"looked at in line{'s' * (len(lines) > 1)} {', '.join(map(str, lines))}" if lines else ""

    def mark(self, figure: str, label: str, unit: str) -> str | None:
        """Formula of the position that a figure marks; None where it is a plain number."""
        node = self.recording.marks.get(figure, {}).get(label)
        return self._cells.reference(node, units.parse(unit).factor) if node else None


def _are_fixed(rows: Node) -> bool:
    """Whether these are the same rows of a table whatever is computed."""
    return rows.op in ("rows", "constant") or (rows.op == "take" and _are_fixed(rows.args[0]))
