"""A name that a cell binds anew has one value where each line is shown: the line that gave it alone has it."""

import re
from pathlib import Path
from typing import Any

import pytest
from in_tex import in_tex
from own_worksheet import own, recorded

from mechsheet.html import write
from mechsheet.page.lines import lines as on_the_page
from mechsheet.recording.dimensions import mismatches
from mechsheet.worksheet import lines, source
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import Formula

TWICE = """y = g.F  # [-] first
z = 2 * y  # [-] twice the first
y = y + 1.0  # [-] second
w = 3 * y  # [-] of the second
v = g.a / 2  # [-] half
v *= 3  # [-] one and a half
u = x * g.a  # [-] field
u = u[::-1]  # [-] another one
q = 5.0  # [mm] of a unit
r = 2 * q  # [mm] twice
q = 3.0  # [N] of another one
s = 1.0  # [-] then changed without a unit
s = s + g.k
a, b = g.F, g.a  # [-] one, [-] other
a, b = b, a  # [-] exchanged, [-] both
for k in (1, 2):
    t_k = k * g.F
t_k = 2.0 * t_k  # [-] after a loop
t = typeset()"""
VALUES = {"z": "5", "y": "3.5", "w": "10.5", "v": "1.125", "r": "10000", "q": "3", "a": "0.75", "b": "2.5", "t_k": "10"}


def rows(tmp_path: Path, text: str) -> tuple[dict[str, Any], list[tuple[str, int, set[str]]]]:
    sheet = own(tmp_path, text)
    names = {**sheet.run_whole(), "__file__": sheet.path}
    found = [row for cell in source.cells(names) for row in lines.formulas(cell) if isinstance(row, Formula)]
    return names, [(row.name, row.again, set(row.others)) for row in found]


def test_only_the_last_line_of_a_name_has_its_value(tmp_path: Path) -> None:
    """On the page and in one file; the earlier lines say from where on the name has another one."""
    names, _ = rows(tmp_path, TWICE)
    shown = on_the_page(names["t"])
    page = write.page(own(tmp_path, TWICE.removesuffix("\nt = typeset()")), names["g"])
    for text in (shown, page):
        told = re.findall(r"(\w+) has another value from line (\d+) on", text)
        assert told == [("y", "39"), ("v", "42"), ("u", "44"), ("q", "47"), ("s", "49"), ("a", "51"), ("b", "51")]
        for name, value in VALUES.items():
            (line,) = re.findall(rf'id="line-{name}".*?ms-value[^>]*>(.*?)</div>', text, re.DOTALL)
            assert re.sub("<[^>]*>", "", line).lstrip("= ").replace("\u202f", "").startswith(value), name
    assert 'id="line-s"' not in page


def test_formulas_have_no_number_of_a_name_that_has_another_one_by_now(tmp_path: Path) -> None:
    names, found = rows(tmp_path, TWICE)
    others = {(name, again): read for name, again, read in found if read}
    assert others["z", 0] == {"y"} and others["y", 0] == {"y"} and others["v", 0] == {"v"} and others["r", 0] == {"q"}
    assert others["a", 0] == {"b"} and others["b", 0] == {"a"} and ("w", 0) not in others
    numbers = re.findall('formula="= ([^"]*)"', in_tex(on_the_page(names["t"])))
    assert any("10.5" not in each and "3.5" in each for each in numbers), "w has the number of the last y"


def test_a_workbook_and_the_dimensions_know_the_last_line(tmp_path: Path) -> None:
    """The text of a formula stands beside what it gives; an earlier number has the unit of its own line."""
    sheet = own(tmp_path, TWICE + '\ntable_2 = table("2", "Last", y, v)')
    _, recording = recorded(sheet)
    texts = {line.symbol: line.text for section in recording.lines.values() for line in section}
    assert (texts["y"], texts["v"]) == ("y + 1.0", "v * 3") and texts.get("s", "") == ""
    assert mismatches(sheet.path) == []


CHOSEN = """if g.k > 2:
    p = g.F * 2  # [kN] large
    d = p + g.F  # [kN] sum
elif g.a > 1:
    p = g.F * 3  # [kN] middle
    d = 2 * p  # [kN] twice
else:
    if g.F > 2:
        p = g.F  # [kN] small
    else:
        p = g.a  # [kN] smallest
    d = p  # [kN] the same
e = 1.0  # [-] factor
if g.k > 2:
    e = 2 * e  # [-] for many
f = 1.0  # [-] told below
if g.k > 2:
    f = 3.0
if g.k > 2:
    h = g.F  # [-] of one way alone
elif g.a > 1:
    h = g.a
else:
    h = 1.0  # [-] of another
t = typeset()"""


def test_a_choice_declares_what_each_way_gives_the_same_unit(tmp_path: Path) -> None:
    names, found = rows(tmp_path, CHOSEN)
    known = lines.registry(names)
    assert [name for name, again, _ in found if not again] == ["x", "p", "d", "e"]
    assert (known["p"].unit, known["d"].unit, "h" in known) == ("kN", "kN", False)
    assert known["p"].meaning == "large or middle or small or smallest"
    assert in_tex(on_the_page(names["t"])).count("begin{cases}") == 2 * 3  # by symbols, and with numbers
    assert [again > 0 for name, again, _ in found if name == "f"] == [True]


def test_a_choice_means_what_any_of_its_ways_does(tmp_path: Path) -> None:
    ways = "p = g.F  # [kN] by Euler", "p = 2.0  # [kN] by Johnson", "p = 1.0  # [kN] by Euler"
    text = "if g.k > 2:\n    {}\nelif g.k > 1:\n    {}\nelse:\n    {}".format(*ways)
    names, _ = rows(tmp_path, text)
    assert lines.registry(names)["p"].meaning == "by Euler or by Johnson"


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("if g.k > 2:\n    p = g.F  # [kN] one\nelse:\n    p = g.a  # [m] other", "p is [m] here and [kN] elsewhere"),
        ("p = 1.0  # [m] one\nif g.k > 2:\n    p = g.F  # [kN] other", "p is [kN] here and [m] elsewhere"),
    ],
)
def test_ways_of_a_choice_have_one_unit(text: str, why: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, text)
    with pytest.raises(SheetError, match=re.escape(f"{why}: one name has one unit")):
        sheet.run_whole()


@pytest.mark.parametrize(
    "text",
    [
        "if g.k > 2:\n    p = x  # [kN] one\nelse:\n    p = 2 * x",
        "for k in (1, 2):\n    p = k * x  # [kN] one",
        "p = x\nif g.k > 2:\n    p = x * 2  # [kN] one",
    ],
)
def test_a_table_tells_the_unit_that_declares_nothing(text: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{text}\ntable_2 = table('2', 'Two', p)")
    with pytest.raises(SheetError, match=r"no line declares p with its unit, that at own.py, line 3\d stands within"):
        sheet.run_whole()
