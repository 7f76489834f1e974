"""The hitch worksheet against the printed document, section by section."""

import math
from dataclasses import replace
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from printed import agrees, rows

from mechsheet import units
from mechsheet.accuracy import exact
from mechsheet.accuracy.arithmetic import DIGITS, reactions
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Check, checks_of
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import build
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Table
from worksheets import hitch

TABLES = sorted(p.name for p in (Path(__file__).parent / "reference" / "hitch").glob("table_*.csv"))


@pytest.fixture(scope="module")
def sheet():
    return hitch.app.run()[1]


PRINTED = {"Pgc": ("MPa", 1e6)}  # shown in the unit of its formula, printed in pascals


def columns(sheet) -> dict[str, np.ndarray]:
    every = [c for table in sheet.values() if isinstance(table, Table) for c in table.columns]
    assert {c.symbol: c.unit for c in every if c.symbol in PRINTED} == {
        name: unit for name, (unit, _) in PRINTED.items()
    }
    return {c.symbol: c.values * PRINTED[c.symbol][1] if c.symbol in PRINTED else c.values for c in every}


@pytest.mark.parametrize("name", TABLES)
def test_printed_table(sheet, name):
    found = columns(sheet)
    printed = rows(f"hitch/{name}")
    assert len(printed) == 10
    wrong = [
        (heading, row["S"], text, float(found[heading][i]))
        for i, row in enumerate(printed)
        for heading, text in row.items()
        if not agrees(float(found[heading][i]), text)
    ]
    assert not wrong


def test_all_760_numbers_are_compared():
    assert sum(len(row) - 1 for name in TABLES for row in rows(f"hitch/{name}")) == 760


@pytest.mark.parametrize("row", rows("hitch/scalars.csv"), ids=lambda row: row["name"])
def test_printed_scalar(sheet, row):
    value = sheet["g"].L6 if row["name"] == "L6" else sheet[row["name"]]
    assert agrees(float(value) / units.parse(row["unit"]).factor, row["printed"])


def test_every_check_passes(sheet):
    checks = [c for v in sheet.values() for c in (v if isinstance(v, tuple) else [v]) if isinstance(c, Check)]
    assert len(checks) >= 15
    assert [str(c) for c in checks if not c.passed] == []


# Printed errata beside what holds


def test_printed_cylinder_angle_misses_the_pin(sheet):
    assert np.min(np.abs(sheet["P23s_S"] - sheet["P23_S"])) > 0.2
    assert np.max(np.abs(sheet["P23c_S"] - sheet["P23_S"])) < 1e-15


def test_the_documents_own_formulas_give_its_angles_and_its_pole(sheet):
    """The law of cosines, half of the circle each, and the pole by the letters AA to FF."""
    for k in range(3, 8):
        assert np.allclose(sheet[f"phi{k}_d"], sheet[f"phi{k}_S"], rtol=0, atol=1e-14), k
    for name, own in {"dphi3_d": "dphi3", "X_pd": "X_p", "Imp_d": "Imp", "Isp_d": "Isp"}.items():
        assert np.allclose(sheet[name], sheet[own], rtol=1e-13, atol=0), name


def test_the_documents_angles_are_lost_where_the_lift_arm_passes_the_line_of_its_hinges(sheet):
    """Beyond 180 degrees of phi341 its arccosine gives the other side; the worksheet's groups still close."""
    far = hitch.app.run(defs={"g": replace(sheet["g"], S_max=0.75)})[1]
    beyond = far["phi341"] > math.pi
    assert beyond.any() and not beyond.all()
    for k in (4, 5):
        off = np.abs(np.exp(1j * (far[f"phi{k}_d"] - far[f"phi{k}_S"])) - 1)
        assert np.all(off[~beyond] < 1e-13) and np.all(off[beyond] > 0.01), k
    assert [str(c) for c in far["checks_closing"] + far["checks_loops"] if not c.passed] == []


