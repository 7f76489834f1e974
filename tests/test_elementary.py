"""Functions of the mechanics are recorded by running themselves; their elementary steps give what they give."""

from __future__ import annotations

import inspect
import pkgutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest

import mechsheet
from mechsheet import mechanics
from mechsheet.mechanics import crank, drive, equilibrium, joint, load, planar, prp, rpp, rpr, rrp, rrr
from mechsheet.mechanics.load import Load
from mechsheet.quantities import elementary_joint
from mechsheet.quantities.elementary import in_steps
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers.jumps import jumps
from mechsheet.readers.numbers import numbers as read
from mechsheet.readers.slopes import slopes
from mechsheet.recording.substitutes import body, current, instead

HOMES = [import_module(f"mechsheet.mechanics.{each.name}") for each in pkgutil.iter_modules(mechanics.__path__)]
OWN = [each for home in HOMES for each in vars(home).values() if getattr(each, "__module__", "") == home.__name__]
STEPS = {f: form for f in OWN if inspect.isfunction(f) and (form := in_steps(f))}
COUNT = 40  # random cases
rng = np.random.default_rng(7)


def points() -> Any:
    return rng.uniform(-2, 2, COUNT) + 1j * rng.uniform(-2, 2, COUNT)


def numbers(low: float = 0.3, high: float = 3.0) -> Any:
    return rng.uniform(low, high, COUNT)


def signs() -> Any:
    return rng.choice([-1, 1], COUNT)


def loads() -> list[Load]:
    return [Load(points(), points(), numbers(-1, 1)), Load(points(), points())]


def pins() -> Any:
    """Outer pins 2 to 4 apart, and two lengths that reach each other."""
    A = points()
    return A, A + numbers(2, 4) * np.exp(1j * numbers(-3, 3)), numbers(3, 4), numbers(3, 4)


