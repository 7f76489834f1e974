"""Scenes from arguments, TOML files and workbooks that were exported and edited."""

import itertools
import subprocess
from datetime import datetime
from pathlib import Path

import pytest
from conftest import WITHIN, examples
from hypothesis import given
from hypothesis import strategies as st
from openpyxl import Workbook, load_workbook

from mechsheet.run import arguments, report
from mechsheet.workbook import reading
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.scene import Limit, Scene
from mechsheet.worksheet.text_line import TextLine
from worksheets.hitch import Hitch

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"
FIELDS = inputs.declared(Hitch)


def written(folder: Path, text: str) -> Path:
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_arguments_replace_inputs_in_their_order(tmp_path):
    file = written(tmp_path, "[inputs]\nP6 = 40e3\nphi_P6 = 85\n")
    found = arguments.read([f"--scene={file}", "--P6=30e3", "--out=somewhere"], FIELDS)
    assert found == Scene({"P6": "30e3", "phi_P6": 85}, Path("somewhere"))


def test_a_later_scene_adds_to_an_earlier_one(tmp_path):
    first = written(tmp_path, 'want = ["GS6"]\n[inputs]\nP6 = 1\n[limits]\nGS6 = {min = 1}\n')
    second = tmp_path / "second.toml"
    second.write_text("[inputs]\nP6 = 2\n[limits]\ndRa = {max = 1}\n")
    found = arguments.read([f"--scene={first}", f"--scene={second}"], FIELDS)
    assert found == Scene({"P6": 2}, None, ("GS6",), {"GS6": Limit(min=1), "dRa": Limit(max=1)})


@pytest.mark.parametrize(
    "limit, unit, found",
    [
        ('{min = "20 N", max = "0,3 kN"}', "N", Limit(20, 300)),
        ('{max = "90 °"}', "deg", Limit(max=90)),
        ('{min = "20 m"}', "N", r"limit 20 m of GS6: m does not measure N"),
        ('{min = "1 kN", max = 3}', "N", r"limit of GS6: min is above max"),
        ('{max = "3 K"}', "degC", r"limit 3 K of GS6: write it in °C, for a temperature is not a difference"),
    ],
)
def test_a_limit_is_read_with_its_unit(tmp_path, limit, unit, found):
    """As an input is: of "20 N" it was said that it is no number."""
    (read,) = arguments.read(
        [f"--scene={written(tmp_path, f'[limits]{chr(10)}GS6 = {limit}')}"], FIELDS
    ).limits.values()
    if isinstance(found, Limit):
        assert read.of("GS6", unit) == found
    else:
        with pytest.raises(SheetError, match=found):
            read.of("GS6", unit)


@pytest.mark.parametrize("argument", ["P6=3", "--P6", "--=3", "-P6=3", "--scene", "--tolerances=", ""])
def test_other_forms_are_refused(argument):
    with pytest.raises(SheetError, match="must be --NAME=VALUE") as error:
        arguments.read([argument], FIELDS)
    assert all(form in str(error.value) for form in ("--proof", "--proof=DIGITS", "--tolerances"))


def test_what_is_empty_is_read_as_the_input_it_is_given_to():
    with pytest.raises(SheetError, match="P6 = '' N is no number"):
        arguments.read(["--P6="], FIELDS)
    note = TextLine("note", "-", "who asked for it", "", False, ())
    assert arguments.read(["--note="], [note]).inputs == {"note": ""}


