"""Every line stands in the workbook, also one on which nothing rests, and follows its inputs or shows no number."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from as_script import as_script
from own_worksheet import written
from test_recalculation import MADE, computed, edit, lines, lines_apart
from written_cells import Values

SETUP = """import numpy as np
from numpy import linspace
from mechsheet import ask, check, export, inputs, read, slider
from mechsheet.units import kN"""
GIVEN = """F: float = 1200.0  # [N] force; >= 0
L: float = 0.35  # [m] length; > 0
n: int = 3  # [-] turns; > 0 < 9"""
LINES = """eta = 0.9  # [-] efficiency
P = 2 * kN  # [kN] constant load
F_1 = g.F  # [N] the force again
M = g.F * g.L * eta  # [N*m] moment
M_1 = M  # [N*m] the moment again
R = g.F + P * 1j  # [N] complex, its second part constant
ok = M > 3  # [-] truth
x = linspace(0, 1, 7)  # [-] places
M_x = M * (1 - x)  # [N*m] along the lever
two = np.outer(x, x) * M  # [N*m] matrix
total = 0 * M
for k in range(g.n):
    total = total + k * M
M_n = total  # [N*m] by turns
part = slider(0, 1, 0.1, value=0.5, label="part of it")
M_p = M * part.value  # [N*m] at the slider
read_of = float(f"{M:.3f}")  # [N*m] read out of a text"""


@pytest.fixture
def worksheet(tmp_path: Path) -> Path:
    path = tmp_path / "lines.py"
    path.write_text(written(SETUP, GIVEN, LINES, "Lines"))
    return path


def test_lines_alone_give_a_workbook(worksheet: Path, tmp_path: Path) -> None:
    """Without a table, figure or check it had a list of no lines, and said that all checks pass."""
    found = lines(Values(computed(worksheet, tmp_path, {})))
    own = {name: values for (_, name), (_, values) in found.items()}
    one = {"eta": 0.9, "P": 2000, "F_1": 1200, "M": 378, "M_1": 378, "Rx": 1200, "Ry": 2000, "ok": 1, "M_n": 1134}
    one |= {"M_p": 189, "read_of": 378}
    single = {name: value for name, (value, *more) in own.items() if not more}
    assert single == {name: pytest.approx(value) for name, value in one.items()}
    assert {name: len(values) for name, values in own.items() if len(values) > 1} == {"x": 7, "M_x": 7, "two": 49}


