"""Inputs that are no plain numbers: choices, switches and texts, wherever an input is given or shown."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from contextlib import chdir
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from as_script import as_script
from cells import run
from test_recalculation import disagreements, edit
from written_cells import Values

from mechsheet import Used, evaluate, load, sensitivity, sweep
from mechsheet.html import fields as html_fields
from mechsheet.html import values as html_values
from mechsheet.page import fields as page_fields
from mechsheet.page import values as page_values
from mechsheet.recording.dimensions import mismatches
from mechsheet.recording.record import record
from mechsheet.run import arguments
from mechsheet.studies.sweep import grid
from mechsheet.workbook import reading
from mechsheet.worksheet import inputs
from mechsheet.worksheet.errors import SheetError

SHEET = '''import marimo

app = marimo.App()

with app.setup:
    from typing import Literal

    from numpy import linspace, pi, where

    from mechsheet import ask, check, one_of, export, inputs, read, table, typeset
    from mechsheet.units import MPa, kN, mm

    @inputs
    class Grade:
        R_m: float  # [MPa] tensile strength; > 0
        R_e: float  # [MPa] yield strength; > 0

    GRADES = {
        "8.8": Grade(800 * MPa, 640 * MPa),
        "10.9": Grade(1040 * MPa, 940 * MPa),
        "12.9": Grade(1220 * MPa, 1100 * MPa),
    }


@app.class_definition
@inputs
class Bolt:
    # 1.1 Bolt
    d: float = 10 * mm  # [mm] diameter; > 0
    grade: Grade = one_of(GRADES, "8.8")  # grade of the bolt
    shear: Literal["single", "double"] = "single"  # planes of shear
    threaded: bool = True  # thread in the plane of shear
    F: float = 5 * kN  # [kN] force
    project: str = "Bridge 7"  # name of the project

    """Inputs."""


@app.cell
def form():
    form = ask(Bolt)
    return (form,)


@app.cell
def given(form):
    g = read(Bolt, form)
    return (g,)


@app.cell
def strength(g):
    n = 2 if g.shear == "double" else 1  # [-] planes of shear
    k = where(g.threaded, 0.78, 1)  # [-] part of the area
    A = k * n * pi * g.d**2 / 4  # [mm**2] area
    tau = g.F / A  # [MPa] stress
    alpha, gamma = {"8.8": (0.6, 1.25), "10.9": (0.5, 1.25), "12.9": (0.5, 1.3)}[g.grade]
    U = gamma * tau / (alpha * g.grade.R_m)  # [-] use
    x = linspace(0, 1, 3)  # [-] part of the force
    U_x = x * U  # [-] use over the force
    R = g.grade.R_e / g.grade.R_m  # [-] ratio of the strengths
    typeset()
    return R, U, U_x, x


@app.cell
def results(R, U_x, g, x):
    table_1 = table("1", f"Use, {g.project}", x, U_x, R)
    return (table_1,)


@app.cell
def workbook():
    export("Bolt", globals())
    return


if __name__ == "__main__":
    app.run()
'''
MPA = 1e6
STRENGTH = {"8.8": (800, 0.6, 1.25), "10.9": (1040, 0.5, 1.25), "12.9": (1220, 0.5, 1.3)}


def use(grade: str = "8.8", shear: str = "single", threaded: bool = True, F: float = 5.0) -> float:
    """What the worksheet computes, by hand."""
    area = (0.78 if threaded else 1) * (2 if shear == "double" else 1) * np.pi * 0.01**2 / 4
    R_m, alpha, gamma = STRENGTH[grade]
    return float(gamma * F * 1e3 / area / (alpha * R_m * MPA))


@pytest.fixture(scope="module")
def bolt(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "bolt.py"
    path.write_text(SHEET, encoding="utf-8")
    return path


def script(path: Path, *given: str) -> subprocess.CompletedProcess[str]:
    with chdir(path.parent):
        return as_script(path, *given)


@pytest.mark.parametrize(
    "given",
    [{}, {"grade": "10.9"}, {"grade": "12,9"}, {"shear": "double", "threaded": "no"}, {"threaded": False, "F": "7,5"}],
)
def test_each_kind_computes_what_is_given(bolt: Path, given: dict[str, Any]) -> None:
    typed = {"8.8": "8.8"} | {"12,9": "12.9"}
    by_hand: dict[str, Any] = {**given}
    if "grade" in given:
        by_hand["grade"] = typed.get(given["grade"], given["grade"])
    if given.get("threaded") == "no":
        by_hand["threaded"] = False
    if "F" in given:
        by_hand["F"] = 7.5
    assert evaluate(bolt, ["U"], **given)["U"] == pytest.approx(use(**by_hand), rel=1e-14)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"grade": "9.8"}, "grade of the bolt grade = '9.8' must be one of 8.8, 10.9, 12.9"),
        ({"grade": ""}, "grade of the bolt grade = '' must be one of 8.8, 10.9, 12.9"),
        ({"grade": None}, "grade of the bolt grade = None must be one of 8.8, 10.9, 12.9"),
        ({"grade": True}, "grade of the bolt grade = True must be one of 8.8, 10.9, 12.9"),
        ({"grade": ["8.8"]}, "grade of the bolt grade = ['8.8'] must be one of 8.8, 10.9, 12.9"),
        (
            {"grade": "x" * 999},
            f"grade of the bolt grade = '{'x' * 59}.. (1001 characters) must be one of 8.8, 10.9, 12.9",
        ),
        ({"shear": "Double"}, "planes of shear shear = 'Double' must be one of single, double"),
        ({"shear": 2}, "planes of shear shear = 2 must be one of single, double"),
        ({"threaded": "perhaps"}, "thread in the plane of shear threaded = 'perhaps' must be yes or no"),
        ({"threaded": 2}, "thread in the plane of shear threaded = 2 must be yes or no"),
        ({"threaded": float("nan")}, "thread in the plane of shear threaded = nan must be yes or no"),
        (
            {"project": "x" * 201},
            f"name of the project project = '{'x' * 59}.. (203 characters) must be a line of at most 200",
        ),
        ({"project": "a\x00b"}, r"name of the project project = 'a\x00b' must be a line of at most 200 characters"),
        ({"project": [1]}, "name of the project project = [1] must be a line of at most 200 characters"),
        ({"graed": "8.8"}, "input graed is unknown; nearest: grade"),
    ],
)
def test_bad_input_is_one_line(bolt: Path, given: dict[str, Any], message: str) -> None:
    with pytest.raises(SheetError) as error:
        evaluate(bolt, ["U"], **given)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)


def test_a_name_that_is_no_option_is_told_where_it_is_compared(bolt: Path) -> None:
    g: Any = load(bolt).inputs()
    assert g.shear == "single" and g.shear != "double" and f"{g.shear:>8}" == "  single"
    with pytest.raises(ValueError, match="'dobule' is none of the options single, double"):
        assert g.shear == "dobule"
    with pytest.raises(AttributeError, match="an option has no property R_p; it has R_m, R_e"):
        assert g.grade.R_p


def test_inputs_of_all_kinds_are_values(bolt: Path) -> None:
    sheet = load(bolt)
    same = inputs.build(sheet.inputs, {"grade": "8.8", "threaded": "yes", "project": " Bridge  7 "})
    assert same == sheet.inputs() and hash(same) == hash(sheet.inputs())
    assert inputs.build(sheet.inputs, {"grade": "10.9"}) != sheet.inputs()
    assert inputs.Used(inputs.build(sheet.inputs, {"grade": "10.9", "threaded": False})).changed == {
        "grade",
        "threaded",
    }
    again = inputs.build(sheet.inputs, {f.name: v for f, v in inputs.Used(same).rows()})
    assert again == same


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ('a: Literal["x", "y"] = "z"  # kind', "kind a = 'z' must be one of x, y"),
        ("a: complex = 1j  # [m] pole", "a is of type complex, which is none of float, int, bool, str"),
        ("a: bool = True  # [m] switch", "a is no number and has neither unit nor limits"),
        ("a: bool = True  # switch; > 0", "a is no number and has neither unit nor limits"),
        ('a: float = one_of({}, "x")  # options', "options of a must be objects of one class of inputs"),
        (
            'a: float = one_of({"x": 1.0}, "x")  # o',
            "options of a must be objects of one class of inputs",
        ),
        (
            "a: float  # [m] length\n    b: float = 1.0  # [m] width\n    c: float = 1.0  # [m] height",
            "input a needs a value, such as a: float = 1.0; in a class of rows or options no field has one: "
            "there that of b, c must go",
        ),
        ("a: float = 1.0  # metre", "input a needs a comment with its unit, such as # \\[m\\] meaning"),
        ("a: int  # [mm] length", "a: the fields of options and rows are floats, texts, or ints in "),
        ("a: int = 2.5  # [-] count", ", line 5: a = 2.5 must be a whole number"),
        ('a: float = "4 mm"  # [mm] length', ", line 5: a = '4 mm' is no number"),
        ('a: int = "2"  # [-] count', "a = '2' is no number"),
        ("a: float = True  # [m] length", "a = True is no number"),
        ("a: float = None  # [m] length", "a = None is no number"),
        ("a: float = 0,5  # [m] length; > 0", r"a = \(0, 5\) is several values: a decimal number has a point"),
        ("a: list[float] = 2.0  # [m] lengths", "a = 2.0 must be a list of numbers"),
        ("a: list[float] = []  # [m] lengths", "lengths a must have 1 to 10000 rows, not 0"),
        ('a: list[float] = ["1 m", 2.0]  # [m] lengths', "a = .'1 m', 2.0. must be a list of numbers"),
        ("a: list[float] = [[1.0], [1.0, 2.0]]  # [m] lengths", "must be a list of numbers"),
        ("a: list[Row] = [(1.0, 2.0)]  # rows", r"a = .* must be a list of rows such as Row\(x, y\)"),
        ("a: list[Row] = Row(1.0, 2.0)  # row", r"a = Row\(x=1.0, y=2.0\) must be a list of rows such as Row"),
        ("a: list[Row] = []  # rows", "rows a must have 1 to 10000 rows, not 0"),
        ('a: bool = "perhaps"  # switch', "switch a = 'perhaps' must be yes or no"),
    ],
)
def test_a_declaration_that_cannot_be_meant_is_told_at_its_line(lines: str, message: str) -> None:
    row = "@inputs\nclass Row:\n    x: float  # [m] place\n    y: float  # [m] place\n" if "Row" in lines else ""
    start = "from typing import Literal\nfrom mechsheet import one_of, inputs\n"
    with pytest.raises(SheetError, match=message):
        run(f"{start}{row}@inputs\nclass A:\n    {lines}\n")


def test_limits_stand_beside_a_unit_that_is_not_known() -> None:
    """A bad unit harms its own line only: what can be compared with it is not."""
    lines = "a: float = 0.2  # [mms] length; > 0 < 30\n    b: float = 0.1  # [mm] width; > 0 < a <= 200\n"
    cls: Any = run(f"from mechsheet import inputs\n@inputs\nclass A:\n    {lines}")["A"]
    a, b = inputs.declared(cls)
    assert "unit [mms] is not known" in a.mistake and not b.mistake and cls().a == 0.2
    assert (a.limits, b.limits) == (((">", "0"),), ((">", "0"), ("<=", "200")))
    with pytest.raises(SheetError, match=r"width b = 300\.0 mm must be <= 200 mm$"):
        cls(b=0.3)


def test_a_temperature_is_in_kelvins() -> None:
    lines = "t: float = celsius(40)  # [degC] oil; > 0\n    d: float = 40 * degC  # [degC] rise\n"
    start = "from mechsheet import inputs\nfrom mechsheet.units import celsius, degC\n@inputs\nclass A:\n    "
    t, d = inputs.declared(run(start + lines)["A"])
    assert "write a temperature in [K]" in t.mistake and not d.mistake and d.unit == "degC"


def test_scenes_give_every_kind(bolt: Path, tmp_path: Path) -> None:
    scene = tmp_path / "other.toml"
    scene.write_text('want = ["U"]\n[inputs]\ngrade = "10.9"\nthreaded = false\nshear = "double"\n', encoding="utf-8")
    answer = script(bolt, f"--scene={scene}")
    assert answer.returncode == 0, answer.stderr
    assert f"U = {use('10.9', 'double', False):.6g}, use" in answer.stdout
    fields = inputs.declared(load(bolt).inputs)
    assert arguments.load(scene, fields).inputs == {"grade": "10.9", "threaded": False, "shear": "double"}


def test_arguments_give_every_kind_and_bad_ones_one_line(bolt: Path) -> None:
    found = script(bolt, "--grade=12.9", "--threaded=no", "--project=Hall", "--out=.")
    assert found.returncode == 0, found.stderr
    wrong = script(bolt, "--grade=5.6")
    assert wrong.returncode == 2
    assert wrong.stderr.strip() == "error: grade of the bolt grade = '5.6' must be one of 8.8, 10.9, 12.9"


def test_sweeps_vary_every_kind(bolt: Path) -> None:
    axes: dict[str, Any] = {"grade": ["8.8", "10.9", "9.8"], "shear": ["single", "double"], "F": [2.0, 4.0]}
    swept = sweep(bolt, ["U", "U_x"], grid(**axes))
    assert swept.shape == (3, 2, 2)
    for i, grade in enumerate(axes["grade"][:2]):
        for j, shear in enumerate(axes["shear"]):
            for k, F in enumerate(axes["F"]):
                assert swept["U"][i, j, k] == pytest.approx(use(grade, shear, True, F), rel=1e-14)
    assert np.isnan(swept["U"][2]).all()
    assert set(swept.reasons[2].ravel()) == {"grade of the bolt grade = '9.8' must be one of 8.8, 10.9, 12.9"}
    assert set(swept.frame()["grade [-]"]) == {"8.8", "10.9"} | {swept.inputs["grade"][2, 0, 0]}
    switched = sweep(bolt, ["U"], {"threaded": [True, False]})
    assert switched["U"].tolist() == pytest.approx([use(), use(threaded=False)], rel=1e-14)


def test_studies_of_small_steps_leave_out_what_has_none(bolt: Path) -> None:
    found = sensitivity(bolt, ["U"])
    assert list(found.inputs) == ["d", "F"]
    with pytest.raises(SheetError, match="cannot be differentiated by grade of the bolt grade, which is no number"):
        sensitivity(bolt, ["U"], ["grade"])


def test_units_of_properties_are_followed(bolt: Path, tmp_path: Path) -> None:
    assert mismatches(bolt) == []
    wrong = tmp_path / "wrong.py"
    wrong.write_text(SHEET.replace("R = g.grade.R_e / g.grade.R_m", "R = g.grade.R_e / g.F"), encoding="utf-8")
    assert any("[-] does not fit" in str(mistake) for mistake in mismatches(wrong))


def test_nothing_is_left_out_of_the_recording(bolt: Path) -> None:
    sheet = load(bolt)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    assert record({**names, "__file__": sheet.path}).gaps == []


def test_the_workbook_follows_every_kind(bolt: Path, tmp_path: Path, recalculated: Callable[[Path], Any]) -> None:
    assert script(bolt, f"--out={tmp_path}").returncode == 0
    changes = {"grade": "10.9", "shear": "double", "threaded": "no", "F": 6.0}
    path = edit(tmp_path / "bolt.xlsx", changes, tmp_path / "edited.xlsx")
    sheet = load(bolt)
    read = reading.inputs(path, inputs.declared(sheet.inputs))
    assert inputs.build(sheet.inputs, read) == inputs.build(sheet.inputs, changes)
    arguments = [f"--{name}={value}" for name, value in changes.items()]
    assert script(bolt, f"--out={tmp_path / 'own'}", *arguments).returncode == 0
    own = Values(tmp_path / "own" / "bolt.xlsx")
    assert not list(disagreements(recalculated(path), own))


@pytest.mark.parametrize(
    "changes", [{"grade": "9.8"}, {"threaded": "perhaps"}, {"shear": "dobule"}, {"project": "Hall"}]
)
def test_the_workbook_has_no_number_for_what_is_no_option_and_under_a_text_that_is_another(
    changes: dict[str, Any], bolt: Path, tmp_path: Path, recalculated: Callable[[Path], Any]
) -> None:
    assert script(bolt, f"--out={tmp_path}").returncode == 0
    path = edit(tmp_path / "bolt.xlsx", changes, tmp_path / "edited.xlsx")
    book = recalculated(path)
    assert [row[1] for row in book["Table 1"].iter_rows(values_only=True)][5:] == ["#N/A", "#N/A"]
    if "project" not in changes:
        with pytest.raises(SheetError, match="must be"):
            reading.inputs(path, inputs.declared(load(bolt).inputs))


@pytest.mark.parametrize(
    ("value", "unit", "said"),
    [
        (900, "MPa", r"cell B\d+: tensile strength grade.R_m \(8.8\) = 900.0 MPa, which the worksheet has as 800.0"),
        ("strong", "MPa", "= 'strong' MPa is no number"),
        (0.8, "GPa", ""),
        ("800,0", "MPa", ""),
    ],
)
def test_a_property_of_an_option_that_is_another_in_a_workbook_is_told(
    value: object, unit: str, said: str, bolt: Path, tmp_path: Path
) -> None:
    """The workbook computed with it, and a run of that workbook with the worksheet's own, without a word."""
    assert script(bolt, f"--out={tmp_path}").returncode == 0
    name = "grade.R_m (8.8)"
    path = edit(tmp_path / "bolt.xlsx", {name: value, "F": 6.0}, tmp_path / "edited.xlsx", {name: unit})
    declared = inputs.declared(load(bolt).inputs)
    if said:
        with pytest.raises(SheetError, match=said):
            reading.inputs(path, declared)
    else:
        assert reading.inputs(path, declared)["F"] == 6.0


