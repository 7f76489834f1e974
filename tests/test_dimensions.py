"""Dimensions by the recording: mistakes by their lines and parts, and nothing told of what is right."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from functools import cache
from io import BytesIO
from pathlib import Path

import pytest
from openpyxl import load_workbook
from own_worksheet import own

from mechsheet.quantities.node import LEAVES
from mechsheet.quantities.operations import ELEMENTWISE
from mechsheet.recording.dimension_rules import RULES
from mechsheet.recording.dimensions import Dimensions, mismatches, of_every_line
from mechsheet.run import report
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.lines import registry

WORKSHEETS = Path(__file__).parents[1] / "worksheets"
DOCUMENTS = ("hitch", "joint", "kinetostatics", "landing_gear", "slotted_link", "bucket", "engine", "bolted_joint")

HEAD = """\
import marimo
app = marimo.App()
with app.setup:
    import numpy as np
    from math import hypot
    from numpy import abs, arange, atan2, cos, exp, interp, linspace, log, pi, sin, sqrt, where
    from mechsheet import angle, check, cross, find, inputs, minerr, table
    from mechsheet import units
    from mechsheet.units import MPa, N, cm, celsius, define, deg, degC, kN, kg, m, mm
    from mechsheet.units import s as second
    STRENGTH = 640 * MPa
    SIZES = {"M8": 8 * mm, "M10": 10 * mm}
    LEAST = min(SIZES.values())
    G_N = 9.80665  # [m/s**2] gravity
    WIRES = np.array([0.002, 0.004])  # [mm] diameters
    SHARE = 0.5  # of the load, no unit
@app.class_definition
@inputs
class Bar:
    F: float = 500.0  # [N] force
    M: float = 30.0  # [kN*m] moment
    L: float = 2.0  # [m] length
    D: float = 0.03  # [mm] diameter
    S: float = 200e6  # [MPa] stress
    V: float = 0.5  # [m**3] volume
    t: float = 3.0  # [s] time
    phi: float = 0.4  # [deg] angle
    n: int = 3  # [-] number
    W: float = 2.0  # [kg] mass
    "end"
