"""The bands of a run within the tolerances of its inputs: by the slopes, and of wanted results in other ways too."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from functools import cache, partial
from itertools import chain
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import parts
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers.banded import Banded, RunBands, about, off, run_bands
from mechsheet.readers.bands import ENDS, Band, Bands, Tolerance, tolerances
from mechsheet.readers.cases import RESULTS
from mechsheet.readers.jumps import Jump
from mechsheet.recording.record import record
from mechsheet.run.within import cases
from mechsheet.worksheet import numbers, shown
from mechsheet.worksheet.cells import Worksheet, base, split
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import Formula, registry
from mechsheet.worksheet.no_inputs import inputs_of
from mechsheet.worksheet.scene import Scene
from mechsheet.worksheet.table import Table
from mechsheet.worksheet.ties import greatest, greatest_first

_CASES = 1000  # of Monte Carlo
_WIDE = 5.0  # times the worst case of the slopes: wider bounds tell nothing
_DIGITS = 6  # that are shown of a result and its ends
_SLACK = 2.0**-25  # of the width of a bound, which balls keep to 30 bits: no reason to show a wider one
_MOST = 3  # inputs that are named as those that matter


def bands_of(namespace: Mapping[str, Any], sheet: Worksheet, checks: Iterable[Check]) -> RunBands:
    """Bands of what a run of a whole worksheet shows.

    Raises SheetError where no input has a tolerance, or one breaks a limit of its input.
    """
    by = tolerances(inputs_of(namespace))
    recording = record(namespace, sheet, whole=True)
    known = registry(namespace)
    run = partial(cases, inputs_of(namespace), sheet, sheet.results, known, by)
    return run_bands(recording, tables_of(namespace), _own(checks, namespace), known, by, run)


def _own(checks: Iterable[Check], namespace: Mapping[str, Any]) -> list[Check]:
    """Checks under the limits of the worksheet, not of a scene, which are not recorded."""
    own = {check.name: check.limit for check in parts.values(namespace) if isinstance(check, Check)}
    return [check for check in checks if own.get(check.name) == check.limit]


def tables_of(namespace: Mapping[str, Any]) -> list[Table]:
    """Tables of a run in the order of its file."""
    return [value for value in parts.values(namespace) if isinstance(value, Table)]


def lines(
    namespace: Mapping[str, Any], sheet: Worksheet, given: Scene, quantities: Sequence[str], checks: Sequence[Check]
) -> Iterator[str]:
    """Bands of a run for some results alone: each at all its positions and in all ways; of a whole run as it shows."""
    if not given.want:
        whole = bands_of(namespace, sheet, checks)
        yield from whole.lines()
        yield from (f"{name}: {sure}" for name, sure in whole.sure.items())
        return
    by = tolerances(inputs_of(namespace))
    needed = replace(sheet, cells=tuple(sheet.needed([*given.want, *given.limits], ["g"])))
    recording = record(namespace, needed, whole=True, every=1)
    known = registry(namespace)
    run = cache(partial(cases, inputs_of(namespace), sheet, [*given.want, *given.limits], known, by))
    bands = Bands(recording, by, run)
    nodes = {name: node for name in quantities if (node := _node(name, recording))}
    yield f"within {', '.join(map(str, by.values()))}"
    if any(t.normal for t in by.values()):
        yield "of a normal tolerance 3 cases in 1000 lie beyond it, where no worst case and no guaranteed bound holds"
    yield from (f"{name}: keeps still" for name in quantities if name not in nodes)
    gaps = {name: np.count_nonzero(np.isnan(node.value)) for name, node in nodes.items()}
    yield from (f"{x}: not known, there is none at {n} of {nodes[x].size} positions" for x, n in gaps.items() if n)
    nodes = {name: node for name, node in nodes.items() if not gaps[name]}
    if nodes:
        found = bands.of(nodes.values())
        sampled = _sampled(sheet, [*nodes], namespace["g"])
        seen = {name: [guard.holds for guard in recording.looked.get(base(name), ())] for name in nodes}
        bounds = _bounds(nodes, seen, recording.inputs, by)
        jumping = bands.jumps(chain(nodes.values(), *seen.values()))
        for name, node in nodes.items():
            jump = next((jumping[x] for x in (node, *seen[name]) if x in jumping), None)
            band = found[node]
            ends = sampled[name][name].least, sampled[name][name].greatest
            how = "" if band.why or jump else bands.misled(node, seen[name])
            if jump or how or sampled[name].lost:
                inside = bands.cases.spans.get((RESULTS, name)) or ends
                ends = inside if sampled[name].lost else ends  # between what those lie that have a value
                band = _told(band, name, node, known[base(name)], bands, jump, how)
            yield from _in_all_ways(name, node, known[base(name)], band, sampled[name], ends, bounds[node], by)
    for table in (value for name in given.want if isinstance(value := namespace.get(name), Table)):
        yield from _of_table(table, run_bands(recording, [table], (), {}, by, run).banded)
    for check in _own(checks, namespace):
        if check.evaluated and check.name in recording.checks:
            sure = bands.sure(check.name, check.passed)
            yield f"{check.name}: {check.verdict}{',' * sure.startswith(('fails', 'holds', 'how'))} {sure}"


def _told(band: Band, name: str, node: Node, line: Formula, bands: Bands, jump: Jump | None, how: str) -> Band:
    """A band, or none with what the cases tell of a result that jumps, bends or ends within the tolerances."""
    shown = Banded(RESULTS, name, line.unit, node.value / units.parse(line.unit).factor, band)
    if band.lost or not (jump or how):
        return band
    if how == ENDS:
        return band.none(how)
    return shown.told_by(bands.cases, how, f" ({bands.turns(jump)})" if jump else "").band


def _sampled(sheet: Worksheet, names: Sequence[str], g: Any) -> dict[str, Any]:
    """Random cases of each result: of all at once, but where one has no value in some of them the others may."""
    draw = partial(shown.study("tolerance"), sheet.path, method="monte carlo", seed=1, count=_CASES, g=g)
    together = draw(names)
    alone = together.lost and len(names) > 1
    return {name: draw([name]) if alone else together for name in names}


def _node(name: str, recording: Recording) -> Node | None:
    """A result in a recording, be it a number that Python chose; none of what rests on nothing."""
    value = recording.values.get(base(name))
    if isinstance(value, Quantity) or not recording.looked.get(base(name)):
        return part_of(name, recording.values)
    return part_of(name, {base(name): lift(recording.graph, value)})


def part_of(name: str, values: Mapping[str, Any]) -> Node | None:
    """A result or a part of one in a recording; none of what is no real quantity there."""
    root, part = split(name)
    quantity = values.get(root)
    if not isinstance(quantity, Quantity):
        return None
    if part:
        quantity = abs(quantity) if part == "abs" else getattr(quantity, part)
    return quantity.re if quantity.im is None else None


def _bounds(
    nodes: Mapping[str, Node],
    seen: Mapping[str, Sequence[Node]],
    inputs: Mapping[str, Node],
    by: Mapping[str, Tolerance],
) -> dict[Node, tuple[Any, Any]]:
    from mechsheet.readers.enclosed import enclosed  # on use: only bounds need balls

    within = {inputs[name]: tolerance.size for name, tolerance in by.items()}
    resting = dict[Node, list[Node]]()
    for name, node in nodes.items():
        resting.setdefault(node, []).extend(seen[name])
    return enclosed(resting, within, resting)


def _in_all_ways(
    name: str,
    node: Node,
    line: Formula,
    band: Band,
    sampled: Any,
    ends: tuple[Any, Any],
    bounds: tuple[Any, Any],
    by: Mapping[str, Tolerance],
) -> Iterator[str]:
    """One result: a row for each position, then by how much the ways differ and which inputs matter most."""
    factor = units.parse(line.unit).factor
    values = node.value.reshape(-1) / factor
    if band.why:
        yield f"{name}: no slopes, {band.why}"
    worst, squares, deviation = (x.reshape(-1) / factor for x in (band.worst, band.squares, band.deviation))
    least, greatest, drawn = (np.reshape(x, -1) for x in (*ends, sampled[name].deviation))
    low, high = (x.reshape(-1) / factor for x in bounds)
    beyond = np.maximum(high - values, values - low)
    narrow = np.where(worst > 0, beyond <= _WIDE * worst, np.isfinite(beyond))
    heads = [f"{name} [{numbers.in_text(line.unit)}]", "worst case", "root of squares", f"{_CASES} random cases"]
    any_narrow = bool(narrow.any())
    rows = [[*heads, *["guaranteed"] * any_narrow]]
    for k, value in enumerate(values):
        row = [numbers.significant(value, _DIGITS), *(about(x[k]) for x in (worst, squares))]
        bound = _ends(*_outwards(low[k], high[k])) if narrow[k] else numbers.CELL.none
        rows.append([*row, _ends(least[k], greatest[k]), *[bound] * any_narrow])
    yield from numbers.aligned(rows)
    if sampled.lost:
        yield f"{sampled.lost} of {_CASES} random cases have no value: {sampled.reason}"
    elif not band.why:
        apart = np.max(np.abs(drawn - deviation), initial=0.0) / (np.max(deviation, initial=0.0) or 1.0)
        yield (
            f"standard deviation of the random cases and by the slopes differ by {numbers.significant(100 * apart, 2)}"
            f" % of the greatest, by chance about {numbers.significant(100 / np.sqrt(2 * _CASES), 2)} %"
        )
    if not narrow.all():
        where = f" at {np.count_nonzero(~narrow)} of {values.size} positions" if narrow.any() else ""
        yield f"bounds that balls guarantee are none, or too wide to tell anything{where}"
    if not band.why and (most := ", ".join(_mattering(line, band, by))):
        yield f"most by {most}"


def _of_table(table: Table, banded: Sequence[Banded]) -> Iterator[str]:
    """A table with the worst cases in place of its numbers, without the columns that keep still."""
    yield f"Table {table.number} - {table.title}: worst case" + (": keeps still" if not banded else "")
    units_of = {column.name: column.unit for column in table.columns}
    columns = [
        (
            each.name,
            f"[{numbers.in_text(units_of[each.name])}]",
            *map(about, each.worst),
        )
        for each in banded
        if not each.band.why
    ]
    yield from numbers.aligned(list(zip(*columns, strict=True)))
    yield from (f"{each.name}: not known, {each.band.why}" for each in banded if each.band.why)


def _mattering(line: Formula, band: Band, by: Mapping[str, Tolerance]) -> Iterator[str]:
    """The inputs that move a result most where its worst case is greatest, and by how much."""
    k = greatest(np.nan_to_num(band.worst))
    moves = np.abs(band.moves.reshape(len(by), -1)[:, k]) / units.parse(line.unit).factor
    for i in greatest_first(moves)[: min(_MOST, int(np.count_nonzero(moves)))]:
        yield f"{[*by][i]} (± {off(moves[i])}{numbers.suffix(line.unit)})"


def _outwards(low: float, high: float) -> tuple[float, float]:
    """A bound at the digits that are shown, rounded so that it still holds.

    >>> _outwards(0.12345649, 2.0000001), _outwards(0.1234564, 2.0000000000000004)
    ((0.123456, 2.00001), (0.123456, 2.0))
    """
    ends, slack = [], _SLACK * (high - low)
    for end, way in ((low, ROUND_FLOOR), (high, ROUND_CEILING)):
        near = float(numbers.significant(end, _DIGITS))
        holds = near <= end + slack if way is ROUND_FLOOR else near >= end - slack
        ends.append(near if holds else float(Context(_DIGITS, way).create_decimal(end)))
    return ends[0], ends[1]


def _ends(low: float, high: float) -> str:
    if np.isnan(low):
        return numbers.CELL.none
    return numbers.span(numbers.significant(float(end), _DIGITS) for end in (low, high))
