"""Extreme scenes: the listed ones, worse ones that are searched for, and faults that must be noticed."""

from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from conftest import examples
from hypothesis import Phase, assume, given, target
from hypothesis import strategies as st

from mechsheet.accuracy import exact, extreme, printed
from mechsheet.accuracy.arithmetic import conditions, equations, mpc, pin, reactions, rrr, undecided
from mechsheet.accuracy.assur import KINDS
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import cross
from mechsheet.mechanics.rrr import RRRGroup, RRRReactions, rrr_reactions
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import Choice
from mechsheet.worksheet.lists import Rows

WORKSHEETS = Path(__file__).parents[1] / "worksheets"
SCENES = {scene.name: scene for scene in extreme.scenes()}


def lost(outcomes):
    """The results that keep less than is expected of them, one line each."""
    return [
        f"{o.case} {o.result}: {o.product:.1f} of {o.expected:.1f} digits {o.words}" for o in outcomes if not o.holds
    ]


@pytest.mark.parametrize("name", SCENES)
def test_scene_keeps_its_digits(name):
    outcomes = extreme.measured(name, WORKSHEETS, short=True)
    assert outcomes
    assert lost(outcomes) == []


# How near a scene is to what it is called after: the least logarithm of the greatest condition number of its results.
# Guides 1e-12 rad off parallel, and links 1e-12 of their length off a line or square to their guide, have 1e12 in the
# crossing and in rates; a length 1e-12 of another one short of its end has its root, 1e6, in the position. Of what the
# document's fifteen steps lead to, the last is 1e-15. Points 1e3 and 1e9 m away on links of a metre or 1e-6 have 1e9.
NEAR = {
    "prp_nearly_parallel": 12,
    "rpp_nearly_parallel": 12,
    "rpr_drive_through_dead_centre": 12,
    "rrp_drive_through_dead_centre": 12,
    "rrr_moved_to_dead_centre": 12,
    "rrr_dead_centre_extended": 15,
    "rrr_dead_centre_folded": 15,
    "rpr_spread": 9,
    "rrp_spread": 9,
    "rrr_spread": 9,
    "slotted_link_past_its_hinge": 12,
    "kinetostatics_drive_through_dead_centre": 6,
    "dead_centre_extended": 15,
    "dead_centre_folded": 15,
    "rod_in_line": 15,
    "ring_axis_at_rim": 12,
    "away_1e9": 9,
}


@pytest.mark.parametrize("name", NEAR)
def test_a_stiff_scene_is_as_near_as_it_says_and_its_results_can_keep_digits(name):
    outcomes = extreme.measured(name, WORKSHEETS, short=True)
    kappa = [o.condition for o in outcomes if np.isfinite(o.condition)]
    assert np.log10(max(kappa)) > NEAR[name] - 0.5
    assert np.mean([o.expected > 1 for o in outcomes]) > 0.5, "a scene that expects no digits cannot fail"


def test_every_kind_of_group_is_measured_with_its_motion_and_reactions():
    for name in KINDS:
        results = {o.result for s in SCENES.values() if s.job == name and not s.says for o in measured(s.name)}
        assert {"R_A", "R_B", "R_C"} < results and {"C", "u"} & results, name
        assert any(r.startswith(("omega", "ds")) for r in results), name
        assert any(r.startswith(("epsilon", "dds")) for r in results), name


def measured(name):
    return extreme.measured(name, WORKSHEETS, short=True)


def test_kinetostatics_are_measured_with_all_reactions_beside_the_printed_ones():
    results = {o.result: o for o in measured("kinetostatics_loads")}
    forces = {"R_A", "R_B", "R_C", "R_D", "R_E", "R_K", "R_H", "R_05", "R_76"}
    assert forces | {"M_b", "omega3", "v5", "eps6", "a_E"} < set(results)
    assert all(np.isfinite(results[name].printed) for name in forces)
    assert {o.case for o in measured("kinetostatics_loads")} == {"1000000000.0, 1e-09", "0.001, 1000.0", "0.0, 0.0"}
    slotted = {o.result: o.printed for o in measured("slotted_link_spread") if o.case.startswith("1")}
    assert all(np.isfinite(slotted[name]) for name in ("SAB_k", "omega_BC_k", "eps_BC_k"))


# The measure


def test_condition_of_a_difference():
    """Of x - y it is (|x| + |y|) / |x - y|; a whole number is no rounded one."""
    found = conditions(lambda x, y, n: {"d": n * (x - y), "zero": 0 * x}, {"x": 3.0, "y": 2.9999, "n": 7})
    assert float(found["d"]) == pytest.approx(5.9999 / 1e-4, rel=1e-9)
    assert found["zero"] == 0


