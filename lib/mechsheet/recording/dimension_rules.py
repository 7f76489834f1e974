"""Dimensions by the recording: each node has the exponents of base units that its operation makes of its operands'.

A table from operation to rule. Where the elements of a quantity are unlike, each has its own. Three kinds of numbers
stand beside the exponents: 0, infinite ones and NaN fit any dimension; a literal without a unit is a pure number where
it is multiplied and takes the other's dimension where it is added or compared; of what is unknown, or rests on a
mistake that is told, nothing is told.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.quantities.lines import Recording, Residual, Solved
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.codes import ANY, LITERAL, NUMBER, UNKNOWN, WRONG, Codes, each, kinds, only, simple
from mechsheet.recording.pinpoint import Mistake, Part, Places
from mechsheet.units import PURE, Dims
from mechsheet.worksheet import inputs
from mechsheet.worksheet import numbers as shown_numbers
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.no_inputs import inputs_of

TOLERANCE = 1e-6  # a literal below it is a tolerance, which has the unit of what it is compared with
VANISHING = 1e-50  # a literal below it, such as a complex step, is as good as 0


class Reader:
    """The dimensions of all nodes of a recording, in the order in which they were made."""

    def __init__(
        self,
        recording: Recording,
        values: Mapping[str, Any],
        namespace: Mapping[str, Any],
        lines: Iterable[Formula],
        places: Places,
    ) -> None:
        self.exponents: list[Dims | None] = [PURE, None, None, None, None]
        self.known: dict[Dims, int] = {PURE: NUMBER}
        self.products: dict[tuple[int, int, float], int] = {}
        self.recording, self.places, self.values = recording, places, values
        self.mistakes: dict[int, Mistake] = {}
        self.notes: dict[int, Mistake] = {}
        self.codes: dict[Node, Codes] = {}
        self.pivots = recording.graph.pivots
        self.wrong: set[Node] = set()
        self.told: set[tuple[int, str]] = set()
        self.unit_of = inputs.units_of(type(inputs_of(namespace)))
        self.names = {node: name for name, node in recording.inputs.items()}
        self.declared: dict[Node, list[Formula]] = {}
        for line in lines:
            value = values.get(line.name)
            for node in value.parts if isinstance(value, Quantity) else ():
                self.declared.setdefault(node, []).append(line)
                self.names.setdefault(node, line.name)
        self.used = dict.fromkeys([*(line.unit for line in lines), *self.unit_of.values()])
        self.found = {solved.node: solved for solved in recording.found.values()}
        self.equations = {solved.residual for solved in recording.found.values()}
        for node in recording.graph.nodes.values():
            self.codes[node] = RULES[node.op](self, node)
            if node in self.declared:
                self.settle(node)
        for name, check in recording.checks.items():
            self.check(name, check)
        for solved in self.found.values():
            self.solved(solved)

    def code(self, dims: Dims) -> int:
        dims = tuple(round(x, 9) for x in dims)
        known = self.known.setdefault(dims, len(self.exponents))
        if known == len(self.exponents):
            self.exponents.append(dims)
        return known

    def of_unit(self, unit: str) -> int:
        return UNKNOWN if unit == units.UNKNOWN else self.code(units.parse(unit).dims)

    def unit_of_input(self, node: Node) -> str:
        """The declared unit of an input; of a slider none is known."""
        return self.unit_of.get(self.names[node], units.UNKNOWN)

    def product(self, a: int, b: int, power: float = 1.0) -> int:
        """Code of a quantity times a power of another one."""
        known = self.products.get((a, b, power))
        if known is not None:
            return known
        first, second = self.exponents[a], self.exponents[b]
        if free := {a, b} & {WRONG, ANY, UNKNOWN}:
            result = next(code for code in (WRONG, ANY, UNKNOWN) if code in free)
        elif first is None and second is None:
            result = LITERAL
        else:
            result = self.code(tuple(p + power * q for p, q in zip(first or PURE, second or PURE, strict=True)))
        self.products[a, b, power] = result
        return result

    def power(self, a: int, power: float) -> int:
        return a if self.exponents[a] is None else self.product(NUMBER, a, power)

    def alike(self, node: Node, a: int, b: int) -> int:
        """Code of two quantities that must be alike; a mistake or a note where they are not."""
        if WRONG in (a, b):
            return WRONG
        for free in (ANY, UNKNOWN):
            if free in (a, b):
                return b if a == free else a
        if a == b:
            return a
        if LITERAL in (a, b):
            taken = b if a == LITERAL else a
            if taken != NUMBER:
                self.taken(node, taken)
            return taken
        self.tell(node, _SAID[node.op].format(self.word(a), self.word(b)), node.operands, a, b)
        return WRONG

    def number(self, node: Node, a: int) -> int:
        if self.exponents[a] is not None and a != NUMBER:
            self.tell(node, f"a quantity in {self.word(a)} where a number belongs", node.operands)
        return NUMBER

    def unfit(self, line: Formula, node: Node) -> bool:
        """Whether a value does not fit the unit that a line declares, of a function too."""
        unit = self.of_unit(line.unit)
        if wrong := [code for code in kinds(self.codes[node]) if not self.fits(code, unit)]:
            self.wrong.add(node)
        if wrong and "erratum" not in line.meaning:
            why = f"unit [{line.unit}] does not fit; the value is in {self.word(wrong[0])}"
            match self.places.literals(line.expression):
                case [literal]:
                    missing = self.word(self.product(unit, wrong[0], -1.0))
                    why += f"; {literal} has no unit, and would fit with {missing}"
                case [_, *_] as several:
                    why += f"; {', '.join(several)} have no unit"
            self.add(Mistake(self.places.line_of(line), line.name, why))
        return bool(wrong)

    def settle(self, node: Node) -> None:
        """Compare a value with its declared units; in that of the line which made it, it is taken from here on.

        Where the two do not fit, either may be wrong: what rests on them is not told as well. Lines that are not
        followed are one node where they have the same numbers, each in its own unit.
        """
        if node.op == "exported":
            own = {self.of_unit(line.unit) for line in self.declared[node] if not line.mistake}
            self.codes[node] = own.pop() if len(own) == 1 else UNKNOWN
            return
        for line in self.declared[node]:
            if line.mistake:
                continue
            unit = self.of_unit(line.unit)
            function = self.places.function_called(line.expression)
            wrong = bool(function and self.unfit(function, node)) or self.unfit(line, node)
            if node.op not in ("constant", "rows", "input") and (
                self.places.lines.get(line.name) == node.line or only(self.codes[node], UNKNOWN, LITERAL, WRONG)
            ):
                self.codes[node] = WRONG if wrong and "erratum" not in line.meaning else unit

    def check(self, name: str, check: Residual) -> None:
        """Compare the residual and the limit of a check with its unit, or with each other where none is given."""
        limit = self.one(check.limit)
        given = limit if check.unit == "-" else self.of_unit(check.unit)
        if not self.wrong.isdisjoint(self.own((*check.parts, check.limit))):
            return
        for what, part in (*(("residual", part) for part in check.parts), ("limit", check.limit)):
            code = self.one(part)
            if not self.fits(code, given):
                against = "limit" if check.unit == "-" else "unit"
                why = f"the {what} is in {self.word(code)}, its {against} in {self.word(given)}"
                line = self.places.of_check(name, (part.line, check.limit.line))
                self.add(Mistake(line, f"check {name!r}", why))
                return
        shown = next((code for code in (given, *map(self.one, check.parts)) if self.exponents[code]), NUMBER)
        if check.unit == "-" and not check.signed and shown != NUMBER:
            line = self.places.of_check(name, (*(part.line for part in check.parts), check.limit.line))
            why = f"no unit is given: shown in {self.word(shown)}"
            self.notes.setdefault(line, Mistake(line, f"check {name!r}", why))

    def solved(self, solved: Solved) -> None:
        """Compare a found value with its interval, and what it solves with the unit that is told of it."""
        own, words = self.one(solved.node), solved.words
        for end in solved.interval or ():
            if not self.fits(code := self.one(end), own):
                why = f"the interval is in {self.word(code)}, {words.unknown} in {self.word(own)}"
                self.add(Mistake(solved.node.line, "find", why))
                return
        for residual, unit, quantity in _equations(solved):
            code = self.one(residual)
            if unit != "-" and not self.fits(code, self.of_unit(unit)):
                why = f"unit [{unit}] does not fit; {quantity} is in {self.word(code)}"
                self.add(Mistake(solved.node.line, "find", why))

    @staticmethod
    def fits(code: int, other: int) -> bool:
        return code == other or bool({code, other} & {UNKNOWN, ANY, LITERAL, WRONG})

    def one(self, node: Node) -> int:
        """The code of all elements; unknown where they are unlike."""
        codes = self.codes[node]
        return codes if isinstance(codes, int) else UNKNOWN

    def tell(self, node: Node, why: str, operands: tuple[Node, ...], *codes: int) -> None:
        if (node.line, why) in self.told:
            return
        self.told.add((node.line, why))
        if node in self.equations:
            function = self.places.function_solved(node.line)
            if not (function and self.unfit(function, operands[0])):
                self.add(Mistake(node.line, "find", "the function and what it equals: " + why))
            return
        part = self.places.find(node.line, node.op, [self.leaf_names(operand) for operand in operands])
        if not self.places.is_erratum(part.line):
            self.add(Mistake(part.line, part.text, why + self.lacking(part, *codes)))

    def lacking(self, part: Part, *codes: int) -> str:
        """The number of a sum that has no unit, and would fit with one, or several of them."""
        match part.literals if codes else ():
            case [(literal, operand, power)]:
                missing = self.power(self.product(codes[1 - operand], codes[operand], -1.0), power)
                return f"; {literal} has no unit, and would fit with {self.word(missing)}"
            case [_, *_] as several:
                return f"; {', '.join(dict.fromkeys(literal for literal, *_ in several))} have no unit"
        return ""

    def add(self, mistake: Mistake) -> None:
        """Note a mistake, of a line the first."""
        self.mistakes.setdefault(mistake.line, mistake)

    def taken(self, node: Node, code: int) -> None:
        """Note a literal that takes the dimension of what it is added to or compared with."""
        literal = next((n for n in node.operands if n.op == "constant" and only(self.codes[n], LITERAL)), None)
        if literal is not None and node.op != "eq" and np.max(np.abs(literal.value)) >= TOLERANCE:
            part = shown_numbers.significant(literal.value.item(), 6) if literal.size == 1 else "numbers"
            self.notes.setdefault(node.line, Mistake(node.line, part, f"taken in {self.word(code)}"))

    def own(self, roots: Iterable[Node]) -> Iterable[Node]:
        """What quantities are made of, down to inputs and declared lines."""
        waiting, seen, first = list(roots), set[Node](), set(roots)
        while waiting:
            node = waiting.pop()
            if node in seen:
                continue
            seen.add(node)
            yield node
            if node not in self.names or (node in first and self.places.lines.get(self.names[node]) == node.line):
                waiting.extend(node.operands)

    def leaf_names(self, node: Node) -> set[str]:
        if node in self.names:
            return {self.names[node]}
        return {self.names[n] for n in self.own([node]) if n in self.names}

    def word(self, code: int) -> str:
        """A unit of these exponents: one that the worksheet uses, without its factor, or a product."""
        dims = self.exponents[code]
        if dims is None or dims == PURE:
            return "- (a number)"
        used = [units.si(unit) for unit in self.used if units.parse(unit).dims == dims]
        usual = (unit for unit in _USUAL if units.parse(unit).dims == dims)
        return shown_numbers.in_text(min(used, key=len, default=next(usual, units.word(dims))))


_USUAL = ("N", "N*m", "Pa", "W", "N/m", "N*m**2", "N*s", "N*m*s", "N*s/m")  # units of mechanics, before those of SI


def _equations(solved: Solved) -> Iterator[tuple[Node, str, str]]:
    """What a found value solves, in which unit, and its name; the first one has those beyond the unknowns as well."""
    if solved.node.op != "found":
        return
    block, number = solved.node.args
    yield block.residuals[number], solved.words.unit, solved.words.quantity
    more = zip(block.residuals, block.unit, strict=False)
    yield from ((r, u, f"equation {k}") for k, (r, u) in enumerate(more, 1) if not number and k > len(block.nodes))


# --- rules -------------------------------------------------------------------------------------------------------


def _constant(reader: Reader, node: Node) -> Codes:
    if node.args:
        return reader.of_unit(*node.args)
    return LITERAL if np.any(np.isfinite(node.value) & (np.abs(node.value + 0.0) > VANISHING)) else ANY


def _input(reader: Reader, node: Node) -> Codes:
    return reader.of_unit(reader.unit_of_input(node))


def _found(reader: Reader, node: Node) -> Codes:
    """Of the unknown's unit; where none is given that of the line which takes its value, or of its interval."""
    if node not in reader.found:
        block, number = node.args
        return NUMBER if number == len(block.nodes) else UNKNOWN  # its evaluations are counted
    solved = reader.found[node]
    if solved.words.unknown_unit != "-":
        return reader.of_unit(solved.words.unknown_unit)
    if node in reader.declared:
        return reader.of_unit(reader.declared[node][0].unit)
    ends = [reader.codes.get(end) for end in solved.interval or ()]
    return next((code for code in ends if isinstance(code, int) and code not in (ANY, LITERAL)), UNKNOWN)


