"""A choice of names where a text is expected, whole numbers of options and rows, and an input asked for as a result."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import written_cells
from as_script import as_script
from cells import run

from mechsheet import evaluate, load, sweep
from mechsheet.html import fields as html_fields
from mechsheet.quantities.lines import Recording
from mechsheet.recording.record import record
from mechsheet.run import arguments
from mechsheet.studies import asked_design
from mechsheet.worksheet import inputs, mistakes
from mechsheet.worksheet.check import checks_of
from mechsheet.worksheet.chosen import Chosen
from mechsheet.worksheet.errors import SheetError
from tests.own_worksheet import value_of, written

SHEET = written(
    """
from typing import Literal

from mechsheet import ask, check, export, inputs, one_of, read, table, typeset

@inputs
class Gear:
    z: int  # [-] teeth; > 0
    m: float  # [kg] mass

GEARS = {"small": Gear(17, 0.5), "large": Gear(43, 2.0)}
""",
    """
mode: Literal["low", "high"] = "low"  # mode
gear: Gear = one_of(GEARS, "small")  # gear
gears: list[Gear] = [Gear(17, 1.0), Gear(20, 1.5)]  # gears
h: float = 2.0  # [-] height
""",
    """
z_all = g.gear.z + sum(g.gears.z)  # [-] teeth
check_1 = check("stress, " + g.mode, z_all, 100)
check_2 = check(g.mode + " stress" if g.mode.startswith("l") else g.mode.upper(), g.h, 3)
typeset(check_1, check_2)
""",
    "Gears",
)


@pytest.fixture(scope="module")
def gears(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "gears.py"
    path.write_text(SHEET, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("mode", "names"), [("low", ["stress, low", "low stress"]), ("high", ["stress, high", "HIGH"])]
)
def test_the_chosen_name_is_used_as_a_text(gears: Path, mode: str, names: list[str]) -> None:
    sheet = load(gears)
    found = sheet.run(sheet.results, {"g": inputs.build(sheet.inputs, {"mode": mode})})
    assert [check.name for check in checks_of(found)] == names
    recording = record({**found, "__file__": sheet.path})
    assert [*recording.checks] == names and recording.gaps == []
    assert recording.guards, "of another choice it is another name"


@pytest.mark.parametrize(
    ("takes", "said"),
    [
        (lambda mode: 2 * mode, "'int' and an option (an option is no number"),
        (lambda mode: mode - 1, "an option and 'int' (an option is no number"),
        (lambda mode: mode == "hihg", "'hihg' is none of the options low, high"),
    ],
)
def test_what_takes_no_option_is_told_in_words(takes: Callable[[Chosen], object], said: str) -> None:
    """It said Chosen."""
    with pytest.raises((TypeError, ValueError)) as raised:
        takes(Chosen(("low", "high"), 1, {}))
    assert said in mistakes.told(raised.value, "gears.py")


TAKEN = {  # forms in which whatever takes a text takes an option
    "len(g.m)": [5, 9],
    "len(', '.join([g.m, 'x']))": [8, 12],
    "len(sorted([g.m, 'iron'])[0])": [4, 9],
    "'iron' in g.m": [False, True],
    "g.m in 'mild steel'": [True, False],
    "g.m.startswith('c') + g.m.find('e') + len(g.m.upper().split())": [3, 2],
    "isinstance(g.m, str)": [True, True],
    "len(f'{g.m:>12}'.strip() + g.m + ' x')": [12, 20],
    "(g.m < 'd') + 2 * (g.m >= 'd') + 4 * ('d' > g.m) + 8 * ('d' <= g.m)": [10, 5],
    "g.m in ('cast iron', 'steel')": [True, True],
    "{'steel': 3, 'cast iron': 4}[str(g.m)]": [3, 4],
    "len([*reversed(g.m)])": [5, 9],
    "(np.array(['steel', 'steel', 'cast iron']) == g.m).sum()": [2, 1],
    "int(bool(g.m))": [1, 1],
    "bool(re.match('st', g.m))": [True, False],
    "str.upper(g.m) == 'STEEL'": [True, False],
    "len(json.dumps([g.m]))": [9, 13],
    "pd.Series([1.0, 2.0], ['steel', 'cast iron'])[g.m]": [1, 2],
    "getattr(SimpleNamespace(steel=3), g.m, 4)": [3, 4],
}
NOT_FOLLOWED = ("re.", "str.upper", "json", "pd.")


def taken(path: Path, lines: str) -> tuple[list[Any], Recording]:
    """The second number of y for each of the options, and the recording of the first."""
    setup = """
import json
import re
from types import SimpleNamespace
from typing import Literal

import numpy as np
import pandas as pd

