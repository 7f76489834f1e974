"""A symbol of a worksheet under another name, in all of its files or in none."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from own_worksheet import own
from test_kinds import SHEET

from mechsheet import evaluate
from mechsheet.run import rename as command
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.renaming import renamed

SCENE = 'want = ["U"]\n[inputs]\nF = 7  # kN, F of the bolt\n[limits]\nU = {max = 2}\n'
OTHER = "[inputs]\nF = 1\nspan = 3\n"  # of another worksheet, which has an F too


@pytest.fixture
def bolt(tmp_path: Path) -> Path:
    path = tmp_path / "bolt.py"
    text = SHEET.replace("# [MPa] stress", "# [MPa] stress of F, of $\\\\varphi_{F}$ and F_max")
    path.write_text(text.replace('f"Use, {g.project}"', 'f"Use under {g.F:.0f} N, {g.project}"'), encoding="utf-8")
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "heavy.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "other.toml").write_text(OTHER, encoding="utf-8")
    return path


def rename(path: Path, *names: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-X", "utf8", "-m", "mechsheet", "rename", str(path), *names]
    return subprocess.run(command, capture_output=True, encoding="utf-8", cwd=path.parent)


def in_process(monkeypatch: pytest.MonkeyPatch, path: Path, *names: str) -> None:
    monkeypatch.setattr(sys, "argv", ["rename", str(path), *names])
    monkeypatch.setattr(command, "watch", lambda _: None)
    command.main()


def test_an_input_is_renamed_in_lines_comments_texts_and_scenes(bolt: Path) -> None:
    use = evaluate(bolt, ["U"], F=7)["U"]
    done = rename(bolt, "F", "F_b")
    assert (done.returncode, done.stderr) == (0, "")
    assert [Path(line.removeprefix("written ")).name for line in done.stdout.splitlines()] == ["bolt.py", "heavy.toml"]
    assert evaluate(bolt, ["U"], F_b=7)["U"] == use
    text = bolt.read_text(encoding="utf-8")
    assert "F_b: float = 5 * kN  # [kN] force" in text and "tau = g.F_b / A  # [MPa] stress of F_b, of" in text
    assert "varphi_{F}$ and F_max" in text and 'f"Use under {g.F_b:.0f} N, {g.project}"' in text
    scene = SCENE.replace("F = 7  # kN, F of", "F_b = 7  # kN, F_b of")
    assert (bolt.parent / "scenes" / "heavy.toml").read_text(encoding="utf-8") == scene
    assert (bolt.parent / "other.toml").read_text(encoding="utf-8") == OTHER


def test_ends_of_lines_stay(bolt: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All those of the worksheet became others with the name."""
    bolt.write_bytes(bolt.read_bytes().replace(b"\n", b"\r\n"))
    in_process(monkeypatch, bolt, "R", "ratio")
    assert b"return ratio, U" in bolt.read_bytes()
    assert bolt.read_bytes().count(b"\n") == bolt.read_bytes().count(b"\r\n") > 9


def test_a_result_is_renamed_where_cells_take_and_give_it(bolt: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = evaluate(bolt, ["R"])["R"]
    in_process(monkeypatch, bolt, "R", "ratio")
    text = bolt.read_text(encoding="utf-8")
    assert "return ratio, U, U_x, x" in text and "def results(ratio, U_x, g, x):" in text
    assert "ratio = g.grade.R_e / g.grade.R_m  # [-] ratio of the strengths" in text
    assert evaluate(bolt, ["ratio"])["ratio"] == expected
    assert 'want = ["U"]' in (bolt.parent / "scenes" / "heavy.toml").read_text(encoding="utf-8")
    in_process(monkeypatch, bolt, "U", "U_s")
    scene = (bolt.parent / "scenes" / "heavy.toml").read_text(encoding="utf-8")
    assert 'want = ["U_s"]' in scene and "U_s = {max = 2}" in scene


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (("F", "tau"), "bolt.py, line "),
        (("F", "sum"), "sum is a name of Python's own"),
        (("F", "F b"), "'F b' is no name"),
        (("F", "lambda"), "'lambda' is no name"),
        (("FF", "G"), "'FF' is no symbol of bolt.py; nearest: F"),
        (("linspace", "G"), "'linspace' is no symbol of bolt.py"),
        (("F",), "rename takes a worksheet, a symbol and its new name"),
    ],
)
def test_what_cannot_be_renamed_is_one_line_and_leaves_all_as_it_was(
    bolt: Path, names: tuple[str, ...], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = bolt.read_bytes()
    with pytest.raises(SheetError) as error:
        in_process(monkeypatch, bolt, *names)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)
    assert bolt.read_bytes() == before