@pytest.mark.office
def test_lines_follow_or_show_no_number(worksheet: Path, recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    there = recalculated(edit(computed(worksheet, tmp_path, {}), {"F": 900.0, "L": 0.5}, tmp_path / "edited.xlsx"))
    own = Values(computed(worksheet, tmp_path / "other", {"F": 900.0, "L": 0.5}))
    apart = list(lines_apart(there, own))
    assert len(apart) == 1 and "'read_of'): '#N/A' instead of 405" in apart[0]


def test_what_is_too_long_is_told(tmp_path: Path) -> None:
    """A line that rests on a hundred thousand numbers has no column of these; a run tells which it is."""
    path = tmp_path / "long.py"
    end = "long = g.F * linspace(0, 1, 100_000)  # [N] long\nmost = long.max()  # [N] greatest\n"
    path.write_text(written(SETUP, GIVEN, end + "other = g.L * linspace(0, 1, 20)  # [m] other", "Long"))
    told = [line for line in as_script(path).stdout.splitlines() if line.startswith("not there")]
    assert told == [f"not there: {name}, a line of too many numbers" for name in ("long", "most")]
    assert {name for _, name in lines(Values(tmp_path / "long.xlsx"))} == {"other"}


def test_what_no_line_takes_is_found_too(tmp_path: Path) -> None:
    """A found value that stands in a formula alone was on no sheet; one of two unknowns likewise."""
    path = tmp_path / "found.py"
    path.write_text(written(SETUP.replace("ask,", "ask, find,"), GIVEN, FOUND, "Found"))
    rows = Values(computed(path, tmp_path, {}))["Find"].iter_rows(min_row=3, values_only=True)
    found = {row[0]: (row[1], row[2], row[9] != "found") for row in rows}
    assert found == {
        "x_1": (pytest.approx(1.5), "-", False),
        "phi_found.value": (pytest.approx(60), "°", True),
        "xy.value.y": (pytest.approx(1.5), "-", False),
    }


FOUND = """phi_found = find(np.cos, 0, np.pi, equals=0.5 + 0 * g.F, unknown="angle", unknown_unit="deg")
twice = 2 * np.sin(phi_found.value)  # [-] twice
xy = find(lambda x, y: (x + y - g.n, x - y), x=(-4, 4), y=(-3, 3))
x_1 = xy.value.x  # [-] first
s = xy.value.x + xy.value.y  # [-] sum"""


LENGTHS = """x = linspace(0, g.L, g.n)  # [m] places
x_s = x.sum()  # [m] their sum
x_e = x[-1]  # [m] last
i_e = np.arange(g.n)[-1]  # [-] last number
long = bool(g.n > 3)  # [-] whether many
f_v = float(np.prod(range(1, g.n + 1)))  # [-] orders
v_n = np.array([float(i) for i in range(g.n)])  # [-] counted up
v_f = np.full(g.n, 2.5)  # [-] full
v_g = np.geomspace(1, 100, g.n)  # [-] geometric
v_i = np.arange(g.n) * 2  # [-] even
v_e = np.array([10.0, 20.0, 30.0])[: g.n]  # [-] part of constants
v_d = np.array([1.0, 2.0] if g.n < 4 else [5.0, 6.0, 7.0])  # [-] of a length by choice
v_2 = v_f  # [-] another name
two = [0.01, 0.02]  # [m] a list
huge = 10**20  # [-] huge"""


@pytest.mark.office
def test_lines_of_another_number_of_rows_have_no_number(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """They kept the numbers of as many rows as were exported, and those that are too many had numbers too."""
    path = tmp_path / "lengths.py"
    path.write_text(written(SETUP, GIVEN, LENGTHS, "Lengths"))
    book = computed(path, tmp_path, {})
    edited = [edit(book, {"n": n}, tmp_path / f"{n}.xlsx") for n in (2, 5)]
    same, *others = recalculated_all([book, *edited])
    own = Values(book)
    assert not [*lines_apart(same, own)]
    assert {name for _, name in lines(own)} >= {"v_2", "two", "huge", "v_d", "v_f"} and len(lines(own)) == 15
    for there in others:
        shown = {name: values for (_, name), (_, values) in lines(there).items()}
        assert shown.pop("two") == [0.01, 0.02] and shown.pop("huge") == [1e20]
        numbers = {name: x for name, values in shown.items() for x in values if x != "#N/A"}
        assert not numbers.keys() - {"long", "v_d"}, numbers
        assert MADE in {row[0] for row in there["Checks"].iter_rows(values_only=True) if row[4] == "FAIL"}


EMPTY = """F_i = g.F * np.array([1.0, 2.0, 3.0])  # [N] forces
over = F_i[F_i > 9000.0]  # [N] those above
sum_of = np.sum(over)  # [N] their sum
twice = 2 * over  # [N] twice
none = linspace(0, g.F, 0)  # [N] of no places
ok = check("over", over, 100, "N"), check("none", none, 100, "N")"""


@pytest.mark.office
def test_lines_without_values_say_so(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """An empty selection ended the export with a text of numpy's."""
    path = tmp_path / "empty.py"
    path.write_text(written(SETUP, GIVEN, EMPTY, "Empty"))
    run = as_script(path)
    assert run.returncode == 1 and "not evaluated  over; there is nothing to check" in run.stdout, run.stderr
    for book, none in ((Values(tmp_path / "empty.xlsx"), "no values"),):
        assert {
            name: values for (_, name), (_, values) in lines(book).items() if name in ("over", "twice", "none")
        } == {name: [none] for name in ("over", "twice", "none")}
    there = recalculated(edit(tmp_path / "empty.xlsx", {"F": 4000.0}, tmp_path / "edited.xlsx"))
    shown = {name: values for (_, name), (_, values) in lines(there).items()}
    assert shown["over"] == shown["twice"] == ["not followed"] and shown["sum_of"] == [12000]
    assert not [
        row for row in there["Checks"].iter_rows(values_only=True) if row[0] in ("over", "none") and row[4] == "PASS"
    ]


ROUNDED = """v = 0.29 * g.L / 0.35  # [-] speed
cents = int(v * 100)  # [-] whole ones
down = 45 * mm * g.L / 0.35 // (5 * mm) * 5  # [-] rounded down
same = g.L * 0.3 == g.L * 0.1 * 3  # [-] whether they are equal
many = np.histogram(np.array([0.1, 0.3, 0.5]) * (g.L / 0.35), [0.0, 0.1 * 3, 1.0])[0]  # [-] counted
up = np.ceil(g.F / 500)  # [-] rounded up"""


@pytest.mark.office
def test_what_rounding_makes_whole_is_that_of_the_worksheet(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """28.999999999999996 is 29 to LibreOffice, and verdicts turned where nothing was changed."""
    path = tmp_path / "rounded.py"
    path.write_text(written(f"{SETUP}\nfrom mechsheet.units import mm", GIVEN, ROUNDED, "Rounded"))
    run = as_script(path)
    told = {line.split(":")[1].partition(", ")[2] for line in run.stdout.splitlines() if "by rounding alone" in line}
    assert {"cents", "same", "many"} <= told and "up" not in told, run.stdout
    book = tmp_path / "rounded.xlsx"
    same, other = recalculated_all([book, edit(book, {"L": 0.36, "F": 1700.0}, tmp_path / "edited.xlsx")])
    assert not [*lines_apart(same, Values(book))]
    shown = {name: values for (_, name), (_, values) in lines(other).items()}
    assert shown["cents"] == ["#N/A"] and shown["up"] == [4]


STEPPED = """a, b = {"ground": (1.34, -0.085), "rough": (2.7, -0.265)}[g.finish]
s = lambda: (g.F / 100 + g.L * g.n + g.F * g.L / 7 + g.n**2) ** b
k = (2 + a * s()) / (1 + s())  # [-] surface"""


@pytest.mark.office
def test_a_step_for_another_text_is_none(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """The line was #N/A, and the cell of its step had the power of before."""
    path = tmp_path / "stepped.py"
    path.write_text(written(SETUP, f'{GIVEN}\nfinish: str = "rough"  # finish', STEPPED, "Stepped"))
    assert "written" in as_script(path).stdout
    there = recalculated(edit(tmp_path / "stepped.xlsx", {"finish": "ground"}, tmp_path / "edited.xlsx"))
    shown = {row[0]: row[1] for row in there["Table lines"].iter_rows(values_only=True)}
    assert shown["k"] == shown["k_1"] == "#N/A"


ENDLESS = """N_1 = 2e6 * (300.0 / g.F) ** 5 if g.F > 300.0 else np.inf  # [-] turns
N_2 = 3e6 * (300.0 / g.F) ** 5 if g.F > 300.0 else np.inf  # [-] turns
least = min(N_1, N_2, 1e9)  # [-] fewest
ratio = N_1 / N_2  # [-] ratio
apart = N_2 - N_1  # [-] difference
some = np.array([N_1, 5.0]).sum()  # [-] sum
ok = check("ratio", ratio, 2), check("difference", apart, 1e9), check("fewest", least, 1e10)"""


@pytest.mark.office
def test_an_infinite_number_that_is_chosen_is_none_to_compute_with(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """1E+307 stood for it: their ratio was 1 and their difference 0, and the checks passed."""
    path = tmp_path / "endless.py"
    path.write_text(written(SETUP, GIVEN, ENDLESS, "Endless"))
    there = recalculated(edit(computed(path, tmp_path, {}), {"F": 200.0}, tmp_path / "edited.xlsx"))
    shown = {name: values for (_, name), (_, values) in lines(there).items()}
    assert shown["ratio"] == shown["apart"] == shown["some"] == ["#N/A"] and shown["least"] == [1e9]
    front = {row[0]: row[1] for row in there["Front"].iter_rows(values_only=True)}
    assert front["ratio"] == "#N/A"
    said = {row[0]: row[4] for row in there["Checks"].iter_rows(values_only=True)}
    assert (said["ratio"], said["difference"], said["fewest"]) == ("not evaluated", "not evaluated", "PASS")


LIFE = """N_1 = 2e6 * (300.0 / g.F) ** 5 if g.F > 300.0 else np.inf  # [-] turns
N = np.where(linspace(0.5, 1.5, 3) * g.F > 300.0, 2e6 * (300.0 / g.F) ** 5, np.inf)  # [-] turns of three parts
used = 1e5 / N_1 + (1e4 / N).sum()  # [-] used up
hours = N_1 / (60 * g.n)  # [-] hours
more = 5.0 - (N_1 + g.L)  # [-] below all
least = min(3 * hours * g.L, 1e9) + max(more, -1e8)  # [-] of what is not
parts = N * g.L  # [-] of each part
shortest = np.minimum(parts, 1e8)  # [-] limited
left = np.exp(-N_1 / 1e6)  # [-] what no cell follows
pull = N_1 * kN / 1e6  # [kN] pull
ok = check("used up", used, 1.0), check("pull", pull, 2 * kN, "kN"), check("h", hours, 9.0), check("parts", N, 9e5)"""


@pytest.mark.office
@pytest.mark.parametrize("force", [200.0, 400.0, 1200.0])
def test_a_number_over_an_infinite_one_is_nothing(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path, force: float
) -> None:
    """The damage of a load that is endured for ever had no number: neither had all that stands behind it."""
    path = tmp_path / "life.py"
    path.write_text(written(SETUP, GIVEN, LIFE, "Life"))
    exported = computed(path, tmp_path, {"F": force})
    changes = [{"F": 200.0}, {"F": 400.0}, {"F": 1200.0}, {"F": 250.0, "L": 0.2}]
    edited = [edit(exported, change, tmp_path / f"{n}.xlsx") for n, change in enumerate(changes)]
    for n, (change, there) in enumerate(zip(changes, recalculated_all(edited), strict=True)):
        (tmp_path / f"{n}").mkdir()
        here = Values(computed(path, tmp_path / f"{n}", change))
        for (sheet, name), (_, values) in lines(here).items():
            cells = lines(there)[sheet, name][1]
            if name == "left" and change != {"F": force} and change["F"] < 300.0:
                assert cells == ["#N/A"]
            else:
                assert cells == pytest.approx(values, rel=1e-12), (sheet, name)
        judged = [[row[:5] for row in book["Checks"].iter_rows(min_row=3, values_only=True)] for book in (here, there)]
        assert [row[4] for row in judged[1]] == [row[4] for row in judged[0]]
        assert [row[1] for row in judged[1]] == pytest.approx([row[1] for row in judged[0]], rel=1e-12)
