"""The kinetostatics worksheet against one dense system at 50 digits: the document prints no numbers."""

import re
from dataclasses import replace
from itertools import chain
from pathlib import Path
from types import SimpleNamespace

import mpmath as mp
import numpy as np
import pytest
from as_script import as_script
from conftest import examples
from hypothesis import Phase, given
from hypothesis import strategies as st
from printed import agrees, rows

from mechsheet import cross as cross_of
from mechsheet.accuracy import arithmetic as exact
from mechsheet.accuracy.arithmetic import cross, mpc, mpf
from mechsheet.recording.evaluation import evaluate
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load as load_sheet
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import Formula, formulas
from mechsheet.worksheet.source import cells
from mechsheet.worksheet.table import Table
from worksheets import kinetostatics

SHEET = Path(kinetostatics.__file__)
CELLS = load_sheet(SHEET)
REQUIREMENT = "the piston stays in its cylinder"  # a demand on the design, which a random one need not meet


def run(g, want=CELLS.results):
    return CELLS.run(want, {"g": g})


@pytest.fixture(scope="module")
def sheet():
    return kinetostatics.app.run()[1]


def checks(sheet) -> list[Check]:
    return [c for value in sheet.values() if isinstance(value, tuple) for c in value if isinstance(c, Check)]


def test_every_check_passes(sheet):
    assert len(checks(sheet)) >= 28
    assert [str(c) for c in checks(sheet) if not c.passed] == []


def test_every_formula_of_the_document_has_a_line():
    lines = (line for cell in cells({"__file__": str(SHEET)}) for line in formulas(cell))
    found = set[int]()
    for part in (
        part for line in lines if isinstance(line, Formula) and line.number for part in line.number.split(",")
    ):
        ends = [int(n) for n in re.findall(r"\(1\.(\d+)\)", part)]
        found |= set(range(ends[0], ends[-1] + 1))
    assert found == set(range(1, 60))


# The mechanism at 50 digits: positions from the loops, accelerations by differencing them in time, all reactions at
# once from 21 equations of equilibrium