C = points()
ARGUMENTS: dict[Callable[..., Any], tuple[Any, ...]] = {
    planar.cross: (points(), points()),
    planar.dot: (points(), points()),
    planar.angle: (points(),),
    planar.angle_between: (points(), points()),
    planar.angle_opposite: (numbers(1, 1.9), numbers(1, 1.9), numbers(1, 1.9)),
    planar.link_velocity: (points(), points(), numbers(), points()),
    planar.link_acceleration: (points(), points(), numbers(), numbers(), points()),
    rrr.rrr: (*pins(), signs()),
    rrr.rrr_reach: (points(), points(), numbers()),
    rrr.rrr_velocity: (points(), points(), C, points(), points(), numbers(), numbers()),
    rrr.rrr_acceleration: (
        *(points(), points(), C, numbers(), numbers(), numbers(), numbers()),
        *(points(), points(), numbers(), numbers()),
    ),
    rrr.rrr_transmission_angle: (points(), points(), points()),
    rrr.rrr_condition: (points(), points(), points()),
    rrp.rrp: (points(), points(), points(), numbers(6, 9), signs(), numbers()),
    rrp.rrp_reach: (points(), points(), points(), numbers()),
    rrp.rrp_velocity: (points(), points(), C, points(), points(), points(), numbers(), numbers()),
    rrp.rrp_acceleration: (
        *(points(), points(), C, points(), numbers(), numbers(), numbers(), numbers()),
        *(points(), points(), numbers(), numbers()),
    ),
    rrp.rrp_transmission_angle: (points(), points(), points()),
    rrp.rrp_condition: (points(), points(), points(), points()),
    rpr.rpr: (points() + 5, points(), signs(), numbers(0.1, 0.5)),
    rpr.rpr_velocity: (points(), points(), points(), points(), points()),
    rpr.rpr_acceleration: (points(), points(), points(), numbers(), numbers(), points(), points()),
    rpr.rpr_transmission_angle: (points(), points(), points()),
    rpr.rpr_condition: (points(), points(), points()),
    planar.link_point: (points(), points(), points()),
    planar.product: (numbers(), numbers(), points()),
    crank.crank: (points(), numbers(), numbers()),
    rrr.rrr_determinant: (points(), points(), points()),
    rrp.rrp_determinant: (points(), points(), points()),
    rpr.rpr_determinant: (points(), points(), points()),
    rpr.rpr_reach: (points(), points()),
    prp.prp: (points(), points(), points(), points()),
    prp.prp_reach: (points(), points(), points(), points()),
    prp.prp_velocity: (points(), points(), C, points(), points(), points(), points(), numbers(), numbers()),
    prp.prp_acceleration: (
        *(points(), points(), C, points(), points(), numbers(), numbers(), numbers(), numbers()),
        *(points(), points(), numbers(), numbers()),
    ),
    prp.prp_determinant: (points(), points()),
    prp.prp_transmission_angle: (points(), points()),
    prp.prp_condition: (points(), points()),
    prp.prp_reactions: (points(), points(), points(), loads(), loads()),
    rpp.rpp: (points(), points(), points(), points()),
    rpp.rpp_reach: (points(), points(), points(), points()),
    rpp.rpp_velocity: (points(), points(), C, points(), points(), points(), points(), numbers()),
    rpp.rpp_acceleration: (
        *(points(), points(), C, points(), points(), numbers(), numbers(), numbers()),
        *(points(), points(), numbers()),
    ),
    rpp.rpp_determinant: (points(), points()),
    rpp.rpp_transmission_angle: (points(), points()),
    rpp.rpp_condition: (points(), points()),
    rpp.rpp_reactions: (points(), points(), points(), points(), loads(), loads()),
    load.inertia: (points(), numbers(), numbers(), points(), numbers()),
    load.lever: (numbers(), numbers()),
    rrr.rrr_reactions: (points(), points(), points(), loads(), loads()),
    rrp.rrp_reactions: (points(), points(), points(), loads(), loads()),
    rpr.rpr_reactions: (points(), points(), points(), loads(), loads()),
    drive.coupling_drive: (points(), loads()),
    drive.gear_drive: (points(), points(), numbers(0, 1), loads()),
    drive.cylinder_drive: (points(), points(), points(), loads()),
    joint.sum_of_elements: (rng.uniform(-1, 1, (COUNT, 6)),),
    joint.bending: (rng.uniform(-1, 1, (COUNT, 6)), rng.uniform(0.1, 1, (COUNT, 6)), numbers(-1, 1), numbers(-1, 1)),
    joint.neutral_axis: (
        *(rng.uniform(-1, 1, (COUNT, 6)), rng.uniform(0.1, 1, (COUNT, 6)), rng.uniform(0.1, 1, (COUNT, 6))),
        *(numbers(-1, 1), numbers(-1, 1)),
    ),
    joint.circular_joint: (
        *(numbers(), np.arange(12) * np.pi / 6 + rng.uniform(0, 1, (COUNT, 1))),
        *(numbers(-1, 1), numbers(-1, 1)),
    ),
}


BODIES: dict[Callable[..., Any], tuple[Any, ...]] = ARGUMENTS | {
    planar.triangle_area: (numbers(1, 1.9), numbers(1, 1.9), numbers(1, 1.9)),
    crank.rrr_crank_reach: (points(), points(), numbers(), numbers(), numbers()),
    crank.rpr_crank_reach: (points(), points(), numbers(), numbers(0.1, 0.5)),
    crank.rrp_crank_reach: (points(), points(), points(), numbers(), numbers(), numbers(0.1, 0.5)),
}
LOOKING = {
    joint.neutral_axis,
    joint.bending,
    joint.circular_joint,
    rrr.rrr_condition,
}  # see the order or signs of numbers: others of the same
ON_STRUCTURES: set[Callable[..., Any]] = {  # take bodies and reactions by number
    *(equilibrium.left_over, equilibrium.solve_reactions, equilibrium.magnitudes),
}


@pytest.fixture
def graph() -> Iterator[Graph]:
    """What is recorded, while the test runs and no longer."""
    graph = Graph()
    token = current.set(graph)
    yield graph
    current.reset(token)