def test_all_parts_of_a_scene_file(tmp_path):
    text = """
        want = ["GS6", "abs(R56)"]
        [inputs]
        P6 = "27500,5"
        [limits]
        GS6 = {min = "30,5", max = 4e4}
        "loop of group (2, 3)" = {max = 1e-9}
    """
    limits = {"GS6": Limit(30.5, 4e4), "loop of group (2, 3)": Limit(max=1e-9)}
    assert arguments.load(written(tmp_path, text), FIELDS) == Scene(
        {"P6": "27500,5"}, None, ("GS6", "abs(R56)"), limits
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[inputs\n", "is no valid TOML"),
        ("[inputs]\nP6 = 27,5\n", r'is no valid TOML: .*; a number with a comma stands in quotes: "27,5"'),
        ("P6 = 3\n", r"may hold \[inputs\], want, proof and \[limits\] and nothing else; it has P6"),
        ("", r"may hold \[inputs\], want, proof and \[limits\] and nothing else; it is empty"),
        ("inputs = 3\n", r"inputs = 3 must be a table \[inputs\]"),
        ("[inputs]\nP6 = [1, 2]\n", r"input P6 = \[1, 2\] must be one value"),
        ("[inputs.P6]\nmin = 1\n", r"input P6 = \{'min': 1\} must be one value"),
        ('want = "GS6"\n', r"want = 'GS6' must be a list of names"),
        ("want = []\n", r"want = \[\] must be a list of names"),
        ("want = [6]\n", r"want = \[6\] must be a list of names"),
        ("[inputs]\nP6 = 3\nP6 = 4\n", r"is no valid TOML: .*; P6 is given twice"),
        ('[inputs]\n"\u00b5" = 3\n"\u03bc" = 4\n', r"\u03bc is given twice"),  # the second one counted silently
        ('[limits]\n"\u00b5" = {min = 3}\n"\u03bc" = {min = 1}\n', r"\u03bc is given twice"),
        ("limits = 1\n", r"limits = 1 must be a table \[limits\]"),
        ("[limits]\nGS6 = 3\n", r"limit GS6 = 3 must be \{min = NUMBER\}, \{max = NUMBER\} or both"),
        ("[limits]\nGS6 = {least = 3}\n", r"limit GS6 = \{'least': 3\} must be \{min"),
        ("[limits]\nGS6 = {}\n", r"limit GS6 = \{\} must be \{min"),
        ('[limits]\nGS6 = {min = "much"}\n', r"limit GS6 = .*: 'much' is no number"),
        ("[limits]\nGS6 = {min = nan}\n", r"limit GS6 = .*: nan is no number"),
        ("[limits]\nGS6 = {min = 2, max = 1}\n", r"limit GS6 = .*: min is above max"),
    ],
)
def test_bad_scene_file_is_named(tmp_path, text, message):
    file = written(tmp_path, text)
    with pytest.raises(SheetError, match=message) as error:
        arguments.read([f"--scene={file}"], FIELDS)
    assert str(file) in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize("encoding", ["utf-16", "latin-1"])
def test_another_encoding_is_told(tmp_path, encoding):
    file = tmp_path / "scene.toml"
    file.write_bytes("[inputs]\nP6 = 3 # größer\n".encode(encoding))
    with pytest.raises(SheetError, match=r"scene\.toml is no text in UTF-8: save it in that encoding"):
        arguments.read([f"--scene={file}"], FIELDS)


def test_a_spreadsheet_of_another_kind_is_told_as_one(tmp_path):
    (tmp_path / "hitch.ods").write_bytes(b"PK\x03\x04\xff")
    with pytest.raises(SheetError, match=r"hitch\.ods is a spreadsheet that cannot be read: save it as \.xlsx"):
        arguments.read([f"--scene={tmp_path / 'hitch.ods'}"], FIELDS)


