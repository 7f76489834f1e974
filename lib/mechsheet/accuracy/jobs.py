"""The jobs in which the product's methods stand beside the others: titles, truths at 50 digits and methods."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy import linspace

from mechsheet.accuracy import exact, printed, rivals
from mechsheet.accuracy.arithmetic import Numbers
from mechsheet.accuracy.chain import REACTIONS, chain_pins, crank_chain, hitch_chain
from mechsheet.accuracy.precision import Job, Method, timed
from mechsheet.worksheet.table import Column, Table

Strokes = Callable[[int], Any]  # so many over the range of the cylinder
Ways = Mapping[str, Callable[[int], Callable[[], Any]]]  # named functions that make a run for n cases


def accuracy_jobs(hitch: Any, crank: Any, N: int, factors: Sequence[float]) -> dict[str, Job]:
    """The jobs by number: positions, derivatives, Finds and reactions of the hitch, positions of a dyad on a crank.

    ``hitch`` are the inputs of the hitch worksheet, ``crank`` has l_1, l_A, l_B, X_B, Y_B [m]; both are computed at N
    positions. The factors are those of bad guesses.
    """
    S, q = linspace(hitch.S_min, hitch.S_max, N), linspace(0, 2 * np.pi, N)
    lengths = exact.finds(hitch)
    L4, S_p, L7 = (float(x) for x in lengths.values())
    known = {"L4": L4, "S_p": S_p, "L7": L7}
    at = [exact.hitch(hitch, s, **known) for s in S]
    upright = exact.hitch(hitch, S_p, **known)
    chain, dyad = hitch_chain(hitch, L4, L7), crank_chain(crank.l_1, crank.X_B + 1j * crank.Y_B, crank.l_A, crank.l_B)
    B = dyad.dyads[0].B

    def of(names: Iterable[str], positions: Iterable[Numbers] = at) -> list[Any]:
        return [p[name] for name in names for p in positions]

    def printed_pins() -> Any:
        r = printed.hitch_pins(hitch, S, L4, L7)
        return np.array([r["P23_S"], r["P45_S"], r["P67_S"]])

    def printed_dyad() -> Any:
        return printed.dyad_pin(dyad.A(q), B, crank.l_A, crank.l_B, +1)

    def printed_analogues() -> Any:
        r = printed.hitch_ratios(hitch, S, L4, L7, printed.hitch_pins(hitch, S, L4, L7))
        return np.array([r[f"dphi{k}"] for k in range(3, 8)])

    def derivatives(order: int, as_printed: Callable[[], Any] | None = None) -> list[Method]:
        return rivals.derivative_methods(chain, S, hitch.S_max - hitch.S_min, order, as_printed)

    def reactions(strokes: Any, positions: Sequence[Numbers]) -> list[Method]:
        return rivals.reaction_methods(hitch, strokes, L4, L7, np.array([complex(p["PS6_S"]) for p in positions]))

    second = [exact.second_analogues(hitch, s, L4, L7) for s in S]
    pins = [exact.four_bar(crank.l_1, crank.l_A, crank.l_B, B, t)["C"] for t in q.tolist()]
    positions, found = rivals.position_methods, list(lengths.values())
    jobs = (
        Job("1.1", "Position of the hitch", of(("P23_S", "P45_S", "P67_S")), positions(chain, S, printed_pins)),
        Job("1.2", "Position of a dyad", pins, positions(dyad, q, printed_dyad)),
        Job("2.1", "Velocity analogues", of(f"dphi{k}" for k in range(3, 8)), derivatives(1, printed_analogues)),
        Job("2.2", "Acceleration analogues", np.array(second, object).T.ravel().tolist(), derivatives(2)),
        Job("3.1", "Find from the document's guesses", found, rivals.find_methods(hitch, [1.0])),
        Job("3.2", "Find from bad guesses", found * len(factors), rivals.find_methods(hitch, factors)),
        Job("4.1", "Reactions", of(REACTIONS), reactions(S, at)),
        Job("4.2", "Reactions, mast upright", of(REACTIONS, [upright]), reactions(np.array([S_p]), [upright])),
    )
    return {job.number: job for job in jobs}


def _position_ways(hitch: Any, S: Strokes, L4: float, L7: float) -> Ways:
    return {
        "library": lambda n: partial(chain_pins, hitch_chain(hitch, L4, L7), S(n)),
        "printed": lambda n: partial(printed.hitch_pins, hitch, S(n), L4, L7),
    }


def _reaction_ways(hitch: Any, S: Strokes, L4: float, L7: float) -> Ways:
    def way(k: int) -> Callable[[int], Callable[[], Any]]:
        return lambda n: rivals.reaction_methods(hitch, S(n), L4, L7, np.full(n, 2 + 0.5j))[k].run

    return {name: way(k) for k, name in enumerate(("library", "printed", "dense", "least squares"))}


_BATCHES: Mapping[str, tuple[str, Callable[[Any, Strokes, float, float], Ways]]] = {
    "1.3": ("Time of a position", _position_ways),
    "3.3": ("Time of a Find", lambda hitch, *_: rivals.rod_ways(hitch)),
    "4.3": ("Time of the reactions", _reaction_ways),
}


def batch_times(number: str, hitch: Any, sizes: Sequence[int], seconds: float) -> Table:
    """Table of the time for one of n positions or Finds computed at once: 1.3, 3.3 or 4.3."""
    title, make_ways = _BATCHES[number]
    L4, _, L7 = map(float, exact.finds(hitch).values())
    ways = make_ways(hitch, partial(linspace, hitch.S_min, hitch.S_max), L4, L7)
    times = np.array([time for _, time in timed([make(n) for n in sizes for make in ways.values()], seconds)])
    each = 1e6 * times.reshape(len(sizes), len(ways)) / np.array(sizes)[:, None]
    columns = [Column(name, "µs", "time of one of them", 2, each[:, k]) for k, name in enumerate(ways)]
    return Table(number, title, (Column("count", "-", "computed at once", 0, np.array(sizes, float)), *columns))
