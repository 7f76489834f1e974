"""A recording as a function in JavaScript: the numbers of a worksheet for whatever inputs it is given."""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet.html import moves
from mechsheet.html.elementwise import array, literal, places
from mechsheet.html.scope import Program, Rule, Scope, declared
from mechsheet.quantities.graph import Guard
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.units import parse
from mechsheet.worksheet.equations import longest_step

_NUMBERS, _FIND, _SOLVE, _BETWEEN = "numbers.js", "find.js", "solve.js", "between.js"
_COUNTED = "its elements are not known for this number of rows"
_WORDS = "G I NaN do for if in let new of p i try var out"


def module(recording: Recording, wanted: Mapping[str, Node]) -> str:
    """A script that defines ``evaluate(inputs)``, which gives the ``wanted`` quantities by their keys.

    ``inputs`` are numbers in SI units by the names of the recording: of a choice the number of its option, of a switch
    0 or 1, of a list its numbers, of a text 0 while it is the worksheet's own and else 1; those that are left out are
    the worksheet's own. What it returns has

    - ``values`` by key: a number, or a Float64Array, which knows its ``shape`` where it has several axes; undefined
      where nobody knows it for these inputs;
    - ``gaps``: for each such key the reason; for that of a verdict after the word found;
    - ``guards``: why the worksheet may be otherwise for these inputs;
    - ``found``: the verdict of each found value of the recording, of an array of problems an array of them; it means
      nothing where it has a gap.
    """
    found = {key: solved.node for key, solved in recording.found.items() if solved.node.op == "found"}
    results = [*wanted.values(), *found.values()]
    every = list(bottom_up(results, ()))
    single = {node.args[0].single for node in every if node.op == "found"}
    files = [_NUMBERS, _FIND, _SOLVE][: 3 if False in single else 1 + len(single)]
    if any(node.op == "found" and node.args[0].method for node in every):
        files.append(_BETWEEN)
    functions = runtime(*files)
    program = Program(recording.graph, RULES, frozenset(_WORDS.split()) | set(re.findall(r"[A-Za-z]\w*", functions)))
    names = {node: json.dumps(name) for name, node in recording.inputs.items()}
    program.inputs = {node: f"I[{name}]" for node, name in names.items()}
    conditions = [node.args[0] for node in every if _is_guarded(recording, node)]
    conditions += [node.args[1] for node in every if node.op == "sized"]
    gaps = {gap.line for gap in recording.gaps}
    looked = {
        holds: otherwise(guard)
        for holds, guard in recording.guards.items()
        if not (guard.rows or guard.turns or guard.line in gaps)
    }
    scope = Scope(program, {})
    scope.write(dict.fromkeys([*results, *conditions, *looked]))

    inputs = [node for node in scope.names if node.op == "input"]
    own = ",".join(f"{names[node]}:{_own(node)}" for node in inputs)
    all_there = "".join(f",{names[n]}:rows_of(G[{names[n]}],{n.size})" for n in inputs if _has_own_length(n))
    values = ",".join(f"{_key(key)}:{_result(scope, node)}" for key, node in wanted.items())
    verdicts = ",".join(f"{json.dumps(key)}:{scope.solved[node.args[0]]}" for key, node in found.items())
    lines = [
        *(f"const {name}={text};" for text, name in program.constants.items()),
        f"const own={{{own}}};",
        f"function evaluate(inputs){{const G={{...own,...inputs}},I={{...G{all_there}}};",
        *scope.lines,
        f"const out={{values:{{{values}}},gaps:{{}},guards:[],found:{{{verdicts}}}}};",
        *_told(recording, scope, wanted, found),
        *(f"{scope.text(holds)}||out.guards.push({json.dumps(why)});" for holds, why in looked.items()),
        "return out}",
    ]
    return "\n".join(["const evaluate=(()=>{", functions, *declared(lines), "return evaluate})();"])


@cache
def runtime(*files: str) -> str:
    """Texts of files beside this one, without indents, empty lines, and comments that begin with //."""
    texts = [Path(__file__).with_name(name).read_text(encoding="utf-8") for name in files]
    return "\n".join(line.strip() for text in texts for line in text.splitlines() if line.strip()[:2] not in ("", "//"))


def _has_own_length(node: Node) -> bool:
    """Whether it is a list that is followed at its own length alone."""
    return node.op == "input" and bool(node.shape) and not node.stretches


def _own(node: Node) -> str:
    return array(node.value) if node.shape else literal(node.value.item()).text


def _key(key: str) -> str:
    """The key of a value as JavaScript has it: most are numbers."""
    return key if key.isdecimal() else json.dumps(key)