class Reference:
    """Reactions, loads and drives of the mechanism at one position of the crank, as exact numbers."""

    def __init__(self, g, phi1: float):
        x = {name: mpf(value) for name, value in vars(g).items()}
        O1, C, H = mpc(0), mpc(x["X_C"], x["Y_C"]), mpc(x["X_H"], x["Y_H"])
        O5, u5 = mpc(x["X05"], x["Y05"]), mp.expj(x["phi05"])

        # points and links over the crank's angle
        def A(phi):
            return x["l1"] * mp.expj(phi)

        def B(phi):
            return exact.rrr(A(phi), C, x["l2"], x["l3"], +1)

        def on_rocker(length, turn):
            return lambda phi: C + (B(phi) - C) / x["l3"] * length * mp.expj(turn)

        D, K = on_rocker(x["l_CD"], x["delta_D"]), on_rocker(x["l_CK"], x["delta_K"])

        def E(phi):
            return exact.rrp(D(phi), O5, u5, x["l4"], +1, mpf(0))

        def between(P, Q, length):  # the point of the link PQ at a distance from P
            return lambda phi: P(phi) + length * (Q(phi) - P(phi)) / abs(Q(phi) - P(phi))

        links = [  # centre of mass, direction of the link
            (lambda phi: A(phi) / x["l1"] * x["l_O1S1"], A),
            (between(B, A, x["l_BS2"]), lambda phi: B(phi) - A(phi)),
            (between(B, lambda _: C, x["l_BS3"]), lambda phi: B(phi) - C),
            (between(E, D, x["l_ES4"]), lambda phi: E(phi) - D(phi)),
            (E, lambda _: u5),
            (between(K, lambda _: H, x["l_KS6"]), lambda phi: K(phi) - H),
            (between(lambda _: H, K, x["l_HS7"]), lambda phi: K(phi) - H),
        ]
        inertias = [x.get(name, mpf(0)) for name in ("J1", "J2", "J3", "J4", "J5", "J6", "J7")]
        here = mpf(float(phi1))

        def in_time(f):
            return lambda t: f(here + x["n1"] * t + x["eps1"] * t**2 / 2)

        self.loads = []
        for body, ((S, direction), J) in enumerate(zip(links, inertias, strict=True)):
            m, (_, a_S) = x[f"m{body + 1}"], exact.derivatives(in_time(S))
            epsilon = exact.rotation(in_time(direction))[1]
            self.loads.append((body, -m * a_S - mpc(0, m * x["g_n"]), S(here), -J * epsilon))
        forwards = (exact.derivatives(lambda turn: E(here + turn))[0] / u5).real * (-1 if x["n1"] < 0 else 1)
        A, B, D, E, K = (point(here) for point in (A, B, D, E, K))
        e7 = (K - H) / abs(K - H)
        gas = x["p_g"] * mp.pi * x["D_g"] ** 2 / 4 * e7
        applied = [(5, gas, K, mpf(0)), (6, -gas, H, mpf(0))]
        if forwards > 0:
            applied.append((4, -x["Q5"] * u5, E, mpf(0)))
        pins = [(O1, 0), (A, 1, 0), (B, 2, 1), (C, 2), (D, 3, 2), (E, 4, 3), (K, 5, 2), (H, 6)]
        unknowns = [
            [(0, mpc(0), O1, mpf(1))],
            *chain.from_iterable(exact.pin(*pin) for pin in pins),
            *exact.slide(E, u5, 4),
            *exact.slide(K, e7, 5, 6),
        ]
        found = exact.reactions(unknowns, self.loads + applied, [A, A, B, D, E, K, K])
        names = ("R_1c", "R_A", "R_B", "R_C", "R_D", "R_E", "R_K", "R_H")
        self.M_c = found[0]
        self.vectors = {name: mpc(found[2 * i + 1], found[2 * i + 2]) for i, name in enumerate(names)}
        self.vectors |= {"R_05": mpc(0, 1) * u5 * found[17], "R_76": mpc(0, 1) * e7 * found[19]}
        self.h76 = -found[20] / found[19]  # along the axis from K to H
        F_y = -self.M_c / x["l_O1P"]
        self.vectors["F_w"] = mpc(abs(F_y) * mp.tan(x["alpha_w"]), F_y)
        self.vectors["R_1g"] = self.vectors["R_1c"] - self.vectors["F_w"]
        self.largest = max(abs(R) for R in self.vectors.values())
        self.size = max(abs(p - q) for p, q in ((A, O1), (A, B), (B, C), (D, E), (H, K)))
        self.K, self.H = K, H


SAID = {  # what the document's formulas give as magnitude and angle
    "R_A": ("R12", "gamma12"), "R_B": ("R23", "gamma23"), "R_C": ("R03", "gamma03"), "R_D": ("R34", "gamma34"),
    "R_E": ("R45", "gamma45"), "R_05": ("R05", "gamma05"), "R_K": ("R36", "gamma36"), "R_H": ("R07", "gamma07"),
    "R_76": ("R76", "gamma76"), "R_1c": ("R_O1c", "gamma_O1c"), "R_1g": ("R_O1g", "gamma_O1g"),
}  # fmt: skip


def disagreement(sheet, row: int) -> dict[str, float]:
    """Errors at one position over the largest force, in units of rounding times condition squared."""
    true = Reference(sheet["g"], sheet["phi1"][row])
    unit = 2.0**-53 * max(sheet["kappa"]) ** 2 * float(true.largest)

    def off(value, exactly) -> float:
        return float(abs(mp.mpmathify(complex(value)) - exactly)) / unit

    errors = {name: off(sheet[name][row], R) for name, R in true.vectors.items()}
    for name, (size, angle) in SAID.items():
        turn = np.broadcast_to(sheet[angle], sheet["phi1"].shape)[row]
        errors[size] = off(sheet[size][row] * np.exp(1j * turn), true.vectors[name])
    errors["F_b"] = off(abs(sheet["F_b"][row]), abs(true.vectors["F_w"]))
    errors["M_b"] = off(sheet["M_b"][row], true.M_c) / float(true.size)
    moment = sheet["R76"][row] * sheet["h76"][row]
    errors["h76"] = off(moment, true.h76 * exact.dot(true.vectors["R_76"], side(true))) / float(true.size)
    return errors


