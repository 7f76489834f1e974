"""The five kinds of Assur groups: what the library says of one, and the same from its position alone.

The exact position is that of `arithmetic`. Where what a group is given moves, the derivatives of its position come with
it (`Taylor`); its reactions are told by virtual work: of a pin that moves on by one, of a guide that moves or turns. So
nothing of it rests on a formula of the library, and it takes numbers of any kind.
"""

from collections.abc import Callable, Mapping
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from flint import acb, arb

from mechsheet.accuracy import arithmetic
from mechsheet.accuracy.arithmetic import Numbers, cross, dot, in_balls, point, root
from mechsheet.accuracy.conditioning import changes
from mechsheet.accuracy.taylor import Taylor
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.prp import PRPGroup
from mechsheet.mechanics.rpp import RPPGroup
from mechsheet.mechanics.rpr import RPRGroup
from mechsheet.mechanics.rrp import RRPGroup
from mechsheet.mechanics.rrr import RRRGroup

Given = Mapping[str, Any]  # numbers, or arrays of them, by name
# Force, point and couple on the body next to A, and on the one next to B.
_LOADS = ("F_A", "P_A", "T_A", "F_B", "P_B", "T_B")
_COMPLEX = {"A", "B", "u", "w", "v_A", "v_B", "a_A", "a_B", "F_A", "P_A", "F_B", "P_B"}