def _result(scope: Scope, node: Node) -> str:
    text = scope.text(node)
    if len(node.shape) > 1:
        return f"shaped({text},{scope.shape(node)})"
    return text if node.shape else f"+{text}"  # what Python counts as a number may be a truth here


def _is_guarded(recording: Recording, node: Node) -> bool:
    """Whether a quantity is no number where Python takes another way than it took."""
    return node.op == "where" and node.args[0] in recording.guards and bool(np.isnan(node.args[2].value).all())


def _told(recording: Recording, scope: Scope, wanted: Mapping[str, Node], found: Mapping[str, Node]) -> Iterable[str]:
    """Statements that empty what rests on numbers that nobody knows for other inputs, and say why."""
    reasons, under = dict[tuple[str, str], int](), dict[Node, int]()  # of each node the reasons that it has, a bit each
    every = {**wanted, **{f"found {key}": node for key, node in found.items()}}
    for node in bottom_up(every.values(), under):
        own = _reason(recording, scope, node)
        bits = 1 << reasons.setdefault(own, len(reasons)) if own else 0
        for operand in node.operands:
            bits |= under[operand]
        under[node] = bits
    told = {reason: [key for key, node in every.items() if under[node] >> bit & 1] for reason, bit in reasons.items()}
    conditions = dict[tuple[str, str], dict[str, None]]()  # of the same with the same reason
    for (condition, why), keys in told.items():
        conditions.setdefault((why, ",".join(map(_key, keys))), {})[condition] = None
    return (
        f"({'&&'.join(all_of)})||gap(out,{json.dumps(why)},[{keys}]);" for (why, keys), all_of in conditions.items()
    )


def _reason(recording: Recording, scope: Scope, node: Node) -> tuple[str, str] | None:
    """The condition under which a quantity is known, and why not otherwise; None where it always is."""
    program = scope.program
    if node.op == "iterated" and node.args[0].most is None and node not in program.conditions:
        return f"{scope.solved[node.args[0]]}.ends", f"line {node.line}: its loop has not ended after 100000 turns"
    if node.op == "exported":
        why = next((gap.reason for gap in recording.gaps if gap.line == node.line), "it is not recorded")
        return program.conditions[node.args], f"line {node.line}: {why}"
    if _has_own_length(node):
        name = next(name for name, own in recording.inputs.items() if own is node)
        return f"G[{json.dumps(name)}].length=={node.size}", f"{name.partition('.')[0]} has more or fewer rows"
    if node in program.conditions:
        return program.conditions[node], f"line {node.line}: {_COUNTED}"
    if node.op == "sized":
        return scope.text(node.args[1]), f"line {node.line}: {_COUNTED}"
    if _is_guarded(recording, node):
        guard = recording.guards[node.args[0]]
        gap = next((gap.reason for gap in recording.gaps if gap.line == guard.line), "")
        return scope.text(node.args[0]), f"line {guard.line}: {gap}" if gap else otherwise(guard)
    return None


def otherwise(guard: Guard) -> str:
    """Why something is not known where Python takes another way than it took."""
    why = guard.why or "for these inputs the worksheet's code goes another way"
    return f"line {guard.line}: {why}"


def _taken(scope: Scope, node: Node) -> str:
    source, index, moved = node.args
    if not moved:
        at = index.reshape(-1)
        if not node.shape:
            return f"{scope.text(source)}[{at[0]}]" if source.shape else scope.text(source)
        if source.size == 1:
            return f"spread({scope.text(source)},[],{list(node.shape)})"
        if at.size and np.array_equal(at, np.arange(at[0], at[0] + at.size)):
            return f"{scope.text(source)}.slice({at[0]},{at[0] + at.size})"
        return f"gather({scope.text(source)},{scope.program.constant(places(index))})"
    lengths = scope.program.size(source)
    shape: list[int | None] = [n if isinstance(n, int) else None for n in lengths]
    text, of, inside = scope.text(source), scope.shape(source), list[str]()
    for move in moved:
        call = moves.move(move, shape)
        if call is None:
            return _as_recorded(scope, node, [source], index)
        text = call[0].format(text, of)
        counts = moves.counts(move)
        if counts or move is not moved[-1]:
            text = scope.bind(text)
        inside += [f"!{text}.outside"] if counts else []
        of, shape = f"{text}.shape", [None] * call[1]
    if inside:
        scope.program.conditions[node] = "&&".join(inside)
    return text if node.shape else f"{text}[0]"


