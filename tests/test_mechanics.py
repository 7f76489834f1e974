"""What the public functions of the mechanics have in common: order of arguments, results, shapes, frozen groups."""

from __future__ import annotations

import inspect
import itertools
import re
from dataclasses import FrozenInstanceError
from graphlib import TopologicalSorter
from typing import Any, get_type_hints

import numpy as np
import pytest
from random_groups import numbers, triangles, vectors

import mechsheet
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.prp import PRPGroup, prp, prp_acceleration, prp_reactions, prp_velocity
from mechsheet.mechanics.rpp import RPPGroup, rpp, rpp_acceleration, rpp_reactions, rpp_velocity
from mechsheet.mechanics.rpr import RPRGroup, rpr, rpr_acceleration, rpr_reactions, rpr_velocity
from mechsheet.mechanics.rrp import RRPGroup, rrp, rrp_acceleration, rrp_reactions, rrp_velocity
from mechsheet.mechanics.rrr import RRRGroup, rrr, rrr_acceleration, rrr_reactions, rrr_velocity

HOMES = {n: home for n, home in mechsheet._HOMES.items() if home.startswith("mechsheet.mechanics.")}
FUNCTIONS = {n: getattr(mechsheet, n) for n in HOMES if inspect.isfunction(getattr(mechsheet, n))}
GROUPS = {n: getattr(mechsheet, n) for n in HOMES if n.endswith("Group")}
every = pytest.mark.parametrize


# --- one order of arguments ------------------------------------------------------------------------------------

ORDER = [
    ("points", r"[ABCPS]|O1"),
    ("directions, vectors in the plane", r"u(_[AB])?|[abczpq]"),
    ("lengths and other given numbers", r"r(_[AB])?|m|J|phi|alpha_w|offset|branch"),
    ("first derivatives", r"v_[AB]|omega(_[AB])?|d[rs](_[AB])?|velocity"),
    ("second derivatives", r"a_[ABS]|epsilon(_[AB])?|dd[rs](_[AB])?"),
    ("reactions and loads", r"R_C|loads(_[AB])?|reactions"),
]
OF_JOINTS = [("radius", r"r"), ("elements", r"x|y|A|A_t|A_c|phi"), ("loads", r"M|N")]
RECORDS = {n: getattr(mechsheet, n) for n in HOMES if inspect.isclass(getattr(mechsheet, n)) and n not in GROUPS}


def rank(name: str, order: list[tuple[str, str]]) -> int:
    return next(i for i, (_, names) in enumerate(order) if re.fullmatch(names, name))


def arguments(f: Any) -> dict[str, inspect.Parameter]:
    return {n: p for n, p in inspect.signature(f).parameters.items() if n != "self"}


METHODS = {
    f"{group}.{name}": method
    for group, kind in GROUPS.items()
    for name, method in [("__init__", kind), *inspect.getmembers(kind, inspect.isfunction)]
    if not name.startswith("_") or name == "__init__"
}


@every("name", [*FUNCTIONS, *METHODS])
def test_arguments_stand_in_one_order(name: str) -> None:
    names = list(arguments({**FUNCTIONS, **METHODS}[name]))
    order = OF_JOINTS if HOMES.get(name) == "mechsheet.mechanics.joint" else ORDER
    assert [rank(n, order) for n in names] == sorted(rank(n, order) for n in names)
    for stem in {re.sub("_?[ABC]$", "", n) for n in names}:
        ends = [n for n in names if re.fullmatch(f"{stem}_?[ABC]", n)]
        assert ends == sorted(ends)


def test_arguments_that_several_take_stand_in_one_order() -> None:
    """One order of all names can be told, in which every function, method and record takes its own."""
    before: dict[str, set[str]] = {}
    for f in {**FUNCTIONS, **METHODS, **RECORDS}.values():
        names = list(arguments(f))
        for first, second in itertools.pairwise(names):
            before.setdefault(second, set()).add(first)
    TopologicalSorter(before).prepare()  # raises CycleError with the names that stand in two orders