def test_condition_of_a_row_is_that_of_its_greatest():
    found = conditions(lambda x, y: {"row": [x + y, x - y]}, {"x": 3.0, "y": 2.0})
    assert float(found["row"]) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("value", "true", "kept"), [(1.0, 1, 16), (1.001, 1, 3), (np.nan, 1, 0), (0.0, 0, 16), (1, 0, 0)]
)
def test_digits(value, true, kept):
    assert extreme.digits("x", value, mp.mpf(true)) == pytest.approx(kept, abs=1e-9)


def test_angles_are_compared_in_any_turn():
    assert extreme.digits("phi3", np.pi, -mp.pi) > 15
    assert extreme.digits("x", np.pi, -mp.pi) == 0


def test_a_position_that_rounding_decides_is_told_from_one_that_is_out_of_reach():
    given = {"A": 1.0, "Ay": 2.0, "B": 4.0, "By": 6.0, "r_B": 3.0}

    def C(**x):
        return {"C": KINDS["RRR"].exact_of(**x)["C"]}

    assert "C" in undecided(C, {"r_A": np.nextafter(2.0, 0), **given})
    assert not undecided(C, {"r_A": 1.9999, **given})


def test_truth_of_the_dyad_is_in_equilibrium_and_moves_with_its_length():
    """Reactions against the dense system of six equations, the pin against its loop, rates against the sine of mu."""
    points = {"A": (0, 1), "B": (4, 0.5), "P_A": (1, 2), "P_B": (3, 1), "F_A": (5, -7), "F_B": (-2, 1)}
    numbers = {"r_A": 3.0, "r_B": 2.0, "dr_A": 1.0}
    for name, (x, y) in points.items():
        numbers |= {name: float(x), f"{name}y": float(y)}
    A, B, P_A, P_B, F_A, F_B = (mpc(*z) for z in points.values())
    true = KINDS["RRR"].exact_of(**numbers)
    C = true["C"]
    assert abs(abs(C - A) - 3) + abs(abs(C - B) - 2) < mp.mpf(10) ** -50
    assert mp.sign(((mp.conj(B - A)) * (C - A)).imag) == 1 and abs(C - rrr(A, B, 3, 2, 1)) < mp.mpf(10) ** -50
    unknowns = [*pin(A, 0), *pin(B, 1), *pin(C, 0, 1)]
    loads = [(0, F_A, P_A, 0), (1, F_B, P_B, 0)]
    assert len(equations(unknowns, loads, [A, B])[0]) == 6
    x = reactions(unknowns, loads, [A, B])
    for k, name in enumerate(("R_A", "R_B", "R_C")):
        assert abs(mpc(x[2 * k], x[2 * k + 1]) - true[name]) < mp.mpf(10) ** -40
    rod = (C - A) / 3
    assert abs((rod * mp.conj(1j * true["omega_B"] * (C - B))).real - 1) < mp.mpf(10) ** -50, "A lengthens by 1"


@pytest.mark.parametrize("worksheet", ["hitch", "landing_gear", "slotted_link", "kinetostatics", "joint"])
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_no_input_takes_what_is_no_number(worksheet, value):
    cls = load(WORKSHEETS / f"{worksheet}.py").inputs
    default = cls()
    for field in inputs.declared(cls):
        given, held = value, value
        if isinstance(field, Rows):
            leaves = field.leaves(getattr(default, field.name))
            columns = {name: [*xs[:-1], value] for name, (_, xs) in leaves.items()}
            given = columns if field.row else columns[field.name]
            held = field.held({name: np.array(xs) for name, xs in columns.items()})
        refused = "must be one of " if isinstance(field, Choice) else "(is no number|must be a finite number)"
        with pytest.raises(SheetError, match=rf"{field.name}.* = .* {refused}"):
            inputs.build(cls, {field.name: given})
        if not field.whole and not isinstance(field, Choice):
            with pytest.raises(SheetError, match=rf"{field.name}.* = .* must be a finite number"):
                cls(**{field.name: held})


# Worse scenes than the listed ones

# without shrinking, which takes longer than the search
searching = {"phases": [Phase.explicit, Phase.generate, Phase.target], "report_multiple_bugs": False}


# What is promised of any inputs: 64 roundings times the condition number. A sum of a dozen terms may take twenty.
PROMISED = np.log10(64)


