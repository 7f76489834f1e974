"""Statements of a function in JavaScript for the nodes of a recording: names, numbers alone, loops over fields."""

from bisect import insort
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from heapq import heapify, heappop, heappush
from itertools import groupby
from operator import itemgetter

from mechsheet.html.elementwise import ELEMENTWISE, REFUSING, Text, array, literal, names, operation
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.refused import is_pythons
from mechsheet.worksheet.errors import SheetError

_CONST = "const "
Size = tuple["int | Node", ...]  # lengths of all axes: numbers, and quantities of those that follow the inputs
Rule = Callable[["Scope", Node], str]
_DEEPEST = 20  # operations in one another in an expression


class Program:
    """What the functions of a script share: names, constant fields, and the ``rules``.

    ``rules`` are of operations that are not elementwise: each gives the expression of a node in a scope.
    """

    def __init__(self, graph: Graph, rules: Mapping[str, Rule], taken: frozenset[str]) -> None:
        self.graph, self.rules = graph, rules
        self.inputs: dict[Node, str] = {}  # how a function gets them
        self.conditions: dict[object, str] = {}  # names of what must hold, by the numbers that rest on it
        self.constants: dict[str, str] = {}  # names by their text
        self._names = names(taken)
        self._own: dict[Block, set[Node]] = {}

    def name(self) -> str:
        return next(self._names)

    def constant(self, text: str) -> str:
        """The name of what is computed once."""
        return self.constants.get(text) or self.constants.setdefault(text, self.name())

    def size(self, node: Node) -> Size:
        return tuple(n.value.item() if n in self.graph.fixed else n for n in self.graph.size(node))

    def tells(self, node: Node, length: "int | Node") -> bool:
        """Whether only the node itself tells this length, or what a search for it leaves."""
        if isinstance(length, int) or length.op != "length":
            return False
        source = length.args[0]
        return source is node or (node.op == "found" and source in self._resting(node.args[0]))

    def _resting(self, block: Block) -> set[Node]:
        """Unknowns of a block, and what is made of them for its residuals."""
        if block not in self._own:
            own = self._own[block] = set(block.nodes)
            own.update(n for n in bottom_up(block.residuals, own) if not own.isdisjoint(n.operands))
        return self._own[block]


