"""The hitch worksheet against the printed document, section by section."""

import math
from dataclasses import replace
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from printed import agrees, rows

from mechsheet import units
from mechsheet.checks import Check
from mechsheet.table import Table
from worksheets import hitch

TABLES = sorted(p.name for p in (Path(__file__).parent / "reference" / "hitch").glob("table_*.csv"))


@pytest.fixture(scope="module")
def sheet():
    return hitch.app.run()[1]


def columns(sheet) -> dict[str, np.ndarray]:
    return {c.symbol: c.values for table in sheet.values() if isinstance(table, Table) for c in table.columns}


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


def test_right_load_keeps_a_fifth_on_the_front_axle_and_the_printed_one_does_not(sheet):
    g, x = sheet["g"], sheet["PS6_S"].real

    def share(P):
        return (g.P_gr * (g.a + g.L) + g.P_msha * g.b - P * x) / g.L / (P + g.P_msha + g.P_gr)

    assert np.allclose(share(sheet["GS6_lim"]), 0.2, rtol=0, atol=1e-15)
    assert np.all(share(sheet["GS6_max"]) < 0.1)
    assert (round(min(sheet["GS6_lim"])), round(max(sheet["GS6_lim"]))) == (31075, 34679), "the figures of the errata"
    assert np.any(sheet["GS6_lim"] < sheet["GS6"]), "stability and not hydraulics limits the load at some positions"


# The whole chain at 50 digits, by other formulas: angles by the law of cosines, forces by one dense system


def reference(g, S, L4=None, L7=None):
    """Reactions [N] and transmission numbers at one stroke, as a dict of mpmath numbers."""
    with mp.workdps(50):
        O1, O3, O5, O7 = (mp.mpc(getattr(g, f"X0{k}"), getattr(g, f"Y0{k}")) for k in (1, 3, 5, 7))

        def pin(A, B, a, b, side):
            d = B - A
            cosine = (a**2 + abs(d) ** 2 - b**2) / (2 * a * abs(d))
            return A + a * d / abs(d) * mp.expj(side * mp.acos(cosine))

        def p34(S):
            return O3 + (pin(O1, O3, S, g.L3, -1) - O3) / g.L3 * g.L34 * mp.expj(mp.mpf(g.phi_BD))

        def p56(S, L4):
            return O5 + (pin(p34(S), O5, L4, g.L5, +1) - O5) / g.L5 * g.L56

        def p67(S, L4, L7):
            return pin(p56(S, L4), O7, g.L6, L7, -1)

        L4 = L4 or mp.findroot(lambda x: p56(g.S_min, x).imag - g.Y56_min, 0.66)
        S_p = mp.findroot(lambda s: p56(s, L4).imag - g.Y_P56, 0.47)
        turn = mp.expj(mp.mpf(g.phi_P6))
        L7 = L7 or mp.findroot(lambda x: ((p67(S_p, L4, x) - p56(S_p, L4)) / turn).imag, 0.75)
        arm = (g.X6 + 1j * mp.mpf(g.Y6)) / ((p67(S_p, L4, L7) - p56(S_p, L4)) / g.L6)

        def s6(S):
            return p56(S, L4) + arm * (p67(S, L4, L7) - p56(S, L4)) / g.L6

        S = S_p if S is None else mp.mpf(S)
        P23, P34, P45 = pin(O1, O3, S, g.L3, -1), p34(S), pin(p34(S), O5, L4, g.L5, +1)
        P56, P67, S6 = p56(S, L4), p67(S, L4, L7), s6(S)
        # unknown pairs (x, y): R01 on 2, R03 on 3, R05 on 5, R07 on 7, R23 on 3, R34 on 4, R45 on 5, R56 on 6, R67 on 7
        pins = [
            (O1, None, 2),
            (O3, None, 3),
            (O5, None, 5),
            (O7, None, 7),
            (P23, 2, 3),
            (P34, 3, 4),
            (P45, 4, 5),
            (P56, 5, 6),
            (P67, 6, 7),
        ]
        A, rhs = mp.zeros(18, 18), mp.zeros(18, 1)
        for body in range(2, 8):
            row = 3 * (body - 2)
            for k, (P, giver, taker) in enumerate(pins):
                sign = (body == taker) - (body == giver)
                A[row, 2 * k] = A[row + 1, 2 * k + 1] = sign
                A[row + 2, 2 * k], A[row + 2, 2 * k + 1] = -sign * P.imag, sign * P.real
        rhs[3 * 4 + 1], rhs[3 * 4 + 2] = g.P6, g.P6 * S6.real
        x = mp.lu_solve(A, rhs)
        R01, R03, R05, R07, R23, R34, R45, R56, R67 = (mp.mpc(x[2 * k], x[2 * k + 1]) for k in range(9))
        return {
            "R01": R01, "R03": R03, "R05": -R05, "R07": R07, "R23": R23, "R34": -R34, "R45": -R45,
            "R56": R56, "R67": R67,
            "I56": mp.diff(lambda s: p56(s, L4).imag, S), "IS6": mp.diff(lambda s: s6(s).imag, S),
            "P56_S": P56, "P67_S": P67, "PS6_S": S6, "P45_S": P45,
        }  # fmt: skip


