"""Derivatives and tolerance bands of a worksheet against balls of 500 bits and against each other."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_cells import by_cells
from flint import acb, arb, ctx

from mechsheet import units
from mechsheet.page.values import html
from mechsheet.recording.evaluation import evaluate
from mechsheet.studies.sensitivity import sensitivity
from mechsheet.studies.tolerance import tolerance
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Input
from tests.own_worksheet import own, written

ROOT = Path(__file__).parents[1]
HITCH = ROOT / "worksheets" / "hitch.py"
CLASS = load(HITCH).inputs
FIELDS = {field.name: field for field in declared(CLASS) if type(field) is Input}
POSITIONS = [0, 4, 9]
WANT = ["GS6", "L4", "abs(R56)", "R56.real", "phi6_S"]
STEP = arb(2) ** -100  # of balls of 500 bits


def exact(g, k):
    """Results in closed form: lengths as distances of points, the group (6, 7) cut free, one derivative by S."""

    def pin(A, B, a, b, side):
        d = B - A
        return A + a * d / abs(d) * turned(side * ((a**2 + abs(d) ** 2 - b**2) / (2 * a * abs(d))).acos())

    O1, O3, O5, O7 = (acb(g[f"X0{i}"], g[f"Y0{i}"]) for i in (1, 3, 5, 7))

    def lower(height):
        return turned(((height - g["Y05"]) / g["L56"]).asin())

    def p34(S):
        return O3 + (pin(O1, O3, S, g["L3"], -1) - O3) / g["L3"] * g["L34"] * turned(g["phi_BD"])

    def p56(S):
        return O5 + (pin(p34(S), O5, L4, g["L5"], +1) - O5) / g["L5"] * g["L56"]

    def mast(S):
        return (pin(p56(S), O7, g["L6"], L7, -1) - p56(S)) / g["L6"]

    L4 = abs(O5 + g["L5"] * lower(g["Y56_min"]) - p34(g["S_min"]))
    upright = turned(g["phi_P6"])
    L7 = abs(O5 + g["L56"] * lower(g["Y_P56"]) + g["L6"] * upright - O7)
    arm = acb(g["X6"], g["Y6"]) / upright
    t = arb(k) / (CLASS.N_pol - 1)
    S = g["S_min"] * (1 - t) + g["S_max"] * t
    IS6 = slope(lambda s: (p56(s) + arm * mast(s)).imag, S)
    P56, u6 = p56(S), mast(S)
    u7 = (P56 + g["L6"] * u6 - O7) / L7
    moment = arm.real * u6.real - arm.imag * u6.imag  # abscissa of the centre of mass from P56
    F7 = g["P6"] * moment / ((g["L6"] * u6).conjugate() * u7).imag
    R56 = acb(0, 1) * g["P6"] - F7 * u7
    area = arb.pi() * g["D_gc"] ** 2 / 4
    GS6 = CLASS.k_gc * g["P_gc_max"] * g["eta"] * area / IS6
    return {"GS6": GS6, "L4": L4, "abs(R56)": abs(R56), "R56.real": R56.real, "phi6_S": u6.arg()}


def turned(phi):
    return acb(0, phi).exp()


def slope(f, x):
    return (f(x + STEP) - f(x - STEP)) / (2 * STEP)


@ctx.workprec(500)
def differentiated(name, k):
    """Exact derivatives of all results by one input, in SI."""
    g = {x: arb(getattr(CLASS, x)) for x in FIELDS}
    ahead, behind = (exact({**g, name: g[name] + step}, k) for step in (STEP, -STEP))
    return {x: (ahead[x] - behind[x]) / (2 * STEP) for x in ahead}


@pytest.fixture(scope="module")
def found():
    return sensitivity(HITCH, WANT)


def test_derivatives_to_the_accuracy_claimed(found):
    """By every input, at both ends and within the stroke, within the error that is estimated, which is small."""
    assert list(found.inputs) == [x for x, field in FIELDS.items() if not field.whole]
    for i, x in enumerate(found.inputs):
        for k in POSITIONS:
            true = differentiated(x, k)
            for name in WANT:
                ratio = units.parse(FIELDS[x].unit).factor / units.parse(found.units[name]).factor
                slope, error = (
                    v[i].ravel()[k if v[i].size > 1 else 0] for v in (found.slopes[name], found.errors[name])
                )
                size = np.max(np.abs(found.values[name])) / abs(found.inputs[x])
                # The truth is a difference as well, by steps of 1e-30: true to about their square.
                assert abs(slope - float(true[name]) * ratio) <= error + 1e-40 * size, (name, x, k)
                assert error <= 1e-9 * size, (name, x, k)


def test_values_units_and_elasticities(found):
    assert np.array_equal(found.values["GS6"], by_cells(HITCH, ["GS6"])["GS6"])
    names = list(found.inputs)
    assert np.allclose(found.relative("GS6")[names.index("D_gc")], 2, rtol=1e-9), "the piston's area is its square"
    assert np.allclose(found.relative("abs(R56)")[names.index("P6")], 1, rtol=1e-9), "reactions are linear in the load"
    assert (found.unit("GS6", "L3"), found.unit("phi6_S", "phi_BD"), found.unit("L4", "eta")) == ("N/m", "deg/deg", "m")
    units.parse(found.unit("GS6", "P_gc_max"))


def test_table_is_sorted_and_names_its_position(found):
    table = found.table("1", "Sensitivity", "GS6", "least")
    frame = table.frame()
    assert frame["input"][0] == "Y03" and len(frame) == len(found.inputs)
    size = frame["relative [-]"].abs().to_numpy()
    assert np.all(np.diff(size) <= 1e-12)  # equal but for rounding as they are declared
    assert "position 9" in table.note and "29958.8 N" in table.note
    assert "<td" in table._mime_()[1] and "N/°" in table._mime_()[1]
    over = found.over_positions("2", "All", "GS6").frame()
    assert over.shape[0] == 10 and "P_msha [-]" not in over and "L3 [-]" in over


def test_a_small_derivative_keeps_its_digits_in_the_table(found):
    small = replace(found, slopes={name: 1e-9 * x for name, x in found.slopes.items()})
    *_, derivative, _, _ = small.table("1", "Sensitivity", "GS6").columns
    shown = [float(text.replace("−", "-")) for text in derivative.texts()]
    np.testing.assert_allclose(shown, derivative.values, rtol=1e-4)


def test_tornado_shows_the_largest_on_top(found):
    tornado = found.tornado("1", "Tornado", "GS6")
    assert [x for x, *_ in tornado.bars[:3]] == ["Y03", "D_gc", "Y01"]
    spec = tornado.chart().to_dict()
    assert spec["encoding"]["y"]["sort"][1] == "Dgc" or spec["encoding"]["y"]["sort"][1].startswith("D")
    assert "P_msha" not in [x for x, *_ in tornado.bars]
    shown = html(tornado)
    assert "<b>Figure 1</b> – Tornado</div>" in shown and "transparent" in shown, "in the page's face"
    assert "Figure 1 \u2013" not in shown.replace("<b>", "").partition('class="ms-caption"')[0]


def test_inputs_at_a_limit_and_at_zero():
    found = sensitivity(HITCH, ["GS6", "Ra"], ["eta", "X05", "P6"], eta=1, X05=0)
    assert set(found.reasons.values()) == {""}
    assert np.allclose(found.relative("GS6")[0], 1, rtol=1e-14), "linear in the efficiency, also at its limit"
    assert np.all(np.isfinite(found.slopes["GS6"][1])) and np.all(found.relative("GS6")[1] == 0)


def test_what_is_not_recorded_is_differentiated_by_differences_and_says_so(tmp_path):
    lines = """
    y = float(f"{g.F:.17g}") * g.a  # [-] by way of a text
    z = 3 * g.F  # [-] recorded
    w = abs(g.F - 2.5)  # [-] with a corner"""
    found = sensitivity(own(tmp_path, lines.replace("\n    ", "\n")).path, ["y", "z", "w"])
    assert set(found.differences) == {"y"} and "line" in found.differences["y"]
    assert found.differences["y"] in found.table("1", "", "y", 0).note
    assert np.allclose(found.slopes["y"], [0.75, 2.5], rtol=1e-9)
    assert found.slopes["z"].tolist() == [3.0, 0.0] and found.errors["z"][0] < 1e-14
    assert np.isnan(found.slopes["w"][0]) and found.slopes["w"][1] == 0
    assert "slope is 1 ahead and -1 behind" in found.reasons["F"] and found.reasons["a"] == ""


