"""The documents' exact results: at 50 digits from their inputs, at any of their positions."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from mechsheet.accuracy import exact
from mechsheet.accuracy.arithmetic import Numbers, mp, mpf


class Truth(NamedTuple):
    """Of a worksheet: its field of positions, the exact one at a part of the way, and the exact results at a position.

    ``compared`` are the results of its run that are: all, where none are named.
    """

    field: str
    at: Callable[[Any, mpf], mpf]
    results: Callable[[Any, Any], Numbers]
    compared: Sequence[str] = ()

    def from_inputs(self, g: Any, k: int, n: int) -> Numbers:
        """Exact results at the k-th of n positions, which no float has been before."""
        return self.results(g, self.at(g, mpf(k) / (n - 1)))


def _length(g: Any, t: mpf) -> mpf:
    made = exact.stroke(g)
    return made["l20"] + made["H"] * t


TRUTHS: dict[str, Truth] = {
    "hitch": Truth("S", lambda g, t: g.S_min + (mpf(g.S_max) - g.S_min) * t, exact.hitch),
    "landing_gear": Truth("l2i", _length, exact.landing_gear, ("Ai", "omega3_l2i", "eps3_l2i", "F_c")),
    "slotted_link": Truth("phi1_k", lambda g, t: g.phi_0 + mp.sign(g.omega1) * 2 * mp.pi * t, exact.slotted_link),
    "kinetostatics": Truth("phi1", lambda _, t: 2 * mp.pi * t, exact.kinetostatics),
}


def exact_results(stem: str, names: Mapping[str, Any], rows: Iterable[int]) -> Numbers:
    """Results of a worksheet at 50 digits at some of its positions, by name; of the joint, which has none, all."""
    if stem == "joint":
        g = names["g"]
        cases = ((plane, case) for plane in (1, 2) for case in range(len(g.loads.M)))
        return {"P": [force for at in cases for force in exact.joint(g, exact.factors(g), *at)["P"]]}
    truth = TRUTHS[stem]
    at = [truth.results(names["g"], float(names[truth.field][i])) for i in rows]
    return {name: [p[name] for p in at] for name in truth.compared or at[0].keys() & names.keys()}