@every("name", [*FUNCTIONS, *METHODS])
def test_derivatives_are_zero_where_they_are_not_given(name: str) -> None:
    """Those that a velocity function returned are not zero by nature."""
    function = {**FUNCTIONS, **METHODS}[name]
    velocity = FUNCTIONS.get(name.replace("_acceleration", "_velocity")) if "_acceleration" in name else None
    found = get_type_hints(get_type_hints(velocity)["return"]) if velocity and not name.startswith("link") else {}
    for argument, parameter in arguments(function).items():
        if HOMES.get(name) == "mechsheet.mechanics.joint" or argument in found or argument == "velocity":
            continue
        if rank(argument, ORDER) in (3, 4):
            turns = name.startswith("link_") and argument == "omega"  # a link that does not turn needs no function
            assert parameter.default is inspect.Parameter.empty if turns else parameter.default == 0


@every("name", FUNCTIONS)
def test_several_results_are_one_record(name: str) -> None:
    result = get_type_hints(FUNCTIONS[name])["return"]
    assert getattr(result, "__origin__", result) is not tuple
    if isinstance(result, type) and issubclass(result, tuple):
        assert len(result._fields) > 1


def test_one_name_means_one_quantity_in_all_records() -> None:
    """No record calls omega what another calls omega_A."""
    stems: dict[str, set[str]] = {}
    for name, f in FUNCTIONS.items():
        if re.match("(rrr|rrp|rpr|prp|rpp)_(velocity|acceleration|reactions)$", name):
            for field in get_type_hints(f)["return"]._fields:
                stems.setdefault(field.partition("_")[0], set()).add(field)
    assert {stem: names for stem, names in stems.items() if stem in names} == {"ds": {"ds", "ds_A", "ds_B"}, **DDS}


DDS = {"dds": {"dds", "dds_A", "dds_B"}}  # one slide along u, or one along each of u_A and u_B


# --- shapes ------------------------------------------------------------------------------------------------------

VALUES: dict[str, Any] = dict(A=0j, B=3 + 0.5j, C=1 + 2j, P=2j, S=1j, O1=0.1j, u=1 + 1j, u_A=1j, u_B=1 + 0.2j)
VALUES |= dict(a=2.0, b=2.5, c=3.0, p=1.0, q=2.0, z=1 + 1j, r=1.0, r_A=2.0, r_B=2.5, m=1.0, J=0.1, phi=0.3, alpha_w=0.3)
VALUES |= dict(offset=0.1, branch=1, R_C=1 + 1j, x=1.0, y=1.0, A_t=1.0, A_c=1.0, M=1.0, N=1.0)


def value(name: str) -> Any:
    if name.startswith("loads"):
        return [Load(1 + 1j, 2)]
    return VALUES.get(name, 0.5)  # a derivative


def shaped(name: str, count: int, area: bool) -> Any:
    if name.startswith("loads"):
        return [Load(1, 2), Load(np.ones(count), 2)]
    return np.full(count, 1.0 if area and name == "A" else value(name))


def pairs(name: str) -> list[tuple[str, str]]:
    names = list(arguments(FUNCTIONS[name]))
    if HOMES[name] == "mechsheet.mechanics.equilibrium":  # of many bodies: in its own test
        return []
    if HOMES[name] != "mechsheet.mechanics.joint":
        return list(itertools.combinations(names, 2))
    return [(x, y) for x, y in itertools.combinations(names, 2) if (x in "MNr") == (y in "MNr")]  # elements or not


@every("name", [name for name in FUNCTIONS if pairs(name)])
def test_shapes_that_do_not_broadcast_are_refused_by_name(name: str) -> None:
    of_joint = HOMES[name] == "mechsheet.mechanics.joint"
    for x, y in pairs(name):
        given = {n: np.ones(2) if of_joint and n not in "MNr" else value(n) for n in arguments(FUNCTIONS[name])}
        given |= {x: shaped(x, 2, of_joint), y: shaped(y, 3, of_joint)}
        with pytest.raises(ValueError, match="shapes do not broadcast") as refused:
            FUNCTIONS[name](**given)
        for argument, shape in ((x, r"\(2,\)"), (y, r"\(3,\)")):
            named = rf"{argument}\[1\]\.F" if argument.startswith("loads") else argument
            assert re.search(rf"\b{named} {shape}", str(refused.value)), (x, y)


# --- frozen groups -----------------------------------------------------------------------------------------------


def same(found: Any, plain: Any) -> None:
    """Equal to the last bit; a motion has what was given behind what was found."""
    found, plain = (x if isinstance(x, tuple) else (x,) for x in (found, plain))
    for x, y in zip(found, plain, strict=False):
        assert np.array_equal(x, y, equal_nan=True)