@app.cell
def cell(g):
"""
FIRST = HEAD.count("\n") + 1


@pytest.fixture
def told(tmp_path: Path) -> Callable[..., Dimensions]:
    """What is told of a worksheet with these lines in a cell."""

    def of(*lines: str) -> Dimensions:
        path = tmp_path / "bar.py"
        path.write_text(HEAD + textwrap.indent("\n".join([*lines, "return"]), "    "), encoding="utf-8")
        sheet = load(path)
        names = sheet.run(sheet.results, {"g": sheet.inputs()})
        return of_every_line(sheet, names, registry(names))

    return of


RIGHT = {
    "root of a square": ["x = sqrt(g.L**2)  # [m] x"],
    "powers of a half": ["x = g.V**0.5 * g.L**1.5  # [m**3] x"],
    "third of a volume": ["x = g.V ** (1 / 3)  # [mm] x", "y = np.cbrt(g.V)  # [mm] y"],
    "0 where nothing is": ["x = where(g.F > 0, g.F, 0)  # [N] x", "y = max(g.F, 0) - max(0, -g.F)  # [N] y"],
    "no number where nothing is": ["x = where(g.F > 0, g.F, np.nan) + np.inf  # [N] x"],
    "what nothing makes": [  # an export ended in an IndexError
        "P = np.array([0, g.F, 2 * g.F])",
        "over = P[P > 1e6 * g.F]",
        "x = (over * np.arange(1.0, len(over) + 1)).sum() + g.F  # [N] x",
        "y = np.concatenate([over, over]).prod()  # [-] y",
        "z = np.outer(over, P).sum() + g.F**2  # [N**2] z",
    ],
    "vector of unlike elements": [
        "A = np.array([[1, 0, 0], [0, 1, 0], [g.L, g.D, 1]])",
        "b = np.array([g.F, 2 * g.F, g.M])",
        "x = np.linalg.solve(A, b)",
        "R = x[0]  # [N] force",
        "T = x[2]  # [N*m] moment",
    ],
    "a force at a computed place": [  # all of the vector was taken for forces, and a right beam failed
        "k = g.F / g.L",
        "A = np.array([[k, k * g.L], [k * g.L, 2 * k * g.L**2]])",
        "b = np.zeros(2)",
        "j = int(np.round(g.L / g.D)) * 0",
        "b[j] -= g.F",
        "d = np.linalg.solve(A, b)",
        "x = d[0]  # [m] way",
        "a = d[1]  # [rad] angle",
    ],
    "rows out of order": [
        "A = np.array([[0, 0.5, 0], [g.L, g.D, 1], [1, 0, 0]])",
        "x = np.linalg.solve(A, np.array([2 * g.F, g.M, g.F]))",
        "R = x[1]  # [N] force",
        "T = x[2]  # [N*m] moment",
    ],
    "elements of a vector": [
        "v = np.array([g.F, g.M, g.L])",
        "w = v / [g.F, g.M, g.L]",
        "x = w.sum() + (v * [g.L, 1, g.F])[1:].sum() / g.M  # [-] sum",
        "y = v[::2].prod()  # [N*m] product",
        "z = np.max(v.reshape(3, 1) * np.ones(4), axis=1)[1]  # [N*m] greatest",
    ],
    "sums so far": ["x = linspace(0, g.L, 5)", "y = np.cumsum(g.F * x)  # [N*m] sum"],
    "mean and deviation": ["x = linspace(0, g.L, 5)", "y = np.mean(x) + np.std(x) + np.median(x)  # [m] y"],
    "integral": ["x = linspace(0, g.L, 5)", "W = np.trapezoid(g.F * x, x)  # [N*m**2] W"],
    "slope": ["x = linspace(0, g.L, 5)", "v = np.gradient(x**2, x)  # [m] v", "d = np.diff(x)  # [m] d"],
    "table of literals": ["s = interp(g.L, [0, 1, 3], [200e6, 180e6, 150e6])  # [MPa] strength"],
    "table of two rows": ["k = interp(g.L, [0, 4], [1.0, 3.0])  # [-] factor", "x = k * g.F  # [N] x"],
    "table over even steps": ["F = interp(g.L, linspace(0, 4, 3), np.array([0, 1, 3]) * kN)  # [N] force"],
    "curve through literals": [
        "from scipy.interpolate import CubicSpline",
        "k = CubicSpline([0, 2, 3], [1.0, 2, 7])(g.L) * g.F  # [N] force",
    ],
    "table of inputs": ["s = interp(g.L, np.array([0, 1, 2]) * g.L, np.array([1, 0.9, 0.8]) * g.S)  # [MPa] s"],
    "polynomial": ["x = np.polyval([1, 2, 3], g.L / g.D)  # [-] x", "y = np.polyval([g.F, g.F * g.L], g.L)  # [N*m] y"],
    "complex": [
        "P = g.L * exp(1j * g.phi)  # [m] point",
        "R = 1j * g.F  # [N] force",
        "T = cross(P, R)  # [N*m] moment",
        "a = angle(P) + abs(P) / g.L  # [deg] angle",
    ],
    "arctangents": ["a = np.arctan(g.L / g.D) + np.arctan(g.phi) + atan2(g.phi, 1) + np.arctanh(g.D / g.L)  # [deg] a"],
    "root from a guess without a unit": [  # as of numbers in metres
        "from scipy.optimize import fsolve, newton",
        "x = fsolve(lambda x: g.F * x - g.M, 1.0)[0]  # [m] x",
        "y, F = fsolve(lambda v: [v[0] * v[1] - g.M, v[1] - 2 * g.F], [20.0, g.F])",
        "z = y * F - newton(lambda T: T - g.M, 10.0)  # [N*m] z",
    ],
    "angles": ["a = atan2(g.L, g.D) % (2 * pi) + g.phi  # [deg] a", "b = sin(g.phi) + log(g.L / g.D)  # [-] b"],
    "hypot": ["x = hypot(g.L, g.D) + np.hypot(g.L, g.D)  # [m] x"],
    "signs": ["x = np.copysign(g.L, g.F) + np.sign(g.F) * g.L + np.heaviside(g.F, 0.5) * g.L  # [m] x"],
    "rounded": ["x = np.round(g.L, 3) + np.floor(g.L / g.D) * g.D + g.L // g.D * g.D  # [m] x"],
    "clipped": ["x = np.clip(g.F, 0, g.M / g.L)  # [N] x"],
    "a number of positions": ["k = arange(g.n)  # [-] k", "x = k * g.L / (g.n - 1)  # [m] x"],
    "exponent of a number": ["x = (g.L / g.D) ** g.n * g.F  # [N] x"],
    "powers by an input": ["x = g.L**g.n / g.L**2  # [m] x"],
    "check": ["c = check('c', g.F - g.M / g.L, 1e-9, 'N')", "d = check('d', g.M, 5 * g.F * g.L, 'N*m')"],
    "check without a unit": ["c = check('c', g.F - g.M / g.L, 1e9)"],
    "find between literals": [
        "x_found = find(lambda x: g.F * x, 0.01, 0.9, equals=g.M, unknown='x', quantity='moment')",
        "x = x_found.value  # [m] x",
        "y = x + g.L  # [m] y",
    ],
    "find with units": [
        "x_found = find(lambda x: g.F * x, 0.01, 0.9, equals=g.M, unknown='x', unit='N*m', unknown_unit='mm')",
        "y = x_found.value + g.L  # [m] y",
    ],
    "what a line declares of a number": ["a = 0.25  # [m] arm", "T = g.F * a  # [N*m] moment"],
    "numbers with units": ["T = g.F * 30 * cm  # [N*m] moment", "k = 640 * MPa / g.S  # [-] reserve"],
    "numbers of several kinds": [
        "G = 7850 * kg / m**3 * g.V * (9.81 * m / second**2)  # [N] weight",
        "a = 20 * deg + pi",
    ],
    "a unit of the module": ["k = 640 * units.MPa / g.S  # [-] reserve", "d = 3 * units.inch + g.D"],
    "a unit by another name": ["from mechsheet.units import kN as force", "x = 2 * force + g.F  # [N] x"],
    "constants of the setup": ["k = STRENGTH / g.S  # [-] reserve", "x = SIZES['M10'] + g.D  # [m] x", "y = LEAST + x"],
    "what a line of the setup declares of a number": [
        "G = G_N * g.W * SHARE  # [N] weight",
        "x = WIRES + g.D  # [mm] x",
    ],
    "temperature": ["dT = celsius(120) - celsius(20) + 5 * degC  # [K] rise", "q = dT / (1 * degC)  # [-] q"],
    "positions with a unit": ["x = linspace(0 * m, 2 * m, 5)", "T = g.F * x  # [N*m] moment", "y = x + g.L  # [m] y"],
    "positions in a declared unit": ["x = linspace(0, 2, 5)  # [m] x", "T = g.F * x  # [N*m] moment"],
    "limits with a unit": ["x = np.clip(g.F, 0 * N, 2 * kN)  # [N] x", "c = check('c', g.F, 600 * N, 'N')"],
    "a unit of one's own": ["sheet = define('sheetdim', 0.6, 'mm')", "x = 3 * sheet + g.D  # [m] x"],
    "what Python made": ["f = float(str(g.L)) / 2", "x = f * g.F  # [N*m] x", "y = max(f, 1) + g.M"],
    "what does not take quantities": [
        "f = float(np.linalg.eigvals(np.eye(2) * (3 * mm))[0].real)",
        "x = f * g.F  # [N*m] x",
    ],
    "not followed": ["f = float(str(g.L))", "x = f * g.F  # [N*m] x", "y = x + g.M  # [N*m] y"],
}


@pytest.mark.parametrize("lines", RIGHT.values(), ids=RIGHT)
def test_what_is_right_is_not_told(told: Callable[..., Dimensions], lines: list[str]) -> None:
    found = told(*lines)
    assert found.mistakes == ()


WRONG = {
    "sum": (["x = g.F + g.M"], 1, "g.F + g.M: adds N and N·m"),
    "difference": (["x = 2 * (g.L - g.D * g.F)"], 1, "g.L - g.D * g.F: subtracts N·m from m"),
    "sine": (["a = sin(g.L)"], 1, "sin(g.L): a quantity in m where a number belongs"),
    "arctangent": (["a = np.arctan(g.L)  # [deg] a"], 1, "np.arctan(g.L): a quantity in m where a number belongs"),
    "area tangent": (["a = np.arctanh(g.D)"], 1, "np.arctanh(g.D): subtracts m from - (a number)"),
    "angle of unlike": (["a = atan2(g.L, g.F)"], 1, "atan2(g.L, g.F): atan2 of m and N"),
    "hypot": (["a = hypot(g.L, g.F)"], 1, "hypot(g.L, g.F): adds m² and "),
    "logarithm": (["a = log(g.L)"], 1, "log(g.L): a quantity in m where a number belongs"),
    "made of another function": (["a = np.tanh(g.L)"], 1, "np.tanh(g.L): a quantity in m where a number belongs"),
    "constant": (["k = 640 * MPa / g.F  # [-] k"], 1, "k: unit [-] does not fit; the value is in 1/m²"),
    "constant of the setup": (["k = STRENGTH + g.F  # [Pa] k"], 1, "STRENGTH + g.F: adds Pa and N"),
    "declared in the setup": (["G = G_N * g.L  # [N] weight"], 1, "G: unit [N] does not fit; the value is in m²/s²"),
    "array declared in the setup": (["x = WIRES + g.F  # [N] x"], 1, "WIRES + g.F: adds m and N"),
    "array with a unit": (["r = np.array([1.0, 2, 3]) * mm", "x = r + g.t"], 2, "r + g.t: adds m and s"),
    "array of numbers": (["x = np.array([1.0, 2]) * g.L + g.F"], 1, "adds m and N"),
    "axis of a table": (["k = interp(g.L, np.array([0, 4]) * second, [1, 3])"], 1, "subtracts s from m"),
    "sum of constants": (["k = 3 * mm + 2 * N"], 1, "3 * mm + 2 * N: adds m and N"),
    "a number that should have a unit": (
        ["k = 640e6 / g.S  # [-] reserve", "q = k + 1  # [-] q"],
        1,
        "k: unit [-] does not fit; the value is in m·s²/kg; 640000000.0 has no unit, and would fit with Pa",
    ),
    "weight": (["G = 9.81 * g.W  # [N] weight"], 1, "the value is in kg; 9.81 has no unit, and would fit with m/s²"),
    "weight by a short number": (["G = 9.8 * g.W  # [N] weight"], 1, "9.8 has no unit, and would fit with m/s²"),
    "weight of a volume": (["G = 7850 * g.V * 9.81  # [N] weight"], 1, "the value is in m³; 7850, 9.81 have no unit"),
    "positions of numbers": (["x = linspace(0, 2, 5)", "T = g.F * x  # [N*m] moment"], 2, "the value is in N"),
    "exponent": (["a = 2**g.L"], 1, "2 ** g.L: an exponent in m"),
    "comparison": (["a = where(g.L < g.F, 1, 2)"], 1, "g.L < g.F: compares m with N"),
    "condition": (["a = 2 * g.L", "if a > 3 * N:", "    a = a + 1 * m"], 2, "34, a > 3 * N: compares m with N"),
    "one of several conditions": (
        ["a = 2 * g.L", "if a > 0 * m and a < 3 * N:", "    a = a + 1 * m"],
        2,
        "34, if a > 0 * m and a < 3 * N: compares m with N",
    ),
    "condition of three parts": (["b = 0 * m < g.L < g.F"], 1, "0 * m < g.L < g.F: compares m with N"),
    "condition of a loop": (["a = 2 * g.L", "while a < 3 * N:", "    a = 2 * a"], 2, "a < 3 * N: compares m with N"),
    "in a loop": (["a = 2 * g.L", "for _ in range(3):", "    a = a + 3 * N"], 3, "a + 3 * N: adds m and N"),
    "in a loop on what rests on it": (
        [
            *("h, x, v = 0.002, g.L, 0 * m / second", "for _ in range(200):"),
            *("    v = v - x / second**2 * h", "    x = x + v * h", "x_end = x  # [mm] place"),
        ],
        4,
        "x + v * h: adds m and m/s²",
    ),
    "in a loop over lists": (
        [*("h = 0.01", "x, v = [g.L], [g.L / g.t]", "for _ in range(50):"), "    v.append(v[-1] - h * x[-1] / g.t**2)"],
        4,
        "v[-1] - h * x[-1] / g.t ** 2: subtracts m/s² from m/s; h has no unit, and would fit with s",
    ),
    "in a loop that adds in place": (
        [*("h = 0.01", "x, v = g.L, g.L / g.t", "for _ in range(5):", "    v -= h * x / g.t**2"), "    x += h * v"],
        4,
        "v -= h * x / g.t ** 2: subtracts m/s² from m/s; h has no unit, and would fit with s",
    ),
    "in a loop that calls a function": (
        [
            *("def a(x, v):", "    return -x / g.t**2 - v / g.t", "h, x, v = 0.01, g.L, g.L / g.t"),
            *("for _ in range(5):", "    v = v + h * a(x, v)", "    x = x + h * v"),
        ],
        5,
        "v + h * a(x, v): adds m/s and m/s²",
    ),
    "of what a loop goes over": (
        ["s = []", "for k in [g.L, g.D]:", "    s.append(max(k, g.F))"],
        3,
        "max(k, g.F): comp",
    ),
    "in a way of a choice": (
        ["if g.n > 1:", "    a = g.L + 2 * g.D", "    b = a + g.F", "else:", "    b = g.L - g.D"],
        3,
        "a + g.F: adds m and N",
    ),
    "in a block": (
        ["with np.errstate():", "    a = g.L + 2 * g.D", "    b = 2 * a + g.F", "    c = a - b"],
        3,
        "2 * a + g.F: adds m and N",
    ),
    "in an attempt": (
        ["try:", "    a = g.L + 2 * g.D", "    b = a + g.F", "except ValueError:", "    b = g.F"],
        3,
        "a + g.F: adds m and N",
    ),
    "divided by a number that should have a unit": (
        ["h = 0.01", "x = g.L / g.t + g.D / h"],
        2,
        "g.L / g.t + g.D / h: adds m/s and m; h has no unit, and would fit with s",
    ),
    "of a name of its cell alone": (["_a = 2 * g.L", "b = _a + 3 * N"], 2, "34, _a + 3 * N: adds m and N"),
    "assertion": (["a = 2 * g.L", "assert a < 300 * N"], 2, "a < 300 * N: compares m with N"),
    "choice": (["a = where(g.n > 2, g.L, g.F)"], 1, "where(g.n > 2, g.L, g.F): chooses between m and N"),
    "greatest": (["a = max(g.L, g.F)"], 1, "max(g.L, g.F): compares m with N"),
    "sum of a list": (["a = np.sum([g.L, g.F])"], 1, "np.sum([g.L, g.F]): puts m and N together"),
    "unit": (["A = pi * g.D**2 / 4  # [m] area"], 1, "A: unit [m] does not fit; the value is in m²"),
    "unit of a half": (["A = sqrt(g.D)  # [m] A"], 1, "A: unit [m] does not fit; the value is in m^(1/2)"),
    "factor": (["A = g.D**2  # [m**2] A", "p = A * g.F  # [MPa] p"], 2, "p: unit [MPa] does not fit"),
    "same under two names": (["A = g.D**2  # [m**2] A", "B = A  # [m] B"], 2, "B: unit [m] does not fit"),
    "input": (["x = g.L  # [N] x"], 1, "x: unit [N] does not fit; the value is in m"),
    "element": (
        ["v = np.array([g.F, g.M])", "w = np.array([g.M, g.F])", "x = v[::-1] - w", "y = v + w"],
        4,
        "v + w: adds N and N·m",
    ),
    "in a function": (
        ["def T(x):", "    y = x * g.F", "    return y + g.F", "", "a = T(g.L)", "b = T(2 * g.L)"],
        3,
        "y + g.F: adds N·m and N",
    ),
    "function with a unit": (
        ["def T(x):", "    return g.F + 0 * x  # [N*m] moment", "", "a = T(g.L)  # [N*m] a"],
        2,
        "T: unit [N*m] does not fit; the value is in N",
    ),
    "function that is solved": (
        [
            "def T(x):",
            "    return g.F * x**2  # [N*m] moment",
            "",
            "a_found = find(T, 0, 2, equals=g.M, unknown='a', unknown_unit='m')",
        ],
        2,
        "T: unit [N*m] does not fit",
    ),
    "argument of the library": (["P = angle(g.L + 1j * g.F)"], 1, "atan2 of N and m"),
    "limit": (["c = check('c', g.F, 1e-12 * g.M, 'N')"], 1, "check 'c': the limit is in N·m, its unit in N"),
    "residual": (["c = check('c', g.F, g.M)"], 1, "check 'c': the residual is in N, its limit in N·m"),
    "interval": (
        ["x_found = find(lambda x: g.F * x, 0, g.F, equals=g.M, unknown='x', unknown_unit='m')"],
        1,
        "find: the interval is in N, x in m",
    ),
    "unit of one of many problems": (
        ["x_found = find(lambda x: g.F * x - g.M, 0, g.L * np.array([2.0, 3.0]), unit='N')"],
        1,
        "find: unit [N] does not fit; f(x) is in N·m",
    ),
    "unit of an equation of many problems": (
        [
            "x_found = find(lambda x, y: (g.F * x - g.M, y - g.L), unit=('N*m', 's'),",
            "    unknown_unit=('m', 'm'), x=g.L * np.array([1.0, 2.0]), y=g.L)",
        ],
        1,
        "find: unit [s] does not fit; equation 2 is in m",
    ),
    "unit of a further equation": (
        [
            "k_least = minerr(lambda k: (g.F * k - g.M, k - g.L, k + g.L), unit=('N*m', 'm', 's'),",
            "    unknown_unit=('m',), k=g.L)",
        ],
        1,
        "find: unit [s] does not fit; equation 3 is in m",
    ),
    "equation": (
        ["x_found = find(lambda x: g.F * x, 0, 99, equals=g.F, unknown='x', unknown_unit='m')"],
        1,
        "find: the function and what it equals: subtracts N from N·m",
    ),
}


@pytest.mark.parametrize(("lines", "number", "says"), WRONG.values(), ids=WRONG)
def test_a_mistake_is_told_once_with_its_line_and_part(
    told: Callable[..., Dimensions], lines: list[str], number: int, says: str
) -> None:
    found = told(*lines)
    assert len(found.mistakes) == 1
    text = str(found.mistakes[0])
    assert text.startswith(f"line {FIRST + number - 1}, "), text
    assert says in text


def test_an_erratum_is_left_alone(told: Callable[..., Dimensions]) -> None:
    found = told("x = g.F + g.M  # [N] as printed (erratum)", "y = 2 * x  # [N] y", "z = g.F  # [m] erratum")
    assert found.mistakes == ()


def test_what_rests_on_a_mistake_is_not_told(told: Callable[..., Dimensions]) -> None:
    found = told("x = g.F + g.M  # [N] x", "y = x + g.F", "p = y / g.L**2  # [MPa] p", "q = g.F + g.L  # [N] q")
    assert [mistake.part for mistake in found.mistakes] == ["g.F + g.M", "g.F + g.L"]
    wrong = "v = g.F * g.L  # [N] whose unit is wrong, or whose formula"
    found = told(wrong, "w = v + g.M  # [N*m] w", "u = v + g.F  # [N] u", "r = sqrt(v / g.M)  # [-] r")
    assert [mistake.part for mistake in found.mistakes] == ["v"]


def test_a_literal_says_once_what_it_is_taken_for(told: Callable[..., Dimensions]) -> None:
    found = told("x = g.L + 0.3 + g.D - 0.3")
    assert [str(note) for note in found.notes] == [f"line {FIRST}, 0.3: taken in m"]


@pytest.mark.parametrize(
    ("line", "note"),
    [
        ("x = g.F * g.L / 1000  # [kN*m] moment", "divided by 1000, as [kN·m] does once more"),
        ("x = g.F / g.L**2 * 1e-6  # [MPa] pressure", "multiplied by 1e-6, as [MPa] does once more"),
        ("x = 1000 * g.L  # [mm] length", "multiplied by 1000, as [mm] does once more"),
        ("x = 100 * g.L / g.D  # [%] part", "multiplied by 100, as [%] does once more"),
        ("x = g.L / 1000  # [mm] sag", ""),
        ("x = 1000 * g.F  # [N] force", ""),
        ("x = 1000 / 25  # [mm] pitch", ""),
        ("x = g.F / 2  # [kN] half", ""),
        ("x = g.F / 1000  # [kN] as printed (erratum)", ""),
    ],
)
def test_a_number_that_converts_as_the_unit_is_noted(told: Callable[..., Dimensions], line: str, note: str) -> None:
    """The unit converts what is shown: 5 kN stood as 0.005 kN; it is no mistake for sure."""
    found = told(line)
    assert [str(note) for note in found.notes] == [f"line {FIRST}, x: {note}"] * bool(note)
    assert not found.mistakes


def test_a_check_whose_unit_was_forgotten_says_what_it_is_shown_in(told: Callable[..., Dimensions]) -> None:
    """A stress stood there as a number of eight digits."""
    found = told("c = check('c', g.F, 2 * g.F)", "d = check('d', g.F / g.F, 3.0)", "e = check('e', g.F, 9.0, 'N')")
    assert [str(note) for note in found.notes] == [f"line {FIRST}, check 'c': no unit is given: shown in N"]
    assert found.check().passed and "shown in N" in found.check().reason


def test_a_number_in_a_text_is_no_literal(told: Callable[..., Dimensions]) -> None:
    """Which nobody has typed, and which is compared with itself while the text stays the same."""
    found = told("M = 0.003 * g.F * g.L  # [N*m] M", 'table_9 = table("9", f"Under {M:.5g}", M)')
    assert not found.notes and not found.mistakes


def test_what_is_not_followed_is_said_and_passes(told: Callable[..., Dimensions]) -> None:
    check = told("f = float(np.linalg.eigvals(np.array([[g.L, 1], [1, g.L]]))[0].real)", "x = f + g.F  # [N] x").check()
    assert check.passed and check.reason == f"not followed at line {FIRST}"
    check = told("x = g.F + g.M").check()
    assert (check.name, check.passed, check.reason) == ("units", False, f"line {FIRST}, g.F + g.M: adds N and N·m")


def test_lines_that_are_not_followed_and_have_the_same_number_have_each_their_own_unit(tmp_path: Path) -> None:
    lines = [f"{name} = json.loads(json.dumps(g.F))  # [{unit}] read" for name, unit in (("y", "m"), ("z", "s"))]
    assert mismatches(own(tmp_path, "\n".join(["import json", *lines])).path) == []
    alone = own(tmp_path, "\n".join(["import json", lines[0], "w = y * g.a  # [s] in metres"]))
    assert [mistake.part for mistake in mismatches(alone.path)] == ["w"], "of one line alone the unit is known"


def test_a_script_tells_mistakes_of_lines_on_which_nothing_rests(tmp_path: Path) -> None:
    """They are typeset with their units, though no table, found value or check takes them; the exit code tells."""
    sheet = own(tmp_path, 'y = g.F * x  # [-] shown\ntable_2 = table("2", "Two", y)')
    apart = "@app.cell\ndef apart(g):\n    z = g.F * g.a  # [mm] alone\n    return\n\nif __name__"
    text = Path(sheet.path).read_text().replace("if __name__", apart)
    Path(sheet.path).write_text(text)
    sheet = load(sheet.path)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "z": 1.875, "__file__": sheet.path}
    book = load_workbook(BytesIO(report.workbook("", names, {})))
    (row,) = (row for row in book["Checks"].iter_rows(min_row=3, values_only=True) if row[0] == "units")
    line = next(n for n, written in enumerate(text.splitlines(), 1) if "z = " in written)
    assert f"line {line}, z: unit [mm] does not fit" in str(row[5])


def test_every_operation_has_a_rule() -> None:
    of_several = {"rows", "length", "state", "iterated", "found", "exported", "take", "at", "join", "reduce"}
    assert set(RULES) == {*ELEMENTWISE, *LEAVES, *of_several}


@pytest.mark.parametrize("document", DOCUMENTS)
def test_the_documents_are_right_but_for_their_errata(document: str) -> None:
    assert mismatches(next(WORKSHEETS.rglob(f"{document}.py"))) == []


PLANTED = [
    ("hitch", "greatest load, as printed (erratum)", "greatest load", "GS6_max", "subtracts N from N·m"),
    ("hitch", "F_gc / (g.k_gc * S_gc * g.eta)", "F_gc / (g.k_gc * g.eta)", "P_gc", "the value is in N"),
    ("hitch", "dRb = Rb / (g.P6 + g.P_msha", "dRb = Rb / (g.P6 + g.L", "dRb", "g.P6 + g.L: adds N and m"),
    ("hitch", "dphi4 = dphi3 * U43  # [rad/m]", "dphi4 = dphi3 * U43  # [rad]", "dphi4", "unit [rad] does not fit"),
    ("hitch", "cross(O1 - P23_S, R01)  # [N*m]", "R01.real  # [N*m]", "M2", "the value is in N"),
    ("hitch", "LS6 = sqrt(g.X6**2 + g.Y6**2)", "LS6 = sqrt(g.X6**2 + g.Y6)", "LS6", "g.X6 ** 2 + g.Y6: adds m² and m"),
    ("hitch", "IS6 = I56 + dphi6", "IS6 = I56 + 0.3 * dphi6 + dphi6", "IS6", ""),
    ("hitch", "phi3(S) + g.phi_BD", "phi3(S) + g.L34", "", "phi3(S) + g.L34: adds"),
    ("hitch", "g.P6 * x_6) / g.L  # [N] load", "x_6 / g.P6) / g.L  # [N] load", "Ra", "subtracts"),
    ("hitch", "of=largest * g.L56", "of=largest", "", "the limit is in N, its unit in N·m"),
    ("joint", "F = total(A)  # [cm**2]", "F = total(A * y)  # [cm**2]", "F", "unit [cm**2] does not fit"),
    ("joint", "M_z = M - N * y_c", "M_z = M - N", "M_z", "M - N: subtracts N from N·m"),
    ("kinetostatics", "s7 = g.l6 + g.l7", "s7 = g.l6 + g.m7", "s7", "g.l6 + g.m7: adds m and kg"),
    ("kinetostatics", "F_in2 = -g.m2 * a_S2", "F_in2 = -g.J2 * a_S2", "F_in2", "unit [N] does not fit"),
    (
        "kinetostatics",
        "F_g = g.p_g * pi * g.D_g**2 / 4",
        "F_g = g.p_g * pi * g.D_g / 4",
        "F_g",
        "unit [N] does not fit",
    ),
    ("landing_gear", "V21 = H / g.t_r", "V21 = g.t_r / H", "V21", "unit [m/s] does not fit"),
    ("slotted_link", "WCn_k = omega_BC_k**2 * g.L3", "WCn_k = omega_BC_k * g.L3", "WCn_k", "the value is in m/s"),
    ("slotted_link", "dphi1 = copysign(2 * pi / g.n", "dphi1 = copysign(2 * pi / g.L1", "dphi1", "unit [deg]"),
]


APART = "of=largest"  # nobody knows what is checked where another mistake spoils it


@pytest.fixture(scope="module")
def told_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, bool], dict[int, str]]:
    """What is told of a copy of a document with all its mistakes, or with the one that stands apart, by the lines."""

    @cache
    def told(document: str, apart: bool) -> dict[int, str]:
        text = (WORKSHEETS / f"{document}.py").read_text(encoding="utf-8")
        mistakes = [p for p in PLANTED if p[0] == document and (p[2] == APART) == apart]
        lines = [line_of(text, right) for _, right, *_ in mistakes]
        for _, right, wrong, *_ in mistakes:
            text = text.replace(right, wrong)
        sheet = tmp_path_factory.mktemp("planted") / f"{document}.py"
        sheet.write_text(text, encoding="utf-8")
        found = mismatches(sheet)
        assert found[0].line == min(lines), "nothing is told of what is right before the first of them"
        return {mistake.line: str(mistake) for mistake in reversed(found)}

    return told


def line_of(text: str, part: str) -> int:
    assert text.count(part) == 1, part
    return text[: text.index(part)].count("\n") + 1


@pytest.mark.parametrize(("document", "right", "wrong", "name", "says"), PLANTED)
def test_a_mistake_planted_in_a_document_is_found_at_its_line(
    told_of: Callable[[str, bool], dict[int, str]], document: str, right: str, wrong: str, name: str, says: str
) -> None:
    text = (WORKSHEETS / f"{document}.py").read_text(encoding="utf-8")
    line = line_of(text, right)
    assert says in told_of(document, wrong == APART).get(line, "nothing")
    assert text.splitlines()[line - 1].strip().startswith(f"{name} =" if name else "")