def agrees_with_reference(sheet, row, limit):
    true = reference(sheet["g"], sheet["S"][row])
    scale = float(max(abs(true[k]) for k in true if k.startswith("R")))
    for name, value in true.items():
        error = abs(complex(sheet[name][row]) - complex(value)) / (scale if name[0] == "R" else 1)
        assert error < limit, (name, row, error)


@pytest.mark.parametrize("row", range(10))
def test_every_position_to_50_digits(sheet, row):
    agrees_with_reference(sheet, row, 1e-13)


def test_mast_upright_where_the_printed_formulas_divide_by_zero(sheet):
    """At S_p the mast is upright, d1 = X67 - X56 vanishes and the printed R56y is lost."""
    upright = hitch.app.run(defs={"g": replace(sheet["g"], S_max=sheet["S_p"])})[1]
    assert abs((upright["P67_S"] - upright["P56_S"])[-1].real) < 1e-15
    agrees_with_reference(upright, -1, 1e-10)


def test_cylinder_upright_where_the_printed_formulas_divide_by_zero(sheet):
    """X23 = X01 at S near 0.43597, where b3 vanishes and the printed R01y is lost."""
    S0 = abs(sheet["O3"].imag - sheet["O1"].imag + 1j * 0) - math.sqrt(0.2**2 - (0.415 - 0.25) ** 2)
    assert 0.4359 < S0 < 0.4360
    upright = hitch.app.run(defs={"g": replace(sheet["g"], S_min=S0)})[1]
    assert abs(upright["P23_S"][0].real - 0.415) < 1e-15
    agrees_with_reference(upright, 0, 1e-10)


# Angles in all quadrants


places = st.complex_numbers(min_magnitude=0.05, max_magnitude=2, allow_nan=False)


@given(places, places, st.floats(0.4, 2))
def test_first_group_angles_in_all_quadrants(O1, O3, part):
    assume(abs(O1 - O3) > 0.1)
    g = replace(hitch.Hitch(), X01=O1.real, Y01=O1.imag, X03=O3.real, Y03=O3.imag, L3=part * abs(O1 - O3))
    names = hitch.group_1.run(O1=O1, O3=O3, g=g)[1]
    L13, S = abs(O1 - O3), g.L3 + 0.3 * abs(O1 - O3)
    assert np.isclose(L13 * np.exp(1j * names["phi13"]), np.conj(O1 - O3), rtol=0, atol=1e-14 * L13)
    pin = O1 + S * np.exp(1j * names["phi12"](S))
    assert np.isclose(pin, names["P23"](S), rtol=0, atol=1e-13)
    assert np.isclose(abs(pin - O3), g.L3, rtol=0, atol=1e-13)


@given(places, places)
def test_slopes_of_the_frame_in_all_quadrants(A, B):
    assume(abs(A - B) > 0.1)
    delta1 = hitch.group_2.run(O3=A, O5=B, P34=None, g=hitch.Hitch())[1]["delta1"]
    delta2 = hitch.group_3.run(O7=A, O5=B, P56=None, L4=None, g=hitch.Hitch())[1]["delta2"]
    assert delta1 == delta2
    assert np.isclose(-np.conj(A - B), abs(A - B) * np.exp(1j * delta1), rtol=0, atol=1e-14)


@given(places, st.floats(-3.1, 3.1))
def test_centre_of_mass_in_all_quadrants(Z, phi6):
    g = replace(hitch.Hitch(), X6=Z.real, Y6=Z.imag)
    names = hitch.centre_of_mass.run(
        L4=1, L7=1, P56=lambda *_: 3 + 4j, P67=lambda *_: 0j, S_p=0.5, g=g, phi6=lambda *_: phi6
    )[1]
    assert 0 <= names["phiS6"] <= 2 * math.pi
    assert np.isclose(names["PS6"](0.5), 3 + 4j + Z, rtol=0, atol=1e-14)


def test_weightless_implement_and_one_position_less(sheet):
    """P6 = 0 is a transport case: no reaction, no pressure, and checks that still hold."""
    empty = hitch.app.run(defs={"g": replace(sheet["g"], P6=0.0, N_pol=2)})[1]
    assert np.all(empty["R01"] == 0) and np.all(empty["Ra"] > 0) and np.all(np.isinf(empty["dGS65"]))
    assert "∞" in empty["table_41"]._mime_()[1]