def side(true: Reference) -> mpc:
    """Direction to the left of the line from K to H."""
    return mpc(0, 1) * (true.H - true.K) / abs(true.H - true.K)


@pytest.mark.parametrize("row", [0, 19, 20, 90, 137, 203, 205, 270, 360])
def test_every_reaction_to_50_digits(sheet, row):
    """Rows 19, 20 and 203, 205 stand on both sides of the working stroke's ends."""
    errors = disagreement(sheet, row)
    assert {name: error for name, error in errors.items() if not error < 16} == {}


@pytest.mark.parametrize("row", [33, 250])
def test_turning_clockwise_and_speeding_up(sheet, row):
    other = run(replace(sheet["g"], n1=-25.0, eps1=60.0))
    assert [str(c) for c in checks(other) if not c.passed] == []
    assert {name: error for name, error in disagreement(other, row).items() if not error < 16} == {}


numbers = st.floats(0.5, 2)


@examples(4, phases=[Phase.explicit, Phase.generate])
@given(
    st.lists(numbers, min_size=13, max_size=13),
    st.floats(-0.3, 0.3),
    st.floats(-60, 60),
    st.floats(-200, 200),
    st.floats(0, 1.2),
    st.integers(0, 360),
)
def test_other_machines_pass_every_check(sheet, factors, tilt, n1, eps1, alpha_w, row):
    g = sheet["g"]
    names = ("m1", "m2", "m3", "m4", "m5", "m6", "m7", "J2", "J3", "J4", "J7", "Q5", "p_g")
    changed = {name: getattr(g, name) * factor for name, factor in zip(names, factors, strict=True)}
    other = run(
        replace(g, **changed, phi05=g.phi05 + tilt, n1=n1, eps1=eps1, alpha_w=alpha_w, delta_K=g.delta_K + tilt)
    )
    assert [str(c) for c in checks(other) if not c.passed and c.name != REQUIREMENT] == []
    assert {name: error for name, error in disagreement(other, row).items() if not error < 16} == {}


def test_machine_without_loads(sheet):
    """No force has a direction then, and the arm h76 does not exist."""
    g = sheet["g"]
    idle = run(replace(g, **{name: 0.0 for name in ("m1", "m2", "m3", "m4", "m5", "m6", "m7", "Q5", "p_g")}, g_n=0.0))
    light = run(replace(g, **{name: 0.0 for name in vars(g) if name[0] in "mJ"}, Q5=0.0, p_g=0.0))
    assert np.all(light["R12"] == 0) and np.all(light["M_b"] == 0) and np.all(np.isnan(light["h76"]))
    assert np.max(np.abs(idle["M_b"])) > 1, "the moments of inertia are left"
    for other in (idle, light):
        assert [str(c) for c in checks(other) if not c.passed] == []


def test_turn_without_resistance_takes_no_work(sheet):
    """Weights, gas and inertia give back in a turn what they took; the sum over a smooth period is exact."""
    g = sheet["g"]
    free = run(replace(g, Q5=0.0))
    assert abs(free["W_b"]) < 1e-12 * 2 * np.pi * np.max(np.abs(free["M_b"]))
    assert np.max(np.abs(free["M_b"])) > 10


def test_variants_are_the_single_machines(sheet):
    g = sheet["g"]
    want = ["R12", "gamma12", "M_b", "R_O1g", "h76", "dense"]
    values = {"l2": (0.42, 0.43), "Q5": (0.0, 4500.0), "n1": (-20.0, 30.0)}
    together = run(replace(g, **{name: np.array(v)[:, None] for name, v in values.items()}), want)
    for i in range(2):
        alone = run(replace(g, **{name: v[i] for name, v in values.items()}), want)
        for name in want:
            assert np.allclose(together[name][i], alone[name], rtol=1e-13, atol=1e-10), name


# The document's formulas and its errata


