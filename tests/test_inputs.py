"""Declared inputs: read from their own lines, checked, replaced in display units."""

import re
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest
from cells import run
from hypothesis import given
from hypothesis import strategies as st
from own_worksheet import written

from mechsheet import ask, load, slider
from mechsheet.document.left_out import left_out
from mechsheet.run import report
from mechsheet.worksheet import inputs, limits, source
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import number

CELL = """
from math import pi
from mechsheet import inputs
@inputs
class Arm:
    # 1.1 Lengths
    L5: float = 0.480  # [m] lower link; > 0
    phi: float = 22 * pi / 180  # [deg] angle
    # 1.2 Range
    S_min: float = 0.42  # [m] least stroke; > 0 < S_max
    S_max: float = 0.67  # [m] greatest stroke
    N: int = 10  # [-] positions; >= 2
"""


@pytest.fixture(scope="module")
def Arm():
    return run(CELL)["Arm"]


def test_lines_declare_unit_meaning_section_and_limits(Arm):
    L5, phi, S_min, _, N = inputs.declared(Arm)
    assert (L5.name, L5.unit, L5.meaning, L5.section, L5.limits) == (
        "L5",
        "m",
        "lower link",
        "1.1 Lengths",
        ((">", "0"),),
    )
    assert (phi.unit, phi.limits) == ("deg", ())
    assert (S_min.section, S_min.limits) == ("1.2 Range", ((">", "0"), ("<", "S_max")))
    assert tuple(limits.read("> 0, <= S_max, < 0.5", "x", "")) == ((">", "0"), ("<=", "S_max"), ("<", "0.5"))
    assert N.whole


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"L5": "-0,48"}, "lower link L5 = -0.48 m must be positive"),
        ({"L5": "0"}, "lower link L5 = 0.0 m must be positive"),
        ({"S_min": 0.9}, "least stroke S_min = 0.9 m must be < S_max = 0.67 m"),
        ({"N": 2.5}, "positions N = 2.5 must be a whole number"),
        ({"N": 1}, "positions N = 1 must be >= 2"),
        ({"L5": "0.4.8"}, "lower link L5 = '0.4.8' m is no number"),
        ({"L5": "nan"}, "lower link L5 = 'nan' m is no number"),
        ({"L5": "1e999"}, "lower link L5 = inf m must be a finite number"),
        ({"L5": "1e-61"}, "lower link L5 = 1e-61 m must be at least 1e-60 m"),
        ({"N": 10**70}, f"positions N = {int(1e70)}" + " must be at most 1e+60 in size"),
        ({"L5": "1 000"}, "lower link L5 = '1 000' m is no number"),
        ({"L5": ""}, "lower link L5 = '' m is no number"),
        ({"L5": True}, "lower link L5 = True m is no number"),
        ({"L55": 1}, "input L55 is unknown; nearest: L5"),
        ({"l5": 1}, "input l5 is unknown; nearest: L5"),
    ],
)
def test_bad_input_is_named_with_value_and_limit(Arm, values, message):
    with pytest.raises(SheetError) as error:
        inputs.build(Arm, values)
    assert str(error.value) == message


def test_replaced_inputs_are_checked_too(Arm):
    with pytest.raises(SheetError, match="lower link L5 = nan m must be a finite number"):
        replace(Arm(), L5=float("nan"))
    with pytest.raises(SheetError, match="lower link L5"):
        replace(Arm(), L5=np.array([0.1, -0.1]))


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (3, 2, 1, 0), (2, 0, 3, 1)])
def test_inputs_of_which_the_declared_ones_break_a_limit_are_refused_until_they_are_replaced(order):
    """Whatever is built first: what is known of a class's own values is no reason to look away."""
    Arm = run(CELL.replace("S_max: float = 0.67", "S_max: float = 0.40"))["Arm"]
    unmet = ", line 10: least stroke S_min = 0.42 m must be < S_max = 0.4 m"
    for k in order:
        values, says = [({}, unmet), ({"L5": 0.5}, unmet), ({"S_max": 0.5}, ""), ({"S_min": 0.3}, "")][k]
        if not says:
            inputs.build(Arm, values)
            continue
        with pytest.raises(SheetError) as error:
            inputs.build(Arm, values)
        assert str(error.value).endswith(says)