def test_a_text_of_an_option_that_is_another_in_a_workbook_is_told(tmp_path: Path) -> None:
    sheet = tmp_path / "bolt.py"
    labelled = SHEET.replace("        R_m: float", "        made: str  # way\n        R_m: float", 1)
    sheet.write_text(labelled.replace("Grade(", 'Grade("cold", '), encoding="utf-8")
    assert script(sheet, f"--out={tmp_path}").returncode == 0
    declared = inputs.declared(load(sheet).inputs)
    assert reading.inputs(tmp_path / "bolt.xlsx", declared)["grade"] == "8.8"
    path = edit(tmp_path / "bolt.xlsx", {"grade.made (8.8)": "hot"}, tmp_path / "edited.xlsx")
    with pytest.raises(SheetError, match=r"way grade.made \(8.8\) = hot, which the worksheet has as cold"):
        reading.inputs(path, declared)


def test_inputs_in_the_meanings_of_inputs_are_symbols(tmp_path):
    """On the page and in the page in one file, where they are edited and where they are printed; M8 is no input."""
    path = tmp_path / "lengths.py"
    own = "L1: float = 2 * mm  # [mm] lever\n    F: float = 5 * kN  # [kN] force beside L1, bolt M8\n"
    path.write_text(SHEET.replace("F: float = 5 * kN  # [kN] force\n", own), encoding="utf-8")
    g = load(path).inputs()
    for shown in (
        page_fields.fields(g).text,
        page_values.html(Used(g)),
        html_fields.fields(g),
        html_values.still(Used(g)),
    ):
        assert "beside <i>L</i><sub>1</sub>, bolt M8" in shown