def test_angles_by_the_documents_cases(sheet):
    """(1.13) to (1.16), (1.28), (1.39): arctangent of a quotient and cases; the same directions."""
    s = sheet
    for link, pair in (("phi2", "12"), ("phi3", "03"), ("phi4", "34"), ("phi6", "36")):
        n, t = s[f"R{pair}_n"], s[f"R{pair}_t"]
        printed = s[link] + np.where(n >= 0, 0, np.pi) + np.arctan(t / n)
        assert np.allclose(np.exp(1j * printed), np.exp(1j * s[f"gamma{pair}"]), rtol=0, atol=1e-14)
    assert np.any(s["R12_n"] > 0) and np.any(s["R12_n"] < 0), "both cases occur"


def left_at_H(sheet, R36_t) -> np.ndarray:
    """Moments about H of all loads on the group (6, 7) and of a force across the rod at K."""
    s = sheet
    arms = ((s["S6"] - s["H"], s["F6_sum"]), (s["S7"] - s["H"], s["F7_sum"]))
    R = R36_t * np.exp(1j * s["gamma36_t"])
    moments = [(np.conj(arm) * force).imag for arm, force in (*arms, (s["K"] - s["H"], R))]
    return sum(moments) + s["M6"] + s["M7"]


def test_1_35_as_printed_leaves_a_moment(sheet):
    scale = sheet["l_HK"] * sheet["R36"]
    assert np.max(np.abs(left_at_H(sheet, sheet["R36_t"]) / scale)) < 1e-13
    assert np.max(np.abs(left_at_H(sheet, sheet["R36_t_printed"]) / scale)) > 1e-3


def test_1_34_as_printed_is_no_lever(sheet):
    """The force is square to EA: the determinant over both lengths is -1 for every angle."""
    assert np.allclose(sheet["d_134"], -1, rtol=0, atol=1e-15)
    assert np.min(np.abs(sheet["d_134_printed"] + 1)) > 0.1


def test_printed_lines_after_1_26_and_1_37_do_not_balance(sheet):
    for pair in ("45", "67"):
        assert np.max(np.abs(sheet[f"r_{pair}"])) < 1e-12 * np.max(sheet["R34"])
        assert np.min(np.abs(sheet[f"r_{pair}_printed"])) > 50
    s = sheet
    x = s["R34_n_printed"] * np.cos(s["phi4"]) - s["R05_printed"] * np.sin(s["g"].phi05) + s["A_45"]
    y = s["R34_n_printed"] * np.sin(s["phi4"]) - s["R05_printed"] * np.cos(s["g"].phi05) + s["B_45"]
    assert max(np.max(np.abs(x)), np.max(np.abs(y))) < 1e-12 * np.max(s["R34"]), "it solves the printed system"
    assert np.min(np.abs(s["R05_printed"] - s["R05"])) > 50


def test_1_56_as_printed_drives_the_wrong_way(sheet):
    true = Reference(sheet["g"], sheet["phi1"][90])
    assert sheet["M_b"][90] == pytest.approx(float(true.M_c), rel=1e-13)
    assert sheet["M_b_printed"][90] == -sheet["M_b"][90] < 0


def test_reactions_of_the_later_groups_keep_their_moments_on_the_rocker(sheet):
    """The forces of the later groups act at D and K, not at S3: their moments are in M3."""
    true, s, k = Reference(sheet["g"], sheet["phi1"][60]), sheet, 60
    moments = [cross(mpc(s[P][k] - s["S3"][k]), -true.vectors[R]) for P, R in (("D", "R_D"), ("K", "R_K"))]
    assert s["M3"][k] == pytest.approx(float(sum(moments) + true.loads[2][3]), rel=1e-12)


def test_tables_list_the_positions_step_by_step(sheet):
    coarse = run(replace(sheet["g"], step=30))
    assert [str(c) for c in checks(coarse) if not c.passed] == []
    tables = [table for table in coarse.values() if isinstance(table, Table)]
    listed = {table.number for table in tables if table.columns[0].values.tolist() == pytest.approx(range(0, 361, 30))}
    assert listed >= {"2.1", "3.1", "3.3", "8.1", "8.3", "8.4", "8.5"}, "the workbook of the script has these rows"