def holds(case):
    """Every result of a case keeps the digits that are promised; the worst is what the search goes for."""
    outcomes = extreme.outcomes(case)
    target(max(o.expected - o.product for o in outcomes))
    assert lost(o for o in outcomes if not o.expected - o.product <= PROMISED) == []


def powers(low, high):
    """Numbers spread evenly over the decades."""
    return st.floats(low, high).map(lambda k: 10.0**k)


signs = st.sampled_from([-1.0, 1.0])
angles = st.floats(-3.2, 3.2)
# angles between the links: anything, and nearer and nearer to a dead centre
closing = st.one_of(
    angles.filter(lambda mu: abs(np.sin(mu)) > 0.01), powers(-9, -1), powers(-9, -1).map(lambda d: np.pi - d)
)


@st.composite
def groups(draw):
    """A group built around its inner point: links over twelve decades, anywhere, moved and loaded at both ends."""
    name, far = draw(st.sampled_from([*KINDS])), draw(st.sampled_from([0.0, 0.0, 1.0, 1e3, 1e6, 1e9]))
    C = far * np.exp(1j * draw(angles))
    r_A, r_B, first = draw(powers(-6, 6)), draw(powers(-6, 6)), draw(angles)
    a, b = np.exp(1j * first), np.exp(1j * (first + draw(closing)))
    A, B = C - r_A * a, C - r_B * b
    if name == "RRR" and cross(B - A, C - A) < 0:
        A, B, r_A, r_B = B, A, r_B, r_A
    # nearer to the rounding of the pins no condition number holds: it is of the first order
    assume(min(r_A, r_B, abs(B - A)) > 1e5 * np.spacing(max(abs(A), abs(B))))
    u = 1j * b if name == "RRP" else b  # square to AC at the dead centre
    u = u if cross(u, 1j * (C - A)) > 0 or name != "RRP" else -u
    offset = cross(u, C - B) if name == "RRP" else cross(1j * a, A - B)
    kind, points = KINDS[name], {"A": A, "B": B, "u": u, "w": a}
    for end, pin_, r in (("A", A, r_A), ("B", B, r_B)):
        points[f"P_{end}"] = pin_ + draw(powers(-3, 1)) * r * np.exp(1j * draw(angles))
        points[f"F_{end}"] = draw(powers(-6, 12)) * np.exp(1j * draw(angles))
        for motion in ("v", "a"):
            points[f"{motion}_{end}"] = draw(powers(-6, 6)) * np.exp(1j * draw(angles))
    given = {"r_A": r_A, "r_B": r_B, "e": offset}
    given |= {name: draw(powers(-6, 6)) for name in kind.numbers if name.startswith(("dr", "ddr", "omega", "epsilon"))}
    for point, z in points.items():
        given |= {point: z.real, f"{point}y": z.imag}
    return name, {key: float(x) for key, x in given.items() if key in kind.numbers}


@examples(30, **searching)
@given(groups())
def test_search_for_worse_groups(group):
    name, given = group
    holds(extreme.group(name, WORKSHEETS, given))


@st.composite
def machines(draw):
    """The document's hitch, with other lengths, anywhere, of any size, up to a dead centre."""
    cls = load(WORKSHEETS / "hitch.py").inputs
    g = cls()
    size, far = draw(powers(-6, 6)), draw(st.sampled_from([0.0, 0.0, 10.0, 1e5, 1e8]))
    given = {"N_pol": 2, "P6": draw(powers(-6, 12)), "phi_P6": draw(st.floats(80, 100))}
    for field in inputs.declared(cls):
        if field.unit == "m":
            value = getattr(g, field.name)
            hinge = field.name[0] in "XY" and field.name[1:2] == "0"
            given[field.name] = size * (
                value * draw(st.floats(0.98, 1.02)) + (far if hinge or field.name[0] == "Y" else 0)
            )
    given |= {"X6": size * g.X6, "Y6": size * g.Y6}
    O1, O3 = (complex(given[f"X0{k}"], given[f"Y0{k}"]) for k in (1, 3))
    reach = abs(O1 - O3) + given["L3"]
    given["S_max"] = reach - (reach - given["S_min"]) * draw(powers(-7, -0.7))
    return given


@examples(12, **searching)
@given(machines())
def test_search_for_worse_machines(machine):
    try:
        case = extreme.hitch(WORKSHEETS, machine)
    except SheetError as error:
        with pytest.raises(ValueError, match="does not exist"):
            exact.finds(inputs.build(load(WORKSHEETS / "hitch.py").inputs, machine))
        assert "is outside" in str(error)
        return
    holds(case)


