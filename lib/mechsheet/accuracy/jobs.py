"""The jobs in which the product's methods stand beside the others: titles, truths at 50 digits and methods."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy import linspace

from mechsheet.accuracy import exact, printed, rivals
from mechsheet.accuracy.arithmetic import Numbers
from mechsheet.accuracy.chain import REACTIONS, crank_chain, hitch_chain, hitch_points
from mechsheet.accuracy.precision import Job, Method, timed
from mechsheet.worksheet.table import Column, Table

_PINS = ("P23_S", "P45_S", "P67_S")
_ANALOGUES = tuple(f"dphi{k}" for k in range(3, 8))


def accuracy_jobs(hitch: Any, crank: Any, N: int, factors: Sequence[float]) -> dict[str, Job]:
    """The jobs by number: positions, derivatives, Finds and reactions of the hitch, positions of a dyad on a crank.

    ``hitch`` are the inputs of the hitch worksheet, ``crank`` has l_1, l_A, l_B, X_B, Y_B [m]; both are computed at N
    positions. The factors are those of bad guesses.
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
        return printed.dyad_pin(dyad.A(q), B, crank.l_A, crank.l_B, +1)

    def printed_analogues() -> Any:
        r = printed.hitch_ratios(hitch, S, L4, L7, printed.hitch_pins(hitch, S, L4, L7))
        return np.array([r[name] for name in _ANALOGUES])

    def derivatives(order: int, as_printed: Callable[[], Any] | None = None) -> list[Method]:
        return rivals.derivative_methods(chain, S, hitch.S_max - hitch.S_min, order, as_printed)

    def reactions(number: str, title: str, strokes: Any, positions: Sequence[Numbers]) -> Job:
        S6 = np.array([complex(p["PS6_S"]) for p in positions])
        return Job(number, title, of(REACTIONS, positions), rivals.reaction_methods(hitch, strokes, L4, L7, S6))

    second = zip(*(exact.second_analogues(hitch, s, L4, L7) for s in S), strict=True)
    pins = [exact.four_bar(crank.l_1, crank.l_A, crank.l_B, B, t)["C"] for t in q.tolist()]
    truth, finds, positions = list(found.values()), rivals.find_methods, rivals.position_methods
    jobs = (
        Job("1.1", "Position of the hitch", of(_PINS), positions(chain, S, printed_pins)),
        Job("1.2", "Position of a dyad", pins, positions(dyad, q, printed_dyad)),
        Job("2.1", "Velocity analogues", of(_ANALOGUES), derivatives(1, printed_analogues)),
        Job("2.2", "Acceleration analogues", [x for row in second for x in row], derivatives(2)),
        Job("3.1", "Find from the document's guesses", truth, finds(hitch, [1.0])),
        Job("3.2", "Find from bad guesses", truth * len(factors), finds(hitch, factors)),
        reactions("4.1", "Reactions", S, at),
        reactions("4.2", "Reactions, mast upright", np.array([S_p]), upright),
    )
    return {job.number: job for job in jobs}


def batch_times(number: str, hitch: Any, sizes: Sequence[int], seconds: float) -> Table:
    """Table of the time for one of n positions or Finds computed at once: 1.3, 3.3 or 4.3."""
    L4, _, L7 = map(float, exact.finds(hitch).values())

    def strokes(n: int) -> Any:
        return linspace(hitch.S_min, hitch.S_max, n)

    def heights(n: int) -> Any:
        return linspace(0.19, 0.21, n) if n > 1 else np.array([0.2])

    def points(n: int) -> Any:
        return hitch_points(hitch, strokes(n), L4, L7, np.full(n, 2 + 0.5j))

    positions = {
        "library": hitch_chain(hitch, L4, L7).groups,
        "printed": lambda S: printed.hitch_pins(hitch, S, L4, L7),
    }
    batches: dict[str, tuple[str, Callable[[int], Any], Mapping[str, Callable[[Any], Any]]]] = {
        "1.3": ("Time of a position", strokes, positions),
        "3.3": ("Time of a Find", heights, rivals.rod_ways(hitch)),
        "4.3": ("Time of the reactions", points, rivals.reaction_ways(hitch)),
    }
    title, cases, ways = batches[number]
    times = timed([partial(way, given) for given in map(cases, sizes) for way in ways.values()], seconds)
    each = 1e6 * np.array([time for _, time in times]).reshape(len(sizes), -1) / np.array(sizes)[:, None]
    columns = [Column(name, "µs", "time of one of them", 2, each[:, k]) for k, name in enumerate(ways)]
    return Table(number, title, (Column("count", "-", "computed at once", 0, np.array(sizes, float)), *columns))