def test_where_a_scene_cannot_be_written_the_worksheet_stays(bolt: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = bolt.read_bytes()
    (bolt.parent / "scenes" / "heavy.toml").chmod(0o444)
    with pytest.raises(SheetError, match=r"heavy\.toml cannot be written: the file is read-only"):
        in_process(monkeypatch, bolt, "F", "F_b")
    assert bolt.read_bytes() == before


@pytest.mark.parametrize("saved", [True, False])
def test_ctrl_c_between_two_files_leaves_all_as_they_were(
    bolt: Path, monkeypatch: pytest.MonkeyPatch, saved: bool
) -> None:
    """Just behind the first file, or before the second one."""
    files = [bolt, bolt.parent / "scenes" / "heavy.toml"]
    before, pressed = [file.read_bytes() for file in files], list[Path]()

    def save(data: bytes, file: Path) -> None:
        now = file == files[0 if saved else 1] and not pressed
        if saved or not now:
            file.write_bytes(data)
        if now:
            pressed.append(file)
            raise KeyboardInterrupt

    monkeypatch.setattr(command, "save", save)
    with pytest.raises(KeyboardInterrupt):
        in_process(monkeypatch, bolt, "F", "F_b")
    assert [file.read_bytes() for file in files] == before and len(pressed) == 1


KEYWORDS = """
c = 2 * g.F  # [-] count
def times(x, c=2): return x * c
y = np.diff(linspace(0, 1, 9) ** 3, n=2); z = np.round(times(g.F, c=c), decimals=c)  # [-] c and φ
t = f"φ c {c:{g.n}.1f}{np.diff([1, 4, 9], n=2)} {times(1, c=3)} {np.round(g.F, decimals=int(c))} {{c}}"
both = find(lambda k, c: (k + c - 3, k - c), k=1.0, c=1.0)"""


@pytest.mark.parametrize("inside", [False, True])
def test_an_argument_of_another_function_keeps_its_name(tmp_path: Path, inside: bool) -> None:
    """Of the worksheet's own functions, and of those that take symbols, it follows; within texts too."""
    path = Path(own(tmp_path, KEYWORDS, inside).path)
    texts = {name: renamed(path, name, new, {})[path] for name, new in (("n", "m"), ("c", "decimals_c"))}
    assert "g.m" in texts["n"] and "m: int = 5" in texts["n"]
    assert "** 3, n=2)" in texts["n"] and "{c:{g.m}.1f}{np.diff([1, 4, 9], n=2)}" in texts["n"]
    after = texts["c"]
    assert "times(g.F, decimals_c=decimals_c), decimals=decimals_c)  # [-] decimals_c and φ" in after
    assert "{times(1, decimals_c=3)} {np.round(g.F, decimals=int(decimals_c))} {{decimals_c}}" in after
    assert "lambda k, decimals_c: (k + decimals_c - 3, k - decimals_c), k=1.0, decimals_c=1.0)" in after


def test_a_named_argument_of_find_is_none_of_its_unknowns(tmp_path: Path) -> None:
    path = Path(own(tmp_path, "\nguess = 1.0  # [-] start\nx_0 = find(lambda x: x - 2, guess=guess).value").path)
    assert "x - 2, guess=x_s)" in renamed(path, "guess", "x_s", {})[path]


ROWS = """
from mechsheet import check
@inputs
class Case:
    x: float  # [m] way; > 0 < m
    m: float  # [kg] mass
cases = [Case(x=1.0, m=2.0), Case(3.0, 4.0)]
m = 2 * g.F  # [m] way of m, 5 m/s or 3 m
s = sum(case.x + m for case in cases)  # [m] all
y_1 = check("m over s in 5 m", s - m, 99, "m")
y_2 = check(f"at {m:.1f} m", x=m) if False else {"m": s[m] if False else m}"""


def test_columns_of_rows_and_units_keep_their_names(tmp_path: Path) -> None:
    path = Path(own(tmp_path, ROWS).path)
    text = renamed(path, "m", "m_1", {tmp_path / "s.toml": ""})[path]
    for kept in (
        "x: float  # [m] way; > 0 < m",
        " m: float  # [kg] mass",
        "Case(x=1.0, m=2.0)",
        "m_1 = 2 * g.F  # [m] way of m_1, 5 m/s or 3 m",
        "case.x + m_1 for case in cases)  # [m] all",
        'check("m_1 over s in 5 m", s - m_1, 99, "m")',  # its last text is a unit
        'f"at {m_1:.1f} m", x=m_1) if False else {"m": s[m_1] if False else m_1}',
    ):
        assert kept in text
    assert "sum(case.x + m" in renamed(path, "s", "s_1", {})[path]


def test_a_scene_keeps_units_and_columns(tmp_path: Path) -> None:
    path, scene = Path(own(tmp_path, ROWS).path), tmp_path / "scene.toml"
    held = 'want = ["m", "s"]\n[inputs]\nF = "3 m"  # m, of m\n[limits]\nm = {max = 3}\n'
    now = 'want = ["m_1", "s"]\n[inputs]\nF = "3 m"  # m, of m_1\n[limits]\nm_1 = {max = 3}\n'
    assert renamed(path, "m", "m_1", {scene: held})[scene] == now


def test_an_input_called_as_all_of_them_are_is_renamed_alone(tmp_path: Path) -> None:
    path = Path(own(tmp_path, 'W = g.F * g.g  # [-] weight of g, in g.g\nt = f"{g.F} times {g.g}"').path)
    more = "    g: float = 9.81  # [-] gravity\n    a: float"
    path.write_text(path.read_text(encoding="utf-8").replace("    a: float", more), encoding="utf-8")
    made = renamed(path, "g", "g_n", {})[path]
    assert "W = g.F * g.g_n  # [-] weight of g, in g.g_n" in made and 't = f"{g.F} times {g.g_n}"' in made
    path.write_text(made, encoding="utf-8")
    assert evaluate(path, ["W"], g_n=10.0, F=3.0)["W"] == 30.0


METHODS = """
import mechsheet as ms
from scipy.integrate import quad
class Beam:
    def __init__(self, l): self.l = l
    def M(self, x): return x * (self.l - x)
M = Beam(g.F).M(1.0)  # [-] moment
both = ms.find(lambda M_1, c: (M_1 + c - 3, M_1 - c), M_1=1.0, c=1.0)
M_1 = both.value.M_1 + quad(lambda x: x, 0, M)[0]  # [-] one"""


def test_methods_keep_their_names_and_unknowns_of_a_module_follow(tmp_path: Path) -> None:
    path = Path(own(tmp_path, METHODS).path)
    before = evaluate(path, ["M", "M_1"])
    path.write_text(renamed(path, "M", "M_b", {})[path], encoding="utf-8")
    path.write_text(renamed(path, "M_1", "u", {})[path], encoding="utf-8")
    assert [*evaluate(path, ["M_b", "u"]).values()] == [*before.values()]
    with pytest.raises(SheetError, match=r"^quad is imported, and no symbol of own\.py$"):
        renamed(path, "quad", "integral", {})


def test_a_scene_without_inputs_follows_where_all_that_it_names_is_known(tmp_path: Path) -> None:
    path, other = Path(own(tmp_path, ROWS).path), tmp_path / "other.toml"
    held = 'want = ["m"]\n[limits]\n"abs(m)" = {max = 3}\n"m over s in 5 m" = {max = 9}\n'
    scenes = {tmp_path / "limits.toml": held, other: held.replace('"m"]', '"m", "span"]')}
    scenes[tmp_path / "project.toml"] = "want = 3\ninputs = 4\n"
    made = renamed(path, "m", "m_1", scenes)
    assert made[tmp_path / "limits.toml"].startswith('want = ["m_1"]\n[limits]\n"abs(m_1)" = {max = 3}\n"m_1 over s')
    assert other not in made, "of another worksheet"


FORMATS = [  # the letters of formats beside the symbol d, here D
    'f"{D:d} {D:5d} {e!r:>5} {D!r}"',
    'f"{day:%d.%m.%Y} {day:%Y%m%d} {D}"',
    'f"{e%D} {e % D} {e:{D}d} {[e, D][0:D]}"',
    '"%d of D" % D',
    '"{:d} D {0:d}"',
    'day.strftime("%d")',
]


@pytest.mark.parametrize("said", FORMATS)
def test_how_a_value_is_written_keeps_its_letters(said: str, tmp_path: Path) -> None:
    """A day was %d_c.%m.%Y from then on, and {k:d_c} is no format."""
    lines = "import datetime\nd = 7 * g.k  # [-] d, not %d\ne = 3\nday = datetime.date(2025, 3, d)\nsaid = SAID"
    path = Path(own(tmp_path, lines.replace("SAID", said.replace("D", "d"))).path)
    new = renamed(path, "d", "d_c", {})[path]
    assert f"said = {said.replace('D', 'd_c')}\n" in new
    assert "d_c = 7 * g.k  # [-] d_c, not %d\n" in new


def test_the_name_of_a_file_is_no_symbol(tmp_path: Path) -> None:
    """The worksheet could not be read any more: no file had the new name."""
    lines = (
        "lift = 2 * g.F  # [N] lift, of `lift.csv` and old/lift-2.XLSX\nsaid = f'{lift}: lift.csv.'\nf = 'a lift.tsv'"
    )
    new = renamed(path := Path(own(tmp_path, lines).path), "lift", "h", {})[path]
    assert "h = 2 * g.F  # [N] h, of `lift.csv` and old/lift-2.XLSX\n" in new
    assert "said = f'{h}: lift.csv.'\n" in new and "f = 'a lift.tsv'" in new


KEYS = """
from typing import Literal
from mechsheet import evaluate, grid
kind: Literal["A", "B"] = "B"
widths = dict(A=1.0, B=2.0)
sizes = {"A": 3.0, "B": 4.0}
B = g.F * sizes["B"] * widths[kind]  # [-] B times
asked = lambda: evaluate("own.py", ["B"])
bounds = {"B": 3}
grids = lambda: (grid(**bounds), grid({"B": [1, 2]}))"""


def test_a_key_and_an_option_keep_their_names_and_what_the_library_is_given_follows(tmp_path: Path) -> None:
    """With "B" at one place and ``dict(B=..)`` or a scene at another the renamed worksheet ended in a KeyError."""
    path, scene = Path(own(tmp_path, KEYS).path), tmp_path / "scene.toml"
    made = renamed(path, "B", "B_1", {scene: '[inputs]\nF = 3\nkind = "B"\n'})
    text = made[path]
    assert 'Literal["A", "B"] = "B"' in text and 'sizes = {"A": 3.0, "B": 4.0}' in text and "A=1.0, B=2.0)" in text
    assert 'B_1 = g.F * sizes["B"] * widths[kind]  # [-] B_1 times' in text
    assert 'evaluate("own.py", ["B_1"])' in text and made.get(scene) is None
    assert 'bounds = {"B_1": 3}' in text and 'grid({"B_1": [1, 2]})' in text
    before = evaluate(path, ["B"], F=3.0)["B"]
    path.write_text(text)
    assert evaluate(path, ["B_1"], F=3.0)["B_1"] == before == 24
