"""How fast sweeps are: ratios to other ways, on the same machine and in the same run.

    python tests/benchmarks/bench_sweep.py

Those compared take turns, several rounds; the times are medians of the processor's time, as all of them run in one
thread, and the results are compared too. The extra ``bench`` brings the rivals: numba for the loop by hand, pylinkage
for its ensemble. Where one is missing, a line says so.
"""

import argparse
import gc
import sys
import time
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from hitch_results import COMPLEX, INPUTS, PER_POSITION, PER_VARIANT, widths
from scipy.optimize import fsolve

from mechsheet.mechanics.crank import crank
from mechsheet.mechanics.planar import link_point
from mechsheet.mechanics.roots import _PLACES
from mechsheet.mechanics.rrr import rrr
from mechsheet.studies.sweep import sweep
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load

HITCH = Path(__file__).parents[2] / "worksheets" / "hitch.py"
WANT = [*PER_VARIANT, *PER_POSITION]
POSITIONS = 10


def medians(*jobs: Callable[[], Any], rounds: int) -> list[float]:
    """Median seconds of the processor for each job; they take turns."""
    seconds = np.empty((rounds, len(jobs)))
    for row in seconds:
        for i, job in enumerate(jobs):
            start = time.process_time()
            job()
            row[i] = time.process_time() - start
    return list(np.median(seconds, axis=0))


def compared(rival: str, run: Callable[[], object]) -> bool:
    """Whether the rival is there to be compared with; a line says it where it is not."""
    try:
        run()
    except ModuleNotFoundError as missing:
        print(f"{rival} is not compared: {missing.name} is not installed (extra bench)")
        return False
    return True


# --- the whole document ------------------------------------------------------------------------------------------


def table(count: int) -> dict[str, np.ndarray]:
    """Variants of a third of the inputs, within 2 %, all of which can be assembled."""
    rng = np.random.default_rng(1)
    default = {"X01": 0.415, "X07": 0.415, "Y07": 0.895, "L3": 0.2, "L5": 0.48, "L6": 0.515, "L34": 0.325, "L56": 1.035}
    default |= {"S_min": 0.42, "Y_P56": 0.4, "P6": 27500, "X6": 0.857}
    return {name: x * (1 + 0.02 * rng.uniform(-1, 1, count)) for name, x in default.items()}


def compiled(variants: dict[str, np.ndarray], samples: int) -> Callable[[], tuple[np.ndarray, np.ndarray]]:
    """The loop by hand, with so many samples of the interval of each Find."""
    from compiled_hitch import hitch  # needs numba

    sheet, count = load(HITCH), len(variants["P6"])
    places = (1 - np.cos(np.linspace(0, np.pi, samples))) / 2

    def run() -> tuple[np.ndarray, np.ndarray]:
        given = inputs.variants(sheet.inputs, variants)
        g = inputs.instance(sheet.inputs, given.at(np.arange(count)))
        columns = np.empty((count, len(INPUTS)))
        for i, name in enumerate(INPUTS):
            columns[:, i] = np.ravel(getattr(g, name))
        a, b = np.empty((count, widths(PER_VARIANT))), np.empty((count, POSITIONS, widths(PER_POSITION)))
        hitch(columns, places, a, b)
        return a, b

    return run


def difference(swept: Any, found: tuple[np.ndarray, np.ndarray]) -> float:
    """Largest relative difference of any result, by its greatest value."""
    worst = 0.0
    for names, values in zip((PER_VARIANT, PER_POSITION), found, strict=True):
        i = 0
        for name in names:
            own = values[..., i] + 1j * values[..., i + 1] if name in COMPLEX else values[..., i]
            i += 2 if name in COMPLEX else 1
            worst = max(worst, np.max(np.abs(own - swept[name])) / np.max(np.abs(own)))
    return worst


