"""Workbooks recalculate: LibreOffice computes every cell again, and each agrees with the worksheet's own run."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from conftest import WITHIN
from openpyxl import Workbook, load_workbook

from mechsheet.workbook import reading
from mechsheet.workbook.place import DefinedNames
from mechsheet.worksheet import cells, inputs

ROOT = Path(__file__).resolve().parents[1]
CHANGED = {  # lengths, loads and angles of each worksheet; "0,47" is typed as a text
    "hitch": {"P6": 25e3, "L5": "0,47", "X07": 0.42, "phi_BD": 23, "S_max": 0.66, "Y_P56": 0.42, "D_gc": 0.085},
    "landing_gear": {"theta": 80, "t_r": "9,5", "m3": 900, "a": 0.21, "U": -70},
    "slotted_link": {"L1": 0.21, "omega1": -9, "L0": "0,52"},
    "kinetostatics": {"m4": 3, "n1": "290,5", "l4": 0.46, "phi05": -9},
    "joint": {"N_1": 12500, "b": "26", "phi_1": 3, "M_r1": 2.1e6},
}
ALWAYS = """<?xml version="1.0" encoding="UTF-8"?>
<oor:items xmlns:oor="http://openoffice.org/2001/registry">
<item oor:path="/org.openoffice.Office.Calc/Formula/Load"><prop oor:name="OOXMLRecalcMode" oor:op="fuse">
<value>0</value></prop></item></oor:items>"""


@pytest.fixture(scope="module")
def recalculated(soffice: str, tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], Any]:
    """Workbook as LibreOffice computes it, whatever values are stored in it."""
    profile = tmp_path_factory.mktemp("profile")
    (profile / "user").mkdir()
    (profile / "user" / "registrymodifications.xcu").write_text(ALWAYS, encoding="utf-8")

    def recalculate(path: Path) -> Any:
        out = tmp_path_factory.mktemp("recalculated")
        kind = "xlsx:Calc MS Excel 2007 XML"
        command = [soffice, f"-env:UserInstallation={profile.as_uri()}", "--headless", "--convert-to", kind]
        subprocess.run([*command, "--outdir", str(out), str(path)], check=True, capture_output=True, timeout=WITHIN)
        return load_workbook(out / path.name, data_only=True)

    return recalculate


def exported(name: str) -> Path:
    """The workbook as it stands in exports/, which other tests keep current."""
    return ROOT / "exports" / f"{name}.xlsx"


def export(name: str, out: Path, changes: dict[str, Any]) -> Path:
    arguments = [f"--{key}={value}" for key, value in changes.items()]
    script = ROOT / "worksheets" / f"{name}.py"
    run = subprocess.run(
        [sys.executable, "-X", "utf8", script, f"--out={out}", *arguments], capture_output=True, encoding="utf-8"
    )
    assert (out / f"{name}.xlsx").exists(), run.stdout + run.stderr
    return out / f"{name}.xlsx"


def edit(path: Path, changes: dict[str, Any], to: Path) -> Path:
    """The workbook with other values on the sheet Inputs, as somebody types them."""
    book = load_workbook(path)
    left = dict(changes)
    for row in book["Inputs"].iter_rows(min_row=3):
        if row[0].value in left:
            row[1].value = left.pop(row[0].value)
    assert not left
    book.save(to)
    return to


def numbers(book: Any) -> Iterator[tuple[str, str, float | str]]:
    """Numbers and error values of the tables: sheet, cell, value."""
    for sheet in book.worksheets:
        if re.match(r"\d", sheet.title) and not sheet.title.endswith(("lines", "fields")):
            for row in sheet.iter_rows(min_row=5):
                yield from ((sheet.title, c.coordinate, c.value) for c in row if c.value is not None)


def disagreements(live: Any, own: Any) -> Iterator[str]:
    """Cells of the tables that differ by more than 1e-10 of what the workbook has in that unit."""
    units = {(s.title, c.column_letter): c.value for s in own.worksheets for c in s[4] if re.match(r"\d", s.title)}
    size: dict[Any, float] = defaultdict(float)
    for sheet, cell, value in numbers(own):
        if isinstance(value, float | int):
            unit = units[sheet, re.match("[A-Z]+", cell)[0]]  # type: ignore[index]
            size[unit] = max(size[unit], abs(value))
    computed = {(sheet, cell): value for sheet, cell, value in numbers(live)}
    for sheet, cell, value in numbers(own):
        other = computed[sheet, cell]
        if isinstance(value, str) or isinstance(other, str):
            if value != other:
                yield f"{sheet}!{cell}: {other!r} instead of {value!r}"
        elif abs(value - other) > 1e-10 * size[units[sheet, re.match("[A-Z]+", cell)[0]]]:  # type: ignore[index]
            yield f"{sheet}!{cell}: {other!r} instead of {value!r}"


def without_iterations(name: str, found: Iterator[str]) -> list[str]:
    """Tables that list the steps or the ends of an iteration hold numbers, which follow no input."""
    stale = ("3 Find!", "4 Find from") if name == "slotted_link" else ("3.2 ",) if name == "joint" else ()
    return [text for text in found if not text.startswith(stale)] if stale else list(found)


@pytest.mark.parametrize("name", CHANGED)
def test_unchanged_every_cell_agrees(name: str, recalculated: Callable[[Path], Any]) -> None:
    path = exported(name)
    live, own = recalculated(path), load_workbook(path, data_only=True)
    assert not list(disagreements(live, own))
    verdicts = [row[4].value for row in live["Checks"].iter_rows(min_row=3)]
    assert verdicts == [row[4].value for row in own["Checks"].iter_rows(min_row=3)] and "FAIL" not in verdicts
    errors = [c.coordinate for s in live.worksheets for r in s.iter_rows() for c in r if str(c.value).startswith("#")]
    assert bool(errors) == any(str(value).startswith("#") for *_, value in numbers(own))


@pytest.mark.parametrize("name", CHANGED)
def test_changed_inputs_are_followed(name: str, recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    changes = CHANGED[name]
    path = edit(exported(name), changes, tmp_path / f"edited_{name}.xlsx")
    own = load_workbook(export(name, tmp_path, changes), data_only=True)
    assert not without_iterations(name, disagreements(recalculated(path), own))


def test_edited_workbook_is_a_scene(tmp_path: Path) -> None:
    """The changed workbook, read back, is the worksheet's run on the same inputs."""
    changes = CHANGED["hitch"]
    path = edit(exported("hitch"), changes, tmp_path / "edited.xlsx")
    sheet = cells.load(ROOT / "worksheets" / "hitch.py")
    read = reading.inputs(path, inputs.declared(sheet.inputs))
    assert inputs.build(sheet.inputs, read) == inputs.build(sheet.inputs, changes)


