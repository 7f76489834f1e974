"""The slotted link worksheet against the printed table, 50-digit derivatives, and its own limits."""

import re
from dataclasses import replace
from functools import cache
from math import pi
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from as_script import as_script
from conftest import examples
from hypothesis import assume, example, given
from hypothesis import strategies as st
from in_tex import typeset
from printed import agrees, rows
from written_cells import Values

from mechsheet.accuracy import exact
from mechsheet.accuracy.arithmetic import relative_error
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import build
from worksheets import slotted_link

SHEET = Path(__file__).parents[1] / "worksheets" / "slotted_link.py"
PRINTED = rows("slotted_link/table_results.csv")
GIVEN = slotted_link.SlottedLink()
FILE = load(SHEET)


@cache
def run(**changed):
    return FILE.run(FILE.results, {"g": replace(GIVEN, **changed)})


@pytest.fixture(scope="module")
def sheet():
    return slotted_link.app.run(defs={"g": GIVEN})[1]


def failed(sheet) -> list[Check]:
    found = [c for v in sheet.values() if isinstance(v, tuple) for c in v if isinstance(c, Check)]
    assert len(found) >= 15
    return [c for c in found if not c.passed]


# The printed table


def test_printed_table_by_the_closed_form(sheet):
    found = {c.symbol: c.values for c in sheet["table_1"].columns}
    heading = dict(zip(PRINTED[0], found, strict=True))
    assert list(found) == ["phi1k", "phi3k", "SABk", "omegaBCk", "epsBCk", "VCk", "WCk"]
    wrong = [
        (name, i, text, found[heading[name]][i])
        for i, row in enumerate(PRINTED)
        for name, text in row.items()
        if not agrees(found[heading[name]][i], text)
    ]
    assert len(PRINTED) == 7 and wrong == []
    assert {c.decimals for c in sheet["table_1"].columns} == {3}, "as printed"
    assert {c.decimals for c in sheet["table_4"].columns[1:]} == {0}, "positions are counted"


def test_printed_table_by_one_find_from_the_printed_approximations(sheet):
    found = {c.symbol: c.values for c in sheet["table_3"].columns}
    printed = dict(zip(("phi1k", "phi3F", "SABF", "omega3F", "eps3F", "VCF", "WCF"), PRINTED[0], strict=True))
    wrong = [
        (heading, i, row[heading], found[symbol][i])
        for i, row in enumerate(PRINTED)
        for symbol, heading in printed.items()
        if not agrees(found[symbol][i], row[heading])
    ]
    assert wrong == []


def test_only_a_clockwise_crank_gives_the_printed_signs(sheet):
    other = run(omega1=10.0)
    assert np.allclose(other["phi1_k"], 2 * pi + np.arange(7) * pi / 3)
    assert np.allclose(other["omega_BC_k"][::-1], -sheet["omega_BC_k"], rtol=1e-13)
    assert np.allclose(other["VC_k"][::-1], -sheet["VC_k"], rtol=1e-13)
    assert np.allclose(other["WC_k"][::-1], sheet["WC_k"], rtol=1e-12)


def test_functions_are_typeset_by_their_symbols():
    tex = typeset("VC(phi1) - eps_BC(phi1) * rpr(A, B)")
    assert tex == r"V_{\mathrm{C}}(\varphi_{1}) - \varepsilon_{\mathrm{BC}}(\varphi_{1})\,\mathrm{rpr}(A,\ B)"


def test_every_check_passes(sheet):
    assert failed(sheet) == []


# 50 digits: nothing but the position of A, differentiated


def derivatives(g, phi1):
    """phi3, SAB, C and their two time derivatives at one crank angle."""
    with mp.workdps(50):
        L1, L0, L3, w, phi0 = (mp.mpf(float(x)) for x in (g.L1, g.L0, g.L3, g.omega1, phi1))

        def A(t):
            return mp.mpc(0, L0) + L1 * mp.expj(phi0 + w * t)

        u0 = A(0) / abs(A(0))  # angles from here on have no jump nearby

        def phi3(t):
            return mp.arg(A(t) / u0)

        def C(t):
            return L3 * A(t) / abs(A(t))

        return {
            "u": u0,
            "SAB": abs(A(0)),
            "omega_BC": mp.diff(phi3, 0),
            "VAB": mp.diff(lambda t: abs(A(t)), 0),
            "eps_BC": mp.diff(phi3, 0, 2),
            "WAB": mp.diff(lambda t: abs(A(t)), 0, 2),
            "C": C(0),
            "VC": mp.diff(lambda t: C(t).real, 0) + 1j * mp.diff(lambda t: C(t).imag, 0),
            "WC": mp.diff(lambda t: C(t).real, 0, 2) + 1j * mp.diff(lambda t: C(t).imag, 0, 2),
        }


