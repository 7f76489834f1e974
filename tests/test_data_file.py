"""A data file beside a worksheet: found however the worksheet is run, with the place of what cannot be used in it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import chdir
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from as_script import as_script
from openpyxl import Workbook
from playwright.sync_api import expect

from mechsheet import evaluate, load
from mechsheet.run import arguments
from mechsheet.worksheet import inputs
from mechsheet.worksheet.errors import SheetError

SHEET = '''import marimo

app = marimo.App()

with app.setup:
    from numpy import trapezoid

    from mechsheet import ask, export, from_file, inputs, read, table, typeset

    @inputs
    class Gas:
        V: float  # [cm**3] volume; > 0
        p: float  # [bar] pressure

        """A row of the file."""


@app.class_definition
@inputs
class Engine:
    gas: list[Gas] = from_file("gas.csv")  # pressure over the volume

    """Inputs."""


@app.cell
def form():
    form = ask(Engine)
    return (form,)


@app.cell
def given(form):
    g = read(Engine, form)
    return (g,)


@app.cell
def work(g):
    W = trapezoid(g.gas.p, g.gas.V)  # [J] work of the gas
    p = g.gas.p  # [bar] pressure
    typeset()
    return W, p


@app.cell
def results(W, p):
    table_1 = table("1", "Work", p, W)
    return (table_1,)


@app.cell
def workbook():
    export("Engine", globals())
    return


if __name__ == "__main__":
    app.run()
'''
GAS = "# measured\nphi [deg];V [l];p [bar]\n0;0,1;20\n\n10;0,2;10,5\n20;0,4;4\n"
WORK = float(np.trapezoid([20e5, 10.5e5, 4e5], [1e-4, 2e-4, 4e-4]))


@pytest.fixture
def engine(tmp_path: Path) -> Path:
    folder = tmp_path / "engines"
    folder.mkdir()
    (folder / "gas.csv").write_text(GAS.replace("[l]", "[dm**3]"), encoding="utf-8-sig")
    (folder / "engine.py").write_text(SHEET, encoding="utf-8")
    return folder / "engine.py"


@pytest.mark.parametrize("folder", [".", "engines"])
def test_the_file_is_found_from_any_folder(engine: Path, tmp_path: Path, folder: str) -> None:
    assert evaluate(engine, ["W"])["W"] == pytest.approx(WORK, rel=1e-14)
    (tmp_path / "gas.csv").write_text(
        "V [cm**3], p [bar]\n1,1\n2,1\n", encoding="utf-8"
    )  # of the folder, not the worksheet
    with chdir(tmp_path / folder):
        done = as_script(engine, "--out=.")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / folder / "engine.xlsx").exists()


def test_a_file_that_has_changed_is_read_again(engine: Path) -> None:
    """As in a session of Python, or behind a page that is open: what was read before would be computed with."""
    file = engine.with_name("gas.csv")
    text, work = file.read_text(encoding="utf-8"), evaluate(engine, ["W"])["W"]
    file.write_text(f"{text}30;0,8;4\n", encoding="utf-8")
    assert evaluate(engine, ["W"])["W"] == pytest.approx(work + 4e5 * 4e-4, rel=1e-14)
    file.unlink()
    with pytest.raises(SheetError, match=r"gas\.csv cannot be read"):
        load(engine)
    file.write_text(text, encoding="utf-8")
    assert evaluate(engine, ["W"])["W"] == work


def test_another_file_is_given_by_a_scene_beside_it(engine: Path, tmp_path: Path) -> None:
    book = Workbook()
    for row in (["V [cm**3]", "p [MPa]"], [100, 3], [300, "1,5"]):
        book.active.append(row)
    (tmp_path / "scenes").mkdir()
    book.save(tmp_path / "scenes" / "hot.xlsx")
    scene = tmp_path / "scenes" / "hot.toml"
    scene.write_text('want = ["W"]\n[inputs]\ngas = "hot.xlsx"\n', encoding="utf-8")
    sheet = load(engine)
    g: Any = inputs.build(sheet.inputs, arguments.load(scene, inputs.declared(sheet.inputs)).inputs)
    assert g.gas.p.tolist() == pytest.approx([3e6, 1.5e6], rel=1e-14)
    assert g.gas.V.tolist() == pytest.approx([1e-4, 3e-4], rel=1e-14)
    (engine.parent / "other.csv").write_text("V,p\n100,20\n200,10\n", encoding="utf-8")
    assert evaluate(engine, ["W"], gas="other.csv")["W"] == pytest.approx(150.0, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("V [cm**3];p [bar]\n100;x\n", "row 2, column p: pressure gas.p (1) = 'x' bar is no number"),
        (
            "V;p\n100;1\n\n200;\n",
            "row 4, column p: pressure gas.p (2) = '' bar is no number: fill it or leave out the row",
        ),
        (
            "V [cm**3];p\n100;NaN\n",
            "row 2, column p: pressure gas.p (1) = 'NaN' bar is no number: fill it or leave out",
        ),
        ("V;p\n100;1\n\n-5;2\n", "row 4, column V: volume gas.V (2) = -5.0 cm³ must be positive"),
        ("V;q\n100;1\n", "row 1: no column p; it has V, q"),
        ("V (l);p (bar)\n1;1\n", "row 1: no column V; it has no names such as V [unit], but V (l), p (bar)"),
        ("V;p;p\n100;1;1\n", "row 1: column p stands there twice"),
        ("V;p\n100;1;7\n", "row 2: 3 values under 2 names of columns"),
        ("V,p\n1,5,3\n", "row 2: 3 values under 2 names of columns"),
        ("V [cm];p\n100;1\n", "row 2, column V: volume gas.V (1) = '100 cm': cm does not measure cm³"),
        ("V [parsec**3];p\n100;1\n", "row 2, column V: "),
        ("", "is empty"),
        ("V;p\n100;1\n#N/A;2\n", "row 3, column V: volume gas.V (2) = '#N/A' cm³ is no number: fill it"),
        ("V [-];p\n100;1\n", "row 1, column V: - does not measure cm³"),
        ("V;p\n100,5;1.250\n", "row 2, column p: 1.250 may be 1250 or 1.250: write it without a sign between"),
        ('V,p\n"1,250",1\n', "row 2, column V: 1,250 may be 1250 or 1.250: write it"),
        ('V,p\n"1,250",2.5\n', "row 2, column V: 1,250 may be 1250 or 1.250: write it"),
    ],
)
def test_what_cannot_be_used_is_one_line_with_its_place(engine: Path, text: str, message: str) -> None:
    (engine.parent / "bad.csv").write_text(text, encoding="utf-8")
    with pytest.raises(SheetError) as error:
        evaluate(engine, ["W"], gas="bad.csv")
    assert str(error.value).startswith(f"file {engine.parent / 'bad.csv'}") and message in str(error.value)
    assert "fill it" not in str(error.value) or "fill it" in message
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "text",
    [
        "sep=;\nV;p\n100;20\n200;10,5\n400;4\n;;\n;\n",  # empty rows, as spreadsheet programs write them below the last
        "V;p\n100,000;20\n200,000;10,5\n400,000;4\n",  # three decimals among others with a comma
        "V;p\n100.000;20.000\n200.000;10.500\n400.000;4.000\n",
        'V,p\n100,20\n200,"10,5"\n400,4\n',
    ],
)
def test_cells_as_programs_write_them(engine: Path, text: str) -> None:
    (engine.parent / "other.csv").write_text(text, encoding="utf-8")
    assert evaluate(engine, ["W"], gas="other.csv")["W"] == pytest.approx(WORK, rel=1e-14)


def test_per_cent_are_read_as_they_are_shown(engine: Path) -> None:
    """A cell that shows 85 % holds 0.85, which was taken for 0.85 %; so was 0.85 under a head that says [-]."""
    sheet = engine.with_name("share.py")
    text = SHEET.replace("p: float  # [bar]", "p: float  # [%]").replace("gas.csv", "own.csv")
    engine.with_name("own.csv").write_text("V;p\n1;1\n2;2\n", encoding="utf-8")
    sheet.write_text(text.replace("[J] work", "[cm**3] work").replace("p = g.gas.p  # [bar]", "p = g.gas.p  # [%]"))
    for head in ("p [%]", "p"):
        book = Workbook()
        for row in (["V", head], [100, 0.85], [300, 0.85]):
            book.active.append(row)
        for cell in ("B2", "B3"):
            book.active[cell].number_format = "0.0%"
        book.save(engine.with_name("share.xlsx"))
        assert evaluate(sheet, ["p"], gas="share.xlsx")["p"].tolist() == [0.85, 0.85]
    for cells in ("p [%]\n100;85%\n300;85 %\n", "p [-]\n100;0,85\n300;0.85\n"):
        engine.with_name("share.csv").write_text(f"V;{cells}", encoding="utf-8")
        assert evaluate(sheet, ["p"], gas="share.csv")["p"].tolist() == [0.85, 0.85]


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("none.csv", None, "cannot be read"),
        ("gas.ods", b"PK", r"gas\.ods cannot be read: save it as \.csv or \.xlsx"),
        ("bytes.csv", b"\xff\xfe\x00", "is no text in UTF-8"),
        ("bad.xlsx", b"nothing", "is no Excel workbook, or damaged"),
    ],
)
def test_a_file_that_cannot_be_read_is_named(engine: Path, name: str, data: bytes | None, message: str) -> None:
    if data is not None:
        (engine.parent / name).write_bytes(data)
    with pytest.raises(SheetError, match=message):
        evaluate(engine, ["W"], gas=name)


def test_a_missing_file_of_the_worksheet_itself_is_one_line(engine: Path) -> None:
    (engine.parent / "gas.csv").unlink()
    done = as_script(engine)
    assert done.returncode == 1
    assert "gas.csv cannot be read" in done.stderr and "Traceback" not in done.stderr


def test_the_file_is_found_by_the_editor_from_another_folder(
    serve: Callable[[str, Path], str], page: Any, console_errors: list[str], engine: Path
) -> None:
    text = SHEET.replace("    form = ask(Engine)\n", "    form = ask(Engine)\n    form\n")
    text = text.replace("W)\n    return (table_1,)", "W)\n    table_1\n    return (table_1,)")
    engine.write_text(text, encoding="utf-8")
    page.goto(serve("edit", engine))
    cell = page.locator(".ms-table:has-text('Table 1 ') tbody tr").last.locator("td").last
    expect(cell).to_have_text(f"{WORK:.3f}")
    assert console_errors == []
