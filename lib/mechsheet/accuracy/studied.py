"""Studies: what they cost beside one run of a worksheet, and their results beside 50 digits and other ways to them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import acb, arb
from numpy import exp, pi
from scipy.optimize import fsolve

from mechsheet.accuracy import arithmetic, exact, plain, sections
from mechsheet.accuracy.arithmetic import Numbers, in_balls, mpf
from mechsheet.accuracy.chains import hitch_chain
from mechsheet.accuracy.conditioning import condition
from mechsheet.accuracy.finding import by_inverse
from mechsheet.accuracy.jobs import inputs_of
from mechsheet.accuracy.precision import Job, Method
from mechsheet.accuracy.rivals import UNCHECKED, family, powers
from mechsheet.accuracy.timing import STEPS, time_spread, timed
from mechsheet.mechanics.joint import neutral_axis
from mechsheet.mechanics.rrr import rrr
from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.readers import numbers as computed
from mechsheet.readers.gradients import gradient
from mechsheet.readers.slopes import slopes
from mechsheet.recording.evaluation import evaluate
from mechsheet.recording.record import record
from mechsheet.run import report
from mechsheet.run.progress import progress
from mechsheet.run.proving import proof_of
from mechsheet.worksheet import shown
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.find import find
from mechsheet.worksheet.table import Column, Table

_CENTRES = np.linspace(0.7, 0.9, 40)  # m, of the hitch's implement
_STEP = mpf(10) ** -30  # relative, of an input at 50 digits
_STARTS = 4  # of each unknown


def study_jobs(path: Path, crank: Any, sweep: Callable[..., Any], sensitivity: Callable[..., Any]) -> dict[str, Job]:
    """Jobs 8.1 to 8.4: two unknowns, the neutral axis, a sweep and a sensitivity of the hitch's worksheet at ``path``.

    ``crank`` has l_1, l_A, l_B, X_B, Y_B [m]; the two studies are handed in, which stand above this room.
    """
    hitch = load(path).inputs()
    jobs = two_unknowns(crank), axes(), _sweep(path, hitch, sweep), _sensitivity(path, hitch, sweep, sensitivity)
    return {job.number: job for job in jobs}


# --- two unknowns ---------------------------------------------------------------------------------------------------


def two_unknowns(crank: Any) -> Job:
    """The angles of the links of the dyad that its crank puts nearest, every solution in a full turn of both."""
    l_A, l_B, B = crank.l_A, crank.l_B, crank.X_B - crank.l_1 + 1j * crank.Y_B

    def loop(alpha: Any, beta: Any) -> Any:
        gap = l_A * exp(1j * alpha) - B - l_B * exp(1j * beta)
        return gap.real, gap.imag

    def slopes(x: Any) -> Any:
        a, b = 1j * l_A * exp(1j * x[0]), -1j * l_B * exp(1j * x[1])
        return [[a.real, b.real], [a.imag, b.imag]]

    @in_balls
    def solutions() -> Numbers:
        pins = [arithmetic.rrr(acb(0), acb(B), arb(l_A), arb(l_B), side) for side in (-1, +1)]
        return {"x": [x for C in pins for x in (C.arg(), (C - acb(B)).arg())]}

    def by_find() -> Any:
        found = find(loop, unknown_unit="rad", unit="m", alpha=(-pi, pi), beta=(-pi, pi))
        return np.array(found.solutions).ravel()

    def by_starts() -> Any:
        solve: Any = partial(fsolve, lambda x: loop(*x), fprime=slopes, xtol=1e-14, full_output=True)
        places, found = np.linspace(-pi, pi, _STARTS, endpoint=False), list[Any]()
        for start in np.array(np.meshgrid(places, places)).reshape(2, -1).T:
            x, _, ended, _ = solve(start)
            x = np.angle(exp(1j * x))
            if ended == 1 and all(np.abs(x - other).max() > 1e-6 for other in found):
                found.append(x)
        return np.array(sorted(found, key=lambda x: x[0])).ravel()

    starts = Method("fsolve from starts", f"{_STARTS} × {_STARTS}", by_starts, "only what its starts lead to")
    given = {"l_A": l_A, "l_B": l_B, "B": B}

    def angles(x: Any) -> Any:
        pins = [rrr(0j, x["B"], x["l_A"], x["l_B"], side) for side in (-1, +1)]
        return np.array([np.angle(link) for C in pins for link in (C, C - x["B"])])

    def closed() -> Any:
        pins = [plain.rrr(0j, B, l_A, l_B, side) for side in (-1, +1)]
        return np.array([np.angle(link) for C in pins for link in (C, C - B)])

    form = Method("closed form, no checks", "", closed, f"thought out for each, {UNCHECKED}")
    truth, ways = solutions()["x"], [Method("find", "", by_find), form, starts]
    return Job("8.1", "Two unknowns, every solution", truth, ways, condition(angles, given))


# --- neutral axis ---------------------------------------------------------------------------------------------------


def axes() -> Job:
    """Forces of 24 elements under 40 moments beside a normal force."""
    y, A_t, A_c, N = np.linspace(-0.1, 0.1, 24), np.full(24, 2e-4), np.full(24, 3e-4), -1e4
    M = np.linspace(1e3, 1e5, 40)
    truth = [force for moment in M.tolist() for force in sections.section(y, A_t, A_c, moment, N)["P"]]

    def iterated() -> Any:
        """The document's iteration: areas by the signs of the stresses that they lead to, until they stay."""
        A = np.broadcast_to(A_c, (M.size, y.size))
        for _ in range(100):
            F = A.sum(-1)
            y_c = A @ y / F
            lever = y - y_c[:, None]
            slope = (M - N * y_c) / (A * lever**2).sum(-1)
            sigma = (N / F)[:, None] + slope[:, None] * lever
            others = np.where(sigma > 0, A_t, A_c)
            if np.array_equal(A, others):
                break
            A = others
        return sigma * A

    def each(moment: float) -> Any:
        def areas(x: Any) -> Any:
            return np.where(x[0] + x[1] * y > 0, A_t, A_c)

        def loads(x: Any) -> Any:
            forces = areas(x) * (x[0] + x[1] * y) * 1e6
            return forces.sum() / 1e4 - N / 1e4, (forces * y).sum() / 1e3 - moment / 1e3

        def slopes(x: Any) -> Any:
            A = areas(x)
            return [[A.sum() * 1e2, (A * y).sum() * 1e2], [(A * y).sum() * 1e3, (A * y**2).sum() * 1e3]]

        x, *_ = fsolve(loads, [0.0, 1.0], fprime=slopes, xtol=1e-14, full_output=True)
        return areas(x) * (x[0] + x[1] * y) * 1e6

    ways = [
        Method("neutral_axis", "", lambda: neutral_axis(y, A_t, A_c, M, N).force),
        Method("document's iteration", "", iterated, f"{UNCHECKED}, no proof that it ends"),
        Method(
            "fsolve, each case", "", lambda: np.array([each(moment) for moment in M.tolist()]), "no proof that it ends"
        ),
    ]
    given = {"y": y, "A_t": A_t, "A_c": A_c, "M": M, "N": N}
    kappa = condition(lambda x: neutral_axis(**x).force, given)
    return Job("8.2", "Neutral axis of 24 elements", truth, ways, kappa)