def test_display_units_at_the_edge(Arm):
    assert inputs.build(Arm, {"phi": "90"}).phi == pytest.approx(pi / 2, rel=1e-15)
    assert inputs.build(Arm, {"phi": "22,0"}) == Arm(), "the default's own text gives the default, to the last bit"
    assert {f.name: v for f, v in inputs.Used(Arm()).rows()} == {
        "L5": 0.48,
        "phi": 22,
        "S_min": 0.42,
        "S_max": 0.67,
        "N": 10,
    }


@given(st.floats(allow_nan=False, allow_infinity=False), st.booleans())
def test_number_reads_what_python_writes_with_point_or_comma(x, comma):
    text = repr(x).replace(".", ",") if comma else repr(x)
    assert number(f" {text} ") == x


@given(st.text(max_size=8))
def test_number_takes_all_or_rejects(text):
    try:
        value = number(text)
    except ValueError:
        return
    assert float(text.strip().replace(",", ".")) == value


def test_input_without_a_unit_is_an_error_that_names_the_line():
    with pytest.raises(SheetError, match=r", line 4: input x needs a comment with its unit"):
        run("from mechsheet import inputs\n@inputs\nclass A:\n    x: float = 1.0  # metre\n")


def test_inputs_called_elsewhere_says_where_it_stands():
    """It was a StopIteration."""
    names = run("from mechsheet import inputs\nclass A:\n    x: float = 1.0  # [m] length\n")
    with pytest.raises(SheetError, match="write @inputs in the line above class A"):
        run("g = inputs(A)", names)


def test_an_input_without_its_type_is_told_and_not_dropped():
    with pytest.raises(SheetError, match=r", line 4: input x needs a type, such as x: float = 1.0"):
        run("from mechsheet import inputs\n@inputs\nclass A:\n    x = 1.0  # [m] length\n")


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        ("between 0 and 3", "limit 'between 0 and 3' of L5 cannot be read; limits are such as > 0, <= 3 or < S_max"),
        ("> 0 and < 3", "limit 'and < 3' of L5 cannot be read"),
        ("> 0 positive", "limit 'positive' of L5 cannot be read"),
        ("=> 0", "limit '=> 0' of L5 cannot be read"),
        ("> = 0", "limit '> = 0' of L5 cannot be read"),
        ("< > 0", "limit '< > 0' of L5 cannot be read"),
        (">", "limit '>' of L5 cannot be read"),
        ("≥ 0", "limit '≥ 0' of L5 cannot be read"),
        ("0..3", "limit '0..3' of L5 cannot be read"),
        ("> 0; < 3", "limit > 0; of L5: 0; is neither a number nor an input"),
        ("< S_maximum", "limit < S_maximum of L5: S_maximum is neither a number nor an input"),
        ("> 1_000", "limit > 1_000 of L5: 1_000 is neither a number nor an input"),
        ("< inf", "limit < inf of L5: inf is neither a number nor an input"),
        ("< phi", "limit < phi of L5: phi is in deg, L5 in m"),
    ],
)
def test_limit_that_cannot_be_read_is_an_error_at_its_line(limits, message):
    refuses(f"lower link; {limits}", message)


def refuses(comment, message):
    """The comment of an input is an error at its line, told in one."""
    with pytest.raises(SheetError, match=f", line 7: {re.escape(message)}") as error:
        run(CELL.replace("lower link; > 0", comment))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("comment", "tolerance", "at_2"),
    [
        ("lower link; > 0; ± 0.001", "± 0.001 m", 0.001),
        ("lower link; ± 0,001; > 0", "± 0.001 m", 0.001),
        ("lower link; +- 0.5 mm normal", "± 0.0005 m normal", 0.0005),
        ("lower link; +/- 1 %", "± 1 %", 0.02),
        ("lower link;±1%normal", "± 1 % normal", 0.02),
        ("lower link; ± 0", "± 0 m", 0.0),
    ],
)
def test_a_line_may_carry_its_tolerance(comment, tolerance, at_2):
    L5 = inputs.declared(run(CELL.replace("lower link; > 0", comment))["Arm"])[0]
    assert (L5.meaning, L5.limits) == ("lower link", ((">", "0"),) if "> 0" in comment else ())
    assert (L5.tolerance.text(L5.unit), L5.tolerance.of(-2.0)) == (tolerance, pytest.approx(at_2))


