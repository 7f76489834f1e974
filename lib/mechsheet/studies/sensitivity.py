"""Sensitivity of results to inputs: slopes of what is recorded, and differences by one sweep of what is not."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.document.chart import COLOURS
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.readers.bands import untold
from mechsheet.readers.beside import beside
from mechsheet.readers.numbers import numbers as recomputed
from mechsheet.readers.slopes import Slope, seen, slopes, solved_under, unfollowed
from mechsheet.readers.stepping import stepping
from mechsheet.recording.record import record
from mechsheet.run.banding import part_of
from mechsheet.run.silent import silently
from mechsheet.studies.sweep import Sweep, known, sweep
from mechsheet.worksheet import inputs as declarations
from mechsheet.worksheet import numbers, symbol
from mechsheet.worksheet.cells import asked, base, load, value
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.shown import Charted
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.ties import greatest, greatest_first

Array = NDArray[np.float64]
Position = int | Literal["least", "greatest"]

_STEP = 2.0**-5  # of an input's size: the widest step
_HALVINGS = 7  # steps down to 2**-12 of the size
_ROUNDING = 32 * np.finfo(float).eps  # of a field's largest value: what the roundings of a worksheet make of it
_CORNER = 1e-3  # of a slope: by more those on either side differ at a corner
_BARS = 12
_RESULT = "result of this sensitivity"
_DRAWS = 4  # of inputs changed by one rounding


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """Derivatives of results by inputs, in display units, each with an estimate of its error.

    Attributes
    ----------
    names : tuple of str
        The results.
    inputs : dict of str to float
        The inputs by which they are differentiated, and where, in display units.
    values : dict of str to array, shape () or (positions,)
        The results there.
    slopes, errors : dict of str to array, shape (inputs,) or (inputs, positions)
        Derivatives d result / d input and the estimates of their errors; NaN where there is none.
    differences : dict of str to str
        Results that are differentiated by differences, and what of them is not recorded.
    reasons : dict of str to str
        For an input, why the results cannot be differentiated by it; "" where they can.
    units, input_units : dict of str to str
        Display units of the results and of the inputs.
    """

    names: tuple[str, ...]
    inputs: dict[str, float]
    values: dict[str, Array]
    slopes: dict[str, Array]
    errors: dict[str, Array]
    differences: dict[str, str]
    reasons: dict[str, str]
    units: dict[str, str]
    input_units: dict[str, str]
    meanings: dict[str, str]

    def relative(self, name: str) -> Array:
        """Elasticities d ln result / d ln input: by how many percent the result changes for one of the input."""
        at, slopes = np.array(list(self.inputs.values())), known(name, self.slopes, _RESULT)
        with np.errstate(all="ignore"):  # a result of zero has none
            relative: Array = slopes * at.reshape(-1, *[1] * self.values[name].ndim) / self.values[name]
        return relative

    def unit(self, name: str, by: str) -> str:
        """Unit of a derivative, such as ``N/m``."""
        over = known(by, self.input_units, "input of this sensitivity")
        unit = known(name, self.units, _RESULT)
        return unit if over == "-" else f"{_one(unit)}/{_grouped(over)}"

    def position(self, name: str, at: Position) -> int:
        """Number of a position, or of the one where the result is least or greatest."""
        values = np.atleast_1d(known(name, self.values, _RESULT))
        if at not in ("least", "greatest"):
            if not isinstance(at, int | np.integer) or not 0 <= at < values.size:
                raise SheetError(
                    f"position {as_given(at)} of {name} must be 0..{values.size - 1}, 'least' or 'greatest'"
                )
            return int(at)
        return greatest(-values if at == "least" else values)

    def table(self, number: str, title: str, name: str, at: Position = "least") -> Table:
        """Derivatives of a result at one position, the largest elasticity first."""
        k, order = self.position(name, at), self._order(name, at)
        slopes, errors, relative = (
            x.reshape(len(self.inputs), -1)[order, k]
            for x in (self.slopes[name], self.errors[name], self.relative(name))
        )
        by = [list(self.inputs)[i] for i in order]
        here = _at(self.inputs, by)
        where = numbers.significant(np.atleast_1d(self.values[name])[k], 6) + numbers.suffix(self.units[name])
        columns = (
            _texts("input", by, names=True),
            Column("value", "", "where the derivative is taken, in the input's unit", 4, here, unlike=True),
            _texts("unit", [units.shown(self.input_units[x]) for x in by]),
            Column("relative", "-", f"d ln {name} / d ln input", 4, relative),
            Column("derivative", "", f"d {name} / d input", 4, slopes, unlike=True),
            _texts("derivative's unit", [units.shown(self.unit(name, x)) for x in by]),
            _texts("error", [numbers.significant(x, 1) for x in errors]),
        )
        note = f"{name} = {where}, position {k}; derivatives in the units beside them"
        by_differences = f", by differences: {self.differences[name]}" if name in self.differences else ""
        return Table(number, title, columns, f"{note}{by_differences}.", said=(name,))

    def over_positions(self, number: str, title: str, name: str) -> Table:
        """Elasticities of a result at every position, a column for each input that has any influence."""
        relative = self.relative(name).reshape(len(self.inputs), -1)
        moving = [i for i, row in enumerate(relative) if np.any(row != 0)]
        k = Column("k", "-", "number of the position", 0, np.arange(relative.shape[1], dtype=float))
        names = list(self.inputs)
        parts = [Column(names[i], "-", f"d ln {name} / d ln {names[i]}", 3, relative[i]) for i in moving]
        return Table(
            number, title, (k, *parts), f"Relative: percent of {name} for one percent of the input.", said=(name,)
        )

    def tornado(self, number: str, title: str, name: str, at: Position = "least") -> "Tornado":
        """Chart of the elasticities at one position, the largest on top; inputs without influence are left out."""
        k, order = self.position(name, at), self._order(name, at)
        relative = self.relative(name).reshape(len(self.inputs), -1)[:, k]
        shown = [i for i in order if relative[i] != 0 and np.isfinite(relative[i])][:_BARS]
        names = list(self.inputs)
        bars = tuple((names[i], self.meanings[names[i]], float(relative[i])) for i in shown)
        return Tornado(number, title, name, bars)

    def _order(self, name: str, at: Position) -> list[int]:
        """Inputs by their elasticity at a position, the largest first and those without one last; of no result too."""
        k, sizes = self.position(name, at), np.abs(list(self.inputs.values()))
        slopes, errors = (x.reshape(len(self.inputs), -1)[:, k] for x in (self.slopes[name], self.errors[name]))
        return greatest_first(np.abs(slopes) * sizes, errors * sizes)


@dataclass(frozen=True)
class Tornado(Charted):
    """Elasticities of one result as horizontal bars, ``bars`` are (input, meaning, elasticity)."""

    number: str
    title: str
    result: str
    bars: tuple[tuple[str, str, float], ...]

    def chart(self) -> Any:
        """The bars as an altair chart."""
        import altair as alt  # on use: only a page needs it

        order = [symbol.text(x) for x, *_ in self.bars]
        rows = [{"input": x, "meaning": m, "relative": r} for x, (_, m, r) in zip(order, self.bars, strict=True)]
        title = f"percent of {symbol.text(self.result)} for one percent of the input"
        return (
            alt.Chart(alt.InlineData(rows))
            .mark_bar()
            .encode(
                x=alt.X("relative:Q", title=title),
                y=alt.Y("input:N", title=None, sort=order),
                color=alt.condition(alt.datum.relative > 0, alt.value(COLOURS[0]), alt.value(COLOURS[1])),
                tooltip=["input:N", "meaning:N", alt.Tooltip("relative:Q", format="+.4f")],
            )
            .properties(
                title=f"Figure {self.number} – {self.title}",
                width=560,
                height=alt.Step(20),
                usermeta={"embedOptions": {"renderer": "svg"}},
            )
        )


def sensitivity(
    worksheet: str | Path, want: Iterable[str], inputs: Iterable[str] | None = None, **given: Any
) -> Sensitivity:
    r"""Derivatives of results by inputs, exact to rounding, also of what a solve block finds.

    Their errors are estimated by what one rounding of every input makes of them. Of a result that rests on something
    that is not recorded they are

    .. math:: D(h) = \frac{f(x + h) - f(x - h)}{2h} = f'(x) + c_2 h^2 + c_4 h^4 + \dots

    central differences at steps halved from 1/32 of the input's own size down, extrapolated to none; of all the
    extrapolations that one is taken whose estimated error, by its two predecessors, is least.

    Parameters
    ----------
    worksheet : str or Path
        The worksheet.
    want : iterable of str
        Results, or parts of them as in a table: ``GS6``, ``PS6_S.real``, ``abs(R56)``.
    inputs : iterable of str, optional
        By which of the inputs; by all that are no whole numbers by default. An input that is zero has the size of
        the largest one with its unit.
    given
        Inputs in their display units that replace the defaults, or the whole of them as ``g``.

    Returns
    -------
    Sensitivity
        Where a result has a corner or a jump, or cannot be moved both ways by differences, it has NaN and a reason.

    Raises
    ------
    SheetError
        An unknown name, an input that is a whole number, a result that is complex, or inputs given that have no
        solution.

    References
    ----------
    C. J. F. Ridders, Accurate computation of F'(x) and F'(x) F''(x), Advances in Engineering Software 4 (1982).
    """
    names, given = asked(want, least=1), by_name(worksheet, given)
    fields, at = point(worksheet, given)
    every = [x for x, field in fields.items() if field.continuous]
    chosen = every if inputs is None else asked(inputs, "inputs", next(iter(fields)), 1)
    for x in chosen:
        continuous(fields, x, "cannot be differentiated by")
    exact, why = _of_recording(worksheet, names, chosen, given)
    sizes = np.array([_size(fields, at, x) for x in chosen if why])
    steps = _STEP / 2.0 ** np.arange(_HALVINGS + 1)
    moves = np.multiply.outer(sizes, np.concatenate([steps, -steps]))  # inputs, steps both ways
    rows = moves.size + 1
    variants = {x: np.full(rows, at[x]) for x in chosen}
    for i, x in enumerate(chosen if why else ()):
        variants[x][1 + i * moves.shape[1] :][: moves.shape[1]] += moves[i]
    swept = sweep(worksheet, dict.fromkeys(base(name) for name in names), {**shared(fields, given), **variants})
    solved(swept, 0)

    found, errors = dict[str, Array](), dict[str, Array]()
    lost = dict.fromkeys(chosen, "")
    results = {name: real(swept, name) for name in names}
    values = {name: result[0] for name, result in results.items()}
    reasons = swept.reasons[1:].reshape(len(chosen), -1)
    for name in names:
        if name in exact:
            own = units.parse(swept.units[base(name)]).factor
            to_display = np.reshape(
                [units.parse(fields[x].unit).factor / own for x in chosen], (-1, *[1] * values[name].ndim)
            )
            slope, errors[name] = exact[name]
            found[name], errors[name] = slope.both * to_display, errors[name] * to_display
            lost |= {x: _corner(name, slope, i) for i, x in enumerate(chosen) if np.isnan(slope.both[i]).any()}
            continue
        moved = results[name][1:].reshape(len(chosen), 2, len(steps), *values[name].shape)
        taken = [variants[x][1:].reshape(len(chosen), 2, len(steps))[i] for i, x in enumerate(chosen)]
        widths = np.reshape([t[0] - t[1] for t in taken], (len(chosen), len(steps), *[1] * values[name].ndim))
        quotients = (moved[:, 0] - moved[:, 1]) / widths  # the steps as they are after rounding
        size = float(np.max(np.abs(values[name]), initial=0.0))
        found[name], errors[name] = _extrapolated(quotients, widths, size)
        bends = 2 * (moved[:, 0] + moved[:, 1] - 2 * values[name]) / widths
        rounding = 4 * _ROUNDING * size / np.abs(widths[:, -1])
        least = rounding + _CORNER * np.abs(found[name])
        jumps = _lasts(bends, least, 1.25) | _lasts(quotients, rounding, 1.25)
        bent = _lasts(bends, least, 0.75) | jumps
        still = np.all(moved[:, :, -1] == values[name], axis=1)  # nearby, whatever jumps farther off
        found[name], errors[name] = (
            np.where(bent, np.nan, np.where(still, 0.0, x)) for x in (found[name], errors[name])
        )
        for i, x in enumerate(chosen):
            if np.isnan(found[name][i]).any():
                corner = f"{name} {'jumps there, or ends' if jumps[i].any() else 'has a corner there'}"
                cause = corner if bent[i].any() else "the result itself has no value"
                lost[x] = next((reason for reason in reasons[i][::-1] if reason), cause)
    return Sensitivity(
        names,
        {x: at[x] for x in chosen},
        values,
        found,
        errors,
        why,
        lost,
        {name: swept.units[base(name)] for name in names},
        {x: fields[x].unit for x in chosen},
        {x: fields[x].meaning for x in chosen},
    )


def _of_recording(
    worksheet: str | Path, names: Sequence[str], by: Sequence[str], given: Mapping[str, Any]
) -> tuple[dict[str, tuple[Slope, Array]], dict[str, str]]:
    """Slopes of results in SI with estimates of their errors, and of the others what of them is not recorded."""
    sheet = load(worksheet)
    g: Any = declarations.build(sheet.inputs, given)
    only = replace(sheet, cells=tuple(sheet.needed([base(name) for name in names], ["g"])))
    with silently():
        recording = record(only.run(only.results, {"g": g}), only, whole=True)
    inputs = [recording.inputs[x] for x in by]
    nodes = {name: part_of(name, recording.values) for name in names}
    lacking = {name: unfollowed([node], inputs) for name, node in nodes.items() if node}
    here = beside(slopes([node for node in nodes.values() if node], inputs), inputs)
    for name, node in nodes.items():
        if node and np.isnan([*here[node]]).all(0).any() and not lacking[name]:
            lacking[name] = seen([node], inputs)
    steps = stepping({node: here[node] for name, node in nodes.items() if node and not lacking[name]}, inputs)
    turned = _turned(recording, nodes, inputs)
    lost = {name for name, node in nodes.items() if node and (lacking[name] or node in steps or name in turned)}
    exact = {name: node for name, node in nodes.items() if node and name not in lost}
    none = "it is no recorded number"
    why = dict.fromkeys((name for name in names if name not in exact), none)
    why |= {name: untold(node, recording.gaps) for name, node in lacking.items() if node}
    why |= {name: f"line {steps[node]} moves it by steps" for name, node in nodes.items() if node in steps}
    why |= {name: f"line {line} goes another way just beside" for name, line in turned.items()}
    wanted = list(dict.fromkeys(exact.values()))
    off = {node: np.zeros_like(here[node].ahead) for node in wanted}
    rng = np.random.default_rng(0)
    for _ in range(_DRAWS):
        signs = rng.choice([-1, 1], len(inputs))
        moved = {x: np.nextafter(x.value, s * np.inf) for x, s in zip(inputs, signs, strict=True)}
        try:
            there = slopes(wanted, inputs, recomputed([*wanted, *solved_under(wanted)], moved))
        except SheetError:  # one rounding decides whether there is a solution at all
            off = {node: np.full_like(off[node], np.inf) for node in wanted}
            break
        for node in wanted:
            own = np.abs(there[node].both - here[node].both) + np.finfo(float).eps * np.abs(here[node].both)
            off[node] = np.maximum(off[node], 4 * own)
    return {name: (here[node], off[node]) for name, node in exact.items()}, why


def _corner(name: str, slope: Slope, i: int) -> str:
    """Why a result has no slope by an input."""
    at = int(np.argmax(np.isnan(slope.both[i]).reshape(-1)))
    sides = [float(side[i].reshape(-1)[at]) for side in (slope.ahead, slope.behind)]
    if not np.isfinite(sides).all():
        return f"{name} jumps there, or ends"
    ahead, behind = numbers.apart(sides)
    return f"{name} has a corner there: in SI its slope is {ahead} ahead and {behind} behind"


def _turned(recording: Recording, names: Iterable[str], inputs: Sequence[Node]) -> dict[str, int]:
    """The lines by which Python went its way for results, where it goes another one for an input a little off."""
    guards = {name: [x for x in recording.looked.get(base(name), ()) if x.holds.op != "eq"] for name in names}
    turns = slopes({guard.holds: 0 for each in guards.values() for guard in each}, inputs)
    turned = {name: [x.line for x in each if np.isnan([*turns[x.holds]]).any()] for name, each in guards.items()}
    return {name: found[0] for name, found in turned.items() if found}


def _extrapolated(quotients: Array, widths: Array, size: float) -> tuple[Array, Array]:
    """Limits of difference quotients for no step, and estimates of their errors; steps on axis 1, halved each."""
    best = np.full_like(quotients[:, 0], np.nan)
    error = np.full_like(best, np.inf)
    before = [quotients[:, 0]]
    for n in range(1, quotients.shape[1]):
        row = [quotients[:, n]]
        rounding = _ROUNDING * size / np.abs(widths[:, n])
        for m in range(1, n + 1):
            row.append(row[-1] + (row[-1] - before[m - 1]) / (4.0**m - 1))
            off = np.maximum(np.abs(row[m] - row[m - 1]), np.abs(row[m] - before[m - 1]))
            with np.errstate(invalid="ignore"):
                new = np.where(np.isnan(row[m]), np.inf, off + rounding)
            better = new < error
            best, error = np.where(better, row[m], best), np.where(better, new, error)
        before = row
    flat = np.all(quotients == 0, axis=1)  # no influence at all: no error either
    return best, np.where(flat, 0.0, np.where(np.isnan(best), np.nan, error))


def _lasts(steps: Array, least: Array, part: float) -> NDArray[np.bool_]:
    """Whether what is found at each of the smallest steps is more than a part of that at the one before.

    Of differences of the slopes on either side: of what only bends they are half, of a corner the same, and of a jump
    twice those before, which slopes over it are too.
    """
    with np.errstate(all="ignore"):
        lasts: NDArray[np.bool_] = np.all(steps[:, -2:] / steps[:, -3:-1] > part, axis=1)
    return lasts & (np.abs(steps[:, -1]) > least)


def by_name(worksheet: str | Path, given: Mapping[str, Any]) -> dict[str, Any]:
    """What is given, each input by its name; of the whole as ``g`` those that are not the worksheet's own."""
    if not hasattr(type(given.get("g")), "__inputs__"):
        return dict(given)
    own = declarations.Used(load(worksheet).inputs()).given()
    used = declarations.Used(given["g"]).given()
    others = {name: x for name, x in given.items() if name != "g"}
    return {**{name: x for name, x in used.items() if name not in own or x != own[name]}, **others}


