"""Scenes and workbooks as they should not be: damaged, cut short, endless. Each is one line, and soon."""

from __future__ import annotations

import io
import random
import re
import zipfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from mechsheet.run import arguments, report
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError

SHEET = load(Path(__file__).parents[1] / "worksheets" / "guide.py")
FIELDS = inputs.declared(SHEET.inputs)
INPUTS = "xl/worksheets/sheet2.xml"  # behind the front sheet


@pytest.fixture(scope="module")
def exported() -> bytes:
    return report.workbook("Guide", SHEET.run(SHEET.results, {"g": SHEET.inputs()}), {})


def changed(book: bytes, part: str, change: Callable[[str], str]) -> bytes:
    """The workbook with a part of it changed, and none compressed, which takes longer than to read it."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as new:
        for name, data in parts(book).items():
            new.writestr(name, change(data.decode()).encode() if name == part else data)
    return out.getvalue()


@cache
def parts(book: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(book)) as old:
        return {name: old.read(name) for name in old.namelist()}


def rows(text: str) -> Callable[[str], str]:
    """Rows put behind those of a sheet."""
    return lambda sheet: sheet.replace("</sheetData>", text + "</sheetData>")


def without(symbol_row: int) -> Callable[[str], str]:
    return lambda sheet: re.sub(rf'<row r="{symbol_row}".*?</row>', "", sheet, flags=re.DOTALL)


def cell(reference: str, text: str) -> str:
    row = re.sub(r"\D", "", reference)
    return f'<row r="{row}"><c r="{reference}" t="inlineStr"><is><t>{text}</t></is></c></row>'


def answer(data: bytes, path: Path) -> str:
    """What a scene of that file comes to: its error, which is one short line, or nothing."""
    path.write_bytes(data)
    try:
        arguments.read([f"--scene={path}"], FIELDS)
    except SheetError as error:
        text = str(error)
        assert "\n" not in text and len(text) < 300 + len(str(path)), text
        assert str(path) in text
        return text
    return ""


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (f"[inputs]\nL1 = {'9' * 5000}\n", "a whole number of thousands of digits"),
        (f"[inputs]\nL1 = {'[' * 2000}{']' * 2000}\n", "brackets are nested too deep"),
        (f"[inputs]\nL1 = [0x{'f' * 5000}]\n", "must be one value"),
        (f"[limits]\nL1 = 0x{'f' * 5000}\n", "must be {min = NUMBER}"),
        (f"want = 0x{'f' * 5000}\n", "must be a list of names"),
        (f"inputs = 0x{'f' * 5000}\n", "must be a table"),
        (f"{'a' * 5000} = 1\n", "may hold [inputs], want, proof and [limits] and nothing else"),
        ("[inputs\n", "no valid TOML"),
    ],
    ids=lambda text: text[:20],
)
def test_a_scene_file_that_cannot_be_used_is_one_line(text: str, says: str, tmp_path: Path) -> None:
    assert says in answer(text.encode(), tmp_path / "scene.toml")


def test_a_number_of_any_length_is_a_number(tmp_path: Path) -> None:
    with pytest.raises(SheetError, match=r"l = inf mm must be a finite number"):
        inputs.build(SHEET.inputs, {"l": 16**5000})
    with pytest.raises(SheetError, match=r"'9{59}.. \(40002 characters\): unit \[x\] is not known"):
        inputs.build(SHEET.inputs, {"l": "9" * 39_999 + "x"})


def test_a_damaged_workbook_is_one_line_or_what_is_left_of_it(exported: bytes, tmp_path: Path) -> None:
    """Cut short anywhere, bytes overwritten anywhere, in the archive and in each part of it."""
    chance, answers = random.Random(1), []
    damaged = [exported[: len(exported) * k // 8] for k in range(8)]
    for _ in range(24):
        data, at = bytearray(exported), chance.randrange(len(exported))
        data[at : at + 20] = chance.randbytes(20)
        damaged.append(bytes(data))
    ways = (lambda text: text[: len(text) // 2], lambda text: "cut", lambda text: text.replace('="', '="x'))
    for n, part in enumerate(parts(exported)):
        looked_at = part == INPUTS or not re.search("worksheets/|charts/", part)
        damaged += [changed(exported, part, way) for way in (ways if looked_at else [ways[n % 3]])]
    answers = [answer(data, tmp_path / "scene.xlsx") for data in damaged]
    assert sum(map(bool, answers)) > len(answers) / 4


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda sheet: sheet.replace("<sheetData>", "<sheetData>&unknown;"), "damaged: undefined entity"),
        (lambda sheet: sheet[: len(sheet) // 2], "damaged: "),
        (rows(cell("A40", "x" * 40_000)), ""),  # far below the last input: not read
        (rows(cell("XFD1048576", "1")), ""),
    ],
    ids=["entity", "cut short", "long text", "far cell"],
)
def test_what_is_odd_in_the_sheet_of_inputs(
    change: Callable[[str], str], says: str, exported: bytes, tmp_path: Path
) -> None:
    told = answer(changed(exported, INPUTS, change), tmp_path / "scene.xlsx")
    assert says in told and bool(says) == bool(told)


def test_entities_that_grow_without_end_are_refused_at_once(exported: bytes, tmp_path: Path) -> None:
    entities = "".join(f'<!ENTITY e{i + 1} "{f"&e{i};" * 10}">' for i in range(12))
    bomb = f'<!DOCTYPE worksheet [<!ENTITY e0 "x">{entities}]>'
    data = changed(exported, INPUTS, lambda sheet: sheet.replace("<worksheet", bomb + "<worksheet", 1).replace(
        "<sheetData>", "<sheetData>&e12;"
    ))  # fmt: skip
    assert "damaged: " in answer(data, tmp_path / "scene.xlsx")


def test_texts_without_end_are_refused_before_they_are_read(
    exported: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The texts of all sheets stand in one part, which is read as a whole: 3 million took a minute."""
    texts = "<si><t>" + "a" * 10_000_000 + "</t></si>"
    data = changed(exported, "xl/sharedStrings.xml", lambda part: part.replace("</sst>", texts + "</sst>"))
    opened, opening = list[str](), zipfile.ZipFile.open

    def noted(parts: zipfile.ZipFile, part: Any, *args: Any, **kwargs: Any) -> Any:
        opened.append(getattr(part, "filename", part))
        return opening(parts, part, *args, **kwargs)

    monkeypatch.setattr(zipfile.ZipFile, "open", noted)
    assert "xl/sharedStrings.xml has over 10 MB: " in answer(data, tmp_path / "scene.xlsx")
    assert "xl/sharedStrings.xml" not in opened
    answer(exported, tmp_path / "scene.xlsx")
    assert "xl/sharedStrings.xml" in opened, "as of any other workbook"