class Scope:
    """One function: ``lines`` are its statements, ``names`` what its nodes are called, those around it included.

    With ``each`` every field counts as a number: that of one problem.
    """

    def __init__(self, program: Program, known: Mapping[Node, str], each: bool = False) -> None:
        self.program, self.each = program, each
        self.names: dict[Node, str] = dict(known)
        self.lines: list[str] = []
        self.solved: dict[object, str] = {}  # names of what is found, by its block or loop
        self._shapes: dict[Node, str] = {}  # of fields whose shape their operands tell alone
        self._spread: dict[tuple[Node, str], str] = {}
        self._inside = set[Node]()  # which stand in the expression of another one
        self._users = defaultdict[Node, set[Node | None]](set)
        self._place: dict[Node, int] = {}  # in the order of what is written here
        self._missing: dict[Node, int] = {}  # how many others it still waits for
        self._fields = list[tuple[int, Node]]()  # that wait for nothing but their loop, by their place
        self._keys: dict[Node, Size | Node] = {}

    def inner(self, known: Mapping[Node, str], each: bool = False) -> "Scope":
        """A function in this one, where some nodes have other names."""
        scope = Scope(self.program, {**self.names, **known}, each)
        scope._shapes, scope._spread = dict(self._shapes), dict(self._spread)
        return scope

    def bind(self, text: str) -> str:
        """The name of a new constant."""
        name = self.program.name()
        self.lines.append(f"{_CONST}{name}={text};")
        return name

    def text(self, node: Node) -> str:
        """A number, or a field as a whole."""
        if node in self.names:
            return self.names[node]
        if node not in self.program.graph.fixed:
            raise SheetError(f"line {node.line}: what is computed there is used before it: no page can follow that")
        return self.program.constant(array(node.value)) if node.shape else literal(node.value.item()).text

    def shape(self, node: Node) -> str:
        """The lengths of all axes in brackets."""
        size = self.program.size(node)
        if node in self._shapes:
            return self._shapes[node]
        if any(self.program.tells(node, n) for n in size):
            return f"[{self.names[node]}.length]" if len(size) == 1 else f"{self.names[node]}.shape"
        return f"[{','.join(map(self._length, size))}]"

    def spread(self, node: Node, shape: str) -> str:
        """A field in another shape."""
        key = node, shape
        if key not in self._spread:
            self._spread[key] = self.bind(f"spread({self.text(node)},{self.shape(node)},{shape})")
        return self._spread[key]

    def _spread_element(self, node: Node, shape: str) -> str:
        """An element of a field in the shape of a loop."""
        own = self.shape(node)
        if not all(part.isdigit() for part in f"{own},{shape}".replace("[", "").replace("]", "").split(",")):
            return f"{self.spread(node, shape)}[i]"
        return f"{self.text(node)}[{self.program.constant(f'spreading({own},{shape})')}[i]]"

    def _length(self, length: "int | Node") -> str:
        if isinstance(length, int):
            return str(length)
        key = length, "whole"
        if key not in self._spread:
            self._spread[key] = self.bind(f"whole({self.text(length)})")
        return self._spread[key]

    def write(self, roots: Iterable[Node]) -> None:
        """Write all that these nodes need, in an order in which each loop computes as many fields as it can."""
        roots = list(roots)
        needed = self._needed(roots)
        self._put_inside(needed, set(roots))
        self._place = {node: k for k, node in enumerate(node for node in needed if node not in self._inside)}
        for node in self._place:
            before = set(self._operands(node))
            self._missing[node] = len(before - self.names.keys())
            for operand in before:
                self._users[operand].add(node)
        for node in roots:
            self._users[node].add(None)
        turns = [(0, k, node) for node, k in self._place.items() if not self._missing[node]]
        while turns or self._fields:
            while turns:
                turn, k, node = heappop(turns)
                if self._in_loop(node):
                    insort(self._fields, (k, node), key=itemgetter(0))
                    continue
                text = self._operation(node).text if node.op in ELEMENTWISE else self.program.rules[node.op](self, node)
                self.names[node] = self.bind(text)
                for later in self._released(node):
                    heappush(turns, (turn + (self._place[later] < k), self._place[later], later))
            if self._fields:
                turns = [(0, self._place[node], node) for node in self._loop()]
                heapify(turns)
        left = [node for node, missing in self._missing.items() if missing]
        if left:
            place = f"line {left[0].line}"
            raise SheetError(f"{place}: how many values are found there is not known before: no page can follow that")

    def _released(self, node: Node) -> list[Node]:
        """What waited for nothing but this node."""
        released = list[Node]()
        for user in self._users[node]:
            if user is not None:
                self._missing[user] -= 1
                if not self._missing[user]:
                    released.append(user)
        return released

    def _needed(self, roots: list[Node]) -> list[Node]:
        order, found = list[Node](), set(self.names)
        while roots:
            new = [node for node in bottom_up(roots, found) if node.op != "constant"]
            order += new
            found.update(new)
            roots = [n for node in new for n in self._lengths(node) if n not in found]
        return order

    def _lengths(self, node: Node) -> list[Node]:
        if self.each or not node.shape:
            return []
        return [n for n in self.program.size(node) if isinstance(n, Node) and not self.program.tells(node, n)]

    def _in_loop(self, node: Node) -> bool:
        return bool(node.shape) and not self.each and (node.op in ELEMENTWISE or node.op == "at")

    def _put_inside(self, nodes: list[Node], roots: set[Node]) -> None:
        """Let nodes that are used once stand in the expression of the operation that uses them, in the same loop."""
        uses = Counter([*roots, *(o for node in nodes for o in (*node.operands, *self._lengths(node)))])
        deep = Counter[Node]()
        for node in nodes:
            if node.op not in ELEMENTWISE:
                continue
            for operand in node.operands:
                alike = (
                    operand.op in ELEMENTWISE
                    and operand not in self.names
                    and self._in_loop(node) == self._in_loop(operand)
                )
                if not (alike and uses[operand] == 1 and deep[operand] < _DEEPEST):
                    continue
                again = node.op == operand.op == "like" and operand is node.args[0]
                if not self._in_loop(node) or self._key(node) == self._key(operand) or again:
                    self._inside.add(operand)
                    deep[node] = max(deep[node], deep[operand] + 1)

    def _key(self, node: Node) -> "Size | Node":
        """What fields of one loop have in common: their size; where only its operands tell that, a field is alone."""
        if node not in self._keys:
            size = self.program.size(node)
            self._keys[node] = node if any(self.program.tells(node, n) for n in size) else size
        return self._keys[node]

    def _operands(self, node: Node) -> Iterator[Node]:
        """What must be known before a node, through those in its expression."""
        for operand in (*node.operands, *self._lengths(node)):
            if operand in self._inside:
                yield from self._operands(operand)
            elif operand.op != "constant":
                yield operand

    def _loop(self) -> list[Node]:
        """Write the next loop; what waited for nothing else."""
        first = self._fields[0][1]
        key, loop, released = self._key(first), dict[Node, str](), list[Node]()
        if key is first:
            self._fields.pop(0)
            self.names[first] = self.bind(self._alone(first))
            return self._released(first)
        turns = [field for field in self._fields if self._key(field[1]) == key]
        self._fields = [field for field in self._fields if self._key(field[1]) != key]
        while turns:
            k, node = heappop(turns)
            loop[node] = self.program.name()
            for later in self._released(node):
                whole = later.op == "at" and later.args[0] in loop  # any element may be taken: of all of them
                if not whole and self._in_loop(later) and self._key(later) == key and self._place[later] > k:
                    heappush(turns, (self._place[later], later))
                else:
                    released.append(later)
        stored = dict.fromkeys(node for node in loop if not self._users[node].issubset(loop.keys()))  # in order
        shape = self.shape(first)
        count = "*".join(shape.strip("[]").split(","))
        count = self.bind(count) if "*" in count else count
        places = {node: f"{name}[i]" if node in stored else name for node, name in loop.items()}
        body = [
            f"{place if node in stored else f'const {place}'}={self._operation(node, key, shape, places).text};"
            for node, place in places.items()
        ]
        self.lines += [f"{_CONST}{loop[node]}=field({count});" for node in stored]
        self.lines.append(f"(()=>{{for(let i=0;i<{count};i++){{{''.join(body)}}}}})();")
        self.names |= {node: loop[node] for node in stored}
        return released

    def _alone(self, node: Node) -> str:
        """A field whose shape only its operands tell."""
        source, others = node, list[Node]()
        while source.op == "like" and (source is node or source in self._inside):
            source, others = source.args[0], [source.args[1], *others]
        along = [source, *others] if others else _along(node)
        shape = self.bind(f"together({','.join(self.shape(operand) for operand in along if operand.shape)})")
        self._shapes[node] = shape
        if others and source.shape and source not in self._inside:
            return f"spread({self.text(source)},{self.shape(source)},{shape})"
        return f"over({shape},i=>{self._operation(node, node, shape).text})"

    def _operation(self, node: Node, key: "Size | Node" = (), shape: str = "", places: Mapping[Node, str] = {}) -> Text:
        """The expression of an elementwise operation, in a loop of this key and shape over fields at these places."""
        if node.op == "like":
            return self._operand(node.args[0], key, shape, places)
        operands = [self._operand(operand, key, shape, places) for operand in _along(node)]
        if node.op == "at":
            return Text(f"pick({self.text(node.args[0])},{operands[0].text})")
        conditions = [operand.value.dtype == bool for operand in _along(node)]
        refuses = node.op in REFUSING and is_pythons(self.program.graph, node)
        return operation(node.op, operands, conditions, refuses)

    def _operand(self, node: Node, key: "Size | Node", shape: str, places: Mapping[Node, str]) -> Text:
        if node in places:
            return Text(places[node])
        if node in self._inside:
            return self._operation(node, key, shape, places)
        if node in self.names and (self.each or not node.shape):
            return Text(self.names[node])
        if not node.shape:
            return literal(node.value.item())
        size = self.program.size(node)
        if all(n == 1 for n in size):
            return literal(node.value.item()) if node.op == "constant" else Text(f"{self.names[node]}[0]")
        return Text(f"{self.text(node)}[i]" if size == key else self._spread_element(node, shape))


def declared(lines: Iterable[str]) -> Iterator[str]:
    """The same lines, where constants that follow one another are declared as one: a page has thousands."""
    for constants, group in groupby(lines, lambda line: line.startswith(_CONST)):
        if constants:
            yield _CONST + ",\n".join(line.removeprefix(_CONST).removesuffix(";") for line in group) + ";"
        else:
            yield from group


def _along(node: Node) -> tuple[Node, ...]:
    """Operands of which each element takes one."""
    return node.args[1:] if node.op == "at" else node.args