# --- sweep and sensitivity of a worksheet ---------------------------------------------------------------------------


def _strokes(g: Any) -> Any:
    return np.linspace(g.S_min, g.S_max, g.N_pol)


def _sweep(path: Path, hitch: Any, sweep: Callable[..., Any]) -> Job:
    S, ends = _strokes(hitch), [0, -1]
    truth = [exact.hitch(replace(hitch, X6=x), S[k])["GS6"] for x in _CENTRES.tolist() for k in ends]
    known = {name: float(x) for name, x in exact.finds(hitch).items()}

    def one_by_one() -> Any:
        return [evaluate(path, ["GS6"], X6=x)["GS6"][ends] for x in _CENTRES.tolist()]

    given = inputs_of(hitch) | known | {"X6": _CENTRES[:, None]}

    def written_out(x: Mapping[str, Any]) -> Any:
        g = SimpleNamespace(**vars(hitch) | x)
        return _capacity(g, _strokes(g), x)

    ways = [
        Method("sweep", "", lambda: sweep(path, ["GS6"], {"X6": _CENTRES})["GS6"][:, ends]),
        Method("evaluate, one by one", "", one_by_one),
        Method("closed form, no checks", "", lambda: written_out(given)[:, ends], f"thought out for each, {UNCHECKED}"),
    ]
    kappa = condition(written_out, given)
    return Job("8.3", "Sweep of 40 centres of mass", truth, ways, kappa)


def _capacity(g: Any, S: Any, known: Mapping[str, Any]) -> Any:
    """GS6 of the hitch at the strokes S with its lengths known, by closed forms alone."""
    chain = hitch_chain(g, known["L4"], known["L7"])
    (P6, a, _), (_, a_w, _) = (chain.plain_links(S)[2] for S in (S, np.array([known["S_p"]])))
    _, _, dphi5, dphi6, _ = chain.plain_analogues(1, S)
    height = dphi5 * (P6 - chain.dyads[1].B).real + dphi6 * ((g.X6 + 1j * g.Y6) / a_w * a).real
    return g.k_gc * g.P_gc_max * g.eta * pi * g.D_gc**2 / 4 / height


