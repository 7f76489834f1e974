"""Every function of the mechanics keeps the digits that its inputs have, against 60-digit vector equations.

An input is known to one rounding; what that leaves open of a result is its effect, taken from the exact equations by
changing each input a little. No error may be larger than 64 times the effect of all inputs together.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest
import vector_equations
from flint import acb, arb, ctx
from hypothesis import settings

import mechsheet
from mechsheet import (
    Load,
    PinReaction,
    PRPGroup,
    RPPGroup,
    RPRGroup,
    RRPGroup,
    RRRGroup,
    SlideReaction,
    angle_between,
    crank,
    cross,
    dot,
    link_acceleration,
    link_point,
    link_velocity,
    rpr_reach,
    rrp_reach,
    rrr_reach,
)

HOMES = {n: home for n, home in mechsheet._HOMES.items() if home.startswith("mechsheet.mechanics.")}
FUNCTIONS = {n: getattr(mechsheet, n) for n in HOMES if inspect.isfunction(getattr(mechsheet, n))}
EXEMPT = {
    "left_over": "sums of what is given: zero in equilibrium, and its tests hold it against levers by hand",
    "magnitudes": "hands on what is given",
    "neutral_axis": "held against exact fractions in test_joint",
    "circular_joint": "held against 50-digit integrals in test_joint",
}


def solve_reactions(A: Any, C: Any, u: Any, loads_A: Any, loads_B: Any) -> dict[str, Any]:
    """Of a link with a slider, whose loads may be none."""
    pairs = [PinReaction(1, 0, 0, A), PinReaction(1, 2, 0, C), SlideReaction(2, 0, 0, C, u / np.abs(u))]
    found = mechsheet.solve_reactions([loads_A, loads_B], pairs).T
    return {"R_A": found[0] + 1j * found[1], "R_C": found[2] + 1j * found[3], "N": found[4], "M_B": found[5]}


def chain(
    O1: Any,
    r: Any,
    phi: Any,
    omega: Any,
    B: Any,
    r_A: Any,
    r_B: Any,
    branch: Any,
    z: Any,
    G: Any,
    u: Any,
    r_D: Any,
    branch_D: Any,
) -> dict[str, Any]:
    """Crank, dyad A-C-B, and a link D-E with a slider on a guide through G, D on the link CB."""
    rod = crank(0, r, phi)
    first = RRRGroup(O1 + rod, B, r_A, r_B, branch)
    v = first.velocity(link_velocity(rod, 0, omega))
    a = first.acceleration(v, link_acceleration(rod, 0, omega))
    D = link_point(B, first.C, z)
    second = RRPGroup(D, G, u, r_D, branch_D)
    w = second.velocity(link_velocity(D, B, v.omega_B))
    b = second.acceleration(w, link_acceleration(D, B, v.omega_B, a.epsilon_B))
    known = dict(C=first.C, omega_B=v.omega_B, epsilon_B=a.epsilon_B)
    return known | dict(E=second.C, ds=w.ds, dds=b.dds)


TRIED = {n: f for n, f in FUNCTIONS.items() if n not in EXEMPT} | {"solve_reactions": solve_reactions, "chain": chain}

ROUNDING = 2.0**-53
ALLOWED = 64 * ROUNDING
UNDECIDED = 32  # roundings of the inputs within which a dead centre or an end of reach may go either way
CHANGE = arb(1e-25)  # of an input, relative, for the effect of a rounding


class Family(NamedTuple):
    """How extreme the random inputs are."""

    size: float = 1.0  # of all lengths
    decades: float = 0.5  # lengths of links spread over twice as many
    away: float = 0.0  # distance from the origin, in lengths
    angle: str = "any"  # between the links, or of the group's two directions
    like: bool = False  # two links of nearly the same length


FAMILIES = {
    "ordinary": Family(),
    "links over twelve decades": Family(decades=6),
    "1e6 lengths from the origin": Family(away=1e6),
    "near a dead centre": Family(angle="near"),
    "long links side by side": Family(angle="folded", like=True),
    "all at once": Family(decades=6, away=1e3, angle="near"),
    "1e-150 of the length": Family(size=1e-150),
    "1e150 of the length": Family(size=1e150),
}
COUNT = 8 * settings.default.max_examples // 100  # of each family, and ten times as many in a search


class Draw:
    """Random inputs of one family, by the names that the functions give them."""

    def __init__(self, name: str, f: Family) -> None:
        self.rng = rng = np.random.default_rng([*map(ord, f"{name}{f._replace(size=1)}")])
        self.f, k, n = f, f.size, COUNT
        r_A, r_B = k * 10 ** rng.uniform(-f.decades, f.decades, (2, n))
        side, mu = rng.choice([-1, 1], n), rng.uniform(0.05, 3.09, n)
        if f.angle != "any" and (name.startswith("rrr") or not f.like):
            mu = 10 ** rng.uniform(-9, -1, n)
            mu = np.where(rng.random(n) < 0.5, mu, np.pi - mu) if f.angle == "near" else mu
        if f.like:
            r_A = r_A * 10 ** rng.uniform(0, 8, n)
            r_B = r_A * (1 + 10 ** rng.uniform(-9, -1, n))
        e = np.exp(1j * rng.uniform(-3.1, 3.1, n))
        A, B, C = r_A * e, r_B * e * np.exp(1j * side * mu), np.zeros(n)
        least = np.min(np.abs([A, B, A - B]), axis=0)
        beside = np.zeros(n, int) if f.like else rng.integers(0, 3, n)
        origin = np.choose(beside, [A, B, C])
        origin = origin + (k if f.like else least) * self.vectors(1)
        away = k * f.away * np.exp(1j * rng.uniform(-3.1, 3.1, n)) - origin
        A, B, C = A + away, B + away, C + away
        a, d = C - A, A - B
        u = (
            (a if name.startswith(("rrp", "solve")) else d) * 1j * np.exp(-1j * side * mu)
        )  # mu from square to a, or to d
        u = u / np.abs(u) * 10 ** rng.uniform(-2, 2, n)
        along = u / np.abs(u)
        offset = k * self.numbers() * 10.0 ** -rng.integers(0, 9, n)
        if name in ("rrp", "rrp_velocity", "rrp_acceleration", "rrp_condition"):
            guided = C - k * 10 ** rng.uniform(-f.decades, f.decades, n) * side * along
            B = np.where(rng.random(n) < (0 if f.like else 0.5), guided, A + (k if f.like else least) * self.vectors(1))
            offset = (np.conj(along) * (C - B)).imag
        if name == "rpr":
            offset = (np.conj(along) * d).imag
        self.given = dict(A=A, B=B, C=C, P=C, S=C, O1=A, u=u, u_A=u, u_B=side * e * np.exp(1j * mu), offset=offset)
        self.given["u_A"] = e * 10 ** rng.uniform(-2, 2, n)
        self.given |= dict(r_A=np.abs(C - A), r_B=np.abs(C - B), branch=np.asarray(side), r=r_A)
        self.given |= dict(phi=rng.uniform(-10, 10, n), alpha_w=rng.uniform(0, 1.4, n), m=10 ** rng.uniform(-3, 3, n))
        self.given |= dict(J=10 ** rng.uniform(-3, 3, n), a=A - C, b=B - C, p=self.numbers(), q=self.numbers())
        self.given |= dict(z=k * self.vectors(3), R_C=self.vectors())

    def vectors(self, decades: float = 3) -> Any:
        z = self.rng.normal(size=COUNT) + 1j * self.rng.normal(size=COUNT)
        return z * 10 ** self.rng.uniform(-decades, decades, COUNT)

    def numbers(self) -> Any:
        """Some of them zero."""
        x = self.rng.normal(size=COUNT) * 10 ** self.rng.uniform(-3, 3, COUNT)
        return np.where(self.rng.random(COUNT) < 0.1, 0, x)

    def loads(self) -> list[Load]:
        k, near = self.f.size, (self.given["A"], self.given["C"])
        points = [near[i] + k * self.vectors(6) * (self.rng.random(COUNT) < 0.7) for i in (0, 1)]
        return [Load(self.vectors(), points[0], k * self.numbers()), Load(self.vectors(), points[1])]

    def value(self, argument: str) -> Any:
        if argument in self.given:
            return self.given[argument]
        if argument.startswith("loads"):
            return self.loads()
        if argument[0] in "va" and argument[1] == "_":
            return self.f.size * self.vectors()
        if argument.startswith("d"):
            return self.f.size * self.numbers()
        return self.numbers()  # omega, epsilon

    def triangle(self) -> dict[str, Any]:
        d = self.given
        return dict(a=np.abs(d["A"] - d["B"]), b=d["r_A"], c=d["r_B"])

    def reach(self) -> dict[str, Any]:
        """Lengths of a crank and of the links behind it that leave a part of the turn, or all of it, or nothing."""
        k, (r, r_A, r_B) = self.f.size, 10 ** self.rng.uniform(-self.f.decades, self.f.decades, (3, COUNT))
        return dict(r=k * r, r_A=k * r_A, r_B=k * r_B)

    def chain(self) -> dict[str, Any]:
        """A crank on the pin A of the dyad, and a slider behind it that the link D-E reaches."""
        rng, k, d = self.rng, self.f.size, self.given
        r, r_D = k * 10 ** rng.uniform(-self.f.decades, self.f.decades, (2, COUNT))
        u, z = d["u"] / np.abs(d["u"]), d["r_B"] * self.vectors(0)
        D = d["B"] + z * (d["C"] - d["B"]) / d["r_B"]
        way = rng.choice([-1, 1], COUNT)
        to_E = r_D * u * np.exp(1j * rng.uniform(-1.4, 1.4, COUNT)) * way
        branch = np.sign(cross(d["B"] - d["A"], d["C"] - d["A"])).astype(int)
        own = dict(O1=d["A"] - crank(0, r, d["phi"]), r=r, omega=self.numbers(), z=z, r_D=r_D, branch=branch)
        return d | own | dict(G=D + to_E + k * self.numbers() * u, branch_D=way)

    def section(self) -> dict[str, Any]:
        k, shape = self.f.size, (COUNT, 5)
        y = k * (self.rng.normal(size=shape) + self.f.away)
        areas = 10 ** self.rng.uniform(-self.f.decades, self.f.decades, shape)
        return dict(y=y, A=areas, M=k * self.numbers(), N=self.numbers())


def inputs(name: str, family: Family) -> dict[str, Any]:
    draw = Draw(name, family)
    if name in ("angle_opposite", "triangle_area"):
        return draw.triangle()
    if name == "bending":
        return draw.section()
    if name == "sum_of_elements":
        return dict(x=draw.section()["y"])
    own = draw.chain() if name == "chain" else draw.reach() if name.endswith("crank_reach") else {}
    names = inspect.signature(TRIED[name]).parameters
    return {argument: own[argument] if argument in own else draw.value(argument) for argument in names}


def exact(x: Any, i: int) -> Any:
    """Element i of an input in exact numbers; loads as tuples of force, point and moment."""
    if isinstance(x, list):
        return [exact((load.F, load.P, load.M), i) for load in x]
    if isinstance(x, tuple):
        return tuple(exact(part, i) for part in x)
    one = np.broadcast_to(x, (COUNT, *np.shape(x)[1:]))[i]
    if one.ndim:
        return [arb(float(v)) for v in one]
    if one.dtype.kind == "i":
        return int(one)
    return acb(complex(one)) if one.dtype.kind == "c" else arb(float(one))


def changes(x: Any) -> Any:
    """The inputs with one of their numbers changed, by the relative `CHANGE`; a point along both axes."""
    if isinstance(x, dict):
        yield from (x | {name: new} for name, value in x.items() for new in changes(value))
    elif isinstance(x, list | tuple):
        yield from (type(x)([*x[:i], new, *x[i + 1 :]]) for i, value in enumerate(x) for new in changes(value))
    elif isinstance(x, acb):
        yield from (x + way * abs(x) * CHANGE for way in (1, vector_equations.i) if x != 0)
    elif x != 0 and not isinstance(x, int):
        yield x * (1 + CHANGE)


def parts(y: Any) -> dict[str, Any]:
    if isinstance(y, dict | Load):
        return y if isinstance(y, dict) else vars(y)
    return y._asdict() if isinstance(y, tuple) else {"": y}


def size(y: Any) -> Any:
    return max(map(abs, y)) if isinstance(y, list) else abs(y)


def difference(x: Any, y: Any) -> Any:
    return [p - q for p, q in zip(x, y, strict=True)] if isinstance(y, list) else x - y


def numbers_of(found: Any, i: int) -> Any:
    one = np.asarray(found)[i] if np.ndim(found) else np.asarray(found)
    return [arb(float(v)) for v in one] if one.ndim else acb(complex(one))


@ctx.workprec(vector_equations.BITS)
def lost(name: str, family: str) -> list[tuple[float, str]]:
    """For every result its error over what is allowed, infinite where a number is missing or should be."""
    given = inputs(name, FAMILIES[family])
    truth: Callable[..., Any] = getattr(vector_equations, name)
    found = parts(TRIED[name](**given))
    rows = []
    for i in range(COUNT):
        x = {argument: exact(value, i) for argument, value in given.items()}
        y = truth(**x)
        effect = dict.fromkeys(y, arb(0))
        for changed in changes(x):
            for result, value in truth(**changed).items():
                step = size(difference(value, y[result]))
                effect[result] += step / CHANGE if step.is_finite() else 0
        exists = y.pop("exists", arb(1))
        undecided = abs(exists) <= UNDECIDED * ROUNDING * effect.get("exists", 0)
        for result, value in y.items():
            if undecided and result != "axis":
                continue
            got = numbers_of(found[result], i)
            off, limit = size(difference(got, value)), ALLOWED * (effect[result] + size(value))
            there = size(got).is_finite()
            if ((exists > 0 or result == "axis") and size(value).is_finite()) != there:
                ratio = np.inf
            else:
                ratio = float(off / limit) if limit != 0 and there else 0.0 if not there or off == 0 else np.inf
            rows.append((ratio, f"{name}[{i}].{result} of {family}"))
    return rows


# --- the tests ----------------------------------------------------------------------------------------------------


def test_every_function_is_tried_or_exempt_with_a_reason() -> None:
    assert {n for n in TRIED if hasattr(vector_equations, n)} == set(TRIED)
    assert set(EXEMPT) < set(FUNCTIONS) and all(EXEMPT.values())


@pytest.mark.parametrize("name", TRIED)
def test_digits_are_lost_to_the_rounding_of_the_inputs_only(name: str) -> None:
    rows = [row for family in FAMILIES for row in lost(name, family)]
    assert len(rows) > 5 * COUNT, "too little is decided"
    assert [f"{what}: {ratio:.3g} times what is allowed" for ratio, what in rows if not ratio <= 1] == []


def at_C(A: Any, B: Any, C: Any, u: Any, v_A: Any, v_B: Any, omega_B: Any, dr_A: Any) -> dict[str, Any]:
    """The velocities of `rrp_velocity` by the motion of the guide at C, however far that is."""
    a, u = C - A, u / np.abs(u)
    guide = v_B + 1j * omega_B * (C - B)
    w = guide - v_A - dr_A * a / np.abs(a)
    ds = -dot(w, a) / dot(a, u)
    return {"v_C": guide + ds * u, "omega_A": cross(u, w) / dot(a, u), "ds": ds}


@np.errstate(all="ignore")
def heron(a: Any, b: Any, c: Any) -> Any:
    """An area under one root, where the product of four lengths leaves the range of floats."""
    return np.sqrt((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)) / 4


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("rrr_transmission_angle", lambda A, B, C: angle_between(C - A, C - B)),  # links far longer than their base
        ("rrr_determinant", lambda A, B, C: cross(C - A, C - B)),
        ("rrp_velocity", at_C),
        ("triangle_area", heron),
    ],
)
def test_a_fault_is_noticed(name: str, fault: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(TRIED, name, fault)
    assert any(not ratio <= 1 for family in FAMILIES for ratio, _ in lost(name, family))


# Where nothing moves: at both ends of the reach, in parallel lines, however the numbers are rounded


def stuck(rng: np.random.Generator, size: float, away: float, decades: float) -> dict[str, Any]:
    """Groups of each kind in a dead centre."""
    n = 200

    def vectors() -> Any:
        return rng.normal(size=n) + 1j * rng.normal(size=n)

    A = size * (away * vectors() + vectors())
    B, r = (
        A + size * vectors() * 10 ** rng.uniform(-decades, decades, n),
        size * 10 ** rng.uniform(-decades, decades, n),
    )
    u, offset = vectors() * 10 ** rng.uniform(-3, 3, n), size * rng.normal(size=n)
    theta = rng.uniform(-7, 7, n)
    parallel = [(u, u), (u, -3.7 * u), (u, u / 3), (np.exp(1j * theta), np.exp(1j * (theta + np.pi)))]
    reach = rrr_reach(A, B, r)
    groups = [RRRGroup(A, B, r, end, way) for end in reach for way in (1, -1)]
    groups += [RRRGroup(B, A, end, r, way) for end in reach for way in (1, -1)]
    groups += [RRPGroup(A, B, u, rrp_reach(A, B, u, offset).least, way, offset) for way in (1, -1)]
    groups += [RPRGroup(A, B, way, end) for end in rpr_reach(A, B) for way in (1, -1)]
    return groups + [kind(A, B, *lines) for lines in parallel for kind in (PRPGroup, RPPGroup)]


@pytest.mark.parametrize("size", [1e-150, 1e-77, 1.0, 1e78, 1e140])
@pytest.mark.parametrize(("away", "decades"), [(0, 0.5), (0, 6), (1e3, 3), (1e6, 0.5), (1e6, 3)])
def test_a_dead_centre_has_no_velocity_no_acceleration_and_no_reaction(
    size: float, away: float, decades: float
) -> None:
    rng = np.random.default_rng(3)
    for group in stuck(rng, size, away, decades):
        closes = isinstance(group, RRRGroup | RRPGroup | RPRGroup)
        position = group.u if isinstance(group, RPRGroup) else group.C
        assert np.all(np.isfinite(position) == closes)
        assert np.isnan(group.determinant).all()
        assert not closes or np.isposinf(group.condition).all()
        velocity, load = group.velocity(size * 1j), Load(1 + 2j, group.A, size)
        moving = type(velocity)(*(np.ones(200) if np.ndim(x) else x for x in velocity))
        for found in (velocity, group.acceleration(moving, size * 1j), group.reactions([load])):
            for name in found._fields:
                own = np.ndim(getattr(found, name)) and not name.startswith("M_")  # moments are those of the loads
                assert not own or np.isnan(getattr(found, name)).all(), name


# Sizes: a power of two rounds nothing


@pytest.mark.parametrize("name", TRIED)
@pytest.mark.parametrize("power", [-400, 400])
def test_another_unit_of_length_changes_no_bit(name: str, power: int) -> None:
    unit = 2.0**power
    for family in (FAMILIES["ordinary"], FAMILIES["near a dead centre"]):
        here, there = (parts(TRIED[name](**inputs(name, family._replace(size=size)))) for size in (1.0, unit))
        for result, value in here.items():
            if np.asarray(value).dtype.kind in "fc":
                assert any(np.array_equal(value * unit**k, there[result], equal_nan=True) for k in (0, 1, 2)), result


PLACES = [n for n in TRIED if n.endswith(("_reach", "angle", "angle_between", "angle_opposite"))]
PLACES += ["crank", "rrr", "prp", "rpp", "link_point"]


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("power", [-900, 900])
def test_places_and_angles_are_right_in_any_unit_of_length(name: str, power: int) -> None:
    """Squares of such lengths leave the range of floats: angles were 0 or a quarter turn."""
    unit = 2.0**power
    for family in (FAMILIES["ordinary"], FAMILIES["near a dead centre"]):
        here, there = (parts(TRIED[name](**inputs(name, family._replace(size=size)))) for size in (1.0, unit))
        for result, value in here.items():
            assert any(np.array_equal(value * unit**k, there[result], equal_nan=True) for k in (0, 1)), result