class Kind(NamedTuple):
    """A kind of group; the branch is +1 throughout."""

    given: tuple[str, ...]  # points, directions, lengths, offset
    first: tuple[str, ...]  # first and second derivatives of these, in the library's order
    second: tuple[str, ...]
    group: Callable[[Given], Any]  # by the library
    position: Callable[[Given], Numbers]  # its place, vectors that turn and distances by the names of their derivatives
    rates: tuple[str, str]  # these names
    bodies: tuple[tuple[str, str], tuple[str, str]]  # a point of each body, and its angular velocity
    guides: Mapping[str, str] = {}  # outer pairs that are guides, and their directions
    turned: Mapping[str, str] = {"u": "B", "w": "A"}  # the pair with which a direction turns
    place: str = "C"  # its inner pin; of RPR the direction of its slide, u

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all that is given."""
        return (*self.given, *self.first, *self.second, *_LOADS)

    @property
    def numbers(self) -> list[str]:
        """Names of the real numbers in it: a point A is A and Ay."""
        return [*chain.from_iterable((name, f"{name}y") if name in _COMPLEX else (name,) for name in self.names)]

    def joined(self, numbers: Given, real: Callable[[Any], Any], complex_of: Callable[[Any, Any], Any]) -> Numbers:
        """What is given, from its real numbers; those that are left out are zero."""
        x = {name: real(numbers.get(name, 0.0)) for name in self.numbers}
        return {name: complex_of(x[name], x[f"{name}y"]) if name in _COMPLEX else x[name] for name in self.names}

    def by_library(self, x: Given) -> Numbers:
        """Position, velocities, accelerations and reactions; arms, which are quotients of these, are left out."""
        return self._by_library(x, {self.place: getattr(self.group(x), self.place)})

    @np.errstate(over="ignore")  # in the arm of a force that is next to nothing, which is left out
    def _by_library(self, x: Given, handed: Given) -> Numbers:
        """From the position that is handed on, and accelerations from the rates that are, where some are."""
        group = self.group(x)
        object.__setattr__(group, self.place, handed[self.place])
        v = group.velocity(*(x[name] for name in self.first))
        rates = {name: handed[name] for name in self.rates if name in handed}
        a = group.acceleration(v._replace(**rates), *(x[name] for name in self.second))
        R = group.reactions([Load(x["F_A"], x["P_A"], x["T_A"])], [Load(x["F_B"], x["P_B"], x["T_B"])])
        found = {self.place: handed[self.place]} | v._asdict() | a._asdict() | R._asdict()
        return {name: y for name, y in found.items() if name not in x and not name.startswith("h_")}

    def changes_by_rounding(self, x: Given) -> Numbers:
        """By how much results change in all for relative changes of what a function of the library hands to the next.

        That are the rounded position and the rates, each beside the points and directions that the next one takes. What
        is off in a position is so in the rates that come from it, and by them in the accelerations.
        """
        found, given = self.by_library(x), [name for name in self.given if name in _COMPLEX]
        place = {self.place: found[self.place]} | {name: x[name] for name in given}
        rates = {name: found[name] for name in self.rates}

        def following(y: Given) -> Any:
            return np.array([*self._by_library({**x, **{name: y[name] for name in given}}, y).values()])

        _, with_rates = changes(following, place)
        _, beside = changes(lambda y: following({**y, **rates}), place)
        _, by_rates = changes(lambda y: following({**place, **y}), rates)
        moved = np.maximum(with_rates, beside) + by_rates
        return {name: change for name, change in zip(found, moved, strict=True) if name != self.place}

    def exact(self, x: Given) -> Numbers:
        """The same from the position, for numbers of any kind."""
        results = Numbers()
        for name, y in self.position(self._moving(x, x, 2)).items():
            here, first, second = y.of
            if name.startswith("omega"):
                rate = first / here
                results |= {name: rate.imag, name.replace("omega", "epsilon"): (second / here - rate * rate).imag}
            elif name.startswith("ds"):
                results |= {name: first, f"d{name}": second}
            else:
                results |= {"C": here, "v_C": first, "a_C": second} if name == "C" else {name: here}
        return results | self._reactions(x, results.get("C"))

    def exact_of(self, **numbers: Any) -> Numbers:
        """The same at 50 digits, from the real numbers that are given."""
        return _in_balls(self, numbers)

    def _moving(self, x: Given, rates: Given, order: int) -> dict[str, Taylor]:
        """What is given with its derivatives: those of ``rates``, all others zero."""
        still = x["A"].real * 0
        rest = point(still, still)

        def told(name: str, nothing: Any, *derivatives: str) -> Taylor:
            return Taylor(*(x[name], *(rates.get(each, nothing) for each in derivatives))[: order + 1])

        moved = {name: told(name, rest, f"v_{name}", f"a_{name}") for name in "AB"}
        for name in self.given[2:]:
            if name in self.turned:
                end, u = self.turned[name], x[name]
                omega, epsilon = rates.get(f"omega_{end}", still), rates.get(f"epsilon_{end}", still)
                moved[name] = Taylor(*(u, _left(u) * omega, _left(u) * epsilon - u * omega * omega)[: order + 1])
            else:
                moved[name] = told(name, still, f"d{name}", f"dd{name}")
        return moved

    def _reactions(self, x: Given, C: Any) -> Numbers:
        """By virtual work; what is left, by the equilibrium of the body next to A."""
        found, zero = Numbers(), x["A"].real * 0
        one = zero + 1
        for end in "AB":
            if end not in self.guides:
                along = (self._work(x, {f"v_{end}": v}) for v in (point(one, zero), point(zero, one)))
                found[f"R_{end}"] = -point(*along)
                continue
            normal = _left(_unit(x[self.guides[end]]))
            found[f"R_{end}"] = normal * -self._work(x, {f"v_{end}": normal})
            found[f"M_{end}"] = -self._work(x, {f"omega_{end}": one, f"v_{end}": _left(x[end] - C)})
        found["R_C"] = -(found["R_A"] + x["F_A"])
        if self.bodies[0][1] == self.bodies[1][1]:  # they turn together, joined by a slide
            found["M_C"] = -(x["T_A"] + cross(x["P_A"] - x["A"], x["F_A"]))
        return found

    def _work(self, x: Given, rates: Given) -> Any:
        """Of the loads, where nothing but this moves."""
        given = self._moving(x, rates, 1)
        found, work = self.position(given), x["A"].real * 0
        for end, (at, omega) in zip("AB", self.bodies, strict=True):
            P, v = (found if at == "C" else given)[at].of
            if omega in found:
                a, da = found[omega].of
                turning = (da / a).imag
            else:
                turning = rates.get(omega, x["A"].real * 0)
            v = v + _left(x[f"P_{end}"] - P) * turning
            work = work + dot(x[f"F_{end}"], v) + x[f"T_{end}"] * turning
        return work


@in_balls
def _in_balls(kind: Kind, numbers: Given) -> Numbers:
    return kind.exact(kind.joined(numbers, arb, acb))


def _left(z: Any) -> Any:
    """A vector turned by a right angle."""
    return point(-z.imag, z.real)


def _unit(u: Any) -> Any:
    return u / root(dot(u, u))


def _along(z: Any, u: Any) -> Any:
    """Component of a vector along a direction."""
    return (z / _unit(u)).real


def _rrr(x: Given) -> Numbers:
    C = arithmetic.rrr(x["A"], x["B"], x["r_A"], x["r_B"], 1)
    return {"C": C, "omega_A": C - x["A"], "omega_B": C - x["B"]}


def _rrp(x: Given) -> Numbers:
    C = arithmetic.rrp(x["A"], x["B"], x["u"], x["r_A"], 1, x["e"])
    return {"C": C, "omega_A": C - x["A"], "ds": _along(C - x["B"], x["u"])}


def _rpr(x: Given) -> Numbers:
    u, s = arithmetic.rpr(x["A"], x["B"], 1, x["e"])
    return {"u": u, "omega_A": u, "ds": s}


def _prp(x: Given) -> Numbers:
    C = arithmetic.lines(x["A"], x["B"], x["w"], x["u"])
    return {"C": C, "ds_A": _along(C - x["A"], x["w"]), "ds_B": _along(C - x["B"], x["u"])}


def _rpp(x: Given) -> Numbers:
    C = arithmetic.lines(x["A"], x["B"], x["w"], x["u"])
    return {"C": C, "ds_A": _along(x["A"] - C, x["w"]), "ds_B": _along(C - x["B"], x["u"])}


KINDS = {
    "RRR": Kind(
        ("A", "B", "r_A", "r_B"),
        ("v_A", "v_B", "dr_A", "dr_B"),
        ("a_A", "a_B", "ddr_A", "ddr_B"),
        lambda x: RRRGroup(x["A"], x["B"], x["r_A"], x["r_B"], 1),
        _rrr,
        ("omega_A", "omega_B"),
        (("A", "omega_A"), ("B", "omega_B")),
    ),
    "RRP": Kind(
        ("A", "B", "u", "r_A", "e"),
        ("v_A", "v_B", "omega_B", "dr_A"),
        ("a_A", "a_B", "epsilon_B", "ddr_A"),
        lambda x: RRPGroup(x["A"], x["B"], x["u"], x["r_A"], 1, x["e"]),
        _rrp,
        ("omega_A", "ds"),
        (("A", "omega_A"), ("C", "omega_B")),
        {"B": "u"},
    ),
    "RPR": Kind(
        ("A", "B", "e"),
        ("v_A", "v_B"),
        ("a_A", "a_B"),
        lambda x: RPRGroup(x["A"], x["B"], 1, x["e"]),
        _rpr,
        ("omega_A", "ds"),
        (("A", "omega_A"), ("B", "omega_A")),
        place="u",
    ),
    "PRP": Kind(
        ("A", "B", "w", "u"),
        ("v_A", "v_B", "omega_A", "omega_B"),
        ("a_A", "a_B", "epsilon_A", "epsilon_B"),
        lambda x: PRPGroup(x["A"], x["B"], x["w"], x["u"]),
        _prp,
        ("ds_A", "ds_B"),
        (("C", "omega_A"), ("C", "omega_B")),
        {"A": "w", "B": "u"},
    ),
    "RPP": Kind(
        ("A", "B", "w", "u"),
        ("v_A", "v_B", "omega_B"),
        ("a_A", "a_B", "epsilon_B"),
        lambda x: RPPGroup(x["A"], x["B"], x["w"], x["u"]),
        _rpp,
        ("ds_A", "ds_B"),
        (("A", "omega_B"), ("C", "omega_B")),
        {"B": "u"},
        {"u": "B", "w": "B"},
    ),
}