SEARCHED = """
low, high = 0.0, 9.0
for _ in range(50):
    middle = (low + high) / 2
    if middle**3 + g.a * middle > g.F:
        high = middle
    else:
        low = middle
root = (low + high) / 2  # [-] by halves
bent = root + abs(g.F - 2.5)  # [-] with a corner"""


def test_what_a_loop_searches_by_halves_moves_though_no_step_of_it_does(tmp_path):
    found = sensitivity(own(tmp_path, SEARCHED).path, ["root"])
    x = float(found.values["root"])
    assert found.slopes["root"].tolist() == pytest.approx([1 / (3 * x**2 + 0.75), -x / (3 * x**2 + 0.75)], rel=1e-6)
    assert "moves it by steps" in found.differences["root"] and set(found.reasons.values()) == {""}
    found = sensitivity(own(tmp_path, SEARCHED).path, ["bent"])
    assert np.isnan(found.slopes["bent"][0]) and "corner" in found.reasons["F"]


def test_differences_tell_a_corner_from_a_slope(tmp_path):
    lines = """
y = float(f"{g.F:.17g}")
w = max(y - 2.5, 0) + y**2 + 3 * g.a  # [-] with a corner"""
    found = sensitivity(own(tmp_path, lines).path, ["w"])
    assert np.isnan(found.slopes["w"][0]) and found.reasons == {"F": "w has a corner there", "a": ""}
    assert found.slopes["w"][1] == pytest.approx(3.0, rel=1e-9)
    for jump in ("y > 2.5", "(y > 2.5) + (y >= 2.5)", "y != 2.5"):
        lines = f'\ny = float(f"{{g.F:.17g}}")\nw = 1.0 * ({jump}) + y  # [-] jumps'
        found = sensitivity(own(tmp_path, lines).path, ["w"])
        assert np.isnan(found.slopes["w"][0]) and found.reasons["F"] == "w jumps there, or ends", jump