@pytest.mark.parametrize(
    ("comment", "message"),
    [
        ("lower link; ± -0.001", "tolerance of lower link L5 = -0.001 m must be a finite number >= 0"),
        ("lower link; ± -1 %", "tolerance of lower link L5 = -1 % must be a finite number >= 0"),
        ("lower link; ± 1e999", "tolerance of lower link L5 = inf m must be a finite number >= 0"),
        (
            "lower link; ± about 1",
            "tolerance of lower link L5 = 'about 1' m is no number; it is such as ± 0.001, ± 1 %",
        ),
        ("lower link; ±", "tolerance of lower link L5 = '' m is no number"),
        ("lower link; ± 1 N", "tolerance of lower link L5 = '1 N': N does not measure m"),
        ("lower link; ± 1; ± 2", "tolerance of lower link L5 = '1; ± 2' m is no number"),
        ("lower link; > 0 ± 0.001", "tolerance of L5 must stand behind a semicolon of its own, as in ; ± 0.001"),
        ("lower link ± 1 %", "tolerance of L5 must stand behind a semicolon of its own, as in ; ± 0.001"),
    ],
)
def test_a_tolerance_that_cannot_be_used_is_an_error_at_its_line(comment, message):
    refuses(comment, message)


def test_only_a_number_that_may_be_a_little_off_has_a_tolerance():
    with pytest.raises(SheetError, match="N has a tolerance, ± 1, which only a single float can have"):
        run(CELL.replace("positions; >= 2", "positions; >= 2; ± 1"))
    with pytest.raises(SheetError, match="bolt has a tolerance, ± 1, which only"):
        run('from mechsheet import inputs\n@inputs\nclass A:\n    bolt: str = "M8"  # bolt; ± 1\n')


@pytest.mark.parametrize("limits", ["> 0 < S_max", "> 0, < S_max", ">0<S_max", " >=0,1   <= 3e0 ", "> -.5"])
def test_limits_stand_in_a_row(limits):
    arm = run(CELL.replace("lower link; > 0", f"lower link; {limits}"))["Arm"]
    with pytest.raises(SheetError, match=r"lower link L5 = -0\.6 m must be"):
        replace(arm(), L5=-0.6)


def test_variants_are_numbers_in_si_with_a_reason_for_each_that_cannot_be_used(Arm):
    given = inputs.variants(Arm, {"L5": ["0,5", "-1", 0.25], "phi": [22, 90, 45], "N": 4})

    assert (given.shape, given.units) == ((3,), {"L5": "m", "phi": "deg", "N": "-"})
    assert list(given.reasons) == ["", "lower link L5 = -1.0 m must be positive", ""]
    si = given.at(np.array([0, 2]))
    assert si["N"] == 4 and si["L5"].tolist() == [[0.5], [0.25]]
    assert si["phi"].tolist() == [[Arm.phi], [pi / 4]], "the default's own number gives the default, to the last bit"
    g = inputs.instance(Arm, si)
    assert isinstance(g, Arm) and isinstance(g.N, int) and g.S_max == 0.67


def test_limits_between_inputs_hold_for_each_variant(Arm):
    given = inputs.variants(Arm, {"S_min": [[0.3], [0.5]], "S_max": [0.4, 0.6]})
    assert given.shape == (2, 2)
    assert list(given.reasons) == ["", "", "least stroke S_min = 0.5 m must be < S_max = 0.4 m", ""]