@pytest.mark.parametrize("changed", [{}, {"L1": 5.0}, {"L1": 2.39}, {"L1": 2.41, "omega1": 3.0}, {"L0": 0.0}], ids=str)
def test_every_quantity_to_50_digits(changed):
    """Digits are lost only as the distance AB is small against L0 + L1: once a derivative."""
    made = run(n=4, phi_0=0.1, **changed)  # next to the hinge and opposite, and between
    g = made["g"]
    for phi1 in made["phi1_k"][:-1]:
        true = derivatives(g, phi1)
        kappa = (g.L0 + g.L1) / float(true["SAB"])
        for name, order in {
            "u": 1,
            "SAB": 1,
            "C": 1,
            "omega_BC": 2,
            "VAB": 2,
            "VC": 2,
            "eps_BC": 3,
            "WAB": 3,
            "WC": 3,
        }.items():
            size = max(
                abs(complex(true[name])), abs(g.omega1) ** (order - 1) * (g.L1 if name in ("SAB", "VAB", "WAB") else 1)
            )
            error = abs(complex(made[name](phi1)) - complex(true[name]))
            assert error <= 1e-15 * 10 * kappa**order * size, (name, phi1, error)


# Find and its roots


def test_find_from_another_angle_ends_on_the_other_branch_and_the_results_stay(sheet):
    other = run(phi3_0=-1.5)
    assert np.all(other["F"][1] < 0), "the link points away from the slider at every position"
    assert np.allclose(other["F"][2], sheet["F"][2], rtol=1e-12), "with the same angular velocity"
    assert np.array_equal(other["VC_k"], sheet["VC_k"]) and failed(other) == []
    assert list(other["N_same"]) == list(sheet["N_same"])
    row = np.searchsorted(sheet["phi3_g"], -pi / 2 - 1e-9)
    assert (sheet["N_same"][row], sheet["N_other"][row], sheet["N_none"][row]) == (0, 7, 0)


# The crank's hinge in that of the link, and the slider thought to be there: the equations have no slope.
AT_THE_HINGE = {"L1": 5.0, "L0": 0.0, "n": 4, "SAB_0": 1e-60}


def test_table_of_first_approximations_counts_every_position(sheet):
    assert np.all(sheet["N_same"] + sheet["N_other"] + sheet["N_none"] == 7)
    made = run(**AT_THE_HINGE)
    assert np.any(made["N_none"] > 0) and np.all(made["N_same"] + made["N_other"] + made["N_none"] == 5)


def test_position_that_find_does_not_solve_is_named():
    made = run(**AT_THE_HINGE)
    lost = [c for c in failed(made) if c.name == "Find ends in a root"]
    assert [c.residual for c in lost] == [5] and "at phi1 = 360, 270, 180" in lost[0].reason
    assert "equation 1 leaves" in made["F_found"].failures()[0]


def test_position_thought_far_away_is_found():
    """The first step of Newton's own puts the slider on the hinge."""
    assert failed(run(**{**AT_THE_HINGE, "SAB_0": 1e12}, phi3_0=0.0)) == []


# Strokes


def test_stroke_ratio_of_the_document_to_50_digits(sheet):
    swing = 2 * mp.asin(mp.mpf("0.8") / mp.mpf("2.4"))
    assert abs(sheet["psi"] - swing) < 1e-15
    assert abs(sheet["K"] - (mp.pi + swing) / (mp.pi - swing)) < 1e-14
    assert abs(sheet["H"] - 2 * 3.5 * 0.8 / 2.4) < 1e-14


@pytest.mark.parametrize(("L1", "reversals"), [(0.8, 2), (2.3, 2), (2.5, 0), (5.0, 0)])
def test_link_reverses_twice_a_turn_or_never(L1, reversals):
    made = run(L1=L1)
    omega = made["omega_BC"](np.linspace(-pi, pi, 2000, endpoint=False))
    assert np.count_nonzero(np.sign(omega) != np.sign(np.roll(omega, 1))) == reversals
    if reversals:
        assert np.all(abs(made["omega_BC"](np.array([made["phi_e1"], made["phi_e2"]]))) < 1e-12)
    else:
        assert np.all(omega < 0), "in the crank's sense"
        assert made["psi"] == pytest.approx(pi, abs=1e-15)


@pytest.mark.parametrize("L1", [0.8, 2.39, 2.41, 5.0])
def test_quick_stroke_is_on_the_side_of_the_hinge(L1):
    made = run(L1=L1)
    assert made["K"] > 1
    assert made["omega_BC"](-pi / 2) == pytest.approx(made["omega_near"], rel=1e-10)
    assert made["omega_BC"](pi / 2) == pytest.approx(made["omega_far"], rel=1e-14)


# Where the crank passes the hinge


def test_link_that_goes_round_turns_once_a_turn_without_a_jump():
    made = run(L1=5.0)
    steps = np.diff(made["phi3_t"])
    assert made["phi3_t"][-1] - made["phi3_t"][0] == pytest.approx(-2 * pi, abs=1e-13)
    assert np.all(steps < 0) and np.max(-steps) < 0.04