PICKED = [
    "np.max(np.array([1.0, 2.0, 4.0])[np.array([3.0, 1.0, g.F]) > 2.5])",
    "max([3.0] + [q for q in (4.0, 5.0) if g.F > 2.5])",
]


@pytest.mark.parametrize("text", PICKED)
def test_the_greatest_of_what_is_picked_otherwise_just_beside_jumps(text, tmp_path):
    found = sensitivity(own(tmp_path, f"\ns = {text} + g.a  # [-] greatest").path, ["s"])
    assert np.isnan(found.slopes["s"][0]) and found.slopes["s"][1] == pytest.approx(1.0)
    assert found.reasons == {"F": "s jumps there, or ends", "a": ""}


def test_an_angle_that_wraps_there_has_no_slope(tmp_path):
    found = sensitivity(own(tmp_path, "\nt = np.angle(-g.a + 1j * (g.F - 2.5))  # [rad] half a turn").path, ["t"])
    assert np.isnan(found.slopes["t"][0]) and found.reasons == {"F": "t jumps there, or ends", "a": ""}


@pytest.mark.parametrize(("at", "slope"), [(2.501, 0.0), (2.55, 0.0), (2.5001, np.nan)])
def test_a_jump_beside_is_no_slope(tmp_path, at, slope):
    """Of a size from a table, or of what is counted, differences had one of the wide steps, true to 1e-13 at times."""
    lines = f'v = float(f"{{g.F:.17g}}")\nd = (1.0 if v < {at} else 3.0) + g.a  # [-] size'
    found = sensitivity(own(tmp_path, lines).path, ["d"])
    assert found.differences and found.slopes["d"][1] == pytest.approx(1.0)
    np.testing.assert_equal(found.slopes["d"][0], slope)
    assert bool(found.reasons["F"]) is bool(np.isnan(slope))


def test_what_keeps_still_beside_a_place_without_a_slope_is_no_searched_one(tmp_path):
    """A share of places on a grid, one of them the origin, was differentiated by steps that jump, by all inputs."""
    lines = """
x, y = np.meshgrid(np.linspace(-1, 1, 15) * g.F, np.linspace(0, 1, 15))
hit = (np.abs(np.hypot(x, y) - 1.1 * g.a) < 0.5) & (np.abs(np.arctan2(y, x) - 1.5) < 1.2)
k = hit.mean()  # [-] share"""
    found = sensitivity(own(tmp_path, lines).path, ["k"])
    assert not found.differences and found.slopes["k"][1] == 0 and "jumps there" in found.reasons["F"]


