"""What of a shown value follows the inputs: the recorded quantities by their keys, and what the page makes of them."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from html import escape
from math import isfinite
from operator import attrgetter
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import chart_svg, mathml
from mechsheet.document.expression import reads
from mechsheet.document.markup import HTML, in_words, named
from mechsheet.document.parts import Line, Section, Text, texts
from mechsheet.html import offered, sketched, wording
from mechsheet.html.javascript import otherwise
from mechsheet.html.put_in import Read, put_in
from mechsheet.quantities.graph import Guard
from mechsheet.quantities.lines import SLIDER, Recording
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import Quantity, has_quantity, lift
from mechsheet.quantities.sketch import Drawn
from mechsheet.quantities.written import Said, Written
from mechsheet.readers.terms import Terms
from mechsheet.recording import showing
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.over import Axis
from mechsheet.worksheet.said import said
from mechsheet.worksheet.symbol import plain, read, stem
from mechsheet.worksheet.system import Solution
from mechsheet.worksheet.table import Column, Figure, Table, usual_decimals
from mechsheet.worksheet.terms import is_rounding, may_be_rounding, terms
from mechsheet.worksheet.title import Caption, Mark
from mechsheet.worksheet.typeset import Numbers
from mechsheet.worksheet.verdict import Verdict

Spec = dict[str, Any]  # one element of the page, as JSON


class Follower:
    """Keys of the quantities that a page shows, and the elements that show them, by their order in the page.

    What has no keys and is not ``fixed`` holds for the exported inputs alone.
    """

    def __init__(self, recording: Recording, numbers: Numbers | None = None) -> None:
        self.recording = recording
        self.numbers = numbers  # of the run, by the names that formulas read
        self._said = said(numbers.namespace) if numbers else None
        self.terms = Terms(recording.graph)
        self.keys: dict[Node, str] = {}
        self.specs: list[Spec] = []
        self.drawn: dict[int, Drawn] = {}  # recorded drawings by the identity of what is shown
        self.units: dict[str, list[Any]] = {}  # with those that measure the same
        self.told: dict[int, Said] = {}  # recorded texts by the identity of what is shown
        self.pictures: dict[int, str] = {}  # what the page cannot draw itself, by their elements
        self._asked: list[Node] = []  # for the next element
        self._slid: dict[Node, frozenset[str]] = {}
        self.texts: tuple[str, ...] = ()  # of the cell whose parts are written
        self.headings = frozenset[str]()  # of its texts with numbers those that have none
        self.why: str | None = None  # why it holds for the run's inputs alone; None where it reads nothing of others

    def pair(self, shown: Mapping[int, Sequence[Any]]) -> None:
        """Find what is recorded of the drawings that the cells show, but for those that a slider makes others."""
        for n, drawn in self.recording.drawings.items():
            own = list(showing.drawings(list(shown.get(n, ()))))
            for a, b in zip(own, drawn, strict=False) if len(own) == len(drawn) else ():
                if b is not None and not self._sliders([guard.holds for guard in b.guards]):
                    self.drawn[id(a)] = b
        for n, parts in shown.items():
            every = [one for each in self.recording.texts.get(n, ()) for one in (each, *_pieces(each))]
            for part in parts:
                match part:
                    case Caption(number, title):
                        told: list[Said | None] = [self.recording.captions.get(number)]
                    case Section(_, title) | Text(title) | str(title):
                        told = [*every]
                    case _:
                        continue
                for each in (each for each in told if each and each.text.now.rstrip() == title.rstrip()):
                    if not self._sliders([guard.holds for guard in each.guards]):
                        self.told[id(part)] = each

    def follows(self, part: Any) -> bool:
        """Whether all that a control moves in a part is recorded."""
        if isinstance(part, Line):
            held = self.recording.values.get(part.formula.name)
            if not isinstance(held, Quantity) or held.extent != np.shape(part.value):
                return False
            return not any(node.op == "exported" for node in bottom_up(held.parts, ()))
        if isinstance(part, Mark):
            return all(name in self.recording.positions for name, _ in part.positions)
        if id(part) in self.told:
            return True
        own = list(showing.drawings(part))
        return bool(own) and all(id(drawing) in self.drawn for drawing in own)

    def text(self, part: Section | Text | Caption | str, shown: Callable[[str], str]) -> str:
        """HTML of a text, by what ``shown`` makes of one; what is recorded of it follows."""
        own = part if isinstance(part, str) else part.markdown if isinstance(part, Text) else part.title
        if isinstance(part, Section) and own in self.headings:
            return shown(own)
        told = self.told.get(id(part))
        return self._written(told.text, shown, self._guards(told.guards)) if told else self.own(shown(own), own)

    def _written(self, text: Written, shown: Callable[[str], str], guards: Spec) -> str:
        pieces, now = wording.pieces(text, shown, self.key), text.now
        keys = [self.keys[node] for node in dict.fromkeys(self._asked)]
        if not pieces:
            self._asked = []
            return self.own(shown(now), now, "its numbers stand in markup that other ones would change")
        return f"<span{self.mark('text', keys=keys, pieces=pieces, **guards)}>{shown(now)}</span>"

    def _guards(self, guards: Iterable[Guard]) -> Spec:
        """Keys of the conditions under which something is known, where there are any, and why not otherwise."""
        told = [[self.key(guard.holds), otherwise(guard)] for guard in guards]
        return {"guards": told} if told else {}

    def _named(self, *names: str) -> Spec:
        """Guards of values under these names that a broken one leaves as they are: other recorded numbers are none."""
        held = ((name, self.recording.values.get(name)) for name in names)
        plain = [n for n, x in held if not isinstance(x, Quantity) or x.dtype == bool or x.re.op == "constant"]
        return self._guards({g.holds: g for name in plain for g in self.recording.looked.get(name, ())}.values())

    def own(self, shown: str, text: str = "", why: str = "") -> str:
        """What is shown for the run's inputs alone, unless it is a ``text`` as it stands in its cell."""
        if self._stands(text):
            return shown
        return shown if self.why is None else f"<span{self.mark('own', why=why or self.why)}>{shown}</span>"

    def _stands(self, text: str) -> bool:
        """Whether the cell has a text as it is."""
        return bool(text) and any(text in constant for constant in self.texts)

    def while_same(self, name: str, shown: str) -> str:
        """What is shown of a name while Python sees the same for it."""
        guards = self._guards(self.recording.looked.get(name, ()))
        return f"<div{self.mark('own', fixed=True, of=name, **guards)}>{shown}</div>" if guards else shown

    def words(self, key: str, text: str, shown: Callable[[str], str] = escape) -> str:
        """HTML of a title or a note of a table or a figure, which follows as far as it is recorded."""
        holds = self.recording.worded.get(key)
        if holds is None:
            return self.own(shown(text), text)
        if holds.op != "constant":
            self.key(holds)  # where it is not known, the text is not
        return self._written(self.recording.said.get(key, Written((text,))), shown, {})

    @property
    def wanted(self) -> dict[str, Node]:
        """Quantities by their keys."""
        return {key: node for node, key in self.keys.items()}

    def mark(self, kind: str, **spec: Any) -> str:
        """Attribute of the element that shows what this says."""
        slid = sorted(self._sliders(self._asked))
        self._asked = []
        self.specs.append({"kind": kind, **spec} | ({"slid": slid} if slid else {}))
        return f' data-n="{len(self.specs) - 1}"'

    def picture(self, follows: str, svg: str) -> str:
        """An element for the picture that the last mark says; it is kept apart, where it takes a third of the room."""
        self.pictures[len(self.specs) - 1] = svg
        return f"<div{follows}></div>"

    def key(self, node: Node) -> str:
        self._asked.append(node)
        return self.keys.setdefault(node, str(len(self.keys)))

    def _sliders(self, nodes: Iterable[Node]) -> frozenset[str]:
        """Names of the sliders that quantities rest on."""
        if not self._slid:
            self._slid = {node: frozenset([name.removeprefix(SLIDER)])
                          for name, node in self.recording.inputs.items() if name.startswith(SLIDER)}  # fmt: skip
        for node in bottom_up(nodes, self._slid):
            self._slid[node] = frozenset().union(*(self._slid[operand] for operand in node.operands))
        return frozenset().union(*(self._slid[node] for node in nodes))

    def drawing(self, drawing: Drawing) -> str:
        """Attribute of a drawing; "" of one that the recording does not hold."""
        drawn = self.drawn.get(id(drawing))
        if drawn is None:
            return ""
        told = sketched.told(drawn, self.key)
        keys = [self.keys[node] for node in dict.fromkeys(self._asked)]
        return self.mark("drawing", keys=keys, **told, **self._guards(drawn.guards))

    def unit(self, unit: str) -> str:
        """A unit, of which the page must know the others that measure the same."""
        if unit:
            self.units.setdefault(unit, offered.told(unit))
        return unit

    def positions(self) -> dict[str, str]:
        """Keys of the positions that are marked along charts, by their quantities."""
        found = {plain(name): self.key(node) for name, node in self.recording.positions.items()}
        self._asked = []
        return found

    def value(self, line: Line, **moved: Any) -> str:
        """Attribute of the value of a line, which a control may have ``moved`` along its field."""
        name, unit = line.formula.name, line.formula.unit
        held, shape = self.recording.values.get(name), np.shape(line.value)
        spec: Spec = {"unit": self.unit(unit), "of": name, **moved}
        guards = self._named(name)
        if not isinstance(held, Quantity):
            known = name in self.recording.values and not has_quantity(held)
            return self.mark("value", keys=None, fixed=known, **spec, **guards) if guards or not known else ""
        if held.extent != shape:
            spec["at"] = line.position
        else:
            spec |= self._terms(line, held)
            spec |= {"over": [self._axis(axis) for axis in line.over.axes]} if line.over else {}
        same = held.extent == shape or held.extent[:-1] == shape
        return self.mark("value", keys=[self.key(part) for part in held.parts] if same else None, **spec, **guards)

    def about_nothing(self, line: Line) -> str:
        """What stands for a value that is nothing but the rounding of what its line, or a function, adds; else ""."""
        namespace = self.numbers.namespace if self.numbers else {}
        if not is_rounding(line.value, line.formula.adding, namespace) and not self._left_over(line):
            return ""
        unit = line.formula.unit
        return f"≈ {numbers.value(np.asarray(line.value).dtype.type(0).item(), unit, offered.notation(unit))}"

    def _left_over(self, line: Line) -> bool:
        held = self.recording.values.get(line.formula.name)
        if not isinstance(held, Quantity) or not may_be_rounding(line.value, line.formula.unit):
            return False
        return numbers.is_rounding(line.value, self.terms.recorded(held).value)

    def _terms(self, line: Line, held: Quantity) -> Spec:
        """Keys of what a line adds, and of what it and all behind it add: for other inputs rounding may be left."""
        if held.dtype.kind not in "fc":
            return {}
        behind = self.terms.recorded(held)
        added = terms(line.formula.adding, self.recording.values)
        own = [abs(part).re for part in (held.real, held.imag)]
        told = {"terms": added.re} if isinstance(added, Quantity) else {}
        told |= {} if behind.re.op == "constant" or behind.re in own else {"left": behind.re}
        return {name: self.key(node) for name, node in told.items()}

    def _axis(self, axis: Axis | None) -> Spec | None:
        """The quantity along an axis of a field; None of one that is not known, or not for other inputs."""
        held = self.recording.values.get(axis.line.name) if axis else None
        if axis and isinstance(held, np.ndarray) and not self._named(axis.line.name):  # the same for all inputs
            held = lift(self.recording.graph, held)
        if not axis or not isinstance(held, Quantity):
            return None
        of, unit = axis.line.name, axis.line.unit
        told = {"factor": units.parse(unit).factor, "behind": numbers.behind(unit, HTML)}
        return {"key": self.key(held.re), "named": named(of), "of": of, "unit": self.unit(unit), **told}

    def put_in(self, line: Line, **moved: Any) -> str:
        """Attribute of the formula of a line with numbers for its symbols; "" where it has none."""
        at = self.numbers.at if self.numbers else lambda *_: None
        known = {name: x for name in reads(line.formula) if (x := at(name, line.position, line.formula.name))}
        made = put_in(line.formula, {name: Read(unit, isinstance(x, complex)) for name, (x, unit) in known.items()})
        if made is None:
            return ""
        told = [self._put_in(name, *x) for name, x in known.items()]
        spec: Spec = {"text": made.text, "signs": made.signs, "numbers": told, "at": line.position, **moved}
        spec |= {"of": line.formula.name, "keys": [self.keys[node] for node in dict.fromkeys(self._asked)]}
        heads = (name.partition(".")[0] for name in known)
        return self.mark("numbers", **spec, **self._named(*heads))

    def _put_in(self, name: str, value: complex, unit: str) -> Spec:
        """A number in a formula: the keys of its parts, or those of one that holds for the run alone."""
        head, _, part = name.partition(".")
        held: Any = self.recording.values.get(head)
        held = attrgetter(part)(held) if part and held is not None else held
        own = [value.real, value.imag] if isinstance(value, complex) else [value]
        spec: Spec = {"factor": units.parse(unit).factor, "behind": numbers.behind(unit, mathml.NUMBER)}
        if isinstance(held, Quantity) and (held.im is not None) == isinstance(value, complex):
            return spec | {"parts": [self.key(part) for part in held.parts]}
        return spec | {"parts": [_plain(x) for x in own], "own": isinstance(held, Quantity) or held is None}

    def along(self, line: Line) -> bool:
        """Whether the value of a line stands at one position of a recorded field."""
        held = self.recording.values.get(line.formula.name)
        return isinstance(held, Quantity) and held.extent != () and held.extent[:-1] == np.shape(line.value)

    def columns(self, table: Table, shown: tuple[Column, ...]) -> str:
        """Attribute of a block of columns of a table."""
        nodes = self._columns(table.number, table.columns)
        at = {id(column): n for n, column in enumerate(table.columns)}
        decimals = self.argument(f"table {table.number} decimals")
        others = {} if decimals is None else {"decimals": decimals}
        each = (self._column(c, nodes[at[id(c)]]) | self._label(table, at[id(c)]) for c in shown)
        return self.mark("table", columns=[c | others if c["decimals"] else c for c in each])

    def _label(self, table: Table, n: int) -> Spec:
        """The input whose texts a column shows, or these, and the key of which ones it does."""
        name, rows = self.recording.labels.get((table.number, n), ("", None))
        return {"label": [wording.texts(name, self.key), self.key(rows.re)]} if rows is not None else {}

    def argument(self, name: str, own: Any = None) -> Any:
        """The key of a recorded argument of what is shown, or the run's own."""
        node = self.recording.arguments.get(name)
        return own if node is None else self.key(node)

    def figure(self, figure: Figure) -> list[Spec]:
        """Columns of a figure, x first."""
        columns = (figure.x, *figure.lines)
        nodes = self._columns(f"Fig {figure.number}", columns)
        return [self._column(c, node) | _drawn(c) for c, node in zip(columns, nodes, strict=True)]

    def marks(self, figure: Figure) -> list[Spec]:
        """Marks of a figure: their labels, and keys or fixed positions in the unit of x."""
        held, found = self.recording.marks.get(figure.number, {}), list[Spec]()
        for label, x in figure.marks:
            node = held.get(label)
            at = {"x": x} if node is None or node.op == "constant" else {"key": self.key(node)}
            found.append({"drawn": chart_svg.inline([read(stem(label))]), **at})
        return found

    def _columns(self, number: str, columns: tuple[Column, ...]) -> list[Node | bool]:
        """Node of each column, whether it is fixed where there is none."""
        if (held := self.recording.tables.get(number)) is None:
            return [False] * len(columns)
        fixed = [bool(own.unit) or (number, n) in self.recording.constants for n, own in enumerate(columns)]
        return [c.re if c is not None else same for c, same in zip(held, fixed, strict=True)]

    def _column(self, column: Column, node: Node | bool) -> Spec:
        own: Spec = {"decimals": column.decimals, "power": column.power}
        own |= {"unit": self.unit(column.unit), "of": column.of}
        own |= {"usual": usual_decimals(column.unit)} if column.usual else {}
        own |= {"factor": column.factor, "rows": len(column.values)}
        if isinstance(node, bool):
            return own | {"key": None, "fixed": node, "texts": column.texts(numbers.AXIS), "values": _listed(column)}
        return own | {"key": self.key(node)}

    def check(self, check: Check) -> str:
        """Attribute of the verdict of a check."""
        held = self.recording.checks.get(check.name)
        spec = {"name": check.name, "essential": check.essential, "agreement": check.agreement}
        if held and (said := self.recording.name_said(check.name)) is not None:
            holds = self.key(self.recording.worded[f"check {check.name} name"])
            spec["title"] = wording.of_name(said, self.in_words, self.key, holds)
        if held is None:
            return self.mark("check", keys=None, **spec)
        unit, factor = (check.unit, 1.0) if held.unit == "-" else (held.unit, units.parse(held.unit).factor)
        spec["where"] = held.where  # it looks, if at some positions alone
        limit = check.limit if held.limit.op == "constant" else None  # that of a scene prevails
        return self.mark(
            "check",
            keys=[self.key(part) for part in held.parts],
            limit=limit if limit is not None else self.key(held.limit),
            own=limit is not None,
            factor=factor,
            signed=held.signed,
            least=held.at_least,
            behind=numbers.behind(unit, HTML),
            **spec,
        )

    def check_name(self, check: Check) -> str:
        """HTML of the name of a check."""
        said = self.recording.name_said(check.name)
        if said is None or check.name not in self.recording.checks:
            return self.in_words(check.name)
        shown = "".join(self.in_words(p) if isinstance(p, str) else escape(Written((p,)).now) for p in said.parts)
        return f'<span class="ms-name">{shown}</span>'

    def found(self, found: Verdict) -> str:
        """Attribute of the verdict of a solve block, with its words where the page solves it again."""
        names = self.numbers.namespace if self.numbers else {}
        name = next((name for name, value in names.items() if value is found), "")
        match found:
            case Found(words=words):
                key, told, own = f"{name}.{words.unknown}", self._of_one(found), found._value
            case Solution(words=words):
                key, told, own = f"{name}.{words.names[0]}", _of_several(found), found._values[0]
            case _:
                return self.mark("found", words=None)
        solved = self.recording.found.get(key)
        again = solved and solved.node.op == "found" and np.array_equal(solved.node.value, own, equal_nan=True)
        return self.mark("found", key=key, words=told if again else None, **self._named(name))

    def _of_one(self, found: Found) -> Spec:
        words = found.words
        return {
            "unknown": self.in_words(words.unknown, found.names),
            "quantity": self.in_words(words.quantity),
            "plain": {"unknown": escape(words.unknown), "quantity": escape(words.quantity)},
            "unit": _measured(words.unit),
            "unknown_unit": _measured(words.unknown_unit),
        }

    def in_words(self, sentence: str, names: tuple[str, ...] = ()) -> str:
        """HTML of a sentence, names of the worksheet as symbols."""
        return in_words(sentence, names, self._said)