def _state(reader: Reader, node: Node) -> Codes:
    codes = reader.codes[node.args[0]]
    return UNKNOWN if only(codes, LITERAL, ANY) else codes  # a number to begin with may have any unit


def _iterated(reader: Reader, node: Node) -> Codes:
    loop, number, _ = node.args
    return reader.codes[loop.following[number]]


def _mul(reader: Reader, node: Node) -> Codes:
    a, b = node.args
    return each(reader.product, reader.codes[a], reader.codes[b])


def _div(reader: Reader, node: Node) -> Codes:
    a, b = node.args
    return each(lambda p, q: reader.product(p, q, -1.0), reader.codes[a], reader.codes[b])


def _alike(reader: Reader, node: Node) -> Codes:
    a, b = node.args
    return each(lambda p, q: reader.alike(node, p, q), reader.codes[a], reader.codes[b])


def _compared(reader: Reader, node: Node) -> Codes:
    if node not in reader.pivots:
        _alike(reader, node)
    return NUMBER


def _where(reader: Reader, node: Node) -> Codes:
    condition, a, b = node.args
    if condition.op == "constant" or condition in reader.pivots:  # one order of the rows is as good as another
        return simple(np.where(condition.value, reader.codes[a], reader.codes[b]))
    return each(lambda p, q: reader.alike(node, p, q), reader.codes[a], reader.codes[b])