def test_of_a_result_that_is_nothing_the_inputs_have_an_order_too(tmp_path):
    found = sensitivity(own(tmp_path, "\nb = g.a * (g.F - 2.5) + 0.01 * (g.a - 0.75)  # [-] nothing").path, ["b"])
    assert found.table("1", "", "b").columns[0].values.tolist() == ["F", "a"]
    found = sensitivity(own(tmp_path, "\nb = g.F * (g.a - 0.75) + 0.01 * (g.F - 2.5)  # [-] nothing").path, ["b"])
    assert found.table("1", "", "b").columns[0].values.tolist() == ["a", "F"]


KNOTS = """
from scipy.interpolate import CubicSpline
t = np.interp(g.F, [0.0, 2.5, 9.0], [0.0, 5.0, 31.0])  # [-] at an abscissa of a table
f = CubicSpline([0.0, 1.0, 2.5, 4.0, 9.0], [0.0, 1.0, 6.25, 16.0, 81.0])(g.F)  # [-] smooth at a knot
j = np.searchsorted([1.0, 2.5, 4.0], g.F) * g.a  # [-] jumps"""


def test_at_an_abscissa_of_a_table_there_is_a_slope_on_either_side(tmp_path):
    found = sensitivity(own(tmp_path, KNOTS).path, ["t"])
    assert found.reasons["F"] == "t has a corner there: in SI its slope is 4 ahead and 2 behind"
    found = sensitivity(own(tmp_path, KNOTS).path, ["f", "j"])
    assert found.slopes["f"].tolist() == pytest.approx([5.0, 0.0], rel=1e-9)
    assert np.isnan(found.slopes["j"][0]) and found.reasons["F"] == "j jumps there, or ends"


def test_corners_bound_the_corners_and_hold_the_nominal():
    given = {"L3": 0.001, "phi_BD": 0.5}
    bands = tolerance(HITCH, ["GS6", "L4"], given)
    corners = [
        evaluate(HITCH, ["GS6", "L4"], L3=0.2 + a * 0.001, phi_BD=22 + b * 0.5) for a in (-1, 1) for b in (-1, 1)
    ]
    each = np.array([c["GS6"] for c in corners])
    assert np.allclose(bands["GS6"].least, each.min(0), rtol=1e-12)
    assert np.allclose(bands["GS6"].greatest, each.max(0), rtol=1e-12)
    assert bands["L4"].least.shape == () and bands.count == 4 and bands.lost == 0
    assert np.array_equal(bands["GS6"].nominal, by_cells(HITCH, ["GS6"])["GS6"])


@pytest.mark.parametrize(("distribution", "part"), [("uniform", 3**-0.5), ("normal", 1 / 3)])
def test_monte_carlo_spreads_as_the_derivatives_say(found, distribution, part):
    """For small tolerances the deviation is the root of the squares of slope times the input's own deviation."""
    given = {"L3": 1e-4, "L34": 2e-4, "phi_BD": 0.05}
    bands = tolerance(HITCH, ["GS6"], given, "monte carlo", seed=3, count=2000, distribution=distribution)
    slopes = (found.slopes["GS6"][list(found.inputs).index(name)] for name in given)
    spread = np.sqrt(sum((slope * t * part) ** 2 for slope, t in zip(slopes, given.values(), strict=True)))
    band = bands["GS6"]
    assert np.allclose(band.deviation, spread, rtol=0.06), "four times the error of 2000 draws"
    assert np.all(np.abs(band.mean - band.nominal) < 5 * spread / 2000**0.5)
    p5, p50, p95 = (band.percentiles[p] for p in (5, 50, 95))
    assert np.all((band.least < p5) & (p5 < p50) & (p50 < p95) & (p95 < band.greatest))
    columns = [c.symbol for c in bands.table("1", "Bands").columns]
    assert columns == ["k", "GS6", *(f"GS6_{part}" for part in ("min", "max", "mean", "sd", "p5", "p50", "p95"))]


def test_a_seed_gives_its_own_draws():
    def drawn(seed):
        return tolerance(HITCH, ["L4"], {"L3": 1e-4}, "monte carlo", seed=seed, count=20)["L4"].deviation

    assert np.array_equal(drawn(3), drawn(3)) and not np.array_equal(drawn(3), drawn(4))