def test_an_array_is_checked_in_the_display_unit(Arm):
    with pytest.raises(SheetError, match=r"lower link L5 = -0\.1 m must be positive"):
        replace(Arm(), L5=np.array([0.1, -0.1]))
    cell = CELL.replace("# [deg] angle", "# [deg] angle; < 90")
    with pytest.raises(SheetError, match=r"angle phi = 100\.0\d* deg must be < 90 deg$"):
        replace(run(cell)["Arm"](), phi=np.deg2rad([80.0, 100.0]))


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            "a: float = 20  # [deg] angle; > 0 <= 25",
            "angle a = 1145.9155.* deg must be <= 25 deg; 20 is taken in rad: write 20 ",
        ),
        ("a: float = 30 * deg  # [deg] angle; > 0 <= 25", "angle a = 30.* deg must be <= 25 deg$"),
        ("a: float = -2.0  # [m] arm; > 0", r"arm a = -2.0 m must be positive$"),
    ],
)
def test_a_value_of_the_class_that_cannot_be_used_is_told_with_its_line(line: str, said: str, tmp_path: Path) -> None:
    """A number without a unit was told as another one, and nobody said where it stood."""
    path = tmp_path / "angle.py"
    setup = "from mechsheet import ask, inputs, read\nfrom mechsheet.units import deg"
    path.write_text(written(setup, line, "y = g.a  # [-] y"))
    number = next(n for n, text in enumerate(path.read_text().splitlines(), 1) if line in text)
    with pytest.raises(SheetError, match=rf"^angle\.py, line {number}: {said}"):
        load(path).inputs()
    with pytest.raises(SheetError, match=r"^[^:]*$"):
        inputs.build(load(path).inputs, {"a": -1.0})
    assert inputs.build(load(path).inputs, {"a": 3.0}).a > 0


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            "d: float = 42  # [mm] diameter",
            "d = 42000 mm; 42 is taken in m: write 42 * mm, or 42 * m where that is meant",
        ),
        ("a: float = 20  # [deg] angle", "a = 1146 deg; 20 is taken in rad: write 20 * deg, or 20 * rad where that is"),
        ("F: float = 2.7  # [kN] force", "F = 0.0027 kN; 2.7 is taken in N: write 2.7 * kN, or"),
        ("p: float = 6  # [bar] pressure", "p = 0.00006 bar; 6 is taken in Pa: write 6 * bar, or"),
        ("e: float = 85  # [%] efficiency", "e = 8500 %; 85 is taken as it stands: write 85 / 100"),
        ("d: float = 0.042  # [mm] diameter", ""),
        ("F: float = 50e3  # [kN] force", ""),
        ("a: float = 0.35  # [deg] angle", ""),
        ("d: float = 42 * mm  # [mm] diameter", ""),
        ("l: float = 42  # [m] length", ""),
        ("F: float = 0  # [kN] force", ""),
    ],
)
def test_a_number_that_is_hardly_meant_in_si_is_told(line: str, said: str, tmp_path: Path, capsys) -> None:
    """42 in a line of millimetres is 42 m: nothing had said so where no limit stands."""
    path = tmp_path / "alone.py"
    setup = "from mechsheet import ask, inputs, read\nfrom mechsheet.units import mm"
    path.write_text(written(setup, line, "y = g.F if hasattr(g, 'F') else 1  # [-] y"))
    names = {**load(path).run_whole(), "__file__": str(path)}
    number = next(n for n, text in enumerate(path.read_text().splitlines(), 1) if line in text)
    told = [text for text in report._left_out(names, path) if "is taken" in text]
    assert [text.startswith(f"alone.py, line {number}: {said}") for text in told] == [True] * bool(said), told
    texts = ("from mechsheet.units import mm\nfrom mechsheet import inputs", f"@inputs\nclass Given:\n    {line}")
    cells = source.of_texts(tuple((text, "") for text in texts))
    in_editor = [each for each in left_out(cells, names) if "is taken" in each.why]
    assert [(each.cell, each.line) for each in in_editor] == [(1, 3)] * bool(said)
    assert all(each.why.startswith(said) for each in in_editor)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (("0", 10), "slider S: start = '0' must be one number"),
        ((0, 10, 0), "slider S: step = 0 must be a number > 0"),
        ((0, 10, 1, [3.0]), "slider S: value = [3.0] must be one number"),
        ((0, 10, 1, None, "S", "mmm"), "slider S: unit [mmm] is not known"),
    ],
)
def test_what_a_slider_cannot_take_is_named(given, told):
    with pytest.raises(SheetError, match=re.escape(told)):
        slider(*given, *(0, 10, 1, None, "S")[len(given) :])


def test_inputs_that_are_none_are_named():
    with pytest.raises(SheetError, match="read takes a class of inputs and what ask gives of it"):
        inputs.read(int, 4)
    row = run("from mechsheet import inputs\n@inputs\nclass Row:\n    a: float  # [m] length")["Row"]
    with pytest.raises(SheetError, match=re.escape("input a of Row needs a value, such as a: float = 1.0")):
        ask(row)