# As a script


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"l2": -0.42}, "rod AB l2 = -0.42 m must be positive"),
        ({"l2": 0.2}, "group (2, 3) closes: no position closes for distance A C = 0.48102"),
        ({"phi05": 80}, "group (4, 5) closes: no position closes for rod l4 = 0.45 m"),
        ({"l1": 0.28, "l2": 0.45, "Y_C": 0}, "no position is a dead centre: first at phi1 = 0 deg"),
    ],
    ids=["length", "does not turn round", "out of the guide's reach", "parallelogram"],
)
def test_bad_input_is_told_in_one_line(given, message):
    with pytest.raises(SheetError) as told:
        CELLS.close({"g": inputs.build(CELLS.inputs, given)})
    assert str(told.value).startswith(message) and "\n" not in str(told.value)


def test_what_does_not_turn_round_writes_nothing(tmp_path):
    done = as_script(SHEET, "--l2=0.2", f"--out={tmp_path}")
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert done.stderr.startswith("error: group (2, 3) closes: no position closes for distance A C = 0.48102")
    assert list(tmp_path.iterdir()) == []


def test_piston_out_of_its_cylinder_is_no_success():
    done = as_script(SHEET, "--l6=0.2", f"--want={REQUIREMENT}")
    assert done.returncode == 1
    assert "FAIL  the piston stays in its cylinder: 0.021289" in done.stdout


# The document's formulas (1.3)-(1.21) on another machine: the hitch, whose document prints its reactions


def first_kind(A, B, C, load, moment) -> dict:
    """What the cell of program SR1 gives for links A-B and C-B, a load at B and a moment on the first of them."""
    cell = next(cell for cell in CELLS.cells if cell.name == "kind_1")
    none = np.zeros_like(A, float)
    g = SimpleNamespace(l2=abs(B - A), l3=abs(B - C), l_BS2=0.0, l_BS3=0.0)
    names = dict.fromkeys(cell.needs, none) | {"g": g, "G2": load, "M_in2": moment}
    names |= {"phi2": np.angle(B - A), "phi3": np.angle(B - C)}
    exec(cell.code, names := {**CELLS.common, **names, "typeset": lambda *_: None})
    return names


def test_program_SR1_gives_the_printed_reactions_of_the_hitch():
    """Groups (6, 7), (4, 5) and (2, 3) from the implement to the cylinder, to half a unit of the last printed digit."""
    pins = ["P23_S", "P34_S", "P45_S", "P56_S", "P67_S", "PS6_S", "O1", "O3", "O5", "O7"]
    h = {name: np.broadcast_to(P, 10) for name, P in evaluate(SHEET.with_name("hitch.py"), want=pins).items()}
    found, load, at = {}, np.full(10, -27500j), h["PS6_S"]
    groups = (  # the reactions on the loaded link and on the other one, the pins there, the inner pin, what goes on
        (("R56", "P56_S"), ("R07", "O7"), "P67_S", "R56"),
        (("R05", "O5"), ("R34", "P34_S"), "P45_S", "R34"),
        (("R03", "O3"), ("R01", "O1"), "P23_S", "R03"),
    )
    for (on_loaded, A), (on_other, C), B, on in groups:
        own = first_kind(h[A], h[B], h[C], load, cross_of(at - h[B], load))
        found[on_loaded] = own["R12"] * np.exp(1j * own["gamma12"])
        found[on_other] = own["R03"] * np.exp(1j * own["gamma03"])
        load, at = -found[on], h[A] if on == on_loaded else h[C]
    found |= {name: -found[name] for name in ("R05", "R34")}  # as the hitch's document counts them
    parts = {f"{name}{axis}": part for name, R in found.items() for axis, part in (("x", R.real), ("y", R.imag))}
    compared = [
        (heading, row["S"], text, parts[heading][i])
        for table in "abcde"
        for i, row in enumerate(rows(f"hitch/table_5.1{table}_reactions.csv"))
        for heading, text in row.items()
        if heading in parts
    ]
    assert len(compared) == 120
    assert [number for number in compared if not agrees(number[3], number[2])] == []