@pytest.fixture
def moving() -> dict[str, Any]:
    rng, A, B, C = triangles("ordinary")
    names = ("v_A", "v_B", "a_A", "a_B"), ("omega_A", "omega_B", "dr_A", "dr_B"), ("epsilon_A", "epsilon_B")
    g = dict(A=A, B=B, r_A=np.abs(C - A), r_B=np.abs(C - B), u_A=C - A, u_B=C - B)
    g |= dict(zip(names[0], vectors(rng, 4), strict=True)) | dict(zip(names[1], numbers(rng, 4), strict=True))
    g |= dict(zip(names[2], numbers(rng, 2), strict=True)) | dict(zip(("ddr_A", "ddr_B"), numbers(rng, 2), strict=True))
    F, P = vectors(rng, 2), vectors(rng, 2)
    return g | dict(loads_A=[Load(F[0], P[0], 0.3)], loads_B=[Load(F[1], P[1]), Load(-1j, 0.2)])


def known(f: Any, g: dict[str, Any]) -> dict[str, Any]:
    return {name: g[name] for name in arguments(f) if name in g}


def common(group: Any, kind: str, given: dict[str, Any]) -> None:
    """What a group says of itself, and its derivatives and reactions, against the plain functions."""
    for name in ("reach", "determinant", "transmission_angle", "condition"):
        if hasattr(type(group), name):
            plain = FUNCTIONS[f"{kind}_{name}"]
            same(getattr(group, name), plain(**{n: getattr(group, n) for n in arguments(plain)}))
    velocity = group.velocity(**known(group.velocity, given))
    position = {n: getattr(group, n) for n in "ABCu" if hasattr(group, n)}
    position |= {n: getattr(group, n) for n in ("u_A", "u_B") if hasattr(group, n)}
    plain = FUNCTIONS[f"{kind}_velocity"]
    same(velocity, plain(**known(plain, given | position)))
    plain = FUNCTIONS[f"{kind}_acceleration"]
    rates = given | position | velocity._asdict()
    same(group.acceleration(velocity, **known(group.acceleration, given)), plain(**known(plain, rates)))
    plain = FUNCTIONS[f"{kind}_reactions"]
    same(group.reactions(given["loads_A"], given["loads_B"]), plain(**known(plain, given | position)))


def test_a_group_rrr_gives_what_the_plain_functions_give(moving: Any) -> None:
    g = moving
    group = RRRGroup(g["A"], g["B"], g["r_A"], g["r_B"], -1)
    same(group.C, rrr(g["A"], g["B"], g["r_A"], g["r_B"], -1))
    same((group.AC, group.BC), (group.C - group.A, group.C - group.B))
    common(group, "rrr", g)
    v = rrr_velocity(g["A"], g["B"], group.C, g["v_A"], 0, g["dr_A"])
    a = rrr_acceleration(g["A"], g["B"], group.C, v.omega_A, v.omega_B, g["dr_A"], 0, g["a_A"])
    same(group.acceleration(group.velocity(g["v_A"], dr_A=g["dr_A"]), g["a_A"]), a)
    same(group.reactions(g["loads_A"]), rrr_reactions(g["A"], g["B"], group.C, g["loads_A"]))


def test_a_group_rrp_gives_what_the_plain_functions_give(moving: Any) -> None:
    g = moving
    group = RRPGroup(g["A"], g["B"], g["u_B"], 9.0, +1, 0.1)
    same(group.C, rrp(g["A"], g["B"], g["u_B"], 9.0, +1, 0.1))
    assert np.isfinite(group.C).sum() > 50
    same((group.AC, group.BC), (group.C - group.A, group.C - group.B))
    common(group, "rrp", g)
    v = rrp_velocity(g["A"], g["B"], group.C, group.u, g["v_A"], omega_B=g["omega_B"])
    a = rrp_acceleration(g["A"], g["B"], group.C, group.u, v.omega_A, v.ds, g["omega_B"], a_A=g["a_A"])
    same(group.acceleration(group.velocity(g["v_A"], omega_B=g["omega_B"]), g["a_A"]), a)
    same(group.reactions((), g["loads_B"]), rrp_reactions(g["A"], group.C, group.u, (), g["loads_B"]))


