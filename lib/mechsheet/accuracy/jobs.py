"""The jobs in which the product's methods stand beside the others, and the times of many of them at once."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy import linspace

from mechsheet.accuracy import exact, printed, rivals
from mechsheet.accuracy.arithmetic import Numbers
from mechsheet.accuracy.chains import (
    REACTIONS,
    crank_chain,
    hitch_chain,
    hitch_points,
    hitch_reactions,
    plain_hitch_reactions,
)
from mechsheet.accuracy.conditioning import condition
from mechsheet.accuracy.finding import by_inverse, find_methods, rod_ways
from mechsheet.accuracy.machine import machine_job, ring_job
from mechsheet.accuracy.precision import Job
from mechsheet.accuracy.responses import response_jobs
from mechsheet.accuracy.timing import STEPS, time_spread, timed, times_of_one
from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.run.progress import progress
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.table import Column, Table

_PINS = ("P23_S", "P45_S", "P67_S")
_ANALOGUES = tuple(f"dphi{k}" for k in range(3, 8))


def accuracy_jobs(hitch: Any, machine: Worksheet, crank: Any, N: int, factors: Sequence[float]) -> dict[str, Job]:
    """The jobs by number: positions, derivatives, Finds and reactions of the hitch, positions of a dyad on a crank.

    Two drives over time, reactions of a machine with groups of three kinds and the bolts of a circular joint too.
    ``hitch`` are the inputs of the hitch worksheet, ``machine`` is the worksheet of kinetostatics, ``crank`` has l_1,
    l_A, l_B, X_B, Y_B [m]; all are computed at N positions. The factors are those of bad guesses.
    """
    S, q = linspace(hitch.S_min, hitch.S_max, N), linspace(0, 2 * np.pi, N)
    found = exact.finds(hitch)
    known = {name: float(x) for name, x in found.items()}
    L4, S_p, L7 = known.values()
    at, upright = [exact.hitch(hitch, s, **known) for s in S], [exact.hitch(hitch, S_p, **known)]
    chain, dyad = hitch_chain(hitch, L4, L7), crank_chain(crank.l_1, crank.X_B + 1j * crank.Y_B, crank.l_A, crank.l_B)
    B = dyad.dyads[0].B

    def of(names: Iterable[str], positions: Iterable[Numbers] = at) -> list[Any]:
        return [p[name] for name in names for p in positions]

    def printed_pins() -> Any:
        r = printed.hitch_pins(hitch, S, L4, L7)
        return np.array([r[name] for name in _PINS])

    def printed_dyad() -> Any:
        return printed.dyad_pin(dyad.A(q), B, crank.l_A, crank.l_B, +1)[0]

    def printed_analogues() -> Any:
        r = printed.hitch_ratios(hitch, S, L4, L7, printed.hitch_pins(hitch, S, L4, L7))
        return np.array([r[name] for name in _ANALOGUES])

    def reactions(number: str, title: str, strokes: Any, positions: Sequence[Numbers]) -> Job:
        S6 = np.array([complex(p["PS6_S"]) for p in positions])
        p = hitch_points(hitch, strokes, L4, L7, S6)
        kappa = condition(lambda x: hitch_reactions(SimpleNamespace(**x), x), inputs_of(hitch) | p)
        methods = rivals.reaction_methods(hitch, strokes, L4, L7, S6)
        return Job(number, title, of(REACTIONS, positions), methods, kappa)

    second = zip(*(exact.second_analogues(hitch, s, L4, L7).values() for s in S), strict=True)
    pins = [exact.four_bar(crank.l_1, crank.l_A, crank.l_B, B, t)["C"] for t in q.tolist()]
    given = inputs_of(hitch)
    moved = given | {"S": S, "L4": L4, "L7": L7}

    def of_chain(f: Callable[[Any, Any], Any]) -> float:
        return condition(lambda x: f(hitch_chain(SimpleNamespace(**x), x["L4"], x["L7"]), x["S"]), moved)

    of_dyad = condition(
        lambda x: crank_chain(x["l_1"], x["B"], x["l_A"], x["l_B"]).pins(x["q"]),
        {"l_1": crank.l_1, "B": B, "l_A": crank.l_A, "l_B": crank.l_B, "q": q},
    )
    of_finds = condition(lambda x: by_inverse(SimpleNamespace(**x)), given)
    truth, stroke = list(found.values()), hitch.S_max - hitch.S_min
    first_order = rivals.derivative_methods(chain, S, stroke, 1, printed_analogues)
    second_order = rivals.derivative_methods(chain, S, stroke, 2)
    positions = rivals.position_methods
    jobs = (
        Job(
            "1.1",
            "Position of the hitch",
            of(_PINS),
            positions(chain, S, printed_pins),
            of_chain(lambda c, S: c.pins(S)),
        ),
        Job("1.2", "Position of a dyad", pins, positions(dyad, q, printed_dyad), of_dyad),
        *response_jobs(("1.6", "1.7"), hitch),
        Job("2.1", "Velocity analogues", of(_ANALOGUES), first_order, of_chain(lambda c, S: c.analogues(1, S))),
        Job(
            "2.2",
            "Acceleration analogues",
            [x for row in second for x in row],
            second_order,
            of_chain(lambda c, S: c.analogues(2, S)),
        ),
        Job("3.1", "Find from the document's guesses", truth, find_methods(hitch, [1.0]), of_finds),
        Job("3.2", "Find from bad guesses", truth * len(factors), find_methods(hitch, factors), of_finds),
        reactions("4.1", "Reactions", S, at),
        reactions("4.2", "Reactions, mast upright", np.array([S_p]), upright),
        machine_job("4.4", machine, N),
        ring_job("4.5", N),
    )
    return {job.number: job for job in jobs}


def inputs_of(g: Any) -> dict[str, Any]:
    """The inputs of a worksheet that are real numbers, by name."""
    fields = (field for field in declared(type(g)) if isinstance(getattr(g, field.name), float | int))
    return {field.name: float(getattr(g, field.name)) for field in fields if not field.whole}


# What takes one after the other, or much for each: the largest number that is waited for.
_MOST = {"find": 1000, "find_root": 1000, "find_root, no checks": 1000, "brentq": 10, "brentq, no checks": 1000}
_MOST |= {"dense system": 1000, "least squares": 1000}


def batch_times(number: str, hitch: Any, sizes: Sequence[int], seconds: float, patience: int = 1) -> Table:
    """Table of the time for one of n positions, Finds or reactions computed at once: 1.3, 3.3 or 4.3.

    Slow ways take no more than a number of their own, times the ``patience``.
    """
    clock_read()  # before anything is run for it
    L4, _, L7 = map(float, exact.finds(hitch).values())
    strokes, heights, points = _given(hitch, L4, L7)
    positions = {
        "library": (chain := hitch_chain(hitch, L4, L7)).groups,
        "closed form, no checks": chain.plain_pins,
        "printed": lambda S: printed.hitch_pins(hitch, S, L4, L7),
    }
    batches: dict[str, tuple[str, Callable[[int], Any], Mapping[str, Callable[[Any], Any]]]] = {
        "1.3": ("Time of a position", strokes, positions),
        "3.3": ("Time of a Find", heights, rod_ways(hitch)),
        "4.3": ("Time of the reactions", points, rivals.reaction_ways(hitch)),
    }
    title, given, ways = batches[number]
    return times_of_one(number, title, sizes, given, ways, seconds, {way: n * patience for way, n in _MOST.items()})


def cost_of_checks(number: str, hitch: Any, sizes: Sequence[int], seconds: float) -> Table:
    """Table of the time for one of n, by the library and by its closed forms without checks."""
    clock_read()  # before anything is run for it
    L4, _, L7 = map(float, exact.finds(hitch).values())
    chain, (strokes, _, points) = hitch_chain(hitch, L4, L7), _given(hitch, L4, L7)
    work: dict[str, tuple[Callable[[int], Any], Callable[[Any], Any], Callable[[Any], Any]]] = {
        "positions": (strokes, chain.pins, chain.plain_pins),
        "velocity analogues": (strokes, lambda S: chain.analogues(1, S), lambda S: chain.plain_analogues(1, S)),
        "acceleration analogues": (strokes, lambda S: chain.analogues(2, S), lambda S: chain.plain_analogues(2, S)),
        "reactions": (points, lambda p: hitch_reactions(hitch, p), lambda p: plain_hitch_reactions(hitch, p)),
    }
    cases = [(name, n) for name in work for n in sizes]
    runs = list[Callable[[], Any]]()
    for name, n in cases:
        given, *ways = work[name]
        runs += [partial(way, given(n)) for way in ways]
    with progress(STEPS * len(runs), f"{number} Checks") as done:
        taken = timed(runs, seconds, done)
    library, plain = taken[::2], taken[1::2]
    counts = np.array([n for _, n in cases], float)
    of_library, of_plain = (1e6 * np.array([time.seconds for time in times]) / counts for times in (library, plain))
    columns = (
        Column("work", "", "", 0, np.array([name for name, _ in cases], object)),
        Column("count", "-", "computed at once", 0, counts),
        Column("library", "µs", "median time of one of them", 3, of_library),
        Column("arithmetic", "µs", "the same by closed forms without checks", 3, of_plain),
        Column("checks", "%", "what is left of the library's time", 0, 100 * (1 - of_plain / of_library)),
        *time_spread(library),
        *time_spread(plain, "arithmetic"),
    )
    return Table(number, "Cost of checks", columns)


def _given(hitch: Any, L4: float, L7: float) -> tuple[Callable[[int], Any], ...]:
    """Strokes, heights of the suspension axis and points of the hitch, n of each."""

    def strokes(n: int) -> Any:
        return linspace(hitch.S_min, hitch.S_max, n)

    def heights(n: int) -> Any:
        return linspace(0.19, 0.21, n) if n > 1 else np.array([0.2])

    def points(n: int) -> Any:
        return hitch_points(hitch, strokes(n), L4, L7, np.full(n, 2 + 0.5j))

    return strokes, heights, points