def _as_recorded(scope: Scope, node: Node, sources: Sequence[Node], index: Any) -> str:
    """Elements by their places for the number of rows that the recording has; no numbers for another one."""
    same = "&&".join(f"equal({scope.shape(source)},{list(source.shape)})" for source in sources if source.stretches)
    condition = scope.program.conditions[node] = scope.bind(same)
    text = f"gather(all_of({','.join(map(scope.text, sources))}),{scope.program.constant(places(index))})"
    return f"shaped({condition}?{text}:nothing({index.size}),{list(index.shape)}){'' if node.shape else '[0]'}"


def _joined(scope: Scope, node: Node) -> str:
    sources, which, inside, moved = node.args
    starts = np.cumsum([0, *(source.size for source in sources)])
    index = starts[which] + inside
    texts = ",".join(map(scope.text, sources))
    axes = {len(source.shape) for source in sources}
    if moved is None:
        if np.array_equal(index.reshape(-1), np.arange(starts[-1])):
            return f"all_of({texts})"
        return f"gather(all_of({texts}),{scope.program.constant(places(index))})"
    way = moves.join(moved, axes.pop()) if len(axes) == 1 else None
    if way is None:
        return _as_recorded(scope, node, sources, index)
    return f"{'stacked' if way[0] else 'joined'}([{texts}],[{','.join(map(scope.shape, sources))}],{way[1]})"


def _reduced(scope: Scope, node: Node) -> str:
    source, _, kind, way = node.args
    text = scope.text(source) if source.shape else f"flat({scope.text(source)})"
    axes = len(source.shape)
    if way.so_far:
        return f"so_far(next.{kind},{text},{scope.shape(source)},{way.axis % axes})"
    if not node.shape:
        return f"of.{kind}({text})"
    if way.axis is None:
        return f"Float64Array.of(of.{kind}({text}))"
    return f"along(of.{kind},{text},{scope.shape(source)},{way.axis % axes}{',1' if way.keepdims else ''})"


def _exported(scope: Scope, node: Node) -> str:
    conditions = scope.program.conditions
    if node.args not in conditions:
        known = [scope.program.constant(array(x.value)) if x.shape else _own(x) for x in node.args]
        same = (f"equal({scope.text(x)},{value})" for x, value in zip(node.args, known, strict=True))
        conditions[node.args] = scope.bind("&&".join(same) or "true")
    if not node.shape:
        return f"{conditions[node.args]}?{_own(node)}:NaN"
    return f"{conditions[node.args]}?{scope.program.constant(array(node.value))}:nothing({node.size})"


def _length(scope: Scope, node: Node) -> str:
    source, axis = node.args
    return f"{scope.shape(source)}[{axis % len(source.shape)}]"


def _iterated(scope: Scope, node: Node) -> str:
    (loop, number, _), conditions = node.args, scope.program.conditions
    if loop not in scope.solved:
        state, before = {n: scope.program.name() for n in loop.nodes}, dict(conditions)
        turn = scope.inner(state)
        turn.write([loop.done, *loop.following])
        inside = dict.fromkeys(conditions.pop(key) for key in [*conditions] if key not in before)
        after = f"[{','.join(map(turn.text, loop.following))}],{turn.text(loop.done)},{'&&'.join(inside) or 'true'}"
        body = f"([{','.join(state.values())}])=>{{{''.join(declared(turn.lines))}return[{after}]}}"
        most = "null" if loop.most is None else str(loop.most)
        begin = f"[{','.join(map(scope.text, loop.initial))}]"
        scope.solved[loop] = scope.bind(f"repeated({begin},{most},{body})")
        if inside:
            conditions[loop] = f"{scope.solved[loop]}.known"
    if loop in conditions:
        conditions[node] = conditions[loop]
    text = f"{scope.solved[loop]}[{number}]"
    return f"shaped({text},{scope.shape(loop.initial[number])})" if len(node.shape) > 1 else text


def _found(scope: Scope, node: Node) -> str:
    block, number = node.args
    if block not in scope.solved:
        under = ",".join(map(scope.text, block.under))
        search = _solved(scope, block)
        scope.solved[block] = scope.bind(f"unless_same({json.dumps(scope.program.name())},[{under}],()=>{search})")
    part = "value" if block.single else f"x[{number}]" if number < len(block.starts) else "evaluations"
    if not node.shape:
        return f"{scope.solved[block]}.{part}"
    text = f"Float64Array.from({scope.solved[block]},v=>v.{part})"
    return f"shaped({text},{_shape_of_problems(scope, block)})" if len(node.shape) > 1 else text


