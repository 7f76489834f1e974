"""Drives whose velocity equations are integrated over time, against the product, which assembles every position.

Two of them, each with one dyad: the cylinder of the hitch's lift arm behind a fast valve, whose equations are stiff,
and a crank that passes a near-dead centre, whose equations are not, however steep they are there.
"""

import cmath
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from flint import acb, arb
from scipy.integrate import solve_ivp

from mechsheet.accuracy import arithmetic
from mechsheet.accuracy.arithmetic import Numbers, in_balls
from mechsheet.accuracy.chains import Chain, Dyad, crank_chain, hinges
from mechsheet.accuracy.conditioning import condition
from mechsheet.accuracy.exact import turn
from mechsheet.accuracy.plain import rrr_turns
from mechsheet.accuracy.precision import Job, Method, largest_error
from mechsheet.accuracy.rivals import family, powers
from mechsheet.mechanics.rrr import rrr
from mechsheet.worksheet.table import Column, Table

SOLVERS = ("RK45", "DOP853", "LSODA", "BDF", "Radau")
_IMPLICIT = SOLVERS[2:]
_STROKE, _LAG = 1.0, 2e-3  # s that the lift takes, time constant of its valve
_CRANK, _COUPLER, _ROCKER, _GAP, _TURN = 1.0, 3.0, 2.0, 1e-6, (2.6, 3.7)  # m, rad: the frame is shorter by the gap
_TIMES = 10


@dataclass(frozen=True)
class Drive:
    """A dyad on a drive: ``rates(t, y)`` and their ``slopes`` by y, of which the last two are its links' angles."""

    chain: Chain
    times: Any
    start: Sequence[float]
    rates: Callable[[float, Any], list[float]]
    slopes: Callable[[float, Any], list[list[float]]]
    along: Callable[[Any], Any]  # the chain's coordinate at the times
    alone: tuple[Callable[[float, Any], list[float]], Callable[[float, Any], list[list[float]]]] | None = (
        None  # rates and slopes of all but the angles
    )

    def integrated(self, method: str, tolerance: float, at: Any = None) -> Any:
        """The result of `solve_ivp`, at its own steps where no times are given."""
        ways: dict[str, Any] = {"jac": self.slopes} if method in _IMPLICIT else {}
        solve: Any = partial(solve_ivp, self.rates, (self.times[0], self.times[-1]), self.start, method, at)
        return solve(rtol=tolerance, atol=tolerance, **ways)

    def pins(self, method: str, tolerance: float) -> Any:
        """The inner pin at the times by integration."""
        (dyad,) = self.chain.dyads
        return dyad.B + dyad.r_B * np.exp(1j * self.integrated(method, tolerance, self.times).y[-1])

    def assembled(self, method: str, tolerance: float) -> Any:
        """The inner pin at the times by assembly from the chain's coordinate, which alone is integrated."""
        assert self.alone
        rates, slopes = self.alone
        solve: Any = partial(solve_ivp, rates, (self.times[0], self.times[-1]), self.start[:-2], method, self.times)
        return self.chain.pins(solve(rtol=tolerance, atol=tolerance, jac=slopes).y[-1])

    @property
    def decays(self) -> float:
        """How many times the fastest mode decays or grows by e on the way."""
        found = self.integrated("DOP853", 1e-9)
        fastest = [
            np.max(np.abs(np.linalg.eigvals(self.slopes(t, y)).real)) for t, y in zip(found.t, found.y.T, strict=True)
        ]
        return float(np.trapezoid(fastest, found.t))


def _turning(chain: Chain, ddA: Callable[[float], complex], q: float, alpha: float, beta: float) -> tuple[Any, Any]:
    """Analogues of both links' angular velocities, and their derivatives by q, alpha and beta."""
    (d,) = chain.dyads
    u, b = cmath.exp(1j * alpha), d.r_B * cmath.exp(1j * beta)
    a, lengthens = d.length(q) * u, d.r_A is None
    x, y = rrr_turns(a, b, -chain.dA(q) - (u if lengthens else 0))
    changes = -1j * x * u if lengthens else -ddA(q), x * a - (1j * u if lengthens else 0), -y * b
    return (x, y), [rrr_turns(a, b, w) for w in changes]


def lift(h: Any) -> Drive:
    """The lift arm of the hitch over time: the valve opens within its time constant, the stroke takes a second."""
    O1, O3, *_ = hinges(h)
    chain = Chain(lambda q: O1 + 0 * q, lambda q: 0 * q, (Dyad(O3, None, h.L3, -1),))
    speed = (h.S_max - h.S_min) / _STROKE

    def rates(_: float, y: Any) -> list[float]:
        opening, S, alpha, beta = y
        turning, _slopes = _turning(chain, complex, S, alpha, beta)
        return [(1 - opening) / _LAG, *(rate * speed * opening for rate in (1, *turning))]

    def valve(_: float, y: Any) -> list[float]:
        return [(1 - y[0]) / _LAG, speed * y[0]]

    def slopes(_: float, y: Any) -> list[list[float]]:
        opening, S, alpha, beta = y
        turning, by = _turning(chain, complex, S, alpha, beta)
        rows = [[rate * speed, *(change[k] * speed * opening for change in by)] for k, rate in enumerate(turning)]
        return [[-1 / _LAG, 0, 0, 0], [speed, 0, 0, 0], *rows]

    times = np.linspace(0, _STROKE, _TIMES)
    start = [0.0, h.S_min, *chain.angles(np.array([h.S_min]))[:, 0]]

    def along(t: Any) -> Any:
        return h.S_min + speed * (t + _LAG * np.expm1(-t / _LAG))

    alone = valve, lambda *_: [[-1 / _LAG, 0], [speed, 0]]
    return Drive(chain, times, start, rates, slopes, along, alone)