def _sensitivity(path: Path, hitch: Any, sweep: Callable[..., Any], sensitivity: Callable[..., Any]) -> Job:
    first, at = sensitivity(path, ["GS6"]), [0, 4]
    names = [name for name, x in first.inputs.items() if x]
    rows = [list(first.inputs).index(name) for name in names]

    def moved(name: str, way: int, k: int) -> Any:
        x = {key: mpf(value) for key, value in exact.numbers(hitch).items()}
        x[name] *= 1 + way * _STEP
        S = x["S_min"] + (x["S_max"] - x["S_min"]) * k / (hitch.N_pol - 1)
        return exact.hitch(SimpleNamespace(**x), S)["GS6"]

    def exactly(name: str, k: int) -> Any:
        ahead, behind = moved(name, 1, k), moved(name, -1, k)
        return (ahead - behind) / (ahead + behind) / _STEP

    def swept(steps: Sequence[float]) -> Any:
        """The capacity by one sweep of all inputs, each moved by these parts of itself; shape (steps, inputs, 2)."""
        ways = np.concatenate([step * np.eye(len(names)) for step in steps])
        values = sweep(path, ["GS6"], {name: first.inputs[name] * (1 + ways[:, i]) for i, name in enumerate(names)})
        return values["GS6"][:, at].reshape(len(steps), len(names), -1)

    def differences(step: float) -> Any:
        ahead, behind = swept([step, -step])
        return (ahead - behind) / (2 * step) / ((ahead + behind) / 2)

    def five_points(step: float) -> Any:
        p, r, s, t = swept([-step, step, -2 * step, 2 * step])
        return (8 * (r - p) - (t - s)) / (12 * step) / ((4 * (p + r) - (s + t)) / 6)

    def elasticities(x: Mapping[str, Any]) -> Any:
        """By closed forms, of differences so wide that theirs tell the condition number."""
        ways = 1e-3 * np.concatenate([np.eye(len(names)), -np.eye(len(names))])
        moved = {name: x[name] * (1 + ways[:, [i]]) for i, name in enumerate(names)}
        g = SimpleNamespace(**vars(hitch) | moved)
        known = dict(zip(("L4", "S_p", "L7"), by_inverse(g), strict=True))
        S = g.S_min + (g.S_max - g.S_min) * np.array(at) / (hitch.N_pol - 1)
        ahead, behind = np.log(_capacity(g, S, known)).reshape(2, len(names), -1)
        return (ahead - behind) / 2e-3

    truth = [exactly(name, k) for name in names for k in at]
    kappa = condition(elasticities, {name: x for name, x in inputs_of(hitch).items() if name in names})
    ways = [
        Method("sensitivity", "", lambda: sensitivity(path, ["GS6"]).relative("GS6")[rows][:, at]),
        *family("differences by a sweep", powers(4, 8, 2), differences),
        *family("differences of five points", powers(2, 4), five_points),
    ]
    return Job("8.4", "Sensitivity of the capacity to every input", truth, ways, kappa)


# --- costs ----------------------------------------------------------------------------------------------------------


def study_costs(number: str, path: Path, studies: Mapping[str, Callable[[], Any]], seconds: float) -> Table:
    """Table of the run times of studies and of the readers of a worksheet's recording, as multiples of one run, too."""
    clock_read()  # before anything is run for it
    sheet, title = load(path), "Cost of studies"
    given = {"g": sheet.inputs()}
    names = sheet.run(sheet.results, given) | {"__file__": str(path)}
    recording = record(names, sheet)
    inputs = [node for node in recording.inputs.values() if node.size == 1 and node.value.dtype.kind == "f"]
    columns = [part for table in recording.tables.values() for c in table if c is not None for part in c.parts]

    def written() -> list[tuple[str, str]]:
        values = sheet.run(sheet.results, given).values()
        return [shown.page().written(value) for value in values if isinstance(value, shown.Shown)]

    ways: dict[str, Callable[[], Any]] = {
        "a run of the worksheet's cells": partial(sheet.run, sheet.results, given),
        "the run recorded": partial(record, names, sheet),
        "its tables computed by the recording": partial(
            computed.numbers, columns, {node: node.value for node in inputs}
        ),
        "their slopes by one input": partial(slopes, columns, inputs[:1]),
        f"their slopes by all {len(inputs)} inputs": partial(slopes, columns, inputs),
        f"one number's slopes by all {len(inputs)} inputs": partial(gradient, columns[-1], 0, inputs),
        "all their digits proved": partial(proof_of, names, sheet, record(names, sheet, exact=True)),
        "its workbook written": partial(report.workbook, path.stem, names, {}),
        "a run, and the HTML of all that it shows": written,
        **studies,
    }
    with progress(STEPS * len(ways), f"{number} {title}") as done:
        taken = timed(list(ways.values()), seconds, done)
    ms = 1e3 * np.array([time.seconds for time in taken])
    columns_of = (
        Column("study", "", "", 0, np.array(list(ways), object)),
        Column("time", "ms", "median of the run times", 1, ms),
        Column("of a run", "-", "time over that of a run of the worksheet's cells", 2, ms / ms[0]),
        *time_spread(taken),
    )
    return Table(number, title, columns_of)