def _solved(scope: Scope, block: Block) -> str:
    """The search for the unknowns of a block, of many problems one after the other."""
    node = block.nodes[0]
    shape = _shape_of_problems(scope, block) if node.shape else ""
    unknowns = block.nodes[: len(block.starts)] if not block.single else block.nodes
    starts = {name: [_of_problem(scope, n, node, shape) for n in nodes] for name, nodes in block.starts.items()}
    equals = "".join(_of_problem(scope, n, node, shape) for n in block.sides[1:])
    function = _residuals(scope, block, block.sides[:1] or block.residuals, unknowns, shape)
    if block.single:
        ends = ",".join([*(starts.get(name, ["null"])[0] for name in ("lo", "hi", "guess")), equals])
        call = f"find({function},{ends})"
        if block.method:
            call = f"root_by({json.dumps(block.method)},{function},{ends})"
        if block.branch is not None and not node.shape:
            on = (f"[{s},{_residuals(scope, block, [f], unknowns, shape)}]" for s, f in block.branches.items())
            call = f"on_branch({scope.text(block.branch)},{call},[{','.join(on)}],{ends})"
    else:
        at = ",".join(f"[{','.join(ends)}]" for ends in starts.values())
        factors = ",".join(literal(parse(unit).factor).text for unit in block.unknown_unit)
        weights = ",".join(literal(parse(unit).factor).text for unit in block.unit) if block.least else ""
        equals = ",".join(_of_problem(scope, n, node, shape) for n in block.targets)
        most = ",".join(literal(longest_step(unit)).text for unit in block.unknown_unit)
        call = f"solve({function},[{at}],[{factors}],[{most}],[{equals}]{f',[{weights}]' if weights else ''})"
    return f"each(count({shape}),p=>{call})" if node.shape else call


def _of_problem(scope: Scope, node: Node, like: Node, shape: str) -> str:
    """A number that a search is given, or of a field that of problem p."""
    if not node.shape:
        return scope.text(node)
    same = scope.program.size(node) == scope.program.size(like)
    return f"{scope.text(node) if same else scope.spread(node, shape)}[p]"


def _shape_of_problems(scope: Scope, block: Block) -> str:
    """The shape of the unknowns; where only the search tells it, that of what it is given together."""
    node = block.nodes[0]
    if not any(scope.program.tells(node, n) for n in scope.program.size(node)):
        return scope.shape(node)
    starts = [n for nodes in block.starts.values() for n in nodes if n.shape]
    given = starts + [n for n in block.under if n.shape] if block.elementwise or not starts else starts
    return scope.bind(f"together({','.join(map(scope.shape, given))})")


def _residuals(scope: Scope, block: Block, roots: Sequence[Node], unknowns: Sequence[Node], shape: str) -> str:
    """The residuals ``roots`` as a function of the unknowns, of a single one the quantity that shall equal another one.

    Where the operations are of each problem by itself, it is of problem p.
    """
    names = {n: scope.program.name() for n in unknowns}
    own = [n for n in bottom_up(roots, {*scope.names, *names}) if n.op != "constant"]
    many = bool(block.nodes[0].shape)
    each = many and block.elementwise and all(n.shape == block.nodes[0].shape for n in own)
    lengths = enumerate(scope.program.size(block.nodes[0]))
    known = names | {n: f"{shape}[{k}]" for k, n in lengths if isinstance(n, Node) and n not in scope.names}
    if each:
        given = dict.fromkeys([*roots, *(operand for n in own for operand in n.operands)])
        known |= {n: _of_problem(scope, n, block.nodes[0], shape) for n in given if n.shape and n not in {*own, *names}}
    inner = scope.inner(known, each)
    inner.write(roots)
    results = [inner.text(root) for root in roots]
    arguments = next(iter(names.values())) if block.single else f"([{','.join(names.values())}])"
    body = f"{{{''.join(declared(inner.lines))}return {results[0] if block.single else '[' + ','.join(results) + ']'}}}"
    if each or not many:
        return f"{arguments}=>{body}"
    all_of = scope.bind(f"{arguments}=>{body}")  # of all problems at once, as if all had these unknowns
    if block.single:
        return f"x=>flat({all_of}(filled({shape},x)))[p]"
    return f"x=>{all_of}(x.map(v=>filled({shape},v))).map(r=>flat(r)[p])"


RULES: dict[str, Rule] = {
    "input": lambda scope, node: f"{'Float64Array.from' if node.shape else ''}({scope.program.inputs[node]})",
    "rows": lambda scope, node: f"rows({scope.text(node.args[0])})",
    "length": _length, "take": _taken, "join": _joined, "reduce": _reduced, "exported": _exported,
    "at": lambda scope, node: f"pick({scope.text(node.args[0])},{scope.text(node.args[1])})",
    "iterated": _iterated, "found": _found,
}  # fmt: skip