def whole_document(sizes: list[int], rounds: int) -> None:
    print(f"\nwhole hitch document, {len(WANT)} results, {POSITIONS} positions a variant")
    few = table(10)
    sweep(HITCH, WANT, few)  # loads
    rivals = [len(_PLACES), 24] if compared("the compiled loop", lambda: compiled(few, 24)()) else []  # compiles
    heading = "variant-positions   sweep, s   us each"
    if rivals:
        print(f"ratio of the times where the Finds of the loop take {len(_PLACES)} samples, as find does, and where 24")
        heading += "   ratio, same search   ratio, 24 samples   largest difference"
    print(heading)
    seconds = []
    for size in sizes:
        variants = table(size // POSITIONS)
        jobs = [lambda v=variants: sweep(HITCH, WANT, v), *(compiled(variants, samples) for samples in rivals)]
        own, *others = medians(*jobs, rounds=max(rounds, 3 * 10**4 // size))
        seconds.append(own)
        ratios = "".join(f" {own / other:19.2f}" for other in others)
        apart = f" {difference(jobs[0](), jobs[1]()):20.1e}" if rivals else ""
        print(f"{size:17,d} {own:10.3f} {own / size * 1e6:9.2f}{ratios}{apart}", flush=True)
    if len(sizes) == 1:
        return
    slope, fixed = np.polyfit(sizes, seconds, 1, w=1 / np.array(seconds))
    off = np.max(np.abs(fixed + slope * np.array(sizes) - seconds) / seconds)
    print(f"line through all sizes: {fixed * 1e3:.1f} ms + {slope * 1e6:.2f} us each, at most {off:.0%} off")


def memory(sizes: list[int]) -> None:
    """Peak of what a sweep holds beside its inputs and results: its chunks, however many variants there are."""
    print("\nmemory of a sweep of the capacity and the suspension axis, beside the inputs and results that are kept")
    print("variant-positions   kept, MB   peak beside it, MB")
    for size in sizes:
        variants = table(size // POSITIONS)
        gc.collect()
        tracemalloc.start()
        swept = sweep(HITCH, ["GS6", "P56_S"], variants)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        kept = sum(swept[name].nbytes for name in swept.names) + sum(x.nbytes for x in swept.inputs.values())
        print(f"{size:17,d} {kept / 1e6:10.1f} {(peak - kept) / 1e6:20.1f}", flush=True)


# --- geometry against one solver call a position -----------------------------------------------------------------

O1, O3, O5, O7 = 0.415 + 0.563j, 0.250 + 1.112j, 0.135 + 0.480j, 0.415 + 0.895j
L3, L34, L4, L5, L56, L6, L7, PHI = 0.2, 0.325, 0.6613, 0.48, 1.035, 0.515, 0.7522, np.deg2rad(22)


def geometry(S: Any) -> tuple[Any, Any, Any]:
    P23 = rrr(O1, O3, S, L3, -1)
    P34 = link_point(O3, P23, L34 * np.exp(1j * PHI))
    P45 = rrr(P34, O5, L4, L5, 1)
    P56 = link_point(O5, P45, L56)
    return P23, P56, rrr(P56, O7, L6, L7, -1)


def by_fsolve(S: np.ndarray) -> np.ndarray:
    """The six angles of the three loops by scipy.optimize.fsolve, each position from the last one."""

    def loops(phi: np.ndarray, s: float) -> list[float]:
        e = np.exp(1j * phi)
        P34 = O3 + L34 * e[1] * np.exp(1j * PHI)
        gaps = (
            O1 + s * e[0] - O3 - L3 * e[1],
            P34 + L4 * e[2] - O5 - L5 * e[3],
            O5 + L56 * e[3] + L6 * e[4] - O7 - L7 * e[5],
        )
        return [x for gap in gaps for x in (gap.real, gap.imag)]

    P23, P56, P67 = geometry(S[0])
    P34 = link_point(O3, P23, L34 * np.exp(1j * PHI))
    P45 = rrr(P34, O5, L4, L5, 1)
    phi = np.angle([P23 - O1, P23 - O3, P45 - P34, P45 - O5, P67 - P56, P67 - O7])
    found = np.empty((len(S), 6))
    for i, s in enumerate(S):
        found[i] = phi = fsolve(loops, phi, args=(s,), xtol=1e-12)
    return found


def against_fsolve(rounds: int) -> None:
    S = np.linspace(0.42, 0.67, 1000)
    many = np.linspace(0.42, 0.67, 100_000)
    own, theirs = medians(lambda: geometry(many), lambda: by_fsolve(S), rounds=rounds)
    apart = np.max(np.abs(O7 + L7 * np.exp(1j * by_fsolve(S)[:, 5]) - geometry(S)[2]))
    own, theirs = own / len(many), theirs / len(S)
    print(f"\ngeometry of a position: {own * 1e9:.0f} ns, scipy.optimize.fsolve {theirs * 1e6:.0f} us", end="")
    print(f": {theirs / own:.0f} times faster, {apart:.0e} m apart")


# --- geometry against pylinkage's ensemble -----------------------------------------------------------------------


def against_pylinkage(rounds: int) -> None:
    """The hitch driven by its lift arm, at an even rate: pylinkage has no cylinder as a driver of an ensemble."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRRDyad
    from pylinkage.population import Ensemble
    from pylinkage.simulation import Linkage

    print("\nhitch driven by its lift arm, pylinkage's ensemble against the library in blocks of 4000 elements")
    start, end, s6 = 0.6, -0.1, 0.857 - 0.2j
    for members, positions in ((10_000, 10), (1000, 100)):
        rate = (end - start) / (positions - 1)
        rng = np.random.default_rng(1)
        lengths = np.array([L34, L4, L5, L56, L6, L7]) * (1 + 0.01 * rng.uniform(-1, 1, (members, 6)))
        phi = start + rate * np.arange(positions)

        def points(rows: slice, phi: np.ndarray = phi, lengths: np.ndarray = lengths) -> tuple[np.ndarray, ...]:
            r34, r4, r5, r56, r6, r7 = lengths[rows, :, None].transpose(1, 0, 2)
            P34 = crank(O3, r34, phi)
            P45 = rrr(P34, O5, r4, r5, 1)
            P56 = link_point(O5, P45, r56)
            P67 = rrr(P56, O7, r6, r7, -1)
            return P34, P45, P56, P67, link_point(P56, P67, s6)

        def own(members: int = members, positions: int = positions, points: Any = points) -> np.ndarray:
            found, step = np.empty((5, members, positions), complex), 4000 // positions
            for i in range(0, members, step):
                found[:, i : i + step] = points(slice(i, i + step))
            return found

        before = [p[:, 0] for p in points(slice(None), phi=np.array([start - rate]))]
        grounds = [Ground(z.real, z.imag) for z in (O3, O5, O7)]
        arm = Crank(grounds[0], L34, angular_velocity=rate, initial_angle=start - rate)
        p45 = RRRDyad(arm.output, grounds[1], L4, L5)
        p56 = FixedDyad(grounds[1], p45, L56, 0.0)
        p67 = RRRDyad(p56, grounds[2], L6, L7)
        s = FixedDyad(p56, p67, abs(s6), float(np.angle(s6)))
        linkage = Linkage([*grounds, arm, p45, p56, p67, s])
        places = np.array([np.broadcast_to(z, members) for z in (O3, O5, O7, *before)]).T
        r34, r4, r5, r56, r6, r7 = lengths.T
        fixed = (np.zeros(members), np.full(members, abs(s6)), np.full(members, np.angle(s6)))
        dimensions = np.column_stack([r34, r4, r5, r56, fixed[0], r6, r7, *fixed[1:]])
        ensemble = Ensemble(linkage, dimensions, np.stack([places.real, places.imag], axis=-1))

        def theirs(ensemble: Ensemble = ensemble, positions: int = positions) -> np.ndarray:
            return ensemble.simulate(positions, store=False)

        found = theirs()
        apart = np.max(np.abs(found[:, :, 3:, 0] + 1j * found[:, :, 3:, 1] - np.moveaxis(own(), 0, -1)))
        a, b = medians(own, theirs, rounds=rounds)
        each = 1e9 / members / positions
        print(
            f"{members:6d} variants x {positions:3d} positions: {a * each:.0f} ns each, pylinkage {b * each:.0f} ns: "
            f"{b / a:.2f} times faster, {apart:.0e} m apart"
        )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--largest", type=float, default=1e6, help="variant-positions of the whole document")
    options = parser.parse_args()
    compared("pylinkage's ensemble", lambda: against_pylinkage(max(options.rounds, 5)))
    against_fsolve(options.rounds)
    whole_document([n for n in (10**3, 10**4, 10**5, 10**6) if n <= options.largest], options.rounds)
    memory([n for n in (10**5, 10**6, 3 * 10**6) if n <= 3 * options.largest])
    sys.exit()