def test_circle_through_the_hinge_has_no_numbers_there_and_only_there():
    made = run(L1=2.4, n=12)
    lost = np.isclose(np.degrees(made["phi1_k"]), 270)
    assert list(np.isnan(made["SAB_k"])) == list(lost) and lost.sum() == 1
    for name in ("phi3_k", "omega_BC_k", "eps_BC_k", "VAB_k", "WAB_k", "VC_k", "WC_k"):
        assert list(np.isnan(made[name])) == list(lost), name
    assert np.allclose(made["omega_BC_k"][~lost], -5, rtol=1e-13), "half the crank's speed everywhere else"
    assert np.all(abs(made["eps_BC_k"][~lost]) < 1e-11)
    assert [c.reason for c in failed(made)] == ["the slider is at the hinge B at phi1 = 270 deg"]
    assert np.isnan(made["K"]) and made["ends"] == {}
    svg = made["figure_4"]._mime_()[1]
    curve = svg[svg.index('stroke="#3b82d0"') :].split('d="', 1)[1].split('"', 1)[0]
    assert [piece.count("L") + 1 for piece in curve.split("M")[1:]] == [90, 270], "a gap in the curve at one degree"
    assert made["scheme"](-pi / 2).svg().startswith("<svg"), "the position itself can be drawn"


def test_circle_through_the_hinge_between_the_positions_of_the_tables_is_no_failure():
    assert failed(run(L1=2.4)) == []


@pytest.fixture(scope="module")
def checking(sheet):
    """Names of the checks: only what they need is run."""
    return [name for name, v in sheet.items() if isinstance(v, tuple) and any(isinstance(c, Check) for c in v)]


@examples(12)
@given(
    L1=st.floats(0.05, 20),
    L0=st.floats(0, 20),
    omega1=st.floats(-1e3, 1e3),
    n=st.integers(2, 8),
    phi_0=st.floats(-7, 7),
)
@example(L1=0.25, L0=0.0, omega1=0.0, n=4, phi_0=1.5)
def test_checks_hold_for_any_dimensions(checking, L1, L0, omega1, n, phi_0):
    """The document's Newton may end in no root: then, and only then, what it found may fail its checks."""
    assume(abs(L1 - L0) > 1e-4 * L1)
    lost = failed(FILE.run(checking, {"g": replace(GIVEN, L1=L1, L0=L0, omega1=omega1, n=n, phi_0=phi_0)}))
    if any(c.name == "Find ends in a root" for c in lost):
        lost = [c for c in lost if not c.name.startswith(("Find ", "residual of Find"))]
    assert [str(c) for c in lost] == []


# The script


RESULTS = "1 Results (table of page 39)"


def test_its_workbook_has_the_printed_table_and_a_full_turn():
    """The one in exports, which is compared with what the script writes today."""
    book = Values(SHEET.parents[1] / "exports" / "slotted_link.xlsx")
    (first,) = book[RESULTS].iter_rows(6, 6, values_only=True)
    assert first[:3] == pytest.approx([300, 76.8132, 1.75342], rel=1e-5)
    assert book["5 Full turn"].max_row == 4 + 361


def test_bad_input_is_one_line_and_writes_nothing(tmp_path):
    done = as_script(SHEET, "--omega1=fast", f"--out={tmp_path}")
    message = "error: angular velocity of the crank, negative clockwise omega1 = 'fast' rad/s is no number\n"
    assert (done.returncode, done.stderr, list(tmp_path.iterdir())) == (2, message, [])


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("L1", "0", "crank L1 = 0.0 m must be positive"),
        ("L3", "-1", "link 3 from its hinge B to the point C L3 = -1.0 m must be positive"),
        ("L0", "-1", "crank's hinge O1 above the link's hinge B L0 = -1.0 m must be >= 0 m"),
        ("n", "1", "steps of a full turn n = 1 must be >= 2"),
        ("SAB_0", "0", "slider's distance from B along the link SAB_0 = 0.0 m must be positive"),
    ],
)
def test_input_outside_its_limits_is_named(name, value, message):
    with pytest.raises(SheetError, match=f"^{re.escape(message)}$"):
        build(slotted_link.SlottedLink, {name: value})


def test_position_without_numbers_fails_the_script_and_is_written(tmp_path):
    done = as_script(SHEET, "--L1=2.4", "--n=12", f"--out={tmp_path}")
    assert done.returncode == 1 and done.stderr == ""
    assert (
        "FAIL  the link has a direction: 1 <= 0 positions; the slider is at the hinge B at phi1 = 270 deg"
        in done.stdout
    )
    (values,) = Values(tmp_path / "slotted_link.xlsx")[RESULTS].iter_rows(8, 8, values_only=True)
    assert values[0] == pytest.approx(270) and values[1:7] == ("#N/A",) * 6


# Digits


@pytest.mark.parametrize("L1", [0.8, 1e-3, 1e-6, 1e-12])
def test_a_short_crank_far_from_the_hinge_keeps_the_digits_of_its_velocity(L1):
    """The velocity of its pin comes from the crank, not from two points far from the origin."""
    sheet = run(L1=L1)
    for i, phi1 in enumerate(sheet["phi1_k"]):
        true = exact.slotted_link(replace(GIVEN, L1=L1), phi1)
        for name in ("SAB_k", "omega_BC_k", "eps_BC_k", "VC_k", "WC_k"):
            assert relative_error(sheet[name][i], true[name]) <= 64 * 2.0**-53, (name, i)