def _pow(reader: Reader, node: Node) -> Codes:
    base, exponent = node.args
    powers = exponent.value
    if exponent.op != "constant":
        each(lambda code: _exponent(reader, node, code), reader.codes[exponent])
    if powers.size == 1:
        return each(lambda code: reader.power(code, float(powers.item())), reader.codes[base])
    if only(reader.codes[base], NUMBER, LITERAL, ANY, UNKNOWN, WRONG):
        return reader.codes[base]
    several, where = np.unique(powers, return_inverse=True)
    return each(lambda code, k: reader.power(code, float(several[k])), reader.codes[base], where.reshape(powers.shape))


def _exponent(reader: Reader, node: Node, code: int) -> int:
    if reader.exponents[code] is not None and code != NUMBER:
        reader.tell(node, f"an exponent in {reader.word(code)}", node.args)
    return NUMBER


def _number(reader: Reader, node: Node) -> Codes:
    each(lambda code: reader.number(node, code), reader.codes[node.args[0]])
    return NUMBER


def _truth(reader: Reader, node: Node) -> Codes:
    return NUMBER


def _atan2(reader: Reader, node: Node) -> Codes:
    if only(reader.codes[node.args[1]], NUMBER):
        return _number(reader, node)
    _alike(reader, node)
    return NUMBER