def test_a_long_value_is_shortened_in_its_line(exported: bytes, tmp_path: Path) -> None:
    def typed(sheet: str) -> str:
        return re.sub(r'<c r="B4"[^>]*>.*?</c>', f'<c r="B4" t="inlineStr"><is><t>{"7" * 40_000}x</t></is></c>', sheet)

    told = answer(changed(exported, INPUTS, typed), tmp_path / "scene.xlsx")
    assert "cell B4: " in told and "(40003 characters)" in told


def ending_in_an_input(book: bytes) -> tuple[bytes, int]:
    """The workbook without the row below the inputs, that counts what differs, and the row of the last input."""
    sheet = zipfile.ZipFile(io.BytesIO(book)).read(INPUTS).decode()
    last = max(map(int, re.findall(r'<row r="(\d+)"', sheet)))
    return changed(book, INPUTS, without(last)), last - 1


def test_rows_behind_the_last_input_are_not_read(exported: bytes, tmp_path: Path) -> None:
    """But for those that stand right below it, which are judged as any other."""
    exported, last = ending_in_an_input(exported)
    number = f'<c r="B{last + 1}"><v>1</v></c></row>'
    below = changed(exported, INPUTS, rows(cell(f"A{last + 1}", "L99").replace("</row>", number)))
    assert "L99 is no input" in answer(below, tmp_path / "scene.xlsx")
    empty, unread = f'<row r="{last + 1}"/>', f'<row r="{last + 2}"><c r="A{last + 2}"><v>no number</v></c></row>'
    broken = changed(exported, INPUTS, rows(empty + unread))
    assert answer(broken, tmp_path / "scene.xlsx") == ""


def test_a_million_empty_rows_are_not_read(exported: bytes, tmp_path: Path) -> None:
    """Where an input was taken out, no row need be the last: then they are told."""
    exported, last = ending_in_an_input(exported)
    endless = "".join(f'<row r="{last + 1 + i}" ht="15"/>' for i in range(20_000)) + "<row damaged"
    whole = changed(exported, INPUTS, rows(endless))
    assert answer(whole, tmp_path / "scene.xlsx") == ""
    told = answer(changed(whole, INPUTS, without(last)), tmp_path / "scene.xlsx")
    assert told.endswith(f"sheet Inputs: over 10000 empty rows from row {last}; delete them")