@pytest.mark.parametrize("name", ["none.toml", "none.xlsx"])
def test_missing_scene_file_is_named(tmp_path, name):
    with pytest.raises(SheetError, match=rf"{name} cannot be read: No such file"):
        arguments.read([f"--scene={tmp_path / name}"], FIELDS)


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Workbook of the hitch on other inputs than its own."""
    sheet, file = load(HITCH), tmp_path_factory.mktemp("exported") / "hitch.xlsx"
    g = inputs.build(Hitch, {"P6": 20000.5, "phi_P6": 85, "N_pol": 4, "X6": "0,1234567890123456789"})
    file.write_bytes(report.workbook("Hitch", sheet.run(sheet.results, {"g": g}), {}))
    return file


def test_exported_workbook_reads_back_to_the_very_same_inputs(exported):
    found = inputs.build(Hitch, reading.inputs(exported, FIELDS))
    assert found == inputs.build(Hitch, {"P6": 20000.5, "phi_P6": 85, "N_pol": 4, "X6": "0,1234567890123456789"})


@given(st.floats(1, 179, exclude_min=True), st.floats(-2, 2))
@examples(100)
def test_inputs_written_in_display_units_are_read_back_to_the_last_bit(angle, length):
    g = inputs.build(Hitch, {"phi_P6": angle, "X6": length})
    shown = {field.name: value for field, value in inputs.Used(g).rows()}
    assert inputs.build(Hitch, shown) == g


class Edited:
    """The sheet of inputs of an exported workbook, to be changed as a user would."""

    def __init__(self, source: Path, path: Path) -> None:
        self.book, self.path = load_workbook(source), path
        self.sheet = self.book["Inputs"]

    def cell(self, name: str, heading: str):
        head = next(row for row in self.sheet.iter_rows() if any(c.value == "Symbol" for c in row))
        column = next(c.column for c in head if c.value == heading)
        symbol = next(c.column for c in head if c.value == "Symbol")
        rows = range(head[0].row, self.sheet.max_row + 1)
        return self.sheet.cell(next(r for r in rows if self.sheet.cell(r, symbol).value == name), column)

    def read(self) -> dict[str, object]:
        self.book.save(self.path)
        return reading.inputs(self.path, FIELDS)


@pytest.fixture(scope="module")
def sheet_of_inputs(exported: Path) -> Path:
    """The exported workbook without its other sheets, which take nine tenths of the time to be read and saved."""
    book = load_workbook(exported)
    for sheet in book.sheetnames:
        if sheet != "Inputs":
            del book[sheet]
    book.save(path := exported.with_name("inputs.xlsx"))
    return path


@pytest.fixture
def edit(sheet_of_inputs: Path, tmp_path: Path) -> Edited:
    return Edited(sheet_of_inputs, tmp_path / "edited.xlsx")


@pytest.mark.parametrize(("typed", "value"), [(30e3, 30e3), ("30000,5", 30000.5), (" 3e4 ", 3e4), (31000, 31000)])
def test_a_number_or_a_text_of_one_may_be_typed(edit, typed, value):
    edit.cell("P6", "Value").value = typed
    P6 = inputs.build(Hitch, edit.read()).P6
    assert value == P6


def test_rows_and_columns_may_be_inserted_and_rows_taken_out(edit):
    edit.cell("P6", "Value").value = 1234
    edit.sheet.delete_rows(edit.cell("X6", "Value").row)
    edit.sheet.insert_rows(3, 2)
    edit.sheet.insert_cols(2)
    found = edit.read()
    assert found["P6"] == 1234 and "X6" not in found and len(found) == len(FIELDS) - 1


@pytest.mark.parametrize(
    ("name", "heading", "typed", "message"),
    [
        ("P6", "Value", "heavy", "weight of the implement P6 = 'heavy' N is no number"),
        ("P6", "Value", "1 000", "weight of the implement P6 = '1 000' N is no number"),
        ("P6", "Value", "#N/A", "weight of the implement P6 = '#N/A' N is no number"),
        ("P6", "Value", True, "weight of the implement P6 = True N is no number"),
        ("P6", "Value", datetime(2024, 5, 1), "weight of the implement P6 = 2024-05-01 00:00:00 N is no number"),
        ("P6", "Value", None, "P6: the value is missing"),
        ("k_gc", "Value", None, "k_gc: the value is missing"),
        ("P6", "Value", "=2*13750", "P6: the formula =2*13750 has no value; open and save the file"),
        ("P6", "Symbol", "P66", "P66 is no input; nearest: P6"),
        ("P6", "Symbol", None, "an empty cell is no input"),
        ("L6", "Symbol", "L5", "L5 stands in A"),
        ("P6", "Unit", "mm", "mm is not the unit of P6, which is N: weight of the implement P6 = "),
        ("P6", "Unit", None, "an empty cell is not the unit of P6, which is N"),
    ],
)
def test_what_cannot_be_used_is_named_with_its_cell(edit, name, heading, typed, message):
    cell = edit.cell(name, heading)
    cell.value = typed
    with pytest.raises(SheetError) as error:
        edit.read()
    start = f"workbook {edit.path}, cell {cell.coordinate}: "
    assert str(error.value).startswith(start + message), str(error.value)


def test_a_number_shown_in_per_cent_is_no_other_one_without_a_word(edit):
    """A spreadsheet program shows 85% for what is typed so in a cell of its own format, and holds 0.85."""
    assert edit.cell("P6", "Value").number_format != "General"  # which would be made per cent by what is typed
    for name, unit in (("P6", "N"), ("eta", "-")):
        cell = edit.cell(name, "Value")
        cell.value, cell.number_format = 0.85, "0.00%"
        if unit == "-":
            assert edit.read()[name] == 0.85
        else:
            for form in ("0.00%", "0%_)"):  # as accounts have it
                cell.number_format = form
                with pytest.raises(SheetError, match=rf"{cell.coordinate}: .*P6 = 0.85 N is shown as 85 %: type 85"):
                    edit.read()
            cell.number_format = "General"


@pytest.mark.parametrize(("value", "unit"), [(27.5, "kN"), ("27,5 kN", "N"), ("27.5 kN", None), (2.75, "MN*cm/m")])
def test_a_unit_typed_beside_a_value_or_behind_it_is_converted(edit, value, unit):
    edit.cell("P6", "Value").value = value
    if unit:
        edit.cell("P6", "Unit").value = unit
    (p6,) = [field for field in FIELDS if field.name == "P6"]
    assert p6.read(edit.read()["P6"]) == 27500


@pytest.mark.parametrize(
    ("unit", "why"), [("mm", "mm does not measure N"), ("kn", "unit [kn] is not known; nearest: kN")]
)
def test_a_unit_that_does_not_fit_is_told_with_both(edit, unit, why):
    edit.cell("P6", "Unit").value = unit
    with pytest.raises(SheetError) as error:
        edit.read()
    assert f"{unit} is not the unit of P6, which is N" in str(error.value) and why in str(error.value)


def test_a_workbook_without_the_sheet_or_its_headings_is_named(edit, tmp_path):
    edit.cell("Symbol", "Value").value = "Wert"
    with pytest.raises(SheetError, match=r"edited\.xlsx, sheet Inputs: no row has the headings Symbol, Value, Unit"):
        edit.read()
    other = tmp_path / "other.xlsx"
    Workbook().save(other)
    with pytest.raises(SheetError, match=r"other\.xlsx has no sheet Inputs; it has Sheet"):
        reading.inputs(other, FIELDS)
    other.write_text("P6;3")
    with pytest.raises(SheetError, match=r"other\.xlsx is no Excel workbook"):
        reading.inputs(other, FIELDS)


def test_libreoffice_saves_what_is_read_back(exported, soffice, tmp_path):
    """Also a formula that the user typed: the program stores its value."""
    book = load_workbook(exported)
    Edited.cell(type("", (), {"sheet": book["Inputs"]}), "P6", "Value").value = "=2*13750.25"
    typed = tmp_path / "typed.xlsx"
    book.save(typed)
    out = tmp_path / "saved"
    convert = ["--headless", "--convert-to", "xlsx:Calc MS Excel 2007 XML", "--outdir", str(out), str(typed)]
    profile = f"-env:UserInstallation={(tmp_path / 'profile').as_uri()}"
    subprocess.run([soffice, profile, *convert], check=True, capture_output=True, timeout=WITHIN)
    found, before = (reading.inputs(path, FIELDS) for path in (out / "typed.xlsx", exported))
    assert found.pop("P6") == 27500.5
    texts = {name for name, value in before.items() if isinstance(value, str)}
    assert {name: found[name] for name in texts} == {name: before[name] for name in texts}
    different = [n for n in found if n not in texts and found[n] != pytest.approx(before[n], rel=1e-14)]
    assert not different and set(found) == set(itertools.chain(before)) - {"P6"}