def _same(reader: Reader, node: Node) -> Codes:
    return reader.codes[node.args[0]]


def _take(reader: Reader, node: Node) -> Codes:
    source, index, _ = node.args
    codes = reader.codes[source]
    return codes if isinstance(codes, int) else simple(np.broadcast_to(codes, source.shape).reshape(-1)[index])


def _at(reader: Reader, node: Node) -> Codes:
    codes = reader.codes[node.args[0]]
    if isinstance(codes, int) and codes == LITERAL:
        return UNKNOWN  # a table that is looked up may have a unit that nobody wrote
    return codes if isinstance(codes, int) else UNKNOWN  # which of the unlike elements is not known


def _join(reader: Reader, node: Node) -> Codes:
    sources, which, inside, _ = node.args
    codes = [reader.codes[source] for source in sources]
    if all(isinstance(c, int) for c in codes):
        return simple(np.array(codes)[which])
    starts = np.cumsum([0, *(source.size for source in sources)])
    flat = np.concatenate(
        [np.broadcast_to(c, source.shape).reshape(-1) for c, source in zip(codes, sources, strict=True)]
    )
    return simple(flat[starts[which] + inside])


def _reduce(reader: Reader, node: Node) -> Codes:
    source, groups, kind, _ = node.args
    codes = reader.codes[source]
    if kind in ("any", "all", "argmax", "argmin"):
        return NUMBER
    if kind != "prod" and isinstance(codes, int):
        return codes
    flat = np.broadcast_to(codes, source.shape).reshape(-1)
    result = [_folded(reader, node, kind, flat[group].tolist()) for group in groups]
    return simple(np.array(result).reshape(node.shape)) if result else UNKNOWN


