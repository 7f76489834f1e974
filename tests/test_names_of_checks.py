"""Names of checks and in drawings with numbers and texts in them follow, and nothing else rests on them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from own_worksheet import own, written
from test_recalculation import computed, edit

from mechsheet import evaluate, load
from mechsheet.html import write
from mechsheet.run import arguments
from mechsheet.run.batch import compute
from mechsheet.worksheet.check import checks_of
from mechsheet.worksheet.scene import Limit, Scene

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
from typing import Literal

import numpy as np

from mechsheet import Drawing, ask, check, export, inputs, one_of, read, typeset
from mechsheet.units import MPa, kN, mm

@inputs
class Case:
    name: str  # name of the case
    F: float  # [kN] force

@inputs
class Steel:
    R_e: float  # [MPa] yield strength

STEELS = {"S235": Steel(235 * MPa), "S355": Steel(355 * MPa)}
"""
GIVEN = """
cases: list[Case] = [Case("braking", 12 * kN), Case("cornering", 8 * kN)]  # load cases
steel: Steel = one_of(STEELS, "S235")  # steel
side: Literal["left", "right"] = "left"  # side
A: float = 100 * mm**2  # [mm**2] area; > 0
n: int = 3  # [-] bolts; > 0
"""
LINES = """
sigma = g.cases.F / g.A  # [MPa] stress
worst = g.cases.name[np.argmax(sigma)]
each = [check(f"{c.name} on {g.n} bolts", s, g.steel.R_e, "MPa") for c, s in zip(g.cases, sigma)]
def of_all(what):
    return check(f"{what} of {g.steel} at {g.A / mm**2:.1f} mm²", sigma.max(), g.steel.R_e, "MPa")
all_ok = of_all("stress")
way = check(f"{worst}, {'pull' if g.cases[0].F > 0 else 'push'}, {g.side}", sigma.max(), g.steel.R_e, "MPa")
picture = Drawing().link(0j, 1 + 0j, g.cases[0].name).force(1 + 0j, 1j, f"{worst}: most")
slight = check(f"area within {g.A:.3g} m²", g.A, 1.0)
signed = check(f"{g.A / mm**2 - 150:+.1f} mm² of {4e4 * g.A / mm**2:,.0f}, {-12345.67 * g.n:+,.2f}", g.A, 1.0)
"""
OTHERS: list[dict[str, Any]] = [
    {},
    {"cases": "braking; 12 | of the plough; 30", "n": 4, "A": 250.0},
    {"cases": 'a"b & <c>; -3 | cornering; 2', "steel": "S355", "side": "right"},
]


@pytest.fixture(scope="module")
def sheet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "names.py"
    text = written(SETUP, GIVEN, LINES, "Names")
    path.write_text(
        text.replace("    return sigma", "    typeset(*each, all_ok, way, slight, signed, picture)\n    return sigma")
    )
    return path


def verdicts(path: Path, given: dict[str, Any]) -> dict[str, str]:
    """Those of the worksheet for some inputs, by the names of the checks."""
    found = checks_of(evaluate(path, ("each", "all_ok", "way", "slight", "signed"), **given))
    return {check.name: "PASS" if check.passed else "FAIL" for check in found}


def of_the_cases(given: dict[str, Any]) -> dict[str, Any]:
    """What is typed into a workbook for some inputs."""
    rows = (row.split("; ") for row in given["cases"].split(" | ")) if "cases" in given else ()
    cells = {f"cases.{k} ({n})": x if k == "name" else float(x)
             for n, row in enumerate(rows, 1) for k, x in zip(("name", "F"), row, strict=True)}  # fmt: skip
    return {**{k: x for k, x in given.items() if k != "cases"}, **cells}


@pytest.mark.office
def test_cells_have_the_names_of_other_inputs(sheet: Path, recalculated_all: Any, tmp_path: Path) -> None:
    """A name with a number in it left its check without a verdict; a number in no plain format has a sign there."""
    book = computed(sheet, tmp_path, {})
    edited = [edit(book, of_the_cases(given), tmp_path / f"{n}.xlsx") for n, given in enumerate(OTHERS)]
    for given, there in zip(OTHERS, recalculated_all(edited), strict=True):
        rows = [*there["Checks"].iter_rows(min_row=3, values_only=True)]
        seen = {row[0]: row[4] for row in rows if not row[0].startswith(("inputs", "units", "made"))}
        own = verdicts(sheet, given)
        if "A" in given:
            own = {"area within … m²" if name.startswith("area") else name: told for name, told in own.items()}
        assert seen == own
        (made,) = [row for row in rows if row[0].startswith("made for these inputs")] or [(*"abcd", "PASS")]
        assert made[4] == "PASS"
        behind = [row[3] for row in there["Residuals lines"].iter_rows(min_row=3, values_only=True)]
        assert behind and not any("braking" in told or "S235" in told for told in behind)