def crank_past_dead_centre() -> Drive:
    """A four-bar linkage whose coupler and rocker miss their line by a millionth of the crank."""
    chain = crank_chain(_CRANK, _COUPLER + _ROCKER - _CRANK - _GAP, _COUPLER, _ROCKER)

    def ddA(q: float) -> complex:
        return -_CRANK * cmath.exp(1j * q)

    def rates(q: float, y: Any) -> list[float]:
        return list(_turning(chain, ddA, q, *y)[0])

    def slopes(q: float, y: Any) -> list[list[float]]:
        _, (_, by_alpha, by_beta) = _turning(chain, ddA, q, *y)
        return [[by_alpha[k], by_beta[k]] for k in (0, 1)]

    times = np.linspace(*_TURN, _TIMES)
    return Drive(chain, times, chain.angles(times[:1])[:, 0].tolist(), rates, slopes, lambda t: t)


@in_balls
def _lift_pins(h: Any, times: Sequence[float]) -> Numbers:
    O1, O3 = (acb(arb(getattr(h, f"X0{k}")), arb(getattr(h, f"Y0{k}"))) for k in (1, 3))
    S_min, speed, lag = arb(h.S_min), (arb(h.S_max) - arb(h.S_min)) / arb(_STROKE), arb(_LAG)
    strokes = [S_min + speed * (t + lag * ((-t / lag).exp() - 1)) for t in map(arb, times)]
    return {"C": [arithmetic.rrr(O1, O3, S, arb(h.L3), -1) for S in strokes]}


@in_balls
def _crank_pins(drive: Drive) -> Numbers:
    a, (d,) = arb(_CRANK), drive.chain.dyads
    pins = [a * turn(arb(q)) for q in drive.times.tolist()]
    return {"C": [arithmetic.rrr(A, acb(d.B), arb(d.r_A), arb(d.r_B), +1) for A in pins]}


def response_jobs(at: tuple[str, str], h: Any) -> list[Job]:
    """The pin at ten times of both drives, by assembly and by integration."""
    arm, crank = lift(h), crank_past_dead_centre()
    (d,), (e,) = arm.chain.dyads, crank.chain.dyads
    of_arm = {"O1": arm.chain.A(0), "O3": d.B, "L3": d.r_B, "S": arm.along(arm.times)}
    of_crank = {"a": _CRANK, "B": e.B, "r_A": e.r_A, "r_B": e.r_B, "q": crank.times}
    kappas = (
        condition(lambda x: rrr(x["O1"], x["O3"], x["S"], x["L3"], -1), of_arm),
        condition(lambda x: rrr(x["a"] * np.exp(1j * x["q"]), x["B"], x["r_A"], x["r_B"], +1), of_crank),
    )
    truths = _lift_pins(h, arm.times.tolist())["C"], _crank_pins(crank)["C"]
    return [
        Job(at[0], "Cylinder behind a fast valve", truths[0], _methods(arm, powers(5, 9, 4)), kappas[0]),
        Job(at[1], "Crank past a dead centre", truths[1], _methods(crank, powers(6, 9, 3)), kappas[1]),
    ]


def _methods(drive: Drive, tolerances: Sequence[float]) -> list[Method]:
    ways = [Method("library: assembled", "", lambda: drive.chain.pins(drive.along(drive.times)))]
    for solver in SOLVERS:
        ways += family(f"solve_ivp {solver}", tolerances, partial(drive.pins, solver))
    for solver in ("LSODA", "Radau") if drive.alone else ():
        ways += family(f"{solver} of the drive, assembled", tolerances, partial(drive.assembled, solver))
    return ways


def integration_steps(number: str, h: Any, tolerances: Sequence[float] = (1e-3, 1e-7)) -> Table:
    """Table of the steps, evaluations, Jacobians, decompositions and errors of each solver on both drives."""
    arm, crank = lift(h), crank_past_dead_centre()
    drives = {"cylinder behind a fast valve": arm, "crank past a dead centre": crank}
    truths = dict(zip(drives, (_lift_pins(h, arm.times.tolist())["C"], _crank_pins(crank)["C"]), strict=True))
    rows = [
        (name, tolerance, solver, drive.integrated(solver, tolerance))
        for name, drive in drives.items()
        for tolerance in tolerances
        for solver in SOLVERS
    ]
    decays = {name: drive.decays for name, drive in drives.items()}
    counts = {"steps": [len(r.t) - 1 for *_, r in rows], "evaluations": [r.nfev for *_, r in rows]}
    errors = [largest_error(drives[name].pins(solver, tol), truths[name]) for name, tol, solver, _ in rows]
    counts |= {"jacobians": [r.njev for *_, r in rows], "decompositions": [r.nlu for *_, r in rows]}
    columns = (
        Column("drive", "", "", 0, np.array([name for name, *_ in rows], object)),
        Column(
            "decays",
            "-",
            "of the fastest mode, by e each, on the way: the stiffness",
            0,
            np.array([decays[r[0]] for r in rows]),
        ),
        Column("tolerance", "-", "relative and absolute", 0, np.array([row[1] for row in rows]), power=True),
        Column("method", "", "of solve_ivp", 0, np.array([row[2] for row in rows], object)),
        *(Column(name, "-", "", 0, np.array(values, float)) for name, values in counts.items()),
        Column("error", "-", "largest of the pin over the largest number, at most 1", 1, np.array(errors), power=True),
    )
    return Table(number, "Steps of the integrators", columns)