@st.composite
def joints(draw):
    """A joint of any shape under any load, or nearly with its axis in an element or at infinity."""
    h, b, F_b, F_s = (draw(powers(*decades)) for decades in ((0, 3), (0, 3), (-2, 2), (-2, 2)))
    beams = [(h / 2 * y, b / 2 * z, F_b, 1, 1) for y, z in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    round = [(1, 0.5), (0.5, 1), (-0.5, 1), (-1, 0.5), (-1, -0.5), (-0.5, -1), (0.5, -1), (1, -0.5)]
    stringers = [(h / 2 * y, b / 2 * z, F_s, draw(st.sampled_from([0, 1])), 1) for y, z in round]
    N = draw(signs) * draw(powers(-6, 9))
    lever = draw(st.one_of(powers(-12, 6), st.sampled_from([0.0, 0.25, 0.5, 1.0])))
    return {"beams": beams, "stringers": stringers, "N": N, "M": draw(signs) * N * h / 2 * lever}


@examples(12, **searching)
@given(joints(), st.sampled_from([0, 1]))
def test_search_for_worse_joints(joint, at):
    case = extreme.joint(WORKSHEETS, joint, at)
    try:
        case.true(**case.x)
    except ValueError:
        assert "no elements carry" in case.words
        return
    holds(case)


# Faults: each must be noticed by a listed scene or by the search


def needle(a, b, c):
    """The printed law of cosines for the angle opposite to a."""
    with np.errstate(invalid="ignore"):
        return np.arccos((b**2 + c**2 - a**2) / (2 * b * c))


def eliminated(A, B, C, loads_A=(), loads_B=()):
    """The printed elimination, which divides by a difference of abscissas."""
    loads = [loads[0] if loads else Load(0.0, 0.0) for loads in (loads_A, loads_B)]
    side = np.sign(cross(B - A, C - A))
    (F_A, P_A), (F_B, P_B) = ((load.F, load.P) for load in loads)
    R = printed.dyad(A, B, np.abs(C - A), np.abs(C - B), side, P_A, P_B, F_A, F_B)
    return RRRReactions(R["R_A"], R["R_B"], R["R_C"])


def summed(A, B, C, loads_A=(), loads_B=()):
    """The force in the inner pin as a difference of the others."""
    R = rrr_reactions(A, B, C, loads_A, loads_B)
    return RRRReactions(R.R_A, R.R_B, -((R.R_B - R.R_A) / 2 + sum(load.F for load in [*loads_A, *loads_B]) / 2))


@pytest.mark.parametrize(
    ("name", "worksheet", "function", "fault"),
    [
        ("tiny_crank", "landing_gear", "angle_opposite", needle),
        ("mast_upright", "hitch", "rrr_reactions", eliminated),
        ("axis_at_infinity_pressed", "joint", "total", lambda x: x.sum(-1, keepdims=True)),
    ],
)
def test_fault_in_a_worksheet_is_noticed(monkeypatch, name, worksheet, function, fault):
    monkeypatch.setitem(load(WORKSHEETS / f"{worksheet}.py").common, function, fault)
    assert lost(extreme.measure(SCENES[name], WORKSHEETS, short=True))


def test_fault_in_the_library_is_noticed_by_the_search(monkeypatch):
    monkeypatch.setattr(RRRGroup, "reactions", lambda dyad, *loads: summed(dyad.A, dyad.B, dyad.C, *loads))
    with pytest.raises(AssertionError):
        test_search_for_worse_groups()


def test_missing_word_is_noticed():
    silent = extreme.Outcome("", "", "", np.nan, np.nan, np.nan, np.nan, words="", wanted="no position closes")
    assert not silent.holds


def test_what_a_rounded_position_costs_the_rates_costs_the_accelerations():
    """A guide turns at 1e6 rad/s a millimetre from the pin, a thousand kilometres from the origin."""
    far = {"A": 999987.8, "Ay": 1e-3, "B": 1e6, "By": 2.6e-4, "u": -0.67, "uy": 0.74, "w": 1.0, "wy": -6e-8}
    case = extreme.group("PRP", WORKSHEETS, far | {"omega_B": 1e6})
    outcomes = {o.result: o for o in extreme.outcomes(case)}
    assert outcomes["ds_B"].condition > 1e8 and outcomes["dds_B"].condition > 1e8
    assert lost(o for o in outcomes.values() if not o.holds) == []