from mechsheet import ask, inputs, read, table
"""
    given = 'm: Literal["steel", "cast iron"] = "steel"  # m\nh: float = 2.0  # [-] h'
    path.write_text(written(setup, given, f"{lines}\ntable_1 = table('1', 'y', y)"), encoding="utf-8")
    sheet = load(path)
    found = [sheet.run(sheet.results, {"g": inputs.build(sheet.inputs, {"m": m})}) for m in ("steel", "cast iron")]
    return [each["y"][1] for each in found], record({**found[0], "__file__": sheet.path})


@pytest.mark.parametrize("form", TAKEN)
def test_whatever_takes_a_text_takes_an_option(form: str, tmp_path: Path) -> None:
    """Of the other option the recording has its own number, or it tells that it has none."""
    found, recording = taken(tmp_path / "taken.py", f"y = np.arange(3.0) * ({form}) * g.h  # [-] y")
    assert found == [2 * wanted for wanted in TAKEN[form]]
    assert len(recording.gaps) == any(part in form for part in NOT_FOLLOWED)
    for gap in recording.gaps:
        assert "recorded text" in gap.reason or "takes the text, str(..)" in gap.reason
    if not recording.gaps and not recording.guards:
        assert value_of(recording, "y", {"m": 1.0})[1] == found[1]


def test_a_pattern_that_tells_the_type_takes_an_option(tmp_path: Path) -> None:
    """None took it, and another way was gone without a word."""
    lines = "match g.m:\n    case str():\n        k = 3\n    case _:\n        k = 1\n"
    found, recording = taken(tmp_path / "taken.py", f"{lines}y = np.arange(3.0) * k * g.h  # [-] y")
    assert found == [6, 6]
    assert {gap.reason for gap in recording.gaps} == {"a pattern that tells the type of a number or a text"}


def test_properties_go_before_the_methods_of_texts_and_a_copy_is_the_same() -> None:
    option: Any = Chosen(("low", "high"), 1, {"title": 2.0, "count": 3})
    for each in (option, copy.deepcopy(option), pickle.loads(pickle.dumps(option))):
        assert (each.title, each.count, each.upper(), each == "high", each == "low") == (2.0, 3, "HIGH", True, False)


def test_whole_numbers_of_options_and_rows_are_counted(gears: Path, tmp_path: Path) -> None:
    assert evaluate(gears, ["z_all"])["z_all"] == 17 + 37
    g: Any = load(gears).inputs()
    assert isinstance(g.gear.z, int)
    assert evaluate(gears, ["z_all"], gear="large", gears="18; 1 | 21; 2 | 25; 3")["z_all"] == 43 + 64
    with pytest.raises(SheetError, match=r"teeth gears.z \(2\) = 20\.5 must be a whole number"):
        evaluate(gears, ["z_all"], gears="17; 1 | 20,5; 2")
    swept = sweep(gears, ["z_all"], {"gears": ["17; 1", "17.5; 1"]})
    assert swept["z_all"][0] == 34 and "z (1) = 17.5 must be a whole number" in swept.reasons[1]
    assert [column["whole"] for column in html_fields.told(g)["fields"][2]["columns"]] == [True, False]
    assert as_script(gears, f"--out={tmp_path}").returncode == 0
    cells = written_cells.read(tmp_path / "gears.xlsx")["Input tables"]
    assert any(value == "whole number, > 0" for _, value in cells.values())
    assert sum("=INT(" in formula for formula, _ in cells.values()) == 2


def test_code_gives_whole_numbers_too(gears: Path) -> None:
    cls: Any = load(gears).inputs
    with pytest.raises(SheetError, match=r"teeth gears.z \(1\) = 17\.5 must be a whole number"):
        cls(gears=[SimpleNamespace(z=17.5, m=1.0)])


@pytest.mark.parametrize("line", ["z: int  # [mm] teeth", "is_new: bool  # new"])
def test_what_an_option_or_a_row_cannot_have_is_told(line: str) -> None:
    name = line.partition(":")[0]
    must = rf"line 4: {name}: the fields of options and rows are floats, texts, or ints in \[-\], as 1 and 0 for yes"
    with pytest.raises(SheetError, match=must):
        run(f"from mechsheet import inputs\n@inputs\nclass Part:\n    {line}\n    m: float  # [kg] mass")


def test_an_input_is_no_result_and_told_as_one(gears: Path) -> None:
    said = rf"h is an input of {gears}, not a result: h_1 = g.h in a line is one"
    varied = asked_design.read(["--vary=h=1..2", "--best=max h"], inputs.declared(load(gears).inputs))
    assert asked_design.Problem(gears, varied), "one that is varied may be the goal"
    asked = asked_design.read(["--vary=w=1..2", "--best=max h"], inputs.declared(load(gears).inputs))
    with pytest.raises(arguments.UsageError, match=said):
        asked_design.Problem(gears, asked)
    for ask in (lambda: evaluate(gears, ["h"]), lambda: sweep(gears, ["h"], {"h": np.array([1.0])})):
        with pytest.raises(SheetError, match=said):
            ask()


def test_a_table_of_one_column_is_given_in_one_line_and_of_its_rows_what_is_misspelt_is_told(tmp_path: Path) -> None:
    """Its page took such a text, a command not; an attribute of a row was told without the one that is meant."""
    path = tmp_path / "rings.py"
    setup = "from mechsheet import ask, inputs, read\n\n@inputs\nclass Ring:\n    diameter: float  # [mm] diameter"
    given = "rings: list[Ring] = [Ring(0.05), Ring(0.06)]  # rings"
    path.write_text(written(setup, given, "y = sum(g.rings.diameter)  # [mm] sum\nn = len(g.rings)  # [-] number"))
    for text, n in {"72; 75": 2, "72; 75;": 2, "72 | 75": 2, "72": 1, "72;": 1}.items():
        found = evaluate(path, ["y", "n"], rings=text)
        assert found["n"] == n and found["y"] == pytest.approx([0.072, 0.147][n - 1])
    assert as_script(path, "--rings=72; 75").returncode == 0
    for row in ("for r in g.rings", "for r in [Ring(0.05)]"):
        path.write_text(written(setup, given, f"y = [r.diametr {row}][0]  # [mm] first"))
        run = as_script(path)
        assert run.returncode and run.stderr.rstrip().endswith("Ring has no diametr (did you mean diameter?)"), (
            run.stderr
        )