def test_a_page_has_the_names_of_other_inputs(sheet: Path, tmp_path: Path, page: Page) -> None:
    file, declared = tmp_path / "names.html", load(sheet)
    file.write_text(write.page(declared, declared.inputs()), encoding="utf-8")
    for given in OTHERS:
        page.goto("about:blank")
        page.goto(file.as_uri())
        page.wait_for_selector("body[data-ready]")
        for label, text in typed(given):
            field = page.get_by_label(label, exact=True)
            field.select_option(text) if label in ("steel", "side") else field.fill(text)
        shown = page.locator(".ms-check").evaluate_all("checks => checks.map(c => c.innerText)")
        own = verdicts(sheet, given)
        assert [text.split()[0] for text in shown] == [*own.values()]
        drawn = [text.replace(" ", " ") for text in page.locator("main svg text").all_text_contents()]
        names = evaluate(sheet, ("way",), **given)["way"].name.split(", ")[0], cases_of(given)[0]
        assert {f"{names[0]}: most", names[1]} <= {*drawn}
        assert [text.split(" ", 1)[1].split(":")[0].replace(" ", " ") for text in shown] == [*own]


def cases_of(given: dict[str, Any]) -> list[str]:
    return [row.split("; ")[0] for row in given.get("cases", "braking; 12").split(" | ")]


def typed(given: dict[str, Any]) -> list[tuple[str, str]]:
    rows = [row.split("; ") for row in given.get("cases", "").split(" | ")] if "cases" in given else []
    cells = [(f"{k}, row {n}", x) for n, row in enumerate(rows, 1) for k, x in zip(("name", "F"), row, strict=True)]
    return cells + [(k, str(x)) for k, x in given.items() if k != "cases"]


@pytest.mark.parametrize("name", ['"line " + str(g.k)', 'f"line {g.k}"', 'f"line " f"{g.k}" + ""'])
def test_a_check_is_wanted_by_its_name_however_that_is_put_together(name: str, tmp_path: Path) -> None:
    """Of a sum of texts it was said that no check has it, which the report tells beside its verdict."""
    sheet = own(tmp_path, f"from mechsheet import check\nstrong = check({name}, g.F, 5.0)")
    assert evaluate(sheet.path, ["line 3"], k=3)["line 3"].passed


def test_a_wanted_check_that_is_not_there_has_not_passed(tmp_path: Path) -> None:
    """A name with a value in it may be any: a scene that wanted another one than there is ended with exit code 0."""
    sheet = own(tmp_path, "from mechsheet import check\nstrong = check(f'force, line {g.k}', g.F, 5.0)")
    with pytest.raises(arguments.UsageError, match="no check is named 'force, line 4'; nearest: 'force, line 2'"):
        compute(sheet, "scene", Scene(want=("force, line 4",)))
    for results, want in (
        (sheet.results, "force, line 2"),
        (["force"], "force, line 2"),
        (["strong"], "force, strong"),
    ):
        named = arguments.read([f"--want={want}"], (), results).want
        assert named == (tuple(want.split(", ")) if "strong" in want else ("force, line 2",))


def test_a_check_that_is_called_like_a_function_is_wanted_and_limited(tmp_path: Path) -> None:
    """A function of the setup has no value, so the name is that of the check: it was "declared by no line"."""
    sheet = own(tmp_path, "from mechsheet import check\ncheck('sqrt', sqrt(g.F), 5.0)")
    given = Scene({"F": 9.0}, want=("sqrt",), limits={"sqrt": Limit(max=3.5)})
    (judged,) = compute(sheet, "scene", given)[0].checks
    assert (judged.residual, judged.limit) == (3, 3.5)
    assert [evaluate(sheet.path, ["sqrt"], F=F)["sqrt"].residual for F in (4.0, 9.0, 16.0)] == [2, 3, 4]


def test_checks_that_take_the_same_stand_as_they_are_stated(tmp_path: Path, page: Page) -> None:
    """In the summary they kept the order in which other inputs had left them."""
    lines = """
first = check("first", 4 + g.n, 10.0)
second = check("second", 10.0 - g.n, 10.0)
third = check("third", 7.0, 10.0)
"""
    path = tmp_path / "order.py"
    text = written(SETUP.replace("import Drawing, ", "import Drawing, summary, "), GIVEN, lines)
    path.write_text(
        text.replace("    return first", "    typeset(summary(first, second, third), third)\n    return first")
    )
    file = tmp_path / "order.html"
    file.write_text(write.page(load(path), load(path).inputs()), encoding="utf-8")
    page.goto(file.as_uri())
    page.wait_for_selector("body[data-ready]")

    def order(n: int) -> list[str]:
        page.locator("#input-n").fill(str(n))
        return page.locator(".ms-summary .ms-row a").all_inner_texts()

    assert order(4) == ["first", "third", "second"]
    assert order(2) == ["second", "third", "first"]
    assert order(3) == ["first", "second", "third"]