def test_what_does_not_close_is_not_available(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """Beyond the reach of the cylinder: #N/A from the first open position on, numbers before it."""
    path = edit(exported("hitch"), {"S_max": 0.9}, tmp_path / "open.xlsx")
    book = recalculated(path)
    for title in ("2.2 Points", "3.1 Kinematics", "4.1 Lifting capacity", "5.1 Reactions"):
        last = [cell.value for cell in book[title][14]][1:]
        assert set(last) == {"#N/A"}, title
        assert all(isinstance(cell.value, float) for cell in book[title][5]), title
    shown = {value for *_, value in numbers(book) if isinstance(value, str)}
    assert shown == {"#N/A"}
    verdicts = {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=3)}
    assert verdicts["group (2, 3) closes"] == "FAIL"


def test_every_table_of_the_hitch_is_live() -> None:
    book = load_workbook(exported("hitch"))
    plain = [(s, c) for s, c, value in numbers(book) if not str(value).startswith("=")]
    assert not plain
    assert "P6_*IS6_" in str(book["4.1 Lifting capacity"]["B5"].value)


def test_values_stand_beside_the_formulas(tmp_path: Path) -> None:
    """pandas, which computes nothing, reads the worksheet's numbers to the last bit, which is the processor's."""
    path = export("hitch", tmp_path, {})
    read = pd.read_excel(path, sheet_name="4.1 Lifting capacity", header=2, skiprows=[3])
    own = cells.evaluate(ROOT / "worksheets" / "hitch.py", ["table_41"])["table_41"].frame()
    assert read["GS6"].head(10).tolist() == own["GS6 [N]"].tolist()