def test_variants_without_a_value_leave_no_band():
    bands = tolerance(HITCH, ["GS6"], {"S_max": 0.2}, "corners")
    assert bands.lost == 1 and "no position closes" in bands.reason
    assert np.isnan(bands["GS6"].greatest).any()
    assert "1 have no value" in bands.table("1", "Bands").note


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: sensitivity(HITCH, ["GS66"]), "GS66 is defined by no cell"),
        (lambda: sensitivity(HITCH, ["GS6"], ["L33"]), "input L33 is unknown; nearest: L3"),
        (lambda: sensitivity(HITCH, ["GS6"], ["N_pol"]), "number of positions N_pol, which is a whole number"),
        (lambda: sensitivity(HITCH, ["R56"]), r"R56 is complex; take R56.real, R56.imag or abs\(R56\)"),
        (lambda: sensitivity(HITCH, ["GS6"], L3=2), "no position closes"),
        (lambda: sensitivity(HITCH, ["GS6"], ["L3"]).table("1", "", "GS6", 10), "position 10 of GS6 must be 0..9"),
        (lambda: tolerance(HITCH, ["GS6"], {}), "no input has a tolerance"),
        (lambda: tolerance(HITCH, ["GS6"], {"L33": 1}), "input L33 is unknown"),
        (lambda: tolerance(HITCH, ["GS6"], {"k_gc": 1}), "number of cylinders k_gc, which is a whole number"),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": -0.001}), "L3 = -0.001 m must be a number >= 0"),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": float("nan")}), "L3 = nan m must be a number >= 0"),
        (
            lambda: tolerance(HITCH, ["GS6"], dict.fromkeys(list(FIELDS)[:13], 0)),
            "13 tolerances have 2[*][*]13 corners",
        ),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": "1 %"}), "L3 = '1 %' m must be a number >= 0"),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": 0}, percentiles=[200]), "percentile 200 must be 0..100"),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": 0}, "monte carlo"), "needs a seed"),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": 0}, "monte carlo", seed=1, count=1), "count = 1 variants"),
        (lambda: tolerance(HITCH, ["GS6"], {"L3": 0}, "worst"), "method 'worst' must be"),
        (
            lambda: tolerance(HITCH, ["GS6"], {"L3": 0}, "monte carlo", seed=1, distribution="flat"),
            "distribution 'flat' must be",
        ),
    ],
)
def test_what_cannot_be_asked_is_said(ask, message):
    with pytest.raises(SheetError, match=message):
        ask()


def test_numbers_of_unlike_units_have_digits_of_their_own(found):
    """A force of 10 kN stands beside lengths of parts of a metre: four decimals are too many for one of them."""
    rows = found.table("1", "T", "GS6")
    for heading in ("value", "derivative"):
        column = next(c for c in rows.columns if c.symbol == heading)
        sizes = np.abs(column.values[column.values != 0])
        assert sizes.max() > 1000 * sizes.min(), "they are alike: nothing is tested"
        for text, x in zip(column.texts(), column.values, strict=True):
            assert float(text) == pytest.approx(x, rel=1e-4)
            assert len(text.lstrip("-").replace(".", "").lstrip("0")) <= max(5, len(f"{abs(x):.0f}")), text


@pytest.mark.parametrize("want", ["b", [3]])
def test_what_is_wanted_is_a_list_of_names(want, tmp_path):
    """Of one name alone each letter was taken for a result, and a number ended in a TypeError from inside."""
    path = own(tmp_path, "\nb = g.a * g.F  # [-] result").path
    for study in (sensitivity, lambda path, want: tolerance(path, want, {"a": 0.1})):
        with pytest.raises(SheetError, match="must be a list of names, such as"):
            study(path, want)


def test_a_list_is_given_as_to_a_run(tmp_path):
    """Each of its rows was a variant: a list was refused, and of a table the first row alone was there."""
    setup = "from mechsheet import ask, read, inputs\n@inputs\nclass Load:\n    F: float  # [N] force"
    arm = "a: float = 2.0  # [m] arm; ± 0.1"
    given = f"{arm}\nx: list[float] = [1.0, 2.0]  # [-] parts\nloads: list[Load] = [Load(1.0)]  # all"
    path = tmp_path / "lists.py"
    path.write_text(written(setup, given, "M = g.a * sum(g.x) * sum(g.loads.F)  # [N*m] moment"))
    for x, loads in (([1.0, 2.0, 4.0], [{"F": 3.0}, {"F": 5.0}]), ([7.0], {"F": [3.0, 5.0]}), ("3; 4", "3 | 5")):
        found = sensitivity(path, ["M"], x=x, loads=loads)
        assert found.values["M"] == 2 * found.slopes["M"][0] == 2 * 7 * 8
        band = tolerance(path, ["M"], x=x, loads=loads)["M"]
        assert [band.least, band.nominal, band.greatest] == pytest.approx([1.9 * 56, 2 * 56, 2.1 * 56])