def test_right_load_keeps_a_fifth_on_the_front_axle_and_the_printed_one_does_not(sheet):
    g, x = sheet["g"], sheet["PS6_S"].real

    def share(P):
        return (g.P_gr * (g.a + g.L) + g.P_msha * g.b - P * x) / g.L / (P + g.P_msha + g.P_gr)

    assert np.allclose(share(sheet["GS6_lim"]), 0.2, rtol=0, atol=1e-15)
    assert np.all(share(sheet["GS6_max"]) < 0.1)
    assert (round(min(sheet["GS6_lim"])), round(max(sheet["GS6_lim"]))) == (31075, 34679), "the figures of the errata"
    assert np.any(sheet["GS6_lim"] < sheet["GS6"]), "stability and not hydraulics limits the load at some positions"


# The whole chain at 50 digits, by other formulas


def agrees_with_truth(sheet, row, limit):
    true = exact.hitch(sheet["g"], sheet["S"][row])
    scale = float(max(abs(true[k]) for k in true if k.startswith("R")))
    for name in ("R01", "R03", "R05", "R07", "R23", "R34", "R45", "R56", "R67", "I56", "IS6"):
        error = abs(complex(sheet[name][row]) - complex(true[name])) / (scale if name[0] == "R" else 1)
        assert error < limit, (name, row, error)
    for name in ("P45_S", "P56_S", "P67_S", "PS6_S"):
        error = abs(complex(sheet[name][row]) - complex(true[name]))
        assert error < limit, (name, row, error)


@pytest.mark.parametrize("S", [0.42, 0.5, 0.67])
def test_truth_is_in_equilibrium(S):
    """The reactions at 50 digits against one dense system of the 18 equations of the six bodies."""
    g, bodies = hitch.Hitch(), range(2, 8)
    x = exact.hitch(g, S)
    pins = {"R01": (x["O1"], None, 2), "R03": (x["O3"], None, 3), "R05": (x["O5"], 5, None), "R07": (x["O7"], None, 7)}
    pins |= {"R23": (x["P23_S"], 2, 3), "R34": (x["P34_S"], 4, 3), "R45": (x["P45_S"], 5, 4)}
    pins |= {"R56": (x["P56_S"], 5, 6), "R67": (x["P67_S"], 6, 7)}
    unknowns = [
        [(k - 2, f * sign, P, 0) for k, sign in ((by, -1), (on, 1)) if k is not None]
        for P, by, on in pins.values()
        for f in (mp.mpc(1), mp.mpc(0, 1))
    ]
    solved = reactions(unknowns, [(4, mp.mpc(0, -g.P6), x["PS6_S"], 0)], [mp.mpc(0)] * len(bodies))
    for k, name in enumerate(pins):
        assert abs(mp.mpc(solved[2 * k], solved[2 * k + 1]) - x[name]) < mp.mpf(10) ** -40, name


def test_truth_solves_the_three_finds():
    g = hitch.Hitch()
    found = exact.finds(g)
    low, work = (exact.hitch(g, S, **found) for S in (g.S_min, found["S_p"]))
    for value, wanted in ((low["P56_S"].imag, g.Y56_min), (work["P56_S"].imag, g.Y_P56), (work["phi6_S"], g.phi_P6)):
        assert abs(value - wanted) < mp.mpf(10) ** -DIGITS


@pytest.mark.parametrize("row", range(10))
def test_every_position_to_50_digits(sheet, row):
    agrees_with_truth(sheet, row, 1e-13)


def test_mast_upright_where_the_printed_formulas_divide_by_zero(sheet):
    """At S_p the mast is upright, d1 = X67 - X56 vanishes and the printed R56y is lost."""
    upright = hitch.app.run(defs={"g": replace(sheet["g"], S_max=sheet["S_p"])})[1]
    assert abs((upright["P67_S"] - upright["P56_S"])[-1].real) < 1e-15
    agrees_with_truth(upright, -1, 1e-10)