def _folded(reader: Reader, node: Node, kind: str, codes: list[int]) -> int:
    if not codes:  # nothing makes 1, or a zero of any unit
        return NUMBER if kind == "prod" else ANY
    total = codes[0]
    for code in codes[1:]:
        if kind == "prod":
            total = reader.product(total, code)
        elif code != total:
            total = reader.alike(node, total, code)
    return total


_SAID = {
    "add": "adds {} and {}", "sub": "subtracts {1} from {0}", "mod": "takes the remainder of {} by {}",
    "atan2": "atan2 of {} and {}", "where": "chooses between {} and {}", "reduce": "puts {} and {} together",
    **dict.fromkeys(("max", "min", "lt", "le", "gt", "ge", "eq", "ne"), "compares {} with {}"),
}  # fmt: skip

RULES: dict[str, Callable[[Reader, Node], Codes]] = {
    "constant": _constant, "rows": lambda reader, node: LITERAL, "input": _input, "found": _found,
    "state": _state, "iterated": _iterated,
    "exported": lambda reader, node: UNKNOWN, "take": _take, "at": _at, "join": _join, "reduce": _reduce,
    "mul": _mul, "div": _div, "pow": _pow, "where": _where, "atan2": _atan2,
    "sqrt": lambda reader, node: each(lambda code: reader.power(code, 0.5), reader.codes[node.args[0]]),
    **dict.fromkeys(("add", "sub", "max", "min", "mod"), _alike),
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne"), _compared),
    **dict.fromkeys(("neg", "abs", "floor", "round", "like", "sized"), _same),
    **dict.fromkeys(("exp", "log", "sin", "cos", "tan", "asin", "acos"), _number),
    **dict.fromkeys(("sign", "and", "or", "not", "finite", "length"), _truth),
}  # fmt: skip