def point(worksheet: str | Path, given: Mapping[str, Any]) -> tuple[dict[str, Input], dict[str, float]]:
    """Declared inputs and their values in display units; SheetError where there are none."""
    cls = load(worksheet).inputs
    if not declarations.declared(cls):
        raise SheetError(f"{worksheet} has no inputs by which its results could differ")
    g: Any = declarations.build(cls, given)
    rows = declarations.Used(g).rows()
    numbers = {field.name: float(shown) for field, shown in rows if field.continuous}
    return {field.name: field for field, _ in rows}, numbers


def shared(fields: Mapping[str, Input], given: Mapping[str, Any]) -> dict[str, Any]:
    """Inputs as all variants of a sweep have them: a list or a table is one, not one for each of its rows."""
    return {name: declarations.each([x]) if isinstance(fields[name], Rows) else x for name, x in given.items()}


def continuous(fields: Mapping[str, Input], name: str, cannot: str) -> None:
    field = declarations.known(fields, name)
    if not field.continuous:
        kind = "a whole number" if field.whole else "no number"
        raise SheetError(f"results {cannot} {field.meaning} {name}, which is {kind}")


def _size(fields: Mapping[str, Input], at: Mapping[str, float], name: str) -> float:
    """Size of an input: its own, of the largest with its unit where it is zero, or one."""
    alike = (abs(at[x]) for x, field in fields.items() if field.unit == fields[name].unit and field.continuous)
    return abs(at[name]) or max(alike) or 1.0


def solved(swept: Sweep, row: int) -> None:
    if swept.reasons[row]:
        raise SheetError(str(swept.reasons[row]))


def real(swept: Sweep, name: str) -> Array:
    """A wanted result of all variants in its display unit."""
    results = np.asarray(value(name, {base(name): swept.display(base(name))}))
    if np.iscomplexobj(results):
        raise SheetError(f"{name} is complex; take {name}.real, {name}.imag or abs({name})")
    return results


def _at(values: Mapping[str, float], names: Sequence[str]) -> Array:
    return np.array([values[name] for name in names])


def _texts(heading: str, texts: Sequence[str], names: bool = False) -> Column:
    return Column(heading, "", "", 0, np.array(texts, dtype=object), names=names)


def _one(unit: str) -> str:
    return "1" if unit == "-" else unit


def _grouped(unit: str) -> str:
    return f"({unit})" if "*" in unit.replace("**", "") or "/" in unit else unit