def public() -> list[Callable[..., Any]]:
    """All public functions of the mechanics."""
    named = [getattr(mechsheet, name) for name in mechsheet.__all__]
    return [f for f in named if inspect.isfunction(f) and f.__module__.startswith("mechsheet.mechanics.")]


def test_every_function_is_tried() -> None:
    assert set(ARGUMENTS) == set(STEPS) - ON_STRUCTURES
    assert set(public()) - ON_STRUCTURES <= set(BODIES)


@pytest.mark.parametrize("f", BODIES, ids=lambda f: f.__name__)
def test_a_function_is_recorded_by_running_itself_and_read_again_for_other_numbers(
    f: Callable[..., Any], graph: Graph
) -> None:
    given: dict[Node, Any] = {}

    def recorded(value: Any) -> Any:
        """A quantity for the first half of the cases; `given` has the other half."""
        if isinstance(value, list):
            return [recorded(v) for v in value]
        if isinstance(value, Load):
            return Load(recorded(value.F), recorded(value.P), recorded(value.M) if np.ndim(value.M) else value.M)
        half = len(value) // 2
        nodes = []
        for part in [value.real, value.imag] if np.iscomplexobj(value) else [value + 0.0]:
            nodes.append(graph.leaf("input", f"x{len(given)}", part[:half]))
            given[nodes[-1]] = part[:half] * (1 + 1e-9) if f in LOOKING else part[half:]
        return Quantity(graph, *nodes)

    def later(value: Any) -> Any:
        if isinstance(value, list):
            return [later(v) for v in value]
        if isinstance(value, Load):
            return Load(later(value.F), later(value.P), later(value.M) if np.ndim(value.M) else value.M)
        return value[: len(value) // 2] * (1 + 1e-9) if f in LOOKING else value[len(value) // 2 :]

    own = parts(f(*map(later, BODIES[f])))
    with np.errstate(all="ignore"):
        result = body(f)(*map(recorded, BODIES[f]))
    result = result._asdict() if hasattr(result, "_asdict") else vars(result) if isinstance(result, Load) else result
    quantities = result if isinstance(result, dict) else {"": result}
    assert {name for name, q in quantities.items() if isinstance(q, Quantity)} >= {n for n in own if own[n].ndim}
    assert all(read(graph.looked, given)[holds].all() for holds in graph.looked)
    for name, q in quantities.items():
        if name in own and isinstance(q, Quantity):
            known = read(q.parts, given)
            value = known[q.re] + (1j * known[q.im] if q.im else 0)
            size = np.nanmax(np.abs(own[name]), initial=0.0, where=np.isfinite(own[name])) or 1.0
            np.testing.assert_allclose(value / size, own[name] / size, rtol=0, atol=1e-12, err_msg=name)


@pytest.mark.parametrize("function", ARGUMENTS, ids=lambda f: f.__name__)
def test_the_steps_give_what_the_function_gives(function: Callable[..., Any]) -> None:
    arguments = ARGUMENTS[function]
    own = parts(function(*arguments))
    with np.errstate(all="ignore"):  # what another branch of a formula would give
        steps = parts(STEPS[function](*arguments))
    assert list(own) == list(steps)
    for name, value in own.items():
        size = np.nanmax(np.abs(value), initial=0.0, where=np.isfinite(value)) or 1.0
        np.testing.assert_allclose(steps[name] / size, value / size, rtol=0, atol=1e-9, err_msg=name)


def crank_mechanism(kind: str) -> tuple[list[list[Load]], list[equilibrium.Reaction]]:
    """Bodies in random positions: crank, rod, and a slider on the frame, a rocker, or a slider on a turning guide."""
    A, B, u = points(), points(), np.exp(1j * numbers(-3, 3))
    bodies = [loads(), loads(), [Load(points(), points())]]
    reactions: list[equilibrium.Reaction] = [
        equilibrium.DriveMoment(1, 0.0),
        equilibrium.PinReaction(1, 0, 0j, 0j),
        equilibrium.PinReaction(2, 1, 0j, A),
        equilibrium.PinReaction(3, 2, 0j, B),
    ]
    if kind == "rocker":
        return bodies, [*reactions, equilibrium.PinReaction(3, 0, 0j, points())]
    if kind == "slider":
        return bodies, [*reactions, equilibrium.SlideReaction(3, 0, 0j, B, u)]
    guide: list[equilibrium.Reaction] = [
        equilibrium.SlideReaction(3, 4, 0j, points(), u),
        equilibrium.PinReaction(4, 0, 0j, points()),
    ]
    return [*bodies, loads()], [*reactions, *guide]


@pytest.mark.parametrize("kind", ["rocker", "slider", "guide"])
def test_the_steps_solve_what_the_one_system_solves(kind: str) -> None:
    arguments = crank_mechanism(kind)
    if kind == "guide":  # one body more can move: it is driven too
        arguments[1].append(equilibrium.DriveMoment(3, 0.0))
    own = equilibrium.solve_reactions(*arguments)
    steps = STEPS[equilibrium.solve_reactions](*arguments)
    assert own.shape == steps.shape == (COUNT, len(arguments[0]) * 3)
    assert np.isfinite(own).all()
    np.testing.assert_allclose(steps, own, rtol=0, atol=1e-9 * np.abs(own).max())


@pytest.mark.parametrize("function", [rrr.rrr, rrp.rrp, rpr.rpr], ids=lambda f: f.__name__)
def test_what_does_not_close_is_no_number(function: Callable[..., Any]) -> None:
    arguments: dict[Any, tuple[Any, ...]] = {
        rrr.rrr: (0j, 5 + 0j, 1.0, 2.0, 1),
        rrp.rrp: (0 + 3j, 0j, 1 + 0j, 2.0, 1),
        rpr.rpr: (1 + 0j, 0j, 1, 2.0),
    }
    with np.errstate(invalid="ignore"):
        assert all(np.isnan(value).all() for value in parts(STEPS[function](*arguments[function])).values())


FIELDS = {  # arguments of a group, and rates that it may be given beside the velocities of its outer pairs
    rrr.RRRGroup: ((*pins(), signs()), {"dr_A": numbers()}),
    rrp.RRPGroup: ((points(), points(), points(), numbers(6, 9), signs(), numbers()), {"omega_B": numbers()}),
    rpr.RPRGroup: ((points() + 5, points(), signs(), numbers(0.1, 0.5)), {}),
    prp.PRPGroup: ((points(), points(), points(), points()), {"omega_A": numbers()}),
    rpp.RPPGroup: ((points(), points(), points(), points()), {"omega_B": numbers()}),
}


def test_every_group_is_tried() -> None:
    assert set(FIELDS) == {kind for kind in OWN if inspect.isclass(kind) and kind.__name__.endswith("Group")}


@pytest.mark.parametrize("kind", FIELDS, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("known", [True, False], ids=["positions recorded", "motion alone recorded"])
def test_a_group_of_recorded_quantities_gives_what_the_group_gives(kind: Any, known: bool, graph: Graph) -> None:
    count = 0

    def record(x: Any) -> Any:
        nonlocal count
        count += 1
        parts = [x.real, x.imag] if np.iscomplexobj(x) else [x]
        return Quantity(graph, *[graph.leaf("input", f"x{count}{n}", part) for n, part in enumerate(parts)])

    arguments, rates = FIELDS[kind]
    v, a, on_A, on_B = points(), points(), loads(), loads()
    shown = instead(kind)
    assert shown is not kind
    own, group = kind(*arguments), shown(*[record(x) if known else x for x in arguments])
    recorded_loads = [[Load(record(x.F), record(x.P), x.M) for x in on] for on in (on_A, on_B)]
    v_own, v_group = own.velocity(v, **rates), group.velocity(record(v), **{n: record(x) for n, x in rates.items()})
    pairs = [
        (v_own, v_group),
        (own.acceleration(v_own, a), group.acceleration(v_group, record(a))),
        (own.reactions(on_A, on_B), group.reactions(*recorded_loads)),
        *((getattr(own, n), getattr(group, n)) for n in ("C", "AC", "BC", "u", "s", "BA") if hasattr(own, n)),
        (own.condition, group.condition),
        (own.determinant, group.determinant),
        (own.transmission_angle, group.transmission_angle),
        (own.reach, group.reach),
    ]
    for plain, steps in pairs:
        for name, value in parts(plain).items():
            found = getattr(steps, name) if hasattr(plain, "_fields") else steps
            assert isinstance(found, Quantity) or not known or abs(found) in (0, np.inf)  # not given, without end
            number = np.asarray(getattr(found, "value", found))
            size = np.nanmax(np.abs(value), initial=0.0, where=np.isfinite(value)) or 1.0
            np.testing.assert_allclose(number / size, value / size, rtol=0, atol=1e-9, err_msg=name)


def parts(result: Any) -> dict[str, Any]:
    """Numbers of a result by name; words such as a state are left out."""
    if hasattr(result, "_asdict"):
        result = result._asdict()
    elif isinstance(result, Load):
        result = vars(result)
    elif isinstance(result, tuple):
        result = dict(enumerate(result))
    else:
        result = {"": result}
    arrays = {name: np.asarray(value) for name, value in result.items()}
    return {name: value for name, value in arrays.items() if value.dtype.kind in "fc"}


def test_a_ring_of_uneven_bolts_is_none_where_it_has_no_equilibrium() -> None:
    """Its texts too: they are compared like numbers."""
    random, seen = np.random.default_rng(1), set[str]()
    for _ in range(200):
        phi = np.sort(random.uniform(0, 2 * np.pi, random.integers(2, 7)))
        M, N, r = 10 * random.normal(), 30 * random.normal() * random.integers(0, 2), random.uniform(0.2, 2)
        own = joint.circular_joint(r, phi, M, N)
        with np.errstate(all="ignore"):
            ring = elementary_joint.circular_joint(np.float64(r), phi, np.float64(M), np.float64(N))
        for name in ("P", "p_0", "R", "M_R", "M_x", "c", "phi_0"):
            assert np.array_equal(np.isnan(getattr(ring, name)), np.isnan(getattr(own, name))), name
        assert ring.state == str(own.state)
        seen.add(str(own.state))
    assert len(seen) > 3


def turned() -> tuple[Any, Any]:
    """Random directions, and origins of the same size as the links."""
    return np.exp(1j * numbers(-3, 3)), points()


def dead_centres() -> Iterator[tuple[Callable[..., Any], tuple[Any, ...]]]:
    """Velocities, accelerations, reactions, conditions of groups in a dead centre, which rounding alone hides."""
    u, A = turned()
    r, t = numbers(), numbers()
    v, on = points(), (loads(), loads())
    flat, square = (A, A + u * (r + t), A + u * r), A + 1j * u * r
    yield rrr.rrr_velocity, (*flat, v)
    yield rrr.rrr_acceleration, (*flat, r, t, r, t, v)
    yield rrr.rrr_reactions, (*flat, *on)
    yield rrr.rrr_condition, flat
    yield rrr.rrr_determinant, flat
    yield rrp.rrp_velocity, (A, square, square, u, v)
    yield rrp.rrp_acceleration, (A, square, square, u, r, t, r, t, v)
    yield rrp.rrp_reactions, (A, square, u, *on)
    yield rrp.rrp_condition, (A, square, square, u)
    yield rrp.rrp_determinant, (A, square, u)
    yield rpr.rpr_velocity, (A, square, u, v)
    yield rpr.rpr_acceleration, (A, square, u, r, t, v)
    yield rpr.rpr_reactions, (A, square, u, *on)
    yield rpr.rpr_condition, (A, square, u)
    yield rpr.rpr_determinant, (A, square, u)
    bodies, (_, *reactions) = crank_mechanism("rocker")
    crank, rod = numbers(0.3, 1), numbers(0.5, 2)
    in_line = u * crank, u * (crank + rod) * (1 + 5e-16j)  # and not to the last bit, which numpy refuses
    reactions[1:3] = [replace(p, P=x) for p, x in zip(reactions[1:3], in_line, strict=True)]
    yield equilibrium.solve_reactions, (bodies, [*reactions, equilibrium.DriveMoment(3, 0.0)])
    guides = u * r, u * t
    yield prp.prp, (A, A + v, *guides)
    yield prp.prp_velocity, (A, A + v, A, *guides, v)
    yield prp.prp_acceleration, (A, A + v, A, *guides, r, t, r, t, v)
    yield prp.prp_reactions, (A, *guides, *on)
    yield prp.prp_condition, guides
    yield rpp.rpp, (A, A + v, *guides)
    yield rpp.rpp_velocity, (A, A + v, A, *guides, v)
    yield rpp.rpp_acceleration, (A, A + v, A, *guides, r, t, r, v)
    yield rpp.rpp_reactions, (A, A + v, *guides, *on)
    upright, level = A + 1j * r, 1 + 0j  # no part of a result is known either
    yield rrp.rrp_velocity, (A, upright, upright, level, v)
    yield rrp.rrp_reactions, (A, upright, level, *on)
    yield rpr.rpr_reactions, (A, upright, level, *on)
    yield prp.prp_velocity, (A, A + v, A, level, 2 * level, v)
    yield prp.prp_reactions, (A, level, 2 * level, *on)
    yield rpp.rpp_velocity, (A, A + v, A, level, 2 * level, v)
    yield rpp.rpp_reactions, (A, A + v, level, 2 * level, *on)
    idle = [Load(0j, A, r)]  # a couple alone needs no force
    yield rrp.rrp_reactions, (A, A + r, level, [], idle)
    yield drive.cylinder_drive, (A, A + r, 0j, [Load(0j, A + r, r)])


@pytest.mark.parametrize(("function", "arguments"), list(dead_centres()), ids=lambda x: getattr(x, "__name__", ""))
def test_at_a_dead_centre_the_steps_have_no_number_either(
    function: Callable[..., Any], arguments: tuple[Any, ...]
) -> None:
    """Rounding made forces of 1e17 N of it in a page, and in a workbook where Excel does not take it for nothing."""
    own = parts(function(*arguments))
    with np.errstate(all="ignore"):
        steps = parts(STEPS[function](*arguments))
    assert any(not np.isfinite(value).any() for value in own.values())  # of the last two a distance alone
    for name, value in own.items():
        np.testing.assert_array_equal(np.isfinite(steps[name]), np.isfinite(value), err_msg=name)
        assert (np.isinf(steps[name]) == np.isinf(value)).all(), name


def test_the_steps_close_a_dyad_of_links_in_one_line() -> None:
    """Its transmission angle is pi and not 2e-8 less, and it has a place where a rounding parts the links."""
    for L, r_A, r_B in ((0.5, 0.3, 0.2), (1.3 - 0.1, 0.7, 0.5), (0.25, 0.75, 0.5), (0.75, 0.5, 1.25)):
        C = rrr.rrr(0j, L + 0j, r_A, r_B, 1)
        steps = STEPS[rrr.rrr](0j, np.complex128(L), np.float64(r_A), np.float64(r_B), 1)
        assert abs(steps - C) < 1e-15 and steps.imag == 0
        assert STEPS[rrr.rrr_transmission_angle](0j, L + 0j, steps) in (0, np.pi)


def test_the_steps_keep_the_digits_of_long_links_whose_outer_pins_are_near_each_other() -> None:
    u, _ = turned()
    A, B = 1e-6 * points(), 1e-6 * points()
    C, on = 1e3 * u, (loads(), loads())
    for function, arguments in (
        (rrr.rrr_velocity, (A, B, C, points(), points())),
        (rrr.rrr_reactions, (A, B, C, *on)),
        (rrr.rrr_determinant, (A, B, C)),
        (rrr.rrr_transmission_angle, (A, B, C)),
    ):
        own, steps = parts(function(*arguments)), parts(STEPS[function](*arguments))
        for name, value in own.items():
            np.testing.assert_allclose(steps[name], value, rtol=1e-12, err_msg=f"{function.__name__} {name}")


def test_the_steps_bend_no_section_that_lies_on_one_level() -> None:
    """Rounding of its centroid made stresses of 1e17 Pa of it."""
    one, alone = np.full((COUNT, 5), 0.1) * numbers()[:, None], rng.uniform(0.1, 1, (COUNT, 5))
    areas = alone * (np.arange(5) == 2)
    for y, A in ((one, alone), (alone, areas), (0 * one, alone)):
        own, steps = joint.bending(y, A, 1.0, 100.0), STEPS[joint.bending](y, A, np.float64(1.0), np.float64(100.0))
        assert np.isnan(own.sigma).all() and np.isnan(steps.sigma).all() and np.isnan(steps.y_0).all()


def test_the_steps_pull_a_symmetrical_section_evenly() -> None:
    """Its neutral axis was 1e15 m away, and not at infinity, where rounding left a moment."""
    y = np.array([0.1, 0.2, 0.3, -0.1, -0.2, -0.3])
    for N in (100.0, -3.0):
        own = joint.bending(y, 1.0, 0.0, N)
        with np.errstate(divide="ignore"):
            steps = STEPS[joint.bending](y, np.ones(6), np.float64(0), np.float64(N))
        assert steps.y_0 == own.y_0 and np.isinf(steps.y_0)


@pytest.mark.parametrize("size", [2.0**-480, 2.0**480])
def test_the_steps_close_a_dyad_of_any_size(size: float) -> None:
    A, B, r_A, r_B = pins()
    C = STEPS[rrr.rrr](A, B, r_A, r_B, 1)
    np.testing.assert_array_equal(STEPS[rrr.rrr](size * A, size * B, size * r_A, size * r_B, 1), size * C)


def inputs_of(graph: Graph, **given: float) -> list[Quantity]:
    return [Quantity(graph, graph.leaf("input", name, np.asarray(x))) for name, x in given.items()]


def test_where_links_lie_in_one_line_the_steps_have_no_slope(graph: Graph) -> None:
    """It was 0 of a constant that stood for what rounding leaves under the root."""
    a, b, c = given = inputs_of(graph, a=0.5, b=0.3, c=0.2)
    C = STEPS[rrr.rrr](0j, a + 0j, b, c, 1)
    flat = [STEPS[planar.angle_opposite](a, b, c), STEPS[planar.angle_opposite](b, a, c), C.real, C.imag]
    for slope in slopes([x.re for x in flat], [x.re for x in given]).values():
        assert np.isnan(slope.both).all()


def test_a_symmetrical_section_keeps_its_slopes(graph: Graph) -> None:
    """Its first moment was a constant 0 within rounding: its tolerances were not followed."""
    y, M, N = inputs_of(graph, y=0.1, M=1e3, N=100.0)
    levels = [y, 0.05, -0.05, -0.1]
    steps = STEPS[joint.bending](np.stack(levels), lift(graph, np.full(4, 1e-4)), M, N)
    wanted = [steps.y_c.re, steps.sigma[0].re]
    found = slopes(wanted, [y.re])
    h = 1e-6
    more, less = (joint.bending([0.1 + d, 0.05, -0.05, -0.1], 1e-4, 1e3, 100.0) for d in (h, -h))
    differences = [(more.y_c - less.y_c) / (2 * h), (more.sigma[0] - less.sigma[0]) / (2 * h)]
    np.testing.assert_allclose([float(found[x].both[0]) for x in wanted], differences, rtol=1e-6)
    assert not jumps(wanted, [y.re], [1e-3])
