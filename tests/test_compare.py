"""Two states of a document side by side: inputs, formulas, numbers and verdicts that differ."""

from __future__ import annotations

import re
import subprocess
import sys
import warnings
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook
from own_worksheet import own
from test_kinds import SHEET, use

from mechsheet import evaluate
from mechsheet.run import compare
from mechsheet.worksheet.results import Displayed

CHECKED = SHEET.replace(
    "    return (table_1,)\n", '    check_1 = check("use", U_x.max(), 1.0)\n    return check_1, table_1\n'
)


def git(folder: Path, *arguments: str) -> None:
    known = ("-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
    subprocess.run(["git", "-C", folder, *known, *arguments], check=True, capture_output=True)


@pytest.fixture(scope="module")
def bolt(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A worksheet in two revisions, of which the second has another formula, a scene and a workbook."""
    folder = tmp_path_factory.mktemp("sheet")
    path = folder / "bolt.py"
    path.write_text(CHECKED, encoding="utf-8")
    git(folder, "init", "-q")
    git(folder, "add", ".")
    git(folder, "commit", "-qm", "first")
    path.write_text(CHECKED.replace("U = gamma * tau", "U = 2 * gamma * tau"), encoding="utf-8")
    git(folder, "commit", "-qam", "second")
    (folder / "strong.toml").write_text('[inputs]\ngrade = "10.9"\nF = 40\n', encoding="utf-8")
    (folder / "plain.toml").write_text("[inputs]\nF = 5\n", encoding="utf-8")
    book = Workbook()
    book.active.title = "Inputs"
    for row in (["Symbol", "Value", "Unit"], ["F", 40, "kN"], ["grade", "10.9", "-"]):
        book.active.append(row)
    book.save(folder / "strong.xlsx")
    return path


def compared(
    bolt: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *options: str
) -> tuple[object, str, str]:
    """Exit code and what is printed."""
    monkeypatch.chdir(bolt.parent)
    monkeypatch.setattr(sys, "argv", ["compare", str(bolt), *options])
    monkeypatch.setattr(compare, "watch", lambda _: None)
    with pytest.raises(SystemExit) as exit_:
        compare.main()
    return (exit_.value.code, *capsys.readouterr())


def test_what_differs_between_two_revisions_is_told(bolt, monkeypatch, capsys) -> None:
    code, out, _ = compared(bolt, monkeypatch, capsys, "HEAD~1", "HEAD")
    old, new = use(), 2 * use()
    assert code == 1
    assert out.splitlines() == [
        "formulas:",
        "  U: gamma * tau / (alpha * g.grade.R_m) -> 2 * gamma * tau / (alpha * g.grade.R_m)",
        "numbers:",
        f"  U: {old:.6g} -> {new:.6g}  {new - old:+.4g} (+100 %)",
        f"  U_x: 0..{old:.6g} -> 0..{new:.6g}  {new - old:+.4g} (+100 %)",
        "checks:",
        f"  use: {old:.5g} <= 1 -> {new:.5g} <= 1  {new - old:+.4g} (+100 %)",
    ]


@pytest.mark.parametrize("state", ["strong.toml", "strong.xlsx"])
def test_a_scene_and_a_workbook_are_states_too(bolt, monkeypatch, capsys, state: str) -> None:
    code, out, _ = compared(bolt, monkeypatch, capsys, "HEAD", state, "--markdown")
    old, new = 2 * use(), 2 * use("10.9", F=40.0)
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in out.splitlines()]
    assert code == 1 and rows[0] == ["what", "name", "old", "new", "by"]
    assert ["input", "F", "5 kN", "40 kN", ""] in rows and ["input", "grade", "8.8", "10.9", ""] in rows
    part = f"{new - old:+.4g} ({100 * (new - old) / old:+.3g} %)"
    assert ["number", "U", f"{old:.6g}", f"{new:.6g}", part] in rows
    assert ["verdict", "use", "PASS", "FAIL", ""] in rows
    assert not [row for row in rows if row[1] in ("A", "n", "k", "x")]


def test_the_file_as_it_is_now_is_a_state_and_differences_need_no_power_of_ten(bolt, monkeypatch, capsys) -> None:
    now = bolt.with_name("now.py")
    now.write_text(
        bolt.read_text(encoding="utf-8").replace("F: float = 5 * kN", "F: float = 500 * kN"), encoding="utf-8"
    )
    code, told, errors = compared(bolt, monkeypatch, capsys, "HEAD", "now.py")
    assert (code, errors) == (1, "")
    assert "  F: 5 kN -> 500 kN" in told
    assert "(+9900 %)" in told and not re.search(r"[(+-]\d\S*e[+-]\d", told)


def test_words_that_differ_are_told(bolt, monkeypatch, capsys) -> None:
    """A meaning, a title, and of a paragraph the place, whatever stands before it; a number in it is no word."""
    text, long = bolt.read_text(encoding="utf-8"), "It holds what it has to. " * 9
    for word, meaning in (("usual", "use"), ("rare", "part that is used")):
        shown = f'    """{long}It is {word}.\n\n    The rest."""\n    typeset(f"{word} {{g.F}} N")\n'
        own = text.replace("    typeset()\n", shown).replace("] use\n", f"] {meaning}\n")
        bolt.with_name(f"{word}.py").write_text(own.replace('f"Use,', f'f"{word.title()},'), encoding="utf-8")
    code, out, err = compared(bolt, monkeypatch, capsys, "usual.py", "rare.py")
    assert (code, err) == (1, "") and out.splitlines() == [
        "meanings:",
        "  U: use -> part that is used",
        "  table 1: Usual, Bridge 7 -> Rare, Bridge 7",
        "paragraphs:",
        "  text: .. has to. It is usual. -> .. has to. It is rare.",
        "  text: f'usual {g.F} N' -> f'rare {g.F} N'",
    ]


def test_where_nothing_differs_the_exit_code_is_0(bolt, monkeypatch, capsys) -> None:
    assert compared(bolt, monkeypatch, capsys, "HEAD", "plain.toml")[:2] == (0, "nothing differs\n")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("HEAD",), "compare takes a worksheet, two states and --markdown, such as hitch HEAD heavy.toml"),
        (("HEAD", "none.toml"), "scene none.toml cannot be read: No such file or directory"),
        (("HEAD", "v9"), "v9 is no .toml, no .xlsx and no revision of "),
        (("HEAD", "--output=x"), "compare takes a worksheet, two states and --markdown"),
        (("HEAD", "long.toml"), "long.toml: "),
    ],
)
def test_what_is_no_state_is_one_line_and_exit_code_2(bolt, monkeypatch, capsys, options, message) -> None:
    bolt.with_name("long.toml").write_text("[inputs]\nF = 1e70\n", encoding="utf-8")
    code, out, err = compared(bolt, monkeypatch, capsys, *options)
    assert (code, out) == (2, "") and err.startswith(f"error: {message}") and err.count("\n") == 1


def numbers_that_differ(old: dict[str, list[float]], new: dict[str, list[float]]) -> dict[str, str]:
    """By how much, of results without a dimension; a warning of numpy is an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        states = [
            compare.State({}, {}, {name: Displayed(name, "-", "", np.array(x)) for name, x in values.items()}, {})
            for values in (old, new)
        ]
        return {change.name: change.by for change in compare.changes(*states)}


@pytest.mark.parametrize("other", [inf, -inf, nan])
def test_a_number_that_is_no_more_finite_differs(other: float) -> None:
    for a, b in (([1.0], [other]), ([other], [1.0]), ([1.0, 2.0, other], [1.0, 2.0, 3.0])):
        (said,) = numbers_that_differ({"x": a}, {"x": b}).values()
        assert said == f"1 of {len(a)} values differ by no finite number"
    assert numbers_that_differ({"x": [1.0, other]}, {"x": [1.0, other]}) == {}
    assert numbers_that_differ({"x": [other, 1.0]}, {"x": [other, 2.0]}) == {"x": "+1 (+100 %)"}


@pytest.mark.parametrize(
    ("values", "said"),
    [([3.0, nan, 1.0], "1..3 mm, 1 of 3 missing"), ([nan, 2.0], "2 mm, 1 of 2 missing"), ([nan, nan], "nan mm")],
)
def test_of_a_field_with_gaps_the_numbers_that_there_are_are_told(values: list[float], said: str) -> None:
    field = Displayed("x", "mm", "length", np.array(values))
    assert str(field) == f"x = {said}, length"
    states = [compare.State({}, {}, {"x": shown}, {}) for shown in (field, field._replace(values=2 * field.values))]
    assert {change.old for change in compare.changes(*states)} <= {said}


def test_infinities_of_other_signs_differ_and_so_do_numbers_whose_difference_is_infinite() -> None:
    assert numbers_that_differ({"x": [inf]}, {"x": [-inf]}) == {"x": "1 of 1 values differ by no finite number"}
    assert numbers_that_differ({"x": [inf]}, {"x": [nan]}) == {"x": "1 of 1 values differ by no finite number"}
    assert list(numbers_that_differ({"x": [-1.5e308]}, {"x": [1.5e308]})) == ["x"]


@pytest.mark.parametrize("beside", [inf, 1e12])
def test_a_great_number_hides_no_change_of_another(beside: float) -> None:
    assert numbers_that_differ({"N": [beside], "x": [0.5]}, {"N": [beside], "x": [0.9]}) == {"x": "+0.4 (+80 %)"}


FAR_APART = """
from mechsheet import check
N = 1e16 * g.F / (g.F + 1e-9)  # [-] life
s = 1.5 * g.a  # [-] safety
left = g.F ** 0.5 * g.F ** 0.5 - g.F + g.a ** (1 / 3) * g.a ** (2 / 3) - g.a  # [-] zero but for rounding
c_1 = check("safety", 1 / s, 1)"""


def test_a_greater_number_of_the_same_dimension_hides_only_what_rounding_moves_as_much(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = Path(own(tmp_path, FAR_APART).path)
    for name, text in {"old": "a = 0.75", "new": "a = 0.8", "other": "a = 0.75\nF = 7.3"}.items():
        (tmp_path / f"{name}.toml").write_text(f"[inputs]\n{text}\n", encoding="utf-8")
    code, out, _ = compared(path, monkeypatch, capsys, "old.toml", "new.toml")
    assert code == 1 and "s: 1.125 -> 1.2  +0.075 (+6.67 %)" in out and "left" not in out and "N:" not in out
    code, out, _ = compared(path, monkeypatch, capsys, "old.toml", "other.toml")
    assert code == 1 and "left" not in out and " s:" not in out


SHOWN = """
from mechsheet import Column, Table, check
M = 2 * g.F * g.a  # [N*m] moment
word = "big" if M > 5 else "small"
for name in ("first", "second"):
    check(name, M, 9, "N*m")
w, s = Column("w", "N", "doubles", 1, np.array([1.0, 2.0]) * g.F), Column("s", "", "", 0, ["a", "b"])
t_1 = Table("2", "Own", (w, s))
c_1 = check("moment", M, 5, "N*m")
c_2 = check("agreeing", g.F * g.a * 2 - M, 1e-9, "N*m", of=M)"""
SHOWN_OTHERWISE = {
    ("M, 5,", "M, 7,"): "check moment: 3.75 <= 5 N·m -> 3.75 <= 7 N·m",
    ("M, 5,", "M / 2, 5,"): "check moment: 3.75 <= 5 N·m -> 1.875 <= 5 N·m  -1.875 N·m (-50 %)",
    ("M, 5, ", "M, at_least=3, unit="): "check moment: 3.75 <= 5 N·m -> 3.75 >= 3 N·m",
    ("M, 9,", "M, 1,"): "verdict second: PASS -> FAIL",
    ("M > 5", "M > 3"): "text word: small -> big",
    ("2.0]) * g.F", "3.0]) * g.F"): "number table 2 w: 2.5..5 N -> 2.5..7.5 N  +2.5 N (+50 %)",
    ('["a", "b"]', '["a", "c"]'): "text table 2 s: a; b -> a; c",
    ("[N*m] moment", "[kN*m] moment"): "number M: 3.75 N·m -> 0.00375 kN·m  the same in another unit",
    ("1e-9,", "1e-3,"): "check agreeing: 0 <= 3.8e-9 N·m -> 0 <= 0.0037 N·m",
    ("2.5  # [-] number", "2.5  # [-] number; > 1; ± 1"): "bound F: none -> > 1; ± 1",
}


@pytest.mark.parametrize("edit", SHOWN_OTHERWISE)
def test_whatever_a_document_shows_otherwise_differs(edit, tmp_path, monkeypatch, capsys) -> None:
    """A limit, a verdict that no name keeps, a column or a text of one's own: nothing of it is a result of a line."""
    path = Path(own(tmp_path, SHOWN).path)
    text = path.read_text(encoding="utf-8")
    assert edit[0] in text
    (tmp_path / "new.py").write_text(text.replace(*edit), encoding="utf-8")
    code, out, _ = compared(path, monkeypatch, capsys, "own.py", "new.py")
    kind, _, told = SHOWN_OTHERWISE[edit].partition(" ")
    assert code == 1 and f"{kind}s:\n" in out and f"  {told}\n" in out
    assert compared(path, monkeypatch, capsys, "new.py", "new.py")[:2] == (0, "nothing differs\n")


def test_what_agreements_leave_is_no_difference(tmp_path, monkeypatch, capsys) -> None:
    path = Path(own(tmp_path, SHOWN).path)
    for name, F in (("old", 2.5), ("new", 2.7)):
        (tmp_path / f"{name}.toml").write_text(f"[inputs]\nF = {F}\n", encoding="utf-8")
    code, out, _ = compared(path, monkeypatch, capsys, "old.toml", "new.toml")
    assert code == 1 and "  moment: 3.75 <= 5 N·m -> 4.05 <= 5 N·m  +0.3 N·m (+8 %)" in out and "agreeing" not in out


def test_rounding_is_no_difference() -> None:
    assert numbers_that_differ({"x": [0.3]}, {"x": [0.1 + 0.2]}) == {}
    assert numbers_that_differ({"F": [400.0], "left": [1e-14]}, {"F": [400.0], "left": [-3e-14]}) == {}


def test_modules_beside_a_worksheet_are_those_of_its_revision(tmp_path, monkeypatch, capsys) -> None:
    path, helper = Path(own(tmp_path, "W = 1 * g.F  # [-] factor").path), tmp_path / "beside_it.py"
    text = path.read_text(encoding="utf-8").replace("W = 1 *", "from beside_it import factor\n    W = factor *")
    path.write_text(text.replace("import math", "import beside_it\n    import math", 1), encoding="utf-8")
    helper.write_text("factor = 2.0\n", encoding="utf-8")
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "first")
    helper.write_text("factor = 3.0  # now\n", encoding="utf-8")
    code, out, _ = compared(path, monkeypatch, capsys, "HEAD", "own.py")
    assert code == 1 and "W: 5 -> 7.5  +2.5 (+50 %)" in out
    monkeypatch.chdir(tmp_path.parent)
    assert evaluate(path, ["W"], F=1.0)["W"] == 3.0, "from another folder too"