def test_cylinder_upright_where_the_printed_formulas_divide_by_zero(sheet):
    """X23 = X01 at S near 0.43597, where b3 vanishes and the printed R01y is lost."""
    S0 = abs(sheet["O3"].imag - sheet["O1"].imag + 1j * 0) - math.sqrt(0.2**2 - (0.415 - 0.25) ** 2)
    assert 0.4359 < S0 < 0.4360
    upright = hitch.app.run(defs={"g": replace(sheet["g"], S_min=S0)})[1]
    assert abs(upright["P23_S"][0].real - 0.415) < 1e-15
    agrees_with_truth(upright, 0, 1e-10)


# Angles in all quadrants


COUNT = 10_000


def places(seed):
    """Points within 2 m of the origin, a quarter of them on a grid: some lie from others exactly along an axis."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(0.05, 2, COUNT) * np.exp(1j * rng.uniform(-np.pi, np.pi, COUNT))
    points[::4] = np.round(points[::4] * 4) / 4
    return points


def apart(*points):
    """Two points each, more than 0.1 m apart, one from the other in all quadrants and along all axes."""
    A, B = (each[abs(points[0] - points[1]) > 0.1] for each in points)
    signs = np.sign((A - B).real) + 1j * np.sign((A - B).imag)
    assert len(A) > 0.95 * COUNT and len(np.unique(signs)) == 8
    return A, B


def test_first_group_angles_in_all_quadrants():
    O1, O3 = apart(places(1), places(2))
    L13 = abs(O1 - O3)
    L3 = L13 * np.random.default_rng(3).uniform(0.4, 2, len(L13))
    g = replace(hitch.Hitch(), X01=O1.real, Y01=O1.imag, X03=O3.real, Y03=O3.imag, L3=L3)
    names = load(hitch.__file__).run(["phi13", "phi12", "P23"], {"O1": O1, "O3": O3, "g": g})
    S = L3 + 0.3 * L13
    assert np.allclose(np.exp(1j * names["phi13"]), np.conj(O1 - O3) / L13, rtol=0, atol=1e-14)
    pin = O1 + S * np.exp(1j * names["phi12"](S))
    assert np.allclose(pin, names["P23"](S), rtol=0, atol=1e-13)
    assert np.allclose(abs(pin - O3), L3, rtol=0, atol=1e-13)


def test_slopes_of_the_frame_in_all_quadrants():
    A, B = apart(places(1), places(2))
    sheet, g = load(hitch.__file__), hitch.Hitch()
    delta1 = sheet.run(["L35"], {"O3": A, "O5": B, "P34": None, "g": g})["delta1"]
    delta2 = sheet.run(["L57"], {"O7": A, "O5": B, "P56": None, "L4": None, "g": g})["delta2"]
    assert np.array_equal(delta1, delta2)
    assert np.allclose(-np.conj(A - B) / abs(A - B), np.exp(1j * delta1), rtol=0, atol=1e-14)


def test_centre_of_mass_in_all_quadrants():
    Z, phi6 = places(1), np.random.default_rng(2).uniform(0.1, 3.1, COUNT)
    points = {"P56": lambda *_: 3 + 4j, "P67": lambda *_: 0j, "phi6": lambda *_: phi6}
    g = replace(hitch.Hitch(), X6=Z.real, Y6=Z.imag, phi_P6=phi6)
    names = load(hitch.__file__).run(["PS6"], {"L4": 1, "L7": 1, "S": 0.5, "S_p": 0.5, "g": g, **points})
    assert np.all((names["phiS6"] >= 0) & (names["phiS6"] <= 2 * math.pi))
    assert np.allclose(names["PS6"](0.5), 3 + 4j + Z, rtol=0, atol=1e-14)


def test_weightless_implement_and_one_position_less(sheet):
    """P6 = 0 is a transport case: no reaction, no pressure, and checks that still hold."""
    empty = hitch.app.run(defs={"g": replace(sheet["g"], P6=0.0, N_pol=2)})[1]
    assert np.all(empty["R01"] == 0) and np.all(empty["Ra"] > 0) and np.all(np.isinf(empty["dGS65"]))
    assert "∞" in empty["table_41"]._mime_()[1]


# The same machine seen from its other side


MIRRORED = {"X01": -0.415, "X03": -0.250, "X05": -0.135, "X07": -0.415, "phi_BD": -22, "X6": -0.857, "phi_P6": 90}
MIRRORED |= {"side_23": "left", "side_45": "right", "side_67": "left", "side_6": "left"}


# turned by the mirror, or measured along the abscissa; what a formula of one quadrant gives is left out
TURNED = ("phi", "psi", "delta", "dphi", "M", "D_", "s_", "X_p", "P23s_S", "R56_x", "R05_x", "R34_x", "R03_x", "R01_x")
TURNED += ("b1", "b2", "b3", "d1", "d2", "d3", "e1", "e2", "e3", "AA", "BB", "DD", "EE")


def test_a_machine_seen_from_its_other_side_has_the_mirrored_results():
    """Every point and force has the other abscissa, every length, ratio and load its own: no formula is edited."""
    sheet = load(hitch.__file__)
    own, other = (sheet.run(sheet.results, {"g": build(sheet.inputs, given)}) for given in ({}, MIRRORED))
    lines = [name for name in registry(own) if isinstance(own[name], np.ndarray | float | complex)]
    assert len(lines) >= 90
    for name in (name for name in lines if not name.startswith(TURNED)):
        a, b = np.asarray(own[name]), np.asarray(other[name])
        mirrored = -a.conj() if a.dtype.kind == "c" else a
        assert np.allclose(b, mirrored, rtol=1e-9, atol=1e-9 * np.max(np.abs(a)) + 1e-10), name
    for name in ("phi12_S", "phi3_S", "phi34_S", "phi4_S", "phi5_S", "phi6_S", "phi7_S"):
        assert np.allclose(np.exp(1j * other[name]), -np.exp(-1j * own[name]), rtol=0, atol=1e-12), name
    for name in ("dphi3", "dphi4", "dphi5", "dphi6", "dphi7"):
        assert np.allclose(other[name], -own[name], rtol=1e-9, atol=1e-9), name
    assert np.allclose(other["X_p"], -own["X_p"], rtol=1e-9)
    assert [check.name for check in checks_of(other) if not check.passed] == []


@pytest.mark.parametrize(
    ("side", "turned", "pin", "outer"),
    [
        ("side_23", "left", lambda x: x["P23"](0.5), lambda x: (x["O1"], x["O3"])),
        ("side_45", "right", lambda x: x["P45"](0.5, 0.66), lambda x: (x["P34"](0.5), x["O5"])),
        ("side_67", "left", lambda x: x["P67"](0.5, 0.75), lambda x: (x["P56"](0.5, x["L4"]), x["O7"])),
    ],
)
def test_the_other_side_of_one_group_is_its_pin_reflected_in_the_line_of_the_outer_pins(side, turned, pin, outer):
    sheet = load(hitch.__file__)
    names = ["O1", "O3", "O5", "O7", "P23", "P34", "P45", "P56", "P67", "L4"]
    want = names[:5] if side == "side_23" else [*names[:7]] if side == "side_45" else names
    own, other = (sheet.run(want, {"g": build(sheet.inputs, given)}) for given in ({}, {side: turned}))
    (A, B), (C, D) = outer(own), outer(other)
    assert (A, B) == (C, D)
    reflected = A + (B - A) * ((pin(own) - A) / (B - A)).conjugate()
    assert abs(pin(other) - reflected) < 1e-14
    assert abs(pin(other) - pin(own)) > 0.1


def test_a_side_that_there_is_not_is_told():
    with pytest.raises(SheetError, match=r"side_45 = 'up' must be one of left, right"):
        build(load(hitch.__file__).inputs, {"side_45": "up"})