def test_number_of_positions_is_that_of_the_workbook(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """Rows cannot grow: another number of positions is told, not computed wrongly."""
    path = edit(exported("hitch"), {"N_pol": 12}, tmp_path / "more.xlsx")
    rows = {row[0].value: row[4].value for row in recalculated(path)["Checks"].iter_rows(min_row=3)}
    assert rows["made for these inputs: where this fails, export the worksheet again"] == "FAIL"


def test_found_value_without_a_closed_form_shows_what_it_leaves(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    source = (ROOT / "worksheets" / "hitch.py").read_text(encoding="utf-8")
    start, end = source.index("    phi5_p = "), source.index("    typeset(S_p_found, checks_S_p)")
    shorter = source[:start] + source[end:]
    shorter = shorter.replace("    checks_S_p,\n", "").replace(", checks_S_p", "")
    (tmp_path / "worksheets").mkdir()
    (tmp_path / "worksheets" / "hitch.py").write_text(shorter, encoding="utf-8")
    run = [sys.executable, "-X", "utf8", tmp_path / "worksheets" / "hitch.py", f"--out={tmp_path}"]
    subprocess.run(run, check=True, capture_output=True)
    before = recalculated(tmp_path / "hitch.xlsx")["Find"]
    after = recalculated(edit(tmp_path / "hitch.xlsx", {"Y_P56": 0.41}, tmp_path / "edited.xlsx"))["Find"]
    assert [row[9].value for row in after.iter_rows(min_row=3)] == ["its closed form", "found", "its closed form"]
    assert math.isclose(after["B4"].value, before["B4"].value, rel_tol=1e-14) and abs(before["E4"].value) < 1e-12
    assert math.isclose(after["E4"].value, -0.01, rel_tol=1e-9)
    rules = load_workbook(tmp_path / "hitch.xlsx")["Find"].conditional_formatting
    assert any("E4" in str(rule.sqref) for rule in rules)


def test_names_are_no_addresses_and_differ_in_more_than_case() -> None:
    names = DefinedNames()
    given = ["L3", "X01", "P56", "phi12", "R", "c", "r1c1", "a", "A", "S_p", "s_p", "IS6", "XFD1", "dphi3", "L_3"]
    new = [names.new(name) for name in given]
    assert new == [
        *("L3_", "X01_", "P56_", "phi12_", "R_", "c_", "r1c1_", "a", "A_", "S_p", "s_p_", "IS6_", "XFD1_", "dphi3"),
        "L_3",
    ]


def test_stored_names_are_accepted() -> None:
    """openpyxl, which knows Excel's rule for addresses, takes every defined name of every worksheet for a name."""
    from openpyxl.formula import Tokenizer

    for path in sorted((ROOT / "exports").glob("*.xlsx")):
        for name in load_workbook(path).defined_names:
            (token,) = Tokenizer(f"={name}").items
            assert token.subtype == "RANGE" and not re.fullmatch(r"\$?[A-Z]{1,3}\$?\d+", name, re.IGNORECASE)


def test_a_change_is_seen(tmp_path: Path) -> None:
    """The comparison itself sees a wrong number and a lost error value."""

    def book(*cells: Any) -> Any:
        made = Workbook()
        made.worksheets[0].title = "1 Table"
        for row in (["Table"], [], ["a"], ["m"], *([c] for c in cells)):
            made.worksheets[0].append(row)
        return made

    assert not list(disagreements(book(1.0, 2.0), book(1.0, 2.0)))
    assert list(disagreements(book(1.0, 2.0 + 1e-9), book(1.0, 2.0)))
    assert list(disagreements(book(1.0, 2.0), book(1.0, "#N/A")))