def test_a_group_rpr_gives_what_the_plain_functions_give(moving: Any) -> None:
    g = moving
    group = RPRGroup(g["A"], g["B"], -1, 0.05)
    same((group.u, group.s), rpr(g["A"], g["B"], -1, 0.05))
    same(group.BA, group.A - group.B)
    common(group, "rpr", g)
    v = rpr_velocity(g["A"], g["B"], group.u, g["v_A"])
    a = rpr_acceleration(g["A"], g["B"], group.u, v.omega_A, v.ds, g["a_A"])
    same(group.acceleration(group.velocity(g["v_A"]), g["a_A"]), a)
    same(group.reactions(g["loads_A"]), rpr_reactions(g["A"], g["B"], group.u, g["loads_A"]))


@every(
    ("kind", "functions"),
    [
        (PRPGroup, (prp, prp_velocity, prp_acceleration, prp_reactions)),
        (RPPGroup, (rpp, rpp_velocity, rpp_acceleration, rpp_reactions)),
    ],
)
def test_a_group_of_two_slides_gives_what_the_plain_functions_give(kind: Any, functions: Any, moving: Any) -> None:
    g, (position, velocity, acceleration, reactions) = moving, functions
    group = kind(g["A"], g["B"], g["u_A"], g["u_B"])
    same(group.C, position(g["A"], g["B"], g["u_A"], g["u_B"]))
    same((group.AC, group.BC), (group.C - group.A, group.C - group.B))
    common(group, position.__name__, g)
    here = g["A"], g["B"], group.C, g["u_A"], g["u_B"]
    v = velocity(*here, g["v_A"], omega_B=g["omega_B"])
    a = acceleration(*here, v.ds_A, v.ds_B, omega_B=g["omega_B"], a_A=g["a_A"])
    same(group.acceleration(group.velocity(g["v_A"], omega_B=g["omega_B"]), g["a_A"]), a)
    where = {n: x for n, x in zip(("A", "B", "C", "u_A", "u_B"), here, strict=True) if n in arguments(reactions)}
    same(group.reactions(g["loads_A"]), reactions(**where, loads_A=g["loads_A"]))


@every("group", [RRRGroup(0, 3, 2, 2, 1), RRPGroup(0, 1j, 1, 2, 1), RPRGroup(1, 0, 1), PRPGroup(0, 1, 1, 1j)])
def test_a_group_is_frozen(group: Any) -> None:
    for name in ("A", "C", "u"):
        with pytest.raises(FrozenInstanceError):
            setattr(group, name, 0)


def test_a_group_refuses_what_its_functions_refuse() -> None:
    with pytest.raises(ValueError, match=r"length r_A = -1 m must not be negative"):
        RRRGroup(0, 3, -1, 2, 1)
    with pytest.raises(ValueError, match=r"shapes do not broadcast: A \(2,\), B \(3,\)"):
        RPRGroup([1, 2], [1, 2, 3], 1)
    with pytest.raises(ValueError, match="dr_A = inf must be finite"):
        RRRGroup(0, 3, 2, 2, 1).velocity(dr_A=np.inf)


# --- dead centres -----------------------------------------------------------------------------------


@every("turned", [0.3, 1.0, 2.5])
def test_a_dead_centre_is_nan_where_only_rounding_hides_it(turned: float) -> None:
    """Lines that are parallel, or links in line, at angles where the determinant's products do not cancel exactly."""
    u = np.exp(1j * turned)
    for D in (
        mechsheet.prp_determinant(u, -3 * u),
        mechsheet.rpp_determinant([u, 1j * u], [7 * u, 1 / 3 * u])[0],
        mechsheet.rrp_determinant(0.1 * u, 1.3 * u, 1j * u),
        mechsheet.rpr_determinant(1e6 + u, 1e6, 1j * u / 3),
        mechsheet.rrr_determinant(0.1 * u, -0.7 * u, 1.3 * u),
    ):
        assert np.isnan(D)


@every("determinant", [mechsheet.rrr_determinant, mechsheet.rrp_determinant])
def test_a_dead_centre_in_a_field_is_the_same_alone_as_among_others(determinant: Any) -> None:
    phi = np.concatenate([np.linspace(0.1, 3, 50), 0.3 + 10.0 ** -np.arange(5, 18), [np.nan]])
    third = np.exp(1j * phi) if determinant is mechsheet.rrr_determinant else 1j * np.exp(1j * phi)
    second = 2 * np.exp(0.3j)
    found = determinant(0, second, third)
    assert 1 < np.isnan(found).sum() < 10
    alone = [determinant(0, second, x) for x in third]
    assert np.array_equal(found, alone, equal_nan=True)