def _of_several(found: Solution) -> Spec:
    words = found.words
    return {
        "names": [named(name) for name in found.names],
        "plain": {"names": [escape(name) for name in found.names]},
        "units": [_measured(unit) for unit in words.units],
        "equations": words.equations,
        "equation_units": [_measured(unit) for unit in words.equation_units],
        "guessed": words.guessed,
        "least": found.least,
    }


_PLACE = 0xE000  # signs of no script, each in place of what a text says otherwise for other inputs


def _pieces(said: Said) -> Iterator[Said]:
    """The headings of a text and what stands between them, each by itself."""
    others = [part for part in said.text.parts if not isinstance(part, str)]
    held = {chr(_PLACE + n): part for n, part in enumerate(others)}
    signs = iter(held)
    for piece in texts("".join(part if isinstance(part, str) else next(signs) for part in said.text.parts)):
        text = piece.title if isinstance(piece, Section) else piece.markdown
        parts = re.split(f"([{chr(_PLACE)}-{chr(_PLACE + len(held))}])", text)
        yield Said(Written(tuple(held.get(part, part) for part in parts if part)), said.guards)


def _measured(unit: str) -> tuple[float, str]:
    """Factor of a unit, and what stands behind a number."""
    return units.parse(unit).factor, escape(numbers.suffix(unit))


def _plain(x: float) -> float | None:
    """A number as JSON has it; none for what is not finite."""
    return float(x) if isfinite(x) else None


def _listed(column: Column) -> list[Any]:
    """Values of a column as JSON has them; none where it is no number."""
    return [x if isinstance(x, str) or isfinite(x) else None for x in column.values.tolist()]


def _drawn(column: Column) -> Spec:
    """What a chart and its legend write of a column."""
    name = read(stem(column.name))
    return {
        "drawn": chart_svg.inline([name]),
        "letters": len(name.mark + name.base + name.index),
        "named": named(column.name),
        "printed": "" if column.unit == "-" else units.shown(column.unit),
        "symbol": column.symbol,
    }
